//! Many starts, each certified: embed, solve, certify, list once. What section 4 does with PATH.

mod all_slip;
mod condensed;
mod curves;
mod found;
mod ground;
mod hunt;
mod same;
mod search;
mod trace;

pub use all_slip::{AllSlip, all_slip};
pub use condensed::{
    CondensedFound, CondensedSearch, CondensedSearchError, CondensedSolution, search_condensed,
};
pub use found::{Certified, Found, Origin, Uncertified};
pub use same::{exact_value, integer_x, same, support};
pub use search::{Certifier, Search};
pub use trace::trace_outcome;

use crate::candidate::Candidate;
use crate::certify;
use crate::reduction::{CondensationError, Expansion, Side, condense};
use crate::run::Watch;
use crate::tolerance::WINDOW_GAP;
use hunt::{Hunt, WINDOW_SALT};
use mceip_exact::to_f64;
use mceip_mcp::solver::SolverError;
use mceip_model::{Admissible, ModelError, Pencil, Problem, Unknown, Window};

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
    let certifier = certify::Certifier::new(problem, admissible.pencil());
    let certify = |candidate: &Candidate| certifier.certify(candidate);
    multistart_with(
        admissible,
        problem.window(),
        search,
        &certify,
        &Watch::nobody(),
    )
}

/// Free variables from which MCEIP-mu is searched on its exactly condensed pencil.
pub const CONDENSE_FROM: usize = 12;

/// Why a search did not take place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The solver's options were refused.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The condensation failed.
    #[error(transparent)]
    Condensation(#[from] CondensationError),
    /// The condensed pencil was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// More variables than dense matrices are made for.
    #[error("solve: expected at most {limit} variables after condensation, got {got}")]
    TooLarge {
        /// The limit.
        limit: usize,
        /// Variables of the problem.
        got: usize,
    },
    /// K_ff is singular in doubles.
    #[error("P1: expected K_ff regular in doubles, got a singular factorisation")]
    SingularInDoubles,
}

/// [`multistart`] for pencils of any size: MCEIP-mu with many free variables is condensed exactly,
/// searched on its slip variables, and *certified on the given pencil*, not on the condensed one.
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
    let certifier = certify::Certifier::new(problem, pencil);
    let direct = |c: &Candidate| certifier.certify(c);
    let window = problem.window();
    if admissible.unknown() != Unknown::Mu || pencil.free().len() < CONDENSE_FROM {
        require_dense_order(pencil)?;
        return Ok((
            multistart_with(admissible, window, search, &direct, watch)?,
            None,
        ));
    }
    let condensed = condense(admissible)?;
    let expansion = Expansion::new(pencil).ok_or(SearchError::SingularInDoubles)?;
    require_dense_order(&condensed)?;
    let small = Admissible::new(&condensed, Unknown::Mu)?;
    let found = multistart_with(
        &small,
        window,
        search,
        &|c| direct(&expansion.expand(c)),
        watch,
    )?;
    Ok((found, Some(condensed)))
}

/// Largest number of variables of a search: two dense matrices in doubles, 576 MB, and their
/// factors.
const MAX_DENSE_ORDER: usize = 6000;

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
    let bottom = to_f64(window.min());
    let mut hunt = Hunt {
        admissible,
        window,
        search,
        certifier,
        watch: *watch,
        found: &mut found,
    };
    for (k, origin) in [bottom]
        .into_iter()
        .chain(search.origins.iter().copied())
        .enumerate()
    {
        hunt.side(Side::Above(origin), search.starts, k as u64)?;
    }
    let mut treated = 0;
    while treated < hunt.found.certified.len().min(search.window_limit) && search.window_starts > 0
    {
        let value = hunt.found.certified[treated].candidate.value;
        // Strictly on either side: at the value itself the solution found would be found again.
        let gap = WINDOW_GAP * (1.0 + value.abs());
        hunt.side(
            Side::Above(value + gap),
            search.window_starts,
            WINDOW_SALT + 2 * treated as u64,
        )?;
        hunt.side(
            Side::Below(value - gap),
            search.window_starts,
            WINDOW_SALT + 1 + 2 * treated as u64,
        )?;
        treated += 1;
    }
    found.certified.sort_by(|a, b| {
        a.candidate
            .value
            .total_cmp(&b.candidate.value)
            .then_with(|| support(&a.claim).cmp(support(&b.claim)))
    });
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::{Attempt, AttemptFailure, NotCertified, propose, sift};
    use mceip_check::Reason;
    use mceip_check::certificate::{Claim, ExactSolution};
    use mceip_exact::{Sparse, whole};
    use mceip_model::Body;
    use mceip_model::file::Number;

    /// lambda^2 = 2 with x = (2, 1) and 3 with (3, 2).
    fn fold() -> (Problem, Pencil) {
        let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        (
            Problem::new(
                Body::Pencil(pencil.clone()),
                Unknown::Lambda2,
                Window::all(),
            )
            .unwrap(),
            pencil,
        )
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

    #[test]
    fn a_search_has_a_largest_order() {
        let identity =
            |n: usize| Pencil::new(Sparse::identity(n), Sparse::identity(n), vec![]).unwrap();

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
        let (problem, pencil) = fold();
        let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();
        let proposed = |candidate: &Candidate| {
            let Claim::ExactSolution(claim) = propose(&pencil, problem.window(), candidate)? else {
                panic!("an exact claim")
            };
            let one = || vec![Number(whole(1))];
            let x = if candidate.value > 2.5 {
                vec![one(), one()]
            } else {
                claim.x.clone()
            };
            Ok(Claim::ExactSolution(ExactSolution { x, ..claim }))
        };
        let checked = |candidate: &Candidate| {
            let mut sifted = sift(&problem, vec![proposed(candidate)?]);
            sifted
                .accepted
                .pop()
                .ok_or_else(|| refusal(sifted.refused.remove(0).1))
        };
        let search = Search::default();
        let found = multistart_with(
            &admissible,
            problem.window(),
            &search,
            &checked,
            &Watch::nobody(),
        )
        .unwrap();

        assert_eq!(found.certified.len(), 1);
        assert!((found.certified[0].candidate.value - 2.0).abs() < 1e-6);
        let [refused] = &found.uncertified[..] else {
            panic!("{:?}", found.uncertified)
        };
        assert!((refused.candidate.value - 3.0).abs() < 1e-6);
        assert!(
            matches!(
                refused.reason.attempts[0].failure,
                AttemptFailure::Refused { .. }
            ),
            "{}",
            refused.reason
        );

        let all = multistart(&problem, &admissible, &search).unwrap();
        assert_eq!((all.certified.len(), all.uncertified.len()), (2, 0));
    }
}
