//! Mechanical systems with every mixture of contact states, one after the other.

use super::{gram, sparse};
use crate::families::Corner;
use mceip_exact::{Rational, rational};
use mceip_model::{ContactState, ModelError, Particle, System};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// The states of one particle.
const STATES: [ContactState; 4] = [
    ContactState::Slip { sign: 1 },
    ContactState::Slip { sign: -1 },
    ContactState::Stick,
    ContactState::Free,
];

/// Mixtures of one to three particles in which one slips: 4 + 16 + 64 less those without slip (2 +
/// 4 + 8).
pub const MIXTURES: u64 = 70;

/// The `number`-th mixture, counted modulo [`MIXTURES`].
pub fn mixture(number: u64) -> Vec<ContactState> {
    let all = (1..=3u32).flat_map(|p| {
        (0..4usize.pow(p)).map(move |code| {
            (0..p)
                .map(|k| STATES[code / 4usize.pow(k) % 4])
                .collect::<Vec<ContactState>>()
        })
    });

    let slips = |m: &Vec<ContactState>| m.iter().any(|s| matches!(s, ContactState::Slip { .. }));
    all.filter(slips)
        .nth((number % MIXTURES) as usize)
        .unwrap_or_default()
}

/// A random system with these states: K and M definite, frames and normals of every kind, up to two
/// inner dofs, numbered in a random order. The corners it reaches are appended.
///
/// # Errors
/// [`ModelError`]; none for states among which one slips.
pub fn system(
    rng: &mut ChaCha8Rng,
    states: &[ContactState],
    corners: &mut Vec<Corner>,
) -> Result<System, ModelError> {
    let n = 2 * states.len() + rng.random_range(0..=2);
    let mut dofs: Vec<usize> = (0..n).collect();

    for i in (1..n).rev() {
        dofs.swap(i, rng.random_range(0..=i));
    }

    let particles = states.iter().enumerate().map(|(k, &state)| {
        let mut particle = Particle::plain(dofs[2 * k], dofs[2 * k + 1], state);
        particle.normal_direction = if rng.random_range(0..2) == 0 { 1 } else { -1 };

        if rng.random_range(0..3) == 0 {
            particle.frame = Some(rotation(rng));
            corners.push(Corner::Oblique);
        }

        match state {
            ContactState::Stick => corners.push(Corner::Stick),
            ContactState::Free => corners.push(Corner::FreeVariables),
            ContactState::Slip { .. } => {}
        }

        particle
    });

    let particles: Vec<Particle> = particles.collect();
    let mass = if rng.random_range(0..2) == 0 {
        (0..n)
            .map(|i| (0..n).map(|j| if i == j { 3 } else { 0 }).collect())
            .collect()
    } else {
        corners.push(Corner::CoupledMass);
        gram(rng, n, 1)
    };

    let friction = rational(rng.random_range(1..=80), 4);
    System::new(
        sparse(&gram(rng, n, 1)),
        Some(sparse(&mass)),
        Some(friction),
        particles,
    )
}

/// A rotation from a Pythagorean triple, in any of the four quadrants.
fn rotation(rng: &mut ChaCha8Rng) -> [[Rational; 2]; 2] {
    let (c, s, h) = [
        (3, 4, 5),
        (4, 3, 5),
        (5, 12, 13),
        (-3, 4, 5),
        (-8, -15, 17),
        (20, -21, 29),
    ][rng.random_range(0..6)];

    let (c, s) = (rational(c, h), rational(s, h));
    [[c.clone(), s.clone()], [-s, c]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mixture_occurs_once() {
        let words = |m: Vec<ContactState>| format!("{m:?}");
        let all: std::collections::BTreeSet<String> =
            (0..MIXTURES).map(|k| words(mixture(k))).collect();
        assert_eq!(all.len() as u64, MIXTURES);
        assert!(!all.contains("[]"));
        assert_eq!(mixture(MIXTURES), mixture(0));
    }
}
