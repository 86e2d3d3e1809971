//! A system asked at one friction or at one lambda^2, and all that the plain enumerator answers.

use mceip_exact::Rational;
use mceip_model::reduction::reduce;
use mceip_model::{Body, ContactState, ModelError, Problem, Reduced, System, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate};

/// The system at another mu, without reactions.
///
/// # Errors
/// [`ModelError`] for a mu that is no friction.
pub fn at_friction(system: &System, mu: &Rational) -> Result<System, ModelError> {
    system.with_states(&states_of(system), Some(mu.clone()))
}

/// K + lambda^2 M in place of K, without mass and friction: its MCEIP-mu has the mu at which
/// lambda^2 is a solution.
///
/// # Errors
/// [`ModelError`] without a mass, and where K + lambda^2 M is no stiffness.
pub fn at_lambda2(system: &System, lambda2: &Rational) -> Result<System, ModelError> {
    let mass = system
        .mass()
        .ok_or(ModelError::Empty { what: "the mass" })?;
    let stiffness = system.stiffness().add_scaled(lambda2, mass);
    let particles = system.particles().to_vec();
    System::new(stiffness, None, None, particles)?.with_states(&states_of(system), None)
}

fn states_of(system: &System) -> Vec<ContactState> {
    let particles = system.particles().iter();
    particles.map(|particle| particle.state).collect()
}

/// All solutions of a system in a window.
///
/// # Panics
/// For a system that lacks what its unknown needs, and beyond the limits of the enumerator.
pub fn solutions_of(system: System, unknown: Unknown, window: &Window) -> Enumeration {
    let problem = Problem::new(Body::System(system), unknown, window.clone());
    let problem = problem.unwrap_or_else(|e| panic!("a system is refused: {e}"));
    enumerated(&problem)
}

/// All solutions of a problem in its window.
///
/// # Panics
/// As [`solutions_of`].
pub fn enumerated(problem: &Problem) -> Enumeration {
    let reduced = reduce(problem).and_then(Reduced::without_zero);
    let reduced = reduced.unwrap_or_else(|e| panic!("a problem is refused: {e}"));
    enumerate(&reduced.pencil, problem.window()).unwrap_or_else(|e| panic!("{e}"))
}
