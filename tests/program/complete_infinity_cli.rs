//! `mceip complete --infinity`: limits for large values, apart from the list and with a certificate
//! of their own.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use serde_json::{Value, json};

/// (I + t [[1, -1], [-1, 1]]) x = y: nothing for any t, x = (1, 1) in the limit.
fn limit(folder: &Folder) -> String {
    let pencil = json!({ "a": [["1", "0"], ["0", "1"]], "b": [["1", "-1"], ["-1", "1"]] });
    folder.write(
        "problem.json",
        &json!({ "format": "mceip-problem/1", "unknown": "mu", "pencil": pencil }).to_string(),
    )
}

#[track_caller]
fn said(code: i32, args: &[&str]) -> String {
    let o = mceip(args);
    assert_eq!(
        o.status.code(),
        Some(code),
        "{args:?}: {}",
        String::from_utf8_lossy(&o.stderr)
    );
    String::from_utf8(o.stdout).unwrap()
}

#[test]
fn what_is_at_infinity_is_said_apart_and_proved_for_the_reversed_problem() {
    let folder = Folder::new();
    let (file, out) = (limit(&folder), folder.path("out.json"));
    let text = said(0, &["complete", &file, "--infinity", "--certificate", &out]);
    assert!(
        text.contains("COMPLETE: no solution in [0, infinity)"),
        "{text}"
    );
    assert!(
        text.contains("at infinity: slip [0, 1]") && text.contains("COMPLETE: 1 at infinity"),
        "{text}"
    );
    let (certificate, reversed) = (
        format!("{out}.infinity.json"),
        format!("{out}.infinity-problem.json"),
    );
    assert!(said(0, &["check", &file, &out]).contains("ABSENT in [0, infinity)"));
    assert!(said(0, &["check", &reversed, &certificate]).contains("ACCEPTED"));
    // Each certificate is for its own problem.
    assert_eq!(
        mceip(&["check", &file, &certificate]).status.code(),
        Some(1)
    );
    assert_eq!(mceip(&["check", &reversed, &out]).status.code(), Some(1));
    let report: Value =
        serde_json::from_str(&said(0, &["complete", &file, "--infinity", "--json"])).unwrap();
    assert_eq!(report["solutions"], json!([]));
    assert_eq!(
        (
            &report["at_infinity"]["claim"],
            &report["at_infinity"]["solutions"][0]["slip"]
        ),
        (&json!("complete"), &json!([0, 1]))
    );
    // Without the option nothing is said of it, and a window from some value on is closed as well.
    assert!(!said(0, &["complete", &file]).contains("at infinity"));
    assert!(
        said(0, &["complete", &file, "--window", "5,", "--infinity"])
            .contains("at infinity: slip [0, 1]")
    );
}

#[test]
fn nothing_at_infinity_and_windows_that_end() {
    let folder = Folder::new();
    let example = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/spec/examples/two-particles-mu.json"
    );
    assert!(said(0, &["complete", example, "--infinity"]).contains("at infinity"));
    let pencil = json!({ "a": [["1", "-6"], ["2", "-6"]], "b": [["1", "0"], ["0", "1"]] });
    let fold = folder.write(
        "fold.json",
        &json!({ "format": "mceip-problem/1", "unknown": "lambda2", "pencil": pencil }).to_string(),
    );
    let text = said(0, &["complete", &fold, "--infinity"]);
    assert!(
        text.contains("COMPLETE: 2 solutions") && text.contains("COMPLETE: nothing at infinity"),
        "{text}"
    );
    refused(
        &["complete", &fold, "--infinity", "--window", "0,9"],
        &["--infinity", "upper end"],
    );
    // A cone of limits: B = 0 leaves A for the limit, here a singular one.
    let zero = json!({ "a": [["1", "-1"], ["-1", "1"]], "b": [["0", "0"], ["0", "0"]] });
    let zero = folder.write(
        "zero.json",
        &json!({ "format": "mceip-problem/1", "unknown": "mu", "pencil": zero }).to_string(),
    );
    assert!(said(0, &["complete", &zero, "--infinity"]).contains("at infinity: slip [0, 1]"));
}
