//! T(t) on the complementarity variables, enclosed over intervals.
//!
//! Without free variables T(t) = A + tB ([`LinearFamily`]): the ends of [lo, hi] are T(lo) and
//! T(hi), and those of a half line T(lo) and the direction B. With free variables T(t) is the Schur
//! complement, expanded about the anchors of the condensation ([`Expanded`]).
//!
//! Each row of A + tB is an integral row of the pencil divided by a power of two that makes its
//! largest entry of A less than one. Numbers are integers in units of 2^-128; what is cut off is
//! counted as a radius, and so are the radii of the data, rounded up. Rows multiplied by positive
//! numbers d_i keep the null vectors of T and the signs of y = Tx, and x'Tx becomes
//! sum d_i x_i y_i, which is zero for solutions as before.
//!
//! Called by the walks: `affordable` and `matrix_work` bound the work before `ends` does it. The
//! ends of two families are in one unit.

use super::ball::{BallMatrix, combination};
use super::budget::entries_work;
use super::condensed::Anchors;
use super::ends::{
    Ends, FRACTION_BITS, LongMatrix, largest_bits, rational_bits, within_matrix_bits,
};
use super::expanded::Expanded;
use super::fault::CoverFault;
use crate::pencil::{MemberRadii, Rows};
use mceip_exact::{Integer, Rational, cleared};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// T(t) over the window.
pub(super) enum Family {
    /// A + tB.
    Linear(LinearFamily),
    /// The condensed pencil about several anchors, those that pieces have named.
    Condensed(Vec<Option<Expanded>>),
}

/// A + tB, with the radii of the data and what was cut off.
pub(super) struct LinearFamily {
    a: BallMatrix<Integer>,
    b: BallMatrix<Integer>,
}

impl Family {
    /// The parts of the pencil, in one unit: with free variables about these anchors, none of which
    /// is expanded.
    pub(super) fn of_parts(
        parts: &[&Rows],
        radii: Option<&MemberRadii>,
        anchors: Option<&Anchors<'_>>,
    ) -> Vec<Family> {
        let bits = row_bits(parts);
        let mut families = Vec::with_capacity(parts.len());
        for (part, rows) in parts.iter().enumerate() {
            families.push(match anchors {
                Some(anchors) => Family::Condensed((0..anchors.len()).map(|_| None).collect()),
                None => {
                    let radius = radii.map(|radii| radii.of_parts()[part]);
                    Family::Linear(LinearFamily::scaled(rows, radius, &bits))
                }
            });
        }

        families
    }

    /// Is the anchor with this number expanded, or is there nothing to expand?
    pub(super) fn has_anchor(&self, number: usize) -> bool {
        match self {
            Family::Linear(_) => true,
            Family::Condensed(list) => list.get(number).is_some_and(Option::is_some),
        }
    }

    /// Keeps the expansion about the anchor with this number.
    pub(super) fn keep_anchor(&mut self, number: usize, expanded: Expanded) {
        if let Family::Condensed(list) = self
            && let Some(place) = list.get_mut(number)
        {
            *place = Some(expanded);
        }
    }

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
            Family::Condensed(_) => self.expanded(anchor)?.ends(lo, hi),
        }
    }

    /// What (hi - lo) T' may be off the difference of the ends over [lo, hi], in their unit.
    pub(super) fn slope(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<LongMatrix, CoverFault> {
        match self {
            Family::Linear(linear) => Ok(linear.slope(lo, hi)),
            Family::Condensed(_) => self.expanded(anchor)?.slope(lo, hi),
        }
    }

    /// The expansion about the anchor that a piece names, which has to exist.
    fn expanded(&self, anchor: Option<usize>) -> Result<&Expanded, CoverFault> {
        let anchors = match self {
            Family::Linear(_) => 0,
            Family::Condensed(list) => list.len(),
        };

        self.anchor(anchor).ok_or(CoverFault::Anchor {
            anchors,
            got: anchor,
        })
    }

    /// The expansion about the anchor that a piece names, if there is one.
    pub(super) fn anchor(&self, anchor: Option<usize>) -> Option<&Expanded> {
        match self {
            Family::Linear(_) => None,
            Family::Condensed(list) => list.get(anchor?)?.as_ref(),
        }
    }

    /// Demands that a matrix of the interval is small enough.
    ///
    /// It has n_s^2 entries of at most about K (128 + bits of lo and hi) bits, K the number of
    /// coefficients of the anchor's expansion, 1 without one.
    pub(super) fn affordable(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<(), CoverFault> {
        let Some(size) = self.matrix_size(anchor) else {
            return Ok(());
        };

        let per_coefficient = FRACTION_BITS + end_bits(lo, hi) + size.bound_bits;
        let what = "bits of a region's matrix";
        within_matrix_bits(what, size.order, size.coefficients, per_coefficient)
    }

    /// Products of machine words that the matrices of the interval take: n_s^2 (E K (C + E K) +
    /// 2^8).
    ///
    /// They are n_s^2 values of a polynomial of K coefficients, each of C words, at an end of E
    /// words: sums of K products of a coefficient and of powers of the end, together of E K words.
    pub(super) fn matrix_work(
        &self,
        anchor: Option<usize>,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> u64 {
        let Some(size) = self.matrix_size(anchor) else {
            return 0;
        };

        let bits = FRACTION_BITS + end_bits(lo, hi) + size.center_bits + size.bound_bits;
        let end_powers = words(bits).saturating_mul(size.coefficients as u64);
        let value_words = words(size.unit_bits).saturating_add(end_powers);
        entries_work(size.order, end_powers.saturating_mul(value_words))
    }

    /// What the size of a matrix depends on beside its interval. A condensation without the anchor
    /// that is asked for has none: it is refused by name elsewhere.
    fn matrix_size(&self, anchor: Option<usize>) -> Option<MatrixSize> {
        match self {
            Family::Linear(linear) => Some(MatrixSize {
                order: linear.a.m.len(),
                coefficients: 1,
                unit_bits: FRACTION_BITS,
                center_bits: 0,
                bound_bits: 0,
            }),
            Family::Condensed(_) => self.anchor(anchor).map(|e| MatrixSize {
                order: e.weight.len(),
                coefficients: e.coefficients,
                unit_bits: e.unit.bits(),
                center_bits: rational_bits(&e.center),
                bound_bits: e.bound_bits,
            }),
        }
    }
}

/// The sizes that a matrix of an interval and its work depend on.
struct MatrixSize {
    order: usize,
    coefficients: usize,
    unit_bits: u64,
    center_bits: u64,
    /// Of sigma and tau.
    bound_bits: u64,
}

impl LinearFamily {
    /// The pencil of a problem without free variables and the radii of its data, row i divided by
    /// 2^bits_i.
    fn scaled(rows: &Rows, radius: Option<&Rows>, bits: &[u64]) -> LinearFamily {
        let n = rows.order();
        let mut a = BallMatrix::zero(n);
        let mut b = BallMatrix::zero(n);

        for (i, (row, &bits)) in rows.rows.iter().zip(bits).enumerate() {
            let lift = FRACTION_BITS as i64 - bits as i64;
            for (j, a_j, b_j) in row {
                a.m[i][*j] = shift(a_j, lift);
                b.m[i][*j] = shift(b_j, lift);
            }

            // Rounding down costs less than one unit.
            if lift < 0 {
                a.r[i].fill(Integer::one());
                b.r[i].fill(Integer::one());
            }

            for (j, a_j, b_j) in radius.iter().flat_map(|radius| &radius.rows[i]) {
                a.r[i][*j] -= shift(&-a_j, lift); // rounded up
                b.r[i][*j] -= shift(&-b_j, lift);
            }
        }

        LinearFamily { a, b }
    }

    /// q A + p B for q >= 0, with the radius.
    fn at(&self, p: &Integer, q: &Integer) -> BallMatrix<Integer> {
        BallMatrix {
            m: combination(&self.a.m, q, &self.b.m, p),
            r: combination(&self.a.r, q, &self.b.r, &p.abs()),
        }
    }

    /// The ends over [lo, hi], in units of 1 / (common 2^128) with a common denominator of both.
    fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Ends {
        let common = lo.denom().lcm(hi.unwrap_or(lo).denom());
        let at = |t: &Rational| self.at(&cleared(t, &common), &common);
        let upper = match hi {
            Some(hi) => at(hi),
            None => self.at(&common, &Integer::zero()),
        };

        Ends {
            at: [at(lo), upper],
            slope: None,
            scale: &common << FRACTION_BITS,
            infinite: hi.is_none(),
        }
    }

    /// The radii of (hi - lo) B, in the unit of the ends; none over a half line.
    fn slope(&self, lo: &Rational, hi: Option<&Rational>) -> LongMatrix {
        let width = hi.unwrap_or(lo) - lo;
        let common = lo.denom().lcm(hi.unwrap_or(lo).denom());
        let factor = (width * common).to_integer();
        let scaled = |row: &Vec<Integer>| row.iter().map(|r| &factor * r).collect();
        self.b.r.iter().map(scaled).collect()
    }
}

/// Bit length of the largest entry of A in each row of these pencils, at least 1: it says by which
/// power of two the row is divided in all of them.
pub(super) fn row_bits(parts: &[&Rows]) -> Vec<u64> {
    let order = parts.first().map_or(0, |rows| rows.order());
    let mut bits = Vec::with_capacity(order);
    for i in 0..order {
        let entries = parts.iter().flat_map(|rows| &rows.rows[i]);
        bits.push(largest_bits(entries.map(|(_, a, _)| a)).max(1));
    }

    bits
}

/// Bits of both ends of an interval.
pub(super) fn end_bits(lo: &Rational, hi: Option<&Rational>) -> u64 {
    rational_bits(lo) + hi.map_or(0, rational_bits)
}

/// Words of 64 bits, one too many for a multiple of 64.
pub(super) fn words(bits: u64) -> u64 {
    bits / 64 + 1
}

/// v 2^bits, rounded down.
fn shift(v: &Integer, bits: i64) -> Integer {
    if bits >= 0 {
        v << bits.unsigned_abs()
    } else {
        v >> bits.unsigned_abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use num_traits::One;

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
            halves: vec![],
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
        let linear = LinearFamily::scaled(&rows, None, &row_bits(&[&rows]));
        for (i, cut) in [0, 0, 1].map(Integer::from).iter().enumerate() {
            assert!(linear.a.r[i].iter().chain(&linear.b.r[i]).all(|r| r == cut));
        }
        let (lo, hi) = (rational(2, 3), rational(7, 5));
        let ends = linear.ends(&lo, Some(&hi));
        let slope = linear.slope(&lo, Some(&hi));
        assert_eq!(
            (ends.scale, ends.infinite),
            (Integer::from(15) << 128u32, false)
        );
        for i in 0..3 {
            let radius = i64::from(i == 2);
            for j in 0..3 {
                let (a, b) = fixed(&rows, i, j);
                assert_eq!(
                    [&ends.at[0].m[i][j], &ends.at[1].m[i][j]],
                    [&(&a * 15 + &b * 10), &(&a * 15 + &b * 21)]
                );
                assert_eq!(
                    [&ends.at[0].r[i][j], &ends.at[1].r[i][j]],
                    [25 * radius, 36 * radius].map(Integer::from).each_ref()
                );
                assert_eq!(slope[i][j], Integer::from(11 * radius));
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
            let ends = LinearFamily::scaled(&rows, None, &row_bits(&[&rows])).ends(&lo, None);
            let slope = LinearFamily::scaled(&rows, None, &row_bits(&[&rows])).slope(&lo, None);
            assert!(ends.infinite);

            for i in 0..3 {
                for j in 0..3 {
                    for (end, t) in [(0, Some(&lo)), (1, None)] {
                        let unit = |v: &Integer| Rational::new(v.clone(), ends.scale.clone());
                        let distance = unit(&ends.at[end].m[i][j]) - given(&rows, i, j, t);
                        let radius = unit(&ends.at[end].r[i][j]);

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
                    assert_eq!(slope[i][j], Integer::zero());
                }
            }
        }
        assert!(
            Family::Linear(LinearFamily::scaled(&rows, None, &row_bits(&[&rows])))
                .ends(None, &whole(1), None)
                .is_ok()
        );
    }

    /// order^2 x coefficients x (128 + 1 + bits of lo and hi): 2^29 is allowed and nothing beyond.
    #[test]
    fn matrices_have_a_largest_size() {
        let rows = |n: usize| Rows {
            halves: vec![],
            rows: vec![Vec::new(); n],
            factor: vec![Integer::one(); n],
            is_free: vec![false; n],
        };
        let family = Family::of_parts(&[&rows(1024)], None, None).remove(0);
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

    /// A constant expansion about 0 in units of 1, whose sigma and tau have so many bits.
    fn expansion(order: usize, bound_bits: u64) -> Family {
        let expanded = Expanded {
            center: whole(0),
            z: vec![],
            unit: Integer::one(),
            left: vec![],
            right: vec![],
            weight: vec![whole(1); order],
            v: vec![],
            rounding: vec![],
            rounding_weight: vec![whole(1); order],
            drift: whole(0),
            gain: whole(0),
            bound_bits,
            coefficients: 1,
            reversed: false,
            spread: None,
        };
        Family::Condensed(vec![Some(expanded)])
    }

    /// 512^2 entries of 128 bits, 2 bits of the end 1, and those of sigma and tau.
    #[test]
    fn bounds_of_a_condensation_make_its_matrices_longer() {
        let longest = expansion(512, (1 << 11) - 130);
        assert_eq!(longest.affordable(Some(0), &whole(1), None), Ok(()));

        let longer = expansion(512, (1 << 11) - 129);
        let too_large = CoverFault::TooLarge {
            what: "bits of a region's matrix",
            limit: 1 << 29,
            got: (1 << 29) + (1 << 18),
        };
        assert_eq!(longer.affordable(Some(0), &whole(1), None), Err(too_large));
    }

    /// The end 1 has 2 bits and the center 0 has one: 131 bits are 3 words, 61 more are 4. The unit
    /// has one word.
    #[test]
    fn bounds_of_a_condensation_make_its_matrices_dearer() {
        let without = expansion(2, 0).matrix_work(Some(0), &whole(1), None);
        assert_eq!(without, 4 * (3 * (1 + 3) + 256));

        let with = expansion(2, 61).matrix_work(Some(0), &whole(1), None);
        assert_eq!(with, 4 * (4 * (1 + 4) + 256));
    }
}
