//! `spec/` as a book: `SUMMARY.md` lists every page once, every link to a file of the repository
//! leads to one, lines have at most 100 columns, and every reason of rejection has its row.
//!
//! The truth is the list of files and the source of the checker. A page without an entry, a link to
//! a file that is gone or a new reason without a row fails here.

use crate::{read, root};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The targets of the links and pictures of a page, code left out.
fn targets(page: &str) -> Vec<String> {
    let mut list = Vec::new();
    let mut in_code = false;

    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }

        if in_code || line.starts_with("    ") {
            continue;
        }

        for part in line.split("](").skip(1) {
            let target = part.split(')').next().unwrap();
            list.push(target.split('#').next().unwrap().to_string());
        }
    }

    list.retain(|target| !target.is_empty() && !target.contains("://"));
    list
}

/// The pages of the book: those beside the summary.
fn pages() -> BTreeSet<String> {
    let files = std::fs::read_dir(root().join("spec")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());

    names
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .collect()
}

#[test]
fn the_summary_lists_every_page_once() {
    let listed = targets(&read("spec/SUMMARY.md"));
    for page in pages() {
        let times = listed.iter().filter(|target| **target == page).count();
        assert_eq!(times, 1, "{page} in SUMMARY.md");
    }
}

#[test]
fn every_link_leads_to_a_file() {
    let spec = root().join("spec");
    let mut list: Vec<PathBuf> = pages().iter().map(|page| spec.join(page)).collect();
    list.push(root().join("spec/SUMMARY.md"));
    list.push(root().join("README.md"));

    let mut links = 0;
    for page in list {
        for target in targets(&read(&page)) {
            let path = page.parent().unwrap().join(&target);
            assert!(path.exists(), "{}: {target}", page.display());

            links += 1;
        }
    }

    assert!(links > 50, "{links}");
}

/// mdBook makes a page of HTML of each page in the summary, and of no other file; a README becomes
/// `index.html`, under which links do not find it.
#[test]
fn links_between_pages_lead_to_pages_of_the_book() {
    let spec = root().join("spec");
    let listed = targets(&read("spec/SUMMARY.md"));

    for page in pages() {
        for target in targets(&read(spec.join(&page))) {
            let is_page = target.ends_with(".md") && !target.starts_with("..");
            let is_readme = target.ends_with("README.md");
            let is_listed = listed.contains(&target) && !is_readme;

            assert!(!is_page || is_listed, "{page}: {target}");
        }
    }
}

/// Tables aside, and what programs print, a page can be read in a window of 100 columns.
#[test]
fn lines_have_at_most_a_hundred_columns() {
    for page in pages() {
        let text = read(root().join("spec").join(&page));
        let mut in_code = false;

        for (number, line) in text.lines().enumerate() {
            if line.trim_start().starts_with("```") {
                in_code = !in_code;
            }

            let is_code = in_code || line.starts_with("    ");
            let is_table = line.trim_start().starts_with('|');
            let columns = line.chars().count();

            assert!(
                is_code || is_table || columns <= 100,
                "{page}:{}: {columns}",
                number + 1
            );
        }
    }
}

#[test]
fn targets_are_found_and_code_is_not() {
    let page = "[a](b.md#c) and [d](https://e) ![f](g/h.svg)\n\n    [i](j)\n```\n[k](l)\n```\n";
    assert_eq!(targets(page), ["b.md", "g/h.svg"]);
}

/// The variants of the enum that a source file declares.
fn variants(source: &str) -> BTreeSet<String> {
    let text = read(source);
    let declaration = text.split("\npub enum ").nth(1).unwrap();
    let body = declaration.split("\n}\n").next().unwrap();

    let mut names = BTreeSet::new();
    for line in body.lines() {
        let Some(line) = line.strip_prefix("    ") else {
            continue;
        };
        if line.starts_with(|c: char| c.is_ascii_uppercase()) {
            let name = line.split(|c: char| !c.is_ascii_alphanumeric()).next();
            names.insert(name.unwrap().to_string());
        }
    }

    names
}

/// Each reason for which the checker rejects has a row of appendix F, and no other name has.
#[test]
fn every_reason_of_rejection_is_explained() {
    let mut expected = variants("crates/check/src/reason.rs");
    for fault in variants("crates/check/src/cover/fault.rs") {
        expected.insert(format!("Cover.{fault}"));
    }

    let page = read("spec/reasons.md");
    let rows = page.lines().filter(|line| line.starts_with("| ")).skip(1);
    let explained: Vec<String> = rows
        .map(|row| row.split(" | ").next().unwrap()[2..].to_string())
        .collect();

    assert!(expected.len() > 50, "{}", expected.len());
    assert_eq!(explained.iter().cloned().collect::<BTreeSet<_>>(), expected);
    assert_eq!(explained.len(), expected.len(), "a name stands twice");
}

/// The Rust files below a folder, by their paths within it; modules of unit tests left out.
fn sources(folder: &Path) -> BTreeSet<String> {
    let mut files = BTreeSet::new();
    let mut stack = vec![folder.to_path_buf()];

    while let Some(place) = stack.pop() {
        for entry in std::fs::read_dir(&place).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                stack.push(path);
                continue;
            }

            let name = path.strip_prefix(folder).unwrap().to_str().unwrap();
            let is_for_tests = name.ends_with("tests.rs") || name.ends_with("order_two.rs");
            if name.ends_with(".rs") && !is_for_tests {
                files.insert(name.to_string());
            }
        }
    }
    files
}

/// The reading list of 10.3 has every file of the checker, each once.
#[test]
fn the_reading_list_has_every_file_of_the_checker() {
    let page = read("spec/verifying.md");
    let section = page.split("## 10.3 Read the checker").nth(1).unwrap();
    let table = section.split("Machine integers").next().unwrap();

    // Every second part of a text split at backquotes stood between two of them.
    let quoted = table.split('`').skip(1).step_by(2);
    let listed: Vec<&str> = quoted.filter(|name| name.ends_with(".rs")).collect();

    let expected = sources(&root().join("crates/check/src"));
    let found: BTreeSet<String> = listed.iter().map(|name| name.to_string()).collect();
    assert!(expected.len() > 35, "{}", expected.len());
    assert_eq!(found, expected);
    assert_eq!(listed.len(), expected.len(), "a file stands twice");
}
