//! Propositions 1 and 2: the eigenproblem as an MCP in doubles, with window and starting points.
//!
//! Unknowns (u, zeta): x = D u with a positive diagonal D, t = origin + direction * unit * zeta.
//! Rows: D (A + tB) D u complementary to u_s (free rows zero), e'u_s - c complementary to zeta
//! (gamma = e'u_s - c). Positive scaling changes neither signs nor complementarity, so this is
//! (27)-(30) or (31)-(34) with another positive normalisation; c = 1 unless asked otherwise.
#![allow(clippy::float_arithmetic)]

use crate::candidate::Candidate;
use mceip_exact::to_f64;
use mceip_mcp::mcp::Mcp;
use mceip_model::Admissible;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Where values are sought: the zeta substitution of section 4. // W1
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// t >= origin: zeta = t - origin. The origin 0 is the plain problem.
    Above(f64),
    /// t <= origin: zeta = origin - t. Negative t may come out and is for the caller to discard.
    Below(f64),
}

/// The MCP of Proposition 1 or 2 for an admissible pencil.
#[derive(Debug, Clone)]
pub struct Embedding {
    pub(super) a: DMatrix<f64>,
    pub(super) b: DMatrix<f64>,
    pub(super) diagonal: Vec<f64>,
    pub(super) is_free: Vec<bool>,
    pub(super) unit: f64,
    origin: f64,
    direction: f64,
    c: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Embedding {
    /// Embeds the pencil; the type of the argument says that its hypotheses hold.
    pub fn new(admissible: &Admissible<'_>, side: Side) -> Embedding {
        let pencil = admissible.pencil();
        let n = pencil.order();
        let (mut a, mut b) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        for (m, s) in [(&mut a, pencil.a()), (&mut b, pencil.b())] {
            s.entries().for_each(|(i, j, v)| m[(i, j)] = to_f64(v));
        }
        let diagonal: Vec<f64> = (0..n).map(|i| scale_of(a[(i, i)], b[(i, i)])).collect();
        for m in [&mut a, &mut b] {
            *m = DMatrix::from_fn(n, n, |i, j| diagonal[i] * m[(i, j)] * diagonal[j]);
        }
        let unit = match (a.amax(), b.amax()) {
            (x, y) if x > 0.0 && y > 0.0 => x / y,
            _ => 1.0,
        };
        let (origin, direction) = match side {
            Side::Above(t) => (t, 1.0),
            Side::Below(t) => (t, -1.0),
        };
        let mut is_free = vec![false; n];
        pencil.free().iter().for_each(|&i| is_free[i] = true);
        let lower = is_free
            .iter()
            .map(|&f| if f { f64::NEG_INFINITY } else { 0.0 })
            .chain([0.0])
            .collect();
        Embedding {
            a,
            b,
            diagonal,
            is_free,
            unit,
            origin,
            direction,
            c: 1.0,
            lower,
            upper: vec![f64::INFINITY; n + 1],
        }
    }

    /// The same problem with another constant c in (28), (33). `None` unless c is positive and
    /// finite.
    pub fn with_c(self, c: f64) -> Option<Embedding> {
        (c > 0.0 && c.is_finite()).then_some(Embedding { c, ..self })
    }

    /// gamma = e'u_s - c of (28), (33): zero at every solution with zeta > 0, free at zeta = 0.
    pub fn gamma(&self, z: &[f64]) -> f64 {
        self.sum(z) - self.c
    }

    fn sum(&self, z: &[f64]) -> f64 {
        self.is_free
            .iter()
            .zip(z)
            .filter(|(free, _)| !**free)
            .map(|(_, u)| u)
            .sum()
    }

    /// The candidate that a point of the MCP stands for: t and x = D u.
    pub fn candidate(&self, z: &[f64]) -> Candidate {
        let n = self.diagonal.len();
        Candidate {
            value: self.t(z[n]),
            x: z[..n]
                .iter()
                .zip(&self.diagonal)
                .map(|(u, d)| u * d)
                .collect(),
        }
    }

    /// The MCP point of a value and x (any positive scale with e'x_s > 0): u = x / d with e'u_s =
    /// c. The way opposite to [`Embedding::candidate`].
    pub fn point(&self, value: f64, x: &[f64]) -> Vec<f64> {
        let u: Vec<f64> = x.iter().zip(&self.diagonal).map(|(v, d)| v / d).collect();
        let sum = self.sum(&u);
        let zeta = (value - self.origin) * self.direction / self.unit;
        u.iter().map(|v| self.c * v / sum).chain([zeta]).collect()
    }

    /// Starting points: e'u_s = c always (at x = 0 the column of t vanishes), u_f = 0.
    ///
    /// The first two are u_s = 1/n_s at t = 0 and t = 1 from the origin (the first starts of
    /// `spec/`), then each single particle, then seeded random faces of the simplex with t
    /// log-uniform over six decades around the unit.
    pub fn starts(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let n = self.diagonal.len();
        let slip: Vec<usize> = (0..n).filter(|&i| !self.is_free[i]).collect();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let even = |zeta: f64| {
            let mut z = vec![0.0; n + 1];
            slip.iter().for_each(|&i| z[i] = 1.0 / slip.len() as f64);
            z[n] = zeta;
            z
        };
        let mut starts = vec![even(0.0), even(1.0 / self.unit)];
        for &i in &slip {
            let mut z = vec![0.0; n + 1];
            z[i] = 1.0;
            z[n] = self.ritz(i);
            starts.push(z);
        }
        while starts.len() < count {
            starts.push(self.random_start(&slip, &mut rng));
        }
        starts.truncate(count);
        // Written for e'u_s = 1.
        starts
            .iter_mut()
            .for_each(|z| z[..n].iter_mut().for_each(|u| *u *= self.c));
        starts
    }

    /// A random residual direction for curves: standard normal in the rows of the pencil (Box and
    /// Muller), zero in that of e'u_s, so that e'u_s = c stays. With `uneven` each is cubed: a few
    /// rows dominate, and the curve stays near the face of its start.
    pub fn direction(&self, seed: u64, uneven: bool) -> Vec<f64> {
        normals(self.diagonal.len(), seed, uneven)
            .into_iter()
            .chain([0.0])
            .collect()
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

    fn random_start(&self, slip: &[usize], rng: &mut ChaCha8Rng) -> Vec<f64> {
        let n = self.diagonal.len();
        let mut z = vec![0.0; n + 1];
        // Exponential weights on a random face: uniform on that face of the simplex.
        let keep: f64 = rng.random_range(0.2..1.0);
        for &i in slip {
            let (weight, kept): (f64, f64) = (
                rng.random_range(f64::MIN_POSITIVE..1.0),
                rng.random_range(0.0..1.0),
            );
            z[i] = if kept < keep { -weight.ln() } else { 0.0 };
        }
        let sum: f64 = slip.iter().map(|&i| z[i]).sum();
        if sum > 0.0 {
            slip.iter().for_each(|&i| z[i] /= sum);
        } else {
            slip.iter().for_each(|&i| z[i] = 1.0 / slip.len() as f64);
        }
        z[n] = 10f64.powf(rng.random_range(-3.0..3.0));
        z
    }

    /// The entries of column j of A and B.
    fn columns(&self, j: usize) -> impl Iterator<Item = (&f64, &f64)> {
        let n = self.diagonal.len();
        let place = j * n..(j + 1) * n;
        self.a.as_slice()[place.clone()]
            .iter()
            .zip(&self.b.as_slice()[place])
    }

    fn t(&self, zeta: f64) -> f64 {
        self.origin + self.direction * self.unit * zeta
    }
}

/// Standard normal numbers (Box and Muller), cubed if `uneven`.
pub(super) fn normals(count: usize, seed: u64, uneven: bool) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || {
        let (u, v): (f64, f64) = (
            rng.random_range(f64::MIN_POSITIVE..1.0),
            rng.random_range(0.0..1.0),
        );
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    };
    (0..count)
        .map(|_| normal())
        .map(|v| if uneven { v * v * v } else { v })
        .collect()
}

/// 1 / sqrt of the larger diagonal entry, a power of two so that scaling commits no rounding.
fn scale_of(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs() * f64::from(u8::from(a == 0.0)));
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
        let t = self.t(z[n]);
        let y = &mut f[..n];
        y.fill(0.0); // E27, E31
        for (j, u) in z[..n].iter().enumerate().filter(|(_, u)| **u != 0.0) {
            y.iter_mut()
                .zip(self.columns(j))
                .for_each(|(y, (a, b))| *y += (a + t * b) * u);
        }
        f[n] = self.gamma(z); // E28, E33
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.diagonal.len();
        let (t, rate) = (self.t(z[n]), self.direction * self.unit);
        let (left, right) = j.as_mut_slice().split_at_mut(n * (n + 1));
        right.fill(0.0);
        for (k, column) in left.chunks_exact_mut(n + 1).enumerate() {
            for ((entry, last), (a, b)) in
                column.iter_mut().zip(right.iter_mut()).zip(self.columns(k))
            {
                *entry = a + t * b;
                *last += b * (rate * z[k]);
            }
            column[n] = if self.is_free[k] { 0.0 } else { 1.0 };
        }
    }
}

#[cfg(test)]
mod tests;
