//! Claims that the checker has accepted: the one way from a candidate to the word "certified".
//!
//! Each proposal for a candidate is handed to the checker; the first one it accepts is returned.
//! Called by searches, the command `certify`, and `judge` for reported solutions.

use super::failure::{AttemptFailure, NotCertified, SupportAttempt};
use super::proposals::{Preference, Proposal, proposals};
use super::rows::IntegralRows;
use crate::candidate::Candidate;
use crate::reduction::zero_of;
use crate::tolerance::{GIVEN_VALUE, MEANT_VALUE};
use mceip_check::certificate::Claim;
use mceip_check::{AcceptedClaim, ClaimChecker};
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
        let proposals = proposals(self.pencil, &self.rows, window, &candidate, self.preference);
        let certified = proposals.and_then(|found| self.first_accepted(found, &candidate));
        certified.map_err(|reason| {
            if self.problem.is_reflected() {
                reason.reflected()
            } else {
                reason
            }
        })
    }

    /// The first accepted proposal that is taken for the one meant ([`is_meant`]), else the
    /// accepted one of the nearest value: a component that looks like rounding may part two
    /// solutions, so the first accepted one need not be it.
    fn first_accepted(
        &self,
        proposals: impl Iterator<Item = Proposal>,
        candidate: &Candidate,
    ) -> Result<(Claim, AcceptedClaim), NotCertified> {
        let every_component = self.positive(candidate);
        let mut attempts = Vec::new();
        let mut nearest: Option<(f64, (Claim, AcceptedClaim))> = None;
        for Proposal { support, claim } in proposals {
            let accepted = match claim.and_then(|claim| self.examined(claim)) {
                Ok(accepted) => accepted,
                Err(failure) => {
                    attempts.push(SupportAttempt { support, failure });
                    continue;
                }
            };

            let distance = distance_of_values(&accepted.1, candidate.value);
            if is_meant(distance, support == every_component) {
                return Ok(accepted);
            }
            if nearest.as_ref().is_none_or(|(least, _)| distance < *least) {
                nearest = Some((distance, accepted));
            }
        }

        match nearest {
            Some((_, accepted)) => Ok(accepted),
            None => Err(NotCertified { attempts }),
        }
    }

    /// The slip variables whose component of the candidate is positive, however small.
    fn positive(&self, candidate: &Candidate) -> Vec<usize> {
        let mut positive = self.pencil.slip();
        positive.retain(|&i| candidate.x[i] > 0.0);

        positive
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

/// Is an accepted claim at this distance of values taken for the one that the candidate means?
///
/// Where the support has every positive component of the candidate, a near value is enough. Where
/// small components were left out, another solution may have them, and its value may be as near as
/// they are small: only the value as given is enough.
fn is_meant(distance: f64, has_every_component: bool) -> bool {
    let limit = if has_every_component {
        MEANT_VALUE
    } else {
        GIVEN_VALUE
    };

    distance <= limit
}

/// Distance of the value of an accepted claim from a value, relative to it; infinite at 0, unless
/// they are equal.
#[allow(
    clippy::float_arithmetic,
    reason = "which claim is meant, not whether it holds"
)]
fn distance_of_values(accepted: &AcceptedClaim, value: f64) -> f64 {
    let difference = (to_f64(&accepted.value.mid()) - value).abs();
    if difference == 0.0 {
        return 0.0;
    }

    difference / value.abs()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::propose;
    use mceip_check::certificate::ExactSolution;
    use mceip_exact::{Sparse, parse, whole};
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
        propose(pencil(problem), problem.window(), &candidate()).unwrap()
    }

    /// The first solution, to six digits.
    fn candidate() -> Candidate {
        Candidate {
            value: 2.0,
            x: vec![0.666667, 0.333333],
        }
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

    /// Whatever is proposed, only what the checker accepts comes out.
    #[test]
    fn a_forged_proposal_is_no_certified_solution() {
        let problem = problem();
        let certifier = Certifier::new(&problem, pencil(&problem));

        let candidate = candidate();
        let alone = certifier.first_accepted([proposal(forged(&problem))].into_iter(), &candidate);

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
        let (accepted, _) = certifier
            .first_accepted(both.into_iter(), &candidate)
            .unwrap();
        assert_eq!(accepted, good(&problem));
    }

    /// [[-2.5, 0], [1, -2.5 - d]] + t I has at t = 2.5 also the solution x = (d, 1), and at
    /// t = 2.5 + d the solution x = (0, 1): values and vectors are d apart, and the component d
    /// looks like rounding.
    #[test]
    fn of_two_solutions_as_near_as_rounding_the_one_that_is_meant_is_certified() {
        for (d, diagonal) in [(1e-9, "-2.500000001"), (1e-12, "-2.500000000001")] {
            let number = |text| parse(text).unwrap();
            let entries = [
                (0, 0, number("-2.5")),
                (1, 0, number("1")),
                (1, 1, number(diagonal)),
            ];
            let a = Sparse::from_entries(2, 2, entries);
            let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
            let body = Body::Pencil(pencil.clone());
            let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
            let certifier = Certifier::new(&problem, &pencil);

            for (value, x, expected) in [
                (2.5, vec![d, 1.0], vec![0, 1]),
                (2.5 + d, vec![0.0, 1.0], vec![1]),
                (2.5, vec![1.0, 0.0], vec![0]),
            ] {
                let candidate = Candidate { value, x };
                let (_, accepted) = certifier.certify_with_verdict(&candidate).unwrap();
                assert_eq!(accepted.support, expected, "{candidate:?}");
            }
        }
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
