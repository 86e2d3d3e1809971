//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

#[cfg(feature = "solver")]
mod circle;
mod condense;
#[cfg(feature = "solver")]
mod condense_sparse;
#[cfg(feature = "solver")]
mod condensed_mcp;
#[cfg(feature = "solver")]
mod embed;
#[cfg(feature = "solver")]
mod expand;
mod project;
mod reversed;

#[cfg(feature = "solver")]
pub use circle::CirclePencil;
pub use condense::{CondensationError, condense};
#[cfg(feature = "solver")]
pub use condense_sparse::{CondensationResidual, SparseCondensation, SparseCondensationError, SparseCondensed};
#[cfg(feature = "solver")]
pub use condensed_mcp::{CondensedEmbedding, CondensedEmbeddingError};
#[cfg(feature = "solver")]
pub use embed::{Embedding, Side};
#[cfg(feature = "solver")]
pub use expand::Expansion;
pub use mceip_model::reduction::{Lifted, Line, LineViolated, MuFamily, Reduced, Variable, check_lines, lift, mu_family, reduce};
pub use project::{Projected, project};
pub use reversed::reversed;
