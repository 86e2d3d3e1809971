//! `mceip solve` on plain LCP and MCP files, trace and replay, through the program.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

fn mceip(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .output()
        .unwrap()
}

fn stdout(o: &Output) -> String {
    String::from_utf8_lossy(&o.stdout).into_owned()
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn an_lcp_is_solved_certified_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "lcp.json",
        r#"{"format":"mceip-mcp/1","m":[["0.2","0.1"],["1/10","2/10"]],"q":["-0.5","-0.6"]}"#,
    );
    let certificate = folder.path().join("c.json").display().to_string();
    let out = mceip(&["solve", &file, "--certificate", &certificate]);
    assert_eq!(out.status.code(), Some(0));
    assert!(
        stdout(&out).contains("z[0] = 4/3") && stdout(&out).contains("completeness unknown"),
        "{}",
        stdout(&out)
    );
    let accepted = mceip(&["solve", &file, "--check", &certificate]);
    assert!(accepted.status.code() == Some(0) && stdout(&accepted).starts_with("ACCEPTED: 1"));
    // A forged digit, and a certificate of another problem.
    let forged = write(
        folder.path(),
        "f.json",
        &std::fs::read_to_string(&certificate)
            .unwrap()
            .replace("4/3", "4/5"),
    );
    let rejected = mceip(&["solve", &file, "--check", &forged]);
    assert!(
        rejected.status.code() == Some(1)
            && stdout(&rejected).starts_with("REJECTED: solution 0: F[0]"),
        "{}",
        stdout(&rejected)
    );
    let other = write(
        folder.path(),
        "o.json",
        r#"{"format":"mceip-mcp/1","m":[[2,1],[1,3]],"q":[-5,-6]}"#,
    );
    for verb in [
        &["check", other.as_str(), certificate.as_str()][..],
        &["solve", &other, "--check", &certificate],
    ] {
        let foreign = mceip(verb);
        assert!(
            foreign.status.code() == Some(1)
                && stdout(&foreign).starts_with("REJECTED: digest: expected"),
            "{}",
            stdout(&foreign)
        );
    }
}

/// `mceip check` by the format of the problem: plain and eigenproblem, each with its own
/// certificates only.
#[test]
fn check_dispatches_on_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let plain = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/spec/examples/bounded-mcp.json"
    );
    let pencil = concat!(env!("CARGO_MANIFEST_DIR"), "/spec/examples/fold.json");
    let (of_plain, of_pencil) = (
        folder.path().join("p.json").display().to_string(),
        folder.path().join("q.json").display().to_string(),
    );
    assert_eq!(
        mceip(&["solve", plain, "--all", "--certificate", &of_plain])
            .status
            .code(),
        Some(0)
    );
    assert_eq!(
        mceip(&["solve", pencil, "--certificate", &of_pencil])
            .status
            .code(),
        Some(0)
    );
    let accepted = mceip(&["check", plain, &of_plain]);
    assert!(
        accepted.status.code() == Some(0)
            && stdout(&accepted).starts_with("ACCEPTED: 3 solution(s)"),
        "{}",
        stdout(&accepted)
    );
    assert_eq!(mceip(&["check", pencil, &of_pencil]).status.code(), Some(0));
    let text = std::fs::read_to_string(&of_plain).unwrap();
    let none = write(
        folder.path(),
        "none.json",
        &format!("{}\"z\": []}}", text.split_once("\"z\"").unwrap().0),
    );
    let rejected = mceip(&["check", plain, &none]);
    assert!(
        rejected.status.code() == Some(1)
            && stdout(&rejected).starts_with("REJECTED: z: expected at least one"),
        "{}",
        stdout(&rejected)
    );
    for (problem, certificate, word) in [
        (plain, &of_pencil, "mceip-mcp-solution/1"),
        (pencil, &of_plain, "mceip-certificate/1"),
    ] {
        let refused = mceip(&["check", problem, certificate]);
        let err = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(
            refused.status.code() == Some(2) && err.lines().count() == 1 && err.contains(word),
            "{err}"
        );
    }
}

/// The trace of a plain problem: its own replay, and what each change does to it.
#[test]
fn a_plain_trace_replays_and_a_changed_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let problem = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/spec/examples/bounded-mcp.json"
    );
    let trace = folder.path().join("t.txt").display().to_string();
    assert_eq!(
        mceip(&[
            "solve", problem, "--all", "--starts", "6", "--seed", "3", "--trace", &trace
        ])
        .status
        .code(),
        Some(0)
    );
    let text = std::fs::read_to_string(&trace).unwrap();
    assert!(
        text.contains("run from")
            && text.contains("curve from")
            && text.contains("certified: 5/6 1/2 1 2"),
        "{text}"
    );
    let same = mceip(&["solve", "--replay", &trace]);
    assert!(
        same.status.code() == Some(0) && stdout(&same).starts_with("IDENTICAL"),
        "{}",
        stdout(&same)
    );
    for (k, (from, to)) in [
        ("certified: 5/6", "certified: 6/6"),
        ("\"seed\":3", "\"seed\":4"),
        ("1/3", "1/2"),
    ]
    .into_iter()
    .enumerate()
    {
        assert!(text.contains(from), "{from}");
        let changed = write(
            folder.path(),
            &format!("{k}.txt"),
            &text.replacen(from, to, 1),
        );
        let different = mceip(&["solve", "--replay", &changed]);
        assert!(
            different.status.code() == Some(1) && stdout(&different).starts_with("DIFFERENT"),
            "{from}: {}",
            stdout(&different)
        );
    }
    for (k, (from, to)) in [
        ("\"starts\":6", "\"starts\":0"),
        ("mceip-mcp/1", "mceip-mcp/2"),
        ("mceip-trace/1", "mceip-trace/2"),
    ]
    .into_iter()
    .enumerate()
    {
        let bad = write(
            folder.path(),
            &format!("b{k}.txt"),
            &text.replacen(from, to, 1),
        );
        let refused = mceip(&["solve", "--replay", &bad]);
        assert_eq!(
            (
                refused.status.code(),
                String::from_utf8_lossy(&refused.stderr).lines().count()
            ),
            (Some(2), 1),
            "{from}"
        );
    }
}

#[test]
fn bounds_of_every_kind_and_all_solutions() {
    let folder = tempfile::tempdir().unwrap();
    // z0 fixed at 1, z1 free, z2 in [0, 2] with F2 = 1 - z2 (solutions 0, 1 and 2).
    let text = r#"{"format":"mceip-mcp/1","m":[[0,0,0],[1,2,0],[0,0,-1]],"q":[-9,"-4",1],"lower":[1,null,0],"upper":[1,null,2]}"#;
    let file = write(folder.path(), "mcp.json", text);
    let out = mceip(&["solve", &file, "--all", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&stdout(&out)).unwrap();
    let mut last: Vec<String> = value["solutions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["z"][2].as_str().unwrap().to_string())
        .collect();
    last.sort();
    assert_eq!(last, ["0", "1", "2"]);
    assert!(
        value["solutions"]
            .as_array()
            .unwrap()
            .iter()
            .all(|s| s["z"][0] == "1" && s["z"][1] == "3/2")
    );
}

#[test]
fn no_solution_is_undecided_and_bad_files_are_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "none.json",
        r#"{"format":"mceip-mcp/1","m":[[-1]],"q":[-1]}"#,
    );
    let out = mceip(&["solve", &file]);
    assert!(
        out.status.code() == Some(3) && stdout(&out).contains("0 certified"),
        "{}",
        stdout(&out)
    );
    // An option of the other kind of problem is refused, not ignored.
    let windowed = mceip(&["solve", &file, "--window", "0,1"]);
    let err = String::from_utf8_lossy(&windowed.stderr).into_owned();
    assert!(
        windowed.status.code() == Some(2) && err.lines().count() == 1 && err.contains("--window"),
        "{err}"
    );
    for text in [
        r#"{"format":"mceip-mcp/1","m":[[1,2]],"q":[-1]}"#,
        r#"{"format":"mceip-mcp/1","m":[[1]],"q":["1e999999"]}"#,
        "{}",
    ] {
        let bad = mceip(&["solve", &write(folder.path(), "bad.json", text)]);
        assert_eq!(
            (
                bad.status.code(),
                String::from_utf8_lossy(&bad.stderr).lines().count()
            ),
            (Some(2), 1),
            "{text}"
        );
    }
}

#[test]
fn a_trace_replays_and_a_changed_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let problem = concat!(env!("CARGO_MANIFEST_DIR"), "/spec/examples/fold.json");
    let trace = folder.path().join("t.txt").display().to_string();
    assert_eq!(
        mceip(&[
            "solve", problem, "--all", "--starts", "4", "--seed", "7", "--trace", &trace
        ])
        .status
        .code(),
        Some(0)
    );
    let text = std::fs::read_to_string(&trace).unwrap();
    assert!(text.contains("leaves") && text.contains("curve") && text.contains("certified in run"));
    let same = mceip(&["solve", "--replay", &trace]);
    assert!(
        same.status.code() == Some(0) && stdout(&same).starts_with("IDENTICAL"),
        "{}",
        stdout(&same)
    );
    let changed = write(
        folder.path(),
        "u.txt",
        &text.replacen("Exchange", "Flip", 1),
    );
    let different = mceip(&["solve", "--replay", &changed]);
    assert!(
        different.status.code() == Some(1) && stdout(&different).starts_with("DIFFERENT"),
        "{}",
        stdout(&different)
    );
    let seed = write(
        folder.path(),
        "s.txt",
        &text.replacen("\"seed\":7", "\"seed\":8", 1),
    );
    assert_eq!(mceip(&["solve", "--replay", &seed]).status.code(), Some(1));
    assert_eq!(
        mceip(&["solve", "--replay", problem]).status.code(),
        Some(2)
    );
}

/// Written before the crash could be chosen: its options do not name it, and it was projected
/// Newton.
#[test]
fn a_trace_from_before_the_choice_of_a_crash_replays() {
    let folder = tempfile::tempdir().unwrap();
    let old = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/traces/before-crash-method.trace"
    );
    let same = mceip(&["solve", "--replay", old]);
    assert!(
        same.status.code() == Some(0) && stdout(&same).starts_with("IDENTICAL"),
        "{}",
        stdout(&same)
    );
    let text = std::fs::read_to_string(old).unwrap();
    assert!(!text.contains("crash_method") && text.contains("Crash"));
    let other = text.replacen(
        "crash_iteration_limit: 50",
        "crash_method: FischerNewton, crash_iteration_limit: 50",
        1,
    );
    let different = mceip(&[
        "solve",
        "--replay",
        &write(folder.path(), "other.txt", &other),
    ]);
    assert!(
        different.status.code() == Some(1) && stdout(&different).contains("line 1"),
        "{}",
        stdout(&different)
    );
}
