//! F' at a point, n x n whatever shape the callback has left it in.

use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// F' at z, n x n even if the callback has resized it: what it left out is NaN.
pub(super) fn jacobian_at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let mut j = DMatrix::zeros(z.len(), z.len());
    problem.jacobian(z, &mut j);
    square(j, z.len())
}

pub(super) fn square(j: DMatrix<f64>, n: usize) -> DMatrix<f64> {
    if j.shape() == (n, n) {
        j
    } else {
        j.resize(n, n, f64::NAN)
    }
}
