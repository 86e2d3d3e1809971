//! LU factors of dense matrices in storage that is kept from one matrix to the next, over the
//! numbers of the path.

use super::number::Number;

/// P A = L U with row pivoting, column by column, so that dependent columns are found on the way.
#[derive(Debug, Clone)]
pub(super) struct Lu<T> {
    order: usize,
    /// L below the diagonal, U on and above it, by columns.
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

impl<T: Number> Lu<T> {
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
            let (left, right) = self.entries.split_at_mut(rank * order);
            let column = &mut right[..order];
            gather(j, &self.rows, column);
            for (s, l) in left.chunks_exact(order).enumerate() {
                let (above, below) = column.split_at_mut(s + 1);
                subtract(below, &above[s], &l[s + 1..]);
            }
            let (mut best, mut size) = (rank, T::zero());
            for (i, entry) in column.iter().enumerate().skip(rank) {
                let magnitude = entry.magnitude();
                if magnitude > size {
                    (best, size) = (i, magnitude);
                }
            }
            // Also where size is NaN.
            if !matches!(
                size.partial_cmp(&least(j)),
                Some(std::cmp::Ordering::Greater)
            ) {
                self.dependent.push(j);
                continue;
            }
            if best != rank {
                self.rows.swap(rank, best);
                column.swap(rank, best);
                left.chunks_exact_mut(order)
                    .for_each(|l| l.swap(rank, best));
            }
            let pivot = column[rank].clone();
            column[rank + 1..]
                .iter_mut()
                .for_each(|entry| *entry /= pivot.clone());
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
        (
            &self.dependent,
            &self.rows[self.order - self.dependent.len()..],
        )
    }

    /// Solves A x = b: `x` holds b in the order of [`Lu::rows`] before and x after.
    pub(super) fn solve(&self, x: &mut [T]) {
        for s in 0..self.order {
            let (above, below) = x.split_at_mut(s + 1);
            subtract(
                below,
                &above[s],
                &self.entries[s * self.order + s + 1..(s + 1) * self.order],
            );
        }
        for s in (0..self.order).rev() {
            let column = &self.entries[s * self.order..];
            x[s] /= column[s].clone();
            let (above, below) = x.split_at_mut(s);
            subtract(above, &below[0], &column[..s]);
        }
    }

    /// Solves A' y = b: `x` holds b before, and y in the order of [`Lu::rows`] after.
    pub(super) fn solve_transposed(&self, x: &mut [T]) {
        for s in 0..self.order {
            let column = &self.entries[s * self.order..];
            let inner = dot(&column[..s], &x[..s]);
            x[s] -= inner;
            x[s] /= column[s].clone();
        }
        for s in (0..self.order).rev() {
            let inner = dot(
                &self.entries[s * self.order + s + 1..(s + 1) * self.order],
                &x[s + 1..],
            );
            x[s] -= inner;
        }
    }
}

/// y -= factor x.
pub(super) fn subtract<T: Number>(y: &mut [T], factor: &T, x: &[T]) {
    if !factor.is_zero() {
        y.iter_mut()
            .zip(x)
            .for_each(|(y, x)| *y -= factor.clone() * x.clone());
    }
}

/// x'y.
pub(super) fn dot<T: Number>(x: &[T], y: &[T]) -> T {
    x.iter()
        .zip(y)
        .fold(T::zero(), |sum, (x, y)| sum + x.clone() * y.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, dmatrix, dvector};

    fn factored(a: &DMatrix<f64>) -> (Lu<f64>, bool) {
        let mut lu = Lu::default();
        let column = |j: usize, rows: &[usize], out: &mut [f64]| {
            rows.iter().zip(out).for_each(|(&i, o)| *o = a[(i, j)])
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
        lu.rows().iter().zip(&y).for_each(|(&i, v)| by_row[i] = *v);
        assert!((a.transpose() * by_row - &b).amax() < 1e-14);
    }

    #[test]
    fn dependent_columns_are_named_with_the_rows_left() {
        assert!(factored(&DMatrix::zeros(0, 0)).1);
        assert!(factored(&dmatrix![0.0, 2.0; 3.0, 0.0]).1);
        let (lu, regular) = factored(&dmatrix![1.0, 0.0, 1.0; 2.0, 1.0, 2.0; 0.0, 0.0, 0.0]);
        assert_eq!((regular, lu.dependent()), (false, (&[2][..], &[2][..])));
        let (lu, _) = factored(&dmatrix![1.0, 1.0, 0.0; 2.0, 2.0, 0.0; 0.0, 0.0, 5.0]);
        assert_eq!(lu.dependent(), (&[1][..], &[0][..]));
        assert!(!factored(&dmatrix![f64::NAN]).1);
        assert_eq!(
            factored(&DMatrix::zeros(2, 2)).0.dependent(),
            (&[0, 1][..], &[0, 1][..])
        );
    }
}
