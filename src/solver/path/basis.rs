//! The basis of the linear subproblem: which unknown stands in which place, and the dense inverse.

use super::super::tolerance::REFACTOR_EVERY;
use super::Subproblem;
use super::number::Number;
use super::variable::Variable;
use nalgebra::{DMatrix, DVector};

/// The columns of M z - w + v + D a - t r = -(q + r).
pub(super) struct Columns<'a, T: Number> {
    pub(super) sub: &'a Subproblem<'a, T>,
    /// Covering vector r: minus the residual at the start.
    pub(super) r: DVector<T>,
    /// Row of the unit column D e_k of the artificial of z_i, where there is one.
    pub(super) artificial_row: Vec<Option<usize>>,
}

impl<T: Number> Columns<'_, T> {
    /// The column of an unknown, length n.
    pub(super) fn of(&self, variable: Variable) -> DVector<T> {
        let n = self.r.len();
        let unit = |row: usize, value: T| {
            let mut column = DVector::zeros(n);
            column[row] = value;
            column
        };
        match variable {
            Variable::Z(i) => self.sub.m.column(i).into_owned(),
            Variable::W(i) => unit(i, -T::one()),
            Variable::V(i) => unit(i, T::one()),
            Variable::Artificial(i) => unit(self.artificial_row[i].unwrap_or(i), T::one()),
            Variable::T => -&self.r,
        }
    }

    fn assemble(&self, variables: &[Variable]) -> DMatrix<T> {
        let n = self.r.len();
        let mut b = DMatrix::zeros(n, n);
        for (place, &variable) in variables.iter().enumerate() {
            b.set_column(place, &self.of(variable));
        }
        b
    }
}

/// A regular basis B with its explicit inverse, updated by rank one and factorised afresh in between.
pub(super) struct Basis<T> {
    pub(super) variables: Vec<Variable>,
    inverse: DMatrix<T>,
    /// B_0 S: columns of the first basis with the sign of their perturbation. The right-hand side is
    /// thought perturbed by B_0 S (eps, eps^2, ...), which decides every tie.
    perturbation: DMatrix<T>,
    updates: usize,
    /// Factorisations after the first.
    pub(super) refreshed: usize,
}

impl<T: Number> Basis<T> {
    /// The basis of these unknowns, or `None` if it is numerically singular.
    ///
    /// `signs[k]` is the side to which the unknown in place k is perturbed: 1 up, 0 not at all.
    pub(super) fn new(columns: &Columns<'_, T>, variables: Vec<Variable>, signs: &[T]) -> Option<Basis<T>> {
        let mut perturbation = columns.assemble(&variables);
        let inverse = T::invert(&perturbation)?;
        for (place, sign) in signs.iter().enumerate() {
            perturbation.column_mut(place).iter_mut().for_each(|entry| *entry *= sign.clone());
        }
        Some(Basis { variables, inverse, perturbation, updates: 0, refreshed: 0 })
    }

    /// B^-1 a.
    pub(super) fn solve(&self, a: &DVector<T>) -> DVector<T> {
        &self.inverse * a
    }

    /// The row of B^-1 B_0 S that belongs to a place: how its value is perturbed.
    pub(super) fn perturbation(&self, place: usize) -> DVector<T> {
        (self.inverse.row(place) * &self.perturbation).transpose()
    }

    /// Is it time to factorise afresh whatever the accuracy?
    pub(super) fn is_stale(&self) -> bool {
        self.updates >= REFACTOR_EVERY
    }

    /// Puts `entering` into `place`; `column` is B^-1 of its column, whose entry there is not zero.
    pub(super) fn replace(&mut self, place: usize, entering: Variable, column: &DVector<T>) {
        self.variables[place] = entering;
        self.updates += 1;
        let pivot_row = self.inverse.row(place) / column[place].clone();
        for (i, factor) in column.iter().enumerate() {
            if i != place && !factor.is_zero() {
                let mut row = self.inverse.row_mut(i);
                row -= &pivot_row * factor.clone();
            }
        }
        self.inverse.set_row(place, &pivot_row);
    }

    /// Inverts the current basis from scratch; false if it is numerically singular.
    pub(super) fn refactor(&mut self, columns: &Columns<'_, T>) -> bool {
        self.updates = 0;
        self.refreshed += 1;
        match T::invert(&columns.assemble(&self.variables)) {
            Some(inverse) => {
                self.inverse = inverse;
                true
            }
            None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn updates_agree_with_factorisation_from_scratch() {
        let (m, q) = (dmatrix![2.0, 1.0; 1.0, 3.0], dvector![1.0, 1.0]);
        let sub = Subproblem { m: &m, q: &q, lower: &[0.0; 2], upper: &[f64::INFINITY; 2] };
        let columns = Columns { sub: &sub, r: dvector![1.0, 2.0], artificial_row: vec![None; 2] };
        let mut basis = Basis::new(&columns, vec![Variable::W(0), Variable::W(1)], &[1.0; 2]).unwrap();
        assert_eq!(basis.perturbation(1), dvector![0.0, 1.0]);
        let column = basis.solve(&columns.of(Variable::Z(1)));
        basis.replace(1, Variable::Z(1), &column);
        let updated = basis.solve(&dvector![5.0, -7.0]);
        assert!(basis.refactor(&columns));
        assert!((updated - basis.solve(&dvector![5.0, -7.0])).amax() < 1e-14);
    }

    #[test]
    fn a_basis_is_stale_after_its_updates() {
        let (m, q) = (dmatrix![2.0, 1.0; 1.0, 3.0], dvector![1.0, 1.0]);
        let sub = Subproblem { m: &m, q: &q, lower: &[0.0; 2], upper: &[f64::INFINITY; 2] };
        let columns = Columns { sub: &sub, r: dvector![1.0, 2.0], artificial_row: vec![None; 2] };
        let mut basis = Basis::new(&columns, vec![Variable::W(0), Variable::W(1)], &[1.0; 2]).unwrap();
        for k in 0..REFACTOR_EVERY {
            assert!(!basis.is_stale(), "{k}");
            let entering = if k % 2 == 0 { Variable::Z(1) } else { Variable::W(1) };
            let column = basis.solve(&columns.of(entering));
            basis.replace(1, entering, &column);
        }
        assert!(basis.is_stale() && basis.refactor(&columns) && !basis.is_stale());
    }
}
