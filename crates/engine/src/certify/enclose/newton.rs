//! Newton's method with exact residuals for the null vector of the active block.
//!
//! Unknowns z = (x on the active variables, t); F(z) = ((A + tB) x on the active rows, e'x_s - 1).
//! The inverse of F' is taken in doubles once, F is computed in integers, so each step gains the
//! digits that the inverse is good for.

use super::super::failure::AttemptFailure;
use super::super::rows::{IntegralRows, active};
use crate::candidate::Candidate;
use mceip_exact::{Integer, Rational, from_f64, to_f64};
use mceip_mcp::linear::inverse;
use mceip_model::Pencil;
use num_traits::{One, Signed, Zero};

/// Newton steps on one grid, at most. Each gains 20 bits or more, and a finer grid has at most 256
/// bits more.
const NEWTON_STEPS: usize = 16;
/// Bits by which a step may be longer than the first one. Basis: with one inverse for all steps
/// each is a fraction of the one before where the method converges; steps that grow end nowhere, in
/// numbers that grow with them.
const GROWTH_BITS: u64 = 8;
/// Bits of a coefficient that a double takes without any thought of overflow.
const SAFE_BITS: u64 = 500;
/// Least binary exponent of a value that counts as its scale; below it a value is taken for zero.
const LEAST_EXPONENT: i32 = -500;

/// A point on a grid: x in units of 2^-`x_bits`, t in units of 2^-`t_bits`.
#[derive(Debug, Clone)]
pub(in crate::certify) struct Point {
    pub(in crate::certify) x: Vec<Integer>,
    pub(in crate::certify) t: Integer,
    pub(in crate::certify) x_bits: u64,
    pub(in crate::certify) t_bits: u64,
}

impl Point {
    /// Component k of x, or t after the last one, in units of its grid.
    pub(super) fn component(&self, k: usize) -> &Integer {
        self.x.get(k).unwrap_or(&self.t)
    }

    /// Bits after the point of component k.
    pub(super) fn bits(&self, k: usize) -> u64 {
        if k < self.x.len() {
            self.x_bits
        } else {
            self.t_bits
        }
    }

    /// So many units of component k's grid.
    pub(super) fn in_units(&self, k: usize, units: &Integer) -> Rational {
        dyadic(units.clone(), self.bits(k))
    }

    /// Component k.
    pub(in crate::certify) fn value(&self, k: usize) -> Rational {
        self.in_units(k, self.component(k))
    }

    /// a + t b in units of the grid of t.
    pub(in crate::certify) fn entry(&self, a: &Integer, b: &Integer) -> Integer {
        (a << self.t_bits) + b * &self.t
    }

    /// The same point on a grid with so many more bits.
    pub(in crate::certify) fn refine(&mut self, more: u32) {
        self.x.iter_mut().for_each(|v| *v <<= more);
        self.t <<= more;
        self.x_bits += u64::from(more);
        self.t_bits += u64::from(more);
    }
}

/// An entry of F' in doubles, its row divided by a power of two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    pub(super) column: usize,
    pub(super) value: f64,
    /// Sum of the moduli of the terms that it is made of.
    pub(super) size: f64,
}

/// The square system of an enclosed solution.
pub(in crate::certify) struct Newton<'a> {
    rows: &'a IntegralRows,
    pub(in crate::certify) active: Vec<usize>,
    /// Position of each variable among the active ones.
    place: Vec<Option<usize>>,
    in_support: Vec<bool>,
    /// Each active row, and the last one, is divided by two to this power before it becomes
    /// doubles: exact pencils may have rows of thousands of bits.
    pub(super) scales: Vec<u64>,
}

impl<'a> Newton<'a> {
    pub(in crate::certify) fn new(
        pencil: &Pencil,
        rows: &'a IntegralRows,
        support: &[usize],
    ) -> Newton<'a> {
        let active = active(pencil, support);
        let mut place = vec![None; pencil.order()];
        active
            .iter()
            .enumerate()
            .for_each(|(k, &i)| place[i] = Some(k));
        let mut in_support = vec![false; pencil.order()];
        support.iter().for_each(|&i| in_support[i] = true);

        let largest = |i: usize| {
            rows.0[i]
                .iter()
                .map(|(_, a, b)| a.bits().max(b.bits()))
                .max()
                .unwrap_or(0)
        };
        let scales = active
            .iter()
            .map(|&i| largest(i).saturating_sub(SAFE_BITS))
            .chain([0])
            .collect();
        Newton {
            rows,
            active,
            place,
            in_support,
            scales,
        }
    }

    pub(super) fn is_in_support(&self, index: usize) -> bool {
        self.in_support[index]
    }

    /// Variables that are not active, ascending.
    pub(in crate::certify) fn inactive(&self) -> impl Iterator<Item = usize> {
        (0..self.place.len()).filter(|&i| self.place[i].is_none())
    }

    /// Entries (position, a, b) of a row of the pencil in the active columns.
    pub(in crate::certify) fn active_entries(
        &self,
        row: usize,
    ) -> impl Iterator<Item = (usize, &Integer, &Integer)> {
        self.rows.0[row]
            .iter()
            .filter_map(|(j, a, b)| self.place[*j].map(|k| (k, a, b)))
    }

    /// The candidate on the active variables with e'x_s = 1, then t, on a grid with `bits` bits for
    /// the largest component of x and for t.
    pub(in crate::certify) fn start(
        &self,
        candidate: &Candidate,
        bits: u32,
    ) -> Result<Point, AttemptFailure> {
        let sum: f64 = self
            .active
            .iter()
            .filter(|i| self.in_support[**i])
            .map(|&i| candidate.x[i])
            .sum();
        let x: Vec<f64> = self.active.iter().map(|&i| candidate.x[i] / sum).collect();
        let largest = x.iter().fold(0.0f64, |m, v| m.max(v.abs()));

        // The grid of the larger one of x and t is not coarser than 1.
        let (x_above, t_above) = (binary_exponent(largest), binary_exponent(candidate.value));
        let lift = (x_above.max(t_above) - bits as i32).max(0);
        let x_bits = (bits as i32 + lift - x_above).unsigned_abs().into();
        let t_bits = (bits as i32 + lift - t_above).unsigned_abs().into();

        let on_grid = |v: f64, bits: u64| -> Result<Integer, AttemptFailure> {
            let exact = from_f64(v).map_err(|_| AttemptFailure::NotFinite)?;
            Ok((exact * Rational::from_integer(Integer::one() << bits))
                .round()
                .to_integer())
        };
        let x = x
            .into_iter()
            .map(|v| on_grid(v, x_bits))
            .collect::<Result<_, _>>()?;
        Ok(Point {
            x,
            t: on_grid(candidate.value, t_bits)?,
            x_bits,
            t_bits,
        })
    }

    /// F'(z) in doubles, row by row.
    pub(super) fn jacobian(&self, point: &Point) -> Vec<Vec<Slope>> {
        let last = self.active.len();
        let x: Vec<f64> = (0..last).map(|k| to_f64(&point.value(k))).collect();
        let t = to_f64(&point.value(last));
        let mut out = Vec::new();

        for (i, &index) in self.active.iter().enumerate() {
            let mut row = Vec::new();
            let mut of_t = Slope {
                column: last,
                value: 0.0,
                size: 0.0,
            };
            for (column, a, b) in self.active_entries(index) {
                let (a, b) = (scaled(a, self.scales[i]), scaled(b, self.scales[i]));
                row.push(Slope {
                    column,
                    value: a + t * b,
                    size: a.abs() + (t * b).abs(),
                });
                of_t.value += b * x[column];
                of_t.size += (b * x[column]).abs();
            }
            row.push(of_t);
            out.push(row);
        }

        let in_sum = |k: &usize| self.in_support[self.active[*k]];
        out.push(
            (0..last)
                .filter(in_sum)
                .map(|column| Slope {
                    column,
                    value: 1.0,
                    size: 1.0,
                })
                .collect(),
        );
        out
    }

    /// |B| on the active block, row by row (position, modulus), the rows divided as those of F'.
    pub(super) fn moduli_of_b(&self) -> Vec<Vec<(usize, f64)>> {
        let of_row = |(i, index): (usize, &usize)| {
            let entries = self.active_entries(*index).filter(|(_, _, b)| !b.is_zero());
            entries
                .map(|(k, _, b)| (k, scaled(b, self.scales[i]).abs()))
                .collect()
        };
        self.active.iter().enumerate().map(of_row).collect()
    }

    /// The inverse of F'(z), whose rows are divided by their powers of two; `None` where it is
    /// singular in doubles.
    pub(in crate::certify) fn inverse(&self, point: &Point) -> Option<Vec<Vec<f64>>> {
        let n = self.active.len() + 1;
        let mut dense = vec![vec![0.0; n]; n];
        for (row, entries) in dense.iter_mut().zip(self.jacobian(point)) {
            entries.iter().for_each(|e| row[e.column] += e.value);
        }
        equilibrated_inverse(&dense, to_f64(&point.value(n - 1)).abs())
    }

    /// F(z) in units of 2^-(x_bits + t_bits).
    fn residual(&self, point: &Point) -> Vec<Integer> {
        let row = |&index: &usize| -> Integer {
            self.active_entries(index)
                .map(|(k, a, b)| point.entry(a, b) * &point.x[k])
                .sum()
        };
        let mut out: Vec<Integer> = self.active.iter().map(row).collect();

        let in_sum = self
            .active
            .iter()
            .zip(&point.x)
            .filter(|(i, _)| self.in_support[**i]);
        let sum: Integer = in_sum.map(|(_, x)| x).sum();
        out.push((sum - (Integer::one() << point.x_bits)) << point.t_bits);
        out
    }

    /// F(z), rows divided by their powers of two, as doubles of order one times 2^`exponent`.
    pub(super) fn scaled_residual(&self, point: &Point) -> ScaledResidual {
        let residual = self.residual(point);
        let bits = |(f, scale): (&Integer, &u64)| {
            if f.is_zero() {
                i64::MIN
            } else {
                f.bits() as i64 - *scale as i64
            }
        };
        let largest = residual
            .iter()
            .zip(&self.scales)
            .map(bits)
            .max()
            .unwrap_or(i64::MIN);
        if largest == i64::MIN {
            return ScaledResidual {
                f: vec![0.0; residual.len()],
                exponent: 0,
            };
        }

        let double =
            |(f, scale): (&Integer, &u64)| to_f64(&times_power(f, -(largest + *scale as i64)));
        let f = residual.iter().zip(&self.scales).map(double).collect();
        let units = (point.x_bits + point.t_bits) as i64;
        ScaledResidual {
            f,
            exponent: largest - units,
        }
    }

    /// Newton's method with a fixed inverse, until a step moves no component by more than a unit of
    /// its grid, or until the steps grow: then there is no solution near, which the caller sees by
    /// where the point is.
    pub(in crate::certify) fn polish(&self, point: &mut Point, inverse: &[Vec<f64>]) {
        let mut longest_allowed = None;
        for _ in 0..NEWTON_STEPS {
            let residual = self.scaled_residual(point);
            let steps: Vec<Integer> = (0..=self.active.len())
                .map(|k| residual.step(&inverse[k], point.bits(k)))
                .collect();

            let bits = largest_bits(&steps);
            let is_still = bits <= 1;
            let diverges = bits > *longest_allowed.get_or_insert(bits + GROWTH_BITS);
            let (of_t, of_x) = (&steps[self.active.len()], &steps[..self.active.len()]);
            point.x.iter_mut().zip(of_x).for_each(|(x, s)| *x -= s);
            point.t -= of_t;
            if is_still || diverges {
                break;
            }
        }
    }
}

/// F = f 2^exponent.
pub(super) struct ScaledResidual {
    pub(super) f: Vec<f64>,
    pub(super) exponent: i64,
}

impl ScaledResidual {
    /// A row of the inverse times F, rounded to units of 2^-bits; zero where it is no finite
    /// number.
    fn step(&self, row: &[f64], bits: u64) -> Integer {
        let product: f64 = row.iter().zip(&self.f).map(|(y, f)| y * f).sum();
        let Ok(exact) = from_f64(product) else {
            return Integer::zero();
        };
        let shift = self.exponent + bits as i64;
        let power = Rational::from_integer(Integer::one() << shift.unsigned_abs());
        let units = if shift < 0 {
            exact / power
        } else {
            exact * power
        };
        units.round().to_integer()
    }
}

/// Bits of the longest number.
fn largest_bits(steps: &[Integer]) -> u64 {
    steps.iter().map(Integer::bits).max().unwrap_or(0)
}

/// v 2^power.
fn times_power(v: &Integer, power: i64) -> Rational {
    let shift = power.unsigned_abs();
    if power < 0 {
        Rational::new_raw(v.clone(), Integer::one() << shift)
    } else {
        Rational::from_integer(v << shift)
    }
}

/// v 2^-scale.
fn scaled(v: &Integer, scale: u64) -> f64 {
    to_f64(&times_power(v, -(scale as i64)))
}

/// Least e with |v| < 2^e; 0 for what counts as zero.
fn binary_exponent(v: f64) -> i32 {
    let exponent = v.abs().log2().floor();
    if exponent.is_finite() && exponent >= f64::from(LEAST_EXPONENT) {
        exponent as i32 + 1
    } else {
        0
    }
}

/// The inverse of a Jacobian, by way of one whose rows and last column are of order one: rows with
/// cleared denominators and a value like lambda^2 are many powers of ten away from e'x_s and x.
fn equilibrated_inverse(jacobian: &[Vec<f64>], value: f64) -> Option<Vec<Vec<f64>>> {
    let n = jacobian.len();
    let column = |j: usize| {
        if j + 1 == n && value > 0.0 {
            value
        } else {
            1.0
        }
    };
    let largest = |row: &Vec<f64>| {
        row.iter()
            .enumerate()
            .map(|(j, v)| v.abs() * column(j))
            .fold(0.0, f64::max)
    };
    let sizes: Vec<f64> = jacobian.iter().map(largest).collect();

    let mut even = jacobian.to_vec();
    for (row, size) in even.iter_mut().zip(&sizes) {
        row.iter_mut()
            .enumerate()
            .for_each(|(j, v)| *v *= column(j) / size);
    }

    let mut y = inverse(&even)?;
    for (j, row) in y.iter_mut().enumerate() {
        row.iter_mut()
            .zip(&sizes)
            .for_each(|(v, s)| *v *= column(j) / s);
    }
    y.iter().flatten().all(|v| v.is_finite()).then_some(y)
}

/// A rational with a power of two as denominator.
pub(super) fn dyadic(numerator: Integer, bits: u64) -> Rational {
    Rational::new(numerator, Integer::from(1) << bits)
}
