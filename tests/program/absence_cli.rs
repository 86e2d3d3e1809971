//! `certify` from outside on what is no solution: the refusal, the proof in a file, and `check` on
//! it.
//!
//! The solutions of the problems are known, so the right answer to each report is too. `check`
//! judges each certificate of absence, and rejects it for another problem.
#![cfg(feature = "cli")]

use crate::common::{
    contains_all, example, exit_code, exits, pencil_problem, read, run, solutions_text,
};
use crate::program::{Folder, refused};
use serde_json::json;
use std::path::Path;
use std::time::Instant;

fn report(folder: &Folder, solutions: &str) -> String {
    folder.write("report.json", &solutions_text(solutions))
}

/// What `certify` writes to stderr, when it ends with this exit code.
#[track_caller]
fn certify(code: i32, args: &[&str]) -> String {
    let run = run(&[&["certify"][..], args].concat());
    assert_eq!(run.code, Some(code), "{}", run.stderr);
    run.stderr
}

/// lambda^2 = 2 and 3 are the only solutions.
#[test]
fn a_refusal_comes_with_a_certificate_of_absence() {
    let folder = Folder::new();
    let fold = example("fold");
    let report = report(&folder, r#"[{"value":2.5,"x":[0.6,0.4]}]"#);
    let proof = folder.path("absent.json");

    let options = ["--absence-radius", "0.25", "--out", &proof];
    let said = certify(1, &[&[fold.as_str(), &report][..], &options].concat());
    assert!(
        said.contains("REFUSED: no solution with lambda2 in [2.25, 2.75] (proved)"),
        "{said}"
    );

    let checked = exits(0, &["check", &fold, &proof]);
    assert!(
        checked.starts_with("ABSENT in [9/4, 11/4]: no solution"),
        "{checked}"
    );
    assert_eq!(checked.lines().count(), 1, "{checked}");

    // The same proof does not hold for another problem.
    exits(1, &["check", &example("two-particles"), &proof]);
}

#[test]
fn several_refusals_go_to_a_folder() {
    let folder = Folder::new();
    let fold = example("fold");
    let report = report(
        &folder,
        r#"[{"value":2,"x":[2,1]},{"value":2.5,"x":[1,1]},
            {"value":3,"x":[1,1]},{"value":-1,"x":[1,1]}]"#,
    );
    let proofs = folder.path("proofs");
    let certificate = folder.path("out.json");

    let options = ["--absence", &proofs, "--out", &certificate];
    let said = certify(1, &[&[fold.as_str(), &report][..], &options].concat());
    contains_all(
        &said,
        &[
            "solution 2 (value 3): REFUSED: with lambda2 in [2.9996, 3.0004] there is only",
            "outside the problem's window",
            "1 distinct solutions certified, 3 of 4 disproved, 0 undecided",
        ],
    );

    exits(0, &["check", &fold, &certificate]);

    let nothing = run(&["check", &fold, &format!("{proofs}/absence-1.json")]);
    assert!(nothing.stdout.starts_with("ABSENT in ["), "{nothing:?}");

    let another_x = run(&["check", &fold, &format!("{proofs}/absence-2.json")]);
    assert!(
        another_x.stdout.contains("COMPLETE: 1 solution"),
        "{another_x:?}"
    );
    assert!(!Path::new(&format!("{proofs}/absence-3.json")).exists());
}

/// A pencil that is singular on {0, 1}: every value is one, a family that is no absence.
#[test]
fn what_is_neither_is_undecided() {
    let folder = Folder::new();
    let pencil = json!({ "a": [[1, -1], [-1, 1]], "b": [[0, 0], [0, 0]] });
    let problem = folder.write("singular.json", &pencil_problem("mu", pencil));
    let report = report(&folder, r#"[{"value":1,"x":[1,0]}]"#);

    let said = certify(3, &[&problem, &report]);
    contains_all(
        &said,
        &[
            "undecided: support [0]",
            "families of solutions lie with mu in [",
        ],
    );

    for radius in ["0", "-1", "x"] {
        refused(
            &["certify", &problem, &report, "--absence-radius", radius],
            &["--absence-radius"],
        );
    }
}

#[test]
fn lifted_claims_are_written_and_checked() {
    let folder = Folder::new();

    for name in ["two-particles", "oblique", "two-particles-mu"] {
        let problem = example(name);
        let listed = run(&["enumerate", &problem, "--json"]).stdout;
        let listed = folder.write("listed.json", &listed);
        let lifted = folder.path("lifted.json");

        certify(0, &[&problem, &listed, "--lifted", "--out", &lifted]);

        assert!(read(&lifted).contains("\"lifted_solution\""));
        assert_eq!(exit_code(&["check", &problem, &lifted]), Some(0));
    }
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
    let said = certify(3, &[&problem, &report]);
    let elapsed = started.elapsed();

    assert!(said.contains("regions stay open"), "{said}");
    assert!(elapsed.as_secs() < 20, "{elapsed:?}");
}

/// `mceip-critical/1`: the example of `spec/certificates.md`, 5.18, with the critical friction 1.
#[test]
fn absence_below_a_friction_is_checked() {
    let folder = Folder::new();
    let problem = example("certificates/critical.problem");
    let proof = example("certificates/critical");

    let checked = exits(0, &["check", &problem, &proof]);
    let said = "ABSENT for friction in [0, 3/4], lambda2 in [0, infinity): no solution";
    assert!(checked.starts_with(said), "{checked}");
    assert_eq!(checked.lines().count(), 1, "{checked}");

    let text = std::fs::read_to_string(&proof).unwrap();
    let higher = folder.write("higher.json", &text.replace("\"3/4\"", "\"1\""));
    let rejected = exits(1, &["check", &problem, &higher]);
    assert!(
        rejected.starts_with("REJECTED: boxes, piece 0, node 4"),
        "{rejected}"
    );

    // A window and a tolerance say nothing about such a file.
    refused(&["check", &problem, &proof, "--window", "0,1"], &["window"]);
    refused(
        &["check", &problem, &proof, "--tolerance", "1e-6"],
        &["tolerance"],
    );

    // Another problem, and a file cut short.
    exits(
        1,
        &[
            "check",
            &example("certificates/critical-free.problem"),
            &proof,
        ],
    );
    let cut = folder.write("cut.json", &text[..text.len() / 2]);
    refused(&["check", &problem, &cut], &["line"]);
}
