//! Why a loading path is not computed: what users read ([`PathError`]), and the law that fails at a
//! node, as the parts of the path tell each other ([`LawFailure`]).

use super::rates::Unsolved;
use mceip_exact::{CondenseError, NumberError, Rational};
use mceip_mcp::linear::SymmetricError;
use mceip_model::ModelError;

/// A path that cannot be followed, or options that make no path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// The condensation to the contact nodes failed.
    #[error(transparent)]
    Condensation(#[from] CondenseError),
    /// A stiffness that is not symmetric or finite in doubles.
    #[error(transparent)]
    Symmetric(#[from] SymmetricError),
    /// A stiffness that is not positive definite in doubles.
    #[error(
        "condensation in doubles: expected a body that is held, got a stiffness that is not \
         positive definite at degree of freedom {dof}"
    )]
    NotDefinite {
        /// Where elimination ended.
        dof: usize,
    },
    /// A condensed entry that overflows.
    #[error("condensation in doubles: {0}")]
    Number(#[from] NumberError),
    /// Parts of a body, or contact states, that do not fit together.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The free nodes have a singular stiffness: never for a body that is held.
    #[error(
        "condensation: expected a regular stiffness of the free contact nodes, got a singular one"
    )]
    SingularFreeNodes,
    /// A coefficient of friction, an amount, a force, a range or a step that is zero or negative.
    #[error("loading path: expected {what} > 0, got {got}")]
    NotPositive {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        got: Rational,
    },
    /// A candidate that stands in the obstacle before any load.
    #[error("contact candidate {node}: expected a gap >= 0, got {got}")]
    NegativeGap {
        /// The candidate, from 0.
        node: usize,
        /// Its gap.
        got: Rational,
    },
    /// Other steps than the body has loads for, or an endless step before another.
    #[error("load steps: expected {expected}, got {got}")]
    Steps {
        /// What is wanted.
        expected: String,
        /// What was found.
        got: String,
    },
    /// No states satisfy the rate conditions. (A path ends instead of failing:
    /// [`super::LoadingPathEnd::NoContinuation`].)
    #[error("rate problem: {0}")]
    NoContinuation(Unsolved),
    /// What fails on the way.
    #[error("loading path: stretch {stretch}, step {step} at {amount} of its load: {source}")]
    At {
        /// Number of the stretch, from 0.
        stretch: usize,
        /// Number of the step, from 1.
        step: usize,
        /// How much of its load is applied, to six digits.
        amount: String,
        /// What failed.
        source: Box<PathError>,
    },
    /// A law fails where the search took it to hold: a bug, reported rather than hidden.
    #[error("{equation} fails at node {node}")]
    LawFails {
        /// Equation id.
        equation: &'static str,
        /// Contact candidate, from 0.
        node: usize,
    },
    /// Two stretches of the path do not meet: a bug, reported rather than hidden.
    #[error("displacements or reactions before and after differ")]
    Discontinuous,
    /// More events than any path that was met.
    #[error("loading path: expected at most {limit} events, got more")]
    TooManyEvents {
        /// The bound.
        limit: usize,
    },
}

/// A law that fails at a contact candidate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LawFailure {
    /// Contact candidate, from 0.
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
