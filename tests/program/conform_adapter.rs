//! The worked example `spec/examples/adapter.py` through `mceip conform`: right where floats
//! suffice, not on degenerate cases; broken adapters get the right labels. Needs python3 with
//! numpy.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

fn numpy_is_missing() -> bool {
    let there = Command::new("python3")
        .args(["-c", "import numpy"])
        .output()
        .is_ok_and(|o| o.status.success());
    if !there {
        eprintln!(
            "SKIPPED: python3 with numpy is not installed: spec/examples/adapter.py was not run"
        );
    }
    !there
}

fn adapter() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples/adapter.py"))
        .unwrap()
}

/// Runs a version of the adapter on the cases with these flags.
fn run(source: &str, flags: &[&str]) -> Value {
    let folder = Folder::new();
    let file = folder.write("adapter.py", source);
    let only: Vec<&str> = flags.iter().flat_map(|f| ["--only", f]).collect();
    let options = [
        &["conform", "--as-pencil", "--json", "--time-limit", "60"][..],
        &only,
        &["--", "python3", file.as_str()],
    ]
    .concat();
    let out = mceip(&options);
    serde_json::from_slice(&out.stdout).unwrap()
}

fn count(report: &Value, label: &str) -> u64 {
    report["labels"][label].as_u64().unwrap_or(0)
}

#[test]
fn the_adapter_is_right_where_floats_suffice_and_not_on_degenerate_cases() {
    if numpy_is_missing() {
        return;
    }
    let report = run(&adapter(), &["fold", "coupled_mass", "continuum", "cone"]);
    for label in ["crashed", "timed out", "malformed"] {
        assert_eq!(count(&report, label), 0, "{report:#}");
    }
    let coupled = report["flags"]["coupled_mass"].as_object().unwrap();
    assert!(
        coupled.keys().all(|l| l == "correct") && coupled["correct"].as_u64().unwrap() > 10,
        "{report:#}"
    );
    for flag in ["continuum", "cone"] {
        let labels = &report["flags"][flag];
        let short =
            labels["incomplete"].as_u64().unwrap_or(0) + labels["wrong"].as_u64().unwrap_or(0);
        assert!(short > 0, "{flag}: {report:#}");
    }
}

#[test]
fn broken_adapters_get_the_right_labels() {
    if numpy_is_missing() {
        return;
    }
    let broken = |from: &str, to: &str| {
        assert!(adapter().contains(from), "{from}");
        adapter().replace(from, to)
    };
    let flipped = run(
        &broken("[float(v) for v in x]", "[-float(v) for v in x]"),
        &["window_end"],
    );
    assert_eq!(flipped["labels"]["wrong"], flipped["cases"], "{flipped:#}");
    // The same value found on two supports is reported once.
    let merged = run(
        &broken(
            "print(json",
            "found = list({round(s['value'], 6): s for s in found}.values())\n    print(json",
        ),
        &["threshold"],
    );
    assert!(
        count(&merged, "incomplete") > 2 && count(&merged, "wrong") == 0,
        "{merged:#}"
    );
    let deaf = run(
        "print('{\"format\": \"mceip-solutions/1\", \"solutions\": []}')",
        &["window_end"],
    );
    assert_eq!(deaf["labels"]["incomplete"], deaf["cases"], "{deaf:#}");
    let blind = run(
        &broken(">= -TOLERANCE * np.abs(a).max()", ">= -np.inf"),
        &["coupled_mass"],
    );
    assert!(count(&blind, "wrong") > 0, "{blind:#}");
    let dead = run(
        &broken(
            "def main():",
            "def main():\n    raise SystemExit('no licence')",
        ),
        &["window_end"],
    );
    assert_eq!(dead["labels"]["crashed"], dead["cases"], "{dead:#}");
    assert!(
        dead["failures"][0]["detail"]
            .as_str()
            .unwrap()
            .contains("no licence")
    );
}
