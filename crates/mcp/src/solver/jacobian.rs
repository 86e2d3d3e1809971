//! F' at a point, as the problem gives it: a dense matrix, or the entries of a sparse one.
//!
//! The crashes, the gradient and the residuals work with either ([`JacobianMatrix`]); paths and
//! curves need the dense matrix. A callback of [`Mcp::jacobian`] is given an n x n matrix and may,
//! by mistake, resize it; one of [`Mcp::entries`] may name a place beyond it. What is then left out
//! becomes NaN, so that residuals computed from it are NaN and not wrong.

use crate::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// F' at a point.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum JacobianMatrix {
    /// All entries.
    Dense(DMatrix<f64>),
    /// Those that the problem has named.
    Sparse(SparseColumns),
}

/// A sparse matrix by columns, rows ascending in each.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SparseColumns {
    /// Where each column begins among the entries, and the number of all at the end.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl SparseColumns {
    /// The square matrix of these entries, row and column below the order; those of one place add
    /// up. Else the rows and columns that a matrix with all of them would have.
    pub(super) fn new(
        order: usize,
        entries: &mut [(usize, usize, f64)],
    ) -> Result<SparseColumns, (usize, usize)> {
        let mut shape = (order, order);
        for &(row, col, _) in entries.iter() {
            shape.0 = shape.0.max(row.saturating_add(1));
            shape.1 = shape.1.max(col.saturating_add(1));
        }
        if shape != (order, order) {
            return Err(shape);
        }

        // A stable sort: entries of one place are added in the order in which they were given.
        entries.sort_by_key(|&(row, col, _)| (col, row));

        let mut matrix = SparseColumns {
            starts: Vec::with_capacity(order + 1),
            rows: Vec::with_capacity(entries.len()),
            values: Vec::with_capacity(entries.len()),
        };
        let mut rest = entries.iter().peekable();
        for column in 0..order {
            let start = matrix.rows.len();
            matrix.starts.push(start);

            while let Some(&(row, _, value)) = rest.next_if(|entry| entry.1 == column) {
                let is_repeated = matrix.rows.len() > start
                    && matrix.rows.last().is_some_and(|&last| last == row);
                match matrix.values.last_mut() {
                    Some(sum) if is_repeated => *sum += value,
                    _ => {
                        matrix.rows.push(row);
                        matrix.values.push(value);
                    }
                }
            }
        }

        matrix.starts.push(matrix.rows.len());
        Ok(matrix)
    }

    /// The entries of a column: row and value, rows ascending.
    pub(super) fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[j]..self.starts[j + 1];
        let values = &self.values[range.clone()];
        self.rows[range].iter().copied().zip(values.iter().copied())
    }

    /// The matrix with all its entries.
    fn dense(&self) -> DMatrix<f64> {
        let order = self.starts.len() - 1;
        let mut dense = DMatrix::zeros(order, order);
        for col in 0..order {
            for (row, value) in self.column(col) {
                dense[(row, col)] = value;
            }
        }
        dense
    }
}

impl From<DMatrix<f64>> for JacobianMatrix {
    fn from(matrix: DMatrix<f64>) -> JacobianMatrix {
        JacobianMatrix::Dense(matrix)
    }
}

impl JacobianMatrix {
    /// The matrix with all its entries.
    pub(super) fn into_dense(self) -> DMatrix<f64> {
        match self {
            JacobianMatrix::Dense(matrix) => matrix,
            JacobianMatrix::Sparse(matrix) => matrix.dense(),
        }
    }

    /// The largest magnitude of an entry.
    pub(super) fn largest(&self) -> f64 {
        match self {
            JacobianMatrix::Dense(matrix) => matrix.amax(),
            JacobianMatrix::Sparse(matrix) => {
                matrix.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
            }
        }
    }

    /// Column j times a vector of length n.
    pub(super) fn column_times(&self, j: usize, vector: &DVector<f64>) -> f64 {
        match self {
            JacobianMatrix::Dense(matrix) => matrix.column(j).dot(vector),
            JacobianMatrix::Sparse(matrix) => {
                matrix.column(j).map(|(row, v)| v * vector[row]).sum()
            }
        }
    }

    /// Adds `factor` times the rows `inside`, ascending, of column j to `sums`, by places.
    pub(super) fn add_column(&self, j: usize, factor: f64, inside: &[usize], sums: &mut [f64]) {
        match self {
            JacobianMatrix::Dense(matrix) => {
                let column = matrix.column(j);
                for (&i, sum) in inside.iter().zip(sums) {
                    *sum += column[i] * factor;
                }
            }
            JacobianMatrix::Sparse(matrix) => {
                for (row, value) in matrix.column(j) {
                    if let Ok(place) = inside.binary_search(&row) {
                        sums[place] += value * factor;
                    }
                }
            }
        }
    }

    /// Row and column of the first entry that is not finite: row by row of a dense matrix, column
    /// by column of a sparse one.
    pub(super) fn first_not_finite(&self) -> Option<(usize, usize)> {
        match self {
            JacobianMatrix::Dense(matrix) => {
                if is_finite(matrix.as_slice()) {
                    return None;
                }
                let places = (0..matrix.nrows())
                    .flat_map(|row| (0..matrix.ncols()).map(move |col| (row, col)));
                places.into_iter().find(|&place| !matrix[place].is_finite())
            }
            JacobianMatrix::Sparse(matrix) => {
                let entry = matrix.values.iter().position(|value| !value.is_finite())?;
                let col = matrix.starts.partition_point(|&start| start <= entry) - 1;
                Some((matrix.rows[entry], col))
            }
        }
    }
}

/// Are all of them finite? All are looked at, which needs no branch for each.
fn is_finite(values: &[f64]) -> bool {
    let mut is_finite = true;
    for value in values {
        is_finite &= value.is_finite();
    }
    is_finite
}

/// F' at z, dense, n x n even if the callback has resized it: what it left out is NaN.
pub(super) fn jacobian_at<P: Mcp + ?Sized>(problem: &P, z: &[f64]) -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(z.len(), z.len());
    problem.jacobian(z, &mut jacobian);
    square(jacobian, z.len())
}

/// The matrix as one of n x n: entries beyond are dropped, missing ones are NaN.
pub(super) fn square(matrix: DMatrix<f64>, n: usize) -> DMatrix<f64> {
    if matrix.shape() == (n, n) {
        return matrix;
    }

    matrix.resize(n, n, f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// [0 7 0; 2 0 0; 0 -9 1], with one entry in two parts.
    fn sparse() -> JacobianMatrix {
        let mut entries = [
            (2, 1, -9.0),
            (1, 0, 0.5),
            (0, 1, 7.0),
            (2, 2, 1.0),
            (1, 0, 1.5),
        ];
        JacobianMatrix::Sparse(SparseColumns::new(3, &mut entries).unwrap())
    }

    #[test]
    fn both_forms_answer_alike() {
        let sparse = sparse();
        let dense = JacobianMatrix::from(sparse.clone().into_dense());
        let matrix = dmatrix![0.0, 7.0, 0.0; 2.0, 0.0, 0.0; 0.0, -9.0, 1.0];
        assert_eq!(dense, JacobianMatrix::Dense(matrix));

        let vector = dvector![1.0, 10.0, 100.0];
        for form in [&sparse, &dense] {
            assert_eq!(form.largest(), 9.0);
            assert_eq!(form.first_not_finite(), None);
            assert_eq!(form.column_times(0, &vector), 20.0);
            assert_eq!(form.column_times(1, &vector), -893.0);

            let mut sums = [1.0, 1.0];
            form.add_column(1, 2.0, &[0, 2], &mut sums);
            assert_eq!(sums, [15.0, -17.0]);
        }
    }

    #[test]
    fn what_is_not_finite_is_found_in_both_forms() {
        let mut entries = [(0, 0, 1.0), (1, 2, f64::NAN), (2, 2, 1.0)];
        let sparse = JacobianMatrix::Sparse(SparseColumns::new(3, &mut entries).unwrap());
        assert_eq!(sparse.first_not_finite(), Some((1, 2)));

        let dense = JacobianMatrix::from(sparse.into_dense());
        assert_eq!(dense.first_not_finite(), Some((1, 2)));
    }

    #[test]
    fn entries_beyond_the_order_are_refused() {
        let shape = |row, col| SparseColumns::new(2, &mut [(0, 0, 1.0), (row, col, 1.0)]).err();
        assert_eq!(shape(1, 1), None);
        assert_eq!(shape(2, 0), Some((3, 2)));
        assert_eq!(shape(0, usize::MAX), Some((2, usize::MAX)));
        assert_eq!(
            SparseColumns::new(0, &mut []).unwrap().dense().shape(),
            (0, 0)
        );
    }
}
