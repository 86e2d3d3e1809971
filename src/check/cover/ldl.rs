//! Leaf `ldl`: sym(A + tB) of the pencil as given is definite on what may move, by an exact LDL' at each
//! end. The conditions (19) and (20) themselves, over an interval of any length, with no margin lost.
//!
//! x'T(t)x = x'y = 0 for a solution. If sym T is definite at the lower end and at the upper one, it is so
//! between; at an infinite end the direction B may be semidefinite.

use super::{CoverFault, Region, State};
use crate::certificate::{Ldl, LdlFactor};
use crate::check::pencil::Rows;
use crate::exact::{Integer, Rational};
use num_traits::{Signed, Zero};

const ENDS: [&str; 2] = ["lower", "upper"];
/// Largest order, and order^2 times bits of the longest number: bounds the work on a small file.
const MAX_ORDER: u64 = 128;
const MAX_SIZE: u64 = 1 << 22;

pub(super) fn check(rows: &Rows, region: &Region, index: &[usize], ldl: &Ldl) -> Result<(), CoverFault> {
    let at_rest = |i: &usize| index.binary_search(i).is_ok_and(|p| region.states[p] == State::Rest);
    let active: Vec<usize> = (0..rows.order()).filter(|i| !at_rest(i)).collect();
    let one = Rational::from_integer(Integer::from(1));
    // T(t) = A + tB at the ends, the direction B at infinity.
    let upper = region.hi.as_ref().map_or_else(|| (Rational::zero(), one.clone()), |hi| (one.clone(), hi.clone()));
    let weights = [(one.clone(), region.lo.clone()), upper];
    let sign = ldl.lower.diagonal.first().map_or(1, |d| if d.0.is_negative() { -1 } else { 1 });
    for (end, (factor, (a, b))) in [&ldl.lower, &ldl.upper].into_iter().zip(&weights).enumerate() {
        lengths(factor, active.len())?;
        let weak = end == 1 && region.hi.is_none();
        let wrong = |d: &Rational| if d.is_zero() { !weak } else { d.is_negative() != (sign < 0) };
        if let Some(k) = factor.diagonal.iter().position(|d| wrong(&d.0)) {
            return Err(CoverFault::NotDefinite { index: active[k], end: ENDS[end] });
        }
        let symmetric = symmetric_part(rows, &active, a, b);
        for i in 0..active.len() {
            for j in 0..=i {
                if product(factor, i, j) != symmetric[i][j] {
                    return Err(CoverFault::Factor { row: active[i], column: active[j], end: ENDS[end] });
                }
            }
        }
    }
    Ok(())
}

fn lengths(factor: &LdlFactor, order: usize) -> Result<(), CoverFault> {
    let length = |what, expected, got| if expected == got { Ok(()) } else { Err(CoverFault::Length { what, expected, got }) };
    length("ldl diagonal", order, factor.diagonal.len())?;
    length("ldl rows", order, factor.rows.len())?;
    factor.rows.iter().enumerate().try_for_each(|(i, row)| length("ldl row", i, row.len()))?;
    let at_most = |what, limit, got| if got > limit { Err(CoverFault::TooLarge { what, limit, got }) } else { Ok(()) };
    at_most("ldl order", MAX_ORDER, order as u64)?;
    let numbers = factor.rows.iter().flatten().chain(&factor.diagonal);
    let bits = numbers.map(|n| n.0.numer().bits() + n.0.denom().bits()).max().unwrap_or(0);
    at_most("ldl size (order squared times bits)", MAX_SIZE, bits.saturating_mul((order * order) as u64))
}

/// (L D L')_ij for j <= i.
fn product(f: &LdlFactor, i: usize, j: usize) -> Rational {
    let entry = |r: usize, k: usize| if k == r { None } else { Some(&f.rows[r][k].0) };
    let mut sum = Rational::zero();
    for k in 0..=j {
        let mut term = f.diagonal[k].0.clone();
        for l in [entry(i, k), entry(j, k)].into_iter().flatten() {
            term *= l;
        }
        sum += term;
    }
    sum
}

/// sym(a A + b B) on the active variables, lower triangle.
fn symmetric_part(rows: &Rows, active: &[usize], a: &Rational, b: &Rational) -> Vec<Vec<Rational>> {
    let mut out: Vec<Vec<Rational>> = (0..active.len()).map(|i| vec![Rational::zero(); i + 1]).collect();
    for (i, &row) in active.iter().enumerate() {
        let half = Rational::new(Integer::from(1), &rows.factor[row] * 2);
        for (column, c, l) in &rows.rows[row] {
            let Ok(j) = active.binary_search(column) else { continue };
            let value = (a * Rational::from_integer(c.clone()) + b * Rational::from_integer(l.clone())) * &half;
            // The diagonal entry is met once, halved.
            out[i.max(j)][i.min(j)] += if i == j { value * Rational::from_integer(Integer::from(2)) } else { value };
        }
    }
    out
}
