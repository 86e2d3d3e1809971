//! `spec/corpus`: certificates that must be accepted, rejected for the reason they name, or refused
//! as malformed. Our checker and `spec/checker.py` go over all of it. A file is never changed once
//! it is released (spec/formats.md, Versions); new ones are written by
//!
//!     cargo test --test checker -- --ignored corpus::write_the_corpus
//!
//! but for the files `hostile-*` whose work is limited (spec/certificates.md, Limits), which are
//! written by hand.
#![cfg(feature = "cli")]

#[path = "../support/corpus_beside.rs"]
mod corpus_beside;
#[path = "../support/corpus_by_leaf.rs"]
mod corpus_by_leaf;
#[path = "../support/corpus_cases.rs"]
mod corpus_cases;
#[path = "../support/corpus_claims.rs"]
mod corpus_claims;
#[path = "../support/corpus_covers.rs"]
mod corpus_covers;
#[path = "../support/corpus_infinity.rs"]
mod corpus_infinity;
#[path = "../support/corpus_malformed.rs"]
mod corpus_malformed;
#[path = "../support/corpus_mcp.rs"]
mod corpus_mcp;
#[path = "../support/corpus_support.rs"]
mod corpus_support;

use corpus_cases::Cases;
use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_engine::lcp;
use mceip_model::file::read_problem;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/corpus")
}

/// A file of the corpus, with its texts spelt out in a folder.
struct Entry {
    name: String,
    file: Value,
    problem: String,
    certificate: String,
}

impl Entry {
    fn verdict(&self) -> &str {
        self.file["verdict"].as_str().unwrap()
    }

    fn code(&self) -> i32 {
        ["accepted", "rejected", "malformed", "undecided"]
            .iter()
            .position(|v| *v == self.verdict())
            .unwrap() as i32
    }
}

/// The certificate's text: as it stands, or with the mark replaced by copies of the unit.
fn certificate_text(file: &Value) -> String {
    let Some(text) = file["certificate_text"].as_str() else {
        return file["certificate"].to_string();
    };
    match file.get("repeat") {
        None => text.into(),
        Some(r) => {
            let count = usize::try_from(r["count"].as_u64().unwrap()).unwrap();
            text.replacen(
                r["mark"].as_str().unwrap(),
                &r["unit"].as_str().unwrap().repeat(count),
                1,
            )
        }
    }
}

fn entries(folder: &Path) -> Vec<Entry> {
    let mut list = Vec::new();
    for kind in ["accept", "reject", "malformed"] {
        for path in std::fs::read_dir(root().join(kind))
            .unwrap()
            .map(|e| e.unwrap().path())
        {
            let name = format!("{kind}-{}", path.file_stem().unwrap().to_str().unwrap());
            let file: Value =
                serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
            assert_eq!(file["format"], "mceip-corpus/1", "{name}");
            assert!(
                file["note"].as_str().is_some_and(|n| !n.is_empty()),
                "{name}: which bug does it stand for?"
            );
            let of_kind: &[&str] = match kind {
                "accept" => &["accepted", "undecided"],
                "reject" => &["rejected"],
                _ => &["malformed"],
            };
            assert!(
                of_kind.contains(&file["verdict"].as_str().unwrap()),
                "{name}"
            );
            let write = |suffix: &str, text: &str| {
                let path = folder.join(format!("{name}.{suffix}.json"));
                std::fs::write(&path, text).unwrap();
                path.display().to_string()
            };
            let (problem, certificate) = (
                write("problem", &file["problem"].to_string()),
                write("certificate", &certificate_text(&file)),
            );
            list.push(Entry {
                name,
                file,
                problem,
                certificate,
            });
        }
    }
    list.sort_by(|a, b| a.name.cmp(&b.name));
    list
}

/// Our checker in this process: the verdict, and for a rejection the obligation's name.
fn judge(e: &Entry) -> (i32, String) {
    if e.file["problem"]["format"] == lcp::MCP_FORMAT {
        return judge_plain(e);
    }
    let problem = read_problem(
        &std::fs::read_to_string(&e.problem).unwrap(),
        Path::new("/"),
    )
    .unwrap();
    let Ok(certificate) = Certificate::from_json(&std::fs::read_to_string(&e.certificate).unwrap())
    else {
        return (2, String::new());
    };
    match check(&problem, &certificate) {
        Ok(accepted) => (
            if accepted.cover.is_some_and(|c| !c.open.is_empty()) {
                3
            } else {
                0
            },
            String::new(),
        ),
        Err(rejected) => (1, rejected.reason.name()),
    }
}

/// The same for a plain LCP or MCP.
fn judge_plain(e: &Entry) -> (i32, String) {
    let problem = lcp::read_mcp(&std::fs::read_to_string(&e.problem).unwrap()).unwrap();
    let Ok(certificate) = lcp::read_solution(&std::fs::read_to_string(&e.certificate).unwrap())
    else {
        return (2, String::new());
    };
    match lcp::judge(&problem, &certificate) {
        Ok(_) => (0, String::new()),
        Err(rejected) => (1, rejected.name()),
    }
}

#[test]
fn our_checker_gives_every_verdict_and_reason() {
    let folder = tempfile::tempdir().unwrap();
    let list = entries(folder.path());
    let mut wrong = Vec::new();
    let mut seen = [0; 4];
    for e in &list {
        let start = Instant::now();
        let got = judge(e);
        let expected = (
            e.code(),
            e.file["reason"].as_str().unwrap_or_default().to_string(),
        );
        if got != expected {
            wrong.push(format!("{}: expected {expected:?}, got {got:?}", e.name));
        }
        assert!(
            start.elapsed() < Duration::from_secs(10),
            "{}: {:?}",
            e.name,
            start.elapsed()
        );
        seen[usize::try_from(e.code()).unwrap()] += 1;
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    println!("accepted, rejected, malformed, undecided: {seen:?}");
    assert!(
        seen[1] >= seen[0] + seen[3] && seen[0] >= 25 && seen[1] >= 90 && seen[2] >= 45,
        "{seen:?}"
    );
}

/// Reasons that no file reaches: a claim and a cover that contradict each other are not both true,
/// and a checker that accepts nothing false refuses the false one by its own obligations.
/// `crates/check/src/lib.rs` tests it on made-up covers.
const UNREACHABLE: [&str; 1] = ["NotInCover"];

/// Each obligation of the checker is the reason of some file.
#[test]
fn every_obligation_has_a_forgery() {
    let folder = tempfile::tempdir().unwrap();
    let reasons: std::collections::BTreeSet<String> = entries(folder.path())
        .iter()
        .filter_map(|e| e.file["reason"].as_str())
        .map(String::from)
        .collect();
    let variants = |file: &str, prefix: &str| {
        let text =
            std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
        let body = text
            .split_once(&format!("pub enum {prefix} {{"))
            .unwrap()
            .1
            .split_once("\n}")
            .unwrap()
            .0
            .to_string();
        let name = |l: &str| {
            l.strip_prefix("    ")
                .filter(|l| l.starts_with(char::is_uppercase))
                .map(|l| l.chars().take_while(char::is_ascii_alphanumeric).collect())
        };
        body.lines().filter_map(name).collect::<Vec<String>>()
    };
    let mut missing: Vec<String> = variants("crates/check/src/reason.rs", "Reason")
        .into_iter()
        .filter(|v| v != "Cover" && !reasons.contains(v))
        .collect();
    missing.retain(|v| !UNREACHABLE.contains(&v.as_str()));
    missing.extend(
        variants("crates/check/src/cover/fault.rs", "CoverFault")
            .into_iter()
            .map(|v| format!("Cover.{v}"))
            .filter(|v| !reasons.contains(v)),
    );
    let plain = ["McpRejected", "Violated"].map(|name| {
        variants(
            &format!(
                "crates/engine/src/lcp/{}.rs",
                if name == "Violated" {
                    "check"
                } else {
                    "verdict"
                }
            ),
            name,
        )
    });
    let of_plain: std::collections::BTreeSet<String> = entries(folder.path())
        .iter()
        .filter(|e| e.file["problem"]["format"] == lcp::MCP_FORMAT)
        .filter_map(|e| e.file["reason"].as_str())
        .map(String::from)
        .collect();
    missing.extend(
        plain
            .concat()
            .into_iter()
            .filter(|v| v != "Solution" && !of_plain.contains(v))
            .map(|v| format!("plain {v}")),
    );
    assert!(missing.is_empty(), "no forgery for {missing:?}");
}

/// From outside: exit codes, one line on stderr for what is malformed, 512 MiB of addresses and ten
/// seconds of processor time at most. (The program that is released takes less than half of the
/// time of this unoptimised one.)
#[test]
fn the_program_stays_within_bounds() {
    let folder = tempfile::tempdir().unwrap();
    let is_heavy = |e: &Entry| e.file.get("repeat").is_some() || e.name.contains("hostile");
    for e in entries(folder.path())
        .iter()
        .filter(|e| e.code() == 2 || is_heavy(e))
    {
        let start = Instant::now();
        let mut run = Command::new("sh");
        run.args([
            "-c",
            "ulimit -v 524288; ulimit -t 10; exec \"$0\" check \"$1\" \"$2\"",
            env!("CARGO_BIN_EXE_mceip"),
            &e.problem,
            &e.certificate,
        ]);
        let o = run.output().unwrap();
        let err = String::from_utf8_lossy(&o.stderr);
        assert_eq!(o.status.code(), Some(e.code()), "{}: {err}", e.name);
        assert!(
            start.elapsed() < Duration::from_secs(30),
            "{}: {:?}",
            e.name,
            start.elapsed()
        );
        if e.code() == 2 {
            assert!(
                o.stdout.is_empty() && err.lines().count() == 1 && err.len() < 1000,
                "{}: {err}",
                e.name
            );
        }
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
fn the_second_checker_gives_every_verdict() {
    if Command::new("python3").arg("--version").output().is_err() {
        eprintln!("python3 is not installed: spec/checker.py was not run over the corpus");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let list = entries(folder.path());
    let mut run = Command::new("python3");
    run.env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", RUN_ALL])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec"));
    run.args(list.iter().flat_map(|e| [&e.problem, &e.certificate]));
    let o = run.output().unwrap();
    let codes: Vec<i32> = String::from_utf8_lossy(&o.stdout)
        .lines()
        .map(|l| l.parse().unwrap())
        .collect();
    assert_eq!(
        codes.len(),
        list.len(),
        "{}",
        String::from_utf8_lossy(&o.stderr)
    );
    let wrong: Vec<String> = list
        .iter()
        .zip(codes)
        .filter(|(e, c)| e.code() != *c)
        .map(|(e, c)| format!("{}: expected {}, got exit {c}", e.name, e.verdict()))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "writes spec/corpus"]
fn write_the_corpus() {
    let mut cases = Cases::default();
    corpus_beside::beside(&mut cases);
    corpus_by_leaf::supports(&mut cases);
    corpus_claims::exact_claims(&mut cases);
    corpus_claims::enclosed_claims(&mut cases);
    corpus_claims::lifted_claims(&mut cases);
    corpus_covers::covers(&mut cases);
    corpus_covers::without_left_coefficients(&mut cases);
    corpus_covers::absence(&mut cases);
    corpus_support::supports(&mut cases);
    corpus_infinity::infinity(&mut cases);
    corpus_mcp::plain(&mut cases);
    corpus_malformed::malformed(&mut cases);
    corpus_malformed::spelling(&mut cases);
    corpus_malformed::hostile(&mut cases);
    for case in cases.0 {
        let folder = root().join(case.folder);
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(format!("{}.json", case.name));
        // What is released stays: only what is missing is written.
        if !path.exists() {
            std::fs::write(
                path,
                format!("{}\n", serde_json::to_string(&case.file).unwrap()),
            )
            .unwrap();
        }
    }
}
