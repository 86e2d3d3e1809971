//! `mceip-analysis/1`: the answer for programs.
//!
//! Input: an [`Analysis`], and the files of its certificates. Output: one JSON object, described in
//! `spec/`. Enclosures are pairs of decimals rounded outwards; exact numbers are text. Called by
//! `mceip analyze`.

use super::answer::Analysis;
use super::conditions::DefiniteUntil;
use super::critical::Unproved;
use super::divergence::Verdict;
use super::evidence::{Evidence, Proof, ProofFile};
use super::flutter::{Flutter, Onset, Oscillation};
use super::members::MemberCost;
use super::modes::Mode;
use super::ranges::{Range, Sample};
use super::sentences::Sentence;
use crate::report::{coefficients, region_json};
use mceip_check::{OpenRegion, SolutionFamily};
use mceip_exact::{Interval, enclosing_decimals, to_f64};
use mceip_model::{ModelError, sha256};
use serde_json::{Value, json};

/// The format of [`Analysis::to_json`].
pub const ANALYSIS_FORMAT: &str = "mceip-analysis/1";

/// The ends of an enclosure as decimals of 17 digits, rounded outwards.
fn enclosure(v: &Interval) -> Value {
    let (lo, hi) = enclosing_decimals(v, 17);
    json!([lo, hi])
}

fn enclosures(values: &[Interval]) -> Vec<Value> {
    values.iter().map(enclosure).collect()
}

fn regions(regions: &[OpenRegion]) -> Vec<Value> {
    regions.iter().map(region_json).collect()
}

/// Intervals of values, each between enclosures of its ends.
fn intervals(families: &[SolutionFamily]) -> Vec<Value> {
    let interval = |family: &SolutionFamily| {
        let [from, to] = [&family.from, &family.to].map(|end| end.as_ref().map(enclosure));
        json!({ "from": from, "to": to })
    };
    families.iter().map(interval).collect()
}

fn definite_until(until: &DefiniteUntil) -> Value {
    match until {
        DefiniteUntil::NotAtZero(_) => json!({ "definite": "not_at_zero" }),
        DefiniteUntil::Always => json!({ "definite": "always" }),
        DefiniteUntil::End { end, exact } => json!({
            "definite": "below",
            "end": enclosure(end),
            "polynomial": exact.as_deref().map(|end| coefficients(end.poly().coeffs())),
        }),
    }
}

fn mode(mode: &Mode) -> Value {
    let mut value = json!({
        "lambda2": enclosure(&mode.lambda2),
        "growth_rate": mode.growth_rate,
        "slipping": mode.slipping,
        "sticking": mode.sticking,
        "v": mode.v,
    });
    if !mode.zero.is_empty() {
        let zero = mode
            .zero
            .iter()
            .map(|(particle, what)| json!({ "particle": particle, "mode": what.word() }));
        value["zero"] = zero.collect();
    }

    value
}

fn sample(sample: &Sample) -> Value {
    json!({ "mu": sample.mu.to_string(), "verdict": sample.verdict.word() })
}

fn unproved(tried: &Unproved) -> Value {
    json!({
        "below": tried.below.to_string(),
        "reason": tried.reason.word(),
        "lambda2": tried.place.map(|[lambda2, _]| lambda2),
        "mu": tried.place.map(|[_, mu]| mu),
    })
}

fn flutter(flutter: &Flutter) -> Value {
    let of_onset = |onset: &Onset| json!([to_f64(&onset.none_at), to_f64(&onset.some_at)]);
    json!({
        "onset": flutter.onset.as_ref().map(of_onset),
        "lambda2": flutter.eigenvalues,
        "growth_rate": flutter.growth_rate,
        "frequency": flutter.frequency,
        "pairs": flutter.pairs().iter().map(pair).collect::<Vec<Value>>(),
    })
}

fn pair(pair: &Oscillation) -> Value {
    json!({
        "growth_rate": pair.growth_rate,
        "frequency": pair.frequency,
        "hertz": pair.hertz(),
    })
}

impl Analysis {
    /// The files of the certificates, none of which has been written.
    ///
    /// # Errors
    /// As [`ProofCertificate::file`](super::ProofCertificate::file).
    pub fn unwritten_files(&self) -> Result<Vec<ProofFile>, ModelError> {
        let unwritten = |proof: &Proof| {
            Ok(ProofFile {
                sha256: sha256(&proof.certificate.file()?),
                path: None,
            })
        };
        self.proofs.iter().map(unwritten).collect()
    }

    /// The evidence in words; `files[i]` is that of the certificate of proof i.
    pub fn evidence_text(&self, evidence: &Evidence, files: &[ProofFile]) -> String {
        match evidence {
            Evidence::Certificate(i) => {
                let name = self.proofs.get(*i).map_or("", |proof| &proof.name);
                match files.get(*i).and_then(|file| file.path.as_ref()) {
                    Some(path) => format!("proved, certificate {path}"),
                    None => format!("proved, certificate {name} (--certificates writes it)"),
                }
            }
            Evidence::Exact(what) => format!("exact: {what}"),
            Evidence::Measured(what) => format!("measured: {what}"),
        }
    }

    /// The evidence for programs.
    fn evidence_json(&self, evidence: &Evidence, files: &[ProofFile]) -> Value {
        match evidence {
            Evidence::Certificate(i) => json!({
                "kind": "certificate",
                "problem_sha256": self.proofs.get(*i).map(|p| p.problem.sha256()),
                "certificate_sha256": files.get(*i).map(|file| &file.sha256),
                "path": files.get(*i).map(|file| &file.path),
            }),
            Evidence::Exact(what) => json!({ "kind": "exact", "how": what }),
            Evidence::Measured(what) => json!({ "kind": "measured", "how": what }),
        }
    }

    fn sentence_json(&self, sentence: &Sentence, files: &[ProofFile]) -> Value {
        json!({
            "topic": sentence.topic,
            "text": sentence.text,
            "evidence": self.evidence_json(&sentence.evidence, files),
        })
    }

    fn sizes_json(&self) -> Value {
        let [dofs, free, slip, stick] = self.sizes;
        let mut sizes = json!({
            "dofs": dofs,
            "free_dofs": free,
            "slip_particles": slip,
            "stick_particles": stick,
        });
        if self.zero > 0 {
            sizes["zero_particles"] = self.zero.into();
        }

        sizes
    }

    fn range_json(&self, range: &Range, files: &[ProofFile]) -> Value {
        json!({
            "verdict": range.verdict.word(),
            "from": range.from.to_string(),
            "from_included": self.is_from_included(range),
            "to": range.to.as_ref().map(ToString::to_string),
            "to_included": range.is_to_included(),
            "proved": !range.evidence.is_measured(),
            "evidence": self.evidence_json(&range.evidence, files),
        })
    }

    fn divergence_json(&self) -> Value {
        let divergence = &self.divergence;
        let modes: Vec<Value> = divergence.modes.iter().map(mode).collect();
        json!({
            "verdict": divergence.verdict.word(),
            "families": divergence.families,
            "modes": modes,
            "normalisation": "slip rates |v_T| of the slip particles sum to 1",
            "open": regions(&divergence.open),
        })
    }

    fn threshold_json(&self) -> Value {
        json!({
            "smallest": self.threshold.smallest().map(enclosure),
            "values": enclosures(&self.threshold.values),
            "intervals": intervals(&self.threshold.intervals),
            "open": regions(&self.threshold.open),
        })
    }

    fn critical_json(&self, files: &[ProofFile]) -> Value {
        let critical = &self.critical;
        let solution = critical.solution.as_ref().map(|solution| {
            json!({
                "mu": enclosure(&solution.mu),
                "lambda2": enclosure(&solution.lambda2),
                "evidence": self.evidence_json(&solution.evidence, files),
            })
        });

        let unbounded = self.unbounded.as_ref().map(|unbounded| {
            json!({
                "mu": enclosure(&unbounded.mu),
                "from_above": unbounded.is_from_above,
                "beside": {
                    "lambda2": unbounded.beside.lambda2.to_string(),
                    "mu": enclosure(&unbounded.beside.mu),
                },
                "evidence": self.evidence_json(&unbounded.evidence, files),
            })
        });

        json!({
            "without_friction": self.without_friction.word(),
            "absent_below": critical.absent_below.as_ref().map(ToString::to_string),
            "absent_evidence": self.evidence_json(&critical.evidence, files),
            "solution": solution,
            "boxes": critical.boxes,
            "unproved": critical.unproved.as_ref().map(unproved),
            "unbounded": unbounded,
        })
    }

    fn stability_json(&self, files: &[ProofFile]) -> Option<Value> {
        let stability = self.stability.as_ref()?;
        Some(json!({
            "to": stability.to.to_string(),
            "of_every_motion": stability.is_of_every_motion,
            "evidence": self.evidence_json(&stability.evidence, files),
        }))
    }

    fn members_json(&self, files: &[ProofFile]) -> Option<Value> {
        let members = self.members.as_ref()?;
        let absence = members.absent_below.as_ref().map(|(below, evidence)| {
            json!({
                "below": below.to_string(),
                "evidence": self.evidence_json(evidence, files),
            })
        });
        let presence = members.present.as_ref().map(|([from, to], evidence)| {
            json!({
                "from": from.to_string(),
                "to": to.to_string(),
                "evidence": self.evidence_json(evidence, files),
            })
        });
        let first_order = members.first_order.as_ref().map(|first_order| {
            let cost = |cost: &MemberCost| {
                json!({ "of": cost.of.text(&self.particles), "width": cost.width })
            };
            let costs: Vec<Value> = first_order.costs.iter().map(cost).collect();
            json!({
                "middle": first_order.middle,
                "width": first_order.width,
                "costs": costs,
            })
        });

        Some(json!({
            "absent": absence,
            "present": presence,
            "first_order": first_order,
            "obstacle": members.obstacle,
        }))
    }

    fn necessary_json(&self) -> Value {
        let necessary = &self.necessary;
        json!({
            "holds_at_friction": necessary.holds_at(&self.friction),
            "stiffness": definite_until(&necessary.stiffness),
            "mass": necessary.mass.as_ref().map(definite_until),
            "mass_is_constant": necessary.mass_is_constant,
            "condensed_at_zero": self.condensed.as_ref().map(definite_until),
        })
    }

    /// The answer as `mceip-analysis/1`; `files[i]` is that of the certificate of proof i, without
    /// which `certificate_sha256` and `path` are null.
    pub fn to_json(&self, files: &[ProofFile]) -> Value {
        let samples: Vec<Value> = self.samples.iter().map(sample).collect();
        let ranges = self.ranges.iter();
        let ranges: Vec<Value> = ranges.map(|range| self.range_json(range, files)).collect();
        let sentences = self.sentences();
        let sentences: Vec<Value> = sentences
            .iter()
            .map(|sentence| self.sentence_json(sentence, files))
            .collect();

        json!({
            "format": ANALYSIS_FORMAT,
            "name": self.name,
            "warnings": self.warnings,
            "problem_sha256": self.problem_sha256,
            "friction": self.friction.to_string(),
            "sizes": self.sizes_json(),
            "particles": self.particles,
            "units": "lambda^2 in 1/s^2 and growth rates in 1/s for K and M in consistent units",
            "interrupted": self.interrupted,
            "summary": self.summary(),
            "divergence": self.divergence_json(),
            "static_threshold": self.threshold_json(),
            "critical": self.critical_json(files),
            "stability": self.stability_json(files),
            "members": self.members_json(files),
            "ranges": ranges,
            "samples": samples,
            "necessary": self.necessary_json(),
            "sufficient": self.sufficient,
            "flutter": self.flutter.as_ref().map(flutter),
            "sentences": sentences,
        })
    }

    /// Is the question of divergence at mu decided?
    pub fn is_decided(&self) -> bool {
        self.divergence.verdict != Verdict::Undecided
    }
}
