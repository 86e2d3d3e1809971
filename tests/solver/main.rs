//! The solver, the embedding, certification and lifting of what it finds.
//!
//! The files named `solver_*` take the solver alone: answers of the literature, hostile input,
//! paths, curves. The others go on to certificates: what is certified must be accepted by the
//! checker and listed by the exact enumerator.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(feature = "solver")]
#[path = "../families/mod.rs"]
mod families;

mod certify;
mod embedding;
mod lift;
mod lifted;
mod near_threshold;
mod newton_alone;
mod solver_curves;
mod solver_hostile;
mod solver_lemke;
mod solver_mceip;
mod solver_paths;
mod solver_properties;
mod solver_textbook;
mod zero_reaction;

#[cfg(feature = "solver")]
use families::support;
