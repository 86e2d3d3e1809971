//! Generators, comparison of engines, forgeries, the verification run, and the bodies of fuzz
//! targets.

use mceip_engine::{
    candidate, certificate, certify, check, exact, foreign, model, multistart, oracle, reduction,
    report, run, search, solver, tolerance,
};
use mceip_paper as source;

mod block;
pub mod campaign;
mod compare;
mod completed;
pub mod conform;
mod disagreement;
mod families;
pub mod floors;
mod forge;
pub mod generators;
mod interior;
pub mod known;
mod large;
mod mutate;
pub mod pareto;
pub mod targets;
mod verify;

pub use block::{AcceptedState, BLOCK_STARTS, BlockError, BlockReport, block_state};
pub use compare::{InstanceReport, Reached, Solver, Treatment, compare, compare_by, coverage_of};
pub use completed::compare_complete;
pub use disagreement::Disagreement;
pub use families::{Corner, Instance, degenerate, mechanical, random_pencils, table1_grid};
pub use forge::{Forgery, forgeries};
pub use interior::{
    INTERIOR_STARTS, InteriorStart, from_interior, interior_starts, path_coverage, path_options,
};
pub use large::{
    LargeError, backslash_block, condensed_in_doubles, mechanical_pencil, refined_block,
};
pub use mutate::mutate;
pub use verify::{FamilyReport, Verification, verify, verify_family};
