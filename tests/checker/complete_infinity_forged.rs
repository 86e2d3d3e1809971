//! Forged covers of the last interval: what the checker accepts is true, and most of it it rejects.
//!
//! `complete` closes random pencils to infinity, also by reversed anchors where the mass is
//! indefinite. Random changes of these certificates are either rejected or compared with the exact
//! enumerator, so that a checker that forgets an obligation of the last interval accepts something
//! that is not there. A forgery of each obligation is a file of `spec/corpus`.
#![cfg(feature = "testkit")]

use crate::cover::family_disagreements;
use crate::two_checkers::{falsehoods, nodes};
use mceip_check::certificate::{Anchor, Certificate};
use mceip_check::check;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::rational;
use mceip_model::{Body, Problem, Unknown, Window};
use mceip_testkit::enumerated;
use mceip_testkit::generators::tails::{Mass, tails};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// Mutants of each certificate.
const COUNT: usize = 300;

#[test]
fn what_is_accepted_of_forged_tails_is_true() {
    let judged = judged(&[0, 1, 2, 3, 4, 6, 7]);
    assert!(judged.rejected > 1000, "{judged:?}");
    assert!(judged.accepted > 50, "{judged:?}");
    assert!(judged.of_reversed_anchors >= 100, "{judged:?}");
}

/// `cargo test --release --test checker -- --ignored --nocapture complete_infinity_forged::`
#[test]
#[ignore = "a minute in the dev profile"]
fn what_is_accepted_of_many_forged_tails_is_true() {
    let all_cases: Vec<usize> = (0..12).collect();
    let judged = judged(&all_cases);
    assert!(judged.rejected > 1000, "{judged:?}");
    assert!(judged.of_reversed_anchors >= 100, "{judged:?}");
}

/// How many forgeries were judged, and how.
#[derive(Debug, Default)]
struct Judged {
    rejected: usize,
    accepted: usize,
    /// Forgeries that change a reversed anchor itself.
    of_reversed_anchors: usize,
}

fn judged(cases: &[usize]) -> Judged {
    let mut judged = Judged::default();
    for &number in cases {
        let mut rng = ChaCha8Rng::seed_from_u64(91_000 + number as u64);
        let problem = problem(&mut rng, number);
        judge_mutants(&problem, &mut rng, &mut judged);
    }

    println!("{judged:?}");
    judged
}

/// A random pencil on a half line.
fn problem(rng: &mut ChaCha8Rng, number: usize) -> Problem {
    let mass = [Mass::Coupled, Mass::Indefinite, Mass::Partial][number % 3];
    let pencil = tails(rng, 2 + number % 3, number / 3 % 3, mass).unwrap();
    let window = Window::new(rational(rng.random_range(1..40), 8), None).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
}

fn judge_mutants(problem: &Problem, rng: &mut ChaCha8Rng, judged: &mut Judged) {
    let options = CompleteOptions {
        pieces: 4,
        ..CompleteOptions::default()
    };
    let found = complete(problem, &options, &Watch::nobody()).unwrap();
    let good = found.proved.into_certificate();
    let tree: Value = serde_json::from_str(&good.to_json()).unwrap();
    let pool = nodes(&tree);

    for _ in 0..COUNT {
        let mut mutant = tree.clone();
        crate::structural::mutate(&mut mutant, &pool, rng);
        let Ok(mutant) = Certificate::from_json(&mutant.to_string()) else {
            continue;
        };
        if mutant == good {
            continue;
        }

        let is_of_reversed_anchor = reversed_anchors(&mutant) != reversed_anchors(&good);
        judged.of_reversed_anchors += usize::from(is_of_reversed_anchor);
        let Ok(accepted) = check(problem, &mutant) else {
            judged.rejected += 1;
            continue;
        };

        judged.accepted += 1;
        let mut wrong = falsehoods(problem, &mutant, &accepted);
        let in_window = problem.clone().with_window(mutant.window.clone());
        if !enumerated(&in_window).is_plain_list() {
            wrong.extend(family_disagreements(&in_window, &accepted.cover.unwrap()));
        }
        assert!(wrong.is_empty(), "{wrong:?}: {}", mutant.to_json());
    }
}

fn reversed_anchors(certificate: &Certificate) -> Vec<&Anchor> {
    let set = certificate.complete_set.as_ref();
    let condensation = set.and_then(|set| set.condensation.as_ref());
    let anchors = condensation
        .into_iter()
        .flat_map(|condensed| &condensed.anchors);
    anchors.filter(|anchor| anchor.reversed).collect()
}
