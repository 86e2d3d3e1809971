//! What the checker says of each file of `spec/corpus`, to the last digit: which obligation fails,
//! where, what was expected and what was got; for what is accepted, every value, interval, family
//! and open region that is proved. `tests/verdicts.txt` holds it. A line changes only with a
//! reason; new files of the corpus are added by
//!
//!     SNAPSHOTS=overwrite cargo test --test checker verdicts

use crate::corpus_reader::{Entry, MALFORMED, entries};
use mceip_check::certificate::{
    CRITICAL_FORMAT, Certificate, CriticalCertificate, PRESENCE_FORMAT, PresenceCertificate,
};
use mceip_check::{
    Accepted, AcceptedAbsence, AcceptedCover, AcceptedPresence, Rejected, SolutionFamily, audit,
    audit_critical, check, check_critical, check_presence,
};
use mceip_exact::Interval;
use mceip_model::Problem;
use mceip_model::file::{read_problem, require_format};
use num_traits::Zero;
use snapbox::{Assert, Data};
use std::fmt::Write as _;
use std::path::Path;

/// A file of the corpus whose certificate can be read.
struct Case {
    name: String,
    problem: Problem,
    certificate: Read,
}

/// A certificate of one of the formats.
enum Read {
    Certificate(Certificate),
    Critical(CriticalCertificate),
    Presence(PresenceCertificate),
}

/// The files whose certificates can be read, by name; those that repeat a unit and those about
/// plain LCPs and MCPs are for `tests/data/corpus.rs`.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for entry in entries() {
        if entry.code != MALFORMED && !entry.is_repeated() && !entry.is_plain() {
            cases.push(read_case(&entry));
        }
    }
    cases
}

fn read_case(entry: &Entry) -> Case {
    let text = &entry.certificate;
    let certificate = if require_format(text, CRITICAL_FORMAT).is_ok() {
        Read::Critical(CriticalCertificate::from_json(text).unwrap())
    } else if require_format(text, PRESENCE_FORMAT).is_ok() {
        Read::Presence(PresenceCertificate::from_json(text).unwrap())
    } else {
        Read::Certificate(Certificate::from_json(text).unwrap())
    };

    Case {
        name: entry.name.clone(),
        problem: read_problem(&entry.problem, Path::new("/")).unwrap(),
        certificate,
    }
}

/// The text of `tests/verdicts.txt`: each line begins with the name of a file.
fn verdicts() -> String {
    let mut text = String::new();
    for case in cases() {
        let lines = match &case.certificate {
            Read::Certificate(certificate) => lines_of(&case, certificate),
            Read::Critical(certificate) => critical_lines(&case, certificate),
            Read::Presence(certificate) => presence_lines(&case, certificate),
        };
        for line in lines {
            writeln!(text, "{}: {line}", case.name).unwrap();
        }
    }
    text
}

fn lines_of(case: &Case, certificate: &Certificate) -> Vec<String> {
    match check(&case.problem, certificate) {
        Ok(accepted) => accepted_lines(&accepted),
        Err(rejected) => rejected_lines(case, certificate, &rejected),
    }
}

fn critical_lines(case: &Case, certificate: &CriticalCertificate) -> Vec<String> {
    let audited = audit_critical(&case.problem, certificate, &|| true);
    let audited = audited.map(|audited| audited.unwrap().1);
    let refused = |list| format!("audit: leaves refused (piece, node): {list:?}");

    match (check_critical(&case.problem, certificate), audited) {
        (Ok(accepted), Ok(list)) => {
            assert!(list.is_empty(), "{}", case.name);
            let AcceptedAbsence {
                from,
                below,
                leaves,
            } = accepted;
            let above = if from.is_zero() {
                String::new()
            } else {
                format!("from {from} ")
            };
            vec![format!("absence {above}below {below}, leaves: {leaves}")]
        }
        (Err(rejected), Ok(list)) => {
            vec![
                format!("{}: {rejected}", rejected.reason.name()),
                refused(list),
            ]
        }
        (Err(rejected), Err(again)) => {
            assert_eq!(again, rejected, "{}", case.name);
            vec![format!("{}: {rejected}", rejected.reason.name())]
        }
        (Ok(_), Err(rejected)) => panic!("{}: {rejected}", case.name),
    }
}

fn presence_lines(case: &Case, certificate: &PresenceCertificate) -> Vec<String> {
    let line = match check_presence(&case.problem, certificate) {
        Ok(AcceptedPresence { from, to, pieces }) => {
            format!("presence from {from} to {to}, pieces: {pieces}")
        }
        Err(rejected) => format!("{}: {rejected}", rejected.reason.name()),
    };
    vec![line]
}

fn accepted_lines(accepted: &Accepted) -> Vec<String> {
    let mut lines = Vec::new();
    for (number, claim) in accepted.claims.iter().enumerate() {
        let value = spelt(&claim.value);
        lines.push(format!(
            "claim {number}: support {:?} in {value}",
            claim.support
        ));
    }

    if let Some(cover) = &accepted.cover {
        lines.extend(cover_lines(cover));
    }
    lines
}

fn cover_lines(cover: &AcceptedCover) -> Vec<String> {
    let mut lines = Vec::new();
    for solution in &cover.solutions {
        let value = spelt(&solution.value);
        lines.push(format!("only support {:?} in {value}", solution.support));
    }

    for family in &cover.families {
        lines.push(family_line(family));
    }

    for region in &cover.open {
        let max = region.max.as_ref().map(ToString::to_string);
        lines.push(format!(
            "open [{}, {max:?}] moving {:?} undecided {:?}",
            region.min, region.moving, region.undecided
        ));
    }

    let is_plain_list = cover.is_plain_list();
    let is_absence = cover.proves_absence();
    lines.push(format!(
        "(leaves, plain list, absence): ({}, {is_plain_list}, {is_absence})",
        cover.leaves
    ));
    lines
}

fn family_line(family: &SolutionFamily) -> String {
    let from = spelt(&family.from);
    let to = family.to.as_ref().map(spelt);
    format!(
        "family {:?} from {from} to {to:?} (point, alone): ({}, {})",
        family.support, family.is_point, family.is_alone
    )
}

fn spelt(interval: &Interval) -> String {
    format!("[{}, {}]", interval.lo(), interval.hi())
}

/// The reason, and for a cover the leaves that an audit refuses.
fn rejected_lines(case: &Case, certificate: &Certificate, rejected: &Rejected) -> Vec<String> {
    let mut lines = vec![format!("{}: {rejected}", rejected.reason.name())];
    match audit(&case.problem, certificate) {
        Ok((_, refused)) => lines.push(format!("audit: leaves refused (piece, node): {refused:?}")),
        Err(again) => assert_eq!(again, *rejected, "{}", case.name),
    }
    lines
}

#[test]
fn every_verdict_is_the_same_to_the_last_digit() {
    let expected = Data::read_from(Path::new("tests/verdicts.txt"), None).raw();
    let assert = Assert::new().action_env("SNAPSHOTS");
    assert.eq(verdicts(), expected);
}
