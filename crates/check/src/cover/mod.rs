//! Complete sets: the cover of (supports) x (window) is walked, each leaf has its reason checked.
//!
//! What is proved: every solution in the certificate's window is one of those listed, up to a
//! positive factor, or lies in one of the open regions listed beside them.

mod beside;
mod condensed;
mod definite;
mod expanded;
mod family;
mod fault;
mod found;
mod infinity;
mod ldl;
mod leaf;
mod product;
mod psd;
mod root;
mod rootless;
mod short;
mod support;

pub use beside::Place;
pub use fault::CoverFault;
pub use found::SolutionFamily;

use super::AcceptedClaim;
use super::pencil::Rows;
use super::reason::Reason;
use crate::certificate::{CompleteSet, Node, Piece, Root, RootOutcome, Support};
use family::{Ends, Family, Linear};
use mceip_exact::{Interval, Rational};
use mceip_model::Window;
use num_traits::Zero;
use rootless::Budget;
use short::Short;
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use support::Held;

/// Largest number of complementarity variables of a cover: a region has dense matrices of this
/// order.
pub const MAX_COVERED: usize = 900;

/// Largest product of the number of anchors and the square of the number of complementarity
/// variables: an anchor is expanded into dense matrices of that order.
const MAX_EXPANDED: usize = 3 << 20;

/// Orders cubed of definite leaves, summed over a file: without any node or entry, for each node,
/// and for each entry of the pencil. Elimination takes a third of the cube.
const DEFINITE_BASE: u64 = 1 << 29;
const DEFINITE_PER_NODE: u64 = 1 << 20;
const DEFINITE_PER_ENTRY: u64 = 1 << 16;

/// Products of machine words for the matrices of all regions of a file: without any node, and for
/// each node.
const MATRIX_BASE: u64 = 1 << 30;
const MATRIX_PER_NODE: u64 = 1 << 24;

/// What the definite leaves of a file may cost in all (spec/certificates.md, Limits).
fn definite_budget(rows: &Rows, cover: &CompleteSet) -> u64 {
    let mut entries = 0;
    for row in &rows.rows {
        entries += row
            .iter()
            .filter(|(_, a, b)| !(a.is_zero() && b.is_zero()))
            .count();
    }

    let by_nodes = DEFINITE_PER_NODE.saturating_mul(nodes(cover));
    let by_entries = DEFINITE_PER_ENTRY.saturating_mul(entries as u64);
    DEFINITE_BASE
        .saturating_add(by_nodes)
        .saturating_add(by_entries)
}

/// What the matrices of all regions may cost (spec/certificates.md, Limits).
fn matrix_budget(cover: &CompleteSet) -> u64 {
    MATRIX_BASE.saturating_add(MATRIX_PER_NODE.saturating_mul(nodes(cover)))
}

fn nodes(cover: &CompleteSet) -> u64 {
    cover
        .pieces
        .iter()
        .map(|piece| piece.tree.len() as u64)
        .sum()
}

/// What a cover has proved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedCover {
    /// Every solution outside the open regions: exactly one per entry, by value and support.
    pub solutions: Vec<AcceptedClaim>,
    /// Every support that has more than isolated single solutions outside the open regions, and
    /// where.
    pub families: Vec<SolutionFamily>,
    /// Where nothing is proved; empty for a complete set.
    pub open: Vec<OpenRegion>,
    /// Leaves checked.
    pub leaves: usize,
}

impl AcceptedCover {
    /// Is there no solution at all in the window, families included?
    pub fn proves_absence(&self) -> bool {
        self.solutions.is_empty() && self.is_plain_list()
    }

    /// Is `solutions` everything there is: nothing open, and no families beside it?
    pub fn is_plain_list(&self) -> bool {
        self.families.is_empty() && self.open.is_empty()
    }
}

/// A part of (supports) x (window) that the cover leaves open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OpenRegion {
    /// Lower end of the interval.
    pub min: Rational,
    /// Upper end, `None` for infinity.
    pub max: Option<Rational>,
    /// Variables known to move: x_i > 0.
    pub moving: Vec<usize>,
    /// Variables not decided.
    pub undecided: Vec<usize>,
}

/// State of a complementarity variable at a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Open,
    /// x_i = 0.
    Rest,
    /// x_i > 0, y_i = 0.
    Moving,
}

/// A node's region.
struct Region {
    lo: Rational,
    hi: Option<Rational>,
    states: Vec<State>,
    matrices: Rc<Matrices>,
}

/// The ends of an interval, computed when they are asked for; regions of one interval share them.
#[derive(Default)]
struct Matrices {
    exact: RefCell<Option<Rc<Ends>>>,
    /// `Some(None)`: there are no short numbers for them.
    short: RefCell<Option<Option<Rc<[Short; 2]>>>>,
}

impl Matrices {
    /// A region that is split is done with them; its siblings compute them again. So a deep tree of
    /// splits holds the matrices of one interval.
    fn forget(&self) {
        self.exact.take();
        self.short.take();
    }
}

/// A solution found in a leaf, unique in `hull` for its support.
struct Found {
    solution: AcceptedClaim,
    hull: Interval,
}

/// Checks a cover. `claims`: the certificate's claims in order, all accepted. With `refused` a leaf
/// that fails is taken for an open one and noted there (piece, node).
pub(super) fn check(
    rows: &Rows,
    window: &Window,
    claims: &[AcceptedSolution<'_>],
    cover: &CompleteSet,
    refused: Option<&mut Vec<(usize, usize)>>,
) -> Result<AcceptedCover, Reason> {
    let index: Vec<usize> = (0..rows.order()).filter(|&i| !rows.is_free[i]).collect();
    let has_free = index.len() < rows.order();
    let whole = |fault| Reason::Cover {
        piece: None,
        node: None,
        fault,
    };
    if index.len() > MAX_COVERED {
        let (limit, got) = (MAX_COVERED as u64, index.len() as u64);
        return Err(whole(CoverFault::TooLarge {
            what: "complementarity variables of a cover",
            limit,
            got,
        }));
    }
    let anchors = cover.condensation.as_ref().map_or(0, |c| c.anchors.len());
    let expanded = anchors.saturating_mul(index.len() * index.len());
    if expanded > MAX_EXPANDED {
        let (limit, got) = (MAX_EXPANDED as u64, expanded as u64);
        let what = "anchors times complementarity variables squared";
        return Err(whole(CoverFault::TooLarge { what, limit, got }));
    }
    let family = match &cover.condensation {
        None if !has_free => Family::Linear(Linear::of(rows)),
        Some(condensation) if has_free => {
            let list = condensed::of(rows, condensation).map_err(whole)?;
            Family::Condensed(
                list.into_iter()
                    .map(|e| (e.short(), e))
                    .map(|(short, e)| (e, short))
                    .collect(),
            )
        }
        _ => return Err(whole(CoverFault::Condensation { expected: has_free })),
    };
    let tail = cover.condensation.as_ref().and_then(|c| c.tail.as_ref());
    if let Some(tail) = tail {
        condensed::tail(rows, tail).map_err(whole)?;
    }
    let tail = tail.map(|t| &t.from.0);
    let mut walk = Walk {
        rows,
        family,
        index,
        window,
        tail,
        claims,
        found: Vec::new(),
        families: Vec::new(),
        open: Vec::new(),
        leaves: 0,
        budget: Budget::new(),
        definite_left: definite_budget(rows, cover),
        matrices_left: Cell::new(matrix_budget(cover)),
        refused,
    };
    let mut lo = window.min().clone();
    for (k, piece) in cover.pieces.iter().enumerate() {
        let is_last = k + 1 == cover.pieces.len();
        walk.anchor(piece).map_err(|fault| Reason::Cover {
            piece: Some(k),
            node: None,
            fault,
        })?;
        walk.piece_end(&lo, piece, is_last)
            .map_err(|fault| Reason::Cover {
                piece: Some(k),
                node: None,
                fault,
            })?;
        walk.piece(k, &lo, piece)
            .map_err(|(node, fault)| Reason::Cover {
                piece: Some(k),
                node: Some(node),
                fault,
            })?;
        lo = piece.max.as_ref().map_or(lo, |n| n.0.clone());
    }
    if cover.pieces.is_empty() {
        return Err(whole(CoverFault::PieceEnd {
            expected: end(window.max()),
            got: lo.to_string(),
        }));
    }
    let families = found::families(&mut walk.found, walk.families);
    let solutions = found::distinct(walk.found).map_err(whole)?;
    Ok(AcceptedCover {
        solutions,
        families,
        open: walk.open,
        leaves: walk.leaves,
    })
}

/// A solution claim that has been accepted, with its biactive set.
pub(super) struct AcceptedSolution<'a> {
    pub(super) claim: AcceptedClaim,
    pub(super) biactive: &'a [usize],
}

fn end(max: Option<&Rational>) -> String {
    max.map_or_else(|| "infinity".into(), ToString::to_string)
}

struct Walk<'a> {
    rows: &'a Rows,
    family: Family,
    /// The complementarity variables: positions in states and matrices to indices of the problem.
    index: Vec<usize>,
    window: &'a Window,
    /// Nothing lies at or above this.
    tail: Option<&'a Rational>,
    claims: &'a [AcceptedSolution<'a>],
    found: Vec<Found>,
    families: Vec<SolutionFamily>,
    open: Vec<OpenRegion>,
    leaves: usize,
    /// For the signs of support leaves.
    budget: Budget,
    /// For definite leaves: orders cubed.
    definite_left: u64,
    /// For the matrices of regions: products of machine words.
    matrices_left: Cell<u64>,
    /// Where leaves that fail are noted, if they are to be taken for open ones.
    refused: Option<&'a mut Vec<(usize, usize)>>,
}

impl Walk<'_> {
    /// An anchor that is named exists. Without a condensation it is ignored.
    fn anchor(&self, piece: &Piece) -> Result<(), CoverFault> {
        let Family::Condensed(list) = &self.family else {
            return Ok(());
        };
        match piece.anchor {
            Some(k) if k >= list.len() => Err(CoverFault::Anchor {
                anchors: list.len(),
                got: Some(k),
            }),
            _ => Ok(()),
        }
    }

    /// Pieces rise, and the last one ends the window. A window of one point is one piece.
    fn piece_end(&self, lo: &Rational, piece: &Piece, is_last: bool) -> Result<(), CoverFault> {
        let max = piece.max.as_ref().map(|n| &n.0);
        let got = || end(max);
        if is_last && max != self.window.max() {
            return Err(CoverFault::PieceEnd {
                expected: end(self.window.max()),
                got: got(),
            });
        }
        let rises = max.is_none_or(|max| max > lo || (is_last && max == lo));
        let inside =
            is_last || max.is_some_and(|max| self.window.max().is_none_or(|end| max < end));
        if rises && inside {
            Ok(())
        } else {
            Err(CoverFault::PieceEnd {
                expected: format!("a value above {lo} within the window"),
                got: got(),
            })
        }
    }

    /// Walks a tree in preorder with the regions still to be closed on a stack.
    fn piece(
        &mut self,
        number: usize,
        lo: &Rational,
        piece: &Piece,
    ) -> Result<(), (usize, CoverFault)> {
        let hi = piece.max.as_ref().map(|n| n.0.clone());
        let states = vec![State::Open; self.index.len()];
        let mut stack = vec![Region {
            lo: lo.clone(),
            hi,
            states,
            matrices: Rc::default(),
        }];
        for (k, node) in piece.tree.iter().enumerate() {
            let region = stack.pop().ok_or((k, CoverFault::Trailing))?;
            match node {
                Node::Split(_) | Node::Branch(_) => self
                    .inner(region, node, &mut stack)
                    .map_err(|fault| (k, fault))?,
                _ => match (
                    self.leaf(&region, piece.anchor, node),
                    self.refused.as_mut(),
                ) {
                    (Err(_), Some(refused)) => {
                        refused.push((number, k));
                        self.open.push(self.left_open(&region));
                    }
                    (verdict, _) => verdict.map_err(|fault| (k, fault))?,
                },
            }
        }
        if stack.is_empty() {
            Ok(())
        } else {
            Err((
                piece.tree.len(),
                CoverFault::Truncated {
                    regions: stack.len(),
                },
            ))
        }
    }

    /// A cut or a branch: its two regions.
    fn inner(
        &self,
        mut region: Region,
        node: &Node,
        stack: &mut Vec<Region>,
    ) -> Result<(), CoverFault> {
        match node {
            Node::Split(at) => {
                let at = &at.0;
                if *at <= region.lo || region.hi.as_ref().is_some_and(|hi| at >= hi) {
                    return Err(CoverFault::Cut {
                        lo: region.lo,
                        hi: end(region.hi.as_ref()),
                        got: at.clone(),
                    });
                }
                region.matrices.forget();
                let (lo, states) = (at.clone(), region.states.clone());
                stack.push(Region {
                    lo,
                    hi: region.hi,
                    states,
                    matrices: Rc::default(),
                });
                stack.push(Region {
                    hi: Some(at.clone()),
                    matrices: Rc::default(),
                    ..region
                });
            }
            Node::Branch(index) => {
                let position = self
                    .index
                    .iter()
                    .position(|i| i == index)
                    .filter(|&p| region.states[p] == State::Open);
                let position = position.ok_or(CoverFault::Branch { index: *index })?;
                let mut moving = region.states.clone();
                moving[position] = State::Moving;
                region.states[position] = State::Rest;
                stack.push(Region {
                    lo: region.lo.clone(),
                    hi: region.hi.clone(),
                    matrices: Rc::clone(&region.matrices),
                    states: moving,
                });
                stack.push(region);
            }
            _ => {}
        }
        Ok(())
    }

    fn leaf(
        &mut self,
        region: &Region,
        anchor: Option<usize>,
        node: &Node,
    ) -> Result<(), CoverFault> {
        self.leaves += 1;
        match node {
            Node::Split(_) | Node::Branch(_) => {} // not a leaf
            Node::Tail => match self.tail {
                Some(from) if *from <= region.lo => {}
                _ => {
                    return Err(CoverFault::Hypothesis {
                        expected: "a tail that begins at or below the region",
                        row: 0,
                    });
                }
            },
            Node::Open => self.open.push(self.left_open(region)),
            Node::Farkas(w) => {
                self.affordable(region, anchor)?;
                let short = self.short(region, anchor);
                leaf::farkas(
                    region,
                    short.as_deref(),
                    || self.ends(region, anchor),
                    &self.index,
                    w,
                )?;
            }
            Node::PositiveDefinite => self.definite(region, anchor, 1)?,
            Node::NegativeDefinite => self.definite(region, anchor, -1)?,
            Node::Ldl(witness) => ldl::check(self.rows, region, &self.index, witness)?,
            Node::Root(root) => {
                let found = self.root(region, anchor, root)?;
                self.found.extend(found);
            }
            Node::Support(leaf) => self.support(region, leaf)?,
        }
        Ok(())
    }

    fn definite(
        &mut self,
        region: &Region,
        anchor: Option<usize>,
        sign: i8,
    ) -> Result<(), CoverFault> {
        self.spend_definite(region)?;
        self.affordable(region, anchor)?;
        let short = self.short(region, anchor);
        leaf::definite(
            region,
            short.as_deref(),
            || self.ends(region, anchor),
            &self.index,
            sign,
        )
    }

    /// A definite leaf costs the cube of the number of variables that may move.
    fn spend_definite(&mut self, region: &Region) -> Result<(), CoverFault> {
        let order = region
            .states
            .iter()
            .filter(|state| **state != State::Rest)
            .count() as u64;
        let cost = order.saturating_pow(3);

        let what = "definite leaves: order cubed, left of the file's budget";
        let too_large = CoverFault::TooLarge {
            what,
            limit: self.definite_left,
            got: cost,
        };
        self.definite_left = self.definite_left.checked_sub(cost).ok_or(too_large)?;
        Ok(())
    }

    fn ends(&self, region: &Region, anchor: Option<usize>) -> Result<Rc<Ends>, CoverFault> {
        if let Some(ends) = &*region.matrices.exact.borrow() {
            return Ok(Rc::clone(ends));
        }
        self.spend_matrix(anchor, &region.lo, region.hi.as_ref())?;
        let ends = Rc::new(self.family.ends(anchor, &region.lo, region.hi.as_ref())?);
        region.matrices.exact.replace(Some(Rc::clone(&ends)));
        Ok(ends)
    }

    /// The same in short numbers, where there are such.
    fn short(&self, region: &Region, anchor: Option<usize>) -> Option<Rc<[Short; 2]>> {
        if let Some(known) = &*region.matrices.short.borrow() {
            return known.clone();
        }
        let linear = self.family.short(anchor, &region.lo, region.hi.as_ref());
        let short = match (linear, &self.family) {
            (None, Family::Condensed(_)) => {
                self.ends(region, anchor).ok().and_then(|ends| ends.short())
            }
            (short, _) => short,
        };
        let short = short.map(Rc::new);
        region.matrices.short.replace(Some(short.clone()));
        short
    }

    /// Leaves that need the matrices of their interval may ask for so much and no more.
    fn affordable(&self, region: &Region, anchor: Option<usize>) -> Result<(), CoverFault> {
        self.family
            .affordable(anchor, &region.lo, region.hi.as_ref())
    }

    /// The matrices of an interval are computed by Horner's rule, entry by entry.
    fn spend_matrix(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<(), CoverFault> {
        let cost = self.family.matrix_work(anchor, lo, hi);
        let limit = self.matrices_left.get();

        let what = "matrices of regions: products of words, left of the file's budget";
        let left = limit.checked_sub(cost).ok_or(CoverFault::TooLarge {
            what,
            limit,
            got: cost,
        })?;
        self.matrices_left.set(left);
        Ok(())
    }

    fn left_open(&self, region: &Region) -> OpenRegion {
        let of = |state| {
            (0..self.index.len())
                .filter(|&i| region.states[i] == state)
                .map(|i| self.index[i])
                .collect()
        };
        OpenRegion {
            min: region.lo.clone(),
            max: region.hi.clone(),
            moving: of(State::Moving),
            undecided: of(State::Open),
        }
    }

    /// A support leaf; isolated single solutions are listed, the others are families.
    fn support(&mut self, region: &Region, leaf: &Support) -> Result<(), CoverFault> {
        let support = self.left_open(region).moving;
        for Held {
            from,
            to,
            is_point,
            is_alone,
            hull,
        } in support::check(self.rows, region, &self.index, leaf, &self.budget)?
        {
            let support = support.clone();
            match hull {
                Some(hull) if is_alone => self.found.push(Found {
                    solution: AcceptedClaim {
                        support,
                        value: from,
                    },
                    hull,
                }),
                _ => self.families.push(SolutionFamily {
                    support,
                    from,
                    to,
                    is_point,
                    is_alone,
                }),
            }
        }
        Ok(())
    }

    /// A root leaf; the solution in it, if there is one.
    fn root(
        &self,
        region: &Region,
        anchor: Option<usize>,
        root: &Root,
    ) -> Result<Option<Found>, CoverFault> {
        let [a, b] = [&root.interval[0].0, &root.interval[1].0];
        let outside = || CoverFault::Interval {
            a: a.clone(),
            b: b.clone(),
        };
        let value = Interval::new(a.clone(), b.clone()).ok_or_else(outside)?;
        let may_be_point = matches!(
            root.outcome,
            RootOutcome::Claim(_) | RootOutcome::Absent | RootOutcome::Infinity(_)
        );
        if a < self.window.min()
            || self.window.max().is_some_and(|max| b > max)
            || (a == b && !may_be_point)
        {
            return Err(outside());
        }
        self.is_meant_for(region, anchor, &root.outcome)?;
        let (hull_lo, hull_hi) = ((&region.lo).min(a), region.hi.as_ref().map(|hi| hi.max(b)));
        // What is alone up to infinity is alone up to b.
        let hull =
            Interval::new(hull_lo.clone(), hull_hi.unwrap_or(b).clone()).ok_or_else(outside)?;
        self.spend_matrix(anchor, hull_lo, hull_hi)?;
        let wide = self.family.hull_ends(anchor, hull_lo, hull_hi)?;
        let narrow = || {
            self.spend_matrix(anchor, a, Some(b))?;
            self.family.ends(anchor, a, Some(b))
        };
        root::check(region, &wide, narrow, &self.index, root)?;
        let support = self.left_open(region).moving;
        match root.outcome {
            RootOutcome::Infinity(ref x) => infinity::null_vector(
                self.rows,
                &support,
                region.hi.is_none(),
                self.family.is_reversed(anchor),
                x,
            )
            .map(|()| None),
            RootOutcome::Solution => Ok(Some(Found {
                solution: AcceptedClaim { support, value },
                hull,
            })),
            RootOutcome::Absent | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => Ok(None),
            RootOutcome::Claim(claim) => {
                let known = self
                    .claims
                    .get(claim)
                    .ok_or(CoverFault::NotTheClaim { claim })?;
                let (s, v) = (&known.claim.support, &known.claim.value);
                // Its x is a null vector of the leaf's block if it moves nothing else and y = 0
                // there.
                let is_null = s.iter().all(|i| support.contains(i))
                    && !s.is_empty()
                    && support
                        .iter()
                        .all(|i| s.contains(i) || known.biactive.contains(i));
                if !is_null || v.lo() < a || v.hi() > b {
                    return Err(CoverFault::NotTheClaim { claim });
                }
                Ok((*s == support).then(|| Found {
                    solution: known.claim.clone(),
                    hull,
                }))
            }
        }
    }

    /// Outcomes that need a narrow interval on a chord are refused by name: over a half line
    /// without a reversed anchor only `absent`, `infinity` and `claim` are read.
    fn is_meant_for(
        &self,
        region: &Region,
        anchor: Option<usize>,
        outcome: &RootOutcome,
    ) -> Result<(), CoverFault> {
        let is_chord = region.hi.is_none() && !self.family.is_reversed(anchor);

        let outcome = match outcome {
            RootOutcome::Solution => "solution",
            RootOutcome::NegativeX(_) => "negative_x",
            RootOutcome::NegativeY(_) => "negative_y",
            RootOutcome::Absent | RootOutcome::Claim(_) | RootOutcome::Infinity(_) => return Ok(()),
        };

        if is_chord {
            Err(CoverFault::OutcomeOnHalfLine { outcome })
        } else {
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Integer, rational, whole};
    use mceip_model::file::Number;

    /// Three variables that may move cost 27; the second leaf does not find enough left.
    #[test]
    fn definite_leaves_spend_a_budget() {
        let row = |i: usize| vec![(i, Integer::from(3), Integer::from(1))];
        let rows = Rows {
            rows: (0..4).map(row).collect(),
            factor: vec![1.into(); 4],
            is_free: vec![false; 4],
        };
        let window = Window::all();
        let mut walk = walk(&rows, &window);
        walk.definite_left = 50;

        let mut states = vec![State::Open, State::Moving, State::Open];
        states.push(State::Rest);
        let region = Region {
            lo: whole(0),
            hi: Some(whole(1)),
            states,
            matrices: Rc::default(),
        };

        assert_eq!(walk.spend_definite(&region), Ok(()));
        assert_eq!(walk.definite_left, 23);
        let what = "definite leaves: order cubed, left of the file's budget";
        assert_eq!(
            walk.spend_definite(&region),
            Err(CoverFault::TooLarge {
                what,
                limit: 23,
                got: 27
            })
        );
    }

    /// What a file may spend on definite leaves: 2^29, 2^20 a node, 2^16 an entry that is not zero.
    #[test]
    fn the_budget_grows_with_nodes_and_entries() {
        let row = |i: usize| {
            vec![
                (i, Integer::from(3), Integer::from(0)),
                (1 - i, Integer::from(0), Integer::from(0)),
            ]
        };
        let rows = Rows {
            rows: vec![row(0), row(1)],
            factor: vec![1.into(); 2],
            is_free: vec![false; 2],
        };
        let piece = |nodes: usize| Piece {
            max: None,
            anchor: None,
            tree: vec![Node::Open; nodes],
        };

        let cover = CompleteSet {
            condensation: None,
            pieces: vec![piece(3), piece(4)],
        };
        assert_eq!(
            definite_budget(&rows, &cover),
            (1 << 29) + 7 * (1 << 20) + 2 * (1 << 16)
        );
        assert_eq!(matrix_budget(&cover), (1 << 30) + 7 * (1 << 24));
    }

    /// Two variables over [1/3, 2]: four entries, K = 1, ends of 128 + 3 + 3 bits in 3 words,
    /// entries of 128 bits in 3.
    #[test]
    fn matrices_of_regions_spend_a_budget_once_an_interval() {
        let row = |i: usize| vec![(i, Integer::from(3), Integer::from(1))];
        let rows = Rows {
            rows: vec![row(0), row(1)],
            factor: vec![1.into(); 2],
            is_free: vec![false; 2],
        };
        let window = Window::all();
        let walk = walk(&rows, &window);
        let region = || Region {
            lo: rational(1, 3),
            hi: Some(whole(2)),
            states: vec![State::Open; 2],
            matrices: Rc::default(),
        };

        let cost = 4 * 3 * (3 + 3);
        walk.matrices_left.set(2 * cost - 1);
        let shared = region();
        assert!(walk.ends(&shared, None).is_ok());
        assert!(walk.ends(&shared, None).is_ok());
        assert_eq!(walk.matrices_left.get(), cost - 1);

        let what = "matrices of regions: products of words, left of the file's budget";
        let refused = walk.ends(&region(), None).err();
        assert_eq!(
            refused,
            Some(CoverFault::TooLarge {
                what,
                limit: cost - 1,
                got: cost
            })
        );
    }

    /// A root leaf of -6 + t over [5, 7] needs the matrices of its hull and of its interval: 3 (3 +
    /// 3) each.
    #[test]
    fn root_leaves_spend_the_same_budget() {
        let rows = Rows {
            rows: vec![vec![(0, Integer::from(-6), Integer::from(1))]],
            factor: vec![1.into()],
            is_free: vec![false],
        };
        let window = Window::all();
        let walk = walk(&rows, &window);
        let region = Region {
            lo: whole(5),
            hi: Some(whole(7)),
            states: vec![State::Moving],
            matrices: Rc::default(),
        };
        let interval = [whole(5), whole(7)].map(Number);
        let (inverse, left, right) = (vec![], vec![], vec![]);
        let outcome = RootOutcome::Solution;
        let root = Root {
            pivot: 0,
            interval,
            inverse,
            inverse_exponent: 0,
            left,
            right,
            exponent: 0,
            outcome,
        };

        let cost = 3 * (3 + 3);
        walk.matrices_left.set(2 * cost);
        assert!(walk.root(&region, None, &root).unwrap().is_some());
        assert_eq!(walk.matrices_left.get(), 0);

        let what = "matrices of regions: products of words, left of the file's budget";
        let refused = Some(CoverFault::TooLarge {
            what,
            limit: cost - 1,
            got: cost,
        });
        for left in [cost - 1, 2 * cost - 1] {
            walk.matrices_left.set(left);
            assert_eq!(walk.root(&region, None, &root).err(), refused, "{left}");
        }
    }

    fn walk<'a>(rows: &'a Rows, window: &'a Window) -> Walk<'a> {
        Walk {
            rows,
            family: Family::Linear(Linear::of(rows)),
            index: (0..rows.order()).collect(),
            window,
            tail: None,
            claims: &[],
            found: Vec::new(),
            families: Vec::new(),
            open: Vec::new(),
            leaves: 0,
            budget: Budget::new(),
            definite_left: 0,
            matrices_left: Cell::new(0),
            refused: None,
        }
    }

    #[test]
    fn a_region_has_short_numbers() {
        let row = |i: usize| vec![(i, Integer::from(3), Integer::from(1))];
        let rows = Rows {
            rows: vec![row(0), row(1)],
            factor: vec![1.into(), 1.into()],
            is_free: vec![false; 2],
        };
        let window = Window::all();
        let walk = walk(&rows, &window);
        let states = vec![State::Open; 2];
        let region = Region {
            lo: whole(0),
            hi: Some(whole(1)),
            states,
            matrices: Rc::default(),
        };
        assert!(walk.short(&region, None).is_some());
    }
}
