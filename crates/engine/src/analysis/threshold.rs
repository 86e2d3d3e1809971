//! The static threshold: the smallest value of MCEIP-mu, where lambda = 0.
//!
//! Input: a complete search of MCEIP-mu over all mu >= 0. Output: its values, and what it left
//! open. Called by [`analyse`](super::analyse). Solutions with lambda^2 > 0 may exist below it
//! (folds).

use super::evidence::Evidence;
use crate::search::complete::Completed;
use mceip_check::{OpenRegion, SolutionFamily};
use mceip_exact::Interval;

/// The static threshold: the smallest MCEIP-mu value (lambda = 0).
#[derive(Debug, Clone)]
pub struct StaticThreshold {
    /// All values found in [0, infinity), ascending.
    pub values: Vec<Interval>,
    /// Parts of [0, infinity) in which nothing is proved.
    pub open: Vec<OpenRegion>,
    /// The certificate.
    pub evidence: Evidence,
}

impl StaticThreshold {
    /// Single values of families count as values; of a family over an interval the ends alone are
    /// known, so that it is left open. `proof` is the index of the certificate.
    pub(super) fn of(found: &Completed, proof: usize) -> StaticThreshold {
        let mut values = Vec::new();
        let mut open = found.cover.open.clone();
        for solution in &found.cover.solutions {
            values.push(solution.value.clone());
        }

        for family in &found.cover.families {
            if family.is_point {
                values.push(family.from.clone());
            } else {
                open.push(open_region(family));
            }
        }

        values.sort_by(|p, q| p.lo().cmp(q.lo()));

        StaticThreshold {
            values,
            open,
            evidence: Evidence::Certificate(proof),
        }
    }

    /// The smallest value, if it is proved that there is no smaller one.
    pub fn smallest(&self) -> Option<&Interval> {
        let smallest = self.values.first()?;
        let is_alone = self.open.iter().all(|o| o.min > *smallest.hi());
        is_alone.then_some(smallest)
    }
}

/// The interval of a family as a region in which nothing is proved.
fn open_region(family: &SolutionFamily) -> OpenRegion {
    OpenRegion {
        min: family.from.lo().clone(),
        max: family.to.as_ref().map(|end| end.hi().clone()),
        moving: family.support.clone(),
        undecided: Vec::new(),
    }
}
