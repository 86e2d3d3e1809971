//! Is the symmetric part of every matrix within R of M positive definite?
//!
//! Let S = 2 sym(M), cut to 40 bits, and let c_i be what the radius and the cutting may take away
//! from row i: the row sum of R + R' and one unit per entry that was cut. Every matrix of the
//! family is S + C with |C|_ii + sum_(j not i) |C_ij| <= c_i, so it is definite if S - diag(c) is
//! (Gershgorin).
//!
//! That is decided in machine integers (`mceip_exact::machine_definite`). A small matrix that is
//! too close to a singular one for that is decided by its leading minors, without a margin.
//!
//! Called by `definite`: `positive_definite` with short numbers, `long_definite` with the long
//! ones.

use super::ball::BallMatrix;
use super::ends::{LongMatrix, largest_bits};
use super::short::Short;
use mceip_exact::{Integer, MachineRow, first_minor_not_positive, machine_definite};
use num_integer::Integer as _;
use num_traits::{One, Zero};

/// Bits kept of S.
const BITS: u32 = 40;
/// The shift in units of the cut S, per row: above the rounding of L times the largest pivot.
const SHIFT: i64 = 1 << 8;

/// Up to this order, and with entries of so many bits, a matrix is decided without a margin.
const MAX_EXACT_ORDER: usize = 12;
const MAX_EXACT_BITS: u64 = 1024;

/// Is `sign` sym(M) definite on `variables`, whatever the radius takes away?
///
/// `Err(k)`: the k-th of the variables breaks it, or the matrix is too large and too close to a
/// singular one to say.
pub(super) fn long_definite(
    matrix: &BallMatrix<Integer>,
    variables: &[usize],
    sign: i8,
) -> Result<(), usize> {
    // The principal part is cut by itself: it may be small beside the rest.
    let verdict = match Short::of(&matrix.m, &matrix.r, variables) {
        Some(block) => {
            let all: Vec<usize> = (0..variables.len()).collect();
            positive_definite(&block, &all, sign)
        }
        None => Err(0),
    };
    if verdict.is_ok() || variables.len() > MAX_EXACT_ORDER {
        return verdict;
    }

    let least = primitive(least_member(matrix, variables, sign));
    if largest_bits(least.iter().flatten()) > MAX_EXACT_BITS {
        verdict
    } else {
        match first_minor_not_positive(least) {
            None => Ok(()),
            Some(minor) => Err(minor.index),
        }
    }
}

/// 2 `sign` sym(M) on `variables`, less the row sums of twice the symmetric radius on its diagonal.
fn least_member(matrix: &BallMatrix<Integer>, variables: &[usize], sign: i8) -> LongMatrix {
    let BallMatrix { m, r } = matrix;
    let mut least = LongMatrix::with_capacity(variables.len());

    for (position, &i) in variables.iter().enumerate() {
        let mut row = Vec::with_capacity(variables.len());
        let mut radius = Integer::zero();
        for &j in variables {
            row.push((&m[i][j] + &m[j][i]) * sign);
            radius += &r[i][j] + &r[j][i];
        }

        row[position] -= radius;
        least.push(row);
    }

    least
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

/// The same as [`long_definite`] for short numbers.
///
/// `Err(k)`: the k-th of the variables breaks it, or the matrix is too close to a singular one to
/// say.
pub(super) fn positive_definite(t: &Short, variables: &[usize], sign: i8) -> Result<(), usize> {
    let shift = SHIFT * variables.len() as i64;
    machine_definite(&least_lower_triangle(t, variables, sign), shift)
}

/// The lower triangle of S - diag(c), cut to `BITS` bits and a sign.
fn least_lower_triangle(t: &Short, variables: &[usize], sign: i8) -> Vec<MachineRow> {
    let mut largest: u64 = 0;
    for &i in variables {
        for &j in variables {
            largest |= t.entries.m[i][j].unsigned_abs();
        }
    }

    let bits_of_twice = u64::BITS - largest.leading_zeros() + 1;
    let cut = bits_of_twice.saturating_sub(BITS);

    let mut lower = Vec::with_capacity(variables.len());
    for (position, &i) in variables.iter().enumerate() {
        let mut row = Vec::with_capacity(position + 1);
        for &j in &variables[..=position] {
            let twice = i128::from(t.entries.m[i][j]) + i128::from(t.entries.m[j][i]);
            // Of BITS bits, whatever is cut.
            row.push(((twice * i128::from(sign)) >> cut) as i64);
        }

        row[position] -= slack(t, variables, i, cut);
        let first = row.iter().position(|entry| *entry != 0).unwrap_or(position);
        let entries = row.split_off(first);
        lower.push(MachineRow { first, entries });
    }

    lower
}

/// c_i: the radius of row i, cut and rounded up, and one unit for every entry that was cut.
fn slack(t: &Short, variables: &[usize], i: usize, cut: u32) -> i64 {
    let mut radius: i128 = 0;
    for &j in variables {
        radius += i128::from(t.entries.r[i][j]) + i128::from(t.entries.r[j][i]);
    }

    let rounded_up = (radius >> cut) + i128::from(radius > 0 && cut > 0);
    let lost = if cut > 0 { variables.len() as i64 } else { 0 };
    // A radius of 2^60 is far more than S itself: nothing is definite then.
    rounded_up.min(1 << 60) as i64 + lost
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a leaf does it: cut to what may move.
    fn positive_definite(
        m: &LongMatrix,
        r: &LongMatrix,
        moving: &[usize],
        sign: i8,
    ) -> Result<(), usize> {
        let all: Vec<usize> = (0..moving.len()).collect();
        super::positive_definite(&Short::of(m, r, moving).ok_or(0usize)?, &all, sign)
    }

    fn matrix(rows: &[&[i64]]) -> LongMatrix {
        rows.iter()
            .map(|r| r.iter().map(|&v| Integer::from(v) << 64).collect())
            .collect()
    }

    fn of(m: &LongMatrix, r: LongMatrix) -> BallMatrix<Integer> {
        BallMatrix { m: m.clone(), r }
    }

    fn zero(n: usize) -> LongMatrix {
        vec![vec![Integer::zero(); n]; n]
    }

    #[test]
    fn definite_indefinite_and_singular() {
        // Not symmetric: the symmetric part is [[2, 1], [1, 2]].
        let m = matrix(&[&[2, 5], &[-3, 2]]);
        assert_eq!(positive_definite(&m, &zero(2), &[0, 1], 1), Ok(()));
        assert_eq!(positive_definite(&m, &zero(2), &[0, 1], -1), Err(0));
        let singular = matrix(&[&[1, 1], &[1, 1]]);
        assert_eq!(positive_definite(&singular, &zero(2), &[0, 1], 1), Err(1));
        let indefinite = matrix(&[&[1, 0, 3], &[0, 9, 0], &[1, 0, 3]]);
        assert_eq!(
            positive_definite(&indefinite, &zero(3), &[0, 1, 2], 1),
            Err(2)
        );
        assert_eq!(positive_definite(&indefinite, &zero(3), &[0, 1], 1), Ok(()));
        assert_eq!(
            positive_definite(&matrix(&[&[-2]]), &zero(1), &[0], -1),
            Ok(())
        );
    }

    #[test]
    fn the_radius_is_taken_off() {
        let m = matrix(&[&[2, 1], &[1, 2]]); // smallest eigenvalue 1
        let radius = |v: i64| vec![vec![Integer::from(v) << 60; 2]; 2]; // row sum 2 v / 16
        assert_eq!(positive_definite(&m, &radius(7), &[0, 1], 1), Ok(()));
        assert!(positive_definite(&m, &radius(9), &[0, 1], 1).is_err());
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
            assert!(
                positive_definite(&near(e), &zero(2), &[0, 1], 1).is_err(),
                "{e}"
            );
        }
    }

    /// Both diagonal entries, the radius of the lower row, and what must hold at the edge: with
    /// `cut` bits cut off S = 2 m, row 1 needs S_11 - slack > 2 SHIFT.
    fn two(m: [i64; 2], r: [[i64; 2]; 2]) -> Result<(), usize> {
        let m = vec![
            vec![m[0].into(), Integer::zero()],
            vec![Integer::zero(), m[1].into()],
        ];
        let r = r
            .iter()
            .map(|row| row.map(Integer::from).to_vec())
            .collect();
        positive_definite(&m, &r, &[0, 1], 1)
    }

    #[test]
    fn the_slack_is_counted_to_the_last_unit() {
        let none = [[0, 0], [0, 0]];
        // Nothing is cut: S = 2 m, the slack is the radius alone.
        let short = 1 << 30;
        assert_eq!(
            [two([short, 257], none), two([short, 256], none)],
            [Ok(()), Err(1)]
        );
        let r = [[0, 3], [5, 4]]; // each radius becomes two more as a short one: 5 + 7 + 2 * 6 = 24
        assert_eq!(
            [two([short, 269], r), two([short, 268], r)],
            [Ok(()), Err(1)]
        );
        let r = [[0, 3], [0, 4]]; // 5 + 2 * 6 = 17
        assert_eq!(
            [two([short, 265], r), two([short, 264], r)],
            [Ok(()), Err(1)]
        );
        // 12 bits are cut: every row loses two units by it, and one more where there is a radius.
        let (long, unit) = (1 << 50, 1 << 11); // 2 unit = 2^12
        assert_eq!(
            [
                two([long, 515 * unit], none),
                two([long, 515 * unit - 1], none)
            ],
            [Ok(()), Err(1)]
        );
        let r = [[0, 3 << 12], [2 << 12, 1 << 12]]; // 7 units of 2^12
        assert_eq!(
            [two([long, 523 * unit], r), two([long, 523 * unit - 1], r)],
            [Ok(()), Err(1)]
        );
        let r = [[0, 0], [1, 0]]; // less than a unit
        assert_eq!(
            [two([long, 516 * unit], r), two([long, 516 * unit - 1], r)],
            [Ok(()), Err(1)]
        );
    }

    /// Bits are cut off S so that 41 are left: one bit more of the largest entry is one bit less of
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
                [Ok(()), Err(1)],
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
        assert_eq!(positive_definite(&m, &zero(4), &[0, 1, 2, 3], 1), Err(3));
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

        assert_eq!(
            positive_definite(&m, &zero(2), &[0, 1], 1),
            Err(1),
            "the margin is too small for short numbers"
        );
        assert_eq!(long_definite(&of(&m, zero(2)), &[0, 1], 1), Ok(()));
        assert_eq!(long_definite(&of(&singular, zero(2)), &[0, 1], 1), Err(1));

        // A radius of r e at the first entry leaves the determinant (2 - r) e - e^2.
        assert_eq!(long_definite(&of(&m, radius(1)), &[0, 1], 1), Ok(()));
        assert_eq!(long_definite(&of(&m, radius(2)), &[0, 1], 1), Err(1));

        let negative: LongMatrix = m
            .iter()
            .map(|row| row.iter().map(|v| -v).collect())
            .collect();
        assert_eq!(
            [
                long_definite(&of(&negative, zero(2)), &[0, 1], -1),
                long_definite(&of(&m, zero(2)), &[0, 1], -1)
            ],
            [Ok(()), Err(0)]
        );
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
            long_definite(
                &of(&tight(n, bits), zero(n)),
                &(0..n).collect::<Vec<_>>(),
                1,
            )
        };

        // Twice the entries, without their factor of two: 2^b has b + 1 bits.
        assert_eq!(
            [decide(12, 1023), decide(12, 1024), decide(13, 90)],
            [Ok(()), Err(1), Err(1)]
        );
    }
}
