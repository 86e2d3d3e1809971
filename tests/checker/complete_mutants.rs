//! Thousands of random mutations of real covers: the checker accepts only those whose statement is
//! still true. The truth is the exact enumerator's.
//!
//! A mutation moves, drops, doubles or exchanges pieces and nodes, or changes numbers. The floors
//! at the end say that both verdicts and most obligations were reached: a campaign whose mutants
//! are all rejected at the first node would prove nothing.
#![cfg(feature = "testkit")]

use crate::cover::{condensed, fold, proved};
use crate::two_checkers::{falsehoods, nodes};
use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_exact::rational;
use mceip_model::{Problem, Unknown, Window};
use mceip_testkit::{known, mechanical_pencil};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Problems with several solutions, degenerate ones, and one with free variables.
fn problems() -> Vec<Problem> {
    let around_both = Window::new(rational(3, 2), Some(rational(7, 2))).unwrap();
    let mut problems = vec![fold(Window::all()), fold(around_both)];

    let graphs = [known::complete_graph(3), known::path(3), known::star(2)];
    problems.extend(graphs.map(|answer| answer.unwrap().problem));

    problems.extend((1..=3).map(|seed| mechanical_pencil(4, Unknown::Mu, seed).unwrap()));

    let degenerate = [known::star(3), known::jordan(3, 2, true)];
    problems.extend(degenerate.map(|answer| answer.unwrap().problem));

    problems.push(condensed().0);
    problems
}

/// What the checker said of the mutants.
#[derive(Debug, Default)]
struct Judged {
    accepted: usize,
    rejected: usize,
    reasons: BTreeSet<String>,
}

/// `count` mutants of each of several certificates. What is accepted is compared with the
/// enumerator.
fn mutants(count: usize, seed: u64) {
    let mut judged = Judged::default();
    for (number, problem) in problems().iter().enumerate() {
        let mut rng = ChaCha8Rng::seed_from_u64(seed + number as u64);
        judge_mutants(problem, count, &mut rng, &mut judged);
    }

    println!(
        "{} mutants accepted and true, {} rejected for {} reasons: {:?}",
        judged.accepted,
        judged.rejected,
        judged.reasons.len(),
        judged.reasons
    );
    // The campaign reaches both verdicts and most obligations of the checker.
    assert!(judged.accepted > count / 10, "{judged:?}");
    assert!(judged.rejected > count, "{judged:?}");
    assert!(judged.reasons.len() >= 25, "{judged:?}");
}

fn judge_mutants(problem: &Problem, count: usize, rng: &mut ChaCha8Rng, judged: &mut Judged) {
    let certificate = proved(problem);
    let tree: Value = serde_json::from_str(&certificate.to_json()).unwrap();
    let mut pool = nodes(&tree);
    pool.extend([json!("positive_definite"), json!("negative_definite")]);

    for _ in 0..count {
        let mut mutant = tree.clone();
        crate::structural::mutate(&mut mutant, &pool, rng);
        let Ok(mutant) = Certificate::from_json(&mutant.to_string()) else {
            continue;
        };
        if mutant == certificate {
            continue;
        }

        match check(problem, &mutant) {
            Ok(accepted) => {
                judged.accepted += 1;
                let wrong = falsehoods(problem, &mutant, &accepted);
                assert!(
                    wrong.is_empty(),
                    "accepted and false: {wrong:?}\n{}\n{}",
                    problem.canonical_text(),
                    mutant.to_json()
                );
            }
            Err(rejected) => {
                judged.rejected += 1;
                judged.reasons.insert(rejected.reason.name());
            }
        }
    }
}

#[test]
fn what_is_accepted_of_ten_thousand_mutants_is_true() {
    mutants(1000, 1);
}

#[test]
#[ignore = "minutes"]
fn what_is_accepted_of_a_hundred_thousand_mutants_is_true() {
    mutants(12_000, 1000);
}
