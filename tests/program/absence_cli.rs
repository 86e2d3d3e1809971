//! `certify` on a report that has to be given up at once. What it prints of absence stands in
//! `tests/transcripts/certify.md`.
#![cfg(feature = "cli")]

use crate::common::{run, solutions_text};
use crate::program::Folder;
use std::time::Instant;

fn report(folder: &Folder, solutions: &str) -> String {
    folder.write("report.json", &solutions_text(solutions))
}

/// What `certify` writes to stderr, when it ends with this exit code.
#[track_caller]
fn certify(code: i32, args: &str) -> String {
    let run = run(&format!("certify {args}"));
    assert_eq!(run.code, Some(code), "{}", run.stderr);
    run.stderr
}

/// Entries from 1e-400 to 1e400: an exact decision of a support takes minors of thousands of bits
/// and as many halvings. `certify` did not end on this file; such supports stay open.
#[test]
fn numbers_of_every_magnitude_stay_undecided_at_once() {
    let folder = Folder::new();
    let problem = folder.write(
        "problem.json",
        r#"{"format": "mceip-problem/1", "unknown": "mu", "pencil": {
            "a": [["3", "1e308", "1", "-3"], ["2", "3", "-1e-400", ".5"],
                  ["-1", "-3", "0", "0"], ["7", ".5", "-1", "9"]],
            "b": [["1", "-1e400", "1e300", "0"],
                  ["-3", "1.7976931348623159e308", "1", "1e300"],
                  ["-1", "3", "3", "2.2250738585072014e-308"], ["0", "1e-400", "0", "0"]],
            "free": [3]}}"#,
    );
    let report = report(&folder, r#"[{"value": 0, "x": [1, 1, 2, 0]}]"#);

    let started = Instant::now();
    let said = certify(3, &format!("{problem} {report}"));
    let elapsed = started.elapsed();

    assert!(said.contains("1 open region and 0 families"), "{said}");
    assert!(elapsed.as_secs() < 20, "{elapsed:?}");
}
