//! Where problems come from: the two particles of Fig. 1, the block of section 5 with its meshes
//! and its loading path, and files of finite-element programs.
//!
//! Everything here makes systems, problems or contact states for the other crates; nothing here
//! solves an eigenproblem. Exact parts hold rationals; files that compute in doubles say so and are
//! compared with the exact ones. Chapter 7 of the book (`spec/paper-examples.md`) describes the
//! examples.
//!
//! | to read first | what |
//! |---|---|
//! | [`two_particles()`] | Fig. 1 as a mechanical system |
//! | [`BlockModel`], [`Block`] | the block: its data, and K and M assembled exactly |
//! | [`DoubleBlock`] | the same in doubles, for large meshes |
//! | [`Loading`] | the loading that leads to the contact states of section 5 |
//! | [`PublishedState`] | the two states whose value of mu the paper prints |
//! | [`calculix`], [`read_contacts`] | matrices and contact states of a model of one's own |
//! | [`read_candidates`], [`read_steps`] | contact candidates and loads of such a model |
//! | [`read_nodes`] | where its nodes are, for pictures |
//! | [`Plausibility`] | figures of such a model that show a wrong unit, file or numbering |
#![deny(clippy::float_arithmetic)]

mod block;
mod block_model;
pub mod calculix;
mod contacts;
mod coordinates;
mod directions;
mod doubles;
mod element;
mod error;
mod frequencies;
mod lines;
mod loading;
mod mesh;
mod nodes;
mod plane;
mod plausibility;
mod published;
mod rotation;
mod spacing;
mod steps;
mod symmetry;
mod table;
mod tolerance;
mod two_particles;

pub use block::Block;
pub use block_model::BlockModel;
pub use contacts::{
    ContactTable, ContactsError, ReactionPlace, TableReaction, read_candidates, read_contacts,
    with_reaction,
};
pub use doubles::{DoubleBlock, DoubleMatrix};
pub use element::{MassKind, Material, PlanePoint};
pub use error::SourceError;
pub use loading::Loading;
pub use mesh::{MAX_CELLS, MeshKind};
pub use nodes::{NodeTable, read_nodes};
pub use plane::Plane;
pub use plausibility::{Plausibility, PlausibilityInput, rows_alone};
pub use published::PublishedState;
pub use rotation::{Frame, angle_in_degrees, make_frames_exact};
pub use steps::{StepsError, read_steps};
pub use symmetry::{Asymmetry, asymmetry, symmetric_part};
pub use table::TableError;
pub use two_particles::{pythagorean_angles, two_particles};
