//! Branch and prune over an interval of the unknown and the states of the complementarity
//! variables.
//!
//! Each region is closed by the first leaf that does: a definite symmetric part, a Farkas vector
//! or, once every variable is decided, its only null vector. Else the test at the middle of the
//! interval decides what to do. If a Farkas vector works there, the interval is cut where it stops
//! working; if none does, the variable whose complementarity the relaxed solution breaks most is
//! decided. What neither closes is left to exact arithmetic, and else open.
//!
//! With particles in contact with zero reaction the halves of v_T are decided first, one of them
//! being at rest (`spec/zero-reaction.md`, Z.3).
//!
//! Input: a region of one piece, the expansion of the piece. Output: the nodes that cover the
//! region, in preorder. Called by `splice`.

use super::checkpoint::Copier;
use super::dyadic::short_near;
use super::gains::Kept;
use super::given::Given;
use super::leaf::farkas::{self, Columns, MiddleTest};
use super::leaf::root::{PartLeaf, RootSearch, Searched, part_around};
use super::leaf::{definite, infinity, ldl, support};
use super::pieces::expansion::{Ends, Expansion};
use super::pieces::skyline::dot;
use super::pieces::view::View;
use super::region::{self, Item, Region, State};
use super::shares::Shares;
use crate::tolerance::{DEGENERATE_PART, NARROW};
use mceip_check::certificate::{Node, RootOutcome};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;
use std::rc::Rc;

/// Cuts in a row before a variable is decided instead: on a finite and on an infinite interval.
pub(super) const MAX_CUTS: usize = 24;
const MAX_CUTS_TO_INFINITY: usize = 3;

/// Cuts of a decided region before it stays open.
const MAX_CUTS_DECIDED: usize = 4 * MAX_CUTS;

/// Cuts of a decided region before exact arithmetic is asked: where there is a simple root, two or
/// three end at it, and the polynomials of a support take long.
const CUTS_BEFORE_EXACT: usize = 8;

/// Cuts on both sides of a null vector that is not provably the only one, before the rest stays
/// open.
const MAX_CUTS_SUSPECT: usize = 6;

/// Share of an interval that a witness must close to be worth two cuts.
const WORTH_TWO_CUTS: f64 = 0.2;

/// How far a cut may lie from where it should be: share of the part that the witness closes, and
/// share of the interval that is halved.
const SLACK_OF_PART: f64 = 0.05;
pub(super) const SLACK_OF_HALF: f64 = 0.1;

/// Undecided variables of a region that no matrices enclose, up to which it is taken support by
/// support.
const MAX_UNDECIDED_EXACT: usize = 6;

/// One piece's search.
pub(super) struct Search<'a> {
    pub(super) given: &'a Given<'a>,
    pub(super) view: &'a View,
    pub(super) expansion: &'a Expansion,
    pub(super) shares: &'a Shares<'a>,
    /// Nodes this piece may still use.
    pub(super) budget: usize,
    /// The nodes found, in preorder.
    pub(super) items: Vec<Item>,
    /// Values of null vectors that were met, decided or not.
    pub(super) met: Vec<f64>,
    /// Hands over copies of the items, if anybody keeps them.
    pub(super) copier: Option<Copier<'a>>,
}

impl Search<'_> {
    /// Covers a region; what it finds is appended to the items. `share` is its part of the whole
    /// search.
    pub(super) fn region(&mut self, region: &Region, share: f64) {
        let ends = self.ends_of(region);
        self.node(region, &ends, None, share);
    }

    /// Hands over a copy of the items, if somebody has asked for it.
    fn answer(&mut self) {
        if let Some(copier) = &mut self.copier {
            copier.answer(&self.items);
        }
    }

    pub(super) fn ends_of(&self, region: &Region) -> Rc<Ends> {
        let lo = to_f64(&region.lo);
        let hi = match &region.hi {
            Some(hi) => to_f64(hi),
            None => f64::INFINITY,
        };
        Rc::new(self.expansion.ends(lo, hi))
    }

    /// Appends a leaf that closes `share` of the search, or leaves it open.
    pub(super) fn leaf(&mut self, node: Node, share: f64) {
        let has_solution = match &node {
            Node::Root(root) => {
                matches!(root.outcome, RootOutcome::Solution | RootOutcome::Claim(_))
            }
            _ => false,
        };

        self.items.push(Item::Node(node));
        self.shares.closed(share, has_solution);
    }

    pub(super) fn branch_on(&mut self, position: usize) {
        let node = Node::Branch(self.view.index[position]);
        self.items.push(Item::Node(node));
    }

    pub(super) fn split_at(&mut self, cut: &Rational) {
        let node = Node::Split(Number(cut.clone()));
        self.items.push(Item::Node(node));
    }

    /// Covers a region whose ends are known, and their game if it was kept: by a leaf, by cuts of
    /// the interval, or by a branch.
    pub(super) fn node(
        &mut self,
        region: &Region,
        ends: &Rc<Ends>,
        kept: Option<Kept>,
        share: f64,
    ) {
        self.answer();
        if self.budget == 0 || self.shares.is_cancelled() {
            return self.leaf(Node::Open, share);
        }

        self.budget -= 1;
        if let Some(position) = self.view.undecided_half(&region.states) {
            return self.divide(position, region, ends, share);
        }

        if self.by_gains(region, ends, kept, share) {
            return;
        }

        if let Some(leaf) = self.definite_leaf(region, ends) {
            return self.leaf(leaf, share);
        }

        // A Farkas vector, from the game at the middle or from that of both ends.
        let middle_value = self.middle(ends);
        let point = self.expansion.ends(middle_value, middle_value);
        let middle = MiddleTest::new(point, &region.states);
        let columns = Columns::of(ends, &region.states);
        if let Some(weights) = farkas::weights(&columns, &middle, &region.states) {
            return self.leaf(Node::Farkas(weights), share);
        }

        // A decided region has its null vector left, and else only cuts.
        let width = self.view.theta(ends.hi) - self.view.theta(ends.lo);
        let is_narrow = width < NARROW;
        if region.is_decided() {
            let is_closed = self.decided_leaf(region, ends, share);
            if is_closed {
                return;
            }

            if region.cuts >= CUTS_BEFORE_EXACT && self.exact(region, share) {
                return;
            }

            if is_narrow || is_hopeless(region, ends, &middle) {
                return self.give_up(region, share);
            }

            return self.cut(region, ends, &columns, &middle, share);
        }

        // In another one the middle's game tells whether a cut or a branch leads further.
        let max_cuts = if ends.is_half_line() {
            MAX_CUTS_TO_INFINITY
        } else {
            MAX_CUTS
        };

        let may_cut = !is_narrow && region.cuts < max_cuts;
        if may_cut && middle.is_prunable {
            self.cut(region, ends, &columns, &middle, share);
        } else {
            self.branch(region, ends, &middle, share);
        }
    }

    pub(super) fn definite_leaf(&self, region: &Region, ends: &Ends) -> Option<Node> {
        let by_doubles = definite::leaf(ends, &region.states);
        if by_doubles.is_some() || self.expansion.reversed {
            return by_doubles;
        }

        ldl::half_line_leaf(self.given, self.view, region, ends)
    }

    /// Covers a decided region by means of its null vector. Returns false, and covers nothing,
    /// where that cannot be done.
    fn decided_leaf(&mut self, region: &Region, ends: &Ends, share: f64) -> bool {
        if !ends.is_half_line() {
            return self.roots(region, ends, share);
        }

        let pencil = self.given.pencil;
        match infinity::leaf(pencil, self.view, self.expansion, region, ends) {
            Some(leaf) => {
                self.leaf(leaf, share);
                true
            }
            None => false,
        }
    }

    /// A value in the middle of the interval, in theta.
    pub(super) fn middle(&self, ends: &Ends) -> f64 {
        let first = self.view.theta(ends.lo);
        let last = self.view.theta(ends.hi);
        let theta = 0.5 * (first + last);
        let middle = self.view.value(theta);
        middle.clamp(ends.lo, ends.hi)
    }

    /// Cuts out the part on which the middle's witness works, or halves.
    fn cut(
        &mut self,
        region: &Region,
        ends: &Ends,
        columns: &Columns,
        middle: &MiddleTest,
        share: f64,
    ) {
        let mut cuts = proposed_cuts(ends, columns, middle);
        cuts.retain(|cut| region.has_inside(cut));
        let is_out_of_order = cuts.len() == 2 && cuts[0] >= cuts[1];
        if cuts.is_empty() || is_out_of_order {
            // The interval is too narrow for doubles.
            return self.give_up(region, share);
        }

        let mut rest = region.clone();
        rest.cuts += 1;
        let part = share / (cuts.len() + 1) as f64;
        for cut in &cuts {
            self.split_at(cut);
            self.region(&rest.below(cut), part);
            rest = rest.above(cut);
        }

        self.region(&rest, part);
    }

    /// Decides the variable whose complementarity the relaxed solution of the middle breaks most:
    /// the one with the largest min(x_i, y_i), y_i in units of the largest entry of its row.
    fn branch(&mut self, region: &Region, ends: &Rc<Ends>, middle: &MiddleTest, share: f64) {
        let x = middle.relaxed_solution();
        let mut violations = Vec::with_capacity(x.len());
        for (row, x_i) in middle.matrix.iter().zip(&x) {
            let size = row.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
            let y_i = dot(row, &x) / size;
            violations.push(x_i.min(y_i));
        }

        let undecided = region::undecided(&region.states);
        let most_violated = undecided.into_iter().max_by(|&i, &j| {
            let first_of_equals = j.cmp(&i);
            violations[i]
                .total_cmp(&violations[j])
                .then(first_of_equals)
        });
        let Some(position) = most_violated else {
            return self.leaf(Node::Open, share);
        };

        self.divide(position, region, ends, share);
    }

    /// Decides the variable at this position.
    fn divide(&mut self, position: usize, region: &Region, ends: &Rc<Ends>, share: f64) {
        self.branch_on(position);
        for state in [State::AtZero, State::InSupport] {
            let mut child = self.view.part(region, position, state);
            child.cuts = 0;
            self.node(&child, ends, None, 0.5 * share);
        }
    }

    /// Covers a decided region by its null vector: the widest part of the interval over which it is
    /// proved to be the only one, and what is left on both sides. Returns false, and covers
    /// nothing, where no null vector is found.
    fn roots(&mut self, region: &Region, ends: &Ends, share: f64) -> bool {
        let search = RootSearch {
            given: self.given,
            view: self.view,
            expansion: self.expansion,
        };

        match search.leaf(region, ends) {
            Searched::Nothing => false,
            Searched::Part(found) => {
                self.met.extend(found.solution);
                self.around(region, *found, share);
                true
            }
            Searched::NotUnique(value) => {
                self.met.push(value);
                if self.exact(region, share) {
                    return true;
                }

                // While games are kept, variables are decided over wide intervals: there may be
                // other values, and both halves are searched.
                if self.keeps_games(ends) && region.cuts < MAX_CUTS_SUSPECT {
                    return false;
                }

                self.degenerate(region, ends, value, share);
                true
            }
        }
    }

    /// A null vector that is not provably the only one (a double root, a wide kernel, a singular
    /// pencil): a neighbourhood of it stays open, or the whole region the second time.
    fn degenerate(&mut self, region: &Region, ends: &Ends, value: f64, share: f64) {
        let neighbourhood = part_around(region, ends, value, DEGENERATE_PART);
        let Some([lo, hi]) = neighbourhood.filter(|_| !region.is_suspect) else {
            return self.leaf(Node::Open, share);
        };

        let mut outside = region.clone();
        outside.is_suspect = true;
        outside.cuts = 0;
        let open = PartLeaf {
            lo,
            hi,
            leaf: Item::Node(Node::Open),
            solution: None,
        };

        self.around(&outside, open, share);
    }

    /// A leaf for a part of a region, and the rest of the region on both sides of it.
    fn around(&mut self, region: &Region, found: PartLeaf, share: f64) {
        let part = share / 3.0;
        let has_below = found.lo > region.lo;
        let has_above = region.hi.as_ref() != Some(&found.hi);

        if has_below {
            self.split_at(&found.lo);
            self.region(&region.below(&found.lo), part);
        }

        if has_above {
            self.split_at(&found.hi);
        }

        let has_solution = found.leaf.is_solution();
        self.items.push(found.leaf);
        self.shares.closed(part, has_solution);
        if has_above {
            self.region(&region.above(&found.hi), part);
        } else {
            self.shares.closed(part, false);
        }

        if !has_below {
            self.shares.closed(part, false);
        }
    }

    /// Decides a decided region by exact arithmetic, if that can be done.
    fn exact(&mut self, region: &Region, share: f64) -> bool {
        let variables = self.view.variables(&region::support(&region.states));
        let shares = self.shares;
        let leaf = support::leaf(
            self.given.pencil,
            &variables,
            &region.lo,
            region.hi.as_ref(),
            &|| shares.is_cancelled(),
        );
        match leaf {
            Some(leaf) => {
                self.leaf(Node::Support(Box::new(leaf)), share);
                true
            }
            None => false,
        }
    }

    /// What doubles do not close: exact arithmetic decides a decided region, or it stays open.
    fn give_up(&mut self, region: &Region, share: f64) {
        if !region.is_decided() || !self.exact(region, share) {
            self.leaf(Node::Open, share);
        }
    }

    /// Covers a region beyond the reach of the enclosures: a few undecided variables are decided
    /// one by one, and each support by exact arithmetic.
    pub(super) fn by_support(&mut self, region: &Region, share: f64) {
        self.answer();
        let undecided = region::undecided(&region.states);
        let Some(&position) = undecided.first() else {
            if region.states.contains(&State::InSupport) {
                return self.give_up(region, share);
            }

            let leaf = Node::Support(Box::new(support::empty_leaf()));
            return self.leaf(leaf, share);
        };

        if undecided.len() > MAX_UNDECIDED_EXACT || self.shares.is_cancelled() {
            return self.leaf(Node::Open, share);
        }

        self.branch_on(position);
        for state in [State::AtZero, State::InSupport] {
            let child = self.view.part(region, position, state);
            self.by_support(&child, 0.5 * share);
        }
    }
}

/// Are further cuts of a decided region in vain?
fn is_hopeless(region: &Region, ends: &Ends, middle: &MiddleTest) -> bool {
    let max_cuts = if region.is_suspect {
        MAX_CUTS_SUSPECT
    } else {
        MAX_CUTS_DECIDED
    };

    // The radius stands in the way, and a shorter interval has the same.
    let is_held_up_by_radius =
        !middle.is_prunable && ends.r.is_some() && region.cuts >= MAX_CUTS_SUSPECT;
    region.cuts >= max_cuts || is_held_up_by_radius
}

/// Both ends of the part on which the middle's witness works, if that is a good part of the
/// interval; else the middle. Ends that coincide with the interval's are left out.
fn proposed_cuts(ends: &Ends, columns: &Columns, middle: &MiddleTest) -> Vec<Rational> {
    let width = ends.hi - ends.lo;
    if !width.is_finite() {
        let halved = short_near(middle.value, SLACK_OF_HALF * middle.value);
        return halved.into_iter().collect();
    }

    let place_of_middle = (middle.value - ends.lo) / width;
    let range = columns.range(&middle.game.w, place_of_middle);
    let Some(range) = range.filter(|range| range.end - range.begin > WORTH_TWO_CUTS) else {
        let halved = short_near(middle.value, SLACK_OF_HALF * width);
        return halved.into_iter().collect();
    };

    let slack = SLACK_OF_PART * (range.end - range.begin);
    let mut cuts = Vec::new();
    if range.begin > 0.0 {
        let target = ends.lo + (range.begin + slack) * width;
        cuts.extend(short_near(target, slack * width));
    }

    if range.end < 1.0 {
        let target = ends.lo + (range.end - slack) * width;
        cuts.extend(short_near(target, slack * width));
    }

    cuts
}
