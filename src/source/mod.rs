//! Where problems come from: the two particles of Fig. 1, the block of section 5.
#![deny(clippy::float_arithmetic)]

mod block;
mod element;
mod two_particles;

pub use block::{Block, PublishedState};
pub use element::{MassKind, Material, Point};
pub use two_particles::{pythagorean_angles, two_particles};
