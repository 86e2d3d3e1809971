//! `mceip campaign` from outside: exit code and summary. States and replays: `tests/transcripts`.
//!
//! A campaign is a function of its seed and its families: its text must not depend on threads.
#![cfg(feature = "cli")]

use crate::common::{contains_all, exits, exits_with_json};
use crate::program::Folder;
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
