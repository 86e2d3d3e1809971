//! The rational type: num-rational's arithmetic, comparisons by one product on each side, and sums
//! and products of dyadic numbers by shifts.
//!
//! p/q < r/s where p s < r q, since denominators are positive. A dyadic number is p / 2^k, as every
//! double is: sums and products of two are brought to lowest terms by counting zeros, where other
//! rationals need a greatest common divisor. Sums with 0 and products with 1 or -1 need neither.
//!
//! Called by everything: this is the only type of rationals in the workspace. Reading and spelling
//! rationals is in `rational`.
//!
//! num-rational compares by continued fractions instead, with one recursive step for each term. Two
//! long numbers that lie close together have about as many terms as bits, so that a file of a
//! hundred kilobytes overflowed the stack.

use super::Integer;
use num_rational::BigRational;
use num_traits::{Num, One, Signed, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, Sub, SubAssign};
use std::str::FromStr;

/// An arbitrary-precision rational in lowest terms. The only rational type of the project:
/// fixed-width rationals overflow silently to zero denominators.
#[derive(Clone, Default)]
pub struct Rational(BigRational);

impl Rational {
    /// p / q in lowest terms, q > 0. Panics if q = 0.
    pub fn new(numer: Integer, denom: Integer) -> Rational {
        Rational(BigRational::new(numer, denom))
    }

    /// p / q as given: q > 0 and without a common factor, or used for nothing but its value.
    pub const fn new_raw(numer: Integer, denom: Integer) -> Rational {
        Rational(BigRational::new_raw(numer, denom))
    }

    /// p / 1.
    pub fn from_integer(value: Integer) -> Rational {
        Rational(BigRational::from_integer(value))
    }

    /// The rational that a finite double is; `None` for the others.
    pub fn from_float<F: num_traits::float::FloatCore>(value: F) -> Option<Rational> {
        BigRational::from_float(value).map(Rational)
    }

    /// The numerator.
    pub const fn numer(&self) -> &Integer {
        self.0.numer()
    }

    /// The denominator, positive.
    pub const fn denom(&self) -> &Integer {
        self.0.denom()
    }

    /// In lowest terms.
    pub fn reduced(&self) -> Rational {
        Rational(self.0.reduced())
    }

    /// 1 / self. Panics if self = 0.
    pub fn recip(&self) -> Rational {
        Rational(self.0.recip())
    }

    /// self^exponent. Panics if self = 0 and the exponent is negative.
    pub fn pow(&self, exponent: i32) -> Rational {
        Rational(self.0.pow(exponent))
    }

    /// Is the denominator 1?
    pub fn is_integer(&self) -> bool {
        self.0.is_integer()
    }

    /// Rounded towards zero.
    pub fn to_integer(&self) -> Integer {
        self.0.to_integer()
    }

    /// The largest integer that is not above.
    pub fn floor(&self) -> Rational {
        Rational::from_integer(num_integer::Integer::div_floor(self.numer(), self.denom()))
    }

    /// The smallest integer that is not below.
    pub fn ceil(&self) -> Rational {
        Rational::from_integer(num_integer::Integer::div_ceil(self.numer(), self.denom()))
    }

    /// The nearest integer, halves away from zero.
    pub fn round(&self) -> Rational {
        Rational(self.0.round())
    }

    /// Rounded towards zero.
    pub fn trunc(&self) -> Rational {
        Rational::from_integer(self.to_integer())
    }
}

/// Numerators of two dyadic numbers over their common denominator, 2^`exponent`.
struct Dyadics {
    first: Integer,
    second: Integer,
    exponent: u64,
}

impl Dyadics {
    /// `None` if one of them is not dyadic.
    fn of(a: &Rational, b: &Rational) -> Option<Dyadics> {
        let [p, q] = [binary_exponent(a.denom())?, binary_exponent(b.denom())?];
        let exponent = p.max(q);
        let over_common = |v: &Rational, own: u64| match exponent - own {
            0 => v.numer().clone(),
            shift => v.numer() << shift,
        };

        Some(Dyadics {
            first: over_common(a, p),
            second: over_common(b, q),
            exponent,
        })
    }
}

/// k of a denominator 2^k.
fn binary_exponent(denom: &Integer) -> Option<u64> {
    let k = denom.trailing_zeros()?;
    (denom.bits() == k + 1).then_some(k)
}

/// p / 2^exponent in lowest terms.
fn dyadic(p: Integer, exponent: u64) -> Rational {
    let zeros = p.trailing_zeros().unwrap_or(exponent);
    match zeros.min(exponent) {
        0 => Rational::new_raw(p, Integer::one() << exponent),
        common => Rational::new_raw(p >> common, Integer::one() << (exponent - common)),
    }
}

/// Is it 1 or -1?
fn is_unit(v: &Rational) -> bool {
    v.denom().is_one() && v.numer().magnitude().is_one()
}

/// `v` or -`v`, with the sign of `unit`.
fn with_sign(v: &Rational, unit: &Rational) -> Rational {
    if unit.is_negative() { -v } else { v.clone() }
}

fn sum(a: &Rational, b: &Rational) -> Rational {
    if a.is_zero() {
        return b.clone();
    }
    if b.is_zero() {
        return a.clone();
    }

    match Dyadics::of(a, b) {
        Some(both) => dyadic(both.first + both.second, both.exponent),
        None => Rational(&a.0 + &b.0),
    }
}

fn difference(a: &Rational, b: &Rational) -> Rational {
    match Dyadics::of(a, b) {
        Some(both) => dyadic(both.first - both.second, both.exponent),
        None => Rational(&a.0 - &b.0),
    }
}

fn product(a: &Rational, b: &Rational) -> Rational {
    if is_unit(a) {
        return with_sign(b, a);
    }
    if is_unit(b) {
        return with_sign(a, b);
    }

    match (binary_exponent(a.denom()), binary_exponent(b.denom())) {
        (Some(p), Some(q)) => dyadic(a.numer() * b.numer(), p + q),
        _ => Rational(&a.0 * &b.0),
    }
}

fn quotient(a: &Rational, b: &Rational) -> Rational {
    Rational(&a.0 / &b.0)
}

/// A decimal or a fraction, as [`parse`](super::parse) reads it: "1.1" is 11/10.
impl FromStr for Rational {
    type Err = super::NumberError;

    fn from_str(text: &str) -> Result<Rational, Self::Err> {
        super::parse(text)
    }
}

impl From<Integer> for Rational {
    fn from(value: Integer) -> Rational {
        Rational::from_integer(value)
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        if self.denom() == other.denom() {
            return self.numer().cmp(other.numer());
        }

        let by_sign = self.numer().sign().cmp(&other.numer().sign());
        if by_sign != Ordering::Equal {
            return by_sign;
        }

        let left = self.numer() * other.denom();
        let right = other.numer() * self.denom();

        left.cmp(&right)
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Rational {
    fn eq(&self, other: &Rational) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Rational {}

impl Hash for Rational {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let reduced = self.0.reduced();
        reduced.numer().hash(state);
        reduced.denom().hash(state);
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// An operator for values and references of rationals, and with an integer on the right.
macro_rules! operator {
    ($trait:ident, $method:ident, $assign:ident, $assign_method:ident, $of:ident) => {
        impl $trait<Rational> for Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $of(&self, &other)
            }
        }

        impl $trait<&Rational> for Rational {
            type Output = Rational;

            fn $method(self, other: &Rational) -> Rational {
                $of(&self, other)
            }
        }

        impl $trait<Rational> for &Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $of(self, &other)
            }
        }

        impl $trait<&Rational> for &Rational {
            type Output = Rational;

            fn $method(self, other: &Rational) -> Rational {
                $of(self, other)
            }
        }

        impl $trait<Integer> for Rational {
            type Output = Rational;

            fn $method(self, other: Integer) -> Rational {
                Rational(self.0.$method(other))
            }
        }

        impl $trait<&Integer> for Rational {
            type Output = Rational;

            fn $method(self, other: &Integer) -> Rational {
                Rational(self.0.$method(other))
            }
        }

        impl $trait<Integer> for &Rational {
            type Output = Rational;

            fn $method(self, other: Integer) -> Rational {
                Rational((&self.0).$method(other))
            }
        }

        impl $trait<&Integer> for &Rational {
            type Output = Rational;

            fn $method(self, other: &Integer) -> Rational {
                Rational((&self.0).$method(other))
            }
        }

        impl $assign<Rational> for Rational {
            fn $assign_method(&mut self, other: Rational) {
                *self = $of(self, &other);
            }
        }

        impl $assign<&Rational> for Rational {
            fn $assign_method(&mut self, other: &Rational) {
                *self = $of(self, other);
            }
        }

        impl $assign<Integer> for Rational {
            fn $assign_method(&mut self, other: Integer) {
                self.0.$assign_method(other);
            }
        }

        impl $assign<&Integer> for Rational {
            fn $assign_method(&mut self, other: &Integer) {
                self.0.$assign_method(other);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign, sum);
operator!(Sub, sub, SubAssign, sub_assign, difference);
operator!(Mul, mul, MulAssign, mul_assign, product);
operator!(Div, div, DivAssign, div_assign, quotient);

impl Neg for Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        Rational(-self.0)
    }
}

impl Neg for &Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        Rational(-&self.0)
    }
}

impl Rem for Rational {
    type Output = Rational;

    fn rem(self, other: Rational) -> Rational {
        Rational(self.0 % other.0)
    }
}

impl Zero for Rational {
    fn zero() -> Rational {
        Rational(BigRational::zero())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl One for Rational {
    fn one() -> Rational {
        Rational(BigRational::one())
    }
}

impl Num for Rational {
    type FromStrRadixErr = num_rational::ParseRatioError;

    fn from_str_radix(text: &str, radix: u32) -> Result<Rational, Self::FromStrRadixErr> {
        BigRational::from_str_radix(text, radix).map(Rational)
    }
}

impl Signed for Rational {
    fn abs(&self) -> Rational {
        Rational(self.0.abs())
    }

    fn abs_sub(&self, other: &Rational) -> Rational {
        if self <= other {
            Rational::zero()
        } else {
            self - other
        }
    }

    fn signum(&self) -> Rational {
        Rational(self.0.signum())
    }

    fn is_positive(&self) -> bool {
        self.0.is_positive()
    }

    fn is_negative(&self) -> bool {
        self.0.is_negative()
    }
}

impl Sum for Rational {
    fn sum<I: Iterator<Item = Rational>>(values: I) -> Rational {
        let mut sum = Rational::zero();
        values.for_each(|v| sum += v);
        sum
    }
}

impl<'a> Sum<&'a Rational> for Rational {
    fn sum<I: Iterator<Item = &'a Rational>>(values: I) -> Rational {
        let mut sum = Rational::zero();
        values.for_each(|v| sum += v);
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(p: i64, q: i64) -> Rational {
        Rational::new(p.into(), q.into())
    }

    #[test]
    fn the_order_is_that_of_the_products() {
        let ascending = [
            of(-3, 2),
            of(-4, 3),
            of(-1, 1000),
            of(0, 1),
            of(1, 3),
            of(333, 998),
            of(1, 2),
            of(2, 1),
        ];

        for (i, a) in ascending.iter().enumerate() {
            for (j, b) in ascending.iter().enumerate() {
                assert_eq!(a.cmp(b), i.cmp(&j), "{a} {b}");
            }
        }

        assert_eq!(Rational::new_raw(2.into(), 4.into()), of(1, 2));
    }

    /// No numbers of their length have continued fractions with more terms than quotients of
    /// Fibonacci numbers.
    #[test]
    fn close_and_long_numbers_are_compared_without_a_stack() {
        let mut a = Integer::one();
        let mut b = Integer::one();

        for _ in 0..200_000 {
            let next = &a + &b;
            a = std::mem::replace(&mut b, next);
        }

        let next = &a + &b;
        let one = Rational::new_raw(b.clone(), a);
        let other = Rational::new_raw(next, b);

        assert_ne!(one, other);
        assert_eq!(one.cmp(&other), other.cmp(&one).reverse());
    }

    /// Dyadic or not: as num-rational computes, in lowest terms.
    #[test]
    fn arithmetic_is_that_of_num_rational() {
        let long = Integer::from(3).pow(200);
        let mut numbers = vec![Rational::zero()];
        for denom in [1, 2, 3, 4, 6, 64] {
            for numer in [-64, -12, -3, -1, 1, 5, 8] {
                numbers.push(of(numer, denom));
            }
            numbers.push(Rational::new(long.clone(), Integer::from(denom).pow(90)));
        }

        for a in &numbers {
            for b in &numbers {
                assert_same(a + b, &a.0 + &b.0);
                assert_same(a - b, &a.0 - &b.0);
                assert_same(a * b, &a.0 * &b.0);
            }
        }
    }

    #[track_caller]
    fn assert_same(got: Rational, expected: BigRational) {
        let expected = expected.reduced();
        assert_eq!(got.numer(), expected.numer());
        assert_eq!(got.denom(), expected.denom());
    }

    #[test]
    fn floors_and_ceilings_round_towards_their_side() {
        for (v, floor, ceil) in [
            (of(7, 2), 3, 4),
            (of(-7, 2), -4, -3),
            (of(6, 2), 3, 3),
            (of(-1, 9), -1, 0),
        ] {
            assert_eq!([v.floor(), v.ceil()], [of(floor, 1), of(ceil, 1)], "{v}");
        }
    }
}
