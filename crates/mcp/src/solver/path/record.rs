//! What a path is followed with and what it leaves: the kind of its start, its limits, and the
//! record of its knots and pivots, with the reason it ended.

use super::super::number::Number;
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

/// Limits on one path.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Limits {
    pub(in super::super) pivots: usize,
    pub(in super::super) cycle_entries: usize,
    pub(in super::super) rule: RatioTest,
}

/// A path that was followed to its end: linear between its knots.
#[derive(Debug, Clone)]
pub(in super::super) struct Path<T = f64> {
    pub(in super::super) knots: Knots<T>,
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

impl<T: Number> Path<T> {
    /// The first point.
    pub(in super::super) fn first(&self) -> Option<&[T]> {
        self.knots.len().checked_sub(1).map(|_| self.knots.z(0))
    }

    /// The last point: the Newton point of a complete path, a little along the ray of one that
    /// ended so.
    pub(in super::super) fn last(&self) -> Option<&[T]> {
        self.knots.len().checked_sub(1).map(|k| self.knots.z(k))
    }
}

impl Path {
    /// The point where the path first reaches t, linearly between knots.
    pub(in super::super) fn at(&self, t: f64) -> Option<impl Fn(usize) -> f64> {
        let k = (1..self.knots.len())
            .position(|k| self.knots.t(k - 1) < &t && self.knots.t(k) >= &t)?;
        let (a, b) = (self.knots.z(k), self.knots.z(k + 1));
        let share = (t - self.knots.t(k)) / (self.knots.t(k + 1) - self.knots.t(k));
        Some(move |i: usize| a[i] * (1.0 - share) + b[i] * share)
    }

    /// The largest t on the path.
    pub(in super::super) fn reach(&self) -> f64 {
        (0..self.knots.len())
            .map(|k| *self.knots.t(k))
            .fold(0.0, f64::max)
    }

    /// Takes the content of another one in place of its own.
    pub(in super::super) fn copy_from(&mut self, other: &Path) {
        self.knots.copy_from(&other.knots);
        self.pivots.clone_from(&other.pivots);
        (self.end, self.start, self.factorisations) =
            (other.end, other.start, other.factorisations);
    }
}
