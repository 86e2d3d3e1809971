//! The fuzz targets with a solver, as their floors are measured and held against other solvers.
#![allow(missing_docs, unreachable_pub)]

use mceip_testkit::Treatment;
use mceip_testkit::targets::{self, Counter};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// A fuzz target with a solver.
pub struct SolverTarget {
    /// The family whose floor it is held against.
    pub family: &'static str,
    /// The length of a random input.
    pub length: usize,
    /// The body, with a solver of one's own.
    pub body: fn(&[u8], &Treatment, &Counter),
}

pub const SOLVER_TARGETS: [SolverTarget; 3] = [
    SolverTarget {
        family: "fuzz: solver_against_oracle",
        length: 34,
        body: targets::solver_against_oracle_by,
    },
    SolverTarget {
        family: "fuzz: mechanical_systems",
        length: 150,
        body: targets::mechanical_systems_by,
    },
    SolverTarget {
        family: "fuzz: two_particle_problems",
        length: 10,
        body: targets::two_particle_problems_by,
    },
];

pub fn random_bytes(rng: &mut ChaCha8Rng, length: usize) -> Vec<u8> {
    (0..length).map(|_| rng.random_range(0..=255)).collect()
}
