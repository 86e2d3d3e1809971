//! What the leaves yield, put together: every solution once, and every family once.
//!
//! Two leaves may yield the same solution, because intervals share their ends and the interval of a
//! root may reach beyond its leaf. A leaf that yields a solution with the interval v has proved
//! that it is the only one of its support with a value in the hull h, and v lies in h. So of two
//! solutions of one support with intervals v, v' and hulls h, h':
//!
//! * if v and v' have no point in common, they are different;
//! * if v lies in h', or v' in h, they are the same;
//! * else they could be one or two, and the cover is rejected.

use super::fault::CoverFault;
use super::proved::{AcceptedCover, LeafSolution, SolutionFamily};
use crate::AcceptedClaim;
use mceip_exact::{Interval, Rational};

impl SolutionFamily {
    /// Does the solution lie in it, or at an end of it?
    fn meets(&self, s: &AcceptedClaim) -> bool {
        let begins_before = match &self.from {
            Some(from) => from.hi() <= s.value.lo(),
            None => true,
        };
        let ends_after = match &self.to {
            Some(to) => to.lo() >= s.value.hi(),
            None => true,
        };
        self.support == s.support && begins_before && ends_after
    }

    /// The family of one solution alone at one value.
    fn of_single(solution: AcceptedClaim) -> SolutionFamily {
        SolutionFamily {
            support: solution.support,
            from: Some(solution.value.clone()),
            to: Some(solution.value),
            is_point: true,
            is_alone: true,
        }
    }

    /// Families are listed by support and lower end, points first, and of two that are the same
    /// first the one of which more is proved.
    fn order_key(&self) -> impl Ord + use<> {
        let to = self.to.as_ref().map(|t| (t.lo().clone(), t.hi().clone()));
        (
            self.support.clone(),
            self.from.as_ref().map(|from| from.lo().clone()),
            !self.is_point,
            to,
            !self.is_alone,
        )
    }

    fn is_same(&self, other: &SolutionFamily) -> bool {
        self.support == other.support
            && self.from == other.from
            && self.to == other.to
            && self.is_point == other.is_point
    }
}

/// Lists the families in order, each once.
///
/// A solution at the end of one leaf may be the first of a family in the next. Then it is no single
/// solution: it is taken out of `found` and listed as a family of one point.
pub(super) fn families(
    found: &mut Vec<LeafSolution>,
    mut list: Vec<SolutionFamily>,
) -> Vec<SolutionFamily> {
    let mut of_families = Vec::new();
    for f in std::mem::take(found) {
        if list.iter().any(|family| family.meets(&f.solution)) {
            of_families.push(SolutionFamily::of_single(f.solution));
        } else {
            found.push(f);
        }
    }

    list.extend(of_families);

    list.sort_by_key(SolutionFamily::order_key);
    // Two leaves share their end, and one of them may have proved more of it: that one is kept.
    list.dedup_by(|next, kept| kept.is_same(next));
    list
}

/// What two covers have proved together of values below 0 and above. What has the value 0 is in
/// both, proved by the interval [0, 0]: no other evidence proves a solution at an end of a window.
pub(super) fn joined(below: AcceptedCover, above: AcceptedCover) -> AcceptedCover {
    let solutions = below.solutions.into_iter().chain(above.solutions);
    let mut found: Vec<LeafSolution> = Vec::new();
    for solution in solutions {
        found.push(LeafSolution {
            hull: solution.value.clone(),
            solution,
        });
    }
    let list = below.families.into_iter().chain(above.families).collect();
    let families = families(&mut found, list);

    let mut solutions: Vec<AcceptedClaim> = found.into_iter().map(|f| f.solution).collect();
    solutions.sort_by(|p, q| by_value(p).cmp(&by_value(q)));
    solutions.dedup();
    AcceptedCover {
        families,
        solutions,
        open: below.open.into_iter().rev().chain(above.open).collect(),
        leaves: below.leaves + above.leaves,
    }
}

/// Lists each solution once, by value, then by support.
///
/// A group holds intervals of one solution. In the order of lower ends, an interval that overlaps
/// none of the group begins the next solution.
pub(super) fn distinct(mut found: Vec<LeafSolution>) -> Result<Vec<AcceptedClaim>, CoverFault> {
    found.sort_by(|p, q| by_support(&p.solution).cmp(&by_support(&q.solution)));

    let mut solutions: Vec<AcceptedClaim> = Vec::new();
    let mut group: Vec<LeafSolution> = Vec::new();
    for next in found {
        if !group.iter().any(|f| overlaps(f, &next)) {
            solutions.extend(first_of(&mut group));
        } else if !group.iter().any(|f| is_same(f, &next)) {
            return Err(CoverFault::Ambiguous {
                support: next.solution.support,
            });
        }

        group.push(next);
    }

    solutions.extend(first_of(&mut group));

    solutions.sort_by(|p, q| by_value(p).cmp(&by_value(q)));
    Ok(solutions)
}

/// Empties a group; its solution, as the first of its members gives it.
fn first_of(group: &mut Vec<LeafSolution>) -> Option<AcceptedClaim> {
    group.drain(..).next().map(|f| f.solution)
}

fn by_support(s: &AcceptedClaim) -> (&[usize], &Rational, &Rational) {
    (&s.support, s.value.lo(), s.value.hi())
}

fn by_value(s: &AcceptedClaim) -> (&Rational, &[usize]) {
    (s.value.lo(), &s.support)
}

/// Can both be one solution? `next` does not begin before `f`.
fn overlaps(f: &LeafSolution, next: &LeafSolution) -> bool {
    let has_same_support = f.solution.support == next.solution.support;
    let reaches_next = f.solution.value.hi() >= next.solution.value.lo();
    has_same_support && reaches_next
}

/// Does one lie where the other is the only solution of the support?
fn is_same(f: &LeafSolution, next: &LeafSolution) -> bool {
    let next_lies_in_hull = lies_in(&next.solution.value, &f.hull);
    let lies_in_hull_of_next = lies_in(&f.solution.value, &next.hull);
    next_lies_in_hull || lies_in_hull_of_next
}

fn lies_in(inner: &Interval, outer: &Interval) -> bool {
    let begins_inside = inner.lo() >= outer.lo();
    let ends_inside = inner.hi() <= outer.hi();
    begins_inside && ends_inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn interval(a: i64, b: i64) -> Interval {
        Interval::new(whole(a), whole(b)).unwrap()
    }

    fn found(support: usize, value: [i64; 2], hull: [i64; 2]) -> LeafSolution {
        let solution = AcceptedClaim {
            support: vec![support],
            value: interval(value[0], value[1]),
        };
        LeafSolution {
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
            from: Some(interval(from[0], from[1])),
            to,
            is_point,
            is_alone,
        }
    }

    fn range() -> SolutionFamily {
        family([2, 3], Some([7, 8]), false, true)
    }

    fn half_line() -> SolutionFamily {
        family([2, 3], None, false, true)
    }

    /// Does a solution stay single beside a family?
    fn is_single(support: usize, value: [i64; 2], beside: SolutionFamily) -> bool {
        let mut list = vec![found(support, value, value)];
        let families = families(&mut list, vec![beside]);
        assert_eq!(families.len() + list.len(), 2);
        list.len() == 1
    }

    /// A solution within a family or at an end of it is a point of it; beside it, or of another
    /// support, it is single.
    #[test]
    fn a_single_solution_at_a_family_belongs_to_it() {
        for value in [[3, 3], [3, 4], [5, 6], [7, 7], [5, 7]] {
            assert!(!is_single(0, value, range()), "{value:?}");
            assert!(is_single(1, value, range()), "{value:?}");
            assert!(!is_single(0, value, half_line()), "{value:?}");
        }
        for value in [[2, 3], [1, 1], [7, 8], [8, 8], [9, 9]] {
            assert!(is_single(0, value, range()), "{value:?}");
        }
        assert!(!is_single(0, [900, 901], half_line()));
        assert!(is_single(0, [1, 2], half_line()));

        let mut list = vec![found(0, [5, 6], [4, 7])];
        let point = family([5, 6], Some([5, 6]), true, true);
        assert_eq!(families(&mut list, vec![range()]), [range(), point]);
    }

    /// Of two leaves that share an end the one that has proved more counts, in either order.
    #[test]
    fn alone_is_kept_of_two_that_are_the_same() {
        let alone = || family([2, 2], Some([2, 2]), true, true);
        let cone = || family([2, 2], Some([2, 2]), true, false);
        let merged = |list| families(&mut Vec::new(), list);

        assert_eq!(merged(vec![alone(), cone()]), [alone()]);
        assert_eq!(merged(vec![cone(), alone()]), [alone()]);
        assert_eq!(merged(vec![cone(), cone()]), [cone()]);

        // A range and the point at its end are two.
        let range = || family([2, 2], Some([2, 2]), false, true);
        assert_eq!(merged(vec![range(), alone()]), [alone(), range()]);
    }

    #[test]
    fn two_that_overlap_are_one_if_either_lies_where_the_other_is_unique() {
        let count = |first: LeafSolution, second: LeafSolution| {
            let list = distinct(vec![first, second])?;
            Ok(list.len())
        };
        let ambiguous = Err(CoverFault::Ambiguous { support: vec![0] });

        let wide_hull = found(0, [3, 6], [0, 9]);
        assert_eq!(count(found(0, [1, 4], [1, 4]), wide_hull), Ok(1));
        let wide_hull = found(0, [1, 4], [0, 9]);
        assert_eq!(count(wide_hull, found(0, [3, 6], [3, 6])), Ok(1));

        let first = || found(0, [1, 4], [1, 4]);
        assert_eq!(count(first(), found(0, [3, 6], [3, 6])), ambiguous);
        let longer = found(0, [1, 4], [1, 5]);
        assert_eq!(count(longer, found(0, [3, 6], [2, 6])), ambiguous);

        assert_eq!(count(first(), found(0, [5, 6], [5, 6])), Ok(2));
        assert_eq!(count(first(), found(1, [3, 6], [3, 6])), Ok(2));
    }
}
