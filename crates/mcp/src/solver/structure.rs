//! Is a Jacobian singular by its zeros alone?
//!
//! A matrix whose rows and columns cannot be permuted to a diagonal without zeros has determinant
//! zero whatever its other entries are. Called by `newton` at the end of a run that found nothing,
//! with the unknowns strictly between their bounds.

use super::matching;
use nalgebra::DMatrix;

/// A row and a column that no permutation to a non-zero diagonal can pair, among the rows and
/// columns `inside` of J; `None` if there is such a permutation. Zero is exactly zero.
pub(super) fn unmatched(j: &DMatrix<f64>, inside: &[usize]) -> Option<(usize, usize)> {
    let mut columns: Vec<Vec<usize>> = Vec::with_capacity(inside.len());
    for &col in inside {
        // The capacity saves further allocations.
        let mut rows = Vec::with_capacity(inside.len());

        for (k, &row) in inside.iter().enumerate() {
            if j[(row, col)] != 0.0 {
                rows.push(k);
            }
        }

        columns.push(rows);
    }

    let (row, col) = matching::unmatched(&columns)?;
    Some((inside[row], inside[col]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn zeros_that_leave_no_diagonal_are_named() {
        let all = [0, 1, 2];
        assert_eq!(
            unmatched(&dmatrix![0.0, 1.0, 0.0; 1.0, 0.0, 0.0; 0.0, 0.0, 1.0], &all),
            None
        );
        assert_eq!(
            unmatched(&dmatrix![1.0, 1.0, 0.0; 0.0, 0.0, 0.0; 0.0, 0.0, 1.0], &all),
            Some((1, 1))
        );

        // Rows 0 and 1 share the only column they have; column 1 is nobody's.
        assert_eq!(
            unmatched(&dmatrix![1.0, 0.0, 0.0; 1.0, 0.0, 0.0; 1.0, 0.0, 1.0], &all),
            Some((1, 1))
        );

        // Augmenting along two rows: 0 - 0, then row 1 takes column 0 and row 0 moves on.
        assert_eq!(unmatched(&dmatrix![1.0, 1.0; 1.0, 0.0], &[0, 1]), None);
        assert_eq!(unmatched(&dmatrix![0.0, 1.0; 1.0, 0.0], &[0]), Some((0, 0)));
        assert_eq!(unmatched(&DMatrix::zeros(2, 2), &[]), None);

        // Singular in numbers, not by its zeros.
        assert_eq!(unmatched(&dmatrix![1.0, 1.0; 1.0, 1.0], &[0, 1]), None);
    }
}
