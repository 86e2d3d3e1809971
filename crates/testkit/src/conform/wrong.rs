//! Wrong answers on purpose: reports that must be rejected, each with the bug it stands for.

use super::case::Case;
use super::judge::Label;
use super::spectrum::{Kind, eigenpairs};
use mceip_engine::candidate::SOLUTIONS_FORMAT;
use mceip_exact::{Rational, rational, whole};
use mceip_model::Window;
use mceip_oracle::{Solution, enumerate};
use num_traits::{Signed, Zero};
use serde_json::{Value, json};

/// The mistake behind a wrong answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Bug {
    /// Every x negated.
    SignFlipped,
    /// A value off by one per cent.
    ShiftedValue,
    /// An eigenvector with components of both signs.
    MixedSigns,
    /// A positive eigenvector with y < 0 off its support.
    ComplementIgnored,
    /// An eigenpair with t < 0.
    NegativeValue,
    /// The same with -1e-6 < t < 0, reported as 0.
    RoundedToZero,
    /// A solution outside the window.
    OutsideWindow,
    /// x = 0.
    ZeroVector,
    /// A continuum for all values where it ends.
    EndlessContinuum,
    /// The last part of the answer left out.
    Dropped,
    /// One of two solutions with one value left out.
    MergedByValue,
}

impl Bug {
    /// The bug as it stands in files.
    pub fn word(self) -> &'static str {
        match self {
            Bug::SignFlipped => "sign_flipped",
            Bug::ShiftedValue => "shifted_value",
            Bug::MixedSigns => "mixed_signs",
            Bug::ComplementIgnored => "complement_ignored",
            Bug::NegativeValue => "negative_value",
            Bug::RoundedToZero => "rounded_to_zero",
            Bug::OutsideWindow => "outside_window",
            Bug::ZeroVector => "zero_vector",
            Bug::EndlessContinuum => "endless_continuum",
            Bug::Dropped => "dropped",
            Bug::MergedByValue => "merged_by_value",
        }
    }

    /// Why it is wrong.
    pub fn reason(self) -> &'static str {
        match self {
            Bug::SignFlipped => {
                "x < 0 where x >= 0 is asked for: S, or the normal, has the wrong sign"
            }
            Bug::ShiftedValue => "no solution has this value: it is 1 per cent off",
            Bug::MixedSigns => "an eigenvector of a support whose components have both signs",
            Bug::ComplementIgnored => "a positive eigenvector of a support with y < 0 elsewhere",
            Bug::NegativeValue => "t < 0: not an answer to (12) or (21)",
            Bug::RoundedToZero => {
                "its value is negative and was rounded to 0: below the threshold nothing exists"
            }
            Bug::OutsideWindow => "a solution outside the window asked for",
            Bug::ZeroVector => "x = 0 solves every line but x != 0",
            Bug::EndlessContinuum => "the support has solutions on part of these values only",
            Bug::Dropped => "the last part of the answer is missing",
            Bug::MergedByValue => "two solutions share this value and one is missing",
        }
    }

    /// The label that a report with it must get.
    pub fn expected(self) -> Label {
        match self {
            Bug::Dropped | Bug::MergedByValue => Label::Incomplete,
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
    pub fn wrong_answers(&self) -> Vec<WrongAnswer> {
        wrong_answers(self)
    }
}

/// The wrong answers of a case: true by construction that they are wrong, at most one of each bug.
fn wrong_answers(case: &Case) -> Vec<WrongAnswer> {
    let slip = case.reduced.pencil.slip();
    let mut out = Vec::new();

    let mut push = |bug, solutions: Vec<Value>| {
        out.push(WrongAnswer {
            bug,
            report: report(solutions, None),
        })
    };

    let listed: Vec<Value> = case
        .answer
        .solutions
        .iter()
        .map(|s| entry(s, &slip, false))
        .collect();

    if let Some(s) = case.answer.solutions.iter().find(|s| !s.is_free_only()) {
        push(Bug::SignFlipped, vec![entry(s, &slip, true)]);
        if let Some(shifted) = shifted(case, s, &slip) {
            push(Bug::ShiftedValue, vec![shifted]);
        }
    }

    for (bug, s) in spurious(case) {
        let mut value = entry(&s, &slip, false);
        if bug == Bug::RoundedToZero {
            value["value"] = json!("0");
        }

        push(bug, vec![value]);
    }

    if let Some(s) = outside(case) {
        push(Bug::OutsideWindow, vec![entry(&s, &slip, false)]);
    }

    if !case.has_solutions() {
        push(
            Bug::ZeroVector,
            vec![json!({ "value": "1", "x": vec!["0"; case.reduced.pencil.order()] })],
        );
    }

    let described = case.answer.cones.is_empty() && case.answer.ranges.is_empty();
    let shared = case
        .answer
        .solutions
        .windows(2)
        .position(|w| w[0].value.clone().equals(&mut w[1].value.clone()));

    match shared.filter(|_| described) {
        Some(k) => push(
            Bug::MergedByValue,
            listed
                .iter()
                .enumerate()
                .filter(|(i, _)| *i != k + 1)
                .map(|(_, v)| v.clone())
                .collect(),
        ),
        None if case.has_solutions() => {
            let kept = if described {
                listed.len() - 1
            } else {
                listed.len()
            };

            // Cones and continua come last: a report without them has dropped them, unless a listed
            // solution lies on a continuum's slip set.
            let lies_on = |s: &Solution| case.answer.ranges.iter().any(|r| r.support == s.slip);
            if described || !case.answer.solutions.iter().any(lies_on) {
                push(Bug::Dropped, listed[..kept].to_vec());
            }
        }
        None => {}
    }

    out.extend(endless(case));
    out
}

fn report(solutions: Vec<Value>, continua: Option<Value>) -> Value {
    let mut out = json!({ "format": SOLUTIONS_FORMAT, "solutions": solutions });
    if let Some(continua) = continua {
        out["continua"] = continua;
    }

    out
}

/// `value` and `x` as a foreign program gives them, or with x negated.
fn entry(s: &Solution, slip: &[usize], negated: bool) -> Value {
    let negate = |d: String| match (d.strip_prefix('-'), d == "0") {
        (Some(rest), _) => rest.to_string(),
        (None, true) => d,
        (None, false) => format!("-{d}"),
    };

    let x = s
        .x_decimals(slip, 17)
        .into_iter()
        .map(|d| if negated { negate(d) } else { d });

    json!({ "value": s.decimal(17), "x": x.collect::<Vec<_>>() })
}

/// The solution with 1.01 value + 0.01, where no support is singular (else that may be a solution).
fn shifted(case: &Case, s: &Solution, slip: &[usize]) -> Option<Value> {
    let value = mceip_exact::parse(&s.decimal(17))
        .ok()
        .filter(|_| case.answer.continua.is_empty())?;
    let value = value * rational(101, 100) + rational(1, 100);
    let mut out = entry(s, slip, false);
    out["value"] = json!(value.to_string());

    Some(out)
}

/// Eigenpairs that are no solutions, the first of each kind.
fn spurious(case: &Case) -> Vec<(Bug, Solution)> {
    let pencil = &case.reduced.pencil;
    if pencil.slip().len() > SPECTRUM_SLIP {
        return Vec::new();
    }

    let window = case.problem.window();
    let mut found: Vec<(Bug, Solution)> = Vec::new();

    let mut keep = |bug: Bug, s: Solution| {
        if found.iter().all(|(b, _)| *b != bug) {
            found.push((bug, s));
        }
    };

    for (kind, s) in eigenpairs(pencil, window.min(), window.max()) {
        match kind {
            Kind::MixedX if clearly_mixed(&s, &pencil.slip()) => keep(Bug::MixedSigns, s),
            Kind::NegativeY => keep(Bug::ComplementIgnored, s),
            _ => {}
        }
    }

    if window.min().is_zero() {
        let (far, near) = (whole(-1_000_000), rational(-1, 1_000_000));
        for (kind, s) in eigenpairs(pencil, &far, Some(&Rational::zero())) {
            if kind != Kind::Admissible || !s.value.clone().cmp_rational(&Rational::zero()).is_lt()
            {
                continue;
            }

            let close = s.value.clone().cmp_rational(&near).is_gt();
            keep(
                if close {
                    Bug::RoundedToZero
                } else {
                    Bug::NegativeValue
                },
                s,
            );
        }
    }

    found
}

/// Is some component of x below -1/100 of e'x_s? (A smaller one might be a reader's rounding.)
fn clearly_mixed(s: &Solution, slip: &[usize]) -> bool {
    let limit = rational(-1, 100);
    let decimals = s.x_decimals(slip, 17);
    slip.iter()
        .any(|&i| mceip_exact::parse(&decimals[i]).is_ok_and(|v| v < limit))
}

/// A solution of the problem without its window, clearly outside of that.
fn outside(case: &Case) -> Option<Solution> {
    let window = case.problem.window();
    if window.max().is_none() && window.min().is_zero() {
        return None;
    }

    let all = enumerate(&case.reduced.pencil, &Window::all()).ok()?;
    let far =
        |v: &Rational, from: &Rational| (v - from).abs() > rational(1, 100) * (whole(1) + v.abs());

    all.solutions.into_iter().find(|s| {
        let Ok(v) = mceip_exact::parse(&s.decimal(17)) else {
            return false;
        };

        (v < *window.min() && far(&v, window.min()))
            || window.max().is_some_and(|m| v > *m && far(&v, m))
    })
}

/// A continuum reported for all values from 0, where it is not.
fn endless(case: &Case) -> Option<WrongAnswer> {
    let range = case
        .answer
        .ranges
        .iter()
        .find(|r| r.pieces.len() > 1 || r.pieces.iter().any(|p| p.to.is_some()))?;

    let interval = json!({ "from": { "value": "0" }, "to": null });
    let continua = json!([{ "slip": range.support, "intervals": [interval] }]);
    Some(WrongAnswer {
        bug: Bug::EndlessContinuum,
        report: report(Vec::new(), Some(continua)),
    })
}
