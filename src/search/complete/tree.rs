//! Branch and prune over an interval of the unknown and the states of the complementarity variables.
//!
//! A region is closed by a definite symmetric part, a Farkas vector or, once every index is decided,
//! by its only null vector. Else the test at the middle decides what to do: if a Farkas vector works
//! there, the interval is cut where it stops working; if none does, the index whose complementarity
//! the relaxed solution breaks most is decided.

use super::game::{Game, dot};
use super::root::{Null, Unique, null_vector};
use super::view::{Ends, Expansion, Matrix, View};
use super::witness::{Columns, definite, vanishes};
use crate::certificate::{Claim, Node, Root, RootOutcome, Support};
use crate::exact::{Rational, from_f64, to_f64};
use crate::model::file::Number;
use crate::tolerance::{DEGENERATE_PART, NARROW, THIN_MARGIN, WITNESS_MARGIN};
use std::rc::Rc;

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
        Region { lo, hi, states: vec![State::Open; variables], cuts: 0, suspect: false }
    }
}

/// Cuts in a row before an index is decided instead: on a finite and on an infinite interval.
const MAX_CUTS: [usize; 2] = [24, 3];

/// Cuts of a decided region before exact arithmetic is asked: where there is a simple root, two or three end at it,
/// and the polynomials of a support take long.
const CUTS_BEFORE_EXACT: usize = 8;

/// Open variables of a region that no matrices enclose, up to which it is taken support by support.
const MAX_OPEN_EXACT: usize = 6;

/// The same on both sides of a null vector that is not provably alone, before the rest stays open.
const MAX_CUTS_SUSPECT: usize = 6;

/// Steps towards a null vector's value while looking for a part over which it is alone, and the factor of
/// each step.
const ROOT_STEPS: i32 = 10;
const ROOT_SHRINK: f64 = 0.3;

/// Tells a walk when to stop, and hears what it closes.
pub(super) trait Watch: Sync {
    /// Should the rest be left open?
    fn stopped(&self) -> bool;
    /// A region of this share of the whole has been closed (or left open); a solution was met in it.
    fn closed(&self, share: f64, solution: bool);
}

/// Exact solutions where doubles cannot tell: value and x over the positions to a claim.
pub(super) type Certify<'a> = dyn Fn(f64, &[f64]) -> Option<Claim> + Sync + 'a;

/// What one support holds over an interval, exactly, if that can be decided.
pub(super) type Decide<'a> = dyn Fn(&[usize], &Rational, Option<&Rational>) -> Option<Support> + Sync + 'a;

/// One piece's search.
pub(super) struct Search<'a> {
    pub(super) view: &'a View,
    pub(super) expansion: &'a Expansion,
    pub(super) certify: &'a Certify<'a>,
    pub(super) decide: &'a Decide<'a>,
    pub(super) watch: &'a dyn Watch,
    /// Nodes this piece may still use.
    pub(super) budget: usize,
    pub(super) items: Vec<Item>,
    /// Values of null vectors that were met, decided or not.
    pub(super) met: Vec<f64>,
    /// Window of the certificate: a root's interval stays inside.
    pub(super) window: (Rational, Option<Rational>),
}

impl Search<'_> {
    /// Covers a region; what it finds is appended to the items. `share` is its part of the whole search.
    pub(super) fn region(&mut self, region: &Region, share: f64) {
        let (lo, hi) = self.ends_of(region);
        let ends = Rc::new(self.expansion.ends(lo, hi));
        self.node(region, &ends, share);
    }

    fn ends_of(&self, region: &Region) -> (f64, f64) {
        (to_f64(&region.lo), region.hi.as_ref().map_or(f64::INFINITY, to_f64))
    }

    fn leaf(&mut self, node: Node, share: f64) {
        let solution = matches!(&node, Node::Root(r) if matches!(r.outcome, RootOutcome::Solution | RootOutcome::Claim(_)));
        self.items.push(Item::Node(node));
        self.watch.closed(share, solution);
    }

    fn node(&mut self, region: &Region, ends: &Rc<Ends>, share: f64) {
        if self.budget == 0 || self.watch.stopped() {
            return self.leaf(Node::Open, share);
        }
        self.budget -= 1;
        if let Some(leaf) = definite_leaf(ends, &region.states) {
            return self.leaf(leaf, share);
        }
        let decided = !region.states.contains(&State::Open);
        let middle = self.middle(ends);
        let point = self.expansion.ends(middle, middle);
        let at = Columns::at(&point.m[0], point.r.as_ref(), &region.states);
        let game = at.play(&region.states);
        let prunable = at.margin(&game) > WITNESS_MARGIN;
        let columns = Columns::of(ends, &region.states);
        if let Some(w) = farkas(&columns, &game, prunable, &region.states, decided) {
            return self.leaf(Node::Farkas(w), share);
        }
        let narrow = self.view.theta(ends.hi) - self.view.theta(ends.lo) < NARROW;
        if decided && ends.hi.is_finite() && self.roots(region, ends, share) {
            return;
        }
        let cuts_left = if region.suspect { MAX_CUTS_SUSPECT } else { 4 * MAX_CUTS[0] };
        if decided && region.cuts >= CUTS_BEFORE_EXACT && self.exact(region, share) {
            return;
        }
        if decided && (narrow || region.cuts >= cuts_left) {
            return self.give_up(region, share);
        }
        if decided && !prunable && ends.r.is_some() && region.cuts >= MAX_CUTS_SUSPECT {
            // The radius stands in the way, and a shorter interval has the same.
            return self.give_up(region, share);
        }
        let may_cut = !narrow && region.cuts < MAX_CUTS[usize::from(ends.hi.is_infinite())];
        if decided || (may_cut && prunable) {
            return self.cut(region, ends, &columns, &game.w, middle, share);
        }
        self.branch(region, ends, &at, &game.mix, &point.m[0], share);
    }

    /// A value in the middle of the interval, in theta.
    fn middle(&self, ends: &Ends) -> f64 {
        let (a, b) = (self.view.theta(ends.lo), self.view.theta(ends.hi));
        self.view.value(0.5 * (a + b)).clamp(ends.lo, ends.hi)
    }

    /// Cuts out the part on which the middle's witness works, or halves.
    fn cut(&mut self, region: &Region, ends: &Ends, columns: &Columns, w: &[f64], middle: f64, share: f64) {
        let width = ends.hi - ends.lo;
        let range = if width.is_finite() { columns.range(w, (middle - ends.lo) / width) } else { None };
        let cuts: Vec<Rational> = match range {
            // Worth two cuts only if a good part of the interval goes.
            Some((a, b)) if b - a > 0.2 => {
                let inner = 0.05 * (b - a);
                let at = |v: f64, keep: bool| keep.then(|| short(ends.lo + v * width, inner * width)).flatten();
                [at(a + inner, a > 0.0), at(b - inner, b < 1.0)].into_iter().flatten().collect()
            }
            _ => short(middle, 0.1 * if width.is_finite() { width } else { middle }).into_iter().collect(),
        };
        let inside = |c: &Rational| *c > region.lo && region.hi.as_ref().is_none_or(|hi| c < hi);
        let cuts: Vec<Rational> = cuts.into_iter().filter(inside).collect();
        if cuts.is_empty() || (cuts.len() == 2 && cuts[0] >= cuts[1]) {
            return self.give_up(region, share); // the interval is too narrow for doubles
        }
        let mut rest = Region { cuts: region.cuts + 1, ..region.clone() };
        let part = share / (cuts.len() + 1) as f64;
        for at in cuts {
            self.items.push(Item::Node(Node::Split(Number(at.clone()))));
            self.region(&Region { hi: Some(at.clone()), ..rest.clone() }, part);
            rest.lo = at;
        }
        self.region(&rest, part);
    }

    /// Decides the index whose complementarity the relaxed solution of the middle breaks most.
    fn branch(&mut self, region: &Region, ends: &Rc<Ends>, at: &Columns, mix: &[f64], m: &Matrix, share: f64) {
        let n = region.states.len();
        let mut x = vec![0.0; n];
        at.variable.iter().zip(mix).for_each(|(&j, q)| x[j] = *q);
        let size = |i: usize| m[i].iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        let y = |i: usize| dot(&m[i], &x) / size(i);
        let open = (0..n).filter(|&i| region.states[i] == State::Open);
        let Some(i) = open.max_by(|&i, &j| x[i].min(y(i)).total_cmp(&x[j].min(y(j))).then(j.cmp(&i))) else {
            return self.leaf(Node::Open, share);
        };
        self.items.push(Item::Node(Node::Branch(self.view.index[i])));
        for state in [State::Rest, State::Moving] {
            let mut child = Region { cuts: 0, ..region.clone() };
            child.states[i] = state;
            self.node(&child, ends, 0.5 * share);
        }
    }

    /// Every index is decided: finds the null vector and the widest part of the interval over which it is
    /// proved to be the only one, and covers what is left on both sides.
    fn roots(&mut self, region: &Region, ends: &Ends, share: f64) -> bool {
        let Some(null) = null_vector(self.expansion, &region.states, ends.lo, ends.hi) else { return false };
        // Closer to the value step by step; an end on the far side of the value stays.
        for step in 0..ROOT_STEPS {
            let Some((lo, hi)) = self.nearer(region, ends, null.value, ROOT_SHRINK.powi(step)) else { return false };
            let (a, b) = (to_f64(&lo), to_f64(&hi));
            if let Some(leaf) = self.absent_leaf(&null, [&lo, &hi], a, b) {
                self.around(region, lo, hi, leaf, share);
                return true;
            }
            let inside = self.window.0 <= from_f64(null.value).unwrap_or_default();
            let wide = if inside { self.expansion.ends(a.min(null.value), b.max(null.value)) } else { self.expansion.ends(a, b) };
            if let Some(unique) = null.unique(&wide)
                && let Some(leaf) = self.root_leaf(&null, &unique, &region.states, [ends.lo, ends.hi, a, b])
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
    fn exact(&mut self, region: &Region, share: f64) -> bool {
        let moving: Vec<usize> =
            (0..region.states.len()).filter(|&p| region.states[p] == State::Moving).map(|p| self.view.index[p]).collect();
        let Some(leaf) = (self.decide)(&moving, &region.lo, region.hi.as_ref()) else { return false };
        self.leaf(Node::Support(Box::new(leaf)), share);
        true
    }

    /// What doubles do not close: exact arithmetic decides a decided region, or it stays open.
    fn give_up(&mut self, region: &Region, share: f64) {
        if region.states.contains(&State::Open) || !self.exact(region, share) {
            self.leaf(Node::Open, share);
        }
    }

    /// A region beyond the reach of the enclosures: few open variables are decided one by one.
    pub(super) fn by_support(&mut self, region: &Region, share: f64) {
        let open: Vec<usize> = (0..region.states.len()).filter(|&p| region.states[p] == State::Open).collect();
        let Some(&p) = open.first() else {
            if !region.states.contains(&State::Moving) {
                let nothing = Support { points: Vec::new(), cells: Vec::new(), reasons: Vec::new() };
                return self.leaf(Node::Support(Box::new(nothing)), share);
            }
            return self.give_up(region, share);
        };
        if open.len() > MAX_OPEN_EXACT || self.watch.stopped() {
            return self.leaf(Node::Open, share);
        }
        self.items.push(Item::Node(Node::Branch(self.view.index[p])));
        for state in [State::Rest, State::Moving] {
            let mut child = region.clone();
            child.states[p] = state;
            self.by_support(&child, 0.5 * share);
        }
    }

    /// [lo, hi] of the region, each end moved to `factor` of its distance from the value.
    fn nearer(&self, region: &Region, ends: &Ends, value: f64, factor: f64) -> Option<(Rational, Rational)> {
        let end = |given: &Rational, at: f64, outside: bool| {
            let distance = (at - value).abs() * factor;
            if factor == 1.0 || outside { Some(given.clone()) } else { short(value + distance.copysign(at - value), 0.2 * distance) }
        };
        let (lo, hi) = (end(&region.lo, ends.lo, ends.lo >= value)?, end(region.hi.as_ref()?, ends.hi, ends.hi <= value)?);
        (lo >= region.lo && Some(&hi) <= region.hi.as_ref() && lo < hi).then_some((lo, hi))
    }

    /// A null vector that is not provably alone (a double root, a wide kernel, a singular pencil): a
    /// neighbourhood of it stays open, or the whole region the second time.
    fn degenerate(&mut self, region: &Region, ends: &Ends, value: f64, share: f64) {
        match self.nearer(region, ends, value, DEGENERATE_PART) {
            Some((lo, hi)) if !region.suspect => {
                let outside = Region { suspect: true, cuts: 0, ..region.clone() };
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
        Some(Item::Node(Node::Root(Box::new(unique.witness(&self.view.index, leaf.map(Clone::clone), RootOutcome::Absent)))))
    }

    fn root_leaf(&self, null: &Null, unique: &Unique, states: &[State], ends: [f64; 4]) -> Option<Item> {
        let index = &self.view.index;
        if let Some((interval, outcome)) = unique.outcome(self.expansion, null.value, ends, states, index) {
            let inside = interval[0] >= self.window.0 && self.window.1.as_ref().is_none_or(|max| interval[1] <= *max);
            if inside {
                return Some(Item::Node(Node::Root(Box::new(unique.witness(index, interval, outcome)))));
            }
        }
        let claim = (self.certify)(null.value, &null.spread(states.len()))?;
        let Claim::ExactSolution(c) = &claim else { return None };
        // Its null vector must be the leaf's: it moves nothing else, and y = 0 on all that moves here.
        let moves = |i: &usize| self.view.index.iter().position(|k| k == i).is_some_and(|p| states[p] == State::Moving);
        let rest = (0..states.len()).filter(|&p| states[p] == State::Moving).map(|p| index[p]);
        if !c.support.iter().all(moves) || !rest.into_iter().all(|i| c.support.contains(&i) || c.biactive.contains(&i)) {
            return None;
        }
        let interval = c.interval.clone().map(|n| n.0);
        Some(Item::Claimed(Box::new(unique.witness(index, interval, RootOutcome::Claim(0))), Box::new(claim)))
    }

    /// The leaf over [lo, hi], and the rest of the region on both sides of it.
    fn around(&mut self, region: &Region, lo: Rational, hi: Rational, leaf: Item, share: f64) {
        let part = share / 3.0;
        let below = (lo > region.lo).then(|| Region { hi: Some(lo.clone()), ..region.clone() });
        let above = (region.hi.as_ref() != Some(&hi)).then(|| Region { lo: hi, ..region.clone() });
        if let Some(below) = &below {
            self.items.push(Item::Node(Node::Split(Number(lo))));
            self.region(below, part);
        }
        if let Some(above) = &above {
            self.items.push(Item::Node(Node::Split(Number(above.lo.clone()))));
        }
        let solution = is_solution(&leaf);
        self.items.push(leaf);
        self.watch.closed(part, solution);
        match &above {
            Some(above) => self.region(above, part),
            None => self.watch.closed(part, false),
        }
        if below.is_none() {
            self.watch.closed(part, false);
        }
    }
}

fn is_solution(leaf: &Item) -> bool {
    match leaf {
        Item::Node(Node::Root(r)) => r.outcome == RootOutcome::Solution,
        Item::Node(_) => false,
        Item::Claimed(..) => true,
    }
}

/// A Farkas vector for both ends of an interval, given the game at its middle. What works at both ends works
/// at the middle: where nothing does, the larger game need not be played.
fn farkas(columns: &Columns, middle: &Game, prunable: bool, states: &[State], decided: bool) -> Option<Vec<i64>> {
    if middle.value <= 0.0 {
        return None;
    }
    // The game of both ends does not know the radius; the middle's vector may stand it over all of the interval.
    if prunable && let Some(w) = columns.round(&middle.w) {
        return Some(w);
    }
    let game = columns.play(states);
    // Before a decided region is given to its null vectors a thin margin is worth trying.
    let holds = game.value > if decided { THIN_MARGIN } else { WITNESS_MARGIN };
    if holds { columns.round(&game.w) } else { None }
}

fn definite_leaf(ends: &Ends, states: &[State]) -> Option<Node> {
    let at_infinity = |k: usize| k == 1 && ends.hi.is_infinite() && vanishes(&ends.m[1], states);
    let both = |sign: f64| (0..2).all(|k| at_infinity(k) || definite(&ends.m[k], ends.r.as_ref(), states, sign));
    if both(1.0) {
        Some(Node::PositiveDefinite)
    } else if both(-1.0) {
        Some(Node::NegativeDefinite)
    } else {
        None
    }
}

/// The shortest dyadic number within `slack` of `target` that is no integer: integers and small
/// fractions are where the solutions of hand-made problems lie, and a cut should not meet them.
pub(super) fn short(target: f64, slack: f64) -> Option<Rational> {
    if !(target > 0.0 && slack > 0.0) {
        return None;
    }
    let top = target.log2().floor() as i32;
    (3..=52).find_map(|bits| {
        let unit = f64::from(top - bits).exp2();
        // An odd multiple of the unit.
        let odd = 2.0 * (0.5 * (target / unit - 1.0)).round() + 1.0;
        let v = odd * unit;
        let fits = (v - target).abs() <= slack && v > 0.0 && (unit < 1.0 || slack > 1e6);
        fits.then(|| from_f64(v).ok()).flatten()
    })
}
