//! Leaves without a solution, by enclosures of T at both ends of the interval: a Farkas vector, or
//! a definite symmetric part.
//!
//! Every T(t) of the region is a convex combination of a matrix within R0 of M0 and one within R1
//! of M1 (at an infinite end: the one plus a non-negative multiple of the other; see `family`).
//! Both proofs are inequalities linear in T, so they hold between if they hold at both ends.
//!
//! *Farkas.* Let w_i >= 0 for all i outside the support. Since y_i = 0 on the support, w'y >= 0 for
//! a solution. If (w'T)_j <= 0 for all j that may be in the support, then w'y = w'Tx <= 0, and it
//! is < 0 if (w'T)_j < 0 for all those j, because x is not zero, or for one j in the support,
//! because x_j > 0. Then there is no solution.
//!
//! *Definite.* A solution has x'Tx = x'y = 0. If sym(T), or -sym(T), is positive definite on the
//! variables that may be in the support, then x = 0, and there is no solution.
//!
//! At an infinite end, which is no value of the window, the weak inequality suffices: the matrix at
//! the lower end adds the strict one.
//!
//! Short numbers (`short`) are tried first. Where they cannot tell, `ends` gives the long ones.
//! Called by the walk through the trees.

use super::definite::{long_definite, positive_definite};
use super::ends::{Ends, Matrix};
use super::fault::CoverFault;
use super::region::{Region, State};
use super::short::Short;
use mceip_exact::{Integer, Rational};
use num_traits::{Signed, Zero};
use std::rc::Rc;

const ENDS: [&str; 2] = ["lower", "upper"];

/// Checks the weights `w`, one per complementarity variable, as a Farkas vector.
pub(super) fn farkas(
    region: &Region,
    short: Option<&[Short; 2]>,
    ends: impl FnOnce() -> Result<Rc<Ends>, CoverFault>,
    index: &[usize],
    w: &[i64],
) -> Result<(), CoverFault> {
    CoverFault::length("farkas", index.len(), w.len())?;
    for (i, &weight) in w.iter().enumerate() {
        if weight < 0 && region.states[i] != State::InSupport {
            return Err(CoverFault::NegativeWeight {
                index: index[i],
                got: weight,
            });
        }
    }

    if let Some([lower, upper]) = short
        && is_negative(region, lower, w)
        && is_negative(region, upper, w)
    {
        return Ok(());
    }

    let ends = ends()?;
    let mut strict_on_all = true;
    let mut strict_on_support = false;
    for j in region.possible_support() {
        let mut strict = true;
        for end in 0..2 {
            let bound = upper_bound(&ends, end, w, j);
            if bound.is_positive() {
                return Err(CoverFault::NotNegative {
                    index: index[j],
                    end: ENDS[end],
                    got: Rational::new(bound, ends.scale.clone()),
                });
            }

            let is_infinite = end == 1 && ends.infinite;
            strict &= bound.is_negative() || is_infinite;
        }

        strict_on_all &= strict;
        strict_on_support |= strict && region.states[j] == State::InSupport;
    }

    if strict_on_all || strict_on_support {
        Ok(())
    } else {
        Err(CoverFault::NotStrict)
    }
}

/// Is w'T < 0 on all variables that may be in the support?
fn is_negative(region: &Region, end: &Short, w: &[i64]) -> bool {
    let Some(bounds) = end.product(w) else {
        return false;
    };
    bounds
        .iter()
        .zip(&region.states)
        .all(|(bound, state)| *bound < 0 || *state == State::AtZero)
}

/// Upper bound of (w'T)_j at an end: sum_i w_i M_ij + |w_i| R_ij.
fn upper_bound(ends: &Ends, end: usize, w: &[i64], j: usize) -> Integer {
    let mut bound = Integer::zero();
    for (i, &weight) in w.iter().enumerate() {
        if weight == 0 {
            continue;
        }

        bound += &ends.m[end][i][j] * weight;

        let radius = &ends.r[end][i][j];
        if !radius.is_zero() {
            bound += radius * weight.unsigned_abs();
        }
    }

    bound
}

/// Demands that `sign` sym(T) is positive definite on the variables that may be in the support.
pub(super) fn definite(
    region: &Region,
    short: Option<&[Short; 2]>,
    ends: impl FnOnce() -> Result<Rc<Ends>, CoverFault>,
    index: &[usize],
    sign: i8,
) -> Result<(), CoverFault> {
    let possible = region.possible_support();
    if let Some([lower, upper]) = short
        && positive_definite(lower, &possible, sign).is_ok()
        && positive_definite(upper, &possible, sign).is_ok()
    {
        return Ok(());
    }

    let ends = ends()?;
    for end in 0..2 {
        let m = &ends.m[end];
        let r = &ends.r[end];
        let is_infinite = end == 1 && ends.infinite;
        if is_infinite && is_skew(m, r, &possible) {
            continue; // semidefinite, which suffices there
        }

        long_definite(m, r, &possible, sign).map_err(|pivot| CoverFault::NotDefinite {
            index: index[possible[pivot]],
            end: ENDS[end],
        })?;
    }

    Ok(())
}

/// Is the symmetric part on these variables exactly zero, with zero radius?
fn is_skew(m: &Matrix, r: &Matrix, variables: &[usize]) -> bool {
    for &i in variables {
        for &j in variables {
            if !(&m[i][j] + &m[j][i]).is_zero() || !r[i][j].is_zero() {
                return false;
            }
        }
    }

    true
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
    const OPEN: [State; 2] = [State::Undecided; 2];

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
        let states = [State::Undecided, State::InSupport];
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
        let moving = [State::InSupport, State::Undecided];
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
            at([State::Undecided, State::AtZero], t(1, 0), t(1, 0), false),
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
                [State::AtZero, State::Undecided],
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
                &region([State::Undecided, State::AtZero]),
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
