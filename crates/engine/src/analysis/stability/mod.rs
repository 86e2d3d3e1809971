//! Stability for every friction up to one: a certificate `mceip-stability/1`.
//!
//! | file | what |
//! |---|---|
//! | `numbers` | the system at lambda^2 = 0 in doubles |
//! | `below` | a definite matrix below a given one, entry by entry |
//!
//! The theorem of `spec/stability.md` holds at mu if there is a definite P with
//!
//! ```text
//!     P_ij <= min(T_ij - theta_i, T_ji - theta_j) - b_i b_j / 4,    b_i = mu a_i + rho_i.
//! ```
//!
//! The mu for which there is one are an interval that begins at 0, so its end is found by
//! bisection: first with the right side itself for P, then, where that gives more, with a P below
//! it. Doubles propose; the checker decides, and what it refuses is proposed again with a wider
//! margin.
//!
//! Input: K* and M* as functions of mu. Output: [`Stability`]. Called by
//! [`analyse`](super::analyse).

mod below;
mod numbers;

use super::evidence::Evidence;
use super::families::Families;
use crate::run::Watch;
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::search::complete::pieces::skyline::Skyline;
use crate::search::complete::rounding;
use crate::tolerance::{LEAST_STABLE, STABLE_END, STABLE_MARGINS};
use below::{definite_below, is_definite};
use mceip_check::Proved;
use mceip_check::certificate::{StabilityCertificate, StabilityEnd};
use mceip_exact::{Integer, Rational, parse, to_f64, truncated};
use mceip_model::Problem;
use num_traits::Zero;
use numbers::RestingNumbers;

/// Largest mu that is tried.
const MOST: f64 = 64.0;
/// A P below the right side is looked for where it gives this share more.
const WORTHWHILE: f64 = 1.01;

/// Bits of the largest entry of Q.
const BITS: i32 = 60;

/// The equilibrium is stable for every mu in (0, `to`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stability {
    /// The largest mu of which it is proved.
    pub to: Rational,
    /// Is it said of every motion that begins in contact, or only of those that keep to the contact
    /// states?
    pub is_of_every_motion: bool,
    /// The certificate.
    pub evidence: Evidence,
}

impl Stability {
    /// What a motion must do beside beginning in contact, behind a comma.
    pub(super) fn proviso(&self) -> &'static str {
        if self.is_of_every_motion {
            ""
        } else {
            ", and keeps to the contact states"
        }
    }

    /// The same behind a range of mu.
    pub(super) fn of_which_motions(&self) -> &'static str {
        if self.is_of_every_motion {
            ""
        } else {
            ", for motions that keep to the contact states"
        }
    }
}

/// A certificate for as large a mu as is found; `None` where there is none.
pub(super) fn stable_until(
    families: &Families,
    problem: &Problem,
    watch: &Watch<'_>,
) -> Option<Proved<StabilityCertificate>> {
    if !families.zero.is_empty() {
        return None;
    }

    let numbers = RestingNumbers::of(&families.own, MOST)?;
    for margin in STABLE_MARGINS {
        if watch.is_cancelled() {
            return None;
        }

        let search = StabilitySearch {
            numbers: &numbers,
            margin: margin * numbers.largest,
        };
        let to = search.largest_friction()?;
        let certificate = search.certificate(problem, &to)?;
        if let Ok(proved) = Proved::new(problem, certificate) {
            return Some(proved);
        }
    }

    None
}

/// The search with one margin for rounding.
struct StabilitySearch<'a> {
    numbers: &'a RestingNumbers,
    margin: f64,
}

/// The evidence at one mu.
struct StabilityPoint {
    /// P.
    definite: SquareMatrix,
    /// b.
    bounds: Vec<f64>,
}

/// How P is looked for.
#[derive(Clone, Copy)]
enum Looked {
    /// The right side itself.
    Itself,
    /// A matrix below the right side.
    Below,
}

impl StabilitySearch<'_> {
    /// The largest mu with a P, as a short decimal.
    fn largest_friction(&self) -> Option<Rational> {
        let plain = self.bisect(LEAST_STABLE, Looked::Itself)?;
        let beyond = WORTHWHILE * plain;
        let largest = if beyond < MOST && self.at(beyond, Looked::Below).is_some() {
            self.bisect(beyond, Looked::Below).unwrap_or(plain)
        } else {
            plain
        };

        four_digits_below(largest)
    }

    /// The end of the interval, up to [`STABLE_END`], from one of its points on.
    fn bisect(&self, from: f64, looked: Looked) -> Option<f64> {
        self.at(from, looked)?;
        let mut low = from;
        let mut high = from;
        while high < MOST && low == high {
            high = (2.0 * low).min(MOST);
            if self.at(high, looked).is_some() {
                low = high;
            }
        }

        while high - low > STABLE_END * low {
            let middle = 0.5 * (low + high);
            match self.at(middle, looked) {
                Some(_) => low = middle,
                None => high = middle,
            }
        }

        Some(low)
    }

    /// P at a mu.
    fn at(&self, mu: f64, looked: Looked) -> Option<StabilityPoint> {
        let numbers = self.numbers;
        if 2.0 * mu * numbers.accelerations > to_f64(&numbers.mass_sigma) {
            return None;
        }

        let [constant, linear] = &numbers.condensed;
        let order = constant.len();
        let rounding = 1.0 + self.margin / numbers.largest;
        let bound = |i: usize| rounding * mu * (numbers.work[i] + numbers.added[i]);
        let bounds: Vec<f64> = (0..order).map(bound).collect();

        let least = |i: usize, j: usize| {
            let t = constant[i][j] + mu * linear[i][j];
            t - mu * numbers.lost[i] - self.margin
        };
        let mut limit = SquareMatrix::with_capacity(order);
        for i in 0..order {
            let entry = |j: usize| least(i, j).min(least(j, i)) - 0.25 * bounds[i] * bounds[j];
            limit.push((0..order).map(entry).collect());
        }

        let definite = match looked {
            Looked::Itself => is_definite(&limit).then_some(limit),
            Looked::Below => definite_below(&limit),
        };
        definite.map(|definite| StabilityPoint { definite, bounds })
    }

    /// What doubles propose for the interval from 0 to a mu.
    fn certificate(&self, problem: &Problem, to: &Rational) -> Option<StabilityCertificate> {
        let end = |mu: f64| {
            let itself = self.at(mu, Looked::Itself);
            let point = itself.or_else(|| self.at(mu, Looked::Below))?;
            point.rounded()
        };

        Some(StabilityCertificate {
            problem_sha256: problem.sha256(),
            from: Rational::zero(),
            to: to.clone(),
            mass_sigma: self.numbers.mass_sigma.clone(),
            mass_factor: self.numbers.mass_factor.clone(),
            condensation: self.numbers.condensation.clone(),
            lower: end(0.0)?,
            upper: end(to_f64(to))?,
        })
    }
}

impl StabilityPoint {
    /// As a certificate has it: Q = P + b b' / 4 to the nearest, b rounded upwards.
    fn rounded(&self) -> Option<StabilityEnd> {
        let order = self.bounds.len();
        let mut q = self.definite.clone();
        for i in 0..order {
            for j in 0..order {
                q[i][j] += 0.25 * self.bounds[i] * self.bounds[j];
            }
        }

        let exponent = rounding::exponent(&q, BITS);
        let unit = f64::from(exponent).exp2();
        let upwards = |b: &f64| truncated((b * unit).ceil());
        let bounds: Vec<Integer> = self.bounds.iter().map(upwards).collect::<Option<_>>()?;

        // 4 Q - b b' is 4 P, up to rounding.
        let four_times = |row: &Vec<f64>| row.iter().map(|v| 4.0 * v).collect();
        let definite = self.definite.iter().map(four_times).collect();
        Some(StabilityEnd {
            exponent,
            symmetric: rounding::integers(&q, unit),
            bounds,
            factor: Skyline::of_rows(definite).factor_of_definite()?,
        })
    }
}

/// The largest decimal of four digits that is not above a positive number.
fn four_digits_below(value: f64) -> Option<Rational> {
    let exponent = value.log10().floor() as i32 - 3;
    let digits = (value / 10f64.powi(exponent)).floor();
    parse(&format!("{digits}e{exponent}")).ok()
}
