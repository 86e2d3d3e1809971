//! Why a system or a pencil is not condensed: equation, index, expected, got.

use mceip_exact::CondenseError;
use mceip_mcp::linear::{PivotNotPositive, SymmetricError};
use mceip_model::ModelError;

/// Why a system or a pencil is not condensed to its slip variables.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CondensationError {
    /// Only MCEIP-mu has f rows that do not depend on the unknown.
    #[error("E16: expected unknown mu for condensation, got {got}")]
    Unknown {
        /// The unknown.
        got: &'static str,
    },
    /// The exact elimination failed.
    #[error(transparent)]
    Elimination(#[from] CondenseError),
    /// The condensed pencil is refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// MCEIP-lambda2 of a system without mass.
    #[error(
        "E12: expected a mass matrix for unknown lambda2, got none: add \"mass\" beside \
         \"stiffness\" (`mceip convert --mass FILE`)"
    )]
    NoMass,
    /// A friction that is negative, infinite or NaN.
    #[error("E15: expected a finite friction mu >= 0, got {got}")]
    Friction {
        /// mu.
        got: f64,
    },
    /// M of another order than K.
    #[error("E3: expected M of order {expected}, got {got}")]
    Mass {
        /// Order of K.
        expected: usize,
        /// Order of M.
        got: usize,
    },
    /// A dof that the matrix does not have.
    #[error("E9: expected dofs of particle {particle} < {dofs}, got {got}")]
    Dof {
        /// Index of the particle.
        particle: usize,
        /// The dof.
        got: usize,
        /// Order of K.
        dofs: usize,
    },
    /// A dof that two particles, or one of them twice, claim.
    #[error("E9: expected each dof in one particle, got {dof} again in particle {particle}")]
    DofTwice {
        /// Index of the second particle.
        particle: usize,
        /// The dof.
        dof: usize,
    },
    /// A sign that is not 1 or -1.
    #[error("E7: expected the sign of particle {particle} to be 1 or -1, got {got}")]
    Sign {
        /// Index of the particle.
        particle: usize,
        /// Its sign.
        got: i8,
    },
    /// A particle in contact with zero reaction, which the condensation does not treat.
    #[error("E9: particle {particle} has state \"zero\", which is not supported here")]
    ZeroReaction {
        /// Index of the particle.
        particle: usize,
    },
    /// A matrix that doubles cannot hold, or that is not symmetric.
    #[error(transparent)]
    Symmetric(#[from] SymmetricError),
    /// Nothing slips.
    #[error("E10: expected at least one particle in impending slip, got none")]
    NoSlip,
    /// K + t M is not positive definite on f.
    #[error("P1: (K + t M)_ff at t = {at}: {source}")]
    NotDefinite {
        /// The value of t.
        at: f64,
        /// Where elimination ended.
        source: PivotNotPositive,
    },
}
