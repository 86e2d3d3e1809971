//! Why a search for solutions did not take place.

use crate::reduction::CondensationError;
use mceip_mcp::solver::SolverError;
use mceip_model::ModelError;

/// Why a search did not take place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The solver's options were refused.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The condensation failed.
    #[error(transparent)]
    Condensation(#[from] CondensationError),
    /// The condensed pencil was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// More variables than dense matrices are made for.
    #[error("solve: expected at most {limit} variables after condensation, got {got}")]
    TooLarge {
        /// The limit.
        limit: usize,
        /// Variables of the problem.
        got: usize,
    },
    /// K_ff is singular in doubles.
    #[error("P1: expected K_ff regular in doubles, got a singular factorisation")]
    SingularInDoubles,
}
