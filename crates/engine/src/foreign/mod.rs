//! Solutions found elsewhere: reading somebody's `mceip-solutions/1`, and a verdict on each
//! solution.
//!
//! A foreign report needs `value` and `x`, or for a mechanical system `value` and `v` over its
//! degrees of freedom; 7 to 17 digits, any positive scale. [`judge`] proves that such a solution
//! exists and says how well the report agrees with it, or proves that none is near, or says that it
//! is undecided.

mod agreement;
mod report;
mod verdict;

pub use agreement::{Agreement, Component};
pub use report::{
    BadPoint, ForeignContinuum, ForeignEnd, ForeignError, ForeignInterval, ForeignReport, Off,
    Reported,
};
pub use verdict::{Effort, Proved, REFUTE_SLIP, Refutation, Verdict, judge};
