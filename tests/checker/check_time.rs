//! How long the checker takes: n = 12 exact, the block's 820 degrees of freedom enclosed. Run with
//! `cargo test --release --test checker -- --ignored --nocapture check_time::`. The test itself
//! asserts a ratio only.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim};
use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, propose};
use mceip_engine::reduction::reduce;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{Options, complete};
use mceip_exact::to_f64;
use mceip_model::{Problem, Unknown};
use mceip_paper::{Block, BlockModel, MassKind, PublishedState};
use mceip_testkit::{block_state, mechanical_pencil};
use std::time::{Duration, Instant};

/// An accepted certificate.
struct Subject {
    problem: Problem,
    certificate: Certificate,
}

impl Subject {
    /// The best of a few runs.
    fn time(&self) -> Duration {
        let mut best = Duration::MAX;
        for _ in 0..5 {
            let start = Instant::now();
            check(&self.problem, &self.certificate).unwrap();
            best = best.min(start.elapsed());
        }
        best
    }

    fn bytes(&self) -> usize {
        self.certificate.to_json().len()
    }
}

/// A solution that moves half of the variables of a random dense pencil of order n, or more.
fn exact(n: usize) -> Subject {
    for seed in 1.. {
        let problem = mechanical_pencil(n, Unknown::Mu, seed).unwrap();
        if let Some(claim) = exact_claim(&problem, n) {
            let certificate = certificate(&problem, vec![claim]);
            return Subject {
                problem,
                certificate,
            };
        }
    }
    unreachable!()
}

fn exact_claim(problem: &Problem, n: usize) -> Option<Claim> {
    let found = complete(problem, &Options::default(), &Watch::nobody()).unwrap();
    let pencil = reduce(problem).unwrap().pencil;
    for (solution, x) in found.solutions() {
        if 2 * solution.support.len() < n {
            continue;
        }
        let candidate = Candidate {
            value: to_f64(&solution.value.mid()),
            x: x.to_vec(),
        };
        let claim = propose(&pencil, problem.window(), &candidate).ok();
        if matches!(claim, Some(Claim::ExactSolution(_))) {
            return claim;
        }
    }
    None
}

/// A state of the block of the paper, enclosed.
fn block(block: &Block, state: PublishedState) -> Subject {
    let found = block_state(block, state, &Watch::nobody());
    Subject {
        problem: state.problem(block).unwrap(),
        certificate: found.unwrap().unwrap().certificate.unwrap(),
    }
}

#[test]
#[ignore = "times"]
fn checking_takes_milliseconds() {
    let small = exact(6);
    let large = exact(12);
    for (n, subject) in [(6, &small), (12, &large)] {
        let Claim::ExactSolution(claim) = &subject.certificate.claims[0] else {
            unreachable!()
        };
        println!(
            "n = {n}, support {}: {:?}, {} bytes",
            claim.support.len(),
            subject.time(),
            subject.bytes()
        );
    }

    let model = BlockModel {
        mass: MassKind::Lumped,
        ..BlockModel::of_the_paper()
    };
    let the_block = Block::new(&model).unwrap();

    for state in PublishedState::ALL {
        let subject = block(&the_block, state);
        println!(
            "block, {state:?}, {} claims: {:?}, {} bytes",
            subject.certificate.claims.len(),
            subject.time(),
            subject.bytes()
        );
    }

    // Twice the order may not cost a hundred times as much.
    let floor = Duration::from_micros(50);
    assert!(large.time() < 100 * small.time().max(floor));
}
