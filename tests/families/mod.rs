//! The families of problems that the measurements are made on: random pencils and Table 1.
//!
//! Entries are rounded to multiples of 2^-12, so that doubles hold them exactly and the exact
//! enumerator can say what the solutions are. Used by the tests of the solver and of its
//! allocations.
#![allow(dead_code, missing_docs, unreachable_pub, clippy::unwrap_used)]

#[path = "../support/mod.rs"]
pub mod support;

use mceip_exact::{Sparse, from_f64};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use support::{random_pencil, table1};

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
/// MCEIP-mu has A = K0 and B = K1, MCEIP-lambda2 has A = K0 + 3 K1 and B = M.
pub fn random_case(family: &str, n: usize, seed: u64, k: u64) -> Case {
    let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 * n as u64 + 1000 * seed + k);
    let (k0, k1, mass, free) = random_pencil(&mut rng, n);

    let (a, b, unknown) = if family == "mu" {
        (k0, k1, Unknown::Mu)
    } else {
        (k0 + k1.map(round) * 3.0, mass, Unknown::Lambda2)
    };
    Case {
        label: format!("{family} n={n} seed={seed} k={k}"),
        pencil: Pencil::new(sparse(&a), sparse(&b), (0..free).collect()).unwrap(),
        unknown,
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
                let (s, c) = phi.to_radians().sin_cos();
                let (a, b) = table1(c, s, mu, s1, s2);
                cases.push(Case {
                    label: format!("table 1 phi={phi} mu={mu} S=({s1},{s2})"),
                    pencil: Pencil::new(sparse(&a), sparse(&b), vec![]).unwrap(),
                    unknown: Unknown::Lambda2,
                });
            }
        }
    }
    cases
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
            entries.push((i, j, from_f64(round(matrix[(i, j)])).unwrap()));
        }
    }
    Sparse::from_entries(matrix.nrows(), matrix.ncols(), entries)
}
