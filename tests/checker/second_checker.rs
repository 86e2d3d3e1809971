//! `spec/checker.py` was written from the pages of spec/ alone. It and `mceip check` must agree: on
//! certificates of the worked examples, and on forgeries of them. Without python3 the test says so
//! and passes.
#![cfg(feature = "cli")]

use mceip_check::{AcceptedClaim, AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::{Interval, whole};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

const EXAMPLES: [&str; 4] = ["fold", "oblique", "two-particles", "two-particles-mu"];

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn code(command: &mut Command) -> i32 {
    command.output().unwrap().status.code().unwrap()
}

/// The certificates that `complete` and `solve` write for an example.
fn certificates(folder: &Path, name: &str) -> Vec<Value> {
    ["complete", "solve"]
        .map(|command| {
            let out = folder.join("written.json");
            let mut run = Command::new(env!("CARGO_BIN_EXE_mceip"));
            run.arg(command)
                .arg(root(&format!("spec/examples/{name}.json")))
                .arg("--certificate")
                .arg(&out);
            assert_eq!(code(&mut run), 0, "{command} {name}");
            serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap()
        })
        .to_vec()
}

/// Pointers to every number, name and list of a certificate, in the file's order.
fn places(value: &Value, at: &str, out: &mut Vec<String>) {
    match value {
        Value::Object(fields) => fields
            .iter()
            .for_each(|(k, v)| places(v, &format!("{at}/{k}"), out)),
        Value::Array(items) => {
            out.push(at.to_string());
            items
                .iter()
                .enumerate()
                .for_each(|(i, v)| places(v, &format!("{at}/{i}"), out));
        }
        _ => out.push(at.to_string()),
    }
}

/// Lists lose an item or have one twice, numbers change sign or value, names change.
fn forge(value: &mut Value, turn: usize) {
    match value {
        Value::Array(items) if !items.is_empty() => {
            let i = turn % items.len();
            if turn.is_multiple_of(2) {
                drop(items.remove(i))
            } else {
                items.insert(i, items[i].clone())
            }
        }
        Value::String(s)
            if s.trim_start_matches('-')
                .starts_with(|c: char| c.is_ascii_digit()) =>
        {
            *s = match turn % 3 {
                0 => s.strip_prefix('-').map_or(format!("-{s}"), String::from),
                1 => format!("{s}1"),
                _ => "0".into(),
            };
        }
        Value::String(s) => {
            *s = [
                "open",
                "tail",
                "positive_definite",
                "negative_definite",
                "absent",
            ][turn % 5]
                .into()
        }
        Value::Number(n) => {
            *value = Value::from(
                n.as_i64()
                    .map_or(0, |n| if turn.is_multiple_of(2) { -n } else { n + 1 }),
            )
        }
        other => *other = Value::from("3"),
    }
}

#[test]
fn both_checkers_give_the_same_verdicts() {
    if Command::new("python3").arg("--version").output().is_err() {
        eprintln!("python3 is not installed: spec/checker.py was not compared");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut seen = [0; 4];
    for name in EXAMPLES {
        for certificate in certificates(folder.path(), name) {
            let mut spots = Vec::new();
            places(&certificate, "", &mut spots);
            // The certificate itself, then a forgery at each of 8 places spread over the file.
            for turn in 0..9 {
                let mut forged = certificate.clone();
                if turn > 0 {
                    forge(
                        forged
                            .pointer_mut(&spots[(turn - 1) * spots.len() / 8])
                            .unwrap(),
                        turn,
                    );
                }
                let file = folder.path().join("forged.json");
                std::fs::write(&file, forged.to_string()).unwrap();
                let problem = root(&format!("spec/examples/{name}.json"));
                let ours = code(
                    Command::new(env!("CARGO_BIN_EXE_mceip"))
                        .arg("check")
                        .arg(&problem)
                        .arg(&file),
                );
                let theirs = code(
                    Command::new("python3")
                        .arg(root("spec/checker.py"))
                        .arg(&problem)
                        .arg(&file),
                );
                assert_eq!(
                    ours, theirs,
                    "mceip check and checker.py on {name}, turn {turn}: {forged}"
                );
                assert!(turn > 0 || ours == 0, "{name}");
                seen[usize::try_from(ours).unwrap()] += 1;
            }
        }
    }
    assert!(
        seen[0] >= 8 && seen[1] > 20 && seen[2] > 0,
        "accepted, rejected, unreadable, open: {seen:?}"
    );
}

#[test]
fn a_cover_with_an_open_leaf_is_undecided_for_both() {
    if Command::new("python3").arg("--version").output().is_err() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut certificate = certificates(folder.path(), "fold").remove(0);
    certificate["complete_set"]["pieces"][0]["tree"] = serde_json::json!(["open"]);
    let file = folder.path().join("open.json");
    std::fs::write(&file, certificate.to_string()).unwrap();
    let problem = root("spec/examples/fold.json");
    assert_eq!(
        code(
            Command::new(env!("CARGO_BIN_EXE_mceip"))
                .arg("check")
                .arg(&problem)
                .arg(&file)
        ),
        3
    );
    assert_eq!(
        code(
            Command::new("python3")
                .arg(root("spec/checker.py"))
                .arg(&problem)
                .arg(&file)
        ),
        3
    );
}

/// Degenerate pencils: a double root, a cone, ranges of values with irrational ends, a star. Their
/// certificates hold support leaves, and a forgery at any place of one gets the same verdict from
/// both.
#[test]
fn both_checkers_agree_on_support_leaves() {
    if Command::new("python3").arg("--version").output().is_err() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let problem = folder.path().join("problem.json");
    let file = folder.path().join("certificate.json");
    let mut seen = [0; 4];
    for (a, b) in [
        ("[[-1,1],[0,-1]]", "[[1,0],[0,1]]"),
        ("[[-1,0],[0,-1]]", "[[1,0],[0,1]]"),
        ("[[0,2,-1],[0,-1,0],[1,0,-2]]", "[[0,-1,0],[0,0,1],[0,1,0]]"),
        ("[[0,1,1],[1,0,0],[1,0,0]]", "[[-1,0,0],[0,-1,0],[0,0,-1]]"),
    ] {
        let text = format!(
            r#"{{"format":"mceip-problem/1","unknown":"lambda2","pencil":{{"a":{a},"b":{b}}}}}"#
        );
        std::fs::write(&problem, text).unwrap();
        let mut run = Command::new(env!("CARGO_BIN_EXE_mceip"));
        run.arg("complete")
            .arg(&problem)
            .arg("--certificate")
            .arg(&file);
        assert_eq!(code(&mut run), 0, "{a} {b}");
        let certificate: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        let mut spots = Vec::new();
        places(&certificate, "", &mut spots);
        let spots: Vec<String> = spots
            .into_iter()
            .filter(|s| s.contains("/support/"))
            .collect();
        assert!(spots.len() > 8, "{a} {b}");
        for turn in 0..17 {
            let mut forged = certificate.clone();
            if turn > 0 {
                forge(
                    forged
                        .pointer_mut(&spots[(turn - 1) * spots.len() / 16])
                        .unwrap(),
                    turn,
                );
            }
            std::fs::write(&file, forged.to_string()).unwrap();
            let ours = code(
                Command::new(env!("CARGO_BIN_EXE_mceip"))
                    .arg("check")
                    .arg(&problem)
                    .arg(&file),
            );
            let theirs = code(
                Command::new("python3")
                    .arg(root("spec/checker.py"))
                    .arg(&problem)
                    .arg(&file),
            );
            assert_eq!(
                ours, theirs,
                "mceip check and checker.py on {a} {b}, turn {turn}: {forged}"
            );
            assert!(turn > 0 || ours == 0);
            seen[usize::try_from(ours).unwrap()] += 1;
        }
    }
    assert!(seen[0] >= 4 && seen[1] > 20, "{seen:?}");
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

/// A cover with one part on a support or states in [3, 5], in the forms of both checkers.
fn parts() -> Vec<(AcceptedCover, Value)> {
    let none = || AcceptedCover {
        solutions: vec![],
        families: vec![],
        open: vec![],
        leaves: 1,
    };
    let listed = AcceptedClaim {
        support: vec![0, 2],
        value: interval([3, 5]),
    };
    let mut list = vec![
        (none(), json!({ "single": [], "families": [], "open": [] })),
        (
            AcceptedCover {
                solutions: vec![listed],
                ..none()
            },
            json!({ "single": [[[0, 2], [3, 5]]], "families": [], "open": [] }),
        ),
    ];
    for last in [Some([5, 6]), None] {
        let to = last.map(interval);
        let family = SolutionFamily {
            support: vec![0, 2],
            from: interval([3, 4]),
            to,
            is_point: false,
            is_alone: true,
        };
        let theirs = json!({ "single": [], "families": [[[0, 2], [3, 4], last]], "open": [] });
        list.push((
            AcceptedCover {
                families: vec![family],
                ..none()
            },
            theirs,
        ));
    }
    for (states, last) in (0..27).flat_map(|k| {
        [
            ([k % 3, k / 3 % 3, k / 9], Some(5)),
            ([k % 3, k / 3 % 3, k / 9], None),
        ]
    }) {
        let of = |state: usize| {
            (0..3)
                .filter(|&i| states[i] == state)
                .collect::<Vec<usize>>()
        };
        let region = OpenRegion {
            min: whole(3),
            max: last.map(whole),
            moving: of(1),
            undecided: of(2),
        };
        let words = states.map(|s| ["rest", "moving", "undecided"][s]);
        let theirs = json!({ "single": [], "families": [], "open": [[3, last, words]] });
        list.push((
            AcceptedCover {
                open: vec![region],
                ..none()
            },
            theirs,
        ));
    }
    list
}

/// No certificate tells whether a claim outside the cover is rejected (each half of such a pair
/// would be rejected by itself), so the two rules are compared on made-up covers.
#[test]
fn both_checkers_give_a_claim_the_same_places() {
    use std::io::Write as _;
    use std::process::Stdio;
    if Command::new("python3").arg("--version").output().is_err() {
        return;
    }
    let supports = (0..8).map(|k| (0..3).filter(|i| k >> i & 1 == 1).collect::<Vec<usize>>());
    let supports: Vec<Vec<usize>> = supports.collect();
    let mut input = String::new();
    let mut ours = Vec::new();
    for (cover, theirs) in parts() {
        for support in &supports {
            for ends in [[1, 2], [2, 3], [4, 4], [5, 6], [6, 7], [7, 8]] {
                let claim = AcceptedClaim {
                    support: support.clone(),
                    value: interval(ends),
                };
                let mut case = theirs.clone();
                case["support"] = json!(support);
                case["claim"] = json!(ends);
                input += &format!("{case}\n");
                ours.push(cover.place_of(&claim).is_some());
            }
        }
    }
    let mut run = Command::new("python3");
    run.env("PYTHONDONTWRITEBYTECODE", "1")
        .args(["-c", BELONGS])
        .arg(root("spec"));
    let mut child = run
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || pipe.write_all(input.as_bytes()).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let theirs: Vec<bool> = String::from_utf8(output.stdout)
        .unwrap()
        .lines()
        .map(|l| l == "True")
        .collect();
    assert_eq!(ours, theirs);
    let count = ours.iter().filter(|holds| **holds).count();
    assert!(
        count > 200 && ours.len() - count > 1000,
        "{count} of {}",
        ours.len()
    );
}
