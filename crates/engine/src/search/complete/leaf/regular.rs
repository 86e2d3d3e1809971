//! Leaf `regular`: T(t, mu) on the support of a decided box has no null vector anywhere in the box.
//!
//! L is the support, k its pivot, T' the block of T without k. With Y ~ T'^-1 and u, v ~ null
//! vectors that are 1 at k, all from the middle of the box, the leaf holds if at the four corners
//!
//! ```text
//!     rho = |I - Y T'| < 1    and    s u'Tv > P epsilon,
//!     epsilon = |Y (T_'k + T'v)| / (1 - rho),    P = sum_j |T_k' + u'T'|_j,
//! ```
//!
//! largest values over the corners, radii included. At the middle both residuals vanish, so that
//! P epsilon is of second order in the size of the box.
//!
//! The pivot is the one with the largest |(T_LL^-1)_kk| = |det T' / det T_LL| at the middle.
//! Numbers are rounded to the fewest bits that still prove. Called by `analysis::absence`
//! for decided boxes with finite ends. The checker's side is `check::cover::regular`.

use crate::bordered::{NullVectors, largest};
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::pieces::matrix::{SquareMatrix, principal_block};
use crate::search::complete::region::support;
use crate::search::complete::rounding::exponent;
use crate::tolerance::REGULAR_MARGIN;
use mceip_check::certificate::{Node, Regular, VariableState};
use mceip_mcp::linear::inverse;

/// Bits tried for the largest number of Y, and of u and v.
const BITS: [i32; 3] = [12, 22, 40];

/// Y, u and v of a decided box.
pub(crate) struct RegularWitness(NullVectors);

/// What the corners of a box make of a witness.
struct WitnessBounds {
    /// rho.
    norm: f64,
    /// P epsilon.
    product: f64,
    /// The least s u'Tv, what the radii may take from it subtracted; of the better sign s.
    distance: f64,
}

impl WitnessBounds {
    /// Of these vectors, over both ends of each interval.
    fn of(vectors: &NullVectors, corners: &[ChordEnds]) -> WitnessBounds {
        let ones = vec![1.0; vectors.rest.len()];
        let mut norm: f64 = 0.0;
        let mut error: f64 = 0.0;
        let mut residual: f64 = 0.0;
        let mut above = f64::INFINITY;
        let mut below = f64::INFINITY;

        for corner in vectors.corners(corners) {
            let products = corner.products();
            norm = norm.max(largest(corner.deviations(&ones)));
            error = error.max(largest(corner.errors(&products)));
            residual = residual.max(corner.left_residual(&ones));

            let value = corner.value(&products);
            above = above.min(value.center - value.radius);
            below = below.min(-value.center - value.radius);
        }

        WitnessBounds {
            norm,
            product: residual * error / (1.0 - norm).max(f64::MIN_POSITIVE),
            distance: above.max(below),
        }
    }

    /// Does the leaf hold, by a margin for what doubles do not see?
    fn hold(&self) -> bool {
        self.norm < 1.0 - REGULAR_MARGIN && self.excess() < 0.0
    }

    /// How far the inequality of the sign is from holding: negative where it holds.
    fn excess(&self) -> f64 {
        (1.0 + REGULAR_MARGIN) * self.product - self.distance
    }
}

impl RegularWitness {
    /// The witness of the middle of a box, where T is `matrix`; `None` where nothing moves or T is
    /// singular to doubles.
    pub(crate) fn of(matrix: &SquareMatrix, states: &[VariableState]) -> Option<RegularWitness> {
        let support = support(states);
        let whole = inverse(&principal_block(matrix, &support))?;
        let size = |place: usize| whole[place][place].abs();
        let place = (0..support.len()).max_by(|&i, &j| size(i).total_cmp(&size(j)))?;

        NullVectors::of(matrix, &support, place).map(RegularWitness)
    }

    /// The leaf, if it holds at these corners; `index` gives the problem's numbers of positions.
    pub(crate) fn leaf(&self, corners: &[ChordEnds], index: &[usize]) -> Option<Node> {
        if !WitnessBounds::of(&self.0, corners).hold() {
            return None;
        }

        BITS.iter()
            .find_map(|&bits| self.rounded_leaf(bits, corners, index))
    }

    /// How far the leaf is from holding at these corners; infinite where T' may be singular.
    pub(crate) fn excess(&self, corners: &[ChordEnds]) -> f64 {
        let bounds = WitnessBounds::of(&self.0, corners);
        if bounds.norm < 1.0 {
            bounds.excess()
        } else {
            f64::INFINITY
        }
    }

    /// The leaf with numbers of so many bits, if it still holds.
    fn rounded_leaf(&self, bits: i32, corners: &[ChordEnds], index: &[usize]) -> Option<Node> {
        let NullVectors {
            inverse,
            left,
            right,
            pivot,
            ..
        } = &self.0;
        let vectors = vec![left.clone(), right.clone(), vec![1.0]];
        let inverse_exponent = exponent(inverse, bits);
        let exponent = exponent(&vectors, bits);
        let [inverse_unit, unit] = [inverse_exponent, exponent].map(|e| f64::from(e).exp2());

        let short = self.0.rounded(inverse_unit, unit);
        if !WitnessBounds::of(&short, corners).hold() {
            return None;
        }

        let integers = short.integers(inverse_unit, unit);
        Some(Node::Regular(Box::new(Regular {
            pivot: index[*pivot],
            inverse: integers.inverse,
            inverse_exponent,
            left: integers.left,
            right: integers.right,
            exponent,
        })))
    }
}
