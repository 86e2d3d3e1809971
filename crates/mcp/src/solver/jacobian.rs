//! F' at a point, n x n whatever shape the callback has left it in.
//!
//! A callback of [`Mcp::jacobian`] is given an n x n matrix and may, by mistake, resize it. What it
//! then leaves out becomes NaN, so that residuals computed from it are NaN and not wrong.

use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// F' at z, n x n even if the callback has resized it: what it left out is NaN.
pub(super) fn jacobian_at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(z.len(), z.len());
    problem.jacobian(z, &mut jacobian);
    square(jacobian, z.len())
}

/// The matrix as one of n x n: entries beyond are dropped, missing ones are NaN.
pub(super) fn square(matrix: DMatrix<f64>, n: usize) -> DMatrix<f64> {
    if matrix.shape() == (n, n) {
        return matrix;
    }

    matrix.resize(n, n, f64::NAN)
}
