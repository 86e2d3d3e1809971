//! The rivals of `spec/rivals.md` through `mceip conform`: the semismooth Newton on some flags in
//! every run, everything with Siconos opt-in (`cargo test --test program -- --ignored rivals::`).
//!
//! The truth is the tables of the page, which were measured. A rival that gets fewer cases right
//! than the page says, but for one case that another version of numpy may move, fails; so does one
//! that crashes or prints no report.
#![cfg(feature = "cli")]

use crate::common::{read, repository};
use crate::program::mceip;
use serde_json::Value;

const SEMISMOOTH_NEWTON: [&str; 2] = ["python3", "spec/rivals/semismooth_newton.py"];

/// Cases by which a run may differ from the page.
const MOVED: u64 = 1;

/// The numbers of the row of the page that begins with this word.
#[track_caller]
fn row(word: &str) -> Vec<u64> {
    let page = read(&repository("spec/rivals.md"));
    let start = format!("| {word} | ");
    let line = page.lines().find(|line| line.starts_with(&start)).unwrap();

    let cells = line[start.len()..].trim_end_matches('|').split('|');
    cells.map(|cell| cell.trim().parse().unwrap()).collect()
}

/// The report on a rival over the cases with these flags, or over all; without eigenvalue problems,
/// which the rivals do not know.
fn report_on(rival: &[&str], flags: &[&str]) -> Value {
    let script = repository(rival[1]);
    let mut args = vec!["conform", "--as-pencil", "--lines", "--json"];
    args.extend(["--time-limit", "60", "--except", "eigenvalue"]);
    for flag in flags {
        args.extend(["--only", flag]);
    }
    args.extend(["--", rival[0], &script]);
    args.extend(&rival[2..]);

    let output = mceip(&args);
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The report has what the page says in this column of its tables.
#[track_caller]
fn has_the_numbers_of_the_page(report: &Value, flags: &[&str], column: usize) {
    for label in ["crashed", "timed out", "malformed"] {
        assert!(report["labels"][label].is_null(), "{report:#}");
    }

    for flag in flags {
        let expected = row(&format!("`{flag}`"))[column + 1];
        let correct = report["flags"][flag]["correct"].as_u64().unwrap_or(0);
        assert!(correct + MOVED >= expected, "{flag}: {report:#}");
    }
}

#[test]
#[cfg_attr(not(has_numpy), ignore = "needs python3 with numpy")]
fn semismooth_newton_gets_the_verdicts_of_the_page() {
    let flags = ["fold", "near_threshold", "window_end", "continuum", "cone"];

    let report = report_on(&SEMISMOOTH_NEWTON, &flags);

    has_the_numbers_of_the_page(&report, &flags, 0);
    let failures = report["failures"].as_array().unwrap();
    let is_past_the_fold = |failure: &&Value| failure["case"] == "fold-02";
    let past_the_fold = failures.iter().find(is_past_the_fold).unwrap();
    assert_eq!(past_the_fold["label"], "wrong", "{report:#}");
}

#[test]
#[ignore = "needs Siconos (Debian: python3-siconos) and ten minutes"]
fn all_rivals_get_the_verdicts_of_the_page() {
    let siconos = ["/usr/bin/python3", "spec/rivals/siconos_adapter.py"];
    let by_minimum = [&siconos[..], &["min"]].concat();
    let rivals: [&[&str]; 3] = [&SEMISMOOTH_NEWTON, &siconos, &by_minimum];

    for (column, rival) in rivals.into_iter().enumerate() {
        let report = report_on(rival, &[]);

        assert_eq!(report["cases"], 281, "{rival:?}");
        has_the_numbers_of_the_page(&report, &["fold", "scaled", "random"], column);
        let correct = report["labels"]["correct"].as_u64().unwrap();
        assert!(correct + 3 * MOVED >= row("correct")[column], "{report:#}");
    }
}
