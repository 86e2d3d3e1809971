//! Cholesky factors of sparse symmetric matrices in skyline form, in doubles.

use mceip_check::certificate::Factor;
use mceip_exact::{Sparse, to_f64, truncated};

/// L with L L' = S: row i holds columns first[i] to i.
pub(crate) struct Skyline {
    first: Vec<usize>,
    rows: Vec<Vec<f64>>,
}

impl Skyline {
    /// The symmetric part of a sparse matrix.
    pub(crate) fn symmetric(m: &Sparse) -> Skyline {
        let n = m.rows();
        let mut first: Vec<usize> = (0..n).collect();
        for (i, j, _) in m.entries() {
            let (row, col) = (i.max(j), i.min(j));
            first[row] = first[row].min(col);
        }
        let mut rows: Vec<Vec<f64>> = (0..n).map(|i| vec![0.0; i + 1 - first[i]]).collect();
        for (i, j, v) in m.entries() {
            let (row, col) = (i.max(j), i.min(j));
            rows[row][col - first[row]] += if i == j { to_f64(v) } else { 0.5 * to_f64(v) };
        }
        Skyline { first, rows }
    }

    /// self + factor other + shift I, on the union of both skylines.
    pub(crate) fn combine(&self, factor: f64, other: &Skyline, shift: f64) -> Skyline {
        let n = self.first.len();
        let first: Vec<usize> = (0..n).map(|i| self.first[i].min(other.first[i])).collect();
        let at = |s: &Skyline, i: usize, j: usize| {
            if j >= s.first[i] {
                s.rows[i][j - s.first[i]]
            } else {
                0.0
            }
        };
        let entry = |i: usize, j: usize| {
            at(self, i, j) + factor * at(other, i, j) + if i == j { shift } else { 0.0 }
        };
        let rows = (0..n)
            .map(|i| (first[i]..=i).map(|j| entry(i, j)).collect())
            .collect();
        Skyline { first, rows }
    }

    /// self + shift I.
    pub(crate) fn shifted(&self, shift: f64) -> Skyline {
        let mut out = Skyline {
            first: self.first.clone(),
            rows: self.rows.clone(),
        };
        out.rows
            .iter_mut()
            .for_each(|row| row.last_mut().into_iter().for_each(|d| *d += shift));
        out
    }

    /// Is the matrix a non-negative diagonal (to the checker's eye: no entry beside the diagonal)?
    pub(crate) fn is_diagonal(&self) -> bool {
        self.rows.iter().all(|row| {
            row.iter().rev().skip(1).all(|v| *v == 0.0) && row.last().is_none_or(|d| *d >= 0.0)
        })
    }

    /// Smallest diagonal entry.
    pub(crate) fn smallest_diagonal(&self) -> f64 {
        self.rows
            .iter()
            .filter_map(|r| r.last())
            .fold(f64::INFINITY, |s, v| v.min(s))
    }

    /// Largest diagonal entry.
    pub(crate) fn largest(&self) -> f64 {
        self.rows
            .iter()
            .filter_map(|r| r.last())
            .fold(0.0, |s, v| v.max(s))
    }

    /// The Cholesky factor, `None` where a pivot is not positive.
    pub(crate) fn cholesky(&self) -> Option<Skyline> {
        let mut l: Vec<Vec<f64>> = Vec::with_capacity(self.rows.len());
        for (i, given) in self.rows.iter().enumerate() {
            let first = self.first[i];
            let mut row = given.clone();
            for j in first..=i {
                let start = first.max(self.first[j]);
                let (before, at) = row.split_at_mut(j - first);
                at[0] = if j < i {
                    let other = &l[j];
                    let sum = dot(
                        &before[start - first..],
                        &other[start - self.first[j]..j - self.first[j]],
                    );
                    (at[0] - sum) / other[j - self.first[j]]
                } else {
                    let value = at[0] - dot(before, before);
                    (value > 0.0).then(|| value.sqrt())?
                };
            }
            l.push(row);
        }
        Some(Skyline {
            first: self.first.clone(),
            rows: l,
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
            before[self.first[i]..]
                .iter_mut()
                .zip(row)
                .for_each(|(b, l)| *b -= l * at[0]);
        }
    }

    /// The same for many right-hand sides, [`TOGETHER`] of them in one pass over L.
    pub(crate) fn solve_all(&self, columns: &mut [Vec<f64>]) {
        for group in columns.chunks_mut(TOGETHER) {
            let mut b = vec![[0.0; TOGETHER]; self.rows.len()];
            for (k, column) in group.iter().enumerate() {
                b.iter_mut().zip(column).for_each(|(b, v)| b[k] = *v);
            }
            self.solve_together(&mut b);
            for (k, column) in group.iter_mut().enumerate() {
                column.iter_mut().zip(&b).for_each(|(v, b)| *v = b[k]);
            }
        }
    }

    fn solve_together(&self, b: &mut [[f64; TOGETHER]]) {
        for i in 0..b.len() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);
            let mut sum = [0.0; TOGETHER];
            for (b, l) in before[self.first[i]..].iter().zip(row) {
                (0..TOGETHER).for_each(|k| sum[k] += l * b[k]);
            }
            (0..TOGETHER).for_each(|k| at[0][k] = (at[0][k] - sum[k]) / pivot);
        }
        for i in (0..b.len()).rev() {
            let (before, at) = b.split_at_mut(i);
            let (row, pivot) = self.row(i);
            let value = at[0].map(|v| v / pivot);
            at[0] = value;
            for (b, l) in before[self.first[i]..].iter_mut().zip(row) {
                (0..TOGETHER).for_each(|k| b[k] -= l * value[k]);
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
        // orthogonal to its vector ends at another one: what it says is tried.
        let mut bound = 0.8 * self.cholesky()?.smallest_eigenvalue();
        for _ in 0..BOUND_STEPS {
            if self.shifted(-bound).cholesky().is_some() {
                return Some(bound);
            }
            bound *= 0.25;
        }
        None
    }

    /// An estimate of the smallest eigenvalue of L L', by inverse iteration.
    fn smallest_eigenvalue(&self) -> f64 {
        let n = self.rows.len();
        let mut v: Vec<f64> = (0..n)
            .map(|i| 1.0 + 0.1 * ((i * 7919) % 13) as f64)
            .collect();
        let mut estimate = f64::INFINITY;
        for _ in 0..INVERSE_STEPS {
            let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.iter_mut().for_each(|x| *x /= norm);
            let before = v.clone();
            self.solve(&mut v);
            estimate = 1.0 / before.iter().zip(&v).map(|(a, b)| a * b).sum::<f64>();
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
        let exponent = (lost.log2().ceil() + 2.0).clamp(0.0, 900.0);
        let unit = exponent.exp2();
        let fixed = |v: &f64| truncated((v * unit).round()).unwrap_or_default();
        let rows = self
            .rows
            .iter()
            .map(|row| row.iter().map(fixed).collect())
            .collect();
        Factor {
            first: self.first.clone(),
            rows,
            exponent: exponent as u32,
        }
    }
}

/// Right-hand sides solved for in one pass.
const TOGETHER: usize = 8;

/// a'b in eight partial sums, which the processor forms side by side.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (full_a, full_b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = full_a
        .remainder()
        .iter()
        .zip(full_b.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in full_a.zip(full_b) {
        (0..8).for_each(|k| sums[k] += x[k] * y[k]);
    }
    sums.iter().sum::<f64>() + rest
}

/// Quarterings of a bound that turns out too large.
const BOUND_STEPS: usize = 30;

/// Inverse iterations for the smallest eigenvalue: it is halved afterwards, so two digits suffice.
const INVERSE_STEPS: usize = 30;

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    #[test]
    fn partial_sums_leave_nothing_out() {
        for n in [0usize, 1, 7, 8, 9, 16, 23] {
            let v: Vec<f64> = (1..=n).map(|i| i as f64).collect();
            assert_eq!(dot(&v, &v), (n * (n + 1) * (2 * n + 1) / 6) as f64);
        }
    }

    fn chain(n: usize, d: i64) -> Sparse {
        let off = (1..n).flat_map(|i| [(i, i - 1, whole(-1)), (i - 1, i, whole(-1))]);
        Sparse::from_entries(n, n, (0..n).map(|i| (i, i, whole(d))).chain(off))
    }

    #[test]
    fn factors_solve_and_refuse() {
        let s = Skyline::symmetric(&chain(6, 2));
        let l = s.cholesky().unwrap();
        let mut x: Vec<f64> = vec![1.0, 0.0, 0.0, 0.0, 0.0, 1.0]; // the chain times (1, ..., 1)
        l.solve(&mut x);
        x.iter()
            .for_each(|v| approx::assert_relative_eq!(*v, 1.0, epsilon = 1e-12));
        // Eleven at once: a full group and a part of one; the k-th is k + 1 times the above.
        let scaled = |k: usize| {
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
                .map(|v| v * (k + 1) as f64)
                .to_vec()
        };
        let mut columns: Vec<Vec<f64>> = (0..11).map(scaled).collect();
        l.solve_all(&mut columns);
        for (k, column) in columns.iter().enumerate() {
            column
                .iter()
                .for_each(|v| approx::assert_relative_eq!(*v, (k + 1) as f64, epsilon = 1e-11));
        }
        let exact = 2.0 - 2.0 * (std::f64::consts::PI / 7.0).cos();
        approx::assert_relative_eq!(l.smallest_eigenvalue(), exact, epsilon = 1e-9);
        assert!(
            s.shifted(-1.01 * exact).cholesky().is_none()
                && s.shifted(-0.99 * exact).cholesky().is_some()
        );
        assert!(!s.is_diagonal() && Skyline::symmetric(&Sparse::identity(3)).is_diagonal());
    }
}
