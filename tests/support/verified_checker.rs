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
use mceip_model::{Body, Pencil, Problem, RealWindow, Reduced, System, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate, enumerate_modes};
use mceip_testkit::verified::{VerifiedChecker, VerifiedVerdict};
use mceip_testkit::{at_friction, at_lambda2, holds_claim};
use num_traits::Signed;
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
    let Some(verdict) = lines.first().and_then(|line| VerdictLine::read(line)) else {
        return vec![format!("no problem is named in {lines:?}")];
    };
    let sentence = match verdict.sentence.strip_suffix(OF_MEMBERS) {
        Some(of_members) if !problem.is_exact() => of_members,
        None if problem.is_exact() => verdict.sentence,
        _ => {
            return vec![format!(
                "about other bodies than those of the data: {lines:?}"
            )];
        }
    };

    if let Some(range) = absence_range(sentence) {
        let mut wrong = verdict.other_than(&name(problem, None), "");
        wrong.extend(absence_falsehoods(problem, certificate, "below", &range));
        return wrong;
    }
    if let Some(range) = stability_range(sentence) {
        let mut wrong = verdict.other_than(&name(problem, None), "");
        // What is stable does not diverge.
        wrong.extend(absence_falsehoods(problem, certificate, "to", &range));
        return wrong;
    }
    if let Some(range) = presence_range(sentence) {
        let mut wrong = verdict.other_than(&name(problem, None), "");
        wrong.extend(presence_falsehoods(problem, certificate, &range));
        return wrong;
    }

    let Some(asked) = windows_of(certificate) else {
        return vec!["accepted without a window".into()];
    };
    let reduced = reduce(problem).unwrap();
    let pencil = &reduced.pencil;
    let word = problem.unknown().word();
    let Some(statement) = Statement::read(sentence, &lines[1..], word, &pencil.slip()) else {
        return vec![format!("an unknown sentence in {lines:?}")];
    };

    let mut wrong = verdict.other_than(
        &name(problem, friction_of(problem)),
        &left_out(&asked, problem),
    );
    wrong.extend(if reduced.zero.is_empty() {
        statement.falsehoods(pencil, &asked)
    } else {
        statement.falsehoods_by_modes(&reduced, problem.window(), &asked)
    });
    wrong
}

/// What a sentence about all members of a problem with radii ends with.
const OF_MEMBERS: &str = ", for every body within the radii of the data";

/// `sentence (name of the question)`, and what follows it.
struct VerdictLine<'a> {
    sentence: &'a str,
    name: &'a str,
    rest: &'a str,
}

impl VerdictLine<'_> {
    fn read(line: &str) -> Option<VerdictLine<'_>> {
        // A window may begin with a parenthesis, too.
        let names = [Unknown::Lambda2, Unknown::Mu, Unknown::Eigenvalue];
        let places = names.map(|name| line.rfind(&format!(" ({}, ", name.word())));
        let (sentence, others) = line.split_at(places.into_iter().flatten().max()?);
        let (name, rest) = others.strip_prefix(" (")?.split_once(')')?;
        Some(VerdictLine {
            sentence,
            name,
            rest,
        })
    }

    /// What the line says of the question and its window in place of this.
    fn other_than(&self, name: &str, rest: &str) -> Vec<String> {
        let mut wrong = Vec::new();
        if self.name != name {
            wrong.push(format!("about {} in place of {name}", self.name));
        }
        if self.rest != rest {
            wrong.push(format!("{:?} in place of {rest:?}", self.rest));
        }
        wrong
    }
}

/// The question of a problem, as the verdict line names it.
fn name(problem: &Problem, friction: Option<&Rational>) -> String {
    let word = problem.unknown().word();
    let friction = friction.map_or(String::new(), |mu| format!("friction {mu}, "));
    format!("{word}, {friction}problem {}", problem.sha256())
}

/// The friction of a system, where the unknown is lambda^2.
fn friction_of(problem: &Problem) -> Option<&Rational> {
    match problem.body() {
        Body::System(system) if problem.unknown() == Unknown::Lambda2 => system.friction(),
        _ => None,
    }
}

/// What is said where a window is not all of the problem's.
fn left_out(asked: &[RealWindow], problem: &Problem) -> String {
    let whole = problem.real_window();
    if asked.iter().any(|window| window.covers(&whole)) {
        String::new()
    } else {
        format!(
            "; NOT the whole window {} of the problem",
            window_text(&whole)
        )
    }
}

/// [a, b] of "no solution for friction in [a, b], lambda2 in [0, infinity)"; (0, b] for a = 0.
fn absence_range(sentence: &str) -> Option<Interval> {
    let range = sentence.strip_prefix("no solution for friction in ")?;
    without_zero(range.strip_suffix(", lambda2 in [0, infinity)")?)
}

/// [a, b] of "stable for every mu in [a, b]: small motions ..."; (0, b] for a = 0.
fn stability_range(sentence: &str) -> Option<Interval> {
    let (range, means) = sentence
        .strip_prefix("stable for every mu in ")?
        .split_once(": ")?;
    let meaning =
        "small motions in these contact states lose energy as the theorem of stability asks";
    without_zero(range).filter(|_| means == meaning)
}

/// [a, b], or [0, b] of "(0, b]".
fn without_zero(range: &str) -> Option<Interval> {
    match range.strip_prefix("(0, ") {
        Some(end) => read_interval(&format!("[0, {end}")),
        None => read_interval(range).filter(|range| range.lo().is_positive()),
    }
}

/// [a, b] of "a solution with lambda2 >= 0 for every friction in [a, b]".
fn presence_range(sentence: &str) -> Option<Interval> {
    let range = sentence.strip_prefix("a solution with lambda2 >= 0 for every friction in ")?;
    read_interval(range)
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

/// Is there a solution at a value of mu? `None` where the enumerator leaves it open.
fn has_solution_at(system: &System, mu: &Rational) -> Option<bool> {
    let at_mu = at_friction(system, mu).unwrap();
    has_solution(at_mu, Unknown::Lambda2, Window::all())
}

/// Values of the range. Not 0, which is no friction of a system.
fn samples(range: &Interval) -> Vec<Rational> {
    let width = range.hi() - range.lo();
    let at = |(n, d): &(i64, i64)| range.lo() + &(&width * rational(*n, *d));
    let none = rational(0, 1);
    PARTS.iter().map(at).filter(|mu| *mu != none).collect()
}

/// What the enumerator finds in a range of friction in which there is said to be nothing, and of
/// which the file calls the upper end so.
fn absence_falsehoods(
    problem: &Problem,
    certificate: &str,
    upper: &str,
    range: &Interval,
) -> Vec<String> {
    if let Some(wrong) = wrong_range(certificate, ["from", upper], range) {
        return vec![wrong];
    }
    let Body::System(system) = problem.body() else {
        return vec!["about a pencil".into()];
    };
    if system.mass().is_none() {
        return vec!["about a system without mass".into()];
    }
    // The body as given is one of the members.
    let system = &system.as_given();

    let mut wrong = Vec::new();
    for (numerator, denominator) in LEVELS {
        let level = rational(numerator, denominator);
        let at_level = at_lambda2(system, &level).unwrap();
        let window = Window::new(range.lo().clone(), Some(range.hi().clone())).unwrap();
        if has_solution(at_level, Unknown::Mu, window) == Some(true) {
            wrong.push(format!("there is a solution at lambda^2 = {level}"));
        }
    }

    for mu in samples(range) {
        if has_solution_at(system, &mu) == Some(true) {
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
    // The body as given is one of the members.
    let system = &system.as_given();

    let mut wrong = Vec::new();
    for mu in samples(range) {
        if has_solution_at(system, &mu) == Some(false) {
            wrong.push(format!("there is no solution at mu = {mu}"));
        }
    }

    wrong
}

/// Is there a solution? `None` where the enumerator of modes leaves something undescribed.
fn has_solution(system: System, unknown: Unknown, window: Window) -> Option<bool> {
    let problem = Problem::new(Body::System(system), unknown, window.clone()).unwrap();
    let reduced = reduce(&problem).unwrap();
    if reduced.zero.is_empty() {
        let found = enumerate(&reduced.pencil, &window).unwrap();
        return Some(!found.is_empty());
    }

    let found = enumerate_modes(&reduced, &window);
    let has_some = !found.solutions.is_empty();
    (has_some || found.is_complete_list()).then_some(has_some)
}

/// The windows of what a certificate states: those of its complete sets or, without any, of its
/// claims.
fn windows_of(certificate: &str) -> Option<Vec<RealWindow>> {
    let file: serde_json::Value = serde_json::from_str(certificate).ok()?;
    let parts = [&file["negative"], &file];
    let has_set = |part: &serde_json::Value| !part["complete_set"].is_null();
    let has_any_set = parts.iter().any(|part| has_set(part));
    let window = |part: &serde_json::Value| {
        let says = if has_any_set {
            has_set(part)
        } else {
            part["claims"]
                .as_array()
                .is_some_and(|claims| !claims.is_empty())
        };
        says.then(|| window_of(part))
    };

    let [negative, window] = parts.map(window);
    let (negative, window) = (
        negative.map_or(Ok(None), known),
        window.map_or(Ok(None), known),
    );
    let (negative, window) = (negative.ok()?, window.ok()?);
    Some(RealWindow::of_parts(negative.as_ref(), window.as_ref()))
}

/// A window that is there has to be readable.
fn known(window: Option<Window>) -> Result<Option<Window>, ()> {
    window.map(Some).ok_or(())
}

/// The window in a part of a certificate.
fn window_of(part: &serde_json::Value) -> Option<Window> {
    let [min, max] = ["min", "max"].map(|end| &part["window"][end]);
    let max = match max {
        serde_json::Value::Null => None,
        value => Some(spelt(value)?),
    };
    Window::new(spelt(min)?, max).ok()
}

/// "[a, b]", "(-infinity, infinity)".
fn window_text(window: &RealWindow) -> String {
    let min = window
        .min()
        .map_or("(-infinity".into(), |min| format!("[{min}"));
    let max = window
        .max()
        .map_or("infinity)".into(), |max| format!("{max}]"));
    format!("{min}, {max}")
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
    windows: Vec<RealWindow>,
    /// All solutions in the window; `None` where nothing is said about others.
    cover: Option<SaidCover>,
    /// Solutions that are claimed one by one.
    claims: Vec<AcceptedClaim>,
}

#[derive(Debug)]
struct SaidCover {
    /// What the verdict line announces.
    announced: Announced,
    /// What the other lines say.
    said: AcceptedCover,
    /// Are open regions left out of the list?
    leaves_out: bool,
}

/// How many there are of each sort; families are not counted.
#[derive(Debug, PartialEq, Eq)]
struct Announced {
    solutions: usize,
    has_families: bool,
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
    /// Reads the sentence of the verdict line and the lines under it; `word` is the unknown, `slip`
    /// are the complementarity variables. `None` for a sentence that is not known here.
    pub fn read(
        sentence: &str,
        others: &[String],
        word: &str,
        slip: &[usize],
    ) -> Option<Statement> {
        let mut listed = Listed::default();
        for line in others {
            listed.read(line, word, slip)?;
        }

        if let Some(rest) = sentence.strip_prefix("claims, each has a solution in ") {
            let window = rest.strip_suffix("; nothing said about others")?;
            return Some(Statement {
                windows: window
                    .split(" or ")
                    .map(read_window)
                    .collect::<Option<_>>()?,
                cover: None,
                claims: listed.claims,
            });
        }

        let (windows, announced) = sentence_of_a_cover(sentence)?;
        let said = AcceptedCover {
            solutions: listed.solutions,
            families: listed.families,
            open: listed.open,
            leaves: 1,
        };
        Some(Statement {
            windows,
            cover: Some(SaidCover {
                announced,
                said,
                leaves_out: listed.leaves_out,
            }),
            claims: listed.claims,
        })
    }

    /// What is said and is not so; empty where all is true. `asked` are the windows of the
    /// certificate, which have to be those that the statement is about.
    pub fn falsehoods(&self, pencil: &Pencil, asked: &[RealWindow]) -> Vec<String> {
        let mut truth = Enumeration::default();
        for window in asked {
            let found = enumerate(pencil, window).unwrap();
            truth.solutions.extend(found.solutions);
            truth.cones.extend(found.cones);
            truth.ranges.extend(found.ranges);
            truth.undescribed.extend(found.undescribed);
        }
        self.falsehoods_beside(&truth, asked)
    }

    /// The same for a system with particles in contact with zero reaction. Where the enumerator of
    /// modes leaves something undescribed, nothing is held against the statement.
    fn falsehoods_by_modes(
        &self,
        split: &Reduced,
        whole: &Window,
        asked: &[RealWindow],
    ) -> Vec<String> {
        let min = asked
            .iter()
            .find_map(RealWindow::min)
            .unwrap_or(whole.min());
        let max = asked.iter().find_map(RealWindow::max).cloned();
        let list = enumerate_modes(split, &Window::new(min.clone(), max).unwrap());
        if !list.is_complete_list() {
            return Vec::new();
        }

        let truth = Enumeration {
            solutions: list.solutions,
            ..Enumeration::default()
        };
        self.falsehoods_beside(&truth, asked)
    }

    fn falsehoods_beside(&self, truth: &Enumeration, asked: &[RealWindow]) -> Vec<String> {
        let mut wrong = Vec::new();
        if self.windows != asked {
            wrong.push(format!("about {:?} in place of {asked:?}", self.windows));
        }

        for claim in &self.claims {
            if !holds_claim(truth, claim) {
                wrong.push(format!("there is no solution {claim:?}"));
            }
        }

        if let Some(cover) = &self.cover {
            wrong.extend(cover.falsehoods(truth));
        }
        wrong
    }
}

impl SaidCover {
    fn falsehoods(&self, truth: &Enumeration) -> Vec<String> {
        // What the regions that are not listed hold, the sentences do not say.
        if self.leaves_out {
            return Vec::new();
        }

        let mut wrong = Vec::new();
        let listed = Announced {
            solutions: self.said.solutions.len(),
            has_families: !self.said.families.is_empty(),
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
    fn read(&mut self, line: &str, word: &str, slip: &[usize]) -> Option<()> {
        let (sort, rest) = line.split_once(": ")?;
        let in_range = rest.strip_prefix(&format!("{word} in "));
        match sort {
            "solution" => self.solutions.push(valued(in_range?)?),
            "claim" => self.claims.push(valued(in_range?)?),
            "family" => self.families.push(family(rest, word)?),
            "open" if rest.ends_with(" more regions (see the certificate)") => {
                self.leaves_out = true;
            }
            "open" => self.open.push(open_region(in_range?, slip)?),
            // Of rates, which no enumeration of eigenvalues knows.
            "UNIQUE" => {}
            _ => return None,
        }
        Some(())
    }
}

/// `no solution in W`, `2 solutions and families of them in W, and no other`, or
/// `1 solution in W, and no other outside 3 open regions`; of values of both signs also
/// `2 solutions in W, no solution in W, and no other`.
fn sentence_of_a_cover(sentence: &str) -> Option<(Vec<RealWindow>, Announced)> {
    let (closed_part, open) = match sentence.split_once(" outside ") {
        None => (sentence, 0),
        Some((part, regions)) => (part, first_word(regions)?.parse().ok()?),
    };

    let (mut rest, excludes_others) = match closed_part.strip_suffix(", and no other") {
        None => (closed_part, false),
        Some(counts) => (counts, true),
    };
    let mut windows = Vec::new();
    let mut announced = Announced {
        solutions: 0,
        has_families: false,
        open,
    };
    let mut lists_some = false;

    while !rest.is_empty() {
        let (counts, place) = rest.split_once(" in ")?;
        let (window, others) = place.split_at(place.find([']', ')'])? + 1);
        windows.push(read_window(window)?);
        rest = others.strip_prefix(", ").unwrap_or(others);

        let (solutions, has_families) = match counts.strip_suffix(" and families of them") {
            None => (counts, false),
            Some(solutions) => (solutions, true),
        };
        lists_some |= solutions != "no solution";
        announced.has_families |= has_families;
        announced.solutions += match first_word(solutions)? {
            "no" => 0,
            count => count.parse().ok()?,
        };
    }

    (lists_some == excludes_others).then_some((windows, announced))
}

fn first_word(text: &str) -> Option<&str> {
    text.split_whitespace().next()
}

/// `[a, b]`, `[a, infinity)` or `(-infinity, b]`.
fn read_window(text: &str) -> Option<RealWindow> {
    let (min, max) = text.split_once(", ")?;
    let min = match min {
        "(-infinity" => None,
        finite => Some(number(finite.strip_prefix('[')?)?),
    };
    let max = match max {
        "infinity)" => None,
        finite => Some(number(finite.strip_suffix(']')?)?),
    };

    // One below 0 is the reflection of one above.
    let is_below = max.as_ref().is_some_and(Signed::is_negative);
    if !is_below {
        return RealWindow::new(min, max).ok();
    }
    let reflected = Window::new(-max?, min.map(|min| -min)).ok()?;
    RealWindow::of_parts(Some(&reflected), None).pop()
}

/// `[a, b], support [0, 2]`: an interval, the support.
fn valued(text: &str) -> Option<AcceptedClaim> {
    let (interval, support) = text.split_once(", support ")?;
    Some(AcceptedClaim {
        support: indices(support)?,
        value: read_interval(interval)?,
    })
}

/// `every lambda2 between V and V, support [0, 2], one solution at each`; V is a number or
/// `a value in [a, b]`.
fn family(text: &str, word: &str) -> Option<SolutionFamily> {
    let (rest, how_many) = text.rsplit_once(", ")?;
    let (place, support) = rest.rsplit_once(", support ")?;

    let (from, to, is_point) = if let Some(value) = place.strip_prefix(&format!("{word} = ")) {
        let value = enclosed(value)?;
        (Some(value.clone()), Some(value), true)
    } else if let Some(value) = place.strip_prefix(&format!("every {word} above ")) {
        (Some(enclosed(value)?), None, false)
    } else if let Some(value) = place.strip_prefix(&format!("every {word} below ")) {
        (None, Some(enclosed(value)?), false)
    } else {
        let ends = place.strip_prefix(&format!("every {word} between "))?;
        let (from, to) = ends.split_once(" and ")?;
        (Some(enclosed(from)?), Some(enclosed(to)?), false)
    };

    Some(SolutionFamily {
        support: indices(support)?,
        from,
        to,
        is_point,
        is_alone: how_many == "one solution at each",
    })
}

/// `[a, b], support [0, 2] and any of [1]`; the other complementarity variables are at rest.
fn open_region(text: &str, slip: &[usize]) -> Option<OpenRegion> {
    let (window, supports) = text.split_once(", support ")?;
    let (moving, undecided) = supports
        .split_once(" and any of ")
        .unwrap_or((supports, "[]"));
    let window = read_window(window)?;
    let moving = indices(moving)?;
    let undecided = indices(undecided)?;

    let is_known = |i: &usize| slip.contains(i);
    if !moving.iter().chain(&undecided).all(is_known) {
        return None;
    }
    Some(OpenRegion {
        min: window.min().cloned(),
        max: window.max().cloned(),
        moving,
        undecided,
    })
}

fn enclosed(text: &str) -> Option<Interval> {
    match text.strip_prefix("a value in ") {
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

/// `[0, 2]`
fn indices(text: &str) -> Option<Vec<usize>> {
    serde_json::from_str(text).ok()
}

fn number(text: &str) -> Option<Rational> {
    parse(text).ok()
}

/// Sentences as the program prints them, beside some that are none.
#[test]
fn sentences_are_read() {
    let read = |text: &str| {
        let (sentence, others) = text.split_once('\n').unwrap_or((text, ""));
        let others: Vec<String> = others.lines().map(String::from).collect();
        Statement::read(sentence, &others, "mu", &[0, 1, 2])
    };

    let one =
        "1 solution in [0, infinity), and no other\nsolution: mu in [1.4, 3/2], support [0, 2]";
    let cover = read(one).unwrap().cover.unwrap();
    assert_eq!(cover.said.solutions[0].support, [0, 2]);
    assert_eq!(cover.announced.solutions, 1);

    let open = "2 solutions and families of them in [0, 4], and no other outside 1 open region\n\
                open: mu in [1, 2], support [0] and any of [1, 2]";
    let cover = read(open).unwrap().cover.unwrap();
    assert_eq!(cover.said.open[0].undecided, [1, 2]);
    let announced = Announced {
        solutions: 2,
        has_families: true,
        open: 1,
    };
    assert_eq!(cover.announced, announced);

    let family = "0 solutions and families of them in [0, 4], and no other\nfamily: every mu \
                  between a value in [1, 2] and 3, support [1], a solution at each";
    let cover = read(family).unwrap().cover.unwrap();
    assert_eq!(cover.said.families[0].support, [1]);
    assert!(!cover.said.families[0].is_alone);

    let claim = "claims, each has a solution in [0, 4]; nothing said about others\n\
                 claim: mu in [1, 2], support [0]";
    assert_eq!(read(claim).unwrap().claims.len(), 1);

    let none = read("no solution in [0, 4] outside 2 open regions").unwrap();
    assert_eq!(none.cover.unwrap().announced.open, 2);

    assert!(read("some solutions in [0, 4], and no other").is_none());
    assert!(read("1 solution in [0, 4]").is_none());
    assert!(read("no solution in [0, 4], and no other").is_none());
    assert!(read("no solution in [4, 0]").is_none());
    assert!(read("no solution in [0, 4]\nbelieve: me").is_none());
    assert!(read(&one.replace("mu in", "lambda2 in")).is_none());
}

/// The name of the question and the window of the problem are part of what is said.
#[test]
fn a_verdict_about_another_question_is_found() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples/certificates");
    let problem = read_problem_file(&folder.join("claim.problem.json")).unwrap();
    let certificate = std::fs::read_to_string(folder.join("claim.json")).unwrap();
    let digest = problem.sha256();
    let right = format!(
        "1 solution in [0, 3], and no other (lambda2, problem {digest}); NOT the whole window \
         [0, infinity) of the problem"
    );

    let wrong_in = |line: &str| {
        let lines = [line, "solution: lambda2 in [1, 1], support [0]"].map(String::from);
        falsehoods(&problem, &certificate, &lines)
    };
    assert_eq!(wrong_in(&right), Vec::<String>::new());

    let others = [
        right.replace("lambda2", "mu"),
        right.replace("(lambda2", "(lambda2, friction 1"),
        right.replace(&digest, &"0".repeat(64)),
        right.replace("[0, 3]", "[0, 4]"),
        right.replace("[0, infinity)", "[0, 4]"),
        right.replace("; NOT the whole window [0, infinity) of the problem", ""),
    ];
    for other in others {
        assert_eq!(wrong_in(&other).len(), 1, "{other}");
    }
    assert!(!wrong_in("1 solution in [0, 3], and no other").is_empty());
}

/// The mass point of chapter 5 has its critical friction at 1.
#[test]
fn a_false_range_of_friction_is_found() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/examples/certificates");
    let problem = read_problem_file(&folder.join("critical.problem.json")).unwrap();
    let name = format!("lambda2, problem {}", problem.sha256());
    let absence = |from: &str, below: &str| {
        let begin = if from == "0" { "(" } else { "[" };
        let range = format!("{begin}{from}, {below}]");
        format!("no solution for friction in {range}, lambda2 in [0, infinity) ({name})")
    };
    let presence = |from: &str, to: &str| {
        format!("a solution with lambda2 >= 0 for every friction in [{from}, {to}] ({name})")
    };
    let absent = |from: &str, below: &str| {
        let line = absence(from, below);
        let certificate = format!(r#"{{"from": "{from}", "below": "{below}"}}"#);
        falsehoods(&problem, &certificate, &[line])
    };

    assert_eq!(absent("0", "1/2"), Vec::<String>::new());
    assert_eq!(absent("1/3", "1/2"), Vec::<String>::new());
    assert!(!absent("0", "9/8").is_empty());
    assert!(!absent("9/8", "5/4").is_empty());

    let line = absence("0", "1/2");
    assert_eq!(
        falsehoods(&problem, r#"{"below": "1/2"}"#, std::slice::from_ref(&line)),
        Vec::<String>::new()
    );
    for other in [r#"{"below": "1/3"}"#, r#"{"from": "1/4", "below": "1/2"}"#] {
        assert!(!falsehoods(&problem, other, std::slice::from_ref(&line)).is_empty());
    }

    let present = |from: &str, to: &str| {
        let line = presence(from, to);
        let certificate = r#"{"from": "5/4", "to": "2"}"#;
        falsehoods(&problem, certificate, &[line])
    };
    assert_eq!(present("5/4", "2"), Vec::<String>::new());
    assert!(!present("1", "2").is_empty());

    let line = presence("1/2", "2");
    assert!(!falsehoods(&problem, r#"{"from": "1/2", "to": "2"}"#, &[line]).is_empty());
}
