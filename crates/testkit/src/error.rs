//! Why the test kit refuses a file or cannot do a run.
//!
//! What a run finds wrong with an engine is no error but a [`Disagreement`](crate::Disagreement).
//! Printed by `mceip verify`, `campaign` and `conform`.

use mceip_engine::multistart::SearchError;
use mceip_engine::reduction::CondensationError;
use mceip_engine::search::complete::CompleteError;
use mceip_exact::NumberError;
use mceip_model::ModelError;
use mceip_oracle::OracleError;
use mceip_paper::SourceError;

/// A file that is refused, or a run that cannot take place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TestkitError {
    /// A model or a file was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A mesh or the states of a block were refused.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The search was refused.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// The complete search was refused.
    #[error(transparent)]
    Complete(#[from] CompleteError),
    /// The block was not condensed.
    #[error(transparent)]
    Condensation(#[from] CondensationError),
    /// Data of Table 1 in a replay file.
    #[error("closed_form: {0}")]
    ClosedForm(#[from] NumberError),
    /// The state of a campaign with other settings.
    #[error("expected the state of a campaign with {what} {expected}, got {got}")]
    OtherCampaign {
        /// Which setting.
        what: &'static str,
        /// This campaign's.
        expected: String,
        /// The file's.
        got: String,
    },
    /// The state of a campaign that says something else than what was written.
    #[error(
        "sha256: expected {expected}, got {got}: the state was edited or cut short; without the \
         file the campaign begins anew"
    )]
    StateDigest {
        /// Digest of what the file says.
        expected: String,
        /// Digest in the file.
        got: String,
    },
    /// The state of a campaign whose counts do not fit together.
    #[error("{what}: expected {expected}, got {got}; without the file the campaign begins anew")]
    StateCount {
        /// Which count.
        what: String,
        /// What it must be.
        expected: String,
        /// What the file says.
        got: u64,
    },
    /// A family of instances that does not exist, or one named twice.
    #[error("expected a family of {families}, each once, got {name:?}")]
    Family {
        /// The names of all families.
        families: String,
        /// The name given.
        name: String,
    },
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
    /// The answer in the pack is not the one that is found.
    #[error("{case}: the answer in the pack is not the exact one")]
    Answer {
        /// The case.
        case: String,
    },
    /// A case whose answer should be proved to be complete, and is not.
    #[error(
        "{case}: expected a complete set of single solutions, got {open} open regions and \
         {families} families"
    )]
    NotProved {
        /// The case.
        case: String,
        /// Regions left open.
        open: usize,
        /// Cones and continua.
        families: usize,
    },
    /// A best known list without a solution.
    #[error("{case}: expected a best known solution or a proof that there is none, got neither")]
    NothingKnown {
        /// The case.
        case: String,
    },
    /// A word that a case may not have there.
    #[error("{case}: expected {what}, got {got:?}")]
    Word {
        /// The case.
        case: String,
        /// What it may be.
        what: &'static str,
        /// The word.
        got: String,
    },
    /// A run that cannot be compared with the others.
    #[error("{run}: expected {expected}, got {got}")]
    OtherRun {
        /// The run.
        run: String,
        /// What it must be.
        expected: String,
        /// What it is.
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
    /// The command does not start.
    #[error("cannot start {command:?}: {reason}")]
    Start {
        /// The program.
        command: String,
        /// The system's reason.
        reason: std::io::ErrorKind,
    },
    /// No verified checker at this path.
    #[error(
        "no verified checker at {path}: `make -C proofs program` builds proofs/mceip-verified \
         (OCaml, zarith and python3 are needed, Coq is not); another place is named by \
         --verified PATH or MCEIP_VERIFIED"
    )]
    NoVerifiedChecker {
        /// Where it was expected.
        path: String,
    },
    /// No scratch file could be written.
    #[error("cannot write a scratch file: {reason}")]
    Scratch {
        /// The system's reason.
        reason: std::io::ErrorKind,
    },
}

impl TestkitError {
    /// A scratch file that was not written.
    pub(crate) fn scratch(e: &std::io::Error) -> TestkitError {
        TestkitError::Scratch { reason: e.kind() }
    }

    /// A problem that is refused, and the file or case that it is in.
    pub(crate) fn problem(place: &str, source: ModelError) -> TestkitError {
        TestkitError::Problem {
            place: place.to_string(),
            source,
        }
    }
}
