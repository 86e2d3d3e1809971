//! Factors of a basis matrix. Most of its columns are unit vectors: only the rows that none of them
//! takes are eliminated, by LU with row pivoting; the others follow by substitution.

use super::super::dense::{Lu, dot, subtract};
use super::super::number::Number;
use super::super::tolerance::DEPENDENT;
use super::columns::Columns;
use super::variable::Variable;

/// B = [unit columns, other columns], ordered by places and rows kept here.
pub(super) struct Factor<T> {
    /// Place, row and sign of each unit column.
    units: Vec<(usize, usize, bool)>,
    /// Places of the other columns.
    places: Vec<usize>,
    /// Rows that no unit column takes.
    rows: Vec<usize>,
    /// The other columns in those rows.
    core: Lu<T>,
    /// The other columns in the rows of the unit columns, by columns.
    border: Vec<T>,
    taken: Vec<bool>,
    repairs: Vec<(usize, usize)>,
}

impl<T> Default for Factor<T> {
    fn default() -> Self {
        Factor {
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

impl<T: Number> Factor<T> {
    /// Factors the basis of these unknowns; false if it is numerically singular.
    pub(super) fn factor(&mut self, columns: &Columns<'_, T>, variables: &[Variable]) -> bool {
        let (places, rows) = (&mut self.places, &mut self.rows);
        self.units.clear();
        places.clear();
        self.repairs.clear();
        self.taken.clear();
        self.taken.resize(variables.len(), false);
        for (place, &variable) in variables.iter().enumerate() {
            match columns.unit(variable) {
                Some((row, positive)) => {
                    self.units.push((place, row, positive));
                    self.taken[row] = true;
                }
                None => places.push(place),
            }
        }
        rows.clear();
        rows.extend((0..variables.len()).filter(|&row| !self.taken[row]));
        if rows.len() != places.len() {
            return false; // two unit columns of one row
        }
        let gather = |j: usize, order: &[usize], out: &mut [T]| {
            let column = columns.dense(variables[places[j]]);
            out.iter_mut()
                .zip(order)
                .for_each(|(o, &r)| *o = column[rows[r]].clone());
        };
        let least = |j: usize| T::tolerance(DEPENDENT) * columns.size(variables[places[j]]);
        if !self.core.factor(places.len(), gather, least) {
            let (dependent, left) = self.core.dependent();
            self.repairs.extend(
                dependent
                    .iter()
                    .zip(left)
                    .map(|(&j, &r)| (places[j], rows[r])),
            );
            return false;
        }
        self.border.clear();
        for &place in places.iter() {
            let column = columns.dense(variables[place]);
            self.border
                .extend(self.units.iter().map(|&(_, row, _)| column[row].clone()));
        }
        true
    }

    /// After a failure: places whose columns depend on others, each with a row whose unit column
    /// may replace it.
    pub(super) fn repairs(&self) -> &[(usize, usize)] {
        &self.repairs
    }

    /// x by places with B x = a, a by rows.
    pub(super) fn solve(&self, a: &[T], x: &mut [T], work: &mut Vec<T>) {
        work.clear();
        work.extend(self.core.rows().iter().map(|&r| a[self.rows[r]].clone()));
        self.core.solve(work);
        work.extend(self.units.iter().map(|&(_, row, _)| a[row].clone()));
        let (inner, outer) = work.split_at_mut(self.places.len());
        if !self.units.is_empty() {
            self.border
                .chunks_exact(self.units.len())
                .zip(inner.iter())
                .for_each(|(column, x)| subtract(outer, x, column));
        }
        self.places
            .iter()
            .zip(inner.iter())
            .for_each(|(&place, value)| x[place] = value.clone());
        for (&(place, _, positive), value) in self.units.iter().zip(outer.iter()) {
            x[place] = if positive {
                value.clone()
            } else {
                -value.clone()
            };
        }
    }

    /// y by rows with B' y = e, e by places.
    pub(super) fn solve_transposed(&self, e: &[T], y: &mut [T], work: &mut Vec<T>) {
        work.clear();
        work.extend(self.units.iter().map(|&(place, _, positive)| {
            if positive {
                e[place].clone()
            } else {
                -e[place].clone()
            }
        }));
        let units = work.len();
        for (k, &place) in self.places.iter().enumerate() {
            let rest = dot(&self.border[k * units..(k + 1) * units], &work[..units]);
            work.push(e[place].clone() - rest);
        }
        let (outer, inner) = work.split_at_mut(units);
        self.core.solve_transposed(inner);
        self.units
            .iter()
            .zip(outer.iter())
            .for_each(|(&(_, row, _), value)| y[row] = value.clone());
        self.core
            .rows()
            .iter()
            .zip(inner.iter())
            .for_each(|(&r, value)| y[self.rows[r]] = value.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::super::Subproblem;
    use super::super::columns::Frame;
    use super::*;
    use nalgebra::dmatrix;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn solves_a_basis_of_every_kind_of_column_both_ways() {
        let m = dmatrix![2.0, 1.0, 0.5, 3.0; 1.0, 3.0, 4.0, 1.0; 0.0, 5.0, 1.0, 2.0; 1.0, 1.0, 1.0, 7.0];
        let sub = Subproblem {
            m: &m,
            q: &[1.0, -2.0, 3.0, 1.0],
            lower: &[0.0; 4],
            upper: &[9.0; 4],
        };
        let mut frame = Frame::default();
        frame.set(&sub, &[1.0, 0.0, 2.0, 0.0], &[0.0; 4]);
        frame.add_artificial(0, 3);
        let columns = frame.columns(&sub);
        let variables = [
            Variable::Z(1),
            Variable::Artificial(0),
            Variable::W(2),
            Variable::T,
        ];
        let mut factor = Factor::default();
        assert!(factor.factor(&columns, &variables));
        let (a, mut x, mut y, mut work) = ([1.0, 2.0, 3.0, 4.0], [0.0; 4], [0.0; 4], Vec::new());
        factor.solve(&a, &mut x, &mut work);
        factor.solve_transposed(&a, &mut y, &mut work);
        let mut column = Vec::new();
        let (mut ahead, mut worst) = ([0.0; 4], 0.0f64);
        for (place, variable) in variables.iter().enumerate() {
            columns.write(*variable, &mut column);
            (0..4).for_each(|row| ahead[row] += column[row] * x[place]);
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
        let mut frame = Frame::default();
        frame.set(&sub, &[0.0; 2], &[0.0; 2]);
        let mut factor = Factor::default();
        assert!(!factor.factor(&frame.columns(&sub), &[Variable::Z(0), Variable::Z(1)]));
        assert_eq!(factor.repairs(), [(1, 1)]);
        assert!(!factor.factor(&frame.columns(&sub), &[Variable::W(0), Variable::V(0)]));
        assert!(factor.repairs().is_empty());
        assert!(factor.factor(&frame.columns(&sub), &[Variable::V(1), Variable::W(0)]));
    }
}
