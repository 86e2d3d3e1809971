//! Short dyadic numbers near a double.
//!
//! Ends of intervals and bounds of blocks stand in the certificate, and the checker computes with
//! them exactly. A number p 2^e with few bits in p keeps both the file and that work small.

use mceip_exact::{Rational, from_f64};

/// Bits below the leading one that are tried for a number near a target.
const FEWEST_BITS: i32 = 3;
const MOST_BITS: i32 = 52;

/// Slack from which on a cut may be an integer: the neighbourhood of small integers is left behind.
const LARGE_SLACK: f64 = 1e6;

/// Bits below the leading one of a lower bound.
const BOUND_BITS: f64 = 4.0;

/// The shortest dyadic number within `slack` of `target` that is no integer; `None` unless both are
/// positive.
///
/// The solutions of hand-made problems are integers and small fractions, and a cut should not meet
/// them.
pub(crate) fn short_near(target: f64, slack: f64) -> Option<Rational> {
    if !(target > 0.0 && slack > 0.0) {
        return None;
    }

    let leading_bit = target.log2().floor() as i32;
    for bits in FEWEST_BITS..=MOST_BITS {
        let number = odd_multiple(target, slack, leading_bit - bits);
        if number.is_some() {
            return number;
        }
    }

    None
}

/// The odd multiple of 2^exponent next to `target`, if it lies within `slack` of it.
fn odd_multiple(target: f64, slack: f64, exponent: i32) -> Option<Rational> {
    let unit = f64::from(exponent).exp2();
    let multiple = 2.0 * (0.5 * (target / unit - 1.0)).round() + 1.0;
    let value = multiple * unit;

    let is_near = (value - target).abs() <= slack && value > 0.0;
    let may_be_taken = unit < 1.0 || slack > LARGE_SLACK;
    if is_near && may_be_taken {
        from_f64(value).ok()
    } else {
        None
    }
}

/// A multiple of a power of two within `slack` of `target`; `None` unless both are positive.
pub(crate) fn multiple_near(target: f64, slack: f64) -> Option<Rational> {
    if !(target > 0.0 && slack > 0.0) {
        return None;
    }

    let unit = slack.log2().floor().exp2();
    from_f64((target / unit).round() * unit).ok()
}

/// A short number at most `value`, within a sixteenth of it; `None` unless `value` is positive.
pub(crate) fn short_below(value: f64) -> Option<Rational> {
    if !(value > 0.0 && value.is_finite()) {
        return None;
    }

    let leading_bit = value.log2().floor();
    let unit = (leading_bit - BOUND_BITS).exp2();
    let multiple = (value / unit).floor();
    from_f64(multiple * unit).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    #[test]
    fn a_multiple_near_a_number_is_short_and_within_the_slack() {
        // The slack 0.01 gives the unit 2^-7: 1.2345 / 2^-7 = 158.016, and 158 / 128 = 79 / 64.
        assert_eq!(multiple_near(1.2345, 0.01), Some(rational(79, 64)));
        // The slack 30 gives the unit 2^4: 990 / 16 = 61.875, and 62 * 16 = 992.
        assert_eq!(multiple_near(990.0, 30.0), Some(rational(992, 1)));

        assert_eq!(multiple_near(0.0, 0.01), None);
        assert_eq!(multiple_near(1.2345, 0.0), None);
        assert_eq!(multiple_near(f64::NAN, 0.01), None);
    }
}
