//! A proof for a point that somebody has computed.

use super::error::Error;
use super::problem::Problem;
use super::solution::Solution;
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{AcceptedClaim, Proved};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{Certifier, of_negative_values};
use mceip_engine::lean::elaborate_file;
use mceip_engine::report::Listed;
use mceip_engine::run::Watch;
use mceip_engine::signs::{BothSigns, OfSign};

/// A solution with its own certificate.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Certified {
    /// The solution near the point.
    pub solution: Solution,
    certificate: Proved<Certificate>,
}

impl Certified {
    /// The certificate, which the checker has accepted.
    pub fn certificate(&self) -> &Certificate {
        self.certificate.certificate()
    }
}

impl Problem {
    /// Proves that there is a solution near a point in doubles: a value of the unknown, and x over
    /// the variables of the pencil in any positive scale.
    ///
    /// # Errors
    /// [`Error::NotCertified`] with every support that was tried and what failed on it. That is no
    /// proof that there is none: see [`Problem::complete`].
    ///
    /// ```
    /// use mceip::Problem;
    /// let problem = Problem::read("spec/examples/fold.json")?;
    /// let certified = problem.certify(2.0000001, &[0.666667, 0.333333])?;
    /// assert_eq!(certified.solution.value, 2.0);
    /// assert!(problem.certify(2.5, &[0.5, 0.5]).is_err());
    /// # Ok::<(), mceip::Error>(())
    /// ```
    pub fn certify(&self, value: f64, x: &[f64]) -> Result<Certified, Error> {
        let problem = self.as_model();
        let given = Candidate::given(problem, value, x.to_vec());
        let signs = BothSigns::of(problem)?;
        let on = |side: &OfSign| {
            let certifier = Certifier::new(&side.problem, &side.reduced.pencil);
            certifier.certify_with_verdict(&side.candidate(&given))
        };

        let (likelier, other) = signs.near(&given);
        let reason = match on(likelier) {
            Ok((claim, verdict)) => return certified(problem, likelier, claim, verdict),
            Err(reason) => reason,
        };
        match other.map(|other| (other, on(other))) {
            Some((other, Ok((claim, verdict)))) => certified(problem, other, claim, verdict),
            _ => Err(reason.into()),
        }
    }

    /// The full text of a lean certificate (`mceip-lean/1`) about this problem: the matrices that
    /// it leaves out are made anew. It is not checked.
    ///
    /// # Errors
    /// [`Error::Lean`]: another problem, another format, or an anchor that cannot be made.
    pub fn elaborate(&self, lean: &str) -> Result<String, Error> {
        Ok(elaborate_file(self.as_model(), lean, &Watch::nobody())?)
    }
}

/// A claim that the checker has accepted of a problem, or of its reflection, as one of the problem.
fn certified(
    problem: &mceip_model::Problem,
    side: &OfSign,
    claim: Claim,
    mut verdict: AcceptedClaim,
) -> Result<Certified, Error> {
    let mut listed = Listed::of_claim(&side.problem, &side.reduced, &claim);
    let mut certificate = Certificate::of_claims(&side.problem, vec![claim]);
    if side.problem.is_reflected() {
        verdict = verdict.reflected();
        listed = listed.reflected();
        certificate = of_negative_values(problem, certificate);
    }

    Ok(Certified {
        solution: Solution::new(problem.unknown(), &verdict, &listed),
        certificate: Proved::new(problem, certificate)?,
    })
}
