//! Factors of a basis matrix. Most of its columns are unit vectors: only the rows that none of them
//! takes are eliminated, by LU with row pivoting; the others follow by substitution.
//!
//! With the rows that unit columns take first, B = [U G; 0 C]: U has entries 1 and -1, one in each
//! row and column, C is the *core*, factored by `dense`, and G the *border*. A unit column whose
//! row another one has taken makes B singular, as do dependent columns of the core.
//!
//! Vectors are indexed by *places* (columns of B: the place of a basic unknown) or by *rows*.
//! Called by `basis`.

use super::super::dense::{Lu, dot, subtract};
use super::super::number::PathNumber;
use super::super::tolerance::DEPENDENT;
use super::columns::{PathColumns, SignedUnit};
use super::variable::Variable;

/// A unit column of the basis.
#[derive(Debug, Clone, Copy)]
struct UnitColumn {
    place: usize,
    unit: SignedUnit,
}

/// A column that depends on others, and what may replace it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Repair {
    /// The place of the column.
    pub(super) place: usize,
    /// The row whose unit column is independent of the others.
    pub(super) row: usize,
}

/// B = [unit columns, other columns], ordered by places and rows kept here.
pub(super) struct BasisFactor<T> {
    units: Vec<UnitColumn>,
    /// Places of the other columns.
    places: Vec<usize>,
    /// Rows that no unit column takes.
    rows: Vec<usize>,
    /// The other columns in those rows, C.
    core: Lu<T>,
    /// The other columns in the rows of the unit columns, G by columns.
    border: Vec<T>,
    /// Is the row taken by a unit column?
    taken: Vec<bool>,
    repairs: Vec<Repair>,
}

impl<T> Default for BasisFactor<T> {
    fn default() -> Self {
        BasisFactor {
            units: Vec::new(),
            places: Vec::new(),
            rows: Vec::new(),
            core: Lu::default(),
            border: Vec::new(),
            taken: Vec::new(),
            repairs: Vec::new(),
        }
    }
}

impl<T: PathNumber> BasisFactor<T> {
    /// Factors the basis of these unknowns; false if it is numerically singular.
    pub(super) fn factor(&mut self, columns: &PathColumns<'_, T>, variables: &[Variable]) -> bool {
        self.part_columns(columns, variables);
        if self.rows.len() != self.places.len() {
            // Two unit columns share a row.
            return false;
        }

        if !self.factor_core(columns, variables) {
            self.list_repairs();
            return false;
        }

        self.border.clear();
        for &place in &self.places {
            let column = columns.dense(variables[place]);
            let entries = self.units.iter().map(|u| column[u.unit.row].clone());
            self.border.extend(entries);
        }
        true
    }

    /// Tells unit columns from the others, and lists the rows that no unit column takes.
    fn part_columns(&mut self, columns: &PathColumns<'_, T>, variables: &[Variable]) {
        self.units.clear();
        self.places.clear();
        self.repairs.clear();
        self.taken.clear();
        self.taken.resize(variables.len(), false);

        for (place, &variable) in variables.iter().enumerate() {
            match columns.unit(variable) {
                Some(unit) => {
                    self.units.push(UnitColumn { place, unit });
                    self.taken[unit.row] = true;
                }
                None => self.places.push(place),
            }
        }

        self.rows.clear();
        for (row, is_taken) in self.taken.iter().enumerate() {
            if !is_taken {
                self.rows.push(row);
            }
        }
    }

    /// Factors C; false if columns of it are dependent.
    fn factor_core(&mut self, columns: &PathColumns<'_, T>, variables: &[Variable]) -> bool {
        let places = &self.places;
        let rows = &self.rows;

        self.core.factor(
            places.len(),
            |j, order, out| {
                let column = columns.dense(variables[places[j]]);
                for (&row, entry) in order.iter().zip(out) {
                    *entry = column[rows[row]].clone();
                }
            },
            |j| T::tolerance(DEPENDENT) * columns.size(variables[places[j]]),
        )
    }

    /// Pairs each dependent column of the core with a row that no column has taken.
    fn list_repairs(&mut self) {
        let (dependent, rows_left) = self.core.dependent();
        for (&j, &row) in dependent.iter().zip(rows_left) {
            self.repairs.push(Repair {
                place: self.places[j],
                row: self.rows[row],
            });
        }
    }

    /// After a failure: places whose columns depend on others, each with a row whose unit column
    /// may replace it.
    pub(super) fn repairs(&self) -> &[Repair] {
        &self.repairs
    }

    /// x by places with B x = a, a by rows.
    pub(super) fn solve(&self, a: &[T], x: &mut [T], work: &mut Vec<T>) {
        // C x_C = a_C.
        work.clear();
        let core_rows = self.core.rows().iter();
        work.extend(core_rows.map(|&row| a[self.rows[row]].clone()));
        self.core.solve(work);

        // U x_U = a_U - G x_C.
        work.extend(self.units.iter().map(|u| a[u.unit.row].clone()));
        let (of_core, of_units) = work.split_at_mut(self.places.len());

        if !self.units.is_empty() {
            let border = self.border.chunks_exact(self.units.len());
            for (column, x) in border.zip(of_core.iter()) {
                subtract(of_units, x, column);
            }
        }

        for (&place, value) in self.places.iter().zip(of_core.iter()) {
            x[place] = value.clone();
        }

        for (column, value) in self.units.iter().zip(of_units.iter()) {
            x[column.place] = column.unit.times(value);
        }
    }

    /// y by rows with B' y = e, e by places.
    pub(super) fn solve_transposed(&self, e: &[T], y: &mut [T], work: &mut Vec<T>) {
        // U' y_U = e_U.
        work.clear();
        work.extend(self.units.iter().map(|u| u.unit.times(&e[u.place])));

        // C' y_C = e_C - G' y_U.
        let units = self.units.len();

        for (k, &place) in self.places.iter().enumerate() {
            let border = &self.border[k * units..(k + 1) * units];
            let rest = dot(border, &work[..units]);
            work.push(e[place].clone() - rest);
        }

        let (of_units, of_core) = work.split_at_mut(units);
        self.core.solve_transposed(of_core);

        for (column, value) in self.units.iter().zip(of_units.iter()) {
            y[column.unit.row] = value.clone();
        }

        for (&row, value) in self.core.rows().iter().zip(of_core.iter()) {
            y[self.rows[row]] = value.clone();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Subproblem;
    use super::super::columns::PathFrame;
    use super::*;
    use nalgebra::dmatrix;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn solves_a_basis_of_every_kind_of_column_both_ways() {
        let m = dmatrix![
            2.0, 1.0, 0.5, 3.0;
            1.0, 3.0, 4.0, 1.0;
            0.0, 5.0, 1.0, 2.0;
            1.0, 1.0, 1.0, 7.0
        ];
        let sub = Subproblem {
            m: &m,
            q: &[1.0, -2.0, 3.0, 1.0],
            lower: &[0.0; 4],
            upper: &[9.0; 4],
        };
        let mut frame = PathFrame::default();
        frame.set(&sub, &[1.0, 0.0, 2.0, 0.0], &[0.0; 4]);
        frame.add_artificial(0, 3);
        let columns = frame.columns(&sub);
        let variables = [
            Variable::Z(1),
            Variable::Artificial(0),
            Variable::W(2),
            Variable::T,
        ];
        let mut factor = BasisFactor::default();

        assert!(factor.factor(&columns, &variables));

        let a = [1.0, 2.0, 3.0, 4.0];
        let mut x = [0.0; 4];
        let mut y = [0.0; 4];
        let mut work = Vec::new();
        factor.solve(&a, &mut x, &mut work);
        factor.solve_transposed(&a, &mut y, &mut work);
        let mut column = Vec::new();
        let mut ahead = [0.0; 4];
        let mut worst = 0.0f64;

        for (place, variable) in variables.iter().enumerate() {
            columns.write(*variable, &mut column);
            for row in 0..4 {
                ahead[row] += column[row] * x[place];
            }
            worst = worst.max((dot(&column, &y) - a[place]).abs());
        }

        assert!(
            ahead.iter().zip(&a).all(|(p, q)| (p - q).abs() < 1e-13),
            "{ahead:?}"
        );
        assert!(worst < 1e-13);
    }

    #[test]
    fn dependent_places_are_repaired_and_two_units_of_a_row_refused() {
        let m = dmatrix![1.0, 1.0; 1.0, 1.0];
        let sub = Subproblem {
            m: &m,
            q: &[0.0; 2],
            lower: &[-INF; 2],
            upper: &[INF; 2],
        };
        let mut frame = PathFrame::default();
        frame.set(&sub, &[0.0; 2], &[0.0; 2]);
        let mut factor = BasisFactor::default();

        assert!(!factor.factor(&frame.columns(&sub), &[Variable::Z(0), Variable::Z(1)]));
        assert_eq!(factor.repairs(), [Repair { place: 1, row: 1 }]);
        assert!(!factor.factor(&frame.columns(&sub), &[Variable::W(0), Variable::V(0)]));
        assert!(factor.repairs().is_empty());
        assert!(factor.factor(&frame.columns(&sub), &[Variable::V(1), Variable::W(0)]));
    }
}
