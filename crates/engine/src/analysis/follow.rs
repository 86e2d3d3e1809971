//! Follows a solution in (lambda^2, mu) to a local minimum of mu, in doubles.
//!
//! With t = lambda^2 the solutions of one support J form branches mu(t): T_JJ(t, mu) x = 0 with
//! T(t, mu) = A(t) + mu B(t), condensed to the slip particles and, in the split form, to those with
//! zero reaction. For a left null vector u of T_JJ,
//!
//! ```text
//!     d mu / dt = - u' T_t x / u' B x.
//! ```
//!
//! A branch is followed downhill until this slope is zero (a fold), until t = 0, or until some x_i
//! or y_i reaches 0 (a kink), where the branch goes on in the neighbouring support or ends in a
//! minimum.
//!
//! Input: the system condensed in doubles, and solutions from which to start. Output: [`Point`], a
//! proposal that `critical` certifies. Called by `critical`.

use super::error::AnalysisError;
use crate::reduction::{SparseCondensation, SparseCondensed};
use crate::search::complete::dyadic::short_near;
use crate::search::complete::pieces::matrix::{bilinear, principal_block, times};
use crate::search::complete::pieces::skyline::dot;
use crate::tolerance::{
    BRANCH_STEP, FOLD_WIDTH, KINK_SIDE, NEWTON_CONVERGED, SHORT_VALUE, SIGN_NOISE,
};
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_mcp::linear::{Symmetric, solve};
use mceip_model::System;
use mceip_model::reduction::zero_variables;

/// Newton steps at one value of t.
const NEWTON_STEPS: usize = 30;

/// Steps along one support, and supports along one branch.
const MAX_STEPS: usize = 200;
const MAX_SUPPORTS: usize = 20;

/// Steps that narrow the bracket of a fold.
const FOLD_STEPS: usize = 60;

/// A solution in doubles: x over the complementarity variables, of sum one.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// lambda^2.
    pub(super) t: f64,
    pub(super) mu: f64,
    pub(super) x: Vec<f64>,
    /// Positions with x_i > 0, ascending.
    support: Vec<usize>,
    /// d mu / dt along the support.
    slope: f64,
    /// A position where x_i or y_i has the wrong sign.
    violated: Option<usize>,
    /// The side on which the solution goes on, at a minimum beside a kink: 1 upwards in t, -1
    /// downwards; 0 elsewhere.
    side: f64,
}

/// The system condensed in doubles.
pub(super) struct Branches {
    condensation: SparseCondensation,
    /// Positions of right and left of each particle with zero reaction.
    halves: Vec<[usize; 2]>,
    /// A lambda^2 of the size of the lowest frequencies: the unit of the first step.
    scale: f64,
}

impl Branches {
    /// # Errors
    /// [`AnalysisError::NotCondensed`].
    pub(super) fn new(system: &System, scale: f64) -> Result<Branches, AnalysisError> {
        let stiffness = symmetric(system.stiffness())?;
        let mass = match system.mass() {
            Some(mass) => Some(symmetric(mass)?),
            None => None,
        };

        let condensation = SparseCondensation::with_zero(stiffness, mass, system.particles(), None)
            .map_err(|source| AnalysisError::NotCondensed(source.to_string()))?;

        let free = system.free_dofs().len();
        let zero = zero_variables(system).into_iter();
        Ok(Branches {
            condensation,
            halves: zero.map(|z| [z.right - free, z.left - free]).collect(),
            scale,
        })
    }

    /// The local minimum of mu below a guess at a solution: x over the complementarity variables,
    /// its support where it is positive. `None` where there is no solution near the guess.
    pub(super) fn minimum_below(&self, t: f64, mu: f64, x: &[f64]) -> Option<Point> {
        let mut point = self.near(t, mu, x)?;
        for _ in 0..MAX_SUPPORTS {
            let end = self.downhill(point);
            match self.beyond_the_kink(&end) {
                Some(next) => point = next,
                None => return Some(end.minimum()),
            }
        }

        Some(point)
    }

    /// The same solution at a short value of lambda^2 near its own, and that value; `None` where
    /// there is none.
    pub(super) fn at_short_value(&self, point: &Point) -> Option<(Rational, Point)> {
        let slack = SHORT_VALUE * (point.t + self.scale).min(point.t);
        let target = point.t + 2.0 * point.side * slack;
        let short = short_near(target, slack)?;
        let moved = self.at(to_f64(&short), point.mu, &point.x, &point.support)?;
        moved.violated.is_none().then_some((short, moved))
    }

    /// A solution near a guess. Components that turn out negative leave the support, and y_i < 0
    /// enters it.
    fn near(&self, t: f64, mu: f64, x: &[f64]) -> Option<Point> {
        let mut guess = x.to_vec();
        self.take_off_common_halves(&mut guess);
        let mut support: Vec<usize> = (0..x.len()).filter(|&i| guess[i] > 0.0).collect();
        let mut mu = mu;
        for _ in 0..=x.len() {
            let point = self.at(t, mu, &guess, &support)?;
            let Some(violated) = point.violated else {
                return Some(point);
            };

            support = toggled(&support, violated);
            mu = point.mu;
            guess = point.x.iter().map(|v| v.max(0.0)).collect();
        }

        None
    }

    /// v_T of a particle with zero reaction is the difference of its halves, of which one is 0 in a
    /// motion.
    fn take_off_common_halves(&self, x: &mut [f64]) {
        for &[right, left] in &self.halves {
            let common = x[right].min(x[left]);
            x[right] -= common;
            x[left] -= common;
        }
    }

    /// The solution of a support at a value of t, by Newton's method from a guess.
    fn at(&self, t: f64, mu: f64, x: &[f64], support: &[usize]) -> Option<Point> {
        if support.is_empty() {
            return None;
        }

        let condensed = self.condensation.at(t).ok()?;
        let mut x: Vec<f64> = support.iter().map(|&i| x[i]).collect();
        let mut mu = mu;
        let sum: f64 = x.iter().sum();
        if sum <= 0.0 {
            x = vec![1.0; support.len()];
        }

        let sum: f64 = x.iter().sum();
        x.iter_mut().for_each(|v| *v /= sum);

        let b = principal_block(&condensed.b, support);
        let mut has_converged = false;
        for _ in 0..NEWTON_STEPS {
            let block = principal_block(&condensed.pencil(mu), support);
            let step = newton_step(&block, &times(&b, &x), &x)?;
            let size = step.iter().fold(0.0f64, |s, v| s.max(v.abs()));
            let [dx @ .., d_mu] = step.as_slice() else {
                return None;
            };

            for (value, change) in x.iter_mut().zip(dx) {
                *value += change;
            }
            mu += d_mu;

            let largest = x.iter().fold(0.0f64, |s, v| s.max(v.abs()));
            if size <= NEWTON_CONVERGED * (largest + mu.abs()) {
                has_converged = true;
                break;
            }
        }

        if !has_converged || mu <= 0.0 {
            return None;
        }

        self.point(&condensed, mu, &x, support)
    }

    /// The solution with its slope and signs.
    fn point(
        &self,
        condensed: &SparseCondensed<'_>,
        mu: f64,
        on_support: &[f64],
        support: &[usize],
    ) -> Option<Point> {
        let mut x = vec![0.0; condensed.a.len()];
        for (&i, value) in support.iter().zip(on_support) {
            x[i] = *value;
        }

        let matrix = condensed.pencil(mu);
        let left = left_null_vector(&principal_block(&matrix, support))?;
        let derivative = match condensed.slope(mu, &x) {
            Some(derivative) => derivative,
            None => vec![0.0; x.len()],
        };

        let of_t: f64 = support
            .iter()
            .zip(&left)
            .map(|(&i, u)| u * derivative[i])
            .sum();
        let b = principal_block(&condensed.b, support);
        let of_mu = bilinear(&left, &b, on_support);

        Some(Point {
            t: condensed.t,
            mu,
            violated: violated(&matrix, &x, support),
            x,
            support: support.to_vec(),
            slope: -of_t / of_mu,
            side: 0.0,
        })
    }

    /// Follows a support downhill as far as it goes.
    fn downhill(&self, start: Point) -> End {
        let direction = if start.slope > 0.0 { -1.0 } else { 1.0 };
        let mut here = start;
        let mut step = BRANCH_STEP * (here.t + self.scale);
        let least = FOLD_WIDTH * FOLD_WIDTH * (here.t + self.scale);
        let mut kink = None;

        for _ in 0..MAX_STEPS {
            let is_at_the_end = here.t == 0.0 && direction < 0.0;
            if is_at_the_end || here.slope == 0.0 || step < least {
                break;
            }

            let t = (here.t + direction * step).max(0.0);
            let predicted = here.mu + here.slope * (t - here.t);
            let Some(next) = self.at(t, predicted, &here.x, &here.support) else {
                step *= 0.25;
                continue;
            };

            if next.violated.is_some() {
                kink = next.violated;
                step *= 0.5;
                continue;
            }

            if next.slope * direction > 0.0 {
                return End::fold(self.fold(here, next));
            }

            if next.mu >= here.mu {
                step *= 0.25; // another branch
                continue;
            }

            here = next;
            kink = None;
            step *= 2.0;
        }

        End {
            last: here,
            kink,
            direction,
        }
    }

    /// The place between two points of a support where the slope is zero.
    fn fold(&self, mut below: Point, mut above: Point) -> Point {
        for k in 0..FOLD_STEPS {
            let width = above.t - below.t;
            if width.abs() <= FOLD_WIDTH * (below.t.abs() + self.scale * FOLD_WIDTH) {
                break;
            }

            // The secant, and every third time the middle.
            let secant = below.slope / (below.slope - above.slope);
            let place = if k % 3 == 2 { 0.5 } else { secant };
            let t = below.t + place * width;
            let guess = 0.5 * (below.mu + above.mu);
            let Some(middle) = self.at(t, guess, &below.x, &below.support) else {
                break;
            };

            if middle.violated.is_some() || middle.slope == 0.0 {
                break;
            }

            if middle.slope * below.slope > 0.0 {
                below = middle;
            } else {
                above = middle;
            }
        }

        if above.mu < below.mu { above } else { below }
    }

    /// The first point of the neighbouring support beyond a kink, if mu falls there.
    fn beyond_the_kink(&self, end: &End) -> Option<Point> {
        let position = end.kink?;
        let last = &end.last;
        let support = toggled(&last.support, position);
        let aside = KINK_SIDE * (last.t + self.scale);
        for side in [end.direction, -end.direction] {
            let t = last.t + side * aside;
            if t < 0.0 {
                continue;
            }

            let next = self.at(t, last.mu, &last.x, &support);
            let falls = next.filter(|next| next.violated.is_none() && next.mu < last.mu);
            if falls.is_some() {
                return falls;
            }
        }

        None
    }
}

/// Where a support has been followed to.
struct End {
    last: Point,
    /// The position that changes its sign beyond the last point.
    kink: Option<usize>,
    /// 1 upwards in t, -1 downwards.
    direction: f64,
}

impl End {
    fn minimum(self) -> Point {
        let side = if self.kink.is_some() {
            -self.direction
        } else {
            0.0
        };

        Point { side, ..self.last }
    }

    fn fold(last: Point) -> End {
        End {
            last,
            kink: None,
            direction: 1.0,
        }
    }
}

/// The Newton step for T x = 0, e'x = 1 in the unknowns (x, mu), with the derivative B x.
pub(super) fn newton_step(matrix: &[Vec<f64>], b_x: &[f64], x: &[f64]) -> Option<Vec<f64>> {
    let mut rows = Vec::with_capacity(x.len() + 1);
    let mut negative_residual = Vec::with_capacity(x.len() + 1);
    for (row, b_x) in matrix.iter().zip(b_x) {
        let scale = row.iter().fold(b_x.abs(), |s, v| s.max(v.abs()));
        let scale = if scale > 0.0 { 1.0 / scale } else { 1.0 };
        let mut scaled: Vec<f64> = row.iter().map(|v| v * scale).collect();
        scaled.push(b_x * scale);
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
pub(super) fn left_null_vector(matrix: &[Vec<f64>]) -> Option<Vec<f64>> {
    let order = matrix.len();
    if order == 1 {
        return Some(vec![1.0]); // the only entry is rounding, and says nothing of scale
    }

    let largest = matrix
        .iter()
        .flatten()
        .fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
    let mut transposed = crate::dense::transposed(matrix);
    for (i, row) in transposed.iter_mut().enumerate() {
        row[i] += NEWTON_CONVERGED * largest;
    }

    let mut vector = vec![1.0; order];
    for _ in 0..3 {
        vector = solve(&transposed, &[vector])?.pop()?;
        let size = vector.iter().fold(0.0f64, |s, v| s.max(v.abs()));
        vector.iter_mut().for_each(|v| *v /= size);
    }

    Some(vector)
}

/// The position where x_i >= 0 on the support or y_i >= 0 off it is missed most.
pub(super) fn violated(matrix: &[Vec<f64>], x: &[f64], support: &[usize]) -> Option<usize> {
    let mut worst = -SIGN_NOISE;
    let mut position = None;
    for (i, row) in matrix.iter().enumerate() {
        let value = if support.contains(&i) {
            x[i]
        } else {
            let size = row.iter().fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
            dot(row, x) / size
        };

        if value < worst {
            worst = value;
            position = Some(i);
        }
    }

    position
}

/// A support with one position put in or taken out.
pub(super) fn toggled(support: &[usize], position: usize) -> Vec<usize> {
    let mut other: Vec<usize> = support.iter().copied().filter(|&i| i != position).collect();
    if other.len() == support.len() {
        other.push(position);
        other.sort_unstable();
    }

    other
}

fn symmetric(matrix: &Sparse) -> Result<Symmetric, AnalysisError> {
    let entries = matrix.entries().map(|(i, j, v)| (i, j, to_f64(v)));
    Symmetric::new(matrix.rows(), entries)
        .map_err(|source| AnalysisError::NotCondensed(source.to_string()))
}
