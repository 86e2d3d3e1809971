//! Leaves that say exactly what one support holds, value by value: points and the cells between
//! them.
//!
//! With J the moving and R the resting variables and f the free ones, x(t) solves with support J if
//! x_J > 0, Tx = 0 on J and f, Tx >= 0 on R. Nothing is there if some w has w_R >= 0 and w'T zero
//! on f, <= 0 on J and < 0 somewhere on it (either sign if w_R = 0): then 0 <= w'Tx < 0. x is alone
//! if for every other active j weights bound c x_j + d x_k from below and from above by what x
//! itself has. Signs at a point are those of remainders, signs on a cell come from `rootless`.

use super::rootless::{Budget, Root, sign_between};
use super::{CoverFault, Region, State};
use crate::certificate::{Alone, Exact, Polynomials, Support};
use crate::exact_solution::isolate;
use crate::pencil::Rows;
use mceip_exact::{Interval, Poly, Rational};

/// Largest number of coefficients of a polynomial, and coefficients times bits of the longest
/// number of a leaf.
const MAX_COEFFICIENTS: usize = 256;
const MAX_SIZE: u64 = 1 << 23;

/// Solutions of the support in one place of the leaf.
pub(super) struct Held {
    pub(super) from: Interval,
    /// The same as `from` at a point, `None`: infinity.
    pub(super) to: Option<Interval>,
    pub(super) is_point: bool,
    /// Is there one only, up to its factor, at each value?
    pub(super) is_alone: bool,
    /// If neighbouring cells hold nothing: a part of the leaf that holds no other.
    pub(super) hull: Option<Interval>,
}

/// Checks a leaf; where it holds solutions. The budget is that of all leaves of the file.
pub(super) fn check(
    rows: &Rows,
    region: &Region,
    index: &[usize],
    leaf: &Support,
    budget: &Budget,
) -> Result<Vec<Held>, CoverFault> {
    let verdict = held(rows, region, index, leaf, budget);
    if budget.is_spent() {
        return Err(CoverFault::OutOfBudget);
    }
    verdict
}

fn held(
    rows: &Rows,
    region: &Region,
    index: &[usize],
    leaf: &Support,
    budget: &Budget,
) -> Result<Vec<Held>, CoverFault> {
    let moving: Vec<usize> = (0..index.len())
        .filter(|&p| region.states[p] == State::Moving)
        .map(|p| index[p])
        .collect();
    let is_empty = leaf.points.is_empty() && leaf.cells.is_empty();
    if region.states.contains(&State::Open) || moving.is_empty() != is_empty {
        return Err(CoverFault::SupportTooEarly);
    }
    if moving.is_empty() {
        return Ok(Vec::new()); // x_s = 0, and T_ff is regular: x = 0
    }
    budget.add_coefficients(bounded(leaf)?);
    let system = System::new(rows, &moving);
    let roots = points(region, leaf)?;
    let reason = |k: usize| {
        leaf.reasons.get(k).ok_or(CoverFault::NoReason {
            reason: k,
            reasons: leaf.reasons.len(),
        })
    };
    let mut held = vec![None; 2 * roots.len() + 1];
    for (k, root) in roots.iter().enumerate() {
        held[2 * k + 1] = system.holds(
            reason(leaf.points[k].reason)?,
            &|g| root.sign(g, budget),
            2 * k,
        )?;
    }
    for (k, cell) in leaf.cells.iter().enumerate() {
        held[2 * k + 2] = system.holds(
            reason(*cell)?,
            &|g| sign_between(g, &roots[k], roots.get(k + 1), budget),
            2 * k + 1,
        )?;
    }
    let mut out = Vec::new();
    for (k, is_alone) in (1..held.len()).filter_map(|k| held[k].map(|alone| (k, alone))) {
        let (left, is_point) = ((k - 1) / 2, k % 2 == 1);
        let from = roots[left].value.clone();
        let to = if is_point {
            Some(from.clone())
        } else {
            roots.get(left + 1).map(|r| r.value.clone())
        };
        let is_isolated =
            is_point && held[k - 1].is_none() && held.get(k + 1).is_none_or(Option::is_none);
        let hull = if is_isolated {
            hull(&roots, left)
        } else {
            None
        };
        out.push(Held {
            from,
            to,
            is_point,
            is_alone,
            hull,
        });
    }
    Ok(out)
}

/// From half way to the point before to half way to the point after.
fn hull(roots: &[Root], k: usize) -> Option<Interval> {
    let half = |a: &Rational, b: &Rational| (a + b) / Rational::from_integer(2.into());
    let value = &roots[k].value;
    let lo = k.checked_sub(1).map_or_else(
        || value.lo().clone(),
        |p| half(roots[p].value.hi(), value.lo()),
    );
    let hi = roots
        .get(k + 1)
        .map_or_else(|| value.hi().clone(), |n| half(value.hi(), n.value.lo()));
    Interval::new(lo, hi)
}

/// The points: each isolated, apart from each other, from one end of the region to the other.
fn points(region: &Region, leaf: &Support) -> Result<Vec<Root>, CoverFault> {
    let mut roots: Vec<Root> = Vec::new();
    for (k, point) in leaf.points.iter().enumerate() {
        let poly = Poly::new(point.polynomial.clone()).primitive();
        let value = isolate(&poly, &point.interval).map_err(|_| CoverFault::Point { point: k })?;
        if roots.last().is_some_and(|r| r.value.hi() >= value.lo()) {
            return Err(CoverFault::Point { point: k });
        }
        roots.push(Root { poly, value });
    }
    let is_at =
        |root: Option<&Root>, end| root.is_some_and(|r| r.value.is_point() && r.value.lo() == end);
    let cells = roots.len() - usize::from(region.hi.is_some() && !roots.is_empty());
    if !is_at(roots.first(), &region.lo)
        || region
            .hi
            .as_ref()
            .is_some_and(|hi| !is_at(roots.last(), hi))
    {
        return Err(CoverFault::Point { point: roots.len() });
    }
    if leaf.cells.len() != cells {
        return Err(CoverFault::Length {
            what: "cells",
            expected: cells,
            got: leaf.cells.len(),
        });
    }
    Ok(roots)
}

/// The leaf is small enough to be multiplied out; its number of coefficients.
fn bounded(leaf: &Support) -> Result<u64, CoverFault> {
    let vectors = leaf.reasons.iter().flat_map(|reason| match reason {
        Exact::None(w) => vec![w],
        Exact::Some(m) => std::iter::once(&m.x)
            .chain(m.alone.iter().flat_map(|a| a.rows.iter().map(|(_, l)| l)))
            .collect(),
    });
    let polynomials = vectors
        .flat_map(|v| &v.0)
        .chain(leaf.points.iter().map(|p| &p.polynomial));
    let (mut longest, mut coefficients, mut bits) = (0, 0u64, 0);
    for p in polynomials {
        longest = longest.max(p.len());
        coefficients += p.len() as u64;
        bits = p.iter().map(|c| c.bits()).max().unwrap_or(0).max(bits);
    }
    let numbers = leaf.points.iter().flat_map(|p| &p.interval);
    bits = numbers
        .map(|n| n.0.numer().bits() + n.0.denom().bits())
        .max()
        .unwrap_or(0)
        .max(bits);
    let places = (leaf.points.len() + leaf.cells.len()) as u64;
    let at_most = |what, limit, got| {
        if got > limit {
            Err(CoverFault::TooLarge { what, limit, got })
        } else {
            Ok(())
        }
    };
    at_most(
        "coefficients of a polynomial",
        MAX_COEFFICIENTS as u64,
        longest as u64,
    )?;
    at_most(
        "coefficients and places times bits",
        MAX_SIZE,
        (coefficients + places).saturating_mul(bits),
    )?;
    Ok(coefficients)
}

/// The sign of a polynomial at a place, if it can be told.
type Sign<'a> = dyn Fn(&Poly) -> Option<i8> + 'a;

struct System<'a> {
    rows: &'a Rows,
    moving: &'a [usize],
    /// Moving and free.
    active: Vec<usize>,
}

impl<'a> System<'a> {
    fn new(rows: &'a Rows, moving: &'a [usize]) -> Self {
        let active = (0..rows.order())
            .filter(|i| rows.is_free[*i] || moving.contains(i))
            .collect();
        System {
            rows,
            moving,
            active,
        }
    }

    /// Checks a reason at a place: `None` if it holds nothing, else whether what it holds is alone.
    fn holds(
        &self,
        reason: &Exact,
        sign: &Sign<'_>,
        place: usize,
    ) -> Result<Option<bool>, CoverFault> {
        match reason {
            Exact::None(w) => self
                .nothing(&self.vector("none", w)?, sign, place)
                .map(|()| None),
            Exact::Some(member) => {
                let y = self.solves(&self.vector("x", &member.x)?, sign, place)?;
                if let Some(alone) = &member.alone {
                    self.alone(alone, &y, sign, place)?;
                }
                Ok(Some(member.alone.is_some()))
            }
        }
    }

    fn vector(&self, what: &'static str, v: &Polynomials) -> Result<Vec<Poly>, CoverFault> {
        if v.0.len() != self.rows.order() {
            return Err(CoverFault::Length {
                what,
                expected: self.rows.order(),
                got: v.0.len(),
            });
        }
        Ok(v.0.iter().map(|c| Poly::new(c.clone())).collect())
    }

    /// w'T on the active columns.
    fn columns(&self, w: &[Poly]) -> Vec<Poly> {
        let mut sums = vec![Poly::default(); self.rows.order()];
        for (row, w_i) in self
            .rows
            .rows
            .iter()
            .zip(w)
            .filter(|(_, w_i)| !w_i.is_zero())
        {
            for (j, a, b) in row.iter().filter(|(j, ..)| self.active.contains(j)) {
                sums[*j] = &sums[*j] + &(w_i * &Poly::new(vec![a.clone(), b.clone()]));
            }
        }
        self.active.iter().map(|&j| sums[j].clone()).collect()
    }

    /// A Farkas vector.
    fn nothing(&self, w: &[Poly], sign: &Sign<'_>, place: usize) -> Result<(), CoverFault> {
        let fault = |expected, index| CoverFault::Place {
            place,
            expected,
            index,
        };
        let mut one_sided = false;
        for i in (0..w.len()).filter(|i| !self.active.contains(i)) {
            let s = sign(&w[i])
                .filter(|s| *s >= 0)
                .ok_or(fault("weights >= 0 off the moving set", i))?;
            one_sided |= s > 0;
        }
        let mut seen = [false; 2];
        for (product, &j) in self.columns(w).iter().zip(&self.active) {
            let s = sign(product).ok_or(fault("a sign of w'T that can be told", j))?;
            if s != 0 && self.rows.is_free[j] {
                return Err(fault("w'T = 0 on the free columns", j));
            }
            if s > 0 && one_sided {
                return Err(fault("w'T <= 0 on the moving columns", j));
            }
            seen[0] |= s < 0;
            seen[1] |= s > 0;
        }
        if seen[0] == seen[1] {
            Err(fault("w'T of one sign and not zero", self.moving[0]))
        } else {
            Ok(())
        }
    }

    /// A solution with exactly the moving variables as its support; the signs of its y.
    fn solves(
        &self,
        x: &[Poly],
        sign: &Sign<'_>,
        place: usize,
    ) -> Result<Vec<Option<i8>>, CoverFault> {
        let fault = |expected, index| CoverFault::Place {
            place,
            expected,
            index,
        };
        for (i, x_i) in x.iter().enumerate().filter(|(i, _)| !self.rows.is_free[*i]) {
            let moves = self.moving.contains(&i);
            if sign(x_i) != Some(i8::from(moves)) {
                return Err(fault(
                    if moves {
                        "x > 0 on the moving set"
                    } else {
                        "x = 0 off it"
                    },
                    i,
                ));
            }
        }
        let mut signs = Vec::new();
        for (i, row) in self.rows.rows.iter().enumerate() {
            // x is zero at this place off the active columns, whatever it is elsewhere.
            let terms = row.iter().filter(|(j, ..)| self.active.contains(j));
            let y = terms.fold(Poly::default(), |sum, (j, a, b)| {
                &sum + &(&x[*j] * &Poly::new(vec![a.clone(), b.clone()]))
            });
            signs.push(sign(&y));
            match (signs[i], self.active.contains(&i)) {
                (Some(0), _) | (Some(1), false) => {}
                (_, true) => return Err(fault("y = 0 on active rows", i)),
                (_, false) => return Err(fault("y >= 0 off them", i)),
            }
        }
        Ok(signs)
    }

    /// Every active component is determined by the pivot's. `y` of the member: l'Tx = l_R'y >= 0
    /// for all others.
    fn alone(
        &self,
        alone: &Alone,
        y: &[Option<i8>],
        sign: &Sign<'_>,
        place: usize,
    ) -> Result<(), CoverFault> {
        let fault = |expected, index| CoverFault::Place {
            place,
            expected,
            index,
        };
        if !self.moving.contains(&alone.pivot) {
            return Err(CoverFault::Pivot { index: alone.pivot });
        }
        // Is c x_j + d x_k known to be >= 0 with c > 0, with c < 0?
        let mut bounds = vec![[false; 2]; self.rows.order()];
        for (own, l) in &alone.rows {
            let own = *own;
            if own == alone.pivot || !self.active.contains(&own) {
                return Err(fault("an active index that is not the pivot", own));
            }
            let l = self.vector("alone", l)?;
            let mut is_equation = true;
            for i in (0..l.len()).filter(|&i| !self.active.contains(&i) && !l[i].is_zero()) {
                if y[i] != Some(0) || sign(&l[i]).is_none_or(|s| s < 0) {
                    return Err(fault("weights >= 0 where y = 0, and none where y > 0", i));
                }
                is_equation = false;
            }
            for (product, &j) in self
                .columns(&l)
                .iter()
                .zip(&self.active)
                .filter(|(_, j)| **j != alone.pivot)
            {
                match sign(product) {
                    Some(0) if j != own => {}
                    Some(s) if j == own && s != 0 => {
                        bounds[own][0] |= s > 0 || is_equation;
                        bounds[own][1] |= s < 0 || is_equation;
                    }
                    _ => return Err(fault("l'T zero but in its own column and the pivot's", j)),
                }
            }
        }
        let others = self.active.iter().filter(|&&j| j != alone.pivot);
        match others.into_iter().find(|&&j| bounds[j] != [true; 2]) {
            Some(&j) => Err(fault("x determined by the pivot's component", j)),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
