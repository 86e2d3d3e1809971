//! The one file that names faer: dense factorisations in doubles, and sparse LU. Sparse Cholesky
//! factors are built on its kernels.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Accum, Mat, MatMut, Par, Side};

/// The inverse of a dense matrix given by rows (n x n), by LU with partial pivoting.
///
/// `None` if an entry of the result is not finite (a singular matrix, overflow).
pub fn inverse(rows: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    let m = Mat::from_fn(n, n, |i, j| rows[i][j]);
    let inverse = m.partial_piv_lu().inverse();
    let rows: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| inverse[(i, j)]).collect())
        .collect();
    rows.iter().flatten().all(|v| v.is_finite()).then_some(rows)
}

/// Solves a dense square system for several right-hand sides given as columns.
///
/// `None` if an entry of the result is not finite.
pub fn solve(rows: &[Vec<f64>], columns: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    let m = Mat::from_fn(n, n, |i, j| rows[i][j]);
    let right = Mat::from_fn(n, columns.len(), |i, j| columns[j][i]);
    let x = m.partial_piv_lu().solve(&right);
    let columns: Vec<Vec<f64>> = (0..columns.len())
        .map(|j| (0..n).map(|i| x[(i, j)]).collect())
        .collect();
    columns
        .iter()
        .flatten()
        .all(|v| v.is_finite())
        .then_some(columns)
}

/// Factors of a sparse square matrix, by LU with row pivoting and an order that keeps them sparse.
#[derive(Debug, Clone)]
pub struct SparseLu {
    order: usize,
    /// None of a matrix without rows.
    factors: Option<Lu<usize, f64>>,
}

impl SparseLu {
    /// From entries (row, column, value), row and column below the order; entries of one place add
    /// up.
    ///
    /// `None` where elimination finds no pivot. A matrix that is singular but for rounding may
    /// pass: the residual of a solution tells.
    pub fn new(
        order: usize,
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
    ) -> Option<SparseLu> {
        if order == 0 {
            return Some(SparseLu {
                order,
                factors: None,
            });
        }
        let entries: Vec<Triplet<usize, usize, f64>> = entries
            .into_iter()
            .map(|(i, j, v)| Triplet::new(i, j, v))
            .collect();
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(order, order, &entries).ok()?;
        Some(SparseLu {
            order,
            factors: Some(matrix.sp_lu().ok()?),
        })
    }

    /// Replaces right-hand sides, columns of length `order`, by solutions.
    pub fn solve(&self, columns: &mut [Vec<f64>]) {
        let Some(factors) = &self.factors else { return };
        let mut right = Mat::from_fn(self.order, columns.len(), |i, j| columns[j][i]);
        factors.solve_in_place(&mut right);
        for (j, column) in columns.iter_mut().enumerate() {
            column
                .iter_mut()
                .enumerate()
                .for_each(|(i, v)| *v = right[(i, j)]);
        }
    }
}

/// The eigenvalues (real, imaginary) of a square matrix given by rows, in no particular order.
///
/// `None` if an entry is not finite or the iteration does not converge.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let n = rows.len();
    if !rows.iter().flatten().all(|v| v.is_finite()) {
        return None;
    }
    let values = Mat::from_fn(n, n, |i, j| rows[i][j]).eigenvalues().ok()?;
    Some(values.iter().map(|z| (z.re, z.im)).collect())
}

/// The eigenvalues t of B v = t A v for symmetric B and symmetric positive definite A, ascending.
///
/// `None` if A is not definite in doubles, an entry is not finite or the iteration does not
/// converge.
pub fn definite_eigenvalues(b: &[Vec<f64>], a: &[Vec<f64>]) -> Option<Vec<f64>> {
    let n = a.len();
    if !a.iter().chain(b).flatten().all(|v| v.is_finite()) {
        return None;
    }
    let mut c = Mat::from_fn(n, n, |i, j| b[i][j]);
    let factor = Mat::from_fn(n, n, |i, j| a[i][j]).llt(Side::Lower).ok()?;
    // L^-1 B L^-T: the same rows solved twice, transposed in between.
    for _ in 0..2 {
        solve_lower_triangular_in_place(factor.L(), c.as_mut(), Par::Seq);
        c = c.transpose().to_owned();
    }
    c.self_adjoint_eigenvalues(Side::Lower).ok()
}

/// Eliminates the first `own` of `order` unknowns of a symmetric front, lower triangles by columns:
/// `panel` holds the columns eliminated (order x own) and becomes their part of the Cholesky
/// factor, `update` the other rows and columns, from which the elimination is taken off.
///
/// `false` where a pivot is not positive.
pub(super) fn eliminate_front(
    panel: &mut [f64],
    update: &mut [f64],
    order: usize,
    own: usize,
) -> bool {
    let rest = order - own;
    let panel = MatMut::from_column_major_slice_mut(panel, order, own);
    let (mut top, mut bottom) = panel.split_at_row_mut(own);
    let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(
        own,
        Par::Seq,
        Default::default(),
    ));
    let stack = MemStack::new(&mut memory);
    if cholesky_in_place(
        top.rb_mut(),
        Default::default(),
        Par::Seq,
        stack,
        Default::default(),
    )
    .is_err()
    {
        return false;
    }
    if rest > 0 {
        solve_lower_triangular_in_place(top.rb(), bottom.rb_mut().transpose_mut(), Par::Seq);
        let update = MatMut::from_column_major_slice_mut(update, rest, rest);
        let (lower, full) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
        matmul(
            update,
            lower,
            Accum::Add,
            bottom.rb(),
            full,
            bottom.rb().transpose(),
            full,
            -1.0,
            Par::Seq,
        );
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverts_and_refuses_singular() {
        let m = vec![vec![0.0, 2.0], vec![4.0, 1.0]];
        let y = inverse(&m).unwrap();
        approx::assert_relative_eq!(y[0][0], -0.125, epsilon = 1e-15);
        approx::assert_relative_eq!(y[1][0], 0.5, epsilon = 1e-15);
        assert_eq!(solve(&m, &[vec![2.0, 5.0]]).unwrap(), vec![vec![1.0, 1.0]]);
        assert!(inverse(&[vec![1.0, 1.0], vec![1.0, 1.0]]).is_none());
    }

    #[test]
    fn eigenvalues_of_a_rotation_and_of_a_definite_pair() {
        let mut turn = eigenvalues(&[vec![0.0, -2.0], vec![2.0, 0.0]]).unwrap();
        turn.sort_by(|p, q| p.1.total_cmp(&q.1));
        approx::assert_relative_eq!(turn[0].1, -2.0, epsilon = 1e-12);
        approx::assert_relative_eq!(turn[1].1, 2.0, epsilon = 1e-12);
        assert!(eigenvalues(&[vec![f64::NAN]]).is_none());
        // B = diag(3, -1), A = [[2, 1], [1, 2]]: 3 t^2 - 4 t - 3 = 0.
        let (b, a) = (
            vec![vec![3.0, 0.0], vec![0.0, -1.0]],
            vec![vec![2.0, 1.0], vec![1.0, 2.0]],
        );
        let t = definite_eigenvalues(&b, &a).unwrap();
        approx::assert_relative_eq!(t[0], (2.0 - 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(t[1], (2.0 + 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        assert!(definite_eigenvalues(&a, &b).is_none());
    }

    /// [4 2; 2 5]: L = [2 0; 1 2], and 5 - 1 = 4 is what the first unknown leaves of the second.
    #[test]
    fn a_front_of_two_by_hand() {
        let (mut panel, mut update) = (vec![4.0, 2.0], vec![5.0]);
        assert!(eliminate_front(&mut panel, &mut update, 2, 1));
        assert_eq!((panel, update), (vec![2.0, 1.0], vec![4.0]));
        assert!(
            !eliminate_front(&mut [1.0, 2.0, 0.0, 4.0], &mut [], 2, 2),
            "[1 2; 2 4] is singular"
        );
    }
}
