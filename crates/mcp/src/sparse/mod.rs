//! Sparse linear MCPs: many unknowns, of which only those with bounds are pivoted.
//!
//! `problem` holds the problem, made from entries. `condensed` eliminates the unknowns without
//! bounds by one sparse factorisation, runs [`crate::solver`] on what is left, and lifts the result
//! to all unknowns (book, 3.12).
#![allow(clippy::float_arithmetic)]

mod condensed;
mod problem;

pub use condensed::{CondensedMcp, SparseError};
pub use problem::SparseLinearMcp;
