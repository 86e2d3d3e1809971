//! The program from outside: malformed input, the chain of commands, exit codes.
#![cfg(feature = "cli")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn mceip(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mceip"))
        .args(args)
        .output()
        .unwrap()
}

fn root(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(path)
        .display()
        .to_string()
}

fn stdout(o: &Output) -> String {
    String::from_utf8(o.stdout.clone()).unwrap()
}

/// Exit 2, nothing on stdout, one line on stderr that mentions each of `words`.
#[track_caller]
fn refused(o: &Output, words: &[&str]) {
    let err = String::from_utf8_lossy(&o.stderr);
    assert_eq!(o.status.code(), Some(2), "{err}");
    assert!(
        o.stdout.is_empty() && err.lines().count() == 1 && err.len() < 600,
        "{err}"
    );
    assert!(
        words.iter().all(|w| err.contains(w)),
        "{words:?} not in: {err}"
    );
}

#[test]
fn malformed_problems_are_refused_in_one_line() {
    let expected: [(&str, &[&str]); 26] = [
        ("empty", &["line 1"]),
        ("truncated", &["EOF"]),
        ("not-json", &["line 1", "expected"]),
        ("nan", &["expected value"]),
        ("deep", &["line 1"]),
        ("duplicate-key", &["duplicate field"]),
        ("wrong-version", &["mceip-problem/1", "mceip-problem/9"]),
        ("unknown-field", &["colour"]),
        ("ragged", &["K", "row 1", "4", "3"]),
        ("non-symmetric", &["E3", "K[0][1] = 0", "-12/25"]),
        ("nan-string", &["NaN"]),
        ("index-out-of-range", &["normal", "9", "4"]),
        ("particle-twice", &["particles 0 and 2", "0"]),
        ("sign-zero", &["particle 0", "sign", "0"]),
        ("state-zero", &["particle 0", "zero"]),
        ("absurd-size", &["1000000", "1000000000000000"]),
        ("absurd-exponent", &["exponent"]),
        ("friction-zero", &["friction > 0", "particle 0"]),
        ("mass-not-definite", &["E3", "M positive definite", "-1"]),
        ("both-bodies", &["exactly one"]),
        ("window-reversed", &["min = 3", "max = 2"]),
        ("window-negative", &["min = -1"]),
        ("missing-market-file", &["nowhere.mtx"]),
        ("negative-index", &["line"]),
        ("reaction-outside-cone", &["E7", "particle 0", "-mu r_N"]),
        ("not-square", &["E3", "K"]),
    ];
    let mut files: Vec<String> = std::fs::read_dir(root("tests/malformed"))
        .unwrap()
        .map(|e| {
            e.unwrap()
                .path()
                .file_stem()
                .unwrap()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    files.sort();
    let mut listed: Vec<String> = expected.iter().map(|e| e.0.to_string()).collect();
    listed.sort();
    assert_eq!(files, listed, "every malformed file is tested");
    for (name, words) in expected {
        for command in ["enumerate", "solve", "reduce"] {
            refused(
                &mceip(&[command, &root(&format!("tests/malformed/{name}.json"))]),
                words,
            );
        }
    }
}

#[test]
fn options_and_files_are_refused_in_one_line() {
    let file = root("spec/examples/fold.json");
    refused(&mceip(&["enumerate", "/nowhere.json"]), &["/nowhere.json"]);
    refused(
        &mceip(&["enumerate", &file, "--window", "3,2"]),
        &["--window", "3,2"],
    );
    refused(
        &mceip(&["enumerate", &file, "--window=-1,2"]),
        &["--window"],
    );
    refused(&mceip(&["solve", &file, "--starts", "0"]), &["--starts"]);
    refused(
        &mceip(&["table1", "--c", "0.5", "--s", "0.5"]),
        &["--s", "c^2 + s^2 = 1"],
    );
    refused(&mceip(&["table1", "--mu", "0"]), &["--mu"]);
    refused(
        &mceip(&["block", "--state", "16"]),
        &["--state", "15 or 17"],
    );
    refused(&mceip(&["check", &file, &file]), &["mceip-certificate/1"]);
    refused(&mceip(&["certify", &file, &file]), &["mceip-solutions/1"]);
    refused(&mceip(&["frobnicate"]), &["frobnicate"]);
    refused(
        &mceip(&["solve", &file, "--starts", "many"]),
        &["many", "--starts"],
    );
    refused(
        &mceip(&["enumerate", &file, "--window", "-1,2"]),
        &["--window", "-1,2"],
    );
    refused(&mceip(&["table1", "--mu", "-1"]), &["--mu", "> 0"]);
    refused(
        &mceip(&["solve", &file, "--certificate", "/nowhere/c.json"]),
        &["/nowhere/c.json"],
    );
    refused(
        &mceip(&["solve", &file, "--certificate", &file]),
        &["--certificate", "input"],
    );
    assert_eq!(mceip(&["--help"]).status.code(), Some(0));
}

fn scratch(folder: &tempfile::TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// enumerate -> certify -> check, solve -> check, a forged file -> exit 1.
#[test]
fn the_chain_of_commands() {
    let folder = tempfile::tempdir().unwrap();
    for (name, count) in [
        ("two-particles", 3),
        ("two-particles-mu", 1),
        ("fold", 2),
        ("oblique", 1),
    ] {
        let file = root(&format!("spec/examples/{name}.json"));
        let listed = mceip(&["enumerate", &file, "--json"]);
        assert_eq!(listed.status.code(), Some(0));
        let json: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
        assert_eq!(
            (
                json["claim"].as_str(),
                json["solutions"].as_array().unwrap().len()
            ),
            (Some("complete"), count)
        );
        let report = scratch(&folder, "report.json", &stdout(&listed));
        let certificate = folder.path().join(format!("{name}.certificate.json"));
        let (report, certificate) = (
            report.display().to_string(),
            certificate.display().to_string(),
        );
        assert_eq!(
            mceip(&["certify", &file, &report, "--out", &certificate])
                .status
                .code(),
            Some(0)
        );
        let accepted = mceip(&["check", &file, &certificate]);
        assert_eq!(accepted.status.code(), Some(0));
        assert!(stdout(&accepted).contains(&format!("ACCEPTED: {count} claim(s)")));
        let solved = folder.path().join("solved.json").display().to_string();
        let solve = mceip(&["solve", &file, "--all", "--json", "--certificate", &solved]);
        assert_eq!(solve.status.code(), Some(0));
        let json: serde_json::Value = serde_json::from_slice(&solve.stdout).unwrap();
        assert_eq!(
            (
                json["claim"].as_str(),
                json["solutions"].as_array().unwrap().len()
            ),
            (Some("solutions"), count)
        );
        assert_eq!(mceip(&["check", &file, &solved]).status.code(), Some(0));
        assert_eq!(
            mceip(&[
                "check",
                &root("spec/examples/two-particles.json"),
                &certificate
            ])
            .status
            .code(),
            Some(i32::from(name != "two-particles"))
        );
    }
}

#[test]
fn foreign_digits_suffice_and_false_ones_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let file = root("spec/examples/fold.json");
    let certify = |solutions: &str| {
        let text = format!(r#"{{"format":"mceip-solutions/1","solutions":{solutions}}}"#);
        mceip(&[
            "certify",
            &file,
            &scratch(&folder, "r.json", &text).display().to_string(),
        ])
        .status
        .code()
    };
    assert_eq!(
        certify(r#"[{"value":2.00000,"x":[0.666667,0.333333]}]"#),
        Some(0)
    );
    // No solution near 2.5; at 2 another x: both are proved, so the report is rejected.
    assert_eq!(
        certify(r#"[{"value":2.5,"x":[0.666667,0.333333]}]"#),
        Some(1)
    );
    assert_eq!(certify(r#"[{"value":2,"x":[0.333333,0.666667]}]"#), Some(1));
    assert_eq!(certify(r#"[{"value":2,"x":[0,0]}]"#), Some(1));
    assert_eq!(certify("[]"), Some(3));
    assert_eq!(certify(r#"[{"value":2,"x":[1]}]"#), Some(2));
    assert_eq!(certify(r#"[{"value":1e999,"x":[1,1]}]"#), Some(2));
    let foreign = r#"{"format":"mceip-solutions/1","problem_sha256":"00","solutions":[]}"#;
    assert_eq!(
        mceip(&[
            "certify",
            &file,
            &scratch(&folder, "f.json", foreign).display().to_string()
        ])
        .status
        .code(),
        Some(1)
    );
}

#[test]
fn reduced_and_condensed_problems_have_the_same_solutions() {
    let folder = tempfile::tempdir().unwrap();
    let file = root("spec/examples/two-particles-mu.json");
    let values = |path: &str| {
        let json: serde_json::Value =
            serde_json::from_slice(&mceip(&["enumerate", path, "--json"]).stdout).unwrap();
        json["solutions"]
            .as_array()
            .unwrap()
            .iter()
            .map(|s| s["value"].as_str().unwrap().to_string())
            .collect::<Vec<_>>()
    };
    let direct = values(&file);
    assert_eq!(direct, vec!["1.920286436967152"]); // sqrt(59)/5 / (4/5) = sqrt(59)/4
    for extra in [&["reduce", &file][..], &["reduce", &file, "--condense"]] {
        let path = scratch(&folder, "reduced.json", &stdout(&mceip(extra)));
        assert_eq!(values(&path.display().to_string()), direct);
    }
    refused(
        &mceip(&[
            "reduce",
            &root("spec/examples/two-particles.json"),
            "--condense",
        ]),
        &["E16", "lambda2"],
    );
}

#[test]
fn table1_agrees_and_verify_ends_with_a_verdict() {
    let table = mceip(&["table1"]);
    assert_eq!(table.status.code(), Some(0));
    assert!(stdout(&table).contains("closed form = enumerator = certified"));
    assert!(
        stdout(&mceip(&["table1", "--c", "0", "--s", "1"]))
            .lines()
            .filter(|l| l.contains("[0, 1]"))
            .count()
            == 2
    );
    let verify = mceip(&["verify", "--random", "4", "--json"]);
    assert_eq!(verify.status.code(), Some(0));
    let json: serde_json::Value = serde_json::from_slice(&verify.stdout).unwrap();
    assert_eq!(json["disagreements"], 0);
    assert!(json["verdict"].as_str().unwrap().starts_with("VERIFIED"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_found() {
    let child = Command::new(env!("CARGO_BIN_EXE_mceip"))
        .arg("verify")
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(3));
    assert!(
        Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(stdout(&output).contains("INTERRUPTED: no disagreement"));
}
