//! Matrices with radii in machine integers, for speed only.
//!
//! Each entry of a matrix lies within `r` of `m`, in a unit that the entries share. What is proved
//! of every matrix within these radii holds for the true one; what these numbers cannot tell is
//! computed with the long numbers of `ends`. So a leaf may be accepted by short numbers, but never
//! rejected.
//!
//! All that is computed is p A + q B (`combine`): the true matrices are within the radii, so their
//! combination lies within |p| R_A + |q| R_B of p M_A + q M_B. A factor is rounded down to p' with
//! p' <= p < p' + 1, which may cost |M_A| + R_A, and the result is cut to 62 bits, which may cost
//! one unit for its center and one for its radius.
//!
//! Overflow: entries, radii and factors are at most 2^62 in absolute value, so that the products of
//! two have at most 124 bits and a sum of four of them fits into an `i128`.

use super::ball::{Ball, BallMatrix};
use super::ends::{Ends, FRACTION_BITS, LongMatrix, largest_bits};
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Bits of the largest entry, and of a factor of a combination.
const BITS: u64 = 62;

/// A matrix with radii in units of 2^`unit`. All numbers are at most 2^62 in absolute
/// value.
#[derive(Clone)]
pub(super) struct Short {
    pub(super) entries: BallMatrix<i64>,
    unit: i64,
}

/// A factor, rounded down: less than one more than `value`, if not exactly that.
struct ShortFactor {
    value: i64,
    is_exact: bool,
}

impl Ends {
    /// Both ends in short numbers.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        let [lower, upper] = &self.at;
        let all: Vec<usize> = (0..lower.m.len()).collect();
        Some([
            Short::of(&lower.m, &lower.r, &all)?,
            Short::of(&upper.m, &upper.r, &all)?,
        ])
    }
}

impl Short {
    /// M +- R, the principal part on `keep`; `None` where the radius is far larger than the matrix.
    pub(super) fn of(m: &LongMatrix, r: &LongMatrix, keep: &[usize]) -> Option<Short> {
        let kept = keep
            .iter()
            .flat_map(|&i| keep.iter().map(move |&j| &m[i][j]));
        let unit = largest_bits(kept).saturating_sub(BITS);

        let mut short = Short::with_unit(unit as i64, keep.len());
        for &i in keep {
            let row = keep
                .iter()
                .map(|&j| Ball::<i64>::cut(&m[i][j], &r[i][j], unit));
            short.push_row(row)?;
        }

        Some(short)
    }

    fn with_unit(unit: i64, order: usize) -> Short {
        Short {
            entries: BallMatrix {
                m: Vec::with_capacity(order),
                r: Vec::with_capacity(order),
            },
            unit,
        }
    }

    /// Appends a row; `None` if an entry does not fit.
    fn push_row(&mut self, row: impl ExactSizeIterator<Item = Option<Ball<i64>>>) -> Option<()> {
        let mut centers = Vec::with_capacity(row.len());
        let mut radii = Vec::with_capacity(row.len());
        for entry in row {
            let entry = entry?;
            centers.push(entry.center);
            radii.push(entry.radius);
        }

        self.entries.m.push(centers);
        self.entries.r.push(radii);
        Some(())
    }

    /// Zero within so many units of 1, for every entry.
    pub(super) fn around_zero(order: usize, radius: i64) -> Short {
        Short {
            entries: BallMatrix {
                m: vec![vec![0; order]; order],
                r: vec![vec![radius; order]; order],
            },
            unit: 0,
        }
    }

    /// M / divisor in the fixed unit, for a positive divisor.
    ///
    /// The quotients are formed in units so small that the largest one has at least 62 bits, and
    /// rounded down: that costs less than one unit.
    pub(super) fn quotient(m: &LongMatrix, divisor: &Integer) -> Option<Short> {
        let missing = (divisor.bits() + BITS + 1).saturating_sub(largest_bits(m.iter().flatten()));

        let mut quotients = LongMatrix::with_capacity(m.len());
        let mut radii = LongMatrix::with_capacity(m.len());
        for row in m {
            let mut quotient_row = Vec::with_capacity(row.len());
            let mut radius_row = Vec::with_capacity(row.len());
            for v in row {
                let (quotient, rest) = (v << missing).div_mod_floor(divisor);
                quotient_row.push(quotient);
                radius_row.push(Integer::from(u8::from(!rest.is_zero())));
            }

            quotients.push(quotient_row);
            radii.push(radius_row);
        }

        let all: Vec<usize> = (0..m.len()).collect();
        let mut short = Short::of(&quotients, &radii, &all)?;
        short.unit += FRACTION_BITS as i64 - missing as i64;
        Some(short)
    }

    /// Zero within left_i right_j, of numbers that are not negative.
    pub(super) fn within_products(left: &[Rational], right: &[Rational]) -> Option<Short> {
        let (left, left_unit) = upper_bounds(left)?;
        let (right, right_unit) = upper_bounds(right)?;

        // Both are at most 2^62, so their products are at most 2^61 in this unit.
        let cut = BITS + 1;
        let mut short = Short::with_unit(left_unit + right_unit + cut as i64, left.len());
        for l in left {
            let row = right.iter().map(|r| Ball::around_zero(l * r).to_entry(cut));
            short.push_row(row)?;
        }

        Some(short)
    }

    /// Zero within a non-negative multiple of the absolute values of all members.
    pub(super) fn within_multiple(&self, factor: &Rational) -> Option<Short> {
        // Half of |m| + r, rounded up, is at most 2^62.
        let BallMatrix { m, r } = &self.entries;
        let mut halves = Short::with_unit(self.unit + 1, m.len());
        for (m, r) in m.iter().zip(r) {
            let mut radii = Vec::with_capacity(m.len());
            for (m, r) in m.iter().zip(r) {
                let magnitude = m.unsigned_abs() + r.unsigned_abs();
                radii.push(magnitude.div_ceil(2) as i64);
            }

            halves.entries.m.push(vec![0; radii.len()]);
            halves.entries.r.push(radii);
        }

        halves.combine(factor, &halves, &Rational::zero())
    }

    /// The ends over [lo, hi] (`None`: infinity) of constant + t direction: the values, and the
    /// direction at infinity.
    pub(super) fn linear_ends(
        [constant, direction]: &[Short; 2],
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Option<[Short; 2]> {
        let lower = constant.plus_multiple(direction, lo)?;
        let upper = match hi {
            Some(hi) => constant.plus_multiple(direction, hi)?,
            None => direction.clone(),
        };
        Some([lower, upper])
    }

    /// The sum.
    pub(super) fn plus(&self, other: &Short) -> Option<Short> {
        self.plus_multiple(other, &Rational::one())
    }

    /// The sum with a multiple of the other.
    pub(super) fn plus_multiple(&self, other: &Short, factor: &Rational) -> Option<Short> {
        self.combine(&Rational::one(), other, factor)
    }

    /// p times this plus q times the other.
    fn combine(&self, p: &Rational, other: &Short, q: &Rational) -> Option<Short> {
        // Both factors in a common unit in which they have at most 62 bits, rounded down.
        let own_size = integral_bits(p) + self.unit;
        let other_size = integral_bits(q) + other.unit;
        let factor_unit = own_size.max(other_size) - BITS as i64;
        let p = ShortFactor::of(p, factor_unit - self.unit)?;
        let q = ShortFactor::of(q, factor_unit - other.unit)?;

        // Sums of four products stay below 2^126.
        let BallMatrix { m, r } = &self.entries;
        let n = m.len();
        let mut sums = Vec::with_capacity(n * n);
        let mut largest = 0u128;
        for i in 0..n {
            let own = m[i].iter().zip(&r[i]);
            let others = other.entries.m[i].iter().zip(&other.entries.r[i]);
            for ((&a, &s), (&b, &t)) in own.zip(others) {
                let of_own = p.times(a, s);
                let of_other = q.times(b, t);
                let center = of_own.center + of_other.center;
                let radius = of_own.radius + of_other.radius;

                largest |= center.unsigned_abs() | radius.unsigned_abs();
                sums.push(Ball { center, radius });
            }
        }

        let cut = (128 - u64::from(largest.leading_zeros())).saturating_sub(BITS);
        let mut short = Short::with_unit(factor_unit + cut as i64, n);
        for row in sums.chunks_exact(n.max(1)) {
            short.push_row(row.iter().map(|sum| sum.to_entry(cut)))?;
        }

        Some(short)
    }

    /// Upper bounds of (w'T)_j for every j; `None` for weights too long.
    pub(super) fn product(&self, w: &[i64]) -> Option<Vec<i128>> {
        // With |w| summing to less than 2^63 every sum below stays under 2^126.
        let size: u128 = w.iter().map(|w| u128::from(w.unsigned_abs())).sum();
        if size >= 1 << 63 {
            return None;
        }

        let mut bounds = vec![0i128; w.len()];
        for (i, &w_i) in w.iter().enumerate() {
            if w_i == 0 {
                continue;
            }

            let weight = i128::from(w_i);
            let size = i128::from(w_i.unsigned_abs());
            let row = self.entries.m[i].iter().zip(&self.entries.r[i]);
            for (bound, (m, r)) in bounds.iter_mut().zip(row) {
                *bound += weight * i128::from(*m) + size * i128::from(*r);
            }
        }

        Some(bounds)
    }
}

#[cfg(test)]
impl Short {
    /// Center and radius of an entry, in units of 1.
    pub(super) fn entry(&self, i: usize, j: usize) -> [Rational; 2] {
        let two = Rational::from_integer(2.into());
        let unit = two.pow(self.unit as i32);
        [self.entries.m[i][j], self.entries.r[i][j]]
            .map(|v| Rational::from_integer(v.into()) * &unit)
    }
}

impl Ball<i64> {
    /// v +- r in units of 2^unit.
    fn cut(v: &Integer, r: &Integer, unit: u64) -> Option<Ball<i64>> {
        let center = v >> unit;
        let is_whole = &center << unit == *v;
        let is_exact = is_whole && !r.is_positive();
        let radius = r >> unit;

        Ball::rounded(center.to_i64()?, radius.to_i64()?, is_exact)
    }

    /// A center and a radius that have been rounded down: rounding each has cost less than one
    /// unit. `None` if one of them is larger than an entry may be.
    fn rounded(center: i64, radius: i64, is_exact: bool) -> Option<Ball<i64>> {
        let radius = if is_exact { 0 } else { radius.checked_add(2)? };
        let center_fits = center.unsigned_abs() <= 1 << BITS;
        let radius_fits = radius <= 1 << BITS;

        let fits = center_fits && radius_fits;
        fits.then_some(Ball { center, radius })
    }
}

impl ShortFactor {
    /// x in units of 2^`unit`; `None` if it does not fit.
    fn of(x: &Rational, unit: i64) -> Option<ShortFactor> {
        let numerator = x.numer() << (-unit).max(0);
        let denominator = x.denom() << unit.max(0);
        let (value, rest) = numerator.div_mod_floor(&denominator);
        Some(ShortFactor {
            value: value.to_i64()?,
            is_exact: rest.is_zero(),
        })
    }

    /// The product with every number within r of m.
    fn times(&self, m: i64, r: i64) -> Ball<i128> {
        // The products of machine words into 128 bits are the whole cost of a combination.
        let center = i128::from(self.value) * i128::from(m);
        let radius = i128::from(self.value.abs()) * i128::from(r);
        let lost = if self.is_exact {
            0
        } else {
            i128::from(m.abs()) + i128::from(r)
        };

        Ball {
            center,
            radius: radius + lost,
        }
    }
}

impl Ball<i128> {
    fn around_zero(radius: i128) -> Ball<i128> {
        Ball { center: 0, radius }
    }

    /// The same in units of 2^unit.
    fn to_entry(&self, unit: u64) -> Option<Ball<i64>> {
        let center = self.center >> unit;
        let is_whole = center << unit == self.center;
        let is_exact = is_whole && self.radius == 0;
        let radius = self.radius >> unit;
        Ball::rounded(center.to_i64()?, radius.to_i64()?, is_exact)
    }
}

/// b with |x| < 2^b.
fn integral_bits(x: &Rational) -> i64 {
    x.numer().bits() as i64 - x.denom().bits() as i64 + 1
}

/// Upper bounds of numbers that are not negative, and their unit as a power of two, such that they
/// are at most 2^62.
fn upper_bounds(values: &[Rational]) -> Option<(Vec<i128>, i64)> {
    let size = values.iter().map(integral_bits).max().unwrap_or(0);
    let unit = size - BITS as i64;

    let mut bounds = Vec::with_capacity(values.len());
    for value in values {
        let factor = ShortFactor::of(value, unit)?;
        bounds.push(i128::from(factor.value) + i128::from(!factor.is_exact));
    }

    Some((bounds, unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn big(rows: &[&[i64]], bits: u32) -> LongMatrix {
        rows.iter()
            .map(|r| {
                r.iter()
                    .map(|&v| (Integer::from(v) << bits) + v.signum())
                    .collect()
            })
            .collect()
    }

    /// Does the enclosure contain p A + q B, entry by entry, if one unit of it is `unit`?
    fn contains(short: &Short, exact: &LongMatrix, unit: &Integer) -> bool {
        let holds = |i: usize, j: usize| {
            (&exact[i][j] - unit * short.entries.m[i][j]).abs() <= unit * short.entries.r[i][j]
        };
        (0..exact.len()).all(|i| (0..exact.len()).all(|j| holds(i, j)))
    }

    #[test]
    fn long_entries_are_enclosed_and_short_ones_exact() {
        let zero = big(&[&[0, 0], &[0, 0]], 0);
        let long = big(&[&[3, -5], &[0, 7]], 100);
        let short = Short::of(&long, &zero, &[0, 1]).unwrap();
        assert!(contains(&short, &long, &(Integer::one() << short.unit)));
        assert_eq!(short.entries.r[1][0], 0); // an exact zero stays one
        assert!(short.entries.r[0][0] > 0);
        let exact = Short::of(&big(&[&[3, -5], &[0, 7]], 40), &zero, &[1]).unwrap();
        assert_eq!(
            (exact.entries.m, exact.entries.r, exact.unit),
            (vec![vec![(7 << 40) + 1]], vec![vec![0]], 0)
        );
        let wide = big(&[&[1, 1], &[1, 1]], 200);
        assert!(Short::of(&long, &wide, &[0, 1]).is_none());
    }

    /// Entries and factors of every length and of both signs, B far smaller or larger than A.
    #[test]
    fn combinations_enclose_the_exact_ones() {
        for (bits_a, bits_b, p, q) in [
            (100, 80, whole(3), whole(1 << 60)),
            (20, 120, whole(i64::MAX), whole(-7)),
            (61, 61, whole(1), whole(0)),
            (10, 3, rational(5, 3), rational(-9, 7)),
            (90, 0, rational(1, i64::MAX), rational(i64::MAX, 3)),
        ] {
            let a = big(&[&[3, -5], &[0, 7]], bits_a);
            let b = big(&[&[-1, 2], &[0, 1000]], bits_b);
            let radius = |bits: u32| big(&[&[1, 2], &[0, 1]], bits.saturating_sub(50));
            let (ra, rb) = (radius(bits_a), radius(bits_b));
            let first = Short::of(&a, &ra, &[0, 1]).unwrap();
            let second = Short::of(&b, &rb, &[0, 1]).unwrap();
            let short = first.combine(&p, &second, &q).unwrap();

            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let exact = |m: &LongMatrix| Rational::from_integer(m[i][j].clone());
                let middle = &p * exact(&a) + &q * exact(&b);
                let reach = p.abs() * exact(&ra) + q.abs() * exact(&rb);
                let [center, radius] = short.entry(i, j);
                assert!((middle - center).abs() + reach <= radius, "{p} {q}");
            }
        }
    }

    /// M / divisor 2^128, close enough to keep 60 bits of the largest entry.
    #[test]
    fn quotients_enclose_the_exact_ones() {
        let m = big(&[&[3, -5], &[0, 7]], 40);
        for divisor in [Integer::from(1), 3.into(), Integer::from(12) << 300u32] {
            let short = Short::quotient(&m, &divisor).unwrap();
            let exact =
                |i: usize, j: usize| Rational::new(&m[i][j] << FRACTION_BITS, divisor.clone());

            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let [center, radius] = short.entry(i, j);
                assert!((exact(i, j) - center).abs() <= radius);
                assert!(&radius * whole(1 << 59) < exact(1, 1));
            }
            assert_eq!(short.entries.r[1][0], 0);
        }
    }

    /// 1 + 1 / divisor is 1 in the units of the quotients, and all that is left of the rest is its
    /// radius.
    #[test]
    fn a_quotient_that_is_not_exact_has_a_radius() {
        let divisor = (Integer::one() << 80u32) - 1;
        for sign in [1, -1] {
            let short = Short::quotient(&vec![vec![(&divisor + 1) * sign]], &divisor).unwrap();
            let exact = Rational::new((&divisor + 1) << FRACTION_BITS, divisor.clone());

            let [center, radius] = short.entry(0, 0);
            let distance = (exact * whole(sign) - center).abs();
            assert!(distance.is_positive() && distance <= radius);
        }

        let short = Short::quotient(&vec![vec![divisor.clone()]], &divisor).unwrap();
        assert_eq!(short.entries.r, [[0]]);
    }

    /// In units of 2^(1 - 62): the largest value is less than 2^1.
    #[test]
    fn upper_bounds_are_rounded_up() {
        let (bounds, unit) =
            upper_bounds(&[whole(1), rational(1, 3), whole(0), rational(1, 1 << 62)]).unwrap();
        let third = (1i128 << 61) / 3 + 1;
        assert_eq!((bounds, unit), (vec![1 << 61, third, 0, 1], -61));

        // 2^62 - 1/2 is less than 2^62 and becomes that.
        let (bounds, _) = upper_bounds(&[whole(1 << 62) - rational(1, 2)]).unwrap();
        assert_eq!(bounds, [1 << 62]);
    }

    /// The largest entries, radii and factors, of both signs: enclosed, or refused, never wrong.
    #[test]
    fn the_largest_numbers_do_not_overflow() {
        let limit = 1i64 << BITS;
        let of = |m: i64, r: i64| Short {
            entries: BallMatrix {
                m: vec![vec![m]],
                r: vec![vec![r]],
            },
            unit: 0,
        };
        let long = |bits: u32| Rational::from_integer(Integer::one() << bits);
        let factors = [
            long(62) - rational(1, 3),
            -long(62),
            rational(1, 3) - long(62),
        ];
        let mut enclosed = 0;

        for (p, q) in factors
            .iter()
            .flat_map(|p| factors.iter().map(move |q| (p, q)))
        {
            for (a, b) in [(limit, limit), (-limit, limit), (-limit, -limit)] {
                for r in [0, 1, limit / 2, limit] {
                    let Some(short) = of(a, r).combine(p, &of(b, r), q) else {
                        assert!(r == limit, "{p} {q} {a} {b} {r}");
                        continue;
                    };

                    let middle = p * whole(a) + q * whole(b);
                    let reach = (p.abs() + q.abs()) * whole(r);
                    let [center, radius] = short.entry(0, 0);
                    assert!(
                        (middle - center).abs() + reach <= radius,
                        "{p} {q} {a} {b} {r}"
                    );
                    enclosed += 1;
                }
            }
        }

        assert!(enclosed >= 81);
    }

    /// Zero times anything, as the sum with a multiple by 0 has it, costs nothing.
    #[test]
    fn sums_of_exact_numbers_are_exact() {
        let three = Short::around_zero(1, 3);
        let [center, radius] = three.entry(0, 0);
        assert_eq!([center, radius], [whole(0), whole(3)]);

        let exact = Short {
            entries: BallMatrix {
                m: vec![vec![-5]],
                r: vec![vec![0]],
            },
            unit: -3,
        };
        let sum = exact.plus_multiple(&exact, &whole(-7)).unwrap();
        assert_eq!(sum.entry(0, 0), [rational(30, 8), whole(0)]);
    }

    /// Never below the product, and above it by 2^-58 of the largest at most.
    #[test]
    fn products_of_vectors_are_upper_bounds() {
        let left = [rational(1, 3), whole(0), rational(i64::MAX, 5)];
        let right = [whole(7), rational(1, 1 << 40), rational(2, 3)];
        let short = Short::within_products(&left, &right).unwrap();

        for (i, l) in left.iter().enumerate() {
            for (j, r) in right.iter().enumerate() {
                let [center, radius] = short.entry(i, j);
                let excess = radius - l * r;
                assert!(center.is_zero() && !excess.is_negative());
                assert!(excess * whole(1 << 58) < &left[2] * &right[0]);
            }
        }
        assert_eq!(short.entries.r[1], [0, 0, 0]);
    }

    #[test]
    fn magnitudes_are_upper_bounds() {
        let top = 1 << BITS;
        let given = Short {
            entries: BallMatrix {
                m: vec![vec![-3, top], vec![0, -top]],
                r: vec![vec![2, top], vec![0, 0]],
            },
            unit: -5,
        };
        let short = given.within_multiple(&whole(6)).unwrap();

        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let [center, radius] = given.entry(i, j);
            let exact = (center.abs() + radius) * whole(6);
            let [center, radius] = short.entry(i, j);
            let excess = radius - exact;
            assert!(center.is_zero() && !excess.is_negative() && excess < whole(4));
        }
        assert_eq!(short.entries.r[1][0], 0);
    }

    #[test]
    fn products_bound_both_signs_of_the_radius() {
        let short = Short {
            entries: BallMatrix {
                m: vec![vec![3, -4], vec![-5, 1]],
                r: vec![vec![1, 0], vec![2, 0]],
            },
            unit: 0,
        };
        assert_eq!(short.product(&[2, -1]), Some(vec![6 + 5 + 2 + 2, -8 - 1]));
        assert_eq!(short.product(&[i64::MAX, 1]), None);
    }

    /// What is exact stays exact, at any length.
    #[test]
    fn a_multiple_of_the_unit_has_no_radius() {
        let m = vec![
            vec![Integer::from(3) << 100u32, Integer::from(1)],
            vec![
                Integer::from(-5) << 90u32,
                Integer::from(1) << 200u32 >> 60u32,
            ],
        ];
        let short = Short::of(&m, &big(&[&[0, 0], &[0, 0]], 0), &[0, 1]).unwrap();
        assert_eq!(short.unit, 141 - 62);
        assert_eq!((short.entries.m[0][0], short.entries.r[0][0]), (3 << 21, 0));
        assert_eq!((short.entries.m[0][1], short.entries.r[0][1]), (0, 2));
    }

    /// The formula of `combine` in rational numbers: values and radii to the last unit.
    #[test]
    fn combinations_are_those_of_the_formula() {
        let top = (1i64 << 61) - 1;
        let long = |v: i64, bits: u32| Rational::from_integer(Integer::from(v) << bits);
        let factors = [
            (whole(3), whole(5)),                      // exact
            (long(3, 70), long(-5, 65)),               // exact, though long
            (long(3, 70) + whole(1), long(5, 65)),     // the first is cut
            (long(3, 70), long(-5, 65) - whole(1)),    // the second is cut
            (long(1, 80) - whole(1), rational(-1, 3)), // both
            (whole(1), whole(0)),
        ];
        let short = |m: [[i64; 2]; 2], r: [[i64; 2]; 2], unit: i64| Short {
            entries: BallMatrix {
                m: m.map(|row| row.to_vec()).to_vec(),
                r: r.map(|row| row.to_vec()).to_vec(),
            },
            unit,
        };
        let small = [[3, -5], [7, 11]];
        let large = [[top, -top], [1, 5]];
        let matrices = [
            (
                small,
                [[1, 2], [3, 1]],
                [[-9, 4], [6, 13]],
                [[2, 1], [1, 3]],
            ),
            (
                small,
                [[0, 0], [0, 0]],
                [[-9, 4], [6, 13]],
                [[0, 0], [0, 0]],
            ),
            (
                large,
                [[top / 7, 9], [0, 2]],
                [[top / 3, 1], [-top, 8]],
                [[0, top / 5], [1, 1]],
            ),
            (large, [[0, 1], [0, 0]], [[2, 1], [1, 8]], [[0, 0], [2, 0]]),
        ];

        for (p, q) in &factors {
            for (a, ra, b, rb) in matrices {
                for (unit_a, unit_b) in [(0, 0), (4, 0), (-90, 3)] {
                    let first = short(a, ra, unit_a);
                    let second = short(b, rb, unit_b);
                    let got = first.combine(p, &second, q).unwrap();
                    assert_eq!(
                        (got.entries.m, got.entries.r, got.unit),
                        formula(p, &first, q, &second)
                    );
                }
            }
        }
    }

    fn power_of_two(exponent: i64) -> Rational {
        whole(2).pow(exponent as i32)
    }

    /// What `combine` says, entry by entry.
    fn formula(
        p: &Rational,
        a: &Short,
        q: &Rational,
        b: &Short,
    ) -> (Vec<Vec<i64>>, Vec<Vec<i64>>, i64) {
        let bits = |x: &Rational| x.numer().bits() as i64 - x.denom().bits() as i64 + 1;
        let factor_unit = (bits(p) + a.unit).max(bits(q) + b.unit) - 62;
        let p = p * power_of_two(a.unit - factor_unit);
        let q = q * power_of_two(b.unit - factor_unit);
        let lost = |x: &Rational| whole(i64::from(!x.is_integer()));

        let center = |i: usize, j: usize| {
            p.floor() * whole(a.entries.m[i][j]) + q.floor() * whole(b.entries.m[i][j])
        };
        let of = |x: &Rational, s: &Short, i: usize, j: usize| {
            let magnitude = whole(s.entries.m[i][j]).abs() + whole(s.entries.r[i][j]);
            x.floor().abs() * whole(s.entries.r[i][j]) + lost(x) * magnitude
        };
        let radius = |i: usize, j: usize| of(&p, a, i, j) + of(&q, b, i, j);

        let cells = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let longest = |v: Rational| v.to_integer().bits() as i64;
        let sizes = cells.map(|(i, j)| longest(center(i, j)).max(longest(radius(i, j))));
        let cut = (sizes.into_iter().max().unwrap() - 62).max(0);

        let small = |v: Rational| {
            (v / power_of_two(cut))
                .floor()
                .to_integer()
                .to_i64()
                .unwrap()
        };
        let rounded = |i: usize, j: usize| {
            let is_whole = (center(i, j) / power_of_two(cut)).is_integer();
            if is_whole && radius(i, j).is_zero() {
                0
            } else {
                small(radius(i, j)) + 2
            }
        };
        (
            vec![
                vec![small(center(0, 0)), small(center(0, 1))],
                vec![small(center(1, 0)), small(center(1, 1))],
            ],
            vec![
                vec![rounded(0, 0), rounded(0, 1)],
                vec![rounded(1, 0), rounded(1, 1)],
            ],
            factor_unit + cut,
        )
    }

    #[test]
    fn values_and_radii_have_a_limit() {
        let limit = 1i64 << BITS;
        let rounded = |center: i64, radius: i64, is_exact: bool| {
            Ball::rounded(center, radius, is_exact).map(|ball| (ball.center, ball.radius))
        };

        assert_eq!(rounded(limit, 0, true), Some((limit, 0)));
        assert_eq!(rounded(-limit, 0, true), Some((-limit, 0)));
        assert_eq!(rounded(limit + 1, 0, true), None);

        assert_eq!(rounded(1, limit - 2, false), Some((1, limit)));
        assert_eq!(rounded(1, limit - 1, false), None);
        assert_eq!(rounded(1, i64::MAX, false), None);
    }
}
