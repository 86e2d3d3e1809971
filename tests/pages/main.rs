//! Tests that read the repository's own text: manifests, sources, pages, planted bugs, mutants.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod book;
mod conformance;
mod examples;
mod laws;
mod mutants;
mod planted;
mod traceability;

use std::path::{Path, PathBuf};

/// The repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

/// The text of a file of the repository.
fn read(path: impl AsRef<Path>) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}
