//! F and F' with their counts, and points that carry their value and merit, in storage that is
//! kept.
//!
//! Whoever needs F at a point asks [`Evaluated`] for a [`Point`], which lies within the bounds and
//! holds z, F(z) and the merit Psi(z). Points and matrices that are given back (`recycle`) are used
//! again, so that a run like one before allocates nothing. A value that is not finite is a reason
//! to stop, not an error: the point has an infinite merit then.

use super::fischer;
use super::jacobian::square;
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
        Evaluated {
            problem,
            counters: Counters::default(),
            not_finite: None,
            pool,
        }
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
        self.problem
            .function(point.z.as_slice(), point.f.as_mut_slice());
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

        unused.unwrap_or_else(|| Point {
            z: DVector::zeros(n),
            f: DVector::zeros(n),
            merit: f64::INFINITY,
        })
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
        let n = point.z.len();
        let jacobian = self.raw_jacobian(point);
        let (rows, cols) = jacobian.shape();

        if rows != n || cols != n {
            return Err(Termination::JacobianShape { rows, cols });
        }

        if is_finite(&jacobian) {
            return Ok(jacobian);
        }

        let (row, col) = first_not_finite(&jacobian).unwrap_or_default();
        self.recycle_matrix(jacobian);
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
        let mut jacobian = unused.unwrap_or_else(|| DMatrix::zeros(n, n));

        jacobian.as_mut_slice().fill(0.0);
        self.problem.jacobian(point.z.as_slice(), &mut jacobian);
        jacobian
    }
}

/// Are all entries finite? All are looked at, which needs no branch for each.
fn is_finite(matrix: &DMatrix<f64>) -> bool {
    let mut is_finite = true;
    for value in matrix.as_slice() {
        is_finite &= value.is_finite();
    }
    is_finite
}

/// Row and column of the first entry, row by row, that is not finite.
fn first_not_finite(matrix: &DMatrix<f64>) -> Option<(usize, usize)> {
    for row in 0..matrix.nrows() {
        for col in 0..matrix.ncols() {
            if !matrix[(row, col)].is_finite() {
                return Some((row, col));
            }
        }
    }
    None
}

impl Point {
    /// The first component of F that is not finite, as a reason to stop.
    pub(super) fn not_finite(&self) -> Option<Termination> {
        if self.merit.is_finite() {
            // No component of F is infinite or NaN then.
            return None;
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

#[cfg(test)]
mod tests {
    use super::super::jacobian::jacobian_at;
    use super::super::probe::{bounded, free};
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn points_are_projected_and_evaluated_once() {
        let p = bounded(
            &[0.0, -1.0],
            &[2.0, 1.0],
            |z, f| (f[0], f[1]) = (z[0] - 5.0, 10.0 * z[1]),
            |_, j| j[(0, 1)] = 7.0,
        );
        let mut e = Evaluated::new(&p);
        let point = e.point(&dvector![9.0, -3.0]);

        assert_eq!(&point.z, &dvector![2.0, -1.0]);
        assert_eq!(&point.f, &dvector![-3.0, -10.0]);
        assert_eq!(point.merit, fischer::merit(&p, &point.z, &point.f));
        assert_eq!(e.point_with(|i| i as f64).z, dvector![0.0, 1.0]);

        let mut copy = e.copy(&point);
        assert_eq!(&copy.z, &point.z);
        assert_eq!(&copy.f, &point.f);
        assert_eq!(copy.merit, point.merit);

        let inside = e.point(&dvector![1.0, 0.0]);
        copy.copy_from(&inside);
        assert_eq!(&copy.z, &inside.z);
        assert_eq!(&copy.f, &inside.f);
        assert_eq!(copy.merit, inside.merit);
        assert_eq!(e.jacobian(&point).unwrap(), dmatrix![0.0, 7.0; 0.0, 0.0]);
        assert_eq!(e.any_jacobian(&point), dmatrix![0.0, 7.0; 0.0, 0.0]);
        assert_eq!(e.counters.functions, 3);
        assert_eq!(e.counters.jacobians, 2);
    }

    /// What was given back is used again, cleared, unless its size is another.
    #[test]
    fn storage_is_used_again() {
        let p = free(2, |z, f| f[0] += z[0], |_, j| j[(0, 0)] += 1.0);
        let mut e = Evaluated::new(&p);
        let point = e.point(&dvector![3.0, 4.0]);
        let jacobian = e.jacobian(&point).unwrap();
        let at = (point.z.as_ptr(), jacobian.as_ptr());
        e.recycle(point);
        e.recycle_matrix(jacobian);

        assert_eq!(e.pool.points.len(), 1);
        assert_eq!(e.pool.matrices.len(), 1);

        let point = e.point(&dvector![5.0, 6.0]);
        let jacobian = e.jacobian(&point).unwrap();
        assert_eq!((point.z.as_ptr(), jacobian.as_ptr()), at);
        assert_eq!(e.pool.points.len(), 0);
        assert_eq!(e.pool.matrices.len(), 0);
        assert_eq!(&point.f, &dvector![5.0, 0.0]);
        assert_eq!(&jacobian, &dmatrix![1.0, 0.0; 0.0, 0.0]);

        e.recycle(point);
        e.recycle_matrix(jacobian);
        let (pool, counters) = e.into_parts();

        assert_eq!(counters.functions, 2);
        assert_eq!(counters.jacobians, 2);

        let other = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
        let mut e = Evaluated::with_pool(&other, pool);
        let point = e.point(&dvector![5.0]);

        assert_eq!(point.z.len(), 1);
        assert_eq!(e.jacobian(&point).unwrap().shape(), (1, 1));
    }

    #[test]
    fn what_is_not_finite_is_named() {
        let p = free(
            3,
            |z, f| f[1] = 1.0 / z[0],
            |z, j| (j[(0, 2)], j[(2, 0)]) = (1.0 / z[1], f64::NAN * z[2]),
        );
        let mut e = Evaluated::new(&p);
        let good = e.point(&dvector![1.0, 0.0, 0.0]);

        assert!(good.not_finite().is_none());
        assert!(e.not_finite.is_none());
        assert_eq!(
            e.jacobian(&good),
            Err(Termination::NonFinite(NonFinite::Jacobian {
                row: 0,
                col: 2
            }))
        );

        let other = e.point(&dvector![1.0, 1.0, 1.0]);
        assert_eq!(
            e.jacobian(&other),
            Err(Termination::NonFinite(NonFinite::Jacobian {
                row: 2,
                col: 0
            }))
        );

        let bad = e.point(&dvector![0.0, 1.0, 1.0]);
        let reason = Some(Termination::NonFinite(NonFinite::Function { row: 1 }));
        assert_eq!(bad.not_finite(), reason);
        assert_eq!(e.not_finite, reason);
        assert_eq!(bad.merit, f64::INFINITY);

        e.point(&dvector![1.0, 1.0, 1.0]);
        assert_eq!(e.not_finite, reason); // until somebody takes it
    }

    /// A callback that resizes what it was given is told, or filled with what is no number.
    #[test]
    fn a_jacobian_of_another_shape_is_refused() {
        let p = free(
            2,
            |z, f| f[0] = z[0],
            |_, j| *j = DMatrix::from_element(1, 2, 5.0),
        );
        let mut e = Evaluated::new(&p);
        let point = e.point(&dvector![1.0, 1.0]);

        assert_eq!(
            e.jacobian(&point),
            Err(Termination::JacobianShape { rows: 1, cols: 2 })
        );

        for j in [e.any_jacobian(&point), jacobian_at(&p, &[1.0, 1.0])] {
            assert!(j.shape() == (2, 2));
            assert!(j[(0, 0)] == 5.0);
            assert!(j[(0, 1)] == 5.0);
            assert!(j[(1, 0)].is_nan());
            assert!(j[(1, 1)].is_nan());
        }
    }
}
