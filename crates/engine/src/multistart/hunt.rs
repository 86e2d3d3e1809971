//! One search under way: runs from starts, then curves ([`super::curves`]), and the lists of
//! results.
//!
//! Proposition 1 or 2 turns the eigenproblem into an MCP over the values on one side of an origin
//! (W1 in chapter 3 of the book). For each such side there are starts: by turns one of a run of the
//! solver and one of a curve. All runs come first. Then curves are followed, and between them each
//! solution that is known is left on new curves.
//!
//! Every point where a run ends with small residuals is handed to the certifier and listed once.
//! Called by [`multistart`](super::multistart).

use super::found::{MultistartFound, Origin};
use super::ground::Ground;
use super::same::support;
use super::search::{Certify, Search};
use super::trace::trace_outcome;
use crate::candidate::Candidate;
use crate::reduction::{Embedding, Side};
use crate::run::{Progress, Watch};
use crate::tolerance::WINDOW_GAP;
use mceip_exact::to_f64;
use mceip_mcp::solver::{Counters, SolverError, Termination, solve};
use mceip_model::{Admissible, Unknown, Window, ZeroVariables};

/// zeta of the first curve of MCEIP-lambda2, in units of the embedding (|A| / |B|).
const FAR_START: f64 = 32.0;
/// Runs between the curves of a side, at most.
const MOST_BETWEEN: usize = 64;
/// First salt of windows around values found.
pub(super) const WINDOW_SALT: u64 = 1000;

/// A search under way.
pub(super) struct Hunt<'a> {
    pub(super) admissible: &'a Admissible<'a>,
    /// The variables of particles in contact with zero reaction.
    pub(super) zero: &'a [ZeroVariables],
    pub(super) window: &'a Window,
    pub(super) search: &'a Search,
    pub(super) certifier: &'a Certify<'a>,
    pub(super) watch: Watch<'a>,
    pub(super) found: MultistartFound,
}

impl Hunt<'_> {
    /// Fresh starts on one side of an origin: by turns a run of the solver and a curve, the runs
    /// first. Between the curves every solution that is known is left on new ones,
    /// [`Search::departures`] times.
    pub(super) fn side(&mut self, side: Side, starts: usize, salt: u64) -> Result<(), SolverError> {
        let seed = self.search.seed.wrapping_add(salt);
        let mut ground = Ground::new(self.admissible, self.zero, side, seed);
        let mut of_runs = Vec::new();
        let mut of_curves = Vec::new();
        for (k, start) in self.starts(&mut ground, starts).into_iter().enumerate() {
            if self.is_curve(k) {
                of_curves.push(start);
            } else {
                of_runs.push(start);
            }
        }

        // All runs first: they say what a run costs, and give the curves something to leave.
        for start in &of_runs {
            self.plain(&ground.embedding, start)?;
            if self.is_interrupted() {
                return Ok(());
            }
        }

        if self.search.curves {
            self.follow(&mut ground, &of_curves)?;
        }

        Ok(())
    }

    /// Is the k-th start that of a curve?
    fn is_curve(&self, k: usize) -> bool {
        self.search.curves && k % 2 == 1
    }

    /// The starts of runs and curves; those of runs between curves are kept in the ground.
    fn starts(&self, ground: &mut Ground, starts: usize) -> Vec<Vec<f64>> {
        let budget = self.search.budget.unwrap_or(0);
        let between = budget.min(MOST_BETWEEN);
        let mut points = ground.embedding.starts(starts + between, ground.seed);
        ground.spare = points.split_off(starts.min(points.len()));
        ground.spare.reverse();

        // At large lambda^2 the pencil is a P matrix, as it is at mu = 0: one end of the curve from
        // the second start is there.
        let second = points.get_mut(1);
        let zeta = second.and_then(|point| point.last_mut());
        if let (Unknown::Lambda2, Some(zeta)) = (self.admissible.unknown(), zeta) {
            *zeta = FAR_START;
        }

        points
    }

    /// Follows the curves from starts. Before each the solutions that are known are left.
    fn follow(&mut self, ground: &mut Ground, starts: &[Vec<f64>]) -> Result<(), SolverError> {
        let mut starts = starts.iter();
        while !self.is_spent() {
            self.depart(ground)?;
            let Some(start) = starts.next() else {
                break;
            };
            if self.found.interrupted || self.is_spent() {
                break;
            }

            self.runs_between(ground)?;
            self.curve(ground, start)?;
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
        let (runs, _) = self.found.plain;
        let budget = self.search.budget.filter(|_| runs > 0)?;
        let allowed = budget.saturating_mul(self.run_cost());
        let done = self.found.pivots + self.found.factorisations;
        Some(allowed.saturating_sub(done))
    }

    /// What a run costs in a budget.
    fn run_cost(&self) -> usize {
        let (runs, work) = self.found.plain;
        let mean = work / runs.max(1);
        mean.max(least_work(self.admissible.pencil().order()))
    }

    /// Tells how far the search has come, and asks whether it is to end.
    pub(super) fn is_interrupted(&mut self) -> bool {
        self.watch.report(&Progress {
            done: self.found.runs as u64,
            solutions: Some(self.found.certified.len() as u64),
            ..Progress::stage("searching")
        });

        self.found.interrupted = self.found.interrupted || self.watch.is_cancelled();
        self.found.interrupted
    }

    /// A run of the solver from a start.
    pub(super) fn plain(
        &mut self,
        embedding: &Embedding,
        start: &[f64],
    ) -> Result<(), SolverError> {
        let outcome = solve(embedding, start, &self.search.options)?;
        self.count_termination(outcome.termination);
        self.trace(|run| format!("run {run} from {start:?}\n{}", trace_outcome(&outcome)));
        self.count(&outcome.counters);
        let (runs, work) = &mut self.found.plain;
        *runs += 1;
        *work += outcome.counters.pivots + outcome.counters.factorisations;

        let run = self.found.runs;
        self.found.runs += 1;
        if outcome.termination.reached_tolerance() {
            let candidate = embedding.candidate(&outcome.point);
            self.file(candidate, run, Origin::Start);
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

    pub(super) fn count_termination(&mut self, termination: Termination) {
        *self.found.terminations.entry(termination).or_default() += 1;
    }

    /// Certifies a candidate and lists it, once. One outside the window is only counted.
    pub(super) fn file(&mut self, candidate: Candidate, run: usize, origin: Origin) {
        if self.is_outside_window(candidate.value) {
            self.found.outside += 1;
            return;
        }
        if self.found.knows(&candidate) {
            self.found.repeated += 1;
            return;
        }

        let claim = (self.certifier)(&candidate);
        let free = self.admissible.pencil().free().len();
        if let Ok(claim) = &claim
            && self.found.is_singular(support(claim), free)
        {
            // Each point of a continuum would be searched around, without end.
            self.found.on_continua += 1;
            return;
        }
        self.found.file(candidate, claim, run, origin);
    }

    /// Is a value outside the window by more than rounding?
    fn is_outside_window(&self, value: f64) -> bool {
        let slack = WINDOW_GAP * (1.0 + value.abs());
        let min = to_f64(self.window.min());
        if value < min - slack {
            return true;
        }

        let max = self.window.max().map(to_f64);
        max.is_some_and(|max| value > max + slack)
    }
}

/// Pivots and factorisations that a run over n variables counts for at least in a budget.
///
/// The budget of curves is a share of the cost of the runs. Short runs would buy few curves, but
/// the curves of an instance are no shorter where its runs are: a curve has some n pieces, and up
/// to n / 2 curves leave each solution.
fn least_work(n: usize) -> usize {
    n * (n + 4) / 2
}
