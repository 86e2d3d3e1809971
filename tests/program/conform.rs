//! The conformance pack and `mceip conform`: the committed pack is the regenerated one, right
//! answers are called correct and wrong ones are not, foreign programs of every kind get the right
//! labels.
//!
//! The exact answer of each case is known. It is written in other ways, which must stay correct,
//! and falsified in every way of [`Bug`], each with its expected label; `certify`, `check` and the
//! enumerator refute it by their own means.
#![cfg(feature = "cli")]

use crate::common::{decimal, exits, exits_with_json, read, refused, repository, run_words};
use crate::program::Folder;
use mceip_engine::foreign::{Effort, ForeignReport, ForeignVerdict, judge};
use mceip_engine::run::Watch;
use mceip_model::file::read_problem;
use mceip_testkit::conform::{Bug, Case, Flag, Label, groups};
use rayon::prelude::*;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The files below a folder, by their paths in it.
fn files_below(folder: &Path) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];

    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }

            let name = path.strip_prefix(folder).unwrap().display().to_string();
            files.insert(name, std::fs::read_to_string(&path).unwrap());
        }
    }

    files
}

/// `mceip conform --write spec/conformance-pack` after a change of the groups, and look at the
/// difference.
#[test]
fn the_committed_pack_is_the_regenerated_one() {
    let folder = Folder::new();
    exits(0, &format!("conform --write {}", folder.path("pack")));

    let committed = files_below(Path::new(&repository("spec/conformance-pack")));
    let regenerated = files_below(Path::new(&folder.path("pack")));

    let names: Vec<&String> = regenerated.keys().collect();
    assert_eq!(names, committed.keys().collect::<Vec<_>>());

    let mut bytes = 0;
    for (name, text) in &regenerated {
        assert!(
            committed[name] == *text,
            "{name} differs: mceip conform --write"
        );
        bytes += text.len();
    }

    assert!(bytes < 3_000_000, "{bytes}");

    let index: Value = serde_json::from_str(&regenerated["index.json"]).unwrap();
    for flag in Flag::ALL {
        let word = flag.word();
        assert!(!index["flags"][word].is_null(), "no case for {word}");
    }
}

/// The schemas of the pack refer to each other and to nothing outside.
#[test]
fn the_pack_stands_alone() {
    let files = files_below(Path::new(&repository("spec/conformance-pack")));

    let mut references = 0;
    for (name, text) in files
        .iter()
        .filter(|(name, _)| name.starts_with("schemas/"))
    {
        for (_, rest) in text
            .match_indices("\"$ref\": \"")
            .map(|(k, m)| text.split_at(k + m.len()))
        {
            let target = rest.split('"').next().unwrap();
            let is_here = files.contains_key(&format!("schemas/{target}"));
            assert!(
                target.starts_with('#') || is_here,
                "{name} refers to {target}"
            );
            references += usize::from(is_here);
        }
    }
    assert_eq!(references, 3);

    for (name, text) in &files {
        let leads_out = text.contains("](../") || text.contains("](/");
        assert!(!leads_out, "{name} has a link that leaves the folder");
    }
}

/// All cases of the pack with their exact answers.
fn cases() -> Vec<Case> {
    let groups = groups().unwrap();
    let drafts: Vec<_> = groups.into_iter().flat_map(|group| group.drafts).collect();
    drafts
        .par_iter()
        .map(|draft| Case::answer(draft, false, &Watch::nobody()).unwrap())
        .collect()
}

/// A report on a case with these solutions and the continua of the exact answer.
fn report(answer: &Value, solutions: &[Value]) -> String {
    let report = json!({
        "format": "mceip-solutions/1",
        "solutions": solutions,
        "continua": answer["continua"],
    });

    report.to_string()
}

#[track_caller]
fn is_judged_correct(case: &Case, report: &str) {
    let judged = case.judge(report);
    assert_eq!(
        judged.label,
        Label::Correct,
        "{}: {}",
        case.id,
        judged.detail
    );
}

/// Value and x of a solution, x three times as long.
fn scaled(solution: &Value) -> Value {
    let x = solution["x"].as_array().unwrap();
    let scaled: Vec<f64> = x.iter().map(|entry| 3.0 * decimal(entry)).collect();
    json!({ "value": solution["value"], "x": scaled })
}

/// Value and x of a solution to six digits.
fn rounded(solution: &Value) -> Value {
    let x = solution["x"].as_array().unwrap();
    let rounded: Vec<String> = x.iter().map(six_digits).collect();
    json!({ "value": six_digits(&solution["value"]), "x": rounded })
}

fn six_digits(value: &Value) -> String {
    format!("{:.5e}", decimal(value))
}

/// The exact answer, the same with value and x alone, in reverse, twice and in another scale.
#[test]
fn right_answers_are_correct_in_any_order_and_scale() {
    let all = cases();

    all.par_iter().for_each(|case| {
        let answer = case.answer_json();
        is_judged_correct(case, &answer.to_string());

        let listed = answer["solutions"].as_array().unwrap();
        let reversed: Vec<Value> = listed.iter().rev().map(scaled).collect();
        let twice = [reversed.clone(), reversed].concat();
        is_judged_correct(case, &report(&answer, &twice));
    });

    let ids: BTreeSet<&String> = all.iter().map(|case| &case.id).collect();
    assert_eq!(ids.len(), all.len(), "every id once");
}

/// Six digits suffice where the flags do not say that they cannot.
#[test]
fn six_digits_are_enough_away_from_close_values() {
    let mut all = cases();
    all.retain(|case| {
        let needs_more = [Flag::CloseValues, Flag::TinyComponent, Flag::NearThreshold];
        !needs_more.iter().any(|flag| case.flags.contains(flag))
    });

    assert!(all.len() > 150, "{}", all.len());

    // A value at a closed end of the window may be rounded to the outside: it counts as the end.
    all.par_iter().for_each(|case| {
        let answer = case.answer_json();
        let listed = answer["solutions"].as_array().unwrap();
        let rounded: Vec<Value> = listed.iter().map(rounded).collect();
        is_judged_correct(case, &report(&answer, &rounded));
    });
}

/// A value moved by so much, relative to 1 + |value|.
fn moved(solution: &Value, by: f64) -> Value {
    let value = decimal(&solution["value"]);
    json!({ "value": value + by * (1.0 + value.abs()), "x": solution["x"] })
}

fn has_bug(case: &Case, bug: Bug) -> bool {
    case.wrong_answers().iter().any(|wrong| wrong.bug == bug)
}

/// Too few digits are inaccurate, with the distance; farther away, or beside a false solution, a
/// report is wrong.
#[test]
fn too_few_digits_are_inaccurate() {
    let cases = cases();
    let has_fold = |case: &&Case| case.flags.contains(&Flag::Fold) && case.has_solutions();
    let case = cases.iter().find(has_fold).unwrap();
    let answer = case.answer_json();
    let solution = &answer["solutions"][0];

    let near = case.judge(&report(&answer, &[moved(solution, 5e-4)]));
    assert_eq!(near.label, Label::Inaccurate, "{near:?}");
    for words in ["off by 5.0e-4 in the value", "is not certified"] {
        assert!(near.detail.contains(words), "{near:?}");
    }

    let far = case.judge(&report(&answer, &[moved(solution, 5e-3)]));
    assert_eq!(far.label, Label::Wrong, "{far:?}");
    for words in ["off by 5.0e-3 in the value", "is not certified"] {
        assert!(far.detail.contains(words), "{far:?}");
    }

    let both = [moved(solution, 5e-4), moved(solution, 5e-3)];
    let both = case.judge(&report(&answer, &both));
    assert_eq!(both.label, Label::Wrong, "{both:?}");

    // A solution outside the window is false, also where one inside is near.
    let window = cases
        .iter()
        .find(|case| has_bug(case, Bug::OutsideWindow))
        .unwrap();
    let outside = window.wrong_answers();
    let outside = outside.iter().find(|wrong| wrong.bug == Bug::OutsideWindow);
    let judged = window.judge(&outside.unwrap().report.to_string());
    assert_eq!(judged.label, Label::Wrong, "{judged:?}");

    // Another support is another solution, however near.
    let tiny = cases.iter().find(|case| case.id == "tiny-3").unwrap();
    let without = json!({ "value": 1.001, "x": [1, 0] });
    let cut = tiny.judge(&report(&tiny.answer_json(), &[without]));
    assert_eq!(cut.label, Label::Wrong, "{cut:?}");
}

/// The answer has -2 and 3, or a cone at -2, or a continuum, of which no value is nearest.
#[test]
fn a_wrong_value_is_compared_with_those_of_the_answer() {
    let cases = cases();
    let detail = |id: &str, value: f64, x: &[i32]| {
        let case = cases.iter().find(|case| case.id == id).unwrap();
        let text = report(&case.answer_json(), &[json!({ "value": value, "x": x })]);
        let judged = case.judge(&text);
        assert_eq!(judged.label, Label::Wrong, "{judged:?}");
        judged.detail
    };

    let flipped = "solution 0: the answer has -2: the sign of the value is flipped";
    let nearest = "solution 0: the nearest solution of the answer has the value ";
    for (id, value, x, begin) in [
        ("eigenvalue-00", 2.0, &[1, 0][..], flipped.to_owned()),
        // With the x of 3 it is no -2 of the other sign.
        (
            "eigenvalue-00",
            2.0,
            &[0, 1],
            format!("{nearest}3: off by 2.5e-1"),
        ),
        (
            "eigenvalue-00",
            5.0,
            &[0, 1],
            format!("{nearest}3: off by 5.0e-1"),
        ),
        (
            "eigenvalue-00",
            3.0,
            &[1, 0],
            format!("{nearest}3: off by 0.0e0"),
        ),
        ("eigenvalue-04", 2.0, &[1, 1, 2], flipped.to_owned()),
        (
            "eigenvalue-04",
            -5.0,
            &[1, 1, 2],
            format!("{nearest}-2: off by 1.0e0"),
        ),
        (
            "eigenvalue-11",
            5.0,
            &[1, 0, 0],
            "solution 0: value 5 is not certified".into(),
        ),
    ] {
        let detail = detail(id, value, x);
        assert!(detail.starts_with(&begin), "{id} {value}: {detail}");
    }
}

/// Every wrong answer gets its label, and what is false in it is refuted by certify, check and
/// enumeration.
#[test]
fn wrong_answers_are_rejected() {
    let all = cases();
    let bugs: Vec<Vec<Bug>> = all.par_iter().map(wrong_answers_of_a_case).collect();

    let mut counts: BTreeMap<Bug, usize> = BTreeMap::new();
    for bug in bugs.into_iter().flatten() {
        *counts.entry(bug).or_default() += 1;
    }

    let total: usize = counts.values().sum();
    assert_eq!(
        counts.len(),
        Bug::ALL.len(),
        "every kind of bug: {counts:?}"
    );
    assert!(total > 500, "{counts:?}");
}

/// Judges the wrong answers of a case; the kind of each.
fn wrong_answers_of_a_case(case: &Case) -> Vec<Bug> {
    let mut bugs = Vec::new();

    for wrong in case.wrong_answers() {
        let bug = wrong.bug;
        let text = wrong.report.to_string();
        let judged = case.judge(&text);

        assert_eq!(
            judged.label,
            bug.expected(),
            "{} {bug:?}: {}",
            case.id,
            judged.detail
        );

        let report = ForeignReport::read(&text, case.problem(), case.reduced()).unwrap();
        if bug.expected() == Label::Wrong && bug != Bug::EndlessContinuum {
            first_solution_is_refuted(case, bug, &report);
        }

        bugs.push(bug);
    }
    bugs
}

fn first_solution_is_refuted(case: &Case, bug: Bug, report: &ForeignReport) {
    let solution = report.solutions[0].as_ref().unwrap();
    let verdict = judge(&case.signs, solution, 1e-6, &mut Effort::default());

    // (1, 0) at t = 1 + 1e-5 is wrong, and as near to the solution (1, 1e-5) at t = 1 as its
    // rounding would be.
    let is_refuted = match verdict {
        ForeignVerdict::Rejected(_) | ForeignVerdict::Inaccurate { .. } => true,
        ForeignVerdict::Undecided { .. } => case.flags.contains(&Flag::TinyComponent),
        _ => false,
    };

    assert!(is_refuted, "{} {bug:?}: {verdict:?}", case.id);
}

/// The end of `conform` on a program.
#[derive(Debug, PartialEq)]
struct Conformed {
    code: Option<i32>,
    text: String,
}

impl Conformed {
    /// The text is a JSON report.
    #[track_caller]
    fn report(&self) -> Value {
        serde_json::from_str(&self.text).unwrap()
    }
}

fn conform(options: &[&str], command: &[&str]) -> Conformed {
    let run = run_words(&[&["conform"][..], options, &["--"], command].concat());
    Conformed {
        code: run.code,
        text: run.stdout,
    }
}

#[test]
fn our_own_programs_conform() {
    let ours = env!("CARGO_BIN_EXE_mceip");
    let enumerator = conform(&[], &[ours, "enumerate", "-", "--json"]);
    assert_eq!(enumerator.code, Some(0), "{enumerator:?}");

    let options = ["--only", "fold", "--only", "threshold", "--json"];
    let solver = conform(&options, &[ours, "solve", "-", "--json"]);
    let labels = &solver.report()["labels"];

    assert!(labels["correct"].as_u64().unwrap() > 10, "{solver:?}");
    for label in ["wrong", "crashed", "malformed"] {
        assert!(labels[label].is_null(), "{label}: {solver:?}");
    }
}

/// A line of the shell that prints a report of another version.
#[cfg(unix)]
const OTHER_FORMAT: &str = r#"echo '{"format":"mceip-solutions/2","solutions":[]}'"#;
/// One that prints an x of the wrong length.
#[cfg(unix)]
const SHORT_X: &str = r#"echo '{"format":"mceip-solutions/1","solutions":[{"value":1,"x":[1]}]}'"#;
/// One that prints a number beyond doubles.
#[cfg(unix)]
const HUGE_VALUE: &str =
    r#"echo '{"format":"mceip-solutions/1","solutions":[{"value":1e999,"x":[1,1]}]}'"#;
/// One that prints a report without solutions.
#[cfg(unix)]
const NOTHING_FOUND: &str = r#"echo '{"format":"mceip-solutions/1","solutions":[]}'"#;
/// One that prints a report on another problem.
#[cfg(unix)]
const OTHER_PROBLEM: &str =
    r#"echo '{"format":"mceip-solutions/1","problem_sha256":"00","solutions":[]}'"#;

/// A program that does not end in time.
#[cfg(unix)]
const SLEEPING: &str = "exec sleep 60";

/// Seconds for a program: enough to start on a busy machine, few for one that sleeps.
#[cfg(unix)]
fn time_limit(script: &str) -> &'static str {
    if script == SLEEPING { "0.5" } else { "30" }
}

/// One label for all of a few cases, whatever the program does.
#[cfg(unix)]
#[test]
fn hostile_programs_get_their_labels() {
    for (script, label) in [
        ("cat > /dev/null; echo nonsense", "malformed"),
        ("true", "malformed"),
        (OTHER_FORMAT, "malformed"),
        (SHORT_X, "malformed"),
        (HUGE_VALUE, "malformed"),
        ("yes", "malformed"),
        ("printf '\\377'", "malformed"),
        ("cat; exit 1", "crashed"),
        ("kill -11 $$", "crashed"),
        (SLEEPING, "timed out"),
        (NOTHING_FOUND, "incomplete"),
        (OTHER_PROBLEM, "wrong"),
    ] {
        let only = ["--only", "window_end", "--json"];
        let options = [&only[..], &["--time-limit", time_limit(script)]].concat();
        let ended = conform(&options, &["sh", "-c", script]);
        let report = ended.report();

        let cases = report["cases"].as_u64().unwrap();
        assert_eq!(ended.code, Some(1), "{script}: {ended:?}");
        assert!(cases > 4, "{script}: {ended:?}");
        assert_eq!(report["labels"][label], cases, "{script}: {ended:?}");
    }
}

/// Options for thirty random problems of a seed, whose table goes to a page.
#[cfg(unix)]
fn random_cases<'a>(threads: &'a str, seed: &'a str, page: &'a str) -> [&'a str; 10] {
    [
        "--threads",
        threads,
        "--count",
        "30",
        "--seed",
        seed,
        "--only",
        "random",
        "--markdown",
        page,
    ]
}

/// A program that answers many problems is judged as one that is started for each; one that hangs
/// or ends is started anew for the next case.
#[cfg(unix)]
#[test]
fn programs_may_answer_line_by_line() {
    let by_lines = |script: &str| {
        let only = ["--only", "window_end", "--json", "--lines"];
        let options = [&only[..], &["--time-limit", time_limit(script)]].concat();
        conform(&options, &["sh", "-c", script]).report()
    };

    for (script, label) in [
        (
            format!("while read -r p; do {NOTHING_FOUND}; done"),
            "incomplete",
        ),
        (
            format!("while read -r p; do {OTHER_PROBLEM}; done"),
            "wrong",
        ),
        ("while read -r p; do echo; done".into(), "malformed"),
        ("exec yes".into(), "malformed"),
        ("read -r p; exit 0".into(), "malformed"),
        ("read -r p; exit 3".into(), "malformed"),
        ("read -r p; exit 1".into(), "crashed"),
        ("kill -11 $$".into(), "crashed"),
        (SLEEPING.into(), "timed out"),
    ] {
        let report = by_lines(&script);
        let cases = report["cases"].as_u64().unwrap();
        assert!(cases > 4, "{script}: {report:#}");
        assert_eq!(report["labels"][label], cases, "{script}: {report:#}");
    }
}

/// A program that reads to the end of its input is told what `--lines` asks for.
#[cfg(unix)]
#[test]
fn a_program_that_waits_for_the_end_of_its_input_is_told_what_lines_are() {
    let options = ["--case", "window-00", "--json", "--time-limit", "0.5"];
    let waits = format!("cat > /dev/null; {NOTHING_FOUND}");
    let by_lines = [&options[..], &["--lines"]].concat();
    let report = conform(&by_lines, &["sh", "-c", &waits]).report();

    let failure = &report["failures"][0];
    assert_eq!(failure["label"], "timed out", "{report:#}");
    let detail = failure["detail"].as_str().unwrap();
    assert!(
        detail.contains("does not read to the end of its input"),
        "{detail}"
    );

    let report = conform(&options, &["sh", "-c", SLEEPING]).report();
    assert_eq!(report["failures"][0]["detail"], "still running after 0.5 s");
}

/// A program that hangs after it has answered a line knows what lines are.
#[cfg(unix)]
#[test]
fn a_program_that_hangs_after_an_answer_is_not_told_what_lines_are() {
    let folder = Folder::new();
    let answered = folder.path("answered");
    let once = format!(
        "while read -r p; do if mkdir {answered}; then {NOTHING_FOUND}; else {SLEEPING}; fi; done"
    );
    let cases = ["--case", "window-00", "--case", "window-01"];
    let lines = ["--lines", "--threads", "1", "--json", "--time-limit", "0.5"];
    let options = [&cases[..], &lines].concat();

    let report = conform(&options, &["sh", "-c", &once]).report();

    let failures = report["failures"].as_array().unwrap();
    let timed_out = failures.iter().find(|f| f["label"] == "timed out");
    assert_eq!(
        timed_out.unwrap()["detail"],
        "still running after 0.5 s without a line for this problem; it has answered others"
    );
}

/// What a program prints beyond its answer, or that it ends after it, is not charged to the next
/// case, however quick the machine is.
#[cfg(unix)]
#[test]
fn what_a_case_has_left_behind_is_no_answer_to_the_next() {
    let judged = |script: &str| {
        let options = [
            "--only",
            "window_end",
            "--json",
            "--lines",
            "--threads",
            "1",
        ];
        conform(&options, &["sh", "-c", script]).report()["labels"].clone()
    };

    let right = judged(&format!("while read -r p; do {NOTHING_FOUND}; done"));
    for script in [
        format!("while read -r p; do {NOTHING_FOUND}; echo more; done"),
        format!("while read -r p; do {NOTHING_FOUND}; sleep 0.05; {OTHER_PROBLEM}; done"),
        format!("read -r p; {NOTHING_FOUND}; exit 7"),
    ] {
        assert_eq!(judged(&script), right, "{script}");
    }
}

#[cfg(unix)]
#[test]
fn threads_do_not_change_the_output() {
    let program = ["sh", "-c", NOTHING_FOUND];
    let folder = Folder::new();
    let first_page = folder.path("one.md");
    let second_page = folder.path("four.md");
    let third_page = folder.path("other.md");

    let by_one = conform(&random_cases("1", "7", &first_page), &program);
    let by_four = conform(&random_cases("4", "7", &second_page), &program);
    assert_eq!(by_one, by_four);
    assert!(by_one.text.contains("150 cases"), "{by_one:?}");

    let page = read(&first_page);
    assert_eq!(page, read(&second_page));
    assert!(page.contains("| random | 150 |"), "{page}");
    let settings = "; the pack of the program; --only random; --count 30 --seed 7; --time-limit ";
    assert!(page.contains(settings), "{page}");

    let other = conform(&random_cases("1", "8", &third_page), &program);
    assert_ne!(by_one.text, other.text, "another seed, other cases");
}

#[test]
fn damaged_packs_are_refused() {
    let good = read(&repository("spec/conformance-pack/folds.json"));
    let digest = sha256(&good);
    let undamaged = Pack::of("folds.json", &good, &digest);
    let ours = [env!("CARGO_BIN_EXE_mceip"), "enumerate", "-", "--json"];
    let ended = conform(&["--pack", &undamaged.0.path("")], &ours);

    assert_eq!(ended.code, Some(0), "{ended:?}");

    let other_digest = Pack::of("folds.json", &good, &"0".repeat(64));
    other_digest.is_refused(&["folds.json", "sha256"]);

    let outside = Pack::of("../folds.json", &good, &digest);
    outside.is_refused(&["../folds.json"]);

    let kernel = "\"kernel_dimension\":1";
    assert!(good.contains(kernel));

    let other_answer = good.replacen(kernel, "\"kernel_dimension\":2", 1);
    Pack::of("folds.json", &other_answer, &sha256(&other_answer))
        .is_refused(&["fold-00", "not the exact one"]);

    let other_flag = good.replacen("\"fold\"", "\"unfold\"", 1);
    Pack::of("folds.json", &other_flag, &sha256(&other_flag)).is_refused(&["unfold"]);

    let cut = &good[..good.len() / 2];
    Pack::of("folds.json", cut, &sha256(cut)).is_refused(&["folds.json", "line"]);
}

fn sha256(text: &str) -> String {
    let bytes = Sha256::digest(text);
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A folder with a pack of one group.
struct Pack(Folder);

impl Pack {
    /// The group stands in `folds.json`; the index says this name and this digest.
    fn of(name: &str, group: &str, digest: &str) -> Pack {
        let entry = json!({
            "file": name,
            "comment": "",
            "cases": 1,
            "wrong": 0,
            "sha256": digest,
        });
        let index = json!({
            "format": "mceip-pack-index/1",
            "cases": 1,
            "groups": [entry],
            "flags": {},
            "bugs": {},
        });

        let folder = Folder::new();
        folder.write("index.json", &index.to_string());
        folder.write("folds.json", group);

        Pack(folder)
    }

    #[track_caller]
    fn is_refused(&self, words: &[&str]) {
        let path = self.0.path("");
        refused(&format!("conform --pack {path} -- true"), words);
    }
}

/// The page has a row for each flag, with the words of the terminal.
#[test]
fn the_page_lists_every_flag_as_the_terminal_does() {
    let page = read(&repository("spec/conform.md"));
    let printed = exits(0, "conform --flags");

    assert_eq!(printed.lines().count(), Flag::ALL.len());
    for flag in Flag::ALL {
        let row = format!("| `{}` | {} |", flag.word(), flag.note());
        assert!(page.contains(&row), "{row}");
        assert!(printed.contains(flag.note()), "{printed}");
    }
}

#[test]
fn cases_are_listed_printed_and_run_one_by_one() {
    let list = exits(0, "conform --list --only fold");
    assert!(!list.is_empty());
    assert!(list.lines().all(|line| line.contains(" fold")), "{list}");

    let id = list.split_whitespace().next().unwrap();
    let case = cases().into_iter().find(|case| case.id == id).unwrap();
    let problem = exits(0, &format!("conform --print {id}"));
    let problem = read_problem(&problem, Path::new("."));
    assert_eq!(problem.unwrap().sha256(), case.problem().sha256());

    let whole = exits_with_json(0, &format!("conform --print {id} --json"));
    assert_eq!(whole["answer"], case.answer_json());

    let one = exits_with_json(1, &format!("conform --case {id} --json -- true"));
    assert_eq!(one["cases"], 1, "{one}");
}

/// `--except` leaves out what `--only` takes, in a list, a run and its settings.
#[test]
fn cases_are_left_out_by_their_flags() {
    let ids = |options: &str| -> Vec<String> {
        let list = exits(0, &format!("conform --list {options}"));
        let lines = list.lines();
        lines
            .map(|line| line.split(' ').next().unwrap().to_owned())
            .collect()
    };
    let all = ids("--only eigenvalue");
    let linear = ids("--only eigenvalue --except quadratic");
    let quadratic = ids("--only quadratic");
    assert!(linear.len() > 20 && quadratic.len() > 20);
    assert_eq!(linear.len() + quadratic.len(), all.len());
    assert!(quadratic.iter().all(|id| !linear.contains(id)));

    // Of five random cases one is an eigenvalue problem.
    let random = |except: &str| {
        let options = format!("--case eigenvalue-00 --count 30 {except} --json");
        exits_with_json(1, &format!("conform {options} -- true"))
    };
    assert_eq!(random("--only eigenvalue")["cases"], 7);
    assert_eq!(random("--except eigenvalue")["cases"], 24);
    assert!(random("--only quadratic")["cases"].as_u64() > Some(1));

    let options = "--only quadratic --except one_by_one --except random";
    let expected = ids(options).len();
    let run = exits_with_json(1, &format!("conform {options} --json -- true"));
    assert_eq!(run["cases"], expected, "{run:#}");
    let settings = run["settings"].as_str().unwrap();
    let said = "; --only quadratic; --except one_by_one; --except random; ";
    assert!(settings.contains(said), "{settings}");

    refused(
        "conform --only eigenvalue --except pencil -- true",
        &["flags that leave a case to run"],
    );
    refused(
        "conform --except folds -- true",
        &["except", "a flag that --flags lists"],
    );
}
