//! Local modes: components and reactions of 1e-22 of the largest, as on finite-element meshes. What
//! `solve` calls certified is accepted by the checker, and the complete set closes.
//!
//! The modes belong to a chain along which the motion falls by a factor of 19 from link to link, so
//! that the sign at the far end is known by hand and lost in doubles.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim, EnclosedSolution};
use mceip_check::{ClaimChecker, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::propose;
use mceip_engine::multistart::{MultistartFound, Search, multistart};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, parse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use num_traits::Signed;

/// Free variables of the chain: more than exact claims are made for.
const LINKS: usize = 17;

/// Slip variable 0, a chain of free variables and slip variable LINKS + 1. Each link passes on
/// about 1/19 of its motion, so that what arrives at the other end is 1e-23. At the value near 1
/// where variable 0 moves alone, the reaction of the other one is that small, with the sign of
/// `end`.
fn chain(end: i64) -> Problem {
    let last = LINKS + 1;
    let mut entries = vec![(0, 0, whole(-1)), (last, last, whole(5))];
    for i in 1..=LINKS {
        entries.push((i, i, whole(18)));
        entries.push((i, i - 1, whole(-1)));
        if i < LINKS {
            entries.push((i, i + 1, whole(-1)));
        }
    }

    entries.push((0, 1, whole(-1)));
    entries.push((LINKS, last, whole(-1)));
    entries.push((last, LINKS, whole(end)));

    let a = Sparse::from_entries(last + 1, last + 1, entries);
    let pencil = Pencil::new(a, Sparse::identity(last + 1), (1..=LINKS).collect()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn found(problem: &Problem) -> MultistartFound {
    let reduced = reduce(problem).unwrap();
    let search = Search {
        starts: 4,
        window_starts: 1,
        ..Search::default()
    };
    multistart(problem, &reduced, &search, &Watch::nobody()).unwrap()
}

fn enclosed(claim: &Claim) -> EnclosedSolution {
    let Claim::EnclosedSolution(claim) = claim else {
        panic!("an enclosed claim: {claim:?}")
    };
    claim.clone()
}

/// The certified claim with this support.
fn with_support(found: &MultistartFound, support: &[usize]) -> Option<Claim> {
    let mut claims = found.certified.iter().map(|certified| &certified.claim);
    claims
        .find(|claim| enclosed(claim).support == support)
        .cloned()
}

#[test]
fn a_local_mode_is_certified_and_accepted() {
    let problem = chain(1);
    let found = found(&problem);
    let claims: Vec<Claim> = found.certified.iter().map(|c| c.claim.clone()).collect();
    assert!(!claims.is_empty(), "{:?}", found.uncertified);

    let count = claims.len();
    let accepted = check(&problem, &Certificate::of_claims(&problem, claims)).unwrap();
    assert_eq!(accepted.claims.len(), count);

    let mut supports = accepted.claims.iter().map(|claim| &claim.support);
    let has_local_mode = supports.any(|support| *support == [0]);
    assert!(has_local_mode, "{:?}", accepted.claims);
}

/// With the other sign variable 0 cannot move alone: it moves with the far one, whose part is
/// 1e-23.
#[test]
fn a_tiny_component_of_a_mode_is_certified() {
    let problem = chain(-1);
    let found = found(&problem);
    assert_eq!(with_support(&found, &[0]), None);

    let Some(both) = with_support(&found, &[0, LINKS + 1]) else {
        panic!("{:?}", found.uncertified)
    };
    let far = &enclosed(&both).center[LINKS + 1].0;
    assert!(far.is_positive(), "{far}");
    assert!(*far < parse("1e-20").unwrap(), "{far}");

    check(&problem, &Certificate::of_claims(&problem, vec![both])).unwrap();
}

/// Order of the pencil of `coupled`, less one.
const LAST: usize = 18;

/// Slip variables 0 and LAST, which only the coupling connects, and free variables between them: at
/// t = 1 variable 0 moves, and the reaction of LAST is the coupling.
fn coupled(coupling: &str) -> Pencil {
    let mut entries: Vec<_> = (1..LAST).map(|i| (i, i, whole(18))).collect();
    entries.push((0, 0, whole(-1)));
    entries.push((LAST, 0, parse(coupling).unwrap()));
    entries.push((LAST, LAST, whole(5)));

    let a = Sparse::from_entries(LAST + 1, LAST + 1, entries);
    Pencil::new(a, Sparse::identity(LAST + 1), (1..LAST).collect()).unwrap()
}

/// A candidate that says 0 where the solution has 1e-4 is not taken for it: that is no matter of
/// rounding.
#[test]
fn a_component_that_doubles_see_is_not_repaired() {
    let mut x = vec![0.0; LAST + 1];
    x[0] = 1.0;
    let candidate = Candidate { value: 1.0, x };

    let rounded = propose(&coupled("-1e-20"), &Window::all(), &candidate).unwrap();
    assert_eq!(enclosed(&rounded).support, [0, LAST]);

    let refused = propose(&coupled("-1e-3"), &Window::all(), &candidate).unwrap_err();
    let mut supports = refused.attempts.iter().map(|attempt| &attempt.support);
    let has_tried_both = supports.any(|support| *support == [0, LAST]);
    assert!(has_tried_both, "{:?}", refused.attempts);
}

/// A box as wide as 2^-40 in every component, as it was once made, is refused; with its own radii
/// it is accepted.
#[test]
fn one_radius_for_all_components_is_refused() {
    let problem = chain(1);
    let good = with_support(&found(&problem), &[0]).unwrap();

    let mut wide = enclosed(&good);
    for radius in &mut wide.radius {
        radius.0 = rational(1, 1 << 40);
    }

    let checker = ClaimChecker::new(&problem);
    let verdict = |claim: &Claim| checker.verdict(problem.window(), claim);
    assert!(verdict(&good).is_ok());
    let reason = verdict(&Claim::EnclosedSolution(wide)).unwrap_err();
    assert_eq!(reason.name(), "YNotPositive");
}

/// Both signs of the far end: nothing stays open, and the checker reads the same set from the file.
#[test]
fn the_complete_set_of_a_local_mode_closes() {
    for (end, support) in [(1, vec![0]), (-1, vec![0, LINKS + 1])] {
        let problem = chain(end);
        let completed = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
        let cover = &completed.cover;
        assert!(cover.open.is_empty(), "{:?}", cover.open);

        let supports: Vec<_> = cover.solutions.iter().map(|s| &s.support).collect();
        assert_eq!(supports, [&support]);

        let read = Certificate::from_json(&completed.proved.certificate().to_json()).unwrap();
        let accepted = check(&problem, &read).unwrap().cover.unwrap();
        assert_eq!(accepted.solutions, cover.solutions);
    }
}
