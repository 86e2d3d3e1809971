//! `mceip solve` on plain LCP and MCP files, trace and replay, through the program.
//!
//! The solutions of the problems are known, certificates are exact and judged by `mceip check`, and
//! a trace must be repeated to the letter. Forged certificates and changed traces must be noticed.
#![cfg(feature = "cli")]

use crate::common::{contains_all, example, exits, exits_with_json, read, repository, run};
use crate::program::{Folder, refused};

/// The run of `args` ends with this exit code and a text that begins with these words.
#[track_caller]
fn says(args: &[&str], code: i32, start: &str) {
    let text = exits(code, args);
    assert!(text.starts_with(start), "{start}: {text}");
}

#[test]
fn an_lcp_is_solved_certified_and_checked() {
    let folder = Folder::new();
    let problem = folder.write(
        "lcp.json",
        r#"{"format":"mceip-mcp/1","m":[["0.2","0.1"],["1/10","2/10"]],"q":["-0.5","-0.6"]}"#,
    );
    let certificate = folder.path("c.json");

    let text = exits(0, &["solve", &problem, "--certificate", &certificate]);
    contains_all(&text, &["z[0] = 4/3", "completeness unknown"]);
    says(
        &["solve", &problem, "--check", &certificate],
        0,
        "ACCEPTED: 1",
    );

    // A forged digit, and a certificate of another problem.
    let forged = read(&certificate).replace("4/3", "4/5");
    let forged = folder.write("f.json", &forged);
    says(
        &["solve", &problem, "--check", &forged],
        1,
        "REJECTED: solution 0: F[0]",
    );
    let other = folder.write(
        "o.json",
        r#"{"format":"mceip-mcp/1","m":[[2,1],[1,3]],"q":[-5,-6]}"#,
    );
    let rejected = "REJECTED: digest: expected";
    says(&["check", &other, &certificate], 1, rejected);
    says(&["solve", &other, "--check", &certificate], 1, rejected);
}

/// `mceip check` by the format of the problem: plain and eigenproblem, each with its own
/// certificates only.
#[test]
fn check_dispatches_on_the_format() {
    let folder = Folder::new();
    let plain = example("bounded-mcp");
    let pencil = example("fold");
    let of_plain = folder.path("p.json");
    let of_pencil = folder.path("q.json");

    exits(0, &["solve", &plain, "--all", "--certificate", &of_plain]);
    exits(0, &["solve", &pencil, "--certificate", &of_pencil]);

    says(&["check", &plain, &of_plain], 0, "ACCEPTED: 3 solution(s)");
    exits(0, &["check", &pencil, &of_pencil]);

    let text = read(&of_plain);
    let (head, _) = text.split_once("\"z\"").unwrap();
    let none = folder.write("none.json", &format!("{head}\"z\": []}}"));
    says(
        &["check", &plain, &none],
        1,
        "REJECTED: z: expected at least one",
    );

    refused(&["check", &plain, &of_pencil], &["mceip-mcp-solution/1"]);
    refused(&["check", &pencil, &of_plain], &["mceip-certificate/1"]);
}

/// A trace with a piece of its text replaced, as a file.
#[track_caller]
fn changed_trace(folder: &Folder, trace: &str, from: &str, to: &str) -> String {
    let text = read(trace);
    assert!(text.contains(from), "{from}");
    folder.write("changed.txt", &text.replacen(from, to, 1))
}

/// The trace of a plain problem: its own replay, and what each change does to it.
#[test]
fn a_plain_trace_replays_and_a_changed_one_does_not() {
    let folder = Folder::new();
    let problem = example("bounded-mcp");
    let trace = folder.path("t.txt");
    let options = ["--all", "--starts", "6", "--seed", "3", "--trace", &trace];

    exits(0, &[&["solve", &problem][..], &options].concat());

    contains_all(
        &read(&trace),
        &["run from", "curve from", "certified: 5/6 1/2 1 2"],
    );
    says(&["solve", "--replay", &trace], 0, "IDENTICAL");

    for (from, to) in [
        ("certified: 5/6", "certified: 6/6"),
        ("\"seed\":3", "\"seed\":4"),
        ("1/3", "1/2"),
    ] {
        let changed = changed_trace(&folder, &trace, from, to);
        says(&["solve", "--replay", &changed], 1, "DIFFERENT");
    }

    for (from, to) in [
        ("\"starts\":6", "\"starts\":0"),
        ("mceip-mcp/1", "mceip-mcp/2"),
        ("mceip-trace/1", "mceip-trace/2"),
    ] {
        let bad = changed_trace(&folder, &trace, from, to);
        refused(&["solve", "--replay", &bad], &[]);
    }
}

#[test]
fn bounds_of_every_kind_and_all_solutions() {
    let folder = Folder::new();

    // z0 fixed at 1, z1 free, z2 in [0, 2] with F2 = 1 - z2 (solutions 0, 1 and 2).
    let problem = folder.write(
        "mcp.json",
        r#"{"format":"mceip-mcp/1","m":[[0,0,0],[1,2,0],[0,0,-1]],"q":[-9,"-4",1],
            "lower":[1,null,0],"upper":[1,null,2]}"#,
    );

    let report = exits_with_json(0, &["solve", &problem, "--all", "--json"]);

    let mut last_components = Vec::new();
    for solution in report["solutions"].as_array().unwrap() {
        let z = &solution["z"];
        assert_eq!(z[0], "1");
        assert_eq!(z[1], "3/2");
        last_components.push(z[2].as_str().unwrap());
    }

    last_components.sort();
    assert_eq!(last_components, ["0", "1", "2"]);
}

#[test]
fn no_solution_is_undecided_and_bad_files_are_one_line() {
    let folder = Folder::new();
    let unsolvable = folder.write(
        "none.json",
        r#"{"format":"mceip-mcp/1","m":[[-1]],"q":[-1]}"#,
    );
    let text = exits(3, &["solve", &unsolvable]);

    assert!(text.contains("0 certified"), "{text}");

    // An option of the other kind of problem is refused, not ignored.
    refused(&["solve", &unsolvable, "--window", "0,1"], &["--window"]);

    for text in [
        r#"{"format":"mceip-mcp/1","m":[[1,2]],"q":[-1]}"#,
        r#"{"format":"mceip-mcp/1","m":[[1]],"q":["1e999999"]}"#,
        "{}",
    ] {
        refused(&["solve", &folder.write("bad.json", text)], &[]);
    }
}

#[test]
fn a_trace_replays_and_a_changed_one_does_not() {
    let folder = Folder::new();
    let problem = example("fold");
    let trace = folder.path("t.txt");
    let options = ["--all", "--starts", "4", "--seed", "7", "--trace", &trace];

    exits(0, &[&["solve", &problem][..], &options].concat());

    contains_all(&read(&trace), &["leaves", "curve", "certified in run"]);
    says(&["solve", "--replay", &trace], 0, "IDENTICAL");

    let changed = changed_trace(&folder, &trace, "Exchange", "Flip");
    says(&["solve", "--replay", &changed], 1, "DIFFERENT");
    let other_seed = changed_trace(&folder, &trace, "\"seed\":7", "\"seed\":8");

    exits(1, &["solve", "--replay", &other_seed]);
    assert_eq!(run(&["solve", "--replay", &problem]).code, Some(2));
}

/// Written before the crash could be chosen: its options do not name it, and it was projected
/// Newton.
#[test]
fn a_trace_from_before_the_choice_of_a_crash_replays() {
    let folder = Folder::new();
    let old = repository("tests/traces/before-crash-method.trace");

    let text = read(&old);
    assert!(!text.contains("crash_method"));
    assert!(text.contains("Crash"));

    says(&["solve", "--replay", &old], 0, "IDENTICAL");

    let with_another_crash = changed_trace(
        &folder,
        &old,
        "crash_iteration_limit: 50",
        "crash_method: FischerNewton, crash_iteration_limit: 50",
    );
    let text = exits(1, &["solve", "--replay", &with_another_crash]);

    assert!(text.contains("line 1"), "{text}");
}
