//! The planted bugs of `spec/planted`: each still applies to the sources, and names a test that
//! exists. That the tests fail with them is run by `spec/planted/run`; its last result is
//! `spec/planted/report.md`.
//!
//! The truth is the source files. A bug whose place has changed, whose test is gone, or that the
//! report does not mention fails here.

use crate::{read, root};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A patch of `spec/planted/bugs`.
struct Bug {
    name: String,
    /// The file that the patch changes.
    file: String,
    /// The test that notices the bug: file and function, or a page of transcripts.
    test: String,
    hunks: Vec<Hunk>,
}

/// One place of a patch.
#[derive(Default)]
struct Hunk {
    /// The text that must stand in the file.
    before: String,
    /// The text that takes its place.
    after: String,
}

fn bug_of(path: &Path) -> Bug {
    let text = read(path);
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    assert!(!field(&name, &text, "bug: ").is_empty());

    Bug {
        file: field(&name, &text, "+++ b/").into(),
        test: field(&name, &text, "test: ").into(),
        hunks: hunks(&text),
        name,
    }
}

/// The rest of the first line of a patch that begins with `key`.
fn field<'a>(name: &str, text: &'a str, key: &str) -> &'a str {
    text.lines()
        .find_map(|line| line.strip_prefix(key))
        .unwrap_or_else(|| panic!("{name}: no {key:?}"))
}

/// The hunks of a patch in the unified format.
fn hunks(text: &str) -> Vec<Hunk> {
    let mut hunks: Vec<Hunk> = Vec::new();

    for line in text.lines().skip_while(|line| !line.starts_with("@@")) {
        if line.starts_with("@@") {
            hunks.push(Hunk::default());
            continue;
        }

        let hunk = hunks.last_mut().unwrap();
        let (mark, code) = line.split_at_checked(1).unwrap_or((" ", ""));

        if mark != "+" {
            hunk.before += &format!("{code}\n");
        }

        if mark != "-" {
            hunk.after += &format!("{code}\n");
        }
    }
    hunks
}

fn bugs() -> Vec<Bug> {
    let folder = std::fs::read_dir(root().join("spec/planted/bugs")).unwrap();
    let mut files: Vec<PathBuf> = folder.map(|file| file.unwrap().path()).collect();
    files.sort();

    files.iter().map(|file| bug_of(file)).collect()
}

#[test]
fn every_bug_still_applies() {
    for bug in bugs() {
        let source = read(&bug.file);
        assert!(!bug.hunks.is_empty(), "{}", bug.name);

        for hunk in &bug.hunks {
            let places = source.matches(&hunk.before).count();
            assert_eq!(
                places, 1,
                "{}: its place in {} is gone: make the patch anew",
                bug.name, bug.file
            );
            assert_ne!(hunk.before, hunk.after, "{}", bug.name);
        }
    }
}

#[test]
fn every_bug_names_a_test_that_exists() {
    for bug in bugs() {
        let (file, name) = bug.test.split_once("::").unwrap_or((&bug.test, ""));
        let function = name.rsplit("::").next().unwrap();
        let source = read(file);
        let is_page = file.starts_with("tests/transcripts/");

        assert!(
            is_page || source.contains(&format!("fn {function}(")),
            "{}: no {function} in {file}",
            bug.name
        );

        // A bug in the tests' own code would prove nothing.
        let is_in_sources = bug.file.starts_with("src/") || bug.file.starts_with("crates/");
        let is_in_testkit = bug.file.contains("testkit");
        assert!(is_in_sources && !is_in_testkit, "{}", bug.name);
    }
}

#[test]
fn there_are_bugs_in_every_room_that_decides() {
    let list = bugs();
    let parts: BTreeSet<&str> = list.iter().flat_map(|bug| bug.file.split('/')).collect();

    for part in [
        "check",
        "oracle",
        "exact",
        "reduction",
        "certify",
        "model",
        "search",
        "solver",
    ] {
        assert!(parts.contains(part), "no bug in {part}");
    }

    assert!(list.len() >= 30);
}

/// The report speaks of these bugs, and none of them survived.
#[test]
fn the_report_lists_every_bug() {
    let report = read("spec/planted/report.md");
    for bug in bugs() {
        let quoted = format!("`{}`", bug.name);
        let row = report
            .lines()
            .find(|line| line.contains(&quoted))
            .unwrap_or_else(|| panic!("{} has no row", bug.name));

        assert!(row.contains(&bug.test), "{row}");
        assert!(!row.contains("SURVIVED"), "{row}");
    }
}
