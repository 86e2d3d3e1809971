//! How long the checker takes: n = 12 exact, the block's 820 degrees of freedom enclosed. Run with
//! `cargo test --release --test checker -- --ignored --nocapture check_time::`. Of these a test
//! asserts a ratio only; files made to take long have a limit.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim};
use mceip_check::check;
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::propose;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::to_f64;
use mceip_model::file::read_problem;
use mceip_model::reduction::reduce;
use mceip_model::{Problem, Unknown};
use mceip_paper::{Block, BlockModel, MassKind, PublishedState};
use mceip_testkit::{block_state, mechanical_pencil};
use serde_json::{Value, json};
use std::path::Path;
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
            let certificate = Certificate::of_claims(&problem, vec![claim]);
            return Subject {
                problem,
                certificate,
            };
        }
    }
    unreachable!()
}

fn exact_claim(problem: &Problem, n: usize) -> Option<Claim> {
    let found = complete(problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
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
        certificate: found
            .unwrap()
            .unwrap()
            .certificate
            .unwrap()
            .into_certificate(),
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

/// A file made to take long, of 40 kB: a leaf of so many variables, of which short numbers cannot
/// tell, over each of many intervals.
struct Hostile {
    /// Complementarity variables.
    order: usize,
    /// Those that may move in a leaf.
    moving: usize,
    /// The values of t at which the window is cut, in units of this.
    unit: &'static str,
}

impl Hostile {
    /// Of the tree; the rest of both files takes 6 kB at most.
    const BYTES: usize = 34_000;

    /// T(t) is (1 + t) I on the moving variables, with a first row and column whose factors fill
    /// the matrix, and beside it one large entry of another variable.
    fn problem(&self) -> Problem {
        let mut a = vec![json!([0, 0, 1])];
        for i in 1..self.moving {
            a.extend([
                json!([i, i, 1]),
                json!([i, 0, "1/32"]),
                json!([0, i, "1/32"]),
            ]);
        }

        let mut b: Vec<Value> = (0..self.moving).map(|i| json!([i, i, 1])).collect();
        b.push(json!([self.order - 1, self.order - 1, "1e80"]));

        let order = self.order;
        let matrix =
            |entries: Vec<Value>| json!({"rows": order, "cols": order, "entries": entries});
        let text = json!({
            "format": "mceip-problem/1",
            "unknown": "mu",
            "pencil": {"a": matrix(a), "b": matrix(b)},
        });
        read_problem(&text.to_string(), Path::new("/")).unwrap()
    }

    /// Decides the variables at rest, then cuts off one interval after the other.
    fn certificate(&self, problem: &Problem) -> Certificate {
        let mut tree: Vec<String> = Vec::new();
        for at_rest in self.moving..self.order {
            tree.push(format!(r#"{{"branch":{at_rest}}}"#));
        }

        let mut bytes: usize = tree.iter().map(|node| node.len() + 1).sum();
        let mut cut = 100;
        while bytes < Hostile::BYTES {
            let split = format!(r#"{{"split":"{cut}{}"}}"#, self.unit);
            bytes += split.len() + r#","positive_definite","#.len();
            tree.extend([split, r#""positive_definite""#.into()]);
            cut += 1;
        }

        let text = format!(
            r#"{{"format":"mceip-certificate/1","problem_sha256":"{}","unknown":"mu",
            "window":{{"min":0,"max":null}},"claims":[],
            "complete_set":{{"pieces":[{{"max":null,"tree":[{}]}}]}}}}"#,
            problem.sha256(),
            tree.join(",")
        );
        Certificate::from_json(&text).unwrap()
    }
}

/// `cargo test --release --test checker -- --ignored --nocapture check_time::`: files of 40 kB that
/// take what the budgets allow are refused within 5 s.
#[test]
#[ignore = "times"]
fn hostile_files_of_forty_kilobytes_take_five_seconds_at_most() {
    let hostile = |order, moving, unit| Hostile {
        order,
        moving,
        unit,
    };

    for file in [
        hostile(102, 101, ""),
        hostile(102, 101, "e-390"),
        hostile(61, 60, ""),
        hostile(512, 13, ""),
        hostile(512, 13, "e-200"),
        hostile(512, 60, "e-200"),
    ] {
        let Hostile {
            order,
            moving,
            unit,
        } = file;
        let problem = file.problem();
        let certificate = file.certificate(&problem);

        let start = Instant::now();
        let refused = check(&problem, &certificate).unwrap_err();
        let elapsed = start.elapsed();
        println!("{order} variables, {moving} of them move, cuts in units of 1{unit}: {elapsed:?}");
        println!("    {}", refused.reason);
        assert!(elapsed < Duration::from_secs(5), "{elapsed:?}");
    }
}
