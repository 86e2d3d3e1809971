//! What leaves yield, put together: single solutions, each once, and families.

use super::{CoverFault, Found};
use crate::AcceptedClaim;
use mceip_exact::Interval;

/// Solutions of one support that no list holds: a cone of them at one value, or some at every value
/// of an interval. There is at least one at each value named; they are all x with x_i > 0 on the
/// support that solve.
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

/// Families in order, each once; a solution at the end of one leaf may be the first of an interval
/// of them in the next, and then it is no single one.
pub(super) fn families(
    found: &mut Vec<Found>,
    mut list: Vec<SolutionFamily>,
) -> Vec<SolutionFamily> {
    let (single, more): (Vec<Found>, Vec<Found>) = found
        .drain(..)
        .partition(|f| !list.iter().any(|g| g.meets(&f.solution)));
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
        (
            f.support.clone(),
            f.from.lo().clone(),
            !f.is_point,
            to,
            !f.is_alone,
        )
    };
    list.sort_by_key(place);
    // Two leaves share their end; one of them may have proved more of it.
    list.dedup_by(|b, a| {
        (&a.support, &a.from, &a.to, a.is_point) == (&b.support, &b.from, &b.to, b.is_point)
    });
    list
}

/// Lists each solution once. Two of one support are the same if one lies where the other is unique.
pub(super) fn distinct(mut found: Vec<Found>) -> Result<Vec<AcceptedClaim>, CoverFault> {
    found.sort_by(|p, q| {
        (
            &p.solution.support,
            p.solution.value.lo(),
            p.solution.value.hi(),
        )
            .cmp(&(
                &q.solution.support,
                q.solution.value.lo(),
                q.solution.value.hi(),
            ))
    });
    let mut kept: Vec<Found> = Vec::new();
    // Those that are the solution kept last: what is one of them is that solution.
    let mut group: Vec<Found> = Vec::new();
    for next in found {
        let overlaps = |f: &Found| {
            f.solution.support == next.solution.support
                && f.solution.value.hi() >= next.solution.value.lo()
        };
        if !group.iter().any(overlaps) {
            kept.extend(group.drain(..).next());
            group.push(next);
            continue;
        }
        let within = |v: &Interval, hull: &Interval| v.lo() >= hull.lo() && v.hi() <= hull.hi();
        let same = |f: &Found| {
            within(&next.solution.value, &f.hull) || within(&f.solution.value, &next.hull)
        };
        if !group.iter().any(same) {
            return Err(CoverFault::Ambiguous {
                support: next.solution.support,
            });
        }
        group.push(next);
    }
    kept.extend(group.drain(..).next());
    let mut list: Vec<AcceptedClaim> = kept.into_iter().map(|f| f.solution).collect();
    list.sort_by(|p, q| (p.value.lo(), &p.support).cmp(&(q.value.lo(), &q.support)));
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn interval(a: i64, b: i64) -> Interval {
        Interval::new(whole(a), whole(b)).unwrap()
    }

    fn found(support: usize, value: [i64; 2], hull: [i64; 2]) -> Found {
        let solution = AcceptedClaim {
            support: vec![support],
            value: interval(value[0], value[1]),
        };
        Found {
            solution,
            hull: interval(hull[0], hull[1]),
        }
    }

    fn family(
        from: [i64; 2],
        to: Option<[i64; 2]>,
        is_point: bool,
        is_alone: bool,
    ) -> SolutionFamily {
        let to = to.map(|t| interval(t[0], t[1]));
        SolutionFamily {
            support: vec![0],
            from: interval(from[0], from[1]),
            to,
            is_point,
            is_alone,
        }
    }

    /// A solution within a family or at an end of it is a point of it; beside it, or of another
    /// support, it is single.
    #[test]
    fn a_single_solution_at_a_family_belongs_to_it() {
        let is_single = |support: usize, value: [i64; 2], f: SolutionFamily| {
            let mut list = vec![found(support, value, value)];
            let families = families(&mut list, vec![f]);
            assert_eq!(families.len() + list.len(), 2);
            list.len() == 1
        };
        let range = || family([2, 3], Some([7, 8]), false, true);
        let half_line = || family([2, 3], None, false, true);
        for value in [[3, 3], [3, 4], [5, 6], [7, 7], [5, 7]] {
            assert!(
                !is_single(0, value, range()) && is_single(1, value, range()),
                "{value:?}"
            );
            assert!(!is_single(0, value, half_line()));
        }
        for value in [[2, 3], [1, 1], [7, 8], [8, 8], [9, 9]] {
            assert!(is_single(0, value, range()), "{value:?}");
        }
        assert!(!is_single(0, [900, 901], half_line()) && is_single(0, [1, 2], half_line()));
        let mut list = vec![found(0, [5, 6], [4, 7])];
        let point = SolutionFamily {
            from: interval(5, 6),
            to: Some(interval(5, 6)),
            is_point: true,
            is_alone: true,
            support: vec![0],
        };
        assert_eq!(families(&mut list, vec![range()]), [range(), point]);
    }

    /// Of two leaves that share an end the one that has proved more counts, in either order.
    #[test]
    fn alone_is_kept_of_two_that_are_the_same() {
        let of = |is_alone| family([2, 2], Some([2, 2]), true, is_alone);
        for list in [vec![of(true), of(false)], vec![of(false), of(true)]] {
            assert_eq!(families(&mut Vec::new(), list), [of(true)]);
        }
        assert_eq!(
            families(&mut Vec::new(), vec![of(false), of(false)]),
            [of(false)]
        );
        // A range and the point at its end are two.
        let range = || family([2, 2], Some([2, 2]), false, true);
        assert_eq!(
            families(&mut Vec::new(), vec![range(), of(true)]),
            [of(true), range()]
        );
    }

    #[test]
    fn two_that_overlap_are_one_if_either_lies_where_the_other_is_unique() {
        let list = |a: Found, b: Found| distinct(vec![a, b]).map(|l| l.len());
        assert_eq!(
            list(found(0, [1, 4], [1, 4]), found(0, [3, 6], [0, 9])),
            Ok(1)
        );
        assert_eq!(
            list(found(0, [1, 4], [0, 9]), found(0, [3, 6], [3, 6])),
            Ok(1)
        );
        assert_eq!(
            list(found(0, [1, 4], [1, 4]), found(0, [3, 6], [3, 6])),
            Err(CoverFault::Ambiguous { support: vec![0] })
        );
        assert_eq!(
            list(found(0, [1, 4], [1, 5]), found(0, [3, 6], [2, 6])),
            Err(CoverFault::Ambiguous { support: vec![0] })
        );
        assert_eq!(
            list(found(0, [1, 4], [1, 4]), found(0, [5, 6], [5, 6])),
            Ok(2)
        );
        assert_eq!(
            list(found(0, [1, 4], [1, 4]), found(1, [3, 6], [3, 6])),
            Ok(2)
        );
    }
}
