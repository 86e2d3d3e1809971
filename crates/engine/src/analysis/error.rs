//! Why a system is not analysed, and the check that doubles can carry its numbers.

use super::model::MAX_SAMPLES;
use crate::magnitude::{decimal_order, has_square_in_doubles};
use crate::search::complete::CompleteError;
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_model::{ModelError, System};
use num_traits::Signed;

/// Why a system is not analysed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The system was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The complete search refuses.
    #[error(transparent)]
    Complete(#[from] CompleteError),
    /// A pencil has no mu.
    #[error(
        "analyze: expected a mechanical system (stiffness, mass, friction, particles), got a pencil"
    )]
    NotASystem,
    /// Divergence needs inertia.
    #[error(
        "E3: expected mass, got none (analyze needs K, M and mu): add \"mass\" beside \
         \"stiffness\" (`mceip convert --mass FILE`); the mu of lambda = 0 alone needs no mass (`mceip complete` \
         with \"unknown\": \"mu\", `mceip path --complete`)"
    )]
    NoMass,
    /// Divergence is asked for at a mu.
    #[error("E2: expected friction in the file or by --friction, got none")]
    NoFriction,
    /// A coefficient of friction below zero.
    #[error("analyze: expected friction >= 0, got {0}")]
    FrictionNegative(Rational),
    /// More samples than any plot has use for.
    #[error("samples: expected at most {MAX_SAMPLES}, got {0}")]
    TooManySamples(usize),
    /// The system cannot be condensed in doubles.
    #[error("condensation in doubles: {0}")]
    NotCondensed(String),
    /// Units that doubles cannot carry.
    #[error(
        "{what}[{row}][{col}]: expected a magnitude between 10^-150 and 10^150 (choose other \
         units), got about 10^{exponent}"
    )]
    Units {
        /// The matrix.
        what: &'static str,
        /// Row of the entry.
        row: usize,
        /// Its column.
        col: usize,
        /// Its decimal order of magnitude.
        exponent: i64,
    },
}

/// Refuses what no question of divergence can be put to.
pub(super) fn require_question(system: &System, friction: &Rational) -> Result<(), AnalysisError> {
    if system.mass().is_none() {
        return Err(AnalysisError::NoMass);
    }
    if friction.is_negative() {
        return Err(AnalysisError::FrictionNegative(friction.clone()));
    }

    Ok(())
}

/// Refuses entries whose squares leave the doubles: the searches propose in doubles.
pub(super) fn require_doubles(system: &System) -> Result<(), AnalysisError> {
    require_doubles_in("K", system.stiffness())?;
    match system.mass() {
        Some(mass) => require_doubles_in("M", mass),
        None => Ok(()),
    }
}

fn require_doubles_in(what: &'static str, matrix: &Sparse) -> Result<(), AnalysisError> {
    for (row, col, v) in matrix.entries() {
        if !has_square_in_doubles(to_f64(v)) {
            return Err(AnalysisError::Units {
                what,
                row,
                col,
                exponent: decimal_order(v),
            });
        }
    }

    Ok(())
}
