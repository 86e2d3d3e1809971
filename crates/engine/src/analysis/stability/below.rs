//! A definite matrix below a given one, entry by entry, in doubles.
//!
//! x'Lx >= x'Px for x >= 0 where P <= L, so L is strictly copositive if such a P is definite; for
//! an order up to four every strictly copositive L has such a P. It is looked for by projections in
//! turn (Dykstra 1983): onto the matrices with eigenvalues above a small number, and onto those
//! below L.
//!
//! Rows and columns are scaled so that the diagonal of L is 1.

use crate::dense::UpperTriangle;
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::tolerance::{LEAST_EIGENVALUE, LEAST_PIVOT};
use nalgebra::DMatrix;

/// Projections at most, and what their eigenvalues may cost: orders cubed.
const MOST_STEPS: usize = 2_000;
const WORK: usize = 40_000_000;
/// Steps between tests.
const TESTED_EVERY: usize = 10;

/// Has the matrix pivots that rounding does not explain?
pub(super) fn is_definite(matrix: &SquareMatrix) -> bool {
    match scales_of(matrix) {
        None => false,
        Some(scales) => {
            let entry = |i: usize, j: usize| scales[i] * matrix[i][j] * scales[j];
            UpperTriangle::new(matrix.len(), entry).has_pivots_above(LEAST_PIVOT)
        }
    }
}

/// What makes the diagonal 1; `None` where it is not positive.
fn scales_of(matrix: &SquareMatrix) -> Option<Vec<f64>> {
    let scale = |i: usize| (matrix[i][i] > 0.0).then(|| 1.0 / matrix[i][i].sqrt());
    (0..matrix.len()).map(scale).collect()
}

/// A definite matrix at most `limit`, if one is found.
pub(super) fn definite_below(limit: &SquareMatrix) -> Option<SquareMatrix> {
    if is_definite(limit) {
        return Some(limit.clone());
    }

    let order = limit.len();
    let scales = scales_of(limit)?;
    let scaled = DMatrix::from_fn(order, order, |i, j| scales[i] * limit[i][j] * scales[j]);

    let mut below = scaled.clone();
    let mut of_cone = DMatrix::zeros(order, order);
    let mut of_limit = DMatrix::zeros(order, order);
    for step in 1..=steps_for(order) {
        let moved = &below + &of_cone;
        let definite = with_eigenvalues_above(&moved);
        of_cone = moved - &definite;

        let moved = definite + &of_limit;
        below = moved.zip_map(&scaled, f64::min);
        of_limit = moved - &below;

        if step % TESTED_EVERY == 0 {
            let unscaled = |i: usize, j: usize| below[(i, j)] / (scales[i] * scales[j]);
            let row = |i: usize| {
                (0..order)
                    .map(|j| unscaled(i, j).min(limit[i][j]))
                    .collect()
            };
            let found: SquareMatrix = (0..order).map(row).collect();
            if is_definite(&found) {
                return Some(found);
            }
        }
    }

    None
}

fn steps_for(order: usize) -> usize {
    (WORK / order.pow(3)).min(MOST_STEPS)
}

/// The nearest symmetric matrix with eigenvalues of at least [`LEAST_EIGENVALUE`].
fn with_eigenvalues_above(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut eigen = matrix.clone().symmetric_eigen();
    eigen.eigenvalues.apply(|v| *v = v.max(LEAST_EIGENVALUE));
    eigen.recompose()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_below(found: &SquareMatrix, limit: &SquareMatrix) -> bool {
        let rows = found.iter().zip(limit);
        rows.flat_map(|(p, l)| p.iter().zip(l)).all(|(p, l)| p <= l)
    }

    /// [[1, 3], [3, 1]] is strictly copositive and not definite; with -1.1 it is not copositive.
    #[test]
    fn copositive_matrices_have_a_definite_one_below() {
        let indefinite = vec![vec![1.0, 3.0], vec![3.0, 1.0]];
        assert!(!is_definite(&indefinite));
        let found = definite_below(&indefinite).unwrap();
        assert!(is_definite(&found) && is_below(&found, &indefinite));

        let not_copositive = vec![vec![1.0, -1.1], vec![-1.1, 1.0]];
        assert_eq!(definite_below(&not_copositive), None);
        assert_eq!(definite_below(&vec![vec![-1.0]]), None);
    }

    /// A definite matrix is its own answer.
    #[test]
    fn a_definite_matrix_stays() {
        let definite = vec![vec![2.0, -1.0], vec![-1.0, 2.0]];
        assert_eq!(definite_below(&definite), Some(definite));
    }
}
