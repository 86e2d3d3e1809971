//! Decided regions whose null vector is known and whose signs are beyond doubles.
//!
//! A local mode has components and reactions of 1e-20 of the largest. In doubles neither x > 0 nor
//! y > 0 can be told there, and such regions stay open. The null vector is computed again in long
//! numbers, the piece gets an anchor whose W is as long (`pieces::precise_anchor`), and the
//! checker, whose arithmetic is exact, reads the signs off both.
//!
//! Input: a cover that the checker has accepted, with open leaves. Output: the cover with `root`
//! leaves in their place, for the checker to judge. Called by `rounds` at the end of a search.

use super::given::Given;
use super::leaf::root::UniquenessWitness;
use super::null_vector::null_vector;
use super::pieces::expansion::Expansion;
use super::pieces::precise_anchor::precise_anchor;
use super::pieces::prepared::Prepared;
use super::pieces::view::View;
use super::region::{SearchRegion, support};
use crate::candidate::Candidate;
use crate::certify::{ENCLOSED_ORDER, precise_null};
use crate::magnitude::{binary_order, in_units, two_to};
use crate::reduction::with_free_variables;
use mceip_check::certificate::{Certificate, CompleteSet, Node, Root, RootOutcome, VariableState};
use mceip_exact::{Rational, to_f64};
use num_traits::{Signed, Zero};

/// Open regions that are looked at, at most: each costs a dense inverse.
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

/// An open region with every variable decided, by its place in the cover.
struct OpenLeaf {
    piece: usize,
    node: usize,
    region: SearchRegion,
}

/// A root for the node of a piece.
struct PlacedRoot {
    node: usize,
    root: Root,
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
    for piece in 0..set.pieces.len() {
        let of_piece = leaves.iter().filter(|leaf| leaf.piece == piece);
        let roots: Vec<PlacedRoot> = of_piece
            .filter_map(|leaf| placed_root(given, prepared, set, leaf))
            .collect();
        let Some(first) = roots.first() else {
            continue;
        };

        if !lengthen(given, &mut longer, piece, &middle(&first.root)) {
            continue;
        }

        for PlacedRoot { node, root } in roots {
            longer.pieces[piece].tree[node] = Node::Root(Box::new(root));
        }

        is_changed = true;
    }

    is_changed.then(|| Certificate {
        complete_set: Some(longer),
        ..certificate.clone()
    })
}

fn placed_root(
    given: &Given<'_>,
    prepared: &Prepared,
    set: &CompleteSet,
    leaf: &OpenLeaf,
) -> Option<PlacedRoot> {
    let anchor = set.pieces[leaf.piece].anchor;
    let expansion = prepared.view.expansion(anchor);
    let root = root(given, &prepared.view, expansion, &leaf.region)?;
    Some(PlacedRoot {
        node: leaf.node,
        root,
    })
}

fn middle(root: &Root) -> Rational {
    let [lo, hi] = &root.interval;
    let two = Rational::from_integer(2.into());
    (&lo.0 + &hi.0) / two
}

/// Gives a piece an anchor about the value with a long W, where there are free variables. Returns
/// false where that fails.
fn lengthen(given: &Given<'_>, set: &mut CompleteSet, piece: usize, value: &Rational) -> bool {
    let Some(condensation) = set.condensation.as_mut() else {
        return true;
    };

    let Some(anchor) = precise_anchor(given.pencil, condensation, value) else {
        return false;
    };

    condensation.anchors.push(anchor);
    set.pieces[piece].anchor = Some(condensation.anchors.len() - 1);
    true
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
            } else if *what == Node::Open && is_enclosed && may_have_root(&region) {
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

fn may_have_root(region: &SearchRegion) -> bool {
    if region.hi.is_none() || !region.is_decided() {
        return false;
    }

    region.states.contains(&VariableState::InSupport)
}

/// The only null vector of a decided region, and what its signs say.
fn root(
    given: &Given<'_>,
    view: &View,
    expansion: &Expansion,
    region: &SearchRegion,
) -> Option<Root> {
    let region_hi = region.hi.as_ref()?;
    let lo = to_f64(&region.lo);
    let hi = to_f64(region_hi);
    let null = null_vector(expansion, &region.states, lo, hi)?;
    let unique = UniquenessWitness::of(&null, &expansion.ends(lo, hi))?;

    let support = view.variables(&support(&region.states));
    if given.pencil.free().len() + support.len() > ENCLOSED_ORDER {
        return None;
    }

    let candidate = Candidate {
        value: null.value,
        x: with_free_variables(given.pencil, null.value, &null.spread(view.order())),
    };
    let precise = precise_null(given.pencil, &support, &candidate, VECTOR_BITS)?;

    let half = half_width(&precise.value, view.scale)?;
    let begin = &precise.value - &half;
    let end = &precise.value + &half;
    let is_inside = begin >= region.lo && end <= *region_hi && begin >= *given.window().min();
    if !is_inside {
        return None;
    }

    let mut root = unique.witness(&view.index, [begin, end], RootOutcome::Solution);
    let vanishing = view.vanishing(&region.states);
    let mut y = precise.y;
    y.retain(|(i, _)| !vanishing.contains(i));
    write_signs(&mut root, &precise.x, &y)?;
    Some(root)
}

/// Puts the long null vector x, scaled to 1 at the pivot, and what its signs and those of y say
/// into a root; `None` where x is zero at the pivot.
fn write_signs(root: &mut Root, x: &[IndexedNumber], y: &[IndexedNumber]) -> Option<()> {
    let at_pivot = x.iter().find(|(i, _)| *i == root.pivot);
    let scale = at_pivot.map(|(_, x)| x).filter(|x| !x.is_zero())?;
    let x = divided(x, scale);
    let y = divided(y, scale);

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
    root.outcome = outcome(&x, &y);
    Some(())
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
