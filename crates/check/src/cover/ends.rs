//! The enclosure of T(t) over an interval by two matrices with radii, its *ends*.
//!
//! An entry of a matrix here is an integer in units of 1 / `scale`. The radius of an entry bounds
//! how far the true number may be from it.

use super::ball::BallMatrix;
use super::fault::CoverFault;
use mceip_exact::{Integer, Rational};

/// A dense square integer matrix, by rows.
pub(super) type LongMatrix = Vec<Vec<Integer>>;

/// Fraction bits kept of each entry of a row scaled to below one.
pub(super) const FRACTION_BITS: u64 = 128;

/// Most bits that the entries of one matrix of a region, or of an anchor's expansion, may take
/// together.
pub(super) const MAX_MATRIX_BITS: u64 = 1 << 29;

/// T(t) for t between two values: convex combinations of a matrix of the lower end and one of the
/// upper end, all in units of 1 / `scale`.
///
/// An infinite end is a direction: T(t) is a matrix of the lower end plus a non-negative multiple
/// of one of the direction. (Of a reversed expansion and of a chord, the upper end is the limit at
/// infinity of a positive multiple of T(t), and all between are convex combinations.)
#[derive(Clone)]
pub(super) struct Ends {
    /// The lower and the upper one.
    pub(super) at: [BallMatrix<Integer>; 2],
    /// (t1 - t0) T'(t) lies within this of the difference of the centers. Only the hull of a root
    /// leaf has it.
    pub(super) slope: Option<LongMatrix>,
    pub(super) scale: Integer,
    /// Is the upper end no value of the window, so that weak inequalities suffice there?
    pub(super) infinite: bool,
}

/// One end of a region: T is a convex combination of matrices of its ends.
pub(super) struct EndMatrix<'a> {
    pub(super) matrix: &'a BallMatrix<Integer>,
    pub(super) scale: &'a Integer,
    /// As messages name it.
    pub(super) name: &'static str,
    /// Is it no value of the window, so that weak inequalities suffice there?
    pub(super) is_limit: bool,
}

impl Ends {
    /// Both ends, with their names in messages.
    pub(super) fn corners(&self, names: [&'static str; 2]) -> [EndMatrix<'_>; 2] {
        [0, 1].map(|end| EndMatrix {
            matrix: &self.at[end],
            scale: &self.scale,
            name: names[end],
            is_limit: end == 1 && self.infinite,
        })
    }

    /// The ends of T0 + mu T1 from those of T0 and of T1, which are in the same unit; mu >= 0.
    ///
    /// Both convex combinations have the same weights, so that of the sum has them as well.
    pub(super) fn plus_multiple(&self, other: &Ends, mu: &Rational) -> Ends {
        Ends {
            at: [0, 1].map(|end| self.at[end].combine(mu.denom(), &other.at[end], mu.numer())),
            slope: None,
            scale: &self.scale * mu.denom(),
            infinite: self.infinite,
        }
    }
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
