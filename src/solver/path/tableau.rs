//! The state on a path: basis, values, the moving unknown; and the moves it can make.

use super::super::tolerance::DRIFT;
use super::basis::{Basis, Columns};
use super::start::StartPoint;
use super::variable::Variable;
use nalgebra::DVector;

/// All unknowns not named here are zero or at a bound.
pub(super) struct Tableau<'a> {
    pub(super) columns: &'a Columns<'a>,
    pub(super) basis: Basis,
    /// Values of the basic unknowns, place by place.
    pub(super) values: DVector<f64>,
    /// All z, also those not basic.
    pub(super) z: DVector<f64>,
    /// w - v.
    pub(super) multiplier: DVector<f64>,
    pub(super) t: f64,
    /// The unknown that moves.
    pub(super) entering: Variable,
    /// 1 if it increases, -1 if it decreases.
    pub(super) sign: f64,
}

impl<'a> Tableau<'a> {
    /// At t = 0, with t about to increase.
    pub(super) fn new(columns: &'a Columns<'a>, basis: Basis, start: StartPoint) -> Self {
        let StartPoint { z, multiplier } = start;
        let values = DVector::from_fn(z.len(), |place, _| match basis.variables[place] {
            Variable::Z(i) => z[i],
            Variable::W(i) => multiplier[i],
            Variable::V(i) => -multiplier[i],
            Variable::Artificial(_) | Variable::T => 0.0,
        });
        Tableau { columns, basis, values, z, multiplier, t: 0.0, entering: Variable::T, sign: 1.0 }
    }

    /// Bounds of an unknown. t has none below: like Lemke's covering variable 1 - t, which has none above.
    pub(super) fn bounds(&self, variable: Variable) -> (f64, f64) {
        let (lower, upper) = (self.columns.sub.lower, self.columns.sub.upper);
        match variable {
            Variable::Z(i) => (lower[i], upper[i]),
            Variable::W(i) | Variable::V(i) if lower[i] == upper[i] => (f64::NEG_INFINITY, f64::INFINITY),
            Variable::W(_) | Variable::V(_) => (0.0, f64::INFINITY),
            Variable::Artificial(_) => (0.0, 0.0),
            Variable::T => (f64::NEG_INFINITY, 1.0),
        }
    }

    /// Current value of an unknown that is moving.
    fn entering_value(&self) -> f64 {
        match self.entering {
            Variable::Z(i) => self.z[i],
            Variable::W(i) => self.multiplier[i],
            Variable::V(i) => -self.multiplier[i],
            Variable::Artificial(_) => 0.0,
            Variable::T => self.t,
        }
    }

    /// How far the moving unknown may go before its own bound.
    pub(super) fn own_room(&self) -> f64 {
        let (lower, upper) = self.bounds(self.entering);
        let value = self.entering_value();
        if self.sign > 0.0 { (upper - value).max(0.0) } else { (value - lower).max(0.0) }
    }

    /// B^-1 a of the moving unknown.
    pub(super) fn column(&self) -> DVector<f64> {
        self.basis.solve(&self.columns.of(self.entering))
    }

    /// Moves the entering unknown by `step`; basic values follow at `rates` per unit.
    pub(super) fn advance(&mut self, rates: &DVector<f64>, step: f64) {
        let entering_value = self.entering_value() + self.sign * step;
        self.values.axpy(step, rates, 1.0);
        self.multiplier.fill(0.0);
        for place in 0..self.values.len() {
            self.store(self.basis.variables[place], self.values[place]);
        }
        self.store(self.entering, entering_value);
    }

    /// Writes the value of a basic or moving unknown where the point keeps it.
    fn store(&mut self, variable: Variable, value: f64) {
        match variable {
            Variable::Z(i) => self.z[i] = value,
            Variable::W(i) => self.multiplier[i] = value,
            Variable::V(i) => self.multiplier[i] = -value,
            Variable::Artificial(_) => {}
            Variable::T => self.t = value.min(1.0),
        }
    }

    /// The moving z_i has crossed to its other bound: the multiplier of that bound moves next.
    pub(super) fn flip(&mut self) {
        if let Variable::Z(i) = self.entering {
            let at_upper = self.sign > 0.0;
            self.z[i] = if at_upper { self.columns.sub.upper[i] } else { self.columns.sub.lower[i] };
            self.entering = if at_upper { Variable::V(i) } else { Variable::W(i) };
            self.sign = 1.0;
        }
    }

    /// Puts the moving unknown into `place`; the complement of the leaving one moves next.
    /// False if a fresh factorisation was due and found the basis singular.
    pub(super) fn exchange(&mut self, place: usize, at_upper: bool, column: &DVector<f64>) -> bool {
        let leaving = self.basis.variables[place];
        let value = self.entering_value();
        self.basis.replace(place, self.entering, column);
        self.values[place] = value;
        (self.entering, self.sign) = self.successor(leaving, at_upper);
        if self.basis.is_stale() || self.drift() > DRIFT { self.refactor() } else { true }
    }

    /// The unknown that moves after `leaving` has reached a bound, and its direction.
    fn successor(&mut self, leaving: Variable, at_upper: bool) -> (Variable, f64) {
        match leaving {
            Variable::Z(i) => {
                let (lower, upper) = self.bounds(leaving);
                self.z[i] = if at_upper { upper } else { lower };
                (if at_upper { Variable::V(i) } else { Variable::W(i) }, 1.0)
            }
            Variable::W(i) => (Variable::Z(i), 1.0),
            Variable::V(i) => (Variable::Z(i), -1.0),
            Variable::Artificial(i) => (Variable::Z(i), self.rising_sign(i)),
            Variable::T => (Variable::T, 1.0), // t leaves only at 1, where the walk ends
        }
    }

    /// z_i was held inside its bounds by an artificial and may move both ways: the way t rises.
    fn rising_sign(&self, i: usize) -> f64 {
        let column = self.basis.solve(&self.columns.of(Variable::Z(i)));
        let place = self.basis.variables.iter().position(|&v| v == Variable::T);
        let rate = place.map_or(0.0, |p| -column[p]);
        if rate < 0.0 { -1.0 } else { 1.0 }
    }

    /// Error of the equations, relative to the size of their terms.
    fn drift(&self) -> f64 {
        let (target, mut size) = (self.right_hand_side(), self.columns.sub.q.amax() + self.columns.r.amax());
        let mut sum = -target;
        for (&variable, &value) in self.basis.variables.iter().zip(self.values.iter()) {
            let column = self.columns.of(variable);
            size = size.max(column.amax() * value.abs());
            sum.axpy(value, &column, 1.0);
        }
        if size > 0.0 { sum.amax() / size } else { 0.0 }
    }

    /// Inverse and values from scratch.
    fn refactor(&mut self) -> bool {
        if !self.basis.refactor(self.columns) {
            return false;
        }
        self.values = self.basis.solve(&self.right_hand_side());
        true
    }

    /// -(q + r) less the columns of the z that are not basic.
    fn right_hand_side(&self) -> DVector<f64> {
        let mut outside = self.z.clone();
        for &variable in &self.basis.variables {
            if let Variable::Z(i) = variable {
                outside[i] = 0.0;
            }
        }
        -(&self.columns.r + self.columns.sub.q) - self.columns.sub.m * outside
    }
}
