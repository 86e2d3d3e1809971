//! Why a conformance run or a pack is refused.
//!
//! Each reason is a variant that names the case, the file or the command. Returned by the functions
//! of this folder and printed by `mceip conform`.

use mceip_model::ModelError;
use mceip_oracle::OracleError;

/// A pack that cannot be used, a command that cannot be started.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConformError {
    /// A problem of the pack, or a file of it.
    #[error("{place}: {source}")]
    Problem {
        /// File or case.
        place: String,
        /// What is wrong.
        source: ModelError,
    },
    /// Larger than the plain enumerator takes.
    #[error("{case}: {source}")]
    Oracle {
        /// The case.
        case: String,
        /// The limit.
        source: OracleError,
    },
    /// The answer in the pack is not the one the plain enumerator finds.
    #[error("{case}: the answer in the pack is not the exact one")]
    Answer {
        /// The case.
        case: String,
    },
    /// A word that is no flag.
    #[error("{case}: expected a flag of spec/conform.md, got {got:?}")]
    Flag {
        /// The case.
        case: String,
        /// The word.
        got: String,
    },
    /// A file of the pack differs from its digest.
    #[error("{file}: expected sha256 {expected}, got {got}")]
    Digest {
        /// The file.
        file: String,
        /// Digest in the index.
        expected: String,
        /// Digest of the file.
        got: String,
    },
    /// A problem of the program's own pack was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A mesh of the block was refused.
    #[error(transparent)]
    Source(#[from] mceip_paper::SourceError),
    /// The block was not condensed.
    #[error(transparent)]
    Condensation(#[from] mceip_engine::reduction::CondensationError),
    /// The command does not start.
    #[error("cannot start {command:?}: {reason}")]
    Start {
        /// The program.
        command: String,
        /// The system's reason.
        reason: std::io::ErrorKind,
    },
    /// No thread pool.
    #[error("cannot start {threads} threads")]
    Threads {
        /// How many.
        threads: usize,
    },
}

impl ConformError {
    /// A problem that is refused, and the file or case that it is in.
    pub(super) fn problem(place: &str, source: ModelError) -> ConformError {
        ConformError::Problem {
            place: place.to_string(),
            source,
        }
    }
}
