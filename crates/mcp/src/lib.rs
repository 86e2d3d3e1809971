#![doc = include_str!("../README.md")]

pub mod linear;
pub mod mcp;
pub mod solver;
mod tolerance;

/// Matrices of this crate's interface are those of this version of nalgebra.
pub use nalgebra;
