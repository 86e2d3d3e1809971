//! Reads `spec/traceability.md`: every id it names has a row in `conformance.md`, every row there
//! is used, and every sentence of the README is listed. A new sentence, a new row or a dead
//! reference fails here.

use std::collections::BTreeSet;
use std::path::Path;

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The cells of each row of the tables below a heading.
fn rows(page: &str, heading: &str) -> Vec<Vec<String>> {
    let part = page
        .split(&format!("\n## {heading}\n"))
        .nth(1)
        .unwrap_or_else(|| panic!("no heading {heading}"));
    let part = part.split("\n## ").next().unwrap();
    let cells = |line: &str| {
        line.trim_matches('|')
            .split(" | ")
            .map(|c| c.trim().to_string())
            .collect::<Vec<_>>()
    };
    part.lines()
        .filter(|l| l.starts_with("| ") && !l.contains("| ids |"))
        .map(cells)
        .collect()
}

/// The rows' own ids of the conformance page.
fn known() -> BTreeSet<String> {
    let page = read("spec/conformance.md");
    let rows = page
        .lines()
        .filter(|l| l.starts_with("| ") && !l.starts_with("| id "));
    rows.map(|l| {
        l.trim_matches('|')
            .split('|')
            .next()
            .unwrap()
            .trim()
            .to_string()
    })
    .collect()
}

/// What a reader takes as one statement: a sentence of a paragraph or of an item, or a row of a
/// table. Code, headings and pictures state nothing.
fn sentences(page: &str) -> Vec<String> {
    let mut blocks: Vec<String> = Vec::new();
    let mut open = false;
    for line in page.lines() {
        let separate = line.starts_with("- ") || line.starts_with("| ");
        if line.trim().is_empty()
            || line.starts_with('#')
            || line.starts_with("    ")
            || line.starts_with("![")
            || line.starts_with("|-")
        {
            open = false;
            if line.starts_with("|-") {
                blocks.pop(); // the head of a table
            }
            continue;
        }
        if open && !separate {
            let last = blocks.last_mut().unwrap();
            *last += " ";
            *last += line.trim();
        } else {
            blocks.push(
                line.trim_start_matches("- ")
                    .trim_matches('|')
                    .trim()
                    .to_string(),
            );
        }
        open = !line.starts_with("| ");
    }
    blocks.iter().flat_map(|b| split(b)).collect()
}

/// A sentence ends at a full stop before a blank and a capital, a digit or a backquote.
fn split(block: &str) -> Vec<String> {
    let mut parts = Vec::new();
    let mut rest = block;
    let mut from = 0;
    while let Some(at) = rest[from..].find(". ").map(|k| from + k) {
        let next = rest[at + 2..]
            .trim_start_matches(['*', '[', '('])
            .chars()
            .next();
        if next.is_some_and(|c| c.is_uppercase() || c == '`') {
            parts.push(rest[..=at].to_string());
            rest = &rest[at + 2..];
            from = 0;
        } else {
            from = at + 2;
        }
    }
    parts.push(rest.to_string());
    parts
}

#[test]
fn every_id_is_known_and_every_row_is_used() {
    let (page, known) = (read("spec/traceability.md"), known());
    let mut used = BTreeSet::new();
    for heading in ["The paper", "The README", "Elsewhere"] {
        for row in rows(&page, heading) {
            for id in row
                .last()
                .unwrap()
                .split_whitespace()
                .filter(|id| *id != "-")
            {
                assert!(
                    known.contains(id),
                    "{heading}: {id} of {row:?} has no row in conformance.md"
                );
                used.insert(id.to_string());
            }
        }
    }
    let unused: Vec<_> = known.difference(&used).collect();
    assert!(
        unused.is_empty(),
        "rows of conformance.md that nothing is traced to: {unused:?}"
    );
}

#[test]
fn every_sentence_of_the_readme_is_traced() {
    let keys: Vec<String> = rows(&read("spec/traceability.md"), "The README")
        .into_iter()
        .map(|mut r| r.swap_remove(0))
        .collect();
    let sentences = sentences(&read("README.md"));
    let plain = |s: &str| s.replace(" | ", " / ");
    let untraced: Vec<String> = sentences
        .iter()
        .map(|s| plain(s))
        .filter(|s| keys.iter().filter(|k| s.starts_with(*k)).count() != 1)
        .collect();
    assert!(
        untraced.is_empty(),
        "sentences of the README without a row of their own:\n{}",
        untraced.join("\n")
    );
    let stale: Vec<&String> = keys
        .iter()
        .filter(|k| !sentences.iter().any(|s| plain(s).starts_with(*k)))
        .collect();
    assert!(stale.is_empty(), "rows without a sentence: {stale:?}");
}

/// A sentence that quotes a time names a row whose status is *measured*, and its section a date.
#[test]
fn figures_are_traced_to_a_measured_row_and_dated() {
    let (page, readme) = (read("spec/conformance.md"), read("README.md"));
    let measured: BTreeSet<&str> = page
        .lines()
        .filter(|l| l.contains("| measured |"))
        .map(|l| l.trim_matches('|').split('|').next().unwrap().trim())
        .collect();
    let trace = rows(&read("spec/traceability.md"), "The README");
    let mut timed = 0;
    for section in readme.split("\n## ") {
        for sentence in sentences(section).iter().filter(|s| quotes_a_time(s)) {
            let row = trace
                .iter()
                .find(|r| sentence.replace(" | ", " / ").starts_with(&r[0]))
                .unwrap();
            assert!(
                row[1].split_whitespace().any(|id| measured.contains(id)),
                "{sentence}: traced to {}",
                row[1]
            );
            assert!(section.contains("2026-"), "no date beside: {sentence}");
            timed += 1;
        }
    }
    assert!(timed > 5, "{timed}");
}

/// A number followed by s, ms or us.
fn quotes_a_time(sentence: &str) -> bool {
    let words: Vec<&str> = sentence
        .split_whitespace()
        .map(|w| w.trim_matches(['(', ')', ',', ';', '.', ':']))
        .collect();
    words
        .windows(2)
        .any(|w| w[0].parse::<f64>().is_ok() && ["s", "ms", "us"].contains(&w[1]))
}

#[test]
fn paths_named_in_the_readme_exist() {
    let readme = read("README.md");
    let rooms = [
        "src/", "crates/", "spec/", "tests/", "fuzz/", "benches/", ".ci/",
    ];
    let named = readme
        .split(['`', '(', ')', ' ', '\n'])
        .filter(|w| rooms.iter().any(|r| w.starts_with(r)));
    let named: Vec<&str> = named
        .map(|w| {
            w.split("::")
                .next()
                .unwrap()
                .trim_end_matches([',', '.', ';', ':'])
        })
        .collect();
    let missing: Vec<&&str> = named
        .iter()
        .filter(|p| !Path::new(env!("CARGO_MANIFEST_DIR")).join(p).exists())
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
    assert!(named.len() > 40);
}

#[test]
fn sentences_are_found_and_code_is_not() {
    let page = "# Head\n\nOne `a.b` holds. Two\nholds (v. 3). `Three` too.\n\n    code. Here\n\n- an item. Another\n\n| a | b |\n|---|---|\n| x | y. Z |\n![p](q)\n";
    let found = sentences(page);
    assert_eq!(
        found,
        [
            "One `a.b` holds.",
            "Two holds (v. 3).",
            "`Three` too.",
            "an item.",
            "Another",
            "x | y.",
            "Z"
        ]
    );
}
