//! The lowest natural frequencies of a body, in doubles.
//!
//! ```text
//! K v = omega^2 M v,   K and M symmetric positive definite,   frequency = omega / (2 pi)
//! ```
//!
//! by subspace iteration: X becomes K^-1 M X, made M-orthonormal, until the smallest eigenvalues of
//! X' K X (the Ritz values) stand still. Used by `plausibility`; nothing here is certified.
#![allow(clippy::float_arithmetic)]

use crate::doubles::DoubleMatrix;
use crate::tolerance::{RITZ_CHANGE, RITZ_ROUNDING, RITZ_STEPS};
use mceip_mcp::linear::{SparseLu, definite_eigenvalues};

/// How many frequencies are looked for.
const WANTED: usize = 3;

/// Columns of X beyond those wanted: the iteration converges as fast as the first frequency left
/// out is far away.
const SPARE: usize = 5;

/// At most three frequencies, ascending, in cycles per unit of time.
///
/// `None` where K has no LU factors in doubles, M is not positive definite there, the iteration
/// does not settle, or rounding hides the lowest one.
pub(crate) fn lowest_frequencies(
    stiffness: &DoubleMatrix,
    mass: &DoubleMatrix,
) -> Option<Vec<f64>> {
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
            let rounding = rounding(stiffness, &basis);
            if ritz
                .first()
                .is_some_and(|lowest| rounding > RITZ_ROUNDING * lowest)
            {
                return None;
            }
            return Some(ritz[..wanted].iter().map(|t| frequency(*t)).collect());
        }
        previous = ritz[..wanted].to_vec();
    }

    None
}

fn frequency(omega_squared: f64) -> f64 {
    omega_squared.max(0.0).sqrt() / std::f64::consts::TAU
}

/// Random vectors, the same in every run, by a linear congruential generator.
fn first_vectors(order: usize, columns: usize) -> Vec<Vec<f64>> {
    let mut state: u64 = 1;
    let mut entry = || {
        // The constants are Knuth's (MMIX).
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 32) as f64 / f64::from(u32::MAX) - 0.5
    };

    let mut vectors = vec![vec![0.0; order]; columns];
    for value in vectors.iter_mut().flatten() {
        *value = entry();
    }

    vectors
}

/// The vectors made orthonormal in the inner product x' M y, by Gram and Schmidt, twice for the
/// sake of rounding.
fn orthonormal(vectors: Vec<Vec<f64>>, mass: &DoubleMatrix) -> Option<Vec<Vec<f64>>> {
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
fn scale(vector: &mut [f64], mass: &DoubleMatrix) -> Option<Vec<f64>> {
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
fn ritz_values(stiffness: &DoubleMatrix, basis: &[Vec<f64>]) -> Option<Vec<f64>> {
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

/// What rounding may leave in an entry of X' K X: its terms without their signs.
fn rounding(stiffness: &DoubleMatrix, basis: &[Vec<f64>]) -> f64 {
    let mut largest: f64 = 0.0;
    for x in basis {
        let entries = stiffness.entries.iter();
        let terms: f64 = entries.map(|&(i, j, k)| (x[i] * k * x[j]).abs()).sum();
        largest = largest.max(terms);
    }

    f64::EPSILON * largest
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
    fn chain(n: usize) -> DoubleMatrix {
        let mut entries = Vec::new();
        for i in 0..n {
            entries.push((i, i, 2.0));
            if i > 0 {
                entries.push((i, i - 1, -1.0));
                entries.push((i - 1, i, -1.0));
            }
        }

        DoubleMatrix { order: n, entries }
    }

    fn unit_masses(n: usize) -> DoubleMatrix {
        let entries = (0..n).map(|i| (i, i, 1.0)).collect();
        DoubleMatrix { order: n, entries }
    }

    #[test]
    fn a_chain_has_its_frequencies() {
        for n in [1, 2, 3, 4, 5, 6, 7, 8, 13, 40, 144, 300] {
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

    /// Two unit masses, each on a unit spring, tied by a stiff one: omega = 1 where doubles see it.
    #[test]
    fn digits_that_rounding_hides_are_not_given() {
        let tied = |spring: f64| {
            let entries = vec![
                (0, 0, 1.0 + spring),
                (0, 1, -spring),
                (1, 0, -spring),
                (1, 1, 1.0 + spring),
            ];
            lowest_frequencies(&DoubleMatrix { order: 2, entries }, &unit_masses(2))
        };

        let found = tied(1e6).unwrap();
        assert!((found[0] * std::f64::consts::TAU - 1.0).abs() < 1e-6);
        assert_eq!(tied(1e14), None);
    }

    #[test]
    fn nothing_to_iterate_on_and_no_mass() {
        assert_eq!(lowest_frequencies(&chain(0), &unit_masses(0)), Some(vec![]));
        let massless = DoubleMatrix {
            order: 2,
            entries: vec![],
        };
        assert_eq!(lowest_frequencies(&chain(2), &massless), None);
    }
}
