//! Windows that end on a solution or within 1e-15 of one: the solution is inside or outside,
//! exactly.
#![cfg(feature = "testkit")]

use crate::cover::{disagreements, truth};
use mceip::exact::{Integer, Rational, Sparse, rational, whole};
use mceip::model::{Body, Pencil, Problem, Unknown, Window};
use mceip::run::Watch;
use mceip::search::complete::{Completed, Options, complete, resume};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn problem(a: Sparse, b: Sparse, lo: &Rational, hi: Option<&Rational>) -> Problem {
    let window = Window::new(lo.clone(), hi.cloned()).unwrap();
    Problem::new(
        Body::Pencil(Pencil::new(a, b, vec![]).unwrap()),
        Unknown::Lambda2,
        window,
    )
    .unwrap()
}

fn search(problem: &Problem) -> Completed {
    complete(
        problem,
        &Options {
            pieces: 4,
            ..Options::default()
        },
        &Watch::nobody(),
    )
    .unwrap()
}

/// The complete list, as the enumerator has it.
#[track_caller]
fn listed(problem: &Problem) -> usize {
    let found = search(problem);
    assert!(found.is_complete(), "{:?}", found.cover.open);
    assert_eq!(
        disagreements(&found.cover, &truth(problem)),
        Vec::<String>::new()
    );
    found.cover.solutions.len()
}

/// lambda^2 = 2 and 3 on one support.
fn fold(lo: Rational, hi: Option<Rational>) -> Problem {
    problem(
        Sparse::from_ints(&[&[1, -6], &[2, -6]]),
        Sparse::identity(2),
        &lo,
        hi.as_ref(),
    )
}

#[test]
fn a_rational_end_on_a_rational_solution_belongs_to_the_window() {
    let tiny = rational(1, 1_000_000_000_000_000_000);
    for (lo, hi, count) in [
        (whole(0), Some(whole(2)), 1),
        (whole(2), Some(whole(3)), 2),
        (whole(2), Some(whole(2)), 1),
        (whole(3), None, 1),
        (whole(0), Some(whole(2) - &tiny), 0),
        (whole(2) + &tiny, Some(whole(3) - &tiny), 0),
        (whole(3) + &tiny, None, 0),
        (whole(2) - &tiny, Some(whole(2) + &tiny), 1),
    ] {
        assert_eq!(
            listed(&fold(lo.clone(), hi.clone())),
            count,
            "[{lo}, {hi:?}]"
        );
    }
}

/// t^2 = 2: convergents of sqrt 2 lie on both sides of it, ever nearer.
#[test]
fn an_irrational_solution_beside_a_rational_end_is_on_the_right_side() {
    let root_two = |lo: &Rational, hi: Option<&Rational>| {
        problem(
            Sparse::from_ints(&[&[0, -2], &[-1, 0]]),
            Sparse::identity(2),
            lo,
            hi,
        )
    };
    let (mut p, mut q) = (Integer::from(1), Integer::from(1));
    let (mut below, mut above) = (0, 0);
    for step in 0..60 {
        (p, q) = (&p + &q * 2, &p + &q);
        let end = Rational::new(p.clone(), q.clone());
        // From 1e-6 to 1e-45 of the value.
        if step < 7 || step % 7 > 1 {
            continue;
        }
        let is_below = &end * &end < whole(2);
        assert_eq!(
            listed(&root_two(&whole(0), Some(&end))),
            usize::from(!is_below),
            "up to {end}"
        );
        assert_eq!(
            listed(&root_two(&end, Some(&whole(9)))),
            usize::from(is_below),
            "from {end}"
        );
        assert_eq!(
            listed(&root_two(&end, None)),
            usize::from(is_below),
            "from {end} on"
        );
        if is_below { below += 1 } else { above += 1 }
    }
    assert!(below >= 4 && above >= 4);
    // The figure of the issue: 1e-15 relative.
    let near = Rational::new(Integer::from(22_619_537), Integer::from(15_994_428));
    let distance = (&near * &near - whole(2)) / whole(4);
    assert!(num_traits::Signed::abs(&distance) < rational(1, 400_000_000_000_000));
    assert_eq!(
        listed(&root_two(&near, None)) + listed(&root_two(&whole(0), Some(&near))),
        1
    );
}

/// A solution planted at 3/7 on all of 12 variables, beyond the reach of exact leaves: the window
/// ends there.
#[test]
fn larger_supports_that_end_a_window_are_listed_through_their_claim() {
    let n = 12;
    let value = rational(3, 7);
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut draw = || -> Vec<Vec<Rational>> {
        (0..n)
            .map(|_| (0..n).map(|_| whole(rng.random_range(-9..=9))).collect())
            .collect()
    };
    let (mut a, b) = (draw(), draw());
    for i in 0..n {
        a[i][i] += whole(60);
        let rest: Rational = (1..n).map(|j| &a[i][j] + &value * &b[i][j]).sum();
        a[i][0] = -rest - &value * &b[i][0]; // x = (1, ..., 1)
    }
    let sparse = |m: &[Vec<Rational>]| {
        Sparse::from_entries(
            n,
            n,
            m.iter()
                .enumerate()
                .flat_map(|(i, r)| r.iter().enumerate().map(move |(j, v)| (i, j, v.clone()))),
        )
    };
    let all: Vec<usize> = (0..n).collect();
    let (lo, hi) = (rational(2, 7), rational(4, 7));
    for (lo, hi) in [
        (lo.clone(), value.clone()),
        (value.clone(), hi.clone()),
        (lo, hi),
    ] {
        let found = search(&problem(sparse(&a), sparse(&b), &lo, Some(&hi)));
        let here: Vec<_> = found
            .cover
            .solutions
            .iter()
            .filter(|s| s.support == all)
            .collect();
        assert!(found.is_complete(), "[{lo}, {hi}]: {:?}", found.cover.open);
        assert!(
            here.len() == 1 && here[0].value.contains(&value),
            "[{lo}, {hi}]: {:?}",
            found.cover.solutions
        );
    }
    let tiny = rational(1, 1_000_000_000_000);
    let found = search(&problem(
        sparse(&a),
        sparse(&b),
        &(&value + &tiny),
        Some(&rational(4, 7)),
    ));
    assert!(
        found.cover.solutions.iter().all(|s| s.support != all),
        "{:?}",
        found.cover.solutions
    );
}

/// A certificate to go on with is of one problem and one window.
#[test]
fn a_checkpoint_of_another_problem_or_window_is_refused() {
    let own = fold(whole(0), Some(whole(5)));
    let certificate = search(&own).certificate;
    let go_on =
        |p: &Problem| resume(p, &certificate, &Options::default(), &Watch::nobody()).map(|_| ());
    assert_eq!(go_on(&own), Ok(()));
    let refused = |p: &Problem| go_on(p).unwrap_err().to_string();
    assert!(
        refused(&fold(whole(0), Some(whole(6)))).contains("expected the window [0, 6], got [0, 5]")
    );
    assert!(refused(&fold(whole(0), None)).contains("[0, infinity)"));
    let other = problem(
        Sparse::from_ints(&[&[1, -6], &[2, -7]]),
        Sparse::identity(2),
        &whole(0),
        Some(&whole(5)),
    );
    assert!(refused(&other).contains("expected problem"));
}
