//! Solutions of one support as a curve t(mu), in doubles, t = lambda^2.
//!
//! On the support S a solution has T_SS(t, mu) x = 0, e'x = 1, with T(t, mu) = T0(t) + mu T1(t).
//! Newton's method solves this for (x, t) at a given mu, and for (x, mu) at a given t. With left
//! and right null vectors u and x of T_SS
//!
//! ```text
//!     dt / dmu = - u' T1 x / u' T_t x.
//! ```
//!
//! T comes from the expansions that the certificate will rest on, remainders left out. Called by
//! `climb`.

use super::super::absence::Family;
use super::super::follow::{left_null_vector, newton_step, toggled, violated};
use crate::search::complete::pieces::expansion::Expansion;
use crate::search::complete::pieces::matrix::{Matrix, bilinear, principal_block, times};
use crate::tolerance::NEWTON_CONVERGED;
use mceip_exact::to_f64;

/// Newton steps at one point.
const NEWTON_STEPS: usize = 20;

/// A solution in doubles.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// lambda^2.
    pub(super) t: f64,
    pub(super) mu: f64,
    /// Over the slip variables, of sum one.
    pub(super) x: Vec<f64>,
    /// Positions with x_i > 0, ascending.
    pub(super) support: Vec<usize>,
    /// Left null vector over the support.
    pub(super) left: Vec<f64>,
    /// dt / dmu along the support.
    pub(super) slope: f64,
    /// A position where x_i or y_i has the wrong sign.
    pub(super) violated: Option<usize>,
}

/// What Newton's method solves for beside x.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Unknown {
    Lambda2,
    Friction,
}

/// The curves of a system.
#[derive(Clone, Copy)]
pub(super) struct Curves<'a> {
    pub(super) family: &'a Family,
}

impl<'a> Curves<'a> {
    /// The anchor that serves a value of lambda^2.
    pub(super) fn anchor(&self, t: f64) -> Option<usize> {
        let pieces = &self.family.pieces;
        let holds = |hi: &Option<_>| hi.as_ref().is_none_or(|hi| t < to_f64(hi));
        let piece = pieces.iter().find(|piece| holds(&piece.hi));
        piece.and_then(|piece| piece.anchor)
    }

    pub(super) fn expansions(&self, t: f64) -> &'a [Expansion; 2] {
        self.family.expansions(self.anchor(t))
    }

    /// The unit of lambda^2.
    pub(super) fn scale(&self) -> f64 {
        self.family.view().scale
    }

    /// T at a point.
    pub(super) fn matrix(&self, t: f64, mu: f64) -> Matrix {
        let [constant, slope] = self.expansions(t);
        combined(constant.at(t), mu, &slope.at(t))
    }

    /// The solution of a support at a given mu, from a guess.
    pub(super) fn at_friction(&self, mu: f64, guess: &Point) -> Option<Point> {
        let t = (guess.t + guess.slope * (mu - guess.mu)).max(0.0);
        self.solved(Unknown::Lambda2, [t, mu], guess)
    }

    /// A solution near a guess. Components that turn out negative leave the support, and y_i < 0
    /// enters it.
    pub(super) fn near(&self, [t, mu]: [f64; 2], x: &[f64], of_friction: bool) -> Option<Point> {
        let unknown = if of_friction {
            Unknown::Friction
        } else {
            Unknown::Lambda2
        };
        let mut guess = Point {
            t,
            mu,
            x: x.to_vec(),
            support: (0..x.len()).filter(|&i| x[i] > 0.0).collect(),
            left: Vec::new(),
            slope: 0.0,
            violated: None,
        };
        for _ in 0..=x.len() {
            let point = self.solved(unknown, [guess.t, guess.mu], &guess)?;
            let Some(position) = point.violated else {
                return Some(point);
            };
            guess = beyond(&point, position);
        }

        None
    }

    fn solved(&self, unknown: Unknown, place: [f64; 2], guess: &Point) -> Option<Point> {
        let support = &guess.support;
        let [mut t, mut mu] = place;
        let mut x: Vec<f64> = support.iter().map(|&i| guess.x[i]).collect();
        let sum: f64 = x.iter().sum();
        if support.is_empty() || sum <= 0.0 {
            return None;
        }

        x.iter_mut().for_each(|v| *v /= sum);
        for _ in 0..NEWTON_STEPS {
            let block = principal_block(&self.matrix(t, mu), support);
            let derivative = self.derivative(unknown, t, mu);
            let of_unknown = times(&principal_block(&derivative, support), &x);
            let step = newton_step(&block, &of_unknown, &x)?;
            let [dx @ .., change] = step.as_slice() else {
                return None;
            };

            for (value, change) in x.iter_mut().zip(dx) {
                *value += change;
            }
            match unknown {
                Unknown::Lambda2 => t += change,
                Unknown::Friction => mu += change,
            }

            if !(t >= 0.0 && mu > 0.0 && t.is_finite() && mu.is_finite()) {
                return None;
            }

            let size = dx.iter().fold(0.0f64, |s, v| s.max(v.abs()));
            let largest = x.iter().fold(0.0f64, |s, v| s.max(v.abs()));
            let unit = match unknown {
                Unknown::Lambda2 => t + self.scale(),
                Unknown::Friction => mu,
            };
            let is_small = size <= NEWTON_CONVERGED.sqrt() * largest
                && change.abs() <= NEWTON_CONVERGED.sqrt() * unit;
            if is_small {
                return self.point([t, mu], &x, support);
            }
        }

        None
    }

    /// The derivative of T by an unknown.
    fn derivative(&self, unknown: Unknown, t: f64, mu: f64) -> Matrix {
        let [constant, slope] = self.expansions(t);
        match unknown {
            Unknown::Lambda2 => combined(constant.derivative(t), mu, &slope.derivative(t)),
            Unknown::Friction => slope.at(t),
        }
    }

    /// The solution with its slope and signs.
    fn point(&self, [t, mu]: [f64; 2], on_support: &[f64], support: &[usize]) -> Option<Point> {
        let matrix = self.matrix(t, mu);
        let mut x = vec![0.0; matrix.len()];
        for (&i, value) in support.iter().zip(on_support) {
            x[i] = *value;
        }

        let left = left_null_vector(&principal_block(&matrix, support))?;
        let along = |unknown| {
            let derivative = self.derivative(unknown, t, mu);
            bilinear(&left, &principal_block(&derivative, support), on_support)
        };
        let slope = -along(Unknown::Friction) / along(Unknown::Lambda2);

        Some(Point {
            t,
            mu,
            violated: violated(&matrix, &x, support),
            x,
            support: support.to_vec(),
            left,
            slope,
        })
    }
}

/// A guess at the solution of the support that a position enters or leaves.
pub(super) fn beyond(point: &Point, position: usize) -> Point {
    Point {
        support: toggled(&point.support, position),
        x: point.x.iter().map(|v| v.max(0.0)).collect(),
        ..point.clone()
    }
}

/// a + factor b.
fn combined(mut a: Matrix, factor: f64, b: &Matrix) -> Matrix {
    for (entry, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
        *entry += factor * b;
    }

    a
}
