//! How far polynomials W solve F(d) W(d) = C(d), with F and C linear in d: the residual C - F W,
//! exactly.
//!
//! With F = F_0 + d F_1 the coefficient of d^m is
//!
//! ```text
//!     r_m = C_m - F_0 W_m - F_1 W_(m-1).
//! ```
//!
//! Each is formed row by row in the unit of the finer of W_m and W_(m-1), and of the rows the sums
//! of the squares are kept: together they are as large as W, in long integers.
//!
//! V belongs to the pencil as given, and row i of T_sf here is f_i times that row. So the equation
//! of V' has f_i in column i of both sides. As far as it divides that column of C it is left out,
//! and multiplied to the squares in the end.
//!
//! Called by `condensed`, for W and for V.

use super::condensed::norms;
use super::ends::LongMatrix;
use super::expanded::Norms;
use super::product::{Linear, LinearPart, RowSum, RowTerm, SumEntry, row_of};
use crate::certificate::IntegerMatrix;
use mceip_exact::Integer;
use num_integer::Integer as _;
use num_traits::{One, Zero};

/// Bits of the entries of a residual whose squares are summed in machine integers, at most.
const SQUARED_BITS: u32 = 112;

/// F(d) W(d) = C(d) in d = t - center, which W solves up to a residual.
pub(super) struct ResidualEquations<'a> {
    f: &'a Linear,
    c: Linear,
    w: &'a [IntegerMatrix],
    /// What each column of W is multiplied by.
    factors_of_w: Vec<Integer>,
    /// What each column of both sides is to be multiplied by.
    pub(super) column_factors: Vec<Integer>,
}

/// What is kept of a residual, in units of 2^-e, e the largest exponent of W.
pub(super) struct Residual {
    /// The sums of the squares of each column of each coefficient.
    pub(super) squares: Vec<Vec<Integer>>,
    /// The coefficients beyond the degree of W, if they are asked for.
    pub(super) beyond: Vec<LongMatrix>,
}

/// Are the coefficients of a residual beyond the degree of W kept?
#[derive(Clone, Copy, PartialEq)]
pub(super) enum BeyondDegree {
    Kept,
    Dropped,
}

impl Residual {
    /// Upper bounds of the norms of the columns of each coefficient; column j counts
    /// `column_factors[j]` times.
    pub(super) fn norms(&self, column_factors: &[Integer]) -> Norms {
        let squares = self.squares.iter();
        squares.map(|sums| norms(sums, column_factors)).collect()
    }
}

impl<'a> ResidualEquations<'a> {
    /// F W = C, with column j of W counted `column_factors[j]` times.
    ///
    /// What divides the factor and column j of C as well is taken out of both.
    pub(super) fn new(
        f: &'a Linear,
        mut c: Linear,
        w: &'a [IntegerMatrix],
        column_factors: &[Integer],
    ) -> ResidualEquations<'a> {
        let mut common = column_factors.to_vec();
        for (j, constant, linear) in c.iter().flatten() {
            for entry in [constant, linear] {
                // The entries may be much longer than the factor.
                if !common[*j].is_one() {
                    common[*j] = (entry % &common[*j]).gcd(&common[*j]);
                }
            }
        }

        for (j, constant, linear) in c.iter_mut().flatten() {
            *constant /= &common[*j];
            *linear /= &common[*j];
        }

        let factors = column_factors.iter().zip(&common);
        ResidualEquations {
            f,
            c,
            w,
            factors_of_w: factors.map(|(factor, common)| factor / common).collect(),
            column_factors: common,
        }
    }

    /// Does the other equation say the same, but for what its columns are multiplied by?
    pub(super) fn is_that_of(&self, other: &ResidualEquations<'_>) -> bool {
        std::ptr::eq(self.f, other.f)
            && self.factors_of_w == other.factors_of_w
            && self.w == other.w
            && self.c == other.c
    }

    /// C(d) - F(d) W(d), without what its columns are multiplied by.
    pub(super) fn residual(&self, beyond: BeyondDegree) -> Residual {
        let mut sums = vec![SquareSums::zero(self.column_factors.len()); self.terms()];
        let mut kept = match beyond {
            BeyondDegree::Kept => vec![LongMatrix::new(); self.terms() - self.w.len()],
            BeyondDegree::Dropped => Vec::new(),
        };

        for i in 0..self.f.len() {
            for (power, sums) in sums.iter_mut().enumerate() {
                let row = self.row(i, power);
                if let Some(k) = power.checked_sub(self.w.len())
                    && let Some(matrix) = kept.get_mut(k)
                {
                    let lift = self.exponent() - self.unit(power);
                    let entries = row.entries().map(|entry| Integer::from(entry) << lift);
                    matrix.push(entries.collect());
                }

                for (j, entry) in row.entries().enumerate() {
                    sums.add(j, entry);
                }
            }
        }

        let squares = sums.into_iter().enumerate().map(|(power, sums)| {
            let lift = self.exponent() - self.unit(power);
            sums.into_integers(2 * lift)
        });
        Residual {
            squares: squares.collect(),
            beyond: kept,
        }
    }

    /// Coefficients of the residual: C is linear, and the product has one more than W.
    fn terms(&self) -> usize {
        (self.w.len() + 1).max(2)
    }

    /// The largest exponent of W.
    fn exponent(&self) -> u32 {
        self.w.iter().map(|w| w.exponent).max().unwrap_or(0)
    }

    /// The binary exponent of the unit in which the coefficient of d^power is formed: that of the
    /// finer of the two coefficients of W in it.
    fn unit(&self, power: usize) -> u32 {
        let first = power.saturating_sub(1);
        let exponents = self.w.iter().skip(first).take(power + 1 - first);
        exponents.map(|w| w.exponent).max().unwrap_or(0)
    }

    /// Row i of the coefficient of d^power, in its unit.
    fn row(&self, i: usize, power: usize) -> RowSum {
        let unit = self.unit(power);
        let mut terms: Vec<RowTerm<'_>> = Vec::new();
        let parts = [
            (LinearPart::Constant, Some(power)),
            (LinearPart::Linear, power.checked_sub(1)),
        ];
        for (part, number) in parts {
            let Some(w) = number.and_then(|number| self.w.get(number)) else {
                continue;
            };
            for (column, entry) in row_of(&self.f[i], part) {
                terms.push((-entry << (unit - w.exponent), &w.rows[column]));
            }
        }

        let of_c = match power {
            0 => row_of(&self.c[i], LinearPart::Constant),
            1 => row_of(&self.c[i], LinearPart::Linear),
            _ => Vec::new(),
        };
        let addends = of_c
            .into_iter()
            .map(|(column, entry)| (column, entry << unit));
        let addends: Vec<(usize, Integer)> = addends.collect();
        let columns = self.column_factors.len();
        if self.factors_of_w.iter().all(One::is_one) {
            return RowSum::of(&terms, &addends, columns);
        }

        let product = RowSum::of(&terms, &[], columns);
        let product = product.entries().map(Integer::from).zip(&self.factors_of_w);
        let mut row: Vec<Integer> = product.map(|(entry, factor)| entry * factor).collect();
        for (column, addend) in addends {
            row[column] += addend;
        }
        RowSum::Long(row)
    }
}

/// The sum of the squares of each column of a matrix that comes row by row.
///
/// With |v| = x 2^64 + y below 2^[`SQUARED_BITS`] the square is x^2 2^128 + x y 2^65 + y^2, so that
/// the sums of 2^31 rows fit into two numbers of 128 bits.
#[derive(Clone)]
struct SquareSums {
    low: Vec<u128>,
    /// In units of 2^128.
    high: Vec<u128>,
    /// Of the longer entries.
    long: Vec<Integer>,
}

impl SquareSums {
    fn zero(columns: usize) -> SquareSums {
        SquareSums {
            low: vec![0; columns],
            high: vec![0; columns],
            long: vec![Integer::zero(); columns],
        }
    }

    /// Adds the square of an entry of a column.
    fn add(&mut self, column: usize, entry: SumEntry) {
        match entry {
            SumEntry::Short(v) if v.unsigned_abs() >> SQUARED_BITS == 0 => {
                let x = v.unsigned_abs() >> 64;
                let y = v.unsigned_abs() & u128::from(u64::MAX);
                let mixed = x * y;
                let (low, is_over) = self.low[column].overflowing_add(y * y);
                let (low, is_over_again) = low.overflowing_add(mixed << 65);
                self.low[column] = low;
                self.high[column] +=
                    x * x + (mixed >> 63) + u128::from(is_over) + u128::from(is_over_again);
            }
            longer => {
                let v = Integer::from(longer);
                self.long[column] += &v * &v;
            }
        }
    }

    /// The sums times 2^`lift`.
    fn into_integers(self, lift: u32) -> Vec<Integer> {
        let halves = self.low.into_iter().zip(self.high);
        let sums = halves.zip(self.long).map(|((low, high), long)| {
            let short = (Integer::from(high) << 128u32) + low;
            (short + long) << lift
        });
        sums.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries at both sides of what machine integers hold, with carries from every part of a
    /// square.
    #[test]
    fn squares_of_short_and_long_entries_add_up() {
        let machine = |v: i128| SumEntry::Short(v);
        let ones = |bits: u32| (1i128 << bits) - 1;
        let values = [
            0,
            1,
            ones(63),
            ones(64),
            ones(64) + 1,
            ones(SQUARED_BITS),
            ones(SQUARED_BITS) + 1,
            i128::MAX,
        ];

        let mut sums = SquareSums::zero(2);
        let mut expected = Integer::zero();
        for _ in 0..5 {
            for v in values {
                for v in [v, -v] {
                    sums.add(1, machine(v));
                    expected += Integer::from(v) * v;
                }
            }
        }
        let long = Integer::one() << 200u32;
        sums.add(1, SumEntry::Long(long.clone()));
        expected += &long * &long;

        assert_eq!(sums.into_integers(3), [Integer::zero(), expected << 3u32]);
    }

    /// 6 divides 12 and 18 but not 20: of the first column 6 is taken out, of the second 2.
    #[test]
    fn what_divides_a_column_is_taken_out() {
        let int = |v: i64| Integer::from(v);
        let f: Linear = vec![vec![(0, int(7), int(5))]];
        let c: Linear = vec![vec![(0, int(12), int(18)), (1, int(20), int(-4))]];
        let w = [IntegerMatrix {
            exponent: 1,
            rows: vec![vec![int(3), int(-2)].into()].into(),
        }];
        let factors = vec![int(6), int(6)];
        let equations = ResidualEquations::new(&f, c, &w, &factors);
        assert_eq!(equations.column_factors, [int(6), int(2)]);

        // r_0 = C_0 - 7 W and r_1 = C_1 - 5 W, in units of 1/2.
        let residual = equations.residual(BeyondDegree::Kept);
        let squares = |v: [i64; 2]| v.map(|v| int(v * v)).to_vec();
        let first = squares([2 * 2 - 7 * 3, 2 * 10 + 7 * 2 * 3]);
        let second = squares([2 * 3 - 5 * 3, -2 * 2 + 5 * 2 * 3]);
        assert_eq!(residual.squares, [first, second.clone()]);
        let beyond = residual.beyond[0][0].iter().map(|v| v * v);
        assert_eq!(beyond.collect::<Vec<_>>(), second);

        // W of another column is another equation.
        let again = ResidualEquations::new(&f, equations.c.clone(), &w, &[int(1), int(1)]);
        assert!(!again.is_that_of(&equations));
        assert!(equations.is_that_of(&equations));
    }
}
