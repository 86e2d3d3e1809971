//! How far a reported solution is from the nearest one of the complete answer.
//!
//! ```text
//! value:  |t - t*| / (1 + |t*|)        x:  max |x_i - x*_i|,  both at largest |x_i| = 1
//! ```
//!
//! A solution that `certify` does not reach is inaccurate where one of
//! the answer with the same positive components is within [`NEAR_RADII`] times what `certify`
//! allows; any other one is wrong, and [`hint`] says which value of the answer is nearest.
//! Called by `judge`.

use super::case::{Case, CaseAnswer, ListedPoint};
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

/// What a wrong solution may have been meant for: the value with the other sign where the answer
/// has that with the same positive components, else the nearest value of the answer with both
/// distances.
///
/// None where the answer has no values, or a continuum of them.
pub(super) fn hint(case: &Case, reported: &Candidate) -> Option<String> {
    let slip = case.reduced().pencil.slip();
    let mut listed = case.points();
    if let CaseAnswer::Enumerated(answer) = &case.answer {
        if !answer.ranges.is_empty() {
            return None;
        }
        let centers = answer.cones.iter().map(|cone| cone.center(&slip));
        listed.extend(centers.map(|center| ListedPoint::of_solution(&center, &slip)));
    }

    let nearest = nearest_value(listed.iter(), reported)?;
    let of_support = listed
        .iter()
        .filter(|point| reported.has_support(&slip, &point.support));
    let opposite = nearest_value(of_support, &reported.reflected());
    let is_opposite = |opposite: &Distance| opposite.of_value <= VALUE_RADIUS;
    Some(match opposite.filter(is_opposite) {
        Some(opposite) if nearest.of_value > VALUE_RADIUS => format!(
            "the answer has {}: the sign of the value is flipped",
            opposite.value
        ),
        _ => nearest.to_string(),
    })
}

/// The distances from the solution with the nearest value, and of those from the nearest in x.
fn nearest_value<'a>(
    listed: impl Iterator<Item = &'a ListedPoint>,
    reported: &Candidate,
) -> Option<Distance> {
    let distances = listed.filter_map(|point| Distance::between(point, reported));
    distances.min_by(|a, b| {
        let by_value = a.of_value.total_cmp(&b.of_value);
        by_value.then(a.of_x.total_cmp(&b.of_x))
    })
}

impl std::fmt::Display for Distance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the nearest solution of the answer has the value {}: off by {:.1e} in the value, \
             relative to 1 + |value| (allowed {VALUE_RADIUS:e}), and by {:.1e} in x (allowed \
             {X_RADIUS:e})",
            self.value, self.of_value, self.of_x
        )
    }
}
