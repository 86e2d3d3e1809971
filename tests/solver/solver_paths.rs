//! The paths of the solver, as its log tells them.
//!
//! A path leads from t = 0 to t = 1 by pivots, each of which exchanges complementary variables;
//! where the regular path does not get there, one starts on a ray. The truth is Lemke's theory: for
//! strictly copositive matrices the ray start must succeed, and each variable that enters is the
//! complement of the last one to leave.
#![cfg(feature = "solver")]

use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{
    Options, Outcome, PathEnd, PathRecord, Start, Termination, Variable, solve,
};
use nalgebra::{DMatrix, dmatrix};

/// Mz + q complementary to z >= 0.
fn lcp(m: DMatrix<f64>, q: &[f64]) -> LinearMcp {
    let lower = vec![0.0; q.len()];
    let upper = vec![f64::INFINITY; q.len()];
    LinearMcp::new(m, q.to_vec(), lower, upper).unwrap()
}

/// Solves without the crash, so that the first path starts where the caller says.
fn solve_without_crash(problem: &LinearMcp, start: &[f64]) -> Outcome {
    let options = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };
    solve(problem, start, &options).unwrap()
}

fn paths(outcome: &Outcome) -> impl Iterator<Item = &PathRecord> {
    outcome.log.iter().flat_map(|major| &major.paths)
}

fn index_of(variable: Variable) -> Option<usize> {
    match variable {
        Variable::Z(i) | Variable::W(i) | Variable::V(i) => Some(i),
        Variable::Artificial(_) | Variable::T => None,
    }
}

/// No path goes beyond t = 1, and complete ones end there.
fn assert_paths_end_at_one(outcome: &Outcome) {
    for path in paths(outcome) {
        assert!(path.pivots.iter().all(|pivot| pivot.t <= 1.0));
        if path.end == PathEnd::Complete {
            assert_eq!(path.reach, 1.0);
        }
    }
}

#[test]
fn the_log_shows_a_full_path() {
    let m = dmatrix![2.0, -1.0, 0.0; -1.0, 2.0, -1.0; 0.0, -1.0, 2.0];
    let problem = lcp(m, &[-1.0, 3.0, -1.0]);

    let outcome = solve_without_crash(&problem, &[5.0, 5.0, 5.0]);

    assert_eq!(outcome.termination, Termination::ToleranceReached);
    for (found, expected) in outcome.point.iter().zip([0.5, 0.0, 0.5]) {
        assert!((found - expected).abs() < 1e-12);
    }
    let path = paths(&outcome).next().unwrap();
    assert_eq!(path.start, Start::Regular);
    assert_eq!(path.end, PathEnd::Complete);
    assert_eq!(path.reach, 1.0);

    // z_1 reaches its bound before t = 1; then w_1 moves, which is the next to enter.
    let mut pivots = path.pivots.iter();
    let k = pivots.position(|p| p.leaving == Variable::Z(1)).unwrap();
    let pivot = &path.pivots[k];
    let next_pivot = &path.pivots[k + 1];
    assert!(pivot.t > 0.0);
    assert!(pivot.t < 1.0);
    assert_eq!(next_pivot.entering, Variable::W(1));

    assert_paths_end_at_one(&outcome);
}

#[test]
fn each_entering_variable_is_the_complement_of_the_last_one_to_leave() {
    let mut m = DMatrix::zeros(6, 6);
    for i in 0..6 {
        for j in 0..6 {
            let number = (2 * i + 3 * j) as f64;
            m[(i, j)] = if i == j { 3.0 } else { 1.0 / (1.0 + number) };
        }
    }
    let problem = lcp(m, &[-1.0, 2.0, -3.0, 4.0, -5.0, 1.0]);

    let outcome = solve_without_crash(&problem, &[0.0, 9.0, 0.0, 9.0, 0.0, 9.0]);

    let mut exchanges = 0;
    for path in paths(&outcome) {
        for pair in path.pivots.windows(2) {
            let left = pair[0].leaving;
            let entered = pair[1].entering;
            assert_eq!(index_of(left), index_of(entered));
            assert_ne!(left, entered);
            exchanges += 1;
        }
    }
    assert!(exchanges > 3);
}

#[test]
fn infeasible_ends_with_a_reason() {
    let problem = lcp(dmatrix![-1.0], &[-1.0]);

    let outcome = solve_without_crash(&problem, &[0.0]);

    assert!(!outcome.termination.reached_tolerance());
    assert!(paths(&outcome).any(|path| path.end == PathEnd::Ray));
}

/// A linear congruential generator, with the constants of Knuth's MMIX.
struct Lcg {
    state: u64,
}

impl Lcg {
    /// A number from 0 to `span` - 1.
    fn below(&mut self, span: u64) -> u64 {
        const MULTIPLIER: u64 = 6_364_136_223_846_793_005;
        const INCREMENT: u64 = 1_442_695_040_888_963_407;
        let product = self.state.wrapping_mul(MULTIPLIER);
        self.state = product.wrapping_add(INCREMENT);
        (self.state >> 33) % span
    }

    /// Positive on the diagonal, nonnegative elsewhere.
    fn strictly_copositive_matrix(&mut self, n: usize) -> DMatrix<f64> {
        DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0 + self.below(3) as f64
            } else {
                self.below(7) as f64
            }
        })
    }
}

/// Lemke's method processes every LCP with a strictly copositive matrix (Cottle, Pang and Stone
/// 1992, theorem 4.4.9); the regular path need not get there, and then the ray start must.
#[test]
fn strictly_copositive_lcps_are_reached_and_some_need_the_ray() {
    let mut random = Lcg { state: 12345 };
    let mut rays = 0;

    for _ in 0..300 {
        let n = 2 + random.below(5) as usize;
        let m = random.strictly_copositive_matrix(n);
        let q: Vec<f64> = (0..n).map(|_| random.below(9) as f64 - 6.0).collect();
        let start: Vec<f64> = (0..n).map(|_| random.below(3) as f64).collect();

        let outcome = solve_without_crash(&lcp(m.clone(), &q), &start);

        assert_eq!(
            outcome.termination,
            Termination::ToleranceReached,
            "{m} {q:?} {start:?} {:?}",
            outcome.log
        );
        assert_paths_end_at_one(&outcome);
        for path in paths(&outcome) {
            if path.start == Start::Ray {
                assert_eq!(path.end, PathEnd::Complete);
                assert_eq!(path.reach, 1.0);
                rays += 1;
            }
        }
    }
    assert!(rays > 5, "{rays} ray starts");
}
