//! Is sym(DT) positive definite for every matrix T within R of M?
//!
//! D is diagonal. Let S = 2 sym(DM) with the row sums of |D|R + R'|D| taken off its diagonal. Twice
//! the symmetric part of DT is S + C with C_ii >= sum_(j not i) |C_ij|, so it is definite if S is
//! (Gershgorin).
//!
//! That is decided for S cut to 40 bits, with one unit taken off the diagonal for each entry of a
//! row that was cut, in machine integers (`mceip_exact::machine_definite`). A small matrix that is
//! too close to a singular one for that is decided by its leading minors, without a margin.
//!
//! Called by `definite`.

use super::ball::BallMatrix;
use super::definite::Definite;
use super::ends::{LongMatrix, largest_bits};
use mceip_exact::{Integer, MachineRow, first_minor_not_positive, machine_definite};
use num_integer::Integer as _;
use num_traits::{One, ToPrimitive, Zero};

/// Bits kept of S.
const BITS: u64 = 40;
/// The shift in units of the cut S, per row: above the rounding of L times the largest pivot.
const SHIFT: i64 = 1 << 8;

/// Up to this order, and with entries of so many bits, a matrix is decided without a margin.
const MAX_EXACT_ORDER: usize = 12;
const MAX_EXACT_BITS: u64 = 1024;

/// DT + T'D for every T of a ball.
pub(super) struct WeightedSum<'a> {
    pub(super) matrix: &'a BallMatrix<Integer>,
    /// D.
    pub(super) diagonal: Definite<'a>,
}

impl WeightedSum<'_> {
    /// Entry (i, j) of DM + M'D.
    fn middle(&self, i: usize, j: usize) -> Integer {
        let m = &self.matrix.m;
        &m[i][j] * self.diagonal.weight(i) + &m[j][i] * self.diagonal.weight(j)
    }

    /// Entry (i, j) of |D|R + R'|D|.
    ///
    /// Soundness hangs on the moduli: a negative weight takes no radius back.
    fn radius(&self, i: usize, j: usize) -> Integer {
        let r = &self.matrix.r;
        let size = |i| self.diagonal.weight(i).unsigned_abs();
        &r[i][j] * size(i) + &r[j][i] * size(j)
    }

    /// Is it exactly zero on these variables, with zero radius?
    pub(super) fn is_zero(&self, variables: &[usize]) -> bool {
        let mut pairs = variables
            .iter()
            .flat_map(|&i| variables.iter().map(move |&j| (i, j)));
        pairs.all(|(i, j)| self.middle(i, j).is_zero() && self.radius(i, j).is_zero())
    }

    /// S on these variables: the middle, less the row sums of the radius on its diagonal.
    fn least_member(&self, variables: &[usize]) -> LongMatrix {
        let mut least = LongMatrix::with_capacity(variables.len());
        for (position, &i) in variables.iter().enumerate() {
            let mut row: Vec<Integer> = variables.iter().map(|&j| self.middle(i, j)).collect();
            let radius: Integer = variables.iter().map(|&j| self.radius(i, j)).sum();
            row[position] -= radius;
            least.push(row);
        }

        least
    }
}

/// The first of the variables at which the least member of the sum is not definite on them, or at
/// which that is too large and too close to a singular one to say.
pub(super) fn first_not_definite(sum: &WeightedSum<'_>, variables: &[usize]) -> Option<usize> {
    let least = sum.least_member(variables);
    let shift = SHIFT * variables.len() as i64;
    let broken = machine_definite(&cut_lower_triangle(&least), shift).err()?;
    if variables.len() > MAX_EXACT_ORDER {
        return Some(broken);
    }

    let least = primitive(least);
    if largest_bits(least.iter().flatten()) > MAX_EXACT_BITS {
        return Some(broken);
    }

    first_minor_not_positive(least).map(|minor| minor.index)
}

/// Divides by the common factor: the unit of the ends may be a small part of every entry.
fn primitive(mut s: LongMatrix) -> LongMatrix {
    let mut factor = Integer::zero();
    for entry in s.iter().flatten() {
        factor = factor.gcd(entry);
    }

    if factor > Integer::one() {
        for entry in s.iter_mut().flatten() {
            *entry /= &factor;
        }
    }

    s
}

/// The lower triangle of S, cut to `BITS` bits, and less on its diagonal by what that may cost.
fn cut_lower_triangle(s: &LongMatrix) -> Vec<MachineRow> {
    let cut = largest_bits(s.iter().flatten()).saturating_sub(BITS);
    let lost = if cut > 0 { s.len() as i64 } else { 0 };

    let mut lower = Vec::with_capacity(s.len());
    for (i, row) in s.iter().enumerate() {
        let mut entries = Vec::with_capacity(i + 1);
        for entry in &row[..=i] {
            entries.extend((entry >> cut).to_i64()); // fits
        }

        entries[i] -= lost;
        lower.push(MachineRow { first: 0, entries });
    }

    lower
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of M with the radius R, on these variables.
    fn verdict(m: &LongMatrix, r: &LongMatrix, variables: &[usize], sign: i8) -> Option<usize> {
        let matrix = BallMatrix {
            m: m.clone(),
            r: r.clone(),
        };
        let sum = WeightedSum {
            matrix: &matrix,
            diagonal: if sign < 0 {
                Definite::Negative
            } else {
                Definite::Positive
            },
        };
        first_not_definite(&sum, variables)
    }

    /// The same without the leading minors.
    fn machine_verdict(m: &LongMatrix, r: &LongMatrix) -> Option<usize> {
        let matrix = BallMatrix {
            m: m.clone(),
            r: r.clone(),
        };
        let all: Vec<usize> = (0..m.len()).collect();
        let sum = WeightedSum {
            matrix: &matrix,
            diagonal: Definite::Positive,
        };
        let lower = cut_lower_triangle(&sum.least_member(&all));
        machine_definite(&lower, SHIFT * m.len() as i64).err()
    }

    fn matrix(rows: &[&[i64]]) -> LongMatrix {
        rows.iter()
            .map(|r| r.iter().map(|&v| Integer::from(v) << 64).collect())
            .collect()
    }

    fn zero(n: usize) -> LongMatrix {
        vec![vec![Integer::zero(); n]; n]
    }

    #[test]
    fn definite_indefinite_and_singular() {
        // Not symmetric: the symmetric part is [[2, 1], [1, 2]].
        let m = matrix(&[&[2, 5], &[-3, 2]]);
        assert_eq!(verdict(&m, &zero(2), &[0, 1], 1), None);
        assert_eq!(verdict(&m, &zero(2), &[0, 1], -1), Some(0));
        let singular = matrix(&[&[1, 1], &[1, 1]]);
        assert_eq!(verdict(&singular, &zero(2), &[0, 1], 1), Some(1));
        let indefinite = matrix(&[&[1, 0, 3], &[0, 9, 0], &[1, 0, 3]]);
        assert_eq!(verdict(&indefinite, &zero(3), &[0, 1, 2], 1), Some(2));
        assert_eq!(verdict(&indefinite, &zero(3), &[0, 1], 1), None);
        assert_eq!(verdict(&matrix(&[&[-2]]), &zero(1), &[0], -1), None);
    }

    #[test]
    fn the_radius_is_taken_off() {
        let m = matrix(&[&[2, 1], &[1, 2]]); // smallest eigenvalue 1
        let radius = |v: i64| vec![vec![Integer::from(v) << 60; 2]; 2]; // row sum 2 v / 16
        assert_eq!(machine_verdict(&m, &radius(7)), None);
        assert!(machine_verdict(&m, &radius(9)).is_some());
    }

    #[test]
    fn nearly_singular_is_never_accepted() {
        let near = |e: u32| {
            let one = Integer::from(1) << 200u32;
            vec![
                vec![one.clone(), one.clone()],
                vec![one.clone(), one.clone() - (Integer::from(1) << (200 - e))],
            ]
        };
        for e in [20, 39, 40, 60, 100] {
            let m = near(e);
            assert!(machine_verdict(&m, &zero(2)).is_some(), "{e}");
            assert_eq!(verdict(&m, &zero(2), &[0, 1], 1), Some(1), "{e}");
        }
    }

    /// Both diagonal entries and the radius: S = 2 m less the row sums of R + R'. Cut, row 1 needs
    /// S_11 > 2 SHIFT, and two units more if something was cut.
    fn two(m: [i64; 2], r: [[i64; 2]; 2]) -> Option<usize> {
        let m = vec![
            vec![m[0].into(), Integer::zero()],
            vec![Integer::zero(), m[1].into()],
        ];
        let r = r
            .iter()
            .map(|row| row.map(Integer::from).to_vec())
            .collect();
        machine_verdict(&m, &r)
    }

    #[test]
    fn what_is_taken_off_is_counted_to_the_last_unit() {
        let none = [[0, 0], [0, 0]];
        let edge = |first: i64, least: i64, r: [[i64; 2]; 2]| {
            assert_eq!(two([first, least], r), None, "{first} {least} {r:?}");
            assert_eq!(two([first, least - 1], r), Some(1), "{first} {least} {r:?}");
        };

        // Nothing is cut: S has 40 bits.
        let short = 1 << 38;
        edge(short, 257, none);
        edge(short, 265, [[0, 3], [5, 4]]); // row 1 loses 3 + 5 + 4 + 4
        edge(short, 262, [[0, 3], [0, 4]]);

        // 12 bits are cut from a diagonal of 52.
        let (long, unit) = ((1 << 50) + (1 << 20), 1 << 11);
        edge(long, 515 * unit, none);
        edge(long, 522 * unit, [[0, 3 << 12], [2 << 12, 1 << 12]]);
        edge(long, 515 * unit + 1, [[0, 0], [1, 0]]);
    }

    /// Bits are cut off S so that 40 are left: one bit more of the largest entry is one bit less of
    /// the others.
    #[test]
    fn what_is_cut_follows_the_largest_entry() {
        let none = [[0, 0], [0, 0]];
        for bits in [39, 40, 41, 45, 60] {
            let cut = (bits + 1u32).saturating_sub(40);
            let lost = if cut > 0 { 2 } else { 0 };
            let edge = (513 + lost) << cut;
            let half = |v: i64| (v + 1) / 2;
            assert_eq!(
                [
                    two([1 << (bits - 1), half(edge)], none),
                    two([1 << (bits - 1), half(edge) - 1], none)
                ],
                [None, Some(1)],
                "{bits}"
            );
        }
    }

    /// The factors of this matrix are all positive and hide an eigenvalue that is not: the residual
    /// tells.
    #[test]
    fn factors_that_do_not_multiply_out_prove_nothing() {
        let lower: [&[i64]; 4] = [
            &[1028],
            &[2, 1028],
            &[6160, 4662, 12_653_620],
            &[84_137, 63_657, 172_869_770, 4_528_399_482],
        ];
        // S = 2 sym(m)
        let entry = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Less => 0,
            std::cmp::Ordering::Equal => lower[i][j] / 2,
            std::cmp::Ordering::Greater => lower[i][j],
        };
        let m: LongMatrix = (0..4)
            .map(|i| (0..4).map(|j| Integer::from(entry(i, j))).collect())
            .collect();
        assert_eq!(machine_verdict(&m, &zero(4)), Some(3));
    }

    /// T = [[1, 1 - e], [1 - e, 1]] with e = 2^-90, far below any margin: definite, and not with a
    /// radius of e.
    #[test]
    fn small_matrices_are_decided_without_a_margin() {
        let one: Integer = Integer::one() << 90;
        let m = vec![vec![one.clone(), &one - 1], vec![&one - 1, one.clone()]];
        let singular = vec![
            vec![one.clone(), one.clone()],
            vec![one.clone(), one.clone()],
        ];
        let radius = |v: i64| {
            vec![
                vec![Integer::from(v), Integer::zero()],
                vec![Integer::zero(), Integer::zero()],
            ]
        };

        // The margin is too small for machine integers.
        assert_eq!(machine_verdict(&m, &zero(2)), Some(1));
        assert_eq!(verdict(&m, &zero(2), &[0, 1], 1), None);
        assert_eq!(verdict(&singular, &zero(2), &[0, 1], 1), Some(1));

        // A radius of r e at the first entry leaves the determinant (2 - r) e - e^2.
        assert_eq!(verdict(&m, &radius(1), &[0, 1], 1), None);
        assert_eq!(verdict(&m, &radius(2), &[0, 1], 1), Some(1));

        let negative: LongMatrix = m
            .iter()
            .map(|row| row.iter().map(|v| -v).collect())
            .collect();
        assert_eq!(verdict(&negative, &zero(2), &[0, 1], -1), None);
        assert_eq!(verdict(&m, &zero(2), &[0, 1], -1), Some(0));
    }

    /// Beyond the largest order of elimination, or its longest entries, the margin is asked for.
    #[test]
    fn elimination_has_limits() {
        let tight = |n: usize, bits: u64| -> LongMatrix {
            let one: Integer = Integer::one() << bits;
            let entry = |i: usize, j: usize| match (i, j) {
                (0, 1) | (1, 0) => &one - 1,
                _ if i == j => one.clone(),
                _ => Integer::zero(),
            };
            (0..n)
                .map(|i| (0..n).map(|j| entry(i, j)).collect())
                .collect()
        };
        let decide = |n: usize, bits: u64| {
            let all: Vec<usize> = (0..n).collect();
            verdict(&tight(n, bits), &zero(n), &all, 1)
        };

        // Twice the entries, without their factor of two: 2^b has b + 1 bits.
        assert_eq!(
            [decide(12, 1023), decide(12, 1024), decide(13, 90)],
            [None, Some(1), Some(1)]
        );
    }
}
