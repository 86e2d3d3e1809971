//! Leaves in which nothing lies: a Farkas vector, or a definite symmetric part, at both ends. Short
//! numbers are tried first; where they cannot tell, `ends` gives the long ones.

use super::definite::{long_definite, positive_definite};
use super::family::Ends;
use super::short::Short;
use super::{CoverFault, Region, State};
use mceip_exact::{Integer, Rational};
use num_traits::{Signed, Zero};
use std::rc::Rc;

const ENDS: [&str; 2] = ["lower", "upper"];

/// w'T <= 0 on what may move, at both ends and so between: then 0 <= w'y = w'Tx <= 0. It excludes x
/// where it is < 0 on all that may move, or on one variable that does. At an infinite end, which is
/// not part of the window, <= suffices.
pub(super) fn farkas(
    region: &Region,
    short: Option<&[Short; 2]>,
    ends: impl FnOnce() -> Result<Rc<Ends>, CoverFault>,
    index: &[usize],
    w: &[i64],
) -> Result<(), CoverFault> {
    let n = index.len();
    if w.len() != n {
        return Err(CoverFault::Length {
            what: "farkas",
            expected: n,
            got: w.len(),
        });
    }
    if let Some(i) = (0..n).find(|&i| w[i] < 0 && region.states[i] != State::Moving) {
        return Err(CoverFault::NegativeWeight {
            index: index[i],
            got: w[i],
        });
    }
    if short.is_some_and(|ends| ends.iter().all(|end| is_negative(region, end, w))) {
        return Ok(());
    }
    let ends = ends()?;
    let (mut strict_on_all, mut strict_on_one) = (true, false);
    for j in (0..n).filter(|&j| region.states[j] != State::Rest) {
        let mut strict = true;
        for end in 0..2 {
            let bound: Integer = (0..n)
                .filter(|&i| w[i] != 0)
                .map(|i| {
                    let radius = &ends.r[end][i][j];
                    let product = &ends.m[end][i][j] * w[i];
                    if radius.is_zero() {
                        product
                    } else {
                        product + radius * w[i].unsigned_abs()
                    }
                })
                .sum();
            if bound.is_positive() {
                return Err(CoverFault::NotNegative {
                    index: index[j],
                    end: ENDS[end],
                    got: Rational::new(bound, ends.scale.clone()),
                });
            }
            strict &= bound.is_negative() || (end == 1 && ends.infinite);
        }
        strict_on_all &= strict;
        strict_on_one |= strict && region.states[j] == State::Moving;
    }
    if strict_on_all || strict_on_one {
        Ok(())
    } else {
        Err(CoverFault::NotStrict)
    }
}

/// Is w'T < 0 on all that may move?
fn is_negative(region: &Region, end: &Short, w: &[i64]) -> bool {
    let bounds = end.product(w);
    bounds.is_some_and(|list| {
        list.iter()
            .zip(&region.states)
            .all(|(bound, state)| *bound < 0 || *state == State::Rest)
    })
}

/// `sign` sym(T) is positive definite on what may move at both ends, and so between: x'Tx = 0 on
/// solutions leaves x = 0 only. At an infinite end zero will do.
pub(super) fn definite(
    region: &Region,
    short: Option<&[Short; 2]>,
    ends: impl FnOnce() -> Result<Rc<Ends>, CoverFault>,
    index: &[usize],
    sign: i8,
) -> Result<(), CoverFault> {
    let moving: Vec<usize> = (0..region.states.len())
        .filter(|&i| region.states[i] != State::Rest)
        .collect();
    if short.is_some_and(|ends| {
        ends.iter()
            .all(|end| positive_definite(end, &moving, sign).is_ok())
    }) {
        return Ok(());
    }
    let ends = ends()?;
    for end in 0..2 {
        let (m, r) = (&ends.m[end], &ends.r[end]);
        let is_zero = || {
            moving.iter().all(|&i| {
                moving
                    .iter()
                    .all(|&j| (&m[i][j] + &m[j][i]).is_zero() && r[i][j].is_zero())
            })
        };
        if end == 1 && ends.infinite && is_zero() {
            continue;
        }
        let not_definite = |p: usize| CoverFault::NotDefinite {
            index: index[moving[p]],
            end: ENDS[end],
        };
        long_definite(m, r, &moving, sign).map_err(not_definite)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    const INDEX: [usize; 2] = [10, 11];

    fn matrix(m: [[i64; 2]; 2]) -> Vec<Vec<Integer>> {
        m.map(|row| row.map(Integer::from).to_vec()).to_vec()
    }

    fn ends(
        m: [[[i64; 2]; 2]; 2],
        r: [[[i64; 2]; 2]; 2],
        infinite: bool,
    ) -> Result<Rc<Ends>, CoverFault> {
        let zero = || matrix([[0, 0], [0, 0]]);
        Ok(Rc::new(Ends {
            m: m.map(matrix),
            r: r.map(matrix),
            slope: zero(),
            scale: 1.into(),
            infinite,
        }))
    }

    fn region(states: [State; 2]) -> Region {
        Region {
            lo: whole(0),
            hi: Some(whole(1)),
            states: states.to_vec(),
            matrices: Default::default(),
        }
    }

    const NONE: [[i64; 2]; 2] = [[0, 0], [0, 0]];
    const OPEN: [State; 2] = [State::Open; 2];

    fn long_farkas(
        states: [State; 2],
        m: [[[i64; 2]; 2]; 2],
        r: [[[i64; 2]; 2]; 2],
        infinite: bool,
        w: [i64; 2],
    ) -> Result<(), CoverFault> {
        farkas(&region(states), None, || ends(m, r, infinite), &INDEX, &w)
    }

    /// (w'T)_j at its largest: the radius counts with |w|, whatever the sign of w.
    #[test]
    fn radii_count_against_a_farkas_vector() {
        // (2, -3)'T = (-16, 10 - 3 c) with radii 2 * 3 + 3 * 2 = 12 and 2 * 1 + 3 * 4 = 14.
        let t = |c: i64| [[-5, 5], [2, c]];
        let r = [[3, 1], [2, 4]];
        let states = [State::Open, State::Moving];
        let at = |c: i64, d: i64| long_farkas(states, [t(c), t(d)], [r, r], false, [2, -3]);
        assert_eq!(at(9, 9), Ok(()));
        let fault = |end, got| {
            Err(CoverFault::NotNegative {
                index: 11,
                end,
                got: whole(got),
            })
        };
        assert_eq!([at(7, 9), at(9, 7)], [fault("lower", 3), fault("upper", 3)]);
        // At zero it is neither: here the moving variable is the one that is not strict.
        assert_eq!(
            [at(8, 9), at(9, 8)],
            [Err(CoverFault::NotStrict), Err(CoverFault::NotStrict)]
        );
    }

    /// w'T <= 0, and < 0 on all or on one that moves; at infinity <= 0 is as good.
    #[test]
    fn strict_on_all_or_on_one_that_moves() {
        let t = |a: i64, b: i64| [[-a, -b], [0, 0]];
        let at = |states, lower, upper, infinite| {
            long_farkas(states, [lower, upper], [NONE, NONE], infinite, [1, 0])
        };
        let moving = [State::Moving, State::Open];
        let weak = Err(CoverFault::NotStrict);
        assert_eq!(at(OPEN, t(1, 1), t(1, 1), false), Ok(()));
        assert_eq!(
            [
                at(OPEN, t(1, 0), t(1, 1), false),
                at(OPEN, t(1, 1), t(1, 0), false)
            ],
            [weak.clone(), weak.clone()]
        );
        assert_eq!(
            [
                at(moving, t(1, 0), t(1, 0), false),
                at(moving, t(0, 1), t(1, 1), false)
            ],
            [Ok(()), weak.clone()]
        );
        assert_eq!(
            [
                at(OPEN, t(1, 1), t(1, 0), true),
                at(OPEN, t(1, 0), t(1, 1), true)
            ],
            [Ok(()), weak.clone()]
        );
        assert_eq!(
            at([State::Open, State::Rest], t(1, 0), t(1, 0), false),
            Ok(())
        );
        assert_eq!(at(OPEN, t(1, 0), t(0, 1), true), weak);
    }

    /// At an infinite end a symmetric part that vanishes on what may move will do, radius included;
    /// at no other.
    #[test]
    fn a_vanishing_direction_is_definite_enough() {
        let eye = [[1 << 20, 0], [0, 1 << 20]];
        let skew = [[0, 5], [-5, 0]];
        let at = |states, m, r, infinite| {
            definite(&region(states), None, || ends(m, r, infinite), &INDEX, 1)
        };
        let not = |index, end| Err(CoverFault::NotDefinite { index, end });
        assert_eq!(at(OPEN, [eye, skew], [NONE, NONE], true), Ok(()));
        assert_eq!(at(OPEN, [eye, skew], [NONE, NONE], false), not(10, "upper"));
        assert_eq!(at(OPEN, [skew, eye], [NONE, NONE], true), not(10, "lower"));
        assert_eq!(
            at(OPEN, [eye, [[0, 5], [5, 0]]], [NONE, NONE], true),
            not(10, "upper")
        );
        assert_eq!(
            at(OPEN, [eye, skew], [NONE, [[0, 1], [0, 0]]], true),
            not(10, "upper")
        );
        assert_eq!(
            at(
                [State::Rest, State::Open],
                [eye, [[7, 9], [9, 0]]],
                [NONE, [[5, 5], [5, 0]]],
                true
            ),
            Ok(())
        );
        assert_eq!(at(OPEN, [eye, eye], [NONE, NONE], true), Ok(()));
        assert_eq!(
            at(OPEN, [eye, [[1 << 20, 0], [0, 0]]], [NONE, NONE], true),
            not(11, "upper")
        );
    }

    /// The short numbers only ever say what the long ones say.
    #[test]
    fn short_numbers_are_asked_first() {
        let short = |m: [[i64; 2]; 2]| Short::of(&matrix(m), &matrix(NONE), &[0, 1]).unwrap();
        let never = || Err(CoverFault::Trailing);
        let negative = || [short([[-1, -1], [0, 0]]), short([[-1, -2], [0, 0]])];
        assert_eq!(
            farkas(&region(OPEN), Some(&negative()), never, &INDEX, &[1, 0]),
            Ok(())
        );
        let unclear = [short([[-1, 0], [0, 0]]), short([[-1, -2], [0, 0]])];
        assert_eq!(
            farkas(&region(OPEN), Some(&unclear), never, &INDEX, &[1, 0]),
            Err(CoverFault::Trailing)
        );
        // What rests need not be negative.
        assert_eq!(
            farkas(
                &region([State::Open, State::Rest]),
                Some(&unclear),
                never,
                &INDEX,
                &[1, 0]
            ),
            Ok(())
        );
        let eye = || short([[1 << 20, 0], [0, 1 << 20]]);
        assert_eq!(
            definite(&region(OPEN), Some(&[eye(), eye()]), never, &INDEX, 1),
            Ok(())
        );
        assert_eq!(
            definite(&region(OPEN), Some(&[eye(), short(NONE)]), never, &INDEX, 1),
            Err(CoverFault::Trailing)
        );
    }
}
