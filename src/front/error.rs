//! What can go wrong when the library is used.

use mceip_check::Rejected;
use mceip_model::ModelError;

/// Why there is no answer. Each message is one line that says what was expected and what was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file, a matrix or a system that is no problem of the paper.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// An entry lies outside its matrix.
    #[error("matrix: expected entries within {rows} x {columns}, got one at ({row}, {column})")]
    Outside {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// The rows of a matrix differ in length.
    #[error("matrix: expected {expected} numbers in row {row}, got {got}")]
    Ragged {
        /// The row.
        row: usize,
        /// Numbers in the first row.
        expected: usize,
        /// Numbers in this one.
        got: usize,
    },
    /// The checker refuses a certificate.
    #[error(transparent)]
    Rejected(Box<Rejected>),
    /// The solver refuses the problem.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Solve(#[from] mceip_engine::multistart::SearchError),
    /// The enumerator refuses the problem.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Enumerate(#[from] mceip_oracle::OracleError),
    /// The complete search refuses the problem.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Complete(#[from] mceip_engine::search::complete::CompleteError),
    /// The analysis refuses the system.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Analyze(#[from] mceip_engine::analysis::AnalysisError),
    /// No certificate was found for a point.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    NotCertified(#[from] mceip_engine::certify::NotCertified),
    /// What a lean certificate leaves out cannot be made anew.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Lean(#[from] mceip_engine::lean::LeanError),
    /// The loading path cannot be followed.
    #[cfg(feature = "solver")]
    #[error(transparent)]
    Path(#[from] mceip_path::PathError),
    /// Only a mechanical system can be analysed.
    #[cfg(feature = "solver")]
    #[error("analyze: expected a mechanical system, got a pencil")]
    NotASystem,
    /// The analysis needs a friction coefficient.
    #[cfg(feature = "solver")]
    #[error("expected a friction coefficient, in the file or as an option, got none")]
    NoFriction,
}

impl From<Rejected> for Error {
    fn from(rejected: Rejected) -> Error {
        Error::Rejected(Box::new(rejected))
    }
}
