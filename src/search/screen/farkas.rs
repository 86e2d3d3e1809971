//! Proofs that a support has no solution for any tau of a piece.
//!
//! Let J be the support, F the free variables, N(tau) = (1 - tau) A + tau s B. A vector w over the
//! rows with w_i <= 0 off F and J proves it if w'N has only positive entries on J and zeros on F: a
//! solution has (N x)_i = 0 on F and J and >= 0 elsewhere, so w'N x <= 0, while x_J >= 0, x_J != 0
//! gives w'N x > 0 (the easy half of Farkas' lemma). w'N is linear in tau: both ends of the piece decide.
//!
//! w comes from an LU factorisation in doubles and is believed only after its products are formed:
//! a computed sum of m products differs from the exact one by at most gamma |w|_1 max(|a| + |b|),
//! gamma = (m + 16) 2^-53 (Higham 2002, section 3.1, with the rounding of entries and of the mean).
//! On F the products come out as small r, not zero; there |x_f|_inf <= beta |x_J|_1 with a proved
//! bound beta of the solution of N_ff x_f = -N_fJ x_J, and |r|_1 beta is subtracted.

use super::bernstein::UNIT;
use super::floats::Floats;

/// Relative size from which components of both signs are used without a look at y, whose way needs
/// a positive e'x_J.
const MIXED: f64 = 1.0 / 1024.0 / 1024.0;

/// Reusable storage for one support after the other.
#[derive(Debug, Default)]
pub(super) struct Prover {
    /// Active variables: free, then the support.
    active: Vec<usize>,
    /// Rows of the other complementarity variables.
    inactive: Vec<usize>,
    /// A and sB on active rows and columns.
    a: Vec<f64>,
    b: Vec<f64>,
    lu: Vec<f64>,
    rows: Vec<usize>,
    cols: Vec<usize>,
    x: Vec<f64>,
    y: Vec<f64>,
    /// Multipliers of the active rows.
    w: Vec<f64>,
    /// Minus the multiplier of the inactive row, where one takes part.
    weight: f64,
    at_a: Vec<f64>,
    at_b: Vec<f64>,
}

impl Prover {
    /// Takes up a support, a set of slip variables.
    pub(super) fn load(&mut self, floats: &Floats, mask: u64) {
        let n = floats.a.len();
        let picked = |k: &usize| mask >> (k - floats.free) & 1 == 1;
        self.active.clear();
        self.active.extend(0..floats.free);
        self.active.extend((floats.free..n).filter(picked));
        self.inactive.clear();
        self.inactive.extend((floats.free..n).filter(|k| !picked(k)));
        for (out, m) in [(&mut self.a, &floats.a), (&mut self.b, &floats.b)] {
            out.clear();
            for &i in &self.active {
                out.extend(self.active.iter().map(|&j| m[i][j]));
            }
        }
    }

    /// Tries to prove that the loaded support has no solution for tau in [low, high].
    pub(super) fn refutes(&mut self, floats: &Floats, low: f64, high: f64) -> bool {
        let m = self.active.len();
        if m == floats.free {
            return false; // no complementarity variable: no sign to contradict
        }
        let tau = 0.5 * (low + high);
        self.factor(tau);
        self.kernel();
        let Some(row) = self.violated(floats, tau) else { return false };
        self.multipliers(floats, tau, row);
        let gamma = (m as f64 + 16.0) * UNIT;
        let size: f64 = self.w.iter().map(|v| v.abs()).sum::<f64>() + self.weight;
        let error = gamma * size * floats.largest + f64::MIN_POSITIVE;
        self.products(floats, row);
        [low, high].into_iter().all(|end| {
            let product = |j: usize| (1.0 - end) * self.at_a[j] + end * self.at_b[j];
            let loss = if floats.free == 0 {
                0.0
            } else {
                let residual: f64 = (0..floats.free).map(|j| product(j).abs() + error).sum();
                residual * self.free_bound(floats, low, high)
            };
            (floats.free..m).all(|j| product(j) - error > loss)
        })
    }

    /// LU with complete pivoting of N(tau) on the active variables.
    fn factor(&mut self, tau: f64) {
        let m = self.active.len();
        self.lu.clear();
        self.lu.extend(self.a.iter().zip(&self.b).map(|(a, b)| (1.0 - tau) * a + tau * b));
        self.rows.clear();
        self.rows.extend(0..m);
        self.cols.clear();
        self.cols.extend(0..m);
        for k in 0..m.saturating_sub(1) {
            let (mut best, mut r, mut c) = (-1.0, k, k);
            for i in k..m {
                for (j, v) in self.lu[i * m + k..(i + 1) * m].iter().enumerate() {
                    if v.abs() > best {
                        (best, r, c) = (v.abs(), i, k + j);
                    }
                }
            }
            self.swap(k, r, c);
            let (above, below) = self.lu.split_at_mut((k + 1) * m);
            let pivot_row = &above[k * m..];
            for row in below.chunks_exact_mut(m) {
                let factor = row[k] / pivot_row[k];
                row[k] = factor;
                row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]).for_each(|(x, p)| *x -= factor * p);
            }
        }
    }

    fn swap(&mut self, k: usize, r: usize, c: usize) {
        let m = self.active.len();
        if r != k {
            self.rows.swap(k, r);
            (0..m).for_each(|j| self.lu.swap(k * m + j, r * m + j));
        }
        if c != k {
            self.cols.swap(k, c);
            (0..m).for_each(|i| self.lu.swap(i * m + k, i * m + c));
        }
    }

    /// The kernel vector if the last pivot is taken for zero.
    fn kernel(&mut self) {
        let m = self.active.len();
        let mut z = vec![0.0; m];
        z[m - 1] = 1.0;
        for i in (0..m - 1).rev() {
            let sum: f64 = (i + 1..m).map(|j| self.lu[i * m + j] * z[j]).sum();
            z[i] = -sum / self.lu[i * m + i];
        }
        self.x.clear();
        self.x.resize(m, 0.0);
        self.cols.iter().zip(&z).for_each(|(&c, &v)| self.x[c] = v);
    }

    /// The condition that the kernel vector misses by most: `Some(None)` signs on the support,
    /// `Some(Some(i))` the sign of y_i. `None`: it looks like a solution. Orients x.
    fn violated(&mut self, floats: &Floats, tau: f64) -> Option<Option<usize>> {
        let slip = &self.x[floats.free..];
        let (low, high) = slip.iter().fold((0.0f64, 0.0f64), |(l, h), &v| (l.min(v), h.max(v)));
        if high < -low {
            self.x.iter_mut().for_each(|v| *v = -*v);
        }
        let (size, against) = (high.max(-low), high.min(-low));
        if against > size * MIXED {
            return Some(None);
        }
        let mut worst = (against, None);
        self.y.clear();
        for (k, &i) in self.inactive.iter().enumerate() {
            let y: f64 = self.active.iter().zip(&self.x).map(|(&j, x)| ((1.0 - tau) * floats.a[i][j] + tau * floats.b[i][j]) * x).sum();
            self.y.push(y);
            if -y > worst.0 {
                worst = (-y, Some(k));
            }
        }
        // Below this the signs of x and y are rounding; a failed proof costs time only.
        (worst.0 > 64.0 * UNIT * size).then_some(worst.1)
    }

    /// Solves N'w = g on the active rows with g > 0 on J, 0 on F and (nearly) orthogonal to x, so
    /// that the equation of the last pivot may be dropped.
    fn multipliers(&mut self, floats: &Floats, tau: f64, row: Option<usize>) {
        let (m, f) = (self.active.len(), floats.free);
        let mut g = vec![0.0; m];
        match row {
            None => {
                let sums = self.x[f..].iter().fold((0.0, 0.0), |(p, n), &v| if v > 0.0 { (p + v, n) } else { (p, n - v) });
                for j in f..m {
                    g[j] = if self.x[j] > 0.0 { 1.0 / sums.0 } else { 1.0 / sums.1 };
                }
            }
            Some(k) => {
                // -N_iJ + w'N_JJ = c > 0, with c e'x_J = -y_i.
                let i = self.inactive[k];
                let c = -self.y[k] / self.x[f..].iter().sum::<f64>();
                for (j, &col) in self.active.iter().enumerate() {
                    let n_ij = (1.0 - tau) * floats.a[i][col] + tau * floats.b[i][col];
                    g[j] = n_ij + if j < f { 0.0 } else { c };
                }
            }
        }
        let mut z = vec![0.0; m];
        for k in 0..m - 1 {
            let sum: f64 = (0..k).map(|i| self.lu[i * m + k] * z[i]).sum();
            z[k] = (g[self.cols[k]] - sum) / self.lu[k * m + k];
        }
        for k in (0..m).rev() {
            let sum: f64 = (k + 1..m).map(|i| self.lu[i * m + k] * z[i]).sum();
            z[k] -= sum;
        }
        let largest = z.iter().fold(f64::from(u8::from(row.is_some())), |x: f64, v| x.max(v.abs()));
        self.w.clear();
        self.w.resize(m, 0.0);
        self.rows.iter().zip(&z).for_each(|(&r, &v)| self.w[r] = v / largest);
        self.weight = if row.is_some() { 1.0 / largest } else { 0.0 };
    }

    /// w'A and s w'B on the active columns; an inactive row enters with a negative weight.
    fn products(&mut self, floats: &Floats, row: Option<usize>) {
        let m = self.active.len();
        let weight = self.weight;
        for (out, own, all) in [(&mut self.at_a, &self.a, &floats.a), (&mut self.at_b, &self.b, &floats.b)] {
            out.clear();
            match row {
                Some(k) => out.extend(self.active.iter().map(|&j| -weight * all[self.inactive[k]][j])),
                None => out.resize(m, 0.0),
            }
            for (&w, row) in self.w.iter().zip(own.chunks_exact(m)) {
                out.iter_mut().zip(row).for_each(|(o, v)| *o += w * v);
            }
        }
    }

    /// beta with |x_f|_inf <= beta |x_J|_1 for every tau in [low, high]; infinite where none is
    /// proved.
    ///
    /// For an approximate inverse R of N_ff with |I - R N_ff|_inf <= theta < 1 on the piece,
    /// |N_ff^-1|_inf <= |R|_inf / (1 - theta) (Higham 2002, section 7.1).
    fn free_bound(&self, floats: &Floats, low: f64, high: f64) -> f64 {
        let (m, f) = (self.active.len(), floats.free);
        let tau = 0.5 * (low + high);
        let entry = |i: usize, j: usize| (1.0 - tau) * self.a[i * m + j] + tau * self.b[i * m + j];
        let Some(inverse) = invert(f, entry) else { return f64::INFINITY };
        let norm = inverse.chunks_exact(f).map(|r| r.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max);
        let mut theta: f64 = 0.0;
        for i in 0..f {
            let row = &inverse[i * f..][..f];
            let sum = (0..f).map(|j| {
                let product: f64 = (0..f).map(|k| row[k] * entry(k, j)).sum();
                (f64::from(u8::from(i == j)) - product).abs()
            });
            theta = theta.max(sum.sum());
        }
        // Entries of N differ from those at tau by at most (|a| + |b|) (high - low), and by rounding.
        let spread = (high - low) + (f as f64 + 16.0) * 4.0 * UNIT;
        theta += norm * f as f64 * floats.largest * spread + f64::MIN_POSITIVE;
        if theta < 0.5 { 2.0 * 1.01 * norm * floats.largest } else { f64::INFINITY }
    }
}

/// Gauss-Jordan with row exchanges, nothing proved.
fn invert(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<f64>> {
    let mut m: Vec<Vec<f64>> =
        (0..n).map(|i| (0..2 * n).map(|j| if j < n { entry(i, j) } else { f64::from(u8::from(j - n == i)) }).collect()).collect();
    for k in 0..n {
        let r = (k..n).max_by(|&p, &q| m[p][k].abs().total_cmp(&m[q][k].abs()))?;
        m.swap(k, r);
        let pivot = m[k].clone();
        if pivot[k] == 0.0 {
            return None;
        }
        for (i, row) in m.iter_mut().enumerate() {
            if i == k {
                row.iter_mut().for_each(|v| *v /= pivot[k]);
            } else {
                let factor = row[k] / pivot[k];
                row.iter_mut().zip(&pivot).for_each(|(v, p)| *v -= factor * p);
            }
        }
    }
    Some(m.into_iter().flat_map(|row| row.into_iter().skip(n)).collect())
}

#[cfg(test)]
mod tests;
