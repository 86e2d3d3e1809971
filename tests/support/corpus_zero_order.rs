//! Boxes about systems in which particles in contact with zero reaction come first in the file, are
//! several, have a normal against the degree of freedom or an own friction factor: what a checker
//! that mistakes a variable or a direction for another one would accept.
//!
//! Particles with zero reaction stand on (T, N) = (0, 1) and, where there are two, on (4, 5); the
//! particle in impending slip with S = 1 on (2, 3) is the second one of the file. K is that of
//! `corpus_zero`: what the others do cancels in w_2 + mu w_3, and (a, b) of each choose its mode.
//! Variables: x of the slip particle, then the gap, right and left of each of the others.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use super::corpus_zero::enclosed_x;
use mceip_check::certificate::{Claim, EnclosedSolution};
use mceip_exact::{Rational, Sparse, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};

/// A particle with zero reaction: its couplings to the one in impending slip.
struct Zero {
    a: &'static str,
    b: &'static str,
}

/// Slides to the right with v_T = x / 4 (MCEIP-lambda2, friction factor 1).
const SLIDES: Zero = Zero { a: "1", b: "6" };
/// Opens with v_N = -x / 4 and slides to the right with v_T = x / 4.
const OPENS: Zero = Zero { a: "-3", b: "3" };
/// Opens with v_N = -x / 4 and slides to the left with v_T = -x / 4.
const OPENS_TO_THE_LEFT: Zero = Zero { a: "-3", b: "-3" };

/// The system, and the first particle as the caller changes it.
fn problem(unknown: Unknown, zeros: &[Zero], change: fn(&mut Particle)) -> Problem {
    let mu = match unknown {
        Unknown::Lambda2 => whole(3),
        Unknown::Mu => whole(2),
    };

    let mut entries = vec![(2, 2, whole(4)), (3, 3, whole(10))];
    let mut couplings = vec![(2, 3, whole(-2))];
    let mut particles = vec![Particle::plain(2, 3, ContactState::Slip { sign: 1 })];
    for (place, zero) in zeros.iter().enumerate() {
        let tangential = 4 * place;
        let normal = tangential + 1;
        let a = parse(zero.a).unwrap();
        let b = parse(zero.b).unwrap();

        entries.extend([
            (tangential, tangential, whole(10)),
            (normal, normal, whole(10)),
        ]);
        couplings.extend([(2, tangential, b.clone()), (2, normal, a.clone())]);
        couplings.extend([(3, tangential, -b / &mu), (3, normal, -a / &mu)]);
        let particle = Particle::plain(tangential, normal, ContactState::Zero);
        particles.insert(if place == 0 { 0 } else { 2 }, particle);
    }

    for (i, j, value) in couplings {
        entries.push((i, j, value.clone()));
        entries.push((j, i, value));
    }

    change(&mut particles[0]);
    let dofs = 2 + 2 * particles.len() - 2;
    let stiffness = Sparse::from_entries(dofs, dofs, entries);
    let (mass, friction) = match unknown {
        Unknown::Lambda2 => (Some(Sparse::identity(dofs)), Some(mu)),
        Unknown::Mu => (None, None),
    };
    let system = System::new(stiffness, mass, friction, particles).unwrap();
    Problem::new(Body::System(system), unknown, Window::all()).unwrap()
}

fn plain(_: &mut Particle) {}

fn against_the_normal(particle: &mut Particle) {
    particle.normal_direction = -1;
}

fn half_the_friction(particle: &mut Particle) {
    particle.friction_factor = rational(1, 2);
}

/// The box around x in quarters.
fn box_in_quarters(problem: &Problem, support: &[usize], quarters: &[i64]) -> EnclosedSolution {
    let x: Vec<Rational> = quarters.iter().map(|&n| rational(n, 4)).collect();
    enclosed_x(problem, support, &x)
}

pub fn boxes(cases: &mut Cases) {
    order_of_particles(cases);
    normals(cases);
    factors(cases);
    margins(cases);
}

fn order_of_particles(cases: &mut Cases) {
    let first = problem(Unknown::Lambda2, &[SLIDES], plain);
    let good = box_in_quarters(&first, &[0, 2], &[4, 0, 1, 0]);
    cases.accept(
        "zero-first-box",
        "the particle with zero reaction is the first of the file; its variables are the last",
        &first,
        &claims(&first, Claim::EnclosedSolution(good.clone())),
    );

    // In the order of the file: gap, right and left, then x.
    let mut forged = good;
    forged.support = vec![1, 3];
    forged.center.swap(0, 1);
    forged.preconditioner.swap(0, 1);
    for row in &mut forged.preconditioner {
        row.swap(0, 1);
    }
    cases.reject(
        "zero-order-of-the-file-box",
        "NotContracting",
        "the same motion with its variables in the order of the particles",
        &first,
        &claims(&first, Claim::EnclosedSolution(forged)),
    );

    let both = problem(Unknown::Lambda2, &[OPENS, SLIDES], plain);
    let good = box_in_quarters(&both, &[0, 1, 2, 5], &[4, 1, 1, 0, 0, 1, 0]);
    cases.accept(
        "zero-two-particles-box",
        "one particle opens and slides to the right, the other one slides to the right",
        &both,
        &claims(&both, Claim::EnclosedSolution(good)),
    );

    // At rest along the obstacle the open particle has y_right > 0 and y_left < 0.
    let both = problem(Unknown::Lambda2, &[OPENS_TO_THE_LEFT, SLIDES], plain);
    let forged = box_in_quarters(&both, &[0, 1, 5], &[4, 1, 0, 0, 0, 1, 0]);
    cases.reject(
        "zero-gap-and-half-of-two-particles-box",
        "YNotPositive",
        "the gap of one particle and the right half of another one: the left row of the first one \
         does not vanish with them, it is negative",
        &both,
        &claims(&both, Claim::EnclosedSolution(forged)),
    );
}

fn normals(cases: &mut Cases) {
    let along = problem(Unknown::Lambda2, &[OPENS], plain);
    let against = problem(Unknown::Lambda2, &[OPENS], against_the_normal);
    let forged = box_in_quarters(&along, &[0, 1, 2], &[4, 1, 1, 0]);
    cases.reject(
        "zero-normal-left-out-box",
        "NotContracting",
        "the gap of a particle whose normal degree of freedom points away from the obstacle, with \
         the sign of one that points into it",
        &against,
        &claims(&against, Claim::EnclosedSolution(forged)),
    );
}

fn factors(cases: &mut Cases) {
    let full = problem(Unknown::Mu, &[SLIDES], plain);
    let half = problem(Unknown::Mu, &[SLIDES], half_the_friction);
    // mu = 2: 10 v_T = 6 - 2 in full friction, 6 - 1 in half of it.
    let good = box_in_quarters(&half, &[0, 2], &[4, 0, 2, 0]);
    cases.accept(
        "zero-factor-mu-box",
        "friction factor 1/2 where mu is the unknown: w_T = mu w_N / 2",
        &half,
        &claims(&half, Claim::EnclosedSolution(good)),
    );

    let x = [whole(1), whole(0), rational(2, 5), whole(0)];
    let forged = enclosed_x(&full, &[0, 2], &x);
    cases.reject(
        "zero-factor-left-out-mu-box",
        "NotContracting",
        "the motion without the friction factor where mu is the unknown",
        &half,
        &claims(&half, Claim::EnclosedSolution(forged)),
    );
}

/// The radius of v_T is its center.
fn margins(cases: &mut Cases) {
    let slides = problem(Unknown::Lambda2, &[SLIDES], plain);
    let mut forged = box_in_quarters(&slides, &[0, 2], &[4, 0, 1, 0]);
    let v_t = forged.center[1].0.clone();
    forged.radius[1] = Number(v_t);
    cases.reject(
        "zero-half-reaches-zero-box",
        "XNotPositive",
        "v_T over the box reaches 0",
        &slides,
        &claims(&slides, Claim::EnclosedSolution(forged)),
    );
}
