//! How far a reported solution is from the nearest one of the complete answer.
//!
//! ```text
//! value:  |t - t*| / (1 + |t*|)        x:  max |x_i - x*_i|,  both at largest |x_i| = 1
//! ```
//!
//! A solution that `certify` does not reach is inaccurate where one of
//! the answer with the same positive components is within [`NEAR_RADII`] times what `certify`
//! allows; any other one is wrong. Called by `judge`.

use super::case::{Case, ListedPoint};
use mceip_engine::candidate::{Candidate, distance};
use mceip_engine::tolerance::{NEAR_RADII, VALUE_RADIUS, X_RADIUS};
use mceip_exact::{nearest_decimal, parse};

/// The distances of a reported solution from one of the answer.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Distance {
    /// The value of the answer.
    value: String,
    /// Of the values, relative to 1 + |value|.
    of_value: f64,
    /// Of x, the largest of a component.
    of_x: f64,
}

impl Distance {
    /// From the solution of the answer that is nearest in x, among those with its positive
    /// components that are near; none where there is no such solution.
    pub(super) fn to_nearest(case: &Case, reported: &Candidate) -> Option<Distance> {
        let slip = case.reduced().pencil.slip();
        let mut nearest: Option<Distance> = None;

        for listed in case.points() {
            if !reported.has_support(&slip, &listed.support) {
                continue;
            }
            let Some(distance) = Distance::between(&listed, reported) else {
                continue;
            };

            let is_nearer = nearest.as_ref().is_none_or(|n| distance.of_x < n.of_x);
            if distance.is_near() && is_nearer {
                nearest = Some(distance);
            }
        }

        nearest
    }

    fn is_near(&self) -> bool {
        self.of_value <= NEAR_RADII * VALUE_RADIUS && self.of_x <= NEAR_RADII * X_RADIUS
    }

    /// `None` for an x that has no scale, or numbers beyond the doubles.
    fn between(listed: &ListedPoint, reported: &Candidate) -> Option<Distance> {
        let exact_value: f64 = listed.value.parse().ok()?;

        let mut x = Vec::new();
        for decimal in &listed.x {
            x.push(decimal.parse().ok()?);
        }
        let of_x = distance(&x, &reported.x);

        let of_value = (reported.value - exact_value).abs() / (1.0 + exact_value.abs());
        let distance = Distance {
            value: nearest_decimal(&parse(&listed.value).ok()?, 9),
            of_value,
            of_x,
        };
        (of_value.is_finite() && of_x.is_finite()).then_some(distance)
    }
}

impl std::fmt::Display for Distance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the answer has the value {}: off by {:.1e} in the value (allowed {VALUE_RADIUS:e}) \
             and by {:.1e} in x (allowed {X_RADIUS:e})",
            self.value, self.of_value, self.of_x
        )
    }
}
