//! Reads `spec/traceability.md`: every id it names has a row in `conformance.md`, every row there
//! is used, and every claim stands in the README, which is short.
//!
//! The truth is `conformance.md` and the README. A new guarantee without a trace, a new row that
//! nothing is traced to, or a reference to something that is gone fails here.

use crate::{read, root};
use std::collections::BTreeSet;

/// The cells of each row of the tables below a heading.
fn rows(page: &str, heading: &str) -> Vec<Vec<String>> {
    let from_heading = page
        .split(&format!("\n## {heading}\n"))
        .nth(1)
        .unwrap_or_else(|| panic!("no heading {heading}"));
    let section = from_heading.split("\n## ").next().unwrap();

    section
        .lines()
        .filter(|line| line.starts_with("| ") && !line.contains("| ids |"))
        .map(cells)
        .collect()
}

/// The cells of a row. They are parted by a bar between blanks, so that |x| may stand in one.
fn cells(row: &str) -> Vec<String> {
    let parts = row.trim_matches('|').split(" | ");
    parts.map(|cell| cell.trim().to_string()).collect()
}

/// The rows' own ids of the conformance page.
fn known() -> BTreeSet<String> {
    let page = read("spec/conformance.md");
    let rows = page
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| id "));
    rows.map(first_cell).collect()
}

fn first_cell(row: &str) -> String {
    let cell = row.trim_matches('|').split('|').next().unwrap();
    cell.trim().to_string()
}

#[test]
fn every_id_is_known_and_every_row_is_used() {
    let page = read("spec/traceability.md");
    let known = known();
    let mut used = BTreeSet::new();

    for heading in ["The paper", "The README", "Elsewhere"] {
        for row in rows(&page, heading) {
            let ids = row.last().unwrap().split_whitespace();
            for id in ids.filter(|id| *id != "-") {
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

/// A text with every run of blanks and line ends as one blank.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_claim_stands_in_the_readme_and_every_guarantee_is_a_claim() {
    let page = read("spec/traceability.md");
    let claims: Vec<String> = rows(&page, "The README")
        .into_iter()
        .map(|mut row| row.swap_remove(0))
        .filter(|claim| claim != "claim")
        .collect();
    let readme = read("README.md");

    let text = unwrapped(&readme);
    let stale: Vec<&String> = claims.iter().filter(|c| !text.contains(*c)).collect();
    assert!(
        stale.is_empty(),
        "claims that the README does not make: {stale:?}"
    );

    let guarantees = rows(&readme, "What is guaranteed, and by whom");
    assert!(guarantees.len() > 8);

    for row in guarantees.iter().filter(|row| row[0] != "you get") {
        assert!(claims.contains(&row[0]), "{} is traced to nothing", row[0]);
    }
}

/// The README is one page, and figures of runs stand in `spec/measurements.md`.
#[test]
fn the_readme_is_short_and_quotes_no_time() {
    let readme = read("README.md");

    assert!(readme.lines().count() <= 150);
    for line in readme.lines() {
        assert!(line.chars().count() <= 100, "{line}");
    }

    let timed: Vec<&str> = readme.lines().filter(|line| quotes_a_time(line)).collect();
    assert!(timed.is_empty(), "{timed:?}");
    assert!(quotes_a_time("it took 2.5 s, then"));
}

/// A number followed by s, ms or us.
fn quotes_a_time(sentence: &str) -> bool {
    let words: Vec<&str> = sentence
        .split_whitespace()
        .map(|word| word.trim_matches(['(', ')', ',', ';', '.', ':']))
        .collect();

    words.windows(2).any(|pair| {
        let is_number = pair[0].parse::<f64>().is_ok();
        let is_unit = ["s", "ms", "us"].contains(&pair[1]);
        is_number && is_unit
    })
}

#[test]
fn paths_named_in_the_readme_exist() {
    let readme = read("README.md");
    let folders = [
        "src/",
        "crates/",
        "spec/",
        "tests/",
        "fuzz/",
        "benches/",
        "examples/",
        ".ci/",
    ];
    let words = readme.split(['`', '(', ')', ' ', '\n']);
    let paths = words.filter(|word| folders.iter().any(|folder| word.starts_with(folder)));

    let mut named = 0;
    for path in paths {
        let file = path.split("::").next().unwrap();
        let file = file.trim_end_matches([',', '.', ';', ':']);
        let exists = root().join(file).exists();

        assert!(exists, "{file}");

        named += 1;
    }

    assert!(named > 20);
}
