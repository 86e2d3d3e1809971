//! Inputs that make no sense, and functions that return what they should not.
//!
//! The solver must answer each with a reason that names what was expected and what was got, and
//! keep the best finite point within the bounds. Problems are small enough to say by hand where a
//! step leads; random ones with the largest and smallest doubles must not make it panic.
#![cfg(feature = "solver")]

use crate::support::{murty, smooth};
use mceip_mcp::mcp::{FunctionMcp, LinearMcp, Mcp};
use mceip_mcp::solver::{
    NonFinite, Options, Outcome, SolverError, Termination, solve, solve_linear,
};
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

const INF: f64 = f64::INFINITY;

/// One unknown, x >= 0.
fn one_unknown<'a>(
    function: impl Fn(f64) -> f64 + 'a,
    derivative: impl Fn(f64) -> f64 + 'a,
) -> FunctionMcp<'a> {
    smooth(
        1,
        move |z, f| f[0] = function(z[0]),
        move |z, j| j[(0, 0)] = derivative(z[0]),
    )
}

/// Solves F(x) complementary to x >= 0 in one unknown.
fn solve_one(
    function: impl Fn(f64) -> f64,
    derivative: impl Fn(f64) -> f64,
    start: f64,
) -> Outcome {
    let problem = one_unknown(function, derivative);
    solve(&problem, &[start], &Options::default()).unwrap()
}

/// What is said of a problem that is refused.
fn refusal(problem: &impl Mcp, start: &[f64]) -> String {
    let error = solve(problem, start, &Options::default()).unwrap_err();
    error.to_string()
}

/// What is said of F = z in two unknowns with these bounds.
fn refusal_of_bounds(lower: &[f64], upper: &[f64]) -> String {
    let identity = |z: &[f64], f: &mut [f64]| f.copy_from_slice(z);
    let problem = FunctionMcp::new(lower.to_vec(), upper.to_vec(), identity);
    refusal(&problem, &[0.0; 2])
}

#[test]
fn refusals_name_index_expected_and_got() {
    let lcp = LinearMcp::lcp(dmatrix![1.0, 0.0; 0.0, 1.0], vec![-1.0; 2]).unwrap();

    // Starts.
    let short = refusal(&lcp, &[0.0]);
    assert_eq!(short, "expected a start of length 2, got 1");
    let not_a_number = refusal(&lcp, &[0.0, f64::NAN]);
    assert_eq!(not_a_number, "expected a finite start at 1, got NaN");
    let infinite = refusal(&lcp, &[INF, 0.0]);
    assert_eq!(infinite, "expected a finite start at 0, got inf");
    let long = refusal(&lcp, &[0.0; 3]);
    assert_eq!(long, "expected a start of length 2, got 3");

    // Options.
    let without_tolerance = Options {
        convergence_tolerance: 0.0,
        ..Options::default()
    };
    let refused = solve(&lcp, &[0.0; 2], &without_tolerance).unwrap_err();
    let words = "expected option convergence_tolerance > 0 and finite, got 0";
    assert_eq!(refused.to_string(), words);
    let SolverError::Option { name, .. } = refused else {
        panic!("{refused}")
    };
    assert_eq!(name, "convergence_tolerance");
    assert!(solve_linear(&lcp, &without_tolerance).is_err());

    // Bounds.
    let reversed = refusal_of_bounds(&[0.0, 2.0], &[1.0, 1.0]);
    assert_eq!(reversed, "expected lower <= upper at 1, got 2 and 1");
    let short = refusal_of_bounds(&[0.0, 0.0], &[1.0]);
    assert_eq!(short, "expected upper of length 2, got 1");
}

#[test]
fn values_that_are_not_finite_are_reasons() {
    let function = Termination::NonFinite(NonFinite::Function { row: 0 });
    let jacobian = Termination::NonFinite(NonFinite::Jacobian { row: 0, col: 0 });

    let outcome = solve_one(|_| f64::NAN, |_| 1.0, 1.0);
    assert_eq!(outcome.termination, function);
    let outcome = solve_one(|_| INF, |_| 1.0, 1.0);
    assert_eq!(outcome.termination, function);
    let outcome = solve_one(|x| x - 1.0, |_| f64::NAN, 3.0);
    assert_eq!(outcome.termination, jacobian);

    // Every step from the start leaves the domain, however short.
    let defined_at_three = |x| if x == 3.0 { -1.0 } else { f64::NAN };
    let outcome = solve_one(defined_at_three, |_| 1.0, 3.0);
    assert_eq!(outcome.termination, function);
}

/// log x = 0 from 5: the full Newton step leaves the domain.
#[test]
fn a_domain_is_respected_by_going_back() {
    let start = 5.0;
    let outcome = solve_one(f64::ln, |x| 1.0 / x, start);

    let error = (outcome.point[0] - 1.0).abs();
    assert!(error < 1e-10, "{outcome:?}");
}

#[test]
fn a_solution_at_infinity_is_none() {
    let start = 1.0;
    let outcome = solve_one(|x| 1.0 / x, |x| -1.0 / (x * x), start);

    let is_claimed = outcome.termination.reached_tolerance();
    assert!(!is_claimed, "{outcome:?}");
}

#[test]
fn a_wrong_jacobian_is_survived() {
    for wrong in [-1.0, 0.0, 1e300, 1e-300, 5e-324] {
        let outcome = solve_one(|x| x - 1.0, |_| wrong, 3.0);
        assert!(outcome.point[0].is_finite());
    }
}

/// F = z - 1 in two unknowns, with a Jacobian that is resized to this order.
fn solve_resizing(order: usize) -> Outcome {
    let problem = smooth(
        2,
        |z, f| f.copy_from_slice(&[z[0] - 1.0, z[1] - 1.0]),
        |_, j| *j = DMatrix::identity(order, order),
    );
    solve(&problem, &[3.0, 3.0], &Options::default()).unwrap()
}

#[test]
fn a_jacobian_of_the_wrong_shape_is_a_reason() {
    for order in [0, 1, 3] {
        let outcome = solve_resizing(order);
        let wrong_shape = Termination::JacobianShape {
            rows: order,
            cols: order,
        };
        assert_eq!(outcome.termination, wrong_shape);
        assert_eq!(outcome.point, vec![3.0; 2]);
    }

    let outcome = solve_resizing(2);
    assert_eq!(outcome.termination, Termination::ToleranceReached);
}

/// Free unknowns with F = (z0 + 1, z0 - 1): no row has z1. The reason names it, and the best point
/// is kept.
#[test]
fn a_structurally_singular_start_is_named() {
    let m = dmatrix![
        1.0, 0.0;
        1.0, 0.0
    ];
    let twice = LinearMcp::new(m, vec![1.0, -1.0], vec![-INF; 2], vec![INF; 2]).unwrap();
    let outcome = solve(&twice, &[5.0, 7.0], &Options::default()).unwrap();
    let singular = Termination::StructurallySingular { row: 1, col: 1 };
    assert_eq!(outcome.termination, singular);
    // The least merit is at z0 = 0.
    assert!(outcome.point[0].abs() < 0.5, "{outcome:?}");
    assert!(outcome.point[1].is_finite(), "{outcome:?}");

    // One bound is enough to make it solvable: F1 >= 0 at z1 = 0.
    let m = dmatrix![
        1.0, 0.0;
        -1.0, 0.0
    ];
    let bounded = LinearMcp::new(m, vec![1.0, -0.5], vec![-INF, 0.0], vec![INF; 2]).unwrap();
    let outcome = solve(&bounded, &[5.0, 7.0], &Options::default()).unwrap();
    assert!(outcome.termination.reached_tolerance());

    // A ray stays a ray, whatever the zeros.
    let ray = LinearMcp::lcp(dmatrix![0.0], vec![-1.0]).unwrap();
    let outcome = solve_linear(&ray, &Options::default()).unwrap();
    assert_eq!(outcome.termination, Termination::Ray);
}

/// A ray: the reason, and a point within the bounds.
fn assert_ends_on_a_ray(outcome: &Outcome) {
    assert_eq!(outcome.termination, Termination::Ray);
    assert!(outcome.point[0].is_finite());
    assert!(outcome.point[0] >= 0.0);
}

/// A ray and each limit: the reason, and a point that is the best one met, within the bounds.
#[test]
fn rays_and_limits_keep_the_best_point() {
    let infeasible = LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap();
    assert_ends_on_a_ray(&solve_linear(&infeasible, &Options::default()).unwrap());
    assert_ends_on_a_ray(&solve(&infeasible, &[2.0], &Options::default()).unwrap());

    // x^3 = 1 from far away: each step takes a third off, and fewer than it takes leave the point
    // nearer than the start.
    let cubic = one_unknown(|x| x * x * x - 1.0, |x| 3.0 * x * x);
    let three_majors = Options {
        crash_iteration_limit: 0,
        major_iteration_limit: 3,
        ..Options::default()
    };
    let outcome = solve(&cubic, &[1000.0], &three_majors).unwrap();
    assert_eq!(outcome.termination, Termination::MajorLimit);
    assert!(outcome.point[0] < 700.0, "{outcome:?}");
    assert!(outcome.point[0] > 1.0, "{outcome:?}");

    let three_pivots = Options {
        crash_iteration_limit: 0,
        cumulative_iteration_limit: 3,
        ..Options::default()
    };
    let outcome = solve(&cubic, &[1000.0], &three_pivots).unwrap();
    assert_eq!(outcome.termination, Termination::CumulativeLimit);
    assert!(outcome.point[0] < 1000.0, "{outcome:?}");
}

#[test]
fn every_limit_is_kept() {
    let hard = one_unknown(
        |x| (x - 2.0) * (x - 2.0) + 0.01 - 0.001 * x.sin(),
        |x| 2.0 * (x - 2.0) - 0.001 * x.cos(),
    );
    let lcp = LinearMcp::lcp(murty(6), vec![-1.0; 6]).unwrap();

    for limit in [1, 2, 7] {
        let few_majors = Options {
            major_iteration_limit: limit,
            ..Options::default()
        };
        let outcome = solve(&hard, &[1.0], &few_majors).unwrap();
        assert!(outcome.counters.majors <= limit);

        let few_pivots = Options {
            cumulative_iteration_limit: limit,
            ..Options::default()
        };
        let outcome = solve(&hard, &[1.0], &few_pivots).unwrap();
        assert!(outcome.counters.pivots <= limit);

        let few_minors = Options {
            minor_iteration_limit: limit,
            preprocess: false,
            ..Options::default()
        };
        let outcome = solve_linear(&lcp, &few_minors).unwrap();
        assert!(outcome.counters.pivots <= limit);
        assert!(limit > 1 || outcome.termination == Termination::MinorLimit);
    }
}

/// Any double that a linear MCP accepts, biased to corners.
fn entry() -> impl Strategy<Value = f64> {
    let extremes = vec![1e308, -1e308, 1e154, 1e-308, 5e-324, -5e-324, 1e16, -0.0];
    prop_oneof![
        4 => (-3i32..4).prop_map(f64::from),
        2 => -2.0..2.0,
        1 => prop::sample::select(extremes),
    ]
}

fn bounds() -> impl Strategy<Value = (f64, f64)> {
    prop::sample::select(vec![
        (0.0, INF),
        (-INF, INF),
        (-INF, 0.0),
        (0.0, 1.0),
        (1.0, 1.0),
        (-1e300, 1e300),
        (-2.0, INF),
    ])
}

fn many_cases() -> ProptestConfig {
    ProptestConfig {
        cases: 300,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// The point has its length and lies within the bounds; a claimed solution has its residual.
fn assert_makes_sense(outcome: &Outcome, lower: &[f64], upper: &[f64]) {
    assert_eq!(outcome.point.len(), lower.len());
    for i in 0..lower.len() {
        assert!(outcome.point[i] >= lower[i], "{outcome:?}");
        assert!(outcome.point[i] <= upper[i], "{outcome:?}");
    }
    if outcome.termination.reached_tolerance() {
        assert!(outcome.residuals.within(1e-10), "{outcome:?}");
    }
}

proptest! {
    #![proptest_config(many_cases())]

    #[test]
    fn no_linear_problem_makes_it_panic(
        n in 1usize..5,
        entries in prop::collection::vec(entry(), 30),
        sides in prop::collection::vec(bounds(), 5),
    ) {
        // Rows of five entries: those of M, the start of the second run, q.
        let m = DMatrix::from_fn(n, n, |i, j| entries[5 * i + j]);
        let start = &entries[20..20 + n];
        let q = entries[25..25 + n].to_vec();
        let (lower, upper): (Vec<f64>, Vec<f64>) = sides[..n].iter().copied().unzip();
        let problem = LinearMcp::new(m, q, lower.clone(), upper.clone()).unwrap();
        let options = Options {
            major_iteration_limit: 60,
            ..Options::default()
        };

        let linear = solve_linear(&problem, &options).unwrap();
        assert_makes_sense(&linear, &lower, &upper);
        let general = solve(&problem, start, &options).unwrap();
        assert_makes_sense(&general, &lower, &upper);
    }
}
