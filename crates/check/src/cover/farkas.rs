//! Leaves without a solution by a Farkas vector (`spec/certificates.md`, 5.8).
//!
//! T(t) is the pencil on the complementarity variables, after elimination of the free ones: y = T x
//! for every solution, and x is not zero. Every T(t) of the region is a convex combination of a
//! matrix within R0 of M0 and one within R1 of M1, its *ends* (at an infinite end: the one plus a
//! non-negative multiple of the other; see `family`). The proof is an inequality linear in T, so it
//! holds between if it holds at both ends.
//!
//! Let w_i >= 0 for all i that are not known to be in the support. Since y_i = 0 on the support,
//! w'y >= 0 for a solution. If (w'T)_j <= 0 for all j that may be in the support, then w'y = w'Tx
//! <= 0, and it is < 0 if (w'T)_j < 0 for all those j, because x is not zero, or for one j in the
//! support, because x_j > 0. Then there is no solution.
//!
//! At an infinite end, which is no value of the window, the weak inequality suffices: the matrix at
//! the lower end adds the strict one.
//!
//! Called by the walk through the trees.

use super::ball::BallMatrix;
use super::context::{Context, corners};
use super::ends::EndMatrix;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::region::Region;
use crate::certificate::VariableState;
use mceip_exact::{Integer, Rational};
use num_traits::{Signed, Zero};

/// The weights w, one per complementarity variable.
pub(super) struct Farkas<'a>(pub(super) &'a [i64]);

impl Leaf for Farkas<'_> {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        let Farkas(w) = *self;
        context.affordable(at)?;
        check_weights(at, &context.index, w)?;
        let ends = context.ends(at)?;
        check_columns(at, &corners(&ends), &context.index, w)?;
        Ok(Yield::default())
    }
}

/// Demands one weight for each complementarity variable, >= 0 off the support.
fn check_weights(region: &Region, index: &[usize], w: &[i64]) -> Result<(), CoverFault> {
    CoverFault::length("farkas", index.len(), w.len())?;
    for (i, &weight) in w.iter().enumerate() {
        if weight < 0 && region.states[i] != VariableState::InSupport {
            return Err(CoverFault::NegativeWeight {
                index: index[i],
                got: weight,
            });
        }
    }

    Ok(())
}

/// Demands that w'T <= 0 at all corners of the region, < 0 at those that are values of the window
/// for all variables that may be in the support, or for one that is.
fn check_columns(
    region: &Region,
    corners: &[EndMatrix<'_>],
    index: &[usize],
    w: &[i64],
) -> Result<(), CoverFault> {
    let mut strict_on_all = true;
    let mut strict_on_support = false;

    for j in region.possible_support() {
        let mut strict = true;
        for corner in corners {
            let bound = upper_bound(corner, w, j);
            if bound.is_positive() {
                return Err(CoverFault::NotNegative {
                    index: index[j],
                    end: corner.name,
                    got: Rational::new(bound, corner.scale.clone()),
                });
            }

            strict &= bound.is_negative() || corner.is_limit;
        }

        strict_on_all &= strict;
        strict_on_support |= strict && region.states[j] == VariableState::InSupport;
    }

    if strict_on_all || strict_on_support {
        Ok(())
    } else {
        Err(CoverFault::NotStrict)
    }
}

/// Upper bound of (w'T)_j at a corner: sum_i w_i M_ij + |w_i| R_ij.
fn upper_bound(corner: &EndMatrix<'_>, w: &[i64], j: usize) -> Integer {
    let mut bound = Integer::zero();
    for (i, &weight) in w.iter().enumerate() {
        if weight == 0 {
            continue;
        }

        let BallMatrix { m, r } = corner.matrix;
        bound += &m[i][j] * weight;

        let radius = &r[i][j];
        if !radius.is_zero() {
            bound += radius * weight.unsigned_abs();
        }
    }

    bound
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cover::ends::Ends;
    use crate::cover::order_two::{INDEX, UNDECIDED, ZERO, ends, region};
    use mceip_exact::whole;

    fn long_farkas(states: [VariableState; 2], ends: Ends, w: [i64; 2]) -> Result<(), CoverFault> {
        check_columns(&region(states), &corners(&[ends]), &INDEX, &w)
    }

    /// (w'T)_j at its largest: the radius counts with |w|, whatever the sign of w.
    #[test]
    fn radii_count_against_a_farkas_vector() {
        // (2, -3)'T = (-16, 10 - 3 c) with radii 2 * 3 + 3 * 2 = 12 and 2 * 1 + 3 * 4 = 14.
        let radius = [[3, 1], [2, 4]];
        let states = [VariableState::Undecided, VariableState::InSupport];
        let verdict = |lower: i64, upper: i64| {
            let m = [lower, upper].map(|c| [[-5, 5], [2, c]]);
            long_farkas(states, ends(m, [radius, radius], false), [2, -3])
        };
        let not_negative = |end| {
            Err(CoverFault::NotNegative {
                index: 11,
                end,
                got: whole(3),
            })
        };

        assert_eq!(verdict(9, 9), Ok(()));
        assert_eq!(verdict(7, 9), not_negative("lower"));
        assert_eq!(verdict(9, 7), not_negative("upper"));

        // At zero it is neither: here the variable of the support is the one that is not strict.
        assert_eq!(verdict(8, 9), Err(CoverFault::NotStrict));
        assert_eq!(verdict(9, 8), Err(CoverFault::NotStrict));
    }

    /// w'T <= 0, and < 0 on all or on one of the support; at infinity <= 0 is as good.
    #[test]
    fn strict_on_all_or_on_one_that_moves() {
        let verdict = |states, lower: [i64; 2], upper: [i64; 2], infinite| {
            let m = [lower, upper].map(|[a, b]| [[-a, -b], [0, 0]]);
            long_farkas(states, ends(m, [ZERO, ZERO], infinite), [1, 0])
        };
        let weak = Err(CoverFault::NotStrict);

        assert_eq!(verdict(UNDECIDED, [1, 1], [1, 1], false), Ok(()));
        assert_eq!(verdict(UNDECIDED, [1, 0], [1, 1], false), weak);
        assert_eq!(verdict(UNDECIDED, [1, 1], [1, 0], false), weak);

        let first_in_support = [VariableState::InSupport, VariableState::Undecided];
        assert_eq!(verdict(first_in_support, [1, 0], [1, 0], false), Ok(()));
        assert_eq!(verdict(first_in_support, [0, 1], [1, 1], false), weak);

        assert_eq!(verdict(UNDECIDED, [1, 1], [1, 0], true), Ok(()));
        assert_eq!(verdict(UNDECIDED, [1, 0], [1, 1], true), weak);
        assert_eq!(verdict(UNDECIDED, [1, 0], [0, 1], true), weak);

        let second_at_zero = [VariableState::Undecided, VariableState::AtZero];
        assert_eq!(verdict(second_at_zero, [1, 0], [1, 0], false), Ok(()));
    }

    #[test]
    fn weights_off_the_support_are_not_negative() {
        let verdict = |states, w: &[i64]| check_weights(&region(states), &INDEX, w);
        let second_in_support = [VariableState::AtZero, VariableState::InSupport];
        assert_eq!(verdict(second_in_support, &[0, -1]), Ok(()));

        let negative = Err(CoverFault::NegativeWeight { index: 10, got: -1 });
        assert_eq!(verdict(second_in_support, &[-1, 1]), negative);
        assert_eq!(verdict(UNDECIDED, &[-1, 1]), negative);
        assert!(matches!(
            verdict(UNDECIDED, &[1]),
            Err(CoverFault::Length { .. })
        ));
    }
}
