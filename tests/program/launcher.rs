//! Shards run by an existing engine: GNU parallel starts the processes, `mceip merge` proves that
//! they cover. `cargo test --test program -- --ignored launcher::` (Debian package `parallel`).
//!
//! The complete graph of 9 vertices has 511 solutions, by theory. A part that is lost must keep
//! `merge` from claiming the whole.
#![cfg(feature = "cli")]

use crate::common::problem_text;
use crate::program::Folder;
use mceip_testkit::known;
use std::process::Command;

#[test]
#[ignore = "needs GNU parallel"]
fn gnu_parallel_runs_the_shards_and_merge_proves_the_whole() {
    let version = Command::new("parallel").arg("--version").output();
    let is_gnu = version.is_ok_and(|output| {
        let text = String::from_utf8_lossy(&output.stdout);
        text.contains("GNU parallel")
    });

    assert!(is_gnu, "install GNU parallel: apt-get install parallel");

    let folder = Folder::new();
    let problem = known::complete_graph(9).unwrap().problem;
    folder.write("problem.json", &problem_text(&problem));

    // The line of spec/complete-sets.md: exit 3 of a shard (the others' pieces stay open) is no
    // failure.
    let mceip = env!("CARGO_BIN_EXE_mceip");
    let line = format!(
        "seq 4 | parallel -j4 '{mceip} complete problem.json --threads 1 --shard {{}}/4 \
         --certificate part-{{}}.json >/dev/null || [ $? -eq 3 ]' \
         && {mceip} merge --problem problem.json part-*.json --certificate whole.json && {mceip} \
         check problem.json whole.json"
    );
    let run = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&run.stdout);

    assert_eq!(run.status.code(), Some(0), "{run:?}");
    assert!(text.contains("COMPLETE: 511 solutions"), "{text}");
    assert!(text.contains("ACCEPTED"), "{text}");

    // One part lost: no whole.
    let parts = ["part-1.json", "part-2.json", "part-4.json"];
    let merged = Command::new(mceip)
        .args(["merge", "--problem", "problem.json"])
        .args(parts)
        .current_dir(folder.path(""))
        .output()
        .unwrap();

    assert_eq!(merged.status.code(), Some(2), "{merged:?}");
}
