//! Preconditioner and radii of a Krawczyk box, proposed in doubles.
//!
//! The box c +- r passes if, in every component,
//!
//! ```text
//! |Y F(c)| + |I - Y F'(c)| r + |Y| d < r,    d_i = 2 r_t sum_j |B_ij| r_j
//! ```
//!
//! (`check::enclosed`; F as in [`newton`](super::newton)). The preconditioner Y is the inverse of
//! F' in doubles, rounded to integers times a power of two. Radii are counted in units of the
//! point's grid: rho_k = r_k / unit_k. They grow from |Y F(c)| until the inequality holds, each a
//! power of two of its own, so that their numbers are short.
//!
//! Errors of the doubles are covered by [`KRAWCZYK_NOISE`] and [`KRAWCZYK_MARGIN`]; whether the box
//! passes is decided by the checker. Called by `enclose`.

use super::super::failure::AttemptFailure;
use super::newton::{Modulus, Newton, NewtonPoint, Slope, scaled};
use crate::magnitude::in_units;
use crate::tolerance::{
    KRAWCZYK_MARGIN, KRAWCZYK_NOISE, PRECONDITIONER_BITS, PRECONDITIONER_LOSS_BITS,
};
use mceip_exact::{Integer, from_f64};

/// Largest binary exponent of a preconditioner that the checker takes
/// (`spec/certificates.md`, 5.5).
const MAX_EXPONENT: u32 = 1 << 16;
/// Rounds in which the radii grow. Each gains the factor by which |I - YF'| is below one.
const GROWTH_ROUNDS: usize = 60;
/// Largest radius in units of the grid: beyond it the inverse is no inverse.
const LARGEST_RADIUS: f64 = 1e9;

/// The parts of Krawczyk's inequality that do not change when the grid becomes finer.
pub(super) struct GridKrawczyk {
    /// Y in units of 2^-exponent.
    preconditioner: Vec<Vec<Integer>>,
    exponent: u32,
    /// Y in doubles, for rows of F that are divided by their powers of two.
    y: Vec<Vec<f64>>,
    /// |I - Y F'(c)| with the rounding errors of its doubles, from radii to radii in units of the
    /// grid.
    error: Vec<Vec<f64>>,
    /// |B| row by row.
    b: Vec<Vec<Modulus>>,
}

impl GridKrawczyk {
    /// Rounds the inverse at a point to a preconditioner.
    ///
    /// # Errors
    /// A preconditioner with more bits than the checker takes.
    pub(super) fn new(
        newton: &Newton<'_>,
        point: &NewtonPoint,
        inverse: &[Vec<f64>],
    ) -> Result<GridKrawczyk, AttemptFailure> {
        let jacobian = newton.jacobian(point);
        let units = units(point);
        let needed_bits = rounding_bits(&jacobian, &units);
        let exponent = exponent(inverse, &newton.scales, needed_bits);
        if exponent > MAX_EXPONENT {
            return Err(AttemptFailure::TooLarge {
                limit: MAX_EXPONENT as usize,
                got: exponent as usize,
            });
        }

        let preconditioner = round(inverse, &newton.scales, exponent);
        let y = rounded(&preconditioner, &newton.scales, exponent);
        let error = contraction(&y, &jacobian, &units);
        Ok(GridKrawczyk {
            preconditioner,
            exponent,
            y,
            error,
            b: newton.moduli_of_b(),
        })
    }

    /// Radii in units of the grid, powers of two, for which the inequality holds with a margin.
    ///
    /// # Errors
    /// [`AttemptFailure::NotContracting`] where none were found.
    pub(super) fn radii(
        &self,
        newton: &Newton<'_>,
        point: &NewtonPoint,
    ) -> Result<Vec<Integer>, AttemptFailure> {
        let distance = self.distances(newton, point);
        let mut radius = Vec::new();
        for d in &distance {
            radius.push(power_above(2.0 * d + 1.0));
        }

        for _ in 0..GROWTH_ROUNDS {
            let bound = self.bound(point, &distance, &radius);
            let mut pairs = radius.iter().zip(&bound);
            if pairs.all(|(r, b)| *b <= KRAWCZYK_MARGIN * r) {
                return integers(&radius).ok_or(AttemptFailure::NotContracting);
            }

            for (r, b) in radius.iter_mut().zip(&bound) {
                *r = r.max(power_above(b / KRAWCZYK_MARGIN));
            }
            if radius.iter().any(|r| r.is_nan() || *r > LARGEST_RADIUS) {
                break;
            }
        }

        Err(AttemptFailure::NotContracting)
    }

    /// |Y F(c)| in units of the grid, with the rounding errors of its sums.
    fn distances(&self, newton: &Newton<'_>, point: &NewtonPoint) -> Vec<f64> {
        let residual = newton.scaled_residual(point);
        let mut distances = Vec::new();
        for (k, row) in self.y.iter().enumerate() {
            let product = dot(row, &residual.f);
            let noise = KRAWCZYK_NOISE * dot_of_moduli(row, &residual.f);
            let exponent = residual.exponent + point.bits(k) as i64;
            distances.push((product.abs() + noise) * power(exponent));
        }

        distances
    }

    /// The left side of the inequality in units of the grid.
    fn bound(&self, point: &NewtonPoint, distance: &[f64], radius: &[f64]) -> Vec<f64> {
        let last = radius.len() - 1;
        let curvature = self.curvature(radius);

        let mut bound = Vec::new();
        for k in 0..=last {
            let linear = dot(&self.error[k], radius);
            // d is in units of x times units of t: one of the two is the unit of component k.
            let quadratic = dot_of_moduli(&self.y[k], &curvature);
            let other_bits = if k < last { point.t_bits } else { point.x_bits };
            let other_unit = power(-(other_bits as i64));
            bound.push(distance[k] + linear + quadratic * other_unit);
        }

        bound
    }

    /// d_i = 2 rho_t sum_j |B_ij| rho_j, in units of the grid of x times that of t.
    fn curvature(&self, radius: &[f64]) -> Vec<f64> {
        let radius_of_t = radius[radius.len() - 1];
        let mut curvature = Vec::new();
        for row in &self.b {
            let entries = row.iter();
            let terms = entries.map(|b| 2.0 * radius_of_t * b.value * radius[b.column]);
            curvature.push(terms.sum());
        }

        curvature
    }

    /// Y in units of 2^-exponent, and the exponent.
    pub(super) fn into_preconditioner(self) -> (Vec<Vec<Integer>>, u32) {
        (self.preconditioner, self.exponent)
    }
}

/// sum_j a_j b_j.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// sum_j |a_j b_j|.
fn dot_of_moduli(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum()
}

/// Whole numbers in doubles as integers.
fn integers(radius: &[f64]) -> Option<Vec<Integer>> {
    let mut integers = Vec::new();
    for r in radius {
        integers.push(from_f64(*r).ok()?.to_integer());
    }

    Some(integers)
}

/// |I - Y J| and the rounding of its sums, taken from units of the grid to units of the grid.
fn contraction(y: &[Vec<f64>], jacobian: &[Vec<Slope>], units: &[f64]) -> Vec<Vec<f64>> {
    let n = y.len();
    let mut error = Vec::new();
    for (i, y_row) in y.iter().enumerate() {
        // Row i of Y J - I, and the sums of the moduli of its terms.
        let mut product = vec![0.0; n];
        let mut size = vec![0.0; n];
        product[i] = -1.0;
        for (y_ik, slopes) in y_row.iter().zip(jacobian) {
            for slope in slopes {
                product[slope.column] += y_ik * slope.value;
                size[slope.column] += (y_ik * slope.size).abs();
            }
        }

        let mut error_row = Vec::new();
        for j in 0..n {
            let entry = product[j].abs() + KRAWCZYK_NOISE * size[j];
            error_row.push(entry * units[j] / units[i]);
        }
        error.push(error_row);
    }

    error
}

/// The unit of each component's grid, all divided by the first.
fn units(point: &NewtonPoint) -> Vec<f64> {
    let unit_of_t = power(point.x_bits as i64 - point.t_bits as i64);
    let mut units = vec![1.0; point.x.len()];
    units.push(unit_of_t);
    units
}

/// 2^exponent in doubles: zero or infinite beyond their range.
fn power(exponent: i64) -> f64 {
    2f64.powi(exponent.clamp(-2000, 2000) as i32)
}

/// The least power of two, at least 1, that is not below v.
fn power_above(v: f64) -> f64 {
    v.max(1.0).log2().ceil().exp2()
}

/// Bits after the point of a preconditioner whose rounding takes at most
/// 2^-[`PRECONDITIONER_LOSS_BITS`] of the narrowest side of a box with these radii: n entries of a
/// row, each off by 2^-e, against sum_j |J_ij| r_j.
fn rounding_bits(jacobian: &[Vec<Slope>], radius: &[f64]) -> f64 {
    let mut widest: f64 = 0.0;
    for row in jacobian {
        let slopes = row.iter();
        let terms = slopes.map(|slope| slope.value.abs() * radius[slope.column]);
        widest = widest.max(terms.sum());
    }

    let narrowest = radius.iter().copied().fold(f64::INFINITY, f64::min);
    let errors_in_row = jacobian.len() as f64;
    let bits = (errors_in_row * widest / narrowest).log2().ceil();
    bits + f64::from(PRECONDITIONER_LOSS_BITS)
}

/// Bits after the point of the preconditioner: its largest entry has about [`PRECONDITIONER_BITS`]
/// bits, or more where `needed` bits after the point are more. An infinite need is beyond every
/// limit.
fn exponent(y: &[Vec<f64>], scales: &[u64], needed: f64) -> u32 {
    let mut largest: f64 = 0.0;
    for entry in y.iter().flatten() {
        largest = largest.max(entry.abs());
    }

    let bits_before_point = largest.log2().ceil() as i32;
    let wanted = (PRECONDITIONER_BITS - bits_before_point).max(needed as i32);

    let widest_scale = scales.iter().copied().max().unwrap_or(0);
    let wanted = u64::from(wanted.max(0).unsigned_abs());
    let exponent = wanted.saturating_add(widest_scale);
    u32::try_from(exponent).unwrap_or(u32::MAX)
}

/// The inverse for rows that were divided by 2^scale, in integers of 2^-exponent.
fn round(y: &[Vec<f64>], scales: &[u64], exponent: u32) -> Vec<Vec<Integer>> {
    let mut rows = Vec::new();
    for y_row in y {
        let mut row = Vec::new();
        for (entry, scale) in y_row.iter().zip(scales) {
            let bits = u64::from(exponent) - scale;
            // `Newton::inverse` returns finite entries only.
            let exact = from_f64(*entry).unwrap_or_default();
            row.push(in_units(&exact, bits as i64));
        }
        rows.push(row);
    }

    rows
}

/// A rounded preconditioner in doubles, for rows that are divided by 2^scale.
fn rounded(preconditioner: &[Vec<Integer>], scales: &[u64], exponent: u32) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for integers in preconditioner {
        let mut row = Vec::new();
        for (units, scale) in integers.iter().zip(scales) {
            let bits = u64::from(exponent) - scale;
            row.push(scaled(units, bits));
        }
        rows.push(row);
    }

    rows
}

#[cfg(test)]
mod tests;
