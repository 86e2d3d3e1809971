//! The Fischer-Burmeister function phi(a, b) = sqrt(a^2 + b^2) - a - b, its nested form for two
//! bounds, and the gradient of the merit Psi = |Phi|^2 / 2 (Fischer 1992; Billups 1995).
//!
//! phi(a, b) = 0 exactly if a >= 0, b >= 0 and a b = 0. So Phi_i is zero exactly if z_i and F_i are
//! complementary, and Psi(z) = 0 exactly at the solutions of the MCP. Psi is differentiable, also
//! where Phi is not, which makes it the *merit* by which steps are judged. Called by `evaluation`,
//! `gradient`, `residual` and `crash/semismooth`.

use super::jacobian::JacobianMatrix;
use super::tolerance::SQUARE_SAFE;
use crate::mcp::Mcp;
use nalgebra::DVector;

/// One component Phi_i with an element of its generalised derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fischer {
    /// Phi_i, units of F (where z and F have comparable scales).
    pub(super) value: f64,
    /// d Phi_i / d z_i at fixed F_i.
    pub(super) by_z: f64,
    /// d Phi_i / d F_i.
    pub(super) by_f: f64,
}

/// phi(z - l, F) below, -phi(u - z, -F) above, phi(z - l, phi(u - z, -F)) between, -F if free.
pub(super) fn fischer(z: f64, f: f64, l: f64, u: f64) -> Fischer {
    match (l.is_finite(), u.is_finite()) {
        (false, false) => Fischer {
            value: -f,
            by_z: 0.0,
            by_f: -1.0,
        },
        (true, false) => {
            let lower = phi(z - l, f);
            Fischer {
                value: lower.value,
                by_z: lower.by_a,
                by_f: lower.by_b,
            }
        }
        (false, true) => {
            let upper = phi(u - z, -f);
            Fischer {
                value: -upper.value,
                by_z: upper.by_a,
                by_f: upper.by_b,
            }
        }
        (true, true) => {
            let inner = phi(u - z, -f);
            let outer = phi(z - l, inner.value);
            Fischer {
                value: outer.value,
                by_z: outer.by_a - outer.by_b * inner.by_a,
                by_f: -outer.by_b * inner.by_b,
            }
        }
    }
}

/// Psi = |Phi|^2 / 2 at z with F(z) = f; infinite where F is not finite.
pub(super) fn merit<P: Mcp + ?Sized>(problem: &P, z: &DVector<f64>, f: &DVector<f64>) -> f64 {
    let lower = problem.lower();
    let upper = problem.upper();
    let values = (0..z.len()).map(|i| fischer(z[i], f[i], lower[i], upper[i]).value);

    let sum: f64 = values.map(|value| value.powi(2)).sum();
    if sum.is_finite() {
        0.5 * sum
    } else {
        f64::INFINITY
    }
}

/// The vectors that a gradient is computed in, both of length n.
pub(super) struct GradientStorage<'a> {
    /// Takes the gradient.
    pub(super) gradient: &'a mut DVector<f64>,
    /// Takes D_F Phi.
    pub(super) work: &'a mut DVector<f64>,
}

/// Gradient of Psi, D_z Phi + F'(z)' D_F Phi, of which each row is multiplied by Phi_i; into
/// `storage.gradient`.
pub(super) fn gradient<P: Mcp + ?Sized>(
    problem: &P,
    z: &[f64],
    f: &[f64],
    jacobian: &JacobianMatrix,
    storage: &mut GradientStorage<'_>,
) {
    let lower = problem.lower();
    let upper = problem.upper();

    for i in 0..z.len() {
        let phi = fischer(z[i], f[i], lower[i], upper[i]);
        storage.gradient[i] = phi.by_z * phi.value;
        storage.work[i] = phi.by_f * phi.value;
    }

    for (j, entry) in storage.gradient.iter_mut().enumerate() {
        *entry += jacobian.column_times(j, storage.work);
    }
}

/// phi(a, b) with its partial derivatives.
struct Phi {
    value: f64,
    by_a: f64,
    by_b: f64,
}

/// phi and its partial derivatives, without cancellation: -2ab / (sqrt(a^2 + b^2) + a + b) where
/// a + b > 0. At the kink (0, 0) the derivative is the limit along a = b > 0.
fn phi(a: f64, b: f64) -> Phi {
    let norm = length(a, b);
    if norm == 0.0 {
        let kink = std::f64::consts::FRAC_1_SQRT_2 - 1.0;
        return Phi {
            value: 0.0,
            by_a: kink,
            by_b: kink,
        };
    }

    let sum = a + b;
    let value = if sum > 0.0 {
        -2.0 * (a / (norm + sum)) * b
    } else {
        norm - sum
    };

    Phi {
        value,
        by_a: a / norm - 1.0,
        by_b: b / norm - 1.0,
    }
}

/// sqrt(a^2 + b^2); by `hypot`, which is slow, only where a square might overflow or lose digits.
fn length(a: f64, b: f64) -> f64 {
    let square = a * a + b * b;
    if square > SQUARE_SAFE && square < 1.0 / SQUARE_SAFE {
        square.sqrt()
    } else {
        a.hypot(b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn phi_vanishes_exactly_on_complementary_pairs_and_nowhere_else() {
        assert_eq!(phi(0.0, 3.0).value, 0.0);
        assert_eq!(phi(2.0, 0.0).value, 0.0);
        assert!(phi(1.0, 1.0).value < 0.0);
        assert!(phi(-1.0, 0.0).value > 0.0);
        assert!(phi(0.0, -1.0).value > 0.0);

        // Without cancellation: phi(1, e) is -e to first order.
        assert!((phi(1.0, 1e-18).value + 1e-18).abs() < 1e-30);
        assert!(phi(1e300, 1e300).value.is_finite());
    }

    /// Only the distances to the bounds count.
    #[test]
    fn bounds_and_point_may_be_moved_together() {
        let value = |z: f64, l: f64, u: f64| fischer(z, 2.0, l, u).value;
        assert_eq!(value(7.0, 3.0, INF), value(4.0, 0.0, INF));
        assert_eq!(value(7.0, -INF, 9.0), value(-2.0, -INF, 0.0));
        assert_eq!(value(7.0, 3.0, 9.0), value(4.0, 0.0, 6.0));
    }

    #[test]
    fn zero_exactly_at_solutions_for_every_kind_of_bounds() {
        for (z, f, l, u, zero) in [
            (0.0, 1.0, 0.0, 1.0, true),
            (1.0, -1.0, 0.0, 1.0, true),
            (0.5, 0.0, 0.0, 1.0, true),
            (0.0, -1.0, 0.0, 1.0, false),
            (1.0, 1.0, 0.0, 1.0, false),
            (0.5, 0.1, 0.0, 1.0, false),
            (2.0, 5.0, 2.0, 2.0, true),
            (2.0, -5.0, 2.0, 2.0, true),
            (1.0, -2.0, -INF, 1.0, true),
            (1.0, 2.0, -INF, 1.0, false),
            (7.0, 0.0, -INF, INF, true),
        ] {
            assert_eq!(
                fischer(z, f, l, u).value.abs() < 1e-15,
                zero,
                "{z} {f} [{l}, {u}]"
            );
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let h = 1e-6;
        for (l, u) in [(0.0, INF), (-INF, 1.0), (0.0, 1.0), (-INF, INF)] {
            for (z, f) in [(0.3, 0.7), (0.6, -0.4), (0.1, 2.0)] {
                let value = |z: f64, f: f64| fischer(z, f, l, u).value;
                let by_z = (value(z + h, f) - value(z - h, f)) / (2.0 * h);
                let by_f = (value(z, f + h) - value(z, f - h)) / (2.0 * h);

                let exact = fischer(z, f, l, u);
                assert!((exact.by_z - by_z).abs() < 1e-8);
                assert!((exact.by_f - by_f).abs() < 1e-8);
            }
        }
    }

    /// Of Psi by central differences, with bounds of every kind; and at the kink along a = b.
    #[test]
    fn the_gradient_is_that_of_the_merit() {
        use crate::mcp::LinearMcp;
        use nalgebra::dmatrix;
        let m = dmatrix![
            2.0, -1.0, 0.5, 0.0;
            1.0, 3.0, 0.0, 0.25;
            -0.5, 0.75, 1.5, 1.0;
            0.25, 1.0, -1.0, 2.0
        ];
        let p = LinearMcp::new(
            m.clone(),
            vec![-1.0, 0.5, -0.25, 0.75],
            vec![0.0, -INF, -1.0, -INF],
            vec![INF, 2.0, 3.0, INF],
        )
        .unwrap();
        let function = |z: &DVector<f64>| &m * z + DVector::from_column_slice(p.vector());
        let z = DVector::from_column_slice(&[0.75, 0.5, 0.25, -0.5]);

        let mut got = DVector::zeros(4);
        let mut storage = GradientStorage {
            gradient: &mut got,
            work: &mut DVector::zeros(4),
        };
        let f = function(&z);
        gradient(
            &p,
            z.as_slice(),
            f.as_slice(),
            &m.clone().into(),
            &mut storage,
        );

        for i in 0..4 {
            let merit_moved_by = |h: f64| {
                let mut moved = z.clone();
                moved[i] += h;
                merit(&p, &moved, &function(&moved))
            };
            let difference = merit_moved_by(1e-6) - merit_moved_by(-1e-6);
            approx::assert_relative_eq!(
                got[i],
                difference / 2e-6,
                max_relative = 1e-6,
                epsilon = 1e-8
            );
        }

        let kink = phi(0.0, 0.0);
        let derivative = 0.5f64.sqrt() - 1.0;
        assert_eq!(kink.value, 0.0);
        approx::assert_relative_eq!(kink.by_a, derivative, max_relative = 1e-15);
        approx::assert_relative_eq!(kink.by_b, derivative, max_relative = 1e-15);
    }

    /// Squares that overflow or underflow do not spoil a length.
    #[test]
    fn lengths_keep_their_digits_at_every_size() {
        for size in [1e-300, 1e-200, 1e-140, 1.0, 1e140, 1e200, 1e300] {
            approx::assert_relative_eq!(
                length(3.0 * size, -4.0 * size),
                5.0 * size,
                max_relative = 1e-15
            );
        }

        assert_eq!(length(0.0, 0.0), 0.0);

        // Where squares are safe they are taken: hypot rounds some of these otherwise.
        let pairs = (1..200).map(|i| (f64::from(i) / 7.0, f64::from(i * i) / 11.0));
        for (a, b) in pairs {
            assert_eq!(length(a, b), (a * a + b * b).sqrt());
        }
    }
}
