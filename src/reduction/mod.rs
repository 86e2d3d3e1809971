//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod condense;
mod eliminate;
#[cfg(feature = "solver")]
mod embed;
#[cfg(feature = "solver")]
mod expand;
mod lift;
mod lines;

pub use condense::{CondensationError, condense};
pub use eliminate::{MuFamily, Reduced, Variable, mu_family, reduce};
#[cfg(feature = "solver")]
pub use embed::{Embedding, Side};
#[cfg(feature = "solver")]
pub use expand::Expansion;
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
