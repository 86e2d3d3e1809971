//! From the mechanical system to the pencil (10)-(16), the lift back, and the lines of (9).
//!
//! `eliminate` goes from (v, w) to (x, y), `split` does so with particles in contact with zero
//! reaction, `lift` goes back from x to (v, w), and `lines` checks that what comes back satisfies
//! (9).
#![deny(clippy::float_arithmetic)]

mod eliminate;
mod lift;
mod lines;
mod split;

pub use eliminate::{MuFamily, Reduced, Variable, ZeroPart, mu_family, reduce};
pub use lift::{Lifted, lift, lift_along};
pub use lines::{Line, LineViolated, check_lines};
pub use split::{mu_family_with_zero, reduce_with_zero, split_form, zero_variables};
