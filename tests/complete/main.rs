//! Complete sets: `mceip_engine::search::complete` against the exact enumerator.
//!
//! The search encloses all solutions in a window and proves that there are no others. Each file
//! takes one kind of problem: random pencils, windows that end on a solution, the last interval of
//! an infinite window, the block of the paper, and what a search costs.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(all(feature = "testkit", feature = "picture"))]
#[path = "../support/cost.rs"]
mod cost;
#[cfg(feature = "testkit")]
#[path = "../support/cover.rs"]
mod cover;

mod analyze_zero;
mod complete;
mod complete_block;
mod complete_cost;
mod complete_ends;
mod complete_random;
mod complete_tail;
mod complete_zero;
mod eigenvalues;
mod listed_x;
