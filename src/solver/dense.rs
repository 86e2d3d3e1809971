//! Dense factorisations, with the cases nalgebra leaves open: empty systems, results not finite.

use super::tolerance::REGULAR;
use nalgebra::{DMatrix, DVector};

/// Solves A x = b by LU with partial pivoting; `None` if A is singular or x is not finite.
pub(super) fn solve(a: DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    if b.is_empty() {
        return Some(DVector::zeros(0)); // nalgebra's triangular solve underflows on 0 x 0
    }
    a.lu().solve(b).filter(|x| x.iter().all(|v| v.is_finite()))
}

/// The inverse by LU, checked: |B B^-1 - I| small, every entry finite.
pub(super) fn invert(b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if b.is_empty() {
        return Some(b.clone());
    }
    let inverse = b.clone().lu().try_inverse()?;
    let error = (b * &inverse - DMatrix::identity(b.nrows(), b.ncols())).iter().fold(0.0, |worst: f64, e| {
        // A NaN must not be lost, as it would be by f64::max.
        if e.is_nan() { f64::INFINITY } else { worst.max(e.abs()) }
    });
    (error < REGULAR).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn singular_empty_and_not_finite() {
        assert!(invert(&dmatrix![1.0, 1.0; 1.0, 1.0]).is_none());
        assert!(invert(&dmatrix![f64::NAN]).is_none());
        assert!(solve(dmatrix![0.0], &dvector![1.0]).is_none());
        assert_eq!(solve(DMatrix::zeros(0, 0), &DVector::zeros(0)).unwrap().len(), 0);
        assert_eq!(solve(dmatrix![4.0], &dvector![1.0]).unwrap()[0], 0.25);
    }
}
