//! Polyhedral cones over Q(alpha) by the double description method (Motzkin, Raiffa, Thompson and
//! Thrall 1953; adjacency as in Fukuda and Prodon 1996). Every sign is exact.
//!
//! The cone {z : row . z >= 0 for each row} is built up row by row, beginning with the whole space.
//! At each step it is held as generators: a basis of the lineality space (the largest subspace in
//! it) and the extreme rays modulo that space. A new row
//!
//! * that does not vanish on the lineality space takes one direction out of it, and makes it a ray;
//! * that does vanish there keeps the rays on its side, and replaces the others by the points at
//!   which the two-dimensional faces between a kept and a lost ray meet its hyperplane.
//!
//! Numbers are integer polynomials taken at alpha; vectors count up to a positive factor and are
//! kept short by [`Algebraic::reduce`].
//!
//! Called by the oracle for kernels of more than one dimension, and by the search for witnesses.

use super::{Algebraic, Poly, Sign};

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
///
/// let rows = [row([1, 0]), row([-1, 1]), row([0, 1])]; // 0 <= z_0 <= z_1
/// let cone = cone_generators(&rows, 2, &mut alpha);
/// assert_eq!((cone.lineality.len(), cone.rays.len()), (0, 2));
/// ```
pub fn cone_generators(rows: &[Vec<Poly>], dimension: usize, alpha: &mut Algebraic) -> Generators {
    let mut cone = PartialCone::whole_space(dimension);
    for row in rows {
        cone.intersect(row, alpha);
    }

    Generators {
        lineality: cone.lineality,
        rays: cone.rays.into_iter().map(|ray| ray.z).collect(),
    }
}

/// The cone of the rows so far.
struct PartialCone {
    lineality: Vec<Vec<Poly>>,
    rays: Vec<Ray>,
    /// Number of rows so far.
    rows: usize,
}

/// An extreme ray, and for each row so far whether it vanishes on the ray.
struct Ray {
    z: Vec<Poly>,
    is_zero: Vec<bool>,
}

/// The value of a row at a ray.
struct RowValue {
    value: Poly,
    sign: Sign,
}

impl PartialCone {
    fn whole_space(dimension: usize) -> PartialCone {
        let mut lineality = vec![vec![Poly::default(); dimension]; dimension];
        for (k, unit_vector) in lineality.iter_mut().enumerate() {
            unit_vector[k] = Poly::from_ints(&[1]);
        }

        PartialCone {
            lineality,
            rays: Vec::new(),
            rows: 0,
        }
    }

    /// Keeps the part with row . z >= 0.
    fn intersect(&mut self, row: &[Poly], alpha: &mut Algebraic) {
        let cut_direction = self
            .lineality
            .iter()
            .position(|direction| alpha.sign_of(&dot(row, direction)) != Sign::Zero);
        match cut_direction {
            Some(k) => self.cut_lineality(row, k, alpha),
            None => self.cut_rays(row, alpha),
        }

        self.rows += 1;
    }

    /// The row does not vanish on the lineality direction k: it becomes a ray, turned to the right
    /// side of the row, and all else moves along it into the row's hyperplane.
    fn cut_lineality(&mut self, row: &[Poly], k: usize, alpha: &mut Algebraic) {
        let mut direction = self.lineality.swap_remove(k);
        if alpha.sign_of(&dot(row, &direction)) == Sign::Negative {
            direction = direction.iter().map(|entry| -entry).collect();
        }

        for vector in &mut self.lineality {
            *vector = move_into_hyperplane(row, vector, &direction, alpha);
        }

        for ray in &mut self.rays {
            ray.z = move_into_hyperplane(row, &ray.z, &direction, alpha);
            ray.is_zero.push(true);
        }

        // Every earlier row vanishes on the lineality space.
        let mut is_zero = vec![true; self.rows];
        is_zero.push(false);
        self.rays.push(Ray {
            z: direction,
            is_zero,
        });
    }

    /// The row vanishes on the lineality space: rays on its wrong side are replaced by rays on its
    /// hyperplane.
    fn cut_rays(&mut self, row: &[Poly], alpha: &mut Algebraic) {
        let mut values = Vec::with_capacity(self.rays.len());
        for ray in &self.rays {
            let value = dot(row, &ray.z);
            let sign = alpha.sign_of(&value);
            values.push(RowValue { value, sign });
        }

        let mut kept = Vec::new();
        for (i, ray) in self.rays.iter().enumerate() {
            if values[i].sign != Sign::Negative {
                let mut is_zero = ray.is_zero.clone();
                is_zero.push(values[i].sign == Sign::Zero);
                kept.push(Ray {
                    z: ray.z.clone(),
                    is_zero,
                });
            }

            for (j, other) in self.rays.iter().enumerate() {
                let is_between =
                    values[i].sign == Sign::Positive && values[j].sign == Sign::Negative;
                if !is_between || !self.are_adjacent(i, j) {
                    continue;
                }
                // (row . ray) other - (row . other) ray: a positive combination with row . z = 0.
                let z = combine(
                    [&values[i].value, &-&values[j].value],
                    [&other.z, &ray.z],
                    alpha,
                );
                let mut is_zero = common_zeros(ray, other);
                is_zero.push(true);
                kept.push(Ray { z, is_zero });
            }
        }

        self.rays = kept;
    }

    /// Do two extreme rays span a face of two dimensions? Exactly if no third one vanishes wherever
    /// both do.
    fn are_adjacent(&self, i: usize, j: usize) -> bool {
        let common: Vec<usize> = (0..self.rows)
            .filter(|&row| self.rays[i].is_zero[row] && self.rays[j].is_zero[row])
            .collect();

        for (k, third) in self.rays.iter().enumerate() {
            if k != i && k != j && common.iter().all(|&row| third.is_zero[row]) {
                return false;
            }
        }

        true
    }
}

/// For each row, whether it vanishes on both rays.
fn common_zeros(a: &Ray, b: &Ray) -> Vec<bool> {
    a.is_zero
        .iter()
        .zip(&b.is_zero)
        .map(|(in_a, in_b)| *in_a && *in_b)
        .collect()
}

/// (row . direction) z - (row . z) direction, where row . direction > 0.
fn move_into_hyperplane(
    row: &[Poly],
    z: &[Poly],
    direction: &[Poly],
    alpha: &Algebraic,
) -> Vec<Poly> {
    let weights = [&dot(row, direction), &-&dot(row, z)];
    combine(weights, [z, direction], alpha)
}

/// p u + q v at alpha, for weights [p, q] and vectors [u, v], up to a positive factor.
fn combine(weights: [&Poly; 2], vectors: [&[Poly]; 2], alpha: &Algebraic) -> Vec<Poly> {
    let [p, q] = weights;
    let [u, v] = vectors;
    let mut sum = Vec::with_capacity(u.len());

    for (u_i, v_i) in u.iter().zip(v) {
        sum.push(&(p * u_i) + &(q * v_i));
    }

    alpha.reduce(&sum)
}

/// The inner product of two vectors of polynomials.
pub fn dot(a: &[Poly], b: &[Poly]) -> Poly {
    let mut sum = Poly::default();
    for (a_i, b_i) in a.iter().zip(b) {
        if !a_i.is_zero() && !b_i.is_zero() {
            sum += &(a_i * b_i);
        }
    }

    sum
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

    fn vector(entries: [&[i64]; 3]) -> Vec<Poly> {
        entries.map(Poly::from_ints).to_vec()
    }

    /// Each ray satisfies all rows, and is the only one (up to scale) where its active rows vanish.
    #[test]
    fn rays_satisfy_and_are_extreme_at_an_irrational_number() {
        let mut root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
        let rows = [
            vector([&[1], &[], &[]]),       // z_0 >= 0
            vector([&[0, -1], &[1], &[]]),  // z_1 >= sqrt 2 z_0
            vector([&[], &[], &[1]]),       // z_2 >= 0
            vector([&[2], &[0, -1], &[1]]), // 2 z_0 + z_2 >= sqrt 2 z_1
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
