//! How much memory the checker takes on small files made to take much.
//!
//! The truth is an allocator that counts. An anchor of a few numbers may stand for dense matrices
//! of thousands of bits: 40 kB spell out 80 of them, which together would take 2 GB.
#![cfg(feature = "testkit")]

use allocation_counter::measure;
use mceip_check::certificate::CriticalCertificate;
use mceip_check::check_critical;
use mceip_model::Problem;
use mceip_model::file::read_problem;
use serde_json::{Value, json};
use std::path::Path;

const MEBIBYTE: u64 = 1 << 20;
const SLIP: usize = 140;

/// One free degree of freedom and 140 slip particles that nothing couples.
fn problem() -> Problem {
    let order = 2 * SLIP + 1;
    let entries: Vec<Value> = (0..order).map(|i| json!([i, i, 9])).collect();
    let matrix = json!({"rows": order, "cols": order, "entries": entries});

    let mut particles = Vec::new();
    for k in 1..=SLIP {
        let state = json!({"tangential": k, "normal": SLIP + k, "state": "slip", "sign": 1});
        particles.push(state);
    }

    let text = json!({
        "format": "mceip-problem/1",
        "unknown": "lambda2",
        "system": {"friction": 1, "stiffness": matrix, "mass": matrix, "particles": particles},
    });
    read_problem(&text.to_string(), Path::new("/")).unwrap()
}

/// Anchors with W of 4,000 bits; the pieces name those listed.
fn certificate(problem: &Problem, anchors: usize, named: &[Option<usize>]) -> CriticalCertificate {
    let ones = vec![1; SLIP];
    let right = json!([{"exponent": 4000, "rows": [ones]}]);
    let anchor = json!({"center": 0, "right": right, "left_friction": []});

    let mut pieces = Vec::new();
    for (k, name) in named.iter().enumerate() {
        let max = if k + 1 < named.len() {
            json!(k + 1)
        } else {
            json!(null)
        };
        let leaf = if max.is_null() {
            "tail"
        } else {
            "positive_definite"
        };
        pieces.push(json!({"max": max, "anchor": name, "tree": [leaf]}));
    }

    let factor = json!({"first": [0], "rows": [[0]], "exponent": 0});
    let whole: Vec<usize> = (0..=SLIP).collect();
    let none: Vec<Value> = whole.iter().map(|_| json!([0])).collect();
    let of_all = json!({"first": whole, "rows": none, "exponent": 0});
    let text = json!({
        "format": "mceip-critical/1",
        "problem_sha256": problem.sha256(),
        "below": 1,
        "condensation": {
            "sigma": 1,
            "stiffness_factor": factor,
            "mass_sigma": 0,
            "anchors": vec![anchor; anchors],
            "tail": {"from": 0, "factor": of_all, "factor_below": of_all},
        },
        "pieces": pieces,
    });
    CriticalCertificate::from_json(&text.to_string()).unwrap()
}

/// The verdict, and the most that was allocated at a time.
fn judge(problem: &Problem, certificate: &CriticalCertificate) -> (String, u64) {
    let mut verdict = String::new();
    let counted = measure(|| {
        verdict = match check_critical(problem, certificate) {
            Ok(_) => "accepted".into(),
            Err(rejected) => rejected.reason.to_string(),
        };
    });

    (verdict, counted.bytes_max)
}

#[test]
fn anchors_are_expanded_when_a_piece_names_them_and_within_a_budget() {
    let problem = problem();

    // No anchor is named: nothing is expanded.
    let unnamed = certificate(&problem, 80, &[None, None]);
    let (verdict, bytes) = judge(&problem, &unnamed);
    assert!(verdict.contains("anchor"), "{verdict}");
    assert!(bytes < 32 * MEBIBYTE, "{bytes}");

    // One is, and is expanded once for two pieces.
    let one = certificate(&problem, 80, &[Some(7), Some(7), None]);
    let (verdict, bytes) = judge(&problem, &one);
    assert_eq!(verdict, "accepted");
    assert!(bytes < 512 * MEBIBYTE, "{bytes}");

    // Each counts 140^2 * 2 bits 512 + 8,000 and 512 + 4,000 times at least, for the two parts:
    // three are more than 2^30 and 2^12 for each of 80 * 3 * 140 integers.
    let three = certificate(&problem, 80, &[Some(7), Some(8), Some(9), None]);
    let (verdict, bytes) = judge(&problem, &three);
    assert!(verdict.contains("bits of expansions"), "{verdict}");
    assert!(bytes < 512 * MEBIBYTE, "{bytes}");
}
