//! A report on a case: correct, incomplete, inaccurate or wrong, decided by exact membership in the
//! complete answer.
//!
//! Beyond the plain oracle a claim has its place by support and value (`certified`). Where the
//! answer is only the best known, a certified solution that is not in it is no error: it is counted
//! as unlisted.
//!
//! The rule for floats: a reported solution counts if `certify` turns it into a claim (value within
//! 1e-4 of 1 + |value|, x within 1e-3 with e'x_s = 1, support by several guesses), and the exact
//! solution of that claim is in the answer. Where values of both signs are asked for, one next to 0
//! is certified on both sides. Scale, order and repetitions do not matter. The answer is complete
//! if every listed solution, every cone (a solution inside it, with its whole support) and every
//! continuum (its intervals, or a solution on its support) is met. A reported solution that is not
//! certified is inaccurate where one of the listed solutions is near, and wrong elsewhere.
//!
//! Input: a case and the text that a program printed. Output: a label and the first reason for it.
//! Called by `run` for each case of the plan.

use super::case::{Case, CaseAnswer};
use super::certified::CertifiedAnswer;
use super::nearest::{Distance, hint};
use mceip_check::certificate::{Claim, ExactSolution};
use mceip_check::{AcceptedClaim, Place};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{Certifier, NotCertified};
use mceip_engine::foreign::{
    BadPoint, ForeignContinuum, ForeignEnd, ForeignError, ForeignReport, Reported,
    negative_component,
};
use mceip_engine::multistart::{exact_value, integer_x, same};
use mceip_engine::report::counted;
use mceip_engine::signs::{BothSigns, OfSign};
use mceip_engine::tolerance::VALUE_RADIUS;
use mceip_exact::{Algebraic, Poly, Rational, from_f64, nearest_decimal, to_decimal};
use mceip_oracle::{End, Enumeration, GivenPencil, Solution, SupportRange, is_between};
use num_traits::{One, Signed};

worded! {
    /// What a program did with a case.
    Label:
    Correct "correct" "The whole answer and nothing else.",
    Incomplete "incomplete" "Nothing false, something missing.",
    Inaccurate "inaccurate"
        "Nothing false, but a solution has too few digits: one of the answer is near.",
    Wrong "wrong" "Something false is reported.",
    Crashed "crashed"
        "The program ended by a signal or with an exit code other than 0 and 3 (undecided).",
    TimedOut "timed out" "It was still running at the end of its time.",
    Malformed "malformed" "What it printed is no report, or too long.",
    Undecided "undecided" "Judging its report takes longer than its time.",
}

impl Label {
    /// Did the program do what the case asks for?
    pub fn is_correct(self) -> bool {
        self == Label::Correct
    }
}

/// A label and the reason for it, in one line (empty where correct).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Judgement {
    /// The label.
    pub label: Label,
    /// Why.
    pub detail: String,
    /// Parts of the answer that were met before it was decided.
    pub found: usize,
    /// Certified solutions that a best known answer does not have.
    pub unlisted: usize,
}

impl Judgement {
    pub(super) fn new(label: Label, detail: impl Into<String>) -> Judgement {
        Judgement {
            label,
            detail: detail.into(),
            found: 0,
            unlisted: 0,
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

/// Judges the text of a report on a case, however long that takes.
pub fn judge_report(case: &Case, text: &str) -> Judgement {
    judge_until(case, text, &|| false)
}

/// Judges the text of a report on a case. The time is looked at before each solution.
pub(super) fn judge_until(case: &Case, text: &str, is_over: &dyn Fn() -> bool) -> Judgement {
    if text.trim().is_empty() {
        return Judgement::new(Label::Malformed, "it printed nothing on stdout");
    }

    let report = match ForeignReport::read(text, case.problem(), case.reduced()) {
        Ok(report) => report,
        Err(e @ ForeignError::Digest { .. }) => return Judgement::new(Label::Wrong, e.to_string()),
        Err(e @ ForeignError::Digits { .. }) => {
            return Judgement::new(Label::Undecided, e.to_string());
        }
        Err(e) => return Judgement::new(Label::Malformed, e.to_string()),
    };

    // Points off the constraints are wrong answers; any other bad point is no answer.
    let bad_points = report.solutions.iter().filter_map(|s| s.as_ref().err());
    for bad in bad_points {
        if !matches!(bad, BadPoint::OffConstraints { .. }) {
            return Judgement::new(Label::Malformed, bad.to_string());
        }
    }

    if report.solutions.len() > MAX_SOLUTIONS {
        let why = format!("more than {MAX_SOLUTIONS} solutions");
        return Judgement::new(Label::Malformed, why);
    }

    let mut met = MetParts::nothing(case);
    let judgement = match met.place_report(&report, is_over) {
        Ok(first_inaccurate) => met.judgement(first_inaccurate),
        Err(judgement) => judgement,
    };

    Judgement {
        found: met.found(),
        unlisted: met.unlisted.len(),
        ..judgement
    }
}

/// Why a reported solution has no place in the answer.
enum NoPlace {
    /// It is not certified, and one of the answer is near.
    Near { distance: Distance, why: String },
    /// It is false.
    False(String),
}

/// A reported solution that was certified.
struct CertifiedPoint {
    claim: Claim,
    verdict: AcceptedClaim,
    /// Is the claim one of the reflected problem, minus its value the one that was reported?
    is_reflected: bool,
}

/// Certifiers of the problem and of its reflection.
struct Certifiers<'a> {
    signs: &'a BothSigns,
    own: Certifier<'a>,
    reflected: Option<Certifier<'a>>,
}

impl<'a> Certifiers<'a> {
    fn of(signs: &'a BothSigns) -> Certifiers<'a> {
        let certifier = |side: &'a OfSign| Certifier::new(&side.problem, &side.reduced.pencil);
        Certifiers {
            signs,
            own: certifier(signs.own()),
            reflected: signs.reflected().map(certifier),
        }
    }

    /// Next to 0 on both sides, the likelier one first.
    fn certify(&self, reported: &Candidate) -> Result<CertifiedPoint, NotCertified> {
        let (likelier, other) = self.signs.near(reported);
        let found = self.certify_on(likelier, reported);
        match other {
            Some(other) if found.is_err() => self.certify_on(other, reported).or(found),
            _ => found,
        }
    }

    fn certify_on(
        &self,
        side: &OfSign,
        reported: &Candidate,
    ) -> Result<CertifiedPoint, NotCertified> {
        let is_reflected = side.problem.is_reflected();
        let certifier = match &self.reflected {
            Some(reflected) if is_reflected => reflected,
            _ => &self.own,
        };
        let (claim, verdict) = certifier.certify_with_verdict(&side.candidate(reported))?;
        Ok(CertifiedPoint {
            claim,
            verdict,
            is_reflected,
        })
    }
}

/// Which parts of a case's answer a report has met.
struct MetParts<'a> {
    case: &'a Case,
    solutions: Vec<bool>,
    cones: Vec<bool>,
    ranges: Vec<bool>,
    /// Solutions that a best known answer does not have, each once.
    unlisted: Vec<Claim>,
}

impl MetParts<'_> {
    /// Nothing of the answer is met.
    fn nothing(case: &Case) -> MetParts<'_> {
        let (solutions, cones, ranges) = match &case.answer {
            CaseAnswer::Enumerated(answer) => (
                answer.solutions.len(),
                answer.cones.len(),
                answer.ranges.len(),
            ),
            CaseAnswer::Certified(answer) => (answer.cover.solutions.len(), 0, 0),
        };

        MetParts {
            case,
            solutions: vec![false; solutions],
            cones: vec![false; cones],
            ranges: vec![false; ranges],
            unlisted: Vec::new(),
        }
    }

    /// The label of a report of which everything has its place.
    fn judgement(&self, first_inaccurate: Option<String>) -> Judgement {
        match (first_inaccurate, self.missing()) {
            (Some(why), _) => Judgement::new(Label::Inaccurate, why),
            (None, None) => Judgement::new(Label::Correct, ""),
            (None, Some(what)) => Judgement::new(Label::Incomplete, what),
        }
    }

    /// How many parts of the answer are met.
    fn found(&self) -> usize {
        let parts = self.solutions.iter().chain(&self.cones).chain(&self.ranges);
        parts.filter(|is_met| **is_met).count()
    }

    /// Places everything reported in the answer; the first thing that has no place, nor one near
    /// by, is wrong, and no more is placed when the time is over. The first solution that is only
    /// near its place is described.
    fn place_report(
        &mut self,
        report: &ForeignReport,
        is_over: &dyn Fn() -> bool,
    ) -> Result<Option<String>, Judgement> {
        let certifiers = Certifiers::of(&self.case.signs);
        let mut first_inaccurate = None;

        for (k, solution) in report.solutions.iter().enumerate() {
            if is_over() {
                let count = counted(report.solutions.len(), "solution");
                let why = format!("judged {k} of {count} in the time of the case");
                return Err(Judgement::new(Label::Undecided, why));
            }

            match self.place_solution(solution, &certifiers) {
                Ok(()) => (),
                Err(NoPlace::Near { distance, why }) => {
                    let text = || format!("solution {k}: {distance}; {why}");
                    first_inaccurate.get_or_insert_with(text);
                }
                Err(NoPlace::False(why)) => {
                    let why = format!("solution {k}: {why}");
                    return Err(Judgement::new(Label::Wrong, why));
                }
            }
        }

        for continuum in &report.continua {
            let placed = self.place_continuum(continuum);
            placed.map_err(|why| Judgement::new(Label::Wrong, why))?;
        }
        Ok(first_inaccurate)
    }

    /// Certifies a reported solution and marks what it meets; the error says why there is nothing.
    fn place_solution(
        &mut self,
        solution: &Result<Reported, BadPoint>,
        certifiers: &Certifiers<'_>,
    ) -> Result<(), NoPlace> {
        let candidate = match solution {
            Ok(reported) => &reported.candidate,
            Err(off) => return Err(NoPlace::False(off.to_string())),
        };

        let value = candidate.value;
        let found = match certifiers.certify(candidate) {
            Ok(certified) => certified,
            Err(why) => {
                let why = format!("value {value} is not certified: {why}");
                if let Some(distance) = Distance::to_nearest(self.case, candidate) {
                    return Err(NoPlace::Near { distance, why });
                }
                if let Some(negative) = negative_component(self.case.reduced(), candidate) {
                    return Err(NoPlace::False(format!("value {value}: {negative}")));
                }
                let hint = hint(self.case, candidate);
                let hint = hint.map_or(String::new(), |hint| format!("{hint}; "));
                return Err(NoPlace::False(format!("{hint}{why}")));
            }
        };

        let case = self.case;
        let is_placed = match (&case.answer, &found.claim) {
            (CaseAnswer::Certified(answer), _) => {
                self.place_accepted(found.claim, &found.verdict, answer)
            }
            (CaseAnswer::Enumerated(answer), Claim::ExactSolution(c)) => {
                self.place_exact(&found, c, answer)
            }
            // A lifted one is never made here; like a box it is placed by value and support.
            (
                CaseAnswer::Enumerated(answer),
                Claim::EnclosedSolution(_) | Claim::LiftedSolution(_),
            ) => self.place_box(&found, answer),
        };
        if !is_placed {
            return Err(NoPlace::False(format!(
                "value {value} is certified and not in the complete answer"
            )));
        }
        Ok(())
    }

    /// Marks the solution of a certified answer that an accepted claim is about; where the answer
    /// leaves its place open the claim is an unlisted one. False contradicts a proved answer.
    fn place_accepted(
        &mut self,
        claim: Claim,
        verdict: &AcceptedClaim,
        answer: &CertifiedAnswer,
    ) -> bool {
        match answer.cover.place_of(verdict) {
            Some(Place::Solution(k)) => self.solutions[k] = true,
            Some(Place::Family(_) | Place::Open(_)) => {
                if !self.unlisted.iter().any(|known| same(known, &claim)) {
                    self.unlisted.push(claim);
                }
            }
            None => return false,
        }
        true
    }

    /// Marks what an exact claim meets; false if the answer does not hold it.
    fn place_exact(
        &mut self,
        found: &CertifiedPoint,
        c: &ExactSolution,
        answer: &Enumeration,
    ) -> bool {
        let Some(mut value) = exact_value(&found.claim) else {
            return false;
        };

        let given = GivenPencil::of(self.case.problem(), self.case.reduced());
        let mut x = integer_x(c);
        x.truncate(given.order()); // without z of the linear form of a quadratic pencil
        if found.is_reflected {
            value = value.negated();
            x = x.iter().map(Poly::reflected).collect();
        }
        if !answer.contains(given, &value, &x) {
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
        for (k, listed) in answer.solutions.iter().enumerate() {
            self.solutions[k] |= *listed == solution;
        }

        for (k, cone) in answer.cones.iter().enumerate() {
            let has_the_value = || cone.value.clone().equals(&mut value.clone());
            self.cones[k] |= cone.slip == c.support && has_the_value();
        }

        for (k, range) in answer.ranges.iter().enumerate() {
            self.ranges[k] |= range.support == c.support && range.contains(&value);
        }

        true
    }

    /// A box holds one solution of its support: the listed one with this support and a value in the
    /// box.
    fn place_box(&mut self, found: &CertifiedPoint, answer: &Enumeration) -> bool {
        let Claim::EnclosedSolution(c) = &found.claim else {
            return false;
        };

        // The value is the last unknown of the box.
        let (Some(center), Some(radius)) = (c.center.last(), c.radius.last()) else {
            return false;
        };
        let center = if found.is_reflected {
            -&center.0
        } else {
            center.0.clone()
        };
        let lo = &center - &radius.0;
        let hi = &center + &radius.0;

        let mut is_placed = false;
        for (k, listed) in answer.solutions.iter().enumerate() {
            if listed.slip == c.support && is_between(&listed.value, &lo, &hi) {
                self.solutions[k] = true;
                is_placed = true;
            }
        }
        is_placed
    }

    /// Marks the range that a reported continuum meets.
    fn place_continuum(&mut self, reported: &ForeignContinuum) -> Result<(), String> {
        let mut slip = reported.slip.clone();
        slip.sort_unstable();

        let ranges: &[SupportRange] = match &self.case.answer {
            CaseAnswer::Enumerated(answer) => &answer.ranges,
            CaseAnswer::Certified(_) => &[], // such an answer has single solutions only
        };
        match ranges.iter().position(|r| r.support == slip) {
            Some(k) if same_intervals(&ranges[k], reported) => {
                self.ranges[k] = true;
                Ok(())
            }
            _ => Err(format!(
                "continuum of support {:?}: its values are not those of the answer",
                reported.slip
            )),
        }
    }

    /// The first part of the answer that was not met, and how many. `None` if all were.
    fn missing(&self) -> Option<String> {
        let total = self.case.parts();
        let count = total - self.found();
        if count == 0 {
            return None;
        }

        let first = match &self.case.answer {
            CaseAnswer::Enumerated(answer) => self.first_missing(answer)?,
            CaseAnswer::Certified(answer) => {
                let accepted = &answer.cover.solutions[first_unmet(&self.solutions)?];
                let value = nearest_decimal(&accepted.value.mid(), 9);
                let support = &accepted.support;
                format!("the solution {value} with support {support:?}")
            }
        };
        Some(format!("{count} of {total} missing, first {first}"))
    }

    /// The first part of an enumerated answer that was not met, in words.
    fn first_missing(&self, answer: &Enumeration) -> Option<String> {
        Some(if let Some(k) = first_unmet(&self.solutions) {
            let s = &answer.solutions[k];
            format!(
                "the solution {} with support {:?}",
                decimal(&s.value),
                s.slip
            )
        } else if let Some(k) = first_unmet(&self.cones) {
            let c = &answer.cones[k];
            format!(
                "the cone at {} with support {:?}",
                decimal(&c.value),
                c.slip
            )
        } else {
            let range = &answer.ranges[first_unmet(&self.ranges)?];
            format!("the continuum of support {:?}", range.support)
        })
    }
}

/// The index of the first part that was not met.
fn first_unmet(is_met: &[bool]) -> Option<usize> {
    is_met.iter().position(|m| !m)
}

/// The value with 9 digits.
fn decimal(value: &Algebraic) -> String {
    let identity = Poly::from_ints(&[0, 1]);
    to_decimal(&mut value.clone(), &identity, 9)
}

/// The same number of intervals, ends within the radius of values, closed where both say so.
fn same_intervals(range: &SupportRange, reported: &ForeignContinuum) -> bool {
    if range.pieces.len() != reported.intervals.len() {
        return false;
    }

    for (piece, interval) in range.pieces.iter().zip(&reported.intervals) {
        let same = |end: &Option<End>, reported: &Option<ForeignEnd>| match (end, reported) {
            (Some(end), Some(reported)) => same_end(end, reported),
            (None, None) => true,
            _ => false,
        };
        if !same(&piece.from, &interval.from) || !same(&piece.to, &interval.to) {
            return false;
        }
    }
    true
}

/// Is the end within the radius of a reported value, and closed where the report says so?
fn same_end(end: &End, reported: &ForeignEnd) -> bool {
    let reported_value = &reported.value.0;
    let relative_radius = from_f64(VALUE_RADIUS).unwrap_or_default(); // a finite constant
    let radius = relative_radius * (Rational::one() + reported_value.abs());

    let lo = reported_value - &radius;
    let hi = reported_value + &radius;
    let has_same_closure = reported.included.is_none_or(|is| is == end.included);
    is_between(&end.value, &lo, &hi) && has_same_closure
}
