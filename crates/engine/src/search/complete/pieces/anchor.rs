//! Anchors of a condensation: centres along the unknown, and the elimination about each of them.
//!
//! About a centre c, with d = t - c, the Taylor polynomials W(d) of F^-1 T_fs and V(d) of
//! (F^-1)'T_sf' are computed in doubles and rounded to integers over a power of two. With the
//! residuals r = T_fs - F W and l = T_sf' - F'V the condensed pencil is
//!
//! ```text
//!     T_ss - T_sf F^-1 T_fs = (T_ss - T_sf W - V'r) - l' F^-1 r,
//! ```
//!
//! a polynomial and a remainder that is small twice over (see `check::cover::condensed`). The
//! coefficients of W follow from F_c W_k = [k = 0] T_fs(c) + [k = 1] B_fs - B_ff W_(k-1).
//!
//! The symmetric part of F has to be positive definite. Called by `condense`, `reverse` and
//! `precise_anchor`.

use super::blocks::{FreeEquations, FreeFactor, PencilBlocks};
use super::expansion::{ColumnNorms, Expansion};
use super::matrix::{SquareMatrix, zeros};
use super::skyline::{dot, nonzero, sparse_dot};
use super::view::row_factor;
use crate::search::complete::dyadic::multiple_near;
use crate::search::complete::rounding::integer;
use mceip_check::certificate::{Anchor, IntegerMatrix, IntegerRow};
use mceip_exact::{Integer, Rational, to_f64};
use mceip_model::Pencil;
use mceip_model::file::Number;
use num_traits::ToPrimitive;
use std::sync::Arc;

/// How an anchor is expanded: degree of W and V, and the bits of their largest entries. What W's
/// rounding costs enters to first order (times V), what the degree leaves out enters squared.
#[derive(Clone, Copy)]
pub(crate) struct Precision {
    degree: usize,
    right_bits: i32,
    left_bits: i32,
}

/// F does not depend on the unknown: W is a constant.
pub(crate) const CONSTANT: Precision = Precision {
    degree: 0,
    right_bits: 56,
    left_bits: 24,
};

/// For regions far from solutions: the margins of their witnesses are wide.
pub(crate) const COARSE: Precision = Precision {
    degree: 2,
    right_bits: 36,
    left_bits: 24,
};

/// About a solution, used within [`NEAR`] of it.
pub(crate) const FINE: Precision = Precision {
    degree: 2,
    right_bits: 56,
    left_bits: 30,
};

/// The precisions of the anchors of one search.
#[derive(Clone, Copy)]
pub(crate) struct Precisions {
    pub(crate) coarse: Precision,
    /// Of the reversed anchor.
    pub(crate) beyond: Precision,
    pub(crate) fine: Precision,
}

/// Of a window of the unknown.
pub(crate) const OF_WINDOW: Precisions = Precisions {
    coarse: COARSE,
    beyond: COARSE,
    fine: FINE,
};

/// Of a window that stays open with [`OF_WINDOW`]: where F changes much between two anchors, as the
/// linear form of a quadratic pencil does, the remainder of degree 2 hides the signs of narrow
/// margins. Each further degree leaves a tenth of it.
pub(crate) const CLOSER: Precisions = Precisions {
    coarse: CLOSE,
    beyond: CLOSE,
    fine: FINE,
};

/// The largest degree that the checker takes.
const CLOSE: Precision = Precision {
    degree: 7,
    right_bits: 60,
    left_bits: 40,
};

/// Of a family that is searched in the unknown and in the friction at once. The margins of its
/// witnesses are narrow, the narrower the more variables slip: the remainder of degree 2 (some 1e-4
/// of an entry at the end of an interval) multiplies the boxes of 25 slip particles by twenty.
/// Degree 3 leaves 1e-6 there, and so many bits 1e-8 beside the centre.
pub(crate) const OF_FAMILY: Precisions = Precisions {
    coarse: Precision {
        degree: 3,
        right_bits: 34,
        left_bits: 20,
    },
    beyond: COARSE,
    fine: Precision {
        degree: 3,
        right_bits: 56,
        left_bits: 30,
    },
};

/// Distance from a solution up to which its own anchor is used, relative to value + lowest
/// frequency.
pub(crate) const NEAR: f64 = 0.03;

/// Bits that each degree needs less.
const BITS_PER_DEGREE: i32 = 2;

/// Distance from a centre up to which it is used, relative to center + smallest eigenvalue of
/// (K_ff, M_ff).
const REACH: f64 = 0.3;

/// How far a centre may be moved to make it a short number, relative to its reach. The checker
/// computes with powers of the distance from it.
const SLACK_OF_CENTER: f64 = 0.01;

/// Anchors at most: beyond that the window is left open above.
const MAX_ANCHORS: usize = 64;

/// An integer in units of 2^-this, or of a larger power of two, is a normal double.
const MAX_EXACT_EXPONENT: u32 = 1_000;

/// Largest binary exponent of a rounded matrix.
pub(crate) const MAX_EXPONENT: i32 = 900;

/// A centre, and the value up to which it is used.
pub(crate) struct Center {
    pub(crate) at: Rational,
    pub(crate) end: f64,
}

/// Centres that cover [low, top], at least one; one for a pencil whose F does not depend on t
/// (`lowest_frequency` zero).
pub(crate) fn centers(lowest_frequency: f64, mut low: f64, top: f64) -> Vec<Center> {
    if lowest_frequency == 0.0 {
        return vec![Center {
            at: Rational::from_integer(0.into()),
            end: f64::INFINITY,
        }];
    }

    let mut centers = Vec::new();
    while centers.is_empty() || (low < top && centers.len() < MAX_ANCHORS) {
        // center - low = REACH (center + lowest frequency), end - center likewise.
        let center = (low + REACH * lowest_frequency) / (1.0 - REACH);
        let reach = REACH * (center + lowest_frequency);
        let end = center + reach;
        centers.push(Center {
            at: short_center(center, reach),
            end,
        });
        low = end;
    }

    centers
}

/// The centre of an interval that ends here, with this `reach` relative to center + lowest
/// frequency.
pub(crate) fn center_below(end: f64, lowest_frequency: f64, reach: f64) -> Center {
    // end - center = reach (center + lowest frequency).
    let center = ((end - reach * lowest_frequency) / (1.0 + reach)).max(0.0);

    Center {
        at: short_center(center, reach * (center + lowest_frequency)),
        end,
    }
}

/// A short number next to a centre with this reach.
fn short_center(center: f64, reach: f64) -> Rational {
    multiple_near(center, SLACK_OF_CENTER * reach).unwrap_or_default()
}

/// A_ff >= sigma I and B_ff >= tau I, as the certificate proves it.
#[derive(Clone, Copy)]
pub(crate) struct SpectrumBounds {
    pub(crate) sigma: f64,
    pub(crate) tau: f64,
}

impl SpectrumBounds {
    /// Those of the pencil with its matrices exchanged.
    pub(crate) fn exchanged(self) -> SpectrumBounds {
        SpectrumBounds {
            sigma: self.tau,
            tau: self.sigma,
        }
    }
}

/// An anchor of the certificate, and the condensed pencil in doubles that it gives.
pub(crate) struct ExpandedAnchor {
    pub(crate) anchor: Anchor,
    pub(crate) expansion: Expansion,
}

/// V of another pencil beside the W of an anchor, and the condensed pencil that both give.
pub(crate) struct Beside {
    pub(crate) left: Vec<IntegerMatrix>,
    pub(crate) expansion: Expansion,
}

/// A matrix by columns: one per complementarity variable, over the free variables.
pub(crate) type SlipColumns = Vec<Vec<f64>>;

/// The elimination of the free variables of one pencil.
pub(crate) struct FreeElimination<'a> {
    pub(crate) pencil: &'a Pencil,
    pub(crate) blocks: PencilBlocks,
    pub(crate) bounds: SpectrumBounds,
}

impl<'a> FreeElimination<'a> {
    pub(crate) fn new(pencil: &'a Pencil, bounds: SpectrumBounds) -> FreeElimination<'a> {
        FreeElimination {
            pencil,
            blocks: PencilBlocks::of(pencil),
            bounds,
        }
    }

    /// The Taylor polynomials about a centre, rounded, and the condensed pencil they give; `None`
    /// where F is not definite in doubles.
    pub(crate) fn expand(&self, center: &Rational, precision: Precision) -> Option<ExpandedAnchor> {
        let at = to_f64(center);
        let solution = CenterSolver::about(&self.blocks, at)?;
        let right = solution.taylor(&self.blocks.right, precision.degree, precision.right_bits);
        let left = solution.taylor(&self.blocks.left, precision.degree, precision.left_bits);

        let expansion = self.expansion(at, &right.rounded, &left.rounded);
        let anchor = Anchor {
            center: Number(center.clone()),
            reversed: false,
            right: right.integers,
            left: left.integers,
        };

        Some(ExpandedAnchor { anchor, expansion })
    }

    /// V alone about the centre of an anchor of a pencil with the same free rows: of the degree of
    /// its W, with as many bits as its V. `None` where F is not definite in doubles.
    pub(crate) fn expand_beside(&self, anchor: &Anchor) -> Option<Beside> {
        let at = to_f64(&anchor.center.0);
        let solution = CenterSolver::about(&self.blocks, at)?;
        let degree = anchor.right.len().saturating_sub(1);
        let bits = bits_of(&anchor.left).max(OF_FAMILY.coarse.left_bits);
        let left = solution.taylor(&self.blocks.left, degree, bits);
        let right = columns_of_all(&anchor.right, self.blocks.slip.len());
        let expansion = self.expansion(at, &right, &left.rounded);
        Some(Beside {
            left: left.integers,
            expansion,
        })
    }

    /// The condensed pencil about a centre and the norms of the residuals, as the checker will
    /// compute them. `right` and `left` are the coefficients of W and V.
    pub(crate) fn expansion(
        &self,
        center: f64,
        right: &[SlipColumns],
        left: &[SlipColumns],
    ) -> Expansion {
        let blocks = &self.blocks;
        let order = blocks.slip.len();
        let right_residual = residual(&blocks.right, center, right);
        let left_residual = residual(&blocks.left, center, left);
        let row_factors: Vec<f64> = blocks
            .slip
            .iter()
            .map(|&i| to_f64(&row_factor(self.pencil, i)))
            .collect();

        let condensed = CondensedPolynomial {
            pencil: self.pencil,
            blocks,
            center,
            right,
            left,
            right_residual: &right_residual,
        };

        let mut coefficients = condensed.coefficients(&row_factors);
        // What is zero but for rounding is zero in exact arithmetic: T is linear where F and the
        // free rows are constant.
        if blocks.is_linear() {
            coefficients.truncate(2);
        }

        let ones = vec![1.0; order];
        Expansion {
            center,
            coefficients,
            left_residual: column_norms(&left_residual, &row_factors),
            right_residual: column_norms(&right_residual, &ones),
            weight: vec![1.0 / self.bounds.sigma; order],
            gain: self.bounds.tau / self.bounds.sigma,
            left_solution: column_norms(left, &row_factors),
            right_rounding: column_norms(&right_residual[..right.len()], &ones),
            caution: 1.0,
            reversed: false,
            spread: None,
        }
    }
}

/// The coefficients of W or V, in doubles.
pub(crate) fn columns_of_all(coefficients: &[IntegerMatrix], width: usize) -> Vec<SlipColumns> {
    let coefficients = coefficients.iter();
    coefficients
        .map(|matrix| columns_of(matrix, width))
        .collect()
}

/// The columns of a rounded matrix, in doubles.
fn columns_of(matrix: &IntegerMatrix, width: usize) -> SlipColumns {
    let mut columns = vec![Vec::with_capacity(matrix.rows.len()); width];
    for row in matrix.rows.iter() {
        for (column, entry) in columns.iter_mut().zip(row.iter()) {
            column.push(nearest_double(&entry, matrix.exponent));
        }
    }

    columns
}

/// The double nearest to entry 2^-exponent.
fn nearest_double(entry: &Integer, exponent: u32) -> f64 {
    match entry.to_i64() {
        // Rounded once: the power of two is exact.
        Some(short) if exponent <= MAX_EXACT_EXPONENT => {
            short as f64 * f64::from(exponent).exp2().recip()
        }
        _ => to_f64(&Rational::new_raw(
            entry.clone(),
            Integer::from(1) << exponent,
        )),
    }
}

/// The bits of the largest entry of the first coefficient; 0 where there is none.
fn bits_of(coefficients: &[IntegerMatrix]) -> i32 {
    let rows = coefficients.first().into_iter().flat_map(|m| m.rows.iter());
    let largest = rows.map(IntegerRow::bits).max();
    largest
        .and_then(|bits| i32::try_from(bits).ok())
        .unwrap_or(0)
}

/// Solutions with F(center), or with its transpose.
pub(crate) struct CenterSolver<'a> {
    blocks: &'a PencilBlocks,
    factor: FreeFactor,
    center: f64,
}

/// Coefficients of a Taylor polynomial, as the certificate has them and in doubles.
#[derive(Default)]
struct Taylor {
    integers: Vec<IntegerMatrix>,
    rounded: Vec<SlipColumns>,
}

impl<'a> CenterSolver<'a> {
    /// `None` where F is not definite in doubles.
    pub(crate) fn about(blocks: &'a PencilBlocks, center: f64) -> Option<CenterSolver<'a>> {
        Some(CenterSolver {
            factor: blocks.factor_at(center)?,
            blocks,
            center,
        })
    }

    /// The Taylor coefficients of the solution of F W = C + tD, or of F'V, up to a degree, or up to
    /// its own where F is constant. `bits` are those of the first one.
    fn taylor(&self, equations: &FreeEquations, degree: usize, bits: i32) -> Taylor {
        let degree = if !self.blocks.mass_is_zero {
            degree
        } else if equations.given.is_constant() {
            0
        } else {
            1
        };

        self.coefficients(equations, degree + 1, |k, columns| {
            Rounded::of(columns, bits - BITS_PER_DEGREE * k as i32)
        })
    }

    /// The Taylor coefficients of the solution, each rounded to units of 2^-exponent.
    pub(crate) fn rounded_to(
        &self,
        equations: &FreeEquations,
        exponents: &[u32],
    ) -> Vec<IntegerMatrix> {
        let taylor = self.coefficients(equations, exponents.len(), |k, columns| {
            Rounded::to(columns, exponents[k])
        });
        taylor.integers
    }

    /// So many coefficients, each rounded before the next one is computed from it.
    fn coefficients(
        &self,
        equations: &FreeEquations,
        count: usize,
        rounded: impl Fn(usize, &SlipColumns) -> Rounded,
    ) -> Taylor {
        let mut taylor = Taylor::default();
        for k in 0..count {
            let mut columns = self.right_hand_sides(equations, k, taylor.rounded.last());
            self.factor.solve_all(&mut columns, equations.is_transposed);

            let rounded = rounded(k, &columns);
            taylor.integers.push(rounded.integers);
            taylor.rounded.push(rounded.columns);
        }

        taylor
    }

    /// [k = 0] (C + center D) + [k = 1] D - B_ff W_(k-1), by columns.
    fn right_hand_sides(
        &self,
        equations: &FreeEquations,
        k: usize,
        before: Option<&SlipColumns>,
    ) -> SlipColumns {
        let given = &equations.given;
        let slip = 0..self.blocks.slip.len();
        let mut columns: SlipColumns = match k {
            0 => slip.map(|j| given.at(j, self.center)).collect(),
            1 => given.slope.clone(),
            _ => slip.map(|_| vec![0.0; self.blocks.free.len()]).collect(),
        };

        if let Some(before) = before {
            let products = equations.mass.times_all(before);
            for (column, product) in columns.iter_mut().zip(products) {
                for (c, p) in column.iter_mut().zip(product) {
                    *c -= p;
                }
            }
        }

        columns
    }
}

/// The coefficients of C + tD - F(t) W, or of C + tD - F(t)'V, in powers of d = t - center.
fn residual(equations: &FreeEquations, center: f64, solution: &[SlipColumns]) -> Vec<SlipColumns> {
    let given = &equations.given;
    let order = given.slope.len();
    let zero: SlipColumns = given.slope.iter().map(|c| vec![0.0; c.len()]).collect();
    let mut residual = vec![zero; (solution.len() + 1).max(2)];

    for j in 0..order {
        residual[0][j] = given.at(j, center);
        residual[1][j].clone_from(&given.slope[j]);
    }

    for (k, coefficient) in solution.iter().enumerate() {
        let mass = equations.mass.times_all(coefficient);
        let stiffness = equations.stiffness.times_all(coefficient);
        for j in 0..order {
            for (i, r) in residual[k][j].iter_mut().enumerate() {
                *r -= stiffness[j][i] + center * mass[j][i];
            }

            for (i, r) in residual[k + 1][j].iter_mut().enumerate() {
                *r -= mass[j][i];
            }
        }
    }

    residual
}

/// The polynomial part of the condensed pencil, T_ss - T_sf W - V'r, in powers of d.
struct CondensedPolynomial<'a> {
    pencil: &'a Pencil,
    blocks: &'a PencilBlocks,
    center: f64,
    right: &'a [SlipColumns],
    left: &'a [SlipColumns],
    right_residual: &'a [SlipColumns],
}

impl CondensedPolynomial<'_> {
    /// The coefficients, each row times its factor.
    fn coefficients(&self, row_factors: &[f64]) -> Vec<SquareMatrix> {
        let order = self.blocks.slip.len();
        let mut coefficients = vec![zeros(order); self.degree() + 1];

        for i in 0..order {
            let [constant, slope] = [
                &self.blocks.left.given.constant,
                &self.blocks.left.given.slope,
            ];
            let row = [constant, slope].map(|rows| nonzero(&rows[i]));
            for j in 0..order {
                let entry = self.entry(i, j, &row);
                for (matrix, value) in coefficients.iter_mut().zip(entry) {
                    matrix[i][j] = value * row_factors[i];
                }
            }
        }

        coefficients
    }

    fn degree(&self) -> usize {
        let of_solution = self.right.len();
        let coefficients = self.left.len() + self.right_residual.len();
        let of_product = coefficients.saturating_sub(2);
        of_solution.max(of_product).max(1)
    }

    /// Entry (i, j) of every coefficient; of row i of T_sf the entries of both parts that are not
    /// zero are given.
    fn entry(&self, i: usize, j: usize, [constant, slope]: &[Vec<(usize, f64)>; 2]) -> Vec<f64> {
        let row = self.blocks.slip[i];
        let column = self.blocks.slip[j];
        let a = to_f64(&self.pencil.a().get(row, column));
        let b = to_f64(&self.pencil.b().get(row, column));

        // T_ss.
        let mut entry = vec![0.0; self.degree() + 1];
        entry[0] += a + self.center * b;
        entry[1] += b;

        // T_sf W.
        for (k, w) in self.right.iter().enumerate() {
            let by_constant = sparse_dot(constant, &w[j]);
            let by_slope = sparse_dot(slope, &w[j]);
            entry[k] -= by_constant + self.center * by_slope;
            entry[k + 1] -= by_slope;
        }

        // V'r. The coefficients of r up to the degree of W are rounding, bounded elsewhere.
        let first = self.right.len();
        for (k, v) in self.left.iter().enumerate() {
            for (m, r) in self.right_residual.iter().enumerate().skip(first) {
                entry[k + m] -= dot(&v[i], &r[j]);
            }
        }

        entry
    }
}

/// Euclidean norms of the columns of each coefficient, column j times factors[j].
fn column_norms(coefficients: &[SlipColumns], factors: &[f64]) -> ColumnNorms {
    let mut norms = ColumnNorms::new();
    for coefficient in coefficients {
        let of_columns = coefficient
            .iter()
            .zip(factors)
            .map(|(column, factor)| dot(column, column).sqrt() * factor);
        norms.push(of_columns.collect());
    }

    norms
}

/// A matrix rounded to integers over a power of two: by rows as the certificate has it, and by
/// columns in doubles.
pub(crate) struct Rounded {
    pub(crate) integers: IntegerMatrix,
    columns: SlipColumns,
}

impl Rounded {
    /// Rounds columns so that the largest entry has about this many bits.
    pub(crate) fn of(columns: &SlipColumns, bits: i32) -> Rounded {
        let largest = columns
            .iter()
            .flatten()
            .fold(f64::MIN_POSITIVE, |s, v| s.max(v.abs()));
        let exponent = (bits - largest.log2().ceil() as i32).clamp(0, MAX_EXPONENT);
        Rounded::to(columns, exponent.unsigned_abs())
    }

    /// Rounds columns to units of 2^-exponent.
    fn to(columns: &SlipColumns, exponent: u32) -> Rounded {
        let unit = f64::from(exponent).exp2();

        let mut rounded = SlipColumns::new();
        for column in columns {
            rounded.push(column.iter().map(|v| (v * unit).round() / unit).collect());
        }

        let row_count = columns.first().map_or(0, Vec::len);
        let mut rows = Vec::with_capacity(row_count);
        for i in 0..row_count {
            let integers = rounded.iter().map(|column| integer(column[i] * unit));
            rows.push(integers.collect());
        }

        Rounded {
            integers: IntegerMatrix {
                exponent,
                rows: Arc::new(rows),
            },
            columns: rounded,
        }
    }
}
