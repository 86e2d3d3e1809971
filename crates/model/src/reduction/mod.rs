//! From the mechanical system to the pencil (10)-(16), the lift back, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod eliminate;
mod lift;
mod lines;

pub use eliminate::{MuFamily, Reduced, Variable, mu_family, reduce};
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
