//! Dense square matrices in doubles, by rows.
//!
//! The order of every sum is fixed: results are compared digit by digit between runs.

use mceip_exact::submatrix;

/// A dense square matrix by rows.
pub(crate) type SquareMatrix = Vec<Vec<f64>>;

pub(crate) fn zeros(order: usize) -> SquareMatrix {
    vec![vec![0.0; order]; order]
}

/// Largest modulus of an entry, zero for an empty matrix.
pub(crate) fn largest_entry(matrix: &[Vec<f64>]) -> f64 {
    matrix
        .iter()
        .flatten()
        .fold(0.0f64, |largest, v| largest.max(v.abs()))
}

/// The block on these rows and columns.
pub(crate) fn principal_block(matrix: &[Vec<f64>], indices: &[usize]) -> SquareMatrix {
    submatrix(matrix, indices, indices)
}

/// The product `matrix * x`.
pub(crate) fn times(matrix: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    matrix
        .iter()
        .map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
        .collect()
}

/// The multiple `factor * matrix`.
pub(crate) fn scaled(matrix: &[Vec<f64>], factor: f64) -> SquareMatrix {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| factor * v).collect())
        .collect()
}

/// The entries without their signs.
pub(crate) fn absolute(matrix: &[Vec<f64>]) -> SquareMatrix {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| v.abs()).collect())
        .collect()
}

/// u' matrix v
pub(crate) fn bilinear(u: &[f64], matrix: &[Vec<f64>], v: &[f64]) -> f64 {
    let product = times(matrix, v);
    u.iter().zip(product).map(|(u_i, p_i)| u_i * p_i).sum()
}

/// a + factor b.
pub(crate) fn combined(a: &[Vec<f64>], factor: f64, b: &[Vec<f64>]) -> SquareMatrix {
    let mut sum = a.to_vec();
    for (row, b_row) in sum.iter_mut().zip(b) {
        for (entry, b) in row.iter_mut().zip(b_row) {
            *entry += factor * b;
        }
    }

    sum
}
