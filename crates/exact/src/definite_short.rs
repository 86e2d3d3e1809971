//! A first try at definiteness in machine integers, for large sparse matrices that are not close to
//! singular: the scheme of `definite` with 48 bits, A - sI = LDL' + E, the residual E computed
//! exactly.

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
    m.rows() <= MAX_ORDER
        && fixed(m).is_some_and(|a| {
            factor(&a).is_some_and(|(l, d)| is_dominated(m, &a, &l, &d) == Some(true))
        })
}

/// The lower triangle rounded down to the fixed unit.
fn fixed(m: &Sparse) -> Option<Vec<Row>> {
    let largest = (0..m.rows())
        .map(|i| m.get(i, i))
        .max()
        .filter(Signed::is_positive)?;
    // 2^bits > largest.
    let bits = largest.numer().bits() as i64 - largest.denom().bits() as i64 + 1;
    let power = |e: i64| Integer::one() << e.max(0).unsigned_abs();
    let (up, down) = (power(i64::from(UNIT) - bits), power(bits - i64::from(UNIT)));
    let round = |v: &Rational| {
        num_integer::Integer::div_floor(&(v.numer() * &up), &(v.denom() * &down)).to_i64()
    };
    let row = |i: usize| {
        let lower: Vec<&(usize, Rational)> = m.row(i).iter().filter(|e| e.0 <= i).collect();
        let first = lower.first().map_or(i, |e| e.0);
        let mut entries = vec![0; i + 1 - first];
        for (j, v) in lower {
            // |a_ij| is below the largest diagonal entry where the matrix is definite.
            entries[j - first] = round(v).filter(|v| v.abs() <= 1 << UNIT)?;
        }
        Some(Row { first, entries })
    };
    (0..m.rows()).map(row).collect()
}

/// L (without its unit diagonal) and D of A less the shift, rounded.
fn factor(a: &[Row]) -> Option<(Vec<Row>, Vec<i64>)> {
    let (mut l, mut d): (Vec<Row>, Vec<i64>) =
        (Vec::with_capacity(a.len()), Vec::with_capacity(a.len()));
    for (i, given) in a.iter().enumerate() {
        let first = given.first;
        let mut row = Row {
            first,
            entries: Vec::with_capacity(i - first),
        };
        let mut scaled = Row {
            first,
            entries: Vec::with_capacity(i - first),
        }; // l_ik d_k in units of A
        for j in first..i {
            let value = i128::from(given.entries[j - first]) - (dot(&scaled, &l[j]) >> LOWER);
            let entry = (value << LOWER) / i128::from(d[j]);
            if entry.abs() > MAX_LOWER || value.abs() > MAX_SCALED {
                return None;
            }
            scaled.entries.push(value as i64);
            row.entries.push(entry as i64);
        }
        let pivot = i128::from(given.entries[i - first])
            - i128::from(SHIFT)
            - (dot(&scaled, &row) >> LOWER);
        d.push(i64::try_from(pivot).ok().filter(|p| *p > 0)?);
        l.push(row);
    }
    Some((l, d))
}

/// sum a_k b_k over the columns that both hold. Below 2^120 by the bounds above.
fn dot(a: &Row, b: &Row) -> i128 {
    let first = a.first.max(b.first);
    let from = |r: &'_ Row| (first - r.first).min(r.entries.len());
    a.entries[from(a)..]
        .iter()
        .zip(&b.entries[from(b)..])
        .map(|(x, y)| i128::from(*x) * i128::from(*y))
        .sum()
}

/// Is A - LDL' diagonally dominant with a positive diagonal, whatever A's rounding took away?
fn is_dominated(m: &Sparse, a: &[Row], l: &[Row], d: &[i64]) -> Option<bool> {
    let n = a.len();
    // In units of A times 2^-2 LOWER. Every stored entry of A may be larger by one unit.
    let one = 1i128 << (2 * LOWER);
    let (mut diagonal, mut off) = (vec![0i128; n], vec![0i128; n]);
    for i in 0..n {
        // l_ik d_k = high 2^LOWER + low, exactly.
        let product = |(k, v): (usize, &i64)| i128::from(*v) * i128::from(d[l[i].first + k]);
        let parts: Vec<i128> = l[i].entries.iter().enumerate().map(product).collect();
        let part = |of: &dyn Fn(&i128) -> i128| -> Option<Row> {
            let entries: Option<Vec<i64>> =
                parts.iter().map(|p| i64::try_from(of(p)).ok()).collect();
            Some(Row {
                first: l[i].first,
                entries: entries?,
            })
        };
        let (high, low) = (part(&|p| p >> LOWER)?, part(&|p| p & ((1 << LOWER) - 1))?);
        for j in a[i].first..=i {
            // (LDL')_ij = sum over k < j, and l_ij d_j (d_i on the diagonal).
            let last = if i == j {
                i128::from(d[i]) << LOWER
            } else {
                parts[j - l[i].first]
            };
            let above = (i128::from(a[i].entries[j - a[i].first]) << LOWER) - dot(&high, &l[j]);
            let rest = above
                .checked_mul(1 << LOWER)?
                .checked_sub(dot(&low, &l[j]))?
                .checked_sub(last.checked_mul(1 << LOWER)?)?;
            if i == j {
                diagonal[i] = rest;
            } else {
                off[i] = off[i].checked_add(rest.abs())?;
                off[j] = off[j].checked_add(rest.abs())?;
            }
        }
    }
    // Off the diagonal rounding costs a unit an entry; the diagonal was rounded down.
    let lost = |i: usize| one * m.row(i).len() as i128;
    Some((0..n).all(|i| {
        off[i]
            .checked_add(lost(i))
            .is_some_and(|off| diagonal[i] > off)
    }))
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
        let (good, other) = (
            chain(12, whole(2), &whole(1)),
            chain(12, rational(19, 10), &whole(1)),
        );
        let (a, b) = (fixed(&good).unwrap(), fixed(&other).unwrap());
        let (l, d) = factor(&a).unwrap();
        assert_eq!(is_dominated(&good, &a, &l, &d), Some(true));
        assert_eq!(is_dominated(&other, &b, &l, &d), Some(false));
        let mut wrong = fixed(&good).unwrap();
        wrong[5].entries[0] += 1 << 30; // an entry off the diagonal, by 2^-18
        assert_eq!(is_dominated(&good, &wrong, &l, &d), Some(false));
    }

    /// The dominance by hand, in integers of any length: factors that are nearly right, so that
    /// units decide.
    #[test]
    fn dominance_is_decided_to_the_last_unit() {
        let (mut state, mut seen) = (88_172_645_463_325_252u64, [0; 2]);
        let mut next = |size: i64| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state % (2 * size as u64 + 1)) as i64 - size
        };
        for _ in 0..300 {
            // Diagonals 1, 1/2 + ..., entries below; everything a multiple of 2^-48.
            let unit = 1i64 << (UNIT - 1);
            let d: Vec<i64> = (0..3).map(|_| unit / 2 + next(unit / 8)).collect();
            let entry = |v: i64| vec![v];
            let l = [next(1 << 35), next(1 << 35), next(1 << 35)]; // l_10, l_20, l_21 below 1/2
            let rows = vec![
                Row {
                    first: 0,
                    entries: vec![],
                },
                Row {
                    first: 0,
                    entries: entry(l[0]),
                },
                Row {
                    first: 0,
                    entries: vec![l[1], l[2]],
                },
            ];
            let at = |i: usize, k: usize| -> Integer {
                if i == k {
                    Integer::one() << LOWER
                } else {
                    Integer::from(l[i + k - 1])
                }
            };
            let product = |i: usize, j: usize| -> Integer {
                (0..=j).map(|k| at(i, k) * d[k] * at(j, k)).sum()
            };
            let one = Integer::one() << (2 * LOWER);
            let a: Vec<Row> = (0..3)
                .map(|i| {
                    let rounded = |j: usize| {
                        (product(i, j) >> (2 * LOWER)).to_i64().unwrap()
                            + if i == j { 5 + next(3) } else { next(1) }
                    };
                    Row {
                        first: 0,
                        entries: (0..=i).map(rounded).collect(),
                    }
                })
                .collect();
            let m = Sparse::from_entries(
                3,
                3,
                (0..3)
                    .flat_map(|i| (0..3).map(move |j| (i, j, whole(1))))
                    .collect::<Vec<_>>(),
            );
            let rest = |i: usize, j: usize| Integer::from(a[i].entries[j]) * &one - product(i, j);
            let off = |i: usize| -> Integer {
                (0..3)
                    .filter(|&j| j != i)
                    .map(|j| rest(i.max(j), i.min(j)).abs())
                    .sum()
            };
            let expected = (0..3).all(|i| rest(i, i) > off(i) + &one * 3);
            assert_eq!(is_dominated(&m, &a, &rows, &d), Some(expected));
            seen[usize::from(expected)] += 1;
        }
        assert!(seen[0] > 50 && seen[1] > 10, "{seen:?}");
    }
}
