//! The x of a solution that the checker has accepted, over all variables of the pencil, in doubles.
//!
//! A support leaf has x as polynomials in t, which are read at the middle of the value's interval.
//! For every other solution the null vector is computed again. Both are scaled to e'x_s = 1. Called
//! by `complete` for the report; nothing depends on it.

use super::null_vector::null_vector;
use super::pieces::prepared::Prepared;
use super::region::State;
use crate::tolerance::SAME_ROOT;
use mceip_check::AcceptedClaim;
use mceip_check::certificate::{Certificate, Exact, Node, Support};
use mceip_exact::{Poly, Rational, to_f64};
use mceip_model::Pencil;

/// x of an accepted solution of the certificate; NaN where no null vector is found.
pub(super) fn accepted_x(
    certificate: &Certificate,
    prepared: &Prepared,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Vec<f64> {
    by_support_leaf(certificate, pencil, solution)
        .unwrap_or_else(|| by_null_vector(prepared, pencil, solution))
}

/// x of a solution that a support leaf of the certificate yields.
fn by_support_leaf(
    certificate: &Certificate,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<Vec<f64>> {
    let set = certificate.complete_set.as_ref()?;
    let mut nodes = set.pieces.iter().flat_map(|piece| &piece.tree);
    let x = nodes.find_map(|node| match node {
        Node::Support(leaf) => yielded(leaf, pencil, solution),
        _ => None,
    })?;

    let value = solution.value.mid();
    let values: Vec<Rational> = x.iter().map(|p| p.eval(&value)).collect();
    let on_support = solution.support.iter().map(|&i| values[i].clone());
    let sum: Rational = on_support.sum();

    let mut scaled = Vec::with_capacity(values.len());
    for value in &values {
        scaled.push(to_f64(&(value / &sum)));
    }

    Some(scaled)
}

/// x at the point of a leaf that is this solution.
fn yielded(leaf: &Support, pencil: &Pencil, solution: &AcceptedClaim) -> Option<Vec<Poly>> {
    let point = leaf.points.iter().find(|point| {
        let [lo, hi] = &point.interval;
        lo.0 == *solution.value.lo() && hi.0 == *solution.value.hi()
    })?;
    let Exact::Some(member) = leaf.reasons.get(point.reason)? else {
        return None;
    };

    let x: Vec<Poly> = member.x.0.iter().map(|c| Poly::new(c.clone())).collect();
    let has_its_support = pencil
        .slip()
        .iter()
        .all(|i| solution.support.contains(i) != x[*i].is_zero());
    has_its_support.then_some(x)
}

fn by_null_vector(prepared: &Prepared, pencil: &Pencil, solution: &AcceptedClaim) -> Vec<f64> {
    let t = to_f64(&solution.value.mid());
    let width = to_f64(solution.value.hi()) - to_f64(solution.value.lo());
    let reach = width.max(SAME_ROOT * t.abs()).max(f64::MIN_POSITIVE);

    let mut states = Vec::with_capacity(prepared.view.order());
    for variable in &prepared.view.index {
        states.push(if solution.support.contains(variable) {
            State::InSupport
        } else {
            State::AtZero
        });
    }

    let expansion = prepared.expansion_at(solution.value.lo());
    let x = match null_vector(expansion, &states, t - reach, t + reach) {
        Some(null) => null.spread(states.len()),
        None => vec![f64::NAN; states.len()],
    };

    let sum: f64 = x.iter().sum();
    let mut all = vec![0.0; pencil.order()];
    for (&i, v) in prepared.view.index.iter().zip(&x) {
        all[i] = v / sum;
    }

    if let Some(free) = expansion.free_part(t, &x) {
        for (&i, v) in pencil.free().iter().zip(free) {
            all[i] = v / sum;
        }
    }

    all
}
