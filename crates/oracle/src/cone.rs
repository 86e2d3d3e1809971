//! Kernels of dimension > 1: all solutions on one support at one value, as a polyhedral cone.
//!
//! At a fixed t a support J has the set
//!
//! C_J = { x : x = 0 off J and f, y = 0 on J and f, x_J >= 0, y >= 0 elsewhere },  y = (A + tB) x,
//!
//! the combinations of kernel vectors that satisfy finitely many inequalities: a polyhedral cone,
//! given by its extreme rays and its lineality space. The solutions at t are the union of all C_J,
//! without 0.
//!
//! Let J be the indices that are positive somewhere on C_J (otherwise a smaller support has the
//! same cone) and Z those whose y vanishes on all of it. Then C_J lies in C_J' exactly if
//! J <= J' <= Z as sets: so a cone that is a face of another one is recognised and left out.
//!
//! Input: a support and a value, an eigenvalue of its block. Called by `solution` for the kernels
//! that `plain` met, and by `range` at single values of a singular support.

use super::degenerate::Cone;
use super::enumeration::{Enumeration, WideKernel};
use super::integer_pencil::{IntegerPencil, entries_of};
use super::plain::multiplicity;
use super::solution::{Solution, equal_values};
use mceip_exact::{Algebraic, Poly, Sign, cone_generators, dot, kernel_at, row_echelon_at};

/// Adds what is on the support of a wide kernel: nothing, ordinary solutions, or a cone.
pub(super) fn describe(pencil: &IntegerPencil<'_>, kernel: &WideKernel, found: &mut Enumeration) {
    let cone = cone_at(pencil, &kernel.support, &kernel.value);
    if cone.slip != kernel.support {
        return; // C_J is the cone of a smaller support, which is described there.
    }

    match (cone.dimension, &cone.lineality[..]) {
        (0, _) => {}
        (1, []) => found.solutions.extend(cone.rays),
        (1, [x, ..]) => {
            let opposite: Vec<Poly> = x.iter().map(|x_i| -x_i).collect();
            found.solutions.push(solution(pencil, x, &cone.value));
            found
                .solutions
                .push(solution(pencil, &opposite, &cone.value));
        }
        _ => found.cones.push(cone),
    }
}

/// Drops every cone that is a face of another one at the same value. Each has its generic support.
pub(super) fn keep_maximal(cones: &mut Vec<Cone>) {
    let is_maximal: Vec<bool> = cones
        .iter()
        .map(|cone| !cones.iter().any(|other| is_face(cone, other)))
        .collect();

    let mut is_maximal = is_maximal.into_iter();
    cones.retain(|_| is_maximal.next().unwrap_or(true));
}

/// J < J' <= Z, at the same value.
fn is_face(small: &Cone, large: &Cone) -> bool {
    small.slip.len() < large.slip.len()
        && small.slip.iter().all(|i| large.slip.contains(i))
        && large
            .slip
            .iter()
            .all(|i| small.slip.contains(i) || small.biactive.contains(i))
        && equal_values(&small.value, &large.value)
}

/// C_J at a value: `slip` are the indices positive somewhere on it, `biactive` the other
/// complementarity variables whose y vanishes on all of it.
pub(super) fn cone_at(pencil: &IntegerPencil<'_>, support: &[usize], value: &Algebraic) -> Cone {
    let mut value = value.clone();
    let active = pencil.active(support);

    // C_J in the coordinates z of the kernel: x = sum_k z_k v_k, under the inequalities of (26).
    let basis: Vec<Vec<Poly>> = kernel_at(pencil.block(&active), &mut value)
        .iter()
        .map(|v| value.reduce(&pencil.extend(&active, v)))
        .collect();
    let inequalities: Vec<Vec<Poly>> = pencil
        .inequalities(support, &basis)
        .iter()
        .map(|row| value.reduce(row))
        .collect();
    let generators = cone_generators(&inequalities, basis.len(), &mut value);

    // The generators as vectors x over all variables.
    let lineality = combinations(pencil, &basis, &generators.lineality, &value);
    let rays = combinations(pencil, &basis, &generators.rays, &value);
    let lineality = Lineality::of(lineality, &mut value);
    let mut rays: Vec<Solution> = rays
        .into_iter()
        .map(|x| lineality.project(x, &value))
        .map(|x| solution(pencil, &x, &value))
        .collect();
    rays.sort_by(|a, b| (&a.slip, &a.biactive).cmp(&(&b.slip, &b.biactive)));

    // What holds on all of the cone is what holds on all of its rays.
    let slip: Vec<usize> = support
        .iter()
        .copied()
        .filter(|i| rays.iter().any(|ray| ray.slip.contains(i)))
        .collect();
    let biactive: Vec<usize> = (0..pencil.order())
        .filter(|&i| pencil.is_complementarity(i))
        .filter(|i| !slip.contains(i) && rays.iter().all(|ray| ray.biactive.contains(i)))
        .collect();

    let mut spanning: Vec<Vec<Poly>> = rays.iter().map(|ray| ray.x.clone()).collect();
    spanning.extend(lineality.basis.iter().cloned());
    let (_, pivots) = row_echelon_at(spanning, &mut value);

    Cone {
        value,
        slip,
        biactive,
        kernel_dimension: basis.len(),
        dimension: pivots.len(),
        rays,
        lineality: lineality.basis,
    }
}

/// sum_k z_k v_k over the basis vectors v_k, for each of the given z.
fn combinations(
    pencil: &IntegerPencil<'_>,
    basis: &[Vec<Poly>],
    coordinates: &[Vec<Poly>],
    value: &Algebraic,
) -> Vec<Vec<Poly>> {
    let mut vectors = Vec::with_capacity(coordinates.len());
    for z in coordinates {
        let x: Vec<Poly> = (0..pencil.order())
            .map(|i| dot(z, &entries_of(basis, i)))
            .collect();
        vectors.push(value.reduce(&x));
    }

    vectors
}

/// A lineality space by its reduced echelon basis: the one basis whose pivots are positive and
/// whose vectors vanish at the pivots of the others. It is unique up to positive factors.
struct Lineality {
    basis: Vec<Vec<Poly>>,
    pivots: Vec<usize>,
}

impl Lineality {
    /// The space spanned by `vectors`.
    fn of(vectors: Vec<Vec<Poly>>, value: &mut Algebraic) -> Lineality {
        let (rows, pivots) = row_echelon_at(vectors, value);

        let mut basis = Vec::with_capacity(rows.len());

        for (mut row, &pivot) in rows.into_iter().zip(&pivots) {
            if value.sign_of(&row[pivot]) == Sign::Negative {
                row = row.iter().map(|entry| -entry).collect();
            }
            basis.push(value.reduce(&row));
        }

        Lineality { basis, pivots }
    }

    /// The vector of ray + space that vanishes at the pivots, up to a positive factor: it makes the
    /// choice of an extreme ray unique.
    fn project(&self, mut ray: Vec<Poly>, value: &Algebraic) -> Vec<Poly> {
        for (row, &pivot) in self.basis.iter().zip(&self.pivots) {
            let mut difference = Vec::with_capacity(ray.len());
            for (ray_i, row_i) in ray.iter().zip(row) {
                difference.push(&(&row[pivot] * ray_i) - &(&ray[pivot] * row_i));
            }
            ray = value.reduce(&difference);
        }

        ray
    }
}

/// The ray x as a solution, with the support and the biactive indices it really has.
fn solution(pencil: &IntegerPencil<'_>, x: &[Poly], value: &Algebraic) -> Solution {
    let mut value = value.clone();
    let y = pencil.times(x);

    let (slip, at_zero): (Vec<usize>, Vec<usize>) = (0..pencil.order())
        .filter(|&i| pencil.is_complementarity(i))
        .partition(|&i| value.sign_of(&x[i]) == Sign::Positive);
    let biactive = at_zero
        .into_iter()
        .filter(|&i| value.sign_of(&y[i]) == Sign::Zero)
        .collect();

    // Where the block of its own support is singular every value is a root: no multiplicity.
    let det = pencil.determinant(&pencil.active(&slip));
    let multiplicity = if det.is_zero() {
        0
    } else {
        multiplicity(&det, &mut value)
    };

    Solution {
        value,
        multiplicity,
        slip,
        biactive,
        x: x.to_vec(),
        y,
    }
}
