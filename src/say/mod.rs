//! What the answers are in words: sentences of the results of the front door.
//!
//! The texts are data of no other part: the front door hands over numbers, intervals and counts,
//! and every sentence about them is made here. Called by the front door and the program.

pub(crate) mod cover;
pub(crate) mod enumeration;
pub(crate) mod search;

/// "1 warning", "2 warnings".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}
