//! The program from outside, and a folder of files for it.
#![allow(dead_code, missing_docs, unreachable_pub)]

use std::process::{Command, Output};

pub fn mceip(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .output()
        .unwrap()
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
