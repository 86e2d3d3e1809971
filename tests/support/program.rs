//! The program from outside, and a folder of files for it.
#![allow(dead_code, missing_docs, unreachable_pub)]

use std::process::{Command, Output};

/// Runs the program. A certificate that it has written is accepted when it is read from the disk.
#[track_caller]
pub fn mceip(args: &[&str]) -> Output {
    let output = without_check(args);
    if let Some([problem, certificate]) = written_certificate(args)
        && output.status.success()
    {
        let verdict = without_check(&["check", problem, certificate]);
        let said = String::from_utf8_lossy(&verdict.stdout);
        assert_eq!(verdict.status.code(), Some(0), "{args:?}: {said}");
    }

    output
}

fn without_check(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .output()
        .unwrap()
}

/// The problem and the certificate of a command that ends with exit 0 only after it has written the
/// certificate.
fn written_certificate<'a>(args: &[&'a str]) -> Option<[&'a str; 2]> {
    let option = match args.first() {
        Some(&("complete" | "merge" | "solve")) => "--certificate",
        Some(&"certify") => "--out",
        _ => return None,
    };
    let place = args.iter().position(|arg| *arg == option)?;
    let certificate = args.get(place + 1)?;
    let problem = args.get(1)?;
    let are_files =
        std::path::Path::new(problem).is_file() && std::path::Path::new(certificate).is_file();
    are_files.then_some([*problem, *certificate])
}

/// Exit 2, nothing on stdout, one line on stderr that mentions each of `words`.
#[track_caller]
pub fn refused(args: &[&str], words: &[&str]) {
    let output = mceip(args);
    let err = String::from_utf8_lossy(&output.stderr);

    assert_eq!(output.status.code(), Some(2), "{args:?}: {err}");
    assert!(output.stdout.is_empty(), "{err}");
    assert_eq!(err.lines().count(), 1, "{err}");
    assert!(err.len() < 800, "{err}");

    let has_all = words.iter().all(|word| err.contains(word));
    assert!(has_all, "{words:?} not in: {err}");
}

/// A folder of problem files and whatever the program writes.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    pub fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    pub fn write(&self, name: &str, text: &str) -> String {
        std::fs::write(self.path(name), text).unwrap();
        self.path(name)
    }
}
