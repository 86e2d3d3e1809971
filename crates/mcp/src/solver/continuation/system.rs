//! The equations of a curve on the current places: F_I(z) = s r_I for the unknowns inside, and one
//! more row that fixes a point or a direction.

use super::super::evaluation::{Evaluated, Point};
use super::super::jacobian::jacobian_at;
use super::super::tolerance::{CURVE_KEPT, CURVE_RESIDUAL, CURVE_STEPS};
use crate::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// Where an unknown stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Between its bounds; its multiplier is zero.
    Inside,
    /// At its lower bound, multiplier >= 0.
    Lower,
    /// At its upper bound, multiplier <= 0.
    Upper,
    /// At equal bounds, multiplier free.
    Fixed,
}

/// The place of every unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Places(pub(super) Vec<Place>);

impl Places {
    /// At a bound if z is exactly there.
    pub(super) fn at_bounds<P: Mcp + ?Sized>(problem: &P, z: &DVector<f64>) -> Places {
        let (l, u) = (problem.lower(), problem.upper());
        let place = |i: usize| match z[i] {
            _ if l[i] == u[i] => Place::Fixed,
            v if v <= l[i] => Place::Lower,
            v if v >= u[i] => Place::Upper,
            _ => Place::Inside,
        };
        Places((0..z.len()).map(place).collect())
    }

    /// At a bound if z is nearer to it than F to zero: right where complementarity is strict.
    pub(super) fn at_solution<P: Mcp + ?Sized>(problem: &P, point: &Point) -> Places {
        let (l, u) = (problem.lower(), problem.upper());
        let place = |i: usize| match (point.z[i], point.f[i]) {
            _ if l[i] == u[i] => Place::Fixed,
            (z, f) if z - l[i] <= f => Place::Lower,
            (z, f) if u[i] - z <= -f => Place::Upper,
            _ => Place::Inside,
        };
        Places((0..point.z.len()).map(place).collect())
    }

    pub(super) fn inside(&self) -> Vec<usize> {
        (0..self.0.len())
            .filter(|&i| self.0[i] == Place::Inside)
            .collect()
    }

    /// A multiplier strictly on the right side of zero.
    pub(super) fn lifted_multiplier(&self, i: usize, f: f64, lift: f64) -> f64 {
        match self.0[i] {
            Place::Inside => 0.0,
            Place::Lower => f.max(0.0) + lift,
            Place::Upper => f.min(0.0) - lift,
            Place::Fixed => f,
        }
    }
}

/// A point of the curve.
#[derive(Debug, Clone)]
pub(super) struct Position {
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
    pub(super) at: Position,
    pub(super) local: Local,
    /// Newton steps taken.
    pub(super) steps: usize,
    /// A unit tangent up to its sign and to the difference between the last factors and F' here;
    /// `None` if no step was needed.
    pub(super) tangent: Option<DVector<f64>>,
}

/// The factors of a bordered matrix.
type Factors = nalgebra::LU<f64, nalgebra::Dyn, nalgebra::Dyn>;

/// The unit vector along which the border, row k, grows with the sign given and the other rows
/// stay.
fn unit(factors: &Factors, k: usize, sign: f64) -> Option<DVector<f64>> {
    let v = factors.solve(&DVector::from_fn(
        k + 1,
        |i, _| if i == k { sign } else { 0.0 },
    ))?;
    let norm = v.norm();
    (norm > 0.0 && norm.is_finite()).then(|| v / norm)
}

/// The equations.
pub(super) struct System<'p, 'a, P: Mcp + ?Sized> {
    pub(super) problem: &'p mut Evaluated<'a, P>,
    pub(super) r: DVector<f64>,
    pub(super) places: Places,
}

impl<P: Mcp + ?Sized> System<'_, '_, P> {
    /// F and F' at z, or `None` if an entry is not finite.
    pub(super) fn local(&mut self, z: &DVector<f64>) -> Option<Local> {
        let point = self.problem.point(z);
        self.problem.counters.jacobians += 1;
        let jacobian = jacobian_at(self.problem.problem, point.z.as_slice());
        let f = &point.f + &jacobian * (z - &point.z);
        (f.iter().all(|v| v.is_finite()) && jacobian.iter().all(|v| v.is_finite()))
            .then_some(Local { f, jacobian })
    }

    pub(super) fn value(&self, quantity: Quantity, at: &Position, local: &Local) -> f64 {
        match quantity {
            Quantity::Z(i, bound) => at.z[i] - bound,
            Quantity::Multiplier(i) => local.f[i] - at.s * self.r[i],
            Quantity::S => at.s,
        }
    }

    /// Derivative of a quantity by (z_I, s).
    pub(super) fn row(&self, quantity: Quantity, local: &Local, inside: &[usize]) -> DVector<f64> {
        let k = inside.len();
        match quantity {
            Quantity::Z(i, _) => {
                DVector::from_fn(
                    k + 1,
                    |c, _| if c < k && inside[c] == i { 1.0 } else { 0.0 },
                )
            }
            Quantity::Multiplier(i) => DVector::from_fn(k + 1, |c, _| {
                if c < k {
                    local.jacobian[(i, inside[c])]
                } else {
                    -self.r[i]
                }
            }),
            Quantity::S => DVector::from_fn(k + 1, |c, _| if c < k { 0.0 } else { 1.0 }),
        }
    }

    fn bordered(&self, local: &Local, inside: &[usize], border: &DVector<f64>) -> DMatrix<f64> {
        let k = inside.len();
        DMatrix::from_fn(k + 1, k + 1, |row, col| match (row < k, col < k) {
            (true, true) => local.jacobian[(inside[row], inside[col])],
            (true, false) => -self.r[inside[row]],
            _ => border[col],
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
        let k = inside.len();
        self.problem.counters.factorisations += 1;
        unit(&self.bordered(local, &inside, border).lu(), k, sign)
    }

    /// Newton from a predicted position to the curve. The factors of a step serve the next ones
    /// while they gain enough (Shamanskii 1967), and at last the tangent.
    pub(super) fn correct(
        &mut self,
        predicted: &Position,
        border: &Border<'_>,
    ) -> Option<Corrected> {
        let inside = self.places.inside();
        let k = inside.len();
        let mut at = predicted.clone();
        let (mut last, mut factors) = (f64::INFINITY, None);
        for steps in 0..=CURVE_STEPS {
            let local = self.local(&at.z)?;
            let (row, rest) = match border {
                Border::Plane(normal) => ((*normal).clone(), 0.0),
                Border::Zero(q) => (self.row(*q, &local, &inside), self.value(*q, &at, &local)),
            };
            let right = DVector::from_fn(k + 1, |i, _| {
                if i < k {
                    at.s * self.r[inside[i]] - local.f[inside[i]]
                } else {
                    -rest
                }
            });
            let size = 1.0 + at.s.abs() * self.r.amax();
            if right.amax() <= CURVE_RESIDUAL * size {
                let tangent = factors.as_ref().and_then(|f| unit(f, k, 1.0));
                return Some(Corrected {
                    at,
                    local,
                    steps,
                    tangent,
                });
            }
            if right.amax() > 2.0 * last || steps == CURVE_STEPS {
                return None;
            }
            if right.amax() > CURVE_KEPT * last {
                factors = None;
            }
            last = right.amax();
            let lu = match factors.take() {
                Some(lu) => lu,
                None => {
                    self.problem.counters.factorisations += 1;
                    self.bordered(&local, &inside, &row).lu()
                }
            };
            let step = lu
                .solve(&right)
                .filter(|v| v.iter().all(|v| v.is_finite()))?;
            factors = Some(lu);
            self.shift(&mut at, &inside, &step, 1.0);
        }
        None
    }

    /// Moves a position by `length` times a direction in (z_I, s).
    pub(super) fn shift(
        &self,
        at: &mut Position,
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
