//! The real job: complementarity eigenproblems embedded as MCP, against brute-force enumeration.
#![cfg(feature = "solver")]

use crate::support::*;
use mceip_mcp::solver::{Options, PathEnd, PathRecord, Start, multistart, solve};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

const C: f64 = 0.6;
const S: f64 = 0.8;

/// Distinct (t, x) among the runs that reached the tolerance.
fn distinct(problem: &Embedded, starts: Vec<Vec<f64>>) -> Vec<Truth> {
    let n = problem.a.nrows();
    let mut found: Vec<Truth> = Vec::new();
    for outcome in multistart(problem, starts, &Options::default()).unwrap() {
        let (x, t) = (&outcome.point[..n], outcome.point[n]);
        if outcome.termination.reached_tolerance() && !contains(&found, t, x) {
            found.push(Truth {
                t,
                x: nalgebra::DVector::from_column_slice(x),
            });
        }
    }
    found
}

#[test]
fn opposite_signs_have_three_solutions() {
    let (a, b) = table1(C, S, 8.0, 1.0, -1.0);
    let problem = Embedded::new(a, b, 0);
    let (q, d) = (8.0 * C * S, C * C + 1.0);
    let found = distinct(&problem, problem.starts(22, 5.0, 1));
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(contains(&found, q - d, &[1.0, 0.0]));
    assert!(contains(&found, q - d, &[0.0, 1.0]));
    assert!(contains(&found, q - d - 1.0, &[0.5, 0.5]));
}

#[test]
fn equal_signs_have_one_solution() {
    let (a, b) = table1(C, S, 8.0, 1.0, 1.0);
    let problem = Embedded::new(a, b, 0);
    let (q, d) = (8.0 * C * S, C * C + 1.0);
    let root = q.hypot(1.0);
    let ratio = 1.0 / (root + q);
    let x = [1.0 / (1.0 + ratio), ratio / (1.0 + ratio)];
    let found = distinct(&problem, problem.starts(22, 5.0, 1));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(contains(&found, root - d, &x), "{found:?} {x:?}");
}

#[test]
fn the_other_opposite_signs_have_none() {
    let (a, b) = table1(C, S, 8.0, -1.0, 1.0);
    let problem = Embedded::new(a, b, 0);
    assert!(distinct(&problem, problem.starts(22, 5.0, 1)).is_empty());
}

#[test]
fn every_solution_of_a_table_1_grid_in_22_starts() {
    let (mut solutions, mut found) = (0, 0);
    for phi in [20.0f64, 45.0, 70.0] {
        let (s, c) = phi.to_radians().sin_cos();
        for mu in [1.0, 4.0, 8.0, 20.0] {
            for (s1, s2) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let (a, b) = table1(c, s, mu, s1, s2);
                let truth = enumerate(&a, &b, 0);
                let problem = Embedded::new(a, b, 0);
                let seen = distinct(&problem, problem.starts(22, 10.0, 1));
                solutions += truth.len();
                found += truth
                    .iter()
                    .filter(|s| contains(&seen, s.t, s.x.as_slice()))
                    .count();
                assert!(
                    seen.iter().all(|s| contains(&truth, s.t, s.x.as_slice())),
                    "{seen:?} {truth:?}"
                );
            }
        }
    }
    assert!(solutions >= 25, "{solutions}");
    assert_eq!(found, solutions);
}

#[test]
fn random_pencils_converge_from_the_first_start() {
    for family in ["lambda2", "mu"] {
        let (mut solvable, mut converged, mut by_ray) = (0, 0, 0);
        for n in [5, 10] {
            let mut rng = ChaCha8Rng::seed_from_u64(1000 * n as u64 + 7);
            for _ in 0..if n == 5 { 30 } else { 12 } {
                let (k0, k1, m0, free) = random_pencil(&mut rng, n);
                let problem = if family == "mu" {
                    Embedded::new(k0, k1, free)
                } else {
                    Embedded::new(k0 + k1 * 3.0, m0, free)
                };
                let truth = enumerate(&problem.a, &problem.b, free);
                if truth.is_empty() {
                    continue;
                }
                for t in [0.0, 1.0] {
                    let outcome =
                        solve(&problem, &problem.first_start(t), &Options::default()).unwrap();
                    let right = contains(&truth, outcome.point[n], &outcome.point[..n]);
                    assert!(
                        right || !outcome.termination.reached_tolerance(),
                        "{outcome:?} {truth:?}"
                    );
                    let ray = |p: &PathRecord| p.start == Start::Ray && p.end == PathEnd::Complete;
                    by_ray += outcome
                        .log
                        .iter()
                        .filter(|r| r.paths.len() == 2 && ray(&r.paths[1]))
                        .count();
                    solvable += 1;
                    converged += usize::from(right);
                }
            }
        }
        println!("{family}: {converged} of {solvable}, {by_ray} Newton points by a ray start");
        assert!(by_ray > 0);
        assert!(
            converged * 100 >= 95 * solvable,
            "{family}: {converged} of {solvable}"
        );
    }
}

#[test]
fn runs_repeat_bit_by_bit() {
    let (k0, k1, _, free) = random_pencil(&mut ChaCha8Rng::seed_from_u64(3), 10);
    let problem = Embedded::new(k0, k1, free);
    let run = || multistart(&problem, problem.starts(6, 10.0, 5), &Options::default()).unwrap();
    assert_eq!(run(), run());
}

#[test]
fn next_to_a_threshold_there_is_a_reason_and_no_panic() {
    // (+,+): solutions begin where 1 + q^2 = (c^2 + 1)^2. Just below there are none.
    let d: f64 = C * C + 1.0;
    let threshold = (d * d - 1.0).sqrt() / (C * S);
    for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let (a, b) = table1(C, S, threshold * (1.0 - gap), 1.0, 1.0);
        let problem = Embedded::new(a, b, 0);
        let outcomes =
            multistart(&problem, problem.starts(22, 2.0, 1), &Options::default()).unwrap();
        let reached = outcomes
            .iter()
            .filter(|o| o.termination.reached_tolerance())
            .count();
        println!("gap {gap:e}: {reached} of 22 within tolerance where no solution exists");
        assert!(gap < 1e-9 || reached == 0, "gap {gap:e}: {reached}");
    }
}
