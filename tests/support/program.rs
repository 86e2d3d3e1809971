//! The program from outside, and a folder of files for it.
#![allow(dead_code, missing_docs, unreachable_pub)]

use std::path::Path;
use std::process::{Command, Output};

/// Runs the program. Where it ends with exit 0, the certificate that it was asked for has been
/// written, unless it says that none is, and is accepted when it is read from the disk.
#[track_caller]
pub fn mceip(args: &[&str]) -> Output {
    mceip_in(Path::new("."), args)
}

/// The same in a folder.
#[track_caller]
pub fn mceip_in(folder: &Path, args: &[&str]) -> Output {
    let output = without_check(folder, args);
    let is_said = |text: &[u8]| String::from_utf8_lossy(text).contains("is not written");
    let is_written = !is_said(&output.stdout) && !is_said(&output.stderr);

    if let Some([problem, certificate]) = certificate_asked_for(args)
        && output.status.success()
        && is_written
    {
        let verdict = without_check(folder, &["check", problem, certificate]);
        let said = String::from_utf8_lossy(&verdict.stdout);
        let err = String::from_utf8_lossy(&verdict.stderr);
        assert_eq!(verdict.status.code(), Some(0), "{args:?}: {said}{err}");
    }

    output
}

fn without_check(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The problem and the certificate of a command that is asked to write one. Nothing can be read
/// from devices afterwards.
fn certificate_asked_for<'a>(args: &[&'a str]) -> Option<[&'a str; 2]> {
    let after = |option: &str| {
        let place = args.iter().position(|arg| *arg == option)?;
        args.get(place + 1).copied()
    };
    let [problem, certificate] = match *args.first()? {
        "complete" | "solve" => [args.get(1).copied(), after("--certificate")],
        "merge" => [after("--problem"), after("--certificate")],
        "certify" => [args.get(1).copied(), after("--out")],
        _ => return None,
    };

    let certificate = certificate.filter(|certificate| !certificate.starts_with("/dev/"))?;
    Some([problem?, certificate])
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
