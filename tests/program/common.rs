//! What the tests of the program share: files of the repository, problem files, and runs of the
//! program with their exit code and text.
#![cfg(feature = "cli")]

use crate::program::mceip;
use mceip_exact::Sparse;
use mceip_model::{Body, Problem};
use serde_json::{Value, json};

/// A file or folder of the repository.
pub(crate) fn repository(path: &str) -> String {
    format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// A problem of `spec/examples`.
pub(crate) fn example(name: &str) -> String {
    repository(&format!("spec/examples/{name}.json"))
}

pub(crate) fn read(path: &str) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// A run of the program that has ended.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

pub(crate) fn run(args: &[&str]) -> Run {
    let output = mceip(args);
    Run {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

pub(crate) fn exit_code(args: &[&str]) -> Option<i32> {
    run(args).code
}

/// What a run prints that must end with this exit code.
#[track_caller]
pub(crate) fn exits(code: i32, args: &[&str]) -> String {
    let run = run(args);
    assert_eq!(run.code, Some(code), "{args:?}: {}", run.stderr);
    run.stdout
}

/// The same, read as JSON.
#[track_caller]
pub(crate) fn exits_with_json(code: i32, args: &[&str]) -> Value {
    serde_json::from_str(&exits(code, args)).unwrap()
}

/// The text has each of these words.
#[track_caller]
pub(crate) fn contains_all(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "{word:?} not in: {text}");
    }
}

/// The text of a problem file with a pencil.
pub(crate) fn pencil_problem(unknown: &str, pencil: Value) -> String {
    json!({ "format": "mceip-problem/1", "unknown": unknown, "pencil": pencil }).to_string()
}

/// The text of the file of a problem whose body is a pencil, with dense matrices.
pub(crate) fn problem_text(problem: &Problem) -> String {
    let Body::Pencil(pencil) = problem.body() else {
        panic!("a pencil")
    };
    let pencil = json!({
        "a": dense(pencil.a()),
        "b": dense(pencil.b()),
        "free": pencil.free(),
    });

    pencil_problem(problem.unknown().word(), pencil)
}

fn dense(matrix: &Sparse) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for i in 0..matrix.rows() {
        let entries = (0..matrix.cols()).map(|j| matrix.get(i, j).to_string());
        rows.push(entries.collect());
    }
    rows
}

/// The text of a file of solutions.
pub(crate) fn solutions_text(solutions: &str) -> String {
    format!(r#"{{"format":"mceip-solutions/1","solutions":{solutions}}}"#)
}
