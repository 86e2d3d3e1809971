//! Decided regions whose null vector is known and whose signs are beyond doubles.
//!
//! A local mode has components and reactions of 1e-20 of the largest. In doubles neither x > 0 nor
//! y > 0 can be told there, and such regions stay open. The piece gets an anchor with a long W
//! (`pieces::precise_anchor`), the null vector of the pencil condensed with it is computed in long
//! numbers, and the checker, whose arithmetic is exact, reads the signs off both.
//!
//! A null vector whose value lies next to a region, closer than doubles tell, leaves that region
//! open as well. There the long numbers show that the region has none.
//!
//! Input: a cover that the checker has accepted, with open leaves. Output: the cover with `root`
//! leaves in their place, for the checker to judge. Called by `rounds` at the end of a search.

use super::given::Given;
use super::leaf::root::UniquenessWitness;
use super::null_vector::null_vector;
use super::pieces::expansion::Expansion;
use super::pieces::precise_anchor::{precise_anchor, tangent};
use super::pieces::prepared::Prepared;
use super::pieces::view::View;
use super::region::{SearchRegion, support};
use crate::candidate::Candidate;
use crate::certify::{PreciseNull, precise_null};
use crate::magnitude::{binary_order, in_units, two_to};
use crate::tolerance::NEAR_ANCHOR;
use mceip_check::certificate::{
    Anchor, Certificate, CompleteSet, Condensation, Node, Root, RootOutcome, VariableState,
};
use mceip_exact::{Rational, from_f64, to_f64};
use num_traits::{Signed, Zero};

/// With more open regions than this none is looked at: each costs a dense inverse.
const MAX_REGIONS: usize = 64;
/// Bits of the null vector and of its value. Basis: the checker keeps 128 bits of each entry of the
/// condensed pencil.
const VECTOR_BITS: u32 = 128;
/// Half width of a value's interval, relative: 2^-this. Basis: the signs of components of 2^-80 are
/// decided, and a sign change over the interval stands out from entries that are cut off at 2^-128.
const INTERVAL_BITS: u32 = 96;
/// A value below 2^-this of the view's scale has the interval of that one. Basis: near a threshold
/// lambda^2 is 2^-20 of the scale, and an interval relative to it moves T by less than 2^-116,
/// which the rounding of W hides.
const LEAST_VALUE_BITS: u32 = 10;

/// A region narrower than this share of the view's scale is looked at with this width, 2^-30.
/// Basis: over a shorter way the slope of T is lost in doubles. What is unique over more is unique
/// in it.
const LEAST_WIDTH: f64 = 1.0 / (1_u64 << 30) as f64;

/// Tangents at most, each at the value of the null vector of the one before.
const TANGENTS: usize = 8;

/// An open region with every variable decided, by its place in the cover.
struct OpenLeaf {
    piece: usize,
    node: usize,
    region: SearchRegion,
}

/// What long numbers say of the open leaves of a piece.
struct LongPiece {
    /// The leaves that are decided, each with its node.
    roots: Vec<(usize, Root)>,
    /// An anchor about the first value, where there are free variables.
    anchor: Option<Anchor>,
}

/// A component of a vector by its variable.
type IndexedNumber = (usize, Rational);

/// The certificate with the open regions that long numbers decide closed, for the checker to judge;
/// `None` if there are none.
pub(super) fn closed(
    given: &Given<'_>,
    prepared: &Prepared,
    certificate: &Certificate,
) -> Option<Certificate> {
    let set = certificate.complete_set.as_ref()?;
    let leaves = open_leaves(given, prepared, set);
    if leaves.is_empty() || leaves.len() > MAX_REGIONS {
        return None;
    }

    let mut longer = set.clone();
    let mut is_changed = false;
    for (number, piece) in set.pieces.iter().enumerate() {
        let of_piece = leaves.iter().filter(|leaf| leaf.piece == number);
        let expansion = prepared.view.expansion(piece.anchor);
        let search = LongSearch {
            given,
            view: &prepared.view,
            expansion,
            condensation: set.condensation.as_ref(),
        };
        let long = search.piece(of_piece);
        if long.roots.is_empty() {
            continue;
        }

        if let (Some(condensation), Some(anchor)) = (&mut longer.condensation, long.anchor) {
            condensation.anchors.push(anchor);
            longer.pieces[number].anchor = Some(condensation.anchors.len() - 1);
        }
        for (node, root) in long.roots {
            longer.pieces[number].tree[node] = Node::Root(Box::new(root));
        }

        is_changed = true;
    }

    is_changed.then(|| Certificate {
        complete_set: Some(longer),
        ..certificate.clone()
    })
}

/// The open leaves in which every variable is decided, the support is not empty and the interval is
/// finite.
fn open_leaves(given: &Given<'_>, prepared: &Prepared, set: &CompleteSet) -> Vec<OpenLeaf> {
    let view = &prepared.view;
    let mut leaves = Vec::new();
    let mut lo = given.window().min().clone();

    for (k, piece) in set.pieces.iter().enumerate() {
        let hi = piece.max.as_ref().map(|number| number.0.clone());
        let has_anchor = piece.anchor.is_some() && !view.expansion(piece.anchor).reversed;
        let is_enclosed = set.condensation.is_none() || has_anchor;

        let mut waiting = vec![SearchRegion::whole(lo.clone(), hi.clone(), view.order())];
        for (node, what) in piece.tree.iter().enumerate() {
            // The checker has accepted the tree, so it does not end early.
            let Some(region) = waiting.pop() else { break };
            if let Some(parts) = region.parts(what, view) {
                waiting.extend(parts);
            } else if *what == Node::Open && is_enclosed && can_be_looked_at(&region) {
                leaves.push(OpenLeaf {
                    piece: k,
                    node,
                    region,
                });
            }
        }

        lo = hi.unwrap_or(lo);
    }

    leaves
}

fn can_be_looked_at(region: &SearchRegion) -> bool {
    if region.hi.is_none() || !region.is_decided() {
        return false;
    }

    region.states.contains(&VariableState::InSupport)
}

/// What the open leaves of one piece are looked at with.
struct LongSearch<'a> {
    given: &'a Given<'a>,
    view: &'a View,
    expansion: &'a Expansion,
    condensation: Option<&'a Condensation>,
}

impl LongSearch<'_> {
    /// The leaves that are decided, with an anchor about the first value that is found.
    fn piece<'l>(&self, leaves: impl Iterator<Item = &'l OpenLeaf>) -> LongPiece {
        let mut long = LongPiece {
            roots: Vec::new(),
            anchor: None,
        };
        for leaf in leaves {
            let root = self.root(&leaf.region, &mut long.anchor);
            long.roots.extend(root.map(|root| (leaf.node, root)));
        }

        long
    }

    /// The leaf of a decided region by the only null vector that is near: what its signs say if its
    /// value lies in the region, `Absent` if the value lies outside. `None` if it is not decided.
    fn root(&self, region: &SearchRegion, anchor: &mut Option<Anchor>) -> Option<Root> {
        let view = self.view;
        let region_hi = region.hi.as_ref()?;
        let lo = to_f64(&region.lo);
        let hi = to_f64(region_hi).max(lo + LEAST_WIDTH * view.scale);
        let null = null_vector(self.expansion, &region.states, lo, hi)?;
        let unique = UniquenessWitness::of(&null, &self.expansion.ends(lo, hi))?;

        let moving = support(&region.states);
        let candidate = Candidate {
            value: null.value,
            x: null.spread(view.order()),
        };
        let precise = self.precise_null(candidate, &moving, anchor)?;

        let variable = |(position, v)| (view.index[position], v);
        let x: Vec<IndexedNumber> = precise.x.into_iter().map(variable).collect();
        if precise.value < region.lo || precise.value > *region_hi {
            let interval = [region.lo.clone(), region_hi.clone()];
            let mut root = unique.witness(&view.index, interval, RootOutcome::Absent);
            lengthen(&mut root, &x)?;
            return Some(root);
        }

        let half = half_width(&precise.value, view.scale)?;
        let begin = &precise.value - &half;
        let end = &precise.value + &half;
        let is_inside =
            begin >= region.lo && end <= *region_hi && begin >= *self.given.window().min();
        if !is_inside {
            return None;
        }

        let mut y: Vec<IndexedNumber> = precise.y.into_iter().map(variable).collect();
        let vanishing = view.vanishing(&region.states);
        y.retain(|(i, _)| !vanishing.contains(i));

        let mut root = unique.witness(&view.index, [begin, end], RootOutcome::Solution);
        let at_pivot = lengthen(&mut root, &x)?;
        root.outcome = outcome(&divided(&x, &at_pivot), &divided(&y, &at_pivot));
        Some(root)
    }

    /// The null vector on these positions next to a candidate, of the pencil on the
    /// complementarity variables: as given where there are no free variables, else of its tangent
    /// at the candidate, until that is at the value itself.
    ///
    /// The anchor that serves is kept where there is none yet.
    fn precise_null(
        &self,
        mut candidate: Candidate,
        moving: &[usize],
        kept: &mut Option<Anchor>,
    ) -> Option<PreciseNull> {
        let pencil = self.given.pencil;
        let Some(condensation) = self.condensation else {
            return precise_null(pencil, moving, &candidate, VECTOR_BITS);
        };

        let mut own = None;
        for _ in 0..TANGENTS {
            let value = from_f64(candidate.value).ok()?;
            let reach = self.view.scale.max(candidate.value.abs()) * NEAR_ANCHOR;
            let is_near = |made: &Anchor| (to_f64(&made.center.0) - candidate.value).abs() <= reach;
            let served = own.as_ref().or(kept.as_ref());
            if !served.is_some_and(is_near) {
                own = Some(precise_anchor(pencil, condensation, &value)?);
            }

            let anchor = own.as_ref().or(kept.as_ref())?;
            let near = tangent(pencil, anchor, &value)?;
            let found = precise_null(&near, moving, &candidate, VECTOR_BITS)?;
            if to_f64(&found.value) == candidate.value {
                *kept = kept.take().or(own);
                return Some(found);
            }

            candidate.value = to_f64(&found.value);
            for (position, x) in &found.x {
                candidate.x[*position] = to_f64(x);
            }
        }

        None
    }
}

/// Puts the long null vector x, scaled to 1 at the pivot, into a root, and gives what x is there;
/// `None` where that is zero.
fn lengthen(root: &mut Root, x: &[IndexedNumber]) -> Option<Rational> {
    let at_pivot = x.iter().find(|(i, _)| *i == root.pivot);
    let scale = at_pivot.map(|(_, x)| x).filter(|x| !x.is_zero())?;
    let x = divided(x, scale);

    let more_bits = VECTOR_BITS - root.exponent;
    for u in &mut root.left {
        *u <<= more_bits;
    }

    root.right = x
        .iter()
        .filter(|(i, _)| *i != root.pivot)
        .map(|(_, v)| in_units(v, VECTOR_BITS.into()))
        .collect();
    root.exponent = VECTOR_BITS;
    Some(scale.clone())
}

fn divided(list: &[IndexedNumber], scale: &Rational) -> Vec<IndexedNumber> {
    let mut quotients = Vec::with_capacity(list.len());
    for (i, v) in list {
        quotients.push((*i, v / scale));
    }

    quotients
}

/// What the signs of x, scaled to 1 at the pivot, and of y say.
fn outcome(x: &[IndexedNumber], y: &[IndexedNumber]) -> RootOutcome {
    if let Some(i) = most_negative(x) {
        RootOutcome::NegativeX(i)
    } else if let Some(i) = most_negative(y) {
        RootOutcome::NegativeY(i)
    } else {
        RootOutcome::Solution
    }
}

fn most_negative(list: &[IndexedNumber]) -> Option<usize> {
    list.iter()
        .filter(|(_, v)| v.is_negative())
        .min_by(|p, q| p.1.cmp(&q.1))
        .map(|(i, _)| *i)
}

/// 2^-[`INTERVAL_BITS`] of a power of two near a positive value, or near the least one that the
/// scale of values allows.
fn half_width(value: &Rational, scale: f64) -> Option<Rational> {
    if !value.is_positive() {
        return None;
    }

    let least_magnitude = scale.log2().floor() as i64 - i64::from(LEAST_VALUE_BITS);
    let magnitude = binary_order(value).max(least_magnitude);
    Some(two_to(magnitude - i64::from(INTERVAL_BITS)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    #[test]
    fn the_most_negative_component_is_named() {
        let positive = [(0, whole(1))];
        let negative_y = [(3, whole(-1))];

        let x = [(0, whole(1)), (1, rational(-1, 100)), (2, rational(-1, 10))];
        assert_eq!(outcome(&x, &negative_y), RootOutcome::NegativeX(2));

        let y = [(3, rational(-1, 9)), (4, rational(-1, 8)), (5, whole(1))];
        assert_eq!(outcome(&positive, &y), RootOutcome::NegativeY(4));

        let positive_y = [(1, whole(1))];
        assert_eq!(outcome(&positive, &positive_y), RootOutcome::Solution);
    }

    #[test]
    fn half_widths_are_relative() {
        let unit = two_to(INTERVAL_BITS.into());
        for value in [rational(1, 1000), whole(1), whole(4_000_000_000)] {
            let ratio = half_width(&value, 1.0).unwrap() * &unit / &value;
            assert!(ratio > rational(1, 4) && ratio <= whole(2), "{value}");
        }

        assert!(half_width(&whole(0), 1.0).is_none());
    }

    #[test]
    fn values_near_zero_have_the_width_of_the_least_one() {
        let unit = two_to(INTERVAL_BITS.into());
        let scale = 2.0f64.powi(30);
        let least = two_to(20);

        for value in [rational(1, 1000), whole(361), least.clone()] {
            let half = half_width(&value, scale).unwrap();
            assert_eq!(half, &least / &unit, "{value}");
        }

        let value = whole(4_000_000_000);
        assert_eq!(half_width(&value, scale), half_width(&value, 1.0));
    }
}
