//! LU factors of dense matrices in storage that is kept from one matrix to the next, over the
//! numbers of the path.
//!
//! P A = L U with row pivoting, column by column: column j is reduced by the columns of L so far,
//! its largest remaining entry becomes the pivot, and where nothing is left of it the column
//! *depends* on those before. Dependent columns are skipped and named, with the rows that no pivot
//! has taken, so that a singular basis can be repaired (`path/factor.rs`).
//!
//! Called by the crash (`crash/step.rs`), the factors of a basis and the start of a path.

use super::number::PathNumber;
use std::cmp::Ordering;

/// P A = L U with row pivoting, column by column, so that dependent columns are found on the way.
#[derive(Debug, Clone)]
pub(super) struct Lu<T> {
    order: usize,
    /// L below the diagonal (its diagonal is 1), U on and above it, by columns.
    entries: Vec<T>,
    /// The row of A in each place.
    rows: Vec<usize>,
    /// Columns that depend on those before them.
    dependent: Vec<usize>,
}

impl<T> Default for Lu<T> {
    fn default() -> Self {
        Lu {
            order: 0,
            entries: Vec::new(),
            rows: Vec::new(),
            dependent: Vec::new(),
        }
    }
}

impl<T: PathNumber> Lu<T> {
    /// Factors the matrix whose column j `gather(j, rows, out)` writes, in the order of `rows`. A
    /// column of which elimination leaves at most `least(j)` is dependent. True if there is none.
    pub(super) fn factor(
        &mut self,
        order: usize,
        gather: impl Fn(usize, &[usize], &mut [T]),
        least: impl Fn(usize) -> T,
    ) -> bool {
        self.order = order;
        self.entries.resize(order * order, T::zero());
        self.rows.clear();
        self.rows.extend(0..order);
        self.dependent.clear();

        let mut rank = 0;
        for j in 0..order {
            let (finished, rest) = self.entries.split_at_mut(rank * order);
            let column = &mut rest[..order];
            gather(j, &self.rows, column);
            reduce(column, finished);

            let pivot = largest_from(column, rank);

            // A size that is NaN does not compare, and makes the column dependent.
            if pivot.size.partial_cmp(&least(j)) != Some(Ordering::Greater) {
                self.dependent.push(j);
                continue;
            }

            if pivot.place != rank {
                self.rows.swap(rank, pivot.place);
                column.swap(rank, pivot.place);
                for l in finished.chunks_exact_mut(order) {
                    l.swap(rank, pivot.place);
                }
            }

            let (above, below) = column.split_at_mut(rank + 1);
            for entry in below {
                *entry /= above[rank].clone();
            }

            rank += 1;
        }

        self.dependent.is_empty()
    }

    /// The row of A in each place of the factors.
    pub(super) fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Dependent columns, and the rows that no column has taken.
    pub(super) fn dependent(&self) -> (&[usize], &[usize]) {
        let rank = self.order - self.dependent.len();
        (&self.dependent, &self.rows[rank..])
    }

    /// Column s of the factors.
    fn column(&self, s: usize) -> &[T] {
        &self.entries[s * self.order..][..self.order]
    }

    /// Solves A x = b: `x` holds b in the order of [`Lu::rows`] before and x after.
    pub(super) fn solve(&self, x: &mut [T]) {
        // L y = b, y in place of b.
        for s in 0..self.order {
            let (above, below) = x.split_at_mut(s + 1);
            subtract(below, &above[s], &self.column(s)[s + 1..]);
        }

        // U x = y.
        for s in (0..self.order).rev() {
            let column = self.column(s);
            x[s] /= column[s].clone();
            let (above, below) = x.split_at_mut(s);
            subtract(above, &below[0], &column[..s]);
        }
    }

    /// Solves A' y = b: `x` holds b before, and y in the order of [`Lu::rows`] after.
    pub(super) fn solve_transposed(&self, x: &mut [T]) {
        // U' w = b, w in place of b.
        for s in 0..self.order {
            let column = self.column(s);
            let inner = dot(&column[..s], &x[..s]);
            x[s] -= inner;
            x[s] /= column[s].clone();
        }

        // L' y = w.
        for s in (0..self.order).rev() {
            let inner = dot(&self.column(s)[s + 1..], &x[s + 1..]);
            x[s] -= inner;
        }
    }
}

/// An entry of a column that may become the pivot.
struct PivotCandidate<T> {
    place: usize,
    size: T,
}

/// Reduces a new column by the finished ones, each with its pivot on the diagonal.
fn reduce<T: PathNumber>(column: &mut [T], finished: &[T]) {
    for (s, l) in finished.chunks_exact(column.len()).enumerate() {
        let (above, below) = column.split_at_mut(s + 1);
        subtract(below, &above[s], &l[s + 1..]);
    }
}

/// The entry of largest magnitude from place `first` on, the first one of equal ones; place `first`
/// with size 0 if no entry is greater than that.
fn largest_from<T: PathNumber>(column: &[T], first: usize) -> PivotCandidate<T> {
    let mut best = PivotCandidate {
        place: first,
        size: T::zero(),
    };

    for (place, entry) in column.iter().enumerate().skip(first) {
        let size = entry.magnitude();
        if size > best.size {
            best = PivotCandidate { place, size };
        }
    }
    best
}

/// y -= factor x.
pub(super) fn subtract<T: PathNumber>(y: &mut [T], factor: &T, x: &[T]) {
    if factor.is_zero() {
        return;
    }

    for (y, x) in y.iter_mut().zip(x) {
        *y -= factor.clone() * x.clone();
    }
}

/// x'y.
pub(super) fn dot<T: PathNumber>(x: &[T], y: &[T]) -> T {
    let mut sum = T::zero();
    for (x, y) in x.iter().zip(y) {
        sum += x.clone() * y.clone();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, dmatrix, dvector};

    fn factored(a: &DMatrix<f64>) -> (Lu<f64>, bool) {
        let mut lu = Lu::default();
        let column = |j: usize, rows: &[usize], out: &mut [f64]| {
            for (&row, entry) in rows.iter().zip(out) {
                *entry = a[(row, j)];
            }
        };

        // Storage of something else before.
        lu.factor(3, |_, _, out: &mut [f64]| out.fill(7.0), |_| 0.0);
        let regular = lu.factor(a.nrows(), column, |_| 1e-12);
        (lu, regular)
    }

    #[test]
    fn solves_both_ways() {
        let a = dmatrix![0.0, 2.0, 1.0; 4.0, 1.0, 0.0; 1.0, 1.0, 3.0];
        let (lu, regular) = factored(&a);
        assert!(regular);

        let b = dvector![1.0, -2.0, 5.0];
        let mut x: Vec<f64> = lu.rows().iter().map(|&i| b[i]).collect();
        lu.solve(&mut x);

        assert!((&a * DVector::from_vec(x) - &b).amax() < 1e-14);

        let mut y = b.as_slice().to_vec();
        lu.solve_transposed(&mut y);
        let mut by_row = dvector![0.0, 0.0, 0.0];
        for (&row, value) in lu.rows().iter().zip(&y) {
            by_row[row] = *value;
        }

        assert!((a.transpose() * by_row - &b).amax() < 1e-14);
    }

    #[test]
    fn dependent_columns_are_named_with_the_rows_left() {
        assert!(factored(&DMatrix::zeros(0, 0)).1);
        assert!(factored(&dmatrix![0.0, 2.0; 3.0, 0.0]).1);

        let (lu, regular) = factored(&dmatrix![1.0, 0.0, 1.0; 2.0, 1.0, 2.0; 0.0, 0.0, 0.0]);
        assert!(!regular);
        assert_eq!(lu.dependent(), (&[2][..], &[2][..]));

        let (lu, _) = factored(&dmatrix![1.0, 1.0, 0.0; 2.0, 2.0, 0.0; 0.0, 0.0, 5.0]);
        assert_eq!(lu.dependent(), (&[1][..], &[0][..]));
        assert!(!factored(&dmatrix![f64::NAN]).1);
        assert_eq!(
            factored(&DMatrix::zeros(2, 2)).0.dependent(),
            (&[0, 1][..], &[0, 1][..])
        );
    }
}
