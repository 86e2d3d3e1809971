//! Why a block is not condensed in doubles.

use mceip_engine::multistart::SearchError;
use mceip_engine::reduction::CondensationError;
use mceip_mcp::linear::SymmetricError;
use mceip_paper::SourceError;

/// Why a block is not condensed in doubles.
#[derive(Debug, thiserror::Error)]
pub(in crate::cli) enum ScaleError {
    #[error(transparent)]
    Source(#[from] SourceError),
    #[error("{what} in doubles: {source}")]
    Matrix {
        what: &'static str,
        source: SymmetricError,
    },
    #[error(transparent)]
    Condensation(#[from] CondensationError),
    #[error(transparent)]
    Search(#[from] SearchError),
}
