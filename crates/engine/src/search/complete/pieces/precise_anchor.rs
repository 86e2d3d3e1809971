//! An anchor whose W has more bits than doubles: Taylor coefficients by refinement with exact
//! residuals.
//!
//! F_c W_k = [k = 0] (A_fs + c B_fs) + [k = 1] B_fs - B_ff W_(k-1) is solved by the factors of F_c
//! in doubles; each round adds the solution for the exact residual, and gains the digits that the
//! factors are good for.

use crate::search::complete::pieces::anchor::{FINE, expand};
use crate::search::complete::pieces::blocks::Blocks;
use mceip_check::certificate::{Anchor, Condensation, IntegerMatrix};
use mceip_exact::{Integer, Rational, common_denominator, from_f64, to_f64};
use mceip_model::Pencil;
use num_traits::{One, Signed, Zero};

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
    let blocks = Blocks::of(pencil);
    let bounds = [
        to_f64(&condensation.sigma.0),
        to_f64(&condensation.mass_sigma.0),
    ];
    let (mut anchor, _) = expand(pencil, &blocks, &center, bounds, FINE)?;
    let factor = blocks.factor_at(to_f64(&center))?;

    let rows = free_rows(pencil, &center);
    for k in 0..anchor.right.len() {
        let bits = RIGHT_BITS.saturating_sub(BITS_PER_DEGREE * k as u32);
        widen(&mut anchor.right[k], bits);

        for _ in 0..ROUNDS {
            let before = k.checked_sub(1).map(|p| &anchor.right[p]);
            let mut columns = residual(&rows, k, &anchor.right[k], before);
            factor.solve_all(&mut columns);
            if add(&mut anchor.right[k], &columns)? {
                break;
            }
        }
    }
    Some(anchor)
}

/// An entry of a free row: position among the free or the complementarity variables, F_c or A + cB,
/// and B, both times the row's multiple.
struct Entry {
    position: usize,
    at_center: Integer,
    slope: Integer,
}

/// A free row of A + tB about a centre, its denominators cleared.
struct FreeRow {
    multiple: Integer,
    free: Vec<Entry>,
    slip: Vec<Entry>,
}

fn free_rows(pencil: &Pencil, center: &Rational) -> Vec<FreeRow> {
    let mut place = vec![(false, 0); pencil.order()];
    pencil
        .free()
        .iter()
        .enumerate()
        .for_each(|(k, &i)| place[i] = (true, k));
    pencil
        .slip()
        .iter()
        .enumerate()
        .for_each(|(k, &i)| place[i] = (false, k));

    let row = |&i: &usize| {
        let (a, b) = (pencil.a().row(i), pencil.b().row(i));
        let clear = common_denominator(a.iter().chain(b).map(|e| &e.1));
        let multiple = Rational::from_integer(clear * center.denom());
        let mut row = FreeRow {
            multiple: multiple.to_integer(),
            free: Vec::new(),
            slip: Vec::new(),
        };

        let mut columns: Vec<usize> = a.iter().chain(b).map(|e| e.0).collect();
        columns.sort_unstable();
        columns.dedup();
        for column in columns {
            let (a, b) = (pencil.a().get(i, column), pencil.b().get(i, column));
            let (is_free, position) = place[column];
            let at_center = ((a + center * &b) * &multiple).to_integer();
            let entry = Entry {
                position,
                at_center,
                slope: (b * &multiple).to_integer(),
            };
            if is_free {
                row.free.push(entry)
            } else {
                row.slip.push(entry)
            }
        }
        row
    };
    pencil.free().iter().map(row).collect()
}

/// Raises the exponent so that the largest entry has this many bits; more stay.
fn widen(m: &mut IntegerMatrix, bits: u32) {
    let largest = m
        .rows
        .iter()
        .flatten()
        .map(Integer::bits)
        .max()
        .unwrap_or(0);
    let more = u64::from(bits).saturating_sub(largest);
    if largest > 0 {
        m.rows.iter_mut().flatten().for_each(|v| *v <<= more);
        m.exponent += more as u32;
    }
}

/// The residual of W_k's equation in doubles, by columns.
fn residual(
    rows: &[FreeRow],
    k: usize,
    w: &IntegerMatrix,
    before: Option<&IntegerMatrix>,
) -> Vec<Vec<f64>> {
    let columns = w.rows.first().map_or(0, Vec::len);
    let exponent = w.exponent.max(before.map_or(0, |m| m.exponent));
    let lift = exponent - w.exponent;
    let lift_before = before.map_or(0, |m| exponent - m.exponent);

    let mut out = vec![vec![0.0; rows.len()]; columns];
    for (i, row) in rows.iter().enumerate() {
        let mut sums = vec![Integer::zero(); columns];
        for entry in &row.slip {
            match k {
                0 => sums[entry.position] += &entry.at_center << exponent,
                1 => sums[entry.position] += &entry.slope << exponent,
                _ => {}
            }
        }
        for entry in &row.free {
            subtract(
                &mut sums,
                &(&entry.at_center << lift),
                &w.rows[entry.position],
            );
            if let Some(before) = before.filter(|_| !entry.slope.is_zero()) {
                subtract(
                    &mut sums,
                    &(&entry.slope << lift_before),
                    &before.rows[entry.position],
                );
            }
        }

        let unit = &row.multiple << exponent;
        for (j, sum) in sums.into_iter().enumerate() {
            out[j][i] = to_f64(&Rational::new_raw(sum, unit.clone()));
        }
    }
    out
}

/// sums -= factor row.
fn subtract(sums: &mut [Integer], factor: &Integer, row: &[Integer]) {
    for (sum, v) in sums.iter_mut().zip(row) {
        *sum -= factor * v;
    }
}

/// Adds corrections, rounded to units of the matrix; is none of them more than a unit?
fn add(m: &mut IntegerMatrix, columns: &[Vec<f64>]) -> Option<bool> {
    let unit = Rational::from_integer(Integer::one() << m.exponent);
    let mut is_still = true;
    for (j, column) in columns.iter().enumerate() {
        for (row, v) in m.rows.iter_mut().zip(column) {
            let units = (from_f64(*v).ok()? * &unit).round().to_integer();
            is_still &= units.abs() <= Integer::one();
            row[j] += units;
        }
    }
    Some(is_still)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, whole};

    /// F = [[3, -1], [-1, 2]] + t I, C = (1, 0)' + t (0, 1)': at t = 1 the coefficients are W_0 =
    /// F^-1 (1, 1)' = (4, 5)' / 11, W_1 = F^-1 ((0, 1)' - W_0).
    #[test]
    fn coefficients_are_right_beyond_doubles() {
        let a = Sparse::from_ints(&[&[3, -1, 1], &[-1, 2, 0], &[1, 0, 5]]);
        let b = Sparse::from_ints(&[&[1, 0, 0], &[0, 1, 1], &[0, 1, 1]]);
        let pencil = Pencil::new(a, b, vec![0, 1]).unwrap();
        let rows = free_rows(&pencil, &whole(1));
        assert_eq!(
            (
                rows[1].free[1].at_center.clone(),
                rows[1].slip[0].at_center.clone()
            ),
            (3.into(), 1.into())
        );

        let window = mceip_model::Window::new(whole(0), Some(whole(2))).unwrap();
        let condensation = crate::search::complete::pieces::condense::condense(&pencil, &window)
            .unwrap()
            .condensation;
        let anchor = precise_anchor(&pencil, &condensation, &whole(1)).unwrap();

        let entry = |k: usize, i: usize| {
            let m = &anchor.right[k];
            Rational::new(m.rows[i][0].clone(), Integer::one() << m.exponent)
        };
        let limit = |bits: u32| Rational::new(Integer::one(), Integer::one() << bits);
        // F W_0 = (1, 1)' with F = [[4, -1], [-1, 3]].
        let of = |p: i64| Rational::new(p.into(), 11.into());
        assert!(
            (entry(0, 0) - of(4)).abs() < limit(120) && (entry(0, 1) - of(5)).abs() < limit(120)
        );
        // F W_1 = (0, 1)' - W_0 = (-4, 6)' / 11, so W_1 = (-6, 20)' / 121.
        let of = |p: i64| Rational::new(p.into(), 121.into());
        assert!(
            (entry(1, 0) - of(-6)).abs() < limit(70) && (entry(1, 1) - of(20)).abs() < limit(70)
        );
    }
}
