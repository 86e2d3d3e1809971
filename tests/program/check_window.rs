//! `mceip check`: claims are printed beside a cover with their place in it; a window smaller than
//! the problem's is said, and `--window` demands one. Reports of `complete` and `merge` and the
//! number of threads say what they are.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use serde_json::Value;
use std::path::Path;

fn root(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(path)
        .display()
        .to_string()
}

/// Exit code and stdout.
fn run(args: &[&str]) -> (i32, String) {
    let out = mceip(args);
    (
        out.status.code().unwrap(),
        String::from_utf8(out.stdout).unwrap(),
    )
}

/// `check` on a file of the corpus.
fn check_corpus(name: &str) -> (i32, String) {
    let folder = Folder::new();
    let file: Value = serde_json::from_str(
        &std::fs::read_to_string(root(&format!("spec/corpus/accept/{name}.json"))).unwrap(),
    )
    .unwrap();
    let problem = folder.write("p.json", &file["problem"].to_string());
    let certificate = folder.write("c.json", &file["certificate"].to_string());
    run(&["check", &problem, &certificate])
}

#[test]
fn claims_beside_a_cover_are_printed_with_their_place() {
    let (code, text) = check_corpus("beside-listed");
    assert!(
        code == 0
            && text.starts_with(
                "claim: lambda2 in [2, 2], slip [0, 1]; solution 1 of the list below\nsolution: "
            ),
        "{text}"
    );
    let (code, text) = check_corpus("beside-open");
    assert!(
        code == 3
            && text.starts_with("claim: lambda2 in [2, 2], slip [0, 1]; in open region 1 below\n"),
        "{text}"
    );
    let (code, text) = check_corpus("beside-family");
    assert!(
        code == 0 && text.contains("claim: lambda2 in [2, 2], slip [0, 1]; in family 1 below\n"),
        "{text}"
    );
    let (code, text) = check_corpus("cover");
    assert!(code == 0 && !text.contains("claim: "), "{text}");
}

/// The fold has solutions at 2 and 3, its problem file the window [0, infinity).
#[test]
fn a_smaller_window_is_said_and_another_one_may_be_demanded() {
    let folder = Folder::new();
    let fold = root("spec/examples/fold.json");
    let (whole, part, absent) = (
        folder.path("whole.json"),
        folder.path("part.json"),
        folder.path("absent.json"),
    );
    assert_eq!(run(&["complete", &fold, "--certificate", &whole]).0, 0);
    assert_eq!(
        run(&[
            "complete",
            &fold,
            "--window",
            "1,5/2",
            "--certificate",
            &part
        ])
        .0,
        0
    );
    assert_eq!(
        run(&[
            "complete",
            &fold,
            "--window",
            "4,5",
            "--certificate",
            &absent
        ])
        .0,
        0
    );

    let (_, text) = run(&["check", &fold, &whole]);
    assert!(text.trim_end().ends_with("in [0, infinity)"), "{text}");
    let (code, text) = run(&["check", &fold, &part]);
    assert!(
        code == 0
            && text
                .trim_end()
                .ends_with("in [1, 5/2]; NOT the whole window [0, infinity) of the problem"),
        "{text}"
    );
    let (code, text) = run(&["check", &fold, &absent]);
    assert!(
        code == 0
            && text.starts_with("ABSENT in [4, 5]: ")
            && text.contains("; NOT the whole window [0, infinity)"),
        "{text}"
    );

    for (certificate, window, expected) in [
        (&whole, "0,inf", 0),
        (&whole, "7,", 0),
        (&part, "1,2.5", 0),
        (&part, "2,2", 0),
        (&part, "1,5/2", 0),
        (&part, "0.999,2", 1),
        (&part, "2,2.501", 1),
        (&part, "2,inf", 1),
        (&absent, "4,5", 0),
        (&absent, "3,5", 1),
    ] {
        let (code, text) = run(&["check", &fold, certificate, "--window", window]);
        assert_eq!(code, expected, "{window}: {text}");
        assert_eq!(
            text.contains("REJECTED: window: expected one that covers ["),
            expected == 1,
            "{text}"
        );
    }
    refused(&["check", &fold, &whole, "--window", "2,1"], &["--window"]);
    refused(
        &["check", &fold, &whole, "--tolerance", "1e-6"],
        &["--tolerance", "solutions only"],
    );
    let mcp = root("spec/examples/bounded-mcp.json");
    refused(
        &["check", &mcp, &whole, "--window", "0,1"],
        &["--window", "plain problem"],
    );
}

/// diag(t - 1, t - 1) has a cone at 1: its list of solutions is not all there is.
#[test]
fn a_report_with_families_claims_them() {
    let folder = Folder::new();
    let problem = |a: &str| {
        format!(
            r#"{{"format":"mceip-problem/1","unknown":"lambda2","pencil":{{"a":{a},"b":[[1,0],[0,1]]}}}}"#
        )
    };
    let cone = folder.write("cone.json", &problem("[[-1,0],[0,-1]]"));
    let list = folder.write("list.json", &problem("[[-1,0],[0,-2]]"));
    for (file, claim, has_families) in [
        (&cone, "complete_with_families", true),
        (&list, "complete", false),
    ] {
        let (code, text) = run(&["complete", file, "--json"]);
        let report: Value = serde_json::from_str(&text).unwrap();
        assert_eq!((code, report["claim"].as_str()), (0, Some(claim)), "{text}");
        assert_eq!(
            !report["families"].as_array().unwrap().is_empty(),
            has_families,
            "{text}"
        );

        let schema: Value = serde_json::from_str(
            &std::fs::read_to_string(root("spec/schemas/mceip-solutions-1.json")).unwrap(),
        )
        .unwrap();
        let validator = jsonschema::draft202012::options().build(&schema).unwrap();
        assert!(validator.is_valid(&report), "{text}");
        // The word without the families, or the families under the other word.
        let mut bare = report.clone();
        bare["families"] = serde_json::json!([]);
        assert_eq!(validator.is_valid(&bare), !has_families, "{bare}");
        let mut other = report.clone();
        other["claim"] = "complete".into();
        assert_eq!(validator.is_valid(&other), !has_families, "{other}");
    }
}

#[test]
fn threads_that_the_machine_does_not_give_are_said() {
    let fold = root("spec/examples/fold.json");
    let said = |threads: &str| {
        let out = mceip(&["complete", &fold, "--threads", threads]);
        assert_eq!(out.status.code(), Some(0));
        String::from_utf8(out.stderr).unwrap()
    };
    assert_eq!(said("1"), "");
    let many = said("200");
    assert!(
        many.lines().count() == 1 && many.starts_with("mceip: --threads 200: the machine runs "),
        "{many}"
    );
    refused(
        &["complete", &fold, "--threads", "0"],
        &["--threads", "at least 1"],
    );
}
