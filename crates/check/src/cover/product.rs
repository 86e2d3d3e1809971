//! The product of a matrix of long integers and one of short integers, exactly.
//!
//! The entries of the pencil are long and those of W and V short, as a rule below 2^62
//! ([`IntegerRow`]). So an entry of the left factor is cut into digits of `width` bits that have
//! its sign,
//!
//! ```text
//!     v = sum_k v_k 2^(width k),    |v_k| < 2^width,
//! ```
//!
//! and for each k the sum of v_k w over a row and a column is formed in 128 bits. The width is the
//! largest with which these sums stay below 2^126 in modulus. Where an entry of the right factor is
//! longer, or one of the left factor has many digits, the sums are formed in long integers; the
//! result is the same. Called by `condensed` and `residual`.

use super::ends::{LongMatrix, largest_bits};
use crate::certificate::IntegerRow;
use crate::pencil::Row;
use mceip_exact::Integer;
use num_traits::{Signed, Zero};

/// Bits of a digit, at most: a digit is a machine integer.
const MOST_DIGIT_BITS: u32 = 62;
/// Bits of a sum of products of digits.
const SUM_BITS: u32 = 126;
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
fn row_times(row: &[(usize, &Integer)], right: &[IntegerRow], columns: usize) -> Vec<Integer> {
    let terms = row.iter().map(|(g, entry)| ((*entry).clone(), &right[*g]));
    let terms: Vec<RowTerm<'_>> = terms.collect();
    let sums = RowSum::of(&terms, &[], columns);
    sums.entries().map(Integer::from).collect()
}

/// A long integer and the row that it multiplies.
pub(super) type RowTerm<'a> = (Integer, &'a IntegerRow);

/// A sum of rows, each times a long integer.
pub(super) enum RowSum {
    /// The sums for each digit, one digit at least, and the width of a digit.
    Digits(Vec<Vec<i128>>, u32),
    Long(Vec<Integer>),
}

/// An entry of such a sum.
pub(super) enum SumEntry {
    Short(i128),
    Long(Integer),
}

impl RowSum {
    /// The sum of the terms, and of the `addends` in their columns, one a column at most.
    pub(super) fn of(
        terms: &[RowTerm<'_>],
        addends: &[(usize, Integer)],
        columns: usize,
    ) -> RowSum {
        RowSum::by_digits(terms, addends, columns)
            .unwrap_or_else(|| RowSum::in_long_integers(terms, addends, columns))
    }

    /// `None` where a row is long or the integers have too many digits.
    fn by_digits(
        terms: &[RowTerm<'_>],
        addends: &[(usize, Integer)],
        columns: usize,
    ) -> Option<RowSum> {
        let short_rows: Option<Vec<&[i64]>> = terms.iter().map(|(_, row)| row.as_short()).collect();
        let short_rows = short_rows?;

        // So many products of a digit and an entry, and one addend, are below 2^126.
        let products = u64::BITS - (terms.len() as u64 + 1).leading_zeros();
        let row_bits = terms.iter().map(|(_, row)| row.bits()).max().unwrap_or(0);
        let width = SUM_BITS.checked_sub(products + row_bits as u32)?;
        if width == 0 {
            return None;
        }

        let width = width.min(MOST_DIGIT_BITS);

        let factors = terms.iter().map(|(factor, _)| factor);
        let longest = largest_bits(factors.chain(addends.iter().map(|(_, addend)| addend)));
        let count = longest.div_ceil(width.into()).max(1);
        if count > MOST_DIGITS {
            return None;
        }

        let mut sums = vec![vec![0i128; columns]; count as usize];
        for ((factor, _), row) in terms.iter().zip(short_rows) {
            for (sums_of_digit, digit) in sums.iter_mut().zip(digits(factor, width)) {
                for (sum, w) in sums_of_digit.iter_mut().zip(row) {
                    *sum += i128::from(digit) * i128::from(*w);
                }
            }
        }

        for (column, addend) in addends {
            for (sums_of_digit, digit) in sums.iter_mut().zip(digits(addend, width)) {
                sums_of_digit[*column] += i128::from(digit);
            }
        }

        Some(RowSum::Digits(sums, width))
    }

    fn in_long_integers(
        terms: &[RowTerm<'_>],
        addends: &[(usize, Integer)],
        columns: usize,
    ) -> RowSum {
        let mut sums = vec![Integer::zero(); columns];
        for (factor, row) in terms {
            for (sum, w) in sums.iter_mut().zip(row.iter()) {
                *sum += factor * &*w;
            }
        }

        for (column, addend) in addends {
            sums[*column] += addend;
        }

        RowSum::Long(sums)
    }

    /// The entries, column by column.
    pub(super) fn entries(&self) -> impl Iterator<Item = SumEntry> {
        let columns = match self {
            RowSum::Digits(sums, _) => sums[0].len(),
            RowSum::Long(sums) => sums.len(),
        };
        (0..columns).map(|column| self.entry(column))
    }

    fn entry(&self, column: usize) -> SumEntry {
        match self {
            RowSum::Long(sums) => SumEntry::Long(sums[column].clone()),
            RowSum::Digits(sums, width) => {
                let of_digits = sums.iter().map(|of_digit| of_digit[column]);
                match joined_short(of_digits.clone(), *width) {
                    Some(value) => SumEntry::Short(value),
                    None => SumEntry::Long(joined_long(of_digits, *width)),
                }
            }
        }
    }
}

impl From<SumEntry> for Integer {
    fn from(entry: SumEntry) -> Integer {
        match entry {
            SumEntry::Short(value) => value.into(),
            SumEntry::Long(value) => value,
        }
    }
}

/// The digits of this width of an integer, the lowest first, with its sign.
fn digits(value: &Integer, width: u32) -> impl Iterator<Item = i64> {
    let sign = if value.is_negative() { -1 } else { 1 };
    let mask = (1u128 << width) - 1;
    let mut words = value.iter_u64_digits();
    let mut held: u128 = 0;
    let mut held_bits = 0;

    std::iter::from_fn(move || {
        if held_bits < width
            && let Some(word) = words.next()
        {
            held |= u128::from(word) << held_bits;
            held_bits += u64::BITS;
        }

        let is_over = held == 0 && words.len() == 0;
        let digit = (held & mask) as i64;
        held >>= width;
        held_bits = held_bits.saturating_sub(width);
        (!is_over).then_some(sign * digit)
    })
}

/// sum_k s_k 2^(width k) in 128 bits; `None` where that is too long.
fn joined_short(sums: impl DoubleEndedIterator<Item = i128>, width: u32) -> Option<i128> {
    let mut value: i128 = 0;
    for sum in sums.rev() {
        // |value| < 2^127 after the shift.
        if value.unsigned_abs().leading_zeros() <= width {
            return None;
        }

        value = (value << width).checked_add(sum)?;
    }

    Some(value)
}

/// The same in a long integer.
fn joined_long(sums: impl DoubleEndedIterator<Item = i128>, width: u32) -> Integer {
    let mut value = Integer::zero();
    for sum in sums.rev() {
        value <<= width;
        value += sum;
    }

    value
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
