//! Replays the fuzz corpus and the regressions on stable, without a fuzzer.
#![cfg(feature = "testkit")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::testkit::targets;
use std::path::Path;

fn replay(target: &str, body: fn(&[u8])) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let mut count = 0;
    for folder in ["corpus", "regressions"] {
        let Ok(files) = std::fs::read_dir(root.join(folder).join(target)) else { continue };
        for file in files {
            let path = file.unwrap().path();
            println!("{}", path.display()); // shown when the body panics
            body(&std::fs::read(&path).unwrap());
            count += 1;
        }
    }
    assert!(count >= 20, "{target}: only {count} inputs");
}

#[test]
fn problem_reader() {
    replay("problem_reader", targets::problem_reader);
}

#[test]
fn solver_against_oracle() {
    replay("solver_against_oracle", targets::solver_against_oracle);
}

#[test]
fn checker_against_forgeries() {
    replay("checker_against_forgeries", targets::checker_against_forgeries);
}
