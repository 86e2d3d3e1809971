//! The last interval of an infinite window: masses that are not definite, without some rows, of low
//! rank; solutions at infinity. All with `cargo test --release --test complete -- --ignored
//! --nocapture complete_tail::`.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, family_disagreements, truth};
use mceip_check::certificate::{Node, RootOutcome};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{Completed, Options, complete};
use mceip_exact::{Sparse, whole};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_testkit::generators::tails::{Mass, tails};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

fn search(problem: &Problem) -> Completed {
    complete(problem, &Options::default(), &Watch::nobody()).unwrap()
}

fn problem(pencil: Pencil) -> Problem {
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn draw(k: usize, most: usize) -> (Mass, Problem) {
    let mut rng = ChaCha8Rng::seed_from_u64(77_000 + k as u64);
    let mass = [Mass::Coupled, Mass::Indefinite, Mass::Partial][k % 3];
    let (n_s, n_f) = (rng.random_range(2..=most), rng.random_range(0..=3));
    (mass, problem(tails(&mut rng, n_s, n_f, mass).unwrap()))
}

/// Searches and compares with the enumerator; how many of how many stay open by kind of mass, and
/// what the covers used.
fn compare(count: usize, most: usize) -> (BTreeMap<String, (usize, usize)>, usize, usize) {
    let (mut by_kind, mut reversed, mut chords) = (BTreeMap::new(), 0, 0);
    for k in 0..count {
        let (mass, problem) = draw(k, most);
        let found = search(&problem);
        let truth = truth(&problem);
        assert_eq!(
            disagreements(&found.cover, &truth),
            Vec::<String>::new(),
            "{k}: {}",
            problem.canonical_text()
        );
        if !truth.is_plain_list() {
            assert_eq!(
                family_disagreements(&problem, &found.cover),
                Vec::<String>::new(),
                "{k}"
            );
        }
        let entry: &mut (usize, usize) = by_kind.entry(format!("{mass:?}")).or_default();
        (entry.0, entry.1) = (entry.0 + usize::from(!found.is_complete()), entry.1 + 1);
        found
            .cover
            .open
            .first()
            .into_iter()
            .for_each(|o| println!("{k} {mass:?}: {} open, first {o:?}", found.cover.open.len()));
        let set = found.certificate.complete_set.unwrap();
        reversed += usize::from(
            set.condensation
                .is_some_and(|c| c.anchors.iter().any(|a| a.reversed)),
        );
        let last = set.pieces.last().unwrap();
        chords += usize::from(last.tree.iter().any(|n| matches!(n, Node::Root(_))));
    }
    (by_kind, reversed, chords)
}

#[test]
fn the_last_interval_closes_whatever_the_mass() {
    let (by_kind, reversed, _) = compare(30, 5);
    println!("{by_kind:?}, {reversed} by reversed anchors");
    assert!(reversed >= 5, "{reversed}");
    let open: usize = by_kind.values().map(|(open, _)| open).sum();
    assert!(open <= 1, "{by_kind:?}");
}

#[test]
#[ignore = "minutes"]
fn the_last_interval_closes_on_larger_pencils() {
    let (by_kind, reversed, chords) = compare(240, 9);
    println!(
        "open of all: {by_kind:?}, {reversed} by reversed anchors, {chords} with roots in the last \
         piece"
    );
    assert!(reversed >= 50);
}

/// A solution at infinity on {0, ..., n-1} and no finite one beyond: closed by the limit's null
/// vector, at sizes that exact leaves do not reach.
#[test]
fn a_solution_at_infinity_does_not_keep_the_window_open() {
    for n in [2usize, 5, 14] {
        // B = L of a path graph (B 1 = 0), A = I: T(t) is definite for every t, and singular in the
        // limit.
        let degree = |i: usize| if i == 0 || i + 1 == n { 1 } else { 2 };
        let entries = (0..n).flat_map(|i| {
            let beside = [i.checked_sub(1), Some(i + 1).filter(|&j| j < n)]
                .into_iter()
                .flatten();
            std::iter::once((i, i, whole(degree(i))))
                .chain(beside.map(move |j| (i, j, whole(-1))))
                .collect::<Vec<_>>()
        });
        let b = Sparse::from_entries(n, n, entries);
        // A skew part keeps the search from one definite leaf without changing x'Tx.
        let skew = |i: usize, j: usize| {
            if j == i + 1 {
                1
            } else if i == j + 1 {
                -1
            } else {
                i64::from(i == j)
            }
        };
        let a = Sparse::from_entries(
            n,
            n,
            (0..n * n).map(|k| (k / n, k % n, whole(skew(k / n, k % n)))),
        );
        let found = search(&problem(Pencil::new(a, b, vec![]).unwrap()));
        assert!(
            found.is_complete() && found.cover.solutions.is_empty(),
            "{n}: {:?}",
            found.cover
        );
    }
}

/// B x = y with x = (1, ..., 1, 0) on 12 of 13 variables, too many for exact leaves: only the
/// outcome `infinity` closes it. (First run: the region up to infinity open on 6 of 6. In doubles
/// the Schur complement had a sign there, and the checker refused the leaf.)
#[test]
fn the_limit_of_a_large_support_is_named() {
    let (n, moving) = (13, 12);
    let (mut named, mut open) = (0, 0);
    for seed in 0..4u64 {
        let mut rng = ChaCha8Rng::seed_from_u64(500 + seed);
        let mut draw = || -> Vec<Vec<i64>> {
            (0..n)
                .map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect())
                .collect()
        };
        let (a, mut b) = (draw(), draw());
        for (i, row) in b.iter_mut().enumerate() {
            row[0] = if i < moving { 0 } else { 5 } - row[1..moving].iter().sum::<i64>();
        }
        let sparse =
            |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let window = Window::new(whole(1 << 20), None).unwrap();
        let problem =
            problem(Pencil::new(sparse(&a), sparse(&b), vec![]).unwrap()).with_window(window);
        let found = search(&problem);
        open += found.cover.open.iter().filter(|o| o.max.is_none()).count();
        let nodes = found
            .certificate
            .complete_set
            .iter()
            .flat_map(|s| &s.pieces)
            .flat_map(|p| &p.tree);
        named += nodes
            .filter(|n| matches!(n, Node::Root(r) if matches!(r.outcome, RootOutcome::Infinity(_))))
            .count();
    }
    assert!(
        named >= 3 && open <= 1,
        "{named} named, {open} open up to infinity"
    );
}
