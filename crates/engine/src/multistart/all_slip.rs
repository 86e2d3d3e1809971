//! The all-slip solutions of a condensed pencil in doubles, (17) and (18): positive eigenvectors.
//!
//! (A + mu B) x = 0 with A regular says that 1 / mu is an eigenvalue of -A^-1 B. The QR algorithm
//! gives the eigenvalues; Newton's method from each real positive one gives its x, which is kept
//! where it is positive. Called by the command `block` and by campaigns; nothing is certified here.

use crate::branch::{BranchPencils, BranchUnknown, Slice};
use crate::search::complete::pieces::matrix::{SquareMatrix, combined};
use crate::tolerance::REAL_EIGENVALUE;
use mceip_mcp::linear::{eigenvalues, solve};

/// An all-slip solution in doubles: (A + mu B) x = 0, x > 0, e'x = 1. Not certified.
#[derive(Debug, Clone, PartialEq)]
pub struct AllSlip {
    /// mu > 0.
    pub mu: f64,
    /// x, n_s.
    pub x: Vec<f64>,
    /// Largest entry of (A + mu B) x, relative to the largest sum of moduli it is made of.
    pub residual: f64,
}

/// Every mu > 0 with a strictly positive null vector of A + mu B (n_s x n_s by rows, A regular), by
/// mu. In doubles: an eigenvalue that is hardly real or an x that is hardly positive may be missed.
///
/// ```
/// use mceip_engine::multistart::all_slip;
/// // 1 - mu^2 = 0 with x = (1, 1).
/// let found = all_slip(&[vec![1.0, 0.0], vec![0.0, 1.0]], &[vec![0.0, -1.0], vec![-1.0, 0.0]]);
/// assert_eq!(found.len(), 1);
/// assert!((found[0].mu - 1.0).abs() < 1e-14 && (found[0].x[0] - 0.5).abs() < 1e-14);
/// ```
pub fn all_slip(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<AllSlip> {
    let Some(values) = reciprocal_values(a, b) else {
        return Vec::new();
    };
    let mut largest: f64 = 0.0;
    for (re, im) in &values {
        largest = largest.max(re.hypot(*im));
    }

    let pencil = DensePencil { a, b };
    let mut found = Vec::new();
    for (re, im) in values {
        let is_positive = re > REAL_EIGENVALUE * largest;
        let is_real = im.abs() <= REAL_EIGENVALUE * largest;
        if is_positive && is_real {
            found.extend(pencil.polished(1.0 / re));
        }
    }

    found.sort_by(|p, q| p.mu.total_cmp(&q.mu));
    found.dedup_by(|p, q| (p.mu - q.mu).abs() <= REAL_EIGENVALUE * q.mu);
    found
}

/// The eigenvalues 1 / mu of -A^-1 B (real and imaginary parts); `None` where A is singular.
fn reciprocal_values(a: &[Vec<f64>], b: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let mut columns = Vec::new();
    for j in 0..a.len() {
        let column: Vec<f64> = b.iter().map(|row| -row[j]).collect();
        columns.push(column);
    }

    // The columns of -A^-1 B are the rows of its transpose, which has the same eigenvalues.
    let transposed = solve(a, &columns)?;
    eigenvalues(&transposed)
}

/// A + mu B, by rows.
struct DensePencil<'a> {
    a: &'a [Vec<f64>],
    b: &'a [Vec<f64>],
}

/// It does not depend on t.
impl BranchPencils for DensePencil<'_> {
    type Slice<'s>
        = &'s Self
    where
        Self: 's;

    fn at(&self, _t: f64) -> Option<&Self> {
        Some(self)
    }

    fn unit(&self) -> f64 {
        1.0
    }
}

impl Slice for &DensePencil<'_> {
    fn matrix(&self, mu: f64) -> SquareMatrix {
        combined(self.a, mu, self.b)
    }

    fn of_mu(&self) -> &[Vec<f64>] {
        self.b
    }

    fn of_t(&self, _mu: f64, x: &[f64]) -> Vec<f64> {
        vec![0.0; x.len()]
    }
}

impl DensePencil<'_> {
    /// The solution near an eigenvalue, from the even vector: the first step of Newton's method is
    /// one of inverse iteration. `None` where it does not end near `start` with x > 0.
    fn polished(&self, start: f64) -> Option<AllSlip> {
        let order = self.a.len();
        let every_variable: Vec<usize> = (0..order).collect();
        let even = vec![1.0; order];
        let found = self.solved(
            BranchUnknown::Friction,
            [0.0, start],
            &even,
            &every_variable,
        )?;

        let residual = self.residual(found.mu, &found.x);
        let is_solution = residual < REAL_EIGENVALUE;
        let is_near = (found.mu - start).abs() < 1e3 * REAL_EIGENVALUE * start;
        let is_positive = found.x.iter().all(|v| *v > 0.0);
        (is_solution && is_near && is_positive).then_some(AllSlip {
            mu: found.mu,
            x: found.x,
            residual,
        })
    }

    /// The largest entry of (A + mu B) x, relative to the largest sum of moduli it is made of.
    fn residual(&self, mu: f64, x: &[f64]) -> f64 {
        let mut entries: Vec<f64> = Vec::new();
        let mut largest_size = f64::MIN_POSITIVE;
        for (a_row, b_row) in self.a.iter().zip(self.b) {
            let mut entry = 0.0;
            let mut size = 0.0;
            for ((a, b), x) in a_row.iter().zip(b_row).zip(x) {
                entry += (a + mu * b) * x;
                size += (a * x).abs() + (mu * b * x).abs();
            }
            entries.push(entry);
            largest_size = largest_size.max(size);
        }

        let mut residual: f64 = 0.0;
        for entry in entries {
            residual = residual.max(entry.abs() / largest_size);
        }

        residual
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(order: usize) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; order]; order];
        for (i, row) in rows.iter_mut().enumerate() {
            row[i] = 1.0;
        }

        rows
    }

    /// `weight` times the adjacency matrix of the path graph.
    fn path(order: usize, weight: f64) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; order]; order];
        for i in 1..order {
            rows[i][i - 1] = weight;
            rows[i - 1][i] = weight;
        }

        rows
    }

    /// The path graph with k nodes: I - mu adjacency / 2 has its Perron vector at mu = 1 / cos(pi /
    /// (k + 1)).
    #[test]
    fn the_perron_vector_of_a_path() {
        let found = all_slip(&identity(12), &path(12, -0.5));

        assert_eq!(found.len(), 1, "other eigenvectors change sign");
        let expected = 1.0 / (std::f64::consts::PI / 13.0).cos();
        approx::assert_relative_eq!(found[0].mu, expected, epsilon = 1e-14);
        assert!(found[0].residual < 1e-15);

        // With the other sign only -mu solves, and a rotation has no real eigenvalue.
        assert!(all_slip(&identity(12), &path(12, 0.5)).is_empty());
        let rotation = [vec![0.0, 1.0], vec![-1.0, 0.0]];
        assert!(all_slip(&identity(2), &rotation).is_empty());

        let singular = [vec![0.0]];
        assert!(all_slip(&singular, &[vec![1.0]]).is_empty());
    }
}
