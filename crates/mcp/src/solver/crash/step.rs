//! One step of a crash: the linear system over the components inside, and the way back along the
//! projected arc until the merit falls. Used by both kinds of crash.

use super::super::dense::Lu;
use super::super::evaluation::{Evaluated, Point};
use super::super::jacobian::{JacobianMatrix, SparseColumns};
use super::super::tolerance::{ARMIJO, BACKTRACK};
use crate::linear::SparseLu;
use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// The system (F'_II + D) d = -g over the components I that do not go to a bound.
pub(super) struct InsideSystem<'a, D, G> {
    /// F', n x n.
    pub(super) jacobian: &'a JacobianMatrix,
    /// The components I, ascending.
    pub(super) inside: &'a [usize],
    /// The diagonal of D, by places in I.
    pub(super) diagonal: D,
    /// The vector g, by places in I.
    pub(super) residual: G,
}

impl<D: Fn(usize) -> f64, G: Fn(usize) -> f64> InsideSystem<'_, D, G> {
    /// Solves the system into `step`, by places in I; says if there is a finite solution. A dense
    /// matrix is factored in `lu`.
    pub(super) fn solve(&self, lu: &mut Lu<f64>, step: &mut Vec<f64>) -> bool {
        let is_regular = match self.jacobian {
            JacobianMatrix::Dense(matrix) => self.solve_dense(matrix, lu, step),
            JacobianMatrix::Sparse(matrix) => self.solve_sparse(matrix, step),
        };

        is_regular && step.iter().all(|value| value.is_finite())
    }

    /// By dense factors; false where a pivot is zero.
    fn solve_dense(&self, matrix: &DMatrix<f64>, lu: &mut Lu<f64>, step: &mut Vec<f64>) -> bool {
        let order = self.inside.len();
        let gather = |j: usize, rows: &[usize], out: &mut [f64]| {
            let column = matrix.column(self.inside[j]);
            for (&row, entry) in rows.iter().zip(out) {
                let added = if row == j { (self.diagonal)(j) } else { 0.0 };
                *entry = column[self.inside[row]] + added;
            }
        };
        if !lu.factor(order, gather, |_| 0.0) {
            return false;
        }

        step.clear();
        step.extend(lu.rows().iter().map(|&row| -(self.residual)(row)));
        lu.solve(step);
        true
    }

    /// By sparse factors, which are made anew; false where elimination finds no pivot.
    fn solve_sparse(&self, matrix: &SparseColumns, step: &mut Vec<f64>) -> bool {
        let mut entries = Vec::new();
        for (col, &j) in self.inside.iter().enumerate() {
            let diagonal = (self.diagonal)(col);
            if diagonal != 0.0 {
                entries.push((col, col, diagonal));
            }

            for (i, value) in matrix.column(j) {
                if let Ok(row) = self.inside.binary_search(&i) {
                    entries.push((row, col, value));
                }
            }
        }

        let order = self.inside.len();
        let Some(factors) = SparseLu::new(order, entries) else {
            return false;
        };
        step.clear();
        step.extend((0..order).map(|row| -(self.residual)(row)));
        factors.solve(std::slice::from_mut(step));
        true
    }
}

/// Back along the projected arc pi(z + a d), from a = 1 to no less than `smallest`, until the merit
/// falls by Armijo's rule; with the length a of the step.
pub(super) fn search<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    point: &Point,
    direction: &[f64],
    smallest: f64,
) -> Option<(Point, f64)> {
    let mut step = 1.0;
    while step >= smallest {
        let next = problem.point_with(|i| point.z[i] + direction[i] * step);
        let keeps_promise = next.merit <= (1.0 - ARMIJO * step) * point.merit;
        if keeps_promise && next.merit < point.merit {
            return Some((next, step));
        }

        problem.recycle(next);
        step *= BACKTRACK;
    }
    None
}
