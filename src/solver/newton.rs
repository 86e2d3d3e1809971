//! The outer loop: linearise, follow the path to the Newton point, accept it or fall back on
//! watchdog, path search, gradient and restart, in this order (Dirkse and Ferris 1995, section 4).

use super::Options;
use super::continuation::{Sense, from_point};
use super::crash::crash;
use super::evaluation::{Evaluated, Point};
use super::gradient::gradient_step;
use super::normal_map::linearise;
use super::outcome::{MajorRecord, Outcome, PathRecord, StepKind, Termination};
use super::path::{Limits, Path, PathEnd, Start, Subproblem, follow};
use super::residual::Residuals;
use super::restart::Attempt;
use super::search::Search;
use super::structure::unmatched;
use super::tolerance::CURVE_TRIALS;
use crate::mcp::Mcp;
use nalgebra::DVector;

/// A run under way. Inputs are valid: lengths agree, bounds are consistent, the start is finite.
pub(super) struct Run<'a, P: Mcp + ?Sized> {
    problem: Evaluated<'a, P>,
    options: &'a Options,
    log: Vec<MajorRecord>,
}

/// An accepted step.
type Step = (Point, StepKind);

impl<'a, P: Mcp + ?Sized> Run<'a, P> {
    pub(super) fn new(problem: &'a P, options: &'a Options) -> Self {
        let problem = Evaluated::new(problem);
        Run { problem, options, log: Vec::new() }
    }

    /// Attempts from the start, the first one and the restarts, until the tolerance or a limit.
    pub(super) fn run(mut self, start: &[f64]) -> Outcome {
        let start = self.problem.point(&DVector::from_column_slice(start));
        if let Some(reason) = start.not_finite() {
            return self.finish(start, reason);
        }
        let mut best = start.clone();
        let mut reason = self.attempt(&start, Attempt::number(0), &mut best);
        if !ends_the_run(reason) && self.options.curve_step_limit > 0 {
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
            let from = self.moved(&start, Attempt::far(trial), trial + 1 + self.options.restart_limit);
            reason = self.along_curves(&from, &mut best).unwrap_or(reason);
        }
        let reason = self.structural(&start, reason).unwrap_or(reason);
        self.finish(best, reason)
    }

    /// The better reason where the zeros of F' at the start explain why nothing got on.
    fn structural(&mut self, start: &Point, reason: Termination) -> Option<Termination> {
        if !matches!(reason, Termination::NoProgress | Termination::SingularBasis) {
            return None;
        }
        let (lower, upper) = (self.problem.problem.lower(), self.problem.problem.upper());
        let inside: Vec<usize> = (0..start.z.len()).filter(|&i| start.z[i] > lower[i] && start.z[i] < upper[i]).collect();
        let jacobian = self.problem.jacobian(start).ok()?;
        unmatched(&jacobian, &inside).map(|(row, col)| Termination::StructurallySingular { row, col })
    }

    /// One more attempt from the start, moved; then along the curves from there.
    fn restart(&mut self, start: &Point, attempt: Attempt, k: usize, best: &mut Point) -> Termination {
        self.problem.counters.restarts += 1;
        self.record(start.merit, StepKind::Restart, 0.0, &[]);
        let from = self.moved(start, attempt, k);
        let reason = self.attempt(&from, attempt, best);
        if attempt.shift > 0.0 && !ends_the_run(reason) && self.options.curve_step_limit > 0 {
            return self.along_curves(&from, best).unwrap_or(reason);
        }
        reason
    }

    /// The start moved as the attempt asks, if F is finite there.
    fn moved(&mut self, start: &Point, attempt: Attempt, k: usize) -> Point {
        let shifted = self.problem.point(&attempt.shifted(&start.z, k));
        if shifted.merit.is_finite() { shifted } else { start.clone() }
    }

    /// Points from which curves alone are tried at the end: none without restarts or curves.
    fn trials(&self) -> usize {
        if self.options.restart_limit > 0 && self.options.curve_step_limit > 0 { CURVE_TRIALS } else { 0 }
    }

    /// To the first solution on the curve of the Newton homotopy from the start, down and then up,
    /// and from there by Newton; `None` if neither way meets one.
    fn along_curves(&mut self, start: &Point, best: &mut Point) -> Option<Termination> {
        let mut reason = None;
        for sense in [Sense::Down, Sense::Up] {
            let (solutions, _) = from_point(&mut self.problem, start, sense, 1, self.options);
            let Some(z) = solutions.first() else { continue };
            self.record(start.merit, StepKind::Curve, 0.0, &[]);
            let point = self.problem.point(z);
            let next = self.attempt(&point, Attempt::number(1), best);
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
        let limit = if attempt.crash { self.options.crash_iteration_limit } else { 0 };
        let mut point = match crash(&mut self.problem, start.clone(), limit, &mut self.log) {
            Ok(point) => point,
            Err(reason) => return reason,
        };
        let mut search = Search::new(start, &point, self.options, attempt);
        let (majors, pivots) = self.share();
        let last = (self.problem.counters.majors + majors, self.problem.counters.pivots + pivots);
        loop {
            if self.is_within_tolerance(&point) {
                *best = point;
                return Termination::ToleranceReached;
            }
            if point.merit < best.merit {
                *best = point.clone();
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
            match self.major(&point, attempt, &mut search) {
                Ok(next) => point = next,
                Err(reason) => return reason,
            }
        }
    }

    /// An even share of the limits on majors and pivots, so that a wandering attempt leaves some to
    /// the restarts.
    fn share(&self) -> (usize, usize) {
        let attempts = (1 + self.options.restart_limit) * if self.options.curve_step_limit > 0 { 2 } else { 1 };
        let Options { major_iteration_limit: majors, cumulative_iteration_limit: pivots, .. } = self.options;
        (majors.div_ceil(attempts), pivots.div_ceil(attempts))
    }

    fn is_within_tolerance(&self, point: &Point) -> bool {
        Residuals::without_gradient(self.problem.problem, point.z.as_slice(), point.f.as_slice()).within(self.options.convergence_tolerance)
    }

    /// One linearisation and the step it leads to.
    fn major(&mut self, point: &Point, attempt: Attempt, search: &mut Search) -> Result<Point, Termination> {
        self.problem.counters.majors += 1;
        let jacobian = self.problem.jacobian(point)?;
        let proximal = attempt.proximal * jacobian.amax() * point.merit.sqrt().min(1.0);
        let (m, q) = linearise(&jacobian, &point.z, &point.f, proximal);
        let (lower, upper) = (self.problem.problem.lower(), self.problem.problem.upper());
        let sub = Subproblem { m: &m, q: &q, lower, upper };
        let mut paths = vec![self.follow(&sub, attempt.first, point)];
        if paths[0].end != PathEnd::Complete {
            let other = if attempt.first == Start::Regular { Start::Ray } else { Start::Regular };
            paths.push(self.follow(&sub, other, point));
        }
        let step = self.choose(point, &paths, search);
        let kind = step.as_ref().map_or(StepKind::Failed, |(_, kind)| *kind);
        self.record(point.merit, kind, proximal, &paths);
        step.map(|(next, _)| next)
    }

    fn follow(&mut self, sub: &Subproblem<'_>, start: Start, point: &Point) -> Path {
        let left = self.options.cumulative_iteration_limit.saturating_sub(self.problem.counters.pivots);
        let pivots = self.options.minor_iteration_limit.min(left);
        let path =
            follow(sub, start, &point.z, Limits { pivots, cycle_entries: self.options.cycle_entry_limit, rule: self.options.ratio_test });
        self.problem.counters.pivots += path.pivots.len();
        self.problem.counters.factorisations += path.factorisations;
        self.problem.counters.ray_starts += usize::from(start == Start::Ray);
        path
    }

    /// The Newton point if a path is complete and acceptable, else what the fallbacks give.
    fn choose(&mut self, point: &Point, paths: &[Path], search: &mut Search) -> Result<Step, Termination> {
        self.problem.not_finite = None;
        if let Some(step) = self.path_end(point, paths, search) {
            return Ok(step);
        }
        if let Some(step) = self.back_along_paths(paths, search) {
            return Ok(step);
        }
        if let Some(step) = self.gradient(search)? {
            return Ok(step);
        }
        let of_path = paths.last().map_or(Termination::NoProgress, |path| Termination::of(path.end));
        Err(self.problem.not_finite.unwrap_or(of_path))
    }

    /// The end of the first complete path, else of a partial one, checked or unchecked.
    fn path_end(&mut self, point: &Point, paths: &[Path], search: &mut Search) -> Option<Step> {
        let regular = paths.iter().find(|path| path.start == Start::Regular);
        let complete = paths.iter().find(|path| path.end == PathEnd::Complete);
        let path = complete.or(regular)?;
        let (end, t) = self.target(path, search.fraction(point.merit))?;
        if search.passes(&end, 1.0) {
            search.take_checked(&end);
            search.forgive_watchdogs();
            return Some((end, StepKind::Path { t }));
        }
        if search.unchecked_allowed(point, &end) {
            search.take_unchecked(regular.unwrap_or(path), &end);
            return Some((end, StepKind::Unchecked { t }));
        }
        None
    }

    /// Where a path leads, with its t: the Newton point of a complete one; of another one its point
    /// of largest t or its last one (a little along the ray), whichever is better. A damped attempt
    /// takes a fraction of a regular path.
    fn target(&mut self, path: &Path, fraction: f64) -> Option<(Point, f64)> {
        let last = path.knots.last()?;
        if path.start == Start::Ray {
            return Some((self.problem.point(&last.z), last.t));
        }
        let t = fraction * path.reach();
        let far = path.at(t).map(|z| self.problem.point(&z));
        match far {
            Some(far) if fraction < 1.0 || path.end == PathEnd::Complete => Some((far, t)),
            far => {
                let last_point = self.problem.point(&last.z);
                let better = far.filter(|far| far.merit < last_point.merit);
                Some(better.map_or((last_point, last.t), |far| (far, t)))
            }
        }
    }

    /// Back along the path of the checkpoint if steps were taken unchecked, else along this one's.
    fn back_along_paths(&mut self, paths: &[Path], search: &mut Search) -> Option<Step> {
        if let Some(checkpoint) = search.watchdog() {
            self.problem.counters.watchdogs += 1;
            let (point, t) = search.along(&mut self.problem, &checkpoint.path, 1.0)?;
            search.take_checked(&point);
            return Some((point, StepKind::Watchdog { t }));
        }
        // Only a regular path begins at the iterate, so that points near its start are near it.
        let path = paths.iter().find(|path| path.start == Start::Regular)?;
        let (point, t) = search.along(&mut self.problem, path, path.reach())?;
        search.take_checked(&point);
        Some((point, StepKind::Search { t }))
    }

    /// A projected-gradient step from the best point, while the limit lasts.
    fn gradient(&mut self, search: &mut Search) -> Result<Option<Step>, Termination> {
        if !search.gradient_allowed() {
            return Ok(None);
        }
        let Some(next) = gradient_step(&mut self.problem, search.best())? else { return Ok(None) };
        self.problem.counters.gradient_steps += 1;
        search.take_checked(&next);
        Ok(Some((next, StepKind::Gradient)))
    }

    fn record(&mut self, merit: f64, step: StepKind, proximal: f64, paths: &[Path]) {
        let of = |path: &Path| PathRecord { start: path.start, end: path.end, reach: path.reach(), pivots: path.pivots.clone() };
        self.log.push(MajorRecord { merit, step, proximal, paths: paths.iter().map(of).collect() });
    }

    fn finish(mut self, best: Point, termination: Termination) -> Outcome {
        self.problem.counters.functions += 1;
        self.problem.counters.jacobians += 1;
        let residuals = Residuals::at(self.problem.problem, best.z.as_slice());
        let point = best.z.as_slice().to_vec();
        Outcome { point, residuals, termination, log: self.log, counters: self.problem.counters }
    }
}

/// Reasons that no restart can mend.
fn ends_the_run(reason: Termination) -> bool {
    use Termination as T;
    matches!(reason, T::ToleranceReached | T::MajorLimit | T::CumulativeLimit | T::JacobianShape { .. })
}
