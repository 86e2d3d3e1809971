//! The state on a path: basis, values, the moving unknown; and the moves it can make.
//!
//! Between two pivots one unknown moves, the *entering* one, and the basic ones follow so that the
//! equations stay true: with B^-1 a of the entering column a, a basic value changes by
//! -sign (B^-1 a) per unit of the movement. At a pivot `walk` calls one of two moves: `exchange`
//! puts the entering unknown into the place of the one that has stopped it, whose complement moves
//! next; `flip` ends at the entering z_i's own other bound.

use super::super::dense::subtract;
use super::super::number::PathNumber;
use super::super::tolerance::DRIFT;
use super::basis::Basis;
use super::block::BlockingVariable;
use super::columns::PathColumns;
use super::variable::Variable;

/// Numbers of a path; all unknowns not named here are zero or at a bound. Storage is kept.
pub(super) struct PathState<T> {
    /// Values of the basic unknowns, place by place.
    pub(super) values: Vec<T>,
    /// All z, also those not basic.
    pub(super) z: Vec<T>,
    /// w - v.
    pub(super) multiplier: Vec<T>,
    /// B^-1 a of the moving unknown.
    pub(super) column: Vec<T>,
    /// Change of the values per unit of its movement.
    pub(super) rates: Vec<T>,
    /// What can stop it.
    pub(super) blocks: Vec<BlockingVariable<T>>,
    /// Rows to compare in the ratio test.
    pub(super) rows: [Vec<T>; 2],
    /// Is z_i basic?
    is_basic: Vec<bool>,
    /// A unit column as a dense one.
    work: Vec<T>,
    /// A right-hand side, and what is left of it.
    sum: Vec<T>,
}

impl<T> Default for PathState<T> {
    fn default() -> Self {
        PathState {
            values: Vec::new(),
            z: Vec::new(),
            multiplier: Vec::new(),
            column: Vec::new(),
            rates: Vec::new(),
            blocks: Vec::new(),
            rows: [Vec::new(), Vec::new()],
            is_basic: Vec::new(),
            work: Vec::new(),
            sum: Vec::new(),
        }
    }
}

/// A path under way.
pub(super) struct PathTableau<'a, T: PathNumber> {
    pub(super) columns: PathColumns<'a, T>,
    pub(super) basis: &'a mut Basis<T>,
    pub(super) state: &'a mut PathState<T>,
    pub(super) t: T,
    /// The unknown that moves.
    pub(super) entering: Variable,
    /// 1 if it increases, -1 if it decreases.
    pub(super) sign: T,
}

impl<'a, T: PathNumber> PathTableau<'a, T> {
    /// At t = 0, with t about to increase; z and multipliers of the state are those of the start.
    pub(super) fn new(
        columns: PathColumns<'a, T>,
        basis: &'a mut Basis<T>,
        state: &'a mut PathState<T>,
    ) -> Self {
        let n = state.z.len();
        state.values.clear();
        state.is_basic.clear();
        state.is_basic.resize(n, false);

        for variable in &basis.variables {
            state.values.push(match *variable {
                Variable::Z(i) => state.z[i].clone(),
                Variable::W(i) => state.multiplier[i].clone(),
                Variable::V(i) => -state.multiplier[i].clone(),
                Variable::Artificial(_) | Variable::T => T::zero(),
            });

            if let Variable::Z(i) = variable {
                state.is_basic[*i] = true;
            }
        }

        state.column.resize(n, T::zero());
        state.rates.resize(n, T::zero());
        state.sum.resize(n, T::zero());

        PathTableau {
            columns,
            basis,
            state,
            t: T::zero(),
            entering: Variable::T,
            sign: T::one(),
        }
    }

    /// Bounds of an unknown. t has none below: like Lemke's covering variable 1 - t, which has none
    /// above.
    pub(super) fn bounds(&self, variable: Variable) -> (T, T) {
        let lower = self.columns.sub.lower;
        let upper = self.columns.sub.upper;

        match variable {
            Variable::Z(i) => (lower[i].clone(), upper[i].clone()),
            Variable::W(i) | Variable::V(i) if lower[i] == upper[i] => {
                (-T::infinity(), T::infinity())
            }
            Variable::W(_) | Variable::V(_) => (T::zero(), T::infinity()),
            Variable::Artificial(_) => (T::zero(), T::zero()),
            Variable::T => (-T::infinity(), T::one()),
        }
    }

    /// Current value of an unknown that is moving.
    fn entering_value(&self) -> T {
        match self.entering {
            Variable::Z(i) => self.state.z[i].clone(),
            Variable::W(i) => self.state.multiplier[i].clone(),
            Variable::V(i) => -self.state.multiplier[i].clone(),
            Variable::Artificial(_) => T::zero(),
            Variable::T => self.t.clone(),
        }
    }

    /// How far the moving unknown may go before its own bound.
    pub(super) fn own_room(&self) -> T {
        let (lower, upper) = self.bounds(self.entering);
        let value = self.entering_value();
        let room = if self.sign > T::zero() {
            upper - value
        } else {
            value - lower
        };

        T::zero().larger(room)
    }

    /// B^-1 a of an unknown, into the state's column.
    fn solve_for(&mut self, variable: Variable) {
        let state = &mut *self.state;
        if self.columns.unit(variable).is_some() {
            self.columns.write(variable, &mut state.work);
            self.basis.solve(&state.work, &mut state.column);
        } else {
            let column = self.columns.dense(variable);
            self.basis.solve(column, &mut state.column);
        }
    }

    /// Column and rates of the moving unknown.
    pub(super) fn set_rates(&mut self) {
        self.solve_for(self.entering);
        let sign = -self.sign.clone();

        for (rate, entry) in self.state.rates.iter_mut().zip(&self.state.column) {
            *rate = entry.clone() * sign.clone();
        }
    }

    /// Moves the entering unknown by `step`; basic values follow at the rates.
    pub(super) fn advance(&mut self, step: &T) {
        let entering_value = self.entering_value() + self.sign.clone() * step.clone();
        for (value, rate) in self.state.values.iter_mut().zip(&self.state.rates) {
            *value += step.clone() * rate.clone();
        }

        self.state.multiplier.fill(T::zero());
        for place in 0..self.basis.variables.len() {
            let value = self.state.values[place].clone();
            self.store(self.basis.variables[place], value);
        }

        self.store(self.entering, entering_value);
    }

    /// Writes the value of an unknown to z, the multipliers or t.
    fn store(&mut self, variable: Variable, value: T) {
        match variable {
            Variable::Z(i) => self.state.z[i] = value,
            Variable::W(i) => self.state.multiplier[i] = value,
            Variable::V(i) => self.state.multiplier[i] = -value,
            Variable::Artificial(_) => {}
            Variable::T => self.t = value.smaller(T::one()),
        }
    }

    /// The moving z_i has crossed to its other bound: the multiplier of that bound moves next.
    pub(super) fn flip(&mut self) {
        if let Variable::Z(i) = self.entering {
            let at_upper = self.sign > T::zero();
            self.leave_at_bound(i, at_upper);
            self.sign = T::one();
        }
    }

    /// Puts z_i on a bound; the multiplier of that bound moves next.
    fn leave_at_bound(&mut self, i: usize, at_upper: bool) {
        if at_upper {
            self.state.z[i] = self.columns.sub.upper[i].clone();
            self.entering = Variable::V(i);
        } else {
            self.state.z[i] = self.columns.sub.lower[i].clone();
            self.entering = Variable::W(i);
        }
    }

    /// Puts the moving unknown into `place`; the complement of the leaving one moves next. The
    /// state's column is that of the moving unknown. False if a fresh factorisation was due and
    /// found the basis singular.
    pub(super) fn exchange(&mut self, place: usize, at_upper: bool) -> bool {
        let leaving = self.basis.variables[place];
        let value = self.entering_value();
        self.basis.replace(place, self.entering, &self.state.column);
        self.state.values[place] = value;
        self.mark_basic(leaving, false);
        self.mark_basic(self.entering, true);

        self.set_successor(leaving, at_upper);
        if self.basis.is_stale() || self.drift() > T::tolerance(DRIFT) {
            self.refactor()
        } else {
            true
        }
    }

    /// Notes whether an unknown is basic, if it is one of z.
    fn mark_basic(&mut self, variable: Variable, is_basic: bool) {
        if let Variable::Z(i) = variable {
            self.state.is_basic[i] = is_basic;
        }
    }

    /// Values that satisfy the equations again, after an unknown was put on a bound it had passed.
    pub(super) fn settle(&mut self) {
        self.set_right_hand_side();
        self.basis.solve(&self.state.sum, &mut self.state.values);
    }

    /// Sets the unknown that moves after `leaving` has reached a bound, and its direction.
    fn set_successor(&mut self, leaving: Variable, at_upper: bool) {
        self.sign = T::one();
        match leaving {
            Variable::Z(i) => self.leave_at_bound(i, at_upper),
            Variable::W(i) => self.entering = Variable::Z(i),
            Variable::V(i) => {
                self.entering = Variable::Z(i);
                self.sign = -T::one();
            }
            Variable::Artificial(i) => {
                self.entering = Variable::Z(i);
                self.sign = self.rising_sign(i);
            }
            // t leaves only at 1, where the walk ends.
            Variable::T => self.entering = Variable::T,
        }
    }

    /// z_i was held inside its bounds by an artificial and may move both ways: the way t rises.
    fn rising_sign(&mut self, i: usize) -> T {
        self.solve_for(Variable::Z(i));
        let place = self.basis.variables.iter().position(|&v| v == Variable::T);
        let falls = place.is_some_and(|p| self.state.column[p] > T::zero());

        if falls { -T::one() } else { T::one() }
    }

    /// Error of the equations, relative to the size of their terms.
    fn drift(&mut self) -> T {
        self.set_right_hand_side();
        let PathState { values, sum, .. } = &mut *self.state;
        let mut size = self.columns.scale();

        for (&variable, value) in self.basis.variables.iter().zip(values.iter()) {
            size = size.larger(self.columns.size(variable) * value.magnitude());
            match self.columns.unit(variable) {
                None => subtract(sum, value, self.columns.dense(variable)),
                Some(unit) => sum[unit.row] -= unit.times(value),
            }
        }

        if size > T::zero() {
            T::largest(&*sum) / size
        } else {
            T::zero()
        }
    }

    /// Factors and values from scratch; false if the basis is numerically singular.
    fn refactor(&mut self) -> bool {
        if !self.basis.refactor(&self.columns) {
            return false;
        }

        self.settle();
        true
    }

    /// -(q + r) less the columns of the z that are not basic, into the state's sum.
    fn set_right_hand_side(&mut self) {
        let PathState {
            z, sum, is_basic, ..
        } = &mut *self.state;
        sum.clone_from_slice(self.columns.right());

        for (i, z) in z.iter().enumerate() {
            if !is_basic[i] {
                subtract(sum, z, self.columns.dense(Variable::Z(i)));
            }
        }
    }
}

#[cfg(test)]
mod tests;
