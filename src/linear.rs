//! The one file that names faer: dense factorisations in doubles. Sparse ones are built on its kernels.
//!
//! | file | what |
//! |---|---|
//! | `symmetric` | sparse symmetric matrices |
//! | `dissection` | nested dissection: the order of elimination |
//! | `analysis` | which fronts there are, and who passes what to whom |
//! | `multifrontal` | Cholesky factors and Schur complements, front by front |

mod analysis;
mod dissection;
mod multifrontal;
mod symmetric;

pub use analysis::Analysis;
pub use multifrontal::{NotDefinite, SchurFactor};
pub use symmetric::{Symmetric, SymmetricError};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, Mat, MatMut, Par};

/// The inverse of a dense matrix given by rows (n x n), by LU with partial pivoting.
///
/// `None` if an entry of the result is not finite (a singular matrix, overflow).
pub fn inverse(rows: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    let m = Mat::from_fn(n, n, |i, j| rows[i][j]);
    let inverse = m.partial_piv_lu().inverse();
    let rows: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| inverse[(i, j)]).collect()).collect();
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
    let columns: Vec<Vec<f64>> = (0..columns.len()).map(|j| (0..n).map(|i| x[(i, j)]).collect()).collect();
    columns.iter().flatten().all(|v| v.is_finite()).then_some(columns)
}

/// Real and imaginary parts of the eigenvalues of a dense square matrix given by rows.
///
/// `None` if the iteration does not converge.
pub fn eigenvalues(rows: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let n = rows.len();
    let m = Mat::from_fn(n, n, |i, j| rows[i][j]);
    Some(m.eigenvalues().ok()?.into_iter().map(|v| (v.re, v.im)).collect())
}

/// Eliminates the first `own` of `order` unknowns of a symmetric front, lower triangles by columns:
/// `panel` holds the columns eliminated (order x own) and becomes their part of the Cholesky factor,
/// `update` the other rows and columns, from which the elimination is taken off.
///
/// `false` where a pivot is not positive.
fn eliminate_front(panel: &mut [f64], update: &mut [f64], order: usize, own: usize) -> bool {
    let rest = order - own;
    let panel = MatMut::from_column_major_slice_mut(panel, order, own);
    let (mut top, mut bottom) = panel.split_at_row_mut(own);
    let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(own, Par::Seq, Default::default()));
    let stack = MemStack::new(&mut memory);
    if cholesky_in_place(top.rb_mut(), Default::default(), Par::Seq, stack, Default::default()).is_err() {
        return false;
    }
    if rest > 0 {
        solve_lower_triangular_in_place(top.rb(), bottom.rb_mut().transpose_mut(), Par::Seq);
        let update = MatMut::from_column_major_slice_mut(update, rest, rest);
        let (lower, full) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
        matmul(update, lower, Accum::Add, bottom.rb(), full, bottom.rb().transpose(), full, -1.0, Par::Seq);
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
    fn eigenvalues_of_a_rotation_and_a_triangle() {
        let turned = eigenvalues(&[vec![0.0, -2.0], vec![2.0, 0.0]]).unwrap();
        assert!(turned.iter().all(|(re, im)| re.abs() < 1e-15 && (im.abs() - 2.0).abs() < 1e-15));
        let mut real: Vec<f64> = eigenvalues(&[vec![3.0, 9.0], vec![0.0, -1.0]]).unwrap().into_iter().map(|v| v.0).collect();
        real.sort_by(f64::total_cmp);
        assert_eq!(real, [-1.0, 3.0]);
    }

    /// [4 2; 2 5]: L = [2 0; 1 2], and 5 - 1 = 4 is what the first unknown leaves of the second.
    #[test]
    fn a_front_of_two_by_hand() {
        let (mut panel, mut update) = (vec![4.0, 2.0], vec![5.0]);
        assert!(eliminate_front(&mut panel, &mut update, 2, 1));
        assert_eq!((panel, update), (vec![2.0, 1.0], vec![4.0]));
        assert!(!eliminate_front(&mut [1.0, 2.0, 0.0, 4.0], &mut [], 2, 2), "[1 2; 2 4] is singular");
    }
}
