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
    /// The pencil is outside the propositions, or the condensed one is refused.
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
    /// Numbers that doubles cannot carry, in any scale.
    #[error(
        "{place}: expected a number within the range of doubles, in which solutions are looked \
         for, got one of about 10^{exponent}; choose units in which K, M and lambda^2 are nearer \
         to 1, or decide it exactly: mceip enumerate"
    )]
    BeyondDoubles {
        /// The entry of A or B, or the window.
        place: String,
        /// Its decimal order of magnitude.
        exponent: i64,
    },
    /// K_ff is singular in doubles.
    #[error("P1: expected K_ff regular in doubles, got a singular factorisation")]
    SingularInDoubles,
}
