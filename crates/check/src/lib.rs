//! The checker: from a problem and a certificate to a verdict, in exact arithmetic.
//!
//! This crate is the only code of the project that has to be trusted. The problem is
//!
//! ```text
//!     (A + t B) x = y,    y_f = 0,    0 <= x_s _|_ y_s >= 0,    x != 0
//! ```
//!
//! (equations (12)-(14), (21)-(23)), with the unknown t (lambda^2 or mu), the free variables f and
//! the complementarity variables s. A certificate ([`certificate`]) makes two kinds of claims, and
//! each kind has its checker:
//!
//! * *There is a solution* with this support and a value t in this interval. The evidence is the
//!   solution over an algebraic number field (`exact_solution`), the same in the degrees of freedom
//!   of the body (`lifted_solution`), or a box that contains one by Krawczyk's test (`enclosed`).
//! * *There are no others* with a value in the window (`cover`). The evidence is a partition of
//!   (supports) x (window) into regions, each with a proof of what it holds.
//!
//! A file of its own kind states absence for a range of friction (`critical`): there is no solution
//! with mu in [0, `below`] and lambda^2 >= 0. Its evidence is a partition as well. Another one
//! states presence (`presence`): there is a solution for every mu in [`from`, `to`]. A third one
//! states the contact states of an equilibrium under loads (`equilibrium`); its evidence is one
//! solution of a pencil made of the loads and the states. A fourth one states that an equilibrium
//! is stable for every mu in (`from`, `to`] (`stability`); its evidence are matrices below the
//! condensed pencil at both ends.
//!
//! The checker multiplies and compares integers and fractions. It has no floating point number, it
//! solves no linear system and finds no root, and it shares no algorithm with the code that finds
//! solutions. Of a mechanical system it forms A and B itself (`pencil`).
//!
//! Of numbers without a certificate, [`backward_error`] says how far they are from a solution.
//!
//! A certificate is accepted, or rejected with the first obligation that fails. There is no third
//! verdict: a file that cannot be read is an error of [`Certificate::from_json`] and never gets
//! here. The obligations are those of `spec/certificates.md`.
#![deny(clippy::float_arithmetic)]

mod backward_error;
pub mod certificate;
mod cover;
mod critical;
mod enclosed;
mod equilibrium;
mod exact_solution;
mod lifted_solution;
mod pencil;
mod presence;
mod proved;
mod reason;
mod stability;

pub use backward_error::backward_error;
pub use cover::{AcceptedCover, CoverFault, MAX_COVERED, OpenRegion, Place, SolutionFamily};
pub use critical::{AcceptedAbsence, audit_critical, check_critical};
pub use equilibrium::{AcceptedEquilibrium, EquilibriumPencil, check_equilibrium};
pub use presence::{AcceptedPresence, check_presence};
pub use proved::{NotAccepted, Provable, Proved};
pub use reason::{Reason, Rejected, with_short_numbers};
pub use stability::{AcceptedStability, check_stability};

use crate::certificate::{Certificate, Claim, CompleteSet};
use cover::AcceptedSolution;
use cover::walk::Audit;
use exact_solution::{ClaimSize, MAX_WORK};
use mceip_exact::Interval;
use mceip_model::{Body, ContactState, Problem, Unknown, Window};
use num_traits::Signed as _;
use pencil::Rows;

/// What the exact and lifted claims of a file may cost together: without any claim, and for each.
const WORK_BASE: u64 = 1 << 43;
const WORK_PER_CLAIM: u64 = 1 << 34;

/// A leaf of a cover: the number of the piece, and of the node in its tree.
pub type LeafPlace = (usize, usize);

/// What an accepted certificate has proved, claim by claim.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Accepted {
    /// One entry per claim, in the certificate's order; those of values below 0 follow.
    pub claims: Vec<AcceptedClaim>,
    /// What the claim of a complete set has proved, if the certificate makes one; of values of both
    /// signs, if it makes two.
    pub cover: Option<AcceptedCover>,
    /// Is T(mu) a P-matrix in the whole window, so that in these contact states the rates of the
    /// quasi-static problem are the only ones, whatever load grows (`spec/certificates.md`, 5.9)?
    /// `false` where the cover does not tell.
    pub has_unique_rates: bool,
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

/// Checks a certificate as [`check`] does, but leaves open each leaf of its cover that fails.
///
/// Beside the verdict on the rest it returns those leaves. A search that wants to replace all
/// leaves that fail calls this once, where it would have to call [`check`] once for each of them.
/// No leaf of values below 0 is left open.
///
/// # Errors
/// [`Rejected`] with an obligation that fails although these leaves are open.
pub fn audit(
    problem: &Problem,
    certificate: &Certificate,
) -> Result<(Accepted, Vec<LeafPlace>), Rejected> {
    let audit = Audit::new(&|| true);
    let accepted = verdict(problem, certificate, Some(&audit))?;
    Ok((accepted, audit.into_refused().unwrap_or_default()))
}

/// A part of a certificate: what it says of values that are not negative, or of the others.
struct SignPart<'a> {
    window: &'a Window,
    claims: &'a [Claim],
    complete_set: Option<&'a CompleteSet>,
}

impl Certificate {
    fn non_negative(&self) -> SignPart<'_> {
        SignPart {
            window: &self.window,
            claims: &self.claims,
            complete_set: self.complete_set.as_ref(),
        }
    }

    fn negative(&self) -> Option<SignPart<'_>> {
        self.negative.as_ref().map(|negative| SignPart {
            window: &negative.window,
            claims: &negative.claims,
            complete_set: negative.complete_set.as_ref(),
        })
    }
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

    /// The verdict of [`check`] on a certificate with this window and this claim alone.
    ///
    /// # Errors
    /// The [`Reason`] why the claim is rejected.
    pub fn verdict(&self, window: &Window, claim: &Claim) -> Result<AcceptedClaim, Reason> {
        Covers::OneBody.treats(self.problem)?;
        match claim {
            Claim::ExactSolution(c) => exact_solution::check(&self.rows, window, c),
            Claim::LiftedSolution(c) => lifted_solution::check(self.problem, &self.rows, window, c),
            Claim::EnclosedSolution(c) => enclosed::check(&self.rows, window, c),
        }
    }

    /// The checker of claims about the reflected problem.
    fn reflected(&self) -> ClaimChecker<'a> {
        ClaimChecker {
            problem: self.problem,
            rows: self.rows.reflected(self.problem),
        }
    }

    /// Checks a part of a certificate: its claims, its complete set, and that they agree.
    fn part(
        &self,
        part: &SignPart<'_>,
        audit: Option<&Audit<'_>>,
    ) -> Result<(Vec<AcceptedClaim>, Option<AcceptedCover>), Rejected> {
        // The solutions come first, because a cover may refer to them.
        let solutions = self.solutions(part)?;
        let cover = match part.complete_set {
            Some(set) => Some(cover::check(
                &self.rows,
                part.window,
                &solutions,
                set,
                audit,
            )?),
            None => None,
        };

        let claims: Vec<AcceptedClaim> = solutions.into_iter().map(|s| s.claim).collect();
        if let Some(cover) = &cover {
            beside_the_cover(&claims, cover)?;
        }

        Ok((claims, cover))
    }

    /// Checks all claims of a part of a certificate, in its order.
    fn solutions<'c>(&self, part: &SignPart<'c>) -> Result<Vec<AcceptedSolution<'c>>, Rejected> {
        let mut solutions = Vec::new();
        let allowed = allowed_work(part.claims.len());
        let mut work: u64 = 0;

        for (index, claim) in part.claims.iter().enumerate() {
            work = work.saturating_add(work_of(claim));
            let what = "work of the claims up to here (spec/certificates.md, Limits)";
            Reason::at_most(what, allowed, work).map_err(|reason| of_claim(index, reason))?;

            let accepted = self
                .verdict(part.window, claim)
                .map_err(|reason| of_claim(index, reason))?;

            solutions.push(AcceptedSolution {
                claim: accepted,
                biactive: biactive_set(claim),
            });
        }

        Ok(solutions)
    }
}

/// What the exact and lifted claims of a file with so many claims may cost together.
fn allowed_work(claims: usize) -> u64 {
    WORK_BASE.saturating_add(WORK_PER_CLAIM.saturating_mul(claims as u64))
}

/// What Horner's rule for the polynomials of a claim costs at most. An enclosed claim has none.
///
/// A claim beyond [`MAX_WORK`] counts as that: it is rejected by itself, before any work.
fn work_of(claim: &Claim) -> u64 {
    let size = match claim {
        Claim::ExactSolution(c) => ClaimSize::of(&c.polynomial, &c.interval, &c.x),
        Claim::LiftedSolution(c) => {
            ClaimSize::of(&c.polynomial, &c.interval, c.v.iter().chain(&c.w))
        }
        Claim::EnclosedSolution(_) => return 0,
    };
    size.work().min(MAX_WORK)
}

/// The verdict of [`check`], or with an audit that of [`audit`].
fn verdict(
    problem: &Problem,
    certificate: &Certificate,
    audit: Option<&Audit<'_>>,
) -> Result<Accepted, Rejected> {
    check_frame(problem, certificate)?;

    let checker = ClaimChecker::new(problem);
    let (claims, cover) = checker.part(&certificate.non_negative(), audit)?;
    let accepted = Accepted {
        has_unique_rates: has_unique_rates(problem, certificate, cover.as_ref()),
        claims,
        cover,
    };

    let Some(negative) = certificate.negative() else {
        return Ok(accepted);
    };
    let of_negative = checker.reflected().part(&negative, None);
    let (claims, cover) = of_negative.map_err(|rejected| Rejected {
        is_negative: true,
        ..rejected
    })?;
    Ok(accepted.with_negative(claims, cover))
}

impl Accepted {
    /// Together with claims and a cover of the reflected pencil.
    pub(crate) fn with_negative(
        mut self,
        claims: Vec<AcceptedClaim>,
        cover: Option<AcceptedCover>,
    ) -> Accepted {
        let claims = claims.into_iter().map(AcceptedClaim::reflected);
        self.claims.extend(claims);
        self.cover = cover::joined(cover.map(AcceptedCover::reflected), self.cover);
        self
    }
}

/// Does an accepted cover say that T(mu) of the contact states of a body is a P-matrix?
fn has_unique_rates(
    problem: &Problem,
    certificate: &Certificate,
    cover: Option<&AcceptedCover>,
) -> bool {
    let (Some(set), Some(cover), Body::System(system)) =
        (&certificate.complete_set, cover, problem.body())
    else {
        return false;
    };

    // A candidate without reaction has rates that T(mu) does not know.
    let has_zero = system
        .particles()
        .iter()
        .any(|p| p.state == ContactState::Zero);
    // Without friction a slip particle may slide both ways.
    let has_friction = certificate.window.min().is_positive();
    problem.unknown() == Unknown::Mu
        && has_friction
        && !has_zero
        // An audit may have opened the leaf that says so.
        && cover.proves_absence()
        && set.is_positive_definite()
}

/// Demands that the certificate belongs to this problem and claims something.
fn check_frame(problem: &Problem, certificate: &Certificate) -> Result<(), Reason> {
    of_problem(problem, &certificate.problem_sha256, Covers::OneBody)?;
    if certificate.unknown != problem.unknown() {
        return Err(Reason::Unknown {
            expected: problem.unknown().word(),
            got: certificate.unknown.word(),
        });
    }

    // Its claims are not those of a body: the rows of the reflected pencil are what is checked.
    if certificate.negative.is_some() && problem.unknown() != Unknown::Eigenvalue {
        return Err(Reason::Unknown {
            expected: Unknown::Eigenvalue.word(),
            got: problem.unknown().word(),
        });
    }

    let parts = [Some(certificate.non_negative()), certificate.negative()];
    let mut parts = parts.into_iter().flatten();
    if parts.all(|part| part.claims.is_empty() && part.complete_set.is_none()) {
        return Err(Reason::NoClaims);
    }

    Ok(())
}

/// What the proof of a kind of certificate covers.
///
/// Soundness hangs on it: the proofs of one body read the data as given and know no radii.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Covers {
    OneBody,
    EveryMember,
}

impl Covers {
    /// Refuses a problem with radii for a proof of one body.
    fn treats(self, problem: &Problem) -> Result<(), Reason> {
        if self == Covers::EveryMember || problem.is_exact() {
            Ok(())
        } else {
            Err(Reason::Radii)
        }
    }
}

/// Demands that a certificate names the digest of this problem, and that its kind treats it.
pub(crate) fn of_problem(problem: &Problem, named: &str, covers: Covers) -> Result<(), Reason> {
    let digest = problem.sha256();
    if named == digest {
        return covers.treats(problem);
    }

    Err(Reason::Digest {
        expected: digest,
        got: named.into(),
    })
}

/// The variables of which a claim says that x_i = y_i = 0, for a cover. An enclosed solution has
/// none, because its signs are strict. (A row that vanishes with the support belongs to a half of
/// v_T whose other half moves; a cover never asks whether it could move as well.)
fn biactive_set(claim: &Claim) -> &[usize] {
    match claim {
        Claim::ExactSolution(c) => &c.biactive,
        Claim::LiftedSolution(c) => &c.biactive,
        Claim::EnclosedSolution(_) => &[],
    }
}

/// The rejection of the claim with this number.
fn of_claim(index: usize, reason: Reason) -> Rejected {
    Rejected {
        is_negative: false,
        claim: Some(index),
        reason,
    }
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
            return Err(of_claim(index, reason));
        }
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn claim(support: usize, value: i64) -> AcceptedClaim {
        AcceptedClaim {
            support: vec![support],
            value: Interval::point(whole(value)),
        }
    }

    /// Are the rates said to be unique, by this tree over [min, max], where T(mu) = 1 - 3 mu?
    fn is_said_unique(unknown: &str, [min, max]: [&str; 2], tree: &str) -> bool {
        let file = format!(
            r#"{{"format": "mceip-problem/1", "unknown": "{unknown}",
                "system": {{"stiffness": [[1, -3], [-3, 10]], "mass": [[1, 0], [0, 1]],
                           "friction": "1/4",
                           "particles": [{{"tangential": 0, "normal": 1, "state": "slip",
                                          "sign": 1}}]}}}}"#
        );
        let problem = mceip_model::file::read_problem(&file, std::path::Path::new(".")).unwrap();
        let certificate = format!(
            r#"{{"format": "mceip-certificate/1", "problem_sha256": "{}", "unknown": "{unknown}",
                "window": {{"min": "{min}", "max": "{max}"}}, "claims": [],
                "complete_set": {{"pieces": [{{"max": "{max}", "tree": [{tree}]}}]}}}}"#,
            problem.sha256()
        );
        let certificate = Certificate::from_json(&certificate).unwrap();
        check(&problem, &certificate).unwrap().has_unique_rates
    }

    /// Only what a positive definite T(mu) says, at mu > 0, of particles with a reaction.
    #[test]
    fn rates_are_unique_where_one_leaf_says_that_the_pencil_is_definite() {
        let definite = r#""positive_definite""#;
        let ldl = |d: &str| {
            let factor = format!(r#"{{"rows": [[]], "diagonal": ["{d}"]}}"#);
            format!(r#"{{"ldl": {{"lower": {factor}, "upper": {factor}}}}}"#)
        };
        let quarter = ["1/4", "1/4"];

        assert!(is_said_unique("mu", quarter, definite));
        assert!(is_said_unique("mu", quarter, &ldl("1/4")));

        assert!(!is_said_unique("mu", ["1", "1"], &ldl("-2")));
        assert!(!is_said_unique("mu", ["1", "1"], r#""negative_definite""#));
        assert!(!is_said_unique("mu", ["0", "1/4"], definite));
        assert!(!is_said_unique("lambda2", quarter, definite));
        let open = r#"{"branch": 0}, "positive_definite", "open""#;
        assert!(!is_said_unique("mu", quarter, open));
    }

    /// A file says `negative` of eigenvalues only, and so does a certificate that is put together.
    #[test]
    fn values_below_zero_are_those_of_an_eigenvalue() {
        for (unknown, is_accepted) in [("eigenvalue", true), ("lambda2", false), ("mu", false)] {
            let problem = format!(
                r#"{{"format": "mceip-problem/1", "unknown": "{unknown}",
                    "pencil": {{"a": [[1]], "b": [[1]]}}}}"#
            );
            let problem = mceip_model::file::read_problem(&problem, std::path::Path::new("."));
            let problem = problem.unwrap();
            let set = r#"{"pieces": [{"max": null, "tree": ["positive_definite"]}]}"#;
            let half = Certificate {
                problem_sha256: problem.sha256(),
                unknown: problem.unknown(),
                window: Window::all(),
                claims: vec![],
                complete_set: serde_json::from_str(set).unwrap(),
                negative: None,
            };
            assert!(check(&problem, &half).is_ok());

            let nothing_below = Certificate {
                complete_set: None,
                ..half.clone()
            };
            let verdict = check(&problem, &half.with_negative(nothing_below));
            assert_eq!(verdict.is_ok(), is_accepted, "{unknown}: {verdict:?}");
        }
    }

    /// No file reaches this rejection as long as the checker accepts true claims and true covers
    /// alone. The cover that leaves out a solution is therefore made here.
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

        let other_value = beside_the_cover(&[claim(0, 2), claim(0, 3)], &cover).unwrap_err();
        let not_in_cover = Reason::NotInCover {
            support: vec![0],
            a: whole(3),
            b: whole(3),
        };
        assert_eq!(other_value.claim, Some(1));
        assert_eq!(other_value.reason, not_in_cover);
        assert_eq!(other_value.reason.name(), "NotInCover");

        let other_support = beside_the_cover(&[claim(1, 2)], &cover).unwrap_err();
        let message = "claim 0: complete set: expected support [1] with a value in [2, 2]";
        assert!(other_support.to_string().starts_with(message));
    }
}
