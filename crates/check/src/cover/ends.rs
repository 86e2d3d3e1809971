//! The enclosure of T(t) over an interval by two matrices with radii, its *ends*.
//!
//! An entry of a matrix here is an integer in units of 1 / `scale`. The radius of an entry bounds
//! how far the true number may be from it.

use super::fault::CoverFault;
use mceip_exact::{Integer, Rational};

/// A dense square integer matrix, by rows.
pub(super) type Matrix = Vec<Vec<Integer>>;

/// Fraction bits kept of each entry of a row scaled to below one.
pub(super) const FRACTION_BITS: u64 = 128;

/// Most bits that the entries of one matrix of a region, or of an anchor's expansion, may take
/// together.
pub(super) const MAX_MATRIX_BITS: u64 = 1 << 29;

/// The ends of an interval, as messages name them.
pub(super) const ENDS: [&str; 2] = ["lower", "upper"];

/// T(t) for t between two values: convex combinations of a matrix within r[0] of m[0] and one
/// within r[1] of m[1], all in units of 1 / `scale`.
///
/// At an infinite end m[1] is a direction: T(t) is a matrix within r[0] of m[0] plus a non-negative
/// multiple of one within r[1] of m[1]. (Of a reversed expansion and of a chord, m[1] is the limit
/// at infinity of a positive multiple of T(t), and all between are convex combinations.)
#[derive(Clone)]
pub(super) struct Ends {
    pub(super) m: [Matrix; 2],
    pub(super) r: [Matrix; 2],
    /// (t1 - t0) T'(t) lies within this of m[1] - m[0].
    pub(super) slope: Matrix,
    pub(super) scale: Integer,
    /// Is m[1] no value of the window, so that weak inequalities suffice there?
    pub(super) infinite: bool,
}

/// Demands that order^2 entries of so many coefficients of so many bits are at most
/// [`MAX_MATRIX_BITS`].
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
    CoverFault::at_most(what, MAX_MATRIX_BITS, got)
}

/// Bit length of numerator and denominator.
pub(crate) fn rational_bits(v: &Rational) -> u64 {
    v.numer().bits() + v.denom().bits()
}

/// Bit length of the largest number.
pub(super) fn largest_bits<'a>(values: impl Iterator<Item = &'a Integer>) -> u64 {
    values.map(Integer::bits).max().unwrap_or(0)
}
