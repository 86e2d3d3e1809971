//! Tier 2 of the conformance pack, and what `mceip conform` does with a run: anonymous cases, runs
//! as JSON and side by side, export.
//!
//! The truth of a proved case is its list, which the reader has held against a search of its own.
//! Lists that were changed, runs of other cases and damaged files have to be refused.
#![cfg(feature = "cli")]

use crate::common::{exits, exits_with_json, read, refused, repository, run, run_words};
use crate::program::Folder;
use mceip_engine::run::Watch;
use mceip_model::file::read_problem;
use mceip_testkit::TestkitError;
use mceip_testkit::conform::{
    Case, CaseAnswer, CasePack, Completeness, Difficulty, Draft, Label, PACK_VERSION, read_pack,
};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;

fn tier2() -> CasePack {
    read_pack(Path::new(&repository("spec/conformance-pack-2"))).unwrap()
}

/// The draft of tier 2 with this id.
fn draft(id: &str) -> Draft {
    let groups = tier2().groups;
    let mut drafts = groups.into_iter().flat_map(|group| group.drafts);
    drafts.find(|draft| draft.id == id).unwrap()
}

/// A draft with its list changed.
fn with_list(draft: &Draft, change: impl FnOnce(&mut Vec<Value>)) -> Draft {
    let mut changed = draft.clone();
    let list = changed.listed.as_mut().unwrap();
    change(list["solutions"].as_array_mut().unwrap());
    changed
}

#[track_caller]
fn is_refused(draft: &Draft) {
    let refused = Case::answer(draft, false, &Watch::nobody());
    assert!(
        matches!(refused, Err(TestkitError::Answer { .. })),
        "{refused:?}"
    );
}

#[test]
fn every_case_says_what_is_known_and_how_hard_it_is() {
    let pack = tier2();
    assert_eq!(
        (pack.name.tier, pack.name.version.as_str()),
        (2, PACK_VERSION)
    );

    let mut ids = BTreeSet::new();
    let mut kinds = BTreeSet::new();
    let mut difficulties = BTreeSet::new();
    for draft in pack.groups.iter().flat_map(|group| &group.drafts) {
        assert!(ids.insert(draft.id.clone()), "{}", draft.id);
        assert_eq!(draft.listed.is_some(), draft.completeness.is_some());
        kinds.insert(draft.completeness);
        difficulties.insert(draft.difficulty.expect(&draft.id));
    }

    let all = [
        None,
        Some(Completeness::Proved),
        Some(Completeness::BestKnown),
    ];
    assert_eq!(kinds, BTreeSet::from(all));
    assert_eq!(difficulties.len(), Difficulty::ALL.len());
    assert!(ids.len() > 50, "{}", ids.len());

    let folder = std::fs::read_dir(repository("spec/conformance-pack-2")).unwrap();
    let bytes: u64 = folder
        .map(|file| file.unwrap().metadata().unwrap().len())
        .sum();
    assert!(bytes < 6_000_000, "{bytes}");
}

/// `mceip conform --write spec/conformance-pack-2 --tier 2 --difficulty spec/rivals/tier2-*.json`
/// after a change of the groups.
#[test]
#[ignore = "minutes"]
fn the_committed_tier_2_is_the_regenerated_one() {
    let folder = Folder::new();
    let runs = ["semismooth-newton", "siconos"]
        .map(|rival| repository(&format!("spec/rivals/tier2-{rival}.json")));
    let place = folder.path("pack");
    exits(
        0,
        &format!(
            "conform --write {place} --tier 2 --difficulty {}",
            runs.join(" ")
        ),
    );

    for file in std::fs::read_dir(&place).unwrap() {
        let path = file.unwrap().path();
        if path.is_file() {
            let name = path.file_name().unwrap().display().to_string();
            let committed = read(&repository(&format!("spec/conformance-pack-2/{name}")));
            assert!(
                committed == std::fs::read_to_string(&path).unwrap(),
                "{name} differs"
            );
        }
    }
}

/// Every answer of the folder is found or certified anew, and every wrong answer has its label.
#[test]
#[ignore = "minutes"]
fn every_answer_of_tier_2_holds() {
    for draft in tier2().groups.iter().flat_map(|group| &group.drafts) {
        let case = Case::answer(draft, false, &Watch::nobody()).unwrap();
        let own = case.judge(&case.answer_json().to_string());
        assert_eq!(own.label, Label::Correct, "{}: {}", case.id, own.detail);
        assert_eq!(own.found, case.parts(), "{}", case.id);

        for wrong in case.wrong_answers() {
            let judged = case.judge(&wrong.report.to_string());
            let what = format!("{} {:?}: {}", case.id, wrong.bug, judged.detail);
            assert_eq!(judged.label, wrong.bug.expected(), "{what}");
        }
    }
}

/// The list of a proved case is the set that the search finds: one too few, one twice, another
/// support or another value are refused.
#[test]
fn a_proved_list_is_held_against_a_search() {
    let draft = draft("eicp-1");
    let case = Case::answer(&draft, false, &Watch::nobody()).unwrap();
    let CaseAnswer::Certified(answer) = &case.answer else {
        panic!("{}: expected a certified answer", case.id)
    };
    assert!(answer.cover.open.is_empty() && case.parts() > 1);
    assert_eq!(case.completeness(), Some(Completeness::Proved));

    let own = case.judge(&case.answer_json().to_string());
    assert_eq!((own.label, own.found), (Label::Correct, case.parts()));
    for wrong in case.wrong_answers() {
        let judged = case.judge(&wrong.report.to_string());
        assert_eq!(judged.label, wrong.bug.expected(), "{:?}", wrong.bug);
    }

    is_refused(&with_list(&draft, |list| drop(list.pop())));
    is_refused(&with_list(&draft, |list| list.push(list[0].clone())));
    is_refused(&with_list(&draft, |list| list[0]["value"] = json!("1e3")));
    is_refused(&with_list(&draft, |list| list[0]["slip"] = json!([])));
}

/// What is proved or best known is about values of one sign.
#[test]
fn values_of_both_signs_have_exact_answers_only() {
    let groups = mceip_testkit::conform::groups().unwrap();
    let mut drafts = groups.into_iter().flat_map(|group| group.drafts);
    let exact = drafts
        .find(|draft| draft.problem.reflected().is_some())
        .unwrap();
    for completeness in [Completeness::Proved, Completeness::BestKnown] {
        let said = Draft {
            completeness: Some(completeness),
            ..exact.clone()
        };
        let refused = Case::answer(&said, false, &Watch::nobody()).unwrap_err();
        let text = refused.to_string();
        assert!(text.contains("values of both signs"), "{text}");
    }
}

/// A certified solution that a best known list does not have is counted, and is no error; an
/// invented one is wrong there, too.
#[test]
fn a_best_known_list_may_be_improved() {
    let whole = draft("eicp-6");
    let report = whole.listed.clone().unwrap().to_string();
    let short = with_list(&whole, |list| drop(list.pop()));
    let case = Case::answer(&short, false, &Watch::nobody()).unwrap();
    assert_eq!(case.completeness(), Some(Completeness::BestKnown));
    assert!(case.parts() > 0);

    let improved = case.judge(&report);
    assert_eq!(improved.label, Label::Correct, "{}", improved.detail);
    assert_eq!((improved.found, improved.unlisted), (case.parts(), 1));

    let nothing = case.judge(r#"{"format": "mceip-solutions/1", "solutions": []}"#);
    assert_eq!((nothing.label, nothing.found), (Label::Incomplete, 0));
    for wrong in case.wrong_answers() {
        let judged = case.judge(&wrong.report.to_string());
        assert_eq!(judged.label, wrong.bug.expected(), "{:?}", wrong.bug);
    }

    is_refused(&with_list(&whole, |list| list[0]["value"] = json!("1e3")));

    // Else a program that finds nothing would be correct.
    let emptied = with_list(&whole, Vec::clear);
    let refused = Case::answer(&emptied, false, &Watch::nobody());
    let is_refused = matches!(refused, Err(TestkitError::NothingKnown { .. }));
    assert!(is_refused, "{refused:?}");
}

/// A system sent as its pencil has the same answer.
#[test]
fn a_certified_answer_holds_for_the_reduced_pencil() {
    let case = Case::answer(&draft("system-1"), true, &Watch::nobody()).unwrap();
    let answer = case.answer_json();
    assert_eq!(answer["problem_sha256"], case.problem().sha256());
    assert!(answer["variables"].is_null());

    let own = case.judge(&answer.to_string());
    assert_eq!(own.label, Label::Correct, "{}", own.detail);
}

#[cfg(unix)]
const NOTHING_FOUND: &str = r#"echo '{"format":"mceip-solutions/1","solutions":[]}'"#;

/// The problems that a program gets with these options, in the order in which it gets them.
#[cfg(unix)]
fn problems_sent(options: &[&str]) -> Vec<mceip_model::Problem> {
    let folder = Folder::new();
    let script = format!("while read -r p; do echo \"$p\" >> $0; {NOTHING_FOUND}; done");
    let log = folder.path("log");
    let chosen = ["conform", "--only", "cone", "--lines", "--threads", "1"];
    run_words(&[&chosen[..], options, &["--", "sh", "-c", &script, &log]].concat());

    // What is not correct is asked again of a new program.
    let mut problems = Vec::new();
    for line in read(&log).lines() {
        let problem = read_problem(line, Path::new(".")).unwrap();
        if problems.last() != Some(&problem) {
            problems.push(problem);
        }
    }
    problems
}

#[cfg(unix)]
#[test]
fn anonymous_cases_are_the_same_problems_in_another_order_under_names_that_say_nothing() {
    let known = problems_sent(&[]);
    let unknown = problems_sent(&["--anonymous"]);
    let again = problems_sent(&["--anonymous"]);
    let other_seed = problems_sent(&["--anonymous", "--seed", "2"]);

    let digests = |list: &[mceip_model::Problem]| -> Vec<String> {
        list.iter().map(mceip_model::Problem::sha256).collect()
    };
    let set = |list| BTreeSet::from_iter(digests(list));
    assert_eq!(set(&known), set(&unknown));
    assert_ne!(digests(&known), digests(&unknown));
    assert_eq!(digests(&unknown), digests(&again));
    assert_ne!(digests(&unknown), digests(&other_seed));

    for problem in &unknown {
        let name = problem.name.as_deref().unwrap();
        let number = name.strip_prefix("problem ").unwrap();
        assert!(number.parse::<usize>().is_ok(), "{name}");
        assert_eq!(problem.comment, None);
    }
}

/// A run as JSON, of a program that finds nothing or of ours.
fn run_as_json(options: &[&str], command: &[&str]) -> Value {
    let options = [&["conform", "--json"][..], options, &["--"], command].concat();
    serde_json::from_str(&run_words(&options).stdout).unwrap()
}

#[cfg(unix)]
#[test]
fn a_run_as_json_has_every_case_and_the_score_of_always_none() {
    let only = ["--only", "window"];
    let run = run_as_json(&only, &["sh", "-c", NOTHING_FOUND]);

    let results = run["results"].as_array().unwrap();
    assert_eq!(run["cases"], results.len());
    assert_eq!(run["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(run["pack"], json!({ "tier": 1, "version": PACK_VERSION }));

    let score = &run["score"];
    assert_eq!(score["correct"], score["always_none"]);
    assert_eq!(score["correct_with_solutions"], 0);
    for result in results {
        let is_correct = result["label"] == "correct";
        assert_eq!(is_correct, result["expected"] == 0, "{result}");
        assert_eq!(result["found"], 0);
        assert!(result["seconds"].as_f64().unwrap() > 0.0);
    }

    let ours = [env!("CARGO_BIN_EXE_mceip"), "enumerate", "-", "--json"];
    let ours = run_as_json(&only, &ours);
    for result in ours["results"].as_array().unwrap() {
        assert_eq!(result["found"], result["expected"], "{result}");
    }
}

/// Tables and a picture of the two runs of the rivals; a run of other cases is refused.
#[test]
fn runs_are_compared_side_by_side() {
    let folder = Folder::new();
    let runs = ["semismooth-newton", "siconos"]
        .map(|rival| repository(&format!("spec/rivals/tier2-{rival}.json")));
    let latex = folder.path("table.tex");
    let svg = folder.path("profile.svg");
    let both = runs.join(" ");
    let markdown = exits(
        0,
        &format!("conform --compare {both} --latex {latex} --svg {svg}"),
    );

    assert!(markdown.contains("| tier2-siconos |"), "{markdown}");
    assert!(markdown.contains("| always none |"), "{markdown}");
    assert!(read(&latex).contains("\\toprule"));
    let picture = read(&svg);
    assert_eq!(picture.matches("class=\"series\"").count(), 2, "{picture}");

    let mut other: Value = serde_json::from_str(&read(&runs[0])).unwrap();
    other["results"].as_array_mut().unwrap().pop();
    let other = folder.write("other.json", &other.to_string());
    refused(
        &format!("conform --compare {} {other}", runs[0]),
        &["other", "cases"],
    );

    let cut = folder.write("cut.json", &read(&runs[0])[..500]);
    refused(&format!("conform --compare {} {cut}", runs[0]), &["cut"]);
    refused(
        &format!("conform --compare {} {}", runs[0], runs[0]),
        &["a name of its own"],
    );

    let mut slower: Value = serde_json::from_str(&read(&runs[1])).unwrap();
    slower["settings"] = json!("mceip 0.1.0; --as-pencil; --time-limit 20");
    let slower = folder.write("slower.json", &slower.to_string());
    refused(
        &format!("conform --compare {} {slower}", runs[0]),
        &["slower", "the options --as-pencil --lines"],
    );
    refused(&format!("conform --svg {svg} -- true"), &["--svg"]);
    refused("conform --tier 2 -- true", &["--tier", "--pack"]);
    refused("conform --difficulty a.json --list", &["--difficulty"]);
}

/// An exported case is read back to the same problem, and its answer belongs to it.
#[test]
fn exported_cases_are_read_back() {
    let folder = Folder::new();
    let place = folder.path("cases");
    let said = exits(
        0,
        &format!("conform --export-mtx {place} --only tiny_component --only oblique"),
    );
    assert!(said.contains(" cases in "), "{said}");

    let mut kinds = BTreeSet::new();
    for case in std::fs::read_dir(&place).unwrap() {
        let path = case.unwrap().path();
        let id = path.file_name().unwrap().display().to_string();
        let original = exits(0, &format!("conform --print {id}"));
        let original = read_problem(&original, Path::new(".")).unwrap();

        let problem = read(&path.join("problem.json").display().to_string());
        let problem = read_problem(&problem, &path).unwrap();
        assert_eq!(problem.sha256(), original.sha256(), "{id}");

        let answer = read(&path.join("answer.json").display().to_string());
        let answer: Value = serde_json::from_str(&answer).unwrap();
        assert_eq!(answer["problem_sha256"], problem.sha256(), "{id}");
        kinds.insert(path.join("K.mtx").exists());
    }
    assert_eq!(kinds.len(), 2, "pencils and systems");
}

/// The template for Octave gets the labels of the one for Python.
#[test]
#[cfg_attr(
    not(all(has_numpy, has_octave)),
    ignore = "needs Octave (Debian: octave) and python3 with numpy"
)]
fn the_templates_get_the_same_labels() {
    let python = repository("spec/examples/adapter.py");
    let octave = repository("spec/examples/adapter.m");
    let options = "conform --as-pencil --lines --json --time-limit 60 --only fold --only cone \
                   --only coupled_mass";

    let by_python = run(&format!("{options} -- python3 {python} --lines"));
    let by_octave = run(&format!("{options} -- octave-cli -q {octave} --lines"));
    let labels = |text: &str| -> Value {
        let run: Value = serde_json::from_str(text).unwrap();
        run["labels"].clone()
    };
    assert_eq!(labels(&by_python.stdout), labels(&by_octave.stdout));
    assert!(labels(&by_octave.stdout)["correct"].as_u64().unwrap() > 20);
}

/// A case of the folder is printed with what is known of it.
#[test]
fn a_case_of_tier_2_is_printed_with_what_is_known() {
    let pack = repository("spec/conformance-pack-2");
    let case = exits_with_json(
        0,
        &format!("conform --pack {pack} --print fold-10-past --json"),
    );
    assert_eq!(case["completeness"], "proved");
    assert_eq!(case["answer"]["solutions"], json!([]));
    assert!(case["difficulty"].is_string());
}
