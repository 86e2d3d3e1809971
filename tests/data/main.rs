//! Tests whose cases are files, one test for each file, so that one can be run alone:
//!
//!     cargo test --test data corpus::reject::cover-pivot
//!
//! `corpus` judges the files of `spec/corpus`, `transcripts` runs the pages of `tests/transcripts`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/program.rs"]
mod program;
#[path = "../support/corpus.rs"]
mod support;

mod corpus;
mod transcripts;

use libtest_mimic::{Arguments, run};

fn main() {
    let arguments = Arguments::from_args();
    let mut tests = corpus::tests();
    tests.extend(transcripts::tests());
    run(&arguments, tests).exit();
}
