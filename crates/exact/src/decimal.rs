//! Decimals for people: correctly rounded at any number of significant digits.
//!
//! A rational is scaled by a power of ten so that the digits wanted stand before the point, and
//! rounded half away from zero. An algebraic number is enclosed by narrower and narrower intervals
//! until both ends round alike. That never happens at a tie (a number half-way between two
//! decimals), so the one tie within the interval is tested for equality by exact signs.
//!
//! Called by reports. No decision is made on a decimal.

use super::{Algebraic, Integer, Interval, Poly, Rational, Sign};
use num_traits::{Pow, Signed, Zero};

/// `value(number)` rounded to `digits` significant digits, half away from zero, as a decimal
/// string. Pass `t` as the polynomial for the number itself.
///
/// ```
/// use mceip_exact::{nonnegative_roots, to_decimal, Poly};
/// let mut root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
/// assert_eq!(to_decimal(&mut root, &Poly::from_ints(&[0, 1]), 20), "1.4142135623730950488");
/// ```
pub fn to_decimal(number: &mut Algebraic, value: &Poly, digits: usize) -> String {
    ratio_to_decimal(number, value, &Poly::from_ints(&[1]), digits)
}

/// `numerator(number) / denominator(number)`, correctly rounded like [`to_decimal`].
///
/// Correct rounding of an irrational number is decided by refining its interval until both ends
/// round alike; a tie is only possible at a rational, which is tested exactly. A denominator that
/// vanishes at the number has no quotient: the result is then "0" (callers divide by sums that
/// are positive by construction).
pub fn ratio_to_decimal(
    number: &mut Algebraic,
    numerator: &Poly,
    denominator: &Poly,
    digits: usize,
) -> String {
    if number.sign_of(numerator) == Sign::Zero || number.sign_of(denominator) == Sign::Zero {
        return "0".into();
    }

    let mut halvings = 1;
    loop {
        let top = number.interval().horner(numerator);
        let bottom = number.interval().horner(denominator);
        if let Some(quotient) = top.div(&bottom)
            && quotient.certain_sign() != 0
        {
            let rounded_lo = nearest_decimal(quotient.lo(), digits);
            let rounded_hi = nearest_decimal(quotient.hi(), digits);
            if rounded_lo == rounded_hi {
                return rounded_lo;
            }
            if let Some(tie) = tie_in(&quotient, digits) {
                // numerator - tie * denominator vanishes here exactly when the quotient is the tie.
                let difference = &numerator.scale(tie.denom()) - &denominator.scale(tie.numer());
                if number.sign_of(&difference) == Sign::Zero {
                    return nearest_decimal(&tie, digits);
                }
            }
        }

        for _ in 0..halvings {
            number.refine();
        }
        halvings = (2 * halvings).min(1024); // rounding costs more than halving
    }
}

/// Decimals with `digits` significant digits (of the larger end) that enclose an interval: the
/// lower end rounded down, the upper end rounded up.
///
/// ```
/// use mceip_exact::{enclosing_decimals, rational, Interval};
/// let i = Interval::new(rational(1, 3), rational(2, 3)).unwrap();
/// assert_eq!(enclosing_decimals(&i, 3), ("0.333".to_string(), "0.667".to_string()));
/// ```
pub fn enclosing_decimals(interval: &Interval, digits: usize) -> (String, String) {
    let largest = interval.lo().abs().max(interval.hi().abs());
    if largest.is_zero() {
        return ("0".into(), "0".into());
    }

    let power = scaling_power(&largest, digits);
    let down = times_power_of_ten(&times_power_of_ten(interval.lo(), power).floor(), -power);
    let up = times_power_of_ten(&times_power_of_ten(interval.hi(), power).ceil(), -power);

    (
        nearest_decimal(&down, digits + 1),
        nearest_decimal(&up, digits + 1),
    ) // both are exact at that length
}

/// A decimal with `digits` significant digits that is not below the number.
///
/// ```
/// use mceip_exact::{rational, upper_decimal};
/// assert_eq!(upper_decimal(&rational(1, 3_000_000), 2), "3.4e-7");
/// ```
pub fn upper_decimal(value: &Rational, digits: usize) -> String {
    enclosing_decimals(&Interval::point(value.clone()), digits).1
}

/// A rational rounded to `digits` significant digits, half away from zero.
///
/// ```
/// use mceip_exact::{nearest_decimal, rational};
/// assert_eq!(nearest_decimal(&rational(2, 3_000_000), 2), "6.7e-7");
/// ```
pub fn nearest_decimal(value: &Rational, digits: usize) -> String {
    if value.is_zero() {
        return "0".into();
    }

    let magnitude = value.abs();
    let mut exponent = decimal_exponent(&magnitude);
    let mut mantissa = times_power_of_ten(&magnitude, scaling_power(&magnitude, digits))
        .round()
        .to_integer();
    if mantissa.to_string().len() > digits.max(1) {
        exponent += 1; // 9.99 -> 10.0
        mantissa /= 10;
    }

    let sign = if value.is_negative() { "-" } else { "" };

    format!("{sign}{}", layout(&mantissa.to_string(), exponent))
}

/// The one rounding tie in a narrow interval of positive or of negative numbers, if any.
fn tie_in(interval: &Interval, digits: usize) -> Option<Rational> {
    let half = Rational::new(1.into(), 2.into());
    let power = scaling_power(&interval.hi().abs(), digits);

    // Scaled, the ties are the integers plus one half.
    let scaled_lo = times_power_of_ten(interval.lo(), power);
    let scaled_tie = (scaled_lo - &half).ceil() + half;
    let tie = times_power_of_ten(&scaled_tie, -power);

    interval.contains(&tie).then_some(tie)
}

/// The k for which value * 10^k has `digits` digits before the point (one for none), value > 0.
fn scaling_power(value: &Rational, digits: usize) -> i64 {
    digits.max(1) as i64 - 1 - decimal_exponent(value)
}

/// floor(log10(value)) for value > 0.
fn decimal_exponent(value: &Rational) -> i64 {
    let numerator_digits = value.numer().to_string().len() as i64;
    let denominator_digits = value.denom().to_string().len() as i64;
    let guess = numerator_digits - denominator_digits; // right, or one too large

    let power = times_power_of_ten(&Rational::from_integer(1.into()), guess);

    if *value < power { guess - 1 } else { guess }
}

/// A number in decimals without the zeros at their end. A number without a decimal point stays as
/// it is, and so does one with an exponent.
///
/// ```
/// use mceip_exact::without_zeros;
/// let written = ["1.50", "2.000", "0.00"];
/// assert_eq!(written.map(without_zeros), ["1.5", "2", "0"]);
/// let stay = ["0", "-0", "100", "1.0e5", "1.5e-10"];
/// assert_eq!(stay.map(without_zeros), stay);
/// ```
pub fn without_zeros(number: &str) -> &str {
    if !number.contains('.') || number.contains('e') {
        return number;
    }
    number.trim_end_matches('0').trim_end_matches('.')
}

/// value * 10^k.
fn times_power_of_ten(value: &Rational, k: i64) -> Rational {
    let power = Integer::from(10).pow(k.unsigned_abs());
    let power = Rational::from_integer(power);

    if k >= 0 { value * power } else { value / power }
}

/// The number d.ddd * 10^exponent by its digits, without zeros at the end: the decimal point where
/// it belongs, or scientific outside 1e-5 .. 1e21.
fn layout(digits: &str, exponent: i64) -> String {
    let trimmed = match digits.trim_end_matches('0') {
        "" => "0",
        trimmed => trimmed,
    };

    match exponent {
        0..=20 => {
            let point = exponent as usize + 1;
            if trimmed.len() <= point {
                let zeros = "0".repeat(point - trimmed.len());
                format!("{trimmed}{zeros}")
            } else {
                let (whole, fraction) = trimmed.split_at(point);
                format!("{whole}.{fraction}")
            }
        }
        -5..=-1 => {
            let zeros = "0".repeat((-exponent - 1) as usize);
            format!("0.{zeros}{trimmed}")
        }
        _ if trimmed.len() == 1 => format!("{trimmed}e{exponent}"),
        _ => {
            let (whole, fraction) = trimmed.split_at(1);
            format!("{whole}.{fraction}e{exponent}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{nonnegative_roots, parse, rational};

    #[test]
    fn rationals_round_half_away_from_zero() {
        for (text, digits, want) in [
            ("1/3", 5, "0.33333"),
            ("2/3", 5, "0.66667"),
            ("12.345", 4, "12.35"),
            ("-12.345", 4, "-12.35"),
            ("999.96", 4, "1000"),
            ("9.996", 3, "10"),
            ("120000", 2, "120000"),
            ("1e-9", 3, "1e-9"),
            ("1.25e30", 3, "1.25e30"),
            ("0.0001234", 2, "0.00012"),
        ] {
            assert_eq!(
                nearest_decimal(&parse(text).unwrap(), digits),
                want,
                "{text}"
            );
        }
    }

    #[test]
    fn a_tie_at_a_hidden_rational_terminates() {
        // 1/8 as a root of a reducible polynomial: 2 digits is the tie 0.125.
        let p = &Poly::linear_root(&rational(1, 8)) * &Poly::from_ints(&[-3, 0, 1]);
        let mut root = nonnegative_roots(&p).remove(0);
        assert_eq!(to_decimal(&mut root, &Poly::from_ints(&[0, 1]), 2), "0.13");
    }

    #[test]
    fn printed_decimals_read_back_close() {
        let mut root = nonnegative_roots(&Poly::from_ints(&[-7, 0, 3])).remove(0);
        let text = to_decimal(&mut root, &Poly::from_ints(&[0, 1]), 17);
        let read: Rational = parse(&text).unwrap();
        let error: Rational = &read * &read * rational(3, 1) - rational(7, 1);
        assert!(error.abs() < parse("1e-15").unwrap());
    }

    /// t^2 = 1/8 at t = sqrt(1/8): the tie 0.125 is only seen at the quotient.
    #[test]
    fn a_tie_of_a_quotient_of_irrational_terms_terminates() {
        let mut root = nonnegative_roots(&Poly::from_ints(&[-1, 0, 8])).remove(0);
        let square = Poly::from_ints(&[0, 0, 1]);
        assert_eq!(to_decimal(&mut root, &square, 2), "0.13");

        let quotients = [
            (Poly::from_ints(&[1]), square, 1, "8"),
            (
                Poly::from_ints(&[0, -3]),
                Poly::from_ints(&[0, 8]),
                2,
                "-0.38",
            ),
            (
                Poly::from_ints(&[0, 5]),
                Poly::from_ints(&[0, 0, 0, 32]),
                2,
                "1.3",
            ),
        ];

        for (numerator, denominator, digits, expected) in quotients {
            let decimal = ratio_to_decimal(&mut root, &numerator, &denominator, digits);
            assert_eq!(decimal, expected);
        }
    }

    #[test]
    fn enclosing_decimals_round_outwards() {
        let cases = [
            (["1/3", "2/3"], 3, ["0.333", "0.667"]),
            (["1.234567", "1.234568"], 4, ["1.234", "1.235"]),
            (["-1.234567", "-1.234561"], 4, ["-1.235", "-1.234"]),
            (["0.1234", "0.99991"], 3, ["0.123", "1"]),
            (["12344", "99999"], 3, ["12300", "100000"]),
            (["12344", "99999"], 1, ["10000", "100000"]),
            (["0", "0"], 3, ["0", "0"]),
            (["-1/8", "1/3"], 2, ["-0.13", "0.34"]),
            (["1.25", "1.5"], 3, ["1.25", "1.5"]),
        ];

        for (ends, digits, expected) in cases {
            let [lo, hi] = ends.map(|text| parse(text).unwrap());
            let interval = Interval::new(lo, hi).unwrap();

            let (down, up) = enclosing_decimals(&interval, digits);

            assert_eq!([down, up], expected, "{ends:?}");
        }
    }
}
