//! Why a loading path is not computed: what users read ([`PathError`]), and the law that fails at a
//! node, as the parts of the path tell each other ([`LawFailure`]).

use mceip_exact::{CondenseError, Rational};
use mceip_model::ModelError;

/// A path that cannot be followed, or options that make no path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// The condensation to the contact nodes failed.
    #[error(transparent)]
    Condensation(#[from] CondenseError),
    /// A contact state was refused.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The free nodes have a singular stiffness: never for a block with a glued side.
    #[error(
        "condensation: expected a regular stiffness of the free contact nodes, got a singular one"
    )]
    SingularFreeNodes,
    /// A coefficient of friction, a force, a range or a step that is zero or negative.
    #[error("loading path: expected {what} > 0, got {got}")]
    NotPositive {
        /// Which quantity, with its unit.
        what: &'static str,
        /// Its value.
        got: Rational,
    },
    /// No states satisfy the rate conditions of the pressing. (Later on a path ends instead of
    /// failing: [`super::PathEnd::NoContinuation`].)
    #[error(
        "rate problem: no admissible states among {tried} sets tried{}",
        if *.all { " (every set there is)" } else { "" }
    )]
    NoContinuation {
        /// Sets of states tried (some of them more than once).
        tried: usize,
        /// Every set was tried, and none was singular: there is no continuation.
        all: bool,
    },
    /// The same, after the path has begun.
    #[error("loading path: event {event} at motion {motion} mm: {source}")]
    AtEvent {
        /// Number of the event, 0 at the end of the pressing.
        event: usize,
        /// Where, mm, to six digits.
        motion: String,
        /// What failed.
        source: Box<PathError>,
    },
    /// A law fails where the search took it to hold: a bug, reported rather than hidden.
    #[error("{equation} fails at node {node}")]
    LawFails {
        /// Equation id.
        equation: &'static str,
        /// Contact node, from 0 at the left.
        node: usize,
    },
    /// Two stretches of the path do not meet: a bug, reported rather than hidden.
    #[error("the displacements before and after differ")]
    Discontinuous,
    /// The pressing does not load the obstacle.
    #[error("pressing: expected a compressive resultant, got none")]
    NoPressure,
    /// More events than any path that was met.
    #[error("loading path: expected at most {limit} events, got more")]
    TooManyEvents {
        /// The bound.
        limit: usize,
    },
    /// Incremental stepping found no states within its iterations.
    #[error(
        "step {step} at motion {motion} mm: no admissible states within {limit} active-set \
         iterations"
    )]
    StepNotConverged {
        /// Number of the step, from 1.
        step: usize,
        /// Where, mm.
        motion: f64,
        /// Iterations allowed.
        limit: usize,
    },
}

/// A law that fails at a contact node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LawFailure {
    /// Contact node, from 0 at the left.
    pub(super) node: usize,
    /// Equation id.
    pub(super) equation: &'static str,
}

impl From<LawFailure> for PathError {
    fn from(failure: LawFailure) -> PathError {
        PathError::LawFails {
            equation: failure.equation,
            node: failure.node,
        }
    }
}
