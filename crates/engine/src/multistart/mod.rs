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
pub use error::SearchError;
pub use found::{CertifiedCandidate, MultistartFound, Origin, Uncertified};
pub(crate) use same::claimed_root;
pub use same::{exact_value, integer_x, is_about, same, same_x, support};
pub(crate) use search::require_starts;
pub use search::{MAX_STARTS, Search};
pub use trace::trace_outcome;

use crate::certify;
use crate::reduction::{FreeExpansion, Side, condense};
use crate::run::Watch;
use crate::tolerance::WINDOW_GAP;
use doubles::require_doubles;
use hunt::{Hunt, WINDOW_SALT};
use mceip_exact::to_f64;
use mceip_mcp::solver::SolverError;
use mceip_model::{Admissible, Pencil, Problem, Reduced, Unknown};

/// Free variables from which MCEIP-mu is searched on its exactly condensed pencil.
pub const CONDENSE_FROM: usize = 12;

/// Largest number of variables of a search: two dense matrices in doubles, 576 MB, and their
/// factors.
const MAX_DENSE_ORDER: usize = 6000;

/// Searches for solutions in the problem's window: plain starts, then above and below each value
/// found. `reduced` is the problem's.
///
/// MCEIP-mu with many free variables is condensed exactly, searched on its slip variables, and
/// *certified on the given pencil*, not on the condensed one.
///
/// # Errors
/// [`SearchError`]; among them hypotheses of the propositions that fail.
pub fn multistart(
    problem: &Problem,
    reduced: &Reduced,
    search: &Search,
    watch: &Watch<'_>,
) -> Result<MultistartFound, SearchError> {
    let pencil = &reduced.pencil;
    let admissible = Admissible::new(pencil, problem.unknown())?;
    let certifier = certify::Certifier::new(problem, pencil).with_preference(search.preference);

    let has_many_free = pencil.free().len() >= CONDENSE_FROM;
    if reduced.zero.is_empty() && problem.unknown() == Unknown::Mu && has_many_free {
        let condensed = condense(&admissible)?;
        let expansion = FreeExpansion::new(pencil).ok_or(SearchError::SingularInDoubles)?;
        return search_with(Hunt {
            admissible: &Admissible::new(&condensed, Unknown::Mu)?,
            zero: &[],
            window: problem.window(),
            search,
            certifier: &|candidate| certifier.certify(&expansion.expand(candidate)),
            watch: *watch,
            found: MultistartFound::default(),
        });
    }

    search_with(Hunt {
        admissible: &admissible,
        zero: &reduced.zero,
        window: problem.window(),
        search,
        certifier: &|candidate| certifier.certify(candidate),
        watch: *watch,
        found: MultistartFound::default(),
    })
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

/// Searches the window, then above and below each value found, and sorts what was found.
fn search_with(mut hunt: Hunt<'_>) -> Result<MultistartFound, SearchError> {
    let search = hunt.search;
    let pencil = hunt.admissible.pencil();
    require_dense_order(pencil)?;
    require_doubles(hunt.admissible, hunt.zero, hunt.window)?;
    require_starts(search.starts.max(search.window_starts), pencil.order())?;

    let mut origins = vec![to_f64(hunt.window.min())];
    origins.extend(&search.origins);
    for (k, origin) in origins.into_iter().enumerate() {
        hunt.side(Side::Above(origin), search.starts, k as u64)?;
    }

    if search.window_starts > 0 {
        hunt_around_values(&mut hunt)?;
    }

    let mut found = hunt.found;
    found.certified.sort_by(|a, b| {
        let by_value = a.candidate.value.total_cmp(&b.candidate.value);
        by_value.then_with(|| support(&a.claim).cmp(support(&b.claim)))
    });
    Ok(found)
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
    use crate::certify::{AttemptFailure, NotCertified, SupportAttempt, propose};
    use mceip_check::certificate::Claim;
    use mceip_check::{ClaimChecker, Reason};
    use mceip_exact::{Sparse, whole};
    use mceip_model::file::Number;
    use mceip_model::reduction::reduce;
    use mceip_model::{Body, Window};

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
            attempts: vec![SupportAttempt {
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
        let verdict = ClaimChecker::new(problem).verdict(problem.window(), &claim);
        verdict.map(|_| claim).map_err(refusal)
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

    /// Columns 1 and 2 of A + tB are opposite, so x = (0, 1, 1) solves for every t >= 0. Each value
    /// is a new solution, around which more would be looked for, without end.
    #[test]
    fn a_search_on_a_continuum_ends_and_lists_examples() {
        let a = Sparse::from_ints(&[&[-1, 1, -1], &[-1, 1, -1], &[-2, 1, -1]]);
        let b = Sparse::from_ints(&[&[-2, 1, -1], &[2, 0, 0], &[-1, 0, 0]]);
        let pencil = Pencil::new(a, b, vec![]).unwrap();
        let search = Search {
            starts: 8,
            ..Search::default()
        };

        let problem = problem_of(&pencil);
        let reduced = reduce(&problem).unwrap();
        let found = multistart(&problem, &reduced, &search, &Watch::nobody()).unwrap();

        // A determinant of order 2 that vanishes at three values vanishes at all.
        assert_eq!(found.certified.len(), 3);
        assert_eq!(found.singular_supports(0), [[1, 2]]);
        assert!(found.on_continua > 10, "{}", found.on_continua);
        assert!(found.runs < 1000, "{}", found.runs);
    }

    /// A certifier that makes a wrong claim of everything above 5/2: with the checker behind it
    /// such points stay uncertified.
    #[test]
    fn what_the_checker_refuses_is_uncertified() {
        let pencil = fold();
        let problem = problem_of(&pencil);
        let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();
        let search = Search::default();

        let found = search_with(Hunt {
            admissible: &admissible,
            zero: &[],
            window: problem.window(),
            search: &search,
            certifier: &|candidate| checked(&problem, wrong_above(&pencil, candidate)?),
            watch: Watch::nobody(),
            found: MultistartFound::default(),
        })
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

        let reduced = reduce(&problem).unwrap();
        let all = multistart(&problem, &reduced, &search, &Watch::nobody()).unwrap();
        assert_eq!((all.certified.len(), all.uncertified.len()), (2, 0));
    }
}
