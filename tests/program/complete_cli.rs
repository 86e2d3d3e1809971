//! `mceip complete` and the merging of its shards from outside: threads, interrupts, resume.
//!
//! The truth is the enumerator, the checker, and the run by one thread without shards: every other
//! way to the end must give the same certificate or the same set. What is refused stands in
//! `tests/transcripts/complete.md`.
#![cfg(feature = "cli")]

use crate::common::{
    decimal, example, exits, exits_with_json, problem_text, read, repository, run, started,
};
#[cfg(unix)]
use crate::interrupt::interrupt;
use crate::program::Folder;
use mceip_model::Unknown;
use mceip_testkit::{known, mechanical_pencil};
use serde_json::Value;
use std::time::Duration;

fn random(folder: &Folder, n: usize) -> String {
    let problem = mechanical_pencil(n, Unknown::Mu, 3).unwrap();
    folder.write("random.json", &problem_text(&problem))
}

/// The complete graph: each nonempty set of vertices is the support of a solution.
fn graph(folder: &Folder, vertices: usize) -> String {
    let problem = known::complete_graph(vertices).unwrap().problem;
    folder.write("graph.json", &problem_text(&problem))
}

/// Runs `complete --shard i/n` into a file and gives its path.
fn shard(folder: &Folder, problem: &str, shard: &str) -> String {
    let out = folder.path(&format!("shard-{}.json", shard.replace('/', "-")));
    let ended = run(&format!(
        "complete {problem} --shard {shard} --certificate {out}"
    ));
    assert_eq!(
        ended.code,
        Some(3),
        "the pieces of other shards stay open: {ended:?}"
    );

    out
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

/// One writer of `mceip-solutions/1`: the search lists what the enumerator lists, digit by digit,
/// with the enclosures it has proved.
#[test]
fn complete_and_enumerate_write_the_same_solutions() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let file = example(name);
        let searched = exits_with_json(0, &format!("complete {file} --json"));
        let searched = searched["solutions"].as_array().unwrap();
        let enumerated = exits_with_json(0, &format!("enumerate {file} --json"));
        let enumerated = enumerated["solutions"].as_array().unwrap();

        assert!(!enumerated.is_empty(), "{name}");
        assert_eq!(searched.len(), enumerated.len(), "{name}");

        for (ours, theirs) in searched.iter().zip(enumerated) {
            for field in ["value", "slip", "biactive", "x", "y", "v", "w"] {
                assert_eq!(ours[field], theirs[field], "{name}: {field}");
            }

            let lower = decimal(&ours["enclosure"][0]);
            let upper = decimal(&ours["enclosure"][1]);
            let value = decimal(&theirs["value"]);

            assert!(lower <= value && value <= upper, "{name}");
        }
    }
}

#[test]
fn one_certificate_for_any_number_of_threads() {
    let folder = Folder::new();
    let with_free_variables = example("two-particles-mu");

    for problem in [random(&folder, 10), graph(&folder, 6), with_free_variables] {
        let certificates = ["1", "2", "4"].map(|threads| {
            let out = folder.path(&format!("threads-{threads}.json"));
            exits(
                0,
                &format!("complete {problem} --threads {threads} --certificate {out}"),
            );

            read(&out)
        });

        assert!(certificates[0] == certificates[1], "{problem}");
        assert!(certificates[0] == certificates[2], "{problem}");

        let checked = exits(
            0,
            &format!("check {problem} {}", folder.path("threads-1.json")),
        );
        assert!(checked.contains("ACCEPTED"), "{checked}");
    }
}

#[test]
fn shards_merged_are_the_single_run() {
    let folder = Folder::new();

    for problem in [random(&folder, 10), graph(&folder, 5)] {
        let single = folder.path("single.json");
        let whole = exits_with_json(
            0,
            &format!("complete {problem} --json --certificate {single}"),
        );
        let [first, second, third] =
            ["1/3", "2/3", "3/3"].map(|part| shard(&folder, &problem, part));
        let merged = folder.path("merged.json");

        // In any order.
        let parts = format!("{third} {first} {second}");
        let merge = format!("merge --problem {problem} {parts} --certificate {merged}");

        assert!(exits(0, &merge).contains("COMPLETE"));

        let report = exits_with_json(0, &format!("{merge} --json"));

        let solutions = solutions_of(&whole);
        assert!(!solutions.is_empty());
        assert_eq!(solutions_of(&report), solutions);

        let merged_certificate: Value = serde_json::from_str(&read(&merged)).unwrap();
        let single_certificate: Value = serde_json::from_str(&read(&single)).unwrap();
        assert_eq!(
            merged_certificate["complete_set"],
            single_certificate["complete_set"]
        );
        exits(0, &format!("check {problem} {merged}"));
    }
}

/// SIGINT in the middle: what has been proved is kept, checked, and gone on with to the same set.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_certificate_to_go_on_with() {
    let folder = Folder::new();
    let problem = graph(&folder, 9);
    let part = folder.path("part.json");

    let search = started(&format!(
        "complete {problem} --threads 1 --certificate {part}"
    ));
    interrupt(&search, Duration::from_millis(100));
    let code = search.wait_with_output().unwrap().status.code();

    // A machine may be quick enough to finish within that time: then it says so.
    assert!(code == Some(130) || code == Some(0), "{code:?}");

    // Accepted as what it is: done, or (3) undecided.
    let checked = run(&format!("check {problem} {part}"));
    assert!(checked.stdout.contains("ACCEPTED"), "{checked:?}");
    assert!(matches!(checked.code, Some(0 | 3)), "{checked:?}");

    let resumed = exits_with_json(0, &format!("complete {problem} --resume {part} --json"));
    let at_once = exits_with_json(0, &format!("complete {problem} --json"));
    let solutions = solutions_of(&resumed);

    assert_eq!(solutions.len(), 511);
    assert_eq!(solutions, solutions_of(&at_once));
}

/// A shard is the checkpoint of the others: what it left open is searched, what it closed stays.
#[test]
fn a_shard_is_resumed_to_the_whole() {
    let folder = Folder::new();
    let problem = random(&folder, 9);
    let part = shard(&folder, &problem, "2/3");
    let whole = folder.path("whole.json");
    let single = folder.path("single.json");

    exits(
        0,
        &format!("complete {problem} --resume {part} --certificate {whole}"),
    );
    exits(0, &format!("complete {problem} --certificate {single}"));

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

        let ended = run(&format!("complete {problem} --resume {certificate}"));

        assert!(matches!(ended.code, Some(0 | 2 | 3)), "{path}: {ended:?}");
        count += 1;
    }

    assert!(count >= 5, "{count}");
}
