//! The search for a proof that a box [t] x [mu] holds no solution.
//!
//! A box in which every variable is decided is empty if T on its support is regular in the whole
//! box (`leaf::regular`). Definite and Farkas leaves are of first order in the size of the box,
//! this one is of second order: near a branch of solutions variables are decided before the box is
//! halved often. It is halved in the direction in which the witness of its middle is lost, until it
//! is empty, or so small that it seems to hold a solution: there the search of the piece ends.
//!
//! Where the rows of T have weights with which its symmetric part is definite, all supports are
//! excluded at once (`leaf::weighted`), so the box is halved and nothing is decided.
//!
//! Called by `mod.rs`; the rest of the search is `search::complete::tree`.

use crate::search::complete::dyadic::short_near;
use crate::search::complete::leaf::farkas::{FarkasColumns, MiddleTest};
use crate::search::complete::leaf::regular::RegularWitness;
use crate::search::complete::leaf::weighted::Weights;
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::region::{Item, SearchRegion};
use crate::search::complete::tree::{Aim, Here, MAX_CUTS, SLACK_OF_HALF, TreeSearch};
use crate::tolerance::{GUESS_SUPPORT, THIN_MARGIN};
use mceip_check::certificate::Node;
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;

/// Halvings in each direction that a Farkas vector may need before a variable is decided instead.
/// It is a leaf of first order in the size of the box; decided boxes have leaves of second order.
const MAX_CUTS_NEEDED: f64 = 3.0;

/// The same of the weights of a definite leaf in a box in which nothing is decided, in both
/// directions together: there they take the place of a tree of branches. No more than there are
/// variables: few variables are sooner decided.
const MAX_CUTS_OF_WEIGHTS: f64 = 12.0;

/// Below this distance in both directions the weights of the middle fail for another reason than
/// the size of the box. Both together stay below the 1 that they can bear.
const FAR_ENOUGH: f64 = 0.25;

/// Bisections of mu for a guess at a solution.
const GUESS_STEPS: usize = 16;

/// Halvings of a decided box before it counts as one that cannot be emptied.
const MAX_CUTS_DECIDED: usize = 80;

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
    of_friction: [ChordEnds; 2],
    of_value: ChordEnds,
}

impl Slices {
    /// How far the weights of the middle carry, along mu and along lambda^2: below 1 to the end of
    /// the box. To infinity it is 1: a direction and a matrix have no common unit.
    fn distances(&self, weights: &Weights, here: &Here<'_>) -> [f64; 2] {
        let distance = |ends| weights.distance(&here.middle.point, ends, &here.region.states);
        let [low, high] = self.of_friction.each_ref().map(distance);
        let along_value = if self.of_value.is_half_line() {
            1.0
        } else {
            distance(&self.of_value)
        };

        [low.max(high), along_value]
    }
}

/// No solution: the search of a piece ends at the first box that it cannot empty.
pub(super) struct Absence {
    pub(super) blocked: Option<Blocked>,
    pub(super) depth: Depth,
}

/// How far the search of a piece goes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::analysis) enum Depth {
    /// To the first box that would have to be branched, where it ends with a guess at a solution.
    ToBranches,
    /// Until every box is empty, or one cannot be emptied.
    Whole,
}

impl Aim for Absence {
    fn is_over(&self) -> bool {
        self.blocked.is_some()
    }

    /// A leaf `regular`, or both halves.
    fn decided(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64) {
        let witness = if search.may_be_regular(here) {
            RegularWitness::of(here.middle.matrix(), &here.region.states)
        } else {
            None
        };

        if let Some(witness) = &witness
            && let Some(leaf) = witness.leaf(&here.corners, &search.view.index)
        {
            return search.leaf(leaf, share);
        }

        match hopeless(here.region, &here.middle) {
            Some(cause) => search.block(cause, here.region, &here.middle),
            None => search.halve(here, witness.as_ref(), share),
        }
    }

    fn weights(region: &SearchRegion, middle: &MiddleTest) -> Option<Weights> {
        if region.is_decided() {
            return None;
        }

        Weights::of(&middle.point, &region.states)
    }

    fn is_worth_cutting(search: &TreeSearch<'_, Self>, here: &Here<'_>) -> bool {
        if here.region.cuts >= MAX_CUTS {
            return false;
        }

        let most = if here.region.is_undecided() {
            let variables = here.region.states.len() as f64;
            variables.clamp(MAX_CUTS_NEEDED, MAX_CUTS_OF_WEIGHTS)
        } else {
            MAX_CUTS_NEEDED
        };
        let of_weights = search.cuts_of_weights(here);
        let weights_are_near = of_weights.is_some_and(|cuts| cuts <= most);
        let is_prunable = here.middle.is_prunable;
        weights_are_near || (is_prunable && cuts_needed(here) <= MAX_CUTS_NEEDED)
    }

    fn ends_at(search: &mut TreeSearch<'_, Self>, here: &Here<'_>) -> bool {
        match search.aim.depth {
            Depth::Whole => false,
            Depth::ToBranches => {
                search.aim.blocked = Some(search.guess(here));
                true
            }
        }
    }

    fn cut(search: &mut TreeSearch<'_, Self>, here: &Here<'_>, share: f64) {
        search.halve(here, None, share);
    }

    fn leave(search: &mut TreeSearch<'_, Self>, region: &SearchRegion, _share: f64) {
        let middle = search.middle_test(region);
        search.block(Cause::Budget, region, &middle);
    }
}

impl TreeSearch<'_, Absence> {
    fn block(&mut self, cause: Cause, region: &SearchRegion, middle: &MiddleTest) {
        self.aim.blocked = Some(Blocked {
            cause,
            middle: [middle.value, region.middle_friction()],
            x: middle.relaxed_solution(),
        });
    }

    /// A guess at a solution with lambda^2 in the middle of a box: mu is where weights cease to
    /// exist there, by bisection from 0, and x what excludes them.
    fn guess(&self, here: &Here<'_>) -> Blocked {
        let value = here.middle.value;
        let parts = self.ends(value, value);
        let mut mu = here.region.middle_friction();
        let mut x = here.middle.relaxed_solution();
        let mut below = 0.0;
        for _ in 0..GUESS_STEPS {
            let tried = 0.5 * (below + mu);
            let point = ChordEnds::at_friction([&parts[0], &parts[1]], tried);
            match Weights::obstacle(&point, &here.region.states) {
                None => below = tried,
                Some(vector) => {
                    mu = tried;
                    x = vector;
                }
            }
        }

        let largest = x.iter().fold(0.0f64, |most, v| most.max(*v));
        for component in &mut x {
            if *component < GUESS_SUPPORT * largest {
                *component = 0.0;
            }
        }
        Blocked {
            cause: Cause::Solution,
            middle: [value, mu],
            x,
        }
    }

    /// May a leaf `regular` stand over this interval?
    fn may_be_regular(&self, here: &Here<'_>) -> bool {
        !here.ends[0].is_half_line() || self.expansions[0].reversed
    }

    /// The lines through the middle of a box.
    fn slices(&self, here: &Here<'_>) -> Slices {
        let value = here.middle.value;
        let at_value = self.ends(value, value);
        let at_friction =
            |parts: &[ChordEnds], mu| ChordEnds::at_friction([&parts[0], &parts[1]], mu);

        let frictions = here.region.mu.each_ref().map(to_f64);
        Slices {
            of_friction: frictions.map(|mu| at_friction(&at_value, mu)),
            of_value: at_friction(here.ends, here.region.middle_friction()),
        }
    }

    /// How often a box has to be halved, in both directions together, until the weights of its
    /// middle hold at its corners; `None` where halving would not help: the margin at the middle is
    /// lost to rounding.
    fn cuts_of_weights(&self, here: &Here<'_>) -> Option<f64> {
        let weights = here.weights.as_ref()?;
        let distances = self.slices(here).distances(weights, here);
        let cuts = |distance: f64| (distance / FAR_ENOUGH).log2();
        let counted = distances.map(cuts).into_iter().filter(|&cuts| cuts > 0.0);
        let needed: f64 = counted.sum();
        (needed > 0.0).then_some(needed)
    }

    /// Covers both halves of a box, halved in the direction in which the witness of its middle
    /// loses more of its margin.
    fn halve(&mut self, here: &Here<'_>, witness: Option<&RegularWitness>, share: f64) {
        let slices = self.slices(here);
        let is_lost_along_friction = match (witness, &here.weights) {
            (Some(witness), _) => {
                let along_value = witness.excess(std::slice::from_ref(&slices.of_value));
                witness.excess(&slices.of_friction) > along_value
            }
            (None, Some(weights)) => {
                let [along_friction, along_value] = slices.distances(weights, here);
                along_friction > along_value
            }
            (None, None) => is_lost_along_friction(&slices, here),
        };

        let mut rest = here.region.clone();
        rest.cuts += 1;

        if is_lost_along_friction {
            let [from, to] = &rest.mu;
            let cut = cut_near(rest.middle_friction(), from, Some(to));
            let parts = rest.cut_in_mu(&cut);
            self.items.push(Item::Node(Node::Friction(Number(cut))));
            for part in parts {
                self.node(&part, here.ends, None, 0.5 * share);
            }
        } else {
            let cut = cut_near(here.middle.value, &rest.lo, rest.hi.as_ref());
            self.split_at(&cut);
            self.region(&rest.below(&cut), 0.5 * share);
            self.region(&rest.above(&cut), 0.5 * share);
        }
    }
}

/// Does the Farkas vector of the middle lose more of its margin along mu than along lambda^2?
fn is_lost_along_friction(slices: &Slices, here: &Here<'_>) -> bool {
    let w = &here.middle.game.w;
    let states = &here.region.states;
    let along_friction = FarkasColumns::of(&slices.of_friction, states).margin_of(w);
    if slices.of_value.is_half_line() {
        return along_friction < 0.0; // a direction and a matrix have no common unit
    }

    let of_value = std::slice::from_ref(&slices.of_value);
    let along_value = FarkasColumns::of(of_value, states).margin_of(w);
    along_friction < along_value
}

/// How often a box has to be halved in each direction until the witness of its middle holds at its
/// corners, if its margin falls in proportion to the width.
fn cuts_needed(here: &Here<'_>) -> f64 {
    let w = &here.middle.game.w;
    let margin = here.middle.columns.margin_of(w);
    let loss = margin - here.columns.margin_of(w);
    (loss / margin).log2()
}

/// Is a decided box beyond hope, and why?
fn hopeless(region: &SearchRegion, middle: &MiddleTest) -> Option<Cause> {
    if middle.game.value <= THIN_MARGIN || region.cuts >= MAX_CUTS_DECIDED {
        return Some(Cause::Solution);
    }

    // A smaller box has the same radius at this point.
    let is_held_up_by_radius = middle.columns.margin_of(&middle.game.w) <= 0.0;
    is_held_up_by_radius.then_some(Cause::Remainder)
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
