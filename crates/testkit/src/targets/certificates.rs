//! What is read is true or refused: certificates of any text, reports of any doubles.

use mceip_check::certificate::{Certificate, Claim};
use mceip_check::{Accepted, AcceptedClaim, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, propose};
use mceip_engine::foreign::{BadPoint, ForeignReport, Reported};
use mceip_engine::multistart::support;
use mceip_engine::reduction::reduce;
use mceip_engine::run::Watch;
use mceip_exact::{Sparse, from_f64};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, enumerate};
use std::cmp::Ordering;

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
            Ok(accepted) => hold(&problem, &accepted),
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

    let doubles: Vec<f64> = rest
        .chunks_exact(8)
        .filter_map(|c| Some(f64::from_bits(u64::from_le_bytes(c.try_into().ok()?))))
        .collect();
    let Some((&value, x)) = doubles.split_first() else {
        return;
    };

    let candidate = Candidate {
        value,
        x: x.to_vec(),
    };
    let Ok(reduced) = reduce(problem) else {
        panic!("a fixed problem is refused")
    };

    if let Ok(claim) = propose(&reduced.pencil, problem.window(), &candidate) {
        let support = support(&claim).to_vec();
        match check(problem, &certificate(problem, vec![claim])) {
            Ok(accepted) => hold(problem, &accepted),
            Err(e) => {
                panic!("certified from {candidate:?} with support {support:?}, and rejected: {e}")
            }
        }
    }

    let number = |v: &f64| format!("{v:e}");
    let list: Vec<String> = x.iter().map(number).collect();

    let text = format!(
        r#"{{"format":"mceip-solutions/1","solutions":[{{"value":{},"x":[{}]}}]}}"#,
        number(&value),
        list.join(",")
    );

    match ForeignReport::read(&text, problem, &reduced) {
        Ok(report) => assert!(
            is_same_point(&report.solutions, &candidate),
            "{text}: {:?}",
            report.solutions
        ),
        Err(e) => {
            assert_eq!(e.to_string().lines().count(), 1, "{e:?}");
            assert!(doubles.iter().any(|v| from_f64(*v).is_err()), "{text}: {e}");
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
    let Ok(reduced) = reduce(problem) else {
        panic!("a fixed problem is refused")
    };

    if let Err(e) = ForeignReport::read(text, problem, &reduced) {
        assert_eq!(e.to_string().lines().count(), 1, "{e:?}");
    }
}

/// The fold of `spec/errata.md`, a pencil with a free variable, a double root, a cone.
fn subjects() -> Vec<Problem> {
    let pencil = |a: &[&[i64]], b: &[&[i64]], free: &[usize], unknown| {
        let pencil = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec());
        pencil
            .and_then(|p| Problem::new(Body::Pencil(p), unknown, Window::all()))
            .ok()
    };

    let one: &[&[i64]] = &[&[1, 0], &[0, 1]];
    let list = [
        pencil(&[&[1, -6], &[2, -6]], one, &[], Unknown::Lambda2),
        pencil(
            &[&[4, 1, 1], &[1, 3, -1], &[2, 1, 5]],
            &[&[0, 0, 0], &[1, -2, 1], &[-1, 1, -3]],
            &[0],
            Unknown::Mu,
        ),
        pencil(&[&[1, -4], &[1, -3]], one, &[], Unknown::Lambda2),
        pencil(&[&[-1, 0], &[0, -1]], one, &[], Unknown::Lambda2),
    ];

    list.into_iter().flatten().collect()
}

/// Everything accepted is in the enumerator's answer.
fn hold(problem: &Problem, accepted: &Accepted) {
    let Ok(oracle) = reduce(problem)
        .map_err(drop)
        .and_then(|r| enumerate(&r.pencil, problem.window()).map_err(drop))
    else {
        panic!("a fixed problem is refused")
    };

    let cover = accepted.cover.iter().flat_map(|c| &c.solutions);
    for claim in accepted.claims.iter().chain(cover) {
        assert!(
            is_listed(&oracle, claim),
            "accepted, but not a solution: {claim:?}"
        );
    }

    if let Some(cover) = accepted.cover.as_ref().filter(|c| c.open.is_empty()) {
        assert!(
            oracle.is_plain_list() || !cover.families.is_empty(),
            "complete, but there is a cone or a range"
        );

        let in_family = |s: &Solution| cover.families.iter().any(|f| f.support == s.slip);
        for s in oracle.solutions.iter().filter(|s| !in_family(s)) {
            assert!(
                cover.solutions.iter().any(|c| is_same(s, c)),
                "complete, but {:?} at {} is missing",
                s.slip,
                s.decimal(12)
            );
        }
    }
}

fn is_listed(oracle: &Enumeration, claim: &AcceptedClaim) -> bool {
    let subset = |a: &[usize], b: &[usize]| a.iter().all(|i| b.contains(i));
    oracle.solutions.iter().any(|s| is_same(s, claim))
        || oracle
            .cones
            .iter()
            .any(|c| subset(&claim.support, &c.slip) && within(&c.value, claim))
        || oracle.ranges.iter().any(|r| r.support == claim.support)
}

fn is_same(s: &Solution, claim: &AcceptedClaim) -> bool {
    s.slip == claim.support && within(&s.value, claim)
}

fn within(value: &mceip_exact::Algebraic, claim: &AcceptedClaim) -> bool {
    let mut value = value.clone();
    value.cmp_rational(claim.value.lo()) != Ordering::Less
        && value.cmp_rational(claim.value.hi()) != Ordering::Greater
}

/// Certificates of every kind for the fixed problems: the seeds of the corpus.
pub fn certificate_seeds() -> Vec<String> {
    use mceip_engine::search::complete::{Options, complete};
    let mut out = Vec::new();

    for problem in subjects() {
        let options = Options {
            pieces: 2,
            nodes_per_piece: 200,
            ..Options::default()
        };

        if let Ok(found) = complete(&problem, &options, &Watch::nobody()) {
            out.push(found.certificate.to_json());
        }

        let Ok(reduced) = reduce(&problem) else {
            continue;
        };

        let Ok(oracle) = enumerate(&reduced.pencil, problem.window()) else {
            continue;
        };

        let slip = reduced.pencil.slip();
        for s in &oracle.solutions {
            let x = s
                .x_decimals(&slip, 17)
                .iter()
                .map(|t| t.parse().unwrap_or(f64::NAN))
                .collect(); // our own decimals parse

            let candidate = Candidate {
                value: s.decimal(17).parse().unwrap_or(f64::NAN),
                x,
            };
            let claims: Vec<Claim> = propose(&reduced.pencil, problem.window(), &candidate)
                .into_iter()
                .collect();
            out.push(certificate(&problem, claims).to_json());
        }
    }

    out
}
