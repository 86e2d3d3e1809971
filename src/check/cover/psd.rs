//! Is a large symmetric matrix positive semidefinite? A rounded Cholesky factor comes with the
//! certificate, here it is multiplied out: S = L L' + E, E diagonally dominant (Gershgorin).

use super::CoverFault;
use crate::certificate::Factor;
use crate::exact::Integer;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Largest binary exponent of a factor.
const MAX_EXPONENT: u32 = 1 << 12;

/// A symmetric matrix by rows: column to entry.
pub(super) type Symmetric = Vec<BTreeMap<usize, Integer>>;

/// S is positive semidefinite (`strictly`: definite). Without a factor S must be a non-negative
/// diagonal. S is in units of 1 / `scale`, the factor in its own.
pub(super) fn semidefinite(
    s: &Symmetric,
    scale: &Integer,
    factor: Option<&Factor>,
    strictly: bool,
    what: &'static str,
) -> Result<(), CoverFault> {
    let fault = |row| CoverFault::Hypothesis { expected: what, row };
    let Some(factor) = factor else {
        let bad = |i: &usize| s[*i].iter().any(|(j, v)| if j == i { v.is_negative() } else { !v.is_zero() });
        let missing = |i: &usize| strictly && !s[*i].get(i).is_some_and(Signed::is_positive);
        return (0..s.len()).find(|i| bad(i) || missing(i)).map_or(Ok(()), |row| Err(fault(row)));
    };
    shape(factor, s.len())?;
    // Everything in units of 1 / (scale 4^exponent).
    let (lift, n) = (Integer::one() << (2 * factor.exponent), s.len());
    let (mut diagonal, mut off) = (vec![Integer::zero(); n], vec![Integer::zero(); n]);
    for i in 0..n {
        let start = factor.first[i].min(s[i].keys().next().copied().unwrap_or(i));
        for j in start..=i {
            let mut residual = s[i].get(&j).map_or_else(Integer::zero, |v| v * &lift);
            residual -= product(factor, i, j) * scale;
            if i == j {
                diagonal[i] = residual;
            } else {
                off[i] += residual.abs();
                off[j] += residual.abs();
            }
        }
    }
    let holds = |i: usize| if strictly { diagonal[i] > off[i] } else { diagonal[i] >= off[i] };
    (0..n).find(|&i| !holds(i)).map_or(Ok(()), |row| Err(fault(row)))
}

/// (L L')_ij.
fn product(factor: &Factor, i: usize, j: usize) -> Integer {
    let start = factor.first[i].max(factor.first[j]);
    let from = |r: usize| factor.rows[r].iter().skip(start.saturating_sub(factor.first[r]));
    from(i).zip(from(j)).take((j + 1).saturating_sub(start)).map(|(p, q)| p * q).sum()
}

/// Row i holds columns first[i] to i.
fn shape(factor: &Factor, n: usize) -> Result<(), CoverFault> {
    for (what, got) in [("factor", factor.rows.len()), ("first columns of the factor", factor.first.len())] {
        if got != n {
            return Err(CoverFault::Length { what, expected: n, got });
        }
    }
    if factor.exponent > MAX_EXPONENT {
        return Err(CoverFault::TooLarge { what: "exponent", limit: MAX_EXPONENT.into(), got: factor.exponent.into() });
    }
    let bad = (0..n).find(|&i| factor.first[i] > i || factor.rows[i].len() != i + 1 - factor.first[i]);
    match bad {
        Some(i) => {
            let expected = (i + 1).saturating_sub(factor.first[i]);
            Err(CoverFault::Length { what: "row of the factor", expected, got: factor.rows[i].len() })
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tridiagonal(n: usize, d: i64) -> Symmetric {
        let row = |i: usize| {
            let mut row = BTreeMap::from([(i, Integer::from(d))]);
            if i > 0 {
                row.insert(i - 1, Integer::from(-4));
            }
            if i + 1 < n {
                row.insert(i + 1, Integer::from(-4));
            }
            row
        };
        (0..n).map(row).collect()
    }

    /// [[2, 0], [-2, 2]] squared is [[4, -4], [-4, 8]].
    fn factor() -> Factor {
        let rows = vec![vec![Integer::from(2)], vec![Integer::from(-2), Integer::from(2)]];
        Factor { first: vec![0, 0], rows, exponent: 0 }
    }

    #[test]
    fn the_residual_decides() {
        let check = |d: i64, strictly| semidefinite(&tridiagonal(2, d), &Integer::one(), Some(&factor()), strictly, "S").is_ok();
        assert!(check(8, false) && check(9, true));
        assert!(!check(8, true) && !check(7, false)); // residual 0 is semidefinite only; -1 is neither
    }

    #[test]
    fn without_a_factor_only_diagonals_pass() {
        let one = Integer::one();
        let diagonal = |v: i64| vec![BTreeMap::from([(0, Integer::from(v))])];
        assert!(semidefinite(&diagonal(1), &one, None, true, "S").is_ok());
        assert!(semidefinite(&diagonal(0), &one, None, false, "S").is_ok());
        assert!(semidefinite(&diagonal(0), &one, None, true, "S").is_err());
        assert!(semidefinite(&diagonal(-1), &one, None, false, "S").is_err());
        assert!(semidefinite(&tridiagonal(2, 9), &one, None, false, "S").is_err());
    }

    #[test]
    fn misshapen_factors_are_refused() {
        let mut short = factor();
        short.rows[1].pop();
        let mut beyond = factor();
        beyond.first[1] = 2;
        let mut few = factor();
        few.rows.pop();
        for bad in [short, beyond, few] {
            assert!(matches!(semidefinite(&tridiagonal(2, 9), &Integer::one(), Some(&bad), false, "S"), Err(CoverFault::Length { .. })));
        }
    }

    /// S = L L' + E in units of 1 / (scale 4^exponent), E with every entry of the lower triangle.
    #[test]
    fn every_residual_off_the_diagonal_counts_for_both_its_rows() {
        // L in units of 1/2: L L' = [[4, 2, 6], [2, 10, 9], [6, 9, 38]] / 4.
        let rows = [vec![2], vec![1, 3], vec![3, 2, 5]];
        let factor = Factor { first: vec![0; 3], rows: rows.iter().map(|r| r.iter().map(|&v| v.into()).collect()).collect(), exponent: 1 };
        let product = [[4, 2, 6], [2, 10, 9], [6, 9, 38]];
        let check = |diagonal: [i64; 3], strictly| {
            // E_10 = 1, E_20 = -2, E_21 = 3; one unit of S is 4 / 7 of those of L L'.
            let off = [[0, 1, -2], [1, 0, 3], [-2, 3, 0]];
            let scale = 7;
            let entry = |i: usize, j: usize| scale * (product[i][j] + if i == j { diagonal[i] } else { off[i][j] });
            let row = |i: usize| (0..3).map(|j| (j, Integer::from(entry(i, j)))).collect();
            let s: Symmetric = (0..3).map(row).collect();
            semidefinite(&s, &Integer::from(4 * scale), Some(&factor), strictly, "S")
        };
        let fault = |row| Err(CoverFault::Hypothesis { expected: "S", row });
        assert_eq!([check([3, 4, 5], false), check([4, 5, 6], true)], [Ok(()), Ok(())]);
        assert_eq!([check([2, 4, 5], false), check([3, 3, 5], false), check([3, 4, 4], false)], [fault(0), fault(1), fault(2)]);
        assert_eq!([check([3, 5, 6], true), check([4, 4, 6], true), check([4, 5, 5], true)], [fault(0), fault(1), fault(2)]);
    }

    /// Rows of a factor that begin beside the first column.
    #[test]
    fn a_banded_factor_is_multiplied_out_from_where_it_begins() {
        // L = [[2, ., .], [1, 3, .], [., 4, 5]]: L L' = [[4, 2, 0], [2, 10, 12], [0, 12, 41]].
        let rows = [vec![2], vec![1, 3], vec![4, 5]];
        let factor =
            Factor { first: vec![0, 0, 1], rows: rows.iter().map(|r| r.iter().map(|&v| v.into()).collect()).collect(), exponent: 0 };
        let check = |s: [[i64; 3]; 3]| {
            let row = |i: usize| (0..3).filter(|&j| s[i][j] != 0).map(|j| (j, Integer::from(s[i][j]))).collect();
            let s: Symmetric = (0..3).map(row).collect();
            semidefinite(&s, &Integer::one(), Some(&factor), false, "S").is_ok()
        };
        assert!(check([[4, 2, 0], [2, 10, 12], [0, 12, 41]]));
        assert!(!check([[4, 2, 1], [2, 10, 12], [1, 12, 41]]) && !check([[4, 2, 0], [2, 10, 13], [0, 13, 41]]));
        assert!(!check([[4, 2, 0], [2, 10, 12], [0, 12, 40]]));
    }

    #[test]
    fn lengths_and_limits_are_told() {
        let with = |change: &dyn Fn(&mut Factor)| {
            let mut f = factor();
            change(&mut f);
            shape(&f, 2)
        };
        let length = |what, expected, got| Err(CoverFault::Length { what, expected, got });
        assert_eq!([with(&|_| {}), with(&|f| f.exponent = MAX_EXPONENT)], [Ok(()), Ok(())]);
        assert_eq!(with(&|f| f.exponent = 4097), Err(CoverFault::TooLarge { what: "exponent", limit: 4096, got: 4097 }));
        assert_eq!(with(&|f| f.rows[1].truncate(1)), length("row of the factor", 2, 1));
        assert_eq!(with(&|f| f.first[1] = 1), length("row of the factor", 1, 2));
        assert_eq!(with(&|f| f.first[1] = 2), length("row of the factor", 0, 2));
        assert_eq!(with(&|f| f.rows[0].clear()), length("row of the factor", 1, 0));
        assert_eq!(
            [with(&|f| f.rows.truncate(1)), with(&|f| f.first.truncate(1))],
            [length("factor", 2, 1), length("first columns of the factor", 2, 1)]
        );
    }
}
