//! Support leaves: what one support holds at every value of an interval, exactly.
//!
//! Every variable is decided. Let J be the support, R the other complementarity variables and f the
//! free ones; *active* are J and f. At a value t, x is a solution with support J if
//!
//! ```text
//!     x_J > 0,    x_R = 0,    T x = 0 on the active rows,    T x >= 0 on R.
//! ```
//!
//! Here T(t) = A + tB is the whole integral pencil: nothing is condensed and nothing is rounded.
//!
//! The leaf cuts the closed interval at *points*, algebraic numbers, the first and the last being
//! its ends, and gives a reason for each *place*: a point, or an open cell between two points
//! (above the last one, if the interval is infinite). A reason is a list of polynomials in t with
//! signs that hold at every value of the place:
//!
//! * *none*: weights w with w_R >= 0, (w'T)_f = 0 and (w'T)_J <= 0, somewhere < 0. Then a solution
//!   would have 0 <= w'y = w'Tx < 0. (If w_R = 0, then w'y = 0, and w'T may be >= 0 as well.)
//! * *some*: x(t) that solves. With *alone* it is the only solution up to a factor. For each active
//!   j but the pivot k there are weights l with l'T = c e_j + d e_k on the active columns, c not
//!   zero. If l = 0 on R, every solution z has c z_j + d z_k = l'Tz = 0. If l >= 0 on the rows of R
//!   where x has y = 0, and l = 0 on the others, then c z_j + d z_k = l'Tz >= 0, with equality for
//!   x: this bounds z_j / z_k by x_j / x_k from one side, and a second l with the other sign of c
//!   bounds it from the other side.
//!
//! A point that is alone, with nothing in the neighbouring cells, is an isolated solution. All
//! other places that hold something are families.
//!
//! Signs at a point are those of remainders, signs on a cell come from `rootless`. Called by the
//! walk through the trees, with the budget of signs for the whole file.

use super::context::Context;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::proved::{LeafSolution, SolutionFamily};
use super::region::Region;
use super::rootless::{AlgebraicValue, sign_between};
use super::sign_budget::{PolySize, SignBudget};
use crate::AcceptedClaim;
use crate::certificate::{Alone, Exact, Polynomials, Support};
use crate::exact_solution::isolate;
use crate::pencil::{Row, Rows};
use mceip_exact::{Integer, Interval, Poly, Rational};
use num_traits::Zero;

/// Largest number of coefficients of a polynomial.
const MAX_COEFFICIENTS: usize = 256;
/// Largest product of coefficients and places with the bits of the longest number of a leaf.
const MAX_SIZE: u64 = 1 << 23;

/// What a place holds.
#[derive(Clone, Copy, PartialEq)]
enum PlaceContent {
    Nothing,
    /// Solutions; are they alone, one up to its factor at each value?
    Solutions {
        is_alone: bool,
    },
}

impl Leaf for Support {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        let support = context.problem_indices(at.support());
        check(context.rows, at, &support, self, &context.sign_budget)
    }
}

/// Checks a leaf and returns what it holds. The budget is that of all leaves of the file.
fn check(
    rows: &Rows,
    region: &Region,
    support: &[usize],
    leaf: &Support,
    budget: &SignBudget,
) -> Result<Yield, CoverFault> {
    let verdict = check_places(rows, region, support, leaf, budget);
    if budget.is_spent() {
        return Err(CoverFault::OutOfBudget);
    }

    verdict
}

fn check_places(
    rows: &Rows,
    region: &Region,
    support: &[usize],
    leaf: &Support,
    budget: &SignBudget,
) -> Result<Yield, CoverFault> {
    let is_empty = leaf.points.is_empty() && leaf.cells.is_empty();
    if !region.is_decided() || support.is_empty() != is_empty {
        return Err(CoverFault::SupportTooEarly);
    }

    if support.is_empty() {
        return Ok(Yield::default()); // x_s = 0, and T_ff is regular: x = 0
    }

    budget.add_coefficients(bounded(leaf)?);

    let pencil = SupportPencil::new(rows, support);
    let roots = points(region, leaf, budget)?;

    let mut at_points = Vec::new();
    for (k, root) in roots.iter().enumerate() {
        let reason = reason(leaf, leaf.points[k].reason)?;
        let place = PlaceInLeaf {
            number: 2 * k,
            location: Location::Point(root),
            budget,
        };
        at_points.push(pencil.content(reason, &place)?);
    }

    let mut in_cells = Vec::new();
    for (k, &cell) in leaf.cells.iter().enumerate() {
        let reason = reason(leaf, cell)?;
        let place = PlaceInLeaf {
            number: 2 * k + 1,
            location: Location::Cell {
                below: &roots[k],
                above: roots.get(k + 1),
            },
            budget,
        };
        in_cells.push(pencil.content(reason, &place)?);
    }

    Ok(collect(support, &roots, &at_points, &in_cells))
}

fn reason(leaf: &Support, number: usize) -> Result<&Exact, CoverFault> {
    leaf.reasons.get(number).ok_or(CoverFault::NoReason {
        reason: number,
        reasons: leaf.reasons.len(),
    })
}

/// What the places hold, from below: isolated single solutions are listed, the others are families.
/// Cell k lies above point k.
fn collect(
    support: &[usize],
    roots: &[AlgebraicValue],
    at_points: &[PlaceContent],
    in_cells: &[PlaceContent],
) -> Yield {
    let is_empty_cell = |k: usize| in_cells.get(k).is_none_or(|c| *c == PlaceContent::Nothing);
    let mut held = Yield::default();

    for (k, root) in roots.iter().enumerate() {
        if let PlaceContent::Solutions { is_alone } = at_points[k] {
            let is_isolated = (k == 0 || is_empty_cell(k - 1)) && is_empty_cell(k);
            match hull(roots, k) {
                Some(hull) if is_alone && is_isolated => {
                    let solution = AcceptedClaim {
                        support: support.to_vec(),
                        value: root.value.clone(),
                    };
                    held.found.push(LeafSolution { solution, hull });
                }
                _ => held.families.push(SolutionFamily {
                    support: support.to_vec(),
                    from: Some(root.value.clone()),
                    to: Some(root.value.clone()),
                    is_point: true,
                    is_alone,
                }),
            }
        }

        if let Some(PlaceContent::Solutions { is_alone }) = in_cells.get(k) {
            held.families.push(SolutionFamily {
                support: support.to_vec(),
                from: Some(root.value.clone()),
                to: roots.get(k + 1).map(|next| next.value.clone()),
                is_point: false,
                is_alone: *is_alone,
            });
        }
    }

    held
}

/// From half way to the point before to half way to the point after.
fn hull(roots: &[AlgebraicValue], k: usize) -> Option<Interval> {
    let value = &roots[k].value;
    let lo = match k.checked_sub(1) {
        Some(before) => half_way(roots[before].value.hi(), value.lo()),
        None => value.lo().clone(),
    };
    let hi = match roots.get(k + 1) {
        Some(after) => half_way(value.hi(), after.value.lo()),
        None => value.hi().clone(),
    };
    Interval::new(lo, hi)
}

fn half_way(a: &Rational, b: &Rational) -> Rational {
    (a + b) / Rational::from_integer(2.into())
}

/// The points: each isolated, apart from each other, from one end of the region to the other.
fn points(
    region: &Region,
    leaf: &Support,
    budget: &SignBudget,
) -> Result<Vec<AlgebraicValue>, CoverFault> {
    let mut roots: Vec<AlgebraicValue> = Vec::new();
    for (k, point) in leaf.points.iter().enumerate() {
        let poly = Poly::new(point.polynomial.clone()).primitive();
        let [lo, hi] = &point.interval;
        if !budget.spend_evaluation(PolySize::of(&poly), &lo.0, &hi.0) {
            return Err(CoverFault::OutOfBudget);
        }

        let value = isolate(&poly, &point.interval).map_err(|_| CoverFault::Point { point: k })?;
        if roots.last().is_some_and(|r| r.value.hi() >= value.lo()) {
            return Err(CoverFault::Point { point: k });
        }

        roots.push(AlgebraicValue { poly, value });
    }

    let begins_at_lo = is_at(roots.first(), &region.lo);
    let ends_at_hi = match &region.hi {
        Some(hi) => is_at(roots.last(), hi),
        None => true,
    };
    if !begins_at_lo || !ends_at_hi {
        return Err(CoverFault::Point { point: roots.len() });
    }

    // There is a cell above each point, but for the last one of a finite interval.
    let cells = match &region.hi {
        Some(_) => roots.len() - 1,
        None => roots.len(),
    };
    CoverFault::length("cells", cells, leaf.cells.len())?;
    Ok(roots)
}

/// Is the root this very number?
fn is_at(root: Option<&AlgebraicValue>, end: &Rational) -> bool {
    let Some(root) = root else {
        return false;
    };

    let is_end = root.value.lo() == end;
    root.value.is_point() && is_end
}

/// Demands that the leaf is small enough to be multiplied out; its number of coefficients.
fn bounded(leaf: &Support) -> Result<u64, CoverFault> {
    let mut longest: u64 = 0;
    let mut coefficients: u64 = 0;
    let mut bits: u64 = 0;

    for polynomial in polynomials(leaf) {
        let length = polynomial.len() as u64;
        longest = longest.max(length);
        coefficients += length;
        for coefficient in polynomial {
            bits = bits.max(coefficient.bits());
        }
    }

    for end in leaf.points.iter().flat_map(|p| &p.interval) {
        bits = bits.max(end.0.numer().bits() + end.0.denom().bits());
    }

    let what = "coefficients of a polynomial";
    CoverFault::at_most(what, MAX_COEFFICIENTS as u64, longest)?;

    let what = "coefficients and places times bits";
    let places = (leaf.points.len() + leaf.cells.len()) as u64;
    let size = (coefficients + places).saturating_mul(bits);
    CoverFault::at_most(what, MAX_SIZE, size)?;
    Ok(coefficients)
}

/// All polynomials of a leaf.
fn polynomials(leaf: &Support) -> Vec<&Vec<Integer>> {
    let mut list: Vec<&Vec<Integer>> = Vec::new();
    for reason in &leaf.reasons {
        match reason {
            Exact::None(w) => list.extend(&w.0),
            Exact::Some(member) => {
                list.extend(&member.x.0);
                if let Some(alone) = &member.alone {
                    list.extend(alone.rows.iter().flat_map(|(_, l)| &l.0));
                }
            }
        }
    }

    list.extend(leaf.points.iter().map(|point| &point.polynomial));
    list
}

/// A place of the leaf, where signs of polynomials are asked for.
struct PlaceInLeaf<'a> {
    /// Twice the point's position, or one more for the cell above it.
    number: usize,
    location: Location<'a>,
    budget: &'a SignBudget,
}

enum Location<'a> {
    Point(&'a AlgebraicValue),
    /// `above` is `None` for a cell that reaches to infinity.
    Cell {
        below: &'a AlgebraicValue,
        above: Option<&'a AlgebraicValue>,
    },
}

impl PlaceInLeaf<'_> {
    /// The sign of g at every value of the place, if it can be told.
    fn sign(&self, g: &Poly) -> Option<i8> {
        match self.location {
            Location::Point(root) => root.sign(g, self.budget),
            Location::Cell { below, above } => sign_between(g, below, above, self.budget),
        }
    }

    fn fault(&self, expected: &'static str, index: usize) -> CoverFault {
        CoverFault::Place {
            place: self.number,
            expected,
            index,
        }
    }
}

/// The rows of the pencil and the support of a leaf, by the indices of the problem.
struct SupportPencil<'a> {
    rows: &'a Rows,
    support: &'a [usize],
    /// The support and the free variables.
    active: Vec<usize>,
    is_active: Vec<bool>,
    /// By the index of a column: its entries, if the column is active.
    columns: Vec<Vec<ColumnEntry<'a>>>,
}

/// An entry a + bt of T, by its row.
struct ColumnEntry<'a> {
    row: usize,
    a: &'a Integer,
    b: &'a Integer,
}

impl<'a> SupportPencil<'a> {
    fn new(rows: &'a Rows, support: &'a [usize]) -> Self {
        let mut is_active = rows.is_free.clone();
        for &i in support {
            is_active[i] = true;
        }

        let mut columns: Vec<Vec<ColumnEntry<'a>>> = Vec::new();
        columns.resize_with(rows.order(), Vec::new);
        for (row, entries) in rows.rows.iter().enumerate() {
            for (j, a, b) in entries {
                if is_active[*j] {
                    columns[*j].push(ColumnEntry { row, a, b });
                }
            }
        }

        let active = (0..rows.order()).filter(|&i| is_active[i]).collect();
        SupportPencil {
            rows,
            support,
            active,
            is_active,
            columns,
        }
    }

    /// Checks a reason at a place and returns what it proves.
    fn content(&self, reason: &Exact, place: &PlaceInLeaf<'_>) -> Result<PlaceContent, CoverFault> {
        match reason {
            Exact::None(w) => {
                let w = self.vector("none", w)?;
                self.check_nothing(&w, place)?;
                Ok(PlaceContent::Nothing)
            }
            Exact::Some(member) => {
                let x = self.vector("x", &member.x)?;
                let y = self.check_solution(&x, place)?;
                if let Some(alone) = &member.alone {
                    self.check_alone(alone, &y, place)?;
                }

                let is_alone = member.alone.is_some();
                Ok(PlaceContent::Solutions { is_alone })
            }
        }
    }

    fn vector(&self, what: &'static str, v: &Polynomials) -> Result<Vec<Poly>, CoverFault> {
        CoverFault::length(what, self.rows.order(), v.0.len())?;
        Ok(v.0.iter().map(|c| Poly::new(c.clone())).collect())
    }

    /// Entry j of w'T, j active.
    fn column(&self, w: &[Poly], j: usize, budget: &SignBudget) -> Result<Poly, CoverFault> {
        let mut sum = Poly::default();
        for entry in &self.columns[j] {
            add_product(&mut sum, &w[entry.row], entry.a, entry.b, budget)?;
        }

        Ok(sum)
    }

    /// Demands that w is a Farkas vector.
    fn check_nothing(&self, w: &[Poly], place: &PlaceInLeaf<'_>) -> Result<(), CoverFault> {
        // Is some weight of R certainly positive? Then w'y >= 0 is all that is known of w'y.
        let mut is_one_sided = false;
        for (i, w_i) in w.iter().enumerate() {
            if self.is_active[i] {
                continue;
            }

            match place.sign(w_i) {
                Some(s) if s >= 0 => is_one_sided |= s > 0,
                _ => return Err(place.fault("weights >= 0 off the moving set", i)),
            }
        }

        let mut has_negative = false;
        let mut has_positive = false;
        for &j in &self.active {
            let product = self.column(w, j, place.budget)?;
            let s = place
                .sign(&product)
                .ok_or_else(|| place.fault("a sign of w'T that can be told", j))?;
            if s != 0 && self.rows.is_free[j] {
                return Err(place.fault("w'T = 0 on the free columns", j));
            }

            if s > 0 && is_one_sided {
                return Err(place.fault("w'T <= 0 on the moving columns", j));
            }

            has_negative |= s < 0;
            has_positive |= s > 0;
        }

        if has_negative == has_positive {
            let expected = "w'T of one sign and not zero";
            return Err(place.fault(expected, self.support[0]));
        }

        Ok(())
    }

    /// Demands that x is a solution with exactly this support; the signs of its y.
    fn check_solution(
        &self,
        x: &[Poly],
        place: &PlaceInLeaf<'_>,
    ) -> Result<Vec<Option<i8>>, CoverFault> {
        for (i, x_i) in x.iter().enumerate() {
            if self.rows.is_free[i] {
                continue;
            }

            let is_in_support = self.support.contains(&i);
            let s = place.sign(x_i);
            if is_in_support && s != Some(1) {
                return Err(place.fault("x > 0 on the moving set", i));
            }

            if !is_in_support && s != Some(0) {
                return Err(place.fault("x = 0 off it", i));
            }
        }

        let mut signs = Vec::new();
        for (i, row) in self.rows.rows.iter().enumerate() {
            let y_i = self.times(row, x, place.budget)?;
            let s = place.sign(&y_i);
            let is_active = self.is_active[i];
            if is_active && s != Some(0) {
                return Err(place.fault("y = 0 on active rows", i));
            }

            if !is_active && s.is_none_or(|s| s < 0) {
                return Err(place.fault("y >= 0 off them", i));
            }

            signs.push(s);
        }

        Ok(signs)
    }

    /// A row of T times x, over the active columns: off them x is zero at this place, whatever its
    /// polynomials are elsewhere.
    fn times(&self, row: &Row, x: &[Poly], budget: &SignBudget) -> Result<Poly, CoverFault> {
        let mut y = Poly::default();
        for (j, a, b) in row {
            if self.is_active[*j] {
                add_product(&mut y, &x[*j], a, b, budget)?;
            }
        }

        Ok(y)
    }

    /// Demands that the pivot's component determines every other active one. `y` holds the signs of
    /// the solution's y: l'Tx = l_R'y_R.
    fn check_alone(
        &self,
        alone: &Alone,
        y: &[Option<i8>],
        place: &PlaceInLeaf<'_>,
    ) -> Result<(), CoverFault> {
        if !self.support.contains(&alone.pivot) {
            return Err(CoverFault::Pivot { index: alone.pivot });
        }

        let mut bounds = vec![ProvedSigns::default(); self.rows.order()];
        for (own, l) in &alone.rows {
            let own = *own;
            if own == alone.pivot || !self.is_active.get(own).is_some_and(|&active| active) {
                return Err(place.fault("an active index that is not the pivot", own));
            }

            let l = self.vector("alone", l)?;
            let is_equation = self.check_weights(&l, y, place)?;
            for &j in &self.active {
                if j == alone.pivot {
                    continue;
                }

                let product = self.column(&l, j, place.budget)?;
                match place.sign(&product) {
                    Some(0) if j != own => {}
                    Some(s) if j == own && s != 0 => {
                        bounds[own].below |= s > 0 || is_equation;
                        bounds[own].above |= s < 0 || is_equation;
                    }
                    _ => {
                        let expected = "l'T zero but in its own column and the pivot's";
                        return Err(place.fault(expected, j));
                    }
                }
            }
        }

        for &j in &self.active {
            let is_bounded = bounds[j].below && bounds[j].above;
            if j != alone.pivot && !is_bounded {
                return Err(place.fault("x determined by the pivot's component", j));
            }
        }

        Ok(())
    }

    /// Demands l >= 0 on rows of R where y = 0, and l = 0 on the other rows of R. Is l zero on all
    /// of R, so that l'Tz = 0 for every solution z?
    fn check_weights(
        &self,
        l: &[Poly],
        y: &[Option<i8>],
        place: &PlaceInLeaf<'_>,
    ) -> Result<bool, CoverFault> {
        let mut is_equation = true;
        for (i, l_i) in l.iter().enumerate() {
            if self.is_active[i] || l_i.is_zero() {
                continue;
            }

            if y[i] != Some(0) || place.sign(l_i).is_none_or(|s| s < 0) {
                let expected = "weights >= 0 where y = 0, and none where y > 0";
                return Err(place.fault(expected, i));
            }

            is_equation = false;
        }

        Ok(is_equation)
    }
}

/// Adds p (a + bt) to the sum.
fn add_product(
    sum: &mut Poly,
    p: &Poly,
    a: &Integer,
    b: &Integer,
    budget: &SignBudget,
) -> Result<(), CoverFault> {
    let is_zero_entry = a.is_zero() && b.is_zero();
    if p.is_zero() || is_zero_entry {
        return Ok(());
    }

    if !budget.spend_product(p, a, b) {
        return Err(CoverFault::OutOfBudget);
    }

    let entry = Poly::new(vec![a.clone(), b.clone()]);
    *sum += &(p * &entry);
    Ok(())
}

/// Is c z_j + d z_k >= 0 proved for all solutions z, with equality for x: with c > 0 (`below`),
/// with c < 0 (`above`)?
#[derive(Clone, Copy, Default)]
struct ProvedSigns {
    below: bool,
    above: bool,
}

#[cfg(test)]
mod tests;
