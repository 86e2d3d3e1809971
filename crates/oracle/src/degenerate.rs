//! Value types for what is not a list: cones of solutions at one value, ranges of values of one
//! support.

use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Rational, common_denominator};
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
    /// x_s = 0); without rays the first direction of the lineality space.
    pub fn center(&self, constrained: &[usize]) -> Solution {
        let norms: Vec<Poly> = self
            .rays
            .iter()
            .map(|r| r.normaliser(constrained))
            .collect();
        let others = |k: usize| {
            norms
                .iter()
                .enumerate()
                .filter(|(l, _)| *l != k)
                .fold(Poly::from_ints(&[1]), |p, (_, n)| &p * n)
        };
        let n = self.rays.first().map_or(0, |r| r.x.len());
        let sum = |entry: &dyn Fn(&Solution) -> Poly| {
            self.rays
                .iter()
                .enumerate()
                .fold(Poly::default(), |s, (k, r)| &s + &(&others(k) * &entry(r)))
        };
        let mean = |of: &dyn Fn(&Solution, usize) -> Poly| {
            (0..n).map(|i| sum(&|r| of(r, i))).collect::<Vec<_>>()
        };
        let (x, y) = match (&self.rays[..], &self.lineality[..]) {
            ([], [direction, ..]) => (direction.clone(), Vec::new()),
            _ => (
                self.value.reduce(&mean(&|r, i| r.x[i].clone())),
                self.value.reduce(&mean(&|r, i| r.y[i].clone())),
            ),
        };
        Solution {
            value: self.value.clone(),
            multiplicity: 0,
            slip: self.slip.clone(),
            biactive: self.biactive.clone(),
            x,
            y,
        }
    }
}

/// A support whose pencil is singular, and the values at which a solution with exactly that support
/// (x_i > 0 on it) exists.
#[derive(Debug, Clone)]
pub struct SupportRange {
    /// The support.
    pub support: Vec<usize>,
    /// Disjoint intervals, ascending, each as long as it can be within the window.
    pub pieces: Vec<Piece>,
    /// A basis over Q(t) of the kernel on the support and the free variables, as vectors over all
    /// variables. With one vector, it or its negative is the solution x(t) wherever it is not zero.
    pub kernel: Vec<Vec<Poly>>,
}

impl SupportRange {
    /// Is this number in one of the pieces?
    pub fn contains(&self, value: &Algebraic) -> bool {
        self.pieces.iter().any(|p| p.contains(value))
    }
}

/// An interval of values; `to` is `None` where it has no upper end.
#[derive(Debug, Clone)]
pub struct Piece {
    /// Lower end.
    pub from: End,
    /// Upper end.
    pub to: Option<End>,
}

impl Piece {
    /// Is this number in the interval?
    pub fn contains(&self, value: &Algebraic) -> bool {
        let side = |end: &End, out: Ordering| match value.clone().cmp_exact(&mut end.value.clone())
        {
            Ordering::Equal => end.included,
            other => other != out,
        };
        side(&self.from, Ordering::Less)
            && self
                .to
                .as_ref()
                .is_none_or(|to| side(to, Ordering::Greater))
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
pub(super) fn constants(x: &[Rational]) -> Vec<Poly> {
    let clear = common_denominator(x);
    x.iter()
        .map(|v| Poly::constant(v.numer() * (&clear / v.denom())))
        .collect()
}
