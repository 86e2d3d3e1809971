//! Solutions found elsewhere: reading somebody's `mceip-solutions/1`, and a verdict on each solution.
//!
//! A foreign report needs `value` and `x`, or for a mechanical system `value` and `v` over its degrees
//! of freedom; 6 to 17 digits, any positive scale. [`judge`] proves that such a solution exists, or
//! that none is near, or says that it is undecided.

mod report;
mod verdict;

pub use report::{ForeignContinuum, ForeignEnd, ForeignError, ForeignInterval, ForeignReport, OffConstraints};
pub use verdict::{REFUTE_SLIP, Refutation, Verdict, judge};
