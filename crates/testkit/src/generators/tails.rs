//! Pencils whose last interval is hard: masses that are not definite, not everywhere, or of low
//! rank.

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
    let friction = |rng: &mut ChaCha8Rng, m: &mut [Vec<i64>], most: i64| {
        m[n_f..]
            .iter_mut()
            .flatten()
            .for_each(|v| *v += rng.random_range(-most..=most));
    };

    let mut a = gram(rng, n, 1);
    friction(rng, &mut a, 18);

    let mut b = gram(rng, n, 1);
    match mass {
        Mass::Coupled => friction(rng, &mut b, 12),
        Mass::Indefinite => {
            for (i, row) in b.iter_mut().enumerate() {
                let from = if i < n_f { n_f } else { 0 };
                row[from..]
                    .iter_mut()
                    .for_each(|v| *v = rng.random_range(-9..=9));
            }
        }
        Mass::Partial => {
            let has_mass: Vec<bool> = (0..n).map(|_| rng.random_range(0..5) < 3).collect();
            let entries = b
                .iter_mut()
                .enumerate()
                .flat_map(|(i, row)| row.iter_mut().enumerate().map(move |(j, v)| (i, j, v)));
            entries
                .filter(|(i, j, _)| !has_mass[*i] || !has_mass[*j])
                .for_each(|(_, _, v)| *v = 0);
        }
    }

    Pencil::new(sparse(&a), sparse(&b), (0..n_f).collect())
}
