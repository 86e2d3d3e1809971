//! Leaves in which nothing lies: a Farkas vector, or a definite symmetric part, at both ends. Short
//! numbers are tried first; where they cannot tell, `ends` gives the long ones.

use super::definite::positive_definite;
use super::family::Ends;
use super::short::Short;
use super::{CoverFault, Region, State};
use crate::exact::{Integer, Rational};
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
        return Err(CoverFault::Length { what: "farkas", expected: n, got: w.len() });
    }
    if let Some(i) = (0..n).find(|&i| w[i] < 0 && region.states[i] != State::Moving) {
        return Err(CoverFault::NegativeWeight { index: index[i], got: w[i] });
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
                    if radius.is_zero() { product } else { product + radius * w[i].unsigned_abs() }
                })
                .sum();
            if bound.is_positive() {
                return Err(CoverFault::NotNegative { index: index[j], end: ENDS[end], got: Rational::new(bound, ends.scale.clone()) });
            }
            strict &= bound.is_negative() || (end == 1 && ends.infinite);
        }
        strict_on_all &= strict;
        strict_on_one |= strict && region.states[j] == State::Moving;
    }
    if strict_on_all || strict_on_one { Ok(()) } else { Err(CoverFault::NotStrict) }
}

/// Is w'T < 0 on all that may move?
fn is_negative(region: &Region, end: &Short, w: &[i64]) -> bool {
    let bounds = end.product(w);
    bounds.is_some_and(|list| list.iter().zip(&region.states).all(|(bound, state)| *bound < 0 || *state == State::Rest))
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
    let moving: Vec<usize> = (0..region.states.len()).filter(|&i| region.states[i] != State::Rest).collect();
    if short.is_some_and(|ends| ends.iter().all(|end| positive_definite(end, &moving, sign).is_ok())) {
        return Ok(());
    }
    let ends = ends()?;
    let all: Vec<usize> = (0..moving.len()).collect();
    for end in 0..2 {
        let (m, r) = (&ends.m[end], &ends.r[end]);
        let is_zero = || moving.iter().all(|&i| moving.iter().all(|&j| (&m[i][j] + &m[j][i]).is_zero() && r[i][j].is_zero()));
        if end == 1 && ends.infinite && is_zero() {
            continue;
        }
        // Cut to what moves: it may be small beside the rest.
        let verdict = Short::of(m, r, &moving).ok_or(0).and_then(|block| positive_definite(&block, &all, sign));
        verdict.map_err(|p| CoverFault::NotDefinite { index: index[moving[p]], end: ENDS[end] })?;
    }
    Ok(())
}
