//! One search under way: runs from starts, then curves ([`super::curves`]), and the lists of
//! results.

use super::found::{Found, Origin};
use super::ground::Ground;
use super::search::{Certifier, Search};
use super::trace::trace_outcome;
use crate::candidate::Candidate;
use crate::reduction::{Embedding, Side};
use crate::run::{Progress, Watch};
use crate::tolerance::WINDOW_GAP;
use mceip_exact::to_f64;
use mceip_mcp::solver::{Counters, SolverError, solve};
use mceip_model::{Admissible, Unknown, Window};

/// zeta of the first curve of MCEIP-lambda2, in units of the embedding (|A| / |B|).
const FAR_START: f64 = 32.0;
/// Runs between the curves of a side, at most.
const MOST_BETWEEN: usize = 64;
/// First salt of windows around values found.
pub(super) const WINDOW_SALT: u64 = 1000;

/// A search under way.
pub(super) struct Hunt<'a> {
    pub(super) admissible: &'a Admissible<'a>,
    pub(super) window: &'a Window,
    pub(super) search: &'a Search,
    pub(super) certifier: &'a Certifier<'a>,
    pub(super) watch: Watch<'a>,
    pub(super) found: &'a mut Found,
}

impl Hunt<'_> {
    /// Fresh starts on one side of an origin: by turns a run of the solver and a curve, the runs
    /// first. Between the curves every solution that is known is left on new ones,
    /// [`Search::departures`] times.
    pub(super) fn side(&mut self, side: Side, starts: usize, salt: u64) -> Result<(), SolverError> {
        let seed = self.search.seed.wrapping_add(salt);
        let mut ground = Ground::new(self.admissible, side, seed);
        let mut points = ground.embedding.starts(
            starts
                + self
                    .search
                    .budget
                    .map_or(0, |budget| budget.min(MOST_BETWEEN)),
            seed,
        );
        ground.spare = points.split_off(starts.min(points.len()));
        ground.spare.reverse();
        if let (Unknown::Lambda2, Some(zeta)) = (
            self.admissible.unknown(),
            points.get_mut(1).and_then(|p| p.last_mut()),
        ) {
            // At large lambda^2 the pencil is a P matrix, as it is at mu = 0: one end of the curve
            // is there.
            *zeta = FAR_START;
        }
        // All runs first: they say what a run costs, and give the curves something to leave.
        let follows = self.search.curves;
        let is_curve = |k: usize| follows && k % 2 == 1;
        for (_, point) in points.iter().enumerate().filter(|(k, _)| !is_curve(*k)) {
            self.plain(&ground.embedding, point)?;
            if self.is_interrupted() {
                return Ok(());
            }
        }
        let mut curves = points.iter().enumerate().filter(|(k, _)| is_curve(*k));
        while follows && !self.is_spent() {
            self.depart(&mut ground)?;
            let Some((_, point)) = curves
                .next()
                .filter(|_| !self.found.interrupted && !self.is_spent())
            else {
                break;
            };
            self.runs_between(&mut ground)?;
            self.curve(&mut ground, point)?;
            if self.is_interrupted() {
                break;
            }
        }
        Ok(())
    }

    /// Have runs and curves cost what [`Search::budget`] allows?
    pub(super) fn is_spent(&self) -> bool {
        self.left() == Some(0)
    }

    /// Pivots and factorisations that [`Search::budget`] leaves; `None` without a budget, and
    /// before the first run. The mean of the runs made says what a run costs, and [`least_work`]
    /// what it costs at least.
    pub(super) fn left(&self) -> Option<usize> {
        let budget = self.search.budget.filter(|_| self.found.plain.0 > 0)?;
        Some(
            budget
                .saturating_mul(self.run_cost())
                .saturating_sub(self.found.pivots + self.found.factorisations),
        )
    }

    /// What a run costs in a budget.
    fn run_cost(&self) -> usize {
        let (runs, work) = self.found.plain;
        (work / runs.max(1)).max(least_work(self.admissible.pencil().order()))
    }

    pub(super) fn is_interrupted(&mut self) -> bool {
        self.watch.report(&Progress {
            done: self.found.runs as u64,
            solutions: Some(self.found.certified.len() as u64),
            ..Progress::stage("searching")
        });
        self.found.interrupted = self.found.interrupted || self.watch.is_cancelled();
        self.found.interrupted
    }

    /// A run of the solver.
    pub(super) fn plain(
        &mut self,
        embedding: &Embedding,
        start: &[f64],
    ) -> Result<(), SolverError> {
        let outcome = solve(embedding, start, &self.search.options)?;
        *self
            .found
            .terminations
            .entry(outcome.termination)
            .or_default() += 1;
        self.trace(|run| format!("run {run} from {start:?}\n{}", trace_outcome(&outcome)));
        self.count(&outcome.counters);
        self.found.plain.0 += 1;
        self.found.plain.1 += outcome.counters.pivots + outcome.counters.factorisations;
        let run = self.found.runs;
        self.found.runs += 1;
        if outcome.termination.reached_tolerance() {
            self.file(embedding.candidate(&outcome.point), run, Origin::Start);
        }
        self.found.first.get_or_insert(outcome);
        Ok(())
    }

    /// Keeps a log entry if a trace was asked for; the closure gets the number of the run.
    pub(super) fn trace(&mut self, entry: impl FnOnce(usize) -> String) {
        if self.search.trace {
            let text = entry(self.found.runs);
            self.found.trace.push(text);
        }
    }

    pub(super) fn count(&mut self, counters: &Counters) {
        self.found.pivots += counters.pivots;
        self.found.factorisations += counters.factorisations;
    }

    /// Certifies a candidate and lists it, once.
    pub(super) fn file(&mut self, candidate: Candidate, run: usize, origin: Origin) {
        let slack = WINDOW_GAP * (1.0 + candidate.value.abs());
        if candidate.value < to_f64(self.window.min()) - slack
            || self
                .window
                .max()
                .is_some_and(|m| candidate.value > to_f64(m) + slack)
        {
            self.found.outside += 1;
            return;
        }
        if self.found.knows(&candidate) {
            self.found.repeated += 1;
            return;
        }
        let claim = (self.certifier)(&candidate);
        self.found.file(candidate, claim, run, origin);
    }
}

/// Pivots and factorisations that a run over n variables counts for at least in a budget.
///
/// The budget of curves is a share of the cost of the runs. Short runs would buy few curves, but the
/// curves of an instance are no shorter where its runs are: a curve has some n pieces, and up to
/// n / 2 curves leave each solution.
fn least_work(n: usize) -> usize {
    n * (n + 4) / 2
}
