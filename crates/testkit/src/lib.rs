//! Generators, comparison of engines, forgeries, the verification run, and the bodies of fuzz
//! targets.
//!
//! ```text
//! families, generators, known, pareto, large     problems, and what is known of their answers
//!         |
//!         v
//! compare (interior, completed, forge)           one problem through every engine
//!         |
//!         +-> verify (block)                     fixed families, one row each: `mceip verify`
//!         +-> campaign                           named families for days: `mceip campaign`
//!         +-> targets                            bodies of the fuzz targets in `fuzz/`
//!
//! conform                                        the pack for other programs: `mceip conform`
//! floors                                         how often the solver has to find what exists
//! verified                                       the checker of `proofs/`, as a process
//! ```
//!
//! Everything is compared with the plain enumerator of `mceip-oracle`; a difference is a
//! [`Disagreement`], and each one is a bug.

#[macro_use]
mod worded;

mod asked;
mod block;
pub mod campaign;
mod compare;
mod completed;
pub mod conform;
mod disagreement;
mod error;
mod families;
pub mod floors;
mod forge;
pub mod generators;
mod interior;
pub mod known;
mod large;
pub mod pareto;
mod tally;
pub mod targets;
pub mod verified;
mod verify;

pub use asked::{at_friction, at_lambda2, enumerated, solutions_of};
pub use block::{AcceptedState, BLOCK_STARTS, BlockReport, block_state};
pub use compare::{
    InstanceReport, Reached, SearchFunction, Treatment, compare, compare_by, coverage_of,
    in_doubles,
};
pub use completed::{compare_complete, holds_claim, is_claimed};
pub use disagreement::Disagreement;
pub use error::TestkitError;
pub use families::{
    Corner, Instance, degenerate, eigenvalue_problems, mechanical, random_pencils, system_of,
    table1_grid,
};
pub use forge::{Forgery, forgeries};
pub use interior::{
    INTERIOR_STARTS, InteriorStart, from_interior, interior_starts, path_coverage, path_options,
};
pub use large::{backslash_block, condensed_in_doubles, mechanical_pencil, refined_block};
pub use tally::Tally;
pub use verify::{FamilyReport, Verification, verify, verify_family};
