//! Polynomials with integer coefficients: arithmetic and evaluation. Division lives in `poly_gcd`.
//!
//! p(t) = c_0 + c_1 t + ... + c_n t^n is the list (c_0, ..., c_n) with c_n != 0; zero is the empty
//! list. Values at a rational u/v are computed without fractions, by Horner's rule for
//! v^n p(u/v) = sum c_i u^i v^(n-i); as v > 0, its sign is that of p(u/v).
//!
//! Called by everything in this crate that has an unknown t in it.

use super::{Integer, Rational, cleared, common_denominator};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

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
    pub fn new(coeffs: Vec<Integer>) -> Self {
        let mut p = Poly { coeffs };
        p.drop_leading_zeros();
        p
    }

    fn drop_leading_zeros(&mut self) {
        while self.coeffs.last().is_some_and(Zero::is_zero) {
            self.coeffs.pop();
        }
    }

    /// [`Poly::new`] from machine integers.
    pub fn from_ints(coeffs: &[i64]) -> Self {
        Poly::new(coeffs.iter().map(|&c| c.into()).collect())
    }

    /// The least positive integer multiple of a rational polynomial that is integral.
    pub fn from_rationals(coeffs: &[Rational]) -> Self {
        let clear = common_denominator(coeffs);
        Poly::new(coeffs.iter().map(|c| cleared(c, &clear)).collect())
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
        let value = self.homogeneous_value(t);
        Rational::new(value.numerator, value.denominator)
    }

    /// Sign (-1, 0, 1) at a rational point; no fraction is ever reduced.
    pub fn sign_at(&self, t: &Rational) -> i8 {
        sign(&self.homogeneous_value(t).numerator)
    }

    /// p(u/v) as a fraction over v^n, for t = u/v.
    fn homogeneous_value(&self, t: &Rational) -> HomogeneousValue {
        let u = t.numer();
        let v = t.denom();
        let mut numerator = self.leading();
        let mut denominator = Integer::one();

        for c in self.coeffs.iter().rev().skip(1) {
            denominator *= v;
            numerator = numerator * u + c * &denominator;
        }

        HomogeneousValue {
            numerator,
            denominator,
        }
    }

    /// The derivative.
    pub fn derivative(&self) -> Poly {
        let powers = self.coeffs.iter().enumerate().skip(1);
        Poly::new(powers.map(|(i, c)| c * i).collect())
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
        let mut divisor = self.content();
        if self.leading().is_negative() {
            divisor = -divisor;
        }

        if divisor.is_zero() || divisor.is_one() {
            return self.clone();
        }

        self.divided_by(&divisor)
    }

    /// Divided by its content, the sign left as it is.
    pub(super) fn divided_by_content(&self) -> Poly {
        let content = self.content();
        if content.is_zero() || content.is_one() {
            return self.clone();
        }
        self.divided_by(&content)
    }

    /// Every coefficient divided by a divisor of all of them.
    pub(super) fn divided_by(&self, divisor: &Integer) -> Poly {
        Poly::new(self.coeffs.iter().map(|c| c / divisor).collect())
    }

    /// Every coefficient times `factor`.
    pub fn scale(&self, factor: &Integer) -> Poly {
        Poly::new(self.coeffs.iter().map(|c| c * factor).collect())
    }

    /// The polynomial at -t.
    ///
    /// ```
    /// use mceip_exact::Poly;
    /// let p = Poly::from_ints(&[1, 2, 3]);
    /// assert_eq!(p.reflected(), Poly::from_ints(&[1, -2, 3]));
    /// ```
    pub fn reflected(&self) -> Poly {
        let mut coeffs = self.coeffs.clone();
        for odd in coeffs.iter_mut().skip(1).step_by(2) {
            *odd = -&*odd;
        }
        Poly::new(coeffs)
    }

    /// Times `t^k`.
    pub fn shift(&self, k: usize) -> Poly {
        let mut coeffs = vec![Integer::zero(); k];
        coeffs.extend(self.coeffs.iter().cloned());
        Poly::new(coeffs)
    }
}

/// numerator / denominator, not reduced; the denominator is positive.
struct HomogeneousValue {
    numerator: Integer,
    denominator: Integer,
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
        if self.coeffs.len() < other.coeffs.len() {
            return other + self;
        }

        let mut sum = self.clone();
        sum += other;

        sum
    }
}

impl AddAssign<&Poly> for Poly {
    fn add_assign(&mut self, other: &Poly) {
        if self.coeffs.len() < other.coeffs.len() {
            self.coeffs.resize(other.coeffs.len(), Integer::zero());
        }

        for (c, other_c) in self.coeffs.iter_mut().zip(&other.coeffs) {
            *c += other_c;
        }

        self.drop_leading_zeros();
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
        let mut difference = self.coeffs.clone();
        if difference.len() < other.coeffs.len() {
            difference.resize(other.coeffs.len(), Integer::zero());
        }

        for (c, other_c) in difference.iter_mut().zip(&other.coeffs) {
            *c -= other_c;
        }

        Poly::new(difference)
    }
}

impl Mul for &Poly {
    type Output = Poly;

    fn mul(self, other: &Poly) -> Poly {
        if self.is_zero() || other.is_zero() {
            return Poly::default();
        }

        let mut product = vec![Integer::zero(); self.coeffs.len() + other.coeffs.len() - 1];
        for (i, a) in self.coeffs.iter().enumerate() {
            for (j, b) in other.coeffs.iter().enumerate() {
                product[i + j] += a * b;
            }
        }

        Poly::new(product)
    }
}

/// The highest power first: `3 t^2-1 t+5`.
impl std::fmt::Display for Poly {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.is_zero() {
            return write!(f, "0");
        }

        for (power, c) in self.coeffs.iter().enumerate().rev() {
            if c.is_zero() {
                continue;
            }
            let is_first = power + 1 == self.coeffs.len();
            if !is_first && c.is_positive() {
                write!(f, "+")?;
            }
            match power {
                0 => write!(f, "{c}")?,
                1 => write!(f, "{c} t")?,
                _ => write!(f, "{c} t^{power}")?,
            }
        }

        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    #[test]
    fn arithmetic_and_evaluation_agree() {
        let p = Poly::from_ints(&[1, -3, 2]);
        let q = Poly::from_ints(&[0, 5]);

        for t in [rational(-2, 3), whole(0), rational(7, 5)] {
            assert_eq!((&p * &q).eval(&t), p.eval(&t) * q.eval(&t));
            assert_eq!((&p - &q).eval(&t), p.eval(&t) - q.eval(&t));
            assert_eq!((&q - &p).eval(&t), q.eval(&t) - p.eval(&t));
            assert_eq!((&q + &p).eval(&t), q.eval(&t) + p.eval(&t));
            assert_eq!(p.sign_at(&t), sign(p.eval(&t).numer()));
        }

        assert_eq!(p.derivative(), Poly::from_ints(&[-3, 4]));
        assert_eq!((&p - &p).degree(), None);
        assert_eq!((&p + &-&p).degree(), None);
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
