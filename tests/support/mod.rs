//! Helpers of the solver tests: MCEIP embedded as MCP (Propositions 1 and 2), random pencils, and a
//! brute-force enumeration of all supports in floats, which the solver must not share.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_mcp::mcp::Mcp;
use nalgebra::{DMatrix, DVector, Schur};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// ((A + t B) x, e'x_s - c) on x_f free, x_s >= 0, t >= 0.
pub struct Embedded {
    pub a: DMatrix<f64>,
    pub b: DMatrix<f64>,
    pub free: usize,
    pub c: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Embedded {
    pub fn new(a: DMatrix<f64>, b: DMatrix<f64>, free: usize) -> Self {
        let n = a.nrows();
        let lower = (0..=n)
            .map(|i| if i < free { f64::NEG_INFINITY } else { 0.0 })
            .collect();
        Embedded {
            a,
            b,
            free,
            c: 1.0,
            lower,
            upper: vec![f64::INFINITY; n + 1],
        }
    }
    /// x_s = 1/n_s, x_f = 0, and t.
    pub fn first_start(&self, t: f64) -> Vec<f64> {
        let n = self.a.nrows();
        let share = 1.0 / (n - self.free) as f64;
        (0..=n)
            .map(|i| {
                if i == n {
                    t
                } else if i < self.free {
                    0.0
                } else {
                    share
                }
            })
            .collect()
    }
    /// t = 0, t = 1, then random ones: x_f normal / sqrt n, x_s uniform with e'x_s = c, t uniform.
    pub fn starts(&self, count: usize, t_max: f64, seed: u64) -> Vec<Vec<f64>> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let n = self.a.nrows();
        let mut starts = vec![self.first_start(0.0), self.first_start(1.0)];
        while starts.len() < count {
            let mut z: Vec<f64> = (0..n)
                .map(|i| {
                    if i < self.free {
                        normal(&mut rng) / (n as f64).sqrt()
                    } else {
                        rng.random::<f64>()
                    }
                })
                .collect();
            if starts.len() % 2 == 1 {
                // A random support: few slip, as solutions have.
                let keep = self.free + rng.random_range(0..n - self.free);
                (self.free..n)
                    .filter(|&i| i != keep)
                    .for_each(|i| z[i] *= f64::from(rng.random_range(0..2)));
            }
            let sum: f64 = z[self.free..].iter().sum();
            z[self.free..].iter_mut().for_each(|v| *v *= self.c / sum);
            z.push(t_max * rng.random::<f64>());
            starts.push(z);
        }
        starts
    }
}

impl Mcp for Embedded {
    fn dimension(&self) -> usize {
        self.a.nrows() + 1
    }
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn function(&self, z: &[f64], f: &mut [f64]) {
        let n = self.a.nrows();
        let x = DVector::from_column_slice(&z[..n]);
        let y = (&self.a + &self.b * z[n]) * &x;
        f[..n].copy_from_slice(y.as_slice());
        f[n] = x.rows(self.free, n - self.free).sum() - self.c;
    }
    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.a.nrows();
        j.fill(0.0);
        j.view_mut((0, 0), (n, n))
            .copy_from(&(&self.a + &self.b * z[n]));
        let by_t = &self.b * DVector::from_column_slice(&z[..n]);
        j.view_mut((0, n), (n, 1)).copy_from(&by_t);
        for i in self.free..n {
            j[(n, i)] = 1.0;
        }
    }
}

/// A solution (t, x), with e'x_s = 1.
#[derive(Debug, Clone)]
pub struct Truth {
    pub t: f64,
    pub x: DVector<f64>,
}

/// All solutions with t >= 0 by enumeration of the 2^n_s supports. Isolated ones only.
pub fn enumerate(a: &DMatrix<f64>, b: &DMatrix<f64>, free: usize) -> Vec<Truth> {
    let n = a.nrows();
    let mut found: Vec<Truth> = Vec::new();
    for mask in 1u32..(1 << (n - free)) {
        let support: Vec<usize> = (0..n)
            .filter(|&i| i < free || mask >> (i - free) & 1 == 1)
            .collect();
        let k = support.len();
        let sub = |m: &DMatrix<f64>| DMatrix::from_fn(k, k, |i, j| m[(support[i], support[j])]);
        let (sa, sb) = (sub(a), sub(b));
        // t with (A + tB) singular: s = 1/t eigenvalues of -A^-1 B, A being definite or at least
        // regular.
        let Some(inverse) = sa.clone().try_inverse() else {
            continue;
        };
        let Some(schur) = Schur::try_new(-(inverse * &sb), 1e-15, 10_000) else {
            continue;
        };
        for s in schur.complex_eigenvalues().iter() {
            if s.im.abs() > 1e-9 * (1.0 + s.re.abs()) || s.re < 1e-8 {
                continue;
            }
            let t = 1.0 / s.re;
            let svd = (&sa + &sb * t).svd(false, true);
            let Some(v_t) = svd.v_t else { continue };
            let least = svd.singular_values.imin();
            let sum: f64 = (0..k)
                .filter(|&i| support[i] >= free)
                .map(|i| v_t[(least, i)])
                .sum();
            let mut x = DVector::zeros(n);
            for i in 0..k {
                x[support[i]] = v_t[(least, i)] / sum;
            }
            let y = (a + b * t) * &x;
            let fits = (free..n).all(|i| x[i] >= -1e-9 && y[i] >= -1e-8 * (1.0 + t));
            if fits
                && y.rows(0, free).amax() < 1e-7 * (1.0 + t)
                && !contains(&found, t, x.as_slice())
            {
                found.push(Truth { t, x });
            }
        }
    }
    found
}

/// Is (t, x) in the list, to 1e-6?
pub fn contains(list: &[Truth], t: f64, x: &[f64]) -> bool {
    index_of(list, t, x).is_some()
}

pub fn index_of(list: &[Truth], t: f64, x: &[f64]) -> Option<usize> {
    list.iter().position(|s| {
        (s.t - t).abs() <= 1e-6 * (1.0 + t.abs())
            && s.x
                .iter()
                .zip(x)
                .all(|(p, q)| (p - q).abs() <= 1e-6 * (1.0 + p.abs()))
    })
}

pub fn normal(rng: &mut impl Rng) -> f64 {
    let (u, v): (f64, f64) = (1.0 - rng.random::<f64>(), rng.random());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

pub fn normal_matrix(rng: &mut impl Rng, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |_, _| normal(rng))
}

pub fn definite(rng: &mut impl Rng, n: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    &g * g.transpose() / n as f64 + DMatrix::identity(n, n) * 0.5
}

/// "Random pencils" of peers.md: (K0, K1, M0, n_f).
pub fn random_pencil(
    rng: &mut impl Rng,
    n: usize,
) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>, usize) {
    let free = n / 2;
    let (m0, k0) = (definite(rng, n), definite(rng, n));
    let mut k1 = normal_matrix(rng, n) / (n as f64).sqrt();
    k1.rows_mut(0, free).fill(0.0);
    (k0, k1, m0, free)
}

/// Table 1 with k = m = 1: (A, I) for the angle's cosine and sine, mu and signs.
pub fn table1(c: f64, s: f64, mu: f64, s1: f64, s2: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let (d, q) = (c * c + 1.0, mu * c * s);
    (
        nalgebra::dmatrix![d - q * s1, -s1 * s2; -s1 * s2, d + q * s2],
        DMatrix::identity(2, 2),
    )
}
