//! One foreign solution, one verdict: it exists (certified and checked), nothing is near
//! (enumerated), or undecided.

use super::agreement::{Agreement, agreement};
use super::report::Reported;
use crate::candidate::Candidate;
use crate::certify::certify;
use crate::multistart::{exact_value, support};
use crate::reduction::Reduced;
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};
use mceip_check::certificate::Claim;
use mceip_exact::{Interval, Poly, Rational, enclosing_decimals, from_f64, to_decimal};
use mceip_model::{Pencil, Problem, Window};
use mceip_oracle::{Enumeration, MAX_FREE, coefficient_bits, enumerate};

/// Most complementarity variables for which absence near a candidate is proved by enumeration.
pub const REFUTE_SLIP: usize = 10;

/// What may still be enumerated for the points of one report, in products of words
/// (spec/formats.md, mceip-solutions/1).
#[derive(Debug)]
pub struct Effort {
    left: u64,
}

impl Default for Effort {
    /// That of a report: a few seconds.
    fn default() -> Effort {
        Effort { left: 1 << 30 }
    }
}

impl Effort {
    fn spend(&mut self, pencil: &Pencil) -> Result<(), String> {
        let cost = enumeration_cost(
            pencil.slip().len() as u64,
            pencil.free().len() as u64,
            coefficient_bits(pencil),
        );
        match self.left.checked_sub(cost) {
            Some(left) => {
                self.left = left;
                Ok(())
            }
            None => Err(format!(
                "absence is proved with at most {} products of words more in this report, {cost} \
                 were needed (see mceip complete)",
                self.left
            )),
        }
    }
}

/// Sum over all supports of m^5 words^2, m the order of the block: Bareiss's elimination takes m^3
/// products of polynomials with up to m coefficients, each of so many words. A determinant of order
/// m has its share of the `bits` of the largest.
fn enumeration_cost(slip: u64, free: u64, bits: u64) -> u64 {
    let order = (slip + free).max(1);
    let mut supports: u64 = 1; // of k variables
    let mut cost: u64 = 0;
    for k in 0..=slip {
        let m = free + k;
        let words = 1 + bits.saturating_mul(m) / (64 * order);
        let of_one = m
            .saturating_pow(5)
            .saturating_mul(words.saturating_mul(words));
        cost = cost.saturating_add(supports.saturating_mul(of_one));
        supports = supports.saturating_mul(slip - k) / (k + 1);
    }
    cost
}

/// What became of a foreign solution.
#[derive(Debug, Clone)]
pub enum Verdict {
    /// It exists: `certify` made the claim, which the checker has accepted, and the report agrees
    /// with it to the tolerance.
    Accepted(Box<Proved>),
    /// A solution near it exists, and the report differs from that by more than the tolerance.
    Inaccurate {
        /// What exists, and by how much the report differs.
        proved: Box<Proved>,
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
pub struct Proved {
    /// The claim; `check` accepts it.
    pub claim: Claim,
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
    /// The value lies outside the window, by more than rounding.
    #[error("value {value} lies outside the window {window}")]
    OutsideWindow {
        /// The value reported.
        value: f64,
        /// The window.
        window: String,
    },
    /// The complete answer near the value holds nothing like it.
    #[error(
        "no solution with value in [{lo:?}, {hi:?}] has x within {x_radius:e} of this one (all \
         {supports} supports examined exactly, {others})"
    )]
    NothingNear {
        /// Lower end of the values examined.
        lo: f64,
        /// Upper end.
        hi: f64,
        /// Distance in x, both with e'x_s = 1.
        x_radius: f64,
        /// Supports examined.
        supports: u64,
        /// What there is instead.
        others: String,
    },
}

/// Proves a reported solution, or refutes it, within the radii of `tolerance.rs` (value 1e-4 of 1 +
/// |value|, x 1e-3). One that is proved is accepted if it agrees with the proven one to
/// `tolerance`, see [`Agreement`]. Absence near points is proved as far as `effort` goes.
pub fn judge(
    problem: &Problem,
    reduced: &Reduced,
    reported: &Reported,
    tolerance: f64,
    effort: &mut Effort,
) -> Verdict {
    let candidate = &reported.candidate;
    if candidate.x.iter().all(|v| *v == 0.0) {
        return Verdict::Rejected(Refutation::ZeroX);
    }

    let reason = match prove(problem, reduced, reported, candidate) {
        Ok(proved) if proved.agreement.is_within(tolerance) => {
            return Verdict::Accepted(Box::new(proved));
        }
        Ok(proved) => {
            // Noise in components that are zero may have led to another solution near by.
            let cleaned = without_noise(candidate, tolerance);
            let again = prove(problem, reduced, reported, &cleaned).ok();
            return match again.filter(|again| again.agreement.is_within(tolerance)) {
                Some(again) => Verdict::Accepted(Box::new(again)),
                None => Verdict::Inaccurate {
                    proved: Box::new(proved),
                    tolerance,
                },
            };
        }
        Err(reason) => reason,
    };
    match refute(problem, reduced, candidate, effort) {
        Ok(refutation) => Verdict::Rejected(refutation),
        Err(why) => Verdict::Undecided {
            reason: format!("{reason}; {why}"),
        },
    }
}

/// The solution that `certify` finds near a candidate and `check` accepts, compared with what was
/// reported.
fn prove(
    problem: &Problem,
    reduced: &Reduced,
    reported: &Reported,
    candidate: &Candidate,
) -> Result<Proved, String> {
    let claim =
        certify(problem, &reduced.pencil, candidate).map_err(|reason| reason.to_string())?;

    let agreement = agreement(problem, reduced, &claim, reported);
    let agreement =
        agreement.ok_or_else(|| "its numbers are beyond the range of doubles".to_string())?;
    Ok(Proved { claim, agreement })
}

/// The candidate with components up to `tolerance` of the largest set to zero.
fn without_noise(candidate: &Candidate, tolerance: f64) -> Candidate {
    let largest = candidate
        .x
        .iter()
        .fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let cleaned = |v: &f64| {
        if v.abs() <= tolerance * largest {
            0.0
        } else {
            *v
        }
    };
    Candidate {
        value: candidate.value,
        x: candidate.x.iter().map(cleaned).collect(),
    }
}

/// Proves that nothing is near a candidate, or says why that was not proved.
fn refute(
    problem: &Problem,
    reduced: &Reduced,
    candidate: &Candidate,
    effort: &mut Effort,
) -> Result<Refutation, String> {
    let radius = VALUE_RADIUS * (1.0 + candidate.value.abs());
    let exact = |v: f64| from_f64(v).map_err(|_| "its value is no finite number".to_string());
    let (lo, hi) = (
        exact(candidate.value - radius)?,
        exact(candidate.value + radius)?,
    );
    let window = problem.window();
    let (lo, hi) = (
        lo.max(window.min().clone()),
        window.max().map_or(hi.clone(), |m| hi.min(m.clone())),
    );
    let Ok(near) = Window::new(lo.clone(), Some(hi.clone())) else {
        return Ok(Refutation::OutsideWindow {
            value: candidate.value,
            window: window.to_string(),
        });
    };
    let slip = reduced.pencil.slip();
    if slip.len() > REFUTE_SLIP || reduced.pencil.free().len() > MAX_FREE {
        return Err(format!(
            "absence is proved for at most {REFUTE_SLIP} slip and {MAX_FREE} free variables"
        ));
    }
    effort.spend(&reduced.pencil)?;
    let found = enumerate(&reduced.pencil, &near).map_err(|e| e.to_string())?;
    if !found.is_complete_list() {
        return Err("the answer near the value has parts that are not described".into());
    }
    if nearby(&found, &slip, candidate) {
        return Err("a solution is near, but not near enough to be told from others".into());
    }
    let count = found.solutions.len() + found.cones.len() + found.ranges.len();
    let others = match count {
        0 => "there is none at all".to_string(),
        n => format!("{n} found with another x"),
    };
    let as_double = mceip_exact::to_f64;
    Ok(Refutation::NothingNear {
        lo: as_double(&lo),
        hi: as_double(&hi),
        x_radius: X_RADIUS,
        supports: found.supports_total,
        others,
    })
}

/// Could one of these solutions be the candidate, by its x? Cones and ranges: wherever their
/// supports allow it.
fn nearby(found: &Enumeration, slip: &[usize], candidate: &Candidate) -> bool {
    let close = |decimals: Vec<String>, ours: &[f64]| {
        let theirs = decimals
            .iter()
            .map(|d| d.parse::<f64>().unwrap_or(f64::NAN)); // our own decimals parse
        theirs.zip(ours).all(|(a, b)| (a - b).abs() <= X_RADIUS)
    };
    let (scaled, unit) = (normalised(&candidate.x, slip), l1(&candidate.x));
    let listed = found.solutions.iter().any(|s| {
        close(
            s.x_decimals(slip, 17),
            if s.is_free_only() { &unit } else { &scaled },
        )
    });
    let x = |i: usize| scaled[i].abs().min(unit[i].abs()).copysign(scaled[i]);
    let allowed = |support: &[usize]| {
        slip.iter().all(|i| {
            if support.contains(i) {
                x(*i) >= -X_RADIUS
            } else {
                x(*i).abs() <= X_RADIUS
            }
        })
    };
    listed
        || found.cones.iter().any(|c| allowed(&c.slip))
        || found.ranges.iter().any(|r| allowed(&r.support))
}

/// e'x_s = 1 where that sum is positive, else l1 norm 1.
fn normalised(x: &[f64], slip: &[usize]) -> Vec<f64> {
    let sum: f64 = slip.iter().map(|&i| x[i]).sum();
    if sum > 0.0 {
        x.iter().map(|v| v / sum).collect()
    } else {
        l1(x)
    }
}

fn l1(x: &[f64]) -> Vec<f64> {
    let sum: f64 = x.iter().map(|v| v.abs()).sum();
    x.iter().map(|v| v / sum).collect()
}

impl Verdict {
    /// One line for people; `word` names the unknown, `given` is the value as reported.
    pub fn line(&self, problem: &Problem, given: f64) -> String {
        let word = problem.unknown().word();
        match self {
            Verdict::Accepted(proved) => {
                let agreement = &proved.agreement;
                let value = digits_text(agreement.value);
                let x = digits_text(agreement.worst.error);
                format!(
                    "ACCEPTED: {}; proved; its value agrees to {value}, x to {x}",
                    existing(problem, &proved.claim)
                )
            }
            Verdict::Inaccurate { proved, tolerance } => {
                inaccurate_text(problem, given, proved, *tolerance)
            }
            Verdict::Rejected(why) => format!("REJECTED: {word} = {given}: {why}"),
            Verdict::Undecided { reason } => format!("UNDECIDED: {word} = {given}: {reason}"),
        }
    }
}

/// `lambda2 = 2 exists with support {0, 1}`.
fn existing(problem: &Problem, claim: &Claim) -> String {
    let indices: Vec<String> = support(claim).iter().map(ToString::to_string).collect();
    format!(
        "{} {} exists with support {{{}}}",
        problem.unknown().word(),
        value_text(claim),
        indices.join(", ")
    )
}

/// The verdict on a report that differs too much from the proven solution: both values, the proven
/// x, the worst component.
fn inaccurate_text(problem: &Problem, given: f64, proved: &Proved, tolerance: f64) -> String {
    let word = problem.unknown().word();
    let agreement = &proved.agreement;
    let worst = &agreement.worst;
    let shown: Vec<String> = agreement
        .proven
        .iter()
        .take(COMPONENTS_SHOWN)
        .map(|v| format!("{v:.9}"))
        .collect();
    let rest = if agreement.proven.len() > COMPONENTS_SHOWN {
        ", ..."
    } else {
        ""
    };

    let proven = format!(
        "{}, x = ({}{rest})",
        existing(problem, &proved.claim),
        shown.join(", ")
    );
    let worst_text = format!(
        "{}[{}] is worst: expected {:.9}, got {:.9}, error {:.1e}",
        worst.vector, worst.index, worst.proven, worst.reported, worst.error
    );
    format!(
        "INACCURATE: {word} = {given}: {proven}; error of the value {:.1e}; {worst_text} (largest \
         |x_i| = 1; allowed {tolerance:e})",
        agreement.value
    )
}

/// How many decimal digits an error of this size leaves right, as far as doubles tell.
fn digits_text(error: f64) -> String {
    let digits = (-error.log10()).floor();
    if digits >= DIGITS_OF_DOUBLES {
        format!("{DIGITS_OF_DOUBLES} or more digits")
    } else {
        format!("{digits} digits")
    }
}

/// Components of a proven x that are printed.
const COMPONENTS_SHOWN: usize = 8;

/// Digits beyond which doubles do not tell errors apart.
const DIGITS_OF_DOUBLES: f64 = 15.0;

/// `= 2`, `= 0.41421356237309505...` or `in [lo, hi]`.
fn value_text(claim: &Claim) -> String {
    if let Some(mut value) = exact_value(claim) {
        value.try_rational();
        let decimal = to_decimal(&mut value, &Poly::from_ints(&[0, 1]), 17);
        let exact = value
            .as_rational()
            .is_some_and(|r| mceip_exact::parse(&decimal).is_ok_and(|d| d == *r));
        return format!("= {decimal}{}", if exact { "" } else { "..." });
    }
    let Claim::EnclosedSolution(c) = claim else {
        return "= ?".into();
    }; // exact claims have a value once checked
    let (Some(center), Some(radius)) = (c.center.last(), c.radius.last()) else {
        return "= ?".into();
    };
    let ends: (Rational, Rational) = (&center.0 - &radius.0, &center.0 + &radius.0);
    let Some(interval) = Interval::new(ends.0, ends.1) else {
        return "= ?".into();
    };
    let (lo, hi) = enclosing_decimals(&interval, 17);
    format!("in [{lo}, {hi}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_agree() {
        let of = [0.05, 1e-3, 0.9e-6, 1.1e-6, 2e-15].map(digits_text);
        assert_eq!(
            of,
            ["1 digits", "3 digits", "6 digits", "5 digits", "14 digits"]
        );
        assert_eq!(
            [0.0, 1e-16].map(digits_text),
            ["15 or more digits", "15 or more digits"]
        );
    }

    #[test]
    fn noise_is_what_the_tolerance_covers() {
        let given = Candidate {
            value: 2.0,
            x: vec![-4.0, 4e-6, -4.1e-6, 1.0],
        };
        assert_eq!(
            without_noise(&given, 1e-6),
            Candidate {
                value: 2.0,
                x: vec![-4.0, 0.0, -4.1e-6, 1.0]
            }
        );
    }
}
