//! The MCPs on which the curves of a search are followed and their solutions polished.
//!
//! The MCP of Proposition 1 or 2 covers one side of an origin ([`Embedding`]): runs start there,
//! and curves are followed there. Where A_ff is regular and the free rows of B are zero, curves run
//! on the circle instead ([`CirclePencil`]), which covers all values at once; their points are
//! polished in the embedding of all t >= 0. With particles in contact with zero reaction there is
//! no circle. Made by [`Hunt`](super::hunt::Hunt) for each side of an origin.

use crate::candidate::Candidate;
use crate::reduction::{CirclePencil, Embedding, Side};
use mceip_mcp::mcp::Mcp;
use mceip_model::{Admissible, ZeroVariables};

/// Solutions taken from one curve, at most: a cone of solutions is met at every step.
const PER_CURVE: usize = 16;

/// The same on the circle, where most of what a curve meets is no solution of the eigenproblem.
const PER_CIRCLE: usize = 64;

/// The MCPs of one side of an origin, and what a search has done on them.
pub(super) struct Ground {
    /// One side of an origin: where runs start.
    pub(super) embedding: Embedding,
    /// All t >= 0: the circle knows no sides.
    pub(super) whole: Embedding,
    /// The circle, if the pencil has one.
    pub(super) circle: Option<CirclePencil>,
    /// Seed of the directions.
    pub(super) seed: u64,
    /// How often each solution was left, in the order of discovery.
    pub(super) departed: Vec<usize>,
    /// Starts of runs between curves, the last one first.
    pub(super) spare: Vec<Vec<f64>>,
    /// Curves followed.
    pub(super) curves: usize,
    /// Pivots and factorisations of these curves.
    pub(super) curve_work: usize,
}

impl Ground {
    pub(super) fn new(
        admissible: &Admissible<'_>,
        zero: &[ZeroVariables],
        side: Side,
        seed: u64,
    ) -> Ground {
        let embedding = Embedding::with_zero(admissible, zero, side);
        let circle = if zero.is_empty() {
            CirclePencil::new(&embedding)
        } else {
            None
        };
        let whole = Embedding::with_zero(admissible, zero, Side::Above(0.0));
        Ground {
            embedding,
            whole,
            circle,
            seed,
            departed: Vec::new(),
            spare: Vec::new(),
            curves: 0,
            curve_work: 0,
        }
    }

    /// The embedding in which a curve's solutions are polished.
    pub(super) fn polisher(&self) -> &Embedding {
        if self.circle.is_some() {
            &self.whole
        } else {
            &self.embedding
        }
    }

    /// The MCP of the curves.
    pub(super) fn problem(&self) -> &dyn Mcp {
        match &self.circle {
            Some(circle) => circle,
            None => &self.embedding,
        }
    }

    /// A candidate as a point of the curves' MCP.
    pub(super) fn point(&self, candidate: &Candidate) -> Vec<f64> {
        match &self.circle {
            Some(circle) => circle.point(candidate.value, &candidate.x),
            None => self.embedding.point(candidate.value, &candidate.x),
        }
    }

    /// The candidate at a point of the curves' MCP; `None` where the point has no value.
    pub(super) fn candidate(&self, z: &[f64]) -> Option<Candidate> {
        match &self.circle {
            Some(circle) => circle.candidate(z),
            None => Some(self.embedding.candidate(z)),
        }
    }

    /// A random direction of the residual.
    pub(super) fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        match &self.circle {
            Some(circle) => circle.direction(seed, uneven),
            None => self.embedding.direction(seed, uneven),
        }
    }

    /// Solutions taken from one curve, at most.
    pub(super) fn enough(&self) -> usize {
        if self.circle.is_some() {
            PER_CIRCLE
        } else {
            PER_CURVE
        }
    }
}
