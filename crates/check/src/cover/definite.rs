//! Leaves without a solution by a definite symmetric part (`spec/certificates.md`, 5.9).
//!
//! T(t) is the pencil on the complementarity variables, after elimination of the free ones: y = T x
//! for every solution, and x is not zero. So x'Tx = x'y = 0. If sym(T), or -sym(T), is positive
//! definite on the variables that may be in the support, then x = 0, and there is no solution.
//!
//! Every T(t) of the region is a convex combination of a matrix within R0 of M0 and one within R1
//! of M1 (at an infinite end: the one plus a non-negative multiple of the other; see `family`). The
//! condition is linear in T, so it holds between if it holds at both ends. At an infinite end,
//! which is no value of the window, a semidefinite matrix suffices: the matrix at the lower end
//! adds the strict inequality.
//!
//! A leaf costs the cube of the number of variables that may be in the support.
//! `enclosed_definite` decides at an end. Called by the walk through the trees.

use super::ball::BallMatrix;
use super::context::{Context, corners};
use super::enclosed_definite::first_not_definite;
use super::ends::EndMatrix;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::region::Region;
use mceip_exact::Integer;
use num_traits::Zero;

/// `sign` sym(T) is positive definite on the variables that may be in the support.
pub(super) struct Definite {
    pub(super) sign: i8,
}

impl Leaf for Definite {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        context.spend_definite(at)?;
        context.affordable(at)?;
        let ends = context.ends(at)?;
        check_corners(at, &corners(&ends), &context.index, self.sign)?;
        Ok(Yield::default())
    }
}

/// Demands that `sign` sym(T) is positive definite on the variables that may be in the support, at
/// all corners of the region.
fn check_corners(
    region: &Region,
    corners: &[EndMatrix<'_>],
    index: &[usize],
    sign: i8,
) -> Result<(), CoverFault> {
    let possible = region.possible_support();
    for corner in corners {
        if corner.is_limit && is_skew(corner.matrix, &possible) {
            continue; // semidefinite, which suffices there
        }

        if let Some(pivot) = first_not_definite(corner.matrix, &possible, sign) {
            return Err(not_definite(sign, index[possible[pivot]], corner.name));
        }
    }

    Ok(())
}

/// The fault of a leaf of this sign.
fn not_definite(sign: i8, index: usize, end: &'static str) -> CoverFault {
    let (leaf, expected) = if sign < 0 {
        ("negative_definite", "< 0")
    } else {
        ("positive_definite", "> 0")
    };
    CoverFault::NotDefinite {
        leaf,
        index,
        expected,
        end,
    }
}

/// Is the symmetric part on these variables exactly zero, with zero radius?
fn is_skew(matrix: &BallMatrix<Integer>, variables: &[usize]) -> bool {
    let BallMatrix { m, r } = matrix;
    for &i in variables {
        for &j in variables {
            if !(&m[i][j] + &m[j][i]).is_zero() || !r[i][j].is_zero() {
                return false;
            }
        }
    }

    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::VariableState;
    use crate::cover::ends::Ends;
    use crate::cover::order_two::{INDEX, Square, UNDECIDED, ZERO, ends, region};

    fn long_definite_leaf(states: [VariableState; 2], ends: Ends) -> Result<(), CoverFault> {
        check_corners(&region(states), &corners(&[ends]), &INDEX, 1)
    }

    fn not_positive(index: usize, end: &'static str) -> Result<(), CoverFault> {
        Err(not_definite(1, index, end))
    }

    /// A message names the leaf as the file does, and the sign that its pivots should have.
    #[test]
    fn messages_name_the_leaf_of_the_file() {
        let negative = not_definite(-1, 3, "lower").to_string();
        let expected = "negative_definite: expected pivot 3 of the symmetric part < 0 \
                        at the lower end";
        assert_eq!(negative, expected);
        assert!(
            not_definite(1, 3, "lower")
                .to_string()
                .starts_with("positive_definite: ")
        );
    }

    /// At an infinite end a symmetric part that vanishes on the possible support will do, radius
    /// included; at no other.
    #[test]
    fn a_vanishing_direction_is_definite_enough() {
        let eye = [[1 << 20, 0], [0, 1 << 20]];
        let skew = [[0, 5], [-5, 0]];
        let verdict = |m: [Square; 2], infinite: bool| {
            long_definite_leaf(UNDECIDED, ends(m, [ZERO, ZERO], infinite))
        };

        assert_eq!(verdict([eye, eye], true), Ok(()));
        assert_eq!(verdict([eye, skew], true), Ok(()));
        assert_eq!(verdict([eye, skew], false), not_positive(10, "upper"));
        assert_eq!(verdict([skew, eye], true), not_positive(10, "lower"));

        let symmetric = [[0, 5], [5, 0]];
        assert_eq!(verdict([eye, symmetric], true), not_positive(10, "upper"));
        let singular = [[1 << 20, 0], [0, 0]];
        assert_eq!(verdict([eye, singular], true), not_positive(11, "upper"));

        let with_radius = ends([eye, skew], [ZERO, [[0, 1], [0, 0]]], true);
        let refused = long_definite_leaf(UNDECIDED, with_radius);
        assert_eq!(refused, not_positive(10, "upper"));

        // Only entry (1, 1) counts, which is zero with its radius.
        let m = [eye, [[7, 9], [9, 0]]];
        let r = [ZERO, [[5, 5], [5, 0]]];
        let first_at_zero = [VariableState::AtZero, VariableState::Undecided];
        assert_eq!(long_definite_leaf(first_at_zero, ends(m, r, true)), Ok(()));
    }
}
