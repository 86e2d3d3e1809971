//! Ill-conditioned, huge and tiny: hard in doubles, and no different in exact arithmetic.
//!
//! Input: a source of random numbers and the order; the free variables come first. Output: pencils
//! whose condition number is large, or whose entries differ in size by many decades. Called by the
//! campaign's families `scales`, `integers` and `doubles`.

use super::raw::{elements, of_elements};
use super::{matrix, power_of_ten, rebuilt};
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
    let k0 = hilbert_section(n, rng.random_range(1..=3));
    let mass = hilbert_section(n, rng.random_range(1..=3));

    // The free rows of K1 vanish (16).
    let mut entries = Vec::new();
    for i in n_f..n {
        for j in 0..n {
            entries.push((i, j, whole(rng.random_range(-4..=4))));
        }
    }
    let k1 = Sparse::from_entries(n, n, entries);

    of_elements(unknown, n_f, [k0, k1, mass], || {
        rational(rng.random_range(1..=20), 10)
    })
}

/// The matrix of all 1 / (i + j + from).
fn hilbert_section(n: usize, from: i64) -> Sparse {
    matrix(n, |i, j| {
        let denominator = (i + j) as i64 + from;
        rational(1, denominator)
    })
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
    let mut d = Vec::new();
    for _ in 0..pencil.order() {
        d.push(power_of_ten(rng.random_range(-4..=4)));
    }

    Ok(rebuilt(&pencil, &|i, j, v| v * &d[i] * &d[j]))
}

/// Powers of ten by which the matrices of a pencil are multiplied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exponents {
    /// A is multiplied by 10 to this power.
    pub a: i32,
    /// B is multiplied by 10 to this power.
    pub b: i32,
}

/// The pencil of finite elements with A and B each multiplied by one power of ten.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn scaled(
    unknown: Unknown,
    rng: &mut ChaCha8Rng,
    n_s: usize,
    n_f: usize,
    exponents: Exponents,
) -> Result<Pencil, ModelError> {
    let pencil = elements(unknown, rng, n_s, n_f)?;
    let a = times_power_of_ten(pencil.a(), exponents.a);
    let b = times_power_of_ten(pencil.b(), exponents.b);
    Pencil::new(a, b, pencil.free().to_vec())
}

/// 10^exponent times the matrix.
fn times_power_of_ten(matrix: &Sparse, exponent: i32) -> Sparse {
    let zero = Sparse::zeros(matrix.rows(), matrix.cols());
    zero.add_scaled(&power_of_ten(exponent), matrix)
}

/// Integers of up to six digits.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn integers(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a = matrix(n, |_, _| six_digits(rng));
    let b = matrix(n, |_, _| six_digits(rng));
    Pencil::new(a, b, Vec::new())
}

/// An integer of up to six digits, of either sign.
fn six_digits(rng: &mut ChaCha8Rng) -> Rational {
    let value = rng.random_range(-999_999..=999_999);
    whole(value)
}

/// Doubles with all of their 53 bits, read exactly, the size of each spread over six decades.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn doubles(rng: &mut ChaCha8Rng, n: usize) -> Result<Pencil, ModelError> {
    let a = matrix(n, |_, _| random_double(rng));
    let b = matrix(n, |_, _| random_double(rng));
    Pencil::new(a, b, Vec::new())
}

/// A double between -1 and 1, times a power of ten from 1e-3 to 1e3.
fn random_double(rng: &mut ChaCha8Rng) -> Rational {
    let size = 10f64.powi(rng.random_range(-3..=3));
    let value = (2.0 * rng.random::<f64>() - 1.0) * size;
    from_f64(value).unwrap_or_default() // finite
}
