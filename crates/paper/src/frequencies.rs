//! The lowest natural frequencies of a body, in doubles.
//!
//! ```text
//! K v = omega^2 M v,   K and M symmetric positive definite,   frequency = omega / (2 pi)
//! ```
//!
//! by subspace iteration: X becomes K^-1 M X, made M-orthonormal, until the smallest eigenvalues of
//! X' K X (the Ritz values) stand still. Used by `plausibility`; nothing here is certified.
#![allow(clippy::float_arithmetic)]

use crate::tolerance::{RITZ_CHANGE, RITZ_STEPS};
use mceip_mcp::linear::{SparseLu, definite_eigenvalues};

/// How many frequencies are looked for.
const WANTED: usize = 3;

/// Columns of X beyond those wanted: the iteration converges as fast as the first frequency left
/// out is far away.
const SPARE: usize = 5;

/// A sparse square matrix in doubles.
pub(crate) struct Doubles {
    /// Rows and columns.
    pub(crate) order: usize,
    /// (row, column, value), each place once.
    pub(crate) entries: Vec<(usize, usize, f64)>,
}

impl Doubles {
    /// The product with a vector of length `order`.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.order];
        for &(row, column, value) in &self.entries {
            product[row] += value * x[column];
        }

        product
    }
}

/// At most three frequencies, ascending, in cycles per unit of time.
///
/// `None` where K or M is not positive definite in doubles or the iteration does not settle.
pub(crate) fn lowest_frequencies(stiffness: &Doubles, mass: &Doubles) -> Option<Vec<f64>> {
    let order = stiffness.order;
    let wanted = order.min(WANTED);
    let columns = order.min(WANTED + SPARE);
    let factors = SparseLu::new(order, stiffness.entries.iter().copied())?;

    let mut basis = orthonormal(first_vectors(order, columns), mass)?;
    let mut previous = vec![f64::INFINITY; wanted];
    for _ in 0..RITZ_STEPS {
        let mut next: Vec<Vec<f64>> = basis.iter().map(|x| mass.times(x)).collect();
        factors.solve(&mut next);
        basis = orthonormal(next, mass)?;

        let ritz = ritz_values(stiffness, &basis)?;
        if has_settled(&previous, &ritz) {
            return Some(ritz[..wanted].iter().map(|t| frequency(*t)).collect());
        }
        previous = ritz[..wanted].to_vec();
    }

    None
}

fn frequency(omega_squared: f64) -> f64 {
    omega_squared.max(0.0).sqrt() / std::f64::consts::TAU
}

/// Vectors without a pattern, the same in every run.
fn first_vectors(order: usize, columns: usize) -> Vec<Vec<f64>> {
    // The fractional parts of multiples of the golden ratio.
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let entry = |k: usize| (golden * (k + 1) as f64).fract() - 0.5;

    let vector = |column: usize| (0..order).map(|i| entry(column * order + i)).collect();
    (0..columns).map(vector).collect()
}

/// The vectors made orthonormal in the inner product x' M y, by Gram and Schmidt, twice for the
/// sake of rounding.
fn orthonormal(vectors: Vec<Vec<f64>>, mass: &Doubles) -> Option<Vec<Vec<f64>>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut images: Vec<Vec<f64>> = Vec::new();
    for mut vector in vectors {
        for _ in 0..2 {
            scale(&mut vector, mass)?;
            for (known, image) in basis.iter().zip(&images) {
                let component = dot(&vector, image);
                subtract(&mut vector, component, known);
            }
        }

        let image = scale(&mut vector, mass)?;
        basis.push(vector);
        images.push(image);
    }

    Some(basis)
}

/// Divides a vector by its length in M, and gives M times it; none for a vector without length.
fn scale(vector: &mut [f64], mass: &Doubles) -> Option<Vec<f64>> {
    let mut image = mass.times(vector);
    let length = dot(vector, &image).sqrt();
    if !length.is_normal() {
        return None;
    }

    for value in vector.iter_mut().chain(&mut image) {
        *value /= length;
    }
    Some(image)
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

fn subtract(vector: &mut [f64], factor: f64, other: &[f64]) {
    for (value, known) in vector.iter_mut().zip(other) {
        *value -= factor * known;
    }
}

/// The eigenvalues of X' K X for M-orthonormal columns X, ascending.
fn ritz_values(stiffness: &Doubles, basis: &[Vec<f64>]) -> Option<Vec<f64>> {
    let n = basis.len();
    let images: Vec<Vec<f64>> = basis.iter().map(|x| stiffness.times(x)).collect();

    let mut projected = vec![vec![0.0; n]; n];
    let mut identity = vec![vec![0.0; n]; n];
    for row in 0..n {
        identity[row][row] = 1.0;
        for column in 0..n {
            projected[row][column] = dot(&basis[row], &images[column]);
        }
    }

    definite_eigenvalues(&projected, &identity)
}

/// Have the values wanted changed by rounding only?
fn has_settled(previous: &[f64], ritz: &[f64]) -> bool {
    let pairs = previous.iter().zip(ritz);
    pairs
        .into_iter()
        .all(|(old, new)| (old - new).abs() <= RITZ_CHANGE * new.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of n unit masses between two walls, by unit springs: omega = 2 sin(k pi / (2n + 2)).
    fn chain(n: usize) -> Doubles {
        let mut entries = Vec::new();
        for i in 0..n {
            entries.push((i, i, 2.0));
            if i > 0 {
                entries.push((i, i - 1, -1.0));
                entries.push((i - 1, i, -1.0));
            }
        }

        Doubles { order: n, entries }
    }

    fn unit_masses(n: usize) -> Doubles {
        let entries = (0..n).map(|i| (i, i, 1.0)).collect();
        Doubles { order: n, entries }
    }

    #[test]
    fn a_chain_has_its_frequencies() {
        for n in [1, 2, 3, 7, 40, 300] {
            let found = lowest_frequencies(&chain(n), &unit_masses(n)).unwrap();

            assert_eq!(found.len(), n.min(3));
            for (k, frequency) in found.iter().enumerate() {
                let angle = (k + 1) as f64 * std::f64::consts::PI / (2 * n + 2) as f64;
                let omega = 2.0 * angle.sin();
                let error = frequency * std::f64::consts::TAU / omega - 1.0;
                assert!(error.abs() < 1e-6, "n = {n}, {k}: {error}");
            }
        }
    }

    #[test]
    fn nothing_to_iterate_on_and_no_mass() {
        assert_eq!(lowest_frequencies(&chain(0), &unit_masses(0)), Some(vec![]));
        let massless = Doubles {
            order: 2,
            entries: vec![],
        };
        assert_eq!(lowest_frequencies(&chain(2), &massless), None);
    }
}
