//! Lemke's method on linear problems whose solution is unique or known by construction.
//!
//! The truth: an LCP with a P matrix has exactly one solution, found here by trying all supports; a
//! bounded box always has one; a semidefinite problem with a feasible point is processed. The path
//! itself must rise from t = 0 to 1 and never fall.
#![cfg(feature = "solver")]

use crate::support::{definite, normal, normal_matrix};
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{Options, Outcome, PathEnd, Start, Termination, solve, solve_linear};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A complete path: t from 0 to 1 and never falling.
fn assert_rises_to_one(outcome: &Outcome) {
    let last_step = outcome.log.last().unwrap();
    let path = last_step.paths.last().unwrap();
    assert_eq!(path.start, Start::Ray);
    assert_eq!(path.end, PathEnd::Complete);
    assert_eq!(path.reach, 1.0);

    let t: Vec<f64> = path.pivots.iter().map(|pivot| pivot.t).collect();
    assert!(t[0] >= 0.0);
    assert_eq!(t[t.len() - 1], 1.0);
    assert!(t.windows(2).all(|w| w[0] <= w[1] + 1e-9), "{t:?}");
}

fn normal_vector(rng: &mut ChaCha8Rng, n: usize) -> Vec<f64> {
    (0..n).map(|_| normal(rng)).collect()
}

/// A small integer as a double.
fn random_integer(rng: &mut ChaCha8Rng, from: i32, below: i32) -> f64 {
    f64::from(rng.random_range(from..below))
}

/// Triangular with a positive diagonal: what lies below the diagonal is dropped.
fn upper_triangle(g: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(g.nrows(), g.ncols(), |i, j| {
        if i == j {
            0.5 + g[(i, i)].abs()
        } else if j > i {
            g[(i, j)]
        } else {
            0.0
        }
    })
}

/// The diagonal replaced, so that it dominates each row.
fn with_dominant_diagonal(g: &DMatrix<f64>) -> DMatrix<f64> {
    let mut h = g.clone();
    for i in 0..g.nrows() {
        let row_sum: f64 = g.row(i).iter().map(|v| v.abs()).sum();
        h[(i, i)] = row_sum + 0.1;
    }
    h
}

/// A definite matrix plus a skew one.
fn definite_plus_skew(rng: &mut ChaCha8Rng, n: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    definite(rng, n) + (&g - g.transpose())
}

/// P matrices of three kinds: definite plus skew, triangular with positive diagonal, and H
/// matrices.
fn p_matrix(rng: &mut ChaCha8Rng, n: usize, kind: usize) -> DMatrix<f64> {
    match kind {
        0 => definite_plus_skew(rng, n),
        1 => upper_triangle(&normal_matrix(rng, n)),
        _ => with_dominant_diagonal(&normal_matrix(rng, n)),
    }
}

/// z with z = 0 off the support and Mz + q = 0 on it.
fn vertex(m: &DMatrix<f64>, q: &[f64], support: &[usize]) -> DVector<f64> {
    let mut z = DVector::zeros(q.len());
    if support.is_empty() {
        return z;
    }

    let order = support.len();
    let block = DMatrix::from_fn(order, order, |i, j| m[(support[i], support[j])]);
    let right = DVector::from_fn(order, |i, _| -q[support[i]]);
    let part = block.lu().solve(&right).unwrap();
    for (&i, value) in support.iter().zip(part.iter()) {
        z[i] = *value;
    }
    z
}

/// The only solution of an LCP with a P matrix, by trying all supports.
fn solve_by_enumeration(m: &DMatrix<f64>, q: &[f64]) -> DVector<f64> {
    let n = q.len();
    for pattern in 0u32..1 << n {
        let support: Vec<usize> = (0..n).filter(|i| pattern >> i & 1 == 1).collect();
        let z = vertex(m, q, &support);
        let w = m * &z + DVector::from_column_slice(q);

        let z_fits = z.iter().all(|v| *v >= -1e-12);
        let w_fits = w.iter().all(|v| *v >= -1e-9);
        if z_fits && w_fits {
            return z;
        }
    }
    unreachable!("a P matrix has a solution for every q")
}

#[test]
fn larger_problems_keep_their_digits() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);

    for n in [30, 60, 120] {
        let m = definite_plus_skew(&mut rng, n);
        let q = normal_vector(&mut rng, n);
        let problem = LinearMcp::lcp(m, q).unwrap();

        let outcome = solve_linear(&problem, &Options::default()).unwrap();

        assert_rises_to_one(&outcome);
        let residuals = &outcome.residuals;
        assert!(residuals.within(1e-12), "n = {n}: {residuals:?}");
    }
}

/// Is each component within 1e-7 of the truth, relative to its largest?
fn is_near(point: &[f64], truth: &DVector<f64>) -> bool {
    let tolerance = 1e-7 * (1.0 + truth.amax());
    let mut pairs = point.iter().zip(truth.iter());
    pairs.all(|(found, expected)| (found - expected).abs() < tolerance)
}

/// M = G G' of rank about n/2 plus skew; q made so that a solution exists. Degenerate on purpose.
fn semidefinite_problem(rng: &mut ChaCha8Rng, n: usize) -> LinearMcp {
    let rank = n.div_ceil(2);
    let g = DMatrix::from_fn(n, rank, |_, _| random_integer(rng, -2, 3));
    let skew = DMatrix::from_fn(n, n, |_, _| random_integer(rng, -1, 2));
    let m = &g * g.transpose() + &skew - skew.transpose();

    let z = DVector::from_fn(n, |_, _| random_integer(rng, 0, 3));
    let w = DVector::from_fn(n, |i, _| {
        if z[i] > 0.0 {
            0.0
        } else {
            random_integer(rng, 0, 3)
        }
    });
    let q = w - &m * z;
    LinearMcp::lcp(m, q.as_slice().to_vec()).unwrap()
}

fn many_cases() -> ProptestConfig {
    ProptestConfig {
        cases: 200,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(many_cases())]

    /// Lemke's method, and Newton's from anywhere: one regular path is enough, since the Newton
    /// point of a linear problem solves it.
    #[test]
    fn p_matrices_give_the_only_solution_along_a_rising_path(
        seed in any::<u64>(),
        n in 1usize..8,
        kind in 0usize..3,
    ) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = p_matrix(&mut rng, n, kind);
        let q = normal_vector(&mut rng, n);
        let start = normal_vector(&mut rng, n);
        let truth = solve_by_enumeration(&m, &q);
        let problem = LinearMcp::lcp(m, q).unwrap();

        let lemke = solve_linear(&problem, &Options::default()).unwrap();
        prop_assert_eq!(lemke.termination, Termination::ToleranceReached);
        assert_rises_to_one(&lemke);
        prop_assert!(is_near(&lemke.point, &truth), "{:?} {}", lemke.point, truth);

        let without_crash = Options {
            crash_iteration_limit: 0,
            ..Options::default()
        };
        let newton = solve(&problem, &start, &without_crash).unwrap();
        prop_assert!(is_near(&newton.point, &truth), "{:?} {}", newton.point, truth);
        prop_assert!(newton.counters.majors <= 2, "{:?}", newton.counters);
    }

    /// Any M on a bounded box: Lemke cannot end on a ray.
    #[test]
    fn boxes_always_have_a_solution(seed in any::<u64>(), n in 1usize..8) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = normal_matrix(&mut rng, n);
        let q = normal_vector(&mut rng, n);
        let problem = LinearMcp::new(m, q, vec![-1.0; n], vec![1.0; n]).unwrap();

        let outcome = solve_linear(&problem, &Options::default()).unwrap();

        let termination = outcome.termination;
        prop_assert_eq!(termination, Termination::ToleranceReached, "{:?}", outcome);
    }

    #[test]
    fn small_integers_tie_but_do_not_cycle(seed in any::<u64>(), n in 1usize..9) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = DMatrix::from_fn(n, n, |_, _| random_integer(&mut rng, -1, 2));
        let q: Vec<f64> = (0..n).map(|_| random_integer(&mut rng, -1, 2)).collect();
        let problem = LinearMcp::lcp(m, q).unwrap();

        let outcome = solve_linear(&problem, &Options::default()).unwrap();

        let expected = [Termination::ToleranceReached, Termination::Ray];
        prop_assert!(expected.contains(&outcome.termination), "{:?}", outcome);
    }

    #[test]
    fn semidefinite_problems_with_a_solution_are_solved(seed in any::<u64>(), n in 1usize..8) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let problem = semidefinite_problem(&mut rng, n);

        let outcome = solve_linear(&problem, &Options::default()).unwrap();

        let termination = outcome.termination;
        prop_assert_eq!(termination, Termination::ToleranceReached, "{:?}", outcome);
    }
}
