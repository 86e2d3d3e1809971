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
    let o = mceip(args);
    let err = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(2), "{args:?}: {err}");
    assert!(
        o.stdout.is_empty() && err.lines().count() == 1 && err.len() < 800,
        "{err}"
    );
    assert!(
        words.iter().all(|w| err.contains(w)),
        "{words:?} not in: {err}"
    );
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
