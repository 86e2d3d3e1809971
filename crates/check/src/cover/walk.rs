//! The walk through the trees of a file: the region of each node is computed, each leaf has its
//! proof checked.
//!
//! A tree is written in preorder. The walk keeps the regions that are still to be closed on a
//! stack. A node takes the region on top: a cut or a branch puts two in its place, whose union is
//! the region that was taken; a leaf proves what its region holds. A tree that ends exactly when
//! the stack is empty has therefore accounted for every (support, value) of its piece, and for
//! every friction where the trees cover an interval of it.
//!
//! Where one half of v_T of a particle with zero reaction moves, a branch puts the other one at
//! rest: what is covered are the motions, each with at most one of them.
//!
//! Called by `cover` for complete sets, and by `critical` for absence below a friction.

use super::condensed::Anchors;
use super::context::Context;
use super::fault::CoverFault;
use super::leaf;
use super::proved::{LeafSolution, OpenRegion, SolutionFamily};
use super::region::{Region, end};
use crate::LeafPlace;
use crate::certificate::{Node, Piece, VariableState};
use mceip_exact::Rational;
use mceip_model::Window;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// What a walk reads and what it has found.
pub(super) struct CoverWalk<'a> {
    pub(super) context: Context<'a>,
    /// Where there are free variables.
    pub(super) anchors: Option<Anchors<'a>>,
    /// The interval of mu of each tree, where the trees cover one.
    pub(super) friction: Option<[Rc<Rational>; 2]>,
    pub(super) audit: Option<&'a Audit<'a>>,
    pub(super) found: Vec<LeafSolution>,
    pub(super) families: Vec<SolutionFamily>,
    pub(super) open: Vec<OpenRegion>,
    pub(super) leaves: usize,
}

/// An examination that leaves the leaves that fail open and may be stopped.
pub(crate) struct Audit<'a> {
    /// Asked before each piece and each node: false stops the examination.
    go_on: &'a dyn Fn() -> bool,
    has_stopped: Cell<bool>,
    /// The leaves that fail: piece, node.
    refused: RefCell<Vec<LeafPlace>>,
}

impl<'a> Audit<'a> {
    pub(crate) fn new(go_on: &'a dyn Fn() -> bool) -> Audit<'a> {
        Audit {
            go_on,
            has_stopped: Cell::new(false),
            refused: RefCell::default(),
        }
    }

    /// The leaves that fail; `None` if the audit was stopped.
    pub(crate) fn into_refused(self) -> Option<Vec<LeafPlace>> {
        let is_complete = !self.has_stopped.get();
        is_complete.then(|| self.refused.into_inner())
    }

    /// Asks whether to go on, unless the answer was no.
    fn stops(&self) -> bool {
        if !self.has_stopped.get() {
            self.has_stopped.set(!(self.go_on)());
        }

        self.has_stopped.get()
    }
}

/// A fault and where it was found: the piece and the node of its tree, if one is to blame.
pub(super) struct FaultAt {
    pub(super) piece: Option<usize>,
    pub(super) node: Option<usize>,
    pub(super) fault: CoverFault,
}

impl From<CoverFault> for FaultAt {
    fn from(fault: CoverFault) -> FaultAt {
        FaultAt {
            piece: None,
            node: None,
            fault,
        }
    }
}

impl FaultAt {
    pub(super) fn piece(piece: usize, fault: CoverFault) -> FaultAt {
        FaultAt {
            piece: Some(piece),
            node: None,
            fault,
        }
    }
}

impl<'a> CoverWalk<'a> {
    pub(super) fn new(context: Context<'a>, anchors: Option<Anchors<'a>>) -> CoverWalk<'a> {
        CoverWalk {
            context,
            anchors,
            friction: None,
            audit: None,
            found: Vec::new(),
            families: Vec::new(),
            open: Vec::new(),
            leaves: 0,
        }
    }

    /// Checks the pieces: they follow one another from one end of the window to the other, and each
    /// tree covers its piece. Returns early if the audit is stopped.
    pub(super) fn pieces(&mut self, pieces: &[Piece]) -> Result<(), FaultAt> {
        let window = self.context.window;
        let mut lo = window.min().clone();

        for (k, piece) in pieces.iter().enumerate() {
            let is_last = k + 1 == pieces.len();
            let max = piece.max.as_ref().map(|n| &n.0);
            if self.has_stopped() {
                return Ok(());
            }

            let of_piece = |fault| FaultAt::piece(k, fault);
            self.context
                .use_anchor(self.anchors.as_ref(), piece.anchor)
                .map_err(of_piece)?;
            check_end(window, &lo, max, is_last).map_err(of_piece)?;
            self.piece(k, &lo, piece)?;

            if let Some(max) = max {
                lo = max.clone();
            }
        }

        if pieces.is_empty() {
            return Err(CoverFault::PieceEnd {
                expected: end(window.max()),
                got: lo.to_string(),
            }
            .into());
        }

        Ok(())
    }

    /// Walks the tree of the piece with this number, which begins at `lo`.
    fn piece(&mut self, number: usize, lo: &Rational, piece: &Piece) -> Result<(), FaultAt> {
        let lo = Rc::new(lo.clone());
        let hi = piece.max.as_ref().map(|max| Rc::new(max.0.clone()));
        let variables = self.context.index.len();
        let mut stack = vec![Region::new(lo, hi, self.friction.clone(), variables)];

        for (k, node) in piece.tree.iter().enumerate() {
            if self.has_stopped() {
                return Ok(());
            }

            let at_node = |fault| FaultAt {
                piece: Some(number),
                node: Some(k),
                fault,
            };
            let region = stack.pop().ok_or(at_node(CoverFault::Trailing))?;

            let halves = match node {
                Node::Split(t) => region.split(&t.0),
                Node::Friction(mu) => region.split_friction(&mu.0),
                Node::Branch(index) => {
                    let other_half = self.context.rows.other_half(*index);
                    region.branch(*index, &self.context.index, other_half)
                }
                leaf => {
                    self.leaf(&region, leaf, (number, k)).map_err(at_node)?;
                    continue;
                }
            };

            // The region on top of the stack is the next one.
            let [first, second] = halves.map_err(at_node)?;
            stack.extend([second, first]);
        }

        if stack.is_empty() {
            return Ok(());
        }

        Err(FaultAt {
            piece: Some(number),
            node: Some(piece.tree.len()),
            fault: CoverFault::Truncated {
                regions: stack.len(),
            },
        })
    }

    /// Checks the proof of a leaf and keeps what it yields. In an audit the region of one that
    /// fails is left open, and its place noted.
    fn leaf(&mut self, region: &Region, node: &Node, place: LeafPlace) -> Result<(), CoverFault> {
        self.leaves += 1;
        if !node.fits(region.friction.is_some()) {
            return Err(CoverFault::Kind { kind: node.kind() });
        }

        let held = match (leaf::check(node, region, &self.context), self.audit) {
            (Err(_), Some(audit)) => {
                audit.refused.borrow_mut().push(place);
                leaf::OPEN
            }
            (verdict, _) => verdict?,
        };

        self.found.extend(held.found);
        self.families.extend(held.families);
        if held.is_open {
            self.open.push(self.open_region(region));
        }

        Ok(())
    }

    fn open_region(&self, region: &Region) -> OpenRegion {
        let undecided = region.positions(|state| state == VariableState::Undecided);
        OpenRegion {
            min: Some(Rational::clone(&region.lo)),
            max: region.hi.as_deref().cloned(),
            moving: self.context.problem_indices(region.support()),
            undecided: self.context.problem_indices(undecided),
        }
    }

    /// Asks an audit whether to go on. A check that is none is never stopped.
    fn has_stopped(&self) -> bool {
        self.audit.is_some_and(Audit::stops)
    }
}

/// Demands that a piece ends above `lo`, where it begins, and within the window; the last one at
/// the end of the window. A window of one point is one piece.
fn check_end(
    window: &Window,
    lo: &Rational,
    max: Option<&Rational>,
    is_last: bool,
) -> Result<(), CoverFault> {
    if is_last && max != window.max() {
        return Err(CoverFault::PieceEnd {
            expected: end(window.max()),
            got: end(max),
        });
    }

    let rises = match max {
        None => true,
        Some(max) => max > lo || (is_last && max == lo),
    };
    let is_inside = match max {
        _ if is_last => true,
        None => false,
        Some(max) => window.max().is_none_or(|window_max| max < window_max),
    };
    if rises && is_inside {
        return Ok(());
    }

    Err(CoverFault::PieceEnd {
        expected: format!("a value above {lo} within the window"),
        got: end(max),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{Ldl, LdlFactor};
    use crate::cover::condensed::PencilParts;
    use crate::pencil::Rows;
    use mceip_exact::{Integer, whole};
    use mceip_model::file::Number;

    /// 1 + t, which is positive definite.
    fn rows() -> Rows {
        Rows {
            halves: vec![],
            rows: vec![vec![(0, Integer::from(1), Integer::from(1))]],
            factor: vec![Integer::from(1)],
            is_free: vec![false],
        }
    }

    /// The fault of a tree over [0, infinity), with an interval of friction or without.
    fn fault(tree: Vec<Node>, has_friction: bool) -> Option<CoverFault> {
        let rows = rows();
        let parts: &[&Rows] = if has_friction {
            &[&rows, &rows]
        } else {
            &[&rows]
        };
        let window = Window::all();
        let mut walk = CoverWalk::new(
            Context::new(PencilParts::exact(parts), None, &window, 1),
            None,
        );
        walk.friction = has_friction.then(|| [whole(0), whole(1)].map(Rc::new));

        let piece = Piece {
            max: None,
            anchor: None,
            tree,
        };
        walk.pieces(&[piece]).err().map(|at| at.fault)
    }

    /// What proves something of one friction only, or nothing, is no leaf of a tree over an
    /// interval of friction.
    #[test]
    fn a_tree_has_the_kinds_of_its_format() {
        assert_eq!(fault(vec![Node::PositiveDefinite], true), None);
        assert_eq!(fault(vec![Node::PositiveDefinite], false), None);

        let kind = |kind| Some(CoverFault::Kind { kind });
        assert_eq!(fault(vec![Node::Open], false), None);
        assert_eq!(fault(vec![Node::Open], true), kind("open"));

        let factor = || LdlFactor {
            rows: vec![vec![]],
            diagonal: vec![Number(whole(1))],
        };
        let ldl = || {
            vec![Node::Ldl(Box::new(Ldl {
                lower: factor(),
                upper: factor(),
            }))]
        };
        assert_eq!(fault(ldl(), false), None);
        assert_eq!(fault(ldl(), true), kind("ldl"));

        let definite = || Node::PositiveDefinite;
        let cut = || vec![Node::Friction(Number(whole(0))), definite(), definite()];
        assert_eq!(fault(cut(), false), kind("friction"));
        let outside = fault(cut(), true);
        assert!(matches!(outside, Some(CoverFault::FrictionCut { .. })));
    }

    #[test]
    fn a_tree_ends_when_its_last_region_is_closed() {
        let split = || Node::Split(Number(whole(1)));
        let definite = || Node::PositiveDefinite;

        assert_eq!(fault(vec![split(), definite(), definite()], true), None);
        let truncated = Some(CoverFault::Truncated { regions: 1 });
        assert_eq!(fault(vec![split(), definite()], false), truncated);
        let trailing = Some(CoverFault::Trailing);
        assert_eq!(fault(vec![definite(), definite()], false), trailing);
    }
}
