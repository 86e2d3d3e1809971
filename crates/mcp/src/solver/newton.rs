//! The outer loop of a run (Dirkse and Ferris 1995, section 4; book, 3.3).
//!
//! At a point z the problem is linearised: M = F'(z) plus a proximal term, q = F(z) - M z. The path
//! of the linear problem leads from z to its solution, the *Newton point* (`path/`). From the paths
//! `choose` makes a step: their end, a point back along them, or a gradient step. An *attempt* is a
//! sequence of such steps, in attempt 0 after a crash; a *run* is a sequence of attempts and curves
//! of the Newton homotopy, until a point is within the tolerance or a limit is reached.
//!
//! Input: a problem, a start and options that `validate` has accepted. Output: [`Finished`], with
//! the best point and the log in the workspace. Called by `reuse`.

mod choose;

use super::continuation::{Sense, from_point};
use super::crash::{crash, semismooth};
use super::evaluation::{Evaluated, Point, Pool};
use super::fischer::GradientStorage;
use super::log::Log;
use super::normal_map::linearise;
use super::options::{CrashMethod, Options};
use super::outcome::{Counters, StepKind, Termination};
use super::path::{Path, PathEnd, PathLimits, Start, Subproblem};
use super::residual::Residuals;
use super::restart::Attempt;
use super::search::NonMonotoneRule;
use super::structure::unmatched;
use super::tolerance::{CURVE_TRIALS, DENSE_ORDER, MERIT_SLACK};
use super::{crash, path};
use crate::mcp::Mcp;
use nalgebra::DMatrix;
use std::mem::{replace, take};

/// Everything a run works with. Whoever owns it may use it for another run, which then allocates
/// only what is longer than before.
#[derive(Default)]
pub(super) struct Workspace {
    pool: Pool,
    crash: crash::CrashStorage,
    path: path::PathStorage,
    /// Paths from one iterate: at most one of each start.
    paths: [Path; 2],
    q: Vec<f64>,
    search: NonMonotoneRule,
    pub(super) log: Log,
    /// The point of least merit met.
    pub(super) point: Vec<f64>,
}

/// The end of a run.
pub(super) struct Finished {
    /// Holds the best point and the log.
    pub(super) space: Workspace,
    /// The residuals of the best point.
    pub(super) residuals: Residuals,
    pub(super) termination: Termination,
    pub(super) counters: Counters,
}

/// A run under way. Inputs are valid: lengths agree, bounds are consistent, the start is finite.
pub(super) struct NewtonRun<'a, P: Mcp + ?Sized> {
    problem: Evaluated<'a, P>,
    options: &'a Options,
    space: Workspace,
}

/// An accepted step.
type Step = (Point, StepKind);

/// Numbers of linearisations and of pivots.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Work {
    majors: usize,
    pivots: usize,
}

impl<'a, P: Mcp + ?Sized> NewtonRun<'a, P> {
    pub(super) fn new(problem: &'a P, options: &'a Options, mut space: Workspace) -> Self {
        space.log.clear();
        let problem = Evaluated::with_pool(problem, take(&mut space.pool));

        NewtonRun {
            problem,
            options,
            space,
        }
    }

    /// Attempts from the start, the first one and the restarts, until the tolerance or a limit. The
    /// best point and the log are left in the workspace.
    pub(super) fn run(mut self, start: &[f64]) -> Finished {
        let start = self.problem.point_with(|i| start[i]);
        if let Some(reason) = start.not_finite() {
            return self.finish(start, reason);
        }

        let mut best = self.problem.copy(&start);
        let mut reason = self.attempt(&start, Attempt::number(0), &mut best);
        if !ends_the_run(reason) {
            reason = self.along_curves(&start, &mut best).unwrap_or(reason);
        }

        for k in 1..=self.options.restart_limit {
            if ends_the_run(reason) {
                break;
            }
            reason = self.restart(&start, Attempt::number(k), k, &mut best);
        }

        // Last, curves alone from other points: they cost little and reach far.
        for trial in 0..self.trials() {
            if ends_the_run(reason) {
                break;
            }

            let k = trial + 1 + self.options.restart_limit;
            let from = self.moved(&start, Attempt::far(trial), k);
            reason = self.along_curves(&from, &mut best).unwrap_or(reason);
            self.problem.recycle(from);
        }

        let reason = self.structural(&start, reason).unwrap_or(reason);
        self.problem.recycle(start);
        self.finish(best, reason)
    }

    /// The better reason where the zeros of F' at the start explain why nothing got on.
    fn structural(&mut self, start: &Point, reason: Termination) -> Option<Termination> {
        let is_vague = matches!(
            reason,
            Termination::NoProgress
                | Termination::SingularBasis
                | Termination::TooLargeForPaths { .. }
        );
        if !is_vague {
            return None;
        }

        let inside = strictly_inside(self.problem.problem, start);
        let jacobian = self.problem.jacobian(start).ok()?;
        let found = unmatched(&jacobian, &inside);
        self.problem.recycle_matrix(jacobian);

        found.map(|(row, col)| Termination::StructurallySingular { row, col })
    }

    /// One more attempt from the start, moved; then along the curves from there.
    fn restart(
        &mut self,
        start: &Point,
        attempt: Attempt,
        k: usize,
        best: &mut Point,
    ) -> Termination {
        self.problem.counters.restarts += 1;
        self.space.log.step(start.merit, StepKind::Restart, 0.0);

        let from = self.moved(start, attempt, k);
        let mut reason = self.attempt(&from, attempt, best);
        if attempt.shift > 0.0 && !ends_the_run(reason) {
            reason = self.along_curves(&from, best).unwrap_or(reason);
        }

        self.problem.recycle(from);
        reason
    }

    /// The start moved as the attempt asks, if F is finite there.
    fn moved(&mut self, start: &Point, attempt: Attempt, k: usize) -> Point {
        let mut shifted = self
            .problem
            .point_with(|i| attempt.shifted(start.z[i], i, k));

        if !shifted.merit.is_finite() {
            shifted.copy_from(start);
        }
        shifted
    }

    /// Points from which curves alone are tried at the end: none without restarts or curves.
    fn trials(&self) -> usize {
        if self.options.restart_limit > 0 && self.options.curve_step_limit > 0 {
            CURVE_TRIALS
        } else {
            0
        }
    }

    /// To the first solution on the curve of the Newton homotopy from the start, down and then up,
    /// and from there by Newton; `None` if neither way meets one, or none may be followed.
    fn along_curves(&mut self, start: &Point, best: &mut Point) -> Option<Termination> {
        if self.options.curve_step_limit == 0 || self.problem.is_too_large_for_paths() {
            return None;
        }

        let mut reason = None;
        for sense in [Sense::Down, Sense::Up] {
            let (solutions, _) = from_point(&mut self.problem, start, sense, 1, self.options);
            let Some(z) = solutions.first() else { continue };

            self.space.log.step(start.merit, StepKind::Curve, 0.0);
            let point = self.problem.point(z);
            let next = self.attempt(&point, Attempt::number(1), best);
            self.problem.recycle(point);
            reason = Some(next);

            if ends_the_run(next) {
                break;
            }
        }

        // A value that was not finite on a curve is no reason to end the run.
        self.problem.not_finite = None;
        reason
    }

    /// One attempt; `best` is left at the point of least merit, or at the one within the tolerance.
    fn attempt(&mut self, start: &Point, attempt: Attempt, best: &mut Point) -> Termination {
        let mut point = self.problem.copy(start);
        // Without paths a crash is all there is, and from the same start it would go the same way.
        let has_no_paths = self.problem.is_too_large_for_paths() && attempt.shift > 0.0;
        if attempt.crash || has_no_paths {
            point = match self.crash(point) {
                Ok(point) => point,
                Err(reason) => return reason,
            };
        }

        let mut search = take(&mut self.space.search);
        search.begin(start, &point, self.options, attempt);
        let reason = self.majors(&mut point, attempt, &mut search, best);

        self.space.search = search;
        self.problem.recycle(point);
        reason
    }

    /// The crash that the options ask for.
    fn crash(&mut self, start: Point) -> Result<Point, Termination> {
        let NewtonRun {
            problem,
            options,
            space,
        } = self;

        let limit = options.crash_iteration_limit;
        if limit == 0 || options.crash_method == CrashMethod::None {
            return Ok(start);
        }

        let mut point = start;
        if options.crash_method == CrashMethod::FischerNewton {
            let tolerance = options.convergence_tolerance;
            let mcp = problem.problem;
            let ending = crash::Ending {
                limit,
                done: |point: &Point| is_within_tolerance(mcp, point, tolerance),
            };
            let storage = &mut space.crash.semismooth;
            let (next, done) = semismooth(problem, point, ending, storage, &mut space.log)?;
            if done {
                return Ok(next);
            }
            point = next;
        }

        crash(problem, point, limit, &mut space.crash, &mut space.log)
    }

    /// Linearisations from a point until there is a reason to stop.
    fn majors(
        &mut self,
        point: &mut Point,
        attempt: Attempt,
        search: &mut NonMonotoneRule,
        best: &mut Point,
    ) -> Termination {
        let tolerance = self.options.convergence_tolerance;
        let share = self.share();
        let last = Work {
            majors: self.problem.counters.majors + share.majors,
            pivots: self.problem.counters.pivots + share.pivots,
        };

        loop {
            if is_within_tolerance(self.problem.problem, point, tolerance) {
                best.copy_from(point);
                return Termination::ToleranceReached;
            }

            if point.merit < best.merit {
                best.copy_from(point);
            }

            if let Some(limit) = self.limit_reached(last) {
                return limit;
            }

            match self.major(point, attempt, search) {
                Ok(next) => self.problem.recycle(replace(point, next)),
                Err(reason) => return reason,
            }
        }
    }

    /// The limit of the run that is reached, or `NoProgress` for the share of the attempt, which
    /// ends at `last`.
    fn limit_reached(&self, last: Work) -> Option<Termination> {
        let done = &self.problem.counters;
        if done.majors >= self.options.major_iteration_limit {
            Some(Termination::MajorLimit)
        } else if done.pivots >= self.options.cumulative_iteration_limit {
            Some(Termination::CumulativeLimit)
        } else if done.majors >= last.majors || done.pivots >= last.pivots {
            Some(Termination::NoProgress)
        } else {
            None
        }
    }

    /// An even share of the limits on majors and pivots, so that a wandering attempt leaves some to
    /// the restarts.
    fn share(&self) -> Work {
        let follows_curves = self.options.curve_step_limit > 0;
        let attempts_of_each = if follows_curves { 2 } else { 1 };
        let attempts = (1 + self.options.restart_limit) * attempts_of_each;

        Work {
            majors: self.options.major_iteration_limit.div_ceil(attempts),
            pivots: self.options.cumulative_iteration_limit.div_ceil(attempts),
        }
    }

    /// One linearisation and the step it leads to.
    fn major(
        &mut self,
        point: &Point,
        attempt: Attempt,
        search: &mut NonMonotoneRule,
    ) -> Result<Point, Termination> {
        self.problem.counters.majors += 1;
        let jacobian = self.problem.jacobian(point)?;
        if self.problem.is_too_large_for_paths() {
            return Err(Termination::TooLargeForPaths {
                order: self.problem.problem.dimension(),
                limit: DENSE_ORDER,
            });
        }

        let mut m = jacobian.into_dense();
        let proximal = if attempt.proximal > 0.0 {
            attempt.proximal * m.amax() * point.merit.sqrt().min(1.0)
        } else {
            0.0
        };

        linearise(&mut m, &point.z, &point.f, proximal, &mut self.space.q);

        let mut paths = take(&mut self.space.paths);
        let count = self.follow_paths(&m, attempt.first, point, &mut paths);
        self.problem.recycle_matrix(m.into());
        let step = self.choose(point, &paths[..count], search);

        let kind = step.as_ref().map_or(StepKind::Failed, |(_, kind)| *kind);
        for path in &paths[..count] {
            self.space.log.path(path);
        }

        self.space.log.step(point.merit, kind, proximal);
        self.space.paths = paths;
        step.map(|(next, _)| next)
    }

    /// Follows the path from the first kind of start, and where it is not complete that from the
    /// other kind; returns their number.
    fn follow_paths(
        &mut self,
        m: &DMatrix<f64>,
        first: Start,
        point: &Point,
        paths: &mut [Path; 2],
    ) -> usize {
        self.follow(m, first, point, &mut paths[0]);
        if paths[0].end == PathEnd::Complete {
            return 1;
        }

        let other = match first {
            Start::Regular => Start::Ray,
            Start::Ray => Start::Regular,
        };
        self.follow(m, other, point, &mut paths[1]);

        2
    }

    /// Follows the path of M z + q, q in the workspace, and counts its work.
    fn follow(&mut self, m: &DMatrix<f64>, start: Start, point: &Point, path: &mut Path) {
        let problem = self.problem.problem;
        let subproblem = Subproblem {
            m,
            q: &self.space.q,
            lower: problem.lower(),
            upper: problem.upper(),
        };

        let counters = &mut self.problem.counters;
        let left = self
            .options
            .cumulative_iteration_limit
            .saturating_sub(counters.pivots);
        let limits = PathLimits {
            pivots: self.options.minor_iteration_limit.min(left),
            cycle_entries: self.options.cycle_entry_limit,
            rule: self.options.ratio_test,
        };

        let storage = &mut self.space.path;
        storage.follow(&subproblem, start, point.z.as_slice(), limits, path);
        counters.pivots += path.pivots.len();
        counters.factorisations += path.factorisations;
        counters.ray_starts += usize::from(start == Start::Ray);
    }

    /// The five residuals of the best point, which with the log is left in the workspace.
    fn finish(mut self, best: Point, termination: Termination) -> Finished {
        let jacobian = self.problem.any_jacobian(&best);
        let mut spare = self.problem.spare();
        let mut storage = GradientStorage {
            gradient: &mut spare.z,
            work: &mut spare.f,
        };
        let z = best.z.as_slice();
        let f = best.f.as_slice();
        let mcp = self.problem.problem;
        let residuals = Residuals::with_gradient(mcp, z, f, &jacobian, &mut storage);

        self.space.point.clear();
        self.space.point.extend_from_slice(z);

        self.problem.recycle_matrix(jacobian);
        self.problem.recycle(spare);
        self.problem.recycle(best);
        let (pool, counters) = self.problem.into_parts();
        self.space.pool = pool;

        Finished {
            space: self.space,
            residuals,
            termination,
            counters,
        }
    }
}

/// Are the four residuals within the tolerance? The merit alone refuses most points:
/// |Phi|_inf <= tolerance is impossible where 2 Psi > n tolerance^2.
fn is_within_tolerance<P: Mcp + ?Sized>(problem: &P, point: &Point, tolerance: f64) -> bool {
    let n = point.z.len() as f64;
    let is_merit_small = point.merit <= MERIT_SLACK * 0.5 * n * tolerance * tolerance;
    if !is_merit_small {
        return false;
    }

    Residuals::without_gradient(problem, point.z.as_slice(), point.f.as_slice()).within(tolerance)
}

/// The unknowns strictly between their bounds, by one allocation.
fn strictly_inside<P: Mcp + ?Sized>(problem: &P, point: &Point) -> Vec<usize> {
    let bounds = problem.lower().iter().zip(problem.upper());
    let mut inside = Vec::with_capacity(point.z.len());

    for (i, (z, (lower, upper))) in point.z.iter().zip(bounds).enumerate() {
        if lower < z && z < upper {
            inside.push(i);
        }
    }
    inside
}

/// Reasons that no restart can mend.
fn ends_the_run(reason: Termination) -> bool {
    matches!(
        reason,
        Termination::ToleranceReached
            | Termination::MajorLimit
            | Termination::CumulativeLimit
            | Termination::JacobianShape { .. }
    )
}

#[cfg(test)]
mod tests;
