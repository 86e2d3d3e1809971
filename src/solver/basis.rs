//! The basis of the linear subproblem: which column stands for which unknown, and its inverse.

use super::path::Variable;
use super::tolerance::{REFACTOR_EVERY, REGULAR};
use nalgebra::{DMatrix, DVector};

/// The columns of M z - w + v + t r = r - q.
pub(super) struct Columns<'a> {
    pub(super) m: &'a DMatrix<f64>,
    pub(super) r: &'a DVector<f64>,
}

impl Columns<'_> {
    /// The column of a variable.
    pub(super) fn of(&self, variable: Variable) -> DVector<f64> {
        let n = self.r.len();
        match variable {
            Variable::Z(i) => self.m.column(i).into_owned(),
            Variable::W(i) => DVector::from_fn(n, |k, _| if k == i { -1.0 } else { 0.0 }),
            Variable::V(i) => DVector::from_fn(n, |k, _| if k == i { 1.0 } else { 0.0 }),
            Variable::T => self.r.clone(),
        }
    }
}

/// A regular basis with its explicit inverse, updated by rank one and refactored now and then.
pub(super) struct Basis {
    pub(super) variables: Vec<Variable>,
    inverse: DMatrix<f64>,
    /// B^-1 B_0: its rows order ties lexicographically (right-hand side perturbed by B_0 eps).
    first: DMatrix<f64>,
    updates: usize,
}

impl Basis {
    /// The basis of these variables, or `None` if it is numerically singular.
    pub(super) fn new(columns: &Columns<'_>, variables: Vec<Variable>) -> Option<Basis> {
        let first = assemble(columns, &variables);
        let inverse = invert(&first)?;
        Some(Basis { variables, inverse, first, updates: 0 })
    }

    /// B^-1 a.
    pub(super) fn solve(&self, a: &DVector<f64>) -> DVector<f64> {
        &self.inverse * a
    }

    /// Was the inverse computed from scratch at the last replacement?
    pub(super) fn is_fresh(&self) -> bool {
        self.updates == 0
    }

    /// Row of B^-1 B_0, the lexicographic perturbation of that basic variable.
    pub(super) fn perturbation(&self, row: usize) -> DVector<f64> {
        (self.inverse.row(row) * &self.first).transpose()
    }

    /// Replaces the variable in `row`; `direction` is B^-1 of the entering column.
    /// False if the new basis is numerically singular.
    pub(super) fn replace(&mut self, columns: &Columns<'_>, row: usize, entering: Variable, direction: &DVector<f64>) -> bool {
        self.variables[row] = entering;
        self.updates += 1;
        if self.updates >= REFACTOR_EVERY {
            self.updates = 0;
            return match invert(&assemble(columns, &self.variables)) {
                Some(inverse) => {
                    self.inverse = inverse;
                    true
                }
                None => false,
            };
        }
        let pivot_row = self.inverse.row(row) / direction[row];
        for i in 0..direction.len() {
            if i != row && direction[i] != 0.0 {
                let factor = direction[i];
                let mut target = self.inverse.row_mut(i);
                target -= &pivot_row * factor;
            }
        }
        self.inverse.set_row(row, &pivot_row);
        true
    }
}

fn assemble(columns: &Columns<'_>, variables: &[Variable]) -> DMatrix<f64> {
    let list: Vec<DVector<f64>> = variables.iter().map(|&v| columns.of(v)).collect();
    DMatrix::from_columns(&list)
}

/// The inverse by LU, checked: |B B^-1 - I| small, every entry finite.
fn invert(b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let inverse = b.clone().lu().try_inverse()?;
    let error = (b * &inverse - DMatrix::identity(b.nrows(), b.ncols())).amax();
    (error < REGULAR).then_some(inverse) // false for NaN as well
}
