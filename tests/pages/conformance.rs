//! Reads `spec/conformance.md`: every id has a row, every row a status and tests that exist.

use std::collections::BTreeSet;
use std::path::Path;

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

fn read(path: &str) -> Option<String> {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).ok()
}

/// (id, status, tests) of each row.
fn rows(page: &str) -> Vec<(String, String, Vec<String>)> {
    let cells = |line: &str| {
        line.trim_matches('|')
            .split('|')
            .map(|c| c.trim().to_string())
            .collect::<Vec<_>>()
    };
    let lines = page
        .lines()
        .filter(|l| l.starts_with("| ") && !l.starts_with("| id "));
    lines
        .map(|line| {
            let cells = cells(line);
            assert_eq!(cells.len(), 4, "{line}");
            let tests = cells[3]
                .split('`')
                .skip(1)
                .step_by(2)
                .map(str::to_string)
                .collect();
            (cells[0].clone(), cells[2].clone(), tests)
        })
        .collect()
}

/// Does `file::name` name a test function (or a macro-made one) in that file?
fn exists(test: &str) -> bool {
    let Some((file, name)) = test.split_once("::") else {
        return false;
    };
    let Some(text) = read(file) else { return false };
    let Some((before, _)) = text.split_once(&format!("fn {name}(")) else {
        return false;
    };
    // #[test] directly above, or within a proptest! or quickcheck! block.
    let above: Vec<&str> = before.lines().rev().take(3).collect();
    above.iter().any(|l| l.trim() == "#[test]") || before.contains("quickcheck! {")
}

/// Does `cargo test` leave the test out?
fn is_ignored(test: &str) -> bool {
    let Some((file, name)) = test.split_once("::") else {
        return false;
    };
    let text = read(file).unwrap_or_default();
    let before = text
        .split(&format!("fn {name}("))
        .next()
        .unwrap_or_default();
    before
        .lines()
        .rev()
        .take(3)
        .any(|l| l.trim().starts_with("#[ignore"))
}

/// A claim that rests on ignored tests alone says that it is opt-in.
#[test]
fn claims_of_ignored_tests_say_that_they_are_opt_in() {
    for (id, tests, claim) in claims(&read("spec/conformance.md").unwrap()) {
        if tests.is_empty() || !tests.iter().all(|t| is_ignored(t)) {
            continue;
        }
        assert!(
            claim.contains("(opt-in)"),
            "{id} rests on {tests:?}, which nothing runs by default"
        );
    }

    assert!(is_ignored(
        "tests/complete/complete_block.rs::every_state_of_the_loading_path_is_closed"
    ));
    assert!(!is_ignored(
        "tests/pages/conformance.rs::a_missing_test_would_be_noticed"
    ));
}

/// (id, tests, claim) of each row.
fn claims(page: &str) -> Vec<(String, Vec<String>, String)> {
    let mut out = Vec::new();
    for line in page
        .lines()
        .filter(|l| l.starts_with("| ") && !l.starts_with("| id "))
    {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let tests = cells[3]
            .split('`')
            .skip(1)
            .step_by(2)
            .map(str::to_string)
            .collect();
        out.push((cells[0].to_string(), tests, cells[1].to_string()));
    }
    out
}

#[test]
fn every_row_names_a_status_and_tests_that_exist() {
    let rows = rows(&read("spec/conformance.md").unwrap());
    let mut seen = BTreeSet::new();
    for (id, status, tests) in &rows {
        assert!(seen.insert(id.clone()), "{id} twice");
        assert!(
            STATUSES.contains(&status.as_str()),
            "{id}: status {status:?}"
        );
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
    let ids: BTreeSet<String> = rows(&read("spec/conformance.md").unwrap())
        .into_iter()
        .map(|r| r.0)
        .collect();
    let wanted = (1..=34)
        .map(|k| format!("E{k}"))
        .chain(["P1", "P2", "R1", "W1", "T1"].map(String::from));
    let chapters = CHAPTERS.map(|page| read(&format!("spec/{page}.md")).unwrap());
    let equations = chapters.join("\n");
    for id in wanted {
        assert!(ids.contains(&id), "no row for {id}");
        let words = equations.split(|c: char| !c.is_alphanumeric());
        assert!(words.clone().any(|w| w == id), "no chapter defines {id}");
    }
}

#[test]
fn a_missing_test_would_be_noticed() {
    assert!(!exists("tests/pages/conformance.rs::no_such_test_is_here"));
    assert!(!exists("tests/nowhere.rs::every_row"));
    assert!(!exists("nonsense"));
    assert!(!exists("tests/pages/conformance.rs::exists")); // a helper is no test
    assert!(exists(
        "tests/pages/conformance.rs::a_missing_test_would_be_noticed"
    ));
}
