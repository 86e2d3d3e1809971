//! One search under way: runs from starts, curves through what was found, and the lists of results.

use super::same::{repeats, same};
use super::{Certified, Certifier, Found, Progress, Search, Uncertified};
use crate::candidate::Candidate;
use crate::exact::to_f64;
use crate::model::{Admissible, Window};
use crate::reduction::{Embedding, Side};
use crate::solver::{Counters, Curve, Sense, SolverError, continuation, continuation_through, solve};
use crate::tolerance::WINDOW_GAP;

/// Solutions taken from one curve, at most: a cone of solutions is met at every step.
const PER_CURVE: usize = 16;

pub(super) struct Hunt<'a> {
    pub(super) admissible: &'a Admissible<'a>,
    pub(super) window: &'a Window,
    pub(super) search: &'a Search,
    pub(super) certifier: &'a Certifier<'a>,
    pub(super) progress: &'a Progress<'a>,
    pub(super) found: &'a mut Found,
}

impl Hunt<'_> {
    /// Runs on one side of an origin: plain runs and curves take turns; each solution found is at
    /// once left along the two ways of a new curve, until the starts are used up.
    pub(super) fn side(&mut self, side: Side, starts: usize, salt: u64) -> Result<(), SolverError> {
        let embedding = Embedding::new(self.admissible, side);
        let seed = self.search.seed.wrapping_add(salt);
        let mut points = embedding.starts(starts, seed).into_iter();
        let mut left = std::collections::VecDeque::new();
        let mut expanded = 0;
        for k in 0..starts {
            if self.found.interrupted {
                return Ok(());
            }
            while expanded < self.found.certified.len() {
                left.extend([Sense::Down, Sense::Up].map(|sense| (expanded, sense)));
                expanded += 1;
            }
            let plain = !self.search.curves || k % 2 == 0;
            match left.pop_front() {
                Some((known, sense)) if self.search.curves && (k % 3 != 2 || k == 2) => self.leave(&embedding, known, sense, seed)?,
                next => {
                    left.extend(next);
                    let Some(point) = points.next() else { return Ok(()) };
                    if plain { self.plain(&embedding, &point)? } else { self.curve(&embedding, &point)? }
                }
            }
            self.found.interrupted = (self.progress)(self.found).is_break();
        }
        Ok(())
    }

    /// A run of the solver.
    pub(super) fn plain(&mut self, embedding: &Embedding, start: &[f64]) -> Result<(), SolverError> {
        let outcome = solve(embedding, start, &self.search.options)?;
        *self.found.terminations.entry(outcome.termination).or_default() += 1;
        self.count(&outcome.counters);
        let run = self.found.runs;
        self.found.runs += 1;
        if outcome.termination.reached_tolerance() {
            self.file(embedding.candidate(&outcome.point), run);
        }
        self.found.first.get_or_insert(outcome);
        Ok(())
    }

    /// A curve from a start.
    fn curve(&mut self, embedding: &Embedding, start: &[f64]) -> Result<(), SolverError> {
        let curve = continuation(embedding, start, Sense::Down, PER_CURVE, &self.search.options)?;
        self.harvest(embedding, curve)
    }

    /// A curve through a known solution with a random residual direction.
    fn leave(&mut self, embedding: &Embedding, known: usize, sense: Sense, seed: u64) -> Result<(), SolverError> {
        let c = &self.found.certified[known].candidate;
        let point = embedding.point(c.value, &c.x);
        let r = embedding.direction(seed.wrapping_mul(0x9e37_79b9).wrapping_add(known as u64));
        let curve = continuation_through(embedding, &point, &r, sense, PER_CURVE, &self.search.options)?;
        self.harvest(embedding, curve)
    }

    /// The solutions of a curve, each polished by a run of the solver.
    fn harvest(&mut self, embedding: &Embedding, curve: Curve) -> Result<(), SolverError> {
        self.count(&curve.counters);
        *self.found.curves.entry(curve.end).or_default() += 1;
        let run = self.found.runs;
        self.found.runs += 1;
        for point in curve.solutions {
            let polished = solve(embedding, &point, &self.search.options)?;
            self.count(&polished.counters);
            if polished.termination.reached_tolerance() {
                self.file(embedding.candidate(&polished.point), run);
            }
        }
        Ok(())
    }

    fn count(&mut self, counters: &Counters) {
        self.found.pivots += counters.pivots;
        self.found.factorisations += counters.factorisations;
    }

    /// Certifies a candidate and lists it, once.
    fn file(&mut self, candidate: Candidate, run: usize) {
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
                    self.found.certified.push(Certified { claim, candidate, run });
                }
            }
            Err(reason) => self.found.uncertified.push(Uncertified { candidate, reason }),
        }
    }
}
