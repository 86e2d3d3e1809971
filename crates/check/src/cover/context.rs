//! What the proofs of leaves read: the pencil, the matrices of a region, and what is left of the
//! budgets of the file.
//!
//! The pencil is T(t), or T(t, mu) = T0(t) + mu T1(t) of a mechanical system with t = lambda^2:
//! only the slip rows depend on mu, and the elimination of the free variables uses the free rows
//! and columns alone, so the condensed pencil is affine in mu as well. Each part is enclosed over
//! an interval of t by its ends (`family`), all by convex combinations with the same weights.
//!
//! The *corners* of a region are its ends; of one with an interval of mu, for both ends e of the
//! interval of t and both ends k of that of mu,
//!
//! ```text
//!     M_e0 + mu_k M_e1    with the radius    R_e0 + mu_k R_e1.
//! ```
//!
//! T is linear in mu for every t, so every T of the region is a convex combination of matrices
//! within these radii; at an infinite end, of those at the lower end plus a non-negative multiple
//! of such a combination at the upper one. What is linear in T, or convex, holds in the region if
//! it holds at the corners.
//!
//! Where the data have radii this holds of each member: its T0(t) and T1(t) lie within what the
//! ends say, and row i of its T1 is that with the friction factors in the middle times 1 + d,
//! |d| at most the share of the particle. `spread` and the linear family add the radii of K and M
//! to those of the ends, and the share of a row of T1 is added here.
//!
//! Matrices are computed once for all regions of the same intervals, and their work is taken from
//! the budget of the file.

use super::budget::{WorkBudget, entries_work};
use super::condensed::{Anchors, PencilParts};
use super::ends::{EndMatrix, Ends, FRACTION_BITS, rational_bits, within_matrix_bits};
use super::family::{Family, end_bits, words};
use super::fault::CoverFault;
use super::proved::AcceptedSolution;
use super::region::Region;
use super::sign_budget::SignBudget;
use crate::pencil::{MemberRadii, Rows};
use mceip_exact::Rational;
use mceip_model::Window;
use std::rc::Rc;

/// The ends of the interval of values, as messages name them.
const ENDS: [&str; 2] = ["lower", "upper"];

/// The same at the lower and at the higher friction.
const ENDS_OF_BOX: [[&str; 2]; 2] = [
    ["lower, low-friction", "upper, low-friction"],
    ["lower, high-friction", "upper, high-friction"],
];

/// What the proofs of leaves read, and what is left of the budgets of the file.
pub(super) struct Context<'a> {
    /// The rows of T, or of T0.
    pub(super) rows: &'a Rows,
    /// T, or T0 and T1.
    pub(super) families: Vec<Family>,
    /// How far a member may be off, where the data have radii.
    radii: Option<&'a MemberRadii>,
    /// The complementarity variables: positions in states and matrices to indices of the problem.
    pub(super) index: Vec<usize>,
    /// The anchor that the piece names.
    pub(super) anchor: Option<usize>,
    pub(super) window: &'a Window,
    /// No solution has a value at or above this.
    pub(super) tail: Option<&'a Rational>,
    /// The claims of the certificate, all accepted.
    pub(super) claims: &'a [AcceptedSolution<'a>],
    /// For the signs of support leaves.
    pub(super) sign_budget: SignBudget,
    pub(super) definite_budget: WorkBudget,
    pub(super) matrix_budget: WorkBudget,
}

impl<'a> Context<'a> {
    /// The context of a file with so many nodes in its trees.
    pub(super) fn new(
        parts: PencilParts<'_, 'a>,
        anchors: Option<&Anchors<'_>>,
        window: &'a Window,
        nodes: u64,
    ) -> Context<'a> {
        let PencilParts {
            rows: parts, radii, ..
        } = parts;
        let rows = parts[0];
        Context {
            rows,
            radii,
            families: Family::of_parts(parts, radii, anchors),
            index: rows.complementarity_variables(),
            anchor: None,
            window,
            tail: None,
            claims: &[],
            sign_budget: SignBudget::new(),
            definite_budget: WorkBudget::of_definite_leaves(parts, nodes),
            matrix_budget: WorkBudget::of_matrices(parts, nodes),
        }
    }

    /// Expands each part about the anchor that a piece names, which has to exist, the first time it
    /// is named. Without a condensation it is ignored.
    pub(super) fn use_anchor(
        &mut self,
        anchors: Option<&Anchors<'_>>,
        anchor: Option<usize>,
    ) -> Result<(), CoverFault> {
        self.anchor = anchor;
        let (Some(anchors), Some(number)) = (anchors, anchor) else {
            return Ok(());
        };
        if self.families.iter().all(|family| family.has_anchor(number)) {
            return Ok(());
        }

        for (family, expanded) in self.families.iter_mut().zip(anchors.expand(number)?) {
            family.keep_anchor(number, expanded);
        }

        Ok(())
    }

    /// Positions among the complementarity variables to indices of the problem.
    pub(super) fn problem_indices(&self, positions: Vec<usize>) -> Vec<usize> {
        positions.into_iter().map(|p| self.index[p]).collect()
    }

    /// Demands that the matrices of the region are small enough to be computed, and counts them
    /// once for all regions that share them.
    pub(super) fn affordable(&self, region: &Region) -> Result<(), CoverFault> {
        let lo = &region.lo;
        let hi = region.hi.as_deref();
        for (family, matrices) in self.families.iter().zip(&*region.parts) {
            family.affordable(self.anchor, lo, hi)?;
            let work = family.matrix_work(self.anchor, lo, hi);
            matrices.count(&self.matrix_budget, work)?;
        }

        if region.friction.is_none() {
            return Ok(());
        }

        // Each entry of the ends is multiplied by a value of mu.
        let [end_bits, friction_bits] = corner_bits(region);
        let order = self.index.len();
        let parts = self.families.len();
        let what = "bits of a box's matrix";
        within_matrix_bits(what, order, parts, end_bits + friction_bits)?;
        let products = words(end_bits).saturating_mul(words(friction_bits));
        region
            .boxed
            .count(&self.matrix_budget, entries_work(order, products))
    }

    /// The matrices at the ends of the region's interval of values; at both ends of that of mu, if
    /// it has one.
    pub(super) fn ends(&self, region: &Region) -> Result<Rc<[Ends]>, CoverFault> {
        let Some(friction) = &region.friction else {
            return self.part_ends(region, 0);
        };

        region.boxed.ends(|| {
            let plain = self.part_ends(region, 0)?;
            let of_friction = self.part_ends(region, 1)?;
            let at = |mu: &Rc<Rational>| plain[0].plus_multiple(&of_friction[0], mu);
            Ok(friction.each_ref().map(at).into())
        })
    }

    fn part_ends(&self, region: &Region, part: usize) -> Result<Rc<[Ends]>, CoverFault> {
        region.parts[part].ends(|| {
            let family = &self.families[part];
            let mut ends = family.ends(self.anchor, &region.lo, region.hi.as_deref())?;
            if let (Some(radii), 1) = (self.radii, part) {
                ends.at = ends
                    .at
                    .each_ref()
                    .map(|end| end.with_rows_off(&radii.relative));
            }
            Ok([ends].into())
        })
    }

    /// Takes from the budget of definite leaves the cube of the number of variables that may be in
    /// the support, once for two corners.
    pub(super) fn spend_definite(&self, region: &Region) -> Result<(), CoverFault> {
        let order = region.possible_support().len() as u64;
        let pairs_of_corners = if region.friction.is_some() { 2 } else { 1 };
        self.definite_budget
            .spend(order.saturating_pow(3) * pairs_of_corners)
    }
}

/// The bits of an entry of an end, and those of both ends of the interval of mu.
pub(super) fn corner_bits(region: &Region) -> [u64; 2] {
    let friction = region.friction.iter().flatten();
    [
        FRACTION_BITS + end_bits(&region.lo, region.hi.as_deref()),
        friction.map(|mu| rational_bits(mu)).sum(),
    ]
}

/// The corners of a region with these ends; those at the lower friction come first.
pub(super) fn corners(ends: &[Ends]) -> Vec<EndMatrix<'_>> {
    let names: &[[&'static str; 2]] = match ends {
        [_] => &[ENDS],
        _ => &ENDS_OF_BOX,
    };

    let mut corners = Vec::with_capacity(2 * ends.len());
    for (ends, names) in ends.iter().zip(names) {
        corners.extend(ends.corners(*names));
    }
    corners
}
