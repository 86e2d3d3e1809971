//! Claims beside a cover: where the cover holds a solution that a claim has proved.
//!
//! A claim proves: there is a solution with support J and a value in [a, b]. A cover proves: every
//! solution in the window is one of its solutions, lies in one of its families, or in one of its
//! open regions. So each claim has its place in the cover. A claim without one shows that either
//! the claim or the cover is false, although both passed their own obligations.
//!
//! Input: an accepted claim, whose value lies in the window of the cover, and the accepted cover.
//! Called by `check::beside_the_cover` and by `mceip check`, which prints the place.

use super::proved::{AcceptedCover, OpenRegion, SolutionFamily};
use crate::AcceptedClaim;
use mceip_exact::{Interval, Rational};
use num_traits::Signed as _;

/// A part of a cover that holds, or may hold, a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The index in [`AcceptedCover::solutions`].
    Solution(usize),
    /// The index in [`AcceptedCover::families`].
    Family(usize),
    /// The index in [`AcceptedCover::open`].
    Open(usize),
}

impl AcceptedCover {
    /// The first part of the cover to which a claim of its window may belong: a solution or a
    /// family with the same support whose values meet those of the claim, or an open region that
    /// admits both. `None` contradicts the cover.
    pub fn place_of(&self, claim: &AcceptedClaim) -> Option<Place> {
        if let Some(k) = self.solutions.iter().position(|s| is_near(s, claim)) {
            return Some(Place::Solution(k));
        }

        if let Some(k) = self.families.iter().position(|f| f.may_hold(claim)) {
            return Some(Place::Family(k));
        }

        let open = self.open.iter().position(|region| region.may_hold(claim));
        open.map(Place::Open)
    }
}

/// Can both be one solution: the same support and overlapping values?
fn is_near(p: &AcceptedClaim, q: &AcceptedClaim) -> bool {
    let p_is_above = p.value.lo() > q.value.hi();
    let q_is_above = q.value.lo() > p.value.hi();
    let overlaps = !p_is_above && !q_is_above;

    p.support == q.support && overlaps && !are_on_both_sides(&ends(p), &ends(q))
}

/// Are these two intervals of values on both sides of 0, each with more than it?
///
/// Of values below 0 and of the others there are two covers. Where they are joined, what has an end
/// at 0 does not meet what ends there on the other side.
fn are_on_both_sides(p: &IntervalEnds<'_>, q: &IntervalEnds<'_>) -> bool {
    side(p) * side(q) < 0
}

fn ends(claim: &AcceptedClaim) -> IntervalEnds<'_> {
    [Some(claim.value.lo()), Some(claim.value.hi())]
}

/// The ends of an interval; none is infinity.
type IntervalEnds<'a> = [Option<&'a Rational>; 2];

/// 1 for values that are not negative, -1 for those that are not positive, 0 for both or 0 alone.
fn side([lo, hi]: &IntervalEnds<'_>) -> i8 {
    let is_from_zero = lo.is_some_and(|lo| !lo.is_negative());
    let is_to_zero = hi.is_some_and(|hi| !hi.is_positive());
    i8::from(is_from_zero) - i8::from(is_to_zero)
}

impl SolutionFamily {
    /// Can the claim's solution be of this family: the same support, and a value between its
    /// outermost ends?
    fn may_hold(&self, claim: &AcceptedClaim) -> bool {
        let ends_before = match &self.to {
            Some(to) => to.hi() < claim.value.lo(),
            None => false,
        };
        let begins_after = match &self.from {
            Some(from) => from.lo() > claim.value.hi(),
            None => false,
        };
        let own = [
            self.from.as_ref().map(Interval::lo),
            self.to.as_ref().map(Interval::hi),
        ];
        let meets = !ends_before && !begins_after && !are_on_both_sides(&own, &ends(claim));
        self.support == claim.support && meets
    }
}

impl OpenRegion {
    /// Can the claim's solution lie in this region: the claim's support J holds all that is known
    /// to be in the support here, nothing of J is zero here, and the values meet?
    fn may_hold(&self, claim: &AcceptedClaim) -> bool {
        let ends_before = match &self.max {
            Some(max) => max < claim.value.lo(),
            None => false,
        };
        let begins_after = match &self.min {
            Some(min) => min > claim.value.hi(),
            None => false,
        };
        let own = [self.min.as_ref(), self.max.as_ref()];
        let meets = !ends_before && !begins_after && !are_on_both_sides(&own, &ends(claim));

        let is_possible = |i: &usize| self.moving.contains(i) || self.undecided.contains(i);
        let holds_known = self.moving.iter().all(|i| claim.support.contains(i));
        let holds_possible_only = claim.support.iter().all(is_possible);
        holds_known && holds_possible_only && meets
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn interval(a: i64, b: i64) -> Interval {
        Interval::new(whole(a), whole(b)).unwrap()
    }

    fn claim(support: &[usize], a: i64, b: i64) -> AcceptedClaim {
        AcceptedClaim {
            support: support.to_vec(),
            value: interval(a, b),
        }
    }

    fn cover() -> AcceptedCover {
        AcceptedCover {
            solutions: vec![],
            families: vec![],
            open: vec![],
            leaves: 1,
        }
    }

    /// Values [4, 6] of support {0, 2}: a claim belongs to it if it has that support and meets
    /// these values, ends included.
    #[test]
    fn a_claim_belongs_to_the_solution_it_overlaps() {
        let cover = AcceptedCover {
            solutions: vec![claim(&[1], 4, 6), claim(&[0, 2], 4, 6)],
            ..cover()
        };
        for (a, b) in [(3, 4), (4, 4), (5, 5), (6, 7), (3, 7)] {
            assert_eq!(
                cover.place_of(&claim(&[0, 2], a, b)),
                Some(Place::Solution(1)),
                "[{a}, {b}]"
            );
            assert_eq!(cover.place_of(&claim(&[0], a, b)), None, "[{a}, {b}]");
            assert_eq!(cover.place_of(&claim(&[0, 1, 2], a, b)), None, "[{a}, {b}]");
        }
        for (a, b) in [(2, 3), (7, 8)] {
            assert_eq!(cover.place_of(&claim(&[0, 2], a, b)), None, "[{a}, {b}]");
        }
    }

    /// What ends at 0 on the other side is something else; what is 0 may be on either.
    #[test]
    fn nothing_belongs_to_the_other_side_of_zero() {
        let family = |from: Option<Interval>, to: Option<Interval>| SolutionFamily {
            support: vec![1],
            from,
            to,
            is_point: false,
            is_alone: true,
        };
        let region = |min: Option<i64>, max: Option<i64>| OpenRegion {
            min: min.map(whole),
            max: max.map(whole),
            moving: vec![2],
            undecided: vec![],
        };
        let cover = AcceptedCover {
            solutions: vec![claim(&[0], -1, 0), claim(&[0], 0, 1)],
            families: vec![
                family(None, Some(interval(0, 0))),
                family(Some(interval(0, 0)), None),
            ],
            open: vec![region(None, Some(0)), region(Some(0), Some(3))],
            leaves: 1,
        };

        for (support, below, above) in [
            (0, Place::Solution(0), Place::Solution(1)),
            (1, Place::Family(0), Place::Family(1)),
            (2, Place::Open(0), Place::Open(1)),
        ] {
            let place = |a, b| cover.place_of(&claim(&[support], a, b));
            assert_eq!((place(-2, 0), place(0, 2)), (Some(below), Some(above)));
            assert_eq!(place(0, 0), Some(below));
        }
    }

    /// A family from [2, 3] to [7, 8] may begin at 2 and end at 8; one without upper end holds
    /// every larger value.
    #[test]
    fn a_claim_belongs_to_the_family_it_meets() {
        let of = |to: Option<Interval>| {
            let family = SolutionFamily {
                support: vec![0],
                from: Some(interval(2, 3)),
                to,
                is_point: false,
                is_alone: true,
            };
            AcceptedCover {
                families: vec![family],
                ..cover()
            }
        };
        let (range, half_line) = (of(Some(interval(7, 8))), of(None));
        for (a, b) in [(1, 2), (2, 2), (5, 5), (8, 8), (8, 9)] {
            assert_eq!(
                range.place_of(&claim(&[0], a, b)),
                Some(Place::Family(0)),
                "[{a}, {b}]"
            );
            assert_eq!(
                half_line.place_of(&claim(&[0], a, b)),
                Some(Place::Family(0)),
                "[{a}, {b}]"
            );
            assert_eq!(range.place_of(&claim(&[1], a, b)), None, "[{a}, {b}]");
        }
        assert_eq!(
            [
                range.place_of(&claim(&[0], 0, 1)),
                half_line.place_of(&claim(&[0], 0, 1))
            ],
            [None, None]
        );
        assert_eq!(range.place_of(&claim(&[0], 9, 10)), None);
        assert_eq!(
            half_line.place_of(&claim(&[0], 900, 901)),
            Some(Place::Family(0))
        );
    }

    /// In [3, 5] with 1 moving, 2 and 4 undecided, the supports {1}, {1, 2}, {1, 4} and {1, 2, 4}
    /// may be.
    #[test]
    fn a_claim_belongs_to_an_open_region_that_admits_its_support() {
        let of = |max: Option<i64>| {
            let region = OpenRegion {
                min: Some(whole(3)),
                max: max.map(whole),
                moving: vec![1],
                undecided: vec![2, 4],
            };
            AcceptedCover {
                open: vec![region],
                ..cover()
            }
        };
        let (region, half_line) = (of(Some(5)), of(None));
        for support in [&[1][..], &[1, 2], &[1, 4], &[1, 2, 4]] {
            for (a, b) in [(2, 3), (3, 3), (4, 4), (5, 5), (5, 6)] {
                assert_eq!(
                    region.place_of(&claim(support, a, b)),
                    Some(Place::Open(0)),
                    "{support:?} [{a}, {b}]"
                );
            }
            assert_eq!(
                [
                    region.place_of(&claim(support, 1, 2)),
                    region.place_of(&claim(support, 6, 7))
                ],
                [None, None]
            );
            assert_eq!(
                [
                    half_line.place_of(&claim(support, 1, 2)),
                    half_line.place_of(&claim(support, 6, 7))
                ],
                [None, Some(Place::Open(0))]
            );
        }
        for support in [&[][..], &[2], &[2, 4], &[0, 1], &[1, 2, 3]] {
            assert_eq!(region.place_of(&claim(support, 4, 4)), None, "{support:?}");
        }
    }

    /// Proved places come before possible ones.
    #[test]
    fn a_listed_solution_comes_first() {
        let region = OpenRegion {
            min: Some(whole(0)),
            max: None,
            moving: vec![],
            undecided: vec![0],
        };
        let family = SolutionFamily {
            support: vec![0],
            from: Some(interval(1, 1)),
            to: None,
            is_point: false,
            is_alone: false,
        };
        let all = AcceptedCover {
            solutions: vec![claim(&[0], 5, 6)],
            families: vec![family],
            open: vec![region],
            leaves: 3,
        };
        let places = [5, 2, 0].map(|t| all.place_of(&claim(&[0], t, t)));
        assert_eq!(
            places,
            [
                Some(Place::Solution(0)),
                Some(Place::Family(0)),
                Some(Place::Open(0))
            ]
        );
    }
}
