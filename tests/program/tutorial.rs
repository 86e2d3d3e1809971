//! The commands of `spec/tutorial.md`, run as they stand there. Opt-in: they install packages.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

/// The fenced blocks of the tutorial with this info string, joined.
fn commands(info: &str) -> String {
    let page =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/tutorial.md"))
            .unwrap();
    let opening = format!("```{info}\n");
    let mut script = String::from("set -euo pipefail\n");
    let mut rest = page.as_str();
    while let Some((_, after)) = rest.split_once(&opening) {
        let (block, after) = after.split_once("```").unwrap();
        script += block;
        rest = after;
    }
    script
}

fn run(folder: &Path, script: &str) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_mceip")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut bash = Command::new("bash");
    bash.args(["-c", script])
        .current_dir(folder)
        .env("PATH", path)
        .env("REPO", env!("CARGO_MANIFEST_DIR"));
    bash.output().unwrap()
}

#[test]
fn the_tutorial_has_commands_and_names_files_that_exist() {
    let (first, second) = (commands("sh"), commands("sh calculix"));
    assert!(
        first.contains("mceip convert")
            && first.contains("mceip check")
            && second.contains("ccx plate")
    );
    for name in ["tutorial.py", "plate.inp", "plate-contacts.csv"] {
        assert!(format!("{first}{second}").contains(name));
        assert!(
            Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("spec/examples")
                .join(name)
                .exists(),
            "{name}"
        );
    }
}

#[test]
#[ignore = "installs scikit-fem from the package index"]
fn the_commands_give_what_the_page_says() {
    let folder = tempfile::tempdir().unwrap();
    let o = run(folder.path(), &commands("sh"));
    let (out, err) = (
        String::from_utf8_lossy(&o.stdout),
        String::from_utf8_lossy(&o.stderr),
    );
    assert!(o.status.success(), "{out}\n{err}");
    for line in [
        "20 degrees of freedom, 4 of 5 nodes slide",
        "form (8) is ABSENT",
        "[2.21062778, 2.21062779]",
        "WARNING of flutter",
        "ACCEPTED",
    ] {
        assert!(out.contains(line), "no {line:?} in {out}");
    }
    assert!(
        std::fs::read_to_string(folder.path().join("at-3.json"))
            .unwrap()
            .contains("\"verdict\":\"present\"")
    );
}

#[test]
#[ignore = "needs ccx (Debian: calculix-ccx)"]
fn the_commands_for_calculix_give_what_the_page_says() {
    let folder = tempfile::tempdir().unwrap();
    let o = run(folder.path(), &commands("sh calculix"));
    let (out, err) = (
        String::from_utf8_lossy(&o.stdout),
        String::from_utf8_lossy(&o.stderr),
    );
    assert!(
        o.status.success()
            && out.contains("form (8) is PRESENT: 1 solution")
            && out.contains("[1.80286761, 1.80286762]"),
        "{out}\n{err}"
    );
}
