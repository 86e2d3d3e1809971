//! A PATH-style solver for mixed complementarity problems in doubles (Dirkse and Ferris 1995).
//!
//! Normal map, linearisation, pivotal path to the Newton point, non-monotone search back along
//! that path, ray start where the regular one fails. It knows nothing of friction, and a run ends
//! with a *reason*; whether a point is a solution is decided elsewhere, exactly.

mod basis;
mod newton;
mod options;
mod outcome;
mod path;
mod residual;
mod tolerance;

pub use newton::solve;
pub use options::Options;
pub use outcome::{Major, Outcome, SolverError, Start, Step, Termination};
pub use path::{Pivot, Variable};
pub use residual::Residuals;
