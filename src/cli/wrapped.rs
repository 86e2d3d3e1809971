//! Sentences wrapped to the width of the terminal.
//!
//! A terminal cuts long lines between any two characters. Sentences are cut between words here, and
//! what follows is indented as the line was. Left as they are: JSON and XML, rows of tables, and
//! commands in backticks, which are copied. Pipes and files get each sentence in one line.

use std::io::stdout;
use terminal_size::terminal_size_of;
use textwrap::core::Word;
use textwrap::{Options, WordSeparator, WordSplitter};

/// The text with its sentences wrapped, if standard output is a terminal.
pub(super) fn for_terminal(text: &str) -> String {
    match terminal_size_of(stdout()) {
        Some((width, _)) => wrapped(text, usize::from(width.0)),
        None => text.to_owned(),
    }
}

/// The text with no sentence longer than `width` columns.
fn wrapped(text: &str, width: usize) -> String {
    let is_for_programs = text.starts_with(['{', '[', '<']);
    if is_for_programs {
        return text.to_owned();
    }

    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let sentence = line.trim_end_matches('\n');
        let end = &line[sentence.len()..];

        if is_row(sentence) {
            out += sentence;
        } else {
            out += &wrapped_line(sentence, width);
        }
        out += end;
    }

    out
}

/// Is this line a row of a table? Two spaces stand between its columns.
fn is_row(line: &str) -> bool {
    let content = line.trim_start();
    content.starts_with('|') || content.contains("  ")
}

fn wrapped_line(line: &str, width: usize) -> String {
    let content = line.trim_start();
    let indent = &line[..line.len() - content.len()];

    let options = Options::new(width)
        .initial_indent(indent)
        .subsequent_indent(indent)
        .break_words(false)
        .word_splitter(WordSplitter::NoHyphenation)
        .word_separator(WordSeparator::Custom(words));

    textwrap::fill(content, options)
}

/// The words of a line: separated by spaces that do not stand between backticks.
fn words(line: &str) -> Box<dyn Iterator<Item = Word<'_>> + '_> {
    let mut list = Vec::new();
    let mut start = 0;
    let mut is_command = false;
    let mut after_space = false;

    for (place, character) in line.char_indices() {
        let is_space = character == ' ' && !is_command;
        if after_space && !is_space {
            list.push(Word::from(&line[start..place]));
            start = place;
        }

        after_space = is_space;
        if character == '`' {
            is_command = !is_command;
        }
    }
    if start < line.len() {
        list.push(Word::from(&line[start..]));
    }

    Box::new(list.into_iter())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_cut_between_words_and_keep_their_indent() {
        let text = "one two three\n    four five six\n\nseven\n";
        let expected = "one two\nthree\n    four\n    five\n    six\n\nseven\n";
        assert_eq!(wrapped(text, 9), expected);

        // A word that is too long stays whole; a text without an end of line gets none.
        assert_eq!(
            wrapped("in 2.2106277812345 or", 9),
            "in\n2.2106277812345\nor"
        );
        assert_eq!(wrapped("", 9), "");
    }

    #[test]
    fn what_is_copied_or_lined_up_is_not_cut() {
        let command = "next: `mceip analyze FILE --friction 8`, then\n";
        let expected = "next:\n`mceip analyze FILE --friction 8`,\nthen\n";
        assert_eq!(wrapped(command, 9), expected);

        for text in [
            "{\"a long sentence\": 1}",
            "<svg width=\"1\" height=\"2\">",
            "| a row of | a table |",
            "  17-slip  1.7048   certified",
        ] {
            assert_eq!(wrapped(text, 9), text);
        }
    }
}
