//! The all-slip solutions of a condensed pencil in doubles: positive eigenvectors, by the QR
//! algorithm.

use crate::tolerance::REAL_EIGENVALUE;
use mceip_mcp::linear::{eigenvalues, solve};

/// Newton steps from an eigenvalue of the QR algorithm and the even vector.
const STEPS: usize = 30;

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
    let n = a.len();
    let columns: Vec<Vec<f64>> = (0..n)
        .map(|j| b.iter().map(|row| -row[j]).collect())
        .collect();
    // Columns of -A^-1 B are rows of its transpose, which has the same eigenvalues 1 / mu.
    let Some(values) = solve(a, &columns).as_deref().and_then(eigenvalues) else {
        return Vec::new();
    };
    let size = values
        .iter()
        .map(|(re, im)| re.hypot(*im))
        .fold(0.0, f64::max);
    let real =
        |v: &&(f64, f64)| v.0 > REAL_EIGENVALUE * size && v.1.abs() <= REAL_EIGENVALUE * size;
    let mut found: Vec<AllSlip> = values
        .iter()
        .filter(real)
        .filter_map(|v| polish(a, b, 1.0 / v.0))
        .collect();
    found.sort_by(|p, q| p.mu.total_cmp(&q.mu));
    found.dedup_by(|p, q| (p.mu - q.mu).abs() <= REAL_EIGENVALUE * q.mu);
    found
}

/// Newton's method for (A + mu B) x = 0, e'x = 1, from the even vector: its first step is one of
/// inverse iteration.
fn polish(a: &[Vec<f64>], b: &[Vec<f64>], mut mu: f64) -> Option<AllSlip> {
    let n = a.len();
    let start = mu;
    let times = |m: &[Vec<f64>], x: &[f64]| {
        m.iter()
            .map(|r| r.iter().zip(x).map(|(m, x)| m * x).sum::<f64>())
            .collect::<Vec<f64>>()
    };
    let mut x = vec![1.0 / n as f64; n];
    let mut best: Option<AllSlip> = None;
    for _ in 0..STEPS {
        let (ax, bx) = (times(a, &x), times(b, &x));
        let mut rows: Vec<Vec<f64>> = (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| a[i][j] + mu * b[i][j])
                    .chain([bx[i]])
                    .collect()
            })
            .collect();
        rows.push((0..=n).map(|j| f64::from(u8::from(j < n))).collect());
        let right: Vec<f64> = ax
            .iter()
            .zip(&bx)
            .map(|(a, b)| -(a + mu * b))
            .chain([1.0 - x.iter().sum::<f64>()])
            .collect();
        let step = solve(&rows, &[right])?.pop()?;
        x.iter_mut().zip(&step).for_each(|(x, d)| *x += d);
        mu += step[n];
        let residual = residual(a, b, mu, &x);
        // Steps go on while they help: the last digits are worth one or two more.
        match &best {
            Some(b) if b.residual <= residual && b.residual < REAL_EIGENVALUE => break,
            _ => {
                best = Some(AllSlip {
                    mu,
                    x: x.clone(),
                    residual,
                })
            }
        }
    }
    best.filter(|s| {
        s.residual < REAL_EIGENVALUE
            && (s.mu - start).abs() < 1e3 * REAL_EIGENVALUE * start
            && s.x.iter().all(|v| *v > 0.0)
    })
}

fn residual(a: &[Vec<f64>], b: &[Vec<f64>], mu: f64, x: &[f64]) -> f64 {
    let row = |(a, b): (&Vec<f64>, &Vec<f64>)| {
        let terms = a
            .iter()
            .zip(b)
            .zip(x)
            .map(|((a, b), x)| ((a + mu * b) * x, (a * x).abs() + (mu * b * x).abs()));
        terms.fold((0.0, 0.0), |s: (f64, f64), t| (s.0 + t.0, s.1 + t.1))
    };
    let rows: Vec<(f64, f64)> = a.iter().zip(b).map(row).collect();
    let largest = rows.iter().map(|r| r.1).fold(f64::MIN_POSITIVE, f64::max);
    rows.iter().map(|r| r.0.abs() / largest).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The path graph with k nodes: I - mu adjacency / 2 has its Perron vector at mu = 1 / cos(pi /
    /// (k + 1)).
    #[test]
    fn the_perron_vector_of_a_path() {
        let k = 12;
        let a: Vec<Vec<f64>> = (0..k)
            .map(|i| (0..k).map(|j| f64::from(u8::from(i == j))).collect())
            .collect();
        let b: Vec<Vec<f64>> = (0..k)
            .map(|i: usize| {
                (0..k)
                    .map(|j| if i.abs_diff(j) == 1 { -0.5 } else { 0.0 })
                    .collect()
            })
            .collect();
        let found = all_slip(&a, &b);
        assert_eq!(found.len(), 1, "other eigenvectors change sign");
        approx::assert_relative_eq!(
            found[0].mu,
            1.0 / (std::f64::consts::PI / 13.0).cos(),
            epsilon = 1e-14
        );
        assert!(found[0].residual < 1e-15);
        // With the other sign only -mu solves, and a rotation has no real eigenvalue.
        let turned: Vec<Vec<f64>> = b
            .iter()
            .map(|r| r.iter().map(|v| v.abs()).collect())
            .collect();
        assert!(all_slip(&a, &turned).is_empty());
        assert!(
            all_slip(
                &[vec![1.0, 0.0], vec![0.0, 1.0]],
                &[vec![0.0, 1.0], vec![-1.0, 0.0]]
            )
            .is_empty()
        );
        assert!(
            all_slip(&[vec![0.0]], &[vec![1.0]]).is_empty(),
            "A singular"
        );
    }
}
