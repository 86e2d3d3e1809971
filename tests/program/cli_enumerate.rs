//! `mceip enumerate` from outside: its list, and an interrupt, after which it must not claim to be
//! complete. Limits: `tests/transcripts/enumerate.md`.
#![cfg(feature = "cli")]

use crate::common::{example, exits_with_json, pencil_problem, started};
#[cfg(unix)]
use crate::interrupt::interrupt;
use crate::program::Folder;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use std::time::Duration;

/// Writes a problem with unknown mu.
fn write_problem(folder: &Folder, name: &str, pencil: Value) -> String {
    folder.write(name, &pencil_problem("mu", pencil))
}

/// A matrix of one-digit integers, as in `peers.md`.
fn random_digits(rng: &mut ChaCha8Rng, order: usize) -> Vec<Vec<i64>> {
    let mut rows = Vec::new();
    for _ in 0..order {
        rows.push((0..order).map(|_| rng.random_range(-9..=9)).collect());
    }
    rows
}

#[test]
fn the_enumerator_lists_the_examples_and_names_its_evidence() {
    for name in ["fold", "two-particles", "two-particles-mu", "oblique"] {
        let report = exits_with_json(0, &format!("enumerate {} --json", example(name)));

        let evidence = report["evidence"].as_str().unwrap();
        assert!(!report["solutions"].as_array().unwrap().is_empty());
        assert_eq!(report["claim"], "complete");
        assert!(evidence.contains("by the plain enumeration"), "{evidence}");
    }
}

/// A cone at one value and a range of values, by both writers.
#[test]
fn families_have_one_shape_in_both_writers() {
    let folder = Folder::new();
    // A double eigenvalue 2 with all of the quadrant.
    let cone = json!({ "a": [[-2, 0], [0, -2]], "b": [[1, 0], [0, 1]], "free": [] });
    // The block of {0, 1} has the kernel (1, 1) for every t.
    let range = json!({ "a": [[1, -1], [-1, 1]], "b": [[0, 0], [0, 0]], "free": [] });

    for (name, pencil, one_value) in [("cone.json", cone, true), ("range.json", range, false)] {
        let problem = write_problem(&folder, name, pencil);
        for command in ["enumerate", "complete"] {
            let report = exits_with_json(0, &format!("{command} {problem} --json"));
            assert_eq!(report["claim"], "complete_with_families", "{command}");

            let families = report["families"].as_array().unwrap();
            let mut of_both = families.iter().filter(|f| f["slip"] == json!([0, 1]));
            let whole = of_both.find(|f| f["one_value"] == one_value).unwrap();
            assert_eq!(whole["one_solution_each"], !one_value, "{command}");
            if one_value {
                assert_eq!(whole["from"], json!(["2", "2"]), "{command}");
            }
        }
    }
}

/// SIGINT: exit 130, and what was found is printed with how far the enumeration came.
#[cfg(unix)]
#[test]
fn an_interrupted_enumeration_prints_what_it_found() {
    let folder = Folder::new();
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let a = random_digits(&mut rng, 13);
    let b = random_digits(&mut rng, 13);
    let problem = write_problem(
        &folder,
        "digits.json",
        json!({ "a": a, "b": b, "free": [] }),
    );

    let child = started(&format!("enumerate {problem} --json"));
    interrupt(&child, Duration::from_millis(300));

    let interrupted = child.wait_with_output().unwrap();

    assert_eq!(interrupted.status.code(), Some(130));

    let report: Value = serde_json::from_slice(&interrupted.stdout).unwrap();
    let evidence = report["evidence"].as_str().unwrap();
    assert_ne!(report["claim"], "complete");
    assert!(evidence.contains("was interrupted after"), "{report}");
}
