//! `spec/corpus`: certificates that must be accepted, rejected for the reason they name, or refused
//! as malformed. Our checker and `spec/checker.py` go over all of it.
//!
//! The verdict of a file is written down in it and known from how the file was made; no checker is
//! asked for it. `spec/corpus/README.md` says what the files are about and how to add one.
#![cfg(feature = "cli")]

use mceip_check::certificate::{
    CRITICAL_FORMAT, Certificate, CriticalCertificate, PRESENCE_FORMAT, PresenceCertificate,
};
use mceip_check::{check, check_critical, check_presence};
use mceip_engine::lcp;
use mceip_model::Problem;
use mceip_model::file::{read_problem, require_format};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/corpus")
}

/// Exit codes of both checkers.
pub(crate) const ACCEPTED: i32 = 0;
const REJECTED: i32 = 1;
const MALFORMED: i32 = 2;
pub(crate) const UNDECIDED: i32 = 3;

/// A file of the corpus, with its texts spelt out in a folder.
pub(crate) struct Entry {
    pub(crate) name: String,
    file: Value,
    problem: String,
    certificate: String,
}

impl Entry {
    fn verdict(&self) -> &str {
        self.file["verdict"].as_str().unwrap()
    }

    /// The obligation that fails; empty where none does.
    fn reason(&self) -> &str {
        self.file["reason"].as_str().unwrap_or_default()
    }

    /// The exit code of a checker.
    pub(crate) fn code(&self) -> i32 {
        match self.verdict() {
            "accepted" => ACCEPTED,
            "rejected" => REJECTED,
            "malformed" => MALFORMED,
            "undecided" => UNDECIDED,
            other => panic!("{other}"),
        }
    }

    /// About an LCP or MCP, not an eigenproblem.
    pub(crate) fn is_plain(&self) -> bool {
        self.file["problem"]["format"] == lcp::MCP_FORMAT
    }

    /// About absence below a friction.
    fn is_critical(&self) -> bool {
        require_format(&self.certificate_text(), CRITICAL_FORMAT).is_ok()
    }

    /// About presence on an interval of friction.
    fn is_presence(&self) -> bool {
        require_format(&self.certificate_text(), PRESENCE_FORMAT).is_ok()
    }

    /// Made to take long, or much memory.
    fn is_heavy(&self) -> bool {
        self.file.get("repeat").is_some() || self.name.contains("hostile")
    }

    pub(crate) fn problem_text(&self) -> String {
        std::fs::read_to_string(&self.problem).unwrap()
    }

    pub(crate) fn certificate_text(&self) -> String {
        std::fs::read_to_string(&self.certificate).unwrap()
    }
}

/// The certificate's text: as it stands, or with the mark replaced by copies of the unit.
fn spelt_out(file: &Value) -> String {
    let Some(text) = file["certificate_text"].as_str() else {
        return file["certificate"].to_string();
    };
    let Some(repeat) = file.get("repeat") else {
        return text.into();
    };

    let mark = repeat["mark"].as_str().unwrap();
    let unit = repeat["unit"].as_str().unwrap();
    let count = usize::try_from(repeat["count"].as_u64().unwrap()).unwrap();
    text.replacen(mark, &unit.repeat(count), 1)
}

/// All files by name, their texts written to a folder.
pub(crate) fn entries(folder: &Path) -> Vec<Entry> {
    let mut list = Vec::new();
    for kind in ["accept", "reject", "malformed"] {
        for file in std::fs::read_dir(root().join(kind)).unwrap() {
            list.push(read_entry(kind, &file.unwrap().path(), folder));
        }
    }

    list.sort_by(|a, b| a.name.cmp(&b.name));
    list
}

fn read_entry(kind: &str, path: &Path, folder: &Path) -> Entry {
    let stem = path.file_stem().unwrap().to_str().unwrap();
    let name = format!("{kind}-{stem}");
    let text = std::fs::read_to_string(path).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    assert_frame(kind, &name, &file);

    let problem = folder.join(format!("{name}.problem.json"));
    std::fs::write(&problem, file["problem"].to_string()).unwrap();
    let certificate = folder.join(format!("{name}.certificate.json"));
    std::fs::write(&certificate, spelt_out(&file)).unwrap();

    Entry {
        name,
        file,
        problem: problem.display().to_string(),
        certificate: certificate.display().to_string(),
    }
}

/// The format, a note, and a verdict that belongs to the folder.
fn assert_frame(kind: &str, name: &str, file: &Value) {
    assert_eq!(file["format"], "mceip-corpus/1", "{name}");

    let note = file["note"].as_str().unwrap_or_default();
    assert!(!note.is_empty(), "{name}: which bug does it stand for?");

    let of_kind: &[&str] = match kind {
        "accept" => &["accepted", "undecided"],
        "reject" => &["rejected"],
        _ => &["malformed"],
    };
    let verdict = file["verdict"].as_str().unwrap();
    assert!(of_kind.contains(&verdict), "{name}");
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
    if entry.is_plain() {
        return judge_plain(entry);
    }

    let problem = read_problem(&entry.problem_text(), Path::new("/")).unwrap();
    if entry.is_critical() {
        return judge_critical(entry, &problem);
    }
    if entry.is_presence() {
        return judge_presence(entry, &problem);
    }

    let Ok(certificate) = Certificate::from_json(&entry.certificate_text()) else {
        return Judgement::without_reason(MALFORMED);
    };

    match check(&problem, &certificate) {
        Ok(accepted) => {
            let is_open = accepted.cover.is_some_and(|cover| !cover.open.is_empty());
            Judgement::without_reason(if is_open { UNDECIDED } else { ACCEPTED })
        }
        Err(rejected) => Judgement::rejected(rejected.reason.name()),
    }
}

/// The same for absence below a friction.
fn judge_critical(entry: &Entry, problem: &Problem) -> Judgement {
    let Ok(certificate) = CriticalCertificate::from_json(&entry.certificate_text()) else {
        return Judgement::without_reason(MALFORMED);
    };

    match check_critical(problem, &certificate) {
        Ok(_) => Judgement::without_reason(ACCEPTED),
        Err(rejected) => Judgement::rejected(rejected.reason.name()),
    }
}

/// The same for presence on an interval of friction.
fn judge_presence(entry: &Entry, problem: &Problem) -> Judgement {
    let Ok(certificate) = PresenceCertificate::from_json(&entry.certificate_text()) else {
        return Judgement::without_reason(MALFORMED);
    };

    match check_presence(problem, &certificate) {
        Ok(_) => Judgement::without_reason(ACCEPTED),
        Err(rejected) => Judgement::rejected(rejected.reason.name()),
    }
}

/// The same for a plain LCP or MCP.
fn judge_plain(entry: &Entry) -> Judgement {
    let problem = lcp::read_mcp(&entry.problem_text()).unwrap();
    let Ok(certificate) = lcp::read_solution(&entry.certificate_text()) else {
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

#[test]
fn our_checker_gives_every_verdict_and_reason() {
    let folder = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    let mut seen = [0; 4];

    for entry in entries(folder.path()) {
        let name = &entry.name;
        let start = time_of_this_thread();
        let got = judge(&entry);
        let elapsed = time_of_this_thread() - start;
        assert!(elapsed < Duration::from_secs(10), "{name}: {elapsed:?}");

        let expected = Judgement {
            code: entry.code(),
            reason: entry.reason().into(),
        };
        if got != expected {
            wrong.push(format!("{name}: expected {expected:?}, got {got:?}"));
        }
        seen[usize::try_from(entry.code()).unwrap()] += 1;
    }

    assert!(wrong.is_empty(), "{wrong:#?}");

    println!("accepted, rejected, malformed, undecided: {seen:?}");
    let [accepted, rejected, malformed, undecided] = seen;
    assert!(rejected >= accepted + undecided, "{seen:?}");
    assert!(accepted >= 25, "{seen:?}");
    assert!(rejected >= 90, "{seen:?}");
    assert!(malformed >= 45, "{seen:?}");
}

/// Reasons that no file reaches: a claim and a cover that contradict each other are not both true,
/// and a checker that accepts nothing false refuses the false one by its own obligations.
/// `crates/check/src/lib.rs` tests it on made-up covers. A negative slip is a reason against
/// numbers without a certificate: `crates/check/src/backward_error.rs` tests it.
const UNREACHABLE: [&str; 2] = ["NotInCover", "XNegative"];

/// Each obligation of the checker is the reason of some file. The obligations are the variants of
/// the enumerations in the source, so that a new one without a file is noticed.
#[test]
fn every_obligation_has_a_forgery() {
    let folder = tempfile::tempdir().unwrap();
    let entries = entries(folder.path());
    let all = reasons(entries.iter());
    let of_plain = reasons(entries.iter().filter(|entry| entry.is_plain()));

    let mut missing = Vec::new();
    for name in variants("crates/check/src/reason.rs", "Reason") {
        let is_exempt =
            ["Cover", "Boxes"].contains(&name.as_str()) || UNREACHABLE.contains(&name.as_str());
        if !is_exempt && !all.contains(&name) {
            missing.push(name);
        }
    }

    for name in variants("crates/check/src/cover/fault.rs", "CoverFault") {
        let reason = format!("Cover.{name}");
        if !all.contains(&reason) {
            missing.push(reason);
        }
    }

    let mut plain = variants("crates/engine/src/lcp/verdict.rs", "McpRejected");
    plain.extend(variants("crates/engine/src/lcp/check.rs", "Violated"));
    for name in plain {
        if name != "Solution" && !of_plain.contains(&name) {
            missing.push(format!("plain {name}"));
        }
    }

    assert!(missing.is_empty(), "no forgery for {missing:?}");
}

/// The reasons that files give.
fn reasons<'a>(entries: impl Iterator<Item = &'a Entry>) -> BTreeSet<String> {
    entries
        .map(|entry| entry.reason().to_string())
        .filter(|reason| !reason.is_empty())
        .collect()
}

/// The names of the variants of an enumeration in a file of the source.
fn variants(file: &str, enumeration: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = std::fs::read_to_string(path).unwrap();
    let start = format!("pub enum {enumeration} {{");
    let (_, after_start) = text.split_once(&start).unwrap();
    let (body, _) = after_start.split_once("\n}").unwrap();

    let mut names = Vec::new();
    for line in body.lines() {
        let Some(declaration) = line.strip_prefix("    ") else {
            continue;
        };
        if declaration.starts_with(char::is_uppercase) {
            let name = declaration.chars().take_while(char::is_ascii_alphanumeric);
            names.push(name.collect());
        }
    }
    names
}

/// From outside: exit codes, one line on stderr for what is malformed, 512 MiB of addresses and ten
/// seconds of processor time at most. (The program that is released takes less than half of the
/// time of this unoptimised one.)
#[test]
fn the_program_stays_within_bounds() {
    let folder = tempfile::tempdir().unwrap();
    for entry in entries(folder.path()) {
        if entry.code() == MALFORMED || entry.is_heavy() {
            assert_within_bounds(&entry);
        }
    }
}

fn assert_within_bounds(entry: &Entry) {
    let name = &entry.name;
    let start = Instant::now();
    let output = Command::new("sh")
        .arg("-c")
        .arg("ulimit -v 524288; ulimit -t 10; exec \"$0\" check \"$1\" \"$2\"")
        .arg(env!("CARGO_BIN_EXE_mceip"))
        .args([&entry.problem, &entry.certificate])
        .output()
        .unwrap();
    let elapsed = start.elapsed();
    let err = String::from_utf8_lossy(&output.stderr);

    assert_eq!(output.status.code(), Some(entry.code()), "{name}: {err}");
    assert!(elapsed < Duration::from_secs(30), "{name}: {elapsed:?}");
    if entry.code() == MALFORMED {
        assert!(output.stdout.is_empty(), "{name}");
        assert_eq!(err.lines().count(), 1, "{name}: {err}");
        assert!(err.len() < 1000, "{name}: {err}");
    }
}

/// One process for all files: prints the exit code of each.
const RUN_ALL: &str = "
import contextlib, io, sys
sys.path.insert(0, sys.argv[1])
import checker
for problem, certificate in zip(sys.argv[2::2], sys.argv[3::2]):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        code = checker.main([problem, certificate])
    print(code)
";

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn the_second_checker_gives_every_verdict() {
    let folder = tempfile::tempdir().unwrap();
    let entries = entries(folder.path());
    let mut files = Vec::new();
    for entry in &entries {
        files.push([&entry.problem, &entry.certificate].map(PathBuf::from));
    }
    let codes = second_codes(&files);

    let mut wrong = Vec::new();
    for (entry, code) in entries.iter().zip(codes) {
        if entry.code() != code {
            let verdict = entry.verdict();
            wrong.push(format!(
                "{}: expected {verdict}, got exit {code}",
                entry.name
            ));
        }
    }

    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Exit codes of `spec/checker.py`, one for each pair of a problem and a certificate.
pub(crate) fn second_codes(files: &[[PathBuf; 2]]) -> Vec<i32> {
    let mut python = Command::new("python3");
    python
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", RUN_ALL])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec"));

    python.args(files.as_flattened());

    let output = python.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let codes: Vec<i32> = text.lines().map(|line| line.parse().unwrap()).collect();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(codes.len(), files.len(), "{err}");
    codes
}
