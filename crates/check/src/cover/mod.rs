//! Complete sets: the proof that a list holds every solution with a value in the window.
//!
//! The problem is condensed to the complementarity variables: 0 <= x _|_ T(t) x >= 0, x != 0, where
//! T(t) = A + tB, or its Schur complement where there are free variables. A solution has a value t
//! and a support { i : x_i > 0 }. The certificate's cover cuts the set of all pairs (support, t),
//! t in the window, into regions: an interval of t, and for each variable x_i = 0, x_i > 0 or
//! undecided. Each region is a leaf of a tree with a proof of one of these statements:
//!
//! * it holds no solution: `farkas`, `definite` (in enclosures), `ldl` (definite, exact),
//!   [`condensed::tail`] (definite from some value on), `root` and `support` (their other
//!   outcomes);
//! * it holds exactly one, with an enclosure of its value: `root`, `support`;
//! * it holds a family of solutions, described exactly: `support`;
//! * nothing is proved of it: an *open* region.
//!
//! The regions cover the whole set, and two regions of a piece have at most an end of their
//! intervals in common. So every solution in the window is one of those found, up to a positive
//! factor, or lies in a family or an open region. What two leaves yield alike is counted once
//! (`found`).
//!
//! `ends`, `family`, `expanded` and `condensed` enclose T(t) over an interval, `infinity` over a
//! half line. `ball`, `product`, `residual`, `enclosed_definite` and `psd` are the arithmetic
//! behind it, and `spread` is what the radii of the data add. `walk` goes through the trees, and
//! `budget` bounds the work.
//!
//! `critical` uses the same leaves for boxes of (value, friction): absence below a friction.
//! `presence` uses the corners of such boxes: a solution for every friction of an interval. What an
//! approximate inverse and null vectors prove, for `root`, `regular` and `presence`, is in
//! `bordered`.
//!
//! For each kind of leaf there is a file in `crates/engine/src/search/complete/leaf/` that makes
//! it; the table in its `mod.rs` names both sides.
//!
//! Input: the integral rows of the pencil, the window, the claims of the certificate that have been
//! accepted, and the cover. Called by [`crate::check`].

mod ball;
mod beside;
mod bordered;
mod budget;
mod condensed;
mod context;
pub(crate) mod critical;
mod definite;
mod enclosed_definite;
pub(crate) mod ends;
mod expanded;
mod family;
mod farkas;
pub(crate) mod fault;
mod found;
mod infinity;
mod ldl;
mod leaf;
#[cfg(test)]
mod order_two;
pub(crate) mod presence;
mod product;
mod proved;
mod psd;
mod region;
mod regular;
mod residual;
mod root;
mod rootless;
mod sign_budget;
mod spread;
pub(crate) mod stability;
mod support;
pub(crate) mod walk;

pub use beside::Place;
pub use fault::CoverFault;
pub(super) use proved::AcceptedSolution;
pub use proved::{AcceptedCover, OpenRegion, SolutionFamily};

use super::pencil::Rows;
use super::reason::Reason;
use crate::certificate::{CompleteSet, Condensation};
use condensed::{AnchorOfParts, Anchors, PencilParts};
use context::Context;
use mceip_exact::Rational;
use mceip_model::Window;
use walk::{Audit, CoverWalk, FaultAt};

/// Largest number of complementarity variables of a cover: a region has dense matrices of this
/// order.
pub const MAX_COVERED: usize = 512;

/// Largest product of the number of anchors and the square of the number of complementarity
/// variables: an anchor is expanded into dense matrices of that order.
const MAX_EXPANDED: usize = 3 << 20;

/// Checks a cover.
///
/// `claims` are the certificate's claims in order, all accepted. With an audit, a leaf that fails
/// is left open and noted there, and what is returned means nothing if the audit was stopped.
pub(super) fn check(
    rows: &Rows,
    window: &Window,
    claims: &[AcceptedSolution<'_>],
    cover: &CompleteSet,
    audit: Option<&Audit<'_>>,
) -> Result<AcceptedCover, Reason> {
    check_cover(rows, window, claims, cover, audit).map_err(|at| Reason::Cover {
        piece: at.piece,
        node: at.node,
        fault: at.fault,
    })
}

fn check_cover(
    rows: &Rows,
    window: &Window,
    claims: &[AcceptedSolution<'_>],
    cover: &CompleteSet,
    audit: Option<&Audit<'_>>,
) -> Result<AcceptedCover, FaultAt> {
    let parts = [rows];
    let pencil = PencilParts::exact(&parts);
    let anchors = anchors(pencil, cover.condensation.as_ref())?;
    let nodes = budget::nodes(&cover.pieces);
    let mut context = Context::new(pencil, anchors.as_ref(), window, nodes);
    context.claims = claims;
    context.tail = tail(rows, cover)?;

    let mut walk = CoverWalk::new(context, anchors);
    walk.audit = audit;
    walk.pieces(&cover.pieces)?;

    let families = found::families(&mut walk.found, walk.families);
    let solutions = found::distinct(walk.found)?;
    Ok(AcceptedCover {
        solutions,
        families,
        open: walk.open,
        leaves: walk.leaves,
    })
}

/// What the covers of values below 0 and of the others have proved together.
pub(super) fn joined(
    below: Option<AcceptedCover>,
    above: Option<AcceptedCover>,
) -> Option<AcceptedCover> {
    match (below, above) {
        (Some(below), Some(above)) => Some(found::joined(below, above)),
        (below, above) => below.or(above),
    }
}

/// The anchors of the condensation, which is there exactly if there are free variables. Demands
/// that matrices of the problem's order may be formed, for each part about each anchor.
fn anchors<'a, A: AnchorOfParts, T>(
    parts: PencilParts<'_, 'a>,
    condensation: Option<&'a Condensation<A, T>>,
) -> Result<Option<Anchors<'a>>, CoverFault> {
    let rows = parts.rows[0];
    let expansions = condensation.map_or(0, |c| c.anchors.len().saturating_mul(parts.rows.len()));
    let order = rows.complementarity_variables().len();
    check_size(order, expansions)?;

    let has_free = order < rows.order();
    match condensation {
        None if !has_free => Ok(None),
        Some(condensation) if has_free => Ok(Some(condensed::of(parts, condensation)?)),
        _ => Err(CoverFault::Condensation { expected: has_free }),
    }
}

/// Demands that matrices of the problem's order may be formed.
fn check_size(order: usize, anchors: usize) -> Result<(), CoverFault> {
    let what = "complementarity variables of a cover";
    CoverFault::at_most(what, MAX_COVERED as u64, order as u64)?;

    let expanded = anchors.saturating_mul(order * order);
    let what = "anchors times complementarity variables squared";
    CoverFault::at_most(what, MAX_EXPANDED as u64, expanded as u64)
}

/// The value from which on there is no solution, if the condensation proves one.
fn tail<'a>(rows: &Rows, cover: &'a CompleteSet) -> Result<Option<&'a Rational>, CoverFault> {
    let tail = cover.condensation.as_ref().and_then(|c| c.tail.as_ref());
    let Some(tail) = tail else { return Ok(None) };

    let from = &tail.from.0;
    condensed::tail(rows, None, from, &tail.factor, tail.mass_factor.as_ref())?;
    Ok(Some(from))
}

#[cfg(test)]
mod tests {
    use super::budget::WorkBudget;
    use super::leaf::Leaf;
    use super::region::Region;
    use super::*;
    use crate::certificate::VariableState;
    use crate::certificate::{Node, Piece, Root, RootOutcome};
    use mceip_exact::{Integer, rational, whole};
    use mceip_model::file::Number;
    use std::rc::Rc;

    const MATRIX_BUDGET: &str = "matrices of regions: products of words, left of the file's budget";

    /// The diagonal pencil (a + t) I.
    fn diagonal(order: usize, a: i64) -> Rows {
        let one = Integer::from(1);
        Rows {
            halves: vec![],
            rows: (0..order)
                .map(|i| vec![(i, a.into(), one.clone())])
                .collect(),
            factor: vec![one.clone(); order],
            is_free: vec![false; order],
        }
    }

    fn region(lo: Rational, hi: i64, states: Vec<VariableState>) -> Region {
        Region {
            states,
            ..Region::new(Rc::new(lo), Some(Rc::new(whole(hi))), None, 0)
        }
    }

    /// The context of a file with one node.
    fn context<'a>(rows: &'a Rows, window: &'a Window) -> Context<'a> {
        Context::new(PencilParts::exact(&[rows]), None, window, 1)
    }

    /// Three variables that may be positive cost 27; the second leaf does not find enough left.
    #[test]
    fn definite_leaves_spend_a_budget() {
        let rows = diagonal(4, 3);
        let window = Window::all();
        let mut context = context(&rows, &window);
        context.definite_budget = WorkBudget::definite_leaves(50);
        let states = vec![
            VariableState::Undecided,
            VariableState::InSupport,
            VariableState::Undecided,
            VariableState::AtZero,
        ];
        let region = region(whole(0), 1, states);

        assert_eq!(context.spend_definite(&region), Ok(()));
        assert_eq!(context.definite_budget.left(), 23);

        let too_large = CoverFault::TooLarge {
            what: "definite leaves: order cubed, left of the file's budget",
            limit: 23,
            got: 27,
        };
        assert_eq!(context.spend_definite(&region), Err(too_large));
    }

    /// What a file may spend on definite leaves: 2^26, 2^20 a node, 2^16 an entry that is not zero;
    /// on matrices 2^30, 2^22 a node and 2^16 an entry, on witnesses of presence 2^30 and 2^26 a
    /// piece.
    #[test]
    fn the_budget_grows_with_nodes_and_entries() {
        let mut rows = diagonal(2, 3);
        for (i, row) in rows.rows.iter_mut().enumerate() {
            row.push((1 - i, Integer::from(0), Integer::from(0)));
        }
        let piece = |nodes: usize| Piece {
            max: None,
            anchor: None,
            tree: vec![Node::Open; nodes],
        };
        let cover = CompleteSet {
            condensation: None,
            pieces: vec![piece(3), piece(4)],
        };

        let definite = WorkBudget::of_definite_leaves(&[&rows], budget::nodes(&cover.pieces));
        let matrices = WorkBudget::of_matrices(&[&rows], budget::nodes(&cover.pieces));

        assert_eq!(definite.left(), (1 << 26) + 7 * (1 << 20) + 2 * (1 << 16));
        assert_eq!(matrices.left(), (1 << 30) + 7 * (1 << 22) + 2 * (1 << 16));
        assert_eq!(WorkBudget::of_pieces(5).left(), (1 << 30) + 5 * (1 << 26));
    }

    /// Two variables over [1/3, 2]: four entries, K = 1, ends of 128 + 3 + 3 bits in 3 words,
    /// entries of 128 bits in 3, and 2^8 each.
    #[test]
    fn matrices_of_regions_spend_a_budget_once_an_interval() {
        let rows = diagonal(2, 3);
        let window = Window::all();
        let mut context = context(&rows, &window);
        let cost = 4 * (3 * (3 + 3) + 256);
        context.matrix_budget = WorkBudget::matrices(2 * cost - 1);

        let shared = region(rational(1, 3), 2, vec![VariableState::Undecided; 2]);
        assert_eq!(context.affordable(&shared), Ok(()));
        assert_eq!(context.affordable(&shared), Ok(()));
        assert_eq!(context.matrix_budget.left(), cost - 1);

        let other = region(rational(1, 3), 2, vec![VariableState::Undecided; 2]);
        let too_large = CoverFault::TooLarge {
            what: MATRIX_BUDGET,
            limit: cost - 1,
            got: cost,
        };
        assert_eq!(context.affordable(&other), Err(too_large));
    }

    /// A root leaf of -6 + t over [5, 7] needs the matrices of its hull and of its interval: 3 (3 +
    /// 3) and 2^8 each.
    #[test]
    fn root_leaves_spend_the_same_budget() {
        let rows = diagonal(1, -6);
        let window = Window::all();
        let mut context = context(&rows, &window);
        let region = region(whole(5), 7, vec![VariableState::InSupport]);
        let root = Root {
            pivot: 0,
            interval: [whole(5), whole(7)].map(Number),
            inverse: vec![],
            inverse_exponent: 0,
            left: vec![],
            right: vec![],
            exponent: 0,
            outcome: RootOutcome::Solution,
        };

        let cost = 3 * (3 + 3) + 256;
        context.matrix_budget = WorkBudget::matrices(2 * cost);
        let held = root.check(&region, &context);
        assert_eq!(held.map(|held| held.found.len()).ok(), Some(1));
        assert_eq!(context.matrix_budget.left(), 0);

        for left in [cost - 1, 2 * cost - 1] {
            context.matrix_budget = WorkBudget::matrices(left);
            let too_large = CoverFault::TooLarge {
                what: MATRIX_BUDGET,
                limit: cost - 1,
                got: cost,
            };
            let refused = root.check(&region, &context).err();
            assert_eq!(refused, Some(too_large), "{left}");
        }
    }

    /// A node that divides its region proves nothing of it.
    #[test]
    fn a_node_that_divides_is_no_leaf() {
        let rows = diagonal(2, 3);
        let window = Window::all();
        let context = context(&rows, &window);
        let region = region(whole(0), 1, vec![VariableState::Undecided; 2]);
        let half = || Number(rational(1, 2));

        for node in [Node::Split(half()), Node::Friction(half()), Node::Branch(0)] {
            assert!(!node.is_leaf());
            let refused = CoverFault::Kind { kind: node.kind() };
            assert_eq!(leaf::check(&node, &region, &context).err(), Some(refused));
        }

        assert!(leaf::check(&Node::PositiveDefinite, &region, &context).is_ok());
    }
}
