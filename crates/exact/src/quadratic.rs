//! Numbers a + b sqrt(d) with rational a, b, d: the field in which Table 1 is exact.
//!
//! ```text
//! (a + b sqrt d) + (a' + b' sqrt d) = (a + a') + (b + b') sqrt d
//! (a + b sqrt d) (a' + b' sqrt d)   = (a a' + b b' d) + (a b' + b a') sqrt d
//! ```
//!
//! The sign of a + b sqrt(d) is that of the term of larger absolute value, found by comparing a^2
//! with b^2 d. Nothing is approximated.
//!
//! Called by `mceip_oracle::table1` and by what compares other answers with that table.

use super::{Poly, Rational, Sign};
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// The real number `a + b * sqrt(d)`, d >= 0.
///
/// Two operands of an operation must have the same `d`; `d` may be a perfect square.
#[derive(Debug, Clone)]
pub struct Quadratic {
    a: Rational,
    b: Rational,
    d: Rational,
}

impl Quadratic {
    /// `a + b sqrt(d)`, or `None` if d < 0.
    pub fn new(a: Rational, b: Rational, d: Rational) -> Option<Self> {
        (!d.is_negative()).then_some(Quadratic { a, b, d })
    }

    /// The rational `a` on its own (radicand 0).
    pub fn embed_rational(a: Rational) -> Self {
        Quadratic {
            a,
            b: Rational::zero(),
            d: Rational::zero(),
        }
    }

    /// The rational `a`, living beside numbers with the radicand `d` of `self`.
    pub fn embed(&self, a: Rational) -> Self {
        Quadratic {
            a,
            b: Rational::zero(),
            d: self.d.clone(),
        }
    }

    /// The rational value of a number without a radical part.
    pub fn as_rational(&self) -> Option<Rational> {
        let has_no_radical = self.b.is_zero() || self.d.is_zero();
        has_no_radical.then(|| self.a.clone())
    }

    /// Sum. The radicands must be equal.
    pub fn add(&self, other: &Self) -> Self {
        debug_assert_eq!(self.d, other.d);
        Quadratic {
            a: &self.a + &other.a,
            b: &self.b + &other.b,
            d: self.d.clone(),
        }
    }

    /// Product. The radicands must be equal.
    pub fn mul(&self, other: &Self) -> Self {
        debug_assert_eq!(self.d, other.d);
        Quadratic {
            a: &self.a * &other.a + &self.b * &other.b * &self.d,
            b: &self.a * &other.b + &self.b * &other.a,
            d: self.d.clone(),
        }
    }

    /// Product with a rational.
    pub fn scale(&self, factor: &Rational) -> Self {
        Quadratic {
            a: &self.a * factor,
            b: &self.b * factor,
            d: self.d.clone(),
        }
    }

    /// The exact sign: compares a^2 with b^2 d where the two terms oppose each other.
    pub fn sign(&self) -> Sign {
        let square_of_a = &self.a * &self.a;
        let square_of_root_term = &self.b * &self.b * &self.d;

        match square_of_a.cmp(&square_of_root_term) {
            Ordering::Greater => sign_of(&self.a),
            Ordering::Less => sign_of(&self.b),
            // The terms cancel, or they have one sign, or both are zero (b may not be:
            // 0 + 1 sqrt 0).
            Ordering::Equal if (&self.a * &self.b).is_negative() => Sign::Zero,
            Ordering::Equal => sign_of(&self.a),
        }
    }

    /// The value of an integer polynomial at this number, by Horner's rule.
    pub fn eval(&self, p: &Poly) -> Self {
        let mut value = self.embed(Rational::zero());
        for coefficient in p.coeffs().iter().rev() {
            let coefficient = Rational::from_integer(coefficient.clone());
            value = value.mul(self).add(&self.embed(coefficient));
        }

        value
    }

    /// Is the number in the closed interval [lo, hi]?
    pub fn within(&self, lo: &Rational, hi: &Rational) -> bool {
        let above_lo = self.add(&self.embed(-lo));
        let above_hi = self.add(&self.embed(-hi));

        let is_at_least_lo = above_lo.sign() != Sign::Negative;
        let is_at_most_hi = above_hi.sign() != Sign::Positive;
        is_at_least_lo && is_at_most_hi
    }
}

fn sign_of(value: &Rational) -> Sign {
    match value.cmp(&Rational::zero()) {
        Ordering::Less => Sign::Negative,
        Ordering::Equal => Sign::Zero,
        Ordering::Greater => Sign::Positive,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    fn number(a: i64, b: i64, d: i64) -> Quadratic {
        Quadratic::new(whole(a), whole(b), whole(d)).unwrap()
    }

    #[test]
    fn signs_of_near_misses() {
        assert_eq!(number(-3, 2, 2).sign(), Sign::Negative); // 2 sqrt 2 = 2.828
        assert_eq!(number(-28, 20, 2).sign(), Sign::Positive);
        assert_eq!(number(-6, 2, 9).sign(), Sign::Zero); // sqrt 9 = 3, d a square
        assert_eq!(number(0, 0, 5).sign(), Sign::Zero);
        assert_eq!(number(0, 1, 0).sign(), Sign::Zero); // sqrt 0, whatever its factor
        assert_eq!(number(0, -1, 0).sign(), Sign::Zero);
        assert_eq!(number(2, -3, 0).sign(), Sign::Positive);
        assert_eq!(number(-1, -1, 5).sign(), Sign::Negative);
        // Parts of equal size, 2 and sqrt 4, on one side and on both.
        for (a, b, sign) in [
            (2, 1, Sign::Positive),
            (-2, -1, Sign::Negative),
            (2, -1, Sign::Zero),
            (-2, 1, Sign::Zero),
        ] {
            assert_eq!(number(a, b, 4).sign(), sign, "{a} {b}");
        }

        assert!(Quadratic::new(whole(0), whole(1), whole(-1)).is_none());
    }

    #[test]
    fn minimal_polynomial_vanishes_only_here() {
        let golden = Quadratic::new(rational(1, 2), rational(1, 2), whole(5)).unwrap();
        assert_eq!(
            golden.eval(&Poly::from_ints(&[-1, -1, 1])).sign(),
            Sign::Zero
        );

        assert_eq!(
            golden.eval(&Poly::from_ints(&[-1, -1, 2])).sign(),
            Sign::Positive
        );

        assert!(
            golden.within(&rational(8, 5), &rational(17, 10))
                && !golden.within(&whole(0), &rational(8, 5))
        );
    }

    #[test]
    fn scaled_and_rational_numbers() {
        let third = number(3, -6, 7).scale(&rational(1, 3));
        assert_eq!(third.add(&number(-1, 2, 7)).sign(), Sign::Zero);
        assert_eq!(
            [
                number(5, 0, 7).as_rational(),
                number(5, 1, 7).as_rational(),
                number(5, 1, 0).as_rational()
            ],
            [Some(whole(5)), None, Some(whole(5))]
        );
    }
}
