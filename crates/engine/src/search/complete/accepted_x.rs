//! The x of a solution that the checker has accepted, over all variables of the pencil, in doubles.
//!
//! An exact claim of the certificate about the solution, or a support leaf, has x as polynomials in
//! the value; a box has it as its centre. For every other solution the null vector is computed
//! again, in doubles or, where these reach another root of the support, exactly. All are scaled to
//! e'x = 1 on the support. Called by `complete` for reports and modes; no proof depends on it.

use super::leaf::support::leaf as support_leaf;
use super::null_vector::existing_null_vector;
use super::pieces::expansion::Expansion;
use super::pieces::matrix::{largest_entry, principal_block};
use super::pieces::prepared::Prepared;
use super::region::support;
use crate::certify::rows::center_of;
use crate::multistart::{claimed_root, exact_value, integer_x};
use crate::reduction::with_free_variables;
use crate::report::row_times;
use crate::tolerance::{SAME_ROOT, SAME_VALUE};
use mceip_check::certificate::{
    Certificate, Claim, Exact, Node, Polynomials, Support, SupportPoint, VariableState,
};
use mceip_check::{AcceptedClaim, Proved};
use mceip_exact::{Algebraic, Integer, Poly, Rational, to_f64};
use mceip_model::Pencil;
use num_traits::{One, Signed};

/// Bits to which a value is refined beyond those of the coefficients that it is put into.
const DIGITS_BEYOND: u64 = 128;

/// The support leaves of a certificate's cover.
pub(super) fn support_leaves(certificate: &Certificate) -> Vec<&Support> {
    let pieces = certificate.complete_set.iter().flat_map(|set| &set.pieces);
    let nodes = pieces.flat_map(|piece| &piece.tree);
    nodes
        .filter_map(|node| match node {
            Node::Support(leaf) => Some(leaf.as_ref()),
            _ => None,
        })
        .collect()
}

/// x of an accepted solution of the certificate, whose support leaves are given; NaN where no null
/// vector is found.
pub(super) fn accepted_x(
    proved: &Proved<Certificate>,
    leaves: &[&Support],
    prepared: &Prepared,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Vec<f64> {
    by_claim(proved, pencil, solution)
        .or_else(|| by_support_leaf(leaves, pencil, solution))
        .and_then(|x| scaled(&x, &solution.support))
        .unwrap_or_else(|| by_null_vector(prepared, pencil, solution))
}

/// The claim that is about a solution of the cover: of its support, with a value that lies where
/// the cover proves it to be the only one.
pub(super) fn claim_about<'a>(
    proved: &'a Proved<Certificate>,
    solution: &AcceptedClaim,
) -> Option<&'a Claim> {
    let accepted = &proved.accepted().claims;
    let place = accepted.iter().position(|claim| {
        let begins_within = claim.value.lo() >= solution.value.lo();
        let ends_within = claim.value.hi() <= solution.value.hi();
        claim.support == solution.support && begins_within && ends_within
    })?;
    proved.certificate().claims.get(place)
}

/// x of the claim that is about the solution.
fn by_claim(
    proved: &Proved<Certificate>,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<Vec<Rational>> {
    let claim = claim_about(proved, solution)?;
    match claim {
        Claim::ExactSolution(exact) => Some(at_root(&integer_x(exact), exact_value(claim)?)),
        Claim::EnclosedSolution(enclosed) => Some(center_of(pencil, enclosed)),
        Claim::LiftedSolution(_) => None,
    }
}

/// The variables at zero with y = 0 of an accepted solution, if its evidence tells: an exact claim
/// says so, in a box and in a root leaf every sign is strict, a support leaf has x as polynomials.
///
/// Not told of a particle with zero reaction that opens and slips: its other half of v_T, at which
/// y = 0 follows from y = 0 on the support, whatever the value.
pub(super) fn biactive(
    proved: &Proved<Certificate>,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<Vec<usize>> {
    match claim_about(proved, solution) {
        Some(Claim::ExactSolution(exact)) => return Some(exact.biactive.clone()),
        Some(Claim::LiftedSolution(lifted)) => return Some(lifted.biactive.clone()),
        Some(Claim::EnclosedSolution(_)) => return Some(Vec::new()),
        None => {}
    }

    match of_support_leaf(&support_leaves(proved.certificate()), pencil, solution) {
        Some((x, value)) => vanishing_y(pencil, solution, &x, &value),
        None => Some(Vec::new()),
    }
}

/// The rows off the support in which y = (A + tB) x vanishes at a root; `None` where the sign of
/// one cannot be told.
fn vanishing_y(
    pencil: &Pencil,
    solution: &AcceptedClaim,
    x: &[Poly],
    value: &Algebraic,
) -> Option<Vec<usize>> {
    let mut vanishing = Vec::new();
    for i in pencil.slip() {
        if solution.support.contains(&i) {
            continue;
        }

        let (y, _) = row_times(&[pencil.a(), pencil.b()], i, x);
        let rest = y.pseudo_rem(value.poly());
        if rest.is_zero() {
            vanishing.push(i);
        } else if value.interval().horner_rounded(&rest).certain_sign() == 0 {
            return None;
        }
    }

    Some(vanishing)
}

/// x at an algebraic number, or at a rational one very close to it.
fn at_root(x: &[Poly], mut value: Algebraic) -> Vec<Rational> {
    let coefficients = x.iter().flat_map(Poly::coeffs);
    let longest = coefficients.map(|c| c.bits()).max().unwrap_or(0);
    let width = Rational::new(Integer::one(), Integer::one() << (longest + DIGITS_BEYOND));
    value.refine_to(&width);

    let value = value.interval().mid();
    x.iter().map(|p| p.eval(&value)).collect()
}

/// x in doubles with e'x = 1 on the support; `None` where that sum is not positive.
fn scaled(x: &[Rational], support: &[usize]) -> Option<Vec<f64>> {
    let sum: Rational = support.iter().map(|&i| x[i].clone()).sum();
    sum.is_positive()
        .then(|| x.iter().map(|x_i| to_f64(&(x_i / &sum))).collect())
}

/// x of a solution that a support leaf of the certificate yields.
fn by_support_leaf(
    leaves: &[&Support],
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<Vec<Rational>> {
    let (x, value) = of_support_leaf(leaves, pencil, solution)?;
    Some(at_root(&x, value))
}

/// The same as polynomials in the value.
fn of_support_leaf(
    leaves: &[&Support],
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<(Vec<Poly>, Algebraic)> {
    leaves
        .iter()
        .find_map(|leaf| yielded(leaf, pencil, solution))
}

/// x at the point of a leaf that is this solution.
fn yielded(
    leaf: &Support,
    pencil: &Pencil,
    solution: &AcceptedClaim,
) -> Option<(Vec<Poly>, Algebraic)> {
    let point = leaf.points.iter().find(|point| {
        let [lo, hi] = &point.interval;
        lo.0 == *solution.value.lo() && hi.0 == *solution.value.hi()
    })?;
    at_point(leaf, point, pencil, &solution.support)
}

/// x and the value at a point of a leaf, if it is a solution with this support.
fn at_point(
    leaf: &Support,
    point: &SupportPoint,
    pencil: &Pencil,
    support: &[usize],
) -> Option<(Vec<Poly>, Algebraic)> {
    let Exact::Some(member) = leaf.reasons.get(point.reason)? else {
        return None;
    };

    let x = polynomials(&member.x);
    let value = claimed_root(&point.polynomial, &point.interval)?;
    has_support(&x, pencil, support).then_some((x, value))
}

fn polynomials(x: &Polynomials) -> Vec<Poly> {
    x.0.iter().map(|c| Poly::new(c.clone())).collect()
}

/// Are just the slip components of this support not zero?
fn has_support(x: &[Poly], pencil: &Pencil, support: &[usize]) -> bool {
    let slip = pencil.slip();
    slip.iter().all(|i| support.contains(i) != x[*i].is_zero())
}

/// x of a solution by exact arithmetic on its support; `None` where that is too large.
fn by_exact_support(pencil: &Pencil, solution: &AcceptedClaim) -> Option<Vec<Rational>> {
    let value = &solution.value;
    let support = &solution.support;
    let leaf = support_leaf(pencil, support, value.lo(), Some(value.hi()), &|| false)?;
    let mut points = leaf.points.iter();
    let found = points.find_map(|point| at_point(&leaf, point, pencil, support));
    found.map(|(x, value)| at_root(&x, value))
}

/// x of a solution by its null vector in doubles, or by exact arithmetic where that of another
/// solution was reached; NaN where neither tells.
fn by_null_vector(prepared: &Prepared, pencil: &Pencil, solution: &AcceptedClaim) -> Vec<f64> {
    let mut states = Vec::with_capacity(prepared.view.order());
    for variable in &prepared.view.index {
        states.push(if solution.support.contains(variable) {
            VariableState::InSupport
        } else {
            VariableState::AtZero
        });
    }

    let expansion = prepared.expansion_at(solution.value.lo());
    let t = to_f64(&solution.value.mid());
    let width = to_f64(solution.value.hi()) - to_f64(solution.value.lo());
    let size = t.abs().max(unit(expansion, t, &support(&states)));
    let reach = width.max(SAME_ROOT * size).max(f64::MIN_POSITIVE);
    let found = existing_null_vector(expansion, &states, t - reach, t + reach);
    // Another root of the support may be nearer to the start than the value is.
    let found = found.filter(|null| {
        let is_at_the_value = (null.value - t).abs() <= width + SAME_VALUE * size;
        is_at_the_value && null.has_one_sign()
    });
    let x = match found {
        Some(null) => null.spread(states.len()),
        None => {
            let exact = by_exact_support(pencil, solution);
            let scaled = exact.and_then(|x| scaled(&x, &solution.support));
            return scaled.unwrap_or_else(|| vec![f64::NAN; pencil.order()]);
        }
    };

    let sum: f64 = x.iter().sum();
    let x: Vec<f64> = x.iter().map(|v| v / sum).collect();
    with_free_variables(pencil, t, &x)
}

/// The change of t that changes T(t) on the support by its own size: the measure of nearness where
/// t itself is 0.
fn unit(expansion: &Expansion, t: f64, support: &[usize]) -> f64 {
    let matrix = principal_block(&expansion.at(t), support);
    let derivative = principal_block(&expansion.derivative(t), support);
    let unit = largest_entry(&matrix) / largest_entry(&derivative);
    if unit.is_finite() { unit } else { 0.0 }
}
