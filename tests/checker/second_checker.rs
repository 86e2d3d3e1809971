//! `spec/checker.py` was written from the pages of spec/ alone. It and `mceip check` must agree: on
//! certificates of the worked examples, and on forgeries of them. The two share no code and no
//! author, so that a mistake of one is a difference. Without python3 the tests are ignored.
#![cfg(feature = "cli")]

use crate::json_places::places;
use crate::python_checker::codes;
use mceip_check::{AcceptedClaim, AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::{Interval, whole};
use serde_json::{Value, json};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const EXAMPLES: [&str; 4] = ["fold", "oblique", "two-particles", "two-particles-mu"];

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn example(name: &str) -> PathBuf {
    root(&format!("spec/examples/{name}.json"))
}

fn code(command: &mut Command) -> i32 {
    command.output().unwrap().status.code().unwrap()
}

/// The exit code of `mceip check`.
fn first_code(problem: &Path, certificate: &Path) -> i32 {
    let mut check = Command::new(env!("CARGO_BIN_EXE_mceip"));
    code(check.arg("check").arg(problem).arg(certificate))
}

/// The certificate that `complete` or `solve` writes for a problem.
fn written(command: &str, problem: &Path, folder: &Path) -> Value {
    let out = folder.join("written.json");
    let mut run = Command::new(env!("CARGO_BIN_EXE_mceip"));
    run.arg(command).arg(problem).arg("--certificate").arg(&out);
    assert_eq!(code(&mut run), 0, "{command} {}", problem.display());
    serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap()
}

fn is_no_object(value: &Value) -> bool {
    !value.is_object()
}

/// Words that stand for a leaf or an outcome.
const WORDS: [&str; 5] = [
    "open",
    "tail",
    "positive_definite",
    "negative_definite",
    "absent",
];

/// Lists lose an item or have one twice, numbers change sign or value, names change.
fn forge(value: &mut Value, turn: usize) {
    match value {
        Value::Array(items) if !items.is_empty() => forge_list(items, turn),
        Value::String(text) if is_number(text) => *text = forged_number(text, turn),
        Value::String(text) => *text = WORDS[turn % 5].into(),
        Value::Number(number) => {
            let old = number.as_i64();
            let new = match old {
                None => 0,
                Some(old) if turn.is_multiple_of(2) => -old,
                Some(old) => old + 1,
            };
            *value = Value::from(new);
        }
        other => *other = Value::from("3"),
    }
}

fn forge_list(items: &mut Vec<Value>, turn: usize) {
    let at = turn % items.len();
    if turn.is_multiple_of(2) {
        items.remove(at);
    } else {
        items.insert(at, items[at].clone());
    }
}

fn is_number(text: &str) -> bool {
    let digits = text.trim_start_matches('-');
    digits.starts_with(|first: char| first.is_ascii_digit())
}

fn forged_number(text: &str, turn: usize) -> String {
    match turn % 3 {
        0 => text
            .strip_prefix('-')
            .map_or(format!("-{text}"), String::from),
        1 => format!("{text}1"),
        _ => "0".into(),
    }
}

/// Certificates and forgeries of them about which both checkers are asked.
struct Comparison<'a> {
    folder: &'a Path,
    /// Problem and certificate.
    files: Vec<[PathBuf; 2]>,
}

impl Comparison<'_> {
    fn new(folder: &Path) -> Comparison<'_> {
        Comparison {
            folder,
            files: Vec::new(),
        }
    }

    /// Writes a certificate, which has to be accepted, and forgeries at places spread over it.
    fn add(&mut self, problem: &Path, certificate: &Value, places: &[String], forgeries: usize) {
        let unchanged = self.write(problem, certificate);
        assert_eq!(first_code(problem, &unchanged), 0, "{}", problem.display());

        for turn in 1..=forgeries {
            let place = &places[(turn - 1) * places.len() / forgeries];
            let mut forged = certificate.clone();
            forge(forged.pointer_mut(place).unwrap(), turn);
            self.write(problem, &forged);
        }
    }

    fn write(&mut self, problem: &Path, certificate: &Value) -> PathBuf {
        let file = self.folder.join(format!("{}.json", self.files.len()));
        std::fs::write(&file, certificate.to_string()).unwrap();
        self.files.push([problem.to_path_buf(), file.clone()]);
        file
    }

    /// How often both give each exit code.
    fn seen(&self) -> [usize; 4] {
        let mut seen = [0; 4];
        for (files, theirs) in self.files.iter().zip(codes(&self.files)) {
            let [problem, certificate] = files;
            let ours = first_code(problem, certificate);
            assert_eq!(
                ours,
                theirs,
                "mceip check and checker.py on {}: {}",
                std::fs::read_to_string(problem).unwrap(),
                std::fs::read_to_string(certificate).unwrap()
            );
            seen[usize::try_from(ours).unwrap()] += 1;
        }

        seen
    }
}

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn both_checkers_give_the_same_verdicts() {
    let folder = tempfile::tempdir().unwrap();
    let mut comparison = Comparison::new(folder.path());
    for name in EXAMPLES {
        let problem = example(name);
        for command in ["complete", "solve"] {
            let certificate = written(command, &problem, folder.path());
            let everywhere = places(&certificate, &is_no_object);
            comparison.add(&problem, &certificate, &everywhere, 8);
        }
    }

    let seen = comparison.seen();
    let [accepted, rejected, unreadable, _] = seen;
    assert!(accepted >= 8, "{seen:?}");
    assert!(rejected > 20, "{seen:?}");
    assert!(unreadable > 0, "{seen:?}");
}

#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn a_cover_with_an_open_leaf_is_undecided_for_both() {
    let folder = tempfile::tempdir().unwrap();
    let problem = example("fold");
    let mut certificate = written("complete", &problem, folder.path());
    certificate["complete_set"]["pieces"][0]["tree"] = json!(["open"]);
    let file = folder.path().join("open.json");
    std::fs::write(&file, certificate.to_string()).unwrap();

    assert_eq!(first_code(&problem, &file), 3);
    assert_eq!(codes(&[[problem, file]]), [3]);
}

/// A and B of degenerate pencils: a double root, a cone, ranges of values with irrational ends, a
/// star.
const DEGENERATE: [[&str; 2]; 4] = [
    ["[[-1,1],[0,-1]]", "[[1,0],[0,1]]"],
    ["[[-1,0],[0,-1]]", "[[1,0],[0,1]]"],
    ["[[0,2,-1],[0,-1,0],[1,0,-2]]", "[[0,-1,0],[0,0,1],[0,1,0]]"],
    ["[[0,1,1],[1,0,0],[1,0,0]]", "[[-1,0,0],[0,-1,0],[0,0,-1]]"],
];

/// The certificates of degenerate pencils hold support leaves, and a forgery at any place of one
/// gets the same verdict from both.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn both_checkers_agree_on_support_leaves() {
    let folder = tempfile::tempdir().unwrap();
    let mut comparison = Comparison::new(folder.path());

    for (k, [a, b]) in DEGENERATE.into_iter().enumerate() {
        let problem = folder.path().join(format!("problem-{k}.json"));
        let text = format!(
            r#"{{"format":"mceip-problem/1","unknown":"lambda2","pencil":{{"a":{a},"b":{b}}}}}"#
        );
        std::fs::write(&problem, text).unwrap();
        let certificate = written("complete", &problem, folder.path());

        let mut in_support_leaves = places(&certificate, &is_no_object);
        in_support_leaves.retain(|place| place.contains("/support/"));
        assert!(in_support_leaves.len() > 8, "{a} {b}");

        comparison.add(&problem, &certificate, &in_support_leaves, 16);
    }

    let seen = comparison.seen();
    let [accepted, rejected, _, _] = seen;
    assert!(accepted >= 4, "{seen:?}");
    assert!(rejected > 20, "{seen:?}");
}

/// One process: for each case whether `belongs` gives the claim a place in the cover.
const BELONGS: &str = "
import json, sys
from fractions import Fraction as Q
from types import SimpleNamespace
sys.path.insert(0, sys.argv[1])
import checker
STATES = {'rest': checker.REST, 'moving': checker.MOVING, 'undecided': checker.OPEN}
def ends(pair):
    return pair and (Q(pair[0]), Q(pair[1]))
for line in sys.stdin:
    case = json.loads(line)
    a, b = ends(case['claim'])
    single = [SimpleNamespace(support=tuple(s), a=Q(v[0]), b=Q(v[1])) for s, v in case['single']]
    families = [(tuple(s), ends(first), ends(last), False) for s, first, last in case['families']]
    left_open = [(Q(lo), None if hi is None else Q(hi), {i: STATES[w] for i, w in \
                       enumerate(states)}) for lo, hi, states in case['open']]
    print(checker.belongs((case['support'], [], a, b), single, families, left_open))
";

fn interval(ends: [i64; 2]) -> Interval {
    Interval::new(whole(ends[0]), whole(ends[1])).unwrap()
}

/// A made-up cover in the forms of both checkers.
struct MadeUp {
    ours: AcceptedCover,
    theirs: Value,
}

fn nothing() -> AcceptedCover {
    AcceptedCover {
        solutions: vec![],
        families: vec![],
        open: vec![],
        leaves: 1,
    }
}

/// Covers with at most one part, on a support or states in [3, 5].
fn made_up_covers() -> Vec<MadeUp> {
    let mut list = vec![
        MadeUp {
            ours: nothing(),
            theirs: json!({ "single": [], "families": [], "open": [] }),
        },
        listed(),
        family(Some([5, 6])),
        family(None),
    ];

    // Each of three variables rests, moves or is undecided.
    for k in 0..27 {
        let states = [k % 3, k / 3 % 3, k / 9];
        list.push(open_region(states, Some(5)));
        list.push(open_region(states, None));
    }
    list
}

fn listed() -> MadeUp {
    let solution = AcceptedClaim {
        support: vec![0, 2],
        value: interval([3, 5]),
    };

    MadeUp {
        ours: AcceptedCover {
            solutions: vec![solution],
            ..nothing()
        },
        theirs: json!({ "single": [[[0, 2], [3, 5]]], "families": [], "open": [] }),
    }
}

/// A family whose upper end is enclosed, or at infinity.
fn family(last: Option<[i64; 2]>) -> MadeUp {
    let family = SolutionFamily {
        support: vec![0, 2],
        from: Some(interval([3, 4])),
        to: last.map(interval),
        is_point: false,
        is_alone: true,
    };

    MadeUp {
        ours: AcceptedCover {
            families: vec![family],
            ..nothing()
        },
        theirs: json!({ "single": [], "families": [[[0, 2], [3, 4], last]], "open": [] }),
    }
}

/// A region from 3 on; the states are numbers of `STATES`.
fn open_region(states: [usize; 3], last: Option<i64>) -> MadeUp {
    const STATES: [&str; 3] = ["rest", "moving", "undecided"];
    let region = OpenRegion {
        min: Some(whole(3)),
        max: last.map(whole),
        moving: (0..3).filter(|&i| states[i] == 1).collect(),
        undecided: (0..3).filter(|&i| states[i] == 2).collect(),
    };
    let words = states.map(|state| STATES[state]);

    MadeUp {
        ours: AcceptedCover {
            open: vec![region],
            ..nothing()
        },
        theirs: json!({ "single": [], "families": [], "open": [[3, last, words]] }),
    }
}

/// No certificate tells whether a claim outside the cover is rejected (each half of such a pair
/// would be rejected by itself), so the two rules are compared on made-up covers.
#[test]
#[cfg_attr(not(has_python3), ignore = "needs python3")]
fn both_checkers_give_a_claim_the_same_places() {
    let mut questions = String::new();
    let mut ours = Vec::new();
    for cover in made_up_covers() {
        for claim in claims() {
            let ends = [claim.value.lo(), claim.value.hi()].map(ToString::to_string);
            let mut question = cover.theirs.clone();
            question["support"] = json!(claim.support);
            question["claim"] = json!(ends);

            questions += &format!("{question}\n");
            ours.push(cover.ours.place_of(&claim).is_some());
        }
    }

    assert_eq!(ours, second_answers(questions));
    let has_place = ours.iter().filter(|has_place| **has_place).count();
    let has_none = ours.len() - has_place;
    assert!(has_place > 200, "{has_place} of {}", ours.len());
    assert!(has_none > 1000, "{has_place} of {}", ours.len());
}

/// Every support of three variables, on intervals before, in, over an end of and after [3, 5].
fn claims() -> Vec<AcceptedClaim> {
    let mut claims = Vec::new();
    for subset in 0..8 {
        let support: Vec<usize> = (0..3).filter(|i| subset >> i & 1 == 1).collect();
        for ends in [[1, 2], [2, 3], [4, 4], [5, 6], [6, 7], [7, 8]] {
            claims.push(AcceptedClaim {
                support: support.clone(),
                value: interval(ends),
            });
        }
    }
    claims
}

/// What `spec/checker.py` answers, one line for each question.
fn second_answers(questions: String) -> Vec<bool> {
    let mut python = Command::new("python3");
    let mut child = python
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", BELONGS])
        .arg(root("spec"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();

    // Written by another thread, because the answers may fill their pipe before all is read.
    let mut pipe = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || pipe.write_all(questions.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();

    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|line| line == "True").collect()
}
