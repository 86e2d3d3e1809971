//! Leaf `root` over a half line [lo, infinity): no null vector has a value there.
//!
//! With s = lo / t, which falls from 1 to 0, s T(t) is the chord from T(lo) to lo B; a reversed
//! expansion has a chord already. The null vector on the chord is found with 0 for lo and 1 for
//! infinity. It is proved to be the only one there, and to lie outside the half line: below it or
//! beyond infinity (outcome `absent`), or at infinity itself, where it is a null vector of the
//! pencil's limit (outcome `infinity`).
//!
//! Called by `tree` for decided regions without an upper end. The checker's side is
//! `check::cover::infinity`.

use super::root::UniquenessWitness;
use crate::search::complete::null_vector::null_vector;
use crate::search::complete::pieces::expansion::{ChordEnds, Expansion};
use crate::search::complete::pieces::matrix::scaled;
use crate::search::complete::pieces::view::View;
use crate::search::complete::region::{SearchRegion, support};
use crate::tolerance::AT_INFINITY;
use mceip_check::certificate::{Node, RootOutcome};
use mceip_exact::{Dense, Integer, Poly, generic_kernel};
use mceip_model::Pencil;
use num_traits::Zero;

/// Active variables up to which a null vector at infinity is looked for exactly.
const MAX_ACTIVE: usize = 60;

/// The leaf of a region in which every variable is decided, if its null vector is provably the only
/// one on the way to infinity and not at a value inside. `ends` are those of the region.
pub(crate) fn leaf(
    pencil: &Pencil,
    view: &View,
    expansion: &Expansion,
    region: &SearchRegion,
    ends: &ChordEnds,
) -> Option<Node> {
    // Cuts close in on a limit as well, at the price of more leaves: the way where the checker has
    // refused this one.
    if region.lo.is_zero() || expansion.caution > 1.0 {
        return None;
    }

    let chord = chord(expansion, ends);
    let null = null_vector(&Expansion::line(&chord.m), &region.states, 0.0, 1.0)?;
    let unique = UniquenessWitness::of(&null, &chord)?;

    // Exact arithmetic is asked first: in doubles the sign of a Schur complement that vanishes is
    // rounding.
    let is_near_infinity = (null.value - 1.0).abs() < AT_INFINITY;
    let limit = if is_near_infinity {
        let support = view.variables(&support(&region.states));
        limit(pencil, &support, expansion.reversed)
    } else {
        None
    };

    let outcome = match limit {
        Some(vector) => RootOutcome::Infinity(vector),
        None if unique.is_absent(&chord) => RootOutcome::Absent,
        None => return None,
    };

    let no_interval = [region.lo.clone(), region.lo.clone()];
    let root = unique.witness(&view.index, no_interval, outcome);
    Some(Node::Root(Box::new(root)))
}

/// The ends of lo T(t) / t over [lo, infinity), as the checker forms them.
fn chord(expansion: &Expansion, ends: &ChordEnds) -> ChordEnds {
    if expansion.reversed {
        return ChordEnds {
            m: ends.m.clone(),
            r: ends.r.clone(),
            slope: ends.slope.clone(),
            ..*ends
        };
    }

    // Of a linear family the radius at lo and lo times that of the direction are of the size of
    // that at 2 lo.
    let radius = expansion
        .ends(ends.lo, 2.0 * ends.lo)
        .radius(1)
        .map(|radius| scaled(radius, 2.0));
    let slope = radius.as_ref().map(|radius| scaled(radius, 2.0));
    ChordEnds {
        lo: ends.lo,
        hi: ends.hi,
        m: [ends.m[0].clone(), scaled(&ends.m[1], ends.lo)],
        r: radius.map(|radius| [radius.clone(), radius]),
        slope,
    }
}

/// The null vector of the pencil's limit at infinity on a support, over all variables of the
/// pencil; `None` unless there is one only. The limit is B on the active rows, and A on the free
/// rows that are zero in B (of a reversed expansion, whose B_ff is definite, B everywhere).
fn limit(pencil: &Pencil, support: &[usize], reversed: bool) -> Option<Vec<Integer>> {
    let mut active: Vec<usize> = support.iter().chain(pencil.free()).copied().collect();
    active.sort_unstable();
    if active.len() > MAX_ACTIVE {
        return None;
    }

    let a = pencil.a().submatrix(&active, &active).to_dense();
    let b = pencil.b().submatrix(&active, &active).to_dense();
    let [a, b] = Dense::clear_rows([&a, &b]);
    let mut rows = Vec::with_capacity(active.len());
    for (p, i) in active.iter().enumerate() {
        let by_a = !reversed && pencil.free().contains(i);
        let given = if by_a { &a[p] } else { &b[p] };
        let mut row = Vec::with_capacity(given.len());
        for v in given {
            row.push(Poly::constant(v.clone()));
        }

        rows.push(row);
    }

    let basis = generic_kernel(rows).0;
    let [vector] = &basis[..] else {
        return None;
    };

    let mut x = vec![Integer::zero(); pencil.order()];
    for (&i, component) in active.iter().zip(vector) {
        x[i] = component.coeffs().first().cloned().unwrap_or_default();
    }

    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
    }

    #[test]
    fn the_limit_is_b_and_for_free_rows_without_b_those_of_a() {
        let plain = pencil(
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
            &[&[1, -2, 5], &[-2, 4, 5], &[0, 0, 0]],
            &[],
        );
        let x = limit(&plain, &[0, 1], false).unwrap();
        assert!(x[2].is_zero() && x[0] == &x[1] * 2 && !x[1].is_zero());
        assert_eq!(limit(&plain, &[0], false), None);
        let last = [0, 0, 1].map(Integer::from).to_vec();
        assert_eq!(limit(&plain, &[2], false), Some(last));

        let mu = pencil(&[&[2, -1], &[1, 1]], &[&[0, 0], &[4, -2]], &[0]);
        let x = limit(&mu, &[1], false).unwrap();
        assert!(x[1] == &x[0] * 2 && !x[0].is_zero());

        let mass = pencil(&[&[2, -1], &[1, 1]], &[&[1, 3], &[3, 9]], &[0]);
        let x = limit(&mass, &[1], true).unwrap();
        assert!(x[0] == &x[1] * -3 && !x[1].is_zero());
    }
}
