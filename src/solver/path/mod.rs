//! The pivotal path of the linear subproblem, from t = 0 at the start to the Newton point at t = 1
//! (Ralph 1994; Dirkse and Ferris 1995, section 3).
//!
//! M z - w + v + D a + (1 - t) r + q = 0, with w and v complementary to the bounds of z, artificials
//! a in a singular starting basis, and r minus the residual at the start, so that t = 0 holds there.
//! Like Lemke's method, one complementary pair is broken at a time. Ties are broken
//! lexicographically: the right-hand side is thought perturbed by the first basis times
//! (eps, eps^2, ...), so that in exact arithmetic no basis repeats on a path that starts on a ray.
//!
//! `variable` names and pivots; `number` the arithmetic, doubles or exact; `start` the two starts, `repair` of singular ones; `basis` the dense
//! inverse; `tableau` the state and its moves; `ratio` the ratio test; `walk` the pivot loop.

mod basis;
mod number;
mod ratio;
mod repair;
mod start;
mod tableau;
mod variable;
mod walk;

pub use variable::{Pivot, PivotKind, Variable};

use super::RatioTest;
use basis::Columns;
use nalgebra::{DMatrix, DVector};
pub(super) use number::Number;
use start::{start_point, starting_basis};
use tableau::Tableau;
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
    pub(super) q: &'a DVector<T>,
    pub(super) lower: &'a [T],
    pub(super) upper: &'a [T],
}

/// Limits on one path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    pub(super) pivots: usize,
    pub(super) cycle_entries: usize,
    pub(super) rule: RatioTest,
}

/// A breakpoint: z and the multipliers w - v at t.
#[derive(Debug, Clone)]
pub(super) struct Knot<T = f64> {
    pub(super) t: T,
    pub(super) z: DVector<T>,
    #[cfg_attr(not(test), allow(dead_code, reason = "read by tests of the path equation"))]
    pub(super) multiplier: DVector<T>,
}

/// A path that was followed to its end: linear between its knots.
#[derive(Debug, Clone)]
pub(super) struct Path<T = f64> {
    pub(super) knots: Vec<Knot<T>>,
    pub(super) pivots: Vec<Pivot>,
    pub(super) end: PathEnd,
    pub(super) start: Start,
    /// Factorisations made on it, with those of its start.
    pub(super) factorisations: usize,
}

/// Follows the path from a start; a regular one begins over `current`, which is within the bounds.
pub(super) fn follow<T: Number>(sub: &Subproblem<'_, T>, start: Start, current: &DVector<T>, limits: Limits) -> Path<T> {
    let point = start_point(sub, start, current);
    let r = &point.multiplier - sub.m * &point.z - sub.q;
    let mut columns = Columns { sub, r, artificial_row: vec![None; current.len()] };
    match starting_basis(&mut columns, &point) {
        Some(basis) => Walk::new(Tableau::new(&columns, basis, point), start, limits).run(),
        None => Path { knots: Vec::new(), pivots: Vec::new(), end: PathEnd::Singular, start, factorisations: 2 },
    }
}

impl<T> Path<T> {
    /// The last point: the Newton point of a complete path, a little along the ray of one that ended so.
    pub(super) fn last(&self) -> Option<&DVector<T>> {
        self.knots.last().map(|k| &k.z)
    }
}

impl Path {
    /// The point where the path first reaches t, linearly between knots.
    pub(super) fn at(&self, t: f64) -> Option<DVector<f64>> {
        let k = self.knots.windows(2).position(|w| w[0].t < t && w[1].t >= t)?;
        let (a, b) = (&self.knots[k], &self.knots[k + 1]);
        Some(a.z.lerp(&b.z, (t - a.t) / (b.t - a.t)))
    }

    /// The largest t on the path.
    pub(super) fn reach(&self) -> f64 {
        self.knots.iter().map(|k| k.t).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests;
