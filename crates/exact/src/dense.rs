//! Dense matrices over Q, for the small problems that elimination is run on.
//!
//! Elimination itself runs on integers: [`Dense::clear_rows`] makes the rows of several matrices
//! integral together. Called by the oracle and by whoever condenses small pencils.

use super::{Integer, Rational, cleared, common_denominator};
use num_traits::Zero;
use std::ops::{Index, IndexMut};

/// A dense matrix over Q, stored by rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dense {
    cols: usize,
    data: Vec<Rational>,
}

impl Dense {
    /// The zero matrix of the given shape.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Dense {
            cols,
            data: vec![Rational::zero(); rows * cols],
        }
    }

    /// A matrix from its rows, all of the same length.
    ///
    /// # Panics
    /// If the rows differ in length: readers check raggedness where they read.
    pub fn from_rows(rows: Vec<Vec<Rational>>) -> Self {
        let cols = rows.first().map_or(0, Vec::len);
        assert!(rows.iter().all(|r| r.len() == cols), "ragged rows");
        Dense {
            cols,
            data: rows.into_iter().flatten().collect(),
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.data.len().checked_div(self.cols).unwrap_or(0)
    }

    /// Number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// Row `i` as a slice.
    pub fn row(&self, i: usize) -> &[Rational] {
        let start = i * self.cols;
        &self.data[start..start + self.cols]
    }

    /// The rows of matrices with the same number of rows, those with one number multiplied by one
    /// positive integer that makes them all integral. Kernels and signs of products with a vector
    /// are unchanged.
    pub fn clear_rows<const N: usize>(matrices: [&Dense; N]) -> [Vec<Vec<Integer>>; N] {
        let count = matrices.first().map_or(0, |matrix| matrix.rows());
        let mut cleared = matrices.map(|_| Vec::with_capacity(count));
        for i in 0..count {
            let rows = matrices.map(|matrix| matrix.row(i));
            let clear = common_denominator(rows.iter().copied().flatten());
            for (list, row) in cleared.iter_mut().zip(rows) {
                list.push(integral(row, &clear));
            }
        }

        cleared
    }
}

/// clear * row, integers because `clear` is a multiple of every denominator.
fn integral(row: &[Rational], clear: &Integer) -> Vec<Integer> {
    row.iter().map(|entry| cleared(entry, clear)).collect()
}

impl Index<(usize, usize)> for Dense {
    type Output = Rational;

    fn index(&self, (i, j): (usize, usize)) -> &Rational {
        &self.data[i * self.cols + j]
    }
}

impl IndexMut<(usize, usize)> for Dense {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut Rational {
        &mut self.data[i * self.cols + j]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    #[test]
    fn rows_and_columns_are_counted() {
        let m = Dense::from_rows(vec![
            vec![whole(1), whole(2), whole(3)],
            vec![whole(4), whole(5), whole(6)],
        ]);

        assert_eq!(m.rows(), 2);
        assert_eq!(m.cols(), 3);
        assert_eq!(m.row(1), [4, 5, 6].map(whole));
    }

    #[test]
    fn clearing_a_row_scales_both_matrices_alike() {
        let a = Dense::from_rows(vec![vec![rational(1, 2), whole(0)]]);
        let b = Dense::from_rows(vec![vec![rational(1, 3), whole(-1)]]);

        let [integers_of_a, integers_of_b] = Dense::clear_rows([&a, &b]);

        assert_eq!(integers_of_a, [[Integer::from(3), Integer::from(0)]]);
        assert_eq!(integers_of_b, [[Integer::from(2), Integer::from(-6)]]);
    }
}
