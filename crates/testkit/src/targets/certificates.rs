//! What is read is true or refused: certificates of any text, reports of any doubles.
//!
//! Input: bytes of a fuzzer. The texts are about a few fixed problems, of which the plain
//! enumerator knows the whole answer; whatever the checker accepts must be in it. Called by the
//! fuzz targets `certificate_reader`, `hostile_report` and `problem_reader`.

use crate::asked::enumerated;
use crate::compare::in_doubles;
use crate::completed::{holds_claim, is_claimed};
use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{Accepted, AcceptedCover, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::propose;
use mceip_engine::foreign::{BadPoint, ForeignReport, Reported};
use mceip_engine::multistart::support;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, from_f64};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Pencil, Problem, Reduced, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate};

/// Certificate reader and checker on any text: what is read round-trips; bound to one of a few
/// fixed problems, what the checker accepts is in the enumerator's list, and a complete set is the
/// whole list.
pub fn certificate_reader(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };

    let mut read = match Certificate::from_json(text) {
        Ok(read) => read,
        Err(e) => return assert_eq!(e.to_string().lines().count(), 1, "{e:?}"),
    };

    let again = Certificate::from_json(&read.to_json())
        .unwrap_or_else(|e| panic!("written certificate is refused: {e}"));
    assert_eq!(again, read);

    for problem in subjects() {
        // The digest is what a forger copies first.
        read.problem_sha256 = problem.sha256();
        let problem = problem.with_window(read.window.clone());

        match check(&problem, &read) {
            Ok(accepted) => assert_true(&problem, &accepted),
            Err(e) => assert_eq!(e.to_string().lines().count(), 1, "{e:?}"),
        }
    }
}

/// Certify on a candidate of any doubles, and the report reader on it as text: no panic, and what
/// is certified is accepted and in the enumerator's answer.
pub fn hostile_report(data: &[u8]) {
    let Some((&head, rest)) = data.split_first() else {
        return;
    };

    let list = subjects();
    let problem = &list[usize::from(head) % list.len()];
    let Some(candidate) = any_candidate(rest) else {
        return;
    };

    assert_certified_is_true(problem, &candidate);
    assert_read_as_it_is(problem, &candidate);
}

/// The candidate whose value and x are these bytes, eight to a double; `None` without a value.
fn any_candidate(data: &[u8]) -> Option<Candidate> {
    let mut doubles = Vec::new();
    for chunk in data.chunks_exact(8) {
        let bytes = chunk.try_into().ok()?;
        doubles.push(f64::from_bits(u64::from_le_bytes(bytes)));
    }

    let (&value, x) = doubles.split_first()?;
    Some(Candidate {
        value,
        x: x.to_vec(),
    })
}

/// What is certified from the candidate is accepted, and true.
fn assert_certified_is_true(problem: &Problem, candidate: &Candidate) {
    let Ok(reduced) = reduce(problem).and_then(Reduced::without_zero) else {
        panic!("a fixed problem is refused")
    };
    let Ok(claim) = propose(&reduced.pencil, problem.window(), candidate) else {
        return;
    };

    let support = support(&claim).to_vec();
    match check(problem, &Certificate::of_claims(problem, vec![claim])) {
        Ok(accepted) => assert_true(problem, &accepted),
        Err(e) => {
            panic!("certified from {candidate:?} with support {support:?}, and rejected: {e}")
        }
    }
}

/// A report of the candidate is read as this candidate, or refused in one line because one of its
/// numbers is not finite.
fn assert_read_as_it_is(problem: &Problem, candidate: &Candidate) {
    let Ok(reduced) = reduce(problem).and_then(Reduced::without_zero) else {
        panic!("a fixed problem is refused")
    };

    let x: Vec<String> = candidate.x.iter().map(|v| format!("{v:e}")).collect();
    let text = format!(
        r#"{{"format":"mceip-solutions/1","solutions":[{{"value":{:e},"x":[{}]}}]}}"#,
        candidate.value,
        x.join(",")
    );

    match ForeignReport::read(&text, problem, &reduced) {
        Ok(report) => assert!(
            is_same_point(&report.solutions, candidate),
            "{text}: {:?}",
            report.solutions
        ),
        Err(e) => {
            let mut numbers = candidate.x.iter().chain([&candidate.value]);
            assert_eq!(e.to_string().lines().count(), 1, "{e:?}");
            assert!(numbers.any(|v| from_f64(*v).is_err()), "{text}: {e}");
        }
    }
}

/// Is this one solution, with the candidate's value bit by bit (but for the sign of zero), or a
/// refusal by name of a vector of another length or of a value that doubles hold with few digits?
fn is_same_point(read: &[Result<Reported, BadPoint>], candidate: &Candidate) -> bool {
    match read {
        [Ok(reported)] => {
            reported.candidate.value == candidate.value
                && reported.candidate.x.len() == candidate.x.len()
        }
        [Err(BadPoint::Length { got, .. })] => *got == candidate.x.len(),
        [Err(BadPoint::OutOfRange { .. })] => !candidate.value.is_normal(),
        _ => false,
    }
}

/// The report reader on any text, read as one about a fixed problem: what is refused is refused in
/// one line.
pub(super) fn report_reader(text: &str) {
    let list = subjects();
    let problem = &list[0];
    let Ok(reduced) = reduce(problem).and_then(Reduced::without_zero) else {
        panic!("a fixed problem is refused")
    };

    if let Err(e) = ForeignReport::read(text, problem, &reduced) {
        assert_eq!(e.to_string().lines().count(), 1, "{e:?}");
    }
}

/// The fold of `spec/errata.md`, a pencil with a free variable, a double root, a cone.
fn subjects() -> Vec<Problem> {
    let identity: &[&[i64]] = &[&[1, 0], &[0, 1]];
    let fold = pencil(&[&[1, -6], &[2, -6]], identity, &[]);
    let with_a_free_variable = pencil(
        &[&[4, 1, 1], &[1, 3, -1], &[2, 1, 5]],
        &[&[0, 0, 0], &[1, -2, 1], &[-1, 1, -3]],
        &[0],
    );
    let double_root = pencil(&[&[1, -4], &[1, -3]], identity, &[]);
    let cone = pencil(&[&[-1, 0], &[0, -1]], identity, &[]);

    let list = [
        (fold, Unknown::Lambda2),
        (with_a_free_variable, Unknown::Mu),
        (double_root, Unknown::Lambda2),
        (cone, Unknown::Lambda2),
    ];

    let mut out = Vec::new();
    for (pencil, unknown) in list {
        let problem = pencil.and_then(|p| Problem::new(Body::Pencil(p), unknown, Window::all()));
        out.extend(problem.ok());
    }
    out
}

/// The pencil of small integers A and B.
fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Result<Pencil, ModelError> {
    Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec())
}

/// Everything accepted is in the enumerator's answer, and a set without open regions is all of it.
fn assert_true(problem: &Problem, accepted: &Accepted) {
    let oracle = enumerated(problem);
    let of_the_cover = accepted.cover.iter().flat_map(|c| &c.solutions);
    for claim in accepted.claims.iter().chain(of_the_cover) {
        assert!(
            holds_claim(&oracle, claim),
            "accepted, but not a solution: {claim:?}"
        );
    }

    if let Some(cover) = &accepted.cover
        && cover.open.is_empty()
    {
        assert_complete(&oracle, cover);
    }
}

/// A cover without open regions holds every solution of the enumerator's answer.
fn assert_complete(oracle: &Enumeration, cover: &AcceptedCover) {
    assert!(
        oracle.is_plain_list() || !cover.families.is_empty(),
        "complete, but there is a cone or a range"
    );

    for solution in &oracle.solutions {
        let in_a_family = cover.families.iter().any(|f| f.support == solution.slip);
        let is_listed = cover.solutions.iter().any(|c| is_claimed(solution, c));
        assert!(
            in_a_family || is_listed,
            "complete, but {:?} at {} is missing",
            solution.slip,
            solution.decimal(12)
        );
    }
}

/// Certificates of every kind for the fixed problems: the seeds of the corpus.
pub fn certificate_seeds() -> Vec<String> {
    let options = CompleteOptions {
        pieces: 2,
        nodes_per_piece: 200,
        ..CompleteOptions::default()
    };

    let mut out = Vec::new();
    for problem in subjects() {
        if let Ok(found) = complete(&problem, &options, &Watch::nobody()) {
            out.push(found.proved.certificate().to_json());
        }

        let Ok(reduced) = reduce(&problem).and_then(Reduced::without_zero) else {
            continue;
        };
        let Ok(oracle) = enumerate(&reduced.pencil, problem.window()) else {
            continue;
        };

        let slip = reduced.pencil.slip();
        for solution in &oracle.solutions {
            let candidate = in_doubles(solution, &slip);
            let claim = propose(&reduced.pencil, problem.window(), &candidate);
            let claims: Vec<Claim> = claim.into_iter().collect();
            out.push(Certificate::of_claims(&problem, claims).to_json());
        }
    }

    out
}
