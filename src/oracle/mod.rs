//! The slow truth: the enumerator of (24)-(26) and Table 1 in closed form. Exact, naive on purpose.
#![deny(clippy::float_arithmetic)]

mod plain;
mod solution;
mod table1;

pub use plain::{MAX_FREE, MAX_SLIP, OracleError, enumerate, enumerate_with, examine_support};
pub use solution::{Enumeration, Solution, WideKernel};
pub use table1::{ClosedSolution, TwoParticles, table1, thresholds};
