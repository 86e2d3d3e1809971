//! The plain enumerator against answers in closed form: complete lists, cones included.
#![cfg(feature = "testkit")]

use mceip_engine::reduction::reduce;
use mceip_exact::{Algebraic, Poly, Rational, parse, rational, whole};
use mceip_model::{Admissible, Body, Problem};
use mceip_oracle::{Enumeration, enumerate, is_rational_solution};
use mceip_testkit::known::{Known, complete_graph, cycle, diagonal, jordan, path, star, z_matrix};
use mceip_testkit::pareto::{pareto_matrices, planted};

fn solve(problem: &Problem) -> Enumeration {
    enumerate(&reduce(problem).unwrap().pencil, problem.window()).unwrap()
}

fn holds(known: &Known) {
    let found = solve(&known.problem);
    assert!(
        found.is_complete_list() && found.ranges.is_empty(),
        "{}",
        known.name
    );
    assert_eq!(
        found.solutions.len(),
        known.expected.solutions.len(),
        "{}",
        known.name
    );
    assert_eq!(
        found.cones.len(),
        known.expected.cones.len(),
        "{}",
        known.name
    );
    assert_eq!(found, known.expected, "{}", known.name);
}

#[test]
fn graphs() {
    (1..=7).for_each(|n| holds(&path(n).unwrap()));
    (3..=7).for_each(|n| holds(&cycle(n).unwrap()));
    (0..=6).for_each(|n| holds(&star(n).unwrap()));
    (1..=8).for_each(|n| holds(&complete_graph(n).unwrap()));
    // The counts of `facts.md`.
    assert_eq!(path(7).unwrap().expected.solutions.len(), 28);
    assert_eq!(complete_graph(8).unwrap().expected.solutions.len(), 255);
    assert!(complete_graph(8).unwrap().expected.cones.is_empty());
    assert!(
        !path(7).unwrap().expected.cones.is_empty() && !cycle(7).unwrap().expected.cones.is_empty()
    );
    assert_eq!(star(5).unwrap().expected.cones.len(), 1); // the leaves at t = 0
}

/// The polynomials really have the trigonometric values that the closed form names.
#[test]
fn closed_forms_are_the_named_numbers() {
    for s in path(9).unwrap().expected.solutions {
        let named = 2.0 * (std::f64::consts::PI / (s.slip.len() as f64 + 1.0)).cos();
        assert!(
            (s.decimal(17).parse::<f64>().unwrap() - named).abs() < 4e-15,
            "{:?}",
            s.slip
        );
    }
    for s in star(4)
        .unwrap()
        .expected
        .solutions
        .iter()
        .filter(|s| s.slip.len() > 1)
    {
        let named = ((s.slip.len() - 1) as f64).sqrt();
        assert!((s.decimal(17).parse::<f64>().unwrap() - named).abs() < 4e-15);
    }
}

#[test]
fn z_matrices_have_only_the_all_slip_solution() {
    (1..=8).for_each(|n| holds(&z_matrix(n).unwrap()));
}

#[test]
fn diagonal_and_jordan_pencils() {
    holds(
        &diagonal(&[
            whole(3),
            rational(1, 2),
            whole(0),
            whole(-1),
            rational(7, 3),
        ])
        .unwrap(),
    );
    holds(
        &diagonal(&[
            whole(2),
            rational(1, 2),
            whole(2),
            rational(1, 2),
            whole(2),
            whole(-2),
            whole(-2),
        ])
        .unwrap(),
    );
    for n in 1..=6 {
        holds(&jordan(n, 2, true).unwrap());
        holds(&jordan(n, 0, false).unwrap());
    }
}

/// A wrong answer is noticed: one ray bent, one solution or one cone left out, one root exchanged.
#[test]
fn near_misses_are_different_answers() {
    let right = path(5).unwrap();
    let found = solve(&right.problem);
    let mut bent = right.expected.clone();
    bent.solutions[7].x[2] = &bent.solutions[7].x[2] + &Poly::from_ints(&[1]);
    let mut short = right.expected.clone();
    short.solutions.pop();
    let mut flat = right.expected.clone();
    flat.cones.pop();
    let mut moved = right.expected.clone();
    moved.solutions[9].value = moved.solutions[10].value.clone();
    moved.solutions[10].value = Algebraic::rational(whole(1));
    let mut widened = right.expected.clone();
    widened.cones[0].biactive.push(4);
    for wrong in [bent, short, flat, moved, widened] {
        assert_ne!(found, wrong);
    }
    assert_eq!(found, right.expected);
}

/// Matrices of the literature: the number of solutions is the published number of Pareto
/// eigenvalues, and in the mechanical system mu = a / (c - lambda) with the same supports and x.
#[test]
fn pareto_matrices_in_mechanical_systems() {
    for pareto in pareto_matrices() {
        let raw = solve(&pareto.pencil().unwrap());
        assert!(raw.is_plain_list());
        assert_eq!(raw.solutions.len(), pareto.count);
        let (a, c) = (rational(7, 2), pareto.bound());
        let system = pareto.system(&a, &c).unwrap();
        assert!(matches!(system.body(), Body::System(_)));
        let reduced = reduce(&system).unwrap();
        assert!(Admissible::new(&reduced.pencil, system.unknown()).is_ok());
        let mechanical = solve(&system);
        assert_eq!(mechanical.solutions.len(), pareto.count);
        // t = lambda + bound = lambda + c is increasing in lambda, and so is mu: both lists are in
        // one order.
        for (s, m) in raw.solutions.iter().zip(&mechanical.solutions) {
            let number = |text: String| parse(&text).unwrap();
            let (t, mu): (Rational, Rational) = (number(s.decimal(40)), number(m.decimal(40)));
            let error = &mu * (whole(2) * &c - &t) - &a;
            let tiny = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(30));
            assert!(error < tiny && -error < tiny);
            assert_eq!((&s.slip, &s.biactive), (&m.slip, &m.biactive));
            let slip = reduced.pencil.slip();
            assert_eq!(s.x_decimals(&slip, 30), m.x_decimals(&slip, 30));
        }
    }
}

#[test]
fn planted_solutions_are_found() {
    for seed in 0..40 {
        let n = 2 + seed as usize % 5;
        let p = planted(n, seed as usize % 3 % n, seed).unwrap();
        let pencil = reduce(&p.problem).unwrap().pencil;
        assert!(
            Admissible::new(&pencil, p.problem.unknown()).is_ok(),
            "seed {seed}"
        );
        assert!(is_rational_solution(&pencil, &p.value, &p.x), "seed {seed}");
        let clear = mceip_exact::common_denominator(&p.x);
        let x: Vec<Poly> =
            p.x.iter()
                .map(|v| Poly::constant(v.numer() * (&clear / v.denom())))
                .collect();
        let found = solve(&p.problem);
        let value = Algebraic::rational(p.value.clone());
        assert!(found.contains(&pencil, &value, &x), "seed {seed}");
        // Beside it, and with another vector, there is nothing.
        assert!(
            !found.contains(
                &pencil,
                &Algebraic::rational(&p.value + rational(1, 1_000_000_007)),
                &x
            ),
            "seed {seed}"
        );
    }
}
