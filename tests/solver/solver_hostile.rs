//! Inputs that make no sense, and functions that return what they should not: reasons, no panics.
#![cfg(feature = "solver")]

use mceip_mcp::mcp::{LinearMcp, Mcp};
use mceip_mcp::solver::{
    NonFinite, Options, SolverError, Termination, multistart, solve, solve_linear,
};
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

const INF: f64 = f64::INFINITY;

/// One unknown, x >= 0, with F and F' from closures.
struct One<F, J>(F, J);

impl<F: Fn(f64) -> f64, J: Fn(f64) -> f64> Mcp for One<F, J> {
    fn dimension(&self) -> usize {
        1
    }
    fn lower(&self) -> &[f64] {
        &[0.0]
    }
    fn upper(&self) -> &[f64] {
        &[INF]
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        f[0] = self.0(z[0]);
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        j[(0, 0)] = self.1(z[0]);
    }
}

/// Bounds as given, F = z.
struct Bounds(Vec<f64>, Vec<f64>);

impl Mcp for Bounds {
    fn dimension(&self) -> usize {
        2
    }
    fn lower(&self) -> &[f64] {
        &self.0
    }
    fn upper(&self) -> &[f64] {
        &self.1
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        f.copy_from_slice(z);
    }
    fn jacobian(&self, _z: &[f64], j: &mut DMatrix<f64>) {
        j.fill_with_identity();
    }
}

fn reason<F: Fn(f64) -> f64, J: Fn(f64) -> f64>(f: F, j: J, start: f64) -> Termination {
    solve(&One(f, j), &[start], &Options::default())
        .unwrap()
        .termination
}

#[test]
fn refusals_name_index_expected_and_got() {
    let lcp = LinearMcp::lcp(dmatrix![1.0, 0.0; 0.0, 1.0], vec![-1.0; 2]).unwrap();
    let run = |start: &[f64]| {
        solve(&lcp, start, &Options::default())
            .unwrap_err()
            .to_string()
    };
    assert_eq!(run(&[0.0]), "expected a start of length 2, got 1");
    assert_eq!(
        run(&[0.0, f64::NAN]),
        "expected a finite start at 1, got NaN"
    );
    assert_eq!(run(&[INF, 0.0]), "expected a finite start at 0, got inf");
    let wrong = Options {
        convergence_tolerance: 0.0,
        ..Options::default()
    };
    let refused = solve(&lcp, &[0.0; 2], &wrong).unwrap_err();
    assert!(matches!(
        refused,
        SolverError::Option {
            name: "convergence_tolerance",
            ..
        }
    ));
    assert_eq!(
        refused.to_string(),
        "expected option convergence_tolerance > 0 and finite, got 0"
    );
    assert!(solve_linear(&lcp, &wrong).is_err());
    let bounds = |l: &[f64], u: &[f64]| {
        solve(
            &Bounds(l.to_vec(), u.to_vec()),
            &[0.0; 2],
            &Options::default(),
        )
    };
    assert_eq!(
        bounds(&[0.0, 2.0], &[1.0, 1.0]).unwrap_err().to_string(),
        "expected lower <= upper at 1, got 2 and 1"
    );
    assert_eq!(
        bounds(&[0.0], &[1.0, 1.0]).unwrap_err().to_string(),
        "expected lower of length 2, got 1"
    );
    assert!(multistart(&lcp, [vec![0.0; 2], vec![0.0; 3]], &Options::default()).is_err());
}

#[test]
fn values_that_are_not_finite_are_reasons() {
    let function = Termination::NonFinite(NonFinite::Function { row: 0 });
    let jacobian = Termination::NonFinite(NonFinite::Jacobian { row: 0, col: 0 });
    assert_eq!(reason(|_| f64::NAN, |_| 1.0, 1.0), function);
    assert_eq!(reason(|_| INF, |_| 1.0, 1.0), function);
    assert_eq!(reason(|x| x - 1.0, |_| f64::NAN, 3.0), jacobian);
    // Every step from the start leaves the domain, however short.
    assert_eq!(
        reason(|x| if x == 3.0 { -1.0 } else { f64::NAN }, |_| 1.0, 3.0),
        function
    );
}

#[test]
fn a_domain_is_respected_by_going_back() {
    // log x = 0 from 5: the full Newton step leaves the domain.
    let outcome = solve(&One(f64::ln, |x| 1.0 / x), &[5.0], &Options::default()).unwrap();
    assert!((outcome.point[0] - 1.0).abs() < 1e-10, "{outcome:?}");
}

#[test]
fn a_solution_at_infinity_is_none() {
    let outcome = solve(
        &One(|x| 1.0 / x, |x| -1.0 / (x * x)),
        &[1.0],
        &Options::default(),
    )
    .unwrap();
    assert!(!outcome.termination.reached_tolerance(), "{outcome:?}");
}

#[test]
fn a_wrong_jacobian_is_survived() {
    for wrong in [-1.0, 0.0, 1e300, 1e-300, 5e-324] {
        let outcome = solve(&One(|x| x - 1.0, |_| wrong), &[3.0], &Options::default()).unwrap();
        assert!(outcome.point[0].is_finite());
    }
}

/// F = z - 1 in two unknowns, with a Jacobian that is resized.
struct Resizing(usize);

impl Mcp for Resizing {
    fn dimension(&self) -> usize {
        2
    }
    fn lower(&self) -> &[f64] {
        &[0.0; 2]
    }
    fn upper(&self) -> &[f64] {
        &[INF; 2]
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        f[0] = z[0] - 1.0;
        f[1] = z[1] - 1.0;
    }
    fn jacobian(&self, _z: &[f64], j: &mut DMatrix<f64>) {
        *j = DMatrix::identity(self.0, self.0);
    }
}

#[test]
fn a_jacobian_of_the_wrong_shape_is_a_reason() {
    let run = |size| solve(&Resizing(size), &[3.0, 3.0], &Options::default()).unwrap();
    for size in [0, 1, 3] {
        let outcome = run(size);
        assert_eq!(
            outcome.termination,
            Termination::JacobianShape {
                rows: size,
                cols: size
            }
        );
        assert_eq!(outcome.point, vec![3.0; 2]);
    }
    assert_eq!(run(2).termination, Termination::ToleranceReached);
}

/// Free unknowns with F = (z0 + 1, z0 - 1): no row has z1. The reason names it, and the best point
/// is kept.
#[test]
fn a_structurally_singular_start_is_named() {
    let twice = LinearMcp::new(
        dmatrix![1.0, 0.0; 1.0, 0.0],
        vec![1.0, -1.0],
        vec![-INF; 2],
        vec![INF; 2],
    )
    .unwrap();
    let outcome = solve(&twice, &[5.0, 7.0], &Options::default()).unwrap();
    assert_eq!(
        outcome.termination,
        Termination::StructurallySingular { row: 1, col: 1 }
    );
    // The least merit is at z0 = 0.
    assert!(
        outcome.point[0].abs() < 0.5 && outcome.point[1].is_finite(),
        "{outcome:?}"
    );
    // One bound is enough to make it solvable: F1 >= 0 at z1 = 0.
    let bounded = LinearMcp::new(
        dmatrix![1.0, 0.0; -1.0, 0.0],
        vec![1.0, -0.5],
        vec![-INF, 0.0],
        vec![INF; 2],
    )
    .unwrap();
    assert!(
        solve(&bounded, &[5.0, 7.0], &Options::default())
            .unwrap()
            .termination
            .reached_tolerance()
    );
    // A ray stays a ray, whatever the zeros.
    let ray = LinearMcp::lcp(dmatrix![0.0], vec![-1.0]).unwrap();
    assert_eq!(
        solve_linear(&ray, &Options::default()).unwrap().termination,
        Termination::Ray
    );
}

/// A ray and each limit: the reason, and a point that is the best one met, within the bounds.
#[test]
fn rays_and_limits_keep_the_best_point() {
    let infeasible = LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap();
    for outcome in [
        solve_linear(&infeasible, &Options::default()).unwrap(),
        solve(&infeasible, &[2.0], &Options::default()).unwrap(),
    ] {
        assert_eq!(outcome.termination, Termination::Ray);
        assert!(outcome.point[0].is_finite() && outcome.point[0] >= 0.0);
    }
    // x^3 = 1 from far away: each step takes a third off, and fewer than it takes leave the point
    // nearer than the start.
    let cubic = One(|x: f64| x * x * x - 1.0, |x: f64| 3.0 * x * x);
    let none = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };
    let majors = solve(
        &cubic,
        &[1000.0],
        &Options {
            major_iteration_limit: 3,
            ..none.clone()
        },
    )
    .unwrap();
    assert_eq!(majors.termination, Termination::MajorLimit);
    assert!(
        majors.point[0] < 700.0 && majors.point[0] > 1.0,
        "{majors:?}"
    );
    let pivots = solve(
        &cubic,
        &[1000.0],
        &Options {
            cumulative_iteration_limit: 3,
            ..none
        },
    )
    .unwrap();
    assert_eq!(pivots.termination, Termination::CumulativeLimit);
    assert!(pivots.point[0] < 1000.0, "{pivots:?}");
}

#[test]
fn every_limit_is_kept() {
    let hard = One(
        |x: f64| (x - 2.0) * (x - 2.0) + 0.01 - 0.001 * x.sin(),
        |x: f64| 2.0 * (x - 2.0) - 0.001 * x.cos(),
    );
    for limit in [1, 2, 7] {
        let options = Options {
            major_iteration_limit: limit,
            ..Options::default()
        };
        assert!(solve(&hard, &[1.0], &options).unwrap().counters.majors <= limit);
        let options = Options {
            cumulative_iteration_limit: limit,
            ..Options::default()
        };
        assert!(solve(&hard, &[1.0], &options).unwrap().counters.pivots <= limit);
        let murty = DMatrix::from_fn(6, 6, |i, j| {
            if i == j {
                1.0
            } else if j > i {
                2.0
            } else {
                0.0
            }
        });
        let lcp = LinearMcp::lcp(murty, vec![-1.0; 6]).unwrap();
        let options = Options {
            minor_iteration_limit: limit,
            preprocess: false,
            ..Options::default()
        };
        let outcome = solve_linear(&lcp, &options).unwrap();
        assert!(
            outcome.counters.pivots <= limit
                && (limit > 1 || outcome.termination == Termination::MinorLimit)
        );
    }
}

/// Any double that a linear MCP accepts, biased to corners.
fn entry() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-3i32..4).prop_map(f64::from),
        2 => -2.0..2.0,
        1 => prop::sample::select(vec![1e308, -1e308, 1e154, 1e-308, 5e-324, -5e-324, 1e16, -0.0]),
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

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_linear_problem_makes_it_panic(
        n in 1usize..5,
        entries in prop::collection::vec(entry(), 30),
        sides in prop::collection::vec(bounds(), 5),
    ) {
        let m = DMatrix::from_fn(n, n, |i, j| entries[5 * i + j]);
        let q = entries[25..25 + n].to_vec();
        let (lower, upper): (Vec<f64>, Vec<f64>) = sides[..n].iter().copied().unzip();
        let problem = LinearMcp::new(m, q, lower.clone(), upper.clone()).unwrap();
        let options = Options { major_iteration_limit: 60, ..Options::default() };
        for outcome in [solve_linear(&problem, &options).unwrap(), solve(&problem, &entries[20..20 + n], &options).unwrap()] {
            prop_assert_eq!(outcome.point.len(), n);
            for i in 0..n {
                prop_assert!(outcome.point[i] >= lower[i] && outcome.point[i] <= upper[i], "{:?}", outcome);
            }
            if outcome.termination.reached_tolerance() {
                prop_assert!(outcome.residuals.within(1e-10), "{:?}", outcome);
            }
        }
    }
}
