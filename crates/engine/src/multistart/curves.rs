//! The curves of a search: from starts, and through solutions found; on the circle where there is
//! one.

use super::found::Origin;
use super::ground::Ground;
use super::hunt::Hunt;
use super::trace::trace_outcome;
use crate::tolerance::SAME_CURVE_POINT;
use mceip_mcp::solver::{
    Curve, CurveEnd, Options, Sense, SolverError, continuation, continuation_through, solve,
};

/// Largest default number of curves on which a solution is left.
const MOST_DEPARTURES: usize = 3;
/// Solutions that are left on curves, at most: a singular pencil has a continuum of them.
const KNOWN_LIMIT: usize = 64;

impl Hunt<'_> {
    /// The curve from a start: down, and up too unless it has closed.
    pub(super) fn curve(&mut self, ground: &mut Ground, start: &[f64]) -> Result<(), SolverError> {
        let from = ground.point(&ground.embedding.candidate(start));
        for sense in [Sense::Down, Sense::Up] {
            let curve = continuation(
                ground.problem(),
                &from,
                sense,
                ground.enough(),
                &self.curve_options(),
            )?;
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
    /// mean, where one of half the steps it may take is counted beforehand. With two variables a
    /// curve is as dear as ten to a hundred runs, each of which may find something too; from ten
    /// variables on it is as cheap as two, and few runs are made, or none.
    pub(super) fn runs_between(&mut self, ground: &mut Ground) -> Result<(), SolverError> {
        let (runs, of_runs) = self.found.plain;
        let (curves, of_curves) = ground.followed;
        let dear = (of_curves + self.search.options.curve_step_limit / 2) * runs
            / (2 * of_runs * (curves + 1)).max(1);
        for _ in 0..dear {
            let Some(start) = ground
                .spare
                .pop()
                .filter(|_| !self.is_spent() && !self.is_interrupted())
            else {
                break;
            };
            self.plain(&ground.embedding, &start)?;
        }
        Ok(())
    }

    /// Leaves the solutions known, also those found on the way, until each was left often enough.
    pub(super) fn depart(&mut self, ground: &mut Ground) -> Result<(), SolverError> {
        let slip = self.admissible.pencil().order() - self.admissible.pencil().free().len();
        let wanted = self
            .search
            .departures
            .unwrap_or(slip.div_ceil(2).min(MOST_DEPARTURES));
        loop {
            let known = self.found.certified.len().min(KNOWN_LIMIT);
            ground.departed.resize(known.max(ground.departed.len()), 0);
            let Some(least) = (0..known)
                .min_by_key(|&i| ground.departed[i])
                .filter(|&i| ground.departed[i] < wanted)
            else {
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

    /// A curve through a known solution with a random residual direction. Has it come back to it?
    fn leave(
        &mut self,
        ground: &mut Ground,
        known: usize,
        sense: Sense,
    ) -> Result<bool, SolverError> {
        let turn = ground.departed[known];
        let point = ground.point(&self.found.certified[known].candidate);
        let salt = (turn as u64) << 20 | known as u64;
        let r = ground.direction(
            ground.seed.wrapping_mul(0x9e37_79b9).wrapping_add(salt),
            turn % 2 == 1,
        );
        let curve = continuation_through(
            ground.problem(),
            &point,
            &r,
            sense,
            ground.enough(),
            &self.curve_options(),
        )?;
        let is_here = |z: &Vec<f64>| {
            z.iter()
                .zip(&point)
                .all(|(a, b)| (a - b).abs() <= SAME_CURVE_POINT * (1.0 + b.abs()))
        };
        let is_round = curve.end == CurveEnd::Closed && curve.solutions.last().is_some_and(is_here);
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
        ground.followed.0 += 1;
        ground.followed.1 += curve.counters.pivots + curve.counters.factorisations;
        *self.found.curves.entry(curve.end).or_default() += 1;
        self.trace(|run| {
            format!(
                "curve {run} ({origin:?}) ended {:?}, {:?}, met {:?}\n",
                curve.end, curve.counters, curve.solutions
            )
        });
        let run = self.found.runs;
        self.found.runs += 1;
        for candidate in curve.solutions.iter().filter_map(|z| ground.candidate(z)) {
            if self.found.knows(&candidate) {
                self.found.met_again += 1;
                continue;
            }
            let polisher = ground.polisher();
            let point = polisher.point(candidate.value, &candidate.x);
            let polished = solve(polisher, &point, &self.search.options)?;
            self.count(&polished.counters);
            *self
                .found
                .terminations
                .entry(polished.termination)
                .or_default() += 1;
            self.trace(|_| format!("polished\n{}", trace_outcome(&polished)));
            if polished.termination.reached_tolerance() {
                self.file(polisher.candidate(&polished.point), run, origin);
            }
        }
        Ok(())
    }
}
