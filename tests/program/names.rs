//! Names that act on a terminal, errors without end, and keys that stand twice.
#![cfg(feature = "cli")]

use crate::common::{edge, example, exits_with_json, refused, run, run_words};
use crate::program::Folder;
use serde_json::Value;

/// No character of the text acts on a terminal.
#[track_caller]
fn assert_harmless(text: &str) {
    let acts = |c: char| (c.is_control() && c != '\n' && c != '\t') || c == '\u{202e}';
    assert!(!text.contains(acts), "{text:?}");
}

/// ESC and BEL of a name reached the terminal.
#[test]
fn a_name_does_not_act_on_the_terminal() {
    let problem = edge("escapes-in-names.json");
    for command in [
        "analyze",
        "simulate",
        "enumerate",
        "complete",
        "solve",
        "reduce",
    ] {
        let run = run(&format!("{command} {problem}"));
        assert_ne!(run.code, Some(2), "{run:?}");
        assert_harmless(&run.stdout);
        assert_harmless(&run.stderr);
    }
    let analysis = run(&format!("analyze {problem}"));
    assert!(
        analysis.stdout.contains("evil\\u001b[31m\\u0007"),
        "{analysis:?}"
    );

    // JSON has the name as it is.
    let name = |report: &Value| report["name"].as_str().unwrap().to_owned();
    let text = std::fs::read_to_string(&problem).unwrap();
    let expected = name(&serde_json::from_str(&text).unwrap());
    assert!(expected.contains('\u{1b}'));
    let report = exits_with_json(0, &format!("analyze {problem} --json"));
    assert_eq!(name(&report), expected);

    refused(
        "complete no\u{1b}[31m\u{7}.json",
        &["no\\u001b[31m\\u0007.json"],
    );
}

#[test]
fn an_error_is_one_line_of_bounded_length() {
    let long = format!("/nowhere/{}\nfile.json", "x".repeat(5000));
    for args in [["check", &long, &long], ["explain", &long, "--quiet"]] {
        let run = run_words(&args);
        assert_eq!(run.code, Some(2), "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
        assert!(run.stderr.chars().count() <= 301, "{}", run.stderr.len());
        assert!(run.stderr.starts_with("mceip: "), "{run:?}");
    }
}

/// Of a problem inside a replay the last of two equal keys was taken.
#[test]
fn a_key_that_stands_twice_is_refused() {
    refused(
        &format!("campaign --replay {}", edge("key-twice-replay.json")),
        &["key-twice-replay.json", "duplicate field `pencil`"],
    );

    let folder = Folder::new();
    let report = r#"{"format":"mceip-solutions/1","solutions":[{"value":2,"x":[2,1]}],
        "notes":{"by":"me","by":"you"}}"#;
    let report = folder.write("report.json", report);
    for command in ["check", "certify"] {
        let words = ["report.json", "duplicate field `by`", "line 2"];
        refused(&format!("{command} {} {report}", example("fold")), &words);
    }

    let state = folder.path("state.json");
    let planted = format!("campaign --count 1 --family planted --state {state}");
    assert_eq!(run(&planted).code, Some(0));
    let text = std::fs::read_to_string(&state).unwrap();
    let twice = text.replacen(
        "\"corners\": {",
        "\"corners\": {\"Empty\": 1, \"Empty\": 1,",
        1,
    );
    assert_ne!(text, twice);
    std::fs::write(&state, twice).unwrap();
    refused(&planted, &["state.json", "duplicate field `Empty`"]);
}
