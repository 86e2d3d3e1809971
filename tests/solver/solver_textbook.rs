//! Problems of the literature with known answers, and the special cases on which LCP codes fail.
#![cfg(feature = "solver")]

use mceip_mcp::mcp::{LinearMcp, Mcp};
use mceip_mcp::solver::{
    Options, Outcome, PathEnd, PivotKind, RatioTest, Termination, multistart, solve, solve_linear,
};
use nalgebra::{DMatrix, dmatrix};

const INF: f64 = f64::INFINITY;

fn close(outcome: &Outcome, expected: &[f64]) {
    assert_eq!(
        outcome.termination,
        Termination::ToleranceReached,
        "{outcome:?}"
    );
    assert!(outcome.residuals.within(1e-10));
    for (got, want) in outcome.point.iter().zip(expected) {
        assert!(
            (got - want).abs() < 1e-8,
            "{:?} instead of {expected:?}",
            outcome.point
        );
    }
}

/// Lemke, and the outer loop from several starts, must agree under both rules of the ratio test,
/// with the bounds' decisions taken first or not.
fn both(problem: &LinearMcp, expected: &[f64]) {
    for (ratio_test, preprocess) in [
        (RatioTest::Lexicographic, true),
        (RatioTest::Expand, false),
        (RatioTest::Lexicographic, false),
    ] {
        let options = Options {
            ratio_test,
            preprocess,
            ..Options::default()
        };
        close(&solve_linear(problem, &options).unwrap(), expected);
        for start in [0.0, 1.0, -3.0, 100.0] {
            close(
                &solve(problem, &vec![start; expected.len()], &options).unwrap(),
                expected,
            );
        }
    }
}

#[test]
fn one_by_one() {
    both(&LinearMcp::lcp(dmatrix![2.0], vec![-3.0]).unwrap(), &[1.5]);
    both(&LinearMcp::lcp(dmatrix![2.0], vec![3.0]).unwrap(), &[0.0]);
    both(&LinearMcp::lcp(dmatrix![2.0], vec![0.0]).unwrap(), &[0.0]);
    both(
        &LinearMcp::new(dmatrix![2.0], vec![-3.0], vec![0.0], vec![1.0]).unwrap(),
        &[1.0],
    );
    both(
        &LinearMcp::new(dmatrix![2.0], vec![-3.0], vec![-INF], vec![INF]).unwrap(),
        &[1.5],
    );
    both(
        &LinearMcp::new(dmatrix![2.0], vec![3.0], vec![-INF], vec![4.0]).unwrap(),
        &[-1.5],
    );
    both(
        &LinearMcp::new(dmatrix![0.0], vec![3.0], vec![7.0], vec![7.0]).unwrap(),
        &[7.0],
    );
}

#[test]
fn no_unknowns_at_all() {
    let empty = LinearMcp::lcp(DMatrix::zeros(0, 0), vec![]).unwrap();
    close(&solve(&empty, &[], &Options::default()).unwrap(), &[]);
    close(&solve_linear(&empty, &Options::default()).unwrap(), &[]);
}

#[test]
fn a_degenerate_lcp_ends_at_its_solution() {
    // w = z = 0 in both components.
    both(
        &LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![0.0, 0.0]).unwrap(),
        &[0.0, 0.0],
    );
    // z = (1, 0) with F_2 = 0.
    both(
        &LinearMcp::lcp(dmatrix![1.0, 1.0; 1.0, 2.0], vec![-1.0, -1.0]).unwrap(),
        &[1.0, 0.0],
    );
}

#[test]
fn murty() {
    for n in 4..=6 {
        let m = DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0
            } else if j > i {
                2.0
            } else {
                0.0
            }
        });
        let mut expected = vec![0.0; n];
        expected[n - 1] = 1.0;
        both(&LinearMcp::lcp(m, vec![-1.0; n]).unwrap(), &expected);
    }
}

#[test]
fn ties_do_not_cycle() {
    // Cottle, Pang and Stone: ties in every ratio test, the classic cyclic example.
    let cyclic = LinearMcp::lcp(
        dmatrix![1.0, 2.0, 0.0; 0.0, 1.0, 2.0; 2.0, 0.0, 1.0],
        vec![-1.0; 3],
    )
    .unwrap();
    both(&cyclic, &[1.0 / 3.0; 3]);
    // Equal rows: every w is tied with every other at every pivot.
    let n = 8;
    let ones = LinearMcp::lcp(DMatrix::from_element(n, n, 1.0), vec![-1.0; n]).unwrap();
    let outcome = solve_linear(&ones, &Options::default()).unwrap();
    assert_eq!(outcome.termination, Termination::ToleranceReached);
    assert!((outcome.point.iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn two_sided_bounds() {
    let m = dmatrix![2.0, 0.5, 0.0; 0.0, 1.0, 0.3; 0.1, 0.0, 1.0];
    let problem =
        LinearMcp::new(m, vec![-9.0, 5.0, -0.5], vec![0.0, 0.0, 0.0], vec![1.0; 3]).unwrap();
    both(&problem, &[1.0, 0.0, 0.4]);
    // Indefinite: several solutions, each a vertex; whatever is reported is one.
    let saddle = LinearMcp::new(
        dmatrix![-1.0, 0.0; 0.0, -1.0],
        vec![0.5, 0.5],
        vec![0.0; 2],
        vec![1.0; 2],
    )
    .unwrap();
    for outcome in multistart(
        &saddle,
        [vec![0.0, 0.0], vec![1.0, 0.0], vec![0.3, 0.8]],
        &Options::default(),
    )
    .unwrap()
    {
        assert!(outcome.residuals.within(1e-10), "{outcome:?}");
    }
}

#[test]
fn free_unknowns() {
    // min (x - 3)^2 / 2 with x <= 1: x free, multiplier >= 0.
    let kkt = LinearMcp::new(
        dmatrix![1.0, 1.0; -1.0, 0.0],
        vec![-3.0, 1.0],
        vec![-INF, 0.0],
        vec![INF; 2],
    )
    .unwrap();
    both(&kkt, &[1.0, 2.0]);
    // A linear system, with zero diagonal.
    let system = LinearMcp::new(
        dmatrix![0.0, 2.0; 1.0, 1.0],
        vec![-4.0, -5.0],
        vec![-INF; 2],
        vec![INF; 2],
    )
    .unwrap();
    both(&system, &[3.0, 2.0]);
}

#[test]
fn equal_bounds() {
    let m = dmatrix![1.0, 1.0, 0.0; 1.0, 2.0, 0.0; 0.0, 0.0, 1.0];
    both(
        &LinearMcp::new(
            m,
            vec![-9.0, -4.0, 2.0],
            vec![1.0, 0.0, -1.0],
            vec![1.0, INF, -1.0],
        )
        .unwrap(),
        &[1.0, 1.5, -1.0],
    );
}

#[test]
fn an_infeasible_lcp_ends_on_a_ray() {
    let lcp = LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap();
    let lemke = solve_linear(&lcp, &Options::default()).unwrap();
    assert_eq!(lemke.termination, Termination::Ray);
    assert_eq!(lemke.log[0].paths[0].end, PathEnd::Ray);
    let outcome = solve(&lcp, &[0.0], &Options::default()).unwrap();
    assert!(!outcome.termination.reached_tolerance());
    assert!(!outcome.residuals.within(1e-3));
}

#[test]
fn singular_starts() {
    // The matrix of ones: singular basis wherever both are inside; a whole edge of solutions.
    let ones = LinearMcp::lcp(dmatrix![1.0, 1.0; 1.0, 1.0], vec![-1.0, -1.0]).unwrap();
    let options = Options {
        crash_iteration_limit: 0,
        ..Options::default()
    };
    let outcome = solve(&ones, &[2.0, 3.0], &options).unwrap();
    assert!(
        (outcome.point[0] + outcome.point[1] - 1.0).abs() < 1e-10,
        "{outcome:?}"
    );
    assert!(
        outcome
            .trace()
            .any(|p| p.kind == PivotKind::ArtificialLeaves)
    );
    // x^2 = 1 from x = 0: stationary for every merit, and F' is zero; the point along the ray
    // leaves it.
    for options in [&options, &Options::default()] {
        let outcome = solve(&Square, &[0.0], options).unwrap();
        assert!((outcome.point[0].abs() - 1.0).abs() < 1e-10, "{outcome:?}");
    }
    let outcome = solve(&Square, &[0.0], &options).unwrap();
    assert_eq!(outcome.log[0].paths[0].end, PathEnd::Ray);
}

struct Square;

impl Mcp for Square {
    fn dimension(&self) -> usize {
        1
    }
    fn lower(&self) -> &[f64] {
        &[-INF]
    }
    fn upper(&self) -> &[f64] {
        &[INF]
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        f[0] = z[0] * z[0] - 1.0;
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        j[(0, 0)] = 2.0 * z[0];
    }
}

/// Kojima and Shindo 1986; with the other coefficients, Josephy 1979.
struct FourByFour {
    f2: f64,
    f3: (f64, f64),
}

impl Mcp for FourByFour {
    fn dimension(&self) -> usize {
        4
    }
    fn lower(&self) -> &[f64] {
        &[0.0; 4]
    }
    fn upper(&self) -> &[f64] {
        &[INF; 4]
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        let (a, b, c, d) = (z[0], z[1], z[2], z[3]);
        f[0] = 3.0 * a * a + 2.0 * a * b + 2.0 * b * b + c + 3.0 * d - 6.0;
        f[1] = 2.0 * a * a + a + b * b + self.f2 * c + 2.0 * d - 2.0;
        f[2] = 3.0 * a * a + a * b + 2.0 * b * b + 2.0 * c + self.f3.0 * d - self.f3.1;
        f[3] = a * a + 3.0 * b * b + 2.0 * c + 3.0 * d - 3.0;
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let (a, b) = (z[0], z[1]);
        j.copy_from(&dmatrix![
            6.0 * a + 2.0 * b, 2.0 * a + 4.0 * b, 1.0, 3.0;
            4.0 * a + 1.0, 2.0 * b, self.f2, 2.0;
            6.0 * a + b, a + 4.0 * b, 2.0, self.f3.0;
            2.0 * a, 6.0 * b, 2.0, 3.0
        ]);
    }
}

fn starts() -> Vec<Vec<f64>> {
    vec![
        vec![0.0; 4],
        vec![1.0; 4],
        vec![100.0; 4],
        vec![1.0, 0.0, 1.0, 0.0],
        vec![1.25, 0.0, 0.0, 0.5],
        vec![0.0, 5.0, 0.0, 5.0],
    ]
}

#[test]
fn josephy() {
    let problem = FourByFour {
        f2: 3.0,
        f3: (3.0, 1.0),
    };
    for outcome in multistart(&problem, starts(), &Options::default()).unwrap() {
        close(&outcome, &[1.5f64.sqrt(), 0.0, 0.0, 0.5]);
    }
}

#[test]
fn kojima_and_shindo_has_two_solutions_one_of_them_degenerate() {
    let problem = FourByFour {
        f2: 10.0,
        f3: (9.0, 9.0),
    };
    let solutions = [[1.5f64.sqrt(), 0.0, 0.0, 0.5], [1.0, 0.0, 3.0, 0.0]];
    let mut seen = [false; 2];
    for outcome in multistart(&problem, starts(), &Options::default()).unwrap() {
        assert!(outcome.termination.reached_tolerance(), "{outcome:?}");
        let near = |s: &[f64; 4]| {
            s.iter()
                .zip(&outcome.point)
                .all(|(a, b)| (a - b).abs() < 1e-5)
        };
        let k = solutions.iter().position(near).unwrap();
        seen[k] = true;
    }
    assert_eq!(seen, [true; 2]);
}

#[test]
fn the_log_tells_the_whole_run() {
    let problem = FourByFour {
        f2: 3.0,
        f3: (3.0, 1.0),
    };
    let outcome = solve(&problem, &[0.0, 5.0, 0.0, 5.0], &Options::default()).unwrap();
    assert_eq!(outcome.trace().count(), outcome.counters.pivots);
    let majors = outcome.log.iter().filter(|r| !r.paths.is_empty()).count();
    assert_eq!(majors, outcome.counters.majors);
    assert!(outcome.trace().all(|p| p.t <= 1.0));
}
