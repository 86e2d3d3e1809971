//! Reads `spec/conformance.md`: every id has a row, every row a status and tests that exist.
//!
//! The truth is the chapters of the book for the ids and the test files for the names. A row whose
//! test was renamed, an equation without a row, or a claim that only ignored tests support without
//! saying so fails here.

use crate::{read, root};
use std::collections::BTreeSet;

/// What a row may say of its claim; the page says what each means.
const STATUSES: [&str; 7] = [
    "proved",
    "checked",
    "measured",
    "refuted",
    "not reproduced",
    "transcript",
    "absent",
];

/// The chapters that define the equations by their ids.
const CHAPTERS: [&str; 5] = [
    "problem",
    "reduction",
    "solver",
    "enumeration",
    "paper-examples",
];

fn text_of(path: &str) -> Option<String> {
    std::fs::read_to_string(root().join(path)).ok()
}

/// A row of the page.
struct Row {
    id: String,
    claim: String,
    status: String,
    /// The tests that it rests on: file and function.
    tests: Vec<String>,
}

/// The rows of all tables of the page.
fn rows(page: &str) -> Vec<Row> {
    page.lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| id "))
        .map(read_row)
        .collect()
}

/// Reads a row `| id | claim | status | tests in backquotes |`.
fn read_row(line: &str) -> Row {
    let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
    let [id, claim, status, tests] = cells[..] else {
        panic!("{line}: expected four cells")
    };

    // Every second part of a text split at backquotes stood between two of them.
    let quoted = tests.split('`').skip(1).step_by(2);
    Row {
        id: id.into(),
        claim: claim.into(),
        status: status.into(),
        tests: quoted.map(str::to_string).collect(),
    }
}

/// Does `file::name` name a test function in that file, a macro-made one, or one that is run for
/// each file of a folder? Or is it a page of transcripts?
fn exists(test: &str) -> bool {
    if test.starts_with("tests/transcripts/") {
        return root().join(test).is_file();
    }
    let Some((file, name)) = test.split_once("::") else {
        return false;
    };
    let Some(text) = text_of(file) else {
        return false;
    };
    let Some((before, _)) = text.split_once(&format!("fn {name}(")) else {
        return false;
    };
    if text.contains(&format!("Trial::test(name, move || {name}(")) {
        return true;
    }

    // The attribute stands in the lines directly above, or a macro makes the function a test.
    let mut above = before.lines().rev().take(3);
    above.any(|line| line.trim() == "#[test]") || before.contains("quickcheck! {")
}

/// Does `cargo test` leave the test out?
fn is_ignored(test: &str) -> bool {
    let Some((file, name)) = test.split_once("::") else {
        return false;
    };
    let text = text_of(file).unwrap_or_default();
    let declaration = format!("fn {name}(");
    let before = text.split(&declaration).next().unwrap_or_default();

    let mut above = before.lines().rev().take(3);
    above.any(|line| line.trim().starts_with("#[ignore"))
}

/// A claim that rests on ignored tests alone says that it is opt-in.
#[test]
fn claims_of_ignored_tests_say_that_they_are_opt_in() {
    for row in rows(&read("spec/conformance.md")) {
        let tests = &row.tests;
        if tests.is_empty() || !tests.iter().all(|test| is_ignored(test)) {
            continue;
        }

        assert!(
            row.claim.contains("(opt-in)"),
            "{} rests on {tests:?}, which nothing runs by default",
            row.id
        );
    }

    assert!(is_ignored(
        "tests/complete/complete_block.rs::every_state_of_the_loading_path_is_closed"
    ));
    assert!(!is_ignored(
        "tests/pages/conformance.rs::a_missing_test_would_be_noticed"
    ));
}

#[test]
fn every_row_names_a_status_and_tests_that_exist() {
    let rows = rows(&read("spec/conformance.md"));
    let mut seen = BTreeSet::new();

    for row in &rows {
        let id = &row.id;
        let status = row.status.as_str();
        assert!(seen.insert(id.clone()), "{id} twice");
        assert!(STATUSES.contains(&status), "{id}: status {status:?}");

        let tests = &row.tests;
        assert_eq!(
            tests.is_empty(),
            status == "absent",
            "{id} is {status} with tests {tests:?}"
        );

        for test in tests {
            assert!(exists(test), "{id}: no test {test}");
        }
    }

    assert!(rows.len() > 50);
}

#[test]
fn every_id_of_the_equations_page_has_a_row() {
    let rows = rows(&read("spec/conformance.md"));
    let ids: BTreeSet<String> = rows.into_iter().map(|row| row.id).collect();
    let chapters = CHAPTERS.map(|page| read(format!("spec/{page}.md")));
    let equations = chapters.join("\n");

    let numbered = (1..=34).map(|number| format!("E{number}"));
    let named = ["P1", "P2", "R1", "W1", "T1"].map(String::from);

    for id in numbered.chain(named) {
        assert!(ids.contains(&id), "no row for {id}");

        let mut words = equations.split(|c: char| !c.is_alphanumeric());
        assert!(words.any(|word| word == id), "no chapter defines {id}");
    }
}

#[test]
fn a_missing_test_would_be_noticed() {
    assert!(!exists("tests/pages/conformance.rs::no_such_test_is_here"));
    assert!(!exists("tests/nowhere.rs::every_row"));
    assert!(!exists("nonsense"));
    assert!(!exists("tests/pages/conformance.rs::exists")); // a helper is no test
    assert!(!exists("tests/data/corpus.rs::judge"));
    assert!(!exists("tests/transcripts/no-such-page.md"));
    assert!(exists(
        "tests/pages/conformance.rs::a_missing_test_would_be_noticed"
    ));
}
