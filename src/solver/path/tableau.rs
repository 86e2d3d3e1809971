//! The state on a path: basis, values, the moving unknown; and the moves it can make.

use super::super::tolerance::DRIFT;
use super::basis::{Basis, Columns};
use super::number::{Number, largest};
use super::start::StartPoint;
use super::variable::Variable;
use nalgebra::DVector;

/// All unknowns not named here are zero or at a bound.
pub(super) struct Tableau<'a, T: Number> {
    pub(super) columns: &'a Columns<'a, T>,
    pub(super) basis: Basis<T>,
    /// Values of the basic unknowns, place by place.
    pub(super) values: DVector<T>,
    /// All z, also those not basic.
    pub(super) z: DVector<T>,
    /// w - v.
    pub(super) multiplier: DVector<T>,
    pub(super) t: T,
    /// The unknown that moves.
    pub(super) entering: Variable,
    /// 1 if it increases, -1 if it decreases.
    pub(super) sign: T,
}

impl<'a, T: Number> Tableau<'a, T> {
    /// At t = 0, with t about to increase.
    pub(super) fn new(columns: &'a Columns<'a, T>, basis: Basis<T>, start: StartPoint<T>) -> Self {
        let StartPoint { z, multiplier } = start;
        let values = DVector::from_fn(z.len(), |place, _| match basis.variables[place] {
            Variable::Z(i) => z[i].clone(),
            Variable::W(i) => multiplier[i].clone(),
            Variable::V(i) => -multiplier[i].clone(),
            Variable::Artificial(_) | Variable::T => T::zero(),
        });
        Tableau { columns, basis, values, z, multiplier, t: T::zero(), entering: Variable::T, sign: T::one() }
    }

    /// Bounds of an unknown. t has none below: like Lemke's covering variable 1 - t, which has none above.
    pub(super) fn bounds(&self, variable: Variable) -> (T, T) {
        let (lower, upper) = (self.columns.sub.lower, self.columns.sub.upper);
        match variable {
            Variable::Z(i) => (lower[i].clone(), upper[i].clone()),
            Variable::W(i) | Variable::V(i) if lower[i] == upper[i] => (-T::infinity(), T::infinity()),
            Variable::W(_) | Variable::V(_) => (T::zero(), T::infinity()),
            Variable::Artificial(_) => (T::zero(), T::zero()),
            Variable::T => (-T::infinity(), T::one()),
        }
    }

    /// Current value of an unknown that is moving.
    fn entering_value(&self) -> T {
        match self.entering {
            Variable::Z(i) => self.z[i].clone(),
            Variable::W(i) => self.multiplier[i].clone(),
            Variable::V(i) => -self.multiplier[i].clone(),
            Variable::Artificial(_) => T::zero(),
            Variable::T => self.t.clone(),
        }
    }

    /// How far the moving unknown may go before its own bound.
    pub(super) fn own_room(&self) -> T {
        let (lower, upper) = self.bounds(self.entering);
        let value = self.entering_value();
        T::zero().larger(if self.sign > T::zero() { upper - value } else { value - lower })
    }

    /// B^-1 a of the moving unknown.
    pub(super) fn column(&self) -> DVector<T> {
        self.basis.solve(&self.columns.of(self.entering))
    }

    /// Moves the entering unknown by `step`; basic values follow at `rates` per unit.
    pub(super) fn advance(&mut self, rates: &DVector<T>, step: T) {
        let entering_value = self.entering_value() + self.sign.clone() * step.clone();
        self.values.axpy(step, rates, T::one());
        self.multiplier.fill(T::zero());
        for place in 0..self.values.len() {
            self.store(self.basis.variables[place], self.values[place].clone());
        }
        self.store(self.entering, entering_value);
    }

    /// Writes the value of a basic or moving unknown where the point keeps it.
    fn store(&mut self, variable: Variable, value: T) {
        match variable {
            Variable::Z(i) => self.z[i] = value,
            Variable::W(i) => self.multiplier[i] = value,
            Variable::V(i) => self.multiplier[i] = -value,
            Variable::Artificial(_) => {}
            Variable::T => self.t = value.smaller(T::one()),
        }
    }

    /// The moving z_i has crossed to its other bound: the multiplier of that bound moves next.
    pub(super) fn flip(&mut self) {
        if let Variable::Z(i) = self.entering {
            let at_upper = self.sign > T::zero();
            self.z[i] = if at_upper { self.columns.sub.upper[i].clone() } else { self.columns.sub.lower[i].clone() };
            self.entering = if at_upper { Variable::V(i) } else { Variable::W(i) };
            self.sign = T::one();
        }
    }

    /// Puts the moving unknown into `place`; the complement of the leaving one moves next.
    /// False if a fresh factorisation was due and found the basis singular.
    pub(super) fn exchange(&mut self, place: usize, at_upper: bool, column: &DVector<T>) -> bool {
        let leaving = self.basis.variables[place];
        let value = self.entering_value();
        self.basis.replace(place, self.entering, column);
        self.values[place] = value;
        (self.entering, self.sign) = self.successor(leaving, at_upper);
        if self.basis.is_stale() || self.drift() > T::tolerance(DRIFT) { self.refactor() } else { true }
    }

    /// Values that satisfy the equations again, after an unknown was put on a bound it had passed.
    pub(super) fn settle(&mut self) {
        self.values = self.basis.solve(&self.right_hand_side());
    }

    /// The unknown that moves after `leaving` has reached a bound, and its direction.
    fn successor(&mut self, leaving: Variable, at_upper: bool) -> (Variable, T) {
        match leaving {
            Variable::Z(i) => {
                let (lower, upper) = self.bounds(leaving);
                self.z[i] = if at_upper { upper } else { lower };
                (if at_upper { Variable::V(i) } else { Variable::W(i) }, T::one())
            }
            Variable::W(i) => (Variable::Z(i), T::one()),
            Variable::V(i) => (Variable::Z(i), -T::one()),
            Variable::Artificial(i) => (Variable::Z(i), self.rising_sign(i)),
            Variable::T => (Variable::T, T::one()), // t leaves only at 1, where the walk ends
        }
    }

    /// z_i was held inside its bounds by an artificial and may move both ways: the way t rises.
    fn rising_sign(&self, i: usize) -> T {
        let column = self.basis.solve(&self.columns.of(Variable::Z(i)));
        let place = self.basis.variables.iter().position(|&v| v == Variable::T);
        let falls = place.is_some_and(|p| column[p] > T::zero());
        if falls { -T::one() } else { T::one() }
    }

    /// Error of the equations, relative to the size of their terms.
    fn drift(&self) -> T {
        let (target, mut size) = (self.right_hand_side(), largest(self.columns.sub.q) + largest(&self.columns.r));
        let mut sum = -target;
        for (&variable, value) in self.basis.variables.iter().zip(self.values.iter()) {
            let column = self.columns.of(variable);
            size = size.larger(largest(&column) * value.magnitude());
            sum.axpy(value.clone(), &column, T::one());
        }
        if size > T::zero() { largest(&sum) / size } else { T::zero() }
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
    fn right_hand_side(&self) -> DVector<T> {
        let mut outside = self.z.clone();
        for &variable in &self.basis.variables {
            if let Variable::Z(i) = variable {
                outside[i] = T::zero();
            }
        }
        -(&self.columns.r + self.columns.sub.q) - self.columns.sub.m * outside
    }
}
