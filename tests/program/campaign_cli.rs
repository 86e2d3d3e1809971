//! `mceip campaign` from outside: exit codes, summary, state file, replay.
//!
//! A campaign is a function of its seed and its families: its text must not depend on threads, and
//! its state file must continue the same campaign alone.
#![cfg(feature = "cli")]

use crate::common::{contains_all, exits, exits_with_json};
use crate::program::{Folder, refused};
use serde_json::Value;
use std::path::Path;

#[test]
fn a_short_campaign_is_clean_and_the_same_on_any_number_of_threads() {
    let folder = Folder::new();
    let replays = folder.path("replays");
    let args = [
        "campaign",
        "--count",
        "3",
        "--family",
        "table1",
        "degenerate",
        "--seed",
        "5",
        "--replays",
        &replays,
    ];
    let on_one_thread = [&args[..], &["--threads", "1"]].concat();
    let on_two_threads = [&args[..], &["--threads", "2"]].concat();

    let text = exits(0, &on_one_thread);
    contains_all(
        &text,
        &[
            "CLEAN: no disagreement in 6 instances (seed 5)",
            "corners reached",
        ],
    );

    assert_eq!(text, exits(0, &on_two_threads));
    assert!(!Path::new(&replays).exists());

    let report = exits_with_json(0, &[&on_two_threads[..], &["--json"]].concat());
    assert_eq!(report["instances"], 6);
    assert_eq!(report["families"][1]["name"], "degenerate");
}

/// Goes on from a state file to so many instances of a family; how many there are then.
#[track_caller]
fn instances_after(count: &str, state: &str) -> Value {
    let report = exits_with_json(
        0,
        &[
            "campaign", "--count", count, "--family", "planted", "--state", state, "--json",
        ],
    );

    report["instances"].clone()
}

#[test]
fn a_state_file_is_gone_on_from() {
    let folder = Folder::new();
    let state = folder.path("state.json");
    assert_eq!(instances_after("2", &state), 2);
    assert_eq!(instances_after("5", &state), 5);
    assert_eq!(instances_after("1", &state), 5);

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
