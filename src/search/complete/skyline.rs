//! Cholesky factors of sparse symmetric matrices in skyline form, in doubles.

use crate::certificate::Factor;
use crate::exact::{Integer, Sparse, from_f64, to_f64};

/// L with L L' = S: row i holds columns first[i] to i.
pub(super) struct Skyline {
    first: Vec<usize>,
    rows: Vec<Vec<f64>>,
}

impl Skyline {
    /// The symmetric part of a sparse matrix.
    pub(super) fn symmetric(m: &Sparse) -> Skyline {
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
    pub(super) fn combine(&self, factor: f64, other: &Skyline, shift: f64) -> Skyline {
        let n = self.first.len();
        let first: Vec<usize> = (0..n).map(|i| self.first[i].min(other.first[i])).collect();
        let at = |s: &Skyline, i: usize, j: usize| if j >= s.first[i] { s.rows[i][j - s.first[i]] } else { 0.0 };
        let entry = |i: usize, j: usize| at(self, i, j) + factor * at(other, i, j) + if i == j { shift } else { 0.0 };
        let rows = (0..n).map(|i| (first[i]..=i).map(|j| entry(i, j)).collect()).collect();
        Skyline { first, rows }
    }

    /// self + shift I.
    pub(super) fn shifted(&self, shift: f64) -> Skyline {
        let mut out = Skyline { first: self.first.clone(), rows: self.rows.clone() };
        out.rows.iter_mut().for_each(|row| row.last_mut().into_iter().for_each(|d| *d += shift));
        out
    }

    /// Is the matrix a non-negative diagonal (to the checker's eye: no entry beside the diagonal)?
    pub(super) fn is_diagonal(&self) -> bool {
        self.rows.iter().all(|row| row.iter().rev().skip(1).all(|v| *v == 0.0) && row.last().is_none_or(|d| *d >= 0.0))
    }

    /// Smallest diagonal entry.
    pub(super) fn smallest_diagonal(&self) -> f64 {
        self.rows.iter().filter_map(|r| r.last()).fold(f64::INFINITY, |s, v| v.min(s))
    }

    /// Largest diagonal entry.
    pub(super) fn largest(&self) -> f64 {
        self.rows.iter().filter_map(|r| r.last()).fold(0.0, |s, v| v.max(s))
    }

    /// The Cholesky factor, `None` where a pivot is not positive.
    pub(super) fn cholesky(&self) -> Option<Skyline> {
        let mut l: Vec<Vec<f64>> = Vec::with_capacity(self.rows.len());
        for (i, given) in self.rows.iter().enumerate() {
            let first = self.first[i];
            let mut row = given.clone();
            for j in first..=i {
                let start = first.max(self.first[j]);
                let other: &[f64] = if j < i { &l[j] } else { &[] };
                let sum: f64 = if j < i {
                    (start..j).map(|k| row[k - first] * other[k - self.first[j]]).sum()
                } else {
                    (first..i).map(|k| row[k - first] * row[k - first]).sum()
                };
                let value = row[j - first] - sum;
                row[j - first] = if j < i { value / other[j - self.first[j]] } else { (value > 0.0).then(|| value.sqrt())? };
            }
            l.push(row);
        }
        Some(Skyline { first: self.first.clone(), rows: l })
    }

    /// Solves L L' x = b in place.
    pub(super) fn solve(&self, b: &mut [f64]) {
        for i in 0..b.len() {
            let (first, row) = (self.first[i], &self.rows[i]);
            let sum: f64 = (first..i).map(|k| row[k - first] * b[k]).sum();
            b[i] = (b[i] - sum) / row[i - first];
        }
        for i in (0..b.len()).rev() {
            let (first, row) = (self.first[i], &self.rows[i]);
            b[i] /= row[i - first];
            let value = b[i];
            (first..i).for_each(|k| b[k] -= row[k - first] * value);
        }
    }

    /// A number below the smallest eigenvalue of a definite matrix, about four fifths of it.
    pub(super) fn below_spectrum(&self) -> Option<f64> {
        // The iteration approaches the eigenvalue from above, and a start that happens to be orthogonal to
        // its vector ends at another one: what it says is tried.
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
        let mut v: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * ((i * 7919) % 13) as f64).collect();
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
    pub(super) fn rounded(&self, slack: f64) -> Factor {
        let width = self.rows.iter().map(Vec::len).max().unwrap_or(1) as f64;
        let largest = self.rows.iter().flatten().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        // A row of L L' changes by at most width^2 largest 2^-e, its row sum has at most n entries.
        let lost = width * width * largest / slack;
        let exponent = (lost.log2().ceil() + 2.0).clamp(0.0, 900.0);
        let unit = exponent.exp2();
        let fixed = |v: &f64| from_f64((v * unit).round()).map_or_else(|_| Integer::default(), |v| v.to_integer());
        let rows = self.rows.iter().map(|row| row.iter().map(fixed).collect()).collect();
        Factor { first: self.first.clone(), rows, exponent: exponent as u32 }
    }
}

/// Quarterings of a bound that turns out too large.
const BOUND_STEPS: usize = 30;

/// Inverse iterations for the smallest eigenvalue: it is halved afterwards, so two digits suffice.
const INVERSE_STEPS: usize = 30;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::whole;

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
        x.iter().for_each(|v| approx::assert_relative_eq!(*v, 1.0, epsilon = 1e-12));
        let exact = 2.0 - 2.0 * (std::f64::consts::PI / 7.0).cos();
        approx::assert_relative_eq!(l.smallest_eigenvalue(), exact, epsilon = 1e-9);
        assert!(s.shifted(-1.01 * exact).cholesky().is_none() && s.shifted(-0.99 * exact).cholesky().is_some());
        assert!(!s.is_diagonal() && Skyline::symmetric(&Sparse::identity(3)).is_diagonal());
    }
}
