//! `mceip check PROBLEM REPORT`: somebody's solutions accepted, refuted or left undecided, in one line each.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "support/program.rs"]
mod program;

use program::{Folder, mceip, refused};
use std::path::Path;

fn example(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("spec/examples/{name}.json")).display().to_string()
}

/// Exit code and stdout of `check` on a report with these solutions.
fn check(problem: &str, solutions: &str) -> (i32, String) {
    let folder = Folder::new();
    let report = folder.write("r.json", &format!(r#"{{"format":"mceip-solutions/1","solutions":{solutions}}}"#));
    let out = mceip(&["check", problem, &report]);
    (out.status.code().unwrap(), String::from_utf8(out.stdout).unwrap())
}

#[test]
fn one_line_for_each_solution() {
    let fold = example("fold");
    let good = r#"{"value":2.00000,"x":[0.666667,0.333333]}"#;
    assert_eq!(check(&fold, &format!("[{good}]")), (0, "ACCEPTED: lambda2 = 2 exists with support {0, 1}; proved\n".into()));
    let (code, text) = check(&fold, r#"[{"value":2.5,"x":[0.666667,0.333333]}]"#);
    assert!(code == 1 && text.starts_with("REJECTED: lambda2 = 2.5: no solution") && text.contains("there is none at all"), "{text}");
    let (code, text) = check(&fold, r#"[{"value":2,"x":[0.333333,0.666667]}]"#);
    assert!(code == 1 && text.contains("1 found with another x"), "{text}");
    assert_eq!(check(&fold, r#"[{"value":-1,"x":[1,1]}]"#).0, 1);
    let (code, text) = check(&fold, r#"[{"value":2,"x":[0,0]}]"#);
    assert!(code == 1 && text.contains("x != 0"), "{text}");
    let (code, text) = check(&fold, &format!(r#"[{good},{{"value":7,"x":[1,1]}}]"#));
    assert!(code == 1 && text.lines().count() == 2 && text.starts_with("ACCEPTED") && text.contains("\nREJECTED"), "{text}");
    let (code, text) = check(&fold, "[]");
    assert!(code == 3 && text.starts_with("UNDECIDED"), "{text}");
}

/// v over the dofs of a system, with and without a rate into the obstacle; x of the wrong length.
#[test]
fn a_mode_in_physical_dofs() {
    let system = example("two-particles");
    let listed = mceip(&["enumerate", &system, "--json"]);
    let listed: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
    for s in listed["solutions"].as_array().unwrap() {
        let bare = serde_json::json!([{ "value": s["value"], "v": s["v"] }]);
        let (code, text) = check(&system, &bare.to_string());
        assert!(code == 0 && text.starts_with("ACCEPTED: lambda2 = "), "{text}");
        let mut lifted = s["v"].as_array().unwrap().clone();
        lifted[1] = serde_json::json!("0.5");
        let (code, text) = check(&system, &serde_json::json!([{ "value": s["value"], "v": lifted }]).to_string());
        assert!(code == 1 && text.starts_with("REJECTED: E9: v[1]"), "{text}");
        let turned: Vec<String> = s["v"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().replace('-', "+")).collect();
        let (code, text) = check(&system, &serde_json::json!([{ "value": s["value"], "v": turned }]).to_string());
        let unchanged = s["v"].as_array().unwrap().iter().all(|v| !v.as_str().unwrap().starts_with('-'));
        assert!(unchanged || code == 1, "{text}");
    }
    let folder = Folder::new();
    for (solutions, words) in [
        (r#"[{"value":1,"v":[1,0]}]"#, vec!["solutions[0]", "v with 4", "got 2"]),
        (r#"[{"value":1,"x":[1]}]"#, vec!["solutions[0]", "x with 2", "got 1"]),
        (r#"[{"value":1}]"#, vec!["x or v"]),
        (r#"[{"value":1e999,"x":[1,1]}]"#, vec!["solutions[0].value"]),
    ] {
        let report = folder.write("r.json", &format!(r#"{{"format":"mceip-solutions/1","solutions":{solutions}}}"#));
        refused(&["check", &system, &report], &words);
    }
    let fold = folder.write("f.json", r#"{"format":"mceip-solutions/1","solutions":[{"value":1,"v":[1,1]}]}"#);
    refused(&["check", &example("fold"), &fold], &["expected x"]);
    let other = folder.write("o.json", r#"{"format":"mceip-solutions/1","problem_sha256":"00","solutions":[]}"#);
    let out = mceip(&["check", &system, &other]);
    assert!(out.status.code() == Some(1) && String::from_utf8(out.stdout).unwrap().starts_with("REJECTED: the report names another"));
}

/// At relative distances 1e-6 to 1e-12 of a threshold: below it the residual of t = 0 is as small, and
/// nothing exists; on it and above it the same report is right.
#[test]
fn near_a_threshold() {
    let folder = Folder::new();
    for power in 6..=12 {
        for (sign, expected) in [("", 1), ("-", 0)] {
            // (d + t) x = y: for d > 0 nothing, for d <= 0 the solution t = -d.
            let text = format!(
                r#"{{"format":"mceip-problem/1","unknown":"lambda2","pencil":{{"a":[["{sign}1e-{power}","0"],["1","3"]],"b":[["1","0"],["0","1"]]}}}}"#
            );
            let problem = folder.write("p.json", &text);
            let (code, text) = check(&problem, r#"[{"value":0,"x":[1,0]}]"#);
            assert_eq!(code, expected, "{sign}1e-{power}: {text}");
        }
    }
}

/// A problem or a report on stdin.
#[test]
fn stdin_is_a_file() {
    use std::io::Write as _;
    use std::process::{Command, Stdio};
    let run = |args: &[&str], input: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"))
            .args(args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // What is refused before it is read closes the pipe.
        _ = child.stdin.take().unwrap().write_all(input.as_bytes());
        child.wait_with_output().unwrap()
    };
    let problem = std::fs::read_to_string(example("fold")).unwrap();
    assert_eq!(run(&["enumerate", "-"], &problem).stdout, mceip(&["enumerate", &example("fold")]).stdout);
    assert_eq!(run(&["solve", "-", "--starts", "4"], &problem).status.code(), Some(0));
    let report = r#"{"format":"mceip-solutions/1","solutions":[{"value":3,"x":[3,1.5]}]}"#;
    assert_eq!(run(&["check", &example("fold"), "-"], report).status.code(), Some(1));
    let bad = run(&["enumerate", "-"], "{");
    assert!(bad.status.code() == Some(2) && String::from_utf8(bad.stderr).unwrap().starts_with("mceip: -: line 1"));
    assert_eq!(run(&["check", "-", "-"], report).status.code(), Some(2));
}
