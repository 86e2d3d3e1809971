//! Why the loading of a block is not computed.

use mceip_path::PathError;

/// A loading of the block that cannot be followed or stepped.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BlockPathError {
    /// The path itself.
    #[error(transparent)]
    Path(#[from] PathError),
    /// The pressing does not load the obstacle.
    #[error("pressing: expected a compressive resultant, got none")]
    NoPressure,
    /// Incremental stepping found no states within its iterations.
    #[error(
        "step {step} at motion {motion} mm: no admissible states within {limit} active-set \
         iterations"
    )]
    StepNotConverged {
        /// Number of the step, from 1.
        step: usize,
        /// Where, mm.
        motion: f64,
        /// Iterations allowed.
        limit: usize,
    },
}
