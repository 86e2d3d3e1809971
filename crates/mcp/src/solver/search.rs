//! The non-monotone acceptance of steps: memory, unchecked steps inside a shrinking trust radius,
//! checkpoint, and the search back along a stored path (Grippo, Lampariello and Lucidi 1986; Dirkse
//! and Ferris 1995, section 4).
//!
//! A step to z at parameter t of a path passes if Psi(z) <= (1 - ARMIJO t) R, where the reference R
//! is the largest of the last few merits: the merit may rise for some steps in a curved valley.
//! Short steps may go unchecked some times in a row. Where one that is checked fails, the
//! *watchdog* returns to the *checkpoint*, the last point that was checked, and searches the path
//! from there.
//!
//! One [`NonMonotoneRule`] serves one attempt of a run. Called by `newton` and `newton/choose`.

use super::evaluation::{Evaluated, Point};
use super::options::Options;
use super::path::Path;
use super::restart::{Acceptance, Attempt};
use super::tolerance::{ARMIJO, BACKTRACK, FREE_REFERENCE, NEAR, SMALLEST_T, TRUST, TRUST_SHRINK};
use crate::mcp::Mcp;
use std::collections::VecDeque;

/// State of the non-monotone rule in one attempt. Storage is kept from one to the next.
#[derive(Default)]
pub(super) struct NonMonotoneRule {
    /// The last merits, of which the largest is the reference.
    memory: VecDeque<f64>,
    memory_size: usize,
    /// Every so many steps in a row one is checked.
    frequency: usize,
    maximum_watchdogs: usize,
    /// The longest step, by its largest component, that may go unchecked.
    radius: f64,
    /// Steps taken unchecked in a row.
    unchecked: usize,
    /// Returns to the checkpoint since a full step has passed.
    watchdogs: usize,
    gradient_steps_left: usize,
    /// The path that left the last checked point, if steps were taken unchecked since.
    checkpoint: Path,
    best: Option<Point>,
    first_merit: f64,
    fraction: f64,
}

impl NonMonotoneRule {
    /// At the first point of an attempt from `start`.
    pub(super) fn begin(
        &mut self,
        start: &Point,
        first: &Point,
        options: &Options,
        attempt: Attempt,
    ) {
        let factor = options.nms_initial_reference_factor;
        let reference_factor = match attempt.acceptance {
            Acceptance::NonMonotone => factor,
            Acceptance::Monotone => 1.0,
            Acceptance::Free => FREE_REFERENCE * factor,
        };

        self.memory.clear();
        self.memory.push_back(reference_factor * start.merit);

        self.radius = match attempt.acceptance {
            Acceptance::NonMonotone => TRUST * (1.0 + start.z.amax()),
            Acceptance::Monotone => 0.0,
            Acceptance::Free => f64::INFINITY,
        };

        if attempt.acceptance == Acceptance::Monotone {
            self.memory_size = 1;
            self.frequency = 1;
        } else {
            self.memory_size = options.nms_memory_size;
            self.frequency = options.nms_mstep_frequency;
        }

        self.maximum_watchdogs = options.nms_maximum_watchdogs;
        self.unchecked = 0;
        self.watchdogs = 0;
        self.gradient_steps_left = options.gradient_step_limit;
        self.first_merit = start.merit;
        self.fraction = attempt.fraction;

        // The best point of another attempt lends its storage if it is of the same length.
        let last_best = self.best.take();
        self.best = last_best.filter(|best| best.z.len() == first.z.len());
        self.take_best(first);
    }

    /// The point of least merit in this attempt.
    pub(super) fn best(&self) -> Option<&Point> {
        self.best.as_ref()
    }

    /// The fraction of a path to take from a point of this merit.
    pub(super) fn fraction(&self, merit: f64) -> f64 {
        if merit > NEAR * self.first_merit {
            self.fraction
        } else {
            1.0
        }
    }

    /// The maximum of the remembered merits.
    fn reference(&self) -> f64 {
        self.memory.iter().copied().fold(0.0, f64::max)
    }

    /// May this step be taken without a check? Short ones, all but every tenth in a row.
    pub(super) fn unchecked_allowed(&self, from: &Point, to: &Point) -> bool {
        let is_due = self.unchecked + 1 >= self.frequency;
        if is_due || !to.merit.is_finite() {
            return false;
        }

        distance(from, to) <= self.radius
    }

    /// Does a point pass the test: (1 - sigma t) of the reference?
    pub(super) fn passes(&self, point: &Point, t: f64) -> bool {
        let limit = (1.0 - ARMIJO * t) * self.reference();
        point.merit.is_finite() && point.merit <= limit
    }

    /// Takes an unchecked step; the path from the last checked point is kept for the watchdog.
    pub(super) fn take_unchecked(&mut self, path: &Path, to: &Point) {
        if self.unchecked == 0 {
            self.checkpoint.copy_from(path);
        }

        self.unchecked += 1;
        self.radius *= TRUST_SHRINK;
        self.keep_best(to);
    }

    /// Takes a checked step: its merit enters the memory, and it becomes the new checkpoint.
    pub(super) fn take_checked(&mut self, to: &Point) {
        self.memory.push_back(to.merit);
        while self.memory.len() > self.memory_size {
            self.memory.pop_front();
        }

        self.unchecked = 0;
        self.keep_best(to);
    }

    /// A step has passed the check at full length: watchdogs are counted anew.
    pub(super) fn forgive_watchdogs(&mut self) {
        self.watchdogs = 0;
    }

    /// Returns to the checkpoint, if steps were taken unchecked since: says if there is one, and if
    /// its path may be searched because watchdogs are left.
    pub(super) fn watchdog(&mut self) -> bool {
        if self.unchecked == 0 {
            return false;
        }

        self.unchecked = 0;
        self.watchdogs += 1;
        self.watchdogs <= self.maximum_watchdogs
    }

    /// Like [`NonMonotoneRule::along`], on the path of the checkpoint.
    pub(super) fn along_checkpoint<P: Mcp + ?Sized>(
        &self,
        problem: &mut Evaluated<'_, P>,
    ) -> Option<(Point, f64)> {
        self.along(problem, &self.checkpoint, 1.0)
    }

    /// Is a gradient step left? Counts it.
    pub(super) fn gradient_allowed(&mut self) -> bool {
        let allowed = self.gradient_steps_left > 0;
        self.gradient_steps_left = self.gradient_steps_left.saturating_sub(1);
        allowed
    }

    /// The first point that passes, back along the path from `t`, with its t.
    pub(super) fn along<P: Mcp + ?Sized>(
        &self,
        problem: &mut Evaluated<'_, P>,
        path: &Path,
        t: f64,
    ) -> Option<(Point, f64)> {
        let mut t = t;
        while t >= SMALLEST_T {
            if let Some(z) = path.at(t) {
                let point = problem.point_with(z);
                if self.passes(&point, t) {
                    return Some((point, t));
                }
                problem.recycle(point);
            }

            t *= BACKTRACK;
        }
        None
    }

    /// Keeps a point if no other one of this attempt has a smaller or equal merit.
    fn keep_best(&mut self, point: &Point) {
        let is_better = match &self.best {
            Some(best) => point.merit < best.merit,
            None => true,
        };

        if is_better {
            self.take_best(point);
        }
    }

    fn take_best(&mut self, point: &Point) {
        match &mut self.best {
            Some(best) => best.copy_from(point),
            None => self.best = Some(point.clone()),
        }
    }
}

/// The largest difference of two components.
fn distance(from: &Point, to: &Point) -> f64 {
    let mut largest: f64 = 0.0;
    for (a, b) in to.z.iter().zip(from.z.iter()) {
        largest = largest.max((a - b).abs());
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    fn point(z: &[f64], merit: f64) -> Point {
        Point {
            z: DVector::from_column_slice(z),
            f: DVector::zeros(z.len()),
            merit,
        }
    }

    fn path() -> Path {
        Path::default()
    }

    fn search(k: usize, options: &Options) -> NonMonotoneRule {
        let start = point(&[3.0, -4.0], 8.0);
        let mut search = NonMonotoneRule::default();
        search.begin(
            &start,
            &start,
            options,
            Attempt {
                fraction: 0.5,
                ..Attempt::number(k)
            },
        );
        search
    }

    #[test]
    fn a_fraction_of_the_path_is_taken_while_far() {
        let s = search(0, &Options::default());
        assert_eq!(s.fraction(8.0), 0.5);
        assert_eq!(s.fraction(1.01 * NEAR * 8.0), 0.5);
        assert_eq!(s.fraction(NEAR * 8.0), 1.0);
        assert_eq!(s.fraction(0.0), 1.0);
    }

    /// The best point of an attempt is its own, also where it has the storage of another one.
    #[test]
    fn a_new_attempt_begins_with_its_first_point() {
        let mut s = search(0, &Options::default());
        for z in [&[1.0, 2.0][..], &[5.0], &[6.0]] {
            let first = point(z, 9.0);
            s.begin(&first, &first, &Options::default(), Attempt::number(0));
            assert_eq!(s.best().unwrap().z.as_slice(), z);

            s.take_checked(&point(&vec![0.0; z.len()], 9.0)); // as good, and later
            assert_eq!(s.best().unwrap().z.as_slice(), z);
        }
    }

    /// The largest of the last merits is the reference; a point passes at (1 - sigma t) of it, and
    /// only if finite.
    #[test]
    fn points_pass_against_the_memory() {
        let options = Options {
            nms_memory_size: 3,
            nms_initial_reference_factor: 2.0,
            ..Options::default()
        };
        let mut s = search(0, &options);

        assert_eq!(s.reference(), 16.0);

        for (merit, reference) in [
            (5.0, 16.0),
            (7.0, 16.0),
            (1.0, 7.0),
            (2.0, 7.0),
            (3.0, 3.0),
            (0.5, 3.0),
        ] {
            s.take_checked(&point(&[0.0, 0.0], merit));
            assert_eq!(s.reference(), reference);
        }

        let passes = |merit: f64, t: f64| s.passes(&point(&[0.0, 0.0], merit), t);
        assert!(passes(3.0 * (1.0 - ARMIJO), 1.0));
        assert!(!passes(3.0 * (1.0 - 0.9 * ARMIJO), 1.0));
        assert!(passes(3.0 * (1.0 - 0.9 * ARMIJO), 0.5));
        assert!(!passes(f64::NAN, 1.0));
        assert!(!passes(f64::INFINITY, 1.0));

        let mut monotone = search(4, &options);
        assert_eq!(monotone.reference(), 8.0);

        monotone.take_checked(&point(&[0.0, 0.0], 6.0));
        assert_eq!(monotone.reference(), 6.0);
    }

    /// Short steps go unchecked, all but every tenth in a row; each halves the radius; the first
    /// leaves a checkpoint.
    #[test]
    fn unchecked_steps_are_short_and_counted() {
        let options = Options {
            nms_mstep_frequency: 4,
            nms_maximum_watchdogs: 1,
            ..Options::default()
        };
        let mut s = search(0, &options);
        let radius = TRUST * 5.0;

        assert_eq!(s.radius, radius);

        let allowed = |s: &NonMonotoneRule, far: f64, merit: f64| {
            s.unchecked_allowed(&point(&[1.0, 0.0], 1.0), &point(&[1.0, far], merit))
        };

        // However far from zero.
        let far = [point(&[1e9, 0.0], 1.0), point(&[1e9, 1.0], 1.0)];
        assert!(s.unchecked_allowed(&far[0], &far[1]));
        assert!(allowed(&s, radius, 1e9));
        assert!(!allowed(&s, 1.01 * radius, 1.0));
        assert!(!allowed(&s, 0.0, f64::INFINITY));

        for k in 1..=3 {
            assert!(allowed(&s, 0.0, 1.0), "{k}");

            s.take_unchecked(&path(), &point(&[k as f64, 0.0], 8.0 - k as f64));
            assert_eq!(s.unchecked, k);
            assert_eq!(s.radius, radius * TRUST_SHRINK.powi(k as i32));
            assert_eq!(s.best().unwrap().merit, 8.0 - k as f64);
        }

        assert!(!allowed(&s, 0.0, 1.0));
        assert!(s.watchdog());
        assert_eq!(s.unchecked, 0);
        assert!(!s.watchdog()); // nothing taken since

        s.take_unchecked(&path(), &point(&[0.0, 0.0], 9.0));
        assert_eq!(s.best().unwrap().merit, 5.0);
        assert!(!s.watchdog()); // one is all there was

        s.forgive_watchdogs();
        s.take_unchecked(&path(), &point(&[0.0, 0.0], 9.0));
        assert!(s.watchdog());

        s.take_unchecked(&path(), &point(&[0.0, 0.0], 9.0));
        s.take_checked(&point(&[0.0, 0.0], 9.0));
        assert_eq!(s.unchecked, 0);
        assert!(!s.watchdog());
    }

    #[test]
    fn gradient_steps_are_counted() {
        let mut s = search(
            0,
            &Options {
                gradient_step_limit: 2,
                ..Options::default()
            },
        );

        assert!(s.gradient_allowed());
        assert!(s.gradient_allowed());
        assert!(!s.gradient_allowed());
    }

    /// The reference at the beginning: a multiple of the start's merit, far above it where all is
    /// free, the merit itself where every step must fall.
    #[test]
    fn each_acceptance_begins_with_its_reference() {
        let options = Options {
            nms_initial_reference_factor: 3.0,
            ..Options::default()
        };
        let begun = |acceptance: Acceptance| {
            let start = point(&[3.0, -4.0], 8.0);
            let first = point(&[1.0, 0.0], 2.0);
            let mut search = NonMonotoneRule::default();
            search.begin(
                &start,
                &first,
                &options,
                Attempt {
                    acceptance,
                    ..Attempt::number(1)
                },
            );
            (
                search.reference(),
                search.radius,
                search.best().map(|best| best.merit),
            )
        };

        assert_eq!(
            begun(Acceptance::NonMonotone),
            (24.0, TRUST * 5.0, Some(2.0))
        );
        assert_eq!(
            begun(Acceptance::Free),
            (24.0 * FREE_REFERENCE, f64::INFINITY, Some(2.0))
        );
        assert_eq!(begun(Acceptance::Monotone), (8.0, 0.0, Some(2.0)));
    }
}
