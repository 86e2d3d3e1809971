//! What people and programs read: `mceip-solutions/1` and plain tables.
//!
//! `listed` turns a solution into decimals, `solutions` writes a list of solutions with what stands
//! behind it, `table` aligns columns.

mod listed;
mod solutions;
mod table;

pub use listed::{Listed, ListedCone};
pub use solutions::{Claimed, Report, solutions_json, solutions_text};
pub use table::Table;
