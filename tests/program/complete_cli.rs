//! `mceip complete` and the merging of its shards from outside: threads, interrupts, resume,
//! refusals.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use mceip_model::{Body, Unknown};
use mceip_testkit::{known, mechanical_pencil};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

#[track_caller]
fn exits(code: i32, args: &[&str]) -> String {
    let o = mceip(args);
    assert_eq!(
        o.status.code(),
        Some(code),
        "{args:?}: {}",
        String::from_utf8_lossy(&o.stderr)
    );
    String::from_utf8(o.stdout).unwrap()
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

    fn pencil(&self, name: &str, problem: &mceip_model::Problem) -> String {
        let Body::Pencil(pencil) = problem.body() else {
            panic!("a pencil")
        };
        let dense = |m: &mceip_exact::Sparse| -> Vec<Vec<String>> {
            (0..m.rows())
                .map(|i| (0..m.cols()).map(|j| m.get(i, j).to_string()).collect())
                .collect()
        };
        let pencil =
            json!({ "a": dense(pencil.a()), "b": dense(pencil.b()), "free": pencil.free() });
        let file = json!({ "format": "mceip-problem/1", "unknown": problem.unknown().word(), "pencil": pencil });
        self.write(name, &file.to_string())
    }

    fn random(&self, n: usize) -> String {
        self.pencil(
            &format!("random-{n}.json"),
            &mechanical_pencil(n, Unknown::Mu, 3).unwrap(),
        )
    }

    /// Runs `complete --shard i/n` into a file and gives its path.
    fn shard(&self, file: &str, shard: &str) -> String {
        let out = self.path(&format!("shard-{}.json", shard.replace('/', "-")));
        let code = mceip(&["complete", file, "--shard", shard, "--certificate", &out])
            .status
            .code();
        assert_eq!(code, Some(3), "the pieces of other shards stay open");
        out
    }
}

/// Value and slip set of each solution of a `--json` report.
fn set(report: &str) -> Vec<(String, Value)> {
    let report: Value = serde_json::from_str(report).unwrap();
    let digits = |s: &Value| s["value"].as_str().unwrap().chars().take(14).collect();
    report["solutions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| (digits(s), s["slip"].clone()))
        .collect()
}

/// One writer of `mceip-solutions/1`: the search lists what the enumerator lists, digit by digit,
/// with the enclosures it has proved.
#[test]
fn complete_and_enumerate_write_the_same_solutions() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(format!("spec/examples/{name}.json"))
            .display()
            .to_string();
        let list = |command: &str| -> Vec<Value> {
            let report: Value =
                serde_json::from_str(&exits(0, &[command, &file, "--json"])).unwrap();
            report["solutions"].as_array().unwrap().clone()
        };
        let (searched, enumerated) = (list("complete"), list("enumerate"));

        assert!(
            !enumerated.is_empty() && searched.len() == enumerated.len(),
            "{name}"
        );
        for (ours, theirs) in searched.iter().zip(&enumerated) {
            for field in ["value", "slip", "biactive", "x", "y", "v", "w"] {
                assert_eq!(ours[field], theirs[field], "{name}: {field}");
            }
            let number = |v: &Value| v.as_str().unwrap().parse::<f64>().unwrap();
            let [lo, hi] = [0, 1].map(|k| number(&ours["enclosure"][k]));
            assert!(
                lo <= number(&theirs["value"]) && number(&theirs["value"]) <= hi,
                "{name}"
            );
        }
    }
}

fn read(path: &str) -> String {
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn one_certificate_for_any_number_of_threads() {
    let bench = Bench::new();
    let free = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("spec/examples/two-particles-mu.json")
        .display()
        .to_string();
    for file in [
        bench.random(10),
        bench.pencil("graph.json", &known::complete_graph(6).unwrap().problem),
        free,
    ] {
        let certificates: Vec<String> = ["1", "2", "4"]
            .iter()
            .map(|threads| {
                let out = bench.path(&format!("threads-{threads}.json"));
                exits(
                    0,
                    &[
                        "complete",
                        &file,
                        "--threads",
                        threads,
                        "--certificate",
                        &out,
                    ],
                );
                read(&out)
            })
            .collect();
        assert!(
            certificates[0] == certificates[1] && certificates[0] == certificates[2],
            "{file}"
        );
        assert!(exits(0, &["check", &file, &bench.path("threads-1.json")]).contains("ACCEPTED"));
    }
}

#[test]
fn shards_merged_are_the_single_run() {
    let bench = Bench::new();
    for file in [
        bench.random(10),
        bench.pencil("graph.json", &known::complete_graph(5).unwrap().problem),
    ] {
        let single = bench.path("single.json");
        let whole = exits(0, &["complete", &file, "--json", "--certificate", &single]);
        let parts: Vec<String> = ["1/3", "2/3", "3/3"]
            .iter()
            .map(|s| bench.shard(&file, s))
            .collect();
        let merged = bench.path("merged.json");
        // In any order.
        let args = [
            "merge",
            "--problem",
            &file,
            &parts[2],
            &parts[0],
            &parts[1],
            "--certificate",
            &merged,
        ];
        assert!(exits(0, &args).contains("COMPLETE"));
        let report = exits(0, &[&args[..], &["--json"]].concat());
        assert!(!set(&whole).is_empty());
        assert_eq!(set(&report), set(&whole));
        assert_eq!(
            serde_json::from_str::<Value>(&read(&merged)).unwrap()["complete_set"],
            serde_json::from_str::<Value>(&read(&single)).unwrap()["complete_set"]
        );
        exits(0, &["check", &file, &merged]);
    }
}

#[test]
fn merge_refuses_what_is_no_whole_by_name() {
    let bench = Bench::new();
    let (file, other) = (bench.random(8), bench.random(7));
    let parts: Vec<String> = ["1/3", "2/3", "3/3"]
        .iter()
        .map(|s| bench.shard(&file, s))
        .collect();
    let merge = |parts: &[&str]| -> Vec<String> {
        ["merge", "--problem", &file]
            .iter()
            .chain(parts)
            .map(ToString::to_string)
            .collect()
    };
    let refuse = |args: Vec<String>, words: &[&str]| {
        refused(&args.iter().map(String::as_str).collect::<Vec<_>>(), words)
    };
    refuse(merge(&[&parts[0], &parts[2]]), &["piece 1 of 16"]);
    refuse(merge(&[&parts[0], &parts[0]]), &["piece 1 of 16"]);
    let alien = bench.path("alien.json");
    exits(0, &["complete", &other, "--certificate", &alien]);
    refuse(
        merge(&[&parts[0], &alien, &parts[2]]),
        &["alien.json", "expected problem"],
    );
    let narrow = bench.path("narrow.json");
    exits(
        0,
        &[
            "complete",
            &file,
            "--window",
            "0,1/10",
            "--certificate",
            &narrow,
        ],
    );
    refuse(
        merge(&[&parts[0], &parts[1], &parts[2], &narrow]),
        &["narrow.json", "window", "1/10"],
    );
    refused(&["merge", &parts[0], &parts[1], &parts[2]], &["--problem"]);
    let broken = bench.write("broken.json", &read(&parts[1])[..200]);
    refuse(merge(&[&parts[0], &broken, &parts[2]]), &["broken.json"]);
    // A part whose proof does not hold is named as well.
    let forged = read(&parts[1]).replacen("\"positive_definite\"", "\"negative_definite\"", 1);
    let (is_changed, forged) = (
        forged != read(&parts[1]),
        bench.write("forged.json", &forged),
    );
    if is_changed {
        refuse(
            merge(&[&parts[0], &forged, &parts[2]]),
            &["forged.json", "definite"],
        );
    }
    let missing = bench.path("missing.json");
    refuse(merge(&[&parts[0], &missing]), &["missing.json"]);
    // Another kind of file.
    refuse(merge(&[&parts[0], &file]), &["random-8.json", "format"]);
    // A certificate is never written over an input.
    refuse(
        merge(&[&parts[0], &parts[1], &parts[2], "--certificate", &parts[0]]),
        &["shard-1-3.json"],
    );
}

#[test]
fn bad_input_is_one_line_and_exit_2() {
    let bench = Bench::new();
    let (file, other) = (bench.random(6), bench.random(5));
    for shard in ["0/3", "4/3", "1", "a/b", "1/0", "-1/3"] {
        refused(
            &["complete", &file, &format!("--shard={shard}")],
            &["--shard", "1 <= i <= n"],
        );
    }
    for window in ["2,1", "-1,2", "x,y", "3"] {
        refused(
            &["complete", &file, &format!("--window={window}")],
            &["--window"],
        );
    }
    refused(&["complete", &file, "--threads", "0"], &["--threads"]);
    let certificate = bench.path("certificate.json");
    exits(0, &["complete", &file, "--certificate", &certificate]);
    refused(
        &["complete", &other, "--resume", &certificate],
        &["expected problem"],
    );
    refused(
        &[
            "complete",
            &file,
            "--window",
            "0,3",
            "--resume",
            &certificate,
        ],
        &["window", "[0, 3]"],
    );
    let text = read(&certificate);
    let cut = bench.write("cut.json", &text[..text.len() / 2]);
    refused(&["complete", &file, "--resume", &cut], &["cut.json"]);
    let wrong = bench.write(
        "wrong.json",
        &text.replacen("\"tree\":[", "\"tree\":[\"open\",", 1),
    );
    refused(
        &["complete", &file, "--resume", &wrong],
        &["rejects", "piece 0"],
    );
    let none = bench.write(
        "none.json",
        &text.replacen("mceip-certificate/1", "mceip-certificate/9", 1),
    );
    refused(
        &["complete", &file, "--resume", &none],
        &["none.json", "mceip-certificate/1"],
    );
    refused(
        &["complete", &bench.path("nothing.json")],
        &["nothing.json"],
    );
    refused(
        &["complete", &file, "--certificate", &file],
        &["--certificate"],
    );
    refused(
        &[
            "complete",
            &file,
            "--certificate",
            "/nonexistent/folder/out.json",
        ],
        &["/nonexistent"],
    );
}

/// SIGINT in the middle: what has been proved is kept, checked, and gone on with to the same set.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_certificate_to_go_on_with() {
    let bench = Bench::new();
    let file = bench.pencil("graph.json", &known::complete_graph(9).unwrap().problem);
    let part = bench.path("part.json");
    let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(["complete", &file, "--threads", "1", "--certificate", &part])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(150));
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    let code = child.wait().unwrap().code();
    // A machine may be quick enough to finish within that time: then it says so.
    assert!(code == Some(130) || code == Some(0), "{code:?}");
    // Accepted as what it is: done, or (3) undecided.
    let checked = mceip(&["check", &file, &part]);
    assert!(
        String::from_utf8_lossy(&checked.stdout).contains("ACCEPTED"),
        "{checked:?}"
    );
    assert!(matches!(checked.status.code(), Some(0 | 3)), "{checked:?}");
    let resumed = exits(0, &["complete", &file, "--resume", &part, "--json"]);
    assert_eq!(set(&resumed).len(), 511);
    assert_eq!(
        set(&resumed),
        set(&exits(0, &["complete", &file, "--json"]))
    );
}

/// A shard is the checkpoint of the others: what it left open is searched, what it closed stays.
#[test]
fn a_shard_is_resumed_to_the_whole() {
    let bench = Bench::new();
    let file = bench.random(9);
    let part = bench.shard(&file, "2/3");
    let out = bench.path("whole.json");
    exits(
        0,
        &["complete", &file, "--resume", &part, "--certificate", &out],
    );
    let single = bench.path("single.json");
    exits(0, &["complete", &file, "--certificate", &single]);
    assert_eq!(read(&out), read(&single));
}

/// Certificates that the checker accepts and a search cannot use as they are: an anchor without a
/// condensation, anchors without coefficients, every variable free. Going on with them ends in a
/// verdict or in one line.
#[test]
fn odd_certificates_are_gone_on_with_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    for entry in std::fs::read_dir(format!("{}/tests/resume", env!("CARGO_MANIFEST_DIR"))).unwrap()
    {
        let path = entry.unwrap().path();
        let case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();

        let [problem, certificate] = ["problem", "certificate"].map(|part| {
            let file = folder.path().join(format!("{part}.json"));
            std::fs::write(&file, case[part].to_string()).unwrap();
            file.display().to_string()
        });
        let run = Command::new(env!("CARGO_BIN_EXE_mceip"))
            .args(["complete", &problem, "--resume", &certificate])
            .output()
            .unwrap();

        let code = run.status.code();
        let message = String::from_utf8_lossy(&run.stderr);
        assert!(
            matches!(code, Some(0 | 2 | 3)),
            "{}: {code:?}: {message}",
            path.display()
        );
        count += 1;
    }
    assert!(count >= 5, "{count}");
}
