//! Robinson's normal map F(pi(zeta)) + zeta - pi(zeta), pi the projection onto [l, u] (Robinson
//! 1992; book, 3.2), and the linearisation of F.
//!
//! A point of its domain is kept as the pair (z, m) with z = pi(zeta) and m = z - zeta: m = w - v
//! is the multiplier of the bounds, w >= 0 where z = l and v >= 0 where z = u. The map is F(z) - m.
//! The function `least_residual` is used by `residual`, `linearise` by `newton`.

use super::dense::subtract;
use nalgebra::{DMatrix, DVector};

/// One component of the normal map at the point over z with the least residual: F_i inside, the
/// wrong-signed part of F_i at a bound, 0 where both bounds hold.
pub(super) fn least_residual(z: f64, f: f64, l: f64, u: f64) -> f64 {
    let f = if z <= l { f.min(0.0) } else { f };
    if z >= u { f.max(0.0) } else { f }
}

/// Turns F'(z) into that of the linearised problem at z: M = F'(z) + proximal I and q = F(z) - M z,
/// so that M z + q = F(z).
pub(super) fn linearise(
    jacobian: &mut DMatrix<f64>,
    z: &DVector<f64>,
    f: &DVector<f64>,
    proximal: f64,
    q: &mut Vec<f64>,
) {
    let n = z.len();
    if proximal > 0.0 {
        for i in 0..n {
            jacobian[(i, i)] += proximal;
        }
    }

    q.clear();
    q.extend(f.iter());

    for (j, z_j) in z.iter().enumerate() {
        let column = &jacobian.as_slice()[j * n..(j + 1) * n];
        subtract(q, z_j, column);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn the_least_residual_is_what_no_bound_absorbs() {
        for (z, f, expected) in [
            (0.0, 2.0, 0.0),
            (0.0, -2.0, -2.0),
            (1.0, -2.0, 0.0),
            (1.0, 2.0, 2.0),
            (0.5, 2.0, 2.0),
        ] {
            assert_eq!(least_residual(z, f, 0.0, 1.0), expected);
        }

        assert_eq!(least_residual(3.0, 2.0, 3.0, 3.0), 0.0);
        assert_eq!(least_residual(3.0, -2.0, 3.0, 3.0), 0.0);
    }

    #[test]
    fn linearisation_keeps_the_value_whatever_the_proximal_term() {
        let z = dvector![1.0, 2.0];
        let f = dvector![3.0, -4.0];
        let mut m = dmatrix![1.0, 2.0; 3.0, 4.0];
        let mut q = vec![9.0; 5];
        linearise(&mut m, &z, &f, 0.5, &mut q);

        assert_eq!(&m * &z + DVector::from_vec(q), f);
        assert_eq!(m[(0, 0)], 1.5);
    }
}
