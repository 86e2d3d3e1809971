//! What the checker says of each file of `spec/corpus`, to the last digit: which obligation fails,
//! where, what was expected and what was got; for what is accepted, every value, interval, family
//! and open region that is proved. `tests/verdicts.txt` holds it. A line changes only with a
//! reason; new files of the corpus are added by
//!
//!     SNAPSHOTS=overwrite cargo test --test checker verdicts

use crate::corpus_reader::{Entry, MALFORMED, entries};
use mceip_check::certificate::{
    CRITICAL_FORMAT, Certificate, CriticalCertificate, EquilibriumCertificate, PRESENCE_FORMAT,
    PresenceCertificate, STABILITY_FORMAT, StabilityCertificate,
};
use mceip_check::{
    Accepted, AcceptedAbsence, AcceptedCover, AcceptedEquilibrium, AcceptedPresence,
    AcceptedStability, Provable, Rejected, SolutionFamily, audit, audit_critical, check,
    check_critical,
};
use mceip_exact::Interval;
use mceip_model::Problem;
use mceip_model::file::{read_loads, read_problem, require_format};
use num_traits::Zero;
use snapbox::{Assert, Data};
use std::fmt::Write as _;
use std::path::Path;

/// The text of `tests/verdicts.txt`: each line begins with the name of a file. The files are those
/// whose certificates can be read; those that repeat a unit and those about plain LCPs and MCPs are
/// for `tests/data/corpus.rs`.
fn verdicts() -> String {
    let mut text = String::new();
    for entry in entries() {
        if entry.code == MALFORMED || entry.is_repeated() || entry.is_plain() {
            continue;
        }
        for line in lines_of_entry(&entry) {
            writeln!(text, "{}: {line}", entry.name).unwrap();
        }
    }
    text
}

fn lines_of_entry(entry: &Entry) -> Vec<String> {
    let name = &entry.name;
    let text = &entry.certificate;
    if entry.is_loads() {
        let file = read_loads(&entry.problem, Path::new("/")).unwrap();
        return line_of::<EquilibriumCertificate>(&file.body, text, equilibrium_line);
    }

    let problem = read_problem(&entry.problem, Path::new("/")).unwrap();
    let is_of_format = |format| require_format(text, format).is_ok();
    if is_of_format(CRITICAL_FORMAT) {
        critical_lines(
            name,
            &problem,
            &CriticalCertificate::from_json(text).unwrap(),
        )
    } else if is_of_format(PRESENCE_FORMAT) {
        line_of::<PresenceCertificate>(&problem, text, presence_line)
    } else if is_of_format(STABILITY_FORMAT) {
        line_of::<StabilityCertificate>(&problem, text, stability_line)
    } else {
        lines_of(name, &problem, &Certificate::from_json(text).unwrap())
    }
}

/// The line of a certificate of a kind that leaves nothing open.
fn line_of<C: Provable>(
    subject: &C::Subject,
    text: &str,
    accepted_line: fn(C::Accepted) -> String,
) -> Vec<String> {
    let Ok(certificate) = C::read(text) else {
        panic!("a certificate that is read: {text}")
    };
    let line = match certificate.check(subject) {
        Ok(accepted) => accepted_line(accepted),
        Err(rejected) => format!("{}: {rejected}", rejected.reason.name()),
    };
    vec![line]
}

fn lines_of(name: &str, problem: &Problem, certificate: &Certificate) -> Vec<String> {
    match check(problem, certificate) {
        Ok(accepted) => accepted_lines(&accepted),
        Err(rejected) => rejected_lines(name, problem, certificate, &rejected),
    }
}

fn critical_lines(name: &str, problem: &Problem, certificate: &CriticalCertificate) -> Vec<String> {
    let audited = audit_critical(problem, certificate, &|| true);
    let audited = audited.map(|audited| audited.unwrap().1);
    let refused = |list| format!("audit: leaves refused (piece, node): {list:?}");

    match (check_critical(problem, certificate), audited) {
        (Ok(accepted), Ok(list)) => {
            assert!(list.is_empty(), "{name}");
            let AcceptedAbsence {
                from,
                below,
                leaves,
                is_of_every_member,
            } = accepted;
            let above = if from.is_zero() {
                String::new()
            } else {
                format!("from {from} ")
            };
            let of = members(is_of_every_member);
            vec![format!(
                "absence {above}below {below}, leaves: {leaves}{of}"
            )]
        }
        (Err(rejected), Ok(list)) => {
            vec![
                format!("{}: {rejected}", rejected.reason.name()),
                refused(list),
            ]
        }
        (Err(rejected), Err(again)) => {
            assert_eq!(again, rejected, "{name}");
            vec![format!("{}: {rejected}", rejected.reason.name())]
        }
        (Ok(_), Err(rejected)) => panic!("{name}: {rejected}"),
    }
}

fn presence_line(accepted: AcceptedPresence) -> String {
    let AcceptedPresence {
        from,
        to,
        pieces,
        is_of_every_member,
    } = accepted;
    let of = members(is_of_every_member);
    format!("presence from {from} to {to}, pieces: {pieces}{of}")
}

fn members(is_of_every_member: bool) -> &'static str {
    if is_of_every_member {
        ", every member"
    } else {
        ""
    }
}

fn stability_line(accepted: AcceptedStability) -> String {
    let AcceptedStability {
        from,
        to,
        is_of_every_motion,
    } = accepted;
    let of = if is_of_every_motion {
        "every motion"
    } else {
        "motions that keep to their states"
    };
    format!("stability from {from} to {to} of {of}")
}

fn equilibrium_line(accepted: AcceptedEquilibrium) -> String {
    let states = accepted.states.iter().map(|state| state.letter());
    let states: String = states.collect();
    format!("equilibrium in the states {states}")
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
        let min = region
            .min
            .as_ref()
            .map_or("-inf".into(), ToString::to_string);
        let max = region.max.as_ref().map(ToString::to_string);
        lines.push(format!(
            "open [{min}, {max:?}] moving {:?} undecided {:?}",
            region.moving, region.undecided
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
    let from = family.from.as_ref().map_or("-inf".into(), spelt);
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
fn rejected_lines(
    name: &str,
    problem: &Problem,
    certificate: &Certificate,
    rejected: &Rejected,
) -> Vec<String> {
    let mut lines = vec![format!("{}: {rejected}", rejected.reason.name())];
    match audit(problem, certificate) {
        Ok((_, refused)) => lines.push(format!("audit: leaves refused (piece, node): {refused:?}")),
        // No leaf of values below 0 is left open.
        Err(again) if again.is_negative => lines.push(format!("audit: {again}")),
        Err(again) => assert_eq!(again, *rejected, "{name}"),
    }
    lines
}

#[test]
fn every_verdict_is_the_same_to_the_last_digit() {
    let expected = Data::read_from(Path::new("tests/verdicts.txt"), None).raw();
    let assert = Assert::new().action_env("SNAPSHOTS");
    assert.eq(verdicts(), expected);
}
