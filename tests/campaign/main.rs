//! The crate `testkit`: the verification run, the campaign, floors of coverage, replays of fuzzing.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod campaign;
mod floors;
mod fuzz_replay;
mod replays;
mod verify;
