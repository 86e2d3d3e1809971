//! The complete search against the oracle: the same set, or undecided.
//!
//! Input: a problem and the plain enumerator's answer. What the search proves must be in the
//! answer; if it claims a complete set, the answer must be in it. Called by `compare` and by the
//! fuzz target `complete_against_plain`.

use super::disagreement::Disagreement;
use mceip_check::{AcceptedClaim, AcceptedCover, SolutionFamily};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteError, CompleteOptions, Completed, complete};
use mceip_exact::{Algebraic, Interval, Rational};
use mceip_model::Problem;
use mceip_oracle::{Cone, Enumeration, Solution, SupportRange, ValueInterval, is_between};
use std::cmp::Ordering;

/// Nodes per piece in comparisons: instances are small, what needs more is degenerate.
pub(super) const NODES: usize = 20_000;

/// Runs the complete search with as many nodes as small instances need. `Ok(true)`: complete, and
/// equal to the oracle's answer; `Ok(false)`: what it proved is in the oracle's answer, the rest is
/// left open (or the free block is outside its hypotheses).
///
/// # Errors
/// [`Disagreement`] between the two.
pub fn compare_complete(problem: &Problem, oracle: &Enumeration) -> Result<bool, Disagreement> {
    let completed = compare_within(problem, oracle, NODES)?;
    Ok(completed.is_some_and(|completed| completed.is_complete()))
}

/// The complete search with so many nodes per piece: what it proved is in the oracle's answer, and
/// is all of it unless regions are left open. `None` if the free block is outside its hypotheses.
///
/// # Errors
/// [`Disagreement`] between the two.
pub(super) fn compare_within(
    problem: &Problem,
    oracle: &Enumeration,
    nodes: usize,
) -> Result<Option<Completed>, Disagreement> {
    let options = CompleteOptions {
        nodes_per_piece: nodes,
        threads: None,
        ..CompleteOptions::default()
    };

    let completed = match complete(problem, &options, &Watch::nobody()) {
        Ok(completed) => completed,
        Err(
            CompleteError::NotDefinite { .. }
            | CompleteError::Hypothesis { .. }
            | CompleteError::NothingSlips,
        ) => return Ok(None),
        Err(e) => return Err(Disagreement::refused("complete search", &e)),
    };

    let cover = &completed.cover;
    let mut is_found = vec![false; oracle.solutions.len()];
    for claim in &cover.solutions {
        match oracle.solutions.iter().position(|o| is_claimed(o, claim)) {
            Some(k) if !is_found[k] => is_found[k] = true,
            // Solutions inside a cone or a continuum are not in the list one by one.
            _ if !oracle.is_plain_list() => {}
            _ => {
                return Err(Disagreement::NotInOracle {
                    support: claim.support.clone(),
                });
            }
        }
    }

    if let Some(family) = cover.families.iter().find(|f| !is_described(f, oracle)) {
        return Err(Disagreement::NotInOracle {
            support: family.support.clone(),
        });
    }

    let all_found = !is_found.contains(&false) && holds_all_families(cover, oracle);
    if completed.is_complete() && !all_found {
        return Err(Disagreement::Incomplete {
            claimed: cover.solutions.len() + cover.families.len(),
            enumerated: oracle.solutions.len() + oracle.cones.len() + oracle.ranges.len(),
        });
    }

    Ok(Some(completed))
}

/// Does the cover have a family for each cone and each range of the oracle's answer?
fn holds_all_families(cover: &AcceptedCover, oracle: &Enumeration) -> bool {
    let cones = oracle.cones.iter().map(|cone| &cone.slip);
    let ranges = oracle.ranges.iter().map(|range| &range.support);
    cones
        .chain(ranges)
        .all(|support| cover.families.iter().any(|f| f.support == *support))
}

/// Is a family of the cover in a cone or a range of the oracle's answer? Of a cone the faces are
/// families of the cover, too. What the oracle has not described may hold anything.
fn is_described(family: &SolutionFamily, oracle: &Enumeration) -> bool {
    let in_cone = |cone: &Cone| {
        let is_face = family.support.iter().all(|i| cone.slip.contains(i));
        is_face && lies_in(&cone.value, family)
    };
    let in_range = |range: &SupportRange| {
        let is_face = family.support.iter().all(|i| range.support.contains(i));
        is_face && range.pieces.iter().any(|piece| meets(piece, family))
    };

    !oracle.is_complete_list()
        || oracle.cones.iter().any(in_cone)
        || oracle.ranges.iter().any(in_range)
}

/// Does the value lie between the outer ends of the family's values?
fn lies_in(value: &Algebraic, family: &SolutionFamily) -> bool {
    let mut value = value.clone();
    let mut is_beyond =
        |end: Option<&Rational>, side| end.is_some_and(|end| value.cmp_rational(end) == side);
    let is_below = is_beyond(family.from.as_ref().map(Interval::lo), Ordering::Less);
    let is_above = is_beyond(family.to.as_ref().map(Interval::hi), Ordering::Greater);
    !is_below && !is_above
}

/// Does the piece meet the family's values?
fn meets(piece: &ValueInterval, family: &SolutionFamily) -> bool {
    let ends_below = match (&piece.to, &family.from) {
        (Some(to), Some(from)) => to.value.clone().cmp_rational(from.lo()).is_lt(),
        _ => false,
    };
    let begins_above = match (&piece.from, &family.to) {
        (Some(from), Some(to)) => from.value.clone().cmp_rational(to.hi()).is_gt(),
        _ => false,
    };
    !ends_below && !begins_above
}

/// Same support, and the enumerator's value lies in the accepted interval.
pub fn is_claimed(solution: &Solution, claim: &AcceptedClaim) -> bool {
    solution.slip == claim.support
        && is_between(&solution.value, claim.value.lo(), claim.value.hi())
}

/// Does the enumerator's answer hold a solution with this support and a value in this interval:
/// one of its list, of a cone, or of a range?
pub fn holds_claim(oracle: &Enumeration, claim: &AcceptedClaim) -> bool {
    let in_a_cone = |cone: &Cone| {
        let is_on_a_face = claim.support.iter().all(|i| cone.slip.contains(i));
        is_on_a_face && is_between(&cone.value, claim.value.lo(), claim.value.hi())
    };

    oracle.solutions.iter().any(|s| is_claimed(s, claim))
        || oracle.cones.iter().any(in_a_cone)
        || oracle.ranges.iter().any(|r| r.support == claim.support)
}
