//! Leaves: what the proof of each kind reads and what it yields.
//!
//! A kind is a file of this folder with the proof, a line of [`check`], and a variant of
//! [`Node`]. What a leaf proves is said there; `critical` says what holds over an interval of
//! friction.

use super::context::Context;
use super::definite::Definite;
use super::farkas::Farkas;
use super::fault::CoverFault;
use super::proved::{LeafSolution, SolutionFamily};
use super::region::Region;
use crate::certificate::Node;

/// The proof of a leaf.
pub(super) trait Leaf {
    /// Demands that the proof holds in this region, and returns what the region holds.
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault>;
}

/// What a region holds; by default no solution.
#[derive(Default)]
pub(super) struct Yield {
    /// Isolated single solutions.
    pub(super) found: Vec<LeafSolution>,
    pub(super) families: Vec<SolutionFamily>,
    /// Is nothing proved of it?
    pub(super) is_open: bool,
}

/// What an open region holds.
pub(super) const OPEN: Yield = Yield {
    found: Vec::new(),
    families: Vec::new(),
    is_open: true,
};

/// Checks the proof of a leaf.
///
/// Soundness hangs on the refusal of the nodes that divide: "no solution" is what a proof yields,
/// and they prove nothing. The walk divides their regions and does not bring them here.
pub(super) fn check(node: &Node, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
    match node {
        Node::Split(_) | Node::Friction(_) | Node::Branch(_) => {
            Err(CoverFault::Kind { kind: node.kind() })
        }
        Node::Farkas(weights) => Farkas(weights).check(at, context),
        Node::PositiveDefinite => Definite::Positive.check(at, context),
        Node::NegativeDefinite => Definite::Negative.check(at, context),
        Node::WeightedDefinite(weights) => Definite::Weighted(weights).check(at, context),
        Node::Ldl(factors) => factors.check(at, context),
        Node::Support(support) => support.check(at, context),
        Node::Root(root) => root.check(at, context),
        Node::Regular(witness) => witness.check(at, context),
        Node::Tail => TailLeaf.check(at, context),
        Node::Open => Ok(OPEN),
    }
}

/// The condensation's tail begins at or below the region: there is no solution from there on.
struct TailLeaf;

impl Leaf for TailLeaf {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        match context.tail {
            Some(from) if from <= at.lo.as_ref() => Ok(Yield::default()),
            _ => {
                let expected = "a tail that begins at or below the region";
                Err(CoverFault::hypothesis(expected, 0))
            }
        }
    }
}
