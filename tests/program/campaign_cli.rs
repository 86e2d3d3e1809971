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
    let command =
        format!("campaign --count 3 --family table1 degenerate --seed 5 --replays {replays}");

    let text = exits(0, &format!("{command} --threads 1"));
    contains_all(
        &text,
        &[
            "CLEAN: no disagreement in 6 instances (seed 5)",
            "corners reached",
        ],
    );

    assert_eq!(text, exits(0, &format!("{command} --threads 2")));
    assert!(!Path::new(&replays).exists());

    let report = exits_with_json(0, &format!("{command} --threads 2 --json"));
    assert_eq!(report["instances"], 6);
    assert_eq!(report["families"][1]["name"], "degenerate");
}
