//! From the mechanical system to the pencil, and back: (10)-(16), the lift, and the lines of (9).
#![deny(clippy::float_arithmetic)]

mod eliminate;
mod lift;
mod lines;

pub use eliminate::{Reduced, Variable, reduce};
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
