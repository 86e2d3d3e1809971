//! `mceip enumerate` from outside: its list, limits, an interrupt; and what `merge` refuses.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use std::process::{Command, Stdio};

fn root(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(path)
        .display()
        .to_string()
}

/// A folder with the problems of these tests.
struct Bench(Folder);

impl Bench {
    fn new() -> Bench {
        Bench(Folder::new())
    }

    fn write(&self, name: &str, text: &str) -> String {
        self.0.write(name, text)
    }

    /// One-digit integer pencils of `peers.md`.
    fn digits(&self, n: usize, seed: u64) -> String {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut matrix = || {
            (0..n)
                .map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect())
                .collect::<Vec<Vec<i64>>>()
        };
        let pencil = serde_json::json!({ "a": matrix(), "b": matrix(), "free": [] });
        self.problem(&format!("digits-{n}-{seed}.json"), pencil)
    }

    fn problem(&self, name: &str, pencil: serde_json::Value) -> String {
        self.write(
            name,
            &serde_json::json!({ "format": "mceip-problem/1", "unknown": "mu", "pencil": pencil })
                .to_string(),
        )
    }
}

#[test]
fn the_enumerator_lists_the_examples_and_names_its_evidence() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let file = root(&format!("spec/examples/{name}.json"));
        let o = mceip(&["enumerate", &file, "--json"]);
        assert_eq!(o.status.code(), Some(0));

        let report: serde_json::Value = serde_json::from_slice(&o.stdout).unwrap();
        assert!(
            !report["solutions"].as_array().unwrap().is_empty() && report["claim"] == "complete"
        );
        assert!(
            report["evidence"]
                .as_str()
                .unwrap()
                .contains("by the plain enumeration")
        );
    }
}

#[test]
fn limits_and_options_are_refused_in_one_line() {
    let b = Bench::new();
    let file = root("spec/examples/fold.json");
    let identity = |n: usize| serde_json::json!({ "rows": n, "cols": n, "entries": (0..n).map(|i| (i, i, 1)).collect::<Vec<_>>() });
    let large = |n: usize| {
        b.problem(
            &format!("large-{n}.json"),
            serde_json::json!({ "a": identity(n), "b": identity(n), "free": [] }),
        )
    };
    refused(&["enumerate", &large(17)], &["16 slip variables", "17"]);
    refused(&["enumerate", &large(70)], &["16 slip variables", "70"]);

    let free: Vec<usize> = (0..17).collect();
    let many_free = b.problem(
        "free.json",
        serde_json::json!({ "a": identity(18), "b": identity(18), "free": free }),
    );
    refused(&["enumerate", &many_free], &["16 free variables", "17"]);

    let digits = format!("1{}", "0".repeat(3000));
    let long = b.problem(
        "long.json",
        serde_json::json!({ "a": [[digits, 1], [1, digits]], "b": [[1, 0], [0, 1]], "free": [] }),
    );
    refused(
        &["enumerate", &long],
        &["bits of a determinant's coefficients", "8192"],
    );

    refused(&["enumerate", &file, "--window", "3,2"], &["--window"]);
    refused(&["enumerate", &file, "--window", "-1,2"], &["--window"]);
    refused(&["enumerate", &file, "--screened"], &["--screened"]);
    refused(&["merge", "--problem", &file], &["PARTS"]);
    refused(&["merge", &file], &["--problem"]);
}

/// SIGINT: exit 130, and what was found is printed with how far the enumeration came.
#[cfg(unix)]
#[test]
fn an_interrupted_enumeration_prints_what_it_found() {
    let b = Bench::new();
    let file = b.digits(13, 1);
    let mut enumerate = Command::new(env!("CARGO_BIN_EXE_mceip"));
    enumerate
        .args(["enumerate", &file, "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());

    let child = enumerate.spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    assert!(
        Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );

    let interrupted = child.wait_with_output().unwrap();
    assert_eq!(interrupted.status.code(), Some(130));
    let report: serde_json::Value = serde_json::from_slice(&interrupted.stdout).unwrap();
    assert_ne!(report["claim"], "complete");
    assert!(
        report["evidence"]
            .as_str()
            .unwrap()
            .contains("was interrupted after"),
        "{report}"
    );
}
