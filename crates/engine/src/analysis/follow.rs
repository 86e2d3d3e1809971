//! Follows a solution in (lambda^2, mu) to a local minimum of mu, in doubles.
//!
//! With t = lambda^2 the solutions of one support form a branch mu(t) (`branch`), here of the
//! system condensed to the slip particles and, in the split form, to those with zero reaction.
//!
//! A branch is followed downhill until this slope is zero (a fold), until t = 0, or until some x_i
//! or y_i reaches 0 (a kink), where the branch goes on in the neighbouring support or ends in a
//! minimum.
//!
//! Input: the system condensed in doubles, and solutions from which to start. Output: [`Minimum`],
//! a proposal that `critical` certifies. Called by `critical`.

use super::error::AnalysisError;
use crate::branch::{BranchPencils, BranchPoint, BranchUnknown, Slice};
use crate::reduction::{SparseCondensation, SparseCondensed};
use crate::search::complete::dyadic::short_near;
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::tolerance::{BRANCH_STEP, FOLD_WIDTH, KINK_SIDE, SHORT_VALUE};
use mceip_exact::{Rational, to_f64};
use mceip_model::System;
use mceip_model::reduction::zero_variables;

/// Steps along one support, and supports along one branch.
const MAX_STEPS: usize = 200;
const MAX_SUPPORTS: usize = 20;

/// Steps that narrow the bracket of a fold.
const FOLD_STEPS: usize = 60;

/// Where a branch has been followed to.
pub(super) struct Minimum {
    pub(super) point: BranchPoint,
    /// The side on which the solution goes on, beside a kink: 1 upwards in t, -1 downwards; 0
    /// elsewhere.
    side: f64,
}

/// The system condensed in doubles.
pub(super) struct BranchFollower {
    condensation: SparseCondensation,
    /// Positions of right and left of each particle with zero reaction.
    halves: Vec<[usize; 2]>,
    /// A lambda^2 of the size of the lowest frequencies: the unit of the first step.
    scale: f64,
}

impl BranchPencils for BranchFollower {
    type Slice<'a> = SparseCondensed<'a>;

    fn at(&self, t: f64) -> Option<SparseCondensed<'_>> {
        self.condensation.at(t).ok()
    }

    fn unit(&self) -> f64 {
        self.scale
    }
}

impl Slice for SparseCondensed<'_> {
    fn matrix(&self, mu: f64) -> SquareMatrix {
        self.pencil(mu)
    }

    fn of_mu(&self) -> &[Vec<f64>] {
        &self.b
    }

    fn of_t(&self, mu: f64, x: &[f64]) -> Vec<f64> {
        let without_mass = || vec![0.0; x.len()];
        self.slope(mu, x).unwrap_or_else(without_mass)
    }
}

impl BranchFollower {
    /// # Errors
    /// [`AnalysisError::NotCondensed`].
    pub(super) fn new(system: &System, scale: f64) -> Result<BranchFollower, AnalysisError> {
        let condensation = SparseCondensation::of_system(system)
            .map_err(|source| AnalysisError::NotCondensed(source.to_string()))?;

        let free = system.free_dofs().len();
        let zero = zero_variables(system).into_iter();
        Ok(BranchFollower {
            condensation,
            halves: zero.map(|z| [z.right - free, z.left - free]).collect(),
            scale,
        })
    }

    /// The local minimum of mu below a guess at a solution: x over the complementarity variables,
    /// its support where it is positive. `None` where there is no solution near the guess.
    pub(super) fn minimum_below(&self, t: f64, mu: f64, x: &[f64]) -> Option<Minimum> {
        let mut guess = x.to_vec();
        self.take_off_common_halves(&mut guess);
        let mut point = self.near(BranchUnknown::Friction, [t, mu], &guess)?;
        for _ in 0..MAX_SUPPORTS {
            let end = self.downhill(point);
            match self.beyond_the_kink(&end) {
                Some(next) => point = next,
                None => return Some(end.minimum()),
            }
        }

        Some(Minimum { point, side: 0.0 })
    }

    /// The same solution at a short value of lambda^2 near its own, and that value; `None` where
    /// there is none.
    pub(super) fn at_short_value(&self, minimum: &Minimum) -> Option<(Rational, BranchPoint)> {
        let point = &minimum.point;
        let slack = SHORT_VALUE * (point.t + self.scale).min(point.t);
        let target = point.t + 2.0 * minimum.side * slack;
        let short = short_near(target, slack)?;
        let moved = self.moved(point, to_f64(&short), point.mu)?;
        moved.violated.is_none().then_some((short, moved))
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

    /// The solution of a point's support at another value of t, from a guess at its mu.
    fn moved(&self, point: &BranchPoint, t: f64, mu: f64) -> Option<BranchPoint> {
        self.solved(BranchUnknown::Friction, [t, mu], &point.x, &point.support)
    }

    /// Follows a support downhill as far as it goes.
    fn downhill(&self, start: BranchPoint) -> BranchEnd {
        let direction = if start.slope_of_mu() > 0.0 { -1.0 } else { 1.0 };
        let mut here = start;
        let mut step = BRANCH_STEP * (here.t + self.scale);
        let least = FOLD_WIDTH * FOLD_WIDTH * (here.t + self.scale);
        let mut kink = None;

        for _ in 0..MAX_STEPS {
            let is_at_the_end = here.t == 0.0 && direction < 0.0;
            if is_at_the_end || here.slope_of_mu() == 0.0 || step < least {
                break;
            }

            let t = (here.t + direction * step).max(0.0);
            let predicted = here.mu + here.slope_of_mu() * (t - here.t);
            let Some(next) = self.moved(&here, t, predicted) else {
                step *= 0.25;
                continue;
            };

            if next.violated.is_some() {
                kink = next.violated;
                step *= 0.5;
                continue;
            }

            if next.slope_of_mu() * direction > 0.0 {
                return BranchEnd::fold(self.fold(here, next));
            }

            if next.mu >= here.mu {
                step *= 0.25; // another branch
                continue;
            }

            here = next;
            kink = None;
            step *= 2.0;
        }

        BranchEnd {
            last: here,
            kink,
            direction,
        }
    }

    /// The place between two points of a support where the slope is zero.
    fn fold(&self, mut below: BranchPoint, mut above: BranchPoint) -> BranchPoint {
        for k in 0..FOLD_STEPS {
            let width = above.t - below.t;
            if width.abs() <= FOLD_WIDTH * (below.t.abs() + self.scale * FOLD_WIDTH) {
                break;
            }

            // The secant, and every third time the middle.
            let secant = below.slope_of_mu() / (below.slope_of_mu() - above.slope_of_mu());
            let place = if k % 3 == 2 { 0.5 } else { secant };
            let t = below.t + place * width;
            let guess = 0.5 * (below.mu + above.mu);
            let Some(middle) = self.moved(&below, t, guess) else {
                break;
            };

            if middle.violated.is_some() || middle.slope_of_mu() == 0.0 {
                break;
            }

            if middle.slope_of_mu() * below.slope_of_mu() > 0.0 {
                below = middle;
            } else {
                above = middle;
            }
        }

        if above.mu < below.mu { above } else { below }
    }

    /// The first point of the neighbouring support beyond a kink, if mu falls there.
    fn beyond_the_kink(&self, end: &BranchEnd) -> Option<BranchPoint> {
        let position = end.kink?;
        let last = &end.last;
        let aside = KINK_SIDE * (last.t + self.scale);
        for side in [end.direction, -end.direction] {
            let t = last.t + side * aside;
            if t < 0.0 {
                continue;
            }

            let next = self.beyond(BranchUnknown::Friction, [t, last.mu], last, position);
            let falls = next.filter(|next| next.violated.is_none() && next.mu < last.mu);
            if falls.is_some() {
                return falls;
            }
        }

        None
    }
}

/// Where a support has been followed to.
struct BranchEnd {
    last: BranchPoint,
    /// The position that changes its sign beyond the last point.
    kink: Option<usize>,
    /// 1 upwards in t, -1 downwards.
    direction: f64,
}

impl BranchEnd {
    fn minimum(self) -> Minimum {
        let side = if self.kink.is_some() {
            -self.direction
        } else {
            0.0
        };

        Minimum {
            point: self.last,
            side,
        }
    }

    fn fold(last: BranchPoint) -> BranchEnd {
        BranchEnd {
            last,
            kink: None,
            direction: 1.0,
        }
    }
}
