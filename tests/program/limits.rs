//! Reports that take long to judge, and states that say something else than what was done.
#![cfg(feature = "cli")]

use crate::common::{edge, example, exits, exits_with_json, refused, run};
use crate::program::Folder;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Fifty solutions with numbers of 99,000 digits took 18 seconds to be read.
fn report_with_long_numbers() -> String {
    let sevens = format!("1/{}", "7".repeat(99_000));
    let threes = format!("0.{}", "3".repeat(99_000));
    let solution = json!({ "value": 2, "x": [sevens, threes] });
    let solutions = vec![solution; 50];
    json!({ "format": "mceip-solutions/1", "solutions": solutions }).to_string()
}

#[test]
fn a_report_of_endless_digits_is_refused_at_once() {
    let folder = Folder::new();
    let report = folder.write("report.json", &report_with_long_numbers());
    let begun = Instant::now();
    for command in ["check", "certify"] {
        refused(
            &format!("{command} {} {report}", example("fold")),
            &["report.json", "fewer digits"],
        );
    }
    assert!(begun.elapsed() < Duration::from_secs(5));

    // Numbers of a thousand digits are read as they are.
    let two = format!("2.{}", "0".repeat(1000));
    let solutions = json!([{ "value": two, "x": [two, 1] }]);
    let report = json!({ "format": "mceip-solutions/1", "solutions": solutions });
    let report = folder.write("long.json", &report.to_string());
    exits(0, &format!("check {} {report}", example("fold")));
}

/// The judging of such reports had no end: it is bounded like the program.
#[cfg(unix)]
#[test]
fn a_hostile_report_leaves_its_case_undecided() {
    let begun = Instant::now();
    let hostile = edge("hostile.py");
    let command = format!("conform --case fold-00 --time-limit 5 --json -- python3 {hostile}");
    let summary = exits_with_json(1, &command);
    assert_eq!(summary["labels"]["undecided"], 1);
    let why = summary["failures"][0]["detail"].as_str().unwrap();
    assert!(why.contains("fewer digits"), "{why}");
    assert!(begun.elapsed() < Duration::from_secs(20));
}

/// An edited state made "10^9 instances CLEAN".
#[test]
fn an_edited_state_of_a_campaign_is_refused() {
    for (state, words) in [
        (
            "state-inst.json",
            ["instances of table1", "expected 1", "1000000000"],
        ),
        (
            "state-done.json",
            ["instances done", "expected at most", "1000000000000000"],
        ),
    ] {
        let command = format!("campaign --count 1 --state {}", edge(state));
        refused(&command, &[&[state][..], &words].concat());
    }

    let folder = Folder::new();
    let state = folder.path("state.json");
    let planted = format!("campaign --family planted --state {state} --count");
    exits(0, &format!("{planted} 2"));
    let text = std::fs::read_to_string(&state).unwrap();
    let whole: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(whole["sha256"].as_str().unwrap().len(), 64);

    // Whatever is edited, one digit of a count included.
    for pointer in ["/done", "/seed", "/tallies/0/pivots", "/tallies/0/accepted"] {
        let mut edited = whole.clone();
        let count = edited.pointer_mut(pointer).unwrap();
        *count = json!(count.as_u64().unwrap() + 1);
        std::fs::write(&state, edited.to_string()).unwrap();
        refused(&format!("{planted} 2"), &["state.json", "sha256"]);
    }

    // Another layout of the same content is the same state.
    std::fs::write(&state, whole.to_string()).unwrap();
    let again = run(&format!("{planted} 3"));
    assert_eq!((again.code, again.stderr.as_str()), (Some(0), ""));
    assert!(again.stdout.contains("3 instances"), "{}", again.stdout);

    // A state without a digest, as older versions wrote it.
    let mut old = whole;
    old.as_object_mut().unwrap().remove("sha256");
    std::fs::write(&state, old.to_string()).unwrap();
    let again = run(&format!("{planted} 3"));
    assert_eq!(again.code, Some(0), "{again:?}");
    assert!(again.stderr.contains("not bound"), "{again:?}");
}
