//! One search under way: runs from starts, curves through what was found, and the lists of results.

use super::same::{repeats, same};
use super::trace::trace_outcome;
use super::{Certified, Certifier, Found, Origin, Progress, Search, Uncertified};
use crate::candidate::Candidate;
use crate::exact::to_f64;
use crate::model::{Admissible, Unknown, Window};
use crate::reduction::{Embedding, Side};
use crate::solver::{Counters, Curve, Sense, SolverError, continuation, continuation_through, solve};
use crate::tolerance::WINDOW_GAP;

/// Solutions taken from one curve, at most: a cone of solutions is met at every step.
const PER_CURVE: usize = 16;
/// zeta of the first curve of MCEIP-lambda2, in units of the embedding (|A| / |B|).
const FAR_START: f64 = 32.0;
/// Largest default number of curves on which a solution is left.
const MOST_DEPARTURES: usize = 6;
/// First salt of windows around values found.
pub(super) const WINDOW_SALT: u64 = 1000;
/// Solutions that are left on curves, at most: a singular pencil has a continuum of them.
const KNOWN_LIMIT: usize = 64;

pub(super) struct Hunt<'a> {
    pub(super) admissible: &'a Admissible<'a>,
    pub(super) window: &'a Window,
    pub(super) search: &'a Search,
    pub(super) certifier: &'a Certifier<'a>,
    pub(super) progress: &'a Progress<'a>,
    pub(super) found: &'a mut Found,
}

impl Hunt<'_> {
    /// Fresh starts on one side of an origin: by turns a run of the solver and a curve. After each,
    /// every solution that is known is left on new curves, up and down, [`Search::departures`] times.
    pub(super) fn side(&mut self, side: Side, starts: usize, salt: u64) -> Result<(), SolverError> {
        let embedding = Embedding::new(self.admissible, side);
        let seed = self.search.seed.wrapping_add(salt);
        let mut departed = Vec::new();
        let mut points = embedding.starts(starts, seed);
        if let (Unknown::Lambda2, Some(zeta)) = (self.admissible.unknown(), points.get_mut(1).and_then(|p| p.last_mut())) {
            // At large lambda^2 the pencil is a P matrix, as it is at mu = 0: one end of the curve is there.
            *zeta = FAR_START;
        }
        for (k, point) in points.iter().enumerate() {
            if self.search.curves && k % 2 == 1 {
                self.curve(&embedding, point)?
            } else {
                self.plain(&embedding, point)?
            }
            if self.search.curves {
                self.depart(&embedding, &mut departed, seed)?;
            }
            if self.is_interrupted() {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Leaves the solutions known, also those found on the way, until each was left often enough.
    /// `departed` counts, in the order of discovery.
    fn depart(&mut self, embedding: &Embedding, departed: &mut Vec<usize>, seed: u64) -> Result<(), SolverError> {
        let slip = self.admissible.pencil().order() - self.admissible.pencil().free().len();
        let wanted = self.search.departures.unwrap_or(slip.div_ceil(2).min(MOST_DEPARTURES));
        loop {
            let known = self.found.certified.len().min(KNOWN_LIMIT);
            departed.resize(known.max(departed.len()), 0);
            let Some(least) = (0..known).min_by_key(|&i| departed[i]).filter(|&i| departed[i] < wanted) else {
                return Ok(());
            };
            for sense in [Sense::Down, Sense::Up] {
                self.leave(embedding, least, sense, departed[least], seed)?;
                if self.is_interrupted() {
                    return Ok(());
                }
            }
            departed[least] += 1;
        }
    }

    fn is_interrupted(&mut self) -> bool {
        self.found.interrupted = self.found.interrupted || (self.progress)(self.found).is_break();
        self.found.interrupted
    }

    /// A run of the solver.
    pub(super) fn plain(&mut self, embedding: &Embedding, start: &[f64]) -> Result<(), SolverError> {
        let outcome = solve(embedding, start, &self.search.options)?;
        *self.found.terminations.entry(outcome.termination).or_default() += 1;
        self.trace(|run| format!("run {run} from {start:?}\n{}", trace_outcome(&outcome)));
        self.count(&outcome.counters);
        let run = self.found.runs;
        self.found.runs += 1;
        if outcome.termination.reached_tolerance() {
            self.file(embedding.candidate(&outcome.point), run, Origin::Start);
        }
        self.found.first.get_or_insert(outcome);
        Ok(())
    }

    /// The curve from a start, both ways.
    fn curve(&mut self, embedding: &Embedding, start: &[f64]) -> Result<(), SolverError> {
        for sense in [Sense::Down, Sense::Up] {
            let curve = continuation(embedding, start, sense, PER_CURVE, &self.search.options)?;
            self.harvest(embedding, curve, Origin::Curve)?;
        }
        Ok(())
    }

    /// A curve through a known solution with a random residual direction.
    fn leave(&mut self, embedding: &Embedding, known: usize, sense: Sense, turn: usize, seed: u64) -> Result<(), SolverError> {
        let c = &self.found.certified[known].candidate;
        let point = embedding.point(c.value, &c.x);
        let salt = (turn as u64) << 20 | known as u64;
        let r = embedding.direction(seed.wrapping_mul(0x9e37_79b9).wrapping_add(salt), turn % 2 == 1);
        let curve = continuation_through(embedding, &point, &r, sense, PER_CURVE, &self.search.options)?;
        self.harvest(embedding, curve, Origin::Departure)
    }

    /// The solutions of a curve, each polished by a run of the solver.
    fn harvest(&mut self, embedding: &Embedding, curve: Curve, origin: Origin) -> Result<(), SolverError> {
        self.count(&curve.counters);
        *self.found.curves.entry(curve.end).or_default() += 1;
        self.trace(|run| format!("curve {run} ({origin:?}) ended {:?}, {:?}, met {:?}\n", curve.end, curve.counters, curve.solutions));
        let run = self.found.runs;
        self.found.runs += 1;
        for point in curve.solutions {
            let polished = solve(embedding, &point, &self.search.options)?;
            self.count(&polished.counters);
            *self.found.terminations.entry(polished.termination).or_default() += 1;
            self.trace(|_| format!("polished\n{}", trace_outcome(&polished)));
            if polished.termination.reached_tolerance() {
                self.file(embedding.candidate(&polished.point), run, origin);
            }
        }
        Ok(())
    }

    /// Keeps a log entry if a trace was asked for; the closure gets the number of the run.
    fn trace(&mut self, entry: impl FnOnce(usize) -> String) {
        if self.search.trace {
            let text = entry(self.found.runs);
            self.found.trace.push(text);
        }
    }

    fn count(&mut self, counters: &Counters) {
        self.found.pivots += counters.pivots;
        self.found.factorisations += counters.factorisations;
    }

    /// Certifies a candidate and lists it, once.
    fn file(&mut self, candidate: Candidate, run: usize, origin: Origin) {
        let slack = WINDOW_GAP * (1.0 + candidate.value.abs());
        if candidate.value < to_f64(self.window.min()) - slack || self.window.max().is_some_and(|m| candidate.value > to_f64(m) + slack) {
            self.found.outside += 1;
            return;
        }
        let certified = self.found.certified.iter().map(|c| &c.candidate);
        if certified.chain(self.found.uncertified.iter().map(|u| &u.candidate)).any(|c| repeats(c, &candidate)) {
            self.found.repeated += 1;
            return;
        }
        match (self.certifier)(&candidate) {
            Ok(claim) => {
                if !self.found.certified.iter().any(|c| same(&c.claim, &claim)) {
                    self.found.certified.push(Certified { claim, candidate, run, origin });
                }
            }
            Err(reason) => self.found.uncertified.push(Uncertified { candidate, reason }),
        }
    }
}
