//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod condense;
mod eliminate;
#[cfg(feature = "solver")]
mod embed;
mod lift;
mod lines;

#[cfg(feature = "solver")]
pub use condense::Expansion;
pub use condense::{CondensationError, condense};
pub use eliminate::{Reduced, Variable, reduce};
#[cfg(feature = "solver")]
pub use embed::{Embedding, Side};
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
