//! A claimed solution in doubles, untrusted: what solvers and reports hand to `certify`.

use crate::tolerance::{SUPPORT_GUESSES, VALUE_RADIUS};
use mceip_check::backward_error;
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::{Body, Problem, Window, ZeroVariables};
use num_traits::{Signed as _, Zero as _};

/// The format of solution reports.
pub const SOLUTIONS_FORMAT: &str = "mceip-solutions/1";

/// Digits of a backward error that are printed, the last one rounded up.
pub const BACKWARD_ERROR_DIGITS: usize = 2;

/// A claimed solution: a value of the unknown and x over the variables of the pencil.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The value of lambda^2 or mu.
    pub value: f64,
    /// x, in any positive scale.
    pub x: Vec<f64>,
}

/// The vector divided by its largest modulus: the scale in which vectors are compared
/// (spec/formats.md, mceip-solutions/1). `None` where that is zero or no finite number.
pub fn scaled(x: &[f64]) -> Option<Vec<f64>> {
    let mut largest: f64 = 0.0;
    for component in x {
        if !component.is_finite() {
            return None;
        }
        largest = largest.max(component.abs());
    }
    if largest == 0.0 {
        return None;
    }

    Some(x.iter().map(|component| component / largest).collect())
}

/// The same for exact numbers, which may lie beyond the range of doubles: they are divided before
/// they are rounded. `None` for the zero vector.
pub fn scaled_exactly(x: &[Rational]) -> Option<Vec<f64>> {
    let largest = x.iter().map(|component| component.abs()).max()?;
    if largest.is_zero() {
        return None;
    }

    Some(
        x.iter()
            .map(|component| to_f64(&(component / &largest)))
            .collect(),
    )
}

/// Largest difference of a component of two vectors of one length, both [`scaled`]; infinite where
/// one of them has no scale.
pub fn distance(x: &[f64], other: &[f64]) -> f64 {
    let (Some(x), Some(other)) = (scaled(x), scaled(other)) else {
        return f64::INFINITY;
    };

    let mut largest: f64 = 0.0;
    for (ours, theirs) in x.iter().zip(&other) {
        largest = largest.max((ours - theirs).abs());
    }

    largest
}

impl Candidate {
    /// A value and x over the variables that the problem was given with.
    ///
    /// Of a quadratic pencil z = x / (1 + |t|) of its linear form is added, which is that of the
    /// reflected pencil where t < 0.
    pub fn given(problem: &Problem, value: f64, mut x: Vec<f64>) -> Candidate {
        if let Body::Quadratic(_) = problem.body() {
            let divisor = 1.0 + value.abs();
            let z: Vec<f64> = x.iter().map(|x_i| x_i / divisor).collect();
            x.extend(z);
        }

        Candidate { value, x }
    }

    /// The largest component among the slip variables, at least 0.
    pub(crate) fn largest_slip(&self, slip: &[usize]) -> f64 {
        slip.iter().map(|&i| self.x[i]).fold(0.0, f64::max)
    }

    /// The positive components among the slip variables, by each of the guesses of what counts as
    /// positive ([`SUPPORT_GUESSES`]).
    pub(crate) fn supports(&self, slip: &[usize]) -> impl Iterator<Item = Vec<usize>> {
        let largest = self.largest_slip(slip);
        SUPPORT_GUESSES.iter().map(move |share| {
            let mut support = slip.to_vec();
            support.retain(|&i| self.x[i] > share * largest);
            support
        })
    }

    /// Are these the positive components among the slip variables, by one of the guesses?
    pub fn has_support(&self, slip: &[usize], support: &[usize]) -> bool {
        self.supports(slip).any(|guess| guess == support)
    }

    /// The ends of the interval of values near this one, within [`VALUE_RADIUS`].
    pub(crate) fn near(&self) -> [f64; 2] {
        let radius = VALUE_RADIUS * (1.0 + self.value.abs());
        [self.value - radius, self.value + radius]
    }

    /// The same solution of the reflected pencil: the value changes its sign.
    pub fn reflected(&self) -> Candidate {
        Candidate {
            value: -self.value,
            x: self.x.clone(),
        }
    }

    /// The ends of those values in a window; the lower one is above the upper one where there are
    /// none. `None` for a value that is no finite number.
    pub(crate) fn values_near(&self, window: &Window) -> Option<[Rational; 2]> {
        let [lo, hi] = self.near().map(from_f64);
        let lo = lo.ok()?.max(window.min().clone());
        let hi = hi.ok()?;
        Some(match window.max() {
            Some(max) => [lo, hi.min(max.clone())],
            None => [lo, hi],
        })
    }

    /// The backward error of these numbers, found by the checker: [`mceip_check::backward_error`].
    ///
    /// # Errors
    /// The checker's refusal, or the number that is not finite.
    pub fn backward_error(&self, problem: &Problem) -> Result<Rational, String> {
        let value = from_f64(self.value).map_err(|e| e.to_string())?;
        let mut x = Vec::with_capacity(self.x.len());
        for component in &self.x {
            x.push(from_f64(*component).map_err(|e| e.to_string())?);
        }

        backward_error(problem, &value, &x).map_err(|rejected| rejected.to_string())
    }

    /// The same motion, with at most one of v+ and v- positive at each particle in contact with
    /// zero reaction: both less the lesser one.
    pub fn one_sided(&self, zero: &[ZeroVariables]) -> Candidate {
        let mut candidate = self.clone();
        for variables in zero {
            let ZeroVariables { right, left, .. } = *variables;
            let to_right = self.x.get(right).copied().unwrap_or_default();
            let to_left = self.x.get(left).copied().unwrap_or_default();
            let common = to_right.min(to_left);
            if common > 0.0 {
                candidate.x[right] -= common;
                candidate.x[left] -= common;
            }
        }

        candidate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A free component that is much larger than those of the slip variables is the scale.
    #[test]
    fn vectors_are_compared_at_largest_component_one() {
        assert_eq!(distance(&[-4.0, 1.0], &[-8.0, 2.0]), 0.0);
        assert_eq!(distance(&[-4.0, 1.0], &[-8.0, 4.0]), 0.25);
        assert_eq!(distance(&[1000.0, 1.0], &[1000.0, 2.0]), 0.001);
        assert_eq!(distance(&[1e308, 1e308], &[1.0, 1.0]), 0.0);

        assert_eq!(distance(&[0.0, 0.0], &[1.0, 0.0]), f64::INFINITY);
        assert_eq!(distance(&[f64::NAN], &[1.0]), f64::INFINITY);
    }
}
