//! Solutions of one support as a curve t(mu), in doubles, t = lambda^2.
//!
//! T comes from the expansions that the certificate will rest on, remainders left out; the rest is
//! `branch`. Called by `climb`.

use super::super::absence::HalfLineFamily;
use crate::branch::{BranchPencils, BranchPoint, BranchUnknown, Slice};
use crate::search::complete::pieces::expansion::Expansion;
use crate::search::complete::pieces::matrix::{SquareMatrix, combined, times};

/// The curves of a system.
#[derive(Clone, Copy)]
pub(super) struct Curves<'a> {
    pub(super) family: &'a HalfLineFamily,
}

impl<'a> Curves<'a> {
    pub(super) fn expansions(&self, t: f64) -> &'a [Expansion; 2] {
        self.family.expansions(self.family.anchor(t))
    }

    /// The solution of a point's support at another mu.
    pub(super) fn at_friction(&self, mu: f64, from: &BranchPoint) -> Option<BranchPoint> {
        let t = (from.t + from.slope_of_t() * (mu - from.mu)).max(0.0);
        self.solved(BranchUnknown::Lambda2, [t, mu], &from.x, &from.support)
    }
}

impl BranchPencils for Curves<'_> {
    type Slice<'b>
        = ExpansionsAt<'b>
    where
        Self: 'b;

    fn at(&self, t: f64) -> Option<ExpansionsAt<'_>> {
        let expansions = self.expansions(t);
        let parts = expansions.each_ref().map(|part| part.at(t));
        t.is_finite().then_some(ExpansionsAt {
            t,
            expansions,
            parts,
        })
    }

    fn unit(&self) -> f64 {
        self.family.view().scale
    }
}

/// T0 and T1 at one value of lambda^2.
pub(super) struct ExpansionsAt<'a> {
    t: f64,
    expansions: &'a [Expansion; 2],
    parts: [SquareMatrix; 2],
}

impl Slice for ExpansionsAt<'_> {
    fn matrix(&self, mu: f64) -> SquareMatrix {
        let [constant, slope] = &self.parts;
        combined(constant, mu, slope)
    }

    fn of_mu(&self) -> &[Vec<f64>] {
        &self.parts[1]
    }

    fn of_t(&self, mu: f64, x: &[f64]) -> Vec<f64> {
        let parts = self.expansions.each_ref();
        let [constant, slope] = parts.map(|part| part.derivative(self.t));
        times(&combined(&constant, mu, &slope), x)
    }
}
