//! The PATH-style solver on problems with known answers, and the paths it follows.
#![cfg(feature = "solver")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::mcp::{LinearMcp, Mcp, McpError};
use mceip::solver::{Options, Outcome, SolverError, Start, Step, Termination, Variable, solve};
use nalgebra::{DMatrix, dmatrix};
use proptest::prelude::*;

const INF: f64 = f64::INFINITY;

fn lcp(m: DMatrix<f64>, q: &[f64]) -> LinearMcp {
    let n = q.len();
    LinearMcp::new(m, q.to_vec(), vec![0.0; n], vec![INF; n]).unwrap()
}

fn run(problem: &dyn Mcp, start: &[f64]) -> Outcome {
    solve(problem, start, &Options::default()).unwrap()
}

#[track_caller]
fn expect(outcome: &Outcome, point: &[f64]) {
    assert_eq!(outcome.termination, Termination::ToleranceReached, "{:?}", outcome.residuals);
    for (got, want) in outcome.point.iter().zip(point) {
        assert!((got - want).abs() < 1e-9, "{:?}", outcome.point);
    }
}

/// Murty's LCP: M upper-triangle 2, unit diagonal, q = -1; solution e_n; exponential for Murty's
/// least-index method (K. Murty 1978).
#[test]
fn murty() {
    for n in 1..=8 {
        let m = DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0
            } else if j > i {
                2.0
            } else {
                0.0
            }
        });
        let mut answer = vec![0.0; n];
        answer[n - 1] = 1.0;
        expect(&run(&lcp(m, &vec![-1.0; n]), &vec![0.0; n]), &answer);
    }
}

/// Fathi's LCP: the Gram matrix of Murty's (Y. Fathi 1979); solution e_1 for q = -1.
#[test]
fn fathi() {
    for n in 1..=6 {
        let l = DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0
            } else if j < i {
                2.0
            } else {
                0.0
            }
        });
        let mut answer = vec![0.0; n];
        answer[0] = 1.0;
        expect(&run(&lcp(&l * l.transpose(), &vec![-1.0; n]), &vec![0.0; n]), &answer);
    }
}

#[test]
fn one_by_one_free_bounded_and_fixed() {
    expect(&run(&lcp(dmatrix![2.0], &[-3.0]), &[0.0]), &[1.5]);
    expect(&run(&lcp(dmatrix![2.0], &[3.0]), &[7.0]), &[0.0]);
    let free = LinearMcp::new(dmatrix![1.0, 2.0; 3.0, 4.0], vec![-5.0, -11.0], vec![-INF; 2], vec![INF; 2]).unwrap();
    expect(&run(&free, &[9.0, 9.0]), &[1.0, 2.0]);
    let boxed = LinearMcp::new(dmatrix![1.0], vec![-9.0], vec![0.0], vec![2.0]).unwrap();
    expect(&run(&boxed, &[0.0]), &[2.0]);
    let fixed = LinearMcp::new(dmatrix![1.0, 0.0; 0.0, 1.0], vec![-9.0, -4.0], vec![3.0, 0.0], vec![3.0, INF]).unwrap();
    expect(&run(&fixed, &[0.0, 0.0]), &[3.0, 4.0]);
    let upper_only = LinearMcp::new(dmatrix![1.0], vec![5.0], vec![-INF], vec![1.0]).unwrap();
    expect(&run(&upper_only, &[1.0]), &[-5.0]);
}

#[test]
fn degenerate_lcp_ends_in_few_pivots() {
    // Every ratio ties; the lexicographic rule decides.
    let m = dmatrix![1.0, 2.0, 0.0; 0.0, 1.0, 2.0; 2.0, 0.0, 1.0]; // P-matrix on which naive rules cycle
    let outcome = run(&lcp(m, &[-1.0, -1.0, -1.0]), &[0.0, 0.0, 0.0]);
    expect(&outcome, &[1.0 / 3.0; 3]);
    assert!(outcome.pivots <= 8, "{} pivots", outcome.pivots);
}

#[test]
fn infeasible_ends_on_a_ray_with_that_reason() {
    let outcome = run(&lcp(dmatrix![0.0, 0.0; 0.0, 0.0], &[-1.0, -1.0]), &[1.0, 1.0]);
    assert!(!outcome.termination.reached_tolerance());
    let skew = run(&lcp(dmatrix![-1.0], &[-1.0]), &[0.0]);
    assert_eq!(skew.termination, Termination::Ray);
}

#[test]
fn a_singular_start_is_perturbed_not_fatal() {
    // The Jacobian of the first basis is singular at z = (1, 1).
    let m = dmatrix![1.0, 1.0; 1.0, 1.0];
    let outcome = run(&lcp(m, &[-2.0, -2.0]), &[0.5, 0.5]);
    assert!(outcome.termination.reached_tolerance());
    assert!((outcome.point[0] + outcome.point[1] - 2.0).abs() < 1e-8);
    assert!(outcome.log[0].proximal > 0.0);
}

/// Lemke's method processes every LCP with a strictly copositive matrix (Cottle, Pang and Stone 1992,
/// theorem 4.4.9); the regular path need not get there, and then the ray start must.
#[test]
fn strictly_copositive_lcps_are_reached_and_some_need_the_ray() {
    let mut seed = 12345u64;
    let mut next = |span: u64| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) % span
    };
    let mut rays = 0;
    for _ in 0..300 {
        let n = 2 + next(5) as usize;
        let m = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 + next(3) as f64 } else { next(7) as f64 });
        let q: Vec<f64> = (0..n).map(|_| next(9) as f64 - 6.0).collect();
        let start: Vec<f64> = (0..n).map(|_| next(3) as f64).collect();
        let outcome = run(&lcp(m.clone(), &q), &start);
        assert_eq!(outcome.termination, Termination::ToleranceReached, "{m} {q:?} {start:?} {:?}", outcome.log);
        check_path(&outcome);
        let by_ray: Vec<_> = outcome.log.iter().filter(|major| major.start == Start::Ray).collect();
        assert!(by_ray.iter().all(|major| major.t == 1.0));
        rays += by_ray.len();
    }
    assert!(rays > 5, "{rays} ray starts");
}

struct Nonlinear {
    lower: Vec<f64>,
    upper: Vec<f64>,
    f: fn(&[f64], &mut [f64]),
    j: fn(&[f64], &mut DMatrix<f64>),
}

impl Mcp for Nonlinear {
    fn dimension(&self) -> usize {
        self.lower.len()
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

/// Kojima and Shindo (1986): two solutions, (sqrt 6 / 2, 0, 0, 1/2) degenerate and (1, 0, 3, 0).
#[test]
fn kojima_shindo() {
    let problem = Nonlinear {
        lower: vec![0.0; 4],
        upper: vec![INF; 4],
        f: |z, f| {
            let (a, b, c, d) = (z[0], z[1], z[2], z[3]);
            f[0] = 3.0 * a * a + 2.0 * a * b + 2.0 * b * b + c + 3.0 * d - 6.0;
            f[1] = 2.0 * a * a + a + b * b + 10.0 * c + 2.0 * d - 2.0;
            f[2] = 3.0 * a * a + a * b + 2.0 * b * b + 2.0 * c + 9.0 * d - 9.0;
            f[3] = a * a + 3.0 * b * b + 2.0 * c + 3.0 * d - 3.0;
        },
        j: |z, j| {
            let (a, b) = (z[0], z[1]);
            j.copy_from(&dmatrix![
                6.0 * a + 2.0 * b, 2.0 * a + 4.0 * b, 1.0, 3.0;
                4.0 * a + 1.0, 2.0 * b, 10.0, 2.0;
                6.0 * a + b, a + 4.0 * b, 2.0, 9.0;
                2.0 * a, 6.0 * b, 2.0, 3.0
            ]);
        },
    };
    let mut seen = [false; 2];
    for start in [[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 1.0, 0.0]] {
        let outcome = run(&problem, &start);
        if !outcome.termination.reached_tolerance() {
            continue;
        }
        let near = |p: [f64; 4]| outcome.point.iter().zip(p).all(|(a, b)| (a - b).abs() < 1e-4);
        seen[0] |= near([6f64.sqrt() / 2.0, 0.0, 0.0, 0.5]);
        seen[1] |= near([1.0, 0.0, 3.0, 0.0]);
        assert!(near([6f64.sqrt() / 2.0, 0.0, 0.0, 0.5]) || near([1.0, 0.0, 3.0, 0.0]), "{:?}", outcome.point);
    }
    assert!(seen[0] || seen[1]);
}

#[test]
fn a_function_that_is_not_finite_is_a_reason() {
    let problem = Nonlinear { lower: vec![0.0], upper: vec![INF], f: |_, f| f[0] = f64::NAN, j: |_, j| j.fill(1.0) };
    assert_eq!(run(&problem, &[1.0]).termination, Termination::NonFinite);
    let jacobian = Nonlinear { lower: vec![0.0], upper: vec![INF], f: |_, f| f[0] = -1.0, j: |_, j| j.fill(INF) };
    assert_eq!(run(&jacobian, &[1.0]).termination, Termination::NonFinite);
}

/// 0 <= x _|_ 1/x >= 0: residuals may shrink, but no point is a solution (facts.md).
#[test]
fn a_small_residual_is_not_called_a_solution() {
    let problem = Nonlinear { lower: vec![0.0], upper: vec![INF], f: |z, f| f[0] = 1.0 / z[0], j: |z, j| j.fill(-1.0 / (z[0] * z[0])) };
    let outcome = run(&problem, &[1.0]);
    // Whatever the reason is, the outcome names a reason and all residuals, not a verdict.
    assert!(outcome.residuals.fischer.is_finite() || outcome.termination == Termination::NonFinite);
}

#[test]
fn inputs_are_refused_by_name() {
    let good = lcp(dmatrix![1.0], &[1.0]);
    assert!(matches!(solve(&good, &[], &Options::default()), Err(SolverError::StartLength { expected: 1, got: 0 })));
    assert!(matches!(solve(&good, &[f64::NAN], &Options::default()), Err(SolverError::StartNotFinite { index: 0, .. })));
    let zero = Options { major_iteration_limit: 0, ..Options::default() };
    assert!(matches!(solve(&good, &[0.0], &zero), Err(SolverError::Option { name: "major_iteration_limit", .. })));
    assert!(matches!(LinearMcp::new(dmatrix![f64::NAN], vec![0.0], vec![0.0], vec![INF]), Err(McpError::NotFinite { row: 0, col: 0, .. })));
    assert!(matches!(LinearMcp::new(dmatrix![1.0], vec![0.0], vec![1.0], vec![0.0]), Err(McpError::Bounds { index: 0, .. })));
    assert!(matches!(LinearMcp::new(dmatrix![1.0], vec![0.0], vec![], vec![0.0]), Err(McpError::Shape { what: "lower", .. })));
}

/// On a full path t runs from 0 to 1, every pivot exchanges complementary partners.
fn check_path(outcome: &Outcome) {
    for major in &outcome.log {
        assert!(major.pivots.iter().all(|p| (0.0..=1.0).contains(&p.t)));
        for p in major.pivots.iter().filter(|p| p.leaving != Variable::T) {
            let index = |v: Variable| match v {
                Variable::Z(i) | Variable::W(i) | Variable::V(i) => i,
                Variable::T => usize::MAX,
            };
            assert_eq!(index(p.leaving), index(p.entering));
            assert_ne!(p.leaving, p.entering);
        }
    }
}

#[test]
fn the_log_shows_a_full_path() {
    let m = dmatrix![2.0, -1.0, 0.0; -1.0, 2.0, -1.0; 0.0, -1.0, 2.0];
    let outcome = run(&lcp(m, &[-1.0, 3.0, -1.0]), &[5.0, 5.0, 5.0]);
    expect(&outcome, &[0.5, 0.0, 0.5]);
    assert_eq!((outcome.log[0].start, outcome.log[0].t, outcome.log[0].step), (Start::Regular, 1.0, Step::Full));
    assert!(outcome.trace().any(|p| p.leaving == Variable::Z(1) && p.entering == Variable::W(1)));
    check_path(&outcome);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    /// For positive definite M the solution is unique and one linearisation suffices: every path is
    /// complete and the merit falls to rounding.
    #[test]
    fn definite_lcps_are_solved_by_one_complete_path(
        n in 1usize..7,
        entries in prop::collection::vec(-3i32..=3, 36),
        q in prop::collection::vec(-5i32..=5, 6),
        start in prop::collection::vec(0i32..=3, 6),
        upper in prop::collection::vec(prop::option::of(0i32..=4), 6),
    ) {
        let g = DMatrix::from_fn(n, n, |i, j| f64::from(entries[i * 6 + j]));
        let m = &g * g.transpose() + DMatrix::identity(n, n) + (&g - g.transpose()); // definite, not symmetric
        let q: Vec<f64> = q[..n].iter().map(|&v| f64::from(v)).collect();
        let u: Vec<f64> = upper[..n].iter().map(|u| u.map_or(INF, f64::from)).collect();
        let problem = LinearMcp::new(m, q, vec![0.0; n], u).unwrap();
        let start: Vec<f64> = start[..n].iter().map(|&v| f64::from(v)).collect();
        let outcome = run(&problem, &start);
        prop_assert_eq!(outcome.termination, Termination::ToleranceReached);
        prop_assert!(outcome.log.iter().all(|major| major.t == 1.0 && major.start == Start::Regular));
        prop_assert!(outcome.log.len() <= 2);
        check_path(&outcome);
    }
}
