//! The search for all solutions in an interval of the unknown.
//!
//! A region in which every variable is decided has one support, and is closed by its only null
//! vector over the widest part of the interval that can be proved. Where a Farkas vector works at
//! the middle, the interval is cut where it stops working. What no leaf closes is left to exact
//! arithmetic, and else open.
//!
//! Called by `splice`; the rest of the search is `tree`.

use super::checkpoint::Copier;
use super::dyadic::short_near;
use super::gains::KeptGame;
use super::given::Given;
use super::leaf::farkas::{FarkasColumns, MiddleTest};
use super::leaf::root::{PartLeaf, RootSearch, Searched, part_around};
use super::leaf::{definite, infinity, ldl, support};
use super::pieces::expansion::{ChordEnds, Expansion};
use super::region::{self, Item, SearchRegion};
use super::tree::{Aim, Here, MAX_CUTS, SLACK_OF_HALF, TreeSearch};
use crate::tolerance::{DEGENERATE_PART, NARROW};
use mceip_check::certificate::{Node, VariableState};
use mceip_exact::{Rational, to_f64};
use std::rc::Rc;

/// Cuts in a row of an infinite interval before a variable is decided instead.
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

/// How far a cut may lie from where it should be: share of the part that the witness closes.
const SLACK_OF_PART: f64 = 0.05;

/// Undecided variables of a region that no matrices enclose, up to which it is taken support by
/// support.
const MAX_UNDECIDED_EXACT: usize = 6;

/// All solutions: what a region holds is listed, and what cannot be closed stays open.
pub(super) struct Solutions<'a> {
    pub(super) given: &'a Given<'a>,
    /// Values of null vectors that were met, decided or not.
    pub(super) met: Vec<f64>,
    /// Hands over copies of the items, if anybody keeps them.
    pub(super) copier: Option<Copier<'a>>,
}

impl Aim for Solutions<'_> {
    /// Hands over a copy of the items, if somebody has asked for it.
    fn answer(&mut self, items: &[Item]) {
        if let Some(copier) = &mut self.copier {
            copier.answer(items);
        }
    }

    fn by_gains(
        search: &mut TreeSearch<'_, Self>,
        region: &SearchRegion,
        ends: &Rc<[ChordEnds]>,
        kept: Option<KeptGame>,
        share: f64,
    ) -> bool {
        search.by_gains(region, ends, kept, share)
    }

    fn definite_leaf(
        search: &TreeSearch<'_, Self>,
        region: &SearchRegion,
        corners: &[ChordEnds],
    ) -> Option<Node> {
        let by_doubles = definite::leaf(corners, &region.states);
        if by_doubles.is_some() || search.expansion().reversed {
            return by_doubles;
        }

        ldl::half_line_leaf(search.aim.given, search.view, region, &corners[0])
    }

    /// By its null vector, by exact arithmetic, or by further cuts.
    fn decided(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64) {
        let region = here.region;
        let ends = &here.ends[0];
        let is_closed = search.null_vector_leaf(region, ends, share);
        if is_closed {
            return;
        }

        // At the middle T is enclosed by its radius alone, which cuts hardly make smaller.
        let is_held_up_by_radius = !here.middle.is_prunable && ends.r.is_some();
        let asks_for_exact = is_held_up_by_radius || region.cuts >= CUTS_BEFORE_EXACT;
        if asks_for_exact && search.exact(region, share) {
            return;
        }

        let max_cuts = if region.is_suspect || is_held_up_by_radius {
            MAX_CUTS_SUSPECT
        } else {
            MAX_CUTS_DECIDED
        };
        if search.is_narrow(ends) || region.cuts >= max_cuts {
            return search.give_up(region, share);
        }

        Self::cut(search, here, share);
    }

    fn is_worth_cutting(search: &TreeSearch<'_, Self>, here: &Here<'_>) -> bool {
        let ends = &here.ends[0];
        let max_cuts = if ends.is_half_line() {
            MAX_CUTS_TO_INFINITY
        } else {
            MAX_CUTS
        };

        here.middle.is_prunable && !search.is_narrow(ends) && here.region.cuts < max_cuts
    }

    /// Cuts out the part on which the middle's witness works, or halves.
    fn cut(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64) {
        let region = here.region;
        let mut cuts = proposed_cuts(&here.ends[0], &here.columns, &here.middle);
        cuts.retain(|cut| region.has_inside(cut));
        let is_out_of_order = cuts.len() == 2 && cuts[0] >= cuts[1];
        if cuts.is_empty() || is_out_of_order {
            // The interval is too narrow for doubles.
            return search.give_up(region, share);
        }

        let mut rest = region.clone();
        rest.cuts += 1;
        let part = share / (cuts.len() + 1) as f64;
        for cut in &cuts {
            search.split_at(cut);
            search.region(&rest.below(cut), part);
            rest = rest.above(cut);
        }

        search.region(&rest, part);
    }

    fn leave(search: &mut TreeSearch<'_, Self>, _region: &SearchRegion, share: f64) {
        search.leaf(Node::Open, share);
    }
}

impl TreeSearch<'_, Solutions<'_>> {
    /// T over the interval of a region.
    pub(super) fn expansion(&self) -> &Expansion {
        &self.expansions[0]
    }

    fn is_narrow(&self, ends: &ChordEnds) -> bool {
        self.width(ends) < NARROW
    }

    /// Is the whole window too narrow to be cut?
    fn is_window_narrow(&self) -> bool {
        let window = self.aim.given.window();
        let theta = |value: &Rational| self.view.theta(to_f64(value));
        window
            .max()
            .is_some_and(|max| theta(max) - theta(window.min()) < NARROW)
    }

    /// The width of an interval in theta.
    pub(super) fn width(&self, ends: &ChordEnds) -> f64 {
        self.view.theta(ends.hi) - self.view.theta(ends.lo)
    }

    /// Covers a decided region by means of its null vector. Returns false, and covers nothing,
    /// where that cannot be done.
    fn null_vector_leaf(&mut self, region: &SearchRegion, ends: &ChordEnds, share: f64) -> bool {
        if !ends.is_half_line() {
            return self.roots(region, ends, share);
        }

        let pencil = self.aim.given.pencil;
        match infinity::leaf(pencil, self.view, self.expansion(), region, ends) {
            Some(leaf) => {
                self.leaf(leaf, share);
                true
            }
            None => false,
        }
    }

    /// Covers a decided region by its null vector: the widest part of the interval over which it is
    /// proved to be the only one, and what is left on both sides. Returns false, and covers
    /// nothing, where no null vector is found.
    fn roots(&mut self, region: &SearchRegion, ends: &ChordEnds, share: f64) -> bool {
        let search = RootSearch {
            given: self.aim.given,
            view: self.view,
            expansion: self.expansion(),
        };

        match search.leaf(region, ends) {
            Searched::Nothing => false,
            Searched::Part(found) => {
                self.aim.met.extend(found.solution);
                self.around(region, *found, share);
                true
            }
            Searched::NotUnique(value) => {
                self.aim.met.push(value);
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
    fn degenerate(&mut self, region: &SearchRegion, ends: &ChordEnds, value: f64, share: f64) {
        // Doubles do not tell the parts of a narrow window apart, long numbers may decide it whole.
        if self.is_window_narrow() {
            return self.leaf(Node::Open, share);
        }

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
    fn around(&mut self, region: &SearchRegion, found: PartLeaf, share: f64) {
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
    fn exact(&mut self, region: &SearchRegion, share: f64) -> bool {
        let variables = self.view.variables(&region::support(&region.states));
        let shares = self.shares;
        let leaf = support::leaf(
            self.aim.given.pencil,
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
    fn give_up(&mut self, region: &SearchRegion, share: f64) {
        if !region.is_decided() || !self.exact(region, share) {
            self.leaf(Node::Open, share);
        }
    }

    /// Covers a region beyond the reach of the enclosures: a few undecided variables are decided
    /// one by one, and each support by exact arithmetic.
    pub(super) fn by_support(&mut self, region: &SearchRegion, share: f64) {
        self.aim.answer(&self.items);
        let undecided = region::undecided(&region.states);
        let Some(&position) = undecided.first() else {
            if region.states.contains(&VariableState::InSupport) {
                return self.give_up(region, share);
            }

            let leaf = Node::Support(Box::new(support::empty_leaf()));
            return self.leaf(leaf, share);
        };

        if undecided.len() > MAX_UNDECIDED_EXACT || self.shares.is_cancelled() {
            return self.leaf(Node::Open, share);
        }

        self.branch_on(position);
        for state in [VariableState::AtZero, VariableState::InSupport] {
            let child = self.view.part(region, position, state);
            self.by_support(&child, 0.5 * share);
        }
    }
}

/// Both ends of the part on which the middle's witness works, if that is a good part of the
/// interval; else the middle. Ends that coincide with the interval's are left out.
fn proposed_cuts(ends: &ChordEnds, columns: &FarkasColumns, middle: &MiddleTest) -> Vec<Rational> {
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
