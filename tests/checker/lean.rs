//! Lean certificates: the same certificate in both forms, one verdict, and what is refused.
//!
//! What the engine has made is left out and made anew to the last digit; what somebody has written
//! by hand stays in the file. A lean file that names other centres or fewer digits is judged by
//! what is made of it.
#![cfg(all(feature = "cli", feature = "testkit"))]

use crate::corpus_reader::{ACCEPTED, entries};
use crate::program::{Folder, mceip};
use mceip_engine::analysis::{AnalysisOptions, Proof, ProofCertificate, analyse};
use mceip_engine::lean::{LeanError, elaborate_file, shorten_file};
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_exact::whole;
use mceip_model::file::{read_problem, write_problem};
use mceip_model::{Problem, sha256};
use mceip_testkit::{mechanical, system_of};
use serde_json::{Value, json};
use std::path::Path;

fn shorten(problem: &Problem, text: &str) -> Result<Option<String>, LeanError> {
    shorten_file(problem, text, &Watch::nobody())
}

fn elaborate(problem: &Problem, text: &str) -> Result<String, LeanError> {
    elaborate_file(problem, text, &Watch::nobody())
}

/// The proofs of a system with free degrees of freedom, some about complete sets, one about absence
/// below a friction, some about presence.
fn proofs_with_anchors(skipped: usize) -> Vec<Proof> {
    let systems = mechanical(48, 40).unwrap();
    let systems = systems.iter().map(|instance| system_of(&instance.problem));
    let mut fit = systems.filter(|system| {
        let is_free = !system.free_dofs().is_empty() && system.zero_particles().is_empty();
        is_free && system.slip_particles().len() > 1
    });
    let system = fit.nth(skipped).unwrap();

    let options = AnalysisOptions {
        samples: 0,
        ..AnalysisOptions::default()
    };
    let watch = Watch::nobody();
    let analysis = analyse(system, &whole(1), &options, &watch).unwrap();
    analysis.proofs
}

/// The coefficients of all anchors of a certificate's file.
fn coefficients(certificate: &Value) -> Vec<&Value> {
    let of_set = certificate.pointer("/complete_set/condensation/anchors");
    let anchors = of_set.or_else(|| certificate.pointer("/condensation/anchors"));
    let anchors = anchors.and_then(Value::as_array).into_iter().flatten();
    let lists = anchors.flat_map(|anchor| ["right", "left", "left_friction"].map(|k| &anchor[k]));
    lists.filter_map(Value::as_array).flatten().collect()
}

/// What the engine makes is left out entirely, and made anew to the last digit.
#[test]
fn what_the_engine_makes_is_made_anew() {
    let mut counts = [0; 3];
    for skipped in 0..3 {
        for proof in proofs_with_anchors(skipped) {
            let kind = match &proof.certificate {
                ProofCertificate::Solutions(_) => 0,
                ProofCertificate::Absence(_) => 1,
                ProofCertificate::Presence(_) => 2,
                ProofCertificate::Stability(_) => continue,
            };
            let full = proof.certificate.file().unwrap();
            let lean = shorten(&proof.problem, &full).unwrap().unwrap();
            let file: Value = serde_json::from_str(&lean).unwrap();
            let left_out = coefficients(&file["certificate"]);
            let has_rows = left_out
                .iter()
                .filter(|matrix| matrix.get("rows").is_some());
            // A precise anchor of a complete set has more digits than doubles.
            assert!(kind == 0 || has_rows.count() == 0, "{}", proof.name);

            counts[kind] += left_out.len();
            assert_eq!(
                elaborate(&proof.problem, &lean).unwrap(),
                full,
                "{}",
                proof.name
            );
        }
    }

    assert!(counts.iter().all(|count| *count >= 8), "{counts:?}");
}

/// Certificates of the corpus keep what is not as the engine makes it, and nothing of them is lost.
#[test]
fn what_cannot_be_made_anew_stays() {
    let mut kept = 0;
    let mut left_out = 0;
    for entry in entries() {
        if entry.code != ACCEPTED || entry.is_plain() || entry.is_loads() {
            continue;
        }

        let problem = read_problem(&entry.problem, Path::new(".")).unwrap();
        let given: Value = serde_json::from_str(&entry.certificate).unwrap();
        let Some(lean) = shorten(&problem, &entry.certificate).unwrap() else {
            kept += coefficients(&given).len();
            continue;
        };

        let lean: Value = serde_json::from_str(&lean).unwrap();
        let all = coefficients(&lean["certificate"]);
        let has_rows = all.iter().filter(|matrix| matrix.get("rows").is_some());
        let with_rows = has_rows.count();
        kept += with_rows;
        left_out += all.len() - with_rows;
        let full = elaborate(&problem, &lean.to_string()).unwrap();
        let full: Value = serde_json::from_str(&full).unwrap();
        let [made, given] = [&full, &given].map(|file| {
            let rows = coefficients(file)
                .into_iter()
                .map(|matrix| matrix["rows"].to_string());
            rows.map(|text| text.replace('"', "")).collect::<Vec<_>>()
        });
        assert_eq!(made, given, "{}", entry.name);
    }
    assert!(kept >= 4 && left_out >= 40, "{kept} {left_out}");
}

/// `analyze --lean` writes what `check` accepts and `elaborate` turns into what it writes without.
#[test]
fn the_program_writes_and_reads_both_forms() {
    let proofs = proofs_with_anchors(0);
    let folder = Folder::new();
    let problem = folder.write("problem.json", &write_problem(&proofs[0].problem));
    let [full, lean] = ["full", "lean"].map(|name| folder.path(name));
    let common = [
        "analyze",
        &problem,
        "--friction",
        "1",
        "--samples",
        "0",
        "--json",
        "--certificates",
    ];
    for options in [vec![&full[..]], vec![&lean[..], "--lean"]] {
        let mut written = 0;
        let answer = mceip(&[&common[..], &options].concat());
        let answer: Value = serde_json::from_slice(&answer.stdout).unwrap();
        for sentence in answer["sentences"].as_array().unwrap() {
            let evidence = &sentence["evidence"];
            let Some(path) = evidence["path"].as_str() else {
                continue;
            };
            let file = std::fs::read_to_string(path).unwrap();
            assert_eq!(evidence["certificate_sha256"], sha256(&file), "{path}");
            written += 1;
        }
        assert!(written >= 2, "{written}");
    }

    let mut count = 0;
    for file in std::fs::read_dir(&lean).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        let Some(stem) = name.strip_suffix(".certificate.json") else {
            continue;
        };

        let [given, other] = [&lean, &full].map(|folder| format!("{folder}/{name}"));
        let problem = format!("{lean}/{stem}.problem.json");
        let [of_lean, of_full] =
            [&given, &other].map(|certificate| mceip(&["check", &problem, certificate]));
        assert_eq!(of_lean.stdout, of_full.stdout, "{stem}");
        assert_eq!(of_lean.status.code(), Some(0), "{stem}");

        let text = std::fs::read_to_string(&given).unwrap();
        if !text.contains("mceip-lean/1") {
            continue;
        }
        count += 1;
        let [made, again] = ["made.json", "again.json"].map(|name| folder.path(name));
        mceip(&["elaborate", &problem, &given, "--out", &made]);
        mceip(&["elaborate", &problem, &made, "--out", &again, "--lean"]);
        let [made, again, other] =
            [made, again, other].map(|path| std::fs::read_to_string(path).unwrap());
        assert_eq!(made.trim_end(), other.trim_end(), "{stem}");
        assert_eq!(again.trim_end(), text.trim_end(), "{stem}");
    }
    assert!(count >= 2, "{count}");
}

/// The lean file of a certificate of absence, and its problem.
fn lean_absence() -> (Problem, Value) {
    let proofs = proofs_with_anchors(0);
    let mut proofs = proofs.iter();
    let is_absence = |proof: &&Proof| matches!(proof.certificate, ProofCertificate::Absence(_));
    let proof = proofs.find(is_absence).unwrap();
    let full = proof.certificate.file().unwrap();
    let lean = shorten(&proof.problem, &full).unwrap().unwrap();
    (proof.problem.clone(), serde_json::from_str(&lean).unwrap())
}

/// Files that are changed in one place: what `check` says of them, and its exit code.
#[test]
fn a_lean_file_is_judged_by_what_is_made_of_it() {
    let (problem, lean) = lean_absence();
    let folder = Folder::new();
    let problem_file = folder.write("problem.json", &write_problem(&problem));
    let anchor = "/certificate/condensation/anchors/0";
    let first = format!("{anchor}/right/0");
    let coefficient = json!({ "exponent": 30 });

    let all = "/certificate/condensation/anchors";
    let many = vec![lean.pointer(anchor).unwrap().clone(); 1_025];

    let cases: [(&str, String, Value, i32, &str); 11] = [
        (
            "many anchors",
            all.into(),
            json!(many),
            1,
            "at most 1024, got 1025",
        ),
        ("empty", format!("{anchor}/right"), json!([]), 1, "REJECTED"),
        ("as it is", String::new(), json!(null), 0, "ABSENT"),
        // F is singular or indefinite left of its spectrum.
        (
            "center",
            format!("{anchor}/center"),
            json!("-1000000000"),
            1,
            "definite",
        ),
        (
            "no digits",
            format!("{first}/exponent"),
            json!(0),
            1,
            "REJECTED",
        ),
        (
            "many digits",
            format!("{first}/exponent"),
            json!(901),
            1,
            "at most 900, got 901",
        ),
        (
            "nine",
            format!("{anchor}/right"),
            json!(vec![coefficient; 9]),
            1,
            "at most 8, got 9",
        ),
        (
            "no rows",
            format!("{first}/rows"),
            json!([["1"]]),
            1,
            "REJECTED",
        ),
        (
            "digest",
            "/certificate/problem_sha256".into(),
            json!("0".repeat(64)),
            1,
            "problem_sha256",
        ),
        (
            "kind",
            "/certificate/format".into(),
            json!("mceip-stability/1"),
            2,
            "lean form",
        ),
        (
            "format",
            "/format".into(),
            json!("mceip-lean/2"),
            2,
            "format",
        ),
    ];
    for (what, place, value, code, says) in cases {
        let mut forged = lean.clone();
        if let Some((holder, key)) = place.rsplit_once('/') {
            forged.pointer_mut(holder).unwrap()[key] = value;
        }
        let file = folder.write("certificate.json", &forged.to_string());
        let output = mceip(&["check", &problem_file, &file]);
        let said = String::from_utf8_lossy(&output.stdout);
        let said = said + String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{what}: {said}");
        assert!(said.contains(says), "{what}: {said}");
    }
}

/// Another problem, a kind without anchors, an interrupt.
#[test]
fn what_has_no_other_form_is_refused() {
    let (problem, lean) = lean_absence();
    let text = lean.to_string();
    let other = proofs_with_anchors(1).remove(0).problem;
    let refused = elaborate(&other, &text).unwrap_err();
    assert!(matches!(refused, LeanError::OtherProblem { .. }));

    let full = elaborate(&problem, &text).unwrap();
    let refused = elaborate(&problem, &full).unwrap_err();
    assert!(matches!(refused, LeanError::Model(_)), "{refused}");
    assert_eq!(
        shorten(&problem, "{\"format\": \"mceip-stability/1\"}"),
        Ok(None)
    );

    let silent = |_: &Progress<'_>| {};
    let cancel = Cancel::requested();
    let interrupted = elaborate_file(&problem, &text, &Watch::new(&cancel, &silent));
    assert_eq!(interrupted, Err(LeanError::Interrupted));
}
