//! Sparse symmetric matrices of doubles, all entries by rows.
//!
//! A matrix is made from entries in any order. Entries of one place add up, as in the assembly of
//! element matrices. Mirrored entries, which assembly in doubles leaves apart by rounding, are
//! replaced by their mean; where they differ by more the matrix is refused.
//!
//! The engine keeps stiffness and mass matrices of bodies in this form, and
//! `multifrontal` factors them.

use crate::tolerance::ASYMMETRY;

/// Why a list of entries is no symmetric matrix.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SymmetricError {
    /// An index beyond the order.
    #[error("expected row and column < {order}, got ({row}, {col})")]
    Index {
        /// Row.
        row: usize,
        /// Column.
        col: usize,
        /// Order of the matrix.
        order: usize,
    },
    /// NaN or infinite.
    #[error("expected a finite entry ({row}, {col}), got {got}")]
    NotFinite {
        /// Row.
        row: usize,
        /// Column.
        col: usize,
        /// The entry.
        got: f64,
    },
    /// Two entries that differ by more than rounding.
    #[error(
        "expected a symmetric matrix, got ({row}, {col}) = {got} and ({col}, {row}) = {mirrored}"
    )]
    NotSymmetric {
        /// Row.
        row: usize,
        /// Column.
        col: usize,
        /// The entry.
        got: f64,
        /// Its mirror.
        mirrored: f64,
    },
}

/// Row, column and value.
type Triplet = (usize, usize, f64);

/// A sparse symmetric matrix.
///
/// While it is made it may be unsymmetric, and hold unsorted rows with several entries of one
/// place; a value that a public function returns does not.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric {
    /// For each row the index of its first entry, then the number of entries.
    start: Vec<usize>,
    /// The column of each entry.
    cols: Vec<usize>,
    /// The value of each entry.
    values: Vec<f64>,
}

impl Symmetric {
    /// From entries (row, column, value) in any order; entries of one place add up, mirrored ones
    /// are averaged (assembly in doubles leaves them apart by rounding).
    ///
    /// # Errors
    /// [`SymmetricError`] naming the place.
    ///
    /// ```
    /// use mceip_mcp::linear::Symmetric;
    /// let k = Symmetric::new(
    ///     2,
    ///     [
    ///         (0, 0, 2.0),
    ///         (0, 1, -1.0),
    ///         (1, 0, -1.0),
    ///         (1, 1, 1.0),
    ///         (1, 1, 1.0),
    ///     ],
    /// )
    /// .unwrap();
    /// assert_eq!(k.times(&[1.0, 3.0]), [-1.0, 5.0]);
    /// assert!(Symmetric::new(2, [(0, 1, 1.0)]).is_err());
    /// ```
    pub fn new(
        order: usize,
        entries: impl IntoIterator<Item = (usize, usize, f64)>,
    ) -> Result<Symmetric, SymmetricError> {
        let entries: Vec<Triplet> = entries.into_iter().collect();
        for &(row, col, got) in &entries {
            if row >= order || col >= order {
                return Err(SymmetricError::Index { row, col, order });
            }

            if !got.is_finite() {
                return Err(SymmetricError::NotFinite { row, col, got });
            }
        }

        let unsorted = by_rows(order, entries.len(), || entries.iter().copied());
        drop(entries);

        // A transposition lists the columns of each row in ascending order: after two of them the
        // rows of the matrix itself are sorted. Between them entries of one place are neighbours.
        let transposed = unsorted.transposed().with_sums();
        let matrix = transposed.transposed();

        matrix.averaged(&transposed)
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.start.len() - 1
    }

    /// (column, value) of a row, columns ascending.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let place = self.start[i]..self.start[i + 1];
        let cols = self.cols[place.clone()].iter().copied();
        let values = self.values[place].iter().copied();

        cols.zip(values)
    }

    /// Columns of a row, ascending.
    pub(super) fn columns(&self, i: usize) -> &[usize] {
        &self.cols[self.start[i]..self.start[i + 1]]
    }

    /// (row, column, value), by rows.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let rows = 0..self.order();
        rows.flat_map(|i| {
            let row = self.row(i);
            row.map(move |(j, value)| (i, j, value))
        })
    }

    /// An entry, 0 where there is none.
    fn entry(&self, row: usize, col: usize) -> f64 {
        for (j, value) in self.row(row) {
            if j == col {
                return value;
            }
        }

        0.0
    }

    /// An entry on the diagonal, 0 where there is none.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.entry(i, i)
    }

    /// The product with a vector of length `order`.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = Vec::with_capacity(self.order());
        for i in 0..self.order() {
            product.push(self.row(i).map(|(j, v)| v * x[j]).sum());
        }
        product
    }

    /// self + factor other, of the same order, on the union of both patterns.
    pub fn add_scaled(&self, factor: f64, other: &Symmetric) -> Symmetric {
        let mut sum = Symmetric {
            start: vec![0],
            cols: Vec::new(),
            values: Vec::new(),
        };

        for i in 0..self.order() {
            sum.push_row(self.row(i), factor, other.row(i));
        }
        sum
    }

    /// Appends the row `first` + factor `second`. Both have their columns in ascending order, and
    /// so has the new row.
    fn push_row(
        &mut self,
        first: impl Iterator<Item = (usize, f64)>,
        factor: f64,
        second: impl Iterator<Item = (usize, f64)>,
    ) {
        let mut first = first.peekable();
        let mut second = second.peekable();

        loop {
            let next_of_first = first.peek().map_or(usize::MAX, |entry| entry.0);
            let next_of_second = second.peek().map_or(usize::MAX, |entry| entry.0);
            let col = next_of_first.min(next_of_second);

            if col == usize::MAX {
                break;
            }

            let a = first.next_if(|entry| entry.0 == col);
            let b = second.next_if(|entry| entry.0 == col);
            let a = a.map_or(0.0, |entry| entry.1);
            let b = b.map_or(0.0, |entry| factor * entry.1);
            self.cols.push(col);
            self.values.push(a + b);
        }

        self.start.push(self.cols.len());
    }

    /// The transposed matrix; in each of its rows the columns ascend.
    fn transposed(&self) -> Symmetric {
        by_rows(self.order(), self.cols.len(), || {
            self.entries().map(|(i, j, v)| (j, i, v))
        })
    }

    /// Adds up entries of one place, which are neighbours.
    fn with_sums(mut self) -> Symmetric {
        let mut read = 0;
        let mut written = 0;

        for i in 0..self.order() {
            let begin = written;
            for k in read..self.start[i + 1] {
                if written > begin && self.cols[written - 1] == self.cols[k] {
                    self.values[written - 1] += self.values[k];
                } else {
                    self.cols[written] = self.cols[k];
                    self.values[written] = self.values[k];
                    written += 1;
                }
            }

            read = self.start[i + 1];
            self.start[i + 1] = written;
        }

        self.cols.truncate(written);
        self.values.truncate(written);
        self
    }

    /// The mean with its transpose, which must be the same but for rounding.
    fn averaged(self, transposed: &Symmetric) -> Result<Symmetric, SymmetricError> {
        let diagonal: Vec<f64> = (0..self.order()).map(|i| self.diagonal(i).abs()).collect();

        let difference = self.add_scaled(-1.0, transposed);
        for (row, col, value) in difference.entries() {
            if value.abs() > ASYMMETRY * diagonal[row].max(diagonal[col]) {
                return Err(SymmetricError::NotSymmetric {
                    row,
                    col,
                    got: self.entry(row, col),
                    mirrored: transposed.entry(row, col),
                });
            }
        }

        let mut mean = self.add_scaled(1.0, transposed);
        for value in &mut mean.values {
            *value *= 0.5;
        }
        Ok(mean)
    }
}

/// Entries sorted into rows, within a row in the order given. `entries` is called twice: to count
/// and to write.
fn by_rows<I: Iterator<Item = Triplet>>(
    order: usize,
    count: usize,
    entries: impl Fn() -> I,
) -> Symmetric {
    let mut start = vec![0; order + 1];
    for (row, _, _) in entries() {
        start[row + 1] += 1;
    }

    for row in 0..order {
        start[row + 1] += start[row];
    }

    let mut cols = vec![0; count];
    let mut values = vec![0.0; count];
    let mut next = start.clone();

    for (row, col, value) in entries() {
        let place = next[row];
        cols[place] = col;
        values[place] = value;
        next[row] += 1;
    }

    Symmetric {
        start,
        cols,
        values,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_in_any_order_add_up() {
        let list = [
            (2, 0, 1.0),
            (1, 1, 2.0),
            (0, 2, 0.5),
            (0, 0, 3.0),
            (1, 1, 2.0),
            (0, 2, 0.5),
            (2, 2, 7.0),
        ];
        let m = Symmetric::new(3, list).unwrap();
        let all: Vec<_> = m.entries().collect();

        assert_eq!(
            all,
            [
                (0, 0, 3.0),
                (0, 2, 1.0),
                (1, 1, 4.0),
                (2, 0, 1.0),
                (2, 2, 7.0)
            ]
        );

        let other = Symmetric::new(3, [(1, 0, 1.0), (0, 1, 1.0), (1, 1, -1.0)]).unwrap();
        let both: Vec<_> = m.add_scaled(2.0, &other).entries().collect();
        assert_eq!(
            both,
            [
                (0, 0, 3.0),
                (0, 1, 2.0),
                (0, 2, 1.0),
                (1, 0, 2.0),
                (1, 1, 2.0),
                (2, 0, 1.0),
                (2, 2, 7.0)
            ]
        );
    }

    /// [1 1/2; v 1].
    fn with_mirror(v: f64) -> Result<Symmetric, SymmetricError> {
        Symmetric::new(2, [(0, 0, 1.0), (1, 1, 1.0), (0, 1, 0.5), (1, 0, v)])
    }

    fn refusal(made: Result<Symmetric, SymmetricError>) -> String {
        made.unwrap_err().to_string()
    }

    #[test]
    fn rounding_is_averaged_and_more_is_refused() {
        let m = with_mirror(0.5 + 4.0 * f64::EPSILON).unwrap();
        assert_eq!(m.times(&[0.0, 1.0])[0], m.times(&[1.0, 0.0])[1]);

        assert_eq!(
            refusal(with_mirror(0.25)),
            "expected a symmetric matrix, got (0, 1) = 0.5 and (1, 0) = 0.25"
        );
        assert_eq!(
            refusal(Symmetric::new(2, [(0, 1, 1.0)])),
            "expected a symmetric matrix, got (0, 1) = 1 and (1, 0) = 0"
        );
        assert_eq!(
            refusal(with_mirror(f64::NAN)),
            "expected a finite entry (1, 0), got NaN"
        );
        assert_eq!(
            refusal(Symmetric::new(2, [(0, 2, 1.0)])),
            "expected row and column < 2, got (0, 2)"
        );
    }
}
