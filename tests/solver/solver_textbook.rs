//! Linear problems with known answers, and the special cases on which LCP codes fail. Nonlinear
//! problems of the literature are in `crates/mcp/tests/mcplib.rs`.
//!
//! The truth are the published solutions, or those of a problem small enough to solve by hand. Each
//! linear problem is solved by Lemke's method and by the outer loop from several starts, under both
//! rules of the ratio test; all must end at the same point.
#![cfg(feature = "solver")]

#[path = "../../crates/mcp/examples/kojima_shindo.rs"]
#[allow(unreachable_pub, dead_code, reason = "a program of its own")]
mod kojima_shindo;

use mceip_mcp::mcp::{FunctionMcp, LinearMcp};
use mceip_mcp::solver::{
    Options, Outcome, PathEnd, PivotKind, RatioTest, Termination, solve, solve_linear,
};
use nalgebra::{DMatrix, dmatrix};

const INF: f64 = f64::INFINITY;

fn lcp(m: DMatrix<f64>, q: &[f64]) -> LinearMcp {
    LinearMcp::lcp(m, q.to_vec()).unwrap()
}

fn with_bounds(m: DMatrix<f64>, q: &[f64], lower: &[f64], upper: &[f64]) -> LinearMcp {
    LinearMcp::new(m, q.to_vec(), lower.to_vec(), upper.to_vec()).unwrap()
}

/// The outcome is this solution, within the tolerance.
fn assert_solves(outcome: &Outcome, expected: &[f64]) {
    let termination = &outcome.termination;
    assert_eq!(*termination, Termination::ToleranceReached, "{outcome:?}");
    assert!(outcome.residuals.within(1e-10));

    let point = &outcome.point;
    for (found, wanted) in point.iter().zip(expected) {
        let error = (found - wanted).abs();
        assert!(error < 1e-8, "{point:?} instead of {expected:?}");
    }
}

/// Lemke, and the outer loop from several starts, must agree under both rules of the ratio test,
/// with the bounds' decisions taken first or not.
fn assert_all_methods_solve(problem: &LinearMcp, expected: &[f64]) {
    let settings = [
        (RatioTest::Lexicographic, true),
        (RatioTest::Expand, false),
        (RatioTest::Lexicographic, false),
    ];
    for (ratio_test, preprocess) in settings {
        let options = Options {
            ratio_test,
            preprocess,
            ..Options::default()
        };
        let lemke = solve_linear(problem, &options).unwrap();
        assert_solves(&lemke, expected);

        for component in [0.0, 1.0, -3.0, 100.0] {
            let start = vec![component; expected.len()];
            let outcome = solve(problem, &start, &options).unwrap();
            assert_solves(&outcome, expected);
        }
    }
}

#[test]
fn one_by_one() {
    let two = || dmatrix![2.0];

    // z >= 0.
    assert_all_methods_solve(&lcp(two(), &[-3.0]), &[1.5]);
    assert_all_methods_solve(&lcp(two(), &[3.0]), &[0.0]);
    assert_all_methods_solve(&lcp(two(), &[0.0]), &[0.0]);

    let two_sided = with_bounds(two(), &[-3.0], &[0.0], &[1.0]);
    assert_all_methods_solve(&two_sided, &[1.0]);

    let free = with_bounds(two(), &[-3.0], &[-INF], &[INF]);
    assert_all_methods_solve(&free, &[1.5]);

    let bounded_above = with_bounds(two(), &[3.0], &[-INF], &[4.0]);
    assert_all_methods_solve(&bounded_above, &[-1.5]);

    let fixed = with_bounds(dmatrix![0.0], &[3.0], &[7.0], &[7.0]);
    assert_all_methods_solve(&fixed, &[7.0]);
}

#[test]
fn no_unknowns_at_all() {
    let empty = lcp(DMatrix::zeros(0, 0), &[]);
    let options = Options::default();

    let outcome = solve(&empty, &[], &options).unwrap();
    assert_solves(&outcome, &[]);
    let lemke = solve_linear(&empty, &options).unwrap();
    assert_solves(&lemke, &[]);
}

#[test]
fn a_degenerate_lcp_ends_at_its_solution() {
    // w = z = 0 in both components.
    let both_zero = lcp(dmatrix![2.0, 1.0; 1.0, 2.0], &[0.0, 0.0]);
    assert_all_methods_solve(&both_zero, &[0.0, 0.0]);

    // z = (1, 0) with F_2 = 0.
    let second_zero = lcp(dmatrix![1.0, 1.0; 1.0, 2.0], &[-1.0, -1.0]);
    assert_all_methods_solve(&second_zero, &[1.0, 0.0]);
}

#[test]
fn murty() {
    for n in 4..=6 {
        let problem = lcp(crate::support::murty(n), &vec![-1.0; n]);
        let mut expected = vec![0.0; n];
        expected[n - 1] = 1.0;

        assert_all_methods_solve(&problem, &expected);
    }
}

#[test]
fn ties_do_not_cycle() {
    // Cottle, Pang and Stone: ties in every ratio test, the classic cyclic example.
    let m = dmatrix![
        1.0, 2.0, 0.0;
        0.0, 1.0, 2.0;
        2.0, 0.0, 1.0
    ];
    let cyclic = lcp(m, &[-1.0; 3]);
    assert_all_methods_solve(&cyclic, &[1.0 / 3.0; 3]);

    // Equal rows: every w is tied with every other at every pivot.
    let n = 8;
    let ones = lcp(DMatrix::from_element(n, n, 1.0), &vec![-1.0; n]);
    let outcome = solve_linear(&ones, &Options::default()).unwrap();
    assert_eq!(outcome.termination, Termination::ToleranceReached);
    let sum: f64 = outcome.point.iter().sum();
    assert!((sum - 1.0).abs() < 1e-12);
}

#[test]
fn two_sided_bounds() {
    let m = dmatrix![
        2.0, 0.5, 0.0;
        0.0, 1.0, 0.3;
        0.1, 0.0, 1.0
    ];
    let q = [-9.0, 5.0, -0.5];
    let problem = with_bounds(m, &q, &[0.0; 3], &[1.0; 3]);
    assert_all_methods_solve(&problem, &[1.0, 0.0, 0.4]);

    // Indefinite: several solutions, each a vertex; whatever is reported is one.
    let m = dmatrix![
        -1.0, 0.0;
        0.0, -1.0
    ];
    let saddle = with_bounds(m, &[0.5, 0.5], &[0.0; 2], &[1.0; 2]);
    let starts = [vec![0.0, 0.0], vec![1.0, 0.0], vec![0.3, 0.8]];
    for start in starts {
        let outcome = solve(&saddle, &start, &Options::default()).unwrap();
        assert!(outcome.residuals.within(1e-10), "{outcome:?}");
    }
}

#[test]
fn free_unknowns() {
    // min (x - 3)^2 / 2 with x <= 1: x free, multiplier >= 0.
    let m = dmatrix![
        1.0, 1.0;
        -1.0, 0.0
    ];
    let optimality = with_bounds(m, &[-3.0, 1.0], &[-INF, 0.0], &[INF; 2]);
    assert_all_methods_solve(&optimality, &[1.0, 2.0]);

    // A linear system, with zero diagonal.
    let m = dmatrix![
        0.0, 2.0;
        1.0, 1.0
    ];
    let system = with_bounds(m, &[-4.0, -5.0], &[-INF; 2], &[INF; 2]);
    assert_all_methods_solve(&system, &[3.0, 2.0]);
}

#[test]
fn equal_bounds() {
    let m = dmatrix![
        1.0, 1.0, 0.0;
        1.0, 2.0, 0.0;
        0.0, 0.0, 1.0
    ];
    let lower = [1.0, 0.0, -1.0];
    let upper = [1.0, INF, -1.0];
    let problem = with_bounds(m, &[-9.0, -4.0, 2.0], &lower, &upper);

    assert_all_methods_solve(&problem, &[1.0, 1.5, -1.0]);
}

#[test]
fn an_infeasible_lcp_ends_on_a_ray() {
    let infeasible = lcp(dmatrix![-1.0], &[-1.0]);

    let lemke = solve_linear(&infeasible, &Options::default()).unwrap();
    assert_eq!(lemke.termination, Termination::Ray);
    assert_eq!(lemke.log[0].paths[0].end, PathEnd::Ray);

    let outcome = solve(&infeasible, &[0.0], &Options::default()).unwrap();
    assert!(!outcome.termination.reached_tolerance());
    assert!(!outcome.residuals.within(1e-3));
}

/// Is the point 1 or -1?
fn assert_solves_square(outcome: &Outcome) {
    let magnitude = outcome.point[0].abs();
    assert!((magnitude - 1.0).abs() < 1e-10, "{outcome:?}");
}

#[test]
fn singular_starts() {
    let without_crash = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };

    // The matrix of ones: singular basis wherever both are inside; a whole edge of solutions.
    let ones = lcp(dmatrix![1.0, 1.0; 1.0, 1.0], &[-1.0, -1.0]);
    let outcome = solve(&ones, &[2.0, 3.0], &without_crash).unwrap();
    let sum = outcome.point[0] + outcome.point[1];
    assert!((sum - 1.0).abs() < 1e-10, "{outcome:?}");
    let mut pivots = outcome.trace();
    assert!(pivots.any(|pivot| pivot.kind == PivotKind::ArtificialLeaves));

    // x^2 = 1 for a free x, from x = 0: stationary for every merit, and F' is zero; the point along
    // the ray leaves it.
    let square = FunctionMcp::new(vec![-INF], vec![INF], |z, f| f[0] = z[0] * z[0] - 1.0)
        .with_jacobian(|z, j| j[(0, 0)] = 2.0 * z[0]);
    let outcome = solve(&square, &[0.0], &Options::default()).unwrap();
    assert_solves_square(&outcome);
    let outcome = solve(&square, &[0.0], &without_crash).unwrap();
    assert_solves_square(&outcome);
    assert_eq!(outcome.log[0].paths[0].end, PathEnd::Ray);
}

#[test]
fn the_log_tells_the_whole_run() {
    let problem = kojima_shindo::problem();
    let start = [0.0, 5.0, 0.0, 5.0];
    let outcome = solve(&problem, &start, &Options::default()).unwrap();

    let mut pivots = 0;
    for pivot in outcome.trace() {
        assert!(pivot.t <= 1.0);
        pivots += 1;
    }
    assert_eq!(pivots, outcome.counters.pivots);

    let mut steps_with_paths = 0;
    for step in &outcome.log {
        steps_with_paths += usize::from(!step.paths.is_empty());
    }
    assert_eq!(steps_with_paths, outcome.counters.majors);
}
