//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod condense;
#[cfg(feature = "solver")]
mod condense_sparse;
mod eliminate;
#[cfg(feature = "solver")]
mod embed;
#[cfg(feature = "solver")]
mod expand;
mod lift;
mod lines;

pub use condense::{CondensationError, condense};
#[cfg(feature = "solver")]
pub use condense_sparse::{CondensationResidual, SparseCondensation, SparseCondensationError, SparseCondensed};
pub use eliminate::{Reduced, Variable, reduce};
#[cfg(feature = "solver")]
pub use embed::{Embedding, Side};
#[cfg(feature = "solver")]
pub use expand::Expansion;
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
