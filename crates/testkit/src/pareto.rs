//! Pareto eigenvalue problems inside admissible mechanical systems, and solutions planted in
//! pencils.
//!
//! Both give problems of which something is known by construction: how many solutions there are,
//! or one of them. A Pareto eigenvalue lambda of P with 0 <= x _|_ (P - lambda I) x >= 0 is a
//! solution t = lambda + shift of a raw pencil, and a solution mu = a / (c - lambda) of a
//! mechanical system. Called by the campaign, the conformance pack and tests.

use crate::generators::sparse;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Body, ContactState, ModelError, Particle, Pencil, Problem, System, Unknown, Window,
};
use num_traits::{One, Signed, Zero};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A matrix P with a known number of Pareto eigenvalues: 0 <= x _|_ (P - lambda I) x >= 0, x != 0.
#[derive(Debug, Clone)]
pub struct Pareto {
    /// P.
    pub matrix: Sparse,
    /// Pareto eigenvalues there are (all simple, each with one eigenvector).
    pub count: usize,
}

/// Matrices with many Pareto eigenvalues for their order: 3, 9, 23 and 57 for orders 2 to 5.
///
/// Orders 3 to 5 are due to A. Pinto da Costa and A. Seeger ("Cone-constrained eigenvalue problems:
/// theory and algorithms", Comput. Optim. Appl. 45 (2010) 25-57), here with the sign that makes
/// (P - lambda I) x >= 0: the literature has both. The counts are what identifies them, and they
/// are recomputed in `tests/oracle/known_answers.rs`. Order 2 is any with p_12, p_21 >= 0 and
/// different diagonal entries.
pub fn pareto_matrices() -> Vec<Pareto> {
    let two = Sparse::from_ints(&[&[3, 1], &[2, 5]]);

    // Half of [16, -2, 8; 6, 8, 1; 4, -1, 12].
    let doubled_three = Sparse::from_ints(&[&[16, -2, 8], &[6, 8, 1], &[4, -1, 12]]);
    let three = Sparse::zeros(3, 3).add_scaled(&rational(1, 2), &doubled_three);

    let four = Sparse::from_ints(&[
        &[100, 106, -18, -81],
        &[92, 158, -24, -101],
        &[2, 44, 37, -7],
        &[21, 38, 0, 2],
    ]);

    let five = Sparse::from_ints(&[
        &[-788, 780, 256, -156, -191],
        &[548, -862, 190, -112, -143],
        &[456, 548, -1308, -110, -119],
        &[292, 374, 14, -1402, -28],
        &[304, 402, 66, -38, -1522],
    ]);

    let list = [(two, 3), (three, 9), (four, 23), (five, 57)];
    list.map(|(matrix, count)| Pareto { matrix, count })
        .to_vec()
}

impl Pareto {
    /// As a raw pencil in t = lambda + shift: (P + shift I) x - t x = y. With a shift above every
    /// |lambda| all of them lie in the window [0, infinity).
    ///
    /// # Errors
    /// [`ModelError`] for an empty matrix.
    pub fn pencil(&self) -> Result<Problem, ModelError> {
        let n = self.matrix.rows();
        let identity = Sparse::identity(n);
        let a = self.matrix.add_scaled(&self.bound(), &identity);
        let minus_identity = Sparse::zeros(n, n).add_scaled(&whole(-1), &identity);

        let pencil = Pencil::new(a, minus_identity, vec![])?;
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())
    }

    /// A number above the absolute value of every eigenvalue of every principal block: 1 + the
    /// largest sum of absolute values in a row.
    pub fn bound(&self) -> Rational {
        let mut largest = Rational::zero();
        for i in 0..self.matrix.rows() {
            let row_sum: Rational = self.matrix.row(i).iter().map(|e| e.1.abs()).sum();
            largest = largest.max(row_sum);
        }
        largest + Rational::one()
    }

    /// As a mechanical system of n particles in impending slip (S = 1): K_TT = aI, K_NT = P - cI,
    /// K_NN = bI with c above every Pareto eigenvalue and b so large that K is positive definite.
    /// Each Pareto eigenvalue lambda is the solution mu = a / (c - lambda), with the same x.
    ///
    /// # Errors
    /// [`ModelError`] for a or c that break this.
    pub fn system(&self, a: &Rational, c: &Rational) -> Result<Problem, ModelError> {
        let n = self.matrix.rows();
        let coupling = self.matrix.add_scaled(&-c, &Sparse::identity(n));

        // a b > |K_NT|_F^2 makes the Schur complement bI - K_NT K_NT' / a definite.
        let frobenius: Rational = coupling.entries().map(|(_, _, v)| v * v).sum();
        let b = frobenius / a + Rational::one();

        let mut entries = Vec::new();
        for i in 0..n {
            entries.push((tangential(i), tangential(i), a.clone()));
            entries.push((normal(i), normal(i), b.clone()));
        }
        for (i, j, v) in coupling.entries() {
            entries.push((normal(i), tangential(j), v.clone()));
            entries.push((tangential(j), normal(i), v.clone()));
        }
        let stiffness = Sparse::from_entries(2 * n, 2 * n, entries);

        let slip = ContactState::Slip { sign: 1 };
        let particles = (0..n)
            .map(|i| Particle::plain(tangential(i), normal(i), slip))
            .collect();

        let system = System::new(stiffness, None, None, particles)?;
        Problem::new(Body::System(system), Unknown::Mu, Window::all())
    }
}

/// The tangential dof of particle i.
fn tangential(i: usize) -> usize {
    2 * i
}

/// The normal dof of particle i.
fn normal(i: usize) -> usize {
    2 * i + 1
}

/// A random admissible pencil with a rational solution planted in it.
#[derive(Debug, Clone)]
pub struct Planted {
    /// The problem.
    pub problem: Problem,
    /// The planted value.
    pub value: Rational,
    /// The planted vector, over all variables.
    pub x: Vec<Rational>,
}

/// Plants t and x in a pencil of order `n` with `free` free variables and admissible for lambda^2:
/// the column of one slipping variable of A is bent until (A + tB) x = y >= 0.
///
/// # Errors
/// [`ModelError::Empty`] without complementarity variables.
pub fn planted(n: usize, free: usize, seed: u64) -> Result<Planted, ModelError> {
    if free >= n {
        return Err(ModelError::Empty {
            what: "the complementarity variables",
        });
    }

    // The first variables after the free ones slip: they are the support.
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let value = fraction(&mut rng, 0, 30, 7);
    let active = free + integer(&mut rng, 1, (n - free) as i64) as usize;

    let mut x = vec![Rational::zero(); n];
    for (i, component) in x[..active].iter_mut().enumerate() {
        let lowest = if i < free { -9 } else { 1 };
        *component = fraction(&mut rng, lowest, 9, 4);
    }

    let mut y = vec![Rational::zero(); n];
    for component in &mut y[active..] {
        *component = whole(integer(&mut rng, 0, 5));
    }

    let b = definite_block(&mut rng, n, free);
    let a = definite_block(&mut rng, n, free);

    // A + tB maps x to `image`; the column of x_free carries the difference from y.
    let image = a.add_scaled(&value, &b).times(&x);
    let mut column = Vec::new();
    for i in 0..n {
        column.push((i, free, (&y[i] - &image[i]) / &x[free]));
    }
    let bend = Sparse::from_entries(n, n, column);
    let a = a.add_scaled(&Rational::one(), &bend);

    let pencil = Pencil::new(a, b, (0..free).collect())?;
    Ok(Planted {
        problem: Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?,
        value,
        x,
    })
}

/// A random integer from `lowest` to `highest`.
fn integer(rng: &mut ChaCha8Rng, lowest: i64, highest: i64) -> i64 {
    rng.random_range(lowest..=highest)
}

/// A numerator from `lowest` to `highest` over a denominator from 1 to `denominators`.
fn fraction(rng: &mut ChaCha8Rng, lowest: i64, highest: i64, denominators: i64) -> Rational {
    let numerator = integer(rng, lowest, highest);
    let denominator = integer(rng, 1, denominators);
    rational(numerator, denominator)
}

/// Small random integers, the leading block symmetric with a dominant diagonal.
fn definite_block(rng: &mut ChaCha8Rng, n: usize, free: usize) -> Sparse {
    let mut rows = vec![vec![0; n]; n];
    for entry in rows.iter_mut().flatten() {
        *entry = integer(rng, -4, 4);
    }

    for i in 0..free {
        for j in 0..i {
            rows[i][j] = rows[j][i];
        }

        rows[i][i] = 4 * n as i64 + 1;
    }

    sparse(&rows)
}
