//! `mceip check PROBLEM REPORT`: somebody's solutions accepted, refuted or left undecided, in one
//! line each.
//!
//! The problems are solved by hand or by the enumerator, so the right verdict of each point is
//! known; a point that costs too much fails. What is printed, on both sides of each tolerance,
//! stands in `tests/transcripts/check-reports.md`.
#![cfg(feature = "cli")]

use crate::common::{contains_all, example, pencil_problem, read, run, solutions_text};
use crate::program::{Folder, mceip};
use serde_json::{Value, json};
use std::io::Write as _;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The verdict of `check`.
#[derive(Debug)]
struct Checked {
    code: i32,
    text: String,
}

impl Checked {
    /// The verdict has this exit code, begins with these words and has those.
    #[track_caller]
    fn says(&self, code: i32, start: &str, words: &[&str]) {
        assert_eq!(self.code, code, "{}", self.text);
        assert!(self.text.starts_with(start), "{start}: {}", self.text);
        contains_all(&self.text, words);
    }
}

/// Runs `check` on a report with these solutions.
fn check(problem: &str, solutions: &str) -> Checked {
    let folder = Folder::new();
    let report = folder.write("r.json", &solutions_text(solutions));
    let run = run(&format!("check {problem} {report}"));

    Checked {
        code: run.code.unwrap(),
        text: run.stdout,
    }
}

/// A list of one solution.
fn point(value: &str, x: &str) -> String {
    format!(r#"[{{"value":{value},"x":{x}}}]"#)
}

/// At relative distances 1e-6 to 1e-12 of a threshold: below it the residual of t = 0 is as small,
/// and nothing exists; on it the same report is right, and above it the solution is near and is not
/// 0.
#[test]
fn near_a_threshold() {
    let folder = Folder::new();

    for power in 6..=12 {
        let distance = format!("1e-{power}");

        // (d + t) x = y has no solution for d > 0.
        let below = folder.write("below.json", &shifted(&distance));
        check(&below, &point("0", "[1,0]")).says(1, "REJECTED", &[]);
        check(&below, &point(&format!("\"{distance}\""), "[1,0]")).says(1, "", &[]);

        // For d <= 0 it has the solution t = -d.
        let above = folder.write("above.json", &shifted(&format!("-{distance}")));
        check(&above, &point("0", "[1,0]")).says(1, "INACCURATE", &[]);
        check(&above, &point(&format!("\"{distance}\""), "[1,0]")).says(0, "", &[]);
    }
}

/// The problem (d + t) x0 = y0, x0 + (3 + t) x1 = y1.
fn shifted(d: &str) -> String {
    let pencil = json!({ "a": [[d, "0"], ["1", "3"]], "b": [["1", "0"], ["0", "1"]] });
    pencil_problem("lambda2", pencil)
}

/// Runs the program with a text on stdin.
fn run_with_input(args: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();

    // A program that refuses its options closes the pipe before it has read all.
    let mut stdin = child.stdin.take().unwrap();
    _ = stdin.write_all(input.as_bytes());
    drop(stdin);

    child.wait_with_output().unwrap()
}

/// A problem or a report on stdin.
#[test]
fn stdin_is_a_file() {
    let fold = example("fold");
    let problem = read(&fold);

    let enumerated = run_with_input(&["enumerate", "-"], &problem);
    assert_eq!(enumerated.stdout, mceip(&["enumerate", &fold]).stdout);

    let solved = run_with_input(&["solve", "-", "--starts", "4"], &problem);
    assert_eq!(solved.status.code(), Some(0));

    let report = solutions_text(&point("3", "[3,1.5]"));
    let checked = run_with_input(&["check", &fold, "-"], &report);
    assert_eq!(checked.status.code(), Some(1));

    let bad = run_with_input(&["enumerate", "-"], "{");
    let message = String::from_utf8(bad.stderr).unwrap();
    assert_eq!(bad.status.code(), Some(2));
    assert!(message.starts_with("mceip: -: line 1"), "{message}");

    let twice = run_with_input(&["check", "-", "-"], &report);
    assert_eq!(twice.status.code(), Some(2));

    // A pipe by its name is read once, too.
    if cfg!(target_os = "linux") {
        let solved = run_with_input(&["solve", "/dev/stdin", "--starts", "4"], &problem);
        assert_eq!(solved.status.code(), Some(0), "{solved:?}");

        let folder = Folder::new();
        let report = folder.write("report.json", &report);
        let checked = run_with_input(&["check", "/dev/stdin", &report], &problem);
        assert_eq!(checked.status.code(), Some(1), "{checked:?}");
    }
}

/// A diagonal matrix as a sparse one of a problem file.
fn diagonal(order: usize, value: &str) -> Value {
    let entries: Vec<Value> = (0..order).map(|i| json!([i, i, value])).collect();
    json!({ "rows": order, "cols": order, "entries": entries })
}

/// The verdict of a check that must end within 5 s.
#[track_caller]
fn check_within_five_seconds(problem: &str, solutions: &str) -> Checked {
    let begun = Instant::now();
    let checked = check(problem, solutions);
    let elapsed = begun.elapsed();

    assert!(elapsed < Duration::from_secs(5), "{elapsed:?}");
    checked
}

/// A dense pencil with 35 free variables and 45 points that are near nothing: a report of 5 kB
/// within 5 s.
#[test]
fn points_near_nothing_cost_little() {
    let order = 40;
    let mut a = vec![vec![0; order]; order];

    for i in 0..order {
        for j in 0..order {
            a[i][j] = ((7 * i + 11 * j + i * j) % 6) as i64 - 2;
        }
    }

    let free: Vec<usize> = (5..order).collect();
    let pencil = json!({ "a": a, "b": diagonal(order, "1"), "free": free });
    let folder = Folder::new();
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    let mut points = Vec::new();
    for k in 0..45 {
        let x: Vec<usize> = (0..order).map(|i| (i * k + i) % 4).collect();
        points.push(json!({ "value": k, "x": x }));
    }

    let checked = check_within_five_seconds(&problem, &json!(points).to_string());

    assert!(checked.code == 3 || checked.code == 1, "{checked:?}");
    assert_eq!(checked.text.lines().count(), 45, "{checked:?}");
    assert!(!checked.text.contains("ACCEPTED"), "{checked:?}");
}

/// Two equal rows of A and of B: every support with both has a determinant that is zero for all
/// values. Describing them took more than a minute.
#[test]
fn supports_that_are_singular_everywhere_are_not_enumerated() {
    let order = 9;
    let mut a = vec![vec![0; order]; order];
    let mut b = vec![vec![0; order]; order];

    for i in 0..order {
        for j in 0..order {
            let row = i.max(1); // row 0 is row 1
            a[i][j] = ((5 * row + 3 * j + 2 * row * j) % 7) as i64 - 3;
            b[i][j] = ((4 * row + 5 * j + 3 * row * j) % 7) as i64 - 3;
        }
    }

    let pencil = json!({ "a": a, "b": b, "free": [] });
    let folder = Folder::new();
    let problem = folder.write("p.json", &pencil_problem("lambda2", pencil));

    let checked = check_within_five_seconds(&problem, &point("1", "[1,1,1,1,1,1,1,1,1]"));

    assert_eq!(checked.code, 3, "{checked:?}");
    assert!(checked.text.contains("were needed"), "{checked:?}");
}

/// A value or an entry beyond doubles leaves the box without a preconditioner of bounded length:
/// undecided, at once.
#[test]
fn numbers_beyond_doubles_cost_little() {
    let folder = Folder::new();
    let a = json!({ "rows": 4, "cols": 4, "entries": [[1, 3, "1e400"]] });
    let pencil = json!({ "a": a, "b": diagonal(4, "1"), "free": [0] });
    let problem = folder.write("p.json", &pencil_problem("mu", pencil));

    let solutions = point("\"1e308\"", r#"["1","1","1","2"]"#);
    let checked = check_within_five_seconds(&problem, &solutions);

    assert!(checked.code == 3 || checked.code == 1, "{checked:?}");
}

/// A dense pencil of order 12 with numbers from 1e-99 to 1e99: enumerating 16 supports would take a
/// minute, and is not begun.
#[test]
fn long_determinants_are_not_enumerated() {
    let folder = Folder::new();
    let mut dense: Vec<Vec<String>> = Vec::new();

    for i in 0..12 {
        let mut row = Vec::new();
        for j in 0..12 {
            let digit = 1 + (3 * i + 5 * j) % 9;
            let exponent = (37 * i + 59 * j + i * j) % 199;
            let sign = if (i + j) % 2 == 0 { "-" } else { "" };
            row.push(format!("{digit}e{sign}{exponent}"));
        }
        dense.push(row);
    }

    let free: Vec<usize> = (4..12).collect();
    let pencil = json!({ "a": dense, "b": dense, "free": free });
    let problem = folder.write("p.json", &pencil_problem("mu", pencil));

    let solutions = point("3", "[1,1,1,1,1,1,1,1,1,1,1,1]");
    let checked = check_within_five_seconds(&problem, &solutions);

    assert_eq!(checked.code, 3, "{checked:?}");
}
