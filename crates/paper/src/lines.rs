//! The lines of a text with their numbers: what tables and the files of CalculiX are read by.

/// A line of a file.
pub(crate) struct TextLine<'a> {
    /// From 1.
    pub(crate) number: usize,
    /// Without space at both ends.
    pub(crate) text: &'a str,
}

/// The lines that are neither empty nor comments, without a byte order mark.
pub(crate) fn lines_with_content(text: &str) -> Vec<TextLine<'_>> {
    let mut lines = lines_not_empty(text, |line| line.trim_start_matches('\u{feff}'));
    lines.retain(|line| !line.text.starts_with('#'));
    lines
}

/// The lines that are not empty once `cut` has taken its part.
pub(crate) fn lines_not_empty(text: &str, cut: fn(&str) -> &str) -> Vec<TextLine<'_>> {
    let mut lines = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let text = cut(line).trim();
        if !text.is_empty() {
            lines.push(TextLine {
                number: index + 1,
                text,
            });
        }
    }

    lines
}

/// The beginning of a text, fit to be printed.
pub(crate) fn shown(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(60).collect()
}
