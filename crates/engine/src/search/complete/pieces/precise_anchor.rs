//! An anchor whose W has more bits than doubles: Taylor coefficients by refinement with exact
//! residuals.
//!
//! The equation F_c W_k = [k = 0] T_fs(c) + [k = 1] B_fs - B_ff W_(k-1) is solved with the factor
//! of F_c in doubles. Each round adds the solution for the exact residual, and gains the digits
//! that the factor is good for. With d = t - c and W(d) = sum_k W_k d^k the condensed pencil is
//!
//! ```text
//!     T(t) = T_ss(t) - T_sf(t) W(d),    T'(t) = B_ss - B_sf W(d) - T_sf(t) W'(d).
//! ```
//!
//! Called by `complete::precise` for regions whose signs are beyond doubles.

use super::anchor::{FINE, FreeElimination};
use super::condense::bounds_of;
use mceip_check::certificate::{Anchor, Condensation, IntegerMatrix, IntegerRow};
use mceip_exact::{Integer, Rational, Sparse, common_denominator, from_f64, to_f64, truncated};
use mceip_model::Pencil;
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Bits of the largest entry of W_0. Basis: the checker keeps 128 bits of an entry of the condensed
/// pencil.
const RIGHT_BITS: u32 = 124;
/// Bits that each further coefficient needs less: the centre is the value in doubles, to 2^-52.
const BITS_PER_DEGREE: u32 = 50;
/// Rounds of refinement, at most. Each gains 20 bits or more.
const ROUNDS: usize = 12;

/// An anchor about the double nearest to a value; `None` where F is singular in doubles there.
pub(crate) fn precise_anchor(
    pencil: &Pencil,
    condensation: &Condensation,
    value: &Rational,
) -> Option<Anchor> {
    let center = from_f64(to_f64(value)).ok()?;
    let elimination = FreeElimination::new(pencil, bounds_of(condensation));
    let mut anchor = elimination.expand(&center, FINE)?.anchor;
    let factor = elimination.blocks.factor_at(to_f64(&center))?;

    let rows = free_rows(pencil, &center);
    for k in 0..anchor.right.len() {
        let bits = RIGHT_BITS.saturating_sub(BITS_PER_DEGREE * k as u32);
        widen(&mut anchor.right[k], bits);

        for _ in 0..ROUNDS {
            let before = k.checked_sub(1).map(|p| &anchor.right[p]);
            let equation = CoefficientEquation::new(k, &anchor.right[k], before);
            let mut columns = equation.residual(&rows);
            factor.solve_all(&mut columns, false);
            if add(&mut anchor.right[k], &columns)? {
                break;
            }
        }
    }

    Some(anchor)
}

/// The pencil T(v) + (t - v) T'(v) on the complementarity variables in place of T(t) near a value
/// v, in exact arithmetic with the W of an anchor.
pub(crate) fn tangent(pencil: &Pencil, anchor: &Anchor, value: &Rational) -> Option<Pencil> {
    let slip = pencil.slip();
    let free = pencil.free();
    let [a_sf, b_sf] = [pencil.a(), pencil.b()].map(|m| m.submatrix(&slip, free));
    let at_value = a_sf.add_scaled(value, &b_sf);

    // Only the rows of W that T_sf meets are needed.
    let distance = value - &anchor.center.0;
    let columns = at_value
        .entries()
        .chain(b_sf.entries())
        .map(|entry| entry.1);
    let mut solved: BTreeMap<usize, SolvedRow> = BTreeMap::new();
    for column in columns {
        let make = || SolvedRow::new(&anchor.right, column, &distance, slip.len());
        solved.entry(column).or_insert_with(make);
    }

    let order = slip.len();
    let times = |matrix: &Sparse, row: fn(&SolvedRow) -> &[Rational]| {
        let mut product = vec![vec![Rational::zero(); order]; order];
        for (i, column, entry) in matrix.entries() {
            for (sum, w) in product[i].iter_mut().zip(row(&solved[&column])) {
                *sum += entry * w;
            }
        }
        product
    };
    let of_value = times(&at_value, |row| &row.w);
    let of_slope = [
        times(&b_sf, |row| &row.w),
        times(&at_value, |row| &row.slope),
    ];

    let [a_ss, b_ss] = [pencil.a(), pencil.b()].map(|m| m.submatrix(&slip, &slip));
    let (mut constant, mut slope) = (Vec::new(), Vec::new());
    for i in 0..order {
        for j in 0..order {
            let of_t = b_ss.get(i, j) - &of_slope[0][i][j] - &of_slope[1][i][j];
            // T(v) - v T'(v)
            let at_zero = a_ss.get(i, j) + value * b_ss.get(i, j) - &of_value[i][j] - value * &of_t;
            constant.push((i, j, at_zero));
            slope.push((i, j, of_t));
        }
    }

    let [a, b] = [constant, slope].map(|entries| Sparse::from_entries(order, order, entries));
    Pencil::new(a, b, Vec::new()).ok()
}

/// A row of W(d) and of its derivative.
struct SolvedRow {
    w: Vec<Rational>,
    slope: Vec<Rational>,
}

impl SolvedRow {
    fn new(right: &[IntegerMatrix], row: usize, distance: &Rational, order: usize) -> SolvedRow {
        let mut solved = SolvedRow {
            w: vec![Rational::zero(); order],
            slope: vec![Rational::zero(); order],
        };

        // Horner's rule, with the derivative beside it.
        for matrix in right.iter().rev() {
            let unit = Integer::one() << matrix.exponent;
            for (j, entry) in matrix.rows[row].iter().enumerate() {
                let slope = &solved.slope[j] * distance + &solved.w[j];
                let coefficient = Rational::new((*entry).clone(), unit.clone());
                solved.w[j] = &solved.w[j] * distance + coefficient;
                solved.slope[j] = slope;
            }
        }

        solved
    }
}

/// An entry of a free row: position among the free or the complementarity variables, F_c or A + cB,
/// and B, both times the row's multiple.
struct RowEntry {
    position: usize,
    at_center: Integer,
    slope: Integer,
}

/// A free row of A + tB about a centre, its denominators cleared.
struct FreeRow {
    multiple: Integer,
    free: Vec<RowEntry>,
    slip: Vec<RowEntry>,
}

/// Where a variable of the pencil stands.
#[derive(Clone, Copy)]
enum VariablePlace {
    Free(usize),
    Slip(usize),
}

fn places(pencil: &Pencil) -> Vec<VariablePlace> {
    let mut places = vec![VariablePlace::Slip(0); pencil.order()];
    for (position, &i) in pencil.free().iter().enumerate() {
        places[i] = VariablePlace::Free(position);
    }

    for (position, &i) in pencil.slip().iter().enumerate() {
        places[i] = VariablePlace::Slip(position);
    }

    places
}

fn free_rows(pencil: &Pencil, center: &Rational) -> Vec<FreeRow> {
    let places = places(pencil);
    pencil
        .free()
        .iter()
        .map(|&i| free_row(pencil, center, &places, i))
        .collect()
}

fn free_row(pencil: &Pencil, center: &Rational, places: &[VariablePlace], i: usize) -> FreeRow {
    let a = pencil.a().row(i);
    let b = pencil.b().row(i);
    let clear = common_denominator(a.iter().chain(b).map(|e| &e.1));
    let multiple = Rational::from_integer(clear * center.denom());

    let mut columns: Vec<usize> = a.iter().chain(b).map(|e| e.0).collect();
    columns.sort_unstable();
    columns.dedup();

    let mut row = FreeRow {
        multiple: multiple.to_integer(),
        free: Vec::new(),
        slip: Vec::new(),
    };

    for column in columns {
        let a = pencil.a().get(i, column);
        let b = pencil.b().get(i, column);
        let at_center = ((a + center * &b) * &multiple).to_integer();
        let slope = (b * &multiple).to_integer();

        let (list, position) = match places[column] {
            VariablePlace::Free(position) => (&mut row.free, position),
            VariablePlace::Slip(position) => (&mut row.slip, position),
        };

        list.push(RowEntry {
            position,
            at_center,
            slope,
        });
    }

    row
}

/// Raises the exponent so that the largest entry has this many bits; more stay.
fn widen(matrix: &mut IntegerMatrix, bits: u32) {
    let largest = matrix.rows.iter().map(IntegerRow::bits).max().unwrap_or(0);
    if largest == 0 {
        return;
    }

    let more = u64::from(bits).saturating_sub(largest);
    for row in Arc::make_mut(&mut matrix.rows) {
        *row = row.iter().map(|entry| &*entry << more).collect();
    }

    matrix.exponent += more as u32;
}

/// The equation of one coefficient W_k, with what is known of its solution.
struct CoefficientEquation<'a> {
    k: usize,
    w: &'a IntegerMatrix,
    /// W_(k-1).
    before: Option<&'a IntegerMatrix>,
    /// Binary exponent of the residual, no less than those of `w` and `before`.
    exponent: u32,
}

impl CoefficientEquation<'_> {
    fn new<'a>(
        k: usize,
        w: &'a IntegerMatrix,
        before: Option<&'a IntegerMatrix>,
    ) -> CoefficientEquation<'a> {
        let exponent_before = before.map_or(0, |m| m.exponent);
        CoefficientEquation {
            k,
            w,
            before,
            exponent: w.exponent.max(exponent_before),
        }
    }

    /// The residual in doubles, by columns.
    fn residual(&self, rows: &[FreeRow]) -> Vec<Vec<f64>> {
        let width = self.w.rows.first().map_or(0, IntegerRow::len);
        let mut columns = vec![vec![0.0; rows.len()]; width];

        for (i, row) in rows.iter().enumerate() {
            let sums = self.row_residual(row, width);
            let unit = &row.multiple << self.exponent;
            for (column, sum) in columns.iter_mut().zip(sums) {
                column[i] = to_f64(&Rational::new_raw(sum, unit.clone()));
            }
        }

        columns
    }

    /// One row of the residual, in units of the row's multiple times 2^`exponent`.
    fn row_residual(&self, row: &FreeRow, width: usize) -> Vec<Integer> {
        let mut sums = vec![Integer::zero(); width];
        for entry in &row.slip {
            match self.k {
                0 => sums[entry.position] += &entry.at_center << self.exponent,
                1 => sums[entry.position] += &entry.slope << self.exponent,
                _ => {}
            }
        }

        for entry in &row.free {
            let lift = self.exponent - self.w.exponent;
            let factor = &entry.at_center << lift;
            subtract(&mut sums, &factor, &self.w.rows[entry.position]);

            if let Some(before) = self.before.filter(|_| !entry.slope.is_zero()) {
                let lift = self.exponent - before.exponent;
                let factor = &entry.slope << lift;
                subtract(&mut sums, &factor, &before.rows[entry.position]);
            }
        }

        sums
    }
}

/// sums -= factor row.
fn subtract(sums: &mut [Integer], factor: &Integer, row: &IntegerRow) {
    for (sum, v) in sums.iter_mut().zip(row.iter()) {
        *sum -= factor * &*v;
    }
}

/// Adds corrections, rounded to units of the matrix; is none of them more than a unit?
fn add(matrix: &mut IntegerMatrix, columns: &[Vec<f64>]) -> Option<bool> {
    // Powers of two whose product is in the range of doubles where either factor may not be.
    let exponent = matrix.exponent as i32;
    let units = [exponent / 2, exponent - exponent / 2].map(|half| f64::from(half).exp2());

    let mut is_still = true;
    for (i, row) in Arc::make_mut(&mut matrix.rows).iter_mut().enumerate() {
        let mut corrected = row.to_vec();
        for (entry, column) in corrected.iter_mut().zip(columns) {
            let correction = (column[i] * units[0] * units[1]).round();
            is_still &= correction.abs() <= 1.0;
            *entry += truncated(correction)?;
        }
        *row = corrected.into();
    }

    Some(is_still)
}

#[cfg(test)]
mod tests {
    use super::super::anchor::OF_WINDOW;
    use super::*;
    use crate::search::complete::pieces::condense::{DefinitePencils, condense};
    use mceip_exact::{rational, whole};
    use mceip_model::Window;
    use num_traits::Signed;

    /// Is entry (i, 0) of a matrix within 2^-bits of a number?
    fn is_near(matrix: &IntegerMatrix, i: usize, expected: &Rational, bits: u32) -> bool {
        let unit = Integer::one() << matrix.exponent;
        let entry = Rational::new(matrix.rows[i].at(0).into_owned(), unit);
        let limit = Rational::new(Integer::one(), Integer::one() << bits);
        (entry - expected).abs() < limit
    }

    /// F = [[3, -1], [-1, 2]] + t I, C = (1, 0)' + t (0, 1)': at t = 1 the coefficients are W_0 =
    /// F^-1 (1, 1)' = (4, 5)' / 11, W_1 = F^-1 ((0, 1)' - W_0).
    #[test]
    fn coefficients_are_right_beyond_doubles() {
        let a = Sparse::from_ints(&[&[3, -1, 1], &[-1, 2, 0], &[1, 0, 5]]);
        let b = Sparse::from_ints(&[&[1, 0, 0], &[0, 1, 1], &[0, 1, 1]]);
        let pencil = Pencil::new(a, b, vec![0, 1]).unwrap();
        let rows = free_rows(&pencil, &whole(1));
        assert_eq!(rows[1].free[1].at_center, 3.into());
        assert_eq!(rows[1].slip[0].at_center, 1.into());

        let window = Window::new(whole(0), Some(whole(2))).unwrap();
        let condensation = condense(&pencil, &window, DefinitePencils::own(&pencil), OF_WINDOW)
            .unwrap()
            .condensation;
        let anchor = precise_anchor(&pencil, &condensation, &whole(1)).unwrap();

        // F W_0 = (1, 1)' with F = [[4, -1], [-1, 3]].
        assert!(is_near(&anchor.right[0], 0, &rational(4, 11), 120));
        assert!(is_near(&anchor.right[0], 1, &rational(5, 11), 120));
        // F W_1 = (0, 1)' - W_0 = (-4, 6)' / 11, so W_1 = (-6, 20)' / 121.
        assert!(is_near(&anchor.right[1], 0, &rational(-6, 121), 70));
        assert!(is_near(&anchor.right[1], 1, &rational(20, 121), 70));

        // T = 5 + t - (1, t) F^-1 (1, t)' = 5 + t - (t^3 + 3 t^2 + 3 t + 2) / (t^2 + 5 t + 5) is
        // 57 / 11 at t = 1, where its slope is 1 - (12 * 11 - 9 * 7) / 121 = 52 / 121.
        let near = tangent(&pencil, &anchor, &whole(1)).unwrap();
        let is_close = |number: Rational, expected: Rational| {
            (number - expected).abs() < Rational::new(Integer::one(), Integer::one() << 70)
        };
        assert!(is_close(near.b().get(0, 0), rational(52, 121)));
        assert!(is_close(near.a().get(0, 0), rational(57 * 11 - 52, 121)));
    }
}
