//! The paths themselves: full from t = 0 to 1, complementary exchanges, the ray where it is needed.
#![cfg(feature = "solver")]

use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{
    Options, Outcome, PathEnd, PathRecord, Start, Termination, Variable, solve,
};
use nalgebra::{DMatrix, dmatrix};

const INF: f64 = f64::INFINITY;

fn lcp(m: DMatrix<f64>, q: &[f64]) -> LinearMcp {
    LinearMcp::new(m, q.to_vec(), vec![0.0; q.len()], vec![INF; q.len()]).unwrap()
}

/// Without the crash, so that the first path starts where the caller says.
fn run(problem: &LinearMcp, start: &[f64]) -> Outcome {
    let options = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };
    solve(problem, start, &options).unwrap()
}

fn paths(outcome: &Outcome) -> impl Iterator<Item = &PathRecord> {
    outcome.log.iter().flat_map(|major| &major.paths)
}

fn index(v: Variable) -> Option<usize> {
    match v {
        Variable::Z(i) | Variable::W(i) | Variable::V(i) => Some(i),
        Variable::Artificial(_) | Variable::T => None,
    }
}

/// Complete paths end at t = 1, and what leaves is replaced by something else.
fn check_paths(outcome: &Outcome) {
    for path in paths(outcome) {
        assert!(path.pivots.iter().all(|p| p.t <= 1.0));
        if path.end == PathEnd::Complete {
            assert_eq!(path.reach, 1.0);
        }
    }
}

#[test]
fn the_log_shows_a_full_path() {
    let m = dmatrix![2.0, -1.0, 0.0; -1.0, 2.0, -1.0; 0.0, -1.0, 2.0];
    let outcome = run(&lcp(m, &[-1.0, 3.0, -1.0]), &[5.0, 5.0, 5.0]);
    assert_eq!(outcome.termination, Termination::ToleranceReached);
    for (got, want) in outcome.point.iter().zip([0.5, 0.0, 0.5]) {
        assert!((got - want).abs() < 1e-12);
    }
    let path = paths(&outcome).next().unwrap();
    assert_eq!(
        (path.start, path.end, path.reach),
        (Start::Regular, PathEnd::Complete, 1.0)
    );
    // z_1 reaches its bound before t = 1; then w_1 moves, which is the next to enter.
    let k = path
        .pivots
        .iter()
        .position(|p| p.leaving == Variable::Z(1))
        .unwrap();
    assert!(path.pivots[k].t > 0.0 && path.pivots[k].t < 1.0);
    assert_eq!(path.pivots[k + 1].entering, Variable::W(1));
    check_paths(&outcome);
}

#[test]
fn each_entering_variable_is_the_complement_of_the_last_one_to_leave() {
    let m = DMatrix::from_fn(6, 6, |i, j| {
        if i == j {
            3.0
        } else {
            1.0 / (1.0 + (2 * i + 3 * j) as f64)
        }
    });
    let outcome = run(
        &lcp(m, &[-1.0, 2.0, -3.0, 4.0, -5.0, 1.0]),
        &[0.0, 9.0, 0.0, 9.0, 0.0, 9.0],
    );
    let mut exchanges = 0;
    for path in paths(&outcome) {
        for pair in path.pivots.windows(2) {
            assert_eq!(index(pair[0].leaving), index(pair[1].entering));
            assert_ne!(pair[0].leaving, pair[1].entering);
            exchanges += 1;
        }
    }
    assert!(exchanges > 3);
}

#[test]
fn infeasible_ends_with_a_reason() {
    let outcome = run(&lcp(dmatrix![-1.0], &[-1.0]), &[0.0]);
    assert!(!outcome.termination.reached_tolerance());
    assert!(paths(&outcome).any(|path| path.end == PathEnd::Ray));
}

/// Lemke's method processes every LCP with a strictly copositive matrix (Cottle, Pang and Stone
/// 1992, theorem 4.4.9); the regular path need not get there, and then the ray start must.
#[test]
fn strictly_copositive_lcps_are_reached_and_some_need_the_ray() {
    let mut seed = 12345u64;
    let mut next = |span: u64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % span
    };
    let mut rays = 0;
    for _ in 0..300 {
        let n = 2 + next(5) as usize;
        let m = DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0 + next(3) as f64
            } else {
                next(7) as f64
            }
        });
        let q: Vec<f64> = (0..n).map(|_| next(9) as f64 - 6.0).collect();
        let start: Vec<f64> = (0..n).map(|_| next(3) as f64).collect();
        let outcome = run(&lcp(m.clone(), &q), &start);
        assert_eq!(
            outcome.termination,
            Termination::ToleranceReached,
            "{m} {q:?} {start:?} {:?}",
            outcome.log
        );
        check_paths(&outcome);
        for path in paths(&outcome).filter(|path| path.start == Start::Ray) {
            assert_eq!((path.end, path.reach), (PathEnd::Complete, 1.0));
            rays += 1;
        }
    }
    assert!(rays > 5, "{rays} ray starts");
}
