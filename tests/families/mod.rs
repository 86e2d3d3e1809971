//! The families of the measurements, over dyadic rationals so that the exact enumerator is the
//! truth.
#![allow(dead_code, missing_docs, unreachable_pub, clippy::unwrap_used)]

use mceip_exact::{Sparse, from_f64};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub struct Case {
    pub label: String,
    pub pencil: Pencil,
    pub unknown: Unknown,
}

impl Case {
    /// The case over the whole half line.
    pub fn problem(&self) -> Problem {
        Problem::new(
            Body::Pencil(self.pencil.clone()),
            self.unknown,
            Window::all(),
        )
        .unwrap()
    }
}

/// M and K0 = GG'/n + I/2, K1 normal/sqrt(n) with zero f rows, n_f = n/2; mu = 3 for lambda2.
/// Entries are rounded to multiples of 2^-12.
pub fn random_case(family: &str, n: usize, seed: u64, k: u64) -> Case {
    let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 * n as u64 + 1000 * seed + k);
    let free = n / 2;
    let (m0, k0) = (definite(&mut rng, n), definite(&mut rng, n));
    let mut k1 = normal_matrix(&mut rng, n) / (n as f64).sqrt();
    k1.rows_mut(0, free).fill(0.0);
    let (a, b, unknown) = if family == "mu" {
        (k0, k1, Unknown::Mu)
    } else {
        (k0 + k1.map(round) * 3.0, m0, Unknown::Lambda2)
    };
    let pencil = Pencil::new(sparse(&a), sparse(&b), (0..free).collect()).unwrap();
    Case {
        label: format!("{family} n={n} seed={seed} k={k}"),
        pencil,
        unknown,
    }
}

/// 320 points: phi 10 to 80 degrees, mu 0.5 to 20, all signs; the matrices in doubles, read
/// exactly.
pub fn table1_cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for phi in [10.0f64, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0] {
        let (s, c) = phi.to_radians().sin_cos();
        for mu in [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0] {
            for (s1, s2) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let (d, q) = (c * c + 1.0, mu * c * s);
                let a = nalgebra::dmatrix![d - q * s1, -s1 * s2; -s1 * s2, d + q * s2];
                let pencil = Pencil::new(sparse(&a), Sparse::identity(2), vec![]).unwrap();
                cases.push(Case {
                    label: format!("table 1 phi={phi} mu={mu} S=({s1},{s2})"),
                    pencil,
                    unknown: Unknown::Lambda2,
                });
            }
        }
    }
    cases
}

fn round(v: f64) -> f64 {
    (v * 4096.0).round() / 4096.0
}

fn sparse(m: &DMatrix<f64>) -> Sparse {
    let entry = |i: usize, j: usize| from_f64(round(m[(i, j)])).unwrap();
    Sparse::from_entries(
        m.nrows(),
        m.ncols(),
        (0..m.nrows()).flat_map(|i| (0..m.ncols()).map(move |j| (i, j, entry(i, j)))),
    )
}

fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let (u, v): (f64, f64) = (1.0 - rng.random::<f64>(), rng.random());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

fn normal_matrix(rng: &mut ChaCha8Rng, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |_, _| normal(rng))
}

fn definite(rng: &mut ChaCha8Rng, n: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    &g * g.transpose() / n as f64 + DMatrix::identity(n, n) * 0.5
}
