//! Where problems come from: the two particles of Fig. 1, the block of section 5.
#![deny(clippy::float_arithmetic)]

mod two_particles;

pub use two_particles::{pythagorean_angles, two_particles};
