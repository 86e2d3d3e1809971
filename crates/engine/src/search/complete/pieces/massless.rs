//! Evidence that a symmetric part is semidefinite where some rows are zero: degrees of freedom
//! without mass.

use crate::search::complete::pieces::skyline::Skyline;
use mceip_check::certificate::Factor;
use mceip_exact::{Integer, Sparse};

/// A factor whose rest is diagonally dominant, for sym(m) positive definite on the rows that are
/// not zero; `None` otherwise.
pub(crate) fn factor(m: &Sparse) -> Option<Factor> {
    let n = m.rows();
    let mut has_mass = vec![false; n];
    m.entries()
        .for_each(|(i, j, _)| (has_mass[i], has_mass[j]) = (true, true));
    let kept: Vec<usize> = (0..n).filter(|&i| has_mass[i]).collect();
    let part = Skyline::symmetric(&m.submatrix(&kept, &kept));
    let slack = part.below_spectrum()?;
    let part = part.shifted(-slack).cholesky()?.rounded(slack);
    // Back among the rows without mass, which are zero in the factor.
    let (mut first, mut rows): (Vec<usize>, Vec<Vec<Integer>>) =
        ((0..n).collect(), vec![vec![Integer::default()]; n]);
    for (p, &i) in kept.iter().enumerate() {
        first[i] = kept[part.first[p]];
        let mut row = vec![Integer::default(); i + 1 - first[i]];
        part.rows[p]
            .iter()
            .zip(&kept[part.first[p]..])
            .for_each(|(v, &j)| row[j - first[i]] = v.clone());
        rows[i] = row;
    }
    Some(Factor {
        first,
        rows,
        exponent: part.exponent,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Rational, whole};

    /// E = S - L L' is zero on rows without mass and diagonally dominant on the others.
    #[test]
    fn rows_without_mass_stay_zero_and_the_rest_is_dominant() {
        let s = Sparse::from_ints(&[&[0, 0, 0, 0], &[0, 4, 0, 1], &[0, 0, 0, 0], &[0, 1, 0, 3]]);
        let f = factor(&s).unwrap();
        let unit = Rational::from_integer(Integer::from(1) << f.exponent);
        let l = |i: usize, k: usize| {
            if k < f.first[i] || k > i {
                whole(0)
            } else {
                Rational::from_integer(f.rows[i][k - f.first[i]].clone()) / &unit
            }
        };
        let e =
            |i: usize, j: usize| s.get(i, j) - (0..4).map(|k| l(i, k) * l(j, k)).sum::<Rational>();
        assert!((0..4).all(|j| e(0, j) == whole(0) && e(2, j) == whole(0)));
        assert!(
            e(1, 1) >= num_traits::Signed::abs(&e(1, 3))
                && e(3, 3) >= num_traits::Signed::abs(&e(1, 3))
        );
        assert!(factor(&Sparse::from_ints(&[&[0, 0], &[0, -1]])).is_none());
        assert!(factor(&Sparse::from_ints(&[&[1, 1], &[1, 1]])).is_none());
    }
}
