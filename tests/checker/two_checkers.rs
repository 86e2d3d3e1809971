//! The checkers and the enumerator on the same mutants: `check` and `spec/checker.py` give one
//! verdict, and what they accept is what the enumerator finds.
//!
//! The verified checker of `proofs/`, where it is built, verifies the statement of a file and not
//! its evidence. So the relation to it is another one: what it accepts is true, by the enumerator;
//! what `check` accepts, it accepts or has no theorem for.
//!
//! Two sources. Witnessed leaves: covers written from a pencil, one leaf with an honest witness and
//! a random claim. Structural mutants: certificates of `complete` and of `certify` with one to
//! three changes of the JSON tree. Windows end at rationals that are no integers, because a scale
//! that is forgotten on one side is one there only.
#![cfg(feature = "testkit")]

use crate::corpus_reader::{ACCEPTED, MALFORMED, REJECTED, UNDECIDED};
use crate::verified_checker::verdicts_on;
use crate::{python_checker, verified_checker};
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{Accepted, check};
use mceip_engine::certify::{certify, lifted};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, rational};
use mceip_model::file::{read_problem, write_problem};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_testkit::verified::VerifiedVerdict;
use mceip_testkit::{
    enumerated, holds_claim, in_doubles, known, mechanical_pencil, random_pencils,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A problem and a text that claims to be its certificate.
struct Forgery {
    problem: Problem,
    text: String,
}

/// How often each verdict and each reason of rejection was given.
#[derive(Default)]
struct Reached {
    verdicts: [usize; 4],
    reasons: BTreeMap<String, usize>,
}

/// The verdict of the checker, after the reader; what is accepted is compared with the enumerator.
fn verdict(forgery: &Forgery, reached: &mut Reached) -> i32 {
    let Ok(certificate) = Certificate::from_json(&forgery.text) else {
        return MALFORMED;
    };

    let accepted = match check(&forgery.problem, &certificate) {
        Ok(accepted) => accepted,
        Err(rejected) => {
            *reached.reasons.entry(rejected.reason.name()).or_default() += 1;
            return REJECTED;
        }
    };

    let wrong = falsehoods(&forgery.problem, &certificate, &accepted);
    assert!(
        wrong.is_empty(),
        "accepted and false: {wrong:?}\n{}\n{}",
        write_problem(&forgery.problem),
        forgery.text
    );
    let is_open = accepted.cover.is_some_and(|cover| !cover.open.is_empty());
    if is_open { UNDECIDED } else { ACCEPTED }
}

/// What an accepted certificate says and the enumerator does not.
pub(crate) fn falsehoods(
    problem: &Problem,
    certificate: &Certificate,
    accepted: &Accepted,
) -> Vec<String> {
    let problem = problem.clone().with_window(certificate.window.clone());
    let truth = enumerated(&problem);

    let mut wrong = Vec::new();
    for claim in &accepted.claims {
        if !holds_claim(&truth, claim) {
            wrong.push(format!("{claim:?}"));
        }
    }

    if let Some(cover) = &accepted.cover {
        wrong.extend(crate::cover::disagreements(cover, &truth));
    }
    wrong
}

/// Writes every problem once and every certificate; the pairs of their paths.
fn write_all(forgeries: &[Forgery], folder: &Path) -> Vec<[PathBuf; 2]> {
    let mut files = Vec::new();
    let mut problems: BTreeMap<String, PathBuf> = BTreeMap::new();

    for (number, forgery) in forgeries.iter().enumerate() {
        let path = folder.join(format!("problem-{}.json", problems.len()));
        let problem = problems
            .entry(write_problem(&forgery.problem))
            .or_insert_with_key(|text| {
                std::fs::write(&path, text).unwrap();
                path
            });

        let certificate = folder.join(format!("{number}.json"));
        std::fs::write(&certificate, &forgery.text).unwrap();
        files.push([problem.clone(), certificate]);
    }
    files
}

/// Judges all forgeries thrice and counts what was reached.
fn compare(forgeries: &[Forgery]) -> Reached {
    let mut reached = Reached::default();
    let mut ours = Vec::new();
    for forgery in forgeries {
        let code = verdict(forgery, &mut reached);
        reached.verdicts[usize::try_from(code).unwrap()] += 1;
        ours.push(code);
    }

    let folder = tempfile::tempdir().unwrap();
    let files = write_all(forgeries, folder.path());
    let theirs = python_checker::codes(&files);
    let differences = differences(forgeries, &ours, &theirs);
    assert!(
        differences.is_empty(),
        "{} differences:\n{}",
        differences.len(),
        differences.join("\n\n")
    );

    if cfg!(has_verified_checker) {
        let verified = verdicts_on(&verified_checker::checker(), &files);
        assert_eq!(verified.len(), forgeries.len(), "{:?}", verified.last());
        let wrong = wrongly_verified(forgeries, &ours, &verified);
        assert!(
            wrong.is_empty(),
            "{} wrong:\n{}",
            wrong.len(),
            wrong.join("\n\n")
        );
        println!("verified checker: {:?}", summary(&verified));
    }

    println!(
        "accepted, rejected, malformed, undecided: {:?}; {:?}",
        reached.verdicts, reached.reasons
    );
    reached
}

/// Certificates that `check` accepts and the verified checker refuses, and certificates that the
/// verified checker accepts and the enumerator contradicts.
fn wrongly_verified(
    forgeries: &[Forgery],
    ours: &[i32],
    verified: &[VerifiedVerdict],
) -> Vec<String> {
    let mut wrong = Vec::new();
    for (number, Forgery { problem, text }) in forgeries.iter().enumerate() {
        let verdict = &verified[number];
        let is_accepted_by_us = !is_refused(ours[number]);

        let mut faults: Vec<String> = Vec::new();
        if is_accepted_by_us {
            faults.extend(verdict.refusal());
        }
        if let Some(lines) = verdict.statement() {
            faults.extend(verified_checker::falsehoods(problem, text, lines));
        }
        if let VerifiedVerdict::NotVerified(what) = verdict
            && what.starts_with("a fault of this program")
        {
            faults.push(what.clone());
        }

        if !faults.is_empty() {
            wrong.push(format!(
                "check says {}, the verified checker {verdict:?}: {faults:?}\n{}\n{text}",
                ours[number],
                write_problem(problem)
            ));
        }
    }
    wrong
}

/// How often each verdict was given; of what is not verified, how often each kind.
fn summary(verdicts: &[VerifiedVerdict]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for verdict in verdicts {
        let word = match verdict {
            VerifiedVerdict::Accepted(_) => "accepted".to_string(),
            VerifiedVerdict::Undecided(_) => "undecided".to_string(),
            VerifiedVerdict::Rejected(_) => "rejected".to_string(),
            VerifiedVerdict::Malformed(_) => "malformed".to_string(),
            VerifiedVerdict::NotVerified(what) => format!("not verified: {what}"),
            VerifiedVerdict::None(how) => format!("no verdict: {how}"),
        };
        *counts.entry(word).or_default() += 1;
    }
    counts
}

fn differences(forgeries: &[Forgery], ours: &[i32], theirs: &[i32]) -> Vec<String> {
    let mut differences = Vec::new();
    for (number, Forgery { problem, text }) in forgeries.iter().enumerate() {
        let [ours, theirs] = [ours[number], theirs[number]];
        if !is_same_verdict(ours, theirs) {
            differences.push(format!(
                "check says {ours}, checker.py {theirs} on\n{}\n{text}",
                write_problem(problem)
            ));
        }
    }
    differences
}

/// One verdict. A file with two faults may be called malformed for the one or rejected for the
/// other.
fn is_same_verdict(ours: i32, theirs: i32) -> bool {
    ours == theirs || (is_refused(ours) && is_refused(theirs))
}

fn is_refused(code: i32) -> bool {
    code == REJECTED || code == MALFORMED
}

fn witnessed_leaves(count: usize, seed: u64) -> Vec<Forgery> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut forgeries = Vec::new();
    for _ in 0..count {
        let case = crate::witnessed::case(&mut rng);
        forgeries.push(Forgery {
            text: case.certificate.to_json(),
            problem: case.problem,
        });
    }
    forgeries
}

fn structural_mutants(count: usize, seed: u64) -> Vec<Forgery> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bases = bases(&mut rng);

    let mut parsed: Vec<Value> = Vec::new();
    for base in &bases {
        parsed.push(serde_json::from_str(&base.text).unwrap());
    }

    let pool: Vec<Value> = parsed.iter().flat_map(nodes).collect();

    let mut mutants = Vec::new();
    for _ in 0..count {
        let number = rng.random_range(0..bases.len());
        let mut mutant = parsed[number].clone();
        crate::structural::mutate(&mut mutant, &pool, &mut rng);
        mutants.push(Forgery {
            problem: bases[number].problem.clone(),
            text: mutant.to_string(),
        });
    }
    mutants
}

/// All nodes of all trees of a certificate.
pub(crate) fn nodes(certificate: &Value) -> Vec<Value> {
    let pieces = certificate.pointer("/complete_set/pieces");
    let Some(Value::Array(pieces)) = pieces else {
        return Vec::new();
    };
    let trees = pieces.iter().filter_map(|piece| piece["tree"].as_array());
    trees.flatten().cloned().collect()
}

/// Certificates that hold: covers of every kind with rational ends, and claims.
fn bases(rng: &mut ChaCha8Rng) -> Vec<Forgery> {
    let mut bases = Vec::new();
    for problem in small_problems(rng) {
        let windows = [
            problem.window().clone(),
            Window::new(rational(1, 7), None).unwrap(),
            between(rng),
        ];
        for window in windows {
            let problem = problem.clone().with_window(window);
            bases.extend(covered(&problem));
            bases.extend(claimed(&problem));
            bases.extend(lifted_claims(&problem));
        }
    }
    bases
}

/// Worked examples, known answers, random problems: those of order 5 at most.
fn small_problems(rng: &mut ChaCha8Rng) -> Vec<Problem> {
    let mut problems = vec![crate::cover::fold(Window::all()), reversed_anchor()];
    problems.extend(["two-particles", "two-particles-mu", "oblique"].map(example));

    let graphs = [known::complete_graph(2), known::path(3), known::star(2)];
    problems.extend(graphs.map(|answer| answer.unwrap().problem));
    let degenerate = [known::star(3), known::jordan(3, 2, true)];
    problems.extend(degenerate.map(|answer| answer.unwrap().problem));

    problems.extend((1..=3).map(|seed| mechanical_pencil(3, Unknown::Mu, seed).unwrap()));
    let random = random_pencils(12, 5).unwrap();
    problems.extend(random.into_iter().map(|instance| instance.problem));
    problems.extend((0..12).map(|_| crate::witnessed::case(rng).problem));

    problems.retain(|problem| reduce(problem).unwrap().pencil.order() <= 5);
    problems
}

fn between(rng: &mut ChaCha8Rng) -> Window {
    let min = rational(rng.random_range(0..=30), 7);
    let max = &min + rational(rng.random_range(1..=900), 100);
    Window::new(min, Some(max)).unwrap()
}

/// A free variable and an indefinite mass: `complete` closes the last interval by a reversed
/// anchor.
fn reversed_anchor() -> Problem {
    let a: [&[i64]; 3] = [&[4, 1, -1], &[1, 3, 0], &[-1, 1, 2]];
    let b: [&[i64]; 3] = [&[1, 0, 1], &[0, 1, 3], &[1, 3, 1]];
    let a = Sparse::from_ints(&a);
    let b = Sparse::from_ints(&b);
    let pencil = Pencil::new(a, b, vec![0]).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn covered(problem: &Problem) -> Option<Forgery> {
    let options = CompleteOptions {
        pieces: 2,
        nodes_per_piece: 200,
        ..CompleteOptions::default()
    };
    let found = complete(problem, &options, &Watch::nobody()).ok()?;
    Some(Forgery {
        problem: problem.clone(),
        text: found.proved.certificate().to_json(),
    })
}

fn claimed(problem: &Problem) -> Option<Forgery> {
    let pencil = reduce(problem).unwrap().pencil;
    let slip = pencil.slip();
    let truth = enumerate(&pencil, problem.window()).unwrap();

    let candidates = truth.solutions.iter().map(|s| in_doubles(s, &slip));
    let claims = candidates.filter_map(|candidate| certify(problem, &pencil, &candidate).ok());
    let claims: Vec<Claim> = claims.collect();

    if claims.is_empty() {
        return None;
    }
    Some(Forgery {
        problem: problem.clone(),
        text: Certificate::of_claims(problem, claims).to_json(),
    })
}

fn example(name: &str) -> Problem {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    read_problem(&text, &folder).unwrap()
}

/// The claims of a mechanical system over its degrees of freedom.
fn lifted_claims(problem: &Problem) -> Option<Forgery> {
    let Body::System(system) = problem.body() else {
        return None;
    };
    let exact = Certificate::from_json(&claimed(problem)?.text).unwrap();

    let mut claims = Vec::new();
    for claim in exact.claims {
        if let Claim::ExactSolution(claim) = claim {
            let motion = lifted(system, problem.unknown(), &claim);
            claims.push(Claim::LiftedSolution(motion));
        }
    }
    Some(Forgery {
        problem: problem.clone(),
        text: Certificate::of_claims(problem, claims).to_json(),
    })
}

/// Every verdict, and most of the reasons that a small problem can meet.
fn assert_reach(reached: &Reached, count: usize, reasons: usize) {
    let [accepted, rejected, _, undecided] = reached.verdicts;
    assert!(accepted + undecided > count / 20, "{:?}", reached.verdicts);
    assert!(rejected > count / 4, "{:?}", reached.verdicts);
    assert!(reached.reasons.len() >= reasons, "{:?}", reached.reasons);
}

fn assert_one_verdict_on_witnessed_leaves(count: usize, seed: u64, reasons: usize) {
    let reached = compare(&witnessed_leaves(count, seed));
    assert_reach(&reached, count, reasons);
}

fn assert_one_verdict_on_structural_mutants(count: usize, seed: u64, reasons: usize) {
    let reached = compare(&structural_mutants(count, seed));
    assert_reach(&reached, count, reasons);
}

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn one_verdict_on_four_thousand_witnessed_leaves() {
    assert_one_verdict_on_witnessed_leaves(4000, 1, 12);
}

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn one_verdict_on_four_thousand_structural_mutants() {
    assert_one_verdict_on_structural_mutants(4000, 2, 30);
}

#[test]
#[ignore = "half a minute; run by .ci/run"]
fn one_verdict_on_twenty_thousand_mutants() {
    assert_one_verdict_on_witnessed_leaves(10_000, 11, 12);
    assert_one_verdict_on_structural_mutants(10_000, 12, 35);
}

/// Ten rounds of two kinds. Where the verified checker is built, all three checkers are compared.
#[test]
#[ignore = "minutes; on request, after `make -C proofs program`"]
fn three_checkers_on_a_hundred_thousand_mutants() {
    for round in 0..10 {
        println!("round {round}");
        assert_one_verdict_on_witnessed_leaves(5000, 3000 + round, 12);
        assert_one_verdict_on_structural_mutants(5000, 4000 + round, 30);
    }
}

/// Ten minutes or more. Twenty-five rounds, so that a failure shows early.
#[test]
#[ignore = "ten minutes; not run by CI"]
fn one_verdict_on_half_a_million_mutants() {
    for round in 0..25 {
        println!("round {round}");
        assert_one_verdict_on_witnessed_leaves(10_000, 1000 + round, 12);
        assert_one_verdict_on_structural_mutants(10_000, 2000 + round, 35);
    }
}
