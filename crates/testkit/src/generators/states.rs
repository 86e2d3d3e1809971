//! Mechanical systems with every mixture of contact states, one after the other.
//!
//! Input: the number of a mixture, a source of random numbers. Output: a system (1)-(9) with these
//! states, positive definite K and M, and the corners that it reaches. Called by the campaign's
//! family `states` and by tests.

use super::{gram, random_order, sparse};
use crate::families::Corner;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{ContactState, Curvature, ModelError, Particle, Reduced, System};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::ops::RangeInclusive;

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
    let mut place = (number % MIXTURES) as usize;
    for particles in 1..=3u32 {
        for code in 0..4usize.pow(particles) {
            let states = decoded(code, particles);
            if !states.iter().any(is_slip) {
                continue;
            }
            if place == 0 {
                return states;
            }
            place -= 1;
        }
    }

    Vec::new()
}

/// The states whose places in [`STATES`] are the digits of `code` to the base 4, lowest first.
fn decoded(code: usize, particles: u32) -> Vec<ContactState> {
    (0..particles)
        .map(|k| STATES[code / 4usize.pow(k) % 4])
        .collect()
}

fn is_slip(state: &ContactState) -> bool {
    matches!(state, ContactState::Slip { .. })
}

/// One to `most_slip` particles that slip, one or two with zero reaction, and one that sticks and
/// one that is free, each in one of `rarity` mixtures.
fn mixture_with_zero(rng: &mut ChaCha8Rng, most_slip: usize, rarity: u32) -> Vec<ContactState> {
    let mut states = Vec::new();
    for _ in 0..rng.random_range(1..=most_slip) {
        let sign = if rng.random_range(0..2) == 0 { 1 } else { -1 };
        states.push(ContactState::Slip { sign });
    }
    states.extend(vec![ContactState::Zero; rng.random_range(1..=2)]);

    for beside in [ContactState::Stick, ContactState::Free] {
        if rng.random_range(0..rarity) == 0 {
            states.push(beside);
        }
    }

    states
}

/// A random system of `mixture_with_zero`, of a family of random problems that only tests have.
///
/// # Errors
/// [`ModelError`]; none.
pub fn system_with_zero(
    family: u64,
    index: u64,
    most_slip: usize,
    rarity: u32,
) -> Result<System, ModelError> {
    let mut rng = super::rng(family, index);
    let states = mixture_with_zero(&mut rng, most_slip, rarity);
    system(&mut rng, &states, &mut Vec::new())
}

/// How often particles with zero reaction do each thing that they can.
#[derive(Debug, Clone, Copy, Default)]
pub struct ZeroModes {
    /// They leave the obstacle.
    pub open: usize,
    /// They rest.
    pub sticking: usize,
    /// They slide along their tangent.
    pub right: usize,
    /// They slide against it.
    pub left: usize,
}

impl ZeroModes {
    /// Counts what each of them does in a solution with this support.
    pub fn count(&mut self, split: &Reduced, support: &[usize]) {
        for variables in &split.zero {
            let mode = if support.contains(&variables.gap) {
                &mut self.open
            } else if support.contains(&variables.right) {
                &mut self.right
            } else if support.contains(&variables.left) {
                &mut self.left
            } else {
                &mut self.sticking
            };
            *mode += 1;
        }
    }

    /// How often the rarest of them was counted.
    pub fn rarest(self) -> usize {
        let ZeroModes {
            open,
            sticking,
            right,
            left,
        } = self;
        open.min(sticking).min(right).min(left)
    }
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
    let dofs = random_order(rng, n);

    let mut particles = Vec::new();
    for (k, &state) in states.iter().enumerate() {
        let plain = Particle::plain(dofs[2 * k], dofs[2 * k + 1], state);
        particles.push(turned(rng, plain, rotation, corners));
    }

    of_particles(rng, n, particles, (3, 1..=80), corners)
}

/// A random system of n degrees of freedom with these particles: K = GG' + I, M another one or
/// `lumped` I, mu one of `quarters`.
pub(crate) fn of_particles(
    rng: &mut ChaCha8Rng,
    n: usize,
    particles: Vec<Particle>,
    (lumped, quarters): (i64, RangeInclusive<i64>),
    corners: &mut Vec<Corner>,
) -> Result<System, ModelError> {
    let is_lumped = rng.random_range(0..2) == 0;
    let mass = if is_lumped {
        Sparse::zeros(n, n).add_scaled(&whole(lumped), &Sparse::identity(n))
    } else {
        corners.push(Corner::CoupledMass);
        sparse(&gram(rng, n, 1))
    };

    let friction = rational(rng.random_range(quarters), 4);
    let stiffness = sparse(&gram(rng, n, 1));
    System::new(stiffness, Some(mass), Some(friction), particles)
}

/// The system with curved obstacles: of four particles that slip two are on a convex one, one on a
/// hollow one and one on a flat one, on average.
///
/// # Errors
/// [`ModelError`]; none.
pub fn on_curved_obstacles(
    rng: &mut ChaCha8Rng,
    system: &System,
    corners: &mut Vec<Corner>,
) -> Result<System, ModelError> {
    let mut particles = system.particles().to_vec();
    for particle in particles.iter_mut().filter(|p| is_slip(&p.state)) {
        let side = match rng.random_range(0..4) {
            0 => continue,
            1 => -1,
            _ => 1,
        };
        particle.curvature = Some(Curvature {
            value: rational(side * rng.random_range(1..=12), 4),
            normal_reaction: rational(-rng.random_range(1..=24), 3),
        });
        corners.push(Corner::Curved);
    }

    system.with_particles(particles)
}

/// The particle with a random normal direction and, one time in three, a rotated frame.
pub(crate) fn turned(
    rng: &mut ChaCha8Rng,
    mut particle: Particle,
    rotation: fn(&mut ChaCha8Rng) -> [[Rational; 2]; 2],
    corners: &mut Vec<Corner>,
) -> Particle {
    particle.normal_direction = if rng.random_range(0..2) == 0 { 1 } else { -1 };
    if rng.random_range(0..3) == 0 {
        particle.frame = Some(rotation(rng));
        corners.push(Corner::Oblique);
    }

    match particle.state {
        ContactState::Stick => corners.push(Corner::Stick),
        ContactState::Free => corners.push(Corner::FreeVariables),
        ContactState::Slip { .. } | ContactState::Zero => {}
    }
    particle
}

/// A rotation from a Pythagorean triple, in any of the four quadrants.
fn rotation(rng: &mut ChaCha8Rng) -> [[Rational; 2]; 2] {
    const TRIPLES: [(i64, i64, i64); 6] = [
        (3, 4, 5),
        (4, 3, 5),
        (5, 12, 13),
        (-3, 4, 5),
        (-8, -15, 17),
        (20, -21, 29),
    ];
    let (p, q, h) = TRIPLES[rng.random_range(0..6)];

    let c = rational(p, h);
    let s = rational(q, h);
    [[c.clone(), s.clone()], [-s, c]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_mixture_occurs_once() {
        let all: BTreeSet<String> = (0..MIXTURES).map(|k| format!("{:?}", mixture(k))).collect();

        assert_eq!(all.len() as u64, MIXTURES);
        assert!(!all.contains("[]"));
        assert_eq!(mixture(MIXTURES), mixture(0));
    }
}
