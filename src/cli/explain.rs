//! `mceip explain [TERM]`: what a word of the output means.
//!
//! A TERM is a term of the glossary, the id of an equation (`E16`, `16` or `(16)`) or of a
//! departure from the paper (`X9`), a reason for which `check` rejects a certificate
//! (`NotIsolated`), or a flag of the conformance pack (`one_by_one`). The texts are those of the
//! book in `spec/`, compiled into the program, and the notes of [`Flag`].

use super::common::{CliError, exit, print};
use mceip_testkit::conform::Flag;

/// The pages with a table of names and meanings.
const TABLES: [Page; 2] = [
    Page::new("spec/glossary.md", include_str!("../../spec/glossary.md")),
    Page::new("spec/reasons.md", include_str!("../../spec/reasons.md")),
];

/// The pages with a list of equations by id.
const CHAPTERS: [Page; 4] = [
    Page::new("spec/problem.md", include_str!("../../spec/problem.md")),
    Page::new("spec/reduction.md", include_str!("../../spec/reduction.md")),
    Page::new("spec/solver.md", include_str!("../../spec/solver.md")),
    Page::new(
        "spec/enumeration.md",
        include_str!("../../spec/enumeration.md"),
    ),
];

/// The page with a section for each departure from the paper.
const ERRATA: Page = Page::new("spec/errata.md", include_str!("../../spec/errata.md"));

/// The page with the table of flags, which the program has as [`Flag`].
const FLAGS: &str = "spec/conform.md";

/// Names shown for a term that is not known.
const SUGGESTIONS: usize = 5;

#[derive(clap::Args)]
pub(super) struct Args {
    /// A term of the output, an equation ("(16)", "E16"), a departure ("X9"), a reason of
    /// rejection ("NotIsolated") or a flag of `conform`; without one, all names
    #[arg(allow_hyphen_values = true)]
    term: Vec<String>,
}

/// A page of the book.
struct Page {
    path: &'static str,
    text: &'static str,
}

impl Page {
    const fn new(path: &'static str, text: &'static str) -> Page {
        Page { path, text }
    }
}

/// A name with its meaning.
struct Entry {
    name: String,
    meaning: String,
    path: &'static str,
}

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let entries = entries();
    if args.term.is_empty() {
        print(&list_of_names(&entries))?;
        return Ok(exit::DONE);
    }

    let term = args.term.join(" ");
    let found: Vec<&Entry> = entries.iter().filter(|e| e.has_name(&term)).collect();
    if found.is_empty() {
        return Err(CliError::Term {
            near: suggestions(&entries, &term),
            term,
        });
    }

    for entry in found {
        print(&format!(
            "{} ({})\n{}\n",
            entry.name, entry.path, entry.meaning
        ))?;
    }
    Ok(exit::DONE)
}

impl Entry {
    /// Is `term` this name, or one of several that stand in it between commas?
    ///
    /// The prefix `Cover.` of a reason may be left out, and a plural may stand for the name or the
    /// name for a plural.
    fn has_name(&self, term: &str) -> bool {
        let wanted = normal_form(term);
        let name = normal_form(&self.name);
        if name == wanted || name.strip_prefix("cover.") == Some(&wanted) {
            return true;
        }

        let singular = wanted.strip_suffix('s');
        name.split(", ").any(|part| {
            let of_plural = part.strip_suffix('s').filter(|part| part.len() > 1);
            part == wanted || Some(part) == singular || of_plural == Some(&wanted)
        })
    }
}

/// Lower case, Greek letters and powers in ASCII, blanks for underscores; an equation's number
/// becomes its id, with or without the word before it.
fn normal_form(name: &str) -> String {
    let name = name.trim().to_lowercase();
    let name = name.replace('λ', "lambda").replace('μ', "mu");
    let name = name.replace('²', "2").replace('^', "").replace('_', " ");

    let mut words = EQUATION_WORDS.iter();
    let number = words.find_map(|word| name.strip_prefix(word));
    let number = number.unwrap_or(&name).trim();
    let number = number.trim_start_matches('(').trim_end_matches(')');
    if !number.is_empty() && number.bytes().all(|c| c.is_ascii_digit()) {
        return format!("e{number}");
    }
    name
}

/// What an equation may be called.
const EQUATION_WORDS: [&str; 3] = ["condition ", "equation ", "eq. "];

fn entries() -> Vec<Entry> {
    let mut list = Vec::new();
    for page in &TABLES {
        list.extend(rows(page));
    }
    for page in &CHAPTERS {
        list.extend(equations(page));
    }
    list.extend(departures(&ERRATA));
    for flag in Flag::ALL {
        list.push(Entry {
            name: flag.word().into(),
            meaning: format!("  flag of a case: {}", flag.note()),
            path: FLAGS,
        });
    }
    list
}

/// The rows `| name | meaning |` of a page, without the head of the table.
fn rows(page: &Page) -> Vec<Entry> {
    let mut list = Vec::new();
    let is_row = |line: &&str| line.starts_with("| ");

    for line in page.text.lines().filter(is_row).skip(1) {
        let row = line.trim_start_matches("| ").trim_end_matches(" |");
        if let Some((name, meaning)) = row.split_once(" | ") {
            list.push(Entry {
                name: plain(name),
                meaning: format!("  {}", plain(meaning)),
                path: page.path,
            });
        }
    }
    list
}

/// The items `- **E10** ...` of a page, each up to the next item or the end of its list.
fn equations(page: &Page) -> Vec<Entry> {
    let mut list: Vec<Entry> = Vec::new();
    let mut is_inside = false;

    for line in page.text.lines() {
        let item = line.strip_prefix("- **").and_then(|l| l.split_once("**"));
        if let Some((name, beginning)) = item {
            list.push(Entry {
                name: name.to_string(),
                meaning: format!("  {}", plain(beginning.trim_start())),
                path: page.path,
            });
            is_inside = true;
            continue;
        }

        let continues = line.is_empty() || line.starts_with("  ");
        is_inside = is_inside && continues;
        if let Some(entry) = list.last_mut().filter(|_| is_inside) {
            entry.meaning.push('\n');
            entry.meaning.push_str(&plain(line));
        }
    }

    for entry in &mut list {
        let length = entry.meaning.trim_end().len();
        entry.meaning.truncate(length);
    }
    list
}

/// The sections `## X9. Title` of the errata: the title, and the paragraph that says what is true,
/// else the first one.
fn departures(page: &Page) -> Vec<Entry> {
    let mut list = Vec::new();

    for section in page.text.split("\n## ").skip(1) {
        let title = section.lines().next().unwrap_or_default();
        let Some((name, title)) = title.split_once(". ") else {
            continue;
        };

        let paragraphs: Vec<&str> = section.split("\n\n").skip(1).collect();
        let truth = paragraphs
            .iter()
            .find(|p| p.starts_with("**DIFFERENCE"))
            .or(paragraphs.first());
        let truth = plain(truth.unwrap_or(&"").trim_end());

        list.push(Entry {
            name: name.to_string(),
            meaning: format!("  {title}\n\n  {}", truth.replace('\n', "\n  ")),
            path: page.path,
        });
    }
    list
}

/// Markdown without bold and code marks, and of a link its text.
fn plain(markdown: &str) -> String {
    let text = markdown.replace("**", "").replace('`', "");
    let text = text.replace("\\|", "|").replace("\\*", "*");

    let mut out = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("](") {
        let Some((target, following)) = after.split_once(')') else {
            break;
        };
        let is_link = !target.contains(' ') && before.contains('[');
        if !is_link {
            out.push_str(before);
            out.push_str("](");
            rest = after;
            continue;
        }

        let opening = before.rfind('[').unwrap_or(0);
        out.push_str(&before[..opening]);
        out.push_str(&before[opening + 1..]);
        rest = following;
    }
    out.push_str(rest);
    out
}

/// All names, a page at a time.
fn list_of_names(entries: &[Entry]) -> String {
    let mut text = String::new();
    let mut page = "";

    for entry in entries {
        if entry.path != page {
            page = entry.path;
            text.push_str(&format!("{page}\n"));
        }
        text.push_str(&format!("  {}\n", entry.name));
    }
    text
}

/// The names that hold the term or begin as it does, a few.
fn suggestions(entries: &[Entry], term: &str) -> String {
    let wanted = normal_form(term);
    let beginning: String = wanted.chars().take(3).collect();

    let is_near = |entry: &&Entry| {
        let name = normal_form(&entry.name);
        name.contains(&wanted) || name.starts_with(&beginning)
    };
    let mut near: Vec<&str> = Vec::new();
    for entry in entries.iter().filter(is_near) {
        if !near.contains(&entry.name.as_str()) && near.len() < SUGGESTIONS {
            near.push(&entry.name);
        }
    }

    if near.is_empty() {
        return "mceip explain lists the names".to_string();
    }
    format!("near it are: {}", near.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Words of headings that mean what they say.
    const PLAIN: [&str; 17] = [
        "assembly",
        "begins",
        "cells",
        "change",
        "closed",
        "difference",
        "found",
        "from",
        "ordering",
        "paper",
        "predicted",
        "refused",
        "seconds",
        "state",
        "time",
        "to",
        "where",
    ];

    /// The headings of tables in all source files of a folder.
    fn headings(folder: &Path, found: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                headings(&path, found);
                continue;
            }
            let source = std::fs::read_to_string(&path).unwrap();
            let source = source.split("#[cfg(test)]").next().unwrap_or_default();
            for marker in [
                "Table::new(&[",
                "header = [",
                "header = vec![",
                "HEADER: [&str;",
            ] {
                for list in source.split(marker).skip(1) {
                    let list = list.trim_start_matches(|c: char| " 0123456789]=[".contains(c));
                    let list = list.split(']').next().unwrap_or_default();
                    found.extend(list.split('"').skip(1).step_by(2).map(String::from));
                }
            }
        }
    }

    #[test]
    fn every_heading_of_a_table_is_explained() {
        let mut found = Vec::new();
        headings(
            &Path::new(env!("CARGO_MANIFEST_DIR")).join("src"),
            &mut found,
        );
        assert!(found.len() > 60, "{found:?}");

        let entries = entries();
        let is_known =
            |name: &str| PLAIN.contains(&name) || entries.iter().any(|entry| entry.has_name(name));
        // One of its words, or two neighbours, have to be known.
        let is_explained = |heading: &String| {
            let words: Vec<&str> = heading.split([' ', '/', ',', '(']).collect();
            let mut pairs = words.windows(2).map(|pair| pair.join(" "));
            let is_empty = heading.is_empty() || heading == "#";
            let by_word = words.iter().any(|word| is_known(word));
            is_empty || is_known(heading) || by_word || pairs.any(|pair| is_known(&pair))
        };
        found.retain(|heading| !is_explained(heading));
        assert!(found.is_empty(), "{found:?}");
    }
}
