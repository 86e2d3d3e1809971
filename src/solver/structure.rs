//! Is a Jacobian singular by its zeros alone? A maximum matching of rows and columns (Kuhn 1955).

use nalgebra::DMatrix;

/// A row and a column that no permutation to a non-zero diagonal can pair, among the rows and columns
/// `inside` of J; `None` if there is such a permutation. Zero is exactly zero.
pub(super) fn unmatched(j: &DMatrix<f64>, inside: &[usize]) -> Option<(usize, usize)> {
    let k = inside.len();
    let mut row_of = vec![None; k];
    let mut first = None;
    for row in 0..k {
        let mut seen = vec![false; k];
        if !augment(j, inside, row, &mut seen, &mut row_of) {
            first = first.or(Some(inside[row]));
        }
    }
    let col = row_of.iter().position(Option::is_none)?;
    first.map(|row| (row, inside[col]))
}

/// Gives `row` a column, moving others where that helps. Rows are tried once per call, so depth and time are bounded.
fn augment(j: &DMatrix<f64>, inside: &[usize], row: usize, seen: &mut [bool], row_of: &mut [Option<usize>]) -> bool {
    for col in 0..inside.len() {
        if j[(inside[row], inside[col])] == 0.0 || seen[col] {
            continue;
        }
        seen[col] = true;
        let is_free = match row_of[col] {
            None => true,
            Some(other) => augment(j, inside, other, seen, row_of),
        };
        if is_free {
            row_of[col] = Some(row);
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn zeros_that_leave_no_diagonal_are_named() {
        let all = [0, 1, 2];
        assert_eq!(unmatched(&dmatrix![0.0, 1.0, 0.0; 1.0, 0.0, 0.0; 0.0, 0.0, 1.0], &all), None);
        assert_eq!(unmatched(&dmatrix![1.0, 1.0, 0.0; 0.0, 0.0, 0.0; 0.0, 0.0, 1.0], &all), Some((1, 1)));
        // Rows 0 and 1 share the only column they have; column 1 is nobody's.
        assert_eq!(unmatched(&dmatrix![1.0, 0.0, 0.0; 1.0, 0.0, 0.0; 1.0, 0.0, 1.0], &all), Some((1, 1)));
        // Augmenting along two rows: 0 - 0, then row 1 takes column 0 and row 0 moves on.
        assert_eq!(unmatched(&dmatrix![1.0, 1.0; 1.0, 0.0], &[0, 1]), None);
        assert_eq!(unmatched(&dmatrix![0.0, 1.0; 1.0, 0.0], &[0]), Some((0, 0)));
        assert_eq!(unmatched(&DMatrix::zeros(2, 2), &[]), None);
        // Singular in numbers, not by its zeros.
        assert_eq!(unmatched(&dmatrix![1.0, 1.0; 1.0, 1.0], &[0, 1]), None);
    }
}
