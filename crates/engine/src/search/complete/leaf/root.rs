//! Leaf `root`: T(t) on a support has one null vector over the interval, and what it is.
//!
//! Of a region in which every variable is decided, the null vector is found by Newton's method
//! (`null_vector`). The leaf takes the widest part of the interval around its value over which it
//! is proved to be the only one (`unique`); what is left on both sides is searched further. Its
//! outcome is a solution, a sign that excludes one, the absence of a null vector, or, where signs
//! are not certain in doubles, the claim of an exact solution.
//!
//! Called by `tree` for decided regions with a finite interval; `infinity` does the same for half
//! lines. The checker's side is `check::cover::root`.

mod bounds;
mod unique;

pub(crate) use unique::UniquenessWitness;

use crate::search::complete::dyadic::short_near;
use crate::search::complete::given::Given;
use crate::search::complete::null_vector::{NullVector, null_vector};
use crate::search::complete::pieces::expansion::{ChordEnds, Expansion};
use crate::search::complete::pieces::view::View;
use crate::search::complete::region::{Item, SearchRegion, support};
use mceip_check::certificate::{Claim, Node, RootOutcome, VariableState};
use mceip_exact::{Rational, from_f64, to_f64};
use unique::Located;

/// Steps towards a null vector's value while looking for a part over which it is the only one, and
/// the factor of each step.
const ROOT_STEPS: i32 = 10;
const ROOT_SHRINK: f64 = 0.3;

/// Share of the distance from the value that an end of a part may be off.
const SLACK_OF_DISTANCE: f64 = 0.2;

/// The search for root leaves in one piece.
pub(crate) struct RootSearch<'a> {
    pub(crate) given: &'a Given<'a>,
    pub(crate) view: &'a View,
    pub(crate) expansion: &'a Expansion,
}

/// What the search for a root leaf says of a region.
pub(crate) enum Searched {
    /// No null vector was found, or the interval is too narrow to be divided in doubles.
    Nothing,
    /// A leaf for a part of the interval.
    Part(Box<PartLeaf>),
    /// A null vector with this value that is not provably the only one over any part.
    NotUnique(f64),
}

/// A leaf for the part [lo, hi] of a region's interval.
pub(crate) struct PartLeaf {
    pub(crate) lo: Rational,
    pub(crate) hi: Rational,
    pub(crate) leaf: Item,
    /// The value, if the leaf is a solution.
    pub(crate) solution: Option<f64>,
}

impl RootSearch<'_> {
    /// The root leaf of a region in which every variable is decided.
    pub(crate) fn leaf(&self, region: &SearchRegion, ends: &ChordEnds) -> Searched {
        let Some(null) = null_vector(self.expansion, &region.states, ends.lo, ends.hi) else {
            return Searched::Nothing;
        };

        // Closer to the value step by step; an end on the far side of the value stays.
        for step in 0..ROOT_STEPS {
            let factor = ROOT_SHRINK.powi(step);
            let Some(part) = part_around(region, ends, null.value, factor) else {
                return Searched::Nothing;
            };

            if let Some(found) = self.part_leaf(region, ends, &null, part) {
                return Searched::Part(Box::new(found));
            }
        }

        Searched::NotUnique(null.value)
    }

    /// The leaf of one part of the interval, if its null vector is provably the only one there.
    fn part_leaf(
        &self,
        region: &SearchRegion,
        ends: &ChordEnds,
        null: &NullVector,
        part: [Rational; 2],
    ) -> Option<PartLeaf> {
        let lo = to_f64(&part[0]);
        let hi = to_f64(&part[1]);
        let is_outside = null.value <= lo || hi <= null.value;
        if is_outside && let Some(leaf) = self.absent_leaf(null, &part, lo, hi) {
            let [lo, hi] = part;
            return Some(PartLeaf {
                lo,
                hi,
                leaf,
                solution: None,
            });
        }

        let value = from_f64(null.value).unwrap_or_default();
        let wide = if *self.given.window().min() <= value {
            self.expansion.ends(lo.min(null.value), hi.max(null.value))
        } else {
            self.expansion.ends(lo, hi)
        };

        let unique = UniquenessWitness::of(null, &wide)?;
        let region_and_leaf_ends = [ends.lo, ends.hi, lo, hi];
        let leaf = self.root_leaf(null, &unique, &region.states, region_and_leaf_ends)?;

        let solution = leaf.is_solution().then_some(null.value);
        let [lo, hi] = part;
        Some(PartLeaf {
            lo,
            hi,
            leaf,
            solution,
        })
    }

    /// The proof that no null vector has a value in [lo, hi], which is `part` in doubles.
    fn absent_leaf(
        &self,
        null: &NullVector,
        part: &[Rational; 2],
        lo: f64,
        hi: f64,
    ) -> Option<Item> {
        let ends = self.expansion.ends(lo, hi);
        let unique = UniquenessWitness::of(null, &ends)?;
        if !unique.is_absent(&ends) {
            return None;
        }

        let root = unique.witness(&self.view.index, part.clone(), RootOutcome::Absent);
        Some(Item::Node(Node::Root(Box::new(root))))
    }

    /// The leaf of the only null vector: by its signs, or by the claim of an exact solution.
    fn root_leaf(
        &self,
        null: &NullVector,
        unique: &UniquenessWitness,
        states: &[VariableState],
        ends: [f64; 4],
    ) -> Option<Item> {
        let index = &self.view.index;
        let vanishing = self.view.vanishing(states);
        let indices = [index.as_slice(), &vanishing];
        let located = unique.outcome(self.expansion, null.value, ends, states, indices);
        if let Some(Located { interval, outcome }) = located
            && self.given.has_in_window(&interval)
        {
            let root = unique.witness(index, interval, outcome);
            return Some(Item::Node(Node::Root(Box::new(root))));
        }

        let claim = self.given.certify(null.value, null.spread(states.len()))?;
        let Claim::ExactSolution(solution) = &claim else {
            return None;
        };

        if !self.belongs_to(&solution.support, &solution.biactive, states) {
            return None;
        }

        let interval = solution.interval.clone().map(|number| number.0);
        let root = unique.witness(index, interval, RootOutcome::Claim(0));
        Some(Item::Claimed(Box::new(root), Box::new(claim)))
    }

    /// Is the null vector of an exact solution that of the leaf? Its support lies in the leaf's,
    /// and y = 0 on all of the leaf's.
    fn belongs_to(
        &self,
        solution_support: &[usize],
        biactive: &[usize],
        states: &[VariableState],
    ) -> bool {
        let leaf_support = self.view.variables(&support(states));
        let is_inside = solution_support.iter().all(|i| leaf_support.contains(i));
        let is_active = leaf_support
            .iter()
            .all(|i| solution_support.contains(i) || biactive.contains(i));
        is_inside && is_active
    }
}

/// The region's interval, each end moved to `factor` of its distance from the value. An end on the
/// far side of the value stays. `None` where that is no interval inside the region's.
pub(crate) fn part_around(
    region: &SearchRegion,
    ends: &ChordEnds,
    value: f64,
    factor: f64,
) -> Option<[Rational; 2]> {
    let region_hi = region.hi.as_ref()?;
    let lo = if factor == 1.0 || ends.lo >= value {
        region.lo.clone()
    } else {
        nearer(ends.lo, value, factor)?
    };

    let hi = if factor == 1.0 || ends.hi <= value {
        region_hi.clone()
    } else {
        nearer(ends.hi, value, factor)?
    };

    let is_inside = lo >= region.lo && hi <= *region_hi && lo < hi;
    is_inside.then_some([lo, hi])
}

/// A short number at `factor` of the distance from the value to an end.
fn nearer(end: f64, value: f64, factor: f64) -> Option<Rational> {
    let whole_distance = end - value;
    let distance = whole_distance.abs() * factor;
    let target = value + distance.copysign(whole_distance);
    let slack = SLACK_OF_DISTANCE * distance;
    short_near(target, slack)
}
