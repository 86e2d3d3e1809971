//! What a run reports: the point, every residual, why it stopped, and the log of its pivots.

use super::{Pivot, Residuals};
use crate::mcp::McpError;

/// Why a run stopped. None of them says that a solution was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Termination {
    /// Both residuals that are tested are below the tolerance.
    ToleranceReached,
    /// The limit on linearisations.
    MajorLimit,
    /// The limit on pivots, of one path or of the run.
    PivotLimit,
    /// Regular and ray start both ended on a ray.
    Ray,
    /// Both starts cycled (rounding; the rule is lexicographic).
    Cycle,
    /// No basis, perturbed or not, was regular at the current point.
    SingularBasis,
    /// No point on the path passes the non-monotone test.
    NoProgress,
    /// F or its Jacobian is not finite at the current point.
    NonFinite,
}

impl Termination {
    /// Did the residuals fall below the tolerance? Only a candidate for certification.
    pub fn reached_tolerance(self) -> bool {
        self == Termination::ToleranceReached
    }
}

/// Which start a path used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// From the current iterate.
    Regular,
    /// Lemke's ray, from the bounds.
    Ray,
}

/// How a step was taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// To the end of the path.
    Full,
    /// Back along the path to this t.
    Search {
        /// The t at which the non-monotone test passed.
        t: f64,
    },
}

/// One linearisation with the path that was followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Major {
    /// Merit |F_normal|^2 / 2 before the step.
    pub merit: f64,
    /// Which start the accepted path used.
    pub start: Start,
    /// Relative proximal perturbation of the linearisation.
    pub proximal: f64,
    /// The pivots with their t.
    pub pivots: Vec<Pivot>,
    /// t at the end of the path: 1 for a complete one.
    pub t: f64,
    /// The step taken.
    pub step: Step,
}

/// The end of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The last point, within the bounds.
    pub point: Vec<f64>,
    /// Residuals there.
    pub residuals: Residuals,
    /// Why the run stopped.
    pub termination: Termination,
    /// The linearisations in order.
    pub log: Vec<Major>,
    /// Pivots of all paths, also of those given up.
    pub pivots: usize,
}

/// Why a run does not start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolverError {
    /// The problem's bounds or shapes are inconsistent.
    #[error(transparent)]
    Problem(#[from] McpError),
    /// The start has the wrong length.
    #[error("expected a start of length {expected}, got {got}")]
    StartLength {
        /// Dimension of the problem.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// The start has a NaN or an infinity.
    #[error("expected a finite start at {index}, got {got}")]
    StartNotFinite {
        /// The component.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// An option is out of range.
    #[error("expected {name} > 0 and finite, got {got}")]
    Option {
        /// The option.
        name: &'static str,
        /// Its value.
        got: f64,
    },
}
