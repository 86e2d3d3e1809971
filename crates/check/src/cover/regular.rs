//! Regular leaves: T(t, mu) on the support of a decided box has no null vector anywhere in the box.
//!
//! The witness is that of `bordered`. Every T(t, mu) of the box is a mean of matrices, each within
//! R_c of M_c at a corner c. With the largest values over the corners, radii included,
//!
//! ```text
//!     rho      >=  |I - Y T'|                          largest row sum
//!     epsilon  >=  |Y (T_'k + T'v)| / (1 - rho)        largest component
//!     P        >=  sum_j |T_k' + u'T'|_j
//! ```
//!
//! hold in the whole box, because the left sides are convex in T. The leaf demands rho < 1 and one
//! sign s with
//!
//! ```text
//!     s u'Tv  >  P epsilon    at all corners,
//! ```
//!
//! and so in the whole box, because u'Tv is linear in T.
//!
//! Let T x = 0 on the support with x != 0. T' is regular, so x_k is not zero: it is scaled to 1,
//! and z is x - v without k, with |z| <= epsilon. Then 0 = u'Tx = u'Tv + (T_k' + u'T') z, whose
//! last term is at most P epsilon: a contradiction. As y = 0 on the support of a solution, the box
//! holds none.
//!
//! Input: the corners, the witness on the support. Called by the walk through the trees.

use super::bordered::{Bordered, NullWitness};
use super::context::{Context, corner_bits, corners};
use super::ends::EndMatrix;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::region::Region;
use crate::certificate::Regular;
use mceip_exact::Rational;

impl Leaf for Regular {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        if at.hi.is_none() && !context.families[0].is_reversed(context.anchor) {
            return Err(CoverFault::OutcomeOnHalfLine { outcome: "regular" });
        }

        let bordered = Bordered::of_leaf(at, &context.index, self.into())?;
        context.affordable(at)?;

        // The budget of definite leaves counts order^3 as well.
        let [end_bits, friction_bits] = corner_bits(at);
        let corner_bits = end_bits + friction_bits;
        let work = NullWitness::from(self).work(bordered.support.len(), corner_bits);
        context.definite_budget.spend(work)?;

        let ends = context.ends(at)?;
        check_corners(&bordered, &corners(&ends))?;
        Ok(Yield::default())
    }
}

/// Demands that T is regular on the support.
fn check_corners(witness: &Bordered<'_>, corners: &[EndMatrix<'_>]) -> Result<(), CoverFault> {
    let blocks = witness.blocks(corners);
    let rho = witness.norm(&blocks)?;
    let epsilon = witness.error(&blocks, &rho);

    let mut largest_residual = Rational::default();
    for (block, corner) in blocks.iter().zip(corners) {
        let residual = witness.left_residual(block);
        let unit = &witness.one * corner.scale;
        largest_residual = largest_residual.max(Rational::new(residual, unit));
    }

    // s u'Tv - radius > P epsilon.
    let bound = largest_residual * epsilon;
    let mut is_above = true;
    let mut is_below = true;
    for (block, corner) in blocks.iter().zip(corners) {
        let value = witness.value(&witness.products(block));
        let unit = &witness.one * &witness.one * corner.scale;
        is_above &= Rational::new(&value.center - &value.radius, unit.clone()) > bound;
        is_below &= Rational::new(-value.center - value.radius, unit) > bound;
    }

    if is_above || is_below {
        Ok(())
    } else {
        Err(CoverFault::SignChange)
    }
}

#[cfg(test)]
mod tests;
