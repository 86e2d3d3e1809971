//! `spec/corpus` as a whole: files of every verdict, a forgery of every obligation, bounds on time
//! and memory of the program, and the verdicts of `spec/checker.py`.
//!
//! The verdict of a file is written down in it and known from how the file was made; no checker is
//! asked for it. `tests/data/corpus.rs` holds our checker against each file.
#![cfg(feature = "cli")]

use crate::corpus_reader::{Entry, MALFORMED, entries};
use crate::python_checker::codes;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

#[test]
fn there_are_files_of_every_verdict() {
    let mut seen = [0; 4];
    for entry in entries() {
        seen[usize::try_from(entry.code).unwrap()] += 1;
    }

    println!("accepted, rejected, malformed, undecided: {seen:?}");
    let [accepted, rejected, malformed, undecided] = seen;
    assert!(rejected >= accepted + undecided, "{seen:?}");
    assert!(accepted >= 130, "{seen:?}");
    assert!(rejected >= 450, "{seen:?}");
    assert!(malformed >= 140, "{seen:?}");
    assert!(undecided >= 5, "{seen:?}");
}

/// Reasons that no file reaches: a claim and a cover that contradict each other are not both true,
/// and a checker that accepts nothing false refuses the false one by its own obligations.
/// `crates/check/src/lib.rs` tests it on made-up covers. A negative slip is a reason against
/// numbers without a certificate: `crates/check/src/backward_error.rs` tests it. A file with a kind
/// of node that its format has not is malformed: `crates/check/src/cover/walk.rs` tests the rest.
/// The pencil of an equilibrium is square, so that the model refuses none.
const UNREACHABLE: [&str; 4] = ["NotInCover", "XNegative", "Cover.Kind", "NoPencil"];

/// Each obligation of the checker is the reason of some file. The obligations are the variants of
/// the enumerations in the source, so that a new one without a file is noticed.
#[test]
fn every_obligation_has_a_forgery() {
    let entries = entries();
    let all = reasons(entries.iter());
    let of_plain = reasons(entries.iter().filter(|entry| entry.is_plain()));

    let mut missing = Vec::new();
    for name in variants("crates/check/src/reason.rs", "Reason") {
        let is_exempt = ["Cover", "Boxes", "Matrices"].contains(&name.as_str())
            || UNREACHABLE.contains(&name.as_str());
        if !is_exempt && !all.contains(&name) {
            missing.push(name);
        }
    }

    for name in variants("crates/check/src/cover/fault.rs", "CoverFault") {
        let reason = format!("Cover.{name}");
        if !all.contains(&reason) && !UNREACHABLE.contains(&reason.as_str()) {
            missing.push(reason);
        }
    }

    let mut plain = variants("crates/engine/src/lcp/verdict.rs", "McpRejected");
    plain.extend(variants("crates/engine/src/lcp/check.rs", "Violated"));
    for name in plain {
        if name != "Solution" && !of_plain.contains(&name) {
            missing.push(format!("plain {name}"));
        }
    }

    assert!(missing.is_empty(), "no forgery for {missing:?}");
}

/// The reasons that files give.
fn reasons<'a>(entries: impl Iterator<Item = &'a Entry>) -> BTreeSet<String> {
    entries
        .map(|entry| entry.reason.clone())
        .filter(|reason| !reason.is_empty())
        .collect()
}

/// The names of the variants of an enumeration in a file of the source.
fn variants(file: &str, enumeration: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let start = format!("pub enum {enumeration} {{");
    let (_, after_start) = text.split_once(&start).unwrap();
    let (body, _) = after_start.split_once("\n}").unwrap();

    let mut names = Vec::new();
    for line in body.lines() {
        let Some(declaration) = line.strip_prefix("    ") else {
            continue;
        };
        if declaration.starts_with(char::is_uppercase) {
            let name = declaration.chars().take_while(char::is_ascii_alphanumeric);
            names.push(name.collect());
        }
    }
    names
}

/// From outside: exit codes, one line on stderr for what is malformed, 512 MiB of addresses and ten
/// seconds of processor time at most. (The program that is released takes less than half of the
/// time of this unoptimised one.)
#[test]
fn the_program_stays_within_bounds() {
    let folder = tempfile::tempdir().unwrap();
    for entry in entries() {
        let is_heavy = entry.is_repeated() || entry.name.contains("hostile");
        if entry.code == MALFORMED || is_heavy {
            assert_within_bounds(&entry, folder.path());
        }
    }
}

fn assert_within_bounds(entry: &Entry, folder: &Path) {
    let name = &entry.name;
    let start = Instant::now();
    let output = Command::new("sh")
        .arg("-c")
        .arg("ulimit -v 524288; ulimit -t 10; exec \"$0\" check \"$1\" \"$2\"")
        .arg(env!("CARGO_BIN_EXE_mceip"))
        .args(entry.write(folder))
        .output()
        .unwrap();
    let elapsed = start.elapsed();
    let err = String::from_utf8_lossy(&output.stderr);

    assert_eq!(output.status.code(), Some(entry.code), "{name}: {err}");
    assert!(elapsed < Duration::from_secs(30), "{name}: {elapsed:?}");
    if entry.code == MALFORMED {
        assert!(output.stdout.is_empty(), "{name}");
        assert_eq!(err.lines().count(), 1, "{name}: {err}");
        assert!(err.len() < 1000, "{name}: {err}");
    }
}

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn the_second_checker_gives_every_verdict() {
    let folder = tempfile::tempdir().unwrap();
    let entries = entries();
    let mut files = Vec::new();
    for entry in &entries {
        files.push(entry.write(folder.path()));
    }

    let mut wrong = Vec::new();
    for (entry, code) in entries.iter().zip(codes(&files)) {
        if entry.code != code {
            wrong.push(format!("{}: {}, got {code}", entry.name, entry.code));
        }
    }

    assert!(wrong.is_empty(), "exit codes expected: {wrong:#?}");
}
