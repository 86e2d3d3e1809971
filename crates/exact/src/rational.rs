//! Rational numbers, and reading them exactly: "1.1" is 11/10, never the nearest double.
//!
//! The grammar, without blanks anywhere:
//!
//! ```text
//! number   = fraction | decimal
//! fraction = integer "/" integer
//! decimal  = [sign] (digits ["." [digits]] | "." digits) [("e" | "E") integer]
//! integer  = [sign] digits
//! ```
//!
//! The length and the exponent are bounded, so that the work is bounded by the length of the text.
//! Called by the readers of files and of command lines.

use super::Rational;
use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Pow, Signed, Zero};

/// An arbitrary-precision integer.
pub type Integer = BigInt;

/// Longest spelling of one number that is read. Keeps a hostile file from buying quadratic time.
pub const MAX_SPELLING: usize = 100_000;
/// Largest decimal exponent that is read, in absolute value. Doubles end at 324. An exponent buys
/// digits that the file does not have to spell, so it has to be small for the work to be bounded by
/// the length of the file.
pub const MAX_EXPONENT: u32 = 400;

/// Why a spelling is not a number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NumberError {
    /// Nothing between the quotes.
    #[error("expected a number, got an empty string")]
    Empty,
    /// Not a decimal and not `p/q`.
    #[error("expected a decimal or p/q, got {text:?}")]
    Malformed {
        /// The beginning of the offending text.
        text: String,
    },
    /// `p/0`.
    #[error("expected a non-zero denominator, got {text:?}")]
    ZeroDenominator {
        /// The beginning of the offending text.
        text: String,
    },
    /// More characters than [`MAX_SPELLING`].
    #[error("expected at most {limit} characters in a number, got {got}")]
    TooLong {
        /// Characters found.
        got: usize,
        /// Characters allowed.
        limit: usize,
    },
    /// A larger exponent than [`MAX_EXPONENT`].
    #[error("expected a decimal exponent of at most {limit} in absolute value, got {text:?}")]
    ExponentTooLarge {
        /// The exponent as spelt.
        text: String,
        /// The largest allowed.
        limit: u32,
    },
    /// NaN or an infinity offered as a value.
    #[error("expected a finite number, got {text}")]
    NotFinite {
        /// What was offered.
        text: String,
    },
}

/// Reads a decimal (`-1.25`, `3e-4`, `7.`, `.5`) or a fraction (`p/q`) as exactly the value it
/// spells. Nothing may stand before or after it: which characters are blank differs from language
/// to language.
///
/// # Errors
/// [`NumberError`] when the text is no such number, or is too long, or has an absurd exponent.
///
/// ```
/// use mceip_exact::{parse, rational};
/// assert_eq!(parse("1.1").unwrap(), rational(11, 10));
/// assert_eq!(parse("-6/4").unwrap(), rational(-3, 2));
/// assert!(parse("1/0").is_err());
/// assert!(parse("NaN").is_err());
/// ```
pub fn parse(text: &str) -> Result<Rational, NumberError> {
    if text.is_empty() {
        return Err(NumberError::Empty);
    }

    if text.len() > MAX_SPELLING {
        return Err(NumberError::TooLong {
            got: text.len(),
            limit: MAX_SPELLING,
        });
    }

    match text.split_once('/') {
        Some((p, q)) => parse_fraction(text, p, q),
        None => parse_decimal(text),
    }
}

/// The rational `p/q` from machine integers, for code and tests.
///
/// # Panics
/// If `q` is zero: the caller writes both numbers down.
pub fn rational(p: i64, q: i64) -> Rational {
    assert!(q != 0, "rational(p, q) needs q != 0");
    Rational::new(p.into(), q.into())
}

/// The integer `p` as a rational.
pub fn whole(p: i64) -> Rational {
    Rational::from_integer(p.into())
}

/// The common positive multiplier that makes every number of `values` an integer
/// (least common multiple of the denominators; 1 for none).
pub fn common_denominator<'a>(values: impl IntoIterator<Item = &'a Rational>) -> Integer {
    let mut multiple = Integer::one();
    for value in values {
        multiple = multiple.lcm(value.denom());
    }
    multiple
}

/// multiple * value, an integer because `multiple` is one of the denominator.
pub fn cleared(value: &Rational, multiple: &Integer) -> Integer {
    value.numer() * (multiple / value.denom())
}

fn malformed(text: &str) -> NumberError {
    NumberError::Malformed { text: head(text) }
}

/// The beginning of a text, for messages that must stay one line.
fn head(text: &str) -> String {
    let printable = text.chars().filter(|c| !c.is_control());
    printable.take(40).collect()
}

fn parse_fraction(text: &str, p: &str, q: &str) -> Result<Rational, NumberError> {
    let p = parse_integer(p).ok_or_else(|| malformed(text))?;
    let q = parse_integer(q).ok_or_else(|| malformed(text))?;

    if q.is_zero() {
        return Err(NumberError::ZeroDenominator { text: head(text) });
    }

    Ok(Rational::new(p, q))
}

/// Optional sign, then at least one ASCII digit, nothing else (no `_`, no blanks inside).
fn parse_integer(text: &str) -> Option<Integer> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let magnitude = parse_unsigned(digits)?;

    if text.starts_with('-') {
        Some(-magnitude)
    } else {
        Some(magnitude)
    }
}

/// The digits of both sides of the point as one integer, times a power of ten.
fn parse_decimal(text: &str) -> Result<Rational, NumberError> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, parse_exponent(text, exponent)?),
        None => (text, 0),
    };

    let (signed_whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let unsigned_whole = signed_whole
        .strip_prefix(['+', '-'])
        .unwrap_or(signed_whole);

    let digits = format!("{unsigned_whole}{fraction}");
    let Some(magnitude) = parse_unsigned(&digits) else {
        return Err(malformed(text));
    };

    let integer = if signed_whole.starts_with('-') {
        -magnitude
    } else {
        magnitude
    };

    let power = i64::from(exponent) - fraction.len() as i64;
    let scale = Integer::from(10).pow(power.unsigned_abs());

    if power >= 0 {
        Ok(Rational::from_integer(integer * scale))
    } else {
        Ok(Rational::new(integer, scale))
    }
}

/// At least one ASCII digit, nothing else.
fn parse_unsigned(digits: &str) -> Option<Integer> {
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    digits.parse().ok()
}

fn parse_exponent(text: &str, exponent: &str) -> Result<i32, NumberError> {
    let value = parse_integer(exponent).ok_or_else(|| malformed(text))?;
    if value.abs() > Integer::from(MAX_EXPONENT) {
        return Err(NumberError::ExponentTooLarge {
            text: head(exponent),
            limit: MAX_EXPONENT,
        });
    }

    // |value| <= MAX_EXPONENT, so it fits.
    Ok(i32::try_from(value).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_is_spelt() {
        for (text, p, q) in [
            ("1.1", 11, 10),
            ("-0.5", -1, 2),
            ("3e2", 300, 1),
            ("25E-1", 5, 2),
            ("7/-14", -1, 2),
            (".5", 1, 2),
            ("5.", 5, 1),
            ("+2", 2, 1),
            ("-.25", -1, 4),
        ] {
            assert_eq!(parse(text).unwrap(), rational(p, q), "{text}");
        }
    }

    #[test]
    fn refuses_what_is_no_number() {
        for text in [
            " 5", "5 ", "5\n", "\u{a0}5", "1 /2", "1/ 2", "\u{661}", "\u{ff11}",
        ] {
            assert!(
                matches!(parse(text), Err(NumberError::Malformed { .. })),
                "{text:?} was read as a number"
            );
        }

        for text in [
            "", " ", "abc", "1..2", "1e", "--1", "+-1", "-+1", "+-.5", "1/2/3", "1_000", "0x10",
            "inf", "NaN", ".", "-", "1e1.5", "1.-5", "1.+5",
        ] {
            assert!(parse(text).is_err(), "{text:?} was read as a number");
        }

        assert!(matches!(
            parse("3/0"),
            Err(NumberError::ZeroDenominator { .. })
        ));
        assert!(matches!(
            parse("1e999999999"),
            Err(NumberError::ExponentTooLarge { .. })
        ));
        assert!(parse("1e400").is_ok() && parse("1e-400").is_ok());
        assert!(matches!(
            parse("1e401"),
            Err(NumberError::ExponentTooLarge { limit: 400, .. })
        ));
        assert!(matches!(
            parse(&"9".repeat(MAX_SPELLING + 1)),
            Err(NumberError::TooLong { .. })
        ));
    }

    #[test]
    fn common_denominator_clears_all() {
        let values = [rational(1, 6), rational(3, 4), whole(2)];
        assert_eq!(common_denominator(&values), Integer::from(12));
    }

    #[test]
    fn a_sign_within_a_decimal_is_malformed_and_quoted() {
        for text in [".+5", ".-5", "1.+5", "-.-5", ".", "1.x"] {
            assert_eq!(
                parse(text),
                Err(NumberError::Malformed { text: text.into() }),
                "{text}"
            );
        }

        assert_eq!(
            parse(&format!("x\n{}", "y".repeat(90))),
            Err(NumberError::Malformed {
                text: format!("x{}", "y".repeat(39))
            })
        );

        assert!(parse(&"9".repeat(MAX_SPELLING)).is_ok());
    }
}
