//! Complete sets: the cover of (supports) x (window) is walked, each leaf has its reason checked.
//!
//! What is proved: every solution in the certificate's window is one of those listed, up to a
//! positive factor, or lies in one of the open regions listed beside them.

mod condensed;
mod definite;
mod expanded;
mod family;
mod fault;
mod ldl;
mod leaf;
mod psd;
mod root;

pub use fault::CoverFault;

use super::AcceptedClaim;
use super::pencil::Rows;
use super::reason::Reason;
use crate::certificate::{CompleteSet, Node, Piece, Root, RootOutcome};
use crate::exact::{Integer, Interval, Rational};
use crate::model::Window;
use family::{Ends, Family, Linear};
use std::rc::Rc;

/// What a cover has proved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedCover {
    /// Every solution outside the open regions: exactly one per entry, by value and support.
    pub solutions: Vec<AcceptedClaim>,
    /// Where nothing is proved; empty for a complete set.
    pub open: Vec<OpenRegion>,
    /// Leaves checked.
    pub leaves: usize,
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
    ends: Option<Rc<Ends>>,
    zero: Integer,
}

/// A solution found in a leaf, unique in `hull` for its support.
struct Found {
    solution: AcceptedClaim,
    hull: Interval,
}

/// Checks a cover. `claims`: the certificate's claims in order, all accepted.
pub(super) fn check(rows: &Rows, window: &Window, claims: &[AcceptedSolution<'_>], cover: &CompleteSet) -> Result<AcceptedCover, Reason> {
    let index: Vec<usize> = (0..rows.order()).filter(|&i| !rows.is_free[i]).collect();
    let has_free = index.len() < rows.order();
    let whole = |fault| Reason::Cover { piece: None, node: None, fault };
    let family = match &cover.condensation {
        None if !has_free => Family::Linear(Linear::of(rows)),
        Some(condensation) if has_free => Family::Condensed(condensed::of(rows, condensation).map_err(whole)?),
        _ => return Err(whole(CoverFault::Condensation { expected: has_free })),
    };
    let tail = cover.condensation.as_ref().and_then(|c| c.tail.as_ref());
    if let Some(tail) = tail {
        condensed::tail(rows, tail).map_err(whole)?;
    }
    let tail = tail.map(|t| &t.from.0);
    let mut walk = Walk { rows, family, index, window, tail, claims, found: Vec::new(), open: Vec::new(), leaves: 0 };
    let mut lo = window.min().clone();
    for (k, piece) in cover.pieces.iter().enumerate() {
        let is_last = k + 1 == cover.pieces.len();
        walk.piece_end(&lo, piece, is_last).map_err(|fault| Reason::Cover { piece: Some(k), node: None, fault })?;
        walk.piece(&lo, piece).map_err(|(node, fault)| Reason::Cover { piece: Some(k), node: Some(node), fault })?;
        lo = piece.max.as_ref().map_or(lo, |n| n.0.clone());
    }
    if cover.pieces.is_empty() {
        return Err(whole(CoverFault::PieceEnd { expected: end(window.max()), got: lo.to_string() }));
    }
    let solutions = distinct(walk.found).map_err(whole)?;
    Ok(AcceptedCover { solutions, open: walk.open, leaves: walk.leaves })
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
    open: Vec<OpenRegion>,
    leaves: usize,
}

impl Walk<'_> {
    /// Pieces rise, and the last one ends the window. A window of one point is one piece.
    fn piece_end(&self, lo: &Rational, piece: &Piece, is_last: bool) -> Result<(), CoverFault> {
        let max = piece.max.as_ref().map(|n| &n.0);
        let got = || end(max);
        if is_last && max != self.window.max() {
            return Err(CoverFault::PieceEnd { expected: end(self.window.max()), got: got() });
        }
        let rises = max.is_none_or(|max| max > lo || (is_last && max == lo));
        let inside = is_last || max.is_some_and(|max| self.window.max().is_none_or(|end| max < end));
        if rises && inside {
            Ok(())
        } else {
            Err(CoverFault::PieceEnd { expected: format!("a value above {lo} within the window"), got: got() })
        }
    }

    /// Walks a tree in preorder with the regions still to be closed on a stack.
    fn piece(&mut self, lo: &Rational, piece: &Piece) -> Result<(), (usize, CoverFault)> {
        let hi = piece.max.as_ref().map(|n| n.0.clone());
        let states = vec![State::Open; self.index.len()];
        let mut stack = vec![Region { lo: lo.clone(), hi, states, ends: None, zero: Integer::default() }];
        for (k, node) in piece.tree.iter().enumerate() {
            let region = stack.pop().ok_or((k, CoverFault::Trailing))?;
            self.node(region, piece.anchor, node, &mut stack).map_err(|fault| (k, fault))?;
        }
        if stack.is_empty() { Ok(()) } else { Err((piece.tree.len(), CoverFault::Truncated { regions: stack.len() })) }
    }

    fn node(&mut self, mut region: Region, anchor: Option<usize>, node: &Node, stack: &mut Vec<Region>) -> Result<(), CoverFault> {
        match node {
            Node::Split(at) => {
                let at = &at.0;
                if *at <= region.lo || region.hi.as_ref().is_some_and(|hi| at >= hi) {
                    return Err(CoverFault::Cut { lo: region.lo, hi: end(region.hi.as_ref()), got: at.clone() });
                }
                stack.push(Region { lo: at.clone(), ends: None, states: region.states.clone(), zero: Integer::default(), hi: region.hi });
                stack.push(Region { hi: Some(at.clone()), ends: None, ..region });
                return Ok(());
            }
            Node::Branch(index) => {
                let position = self.index.iter().position(|i| i == index).filter(|&p| region.states[p] == State::Open);
                let position = position.ok_or(CoverFault::Branch { index: *index })?;
                if region.ends.is_none() {
                    region.ends = Some(self.ends(&region, anchor)?); // shared by both children
                }
                let mut moving = region.states.clone();
                moving[position] = State::Moving;
                region.states[position] = State::Rest;
                stack.push(Region {
                    lo: region.lo.clone(),
                    hi: region.hi.clone(),
                    ends: region.ends.clone(),
                    states: moving,
                    zero: Integer::default(),
                });
                stack.push(region);
                return Ok(());
            }
            Node::Tail => match self.tail {
                Some(from) if *from <= region.lo => {}
                _ => return Err(CoverFault::Hypothesis { expected: "a tail that begins at or below the region", row: 0 }),
            },
            Node::Open => self.open.push(self.left_open(&region)),
            Node::Farkas(w) => leaf::farkas(&region, &*self.ends(&region, anchor)?, &self.index, w)?,
            Node::PositiveDefinite => leaf::definite(&region, &*self.ends(&region, anchor)?, 1)?,
            Node::NegativeDefinite => leaf::definite(&region, &*self.ends(&region, anchor)?, -1)?,
            Node::Ldl(witness) => ldl::check(self.rows, &region, &self.index, witness)?,
            Node::Root(root) => {
                let found = self.root(&region, anchor, root)?;
                self.found.extend(found);
            }
        }
        self.leaves += 1;
        Ok(())
    }

    fn ends(&self, region: &Region, anchor: Option<usize>) -> Result<Rc<Ends>, CoverFault> {
        match &region.ends {
            Some(ends) => Ok(Rc::clone(ends)),
            None => Ok(Rc::new(self.family.ends(anchor, &region.lo, region.hi.as_ref())?)),
        }
    }

    fn left_open(&self, region: &Region) -> OpenRegion {
        let of = |state| (0..self.index.len()).filter(|&i| region.states[i] == state).map(|i| self.index[i]).collect();
        OpenRegion { min: region.lo.clone(), max: region.hi.clone(), moving: of(State::Moving), undecided: of(State::Open) }
    }

    /// A root leaf; the solution in it, if there is one.
    fn root(&self, region: &Region, anchor: Option<usize>, root: &Root) -> Result<Option<Found>, CoverFault> {
        let [a, b] = [&root.interval[0].0, &root.interval[1].0];
        let outside = || CoverFault::Interval { a: a.clone(), b: b.clone() };
        let value = Interval::new(a.clone(), b.clone()).ok_or_else(outside)?;
        let may_be_point = matches!(root.outcome, RootOutcome::Claim(_) | RootOutcome::Absent);
        if a < self.window.min() || self.window.max().is_some_and(|max| b > max) || (a == b && !may_be_point) {
            return Err(outside());
        }
        let hi = region.hi.as_ref().ok_or(CoverFault::RootTooEarly)?;
        let (hull_lo, hull_hi) = ((&region.lo).min(a), hi.max(b));
        let hull = Interval::new(hull_lo.clone(), hull_hi.clone()).ok_or_else(outside)?;
        let wide = self.family.ends(anchor, hull_lo, Some(hull_hi))?;
        let narrow = self.family.ends(anchor, a, Some(b))?;
        root::check(region, &wide, &narrow, &self.index, root)?;
        let support = self.left_open(region).moving;
        match root.outcome {
            RootOutcome::Solution => Ok(Some(Found { solution: AcceptedClaim { support, value }, hull })),
            RootOutcome::Absent | RootOutcome::NegativeX(_) | RootOutcome::NegativeY(_) => Ok(None),
            RootOutcome::Claim(claim) => {
                let known = self.claims.get(claim).ok_or(CoverFault::NotTheClaim { claim })?;
                let (s, v) = (&known.claim.support, &known.claim.value);
                // Its x is a null vector of the leaf's block if it moves nothing else and y = 0 there.
                let is_null = s.iter().all(|i| support.contains(i))
                    && !s.is_empty()
                    && support.iter().all(|i| s.contains(i) || known.biactive.contains(i));
                if !is_null || v.lo() < a || v.hi() > b {
                    return Err(CoverFault::NotTheClaim { claim });
                }
                Ok((*s == support).then(|| Found { solution: known.claim.clone(), hull }))
            }
        }
    }
}

/// Lists each solution once. Two of one support are the same if one lies where the other is unique.
fn distinct(mut found: Vec<Found>) -> Result<Vec<AcceptedClaim>, CoverFault> {
    found.sort_by(|p, q| {
        (&p.solution.support, p.solution.value.lo(), p.solution.value.hi()).cmp(&(
            &q.solution.support,
            q.solution.value.lo(),
            q.solution.value.hi(),
        ))
    });
    let mut kept: Vec<Found> = Vec::new();
    // Those that are the solution kept last: what is one of them is that solution.
    let mut group: Vec<Found> = Vec::new();
    for next in found {
        let overlaps = |f: &Found| f.solution.support == next.solution.support && f.solution.value.hi() >= next.solution.value.lo();
        if !group.iter().any(overlaps) {
            kept.extend(group.drain(..).next());
            group.push(next);
            continue;
        }
        let within = |v: &Interval, hull: &Interval| v.lo() >= hull.lo() && v.hi() <= hull.hi();
        let same = |f: &Found| within(&next.solution.value, &f.hull) || within(&f.solution.value, &next.hull);
        if !group.iter().any(same) {
            return Err(CoverFault::Ambiguous { support: next.solution.support });
        }
        group.push(next);
    }
    kept.extend(group.drain(..).next());
    let mut list: Vec<AcceptedClaim> = kept.into_iter().map(|f| f.solution).collect();
    list.sort_by(|p, q| (p.value.lo(), &p.support).cmp(&(q.value.lo(), &q.support)));
    Ok(list)
}
