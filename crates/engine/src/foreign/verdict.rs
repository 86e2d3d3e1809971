//! One foreign solution, one verdict: it exists (certified and checked), nothing is near
//! (enumerated), or undecided.
//!
//! `certify` looks for a solution near the reported one and `check` decides whether it is one. If
//! so, the report is compared with it ([`agreement`]); if not, `refute` tries to prove that nothing
//! is near. Input: a problem, its reduction, and a point of a report. Called by the command `check`
//! and by the conformance runner; [`ForeignVerdict::line`] is what they print.

use super::agreement::{Agreement, agreement};
use super::refute::{Effort, EnumerationAnswer, refute};
use super::report::Reported;
use crate::candidate::{BACKWARD_ERROR_DIGITS, Candidate, scaled};
use crate::certify::{Certifier, certify};
use crate::multistart::{exact_value, support};
use crate::report::{counted, negated};
use crate::signs::{BothSigns, OfSign};
use crate::tolerance::{DISTANCE_ROUNDING, X_RADIUS};
use mceip_check::certificate::{Claim, EnclosedSolution};
use mceip_check::with_short_numbers;
use mceip_exact::{Algebraic, Interval, Poly};
use mceip_exact::{enclosing_decimals, parse, to_decimal, upper_decimal};
use mceip_model::{Problem, RealWindow, Reduced};

/// Components of a proven x that are printed.
const COMPONENTS_SHOWN: usize = 8;

/// Digits beyond which doubles do not tell errors apart.
const DIGITS_OF_DOUBLES: f64 = 15.0;

/// Digits of a value that are printed.
const VALUE_DIGITS: usize = 17;

/// What became of a foreign solution.
#[derive(Debug, Clone)]
pub enum ForeignVerdict {
    /// It exists: `certify` made the claim, which the checker has accepted, and the report agrees
    /// with it to the tolerance.
    Accepted(Box<Confirmed>),
    /// A solution near it exists, and the report differs from that by more than the tolerance.
    Inaccurate {
        /// What exists, and by how much the report differs.
        proved: Box<Confirmed>,
        /// The largest error allowed.
        tolerance: f64,
    },
    /// It does not: proved.
    Rejected(Refutation),
    /// Neither was proved.
    Undecided {
        /// Why it was not certified, and why absence was not proved.
        reason: String,
    },
}

/// A solution proved near a reported one.
#[derive(Debug, Clone)]
pub struct Confirmed {
    /// The claim; `check` accepts it.
    pub claim: Claim,
    /// Is it one of the reflected problem, whose value is that of the solution with its sign
    /// changed?
    pub is_reflected: bool,
    /// How near the report is to it.
    pub agreement: Agreement,
}

/// Why no solution is where one is reported.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refutation {
    /// The zero vector.
    #[error("E12: expected x != 0, got the zero vector")]
    ZeroX,
    /// A component that no solution has, by more than rounding.
    #[error(
        "x[{index}] = {} < 0 at largest |x_i| = 1, and every solution has x[{index}] >= 0",
        plain_or_power(*value)
    )]
    NegativeX {
        /// The variable.
        index: usize,
        /// The component, of x with the largest |x_i| = 1.
        value: f64,
    },
    /// The value lies outside the window, by more than rounding.
    #[error("value {} lies outside the window {window}", plain_or_power(*value))]
    OutsideWindow {
        /// The value reported.
        value: f64,
        /// The window.
        window: RealWindow,
    },
    /// The complete answer near the value holds nothing like it.
    #[error("{0}")]
    NothingNear(Examined),
}

/// An interval of values, of which all solutions are known.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "no solution with value in [{lo:?}, {hi:?}] has x within {X_RADIUS:e} of this one (all \
     {} examined exactly, {})",
    counted(*supports, "support"),
    others_text(*others)
)]
pub struct Examined {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
    /// Supports examined.
    pub supports: u64,
    /// How many solutions there are, all with another x.
    pub others: usize,
}

fn others_text(others: usize) -> String {
    match others {
        0 => "there is none at all".to_string(),
        n => format!("{n} found with another x"),
    }
}

impl Refutation {
    /// Of the reflected problem, as one of the problem with this window.
    fn reflected(self, window: RealWindow) -> Refutation {
        match self {
            Refutation::ZeroX | Refutation::NegativeX { .. } => self,
            Refutation::OutsideWindow { value, .. } => Refutation::OutsideWindow {
                value: -value,
                window,
            },
            Refutation::NothingNear(examined) => Refutation::NothingNear(Examined {
                lo: -examined.hi,
                hi: 0.0 - examined.lo, // no -0.0
                ..examined
            }),
        }
    }

    /// Of values on both sides of 0.
    fn and(self, other: Refutation) -> Refutation {
        match (self, other) {
            (Refutation::NothingNear(here), Refutation::NothingNear(there)) => {
                Refutation::NothingNear(Examined {
                    lo: here.lo.min(there.lo),
                    hi: here.hi.max(there.hi),
                    supports: here.supports,
                    others: here.others + there.others,
                })
            }
            (near @ Refutation::NothingNear(_), _) => near,
            (_, other) => other,
        }
    }
}

/// Proves a reported solution, or refutes it, within the radii of `tolerance.rs` (value 1e-4 of 1 +
/// |value|, x 1e-3). One that is proved is accepted if it agrees with the proven one to
/// `tolerance`, see [`Agreement`]. Absence near points is proved as far as `effort` goes.
pub fn judge(
    signs: &BothSigns,
    reported: &Reported,
    tolerance: f64,
    effort: &mut Effort,
) -> ForeignVerdict {
    let mut judge_on = |side: &OfSign| {
        let here = Reported {
            candidate: side.candidate(&reported.candidate),
            off: reported.off,
        };
        match judge_on_side(side, &here, tolerance, effort) {
            ForeignVerdict::Rejected(refutation) if side.problem.is_reflected() => {
                let window = signs.own().problem.real_window();
                ForeignVerdict::Rejected(refutation.reflected(window))
            }
            verdict => verdict,
        }
    };

    let (likelier, other) = signs.near(&reported.candidate);
    let verdict = judge_on(likelier);
    match other {
        Some(other) if !matches!(verdict, ForeignVerdict::Accepted(_)) => {
            together(verdict, judge_on(other))
        }
        _ => verdict,
    }
}

/// What two verdicts, of the two sides of 0, say together: what exists on one of them exists, and
/// only what neither has is refuted.
fn together(first: ForeignVerdict, second: ForeignVerdict) -> ForeignVerdict {
    use ForeignVerdict::{Accepted, Inaccurate, Rejected, Undecided};
    match (first, second) {
        (Rejected(here), Rejected(there)) => Rejected(here.and(there)),
        (found @ Accepted(_), _) | (_, found @ Accepted(_)) => found,
        (found @ Inaccurate { .. }, _) | (_, found @ Inaccurate { .. }) => found,
        (open @ Undecided { .. }, _) | (_, open @ Undecided { .. }) => open,
    }
}

/// The verdict on the values that a problem or its reflection has.
fn judge_on_side(
    side: &OfSign,
    reported: &Reported,
    tolerance: f64,
    effort: &mut Effort,
) -> ForeignVerdict {
    let OfSign { problem, reduced } = side;
    let candidate = &reported.candidate;
    if candidate.x.iter().all(|v| *v == 0.0) {
        return ForeignVerdict::Rejected(Refutation::ZeroX);
    }

    if let Some(refutation) = negative_component(reduced, candidate) {
        return ForeignVerdict::Rejected(refutation);
    }

    let proved = match prove(problem, reduced, reported, candidate) {
        Ok(proved) => proved,
        Err(reason) => match refute(problem, reduced, candidate, effort) {
            Ok(EnumerationAnswer::Refuted(refutation)) => {
                return ForeignVerdict::Rejected(refutation);
            }
            Ok(EnumerationAnswer::Near(nearest)) => {
                match prove(problem, reduced, reported, &nearest) {
                    Ok(proved) => proved,
                    Err(why) => return undecided(problem, candidate, &reason, &why),
                }
            }
            Err(why) => return undecided(problem, candidate, &reason, &why),
        },
    };
    if proved.agreement.is_within(tolerance) {
        return ForeignVerdict::Accepted(Box::new(proved));
    }

    // Noise in components that are zero, and true components that look like noise, may have led to
    // another solution near by.
    let cleaned = without_noise(candidate, tolerance);
    let certifier = Certifier::new(problem, &reduced.pencil);
    for meant in [candidate, &cleaned] {
        for claim in certifier.every_accepted(meant) {
            if let Some(agreement) = agreement(problem, reduced, &claim, reported)
                && agreement.is_within(tolerance)
            {
                return ForeignVerdict::Accepted(Box::new(Confirmed {
                    claim,
                    is_reflected: problem.is_reflected(),
                    agreement,
                }));
            }
        }
    }

    ForeignVerdict::Inaccurate {
        proved: Box::new(proved),
        tolerance,
    }
}

/// A component x_i < 0 of a complementarity variable that is further from every x_i >= 0 than
/// [`X_RADIUS`], both x at largest |x_i| = 1.
pub fn negative_component(reduced: &Reduced, candidate: &Candidate) -> Option<Refutation> {
    let x = scaled(&candidate.x)?;
    let slip = reduced.pencil.slip().into_iter();
    let index = slip.min_by(|i, j| x[*i].total_cmp(&x[*j]))?;
    let value = x[index];
    let is_beyond_rounding = value < -(X_RADIUS + DISTANCE_ROUNDING);
    is_beyond_rounding.then_some(Refutation::NegativeX { index, value })
}

/// The verdict where a proof of presence and one of absence failed for these reasons.
fn undecided(problem: &Problem, candidate: &Candidate, reason: &str, why: &str) -> ForeignVerdict {
    let backward_error = backward_error_text(problem, candidate);
    ForeignVerdict::Undecided {
        reason: format!("{reason}; {why}{backward_error}"),
    }
}

/// The backward error of a candidate that is neither proved nor refuted, as a clause; empty where
/// the checker refuses it.
fn backward_error_text(problem: &Problem, candidate: &Candidate) -> String {
    match candidate.backward_error(problem) {
        Ok(error) => format!(
            "; backward error {}",
            upper_decimal(&error, BACKWARD_ERROR_DIGITS)
        ),
        Err(_) => String::new(),
    }
}

/// The solution that `certify` finds near a candidate and `check` accepts, compared with what was
/// reported.
fn prove(
    problem: &Problem,
    reduced: &Reduced,
    reported: &Reported,
    candidate: &Candidate,
) -> Result<Confirmed, String> {
    let claim = certify(problem, &reduced.pencil, candidate).map_err(|e| e.to_string())?;
    let agreement = agreement(problem, reduced, &claim, reported);
    let agreement = agreement.ok_or("its numbers are beyond the range of doubles")?;
    Ok(Confirmed {
        claim,
        is_reflected: problem.is_reflected(),
        agreement,
    })
}

/// The candidate with components up to `tolerance` of the largest set to zero.
fn without_noise(candidate: &Candidate, tolerance: f64) -> Candidate {
    let mut largest: f64 = 0.0;
    for component in &candidate.x {
        largest = largest.max(component.abs());
    }

    let mut cleaned = candidate.clone();
    for component in &mut cleaned.x {
        if component.abs() <= tolerance * largest {
            *component = 0.0;
        }
    }

    cleaned
}

impl ForeignVerdict {
    /// One line for people; `given` is the value as reported.
    pub fn line(&self, problem: &Problem, given: f64) -> String {
        with_short_numbers(&self.full_line(problem, given))
    }

    fn full_line(&self, problem: &Problem, given: f64) -> String {
        let word = problem.unknown().word();
        let value = plain_or_power(given);
        match self {
            ForeignVerdict::Accepted(proved) => {
                let exists = existing(problem, proved);
                let value = digits_text(proved.agreement.value);
                let x = digits_text(proved.agreement.worst.error);
                format!("ACCEPTED: {exists}; proved; its value agrees to {value}, x to {x}")
            }
            ForeignVerdict::Inaccurate { proved, tolerance } => {
                inaccurate_text(problem, &value, proved, *tolerance)
            }
            ForeignVerdict::Rejected(why) => format!("REJECTED: {word} = {value}: {why}"),
            ForeignVerdict::Undecided { reason } => {
                format!("UNDECIDED: {word} = {value}: {reason}")
            }
        }
    }
}

/// The shortest decimal of a double; where that has many zeros, with a power of ten.
fn plain_or_power(value: f64) -> String {
    const LONGEST: usize = 30;

    let plain = value.to_string();
    if plain.len() > LONGEST {
        format!("{value:e}")
    } else {
        plain
    }
}

/// `lambda2 = 2 exists with support {0, 1}`.
fn existing(problem: &Problem, proved: &Confirmed) -> String {
    let word = problem.unknown().word();
    let value = value_text(proved);
    let indices: Vec<String> = support(&proved.claim)
        .iter()
        .map(ToString::to_string)
        .collect();
    let support = indices.join(", ");
    format!("{word} {value} exists with support {{{support}}}")
}

/// The verdict on a report that differs too much from the proven solution: both values, the proven
/// x, the worst component.
fn inaccurate_text(problem: &Problem, given: &str, proved: &Confirmed, tolerance: f64) -> String {
    let word = problem.unknown().word();
    let agreement = &proved.agreement;
    let exists = existing(problem, proved);
    let x = shown_components(&agreement.proven);

    let worst = &agreement.worst;
    let worst_text = if worst.error <= tolerance {
        format!("x agrees to {}", digits_text(worst.error))
    } else {
        format!(
            "{}[{}] is worst: expected {:.9}, got {:.9}, error {:.1e}",
            worst.vector, worst.index, worst.proven, worst.reported, worst.error
        )
    };
    // Infinite where the value is 0 and no row of the support sets a scale of values.
    let value_text = if agreement.value.is_finite() {
        format!("error of the value {:.1e}", agreement.value)
    } else {
        "the value must be 0 itself, since no row of the support sets a scale".to_string()
    };
    format!(
        "INACCURATE: {word} = {given}: {exists}, x = ({x}); {value_text}; {worst_text} \
         (largest |x_i| = 1; allowed {tolerance:e})"
    )
}

/// The first components with nine digits, and dots where there are more.
fn shown_components(x: &[f64]) -> String {
    let mut shown = Vec::new();
    for component in x.iter().take(COMPONENTS_SHOWN) {
        shown.push(format!("{component:.9}"));
    }

    if x.len() > COMPONENTS_SHOWN {
        shown.push("...".to_string());
    }

    shown.join(", ")
}

/// How many decimal digits an error of this size leaves right, as far as doubles tell.
fn digits_text(error: f64) -> String {
    let digits = (-error.log10()).floor();
    if digits >= DIGITS_OF_DOUBLES {
        format!("{DIGITS_OF_DOUBLES} or more digits")
    } else {
        counted(digits, "digit")
    }
}

/// `= 2`, `= 0.41421356237309505...` or `in [lo, hi]`.
fn value_text(proved: &Confirmed) -> String {
    let Confirmed {
        claim,
        is_reflected,
        ..
    } = proved;
    if let Some(value) = exact_value(claim) {
        let (decimal, dots) = exact_value_text(value);
        let decimal = if *is_reflected {
            negated(&decimal)
        } else {
            decimal
        };
        return format!("= {decimal}{dots}");
    }

    let interval = match claim {
        Claim::EnclosedSolution(claim) => value_interval(claim),
        _ => None,
    };
    match interval {
        Some(interval) => {
            let (mut lo, mut hi) = enclosing_decimals(&interval, VALUE_DIGITS);
            if *is_reflected {
                (lo, hi) = (negated(&hi), negated(&lo));
            }
            format!("in [{lo}, {hi}]")
        }
        // Claims that are checked have a value.
        None => "= ?".to_string(),
    }
}

/// A rational in full where it is short, else its first digits, and dots.
fn exact_value_text(mut value: Algebraic) -> (String, &'static str) {
    value.try_rational();
    let t = Poly::from_ints(&[0, 1]);
    let decimal = to_decimal(&mut value, &t, VALUE_DIGITS);

    let parsed = parse(&decimal).ok();
    let is_exact = value.as_rational().is_some() && parsed.as_ref() == value.as_rational();
    let dots = if is_exact { "" } else { "..." };
    (decimal, dots)
}

/// The interval of the value of an enclosed claim.
fn value_interval(claim: &EnclosedSolution) -> Option<Interval> {
    let center = &claim.center.last()?.0;
    let radius = &claim.radius.last()?.0;
    Interval::new(center - radius, center + radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_agree() {
        assert_eq!(digits_text(0.05), "1 digit");
        assert_eq!(digits_text(1e-3), "3 digits");
        assert_eq!(digits_text(0.9e-6), "6 digits");
        assert_eq!(digits_text(1.1e-6), "5 digits");
        assert_eq!(digits_text(2e-15), "14 digits");
        assert_eq!(digits_text(1e-16), "15 or more digits");
        assert_eq!(digits_text(0.0), "15 or more digits");
    }

    #[test]
    fn noise_is_what_the_tolerance_covers() {
        let given = Candidate {
            value: 2.0,
            x: vec![-4.0, 4e-6, -4.1e-6, 1.0],
        };

        let cleaned = without_noise(&given, 1e-6);

        assert_eq!(cleaned.value, 2.0);
        assert_eq!(cleaned.x, [-4.0, 0.0, -4.1e-6, 1.0]);
    }
}
