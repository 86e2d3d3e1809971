//! Polyhedral cones over Q(alpha) by the double description method (Motzkin, Raiffa, Thompson and
//! Thrall 1953; adjacency as in Fukuda and Prodon 1996). Every sign is exact.

use super::{Algebraic, Integer, Poly, Sign};
use num_traits::One;

/// A cone as lineality space plus nonnegative combinations of rays; minimal on both sides.
#[derive(Debug, Clone, Default)]
pub struct Generators {
    /// A basis of the largest subspace in the cone.
    pub lineality: Vec<Vec<Poly>>,
    /// The extreme rays modulo that subspace.
    pub rays: Vec<Vec<Poly>>,
}

/// Generators of {z : row . z >= 0 for each of `rows`} in a space of `dimension` dimensions, all
/// numbers being integer polynomials taken at `alpha`.
///
/// ```
/// use mceip_exact::{Algebraic, Poly, cone_generators, rational};
/// let row = |v: [i64; 2]| v.map(|c| Poly::from_ints(&[c])).to_vec();
/// let mut alpha = Algebraic::rational(rational(1, 1));
/// let cone = cone_generators(&[row([1, 0]), row([-1, 1]), row([0, 1])], 2, &mut alpha); // 0 <= z_0 <= z_1
/// assert_eq!((cone.lineality.len(), cone.rays.len()), (0, 2));
/// ```
pub fn cone_generators(rows: &[Vec<Poly>], dimension: usize, alpha: &mut Algebraic) -> Generators {
    let unit = |k: usize| {
        (0..dimension)
            .map(|i| {
                if i == k {
                    Poly::constant(Integer::one())
                } else {
                    Poly::default()
                }
            })
            .collect()
    };
    let mut lineality: Vec<Vec<Poly>> = (0..dimension).map(unit).collect();
    let mut rays: Vec<Ray> = Vec::new();
    for (rows_before, row) in rows.iter().enumerate() {
        match lineality
            .iter()
            .position(|l| alpha.sign_of(&dot(row, l)) != Sign::Zero)
        {
            Some(k) => {
                let direction = lineality.swap_remove(k);
                rays = leave_lineality(row, rows_before, direction, &mut lineality, rays, alpha);
            }
            None => rays = cut(row, &rays, alpha),
        }
    }
    Generators {
        lineality,
        rays: rays.into_iter().map(|r| r.z).collect(),
    }
}

/// A ray and which of the rows so far vanish on it.
struct Ray {
    z: Vec<Poly>,
    zero: Vec<bool>,
}

/// The row cuts the lineality space: one direction becomes a ray, all else moves into the row's
/// hyperplane.
fn leave_lineality(
    row: &[Poly],
    rows_before: usize,
    mut direction: Vec<Poly>,
    lineality: &mut [Vec<Poly>],
    mut rays: Vec<Ray>,
    alpha: &mut Algebraic,
) -> Vec<Ray> {
    if alpha.sign_of(&dot(row, &direction)) == Sign::Negative {
        direction = direction.iter().map(|p| -p).collect();
    }
    let scale = dot(row, &direction); // positive
    let into_plane = |z: &[Poly]| combine(&scale, z, &-&dot(row, z), &direction, alpha);
    lineality.iter_mut().for_each(|l| *l = into_plane(l));
    for ray in &mut rays {
        ray.z = into_plane(&ray.z);
        ray.zero.push(true);
    }
    // Every earlier row vanishes on the lineality space.
    let mut zero = vec![true; rows_before];
    zero.push(false);
    rays.push(Ray { z: direction, zero });
    rays
}

/// The row cuts the pointed part: rays on the wrong side are replaced by those on the plane.
fn cut(row: &[Poly], rays: &[Ray], alpha: &mut Algebraic) -> Vec<Ray> {
    let values: Vec<(Poly, Sign)> = rays
        .iter()
        .map(|r| dot(row, &r.z))
        .map(|v| (v.clone(), alpha.sign_of(&v)))
        .collect();
    let mut kept = Vec::new();
    for (i, ray) in rays.iter().enumerate() {
        if values[i].1 != Sign::Negative {
            let zero = [&ray.zero[..], &[values[i].1 == Sign::Zero]].concat();
            kept.push(Ray {
                z: ray.z.clone(),
                zero,
            });
        }
        for (j, other) in rays.iter().enumerate() {
            if values[i].1 != Sign::Positive
                || values[j].1 != Sign::Negative
                || !adjacent(i, j, rays)
            {
                continue;
            }
            // (row.p) n - (row.n) p: a positive combination on which the row vanishes.
            let z = combine(&values[i].0, &other.z, &-&values[j].0, &ray.z, alpha);
            let mut zero: Vec<bool> = ray
                .zero
                .iter()
                .zip(&other.zero)
                .map(|(a, b)| *a && *b)
                .collect();
            zero.push(true);
            kept.push(Ray { z, zero });
        }
    }
    kept
}

/// Do two extreme rays span a face of two dimensions? Exactly if no third one vanishes wherever
/// both do.
fn adjacent(i: usize, j: usize, rays: &[Ray]) -> bool {
    let common: Vec<usize> = (0..rays[i].zero.len())
        .filter(|&k| rays[i].zero[k] && rays[j].zero[k])
        .collect();
    !rays
        .iter()
        .enumerate()
        .any(|(k, r)| k != i && k != j && common.iter().all(|&c| r.zero[c]))
}

/// The inner product of two vectors of polynomials.
pub fn dot(a: &[Poly], b: &[Poly]) -> Poly {
    a.iter()
        .zip(b)
        .filter(|(p, q)| !p.is_zero() && !q.is_zero())
        .fold(Poly::default(), |sum, (p, q)| &sum + &(p * q))
}

/// p u + q v at alpha, up to a positive factor.
fn combine(p: &Poly, u: &[Poly], q: &Poly, v: &[Poly], alpha: &Algebraic) -> Vec<Poly> {
    let sum: Vec<Poly> = u.iter().zip(v).map(|(a, b)| &(p * a) + &(q * b)).collect();
    alpha.reduce(&sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{nonnegative_roots, whole};

    fn row(v: &[i64]) -> Vec<Poly> {
        v.iter().map(|&c| Poly::from_ints(&[c])).collect()
    }

    fn counts(rows: &[&[i64]], dimension: usize) -> (usize, usize) {
        let rows: Vec<_> = rows.iter().map(|r| row(r)).collect();
        let cone = cone_generators(&rows, dimension, &mut Algebraic::rational(whole(1)));
        (cone.lineality.len(), cone.rays.len())
    }

    #[test]
    fn textbook_cones() {
        assert_eq!(counts(&[], 3), (3, 0));
        assert_eq!(counts(&[&[0, 0, 1]], 3), (2, 1)); // half-space
        assert_eq!(counts(&[&[0, 0, 1], &[0, 0, -1]], 3), (2, 0)); // plane
        assert_eq!(counts(&[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]], 3), (0, 3)); // octant
        assert_eq!(
            counts(&[&[1, 0, 1], &[-1, 0, 1], &[0, 1, 1], &[0, -1, 1]], 3),
            (0, 4)
        ); // over a square
        assert_eq!(counts(&[&[1, 0], &[-1, 0], &[0, 1], &[0, -1]], 2), (0, 0)); // the origin
        assert_eq!(counts(&[&[1, 0], &[2, 0], &[0, 1], &[1, 1]], 2), (0, 2)); // redundant rows
        assert_eq!(counts(&[&[1, -1], &[-1, 1], &[1, 0]], 2), (0, 1)); // a ray
        // Over the cube: 6 facets, 8 rays; many pairs are not adjacent.
        let cube: [&[i64]; 6] = [
            &[1, 0, 0, 1],
            &[-1, 0, 0, 1],
            &[0, 1, 0, 1],
            &[0, -1, 0, 1],
            &[0, 0, 1, 1],
            &[0, 0, -1, 1],
        ];
        assert_eq!(counts(&cube, 4), (0, 8));
        // Over the octahedron: 8 facets, 6 rays.
        let signs = (0..8i64).map(|k| [1 - 2 * (k & 1), 1 - (k & 2), 1 - (k & 4) / 2, 1]);
        let octahedron: Vec<[i64; 4]> = signs.collect();
        let rows: Vec<&[i64]> = octahedron.iter().map(|r| &r[..]).collect();
        assert_eq!(counts(&rows, 4), (0, 6));
    }

    /// Each ray satisfies all rows, and is the only one (up to scale) where its active rows vanish.
    #[test]
    fn rays_satisfy_and_are_extreme_at_an_irrational_number() {
        let mut root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
        let p = |c: &[i64]| Poly::from_ints(c);
        // z_0 >= 0, z_1 >= sqrt 2 z_0, z_2 >= 0, 2 z_0 + z_2 >= sqrt 2 z_1
        let rows = [
            vec![p(&[1]), p(&[]), p(&[])],
            vec![p(&[0, -1]), p(&[1]), p(&[])],
            vec![p(&[]), p(&[]), p(&[1])],
            vec![p(&[2]), p(&[0, -1]), p(&[1])],
        ];
        let cone = cone_generators(&rows, 3, &mut root);
        assert_eq!((cone.lineality.len(), cone.rays.len()), (0, 3));
        for ray in &cone.rays {
            let signs: Vec<Sign> = rows.iter().map(|r| root.sign_of(&dot(r, ray))).collect();
            assert!(!signs.contains(&Sign::Negative));
            assert!(
                signs.iter().filter(|s| **s == Sign::Zero).count() >= 2,
                "{ray:?}"
            );
        }
    }
}
