//! F and F' with their counts, and points that carry their value and merit, in storage that is
//! kept.
//!
//! Whoever needs F at a point asks [`Evaluated`] for a [`Point`], which lies within the bounds and
//! holds z, F(z) and the merit Psi(z). Points and matrices that are given back (`recycle`) are used
//! again, so that a run like one before allocates nothing. A value that is not finite is a reason
//! to stop, not an error: the point has an infinite merit then.

use super::fischer;
use super::jacobian::{JacobianMatrix, SparseColumns, square};
use super::outcome::{Counters, NonFinite, Termination};
use super::tolerance::DENSE_ORDER;
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
    entries: Vec<(usize, usize, f64)>,
}

/// A problem whose evaluations are counted.
pub(super) struct Evaluated<'a, P: Mcp + ?Sized> {
    pub(super) problem: &'a P,
    pub(super) counters: Counters,
    /// The last value of F that was not finite, until somebody takes it.
    pub(super) not_finite: Option<Termination>,
    /// Has the problem given its last Jacobian by its entries?
    is_sparse: bool,
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
            is_sparse: false,
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
    pub(super) fn recycle_matrix(&mut self, matrix: JacobianMatrix) {
        if let JacobianMatrix::Dense(matrix) = matrix {
            self.pool.matrices.push(matrix);
        }
    }

    /// Is F' sparse and of so large an order that no dense matrix of it is made, which paths and
    /// curves need? Known once F' was asked for.
    pub(super) fn is_too_large_for_paths(&self) -> bool {
        self.is_sparse && self.problem.dimension() > DENSE_ORDER
    }

    /// F' at a point.
    ///
    /// # Errors
    /// [`Termination::JacobianShape`]; [`Termination::NonFinite`] naming the first entry.
    pub(super) fn jacobian(&mut self, point: &Point) -> Result<JacobianMatrix, Termination> {
        let n = point.z.len();
        let jacobian = self.raw_jacobian(point)?;

        if let JacobianMatrix::Dense(matrix) = &jacobian
            && matrix.shape() != (n, n)
        {
            let (rows, cols) = matrix.shape();
            return Err(Termination::JacobianShape { rows, cols });
        }

        let Some((row, col)) = jacobian.first_not_finite() else {
            return Ok(jacobian);
        };
        self.recycle_matrix(jacobian);
        Err(Termination::NonFinite(NonFinite::Jacobian { row, col }))
    }

    /// F' at a point, n x n and finite or not: what a callback has left out is NaN, all of it where
    /// an entry lies beyond the matrix.
    pub(super) fn any_jacobian(&mut self, point: &Point) -> JacobianMatrix {
        let n = point.z.len();
        match self.raw_jacobian(point) {
            Ok(JacobianMatrix::Dense(matrix)) => square(matrix, n).into(),
            Ok(sparse) => sparse,
            Err(_) => DMatrix::from_element(n, n, f64::NAN).into(),
        }
    }

    /// F' at a point, a dense one in whatever shape the callback has left it.
    ///
    /// # Errors
    /// [`Termination::JacobianShape`] for entries beyond the matrix.
    fn raw_jacobian(&mut self, point: &Point) -> Result<JacobianMatrix, Termination> {
        self.counters.jacobians += 1;
        let n = point.z.len();
        let z = point.z.as_slice();

        let entries = &mut self.pool.entries;
        entries.clear();
        self.is_sparse = self.problem.entries(z, entries);
        if self.is_sparse {
            let matrix = SparseColumns::new(n, entries);
            return matrix
                .map(JacobianMatrix::Sparse)
                .map_err(|(rows, cols)| Termination::JacobianShape { rows, cols });
        }

        let unused = self.pool.matrices.pop().filter(|j| j.shape() == (n, n));
        let mut jacobian = unused.unwrap_or_else(|| DMatrix::zeros(n, n));

        jacobian.as_mut_slice().fill(0.0);
        self.problem.jacobian(z, &mut jacobian);
        Ok(JacobianMatrix::Dense(jacobian))
    }
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
    use crate::mcp::FunctionMcp;
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
        let expected = JacobianMatrix::from(dmatrix![0.0, 7.0; 0.0, 0.0]);
        assert_eq!(e.jacobian(&point).unwrap(), expected);
        assert_eq!(e.any_jacobian(&point), expected);
        assert_eq!(e.counters.functions, 3);
        assert_eq!(e.counters.jacobians, 2);
    }

    /// What was given back is used again, cleared, unless its size is another.
    #[test]
    fn storage_is_used_again() {
        let p = free(2, |z, f| f[0] += z[0], |_, j| j[(0, 0)] += 1.0);
        let mut e = Evaluated::new(&p);
        let point = e.point(&dvector![3.0, 4.0]);
        let jacobian = e.jacobian(&point).unwrap().into_dense();
        let at = (point.z.as_ptr(), jacobian.as_ptr());
        e.recycle(point);
        e.recycle_matrix(jacobian.into());

        assert_eq!(e.pool.points.len(), 1);
        assert_eq!(e.pool.matrices.len(), 1);

        let point = e.point(&dvector![5.0, 6.0]);
        let jacobian = e.jacobian(&point).unwrap().into_dense();
        assert_eq!((point.z.as_ptr(), jacobian.as_ptr()), at);
        assert_eq!(e.pool.points.len(), 0);
        assert_eq!(e.pool.matrices.len(), 0);
        assert_eq!(&point.f, &dvector![5.0, 0.0]);
        assert_eq!(&jacobian, &dmatrix![1.0, 0.0; 0.0, 0.0]);

        e.recycle(point);
        e.recycle_matrix(jacobian.into());
        let (pool, counters) = e.into_parts();

        assert_eq!(counters.functions, 2);
        assert_eq!(counters.jacobians, 2);

        let other = free(1, |z, f| f[0] = z[0], |_, j| j[(0, 0)] = 1.0);
        let mut e = Evaluated::with_pool(&other, pool);
        let point = e.point(&dvector![5.0]);

        assert_eq!(point.z.len(), 1);
        assert_eq!(e.jacobian(&point).unwrap().into_dense().shape(), (1, 1));
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

        let any = e.any_jacobian(&point).into_dense();
        for j in [any, jacobian_at(&p, &[1.0, 1.0])] {
            assert!(j.shape() == (2, 2));
            assert!(j[(0, 0)] == 5.0);
            assert!(j[(0, 1)] == 5.0);
            assert!(j[(1, 0)].is_nan());
            assert!(j[(1, 1)].is_nan());
        }
    }

    /// Entries are a sparse matrix, without a dense one; one beyond the order is told.
    #[test]
    fn entries_are_a_sparse_jacobian() {
        let line = || FunctionMcp::new(vec![0.0; 2], vec![9.0; 2], |z, f| f.copy_from_slice(z));
        let p = line().with_entries(|_, entries| entries.push((1, 0, 5.0)));
        let mut e = Evaluated::new(&p);
        let point = e.point(&dvector![1.0, 1.0]);
        let jacobian = e.jacobian(&point).unwrap();

        assert!(matches!(jacobian, JacobianMatrix::Sparse(_)));
        assert_eq!(jacobian.into_dense(), dmatrix![0.0, 0.0; 5.0, 0.0]);

        let beyond = line().with_entries(|_, entries| entries.push((1, 4, 5.0)));
        let mut e = Evaluated::new(&beyond);
        let point = e.point(&dvector![1.0, 1.0]);
        assert_eq!(
            e.jacobian(&point),
            Err(Termination::JacobianShape { rows: 2, cols: 5 })
        );
        assert!(e.any_jacobian(&point).first_not_finite().is_some());
    }
}
