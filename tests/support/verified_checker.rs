//! The verified checker in tests: the program, many files at once, and whether what it says is true.
//!
//! The sentences are read as a reader reads them, so that a program that proves one thing and prints
//! another is found. The exact enumerator (`mceip_oracle`), which goes through all supports one by
//! one, knows what is true.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_check::certificate::Certificate;
use mceip_check::{AcceptedClaim, AcceptedCover};
use mceip_exact::{Interval, Rational, parse};
use mceip_model::reduction::reduce;
use mceip_model::{Problem, Window};
use mceip_oracle::{Enumeration, enumerate};
use mceip_testkit::verified::{VerifiedChecker, VerifiedVerdict};
use std::fs::File;
use std::path::Path;
use std::process::Command;

/// The program; says so if it is not built.
pub fn checker() -> Option<VerifiedChecker> {
    match VerifiedChecker::find(None) {
        Ok(checker) => Some(checker),
        Err(e) => {
            eprintln!("mceip-verified is not built: make -C proofs program ({e})");
            None
        }
    }
}

/// Verdicts on all pairs of a list (a line: the paths of a problem and of a certificate), by one
/// process. Fewer verdicts than pairs: the program ended at the first pair without one.
pub fn verdicts_on_list(checker: &VerifiedChecker, list: &Path) -> Vec<VerifiedVerdict> {
    let mut command = Command::new(checker.program());
    let output = command
        .arg("--lines")
        .stdin(File::open(list).unwrap())
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();

    let mut verdicts = Vec::new();
    let mut said = String::new();
    for line in text.lines() {
        let Some(code) = line.strip_prefix("exit ") else {
            said += &format!("{line}\n");
            continue;
        };

        let code: i32 = code.parse().unwrap();
        let verdict = VerifiedVerdict::read(Some(code), &said);
        verdicts.push(verdict.unwrap_or_else(|| VerifiedVerdict::None(said.clone())));
        said.clear();
    }
    verdicts
}

/// What an accepted certificate states and the enumerator contradicts; a statement that cannot be
/// read counts as false.
pub fn falsehoods(problem: &Problem, certificate: &str, lines: &[String]) -> Vec<String> {
    let Ok(certificate) = Certificate::from_json(certificate) else {
        return vec!["accepted, but malformed".into()];
    };
    match Statement::read(lines) {
        Some(statement) => statement.falsehoods(problem, &certificate.window),
        None => vec![format!("an unknown sentence in {lines:?}")],
    }
}

/// The sentences of an acceptance.
#[derive(Debug)]
pub struct Statement {
    /// All solutions in the window; `None` where nothing is said about others.
    cover: Option<SaidCover>,
    /// Solutions that are claimed one by one.
    claims: Vec<AcceptedClaim>,
}

#[derive(Debug)]
struct SaidCover {
    window: Window,
    /// May two regions hold the same solution?
    may_repeat: bool,
    /// Solutions announced in the first line.
    count: usize,
    solutions: Vec<AcceptedClaim>,
}

impl Statement {
    /// Reads the lines of an acceptance. `None` for a sentence that is not known here.
    pub fn read(lines: &[String]) -> Option<Statement> {
        let (first_line, others) = lines.split_first()?;
        let mut solutions = Vec::new();
        let mut claims = Vec::new();

        for line in others {
            if let Some(rest) = line.strip_prefix("solution: value in ") {
                solutions.push(valued(rest, ", moving")?);
            } else {
                let rest = line.strip_prefix("claim: a solution with a value in ")?;
                claims.push(valued(rest, ", support")?);
            }
        }

        let claims_only = format!(
            "{} solution(s) claimed, nothing said about others",
            claims.len()
        );
        if *first_line == claims_only {
            return solutions.is_empty().then_some(Statement {
                cover: None,
                claims,
            });
        }

        Some(Statement {
            cover: Some(said_cover(first_line, solutions)?),
            claims,
        })
    }

    /// What is said and is not so; empty where all is true. `asked` is the window of the
    /// certificate, which has to be the one that the statement is about.
    pub fn falsehoods(&self, problem: &Problem, asked: &Window) -> Vec<String> {
        let pencil = reduce(problem).unwrap().pencil;
        let truth = enumerate(&pencil, asked).unwrap();

        let mut wrong = Vec::new();
        for claim in &self.claims {
            if !is_solution(&truth, claim) {
                wrong.push(format!("there is no solution {claim:?}"));
            }
        }

        if let Some(said) = &self.cover {
            if said.window != *asked {
                wrong.push(format!("about {:?} in place of {asked:?}", said.window));
            }
            if said.count != said.solutions.len() {
                wrong.push(format!("{} solutions announced: {said:?}", said.count));
            }
            wrong.extend(crate::cover::disagreements(&said.as_cover(), &truth));
        }
        wrong
    }
}

impl SaidCover {
    /// In the words of our checker; of regions that overlap and may hold the same solution, the
    /// first.
    fn as_cover(&self) -> AcceptedCover {
        let mut solutions: Vec<AcceptedClaim> = Vec::new();
        for solution in &self.solutions {
            let is_repeated = solutions.iter().any(|other| overlap(other, solution));
            if !(self.may_repeat && is_repeated) {
                solutions.push(solution.clone());
            }
        }

        AcceptedCover {
            solutions,
            families: vec![],
            open: vec![],
            leaves: 1,
        }
    }
}

fn overlap(a: &AcceptedClaim, b: &AcceptedClaim) -> bool {
    let begins_in_time = a.value.lo() <= b.value.hi();
    let ends_late_enough = a.value.hi() >= b.value.lo();
    a.support == b.support && begins_in_time && ends_late_enough
}

/// The first line: how many solutions, in which window.
fn said_cover(line: &str, solutions: Vec<AcceptedClaim>) -> Option<SaidCover> {
    let (count, window) = line.rsplit_once(" in ")?;
    let window = read_window(window)?;
    let may_repeat = count.contains(" regions, ");

    let count = match count {
        "no solution" => 0,
        "exactly one solution" => 1,
        _ if may_repeat => {
            let (number, rest) = count.split_once(' ')?;
            let expected = "regions, each with exactly one solution, and no other solution";
            (rest == expected).then(|| number.parse().ok())??
        }
        _ => {
            let rest = count.strip_prefix("exactly ")?;
            rest.strip_suffix(" solutions")?.parse().ok()?
        }
    };

    Some(SaidCover {
        window,
        may_repeat,
        count,
        solutions,
    })
}

/// `[a, b]` or `[a, infinity)`.
fn read_window(text: &str) -> Option<Window> {
    let (min, max) = text.strip_prefix('[')?.split_once(", ")?;
    let max = match max {
        "infinity)" => None,
        finite => Some(number(finite.strip_suffix(']')?)?),
    };
    Window::new(number(min)?, max).ok()
}

/// `[a, b], moving 0 2`: an interval, a word, the support.
fn valued(text: &str, word: &str) -> Option<AcceptedClaim> {
    let (interval, support) = text.split_once(word)?;
    let inner = interval.strip_prefix('[')?.strip_suffix(']')?;
    let (min, max) = inner.split_once(", ")?;

    let mut indices = Vec::new();
    for index in support.split_whitespace() {
        indices.push(index.parse().ok()?);
    }

    Some(AcceptedClaim {
        support: indices,
        value: Interval::new(number(min)?, number(max)?)?,
    })
}

fn number(text: &str) -> Option<Rational> {
    parse(text).ok()
}

/// Is the claim a solution of the list, of a cone or of a range?
pub fn is_solution(truth: &Enumeration, claim: &AcceptedClaim) -> bool {
    for solution in &truth.solutions {
        if solution.slip == claim.support && crate::cover::within(&solution.value, &claim.value) {
            return true;
        }
    }

    for cone in &truth.cones {
        let is_face = claim.support.iter().all(|i| cone.slip.contains(i));
        if is_face && crate::cover::within(&cone.value, &claim.value) {
            return true;
        }
    }

    let mut ranges = truth.ranges.iter();
    ranges.any(|range| range.support == claim.support)
}
