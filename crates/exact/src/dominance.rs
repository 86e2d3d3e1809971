//! Definiteness of a symmetric matrix by factors that may be wrong: the exact residual decides.
//!
//! Let S = F D F' + E with D >= 0. If E is strictly diagonally dominant with a positive diagonal,
//! E_ii > sum_(j not i) |E_ij|, then E is positive definite (Gershgorin), and so is S; if
//! E_ii >= sum |E_ij| only, both are positive semidefinite. The factors may be anything, because E
//! is computed without rounding.
//!
//! [`Dominance`] collects the rows of E in any numbers. [`machine_definite`] makes the factors as
//! well, in machine integers: L and D of S - s I with rounding, for a small shift s that makes room
//! for E. Every overflow and every number out of bounds ends in a refusal.
//!
//! Machine numbers: S, D and L D in units of S; L in units of 2^-36; E in units of 2^-72.
//!
//! Used by `definite`, and by the checker for its leaves and hypotheses.

use num_traits::Signed;
use std::ops::AddAssign;

/// Bits of an entry of S at most.
pub(super) const MACHINE_BITS: u32 = 48;
/// Fraction bits of L.
const LOWER: u32 = 36;
/// Largest entry of L: of a definite matrix |l_ij|^2 d_j <= S_ii, so it is 2^14 at most unless a
/// pivot is below 2^-28 S_ii.
const MAX_LOWER: i128 = 1 << (LOWER + 14);
/// Largest entry of L D in units of S: of a definite matrix (l_ij d_j)^2 <= S_ii d_j.
const MAX_SCALED: i128 = 1 << (MACHINE_BITS + 1);
/// Order up to which the sums of products fit into 128 bits.
const MAX_ORDER: usize = 1 << 20;
/// Bits of an entry of E: a row of [`MAX_ORDER`] of them fits into 128 bits.
const RESIDUAL_BITS: u32 = 107;

/// Of each row of a symmetric matrix E the diagonal entry and the sum of the absolute values of the
/// others.
pub struct Dominance<N> {
    diagonal: Vec<N>,
    off_diagonal: Vec<N>,
}

impl<N: Clone + Signed + PartialOrd + AddAssign> Dominance<N> {
    /// Of the zero matrix of this order.
    pub fn zero(order: usize) -> Dominance<N> {
        Dominance {
            diagonal: vec![N::zero(); order],
            off_diagonal: vec![N::zero(); order],
        }
    }

    /// Counts entry (i, j) of the lower triangle, and its mirror.
    pub fn add(&mut self, i: usize, j: usize, entry: N) {
        if i == j {
            self.diagonal[i] = entry;
        } else {
            self.off_diagonal[i] += entry.abs();
            self.off_diagonal[j] += entry.abs();
        }
    }

    /// The first row with E_ii < sum |E_ij|, or `strictly` with E_ii <= sum |E_ij|.
    pub fn first_undominated(&self, strictly: bool) -> Option<usize> {
        (0..self.diagonal.len()).find(|&i| {
            let (diagonal, sum) = (&self.diagonal[i], &self.off_diagonal[i]);
            if strictly {
                diagonal <= sum
            } else {
                diagonal < sum
            }
        })
    }
}

/// A row of a lower triangle: its first column, and the entries from there on.
#[derive(Debug, Clone)]
pub struct MachineRow {
    /// The column of the first entry.
    pub first: usize,
    /// Up to the diagonal.
    pub entries: Vec<i64>,
}

/// Proves that S, given by its lower triangle, is positive definite; the factors are those of S
/// less the shift, which is not negative.
///
/// # Errors
/// The row at which the proof fails, 0 where the order is too large; of S that says nothing.
///
/// ```
/// use mceip_exact::{MachineRow, machine_definite};
/// let row = |first, entries: &[i64]| MachineRow { first, entries: entries.to_vec() };
/// let s = [row(0, &[2000]), row(0, &[1000, 2000])];
/// assert_eq!(machine_definite(&s, 10), Ok(()));
/// assert_eq!(machine_definite(&s, 1500), Err(1));
///
/// let singular = [row(0, &[1000]), row(0, &[1000, 1000])];
/// assert_eq!(machine_definite(&singular, 10), Err(1));
/// ```
pub fn machine_definite(s: &[MachineRow], shift: i64) -> Result<(), usize> {
    if s.len() > MAX_ORDER {
        return Err(0);
    }

    let is_misshapen =
        |(i, row): (usize, &MachineRow)| row.first > i || row.entries.len() != i + 1 - row.first;
    if let Some(i) = s.iter().enumerate().position(is_misshapen) {
        return Err(i);
    }

    let factors = Factors::of(s, shift)?;
    factors.require_dominated(s)
}

/// L (without its unit diagonal) and D of S less the shift, rounded.
struct Factors {
    lower: Vec<MachineRow>,
    pivots: Vec<i64>,
}

impl Factors {
    fn of(s: &[MachineRow], shift: i64) -> Result<Factors, usize> {
        let mut factors = Factors {
            lower: Vec::with_capacity(s.len()),
            pivots: Vec::with_capacity(s.len()),
        };
        for (i, given) in s.iter().enumerate() {
            factors.append_row(given, shift).ok_or(i)?;
        }

        Ok(factors)
    }

    /// Row i from the rows above: l_ij d_j = s_ij - sum_k l_ik d_k l_jk for j < i, and
    /// d_i = s_ii - shift - sum_k l_ik d_k l_ik. `None` if that is not positive or a number is too
    /// long.
    fn append_row(&mut self, given: &MachineRow, shift: i64) -> Option<()> {
        let i = self.lower.len();
        let first = given.first;
        if given
            .entries
            .iter()
            .any(|e| e.unsigned_abs() > 1 << MACHINE_BITS)
        {
            return None;
        }

        let mut row = MachineRow::empty(first, i);
        let mut scaled = MachineRow::empty(first, i); // l_ij d_j
        for j in first..i {
            let s_ij = i128::from(given.entries[j - first]);
            let l_ij_d_j = s_ij - (dot(&scaled, &self.lower[j]) >> LOWER);
            let l_ij = (l_ij_d_j << LOWER) / i128::from(self.pivots[j]);
            if l_ij.abs() > MAX_LOWER || l_ij_d_j.abs() > MAX_SCALED {
                return None;
            }
            scaled.entries.push(l_ij_d_j as i64);
            row.entries.push(l_ij as i64);
        }

        let s_ii = i128::from(given.entries[i - first]);
        let pivot = s_ii - i128::from(shift) - (dot(&scaled, &row) >> LOWER);
        let pivot = i64::try_from(pivot).ok()?;
        if pivot <= 0 {
            return None;
        }

        self.pivots.push(pivot);
        self.lower.push(row);
        Some(())
    }

    /// Demands that S - L D L', computed without rounding, is strictly diagonally dominant with a
    /// positive diagonal. `Err(i)`: row i is not, or a number does not fit.
    fn require_dominated(&self, s: &[MachineRow]) -> Result<(), usize> {
        let mut residual = Dominance::zero(s.len());
        for (i, row) in s.iter().enumerate() {
            let scaled = ScaledRow::of(&self.lower[i], &self.pivots).ok_or(i)?;
            for j in row.first..=i {
                let entry = self.residual(row, &scaled, i, j).ok_or(i)?;
                if entry.unsigned_abs() >> RESIDUAL_BITS > 0 {
                    return Err(i);
                }
                residual.add(i, j, entry);
            }
        }

        residual.first_undominated(true).map_or(Ok(()), Err)
    }

    /// s_ij - sum_(k < j) l_ik d_k l_jk - l_ij d_j; `scaled` is row i of L D.
    fn residual(&self, row: &MachineRow, scaled: &ScaledRow, i: usize, j: usize) -> Option<i128> {
        let l_ij_d_j = if i == j {
            i128::from(self.pivots[i]) << LOWER
        } else {
            scaled.entries[j - row.first]
        };
        let s_ij = i128::from(row.entries[j - row.first]) << LOWER;
        let l_j = &self.lower[j];

        (s_ij - dot(&scaled.high, l_j))
            .checked_mul(1 << LOWER)?
            .checked_sub(dot(&scaled.low, l_j))?
            .checked_sub(l_ij_d_j.checked_mul(1 << LOWER)?)
    }
}

/// A row of L D, exactly: the products l_ik d_k, split as high 2^LOWER + low so that sums of their
/// products fit into 128 bits.
struct ScaledRow {
    entries: Vec<i128>,
    high: MachineRow,
    low: MachineRow,
}

impl ScaledRow {
    fn of(row: &MachineRow, pivots: &[i64]) -> Option<ScaledRow> {
        let end = row.first + row.entries.len();
        let mut scaled = ScaledRow {
            entries: Vec::with_capacity(row.entries.len()),
            high: MachineRow::empty(row.first, end),
            low: MachineRow::empty(row.first, end),
        };
        for (l_ik, d_k) in row.entries.iter().zip(&pivots[row.first..]) {
            let product = i128::from(*l_ik) * i128::from(*d_k);
            let low = product & ((1 << LOWER) - 1);
            scaled.entries.push(product);
            scaled
                .high
                .entries
                .push(i64::try_from(product >> LOWER).ok()?);
            scaled.low.entries.push(i64::try_from(low).ok()?);
        }

        Some(scaled)
    }
}

/// sum a_k b_k over the columns that both hold. Below 2^120 by the bounds above: |l_ij d_j| < 2^49
/// in units of S, and l_ij is rounded towards 0, so that the high half of a product is no longer.
fn dot(a: &MachineRow, b: &MachineRow) -> i128 {
    let first = a.first.max(b.first);
    let mut sum = 0;
    for (a_k, b_k) in a.entries_from(first).iter().zip(b.entries_from(first)) {
        sum += i128::from(*a_k) * i128::from(*b_k);
    }

    sum
}

impl MachineRow {
    /// No entries, with room for those up to the column `end`.
    fn empty(first: usize, end: usize) -> MachineRow {
        MachineRow {
            first,
            entries: Vec::with_capacity(end - first),
        }
    }

    /// The entries of the columns from `column` on, none if the row ends before it.
    fn entries_from(&self, column: usize) -> &[i64] {
        let start = (column - self.first).min(self.entries.len());
        &self.entries[start..]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Integer;
    use num_traits::{One, ToPrimitive};

    fn rows(lower: &[&[i64]]) -> Vec<MachineRow> {
        lower
            .iter()
            .map(|entries| MachineRow {
                first: 0,
                entries: entries.to_vec(),
            })
            .collect()
    }

    /// The factors of one matrix prove nothing about another one: the exact residual notices.
    #[test]
    fn a_factorisation_of_another_matrix_is_not_dominated() {
        let one = 1 << (MACHINE_BITS - 4);
        let chain = |corner: i64, diagonal: i64| {
            rows(&[&[diagonal], &[-one, diagonal], &[corner, -one, diagonal]])
        };
        let good = chain(0, 2 * one);

        let factors = Factors::of(&good, 1 << 20).unwrap();

        assert_eq!(factors.require_dominated(&good), Ok(()));
        let less = chain(0, 2 * one - (1 << 21));
        assert_eq!(factors.require_dominated(&less), Err(0));
        let beside = chain(1 << 21, 2 * one);
        assert_eq!(factors.require_dominated(&beside), Err(0));
    }

    #[test]
    fn numbers_out_of_bounds_are_refused() {
        let limit = 1i64 << MACHINE_BITS;
        assert_eq!(machine_definite(&rows(&[&[limit]]), 1), Ok(()));
        assert_eq!(machine_definite(&rows(&[&[limit + 1]]), 1), Err(0));
        assert_eq!(machine_definite(&rows(&[&[-i64::MAX]]), 1), Err(0));
        // Definite, but l_10 = 2^21 is above what a factor may be.
        let long = rows(&[&[2], &[1 << 21, limit]]);
        assert_eq!(machine_definite(&long, 1), Err(1));
        let misshapen = [MachineRow {
            first: 1,
            entries: vec![5],
        }];
        assert_eq!(machine_definite(&misshapen, 1), Err(0));
        let many = vec![rows(&[&[1]])[0].clone(); MAX_ORDER + 1];
        assert_eq!(machine_definite(&many, 0), Err(0));
    }

    #[test]
    fn dominance_counts_an_entry_for_both_its_rows() {
        let mut e = Dominance::zero(3);
        for (i, j, entry) in [
            (0, 0, 3),
            (1, 0, -1),
            (1, 1, 4),
            (2, 0, 2),
            (2, 1, 3),
            (2, 2, 5),
        ] {
            e.add(i, j, entry);
        }

        assert_eq!(e.first_undominated(false), None);
        assert_eq!(e.first_undominated(true), Some(0));
        e.add(0, 0, 4);
        e.add(2, 2, 4);
        assert_eq!(e.first_undominated(false), Some(2));
        assert_eq!(e.first_undominated(true), Some(1));
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
        let quarter = 1i64 << (MACHINE_BITS - 2);
        let pivots = (0..3).map(|_| quarter + random.next(quarter / 4)).collect();
        let lower = (0..3)
            .map(|i| MachineRow {
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
        let mut seen = [0; 2];

        for _ in 0..300 {
            let factors = random_factors(&mut random);
            let mut s = Vec::new();
            for i in 0..3 {
                let mut entries = Vec::new();
                for j in 0..=i {
                    let rounded = (product(&factors, i, j) >> (2 * LOWER)).to_i64().unwrap();
                    let more = if i == j {
                        2 + random.next(3)
                    } else {
                        random.next(1)
                    };
                    entries.push(rounded + more);
                }
                s.push(MachineRow { first: 0, entries });
            }

            let residual = |i: usize, j: usize| {
                Integer::from(s[i].entries[j]) * &one - product(&factors, i, j)
            };
            let is_row_dominated = |i: usize| {
                let off_diagonal: Integer = (0..3)
                    .filter(|&j| j != i)
                    .map(|j| residual(i.max(j), i.min(j)).abs())
                    .sum();
                residual(i, i) > off_diagonal
            };
            let expected = (0..3).find(|&i| !is_row_dominated(i));

            assert_eq!(factors.require_dominated(&s).err(), expected);
            seen[usize::from(expected.is_none())] += 1;
        }

        assert!(seen[0] > 50 && seen[1] > 10, "{seen:?}");
    }
}
