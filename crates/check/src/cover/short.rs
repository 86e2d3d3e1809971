//! Enclosures of a matrix in machine integers. What holds for them holds for the matrix; what they
//! cannot tell is computed with the long numbers of `family`. They are there for speed only.

use super::family::Matrix;
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

impl Short {
    /// M +- R, the principal part on `keep`; `None` where the radius is far larger than the matrix.
    pub(super) fn of(m: &Matrix, r: &Matrix, keep: &[usize]) -> Option<Short> {
        let pick = |list: &Matrix| {
            keep.iter()
                .map(|&i| keep.iter().map(|&j| list[i][j].clone()).collect())
                .collect::<Matrix>()
        };
        let (m, r) = (pick(m), pick(r));
        let unit = m
            .iter()
            .flatten()
            .map(Integer::bits)
            .max()
            .unwrap_or(0)
            .saturating_sub(BITS);
        let cut = |v: &Integer, r: &Integer| {
            let low = v >> unit;
            let is_exact = &low << unit == *v;
            around(
                low.to_i64()?,
                (r >> unit).to_i64()?,
                is_exact && !r.is_positive(),
            )
        };
        Short::from_entries(
            m.iter()
                .zip(&r)
                .map(|(m, r)| m.iter().zip(r).map(|(v, r)| cut(v, r))),
            unit,
        )
    }

    /// p times this plus q times the other (p, q >= 0), in some unit.
    pub(super) fn combine(&self, p: &Integer, other: &Short, q: &Integer) -> Option<Short> {
        let low = self.unit.min(other.unit);
        let (p, q) = (p << (self.unit - low), q << (other.unit - low));
        let cut = p.bits().max(q.bits()).saturating_sub(BITS);
        let is_exact = &p >> cut << cut == p && &q >> cut << cut == q;
        let (p, q) = ((p >> cut).to_i64()?, (q >> cut).to_i64()?);
        // A factor that was cut may be larger by one unit. Sums stay below 2^126.
        let (n, lost) = (self.m.len(), i128::from(!is_exact));
        let (mut sums, mut largest) = (Vec::with_capacity(n * n), 0u128);
        for ((m, r), (other_m, other_r)) in
            self.m.iter().zip(&self.r).zip(other.m.iter().zip(&other.r))
        {
            for ((a, s), (b, t)) in m.iter().zip(r).zip(other_m.iter().zip(other_r)) {
                let [a, b, s, t] = [a, b, s, t].map(|v| i128::from(*v));
                let value = i128::from(p) * a + i128::from(q) * b;
                largest |= value.unsigned_abs();
                sums.push((
                    value,
                    i128::from(p) * s + i128::from(q) * t + lost * (a.abs() + s + b.abs() + t),
                ));
            }
        }
        let unit = (128 - u64::from(largest.leading_zeros())).saturating_sub(BITS);
        let cut = |(v, r): &(i128, i128)| {
            around(
                (v >> unit).to_i64()?,
                (r >> unit).to_i64()?,
                v >> unit << unit == *v && *r == 0,
            )
        };
        Short::from_entries(
            sums.chunks_exact(n.max(1)).map(|row| row.iter().map(cut)),
            unit,
        )
    }

    fn from_entries(
        rows: impl Iterator<Item = impl ExactSizeIterator<Item = Option<(i64, i64)>>>,
        unit: u64,
    ) -> Option<Short> {
        let (mut m, mut r) = (Vec::new(), Vec::new());
        for row in rows {
            let (mut values, mut radii) =
                (Vec::with_capacity(row.len()), Vec::with_capacity(row.len()));
            for entry in row {
                let (value, radius) = entry?;
                values.push(value);
                radii.push(radius);
            }
            m.push(values);
            r.push(radii);
        }
        Some(Short { m, r, unit })
    }

    /// Upper bounds of (w'T)_j for every j of both signs of error; `None` for weights too long.
    pub(super) fn product(&self, w: &[i64]) -> Option<Vec<i128>> {
        // With |w| summing to less than 2^63 every sum below stays under 2^126.
        let size: u128 = w.iter().map(|w| u128::from(w.unsigned_abs())).sum();
        if size >= 1 << 63 {
            return None;
        }
        let mut bound = vec![0i128; w.len()];
        for (i, &w) in w.iter().enumerate().filter(|(_, w)| **w != 0) {
            let (value, size) = (i128::from(w), i128::from(w.unsigned_abs()));
            for (bound, (m, r)) in bound.iter_mut().zip(self.m[i].iter().zip(&self.r[i])) {
                *bound += value * i128::from(*m) + size * i128::from(*r);
            }
        }
        Some(bound)
    }
}

/// A number and radius rounded down, with what rounding both may have cost.
fn around(value: i64, radius: i64, is_exact: bool) -> Option<(i64, i64)> {
    let radius = if is_exact { 0 } else { radius.checked_add(2)? };
    (value.unsigned_abs() <= 1 << BITS && radius <= 1 << BITS).then_some((value, radius))
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
        assert_eq!(
            [
                around(limit, 0, true),
                around(-limit, 0, true),
                around(limit + 1, 0, true)
            ],
            [Some((limit, 0)), Some((-limit, 0)), None]
        );
        assert_eq!(
            [around(1, limit - 2, false), around(1, limit - 1, false)],
            [Some((1, limit)), None]
        );
        assert_eq!(around(1, i64::MAX, false), None);
    }
}
