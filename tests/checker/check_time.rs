//! How long the checker takes: n = 12 exact, the block's 820 degrees of freedom enclosed. Run with
//! `cargo test --release --test checker -- --ignored --nocapture check_time::`. The test itself
//! asserts a ratio only.
#![cfg(feature = "testkit")]

use mceip::candidate::Candidate;
use mceip::certificate::{Certificate, Claim};
use mceip::certify::{certificate, propose};
use mceip::check::check;
use mceip::model::Problem;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::source::{Block, BlockModel, MassKind, PublishedState};
use mceip::testkit::{block_state, mechanical_pencil};
use std::time::{Duration, Instant};

/// The best of a few runs.
fn time(problem: &Problem, certificate: &Certificate) -> Duration {
    let run = || {
        let start = Instant::now();
        check(problem, certificate).unwrap();
        start.elapsed()
    };
    (0..5).map(|_| run()).min().unwrap()
}

/// A solution with the largest support that a random dense pencil of order n has.
fn exact(n: usize) -> (Problem, Certificate) {
    for seed in 1.. {
        let problem = mechanical_pencil(n, mceip::model::Unknown::Mu, seed).unwrap();
        let found = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
        let pencil = mceip::reduction::reduce(&problem).unwrap().pencil;
        for (s, x) in found.solutions().filter(|(s, _)| 2 * s.support.len() >= n) {
            let candidate = Candidate {
                value: mceip::exact::to_f64(&s.value.mid()),
                x: x.to_vec(),
            };
            if let Ok(Claim::ExactSolution(c)) = propose(&pencil, problem.window(), &candidate) {
                return (
                    problem.clone(),
                    certificate(&problem, vec![Claim::ExactSolution(c)]),
                );
            }
        }
    }
    unreachable!()
}

#[test]
#[ignore = "times"]
fn checking_takes_milliseconds() {
    let [small, large] = [6, 12].map(exact);
    for (n, (problem, c)) in [(6, &small), (12, &large)] {
        let Claim::ExactSolution(claim) = &c.claims[0] else {
            unreachable!()
        };
        println!(
            "n = {n}, support {}: {:?}, {} bytes",
            claim.support.len(),
            time(problem, c),
            c.to_json().len()
        );
    }
    let block = Block::new(&BlockModel {
        mass: MassKind::Lumped,
        ..BlockModel::of_the_paper()
    })
    .unwrap();
    for state in PublishedState::ALL {
        let certificate = block_state(&block, state, &Watch::nobody())
            .unwrap()
            .unwrap()
            .certificate
            .unwrap();
        let problem = state.problem(&block).unwrap();
        println!(
            "block, {state:?}, {} claims: {:?}, {} bytes",
            certificate.claims.len(),
            time(&problem, &certificate),
            certificate.to_json().len()
        );
    }
    // Twice the order may not cost a hundred times as much.
    assert!(
        time(&large.0, &large.1) < 100 * time(&small.0, &small.1).max(Duration::from_micros(50))
    );
}
