//! What regular leaves and pieces of presence have in common: Y ~ T'^-1 and approximate null
//! vectors u and v of T, where T' is T without the row and the column of the pivot.

use super::ends::largest_bits;
use super::family::words;
use super::fault::CoverFault;
use crate::certificate::{PresencePiece, Regular};
use mceip_exact::Integer;

/// Largest binary exponent of a witness.
const MAX_EXPONENT: u32 = 1 << 14;

/// The numbers of a witness, without the component 1 of u and v at the pivot.
pub(super) struct NullWitness<'a> {
    inverse: &'a [Vec<Integer>],
    left: &'a [Integer],
    right: &'a [Integer],
    /// The larger of both exponents.
    exponent: u32,
}

impl<'a> NullWitness<'a> {
    pub(super) fn of_leaf(leaf: &'a Regular) -> NullWitness<'a> {
        NullWitness {
            inverse: &leaf.inverse,
            left: &leaf.left,
            right: &leaf.right,
            exponent: leaf.exponent.max(leaf.inverse_exponent),
        }
    }

    pub(super) fn of_piece(piece: &'a PresencePiece) -> NullWitness<'a> {
        NullWitness {
            inverse: &piece.inverse,
            left: &piece.left,
            right: &piece.right,
            exponent: piece.exponent.max(piece.inverse_exponent),
        }
    }

    /// Demands that u, v and Y have order n, and that their exponents are within the limit.
    pub(super) fn check_shape(&self, n: usize) -> Result<(), CoverFault> {
        CoverFault::length("left", n, self.left.len())?;
        CoverFault::length("right", n, self.right.len())?;
        CoverFault::length("inverse", n, self.inverse.len())?;
        for row in self.inverse {
            CoverFault::length("inverse row", n, row.len())?;
        }

        CoverFault::at_most("exponent", MAX_EXPONENT.into(), self.exponent.into())
    }

    /// Bits of the longest number, units included.
    pub(super) fn bits(&self) -> u64 {
        let inverse = largest_bits(self.inverse.iter().flatten());
        let vectors = largest_bits(self.left.iter().chain(self.right));
        inverse.max(vectors).max(u64::from(self.exponent))
    }

    /// Products of machine words in the product of Y with four corners of order `moving`, whose
    /// entries have `corner_bits`.
    pub(super) fn work(&self, moving: usize, corner_bits: u64) -> u64 {
        let cubes = (moving as u64).saturating_pow(3) * 8;
        let own_words = words(self.bits());
        cubes
            .saturating_mul(own_words)
            .saturating_mul(words(corner_bits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(numbers: i64, exponents: [u32; 2]) -> PresencePiece {
        let number = mceip_model::file::Number(mceip_exact::whole(1));
        let integer = Integer::from(numbers);
        PresencePiece {
            to: number.clone(),
            interval: [number.clone(), number],
            anchor: None,
            support: vec![0, 1],
            pivot: 1,
            inverse: vec![vec![integer.clone()]],
            inverse_exponent: exponents[0],
            left: vec![integer.clone()],
            right: vec![integer],
            exponent: exponents[1],
        }
    }

    #[test]
    fn the_shape_is_that_of_the_order() {
        let limit = MAX_EXPONENT;
        let fault = |exponents, n| {
            let piece = piece(3, exponents);
            NullWitness::of_piece(&piece).check_shape(n).err()
        };

        assert_eq!(fault([limit, limit], 1), None);
        assert!(matches!(
            fault([limit + 1, 0], 1),
            Some(CoverFault::TooLarge { .. })
        ));
        assert!(matches!(
            fault([0, limit + 1], 1),
            Some(CoverFault::TooLarge { .. })
        ));
        assert!(matches!(fault([0, 0], 2), Some(CoverFault::Length { .. })));
    }

    /// 8 q^3 y e' with y = 1 + b / 64 for the longest of numbers and exponents.
    #[test]
    fn the_work_is_that_of_the_page() {
        let work = |numbers, exponents, corner_bits| {
            let piece = piece(numbers, exponents);
            NullWitness::of_piece(&piece).work(2, corner_bits)
        };

        assert_eq!(work(3, [0, 0], 0), 64);
        assert_eq!(work(3, [0, 0], 128), 64 * 3);
        assert_eq!(work(3, [64, 0], 127), 64 * 2 * 2);
        assert_eq!(work(3, [0, 130], 0), 64 * 3);
        assert_eq!(work(i64::MIN, [0, 0], 0), 64 * 2);
    }
}
