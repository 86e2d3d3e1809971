//! The columns of M z - w + v + D a - t r = -(q + r): unit columns, those of M, and that of t.
//!
//! A [`PathFrame`] holds what belongs to one path: the column of t, the right-hand side, the rows
//! of the artificials, and the sizes by which rounding is judged. [`PathColumns`] shows it together
//! with the subproblem as one matrix. Read by `factor`, `basis` and `tableau`.

use super::super::number::PathNumber;
use super::subproblem::Subproblem;
use super::variable::Variable;

/// What belongs to one path besides its subproblem. Storage is kept.
pub(super) struct PathFrame<T> {
    /// -r, the column of t: the residual at the start.
    covering: Vec<T>,
    /// -(q + r).
    right: Vec<T>,
    /// Row of the unit column of the artificial of z_i, where there is one.
    artificial_row: Vec<Option<usize>>,
    /// Largest entry of each column of M, then of that of t.
    sizes: Vec<T>,
    /// Largest entry of q and of r, added.
    scale: Option<T>,
}

impl<T> Default for PathFrame<T> {
    fn default() -> Self {
        PathFrame {
            covering: Vec::new(),
            right: Vec::new(),
            artificial_row: Vec::new(),
            sizes: Vec::new(),
            scale: None,
        }
    }
}

/// The columns of one path.
pub(super) struct PathColumns<'a, T: PathNumber> {
    pub(super) sub: &'a Subproblem<'a, T>,
    frame: &'a PathFrame<T>,
}

/// A column with one entry, 1 or -1.
#[derive(Debug, Clone, Copy)]
pub(super) struct SignedUnit {
    pub(super) row: usize,
    /// Is the entry 1?
    pub(super) is_positive: bool,
}

impl SignedUnit {
    /// The entry times a value.
    pub(super) fn times<T: PathNumber>(self, value: &T) -> T {
        if self.is_positive {
            value.clone()
        } else {
            -value.clone()
        }
    }
}

impl<T: PathNumber> PathFrame<T> {
    /// A path of `sub` that begins at (z, multiplier), so that r = multiplier - M z - q; no
    /// artificials.
    pub(super) fn set(&mut self, sub: &Subproblem<'_, T>, z: &[T], multiplier: &[T]) {
        let n = z.len();
        sub.value(z, &mut self.covering);

        for (residual, multiplier) in self.covering.iter_mut().zip(multiplier) {
            *residual -= multiplier.clone();
        }

        self.right.clear();
        for (residual, q) in self.covering.iter().zip(sub.q) {
            self.right.push(residual.clone() - q.clone());
        }

        self.artificial_row.clear();
        self.artificial_row.resize(n, None);

        self.sizes.clear();
        for j in 0..n {
            self.sizes.push(T::largest(sub.column(j)));
        }

        let covering_size = T::largest(&self.covering);
        self.scale = Some(T::largest(sub.q) + covering_size.clone());
        self.sizes.push(covering_size);
    }

    /// Gives z_i an artificial whose column is the unit vector of a row.
    pub(super) fn add_artificial(&mut self, i: usize, row: usize) {
        self.artificial_row[i] = Some(row);
    }

    /// All columns of the path of `sub`.
    pub(super) fn columns<'a>(&'a self, sub: &'a Subproblem<'a, T>) -> PathColumns<'a, T> {
        PathColumns { sub, frame: self }
    }
}

impl<'a, T: PathNumber> PathColumns<'a, T> {
    /// The unit column of a multiplier or an artificial; `None` for z and t.
    pub(super) fn unit(&self, variable: Variable) -> Option<SignedUnit> {
        match variable {
            Variable::W(i) => Some(SignedUnit {
                row: i,
                is_positive: false,
            }),
            Variable::V(i) => Some(SignedUnit {
                row: i,
                is_positive: true,
            }),
            Variable::Artificial(i) => Some(SignedUnit {
                row: self.frame.artificial_row[i].unwrap_or(i),
                is_positive: true,
            }),
            Variable::Z(_) | Variable::T => None,
        }
    }

    /// The column of z_i, or else that of t.
    pub(super) fn dense(&self, variable: Variable) -> &'a [T] {
        match variable {
            Variable::Z(i) => self.sub.column(i),
            _ => &self.frame.covering,
        }
    }

    /// The column of an unknown, into `out`.
    pub(super) fn write(&self, variable: Variable, out: &mut Vec<T>) {
        out.clear();
        match self.unit(variable) {
            None => out.extend_from_slice(self.dense(variable)),
            Some(unit) => {
                out.resize(self.frame.covering.len(), T::zero());
                out[unit.row] = unit.times(&T::one());
            }
        }
    }

    /// The largest entry of a column.
    pub(super) fn size(&self, variable: Variable) -> T {
        match variable {
            Variable::Z(i) => self.frame.sizes[i].clone(),
            Variable::T => self.frame.sizes[self.frame.covering.len()].clone(),
            _ => T::one(),
        }
    }

    /// -(q + r).
    pub(super) fn right(&self) -> &'a [T] {
        &self.frame.right
    }

    /// The size of q and r.
    pub(super) fn scale(&self) -> T {
        self.frame.scale.clone().unwrap_or_else(T::zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// Of M z - w + v + D a - t r = -(q + r), with r = multiplier - M z - q.
    #[test]
    fn columns_are_those_of_the_equation() {
        let m = dmatrix![2.0, -7.0; 1.0, 3.0];
        let sub = Subproblem {
            m: &m,
            q: &[-1.0, 4.0],
            lower: &[0.0; 2],
            upper: &[f64::INFINITY; 2],
        };
        let mut frame = PathFrame::default();
        frame.set(&sub, &[5.0, 1.0], &[6.0, 0.5]);

        // M z + q = (2, 12), so that r = (4, -11.5).
        frame.add_artificial(0, 1);
        let columns = frame.columns(&sub);

        assert_eq!(columns.dense(Variable::T), &[-4.0, 11.5][..]);
        assert_eq!(columns.right(), &[-3.0, 7.5][..]);

        let written = |variable: Variable| {
            let mut out = vec![9.0; 5];
            columns.write(variable, &mut out);
            (out, columns.size(variable))
        };

        assert_eq!(written(Variable::Z(0)), (vec![2.0, 1.0], 2.0));
        assert_eq!(written(Variable::Z(1)), (vec![-7.0, 3.0], 7.0));
        assert_eq!(written(Variable::T), (vec![-4.0, 11.5], 11.5));
        assert_eq!(written(Variable::W(1)), (vec![0.0, -1.0], 1.0));
        assert_eq!(written(Variable::V(1)), (vec![0.0, 1.0], 1.0));

        // An artificial has its row, or else that of its own unknown.
        assert_eq!(written(Variable::Artificial(0)), (vec![0.0, 1.0], 1.0));
        assert_eq!(written(Variable::Artificial(1)), (vec![0.0, 1.0], 1.0));
        assert_eq!(columns.scale(), 4.0 + 11.5);
    }
}
