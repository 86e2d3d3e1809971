//! Polynomials with integer coefficients: arithmetic and evaluation. Division lives in `poly_gcd`.

use super::{Integer, Rational, common_denominator};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// A polynomial over Z, coefficients from the constant term up, no trailing zeros.
///
/// Polynomials over Q enter as integer multiples ([`Poly::from_rationals`]): roots and signs at a
/// point need no more.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub struct Poly {
    coeffs: Vec<Integer>,
}

impl Poly {
    /// The polynomial with these coefficients, constant term first.
    ///
    /// ```
    /// use mceip_exact::{Poly, rational};
    /// let p = Poly::from_ints(&[-2, 0, 1]); // t^2 - 2
    /// assert_eq!(p.degree(), Some(2));
    /// assert_eq!(p.eval(&rational(3, 2)), rational(1, 4));
    /// ```
    pub fn new(mut coeffs: Vec<Integer>) -> Self {
        while coeffs.last().is_some_and(Zero::is_zero) {
            coeffs.pop();
        }
        Poly { coeffs }
    }

    /// [`Poly::new`] from machine integers.
    pub fn from_ints(coeffs: &[i64]) -> Self {
        Poly::new(coeffs.iter().map(|&c| c.into()).collect())
    }

    /// The least positive integer multiple of a rational polynomial that is integral.
    pub fn from_rationals(coeffs: &[Rational]) -> Self {
        let m = common_denominator(coeffs);
        Poly::new(
            coeffs
                .iter()
                .map(|c| c.numer() * (&m / c.denom()))
                .collect(),
        )
    }

    /// The constant polynomial `c`.
    pub fn constant(c: Integer) -> Self {
        Poly::new(vec![c])
    }

    /// `denominator * t - numerator`: the primitive polynomial with this one root.
    pub fn linear_root(root: &Rational) -> Self {
        Poly::new(vec![-root.numer().clone(), root.denom().clone()])
    }

    /// Coefficients from the constant term up.
    pub fn coeffs(&self) -> &[Integer] {
        &self.coeffs
    }

    /// The degree; `None` for the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.coeffs.len().checked_sub(1)
    }

    /// Is this the zero polynomial?
    pub fn is_zero(&self) -> bool {
        self.coeffs.is_empty()
    }

    /// The leading coefficient, zero for the zero polynomial.
    pub fn leading(&self) -> Integer {
        self.coeffs.last().cloned().unwrap_or_default()
    }

    /// Value at a rational point (Horner on numerator and denominator, one division at the end).
    pub fn eval(&self, t: &Rational) -> Rational {
        let (value, scale) = self.eval_homogeneous(t);
        Rational::new(value, scale)
    }

    /// Sign (-1, 0, 1) at a rational point; no fraction is ever reduced.
    pub fn sign_at(&self, t: &Rational) -> i8 {
        sign(&self.eval_homogeneous(t).0)
    }

    /// `(sum c_i u^i v^(n-i), v^n)` at t = u/v, v > 0.
    fn eval_homogeneous(&self, t: &Rational) -> (Integer, Integer) {
        let (u, v) = (t.numer(), t.denom());
        let mut scale = Integer::one();
        let mut value = Integer::zero();
        for c in self.coeffs.iter().rev() {
            value = value * u + c * &scale;
            scale *= v;
        }
        // One factor v too many: value belongs to v^(n), scale ran to v^(n+1).
        let scale = if self.coeffs.is_empty() {
            Integer::one()
        } else {
            scale / v
        };
        (value, scale)
    }

    /// The derivative.
    pub fn derivative(&self) -> Poly {
        Poly::new(
            self.coeffs
                .iter()
                .enumerate()
                .skip(1)
                .map(|(i, c)| c * i)
                .collect(),
        )
    }

    /// Greatest common divisor of the coefficients, zero for the zero polynomial.
    pub fn content(&self) -> Integer {
        let mut content = Integer::zero();
        for c in &self.coeffs {
            content = content.gcd(c);
            if content.is_one() {
                break;
            }
        }
        content
    }

    /// Divided by its content, leading coefficient made positive.
    pub fn primitive(&self) -> Poly {
        let g = if self.leading().is_negative() {
            -self.content()
        } else {
            self.content()
        };
        if g.is_zero() || g.is_one() {
            self.clone()
        } else {
            Poly::new(self.coeffs.iter().map(|c| c / &g).collect())
        }
    }

    /// Every coefficient times `factor`.
    pub fn scale(&self, factor: &Integer) -> Poly {
        Poly::new(self.coeffs.iter().map(|c| c * factor).collect())
    }

    /// Times `t^k`.
    pub fn shift(&self, k: usize) -> Poly {
        let mut coeffs = vec![Integer::zero(); k];
        coeffs.extend(self.coeffs.iter().cloned());
        Poly::new(coeffs)
    }
}

/// Sign of an integer as -1, 0 or 1.
pub(super) fn sign(value: &Integer) -> i8 {
    match value.sign() {
        num_bigint::Sign::Minus => -1,
        num_bigint::Sign::NoSign => 0,
        num_bigint::Sign::Plus => 1,
    }
}

impl Add for &Poly {
    type Output = Poly;
    fn add(self, other: &Poly) -> Poly {
        let n = self.coeffs.len().max(other.coeffs.len());
        let at = |p: &Poly, i: usize| p.coeffs.get(i).cloned().unwrap_or_default();
        Poly::new((0..n).map(|i| at(self, i) + at(other, i)).collect())
    }
}

impl Neg for &Poly {
    type Output = Poly;
    fn neg(self) -> Poly {
        Poly::new(self.coeffs.iter().map(|c| -c).collect())
    }
}

impl Sub for &Poly {
    type Output = Poly;
    fn sub(self, other: &Poly) -> Poly {
        self + &-other
    }
}

impl Mul for &Poly {
    type Output = Poly;
    fn mul(self, other: &Poly) -> Poly {
        if self.is_zero() || other.is_zero() {
            return Poly::default();
        }
        let mut coeffs = vec![Integer::zero(); self.coeffs.len() + other.coeffs.len() - 1];
        for (i, a) in self.coeffs.iter().enumerate() {
            for (j, b) in other.coeffs.iter().enumerate() {
                coeffs[i + j] += a * b;
            }
        }
        Poly::new(coeffs)
    }
}

impl std::fmt::Display for Poly {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut first = true;
        for (i, c) in self
            .coeffs
            .iter()
            .enumerate()
            .rev()
            .filter(|(_, c)| !c.is_zero())
        {
            let sign = if c.is_negative() {
                "-"
            } else if first {
                ""
            } else {
                "+"
            };
            match (i, c.abs()) {
                (0, c) => write!(f, "{sign}{c}")?,
                (1, c) => write!(f, "{sign}{c} t")?,
                (_, c) => write!(f, "{sign}{c} t^{i}")?,
            }
            first = false;
        }
        if first { write!(f, "0") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    #[test]
    fn arithmetic_and_evaluation_agree() {
        let (p, q) = (Poly::from_ints(&[1, -3, 2]), Poly::from_ints(&[0, 5]));
        for t in [rational(-2, 3), whole(0), rational(7, 5)] {
            assert_eq!((&p * &q).eval(&t), p.eval(&t) * q.eval(&t));
            assert_eq!((&p - &q).eval(&t), p.eval(&t) - q.eval(&t));
            assert_eq!(
                i64::from(p.sign_at(&t)),
                i64::from(sign(p.eval(&t).numer()))
            );
        }
        assert_eq!(p.derivative(), Poly::from_ints(&[-3, 4]));
        assert_eq!((&p - &p).degree(), None);
    }

    #[test]
    fn primitive_part_has_positive_lead_and_content_one() {
        assert_eq!(
            Poly::from_ints(&[4, 0, -6]).primitive(),
            Poly::from_ints(&[-2, 0, 3])
        );
        assert_eq!(
            Poly::from_rationals(&[rational(1, 2), rational(-1, 3)]),
            Poly::from_ints(&[3, -2])
        );
    }

    #[test]
    fn prints_highest_power_first() {
        assert_eq!(Poly::from_ints(&[-2, 0, 1]).to_string(), "1 t^2-2");
        assert_eq!(Poly::default().to_string(), "0");
    }
}
