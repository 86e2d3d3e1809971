//! Reports of `complete` say what they are: one whose word does not fit its families fails. What
//! `mceip check` prints stands in `tests/transcripts`.
#![cfg(feature = "cli")]

use crate::common::{exits, pencil_problem, read, repository};
use crate::program::Folder;
use serde_json::{Value, json};

/// diag(t - 1, t - 1) has a cone at 1: its list of solutions is not all there is.
#[test]
fn a_report_with_families_claims_them() {
    let folder = Folder::new();
    let cone = json!({ "a": [[-1, 0], [0, -1]], "b": [[1, 0], [0, 1]] });
    let cone = folder.write("cone.json", &pencil_problem("lambda2", cone));
    let list = json!({ "a": [[-1, 0], [0, -2]], "b": [[1, 0], [0, 1]] });
    let list = folder.write("list.json", &pencil_problem("lambda2", list));
    let schema = read(&repository("spec/schemas/mceip-solutions-1.json"));
    let schema: Value = serde_json::from_str(&schema).unwrap();
    let validator = jsonschema::draft202012::options().build(&schema).unwrap();

    for (problem, claim, has_families) in [
        (&cone, "complete_with_families", true),
        (&list, "complete", false),
    ] {
        let text = exits(0, &format!("complete {problem} --json"));
        let report: Value = serde_json::from_str(&text).unwrap();
        let families = report["families"].as_array().unwrap();
        assert_eq!(report["claim"], claim, "{text}");
        assert_eq!(!families.is_empty(), has_families, "{text}");
        assert!(validator.is_valid(&report), "{text}");

        // The word without the families, or the families under the other word.
        let mut without_families = report.clone();
        without_families["families"] = json!([]);
        let is_valid = validator.is_valid(&without_families);
        assert_eq!(is_valid, !has_families, "{without_families}");

        let mut under_the_other_word = report.clone();
        under_the_other_word["claim"] = "complete".into();
        let is_valid = validator.is_valid(&under_the_other_word);
        assert_eq!(is_valid, !has_families, "{under_the_other_word}");
    }
}
