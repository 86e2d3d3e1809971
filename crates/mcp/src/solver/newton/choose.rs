//! From the paths of a linearisation to a step (Dirkse and Ferris 1995, section 4).
//!
//! In this order: the end of a path, checked or unchecked; back along the path of the checkpoint,
//! or along this one's, to a point that passes; a projected-gradient step from the best point. What
//! passes is decided by `search`.

use super::super::evaluation::Point;
use super::super::gradient::gradient_step;
use super::super::outcome::{StepKind, Termination};
use super::super::path::{Path, PathEnd, Start};
use super::super::search::NonMonotoneRule;
use super::{NewtonRun, Step};
use crate::mcp::Mcp;

impl<P: Mcp + ?Sized> NewtonRun<'_, P> {
    /// The Newton point if a path is complete and acceptable, else what the fallbacks give.
    ///
    /// # Errors
    /// The reason to end the attempt: F was not finite on the way, or else how the last path ended.
    pub(super) fn choose(
        &mut self,
        point: &Point,
        paths: &[Path],
        search: &mut NonMonotoneRule,
    ) -> Result<Step, Termination> {
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

        let of_path = match paths.last() {
            Some(path) => Termination::of(path.end),
            None => Termination::NoProgress,
        };

        Err(self.problem.not_finite.unwrap_or(of_path))
    }

    /// The end of the first complete path, else of a partial one, checked or unchecked.
    pub(super) fn path_end(
        &mut self,
        point: &Point,
        paths: &[Path],
        search: &mut NonMonotoneRule,
    ) -> Option<Step> {
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

        self.problem.recycle(end);
        None
    }

    /// Where a path leads, with its t: the Newton point of a complete one; of another one its point
    /// of largest t or its last one (a little along the ray), whichever is better. A damped attempt
    /// takes a fraction of a regular path.
    pub(super) fn target(&mut self, path: &Path, fraction: f64) -> Option<(Point, f64)> {
        let last = path.last()?;
        let last_t = *path.knots.t(path.knots.len() - 1);
        if path.start == Start::Ray {
            return Some((self.problem.point_with(|i| last[i]), last_t));
        }

        let t = fraction * path.reach();
        let Some(far) = path.at(t) else {
            return Some((self.problem.point_with(|i| last[i]), last_t));
        };
        let far = self.problem.point_with(far);

        if fraction < 1.0 || path.end == PathEnd::Complete {
            return Some((far, t));
        }

        let last = self.problem.point_with(|i| last[i]);
        if far.merit < last.merit {
            self.problem.recycle(last);
            Some((far, t))
        } else {
            self.problem.recycle(far);
            Some((last, last_t))
        }
    }

    /// Back along the path of the checkpoint if steps were taken unchecked, else along this one's.
    pub(super) fn back_along_paths(
        &mut self,
        paths: &[Path],
        search: &mut NonMonotoneRule,
    ) -> Option<Step> {
        if search.watchdog() {
            self.problem.counters.watchdogs += 1;
            let (point, t) = search.along_checkpoint(&mut self.problem)?;
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
    pub(super) fn gradient(
        &mut self,
        search: &mut NonMonotoneRule,
    ) -> Result<Option<Step>, Termination> {
        if !search.gradient_allowed() {
            return Ok(None);
        }

        let Some(best) = search.best() else {
            return Ok(None);
        };
        let Some(next) = gradient_step(&mut self.problem, best)? else {
            return Ok(None);
        };

        self.problem.counters.gradient_steps += 1;
        search.take_checked(&next);
        Ok(Some((next, StepKind::Gradient)))
    }
}
