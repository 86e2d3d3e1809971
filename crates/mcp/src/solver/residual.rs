//! The five residuals, always reported together, each with its definition. None of them certifies.
//!
//! Each is the infinity norm of a vector that is zero at the solutions of the MCP (but for the last
//! one, which is zero there and at other stationary points). A run ends where four of them are
//! within the tolerance ([`Residuals::within`]). Input: bounds, z, F(z) and, for the gradient,
//! F'(z) or products with its transpose.

use super::evaluation::{Evaluated, Point};
use super::fischer::{Fischer, GradientStorage, fischer, gradient};
use super::jacobian::JacobianMatrix;
use super::normal_map::least_residual;
use crate::mcp::Mcp;
use nalgebra::DVector;

/// Infinity norms at a point z in [l, u]. NaN or infinite where F or F' is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residuals {
    /// Products (z_i - l_i) max(F_i, 0) and (u_i - z_i) max(-F_i, 0) over finite bounds, and |F_i|
    /// towards an infinite one. Units of F times z. The only one that sees z run to infinity with
    /// F to zero, as in 0 <= x, 1/x >= 0.
    pub complementarity: f64,
    /// Normal map at the point over z with the least residual: |F_i| inside, the wrong-signed part
    /// of F_i at a bound (Robinson 1992). Units of F.
    pub normal_map: f64,
    /// Minimum map z - mid(l, u, z - F(z)). Units of z or F, whichever is smaller.
    pub minimum_map: f64,
    /// Fischer-Burmeister function, nested for two bounds (Fischer 1992, Billups 1995).
    pub fischer: f64,
    /// Gradient of Psi = |Phi|^2 / 2. Small without `fischer` small: a stationary point of Psi that
    /// solves nothing.
    pub fischer_gradient: f64,
}

/// The residuals of a point that is no point of the problem.
const UNDEFINED: Residuals = Residuals {
    complementarity: f64::NAN,
    normal_map: f64::NAN,
    minimum_map: f64::NAN,
    fischer: f64::NAN,
    fischer_gradient: f64::NAN,
};

impl Residuals {
    /// All five at z, evaluating F and F' once.
    ///
    /// `z` has the problem's dimension; components beyond it are ignored, missing ones are an error
    /// of the caller that is answered with NaN.
    pub fn at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> Residuals {
        let n = problem.dimension();
        let lengths = [z.len(), problem.lower().len(), problem.upper().len()];
        if lengths.iter().any(|&length| length < n) {
            return UNDEFINED;
        }

        let z = &z[..n];
        let mut point = Point {
            z: DVector::from_column_slice(z),
            f: DVector::zeros(n),
            merit: f64::INFINITY,
        };
        problem.function(z, point.f.as_mut_slice());
        let jacobian = Evaluated::new(problem).any_jacobian(&point);

        let mut storage = GradientStorage {
            gradient: &mut DVector::zeros(n),
            work: &mut DVector::zeros(n),
        };

        Residuals::with_gradient(problem, z, point.f.as_slice(), &jacobian, &mut storage)
    }

    /// All five of F and F' as given; the vectors of the storage are of length n.
    pub(super) fn with_gradient<P: Mcp + ?Sized>(
        problem: &P,
        z: &[f64],
        f: &[f64],
        jacobian: &JacobianMatrix,
        storage: &mut GradientStorage<'_>,
    ) -> Residuals {
        gradient(problem, z, f, jacobian, storage);
        Residuals {
            fischer_gradient: norm(storage.gradient.iter().copied()),
            ..Residuals::without_gradient(problem, z, f)
        }
    }

    /// The first four; the gradient is left at zero.
    pub(super) fn without_gradient<P: Mcp + ?Sized>(
        problem: &P,
        z: &[f64],
        f: &[f64],
    ) -> Residuals {
        Residuals::within_bounds(problem.lower(), problem.upper(), z, f)
    }

    /// All five from parts: bounds, z and F(z), all of length n, and the product y -> F'(z)' y,
    /// which writes its second argument.
    pub fn of(
        l: &[f64],
        u: &[f64],
        z: &[f64],
        f: &[f64],
        product: impl Fn(&[f64], &mut [f64]),
    ) -> Residuals {
        let phi: Vec<Fischer> = (0..z.len())
            .map(|i| fischer(z[i], f[i], l[i], u[i]))
            .collect();

        // Gradient of Psi, D_z Phi + F'(z)' D_F Phi, each row times Phi_i.
        let by_f: Vec<f64> = phi.iter().map(|phi| phi.by_f * phi.value).collect();
        let mut gradient = vec![0.0; z.len()];
        product(&by_f, &mut gradient);

        for (entry, phi) in gradient.iter_mut().zip(&phi) {
            *entry += phi.by_z * phi.value;
        }

        Residuals {
            fischer_gradient: norm(gradient.into_iter()),
            ..Residuals::within_bounds(l, u, z, f)
        }
    }

    /// The first four, of bounds as given.
    fn within_bounds(l: &[f64], u: &[f64], z: &[f64], f: &[f64]) -> Residuals {
        let indices = 0..z.len();
        let products = indices.clone().map(|i| product(z[i], f[i], l[i], u[i]));
        let normal_map = indices
            .clone()
            .map(|i| least_residual(z[i], f[i], l[i], u[i]));
        let minimum_map = indices
            .clone()
            .map(|i| z[i] - (z[i] - f[i]).max(l[i]).min(u[i]));
        let phi = indices.map(|i| fischer(z[i], f[i], l[i], u[i]).value);

        Residuals {
            complementarity: norm(products),
            normal_map: norm(normal_map),
            minimum_map: norm(minimum_map),
            fischer: norm(phi),
            fischer_gradient: 0.0,
        }
    }

    /// Normal map, minimum map and Fischer at most `tolerance`, complementarity at most its root.
    pub fn within(&self, tolerance: f64) -> bool {
        // Written so that a NaN is never within.
        self.normal_map <= tolerance
            && self.minimum_map <= tolerance
            && self.fischer <= tolerance
            && self.complementarity <= tolerance.sqrt()
    }
}

/// The complementarity product of one component: |F_i| times the distance to the bound it points
/// to, or |F_i| where there is none.
fn product(z: f64, f: f64, l: f64, u: f64) -> f64 {
    if f.is_nan() {
        return f64::NAN;
    }

    let gap = if f >= 0.0 { z - l } else { u - z };
    if gap.is_finite() {
        gap * f.abs()
    } else {
        f.abs()
    }
}

/// Infinity norm that does not lose a NaN.
fn norm(values: impl Iterator<Item = f64>) -> f64 {
    let mut norm: f64 = 0.0;
    for value in values {
        norm = if norm.is_nan() || value.is_nan() {
            f64::NAN
        } else {
            norm.max(value.abs())
        };
    }
    norm
}

#[cfg(test)]
mod tests {
    use super::super::probe::bounded;
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::{DMatrix, dmatrix};

    struct Reciprocal;

    impl Mcp for Reciprocal {
        fn dimension(&self) -> usize {
            1
        }
        fn lower(&self) -> &[f64] {
            &[0.0]
        }
        fn upper(&self) -> &[f64] {
            &[f64::INFINITY]
        }
        fn function(&self, z: &[f64], f: &mut [f64]) {
            f[0] = 1.0 / z[0];
        }
        fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
            j[(0, 0)] = -1.0 / (z[0] * z[0]);
        }
    }

    #[test]
    fn only_the_products_see_a_solution_at_infinity() {
        let r = Residuals::at(&Reciprocal, &[1e16]);
        assert!(r.minimum_map <= 1e-15);
        assert!(r.normal_map <= 1e-15);
        assert!(r.fischer <= 1e-15);
        assert!((r.complementarity - 1.0).abs() < 1e-12);
        assert!(!r.within(1e-10));
    }

    #[test]
    fn nan_is_never_within() {
        let r = Residuals::at(&Reciprocal, &[0.0]);
        assert!(!r.within(1e300), "{r:?}");
        assert!(Residuals::at(&Reciprocal, &[]).normal_map.is_nan());
    }

    #[test]
    fn all_vanish_at_a_solution_and_differ_elsewhere() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let r = Residuals::at(&lcp, &[4.0 / 3.0, 7.0 / 3.0]);
        assert!(r.within(1e-14));
        assert!(r.fischer_gradient < 1e-13);

        let r = Residuals::at(&lcp, &[0.0, 0.0]);
        assert_eq!(r.normal_map, 6.0);
        assert_eq!(r.minimum_map, 6.0);
        assert_eq!(r.fischer, 12.0);
    }

    /// By hand, one component each: towards both bounds, inside, free, and with |F| where the bound
    /// is infinite.
    #[test]
    fn each_residual_is_its_formula() {
        let inf = f64::INFINITY;

        // z, F, l, u: product, normal map, minimum map.
        let table = [
            (1.0, 2.0, 0.0, 4.0, 2.0, 2.0, 1.0),
            (1.0, -2.0, 0.0, 4.0, 6.0, 2.0, 2.0),
            (1.0, 0.25, 0.0, 4.0, 0.25, 0.25, 0.25),
            (0.0, 3.0, 0.0, 4.0, 0.0, 0.0, 0.0),
            (4.0, -3.0, 0.0, 4.0, 0.0, 0.0, 0.0),
            (0.0, -3.0, 0.0, 4.0, 12.0, 3.0, 3.0),
            (4.0, 3.0, 0.0, 4.0, 12.0, 3.0, 3.0),
            (5.0, -3.0, 0.0, inf, 3.0, 3.0, 3.0),
            (5.0, 3.0, -inf, 6.0, 3.0, 3.0, 3.0),
            (5.0, 3.0, -inf, inf, 3.0, 3.0, 3.0),
        ];

        for (z, f, l, u, product, normal, minimum) in table {
            let r = Residuals::within_bounds(&[l], &[u], &[z], &[f]);
            assert_eq!(r.complementarity, product, "{z} {f} [{l}, {u}]");
            assert_eq!(r.normal_map, normal, "{z} {f} [{l}, {u}]");
            assert_eq!(r.minimum_map, minimum, "{z} {f} [{l}, {u}]");
            assert_eq!(r.fischer, fischer(z, f, l, u).value.abs());
            assert_eq!(r.fischer_gradient, 0.0);
        }

        // The largest of the components, whatever their order.
        let r = Residuals::within_bounds(&[0.0; 3], &[inf; 3], &[1.0, 5.0, 2.0], &[-7.0, 1.0, 0.5]);
        assert_eq!(r.complementarity, 7.0);
        assert_eq!(r.normal_map, 7.0);
        assert_eq!(r.minimum_map, 7.0);
    }

    /// From parts as from the problem, with a gradient that is none of its terms.
    #[test]
    fn parts_give_what_the_problem_gives() {
        let m = dmatrix![2.0, -1.0, 0.5; 1.0, 3.0, 0.25; -0.5, 0.75, 1.5];
        let p = LinearMcp::new(
            m.clone(),
            vec![-1.0, 0.5, -0.25],
            vec![0.0, f64::NEG_INFINITY, -1.0],
            vec![f64::INFINITY, 2.0, 3.0],
        )
        .unwrap();
        let z = [0.75, 0.5, 0.25];
        let at = Residuals::at(&p, &z);
        let mut f = vec![0.0; 3];
        p.function(&z, &mut f);
        let transposed = |y: &[f64], out: &mut [f64]| {
            out.copy_from_slice((m.transpose() * DVector::from_column_slice(y)).as_slice())
        };
        let of = Residuals::of(p.lower(), p.upper(), &z, &f, transposed);

        approx::assert_relative_eq!(
            of.fischer_gradient,
            at.fischer_gradient,
            max_relative = 1e-14
        );
        assert_eq!(
            Residuals {
                fischer_gradient: 0.0,
                ..of
            },
            Residuals {
                fischer_gradient: 0.0,
                ..at
            }
        );
        assert_eq!(
            Residuals::without_gradient(&p, &z, &f),
            Residuals {
                fischer_gradient: 0.0,
                ..at
            }
        );
        assert!(at.fischer_gradient > 0.1);

        // Components beyond are ignored.
        assert_eq!(Residuals::at(&p, &[0.75, 0.5, 0.25, 99.0]), at);
    }

    /// Three residuals at the tolerance, the products at its root; each alone beyond it is too
    /// much.
    #[test]
    fn each_of_four_residuals_must_be_within() {
        let is_within = |normal_map, minimum_map, fischer, complementarity| {
            Residuals {
                complementarity,
                normal_map,
                minimum_map,
                fischer,
                fischer_gradient: f64::INFINITY,
            }
            .within(0.0625)
        };
        let t = 0.0625;
        let more = 0.063;

        assert!(is_within(t, t, t, 0.25));
        assert!(!is_within(more, t, t, 0.25));
        assert!(!is_within(t, more, t, 0.25));
        assert!(!is_within(t, t, more, 0.25));
        assert!(!is_within(t, t, t, 0.26));
        assert!(!is_within(f64::NAN, t, t, t));
        assert!(!is_within(t, f64::NAN, t, t));
        assert!(!is_within(t, t, f64::NAN, t));
        assert!(!is_within(t, t, t, f64::NAN));
    }

    /// Bounds that are shorter than the problem says give NaN, as does a short z; a NaN is not lost
    /// behind a number.
    #[test]
    fn what_is_missing_is_no_number() {
        let is_undefined = |l: &[f64], u: &[f64], z: &[f64]| {
            let p = bounded(l, u, |_, f| f.fill(1.0), |_, j| j.fill(0.0));
            Residuals::at(&Sized2(p), z).normal_map.is_nan()
        };

        assert!(!is_undefined(&[0.0; 2], &[1.0; 2], &[0.5; 2]));
        assert!(is_undefined(&[0.0; 1], &[1.0; 2], &[0.5; 2]));
        assert!(is_undefined(&[0.0; 2], &[1.0; 1], &[0.5; 2]));
        assert!(is_undefined(&[0.0; 2], &[1.0; 2], &[0.5; 1]));
        assert!(
            [[f64::NAN, 1.0], [1.0, f64::NAN]]
                .iter()
                .all(|list| norm(list.iter().copied()).is_nan())
        );
        assert_eq!(norm([1.0, -3.0, 2.0].into_iter()), 3.0);
    }

    /// Says that it has two unknowns, whatever its bounds are.
    struct Sized2<P>(P);

    impl<P: Mcp> Mcp for Sized2<P> {
        fn dimension(&self) -> usize {
            2
        }
        fn lower(&self) -> &[f64] {
            self.0.lower()
        }
        fn upper(&self) -> &[f64] {
            self.0.upper()
        }
        fn function(&self, z: &[f64], f: &mut [f64]) {
            self.0.function(z, f);
        }
        fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
            self.0.jacobian(z, j);
        }
    }
}
