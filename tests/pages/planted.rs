//! The planted bugs of `spec/planted`: each still applies to the sources, and names a test that
//! exists. That the tests fail with them is run by `spec/planted/run`; its last result is
//! `spec/planted/report.md`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

struct Bug {
    name: String,
    file: String,
    test: String,
    /// What must be in the file, and what takes its place, hunk by hunk.
    hunks: Vec<(String, String)>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn read(path: &Path) -> Bug {
    let text = std::fs::read_to_string(path).unwrap();
    let after = |key: &str| {
        text.lines()
            .find_map(|l| l.strip_prefix(key))
            .unwrap_or_else(|| panic!("{}: no {key:?}", path.display()))
    };
    assert!(!after("bug: ").is_empty());
    let mut hunks: Vec<(String, String)> = Vec::new();
    for line in text.lines().skip_while(|l| !l.starts_with("@@")) {
        if line.starts_with("@@") {
            hunks.push(Default::default());
            continue;
        }
        let (before, now) = hunks.last_mut().unwrap();
        let (mark, rest) = line.split_at_checked(1).unwrap_or((" ", ""));
        if mark != "+" {
            *before += &format!("{rest}\n");
        }
        if mark != "-" {
            *now += &format!("{rest}\n");
        }
    }
    Bug {
        name: path.file_stem().unwrap().to_string_lossy().into_owned(),
        file: after("+++ b/").into(),
        test: after("test: ").into(),
        hunks,
    }
}

fn bugs() -> Vec<Bug> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(root().join("spec/planted/bugs"))
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    files.sort();
    files.iter().map(|f| read(f)).collect()
}

#[test]
fn every_bug_still_applies() {
    for bug in bugs() {
        let source = std::fs::read_to_string(root().join(&bug.file)).unwrap();
        assert!(!bug.hunks.is_empty(), "{}", bug.name);
        for (before, now) in &bug.hunks {
            assert_eq!(
                source.matches(before).count(),
                1,
                "{}: its place in {} is gone: make the patch anew",
                bug.name,
                bug.file
            );
            assert_ne!(before, now, "{}", bug.name);
        }
    }
}

#[test]
fn every_bug_names_a_test_that_exists() {
    for bug in bugs() {
        let (file, name) = bug.test.split_once("::").unwrap();
        let function = name.rsplit("::").next().unwrap();
        let source = std::fs::read_to_string(root().join(file)).unwrap();
        assert!(
            source.contains(&format!("fn {function}(")),
            "{}: no {function} in {file}",
            bug.name
        );
        // A bug in the tests' own code would prove nothing.
        assert!(
            ["src/", "crates/"].iter().any(|f| bug.file.starts_with(f))
                && !bug.file.contains("testkit"),
            "{}",
            bug.name
        );
    }
}

#[test]
fn there_are_bugs_in_every_room_that_decides() {
    let list = bugs();
    let rooms: BTreeSet<&str> = list.iter().flat_map(|b| b.file.split('/')).collect();
    for room in [
        "check",
        "oracle",
        "exact",
        "reduction",
        "certify",
        "model",
        "search",
        "solver",
    ] {
        assert!(rooms.contains(room), "no bug in {room}");
    }
    assert!(list.len() >= 30);
}

/// The report speaks of these bugs, and none of them survived.
#[test]
fn the_report_lists_every_bug() {
    let report = std::fs::read_to_string(root().join("spec/planted/report.md")).unwrap();
    for bug in bugs() {
        let row = report
            .lines()
            .find(|l| l.contains(&format!("`{}`", bug.name)))
            .unwrap_or_else(|| panic!("{} has no row", bug.name));
        assert!(
            row.contains(&bug.test) && !row.contains("SURVIVED"),
            "{row}"
        );
    }
}
