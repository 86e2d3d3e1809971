//! A number in a file: a JSON string or a JSON number, read as exactly the value it spells.
//!
//! `serde_json` keeps the text of a JSON number (its feature `arbitrary_precision`), so that `0.1`
//! is 1/10 and never the nearest double. Written numbers are strings.

use mceip_exact::{Rational, from_f64, parse, to_f64};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

/// A rational as it stands in JSON: `"p/q"`, `"1.1"` or `1.1`, never through a double.
///
/// ```
/// use mceip_exact::rational;
/// use mceip_model::file::Number;
/// let n: Number = serde_json::from_str("0.1").unwrap();
/// assert_eq!(n.0, rational(1, 10));
/// assert_eq!(serde_json::to_string(&n).unwrap(), "\"1/10\"");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number(pub Rational);

impl Number {
    /// The nearest double's exact value: what `"read_as": "f64"` asks for.
    pub(super) fn through_f64(&self) -> Option<Number> {
        from_f64(to_f64(&self.0)).ok().map(Number)
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = match Value::deserialize(deserializer)? {
            Value::Number(number) => number.to_string(), // the text itself
            Value::String(text) => text,
            other => {
                let got = kind(&other);
                let message = format!("expected a number or a string with one, got {got}");
                return Err(D::Error::custom(message));
            }
        };

        parse(&text).map(Number).map_err(D::Error::custom)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "a boolean",
        Value::Array(_) => "an array",
        Value::Object(_) => "an object",
        Value::Number(_) => "a number",
        Value::String(_) => "a string",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    #[test]
    fn json_numbers_and_strings_are_exact() {
        for (text, p, q) in [
            ("1.1", 11, 10),
            ("\"1.1\"", 11, 10),
            ("\"-3/6\"", -1, 2),
            ("1e-2", 1, 100),
            ("0.30000000000000004", 30000000000000004, 100000000000000000),
        ] {
            let n: Number = serde_json::from_str(text).unwrap();
            assert_eq!(n.0, rational(p, q), "{text}");
        }
    }

    #[test]
    fn everything_else_is_refused() {
        for text in ["null", "true", "[]", "{}", "\"NaN\"", "\"\"", "\"1/0\""] {
            assert!(serde_json::from_str::<Number>(text).is_err(), "{text}");
        }
    }
}
