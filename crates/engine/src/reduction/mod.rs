//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod circle;
mod condense;
mod condense_sparse;
mod condensed_mcp;
mod embed;
mod expand;
mod project;
mod reversed;

pub use circle::CirclePencil;
pub use condense::{CondensationError, condense};
pub use condense_sparse::{
    CondensationResidual, SparseCondensation, SparseCondensationError, SparseCondensed,
};
pub use condensed_mcp::{CondensedEmbedding, CondensedEmbeddingError};
pub use embed::{Embedding, Side};
pub use expand::Expansion;
pub use mceip_model::reduction::{
    Lifted, Line, LineViolated, MuFamily, Reduced, Variable, check_lines, lift, mu_family, reduce,
};
pub use project::{Projected, project};
pub use reversed::reversed;
