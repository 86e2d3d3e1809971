//! Raw pencils: as finite elements have them, one-digit integers, mostly zeros, twins, graphs, free
//! variables anywhere.
//!
//! A raw pencil is drawn as two matrices A and B, without a mechanical system behind it. Input: a
//! source of random numbers and the order. Called by the campaign's families (`campaign::named`)
//! and by tests.

use super::{drawn, gram, matrix, sparse};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{ModelError, Pencil, QuadraticPencil, Unknown};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// K0 = GG' + I, K1 with zero free rows, M = GG' + I: as finite elements have it.
///
/// The `n_f` free variables come first, then the `n_s` complementarity variables.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn elements(
    unknown: Unknown,
    rng: &mut ChaCha8Rng,
    n_s: usize,
    n_f: usize,
) -> Result<Pencil, ModelError> {
    let n = n_s + n_f;
    let k0 = sparse(&gram(rng, n, 1));
    let mass = sparse(&gram(rng, n, 1));

    let mut k1 = drawn(n, || rng.random_range(-9..=9));
    for free_row in &mut k1[..n_f] {
        free_row.fill(0);
    }
    let k1 = sparse(&k1);

    of_elements(unknown, n_f, [k0, k1, mass], || {
        rational(rng.random_range(1..=9), 3)
    })
}

/// K0 + mu K1 of MCEIP-mu, or K0 + mu K1 and M of MCEIP-lambda2 under a friction that is drawn
/// last. The free variables come first.
pub(super) fn of_elements(
    unknown: Unknown,
    n_f: usize,
    [k0, k1, mass]: [Sparse; 3],
    friction: impl FnOnce() -> Rational,
) -> Result<Pencil, ModelError> {
    let free = (0..n_f).collect();
    match unknown {
        Unknown::Mu => Pencil::new(k0, k1, free),
        Unknown::Lambda2 | Unknown::Eigenvalue => {
            Pencil::new(k0.add_scaled(&friction(), &k1), mass, free)
        }
    }
}

/// One-digit integers, A and B arbitrary; with free variables A_ff definite, B_ff = 0.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn digits(rng: &mut ChaCha8Rng, n_s: usize, n_f: usize) -> Result<Pencil, ModelError> {
    let n = n_s + n_f;
    let mut a = drawn(n, || rng.random_range(-9..=9));
    let mut b = drawn(n, || rng.random_range(-9..=9));

    let a_ff = gram(rng, n_f, 1);
    for i in 0..n_f {
        a[i][..n_f].copy_from_slice(&a_ff[i]);
        b[i].fill(0);
    }

    Pencil::new(sparse(&a), sparse(&b), (0..n_f).collect())
}

/// Three quarters zeros: singular supports, repeated roots, ties.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn zeros(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    const ENTRIES: [i64; 8] = [0, 0, 0, 1, 0, 0, 0, -1];
    let a = drawn_from(&ENTRIES, rng, n);
    let b = drawn_from(&ENTRIES, rng, n);
    Pencil::new(sparse(&a), sparse(&b), Vec::new())
}

/// A matrix of order n by its rows, each entry one of eight with the same probability.
fn drawn_from(entries: &[i64; 8], rng: &mut ChaCha8Rng, n: usize) -> Vec<Vec<i64>> {
    drawn(n, || entries[rng.random_range(0..8)])
}

/// A particle that is another's double: the same row and column. At least two variables.
///
/// # Errors
/// [`ModelError`] for fewer.
pub fn doubled(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    if n < 2 {
        return Err(ModelError::Empty {
            what: "a pair of variables",
        });
    }

    let mut a = drawn(n, || rng.random_range(-3..=3));
    let mut b = drawn(n, || rng.random_range(-3..=3));
    double_the_last_but_one(&mut a);
    double_the_last_but_one(&mut b);
    Pencil::new(sparse(&a), sparse(&b), Vec::new())
}

/// Overwrites the last row and column with those before them.
fn double_the_last_but_one(rows: &mut [Vec<i64>]) {
    let n = rows.len();
    for row in rows.iter_mut() {
        row[n - 1] = row[n - 2];
    }
    rows[n - 1] = rows[n - 2].clone();
}

/// (A - 2 - t) x = y, A the adjacency matrix of a random graph: repeated values, integers, cones.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn graph(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut adjacency = vec![vec![0; n]; n];
    for i in 0..n {
        for j in 0..i {
            let is_edge = rng.random_range(0..2) == 0;
            adjacency[i][j] = i64::from(is_edge);
            adjacency[j][i] = i64::from(is_edge);
        }
    }

    let identity = Sparse::identity(n);
    let minus_identity = identity.add_scaled(&whole(-2), &identity);
    Pencil::new(sparse(&adjacency), minus_identity, Vec::new())
}

/// B = I and A of small integers: standard eigenvalues, often repeated, often zero.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn identity(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a = drawn(n, || rng.random_range(-2..=1));
    Pencil::new(sparse(&a), Sparse::identity(n), Vec::new())
}

/// Zeros and units with free variables anywhere, A_ff possibly singular: outside Propositions 1 and
/// 2.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn free_anywhere(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    const ENTRIES: [i64; 8] = [0, 0, 0, 1, -1, 1, -1, 2];
    let mut free = Vec::new();
    for i in 0..n {
        if rng.random_range(0..3) == 0 {
            free.push(i);
        }
    }

    let a = drawn_from(&ENTRIES, rng, n);
    let b = drawn_from(&ENTRIES, rng, n);
    Pencil::new(sparse(&a), sparse(&b), free)
}

/// A pencil without free variables, of one of the kinds above by its number.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn of_kind(rng: &mut ChaCha8Rng, kind: u64, n: usize) -> Result<Pencil, ModelError> {
    match kind % 5 {
        0 => digits(rng, n, 0),
        1 => zeros(rng, n),
        2 => doubled(rng, n.max(2)),
        3 => graph(rng, n),
        _ => identity(rng, n),
    }
}

/// A + tB + t^2 C of digits up to 3. What may go wrong is chosen by `kind`: nothing in particular,
/// many zeros, a support that is singular for every t, double roots, one row in C or none, C = I.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn quadratic(rng: &mut ChaCha8Rng, kind: u64, n: usize) -> Result<QuadraticPencil, ModelError> {
    let mut matrices: [_; 3] = std::array::from_fn(|_| drawn(n, || rng.random_range(-3..=3)));
    let pivot = rng.random_range(0..n.max(1));
    let other = rng.random_range(0..n.max(1));
    let root = rng.random_range(-3..=3);
    for (power, matrix) in matrices.iter_mut().enumerate() {
        match kind % 6 {
            1 => matrix.iter_mut().flatten().for_each(|v| *v = (*v).max(0)),
            2 => {
                matrix[other] = matrix[pivot].clone();
                matrix.iter_mut().for_each(|row| row[other] = row[pivot]);
            }
            3 => {
                // Row i is (t - root)^2 on the diagonal and what is above it.
                for (i, row) in matrix.iter_mut().enumerate() {
                    row[..i].fill(0);
                    row[i] = [root * root, -2 * root, 1][power];
                }
            }
            4 if power == 2 => {
                for (i, row) in matrix.iter_mut().enumerate() {
                    let is_kept = i == pivot && root > 0;
                    row.iter_mut().for_each(|v| *v *= i64::from(is_kept));
                }
            }
            5 if power == 2 => {
                for (i, row) in matrix.iter_mut().enumerate() {
                    row.fill(0);
                    row[i] = 1;
                }
            }
            _ => {}
        }
    }

    let [a, b, c] = matrices.map(|rows| sparse(&rows));
    QuadraticPencil::new(a, b, c)
}

/// Numbers with denominators, rows and columns of very different size.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn fractions(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a = matrix(n, |i, j| scaled_fraction(rng, i, j));
    let b = matrix(n, |i, j| scaled_fraction(rng, i, j));
    Pencil::new(a, b, Vec::new())
}

/// A fraction of up to three digits over two, times 10^(i + 2j).
fn scaled_fraction(rng: &mut ChaCha8Rng, i: usize, j: usize) -> Rational {
    let numerator = rng.random_range(-999..=999);
    let denominator = rng.random_range(1..=99);
    let scale = 10i64.pow((i + 2 * j) as u32);
    rational(numerator, denominator) * whole(scale)
}

/// Signs alone: every entry 1 or -1, each with probability 1/2.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn signs(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a = drawn(n, || sign(rng));
    let b = drawn(n, || sign(rng));
    Pencil::new(sparse(&a), sparse(&b), Vec::new())
}

/// 1 or -1 with the same probability.
fn sign(rng: &mut ChaCha8Rng) -> i64 {
    if rng.random_range(0..2) == 0 { 1 } else { -1 }
}
