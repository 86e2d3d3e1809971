//! Sparse matrices over Q: rows of (column, value), the form every given matrix takes.
//!
//! Rows are sorted by column and hold no zeros, so equal matrices have equal rows. Called by every
//! crate of the workspace; elimination runs on [`Dense`] and integer matrices made of it.

use super::{Dense, Rational};
use num_traits::Zero;

/// A matrix over Q stored by rows, each row sorted by column, zeros left out.
///
/// Two matrices are equal exactly when they have the same shape and the same entries.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sparse {
    cols: usize,
    rows: Vec<Vec<(usize, Rational)>>,
}

impl Sparse {
    /// The zero matrix of the given shape.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Sparse {
            cols,
            rows: vec![Vec::new(); rows],
        }
    }

    /// The identity of order `n`.
    pub fn identity(n: usize) -> Self {
        Self::from_entries(
            n,
            n,
            (0..n).map(|i| (i, i, Rational::from_integer(1.into()))),
        )
    }

    /// Sums entries given in any order; entries named twice are added, zeros dropped.
    ///
    /// # Panics
    /// If an index lies outside the shape: callers check indices where they read them.
    pub fn from_entries(
        rows: usize,
        cols: usize,
        entries: impl IntoIterator<Item = (usize, usize, Rational)>,
    ) -> Self {
        let mut lists: Vec<Vec<(usize, Rational)>> = vec![Vec::new(); rows];
        for (i, j, v) in entries {
            assert!(
                i < rows && j < cols,
                "entry ({i}, {j}) outside a {rows} x {cols} matrix"
            );
            lists[i].push((j, v));
        }

        for list in &mut lists {
            list.sort_by_key(|e| e.0); // stable: sums in the order given
            let mut merged: Vec<(usize, Rational)> = Vec::with_capacity(list.len());
            for (j, v) in list.drain(..) {
                match merged.last_mut() {
                    Some(last) if last.0 == j => last.1 += v,
                    _ => merged.push((j, v)),
                }
            }
            merged.retain(|e| !e.1.is_zero());
            *list = merged;
        }

        Sparse { cols, rows: lists }
    }

    /// A matrix of machine integers by rows of one length, as [`super::Poly::from_ints`].
    ///
    /// ```
    /// use mceip_exact::{Sparse, whole};
    /// let m = Sparse::from_ints(&[&[1, 0, -2], &[0, 3, 0]]);
    /// assert_eq!((m.rows(), m.cols(), m.get(0, 2)), (2, 3, whole(-2)));
    /// ```
    ///
    /// # Panics
    /// If a row is longer than the first: the caller writes the numbers down.
    pub fn from_ints(rows: &[&[i64]]) -> Self {
        let entries = rows.iter().enumerate().flat_map(|(i, r)| {
            r.iter()
                .enumerate()
                .map(move |(j, &v)| (i, j, super::whole(v)))
        });

        Sparse::from_entries(rows.len(), rows.first().map_or(0, |r| r.len()), entries)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// The non-zero entries of row `i`, by ascending column.
    pub fn row(&self, i: usize) -> &[(usize, Rational)] {
        &self.rows[i]
    }

    /// All non-zero entries, row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &Rational)> {
        self.rows
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().map(move |(j, v)| (i, *j, v)))
    }

    /// Entry (i, j), zero where none is stored.
    pub fn get(&self, i: usize, j: usize) -> Rational {
        match self.rows[i].binary_search_by_key(&j, |e| e.0) {
            Ok(k) => self.rows[i][k].1.clone(),
            Err(_) => Rational::zero(),
        }
    }

    /// The sub-matrix of the given rows and columns, in the given order.
    pub fn submatrix(&self, rows: &[usize], cols: &[usize]) -> Sparse {
        let mut place = vec![usize::MAX; self.cols];
        for (k, &j) in cols.iter().enumerate() {
            place[j] = k;
        }

        let entries = rows.iter().enumerate().flat_map(|(k, &i)| {
            let place = &place;
            self.rows[i]
                .iter()
                .filter(|e| place[e.0] != usize::MAX)
                .map(move |(j, v)| (k, place[*j], v.clone()))
        });

        Sparse::from_entries(rows.len(), cols.len(), entries)
    }

    /// -self.
    pub fn negated(&self) -> Sparse {
        let entries = self.entries().map(|(i, j, v)| (i, j, -v));
        Sparse::from_entries(self.rows(), self.cols, entries)
    }

    /// `self + factor * other`. Shapes must agree.
    pub fn add_scaled(&self, factor: &Rational, other: &Sparse) -> Sparse {
        let own = self.entries().map(|(i, j, v)| (i, j, v.clone()));
        let theirs = other.entries().map(|(i, j, v)| (i, j, factor * v));
        Sparse::from_entries(self.rows(), self.cols, own.chain(theirs))
    }

    /// The product with a vector of length `cols`.
    pub fn times(&self, x: &[Rational]) -> Vec<Rational> {
        self.rows
            .iter()
            .map(|row| row.iter().map(|(j, v)| v * &x[*j]).sum())
            .collect()
    }

    /// The transpose.
    pub fn transpose(&self) -> Sparse {
        Sparse::from_entries(
            self.cols,
            self.rows(),
            self.entries().map(|(i, j, v)| (j, i, v.clone())),
        )
    }

    /// The first pair (i, j), i < j in row order, at which the matrix differs from its transpose.
    pub fn first_asymmetry(&self) -> Option<(usize, usize)> {
        self.entries()
            .find(|&(i, j, v)| i != j && self.get(j, i) != *v)
            .map(|(i, j, _)| (i.min(j), i.max(j)))
    }

    /// The same matrix with every entry stored.
    pub fn to_dense(&self) -> Dense {
        let mut dense = Dense::zeros(self.rows(), self.cols);
        for (i, j, v) in self.entries() {
            dense[(i, j)] = v.clone();
        }
        dense
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    fn example() -> Sparse {
        Sparse::from_entries(
            2,
            3,
            [
                (0, 2, whole(3)),
                (0, 0, whole(1)),
                (1, 1, rational(1, 2)),
                (0, 2, whole(-3)),
                (1, 2, whole(4)),
            ],
        )
    }

    #[test]
    fn entries_are_sorted_summed_and_free_of_zeros() {
        let m = example();
        assert_eq!(m.row(0), &[(0, whole(1))]);
        assert_eq!(m.get(1, 2), whole(4));
        assert_eq!(m.get(0, 2), whole(0));
    }

    #[test]
    fn products_submatrices_and_transposes() {
        let m = example();
        assert_eq!(
            m.times(&[whole(2), whole(4), whole(1)]),
            vec![whole(2), whole(6)]
        );

        assert_eq!(m.transpose().transpose(), m);
        assert_eq!(
            m.submatrix(&[1], &[2, 1]),
            Sparse::from_entries(1, 2, [(0, 0, whole(4)), (0, 1, rational(1, 2))])
        );

        assert_eq!(m.add_scaled(&whole(-1), &m), Sparse::zeros(2, 3));
    }

    #[test]
    fn asymmetry_is_found_also_against_a_missing_entry() {
        let symmetric = Sparse::from_entries(2, 2, [(0, 1, whole(1)), (1, 0, whole(1))]);
        assert_eq!(symmetric.first_asymmetry(), None);
        let skew = Sparse::from_entries(2, 2, [(1, 0, whole(1))]);
        assert_eq!(skew.first_asymmetry(), Some((0, 1)));
    }
}
