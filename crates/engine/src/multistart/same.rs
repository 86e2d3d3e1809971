//! When two claims, or two candidates, are the same solution.
//!
//! Accepted claims are compared exactly, candidates within rounding ([`SAME_POINT`]). Called where
//! searches list what they have found, and by reports.

use crate::candidate::Candidate;
use crate::tolerance::SAME_POINT;
use mceip_check::AcceptedClaim;
use mceip_check::certificate::{Claim, EnclosedSolution, ExactSolution};
use mceip_exact::{Algebraic, Integer, Interval, Poly, common_denominator};
use mceip_model::file::Number;

/// The support of a claim.
pub fn support(claim: &Claim) -> &[usize] {
    match claim {
        Claim::ExactSolution(c) => &c.support,
        Claim::LiftedSolution(c) => &c.support,
        Claim::EnclosedSolution(c) => &c.support,
    }
}

/// The exact value of an exact claim.
pub fn exact_value(claim: &Claim) -> Option<Algebraic> {
    match claim {
        Claim::ExactSolution(c) => claimed_root(&c.polynomial, &c.interval),
        Claim::LiftedSolution(c) => claimed_root(&c.polynomial, &c.interval),
        Claim::EnclosedSolution(_) => None,
    }
}

/// The components of x of an exact claim, as integer polynomials in the value.
///
/// x is a direction: all components are multiplied by one common denominator.
pub fn integer_x(claim: &ExactSolution) -> Vec<Poly> {
    let denominator = common_denominator(claim.x.iter().flatten().map(|n| &n.0));
    let mut x = Vec::new();

    for component in &claim.x {
        let mut coefficients = Vec::new();
        for coefficient in component {
            let factor = &denominator / coefficient.0.denom();
            coefficients.push(coefficient.0.numer() * factor);
        }
        x.push(Poly::new(coefficients));
    }

    x
}

/// The root of a polynomial in an isolating interval, as a claim says it.
pub(crate) fn claimed_root(polynomial: &[Integer], interval: &[Number; 2]) -> Option<Algebraic> {
    let [lo, hi] = interval;
    let interval = Interval::new(lo.0.clone(), hi.0.clone())?;
    let polynomial = Poly::new(polynomial.to_vec());
    Some(Algebraic::from_claim(polynomial, interval))
}

/// Do two claims speak of the same solution: same support and equal value (exact), or a box that
/// holds the other's centre (each box holds exactly one solution of its support)?
pub fn same(a: &Claim, b: &Claim) -> bool {
    if support(a) != support(b) {
        return false;
    }
    if let (Claim::EnclosedSolution(a), Claim::EnclosedSolution(b)) = (a, b) {
        return holds_center(a, b);
    }

    match (exact_value(a), exact_value(b)) {
        (Some(mut a), Some(mut b)) => a.equals(&mut b),
        _ => false,
    }
}

/// Do two claims speak of the same solution and, where it is one of a cone, of the same x?
pub fn same_x(a: &Claim, b: &Claim) -> bool {
    let has_same_x = match (a, b) {
        (Claim::ExactSolution(a), Claim::ExactSolution(b)) => a.x == b.x,
        (Claim::LiftedSolution(a), Claim::LiftedSolution(b)) => a.v == b.v,
        _ => true,
    };
    has_same_x && same(a, b)
}

/// Is a claim about this solution of a cover, the only one with its support in its enclosure?
/// Surely so if the claim's value lies within it. Where they only overlap, the claim could be about
/// another solution near by. `exact` is the value of an exact claim.
pub fn is_about(verdict: &AcceptedClaim, exact: Option<Algebraic>, proved: &AcceptedClaim) -> bool {
    let [lo, hi] = [proved.value.lo(), proved.value.hi()];
    let lies_within = match exact {
        Some(mut value) => value.cmp_rational(lo).is_ge() && value.cmp_rational(hi).is_le(),
        None => verdict.value.lo() >= lo && verdict.value.hi() <= hi,
    };
    verdict.support == proved.support && lies_within
}

/// Does the box of `a` hold the centre of `b`?
fn holds_center(a: &EnclosedSolution, b: &EnclosedSolution) -> bool {
    if a.center.len() != b.center.len() {
        return false;
    }

    for k in 0..a.center.len() {
        let difference = &a.center[k].0 - &b.center[k].0;
        let radius = &a.radius[k].0;
        if difference > *radius || -difference > *radius {
            return false;
        }
    }

    true
}

/// Is `b` the same point as `a` within rounding, in any scale of x?
pub(super) fn repeats(a: &Candidate, b: &Candidate) -> bool {
    let value_difference = (a.value - b.value).abs();
    let has_same_value = value_difference <= SAME_POINT * (1.0 + a.value.abs());
    if !has_same_value || a.x.len() != b.x.len() {
        return false;
    }

    let a_norm = l1_norm(&a.x);
    let b_norm = l1_norm(&b.x);
    let mut components = a.x.iter().zip(&b.x);
    components.all(|(a_i, b_i)| {
        let difference = a_i / a_norm - b_i / b_norm;
        difference.abs() <= SAME_POINT
    })
}

fn l1_norm(x: &[f64]) -> f64 {
    x.iter().map(|v| v.abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(value: f64, x: &[f64]) -> Candidate {
        Candidate {
            value,
            x: x.to_vec(),
        }
    }

    /// Every component has to agree: two solutions at one value may share their zeros.
    #[test]
    fn candidates_at_one_value_repeat_only_if_all_of_x_agrees() {
        let known = candidate(3.0, &[1.0, 0.0, 0.0]);

        assert!(
            repeats(&known, &candidate(3.0, &[7.0, 0.0, 0.0])),
            "in another scale"
        );
        assert!(
            !repeats(&known, &candidate(3.0, &[0.0, 1.0, 0.0])),
            "the third component alone is shared"
        );
        assert!(!repeats(&known, &candidate(3.0, &[1.0, 0.0, 1e-3])));
        assert!(
            !repeats(&known, &candidate(3.001, &[1.0, 0.0, 0.0])),
            "another value"
        );
        assert!(
            !repeats(&known, &candidate(3.0, &[1.0, 0.0])),
            "another length"
        );
    }
}
