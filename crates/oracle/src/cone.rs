//! Kernels of dimension > 1: all solutions on one support at one value, as a polyhedral cone.
//!
//! At a fixed t a support J spans C_J = {x : x = 0 off J and f, y = 0 on J and f, x_J >= 0, y >= 0
//! elsewhere}: kernel combinations under finitely many inequalities. The solutions at t are the
//! union of all C_J. With J the indices that are positive somewhere on C_J (else a smaller support
//! has the same cone) and Z those whose y vanishes on all of it, C_J lies in C_J' exactly if J <=
//! J' <= Z: that is how a cone that is a face of another is left out.

use super::degenerate::Cone;
use super::enumeration::{Enumeration, WideKernel};
use super::integral::{Integral, multiplicity};
use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Sign, cone_generators, dot, kernel_at, row_echelon_at};

/// Describes what is on the support of a wide kernel: nothing, ordinary solutions, or a cone.
pub(super) fn describe(pencil: &Integral<'_>, kernel: &WideKernel, found: &mut Enumeration) {
    let cone = cone_at(pencil, &kernel.support, &kernel.value);
    if cone.slip != kernel.support {
        return; // C_J is the cone of a smaller support, which is described there
    }
    match (cone.dimension, &cone.lineality[..]) {
        (0, _) => {}
        (1, []) => found.solutions.extend(cone.rays),
        (1, [x, ..]) => {
            let opposite: Vec<Poly> = x.iter().map(|p| -p).collect();
            found
                .solutions
                .extend([x, &opposite].map(|x| solution(pencil, x, &cone.value)));
        }
        _ => found.cones.push(cone),
    }
}

/// Drops every cone that is a face of another one at the same value. Each has its generic support.
pub(super) fn keep_maximal(cones: &mut Vec<Cone>) {
    let face = |small: &Cone, large: &Cone| {
        let inside = |i: &usize| small.slip.contains(i) || small.biactive.contains(i);
        small.slip.len() < large.slip.len()
            && small.slip.iter().all(|i| large.slip.contains(i))
            && large.slip.iter().all(inside)
            && small.value.clone().equals(&mut large.value.clone())
    };
    let keep: Vec<bool> = cones
        .iter()
        .map(|c| !cones.iter().any(|other| face(c, other)))
        .collect();
    let mut keep = keep.into_iter();
    cones.retain(|_| keep.next().unwrap_or(true));
}

/// C_J at a value: `slip` are the indices positive somewhere on it, `biactive` the other
/// complementarity variables whose y vanishes on all of it.
pub(super) fn cone_at(pencil: &Integral<'_>, support: &[usize], value: &Algebraic) -> Cone {
    let mut value = value.clone();
    let active = pencil.active(support);
    let basis: Vec<Vec<Poly>> = kernel_at(pencil.block(&active), &mut value)
        .iter()
        .map(|v| value.reduce(&pencil.extend(&active, v)))
        .collect();
    let images: Vec<Vec<Poly>> = basis.iter().map(|x| pencil.times(x)).collect();
    let x_rows = support
        .iter()
        .map(|&i| basis.iter().map(|x| x[i].clone()).collect::<Vec<_>>());
    let off = (0..pencil.order()).filter(|i| !active.contains(i));
    let y_rows = off.map(|i| images.iter().map(|y| y[i].clone()).collect());
    let rows: Vec<Vec<Poly>> = x_rows.chain(y_rows).map(|row| value.reduce(&row)).collect();
    let generators = cone_generators(&rows, basis.len(), &mut value);
    let to_x = |z: &Vec<Poly>| -> Vec<Poly> {
        let entry = |i: usize| dot(z, &basis.iter().map(|x| x[i].clone()).collect::<Vec<_>>());
        value.reduce(&(0..pencil.order()).map(entry).collect::<Vec<_>>())
    };
    let lineality: Vec<Vec<Poly>> = generators.lineality.iter().map(to_x).collect();
    let rays: Vec<Vec<Poly>> = generators.rays.iter().map(to_x).collect();
    let (lineality, rays) = canonical(lineality, rays, &mut value);
    let mut rays: Vec<Solution> = rays.iter().map(|x| solution(pencil, x, &value)).collect();
    rays.sort_by(|a, b| (&a.slip, &a.biactive).cmp(&(&b.slip, &b.biactive)));
    let slip: Vec<usize> = support
        .iter()
        .copied()
        .filter(|i| rays.iter().any(|r| r.slip.contains(i)))
        .collect();
    let vanishes = |i: &usize| !slip.contains(i) && rays.iter().all(|r| r.biactive.contains(i));
    let biactive = (0..pencil.order())
        .filter(|i| pencil.free.binary_search(i).is_err())
        .filter(vanishes)
        .collect();
    let generators: Vec<Vec<Poly>> = rays
        .iter()
        .map(|r| r.x.clone())
        .chain(lineality.iter().cloned())
        .collect();
    let dimension = row_echelon_at(generators, &mut value).1.len();
    Cone {
        value,
        slip,
        biactive,
        kernel_dimension: basis.len(),
        dimension,
        rays,
        lineality,
    }
}

/// The reduced echelon basis of the lineality space, pivots positive, and rays that vanish at its
/// pivots: both are unique up to positive factors.
fn canonical(
    lineality: Vec<Vec<Poly>>,
    rays: Vec<Vec<Poly>>,
    value: &mut Algebraic,
) -> (Vec<Vec<Poly>>, Vec<Vec<Poly>>) {
    let (rows, pivots) = row_echelon_at(lineality, value);
    let orient = |(row, &p): (Vec<Poly>, &usize)| {
        let negative = value.sign_of(&row[p]) == Sign::Negative;
        value.reduce(&if negative {
            row.iter().map(|e| -e).collect()
        } else {
            row
        })
    };
    let basis: Vec<Vec<Poly>> = rows.into_iter().zip(&pivots).map(orient).collect();
    let project = |mut ray: Vec<Poly>| {
        for (row, &p) in basis.iter().zip(&pivots) {
            let step: Vec<Poly> = ray
                .iter()
                .zip(row)
                .map(|(r, l)| &(&row[p] * r) - &(&ray[p] * l))
                .collect();
            ray = value.reduce(&step);
        }
        ray
    };
    let rays = rays.into_iter().map(project).collect();
    (basis, rays)
}

/// The ray x as a solution, with the support and the biactive indices it really has.
fn solution(pencil: &Integral<'_>, x: &[Poly], value: &Algebraic) -> Solution {
    let mut value = value.clone();
    let y = pencil.times(x);
    let constrained: Vec<usize> = (0..pencil.order())
        .filter(|i| pencil.free.binary_search(i).is_err())
        .collect();
    let (slip, rest): (Vec<usize>, Vec<usize>) = constrained
        .into_iter()
        .partition(|&i| value.sign_of(&x[i]) == Sign::Positive);
    let biactive = rest
        .into_iter()
        .filter(|&i| value.sign_of(&y[i]) == Sign::Zero)
        .collect();
    let det = pencil.determinant(&pencil.active(&slip));
    // Where the pencil of its own support is singular every value is a root: no multiplicity.
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
