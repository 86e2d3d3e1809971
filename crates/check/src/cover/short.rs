//! Matrices with radii in machine integers, for speed only.
//!
//! Each entry of the long matrix lies within `r` of `m` in a common unit. What is proved of every
//! matrix within these radii holds for the long one; what these numbers cannot tell is computed
//! with the long numbers of `ends`. So a leaf may be accepted by short numbers, but never rejected.
//!
//! Overflow: entries and radii are at most 2^62 in absolute value, so that the products of two have
//! at most 124 bits and a sum of four of them fits into an `i128`.

use super::ends::{Ends, Matrix, largest_bits};
use mceip_exact::Integer;
use num_traits::{Signed, ToPrimitive};

/// Bits of the largest entry, and of a factor of a combination.
const BITS: u64 = 62;

/// Each entry lies within r of m, in units of 2^`unit` (where the unit does not matter: of some
/// positive number). All numbers are at most 2^62 in absolute value.
pub(super) struct Short {
    pub(super) m: Vec<Vec<i64>>,
    pub(super) r: Vec<Vec<i64>>,
    unit: u64,
}

/// Every number within `radius` of `center`, as an entry.
struct ShortBall {
    center: i64,
    radius: i64,
}

/// The same before it is cut to an entry.
#[derive(Clone, Copy)]
struct WideBall {
    center: i128,
    radius: i128,
}

impl Ends {
    /// Both ends in short numbers.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        let all: Vec<usize> = (0..self.m[0].len()).collect();
        let lower = Short::of(&self.m[0], &self.r[0], &all)?;
        let upper = Short::of(&self.m[1], &self.r[1], &all)?;
        Some([lower, upper])
    }
}

impl Short {
    /// M +- R, the principal part on `keep`; `None` where the radius is far larger than the matrix.
    pub(super) fn of(m: &Matrix, r: &Matrix, keep: &[usize]) -> Option<Short> {
        let kept = keep
            .iter()
            .flat_map(|&i| keep.iter().map(move |&j| &m[i][j]));
        let unit = largest_bits(kept).saturating_sub(BITS);

        let mut short = Short::with_unit(unit, keep.len());
        for &i in keep {
            let row = keep
                .iter()
                .map(|&j| ShortBall::cut(&m[i][j], &r[i][j], unit));
            short.push_row(row)?;
        }

        Some(short)
    }

    fn with_unit(unit: u64, order: usize) -> Short {
        Short {
            m: Vec::with_capacity(order),
            r: Vec::with_capacity(order),
            unit,
        }
    }

    /// Appends a row; `None` if an entry does not fit.
    fn push_row(&mut self, row: impl ExactSizeIterator<Item = Option<ShortBall>>) -> Option<()> {
        let mut centers = Vec::with_capacity(row.len());
        let mut radii = Vec::with_capacity(row.len());
        for entry in row {
            let entry = entry?;
            centers.push(entry.center);
            radii.push(entry.radius);
        }

        self.m.push(centers);
        self.r.push(radii);
        Some(())
    }

    /// p times this plus q times the other (p, q >= 0), in some unit.
    pub(super) fn combine(&self, p: &Integer, other: &Short, q: &Integer) -> Option<Short> {
        // Both factors in a common unit, cut to short numbers.
        let low = self.unit.min(other.unit);
        let p = p << (self.unit - low);
        let q = q << (other.unit - low);
        let cut = p.bits().max(q.bits()).saturating_sub(BITS);
        let is_exact = &p >> cut << cut == p && &q >> cut << cut == q;
        let p = i128::from((p >> cut).to_i64()?);
        let q = i128::from((q >> cut).to_i64()?);
        // A factor that was cut may be larger by one unit. Sums stay below 2^126.
        let lost = i128::from(!is_exact);

        let n = self.m.len();
        let mut sums = Vec::with_capacity(n * n);
        let mut largest = 0u128;
        for i in 0..n {
            let own = self.m[i].iter().zip(&self.r[i]);
            let others = other.m[i].iter().zip(&other.r[i]);
            for ((&a, &s), (&b, &t)) in own.zip(others) {
                let a = WideBall::new(a, s);
                let b = WideBall::new(b, t);
                let center = p * a.center + q * b.center;
                let radius = p * a.radius + q * b.radius + lost * (a.magnitude() + b.magnitude());

                largest |= center.unsigned_abs();
                sums.push(WideBall { center, radius });
            }
        }

        let unit = (128 - u64::from(largest.leading_zeros())).saturating_sub(BITS);
        let mut short = Short::with_unit(unit, n);
        for row in sums.chunks_exact(n.max(1)) {
            short.push_row(row.iter().map(|sum| sum.cut(unit)))?;
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
            let row = self.m[i].iter().zip(&self.r[i]);
            for (bound, (m, r)) in bounds.iter_mut().zip(row) {
                *bound += weight * i128::from(*m) + size * i128::from(*r);
            }
        }

        Some(bounds)
    }
}

impl ShortBall {
    /// v +- r in units of 2^unit.
    fn cut(v: &Integer, r: &Integer, unit: u64) -> Option<ShortBall> {
        let center = v >> unit;
        let is_whole = &center << unit == *v;
        let is_exact = is_whole && !r.is_positive();
        let radius = r >> unit;

        ShortBall::rounded(center.to_i64()?, radius.to_i64()?, is_exact)
    }

    /// A center and a radius that have been rounded down: rounding each has cost less than one
    /// unit. `None` if one of them is larger than an entry may be.
    fn rounded(center: i64, radius: i64, is_exact: bool) -> Option<ShortBall> {
        let radius = if is_exact { 0 } else { radius.checked_add(2)? };
        let center_fits = center.unsigned_abs() <= 1 << BITS;
        let radius_fits = radius <= 1 << BITS;

        let fits = center_fits && radius_fits;
        fits.then_some(ShortBall { center, radius })
    }
}

impl WideBall {
    fn new(center: i64, radius: i64) -> WideBall {
        WideBall {
            center: center.into(),
            radius: radius.into(),
        }
    }

    fn magnitude(&self) -> i128 {
        self.center.abs() + self.radius
    }

    /// The same in units of 2^unit.
    fn cut(&self, unit: u64) -> Option<ShortBall> {
        let center = self.center >> unit;
        let is_whole = center << unit == self.center;
        let is_exact = is_whole && self.radius == 0;
        let radius = self.radius >> unit;
        ShortBall::rounded(center.to_i64()?, radius.to_i64()?, is_exact)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    fn big(rows: &[&[i64]], bits: u32) -> Matrix {
        rows.iter()
            .map(|r| {
                r.iter()
                    .map(|&v| (Integer::from(v) << bits) + v.signum())
                    .collect()
            })
            .collect()
    }

    /// Does the enclosure contain p A + q B, entry by entry, if one unit of it is `unit`?
    fn contains(short: &Short, exact: &Matrix, unit: &Integer) -> bool {
        let holds = |i: usize, j: usize| {
            (&exact[i][j] - unit * short.m[i][j]).abs() <= unit * short.r[i][j]
        };
        (0..exact.len()).all(|i| (0..exact.len()).all(|j| holds(i, j)))
    }

    #[test]
    fn long_entries_are_enclosed_and_short_ones_exact() {
        let zero = big(&[&[0, 0], &[0, 0]], 0);
        let long = big(&[&[3, -5], &[0, 7]], 100);
        let short = Short::of(&long, &zero, &[0, 1]).unwrap();
        assert!(contains(&short, &long, &(Integer::one() << short.unit)));
        assert_eq!(short.r[1][0], 0); // an exact zero stays one
        assert!(short.r[0][0] > 0);
        let exact = Short::of(&big(&[&[3, -5], &[0, 7]], 40), &zero, &[1]).unwrap();
        assert_eq!(
            (exact.m, exact.r, exact.unit),
            (vec![vec![(7 << 40) + 1]], vec![vec![0]], 0)
        );
        let wide = big(&[&[1, 1], &[1, 1]], 200);
        assert!(Short::of(&long, &wide, &[0, 1]).is_none());
    }

    /// Entries and factors of every length, B a million times smaller or larger than A.
    #[test]
    fn combinations_enclose_the_exact_ones() {
        for (bits_a, bits_b, p, q) in [
            (100, 80, 3u64, 1 << 60),
            (20, 120, u64::MAX, 7),
            (61, 61, 1, 0),
            (10, 3, 5, 9),
            (90, 0, 1, u64::MAX),
        ] {
            let (a, b) = (
                big(&[&[3, -5], &[0, 7]], bits_a),
                big(&[&[-1, 2], &[0, 1000]], bits_b),
            );
            let radius = |bits: u32| big(&[&[1, 2], &[0, 1]], bits.saturating_sub(50));
            let (ra, rb) = (radius(bits_a), radius(bits_b));
            let factor = |v: u64| (Integer::from(v) << 20) + 1;
            let (p, q) = (factor(p), factor(q));
            let short = Short::of(&a, &ra, &[0, 1])
                .unwrap()
                .combine(&p, &Short::of(&b, &rb, &[0, 1]).unwrap(), &q)
                .unwrap();
            // The unit is not kept: read it off the largest entry, generously on both sides of it.
            for sign in [-1, 1] {
                let end: Matrix = (0..2)
                    .map(|i| {
                        (0..2)
                            .map(|j| {
                                &p * (&a[i][j] + &ra[i][j] * sign)
                                    + &q * (&b[i][j] + &rb[i][j] * sign)
                            })
                            .collect()
                    })
                    .collect();
                let fits =
                    (0..400u32).any(|unit| contains(&short, &end, &(Integer::one() << unit)));
                assert!(fits, "{bits_a} {bits_b} {sign}");
            }
        }
    }

    #[test]
    fn products_bound_both_signs_of_the_radius() {
        let short = Short {
            m: vec![vec![3, -4], vec![-5, 1]],
            r: vec![vec![1, 0], vec![2, 0]],
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
        assert_eq!((short.m[0][0], short.r[0][0]), (3 << 21, 0));
        assert_eq!((short.m[0][1], short.r[0][1]), (0, 2));
    }

    /// The formula of `combine`, in integers of any length: values and radii to the last unit.
    #[test]
    fn combinations_are_those_of_the_formula() {
        let top = (1i64 << 61) - 1;
        let list = [
            (Integer::from(3), Integer::from(5)),                   // exact
            (Integer::from(3) << 70u32, Integer::from(5) << 65u32), // exact, though long
            ((Integer::from(3) << 70u32) + 1, Integer::from(5) << 65u32), // the first is cut
            (Integer::from(3) << 70u32, (Integer::from(5) << 65u32) + 1), // the second is cut
            ((Integer::one() << 80u32) - 1, (Integer::one() << 79u32) - 1), // both
            (Integer::one(), (Integer::one() << 62u32) + 1),
        ];
        let matrices = [
            (
                [[3, -5], [7, 11]],
                [[1, 2], [3, 1]],
                [[-9, 4], [6, 13]],
                [[2, 1], [1, 3]],
            ),
            (
                [[3, -5], [7, 11]],
                [[0, 0], [0, 0]],
                [[-9, 4], [6, 13]],
                [[0, 0], [0, 0]],
            ),
            (
                [[top, -top], [1, 5]],
                [[top / 7, 9], [0, 2]],
                [[top / 3, 1], [-top, 8]],
                [[0, top / 5], [1, 1]],
            ),
            (
                [[top, 0], [1, 5]],
                [[0, 1], [0, 0]],
                [[2, 1], [1, 8]],
                [[0, 0], [2, 0]],
            ),
        ];
        let rows = |m: [[i64; 2]; 2]| m.map(|r| r.to_vec()).to_vec();
        for (k, (p, q)) in list.iter().enumerate() {
            for (a, ra, b, rb) in matrices {
                for (unit_a, unit_b) in [(0, 0), (4, 0), (0, 3)] {
                    let first = Short {
                        m: rows(a),
                        r: rows(ra),
                        unit: unit_a,
                    };
                    let got = first.combine(
                        p,
                        &Short {
                            m: rows(b),
                            r: rows(rb),
                            unit: unit_b,
                        },
                        q,
                    );
                    let low = unit_a.min(unit_b);
                    let (p, q) = (p << (unit_a - low), q << (unit_b - low));
                    let cut = p.bits().max(q.bits()).saturating_sub(62);
                    let one = Integer::one() << cut;
                    let lost = i32::from(
                        &p % &one != Integer::default() || &q % &one != Integer::default(),
                    );
                    let (p, q) = (p / &one, q / &one);
                    let value = |i: usize, j: usize| &p * a[i][j] + &q * b[i][j];
                    let size = |i: usize, j: usize| {
                        Integer::from(a[i][j]).abs()
                            + ra[i][j]
                            + Integer::from(b[i][j]).abs()
                            + rb[i][j]
                    };
                    let radius =
                        |i: usize, j: usize| &p * ra[i][j] + &q * rb[i][j] + lost * size(i, j);
                    let cells = [(0, 0), (0, 1), (1, 0), (1, 1)];
                    let bits = cells
                        .iter()
                        .map(|&(i, j)| value(i, j).bits())
                        .max()
                        .unwrap()
                        .saturating_sub(62);
                    let unit = Integer::one() << bits;
                    let long = |r: &Integer| r / &unit + 2 > Integer::one() << 62u32;
                    let Some(got) = got else {
                        assert!(cells.iter().any(|&(i, j)| long(&radius(i, j))), "{k}");
                        continue;
                    };
                    for (i, j) in cells {
                        let (v, r) = (value(i, j), radius(i, j));
                        let is_exact =
                            (&v % &unit) == Integer::default() && r == Integer::default();
                        let expected = if is_exact {
                            Integer::default()
                        } else {
                            r / &unit + 2
                        };
                        assert_eq!(
                            (Integer::from(got.m[i][j]), Integer::from(got.r[i][j])),
                            (v >> bits, expected),
                            "{k} [{i}][{j}]"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn values_and_radii_have_a_limit() {
        let limit = 1i64 << BITS;
        let rounded = |center: i64, radius: i64, is_exact: bool| {
            ShortBall::rounded(center, radius, is_exact).map(|ball| (ball.center, ball.radius))
        };

        assert_eq!(rounded(limit, 0, true), Some((limit, 0)));
        assert_eq!(rounded(-limit, 0, true), Some((-limit, 0)));
        assert_eq!(rounded(limit + 1, 0, true), None);

        assert_eq!(rounded(1, limit - 2, false), Some((1, limit)));
        assert_eq!(rounded(1, limit - 1, false), None);
        assert_eq!(rounded(1, i64::MAX, false), None);
    }
}
