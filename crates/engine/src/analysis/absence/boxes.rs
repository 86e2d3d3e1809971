//! Branch and prune over a box [t] x [mu] and the states of the complementarity variables.
//!
//! At the four corners of a box T(t, mu) = T0(t) + mu T1(t) is known up to a radius, and everywhere
//! in the box it is a convex combination of such matrices. A box holds no solution if at all four
//! corners
//!
//! - a Farkas vector w has w'T < 0 in every column that may be in the support, and w_i >= 0 off the
//!   support: then 0 <= w'y = w'T x < 0, or
//! - the symmetric part of T on the variables that may be in the support is definite: then
//!   0 = x'y = x'T x is not zero, or
//! - every variable is decided, and T on the support is regular in the whole box (`regular`).
//!
//! The first two are of first order in the size of the box, the last one is of second order: near a
//! branch of solutions variables are decided before the box is halved often.
//!
//! While both halves of v_T of a particle with zero reaction are open, no leaf can hold: they are
//! decided first. Where no leaf holds, the game at the middle of the box decides what to do. If a
//! Farkas vector works there by enough, the box is halved in the direction in which that vector is
//! lost; else the variable whose complementarity the relaxed solution breaks most is decided. A box
//! in which all is decided is halved until it is empty, or so small that it seems to hold a
//! solution.
//!
//! Input: a piece of [0, infinity) with the expansions of T0 and T1, and the interval of mu.
//! Output: the nodes of its tree in preorder, or the box that could not be emptied. Called by
//! `mod.rs`.

use super::family::at_friction;
use super::regular::Witness;
use crate::search::complete::dyadic::short_near;
use crate::search::complete::leaf::definite::holds_at_both_ends;
use crate::search::complete::leaf::farkas::{self, Columns, MiddleTest};
use crate::search::complete::pieces::expansion::{Ends, Expansion};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::pieces::view::View;
use crate::search::complete::region::{State, undecided};
use crate::search::complete::shares::Shares;
use crate::tolerance::THIN_MARGIN;
use mceip_check::certificate::Node;
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;
use std::rc::Rc;

/// Halvings in a row before a variable is decided instead.
const MAX_CUTS: usize = 24;

/// Halvings in each direction that a Farkas vector may need before a variable is decided instead.
/// It is a leaf of first order in the size of the box; decided boxes have leaves of second order.
const MAX_CUTS_NEEDED: f64 = 3.0;

/// Halvings of a decided box before it counts as one that cannot be emptied.
const MAX_CUTS_DECIDED: usize = 80;

/// How far a cut may lie from the middle: share of the interval.
const SLACK_OF_HALF: f64 = 0.1;

/// A box and the state of each complementarity variable.
#[derive(Clone)]
struct Region {
    /// The interval of lambda^2; `None` for infinity.
    lo: Rational,
    hi: Option<Rational>,
    /// The interval of mu.
    mu: [Rational; 2],
    /// By position.
    states: Vec<State>,
    /// Halvings since the last branch.
    cuts: usize,
}

/// Why a box could not be emptied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::analysis) enum Cause {
    /// It seems to hold a solution.
    Solution,
    /// The remainder of the condensation stands in the way.
    Remainder,
    /// The nodes allowed are used up, or the run was cancelled.
    Budget,
}

/// A box that could not be emptied.
#[derive(Debug, Clone)]
pub(in crate::analysis) struct Blocked {
    pub(in crate::analysis) cause: Cause,
    /// lambda^2 and mu in its middle.
    pub(in crate::analysis) middle: [f64; 2],
    /// The relaxed solution there, by position.
    pub(in crate::analysis) x: Vec<f64>,
}

/// The lines through the middle of a box: a value of lambda^2 with all of mu, and a value of mu
/// with all of lambda^2.
struct Slices {
    of_friction: [Ends; 2],
    of_value: [Ends; 1],
    is_half_line: bool,
}

/// The search of one piece.
pub(super) struct Search<'a> {
    pub(super) view: &'a View,
    /// T0 and T1.
    pub(super) expansions: &'a [Expansion; 2],
    pub(super) shares: &'a Shares<'a>,
    /// Nodes this piece may still use.
    pub(super) budget: usize,
    /// The nodes found, in preorder.
    pub(super) nodes: Vec<Node>,
}

impl Search<'_> {
    /// Covers [lo, hi] x [from, below] with all variables open. `share` is its part of the whole
    /// search.
    pub(super) fn piece(
        &mut self,
        lo: &Rational,
        hi: Option<&Rational>,
        [from, below]: [&Rational; 2],
        share: f64,
    ) -> Result<(), Box<Blocked>> {
        let whole = Region {
            lo: lo.clone(),
            hi: hi.cloned(),
            mu: [from.clone(), below.clone()],
            states: vec![State::Undecided; self.view.order()],
            cuts: 0,
        };

        self.fresh_box(&whole, share)
    }

    /// Covers a region whose interval of lambda^2 is new.
    fn fresh_box(&mut self, region: &Region, share: f64) -> Result<(), Box<Blocked>> {
        let hi = match &region.hi {
            Some(hi) => to_f64(hi),
            None => f64::INFINITY,
        };
        let lo = to_f64(&region.lo);
        let ends = Rc::new(self.ends(lo, hi));
        self.node(region, &ends, share)
    }

    /// T0 and T1 over an interval of lambda^2.
    fn ends(&self, lo: f64, hi: f64) -> [Ends; 2] {
        self.expansions.each_ref().map(|part| part.ends(lo, hi))
    }

    fn leaf(&mut self, node: Node, share: f64) {
        self.nodes.push(node);
        self.shares.closed(share, false);
    }

    /// Covers a region: by a leaf, by halving, or by a branch.
    fn node(
        &mut self,
        region: &Region,
        ends: &Rc<[Ends; 2]>,
        share: f64,
    ) -> Result<(), Box<Blocked>> {
        let frictions = region.mu.each_ref().map(to_f64);
        let middle_friction = 0.5 * (frictions[0] + frictions[1]);
        let middle_value = self.middle(ends[0].lo, ends[0].hi);
        let middle_ends = self.ends(middle_value, middle_value);
        let point = at_friction(&middle_ends, middle_friction);
        let middle = MiddleTest::new(point, &region.states);
        let place = [middle_value, middle_friction];

        if self.budget == 0 || self.shares.is_cancelled() {
            return Err(blocked(Cause::Budget, place, &middle));
        }

        self.budget -= 1;
        if let Some(half) = self.view.undecided_half(&region.states) {
            return self.branch_on(half, region, ends, share);
        }

        let corners = frictions.map(|mu| at_friction(ends, mu));
        if let Some(leaf) = definite_leaf(&corners, &region.states) {
            self.leaf(leaf, share);
            return Ok(());
        }

        let columns = Columns::of_all(&corners, &region.states);
        if let Some(weights) = farkas::weights(&columns, &middle, &region.states) {
            self.leaf(Node::Farkas(weights), share);
            return Ok(());
        }

        let is_decided = undecided(&region.states).is_empty();
        let witness = if is_decided && self.may_be_regular(ends) {
            Witness::of(&middle.matrix, &region.states)
        } else {
            None
        };
        if let Some(witness) = &witness
            && let Some(leaf) = witness.leaf(&corners, &self.view.index)
        {
            self.leaf(leaf, share);
            return Ok(());
        }

        if is_decided && let Some(cause) = hopeless(region, &middle) {
            return Err(blocked(cause, place, &middle));
        }

        let is_worth_halving = middle.is_prunable
            && region.cuts < MAX_CUTS
            && cuts_needed(&columns, &middle) <= MAX_CUTS_NEEDED;
        if !is_decided && !is_worth_halving {
            return self.branch(region, ends, &middle, share);
        }

        let slices = self.slices(ends, place, region);
        let along_friction = match &witness {
            Some(witness) => witness.excess(&slices.of_friction) > witness.excess(&slices.of_value),
            None => self.is_lost_along_friction(&slices, &middle, region),
        };
        self.halve(region, ends, place, along_friction, share)
    }

    /// The middle lines of a box.
    fn slices(&self, ends: &[Ends; 2], [value, friction]: [f64; 2], region: &Region) -> Slices {
        let at_value = self.ends(value, value);
        Slices {
            of_friction: corners_at(&at_value, region),
            of_value: [at_friction(ends, friction)],
            is_half_line: ends[0].is_half_line(),
        }
    }

    /// May a leaf `regular` stand over this interval?
    fn may_be_regular(&self, ends: &[Ends; 2]) -> bool {
        !ends[0].is_half_line() || self.expansions[0].reversed
    }

    /// A value in the middle of an interval, in theta.
    fn middle(&self, lo: f64, hi: f64) -> f64 {
        let theta = 0.5 * (self.view.theta(lo) + self.view.theta(hi));
        self.view.value(theta).clamp(lo, hi)
    }

    /// In which direction does the witness of the middle lose more of its margin: along mu, rather
    /// than along lambda^2?
    fn is_lost_along_friction(
        &self,
        slices: &Slices,
        middle: &MiddleTest,
        region: &Region,
    ) -> bool {
        let w = &middle.game.w;
        let along_friction = Columns::of_all(&slices.of_friction, &region.states).margin_of(w);
        if slices.is_half_line {
            return along_friction < 0.0; // a direction and a matrix have no common unit
        }

        let along_value = Columns::of_all(&slices.of_value, &region.states).margin_of(w);
        along_friction < along_value
    }

    /// Covers both halves of a box.
    fn halve(
        &mut self,
        region: &Region,
        ends: &Rc<[Ends; 2]>,
        place: [f64; 2],
        along_friction: bool,
        share: f64,
    ) -> Result<(), Box<Blocked>> {
        let mut lower = region.clone();
        lower.cuts += 1;
        let mut upper = lower.clone();

        if along_friction {
            let cut = cut_near(place[1], &region.mu[0], Some(&region.mu[1]));
            lower.mu[1].clone_from(&cut);
            upper.mu[0].clone_from(&cut);
            self.nodes.push(Node::Friction(Number(cut)));
            self.node(&lower, ends, 0.5 * share)?;
            return self.node(&upper, ends, 0.5 * share);
        }

        let cut = cut_near(place[0], &region.lo, region.hi.as_ref());
        lower.hi = Some(cut.clone());
        upper.lo.clone_from(&cut);
        self.nodes.push(Node::Split(Number(cut)));
        self.fresh_box(&lower, 0.5 * share)?;
        self.fresh_box(&upper, 0.5 * share)
    }

    /// Decides the variable whose complementarity the relaxed solution of the middle breaks most:
    /// the one with the largest min(x_i, y_i), y_i in units of the largest entry of its row.
    fn branch(
        &mut self,
        region: &Region,
        ends: &Rc<[Ends; 2]>,
        middle: &MiddleTest,
        share: f64,
    ) -> Result<(), Box<Blocked>> {
        self.branch_on(most_violated(region, middle), region, ends, share)
    }

    /// Decides the variable at this position. One half of v_T rests where the other one moves.
    fn branch_on(
        &mut self,
        position: usize,
        region: &Region,
        ends: &Rc<[Ends; 2]>,
        share: f64,
    ) -> Result<(), Box<Blocked>> {
        self.nodes.push(Node::Branch(self.view.index[position]));
        for state in [State::AtZero, State::InSupport] {
            let mut child = region.clone();
            child.states[position] = state;
            if state == State::InSupport
                && let Some(other) = self.view.other_half(position)
            {
                child.states[other] = State::AtZero;
            }
            child.cuts = 0;
            self.node(&child, ends, 0.5 * share)?;
        }

        Ok(())
    }
}

/// How often a box has to be halved in each direction until the witness of its middle holds at its
/// corners, if its margin falls in proportion to the width.
fn cuts_needed(columns: &Columns, middle: &MiddleTest) -> f64 {
    let w = &middle.game.w;
    let margin = middle.columns.margin_of(w);
    let loss = margin - columns.margin_of(w);
    (loss / margin).log2()
}

/// Is a decided box beyond hope, and why?
fn hopeless(region: &Region, middle: &MiddleTest) -> Option<Cause> {
    if middle.game.value <= THIN_MARGIN || region.cuts >= MAX_CUTS_DECIDED {
        return Some(Cause::Solution);
    }

    // A smaller box has the same radius at this point.
    let is_held_up_by_radius = middle.columns.margin_of(&middle.game.w) <= 0.0;
    is_held_up_by_radius.then_some(Cause::Remainder)
}

/// The ends over an interval of lambda^2 at both ends of a region's mu.
fn corners_at(ends: &[Ends; 2], region: &Region) -> [Ends; 2] {
    region.mu.each_ref().map(|mu| at_friction(ends, to_f64(mu)))
}

fn definite_leaf(corners: &[Ends; 2], states: &[State]) -> Option<Node> {
    let is_definite = |sign| {
        corners
            .iter()
            .all(|ends| holds_at_both_ends(ends, states, sign))
    };
    if is_definite(1.0) {
        Some(Node::PositiveDefinite)
    } else if is_definite(-1.0) {
        Some(Node::NegativeDefinite)
    } else {
        None
    }
}

/// The open variable with the largest min(x_i, y_i) at the middle, the first of several.
fn most_violated(region: &Region, middle: &MiddleTest) -> usize {
    let x = middle.relaxed_solution();
    let mut most = None;
    for position in undecided(&region.states) {
        let row = &middle.matrix[position];
        let size = row.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        let y_i = dot(row, &x) / size;
        let violation = x[position].min(y_i);
        if most.is_none_or(|(largest, _)| violation > largest) {
            most = Some((violation, position));
        }
    }

    most.map_or(0, |(_, position)| position)
}

fn blocked(cause: Cause, middle: [f64; 2], test: &MiddleTest) -> Box<Blocked> {
    Box::new(Blocked {
        cause,
        middle,
        x: test.relaxed_solution(),
    })
}

/// A short number near a place inside an interval, its middle where there is none.
fn cut_near(target: f64, lo: &Rational, hi: Option<&Rational>) -> Rational {
    let slack = match hi {
        Some(hi) => SLACK_OF_HALF * to_f64(&(hi - lo)),
        None => SLACK_OF_HALF * target,
    };

    let short = short_near(target, slack);
    let inside = short.filter(|cut| cut > lo && hi.is_none_or(|hi| cut < hi));
    match (inside, hi) {
        (Some(cut), _) => cut,
        (None, Some(hi)) => (lo + hi) / Rational::from_integer(2.into()),
        (None, None) => lo * Rational::from_integer(2.into()) + Rational::from_integer(1.into()),
    }
}
