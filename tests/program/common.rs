//! What the tests of the program share: files of the repository, problem files, and runs of the
//! program with their exit code and text.
#![cfg(feature = "cli")]

use crate::program::mceip;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Body, Problem};
use mceip_oracle::TwoParticles;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// A file or folder of the repository.
pub(crate) fn repository(path: &str) -> String {
    format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// A file of `tests/edges`.
pub(crate) fn edge(name: &str) -> String {
    repository(&format!("tests/edges/{name}"))
}

/// A problem of `spec/examples`.
pub(crate) fn example(name: &str) -> String {
    repository(&format!("spec/examples/{name}.json"))
}

pub(crate) fn read(path: &str) -> String {
    std::fs::read_to_string(path).unwrap()
}

pub(crate) fn read_json(path: impl AsRef<Path>) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// The names of the files in a folder.
pub(crate) fn names_in(folder: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

/// A decimal of a report as a number.
pub(crate) fn decimal(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// A run of the program that has ended.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// Runs a command line, which is split at blanks: no path of a test has one.
pub(crate) fn run(command: &str) -> Run {
    run_words(&command.split(' ').collect::<Vec<_>>())
}

pub(crate) fn run_words(args: &[&str]) -> Run {
    let output = mceip(args);
    Run {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

/// A run that has begun, with pipes for its output.
pub(crate) fn started(command: &str) -> Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_mceip"));
    program.args(command.split(' ')).stdin(Stdio::null());
    let piped = program.stdout(Stdio::piped()).stderr(Stdio::piped());
    piped.spawn().unwrap()
}

pub(crate) fn exit_code(command: &str) -> Option<i32> {
    run(command).code
}

/// What a run prints that must end with this exit code.
#[track_caller]
pub(crate) fn exits(code: i32, command: &str) -> String {
    let run = run(command);
    assert_eq!(run.code, Some(code), "{command}: {}", run.stderr);
    run.stdout
}

/// The same, read as JSON.
#[track_caller]
pub(crate) fn exits_with_json(code: i32, command: &str) -> Value {
    serde_json::from_str(&exits(code, command)).unwrap()
}

/// Exit 2, nothing on stdout, one line on stderr of at most 600 bytes that has each of `words`.
#[track_caller]
pub(crate) fn refused(command: &str, words: &[&str]) {
    let run = run(command);
    let message = &run.stderr;
    assert_eq!(run.code, Some(2), "{command}: {message}");
    assert!(run.stdout.is_empty(), "{run:?}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(message.len() < 600, "{message}");
    contains_all(message, words);
}

/// The text has each of these words.
#[track_caller]
pub(crate) fn contains_all(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "{word:?} not in: {text}");
    }
}

/// Two particles with c = 3/5, s = 4/5, k = 5, m = 1/7.
pub(crate) fn two_particles_with(signs: (i8, i8), mu: Rational) -> TwoParticles {
    TwoParticles {
        c: rational(3, 5),
        s: rational(4, 5),
        k: whole(5),
        m: rational(1, 7),
        mu,
        signs,
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
