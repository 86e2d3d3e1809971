//! From the mechanical system to the pencil (10)-(16), the lift back, and the lines of (9).
//!
//! `eliminate` goes from (v, w) to (x, y), `lift` goes back from x to (v, w), and `lines` checks
//! that what comes back satisfies (9).
#![deny(clippy::float_arithmetic)]

mod eliminate;
mod lift;
mod lines;

pub use eliminate::{mu_family, radii_family, reduce, reduce_system, variables, zero_variables};
pub use lift::{Lifted, lift};
pub use lines::{Line, LineViolated, check_lines};
