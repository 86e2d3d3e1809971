//! Local modes: components and reactions of 1e-22 of the largest, as on finite-element meshes. What
//! `solve` calls certified is accepted by the checker, and the complete set closes.
#![cfg(feature = "testkit")]

use mceip::certificate::{Certificate, Claim};
use mceip::certify::{certificate, sift};
use mceip::check::check;
use mceip::exact::{Sparse, parse, rational, whole};
use mceip::model::{Admissible, Body, Pencil, Problem, Unknown, Window};
use mceip::multistart::{Search, multistart};
use mceip::reduction::reduce;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
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

fn found(problem: &Problem) -> mceip::multistart::Found {
    let pencil = reduce(problem).unwrap().pencil;
    let admissible = Admissible::new(&pencil, problem.unknown()).unwrap();
    multistart(
        problem,
        &admissible,
        &Search {
            starts: 4,
            window_starts: 1,
            ..Search::default()
        },
    )
    .unwrap()
}

fn enclosed(claim: &Claim) -> mceip::certificate::EnclosedSolution {
    let Claim::EnclosedSolution(claim) = claim else {
        panic!("an enclosed claim: {claim:?}")
    };
    claim.clone()
}

#[test]
fn a_local_mode_is_certified_and_accepted() {
    let problem = chain(1);
    let found = found(&problem);
    let claims: Vec<Claim> = found.certified.iter().map(|c| c.claim.clone()).collect();
    assert!(!claims.is_empty(), "{:?}", found.uncertified);

    let accepted = check(&problem, &certificate(&problem, claims.clone())).unwrap();
    assert_eq!(accepted.claims.len(), claims.len());
    assert!(
        accepted.claims.iter().any(|c| c.support == [0]),
        "{:?}",
        accepted.claims
    );
}

/// With the other sign variable 0 cannot move alone: it moves with the far one, whose part is
/// 1e-23.
#[test]
fn a_tiny_component_of_a_mode_is_certified() {
    let problem = chain(-1);
    let found = found(&problem);
    let both = found
        .certified
        .iter()
        .find(|c| enclosed(&c.claim).support == [0, LINKS + 1]);
    let claim = enclosed(
        &both
            .unwrap_or_else(|| panic!("{:?}", found.uncertified))
            .claim,
    );

    let far = &claim.center[LINKS + 1].0;
    assert!(far.is_positive() && *far < parse("1e-20").unwrap(), "{far}");
    assert!(
        !found
            .certified
            .iter()
            .any(|c| enclosed(&c.claim).support == [0])
    );
    check(
        &problem,
        &certificate(&problem, vec![Claim::EnclosedSolution(claim)]),
    )
    .unwrap();
}

/// A candidate that says 0 where the solution has 1e-4 is not taken for it: that is no matter of
/// rounding.
#[test]
fn a_component_that_doubles_see_is_not_repaired() {
    let certified = |coupling: &str| {
        let n = 18;
        let mut entries: Vec<_> = (1..n).map(|i| (i, i, whole(18))).collect();
        entries.extend([
            (0, 0, whole(-1)),
            (n, 0, parse(coupling).unwrap()),
            (n, n, whole(5)),
        ]);
        let pencil = Pencil::new(
            Sparse::from_entries(n + 1, n + 1, entries),
            Sparse::identity(n + 1),
            (1..n).collect(),
        )
        .unwrap();
        let mut x = vec![0.0; n + 1];
        x[0] = 1.0;
        mceip::certify::propose(
            &pencil,
            &Window::all(),
            &mceip::candidate::Candidate { value: 1.0, x },
        )
    };
    assert_eq!(enclosed(&certified("-1e-20").unwrap()).support, [0, 18]);
    let attempts = certified("-1e-3").unwrap_err().attempts;
    assert!(
        attempts.iter().any(|a| a.support == [0, 18]),
        "{attempts:?}"
    );
}

/// A box as wide as 2^-40 in every component, as it was once made, is refused and sifted out; with
/// its own radii it stays.
#[test]
fn one_radius_for_all_components_is_refused() {
    let problem = chain(1);
    let found = found(&problem);
    let good = found
        .certified
        .iter()
        .map(|c| &c.claim)
        .find(|c| enclosed(c).support == [0])
        .unwrap()
        .clone();

    let mut wide = enclosed(&good);
    for radius in &mut wide.radius {
        radius.0 = rational(1, 1 << 40);
    }
    let sifted = sift(&problem, vec![Claim::EnclosedSolution(wide), good.clone()]);
    assert_eq!(sifted.accepted, [good]);
    let [(0, reason)] = &sifted.refused[..] else {
        panic!("{:?}", sifted.refused)
    };
    assert_eq!(reason.name(), "YNotPositive");
}

/// Both signs of the far end: nothing stays open, and the checker reads the same set from the file.
#[test]
fn the_complete_set_of_a_local_mode_closes() {
    for (end, support) in [(1, vec![0]), (-1, vec![0, LINKS + 1])] {
        let problem = chain(end);
        let completed = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
        assert!(
            completed.cover.open.is_empty(),
            "{:?}",
            completed.cover.open
        );

        let supports: Vec<&Vec<usize>> = completed
            .cover
            .solutions
            .iter()
            .map(|s| &s.support)
            .collect();
        assert_eq!(supports, [&support]);

        let read = Certificate::from_json(&completed.certificate.to_json()).unwrap();
        assert_eq!(
            check(&problem, &read).unwrap().cover.unwrap().solutions,
            completed.cover.solutions
        );
    }
}
