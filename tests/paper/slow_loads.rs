//! Motion under slow loads follows the quasi-static path where that is the only one.
//!
//! A third way to the same equilibria: the body of unit mass is at rest, its loads grow smoothly
//! and slowly, and M u'' + K u = f + r is integrated with the contact laws (1), (2) as they stand,
//! by implicit Euler. In each time step every combination of contact states is tried. The path
//! knows neither time nor mass: the longer the loads take, the nearer the motion has to stay to it.
//! Shares with `mceip_path` nothing but the body.
#![cfg(feature = "solver")]

use crate::loads::Instance;
use mceip_exact::{to_f64, whole};
use mceip_model::{ContactState, Direction};
use mceip_path::{LoadingPath, LoadingPathEnd, RateSolutions};
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// The body in doubles.
struct Body {
    stiffness: DMatrix<f64>,
    loads: Vec<DVector<f64>>,
    /// The tangent of each candidate, then its normal.
    directions: DMatrix<f64>,
    gaps: Vec<f64>,
    /// Friction of each candidate.
    mu: Vec<f64>,
}

impl Body {
    fn of(instance: &Instance) -> Body {
        let system = instance.body.system();
        let dofs = system.dofs();
        let mut stiffness = DMatrix::zeros(dofs, dofs);
        for (i, j, value) in system.stiffness().entries() {
            stiffness[(i, j)] = to_f64(value);
        }

        let particles = system.particles();
        let mut directions = DMatrix::zeros(2 * particles.len(), dofs);
        for (k, particle) in particles.iter().enumerate() {
            let both: [Direction; 2] = [particle.tangent(), particle.into_obstacle()];
            for (row, direction) in both.iter().enumerate() {
                for (dof, value) in direction {
                    directions[(2 * k + row, *dof)] = to_f64(value);
                }
            }
        }

        let in_doubles = |load: &Vec<_>| DVector::from_iterator(dofs, load.iter().map(to_f64));
        Body {
            stiffness,
            loads: instance.body.loads().iter().map(in_doubles).collect(),
            directions,
            gaps: instance.body.gaps().iter().map(to_f64).collect(),
            mu: (0..particles.len())
                .map(|k| to_f64(&instance.mu(k)))
                .collect(),
        }
    }

    /// The displacements (u_T, u_N) of the candidates at the ends of the time steps, load by load.
    /// Each load takes this long.
    fn moved(&self, duration: f64) -> Vec<Vec<DVector<f64>>> {
        let dofs = self.stiffness.nrows();
        let h = duration / TIME_STEPS as f64;
        let inertia = DMatrix::identity(dofs, dofs) / (h * h);
        let inverse = (&inertia + &self.stiffness).try_inverse().unwrap();
        let compliance = &self.directions * &inverse * self.directions.transpose();

        let mut applied = DVector::zeros(dofs);
        let mut at = DVector::zeros(dofs);
        let mut velocity = DVector::zeros(dofs);
        let mut all = Vec::new();
        for load in &self.loads {
            let mut places = Vec::new();
            for k in 1..=TIME_STEPS {
                let force = &applied + load * applied_after(k);
                let driving = force + &inertia * (&at + &velocity * h);
                let without_contact = &self.directions * &inverse * &driving;
                let before = &self.directions * &at;
                let reaction = self.reaction(&compliance, &without_contact, &before);
                let next = &inverse * (driving + self.directions.transpose() * reaction);
                velocity = (&next - &at) / h;
                at = next;
                places.push(&self.directions * &at);
            }
            applied += load;
            all.push(places);
        }

        all
    }

    /// The reactions r of a time step: u = `without_contact` + `compliance` r has to satisfy
    /// (1), (2).
    fn reaction(
        &self,
        compliance: &DMatrix<f64>,
        without_contact: &DVector<f64>,
        before: &DVector<f64>,
    ) -> DVector<f64> {
        let count = self.gaps.len();
        for combination in 0..STATES.len().pow(count as u32) {
            let state = |k: usize| STATES[combination / STATES.len().pow(k as u32) % STATES.len()];
            let mut matrix = DMatrix::zeros(2 * count, 2 * count);
            let mut right = DVector::zeros(2 * count);
            for k in 0..count {
                let [t, n] = [2 * k, 2 * k + 1];
                if state(k) == ContactState::Free {
                    matrix[(t, t)] = 1.0; // r = 0
                    matrix[(n, n)] = 1.0;
                    continue;
                }
                matrix.set_row(n, &compliance.row(n)); // u_N = g
                right[n] = self.gaps[k] - without_contact[n];
                if let ContactState::Slip { sign } = state(k) {
                    matrix[(t, t)] = f64::from(sign); // S r_T + mu r_N = 0
                    matrix[(t, n)] = self.mu[k];
                } else {
                    matrix.set_row(t, &compliance.row(t)); // u_T as before
                    right[t] = before[t] - without_contact[t];
                }
            }

            let Some(reaction) = matrix.lu().solve(&right) else {
                continue;
            };
            let there = without_contact + compliance * &reaction;
            let holds = |k: usize| {
                let [t, n] = [2 * k, 2 * k + 1];
                let small = 1e-12 * (1.0 + without_contact.amax());
                let slid = there[t] - before[t];
                let limit = -self.mu[k] * reaction[n];
                let is_inside = there[n] <= self.gaps[k] + small;
                let is_pressed = reaction[n] * compliance[(n, n)] <= small;
                match state(k) {
                    ContactState::Slip { sign } => is_pressed && f64::from(sign) * slid <= small,
                    ContactState::Free => is_inside,
                    _ => is_pressed && (reaction[t].abs() - limit) * compliance[(t, t)] <= small,
                }
            };
            if (0..count).all(holds) {
                return reaction;
            }
        }

        panic!("no contact states satisfy the time step");
    }
}

const STATES: [ContactState; 4] = [
    ContactState::Free,
    ContactState::Stick,
    ContactState::Slip { sign: 1 },
    ContactState::Slip { sign: -1 },
];

/// Time steps in which each load is applied.
const TIME_STEPS: usize = 1000;

/// How much of a load is applied after k time steps: it begins and ends at rest.
fn applied_after(k: usize) -> f64 {
    let part = k as f64 / TIME_STEPS as f64;
    part * part * (3.0 - 2.0 * part)
}

/// The displacements of the candidates on the path, where this much of a step's load is applied.
fn on_path(path: &LoadingPath, step: usize, amount: f64) -> Option<DVector<f64>> {
    let mut stretches = path.stretches.iter().filter(|stretch| stretch.step == step);
    let stretch = stretches.find(|stretch| amount <= to_f64(stretch.last().amount()))?;
    let ends = [&stretch.start, stretch.last()];
    let [from, to] = ends.map(|end| to_f64(end.amount()));
    let count = stretch.states.len();
    let [start, stop] = ends.map(|end| {
        let places = (0..count).map(|k| end.displacement(k));
        let places = places.flat_map(|(u_t, u_n)| [to_f64(&u_t), to_f64(&u_n)]);
        DVector::from_iterator(2 * count, places)
    });

    Some(&start + (stop - &start) * ((amount - from) / (to - from)))
}

/// How far the motion under loads that take this long departs from a path, relative to the largest
/// displacement; `None` where nothing moves.
fn departure(body: &Body, path: &LoadingPath, duration: f64) -> Option<f64> {
    let mut largest: f64 = 0.0;
    let mut apart: f64 = 0.0;
    for (step, places) in body.moved(duration).iter().enumerate() {
        for (k, place) in places.iter().enumerate() {
            largest = largest.max(place.amax());
            if let Some(expected) = on_path(path, step, applied_after(k + 1)) {
                apart = apart.max((place - expected).amax());
            }
        }
    }

    (largest > 1e-9).then_some(apart / largest)
}

/// Where one way to go on is proved at the beginning of every stretch, and all loads are applied.
fn is_the_only_one(instance: &Instance, path: &LoadingPath) -> bool {
    let contact = instance.condensed();
    let mut pencils = contact.pencils();
    let mut has_one_way = |stretch: usize| {
        let ways = path.rate_solutions(&mut pencils, stretch).unwrap();
        ways == RateSolutions::OneForEveryLoad
    };

    path.end == LoadingPathEnd::AllApplied && (0..path.stretches.len()).all(&mut has_one_way)
}

/// Periods are of the order of 1. The path at half the friction is another one, where candidates
/// slip: the motion departs from it.
#[test]
fn slow_motion_follows_a_path_that_is_the_only_one() {
    let mut rng = ChaCha8Rng::seed_from_u64(38);
    let (mut followed, mut events, mut noticed) = (0, 0, 0);
    for case in 0..100 {
        let mut instance = Instance::random(&mut rng);
        let path = instance.follow();
        if !is_the_only_one(&instance, &path) {
            continue;
        }

        let body = Body::of(&instance);
        let Some(slow) = departure(&body, &path, 200.0) else {
            continue;
        };
        let slower = departure(&body, &path, 2000.0).unwrap();
        assert!(slower < 1e-2 && slower < slow, "{case}: {slow} {slower}");
        followed += 1;
        events += path.stretches.len() - 1;

        instance.friction /= whole(2);
        let other = departure(&body, &instance.follow(), 2000.0).unwrap();
        noticed += usize::from(other > 3e-2);
    }

    assert!(followed >= 40 && events >= 80, "{followed} {events}");
    assert!(noticed >= 15, "{noticed}");
}
