//! Tests that read the repository's own text: laws of the house, pages, planted bugs, mutants.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

// The solver compiled on its own, for `laws`: nothing but `mcp` beside it, no oracle, no model.
#[cfg(feature = "solver")]
#[path = "../../src/mcp.rs"]
#[allow(dead_code, unreachable_pub)]
pub mod mcp;
#[cfg(feature = "solver")]
#[path = "../../src/solver/mod.rs"]
#[allow(dead_code, unreachable_pub)]
pub mod solver;

mod conformance;
mod laws;
mod mutants;
mod planted;
mod traceability;
