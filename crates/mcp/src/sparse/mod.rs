//! Sparse linear MCPs: many unknowns, of which only those with bounds are pivoted.
//!
//! `problem` the problem, from entries; `condensed` the elimination of the unknowns without bounds
//! by one sparse factorisation, and the runs of [`crate::solver`] on what is left.
#![allow(clippy::float_arithmetic)]

mod condensed;
mod problem;

pub use condensed::{CondensedMcp, SparseError};
pub use problem::SparseLinearMcp;
