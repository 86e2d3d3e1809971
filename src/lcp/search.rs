//! Many starts on a plain problem: Lemke's ray first, then the solver and curves from seeded points.
#![allow(clippy::float_arithmetic)]

use super::{ExactMcp, Uncertifiable, certify};
use crate::exact::Rational;
use crate::solver::{Counters, Options, Outcome, Sense, SolverError, Termination, continuation, solve, solve_linear};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;

/// What a search of a plain problem found.
#[derive(Debug, Clone, Default)]
pub struct Found {
    /// Distinct exact solutions, in the order of discovery.
    pub certified: Vec<Vec<Rational>>,
    /// Points within the tolerance that are no certified solution, with the reason.
    pub uncertified: Vec<(Vec<f64>, Uncertifiable)>,
    /// How often each reason ended a run.
    pub terminations: BTreeMap<Termination, usize>,
    /// Runs and curves made.
    pub runs: usize,
    /// Pivots and factorisations made.
    pub counters: (usize, usize),
    /// Outcome of the first run (Lemke's method).
    pub first: Option<Outcome>,
}

/// Run 0 is Lemke's method, run 1 the solver from 0; then by turns the solver and, with `all`, curves
/// from random points (standard Cauchy components, so that all scales occur).
///
/// Without `all` it stops at the first certified solution.
///
/// # Errors
/// [`SolverError`] for options and numbers that make no sense.
pub fn search(problem: &ExactMcp, starts: usize, all: bool, seed: u64, options: &Options) -> Result<Found, SolverError> {
    let doubles = problem.to_f64()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut found = Found::default();
    for k in 0..starts {
        if !all && !found.certified.is_empty() {
            break;
        }
        let mut cauchy = || (std::f64::consts::PI * (rng.random_range(0.01..0.99) - 0.5)).tan();
        let start: Vec<f64> = (0..problem.dimension()).map(|_| if k < 2 { 0.0 } else { cauchy() }).collect();
        if all && k % 2 == 1 {
            for sense in [Sense::Down, Sense::Up] {
                let curve = continuation(&doubles, &start, sense, 16, options)?;
                count(&mut found, &curve.counters);
                for point in curve.solutions {
                    run(problem, &mut found, solve(&doubles, &point, options)?);
                }
            }
        }
        let outcome = if k == 0 { solve_linear(&doubles, options)? } else { solve(&doubles, &start, options)? };
        run(problem, &mut found, outcome);
    }
    Ok(found)
}

fn count(found: &mut Found, counters: &Counters) {
    found.runs += 1;
    found.counters.0 += counters.pivots;
    found.counters.1 += counters.factorisations;
}

fn run(problem: &ExactMcp, found: &mut Found, outcome: Outcome) {
    count(found, &outcome.counters);
    *found.terminations.entry(outcome.termination).or_default() += 1;
    if outcome.termination.reached_tolerance() {
        match certify(problem, &outcome.point) {
            Ok(z) if !found.certified.contains(&z) => found.certified.push(z),
            Ok(_) => {}
            Err(reason) => found.uncertified.push((outcome.point.clone(), reason)),
        }
    }
    found.first.get_or_insert(outcome);
}
