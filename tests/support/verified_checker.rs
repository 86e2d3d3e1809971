//! The verified checker in tests: the program, many files at once, whether what it says is true.
//!
//! The sentences are read as a reader reads them, so that a program that proves one thing and
//! prints another is found. The exact enumerator (`mceip_oracle`), which goes through all supports
//! one by one, knows what is true.
#![allow(dead_code, missing_docs, unreachable_pub)]

use crate::python_checker::list_of;
use mceip_check::{AcceptedClaim, AcceptedCover, OpenRegion, SolutionFamily};
use mceip_exact::{Interval, Rational, parse, rational};
use mceip_model::file::read_problem_file;
use mceip_model::reduction::reduce;
use mceip_model::{Body, Particle, Pencil, Problem, Reduced, System, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate, enumerate_modes};
use mceip_testkit::verified::{VerifiedChecker, VerifiedVerdict};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program, which a test demands where the build has found it.
pub fn checker() -> VerifiedChecker {
    VerifiedChecker::find(None).unwrap_or_else(|e| panic!("{e}"))
}

/// Verdicts on pairs of a problem and a certificate, by one process. Fewer verdicts than pairs: the
/// program ended at the first pair without one.
pub fn verdicts_on(checker: &VerifiedChecker, files: &[[PathBuf; 2]]) -> Vec<VerifiedVerdict> {
    let mut command = Command::new(checker.program());
    let output = command
        .arg("--lines")
        .stdin(list_of(files))
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
///
/// The certificate may be malformed for our reader: the verified checker does not read evidence
/// that it replaces by its own.
pub fn falsehoods(problem: &Problem, certificate: &str, lines: &[String]) -> Vec<String> {
    if let [line] = lines
        && let Some(range) = absence_range(line)
    {
        return absence_falsehoods(problem, certificate, &range);
    }
    if let [line] = lines
        && let Some(range) = presence_range(line)
    {
        return presence_falsehoods(problem, certificate, &range);
    }

    let Some(asked) = window_of(certificate) else {
        return vec!["accepted without a window".into()];
    };
    let reduced = reduce(problem).unwrap();
    let pencil = &reduced.pencil;
    let Some(statement) = Statement::read(lines, &pencil.slip()) else {
        return vec![format!("an unknown sentence in {lines:?}")];
    };

    if reduced.zero.is_empty() {
        statement.falsehoods(pencil, &asked)
    } else {
        statement.falsehoods_by_modes(&reduced, &asked)
    }
}

/// [a, b] of "no solution for mu in [a, b] and lambda^2 in [0, infinity)".
fn absence_range(line: &str) -> Option<Interval> {
    let range = line.strip_prefix("no solution for mu in ")?;
    read_interval(range.strip_suffix(" and lambda^2 in [0, infinity)")?)
}

/// [a, b] of "for every mu in [a, b] a solution with lambda^2 >= 0".
fn presence_range(line: &str) -> Option<Interval> {
    let range = line.strip_prefix("for every mu in ")?;
    read_interval(range.strip_suffix(" a solution with lambda^2 >= 0")?)
}

/// Values of lambda^2 at which the enumerator looks for solutions of every mu of the range.
const LEVELS: [(i64, i64); 6] = [(0, 1), (1, 7), (1, 1), (5, 2), (9, 1), (100, 1)];

/// Parts of the range at which it looks for solutions of every lambda^2.
const PARTS: [(i64, i64); 4] = [(0, 1), (1, 9), (2, 3), (1, 1)];

/// Whether the range of the sentence is that of the file, whose ends have these names; the lower
/// one is 0 where it is absent.
fn wrong_range(certificate: &str, names: [&str; 2], range: &Interval) -> Option<String> {
    let file: serde_json::Value = serde_json::from_str(certificate).unwrap();
    let from = match &file[names[0]] {
        serde_json::Value::Null => Some(rational(0, 1)),
        value => spelt(value),
    };
    let to = spelt(&file[names[1]]);
    let is_same = from.as_ref() == Some(range.lo()) && to.as_ref() == Some(range.hi());
    (!is_same).then(|| format!("about {range:?} in place of {from:?} to {to:?}"))
}

/// Is there a solution at a value of mu?
fn has_solution_at(system: &System, mu: &Rational) -> bool {
    let stiffness = system.stiffness().clone();
    let mass = system.mass().cloned();
    let particles = without_reactions(system);
    let at_mu = System::new(stiffness, mass, Some(mu.clone()), particles).unwrap();
    has_solution(at_mu, Unknown::Lambda2, Window::all())
}

/// Values of the range. Not 0, which is no friction of a system.
fn samples(range: &Interval) -> Vec<Rational> {
    let width = range.hi() - range.lo();
    let at = |(n, d): &(i64, i64)| range.lo() + &(&width * rational(*n, *d));
    let none = rational(0, 1);
    PARTS.iter().map(at).filter(|mu| *mu != none).collect()
}

/// What the enumerator finds in a range of friction in which there is said to be nothing.
fn absence_falsehoods(problem: &Problem, certificate: &str, range: &Interval) -> Vec<String> {
    if let Some(wrong) = wrong_range(certificate, ["from", "below"], range) {
        return vec![wrong];
    }
    let Body::System(system) = problem.body() else {
        return vec!["about a pencil".into()];
    };
    let Some(mass) = system.mass() else {
        return vec!["about a system without mass".into()];
    };

    let mut wrong = Vec::new();
    for (numerator, denominator) in LEVELS {
        let level = rational(numerator, denominator);
        let stiffness = system.stiffness().add_scaled(&level, mass);
        let at_level = System::new(stiffness, None, None, without_reactions(system)).unwrap();
        let window = Window::new(range.lo().clone(), Some(range.hi().clone())).unwrap();
        if has_solution(at_level, Unknown::Mu, window) {
            wrong.push(format!("there is a solution at lambda^2 = {level}"));
        }
    }

    for mu in samples(range) {
        if has_solution_at(system, &mu) {
            wrong.push(format!("there is a solution at mu = {mu}"));
        }
    }

    wrong
}

/// Where the enumerator finds nothing in a range in which there is said to be a solution.
fn presence_falsehoods(problem: &Problem, certificate: &str, range: &Interval) -> Vec<String> {
    if let Some(wrong) = wrong_range(certificate, ["from", "to"], range) {
        return vec![wrong];
    }
    let Body::System(system) = problem.body() else {
        return vec!["about a pencil".into()];
    };

    let mut wrong = Vec::new();
    for mu in samples(range) {
        if !has_solution_at(system, &mu) {
            wrong.push(format!("there is no solution at mu = {mu}"));
        }
    }

    wrong
}

/// The particles without their reactions, which belong to one value of mu.
fn without_reactions(system: &System) -> Vec<Particle> {
    let mut particles = system.particles().to_vec();
    for particle in &mut particles {
        particle.reaction = None;
    }
    particles
}

fn has_solution(system: System, unknown: Unknown, window: Window) -> bool {
    let problem = Problem::new(Body::System(system), unknown, window.clone()).unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    let found = enumerate(&pencil, &window).unwrap();
    !(found.solutions.is_empty() && found.cones.is_empty() && found.ranges.is_empty())
}

/// The window in the text of a certificate.
fn window_of(certificate: &str) -> Option<Window> {
    let file: serde_json::Value = serde_json::from_str(certificate).ok()?;
    let [min, max] = ["min", "max"].map(|end| &file["window"][end]);
    let max = match max {
        serde_json::Value::Null => None,
        value => Some(spelt(value)?),
    };
    Window::new(spelt(min)?, max).ok()
}

/// A number of a file: a JSON string or a JSON number.
fn spelt(value: &serde_json::Value) -> Option<Rational> {
    match value.as_str() {
        Some(text) => number(text),
        None => number(&value.to_string()),
    }
}

/// The sentences about a complete set, about claims, or both.
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
    /// What the first line announces.
    announced: Announced,
    /// What the other lines say.
    said: AcceptedCover,
    /// Are open regions left out of the list?
    leaves_out: bool,
}

/// How many there are of each sort.
#[derive(Debug, PartialEq, Eq)]
struct Announced {
    solutions: usize,
    families: usize,
    open: usize,
}

/// What follows the first line.
#[derive(Debug, Default)]
struct Listed {
    solutions: Vec<AcceptedClaim>,
    families: Vec<SolutionFamily>,
    open: Vec<OpenRegion>,
    leaves_out: bool,
    claims: Vec<AcceptedClaim>,
}

impl Statement {
    /// Reads the lines of a verdict; `slip` are the complementarity variables. `None` for a
    /// sentence that is not known here.
    pub fn read(lines: &[String], slip: &[usize]) -> Option<Statement> {
        let (first_line, others) = lines.split_first()?;
        let mut listed = Listed::default();
        for line in others {
            listed.read(line, slip)?;
        }

        let count = listed.claims.len();
        let claims_only = format!("{count} solution(s) claimed, nothing said about others");
        if *first_line == claims_only {
            return Some(Statement {
                cover: None,
                claims: listed.claims,
            });
        }

        let (window, announced) = first_sentence(first_line)?;
        let said = AcceptedCover {
            solutions: listed.solutions,
            families: listed.families,
            open: listed.open,
            leaves: 1,
        };
        Some(Statement {
            cover: Some(SaidCover {
                window,
                announced,
                said,
                leaves_out: listed.leaves_out,
            }),
            claims: listed.claims,
        })
    }

    /// What is said and is not so; empty where all is true. `asked` is the window of the
    /// certificate, which has to be the one that the statement is about.
    pub fn falsehoods(&self, pencil: &Pencil, asked: &Window) -> Vec<String> {
        self.falsehoods_beside(&enumerate(pencil, asked).unwrap(), asked)
    }

    /// The same for a system with particles in contact with zero reaction. Where the enumerator of
    /// modes leaves something undescribed, nothing is held against the statement.
    fn falsehoods_by_modes(&self, split: &Reduced, asked: &Window) -> Vec<String> {
        let list = enumerate_modes(split, asked);
        if !list.is_complete_list() {
            return Vec::new();
        }

        let truth = Enumeration {
            solutions: list.solutions,
            ..Enumeration::default()
        };
        self.falsehoods_beside(&truth, asked)
    }

    fn falsehoods_beside(&self, truth: &Enumeration, asked: &Window) -> Vec<String> {
        let mut wrong = Vec::new();
        for claim in &self.claims {
            if !is_solution(truth, claim) {
                wrong.push(format!("there is no solution {claim:?}"));
            }
        }

        if let Some(cover) = &self.cover {
            wrong.extend(cover.falsehoods(truth, asked));
        }
        wrong
    }
}

impl SaidCover {
    fn falsehoods(&self, truth: &Enumeration, asked: &Window) -> Vec<String> {
        let mut wrong = Vec::new();
        if self.window != *asked {
            wrong.push(format!("about {:?} in place of {asked:?}", self.window));
        }

        // What the regions that are not listed hold, the sentences do not say.
        if self.leaves_out {
            return wrong;
        }

        let listed = Announced {
            solutions: self.said.solutions.len(),
            families: self.said.families.len(),
            open: self.said.open.len(),
        };
        if self.announced != listed {
            wrong.push(format!("{:?} announced, {listed:?}", self.announced));
        }
        wrong.extend(crate::cover::disagreements(&self.said, truth));
        wrong
    }
}

impl Listed {
    fn read(&mut self, line: &str, slip: &[usize]) -> Option<()> {
        let (sort, rest) = line.split_once(": ")?;
        match sort {
            "solution" => {
                let rest = rest.strip_prefix("value in ")?;
                self.solutions.push(valued(rest, ", moving")?);
            }
            "claim" => {
                let rest = rest.strip_prefix("a solution with a value in ")?;
                self.claims.push(valued(rest, ", support")?);
            }
            "family" => self.families.push(family(rest)?),
            "open" if rest == "more regions" => self.leaves_out = true,
            "open" => self.open.push(open_region(rest, slip)?),
            _ => return None,
        }
        Some(())
    }
}

/// `exactly 2 solutions in W`, `2 solution(s) and one family, and no others, in W`, or
/// `one solution; every other one in W lies in one of 3 open region(s)`.
fn first_sentence(line: &str) -> Option<(Window, Announced)> {
    let (closed_part, open) = match line.split_once(" lies in one of ") {
        None => (line, 0),
        Some((part, regions)) => (part, first_word(regions)?.parse().ok()?),
    };

    let (counts, window) = closed_part.rsplit_once(" in ")?;
    let counts = counts.trim_end_matches(", and no others,");
    let counts = counts.trim_end_matches("; every other one");
    let (solutions, families) = counts.split_once(" and ").unwrap_or((counts, ""));

    let solutions = match solutions {
        "no solution" | "every solution" => 0,
        "exactly one solution" | "one solution" => 1,
        many => first_word(many.trim_start_matches("exactly "))?
            .parse()
            .ok()?,
    };
    let families = match families {
        "" => 0,
        "one family" => 1,
        many => first_word(many)?.parse().ok()?,
    };

    let announced = Announced {
        solutions,
        families,
        open,
    };
    Some((read_window(window)?, announced))
}

fn first_word(text: &str) -> Option<&str> {
    text.split_whitespace().next()
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
    Some(AcceptedClaim {
        support: indices(support)?,
        value: read_interval(interval)?,
    })
}

/// `values between V and V, moving 0 2, one solution at each value`; V is a number or
/// `a root in [a, b]`.
fn family(text: &str) -> Option<SolutionFamily> {
    let (rest, how_many) = text.rsplit_once(", ")?;
    let (place, support) = rest.rsplit_once(", moving")?;

    let (from, to, is_point) = if let Some(value) = place.strip_prefix("value ") {
        let value = enclosed(value)?;
        (value.clone(), Some(value), true)
    } else if let Some(value) = place.strip_prefix("values above ") {
        (enclosed(value)?, None, false)
    } else {
        let ends = place.strip_prefix("values between ")?;
        let (from, to) = ends.split_once(" and ")?;
        (enclosed(from)?, Some(enclosed(to)?), false)
    };

    Some(SolutionFamily {
        support: indices(support)?,
        from,
        to,
        is_point,
        is_alone: how_many == "one solution at each value",
    })
}

/// `values in [a, b], moving {0 2}, at rest {1}`; the other variables are undecided.
fn open_region(text: &str, slip: &[usize]) -> Option<OpenRegion> {
    let (window, states) = text.strip_prefix("values in ")?.split_once(", moving {")?;
    let (moving, resting) = states.strip_suffix('}')?.split_once("}, at rest {")?;
    let window = read_window(window)?;
    let moving = indices(moving)?;
    let resting = indices(resting)?;

    let is_undecided = |i: &usize| !moving.contains(i) && !resting.contains(i);
    let undecided = slip.iter().copied().filter(is_undecided).collect();
    Some(OpenRegion {
        min: window.min().clone(),
        max: window.max().cloned(),
        moving,
        undecided,
    })
}

fn enclosed(text: &str) -> Option<Interval> {
    match text.strip_prefix("a root in ") {
        Some(interval) => read_interval(interval),
        None => Some(Interval::point(number(text)?)),
    }
}

fn read_interval(text: &str) -> Option<Interval> {
    let (min, max) = text
        .strip_prefix('[')?
        .strip_suffix(']')?
        .split_once(", ")?;
    Interval::new(number(min)?, number(max)?)
}

fn indices(text: &str) -> Option<Vec<usize>> {
    let mut list = Vec::new();
    for index in text.split_whitespace() {
        list.push(index.parse().ok()?);
    }
    Some(list)
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

/// Sentences as the program prints them, beside some that are none.
#[test]
fn sentences_are_read() {
    let read = |text: &str| {
        let lines: Vec<String> = text.lines().map(String::from).collect();
        Statement::read(&lines, &[0, 1, 2])
    };

    let one = "exactly one solution in [0, infinity)\nsolution: value in [1.4, 3/2], moving 0 2";
    let cover = read(one).unwrap().cover.unwrap();
    assert_eq!(cover.said.solutions[0].support, [0, 2]);
    assert_eq!(cover.announced.solutions, 1);

    let open = "2 solutions and one family; every other one in [0, 4] lies in one of 1 open \
                region(s)\nopen: values in [1, 2], moving {0}, at rest {}";
    let cover = read(open).unwrap().cover.unwrap();
    assert_eq!(cover.said.open[0].undecided, [1, 2]);
    let announced = Announced {
        solutions: 2,
        families: 1,
        open: 1,
    };
    assert_eq!(cover.announced, announced);

    let family = "0 solution(s) and one family, and no others, in [0, 4]\nfamily: values between \
                  a root in [1, 2] and 3, moving 1, solutions at each value";
    let cover = read(family).unwrap().cover.unwrap();
    assert_eq!(cover.said.families[0].support, [1]);
    assert!(!cover.said.families[0].is_alone);

    let claim = "1 solution(s) claimed, nothing said about others\n\
                 claim: a solution with a value in [1, 2], support 0";
    assert_eq!(read(claim).unwrap().claims.len(), 1);

    assert!(read("exactly some solutions in [0, 4]").is_none());
    assert!(read("no solution in [4, 0]").is_none());
    assert!(read("no solution in [0, 4]\nbelieve: me").is_none());
}

/// The mass point of chapter 5 has its critical friction at 1.
#[test]
fn a_false_range_of_friction_is_found() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples/certificates");
    let problem = read_problem_file(&folder.join("critical.problem.json")).unwrap();
    let absent = |from: &str, below: &str| {
        let line = format!("no solution for mu in [{from}, {below}] and lambda^2 in [0, infinity)");
        let certificate = format!(r#"{{"from": "{from}", "below": "{below}"}}"#);
        falsehoods(&problem, &certificate, &[line])
    };

    assert_eq!(absent("0", "1/2"), Vec::<String>::new());
    assert_eq!(absent("1/3", "1/2"), Vec::<String>::new());
    assert!(!absent("0", "9/8").is_empty());
    assert!(!absent("9/8", "5/4").is_empty());

    let line = "no solution for mu in [0, 1/2] and lambda^2 in [0, infinity)".to_string();
    assert_eq!(
        falsehoods(&problem, r#"{"below": "1/2"}"#, std::slice::from_ref(&line)),
        Vec::<String>::new()
    );
    for other in [r#"{"below": "1/3"}"#, r#"{"from": "1/4", "below": "1/2"}"#] {
        assert!(!falsehoods(&problem, other, std::slice::from_ref(&line)).is_empty());
    }

    let present = |from: &str, to: &str| {
        let line = format!("for every mu in [{from}, {to}] a solution with lambda^2 >= 0");
        let certificate = r#"{"from": "5/4", "to": "2"}"#;
        falsehoods(&problem, certificate, &[line])
    };
    assert_eq!(present("5/4", "2"), Vec::<String>::new());
    assert!(!present("1", "2").is_empty());

    let line = "for every mu in [1/2, 2] a solution with lambda^2 >= 0".to_string();
    assert!(!falsehoods(&problem, r#"{"from": "1/2", "to": "2"}"#, &[line]).is_empty());
}
