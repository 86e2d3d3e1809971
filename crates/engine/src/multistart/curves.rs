//! The curves of a search: from starts, and through solutions found; on the circle where there is
//! one.
//!
//! A curve consists of the zeros of the normal map with a multiple of a fixed vector added; the
//! solver follows it ([`continuation`], [`continuation_through`]), and where the multiple is zero
//! it meets a solution. A solution found is left on curves with random vectors, which connect it
//! with others. Within a budget ([`Search::budget`](super::Search::budget)) further runs from
//! starts are made where a curve costs many. Called by [`Hunt::side`].

use super::found::Origin;
use super::ground::Ground;
use super::hunt::Hunt;
use super::trace::trace_outcome;
use crate::candidate::Candidate;
use crate::tolerance::SAME_CURVE_POINT;
use mceip_mcp::solver::{
    Curve, CurveEnd, Options, Sense, SolverError, continuation, continuation_through, solve,
};

/// Largest default number of curves on which a solution is left.
const MOST_DEPARTURES: usize = 3;
/// Solutions that are left on curves, at most: a singular pencil has a continuum of them.
const KNOWN_LIMIT: usize = 64;
/// Spreads the seeds of directions: 2^32 divided by the golden ratio.
const SEED_FACTOR: u64 = 0x9e37_79b9;

impl Hunt<'_> {
    /// The curve from a start: down, and up too unless it has closed.
    pub(super) fn curve(&mut self, ground: &mut Ground, start: &[f64]) -> Result<(), SolverError> {
        let from = ground.point(&ground.embedding.candidate(start));
        for sense in [Sense::Down, Sense::Up] {
            let options = self.curve_options();
            let problem = ground.problem();
            let curve = continuation(problem, &from, sense, ground.enough(), &options)?;

            let end = curve.end;
            self.harvest(ground, curve, Origin::Curve)?;
            if end == CurveEnd::Closed {
                break;
            }
        }

        Ok(())
    }

    /// The options of one curve: no more steps than the budget has pivots and factorisations left.
    /// A step costs one factorisation or some more, so that the last curve may pass the end a
    /// little.
    fn curve_options(&self) -> Options {
        let options = self.search.options.clone();
        let allowed = self.left().unwrap_or(usize::MAX);
        Options {
            curve_step_limit: options.curve_step_limit.min(allowed),
            ..options
        }
    }

    /// Within a budget, before a curve: as many runs as cost half of what a curve costs in the
    /// mean.
    ///
    /// One curve of half the steps it may take is counted beforehand. With two variables a curve
    /// costs as much as ten to a hundred runs, each of which may find something too; from ten
    /// variables on it costs about as much as two, and few runs are made, or none.
    pub(super) fn runs_between(&mut self, ground: &mut Ground) -> Result<(), SolverError> {
        let (runs, run_work) = self.found.plain;
        let first_curve = self.search.options.curve_step_limit / 2;
        let curve_work = ground.curve_work + first_curve;
        let curves = ground.curves + 1;
        // Half the mean work of a curve, divided by the mean work of a run.
        let affordable = curve_work * runs / (2 * run_work * curves).max(1);

        for _ in 0..affordable {
            let Some(start) = ground.spare.pop() else {
                break;
            };
            if self.is_spent() || self.is_interrupted() {
                break;
            }
            self.plain(&ground.embedding, &start)?;
        }

        Ok(())
    }

    /// Leaves the solutions known, also those found on the way, until each was left often enough.
    pub(super) fn depart(&mut self, ground: &mut Ground) -> Result<(), SolverError> {
        let wanted = self.departures_wanted();
        loop {
            let known = self.found.certified.len().min(KNOWN_LIMIT);
            ground.departed.resize(known.max(ground.departed.len()), 0);
            let least = (0..known).min_by_key(|&i| ground.departed[i]);
            let Some(least) = least.filter(|&i| ground.departed[i] < wanted) else {
                return Ok(());
            };

            self.runs_between(ground)?;
            for sense in [Sense::Down, Sense::Up] {
                let is_round = self.leave(ground, least, sense)?;
                if self.is_interrupted() || self.is_spent() {
                    return Ok(());
                }
                if is_round {
                    break;
                }
            }
            ground.departed[least] += 1;
        }
    }

    /// Curves on which each solution is left.
    fn departures_wanted(&self) -> usize {
        let pencil = self.admissible.pencil();
        let slip = pencil.order() - pencil.free().len();
        let by_default = slip.div_ceil(2).min(MOST_DEPARTURES);
        self.search.departures.unwrap_or(by_default)
    }

    /// A curve through a known solution with a random residual direction. Has it come back to it?
    fn leave(
        &mut self,
        ground: &mut Ground,
        known: usize,
        sense: Sense,
    ) -> Result<bool, SolverError> {
        let turn = ground.departed[known];
        let point = ground.point(&self.found.certified[known].candidate);
        let salt = ((turn as u64) << 20) | known as u64;
        let seed = ground.seed.wrapping_mul(SEED_FACTOR).wrapping_add(salt);
        let direction = ground.direction(seed, turn % 2 == 1);

        let curve = continuation_through(
            ground.problem(),
            &point,
            &direction,
            sense,
            ground.enough(),
            &self.curve_options(),
        )?;
        let last_met = curve.solutions.last();
        let ends_here = last_met.is_some_and(|met| is_same_curve_point(met, &point));
        let is_round = curve.end == CurveEnd::Closed && ends_here;

        self.harvest(ground, curve, Origin::Departure)?;
        Ok(is_round)
    }

    /// The solutions of a curve, each that is not known already polished by a run of the solver.
    fn harvest(
        &mut self,
        ground: &mut Ground,
        curve: Curve,
        origin: Origin,
    ) -> Result<(), SolverError> {
        self.count(&curve.counters);
        ground.curves += 1;
        ground.curve_work += curve.counters.pivots + curve.counters.factorisations;
        *self.found.curves.entry(curve.end).or_default() += 1;
        self.trace(|run| {
            format!(
                "curve {run} ({origin:?}) ended {:?}, {:?}, met {:?}\n",
                curve.end, curve.counters, curve.solutions
            )
        });
        let run = self.found.runs;
        self.found.runs += 1;

        for point in &curve.solutions {
            let Some(candidate) = ground.candidate(point) else {
                continue;
            };
            if self.found.knows(&candidate) {
                self.found.met_again += 1;
            } else {
                self.polish(ground, &candidate, run, origin)?;
            }
        }

        Ok(())
    }

    /// A run of the solver from a point of a curve; the point where it ends is listed.
    fn polish(
        &mut self,
        ground: &Ground,
        candidate: &Candidate,
        run: usize,
        origin: Origin,
    ) -> Result<(), SolverError> {
        let polisher = ground.polisher();
        let start = polisher.point(candidate.value, &candidate.x);
        let outcome = solve(polisher, &start, &self.search.options)?;

        self.count(&outcome.counters);
        self.count_termination(outcome.termination);
        self.trace(|_| format!("polished\n{}", trace_outcome(&outcome)));
        if outcome.termination.reached_tolerance() {
            self.file(polisher.candidate(&outcome.point), run, origin);
        }

        Ok(())
    }
}

/// Is a point that a curve meets the given one, up to the accuracy of curves?
fn is_same_curve_point(met: &[f64], point: &[f64]) -> bool {
    for (met, given) in met.iter().zip(point) {
        let difference = (met - given).abs();
        let is_close = difference <= SAME_CURVE_POINT * (1.0 + given.abs());
        if !is_close {
            return false;
        }
    }

    true
}
