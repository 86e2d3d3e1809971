//! Lemke's method on problems whose solution is unique or known by construction.
#![cfg(feature = "solver")]

use crate::support::{definite, normal, normal_matrix};
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{Options, Outcome, PathEnd, Start, Termination, solve, solve_linear};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A complete path: t from 0 to 1 and never falling.
fn rises_to_one(outcome: &Outcome) {
    let path = outcome.log.last().and_then(|r| r.paths.last()).unwrap();
    assert_eq!(
        (path.start, path.end, path.reach),
        (Start::Ray, PathEnd::Complete, 1.0)
    );
    let t: Vec<f64> = path.pivots.iter().map(|p| p.t).collect();
    assert!(t[0] >= 0.0 && t[t.len() - 1] == 1.0);
    assert!(t.windows(2).all(|w| w[0] <= w[1] + 1e-9), "{t:?}");
}

/// P matrices of three kinds: definite plus skew, triangular with positive diagonal, and H
/// matrices.
fn p_matrix(rng: &mut ChaCha8Rng, n: usize, kind: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    match kind {
        0 => definite(rng, n) + (&g - g.transpose()),
        1 => DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                0.5 + g[(i, i)].abs()
            } else if j > i {
                g[(i, j)]
            } else {
                0.0
            }
        }),
        _ => {
            let mut h = g.clone();
            (0..n).for_each(|i| h[(i, i)] = g.row(i).iter().map(|v| v.abs()).sum::<f64>() + 0.1);
            h
        }
    }
}

/// The only solution of an LCP with a P matrix, by trying all supports.
fn by_enumeration(m: &DMatrix<f64>, q: &[f64]) -> DVector<f64> {
    let n = q.len();
    for mask in 0u32..1 << n {
        let support: Vec<usize> = (0..n).filter(|i| mask >> i & 1 == 1).collect();
        let mut z = DVector::zeros(n);
        if !support.is_empty() {
            let block = DMatrix::from_fn(support.len(), support.len(), |i, j| {
                m[(support[i], support[j])]
            });
            let right = DVector::from_fn(support.len(), |i, _| -q[support[i]]);
            let part = block.lu().solve(&right).unwrap();
            support
                .iter()
                .zip(part.iter())
                .for_each(|(&i, v)| z[i] = *v);
        }
        let w = m * &z + DVector::from_column_slice(q);
        if z.iter().all(|v| *v >= -1e-12) && w.iter().all(|v| *v >= -1e-9) {
            return z;
        }
    }
    unreachable!("a P matrix has a solution for every q")
}

#[test]
fn larger_problems_keep_their_digits() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    for n in [30, 60, 120] {
        let g = normal_matrix(&mut rng, n);
        let m = definite(&mut rng, n) + (&g - g.transpose());
        let q: Vec<f64> = (0..n).map(|_| normal(&mut rng)).collect();
        let outcome = solve_linear(&LinearMcp::lcp(m, q).unwrap(), &Options::default()).unwrap();
        rises_to_one(&outcome);
        assert!(
            outcome.residuals.within(1e-12),
            "n = {n}: {:?}",
            outcome.residuals
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn p_matrices_give_the_only_solution_along_a_rising_path(seed in any::<u64>(), n in 1usize..8, kind in 0usize..3) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = p_matrix(&mut rng, n, kind);
        let q: Vec<f64> = (0..n).map(|_| normal(&mut rng)).collect();
        let problem = LinearMcp::lcp(m.clone(), q.clone()).unwrap();
        let truth = by_enumeration(&m, &q);
        let outcome = solve_linear(&problem, &Options::default()).unwrap();
        prop_assert_eq!(outcome.termination, Termination::ToleranceReached);
        rises_to_one(&outcome);
        let start: Vec<f64> = (0..n).map(|_| normal(&mut rng)).collect();
        let newton = solve(&problem, &start, &Options { crash_iteration_limit: 0, ..Options::default() }).unwrap();
        for point in [&outcome.point, &newton.point] {
            for i in 0..n {
                prop_assert!((point[i] - truth[i]).abs() < 1e-7 * (1.0 + truth.amax()), "{:?} {}", point, truth);
            }
        }
        // From anywhere, one regular path is enough: the Newton point of a linear problem solves
        // it.
        prop_assert!(newton.counters.majors <= 2, "{:?}", newton.counters);
    }

    #[test]
    fn boxes_always_have_a_solution(seed in any::<u64>(), n in 1usize..8) {
        // Any M on a bounded box: Lemke cannot end on a ray.
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let (m, q) = (normal_matrix(&mut rng, n), (0..n).map(|_| normal(&mut rng)).collect());
        let problem = LinearMcp::new(m, q, vec![-1.0; n], vec![1.0; n]).unwrap();
        let outcome = solve_linear(&problem, &Options::default()).unwrap();
        prop_assert_eq!(outcome.termination, Termination::ToleranceReached, "{:?}", outcome);
    }

    #[test]
    fn small_integers_tie_but_do_not_cycle(seed in any::<u64>(), n in 1usize..9) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let m = DMatrix::from_fn(n, n, |_, _| f64::from(rng.random_range(-1..2)));
        let q: Vec<f64> = (0..n).map(|_| f64::from(rng.random_range(-1..2))).collect();
        let outcome = solve_linear(&LinearMcp::lcp(m.clone(), q).unwrap(), &Options::default()).unwrap();
        let expected = [Termination::ToleranceReached, Termination::Ray];
        prop_assert!(expected.contains(&outcome.termination), "{:?}", outcome);
    }

    #[test]
    fn semidefinite_problems_with_a_solution_are_solved(seed in any::<u64>(), n in 1usize..8) {
        // M = G G' of rank about n/2 plus skew; q made so that a solution exists. Degenerate on
        // purpose.
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let rank = n.div_ceil(2);
        let g = DMatrix::from_fn(n, rank, |_, _| f64::from(rng.random_range(-2..3)));
        let skew = DMatrix::from_fn(n, n, |_, _| f64::from(rng.random_range(-1..2)));
        let m = &g * g.transpose() + &skew - skew.transpose();
        let z = DVector::from_fn(n, |_, _| f64::from(rng.random_range(0..3)));
        let w = DVector::from_fn(n, |i, _| if z[i] > 0.0 { 0.0 } else { f64::from(rng.random_range(0..3)) });
        let q = w - &m * z;
        let problem = LinearMcp::lcp(m, q.as_slice().to_vec()).unwrap();
        let outcome = solve_linear(&problem, &Options::default()).unwrap();
        prop_assert_eq!(outcome.termination, Termination::ToleranceReached, "{:?}", outcome);
    }
}
