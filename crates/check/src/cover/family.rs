//! The pencil on the complementarity variables as a family of matrices over an interval: its two
//! ends, and how far the matrices between may be from them.
//!
//! Numbers are integers in units of 2^-128 after each row has been divided by a power of two that
//! makes its largest entry of A less than one; what is cut off is counted as a radius.

use super::CoverFault;
use super::expanded::Expanded;
use super::short::Short;
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// A dense square integer matrix, by rows.
pub(super) type Matrix = Vec<Vec<Integer>>;

/// Fraction bits kept of each entry of a row scaled to below one.
const FRACTION_BITS: u64 = 128;
/// Most bits that the entries of one matrix of a region, or of an anchor's expansion, may take
/// together.
pub(super) const MAX_MATRIX_BITS: u64 = 1 << 29;

/// T(t) for t between two values: convex combinations of (m[0] +- r[0]) and (m[1] +- r[1]), all in
/// units of 1 / `scale`. At an infinite end m[1] is the direction B, in the same units.
#[derive(Clone)]
pub(super) struct Ends {
    pub(super) m: [Matrix; 2],
    pub(super) r: [Matrix; 2],
    /// (t1 - t0) T'(t) lies within this of m[1] - m[0].
    pub(super) slope: Matrix,
    pub(super) scale: Integer,
    pub(super) infinite: bool,
}

/// The pencil over the window.
pub(super) enum Family {
    /// A + tB.
    Linear(Linear),
    /// The condensed pencil about several anchors, and what [`Expanded::short`] gives for each.
    Condensed(Vec<(Expanded, Option<[Short; 2]>)>),
}

/// A + tB with a radius per row for what was cut off.
pub(super) struct Linear {
    a: Matrix,
    b: Matrix,
    radius: Vec<Integer>,
    /// A and B in short numbers.
    short: Option<[Short; 2]>,
}

impl Family {
    /// The ends over [lo, hi] (`None`: infinity).
    pub(super) fn ends(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<Ends, CoverFault> {
        self.affordable(anchor, lo, hi)?;
        match self {
            Family::Linear(linear) => Ok(linear.ends(lo, hi)),
            Family::Condensed(list) => {
                let (expanded, _) = anchor.and_then(|k| list.get(k)).ok_or(CoverFault::Anchor {
                    anchors: list.len(),
                    got: anchor,
                })?;
                expanded.ends(lo, hi)
            }
        }
    }

    /// A matrix of the interval has n_s^2 entries of at most about K (128 + bits of lo and hi)
    /// bits, K the number of coefficients of the anchor's expansion, 1 without one.
    pub(super) fn affordable(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<(), CoverFault> {
        let (order, coefficients) = match self {
            Family::Linear(linear) => (linear.a.len(), 1),
            // What is no anchor is refused by name elsewhere.
            Family::Condensed(list) => anchor
                .and_then(|k| list.get(k))
                .map_or((0, 0), |(e, _)| (e.weight.len(), e.coefficients)),
        };
        let per_coefficient = FRACTION_BITS + rational_bits(lo) + hi.map_or(0, rational_bits);
        within_matrix_bits(
            "bits of a region's matrix",
            order,
            coefficients,
            per_coefficient,
        )
    }

    /// Products of machine words that the matrices of the interval take: n_s^2 values of a
    /// polynomial of K coefficients, each of C words, at an end of E words. Horner's rule
    /// multiplies a sum of C + k E words by E words, k < K.
    pub(super) fn matrix_work(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> u64 {
        let (order, coefficients, bits, center) = match self {
            Family::Linear(linear) => (linear.a.len(), 1, FRACTION_BITS, 0),
            Family::Condensed(list) => match anchor.and_then(|k| list.get(k)) {
                Some((e, _)) => (
                    e.weight.len(),
                    e.coefficients,
                    e.unit.bits(),
                    rational_bits(&e.center),
                ),
                None => return 0,
            },
        };

        let end_words =
            words(FRACTION_BITS + center + rational_bits(lo) + hi.map_or(0, rational_bits));
        let end_powers = end_words.saturating_mul(coefficients as u64);
        let value_words = words(bits).saturating_add(end_powers);

        let entries = (order as u64).saturating_mul(order as u64);
        entries
            .saturating_mul(end_powers)
            .saturating_mul(value_words)
    }

    /// The ends in short numbers, where the family is linear: T_0 + tT_1 is (q T_0 + p T_1) / q at
    /// t = p / q >= 0, and T_1 at infinity.
    pub(super) fn short(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Option<[Short; 2]> {
        let parts = match self {
            Family::Linear(linear) => &linear.short,
            Family::Condensed(list) => anchor
                .and_then(|k| list.get(k))
                .map_or(&None, |(_, short)| short),
        };
        let [a, b] = parts.as_ref()?;
        let at = |t: &Rational| a.combine(t.denom(), b, t.numer());
        let upper = match hi {
            Some(hi) => at(hi),
            None => a.combine(&Integer::zero(), b, &Integer::one()),
        };
        Some([at(lo)?, upper?])
    }
}

impl Ends {
    /// Both ends in short numbers.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        let all: Vec<usize> = (0..self.slope.len()).collect();
        let of = |end: usize| Short::of(&self.m[end], &self.r[end], &all);
        Some([of(0)?, of(1)?])
    }
}

impl Linear {
    /// The pencil of a problem without free variables.
    pub(super) fn of(rows: &Rows) -> Linear {
        let n = rows.order();
        let mut linear = Linear {
            a: Vec::new(),
            b: Vec::new(),
            radius: Vec::new(),
            short: None,
        };
        for row in &rows.rows {
            let bits = largest_bits(row.iter().map(|(_, a, _)| a)).max(1);
            let (mut a, mut b) = (vec![Integer::zero(); n], vec![Integer::zero(); n]);
            for (j, a_j, b_j) in row {
                a[*j] = shift(a_j, FRACTION_BITS as i64 - bits as i64);
                b[*j] = shift(b_j, FRACTION_BITS as i64 - bits as i64);
            }
            linear.a.push(a);
            linear.b.push(b);
            linear
                .radius
                .push(Integer::from(u8::from(bits > FRACTION_BITS)));
        }
        let (all, radius): (Vec<usize>, Matrix) = (
            (0..n).collect(),
            linear.radius.iter().map(|r| vec![r.clone(); n]).collect(),
        );
        let [a, b] = [&linear.a, &linear.b].map(|m| Short::of(m, &radius, &all));
        linear.short = a.zip(b).map(|(a, b)| [a, b]);
        linear
    }

    fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Ends {
        let n = self.a.len();
        let common = lo.denom().lcm(hi.unwrap_or(lo).denom());
        let at = |t: &Rational| {
            let (p, q) = (t.numer() * (&common / t.denom()), &common);
            let m: Matrix = (0..n)
                .map(|i| {
                    (0..n)
                        .map(|j| q * &self.a[i][j] + &p * &self.b[i][j])
                        .collect()
                })
                .collect();
            let r = (0..n)
                .map(|i| vec![(q + p.abs()) * &self.radius[i]; n])
                .collect();
            (m, r)
        };
        let by_row = |factor: &Integer| {
            (0..n)
                .map(|i| vec![factor * &self.radius[i]; n])
                .collect::<Matrix>()
        };
        let (m0, r0) = at(lo);
        let (m1, r1, slope) = match hi {
            Some(hi) => {
                let (m1, r1) = at(hi);
                // Common clears both.
                let width = ((hi - lo) * Rational::from_integer(common.clone())).to_integer();
                (m1, r1, by_row(&width))
            }
            None => {
                // The direction B, in the unit of the lower end.
                let direction = self
                    .b
                    .iter()
                    .map(|row| row.iter().map(|v| v * &common).collect())
                    .collect();
                (direction, by_row(&common), by_row(&Integer::zero()))
            }
        };
        Ends {
            m: [m0, m1],
            r: [r0, r1],
            slope,
            scale: common << FRACTION_BITS,
            infinite: hi.is_none(),
        }
    }
}

/// order^2 entries of so many coefficients of so many bits are at most [`MAX_MATRIX_BITS`].
pub(super) fn within_matrix_bits(
    what: &'static str,
    order: usize,
    coefficients: usize,
    bits: u64,
) -> Result<(), CoverFault> {
    let entries = (order as u64).saturating_mul(order as u64);
    let got = entries
        .saturating_mul(coefficients as u64)
        .saturating_mul(bits);
    if got > MAX_MATRIX_BITS {
        Err(CoverFault::TooLarge {
            what,
            limit: MAX_MATRIX_BITS,
            got,
        })
    } else {
        Ok(())
    }
}

/// Bit length of numerator and denominator.
pub(super) fn rational_bits(v: &Rational) -> u64 {
    v.numer().bits() + v.denom().bits()
}

/// Words of 64 bits, one too many for a multiple of 64.
fn words(bits: u64) -> u64 {
    bits / 64 + 1
}

/// v 2^bits, rounded down.
pub(super) fn shift(v: &Integer, bits: i64) -> Integer {
    if bits >= 0 {
        v << bits.unsigned_abs()
    } else {
        v >> bits.unsigned_abs()
    }
}

/// Bit length of the largest number.
pub(super) fn largest_bits<'a>(values: impl Iterator<Item = &'a Integer>) -> u64 {
    values.map(Integer::bits).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// One row short of 128 bits, one of exactly 128 and one of 131, which loses three.
    fn rows() -> Rows {
        let int = |v: i64, bits: u32| (Integer::from(v) << bits) + v;
        let row = |bits: u32| {
            vec![
                (0, int(1, bits), int(-3, 7)),
                (1, int(-1, bits - 5), int(5, 2)),
                (2, Integer::zero(), int(1, bits - 9)),
            ]
        };
        Rows {
            rows: vec![row(20), row(127), row(130)],
            factor: vec![Integer::one(); 3],
            is_free: vec![false; 3],
        }
    }

    fn floor(v: &Integer, bits: i64) -> Integer {
        let two = |k: i64| Rational::from_integer(Integer::one() << k.unsigned_abs());
        let v = Rational::from_integer(v.clone());
        (if bits < 0 {
            v / two(bits)
        } else {
            v * two(bits)
        })
        .floor()
        .to_integer()
    }

    /// Entry (i, j) of A and of B in the fixed unit.
    fn fixed(rows: &Rows, i: usize, j: usize) -> (Integer, Integer) {
        let bits = [107, 0, -3][i];
        (
            floor(&rows.rows[i][j].1, bits),
            floor(&rows.rows[i][j].2, bits),
        )
    }

    #[test]
    fn ends_are_exact_but_for_what_is_cut_off() {
        let rows = rows();
        let linear = Linear::of(&rows);
        assert_eq!(linear.radius, [0, 0, 1].map(Integer::from));
        let (lo, hi) = (rational(2, 3), rational(7, 5));
        let ends = linear.ends(&lo, Some(&hi));
        assert_eq!(
            (ends.scale, ends.infinite),
            (Integer::from(15) << 128u32, false)
        );
        for i in 0..3 {
            let radius = i64::from(i == 2);
            for j in 0..3 {
                let (a, b) = fixed(&rows, i, j);
                assert_eq!(
                    [&ends.m[0][i][j], &ends.m[1][i][j]],
                    [&(&a * 15 + &b * 10), &(&a * 15 + &b * 21)]
                );
                assert_eq!(
                    [&ends.r[0][i][j], &ends.r[1][i][j]],
                    [25 * radius, 36 * radius].map(Integer::from).each_ref()
                );
                assert_eq!(ends.slope[i][j], Integer::from(11 * radius));
            }
        }
    }

    /// Entry (i, j) of A + tB or of B, from the rows as given: divided by the power of two of row
    /// i.
    fn given(rows: &Rows, i: usize, j: usize, t: Option<&Rational>) -> Rational {
        let (_, a, b) = rows.rows[i]
            .iter()
            .find(|(column, _, _)| *column == j)
            .unwrap();
        let whole = |v: &Integer| Rational::from_integer(v.clone());

        let entry = match t {
            Some(t) => whole(a) + t * whole(b),
            None => whole(b),
        };
        let row_scale = Rational::from_integer(Integer::one() << [21u32, 128, 131][i]);
        entry / row_scale
    }

    /// Both ends are in one unit, 1 / `scale`, whatever the denominator of the lower end.
    #[test]
    fn an_infinite_end_is_the_direction() {
        let rows = rows();
        for lo in [
            whole(2),
            rational(2, 3),
            rational(1, 1000),
            rational(1001, 7),
        ] {
            let ends = Linear::of(&rows).ends(&lo, None);
            assert!(ends.infinite);

            for i in 0..3 {
                for j in 0..3 {
                    for (end, t) in [(0, Some(&lo)), (1, None)] {
                        let unit = |v: &Integer| Rational::new(v.clone(), ends.scale.clone());
                        let distance = unit(&ends.m[end][i][j]) - given(&rows, i, j, t);
                        let radius = unit(&ends.r[end][i][j]);

                        assert!(
                            distance.abs() <= radius,
                            "end {end}, entry ({i}, {j}), lo {lo}"
                        );
                        assert_eq!(
                            radius.is_zero(),
                            i != 2,
                            "end {end}, entry ({i}, {j}), lo {lo}"
                        );
                    }
                    assert_eq!(ends.slope[i][j], Integer::zero());
                }
            }
        }
        assert!(
            Family::Linear(Linear::of(&rows))
                .ends(None, &whole(1), None)
                .is_ok()
        );
    }

    /// order^2 x coefficients x (128 + 1 + bits of lo and hi): 2^29 is allowed and nothing beyond.
    #[test]
    fn matrices_have_a_largest_size() {
        let rows = |n: usize| Rows {
            rows: vec![Vec::new(); n],
            factor: vec![Integer::one(); n],
            is_free: vec![false; n],
        };
        let family = Family::Linear(Linear::of(&rows(1024)));
        // With its denominator of one bit.
        let value = |bits: u64| Rational::from_integer(Integer::one() << (bits - 2));

        // 2^20 entries: 512 bits each.
        assert_eq!(
            family.affordable(None, &value(184), Some(&value(200))),
            Ok(())
        );
        let refused = Err(CoverFault::TooLarge {
            what: "bits of a region's matrix",
            limit: 1 << 29,
            got: 513 << 20,
        });
        assert_eq!(
            family.affordable(None, &value(185), Some(&value(200))),
            refused
        );
        assert_eq!(family.affordable(None, &value(384), None), Ok(()));
        assert!(
            family.affordable(None, &value(385), None).is_err()
                && family.ends(None, &value(385), None).is_err()
        );

        // The coefficients of an expansion count; no overflow makes a size small.
        assert_eq!(within_matrix_bits("", 1024, 4, 128), Ok(()));
        assert!(
            within_matrix_bits("", 1024, 4, 129).is_err()
                && within_matrix_bits("", usize::MAX, 2, 2).is_err()
        );
    }

    /// The short numbers are there for ordinary matrices, or every leaf would be computed with long
    /// ones.
    #[test]
    fn ordinary_matrices_have_short_numbers() {
        let linear = Linear::of(&rows());
        let (lo, hi) = (rational(2, 3), rational(7, 5));
        assert!(
            linear.ends(&lo, Some(&hi)).short().is_some()
                && linear.ends(&lo, None).short().is_some()
        );
        let family = Family::Linear(linear);
        assert!(
            family.short(None, &lo, Some(&hi)).is_some() && family.short(None, &lo, None).is_some()
        );
    }
}
