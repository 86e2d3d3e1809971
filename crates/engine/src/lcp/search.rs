//! Many starts on a plain problem: Lemke's ray first, then the solver and curves from seeded
//! points.
#![allow(clippy::float_arithmetic)]

use super::certify::Uncertifiable;
use super::certify::certify;
use super::exact::ExactMcp;
use crate::multistart::trace_outcome;
use mceip_exact::Rational;
use mceip_mcp::solver::{
    Counters, Options, Outcome, Sense, SolverError, Termination, continuation, solve, solve_linear,
};
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
    /// The log of every run and curve as text, if it was asked for.
    pub trace: Vec<String>,
}

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Starts.
    pub starts: usize,
    /// Go on after the first certified solution, and follow curves?
    pub all: bool,
    /// Seed of the random starts.
    pub seed: u64,
    /// Keep the log of every run as text?
    pub trace: bool,
    /// Options of each run.
    pub options: Options,
}

/// Run 0 is Lemke's method, run 1 the solver from 0; then by turns the solver and, with `all`,
/// curves from random points (standard Cauchy components, so that all scales occur).
///
/// Without `all` it stops at the first certified solution.
///
/// # Errors
/// [`SolverError`] for options and numbers that make no sense.
pub fn search(problem: &ExactMcp, how: &Search) -> Result<Found, SolverError> {
    let doubles = problem.to_f64()?;
    let mut rng = ChaCha8Rng::seed_from_u64(how.seed);
    let mut hunt = Hunt {
        problem,
        is_traced: how.trace,
        found: Found::default(),
    };
    for k in 0..how.starts {
        if !how.all && !hunt.found.certified.is_empty() {
            break;
        }
        let mut cauchy = || (std::f64::consts::PI * (rng.random_range(0.01..0.99) - 0.5)).tan();
        let start: Vec<f64> = (0..problem.dimension())
            .map(|_| if k < 2 { 0.0 } else { cauchy() })
            .collect();
        if how.all && k % 2 == 1 {
            for sense in [Sense::Down, Sense::Up] {
                let curve = continuation(&doubles, &start, sense, 16, &how.options)?;
                hunt.count(&curve.counters);
                hunt.trace(|| {
                    format!(
                        "curve from {start:?} {sense:?} ended {:?}, met {:?}\n",
                        curve.end, curve.solutions
                    )
                });
                for point in curve.solutions {
                    hunt.run(solve(&doubles, &point, &how.options)?, &point);
                }
            }
        }
        let outcome = if k == 0 {
            solve_linear(&doubles, &how.options)?
        } else {
            solve(&doubles, &start, &how.options)?
        };
        hunt.run(outcome, &start);
    }
    Ok(hunt.found)
}

struct Hunt<'a> {
    problem: &'a ExactMcp,
    is_traced: bool,
    found: Found,
}

impl Hunt<'_> {
    fn trace(&mut self, entry: impl FnOnce() -> String) {
        if self.is_traced {
            self.found.trace.push(entry());
        }
    }

    fn count(&mut self, counters: &Counters) {
        self.found.runs += 1;
        self.found.counters.0 += counters.pivots;
        self.found.counters.1 += counters.factorisations;
    }

    fn run(&mut self, outcome: Outcome, start: &[f64]) {
        self.count(&outcome.counters);
        self.trace(|| format!("run from {start:?}\n{}", trace_outcome(&outcome)));
        let found = &mut self.found;
        *found.terminations.entry(outcome.termination).or_default() += 1;
        if outcome.termination.reached_tolerance() {
            match certify(self.problem, &outcome.point) {
                Ok(z) if !found.certified.contains(&z) => found.certified.push(z),
                Ok(_) => {}
                Err(reason) => found.uncertified.push((outcome.point.clone(), reason)),
            }
        }
        found.first.get_or_insert(outcome);
    }
}
