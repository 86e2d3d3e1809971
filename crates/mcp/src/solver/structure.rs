//! Is a Jacobian singular by its zeros alone?
//!
//! A matrix whose rows and columns cannot be permuted to a diagonal without zeros has determinant
//! zero whatever its other entries are. Called by `newton` at the end of a run that found nothing,
//! with the unknowns strictly between their bounds.

use super::jacobian::JacobianMatrix;
use super::matching;

/// A row and a column that no permutation to a non-zero diagonal can pair, among the rows and
/// columns `inside` of J; `None` if there is such a permutation. Zero is exactly zero.
pub(super) fn unmatched(j: &JacobianMatrix, inside: &[usize]) -> Option<(usize, usize)> {
    let mut columns: Vec<Vec<usize>> = Vec::with_capacity(inside.len());
    for &col in inside {
        columns.push(places_of_entries(j, col, inside));
    }

    let (row, col) = matching::unmatched(&columns)?;
    Some((inside[row], inside[col]))
}

/// The places among the rows `inside`, ascending, at which column `col` is not zero.
fn places_of_entries(j: &JacobianMatrix, col: usize, inside: &[usize]) -> Vec<usize> {
    match j {
        JacobianMatrix::Dense(matrix) => {
            // The capacity saves further allocations.
            let mut places = Vec::with_capacity(inside.len());
            for (place, &row) in inside.iter().enumerate() {
                if matrix[(row, col)] != 0.0 {
                    places.push(place);
                }
            }
            places
        }
        JacobianMatrix::Sparse(matrix) => matrix
            .column(col)
            .filter(|&(_, value)| value != 0.0)
            .filter_map(|(row, _)| inside.binary_search(&row).ok())
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::jacobian::SparseColumns;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    /// What is found in a dense matrix, and in a sparse one with the same entries, zeros too.
    fn unmatched(j: &DMatrix<f64>, inside: &[usize]) -> Option<(usize, usize)> {
        let order = j.nrows();
        let places = (0..order).flat_map(|row| (0..order).map(move |col| (row, col)));
        let mut entries: Vec<_> = places.map(|(row, col)| (row, col, j[(row, col)])).collect();
        let sparse = SparseColumns::new(order, &mut entries).unwrap();

        let found = super::unmatched(&j.clone().into(), inside);
        assert_eq!(
            super::unmatched(&JacobianMatrix::Sparse(sparse), inside),
            found
        );
        found
    }

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
