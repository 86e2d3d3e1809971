//! The crate `testkit`: the verification run, the campaign, floors of coverage, replays of fuzzing.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(feature = "testkit")]
#[path = "../support/solver_targets.rs"]
mod solver_targets;

mod campaign;
mod floors;
mod fuzz_replay;
mod replays;
mod verify;
