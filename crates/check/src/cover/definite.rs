//! Leaves without a solution by a definite symmetric part (`spec/certificates.md`, 5.9).
//!
//! T(t) is the pencil on the complementarity variables, after elimination of the free ones: y = T x
//! for every solution, x_i y_i = 0 for every i, and x is not zero. So x'DTx = sum_i d_i x_i y_i = 0
//! for every diagonal matrix D. If sym(DT) is positive definite on the variables that may be in the
//! support, then x = 0, and there is no solution. D is 1, -1, or the weights of the leaf.
//!
//! Every T(t) of the region is a convex combination of a matrix within R0 of M0 and one within R1
//! of M1 (at an infinite end: the one plus a non-negative multiple of the other; see `family`). The
//! condition is linear in T, so it holds between if it holds at both ends. At an infinite end,
//! which is no value of the window, a semidefinite matrix suffices: the matrix at the lower end
//! adds the strict inequality.
//!
//! A leaf costs the cube of the number of variables that may be in the support.
//! `enclosed_definite` decides at an end. Called by the walk through the trees.

use super::context::{Context, corners};
use super::enclosed_definite::{WeightedSum, first_not_definite};
use super::ends::EndMatrix;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::region::Region;

/// The diagonal of D in a leaf that says that sym(DT) is positive definite.
#[derive(Clone, Copy)]
pub(super) enum Definite<'a> {
    Positive,
    Negative,
    /// An integer of any sign for each complementarity variable.
    Weighted(&'a [i64]),
}

impl Leaf for Definite<'_> {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        if let Definite::Weighted(weights) = self {
            CoverFault::length(self.name(), context.index.len(), weights.len())?;
        }

        context.spend_definite(at)?;
        context.affordable(at)?;
        let ends = context.ends(at)?;
        self.check_corners(at, &corners(&ends), &context.index)?;
        Ok(Yield::default())
    }
}

impl Definite<'_> {
    /// d_i, of the complementarity variable at this position.
    pub(super) fn weight(&self, i: usize) -> i64 {
        match self {
            Definite::Positive => 1,
            Definite::Negative => -1,
            Definite::Weighted(weights) => weights[i],
        }
    }

    /// The leaf, as in the file.
    fn name(&self) -> &'static str {
        match self {
            Definite::Positive => "positive_definite",
            Definite::Negative => "negative_definite",
            Definite::Weighted(_) => "weighted_definite",
        }
    }

    /// Demands that sym(DT) is positive definite on the variables that may be in the support, at
    /// all corners of the region.
    fn check_corners(
        &self,
        region: &Region,
        corners: &[EndMatrix<'_>],
        index: &[usize],
    ) -> Result<(), CoverFault> {
        let possible = region.possible_support();
        for corner in corners {
            let twice = WeightedSum {
                matrix: corner.matrix,
                diagonal: *self,
            };
            if corner.is_limit && twice.is_zero(&possible) {
                continue; // semidefinite, which suffices there
            }

            if let Some(pivot) = first_not_definite(&twice, &possible) {
                return Err(self.fault(index[possible[pivot]], corner.name));
            }
        }

        Ok(())
    }

    fn fault(&self, index: usize, end: &'static str) -> CoverFault {
        CoverFault::NotDefinite {
            leaf: self.name(),
            index,
            expected: match self {
                Definite::Negative => "< 0",
                Definite::Positive | Definite::Weighted(_) => "> 0",
            },
            end,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::VariableState;
    use crate::cover::ends::Ends;
    use crate::cover::order_two::{INDEX, Square, UNDECIDED, ZERO, ends, region};

    fn long_definite_leaf(states: [VariableState; 2], ends: Ends) -> Result<(), CoverFault> {
        Definite::Positive.check_corners(&region(states), &corners(&[ends]), &INDEX)
    }

    fn not_positive(index: usize, end: &'static str) -> Result<(), CoverFault> {
        Err(Definite::Positive.fault(index, end))
    }

    /// A message names the leaf as the file does, and the sign that its pivots should have.
    #[test]
    fn messages_name_the_leaf_of_the_file() {
        let negative = Definite::Negative.fault(3, "lower").to_string();
        let expected = "negative_definite: expected pivot 3 of the symmetric part < 0 \
                        at the lower end";
        assert_eq!(negative, expected);
        let weighted = Definite::Weighted(&[1]).fault(3, "lower").to_string();
        assert_eq!(
            weighted,
            negative.replace("negative", "weighted").replace('<', ">")
        );
    }

    /// T = [[1, -1], [0, 1]] with D = diag(4, d): 2 sym(DT) = [[8, -4], [-4, 2d]]. The weight of a
    /// variable at rest is not looked at.
    #[test]
    fn weights_multiply_the_rows() {
        let unit = 1 << 20;
        let t = [[unit, -unit], [0, unit]];
        let verdict = |states, weights: &[i64], radius: Square| {
            let ends = ends([t, t], [radius, radius], false);
            Definite::Weighted(weights).check_corners(&region(states), &corners(&[ends]), &INDEX)
        };
        let fault = |index| Err(Definite::Weighted(&[]).fault(index, "lower"));

        assert_eq!(verdict(UNDECIDED, &[1, 1], ZERO), Ok(()));
        assert_eq!(verdict(UNDECIDED, &[4, 1], ZERO), fault(11)); // the determinant is 0
        assert_eq!(verdict(UNDECIDED, &[4, 2], ZERO), Ok(()));
        assert_eq!(verdict(UNDECIDED, &[4, -2], ZERO), fault(11));
        assert_eq!(verdict(UNDECIDED, &[4, 0], ZERO), fault(11));
        let second_at_zero = [VariableState::Undecided, VariableState::AtZero];
        assert_eq!(verdict(second_at_zero, &[4, 0], ZERO), Ok(()));

        // Row 0 of the radius counts four times.
        let radius = |r: i64| [[r, 0], [0, 0]];
        assert_eq!(verdict(UNDECIDED, &[4, 2], radius(unit / 2)), fault(11));
        assert_eq!(verdict(UNDECIDED, &[4, 2], radius(unit / 2 - 1)), Ok(()));
        let negative = |r: i64| {
            let ends = ends([t.map(|row| row.map(|v| -v)); 2], [radius(r); 2], false);
            let weights = Definite::Weighted(&[-4, -2]);
            weights.check_corners(&region(UNDECIDED), &corners(&[ends]), &INDEX)
        };
        assert_eq!(negative(unit / 2), fault(11));
        assert_eq!(negative(unit / 2 - 1), Ok(()));
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
