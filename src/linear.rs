//! The one file that names faer: dense factorisations in doubles.

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par, Side};

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
/// `None` if A is not definite in doubles, an entry is not finite or the iteration does not converge.
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
        let (b, a) = (vec![vec![3.0, 0.0], vec![0.0, -1.0]], vec![vec![2.0, 1.0], vec![1.0, 2.0]]);
        let t = definite_eigenvalues(&b, &a).unwrap();
        approx::assert_relative_eq!(t[0], (2.0 - 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        approx::assert_relative_eq!(t[1], (2.0 + 13f64.sqrt()) / 3.0, epsilon = 1e-12);
        assert!(definite_eigenvalues(&a, &b).is_none());
    }
}
