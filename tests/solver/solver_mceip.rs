//! The solver on what it is for: complementarity eigenproblems embedded as MCP.
//!
//! The truth is the closed form of Table 1 and an enumeration of all supports in doubles
//! (`tests/support`), which shares nothing with the solver. What the solver returns within its
//! tolerance must be in that list, and over a grid it must find all of the list.
#![cfg(feature = "solver")]

use crate::support::{Embedded, Truth, contains, enumerate, random_pencil, table1};
use mceip_mcp::solver::{Options, Outcome, PathEnd, PathRecord, Start, solve};
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Cosine and sine of the angle.
const C: f64 = 0.6;
const S: f64 = 0.8;

/// The friction coefficient in the tests of single problems.
const MU: f64 = 8.0;

/// Table 1 for the angle above and these signs, embedded.
fn two_particles(mu: f64, s1: f64, s2: f64) -> Embedded {
    let (a, b) = table1(C, S, mu, s1, s2);
    Embedded::new(a, b, 0)
}

/// Distinct (t, x) among the runs that reached the tolerance.
fn distinct_solutions(problem: &Embedded, starts: Vec<Vec<f64>>) -> Vec<Truth> {
    let n = problem.a.nrows();
    let mut found: Vec<Truth> = Vec::new();

    for start in starts {
        let outcome = solve(problem, &start, &Options::default()).unwrap();
        let x = &outcome.point[..n];
        let t = outcome.point[n];
        if outcome.termination.reached_tolerance() && !contains(&found, t, x) {
            let x = DVector::from_column_slice(x);
            found.push(Truth { t, x });
        }
    }
    found
}

/// q = mu c s and d = c^2 + 1: the solutions are q - d with one particle, q - d - 1 with both.
#[test]
fn opposite_signs_have_three_solutions() {
    let problem = two_particles(MU, 1.0, -1.0);
    let q = MU * C * S;
    let d = C * C + 1.0;

    let found = distinct_solutions(&problem, problem.starts(22, 5.0, 1));

    assert_eq!(found.len(), 3, "{found:?}");
    assert!(contains(&found, q - d, &[1.0, 0.0]));
    assert!(contains(&found, q - d, &[0.0, 1.0]));
    assert!(contains(&found, q - d - 1.0, &[0.5, 0.5]));
}

#[test]
fn equal_signs_have_one_solution() {
    let problem = two_particles(MU, 1.0, 1.0);
    let q = MU * C * S;
    let d = C * C + 1.0;
    let root = q.hypot(1.0);
    let ratio = 1.0 / (root + q);
    let x = [1.0 / (1.0 + ratio), ratio / (1.0 + ratio)];

    let found = distinct_solutions(&problem, problem.starts(22, 5.0, 1));

    assert_eq!(found.len(), 1, "{found:?}");
    assert!(contains(&found, root - d, &x), "{found:?} {x:?}");
}

#[test]
fn the_other_opposite_signs_have_none() {
    let problem = two_particles(MU, -1.0, 1.0);
    let found = distinct_solutions(&problem, problem.starts(22, 5.0, 1));
    assert!(found.is_empty());
}

/// Solutions of a grid, and how many of them are found.
#[derive(Default)]
struct GridCount {
    solutions: usize,
    found: usize,
}

impl GridCount {
    /// Solves a problem from 22 starts; what is found must be in the enumeration.
    fn add(&mut self, a: DMatrix<f64>, b: DMatrix<f64>) {
        let truth = enumerate(&a, &b, 0);
        let problem = Embedded::new(a, b, 0);

        let seen = distinct_solutions(&problem, problem.starts(22, 10.0, 1));

        for solution in &seen {
            let is_true = contains(&truth, solution.t, solution.x.as_slice());
            assert!(is_true, "{seen:?} {truth:?}");
        }
        for solution in &truth {
            let is_seen = contains(&seen, solution.t, solution.x.as_slice());
            self.found += usize::from(is_seen);
            self.solutions += 1;
        }
    }
}

#[test]
fn every_solution_of_a_table_1_grid_in_22_starts() {
    let sign_patterns = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let mut count = GridCount::default();

    for phi in [20.0f64, 45.0, 70.0] {
        let (s, c) = phi.to_radians().sin_cos();
        for mu in [1.0, 4.0, 8.0, 20.0] {
            for (s1, s2) in sign_patterns {
                let (a, b) = table1(c, s, mu, s1, s2);
                count.add(a, b);
            }
        }
    }

    assert!(count.solutions >= 25, "{}", count.solutions);
    assert_eq!(count.found, count.solutions);
}

/// A random pencil of MCEIP-mu, or of MCEIP-lambda2 with mu = 3.
fn random_problem(rng: &mut ChaCha8Rng, family: &str, n: usize) -> Embedded {
    let (k0, k1, m0, free) = random_pencil(rng, n);
    if family == "mu" {
        Embedded::new(k0, k1, free)
    } else {
        Embedded::new(k0 + k1 * 3.0, m0, free)
    }
}

fn is_complete_ray(path: &PathRecord) -> bool {
    let is_ray = path.start == Start::Ray;
    let is_complete = path.end == PathEnd::Complete;
    is_ray && is_complete
}

/// The steps whose second path, from a ray start, led to the Newton point.
fn steps_by_ray(outcome: &Outcome) -> usize {
    let mut count = 0;
    for step in &outcome.log {
        let is_by_ray = step.paths.len() == 2 && is_complete_ray(&step.paths[1]);
        count += usize::from(is_by_ray);
    }
    count
}

/// What came of first starts.
#[derive(Default)]
struct FirstStarts {
    solvable: usize,
    converged: usize,
    by_ray: usize,
}

impl FirstStarts {
    /// Solves a problem from its first starts with t = 0 and t = 1, if it has a solution.
    fn add(&mut self, problem: &Embedded) {
        let n = problem.a.nrows();
        let truth = enumerate(&problem.a, &problem.b, problem.free);
        if truth.is_empty() {
            return;
        }

        for t in [0.0, 1.0] {
            let outcome = solve(problem, &problem.first_start(t), &Options::default()).unwrap();

            let is_true = contains(&truth, outcome.point[n], &outcome.point[..n]);
            let is_claimed = outcome.termination.reached_tolerance();
            assert!(is_true || !is_claimed, "{outcome:?} {truth:?}");

            self.by_ray += steps_by_ray(&outcome);
            self.solvable += 1;
            self.converged += usize::from(is_true);
        }
    }
}

#[test]
fn random_pencils_converge_from_the_first_start() {
    for family in ["lambda2", "mu"] {
        let mut first_starts = FirstStarts::default();
        for (n, count) in [(5, 30), (10, 12)] {
            let mut rng = ChaCha8Rng::seed_from_u64(1000 * n as u64 + 7);
            for _ in 0..count {
                first_starts.add(&random_problem(&mut rng, family, n));
            }
        }

        let FirstStarts {
            solvable,
            converged,
            by_ray,
        } = first_starts;
        println!("{family}: {converged} of {solvable}, {by_ray} Newton points by a ray start");
        assert!(by_ray > 0);
        let is_enough = converged * 100 >= 95 * solvable;
        assert!(is_enough, "{family}: {converged} of {solvable}");
    }
}

#[test]
fn runs_repeat_bit_by_bit() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let problem = random_problem(&mut rng, "mu", 10);
    for start in problem.starts(6, 10.0, 5) {
        let run = || solve(&problem, &start, &Options::default()).unwrap();
        assert_eq!(run(), run());
    }
}

/// (+,+): solutions begin where 1 + q^2 = (c^2 + 1)^2. Just below there are none.
#[test]
fn next_to_a_threshold_there_is_a_reason_and_no_panic() {
    let d: f64 = C * C + 1.0;
    let threshold = (d * d - 1.0).sqrt() / (C * S);

    for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let problem = two_particles(threshold * (1.0 - gap), 1.0, 1.0);
        let starts = problem.starts(22, 2.0, 1);

        let mut reached = 0;
        for start in starts {
            let outcome = solve(&problem, &start, &Options::default()).unwrap();
            reached += usize::from(outcome.termination.reached_tolerance());
        }
        println!("gap {gap:e}: {reached} of 22 within tolerance where no solution exists");
        assert!(gap < 1e-9 || reached == 0, "gap {gap:e}: {reached}");
    }
}
