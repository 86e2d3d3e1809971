//! Regions of the search, and the nodes that the search puts in their place.
//!
//! A region is an interval of the unknown t, an interval of mu where the pencil depends on it, and,
//! for each complementarity variable, what is known of it: x_i = 0, x_i > 0 or undecided. A piece
//! begins as one region in which nothing is decided. A cut of an interval or a branch on a variable
//! divides a region in two.
//!
//! Variables are named by their *position* in the view of the pencil; `View::index` gives their
//! numbers in the pencil.

use super::pieces::view::View;
use mceip_check::certificate::{Claim, Node, Root, RootOutcome, VariableState};
use mceip_exact::{Rational, to_f64};
use num_traits::Zero;

/// Positions of the variables that are in the support.
pub(crate) fn support(states: &[VariableState]) -> Vec<usize> {
    positions(states, |state| state == VariableState::InSupport)
}

/// Positions of the variables that are or may be in the support.
pub(crate) fn possible_support(states: &[VariableState]) -> Vec<usize> {
    positions(states, |state| state != VariableState::AtZero)
}

/// Positions of the variables with x_i = 0.
pub(crate) fn at_zero(states: &[VariableState]) -> Vec<usize> {
    positions(states, |state| state == VariableState::AtZero)
}

/// Positions of the variables that are not decided.
pub(crate) fn undecided(states: &[VariableState]) -> Vec<usize> {
    positions(states, |state| state == VariableState::Undecided)
}

fn positions(states: &[VariableState], holds: impl Fn(VariableState) -> bool) -> Vec<usize> {
    let mut positions = Vec::new();
    for (position, state) in states.iter().enumerate() {
        if holds(*state) {
            positions.push(position);
        }
    }

    positions
}

/// The part of (supports) x (window) x (interval of mu) that belongs to a node of the tree.
#[derive(Clone)]
pub(crate) struct SearchRegion {
    /// The interval [lo, hi] of the unknown; `None` stands for infinity.
    pub(crate) lo: Rational,
    pub(crate) hi: Option<Rational>,
    /// The interval of mu; [0, 0] where the pencil does not depend on it.
    pub(crate) mu: [Rational; 2],
    /// One per complementarity variable, by position.
    pub(crate) states: Vec<VariableState>,
    /// Cuts since the last branch: towards a degenerate end cutting alone would not come to an end.
    pub(crate) cuts: usize,
    /// Has a null vector of this support already been met that is not provably the only one?
    pub(crate) is_suspect: bool,
}

impl SearchRegion {
    /// An interval of t with nothing decided.
    pub(crate) fn whole(lo: Rational, hi: Option<Rational>, variables: usize) -> SearchRegion {
        SearchRegion {
            lo,
            hi,
            mu: [Rational::zero(), Rational::zero()],
            states: vec![VariableState::Undecided; variables],
            cuts: 0,
            is_suspect: false,
        }
    }

    /// The part below a cut.
    pub(crate) fn below(&self, cut: &Rational) -> SearchRegion {
        SearchRegion {
            hi: Some(cut.clone()),
            ..self.clone()
        }
    }

    /// The part above a cut.
    pub(crate) fn above(&self, cut: &Rational) -> SearchRegion {
        SearchRegion {
            lo: cut.clone(),
            ..self.clone()
        }
    }

    /// The parts below and above a cut of mu.
    pub(crate) fn cut_in_mu(&self, cut: &Rational) -> [SearchRegion; 2] {
        let [from, to] = &self.mu;
        let with_mu = |from: &Rational, to: &Rational| SearchRegion {
            mu: [from.clone(), to.clone()],
            ..self.clone()
        };
        [with_mu(from, cut), with_mu(cut, to)]
    }

    /// The two parts into which an inner node of a tree divides the region, the one that comes
    /// first in preorder last; `None` for a leaf.
    pub(crate) fn parts(&self, node: &Node, view: &View) -> Option<[SearchRegion; 2]> {
        match node {
            Node::Split(cut) => Some([self.above(&cut.0), self.below(&cut.0)]),
            Node::Friction(cut) => {
                let [below, above] = self.cut_in_mu(&cut.0);
                Some([above, below])
            }
            Node::Branch(variable) => {
                let position = view.position(*variable).unwrap_or(0);
                let in_support = view.part(self, position, VariableState::InSupport);
                let at_zero = view.part(self, position, VariableState::AtZero);
                Some([in_support, at_zero])
            }
            _ => None,
        }
    }

    /// The interval of t in doubles.
    pub(crate) fn interval(&self) -> [f64; 2] {
        let hi = self.hi.as_ref().map_or(f64::INFINITY, to_f64);
        [to_f64(&self.lo), hi]
    }

    pub(crate) fn middle_friction(&self) -> f64 {
        let [from, to] = self.mu.each_ref().map(to_f64);
        0.5 * (from + to)
    }

    pub(crate) fn is_decided(&self) -> bool {
        !self.states.contains(&VariableState::Undecided)
    }

    /// Is nothing decided?
    pub(crate) fn is_undecided(&self) -> bool {
        let mut states = self.states.iter();
        states.all(|state| *state == VariableState::Undecided)
    }

    /// Does the value lie strictly inside the interval?
    pub(crate) fn has_inside(&self, value: &Rational) -> bool {
        let is_above = *value > self.lo;
        let is_below = match &self.hi {
            Some(hi) => value < hi,
            None => true,
        };
        is_above && is_below
    }
}

/// A node of the tree as the search finds it, in preorder.
#[derive(Debug, Clone)]
pub(crate) enum Item {
    Node(Node),
    /// A root whose outcome is this claim, numbered when the certificate is put together.
    Claimed(Box<Root>, Box<Claim>),
}

impl Item {
    /// Does this leaf yield a solution by its null vector?
    pub(crate) fn is_solution(&self) -> bool {
        match self {
            Item::Node(Node::Root(root)) => root.outcome == RootOutcome::Solution,
            Item::Node(_) => false,
            Item::Claimed(..) => true,
        }
    }
}
