//! What people and programs read: `mceip-solutions/1` and plain tables.
//!
//! `counted` makes nouns agree with their count, `digits` writes measured numbers, `listed` turns a
//! solution into decimals, `solutions` writes a list of solutions with what stands behind it,
//! `table` aligns columns.

mod counted;
mod digits;
mod listed;
mod solutions;
mod table;

pub use counted::counted;
pub use digits::{fixed_decimals, six_digits};
pub(crate) use digits::{short, short_is_plain};
pub use listed::{Listed, ListedCone};
pub(crate) use listed::{negated, row_times};
pub use solutions::{Claimed, Report, solutions_json, solutions_text};
pub(crate) use solutions::{coefficients, region_json};
pub use table::Table;
