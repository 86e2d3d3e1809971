//! `mceip campaign` from outside: exit codes, summary, state file, replay.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};

#[test]
fn a_short_campaign_is_clean_and_the_same_on_any_number_of_threads() {
    let folder = Folder::new();
    let replays = folder.path("replays");
    let run = |threads: &str, more: &[&str]| {
        let base = [
            "campaign",
            "--count",
            "3",
            "--family",
            "table1",
            "degenerate",
            "--seed",
            "5",
            "--threads",
            threads,
            "--replays",
            &replays,
        ];
        let o = mceip(&[&base[..], more].concat());
        assert_eq!(
            o.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&o.stderr)
        );
        String::from_utf8(o.stdout).unwrap()
    };
    let text = run("1", &[]);
    assert!(
        text.contains("CLEAN: no disagreement in 6 instances (seed 5)")
            && text.contains("corners reached"),
        "{text}"
    );
    assert_eq!(text, run("2", &[]));
    assert!(!std::path::Path::new(&replays).exists());
    let json: serde_json::Value = serde_json::from_str(&run("2", &["--json"])).unwrap();
    assert_eq!(
        (&json["instances"], &json["families"][1]["name"]),
        (&6.into(), &"degenerate".into())
    );
}

#[test]
fn a_state_file_is_gone_on_from() {
    let folder = Folder::new();
    let state = folder.path("state.json");
    let run = |count: &str| {
        let o = mceip(&[
            "campaign", "--count", count, "--family", "planted", "--state", &state, "--json",
        ]);
        assert_eq!(o.status.code(), Some(0));
        serde_json::from_slice::<serde_json::Value>(&o.stdout).unwrap()["instances"].clone()
    };
    assert_eq!(
        (run("2"), run("5"), run("1")),
        (2.into(), 5.into(), 5.into())
    );
    refused(
        &[
            "campaign", "--count", "5", "--family", "planted", "--seed", "2", "--state", &state,
        ],
        &["seed 2, got 1"],
    );
    let broken = folder.write("broken.json", "[]");
    refused(
        &["campaign", "--count", "5", "--state", &broken],
        &["broken.json"],
    );
}

#[test]
fn a_replay_is_judged_again() {
    let folder = Folder::new();
    let problem = r#"{"format":"mceip-problem/1","unknown":"mu","pencil":{"a":[["-9"]],"b":[["4"]],"free":[]}}"#;
    let text = format!(
        r#"{{"format":"mceip-replay/1","family":"digits","seed":1,"index":3,"engine":"pipeline","kind":"refused","disagreement":"d","as_drawn":"d","problem":{problem},"shrunk":true}}"#
    );
    let o = mceip(&["campaign", "--replay", &folder.write("replay.json", &text)]);
    assert_eq!(o.status.code(), Some(0));
    assert!(
        String::from_utf8(o.stdout)
            .unwrap()
            .contains("CLEAN: 1 solutions")
    );
    refused(
        &["campaign", "--replay", &folder.write("no.json", "{}")],
        &["no.json", "format"],
    );
}

#[test]
fn bad_options_are_refused_in_one_line() {
    refused(&["campaign"], &["--seconds"]);
    refused(
        &["campaign", "--count", "1", "--seconds", "1"],
        &["--seconds"],
    );
    refused(
        &["campaign", "--count", "1", "--family", "nothing"],
        &["table1", "nothing"],
    );
    refused(
        &["campaign", "--count", "1", "--family", "known", "known"],
        &["each once"],
    );
    refused(
        &["campaign", "--count", "1", "--shard", "3/2"],
        &["shard", "3/2"],
    );
    refused(
        &["campaign", "--count", "1", "--threads", "0"],
        &["threads"],
    );
    refused(
        &["campaign", "--count", "1", "--state", "/nonexistent/state"],
        &["/nonexistent/state"],
    );
}
