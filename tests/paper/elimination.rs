//! Plain elimination in fractions: the truth of the tests of loading paths.
#![cfg(feature = "solver")]

use mceip_exact::Rational;
use num_traits::Zero;

/// Gauss-Jordan elimination of rows with their right side at the end; `None` if singular.
pub(crate) fn solve(mut rows: Vec<Vec<Rational>>) -> Option<Vec<Rational>> {
    let order = rows.len();
    for k in 0..order {
        let pivot = (k..order).find(|&i| !rows[i][k].is_zero())?;
        rows.swap(k, pivot);

        let pivot_row = rows[k].clone();
        for i in (0..order).filter(|&i| i != k) {
            let factor = &rows[i][k] / &pivot_row[k];
            if factor.is_zero() {
                continue;
            }

            for j in k..=order {
                rows[i][j] -= &factor * &pivot_row[j];
            }
        }
    }

    Some((0..order).map(|i| &rows[i][order] / &rows[i][i]).collect())
}
