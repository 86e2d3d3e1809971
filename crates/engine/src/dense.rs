//! Small dense matrices in doubles, by rows: what several parts of the engine do with them.
//!
//! Used by the searches, the analysis and the reduction in doubles. Results are proposals that
//! exact arithmetic decides, or are reported as measured (flutter).
#![allow(clippy::float_arithmetic)]

use mceip_exact::{Sparse, to_f64};

/// A matrix of rationals, each entry rounded to the nearest double.
pub(crate) fn rounded(matrix: &Sparse) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.cols()]; matrix.rows()];
    for (i, j, v) in matrix.entries() {
        rows[i][j] = to_f64(v);
    }

    rows
}

/// The columns of a square matrix given by rows, or the rows of one given by columns.
pub(crate) fn transposed(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let order = matrix.len();
    let mut transposed = vec![vec![0.0; order]; order];
    for (i, row) in matrix.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            transposed[j][i] = *entry;
        }
    }

    transposed
}

/// One step of Gaussian elimination: subtracts multiples of row k from the rows below it, in the
/// columns after k. Column k keeps its old entries.
pub(crate) fn eliminate_below(matrix: &mut [Vec<f64>], k: usize) {
    let order = matrix.len();
    let (upper, lower) = matrix.split_at_mut(k + 1);
    let pivot_row = &upper[k];

    for row in lower {
        let factor = row[k] / pivot_row[k];
        for j in k + 1..order {
            row[j] -= factor * pivot_row[j];
        }
    }
}

/// The upper triangle of a symmetric matrix, by rows of full length in one array; places left of
/// the diagonal stay zero.
pub(crate) struct UpperTriangle {
    order: usize,
    entries: Vec<f64>,
}

impl UpperTriangle {
    /// The matrix with these entries; `entry(i, j)` is asked for i <= j.
    pub(crate) fn new(order: usize, entry: impl Fn(usize, usize) -> f64) -> UpperTriangle {
        let mut entries = vec![0.0; order * order];
        // Chunks of length 0 are not allowed.
        for (i, row) in entries.chunks_exact_mut(order.max(1)).enumerate() {
            for j in i..order {
                row[j] = entry(i, j);
            }
        }

        UpperTriangle { order, entries }
    }

    /// Largest modulus of an entry, zero for an empty matrix.
    pub(crate) fn largest_entry(&self) -> f64 {
        self.entries
            .iter()
            .fold(0.0, |largest, entry| entry.abs().max(largest))
    }

    pub(crate) fn subtract_from_diagonal(&mut self, i: usize, amount: f64) {
        self.entries[i * self.order + i] -= amount;
    }

    /// Does elimination meet only pivots above `least`?
    pub(crate) fn has_pivots_above(mut self, least: f64) -> bool {
        for k in 0..self.order {
            let (upper, lower) = self.entries.split_at_mut((k + 1) * self.order);
            let pivot_row = &upper[k * self.order..];
            let pivot = pivot_row[k];
            if pivot.is_nan() || pivot <= least {
                return false;
            }

            for (row, i) in lower.chunks_exact_mut(self.order).zip(k + 1..) {
                let factor = pivot_row[i] / pivot;
                for (entry, of_pivot_row) in row[i..].iter_mut().zip(&pivot_row[i..]) {
                    *entry -= factor * of_pivot_row;
                }
            }
        }

        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    #[test]
    fn entries_are_rounded_and_the_others_are_zero() {
        let matrix =
            Sparse::from_entries(2, 3, vec![(0, 2, rational(1, 3)), (1, 0, rational(-2, 1))]);

        assert_eq!(
            rounded(&matrix),
            vec![vec![0.0, 0.0, 1.0 / 3.0], vec![-2.0, 0.0, 0.0]]
        );
    }

    #[test]
    fn a_transposed_matrix_has_rows_for_columns() {
        let matrix = [vec![1.0, 2.0], vec![3.0, 4.0]];
        assert_eq!(transposed(&matrix), vec![vec![1.0, 3.0], vec![2.0, 4.0]]);
    }

    /// [[4, 2], [2, 3]] has the pivots 4 and 3 - 2 2/4 = 2.
    #[test]
    fn the_smallest_pivot_decides() {
        let entries = [[4.0, 2.0], [2.0, 3.0]];
        let matrix = || UpperTriangle::new(2, |i, j| entries[i][j]);

        assert!(matrix().has_pivots_above(1.9));
        assert!(!matrix().has_pivots_above(2.0));
        assert!(!UpperTriangle::new(1, |_, _| f64::NAN).has_pivots_above(0.0));
        assert!(UpperTriangle::new(0, |_, _| 0.0).has_pivots_above(0.0));
    }
}
