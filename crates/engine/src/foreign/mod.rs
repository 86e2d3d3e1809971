//! Solutions found elsewhere: reading somebody's `mceip-solutions/1`, and a verdict on each
//! solution.
//!
//! A foreign report needs `value` and `x`, or for a mechanical system `value` and `v` over its
//! degrees of freedom; 7 to 17 digits, any positive scale. [`judge`] proves that such a solution
//! exists and says how well the report agrees with it, or proves that none is near, or says that it
//! is undecided.
//!
//! `report` reads the file, `verdict` judges one solution of it, `agreement` says how near a proven
//! solution is, and `refute` proves that none is near. Called by the command `check` and by the
//! conformance runner.

mod agreement;
mod refute;
mod report;
mod singular;
mod verdict;

pub use agreement::{Agreement, Component};
pub use refute::{Effort, REFUTE_SLIP};
pub use report::{
    BadPoint, ForeignContinuum, ForeignEnd, ForeignError, ForeignInterval, ForeignReport, Off,
    Reported,
};
pub use verdict::{Confirmed, Examined, ForeignVerdict, Refutation, judge, negative_component};
