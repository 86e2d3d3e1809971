//! From the mechanical system to the pencil, from the pencil to an MCP in doubles, and back.
//!
//! The exact reduction (10)-(16), the lift and the lines of (9) stand in the crate `mceip-model`.
//! This folder adds what the engine needs besides:
//!
//! | file | what |
//! |---|---|
//! | `condense` | elimination of the free variables of MCEIP-mu, exactly |
//! | `expand` | the eliminated variables of a candidate, and v of x, in doubles |
//! | `condense_sparse` | the same for both problems in doubles, on meshes of any size |
//! | `embed` | Propositions 1 and 2: the pencil as an MCP |
//! | `condensed_mcp` | Proposition 2 on the condensed matrix |
//! | `circle` | the pencil on alpha^2 + beta^2 = 1, for curves that close |
//! | `project` | from v over all degrees of freedom to x |
//! | `reversed` | the pencil of s = 1 / t, for solutions at infinity |
#![deny(clippy::float_arithmetic)]

mod circle;
mod condense;
mod condense_sparse;
mod condensed_mcp;
mod embed;
mod error;
mod expand;
mod project;
mod reversed;

pub use circle::CirclePencil;
pub use condense::condense;
pub use condense_sparse::{CondensationResidual, SparseCondensation, SparseCondensed};
pub use condensed_mcp::CondensedEmbedding;
pub use embed::{Embedding, Side};
pub use error::CondensationError;
pub(crate) use expand::with_free_variables;
pub use expand::{FreeExpansion, mode};
pub use project::{Projected, project};
pub use reversed::reversed;

use mceip_model::reduction::zero_variables;
use mceip_model::{Body, Problem, ZeroVariables};

/// The variables of the particles in contact with zero reaction, of which a pencil has none.
pub(crate) fn zero_of(problem: &Problem) -> Vec<ZeroVariables> {
    match problem.body() {
        Body::System(system) => zero_variables(system),
        Body::Pencil(_) | Body::Quadratic(_) => Vec::new(),
    }
}
