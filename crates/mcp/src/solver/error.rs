//! Why a run does not start: inputs that make no sense, with index, expected and got.
//!
//! A run that has started never fails with an error; it ends with a `Termination`.

use crate::mcp::McpError;

/// Refusal of a problem, a start or an option.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolverError {
    /// The problem's bounds or shapes are inconsistent.
    #[error(transparent)]
    Problem(#[from] McpError),
    /// The start has the wrong length.
    #[error("expected a start of length {expected}, got {got}")]
    StartLength {
        /// Dimension of the problem.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// The start has a NaN or an infinity.
    #[error("expected a finite start at {index}, got {got}")]
    StartNotFinite {
        /// The component.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// A point that must lie within the bounds does not.
    #[error("expected a start within [{lower}, {upper}] at {index}, got {got}")]
    StartOutside {
        /// The component.
        index: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
        /// Its value.
        got: f64,
    },
    /// An option is out of range.
    #[error("expected option {name} {expected}, got {got}")]
    Option {
        /// The option.
        name: &'static str,
        /// What it must be.
        expected: &'static str,
        /// Its value.
        got: f64,
    },
}
