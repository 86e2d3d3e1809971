//! The checker: verdicts, forgeries, the corpus, and the second checker beside it.
//!
//! `corpus` and `verdicts` read the files of `spec/corpus`, which break one obligation each; the
//! `*_forged` files change real covers in one place; `complete_mutants`, `mutated_claims` and
//! `two_checkers` change certificates at random and ask the exact enumerator; `verified` runs the
//! checker of `proofs/` beside ours.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/corpus.rs"]
mod corpus_reader;
#[cfg(feature = "testkit")]
#[path = "../support/cover.rs"]
mod cover;
#[cfg(feature = "testkit")]
#[path = "../support/json_places.rs"]
mod json_places;
#[path = "../support/program.rs"]
mod program;
#[cfg(feature = "testkit")]
#[path = "../support/python_checker.rs"]
mod python_checker;
#[cfg(feature = "testkit")]
#[path = "../support/structural.rs"]
mod structural;
#[cfg(feature = "testkit")]
#[path = "../support/verified_checker.rs"]
mod verified_checker;
#[cfg(feature = "testkit")]
#[path = "../support/witnessed.rs"]
mod witnessed;

mod check_time;
mod checker;
mod complete_forged;
mod complete_infinity_forged;
mod complete_mutants;
mod corpus;
mod critical;
mod lean;
mod local_modes;
mod mutated_claims;
mod second_checker;
mod two_checkers;
mod two_readers;
mod verdicts;
mod verified;
