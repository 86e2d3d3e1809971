//! The product of a matrix of long integers and one of short integers, exactly.
//!
//! The entries of the pencil are long and those of W and V short, as a rule below 2^62
//! ([`IntegerRow`]). So an entry of the left factor is cut into digits of 32 bits that have its
//! sign,
//!
//! ```text
//!     v = sum_k v_k 2^(32 k),    |v_k| < 2^32,
//! ```
//!
//! and for each k the sum of v_k w over a row and a column is formed in 128 bits, which hold 2^33
//! such products. Where an entry of the right factor is longer, or one of the left factor has many
//! digits, the sums are formed in long integers; the result is the same. Called by `condensed`.

use super::ends::{LongMatrix, largest_bits};
use crate::certificate::IntegerRow;
use crate::pencil::Row;
use mceip_exact::Integer;
use num_traits::{Signed, Zero};

/// Bits of a digit.
const DIGIT_BITS: u32 = 32;
/// Rows of the left factor with at most this many digits are cut: to join the digits takes time
/// with the square of their number.
const MOST_DIGITS: u64 = 64;

/// Rows of a matrix linear in t or d: column, constant, coefficient.
pub(super) type Linear = Vec<Row>;

/// Rows of a matrix: column and entry, of those that are not zero.
pub(super) type NonzeroRows<'a> = Vec<Vec<(usize, &'a Integer)>>;

/// One of the two coefficients of a matrix linear in d.
#[derive(Clone, Copy)]
pub(super) enum LinearPart {
    /// At d = 0.
    Constant,
    /// Of d.
    Linear,
}

/// One part of a matrix linear in d.
pub(super) fn part_of(matrix: &Linear, part: LinearPart) -> NonzeroRows<'_> {
    matrix.iter().map(|row| row_of(row, part)).collect()
}

/// One part of a row of such a matrix.
pub(super) fn row_of(row: &Row, part: LinearPart) -> Vec<(usize, &Integer)> {
    let entries = row.iter().map(|(column, constant, linear)| match part {
        LinearPart::Constant => (*column, constant),
        LinearPart::Linear => (*column, linear),
    });

    entries.filter(|(_, entry)| !entry.is_zero()).collect()
}

/// The transpose of a dense matrix with `columns` columns.
pub(super) fn transposed(matrix: &LongMatrix, columns: usize) -> NonzeroRows<'_> {
    let mut rows = vec![Vec::new(); columns];
    for (i, row) in matrix.iter().enumerate() {
        for (transposed_row, entry) in rows.iter_mut().zip(row) {
            if !entry.is_zero() {
                transposed_row.push((i, entry));
            }
        }
    }

    rows
}

/// The product with a matrix that has `columns` columns.
pub(super) fn times(left: &NonzeroRows<'_>, right: &[IntegerRow], columns: usize) -> LongMatrix {
    let mut product = LongMatrix::with_capacity(left.len());
    for row in left {
        product.push(row_times(row, right, columns));
    }

    product
}

/// One row of such a product.
pub(super) fn row_times(
    row: &[(usize, &Integer)],
    right: &[IntegerRow],
    columns: usize,
) -> Vec<Integer> {
    let digits = digits_of(row);
    let short_rows = row.iter().map(|(g, _)| right[*g].as_short());
    let short_rows: Option<Vec<&[i64]>> = short_rows.collect();

    match short_rows {
        Some(short_rows) if digits <= MOST_DIGITS => {
            row_by_digits(row, digits, &short_rows, columns)
        }
        _ => long_row(row, right, columns),
    }
}

/// Digits of the longest entry.
fn digits_of(row: &[(usize, &Integer)]) -> u64 {
    let bits = largest_bits(row.iter().map(|(_, entry)| *entry));
    bits.div_ceil(DIGIT_BITS.into())
}

/// A row of the product: the sums for each digit, joined. `right` has the row of each entry.
fn row_by_digits(
    row: &[(usize, &Integer)],
    digits: u64,
    right: &[&[i64]],
    columns: usize,
) -> Vec<Integer> {
    let mut sums = vec![vec![0i128; columns]; digits as usize];

    for ((_, entry), right) in row.iter().zip(right) {
        let sign = if entry.is_negative() { -1 } else { 1 };
        for (sums_of_digit, digit) in sums.iter_mut().zip(entry.iter_u32_digits()) {
            let digit = sign * i64::from(digit);
            for (sum, w) in sums_of_digit.iter_mut().zip(*right) {
                *sum += i128::from(digit) * i128::from(*w);
            }
        }
    }

    let mut joined = vec![Integer::zero(); columns];
    for sums_of_digit in sums.iter().rev() {
        for (value, sum) in joined.iter_mut().zip(sums_of_digit) {
            *value <<= DIGIT_BITS;
            *value += *sum;
        }
    }

    joined
}

/// A row of the product in long integers.
fn long_row(row: &[(usize, &Integer)], right: &[IntegerRow], columns: usize) -> Vec<Integer> {
    let mut sums = vec![Integer::zero(); columns];
    for (g, entry) in row {
        for (sum, w) in sums.iter_mut().zip(right[*g].iter()) {
            *sum += *entry * &*w;
        }
    }

    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    fn ones(bits: u32) -> Integer {
        (Integer::one() << bits) - 1
    }

    /// Lengths at both sides of one, two, three and the most digits, and of the short entries.
    #[test]
    fn short_and_long_products_agree_at_the_limit() {
        for (left_bits, right_bits) in [
            (3, 4),
            (31, 61),
            (32, 62),
            (33, 63),
            (64, 62),
            (65, 63),
            (96, 64),
            (97, 1),
            (1, 200),
            (300, 62),
            (2048, 62),
            (2049, 62),
        ] {
            let a = ones(left_bits);
            let b = ones(right_bits);
            let rows: Linear = vec![
                vec![
                    (0, a.clone(), -&a),
                    (1, a.clone(), a.clone()),
                    (2, a.clone(), Integer::zero()),
                ],
                vec![],
                vec![(1, -&a, Integer::zero())],
            ];
            let right = [
                vec![b.clone(), -&b],
                vec![b.clone(), -&b],
                vec![b.clone(), b.clone()],
            ]
            .map(IntegerRow::from);

            let p = &a * &b;
            let zero = vec![Integer::zero(); 2];
            let by_constant = vec![vec![&p * 3, -&p], zero.clone(), vec![-&p, p]];
            assert_eq!(
                times(&part_of(&rows, LinearPart::Constant), &right, 2),
                by_constant
            );
            let by_linear = vec![zero.clone(), zero.clone(), zero];
            assert_eq!(
                times(&part_of(&rows, LinearPart::Linear), &right, 2),
                by_linear
            );
        }
    }

    /// Short and long entries at both ends of what 62 and 64 bits hold.
    #[test]
    fn the_largest_entries_keep_their_signs() {
        for sign in [1, -1] {
            let long: Integer = ones(160) * sign;
            for short in [ones(62), -ones(62), ones(63), -ones(63), -ones(63) - 1] {
                let right = vec![IntegerRow::from(vec![short.clone()]); 3];
                let left = vec![vec![(0, &long), (2, &long)]];
                assert_eq!(times(&left, &right, 1), vec![vec![&long * &short * 2]]);
            }
        }
    }

    /// Forty products of 94 bits and of both signs, more of one sign than of the other.
    #[test]
    fn many_terms_of_both_signs_add_up() {
        let long = [ones(64), -ones(64)];
        let short = ones(62);

        let row: Vec<_> = (0..40)
            .map(|g| (g, &long[usize::from(g % 4 == 0)]))
            .collect();
        let right = vec![IntegerRow::from(vec![short.clone(), -&short]); 40];

        let sum: Integer = &long[0] * &short * 20;
        assert_eq!(times(&vec![row], &right, 2), vec![vec![sum.clone(), -sum]]);
    }

    #[test]
    fn a_transpose_leaves_out_zeros() {
        let [one, two, zero] = [1, 2, 0].map(Integer::from);
        let matrix: LongMatrix = vec![
            vec![one.clone(), zero.clone()],
            vec![two.clone(), one.clone()],
        ];

        let expected = vec![vec![(0, &one), (1, &two)], vec![(1, &one)]];
        assert_eq!(transposed(&matrix, 2), expected);
    }
}
