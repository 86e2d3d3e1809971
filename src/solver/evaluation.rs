//! F and F' with their counts, and points that carry their value and merit, in storage that is kept.

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

/// Points and matrices that nobody uses at the moment.
#[derive(Default)]
pub(super) struct Pool {
    points: Vec<Point>,
    matrices: Vec<DMatrix<f64>>,
}

/// A problem whose evaluations are counted.
pub(super) struct Evaluated<'a, P: Mcp + ?Sized> {
    pub(super) problem: &'a P,
    pub(super) counters: Counters,
    /// The last value of F that was not finite, until somebody takes it.
    pub(super) not_finite: Option<Termination>,
    pool: Pool,
}

impl<'a, P: Mcp + ?Sized> Evaluated<'a, P> {
    pub(super) fn new(problem: &'a P) -> Self {
        Evaluated::with_pool(problem, Pool::default())
    }

    /// With what another problem has left behind.
    pub(super) fn with_pool(problem: &'a P, pool: Pool) -> Self {
        Evaluated { problem, counters: Counters::default(), not_finite: None, pool }
    }

    /// What may be used again, and the counts.
    pub(super) fn into_parts(self) -> (Pool, Counters) {
        (self.pool, self.counters)
    }

    /// The point z, projected onto the bounds, with F and merit.
    pub(super) fn point(&mut self, z: &DVector<f64>) -> Point {
        self.point_with(|i| z[i])
    }

    /// The point with components z(i), projected onto the bounds, with F and merit.
    pub(super) fn point_with(&mut self, z: impl Fn(usize) -> f64) -> Point {
        self.counters.functions += 1;
        let mut point = self.spare();
        let bounds = self.problem.lower().iter().zip(self.problem.upper());
        for (i, (value, (lower, upper))) in point.z.iter_mut().zip(bounds).enumerate() {
            // max and min rather than clamp: no panic even if the bounds were crossed.
            *value = z(i).max(*lower).min(*upper);
        }
        point.f.fill(0.0);
        self.problem.function(point.z.as_slice(), point.f.as_mut_slice());
        point.merit = fischer::merit(self.problem, &point.z, &point.f);
        self.not_finite = point.not_finite().or(self.not_finite);
        point
    }

    /// A copy of a point.
    pub(super) fn copy(&mut self, of: &Point) -> Point {
        let mut point = self.spare();
        point.copy_from(of);
        point
    }

    /// Two vectors of length n with anything in them.
    pub(super) fn spare(&mut self) -> Point {
        let n = self.problem.dimension();
        let unused = self.pool.points.pop().filter(|point| point.z.len() == n);
        unused.unwrap_or_else(|| Point { z: DVector::zeros(n), f: DVector::zeros(n), merit: f64::INFINITY })
    }

    /// Gives a point back.
    pub(super) fn recycle(&mut self, point: Point) {
        self.pool.points.push(point);
    }

    /// Gives a matrix back.
    pub(super) fn recycle_matrix(&mut self, matrix: DMatrix<f64>) {
        self.pool.matrices.push(matrix);
    }

    /// F' at a point.
    ///
    /// # Errors
    /// [`Termination::JacobianShape`]; [`Termination::NonFinite`] naming the first entry.
    pub(super) fn jacobian(&mut self, point: &Point) -> Result<DMatrix<f64>, Termination> {
        let j = self.raw_jacobian(point);
        let (n, shape) = (point.z.len(), j.shape());
        if shape != (n, n) {
            return Err(Termination::JacobianShape { rows: shape.0, cols: shape.1 });
        }
        // Without a branch for each entry.
        if j.as_slice().iter().fold(true, |finite, v| finite & v.is_finite()) {
            return Ok(j);
        }
        let places = (0..n).flat_map(|row| (0..n).map(move |col| (row, col)));
        let (row, col) = places.into_iter().find(|&place| !j[place].is_finite()).unwrap_or_default();
        self.recycle_matrix(j);
        Err(Termination::NonFinite(NonFinite::Jacobian { row, col }))
    }

    /// F' at a point, n x n and finite or not: what a callback that has resized it left out is NaN.
    pub(super) fn any_jacobian(&mut self, point: &Point) -> DMatrix<f64> {
        let n = point.z.len();
        square(self.raw_jacobian(point), n)
    }

    /// F' at a point in whatever shape the callback has left it.
    fn raw_jacobian(&mut self, point: &Point) -> DMatrix<f64> {
        self.counters.jacobians += 1;
        let n = point.z.len();
        let unused = self.pool.matrices.pop().filter(|j| j.shape() == (n, n));
        let mut j = unused.unwrap_or_else(|| DMatrix::zeros(n, n));
        j.as_mut_slice().fill(0.0);
        self.problem.jacobian(point.z.as_slice(), &mut j);
        j
    }
}

/// F' at z, n x n even if the callback has resized it: what it left out is NaN.
pub(super) fn jacobian_at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let mut j = DMatrix::zeros(z.len(), z.len());
    problem.jacobian(z, &mut j);
    square(j, z.len())
}

fn square(j: DMatrix<f64>, n: usize) -> DMatrix<f64> {
    if j.shape() == (n, n) { j } else { j.resize(n, n, f64::NAN) }
}

impl Point {
    /// The first component of F that is not finite, as a reason to stop.
    pub(super) fn not_finite(&self) -> Option<Termination> {
        if self.merit.is_finite() {
            return None; // no component of F is infinite or NaN then
        }
        let row = self.f.iter().position(|v| !v.is_finite())?;
        Some(Termination::NonFinite(NonFinite::Function { row }))
    }

    /// Takes the content of another point of the same length.
    pub(super) fn copy_from(&mut self, other: &Point) {
        self.z.copy_from(&other.z);
        self.f.copy_from(&other.f);
        self.merit = other.merit;
    }
}
