//! The program from outside: its commands, exit codes, text, files and pictures.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[cfg(feature = "cli")]
#[path = "../support/corpus.rs"]
mod corpus_reader;
#[cfg(all(feature = "cli", unix))]
#[path = "../support/interrupt.rs"]
mod interrupt;
#[cfg(feature = "cli")]
#[path = "../support/json_places.rs"]
mod json_places;
#[cfg(feature = "cli")]
#[path = "../support/program.rs"]
mod program;

mod absence_cli;
mod analyze;
mod block;
mod block_friction;
mod campaign_cli;
mod check_foreign;
mod check_window;
mod cli;
mod cli_enumerate;
mod common;
mod complete_cli;
mod conform;
mod conform_adapter;
mod conform_tier2;
mod convert;
mod examples;
mod fold;
mod lasting;
mod launcher;
mod limits;
mod manual;
mod names;
mod path;
mod pictures;
mod plausibility;
mod presence;
mod rivals;
mod schemas;
mod simulate;
mod slurm;
mod solver_plain;
mod tutorial;
