//! The exact side: the enumerator, Table 1, exact arithmetic and the way back from the pencil.
//!
//! Each file says which truth it compares with: algebra, closed forms, hand-worked pencils, laws of
//! the problem, or the independent enumeration in `third`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[allow(dead_code, unreachable_pub, missing_docs)]
mod third;

mod algebra;
mod counterexamples;
mod curved;
mod known_answers;
mod members;
mod oracle_degenerate;
mod oracle_edges;
mod oracle_report;
mod physical;
mod problem_files;
mod properties;
mod small;
mod stability;
mod stable;
mod table1;
mod third_opinion;
mod way_back;
mod zero_reaction;
