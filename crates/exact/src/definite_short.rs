//! A first try at definiteness in machine integers, for large sparse matrices that are not close to
//! singular: the scheme of `definite` with 48 bits.
//!
//! A is rounded down to multiples of a unit u = 2^(bits - 48), 2^bits above its largest diagonal
//! entry. The factors L and D of A - sI are computed in 64-bit integers; then the residual
//! A - L D L' is computed exactly, in 128 bits, and must be strictly diagonally dominant with a
//! positive diagonal, whatever the rounding of A took away (less than u an entry).
//!
//! `true` is a proof of definiteness, a hundred times faster than long numbers; `false` says
//! nothing. Every overflow and every number out of bounds ends in `false`.
//!
//! Numbers: A, D and L D in units u; L in units of 2^-36; the residual in units u 2^-72.

use super::{Integer, Rational, Sparse};
use num_traits::{One, Signed, ToPrimitive};

/// Fraction bits of A and D relative to a power of two above the largest diagonal entry.
const UNIT: u32 = 48;
/// Fraction bits of L.
const LOWER: u32 = 36;
/// The shift, in units of A: covers a row of 2^12 roundings of L, each at most 2^(UNIT - LOWER).
const SHIFT: i64 = 1 << (UNIT - 24);
/// Largest entry of L, and of L D in units of A; a definite matrix that is not nearly singular
/// stays below.
const MAX_LOWER: i128 = 1 << (LOWER + 14);
const MAX_SCALED: i128 = 1 << (UNIT + 1);
/// Order up to which the sums of products fit into 128 bits.
const MAX_ORDER: usize = 1 << 20;

/// A row of the skyline: its first column, and the entries from there on.
struct Row {
    first: usize,
    entries: Vec<i64>,
}

/// `true` proves that a symmetric matrix is positive definite; `false` says nothing.
pub(super) fn certainly_definite(m: &Sparse) -> bool {
    proof(m).unwrap_or(false)
}

/// `None` where a number does not fit.
fn proof(m: &Sparse) -> Option<bool> {
    if m.rows() > MAX_ORDER {
        return None;
    }

    let a = rounded_down(m)?;
    let factors = Factors::of(&a)?;

    factors.is_residual_dominated(m, &a)
}

/// The lower triangle rounded down to the fixed unit.
fn rounded_down(m: &Sparse) -> Option<Vec<Row>> {
    let unit = Unit::of(m)?;
    let mut rows = Vec::with_capacity(m.rows());

    for i in 0..m.rows() {
        let lower: Vec<&(usize, Rational)> = m.row(i).iter().filter(|(j, _)| *j <= i).collect();
        let first = lower.first().map_or(i, |(j, _)| *j);
        let mut entries = vec![0; i + 1 - first];
        for (j, value) in lower {
            let entry = unit.round_down(value)?;
            // |a_ij| is below the largest diagonal entry where the matrix is definite.
            if entry.abs() > 1 << UNIT {
                return None;
            }
            entries[j - first] = entry;
        }
        rows.push(Row { first, entries });
    }

    Some(rows)
}

/// The unit of A as `down / up`, one of them 1 and the other a power of two.
struct Unit {
    up: Integer,
    down: Integer,
}

impl Unit {
    /// 2^-UNIT of a power of two above the largest diagonal entry; `None` if that is not positive.
    fn of(m: &Sparse) -> Option<Unit> {
        let largest = (0..m.rows()).map(|i| m.get(i, i)).max()?;
        if !largest.is_positive() {
            return None;
        }

        let bits = largest.numer().bits() as i64 - largest.denom().bits() as i64 + 1;
        let exponent = bits - i64::from(UNIT);
        Some(Unit {
            up: Integer::one() << (-exponent).max(0).unsigned_abs(),
            down: Integer::one() << exponent.max(0).unsigned_abs(),
        })
    }

    fn round_down(&self, value: &Rational) -> Option<i64> {
        let numerator = value.numer() * &self.up;
        let denominator = value.denom() * &self.down;
        num_integer::Integer::div_floor(&numerator, &denominator).to_i64()
    }
}

/// L (without its unit diagonal) and D of A less the shift, rounded.
struct Factors {
    lower: Vec<Row>,
    pivots: Vec<i64>,
}

impl Factors {
    fn of(a: &[Row]) -> Option<Factors> {
        let mut factors = Factors {
            lower: Vec::with_capacity(a.len()),
            pivots: Vec::with_capacity(a.len()),
        };

        for given in a {
            factors.append_row(given)?;
        }

        Some(factors)
    }

    /// Row i from the rows above: l_ij d_j = a_ij - sum_k l_ik d_k l_jk for j < i, and
    /// d_i = a_ii - s - sum_k l_ik d_k l_ik.
    fn append_row(&mut self, given: &Row) -> Option<()> {
        let i = self.lower.len();
        let first = given.first;
        let mut row = Row {
            first,
            entries: Vec::with_capacity(i - first),
        };

        let mut scaled = Row {
            first,
            entries: Vec::with_capacity(i - first),
        }; // l_ij d_j

        for j in first..i {
            let a_ij = i128::from(given.entries[j - first]);
            let l_ij_d_j = a_ij - (dot(&scaled, &self.lower[j]) >> LOWER);
            let l_ij = (l_ij_d_j << LOWER) / i128::from(self.pivots[j]);
            if l_ij.abs() > MAX_LOWER || l_ij_d_j.abs() > MAX_SCALED {
                return None;
            }
            scaled.entries.push(l_ij_d_j as i64);
            row.entries.push(l_ij as i64);
        }

        let a_ii = i128::from(given.entries[i - first]);
        let pivot = a_ii - i128::from(SHIFT) - (dot(&scaled, &row) >> LOWER);
        let pivot = i64::try_from(pivot).ok()?;

        if pivot <= 0 {
            return None;
        }

        self.pivots.push(pivot);
        self.lower.push(row);

        Some(())
    }

    /// Is A - LDL' strictly diagonally dominant with a positive diagonal, whatever A's rounding
    /// took away? `None` where a number does not fit.
    fn is_residual_dominated(&self, m: &Sparse, a: &[Row]) -> Option<bool> {
        let n = a.len();
        let mut diagonal = vec![0i128; n];
        let mut off_diagonal = vec![0i128; n]; // row sums of absolute values
        for i in 0..n {
            let scaled = ScaledRow::of(&self.lower[i], &self.pivots)?;

            for j in a[i].first..=i {
                let l_ij_d_j = if i == j {
                    i128::from(self.pivots[i]) << LOWER
                } else {
                    scaled.entries[j - self.lower[i].first]
                };
                let a_ij = i128::from(a[i].entries[j - a[i].first]) << LOWER;
                let l_j = &self.lower[j];

                // a_ij - sum_{k < j} l_ik d_k l_jk - l_ij d_j
                let residual = (a_ij - dot(&scaled.high, l_j))
                    .checked_mul(1 << LOWER)?
                    .checked_sub(dot(&scaled.low, l_j))?
                    .checked_sub(l_ij_d_j.checked_mul(1 << LOWER)?)?;
                if i == j {
                    diagonal[i] = residual;
                } else {
                    off_diagonal[i] = off_diagonal[i].checked_add(residual.abs())?;
                    off_diagonal[j] = off_diagonal[j].checked_add(residual.abs())?;
                }
            }
        }

        // Off the diagonal rounding costs a unit an entry; the diagonal was rounded down.
        let unit = 1i128 << (2 * LOWER);
        for i in 0..n {
            let lost = unit * m.row(i).len() as i128;
            let Some(radius) = off_diagonal[i].checked_add(lost) else {
                return Some(false);
            };
            if diagonal[i] <= radius {
                return Some(false);
            }
        }

        Some(true)
    }
}

/// A row of L D, exactly: the products l_ik d_k, split as high 2^LOWER + low so that sums of their
/// products fit into 128 bits.
struct ScaledRow {
    entries: Vec<i128>,
    high: Row,
    low: Row,
}

impl ScaledRow {
    fn of(row: &Row, pivots: &[i64]) -> Option<ScaledRow> {
        let first = row.first;
        let count = row.entries.len();
        let mut entries = Vec::with_capacity(count);
        let mut high = Vec::with_capacity(count);
        let mut low = Vec::with_capacity(count);

        for (l_ik, d_k) in row.entries.iter().zip(&pivots[first..]) {
            let product = i128::from(*l_ik) * i128::from(*d_k);
            entries.push(product);
            high.push(i64::try_from(product >> LOWER).ok()?);
            low.push(i64::try_from(product & ((1 << LOWER) - 1)).ok()?);
        }

        Some(ScaledRow {
            entries,
            high: Row {
                first,
                entries: high,
            },
            low: Row {
                first,
                entries: low,
            },
        })
    }
}

/// sum a_k b_k over the columns that both hold. Below 2^120 by the bounds above.
fn dot(a: &Row, b: &Row) -> i128 {
    let first = a.first.max(b.first);
    let mut sum = 0;

    for (a_k, b_k) in a.entries_from(first).iter().zip(b.entries_from(first)) {
        sum += i128::from(*a_k) * i128::from(*b_k);
    }

    sum
}

impl Row {
    /// The entries of the columns from `column` on, none if the row ends before it.
    fn entries_from(&self, column: usize) -> &[i64] {
        let start = (column - self.first).min(self.entries.len());
        &self.entries[start..]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    /// tridiag(-1, d, -1): definite exactly for d > 2 cos(pi/(n+1)), times a factor.
    fn chain(n: usize, d: Rational, factor: &Rational) -> Sparse {
        let off = (1..n).flat_map(|i| [(i, i - 1, -factor.clone()), (i - 1, i, -factor.clone())]);
        Sparse::from_entries(n, n, (0..n).map(|i| (i, i, &d * factor)).chain(off))
    }

    #[test]
    fn definite_chains_are_seen_at_every_scale() {
        for factor in [
            whole(1),
            rational(1, 3),
            rational(7, 1_000_000_007),
            whole(i64::MAX),
        ] {
            assert!(certainly_definite(&chain(100, whole(2), &factor)));
            assert!(!certainly_definite(&chain(100, rational(19, 10), &factor)));
        }

        assert!(!certainly_definite(&Sparse::zeros(3, 3)));
    }

    /// Definite by 2^-40 only, exactly singular, indefinite by 2^-40: none is accepted.
    #[test]
    fn nearly_singular_is_never_accepted() {
        let tiny = rational(1, 1 << 40);
        for corner in [whole(1) + &tiny, whole(1), whole(1) - &tiny] {
            let m = Sparse::from_entries(
                2,
                2,
                [
                    (0, 0, whole(1)),
                    (0, 1, whole(1)),
                    (1, 0, whole(1)),
                    (1, 1, corner),
                ],
            );
            assert!(!certainly_definite(&m));
        }

        // Entries off the diagonal that are larger than all of it.
        let off = Sparse::from_entries(
            2,
            2,
            [
                (0, 0, whole(1)),
                (0, 1, whole(99)),
                (1, 0, whole(99)),
                (1, 1, whole(1)),
            ],
        );

        assert!(!certainly_definite(&off));
    }

    /// The factors of one matrix prove nothing about another one: the exact residual notices.
    #[test]
    fn a_factorisation_of_another_matrix_is_not_dominated() {
        let good = chain(12, whole(2), &whole(1));
        let other = chain(12, rational(19, 10), &whole(1));
        let good_rows = rounded_down(&good).unwrap();
        let other_rows = rounded_down(&other).unwrap();
        let mut wrong_rows = rounded_down(&good).unwrap();
        wrong_rows[5].entries[0] += 1 << 30; // an entry off the diagonal, by 2^-18

        let factors = Factors::of(&good_rows).unwrap();

        let is_dominated = |m, rows: &[Row]| factors.is_residual_dominated(m, rows);
        assert_eq!(is_dominated(&good, &good_rows), Some(true));
        assert_eq!(is_dominated(&other, &other_rows), Some(false));
        assert_eq!(is_dominated(&good, &wrong_rows), Some(false));
    }

    /// Pseudo-random integers (Marsaglia, Xorshift RNGs, 2003).
    struct Random(u64);

    impl Random {
        /// Between -size and size.
        fn next(&mut self, size: i64) -> i64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 % (2 * size as u64 + 1)) as i64 - size
        }
    }

    /// Factors of order 3 with pivots near 1/4 and entries of L below 1/2.
    fn random_factors(random: &mut Random) -> Factors {
        let quarter = 1i64 << (UNIT - 2);
        let pivots = (0..3).map(|_| quarter + random.next(quarter / 4)).collect();
        let lower = (0..3)
            .map(|i| Row {
                first: 0,
                entries: (0..i).map(|_| random.next(1 << (LOWER - 1))).collect(),
            })
            .collect();

        Factors { lower, pivots }
    }

    /// (L D L')_ij in integers of any length, i >= j.
    fn product(factors: &Factors, i: usize, j: usize) -> Integer {
        let entry = |row: usize, column: usize| match factors.lower[row].entries.get(column) {
            Some(value) => Integer::from(*value),
            None => Integer::one() << LOWER, // the diagonal
        };

        (0..=j)
            .map(|k| entry(i, k) * factors.pivots[k] * entry(j, k))
            .sum()
    }

    /// The dominance by hand, in integers of any length: factors that are nearly right, so that
    /// units decide.
    #[test]
    fn dominance_is_decided_to_the_last_unit() {
        let mut random = Random(88_172_645_463_325_252);
        let one = Integer::one() << (2 * LOWER);
        let ones = Sparse::from_ints(&[&[1, 1, 1], &[1, 1, 1], &[1, 1, 1]]);
        let mut seen = [0; 2];

        for _ in 0..300 {
            let factors = random_factors(&mut random);
            let mut a = Vec::new();
            for i in 0..3 {
                let mut entries = Vec::new();
                for j in 0..=i {
                    let rounded = (product(&factors, i, j) >> (2 * LOWER)).to_i64().unwrap();
                    let more = if i == j {
                        5 + random.next(3)
                    } else {
                        random.next(1)
                    };
                    entries.push(rounded + more);
                }
                a.push(Row { first: 0, entries });
            }

            let residual = |i: usize, j: usize| {
                Integer::from(a[i].entries[j]) * &one - product(&factors, i, j)
            };
            let is_row_dominated = |i: usize| {
                let off_diagonal: Integer = (0..3)
                    .filter(|&j| j != i)
                    .map(|j| residual(i.max(j), i.min(j)).abs())
                    .sum();
                residual(i, i) > off_diagonal + &one * 3
            };
            let expected = (0..3).all(is_row_dominated);

            assert_eq!(factors.is_residual_dominated(&ones, &a), Some(expected));
            seen[usize::from(expected)] += 1;
        }

        assert!(seen[0] > 50 && seen[1] > 10, "{seen:?}");
    }
}
