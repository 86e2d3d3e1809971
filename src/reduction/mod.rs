//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

#[cfg(feature = "solver")]
mod circle;
mod condense;
#[cfg(feature = "solver")]
mod condense_sparse;
#[cfg(feature = "solver")]
mod condensed_mcp;
mod eliminate;
#[cfg(feature = "solver")]
mod embed;
#[cfg(feature = "solver")]
mod expand;
mod lift;
mod lines;
mod project;
mod reversed;

#[cfg(feature = "solver")]
pub use circle::CirclePencil;
pub use condense::{CondensationError, condense};
#[cfg(feature = "solver")]
pub use condense_sparse::{CondensationResidual, SparseCondensation, SparseCondensationError, SparseCondensed};
#[cfg(feature = "solver")]
pub use condensed_mcp::{CondensedEmbedding, CondensedEmbeddingError};
pub use eliminate::{MuFamily, Reduced, Variable, mu_family, reduce};
#[cfg(feature = "solver")]
pub use embed::{Embedding, Side};
#[cfg(feature = "solver")]
pub use expand::Expansion;
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
pub use project::{Projected, project};
pub use reversed::reversed;
