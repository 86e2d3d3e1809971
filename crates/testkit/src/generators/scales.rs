//! Ill-conditioned, huge and tiny: what floats dislike and exact arithmetic does not notice.

use super::raw::elements;
use super::{power_of_ten, rebuilt};
use mceip_exact::{Rational, Sparse, from_f64, rational, whole};
use mceip_model::{ModelError, Pencil, Unknown};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// K0 a section of the Hilbert matrix (condition number about 30^n), K1 of digits, M another
/// section.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn hilbert(
    unknown: Unknown,
    rng: &mut ChaCha8Rng,
    n_s: usize,
    n_f: usize,
) -> Result<Pencil, ModelError> {
    let n = n_s + n_f;
    let section = |from: i64| {
        Sparse::from_entries(
            n,
            n,
            (0..n * n).map(|k| (k / n, k % n, rational(1, (k / n + k % n) as i64 + from))),
        )
    };

    let (k0, mass) = (
        section(rng.random_range(1..=3)),
        section(rng.random_range(1..=3)),
    );

    let k1 = Sparse::from_entries(
        n,
        n,
        (n_f * n..n * n)
            .map(|k| (k / n, k % n, whole(rng.random_range(-4..=4))))
            .collect::<Vec<_>>(),
    );

    let (a, b) = match unknown {
        Unknown::Mu => (k0, k1),
        Unknown::Lambda2 => (
            k0.add_scaled(&rational(rng.random_range(1..=20), 10), &k1),
            mass,
        ),
    };

    Pencil::new(a, b, (0..n_f).collect())
}

/// The pencil of finite elements with rows and columns scaled by powers of ten from 1e-4 to 1e4: D
/// A D, D B D.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn badly_scaled(
    unknown: Unknown,
    rng: &mut ChaCha8Rng,
    n_s: usize,
    n_f: usize,
) -> Result<Pencil, ModelError> {
    let pencil = elements(unknown, rng, n_s, n_f)?;
    let d: Vec<Rational> = (0..n_s + n_f)
        .map(|_| power_of_ten(rng.random_range(-4..=4)))
        .collect();

    Ok(rebuilt(&pencil, &|i, j, v| v * &d[i] * &d[j]))
}

/// The pencil of finite elements with A and B each multiplied by one power of ten; `exponents` for
/// A and B.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn scaled(
    unknown: Unknown,
    rng: &mut ChaCha8Rng,
    order: (usize, usize),
    exponents: (i32, i32),
) -> Result<Pencil, ModelError> {
    let pencil = elements(unknown, rng, order.0, order.1)?;
    let by = |m: &Sparse, k: i32| Sparse::zeros(m.rows(), m.cols()).add_scaled(&power_of_ten(k), m);
    Pencil::new(
        by(pencil.a(), exponents.0),
        by(pencil.b(), exponents.1),
        pencil.free().to_vec(),
    )
}

/// Integers of up to six digits.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn integers(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut draw = || {
        Sparse::from_entries(
            n,
            n,
            (0..n * n)
                .map(|k| (k / n, k % n, whole(rng.random_range(-999_999..=999_999))))
                .collect::<Vec<_>>(),
        )
    };

    Pencil::new(draw(), draw(), Vec::new())
}

/// Doubles with all of their 53 bits, read exactly, the size of each spread over six decades.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn doubles(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let mut entry = || {
        let size = 10f64.powi(rng.random_range(-3..=3));
        from_f64((2.0 * rng.random::<f64>() - 1.0) * size).unwrap_or_default() // finite
    };

    let mut draw = || {
        Sparse::from_entries(
            n,
            n,
            (0..n * n)
                .map(|k| (k / n, k % n, entry()))
                .collect::<Vec<_>>(),
        )
    };

    Pencil::new(draw(), draw(), Vec::new())
}
