//! `mceip complete --infinity`: limits for large values, apart from the list and with a certificate
//! of their own.
//!
//! The problems are small enough to be solved by hand, and `mceip check` judges each certificate. A
//! limit that is taken for a solution, or a certificate that holds for the other problem, fails.
#![cfg(feature = "cli")]

use crate::common::{contains_all, example, exits, exits_with_json, pencil_problem};
use crate::program::{Folder, refused};
use serde_json::json;

/// (I + t [[1, -1], [-1, 1]]) x = y: nothing for any t, x = (1, 1) in the limit.
fn limit(folder: &Folder) -> String {
    let pencil = json!({ "a": [["1", "0"], ["0", "1"]], "b": [["1", "-1"], ["-1", "1"]] });
    folder.write("problem.json", &pencil_problem("mu", pencil))
}

#[test]
fn what_is_at_infinity_is_said_apart_and_proved_for_the_reversed_problem() {
    let folder = Folder::new();
    let problem = limit(&folder);
    let certificate = folder.path("out.json");
    let infinity_certificate = format!("{certificate}.infinity.json");
    let reversed_problem = format!("{certificate}.infinity-problem.json");

    let args = ["complete", &problem, "--infinity"];
    let text = exits(0, &[&args[..], &["--certificate", &certificate]].concat());
    contains_all(
        &text,
        &[
            "COMPLETE: no solution in [0, infinity)",
            "at infinity: slip [0, 1]",
            "COMPLETE: 1 at infinity",
        ],
    );

    // Each certificate is for its own problem.
    let checked = exits(0, &["check", &problem, &certificate]);
    assert!(checked.contains("ABSENT in [0, infinity)"), "{checked}");

    let checked = exits(0, &["check", &reversed_problem, &infinity_certificate]);
    assert!(checked.contains("ACCEPTED"), "{checked}");
    exits(1, &["check", &problem, &infinity_certificate]);
    exits(1, &["check", &reversed_problem, &certificate]);

    let report = exits_with_json(0, &[&args[..], &["--json"]].concat());
    let at_infinity = &report["at_infinity"];
    assert_eq!(report["solutions"], json!([]));
    assert_eq!(at_infinity["claim"], "complete");
    assert_eq!(at_infinity["solutions"][0]["slip"], json!([0, 1]));

    // Without the option nothing is said of it, and a window from some value on is closed as well.
    let without = exits(0, &["complete", &problem]);
    assert!(!without.contains("at infinity"), "{without}");

    let windowed = exits(0, &[&args[..], &["--window", "5,"]].concat());
    assert!(windowed.contains("at infinity: slip [0, 1]"), "{windowed}");
}

#[test]
fn nothing_at_infinity_and_windows_that_end() {
    let folder = Folder::new();
    let text = exits(0, &["complete", &example("two-particles-mu"), "--infinity"]);
    assert!(text.contains("at infinity"), "{text}");

    let pencil = json!({ "a": [["1", "-6"], ["2", "-6"]], "b": [["1", "0"], ["0", "1"]] });
    let fold = folder.write("fold.json", &pencil_problem("lambda2", pencil));
    let text = exits(0, &["complete", &fold, "--infinity"]);
    contains_all(
        &text,
        &["COMPLETE: 2 solutions", "COMPLETE: nothing at infinity"],
    );

    refused(
        &["complete", &fold, "--infinity", "--window", "0,9"],
        &["--infinity", "upper end"],
    );

    // A cone of limits: B = 0 leaves A for the limit, here a singular one.
    let pencil = json!({ "a": [["1", "-1"], ["-1", "1"]], "b": [["0", "0"], ["0", "0"]] });
    let zero = folder.write("zero.json", &pencil_problem("mu", pencil));
    let text = exits(0, &["complete", &zero, "--infinity"]);

    assert!(text.contains("at infinity: slip [0, 1]"), "{text}");
}
