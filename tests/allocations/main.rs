//! What the solver and the checker allocate. These tests are a process of their own, because its
//! allocator counts.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(feature = "testkit")]
#[path = "../families/mod.rs"]
mod families;

mod checker_memory;
mod solver_allocations;
