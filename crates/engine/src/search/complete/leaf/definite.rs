//! Leaves `positive_definite` and `negative_definite`: the symmetric part of T is definite.
//!
//! A solution has x_i y_i = 0 for every i, so x'DTx = 0 for every diagonal matrix D. If sym(DT) is
//! positive definite on the variables that may be in the support, at both ends of the interval and
//! so between, then x = 0. At an infinite end it also suffices that the symmetric part of D times
//! the direction B is zero on these variables, because the matrix at the lower end is definite. The
//! leaves of this file have D = 1 and D = -1; others are found by `weighted`.
//!
//! Called by `tree` and `gains` for regions, by `weighted`, `ldl` and `pieces::wide`. The checker's
//! side is `check::cover::definite`, with the test itself in `check::cover::enclosed_definite`.

use crate::dense::UpperTriangle;
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::search::complete::region::possible_support;
use crate::tolerance::DEFINITE_PIVOT;
use mceip_check::certificate::{Node, VariableState};

/// The leaf of a region with these states, if its symmetric part is definite at all corners: the
/// ends of its interval of t, at both ends of its interval of mu.
pub(crate) fn leaf(corners: &[ChordEnds], states: &[VariableState]) -> Option<Node> {
    let is_definite = |sign| holds_at_all(corners, states, &vec![sign; states.len()]);

    if is_definite(1.0) {
        Some(Node::PositiveDefinite)
    } else if is_definite(-1.0) {
        Some(Node::NegativeDefinite)
    } else {
        None
    }
}

/// Is sym(DT), D = diag(d), positive definite on what may be in the support, at both ends of each
/// corner?
pub(crate) fn holds_at_all(corners: &[ChordEnds], states: &[VariableState], d: &[f64]) -> bool {
    let mut corners = corners.iter();
    corners.all(|ends| holds_at_both_ends(ends, states, d))
}

/// The same of one corner.
pub(crate) fn holds_at_both_ends(ends: &ChordEnds, states: &[VariableState], d: &[f64]) -> bool {
    if !is_definite(&ends.m[0], ends.radius(0), states, d) {
        return false;
    }

    let is_exact = ends
        .radius(1)
        .is_none_or(|radius| vanishes(radius, states, d));
    let vanishes_at_infinity = ends.is_half_line() && is_exact && vanishes(&ends.m[1], states, d);
    vanishes_at_infinity || is_definite(&ends.m[1], ends.radius(1), states, d)
}

/// Is sym(DM) exactly zero on what may be in the support? Enough at an infinite end.
fn vanishes(m: &SquareMatrix, states: &[VariableState], d: &[f64]) -> bool {
    let possible = possible_support(states);
    for &i in &possible {
        for &j in &possible {
            if d[i] * m[i][j] + d[j] * m[j][i] != 0.0 {
                return false;
            }
        }
    }

    true
}

/// Is sym(DM) positive definite on what may be in the support, for every M within `radius` of `m`,
/// with a margin?
pub(crate) fn is_definite(
    m: &SquareMatrix,
    radius: Option<&SquareMatrix>,
    states: &[VariableState],
    d: &[f64],
) -> bool {
    let possible = possible_support(states);

    // A diagonal entry that is not positive stays so: neither the radius nor elimination with
    // positive pivots makes one larger.
    if possible.iter().any(|&i| d[i] * m[i][i] <= 0.0) {
        return false;
    }

    let mut symmetric = UpperTriangle::new(possible.len(), |p, q| {
        let [i, j] = [possible[p], possible[q]];
        d[i] * m[i][j] + d[j] * m[j][i]
    });
    let least_pivot = DEFINITE_PIVOT * symmetric.largest_entry();

    if let Some(radius) = radius {
        for (p, &i) in possible.iter().enumerate() {
            let around = |&j: &usize| d[i].abs() * radius[i][j] + d[j].abs() * radius[j][i];
            symmetric.subtract_from_diagonal(p, possible.iter().map(around).sum());
        }
    }

    symmetric.has_pivots_above(least_pivot)
}
