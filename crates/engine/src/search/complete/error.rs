//! Why there is no certificate: the problem is outside the hypotheses of the search, a certificate
//! does not belong to it, or parts do not fit together.

use mceip_check::Rejected;
use mceip_check::certificate::Certificate;
use mceip_model::{ModelError, Problem};

/// Why there is no certificate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompleteError {
    /// The problem was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// No complementarity variables.
    #[error("complete: expected at least one slip variable, got none")]
    NothingSlips,
    /// The free variables cannot be eliminated.
    #[error(
        "P1, P2: expected the symmetric part of {what} to be definite (of B_ff: semidefinite), got the \
         contrary at variable {index}"
    )]
    NotDefinite {
        /// Which block.
        what: &'static str,
        /// A free variable of it.
        index: usize,
    },
    /// The free variables can be eliminated in doubles and not provably so.
    #[error(
        "condensation: expected {expected}, for a bound from doubles, got row {row} of the free \
         block that breaks it: rounding hides whether the block is definite, as with units that \
         differ very much; `enumerate` and `solve` do not need that bound"
    )]
    Hypothesis {
        /// What the checker demands.
        expected: &'static str,
        /// Row of the free block.
        row: usize,
    },
    /// More complementarity variables than a cover may have.
    #[error("complete: expected at most {limit} complementarity variables, got {got}")]
    TooManySlip {
        /// The checker's limit.
        limit: usize,
        /// Variables of the problem.
        got: usize,
    },
    /// A certificate to go on with has free variables eliminated, and nothing to search with.
    #[error(
        "certificate: expected a condensation with at least one anchor to go on with, got none"
    )]
    NoAnchor,
    /// A certificate was made for other matrices.
    #[error("certificate: expected problem {expected}, got {got:?}")]
    OtherProblem {
        /// Digest of the problem at hand.
        expected: String,
        /// Digest the certificate names.
        got: String,
    },
    /// A certificate was made for another window.
    #[error("certificate: expected the window {expected}, got {got}")]
    OtherWindow {
        /// The problem's.
        expected: String,
        /// The certificate's.
        got: String,
    },
    /// A certificate claims no complete set.
    #[error("certificate: expected a complete set, got none")]
    NoCompleteSet,
    /// A part was cut into other pieces.
    #[error("merge: expected part {part} to have the pieces and the condensation of part 0")]
    OtherPieces {
        /// The part, from 0.
        part: usize,
    },
    /// A piece that no part has searched.
    #[error(
        "merge: expected every piece to be searched by a part, got none for piece {piece} of \
         {pieces}"
    )]
    MissingPiece {
        /// The piece, from 0.
        piece: usize,
        /// Pieces in all.
        pieces: usize,
    },
    /// Nothing to merge.
    #[error("merge: expected at least one part")]
    NoParts,
    /// K_ff + lambda^2 M_ff cannot be eliminated in doubles.
    #[error(
        "E16: expected K_ff + lambda^2 M_ff invertible in doubles, got a singular matrix at \
         lambda^2 = {lambda2}"
    )]
    SingularLevel {
        /// The level.
        lambda2: f64,
    },
    /// The checker refused a certificate: the one to go on with, or a defect of this program.
    #[error("the checker rejects the certificate: {0}")]
    Rejected(#[from] Rejected),
}

/// The certificate is for this problem and window.
pub(super) fn same_problem(
    problem: &Problem,
    certificate: &Certificate,
) -> Result<(), CompleteError> {
    let expected = problem.sha256();
    if certificate.problem_sha256 != expected {
        return Err(CompleteError::OtherProblem {
            expected,
            got: certificate.problem_sha256.clone(),
        });
    }

    if certificate.window != *problem.window() {
        return Err(CompleteError::OtherWindow {
            expected: problem.window().to_string(),
            got: certificate.window.to_string(),
        });
    }

    Ok(())
}
