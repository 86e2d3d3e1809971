//! Has the problem of one step exactly one solution?
//!
//! A step is the linear complementarity problem 0 <= v _|_ C v + c >= 0 in the slip velocities v.
//! It has exactly one solution for every c if and only if C is a P-matrix: all its principal minors
//! are positive (Cottle, Pang and Stone 1992, theorem 3.3.7). For small steps C is the mass matrix
//! M* with the free coordinates eliminated. Where M does not couple T and N it is definite; a full
//! M may have other minors: then friction admits several accelerations, or none (Painlevé).
//!
//! The minors are tested by the recursion of Tsatsomeros and Li: C is a P-matrix if and only if
//! c_11 > 0 and both C without its first row and column and the Schur complement C / c_11 are.

use super::tolerance::MINOR;
use nalgebra::DMatrix;

/// How many solutions the problem of a step may have.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepSolutions {
    /// One, whatever the state.
    One,
    /// Several or none for some states.
    Several {
        /// Slip coordinates whose principal minor is not positive.
        minor: Vec<usize>,
    },
    /// Not decided: a minor that is zero in doubles, or too many of them.
    NotDecided,
}

/// Slip coordinates up to which all 2^n minors are tested.
const MINORS_UP_TO: usize = 20;

/// Is the matrix a P-matrix? `sizes` are those of the terms that each diagonal entry is the sum of.
pub(crate) fn step_solutions(matrix: &DMatrix<f64>, sizes: &[f64]) -> StepSolutions {
    let n = matrix.nrows();
    for (i, size) in sizes.iter().enumerate() {
        let rounding = MINOR * size;
        if matrix[(i, i)] < -rounding {
            return StepSolutions::Several { minor: vec![i] };
        }
        if matrix[(i, i)] <= rounding {
            return StepSolutions::NotDecided;
        }
    }

    // Signs of minors do not change under D C D with a positive diagonal D.
    let scaled = DMatrix::from_fn(n, n, |i, j| {
        matrix[(i, j)] / (matrix[(i, i)] * matrix[(j, j)]).sqrt()
    });
    let symmetric_part = (&scaled + scaled.transpose()) / 2.0;
    let raised = symmetric_part - DMatrix::identity(n, n) * MINOR;
    let is_definite = raised.cholesky().is_some();
    if is_definite {
        return StepSolutions::One;
    }

    if n > MINORS_UP_TO {
        return StepSolutions::NotDecided;
    }

    let all: Vec<usize> = (0..n).collect();
    minors(&scaled, &all, &[])
}

/// The recursion: `matrix` is a Schur complement over the coordinates `rest`, by the pivots of
/// `chosen`, which are positive.
fn minors(matrix: &DMatrix<f64>, rest: &[usize], chosen: &[usize]) -> StepSolutions {
    let Some((first, others)) = rest.split_first() else {
        return StepSolutions::One;
    };
    let mut with_first = chosen.to_vec();
    with_first.push(*first);

    let pivot = matrix[(0, 0)];
    if pivot < -MINOR {
        return StepSolutions::Several { minor: with_first };
    }
    if pivot <= MINOR {
        return StepSolutions::NotDecided;
    }

    let m = others.len();
    let without = matrix.view((1, 1), (m, m)).into_owned();
    let column = matrix.view((1, 0), (m, 1));
    let row = matrix.view((0, 1), (1, m));
    let complement = &without - column * row / pivot;

    match minors(&without, others, chosen) {
        StepSolutions::One => minors(&complement, others, &with_first),
        found => found,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn step_solutions(matrix: &DMatrix<f64>) -> StepSolutions {
        let sizes: Vec<f64> = matrix.diagonal().iter().map(|v| v.abs()).collect();
        super::step_solutions(matrix, &sizes)
    }

    #[test]
    fn p_matrices_need_not_be_definite() {
        // Minors 1, 1 and 1 + 12; its symmetric part has the determinant 1 - 1.
        assert_eq!(
            step_solutions(&dmatrix![1.0, -3.0; 4.0, 1.0]),
            StepSolutions::One
        );
        assert_eq!(
            step_solutions(&dmatrix![1.0, -30.0; 4.0, 1.0]),
            StepSolutions::One
        );
    }

    #[test]
    fn a_minor_that_is_not_positive_is_named() {
        let last_pair = dmatrix![1.0, 0.0, 0.0; 0.0, 1.0, 2.0; 0.0, 3.0, 1.0];
        let expected = StepSolutions::Several { minor: vec![1, 2] };
        assert_eq!(step_solutions(&last_pair), expected);

        let diagonal = dmatrix![1.0, 0.0; 0.0, -1.0];
        let expected = StepSolutions::Several { minor: vec![1] };
        assert_eq!(step_solutions(&diagonal), expected);
    }

    #[test]
    fn a_minor_that_is_zero_is_left_undecided() {
        assert_eq!(
            step_solutions(&dmatrix![1.0, 1.0; 1.0, 1.0]),
            StepSolutions::NotDecided
        );
    }

    /// 1 - 1, of which rounding has left something.
    #[test]
    fn a_diagonal_entry_that_is_rounding_is_left_undecided() {
        let rounding = dmatrix![1e-17];
        assert_eq!(
            super::step_solutions(&rounding, &[2.0]),
            StepSolutions::NotDecided
        );
        assert_eq!(
            super::step_solutions(&rounding, &[1e-17]),
            StepSolutions::One
        );
    }
}
