//! F and F' with their counts, and points that carry their value and merit.

use super::fischer;
use super::outcome::{Counters, NonFinite, Termination};
use crate::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// A point within the bounds with F and the Fischer merit Psi there (infinite if F is not finite).
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub(super) z: DVector<f64>,
    pub(super) f: DVector<f64>,
    pub(super) merit: f64,
}

/// A problem whose evaluations are counted.
pub(super) struct Evaluated<'a, P: Mcp + ?Sized> {
    pub(super) problem: &'a P,
    pub(super) counters: Counters,
    /// The last value of F that was not finite, until somebody takes it.
    pub(super) not_finite: Option<Termination>,
}

impl<'a, P: Mcp + ?Sized> Evaluated<'a, P> {
    pub(super) fn new(problem: &'a P) -> Self {
        Evaluated { problem, counters: Counters::default(), not_finite: None }
    }

    /// The point z, projected onto the bounds, with F and merit.
    pub(super) fn point(&mut self, z: &DVector<f64>) -> Point {
        self.counters.functions += 1;
        let z = super::normal_map::project(z, self.problem.lower(), self.problem.upper());
        let mut f = DVector::zeros(z.len());
        self.problem.function(z.as_slice(), f.as_mut_slice());
        let merit = fischer::merit(self.problem, &z, &f);
        let point = Point { z, f, merit };
        self.not_finite = point.not_finite().or(self.not_finite);
        point
    }

    /// F' at a point.
    ///
    /// # Errors
    /// [`Termination::JacobianShape`]; [`Termination::NonFinite`] naming the first entry.
    pub(super) fn jacobian(&mut self, point: &Point) -> Result<DMatrix<f64>, Termination> {
        self.counters.jacobians += 1;
        let n = point.z.len();
        let j = raw_jacobian(self.problem, point.z.as_slice());
        if j.shape() != (n, n) {
            return Err(Termination::JacobianShape { rows: j.nrows(), cols: j.ncols() });
        }
        for row in 0..n {
            let bad = (0..n).find(|&col| !j[(row, col)].is_finite());
            if let Some(col) = bad {
                return Err(Termination::NonFinite(NonFinite::Jacobian { row, col }));
            }
        }
        Ok(j)
    }
}

/// F' at z, n x n even if the callback has resized it: what it left out is NaN.
pub(super) fn jacobian_at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let n = z.len();
    let j = raw_jacobian(problem, z);
    if j.shape() == (n, n) { j } else { j.resize(n, n, f64::NAN) }
}

/// F' at z in whatever shape the callback has left it.
fn raw_jacobian<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let mut j = DMatrix::zeros(z.len(), z.len());
    problem.jacobian(z, &mut j);
    j
}

impl Point {
    /// The first component of F that is not finite, as a reason to stop.
    pub(super) fn not_finite(&self) -> Option<Termination> {
        let row = self.f.iter().position(|v| !v.is_finite())?;
        Some(Termination::NonFinite(NonFinite::Function { row }))
    }
}
