//! Matrices of finite-element programs that are symmetric up to rounding.
//!
//! K and M are symmetric in exact arithmetic. A program that sums an entry and its mirror image in
//! two orders, or prints them with few digits, leaves a difference in the last place. The problem
//! file wants exact symmetry; [`symmetric_part`] restores it, on request only.

use crate::tolerance::ROUNDED_SYMMETRY;
use mceip_exact::{Rational, Sparse, rational};
use num_traits::{Signed, Zero};

/// What a matrix lacks to be symmetric.
#[derive(Debug, Clone, PartialEq)]
pub enum Asymmetry {
    /// Nothing, or it is not square.
    None,
    /// The largest |a_ij - a_ji| is at most 1e-12 of the largest entry.
    Rounding,
    /// It is more.
    Large,
}

/// Compares a matrix with its transpose.
pub fn asymmetry(matrix: &Sparse) -> Asymmetry {
    if matrix.rows() != matrix.cols() || matrix.first_asymmetry().is_none() {
        return Asymmetry::None;
    }

    let minus_one = rational(-1, 1);
    let difference = matrix.add_scaled(&minus_one, &matrix.transpose());
    let (numerator, denominator) = ROUNDED_SYMMETRY;
    let allowed = largest(matrix) * rational(numerator, denominator);
    if largest(&difference) <= allowed {
        Asymmetry::Rounding
    } else {
        Asymmetry::Large
    }
}

/// (A + A') / 2.
pub fn symmetric_part(matrix: &Sparse) -> Sparse {
    let half = rational(1, 2);
    let halved = Sparse::zeros(matrix.rows(), matrix.cols()).add_scaled(&half, matrix);
    halved.add_scaled(&half, &matrix.transpose())
}

fn largest(matrix: &Sparse) -> Rational {
    let sizes = matrix.entries().map(|(_, _, v)| v.abs());
    sizes.max().unwrap_or_else(Rational::zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn with_corner(value: Rational) -> Sparse {
        let entries = [(0, 0, whole(2)), (0, 1, whole(-1)), (1, 0, value)];
        Sparse::from_entries(2, 2, entries)
    }

    #[test]
    fn differences_up_to_1e_minus_12_are_rounding() {
        let allowed = rational(2, 1_000_000_000_000);
        let more = rational(3, 1_000_000_000_000);

        assert_eq!(asymmetry(&with_corner(whole(-1))), Asymmetry::None);
        assert_eq!(
            asymmetry(&with_corner(whole(-1) + allowed)),
            Asymmetry::Rounding
        );
        assert_eq!(asymmetry(&with_corner(whole(-1) - more)), Asymmetry::Large);
    }

    #[test]
    fn the_symmetric_part_is_the_mean() {
        let part = symmetric_part(&with_corner(whole(-2)));

        assert_eq!(part.get(0, 0), whole(2));
        assert_eq!(part.get(0, 1), rational(-3, 2));
        assert_eq!(part.get(1, 0), rational(-3, 2));
        assert_eq!(part.first_asymmetry(), None);
    }
}
