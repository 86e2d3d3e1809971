//! A solution by its exact support.
//!
//! A [`Solution`] is t and x with y = (A + tB) x, up to one positive factor. t is an algebraic
//! number, the entries of x and y are integer polynomials to be evaluated at it; so every question
//! about a solution is a sign of a polynomial at an algebraic number.

use mceip_exact::{Algebraic, Poly, Rational, Sign, ratio_to_decimal, to_decimal};

/// One solution of (12)-(14) or (21)-(23), up to the positive factor that x and y share.
///
/// x and y are integer polynomials to be evaluated at `value`; each entry of y carries the scale
/// of its (positively scaled) row, so only its sign is meaningful against the given matrices.
#[derive(Debug, Clone)]
pub struct Solution {
    /// t: lambda^2 or mu.
    pub value: Algebraic,
    /// How often `value` is a root of the determinant of its support; 0 where that vanishes
    /// identically.
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
    /// Is x_s = 0? The hypotheses of Propositions 1 and 2 (K_ff, for lambda^2 also M_ff, definite)
    /// exclude such solutions, so they occur for raw pencils only, and the MCP does not find them.
    pub fn is_free_only(&self) -> bool {
        self.slip.is_empty()
    }

    /// The value as a decimal with `digits` correctly rounded significant digits.
    pub fn decimal(&self, digits: usize) -> String {
        let t = Poly::from_ints(&[0, 1]);
        to_decimal(&mut self.value.clone(), &t, digits)
    }

    /// x scaled to e'x_s = 1 (l1 norm 1 where x_s = 0), each entry correctly rounded.
    ///
    /// `constrained` lists the complementarity variables of the pencil.
    pub fn x_decimals(&self, constrained: &[usize], digits: usize) -> Vec<String> {
        let mut value = self.value.clone();
        let norm = self.normaliser(constrained);
        self.x
            .iter()
            .map(|x_i| ratio_to_decimal(&mut value, x_i, &norm, digits))
            .collect()
    }

    /// The polynomial whose value x is divided by: e'x_s, or the l1 norm for free-only solutions.
    ///
    /// `constrained` lists the complementarity variables of the pencil.
    pub fn normaliser(&self, constrained: &[usize]) -> Poly {
        let mut norm = Poly::default();

        if !self.is_free_only() {
            for &i in constrained {
                norm += &self.x[i];
            }
            return norm;
        }

        let mut value = self.value.clone();
        for x_i in &self.x {
            if value.sign_of(x_i) == Sign::Negative {
                norm += &-x_i;
            } else {
                norm += x_i;
            }
        }

        norm
    }
}

/// Are two numbers equal? The comparison refines copies, the numbers stay as they are.
pub(super) fn equal_values(a: &Algebraic, b: &Algebraic) -> bool {
    a.clone().equals(&mut b.clone())
}

/// lo <= value <= hi? The comparison refines a copy, the number stays as it is.
pub fn is_between(value: &Algebraic, lo: &Rational, hi: &Rational) -> bool {
    let mut value = value.clone();
    value.cmp_rational(lo).is_ge() && value.cmp_rational(hi).is_le()
}
