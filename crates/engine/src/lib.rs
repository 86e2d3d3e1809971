//! Complementarity eigenproblems solved: floats propose, exact arithmetic decides.
//!
//! ```text
//! problem -> reduction -> multistart -> candidates -> certify -> accepted claims
//!                     `-> search -> a complete set, or what is left open
//! ```
//!
//! Nothing in this crate is trusted. Every claim and every complete set is handed to `mceip_check`,
//! which decides in exact arithmetic; what it does not accept is reported as uncertified, open or
//! undecided.
//!
//! | module | what |
//! |---|---|
//! | [`reduction`] | Propositions 1 and 2, condensations, projection |
//! | [`multistart`] | the solver from many starts and along curves: candidates |
//! | [`certify`] | from a candidate to a claim that the checker has accepted |
//! | [`search`] | complete sets: branch and prune, with a certificate |
//! | [`analysis`] | the engineer's answer: divergence, flutter, ranges of friction |
//! | [`equilibrium`] | contact states that loads lead to, certified |
//! | [`foreign`] | somebody's solutions, judged |
//! | [`report`] | `mceip-solutions/1`, and tables |
//! | [`lcp`] | plain LCP and MCP files |
//! | [`lean`] | certificates without the matrices that are made anew |
//! | [`candidate`], [`tolerance`] | a claimed solution in doubles; every tolerance |
//! | [`run`] | cancelling a long run, and its progress |

pub mod analysis;
mod bordered;
mod branch;
pub mod candidate;
pub mod certify;
mod dense;
pub mod equilibrium;
pub mod foreign;
pub mod lcp;
pub mod lean;
mod magnitude;
pub mod multistart;
pub mod reduction;
pub mod report;
pub mod run;
pub mod search;
pub mod signs;
pub mod tolerance;
