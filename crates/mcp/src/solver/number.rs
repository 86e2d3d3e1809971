//! The numbers the path is pivoted in: doubles in the solver, exact rationals in the tests that
//! hold Lemke's method to its finiteness theorem. One code for both.
//!
//! A tolerance guards against rounding: [`PathNumber::tolerance`] keeps it in doubles and makes it
//! zero in exact arithmetic.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::ops::Neg;

/// A number of the path, with an infinity for absent bounds.
pub(super) trait PathNumber:
    Scalar
    + Zero
    + One
    + Neg<Output = Self>
    + PartialOrd
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
{
    /// The upper bound that is none.
    fn infinity() -> Self;

    /// Is it neither infinite nor undefined?
    fn is_finite(&self) -> bool;

    /// A length that is no tolerance, such as that of the step along a ray.
    fn from_double(value: f64) -> Self;

    /// What is left of a tolerance for rounding: itself in doubles, zero where nothing is rounded.
    fn tolerance(value: f64) -> Self;

    /// For the record of pivots.
    fn to_double(&self) -> f64;

    /// A total order.
    fn order(&self, other: &Self) -> Ordering;

    /// |x|.
    fn magnitude(&self) -> Self;

    /// The largest |entry|, 0 of nothing; entries that do not compare are passed over.
    fn largest(entries: &[Self]) -> Self {
        let mut largest = Self::zero();
        for entry in entries {
            largest = largest.larger(entry.magnitude());
        }
        largest
    }

    /// The larger one; `self` if they do not compare.
    fn larger(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The smaller one; `self` if they do not compare.
    fn smaller(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

impl PathNumber for f64 {
    fn infinity() -> f64 {
        f64::INFINITY
    }
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
    fn from_double(value: f64) -> f64 {
        value
    }
    fn tolerance(value: f64) -> f64 {
        value
    }
    fn to_double(&self) -> f64 {
        *self
    }
    fn order(&self, other: &f64) -> Ordering {
        self.total_cmp(other)
    }
    fn magnitude(&self) -> f64 {
        self.abs()
    }
    fn largest(entries: &[f64]) -> f64 {
        // Four at a time, so that no entry waits for the one before.
        let (blocks, rest) = entries.as_chunks::<4>();
        let mut lanes = [0.0; 4];

        for block in blocks {
            for (largest, value) in lanes.iter_mut().zip(block) {
                if value.abs() > *largest {
                    *largest = value.abs();
                }
            }
        }

        let mut largest = 0.0;
        for value in lanes.iter().chain(rest) {
            if value.abs() > largest {
                largest = value.abs();
            }
        }
        largest
    }
}
