//! The enumerator against answers in closed form.
//!
//! The truth is `mceip_testkit::known` and `mceip_testkit::pareto`: graphs, diagonal, Jordan and
//! Z-matrices whose complete lists, cones included, follow from theorems, matrices of the
//! literature with published numbers of solutions, and problems made around a planted solution.
//! Answers are compared exactly, and near misses must differ.
#![cfg(feature = "testkit")]

use mceip_exact::{Algebraic, Integer, Poly, Rational, parse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, Pencil};
use mceip_oracle::{Solution, constants, is_rational_solution};
use mceip_testkit::enumerated;
use mceip_testkit::known::{Known, complete_graph, cycle, diagonal, jordan, path, star, z_matrix};
use mceip_testkit::pareto::{Pareto, pareto_matrices, planted};
use std::f64::consts::PI;

/// The enumerator lists what is known, and nothing else.
fn assert_known(known: &Known) {
    let name = &known.name;
    let expected = &known.expected;
    let found = enumerated(&known.problem);

    assert!(found.is_complete_list(), "{name}");
    assert!(found.ranges.is_empty(), "{name}");
    assert_eq!(found.solutions.len(), expected.solutions.len(), "{name}");
    assert_eq!(found.cones.len(), expected.cones.len(), "{name}");
    assert_eq!(found, *expected, "{name}");
}

#[test]
fn graphs() {
    for n in 1..=7 {
        assert_known(&path(n).unwrap());
    }
    for n in 3..=7 {
        assert_known(&cycle(n).unwrap());
    }
    for n in 0..=6 {
        assert_known(&star(n).unwrap());
    }
    for n in 1..=8 {
        assert_known(&complete_graph(n).unwrap());
    }

    // The counts of `facts.md`.
    let path = path(7).unwrap().expected;
    assert_eq!(path.solutions.len(), 28);
    assert!(!path.cones.is_empty());

    let complete_graph = complete_graph(8).unwrap().expected;
    assert_eq!(complete_graph.solutions.len(), 255);
    assert!(complete_graph.cones.is_empty());

    let cycle = cycle(7).unwrap().expected;
    assert!(!cycle.cones.is_empty());

    // The leaves at t = 0.
    let star = star(5).unwrap().expected;
    assert_eq!(star.cones.len(), 1);
}

fn value_as_double(solution: &Solution) -> f64 {
    solution.decimal(17).parse().unwrap()
}

/// The polynomials really have the trigonometric values that the closed form names.
#[test]
fn closed_forms_are_the_named_numbers() {
    for solution in path(9).unwrap().expected.solutions {
        let vertices = solution.slip.len() as f64;
        let named = 2.0 * (PI / (vertices + 1.0)).cos();

        let error = (value_as_double(&solution) - named).abs();
        assert!(error < 4e-15, "{:?}", solution.slip);
    }

    for solution in star(4).unwrap().expected.solutions {
        if solution.slip.len() <= 1 {
            continue;
        }
        let leaves = solution.slip.len() - 1;
        let named = (leaves as f64).sqrt();

        let error = (value_as_double(&solution) - named).abs();
        assert!(error < 4e-15);
    }
}

#[test]
fn z_matrices_have_only_the_all_slip_solution() {
    for n in 1..=8 {
        assert_known(&z_matrix(n).unwrap());
    }
}

#[test]
fn diagonal_and_jordan_pencils() {
    let distinct = [
        whole(3),
        rational(1, 2),
        whole(0),
        whole(-1),
        rational(7, 3),
    ];
    assert_known(&diagonal(&distinct).unwrap());

    let repeated = [
        whole(2),
        rational(1, 2),
        whole(2),
        rational(1, 2),
        whole(2),
        whole(-2),
        whole(-2),
    ];
    assert_known(&diagonal(&repeated).unwrap());

    for n in 1..=6 {
        assert_known(&jordan(n, 2, true).unwrap());
        assert_known(&jordan(n, 0, false).unwrap());
    }
}

/// A wrong answer is noticed: one ray bent, one solution or one cone left out, one root exchanged.
#[test]
fn near_misses_are_different_answers() {
    let path = path(5).unwrap();
    let right = &path.expected;

    let mut bent = right.clone();
    bent.solutions[7].x[2] = &bent.solutions[7].x[2] + &Poly::from_ints(&[1]);

    let mut without_a_solution = right.clone();
    without_a_solution.solutions.pop();

    let mut without_a_cone = right.clone();
    without_a_cone.cones.pop();

    let mut with_other_roots = right.clone();
    with_other_roots.solutions[9].value = with_other_roots.solutions[10].value.clone();
    with_other_roots.solutions[10].value = Algebraic::rational(whole(1));

    let mut with_a_wider_cone = right.clone();
    with_a_wider_cone.cones[0].biactive.push(4);

    let found = enumerated(&path.problem);
    assert_ne!(found, bent);
    assert_ne!(found, without_a_solution);
    assert_ne!(found, without_a_cone);
    assert_ne!(found, with_other_roots);
    assert_ne!(found, with_a_wider_cone);
    assert_eq!(found, *right);
}

/// The value to forty digits.
fn value_to_forty_digits(solution: &Solution) -> Rational {
    parse(&solution.decimal(40)).unwrap()
}

/// The mechanical system of a matrix has mu = a / (c - lambda), and its own pencil has
/// t = lambda + c: mu (2 c - t) = a up to the digits, with the same supports and x.
fn assert_same_solution(a: &Rational, c: &Rational, own: &Solution, mechanical: &Solution) {
    let t = value_to_forty_digits(own);
    let mu = value_to_forty_digits(mechanical);
    let error = &mu * (whole(2) * c - &t) - a;
    let tiny = Rational::new(1.into(), Integer::from(10).pow(30));
    assert!(error < tiny);
    assert!(-error < tiny);

    assert_eq!(own.slip, mechanical.slip);
    assert_eq!(own.biactive, mechanical.biactive);
}

fn assert_published_count(pareto: &Pareto) {
    let a = rational(7, 2);
    let c = pareto.bound();

    let own = enumerated(&pareto.pencil().unwrap());
    assert!(own.is_plain_list());
    assert_eq!(own.solutions.len(), pareto.count);

    let system = pareto.system(&a, &c).unwrap();
    assert!(matches!(system.body(), Body::System(_)));
    let pencil = reduce(&system).unwrap().pencil;
    assert!(Admissible::new(&pencil, system.unknown()).is_ok());
    let mechanical = enumerated(&system);
    assert_eq!(mechanical.solutions.len(), pareto.count);

    // t and mu are increasing in lambda: both lists are in one order.
    let slip = pencil.slip();
    for (left, right) in own.solutions.iter().zip(&mechanical.solutions) {
        assert_same_solution(&a, &c, left, right);
        assert_eq!(left.x_decimals(&slip, 30), right.x_decimals(&slip, 30));
    }
}

/// Matrices of the literature: the number of solutions is the published number of Pareto
/// eigenvalues, and in the mechanical system mu = a / (c - lambda) with the same supports and x.
#[test]
fn pareto_matrices_in_mechanical_systems() {
    for pareto in pareto_matrices() {
        assert_published_count(&pareto);
    }
}

#[test]
fn planted_solutions_are_found() {
    for seed in 0..40 {
        let n = 2 + seed as usize % 5;
        let planted = planted(n, seed as usize % 3 % n, seed).unwrap();
        let pencil: Pencil = reduce(&planted.problem).unwrap().pencil;
        let admissible = Admissible::new(&pencil, planted.problem.unknown());
        assert!(admissible.is_ok(), "seed {seed}");
        let solves = is_rational_solution(&pencil, &planted.value, &planted.x);
        assert!(solves, "seed {seed}");

        let found = enumerated(&planted.problem);

        let x = constants(&planted.x);
        let value = Algebraic::rational(planted.value.clone());
        assert!(found.contains(&pencil, &value, &x), "seed {seed}");

        // The same vector solves nothing at a value close by.
        let beside = Algebraic::rational(&planted.value + rational(1, 1_000_000_007));
        assert!(!found.contains(&pencil, &beside, &x), "seed {seed}");
    }
}
