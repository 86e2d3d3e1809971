//! Ranges of mu in which samples have no divergence, proved.
//!
//! The range from the first to the last sample of such a run gets a cover of [0, infinity) x [from,
//! below] (`absence`), which the checker has to accept. Where condensation is too coarse it is made
//! anew about the boxes that stay open. Where no cover is found the range stays what it was: known
//! at its samples.
//!
//! Input: a system and its ranges. Output: the evidence of ranges, and the proofs named
//! `absent-range`. Called by `ranges`.

use super::absence::{
    AbsenceBound, Blocked, Cause, CoverOutcome, LastFamily, PrecisePlace, unit_of_lambda2,
};
use super::critical::KnownOfSystem;
use super::divergence::Verdict;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::model::AnalysisModel;
use super::ranges::Range;
use crate::run::Progress;
use mceip_check::Proved;
use mceip_check::certificate::CriticalCertificate;
use mceip_exact::Rational;

/// How often condensation is made anew for a range.
const PRECISE_ROUNDS: usize = 3;

/// Proves what it can of the ranges that are absent at samples.
pub(super) fn prove<'a>(
    model: &AnalysisModel<'a>,
    known: &KnownOfSystem<'a>,
    ranges: &mut [Range],
    proofs: &mut Vec<Proof>,
) {
    let mut count = 0;
    for range in ranges {
        if model.stopped() {
            break;
        }

        let Some(ends) = sampled_absence(range) else {
            continue;
        };
        if let Some(certificate) = cover(model, known, ends) {
            count += 1;
            let certificate = ProofCertificate::Absence(certificate);
            let name = format!("absent-range-{count}");
            let proof = Proof::new(name, known.problem.clone(), certificate);
            model.keep(&proof.name, &proof.problem, &proof.certificate);
            range.evidence = Evidence::Certificate(proofs.len());
            proofs.push(proof);
        }
    }
}

/// The ends of a range of more than one mu that is absent at samples.
fn sampled_absence(range: &Range) -> Option<[&Rational; 2]> {
    let to = range.to.as_ref()?;
    let is_absent = range.verdict == Verdict::Absent;
    (range.evidence.is_measured() && is_absent && range.from < *to).then_some([&range.from, to])
}

/// A certificate of absence for every mu between two values, if one is found. What cannot be
/// condensed is not proved either.
fn cover<'a>(
    model: &AnalysisModel<'a>,
    known: &KnownOfSystem<'a>,
    [from, below]: [&Rational; 2],
) -> Option<Proved<CriticalCertificate>> {
    let stage = "ranges of mu: proving absence";
    let relay = |progress: &Progress<'_>| model.relay(stage, progress);
    let all = known.quadrant(model);
    let quadrant = all.heard_by(&relay);
    let scale = unit_of_lambda2(&known.families.own).ok()?;

    let mut places = Vec::new();
    for _ in 0..=PRECISE_ROUNDS {
        let bound = AbsenceBound {
            from: from.clone(),
            below: below.clone(),
            at_most: below.clone(),
            places: &places,
        };
        match quadrant.cover(&bound, &mut LastFamily::default()).ok()? {
            CoverOutcome::Absent(proved) => return Some(*proved),
            CoverOutcome::Blocked(boxes) if boxes.iter().all(is_imprecise) => {
                for blocked in &boxes {
                    let [lambda2, _] = blocked.middle;
                    places.push(PrecisePlace::sharper(&places, lambda2, scale));
                }
            }
            CoverOutcome::Blocked(_) | CoverOutcome::Refused | CoverOutcome::Stopped => {
                return None;
            }
        }
    }

    None
}

fn is_imprecise(blocked: &Blocked) -> bool {
    blocked.cause == Cause::Remainder
}
