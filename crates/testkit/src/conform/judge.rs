//! A report on a case: correct, incomplete or wrong, decided by exact membership in the complete
//! answer.
//!
//! The rule for floats: a reported solution counts if `certify` turns it into a claim (value within
//! 1e-4 of 1 + |value|, x within 1e-3 with e'x_s = 1, support by several guesses), and the exact
//! solution of that claim is in the answer. Scale, order and repetitions do not matter. The answer
//! is complete if every listed solution, every cone (a solution inside it, with its whole slip set)
//! and every continuum (its intervals, or a solution on its slip set) is met.

use super::case::Case;
use mceip_check::certificate::{Claim, ExactSolution};
use mceip_engine::certify::Certifier;
use mceip_engine::foreign::{BadPoint, ForeignContinuum, ForeignEnd, ForeignError, ForeignReport};
use mceip_engine::multistart::{exact_value, integer_x, support};
use mceip_engine::tolerance::VALUE_RADIUS;
use mceip_exact::{Algebraic, Poly, Rational, from_f64};
use mceip_oracle::{End, Enumeration, Solution, SupportRange};
use num_traits::{One, Signed};

/// What a program did with a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Label {
    /// The whole answer and nothing else.
    Correct,
    /// Nothing false, something missing.
    Incomplete,
    /// Something false is reported.
    Wrong,
    /// The program ended by a signal or with an exit code other than 0 and 3 (undecided).
    Crashed,
    /// It was still running at the end of its time.
    TimedOut,
    /// What it printed is no report, or too long.
    Malformed,
}

impl Label {
    /// All labels, in the order of tables.
    pub const ALL: [Label; 6] = [
        Label::Correct,
        Label::Incomplete,
        Label::Wrong,
        Label::Crashed,
        Label::TimedOut,
        Label::Malformed,
    ];

    /// Did the program do what the case asks for?
    pub fn is_correct(self) -> bool {
        self == Label::Correct
    }

    /// The label in words.
    pub fn word(self) -> &'static str {
        match self {
            Label::Correct => "correct",
            Label::Incomplete => "incomplete",
            Label::Wrong => "wrong",
            Label::Crashed => "crashed",
            Label::TimedOut => "timed out",
            Label::Malformed => "malformed",
        }
    }
}

/// A label and the reason for it, in one line (empty where correct).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Judgement {
    /// The label.
    pub label: Label,
    /// Why.
    pub detail: String,
}

impl Judgement {
    pub(super) fn new(label: Label, detail: impl Into<String>) -> Judgement {
        Judgement {
            label,
            detail: detail.into(),
        }
    }
}

/// Most solutions of a report that are looked at: each is certified. No answer of the pack has a
/// hundred.
const MAX_SOLUTIONS: usize = 10_000;

impl Case {
    /// Judges a report on this case.
    pub fn judge(&self, report: &str) -> Judgement {
        judge_report(self, report)
    }
}

/// Judges the text of a report on a case.
pub fn judge_report(case: &Case, text: &str) -> Judgement {
    let report = match ForeignReport::read(text, &case.problem, &case.reduced) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => return Judgement::new(Label::Wrong, e.to_string()),
        Err(e) => return Judgement::new(Label::Malformed, e.to_string()),
    };

    let unfit = report
        .solutions
        .iter()
        .filter_map(|s| s.as_ref().err())
        .find(|bad| !matches!(bad, BadPoint::OffConstraints { .. }));

    if let Some(bad) = unfit {
        return Judgement::new(Label::Malformed, bad.to_string());
    }

    if report.solutions.len() > MAX_SOLUTIONS {
        return Judgement::new(
            Label::Malformed,
            format!("more than {MAX_SOLUTIONS} solutions"),
        );
    }

    match met(case, &report) {
        Err(why) => Judgement::new(Label::Wrong, why),
        Ok(met) => match missing(case, &met) {
            None => Judgement::new(Label::Correct, ""),
            Some(what) => Judgement::new(Label::Incomplete, what),
        },
    }
}

/// Which parts of the answer a report has met.
struct Met {
    solutions: Vec<bool>,
    cones: Vec<bool>,
    ranges: Vec<bool>,
}

/// Places everything reported in the answer; the first thing that has no place is the error.
fn met(case: &Case, report: &ForeignReport) -> Result<Met, String> {
    let answer = &case.answer;
    let mut met = Met {
        solutions: vec![false; answer.solutions.len()],
        cones: vec![false; answer.cones.len()],
        ranges: vec![false; answer.ranges.len()],
    };

    let certifier = Certifier::new(&case.problem, &case.reduced.pencil);
    for (k, solution) in report.solutions.iter().enumerate() {
        let wrong = |why: String| format!("solution {k}: {why}");
        let candidate = &solution
            .as_ref()
            .map_err(|off| wrong(off.to_string()))?
            .candidate;
        let claim = certifier
            .certify(candidate)
            .map_err(|why| wrong(format!("value {} is not certified: {why}", candidate.value)))?;

        let placed = match &claim {
            Claim::ExactSolution(c) => place(case, &claim, c, &mut met),
            // A lifted one is never made here; like a box it is placed by value and support.
            Claim::EnclosedSolution(_) | Claim::LiftedSolution(_) => {
                place_box(answer, &claim, &mut met)
            }
        };

        if !placed {
            return Err(wrong(format!(
                "value {} is certified and not in the complete answer",
                candidate.value
            )));
        }
    }

    for reported in &report.continua {
        let of_slip = answer
            .ranges
            .iter()
            .position(|r| r.support == sorted(&reported.slip));

        match of_slip.filter(|&k| same_intervals(&answer.ranges[k], reported)) {
            Some(k) => met.ranges[k] = true,
            None => {
                return Err(format!(
                    "continuum of slip {:?}: its values are not those of the answer",
                    reported.slip
                ));
            }
        }
    }

    Ok(met)
}

/// Marks what an exact claim meets; false if the answer does not hold it.
fn place(case: &Case, claim: &Claim, c: &ExactSolution, met: &mut Met) -> bool {
    let Some(value) = exact_value(claim) else {
        return false;
    };

    let x = integer_x(c);
    if !case.answer.contains(&case.reduced.pencil, &value, &x) {
        return false;
    }

    let solution = Solution {
        value: value.clone(),
        multiplicity: 0,
        slip: c.support.clone(),
        biactive: c.biactive.clone(),
        x,
        y: Vec::new(),
    };

    for (k, s) in case.answer.solutions.iter().enumerate() {
        met.solutions[k] |= *s == solution;
    }

    for (k, cone) in case.answer.cones.iter().enumerate() {
        met.cones[k] |= cone.slip == c.support && cone.value.clone().equals(&mut value.clone());
    }

    for (k, range) in case.answer.ranges.iter().enumerate() {
        met.ranges[k] |= range.support == c.support && range.contains(&value);
    }

    true
}

/// A box holds one solution of its support: the listed one with this support and a value in the
/// box.
fn place_box(answer: &Enumeration, claim: &Claim, met: &mut Met) -> bool {
    let Claim::EnclosedSolution(c) = claim else {
        return false;
    };

    let (Some(center), Some(radius)) = (c.center.last(), c.radius.last()) else {
        return false;
    };

    let (lo, hi) = (&center.0 - &radius.0, &center.0 + &radius.0);
    let inside =
        |v: &Algebraic| v.clone().cmp_rational(&lo).is_ge() && v.clone().cmp_rational(&hi).is_le();
    let mut placed = false;

    for (k, s) in answer
        .solutions
        .iter()
        .enumerate()
        .filter(|(_, s)| s.slip == support(claim) && inside(&s.value))
    {
        met.solutions[k] |= s.slip == support(claim);
        placed = true;
    }

    placed
}

fn sorted(list: &[usize]) -> Vec<usize> {
    let mut list = list.to_vec();
    list.sort_unstable();
    list
}

/// The same number of intervals, ends within the radius of values, closed where both say so.
fn same_intervals(range: &SupportRange, reported: &ForeignContinuum) -> bool {
    let end = |a: &End, b: &ForeignEnd| {
        let mut value = a.value.clone();
        let radius = from_f64(VALUE_RADIUS).unwrap_or_default(); // a finite constant
        let radius = radius * (Rational::one() + b.value.0.abs());
        let near = value.cmp_rational(&(&b.value.0 - &radius)).is_ge()
            && value.cmp_rational(&(&b.value.0 + &radius)).is_le();

        near && b.included.is_none_or(|included| included == a.included)
    };

    range.pieces.len() == reported.intervals.len()
        && range.pieces.iter().zip(&reported.intervals).all(|(a, b)| {
            end(&a.from, &b.from)
                && match (&a.to, &b.to) {
                    (Some(x), Some(y)) => end(x, y),
                    (None, None) => true,
                    _ => false,
                }
        })
}

/// The first part of the answer that was not met, and how many.
fn missing(case: &Case, met: &Met) -> Option<String> {
    let decimal = |value: &Algebraic| {
        mceip_exact::to_decimal(&mut value.clone(), &Poly::from_ints(&[0, 1]), 9)
    };

    let not = |list: &[bool]| {
        list.iter()
            .enumerate()
            .filter(|(_, m)| !**m)
            .map(|(k, _)| k)
            .collect::<Vec<_>>()
    };

    let (solutions, cones, ranges) = (not(&met.solutions), not(&met.cones), not(&met.ranges));
    let count = solutions.len() + cones.len() + ranges.len();
    let total = met.solutions.len() + met.cones.len() + met.ranges.len();

    let first = if let Some(&k) = solutions.first() {
        let s = &case.answer.solutions[k];
        format!("the solution {} with slip {:?}", decimal(&s.value), s.slip)
    } else if let Some(&k) = cones.first() {
        let c = &case.answer.cones[k];
        format!("the cone at {} with slip {:?}", decimal(&c.value), c.slip)
    } else {
        format!(
            "the continuum of slip {:?}",
            case.answer.ranges[*ranges.first()?].support
        )
    };

    Some(format!("{count} of {total} missing, first {first}"))
}
