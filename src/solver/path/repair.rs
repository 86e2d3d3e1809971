//! Repair of a singular starting basis: dependent columns give way to unit columns of artificials.

use super::super::tolerance::DEPENDENT;
use super::number::{Number, largest};
use nalgebra::DMatrix;

/// The places whose columns depend on others, each with the row whose unit column replaces it.
///
/// Gaussian elimination with row pivoting, unit-like columns first as the caller orders them by
/// `priority` (places in the order in which they are tried; later ones are found dependent).
pub(super) fn dependent_places<T: Number>(basis: &DMatrix<T>, priority: &[usize]) -> Vec<(usize, usize)> {
    let n = basis.nrows();
    let mut work = basis.clone();
    let mut pivoted = vec![false; n];
    let mut dependent = Vec::new();
    for &place in priority {
        let size = largest(basis.column(place).iter());
        let best = (0..n).filter(|&row| !pivoted[row]).max_by(|&a, &b| work[(a, place)].magnitude().order(&work[(b, place)].magnitude()));
        match best {
            Some(row) if work[(row, place)].magnitude() > T::tolerance(DEPENDENT) * size => {
                pivoted[row] = true;
                eliminate(&mut work, row, place, &pivoted);
            }
            _ => dependent.push(place),
        }
    }
    let free_rows = (0..n).filter(|&row| !pivoted[row]);
    dependent.into_iter().zip(free_rows).collect()
}

/// Clears the column below the pivot in the rows not pivoted yet.
fn eliminate<T: Number>(work: &mut DMatrix<T>, row: usize, place: usize, pivoted: &[bool]) {
    for other in (0..work.nrows()).filter(|&k| !pivoted[k]) {
        let factor = work[(other, place)].clone() / work[(row, place)].clone();
        if !factor.is_zero() {
            for column in 0..work.ncols() {
                let entry = work[(row, column)].clone();
                work[(other, column)] -= factor.clone() * entry;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    #[test]
    fn regular_bases_need_nothing_and_zero_ones_everything() {
        assert!(dependent_places(&dmatrix![0.0, 2.0; 3.0, 0.0], &[0, 1]).is_empty());
        assert_eq!(dependent_places(&DMatrix::<f64>::zeros(2, 2), &[0, 1]), vec![(0, 0), (1, 1)]);
    }

    #[test]
    fn the_later_of_two_equal_columns_goes() {
        let b = dmatrix![1.0, 0.0, 1.0; 2.0, 1.0, 2.0; 0.0, 0.0, 0.0];
        assert_eq!(dependent_places(&b, &[0, 1, 2]), vec![(2, 2)]);
        assert_eq!(dependent_places(&b, &[2, 1, 0]), vec![(0, 2)]);
    }
}
