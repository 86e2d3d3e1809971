//! `mceip check`: claims are printed beside a cover with their place in it; a window smaller than
//! the problem's is said, and `--window` demands one. Reports of `complete` and `merge` and the
//! number of threads say what they are.
//!
//! The fold has solutions at 2 and 3, so what holds in a window is known. A verdict that hides that
//! its window is smaller, or a report whose word does not fit its families, fails.
#![cfg(feature = "cli")]

use crate::common::{Run, example, exits, pencil_problem, read, repository, run};
use crate::corpus_reader::entry;
use crate::program::{Folder, refused};
use serde_json::{Value, json};

/// `check` on a file of the corpus.
fn check_corpus(name: &str) -> Run {
    let folder = Folder::new();
    let case = entry(&format!("accept/{name}"));
    let problem = folder.write("p.json", &case.problem);
    let certificate = folder.write("c.json", &case.certificate);

    run(&["check", &problem, &certificate])
}

#[test]
fn claims_beside_a_cover_are_printed_with_their_place() {
    let listed = check_corpus("beside-listed");
    assert_eq!(listed.code, Some(0), "{listed:?}");
    assert!(
        listed.stdout.starts_with(
            "claim: lambda2 in [2, 2], slip [0, 1]; solution 1 of the list below\nsolution: "
        ),
        "{listed:?}"
    );

    let open = check_corpus("beside-open");
    assert_eq!(open.code, Some(3), "{open:?}");
    assert!(
        open.stdout
            .starts_with("claim: lambda2 in [2, 2], slip [0, 1]; in open region 1 below\n"),
        "{open:?}"
    );

    let family = check_corpus("beside-family");
    assert_eq!(family.code, Some(0), "{family:?}");
    assert!(
        family
            .stdout
            .contains("claim: lambda2 in [2, 2], slip [0, 1]; in family 1 below\n"),
        "{family:?}"
    );

    let alone = check_corpus("cover");
    assert_eq!(alone.code, Some(0), "{alone:?}");
    assert!(!alone.stdout.contains("claim: "), "{alone:?}");
}

/// Certificates of the fold on its whole window, on a part with a solution, and on one without.
struct Certificates {
    whole: String,
    part: String,
    absent: String,
}

impl Certificates {
    fn of_the_fold(folder: &Folder) -> Certificates {
        let certificates = Certificates {
            whole: folder.path("whole.json"),
            part: folder.path("part.json"),
            absent: folder.path("absent.json"),
        };
        let Certificates {
            whole,
            part,
            absent,
        } = &certificates;

        let complete_fold = ["complete", &example("fold"), "--certificate"];
        exits(0, &[&complete_fold[..], &[whole]].concat());
        exits(
            0,
            &[&complete_fold[..], &[part, "--window", "1,5/2"]].concat(),
        );
        exits(
            0,
            &[&complete_fold[..], &[absent, "--window", "4,5"]].concat(),
        );

        certificates
    }
}

/// The fold has solutions at 2 and 3, its problem file the window [0, infinity).
#[test]
fn a_smaller_window_is_said_and_another_one_may_be_demanded() {
    let folder = Folder::new();
    let fold = example("fold");
    let Certificates {
        whole,
        part,
        absent,
    } = Certificates::of_the_fold(&folder);

    let text = run(&["check", &fold, &whole]).stdout;
    assert!(text.trim_end().ends_with("in [0, infinity)"), "{text}");

    let text = exits(0, &["check", &fold, &part]);
    assert!(
        text.trim_end()
            .ends_with("in [1, 5/2]; NOT the whole window [0, infinity) of the problem"),
        "{text}"
    );

    let text = exits(0, &["check", &fold, &absent]);
    assert!(text.starts_with("ABSENT in [4, 5]: "), "{text}");
    assert!(
        text.contains("; NOT the whole window [0, infinity)"),
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
        let text = exits(expected, &["check", &fold, certificate, "--window", window]);
        let is_rejected = text.contains("REJECTED: window: expected one that covers [");
        assert_eq!(is_rejected, expected == 1, "{window}: {text}");
    }

    refused(&["check", &fold, &whole, "--window", "2,1"], &["--window"]);
    refused(
        &["check", &fold, &whole, "--tolerance", "1e-6"],
        &["--tolerance", "solutions only"],
    );
    refused(
        &["check", &example("bounded-mcp"), &whole, "--window", "0,1"],
        &["--window", "plain problem"],
    );
}

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
        let text = exits(0, &["complete", problem, "--json"]);
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

#[test]
fn threads_that_the_machine_does_not_give_are_said() {
    let fold = example("fold");

    let one = run(&["complete", &fold, "--threads", "1"]);
    assert_eq!(one.code, Some(0));
    assert_eq!(one.stderr, "");

    let many = run(&["complete", &fold, "--threads", "200"]);
    let message = &many.stderr;
    assert_eq!(many.code, Some(0));
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(
        message.starts_with("mceip: --threads 200: the machine runs "),
        "{message}"
    );

    refused(
        &["complete", &fold, "--threads", "0"],
        &["--threads", "1 to 1024"],
    );
}
