//! `mceip-analysis/1`: the answer for programs.

use super::answer::Analysis;
use super::conditions::DefiniteUntil;
use super::divergence::Verdict;
use super::evidence::Evidence;
use super::modes::Mode;
use mceip_check::OpenRegion;
use mceip_exact::{Interval, enclosing_decimals};
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};
use std::fmt::Write as _;

/// The format of [`Analysis::to_json`].
pub const ANALYSIS_FORMAT: &str = "mceip-analysis/1";

fn enclosure(v: &Interval) -> Value {
    let (lo, hi) = enclosing_decimals(v, 17);
    json!([lo, hi])
}

fn open(regions: &[OpenRegion]) -> Vec<Value> {
    let region = |r: &OpenRegion| {
        json!({
            "min": r.min.to_string(),
            "max": r.max.as_ref().map(ToString::to_string),
            "moving": r.moving,
            "undecided": r.undecided,
        })
    };
    regions.iter().map(region).collect()
}

fn until(u: &DefiniteUntil) -> Value {
    match u {
        DefiniteUntil::Never => json!({ "definite": "never" }),
        DefiniteUntil::Always => json!({ "definite": "always" }),
        DefiniteUntil::End { end, exact } => {
            let polynomial = exact.as_ref().map(|e| {
                e.poly()
                    .coeffs()
                    .iter()
                    .map(ToString::to_string)
                    .collect::<Vec<_>>()
            });
            json!({ "definite": "below", "end": enclosure(end), "polynomial": polynomial })
        }
    }
}

fn mode(m: &Mode) -> Value {
    json!({
        "lambda2": enclosure(&m.lambda2),
        "growth_rate": m.growth_rate,
        "slipping": m.slipping,
        "sticking": m.sticking,
        "v": m.v,
    })
}

impl Analysis {
    /// SHA-256 of a proof's certificate as it is written to a file.
    pub fn certificate_sha256(&self, proof: usize) -> Option<String> {
        let text = self.proofs.get(proof)?.certificate.to_json();
        let mut hex = String::new();
        for byte in Sha256::digest(text.as_bytes()) {
            let _ = write!(hex, "{byte:02x}"); // a String takes everything
        }
        Some(hex)
    }

    /// The evidence in words; `paths[i]` is where the certificate of proof i has been written.
    pub fn evidence_text(&self, evidence: &Evidence, paths: &[String]) -> String {
        match evidence {
            Evidence::Certificate(i) => match paths.get(*i) {
                Some(path) => format!("proved, certificate {path}"),
                None => format!(
                    "proved, certificate {:.12} (--certificates writes it)",
                    self.certificate_sha256(*i).unwrap_or_default()
                ),
            },
            Evidence::Exact(what) => format!("exact: {what}"),
            Evidence::Measured(what) => format!("measured: {what}"),
        }
    }

    fn evidence_json(&self, evidence: &Evidence, paths: &[String]) -> Value {
        match evidence {
            Evidence::Certificate(i) => json!({
                "kind": "certificate",
                "problem_sha256": self.proofs.get(*i).map(|p| p.problem.sha256()),
                "certificate_sha256": self.certificate_sha256(*i),
                "path": paths.get(*i),
            }),
            Evidence::Exact(what) => json!({ "kind": "exact", "how": what }),
            Evidence::Measured(what) => json!({ "kind": "measured", "how": what }),
        }
    }

    /// The answer as `mceip-analysis/1`.
    pub fn to_json(&self, paths: &[String]) -> Value {
        let sentences: Vec<Value> = self
            .sentences()
            .iter()
            .map(|s| {
                json!({
                    "topic": s.topic,
                    "text": s.text,
                    "evidence": self.evidence_json(&s.evidence, paths),
                })
            })
            .collect();
        let samples: Vec<Value> = self
            .samples
            .iter()
            .map(|s| json!({ "mu": s.mu.to_string(), "verdict": s.verdict.word() }))
            .collect();
        let ranges: Vec<Value> = self
            .ranges
            .iter()
            .map(|r| {
                json!({
                    "verdict": r.verdict.word(),
                    "from": r.from.to_string(),
                    "to": r.to.to_string(),
                })
            })
            .collect();
        let solution = self.critical.solution.as_ref().map(|s| {
            json!({
                "mu": enclosure(&s.mu),
                "lambda2": enclosure(&s.lambda2),
                "evidence": self.evidence_json(&s.evidence, paths),
            })
        });
        let [dofs, free, slip, stick] = self.sizes;
        json!({
            "format": ANALYSIS_FORMAT,
            "name": self.name,
            "problem_sha256": self.problem_sha256,
            "friction": self.friction.to_string(),
            "sizes": {
                "dofs": dofs,
                "free_dofs": free,
                "slip_particles": slip,
                "stick_particles": stick,
            },
            "units": "lambda^2 in 1/s^2 and growth rates in 1/s for K and M in consistent units",
            "interrupted": self.interrupted,
            "divergence": {
                "verdict": self.divergence.verdict.word(),
                "families": self.divergence.families,
                "modes": self.divergence.modes.iter().map(mode).collect::<Vec<_>>(),
                "normalisation": "slip rates |v_T| of the slip particles sum to 1",
                "open": open(&self.divergence.open),
            },
            "static_threshold": {
                "smallest": self.threshold.smallest().map(enclosure),
                "values": self.threshold.values.iter().map(enclosure).collect::<Vec<_>>(),
                "open": open(&self.threshold.open),
            },
            "critical": {
                "absent_below": self.critical.absent_below.as_ref().map(ToString::to_string),
                "absent_evidence": self.evidence_json(&self.critical.evidence, paths),
                "solution": solution,
                "boxes": self.critical.cover.as_ref().map(|c| c.boxes),
            },
            "ranges": ranges,
            "samples": samples,
            "necessary": {
                "holds_at_friction": self.necessary.holds_at(&self.friction),
                "stiffness": until(&self.necessary.stiffness),
                "mass": self.necessary.mass.as_ref().map(until),
                "mass_is_constant": self.necessary.mass_is_constant,
            },
            "sufficient": self.sufficient,
            "flutter": self.flutter
                .as_ref()
                .map(|f| json!({
                    "lambda2": f.eigenvalues,
                    "growth_rate": f.growth_rate,
                    "frequency": f.frequency,
                })),
            "sentences": sentences,
        })
    }

    /// Is the question of divergence at mu decided?
    pub fn is_decided(&self) -> bool {
        self.divergence.verdict != Verdict::Undecided
    }
}
