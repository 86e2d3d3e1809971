//! What the solver allocates: its own process, whose allocator counts.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(feature = "testkit")]
#[path = "../families/mod.rs"]
mod families;

mod solver_allocations;
mod solver_sparse;
