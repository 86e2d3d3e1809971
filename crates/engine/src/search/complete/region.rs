//! Where a search is: an interval of the unknown with the states of the complementarity variables,
//! and the nodes that it leaves in a tree.

use mceip_check::certificate::{Claim, Node, Root};
use mceip_exact::Rational;

/// State of a complementarity variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Not decided.
    Open,
    /// x_i = 0.
    Rest,
    /// x_i > 0, y_i = 0.
    Moving,
}

/// A node of the tree as found, in preorder.
#[derive(Debug, Clone)]
pub(super) enum Item {
    Node(Node),
    /// A root whose outcome is this claim, numbered when the certificate is put together.
    Claimed(Box<Root>, Box<Claim>),
}

/// Where and what is searched.
#[derive(Clone)]
pub(super) struct Region {
    pub(super) lo: Rational,
    pub(super) hi: Option<Rational>,
    pub(super) states: Vec<State>,
    /// Cuts since the last branch: towards a degenerate end cutting alone would not come to an end.
    pub(super) cuts: usize,
    /// Has a null vector of this support already been met that is not provably alone?
    pub(super) suspect: bool,
}

impl Region {
    /// An interval with nothing decided.
    pub(super) fn whole(lo: Rational, hi: Option<Rational>, variables: usize) -> Region {
        Region {
            lo,
            hi,
            states: vec![State::Open; variables],
            cuts: 0,
            suspect: false,
        }
    }
}
