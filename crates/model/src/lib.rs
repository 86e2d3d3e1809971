//! The problem: contact states, mechanical systems (1)-(9), pencils (15), and their file form.
//!
//! A [`Problem`] is a [`System`] (stiffness K, mass M, friction mu, contact particles) or a
//! [`Pencil`] A + tB given directly, with the [`Unknown`] t and the [`Window`] in which it is
//! sought. [`mod@reduction`] makes a pencil of a system, [`mod@file`] reads and writes problems,
//! and a problem's digest ([`Problem::sha256`]) binds certificates to it.
//!
//! A [`LoadedBody`] is a body whose contact states are not known: loads lead to them.
//!
//! A value that exists satisfies its preconditions: shapes, symmetry, definiteness and index sets
//! are established at construction, and whatever fails is refused with a [`ModelError`].

mod canonical;
mod coordinates;
mod error;
pub mod file;
mod loaded;
mod pencil;
mod problem;
mod quadratic;
mod radii;
mod reduced;
pub mod reduction;
mod system;
mod window;

pub use canonical::sha256;
pub use coordinates::{BodyNode, Coordinates, PrescribedDisplacement};
pub use error::{ErrorLocation, ModelError};
pub use loaded::{ContactCandidate, LoadStep, LoadedBody, LoadedParts};
pub use pencil::{Admissible, Pencil, Unknown};
pub use problem::{Body, Problem};
pub use quadratic::QuadraticPencil;
pub use radii::Radii;
pub use reduced::{MuFamily, Reduced, ReducedVariable, ZeroPart, ZeroVariables};
pub use system::{ContactState, Curvature, Direction, Particle, Reaction, System};
pub use window::{RealWindow, Window};
