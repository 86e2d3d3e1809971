//! Is a box empty? Doubles look for a reason, integers decide whether it is one.
//!
//! With T the condensed matrix, a solution in the box has x >= 0 not zero, x_j = 0 where the state
//! says at rest, y = T x >= 0, and y_i = 0 where it says moving. There is none if at all four
//! corners of the box, up to the radius,
//!
//! - a Farkas vector w has w'T < 0 in every column that may move, and w_i >= 0 in every row that is
//!   not moving: then 0 <= w'y = w'T x < 0, or
//! - the symmetric part of T on the variables that may move is positive (negative) definite: then 0
//!   = x'y = x'T x > 0 (< 0).
//!
//! Input: the four corners of a box ([`Strip`]) and the states. Output: [`Verdict`]. Called by the
//! cover in `mod.rs`.

use super::strip::Strip;
use crate::dense::has_pivots_above;
use crate::search::complete::game;
use crate::tolerance::{DEFINITE_PIVOT, WITNESS_MARGIN};
use mceip_exact::{Rational, Sparse, positive_definite};

/// State of a slip variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum State {
    /// Not decided.
    Open,
    /// x_i = 0.
    AtRest,
    /// x_i > 0, y_i = 0.
    Moving,
}

/// What to do with a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Proved to hold no solution.
    Empty,
    /// Decide this variable.
    Branch(usize),
    /// Halve it, along m or s; `hopeful` if its middle can be proved empty.
    Split {
        /// Along m rather than s.
        along_m: bool,
        /// Can the middle be proved empty?
        hopeful: bool,
    },
}

/// The condensed family at the four corners of a box, in integers times 2^m_level, and its radius.
pub(super) struct Corners {
    /// Order of the matrices, which are stored row by row.
    n: usize,
    /// (s0, m0), (s1, m0), (s0, m1), (s1, m1).
    at: [Vec<i128>; 4],
    /// At m0 and m1.
    radius: [Vec<i128>; 2],
}

/// Bits of a Farkas vector's largest weight.
const WEIGHT_BITS: f64 = 24.0;

impl Corners {
    /// The corners of the box of a strip from m to m + 1, in units of 2^-m_level.
    pub(super) fn new(strip: &Strip, m: u64, m_level: u32) -> Corners {
        let lower = Weights::at(m, m_level);
        let upper = Weights::at(m + 1, m_level);
        let [[zero_0, zero_1], [one_0, one_1]] = &strip.z;
        let at = [
            lower.mix(zero_0, one_0),
            lower.mix(zero_1, one_1),
            upper.mix(zero_0, one_0),
            upper.mix(zero_1, one_1),
        ];

        let [radius_0, radius_1] = &strip.radius;
        Corners {
            n: at[0].len().isqrt(),
            at,
            radius: [lower.mix(radius_0, radius_1), upper.mix(radius_0, radius_1)],
        }
    }

    /// What to do with the box.
    pub(super) fn judge(&self, states: &[State]) -> Verdict {
        let may_move: Vec<usize> = (0..self.n)
            .filter(|&j| states[j] != State::AtRest)
            .collect();
        if may_move.is_empty() {
            return Verdict::Empty; // x_s = 0, and then x_f = 0
        }

        let corners = self.at.each_ref().map(|corner| self.in_doubles(corner));
        // Rows of any sign: those of y_i = 0.
        let is_free_row: Vec<bool> = states.iter().map(|s| *s == State::Moving).collect();

        let mut columns = Vec::new();
        for corner in &corners {
            columns.extend(self.columns(corner, &may_move));
        }

        let farkas = game::solve(&is_free_row, &columns);
        if farkas.value > WITNESS_MARGIN && self.is_farkas(&rounded(&farkas.w), &may_move, states) {
            return Verdict::Empty;
        }

        for sign in [1, -1] {
            let seems_definite = corners
                .iter()
                .all(|corner| self.seems_definite(corner, &may_move, sign));
            if seems_definite && self.is_definite(&may_move, sign) {
                return Verdict::Empty;
            }
        }

        // Nothing holds at all four corners. Could it in the middle?
        let middle = mean(&corners);
        let in_middle = game::solve(&is_free_row, &self.columns(&middle, &may_move));
        let hopeful = in_middle.value > WITNESS_MARGIN;
        if !hopeful {
            let x = self.scattered(&may_move, &in_middle.mix);
            if let Some(variable) = self.most_violated(&middle, &x, states) {
                return Verdict::Branch(variable);
            }
        }

        Verdict::Split {
            along_m: self.varies_more_along_m(&corners),
            hopeful,
        }
    }

    /// A matrix in doubles, relative to the largest entry of all corners.
    fn in_doubles(&self, matrix: &[i128]) -> Vec<f64> {
        let sizes = self.at.iter().flatten().map(|v| v.unsigned_abs());
        let largest = sizes.max().unwrap_or(1).max(1) as f64;
        matrix.iter().map(|v| *v as f64 / largest).collect()
    }

    /// Some columns of a matrix, the largest entry of each one.
    fn columns(&self, matrix: &[f64], indices: &[usize]) -> Vec<Vec<f64>> {
        let mut columns = Vec::with_capacity(indices.len());
        for &j in indices {
            let mut column: Vec<f64> = (0..self.n).map(|i| matrix[i * self.n + j]).collect();
            let size = largest_modulus(&column);
            for entry in &mut column {
                *entry /= size;
            }
            columns.push(column);
        }

        columns
    }

    /// The vector with the given values at some indices, zero elsewhere.
    fn scattered(&self, indices: &[usize], values: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.n];
        for (&j, value) in indices.iter().zip(values) {
            x[j] = *value;
        }

        x
    }

    /// w'T < 0 in every column that may move, at every corner with its radius; w >= 0 off the
    /// moving rows.
    fn is_farkas(&self, w: &[i64], may_move: &[usize], states: &[State]) -> bool {
        for (weight, state) in w.iter().zip(states) {
            if *weight < 0 && *state != State::Moving {
                return false;
            }
        }

        for corner in 0..4 {
            let matrix = &self.at[corner];
            let radius = &self.radius[corner / 2];

            for &j in may_move {
                let mut sum = 0;
                for (i, weight) in w.iter().enumerate() {
                    let place = i * self.n + j;
                    sum += i128::from(*weight) * matrix[place];
                    sum += i128::from(weight.abs()) * radius[place];
                }
                if sum >= 0 {
                    return false;
                }
            }
        }

        true
    }

    /// Cholesky in doubles of the symmetric part on the variables that may move, times sign.
    fn seems_definite(&self, matrix: &[f64], may_move: &[usize], sign: i8) -> bool {
        let half = 0.5 * f64::from(sign);
        let n = may_move.len();
        let mut rest = vec![vec![0.0; n]; n];
        for (p, &i) in may_move.iter().enumerate() {
            for (q, &j) in may_move.iter().enumerate() {
                let entry = matrix[i * self.n + j];
                let mirror = matrix[j * self.n + i];
                rest[p][q] = half * (entry + mirror);
            }
        }

        has_pivots_above(rest, DEFINITE_PIVOT)
    }

    /// The symmetric part times sign, less its radius, is positive definite at every corner.
    fn is_definite(&self, may_move: &[usize], sign: i8) -> bool {
        (0..4).all(|corner| {
            let shifted = self.less_its_radius(corner, may_move, sign);
            positive_definite(&shifted).is_ok()
        })
    }

    /// sign (T + T') at a corner on the variables that may move, with the radii of each row taken
    /// off its diagonal entry.
    fn less_its_radius(&self, corner: usize, may_move: &[usize], sign: i8) -> Sparse {
        let matrix = &self.at[corner];
        let radius = &self.radius[corner / 2];

        let mut entries = Vec::new();
        for (p, &i) in may_move.iter().enumerate() {
            for (q, &j) in may_move.iter().enumerate() {
                let place = i * self.n + j;
                let mirror = j * self.n + i;
                let entry = i128::from(sign) * (matrix[place] + matrix[mirror]);
                let slack = radius[place] + radius[mirror];
                entries.push((p, q, Rational::from_integer(entry.into())));
                entries.push((p, p, Rational::from_integer((-slack).into())));
            }
        }

        Sparse::from_entries(may_move.len(), may_move.len(), entries)
    }

    /// The open variable whose complementarity a relaxed solution x breaks most: of largest min(x,
    /// y), the first of several.
    fn most_violated(&self, matrix: &[f64], x: &[f64], states: &[State]) -> Option<usize> {
        let mut violation = Vec::with_capacity(self.n);
        for (row, x_i) in matrix.chunks_exact(self.n).zip(x) {
            let products = row.iter().zip(x).map(|(t, x_j)| t * x_j);
            let y_i: f64 = products.sum();
            violation.push(x_i.min(y_i));
        }

        let open = (0..self.n).filter(|&i| states[i] == State::Open);
        open.max_by(|&i, &j| violation[i].total_cmp(&violation[j]).then(j.cmp(&i)))
    }

    /// Which halving changes the corners more? The radius shrinks with s alone.
    fn varies_more_along_m(&self, corners: &[Vec<f64>; 4]) -> bool {
        let [s0_m0, s1_m0, s0_m1, s1_m1] = corners;
        let along_m = largest_change(s0_m0, s0_m1).max(largest_change(s1_m0, s1_m1));
        let along_s = largest_change(s0_m0, s1_m0).max(largest_change(s0_m1, s1_m1));
        let radius = self.in_doubles(&self.radius[1]);
        let largest_radius = radius.into_iter().fold(0.0, f64::max);
        along_m > along_s + 4.0 * largest_radius
    }
}

/// The weights 1 - m and m of the parts without friction and of friction, times 2^m_level.
struct Weights {
    without_friction: i128,
    of_friction: i128,
}

impl Weights {
    fn at(m: u64, m_level: u32) -> Weights {
        Weights {
            without_friction: i128::from((1u64 << m_level) - m),
            of_friction: i128::from(m),
        }
    }

    fn mix(&self, without_friction: &[i64], of_friction: &[i64]) -> Vec<i128> {
        let mut sum = Vec::with_capacity(of_friction.len());
        for (zero, one) in without_friction.iter().zip(of_friction) {
            let first = self.without_friction * i128::from(*zero);
            let second = self.of_friction * i128::from(*one);
            sum.push(first + second);
        }

        sum
    }
}

/// The mean of the four corners.
fn mean(corners: &[Vec<f64>; 4]) -> Vec<f64> {
    let places = 0..corners[0].len();
    places
        .map(|place| corners.iter().map(|corner| 0.25 * corner[place]).sum())
        .collect()
}

/// The largest difference of two entries at the same place.
fn largest_change(a: &[f64], b: &[f64]) -> f64 {
    let changes = a.iter().zip(b).map(|(x, y)| (x - y).abs());
    changes.fold(0.0, f64::max)
}

/// The largest modulus, positive in any case so that one can divide by it.
fn largest_modulus(v: &[f64]) -> f64 {
    v.iter()
        .map(|entry| entry.abs())
        .fold(f64::MIN_POSITIVE, f64::max)
}

/// w in integers of WEIGHT_BITS bits.
fn rounded(w: &[f64]) -> Vec<i64> {
    let largest = largest_modulus(w);
    let integers = w
        .iter()
        .map(|v| (v / largest * WEIGHT_BITS.exp2()).round() as i64);
    integers.collect()
}
