//! Measures, printed with `cargo test --release --test solver_measure -- --ignored --nocapture`.
#![cfg(feature = "solver")]
#![allow(missing_docs, clippy::unwrap_used, reason = "a test may panic")]

mod support;

use mceip::solver::{Options, Outcome, solve};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use support::*;

#[derive(Default, Debug)]
struct Tally {
    instances: usize,
    solvable: usize,
    first: [usize; 2],
    random: (usize, usize),
    found: usize,
    truth: usize,
    false_claims: usize,
    success_ms: f64,
    failure_ms: f64,
    successes: usize,
    failures: usize,
    ends: BTreeMap<String, usize>,
    majors: usize,
}

fn run(tally: &mut Tally, problem: &Embedded, t_max: f64, seed: u64) {
    let truth = enumerate(&problem.a, &problem.b, problem.free);
    tally.instances += 1;
    if truth.is_empty() {
        return;
    }
    tally.solvable += 1;
    tally.truth += truth.len();
    let mut seen = vec![false; truth.len()];
    for (k, start) in problem.starts(22, t_max, seed).iter().enumerate() {
        let clock = std::time::Instant::now();
        let outcome = solve(problem, start, &Options::default()).unwrap();
        let ms = clock.elapsed().as_secs_f64() * 1e3;
        let ok = matched(problem, &truth, &outcome, &mut seen, tally);
        tally.majors += outcome.counters.majors;
        *tally.ends.entry(format!("{:?} r{}", outcome.termination, outcome.counters.restarts)).or_default() += 1;
        if ok {
            tally.successes += 1;
            tally.success_ms += ms;
        } else {
            tally.failures += 1;
            tally.failure_ms += ms;
        }
        match k {
            0 | 1 => tally.first[k] += usize::from(ok),
            _ => tally.random = (tally.random.0 + usize::from(ok), tally.random.1 + 1),
        }
    }
    if seen.contains(&false) && problem.a.nrows() == 2 {
        println!("missed {:?} of {truth:?} in {}", seen, problem.a);
    }
    tally.found += seen.iter().filter(|s| **s).count();
}

fn matched(problem: &Embedded, truth: &[Truth], outcome: &Outcome, seen: &mut [bool], tally: &mut Tally) -> bool {
    if !outcome.termination.reached_tolerance() {
        return false;
    }
    let n = problem.a.nrows();
    match index_of(truth, outcome.point[n], &outcome.point[..n]) {
        Some(i) => {
            seen[i] = true;
            true
        }
        None => {
            tally.false_claims += 1;
            false
        }
    }
}

fn print(name: &str, t: &Tally) {
    println!(
        "{name}: {}/{} solvable; first t=0 {} t=1 {}; random {}/{}; found {}/{}; unmatched {}; success {:.3} ms failure {:.3} ms; majors {}\n   {:?}",
        t.solvable,
        t.instances,
        t.first[0],
        t.first[1],
        t.random.0,
        t.random.1,
        t.found,
        t.truth,
        t.false_claims,
        t.success_ms / t.successes.max(1) as f64,
        t.failure_ms / t.failures.max(1) as f64,
        t.majors,
        t.ends
    );
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn random_pencils() {
    for (family, sizes) in [("lambda2", [5, 10, 15, 20]), ("mu", [5, 10, 15, 20])] {
        for n in sizes {
            for seed in [1u64, 2] {
                let mut tally = Tally::default();
                let mut rng = ChaCha8Rng::seed_from_u64(1000 * n as u64 + seed);
                for k in 0..40 {
                    let (k0, k1, m0, free) = random_pencil(&mut rng, n);
                    let problem = if family == "mu" { Embedded::new(k0, k1, free) } else { Embedded::new(k0 + k1 * 3.0, m0, free) };
                    run(&mut tally, &problem, 10.0, k);
                }
                print(&format!("{family} n={n} seed {seed}"), &tally);
            }
        }
    }
}

#[test]
#[ignore = "a measurement: run on request, in release"]
fn table_one() {
    let mut all = Tally::default();
    for phi in [10.0f64, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0] {
        let (s, c) = phi.to_radians().sin_cos();
        for mu in [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0] {
            for (s1, s2) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let (a, b) = table1(c, s, mu, s1, s2);
                run(&mut all, &Embedded::new(a, b, 0), 10.0, (phi + mu) as u64);
            }
        }
    }
    print("table 1", &all);
}

/// Seeds 1 to 6 were looked at while the restarts were chosen; 101 to 106 were not.
#[test]
#[ignore = "a measurement: run on request, in release"]
fn first_starts() {
    for (what, seeds) in [("looked at", 1u64..=6), ("held out", 101..=106)] {
        for restart_limit in [3, 1, 0] {
            for family in ["lambda2", "mu"] {
                for n in [5, 10] {
                    print!("{what}, restarts {restart_limit}: ");
                    first_starts_of(family, n, seeds.clone(), restart_limit);
                }
            }
        }
    }
}

fn first_starts_of(family: &str, n: usize, seeds: std::ops::RangeInclusive<u64>, restart_limit: usize) {
    let (mut solvable, mut ok, mut majors, mut reasons) = (0, [0, 0], 0, BTreeMap::<String, usize>::new());
    let options = Options { restart_limit, ..Options::default() };
    for seed in seeds {
        let mut rng = ChaCha8Rng::seed_from_u64(1000 * n as u64 + seed);
        for _ in 0..40 {
            let (k0, k1, m0, free) = random_pencil(&mut rng, n);
            let problem = if family == "mu" { Embedded::new(k0, k1, free) } else { Embedded::new(k0 + k1 * 3.0, m0, free) };
            let truth = enumerate(&problem.a, &problem.b, free);
            if truth.is_empty() {
                continue;
            }
            solvable += 1;
            for t in [0, 1] {
                let outcome = solve(&problem, &problem.first_start(t as f64), &options).unwrap();
                let right = contains(&truth, outcome.point[n], &outcome.point[..n]);
                ok[t] += usize::from(outcome.termination.reached_tolerance() && right);
                majors += outcome.counters.majors;
                *reasons.entry(format!("{:?} r{}", outcome.termination, outcome.counters.restarts)).or_default() += 1;
            }
        }
    }
    println!("{family} n={n}: {ok:?} of {solvable} majors {majors} {reasons:?}");
}
