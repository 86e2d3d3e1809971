//! The checker, `spec/checker.py` and the enumerator on the same mutants: the two checkers give one
//! verdict, and what they accept is what the enumerator finds.
//!
//! Two sources. Witnessed leaves: covers written from a pencil, one leaf with an honest witness and
//! a random claim. Structural mutants: certificates of `complete` and of `certify` with one to
//! three changes of the JSON tree. Windows end at rationals that are no integers, because a scale
//! that is forgotten on one side is one there only.
#![cfg(feature = "testkit")]

use crate::witnessed::Case;
use mceip::candidate::Candidate;
use mceip::certificate::{Certificate, Claim};
use mceip::certify::{certificate, certify, lifted};
use mceip::check::{Accepted, AcceptedClaim, check};
use mceip::exact::{Algebraic, Sparse, rational};
use mceip::model::file::{read_problem, write_problem};
use mceip::model::{Body, Pencil, Problem, Unknown, Window};
use mceip::oracle::{Enumeration, enumerate};
use mceip::reduction::reduce;
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use mceip::testkit::{known, mechanical_pencil, random_pencils};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

/// Exit codes of both programs.
const ACCEPTED: i32 = 0;
const REJECTED: i32 = 1;
const MALFORMED: i32 = 2;
const UNDECIDED: i32 = 3;

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

    match check(&forgery.problem, &certificate) {
        Ok(accepted) => {
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
        Err(rejected) => {
            *reached.reasons.entry(rejected.reason.name()).or_default() += 1;
            REJECTED
        }
    }
}

/// What an accepted certificate says and the enumerator does not.
fn falsehoods(problem: &Problem, certificate: &Certificate, accepted: &Accepted) -> Vec<String> {
    let problem = problem.clone().with_window(certificate.window.clone());
    let pencil = reduce(&problem).unwrap().pencil;
    let truth = enumerate(&pencil, problem.window()).unwrap();

    let mut wrong: Vec<String> = accepted
        .claims
        .iter()
        .filter(|claim| !is_solution(&truth, claim))
        .map(|claim| format!("{claim:?}"))
        .collect();
    if let Some(cover) = &accepted.cover {
        wrong.extend(crate::cover::disagreements(cover, &truth));
    }
    wrong
}

fn is_solution(truth: &Enumeration, claim: &AcceptedClaim) -> bool {
    let is_subset = |part: &[usize], whole: &[usize]| part.iter().all(|i| whole.contains(i));
    let in_list = truth
        .solutions
        .iter()
        .any(|s| s.slip == claim.support && is_within(&s.value, claim));
    let in_cone = truth
        .cones
        .iter()
        .any(|c| is_subset(&claim.support, &c.slip) && is_within(&c.value, claim));
    let in_range = truth.ranges.iter().any(|r| r.support == claim.support);
    in_list || in_cone || in_range
}

fn is_within(value: &Algebraic, claim: &AcceptedClaim) -> bool {
    let mut value = value.clone();
    value.cmp_rational(claim.value.lo()) != Ordering::Less
        && value.cmp_rational(claim.value.hi()) != Ordering::Greater
}

/// One process of Python for all files of a folder.
const RUN_ALL: &str = "
import contextlib, io, sys
sys.path.insert(0, sys.argv[1])
import checker
for line in open(sys.argv[2]):
    problem, certificate = line.split()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        code = checker.main([problem, certificate])
    print(code)
";

/// Exit codes of `spec/checker.py`; none without python3.
fn second_verdicts(forgeries: &[Forgery]) -> Option<Vec<i32>> {
    let folder = tempfile::tempdir().unwrap();
    let mut list = String::new();
    let mut written: BTreeMap<String, String> = BTreeMap::new();

    for (k, forgery) in forgeries.iter().enumerate() {
        let count = written.len();
        let problem = written
            .entry(write_problem(&forgery.problem))
            .or_insert_with_key(|text| {
                let path = folder.path().join(format!("problem-{count}.json"));
                std::fs::write(&path, text).unwrap();
                path.display().to_string()
            });
        let path = folder.path().join(format!("{k}.json"));
        std::fs::write(&path, &forgery.text).unwrap();
        writeln!(list, "{problem} {}", path.display()).unwrap();
    }
    let list_path = folder.path().join("list");
    std::fs::write(&list_path, list).unwrap();

    let mut python = Command::new("python3");
    python
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", RUN_ALL]);
    python
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec"))
        .arg(&list_path);
    let Ok(output) = python.output() else {
        eprintln!("python3 is not installed: spec/checker.py was not compared");
        return None;
    };
    let codes: Vec<i32> = String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(|l| l.parse().unwrap())
        .collect();
    assert_eq!(
        codes.len(),
        forgeries.len(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Some(codes)
}

/// Judges all forgeries thrice and counts what was reached.
fn compare(forgeries: &[Forgery]) -> Reached {
    let mut reached = Reached::default();
    let ours: Vec<i32> = forgeries
        .iter()
        .map(|forgery| verdict(forgery, &mut reached))
        .collect();
    for &code in &ours {
        reached.verdicts[usize::try_from(code).unwrap()] += 1;
    }

    let mut differences = Vec::new();
    for ((forgery, ours), theirs) in forgeries
        .iter()
        .zip(&ours)
        .zip(second_verdicts(forgeries).unwrap_or_default())
    {
        if !is_same_verdict(*ours, theirs) {
            let Forgery { problem, text } = forgery;
            differences.push(format!(
                "check says {ours}, checker.py {theirs} on\n{}\n{text}",
                write_problem(problem)
            ));
        }
    }
    assert!(
        differences.is_empty(),
        "{} differences:\n{}",
        differences.len(),
        differences.join("\n\n")
    );
    println!(
        "accepted, rejected, malformed, undecided: {:?}; {:?}",
        reached.verdicts, reached.reasons
    );
    reached
}

/// One verdict. A file with two faults may be called malformed for the one or rejected for the
/// other.
fn is_same_verdict(ours: i32, theirs: i32) -> bool {
    let is_refused = |code: i32| code == REJECTED || code == MALFORMED;
    ours == theirs || (is_refused(ours) && is_refused(theirs))
}

fn witnessed_leaves(count: usize, seed: u64) -> Vec<Forgery> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let forgery = |case: Case| Forgery {
        text: case.certificate.to_json(),
        problem: case.problem,
    };
    (0..count)
        .map(|_| forgery(crate::witnessed::case(&mut rng)))
        .collect()
}

fn structural_mutants(count: usize, seed: u64) -> Vec<Forgery> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bases = bases(&mut rng);
    let parsed: Vec<Value> = bases
        .iter()
        .map(|base| serde_json::from_str(&base.text).unwrap())
        .collect();
    let pool: Vec<Value> = parsed.iter().flat_map(nodes).collect();

    let mut out = Vec::new();
    for _ in 0..count {
        let k = rng.random_range(0..bases.len());
        let mut mutant = parsed[k].clone();
        crate::structural::mutate(&mut mutant, &pool, &mut rng);
        out.push(Forgery {
            problem: bases[k].problem.clone(),
            text: mutant.to_string(),
        });
    }
    out
}

fn nodes(certificate: &Value) -> Vec<Value> {
    let pieces = certificate
        .pointer("/complete_set/pieces")
        .and_then(Value::as_array);
    let trees = pieces
        .into_iter()
        .flatten()
        .filter_map(|piece| piece["tree"].as_array());
    trees.flatten().cloned().collect()
}

/// Certificates that hold: covers of every kind with rational ends, and claims.
fn bases(rng: &mut ChaCha8Rng) -> Vec<Forgery> {
    let mut problems = vec![crate::cover::fold(Window::all()), reversed_anchor()];
    problems.extend(["two-particles", "two-particles-mu", "oblique"].map(example));
    problems.extend(
        [known::complete_graph(2), known::path(3), known::star(2)].map(|k| k.unwrap().problem),
    );
    problems.extend([known::star(3), known::jordan(3, 2, true)].map(|k| k.unwrap().problem));
    problems.extend((1..=3).map(|seed| mechanical_pencil(3, Unknown::Mu, seed).unwrap()));
    problems.extend(
        random_pencils(12, 5)
            .unwrap()
            .into_iter()
            .map(|instance| instance.problem),
    );
    problems.extend((0..12).map(|_| crate::witnessed::case(rng).problem));

    let mut out = Vec::new();
    for problem in problems {
        let is_small = reduce(&problem).unwrap().pencil.order() <= 5;
        if !is_small {
            continue;
        }
        for window in [
            problem.window().clone(),
            Window::new(rational(1, 7), None).unwrap(),
            between(rng),
        ] {
            let problem = problem.clone().with_window(window);
            out.extend(covered(&problem));
            out.extend(claimed(&problem));
            out.extend(lifted_claims(&problem));
        }
    }
    out
}

fn between(rng: &mut ChaCha8Rng) -> Window {
    let min = rational(rng.random_range(0..=30), 7);
    let max = &min + rational(rng.random_range(1..=900), 100);
    Window::new(min, Some(max)).unwrap()
}

fn reversed_anchor() -> Problem {
    let a = Sparse::from_ints(&[&[4, 1, -1], &[1, 3, 0], &[-1, 1, 2]]);
    let b = Sparse::from_ints(&[&[1, 0, 1], &[0, 1, 3], &[1, 3, 1]]);
    let pencil = Pencil::new(a, b, vec![0]).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

fn covered(problem: &Problem) -> Option<Forgery> {
    let options = Options {
        pieces: 2,
        nodes_per_piece: 200,
        ..Options::default()
    };
    let found = complete(problem, &options, &Watch::nobody()).ok()?;
    Some(Forgery {
        problem: problem.clone(),
        text: found.certificate.to_json(),
    })
}

fn claimed(problem: &Problem) -> Option<Forgery> {
    let pencil = reduce(problem).unwrap().pencil;
    let slip = pencil.slip();
    let truth = enumerate(&pencil, problem.window()).unwrap();

    let mut claims = Vec::new();
    for solution in &truth.solutions {
        let x = solution
            .x_decimals(&slip, 17)
            .iter()
            .map(|text| text.parse().unwrap())
            .collect();
        let value = solution.decimal(17).parse().unwrap();
        claims.extend(certify(problem, &pencil, &Candidate { value, x }).ok());
    }
    if claims.is_empty() {
        return None;
    }
    Some(Forgery {
        problem: problem.clone(),
        text: certificate(problem, claims).to_json(),
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
            claims.push(Claim::LiftedSolution(lifted(
                system,
                problem.unknown(),
                &claim,
            )));
        }
    }
    Some(Forgery {
        problem: problem.clone(),
        text: certificate(problem, claims).to_json(),
    })
}

/// Every verdict, and most of the reasons that a small problem can meet.
fn assert_reach(reached: &Reached, count: usize, reasons: usize) {
    let [accepted, rejected, _, undecided] = reached.verdicts;
    assert!(accepted + undecided > count / 20, "{:?}", reached.verdicts);
    assert!(rejected > count / 4, "{:?}", reached.verdicts);
    assert!(reached.reasons.len() >= reasons, "{:?}", reached.reasons);
}

#[test]
fn one_verdict_on_four_thousand_witnessed_leaves() {
    assert_reach(&compare(&witnessed_leaves(4000, 1)), 4000, 12);
}

#[test]
fn one_verdict_on_four_thousand_structural_mutants() {
    assert_reach(&compare(&structural_mutants(4000, 2)), 4000, 30);
}

#[test]
#[ignore = "half a minute; run by .ci/run"]
fn one_verdict_on_twenty_thousand_mutants() {
    assert_reach(&compare(&witnessed_leaves(10_000, 11)), 10_000, 12);
    assert_reach(&compare(&structural_mutants(10_000, 12)), 10_000, 35);
}

/// Ten minutes or more. Twenty-five rounds, so that a failure shows early.
#[test]
#[ignore = "ten minutes; not run by CI"]
fn one_verdict_on_half_a_million_mutants() {
    for round in 0..25 {
        println!("round {round}");
        assert_reach(
            &compare(&witnessed_leaves(10_000, 1000 + round)),
            10_000,
            12,
        );
        assert_reach(
            &compare(&structural_mutants(10_000, 2000 + round)),
            10_000,
            35,
        );
    }
}
