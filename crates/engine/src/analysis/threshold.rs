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
    /// All single values found in [0, infinity), ascending.
    pub values: Vec<Interval>,
    /// Families over an interval of mu: each mu of it is a value.
    pub intervals: Vec<SolutionFamily>,
    /// Parts of [0, infinity) in which nothing is proved.
    pub open: Vec<OpenRegion>,
    /// The certificate.
    pub evidence: Evidence,
}

impl StaticThreshold {
    /// Single values of families count as values. `proof` is the index of the certificate.
    pub(super) fn of(found: &Completed, proof: usize) -> StaticThreshold {
        let mut values = Vec::new();
        let mut intervals = Vec::new();
        for solution in &found.cover.solutions {
            values.push(solution.value.clone());
        }

        for family in &found.cover.families {
            match &family.from {
                Some(value) if family.is_point => values.push(value.clone()),
                _ => intervals.push(family.clone()),
            }
        }

        values.sort_by(|p, q| p.lo().cmp(q.lo()));

        StaticThreshold {
            values,
            intervals,
            open: found.cover.open.clone(),
            evidence: Evidence::Certificate(proof),
        }
    }

    /// The smallest value, if it is proved that there is no smaller one.
    pub fn smallest(&self) -> Option<&Interval> {
        let smallest = self.values.first()?;
        let begins_above = |open: &OpenRegion| match &open.min {
            Some(min) => min > smallest.hi(),
            None => false,
        };
        let is_first = self.open.iter().all(begins_above);
        let begins_all = |family: &SolutionFamily| match &family.from {
            Some(from) => from == smallest || from.lo() > smallest.hi(),
            None => false,
        };
        (is_first && self.intervals.iter().all(begins_all)).then_some(smallest)
    }
}
