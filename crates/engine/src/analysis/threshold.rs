//! The static threshold: the smallest value of MCEIP-mu, where lambda = 0.

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
    /// known, so that it is left open.
    pub(super) fn of(found: &Completed) -> StaticThreshold {
        let (points, intervals): (Vec<_>, Vec<_>) =
            found.cover.families.iter().partition(|f| f.is_point);
        let mut values: Vec<Interval> = found
            .cover
            .solutions
            .iter()
            .map(|s| s.value.clone())
            .collect();
        values.extend(points.into_iter().map(|f| f.from.clone()));
        values.sort_by(|p, q| p.lo().cmp(q.lo()));
        let region = |f: &SolutionFamily| OpenRegion {
            min: f.from.lo().clone(),
            max: f.to.as_ref().map(|end| end.hi().clone()),
            moving: f.support.clone(),
            undecided: Vec::new(),
        };
        let open = found
            .cover
            .open
            .iter()
            .cloned()
            .chain(intervals.into_iter().map(region))
            .collect();
        StaticThreshold {
            values,
            open,
            evidence: Evidence::Certificate(1),
        }
    }

    /// The smallest value, if it is proved that there is no smaller one.
    pub fn smallest(&self) -> Option<&Interval> {
        self.values
            .first()
            .filter(|v| self.open.iter().all(|o| o.min > *v.hi()))
    }
}
