//! The outer loop: linearise, follow the path to the Newton point, accept it or fall back on
//! watchdog, path search, gradient (`choose`) and restart, in this order (Dirkse and Ferris 1995,
//! section 4).

mod choose;

use super::continuation::{Sense, from_point};
use super::crash::{crash, semismooth};
use super::evaluation::{Evaluated, Point, Pool};
use super::log::Log;
use super::normal_map::linearise;
use super::options::{CrashMethod, Options};
use super::outcome::{Counters, StepKind, Termination};
use super::path::{Limits, Path, PathEnd, Start, Subproblem, follow};
use super::residual::Residuals;
use super::restart::Attempt;
use super::search::Search;
use super::structure::unmatched;
use super::tolerance::{CURVE_TRIALS, MERIT_SLACK};
use super::{crash, path};
use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// Everything a run works with. Whoever owns it may use it for another run, which then allocates
/// only what is longer than before.
#[derive(Default)]
pub(super) struct Workspace {
    pool: Pool,
    crash: crash::Storage,
    path: path::Storage,
    /// Paths from one iterate: at most one of each start.
    paths: [Path; 2],
    q: Vec<f64>,
    search: Search,
    pub(super) log: Log,
    /// The point of least merit met.
    pub(super) point: Vec<f64>,
}

/// A run under way. Inputs are valid: lengths agree, bounds are consistent, the start is finite.
pub(super) struct Run<'a, P: Mcp + ?Sized> {
    problem: Evaluated<'a, P>,
    options: &'a Options,
    space: Workspace,
}

/// An accepted step.
type Step = (Point, StepKind);

impl<'a, P: Mcp + ?Sized> Run<'a, P> {
    pub(super) fn new(problem: &'a P, options: &'a Options, mut space: Workspace) -> Self {
        space.log.clear();
        let problem = Evaluated::with_pool(problem, std::mem::take(&mut space.pool));
        Run {
            problem,
            options,
            space,
        }
    }

    /// Attempts from the start, the first one and the restarts, until the tolerance or a limit. The
    /// best point and the log are left in the workspace.
    pub(super) fn run(mut self, start: &[f64]) -> (Workspace, Residuals, Termination, Counters) {
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
            let from = self.moved(
                &start,
                Attempt::far(trial),
                trial + 1 + self.options.restart_limit,
            );
            reason = self.along_curves(&from, &mut best).unwrap_or(reason);
            self.problem.recycle(from);
        }
        let reason = self.structural(&start, reason).unwrap_or(reason);
        self.problem.recycle(start);
        self.finish(best, reason)
    }

    /// The better reason where the zeros of F' at the start explain why nothing got on.
    fn structural(&mut self, start: &Point, reason: Termination) -> Option<Termination> {
        if !matches!(reason, Termination::NoProgress | Termination::SingularBasis) {
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
        if self.options.curve_step_limit == 0 {
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
        self.problem.not_finite = None;
        reason
    }

    /// One attempt; `best` is left at the point of least merit, or at the one within the tolerance.
    fn attempt(&mut self, start: &Point, attempt: Attempt, best: &mut Point) -> Termination {
        let mut point = self.problem.copy(start);
        if attempt.crash {
            point = match self.crash(point) {
                Ok(point) => point,
                Err(reason) => return reason,
            };
        }
        let mut search = std::mem::take(&mut self.space.search);
        search.begin(start, &point, self.options, attempt);
        let reason = self.majors(&mut point, attempt, &mut search, best);
        self.space.search = search;
        self.problem.recycle(point);
        reason
    }

    /// The crash that the options ask for.
    fn crash(&mut self, start: Point) -> Result<Point, Termination> {
        let Run {
            problem,
            options,
            space,
        } = self;
        let (limit, of, tolerance) = (
            options.crash_iteration_limit,
            problem.problem,
            options.convergence_tolerance,
        );
        if limit == 0 || options.crash_method == CrashMethod::None {
            return Ok(start);
        }
        let mut point = start;
        if options.crash_method == CrashMethod::FischerNewton {
            let done = |point: &Point| is_within_tolerance(of, point, tolerance);
            let (next, done) = semismooth(
                problem,
                point,
                limit,
                done,
                &mut space.crash.semismooth,
                &mut space.log,
            )?;
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
        search: &mut Search,
        best: &mut Point,
    ) -> Termination {
        let (majors, pivots) = self.share();
        let last = (
            self.problem.counters.majors + majors,
            self.problem.counters.pivots + pivots,
        );
        loop {
            if is_within_tolerance(
                self.problem.problem,
                point,
                self.options.convergence_tolerance,
            ) {
                best.copy_from(point);
                return Termination::ToleranceReached;
            }
            if point.merit < best.merit {
                best.copy_from(point);
            }
            if self.problem.counters.majors >= self.options.major_iteration_limit {
                return Termination::MajorLimit;
            }
            if self.problem.counters.pivots >= self.options.cumulative_iteration_limit {
                return Termination::CumulativeLimit;
            }
            if self.problem.counters.majors >= last.0 || self.problem.counters.pivots >= last.1 {
                return Termination::NoProgress;
            }
            match self.major(point, attempt, search) {
                Ok(next) => self.problem.recycle(std::mem::replace(point, next)),
                Err(reason) => return reason,
            }
        }
    }

    /// An even share of the limits on majors and pivots, so that a wandering attempt leaves some to
    /// the restarts.
    fn share(&self) -> (usize, usize) {
        let attempts = (1 + self.options.restart_limit)
            * if self.options.curve_step_limit > 0 {
                2
            } else {
                1
            };
        let Options {
            major_iteration_limit: majors,
            cumulative_iteration_limit: pivots,
            ..
        } = self.options;
        (majors.div_ceil(attempts), pivots.div_ceil(attempts))
    }

    /// One linearisation and the step it leads to.
    fn major(
        &mut self,
        point: &Point,
        attempt: Attempt,
        search: &mut Search,
    ) -> Result<Point, Termination> {
        self.problem.counters.majors += 1;
        let mut m = self.problem.jacobian(point)?;
        let proximal = if attempt.proximal > 0.0 {
            attempt.proximal * m.amax() * point.merit.sqrt().min(1.0)
        } else {
            0.0
        };
        linearise(&mut m, &point.z, &point.f, proximal, &mut self.space.q);
        let mut paths = std::mem::take(&mut self.space.paths);
        self.follow(&m, attempt.first, point, &mut paths[0]);
        let mut count = 1;
        if paths[0].end != PathEnd::Complete {
            let other = if attempt.first == Start::Regular {
                Start::Ray
            } else {
                Start::Regular
            };
            self.follow(&m, other, point, &mut paths[1]);
            count = 2;
        }
        self.problem.recycle_matrix(m);
        let step = self.choose(point, &paths[..count], search);
        let kind = step.as_ref().map_or(StepKind::Failed, |(_, kind)| *kind);
        paths[..count]
            .iter()
            .for_each(|path| self.space.log.path(path));
        self.space.log.step(point.merit, kind, proximal);
        self.space.paths = paths;
        step.map(|(next, _)| next)
    }

    fn follow(&mut self, m: &DMatrix<f64>, start: Start, point: &Point, path: &mut Path) {
        let (problem, options) = (self.problem.problem, self.options);
        let sub = Subproblem {
            m,
            q: &self.space.q,
            lower: problem.lower(),
            upper: problem.upper(),
        };
        let left = options
            .cumulative_iteration_limit
            .saturating_sub(self.problem.counters.pivots);
        let pivots = options.minor_iteration_limit.min(left);
        let limits = Limits {
            pivots,
            cycle_entries: options.cycle_entry_limit,
            rule: options.ratio_test,
        };
        follow(
            &sub,
            start,
            point.z.as_slice(),
            limits,
            &mut self.space.path,
            path,
        );
        self.problem.counters.pivots += path.pivots.len();
        self.problem.counters.factorisations += path.factorisations;
        self.problem.counters.ray_starts += usize::from(start == Start::Ray);
    }

    /// The five residuals of the best point, which with the log is left in the workspace.
    fn finish(
        mut self,
        best: Point,
        termination: Termination,
    ) -> (Workspace, Residuals, Termination, Counters) {
        let jacobian = self.problem.any_jacobian(&best);
        let mut work = self.problem.spare();
        let (z, f) = (best.z.as_slice(), best.f.as_slice());
        let residuals = Residuals::with_gradient(
            self.problem.problem,
            z,
            f,
            &jacobian,
            &mut work.z,
            &mut work.f,
        );
        self.space.point.clear();
        self.space.point.extend_from_slice(z);
        self.problem.recycle_matrix(jacobian);
        self.problem.recycle(work);
        self.problem.recycle(best);
        let (pool, counters) = self.problem.into_parts();
        self.space.pool = pool;
        (self.space, residuals, termination, counters)
    }
}

fn is_within_tolerance<P: Mcp + ?Sized>(problem: &P, point: &Point, tolerance: f64) -> bool {
    // The merit alone says so of most points.
    point.merit <= MERIT_SLACK * 0.5 * point.z.len() as f64 * tolerance * tolerance
        && Residuals::without_gradient(problem, point.z.as_slice(), point.f.as_slice())
            .within(tolerance)
}

/// The unknowns strictly between their bounds, by one allocation.
fn strictly_inside<P: Mcp + ?Sized>(problem: &P, point: &Point) -> Vec<usize> {
    let bounds = problem.lower().iter().zip(problem.upper());
    let mut inside = Vec::with_capacity(point.z.len());
    inside.extend(
        point
            .z
            .iter()
            .zip(bounds)
            .enumerate()
            .filter(|(_, (z, (l, u)))| *l < z && z < u)
            .map(|(i, _)| i),
    );
    inside
}

/// Reasons that no restart can mend.
fn ends_the_run(reason: Termination) -> bool {
    use Termination as T;
    matches!(
        reason,
        T::ToleranceReached | T::MajorLimit | T::CumulativeLimit | T::JacobianShape { .. }
    )
}

#[cfg(test)]
mod tests;
