//! What people and programs read: `mceip-solutions/1` and plain tables.

mod listed;
mod solutions;
mod table;

pub use listed::{Listed, ListedCone};
pub use solutions::{Claimed, Report, solutions_json, solutions_text};
pub use table::Table;
