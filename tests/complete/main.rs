//! Complete sets: `mceip_engine::search::complete` against the enumerator.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(all(feature = "testkit", feature = "picture"))]
#[path = "../support/cost.rs"]
mod cost;
#[cfg(feature = "testkit")]
#[path = "../support/cover.rs"]
mod cover;

mod complete;
mod complete_block;
mod complete_cost;
mod complete_ends;
mod complete_random;
mod complete_tail;
