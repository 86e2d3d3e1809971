//! Where problems come from: the two particles of Fig. 1, the block of section 5.
#![deny(clippy::float_arithmetic)]

mod block;
mod block_model;
pub mod calculix;
mod contacts;
mod doubles;
mod element;
mod error;
mod mesh;
pub mod path;
mod plane;
mod published;
mod tolerance;
mod triangulation;
mod two_particles;

pub use block::Block;
pub use block_model::BlockModel;
pub use contacts::{ContactsError, read_contacts};
pub use doubles::{DoubleBlock, DoubleMatrix};
pub use element::{MassKind, Material, Point};
pub use error::SourceError;
pub use mesh::{MAX_CELLS, MeshKind};
pub use plane::Plane;
pub use published::PublishedState;
pub use triangulation::Triangulation;
pub use two_particles::{pythagorean_angles, two_particles};
