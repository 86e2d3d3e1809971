//! A solution as a caller reads it.

use mceip_check::AcceptedClaim;
use mceip_engine::report::Listed;
use mceip_exact::{Interval, Rational};
use mceip_model::Unknown;
use std::fmt;

/// A solution that the checker has accepted.
///
/// What is proved is that the problem has a solution with this support and a value in
/// [`Solution::enclosure`]; `value`, `x`, `y`, `v` and `w` are its components to the precision of
/// doubles.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// Which number `value` is.
    pub unknown: Unknown,
    /// lambda^2 or mu.
    pub value: f64,
    /// Encloses the value, with rational ends.
    pub enclosure: Interval,
    /// The support: indices of complementarity variables with x_i > 0; of a body, the particles in
    /// impending slip that slip.
    pub support: Vec<usize>,
    /// Indices with x_i = y_i = 0, where that is proved; empty where the solution is only enclosed.
    pub biactive: Vec<usize>,
    /// x over the variables of the pencil, scaled so that its complementarity variables sum to one;
    /// empty where it is not known.
    pub x: Vec<f64>,
    /// y = (A + tB) x.
    pub y: Vec<f64>,
    /// Displacements v over the degrees of freedom, the mode of (8); `None` for a problem that was
    /// given as a pencil.
    pub v: Option<Vec<f64>>,
    /// Reaction rates w over the degrees of freedom; `None` for a problem given as a pencil.
    pub w: Option<Vec<f64>>,
}

impl Solution {
    /// What the checker has proved, with the decimals of its components.
    pub(super) fn new(unknown: Unknown, proved: &AcceptedClaim, listed: &Listed) -> Solution {
        let lifted = listed.lifted.as_ref();
        Solution {
            unknown,
            value: double(&listed.value),
            enclosure: proved.value.clone(),
            support: proved.support.clone(),
            biactive: listed.biactive.clone(),
            x: doubles(&listed.x),
            y: doubles(&listed.y),
            v: lifted.map(|(v, _)| doubles(v)),
            w: lifted.map(|(_, w)| doubles(w)),
        }
    }

    /// The value itself, where it is rational and known.
    pub fn exact_value(&self) -> Option<&Rational> {
        self.enclosure.is_point().then(|| self.enclosure.lo())
    }
}

/// "lambda2 = 2, support [0, 1]".
impl fmt::Display for Solution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unknown = self.unknown.word();
        write!(f, "{unknown} = {}, support {:?}", self.value, self.support)
    }
}

/// A solution as it is proved, and as it is listed.
pub(super) type SolutionEntry = (AcceptedClaim, Listed);

/// The solutions of both signs by value, then by support; `reflected` are those of the reflected
/// problem. What has the value 0 is in both, and listed once.
pub(super) fn entries_of_both_signs(
    own: Vec<SolutionEntry>,
    reflected: Vec<SolutionEntry>,
) -> Vec<SolutionEntry> {
    let reflected = reflected.into_iter();
    let reflected = reflected.map(|(proved, listed)| (proved.reflected(), listed.reflected()));
    let mut entries: Vec<SolutionEntry> = own.into_iter().chain(reflected).collect();
    entries.sort_by(|(p, _), (q, _)| {
        let by_value = p.value.lo().cmp(q.value.lo());
        by_value.then_with(|| p.support.cmp(&q.support))
    });
    entries.dedup_by(|next, kept| next.0 == kept.0);
    entries
}

/// The nearest double of a decimal that our own writer has made.
fn double(decimal: &str) -> f64 {
    decimal.parse().unwrap_or(f64::NAN)
}

/// The nearest doubles of such decimals.
fn doubles(decimals: &[String]) -> Vec<f64> {
    decimals.iter().map(|d| double(d)).collect()
}
