//! Many starts on a plain problem: Lemke's ray first, then the solver and curves from seeded
//! points.
//!
//! Input: an exact problem and how much to search ([`PlainSearch`]). Output: what was found and
//! certified ([`PlainFound`]). Called by `mceip solve` for plain problems.
#![allow(clippy::float_arithmetic)]

use super::certify::Uncertifiable;
use super::certify::certify;
use super::exact::ExactMcp;
use crate::multistart::{require_starts, trace_outcome};
use crate::run::{Progress, Watch};
use mceip_exact::Rational;
use mceip_mcp::mcp::LinearMcp;
use mceip_mcp::solver::{
    Counters, Options, Outcome, Sense, SolverError, Termination, continuation, solve, solve_linear,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// What a search of a plain problem found.
#[derive(Debug, Clone, Default)]
pub struct PlainFound {
    /// Distinct exact solutions, in the order of discovery.
    pub certified: Vec<Vec<Rational>>,
    /// Points within the tolerance that are no certified solution, with the reason.
    pub uncertified: Vec<(Vec<f64>, Uncertifiable)>,
    /// How often each reason ended a run.
    pub terminations: BTreeMap<Termination, usize>,
    /// Runs of the solver.
    pub runs: usize,
    /// Curves followed.
    pub curves: usize,
    /// Pivots and factorisations made.
    pub counters: (usize, usize),
    /// Outcome of the first run (Lemke's method).
    pub first: Option<Outcome>,
    /// The log of every run and curve as text, if it was asked for.
    pub trace: Vec<String>,
    /// Was the search cancelled?
    pub interrupted: bool,
}

/// How to search.
#[derive(Debug, Clone, PartialEq)]
pub struct PlainSearch {
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
/// Without `all` it stops at the first certified solution. A search that is cancelled keeps what it
/// has found.
///
/// # Errors
/// [`SolverError`] for options and numbers that make no sense.
pub fn search(
    problem: &ExactMcp,
    how: &PlainSearch,
    watch: &Watch<'_>,
) -> Result<PlainFound, SolverError> {
    require_starts(how.starts, problem.dimension())?;
    let mut hunt = PlainHunt {
        problem,
        doubles: problem.to_f64()?,
        how,
        found: PlainFound::default(),
    };

    let mut rng = ChaCha8Rng::seed_from_u64(how.seed);

    for run in 0..how.starts {
        if !how.all && !hunt.found.certified.is_empty() {
            break;
        }
        if watch.is_cancelled() {
            hunt.found.interrupted = true;
            break;
        }

        watch.report(&Progress::of("searching", run, how.starts));
        let start = if run < 2 {
            vec![0.0; problem.dimension()]
        } else {
            random_start(problem.dimension(), &mut rng)
        };

        if how.all && run % 2 == 1 {
            hunt.follow_curve(&start, Sense::Down)?;
            hunt.follow_curve(&start, Sense::Up)?;
        }
        if run == 0 {
            let outcome = solve_linear(&hunt.doubles, &how.options)?;
            hunt.record_run(outcome, &start);
        } else {
            hunt.run_solver(&start)?;
        }
    }

    Ok(hunt.found)
}

/// Points met on a curve beyond which it is not followed.
const CURVE_SOLUTIONS: usize = 16;

/// Standard Cauchy components, cut at the outer hundredths of their distribution.
fn random_start(dimension: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut start = vec![0.0; dimension];
    for component in &mut start {
        let quantile = rng.random_range(0.01..0.99);
        *component = (PI * (quantile - 0.5)).tan();
    }
    start
}

/// A search under way.
struct PlainHunt<'a> {
    problem: &'a ExactMcp,
    doubles: LinearMcp,
    how: &'a PlainSearch,
    found: PlainFound,
}

impl PlainHunt<'_> {
    /// Follows the curve through a point, and solves from every solution it meets.
    fn follow_curve(&mut self, start: &[f64], sense: Sense) -> Result<(), SolverError> {
        let options = &self.how.options;
        let curve = continuation(&self.doubles, start, sense, CURVE_SOLUTIONS, options)?;
        self.found.curves += 1;
        self.count(&curve.counters);
        if self.how.trace {
            self.found.trace.push(format!(
                "curve from {start:?} {sense:?} ended {:?}, met {:?}\n",
                curve.end, curve.solutions
            ));
        }

        for point in &curve.solutions {
            self.run_solver(point)?;
        }

        Ok(())
    }

    fn run_solver(&mut self, start: &[f64]) -> Result<(), SolverError> {
        let outcome = solve(&self.doubles, start, &self.how.options)?;
        self.record_run(outcome, start);
        Ok(())
    }

    fn count(&mut self, counters: &Counters) {
        self.found.counters.0 += counters.pivots;
        self.found.counters.1 += counters.factorisations;
    }

    /// Counts a run, and certifies its point if it is within the tolerance.
    fn record_run(&mut self, outcome: Outcome, start: &[f64]) {
        self.found.runs += 1;
        self.count(&outcome.counters);
        if self.how.trace {
            let log = trace_outcome(&outcome);
            self.found.trace.push(format!("run from {start:?}\n{log}"));
        }

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
