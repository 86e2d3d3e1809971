//! Is a large symmetric matrix positive semidefinite?
//!
//! The certificate brings a rounded Cholesky factor L, and the exact residual S - L L' has to be
//! diagonally dominant, strictly for a definite S (`mceip_exact::Dominance`). Without a factor S
//! has to be a non-negative diagonal.
//!
//! Only the lower triangle is looked at, so S must be symmetric. Called by
//! `condensed` for its hypotheses.

use super::fault::CoverFault;
use crate::certificate::{Factor, IntegerRow};
use mceip_exact::{Dominance, Integer};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Largest binary exponent of a factor.
const MAX_EXPONENT: u32 = 1 << 12;

/// Bits of a sum of products in machine integers, beside its sign.
const MACHINE_BITS: u64 = 127;

/// A symmetric matrix by rows: column to entry.
pub(super) type SymmetricRows = Vec<BTreeMap<usize, Integer>>;

/// Demands that S is positive semidefinite (`strictly`: definite). S is in units of 1 / `scale`,
/// the factor in its own. `what` names the hypothesis in the fault.
pub(super) fn semidefinite(
    s: &SymmetricRows,
    scale: &Integer,
    factor: Option<&Factor>,
    strictly: bool,
    what: &'static str,
) -> Result<(), CoverFault> {
    let broken = match factor {
        None => (0..s.len()).find(|&i| !is_diagonal_row(s, i, strictly)),
        Some(factor) => {
            shape(factor, s.len())?;
            residual(s, scale, factor).first_undominated(strictly)
        }
    };

    match broken {
        None => Ok(()),
        Some(row) => Err(CoverFault::hypothesis(what, row)),
    }
}

/// Is row i zero but for its diagonal entry, which is >= 0 (`strictly`: > 0)?
fn is_diagonal_row(s: &SymmetricRows, i: usize, strictly: bool) -> bool {
    for (j, entry) in &s[i] {
        let is_allowed = if *j == i {
            !entry.is_negative()
        } else {
            entry.is_zero()
        };
        if !is_allowed {
            return false;
        }
    }

    !strictly || s[i].get(&i).is_some_and(Signed::is_positive)
}

/// The rows of E = S - L L', in units of 1 / (scale 4^exponent).
fn residual(s: &SymmetricRows, scale: &Integer, factor: &Factor) -> Dominance<Integer> {
    let lift = Integer::one() << (2 * factor.exponent);
    let bits: Vec<u64> = factor.rows.iter().map(IntegerRow::bits).collect();
    let mut rows = Dominance::zero(s.len());

    for (i, row) in s.iter().enumerate() {
        let first_of_s = row.keys().next().copied().unwrap_or(i);
        for j in factor.first[i].min(first_of_s)..=i {
            let mut residual = -product(factor, &bits, i, j) * scale;
            if let Some(given) = row.get(&j) {
                residual += given * &lift;
            }

            rows.add(i, j, residual);
        }
    }

    rows
}

/// (L L')_ij for j <= i: the sum over the columns that both rows hold, up to j, where row j ends.
fn product(factor: &Factor, bits: &[u64], i: usize, j: usize) -> Integer {
    let start = factor.first[i].max(factor.first[j]);
    let row_parts = [i, j].map(|row| (&factor.rows[row], start - factor.first[row]));
    let count = (j + 1).saturating_sub(start) as u64;
    let count_bits = u64::from(u64::BITS - count.leading_zeros());

    let short = row_parts.map(|(row, from)| row.as_short().and_then(|row| row.get(from..)));
    if let [Some(left), Some(right)] = short
        && bits[i] + bits[j] + count_bits <= MACHINE_BITS
    {
        let products = left.iter().zip(right);
        let products = products.map(|(p, q)| i128::from(*p) * i128::from(*q));
        return products.sum::<i128>().into();
    }

    let [left, right] = row_parts.map(|(row, from)| row.iter().skip(from));
    let mut sum = Integer::zero();
    for (p, q) in left.zip(right) {
        sum += &*p * &*q;
    }

    sum
}

/// Demands that row i holds the columns from `first` on, and that the exponent is within the limit.
fn shape(factor: &Factor, n: usize) -> Result<(), CoverFault> {
    CoverFault::length("factor", n, factor.rows.len())?;
    CoverFault::length("first columns of the factor", n, factor.first.len())?;
    CoverFault::at_most("exponent", MAX_EXPONENT.into(), factor.exponent.into())?;

    for (i, row) in factor.rows.iter().enumerate() {
        let first = factor.first[i];
        if first > i || row.len() != i + 1 - first {
            return Err(CoverFault::Length {
                what: "row of the factor",
                expected: (i + 1).saturating_sub(first),
                got: row.len(),
            });
        }
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tridiagonal(n: usize, d: i64) -> SymmetricRows {
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
        let rows = vec![
            vec![Integer::from(2)].into(),
            vec![Integer::from(-2), Integer::from(2)].into(),
        ];
        Factor {
            first: vec![0, 0],
            rows,
            exponent: 0,
        }
    }

    #[test]
    fn the_residual_decides() {
        let check = |d: i64, strictly| {
            semidefinite(
                &tridiagonal(2, d),
                &Integer::one(),
                Some(&factor()),
                strictly,
                "S",
            )
            .is_ok()
        };
        assert!(check(8, false) && check(9, true));
        // Residual 0 is semidefinite only; -1 is neither.
        assert!(!check(8, true) && !check(7, false));
    }

    /// S = L L' + E with an S that is zero where L L' is not, for short and for long factors and
    /// two scales: E_ii - sum |E_ij| is `more` units, row by row, and the sign of that decides.
    #[test]
    fn fill_counts() {
        let verdict = |bits: u32, scale: i64, more: [i64; 3], strictly: bool| {
            let value = |v: i64| Integer::from(v) << bits;
            // L = [[3], [-1, 3], [-1, 1, 3]]: L L' = [[9, -3, -3], [-3, 10, 4], [-3, 4, 11]].
            let rows = vec![
                vec![value(3)].into(),
                vec![value(-1), value(3)].into(),
                vec![value(-1), value(1), value(3)].into(),
            ];
            let factor = Factor {
                first: vec![0, 0, 0],
                rows,
                exponent: 0,
            };
            let entry = |v: i64| Integer::from(v * scale) << (2 * bits);
            // Off the diagonal S holds (1, 0) only, -3 + 1: row sums of |E| are 1 + 3, 1 + 4, 3 +
            // 4.
            let s = vec![
                BTreeMap::from([(0, entry(9 + 4) + more[0]), (1, entry(-2))]),
                BTreeMap::from([(0, entry(-2)), (1, entry(10 + 5) + more[1])]),
                BTreeMap::from([(2, entry(11 + 7) + more[2])]),
            ];
            semidefinite(&s, &Integer::from(scale), Some(&factor), strictly, "S")
        };
        for (bits, scale) in [(0, 1), (0, 3), (40, 7), (59, 3), (60, 3), (90, 1)] {
            assert_eq!(
                (
                    verdict(bits, scale, [0; 3], false),
                    verdict(bits, scale, [1; 3], true)
                ),
                (Ok(()), Ok(())),
                "{bits}"
            );
            for row in 0..3 {
                let but = |all: i64| std::array::from_fn(|i| all - i64::from(i == row));
                let broken = Err(CoverFault::Hypothesis { expected: "S", row });
                assert_eq!(
                    (
                        verdict(bits, scale, but(0), false),
                        verdict(bits, scale, but(1), true)
                    ),
                    (broken.clone(), broken),
                    "{bits} {row}"
                );
            }
        }
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
        short.rows[1] = vec![Integer::from(-2)].into();
        let mut beyond = factor();
        beyond.first[1] = 2;
        let mut few = factor();
        few.rows.pop();
        for bad in [short, beyond, few] {
            assert!(matches!(
                semidefinite(&tridiagonal(2, 9), &Integer::one(), Some(&bad), false, "S"),
                Err(CoverFault::Length { .. })
            ));
        }
    }

    /// S = L L' + E in units of 1 / (scale 4^exponent), E with every entry of the lower triangle.
    #[test]
    fn every_residual_off_the_diagonal_counts_for_both_its_rows() {
        // L in units of 1/2: L L' = [[4, 2, 6], [2, 10, 9], [6, 9, 38]] / 4.
        let rows = [vec![2], vec![1, 3], vec![3, 2, 5]];
        let factor = Factor {
            first: vec![0; 3],
            rows: rows
                .iter()
                .map(|r| r.iter().map(|&v| v.into()).collect())
                .collect(),
            exponent: 1,
        };
        let product = [[4, 2, 6], [2, 10, 9], [6, 9, 38]];
        let check = |diagonal: [i64; 3], strictly| {
            // E_10 = 1, E_20 = -2, E_21 = 3; one unit of S is 4 / 7 of those of L L'.
            let off = [[0, 1, -2], [1, 0, 3], [-2, 3, 0]];
            let scale = 7;
            let entry = |i: usize, j: usize| {
                scale * (product[i][j] + if i == j { diagonal[i] } else { off[i][j] })
            };
            let row = |i: usize| (0..3).map(|j| (j, Integer::from(entry(i, j)))).collect();
            let s: SymmetricRows = (0..3).map(row).collect();
            semidefinite(&s, &Integer::from(4 * scale), Some(&factor), strictly, "S")
        };
        let fault = |row| Err(CoverFault::Hypothesis { expected: "S", row });
        assert_eq!(
            [check([3, 4, 5], false), check([4, 5, 6], true)],
            [Ok(()), Ok(())]
        );
        assert_eq!(
            [
                check([2, 4, 5], false),
                check([3, 3, 5], false),
                check([3, 4, 4], false)
            ],
            [fault(0), fault(1), fault(2)]
        );
        assert_eq!(
            [
                check([3, 5, 6], true),
                check([4, 4, 6], true),
                check([4, 5, 5], true)
            ],
            [fault(0), fault(1), fault(2)]
        );
    }

    /// Rows of a factor that begin beside the first column.
    #[test]
    fn a_banded_factor_is_multiplied_out_from_where_it_begins() {
        // L = [[2, ., .], [1, 3, .], [., 4, 5]]: L L' = [[4, 2, 0], [2, 10, 12], [0, 12, 41]].
        let rows = [vec![2], vec![1, 3], vec![4, 5]];
        let factor = Factor {
            first: vec![0, 0, 1],
            rows: rows
                .iter()
                .map(|r| r.iter().map(|&v| v.into()).collect())
                .collect(),
            exponent: 0,
        };
        let check = |s: [[i64; 3]; 3]| {
            let row = |i: usize| {
                (0..3)
                    .filter(|&j| s[i][j] != 0)
                    .map(|j| (j, Integer::from(s[i][j])))
                    .collect()
            };
            let s: SymmetricRows = (0..3).map(row).collect();
            semidefinite(&s, &Integer::one(), Some(&factor), false, "S").is_ok()
        };
        assert!(check([[4, 2, 0], [2, 10, 12], [0, 12, 41]]));
        assert!(
            !check([[4, 2, 1], [2, 10, 12], [1, 12, 41]])
                && !check([[4, 2, 0], [2, 10, 13], [0, 13, 41]])
        );
        assert!(!check([[4, 2, 0], [2, 10, 12], [0, 12, 40]]));
    }

    #[test]
    fn lengths_and_limits_are_told() {
        let with = |change: &dyn Fn(&mut Factor)| {
            let mut f = factor();
            change(&mut f);
            shape(&f, 2)
        };
        let length = |what, expected, got| {
            Err(CoverFault::Length {
                what,
                expected,
                got,
            })
        };
        assert_eq!(
            [with(&|_| {}), with(&|f| f.exponent = MAX_EXPONENT)],
            [Ok(()), Ok(())]
        );
        assert_eq!(
            with(&|f| f.exponent = 4097),
            Err(CoverFault::TooLarge {
                what: "exponent",
                limit: 4096,
                got: 4097
            })
        );
        assert_eq!(
            with(&|f| f.rows[1] = vec![Integer::from(-2)].into()),
            length("row of the factor", 2, 1)
        );
        assert_eq!(with(&|f| f.first[1] = 1), length("row of the factor", 1, 2));
        assert_eq!(with(&|f| f.first[1] = 2), length("row of the factor", 0, 2));
        assert_eq!(
            with(&|f| f.rows[0] = vec![].into()),
            length("row of the factor", 1, 0)
        );
        assert_eq!(
            [
                with(&|f| f.rows.truncate(1)),
                with(&|f| f.first.truncate(1))
            ],
            [
                length("factor", 2, 1),
                length("first columns of the factor", 2, 1)
            ]
        );
    }
}
