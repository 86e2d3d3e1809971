//! Value types for what is not a list: a [`Cone`] of solutions at one value, and a [`SupportRange`]
//! of values at which one support has a solution.
//!
//! A cone with the extreme rays r_1, ..., r_k and the lineality basis l_1, ..., l_m is the set of
//! all x = sum_j a_j r_j + sum_j b_j l_j != 0 with a_j >= 0 and any b_j. A range is a union of
//! intervals whose ends are algebraic numbers.
//!
//! Filled in by `cone` and `range`; compared by `member`.

use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Rational, cleared, common_denominator};
use std::cmp::Ordering;

/// Solutions at one value that form a cone of dimension > 1: all sums of a nonnegative combination
/// of `rays` and any combination of `lineality`, zero excluded.
///
/// It is the set of all solutions x at `value` with x = 0 off `slip` (and the free variables) and
/// y = 0 on `slip`; no other cone of the list contains it. A ray that is the only solution with its
/// value and support is also in [`super::Enumeration::solutions`].
#[derive(Debug, Clone)]
pub struct Cone {
    /// The value.
    pub value: Algebraic,
    /// Complementarity variables positive inside the cone, ascending.
    pub slip: Vec<usize>,
    /// Complementarity variables with x_i = y_i = 0 on all of the cone, ascending.
    pub biactive: Vec<usize>,
    /// Dimension of the kernel on the support.
    pub kernel_dimension: usize,
    /// Dimension of the cone: at most that of the kernel.
    pub dimension: usize,
    /// Extreme rays (modulo the lineality space), by slip set, then by biactive set.
    pub rays: Vec<Solution>,
    /// A basis of the lineality space: directions of free variables alone, y = 0 along them. Empty
    /// where Propositions 1 and 2 apply.
    pub lineality: Vec<Vec<Poly>>,
}

impl Cone {
    /// A solution inside the cone: the mean of the rays, each scaled to e'x_s = 1 (l1 norm 1 where
    /// x_s = 0); without rays the first direction of the lineality space, without y.
    ///
    /// `constrained` lists the complementarity variables of the pencil.
    pub fn center(&self, constrained: &[usize]) -> Solution {
        let mut center = Solution {
            value: self.value.clone(),
            multiplicity: 0,
            slip: self.slip.clone(),
            biactive: self.biactive.clone(),
            x: Vec::new(),
            y: Vec::new(),
        };

        if self.rays.is_empty()
            && let Some(direction) = self.lineality.first()
        {
            center.x = direction.clone();
            return center;
        }

        let weights = self.weights(constrained);
        let rays_x: Vec<&[Poly]> = self.rays.iter().map(|ray| &ray.x[..]).collect();
        let rays_y: Vec<&[Poly]> = self.rays.iter().map(|ray| &ray.y[..]).collect();
        center.x = self.value.reduce(&weighted_sum(&weights, &rays_x));
        center.y = self.value.reduce(&weighted_sum(&weights, &rays_y));

        center
    }

    /// The weights 1 / n_k of the rays with norms n_k, times the product of all norms: the products
    /// of the other norms n_l, l != k.
    fn weights(&self, constrained: &[usize]) -> Vec<Poly> {
        let norms: Vec<Poly> = self
            .rays
            .iter()
            .map(|ray| ray.normaliser(constrained))
            .collect();

        let mut weights = Vec::with_capacity(norms.len());
        for k in 0..norms.len() {
            let mut weight = Poly::from_ints(&[1]);
            for (l, norm) in norms.iter().enumerate() {
                if l != k {
                    weight = &weight * norm;
                }
            }
            weights.push(weight);
        }

        weights
    }
}

/// sum_k weight_k vector_k.
fn weighted_sum(weights: &[Poly], vectors: &[&[Poly]]) -> Vec<Poly> {
    let order = vectors.first().map_or(0, |vector| vector.len());
    let mut sum = vec![Poly::default(); order];

    for (weight, vector) in weights.iter().zip(vectors) {
        for (sum_i, entry) in sum.iter_mut().zip(*vector) {
            *sum_i += &(weight * entry);
        }
    }

    sum
}

/// A support whose pencil is singular, and the values at which a solution with exactly that support
/// (x_i > 0 on it) exists.
#[derive(Debug, Clone)]
pub struct SupportRange {
    /// The support.
    pub support: Vec<usize>,
    /// Disjoint intervals, ascending, each as long as it can be within the window.
    pub pieces: Vec<ValueInterval>,
    /// A basis over Q(t) of the kernel on the support and the free variables, as vectors over all
    /// variables. With one vector, it or its negative is the solution x(t) wherever it is not zero.
    pub kernel: Vec<Vec<Poly>>,
}

impl SupportRange {
    /// Is this number in one of the pieces?
    pub fn contains(&self, value: &Algebraic) -> bool {
        self.pieces.iter().any(|piece| piece.contains(value))
    }
}

/// An interval of values.
#[derive(Debug, Clone)]
pub struct ValueInterval {
    /// Lower end, `None` where it has none.
    pub from: Option<End>,
    /// Upper end, `None` where it has none.
    pub to: Option<End>,
}

impl ValueInterval {
    /// Is this number in the interval?
    pub fn contains(&self, value: &Algebraic) -> bool {
        let is_from_on = self
            .from
            .as_ref()
            .is_none_or(|from| match from.place_of(value) {
                Ordering::Less => false,
                Ordering::Equal => from.included,
                Ordering::Greater => true,
            });
        let is_up_to = self.to.as_ref().is_none_or(|to| match to.place_of(value) {
            Ordering::Less => true,
            Ordering::Equal => to.included,
            Ordering::Greater => false,
        });

        is_from_on && is_up_to
    }
}

/// An end of an interval.
#[derive(Debug, Clone)]
pub struct End {
    /// The number.
    pub value: Algebraic,
    /// Does it belong to the interval?
    pub included: bool,
}

impl End {
    /// How `value` compares with this end.
    fn place_of(&self, value: &Algebraic) -> Ordering {
        value.clone().cmp_exact(&mut self.value.clone())
    }
}

/// A singular support that was left undescribed: its cells would need too many minors.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "singular support {support:?} is not described: it needs {minors} minors, the limit is {limit}"
)]
pub struct Undescribed {
    /// The support.
    pub support: Vec<usize>,
    /// Minors needed.
    pub minors: usize,
    /// Minors allowed.
    pub limit: usize,
}

/// A rational vector as constant polynomials, up to a positive factor.
pub fn constants(x: &[Rational]) -> Vec<Poly> {
    let clear = common_denominator(x);
    x.iter()
        .map(|x_i| Poly::constant(cleared(x_i, &clear)))
        .collect()
}
