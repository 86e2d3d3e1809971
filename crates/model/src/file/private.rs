//! Keys that the JSON reader keeps for itself.
//!
//! With exact numbers `serde_json` hands a number over
//! as an object with the key `$serde_json::private::Number`, so that an object with this key in a
//! file would be read as a number. No format has a field of such a name: every key that begins like
//! it is refused before anything is read.

use crate::{ErrorLocation, ModelError};

/// The beginning of the keys that `serde_json` keeps for itself.
const PRIVATE: &str = "$serde_json::private::";

/// Refuses a text in which some object has a private key, spelt out or with escapes.
///
/// # Errors
/// [`ModelError::Json`] with the place of the key.
pub(super) fn refuse_keys(text: &str) -> Result<(), ModelError> {
    // Without these letters and without escapes no key can be private.
    if !text.contains("private") && !text.contains("\\u") {
        return Ok(());
    }

    let mut rest = 0;
    while let Some(start) = text[rest..].find('"').map(|at| rest + at) {
        let Some(end) = end_of_string(text, start) else {
            return Ok(()); // an unfinished string, which the reader refuses
        };

        let is_key = text[end..].trim_start().starts_with(':');
        if is_key && is_private(&text[start..end]) {
            return Err(refusal(text, start));
        }
        rest = end;
    }

    Ok(())
}

/// Where the string that begins at the quote `start` ends: one past its closing quote.
fn end_of_string(text: &str, start: usize) -> Option<usize> {
    let mut is_escaped = false;
    for (at, byte) in text.bytes().enumerate().skip(start + 1) {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' => return Some(at + 1),
            _ => {}
        }
    }

    None
}

/// Does this string, quotes included, begin like a private key once its escapes are read?
fn is_private(quoted: &str) -> bool {
    serde_json::from_str::<String>(quoted).is_ok_and(|key| key.starts_with(PRIVATE))
}

fn refusal(text: &str, at: usize) -> ModelError {
    let before = &text[..at];
    let line = before.matches('\n').count() + 1;
    let column = before.len() - before.rfind('\n').map_or(0, |newline| newline + 1) + 1;
    let problem = format!("expected the name of a field, got one that begins with {PRIVATE}");
    ModelError::Json {
        location: ErrorLocation { line, column },
        problem,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_refused(text: &str) -> bool {
        refuse_keys(text).is_err()
    }

    #[test]
    fn private_keys_are_refused_however_they_are_spelt() {
        for key in [
            "$serde_json::private::Number",
            "\\u0024serde_json::private::Number",
            "$serde_json::priv\\u0061te::RawValue",
        ] {
            assert!(is_refused(&format!(r#"{{"{key}": "1"}}"#)), "{key}");
            assert!(
                is_refused(&format!("{{\"a\": [\"b\\\"\", {{\"{key}\"\n : 1}}]}}")),
                "{key}"
            );
            // As a value it is a text like any other.
            assert!(
                !is_refused(&format!(r#"{{"name": "{key}", "private": "\u0061"}}"#)),
                "{key}"
            );
        }

        for text in [
            "",
            "{}",
            r#"{"private": 1}"#,
            r#"{"$serde_json": 1, "\u0061": 2}"#,
            r#"{"$serde_json::private"#,
        ] {
            assert!(!is_refused(text), "{text}");
        }
    }

    #[test]
    fn the_place_is_named() {
        let text = "{\n \"a\": {\"$serde_json::private::Number\": \"1\"}}";
        let Err(ModelError::Json { location, .. }) = refuse_keys(text) else {
            panic!("refused")
        };
        assert_eq!((location.line, location.column), (2, 8));
    }
}
