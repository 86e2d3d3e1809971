//! The conformance pack and `mceip conform`: the committed pack is the regenerated one, right
//! answers are called correct and wrong ones are not, foreign programs of every kind get the right
//! labels.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use mceip_engine::foreign::{Effort, ForeignReport, Verdict, judge};
use mceip_testkit::conform::{Bug, Case, Flag, Label, groups, pack_files};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// `mceip conform --write spec/conformance-pack` after a change of the groups, and look at the
/// difference.
#[test]
fn the_committed_pack_is_the_regenerated_one() {
    let files = pack_files(&groups().unwrap()).unwrap();
    let folder = root("spec/conformance-pack");
    let there: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(there, files.iter().map(|f| f.0.clone()).collect());
    let bytes: usize = files.iter().map(|f| f.1.len()).sum();
    assert!(bytes < 3_000_000, "{bytes}");
    for (name, text) in &files {
        assert!(
            std::fs::read_to_string(folder.join(name)).unwrap() == *text,
            "{name} differs: mceip conform --write"
        );
    }
    let index: Value = serde_json::from_str(&files.last().unwrap().1).unwrap();
    let missing: Vec<&str> = Flag::ALL
        .iter()
        .map(|f| f.word())
        .filter(|w| index["flags"][w].is_null())
        .collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

fn cases() -> Vec<Case> {
    let drafts: Vec<_> = groups()
        .unwrap()
        .into_iter()
        .flat_map(|g| g.drafts)
        .collect();
    drafts
        .par_iter()
        .map(|d| Case::answer(d, false).unwrap())
        .collect()
}

/// The exact answer, the same with value and x alone, in reverse, twice and in another scale.
#[test]
fn right_answers_are_correct_in_any_order_and_scale() {
    let all = cases();
    let ids = all.par_iter().map(|case| {
        let answer = case.answer_json();
        let full = case.judge(&answer.to_string());
        assert_eq!(full.label, Label::Correct, "{}: {}", case.id, full.detail);
        let bare = |s: &Value| {
            let scaled: Vec<f64> = s["x"].as_array().unwrap().iter().map(|v| 3.0 * v.as_str().unwrap().parse::<f64>().unwrap()).collect();
            json!({ "value": s["value"], "x": scaled })
        };
        let mut solutions: Vec<Value> = answer["solutions"].as_array().unwrap().iter().map(bare).collect();
        solutions.reverse();
        solutions.extend(solutions.clone());
        let report = json!({ "format": "mceip-solutions/1", "solutions": solutions, "continua": answer["continua"] });
        let judged = case.judge(&report.to_string());
        assert_eq!(judged.label, Label::Correct, "{}: {}", case.id, judged.detail);
        case.id.clone()
    });
    let ids: BTreeSet<String> = ids.collect();
    assert_eq!(ids.len(), all.len(), "every id once");
}

/// Six digits suffice where the flags do not say that they cannot.
#[test]
fn six_digits_are_enough_away_from_close_values() {
    let all = cases();
    let count = all.par_iter().map(|case| {
        if [Flag::CloseValues, Flag::TinyComponent, Flag::NearThreshold].iter().any(|f| case.flags.contains(f)) {
            return 0usize;
        }
        let answer = case.answer_json();
        let six = |v: &Value| format!("{:.5e}", v.as_str().unwrap().parse::<f64>().unwrap());
        let bare = |s: &Value| json!({ "value": six(&s["value"]), "x": s["x"].as_array().unwrap().iter().map(six).collect::<Vec<_>>() });
        let solutions: Vec<Value> = answer["solutions"].as_array().unwrap().iter().map(bare).collect();
        // Rounded into the window's outside by the last digit: the closed end itself.
        let report = json!({ "format": "mceip-solutions/1", "solutions": solutions, "continua": answer["continua"] });
        let judged = case.judge(&report.to_string());
        assert_eq!(judged.label, Label::Correct, "{}: {}", case.id, judged.detail);
        1
    });
    assert!(count.sum::<usize>() > 150);
}

/// Every wrong answer gets its label, and what is false in it is refuted by certify, check and
/// enumeration.
#[test]
fn wrong_answers_are_rejected() {
    let all = cases();
    let counts = all.par_iter().map(|case| {
        let mut seen: BTreeMap<Bug, usize> = BTreeMap::new();
        for wrong in case.wrong_answers() {
            let text = wrong.report.to_string();
            let judged = case.judge(&text);
            assert_eq!(
                judged.label,
                wrong.bug.expected(),
                "{} {:?}: {}",
                case.id,
                wrong.bug,
                judged.detail
            );
            *seen.entry(wrong.bug).or_default() += 1;
            let report = ForeignReport::read(&text, &case.problem, &case.reduced).unwrap();
            if wrong.bug.expected() == Label::Wrong && wrong.bug != Bug::EndlessContinuum {
                let verdict = judge(
                    &case.problem,
                    &case.reduced,
                    report.solutions[0].as_ref().unwrap(),
                    1e-6,
                    &mut Effort::default(),
                );
                // (1, 0) at t = 1 + 1e-5 is wrong, and as near to the solution (1, 1e-5) at t = 1
                // as its rounding would be.
                let rounding = case.flags.contains(&Flag::TinyComponent)
                    && matches!(verdict, Verdict::Undecided { .. });
                assert!(
                    rounding
                        || matches!(verdict, Verdict::Rejected(_) | Verdict::Inaccurate { .. }),
                    "{} {:?}: {verdict:?}",
                    case.id,
                    wrong.bug
                );
            }
        }
        seen
    });
    let total = counts.reduce(BTreeMap::new, |mut a, b| {
        b.into_iter()
            .for_each(|(bug, n)| *a.entry(bug).or_default() += n);
        a
    });
    assert_eq!(total.len(), 11, "every kind of bug: {total:?}");
    assert!(total.values().sum::<usize>() > 500, "{total:?}");
}

fn conform(options: &[&str], command: &[&str]) -> (i32, String) {
    let out = mceip(&[&["conform"][..], options, &["--"], command].concat());
    (
        out.status.code().unwrap(),
        String::from_utf8(out.stdout).unwrap(),
    )
}

#[test]
fn our_own_programs_conform() {
    let ours = env!("CARGO_BIN_EXE_mceip");
    let (code, text) = conform(&[], &[ours, "enumerate", "-", "--json"]);
    assert_eq!(code, 0, "{text}");
    let (_, text) = conform(
        &["--only", "fold", "--only", "threshold", "--json"],
        &[ours, "solve", "-", "--json"],
    );
    let report: Value = serde_json::from_str(&text).unwrap();
    assert!(
        report["labels"]["wrong"].is_null() && report["labels"]["correct"].as_u64().unwrap() > 10,
        "{text}"
    );
    assert!(
        report["labels"]["crashed"].is_null() && report["labels"]["malformed"].is_null(),
        "{text}"
    );
}

/// One label for all of a few cases, whatever the program does.
#[cfg(unix)]
#[test]
fn hostile_programs_get_their_labels() {
    let only = ["--only", "window_end", "--time-limit", "0.5", "--json"];
    for (script, label) in [
        ("cat > /dev/null; echo nonsense", "malformed"),
        ("true", "malformed"),
        (
            "echo '{\"format\":\"mceip-solutions/2\",\"solutions\":[]}'",
            "malformed",
        ),
        (
            "echo '{\"format\":\"mceip-solutions/1\",\"solutions\":[{\"value\":1,\"x\":[1]}]}'",
            "malformed",
        ),
        (
            "echo '{\"format\":\"mceip-solutions/1\",\"solutions\":[{\"value\":1e999,\"x\":[1,1]}]}'",
            "malformed",
        ),
        ("yes", "malformed"),
        ("printf '\\377'", "malformed"),
        ("cat; exit 1", "crashed"),
        ("kill -11 $$", "crashed"),
        ("exec sleep 60", "timed out"),
        (
            "echo '{\"format\":\"mceip-solutions/1\",\"solutions\":[]}'",
            "incomplete",
        ),
        (
            "echo '{\"format\":\"mceip-solutions/1\",\"problem_sha256\":\"00\",\"solutions\":[]}'",
            "wrong",
        ),
    ] {
        let (code, text) = conform(&only, &["sh", "-c", script]);
        let report: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(code, 1, "{script}: {text}");
        assert!(
            report["cases"].as_u64().unwrap() > 4 && report["labels"][label] == report["cases"],
            "{script}: {text}"
        );
    }
}

#[cfg(unix)]
#[test]
fn threads_do_not_change_the_output() {
    let program = [
        "sh",
        "-c",
        "echo '{\"format\":\"mceip-solutions/1\",\"solutions\":[]}'",
    ];
    let folder = Folder::new();
    let run = |threads: &str| {
        let page = folder.path(threads);
        let text = conform(
            &[
                "--threads",
                threads,
                "--count",
                "30",
                "--seed",
                "7",
                "--only",
                "random",
                "--markdown",
                &page,
            ],
            &program,
        );
        (text, std::fs::read_to_string(&page).unwrap())
    };
    let (one, four) = (run("1"), run("4"));
    assert_eq!(one, four);
    assert!(
        one.0.1.contains("126 cases") && one.1.contains("| random | 126 |"),
        "{}",
        one.0.1
    );
    let other = conform(
        &["--count", "30", "--seed", "8", "--only", "random"],
        &program,
    );
    assert_ne!(one.0.1, other.1, "another seed, other cases");
}

#[test]
fn bad_usage_and_damaged_packs_are_refused() {
    refused(&["conform"], &["COMMAND"]);
    refused(
        &["conform", "--time-limit", "0", "--", "true"],
        &["--time-limit"],
    );
    refused(
        &["conform", "--time-limit=-1", "--", "true"],
        &["--time-limit"],
    );
    refused(&["conform", "--threads", "0", "--", "true"], &["--threads"]);
    refused(
        &["conform", "--only", "everything", "--", "true"],
        &["--only", "everything"],
    );
    refused(&["conform", "--", "/nowhere/solver"], &["/nowhere/solver"]);
    refused(
        &["conform", "--pack", "/nowhere", "--", "true"],
        &["index.json"],
    );
    let folder = Folder::new();
    let pack = folder.path("");
    let write = |group: &str, digest: bool, name: &str| {
        use sha2::{Digest, Sha256};
        let sum: String = Sha256::digest(group)
            .iter()
            .map(|b| format!("{b:02x}"))
            .collect();
        let sum = if digest { sum } else { "0".repeat(64) };
        let entry = json!({ "file": name, "comment": "", "cases": 1, "wrong": 0, "sha256": sum });
        let index = json!({ "format": "mceip-pack-index/1", "cases": 1, "groups": [entry], "flags": {}, "bugs": {} });
        folder.write("index.json", &index.to_string());
        folder.write("folds.json", group);
    };
    let good = std::fs::read_to_string(root("spec/conformance-pack/folds.json")).unwrap();
    write(&good, true, "folds.json");
    assert_eq!(
        mceip(&[
            "conform",
            "--pack",
            &pack,
            "--",
            env!("CARGO_BIN_EXE_mceip"),
            "enumerate",
            "-",
            "--json"
        ])
        .status
        .code(),
        Some(0)
    );
    write(&good, false, "folds.json");
    refused(
        &["conform", "--pack", &pack, "--", "true"],
        &["folds.json", "sha256"],
    );
    write(&good, true, "../folds.json");
    refused(
        &["conform", "--pack", &pack, "--", "true"],
        &["../folds.json"],
    );
    assert!(good.contains("\"kernel_dimension\":1"));
    write(
        &good.replacen("\"kernel_dimension\":1", "\"kernel_dimension\":2", 1),
        true,
        "folds.json",
    );
    refused(
        &["conform", "--pack", &pack, "--", "true"],
        &["fold-00", "not the exact one"],
    );
    write(
        &good.replacen("\"fold\"", "\"unfold\"", 1),
        true,
        "folds.json",
    );
    refused(&["conform", "--pack", &pack, "--", "true"], &["unfold"]);
    write(&good[..good.len() / 2], true, "folds.json");
    refused(
        &["conform", "--pack", &pack, "--", "true"],
        &["folds.json", "line"],
    );
}
