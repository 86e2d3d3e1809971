//! (9) in the physical variables against the reduced route, and what is known of particles with
//! zero reaction (z).
//!
//! The enumerator of `mceip_oracle::enumerate_motions` shares no code with the reduction. For
//! systems of f, d and s particles it must list what the enumerator of the reduced pencil lists.
//! A z particle is treated by the reduced route in four runs: as f (open), as d (sticking) and as s
//! of either sign (slipping), with the inequalities that z adds as a filter. The closed form of
//! Fig. 1 with one z is the third truth.
#![cfg(feature = "testkit")]

use mceip_exact::{Algebraic, Integer, Poly, Rational, Sign, common_denominator, rational, whole};
use mceip_model::reduction::{Lifted, check_lines, lift, reduce};
use mceip_model::{
    Body, ContactState, Direction, Particle, Problem, ReducedVariable, System, Unknown, Window,
};
use mceip_oracle::{
    Enumeration, Motion, Motions, ParticleMode, PhysicalState, PhysicalSystem, TwoParticles,
    enumerate, enumerate_motions,
};
use mceip_paper::{pythagorean_angles, two_particles};
use mceip_testkit::generators::{rng, states};
use rand::RngExt;

pub(crate) const UNKNOWNS: [Unknown; 2] = [Unknown::Lambda2, Unknown::Mu];

/// Number of this family of random systems.
const FAMILY: u64 = 90;

/// The reduced route: what the enumerator of the pencil finds, and the problem.
struct Reduced {
    found: Enumeration,
    pencil: mceip_model::Pencil,
    variables: Vec<ReducedVariable>,
}

fn reduced_route(system: &System, unknown: Unknown) -> Reduced {
    let body = Body::System(system.clone());
    let problem = Problem::new(body, unknown, Window::all()).unwrap();
    let reduced = reduce(&problem).unwrap();

    Reduced {
        found: enumerate(&reduced.pencil, &Window::all()).unwrap(),
        pencil: reduced.pencil,
        variables: reduced.variables,
    }
}

/// The sum of the c_i p_i of a direction c, times a common denominator.
fn combination(direction: &Direction, polynomials: &[Poly], clear: &Integer) -> Poly {
    let mut sum = Poly::default();
    for (dof, c) in direction {
        sum += &polynomials[*dof].scale(&(c.numer() * (clear / c.denom())));
    }
    sum
}

/// A common denominator of the coefficients of two directions.
fn denominator_of(first: &Direction, second: &Direction) -> Integer {
    common_denominator(first.iter().chain(second).map(|(_, c)| c))
}

/// x of (10) for a motion v: v at free degrees of freedom, -S v_T at slip particles.
fn x_of(variables: &[ReducedVariable], v: &[Poly]) -> Vec<Poly> {
    // One factor for all entries, since x counts up to a positive factor.
    let mut coefficients = Vec::new();
    for variable in variables {
        if let ReducedVariable::Slip { tangent, .. } = variable {
            coefficients.extend(tangent.iter().map(|(_, c)| c.clone()));
        }
    }
    let clear = common_denominator(&coefficients);

    let mut x = Vec::new();
    for variable in variables {
        x.push(match variable {
            ReducedVariable::Free { dof } => v[*dof].scale(&clear),
            ReducedVariable::Slip { sign, tangent, .. } => {
                let sliding = combination(tangent, v, &clear);
                sliding.scale(&(-i64::from(*sign)).into())
            }
            ReducedVariable::Zero { .. } => panic!("the reduced route has no z particles"),
        });
    }

    x
}

/// Is every motion listed by the reduced route, and is none of its solutions missing?
fn assert_same(motions: &[Motion], route: &Reduced, label: &str) {
    assert!(route.found.is_plain_list(), "{label}");
    assert_eq!(motions.len(), route.found.solutions.len(), "{label}");

    for motion in motions {
        let x = x_of(&route.variables, &motion.v);
        let is_listed = route.found.contains(&route.pencil, &motion.value, &x);
        assert!(is_listed, "{label}: {motion:?}");
    }
}

/// 70 mixtures of f, d and s, both unknowns.
#[test]
fn motions_are_the_solutions_of_the_reduced_pencil() {
    let mut compared = 0;
    let mut solutions = 0;
    let mut degenerate = 0;

    for number in 0..2 * states::MIXTURES {
        let mut rng = rng(FAMILY, number);
        let mixture = states::mixture(number);
        let system = states::system(&mut rng, &mixture, &mut Vec::new()).unwrap();

        for unknown in UNKNOWNS {
            let label = format!("system {number}, {unknown:?}");
            let physical = PhysicalSystem::of(&system, unknown).unwrap();
            let direct = enumerate_motions(&physical, &Window::all()).unwrap();
            let route = reduced_route(&system, unknown);

            if !direct.degenerate.is_empty() || !route.found.is_plain_list() {
                degenerate += 1;
                continue;
            }

            assert_same(&direct.motions, &route, &label);
            compared += 1;
            solutions += direct.motions.len();
        }
    }

    assert!(degenerate <= 14, "{degenerate} of 280 left out");
    assert!(compared >= 266, "{compared} systems compared");
    assert!(solutions >= 100, "{solutions} solutions");
}

/// The system with a friction factor of its own for each particle.
pub(crate) fn with_factors(system: &System, rng: &mut impl rand::Rng) -> System {
    let mut particles = system.particles().to_vec();
    for particle in &mut particles {
        particle.friction_factor = rational(rng.random_range(1..=12), 4);
    }

    system.with_particles(particles).unwrap()
}

/// 70 mixtures with friction factors: the motions are the solutions of the reduced pencil, and each
/// solution satisfies the lines of (9) when it is lifted. Without the factors few of them do.
#[test]
fn friction_factors_count_in_both_routes() {
    let mut solutions = 0;
    let mut changed = 0;

    for number in 0..states::MIXTURES {
        let mut rng = rng(FAMILY, 2000 + number);
        let mixture = states::mixture(number);
        let plain = states::system(&mut rng, &mixture, &mut Vec::new()).unwrap();
        let system = with_factors(&plain, &mut rng);

        for unknown in UNKNOWNS {
            let physical = PhysicalSystem::of(&system, unknown).unwrap();
            let direct = enumerate_motions(&physical, &Window::all()).unwrap();
            let route = reduced_route(&system, unknown);
            if !direct.degenerate.is_empty() || !route.found.is_plain_list() {
                continue;
            }

            assert_same(
                &direct.motions,
                &route,
                &format!("system {number}, {unknown:?}"),
            );
            for solution in &route.found.solutions {
                let lifted = lift(&system, unknown, &route.variables, &solution.x);
                let value = &mut solution.value.clone();
                assert_eq!(check_lines(&system, unknown, &lifted, value), Ok(()));
                changed += usize::from(check_lines(&plain, unknown, &lifted, value).is_err());
                solutions += 1;
            }
        }
    }

    assert!(solutions >= 50, "{solutions} solutions");
    assert!(changed >= 40, "{changed} solutions of factors alone");
}

/// 70 mixtures with friction factors on curved obstacles: the motions are the solutions of the
/// reduced pencil, and each satisfies the lines of (9) when it is lifted. On flat obstacles few of
/// them do.
#[test]
fn curved_obstacles_count_in_both_routes() {
    let unknown = Unknown::Lambda2;
    let mut solutions = 0;
    let mut changed = 0;

    for number in 0..2 * states::MIXTURES {
        let mut rng = rng(FAMILY, 3000 + number);
        let mixture = states::mixture(number);
        let plain = states::system(&mut rng, &mixture, &mut Vec::new()).unwrap();
        let flat = with_factors(&plain, &mut rng);
        let system = states::on_curved_obstacles(&mut rng, &flat, &mut Vec::new()).unwrap();

        let physical = PhysicalSystem::of(&system, unknown).unwrap();
        let direct = enumerate_motions(&physical, &Window::all()).unwrap();
        let route = reduced_route(&system, unknown);
        if !direct.degenerate.is_empty() || !route.found.is_plain_list() {
            continue;
        }

        assert_same(&direct.motions, &route, &format!("system {number}"));
        for solution in &route.found.solutions {
            let lifted = lift(&system, unknown, &route.variables, &solution.x);
            let value = &mut solution.value.clone();
            assert_eq!(check_lines(&system, unknown, &lifted, value), Ok(()));
            changed += usize::from(check_lines(&flat, unknown, &lifted, value).is_err());
            solutions += 1;
        }
    }

    assert!(solutions >= 100, "{solutions} solutions");
    assert!(
        changed >= 80,
        "{changed} solutions of curved obstacles alone"
    );
}

/// The system with some of its particles in contact with zero reaction.
struct WithZero {
    /// In it the z particles have some other state, which is not used.
    system: System,
    /// Which particles are z.
    zero: Vec<usize>,
}

impl WithZero {
    /// A random system of two or three particles, of which the first slips and the last is z.
    fn random(index: u64) -> WithZero {
        let mut rng = rng(FAMILY, 1000 + index);
        let count = 2 + (index % 2) as usize;
        let mut states = vec![ContactState::Slip { sign: 1 }];
        if index / 2 % 2 == 1 {
            states[0] = ContactState::Slip { sign: -1 };
        }
        for _ in 1..count {
            states.push(match rng.random_range(0..4) {
                0 => ContactState::Slip { sign: 1 },
                1 => ContactState::Slip { sign: -1 },
                2 => ContactState::Stick,
                _ => ContactState::Free,
            });
        }

        let mut zero = vec![count - 1];
        if count == 3 && index / 4 % 2 == 1 {
            zero.push(1);
        }
        zero.sort_unstable();

        WithZero {
            system: states::system(&mut rng, &states, &mut Vec::new()).unwrap(),
            zero,
        }
    }

    fn physical(&self, unknown: Unknown) -> PhysicalSystem {
        let mut physical = PhysicalSystem::of(&self.system, unknown).unwrap();
        for &particle in &self.zero {
            physical.particles[particle].state = PhysicalState::Zero;
        }
        physical
    }

    /// The system in which the z particles have these states.
    fn in_states(&self, states: &[ContactState]) -> System {
        let mut particles: Vec<Particle> = self.system.particles().to_vec();
        for (&particle, state) in self.zero.iter().zip(states) {
            particles[particle].state = *state;
        }

        self.system.with_particles(particles).unwrap()
    }
}

const STATES_OF_ZERO: [ContactState; 4] = [
    ContactState::Free,
    ContactState::Stick,
    ContactState::Slip { sign: 1 },
    ContactState::Slip { sign: -1 },
];

/// The mode of a z particle that is treated as one of this state.
fn mode_of(state: ContactState) -> ParticleMode {
    match state {
        ContactState::Free | ContactState::Zero => ParticleMode::Open,
        ContactState::Stick => ParticleMode::Sticking,
        ContactState::Slip { sign } => ParticleMode::Slipping { sign },
    }
}

/// Every choice of a state for each of so many z particles.
fn choices(count: usize) -> Vec<Vec<ContactState>> {
    let mut all = vec![Vec::new()];
    for _ in 0..count {
        let mut longer = Vec::new();
        for choice in &all {
            for state in STATES_OF_ZERO {
                let mut extended: Vec<ContactState> = choice.clone();
                extended.push(state);
                longer.push(extended);
            }
        }
        all = longer;
    }

    all
}

/// S w_T + mu w_N, up to a positive factor.
fn cone(particle: &Particle, sign: i8, mu: Option<&Rational>, w: &[Poly]) -> Poly {
    let tangent = particle.tangent();
    let normal = particle.into_obstacle();
    let clear = denominator_of(&tangent, &normal);
    let tangential = combination(&tangent, w, &clear).scale(&i64::from(sign).into());
    let normal = combination(&normal, w, &clear);

    match mu {
        Some(mu) => &tangential.scale(mu.denom()) + &normal.scale(mu.numer()),
        // mu is the unknown t.
        None => &tangential + &normal.shift(1),
    }
}

/// Does a z particle of this mode satisfy its inequalities?
fn zero_admits(
    particle: &Particle,
    mode: ParticleMode,
    mu: Option<&Rational>,
    lifted: &Lifted,
    value: &mut Algebraic,
) -> bool {
    let normal = particle.into_obstacle();
    let tangent = particle.tangent();
    let clear = denominator_of(&normal, &tangent);
    let v_normal = combination(&normal, &lifted.v, &clear);
    let v_tangential = combination(&tangent, &lifted.v, &clear);
    let w_normal = combination(&normal, &lifted.w, &clear);

    match mode {
        ParticleMode::Open => value.sign_of(&v_normal) == Sign::Negative,
        ParticleMode::Sticking => {
            value.sign_of(&cone(particle, 1, mu, &lifted.w)) != Sign::Positive
                && value.sign_of(&cone(particle, -1, mu, &lifted.w)) != Sign::Positive
                && value.sign_of(&w_normal) != Sign::Positive
        }
        ParticleMode::Slipping { sign } => {
            let against = v_tangential.scale(&i64::from(sign).into());
            value.sign_of(&against) == Sign::Negative && value.sign_of(&w_normal) != Sign::Positive
        }
    }
}

/// The number of solutions of the reduced route in which the z particles have these states, after
/// the filter; `None` where one of them is not a plain list.
fn filtered(zero: &WithZero, states: &[ContactState], unknown: Unknown) -> Option<usize> {
    let system = zero.in_states(states);
    let route = reduced_route(&system, unknown);
    if !route.found.is_plain_list() {
        return None;
    }

    let mu = match unknown {
        Unknown::Lambda2 => system.friction(),
        Unknown::Mu | Unknown::Eigenvalue => None,
    };

    let mut admitted = 0;
    for solution in &route.found.solutions {
        let lifted = lift(&system, unknown, &route.variables, &solution.x);
        let mut value = solution.value.clone();
        let is_admitted = zero.zero.iter().zip(states).all(|(&particle, &state)| {
            let particle = &system.particles()[particle];
            zero_admits(particle, mode_of(state), mu, &lifted, &mut value)
        });
        admitted += usize::from(is_admitted);
    }

    Some(admitted)
}

/// The motions in which the z particles have these modes.
fn with_modes(found: &Motions, zero: &[usize], states: &[ContactState]) -> usize {
    let has_modes = |motion: &&Motion| {
        zero.iter()
            .zip(states)
            .all(|(&particle, &state)| motion.modes[particle] == mode_of(state))
    };
    found.motions.iter().filter(has_modes).count()
}

/// Random systems with one or two z particles: four runs of the reduced route for each z.
#[test]
fn motions_with_zero_reaction_are_those_of_four_filtered_runs() {
    let mut compared = 0;
    let mut by_mode = [0; 4];

    for index in 0..120 {
        let zero = WithZero::random(index);
        for unknown in UNKNOWNS {
            let direct = enumerate_motions(&zero.physical(unknown), &Window::all()).unwrap();
            if !direct.degenerate.is_empty() {
                continue;
            }

            for states in choices(zero.zero.len()) {
                let Some(expected) = filtered(&zero, &states, unknown) else {
                    continue;
                };
                let got = with_modes(&direct, &zero.zero, &states);
                assert_eq!(got, expected, "system {index}, {unknown:?}, {states:?}");

                compared += 1;
                for (place, state) in STATES_OF_ZERO.iter().enumerate() {
                    if states.contains(state) {
                        by_mode[place] += got;
                    }
                }
            }
        }
    }

    assert!(compared >= 1000, "{compared} choices compared");
    assert!(by_mode.iter().all(|&count| count >= 5), "{by_mode:?}");
}

/// The theorem behind Propositions 1 and 2 with z: in every motion mu > 0 and some s particle slips
/// while its pressure falls (w_N > 0).
#[test]
fn every_motion_has_an_s_particle_that_slips_while_its_pressure_falls() {
    let mut motions = 0;
    for index in 0..120 {
        let zero = WithZero::random(index);
        let physical = zero.physical(Unknown::Lambda2);
        for motion in enumerate_motions(&physical, &Window::all())
            .unwrap()
            .motions
        {
            assert!(has_unloading_slip(&physical, &motion), "system {index}");
            motions += 1;
        }
    }

    assert!(motions >= 30, "{motions} motions");
}

fn has_unloading_slip(system: &PhysicalSystem, motion: &Motion) -> bool {
    let mass = system.mass.as_ref().unwrap();
    let n = system.stiffness.rows();
    let mut value = motion.value.clone();

    // w = (K + t M) v, all entries times one positive integer.
    let entries = system.stiffness.entries().chain(mass.entries());
    let clear = common_denominator(entries.map(|(_, _, entry)| entry));
    let mut w = vec![Poly::default(); n];
    for (matrix, power) in [(&system.stiffness, 0), (mass, 1)] {
        for (i, j, entry) in matrix.entries() {
            let factor = entry.numer() * (&clear / entry.denom());
            w[i] += &motion.v[j].scale(&factor).shift(power);
        }
    }

    system
        .particles
        .iter()
        .zip(&motion.modes)
        .any(|(particle, mode)| {
            let is_s = matches!(particle.state, PhysicalState::Slip { .. });
            let slips = matches!(mode, ParticleMode::Slipping { .. });
            let clear = denominator_of(&particle.normal, &particle.tangent);
            let w_normal = combination(&particle.normal, &w, &clear);
            is_s && slips && value.sign_of(&w_normal) == Sign::Positive
        })
}

/// Fig. 1 with particle `zero` in contact with zero reaction and k = m = 1, the other one in
/// impending slip with the sign S. With d = c s, a motion exists exactly if mu^2 s^2 >= c^2 + 2 and
/// S d > 0 for zero = 1, S d < 0 for zero = 0. Then it is one, both particles slide towards -S, and
/// lambda^2 + c^2 + 1 = sqrt(1 + mu^2 c^2 s^2).
#[test]
fn two_particles_with_one_zero_reaction() {
    let mut found = 0;
    for (c, s) in angles() {
        for mu in [rational(1, 2), whole(2), whole(3), rational(7, 2), whole(8)] {
            for sign in [1, -1] {
                let data = data(&c, &s, &mu, sign);
                found += assert_closed_form(&data, sign, 0);
                found += assert_closed_form(&data, sign, 1);
            }
        }
    }

    assert!(found >= 20, "{found} motions");
}

/// c = s = 1/2 is no angle, and the matrices do not ask for one: mu = 3 is the threshold.
#[test]
fn two_particles_with_one_zero_reaction_at_the_threshold() {
    let half = rational(1, 2);
    let at_threshold = data(&half, &half, &whole(3), 1);

    assert_eq!(assert_closed_form(&at_threshold, 1, 1), 1);
}

/// Angles with s of both signs. Without c = 0, where K is only semidefinite.
fn angles() -> Vec<(Rational, Rational)> {
    let mut angles = Vec::new();
    for (c, s) in pythagorean_angles() {
        if c != whole(0) {
            angles.push((c.clone(), s.clone()));
            angles.push((c, -s));
        }
    }
    angles
}

fn data(c: &Rational, s: &Rational, mu: &Rational, sign: i8) -> TwoParticles {
    TwoParticles {
        c: c.clone(),
        s: s.clone(),
        k: whole(1),
        m: whole(1),
        mu: mu.clone(),
        signs: (sign, sign),
    }
}

/// Compares the motions with the closed form; how many there are.
fn assert_closed_form(data: &TwoParticles, sign: i8, zero: usize) -> usize {
    let TwoParticles { c, s, mu, .. } = data;
    let system = two_particles(data).unwrap();
    let mut physical = PhysicalSystem::of(&system, Unknown::Lambda2).unwrap();
    physical.particles[zero].state = PhysicalState::Zero;

    let side = if zero == 1 { sign } else { -sign };
    let is_on_side = c * s * whole(side.into()) > whole(0);
    let is_beyond = mu * mu * s * s >= c * c + whole(2);
    let expected = usize::from(is_on_side && is_beyond);

    let found = enumerate_motions(&physical, &Window::all()).unwrap();
    assert!(found.degenerate.is_empty(), "{data:?}");
    assert_eq!(found.motions.len(), expected, "{data:?}, z = {zero}");

    for motion in &found.motions {
        assert_eq!(motion.modes, [ParticleMode::Slipping { sign }; 2]);

        // (t + c^2 + 1)^2 = 1 + mu^2 c^2 s^2
        let p = c * c + whole(1);
        let q = mu * c * s;
        let constant = &p * &p - whole(1) - &q * &q;
        let equation = Poly::from_rationals(&[constant, p * whole(2), whole(1)]);
        let mut value = motion.value.clone();
        assert_eq!(value.sign_of(&equation), Sign::Zero, "{data:?}");
    }

    expected
}
