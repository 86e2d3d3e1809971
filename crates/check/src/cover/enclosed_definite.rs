//! Is the symmetric part of every matrix within R of M positive definite?
//!
//! Let S = 2 sym(M), cut to 40 bits, and let c_i be what the radius and the cutting may take away
//! from row i: the row sum of R + R' and one unit per entry that was cut. Every matrix of the
//! family is S + C with |C|_ii + sum_(j not i) |C_ij| <= c_i, so it is definite if S - diag(c) is
//! (Gershgorin).
//!
//! In machine integers: an LDL' of S - diag(c) - s I is computed with rounding, for a small shift
//! s. Then E = S - diag(c) - LDL' is computed exactly. If D > 0 and E is strictly diagonally
//! dominant with a positive diagonal, S - diag(c) = LDL' + E is definite. The shift makes room for
//! E; the factors may be anything, because only the exact residual decides.
//!
//! A small matrix that is too close to a singular one for that is decided by elimination in long
//! integers without a margin.
//!
//! Called by `definite`: `positive_definite` with short numbers, `long_definite` with the long
//! ones.

use super::ball::BallMatrix;
use super::ends::{Matrix, largest_bits};
use super::short::Short;
use mceip_exact::Integer;
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Bits kept of S.
const BITS: u32 = 40;
/// Fraction bits of L.
const UNIT: u32 = 34;
/// l_ik d_k is multiplied in two halves, the lower one of so many bits.
const HALF: u32 = 32;
/// The shift in units of the cut S, per row: above the rounding of L times the largest pivot.
const SHIFT: i128 = 1 << 8;
/// Bits of what is multiplied. Of a definite matrix nothing is longer: |l_ij|^2 d_j <= S_ii < 2^40
/// and d_j >= 1, so |l_ij| <= 2^20 and |l_ij d_j| <= 2^40.
const FACTOR_BITS: u32 = 57;
/// Order at which sums of products of such factors could leave 128 bits.
const MAX_ORDER: usize = 4096;

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
        eliminate(least)
    }
}

/// 2 `sign` sym(M) on `variables`, less the row sums of twice the symmetric radius on its diagonal.
fn least_member(matrix: &BallMatrix<Integer>, variables: &[usize], sign: i8) -> Matrix {
    let BallMatrix { m, r } = matrix;
    let mut least = Matrix::with_capacity(variables.len());

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
fn primitive(mut s: Matrix) -> Matrix {
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

/// Elimination without fractions (Bareiss): the pivots are the leading minors. `Err(k)`: minor k is
/// not positive.
fn eliminate(mut s: Matrix) -> Result<(), usize> {
    let n = s.len();
    let mut previous = Integer::one();

    for k in 0..n {
        let pivot = s[k][k].clone();
        if !pivot.is_positive() {
            return Err(k);
        }

        for i in k + 1..n {
            for j in k + 1..n {
                // The division is exact.
                s[i][j] = (&pivot * &s[i][j] - &s[i][k] * &s[k][j]) / &previous;
            }
        }

        previous = pivot;
    }

    Ok(())
}

/// The same as [`long_definite`] for short numbers.
///
/// `Err(k)`: the k-th of the variables breaks it, or the matrix is too close to a singular one to
/// say.
pub(super) fn positive_definite(t: &Short, variables: &[usize], sign: i8) -> Result<(), usize> {
    let order = variables.len();
    if order > MAX_ORDER {
        return Err(0);
    }

    let lower = least_lower_triangle(t, variables, sign);
    let shift = SHIFT * order as i128;
    let ldl = Ldl::of(&lower, shift)?;
    ldl.check_residual(&lower)
}

/// The lower triangle of S - diag(c), cut to `BITS` bits and a sign.
fn least_lower_triangle(t: &Short, variables: &[usize], sign: i8) -> Vec<Vec<i128>> {
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
            row.push((twice * i128::from(sign)) >> cut);
        }

        row[position] -= slack(t, variables, i, cut);
        lower.push(row);
    }

    lower
}

/// c_i: the radius of row i, cut and rounded up, and one unit for every entry that was cut.
fn slack(t: &Short, variables: &[usize], i: usize, cut: u32) -> i128 {
    let mut radius: i128 = 0;
    for &j in variables {
        radius += i128::from(t.entries.r[i][j]) + i128::from(t.entries.r[j][i]);
    }

    let rounded_up = (radius >> cut) + i128::from(radius > 0 && cut > 0);
    let lost = if cut > 0 { variables.len() as i128 } else { 0 };
    // A radius of 2^60 is far more than S itself: nothing is definite then.
    rounded_up.min(1 << 60) + lost
}

/// Rounded factors L D L'. Products are of two machine words, and their sums fit into two.
struct Ldl {
    rows: Vec<FactorRow>,
    d: Vec<i64>,
}

/// A row of L.
struct FactorRow {
    /// The column of the first entry that is not zero.
    first: usize,
    /// Up to the diagonal, in units of 2^-UNIT.
    entries: Vec<i64>,
}

impl Ldl {
    /// Factors the matrix less the shift. `Err(i)`: row i has no positive pivot.
    ///
    /// A factor of more than [`FACTOR_BITS`] bits means that the matrix is not definite, or hardly.
    fn of(lower: &[Vec<i128>], shift: i128) -> Result<Ldl, usize> {
        let mut ldl = Ldl {
            rows: Vec::with_capacity(lower.len()),
            d: Vec::with_capacity(lower.len()),
        };
        for (i, given) in lower.iter().enumerate() {
            ldl.push_row(given, shift).ok_or(i)?;
        }

        Ok(ldl)
    }

    /// Appends a row of L and its pivot; `None` if that is not positive or a factor is too long.
    fn push_row(&mut self, given: &[i128], shift: i128) -> Option<()> {
        let i = given.len() - 1;
        let first = given.iter().position(|entry| *entry != 0).unwrap_or(i);
        let mut entries: Vec<i64> = Vec::with_capacity(i + 1);
        let mut scaled: Vec<i64> = Vec::with_capacity(i); // l_ik d_k in units of 1

        for (j, row) in self.rows.iter().enumerate() {
            let from = first.max(row.first).min(j);
            let rest = (given[j] << UNIT) - dot(&scaled[from..], &row.entries[from..j]);
            entries.push(factor(rest / i128::from(self.d[j]))?);
            scaled.push(factor(rest >> UNIT)?);
        }

        let rest = ((given[i] - shift) << UNIT) - dot(&scaled, &entries);
        let pivot = factor(rest >> UNIT)?;
        if pivot <= 0 {
            return None;
        }

        entries.push(1 << UNIT);
        self.rows.push(FactorRow { first, entries });
        self.d.push(pivot);
        Some(())
    }

    /// Demands that the matrix less L D L', computed without rounding, is strictly diagonally
    /// dominant with a positive diagonal. `Err(i)`: row i is not, or overflows.
    fn check_residual(&self, lower: &[Vec<i128>]) -> Result<(), usize> {
        let n = lower.len();
        let mut diagonal = vec![0i128; n];
        let mut off_diagonal = vec![0i128; n];

        for i in 0..n {
            let scaled = self.scaled_row(i).ok_or(i)?;
            for j in 0..=i {
                let residual = self.residual(lower[i][j], &scaled, j).ok_or(i)?;

                if i == j {
                    diagonal[i] = residual;
                } else {
                    off_diagonal[i] = off_diagonal[i].saturating_add(residual.abs());
                    off_diagonal[j] = off_diagonal[j].saturating_add(residual.abs());
                }
            }
        }

        for i in 0..n {
            if diagonal[i] <= off_diagonal[i] {
                return Err(i);
            }
        }

        Ok(())
    }

    /// Row i of L D; `None` if an entry is too long.
    fn scaled_row(&self, i: usize) -> Option<ScaledRow> {
        let row = &self.rows[i];
        let mut scaled = ScaledRow {
            first: row.first,
            high: Vec::with_capacity(i + 1),
            low: Vec::with_capacity(i + 1),
        };

        for (&entry, &pivot) in row.entries.iter().zip(&self.d) {
            let value = product(entry, pivot);
            scaled.high.push(factor(value >> HALF)?);
            scaled.low.push(factor(value & ((1 << HALF) - 1))?);
        }

        Some(scaled)
    }

    /// given - (L D L')_ij for j <= i, in units of 2^-(2 UNIT); `scaled` is row i of L D.
    fn residual(&self, given: i128, scaled: &ScaledRow, j: usize) -> Option<i128> {
        let row = &self.rows[j];
        let from = scaled.first.max(row.first).min(j);
        let entries = &row.entries[from..];
        let high = dot(&scaled.high[from..=j], entries);
        let low = dot(&scaled.low[from..=j], entries);

        let sum = high.checked_mul(1 << HALF)?.checked_add(low)?;
        given.checked_mul(1 << (2 * UNIT))?.checked_sub(sum)
    }
}

/// A row of L D in units of 2^-UNIT, exact: high 2^HALF + low, with 0 <= low < 2^HALF.
struct ScaledRow {
    /// The column of the first entry that is not zero.
    first: usize,
    high: Vec<i64>,
    low: Vec<i64>,
}

/// The sum of products of factors, of [`MAX_ORDER`] at most.
fn dot(a: &[i64], b: &[i64]) -> i128 {
    let mut sum: i128 = 0;
    for (&a, &b) in a.iter().zip(b) {
        sum += product(a, b);
    }

    sum
}

/// A factor of at most [`FACTOR_BITS`] bits.
fn factor(value: i128) -> Option<i64> {
    if value.unsigned_abs() >> FACTOR_BITS > 0 {
        return None;
    }

    i64::try_from(value).ok()
}

/// The product of two machine words.
fn product(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a leaf does it: cut to what may move.
    fn positive_definite(m: &Matrix, r: &Matrix, moving: &[usize], sign: i8) -> Result<(), usize> {
        let all: Vec<usize> = (0..moving.len()).collect();
        super::positive_definite(&Short::of(m, r, moving).ok_or(0usize)?, &all, sign)
    }

    fn matrix(rows: &[&[i64]]) -> Matrix {
        rows.iter()
            .map(|r| r.iter().map(|&v| Integer::from(v) << 64).collect())
            .collect()
    }

    fn of(m: &Matrix, r: Matrix) -> BallMatrix<Integer> {
        BallMatrix { m: m.clone(), r }
    }

    fn zero(n: usize) -> Matrix {
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
        let lower: [&[i128]; 4] = [
            &[1028],
            &[2, 1028],
            &[6160, 4662, 12_653_620],
            &[84_137, 63_657, 172_869_770, 4_528_399_482],
        ];
        let lower: Vec<Vec<i128>> = lower.iter().map(|row| row.to_vec()).collect();
        let factors = Ldl::of(&lower, SHIFT * 4);
        assert_eq!(factors.and_then(|ldl| ldl.check_residual(&lower)), Err(3));
        // S = 2 sym(m)
        let entry = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Less => 0,
            std::cmp::Ordering::Equal => lower[i][j] / 2,
            std::cmp::Ordering::Greater => lower[i][j],
        };
        let m: Matrix = (0..4)
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

        let negative: Matrix = m
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
        let tight = |n: usize, bits: u64| -> Matrix {
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

    /// By hand the minors are 6, 27 and 27 corner - 54: the last is zero at corner 2.
    #[test]
    fn pivots_of_the_elimination_are_the_minors() {
        let of = |corner: i64| {
            let rows = [[6, -3, 0], [-3, 6, -3], [0, -3, corner]];
            rows.map(|row| row.map(Integer::from).to_vec()).to_vec()
        };
        assert_eq!(
            [
                eliminate(of(6)),
                eliminate(of(3)),
                eliminate(of(2)),
                eliminate(of(1))
            ],
            [Ok(()), Ok(()), Err(2), Err(2)]
        );
    }

    #[test]
    fn the_largest_order_is_still_decided() {
        // One variable many times over is singular: row 1 says so, and row 0 beyond the largest
        // order.
        let one = Short::of(&matrix(&[&[1]]), &zero(1), &[0]).unwrap();
        assert_eq!(super::positive_definite(&one, &[0; MAX_ORDER], 1), Err(1));
        assert_eq!(
            super::positive_definite(&one, &[0; MAX_ORDER + 1], 1),
            Err(0)
        );
    }
}
