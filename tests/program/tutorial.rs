//! The commands of `spec/tutorial.md`, run as they stand there. Opt-in: they install packages.
//!
//! The truth is the figures that the page prints; a command that no longer works or gives another
//! answer fails.
#![cfg(feature = "cli")]

use crate::common::{contains_all, read, repository};
use crate::program::Folder;
use std::path::Path;
use std::process::Command;

/// The fenced blocks of the tutorial with this info string, joined.
fn commands(info: &str) -> String {
    let page = read(&repository("spec/tutorial.md"));
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

/// What a script prints that must succeed in this folder, with `mceip` on its path.
#[track_caller]
fn run_script(folder: &Folder, script: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_mceip")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());

    let output = Command::new("bash")
        .args(["-c", script])
        .current_dir(folder.path(""))
        .env("PATH", path)
        .env("REPO", env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();

    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}\n{message}");

    text
}

#[test]
fn the_tutorial_has_commands_and_names_files_that_exist() {
    let first = commands("sh");
    let for_calculix = commands("sh calculix");
    contains_all(&first, &["mceip convert", "mceip check"]);
    contains_all(&for_calculix, &["ccx plate"]);

    let both = first + &for_calculix;
    for name in ["tutorial.py", "plate.inp", "plate-contacts.csv"] {
        let file = repository(&format!("spec/examples/{name}"));
        assert!(both.contains(name), "{name}");
        assert!(Path::new(&file).exists(), "{name}");
    }
}

#[test]
#[ignore = "installs scikit-fem from the package index"]
fn the_commands_give_what_the_page_says() {
    let folder = Folder::new();

    let text = run_script(&folder, &commands("sh"));

    contains_all(
        &text,
        &[
            "20 degrees of freedom, 4 of 5 nodes slide",
            "lowest frequencies: 508.52, 708.42, 766.43",
            "form (8) is ABSENT",
            "[2.21062778, 2.21062779]",
            "sliding steadily in these contact states",
            "ACCEPTED",
        ],
    );
    let at_3 = read(&folder.path("at-3.json"));

    assert!(at_3.contains("\"verdict\":\"present\""), "{at_3}");
}

#[test]
#[ignore = "needs ccx (Debian: calculix-ccx)"]
fn the_commands_for_calculix_give_what_the_page_says() {
    let folder = Folder::new();

    let text = run_script(&folder, &commands("sh calculix"));

    contains_all(
        &text,
        &[
            "form (8) is PRESENT: 1 solution",
            "[1.80286761, 1.80286762]",
        ],
    );
}
