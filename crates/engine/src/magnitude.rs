//! Orders of magnitude and powers of two in exact numbers, also beyond the range of doubles.

use mceip_exact::{Integer, Rational};
use num_traits::One;

/// The binary order of magnitude of a number other than 0, which lies strictly between
/// 2^(this - 1) and 2^(this + 1).
pub(crate) fn binary_order(v: &Rational) -> i64 {
    v.numer().bits() as i64 - v.denom().bits() as i64
}

/// The decimal order of magnitude of a number other than 0.
pub(crate) fn decimal_order(v: &Rational) -> i64 {
    (binary_order(v) * 30_103 + 50_000).div_euclid(100_000) // log10(2) = 0.30103, to the nearest
}

/// Largest magnitude of a number whose square is a double, with room for sums.
const LARGEST: f64 = 1e150;

/// Is the square of a number of this size within the range of doubles?
pub(crate) fn has_square_in_doubles(size: f64) -> bool {
    (LARGEST.recip()..=LARGEST).contains(&size.abs())
}

/// 2^exponent.
pub(crate) fn two_to(exponent: i64) -> Rational {
    let power = Rational::from_integer(Integer::one() << exponent.unsigned_abs());
    if exponent < 0 { power.recip() } else { power }
}

/// v in units of 2^-bits, rounded.
pub(crate) fn in_units(v: &Rational, bits: i64) -> Integer {
    (v * two_to(bits)).round().to_integer()
}
