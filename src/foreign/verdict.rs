//! One foreign solution, one verdict: it exists (certified and checked), nothing is near (enumerated), or undecided.

use crate::candidate::Candidate;
use crate::certificate::Claim;
use crate::certify::certify;
use crate::exact::{Interval, Poly, Rational, enclosing_decimals, from_f64, to_decimal};
use crate::model::{Problem, Window};
use crate::multistart::{exact_value, support};
use crate::oracle::{Enumeration, MAX_FREE, enumerate};
use crate::reduction::Reduced;
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};

/// Most complementarity variables for which absence near a candidate is proved by enumeration.
pub const REFUTE_SLIP: usize = 10;

/// What became of a foreign solution.
#[derive(Debug, Clone)]
pub enum Verdict {
    /// It exists: `certify` made this claim, which the checker has accepted.
    Accepted(Box<Claim>),
    /// It does not: proved.
    Rejected(Refutation),
    /// Neither was proved.
    Undecided {
        /// Why it was not certified, and why absence was not proved.
        reason: String,
    },
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
        "no solution with value in [{lo:?}, {hi:?}] has x within {x_radius:e} of this one (all {supports} supports examined exactly, {others})"
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

/// Proves a candidate, or refutes it, within the radii of `tolerance.rs` (value 1e-4 of 1 + |value|, x 1e-3).
pub fn judge(problem: &Problem, reduced: &Reduced, candidate: &Candidate) -> Verdict {
    if candidate.x.iter().all(|v| *v == 0.0) {
        return Verdict::Rejected(Refutation::ZeroX);
    }
    let reason = match certify(problem, &reduced.pencil, candidate) {
        Ok(claim) => return Verdict::Accepted(Box::new(claim)),
        Err(reason) => reason,
    };
    match refute(problem, reduced, candidate) {
        Ok(refutation) => Verdict::Rejected(refutation),
        Err(why) => Verdict::Undecided { reason: format!("{reason}; {why}") },
    }
}

/// Proves that nothing is near a candidate, or says why that was not proved.
fn refute(problem: &Problem, reduced: &Reduced, candidate: &Candidate) -> Result<Refutation, String> {
    let radius = VALUE_RADIUS * (1.0 + candidate.value.abs());
    let exact = |v: f64| from_f64(v).map_err(|_| "its value is no finite number".to_string());
    let (lo, hi) = (exact(candidate.value - radius)?, exact(candidate.value + radius)?);
    let window = problem.window();
    let (lo, hi) = (lo.max(window.min().clone()), window.max().map_or(hi.clone(), |m| hi.min(m.clone())));
    let Ok(near) = Window::new(lo.clone(), Some(hi.clone())) else {
        let max = window.max().map_or_else(|| "infinity)".into(), |m| format!("{m}]"));
        return Ok(Refutation::OutsideWindow { value: candidate.value, window: format!("[{}, {max}", window.min()) });
    };
    let slip = reduced.pencil.slip();
    if slip.len() > REFUTE_SLIP || reduced.pencil.free().len() > MAX_FREE {
        return Err(format!("absence is proved for at most {REFUTE_SLIP} slip and {MAX_FREE} free variables"));
    }
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
    let as_double = crate::exact::to_f64;
    Ok(Refutation::NothingNear { lo: as_double(&lo), hi: as_double(&hi), x_radius: X_RADIUS, supports: found.supports_total, others })
}

/// Could one of these solutions be the candidate, by its x? Cones and ranges: wherever their supports allow it.
fn nearby(found: &Enumeration, slip: &[usize], candidate: &Candidate) -> bool {
    let close = |decimals: Vec<String>, ours: &[f64]| {
        let theirs = decimals.iter().map(|d| d.parse::<f64>().unwrap_or(f64::NAN)); // our own decimals parse
        theirs.zip(ours).all(|(a, b)| (a - b).abs() <= X_RADIUS)
    };
    let (scaled, unit) = (normalised(&candidate.x, slip), l1(&candidate.x));
    let listed = found.solutions.iter().any(|s| close(s.x_decimals(slip, 17), if s.is_free_only() { &unit } else { &scaled }));
    let x = |i: usize| scaled[i].abs().min(unit[i].abs()).copysign(scaled[i]);
    let allowed = |support: &[usize]| slip.iter().all(|i| if support.contains(i) { x(*i) >= -X_RADIUS } else { x(*i).abs() <= X_RADIUS });
    listed || found.cones.iter().any(|c| allowed(&c.slip)) || found.ranges.iter().any(|r| allowed(&r.support))
}

/// e'x_s = 1 where that sum is positive, else l1 norm 1.
fn normalised(x: &[f64], slip: &[usize]) -> Vec<f64> {
    let sum: f64 = slip.iter().map(|&i| x[i]).sum();
    if sum > 0.0 { x.iter().map(|v| v / sum).collect() } else { l1(x) }
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
            Verdict::Accepted(claim) => {
                let indices: Vec<String> = support(claim).iter().map(ToString::to_string).collect();
                format!("ACCEPTED: {word} {} exists with support {{{}}}; proved", value_text(claim), indices.join(", "))
            }
            Verdict::Rejected(why) => format!("REJECTED: {word} = {given}: {why}"),
            Verdict::Undecided { reason } => format!("UNDECIDED: {word} = {given}: {reason}"),
        }
    }
}

/// `= 2`, `= 0.41421356237309505...` or `in [lo, hi]`.
fn value_text(claim: &Claim) -> String {
    if let Some(mut value) = exact_value(claim) {
        value.try_rational();
        let decimal = to_decimal(&mut value, &Poly::from_ints(&[0, 1]), 17);
        let exact = value.as_rational().is_some_and(|r| crate::exact::parse(&decimal).is_ok_and(|d| d == *r));
        return format!("= {decimal}{}", if exact { "" } else { "..." });
    }
    let Claim::EnclosedSolution(c) = claim else { return "= ?".into() }; // exact claims have a value once checked
    let (Some(center), Some(radius)) = (c.center.last(), c.radius.last()) else { return "= ?".into() };
    let ends: (Rational, Rational) = (&center.0 - &radius.0, &center.0 + &radius.0);
    let Some(interval) = Interval::new(ends.0, ends.1) else { return "= ?".into() };
    let (lo, hi) = enclosing_decimals(&interval, 17);
    format!("in [{lo}, {hi}]")
}
