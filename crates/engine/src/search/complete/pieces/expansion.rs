//! The pencil on the complementarity variables about one centre, as the checker encloses it.
//!
//! With d = t - center (d = 1/t - center for a reversed expansion) entry (i, j) of T lies within
//!
//! ```text
//!     weight_i |l_i(d)| |r_j(d)| / (1 + gain t)  +  |v_i(d)| |q_j(d)|
//! ```
//!
//! of Z_ij(d) = sum_k z_k d^k. Over an interval the *ends* are Z at both ends, and the radius is
//! the distance of the chord from Z plus that remainder. All of this is computed in doubles: it
//! proposes what `check::cover::expanded` then computes exactly.
//!
//! Made by `view` (no free variables) and `anchor` (about the anchors of a condensation); read by
//! every leaf.

use super::matrix::{SquareMatrix, combined, zeros};
use crate::tolerance::CONDENSATION_NOISE;

/// Norms of the columns of a matrix polynomial: `[k][j]` is that of column j of coefficient k.
pub(crate) type ColumnNorms = Vec<Vec<f64>>;

/// T(t) about a centre: a polynomial matrix and what bounds the distance from it.
#[derive(Clone)]
pub(crate) struct Expansion {
    pub(crate) center: f64,
    /// z_k, the coefficients of the powers of d; two of them at least.
    pub(crate) coefficients: Vec<SquareMatrix>,
    /// |l_i|, the residuals of V, and |r_j|, those of W.
    pub(crate) left_residual: ColumnNorms,
    pub(crate) right_residual: ColumnNorms,
    /// Empty where there are no free variables.
    pub(crate) weight: Vec<f64>,
    /// At t the weights are divided by 1 + gain t.
    pub(crate) gain: f64,
    /// |v_i|, the norms of V, and |q_j|, what rounding W leaves in its residual.
    pub(crate) left_solution: ColumnNorms,
    pub(crate) right_rounding: ColumnNorms,
    /// Factor on the remainder, which is itself computed in doubles.
    pub(crate) caution: f64,
    /// Is this T(t) / t in powers of 1 / t - center?
    pub(crate) reversed: bool,
    /// What a member may be off, where the data have radii.
    pub(crate) spread: Option<ExpansionSpread>,
}

/// How far the matrix of a member may be from that in the middle: within constant + argument *
/// slope entry by entry, and then row i within a share of what is known of it.
#[derive(Clone)]
pub(crate) struct ExpansionSpread {
    pub(crate) constant: SquareMatrix,
    pub(crate) slope: SquareMatrix,
    pub(crate) shares: Vec<f64>,
}

impl ExpansionSpread {
    /// Adds to the radii of an end, which is the matrix at an argument, or the direction where that
    /// is infinite.
    fn add_to(&self, radius: &mut SquareMatrix, m: &SquareMatrix, argument: f64) {
        for (i, row) in radius.iter_mut().enumerate() {
            for (j, r) in row.iter_mut().enumerate() {
                let [constant, slope] = [self.constant[i][j], self.slope[i][j]];
                *r += if argument.is_infinite() {
                    slope
                } else {
                    constant + argument * slope
                };
                *r += self.shares[i] * (m[i][j].abs() + *r);
            }
        }
    }
}

/// T over an interval: the matrices at both ends, and the radius around the chord between them.
pub(crate) struct ChordEnds {
    pub(crate) lo: f64,
    /// Infinite for an unbounded interval, whose `m[1]` is the direction B.
    pub(crate) hi: f64,
    pub(crate) m: [SquareMatrix; 2],
    /// Radius of each entry at both ends; `None` where the chord is exact.
    pub(crate) r: Option<[SquareMatrix; 2]>,
    /// (hi - lo) T' lies within this of m[1] - m[0]; `None` likewise.
    pub(crate) slope: Option<SquareMatrix>,
}

impl ChordEnds {
    /// Two matrices with an exact chord.
    pub(crate) fn exact(lo: f64, hi: f64, m: [SquareMatrix; 2]) -> ChordEnds {
        ChordEnds {
            lo,
            hi,
            m,
            r: None,
            slope: None,
        }
    }

    /// The ends of T0 + mu T1, given those of T0 and T1 over one interval of t.
    pub(crate) fn at_friction([constant, slope]: [&ChordEnds; 2], friction: f64) -> ChordEnds {
        let m = [0, 1].map(|end| combined(&constant.m[end], friction, &slope.m[end]));
        let none = zeros(constant.m[0].len());
        let has_radius = constant.r.is_some() || slope.r.is_some();
        let radius = |part: &ChordEnds, end| part.radius(end).unwrap_or(&none).clone();
        let at_end = |end| combined(&radius(constant, end), friction, &radius(slope, end));
        let r = has_radius.then(|| [0, 1].map(at_end));

        ChordEnds {
            lo: constant.lo,
            hi: constant.hi,
            m,
            r,
            slope: None,
        }
    }

    /// The radii at an end, where it is not exact.
    pub(crate) fn radius(&self, end: usize) -> Option<&SquareMatrix> {
        self.r.as_ref().map(|r| &r[end])
    }

    /// Radius of entry (i, j) of (hi - lo) T' about m[1] - m[0].
    pub(crate) fn slope_radius(&self, i: usize, j: usize) -> f64 {
        match &self.slope {
            Some(radius) => radius[i][j],
            None => 0.0,
        }
    }

    pub(crate) fn is_half_line(&self) -> bool {
        self.hi.is_infinite()
    }
}

/// The remainder of an expansion over an interval, entry by entry.
struct Remainder {
    /// weight_i |l_i| / (1 + gain t) and |r_j|.
    left: Vec<f64>,
    right: Vec<f64>,
    /// |v_i| and |q_j|.
    left_solution: Vec<f64>,
    rounding: Vec<f64>,
    /// The coefficients themselves come from long sums of terms below one in doubles.
    noise: f64,
    caution: f64,
}

impl Remainder {
    fn at(&self, i: usize, j: usize) -> f64 {
        let by_residuals = self.left[i] * self.right[j];
        let by_rounding = self.left_solution[i] * self.rounding[j];
        self.caution * (by_residuals + by_rounding + self.noise)
    }
}

impl Expansion {
    /// A + tB itself.
    pub(crate) fn linear(a: SquareMatrix, b: SquareMatrix) -> Expansion {
        Expansion {
            center: 0.0,
            coefficients: vec![a, b],
            left_residual: Vec::new(),
            right_residual: Vec::new(),
            weight: Vec::new(),
            gain: 0.0,
            left_solution: Vec::new(),
            right_rounding: Vec::new(),
            caution: 1.0,
            reversed: false,
            spread: None,
        }
    }

    /// The chord between two matrices, from 0 to 1.
    pub(crate) fn line(ends: &[SquareMatrix; 2]) -> Expansion {
        let mut slope = ends[1].clone();
        for (row, first_row) in slope.iter_mut().zip(&ends[0]) {
            for (last, first) in row.iter_mut().zip(first_row) {
                *last -= first;
            }
        }

        Expansion::linear(ends[0].clone(), slope)
    }

    /// The same without its remainder and its spread: to look for solutions, not to prove anything.
    pub(crate) fn without_remainder(&self) -> Expansion {
        Expansion {
            left_residual: Vec::new(),
            right_residual: Vec::new(),
            left_solution: Vec::new(),
            right_rounding: Vec::new(),
            spread: None,
            ..self.clone()
        }
    }

    /// The same with row i of the pencil multiplied by `factors[i]`.
    pub(crate) fn with_rows_times(mut self, factors: &[f64]) -> Expansion {
        for coefficient in &mut self.coefficients {
            for (row, factor) in coefficient.iter_mut().zip(factors) {
                row.iter_mut().for_each(|entry| *entry *= factor);
            }
        }

        for norms in self.left_residual.iter_mut().chain(&mut self.left_solution) {
            for (norm, factor) in norms.iter_mut().zip(factors) {
                *norm *= factor;
            }
        }

        self
    }

    /// Is this the pencil itself, valid for every value?
    pub(crate) fn is_everywhere(&self) -> bool {
        self.weight.is_empty()
    }

    /// Is the polynomial of degree one at most?
    pub(crate) fn is_linear(&self) -> bool {
        self.coefficients.len() <= 2
    }

    pub(crate) fn order(&self) -> usize {
        self.coefficients[0].len()
    }

    /// The variable of the expansion: the value, or its reciprocal.
    fn argument(&self, t: f64) -> f64 {
        if self.reversed { 1.0 / t } else { t }
    }

    /// T(t), the remainder left out.
    pub(crate) fn at(&self, t: f64) -> SquareMatrix {
        self.polynomial(self.argument(t))
    }

    /// Z at an argument, by Horner's rule.
    fn polynomial(&self, argument: f64) -> SquareMatrix {
        let d = argument - self.center;
        let mut sum = zeros(self.order());

        for coefficient in self.coefficients.iter().rev() {
            let entries = coefficient.iter().flatten();
            for (s, z) in sum.iter_mut().flatten().zip(entries) {
                *s = *s * d + z;
            }
        }

        sum
    }

    /// dT/dt, the remainder left out.
    pub(crate) fn derivative(&self, t: f64) -> SquareMatrix {
        let d = self.argument(t) - self.center;
        let mut sum = zeros(self.order());

        for k in (1..self.coefficients.len()).rev() {
            let factor = k as f64;
            let entries = self.coefficients[k].iter().flatten();
            for (s, z) in sum.iter_mut().flatten().zip(entries) {
                *s = *s * d + factor * z;
            }
        }

        let argument_slope = if self.reversed { -1.0 / (t * t) } else { 1.0 };
        sum.iter_mut().flatten().for_each(|s| *s *= argument_slope);
        sum
    }

    /// The ends over [lo, hi] as the checker will see them.
    pub(crate) fn ends(&self, lo: f64, hi: f64) -> ChordEnds {
        if !self.reversed {
            return self.between(lo, hi);
        }

        let ends = self.between(1.0 / hi, 1.0 / lo);
        let [at_hi, at_lo] = ends.m;
        ChordEnds {
            lo,
            hi,
            m: [at_lo, at_hi],
            r: ends.r.map(|[at_hi, at_lo]| [at_lo, at_hi]),
            ..ends
        }
    }

    /// The ends over an interval of the argument, with the spread.
    fn between(&self, lo: f64, hi: f64) -> ChordEnds {
        let mut ends = self.between_without_spread(lo, hi);
        let Some(spread) = &self.spread else {
            return ends;
        };

        let none = || zeros(self.order());
        let mut r = ends.r.unwrap_or_else(|| [none(), none()]);
        for (end, argument) in [lo, hi].into_iter().enumerate() {
            spread.add_to(&mut r[end], &ends.m[end], argument);
        }
        ends.r = Some(r);
        ends
    }

    fn between_without_spread(&self, lo: f64, hi: f64) -> ChordEnds {
        let lower = self.polynomial(lo);
        if hi.is_infinite() {
            return ChordEnds::exact(lo, hi, [lower, self.coefficients[1].clone()]);
        }

        let upper = if lo == hi {
            lower.clone()
        } else {
            self.polynomial(hi)
        };

        let m = [lower, upper];
        if self.is_linear() && self.weight.is_empty() {
            return ChordEnds::exact(lo, hi, m);
        }

        let bend = self.bend(lo, hi);
        let remainder = self.remainder(lo, hi, &m);
        let mut radius = zeros(self.order());
        let mut slope = zeros(self.order());
        for i in 0..self.order() {
            for j in 0..self.order() {
                // The remainder's slope is at most a few times remainder / width where it matters;
                // the exact check decides.
                radius[i][j] = bend[i][j] / 8.0 + remainder.at(i, j);
                slope[i][j] = bend[i][j] + 4.0 * remainder.at(i, j);
            }
        }

        ChordEnds {
            lo,
            hi,
            m,
            r: Some([radius.clone(), radius]),
            slope: Some(slope),
        }
    }

    /// Largest distance of the interval from the centre.
    fn reach(&self, lo: f64, hi: f64) -> f64 {
        let below = (lo - self.center).abs();
        let above = (hi - self.center).abs();
        below.max(above)
    }

    /// Upper bounds of (hi - lo)^2 |Z''|. The chord differs from Z by an eighth of it at most.
    fn bend(&self, lo: f64, hi: f64) -> SquareMatrix {
        let reach = self.reach(lo, hi);
        let width = hi - lo;
        let mut bound = zeros(self.order());

        for k in (2..self.coefficients.len()).rev() {
            let factor = (k * (k - 1)) as f64;
            let entries = self.coefficients[k].iter().flatten();
            for (s, z) in bound.iter_mut().flatten().zip(entries) {
                *s = *s * reach + factor * z.abs() * width * width;
            }
        }

        bound
    }

    fn remainder(&self, lo: f64, hi: f64, m: &[SquareMatrix; 2]) -> Remainder {
        let reach = self.reach(lo, hi);
        let positions = 0..self.order();
        let size: f64 = m
            .iter()
            .flatten()
            .flatten()
            .fold(1.0, |largest, v| largest.max(v.abs()));

        let mut left = Vec::new();
        for i in positions.clone() {
            let residual = norm_bound(&self.left_residual, i, reach);
            left.push(residual * self.weight[i] / (1.0 + self.gain * lo));
        }

        Remainder {
            left,
            right: norm_bounds(&self.right_residual, positions.clone(), reach),
            left_solution: norm_bounds(&self.left_solution, positions.clone(), reach),
            rounding: norm_bounds(&self.right_rounding, positions, reach),
            noise: CONDENSATION_NOISE * size,
            caution: self.caution,
        }
    }
}

fn norm_bounds(norms: &ColumnNorms, positions: std::ops::Range<usize>, reach: f64) -> Vec<f64> {
    positions.map(|i| norm_bound(norms, i, reach)).collect()
}

/// Upper bound of the norm of column i of a matrix polynomial for |d| <= reach.
fn norm_bound(norms: &ColumnNorms, i: usize, reach: f64) -> f64 {
    norms
        .iter()
        .rev()
        .fold(0.0, |sum, coefficient| sum * reach + coefficient[i])
}
