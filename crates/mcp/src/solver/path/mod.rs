//! The pivotal path of the linear subproblem, from t = 0 at the start to the Newton point at t = 1
//! (Ralph 1994; Dirkse and Ferris 1995, section 3).
//!
//! M z - w + v + D a + (1 - t) r + q = 0, with w and v complementary to the bounds of z,
//! artificials a in a singular starting basis, and r minus the residual at the start, so that t = 0
//! holds there. Like Lemke's method, one complementary pair is broken at a time. Ties are broken
//! lexicographically: the right-hand side is thought perturbed by the first basis times (eps,
//! eps^2, ...), so that in exact arithmetic no basis repeats on a path that starts on a ray.
//!
//! | file | what |
//! |---|---|
//! | `variable`, `number` | names and pivots; the arithmetic, doubles or exact |
//! | `columns`, `factor`, `basis` | the matrix, its factors, exchanges since |
//! | `start` | the two starts, with the repair of singular ones |
//! | `tableau`, `ratio`, `walk` | the state and its moves, the ratio test, the pivot loop |
//! | `knots` | the breakpoints, and points between them |
//!
//! All storage is kept from one path to the next: a path no longer than one before allocates
//! nothing.

mod basis;
mod columns;
mod factor;
mod knots;
mod number;
mod ratio;
mod start;
mod tableau;
mod variable;
mod walk;

pub use variable::{Pivot, PivotKind, Variable};

use super::dense::subtract;
use super::options::RatioTest;
use basis::Basis;
use columns::Frame;
pub(super) use knots::Knots;
use nalgebra::DMatrix;
pub(super) use number::Number;
use start::{FreeRows, start_point, starting_basis};
use tableau::{State, Tableau};
use walk::Walk;

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

/// The linear MCP: M z + q on [lower, upper].
pub(super) struct Subproblem<'a, T: Number = f64> {
    pub(super) m: &'a DMatrix<T>,
    pub(super) q: &'a [T],
    pub(super) lower: &'a [T],
    pub(super) upper: &'a [T],
}

impl<T: Number> Subproblem<'_, T> {
    /// A column of M.
    fn column(&self, j: usize) -> &[T] {
        let n = self.q.len();
        &self.m.as_slice()[j * n..(j + 1) * n]
    }

    /// M z + q, into `out`.
    fn value(&self, z: &[T], out: &mut Vec<T>) {
        out.clear();
        out.extend_from_slice(self.q);
        z.iter()
            .enumerate()
            .for_each(|(j, z)| subtract(out, &-z.clone(), self.column(j)));
    }
}

/// Limits on one path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub(super) pivots: usize,
    pub(super) cycle_entries: usize,
    pub(super) rule: RatioTest,
}

/// A path that was followed to its end: linear between its knots.
#[derive(Debug, Clone)]
pub(super) struct Path<T = f64> {
    pub(super) knots: Knots<T>,
    pub(super) pivots: Vec<Pivot>,
    pub(super) end: PathEnd,
    pub(super) start: Start,
    /// Factorisations made on it, with that of its start.
    pub(super) factorisations: usize,
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

/// What paths are followed with.
pub(super) struct Storage<T = f64> {
    frame: Frame<T>,
    basis: Basis<T>,
    state: State<T>,
    entries: Vec<[usize; 3]>,
    free: FreeRows<T>,
}

impl<T> Default for Storage<T> {
    fn default() -> Self {
        Storage {
            frame: Frame::default(),
            basis: Basis::default(),
            state: State::default(),
            entries: Vec::new(),
            free: FreeRows::default(),
        }
    }
}

/// Follows the path from a start into `path`; a regular one begins over `current`, within the
/// bounds.
pub(super) fn follow<T: Number>(
    sub: &Subproblem<'_, T>,
    start: Start,
    current: &[T],
    limits: Limits,
    storage: &mut Storage<T>,
    path: &mut Path<T>,
) {
    let Storage {
        frame,
        basis,
        state,
        entries,
        free,
    } = storage;
    path.knots.clear(current.len());
    path.pivots.clear();
    (path.start, path.end, path.factorisations) = (start, PathEnd::Singular, 0);
    start_point(sub, start, current, state, free);
    frame.set(sub, &state.z, &state.multiplier);
    if starting_basis(sub, frame, basis, state, path) {
        let tableau = Tableau::new(frame.columns(sub), basis, state);
        Walk::new(tableau, limits, entries, path).run();
    }
}

impl<T: Number> Path<T> {
    /// The first point.
    pub(super) fn first(&self) -> Option<&[T]> {
        self.knots.len().checked_sub(1).map(|_| self.knots.z(0))
    }

    /// The last point: the Newton point of a complete path, a little along the ray of one that
    /// ended so.
    pub(super) fn last(&self) -> Option<&[T]> {
        self.knots.len().checked_sub(1).map(|k| self.knots.z(k))
    }
}

impl Path {
    /// The point where the path first reaches t, linearly between knots.
    pub(super) fn at(&self, t: f64) -> Option<impl Fn(usize) -> f64> {
        let k = (1..self.knots.len())
            .position(|k| self.knots.t(k - 1) < &t && self.knots.t(k) >= &t)?;
        let (a, b) = (self.knots.z(k), self.knots.z(k + 1));
        let share = (t - self.knots.t(k)) / (self.knots.t(k + 1) - self.knots.t(k));
        Some(move |i: usize| a[i] * (1.0 - share) + b[i] * share)
    }

    /// The largest t on the path.
    pub(super) fn reach(&self) -> f64 {
        (0..self.knots.len())
            .map(|k| *self.knots.t(k))
            .fold(0.0, f64::max)
    }

    /// Takes the content of another one in place of its own.
    pub(super) fn copy_from(&mut self, other: &Path) {
        self.knots.copy_from(&other.knots);
        self.pivots.clone_from(&other.pivots);
        (self.end, self.start, self.factorisations) =
            (other.end, other.start, other.factorisations);
    }
}

#[cfg(test)]
mod tests;
