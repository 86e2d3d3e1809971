//! The solutions of one support as a branch in (t, mu), in doubles, t = lambda^2.
//!
//! On the support S a solution has
//!
//! ```text
//!     T_SS(t, mu) x = 0,    e'x = 1,    T(t, mu) = T0(t) + mu T1(t).
//! ```
//!
//! Newton's method solves this for (x, mu) at a given t, or for (x, t) at a given mu; its Jacobian
//! is [[T_SS, d], [e', 0]] with d = T1 x or T_t x. With a left null vector u of T_SS the slope of
//! the branch is
//!
//! ```text
//!     d mu / dt = - u' T_t x / u' T1 x.
//! ```
//!
//! T comes from who implements [`BranchPencils`]: `analysis::follow` and
//! `analysis::presence::curve`, which follow branches, and `multistart::all_slip`, where T does not
//! depend on t. Nothing is proved here.

use crate::dense::transposed;
use crate::search::complete::pieces::expansion::{ChordEnds, Expansion};
use crate::search::complete::pieces::matrix::{SquareMatrix, principal_block, times};
use crate::search::complete::pieces::skyline::dot;
use crate::tolerance::{NEWTON_CONVERGED, SIGN_NOISE};
use mceip_mcp::linear::solve;

/// Newton steps to one solution, at most.
const NEWTON_STEPS: usize = 30;

/// What Newton's method solves for beside x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BranchUnknown {
    Lambda2,
    Friction,
}

/// T0 and T1 at one value of t.
pub(crate) trait Slice {
    /// T0 + mu T1.
    fn matrix(&self, mu: f64) -> SquareMatrix;

    /// T1.
    fn of_mu(&self) -> &[Vec<f64>];

    /// (T0' + mu T1') x, with x over all positions.
    fn of_t(&self, mu: f64, x: &[f64]) -> Vec<f64>;
}

/// A solution: x over all positions, of sum one.
#[derive(Debug, Clone)]
pub(crate) struct BranchPoint {
    pub(crate) t: f64,
    pub(crate) mu: f64,
    pub(crate) x: Vec<f64>,
    /// Positions with x_i > 0, ascending.
    pub(crate) support: Vec<usize>,
    /// u, the left null vector on the support.
    pub(crate) left: Vec<f64>,
    /// u' T_t x.
    pub(crate) of_t: f64,
    /// u' T1 x.
    pub(crate) of_mu: f64,
    /// A position where x_i or y_i has the wrong sign.
    pub(crate) violated: Option<usize>,
}

impl BranchPoint {
    /// d mu / dt along the support.
    pub(crate) fn slope_of_mu(&self) -> f64 {
        -self.of_t / self.of_mu
    }

    /// dt / d mu along the support.
    pub(crate) fn slope_of_t(&self) -> f64 {
        -self.of_mu / self.of_t
    }

    /// The largest |u' (T - T') x| over what is known of the matrices T' of members.
    pub(crate) fn spread_of_null_vector(&self, expansions: &[Expansion; 2]) -> f64 {
        let ends = expansions.each_ref().map(|part| part.ends(self.t, self.t));
        let here = ChordEnds::at_friction(ends.each_ref(), self.mu);
        let Some(radius) = here.radius(0) else {
            return 0.0;
        };

        let mut sum = 0.0;
        for (&i, u) in self.support.iter().zip(&self.left) {
            for &j in &self.support {
                sum += u.abs() * radius[i][j] * self.x[j];
            }
        }
        sum
    }

    /// The support with one position put in or taken out.
    pub(crate) fn toggled(&self, position: usize) -> Vec<usize> {
        let others = self.support.iter().copied().filter(|&i| i != position);
        let mut toggled: Vec<usize> = others.collect();
        if toggled.len() == self.support.len() {
            toggled.push(position);
            toggled.sort_unstable();
        }

        toggled
    }
}

/// T as a function of t and mu, in doubles.
pub(crate) trait BranchPencils {
    type Slice<'a>: Slice
    where
        Self: 'a;

    /// T0 and T1 at a value of t; `None` where doubles fail.
    fn at(&self, t: f64) -> Option<Self::Slice<'_>>;

    /// A value of t on whose scale T changes.
    fn unit(&self) -> f64;

    /// The solution of a support, from a guess at its place (t, mu) and at x over all positions.
    /// `None` where Newton's method does not converge, or not to t >= 0 and mu > 0.
    fn solved(
        &self,
        unknown: BranchUnknown,
        [mut t, mut mu]: [f64; 2],
        guess: &[f64],
        support: &[usize],
    ) -> Option<BranchPoint> {
        if support.is_empty() {
            return None;
        }

        let mut slice = self.at(t)?;
        let mut x = of_sum_one(guess, support);
        for _ in 0..NEWTON_STEPS {
            let block = principal_block(&slice.matrix(mu), support);
            let derivative = match unknown {
                BranchUnknown::Lambda2 => slice.of_t(mu, &x),
                BranchUnknown::Friction => times(slice.of_mu(), &x),
            };

            let step = newton_step(&block, &at(&derivative, support), &at(&x, support))?;
            let [dx @ .., change] = step.as_slice() else {
                return None;
            };
            for (&i, change) in support.iter().zip(dx) {
                x[i] += change;
            }

            let unit = match unknown {
                BranchUnknown::Lambda2 => {
                    t += change;
                    slice = self.at(t).filter(|_| t >= 0.0)?;
                    t + self.unit()
                }
                BranchUnknown::Friction => {
                    mu += change;
                    mu.abs()
                }
            };

            // The method is quadratic: the next step would be the square of this one.
            let least = NEWTON_CONVERGED.sqrt();
            let is_small = largest(dx) <= least * largest(&x) && change.abs() <= least * unit;
            if is_small && mu > 0.0 {
                return point(&slice, [t, mu], x, support);
            }
            if is_small {
                return None;
            }
        }

        None
    }

    /// A solution near a guess. Components that turn out negative leave the support, and positions
    /// with y_i < 0 enter it.
    fn near(&self, unknown: BranchUnknown, [t, mu]: [f64; 2], x: &[f64]) -> Option<BranchPoint> {
        let support: Vec<usize> = (0..x.len()).filter(|&i| x[i] > 0.0).collect();
        let mut point = self.solved(unknown, [t, mu], x, &support)?;
        for _ in 0..x.len() {
            let Some(position) = point.violated else {
                return Some(point);
            };
            point = self.beyond(unknown, [point.t, point.mu], &point, position)?;
        }

        point.violated.is_none().then_some(point)
    }

    /// The solution of the support that a position enters or leaves, from a guess at its place.
    fn beyond(
        &self,
        unknown: BranchUnknown,
        place: [f64; 2],
        point: &BranchPoint,
        position: usize,
    ) -> Option<BranchPoint> {
        let guess: Vec<f64> = point.x.iter().map(|v| v.max(0.0)).collect();
        self.solved(unknown, place, &guess, &point.toggled(position))
    }
}

/// The guess on the support, zero elsewhere, of sum one; the even vector where it has no sum.
fn of_sum_one(guess: &[f64], support: &[usize]) -> Vec<f64> {
    let sum: f64 = support.iter().map(|&i| guess[i]).sum();

    let mut x = vec![0.0; guess.len()];
    for &i in support {
        x[i] = if sum > 0.0 {
            guess[i] / sum
        } else {
            1.0 / support.len() as f64
        };
    }

    x
}

fn at(vector: &[f64], positions: &[usize]) -> Vec<f64> {
    positions.iter().map(|&i| vector[i]).collect()
}

fn largest(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |s, v| f64::max(s, v.abs()))
}

/// The solution with what belongs to it.
fn point(
    slice: &impl Slice,
    [t, mu]: [f64; 2],
    x: Vec<f64>,
    support: &[usize],
) -> Option<BranchPoint> {
    let matrix = slice.matrix(mu);
    let left = left_null_vector(&principal_block(&matrix, support))?;
    let of_t = dot(&left, &at(&slice.of_t(mu, &x), support));
    let of_mu = dot(&left, &at(&times(slice.of_mu(), &x), support));

    Some(BranchPoint {
        t,
        mu,
        violated: violated(&matrix, &x, support),
        x,
        support: support.to_vec(),
        left,
        of_t,
        of_mu,
    })
}

/// The step of (x, unknown) for T x = 0, e'x = 1, given the derivative of T x by the unknown.
fn newton_step(matrix: &SquareMatrix, derivative: &[f64], x: &[f64]) -> Option<Vec<f64>> {
    let mut rows = Vec::with_capacity(x.len() + 1);
    let mut negative_residual = Vec::with_capacity(x.len() + 1);
    for (row, slope) in matrix.iter().zip(derivative) {
        let largest = largest(row).max(slope.abs());
        let scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        let mut scaled: Vec<f64> = row.iter().map(|v| v * scale).collect();
        scaled.push(slope * scale);
        negative_residual.push(-scale * dot(row, x));
        rows.push(scaled);
    }

    let mut last = vec![1.0; x.len()];
    last.push(0.0);
    rows.push(last);
    negative_residual.push(1.0 - x.iter().sum::<f64>());

    solve(&rows, &[negative_residual])?.pop()
}

/// A left null vector of a matrix that is singular up to rounding, by inverse iteration.
fn left_null_vector(matrix: &SquareMatrix) -> Option<Vec<f64>> {
    let order = matrix.len();
    if order == 1 {
        return Some(vec![1.0]); // the only entry is rounding, and says nothing of scale
    }

    let entries = matrix.iter().flatten();
    let largest_entry = entries.fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
    let mut transposed = transposed(matrix);
    for (i, row) in transposed.iter_mut().enumerate() {
        row[i] += NEWTON_CONVERGED * largest_entry;
    }

    let mut vector = vec![1.0; order];
    for _ in 0..3 {
        vector = solve(&transposed, &[vector])?.pop()?;
        let size = largest(&vector);
        vector.iter_mut().for_each(|v| *v /= size);
    }

    Some(vector)
}

/// The position where x_i >= 0 on the support or y_i >= 0 off it is missed most.
fn violated(matrix: &SquareMatrix, x: &[f64], support: &[usize]) -> Option<usize> {
    let mut worst = -SIGN_NOISE;
    let mut position = None;
    for (i, row) in matrix.iter().enumerate() {
        let value = if support.contains(&i) {
            x[i]
        } else {
            dot(row, x) / largest(row).max(f64::MIN_POSITIVE)
        };

        if value < worst {
            worst = value;
            position = Some(i);
        }
    }

    position
}
