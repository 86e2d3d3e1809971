//! The worked example `spec/examples/adapter.py` through `mceip conform`: right where floats
//! suffice, not on degenerate cases; broken adapters get the right labels. Needs python3 with
//! numpy.
//!
//! The answers of the cases are exact and known, and each fault is built into the adapter by one
//! change of its source; a label that does not fit the fault fails.
#![cfg(feature = "cli")]

use crate::common::{read, repository};
use crate::program::{Folder, mceip};
use serde_json::Value;

fn adapter() -> String {
    read(&repository("spec/examples/adapter.py"))
}

/// The adapter with a piece of its source replaced.
#[track_caller]
fn adapter_with(from: &str, to: &str) -> String {
    let source = adapter();
    assert!(source.contains(from), "{from}");
    source.replace(from, to)
}

/// The report on a version of the adapter, over the cases with these flags.
fn report_on(source: &str, flags: &[&str]) -> Value {
    let folder = Folder::new();
    let file = folder.write("adapter.py", source);

    let mut args = vec!["conform", "--as-pencil", "--json", "--time-limit", "60"];
    for flag in flags {
        args.extend(["--only", flag]);
    }

    args.extend(["--", "python3", &file]);

    let output = mceip(&args);
    serde_json::from_slice(&output.stdout).unwrap()
}

/// How many cases have this label.
fn count(labels: &Value, label: &str) -> u64 {
    labels[label].as_u64().unwrap_or(0)
}

#[test]
#[cfg_attr(not(has_numpy), ignore = "needs python3 with numpy")]
fn the_adapter_is_right_where_floats_suffice_and_not_on_degenerate_cases() {
    let report = report_on(&adapter(), &["fold", "coupled_mass", "continuum", "cone"]);

    for label in ["crashed", "timed out", "malformed"] {
        assert_eq!(count(&report["labels"], label), 0, "{report:#}");
    }

    let coupled_mass = report["flags"]["coupled_mass"].as_object().unwrap();
    assert!(
        coupled_mass.keys().all(|label| label == "correct"),
        "{report:#}"
    );
    assert!(coupled_mass["correct"].as_u64().unwrap() > 10, "{report:#}");

    for flag in ["continuum", "cone"] {
        let labels = &report["flags"][flag];
        let not_correct = count(labels, "incomplete") + count(labels, "wrong");
        assert!(not_correct > 0, "{flag}: {report:#}");
    }
}

/// Values of both signs, and quadratic pencils by a companion matrix.
#[test]
#[cfg_attr(not(has_numpy), ignore = "needs python3 with numpy")]
fn the_adapter_knows_eigenvalue_problems() {
    let report = report_on(&adapter(), &["eigenvalue"]);

    let quadratic = &report["flags"]["quadratic"];
    assert!(count(quadratic, "correct") > 16, "{report:#}");
    assert!(count(&report["labels"], "correct") > 45, "{report:#}");
    assert_eq!(count(&report["labels"], "wrong"), 0, "{report:#}");

    let for_one_sign = adapter_with("float(\"-inf\") if", "0.0 if");
    let report = report_on(&for_one_sign, &["below_zero"]);
    assert!(count(&report["labels"], "incomplete") > 25, "{report:#}");
}

/// Started once, it gets the same labels as started for each case.
#[test]
#[cfg_attr(not(has_numpy), ignore = "needs python3 with numpy")]
fn the_adapter_answers_line_by_line() {
    let folder = Folder::new();
    let file = folder.write("adapter.py", &adapter());
    let options = ["conform", "--as-pencil", "--json", "--time-limit", "60"];
    let cases = ["--only", "fold", "--only", "cone"];

    let each = mceip(&[&options[..], &cases, &["--", "python3", &file]].concat());
    let lines = ["--lines", "--", "python3", &file, "--lines"];
    let once = mceip(&[&options[..], &cases, &lines].concat());

    let each: Value = serde_json::from_slice(&each.stdout).unwrap();
    let once: Value = serde_json::from_slice(&once.stdout).unwrap();
    assert_eq!(once["failures"], each["failures"]);
    assert_eq!(once["labels"], each["labels"]);
    assert!(count(&once["labels"], "correct") > 5, "{once:#}");
}

#[test]
#[cfg_attr(not(has_numpy), ignore = "needs python3 with numpy")]
fn broken_adapters_get_the_right_labels() {
    let with_turned_sign = adapter_with("[float(v) for v in x]", "[-float(v) for v in x]");
    let report = report_on(&with_turned_sign, &["window_end"]);
    assert_eq!(report["labels"]["wrong"], report["cases"], "{report:#}");

    // The same value found on two supports is reported once.
    let merging = adapter_with(
        "return {\"format\"",
        "found = list({round(s['value'], 6): s for s in found}.values())\n    return {\"format\"",
    );
    let report = report_on(&merging, &["threshold"]);

    assert!(count(&report["labels"], "incomplete") > 2, "{report:#}");
    assert_eq!(count(&report["labels"], "wrong"), 0, "{report:#}");

    let finding_nothing = "print('{\"format\": \"mceip-solutions/1\", \"solutions\": []}')";
    let report = report_on(finding_nothing, &["window_end"]);
    assert_eq!(
        report["labels"]["incomplete"], report["cases"],
        "{report:#}"
    );

    let without_inequalities = adapter_with(">= -TOLERANCE * scale", ">= -np.inf");
    let report = report_on(&without_inequalities, &["coupled_mass"]);
    assert!(count(&report["labels"], "wrong") > 0, "{report:#}");

    let exiting = adapter_with(
        "def main():",
        "def main():\n    raise SystemExit('no licence')",
    );
    let report = report_on(&exiting, &["window_end"]);

    assert_eq!(report["labels"]["crashed"], report["cases"], "{report:#}");

    let detail = report["failures"][0]["detail"].as_str().unwrap();
    assert!(detail.contains("no licence"), "{detail}");
}
