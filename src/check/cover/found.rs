//! What leaves yield, put together: single solutions, each once, and families.

use super::{CoverFault, Found};
use crate::check::AcceptedClaim;
use crate::exact::Interval;

/// Solutions of one support that no list holds: a cone of them at one value, or some at every value of an
/// interval. There is at least one at each value named; they are all x with x_i > 0 on the support that solve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SolutionFamily {
    /// Complementarity variables with x_i > 0.
    pub support: Vec<usize>,
    /// Encloses the value, or the lower end of the open interval of values.
    pub from: Interval,
    /// Encloses the upper end, the same as `from` for a single value; `None` for infinity.
    pub to: Option<Interval>,
    /// One value only?
    pub is_point: bool,
    /// Is there only one solution at each value, up to its factor?
    pub is_alone: bool,
}

impl SolutionFamily {
    /// Does the solution lie in it, or at an end of it?
    fn meets(&self, s: &AcceptedClaim) -> bool {
        let below = self.to.as_ref().is_none_or(|end| end.lo() >= s.value.hi());
        self.support == s.support && self.from.hi() <= s.value.lo() && below
    }
}

/// Families in order, each once; a solution at the end of one leaf may be the first of an interval of them in
/// the next, and then it is no single one.
pub(super) fn families(found: &mut Vec<Found>, mut list: Vec<SolutionFamily>) -> Vec<SolutionFamily> {
    let (single, more): (Vec<Found>, Vec<Found>) = found.drain(..).partition(|f| !list.iter().any(|g| g.meets(&f.solution)));
    *found = single;
    list.extend(more.into_iter().map(|f| SolutionFamily {
        support: f.solution.support,
        from: f.solution.value.clone(),
        to: Some(f.solution.value),
        is_point: true,
        is_alone: true,
    }));
    let place = |f: &SolutionFamily| {
        let to = f.to.as_ref().map(|t| (t.lo().clone(), t.hi().clone()));
        (f.support.clone(), f.from.lo().clone(), !f.is_point, to, !f.is_alone)
    };
    list.sort_by_key(place);
    // Two leaves share their end; one of them may have proved more of it.
    list.dedup_by(|b, a| (&a.support, &a.from, &a.to, a.is_point) == (&b.support, &b.from, &b.to, b.is_point));
    list
}

/// Lists each solution once. Two of one support are the same if one lies where the other is unique.
pub(super) fn distinct(mut found: Vec<Found>) -> Result<Vec<AcceptedClaim>, CoverFault> {
    found.sort_by(|p, q| {
        (&p.solution.support, p.solution.value.lo(), p.solution.value.hi()).cmp(&(
            &q.solution.support,
            q.solution.value.lo(),
            q.solution.value.hi(),
        ))
    });
    let mut kept: Vec<Found> = Vec::new();
    // Those that are the solution kept last: what is one of them is that solution.
    let mut group: Vec<Found> = Vec::new();
    for next in found {
        let overlaps = |f: &Found| f.solution.support == next.solution.support && f.solution.value.hi() >= next.solution.value.lo();
        if !group.iter().any(overlaps) {
            kept.extend(group.drain(..).next());
            group.push(next);
            continue;
        }
        let within = |v: &Interval, hull: &Interval| v.lo() >= hull.lo() && v.hi() <= hull.hi();
        let same = |f: &Found| within(&next.solution.value, &f.hull) || within(&f.solution.value, &next.hull);
        if !group.iter().any(same) {
            return Err(CoverFault::Ambiguous { support: next.solution.support });
        }
        group.push(next);
    }
    kept.extend(group.drain(..).next());
    let mut list: Vec<AcceptedClaim> = kept.into_iter().map(|f| f.solution).collect();
    list.sort_by(|p, q| (p.value.lo(), &p.support).cmp(&(q.value.lo(), &q.support)));
    Ok(list)
}
