//! Dense factorisations in doubles, and sparse LU. The only file that names faer.
//!
//! Public: [`inverse`], [`solve`], [`eigenvalues`], [`sensitive_eigenvalues`],
//! [`definite_eigenvalues`] of dense matrices, and [`SparseLu`]. `eliminate_front` is the kernel of
//! the sparse Cholesky factors of `multifrontal`.
//!
//! A dense matrix is given by rows, all of the same length; the caller answers for the shape.
//! Results are not certified: a matrix that is singular but for rounding may pass.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};

/// The square matrix with these rows.
fn square(rows: &[Vec<f64>]) -> Mat<f64> {
    let n = rows.len();
    Mat::from_fn(n, n, |row, col| rows[row][col])
}

/// The matrix with `n` rows and these columns.
fn from_columns(n: usize, columns: &[Vec<f64>]) -> Mat<f64> {
    Mat::from_fn(n, columns.len(), |row, col| columns[col][row])
}

/// Are all entries of all lists finite?
fn are_finite(lists: &[Vec<f64>]) -> bool {
    lists.iter().flatten().all(|value| value.is_finite())
}

/// The inverse of a dense matrix given by rows (n x n), by LU with partial pivoting.
///
/// `None` if an entry of the result is not finite (a singular matrix, overflow).
pub fn inverse(rows: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    let inverse = square(rows).partial_piv_lu().inverse();

    let mut result = vec![vec![0.0; n]; n];
    for row in 0..n {
        for col in 0..n {
            result[row][col] = inverse[(row, col)];
        }
    }

    are_finite(&result).then_some(result)
}

/// Solves a dense square system (n x n) for several right-hand sides given as columns of length n.
///
/// `None` if an entry of the result is not finite.
pub fn solve(rows: &[Vec<f64>], columns: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    let right = from_columns(n, columns);
    let solutions = square(rows).partial_piv_lu().solve(&right);

    let mut result = vec![vec![0.0; n]; columns.len()];
    for col in 0..columns.len() {
        for row in 0..n {
            result[col][row] = solutions[(row, col)];
        }
    }

    are_finite(&result).then_some(result)
}

/// Factors of a sparse square matrix, by LU with row pivoting and an order that keeps them sparse.
#[derive(Debug, Clone)]
pub struct SparseLu {
    order: usize,
    /// `None` for a matrix without rows.
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

        let triplets: Vec<Triplet<usize, usize, f64>> = entries
            .into_iter()
            .map(|(row, col, value)| Triplet::new(row, col, value))
            .collect();
        let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(order, order, &triplets);
        let factors = matrix.ok()?.sp_lu().ok()?;

        Some(SparseLu {
            order,
            factors: Some(factors),
        })
    }

    /// Replaces right-hand sides, columns of length `order`, by solutions.
    pub fn solve(&self, columns: &mut [Vec<f64>]) {
        self.solve_by(columns, |factors, right| factors.solve_in_place(right));
    }

    /// The same with the transpose of the matrix.
    pub fn solve_transposed(&self, columns: &mut [Vec<f64>]) {
        self.solve_by(columns, |factors, right| {
            factors.solve_transpose_in_place(right);
        });
    }

    fn solve_by(&self, columns: &mut [Vec<f64>], solve: fn(&Lu<usize, f64>, &mut Mat<f64>)) {
        let Some(factors) = &self.factors else { return };

        let mut right = from_columns(self.order, columns);
        solve(factors, &mut right);

        for (col, column) in columns.iter_mut().enumerate() {
            for (row, value) in column.iter_mut().enumerate() {
                *value = right[(row, col)];
            }
        }
    }
}

/// The eigenvalues (real, imaginary) of a square matrix given by rows, in no particular order.
///
/// `None` if an entry is not finite or the iteration does not converge.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    if !are_finite(rows) {
        return None;
    }

    let values = square(rows).eigenvalues().ok()?;
    Some(values.iter().map(|z| (z.re, z.im)).collect())
}

/// An eigenvalue re + i im of a square matrix, and how far changes of the matrix move it, to first
/// order. Infinite where doubles find no left eigenvector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eigenvalue {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// |u|' E |v| / |u'v| for the left and right eigenvectors u, v: what a change of each entry by
    /// that of E at most does. No change of units of the unknowns changes it.
    pub sensitivity: f64,
    /// |u'(A v - t v)| / |u'v|: what the iteration has left.
    pub residual: f64,
}

/// The eigenvalues of a square matrix A given by rows with their sensitivity to changes E >= 0 of
/// its entries, in no particular order.
///
/// The matrix is balanced first: units of the unknowns are changed by powers of two until rows and
/// columns have like sums. The left eigenvectors are the rows of V^-1, V the matrix of right ones.
/// `None` if an entry is not finite or the iteration does not converge.
pub fn sensitive_eigenvalues(rows: &[Vec<f64>], changes: &[Vec<f64>]) -> Option<Vec<Eigenvalue>> {
    if !are_finite(rows) {
        return None;
    }

    let order = rows.len();
    let units = balancing_units(rows);
    let in_units = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| rows[i][j] * units[j] / units[i];
        (0..order)
            .map(|i| (0..order).map(|j| entry(i, j)).collect())
            .collect()
    };
    let rows = in_units(rows);
    let changes = in_units(changes);

    let eigen = square(&rows).eigen().ok()?;
    let right = eigen.U();
    let left = right.partial_piv_lu().inverse();

    let values = eigen.S().column_vector();
    let mut eigenvalues = Vec::with_capacity(order);
    for k in 0..order {
        let mut sensitivity = 0.0;
        let mut residual = values[k] * 0.0;
        for i in 0..order {
            let mut row = right[(i, k)] * -values[k];
            let mut change = 0.0;
            for j in 0..order {
                row += right[(j, k)] * rows[i][j];
                change += changes[i][j] * right[(j, k)].norm();
            }
            residual += left[(k, i)] * row;
            sensitivity += left[(k, i)].norm() * change;
        }

        let finite = |v: f64| if v.is_finite() { v } else { f64::INFINITY };
        eigenvalues.push(Eigenvalue {
            re: values[k].re,
            im: values[k].im,
            sensitivity: finite(sensitivity),
            residual: finite(residual.norm()),
        });
    }

    Some(eigenvalues)
}

/// Sweeps of balancing, at most; a few settle it.
const BALANCING_SWEEPS: usize = 20;

/// Powers of two d such that in D^-1 A D the sums of a row and of its column, the diagonal left
/// out, differ by a factor of about four at most (Osborne 1960). A row or column of zeros keeps its
/// unit.
fn balancing_units(rows: &[Vec<f64>]) -> Vec<f64> {
    let order = rows.len();
    let mut units = vec![1.0; order];
    for _ in 0..BALANCING_SWEEPS {
        let mut has_changed = false;
        for i in 0..order {
            let others = (0..order).filter(|&j| j != i);
            let mut row = 0.0;
            let mut column = 0.0;
            for j in others {
                row += (rows[i][j] * units[j] / units[i]).abs();
                column += (rows[j][i] * units[i] / units[j]).abs();
            }

            let exponent = (0.5 * (row / column).log2()).round();
            if exponent.is_finite() && exponent != 0.0 {
                units[i] *= exponent.exp2();
                has_changed = true;
            }
        }
        if !has_changed {
            break;
        }
    }

    units
}

/// The eigenvalues t of B v = t A v for symmetric B and symmetric positive definite A, ascending.
///
/// With the Cholesky factor L of A they are those of the symmetric matrix L^-1 B L^-T. `None` if A
/// is not definite in doubles, an entry is not finite or the iteration does not converge.
pub fn definite_eigenvalues(b: &[Vec<f64>], a: &[Vec<f64>]) -> Option<Vec<f64>> {
    if !are_finite(a) || !are_finite(b) {
        return None;
    }

    let factor = square(a).llt(Side::Lower).ok()?;
    let n = a.len();
    let mut c = Mat::from_fn(n, n, |row, col| b[row][col]);

    // L^-1 B L^-T: L^-1 is applied from the left twice, and the product is transposed each time.
    for _ in 0..2 {
        solve_lower_triangular_in_place(factor.L(), c.as_mut(), Par::Seq);
        c = c.transpose().to_owned();
    }

    c.self_adjoint_eigenvalues(Side::Lower).ok()
}

/// Eliminates the first `own` of `order` unknowns of a symmetric front, lower triangles by columns.
///
/// `panel` holds the columns eliminated (order x own) and becomes their part of the Cholesky
/// factor: with the front [F B'; B C] and F = L L' it becomes [L; B L^-T]. `update` holds the other
/// rows and columns, C, and becomes C - (B L^-T)(B L^-T)'.
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

    if !factor_in_place(top.rb_mut()) {
        return false;
    }

    if rest > 0 {
        solve_lower_triangular_in_place(top.rb(), bottom.rb_mut().transpose_mut(), Par::Seq);
        let update = MatMut::from_column_major_slice_mut(update, rest, rest);
        subtract_square(update, bottom.rb());
    }
    true
}

/// Replaces the lower triangle of a symmetric matrix by its Cholesky factor; `false` where a pivot
/// is not positive.
fn factor_in_place(matrix: MatMut<'_, f64>) -> bool {
    let need = cholesky_in_place_scratch::<f64>(matrix.nrows(), Par::Seq, Default::default());
    let mut memory = MemBuffer::new(need);
    let stack = MemStack::new(&mut memory);
    let regularization = Default::default();
    let parameters = Default::default();

    cholesky_in_place(matrix, regularization, Par::Seq, stack, parameters).is_ok()
}

/// Subtracts W W' from the lower triangle of `target`.
fn subtract_square(target: MatMut<'_, f64>, w: MatRef<'_, f64>) {
    matmul(
        target,
        BlockStructure::TriangularLower,
        Accum::Add,
        w,
        BlockStructure::Rectangular,
        w.transpose(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
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
        let rotation = [vec![0.0, -2.0], vec![2.0, 0.0]];
        let mut values = eigenvalues(&rotation).unwrap();
        values.sort_by(|p, q| p.1.total_cmp(&q.1));

        approx::assert_relative_eq!(values[0].1, -2.0, epsilon = 1e-12);
        approx::assert_relative_eq!(values[1].1, 2.0, epsilon = 1e-12);
        assert!(eigenvalues(&[vec![f64::NAN]]).is_none());

        // (1, 0) and (1, d) are the right eigenvectors of [1 1; 0 1 + d], at an angle of d.
        let nearly_double = [vec![1.0, 1.0], vec![0.0, 1.0 + 1e-6]];
        let ones = [vec![1.0, 1.0], vec![1.0, 1.0]];
        let values = sensitive_eigenvalues(&nearly_double, &ones).unwrap();
        approx::assert_relative_eq!(values[0].sensitivity, 1e6, max_relative = 1e-5);
        let values = sensitive_eigenvalues(&rotation, &ones).unwrap();
        approx::assert_relative_eq!(values[0].im.abs(), 2.0, epsilon = 1e-12);
        approx::assert_relative_eq!(values[1].sensitivity, 2.0, epsilon = 1e-12);
        assert!(values[1].residual < 1e-14);

        // The same in other units: nothing changes but the entries.
        let units = 2f64.powi(40);
        let turned = [vec![0.0, -2.0 * units], vec![2.0 / units, 0.0]];
        let changes = [vec![1.0, units], vec![1.0 / units, 1.0]];
        let values = sensitive_eigenvalues(&turned, &changes).unwrap();
        approx::assert_relative_eq!(values[1].sensitivity, 2.0, epsilon = 1e-12);

        // det(B - t A) = 3 t^2 - 4 t - 3 for these two.
        let b = vec![vec![3.0, 0.0], vec![0.0, -1.0]];
        let a = vec![vec![2.0, 1.0], vec![1.0, 2.0]];
        let t = definite_eigenvalues(&b, &a).unwrap();

        approx::assert_relative_eq!(t[0], (2.0 - 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(t[1], (2.0 + 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        assert!(definite_eigenvalues(&a, &b).is_none());
    }

    /// [4 2; 2 5]: L = [2 0; 1 2], and 5 - 1 = 4 is what the first unknown leaves of the second.
    #[test]
    fn a_front_of_two_by_hand() {
        let mut panel = vec![4.0, 2.0];
        let mut update = vec![5.0];
        assert!(eliminate_front(&mut panel, &mut update, 2, 1));
        assert_eq!(panel, [2.0, 1.0]);
        assert_eq!(update, [4.0]);

        assert!(
            !eliminate_front(&mut [1.0, 2.0, 0.0, 4.0], &mut [], 2, 2),
            "[1 2; 2 4] is singular"
        );
    }
}
