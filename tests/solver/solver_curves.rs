//! The Newton homotopy: curves that meet several solutions, curves through known ones, and problems
//! of the literature on which descent alone fails.
#![cfg(feature = "testkit")]

use crate::families::{Case, random_case, table1_cases};
use mceip_engine::multistart::{Search, multistart, support};
use mceip_engine::reduction::{Embedding, Side};
use mceip_mcp::mcp::{LinearMcp, Mcp};
use mceip_mcp::solver::{
    CurveEnd, Options, Sense, StepKind, continuation, continuation_through, solve, solve_linear,
};
use mceip_model::{Admissible, Window};
use mceip_oracle::enumerate;
use nalgebra::DMatrix;

/// A smooth MCP in one or more unknowns z >= 0, the Jacobian by hand.
struct Smooth<F, J> {
    n: usize,
    f: F,
    j: J,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl<F: Fn(&[f64], &mut [f64]), J: Fn(&[f64], &mut DMatrix<f64>)> Mcp for Smooth<F, J> {
    fn dimension(&self) -> usize {
        self.n
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        (self.f)(z, f);
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        (self.j)(z, j);
    }
}

fn smooth<F: Fn(&[f64], &mut [f64]), J: Fn(&[f64], &mut DMatrix<f64>)>(
    n: usize,
    f: F,
    j: J,
) -> Smooth<F, J> {
    Smooth {
        n,
        f,
        j,
        lower: vec![0.0; n],
        upper: vec![f64::INFINITY; n],
    }
}

/// Billups 1995: (z - 1)^2 - 1.01 on z >= 0 has one solution, and every merit a trap at z = 0 or
/// near 1.
#[test]
fn billups() {
    let problem = smooth(
        1,
        |z, f| f[0] = (z[0] - 1.0).powi(2) - 1.01,
        |z, j| j[(0, 0)] = 2.0 * (z[0] - 1.0),
    );
    for start in [0.0, 0.5, 1.0, 1.5, 10.0] {
        let outcome = solve(&problem, &[start], &Options::default()).unwrap();
        assert!(
            outcome.termination.reached_tolerance(),
            "{start}: {outcome:?}"
        );
        assert!((outcome.point[0] - (1.0 + 1.01f64.sqrt())).abs() < 1e-9);
    }
    let curve = continuation(&problem, &[0.0], Sense::Down, 9, &Options::default()).unwrap();
    assert_eq!(
        (curve.solutions.len(), curve.end),
        (1, CurveEnd::Ray),
        "{curve:?}"
    );
}

/// Murphy, Sherali and Soyster 1982, five firms; four digits of the known solution.
#[test]
fn nash_cournot() {
    const C: [f64; 5] = [10.0, 8.0, 6.0, 4.0, 2.0];
    const BETA: [f64; 5] = [1.2, 1.1, 1.0, 0.9, 0.8];
    const GAMMA: f64 = 1.1;
    let price = |q: f64| (5000.0 / q).powf(1.0 / GAMMA);
    let f = move |z: &[f64], f: &mut [f64]| {
        let q: f64 = z.iter().sum();
        for i in 0..5 {
            f[i] =
                C[i] + (z[i] / 5.0).powf(1.0 / BETA[i]) - price(q) + z[i] * price(q) / (GAMMA * q);
        }
    };
    let j = move |z: &[f64], j: &mut DMatrix<f64>| {
        let q: f64 = z.iter().sum();
        let (p, dp) = (price(q), -price(q) / (GAMMA * q));
        for i in 0..5 {
            for k in 0..5 {
                j[(i, k)] = -dp + z[i] / GAMMA * (dp / q - p / (q * q));
            }
            j[(i, i)] += (z[i] / 5.0).powf(1.0 / BETA[i] - 1.0) / (5.0 * BETA[i]) + p / (GAMMA * q);
        }
    };
    let problem = Smooth {
        lower: vec![0.01; 5],
        ..smooth(5, f, j)
    };
    for start in [1.0, 10.0, 100.0] {
        let outcome = solve(&problem, &[start; 5], &Options::default()).unwrap();
        assert!(
            outcome.termination.reached_tolerance(),
            "{start}: {:?}",
            outcome.termination
        );
        for (got, want) in outcome
            .point
            .iter()
            .zip([36.93, 41.82, 43.71, 42.66, 39.18])
        {
            assert!((got - want).abs() < 6e-3, "{:?}", outcome.point);
        }
    }
}

/// Invariant capital stock (Hansen and Koopmans 1972): activities x, prices y of two capital goods
/// and u of labour. Our own data, made from the solution x = (2, 0, 1, 0), y = (3, 1), u = 2; the
/// model is that of MCPLIB's `hanskoop`, whose data we did not have.
#[test]
fn hansen_and_koopmans() {
    const ALPHA: f64 = 0.7;
    let inputs = [[1.0, 2.0, 1.0, 0.5], [1.0, 1.0, 2.0, 1.0]];
    let outputs = [[1.0, 3.0, 1.0, 1.0], [1.5, 1.0, 1.0, 2.0]];
    let labour = [1.0, 2.0, 1.5, 1.0];
    let (x, y, u, slack) = ([2.0, 0.0, 1.0, 0.0], [3.0, 1.0], 2.0, [0.0, 0.4, 0.0, 0.9]);
    let cost = |k: usize, y: &[f64], u: f64| {
        (0..2)
            .map(|g| (inputs[g][k] - ALPHA * outputs[g][k]) * y[g])
            .sum::<f64>()
            + labour[k] * u
    };
    // Marginal utility a_k - x_k, with a_k such that the given x is optimal.
    let a: Vec<f64> = (0..4).map(|k| x[k] + cost(k, &y, u) - slack[k]).collect();
    let supply = labour.iter().zip(&x).map(|(l, x)| l * x).sum::<f64>();
    let f = |z: &[f64], f: &mut [f64]| {
        for k in 0..4 {
            f[k] = z[k] - a[k] + cost(k, &z[4..6], z[6]);
        }
        for g in 0..2 {
            f[4 + g] = (0..4).map(|k| (outputs[g][k] - inputs[g][k]) * z[k]).sum();
        }
        f[6] = supply - (0..4).map(|k| labour[k] * z[k]).sum::<f64>();
    };
    let j = |_: &[f64], j: &mut DMatrix<f64>| {
        j.fill(0.0);
        for k in 0..4 {
            j[(k, k)] = 1.0;
            for g in 0..2 {
                j[(k, 4 + g)] = inputs[g][k] - ALPHA * outputs[g][k];
                j[(4 + g, k)] = outputs[g][k] - inputs[g][k];
            }
            (j[(k, 6)], j[(6, k)]) = (labour[k], -labour[k]);
        }
    };
    let problem = smooth(7, f, j);
    for start in [0.0, 1.0, 10.0] {
        let outcome = solve(&problem, &[start; 7], &Options::default()).unwrap();
        assert!(
            outcome.termination.reached_tolerance(),
            "{start}: {:?}",
            outcome.termination
        );
        // Utility is strictly concave: x is unique, prices are not (three rows bind, two activities
        // run).
        assert!(
            outcome
                .point
                .iter()
                .zip(x)
                .all(|(got, want)| (got - want).abs() < 1e-8),
            "{:?}",
            outcome.point
        );
    }
}

/// Fathi 1979: positive definite, exponentially many pivots for Murty's rule; z = e_1.
#[test]
fn fathi() {
    for n in [2usize, 5, 9] {
        let diagonal = |i: usize| 4.0 * i as f64 + 1.0;
        let entry = |i: usize, j: usize| diagonal(i.min(j)) + if i == j { 0.0 } else { 1.0 };
        let lcp = LinearMcp::lcp(DMatrix::from_fn(n, n, entry), vec![-1.0; n]).unwrap();
        for outcome in [
            solve_linear(&lcp, &Options::default()).unwrap(),
            solve(&lcp, &vec![3.0; n], &Options::default()).unwrap(),
        ] {
            assert!(outcome.termination.reached_tolerance());
            assert!(
                outcome
                    .point
                    .iter()
                    .enumerate()
                    .all(|(i, v)| (v - f64::from(u8::from(i == 0))).abs() < 1e-9),
                "{outcome:?}"
            );
        }
    }
}

/// sin has its zeros on one curve: the curve goes on after each. The bound 0 is a solution too (F =
/// 0).
#[test]
fn one_curve_meets_many_solutions() {
    let wave = Smooth {
        lower: vec![f64::NEG_INFINITY],
        ..smooth(
            1,
            |z, f| f[0] = z[0].sin() + 0.5 * (0.3 * z[0]).cos(),
            |z, j| j[(0, 0)] = z[0].cos() - 0.15 * (0.3 * z[0]).sin(),
        )
    };
    let curve = continuation(&wave, &[1.0], Sense::Down, 5, &Options::default()).unwrap();
    assert_eq!((curve.solutions.len(), curve.end), (5, CurveEnd::Enough));
    for z in &curve.solutions {
        assert!((z[0].sin() + 0.5 * (0.3 * z[0]).cos()).abs() < 1e-8);
    }
}

/// F is never evaluated outside the bounds, however far Newton's steps would go.
#[test]
fn curves_stay_within_the_bounds() {
    let problem = smooth(
        2,
        |z, f| {
            assert!(z.iter().all(|v| *v >= 0.0));
            f[0] = z[0].sqrt() - z[1] + 0.1;
            f[1] = z[0] + z[1].sqrt() - 2.0;
        },
        |z, j| {
            j.copy_from(&nalgebra::dmatrix![0.5 / (z[0] + 1e-9).sqrt(), -1.0; 1.0, 0.5 / (z[1] + 1e-9).sqrt()]);
        },
    );
    for sense in [Sense::Down, Sense::Up] {
        continuation(&problem, &[3.0, 0.2], sense, 4, &Options::default()).unwrap();
    }
}

#[test]
fn the_curve_is_in_the_log_where_the_first_attempt_fails() {
    let mut by_curve = 0;
    for k in 0..40 {
        let case = random_case("mu", 10, 5, k);
        let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
        let embedding = Embedding::new(&admissible, Side::Above(0.0));
        let outcome = solve(&embedding, &embedding.starts(1, 0)[0], &Options::default()).unwrap();
        by_curve += usize::from(
            outcome.log.iter().any(|m| m.step == StepKind::Curve)
                && outcome.termination.reached_tolerance(),
        );
    }
    assert!(by_curve > 0);
}

/// First starts and coverage on two families against the plain enumerator; the full tables are in
/// `spec/measurements.md`, D.3.
#[test]
fn first_starts_and_coverage_on_held_out_seeds() {
    for family in ["lambda2", "mu"] {
        let (mut solvable, mut first, mut found, mut truth) = (0, 0, 0, 0);
        for k in 0..20 {
            let case = random_case(family, 8, 901, k);
            let all = enumerate(&case.pencil, &Window::all()).unwrap();
            if all.solutions.is_empty() {
                continue;
            }
            let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
            let search = Search {
                starts: 10,
                window_starts: 0,
                ..Search::default()
            };
            let list = multistart(&case.problem(), &admissible, &search).unwrap();
            solvable += 1;
            first += usize::from(list.certified.iter().any(|c| c.run == 0));
            truth += all.solutions.len();
            found += all
                .solutions
                .iter()
                .filter(|s| list.certified.iter().any(|c| support(&c.claim) == s.slip))
                .count();
            assert!(
                list.certified.len() <= all.solutions.len(),
                "{}",
                case.label
            );
        }
        assert!(
            solvable >= 10 && first == solvable,
            "{family}: {first} of {solvable}"
        );
        assert_eq!(found, truth, "{family}");
    }
}

/// The instance that the first start once missed: its one solution, just above a threshold, beside
/// a trap of the merit; all curves from near the start run off, those from farther away do not.
#[test]
fn the_pocket_of_the_first_start_is_left() {
    let case = random_case("lambda2", 10, 302, 3);
    let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
    let embedding = Embedding::new(&admissible, Side::Above(0.0));
    let outcome = solve(&embedding, &embedding.starts(1, 0)[0], &Options::default()).unwrap();
    assert!(
        outcome.termination.reached_tolerance(),
        "{:?}",
        outcome.termination
    );
    let truth = enumerate(&case.pencil, &Window::all()).unwrap();
    let value: f64 = truth.solutions[0].decimal(17).parse().unwrap();
    assert!(
        (embedding.candidate(&outcome.point).value - value).abs() < 1e-7
            && truth.solutions.len() == 1
    );
}

/// Ten fresh starts within the work of so many runs, and its work.
fn searched(case: &Case, budget: Option<usize>) -> (mceip_engine::multistart::Found, usize) {
    let admissible = Admissible::new(&case.pencil, case.unknown).unwrap();
    let search = Search {
        starts: 10,
        window_starts: 0,
        budget,
        ..Search::default()
    };
    let found = multistart(&case.problem(), &admissible, &search).unwrap();
    let work = found.pivots + found.factorisations;
    (found, work)
}

/// A budget in runs: the curves end, and the runs from fresh starts are all made.
#[test]
fn a_budget_ends_the_curves() {
    let [mut less, mut short] = [0; 2];
    for k in 0..6 {
        let case = random_case("mu", 10, 5, k);
        let [(free, without), (held, work)] = [None, Some(8)].map(|b| searched(&case, b));
        let (runs, plain) = held.plain;
        assert!(free.plain.0 == 5 && runs >= 5, "{runs}");
        // A run counts for n (n + 4) / 2 at least, however short the runs are. Beyond the end goes
        // what the steps left to the last curve cost above one factorisation each, and what its
        // solutions cost to polish.
        let (cost, least) = ((plain / runs).max(10 * 14 / 2), 8 * 10 * 14 / 2);
        assert!(
            work <= 8 * cost + 400,
            "{}: {work} of {}",
            case.label,
            8 * cost
        );
        assert!(
            work >= without.min(least),
            "{}: {work} of {without}",
            case.label
        );
        short += usize::from(plain / runs < 10 * 14 / 2 && without > least);
        less += usize::from(work < without);
    }
    assert!(less >= 2 && short >= 1, "{less} {short}");
}

/// Where a curve is as dear as many runs there are runs between curves, and only within a budget.
#[test]
fn dear_curves_make_room_for_runs() {
    let cases = table1_cases();
    let case = cases
        .iter()
        .find(|c| c.label.contains("phi=30 mu=12 S=(1,-1)"))
        .unwrap();
    let [(free, _), (held, work), (little, _)] =
        [None, Some(22), Some(2)].map(|b| searched(case, b));
    assert_eq!(
        (free.plain.0, free.certified.len(), held.certified.len()),
        (5, 3, 3)
    );
    // The runs cost one or two factorisations, a curve more than a hundred: all runs of the budget
    // come before it.
    assert_eq!(held.plain.0, 5 + 22);
    assert!(!held.curves.is_empty() && work < 22 * 6 + 40, "{work}");
    // However large a budget, the runs between curves are counted.
    let (vast, _) = searched(case, Some(usize::MAX));
    assert!(
        vast.plain.0 <= 5 + 64 && vast.certified.len() == 3,
        "{:?}",
        vast.plain
    );
    // A budget that the runs exceed buys nothing else.
    assert!(little.plain.0 >= 5 && little.plain.0 <= 5 + 2, "{little:?}");
}

#[test]
fn a_curve_through_a_solution_leads_to_others() {
    // The fold of spec/errata.md: lambda^2 = 2 and 3 with the same support.
    use mceip_exact::Sparse;
    use mceip_model::{Pencil, Unknown};
    let pencil = Pencil::new(
        Sparse::from_ints(&[&[1, -6], &[2, -6]]),
        Sparse::identity(2),
        vec![],
    )
    .unwrap();
    let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();
    let embedding = Embedding::new(&admissible, Side::Above(0.0));
    let known = embedding.point(2.0, &[2.0, 1.0]);
    let mut values = Vec::new();
    for sense in [Sense::Down, Sense::Up] {
        let r = embedding.direction(3, false);
        let curve =
            continuation_through(&embedding, &known, &r, sense, 4, &Options::default()).unwrap();
        values.extend(curve.solutions.iter().map(|z| embedding.candidate(z).value));
    }
    assert!(values.iter().any(|v| (v - 3.0).abs() < 1e-7), "{values:?}");
}
