//! Preconditioner and radii of a Krawczyk box, proposed in doubles.
//!
//! The box c +- r passes if, in every component,
//!   |Y F(c)| + |I - Y F'(c)| r + |Y| d < r,   d_i = 2 r_t sum_j |B_ij| r_j
//! (`check::enclosed`). Radii are counted in units of the point's grid: rho_k = r_k / unit_k. They
//! grow from |Y F(c)| until the inequality holds, each a power of two of its own, so that their
//! numbers are short.

use super::super::failure::AttemptFailure;
use super::newton::{Newton, Point, Slope};
use crate::tolerance::{
    KRAWCZYK_MARGIN, KRAWCZYK_NOISE, PRECONDITIONER_BITS, PRECONDITIONER_LOSS_BITS,
};
use mceip_exact::{Integer, Rational, from_f64};
use num_traits::One;

/// Largest binary exponent of a preconditioner that the checker takes
/// (`spec/certificates.md`, 5.5).
const MAX_EXPONENT: u32 = 1 << 16;
/// Rounds in which the radii grow. Each gains the factor by which |I - YF'| is below one.
const GROWTH_ROUNDS: usize = 60;
/// Largest radius in units of the grid: beyond it the inverse is no inverse.
const LARGEST_RADIUS: f64 = 1e9;

/// The parts of Krawczyk's inequality that do not change when the grid becomes finer.
pub(super) struct Krawczyk {
    preconditioner: Vec<Vec<Integer>>,
    exponent: u32,
    /// The preconditioner in doubles, for rows of F that are divided by their powers of two.
    y: Vec<Vec<f64>>,
    /// |I - Y F'(c)| with what doubles do not see of it, from radii to radii in units of the grid.
    error: Vec<Vec<f64>>,
    /// |B| row by row.
    b: Vec<Vec<(usize, f64)>>,
}

impl Krawczyk {
    /// Rounds the inverse at a point to a preconditioner.
    ///
    /// # Errors
    /// A preconditioner with more bits than the checker takes.
    pub(super) fn new(
        newton: &Newton<'_>,
        point: &Point,
        inverse: &[Vec<f64>],
    ) -> Result<Krawczyk, AttemptFailure> {
        let jacobian = newton.jacobian(point);
        let units = units(point);
        let exponent = exponent(inverse, &newton.scales, rounding_bits(&jacobian, &units));
        if exponent > MAX_EXPONENT {
            return Err(AttemptFailure::TooLarge {
                limit: MAX_EXPONENT as usize,
                got: exponent as usize,
            });
        }
        let preconditioner = round(inverse, &newton.scales, exponent);

        let y = rounded(&preconditioner, &newton.scales, exponent);
        let error = contraction(&y, &jacobian, &units);
        Ok(Krawczyk {
            preconditioner,
            exponent,
            y,
            error,
            b: newton.moduli_of_b(),
        })
    }

    /// Radii in units of the grid, powers of two, for which the inequality holds with a margin;
    /// `None` where there are none.
    pub(super) fn radii(&self, newton: &Newton<'_>, point: &Point) -> Option<Vec<Integer>> {
        let distance = self.distances(newton, point);
        let mut radius: Vec<f64> = distance
            .iter()
            .map(|d| power_above(2.0 * d + 1.0))
            .collect();

        for _ in 0..GROWTH_ROUNDS {
            let bound = self.bound(point, &distance, &radius);
            let is_short = |(r, b): (&f64, &f64)| *b <= KRAWCZYK_MARGIN * r;
            if radius.iter().zip(&bound).all(is_short) {
                return radius
                    .iter()
                    .map(|r| from_f64(*r).ok().map(|v| v.to_integer()))
                    .collect();
            }

            for (r, b) in radius.iter_mut().zip(&bound) {
                *r = r.max(power_above(b / KRAWCZYK_MARGIN));
            }
            if radius.iter().any(|r| r.is_nan() || *r > LARGEST_RADIUS) {
                return None;
            }
        }
        None
    }

    /// |Y F(c)| in units of the grid, with what the sums in doubles may be off.
    fn distances(&self, newton: &Newton<'_>, point: &Point) -> Vec<f64> {
        let residual = newton.scaled_residual(point);
        let mut distances = Vec::new();
        for (k, y) in self.y.iter().enumerate() {
            let product: f64 = y.iter().zip(&residual.f).map(|(y, f)| y * f).sum();
            let size: f64 = y.iter().zip(&residual.f).map(|(y, f)| (y * f).abs()).sum();
            let units = power(residual.exponent + point.bits(k) as i64);
            distances.push((product.abs() + KRAWCZYK_NOISE * size) * units);
        }
        distances
    }

    /// The left side of the inequality in units of the grid.
    fn bound(&self, point: &Point, distance: &[f64], radius: &[f64]) -> Vec<f64> {
        let last = radius.len() - 1;
        // d in units of the grids of x and t: 2 rho_t sum_j |B_ij| rho_j.
        let bends: Vec<f64> = self
            .b
            .iter()
            .map(|row| {
                row.iter()
                    .map(|(j, b)| 2.0 * radius[last] * b * radius[*j])
                    .sum()
            })
            .collect();

        let mut bound = Vec::new();
        for k in 0..=last {
            let linear: f64 = self.error[k].iter().zip(radius).map(|(e, r)| e * r).sum();
            let other_bits = if k < last { point.t_bits } else { point.x_bits };
            let bend: f64 = self.y[k].iter().zip(&bends).map(|(y, d)| y.abs() * d).sum();
            bound.push(distance[k] + linear + bend * power(-(other_bits as i64)));
        }
        bound
    }

    pub(super) fn into_preconditioner(self) -> (Vec<Vec<Integer>>, u32) {
        (self.preconditioner, self.exponent)
    }
}

/// |I - Y J| and the rounding of its sums, taken from units of the grid to units of the grid.
fn contraction(y: &[Vec<f64>], jacobian: &[Vec<Slope>], units: &[f64]) -> Vec<Vec<f64>> {
    let n = y.len();
    let mut error = Vec::new();
    for (i, row) in y.iter().enumerate() {
        let (mut product, mut size) = (vec![0.0; n], vec![0.0; n]);
        product[i] = -1.0;
        for (y_k, slopes) in row.iter().zip(jacobian) {
            for slope in slopes {
                product[slope.column] += y_k * slope.value;
                size[slope.column] += (y_k * slope.size).abs();
            }
        }

        let entry = |j: usize| (product[j].abs() + KRAWCZYK_NOISE * size[j]) * units[j] / units[i];
        error.push((0..n).map(entry).collect());
    }
    error
}

/// The unit of each component's grid, all divided by the first.
fn units(point: &Point) -> Vec<f64> {
    let of_t = power(point.x_bits as i64 - point.t_bits as i64);
    let mut units = vec![1.0; point.x.len()];
    units.push(of_t);
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
    let reach = |row: &Vec<Slope>| {
        row.iter()
            .map(|s| s.value.abs() * radius[s.column])
            .sum::<f64>()
    };
    let widest = jacobian.iter().map(reach).fold(0.0, f64::max);
    let narrowest = radius.iter().copied().fold(f64::INFINITY, f64::min);
    (jacobian.len() as f64 * widest / narrowest).log2().ceil() + f64::from(PRECONDITIONER_LOSS_BITS)
}

/// Bits after the point of the preconditioner: its largest entry has about [`PRECONDITIONER_BITS`]
/// bits, or more where `needed` bits after the point are more. An infinite need is beyond every
/// limit.
fn exponent(y: &[Vec<f64>], scales: &[u64], needed: f64) -> u32 {
    let largest = y.iter().flatten().fold(0.0f64, |m, v| m.max(v.abs()));
    let widest = scales.iter().copied().max().unwrap_or(0);
    let wanted = (PRECONDITIONER_BITS - largest.log2().ceil() as i32).max(needed as i32);
    let exponent = u64::from(wanted.max(0).unsigned_abs()).saturating_add(widest);
    u32::try_from(exponent).unwrap_or(u32::MAX)
}

/// The inverse for rows that were divided by 2^scale, in integers of 2^-exponent.
fn round(y: &[Vec<f64>], scales: &[u64], exponent: u32) -> Vec<Vec<Integer>> {
    // Finite: `inverse` refuses anything else.
    let integer = |(v, k): (&f64, &u64)| {
        let scale = Rational::from_integer(Integer::one() << (u64::from(exponent) - k));
        from_f64(*v)
            .map(|r| (r * scale).round().to_integer())
            .unwrap_or_default()
    };
    y.iter()
        .map(|row| row.iter().zip(scales).map(integer).collect())
        .collect()
}

/// A rounded preconditioner in doubles, for rows that are divided by 2^scale.
fn rounded(preconditioner: &[Vec<Integer>], scales: &[u64], exponent: u32) -> Vec<Vec<f64>> {
    let double = |(v, k): (&Integer, &u64)| {
        let bits = u64::from(exponent) - k;
        mceip_exact::to_f64(&Rational::new_raw(v.clone(), Integer::one() << bits))
    };
    preconditioner
        .iter()
        .map(|row| row.iter().zip(scales).map(double).collect())
        .collect()
}

#[cfg(test)]
mod tests;
