//! `spec/corpus`: our checker gives each file its verdict, for the reason that the file names, in
//! bounded time. What is demanded of all files together stands in `tests/checker/corpus.rs`.

use crate::support::{ACCEPTED, Entry, MALFORMED, REJECTED, UNDECIDED, entries};
use libtest_mimic::{Failed, Trial};
use mceip_check::Provable;
use mceip_check::certificate::{
    CRITICAL_FORMAT, Certificate, CriticalCertificate, EquilibriumCertificate, PRESENCE_FORMAT,
    PresenceCertificate,
};
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

    let expected = Judgement {
        code: entry.code,
        reason: entry.reason.clone(),
    };
    if got != expected {
        return Err(format!("expected {expected:?}, got {got:?}").into());
    }
    if elapsed >= Duration::from_secs(10) {
        return Err(format!("{elapsed:?}").into());
    }
    Ok(())
}

/// The exit code, and for a rejection the obligation's name.
#[derive(Debug, PartialEq, Eq)]
struct Judgement {
    code: i32,
    reason: String,
}

impl Judgement {
    fn without_reason(code: i32) -> Self {
        Judgement {
            code,
            reason: String::new(),
        }
    }

    fn rejected(reason: String) -> Self {
        Judgement {
            code: REJECTED,
            reason,
        }
    }
}

/// Our checker in this process.
fn judge(entry: &Entry) -> Judgement {
    let text = &entry.certificate;
    if entry.is_plain() {
        return judge_plain(entry);
    }
    if entry.is_loads() {
        let file = read_loads(&entry.problem, Path::new("/")).unwrap();
        return judged::<EquilibriumCertificate>(&file.body, text).0;
    }

    let problem = read_problem(&entry.problem, Path::new("/")).unwrap();
    let is_of_format = |format| require_format(text, format).is_ok();
    if is_of_format(CRITICAL_FORMAT) {
        return judged::<CriticalCertificate>(&problem, text).0;
    }
    if is_of_format(PRESENCE_FORMAT) {
        return judged::<PresenceCertificate>(&problem, text).0;
    }

    let (judgement, accepted) = judged::<Certificate>(&problem, text);
    let cover = accepted.and_then(|accepted| accepted.cover);
    if cover.is_some_and(|cover| !cover.open.is_empty()) {
        return Judgement::without_reason(UNDECIDED);
    }
    judgement
}

/// The judgement on a certificate of one kind, and what an accepted one has proved.
fn judged<C: Provable>(subject: &C::Subject, text: &str) -> (Judgement, Option<C::Accepted>) {
    let Ok(certificate) = C::read(text) else {
        return (Judgement::without_reason(MALFORMED), None);
    };

    match certificate.check(subject) {
        Ok(accepted) => (Judgement::without_reason(ACCEPTED), Some(accepted)),
        Err(rejected) => (Judgement::rejected(rejected.reason.name()), None),
    }
}

/// The same for a plain LCP or MCP.
fn judge_plain(entry: &Entry) -> Judgement {
    let problem = lcp::read_mcp(&entry.problem).unwrap();
    let Ok(certificate) = lcp::read_solution(&entry.certificate) else {
        return Judgement::without_reason(MALFORMED);
    };

    match lcp::judge(&problem, &certificate) {
        Ok(_) => Judgement::without_reason(ACCEPTED),
        Err(rejected) => Judgement::rejected(rejected.name()),
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
