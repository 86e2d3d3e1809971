//! Enclosed claims: Newton with exact residuals, then a box and a preconditioner for Krawczyk.

use super::{AttemptFailure, IntegralRows, active};
use crate::candidate::Candidate;
use crate::certificate::EnclosedSolution;
use crate::exact::{Integer, Rational, from_f64, to_f64};
use crate::linear::inverse;
use crate::model::file::Number;
use crate::model::{Pencil, Window};
use crate::tolerance::{BOX_RADIUS_BITS, CENTER_BITS, PRECONDITIONER_BITS, PRECONDITIONER_LOSS_BITS, VALUE_RADIUS, X_RADIUS};
use num_traits::{One, Signed, Zero};

/// Newton steps with a fixed inverse: each gains the digits the inverse is good for.
const NEWTON_STEPS: usize = 8;
/// Largest binary exponent of a preconditioner that the checker takes (`spec/formats.md`).
const MAX_EXPONENT: u32 = 1 << 16;
/// Bits of a coefficient that a double takes without any thought of overflow.
const SAFE_BITS: u64 = 500;

/// A box around the candidate in which Krawczyk's test should hold; `check` decides whether it does.
pub(super) fn make(
    pencil: &Pencil,
    rows: &IntegralRows,
    window: &Window,
    support: &[usize],
    candidate: &Candidate,
) -> Result<EnclosedSolution, AttemptFailure> {
    if support.is_empty() {
        return Err(AttemptFailure::ZeroX);
    }
    let newton = Newton { rows, active: active(pencil, support), support };
    let start = newton.start(candidate)?;
    let jacobian = newton.jacobian(&start);
    let y = equilibrated_inverse(&jacobian, &start).ok_or(AttemptFailure::SingularJacobian)?;
    let center = newton.polish(start.clone(), &y)?;
    let distance = center.iter().zip(&start).map(|(c, s)| to_f64(&(c - s)).abs()).fold(0.0, f64::max);
    if distance > X_RADIUS.max(VALUE_RADIUS * (1.0 + candidate.value.abs())) {
        return Err(AttemptFailure::TooFar { distance, limit: X_RADIUS });
    }
    let value = &center[center.len() - 1];
    if value < window.min() || window.max().is_some_and(|m| value > m) {
        return Err(AttemptFailure::NoRootNear {
            lo: window.min().to_string(),
            hi: window.max().map_or("infinity".into(), ToString::to_string),
        });
    }
    // The inverse at the polished centre, rounded to short integers.
    let jacobian = newton.jacobian(&center);
    let y = equilibrated_inverse(&jacobian, &center).ok_or(AttemptFailure::SingularJacobian)?;
    let radius = radii(&center);
    let (preconditioner, exponent) = round(&y, &newton.scales(), rounding_bits(&jacobian, &radius));
    if exponent > MAX_EXPONENT {
        return Err(AttemptFailure::TooLarge { limit: MAX_EXPONENT as usize, got: exponent as usize });
    }
    let number = |list: Vec<Rational>| list.into_iter().map(Number).collect();
    let claim = EnclosedSolution { support: support.to_vec(), center: number(center), radius: number(radius), preconditioner, exponent };
    newton.signs(&claim)?;
    Ok(claim)
}

/// The square system of an enclosed solution: active rows of (A + tB) x and e'x_s - 1.
struct Newton<'a> {
    rows: &'a IntegralRows,
    active: Vec<usize>,
    support: &'a [usize],
}

impl Newton<'_> {
    /// The candidate on the active variables with e'x_s = 1, then t.
    fn start(&self, candidate: &Candidate) -> Result<Vec<Rational>, AttemptFailure> {
        let sum: f64 = self.support.iter().map(|&i| candidate.x[i]).sum();
        let x = self.active.iter().map(|&i| candidate.x[i] / sum).chain([candidate.value]);
        x.map(|v| from_f64(v).map_err(|_| AttemptFailure::NotFinite)).collect()
    }

    /// Power of two near the largest coefficient of each row: exact pencils may have rows of
    /// thousands of bits, doubles see them divided by this.
    fn scales(&self) -> Vec<u64> {
        let largest = |i: &usize| self.rows.0[*i].iter().map(|(_, a, b)| a.bits().max(b.bits())).max().unwrap_or(0);
        self.active.iter().map(|i| largest(i).saturating_sub(SAFE_BITS)).chain([0]).collect()
    }

    /// F'(z) in doubles, each row divided by 2^scale.
    fn jacobian(&self, z: &[Rational]) -> Vec<Vec<f64>> {
        let n = z.len();
        let approx: Vec<f64> = z.iter().map(to_f64).collect();
        let scales = self.scales();
        let mut out = vec![vec![0.0; n]; n];
        for (k, &i) in self.active.iter().enumerate() {
            for (j, a, b) in &self.rows.0[i] {
                let Ok(col) = self.active.binary_search(j) else { continue };
                let (a, b) = (double(a, scales[k]), double(b, scales[k]));
                out[k][col] = a + approx[n - 1] * b;
                out[k][n - 1] += b * approx[col];
            }
        }
        for (k, i) in self.active.iter().enumerate() {
            out[n - 1][k] = if self.support.contains(i) { 1.0 } else { 0.0 };
        }
        out
    }

    /// F(z), exactly.
    fn residual(&self, z: &[Rational]) -> Vec<Rational> {
        let t = &z[z.len() - 1];
        let mut out: Vec<Rational> = self.active.iter().map(|&i| self.row(i, z, t)).collect();
        let sum: Rational = self.active.iter().zip(z).filter(|(i, _)| self.support.contains(i)).map(|(_, v)| v).sum();
        out.push(sum - Rational::one());
        out
    }

    fn row(&self, i: usize, z: &[Rational], t: &Rational) -> Rational {
        let mut sum = Rational::zero();
        for (j, a, b) in &self.rows.0[i] {
            if let Ok(k) = self.active.binary_search(j) {
                sum += (Rational::from_integer(a.clone()) + t * Rational::from_integer(b.clone())) * &z[k];
            }
        }
        sum
    }

    /// Newton's method with a fixed approximate inverse and exact residuals, rounded to a grid.
    fn polish(&self, mut z: Vec<Rational>, y: &[Vec<f64>]) -> Result<Vec<Rational>, AttemptFailure> {
        let scale = Rational::from_integer(Integer::one() << CENTER_BITS);
        let row_scales: Vec<Rational> = self.scales().iter().map(|&k| Rational::from_integer(Integer::one() << k)).collect();
        for _ in 0..NEWTON_STEPS {
            let residual: Vec<Rational> = self.residual(&z).iter().zip(&row_scales).map(|(v, s)| v / s).collect();
            let size = residual.iter().map(|v| v.abs()).max().unwrap_or_else(Rational::zero);
            if size.is_zero() {
                break;
            }
            // Scaled to doubles of order one, so that tiny residuals keep their digits.
            let f: Vec<f64> = residual.iter().map(|v| to_f64(&(v / &size))).collect();
            for (z_k, row) in z.iter_mut().zip(y) {
                let step: f64 = row.iter().zip(&f).map(|(a, b)| a * b).sum();
                let step = from_f64(step).map_err(|_| AttemptFailure::SingularJacobian)? * &size;
                *z_k = ((&*z_k - step) * &scale).round() / &scale;
            }
        }
        Ok(z)
    }

    /// A first look at the signs at the centre, so that a wrong support is named as such.
    fn signs(&self, claim: &EnclosedSolution) -> Result<(), AttemptFailure> {
        let z: Vec<Rational> = claim.center.iter().map(|n| n.0.clone()).collect();
        let positive = |k: usize| claim.center[k].0 > claim.radius[k].0;
        if let Some((_, &index)) = self.active.iter().enumerate().find(|(k, i)| self.support.contains(i) && !positive(*k)) {
            return Err(AttemptFailure::XNotPositive { index });
        }
        let t = &z[z.len() - 1];
        match (0..self.rows.0.len()).find(|i| self.active.binary_search(i).is_err() && !self.row(*i, &z, t).is_positive()) {
            Some(index) => Err(AttemptFailure::YNegative { index }),
            None => Ok(()),
        }
    }
}

fn double(v: &Integer, scale: u64) -> f64 {
    to_f64(&Rational::new(v.clone(), Integer::one() << scale))
}

/// Half widths: 2^-40 of the largest component of x, and of the value.
fn radii(center: &[Rational]) -> Vec<Rational> {
    let small = Rational::new(Integer::one(), Integer::one() << BOX_RADIUS_BITS);
    let n = center.len();
    let largest = center[..n - 1].iter().map(|v| v.abs()).max().unwrap_or_else(Rational::one);
    let power = |v: &Rational| {
        let bits = v.numer().bits() as i64 - v.denom().bits() as i64;
        let p = Rational::from_integer(Integer::one() << bits.unsigned_abs());
        if bits < 0 { p.recip() } else { p }
    };
    let value = if center[n - 1].is_zero() { Rational::one() } else { power(&center[n - 1].abs()) };
    let x = power(&largest) * &small;
    let mut radius = vec![x; n - 1];
    radius.push(value * small);
    radius
}

/// The inverse of a Jacobian at z, by way of one whose rows and last column are of order one: rows with
/// cleared denominators and a value like lambda^2 are many powers of ten away from e'x_s and x.
fn equilibrated_inverse(jacobian: &[Vec<f64>], z: &[Rational]) -> Option<Vec<Vec<f64>>> {
    let n = jacobian.len();
    let value = to_f64(&z[n - 1]).abs();
    let column = |j: usize| if j + 1 == n && value > 0.0 { value } else { 1.0 };
    let sizes: Vec<f64> = jacobian.iter().map(|r| r.iter().enumerate().map(|(j, v)| v.abs() * column(j)).fold(0.0, f64::max)).collect();
    let even: Vec<Vec<f64>> =
        jacobian.iter().zip(&sizes).map(|(r, s)| r.iter().enumerate().map(|(j, v)| v * column(j) / s).collect()).collect();
    let mut y = inverse(&even)?;
    for (j, row) in y.iter_mut().enumerate() {
        row.iter_mut().zip(&sizes).for_each(|(v, s)| *v *= column(j) / s);
    }
    y.iter().flatten().all(|v| v.is_finite()).then_some(y)
}

/// Bits after the point of a preconditioner whose rounding takes at most 2^-`PRECONDITIONER_LOSS_BITS` of the
/// narrowest side of the box: n entries of row k, each off by 2^-e, against sum_j |J_ij| r_j.
fn rounding_bits(jacobian: &[Vec<f64>], radius: &[Rational]) -> f64 {
    let r: Vec<f64> = radius.iter().map(to_f64).collect();
    let reach = |row: &Vec<f64>| row.iter().zip(&r).map(|(v, r)| v.abs() * r).sum::<f64>();
    let widest = jacobian.iter().map(reach).fold(0.0, f64::max);
    let narrowest = r.iter().copied().fold(f64::INFINITY, f64::min);
    (jacobian.len() as f64 * widest / narrowest).log2().ceil() + f64::from(PRECONDITIONER_LOSS_BITS)
}

/// The inverse for rows that were divided by 2^scale, in integers of 2^-exponent: the largest entry
/// has about `PRECONDITIONER_BITS` bits, or more where `needed` bits after the point are more.
fn round(y: &[Vec<f64>], scales: &[u64], needed: f64) -> (Vec<Vec<Integer>>, u32) {
    let largest = y.iter().flatten().fold(0.0f64, |m, v| m.max(v.abs()));
    let widest = scales.iter().copied().max().unwrap_or(0);
    let wanted = (PRECONDITIONER_BITS - largest.log2().ceil() as i32).max(needed as i32);
    let exponent = wanted.max(0) as u64 + widest;
    // Finite: `inverse` refuses anything else.
    let integer = |(v, k): (&f64, &u64)| {
        let scale = Rational::from_integer(Integer::one() << (exponent - k));
        from_f64(*v).map(|r| (r * scale).round().to_integer()).unwrap_or_default()
    };
    (y.iter().map(|row| row.iter().zip(scales).map(integer).collect()).collect(), exponent as u32)
}

#[cfg(test)]
mod tests;
