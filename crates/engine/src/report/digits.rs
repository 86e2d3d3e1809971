//! Measured numbers for people: six decimals, or six digits where these have too few.

use crate::tolerance::WITH_SIX_DECIMALS;
use mceip_exact::{Rational, from_f64, nearest_decimal, to_f64, without_zeros};
use num_traits::Zero;

/// Six decimals without trailing zeros; beyond [`WITH_SIX_DECIMALS`] six digits and an exponent.
pub(crate) fn short(v: &Rational) -> String {
    let value = to_f64(v);
    if !v.is_zero() && !short_is_plain(value) {
        return nearest_decimal(v, 6);
    }

    without_zeros(&format!("{value:.6}")).to_owned()
}

/// Is a number of this size printed with six decimals?
pub(crate) fn short_is_plain(value: f64) -> bool {
    WITH_SIX_DECIMALS.contains(&value.abs())
}

/// Six decimals, or six digits and an exponent where these have too few digits.
///
/// ```
/// use mceip_engine::report::six_digits;
/// assert_eq!([0.5, 2e-9, f64::INFINITY].map(six_digits), ["0.500000", "2e-9", "inf"]);
/// ```
pub fn six_digits(value: f64) -> String {
    if value == 0.0 || short_is_plain(value) || !value.is_finite() {
        format!("{value:.6}")
    } else {
        short(&from_f64(value).unwrap_or_default())
    }
}

/// So many decimals, or so many digits and an exponent where the decimals say too little.
///
/// ```
/// use mceip_engine::report::fixed_decimals;
/// use mceip_exact::rational;
/// assert_eq!(fixed_decimals(&rational(1, 4), 9), "0.250000000");
/// assert_eq!(fixed_decimals(&rational(1, 3_000_000_000), 3), "3.33e-10");
/// ```
pub fn fixed_decimals(v: &Rational, decimals: usize) -> String {
    let value = to_f64(v);
    if v.is_zero() || short_is_plain(value) {
        format!("{value:.decimals$}")
    } else {
        nearest_decimal(v, decimals)
    }
}
