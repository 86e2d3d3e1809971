//! The one file that names faer: dense factorisations in doubles.

use faer::Mat;
use faer::linalg::solvers::{DenseSolveCore, Solve};

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
}
