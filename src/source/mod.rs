//! Where problems come from: the two particles of Fig. 1, the block of section 5.
#![deny(clippy::float_arithmetic)]

mod block;
mod block_model;
pub mod calculix;
#[cfg(feature = "solver")]
mod contacts;
mod doubles;
mod element;
mod error;
mod mesh;
#[cfg(feature = "solver")]
pub mod path;
mod published;
mod triangulation;
mod two_particles;

pub use block::Block;
pub use block_model::BlockModel;
#[cfg(feature = "solver")]
pub use contacts::{ContactsError, read_contacts};
pub use doubles::{DoubleBlock, DoubleMatrix};
pub use element::{MassKind, Material, Plane, Point};
pub use error::SourceError;
pub use mesh::{MAX_CELLS, MeshKind};
pub use published::PublishedState;
pub use triangulation::Triangulation;
pub use two_particles::{pythagorean_angles, two_particles};
