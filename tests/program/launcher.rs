//! Shards run by an existing engine: GNU parallel starts the processes, `mceip merge` proves that
//! they cover. `cargo test --test program -- --ignored launcher::` (Debian package `parallel`).
#![cfg(feature = "cli")]

use mceip_testkit::known;
use std::process::Command;

#[test]
#[ignore = "needs GNU parallel"]
fn gnu_parallel_runs_the_shards_and_merge_proves_the_whole() {
    let version = Command::new("parallel").arg("--version").output();
    let is_gnu = version.is_ok_and(|o| String::from_utf8_lossy(&o.stdout).contains("GNU parallel"));
    assert!(is_gnu, "install GNU parallel: apt-get install parallel");
    let folder = tempfile::tempdir().unwrap();
    let problem = known::complete_graph(9).unwrap().problem;
    let mceip_model::Body::Pencil(pencil) = problem.body() else {
        panic!("a pencil")
    };
    let dense = |m: &mceip_exact::Sparse| -> Vec<Vec<String>> {
        (0..m.rows())
            .map(|i| (0..m.cols()).map(|j| m.get(i, j).to_string()).collect())
            .collect()
    };
    let pencil = serde_json::json!({ "a": dense(pencil.a()), "b": dense(pencil.b()), "free": [] });
    let file = serde_json::json!({ "format": "mceip-problem/1", "unknown": problem.unknown().word(), "pencil": pencil });
    std::fs::write(folder.path().join("problem.json"), file.to_string()).unwrap();

    // The line of spec/complete-sets.md: exit 3 of a shard (the others' pieces stay open) is no
    // failure.
    let mceip = env!("CARGO_BIN_EXE_mceip");
    let line = format!(
        "seq 4 | parallel -j4 '{mceip} complete problem.json --threads 1 --shard {{}}/4 \
         --certificate part-{{}}.json >/dev/null || [ $? -eq 3 ]' \
         && {mceip} merge --problem problem.json part-*.json --certificate whole.json && {mceip} \
         check problem.json whole.json"
    );
    let o = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let (out, err) = (
        String::from_utf8_lossy(&o.stdout),
        String::from_utf8_lossy(&o.stderr),
    );
    assert_eq!(o.status.code(), Some(0), "{out}{err}");
    assert!(out.contains("COMPLETE: 511 solutions"), "{out}");
    assert!(out.contains("ACCEPTED"), "{out}");
    // One part lost: no whole.
    let parts = ["part-1.json", "part-2.json", "part-4.json"];
    let o = Command::new(mceip)
        .args(["merge", "--problem", "problem.json"])
        .args(parts)
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(o.status.code(), Some(2), "{o:?}");
}
