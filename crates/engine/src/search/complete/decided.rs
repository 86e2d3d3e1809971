//! Regions in which every index is decided: their null vectors, exact arithmetic, and what both
//! leave over.

use crate::search::complete::leaf::root::{Null, Unique, null_vector};
use crate::search::complete::pieces::view::Ends;
use crate::search::complete::region::{Item, Region, State};
use crate::search::complete::tree::{Search, short};
use crate::tolerance::DEGENERATE_PART;
use mceip_check::certificate::{Claim, Node, RootOutcome, Support};
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::file::Number;

/// Open variables of a region that no matrices enclose, up to which it is taken support by support.
const MAX_OPEN_EXACT: usize = 6;

/// Steps towards a null vector's value while looking for a part over which it is alone, and the
/// factor of each step.
const ROOT_STEPS: i32 = 10;
const ROOT_SHRINK: f64 = 0.3;

impl Search<'_> {
    /// Every index is decided: finds the null vector and the widest part of the interval over which
    /// it is proved to be the only one, and covers what is left on both sides.
    pub(super) fn roots(&mut self, region: &Region, ends: &Ends, share: f64) -> bool {
        let Some(null) = null_vector(self.expansion, &region.states, ends.lo, ends.hi) else {
            return false;
        };
        // Closer to the value step by step; an end on the far side of the value stays.
        for step in 0..ROOT_STEPS {
            let Some((lo, hi)) = self.nearer(region, ends, null.value, ROOT_SHRINK.powi(step))
            else {
                return false;
            };
            let (a, b) = (to_f64(&lo), to_f64(&hi));
            if let Some(leaf) = self.absent_leaf(&null, [&lo, &hi], a, b) {
                self.around(region, lo, hi, leaf, share);
                return true;
            }
            let inside = self.window.0 <= from_f64(null.value).unwrap_or_default();
            let wide = if inside {
                self.expansion.ends(a.min(null.value), b.max(null.value))
            } else {
                self.expansion.ends(a, b)
            };
            if let Some(unique) = null.unique(&wide)
                && let Some(leaf) =
                    self.root_leaf(&null, &unique, &region.states, [ends.lo, ends.hi, a, b])
            {
                self.met.extend(is_solution(&leaf).then_some(null.value));
                self.around(region, lo, hi, leaf, share);
                return true;
            }
        }
        self.met.push(null.value);
        if !self.exact(region, share) {
            self.degenerate(region, ends, null.value, share);
        }
        true
    }

    /// Decides a region whose states are decided by exact arithmetic, if that can be done.
    pub(super) fn exact(&mut self, region: &Region, share: f64) -> bool {
        let moving: Vec<usize> = (0..region.states.len())
            .filter(|&p| region.states[p] == State::Moving)
            .map(|p| self.view.index[p])
            .collect();
        let Some(leaf) = (self.decide)(&moving, &region.lo, region.hi.as_ref()) else {
            return false;
        };
        self.leaf(Node::Support(Box::new(leaf)), share);
        true
    }

    /// What doubles do not close: exact arithmetic decides a decided region, or it stays open.
    pub(super) fn give_up(&mut self, region: &Region, share: f64) {
        if region.states.contains(&State::Open) || !self.exact(region, share) {
            self.leaf(Node::Open, share);
        }
    }

    /// A region beyond the reach of the enclosures: few open variables are decided one by one.
    pub(super) fn by_support(&mut self, region: &Region, share: f64) {
        let open: Vec<usize> = (0..region.states.len())
            .filter(|&p| region.states[p] == State::Open)
            .collect();
        let Some(&p) = open.first() else {
            if !region.states.contains(&State::Moving) {
                let nothing = Support {
                    points: Vec::new(),
                    cells: Vec::new(),
                    reasons: Vec::new(),
                };
                return self.leaf(Node::Support(Box::new(nothing)), share);
            }
            return self.give_up(region, share);
        };
        if open.len() > MAX_OPEN_EXACT || self.shares.is_cancelled() {
            return self.leaf(Node::Open, share);
        }
        self.items
            .push(Item::Node(Node::Branch(self.view.index[p])));
        for state in [State::Rest, State::Moving] {
            let mut child = region.clone();
            child.states[p] = state;
            self.by_support(&child, 0.5 * share);
        }
    }

    /// [lo, hi] of the region, each end moved to `factor` of its distance from the value.
    fn nearer(
        &self,
        region: &Region,
        ends: &Ends,
        value: f64,
        factor: f64,
    ) -> Option<(Rational, Rational)> {
        let end = |given: &Rational, at: f64, outside: bool| {
            let distance = (at - value).abs() * factor;
            if factor == 1.0 || outside {
                Some(given.clone())
            } else {
                short(value + distance.copysign(at - value), 0.2 * distance)
            }
        };
        let (lo, hi) = (
            end(&region.lo, ends.lo, ends.lo >= value)?,
            end(region.hi.as_ref()?, ends.hi, ends.hi <= value)?,
        );
        (lo >= region.lo && Some(&hi) <= region.hi.as_ref() && lo < hi).then_some((lo, hi))
    }

    /// A null vector that is not provably alone (a double root, a wide kernel, a singular pencil):
    /// a neighbourhood of it stays open, or the whole region the second time.
    fn degenerate(&mut self, region: &Region, ends: &Ends, value: f64, share: f64) {
        match self.nearer(region, ends, value, DEGENERATE_PART) {
            Some((lo, hi)) if !region.suspect => {
                let outside = Region {
                    suspect: true,
                    cuts: 0,
                    ..region.clone()
                };
                self.around(&outside, lo, hi, Item::Node(Node::Open), share);
            }
            _ => self.leaf(Node::Open, share),
        }
    }

    /// A null vector whose value lies outside [a, b], and the proof that none lies inside.
    fn absent_leaf(&self, null: &Null, leaf: [&Rational; 2], a: f64, b: f64) -> Option<Item> {
        if a < null.value && null.value < b {
            return None;
        }
        let ends = self.expansion.ends(a, b);
        let unique = null.unique(&ends).filter(|u| u.is_absent(&ends))?;
        Some(Item::Node(Node::Root(Box::new(unique.witness(
            &self.view.index,
            leaf.map(Clone::clone),
            RootOutcome::Absent,
        )))))
    }

    fn root_leaf(
        &self,
        null: &Null,
        unique: &Unique,
        states: &[State],
        ends: [f64; 4],
    ) -> Option<Item> {
        let index = &self.view.index;
        if let Some((interval, outcome)) =
            unique.outcome(self.expansion, null.value, ends, states, index)
        {
            let inside = interval[0] >= self.window.0
                && self.window.1.as_ref().is_none_or(|max| interval[1] <= *max);
            if inside {
                return Some(Item::Node(Node::Root(Box::new(
                    unique.witness(index, interval, outcome),
                ))));
            }
        }
        let claim = (self.certify)(null.value, &null.spread(states.len()))?;
        let Claim::ExactSolution(c) = &claim else {
            return None;
        };
        // Its null vector must be the leaf's: it moves nothing else, and y = 0 on all that moves
        // here.
        let moves = |i: &usize| {
            self.view
                .index
                .iter()
                .position(|k| k == i)
                .is_some_and(|p| states[p] == State::Moving)
        };
        let rest = (0..states.len())
            .filter(|&p| states[p] == State::Moving)
            .map(|p| index[p]);
        if !c.support.iter().all(moves)
            || !rest
                .into_iter()
                .all(|i| c.support.contains(&i) || c.biactive.contains(&i))
        {
            return None;
        }
        let interval = c.interval.clone().map(|n| n.0);
        Some(Item::Claimed(
            Box::new(unique.witness(index, interval, RootOutcome::Claim(0))),
            Box::new(claim),
        ))
    }

    /// The leaf over [lo, hi], and the rest of the region on both sides of it.
    pub(super) fn around(
        &mut self,
        region: &Region,
        lo: Rational,
        hi: Rational,
        leaf: Item,
        share: f64,
    ) {
        let part = share / 3.0;
        let below = (lo > region.lo).then(|| Region {
            hi: Some(lo.clone()),
            ..region.clone()
        });
        let above = (region.hi.as_ref() != Some(&hi)).then(|| Region {
            lo: hi,
            ..region.clone()
        });
        if let Some(below) = &below {
            self.items.push(Item::Node(Node::Split(Number(lo))));
            self.region(below, part);
        }
        if let Some(above) = &above {
            self.items
                .push(Item::Node(Node::Split(Number(above.lo.clone()))));
        }
        let solution = is_solution(&leaf);
        self.items.push(leaf);
        self.shares.closed(part, solution);
        match &above {
            Some(above) => self.region(above, part),
            None => self.shares.closed(part, false),
        }
        if below.is_none() {
            self.shares.closed(part, false);
        }
    }
}

pub(super) fn is_solution(leaf: &Item) -> bool {
    match leaf {
        Item::Node(Node::Root(r)) => r.outcome == RootOutcome::Solution,
        Item::Node(_) => false,
        Item::Claimed(..) => true,
    }
}
