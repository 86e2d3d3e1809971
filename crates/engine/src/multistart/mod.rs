//! Many starts, each certified: embed, solve, certify, list once. What section 4 does with PATH.
//!
//! ```text
//! pencil -> MCP on one side of an origin -> runs from starts, curves -> candidates -> certify
//! ```
//!
//! `hunt` is the search on one side, `curves` follows curves of the normal map, `ground` has the
//! MCPs on which both happen, `found` and `same` list each solution once, and `search` has the
//! options. `condensed` is a search of its own for MCEIP-lambda2 at finite-element size, and
//! `all_slip` needs no starts: it takes the positive eigenvectors of a condensed pencil. The method
//! is chapter 3 of the book (`spec/solver.md`).
//!
//! A search claims only what the checker has accepted; it never says that nothing else exists.

mod all_slip;
mod condensed;
mod curves;
mod doubles;
mod error;
mod found;
mod ground;
mod hunt;
mod same;
mod search;
mod trace;

pub use all_slip::{AllSlip, all_slip};
pub use condensed::{CondensedFound, CondensedSearch, CondensedSolution, search_condensed};
pub(crate) use doubles::decimal_order;
pub use error::SearchError;
pub use found::{Certified, Found, Origin, Uncertified};
pub use same::{exact_value, integer_x, same, support};
pub(crate) use search::require_starts;
pub use search::{Certifier, MAX_STARTS, Search};
pub use trace::trace_outcome;

use crate::certify;
use crate::reduction::{Expansion, Reduced, Side, condense};
use crate::run::Watch;
use crate::tolerance::WINDOW_GAP;
use doubles::require_doubles;
use hunt::{Hunt, WINDOW_SALT};
use mceip_exact::to_f64;
use mceip_mcp::solver::SolverError;
use mceip_model::{Admissible, Pencil, Problem, Unknown, Window};

/// Free variables from which MCEIP-mu is searched on its exactly condensed pencil.
pub const CONDENSE_FROM: usize = 12;

/// Largest number of variables of a search: two dense matrices in doubles, 576 MB, and their
/// factors.
const MAX_DENSE_ORDER: usize = 6000;

/// Searches for solutions in the problem's window: plain starts, then above and below each value
/// found. `admissible` is the problem's reduced pencil.
///
/// # Errors
/// [`SolverError`] for options out of range.
pub fn multistart(
    problem: &Problem,
    admissible: &Admissible<'_>,
    search: &Search,
) -> Result<Found, SolverError> {
    let certifier =
        certify::Certifier::new(problem, admissible.pencil()).with_preference(search.preference);
    multistart_with(
        admissible,
        problem.window(),
        search,
        &|candidate| certifier.certify(candidate),
        &Watch::nobody(),
    )
}

/// [`multistart`] for pencils of any size: MCEIP-mu with many free variables is condensed exactly,
/// searched on its slip variables, and *certified on the given pencil*, not on the condensed one.
/// The condensed pencil is returned too, where there was one.
///
/// # Errors
/// [`SearchError`].
pub fn multistart_large(
    problem: &Problem,
    admissible: &Admissible<'_>,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<(Found, Option<Pencil>), SearchError> {
    let pencil = admissible.pencil();
    if admissible.unknown() == Unknown::Mu && pencil.free().len() >= CONDENSE_FROM {
        let (found, condensed) = multistart_on_slip_variables(problem, admissible, search, watch)?;
        return Ok((found, Some(condensed)));
    }

    require_dense_order(pencil)?;
    require_doubles(admissible, &[], problem.window())?;
    let certifier = certify::Certifier::new(problem, pencil).with_preference(search.preference);
    let found = multistart_with(
        admissible,
        problem.window(),
        search,
        &|candidate| certifier.certify(candidate),
        watch,
    )?;
    Ok((found, None))
}

/// Searches MCEIP-mu on its exactly condensed pencil, which is returned too. Candidates are
/// expanded by the free variables and certified on the given pencil.
fn multistart_on_slip_variables(
    problem: &Problem,
    admissible: &Admissible<'_>,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<(Found, Pencil), SearchError> {
    let pencil = admissible.pencil();
    let certifier = certify::Certifier::new(problem, pencil).with_preference(search.preference);
    let condensed = condense(admissible)?;
    let expansion = Expansion::new(pencil).ok_or(SearchError::SingularInDoubles)?;
    require_dense_order(&condensed)?;

    let small = Admissible::new(&condensed, Unknown::Mu)?;
    require_doubles(&small, &[], problem.window())?;
    let found = multistart_with(
        &small,
        problem.window(),
        search,
        &|candidate| certifier.certify(&expansion.expand(candidate)),
        watch,
    )?;
    Ok((found, condensed))
}

/// Demands that dense matrices of the pencil's order may be formed.
fn require_dense_order(pencil: &Pencil) -> Result<(), SearchError> {
    let got = pencil.order();
    if got > MAX_DENSE_ORDER {
        Err(SearchError::TooLarge {
            limit: MAX_DENSE_ORDER,
            got,
        })
    } else {
        Ok(())
    }
}

/// [`multistart`] with a certifier of one's own.
///
/// # Errors
/// As [`multistart`].
pub fn multistart_with(
    admissible: &Admissible<'_>,
    window: &Window,
    search: &Search,
    certifier: &Certifier<'_>,
    watch: &Watch<'_>,
) -> Result<Found, SolverError> {
    let mut found = Found::default();
    let hunt = Hunt {
        admissible,
        zero: &[],
        window,
        search,
        certifier,
        watch: *watch,
        found: &mut found,
    };

    search_with(hunt)?;
    Ok(found)
}

/// [`multistart_large`], also for systems with particles in contact with zero reaction: `reduced`
/// is that of [`reduce_with_zero`](crate::reduction::reduce_with_zero), `admissible` its pencil.
///
/// # Errors
/// [`SearchError`].
pub fn multistart_with_zero(
    problem: &Problem,
    reduced: &Reduced,
    admissible: &Admissible<'_>,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<Found, SearchError> {
    let zero = reduced.zero_variables();
    if zero.is_empty() {
        let (found, _) = multistart_large(problem, admissible, search, watch)?;
        return Ok(found);
    }

    require_dense_order(&reduced.pencil)?;
    require_doubles(admissible, &zero, problem.window())?;
    let certifier =
        certify::Certifier::new(problem, &reduced.pencil).with_preference(search.preference);
    let mut found = Found::default();
    let hunt = Hunt {
        admissible,
        zero: &zero,
        window: problem.window(),
        search,
        certifier: &|candidate| certifier.certify(candidate),
        watch: *watch,
        found: &mut found,
    };

    search_with(hunt)?;
    Ok(found)
}

/// Searches the window, then above and below each value found, and sorts what was found.
fn search_with(mut hunt: Hunt<'_>) -> Result<(), SolverError> {
    let search = hunt.search;
    let order = hunt.admissible.pencil().order();
    require_starts(search.starts.max(search.window_starts), order)?;

    let mut origins = vec![to_f64(hunt.window.min())];
    origins.extend(&search.origins);
    for (k, origin) in origins.into_iter().enumerate() {
        hunt.side(Side::Above(origin), search.starts, k as u64)?;
    }

    if search.window_starts > 0 {
        hunt_around_values(&mut hunt)?;
    }

    let certified = &mut hunt.found.certified;
    certified.sort_by(|a, b| {
        let by_value = a.candidate.value.total_cmp(&b.candidate.value);
        by_value.then_with(|| support(&a.claim).cmp(support(&b.claim)))
    });
    Ok(())
}

/// Searches above and below the value of each solution found, also of those found on the way.
fn hunt_around_values(hunt: &mut Hunt<'_>) -> Result<(), SolverError> {
    let starts = hunt.search.window_starts;
    let mut treated = 0;
    while treated < hunt.found.certified.len().min(hunt.search.window_limit) {
        let value = hunt.found.certified[treated].candidate.value;
        // Strictly on either side: at the value itself the solution found would be found again.
        let gap = WINDOW_GAP * (1.0 + value.abs());
        let salt = WINDOW_SALT + 2 * treated as u64;

        hunt.side(Side::Above(value + gap), starts, salt)?;
        hunt.side(Side::Below(value - gap), starts, salt + 1)?;
        treated += 1;
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candidate::Candidate;
    use crate::certify::{Attempt, AttemptFailure, NotCertified, propose, sift};
    use mceip_check::Reason;
    use mceip_check::certificate::Claim;
    use mceip_exact::{Sparse, whole};
    use mceip_model::Body;
    use mceip_model::file::Number;

    /// [[1, -6], [2, -6]] + t I: lambda^2 = 2 with x = (2, 1) and 3 with (3, 2).
    fn fold() -> Pencil {
        let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
        Pencil::new(a, Sparse::identity(2), vec![]).unwrap()
    }

    fn problem_of(pencil: &Pencil) -> Problem {
        let body = Body::Pencil(pencil.clone());
        Problem::new(body, Unknown::Lambda2, Window::all()).unwrap()
    }

    fn identity(order: usize) -> Pencil {
        Pencil::new(Sparse::identity(order), Sparse::identity(order), vec![]).unwrap()
    }

    fn refusal(reason: Reason) -> NotCertified {
        let failure = AttemptFailure::Refused {
            reason: Box::new(reason),
        };
        NotCertified {
            attempts: vec![Attempt {
                support: vec![0, 1],
                failure,
            }],
        }
    }

    /// A claim about a candidate, with a wrong x if the value is above 5/2.
    fn wrong_above(pencil: &Pencil, candidate: &Candidate) -> Result<Claim, NotCertified> {
        let Claim::ExactSolution(mut claim) = propose(pencil, &Window::all(), candidate)? else {
            panic!("an exact claim")
        };
        if candidate.value > 2.5 {
            let one = vec![Number(whole(1))];
            claim.x = vec![one.clone(), one];
        }

        Ok(Claim::ExactSolution(claim))
    }

    /// The claim, if the checker accepts it.
    fn checked(problem: &Problem, claim: Claim) -> Result<Claim, NotCertified> {
        let mut sifted = sift(problem, vec![claim]);
        if let Some(accepted) = sifted.accepted.pop() {
            return Ok(accepted);
        }

        let (_, reason) = sifted.refused.remove(0);
        Err(refusal(reason))
    }

    #[test]
    fn a_search_has_a_largest_order() {
        assert!(require_dense_order(&identity(6000)).is_ok());

        let refused = require_dense_order(&identity(6001));
        assert!(matches!(
            refused,
            Err(SearchError::TooLarge {
                limit: 6000,
                got: 6001
            })
        ));
    }

    /// A certifier that makes a wrong claim of everything above 5/2: with the checker behind it
    /// such points stay uncertified.
    #[test]
    fn what_the_checker_refuses_is_uncertified() {
        let pencil = fold();
        let problem = problem_of(&pencil);
        let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();
        let search = Search::default();

        let found = multistart_with(
            &admissible,
            problem.window(),
            &search,
            &|candidate| checked(&problem, wrong_above(&pencil, candidate)?),
            &Watch::nobody(),
        )
        .unwrap();

        assert_eq!(found.certified.len(), 1);
        assert!((found.certified[0].candidate.value - 2.0).abs() < 1e-6);
        assert_eq!(found.uncertified.len(), 1);
        let refused = &found.uncertified[0];
        assert!((refused.candidate.value - 3.0).abs() < 1e-6);
        let failure = &refused.reason.attempts[0].failure;
        assert!(
            matches!(failure, AttemptFailure::Refused { .. }),
            "{}",
            refused.reason
        );

        let all = multistart(&problem, &admissible, &search).unwrap();
        assert_eq!((all.certified.len(), all.uncertified.len()), (2, 0));
    }
}
