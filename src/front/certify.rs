//! A proof for a point that somebody has computed.

use super::error::Error;
use super::problem::Problem;
use super::solution::Solution;
use mceip_check::Proved;
use mceip_check::certificate::Certificate;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{Certifier, certificate, of_negative_values};
use mceip_engine::lean::elaborate_file;
use mceip_engine::report::Listed;
use mceip_engine::run::Watch;
use mceip_model::reduction::reduce;

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
        let reflected = problem.reflected().filter(|_| value < 0.0);
        let of_sign = reflected.as_ref().unwrap_or(problem);
        let reduced = reduce(of_sign)?;
        let certifier = Certifier::new(of_sign, &reduced.pencil);
        let mut candidate = Candidate::given(problem, value, x.to_vec());
        if reflected.is_some() {
            candidate = candidate.reflected();
        }
        let (claim, mut proved) = certifier.certify_with_verdict(&candidate)?;

        let mut listed = Listed::of_claim(of_sign, &reduced, &claim);
        let mut certificate = certificate(of_sign, vec![claim]);
        if reflected.is_some() {
            proved = proved.reflected();
            listed = listed.reflected();
            certificate = of_negative_values(problem, certificate);
        }

        Ok(Certified {
            solution: Solution::new(problem.unknown(), &proved, &listed),
            certificate: Proved::new(problem, certificate)?,
        })
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
