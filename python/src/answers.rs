//! Answers as JSON, which `mceip/answers.py` turns into dataclasses.
//!
//! Exact numbers are text ("p/q"), doubles are numbers.

use mceip::analysis::ProofFile;
use mceip::{
    Accepted, AcceptedClaim, Analysis, Certificate, Certified, Found, Interval, ModelError,
    OpenRegion, RealWindow, Solution, SolutionFamily, SolutionSet, Uncertified,
};
use mceip_check::certificate::{
    CERTIFICATE_FORMAT, CRITICAL_FORMAT, PRESENCE_FORMAT, STABILITY_FORMAT,
};
use mceip_check::{AcceptedAbsence, AcceptedPresence, AcceptedStability};
use mceip_model::sha256;
use serde_json::{Value, json};

pub(crate) fn found(found: &Found) -> Value {
    let uncertified: Vec<Value> = found.uncertified.iter().map(uncertified).collect();
    let certificates = found.certificates().iter();
    let certificates: Vec<Value> = certificates.map(|c| document(c.certificate())).collect();

    json!({
        "solutions": solutions(&found.solutions),
        "uncertified": uncertified,
        "runs": found.runs,
        "certificates": certificates,
    })
}

fn uncertified(point: &Uncertified) -> Value {
    json!({
        "value": point.candidate.value,
        "x": point.candidate.x,
        "reason": point.reason.to_string(),
    })
}

pub(crate) fn solution_set(all: &SolutionSet) -> Value {
    json!({
        "solutions": solutions(all.solutions()),
        "families": families(all.families()),
        "open": regions(all.open()),
        "certificate": document(all.certificate()),
    })
}

pub(crate) fn certified(certified: &Certified) -> Value {
    json!({
        "solution": solution(&certified.solution),
        "certificate": document(certified.certificate()),
    })
}

/// `mceip-analysis/1` with the proofs: problem and certificate of each.
pub(crate) fn analysis(analysis: &Analysis) -> Result<Value, ModelError> {
    let mut files = Vec::new();
    let mut proofs = Vec::new();
    for proof in &analysis.proofs {
        let problem = mceip::Problem::from(proof.problem.clone());
        let text = proof.certificate.file()?;
        files.push(ProofFile {
            sha256: sha256(&text),
            path: Some(proof.name.clone()),
        });
        proofs.push(json!({
            "name": proof.name,
            "problem": text_as_json(&problem.to_json()),
            "certificate": text_as_json(&text),
        }));
    }

    Ok(json!({ "answer": analysis.to_json(&files), "proofs": proofs }))
}

/// `windows` are those of the certificate.
pub(crate) fn accepted(accepted: &Accepted, windows: &[RealWindow]) -> Value {
    let claims: Vec<Value> = accepted.claims.iter().map(claim).collect();
    let cover = accepted.cover.as_ref().map(|cover| {
        let solutions: Vec<Value> = cover.solutions.iter().map(claim).collect();
        json!({
            "solutions": solutions,
            "families": families(&cover.families),
            "open": regions(&cover.open),
        })
    });

    let windows: Vec<String> = windows.iter().map(ToString::to_string).collect();
    json!({
        "format": CERTIFICATE_FORMAT,
        "claims": claims,
        "complete_set": cover,
        "windows": windows,
    })
}

pub(crate) fn absence(accepted: &AcceptedAbsence) -> Value {
    json!({
        "format": CRITICAL_FORMAT,
        "below": accepted.below.to_string(),
        "leaves": accepted.leaves,
        "start": accepted.from.to_string(),
        "of_every_member": accepted.is_of_every_member,
    })
}

pub(crate) fn presence(accepted: &AcceptedPresence) -> Value {
    json!({
        "format": PRESENCE_FORMAT,
        "start": accepted.from.to_string(),
        "end": accepted.to.to_string(),
        "pieces": accepted.pieces,
        "of_every_member": accepted.is_of_every_member,
    })
}

pub(crate) fn stability(accepted: &AcceptedStability) -> Value {
    json!({
        "format": STABILITY_FORMAT,
        "start": accepted.from.to_string(),
        "end": accepted.to.to_string(),
        "of_every_motion": accepted.is_of_every_motion,
    })
}

fn solutions(list: &[Solution]) -> Vec<Value> {
    list.iter().map(solution).collect()
}

fn solution(solution: &Solution) -> Value {
    json!({
        "unknown": solution.unknown.word(),
        "value": solution.value,
        "enclosure": interval(&solution.enclosure),
        "support": solution.support,
        "biactive": solution.biactive,
        "x": solution.x,
        "y": solution.y,
        "v": solution.v,
        "w": solution.w,
    })
}

fn claim(claim: &AcceptedClaim) -> Value {
    json!({ "support": claim.support, "enclosure": interval(&claim.value) })
}

fn families(list: &[SolutionFamily]) -> Vec<Value> {
    list.iter().map(family).collect()
}

fn family(family: &SolutionFamily) -> Value {
    json!({
        "support": family.support,
        "from": family.from.as_ref().map(interval),
        "to": family.to.as_ref().map(interval),
        "is_point": family.is_point,
        "is_alone": family.is_alone,
    })
}

fn regions(list: &[OpenRegion]) -> Vec<Value> {
    list.iter().map(region).collect()
}

fn region(region: &OpenRegion) -> Value {
    json!({
        "min": region.min.as_ref().map(ToString::to_string),
        "max": region.max.as_ref().map(ToString::to_string),
        "moving": region.moving,
        "undecided": region.undecided,
    })
}

fn interval(interval: &Interval) -> [String; 2] {
    [interval.lo().to_string(), interval.hi().to_string()]
}

fn document(certificate: &Certificate) -> Value {
    text_as_json(&certificate.to_json())
}

/// A file that our own writer has made.
fn text_as_json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or(Value::Null)
}
