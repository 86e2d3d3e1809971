//! Pencils whose last interval [t, infinity) is hard to exclude: masses that are not definite, not
//! everywhere, or of low rank.
//!
//! A complete search closes the tail of the window where M* is definite. Here it is not. Input: a
//! source of random numbers, the order, the kind of mass. Called by tests of the complete search.

use super::{gram, sparse};
use mceip_model::{ModelError, Pencil};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// What the mass matrix of [`tails`] is like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mass {
    /// Definite, and coupled by friction: M* = M + mu M1, the symmetric part of which may be
    /// indefinite.
    Coupled,
    /// Arbitrary digits, but definite on the free variables.
    Indefinite,
    /// Zero in the rows and columns of some variables.
    Partial,
}

/// K* and M* with `n_f` free variables first and `n_s` of the other kind.
///
/// # Errors
/// [`ModelError`] for no variables.
pub fn tails(
    rng: &mut ChaCha8Rng,
    n_s: usize,
    n_f: usize,
    mass: Mass,
) -> Result<Pencil, ModelError> {
    let n = n_s + n_f;
    let mut a = gram(rng, n, 1);
    add_friction(rng, &mut a[n_f..], 18);

    let mut b = gram(rng, n, 1);
    match mass {
        Mass::Coupled => add_friction(rng, &mut b[n_f..], 12),
        Mass::Indefinite => draw_all_but_the_free_block(rng, &mut b, n_f),
        Mass::Partial => take_the_mass_of_some(rng, &mut b),
    }

    Pencil::new(sparse(&a), sparse(&b), (0..n_f).collect())
}

/// Adds integers from -most to most to the rows of the complementarity variables.
fn add_friction(rng: &mut ChaCha8Rng, rows: &mut [Vec<i64>], most: i64) {
    for value in rows.iter_mut().flatten() {
        *value += rng.random_range(-most..=most);
    }
}

/// Replaces every entry outside the block of the free variables by a digit of either sign.
fn draw_all_but_the_free_block(rng: &mut ChaCha8Rng, rows: &mut [Vec<i64>], n_f: usize) {
    for (i, row) in rows.iter_mut().enumerate() {
        let first = if i < n_f { n_f } else { 0 };
        for value in &mut row[first..] {
            *value = rng.random_range(-9..=9);
        }
    }
}

/// Sets rows and columns to zero, each variable's with probability 2/5.
fn take_the_mass_of_some(rng: &mut ChaCha8Rng, rows: &mut [Vec<i64>]) {
    let has_mass: Vec<bool> = rows.iter().map(|_| rng.random_range(0..5) < 3).collect();
    for (i, row) in rows.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            if !has_mass[i] || !has_mass[j] {
                *value = 0;
            }
        }
    }
}
