//! The equations of a curve on the current places, and one more row that fixes a point or a
//! direction.
//!
//! Let I be the unknowns *inside*, strictly between their bounds; the others stay at their bounds.
//! On a piece of the curve F_I(z) = s r_I: |I| equations for the |I| + 1 unknowns z_I and s. A
//! *border* row makes the matrix [F'_II, -r_I; border] square: the tangent solves it for the
//! last unit vector, Newton's step back to the curve for the residuals. The multipliers of the
//! unknowns at bounds follow as m = F - s r.
//!
//! Vectors of length |I| + 1 hold z_I first, in ascending order of the indices, and s last. Called
//! by `follow`.

use super::super::active_bound::ActiveBound;
use super::super::evaluation::{Evaluated, Point};
use super::super::jacobian::jacobian_at;
use super::super::tolerance::{CURVE_KEPT, CURVE_RESIDUAL, CURVE_STEPS};
use crate::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// Which bound, if any, each unknown is at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Places(pub(super) Vec<ActiveBound>);

impl Places {
    /// At a bound if z is exactly there.
    pub(super) fn at_bounds<P: Mcp + ?Sized>(problem: &P, z: &DVector<f64>) -> Places {
        Places::of(problem, z, |_| 0.0)
    }

    /// At a bound if z is nearer to it than F to zero: right where complementarity is strict.
    pub(super) fn at_solution<P: Mcp + ?Sized>(problem: &P, point: &Point) -> Places {
        Places::of(problem, &point.z, |i| point.f[i])
    }

    /// At the lower bound if z is as near to it as `f`, at the upper one if as near as -f.
    fn of<P: Mcp + ?Sized>(problem: &P, z: &DVector<f64>, f: impl Fn(usize) -> f64) -> Places {
        let mut places = Vec::with_capacity(z.len());
        for (i, &z) in z.iter().enumerate() {
            let lower = problem.lower()[i];
            let upper = problem.upper()[i];
            places.push(if lower == upper {
                ActiveBound::Fixed
            } else if z - lower <= f(i) {
                ActiveBound::Lower
            } else if upper - z <= -f(i) {
                ActiveBound::Upper
            } else {
                ActiveBound::None
            });
        }

        Places(places)
    }

    /// The unknowns inside, ascending.
    pub(super) fn inside(&self) -> Vec<usize> {
        (0..self.0.len())
            .filter(|&i| self.0[i] == ActiveBound::None)
            .collect()
    }

    /// A multiplier strictly on the right side of zero.
    pub(super) fn lifted_multiplier(&self, i: usize, f: f64, lift: f64) -> f64 {
        match self.0[i] {
            ActiveBound::None => 0.0,
            ActiveBound::Lower => f.max(0.0) + lift,
            ActiveBound::Upper => f.min(0.0) - lift,
            ActiveBound::Fixed => f,
        }
    }
}

/// A point of the curve.
#[derive(Debug, Clone)]
pub(super) struct CurvePoint {
    pub(super) z: DVector<f64>,
    pub(super) s: f64,
}

/// F and F' at a position. Outside the bounds both are continued linearly, so that the problem is
/// never asked for a value there.
pub(super) struct Local {
    pub(super) f: DVector<f64>,
    pub(super) jacobian: DMatrix<f64>,
}

/// A quantity that stops or fixes the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    /// z_i, for an unknown inside, less its lower or upper bound as given.
    Z(usize, f64),
    /// The multiplier of an unknown at a bound.
    Multiplier(usize),
    /// s.
    S,
}

/// The row that makes the equations square.
pub(super) enum Border<'a> {
    /// The plane through the predicted position, across the tangent.
    Plane(&'a DVector<f64>),
    /// A quantity is zero.
    Zero(Quantity),
}

/// A position on the curve, with F and F' there.
pub(super) struct Corrected {
    pub(super) at: CurvePoint,
    pub(super) local: Local,
    /// Newton steps taken.
    pub(super) steps: usize,
    /// A unit tangent up to its sign and to the difference between the last factors and F' here;
    /// `None` if no step was needed.
    pub(super) tangent: Option<DVector<f64>>,
}

/// The factors of a bordered matrix.
type BorderedFactors = nalgebra::LU<f64, nalgebra::Dyn, nalgebra::Dyn>;

/// The unit vector along which the border, row k, grows with the sign given and the other rows
/// stay.
fn unit(factors: &BorderedFactors, k: usize, sign: f64) -> Option<DVector<f64>> {
    let mut right = DVector::zeros(k + 1);
    right[k] = sign;
    let v = factors.solve(&right)?;

    let norm = v.norm();
    (norm > 0.0 && norm.is_finite()).then(|| v / norm)
}

/// The equations.
pub(super) struct HomotopySystem<'p, 'a, P: Mcp + ?Sized> {
    pub(super) problem: &'p mut Evaluated<'a, P>,
    /// The residual at s = 1, over all unknowns.
    pub(super) r: DVector<f64>,
    pub(super) places: Places,
}

impl<P: Mcp + ?Sized> HomotopySystem<'_, '_, P> {
    /// F and F' at z, or `None` if an entry is not finite.
    pub(super) fn local(&mut self, z: &DVector<f64>) -> Option<Local> {
        let point = self.problem.point(z);
        self.problem.counters.jacobians += 1;
        let jacobian = jacobian_at(self.problem.problem, point.z.as_slice());

        // The point is the projection of z onto the bounds.
        let f = &point.f + &jacobian * (z - &point.z);
        let mut entries = f.iter().chain(jacobian.iter());
        let is_finite = entries.all(|value| value.is_finite());

        is_finite.then_some(Local { f, jacobian })
    }

    /// The value of a quantity.
    pub(super) fn value(&self, quantity: Quantity, at: &CurvePoint, local: &Local) -> f64 {
        match quantity {
            Quantity::Z(i, bound) => at.z[i] - bound,
            Quantity::Multiplier(i) => local.f[i] - at.s * self.r[i],
            Quantity::S => at.s,
        }
    }

    /// Derivative of a quantity by (z_I, s).
    pub(super) fn row(&self, quantity: Quantity, local: &Local, inside: &[usize]) -> DVector<f64> {
        let k = inside.len();
        let mut row = DVector::zeros(k + 1);
        match quantity {
            Quantity::Z(i, _) => {
                for c in 0..k {
                    if inside[c] == i {
                        row[c] = 1.0;
                    }
                }
            }
            Quantity::Multiplier(i) => {
                for c in 0..k {
                    row[c] = local.jacobian[(i, inside[c])];
                }
                row[k] = -self.r[i];
            }
            Quantity::S => row[k] = 1.0,
        }
        row
    }

    /// The matrix [F'_II, -r_I; border].
    fn bordered(&self, local: &Local, inside: &[usize], border: &DVector<f64>) -> DMatrix<f64> {
        let k = inside.len();
        DMatrix::from_fn(k + 1, k + 1, |row, col| {
            if row == k {
                border[col]
            } else if col == k {
                -self.r[inside[row]]
            } else {
                local.jacobian[(inside[row], inside[col])]
            }
        })
    }

    /// The unit tangent along which the row `border` grows with the sign given.
    pub(super) fn tangent(
        &mut self,
        local: &Local,
        border: &DVector<f64>,
        sign: f64,
    ) -> Option<DVector<f64>> {
        let inside = self.places.inside();
        let factors = self.factor(local, &inside, border);
        unit(&factors, inside.len(), sign)
    }

    /// Factors the bordered matrix, and counts it.
    fn factor(
        &mut self,
        local: &Local,
        inside: &[usize],
        border: &DVector<f64>,
    ) -> BorderedFactors {
        self.problem.counters.factorisations += 1;
        self.bordered(local, inside, border).lu()
    }

    /// Newton from a predicted position to the curve. The factors of a step serve the next ones
    /// while they gain enough (Shamanskii 1967), and at last the tangent.
    pub(super) fn correct(
        &mut self,
        predicted: &CurvePoint,
        border: &Border<'_>,
    ) -> Option<Corrected> {
        let inside = self.places.inside();
        let mut at = predicted.clone();
        let mut last_size = f64::INFINITY;
        let mut factors: Option<BorderedFactors> = None;

        for steps in 0..=CURVE_STEPS {
            let local = self.local(&at.z)?;
            let right = self.negative_residual(&at, &local, &inside, border);
            let size = right.amax();

            if size <= CURVE_RESIDUAL * (1.0 + at.s.abs() * self.r.amax()) {
                let tangent = factors.and_then(|factors| unit(&factors, inside.len(), 1.0));
                return Some(Corrected {
                    at,
                    local,
                    steps,
                    tangent,
                });
            }

            if size > 2.0 * last_size || steps == CURVE_STEPS {
                return None;
            }

            if size > CURVE_KEPT * last_size {
                factors = None;
            }

            last_size = size;

            let lu = match factors.take() {
                Some(lu) => lu,
                None => {
                    let row = self.border_row(border, &local, &inside);
                    self.factor(&local, &inside, &row)
                }
            };

            let step = lu.solve(&right)?;
            if !step.iter().all(|v| v.is_finite()) {
                return None;
            }

            factors = Some(lu);
            self.shift(&mut at, &inside, &step, 1.0);
        }
        None
    }

    /// The border as a row by (z_I, s).
    fn border_row(&self, border: &Border<'_>, local: &Local, inside: &[usize]) -> DVector<f64> {
        match border {
            Border::Plane(normal) => (*normal).clone(),
            Border::Zero(quantity) => self.row(*quantity, local, inside),
        }
    }

    /// s r_I - F_I, and minus what the border should make zero. A plane is met from the first step
    /// on: every step stays in it.
    fn negative_residual(
        &self,
        at: &CurvePoint,
        local: &Local,
        inside: &[usize],
        border: &Border<'_>,
    ) -> DVector<f64> {
        let k = inside.len();
        let mut right = DVector::zeros(k + 1);

        for (c, &i) in inside.iter().enumerate() {
            right[c] = at.s * self.r[i] - local.f[i];
        }

        let rest = match border {
            Border::Plane(_) => 0.0,
            Border::Zero(quantity) => self.value(*quantity, at, local),
        };
        right[k] = -rest;

        right
    }

    /// Moves a position by `length` times a direction in (z_I, s).
    pub(super) fn shift(
        &self,
        at: &mut CurvePoint,
        inside: &[usize],
        direction: &DVector<f64>,
        length: f64,
    ) {
        for (c, &i) in inside.iter().enumerate() {
            at.z[i] += length * direction[c];
        }

        at.s += length * direction[inside.len()];
    }
}

#[cfg(test)]
mod tests;
