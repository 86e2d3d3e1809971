//! Newton's method with exact residuals for the null vector of the active block.
//!
//! Unknowns: z = (x on the active variables, t). Equations:
//!
//! ```text
//! F(z) = ( (A + tB) x on the active rows,  e'x_s - 1 ) = 0
//! ```
//!
//! A step is z <- z - Y F(z). The inverse Y of F' is taken in doubles once; F is computed in
//! integers, so each step gains the digits that Y is good for, on a grid of any fineness.
//!
//! Exact pencils may have rows of thousands of bits, so each row is divided by a power of two
//! before it becomes doubles ([`Newton::scales`]). Called by `enclose` and by `precise`.

use super::super::failure::AttemptFailure;
use super::super::rows::{IntegralRows, PencilEntry, active};
use crate::candidate::Candidate;
use crate::magnitude::in_units;
use mceip_exact::{Integer, Rational, from_f64, to_f64};
use mceip_mcp::linear::inverse;
use mceip_model::Pencil;
use num_traits::{One, Signed, Zero};

/// Newton steps on one grid, at most. Each gains 20 bits or more, and a finer grid has at most 256
/// bits more.
const NEWTON_STEPS: usize = 16;
/// Bits by which a step may be longer than the first one. Basis: with one inverse for all steps
/// each is a fraction of the previous one where the method converges; steps that grow do not
/// converge, and the numbers grow with them.
const GROWTH_BITS: u64 = 8;
/// Bits of a coefficient that a double takes without any thought of overflow.
const SAFE_BITS: u64 = 500;
/// Least binary exponent of a value that counts as its scale; below it a value is taken for zero.
const LEAST_EXPONENT: i32 = -500;

/// A point on a grid: x in units of 2^-`x_bits`, t in units of 2^-`t_bits`.
#[derive(Debug, Clone)]
pub(in crate::certify) struct NewtonPoint {
    pub(in crate::certify) x: Vec<Integer>,
    pub(in crate::certify) t: Integer,
    pub(in crate::certify) x_bits: u64,
    pub(in crate::certify) t_bits: u64,
}

impl NewtonPoint {
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
    pub(in crate::certify) fn coefficient(&self, entry: &ActiveEntry<'_>) -> Integer {
        (entry.a << self.t_bits) + entry.b * &self.t
    }

    /// The same point on a grid with so many more bits.
    pub(in crate::certify) fn refine(&mut self, more: u32) {
        for component in &mut self.x {
            *component <<= more;
        }

        self.t <<= more;
        self.x_bits += u64::from(more);
        self.t_bits += u64::from(more);
    }
}

/// An entry a + t b of a row of the pencil in an active column.
pub(in crate::certify) struct ActiveEntry<'a> {
    /// Position of the column among the active variables.
    pub(in crate::certify) position: usize,
    pub(in crate::certify) a: &'a Integer,
    pub(in crate::certify) b: &'a Integer,
}

/// An entry of F' in doubles, its row divided by a power of two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    pub(super) column: usize,
    pub(super) value: f64,
    /// Sum of the moduli of the terms that it is made of.
    pub(super) size: f64,
}

/// The modulus of an entry of B in doubles, its row divided by a power of two.
#[derive(Debug, Clone, Copy)]
pub(super) struct Modulus {
    pub(super) column: usize,
    pub(super) value: f64,
}

/// The square system F(z) = 0 of an enclosed solution.
pub(in crate::certify) struct Newton<'a> {
    rows: &'a IntegralRows,
    pub(in crate::certify) active: Vec<usize>,
    /// Position of each variable among the active ones.
    place: Vec<Option<usize>>,
    in_support: Vec<bool>,
    /// Each active row, and the last one, is divided by two to this power before it becomes
    /// doubles.
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
        for (position, &index) in active.iter().enumerate() {
            place[index] = Some(position);
        }

        let mut in_support = vec![false; pencil.order()];
        for &index in support {
            in_support[index] = true;
        }

        let mut scales = Vec::new();
        for &index in &active {
            let bits = rows.row(index).iter().map(PencilEntry::bits).max();
            scales.push(bits.unwrap_or(0).saturating_sub(SAFE_BITS));
        }

        scales.push(0);

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

    /// Variables that are not active and whose rows vanish with the active ones.
    pub(in crate::certify) fn vanishing(&self) -> Vec<usize> {
        self.rows.vanishing(&self.active)
    }

    /// Variables that are not active, ascending.
    pub(in crate::certify) fn inactive(&self) -> impl Iterator<Item = usize> {
        (0..self.place.len()).filter(|&i| self.place[i].is_none())
    }

    /// The entries of a row of the pencil in the active columns.
    pub(in crate::certify) fn active_entries(
        &self,
        row: usize,
    ) -> impl Iterator<Item = ActiveEntry<'_>> {
        let entries = self.rows.row(row).iter();
        entries.filter_map(|entry| {
            Some(ActiveEntry {
                position: self.place[entry.column]?,
                a: &entry.a,
                b: &entry.b,
            })
        })
    }

    /// Row `index` of (A + tB) x, in units of 2^-(x_bits + t_bits).
    pub(in crate::certify) fn y(&self, index: usize, point: &NewtonPoint) -> Integer {
        let mut y = Integer::zero();
        for entry in self.active_entries(index) {
            let coefficient = point.coefficient(&entry);
            y += coefficient * &point.x[entry.position];
        }

        y
    }

    /// The candidate on the active variables with e'x_s = 1, then t, on a grid with `bits` bits for
    /// the largest component of x and for t.
    ///
    /// # Errors
    /// [`AttemptFailure::NotFinite`]: among them a candidate without a sum on the support.
    pub(in crate::certify) fn start(
        &self,
        candidate: &Candidate,
        bits: u32,
    ) -> Result<NewtonPoint, AttemptFailure> {
        let support = self.active.iter().filter(|i| self.in_support[**i]);
        let sum: f64 = support.map(|&i| candidate.x[i]).sum();
        let mut x = Vec::new();
        let mut largest: f64 = 0.0;
        for &i in &self.active {
            let component = candidate.x[i] / sum;
            largest = largest.max(component.abs());
            x.push(component);
        }

        // The grid of the larger one of x and t is not coarser than 1.
        let x_exponent = binary_exponent(largest);
        let t_exponent = binary_exponent(candidate.value);
        let lift = (x_exponent.max(t_exponent) - bits as i32).max(0);
        let x_bits = (bits as i32 + lift - x_exponent).unsigned_abs().into();
        let t_bits = (bits as i32 + lift - t_exponent).unsigned_abs().into();

        let mut x_on_grid = Vec::new();
        for component in x {
            x_on_grid.push(on_grid(component, x_bits)?);
        }

        Ok(NewtonPoint {
            x: x_on_grid,
            t: on_grid(candidate.value, t_bits)?,
            x_bits,
            t_bits,
        })
    }

    /// F'(z) = [[A + tB, Bx], [e_s', 0]] in doubles, row by row, as sparse rows.
    pub(super) fn jacobian(&self, point: &NewtonPoint) -> Vec<Vec<Slope>> {
        let last = self.active.len();
        let x: Vec<f64> = (0..last).map(|k| to_f64(&point.value(k))).collect();
        let t = to_f64(&point.value(last));

        let mut rows = Vec::new();
        for (&index, &scale) in self.active.iter().zip(&self.scales) {
            rows.push(self.slopes_of_row(index, scale, &x, t));
        }

        rows.push(self.slopes_of_sum());
        rows
    }

    /// The slopes of row `index` of (A + tB) x, divided by 2^scale: a + t b in x, (B x)_i in t.
    fn slopes_of_row(&self, index: usize, scale: u64, x: &[f64], t: f64) -> Vec<Slope> {
        let mut row = Vec::new();
        let mut of_t = Slope {
            column: self.active.len(),
            value: 0.0,
            size: 0.0,
        };

        for entry in self.active_entries(index) {
            let a = scaled(entry.a, scale);
            let b = scaled(entry.b, scale);
            let tb = t * b;
            let bx = b * x[entry.position];

            row.push(Slope {
                column: entry.position,
                value: a + tb,
                size: a.abs() + tb.abs(),
            });
            of_t.value += bx;
            of_t.size += bx.abs();
        }

        row.push(of_t);
        row
    }

    /// The last row of F': the slopes of e'x_s.
    fn slopes_of_sum(&self) -> Vec<Slope> {
        let mut row = Vec::new();
        for (column, &index) in self.active.iter().enumerate() {
            if self.in_support[index] {
                row.push(Slope {
                    column,
                    value: 1.0,
                    size: 1.0,
                });
            }
        }

        row
    }

    /// |B| on the active block, as sparse rows, divided as those of F'.
    pub(super) fn moduli_of_b(&self) -> Vec<Vec<Modulus>> {
        let mut rows = Vec::new();
        for (&index, &scale) in self.active.iter().zip(&self.scales) {
            let mut row = Vec::new();
            for entry in self.active_entries(index) {
                if !entry.b.is_zero() {
                    row.push(Modulus {
                        column: entry.position,
                        value: scaled(entry.b, scale).abs(),
                    });
                }
            }
            rows.push(row);
        }

        rows
    }

    /// The inverse of F'(z), whose rows are divided by their powers of two.
    ///
    /// # Errors
    /// [`AttemptFailure::SingularJacobian`] where F'(z) is singular in doubles.
    pub(in crate::certify) fn inverse(
        &self,
        point: &NewtonPoint,
    ) -> Result<Vec<Vec<f64>>, AttemptFailure> {
        let n = self.active.len() + 1;
        let mut dense = vec![vec![0.0; n]; n];
        for (row, slopes) in dense.iter_mut().zip(self.jacobian(point)) {
            for slope in slopes {
                row[slope.column] += slope.value;
            }
        }

        let t = to_f64(&point.value(n - 1));
        let inverse = equilibrated_inverse(&dense, t.abs());
        inverse.ok_or(AttemptFailure::SingularJacobian)
    }

    /// F(z) in units of 2^-(x_bits + t_bits).
    fn residual(&self, point: &NewtonPoint) -> Vec<Integer> {
        let mut residual = Vec::new();
        let mut sum = Integer::zero();
        for (&index, x) in self.active.iter().zip(&point.x) {
            residual.push(self.y(index, point));
            if self.in_support[index] {
                sum += x;
            }
        }

        let one = Integer::one() << point.x_bits;
        residual.push((sum - one) << point.t_bits);
        residual
    }

    /// F(z), rows divided by their powers of two, as doubles of order one times a power of two.
    pub(super) fn scaled_residual(&self, point: &NewtonPoint) -> ScaledResidual {
        let residual = self.residual(point);
        let mut largest: Option<i64> = None;
        for (f, &scale) in residual.iter().zip(&self.scales) {
            if !f.is_zero() {
                largest = largest.max(Some(f.bits() as i64 - scale as i64));
            }
        }

        let Some(largest) = largest else {
            return ScaledResidual {
                f: vec![0.0; residual.len()],
                exponent: 0,
            };
        };

        let mut doubles = Vec::new();
        for (f, &scale) in residual.iter().zip(&self.scales) {
            let power = -(largest + scale as i64);
            doubles.push(to_f64(&times_power(f, power)));
        }

        let unit_bits = (point.x_bits + point.t_bits) as i64;
        ScaledResidual {
            f: doubles,
            exponent: largest - unit_bits,
        }
    }

    /// Newton's method with a fixed inverse, until a step moves no component by more than a unit of
    /// its grid, or until the steps grow: then there is no solution near, which the caller sees by
    /// where the point is.
    pub(in crate::certify) fn polish(&self, point: &mut NewtonPoint, inverse: &[Vec<f64>]) {
        let last = self.active.len();
        let mut longest_allowed = None;
        for _ in 0..NEWTON_STEPS {
            let residual = self.scaled_residual(point);
            let mut step = Vec::new();
            for (k, row) in inverse.iter().enumerate() {
                step.push(residual.step(row, point.bits(k)));
            }
            let bits = largest_bits(&step);
            let is_still = bits <= 1;
            let diverges = bits > *longest_allowed.get_or_insert(bits + GROWTH_BITS);

            for (component, change) in point.x.iter_mut().zip(&step) {
                *component -= change;
            }
            point.t -= &step[last];
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
        match from_f64(product) {
            Ok(exact) => in_units(&exact, self.exponent + bits as i64),
            Err(_) => Integer::zero(),
        }
    }
}

/// A double in units of 2^-bits, rounded.
fn on_grid(v: f64, bits: u64) -> Result<Integer, AttemptFailure> {
    let exact = from_f64(v).map_err(|_| AttemptFailure::NotFinite)?;
    Ok(in_units(&exact, bits as i64))
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
pub(super) fn scaled(v: &Integer, scale: u64) -> f64 {
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

/// The inverse of a Jacobian J: J^-1 = C (R J C)^-1 R, where the entries of R J C are of order one.
///
/// Rows with cleared denominators and a value like lambda^2 are many powers of ten away from e'x_s
/// and x. So C multiplies the last column by the value, and R divides each row by its largest
/// entry. `None` where R J C is singular in doubles, or an entry of the inverse is not finite.
fn equilibrated_inverse(jacobian: &[Vec<f64>], value: f64) -> Option<Vec<Vec<f64>>> {
    let mut column_factors = vec![1.0; jacobian.len()];
    if let Some(last) = column_factors.last_mut().filter(|_| value > 0.0) {
        *last = value;
    }

    let row_sizes = row_sizes(jacobian, &column_factors);

    let mut equilibrated = jacobian.to_vec();
    for (row, size) in equilibrated.iter_mut().zip(&row_sizes) {
        for (entry, factor) in row.iter_mut().zip(&column_factors) {
            *entry *= factor / size;
        }
    }

    let mut inverse = inverse(&equilibrated)?;
    for (row, factor) in inverse.iter_mut().zip(&column_factors) {
        for (entry, size) in row.iter_mut().zip(&row_sizes) {
            *entry *= factor / size;
        }
    }

    let mut entries = inverse.iter().flatten();
    let is_finite = entries.all(|entry| entry.is_finite());
    is_finite.then_some(inverse)
}

/// The largest entry of each row, each entry times the factor of its column.
fn row_sizes(matrix: &[Vec<f64>], column_factors: &[f64]) -> Vec<f64> {
    let mut sizes = Vec::new();
    for row in matrix {
        let mut size: f64 = 0.0;
        for (entry, factor) in row.iter().zip(column_factors) {
            size = size.max(entry.abs() * factor);
        }
        sizes.push(size);
    }

    sizes
}

/// A rational with a power of two as denominator.
pub(super) fn dyadic(numerator: Integer, bits: u64) -> Rational {
    Rational::new(numerator, Integer::from(1) << bits)
}
