//! The families of problems that the measurements are made on: random pencils and Table 1.
//!
//! Entries are rounded to multiples of 2^-12, so that doubles hold them exactly and the exact
//! enumerator can say what the solutions are. Used by the tests of the solver and of its
//! allocations.
#![allow(dead_code, missing_docs, unreachable_pub, clippy::unwrap_used)]

use mceip_exact::{Sparse, from_f64};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use nalgebra::{DMatrix, dmatrix};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

pub struct Case {
    pub label: String,
    pub pencil: Pencil,
    pub unknown: Unknown,
}

impl Case {
    /// The case over the whole half line.
    pub fn problem(&self) -> Problem {
        let body = Body::Pencil(self.pencil.clone());
        Problem::new(body, self.unknown, Window::all()).unwrap()
    }
}

/// A random problem of the family "mu" or "lambda2" of order n, of which n/2 variables are free.
///
/// M and K0 are GG'/n + I/2, K1 is normal / sqrt(n) with zero rows for the free variables. MCEIP-mu
/// has A = K0 and B = K1, MCEIP-lambda2 has A = K0 + 3 K1 and B = M.
pub fn random_case(family: &str, n: usize, seed: u64, k: u64) -> Case {
    let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 * n as u64 + 1000 * seed + k);
    let free = n / 2;

    let mass = random_definite(&mut rng, n);
    let k0 = random_definite(&mut rng, n);
    let mut k1 = normal_matrix(&mut rng, n) / (n as f64).sqrt();
    k1.rows_mut(0, free).fill(0.0);

    let label = format!("{family} n={n} seed={seed} k={k}");
    let free = (0..free).collect();

    if family == "mu" {
        return Case {
            label,
            pencil: Pencil::new(sparse(&k0), sparse(&k1), free).unwrap(),
            unknown: Unknown::Mu,
        };
    }

    let stiffness = k0 + k1.map(round) * 3.0;
    Case {
        label,
        pencil: Pencil::new(sparse(&stiffness), sparse(&mass), free).unwrap(),
        unknown: Unknown::Lambda2,
    }
}

/// 320 points of Table 1: phi 10 to 80 degrees, mu 0.5 to 20, all signs; the matrices in doubles,
/// read exactly.
pub fn table1_cases() -> Vec<Case> {
    let angles = [10.0f64, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
    let frictions = [0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0];
    let sign_patterns = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let mut cases = Vec::new();

    for phi in angles {
        for mu in frictions {
            for (s1, s2) in sign_patterns {
                cases.push(Case {
                    label: format!("table 1 phi={phi} mu={mu} S=({s1},{s2})"),
                    pencil: table1_pencil(phi, mu, s1, s2),
                    unknown: Unknown::Lambda2,
                });
            }
        }
    }
    cases
}

/// Two particles on a slope of `phi` degrees, with the signs of their slip.
fn table1_pencil(phi: f64, mu: f64, s1: f64, s2: f64) -> Pencil {
    let (s, c) = phi.to_radians().sin_cos();
    let d = c * c + 1.0;
    let q = mu * c * s;

    let a = dmatrix![
        d - q * s1, -s1 * s2;
        -s1 * s2, d + q * s2
    ];
    Pencil::new(sparse(&a), Sparse::identity(2), vec![]).unwrap()
}

/// The nearest multiple of 2^-12.
fn round(value: f64) -> f64 {
    (value * 4096.0).round() / 4096.0
}

/// The matrix with its entries rounded.
fn sparse(matrix: &DMatrix<f64>) -> Sparse {
    let mut entries = Vec::new();

    for i in 0..matrix.nrows() {
        for j in 0..matrix.ncols() {
            let rounded = round(matrix[(i, j)]);
            entries.push((i, j, from_f64(rounded).unwrap()));
        }
    }
    Sparse::from_entries(matrix.nrows(), matrix.ncols(), entries)
}

/// A standard normal number (Box and Muller).
fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let u = 1.0 - rng.random::<f64>();
    let v = rng.random::<f64>();
    let radius = (-2.0 * u.ln()).sqrt();

    radius * (TAU * v).cos()
}

fn normal_matrix(rng: &mut ChaCha8Rng, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |_, _| normal(rng))
}

/// GG'/n + I/2.
fn random_definite(rng: &mut ChaCha8Rng, n: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    let gram = &g * g.transpose();
    gram / n as f64 + DMatrix::identity(n, n) * 0.5
}
