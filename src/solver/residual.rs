//! Residuals, always reported together, each with its definition. None of them certifies.

use crate::mcp::Mcp;

/// Infinity norms at a point z within the bounds, in units of F.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residuals {
    /// Normal map F(pi(zbar)) + zbar - pi(zbar) at the zbar over z with the least residual
    /// (Robinson 1992): |F_i| inside, the wrong-signed part of F_i at a bound.
    pub normal_map: f64,
    /// Minimum map: z - mid(l, u, z - F(z)).
    pub minimum_map: f64,
    /// Fischer-Burmeister function, nested for two bounds (Fischer 1992, Billups 1995).
    pub fischer: f64,
}

impl Residuals {
    /// All residuals of a problem at z with F(z) = f.
    pub fn at<P: Mcp + ?Sized>(problem: &P, z: &[f64], f: &[f64]) -> Residuals {
        let (l, u) = (problem.lower(), problem.upper());
        let each = |g: &dyn Fn(usize) -> f64| (0..z.len()).map(|i| g(i).abs()).fold(0.0, max_or_nan);
        Residuals {
            normal_map: each(&|i| least_normal(z[i], f[i], l[i], u[i])),
            minimum_map: each(&|i| z[i] - (z[i] - f[i]).clamp(l[i], u[i])),
            fischer: each(&|i| fischer(z[i], f[i], l[i], u[i])),
        }
    }
}

/// max that does not lose a NaN.
fn max_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// F_i, with the part that a bound absorbs taken off.
pub(super) fn least_normal(z: f64, f: f64, l: f64, u: f64) -> f64 {
    let f = if z <= l { f.min(0.0) } else { f };
    if z >= u { f.max(0.0) } else { f }
}

/// phi(a, b) = sqrt(a^2 + b^2) - a - b without cancellation: -2ab / (sqrt(a^2 + b^2) + a + b).
fn phi(a: f64, b: f64) -> f64 {
    let norm = a.hypot(b);
    let sum = a + b;
    if sum > 0.0 { -2.0 * (a / (norm + sum)) * b } else { norm - sum }
}

fn fischer(z: f64, f: f64, l: f64, u: f64) -> f64 {
    match (l.is_finite(), u.is_finite()) {
        (false, false) => -f,
        (true, false) => phi(z - l, f),
        (false, true) => -phi(u - z, -f),
        (true, true) => phi(z - l, phi(u - z, -f)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn phi_vanishes_exactly_on_complementary_pairs() {
        assert_eq!((phi(0.0, 3.0), phi(2.0, 0.0)), (0.0, 0.0));
        assert!(phi(1.0, 1.0) < 0.0 && phi(-1.0, 0.0) > 0.0);
        // Cancellation-free: phi(1, e) is -e to first order.
        assert_relative_eq!(phi(1.0, 1e-18), -1e-18, max_relative = 1e-12);
    }

    #[test]
    fn both_bounds_and_free_variables() {
        for (z, f, zero) in
            [(0.0, 1.0, true), (1.0, -1.0, true), (0.5, 0.0, true), (0.0, -1.0, false), (1.0, 1.0, false), (0.5, 0.1, false)]
        {
            assert_eq!(fischer(z, f, 0.0, 1.0).abs() < 1e-15, zero, "{z} {f}");
            assert_eq!(least_normal(z, f, 0.0, 1.0) == 0.0, zero);
        }
        assert_eq!(fischer(7.0, 2.0, f64::NEG_INFINITY, f64::INFINITY), -2.0);
    }
}
