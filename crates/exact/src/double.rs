//! The border between doubles and rationals. The only file of `exact` that names `f64`;
//! it converts, it never computes with floats.
//!
//! A positive double is m 2^e with a mantissa m < 2^53 and e >= -1074; it has 53 bits unless e is
//! the lowest exponent (subnormal numbers). Read as integers, the 64 bits of the positive doubles
//! count them in ascending order (IEEE 754-2019, section 3.4).
//!
//! Called where solvers propose ([`from_f64`]) and where reports print or plot ([`to_f64`]).

use super::{Integer, Interval, NumberError, Rational};
use num_integer::Integer as _;
use num_traits::{FromPrimitive, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// The exact value of a finite double (a dyadic rational).
///
/// # Errors
/// [`NumberError::NotFinite`] for NaN and the infinities.
///
/// ```
/// use mceip_exact::{from_f64, parse};
/// assert_ne!(from_f64(1.1).unwrap(), parse("1.1").unwrap());
/// assert!(from_f64(f64::NAN).is_err());
/// ```
pub fn from_f64(value: f64) -> Result<Rational, NumberError> {
    Rational::from_float(value)
        .filter(|_| value.is_finite())
        .ok_or_else(|| NumberError::NotFinite {
            text: value.to_string(),
        })
}

/// A finite double without its fraction; `None` for NaN and the infinities.
///
/// ```
/// use mceip_exact::{truncated, whole};
/// assert_eq!(truncated(-7.9), Some(whole(-7).to_integer()));
/// assert_eq!(truncated(2f64.powi(70)), Some(whole(2).to_integer().pow(70)));
/// assert_eq!(truncated(f64::NAN), None);
/// ```
pub fn truncated(value: f64) -> Option<Integer> {
    Integer::from_f64(value)
}

/// The nearest double, ties to even; beyond the range of doubles the signed infinity.
///
/// Computed by integer division to 66 bits and a sticky bit, so it is the IEEE rounding of the
/// exact value (`num-rational`'s own conversion rounds twice).
pub fn to_f64(value: &Rational) -> f64 {
    if value.is_zero() {
        return 0.0;
    }

    let mut numerator = value.numer().abs();
    let mut denominator = value.denom().clone();

    // Scaled to a quotient of at least 66 bits, which with what the division leaves is rounded
    // once.
    let shift = 66 - (numerator.bits() as i64 - denominator.bits() as i64);
    if shift >= 0 {
        numerator <<= shift.unsigned_abs();
    } else {
        denominator <<= shift.unsigned_abs();
    }

    let (quotient, remainder) = numerator.div_rem(&denominator);
    let scaled = Scaled {
        quotient,
        is_inexact: !remainder.is_zero(),
        exponent: -shift,
    };

    let magnitude = scaled.nearest();
    let sign_bit = u64::from(value.is_negative()) << 63;

    f64::from_bits(magnitude.to_bits() + sign_bit)
}

/// `quotient * 2^exponent`, or more by less than one unit if inexact. The quotient has more than 53
/// bits.
struct Scaled {
    quotient: Integer,
    is_inexact: bool,
    exponent: i64,
}

impl Scaled {
    /// The nearest double, ties to even, rounded once.
    fn nearest(&self) -> f64 {
        let bits = self.quotient.bits() as i64;
        // Lowest exponent a bit of the result may have: subnormals stop at 2^-1074.
        let keep = 53.min(bits + self.exponent + 1074);
        let drop = bits - keep;

        let kept = &self.quotient >> drop as u64;
        let below = &self.quotient % (Integer::from(1) << drop as u64);
        let half = Integer::from(1) << (drop - 1) as u64;
        let is_up = match below.cmp(&half) {
            Ordering::Less => false,
            Ordering::Equal => self.is_inexact || kept.bit(0),
            Ordering::Greater => true,
        };

        let rounded = if is_up { kept + 1 } else { kept };
        let mantissa = rounded.to_u64().unwrap_or(0); // at most 2^53
        assemble(mantissa, self.exponent + drop)
    }
}

/// `mantissa * 2^exponent` for a mantissa of 53 bits (or 2^53 itself), or of fewer at the lowest
/// exponent, -1074; infinity beyond the largest double. The bits of positive doubles, read as
/// integers, count them in their order, 2^52 to a power of two: a mantissa's leading bit raises the
/// exponent by itself, and so does a carry.
fn assemble(mantissa: u64, exponent: i64) -> f64 {
    let rank = ((exponent + 1074).min(2046) as u64) << 52;
    f64::from_bits((rank + mantissa).min(f64::INFINITY.to_bits()))
}

/// The nearest doubles that enclose an interval; beyond the range of doubles infinity.
///
/// ```
/// use mceip_exact::{Interval, enclosing_doubles, from_f64, rational};
/// let third = Interval::point(rational(1, 3));
/// let [lo, hi] = enclosing_doubles(&third);
/// assert!(from_f64(lo).unwrap() < rational(1, 3) && rational(1, 3) < from_f64(hi).unwrap());
/// assert_eq!(enclosing_doubles(&Interval::point(rational(1, 4))), [0.25, 0.25]);
/// ```
pub fn enclosing_doubles(interval: &Interval) -> [f64; 2] {
    let [lo, hi] = [interval.lo(), interval.hi()];
    let [nearest_lo, nearest_hi] = [lo, hi].map(to_f64);
    let is_above = from_f64(nearest_lo).is_ok_and(|value| value > *lo);
    let is_below = from_f64(nearest_hi).is_ok_and(|value| value < *hi);

    [
        if is_above || nearest_lo == f64::INFINITY {
            nearest_lo.next_down()
        } else {
            nearest_lo
        },
        if is_below || nearest_hi == f64::NEG_INFINITY {
            nearest_hi.next_up()
        } else {
            nearest_hi
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{parse, rational};

    #[test]
    fn nearest_double_agrees_with_the_standard_parser() {
        // Basis: Rust's own correctly rounded decimal parser, a different algorithm.
        for text in [
            "1.1",
            "0.1",
            "-2.5",
            "1e-320",
            "4.9e-324",
            "2.4e-324",
            "2.5e-324",
            "1.7976931348623157e308",
            "1e308",
            "9007199254740993",
            "9007199254740995",
            "0.30000000000000004",
            "5e-300",
            "2.2250738585072011e-308",
            "123456789.123456789",
        ] {
            let expected: f64 = text.parse().unwrap();

            let nearest = to_f64(&parse(text).unwrap());

            assert_eq!(nearest.to_bits(), expected.to_bits(), "{text}");
        }

        assert_eq!(to_f64(&parse("1e400").unwrap()), f64::INFINITY);
        assert_eq!(to_f64(&rational(1, 3)), 1.0 / 3.0);
    }

    #[test]
    fn doubles_round_trip() {
        for bits in [
            1u64,
            0x000f_ffff_ffff_ffff,
            0x3ff0_0000_0000_0001,
            0x7fef_ffff_ffff_ffff,
            0xbfb9_9999_9999_999a,
        ] {
            let value = f64::from_bits(bits);
            assert_eq!(to_f64(&from_f64(value).unwrap()).to_bits(), bits);
        }

        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(from_f64(value).is_err());
        }
    }

    /// Both ends of the range, from both sides: the first infinity is half a unit above the largest
    /// double (a tie, to even), the last zero half the smallest subnormal.
    #[test]
    fn the_ends_of_the_range() {
        let power = |k: u32| Rational::from_integer(Integer::from(1) << k);
        let half_a_unit = power(970);
        let last = power(1024) - &half_a_unit;

        for (value, want) in [
            (&last - power(0), f64::MAX),
            (last, f64::INFINITY),
            (power(1024), f64::INFINITY),
            (power(1025), f64::INFINITY),
            (power(3000), f64::INFINITY),
            (power(1074).recip(), f64::from_bits(1)),
            (power(1075).recip(), 0.0),
            (power(1075).recip() + power(1200).recip(), f64::from_bits(1)),
            (power(1076).recip(), 0.0),
            (power(3000).recip(), 0.0),
            (power(1022).recip() - power(1075).recip(), f64::MIN_POSITIVE),
        ] {
            assert_eq!(to_f64(&value).to_bits(), want.to_bits(), "{value}");
            assert_eq!(to_f64(&-value).to_bits(), (-want).to_bits());
        }
    }

    /// All ones above the last bit kept: rounding up makes a power of two.
    #[test]
    fn a_carry_out_of_the_mantissa_raises_the_exponent() {
        let power = |k: u32| Rational::from_integer(Integer::from(1) << k);
        for k in [54u32, 60, 200] {
            let nearly = power(k) - rational(1, 1);
            assert_eq!(to_f64(&nearly), 2f64.powi(k as i32));
            assert_eq!(to_f64(&nearly.recip()), 2f64.powi(-(k as i32)));
        }

        assert_eq!(
            to_f64(&(power(53) - rational(1, 1))),
            9_007_199_254_740_991.0
        );
    }
}
