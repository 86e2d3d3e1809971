//! Helpers of the solver tests: MCEIP embedded as MCP (Propositions 1 and 2), random pencils, and a
//! brute-force enumeration of all supports in floats.
//!
//! The enumeration solves an eigenproblem for every support and keeps what satisfies the signs. It
//! shares no line with the solver, so that a solution that the solver misses or invents shows.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_mcp::mcp::{FunctionMcp, Mcp};
use nalgebra::{DMatrix, DVector, Schur};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cmp::Ordering;

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

        let mut z = vec![0.0; self.free];
        z.resize(n, share);
        z.push(t);
        z
    }

    /// t = 0, t = 1, then random ones: x_f normal / sqrt n, x_s uniform with e'x_s = c, t uniform.
    pub fn starts(&self, count: usize, t_max: f64, seed: u64) -> Vec<Vec<f64>> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut starts = vec![self.first_start(0.0), self.first_start(1.0)];

        while starts.len() < count {
            let mut z = self.random_components(&mut rng);

            let has_random_support = starts.len() % 2 == 1;
            if has_random_support {
                self.drop_components(&mut z, &mut rng);
            }

            let slip = &mut z[self.free..];
            let sum: f64 = slip.iter().sum();
            for component in slip {
                *component *= self.c / sum;
            }

            z.push(t_max * rng.random::<f64>());
            starts.push(z);
        }
        starts
    }

    fn random_components(&self, rng: &mut ChaCha8Rng) -> Vec<f64> {
        let n = self.a.nrows();
        let mut z = Vec::with_capacity(n + 1);
        for i in 0..n {
            let component = if i < self.free {
                normal(rng) / (n as f64).sqrt()
            } else {
                rng.random::<f64>()
            };
            z.push(component);
        }
        z
    }

    /// A random support that is not empty: few slip, as solutions have.
    fn drop_components(&self, z: &mut [f64], rng: &mut ChaCha8Rng) {
        let n = self.a.nrows();
        let keep = self.free + rng.random_range(0..n - self.free);
        for (i, component) in z.iter_mut().enumerate().skip(self.free) {
            if i != keep {
                *component *= f64::from(rng.random_range(0..2));
            }
        }
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
        let t = z[n];

        let y = (&self.a + &self.b * t) * &x;
        f[..n].copy_from_slice(y.as_slice());
        f[n] = x.rows(self.free, n - self.free).sum() - self.c;
    }

    fn jacobian(&self, z: &[f64], j: &mut DMatrix<f64>) {
        let n = self.a.nrows();
        let x = DVector::from_column_slice(&z[..n]);
        let t = z[n];
        j.fill(0.0);

        let by_x = &self.a + &self.b * t;
        j.view_mut((0, 0), (n, n)).copy_from(&by_x);

        let by_t = &self.b * x;
        j.view_mut((0, n), (n, 1)).copy_from(&by_t);

        for i in self.free..n {
            j[(n, i)] = 1.0;
        }
    }
}

/// F and its Jacobian in n unknowns z >= 0.
pub fn smooth<'a>(
    n: usize,
    f: impl Fn(&[f64], &mut [f64]) + 'a,
    j: impl Fn(&[f64], &mut DMatrix<f64>) + 'a,
) -> FunctionMcp<'a> {
    FunctionMcp::new(vec![0.0; n], vec![f64::INFINITY; n], f).with_jacobian(j)
}

/// Murty's matrix: 1 on the diagonal, 2 above it.
pub fn murty(order: usize) -> DMatrix<f64> {
    DMatrix::from_fn(order, order, |i, j| match i.cmp(&j) {
        Ordering::Less => 2.0,
        Ordering::Equal => 1.0,
        Ordering::Greater => 0.0,
    })
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
        let mut support: Vec<usize> = (0..n).collect();
        support.retain(|&i| i < free || mask >> (i - free) & 1 == 1);

        let a_on_support = a.select_rows(&support).select_columns(&support);
        let b_on_support = b.select_rows(&support).select_columns(&support);

        for t in positive_eigenvalues(&a_on_support, &b_on_support) {
            let pencil = &a_on_support + &b_on_support * t;
            let Some(kernel) = kernel_vector(pencil) else {
                continue;
            };

            let x = spread(&kernel, &support, n, free);
            if solves(a, b, free, t, &x) && !contains(&found, t, x.as_slice()) {
                found.push(Truth { t, x });
            }
        }
    }
    found
}

/// All t > 0 with A + t B singular: 1/t is an eigenvalue of -A^-1 B. None where A is singular.
fn positive_eigenvalues(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Vec<f64> {
    let Some(inverse) = a.clone().try_inverse() else {
        return Vec::new();
    };
    let Some(schur) = Schur::try_new(-(inverse * b), 1e-15, 10_000) else {
        return Vec::new();
    };

    let mut values = Vec::new();
    for reciprocal in schur.complex_eigenvalues().iter() {
        let is_real = reciprocal.im.abs() <= 1e-9 * (1.0 + reciprocal.re.abs());
        if is_real && reciprocal.re >= 1e-8 {
            values.push(1.0 / reciprocal.re);
        }
    }
    values
}

/// The right singular vector of the least singular value.
fn kernel_vector(matrix: DMatrix<f64>) -> Option<DVector<f64>> {
    let svd = matrix.svd(false, true);
    let least = svd.singular_values.imin();
    Some(svd.v_t?.row(least).transpose())
}

/// The vector with these components on the support and zero elsewhere, with e'x_s = 1.
fn spread(components: &DVector<f64>, support: &[usize], n: usize, free: usize) -> DVector<f64> {
    let mut sum = 0.0;
    for (component, &i) in components.iter().zip(support) {
        if i >= free {
            sum += component;
        }
    }

    let mut x = DVector::zeros(n);
    for (component, &i) in components.iter().zip(support) {
        x[i] = component / sum;
    }
    x
}

/// x_s >= 0, y_s >= 0 and y_f = 0 for y = (A + t B) x, to rounding.
fn solves(a: &DMatrix<f64>, b: &DMatrix<f64>, free: usize, t: f64, x: &DVector<f64>) -> bool {
    let y = (a + b * t) * x;
    let scale = 1.0 + t;

    let mut slip = free..a.nrows();
    let has_signs = slip.all(|i| x[i] >= -1e-9 && y[i] >= -1e-8 * scale);
    let is_balanced = y.rows(0, free).amax() < 1e-7 * scale;
    has_signs && is_balanced
}

/// Is (t, x) in the list, to 1e-6?
pub fn contains(list: &[Truth], t: f64, x: &[f64]) -> bool {
    index_of(list, t, x).is_some()
}

/// The place of (t, x) in the list, to 1e-6.
pub fn index_of(list: &[Truth], t: f64, x: &[f64]) -> Option<usize> {
    list.iter()
        .position(|truth| is_near(t, truth.t) && are_near(truth.x.as_slice(), x))
}

/// Do the numbers agree to 1e-6 of the first one, or absolutely if that is small?
fn is_near(first: f64, second: f64) -> bool {
    (first - second).abs() <= 1e-6 * (1.0 + first.abs())
}

fn are_near(first: &[f64], second: &[f64]) -> bool {
    let mut pairs = first.iter().zip(second);
    pairs.all(|(&first, &second)| is_near(first, second))
}

/// A normally distributed number, from two uniform ones by the method of Box and Muller.
pub fn normal(rng: &mut impl Rng) -> f64 {
    let u: f64 = 1.0 - rng.random::<f64>();
    let v: f64 = rng.random();

    let radius = (-2.0 * u.ln()).sqrt();
    let angle = std::f64::consts::TAU * v;
    radius * angle.cos()
}

pub fn normal_matrix(rng: &mut impl Rng, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |_, _| normal(rng))
}

/// A random matrix with eigenvalues of at least 1/2.
pub fn definite(rng: &mut impl Rng, n: usize) -> DMatrix<f64> {
    let g = normal_matrix(rng, n);
    let semidefinite = &g * g.transpose() / n as f64;
    let half = DMatrix::identity(n, n) * 0.5;

    semidefinite + half
}

/// "Random pencils" of peers.md: (K0, K1, M0, n_f).
pub fn random_pencil(
    rng: &mut impl Rng,
    n: usize,
) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>, usize) {
    let free = n / 2;
    let m0 = definite(rng, n);
    let k0 = definite(rng, n);
    let mut k1 = normal_matrix(rng, n) / (n as f64).sqrt();
    k1.rows_mut(0, free).fill(0.0);
    (k0, k1, m0, free)
}

/// Table 1 with k = m = 1: (A, I) for the angle's cosine and sine, mu and signs.
pub fn table1(c: f64, s: f64, mu: f64, s1: f64, s2: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let stiffness = c * c + 1.0;
    let friction = mu * c * s;
    let coupling = -s1 * s2;
    let a = nalgebra::dmatrix![
        stiffness - friction * s1, coupling;
        coupling, stiffness + friction * s2
    ];
    (a, DMatrix::identity(2, 2))
}
