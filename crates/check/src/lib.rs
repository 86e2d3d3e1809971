//! The checker: problem and certificate to a verdict. The only code that has to be trusted.
//!
//! It multiplies and compares exact numbers, nothing else: no floats, no linear solver, no root
//! finder, nothing shared with the rooms that find solutions. For a mechanical system it forms
//! the pencil (10)-(16) by its own short route (`pencil.rs`).
//!
//! Two verdicts: `Ok(Accepted)` or `Err(Rejected)`. A file that cannot be read never gets here.
#![deny(clippy::float_arithmetic)]

pub mod certificate;
mod cover;
mod enclosed;
mod exact_solution;
mod lifted_solution;
mod pencil;
mod reason;

pub use cover::{AcceptedCover, CoverFault, MAX_COVERED, OpenRegion, Place, SolutionFamily};
pub use reason::{Reason, Rejected};

use crate::certificate::{Certificate, Claim};
use cover::AcceptedSolution;
use mceip_exact::Interval;
use mceip_model::{Problem, Window};
use pencil::Rows;

/// What an accepted certificate has proved, claim by claim.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Accepted {
    /// One entry per claim, in the certificate's order.
    pub claims: Vec<AcceptedClaim>,
    /// What the claim of a complete set has proved, if the certificate makes one.
    pub cover: Option<AcceptedCover>,
}

/// A proved claim: the problem has a solution with this support and a value in this interval.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedClaim {
    /// Complementarity variables with x_i > 0.
    pub support: Vec<usize>,
    /// Encloses the value of the unknown.
    pub value: Interval,
}

/// Checks every claim of a certificate against a problem, exactly.
///
/// # Errors
/// [`Rejected`] with the claim and the first obligation that fails: equation, index, expected, got.
pub fn check(problem: &Problem, certificate: &Certificate) -> Result<Accepted, Rejected> {
    verdict(problem, certificate, None)
}

/// [`check`] of the certificate with the leaves of its cover that fail made open, and which these
/// are (piece and node): for a search, which need not check the rest again for each of them.
///
/// # Errors
/// [`Rejected`] for whatever making leaves open does not mend.
pub fn audit(
    problem: &Problem,
    certificate: &Certificate,
) -> Result<(Accepted, Vec<(usize, usize)>), Rejected> {
    let mut refused = Vec::new();
    let accepted = verdict(problem, certificate, Some(&mut refused))?;
    Ok((accepted, refused))
}

/// Checks claims about one problem one by one: its rows are formed once.
pub struct ClaimChecker<'a> {
    problem: &'a Problem,
    rows: Rows,
}

impl<'a> ClaimChecker<'a> {
    /// The checker of claims about this problem.
    pub fn new(problem: &'a Problem) -> ClaimChecker<'a> {
        ClaimChecker {
            problem,
            rows: Rows::of(problem),
        }
    }

    /// The verdict of [`check`] on this claim in a certificate with this window.
    ///
    /// # Errors
    /// The [`Reason`] why the claim is rejected.
    pub fn verdict(&self, window: &Window, claim: &Claim) -> Result<AcceptedClaim, Reason> {
        match claim {
            Claim::ExactSolution(c) => exact_solution::check(&self.rows, window, c),
            Claim::LiftedSolution(c) => lifted_solution::check(self.problem, &self.rows, window, c),
            Claim::EnclosedSolution(c) => enclosed::check(&self.rows, window, c),
        }
    }
}

fn verdict(
    problem: &Problem,
    certificate: &Certificate,
    refused: Option<&mut Vec<(usize, usize)>>,
) -> Result<Accepted, Rejected> {
    let whole = |reason| Rejected {
        claim: None,
        reason,
    };
    let digest = problem.sha256();
    if certificate.problem_sha256 != digest {
        return Err(whole(Reason::Digest {
            expected: digest,
            got: certificate.problem_sha256.clone(),
        }));
    }
    if certificate.unknown != problem.unknown() {
        return Err(whole(Reason::Unknown {
            expected: problem.unknown().word(),
            got: certificate.unknown.word(),
        }));
    }
    if certificate.claims.is_empty() && certificate.complete_set.is_none() {
        return Err(whole(Reason::NoClaims));
    }
    let checker = ClaimChecker::new(problem);
    // Solutions first: a complete set may refer to them.
    let mut solutions: Vec<AcceptedSolution<'_>> = Vec::new();
    for (index, claim) in certificate.claims.iter().enumerate() {
        let verdict = checker.verdict(&certificate.window, claim);
        let biactive: &[usize] = match claim {
            Claim::ExactSolution(c) => &c.biactive,
            Claim::LiftedSolution(c) => &c.biactive,
            Claim::EnclosedSolution(_) => &[],
        };
        let claim = verdict.map_err(|reason| Rejected {
            claim: Some(index),
            reason,
        })?;
        solutions.push(AcceptedSolution { claim, biactive });
    }
    let cover = match &certificate.complete_set {
        Some(c) => Some(
            cover::check(&checker.rows, &certificate.window, &solutions, c, refused)
                .map_err(whole)?,
        ),
        None => None,
    };
    let claims: Vec<AcceptedClaim> = solutions.into_iter().map(|s| s.claim).collect();
    if let Some(cover) = &cover {
        beside_the_cover(&claims, cover)?;
    }
    Ok(Accepted { claims, cover })
}

/// Demands that each claim belongs to a solution, a family or an open region of the cover.
///
/// True claims and a true cover agree. The rejection therefore shows that a claim or the cover is
/// false, although each met its own obligations.
fn beside_the_cover(claims: &[AcceptedClaim], cover: &AcceptedCover) -> Result<(), Rejected> {
    for (index, claim) in claims.iter().enumerate() {
        if cover.place_of(claim).is_none() {
            let reason = Reason::NotInCover {
                support: claim.support.clone(),
                a: claim.value.lo().clone(),
                b: claim.value.hi().clone(),
            };
            return Err(Rejected {
                claim: Some(index),
                reason,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn claim(support: usize, value: i64) -> AcceptedClaim {
        let value = Interval::new(whole(value), whole(value)).unwrap();
        AcceptedClaim {
            support: vec![support],
            value,
        }
    }

    /// No file reaches this rejection as long as the checker accepts true claims and true covers
    /// alone, so the cover that leaves out a solution is made here.
    #[test]
    fn a_claim_that_the_cover_leaves_out_is_rejected() {
        let cover = AcceptedCover {
            solutions: vec![claim(0, 2)],
            families: vec![],
            open: vec![],
            leaves: 1,
        };
        assert_eq!(beside_the_cover(&[], &cover), Ok(()));
        assert_eq!(beside_the_cover(&[claim(0, 2)], &cover), Ok(()));

        let rejected = beside_the_cover(&[claim(0, 2), claim(0, 3)], &cover).unwrap_err();
        assert_eq!(rejected.claim, Some(1));
        assert_eq!(
            rejected.reason,
            Reason::NotInCover {
                support: vec![0],
                a: whole(3),
                b: whole(3)
            }
        );
        assert_eq!(rejected.reason.name(), "NotInCover");
        let other_support = beside_the_cover(&[claim(1, 2)], &cover).unwrap_err();
        assert!(
            other_support
                .to_string()
                .starts_with("claim 0: complete set: expected support [1] with a value in [2, 2]")
        );
    }
}
