//! `spec/checker.py` in tests: many files by one process.
#![allow(dead_code, missing_docs, unreachable_pub)]

use std::fs::File;
use std::io::{Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Reads pairs of paths from stdin and prints the exit code of each.
const RUN_ALL: &str = "
import contextlib, io, sys
sys.path.insert(0, sys.argv[1])
import checker
for line in sys.stdin:
    problem, certificate = line.split()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        code = checker.main([problem, certificate])
    print(code)
";

/// Exit codes, one for each pair of a problem and a certificate.
pub fn codes(files: &[[PathBuf; 2]]) -> Vec<i32> {
    let mut python = Command::new("python3");
    python
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", RUN_ALL])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec"))
        .stdin(list_of(files));
    let output = python.output().unwrap();

    let text = String::from_utf8_lossy(&output.stdout);
    let codes: Vec<i32> = text.lines().map(|line| line.parse().unwrap()).collect();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(codes.len(), files.len(), "{err}");
    codes
}

/// A line for each pair, as checkers of many files read them from stdin.
pub fn list_of(files: &[[PathBuf; 2]]) -> File {
    let mut list = tempfile::tempfile().unwrap();
    for [problem, certificate] in files {
        writeln!(list, "{} {}", problem.display(), certificate.display()).unwrap();
    }

    list.rewind().unwrap();
    list
}
