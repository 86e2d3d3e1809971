//! Absence below a friction: a cover of (supports) x [0, infinity) x [from, below].
//!
//! For a mechanical system the condensed pencil is affine in mu, T(t, mu) = T0(t) + mu T1(t), with
//! t = lambda^2: only the slip rows depend on mu, and the elimination of the free variables uses
//! the free rows and columns alone. Each part is enclosed over an interval of t as in `family`, and
//! both by convex combinations with the same weights.
//!
//! A *box* is an interval of t, an interval [lower, higher] of mu and a state of each slip
//! variable. Its *corners* are, for both ends e of the interval of t and both ends k of that of mu,
//!
//! ```text
//!     M_e0 + mu_k M_e1    with the radius    R_e0 + mu_k R_e1.
//! ```
//!
//! T is linear in mu for every t, so every T(t, mu) of the box is a convex combination of matrices
//! within these radii; at an infinite end, of those at the lower end plus a non-negative multiple
//! of such a combination at the upper one. Leaves prove what is linear in T at the four corners,
//! with the code for covers of one window (`farkas`, `definite`). Those of `regular` prove what is
//! convex in T. As there, short numbers are tried first, and the long ones decide where these
//! cannot tell.
//!
//! *Tail.* Above some t sym(A + tB) of the whole pencil is positive definite, and sym(B) is
//! semidefinite, at mu = `from` and at mu = `below`, so at every mu between. The pencil is that of
//! the system in which the particles with zero reaction are free (`spec/zero-reaction.md`, Z.4).
//!
//! *Zero reaction.* Particles in contact with zero reaction have three variables each, whose rows
//! are affine in mu as well. A branch on one half of v_T puts the other half at rest where the
//! first one moves.
//!
//! Every leaf proves that its box holds no solution. Trees are read as in `walk`, with one more
//! node that cuts the interval of mu.

use super::bordered::{Bordered, NullWitness};
use super::budget::{WorkBudget, entries_work};
use super::condensed::Anchors;
use super::ends::{Corner, Ends, FRACTION_BITS, rational_bits, within_matrix_bits};
use super::family::{Family, Linear, end_bits, row_bits, words};
use super::fault::CoverFault;
use super::region::{Matrices, Region, State};
use super::short::Short;
use super::walk::NodeFault;
use super::{check_end, check_size, condensed, definite, expand_anchor, farkas, regular};
use crate::LeafPlace;
use crate::certificate::{
    CriticalCertificate, CriticalCondensation, CriticalNode, CriticalPiece, CriticalTail, Regular,
};
use crate::pencil::{FrictionParts, Rows};
use crate::reason::Reason;
use mceip_exact::Rational;
use mceip_model::Window;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The corners of a box, as messages name them: first those at the lower friction.
const CORNERS: [[&str; 2]; 2] = [
    ["lower, low-friction", "upper, low-friction"],
    ["lower, high-friction", "upper, high-friction"],
];

/// A box has the matrices of two parts, which are there at the same time.
pub(super) const PARTS: usize = 2;

/// Checks that the boxes cover everything and that each holds no solution. Returns the number of
/// leaves.
///
/// With an audit, leaves that fail are passed over, and what is returned means nothing if the audit
/// was stopped.
pub(crate) fn check(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    audit: Option<&Audit<'_>>,
) -> Result<usize, Reason> {
    let is_free = &parts.plain.is_free;
    let index: Vec<usize> = (0..is_free.len()).filter(|&i| !is_free[i]).collect();
    let condensation = certificate.condensation.as_ref();
    // Each anchor is expanded for both parts.
    let expansions = condensation.map_or(0, |c| c.anchors.len().saturating_mul(2));
    check_size(index.len(), expansions).map_err(of_file)?;

    let anchors = anchors(parts, condensation).map_err(of_file)?;
    let families = families(parts, anchors.as_ref());
    let tail = condensation.and_then(|c| c.tail.as_ref());
    if let Some(tail) = tail {
        check_tail(parts.of_tail(), certificate, tail).map_err(of_file)?;
    }

    let nodes = certificate.pieces.iter().map(|p| p.tree.len() as u64).sum();
    let mut walk = BoxWalk {
        anchors,
        families,
        index,
        rows: &parts.plain,
        friction: [&certificate.from, &certificate.below].map(|end| Rc::new(end.clone())),
        tail: tail.map(|tail| &tail.from.0),
        leaves: 0,
        definite_budget: WorkBudget::of_definite_leaves([&parts.plain, &parts.friction], nodes),
        matrix_budget: WorkBudget::of_matrices([&parts.plain, &parts.friction], nodes),
        audit,
    };
    check_pieces(&mut walk, &certificate.pieces)?;

    Ok(walk.leaves)
}

/// An examination that passes over the leaves that fail and may be stopped.
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

/// Asks an audit whether to go on. A check that is none is never stopped.
fn has_stopped(audit: Option<&Audit<'_>>) -> bool {
    audit.is_some_and(Audit::stops)
}

/// The anchors of the condensation, which is there exactly if there are free variables.
pub(super) fn anchors<'a>(
    parts: &FrictionParts,
    condensation: Option<&'a CriticalCondensation>,
) -> Result<Option<Anchors<'a>>, CoverFault> {
    let has_free = parts.plain.is_free.contains(&true);

    match condensation {
        None if !has_free => Ok(None),
        Some(condensation) if has_free => Ok(Some(condensed::of_parts(parts, condensation)?)),
        _ => Err(CoverFault::Condensation { expected: has_free }),
    }
}

/// The enclosures of T0 and T1; no anchor is expanded.
pub(super) fn families(parts: &FrictionParts, anchors: Option<&Anchors<'_>>) -> [Family; 2] {
    if let Some(anchors) = anchors {
        return [Family::condensed(anchors), Family::condensed(anchors)];
    }

    let own = row_bits(&parts.plain).into_iter();
    let bits: Vec<u64> = own
        .zip(row_bits(&parts.friction))
        .map(|(plain, friction)| plain.max(friction))
        .collect();
    [&parts.plain, &parts.friction].map(|rows| Family::Linear(Linear::scaled(rows, &bits)))
}

/// The whole pencil of these parts is definite from `tail.from` on, at the lowest mu and at the
/// highest.
fn check_tail(
    parts: &FrictionParts,
    certificate: &CriticalCertificate,
    tail: &CriticalTail,
) -> Result<(), CoverFault> {
    let start = &tail.from.0;
    let lowest = parts.at(&certificate.from);
    let mass_factor = tail.mass_factor.as_ref();
    condensed::tail(&lowest, start, &tail.factor, mass_factor)?;

    let highest = parts.at(&certificate.below);
    let mass_factor = tail.mass_factor_below.as_ref();
    condensed::tail(&highest, start, &tail.factor_below, mass_factor)
}

/// Checks the pieces: they follow one another from 0 to infinity, and each tree covers its piece.
fn check_pieces(walk: &mut BoxWalk<'_>, pieces: &[CriticalPiece]) -> Result<(), Reason> {
    let window = Window::all();
    let mut lo = window.min().clone();

    for (k, piece) in pieces.iter().enumerate() {
        let is_last = k + 1 == pieces.len();
        let max = piece.max.as_ref().map(|n| &n.0);
        if has_stopped(walk.audit) {
            return Ok(());
        }

        expand_anchor(walk.anchors.as_ref(), &mut walk.families, piece.anchor)
            .map_err(|fault| of_piece(k, fault))?;
        check_end(&window, &lo, max, is_last).map_err(|fault| of_piece(k, fault))?;
        walk.piece(k, &lo, piece).map_err(|at| Reason::Boxes {
            piece: Some(k),
            node: Some(at.node),
            fault: at.fault,
        })?;

        if let Some(max) = max {
            lo = max.clone();
        }
    }

    if pieces.is_empty() {
        return Err(of_file(CoverFault::PieceEnd {
            expected: super::end(window.max()),
            got: lo.to_string(),
        }));
    }

    Ok(())
}

/// A box: a region of (supports) x (values of t), and an interval of mu.
struct FrictionBox {
    /// Holds the matrices of T0 as well.
    region: Region,
    /// The ends of the interval of mu.
    friction: [Rc<Rational>; 2],
    /// The matrices of T1, shared like those of the region.
    friction_matrices: Rc<Matrices>,
    corners: Rc<BoxCorners>,
}

/// The matrices at the lower and at the higher friction, computed when they are asked for. Boxes
/// that differ in their states alone share them.
#[derive(Default)]
struct BoxCorners {
    exact: RefCell<Option<Rc<[Ends; 2]>>>,
    /// `Some(None)`: there are no short numbers for them.
    short: RefCell<Option<Option<Rc<[Short; 4]>>>>,
    is_counted: Cell<bool>,
}

impl BoxCorners {
    /// Frees the memory, as [`Matrices::forget`] does.
    fn forget(&self) {
        self.exact.take();
        self.short.take();
        self.is_counted.set(false);
    }
}

impl FrictionBox {
    /// The values of t up to a cut and those from it on.
    fn split(self, at: &Rational) -> Result<[FrictionBox; 2], CoverFault> {
        let halves = self.region.split(at)?;
        self.friction_matrices.forget();
        self.corners.forget();

        Ok(halves.map(|region| FrictionBox {
            region,
            friction: self.friction.clone(),
            friction_matrices: Rc::default(),
            corners: Rc::default(),
        }))
    }

    /// x_i = 0 and x_i > 0 for an undecided variable i; see [`Region::branch`].
    fn branch(
        self,
        index: usize,
        indices: &[usize],
        other_half: Option<usize>,
    ) -> Result<[FrictionBox; 2], CoverFault> {
        let halves = self.region.branch(index, indices, other_half)?;

        Ok(halves.map(|region| FrictionBox {
            region,
            friction: self.friction.clone(),
            friction_matrices: Rc::clone(&self.friction_matrices),
            corners: Rc::clone(&self.corners),
        }))
    }

    /// The values of mu up to a cut and those from it on.
    fn split_friction(self, at: &Rational) -> Result<[FrictionBox; 2], CoverFault> {
        let [lower, higher] = self.friction;
        if at <= lower.as_ref() || at >= higher.as_ref() {
            return Err(CoverFault::FrictionCut {
                lower: Rational::clone(&lower),
                higher: Rational::clone(&higher),
                got: at.clone(),
            });
        }

        self.corners.forget();
        let cut = Rc::new(at.clone());
        let halves = [[lower, Rc::clone(&cut)], [cut, higher]];
        Ok(halves.map(|friction| FrictionBox {
            region: self.region.same(),
            friction,
            friction_matrices: Rc::clone(&self.friction_matrices),
            corners: Rc::default(),
        }))
    }
}

/// What a walk through the trees reads, and what is left of the budgets of the file.
struct BoxWalk<'a> {
    /// Where there are free variables.
    anchors: Option<Anchors<'a>>,
    /// T0 and T1.
    families: [Family; 2],
    /// The complementarity variables: positions in states and matrices to indices of the pencil.
    index: Vec<usize>,
    /// The rows without friction, which name the halves of v_T.
    rows: &'a Rows,
    /// The interval of mu of each tree.
    friction: [Rc<Rational>; 2],
    /// No solution has a value of t at or above this.
    tail: Option<&'a Rational>,
    leaves: usize,
    definite_budget: WorkBudget,
    matrix_budget: WorkBudget,
    /// Notes the leaves that fail, if they are to be passed over.
    audit: Option<&'a Audit<'a>>,
}

impl BoxWalk<'_> {
    /// Walks the tree of the piece with this number, which begins at `lo`.
    fn piece(
        &mut self,
        number: usize,
        lo: &Rational,
        piece: &CriticalPiece,
    ) -> Result<(), NodeFault> {
        let region = Region {
            lo: Rc::new(lo.clone()),
            hi: piece.max.as_ref().map(|n| Rc::new(n.0.clone())),
            states: vec![State::Undecided; self.index.len()],
            matrices: Rc::default(),
        };
        let mut stack = vec![FrictionBox {
            region,
            friction: self.friction.clone(),
            friction_matrices: Rc::default(),
            corners: Rc::default(),
        }];

        for (k, node) in piece.tree.iter().enumerate() {
            if has_stopped(self.audit) {
                return Ok(());
            }

            let at_node = |fault| NodeFault { node: k, fault };
            let at = stack.pop().ok_or(at_node(CoverFault::Trailing))?;

            let halves = match node {
                CriticalNode::Split(t) => Some(at.split(&t.0)),
                CriticalNode::Friction(mu) => Some(at.split_friction(&mu.0)),
                CriticalNode::Branch(index) => {
                    let other_half = self.rows.other_half(*index);
                    Some(at.branch(*index, &self.index, other_half))
                }
                leaf => {
                    self.leaves += 1;
                    let verdict = self.leaf(&at, piece.anchor, leaf);
                    self.settle(verdict, (number, k)).map_err(at_node)?;
                    None
                }
            };

            if let Some(halves) = halves {
                // The box on top of the stack is the next one.
                let [first, second] = halves.map_err(at_node)?;
                stack.extend([second, first]);
            }
        }

        if stack.is_empty() {
            return Ok(());
        }

        Err(NodeFault {
            node: piece.tree.len(),
            fault: CoverFault::Truncated {
                regions: stack.len(),
            },
        })
    }

    /// Passes on the verdict on a leaf, or notes where one fails.
    fn settle(&self, verdict: Result<(), CoverFault>, place: LeafPlace) -> Result<(), CoverFault> {
        match (&verdict, self.audit) {
            (Err(_), Some(audit)) => {
                audit.refused.borrow_mut().push(place);
                Ok(())
            }
            _ => verdict,
        }
    }

    /// Checks the proof of a leaf.
    fn leaf(
        &self,
        at: &FrictionBox,
        anchor: Option<usize>,
        node: &CriticalNode,
    ) -> Result<(), CoverFault> {
        let region = &at.region;

        match node {
            // These are no leaves.
            CriticalNode::Split(_) | CriticalNode::Friction(_) | CriticalNode::Branch(_) => Ok(()),
            CriticalNode::Tail => region.is_in_tail(self.tail),
            CriticalNode::Farkas(w) => {
                farkas::check_weights(region, &self.index, w)?;
                self.affordable(at, anchor)?;
                let short = self.short(at, anchor);
                if short.is_some_and(|corners| farkas::is_negative_at(region, &*corners, w)) {
                    return Ok(());
                }

                let ends = self.corners(at, anchor)?;
                farkas::check_columns(region, &four_corners(&ends), &self.index, w)
            }
            CriticalNode::PositiveDefinite => self.definite(at, anchor, 1),
            CriticalNode::NegativeDefinite => self.definite(at, anchor, -1),
            CriticalNode::Regular(witness) => self.regular(at, anchor, witness),
        }
    }

    fn definite(
        &self,
        at: &FrictionBox,
        anchor: Option<usize>,
        sign: i8,
    ) -> Result<(), CoverFault> {
        self.spend_definite(at)?;
        self.affordable(at, anchor)?;
        if let Some(corners) = self.short(at, anchor) {
            if definite::is_definite_at(&at.region, &*corners, sign) {
                return Ok(());
            }

            self.spend_definite(at)?;
        }

        let ends = self.corners(at, anchor)?;
        definite::check_corners(&at.region, &four_corners(&ends), &self.index, sign)
    }

    /// A definite leaf costs twice the cube of the number of variables that may be in the support:
    /// it has twice the corners of a leaf of one window. Where short numbers were tried in vain it
    /// costs that once more.
    fn spend_definite(&self, at: &FrictionBox) -> Result<(), CoverFault> {
        let order = at.region.possible_support().len() as u64;
        self.definite_budget.spend(order.saturating_pow(3) * 2)
    }

    fn regular(
        &self,
        at: &FrictionBox,
        anchor: Option<usize>,
        witness: &Regular,
    ) -> Result<(), CoverFault> {
        let is_half_line = at.region.hi.is_none();
        if is_half_line && !self.families[0].is_reversed(anchor) {
            return Err(CoverFault::OutcomeOnHalfLine { outcome: "regular" });
        }

        let bordered = Bordered::of_leaf(&at.region, &self.index, witness.into())?;
        self.affordable(at, anchor)?;
        self.spend_regular(at, bordered.support.len(), witness)?;

        let ends = self.corners(at, anchor)?;
        regular::check_corners(&bordered, &four_corners(&ends))
    }

    /// Takes the work of a regular leaf from the budget of definite leaves, which counts order^3 as
    /// well: the product of Y with the four corners is that of long numbers.
    fn spend_regular(
        &self,
        at: &FrictionBox,
        moving: usize,
        witness: &Regular,
    ) -> Result<(), CoverFault> {
        let [end_bits, friction_bits] = box_bits(at);
        let work = NullWitness::from(witness).work(moving, end_bits + friction_bits);
        self.definite_budget.spend(work)
    }

    /// The matrices of the box at its lower and at its higher friction, computed once for all boxes
    /// that differ in their states alone.
    fn corners(
        &self,
        at: &FrictionBox,
        anchor: Option<usize>,
    ) -> Result<Rc<[Ends; 2]>, CoverFault> {
        if let Some(corners) = &*at.corners.exact.borrow() {
            return Ok(Rc::clone(corners));
        }

        let region = &at.region;
        let plain = self.ends(0, region, &region.matrices, anchor)?;
        let friction = self.ends(1, region, &at.friction_matrices, anchor)?;

        let corners = at
            .friction
            .each_ref()
            .map(|mu| plain.plus_multiple(&friction, mu));
        let corners = Rc::new(corners);
        at.corners.exact.replace(Some(Rc::clone(&corners)));
        Ok(corners)
    }

    /// The corners in short numbers, where there are such.
    fn short(&self, at: &FrictionBox, anchor: Option<usize>) -> Option<Rc<[Short; 4]>> {
        if let Some(known) = &*at.corners.short.borrow() {
            return known.clone();
        }

        let short = self.short_corners(at, anchor).map(Rc::new);
        at.corners.short.replace(Some(short.clone()));
        short
    }

    /// M_e0 + mu_k M_e1 for both ends e and both frictions mu_k.
    fn short_corners(&self, at: &FrictionBox, anchor: Option<usize>) -> Option<[Short; 4]> {
        let part = |part: usize| {
            let lo = &at.region.lo;
            self.families[part].short(anchor, lo, at.region.hi.as_deref())
        };
        let plain = at.region.matrices.short(|| part(0))?;
        let friction = at.friction_matrices.short(|| part(1))?;

        let corner = |end: usize, mu: &Rational| plain[end].plus_multiple(&friction[end], mu);
        let [low, high] = &at.friction;
        Some([
            corner(0, low)?,
            corner(1, low)?,
            corner(0, high)?,
            corner(1, high)?,
        ])
    }

    /// The matrices of a part at the ends of the interval of t.
    fn ends(
        &self,
        part: usize,
        region: &Region,
        matrices: &Matrices,
        anchor: Option<usize>,
    ) -> Result<Rc<Ends>, CoverFault> {
        let family = &self.families[part];
        let lo = &region.lo;
        let hi = region.hi.as_deref();

        matrices.ends(|| family.ends(anchor, lo, hi))
    }

    /// Demands that the matrices of the parts and those of the box are small enough, and counts
    /// them once for all boxes that share them.
    fn affordable(&self, at: &FrictionBox, anchor: Option<usize>) -> Result<(), CoverFault> {
        let lo = &at.region.lo;
        let hi = at.region.hi.as_deref();
        for family in &self.families {
            family.affordable(anchor, lo, hi)?;
        }

        let [end_bits, friction_bits] = box_bits(at);
        let what = "bits of a box's matrix";
        within_matrix_bits(what, self.index.len(), PARTS, end_bits + friction_bits)?;

        let matrices = [&at.region.matrices, &at.friction_matrices];
        for (family, matrices) in self.families.iter().zip(matrices) {
            let work = family.matrix_work(anchor, lo, hi);
            matrices.count(&self.matrix_budget, work)?;
        }

        if at.corners.is_counted.replace(true) {
            return Ok(());
        }
        self.spend_corners(at)
    }

    /// Takes the work of the corners from the budget: each entry of the ends is multiplied by a
    /// value of mu.
    fn spend_corners(&self, at: &FrictionBox) -> Result<(), CoverFault> {
        let order = self.index.len();
        let [end_bits, friction_bits] = box_bits(at);

        let products = words(end_bits).saturating_mul(words(friction_bits));
        self.matrix_budget.spend(entries_work(order, products))
    }
}

fn box_bits(at: &FrictionBox) -> [u64; 2] {
    let friction = at.friction.each_ref().map(Rc::as_ref);
    bits_of_box(&at.region.lo, at.region.hi.as_deref(), friction)
}

/// The bits of an entry of an end, and those of both ends of the interval of mu.
pub(super) fn bits_of_box(
    lo: &Rational,
    hi: Option<&Rational>,
    [lower, higher]: [&Rational; 2],
) -> [u64; 2] {
    [
        FRACTION_BITS + end_bits(lo, hi),
        rational_bits(lower) + rational_bits(higher),
    ]
}

/// The corners at the lower friction, then those at the higher one.
fn four_corners(ends: &[Ends; 2]) -> [Corner<'_>; 4] {
    let [lower, higher] = ends;
    let [a, b] = lower.corners(CORNERS[0]);
    let [c, d] = higher.corners(CORNERS[1]);
    [a, b, c, d]
}

pub(super) fn of_file(fault: CoverFault) -> Reason {
    Reason::Boxes {
        piece: None,
        node: None,
        fault,
    }
}

pub(super) fn of_piece(piece: usize, fault: CoverFault) -> Reason {
    Reason::Boxes {
        piece: Some(piece),
        node: None,
        fault,
    }
}

#[cfg(test)]
mod tests;
