//! Cholesky factors of sparse symmetric matrices in skyline form, in doubles.
//!
//! Row i of the lower triangle is stored from its first entry that is not zero to the diagonal;
//! the factor L with L L' = S has the same profile. Rounded to integers, L is the certificate's
//! evidence that S is positive (semi)definite (`check::cover::psd`).

use super::matrix::SquareMatrix;
use crate::search::complete::rounding::integer;
use mceip_check::certificate::Factor;
use mceip_exact::{Sparse, to_f64};

/// Columns that are taken together, in one pass over a matrix.
pub(super) const TOGETHER: usize = 8;

/// Partial sums of an inner product.
const LANES: usize = 8;

/// Quarterings of a bound that turns out too large.
const BOUND_STEPS: usize = 30;

/// Inverse iterations for the smallest eigenvalue. A fifth is taken off afterwards, so two digits
/// suffice.
const INVERSE_STEPS: usize = 30;

/// Largest binary exponent of a rounded factor.
const MAX_EXPONENT: f64 = 900.0;

/// A lower triangle: row i holds columns first[i] to i.
pub(crate) struct Skyline {
    first: Vec<usize>,
    rows: Vec<Vec<f64>>,
}

impl Skyline {
    /// The symmetric part of a sparse matrix.
    pub(crate) fn symmetric(m: &Sparse) -> Skyline {
        let mut first: Vec<usize> = (0..m.rows()).collect();
        for (i, j, _) in m.entries() {
            let row = i.max(j);
            let column = i.min(j);
            first[row] = first[row].min(column);
        }

        let mut rows = Vec::with_capacity(m.rows());
        for (i, begin) in first.iter().enumerate() {
            let length = i + 1 - begin;
            rows.push(vec![0.0; length]);
        }

        for (i, j, v) in m.entries() {
            let row = i.max(j);
            let column = i.min(j);
            let share = if i == j { to_f64(v) } else { 0.5 * to_f64(v) };
            rows[row][column - first[row]] += share;
        }

        Skyline { first, rows }
    }

    /// A symmetric matrix given by its rows.
    pub(crate) fn of_rows(rows: SquareMatrix) -> Skyline {
        let first = vec![0; rows.len()];
        let lower = |(i, mut row): (usize, Vec<f64>)| {
            row.truncate(i + 1);
            row
        };

        Skyline {
            first,
            rows: rows.into_iter().enumerate().map(lower).collect(),
        }
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        if j >= self.first[i] {
            self.rows[i][j - self.first[i]]
        } else {
            0.0
        }
    }

    /// self + factor other, on the union of both skylines.
    pub(crate) fn combine(&self, factor: f64, other: &Skyline) -> Skyline {
        let mut first = Vec::with_capacity(self.first.len());
        let mut rows = Vec::with_capacity(self.rows.len());

        for i in 0..self.first.len() {
            let start = self.first[i].min(other.first[i]);
            let row = (start..=i)
                .map(|j| self.entry(i, j) + factor * other.entry(i, j))
                .collect();
            first.push(start);
            rows.push(row);
        }

        Skyline { first, rows }
    }

    /// self + shift I.
    pub(crate) fn shifted(&self, shift: f64) -> Skyline {
        let mut rows = self.rows.clone();
        for diagonal in rows.iter_mut().filter_map(|row| row.last_mut()) {
            *diagonal += shift;
        }

        Skyline {
            first: self.first.clone(),
            rows,
        }
    }

    /// Is the matrix a non-negative diagonal, with no entry beside it that the checker would see?
    pub(crate) fn is_diagonal(&self) -> bool {
        self.rows.iter().all(|row| {
            let mut from_the_diagonal = row.iter().rev();
            let is_nonnegative = from_the_diagonal.next().is_none_or(|d| *d >= 0.0);
            is_nonnegative && from_the_diagonal.all(|v| *v == 0.0)
        })
    }

    fn diagonal(&self) -> impl Iterator<Item = &f64> {
        self.rows.iter().filter_map(|row| row.last())
    }

    pub(crate) fn smallest_diagonal(&self) -> f64 {
        let mut smallest = f64::INFINITY;
        for &entry in self.diagonal() {
            smallest = entry.min(smallest);
        }

        smallest
    }

    pub(crate) fn largest_diagonal(&self) -> f64 {
        let mut largest = 0.0;
        for &entry in self.diagonal() {
            largest = entry.max(largest);
        }

        largest
    }

    /// The Cholesky factor, `None` where a pivot is not positive.
    pub(crate) fn cholesky(&self) -> Option<Skyline> {
        let mut factor: Vec<Vec<f64>> = Vec::with_capacity(self.rows.len());

        for (i, given) in self.rows.iter().enumerate() {
            let first = self.first[i];
            let mut row = given.clone();
            for j in first..i {
                let above = &factor[j];
                let first_above = self.first[j];
                let start = first.max(first_above);

                let sum = dot(
                    &row[start - first..j - first],
                    &above[start - first_above..j - first_above],
                );
                row[j - first] = (row[j - first] - sum) / above[j - first_above];
            }

            let (left, diagonal) = row.split_at_mut(i - first);
            let square = diagonal[0] - dot(left, left);
            if square <= 0.0 || square.is_nan() {
                return None;
            }

            diagonal[0] = square.sqrt();
            factor.push(row);
        }

        Some(Skyline {
            first: self.first.clone(),
            rows: factor,
        })
    }

    /// Solves L L' x = b in place.
    pub(crate) fn solve(&self, b: &mut [f64]) {
        for i in 0..b.len() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);
            at[0] = (at[0] - dot(row, &before[self.first[i]..])) / pivot;
        }

        for i in (0..b.len()).rev() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);
            at[0] /= pivot;
            for (b_j, l) in before[self.first[i]..].iter_mut().zip(row) {
                *b_j -= l * at[0];
            }
        }
    }

    /// The same for many right-hand sides, [`TOGETHER`] of them in one pass over L.
    pub(crate) fn solve_all(&self, columns: &mut [Vec<f64>]) {
        for group in columns.chunks_mut(TOGETHER) {
            let mut b = side_by_side(group, self.rows.len());
            self.solve_together(&mut b);

            for (k, column) in group.iter_mut().enumerate() {
                for (v, row) in column.iter_mut().zip(&b) {
                    *v = row[k];
                }
            }
        }
    }

    fn solve_together(&self, b: &mut [[f64; TOGETHER]]) {
        for i in 0..b.len() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);

            let mut sum = [0.0; TOGETHER];
            for (b_j, l) in before[self.first[i]..].iter().zip(row) {
                for k in 0..TOGETHER {
                    sum[k] += l * b_j[k];
                }
            }

            for k in 0..TOGETHER {
                at[0][k] = (at[0][k] - sum[k]) / pivot;
            }
        }

        for i in (0..b.len()).rev() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);

            let value = at[0].map(|v| v / pivot);
            at[0] = value;
            for (b_j, l) in before[self.first[i]..].iter_mut().zip(row) {
                for k in 0..TOGETHER {
                    b_j[k] -= l * value[k];
                }
            }
        }
    }

    /// A row left of its diagonal, and the diagonal.
    fn row(&self, i: usize) -> (&[f64], f64) {
        let (row, pivot) = self.rows[i].split_at(i - self.first[i]);
        (row, pivot[0])
    }

    /// A number below the smallest eigenvalue of a definite matrix, about four fifths of it.
    pub(crate) fn below_spectrum(&self) -> Option<f64> {
        // The iteration approaches the eigenvalue from above, and a start that happens to be
        // orthogonal to its vector ends at another one. So the estimate is tried.
        let mut bound = 0.8 * self.cholesky()?.smallest_eigenvalue();
        for _ in 0..BOUND_STEPS {
            if self.shifted(-bound).cholesky().is_some() {
                return Some(bound);
            }

            bound *= 0.25;
        }

        None
    }

    /// The factor that proves this matrix positive definite; `None` where it is not.
    pub(crate) fn factor_of_definite(&self) -> Option<Factor> {
        let slack = self.below_spectrum()?;
        let factor = self.shifted(-slack).cholesky()?;
        Some(factor.rounded(slack))
    }

    /// A vector to begin inverse iterations with: any without symmetry will do.
    pub(crate) fn without_symmetry(&self) -> Vec<f64> {
        let mut v = Vec::with_capacity(self.rows.len());
        for i in 0..self.rows.len() {
            let digit = (i * 7919) % 13;
            v.push(1.0 + 0.1 * digit as f64);
        }

        v
    }

    /// An estimate of the smallest eigenvalue of L L', by inverse iteration.
    fn smallest_eigenvalue(&self) -> f64 {
        let mut v = self.without_symmetry();
        let mut estimate = f64::INFINITY;

        for _ in 0..INVERSE_STEPS {
            let square: f64 = v.iter().map(|x| x * x).sum();
            let norm = square.sqrt();
            v.iter_mut().for_each(|x| *x /= norm);

            let before = v.clone();
            self.solve(&mut v);
            let product: f64 = before.iter().zip(&v).map(|(a, b)| a * b).sum();
            estimate = 1.0 / product;
        }

        estimate
    }

    /// The factor rounded so finely that what it loses stays below `slack` in every row sum.
    pub(crate) fn rounded(&self, slack: f64) -> Factor {
        let width = self.rows.iter().map(Vec::len).max().unwrap_or(1) as f64;
        let largest = self
            .rows
            .iter()
            .flatten()
            .fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));

        // A row of L L' changes by at most width^2 largest 2^-e, its row sum has at most n entries.
        let lost = width * width * largest / slack;
        let exponent = (lost.log2().ceil() + 2.0).clamp(0.0, MAX_EXPONENT);
        let unit = exponent.exp2();

        let mut rows = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let integers = row.iter().map(|v| integer(v * unit));
            rows.push(integers.collect());
        }

        Factor {
            first: self.first.clone(),
            rows,
            exponent: exponent as u32,
        }
    }
}

/// Up to [`TOGETHER`] columns of this length by rows, zeros in place of those that are missing.
pub(super) fn side_by_side(columns: &[Vec<f64>], length: usize) -> Vec<[f64; TOGETHER]> {
    let mut rows = vec![[0.0; TOGETHER]; length];
    for (k, column) in columns.iter().enumerate() {
        for (row, v) in rows.iter_mut().zip(column) {
            row[k] = *v;
        }
    }

    rows
}

/// The inner product of a vector, given by its [`nonzero`] entries, and `b`, whose entries are
/// finite. The products are added as [`dot`] adds them, which gives the same number.
pub(super) fn sparse_dot(entries: &[(usize, f64)], b: &[f64]) -> f64 {
    let end_of_groups = b.len() / LANES * LANES;
    let mut rest = 0.0;
    let mut sums = [0.0; LANES];
    for &(j, value) in entries {
        let product = value * b[j];
        if j < end_of_groups {
            sums[j % LANES] += product;
        } else {
            rest += product;
        }
    }

    sums.iter().sum::<f64>() + rest
}

/// The entries of a vector that are not zero: position and value.
pub(super) fn nonzero(vector: &[f64]) -> Vec<(usize, f64)> {
    let entries = vector.iter().copied().enumerate();
    entries.filter(|(_, value)| *value != 0.0).collect()
}

/// a'b in eight partial sums, which the processor forms side by side.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let groups_of_a = a.chunks_exact(LANES);
    let groups_of_b = b.chunks_exact(LANES);
    let rest: f64 = groups_of_a
        .remainder()
        .iter()
        .zip(groups_of_b.remainder())
        .map(|(x, y)| x * y)
        .sum();

    let mut sums = [0.0; LANES];
    for (x, y) in groups_of_a.zip(groups_of_b) {
        for k in 0..LANES {
            sums[k] += x[k] * y[k];
        }
    }

    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    #[test]
    fn zeros_change_no_inner_product() {
        for n in [1, 7, 8, 9, 23, 40] {
            let b: Vec<f64> = (1..=n).map(|i| f64::from(i).sqrt()).collect();
            let a: Vec<f64> = (0..n)
                .map(|i| if i % 3 == 0 { 0.0 } else { f64::from(i).cbrt() })
                .collect();
            assert_eq!(
                sparse_dot(&nonzero(&a), &b).to_bits(),
                dot(&a, &b).to_bits()
            );
        }
    }

    #[test]
    fn partial_sums_leave_nothing_out() {
        for n in [0usize, 1, 7, 8, 9, 16, 23] {
            let v: Vec<f64> = (1..=n).map(|i| i as f64).collect();

            let sum_of_squares = (n * (n + 1) * (2 * n + 1) / 6) as f64;
            assert_eq!(dot(&v, &v), sum_of_squares);
        }
    }

    /// The tridiagonal matrix with `diagonal` on its diagonal and -1 beside it.
    fn chain(n: usize, diagonal: i64) -> Sparse {
        let on = (0..n).map(|i| (i, i, whole(diagonal)));
        let off = (1..n).flat_map(|i| [(i, i - 1, whole(-1)), (i - 1, i, whole(-1))]);
        Sparse::from_entries(n, n, on.chain(off))
    }

    #[test]
    fn factors_solve_and_refuse() {
        let matrix = Skyline::symmetric(&chain(6, 2));
        let factor = matrix.cholesky().unwrap();
        // The chain times (1, ..., 1).
        let ends_only = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0];

        let mut x = ends_only.to_vec();
        factor.solve(&mut x);
        for v in &x {
            approx::assert_relative_eq!(*v, 1.0, epsilon = 1e-12);
        }

        // Eleven at once: a full group and a part of one; the k-th is k + 1 times the above.
        let mut columns: Vec<Vec<f64>> = (1..=11)
            .map(|k| ends_only.map(|v| v * f64::from(k)).to_vec())
            .collect();
        factor.solve_all(&mut columns);
        for (k, column) in columns.iter().enumerate() {
            for v in column {
                approx::assert_relative_eq!(*v, (k + 1) as f64, epsilon = 1e-11);
            }
        }

        let smallest = 2.0 - 2.0 * (std::f64::consts::PI / 7.0).cos();
        approx::assert_relative_eq!(factor.smallest_eigenvalue(), smallest, epsilon = 1e-9);
        assert!(matrix.shifted(-1.01 * smallest).cholesky().is_none());
        assert!(matrix.shifted(-0.99 * smallest).cholesky().is_some());

        assert!(!matrix.is_diagonal());
        assert!(Skyline::symmetric(&Sparse::identity(3)).is_diagonal());
    }
}
