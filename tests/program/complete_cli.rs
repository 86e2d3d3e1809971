//! `mceip complete` and the merging of its shards from outside: threads, interrupts, resume,
//! refusals.
//!
//! The truth is the enumerator, the checker, and the run by one thread without shards: every other
//! way to the end must give the same certificate or the same set. What is no whole must be refused
//! by the name of the file or the piece.
#![cfg(feature = "cli")]

use crate::common::{example, exits, exits_with_json, problem_text, read, repository, run};
#[cfg(unix)]
use crate::interrupt::interrupt;
use crate::program::{Folder, refused};
use mceip_model::{Problem, Unknown};
use mceip_testkit::{known, mechanical_pencil};
use serde_json::Value;
use std::process::{Command, Stdio};
use std::time::Duration;

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

    fn problem(&self, name: &str, problem: &Problem) -> String {
        self.write(name, &problem_text(problem))
    }

    fn random(&self, n: usize) -> String {
        let problem = mechanical_pencil(n, Unknown::Mu, 3).unwrap();
        self.problem(&format!("random-{n}.json"), &problem)
    }

    /// The complete graph: each nonempty set of vertices is the support of a solution.
    fn graph(&self, vertices: usize) -> String {
        let problem = known::complete_graph(vertices).unwrap().problem;
        self.problem("graph.json", &problem)
    }

    /// Runs `complete --shard i/n` into a file and gives its path.
    fn shard(&self, problem: &str, shard: &str) -> String {
        let out = self.path(&format!("shard-{}.json", shard.replace('/', "-")));
        let ended = run(&["complete", problem, "--shard", shard, "--certificate", &out]);
        assert_eq!(
            ended.code,
            Some(3),
            "the pieces of other shards stay open: {ended:?}"
        );

        out
    }

    fn three_shards(&self, problem: &str) -> [String; 3] {
        ["1/3", "2/3", "3/3"].map(|shard| self.shard(problem, shard))
    }
}

/// A solution of a `--json` report, to 14 digits.
#[derive(Debug, PartialEq)]
struct Listed {
    value: String,
    slip: Value,
}

fn solutions_of(report: &Value) -> Vec<Listed> {
    let mut list = Vec::new();
    for solution in report["solutions"].as_array().unwrap() {
        let value = solution["value"].as_str().unwrap();
        list.push(Listed {
            value: value.chars().take(14).collect(),
            slip: solution["slip"].clone(),
        });
    }
    list
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// One writer of `mceip-solutions/1`: the search lists what the enumerator lists, digit by digit,
/// with the enclosures it has proved.
#[test]
fn complete_and_enumerate_write_the_same_solutions() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let file = example(name);
        let searched = exits_with_json(0, &["complete", &file, "--json"]);
        let searched = searched["solutions"].as_array().unwrap();
        let enumerated = exits_with_json(0, &["enumerate", &file, "--json"]);
        let enumerated = enumerated["solutions"].as_array().unwrap();

        assert!(!enumerated.is_empty(), "{name}");
        assert_eq!(searched.len(), enumerated.len(), "{name}");

        for (ours, theirs) in searched.iter().zip(enumerated) {
            for field in ["value", "slip", "biactive", "x", "y", "v", "w"] {
                assert_eq!(ours[field], theirs[field], "{name}: {field}");
            }

            let lower = number(&ours["enclosure"][0]);
            let upper = number(&ours["enclosure"][1]);
            let value = number(&theirs["value"]);

            assert!(lower <= value && value <= upper, "{name}");
        }
    }
}

#[test]
fn one_certificate_for_any_number_of_threads() {
    let bench = Bench::new();
    let with_free_variables = example("two-particles-mu");

    for problem in [bench.random(10), bench.graph(6), with_free_variables] {
        let certificates = ["1", "2", "4"].map(|threads| {
            let out = bench.path(&format!("threads-{threads}.json"));
            exits(
                0,
                &[
                    "complete",
                    &problem,
                    "--threads",
                    threads,
                    "--certificate",
                    &out,
                ],
            );

            read(&out)
        });

        assert!(certificates[0] == certificates[1], "{problem}");
        assert!(certificates[0] == certificates[2], "{problem}");

        let checked = exits(0, &["check", &problem, &bench.path("threads-1.json")]);
        assert!(checked.contains("ACCEPTED"), "{checked}");
    }
}

#[test]
fn shards_merged_are_the_single_run() {
    let bench = Bench::new();

    for problem in [bench.random(10), bench.graph(5)] {
        let single = bench.path("single.json");
        let whole = exits_with_json(
            0,
            &["complete", &problem, "--json", "--certificate", &single],
        );
        let [first, second, third] = bench.three_shards(&problem);
        let merged = bench.path("merged.json");

        // In any order.
        let args = [
            "merge",
            "--problem",
            &problem,
            &third,
            &first,
            &second,
            "--certificate",
            &merged,
        ];

        assert!(exits(0, &args).contains("COMPLETE"));

        let report = exits_with_json(0, &[&args[..], &["--json"]].concat());

        let solutions = solutions_of(&whole);
        assert!(!solutions.is_empty());
        assert_eq!(solutions_of(&report), solutions);

        let merged_certificate: Value = serde_json::from_str(&read(&merged)).unwrap();
        let single_certificate: Value = serde_json::from_str(&read(&single)).unwrap();
        assert_eq!(
            merged_certificate["complete_set"],
            single_certificate["complete_set"]
        );
        exits(0, &["check", &problem, &merged]);
    }
}

/// `merge` refuses these parts and options of a problem in one line with these words.
#[track_caller]
fn merge_refuses(problem: &str, parts: &[&str], words: &[&str]) {
    let args = [&["merge", "--problem", problem][..], parts].concat();
    refused(&args, words);
}

#[test]
fn merge_refuses_what_is_no_whole_by_name() {
    let bench = Bench::new();
    let problem = bench.random(8);
    let shards = bench.three_shards(&problem);
    let [first, second, third] = shards.each_ref().map(String::as_str);

    // A piece that nobody searched.
    merge_refuses(&problem, &[first, third], &["piece 1 of 16"]);
    merge_refuses(&problem, &[first, first], &["piece 1 of 16"]);
    refused(&["merge", first, second, third], &["--problem"]);

    // Certificates of another problem and of another window.
    let other = bench.random(7);
    let alien = bench.path("alien.json");
    exits(0, &["complete", &other, "--certificate", &alien]);

    merge_refuses(
        &problem,
        &[first, &alien, third],
        &["alien.json", "expected problem"],
    );
    let narrow = bench.path("narrow.json");

    exits(
        0,
        &[
            "complete",
            &problem,
            "--window",
            "0,1/10",
            "--certificate",
            &narrow,
        ],
    );

    merge_refuses(
        &problem,
        &[first, second, third, &narrow],
        &["narrow.json", "window", "1/10"],
    );

    // A part that is cut off, and one whose proof does not hold.
    let text = read(second);
    let broken = bench.write("broken.json", &text[..200]);
    merge_refuses(&problem, &[first, &broken, third], &["broken.json"]);
    let changed = text.replacen("\"positive_definite\"", "\"negative_definite\"", 1);

    if changed != text {
        let forged = bench.write("forged.json", &changed);
        merge_refuses(
            &problem,
            &[first, &forged, third],
            &["forged.json", "definite"],
        );
    }

    // A file that is not there, and one of another kind.
    let missing = bench.path("missing.json");
    merge_refuses(&problem, &[first, &missing], &["missing.json"]);
    merge_refuses(&problem, &[first, &problem], &["random-8.json", "format"]);

    // A certificate is never written over an input.
    merge_refuses(
        &problem,
        &[first, second, third, "--certificate", first],
        &["shard-1-3.json"],
    );
}

#[test]
fn bad_input_is_one_line_and_exit_2() {
    let bench = Bench::new();
    let problem = bench.random(6);

    for shard in ["0/3", "4/3", "1", "a/b", "1/0", "-1/3"] {
        refused(
            &["complete", &problem, &format!("--shard={shard}")],
            &["--shard", "1 <= i <= n"],
        );
    }

    for window in ["2,1", "-1,2", "x,y", "3"] {
        refused(
            &["complete", &problem, &format!("--window={window}")],
            &["--window"],
        );
    }

    for threads in ["0", "1025", "1000000000"] {
        refused(
            &["complete", &problem, "--threads", threads],
            &["--threads", threads, "1024"],
        );
    }

    refused(
        &["complete", &bench.path("nothing.json")],
        &["nothing.json"],
    );
    refused(
        &["complete", &problem, "--certificate", &problem],
        &["--certificate"],
    );
    refused(
        &["complete", &problem, "--certificate", "Cargo.toml/out.json"],
        &["Cargo.toml/out.json"],
    );

    bad_files_to_resume_from_are_refused(&bench, &problem);
}

#[track_caller]
fn bad_files_to_resume_from_are_refused(bench: &Bench, problem: &str) {
    let certificate = bench.path("certificate.json");
    exits(0, &["complete", problem, "--certificate", &certificate]);

    let text = read(&certificate);

    let other = bench.random(5);
    refused(
        &["complete", &other, "--resume", &certificate],
        &["expected problem"],
    );
    refused(
        &[
            "complete",
            problem,
            "--window",
            "0,3",
            "--resume",
            &certificate,
        ],
        &["window", "[0, 3]"],
    );

    let cut = bench.write("cut.json", &text[..text.len() / 2]);
    refused(&["complete", problem, "--resume", &cut], &["cut.json"]);

    let with_two_roots = text.replacen("\"tree\":[", "\"tree\":[\"open\",", 1);
    let wrong = bench.write("wrong.json", &with_two_roots);
    refused(
        &["complete", problem, "--resume", &wrong],
        &["rejects", "piece 0"],
    );

    let of_another_format = text.replacen("mceip-certificate/1", "mceip-certificate/9", 1);
    let none = bench.write("none.json", &of_another_format);
    refused(
        &["complete", problem, "--resume", &none],
        &["none.json", "mceip-certificate/1"],
    );
}

/// SIGINT in the middle: what has been proved is kept, checked, and gone on with to the same set.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_certificate_to_go_on_with() {
    let bench = Bench::new();
    let problem = bench.graph(9);
    let part = bench.path("part.json");

    let mut child = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args([
            "complete",
            &problem,
            "--threads",
            "1",
            "--certificate",
            &part,
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    interrupt(&child, Duration::from_millis(100));
    let code = child.wait().unwrap().code();

    // A machine may be quick enough to finish within that time: then it says so.
    assert!(code == Some(130) || code == Some(0), "{code:?}");

    // Accepted as what it is: done, or (3) undecided.
    let checked = run(&["check", &problem, &part]);
    assert!(checked.stdout.contains("ACCEPTED"), "{checked:?}");
    assert!(matches!(checked.code, Some(0 | 3)), "{checked:?}");

    let resumed = exits_with_json(0, &["complete", &problem, "--resume", &part, "--json"]);
    let at_once = exits_with_json(0, &["complete", &problem, "--json"]);
    let solutions = solutions_of(&resumed);

    assert_eq!(solutions.len(), 511);
    assert_eq!(solutions, solutions_of(&at_once));
}

/// A shard is the checkpoint of the others: what it left open is searched, what it closed stays.
#[test]
fn a_shard_is_resumed_to_the_whole() {
    let bench = Bench::new();
    let problem = bench.random(9);
    let part = bench.shard(&problem, "2/3");
    let whole = bench.path("whole.json");
    let single = bench.path("single.json");

    exits(
        0,
        &[
            "complete",
            &problem,
            "--resume",
            &part,
            "--certificate",
            &whole,
        ],
    );
    exits(0, &["complete", &problem, "--certificate", &single]);

    assert_eq!(read(&whole), read(&single));
}

/// Certificates that the checker accepts and a search cannot use as they are: an anchor without a
/// condensation, anchors without coefficients, every variable free. Going on with them ends in a
/// verdict or in one line.
#[test]
fn odd_certificates_are_gone_on_with_or_refused() {
    let folder = Folder::new();
    let mut count = 0;

    for entry in std::fs::read_dir(repository("tests/resume")).unwrap() {
        let path = entry.unwrap().path().display().to_string();
        let case: Value = serde_json::from_str(&read(&path)).unwrap();
        let problem = folder.write("problem.json", &case["problem"].to_string());
        let certificate = folder.write("certificate.json", &case["certificate"].to_string());

        let ended = run(&["complete", &problem, "--resume", &certificate]);

        assert!(matches!(ended.code, Some(0 | 2 | 3)), "{path}: {ended:?}");
        count += 1;
    }

    assert!(count >= 5, "{count}");
}
