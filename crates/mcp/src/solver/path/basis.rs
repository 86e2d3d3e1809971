//! The basis of the linear subproblem: which unknown stands in which place, its factors, and the
//! product form of what was exchanged since.
//!
//! Let B_k be the basis factored last. Each exchange since then has put a column a in a place p;
//! with e = B^-1 a, B before it, the new basis is B E, where E is the identity with e in column p.
//! So B^-1 b is found from the factors of B_k and one step for each exchange. Called by `tableau`,
//! and by the ratio test for the lexicographic rows.

use super::super::dense::{dot, subtract};
use super::super::number::PathNumber;
use super::super::tolerance::REFACTOR_EVERY;
use super::columns::PathColumns;
use super::factor::{BasisFactor, Repair};
use super::variable::Variable;
use std::mem::replace;

/// A regular basis B = B_k E_1 ... E_m: factors of B_k, and one column of each exchange since.
pub(super) struct Basis<T> {
    /// The basic unknown in each place.
    pub(super) variables: Vec<Variable>,
    factor: BasisFactor<T>,
    /// Columns B^-1 a of the unknowns that came in, one after the other, each of length n.
    exchanged: Vec<T>,
    /// Their places.
    places: Vec<usize>,
    /// The unknowns of the first basis B_0. The right-hand side is thought perturbed by
    /// B_0 (eps, eps^2, ...), artificials not at all, which decides every tie.
    first: Vec<Variable>,
    /// Factorisations after the first.
    pub(super) refreshed: usize,
    work: Vec<T>,
    row: Vec<T>,
}

impl<T> Default for Basis<T> {
    fn default() -> Self {
        Basis {
            variables: Vec::new(),
            factor: BasisFactor::default(),
            exchanged: Vec::new(),
            places: Vec::new(),
            first: Vec::new(),
            refreshed: 0,
            work: Vec::new(),
            row: Vec::new(),
        }
    }
}

impl<T: PathNumber> Basis<T> {
    /// Factors the unknowns in `variables` as the first basis of a path; false if it is numerically
    /// singular, and [`Basis::repairs`] says how to mend it.
    pub(super) fn begin(&mut self, columns: &PathColumns<'_, T>) -> bool {
        self.refreshed = 0;
        self.forget();
        self.first.clone_from(&self.variables);

        self.factor.factor(columns, &self.variables)
    }

    /// Places whose columns depend on others, each with the row whose unit column may replace it.
    pub(super) fn repairs(&self) -> &[Repair] {
        self.factor.repairs()
    }

    /// B^-1 a.
    pub(super) fn solve(&mut self, a: &[T], x: &mut [T]) {
        let n = x.len();
        self.factor.solve(a, x, &mut self.work);

        for (k, &place) in self.places.iter().enumerate() {
            let column = &self.exchanged[k * n..(k + 1) * n];
            exchange(x, place, column);
        }
    }

    /// How the value in a place is perturbed: its row of B^-1 B_0, into `out`.
    pub(super) fn perturbation(
        &mut self,
        columns: &PathColumns<'_, T>,
        place: usize,
        out: &mut Vec<T>,
    ) {
        let n = self.variables.len();
        out.clear();
        out.resize(n, T::zero());
        out[place] = T::one();

        // The row of (E_1 ... E_m)^-1: from the last exchange to the first.
        for (k, &p) in self.places.iter().enumerate().rev() {
            let column = &self.exchanged[k * n..(k + 1) * n];
            let value = replace(&mut out[p], T::zero());
            out[p] = (value - dot(out, column)) / column[p].clone();
        }

        // Times B_k^-1 B_0, which is the identity unless the basis was factored afresh.
        if self.refreshed > 0 {
            self.row.resize(n, T::zero());
            self.factor
                .solve_transposed(out, &mut self.row, &mut self.work);
            for (entry, &variable) in out.iter_mut().zip(&self.first) {
                *entry = self.times_row(columns, variable);
            }
        }

        for (entry, variable) in out.iter_mut().zip(&self.first) {
            if matches!(variable, Variable::Artificial(_)) {
                *entry = T::zero();
            }
        }
    }

    /// The product of the row with the column of an unknown.
    fn times_row(&self, columns: &PathColumns<'_, T>, variable: Variable) -> T {
        match columns.unit(variable) {
            Some(unit) => unit.times(&self.row[unit.row]),
            None => dot(&self.row, columns.dense(variable)),
        }
    }

    /// Is it time to factorise afresh whatever the accuracy?
    pub(super) fn is_stale(&self) -> bool {
        self.places.len() >= REFACTOR_EVERY
    }

    /// Puts `entering` into `place`; `column` is B^-1 of its column, whose entry there is not zero.
    pub(super) fn replace(&mut self, place: usize, entering: Variable, column: &[T]) {
        self.variables[place] = entering;
        self.places.push(place);
        self.exchanged.extend_from_slice(column);
    }

    /// Factors the current basis from scratch; false if it is numerically singular.
    pub(super) fn refactor(&mut self, columns: &PathColumns<'_, T>) -> bool {
        self.forget();
        self.refreshed += 1;
        self.factor.factor(columns, &self.variables)
    }

    /// Drops the exchanges.
    fn forget(&mut self) {
        self.exchanged.clear();
        self.places.clear();
    }
}

/// x becomes E^-1 x, E the identity with `column` in `place`.
fn exchange<T: PathNumber>(x: &mut [T], place: usize, column: &[T]) {
    let value = x[place].clone() / column[place].clone();
    subtract(x, &value, column);
    x[place] = value;
}

#[cfg(test)]
mod tests {
    use super::super::Subproblem;
    use super::super::columns::PathFrame;
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    /// z >= 0 with m and q = (1, 1).
    fn subproblem(m: &DMatrix<f64>) -> Subproblem<'_, f64> {
        Subproblem {
            m,
            q: &[1.0, 1.0],
            lower: &[0.0; 2],
            upper: &[f64::INFINITY; 2],
        }
    }

    fn frame_of(sub: &Subproblem<'_, f64>) -> PathFrame<f64> {
        let mut frame = PathFrame::default();
        frame.set(sub, &[0.0, 0.0], &[2.0, 3.0]);
        frame
    }

    /// The basis of the slacks.
    fn begun(columns: &PathColumns<'_, f64>) -> Basis<f64> {
        let mut basis = Basis {
            variables: vec![Variable::W(0), Variable::W(1)],
            ..Basis::default()
        };
        assert!(basis.begin(columns));
        basis
    }

    #[test]
    fn updates_agree_with_factorisation_from_scratch() {
        let m = dmatrix![2.0, 1.0; 1.0, 3.0];
        let sub = subproblem(&m);
        let frame = frame_of(&sub);
        let columns = frame.columns(&sub);
        let mut basis = begun(&columns);

        let mut column = vec![0.0; 2];
        let mut row = Vec::new();
        let mut x = vec![0.0; 2];
        basis.perturbation(&columns, 1, &mut row);

        assert_eq!(row, [0.0, 1.0]);

        basis.solve(columns.dense(Variable::Z(1)), &mut column);
        basis.replace(1, Variable::Z(1), &column);
        basis.solve(&[5.0, -7.0], &mut x);
        let updated = x.clone();
        let mut updated_row = Vec::new();
        basis.perturbation(&columns, 1, &mut updated_row);

        assert!(basis.refactor(&columns));

        basis.solve(&[5.0, -7.0], &mut x);
        basis.perturbation(&columns, 1, &mut row);
        for (a, b) in updated.iter().chain(&updated_row).zip(x.iter().chain(&row)) {
            assert!(
                (a - b).abs() < 1e-14,
                "{updated:?} {updated_row:?} {x:?} {row:?}"
            );
        }

        assert_eq!(updated_row, [0.0, -1.0 / 3.0]);
    }

    #[test]
    fn a_basis_is_stale_after_its_updates() {
        let m = dmatrix![2.0, 1.0; 1.0, 3.0];
        let sub = subproblem(&m);
        let frame = frame_of(&sub);
        let columns = frame.columns(&sub);
        let mut basis = begun(&columns);

        let mut given = Vec::new();
        let mut column = vec![0.0; 2];
        for k in 0..REFACTOR_EVERY {
            assert!(!basis.is_stale(), "{k}");

            let entering = if k % 2 == 0 {
                Variable::Z(1)
            } else {
                Variable::W(1)
            };
            columns.write(entering, &mut given);
            basis.solve(&given, &mut column);
            basis.replace(1, entering, &column);
        }

        assert!(basis.is_stale());
        assert!(basis.refactor(&columns));
        assert!(!basis.is_stale());
    }
}
