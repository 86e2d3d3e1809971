//! Evidence that a symmetric part is positive semidefinite where some of its rows are zero.
//!
//! Degrees of freedom without mass make such rows in B. The factor is formed on the other rows,
//! where the matrix has to be positive definite, and is zero on these. Then S - L L' is zero on the
//! rows without mass and diagonally dominant on the others, which the checker sees
//! (`check::cover::psd`). Called for B_ff (`condense`) and for the whole of B (`leaf::tail`).

use super::skyline::Skyline;
use mceip_check::certificate::{Factor, IntegerRow};
use mceip_exact::{Integer, Sparse};

/// A factor of sym(m), which is positive definite on the rows that are not zero; `None` otherwise.
pub(crate) fn factor(m: &Sparse) -> Option<Factor> {
    let kept = rows_with_entries(m);
    let part = Skyline::symmetric(&m.submatrix(&kept, &kept));
    let slack = part.below_spectrum()?;
    let factor = part.shifted(-slack).cholesky()?;
    let rounded = factor.rounded(slack);
    Some(among_zero_rows(&rounded, &kept, m.rows()))
}

fn rows_with_entries(m: &Sparse) -> Vec<usize> {
    let mut has_entry = vec![false; m.rows()];
    for (i, j, _) in m.entries() {
        has_entry[i] = true;
        has_entry[j] = true;
    }

    (0..m.rows()).filter(|&i| has_entry[i]).collect()
}

/// The factor over `order` rows: row p of `part` becomes row kept[p], the other rows are zero.
fn among_zero_rows(part: &Factor, kept: &[usize], order: usize) -> Factor {
    let mut first: Vec<usize> = (0..order).collect();
    let mut rows = vec![vec![Integer::default()]; order];

    for (p, &i) in kept.iter().enumerate() {
        first[i] = kept[part.first[p]];
        rows[i] = vec![Integer::default(); i + 1 - first[i]];
        for (v, &j) in part.rows[p].iter().zip(&kept[part.first[p]..]) {
            rows[i][j - first[i]] = v.into_owned();
        }
    }

    Factor {
        first,
        rows: rows.into_iter().map(IntegerRow::from).collect(),
        exponent: part.exponent,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Dense, Rational, whole};
    use num_traits::Signed;

    /// Entry (i, k) of the lower triangular matrix that a factor stands for.
    fn entry(factor: &Factor, i: usize, k: usize) -> Rational {
        if k < factor.first[i] || k > i {
            return whole(0);
        }

        let unit = Integer::from(1) << factor.exponent;
        Rational::new(factor.rows[i].at(k - factor.first[i]).into_owned(), unit)
    }

    /// Entry (i, j) of S - L L'.
    fn residual(s: &Dense, factor: &Factor, i: usize, j: usize) -> Rational {
        let mut residual = s.row(i)[j].clone();
        for k in 0..s.rows() {
            residual -= entry(factor, i, k) * entry(factor, j, k);
        }

        residual
    }

    /// E = S - L L' is zero on rows without mass and diagonally dominant on the others.
    #[test]
    fn rows_without_mass_stay_zero_and_the_rest_is_dominant() {
        let s = Sparse::from_ints(&[&[0, 0, 0, 0], &[0, 4, 0, 1], &[0, 0, 0, 0], &[0, 1, 0, 3]]);

        let found = factor(&s).unwrap();

        let s = s.to_dense();
        for j in 0..4 {
            assert_eq!(residual(&s, &found, 0, j), whole(0));
            assert_eq!(residual(&s, &found, 2, j), whole(0));
        }

        let beside = residual(&s, &found, 1, 3).abs();
        assert!(residual(&s, &found, 1, 1) >= beside);
        assert!(residual(&s, &found, 3, 3) >= beside);

        assert!(factor(&Sparse::from_ints(&[&[0, 0], &[0, -1]])).is_none());
        assert!(factor(&Sparse::from_ints(&[&[1, 1], &[1, 1]])).is_none());
    }
}
