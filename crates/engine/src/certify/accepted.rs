//! Claims that the checker has accepted: the one way from a candidate to the word "certified".
//!
//! Each proposal for a candidate is handed to the checker; the first one it accepts is returned.
//! Called by searches, the command `certify`, and `judge` for reported solutions.

use super::failure::{Attempt, AttemptFailure, NotCertified};
use super::proposals::{Preference, Proposal, proposals};
use super::rows::IntegralRows;
use crate::candidate::Candidate;
use crate::reduction::zero_of;
use crate::tolerance::MEANT_VALUE;
use mceip_check::certificate::Claim;
use mceip_check::{AcceptedClaim, ClaimChecker, Reason};
use mceip_exact::to_f64;
use mceip_model::{Pencil, Problem, ZeroVariables};

/// Makes claims about one problem and has each of them checked.
pub struct Certifier<'a> {
    problem: &'a Problem,
    pencil: &'a Pencil,
    rows: IntegralRows,
    /// The variables of the particles in contact with zero reaction.
    zero: Vec<ZeroVariables>,
    checker: ClaimChecker<'a>,
    preference: Preference,
}

impl<'a> Certifier<'a> {
    /// The certifier of a problem, exact numbers before boxes; `pencil` is the problem's reduced
    /// pencil, of a system with particles in contact with zero reaction that of the split form.
    pub fn new(problem: &'a Problem, pencil: &'a Pencil) -> Certifier<'a> {
        let zero = zero_of(problem);
        Certifier {
            problem,
            pencil,
            rows: IntegralRows::of(pencil).with_zero(zero.clone()),
            zero,
            checker: ClaimChecker::new(problem),
            preference: Preference::Exact,
        }
    }

    /// The same with this choice between exact numbers and boxes.
    pub fn with_preference(self, preference: Preference) -> Certifier<'a> {
        Certifier { preference, ..self }
    }

    /// A claim that the candidate suggests and the checker accepts, in the problem's window.
    ///
    /// # Errors
    /// [`NotCertified`] with every support tried and what failed on it; among the failures the
    /// checker's reasons.
    pub fn certify(&self, candidate: &Candidate) -> Result<Claim, NotCertified> {
        let (claim, _) = self.certify_with_verdict(candidate)?;
        Ok(claim)
    }

    /// [`Certifier::certify`], and what the checker has read off the claim.
    ///
    /// # Errors
    /// As [`Certifier::certify`].
    pub fn certify_with_verdict(
        &self,
        candidate: &Candidate,
    ) -> Result<(Claim, AcceptedClaim), NotCertified> {
        let window = self.problem.window();
        let candidate = candidate.one_sided(&self.zero);
        let proposals = proposals(self.pencil, &self.rows, window, &candidate, self.preference)?;
        self.first_accepted(proposals, candidate.value)
    }

    /// The first proposal that the checker accepts with the value of the candidate, else the first
    /// one that it accepts: a component that looks like rounding may part two solutions of near
    /// values.
    fn first_accepted(
        &self,
        proposals: impl Iterator<Item = Proposal>,
        value: f64,
    ) -> Result<(Claim, AcceptedClaim), NotCertified> {
        let mut attempts = Vec::new();
        let mut first = None;
        for Proposal { support, claim } in proposals {
            match claim.and_then(|claim| self.examined(claim)) {
                Ok(accepted) if is_value(&accepted.1, value) => return Ok(accepted),
                Ok(accepted) => {
                    first.get_or_insert(accepted);
                }
                Err(failure) => attempts.push(Attempt { support, failure }),
            }
        }

        first.ok_or(NotCertified { attempts })
    }

    /// Every claim that the candidate suggests and the checker accepts, best first.
    pub(crate) fn every_accepted(&self, candidate: &Candidate) -> Vec<Claim> {
        let window = self.problem.window();
        let candidate = candidate.one_sided(&self.zero);
        let Ok(proposals) = proposals(self.pencil, &self.rows, window, &candidate, self.preference)
        else {
            return Vec::new();
        };

        let mut accepted = Vec::new();
        for proposal in proposals {
            if let Ok((claim, _)) = proposal.claim.and_then(|claim| self.examined(claim)) {
                accepted.push(claim);
            }
        }

        accepted
    }

    /// The claim and the verdict, if the checker accepts it.
    fn examined(&self, claim: Claim) -> Result<(Claim, AcceptedClaim), AttemptFailure> {
        match self.checker.verdict(self.problem.window(), &claim) {
            Ok(verdict) => Ok((claim, verdict)),
            Err(reason) => Err(AttemptFailure::Refused {
                reason: Box::new(reason),
            }),
        }
    }
}

/// Is the value of an accepted claim the one that a candidate has, up to [`MEANT_VALUE`]?
#[allow(
    clippy::float_arithmetic,
    reason = "which claim is meant, not whether it holds"
)]
fn is_value(accepted: &AcceptedClaim, value: f64) -> bool {
    let claimed = to_f64(&accepted.value.mid());
    (claimed - value).abs() <= MEANT_VALUE * value.abs()
}

/// A claim that the candidate suggests and the checker accepts; for several candidates a
/// [`Certifier`] is cheaper.
///
/// # Errors
/// As [`Certifier::certify`].
pub fn certify(
    problem: &Problem,
    pencil: &Pencil,
    candidate: &Candidate,
) -> Result<Claim, NotCertified> {
    Certifier::new(problem, pencil).certify(candidate)
}

/// Claims parted by the checker's verdict.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Sifted {
    /// Those that it accepts, in their order.
    pub accepted: Vec<Claim>,
    /// Those that it refuses, each with its place in the list and the reason.
    pub refused: Vec<(usize, Reason)>,
}

/// Has the checker part claims about a problem, in the problem's window.
pub fn sift(problem: &Problem, claims: Vec<Claim>) -> Sifted {
    let checker = ClaimChecker::new(problem);
    let mut sifted = Sifted::default();
    for (index, claim) in claims.into_iter().enumerate() {
        match checker.verdict(problem.window(), &claim) {
            Ok(_) => sifted.accepted.push(claim),
            Err(reason) => sifted.refused.push((index, reason)),
        }
    }

    sifted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::propose;
    use mceip_check::certificate::ExactSolution;
    use mceip_exact::{Sparse, whole};
    use mceip_model::file::Number;
    use mceip_model::{Body, Unknown, Window};

    /// [[1, -6], [2, -6]] + t I: t = 2 with x = (2, 1) and t = 3 with x = (3, 2).
    fn problem() -> Problem {
        let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
    }

    fn pencil(problem: &Problem) -> &Pencil {
        let Body::Pencil(pencil) = problem.body() else {
            panic!("a pencil")
        };
        pencil
    }

    fn good(problem: &Problem) -> Claim {
        let candidate = Candidate {
            value: 2.0,
            x: vec![0.666667, 0.333333],
        };
        propose(pencil(problem), problem.window(), &candidate).unwrap()
    }

    /// The claim with an x that solves nothing.
    fn forged(problem: &Problem) -> Claim {
        let Claim::ExactSolution(claim) = good(problem) else {
            panic!("an exact claim")
        };
        let x = vec![vec![Number(whole(1))], vec![Number(whole(1))]];
        Claim::ExactSolution(ExactSolution { x, ..claim })
    }

    fn proposal(claim: Claim) -> Proposal {
        Proposal {
            support: vec![0, 1],
            claim: Ok(claim),
        }
    }

    #[test]
    fn a_forged_claim_is_sifted_out_with_its_reason() {
        let problem = problem();

        let sifted = sift(&problem, vec![forged(&problem), good(&problem)]);

        assert_eq!(sifted.accepted, [good(&problem)]);
        let [(0, reason)] = &sifted.refused[..] else {
            panic!("one refusal: {:?}", sifted.refused)
        };
        assert_eq!(reason.name(), "YNotZero");
    }

    /// Whatever is proposed, only what the checker accepts comes out.
    #[test]
    fn a_forged_proposal_is_no_certified_solution() {
        let problem = problem();
        let certifier = Certifier::new(&problem, pencil(&problem));

        let alone = certifier.first_accepted([proposal(forged(&problem))].into_iter(), 2.0);

        let Err(refused) = alone else {
            panic!("a forged claim was accepted")
        };
        assert_eq!(refused.attempts.len(), 1);
        let failure = &refused.attempts[0].failure;
        assert!(
            matches!(failure, AttemptFailure::Refused { .. }),
            "{refused}"
        );
        let told = refused.to_string();
        assert!(told.contains("the checker refuses the claim"), "{told}");

        let both = [proposal(forged(&problem)), proposal(good(&problem))];
        let (accepted, _) = certifier.first_accepted(both.into_iter(), 2.0).unwrap();
        assert_eq!(accepted, good(&problem));
    }

    #[test]
    fn what_is_no_solution_is_not_certified() {
        let problem = problem();
        let certifier = Certifier::new(&problem, pencil(&problem));

        let near = Candidate {
            value: 2.000001,
            x: vec![0.666667, 0.333333],
        };
        assert_eq!(certifier.certify(&near), Ok(good(&problem)));
        assert_eq!(
            certify(&problem, pencil(&problem), &near),
            Ok(good(&problem))
        );

        let between = Candidate {
            value: 2.5,
            x: vec![0.6, 0.4],
        };
        assert!(certifier.certify(&between).is_err());
    }
}
