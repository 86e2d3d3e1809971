//! The verified checker of `proofs/` on the corpus, the examples of chapter 5 and the conformance
//! pack. Where it is not built, the tests are ignored.
//!
//! It refuses nothing that is to be accepted (it may have no theorem for it, exit code 4), and what
//! it accepts of the other files is true by the exact enumerator: it verifies the statement of a
//! certificate with evidence of its own, so that wrong evidence for a true statement may pass.
//!
//! Certificates of the test kit's families: `tests/campaign/verify.rs`. Mutants: `two_checkers`.
#![cfg(feature = "cli")]

use crate::corpus_reader::{ACCEPTED, Entry, UNDECIDED, entries};
use crate::verified_checker::{checker, falsehoods};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_model::file::read_problem;
use mceip_testkit::conform::groups;
use mceip_testkit::verified::{VerifiedCounts, VerifiedVerdict};
use std::path::Path;

/// Files of `spec/corpus/accept` that are accepted at least.
const CORPUS_FLOOR: usize = 165;
/// Examples of chapter 5 that are accepted at least.
const EXAMPLES_FLOOR: usize = 25;
/// Complete sets of the conformance pack that are accepted at least.
const PACK_FLOOR: usize = 100;

#[test]
#[cfg_attr(not(has_verified_checker), ignore = "needs `make -C proofs program`")]
fn the_corpus_gets_no_wrong_verdict() {
    let checker = checker();
    let mut accepted = 0;
    let mut wrong = Vec::new();

    for entry in &entries() {
        let verdict = checker.judge_texts(&entry.problem, &entry.certificate);
        let is_good = matches!(entry.code, ACCEPTED | UNDECIDED);
        accepted += usize::from(is_good && verdict.statement().is_some());

        let fault = if is_good {
            verdict.refusal()
        } else {
            fault_of_acceptance(entry, &verdict)
        };
        wrong.extend(fault.map(|fault| format!("{}: {fault}", entry.name)));
    }

    assert!(wrong.is_empty(), "{wrong:#?}");
    println!("{accepted} files of corpus/accept accepted");
    assert!(accepted >= CORPUS_FLOOR, "{accepted}");
}

/// What is wrong with the verdict on a file that is to be refused. No verdict is wrong, too.
fn fault_of_acceptance(entry: &Entry, verdict: &VerifiedVerdict) -> Option<String> {
    if let VerifiedVerdict::None(how) = verdict {
        return Some(how.clone());
    }

    let lines = verdict.statement()?;
    if entry.is_plain() || entry.is_loads() {
        return Some(format!("accepted: {lines:?}"));
    }
    let problem = read_problem(&entry.problem, Path::new("/")).unwrap();
    let false_sentences = falsehoods(&problem, &entry.certificate, lines);
    (!false_sentences.is_empty()).then(|| format!("{false_sentences:?}"))
}

#[test]
#[cfg_attr(not(has_verified_checker), ignore = "needs `make -C proofs program`")]
fn no_example_of_chapter_5_is_refused() {
    let checker = checker();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples/certificates");
    let mut accepted = 0;
    let mut wrong = Vec::new();

    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let name = path.display().to_string();
        let Some(stem) = name.strip_suffix(".problem.json") else {
            continue;
        };

        let problem = std::fs::read_to_string(&path).unwrap();
        let certificate = std::fs::read_to_string(format!("{stem}.json")).unwrap();
        let verdict = checker.judge_texts(&problem, &certificate);

        accepted += usize::from(verdict.statement().is_some());
        wrong.extend(verdict.refusal().map(|reason| format!("{stem}: {reason}")));
    }

    assert!(wrong.is_empty(), "{wrong:#?}");
    println!("{accepted} examples accepted");
    assert!(accepted >= EXAMPLES_FLOOR, "{accepted}");
}

/// The complete set of each problem of the pack: not refused, and true where it is accepted.
#[test]
#[cfg_attr(not(has_verified_checker), ignore = "needs `make -C proofs program`")]
fn no_complete_set_of_the_conformance_pack_is_refused() {
    let checker = checker();
    let mut counts = VerifiedCounts::default();
    let mut wrong = Vec::new();

    for draft in groups().unwrap().iter().flat_map(|group| &group.drafts) {
        let problem = &draft.problem;
        let Ok(found) = complete(problem, &CompleteOptions::default(), &Watch::nobody()) else {
            continue;
        };

        let verdict = checker.judge(problem, found.proved.certificate());
        counts.count(found.proved.certificate(), &verdict);

        let mut faults: Vec<String> = verdict.refusal().into_iter().collect();
        if let Some(lines) = verdict.statement() {
            faults.extend(falsehoods(
                problem,
                &found.proved.certificate().to_json(),
                lines,
            ));
        }
        if !faults.is_empty() {
            wrong.push(format!("{}: {faults:?}", draft.id));
        }
    }

    println!("{counts:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(counts.accepted >= PACK_FLOOR, "{}", counts.accepted);
}
