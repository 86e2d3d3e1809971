//! The MCPs on which the curves of a search are followed and their solutions polished: the
//! embedding of one side of an origin, or the circle where there is one.

use crate::candidate::Candidate;
use crate::reduction::{CirclePencil, Embedding, Side};
use mceip_mcp::mcp::Mcp;
use mceip_model::Admissible;

/// Solutions taken from one curve, at most: a cone of solutions is met at every step.
const PER_CURVE: usize = 16;

/// The same on the circle, where most of what a curve meets is no solution of the eigenproblem.
const PER_CIRCLE: usize = 64;

/// The MCPs on which curves are followed and their solutions polished.
pub(super) struct Ground {
    /// One side of an origin: where runs start.
    pub(super) embedding: Embedding,
    /// All t >= 0: the circle knows no sides.
    pub(super) whole: Embedding,
    pub(super) circle: Option<CirclePencil>,
    /// Seed of the directions.
    pub(super) seed: u64,
    /// How often each solution was left, in the order of discovery.
    pub(super) departed: Vec<usize>,
    /// Starts of runs between curves, the last one first.
    pub(super) spare: Vec<Vec<f64>>,
    /// Curves followed, and their pivots and factorisations.
    pub(super) followed: (usize, usize),
}

impl Ground {
    pub(super) fn new(admissible: &Admissible<'_>, side: Side, seed: u64) -> Ground {
        let embedding = Embedding::new(admissible, side);
        let circle = CirclePencil::new(&embedding);
        let whole = Embedding::new(admissible, Side::Above(0.0));
        Ground {
            embedding,
            whole,
            circle,
            seed,
            departed: Vec::new(),
            spare: Vec::new(),
            followed: (0, 0),
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

    pub(super) fn point(&self, c: &Candidate) -> Vec<f64> {
        self.circle.as_ref().map_or_else(
            || self.embedding.point(c.value, &c.x),
            |circle| circle.point(c.value, &c.x),
        )
    }

    pub(super) fn candidate(&self, z: &[f64]) -> Option<Candidate> {
        self.circle.as_ref().map_or_else(
            || Some(self.embedding.candidate(z)),
            |circle| circle.candidate(z),
        )
    }

    pub(super) fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        self.circle.as_ref().map_or_else(
            || self.embedding.direction(seed, uneven),
            |circle| circle.direction(seed, uneven),
        )
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
