//! The program from outside: particles in contact with zero reaction through the chain of commands,
//! and `verify`.
//!
//! The truth is the solution of each problem and the agreement of the commands: what one writes the
//! next must take, and for another problem it must not.
#![cfg(feature = "cli")]

use crate::common::{contains_all, exits, exits_with_json, read, started};
use crate::corpus_reader::entry;
#[cfg(unix)]
use crate::interrupt::interrupt;
use crate::program::Folder;
use serde_json::{Value, json};
use std::time::Duration;

/// A problem of each mode of a particle in contact with zero reaction, of which t = 2 is the only
/// value.
const MODES: [&str; 5] = [
    "zero-open",
    "zero-stick",
    "zero-right",
    "zero-left",
    "zero-open-mu",
];

/// Reports on a problem with a particle in contact with zero reaction, by x and by v: each mode is
/// accepted and certified, what is no solution is refuted by `check` and stays without a
/// certificate.
#[test]
fn reports_with_zero_reaction_are_checked_and_certified() {
    let folder = Folder::new();
    let certificate = folder.path("certificate.json");

    for name in MODES {
        let problem = zero_reaction_problem(&folder, name);
        let mut report = exits_with_json(0, &format!("solve {problem} --json"));
        let by_x = folder.write("x.json", &report.to_string());
        remove_x(&mut report);
        let by_v = folder.write("v.json", &report.to_string());

        for report in [&by_x, &by_v] {
            let verdict = exits(0, &format!("check {problem} {report}"));
            contains_all(&verdict, &["ACCEPTED", "= 2 exists"]);

            exits(
                0,
                &format!("certify {problem} {report} --out {certificate}"),
            );
            exits(0, &format!("check {problem} {certificate}"));
            exits(
                0,
                &format!("certify {problem} {report} --lifted --out {certificate}"),
            );
            contains_all(&read(&certificate), &["lifted_solution"]);
            exits(0, &format!("check {problem} {certificate}"));
        }
    }
}

/// Leaves v of each solution of a report.
fn remove_x(report: &mut Value) {
    for solution in report["solutions"].as_array_mut().unwrap() {
        solution.as_object_mut().unwrap().remove("x");
    }
}

/// Each mode of a particle in contact with zero reaction: `solve`, `complete` and `enumerate` find
/// the solution, `check` accepts their certificates, and not for the problem of another mode.
#[test]
fn zero_reaction_is_solved_and_checked() {
    let folder = Folder::new();
    let foreign = zero_reaction_problem(&folder, "zero-factor");
    let certificate = folder.path("certificate.json");

    for name in MODES {
        let problem = zero_reaction_problem(&folder, name);
        let written = format!("{problem} --json --certificate {certificate}");

        let report = exits_with_json(0, &format!("solve {written}"));

        assert_eq!(report["solutions"].as_array().unwrap().len(), 1, "{name}");
        assert_eq!(report["solutions"][0]["value"], "2", "{name}");
        exits(0, &format!("check {problem} {certificate}"));
        exits(1, &format!("check {foreign} {certificate}"));

        let all = exits_with_json(0, &format!("complete {written}"));
        assert_eq!(all["solutions"].as_array().unwrap().len(), 1, "{name}");
        assert_eq!(all["solutions"][0]["slip"], report["solutions"][0]["slip"]);
        exits(0, &format!("check {problem} {certificate}"));
        exits(1, &format!("check {foreign} {certificate}"));

        let listed = exits_with_json(0, &format!("enumerate {problem} --json"));
        assert_eq!(listed["claim"], "complete", "{name}");
        assert_eq!(
            listed["evidence"],
            "complete, by the plain enumeration of 4 choices of modes: every one by exact arithmetic"
        );
        assert_eq!(listed["solutions"].as_array().unwrap().len(), 1, "{name}");
        for key in ["value", "slip", "x", "v"] {
            let [by_modes, by_solver] = [&listed, &report].map(|r| &r["solutions"][0][key]);
            assert_eq!(by_modes, by_solver, "{name}: {key}");
        }

        contains_all(
            &exits(0, &format!("solve {problem}")),
            &["right of particle 1"],
        );
    }
}

/// The critical friction of a particle that slides with friction is 6/7 (`spec/corpus/README.md`):
/// `analyze` bounds it from both sides, names what is not defined, and its certificates are
/// accepted.
#[test]
fn zero_reaction_is_analysed() {
    let folder = Folder::new();
    let problem = zero_reaction_problem(&folder, "critical-zero");
    let [proofs, report] = ["proofs", "report.html"].map(|name| folder.path(name));

    let command = format!("analyze {problem} --friction 1");
    let text = exits(
        0,
        &format!("{command} --certificates {proofs} --report {report}"),
    );
    contains_all(
        &text,
        &[
            "1 with zero reaction",
            "PRESENT",
            "no such motion below mu = 0.857142",
            "there is one at some mu up to 0.857142858",
            "particle 1 with zero reaction slides along its tangent",
            "(17)-(18): not defined",
            "Flutter: not examined",
        ],
    );

    let files = format!("{proofs}/absence.problem.json {proofs}/absence.certificate.json");
    let verdict = exits(0, &format!("check {files}"));
    contains_all(&verdict, &["ABSENT for friction"]);

    contains_all(&read(&report), &["particles with zero reaction", "1 right"]);

    let answer = exits_with_json(0, &format!("{command} --json"));
    assert_eq!(answer["sizes"]["zero_particles"], 1);
    let zero = &answer["divergence"]["modes"][0]["zero"][0];
    assert_eq!(*zero, json!({"particle": 1, "mode": "right"}));
    assert!(answer["sufficient"].is_null() && answer["flutter"].is_null());
}

/// The problem of a file of `spec/corpus/accept`, as a file of its own.
fn zero_reaction_problem(folder: &Folder, name: &str) -> String {
    let problem = entry(&format!("accept/{name}")).problem;
    folder.write(&format!("{name}.json"), &problem)
}

/// What it finds is `tests/campaign/verify.rs`.
#[test]
#[ignore = "a minute"]
fn verify_ends_with_a_verdict() {
    let report = exits_with_json(0, "verify --random 4 --json");
    let verdict = report["verdict"].as_str().unwrap();
    assert_eq!(report["disagreements"], 0);
    assert!(verdict.starts_with("VERIFIED"), "{verdict}");
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_found() {
    let child = started("verify");
    interrupt(&child, Duration::from_secs(3));

    let output = child.wait_with_output().unwrap();

    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(text.contains("INTERRUPTED: no disagreement"), "{text}");
}
