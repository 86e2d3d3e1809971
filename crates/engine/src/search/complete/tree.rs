//! Branch and prune over an interval of the unknown and the states of the complementarity
//! variables.
//!
//! A region is closed by a definite symmetric part, a Farkas vector or, once every index is
//! decided, by its only null vector. Else the test at the middle decides what to do: if a Farkas
//! vector works there, the interval is cut where it stops working; if none does, the index whose
//! complementarity the relaxed solution breaks most is decided.

use crate::search::complete::game::Game;
use crate::search::complete::leaf::farkas::{Columns, definite, vanishes};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::pieces::view::{Ends, Expansion, Matrix, View};
use crate::search::complete::region::{Item, Region, State};
use crate::search::complete::shares::Shares;
use crate::tolerance::{NARROW, THIN_MARGIN, WITNESS_MARGIN};
use mceip_check::certificate::{Claim, Node, RootOutcome, Support};
use mceip_exact::{Integer, Rational, from_f64, to_f64};
use mceip_model::file::Number;
use std::rc::Rc;

/// Cuts in a row before an index is decided instead: on a finite and on an infinite interval.
const MAX_CUTS: [usize; 2] = [24, 3];

/// Cuts of a decided region before exact arithmetic is asked: where there is a simple root, two or
/// three end at it, and the polynomials of a support take long.
const CUTS_BEFORE_EXACT: usize = 8;

/// Cuts on both sides of a null vector that is not provably alone, before the rest stays open.
const MAX_CUTS_SUSPECT: usize = 6;

/// Exact solutions where doubles cannot tell: value and x over the positions to a claim.
pub(super) type Certify<'a> = dyn Fn(f64, &[f64]) -> Option<Claim> + Sync + 'a;

/// A null vector of the pencil's limit at infinity over the variables of the pencil, for a moving
/// set that has one.
pub(super) type Limit<'a> = dyn Fn(&[usize]) -> Option<Vec<Integer>> + Sync + 'a;

/// Exact factors that prove the symmetric part definite from a value on, without the variables
/// given.
pub(super) type DefiniteFrom<'a> = dyn Fn(&Rational, &[usize]) -> Option<Node> + Sync + 'a;

/// What one support holds over an interval, exactly, if that can be decided.
pub(super) type Decide<'a> =
    dyn Fn(&[usize], &Rational, Option<&Rational>) -> Option<Support> + Sync + 'a;

/// One piece's search.
pub(super) struct Search<'a> {
    pub(super) view: &'a View,
    pub(super) expansion: &'a Expansion,
    pub(super) certify: &'a Certify<'a>,
    pub(super) decide: &'a Decide<'a>,
    pub(super) limit: &'a Limit<'a>,
    pub(super) definite_from: &'a DefiniteFrom<'a>,
    pub(super) shares: &'a Shares<'a>,
    /// Nodes this piece may still use.
    pub(super) budget: usize,
    pub(super) items: Vec<Item>,
    /// Values of null vectors that were met, decided or not.
    pub(super) met: Vec<f64>,
    /// Window of the certificate: a root's interval stays inside.
    pub(super) window: (Rational, Option<Rational>),
}

impl Search<'_> {
    /// Covers a region; what it finds is appended to the items. `share` is its part of the whole
    /// search.
    pub(super) fn region(&mut self, region: &Region, share: f64) {
        let (lo, hi) = self.ends_of(region);
        let ends = Rc::new(self.expansion.ends(lo, hi));
        self.node(region, &ends, share);
    }

    fn ends_of(&self, region: &Region) -> (f64, f64) {
        (
            to_f64(&region.lo),
            region.hi.as_ref().map_or(f64::INFINITY, to_f64),
        )
    }

    pub(super) fn leaf(&mut self, node: Node, share: f64) {
        let solution = matches!(&node, Node::Root(r) if matches!(r.outcome, RootOutcome::Solution | RootOutcome::Claim(_)));
        self.items.push(Item::Node(node));
        self.shares.closed(share, solution);
    }

    fn node(&mut self, region: &Region, ends: &Rc<Ends>, share: f64) {
        if self.budget == 0 || self.shares.is_cancelled() {
            return self.leaf(Node::Open, share);
        }
        self.budget -= 1;
        if let Some(leaf) =
            definite_leaf(ends, &region.states).or_else(|| self.half_line(region, ends))
        {
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
        let is_infinite = ends.hi.is_infinite();
        if decided
            && if is_infinite {
                self.at_infinity(region, ends, share)
            } else {
                self.roots(region, ends, share)
            }
        {
            return;
        }
        let cuts_left = if region.suspect {
            MAX_CUTS_SUSPECT
        } else {
            4 * MAX_CUTS[0]
        };
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
    fn cut(
        &mut self,
        region: &Region,
        ends: &Ends,
        columns: &Columns,
        w: &[f64],
        middle: f64,
        share: f64,
    ) {
        let width = ends.hi - ends.lo;
        let range = if width.is_finite() {
            columns.range(w, (middle - ends.lo) / width)
        } else {
            None
        };
        let cuts: Vec<Rational> = match range {
            // Worth two cuts only if a good part of the interval goes.
            Some((a, b)) if b - a > 0.2 => {
                let inner = 0.05 * (b - a);
                let at = |v: f64, keep: bool| {
                    keep.then(|| short(ends.lo + v * width, inner * width))
                        .flatten()
                };
                [at(a + inner, a > 0.0), at(b - inner, b < 1.0)]
                    .into_iter()
                    .flatten()
                    .collect()
            }
            _ => short(middle, 0.1 * if width.is_finite() { width } else { middle })
                .into_iter()
                .collect(),
        };
        let inside = |c: &Rational| *c > region.lo && region.hi.as_ref().is_none_or(|hi| c < hi);
        let cuts: Vec<Rational> = cuts.into_iter().filter(inside).collect();
        if cuts.is_empty() || (cuts.len() == 2 && cuts[0] >= cuts[1]) {
            return self.give_up(region, share); // the interval is too narrow for doubles
        }
        let mut rest = Region {
            cuts: region.cuts + 1,
            ..region.clone()
        };
        let part = share / (cuts.len() + 1) as f64;
        for at in cuts {
            self.items.push(Item::Node(Node::Split(Number(at.clone()))));
            self.region(
                &Region {
                    hi: Some(at.clone()),
                    ..rest.clone()
                },
                part,
            );
            rest.lo = at;
        }
        self.region(&rest, part);
    }

    /// Decides the index whose complementarity the relaxed solution of the middle breaks most.
    fn branch(
        &mut self,
        region: &Region,
        ends: &Rc<Ends>,
        at: &Columns,
        mix: &[f64],
        m: &Matrix,
        share: f64,
    ) {
        let n = region.states.len();
        let mut x = vec![0.0; n];
        at.variable.iter().zip(mix).for_each(|(&j, q)| x[j] = *q);
        let size = |i: usize| m[i].iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        let y = |i: usize| dot(&m[i], &x) / size(i);
        let open = (0..n).filter(|&i| region.states[i] == State::Open);
        let Some(i) =
            open.max_by(|&i, &j| x[i].min(y(i)).total_cmp(&x[j].min(y(j))).then(j.cmp(&i)))
        else {
            return self.leaf(Node::Open, share);
        };
        self.items
            .push(Item::Node(Node::Branch(self.view.index[i])));
        for state in [State::Rest, State::Moving] {
            let mut child = Region {
                cuts: 0,
                ..region.clone()
            };
            child.states[i] = state;
            self.node(&child, ends, 0.5 * share);
        }
    }
}

/// A Farkas vector for both ends of an interval, given the game at its middle. What works at both
/// ends works at the middle: where nothing does, the larger game need not be played.
fn farkas(
    columns: &Columns,
    middle: &Game,
    prunable: bool,
    states: &[State],
    decided: bool,
) -> Option<Vec<i64>> {
    if middle.value <= 0.0 {
        return None;
    }
    // The game of both ends does not know the radius; the middle's vector may stand it over all of
    // the interval.
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
    let both = |sign: f64| {
        (0..2).all(|k| at_infinity(k) || definite(&ends.m[k], ends.r.as_ref(), states, sign))
    };
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
