//! What the answers are in words: sentences of the results of the front door.
//!
//! The texts are data of no other part: the front door hands over numbers, intervals and counts,
//! and every sentence about them is made here. Called by the front door and the program.

pub(crate) mod cover;
pub(crate) mod enumeration;
pub(crate) mod own_critical;
pub(crate) mod path;
pub(crate) mod search;
pub(crate) mod stretches;

use mceip_exact::{Rational, nearest_decimal, parse};

/// What looked wrong when a file was made, a line each.
pub(crate) fn warnings_text(warnings: &[String]) -> String {
    let mut out = String::new();
    for warning in warnings {
        let printable = warning.replace(char::is_control, " ");
        out += &format!("WARNING of convert: {printable}.\n");
    }

    out
}

/// A mu as a decimal where it is a short one, else as a fraction.
pub(crate) fn mu_text(mu: &Rational) -> String {
    let decimal = nearest_decimal(mu, 15);
    if parse(&decimal).is_ok_and(|value| value == *mu) {
        decimal
    } else {
        mu.to_string()
    }
}

/// "1 warning", "2 warnings", "2 stretches".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    let plural = match noun {
        _ if count == 1 => "",
        noun if noun.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{count} {noun}{plural}")
}
