//! `mceip solve` on plain LCP and MCP files, trace and replay, through the program.
//!
//! The solutions of the problems are known, certificates are exact and judged by `mceip check`, and
//! a trace must be repeated to the letter. Forged certificates and changed traces must be noticed.
#![cfg(feature = "cli")]

use crate::common::{contains_all, example, exits, read, refused, repository, run};
use crate::program::Folder;

/// The run of `args` ends with this exit code and a text that begins with these words.
#[track_caller]
fn says(command: &str, code: i32, start: &str) {
    let text = exits(code, command);
    assert!(text.starts_with(start), "{start}: {text}");
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

    exits(
        0,
        &format!("solve {problem} --all --starts 6 --seed 3 --trace {trace}"),
    );

    contains_all(
        &read(&trace),
        &["run from", "curve from", "certified: 5/6 1/2 1 2"],
    );
    says(&format!("solve --replay {trace}"), 0, "IDENTICAL");

    for (from, to) in [
        ("certified: 5/6", "certified: 6/6"),
        ("\"seed\":3", "\"seed\":4"),
        ("1/3", "1/2"),
    ] {
        let changed = changed_trace(&folder, &trace, from, to);
        says(&format!("solve --replay {changed}"), 1, "DIFFERENT");
    }

    for (from, to) in [
        ("\"starts\":6", "\"starts\":0"),
        ("mceip-mcp/1", "mceip-mcp/2"),
        ("mceip-trace/1", "mceip-trace/2"),
    ] {
        let bad = changed_trace(&folder, &trace, from, to);
        refused(&format!("solve --replay {bad}"), &[]);
    }
}

#[test]
fn a_trace_replays_and_a_changed_one_does_not() {
    let folder = Folder::new();
    let problem = example("fold");
    let trace = folder.path("t.txt");

    exits(
        0,
        &format!("solve {problem} --all --starts 4 --seed 7 --trace {trace}"),
    );

    contains_all(&read(&trace), &["leaves", "curve", "certified in run"]);
    says(&format!("solve --replay {trace}"), 0, "IDENTICAL");

    let changed = changed_trace(&folder, &trace, "Exchange", "Flip");
    says(&format!("solve --replay {changed}"), 1, "DIFFERENT");
    let other_seed = changed_trace(&folder, &trace, "\"seed\":7", "\"seed\":8");

    exits(1, &format!("solve --replay {other_seed}"));
    assert_eq!(run(&format!("solve --replay {problem}")).code, Some(2));
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

    says(&format!("solve --replay {old}"), 0, "IDENTICAL");

    let with_another_crash = changed_trace(
        &folder,
        &old,
        "crash_iteration_limit: 50",
        "crash_method: FischerNewton, crash_iteration_limit: 50",
    );
    let text = exits(1, &format!("solve --replay {with_another_crash}"));

    assert!(text.contains("line 1"), "{text}");
}
