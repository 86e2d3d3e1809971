//! Propositions 1 and 2: the eigenproblem as an MCP in doubles, with window and starting points.
//!
//! Unknowns (u, zeta): x = D u with a positive diagonal D, and t = origin + direction unit zeta.
//! Rows, with the complementary unknowns:
//!
//!   D (A + t B) D u  complementary to u_s >= 0 (zero in the rows of free u_f),
//!   gamma = e'u_s - c  complementary to zeta >= 0.
//!
//! Positive scaling changes neither signs nor complementarity, so this is (27)-(30) or (31)-(34)
//! with another positive normalisation; c = 1 unless asked otherwise. D and the unit of t are
//! powers of two and a ratio of the largest entries, so that the MCP is well scaled.
//!
//! With particles in contact with zero reaction the pencil is that of the split form, and the
//! unknowns and rows of these particles are those of [`ratios`].
//!
//! Input: an admissible pencil (the hypotheses of the propositions hold) and the side of a window.
//! Output: an [`Mcp`] for the solver, its starting points, and the way between its points and
//! candidates. Called by `multistart`; the curves of [`CirclePencil`](super::CirclePencil) begin
//! with an embedding.
#![allow(clippy::float_arithmetic)]

mod ratios;

use crate::candidate::Candidate;
use crate::magnitude::{binary_order, two_to};
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_mcp::mcp::Mcp;
use mceip_model::{Admissible, Pencil, ZeroVariables};
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Where values are sought: the zeta substitution of section 4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// t >= origin: zeta = t - origin. The origin 0 is the plain problem.
    Above(f64),
    /// t <= origin: zeta = origin - t. Negative t may come out and is for the caller to discard.
    Below(f64),
}

/// The MCP of Proposition 1 or 2 for an admissible pencil of order n.
#[derive(Debug, Clone)]
pub struct Embedding {
    /// D A D, n x n.
    pub(super) a: DMatrix<f64>,
    /// D B D, n x n.
    pub(super) b: DMatrix<f64>,
    /// The diagonal of D, powers of two.
    pub(super) diagonal: Vec<f64>,
    pub(super) is_free: Vec<bool>,
    /// Is the variable one of the sum e'u_s: neither free nor of a z particle?
    is_summed: Vec<bool>,
    /// The variables of the particles in contact with zero reaction.
    zero: Vec<ZeroVariables>,
    /// The change of t for zeta = 1, of the size of |A| / |B|.
    pub(super) unit: f64,
    /// t at zeta = 0.
    origin: f64,
    /// 1 where t grows with zeta, else -1.
    direction: f64,
    /// e'u_s of every solution with zeta > 0.
    c: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Embedding {
    /// Embeds the pencil; the type of the argument says that its hypotheses hold.
    pub fn new(admissible: &Admissible<'_>, side: Side) -> Embedding {
        Embedding::with_zero(admissible, &[], side)
    }

    /// The same for the pencil of the split form of a system with the given variables of z
    /// particles.
    pub fn with_zero(admissible: &Admissible<'_>, zero: &[ZeroVariables], side: Side) -> Embedding {
        let pencil = admissible.pencil();
        let n = pencil.order();

        let common = common_scale(pencil);
        let plain_a = dense(pencil.a(), common.as_ref());
        let plain_b = dense(pencil.b(), common.as_ref());
        let mut diagonal = vec![1.0; n];
        for (i, d) in diagonal.iter_mut().enumerate() {
            *d = scale_of(plain_a[(i, i)], plain_b[(i, i)]);
        }
        ratios::join_scales(&mut diagonal, zero);

        let a = scaled(&plain_a, &diagonal);
        let b = scaled(&plain_b, &diagonal);

        let largest_a = a.amax();
        let largest_b = b.amax();
        let unit = if largest_a > 0.0 && largest_b > 0.0 {
            largest_a / largest_b
        } else {
            1.0
        };

        let (origin, direction) = match side {
            Side::Above(t) => (t, 1.0),
            Side::Below(t) => (t, -1.0),
        };

        let mut is_free = vec![false; n];
        let mut is_summed = vec![true; n];
        let mut lower = vec![0.0; n + 1];
        let mut upper = vec![f64::INFINITY; n + 1];
        for &i in pencil.free() {
            is_free[i] = true;
            is_summed[i] = false;
            lower[i] = f64::NEG_INFINITY;
        }
        for variables in zero {
            for i in [variables.gap, variables.right, variables.left] {
                is_summed[i] = false;
            }
            ratios::set_bounds(variables, &mut lower, &mut upper);
        }

        Embedding {
            a,
            b,
            diagonal,
            is_free,
            is_summed,
            zero: zero.to_vec(),
            unit,
            origin,
            direction,
            c: 1.0,
            lower,
            upper,
        }
    }

    /// The same problem with another constant c in (28), (33). `None` unless c is positive and
    /// finite.
    pub fn with_c(self, c: f64) -> Option<Embedding> {
        let is_admissible = c > 0.0 && c.is_finite();
        is_admissible.then_some(Embedding { c, ..self })
    }

    /// Are all numbers of the MCP finite, and is there a unit of t?
    pub(crate) fn is_finite(&self) -> bool {
        let mut entries = self.a.iter().chain(&self.b);
        let has_unit = self.unit.is_finite() && self.unit > 0.0;
        has_unit && entries.all(|entry| entry.is_finite())
    }

    /// gamma = e'u_s - c of (28), (33): zero at every solution with zeta > 0, free at zeta = 0.
    pub fn gamma(&self, z: &[f64]) -> f64 {
        self.slip_sum(z) - self.c
    }

    /// e'u_s.
    fn slip_sum(&self, u: &[f64]) -> f64 {
        let variables = self.is_summed.iter().zip(u);
        let slip = variables.filter(|(is_summed, _)| **is_summed);
        slip.map(|(_, u_i)| u_i).sum()
    }

    /// The candidate that a point of the MCP stands for: t and x = D u.
    pub fn candidate(&self, z: &[f64]) -> Candidate {
        let n = self.diagonal.len();
        let mut u = z[..n].to_vec();
        for variables in &self.zero {
            ratios::split(variables, &mut u);
        }

        Candidate {
            value: self.t(z[n]),
            x: u.iter().zip(&self.diagonal).map(|(u, d)| u * d).collect(),
        }
    }

    /// The MCP point of a value and x (any positive scale with e'x_s > 0): u = x / d with e'u_s =
    /// c. The way opposite to [`Embedding::candidate`].
    pub fn point(&self, value: f64, x: &[f64]) -> Vec<f64> {
        let scaled = x.iter().zip(&self.diagonal).map(|(v, d)| v / d);
        let mut z: Vec<f64> = scaled.collect();

        let sum = self.slip_sum(&z);
        for u in &mut z {
            *u = self.c * *u / sum;
        }

        let zeta = (value - self.origin) * self.direction / self.unit;
        z.push(zeta);
        self.join_ratios(&mut z);
        z
    }

    /// Replaces v+ and v- of each z particle by v_T and the friction ratio.
    fn join_ratios(&self, z: &mut [f64]) {
        if self.zero.is_empty() {
            return;
        }

        for variables in &self.zero {
            ratios::join(variables, z);
        }
        let rows = self.rows(z);
        for variables in &self.zero {
            z[variables.left] = ratios::ratio(variables, z[variables.right], &rows);
        }
    }

    /// `count` starting points: e'u_s = c always (at x = 0 the column of t vanishes), u_f = 0.
    ///
    /// The first two are u_s = 1/n_s at t = 0 and t = 1 from the origin (the first starts of
    /// `spec/`), then each single particle, then seeded random faces of the simplex with t
    /// log-uniform over six decades around the unit.
    pub fn starts(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let n = self.diagonal.len();
        let slip: Vec<usize> = (0..n).filter(|&i| self.is_summed[i]).collect();
        let even = even_weights(slip.len());

        let mut starts = vec![
            self.start(&slip, &even, 0.0),
            self.start(&slip, &even, 1.0 / self.unit),
        ];
        for &i in &slip {
            starts.push(self.start(&[i], &[1.0], self.ritz(i)));
        }

        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        while starts.len() < count {
            starts.push(self.random_start(&slip, &mut rng));
        }
        starts.truncate(count);

        // All of them were written for e'u_s = 1.
        for z in &mut starts {
            for u in &mut z[..n] {
                *u *= self.c;
            }
        }

        // The first start has no z particle that moves or is pressed.
        for z in starts.iter_mut().skip(1) {
            for variables in &self.zero {
                ratios::random_mode(variables, self.c, z, &mut rng);
            }
        }

        starts
    }

    /// The point with the given weights of some slip variables, all other u zero.
    fn start(&self, slip: &[usize], weights: &[f64], zeta: f64) -> Vec<f64> {
        let n = self.diagonal.len();
        let mut z = vec![0.0; n + 1];
        for (&i, weight) in slip.iter().zip(weights) {
            z[i] = *weight;
        }
        z[n] = zeta;
        z
    }

    /// A random residual direction for curves: standard normal in the rows of the pencil (Box and
    /// Muller), zero in that of e'u_s, so that e'u_s = c stays.
    ///
    /// With `uneven` each entry is cubed: a few rows dominate, and the curve stays near the face of
    /// its start.
    pub fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        let mut direction = normals(self.diagonal.len(), seed, uneven);
        direction.push(0.0);
        direction
    }

    /// zeta at which the diagonal entry of particle i vanishes, or 0 if that lies on the other
    /// side.
    fn ritz(&self, i: usize) -> f64 {
        let t = -self.a[(i, i)] / self.b[(i, i)];
        let zeta = (t - self.origin) * self.direction / self.unit;
        if zeta.is_finite() && zeta > 0.0 {
            zeta
        } else {
            0.0
        }
    }

    /// A random point of a random face of the simplex, at a random value.
    fn random_start(&self, slip: &[usize], rng: &mut ChaCha8Rng) -> Vec<f64> {
        let weights = random_face(slip.len(), rng);
        let zeta = random_zeta(rng);
        self.start(slip, &weights, zeta)
    }

    /// The entries of column j of D A D and D B D.
    fn columns(&self, j: usize) -> impl Iterator<Item = (&f64, &f64)> {
        let n = self.diagonal.len();
        let begin = j * n;
        let end = begin + n;
        let a = &self.a.as_slice()[begin..end];
        let b = &self.b.as_slice()[begin..end];
        a.iter().zip(b)
    }

    /// t of zeta.
    fn t(&self, zeta: f64) -> f64 {
        self.origin + self.direction * self.unit * zeta
    }

    /// y = D (A + t B) D u, where the column of v- of a z particle is left out: its unknown is the
    /// friction ratio.
    fn rows(&self, z: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.diagonal.len()];
        self.add_rows(z, &mut y);
        y
    }

    /// Column by column; columns of u_j = 0 are left out.
    fn add_rows(&self, z: &[f64], y: &mut [f64]) {
        let n = self.diagonal.len();
        let t = self.t(z[n]);
        for (j, &u_j) in z[..n].iter().enumerate() {
            if u_j == 0.0 || self.is_ratio(j) {
                continue;
            }
            for (y_i, (a, b)) in y.iter_mut().zip(self.columns(j)) {
                *y_i += (a + t * b) * u_j;
            }
        }
    }

    /// Is unknown j the friction ratio of a z particle?
    fn is_ratio(&self, j: usize) -> bool {
        self.zero.iter().any(|variables| variables.left == j)
    }
}

/// Binary orders of magnitude of entries up to which doubles carry their products, too.
const MODEST: i64 = 500;

/// A power of two that brings the entries of A and B, taken together, into the middle of the
/// doubles; `None` where they need none. It is another unit of y, and leaves t and x alone.
fn common_scale(pencil: &Pencil) -> Option<Rational> {
    let entries = pencil.a().entries().chain(pencil.b().entries());
    let orders: Vec<i64> = entries.map(|(_, _, v)| binary_order(v)).collect();
    let least = *orders.iter().min()?;
    let most = *orders.iter().max()?;
    if least >= -MODEST && most <= MODEST {
        return None;
    }

    Some(two_to(-(least + most) / 2))
}

/// A matrix of rationals, multiplied by the scale, each entry rounded to the nearest double.
fn dense(matrix: &Sparse, scale: Option<&Rational>) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(matrix.rows(), matrix.cols());
    for (i, j, v) in matrix.entries() {
        dense[(i, j)] = match scale {
            Some(scale) => to_f64(&(v * scale)),
            None => to_f64(v),
        };
    }
    dense
}

/// D M D for the diagonal of D.
fn scaled(matrix: &DMatrix<f64>, diagonal: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
        diagonal[i] * matrix[(i, j)] * diagonal[j]
    })
}

/// The weights 1 / count.
pub(super) fn even_weights(count: usize) -> Vec<f64> {
    vec![1.0 / count as f64; count]
}

/// Random weights of sum 1, uniformly distributed on a random face of the simplex; even ones where
/// no component was kept.
///
/// Exponential weights divided by their sum are uniform on the simplex. Each of them is kept with
/// one probability, itself drawn between 0.2 and 1.
pub(super) fn random_face(count: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let keep: f64 = rng.random_range(0.2..1.0);
    let mut weights = vec![0.0; count];
    for weight in &mut weights {
        let uniform: f64 = rng.random_range(f64::MIN_POSITIVE..1.0);
        let kept: f64 = rng.random_range(0.0..1.0);
        if kept < keep {
            *weight = -uniform.ln();
        }
    }

    let sum: f64 = weights.iter().sum();
    if sum > 0.0 {
        for weight in &mut weights {
            *weight /= sum;
        }
        weights
    } else {
        even_weights(count)
    }
}

/// A value in units, log-uniform over the six decades around 1.
pub(super) fn random_zeta(rng: &mut ChaCha8Rng) -> f64 {
    10f64.powf(rng.random_range(-3.0..3.0))
}

/// Standard normal numbers, cubed if `uneven`.
pub(super) fn normals(count: usize, seed: u64, uneven: bool) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut numbers = Vec::with_capacity(count);
    for _ in 0..count {
        let v = normal(&mut rng);
        numbers.push(if uneven { v * v * v } else { v });
    }

    numbers
}

/// A standard normal number (Box and Muller).
fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let u: f64 = rng.random_range(f64::MIN_POSITIVE..1.0);
    let v: f64 = rng.random_range(0.0..1.0);
    (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
}

/// 1 / sqrt(|a|), or 1 / sqrt(|b|) where a is zero, rounded to a power of two so that scaling
/// commits no rounding; 1 where that is no positive number.
fn scale_of(a: f64, b: f64) -> f64 {
    let size_of_b = if a == 0.0 { b.abs() } else { 0.0 };
    power_of_two(a.abs().max(size_of_b))
}

/// 1 / sqrt of a positive number, rounded to a power of two; 1 for what is no positive number.
pub(super) fn power_of_two(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() {
        (-0.5 * size.log2()).round().exp2()
    } else {
        1.0
    }
}

impl Mcp for Embedding {
    fn dimension(&self) -> usize {
        self.diagonal.len() + 1
    }

    fn lower(&self) -> &[f64] {
        &self.lower
    }

    fn upper(&self) -> &[f64] {
        &self.upper
    }

    fn function(&self, z: &[f64], f: &mut [f64]) {
        let n = self.diagonal.len();
        let y = &mut f[..n]; // (27), (31)
        y.fill(0.0);
        self.add_rows(z, y);
        for variables in &self.zero {
            ratios::combine_rows(variables, z, y);
        }

        f[n] = self.gamma(z); // (28), (33)
    }

    /// Columns 0 to n - 1: A + t B, and e'_s in the last row. Column n: dt/dzeta B u.
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.diagonal.len();
        let t = self.t(z[n]);
        let t_by_zeta = self.direction * self.unit;

        let (left, last_column) = j.as_mut_slice().split_at_mut(n * (n + 1));
        last_column.fill(0.0);
        for (k, column) in left.chunks_exact_mut(n + 1).enumerate() {
            if self.is_ratio(k) {
                column.fill(0.0);
                continue;
            }
            for (i, (a, b)) in self.columns(k).enumerate() {
                column[i] = a + t * b;
                last_column[i] += b * (t_by_zeta * z[k]);
            }
            column[n] = if self.is_summed[k] { 1.0 } else { 0.0 };
        }

        if !self.zero.is_empty() {
            let y = self.rows(z);
            for variables in &self.zero {
                ratios::combine_rows_of_jacobian(variables, z, &y, j);
            }
        }
    }
}

#[cfg(test)]
mod tests;
