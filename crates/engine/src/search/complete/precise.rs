//! Decided regions whose null vector is known and whose signs are beyond doubles.
//!
//! A local mode has components and reactions of 1e-20 of the largest. In doubles neither x > 0 nor
//! y > 0 can be told there, and such regions stay open. The null vector is computed again in long
//! numbers, the piece gets an anchor whose W is as long, and the checker, whose arithmetic is
//! exact, reads the signs off both.

use crate::candidate::Candidate;
use crate::certify::{ENCLOSED_ORDER, precise_null};
use crate::search::complete::leaf::root::null_vector;
use crate::search::complete::pieces::precise_anchor::precise_anchor;
use crate::search::complete::pieces::prepared::Prepared;
use crate::search::complete::pieces::view::Expansion;
use crate::search::complete::region::{Region, State};
use mceip_check::certificate::{Certificate, CompleteSet, Node, Root, RootOutcome};
use mceip_exact::{Integer, Rational, to_f64};
use mceip_model::{Pencil, Problem};
use num_traits::{One, Signed, Zero};

/// Open regions that are looked at, at most: each costs a dense inverse.
const MAX_REGIONS: usize = 64;
/// Bits of the null vector and of its value. Basis: the checker keeps 128 bits of each entry of the
/// condensed pencil.
const VECTOR_BITS: u32 = 128;
/// Half width of a value's interval, relative: 2^-this. Basis: the signs of components of 2^-80 are
/// decided, and a sign change over the interval stands out from entries that are cut off at 2^-128.
const INTERVAL_BITS: u32 = 96;

/// An open region with every index decided, by its place in the cover.
struct OpenLeaf {
    piece: usize,
    node: usize,
    region: Region,
}

/// The certificate with the open regions that long numbers decide closed, for the checker to judge;
/// `None` if there are none.
pub(super) fn closed(
    problem: &Problem,
    pencil: &Pencil,
    prepared: &Prepared,
    certificate: &Certificate,
) -> Option<Certificate> {
    let set = certificate.complete_set.as_ref()?;
    let leaves = open_leaves(problem, prepared, set);
    if leaves.is_empty() || leaves.len() > MAX_REGIONS {
        return None;
    }

    let mut set = set.clone();
    let mut changed = false;
    for piece in 0..set.pieces.len() {
        let expansion = prepared.view.expansion(set.pieces[piece].anchor);
        let own = leaves.iter().filter(|leaf| leaf.piece == piece);
        let roots: Vec<(usize, Root)> = own
            .filter_map(|leaf| {
                Some((
                    leaf.node,
                    root(problem, pencil, prepared, expansion, &leaf.region)?,
                ))
            })
            .collect();
        let Some((_, first)) = roots.first() else {
            continue;
        };

        let value = middle(first);
        if !lengthen(&mut set, pencil, piece, &value) {
            continue;
        }
        for (node, root) in roots {
            set.pieces[piece].tree[node] = Node::Root(Box::new(root));
        }
        changed = true;
    }
    changed.then(|| Certificate {
        complete_set: Some(set),
        ..certificate.clone()
    })
}

fn middle(root: &Root) -> Rational {
    (&root.interval[0].0 + &root.interval[1].0) / Rational::from_integer(2.into())
}

/// Gives a piece an anchor about the value with a long W, where there are free variables.
fn lengthen(set: &mut CompleteSet, pencil: &Pencil, piece: usize, value: &Rational) -> bool {
    let Some(condensation) = set.condensation.as_mut() else {
        return true;
    };
    let Some(anchor) = precise_anchor(pencil, condensation, value) else {
        return false;
    };
    condensation.anchors.push(anchor);
    set.pieces[piece].anchor = Some(condensation.anchors.len() - 1);
    true
}

/// The open leaves in which every index is decided, something moves and the interval is finite.
fn open_leaves(problem: &Problem, prepared: &Prepared, set: &CompleteSet) -> Vec<OpenLeaf> {
    let view = &prepared.view;
    let mut leaves = Vec::new();
    let mut lo = problem.window().min().clone();

    for (k, piece) in set.pieces.iter().enumerate() {
        let hi = piece.max.as_ref().map(|n| n.0.clone());
        let is_searchable = set.condensation.is_none()
            || (piece.anchor.is_some() && !view.expansion(piece.anchor).reversed);

        let mut stack = vec![Region::whole(lo.clone(), hi.clone(), view.order())];
        for (node, what) in piece.tree.iter().enumerate() {
            let Some(region) = stack.pop() else { break }; // the checker has accepted the tree
            match what {
                Node::Split(at) => {
                    stack.push(Region {
                        lo: at.0.clone(),
                        ..region.clone()
                    });
                    stack.push(Region {
                        hi: Some(at.0.clone()),
                        ..region
                    });
                }
                Node::Branch(index) => {
                    let position = view.index.iter().position(|i| i == index).unwrap_or(0);
                    let with = |state: State| {
                        let mut child = region.clone();
                        child.states[position] = state;
                        child
                    };
                    stack.extend([with(State::Moving), with(State::Rest)]);
                }
                Node::Open if is_searchable && is_decided(&region) => leaves.push(OpenLeaf {
                    piece: k,
                    node,
                    region,
                }),
                _ => {}
            }
        }
        lo = hi.unwrap_or(lo);
    }
    leaves
}

fn is_decided(region: &Region) -> bool {
    region.hi.is_some()
        && region.states.contains(&State::Moving)
        && !region.states.contains(&State::Open)
}

/// The only null vector of a decided region, and what its signs say.
fn root(
    problem: &Problem,
    pencil: &Pencil,
    prepared: &Prepared,
    expansion: &Expansion,
    region: &Region,
) -> Option<Root> {
    let index = &prepared.view.index;
    let hi = region.hi.as_ref()?;
    let (a, b) = (to_f64(&region.lo), to_f64(hi));

    let null = null_vector(expansion, &region.states, a, b)?;
    let unique = null.unique(&expansion.ends(a, b))?;

    let moving: Vec<usize> = (0..index.len())
        .filter(|&p| region.states[p] == State::Moving)
        .map(|p| index[p])
        .collect();
    if pencil.free().len() + moving.len() > ENCLOSED_ORDER {
        return None;
    }
    let spread = null.spread(index.len());
    let candidate = over_all_variables(pencil, index, expansion, null.value, &spread);
    let precise = precise_null(pencil, &moving, &candidate, VECTOR_BITS)?;

    let half = half_width(&precise.value)?;
    let interval = [&precise.value - &half, &precise.value + &half];
    let is_inside =
        interval[0] >= region.lo && interval[1] <= *hi && interval[0] >= *problem.window().min();
    if !is_inside {
        return None;
    }

    let mut root = unique.witness(index, interval, RootOutcome::Solution);
    let scale = precise
        .x
        .iter()
        .find(|(i, _)| *i == root.pivot)
        .map(|(_, x)| x.clone())
        .filter(|x| !x.is_zero())?;
    let relative = |list: &[(usize, Rational)]| {
        list.iter()
            .map(|(i, v)| (*i, v / &scale))
            .collect::<Vec<_>>()
    };
    let (x, y) = (relative(&precise.x), relative(&precise.y));

    let longer = VECTOR_BITS - root.exponent;
    root.left.iter_mut().for_each(|u| *u <<= longer);
    root.right = x
        .iter()
        .filter(|(i, _)| *i != root.pivot)
        .map(|(_, v)| fixed(v))
        .collect();
    root.exponent = VECTOR_BITS;
    root.outcome = outcome(&x, &y);
    Some(root)
}

/// The null vector in doubles over the variables of the pencil.
fn over_all_variables(
    pencil: &Pencil,
    index: &[usize],
    expansion: &Expansion,
    value: f64,
    spread: &[f64],
) -> Candidate {
    let mut x = vec![0.0; pencil.order()];
    index.iter().zip(spread).for_each(|(&i, v)| x[i] = *v);
    let free = expansion.free_part(value, spread).unwrap_or_default();
    pencil.free().iter().zip(free).for_each(|(&i, v)| x[i] = v);
    Candidate { value, x }
}

/// What the signs of x, scaled to 1 at the pivot, and of y say.
fn outcome(x: &[(usize, Rational)], y: &[(usize, Rational)]) -> RootOutcome {
    let least = |list: &[(usize, Rational)]| {
        list.iter()
            .filter(|(_, v)| v.is_negative())
            .min_by(|p, q| p.1.cmp(&q.1))
            .map(|(i, _)| *i)
    };
    match (least(x), least(y)) {
        (Some(i), _) => RootOutcome::NegativeX(i),
        (None, Some(i)) => RootOutcome::NegativeY(i),
        (None, None) => RootOutcome::Solution,
    }
}

/// v in units of 2^-[`VECTOR_BITS`].
fn fixed(v: &Rational) -> Integer {
    (v * Rational::from_integer(Integer::one() << VECTOR_BITS))
        .round()
        .to_integer()
}

/// 2^-[`INTERVAL_BITS`] of a power of two near a positive value.
fn half_width(value: &Rational) -> Option<Rational> {
    if !value.is_positive() {
        return None;
    }
    let exponent =
        value.numer().bits() as i64 - value.denom().bits() as i64 - i64::from(INTERVAL_BITS);
    let power = Rational::from_integer(Integer::one() << exponent.unsigned_abs());
    Some(if exponent < 0 { power.recip() } else { power })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    #[test]
    fn the_most_negative_component_is_named() {
        let (plus, minus) = (
            |i: usize| (i, whole(1)),
            |i: usize, v: i64| (i, rational(-1, v)),
        );
        assert_eq!(
            outcome(&[plus(0), minus(1, 100), minus(2, 10)], &[minus(3, 1)]),
            RootOutcome::NegativeX(2)
        );
        assert_eq!(
            outcome(&[plus(0)], &[minus(3, 9), minus(4, 8), plus(5)]),
            RootOutcome::NegativeY(4)
        );
        assert_eq!(outcome(&[plus(0)], &[plus(1)]), RootOutcome::Solution);
    }

    #[test]
    fn half_widths_are_relative() {
        for value in [rational(1, 1000), whole(1), whole(4_000_000_000)] {
            let ratio = half_width(&value).unwrap()
                * Rational::from_integer(Integer::one() << INTERVAL_BITS)
                / &value;
            assert!(ratio > rational(1, 4) && ratio <= whole(2), "{value}");
        }
        assert!(half_width(&whole(0)).is_none());
    }
}
