//! `mceip solve` on plain LCP and MCP files, trace and replay, through the program.
#![cfg(feature = "cli")]
#![allow(missing_docs, clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::{Command, Output};

fn mceip(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip")).args(args).output().unwrap()
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
    let file = write(folder.path(), "lcp.json", r#"{"format":"mceip-mcp/1","m":[["0.2","0.1"],["1/10","2/10"]],"q":["-0.5","-0.6"]}"#);
    let certificate = folder.path().join("c.json").display().to_string();
    let out = mceip(&["solve", &file, "--certificate", &certificate]);
    assert_eq!(out.status.code(), Some(0));
    assert!(stdout(&out).contains("z[0] = 4/3") && stdout(&out).contains("completeness unknown"), "{}", stdout(&out));
    let accepted = mceip(&["solve", &file, "--check", &certificate]);
    assert!(accepted.status.code() == Some(0) && stdout(&accepted).starts_with("ACCEPTED: 1"));
    // A forged digit, and a certificate of another problem.
    let forged = write(folder.path(), "f.json", &std::fs::read_to_string(&certificate).unwrap().replace("4/3", "4/5"));
    let rejected = mceip(&["solve", &file, "--check", &forged]);
    assert!(rejected.status.code() == Some(1) && stdout(&rejected).starts_with("REJECTED: solution 0: F[0]"), "{}", stdout(&rejected));
    let other = write(folder.path(), "o.json", r#"{"format":"mceip-mcp/1","m":[[2,1],[1,3]],"q":[-5,-6]}"#);
    let foreign = mceip(&["solve", &other, "--check", &certificate]);
    assert_eq!((foreign.status.code(), String::from_utf8_lossy(&foreign.stderr).lines().count()), (Some(2), 1));
}

#[test]
fn bounds_of_every_kind_and_all_solutions() {
    let folder = tempfile::tempdir().unwrap();
    // z0 fixed at 1, z1 free, z2 in [0, 2] with F2 = 1 - z2 (solutions 0, 1 and 2).
    let text = r#"{"format":"mceip-mcp/1","m":[[0,0,0],[1,2,0],[0,0,-1]],"q":[-9,"-4",1],"lower":[1,null,0],"upper":[1,null,2]}"#;
    let file = write(folder.path(), "mcp.json", text);
    let out = mceip(&["solve", &file, "--all", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&stdout(&out)).unwrap();
    let mut last: Vec<String> = value["solutions"].as_array().unwrap().iter().map(|s| s["z"][2].as_str().unwrap().to_string()).collect();
    last.sort();
    assert_eq!(last, ["0", "1", "2"]);
    assert!(value["solutions"].as_array().unwrap().iter().all(|s| s["z"][0] == "1" && s["z"][1] == "3/2"));
}

#[test]
fn no_solution_is_undecided_and_bad_files_are_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "none.json", r#"{"format":"mceip-mcp/1","m":[[-1]],"q":[-1]}"#);
    let out = mceip(&["solve", &file]);
    assert!(out.status.code() == Some(3) && stdout(&out).contains("0 certified"), "{}", stdout(&out));
    // An option of the other kind of problem is refused, not ignored.
    let traced = mceip(&["solve", &file, "--trace", "trace.txt"]);
    let err = String::from_utf8_lossy(&traced.stderr).into_owned();
    assert!(traced.status.code() == Some(2) && err.lines().count() == 1 && err.contains("--trace"), "{err}");
    for text in [r#"{"format":"mceip-mcp/1","m":[[1,2]],"q":[-1]}"#, r#"{"format":"mceip-mcp/1","m":[[1]],"q":["1e999999"]}"#, "{}"] {
        let bad = mceip(&["solve", &write(folder.path(), "bad.json", text)]);
        assert_eq!((bad.status.code(), String::from_utf8_lossy(&bad.stderr).lines().count()), (Some(2), 1), "{text}");
    }
}

#[test]
fn a_trace_replays_and_a_changed_one_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let problem = concat!(env!("CARGO_MANIFEST_DIR"), "/spec/examples/fold.json");
    let trace = folder.path().join("t.txt").display().to_string();
    assert_eq!(mceip(&["solve", problem, "--all", "--starts", "4", "--seed", "7", "--trace", &trace]).status.code(), Some(0));
    let text = std::fs::read_to_string(&trace).unwrap();
    assert!(text.contains("leaves") && text.contains("curve") && text.contains("certified in run"));
    let same = mceip(&["solve", "--replay", &trace]);
    assert!(same.status.code() == Some(0) && stdout(&same).starts_with("IDENTICAL"), "{}", stdout(&same));
    let changed = write(folder.path(), "u.txt", &text.replacen("Exchange", "Flip", 1));
    let different = mceip(&["solve", "--replay", &changed]);
    assert!(different.status.code() == Some(1) && stdout(&different).starts_with("DIFFERENT"), "{}", stdout(&different));
    let seed = write(folder.path(), "s.txt", &text.replacen("\"seed\":7", "\"seed\":8", 1));
    assert_eq!(mceip(&["solve", "--replay", &seed]).status.code(), Some(1));
    assert_eq!(mceip(&["solve", "--replay", problem]).status.code(), Some(2));
}
