//! What a path is followed with and what it leaves: the kind of its start, its limits, and the
//! record of its knots and pivots, with the reason it ended.

use super::super::number::PathNumber;
use super::super::options::RatioTest;
use super::knots::Knots;
use super::variable::Pivot;

/// Which start a path used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Start {
    /// From the current point, with its active set as basis.
    Regular,
    /// Lemke's ray, from the bounds.
    Ray,
}

/// Why a path ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PathEnd {
    /// t reached 1.
    Complete,
    /// Nothing stops the moving unknown.
    Ray,
    /// One unknown moved too often without progress of t.
    Cycle,
    /// The limit on pivots of one path.
    PivotLimit,
    /// A basis lost its rank to rounding, or no starting basis could be made.
    Singular,
}

/// Limits on one path, and the rule of its ratio test.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct PathLimits {
    /// Pivots.
    pub(in super::super) pivots: usize,
    /// Times one unknown may begin to move without a new maximum of t.
    pub(in super::super) cycle_entries: usize,
    pub(in super::super) rule: RatioTest,
}

/// A path that was followed to its end: linear between its knots.
#[derive(Debug, Clone)]
pub(in super::super) struct Path<T = f64> {
    /// Where its direction changes, in order, with its first and its last point.
    pub(in super::super) knots: Knots<T>,
    /// What happened at them, in order.
    pub(in super::super) pivots: Vec<Pivot>,
    pub(in super::super) end: PathEnd,
    pub(in super::super) start: Start,
    /// Factorisations made on it, with that of its start.
    pub(in super::super) factorisations: usize,
}

impl<T> Default for Path<T> {
    fn default() -> Self {
        Path {
            knots: Knots::default(),
            pivots: Vec::new(),
            end: PathEnd::Singular,
            start: Start::Regular,
            factorisations: 0,
        }
    }
}

impl<T: PathNumber> Path<T> {
    /// Forgets what was recorded: a path of `n` unknowns begins.
    pub(super) fn begin(&mut self, start: Start, n: usize) {
        self.knots.clear(n);
        self.pivots.clear();
        self.start = start;
        self.end = PathEnd::Singular;
        self.factorisations = 0;
    }

    /// The first point.
    pub(in super::super) fn first(&self) -> Option<&[T]> {
        if self.knots.len() == 0 {
            return None;
        }

        Some(self.knots.z(0))
    }

    /// The last point: the Newton point of a complete path, a little along the ray of one that
    /// ended so.
    pub(in super::super) fn last(&self) -> Option<&[T]> {
        let last = self.knots.len().checked_sub(1)?;
        Some(self.knots.z(last))
    }
}

impl Path {
    /// The point where the path first reaches t, linearly between knots; by components.
    pub(in super::super) fn at(&self, t: f64) -> Option<impl Fn(usize) -> f64> {
        let knots = &self.knots;
        let passes = |k: &usize| *knots.t(*k - 1) < t && *knots.t(*k) >= t;
        let end = (1..knots.len()).find(passes)?;
        let begin = end - 1;

        let length = knots.t(end) - knots.t(begin);
        let share = (t - knots.t(begin)) / length;
        let from = knots.z(begin);
        let to = knots.z(end);

        Some(move |i: usize| from[i] * (1.0 - share) + to[i] * share)
    }

    /// The largest t on the path.
    pub(in super::super) fn reach(&self) -> f64 {
        let mut reach: f64 = 0.0;
        for k in 0..self.knots.len() {
            reach = reach.max(*self.knots.t(k));
        }
        reach
    }

    /// Takes the content of another one in place of its own.
    pub(in super::super) fn copy_from(&mut self, other: &Path) {
        self.knots.copy_from(&other.knots);
        self.pivots.clone_from(&other.pivots);
        self.end = other.end;
        self.start = other.start;
        self.factorisations = other.factorisations;
    }
}
