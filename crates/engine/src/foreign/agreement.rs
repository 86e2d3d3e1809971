//! How near a reported solution is to the proven one.
//!
//! Value: |reported - proven| / max(|proven|, floor). The floor, VALUE_FLOOR times the least
//! (|A||x|)_i / (|B||x|)_i over the active rows i in which B takes part, keeps the error of a value
//! at or near 0 meaningful: t B x balances A x in each of these rows. x: both vectors are scaled to
//! largest |x_i| = 1, and the largest difference of a component counts. What a proof leaves open
//! (the half widths of an enclosure) is added to each difference, so that an error is never
//! understated. A v that leaves v_d = 0 or v_Ns = 0 counts like a component of x.
//!
//! Input: an accepted claim and the report's numbers in doubles. Called by `judge`.

use super::report::Reported;
use crate::candidate::{Candidate, scaled};
use crate::certify::rows::active;
use crate::multistart::support;
use crate::report::Listed;
use crate::tolerance::VALUE_FLOOR;
use mceip_check::certificate::Claim;
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::{Pencil, Problem, Reduced};
use num_traits::{Signed, Zero};

/// Errors of a reported solution, relative to the proven one.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Error of the value.
    pub value: f64,
    /// The component that differs most; its error is that of x.
    pub worst: Component,
    /// The proven x, largest |x_i| = 1.
    pub proven: Vec<f64>,
}

/// A component of x (or of v) as reported and as proven, both vectors scaled to largest component
/// 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Component {
    /// `x` or `v`.
    pub vector: &'static str,
    /// Its index.
    pub index: usize,
    /// As reported.
    pub reported: f64,
    /// As proven.
    pub proven: f64,
    /// Upper bound of the difference.
    pub error: f64,
}

impl Agreement {
    /// Do value and x agree to this relative error?
    pub fn is_within(&self, tolerance: f64) -> bool {
        let has_value = self.value <= tolerance;
        let has_x = self.worst.error <= tolerance;
        has_value && has_x
    }
}

/// A proven number: center and half width of an interval that holds it.
#[derive(Clone, Copy)]
struct ProvenNumber {
    center: f64,
    radius: f64,
}

impl ProvenNumber {
    fn exact(center: f64) -> ProvenNumber {
        ProvenNumber {
            center,
            radius: 0.0,
        }
    }
}

/// What a claim proves, in doubles.
struct Proven {
    value: ProvenNumber,
    /// x over all variables of the pencil, in the claim's own scale.
    x: Vec<ProvenNumber>,
    /// How many of them a report has.
    reported: usize,
}

impl Proven {
    /// `None` for numbers beyond the range of doubles.
    fn of(problem: &Problem, reduced: &Reduced, claim: &Claim) -> Option<Proven> {
        let listed = Listed::of_claim(problem, reduced, claim);
        let mut proven = Proven {
            value: ProvenNumber::exact(finite(&listed.value)?),
            x: Vec::new(),
            reported: listed.x.len(),
        };
        let mut x = Vec::with_capacity(listed.x.len());
        for decimal in &listed.x {
            x.push(finite(decimal)?);
        }
        let candidate = Candidate::given(problem, proven.value.center, x);
        proven.x = candidate.x.into_iter().map(ProvenNumber::exact).collect();

        if let Claim::EnclosedSolution(claim) = claim {
            proven.value.radius = to_f64(&claim.radius.last()?.0);
            let active = active(&reduced.pencil, &claim.support);
            for (i, radius) in active.into_iter().zip(&claim.radius) {
                proven.x[i].radius = to_f64(&radius.0);
            }
        }

        Some(proven)
    }
}

/// One of our own decimals as a double.
fn finite(decimal: &str) -> Option<f64> {
    let value: f64 = decimal.parse().ok()?;
    value.is_finite().then_some(value)
}

/// The errors of a reported solution against the claim that proves one near it.
pub(super) fn agreement(
    problem: &Problem,
    reduced: &Reduced,
    claim: &Claim,
    reported: &Reported,
) -> Option<Agreement> {
    let proven = Proven::of(problem, reduced, claim)?;
    let floor = value_floor(&reduced.pencil, support(claim), &proven.x);
    let value = value_error(reported.candidate.value, proven.value, floor);
    let compared = &proven.x[..proven.reported];
    let (mut worst, scaled) = worst_component(&reported.candidate.x, compared)?;

    if let Some(off) = reported.off.filter(|off| off.size > worst.error) {
        worst = Component {
            vector: "v",
            index: off.dof,
            reported: off.size,
            proven: 0.0,
            error: off.size,
        };
    }

    Some(Agreement {
        value,
        worst,
        proven: scaled,
    })
}

/// |reported - proven| / max(|proven|, floor), with the radius added to the difference.
fn value_error(reported: f64, proven: ProvenNumber, floor: f64) -> f64 {
    let difference = (reported - proven.center).abs() + proven.radius;
    if difference == 0.0 {
        0.0
    } else {
        difference / proven.center.abs().max(floor)
    }
}

/// VALUE_FLOOR min_i (|A||x|)_i / (|B||x|)_i over the active rows with (|B||x|)_i > 0; 0 where
/// there are none, since then there is no scale of values.
fn value_floor(pencil: &Pencil, support: &[usize], x: &[ProvenNumber]) -> f64 {
    let mut moduli = Vec::new();
    for ball in x {
        moduli.push(from_f64(ball.center.abs()).unwrap_or_default());
    }

    let mut least: Option<Rational> = None;
    for &i in pencil.free().iter().chain(support) {
        let of_b = weighted(pencil.b().row(i), &moduli);
        if of_b.is_zero() {
            continue;
        }
        let ratio = weighted(pencil.a().row(i), &moduli) / of_b;
        if least.as_ref().is_none_or(|least| ratio < *least) {
            least = Some(ratio);
        }
    }

    let scale = to_f64(&least.unwrap_or_default());
    if scale.is_finite() {
        VALUE_FLOOR * scale
    } else {
        0.0
    }
}

/// sum_j |row_j| |x_j|.
fn weighted(row: &[(usize, Rational)], moduli: &[Rational]) -> Rational {
    let terms = row.iter().map(|(j, v)| v.abs() * &moduli[*j]);
    terms.sum()
}

/// The component that differs most, and the proven x scaled to largest |x_i| = 1.
fn worst_component(reported: &[f64], proven: &[ProvenNumber]) -> Option<(Component, Vec<f64>)> {
    let reported = scaled(reported)?;
    let largest_proven = proven
        .iter()
        .max_by(|p, q| p.center.abs().total_cmp(&q.center.abs()))?;
    let proven_scale = largest_proven.center.abs();
    if proven_scale == 0.0 {
        return None;
    }

    // Division by a scale known up to this relative error moves each component by as much of
    // itself.
    let scale_error = largest_proven.radius / proven_scale;

    let mut worst: Option<Component> = None;
    let mut scaled = Vec::new();
    for (index, (&reported, known)) in reported.iter().zip(proven).enumerate() {
        let proven = known.center / proven_scale;
        let radius = known.radius / proven_scale + proven.abs() * scale_error;
        let error = (reported - proven).abs() + radius;

        scaled.push(proven);
        if worst.is_none_or(|w| error > w.error) {
            worst = Some(Component {
                vector: "x",
                index,
                reported,
                proven,
                error,
            });
        }
    }

    worst.map(|worst| (worst, scaled))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    #[test]
    fn errors_of_values_are_relative_down_to_the_floor() {
        assert_eq!(value_error(2.5, ProvenNumber::exact(2.0), 0.5), 0.25);
        assert_eq!(value_error(2.5, ProvenNumber::exact(2.0), 4.0), 0.125);
        assert_eq!(value_error(0.5, ProvenNumber::exact(0.0), 2.0), 0.25);
        assert_eq!(value_error(0.0, ProvenNumber::exact(0.0), 0.0), 0.0);

        let wide = ProvenNumber {
            center: 2.0,
            radius: 0.5,
        };
        assert_eq!(value_error(2.5, wide, 0.0), 0.5);
    }

    fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
        let a = Sparse::from_ints(a);
        let b = Sparse::from_ints(b);
        Pencil::new(a, b, free.to_vec()).unwrap()
    }

    fn exact(x: &[f64]) -> Vec<ProvenNumber> {
        x.iter().map(|v| ProvenNumber::exact(*v)).collect()
    }

    /// The floor of a pencil with entries of these sizes.
    fn floor_for_sizes(a: i64, b: i64) -> f64 {
        let pencil = pencil(&[&[a, a], &[-a, a]], &[&[b, 0], &[0, b]], &[]);
        value_floor(&pencil, &[0, 1], &exact(&[1.0, -1.0]))
    }

    /// The floor follows the unit of values: A in other units moves it, and so does B. Signs do not
    /// cancel.
    #[test]
    fn the_floor_is_in_the_unit_of_values() {
        assert_eq!(floor_for_sizes(-6, 2), 6.0 * VALUE_FLOOR);
        assert_eq!(floor_for_sizes(-6000, 2), 6000.0 * VALUE_FLOOR);
        assert_eq!(floor_for_sizes(-6, 0), 0.0);
    }

    /// What takes no part in the solution does not move the floor: rows at rest, and rows
    /// multiplied by a large number.
    #[test]
    fn stiff_rows_elsewhere_do_not_move_the_floor() {
        let at_rest = pencil(&[&[-3, 0], &[0, 1_000_000_000]], &[&[1, 0], &[0, 1]], &[]);
        let floor = value_floor(&at_rest, &[0], &exact(&[1.0, 0.0]));
        assert_eq!(floor, 3.0 * VALUE_FLOOR);

        let stiff_row: &[i64] = &[1_000_000_000, -1_000_000_000];
        let stiff = pencil(&[&[-3, 0], stiff_row], &[&[1, 0], &[0, 0]], &[1]);
        let floor = value_floor(&stiff, &[0], &exact(&[1.0, 1.0]));
        assert_eq!(floor, 3.0 * VALUE_FLOOR);
    }

    /// Any positive scale; the largest component of each vector is 1 before they are compared.
    #[test]
    fn components_are_compared_at_largest_component_one() {
        let proven = exact(&[-4.0, 1.0, 0.5]);

        let (worst, scaled) = worst_component(&[-8.0, 2.0, 0.0], &proven).unwrap();

        assert_eq!(scaled, [-1.0, 0.25, 0.125]);
        let expected = Component {
            vector: "x",
            index: 2,
            reported: 0.0,
            proven: 0.125,
            error: 0.125,
        };
        assert_eq!(worst, expected);

        let wide = ProvenNumber {
            center: 4.0,
            radius: 1.0,
        };
        let (worst, _) = worst_component(&[8.0, 2.0], &[wide, ProvenNumber::exact(1.0)]).unwrap();
        assert_eq!((worst.index, worst.error), (0, 0.5));

        assert!(worst_component(&[0.0], &exact(&[1.0])).is_none());
        assert!(worst_component(&[1.0], &exact(&[0.0])).is_none());
    }
}
