//! `spec/corpus`: our checker gives each file its verdict, for the reason that the file names, in
//! bounded time. What is demanded of all files together stands in `tests/checker/corpus.rs`.

use crate::support::{ACCEPTED, Entry, MALFORMED, REJECTED, UNDECIDED, entries};
use libtest_mimic::{Failed, Trial};
use mceip_check::certificate::{
    CRITICAL_FORMAT, Certificate, CriticalCertificate, EquilibriumCertificate, PRESENCE_FORMAT,
    PresenceCertificate, STABILITY_FORMAT, StabilityCertificate,
};
use mceip_check::{Provable, check};
use mceip_engine::lcp;
use mceip_model::file::{read_loads, read_problem, require_format};
use std::path::Path;
use std::time::Duration;

/// A test for each file: `corpus::reject::cover-pivot`.
pub(crate) fn tests() -> Vec<Trial> {
    let mut tests = Vec::new();
    for entry in entries() {
        let name = format!("corpus::{}", entry.name.replace('/', "::"));
        tests.push(Trial::test(name, move || verdict_and_reason(&entry)));
    }
    tests
}

/// The verdict and the reason of the file, within ten seconds of processor time.
fn verdict_and_reason(entry: &Entry) -> Result<(), Failed> {
    let start = time_of_this_thread();
    let got = judge(entry);
    let elapsed = time_of_this_thread() - start;

    let expected = (entry.code, entry.reason.clone());
    if got != expected {
        return Err(format!("expected {expected:?}, got {got:?}").into());
    }
    if elapsed >= Duration::from_secs(10) {
        return Err(format!("{elapsed:?}").into());
    }
    Ok(())
}

/// Our checker in this process: the exit code, and for a rejection the obligation's name.
fn judge(entry: &Entry) -> (i32, String) {
    let certificate = entry.certificate.as_str();
    if entry.is_plain() {
        let problem = lcp::read_mcp(&entry.problem).unwrap();
        return judge_by(lcp::read_solution(certificate), |solution| {
            let judged = lcp::judge(&problem, solution);
            judged.map(|_| ACCEPTED).map_err(|refused| refused.name())
        });
    }

    let folder = Path::new("/");
    if entry.is_loads() {
        let file = read_loads(&entry.problem, folder).unwrap();
        return judge_kind::<EquilibriumCertificate>(&file.body, certificate);
    }

    let problem = read_problem(&entry.problem, folder).unwrap();
    let is_of_format = |format| require_format(certificate, format).is_ok();
    if is_of_format(CRITICAL_FORMAT) {
        judge_kind::<CriticalCertificate>(&problem, certificate)
    } else if is_of_format(PRESENCE_FORMAT) {
        judge_kind::<PresenceCertificate>(&problem, certificate)
    } else if is_of_format(STABILITY_FORMAT) {
        judge_kind::<StabilityCertificate>(&problem, certificate)
    } else {
        judge_by(Certificate::from_json(certificate), |certificate| {
            let accepted = check(&problem, certificate).map_err(|e| e.reason.name())?;
            let is_open = accepted.cover.is_some_and(|cover| !cover.open.is_empty());
            Ok(if is_open { UNDECIDED } else { ACCEPTED })
        })
    }
}

/// The verdict on a certificate of a kind that leaves nothing open.
fn judge_kind<C: Provable>(subject: &C::Subject, text: &str) -> (i32, String) {
    judge_by(C::read(text), |certificate| {
        let checked = certificate.check(subject);
        checked.map(|_| ACCEPTED).map_err(|e| e.reason.name())
    })
}

/// The verdict on what was read; the check gives an exit code or the reason of the rejection.
fn judge_by<C, E>(
    read: Result<C, E>,
    check: impl FnOnce(&C) -> Result<i32, String>,
) -> (i32, String) {
    match read.ok().map(|certificate| check(&certificate)) {
        None => (MALFORMED, String::new()),
        Some(Ok(code)) => (code, String::new()),
        Some(Err(reason)) => (REJECTED, reason),
    }
}

/// Processor time of this thread: on a busy machine the clock on the wall says nothing.
#[cfg(unix)]
fn time_of_this_thread() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(
        time.tv_sec.unsigned_abs(),
        time.tv_nsec.unsigned_abs() as u32,
    )
}

#[cfg(not(unix))]
fn time_of_this_thread() -> Duration {
    Duration::ZERO
}
