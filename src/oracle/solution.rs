//! What the enumerator finds: solutions by their exact support, and what it only reports.

use crate::exact::{Algebraic, Poly, ratio_to_decimal, to_decimal};
use crate::model::{Pencil, Window};

/// One solution of (12)-(14) or (21)-(23), up to the positive factor that x and y share.
///
/// x and y are integer polynomials to be evaluated at `value`; each entry of y carries the scale
/// of its (positively scaled) row, so only its sign is meaningful against the given matrices.
#[derive(Debug, Clone)]
pub struct Solution {
    /// t: lambda^2 or mu.
    pub value: Algebraic,
    /// How often `value` is a root of the determinant of its support.
    pub multiplicity: usize,
    /// Indices of complementarity variables with x_i > 0, ascending.
    pub slip: Vec<usize>,
    /// Indices of complementarity variables with x_i = y_i = 0, ascending.
    pub biactive: Vec<usize>,
    /// x over all variables of the pencil.
    pub x: Vec<Poly>,
    /// Positive multiple of y_i for each variable of the pencil.
    pub y: Vec<Poly>,
}

impl Solution {
    /// The value as a decimal with `digits` correctly rounded significant digits.
    pub fn decimal(&self, digits: usize) -> String {
        to_decimal(&mut self.value.clone(), &Poly::from_ints(&[0, 1]), digits)
    }

    /// x scaled to e'x_s = 1 (l1 norm 1 where x_s = 0), each entry correctly rounded.
    pub fn x_decimals(&self, constrained: &[usize], digits: usize) -> Vec<String> {
        let mut value = self.value.clone();
        let norm = self.normaliser(constrained);
        self.x.iter().map(|p| ratio_to_decimal(&mut value, p, &norm, digits)).collect()
    }

    /// The polynomial whose value x is divided by: e'x_s, or the l1 norm for free-only solutions.
    pub fn normaliser(&self, constrained: &[usize]) -> Poly {
        let add = |a: Poly, b: &Poly| &a + b;
        if !self.slip.is_empty() {
            return constrained.iter().map(|&i| &self.x[i]).fold(Poly::default(), add);
        }
        let mut value = self.value.clone();
        let signed = self.x.iter().map(|p| if value.sign_of(p) == crate::exact::Sign::Negative { -p } else { p.clone() });
        signed.fold(Poly::default(), |a, b| &a + &b)
    }
}

/// A support and value whose kernel has more than one dimension: detected, not yet described.
#[derive(Debug, Clone)]
pub struct WideKernel {
    /// The value.
    pub value: Algebraic,
    /// The complementarity variables assumed to slip.
    pub support: Vec<usize>,
    /// Dimension of the kernel.
    pub dimension: usize,
}

/// Everything the enumerator found in the window.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    /// Solutions, by value, then by slip set.
    pub solutions: Vec<Solution>,
    /// Kernels of dimension > 1, which may hold cones of solutions.
    pub wide: Vec<WideKernel>,
    /// Supports whose pencil is singular: every t is an eigenvalue of them.
    pub continua: Vec<Vec<usize>>,
    /// Supports examined.
    pub supports_done: u64,
    /// Supports there are: 2^n_s.
    pub supports_total: u64,
}

impl Enumeration {
    /// Were all supports examined?
    pub fn is_finished(&self) -> bool {
        self.supports_done == self.supports_total
    }

    /// Is `solutions` the complete answer: all supports examined, no wide kernel, no singular pencil?
    pub fn is_complete_list(&self) -> bool {
        self.is_finished() && self.wide.is_empty() && self.continua.is_empty()
    }

    /// Completes an answer put together from [`super::examine_support`]s, once all are in.
    pub fn describe(&mut self, _pencil: &Pencil, _window: &Window) {
        self.sort();
    }

    /// Puts everything into the canonical order.
    pub(super) fn sort(&mut self) {
        self.solutions.sort_by(|a, b| a.value.clone().cmp_exact(&mut b.value.clone()).then_with(|| a.slip.cmp(&b.slip)));
        self.wide.sort_by(|a, b| a.value.clone().cmp_exact(&mut b.value.clone()).then_with(|| a.support.cmp(&b.support)));
        self.continua.sort();
    }
}
