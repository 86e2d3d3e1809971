//! Verdicts in colour on a terminal, unless colours are turned off.
//!
//! The words are those of [`VERDICTS`], in capitals. `NO_COLOR` and `CLICOLOR=0` turn
//! colours off, `CLICOLOR_FORCE=1` on; pipes and files get plain text. JSON is left alone.

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use std::io::stdout;

/// Words in capitals, and what their colour says.
const VERDICTS: [(AnsiColor, &[&str]); 3] = [
    // A claim holds. ABSENT is none of these: absence of one form is not stability.
    (
        AnsiColor::Green,
        &["ACCEPTED", "AGREES", "CLEAN", "COMPLETE", "VERIFIED"],
    ),
    // Something to look at, or left open.
    (
        AnsiColor::Yellow,
        &["PRESENT", "UNDECIDED", "WARNING", "INTERRUPTED"],
    ),
    // Refuted.
    (
        AnsiColor::Red,
        &[
            "REJECTED",
            "INACCURATE",
            "DISAGREEMENT",
            "DISAGREES",
            "REFUSED",
        ],
    ),
];

/// Does standard output take colours?
pub(super) fn is_wanted() -> bool {
    AutoStream::choice(&stdout()) != ColorChoice::Never
}

/// The text with its verdicts in colour.
pub(super) fn coloured(text: &str) -> String {
    let is_json = text.starts_with(['{', '[']);
    if is_json {
        return text.to_owned();
    }

    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_letter) {
        let (between, after) = rest.split_at(start);
        let end = after.find(|c| !is_letter(c)).unwrap_or(after.len());
        let (word, after) = after.split_at(end);

        out += between;
        match style(word) {
            Some(style) => out += &format!("{style}{word}{style:#}"),
            None => out += word,
        }
        rest = after;
    }

    out + rest
}

fn style(word: &str) -> Option<Style> {
    let known = VERDICTS.iter().find(|(_, words)| words.contains(&word));
    known.map(|(colour, _)| colour.on_default().bold())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_coloured_and_nothing_else() {
        let green = "\u{1b}[1m\u{1b}[32mACCEPTED\u{1b}[0m";
        assert_eq!(coloured("ACCEPTED: x = 1\n"), format!("{green}: x = 1\n"));
        assert_eq!(coloured("é, ACCEPTED"), format!("é, {green}"));

        for plain in [
            "",
            "accepted",
            "UNACCEPTED",
            "NOT_ACCEPTED",
            "{\"a\":\"ACCEPTED\"}",
        ] {
            assert_eq!(coloured(plain), plain);
        }
    }
}
