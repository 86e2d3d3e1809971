//! Sparse symmetric matrices of doubles, all entries by rows.

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

/// A sparse symmetric matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric {
    start: Vec<usize>,
    cols: Vec<usize>,
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
        let entries: Vec<(usize, usize, f64)> = entries.into_iter().collect();
        for &(row, col, got) in &entries {
            if row >= order || col >= order {
                return Err(SymmetricError::Index { row, col, order });
            }
            if !got.is_finite() {
                return Err(SymmetricError::NotFinite { row, col, got });
            }
        }
        let one = by_rows(order, entries.len(), || entries.iter().copied());
        drop(entries);
        // Transposed twice, the columns of each row are sorted.
        let turned = by_rows(order, one.cols.len(), || {
            one.entries().map(|(i, j, v)| (j, i, v))
        })
        .summed();
        let straight = by_rows(order, turned.cols.len(), || {
            turned.entries().map(|(i, j, v)| (j, i, v))
        });
        straight.averaged(&turned)
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.start.len() - 1
    }

    /// (column, value) of a row, columns ascending.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let place = self.start[i]..self.start[i + 1];
        self.cols[place.clone()]
            .iter()
            .copied()
            .zip(self.values[place].iter().copied())
    }

    /// Columns of a row, ascending.
    pub(super) fn columns(&self, i: usize) -> &[usize] {
        &self.cols[self.start[i]..self.start[i + 1]]
    }

    /// (row, column, value), by rows.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.order()).flat_map(|i| self.row(i).map(move |(j, v)| (i, j, v)))
    }

    /// An entry on the diagonal, 0 where there is none.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.row(i).find(|(j, _)| *j == i).map_or(0.0, |(_, v)| v)
    }

    /// The product with a vector of length `order`.
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        (0..self.order())
            .map(|i| self.row(i).map(|(j, v)| v * x[j]).sum())
            .collect()
    }

    /// self + factor other, of the same order, on the union of both patterns.
    pub fn add_scaled(&self, factor: f64, other: &Symmetric) -> Symmetric {
        let mut out = Symmetric {
            start: vec![0],
            cols: Vec::new(),
            values: Vec::new(),
        };
        for i in 0..self.order() {
            let (mut a, mut b) = (self.row(i).peekable(), other.row(i).peekable());
            loop {
                let (ja, jb) = (
                    a.peek().map_or(usize::MAX, |e| e.0),
                    b.peek().map_or(usize::MAX, |e| e.0),
                );
                let j = ja.min(jb);
                if j == usize::MAX {
                    break;
                }
                let first = a.next_if(|e| e.0 == j).map_or(0.0, |e| e.1);
                out.cols.push(j);
                out.values
                    .push(first + b.next_if(|e| e.0 == j).map_or(0.0, |e| factor * e.1));
            }
            out.start.push(out.cols.len());
        }
        out
    }

    /// Entries of one place are neighbours: adds them up.
    fn summed(mut self) -> Symmetric {
        let (mut from, mut to) = (0, 0);
        for i in 0..self.order() {
            let begin = to;
            for k in from..self.start[i + 1] {
                if to > begin && self.cols[to - 1] == self.cols[k] {
                    self.values[to - 1] += self.values[k];
                } else {
                    (self.cols[to], self.values[to]) = (self.cols[k], self.values[k]);
                    to += 1;
                }
            }
            from = self.start[i + 1];
            self.start[i + 1] = to;
        }
        self.cols.truncate(to);
        self.values.truncate(to);
        self
    }

    /// The mean with its transpose, which must be the same but for rounding.
    fn averaged(self, turned: &Symmetric) -> Result<Symmetric, SymmetricError> {
        let diagonal: Vec<f64> = (0..self.order()).map(|i| self.diagonal(i).abs()).collect();
        let difference = self.add_scaled(-1.0, turned);
        let apart =
            |e: &(usize, usize, f64)| e.2.abs() > ASYMMETRY * diagonal[e.0].max(diagonal[e.1]);
        if let Some((row, col, _)) = difference.entries().find(apart) {
            let entry = |m: &Symmetric| m.row(row).find(|e| e.0 == col).map_or(0.0, |e| e.1);
            return Err(SymmetricError::NotSymmetric {
                row,
                col,
                got: entry(&self),
                mirrored: entry(turned),
            });
        }
        let mut sum = self.add_scaled(1.0, turned);
        sum.values.iter_mut().for_each(|v| *v *= 0.5);
        Ok(sum)
    }
}

/// Entries sorted into rows, within a row in the order given.
fn by_rows<I: Iterator<Item = (usize, usize, f64)>>(
    order: usize,
    count: usize,
    entries: impl Fn() -> I,
) -> Symmetric {
    let mut start = vec![0; order + 1];
    entries().for_each(|(i, _, _)| start[i + 1] += 1);
    (0..order).for_each(|i| start[i + 1] += start[i]);
    let (mut cols, mut values, mut next) = (vec![0; count], vec![0.0; count], start.clone());
    for (i, j, v) in entries() {
        (cols[next[i]], values[next[i]]) = (j, v);
        next[i] += 1;
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

    #[test]
    fn rounding_is_averaged_and_more_is_refused() {
        let with = |v: f64| Symmetric::new(2, [(0, 0, 1.0), (1, 1, 1.0), (0, 1, 0.5), (1, 0, v)]);
        let m = with(0.5 + 4.0 * f64::EPSILON).unwrap();
        assert_eq!(m.times(&[0.0, 1.0])[0], m.times(&[1.0, 0.0])[1]);
        let refused = |r: Result<Symmetric, SymmetricError>| r.unwrap_err().to_string();
        assert_eq!(
            refused(with(0.25)),
            "expected a symmetric matrix, got (0, 1) = 0.5 and (1, 0) = 0.25"
        );
        assert_eq!(
            refused(Symmetric::new(2, [(0, 1, 1.0)])),
            "expected a symmetric matrix, got (0, 1) = 1 and (1, 0) = 0"
        );
        assert_eq!(
            refused(with(f64::NAN)),
            "expected a finite entry (1, 0), got NaN"
        );
        assert_eq!(
            refused(Symmetric::new(2, [(0, 2, 1.0)])),
            "expected row and column < 2, got (0, 2)"
        );
    }
}
