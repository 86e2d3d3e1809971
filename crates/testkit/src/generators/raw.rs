//! Raw pencils: as finite elements have them, one-digit integers, mostly zeros, twins, graphs, free
//! variables anywhere.

use super::{gram, sparse};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{ModelError, Pencil, Unknown};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// K0 = GG' + I, K1 with zero free rows, M = GG' + I: as finite elements have it.
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
    let (k0, mass) = (gram(rng, n, 1), gram(rng, n, 1));
    let mut k1: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect())
        .collect();
    k1[..n_f].iter_mut().for_each(|r| r.fill(0));

    let (a, b) = match unknown {
        Unknown::Mu => (sparse(&k0), sparse(&k1)),
        Unknown::Lambda2 => (
            sparse(&k0).add_scaled(&rational(rng.random_range(1..=9), 3), &sparse(&k1)),
            sparse(&mass),
        ),
    };

    Pencil::new(a, b, (0..n_f).collect())
}

/// One-digit integers, A and B arbitrary; with free variables A_ff definite, B_ff = 0.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn digits(rng: &mut ChaCha8Rng, n_s: usize, n_f: usize) -> Result<Pencil, ModelError> {
    let n = n_s + n_f;
    let mut draw = || -> Vec<Vec<i64>> {
        (0..n)
            .map(|_| (0..n).map(|_| rng.random_range(-9..=9)).collect())
            .collect()
    };

    let (mut a, mut b) = (draw(), draw());
    let ff = gram(rng, n_f, 1);

    for i in 0..n_f {
        a[i][..n_f].copy_from_slice(&ff[i]);
        b[i].fill(0);
    }

    Pencil::new(sparse(&a), sparse(&b), (0..n_f).collect())
}

/// Three quarters zeros: singular supports, repeated roots, ties.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn zeros(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut draw = || -> Vec<Vec<i64>> {
        (0..n)
            .map(|_| {
                (0..n)
                    .map(|_| [0, 0, 0, 1, 0, 0, 0, -1][rng.random_range(0..8)])
                    .collect()
            })
            .collect()
    };

    Pencil::new(sparse(&draw()), sparse(&draw()), Vec::new())
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

    let twin = |m: Vec<Vec<i64>>| -> Vec<Vec<i64>> {
        let of = |i: usize| i.min(n - 2);
        (0..n)
            .map(|i| (0..n).map(|j| m[of(i)][of(j)]).collect())
            .collect()
    };

    let mut draw = || -> Vec<Vec<i64>> {
        (0..n)
            .map(|_| (0..n).map(|_| rng.random_range(-3..=3)).collect())
            .collect()
    };

    Pencil::new(sparse(&twin(draw())), sparse(&twin(draw())), Vec::new())
}

/// (A - 2 - t) x = y, A the adjacency matrix of a random graph: repeated values, integers, cones.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn graph(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut a = vec![vec![0; n]; n];
    for i in 0..n {
        for j in 0..i {
            (a[i][j], a[j][i]) = if rng.random_range(0..2) == 0 {
                (1, 1)
            } else {
                (0, 0)
            };
        }
    }

    Pencil::new(
        sparse(&a),
        Sparse::identity(n).add_scaled(&whole(-2), &Sparse::identity(n)),
        Vec::new(),
    )
}

/// B = I and A of small integers: standard eigenvalues, often repeated, often zero.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn identity(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| rng.random_range(-2..=1)).collect())
        .collect();
    Pencil::new(sparse(&a), Sparse::identity(n), Vec::new())
}

/// Zeros and units with free variables anywhere, A_ff possibly singular: outside Propositions 1 and
/// 2.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn free_anywhere(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let free = (0..n).filter(|_| rng.random_range(0..3) == 0).collect();
    let mut draw = || -> Vec<Vec<i64>> {
        (0..n)
            .map(|_| {
                (0..n)
                    .map(|_| [0, 0, 0, 1, -1, 1, -1, 2][rng.random_range(0..8)])
                    .collect()
            })
            .collect()
    };

    Pencil::new(sparse(&draw()), sparse(&draw()), free)
}

/// Numbers with denominators, rows and columns of very different size.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn fractions(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut entry = |i: usize, j: usize| -> Rational {
        rational(rng.random_range(-999..=999), rng.random_range(1..=99))
            * whole(10i64.pow((i + 2 * j) as u32))
    };

    let mut draw = || {
        Sparse::from_entries(
            n,
            n,
            (0..n * n)
                .map(|k| (k / n, k % n, entry(k / n, k % n)))
                .collect::<Vec<_>>(),
        )
    };

    Pencil::new(draw(), draw(), Vec::new())
}

/// Signs alone: every entry 1 or -1, by the pattern of the index's bits where they suffice.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn signs(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut draw = || -> Vec<Vec<i64>> {
        (0..n)
            .map(|_| {
                (0..n)
                    .map(|_| if rng.random_range(0..2) == 0 { 1 } else { -1 })
                    .collect()
            })
            .collect()
    };

    Pencil::new(sparse(&draw()), sparse(&draw()), Vec::new())
}
