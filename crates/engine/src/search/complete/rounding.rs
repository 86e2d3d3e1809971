//! Matrices and vectors in doubles as integers in units of a power of two.
//!
//! Witnesses stand in certificates with as few bits as still prove. Called by the leaves `root` and
//! `regular`.

use super::pieces::matrix::{SquareMatrix, largest_entry};
use mceip_exact::{Integer, truncated};

/// Binary exponent that gives the largest entry about this many bits.
pub(crate) fn exponent(matrix: &SquareMatrix, bits: i32) -> u32 {
    // Where a pivot is the whole support nothing is left to invert, and an empty Y needs no units.
    if matrix.is_empty() {
        return 0;
    }

    let largest = largest_entry(matrix).max(f64::MIN_POSITIVE);
    u32::try_from(bits - largest.log2().ceil() as i32).unwrap_or(0)
}

/// The entries rounded to multiples of 1 / `unit`.
pub(crate) fn rounded(matrix: &SquareMatrix, unit: f64) -> SquareMatrix {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| (v * unit).round() / unit).collect())
        .collect()
}

/// The entries in units of 1 / `unit`.
pub(crate) fn integers(matrix: &SquareMatrix, unit: f64) -> Vec<Vec<Integer>> {
    matrix
        .iter()
        .map(|row| row.iter().map(|v| integer(v * unit)).collect())
        .collect()
}

/// An integer from a double that holds one.
pub(crate) fn integer(v: f64) -> Integer {
    truncated(v.round()).unwrap_or_default()
}
