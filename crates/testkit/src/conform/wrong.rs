//! Wrong answers on purpose: reports that must be rejected, each with the bug it stands for.
//!
//! Each is made from the complete exact answer of a case by one change that makes it false, or
//! leaves a part out. Input: a case. Output: at most one report of each bug. They are in the pack,
//! so that a harness can be tested, and `judge` has to give each the label of [`Bug::expected`].

use super::case::{Case, CaseAnswer, ListedPoint};
use super::judge::Label;
use super::spectrum::{EigenvectorKind, eigenpairs};
use mceip_engine::candidate::SOLUTIONS_FORMAT;
use mceip_exact::{Rational, parse, rational, whole};
use mceip_model::{RealWindow, Unknown, Window};
use mceip_oracle::{
    End, Enumeration, GivenPencil, IntegerPencil, Solution, ValueInterval, enumerate,
};
use num_traits::{Signed, Zero};
use serde_json::{Value, json};

worded! {
    /// The mistake behind a wrong answer. Its note says why the answer is wrong.
    Bug:
    SignFlipped "sign_flipped"
        "x < 0 where x >= 0 is asked for: S, or the normal, has the wrong sign",
    ShiftedValue "shifted_value" "no solution has this value: it is 1 per cent off",
    MixedSigns "mixed_signs" "an eigenvector of a support whose components have both signs",
    ComplementIgnored "complement_ignored"
        "a positive eigenvector of a support with y < 0 elsewhere",
    NegativeValue "negative_value" "t < 0: not an answer to (12) or (21)",
    NegativeDropped "negative_dropped" "solutions with t < 0 are missing: both signs are asked for",
    RoundedToZero "rounded_to_zero"
        "its value is negative and was rounded to 0: below the threshold nothing exists",
    OutsideWindow "outside_window" "a solution outside the window asked for",
    ZeroVector "zero_vector" "x = 0 solves every line but x != 0",
    EndlessContinuum "endless_continuum"
        "the support has solutions on part of these values only",
    Dropped "dropped" "the last part of the answer is missing",
    MergedByValue "merged_by_value" "two solutions share this value and one is missing",
}

impl Bug {
    /// The label that a report with it must get.
    pub fn expected(self) -> Label {
        match self {
            Bug::Dropped | Bug::MergedByValue | Bug::NegativeDropped => Label::Incomplete,
            _ => Label::Wrong,
        }
    }
}

/// A report that must not be called correct.
#[derive(Debug, Clone, PartialEq)]
pub struct WrongAnswer {
    /// The mistake.
    pub bug: Bug,
    /// The report (mceip-solutions/1, without a digest).
    pub report: Value,
}

/// Most slip variables for which eigenpairs of all supports are formed.
const SPECTRUM_SLIP: usize = 5;

impl Case {
    /// Answers that must not be called correct, each with the label it must get.
    ///
    /// True by construction that they are wrong, at most one of each bug.
    pub fn wrong_answers(&self) -> Vec<WrongAnswer> {
        let mut out = Vec::new();
        let points = self.points();
        if let Some(point) = points.iter().find(|p| !p.support.is_empty()) {
            let flipped = entry_negated(point);
            out.push(WrongAnswer::new(Bug::SignFlipped, vec![flipped]));
            if let Some(shifted) = shifted(self, point) {
                out.push(WrongAnswer::new(Bug::ShiftedValue, vec![shifted]));
            }
        }

        match &self.answer {
            CaseAnswer::Enumerated(answer) => {
                out.extend(self.wrong_for_the_enumerated(answer, &points));
            }
            CaseAnswer::Certified(_) => {
                let mut listed: Vec<Value> = points.iter().map(ListedPoint::entry).collect();
                if listed.pop().is_some() {
                    out.push(WrongAnswer::new(Bug::Dropped, listed));
                }
            }
        }

        if !self.has_solutions() {
            let zeros = vec!["0"; GivenPencil::of(self.problem(), self.reduced()).order()];
            let entry = json!({ "value": "1", "x": zeros });
            out.push(WrongAnswer::new(Bug::ZeroVector, vec![entry]));
        }
        out
    }

    /// What needs the exact answer: eigenpairs of supports, solutions outside the window, cones and
    /// continua.
    fn wrong_for_the_enumerated(
        &self,
        answer: &Enumeration,
        points: &[ListedPoint],
    ) -> Vec<WrongAnswer> {
        let slip = self.reduced().pencil.slip();
        let mut out = Vec::new();
        for spurious in spurious(self) {
            let mut entry = ListedPoint::of_solution(&spurious.pair, &slip).entry();
            if spurious.bug == Bug::RoundedToZero {
                entry["value"] = json!("0");
            }
            out.push(WrongAnswer::new(spurious.bug, vec![entry]));
        }

        if let Some(solution) = outside(self) {
            let entry = ListedPoint::of_solution(&solution, &slip).entry();
            out.push(WrongAnswer::new(Bug::OutsideWindow, vec![entry]));
        }

        out.extend(incomplete(answer, points));
        out.extend(without_values_below_zero(answer, points));
        out.extend(endless(answer));
        out
    }
}

impl WrongAnswer {
    fn new(bug: Bug, solutions: Vec<Value>) -> WrongAnswer {
        WrongAnswer {
            bug,
            report: json!({ "format": SOLUTIONS_FORMAT, "solutions": solutions }),
        }
    }
}

/// The entry of a solution with x negated.
fn entry_negated(point: &ListedPoint) -> Value {
    let x: Vec<String> = point.x.iter().map(|decimal| negated(decimal)).collect();
    json!({ "value": point.value, "x": x })
}

/// The decimal with the other sign; zero has none.
fn negated(decimal: &str) -> String {
    match decimal.strip_prefix('-') {
        Some(rest) => rest.to_string(),
        None if decimal == "0" => decimal.to_string(),
        None => format!("-{decimal}"),
    }
}

/// The solution with 1.01 value + 0.01, or - 0.01 for a value below 0, where no support is singular
/// (else that may be a solution).
fn shifted(case: &Case, point: &ListedPoint) -> Option<Value> {
    if let CaseAnswer::Enumerated(answer) = &case.answer
        && !answer.continua.is_empty()
    {
        return None;
    }

    let value = parse(&point.value).ok()?;
    let away_from_zero = rational(if value.is_negative() { -1 } else { 1 }, 100);
    let shifted = value * rational(101, 100) + away_from_zero;
    let mut out = point.entry();
    out["value"] = json!(shifted.to_string());
    Some(out)
}

/// The complete answer without one of its parts: one of two solutions that share a value, or else
/// the last part.
fn incomplete(answer: &Enumeration, points: &[ListedPoint]) -> Option<WrongAnswer> {
    let mut listed: Vec<Value> = points.iter().map(ListedPoint::entry).collect();

    let is_plain_list = answer.cones.is_empty() && answer.ranges.is_empty();
    if is_plain_list {
        if let Some(k) = first_with_the_value_of_the_next(&answer.solutions) {
            listed.remove(k + 1);
            return Some(WrongAnswer::new(Bug::MergedByValue, listed));
        }

        listed.pop()?;
        return Some(WrongAnswer::new(Bug::Dropped, listed));
    }

    // Cones and continua come last: a report without them has dropped them, unless a listed
    // solution lies on a continuum's support.
    let lies_on_a_range = |s: &Solution| answer.ranges.iter().any(|r| r.support == s.slip);
    if answer.solutions.iter().any(lies_on_a_range) {
        return None;
    }
    Some(WrongAnswer::new(Bug::Dropped, listed))
}

/// The solutions with values that are not negative, where there are others.
fn without_values_below_zero(answer: &Enumeration, points: &[ListedPoint]) -> Option<WrongAnswer> {
    let is_negative = |s: &Solution| s.value.clone().cmp_rational(&Rational::zero()).is_lt();
    let mut kept = Vec::new();
    for (solution, point) in answer.solutions.iter().zip(points) {
        if !is_negative(solution) {
            kept.push(point.entry());
        }
    }

    let has_dropped = kept.len() < points.len();
    has_dropped.then(|| WrongAnswer::new(Bug::NegativeDropped, kept))
}

/// The first of two neighbours that share a value.
fn first_with_the_value_of_the_next(solutions: &[Solution]) -> Option<usize> {
    solutions
        .windows(2)
        .position(|pair| pair[0].value.clone().equals(&mut pair[1].value.clone()))
}

/// An eigenpair that is no solution, and the bug of a program that reports it.
struct Spurious {
    bug: Bug,
    pair: Solution,
}

/// Eigenpairs that are no solutions, the first of each kind.
fn spurious(case: &Case) -> Vec<Spurious> {
    let pencil = &IntegerPencil::of(case.problem(), case.reduced());
    let slip = case.reduced().pencil.slip();
    if slip.len() > SPECTRUM_SLIP {
        return Vec::new();
    }

    let window = case.problem().real_window();
    let far_below = whole(-1_000_000);
    let min = window.min().unwrap_or(&far_below);
    let mut found = Vec::new();
    for (kind, pair) in eigenpairs(pencil, &slip, min, window.max()) {
        match kind {
            EigenvectorKind::MixedX if is_clearly_mixed(&pair, &slip) => {
                keep_the_first(&mut found, Bug::MixedSigns, pair);
            }
            EigenvectorKind::NegativeY => keep_the_first(&mut found, Bug::ComplementIgnored, pair),
            _ => {}
        }
    }

    let is_eigenvalue = case.problem().unknown() == Unknown::Eigenvalue;
    if min.is_zero() && !is_eigenvalue {
        let zero = Rational::zero();
        for (kind, pair) in eigenpairs(pencil, &slip, &far_below, Some(&zero)) {
            let is_negative = pair.value.clone().cmp_rational(&zero).is_lt();
            if kind != EigenvectorKind::Admissible || !is_negative {
                continue;
            }

            let near_zero = rational(-1, 1_000_000);
            let bug = if pair.value.clone().cmp_rational(&near_zero).is_gt() {
                Bug::RoundedToZero
            } else {
                Bug::NegativeValue
            };
            keep_the_first(&mut found, bug, pair);
        }
    }

    found
}

/// Adds the pair unless there is one of the same bug.
fn keep_the_first(found: &mut Vec<Spurious>, bug: Bug, pair: Solution) {
    if found.iter().all(|s| s.bug != bug) {
        found.push(Spurious { bug, pair });
    }
}

/// Is some component of x below -1/100 of e'x_s? (A smaller one might be a reader's rounding.)
fn is_clearly_mixed(s: &Solution, slip: &[usize]) -> bool {
    let limit = rational(-1, 100);
    let decimals = s.x_decimals(slip, 17);
    slip.iter()
        .any(|&i| parse(&decimals[i]).is_ok_and(|v| v < limit))
}

/// A solution of the problem without its window, clearly outside of that.
fn outside(case: &Case) -> Option<Solution> {
    let window = case.problem().real_window();
    let everywhere = match case.problem().unknown() {
        Unknown::Eigenvalue => RealWindow::ALL,
        Unknown::Lambda2 | Unknown::Mu => RealWindow::from(&Window::all()),
    };
    if window == everywhere {
        return None;
    }

    let pencil = IntegerPencil::of(case.problem(), case.reduced());
    let all = enumerate(pencil, everywhere).ok()?;
    all.solutions
        .into_iter()
        .find(|s| is_clearly_outside(s, &window))
}

/// Is the value outside the window, and not near an end of it?
fn is_clearly_outside(s: &Solution, window: &RealWindow) -> bool {
    let Ok(value) = parse(&s.decimal(17)) else {
        return false;
    };

    let is_below = |min: &Rational| value < *min && is_far(&value, min);
    let is_above = |max: &Rational| value > *max && is_far(&value, max);
    window.min().is_some_and(is_below) || window.max().is_some_and(is_above)
}

/// Is the distance more than 1 per cent of 1 + |v|?
fn is_far(v: &Rational, from: &Rational) -> bool {
    let distance = (v - from).abs();
    let size = whole(1) + v.abs();
    distance > rational(1, 100) * size
}

/// A continuum reported for all values from 0, some of which it has not.
fn endless(answer: &Enumeration) -> Option<WrongAnswer> {
    let begins_above_zero = |end: &End| end.value.clone().cmp_rational(&Rational::zero()).is_gt();
    // A report that does not say whether 0 belongs to it is not held against an open end there.
    let has_all_from_zero = |piece: &ValueInterval| {
        piece.to.is_none() && !piece.from.as_ref().is_some_and(begins_above_zero)
    };
    let mut ranges = answer.ranges.iter();
    let range = ranges.find(|range| !range.pieces.iter().any(has_all_from_zero))?;

    let interval = json!({ "from": { "value": "0" }, "to": null });
    let mut answer = WrongAnswer::new(Bug::EndlessContinuum, Vec::new());
    answer.report["continua"] = json!([{ "slip": range.support, "intervals": [interval] }]);
    Some(answer)
}
