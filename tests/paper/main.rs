//! The polyurethane block of the paper: its states, its loading path, its observations over meshes,
//! and finer meshes.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(all(feature = "cli", unix))]
#[path = "../support/interrupt.rs"]
mod interrupt;

mod block;
mod block_observations;
mod elimination;
mod equilibria;
mod loads;
mod paper_path;
mod path;
mod path_found;
mod path_states;
mod rounded;
mod scale;
mod slow_loads;
