//! `mceip enumerate` and `merge` from outside: engines, limits, checkpoints, shards, refusals.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "support/program.rs"]
mod program;

use program::{Folder, mceip, refused};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use std::process::{Command, Output};

fn root(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path).display().to_string()
}

/// A folder with the problems of these tests.
struct Bench(Folder);

impl Bench {
    fn new() -> Bench {
        Bench(Folder::new())
    }

    fn path(&self, name: &str) -> String {
        self.0.path(name)
    }

    fn write(&self, name: &str, text: &str) -> String {
        self.0.write(name, text)
    }

    /// One-digit integer pencils of `peers.md`.
    fn digits(&self, n: usize, seed: u64) -> String {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut matrix = || (0..n).map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect()).collect::<Vec<Vec<i64>>>();
        let pencil = serde_json::json!({ "a": matrix(), "b": matrix(), "free": [] });
        self.problem(&format!("digits-{n}-{seed}.json"), pencil)
    }

    fn problem(&self, name: &str, pencil: serde_json::Value) -> String {
        self.write(name, &serde_json::json!({ "format": "mceip-problem/1", "unknown": "mu", "pencil": pencil }).to_string())
    }

    /// Runs `enumerate --shard i/n` into a file and gives its path.
    fn part(&self, file: &str, shard: &str, more: &[&str]) -> String {
        let out = self.path(&format!("part-{}-{}.json", shard.replace('/', "-"), more.join("").replace('/', "-")));
        let o = mceip(&[&["enumerate", file, "--shard", shard, "--out", &out], more].concat());
        assert_eq!((o.status.code(), o.stdout.len()), (Some(0), 0), "{o:?}");
        out
    }
}

#[test]
fn both_engines_list_the_same_and_name_themselves() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let file = root(&format!("spec/examples/{name}.json"));
        let json = |more: &[&str]| -> serde_json::Value {
            let o = mceip(&[&["enumerate", &file, "--json"], more].concat());
            assert_eq!(o.status.code(), Some(0));
            serde_json::from_slice(&o.stdout).unwrap()
        };
        let (plain, screened) = (json(&[]), json(&["--screened"]));
        let keep = |v: &serde_json::Value| -> Vec<serde_json::Value> {
            let fields = |s: &serde_json::Value| serde_json::json!([s["value"], s["slip"], s["biactive"], s["x"], s["y"], s["v"], s["w"]]);
            v["solutions"].as_array().unwrap().iter().map(fields).collect()
        };
        assert_eq!(keep(&plain), keep(&screened));
        assert!(!keep(&plain).is_empty() && plain["claim"] == "complete" && screened["claim"] == "complete");
        assert!(plain["evidence"].as_str().unwrap().contains("by the plain enumeration"));
        let evidence = screened["evidence"].as_str().unwrap();
        assert!(evidence.contains("by the screened enumeration") && evidence.contains("Farkas"), "{evidence}");
    }
}

#[test]
fn limits_and_options_are_refused_in_one_line() {
    let b = Bench::new();
    let file = root("spec/examples/fold.json");
    let identity = |n: usize| serde_json::json!({ "rows": n, "cols": n, "entries": (0..n).map(|i| (i, i, 1)).collect::<Vec<_>>() });
    let large = |n: usize| b.problem(&format!("large-{n}.json"), serde_json::json!({ "a": identity(n), "b": identity(n), "free": [] }));
    refused(&["enumerate", &large(17)], &["16 slip variables", "17"]);
    refused(&["enumerate", &large(25), "--screened"], &["24 slip variables", "25"]);
    refused(&["enumerate", &large(70), "--screened"], &["24 slip variables", "70"]);
    let free: Vec<usize> = (0..17).collect();
    let many_free = b.problem("free.json", serde_json::json!({ "a": identity(18), "b": identity(18), "free": free }));
    let digits = format!("1{}", "0".repeat(3000));
    let long = b.problem("long.json", serde_json::json!({ "a": [[digits, 1], [1, digits]], "b": [[1, 0], [0, 1]], "free": [] }));
    for engine in [&[][..], &["--screened"]] {
        refused(&[&["enumerate", &many_free], engine].concat(), &["16 free variables", "17"]);
        refused(&[&["enumerate", &long], engine].concat(), &["bits of a determinant's coefficients", "8192"]);
        for shard in ["0/3", "4/3", "1/0", "1", "-1/3", "a/b", "1/5", "1/99999999999999999999", "1/3/3"] {
            refused(&[&["enumerate", &file, "--shard", shard], engine].concat(), &["--shard", shard]);
        }
        refused(&[&["enumerate", &file, "--window", "3,2"], engine].concat(), &["--window"]);
        refused(&[&["enumerate", &file, "--window", "-1,2"], engine].concat(), &["--window"]);
        refused(&[&["enumerate", &file, "--checkpoint", "/nowhere/c.json"], engine].concat(), &["/nowhere/c.json"]);
    }
    refused(&["enumerate", &file, "--out", &b.path("x")], &["--shard"]);
    refused(&["enumerate", &file, "--checkpoint", &file], &["mceip-checkpoint/1"]);
    refused(&["merge"], &["PARTS"]);
}

/// What `merge` prints without its word on what it has not verified.
fn without_note(printed: &str) -> String {
    if let Ok(mut report) = serde_json::from_str::<serde_json::Value>(printed) {
        assert!(report.as_object_mut().unwrap().remove("not_verified").is_some());
        return format!("{report}\n");
    }
    let lines: Vec<&str> = printed.lines().collect();
    assert!(lines.last().unwrap().starts_with("NOT VERIFIED: that "), "{printed}");
    lines[..lines.len() - 1].iter().map(|line| format!("{line}\n")).collect()
}

/// But for its last word, which says that supports without a solution are not examined again.
#[test]
fn parts_merge_into_what_enumerate_prints_byte_for_byte() {
    let b = Bench::new();
    // Solutions, a wide kernel (A = -I beside), a singular support (zero row and column).
    let a = [[-1, 0, 0, 2, 0], [0, -1, 0, 1, 0], [0, 0, 0, 0, 0], [1, -3, 0, -2, 1], [0, 4, 0, 1, -5]];
    let unit = |i: usize| (0..5).map(|j| i64::from(i == j && i != 2)).collect::<Vec<_>>();
    let degenerate = b.problem("degenerate.json", serde_json::json!({ "a": a, "b": (0..5).map(unit).collect::<Vec<_>>(), "free": [] }));
    let digits = b.digits(8, 3);
    for (file, window) in [(&degenerate, "0,inf"), (&digits, "0,inf"), (&digits, "1/3,2")] {
        for engine in [&["--window", window][..], &["--window", window, "--screened"]] {
            let parts: Vec<String> = (1..=5).rev().map(|i| b.part(file, &format!("{i}/5"), engine)).collect();
            for json in [&[][..], &["--json"]] {
                let whole = mceip(&[&["enumerate", file], engine, json].concat());
                let merged = mceip(&[&["merge"], &parts.iter().map(String::as_str).collect::<Vec<_>>()[..], json].concat());
                let printed = String::from_utf8_lossy(&merged.stdout).into_owned();
                assert!(printed.contains("supports hold no solution is what the parts say"), "{printed}");
                assert_eq!(without_note(&printed), String::from_utf8_lossy(&whole.stdout));
                assert_eq!((merged.status.code(), merged.stderr.len()), (whole.status.code(), 0));
                assert!(whole.stdout.len() > 60);
            }
        }
    }
    // On stdout as well as in a file.
    let stdout = mceip(&["enumerate", &digits, "--shard", "2/5"]).stdout;
    assert_eq!(String::from_utf8(stdout).unwrap(), std::fs::read_to_string(b.part(&digits, "2/5", &[])).unwrap());
}

#[test]
fn incomplete_overlapping_and_mismatched_parts_are_refused_by_name() {
    let b = Bench::new();
    let (file, other) = (b.digits(6, 1), b.digits(6, 2));
    let p = |i: usize| b.part(&file, &format!("{i}/3"), &[]);
    let (p1, p2, p3) = (p(1), p(2), p(3));
    refused(&["merge", &p1, &p3], &["supports 21..42 of 64"]);
    refused(&["merge", &p2, &p3], &["supports 0..21"]);
    refused(&["merge", &p1, &p2], &["supports 42..64"]);
    refused(&["merge", &p1, &p2, &p3, &p2], &["part-2-3-.json", "both cover", "21..42"]);
    refused(&["merge", &p1, &b.part(&file, "2/2", &[]), &p2], &["part-2-3-.json and", "part-2-2-.json both cover supports 32..42"]);
    refused(&["merge", &p1, &b.part(&other, "2/3", &["--window", "0,inf"]), &p3], &["part-2-3", "problem_sha256"]);
    refused(&["merge", &p1, &b.part(&file, "2/3", &["--screened"]), &p3], &["screened", "engine: expected plain"]);
    refused(&["merge", &p1, &b.part(&file, "2/3", &["--window", "1,2"]), &p3], &["window: expected 0, infinity, got 1, 2"]);
    refused(&["merge", &file], &["mceip-part/1", "mceip-problem/1"]);
    refused(&["merge", &p1, &file], &["mceip-part/1"]);
    refused(&["merge", &b.path("nowhere")], &["nowhere"]);
    refused(&["merge", &b.write("empty", "")], &["empty"]);
    // A damaged part: any change is noticed, whatever it does.
    let text = std::fs::read_to_string(&p2).unwrap();
    for (from, to) in [
        ("\"done\":42", "\"done\":41"),
        ("\"supports\":64", "\"supports\":128"),
        ("[0,0,\"", "[0,0,\"1"),
        ("\"range\":[21", "\"range\":[20"),
    ] {
        assert!(text.contains(from), "{from}");
        refused(&["merge", &p1, &b.write("damaged", &text.replacen(from, to, 1)), &p3], &["damaged"]);
    }
    refused(&["merge", &b.write("colour", &text.replacen('{', "{\"colour\":1,", 1))], &["colour"]);
}

#[test]
fn a_finished_checkpoint_answers_at_once_and_binds_its_problem() {
    let b = Bench::new();
    let (file, other, c) = (b.digits(7, 1), b.digits(7, 2), b.path("c.json"));
    for engine in [&[][..], &["--screened"]] {
        std::fs::remove_file(&c).ok();
        let run = |file: &str, more: &[&str]| mceip(&[&["enumerate", file, "--checkpoint", &c], engine, more].concat());
        let first = run(&file, &[]);
        assert_eq!((first.status.code(), first.stderr.len()), (Some(0), 0));
        let saved = std::fs::read_to_string(&c).unwrap();
        let again = run(&file, &[]);
        assert_eq!((&again.stdout, again.status.code()), (&first.stdout, Some(0)));
        assert!(String::from_utf8_lossy(&again.stderr).contains("128 of 128 supports done"));
        if engine.is_empty() {
            refused(&["enumerate", &file, "--checkpoint", &c, "--screened"], &["c.json", "engine: expected screened, got plain"]);
        }
        refused(&[&["enumerate", &other, "--checkpoint", &c], engine].concat(), &["c.json", "problem_sha256"]);
        refused(&[&["enumerate", &file, "--checkpoint", &c, "--window", "0,1"], engine].concat(), &["c.json", "window"]);
        refused(&[&["enumerate", &file, "--checkpoint", &c, "--shard", "1/2"], engine].concat(), &["c.json", "range"]);
        assert_eq!(std::fs::read_to_string(&c).unwrap(), saved, "the old checkpoint is untouched");
    }
    let cut = std::fs::read_to_string(&c).unwrap();
    refused(&["enumerate", &file, "--screened", "--checkpoint", &b.write("cut", &cut[..cut.len() / 2])], &["cut"]);
}

/// SIGINT: exit 130, what was found is printed, and the next run goes on from there to the same answer.
#[cfg(unix)]
#[test]
fn an_interrupted_enumeration_resumes_to_the_same_answer() {
    let b = Bench::new();
    let c = b.path("c.json");
    let solutions = |o: &Output| serde_json::from_slice::<serde_json::Value>(&o.stdout).unwrap()["solutions"].as_array().unwrap().clone();
    let screened = |file: String| (mceip(&["enumerate", &file, "--screened", "--json"]), file);
    let (whole, file) = (1..).map(|seed| screened(b.digits(11, seed))).find(|(o, _)| !solutions(o).is_empty()).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"));
    child
        .args(["enumerate", &file, "--checkpoint", &c, "--json"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped());
    let child = child.spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let interrupted = child.wait_with_output().unwrap();
    assert_eq!(interrupted.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&interrupted.stdout).contains("interrupted after"));
    let record: serde_json::Value = serde_json::from_slice(&std::fs::read(&c).unwrap()).unwrap();
    let done = record["done"].as_u64().unwrap();
    assert!(done > 0 && done < 2048, "{done}");
    let resumed = mceip(&["enumerate", &file, "--checkpoint", &c, "--json"]);
    assert_eq!(resumed.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&resumed.stderr).contains(&format!("{done} of 2048 supports done")));
    let values = |o: &Output| solutions(o).iter().map(|s| (s["value"].clone(), s["slip"].clone(), s["x"].clone())).collect::<Vec<_>>();
    assert_eq!(values(&resumed), values(&whole));
}
