//! The ends of an expansion in short numbers.
//!
//! The formulas are those of `expanded`, for the values
//!
//! ```text
//!     Z(d) = Z_0 + d (Z_1 + d (Z_2 + ...)),
//! ```
//!
//! and for the radius, with all numbers rounded up,
//!
//! ```text
//!     (hi - lo)^2 / 8 sum_k k (k - 1) |Z_k| reach^(k - 2)  +  the remainders,
//! ```
//!
//! in matrices with radii of their own for what rounding has cost (`short`). Vectors are computed
//! in long integers. Every entry holds the one of `expanded` with its radius, and is wider by about
//! 2^-58 of the largest entry: what is proved of these ends is proved of those of `expanded`, and
//! leaves that they do not prove are decided by the long ones. Called by `family`.

use super::Expanded;
use crate::cover::ends::FRACTION_BITS;
use crate::cover::short::Short;
use mceip_exact::{Integer, Rational};
use num_traits::Signed;

/// A long end is rounded down to a unit of 2^-128, its radius rounded up and enlarged by a unit for
/// that: one unit of Z(d), two of a chord, two of the remainders and one for their sum. So long
/// ends are wider by less than this than the numbers before rounding, which short ones enclose.
pub(super) const LONG_ROUNDING: i64 = 6;

/// The short numbers of an expansion, in the fixed unit.
pub(in crate::cover) enum ShortForm {
    /// The constant and the direction of a family that is linear in t, remainders included.
    Linear([Short; 2]),
    /// Any other.
    Polynomial(ShortPolynomial),
}

/// Z(d) in short numbers.
pub(in crate::cover) struct ShortPolynomial {
    /// Z_k, for k from 0.
    values: Vec<Short>,
    /// Zero within k (k - 1) |Z_k|, for k from 2.
    bend: Vec<Short>,
}

impl ShortForm {
    pub(in crate::cover) fn of(expanded: &Expanded) -> Option<ShortForm> {
        if let Some(parts) = expanded.short() {
            return Some(ShortForm::Linear(parts));
        }

        ShortPolynomial::of(expanded).map(ShortForm::Polynomial)
    }

    /// The ends over [lo, hi] (`None`: infinity) of the expansion that this is the form of.
    pub(in crate::cover) fn ends(
        &self,
        expanded: &Expanded,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Option<[Short; 2]> {
        match self {
            ShortForm::Linear(parts) => Short::linear_ends(parts, lo, hi),
            ShortForm::Polynomial(polynomial) => polynomial.ends(expanded, lo, hi),
        }
    }
}

impl ShortPolynomial {
    fn of(expanded: &Expanded) -> Option<ShortPolynomial> {
        let mut values = Vec::with_capacity(expanded.z.len());
        let mut bend = Vec::with_capacity(expanded.z.len());

        for (k, z_k) in expanded.z.iter().enumerate() {
            let mut value = Short::quotient(z_k, &expanded.unit)?;
            if k == 0 {
                let rounding = Short::around_zero(z_k.len(), LONG_ROUNDING);
                value = value.plus(&rounding)?;
            }

            if k >= 2 {
                let falling = Rational::from_integer(Integer::from(k * (k - 1)));
                bend.push(value.within_multiple(&falling)?);
            }

            values.push(value);
        }

        Some(ShortPolynomial { values, bend })
    }

    /// The ends over [lo, hi]; none over a half line, unless the expansion is reversed.
    fn ends(
        &self,
        expanded: &Expanded,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Option<[Short; 2]> {
        let (own_lo, own_hi) = expanded.own_interval(lo, hi).ok()?;
        let d0 = &own_lo - &expanded.center;
        let d1 = own_hi? - &expanded.center;
        let radius = self.radius(expanded, &own_lo, [&d0, &d1])?;

        let lower = value_at(&self.values, &d0)?.plus(&radius)?;
        let upper = value_at(&self.values, &d1)?.plus(&radius)?;
        if expanded.reversed {
            Some([upper, lower])
        } else {
            Some([lower, upper])
        }
    }

    /// Zero within an eighth of the bend and the remainders, for d0 <= d <= d1.
    fn radius(
        &self,
        expanded: &Expanded,
        own_lo: &Rational,
        [d0, d1]: [&Rational; 2],
    ) -> Option<Short> {
        let width = d1 - d0;
        let reach = d0.abs().max(d1.abs());

        let factors = expanded.factors(0, &reach);
        let weight = expanded.weight_above(own_lo);
        let left = weighted(&factors.left, &weight);
        let remainder = Short::within_products(&left, &whole(factors.right))?;
        let left = weighted(&factors.v, &expanded.rounding_weight);
        let rounding = Short::within_products(&left, &whole(factors.rounding))?;
        let remainders = remainder.plus(&rounding)?;

        if self.bend.is_empty() {
            return Some(remainders);
        }

        let eighth = &width * &width / Integer::from(8);
        let bend = value_at(&self.bend, &reach)?;
        remainders.plus_multiple(&bend, &eighth)
    }
}

/// The sum of C_k x^k, for at least one coefficient C_k.
fn value_at(coefficients: &[Short], x: &Rational) -> Option<Short> {
    let (last, others) = coefficients.split_last()?;

    let mut value = last.clone();
    for coefficient in others.iter().rev() {
        value = coefficient.plus_multiple(&value, x)?;
    }

    Some(value)
}

/// weight_i left_i of factors in the fixed unit, such that the product with another factor in the
/// fixed unit is in the fixed unit. The fractions are not reduced.
fn weighted(left: &[Integer], weight: &[Rational]) -> Vec<Rational> {
    let mut products = Vec::with_capacity(left.len());
    for (l, w) in left.iter().zip(weight) {
        products.push(Rational::new_raw(l * w.numer(), w.denom() << FRACTION_BITS));
    }

    products
}

fn whole(values: Vec<Integer>) -> Vec<Rational> {
    values.into_iter().map(Rational::from_integer).collect()
}
