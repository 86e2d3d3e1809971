//! Complementarity eigenproblems solved: floats propose, exact arithmetic decides.
//!
//! | module | what |
//! |---|---|
//! | [`reduction`] | Propositions 1 and 2, condensations, projection |
//! | [`multistart`] | the solver from many starts and along curves: candidates |
//! | [`certify`] | from a candidate to a claim that the checker has accepted |
//! | [`search`] | complete sets: branch and prune, with a certificate |
//! | [`analysis`] | the engineer's answer: divergence, flutter, ranges of friction |
//! | [`foreign`] | somebody's solutions, judged |
//! | [`report`] | `mceip-solutions/1`, and tables |
//! | [`lcp`] | plain LCP and MCP files |
//! | [`candidate`], [`tolerance`] | a claimed solution in doubles; every tolerance |
//!
//! The crates beneath are re-exported under the names of their rooms.

pub use mceip_check as check;
pub use mceip_check::certificate;
pub use mceip_exact as exact;
pub use mceip_mcp::{linear, mcp, solver, sparse};
pub use mceip_model as model;
pub use mceip_oracle as oracle;

pub mod analysis;
pub mod candidate;
pub mod certify;
pub mod foreign;
pub mod lcp;
pub mod multistart;
pub mod reduction;
pub mod report;
pub mod run;
pub mod search;
pub mod tolerance;
