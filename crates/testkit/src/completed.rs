//! The complete search against the oracle: the same set, or honestly undecided.

use super::disagreement::Disagreement;
use mceip_check::AcceptedClaim;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteError, Options, complete};
use mceip_exact::Rational;
use mceip_model::Problem;
use mceip_oracle::{Enumeration, Solution};
use std::cmp::Ordering;

/// Nodes per piece in comparisons: instances are small, what needs more is degenerate.
pub(super) const NODES: usize = 20_000;

/// `compare_within` with as many nodes as small instances need.
///
/// # Errors
/// [`Disagreement`] between the two.
pub fn compare_complete(problem: &Problem, oracle: &Enumeration) -> Result<bool, Disagreement> {
    compare_within(problem, oracle, NODES)
}

/// Runs the complete search with so many nodes per piece. `Ok(true)`: complete, and equal to the
/// oracle's answer; `Ok(false)`: what it proved is in the oracle's answer, the rest is left open
/// (or the free block is outside its hypotheses).
///
/// # Errors
/// [`Disagreement`] between the two.
pub(super) fn compare_within(
    problem: &Problem,
    oracle: &Enumeration,
    nodes: usize,
) -> Result<bool, Disagreement> {
    let options = Options {
        nodes_per_piece: nodes,
        threads: None,
        ..Options::default()
    };

    let completed = match complete(problem, &options, &Watch::nobody()) {
        Ok(completed) => completed,
        Err(
            CompleteError::NotDefinite { .. }
            | CompleteError::Hypothesis { .. }
            | CompleteError::NothingSlips,
        ) => return Ok(false),
        Err(e) => {
            return Err(Disagreement::Refused {
                engine: "complete search",
                reason: e.to_string(),
            });
        }
    };

    let mut hit = vec![false; oracle.solutions.len()];
    for s in &completed.cover.solutions {
        match oracle.solutions.iter().position(|o| is_same(o, s)) {
            Some(k) if !hit[k] => hit[k] = true,
            // Solutions inside a cone or a continuum are not in the list one by one.
            _ if !oracle.is_plain_list() => {}
            _ => {
                return Err(Disagreement::NotInOracle {
                    support: s.support.clone(),
                });
            }
        }
    }

    let complete = completed.is_complete();

    // What is no list is a family on the same support.
    let has_family = |support: &[usize]| {
        completed
            .cover
            .families
            .iter()
            .any(|f| f.support == support)
    };

    // Of a range that the window meets in its end only, one solution is listed.
    let has_one = |support: &[usize]| {
        completed
            .cover
            .solutions
            .iter()
            .any(|s| s.support == support)
    };

    let missing = oracle.cones.iter().any(|c| !has_family(&c.slip))
        || oracle
            .ranges
            .iter()
            .any(|r| !has_family(&r.support) && !has_one(&r.support));

    if complete && (hit.contains(&false) || missing) {
        return Err(Disagreement::Incomplete {
            claimed: completed.cover.solutions.len(),
            enumerated: oracle.solutions.len(),
        });
    }

    Ok(complete)
}

/// Same support, and the oracle's value lies in the accepted interval.
fn is_same(oracle: &Solution, accepted: &AcceptedClaim) -> bool {
    let compare = |end: &Rational| oracle.value.clone().cmp_rational(end);
    oracle.slip == accepted.support
        && compare(accepted.value.lo()) != Ordering::Less
        && compare(accepted.value.hi()) != Ordering::Greater
}
