//! Branch and prune over regions: an interval of the unknown t, an interval of mu where the pencil
//! depends on it, and the states of the complementarity variables.
//!
//! T(t) = A + tB, or T(t, mu) = T0(t) + mu T1(t), is known up to a radius at the *corners* of a
//! region: at both ends of its interval of t, at both ends of its interval of mu. In between it is
//! a convex combination of such matrices. A region is closed by the first leaf that holds at the
//! corners: a definite symmetric part, a Farkas vector or, once every variable is decided, what the
//! [`Aim`] of the search has for it. Else the test at the middle of the region decides what to do:
//! where a Farkas vector works there, a cut may lead further; where none does, the variable whose
//! complementarity the relaxed solution breaks most is decided.
//!
//! With particles in contact with zero reaction the halves of v_T are decided first, one of them
//! being at rest (`spec/zero-reaction.md`, Z.3).
//!
//! Two aims: all solutions (`solutions`, called by `splice`) and that there is none below a
//! friction (`analysis::absence`). Input: a region of one piece, the expansions of the piece.
//! Output: the nodes that cover the region, in preorder.

use super::gains::KeptGame;
use super::leaf::definite;
use super::leaf::farkas::{self, FarkasColumns, MiddleTest};
use super::leaf::weighted::Weights;
use super::pieces::expansion::{ChordEnds, Expansion};
use super::pieces::skyline::dot;
use super::pieces::view::View;
use super::region::{self, Item, SearchRegion};
use super::shares::Shares;
use mceip_check::certificate::{Node, RootOutcome, VariableState};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;
use std::rc::Rc;

/// Cuts in a row before a variable is decided instead.
pub(crate) const MAX_CUTS: usize = 24;

/// How far a cut may lie from the middle: share of the interval.
pub(crate) const SLACK_OF_HALF: f64 = 0.1;

/// One piece's search.
pub(crate) struct TreeSearch<'a, A> {
    pub(crate) view: &'a View,
    /// T over an interval of t; T0 and T1 where it depends on mu.
    pub(crate) expansions: &'a [Expansion],
    pub(crate) shares: &'a Shares<'a>,
    /// Nodes this piece may still use.
    pub(crate) budget: usize,
    /// The nodes found, in preorder.
    pub(crate) items: Vec<Item>,
    pub(crate) aim: A,
}

/// A region that neither a definite part nor a Farkas vector closes.
pub(crate) struct Here<'r> {
    pub(crate) region: &'r SearchRegion,
    /// The ends of each expansion.
    pub(crate) ends: &'r Rc<[ChordEnds]>,
    /// T at both ends of the interval of t, for each end of the interval of mu.
    pub(crate) corners: Rc<[ChordEnds]>,
    pub(crate) columns: FarkasColumns,
    pub(crate) middle: MiddleTest,
    /// Weights of a definite leaf at the middle.
    pub(crate) weights: Option<Weights>,
}

/// What a search is for.
pub(crate) trait Aim: Sized {
    /// Is the search over, whatever is left of the piece?
    fn is_over(&self) -> bool {
        false
    }

    /// Sees the nodes found so far, whenever a region is begun.
    fn answer(&mut self, _items: &[Item]) {}

    /// Covers a region by means of a game that is kept from region to region. Returns false, and
    /// covers nothing, where that cannot be done.
    fn by_gains(
        _search: &mut TreeSearch<'_, Self>,
        _region: &SearchRegion,
        _ends: &Rc<[ChordEnds]>,
        _kept: Option<KeptGame>,
        _share: f64,
    ) -> bool {
        false
    }

    /// A leaf by a definite symmetric part.
    fn definite_leaf(
        _search: &TreeSearch<'_, Self>,
        region: &SearchRegion,
        corners: &[ChordEnds],
    ) -> Option<Node> {
        definite::leaf(corners, &region.states)
    }

    /// Weights with which the symmetric part is definite in the middle of a region.
    fn weights(_region: &SearchRegion, _middle: &MiddleTest) -> Option<Weights> {
        None
    }

    /// Covers a region in which every variable is decided.
    fn decided(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64);

    /// Does a cut of a region that is not decided lead further than a branch?
    fn is_worth_cutting(search: &TreeSearch<'_, Self>, here: &Here<'_>) -> bool;

    /// Cuts an interval of a region, and covers the parts.
    fn cut(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64);

    /// Ends the search at a region that would have to be branched, and says so; does nothing where
    /// it goes on.
    fn ends_at(_search: &mut TreeSearch<'_, Self>, _here: &Here<'_>) -> bool {
        false
    }

    /// Leaves a region for which no budget is left.
    fn leave(search: &mut TreeSearch<'_, Self>, region: &SearchRegion, share: f64);
}

impl<A: Aim> TreeSearch<'_, A> {
    /// Covers a region; what it finds is appended to the items. `share` is its part of the whole
    /// search.
    pub(crate) fn region(&mut self, region: &SearchRegion, share: f64) {
        let ends = self.ends_of(region);
        self.node(region, &ends, None, share);
    }

    /// Covers a region whose ends are known, and their game if it was kept: by a leaf, by cuts of
    /// an interval, or by a branch.
    pub(crate) fn node(
        &mut self,
        region: &SearchRegion,
        ends: &Rc<[ChordEnds]>,
        kept: Option<KeptGame>,
        share: f64,
    ) {
        if self.aim.is_over() {
            return;
        }

        self.aim.answer(&self.items);
        if self.budget == 0 || self.shares.is_cancelled() {
            return A::leave(self, region, share);
        }

        self.budget -= 1;
        if let Some(position) = self.view.undecided_half(&region.states) {
            return self.divide(position, region, ends, share);
        }

        if A::by_gains(self, region, ends, kept, share) {
            return;
        }

        let corners = corners(ends, region);
        if let Some(leaf) = A::definite_leaf(self, region, &corners) {
            return self.leaf(leaf, share);
        }

        let middle = self.middle_test(region);
        let weights = A::weights(region, &middle);
        let weighted = weights
            .as_ref()
            .and_then(|found| found.leaf(&corners, &region.states));
        if let Some(leaf) = weighted {
            return self.leaf(leaf, share);
        }

        // A Farkas vector, from the game at the middle or from that of all corners.
        let columns = FarkasColumns::of(&corners, &region.states);
        if let Some(weights) = farkas::weights(&columns, &middle, &region.states) {
            return self.leaf(Node::Farkas(weights), share);
        }

        let here = Here {
            region,
            ends,
            corners,
            columns,
            middle,
            weights,
        };
        if region.is_decided() {
            A::decided(self, &here, share);
        } else if A::is_worth_cutting(self, &here) {
            A::cut(self, &here, share);
        } else if !A::ends_at(self, &here) {
            self.branch(&here, share);
        }
    }

    /// The ends of each expansion over the region's interval of t.
    pub(crate) fn ends_of(&self, region: &SearchRegion) -> Rc<[ChordEnds]> {
        let [lo, hi] = region.interval();
        self.ends(lo, hi)
    }

    /// The ends of each expansion over an interval of t.
    pub(crate) fn ends(&self, lo: f64, hi: f64) -> Rc<[ChordEnds]> {
        let parts = self.expansions.iter();
        parts.map(|part| part.ends(lo, hi)).collect()
    }

    /// The game in the middle of a region.
    pub(crate) fn middle_test(&self, region: &SearchRegion) -> MiddleTest {
        let value = self.middle(region);
        let point = match self.expansions {
            [constant, slope] => {
                let [constant, slope] = [constant, slope].map(|part| part.ends(value, value));
                ChordEnds::at_friction([&constant, &slope], region.middle_friction())
            }
            others => others[0].ends(value, value),
        };
        MiddleTest::new(point, &region.states)
    }

    /// A value in the middle of the interval of t, in theta.
    pub(crate) fn middle(&self, region: &SearchRegion) -> f64 {
        let [lo, hi] = region.interval();
        let theta = 0.5 * (self.view.theta(lo) + self.view.theta(hi));
        self.view.value(theta).clamp(lo, hi)
    }

    /// Appends a leaf that closes `share` of the search, or leaves it open.
    pub(crate) fn leaf(&mut self, node: Node, share: f64) {
        let has_solution = match &node {
            Node::Root(root) => {
                matches!(root.outcome, RootOutcome::Solution | RootOutcome::Claim(_))
            }
            _ => false,
        };

        self.items.push(Item::Node(node));
        self.shares.closed(share, has_solution);
    }

    pub(crate) fn branch_on(&mut self, position: usize) {
        let node = Node::Branch(self.view.index[position]);
        self.items.push(Item::Node(node));
    }

    pub(crate) fn split_at(&mut self, cut: &Rational) {
        let node = Node::Split(Number(cut.clone()));
        self.items.push(Item::Node(node));
    }

    /// Decides the variable whose complementarity the relaxed solution of the middle breaks most:
    /// the one with the largest min(x_i, y_i), y_i in units of the largest entry of its row.
    fn branch(&mut self, here: &Here<'_>, share: f64) {
        let x = here.middle.relaxed_solution();
        let mut violations = Vec::with_capacity(x.len());
        for (row, x_i) in here.middle.matrix().iter().zip(&x) {
            let size = row.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
            let y_i = dot(row, &x) / size;
            violations.push(x_i.min(y_i));
        }

        let undecided = region::undecided(&here.region.states);
        let most_violated = undecided.into_iter().max_by(|&i, &j| {
            let first_of_equals = j.cmp(&i);
            violations[i]
                .total_cmp(&violations[j])
                .then(first_of_equals)
        });
        match most_violated {
            Some(position) => self.divide(position, here.region, here.ends, share),
            None => A::leave(self, here.region, share),
        }
    }

    /// Decides the variable at this position.
    fn divide(
        &mut self,
        position: usize,
        region: &SearchRegion,
        ends: &Rc<[ChordEnds]>,
        share: f64,
    ) {
        self.branch_on(position);
        for state in [VariableState::AtZero, VariableState::InSupport] {
            let mut child = self.view.part(region, position, state);
            child.cuts = 0;
            self.node(&child, ends, None, 0.5 * share);
        }
    }
}

/// T at both ends of the interval of t, for each end of the region's interval of mu.
fn corners(ends: &Rc<[ChordEnds]>, region: &SearchRegion) -> Rc<[ChordEnds]> {
    match &ends[..] {
        [constant, slope] => {
            let at = |mu| ChordEnds::at_friction([constant, slope], to_f64(mu));
            region.mu.iter().map(at).collect()
        }
        _ => Rc::clone(ends),
    }
}
