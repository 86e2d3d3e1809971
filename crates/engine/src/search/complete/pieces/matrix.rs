//! Dense square matrices in doubles, by rows.
//!
//! The order of every sum is fixed: results are compared digit by digit between runs.

/// A dense square matrix by rows.
pub(crate) type Matrix = Vec<Vec<f64>>;

pub(crate) fn zeros(order: usize) -> Matrix {
    vec![vec![0.0; order]; order]
}

/// Largest modulus of an entry, zero for an empty matrix.
pub(crate) fn largest_entry(matrix: &Matrix) -> f64 {
    matrix
        .iter()
        .flatten()
        .fold(0.0f64, |largest, v| largest.max(v.abs()))
}

/// The block on these rows and columns.
pub(crate) fn principal_block(matrix: &Matrix, indices: &[usize]) -> Matrix {
    let mut block = Vec::with_capacity(indices.len());
    for &i in indices {
        block.push(indices.iter().map(|&j| matrix[i][j]).collect());
    }

    block
}

/// The product `matrix * x`.
pub(crate) fn times(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    matrix
        .iter()
        .map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
        .collect()
}

/// The multiple `factor * matrix`.
pub(crate) fn scaled(matrix: &Matrix, factor: f64) -> Matrix {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| factor * v).collect())
        .collect()
}

/// u' matrix v
pub(crate) fn bilinear(u: &[f64], matrix: &Matrix, v: &[f64]) -> f64 {
    let product = times(matrix, v);
    u.iter().zip(product).map(|(u_i, p_i)| u_i * p_i).sum()
}
