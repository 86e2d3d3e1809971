//! How far the condensed pencil of a member may be from that in the middle.
//!
//! A member has T + D in place of T, with |D| <= R(t) = R_A + t R_B entry by entry and D_ff
//! symmetric. With the same W and V its Schur complement is
//!
//! ```text
//!     (T_ss - T_sf W - V'r)  +  (D_ss - D_sf W - V'(D_fs - D_ff W))  -  l_D' (F + D_ff)^-1 r_D
//!     r_D = r + D_fs - D_ff W,        l_D = l + D_sf' - D_ff V.
//! ```
//!
//! So with |W(d)| <= W_max and |V(d)| <= V_max for |d| <= reach, and R at the largest t,
//!
//! ```text
//!     P = R_fs + R_ff W_max,        Q = R_sf' + R_ff V_max,        E = R_ss + R_sf W_max + V_max'P
//! ```
//!
//! bound what r, l and the bracket gain: the norms of the columns of P and Q are added to those of
//! r and l, and E to the radius of each entry. F + D_ff is symmetric, and at least
//! (sigma + t tau) I, because that is demanded of every member (`condensed`).
//!
//! W_max and V_max are rounded up to units of 2^-64. Input: the blocks of the radii, in the scale
//! of those of the pencil. Called by `condensed` where the data of a problem have radii.

use super::condensed::{
    IntegralBlocks, LinearBlocks, MatrixPolynomial, add_squares, norms, ones, transpose,
};
use super::ends::{FRACTION_BITS, LongMatrix};
use super::fault::CoverFault;
use super::product::Linear;
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Most bits of the integral part of what an anchor serves, and bits to which it is rounded up: the
/// ends of pieces may be long numbers, and every number here would be as long.
const MAX_EXPONENT: u64 = 1 << 12;
const REACH_BITS: u64 = 64;

/// Fraction bits of W_max and V_max.
const BOUND_BITS: u64 = FRACTION_BITS / 2;

/// What the expansion about an anchor gains.
pub(super) struct MemberSpread {
    /// Norms of the columns of P and Q, in the units of those of r and l.
    pub(super) right: Vec<Integer>,
    pub(super) left: Vec<Integer>,
    /// E in units of 2^-[`FRACTION_BITS`], its rows divided as those of the pencil.
    pub(super) entries: LongMatrix,
}

/// The values that an anchor serves, in its own variable (t, or 1 / t): how far they are from its
/// center, and the largest of them.
pub(super) struct Reach {
    pub(super) distance: Rational,
    pub(super) top: Rational,
}

impl Reach {
    /// The same with short numbers, none smaller.
    ///
    /// # Errors
    /// [`CoverFault::TooLarge`] for values of 2^[`MAX_EXPONENT`] and more.
    pub(super) fn rounded_up(&self) -> Result<Reach, CoverFault> {
        Ok(Reach {
            distance: rounded_up(&self.distance)?,
            top: rounded_up(&self.top)?,
        })
    }
}

/// The number itself where it is short, or else a short one above it: by at most 2^-62 of it, or
/// 2^-[`MAX_EXPONENT`].
fn rounded_up(v: &Rational) -> Result<Rational, CoverFault> {
    let [numerator, denominator] = [v.numer().bits(), v.denom().bits()];
    if numerator.max(denominator) <= REACH_BITS {
        return Ok(v.clone());
    }

    let what = "bits of the integral part of what an anchor serves";
    CoverFault::at_most(what, MAX_EXPONENT, v.to_integer().bits())?;
    let fraction_bits = (REACH_BITS + denominator.saturating_sub(numerator)).min(MAX_EXPONENT);
    let scaled = (v.numer() << fraction_bits).div_ceil(v.denom());
    Ok(Rational::new(scaled, Integer::one() << fraction_bits))
}

/// W and V about a center.
pub(super) struct AnchorWitness<'a> {
    pub(super) center: &'a Rational,
    pub(super) w: &'a MatrixPolynomial<'a>,
    pub(super) v: &'a MatrixPolynomial<'a>,
}

/// The radii at the largest value, in units of 1 / (D times its denominator).
struct RadiiAtTop {
    ff: RadiusRows,
    fs: RadiusRows,
    sf: RadiusRows,
    sf_transposed: RadiusRows,
    ss: RadiusRows,
}

/// Rows of (column, value).
type RadiusRows = Vec<Vec<(usize, Integer)>>;

impl MemberSpread {
    /// From the blocks of the radii, for values within `reach`.
    pub(super) fn of(
        radii: &IntegralBlocks,
        about: &AnchorWitness<'_>,
        reach: &Reach,
    ) -> MemberSpread {
        let at_top = RadiiAtTop::of(radii, &reach.top);
        let shape = [radii.free, radii.slip];
        let w = largest_values(about.w, &reach.distance, shape);
        let v = largest_values(about.v, &reach.distance, shape);

        // In units of 2^-64 of those of the radii.
        let p = bound_of_residual(&at_top.fs, &at_top.ff, &w, radii.slip);
        let q = bound_of_residual(&at_top.sf_transposed, &at_top.ff, &v, radii.slip);

        let in_units_of = |residual: &LongMatrix, exponent: u32| {
            let mut squares = vec![Integer::zero(); radii.slip];
            for row in residual {
                add_squares(&mut squares, row.iter());
            }
            let factor = about.center.denom() << exponent;
            let unit = reach.top.denom() << BOUND_BITS;
            let columns = norms(&squares, &ones(radii.slip)).into_iter();
            columns
                .map(|norm| (norm * &factor).div_ceil(&unit))
                .collect()
        };

        MemberSpread {
            right: in_units_of(&p, about.w.exponent),
            left: in_units_of(&q, about.v.exponent),
            entries: entries(radii, &at_top, &w, &v, &p, reach),
        }
    }
}

/// E, from R_ss and R_sf W_max and V_max'P.
fn entries(
    radii: &IntegralBlocks,
    at_top: &RadiiAtTop,
    w: &LongMatrix,
    v: &LongMatrix,
    p: &LongMatrix,
    reach: &Reach,
) -> LongMatrix {
    let mut sum = vec![vec![Integer::zero(); radii.slip]; radii.slip];
    for (i, row) in at_top.ss.iter().enumerate() {
        for (j, value) in row {
            sum[i][*j] += value << (2 * BOUND_BITS);
        }
    }
    for (i, row) in at_top.sf.iter().enumerate() {
        for (k, value) in row {
            add_multiple(&mut sum[i], &(value << BOUND_BITS), &w[*k]);
        }
    }
    for (v_row, p_row) in v.iter().zip(p) {
        for (target, v_i) in sum.iter_mut().zip(v_row) {
            add_multiple(target, v_i, p_row);
        }
    }

    // In units of 1 / (D q 2^128), which are those of the pencil but for D q and the power of two
    // that its row is divided by.
    let unit = &radii.common * reach.top.denom();
    for (row, bits) in sum.iter_mut().zip(&radii.bits) {
        let unit = &unit << *bits;
        for entry in row {
            *entry = entry.div_ceil(&unit);
        }
    }

    sum
}

impl RadiiAtTop {
    fn of(radii: &IntegralBlocks, top: &Rational) -> RadiiAtTop {
        // The free rows are multiples of D already.
        let one = Integer::one();
        let LinearBlocks { ff, fs, sf, ss } = &radii.of_t;
        RadiiAtTop {
            ff: at(ff, top, &one),
            fs: at(fs, top, &one),
            sf: at(sf, top, &radii.common),
            sf_transposed: at(&transpose(sf, radii.free), top, &radii.common),
            ss: at(ss, top, &radii.common),
        }
    }
}

/// `factor` (q A + p B) for t = p/q.
fn at(block: &Linear, t: &Rational, factor: &Integer) -> RadiusRows {
    let mut rows = RadiusRows::with_capacity(block.len());
    for row in block {
        let value = |a: &Integer, b: &Integer| (t.denom() * a + t.numer() * b) * factor;
        rows.push(row.iter().map(|(j, a, b)| (*j, value(a, b))).collect());
    }

    rows
}

/// sum |W_k| distance^k entry by entry, rounded up to units of 2^-[`BOUND_BITS`].
fn largest_values(
    polynomial: &MatrixPolynomial<'_>,
    distance: &Rational,
    [rows, columns]: [usize; 2],
) -> LongMatrix {
    let degree = polynomial.coefficients.len();
    let [p, q] = [distance.numer(), distance.denom()];
    let power = |base: &Integer, exponent: usize| num_traits::pow(base.clone(), exponent);
    let unit = power(q, degree) << polynomial.exponent;

    let mut sum = vec![vec![Integer::zero(); columns]; rows];
    for (k, coefficient) in polynomial.coefficients.iter().enumerate() {
        let weight = (power(p, k) * power(q, degree - k)) << BOUND_BITS;
        let factors: Vec<Integer> = coefficient
            .column_factors
            .iter()
            .map(|f| f * &weight)
            .collect();
        for (target, row) in sum.iter_mut().zip(coefficient.matrix) {
            for ((target, entry), factor) in target.iter_mut().zip(row.iter()).zip(&factors) {
                *target += entry.abs() * factor;
            }
        }
    }

    for entry in sum.iter_mut().flatten() {
        *entry = entry.div_ceil(&unit);
    }

    sum
}

/// R_fs + R_ff W_max: P, or with the transpose of R_sf and V_max Q.
fn bound_of_residual(
    coupling: &RadiusRows,
    free: &RadiusRows,
    largest: &LongMatrix,
    slip: usize,
) -> LongMatrix {
    let mut bound = Vec::with_capacity(free.len());
    for (coupling, free) in coupling.iter().zip(free) {
        let mut row = vec![Integer::zero(); slip];
        for (j, value) in coupling {
            row[*j] += value << BOUND_BITS;
        }
        for (k, value) in free {
            add_multiple(&mut row, value, &largest[*k]);
        }
        bound.push(row);
    }

    bound
}

fn add_multiple(target: &mut [Integer], factor: &Integer, row: &[Integer]) {
    if factor.is_zero() {
        return;
    }

    for (target, entry) in target.iter_mut().zip(row) {
        *target += factor * entry;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// Long numbers become short ones that are hardly larger, and none becomes smaller.
    #[test]
    fn what_an_anchor_serves_is_rounded_up() {
        let two = |exponent: u32| Rational::from_integer(Integer::one() << exponent);
        assert_eq!(rounded_up(&rational(7, 3)), Ok(rational(7, 3)));

        for long in [
            two(200) + rational(1, 3),
            (two(200) + whole(1)) / (two(201) - whole(3)),
            two(2000).recip() * rational(5, 3),
            two(5000).recip(),
        ] {
            let rounded = rounded_up(&long).unwrap();
            assert!(rounded >= long);
            assert!(&rounded - &long <= &long / two(62) + two(4096).recip());
            assert!(rounded.denom().bits() <= 4097 && rounded.numer().bits() <= 4200);
        }

        let refused = rounded_up(&two(5000));
        assert!(matches!(refused, Err(CoverFault::TooLarge { .. })));
    }
}
