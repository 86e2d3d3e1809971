//! Systems with particles in contact with zero reaction (z): the modes of the split form against
//! the conditions (9) themselves.
//!
//! `enumerate_motions` solves (9) in v and w and knows no reduction; `enumerate_modes` solves the
//! split form of `spec/zero-reaction.md`. On random systems of every mixture of f, z, d and s
//! particles they must list the same motions. Each solution must satisfy the lines of (9) when it
//! is lifted, and the checker must accept it as an exact claim.
#![cfg(feature = "testkit")]

use crate::physical::{UNKNOWNS, with_factors};
use mceip_check::certificate::{Certificate, Claim, ExactSolution};
use mceip_check::check;
use mceip_exact::{Algebraic, Poly, Rational, Sign, rational};
use mceip_model::file::Number;
use mceip_model::reduction::{Lifted, check_lines, lift, reduce_system};
use mceip_model::{Body, ContactState, Problem, Reduced, System, Unknown, Window};
use mceip_oracle::{
    Motion, OracleError, PhysicalSystem, Solution, enumerate_modes, enumerate_modes_with,
    enumerate_motions,
};
use mceip_testkit::generators::states::ZeroModes;
use mceip_testkit::generators::{rng, states};
use rand::RngExt;
use std::ops::ControlFlow;

/// Number of this family of random systems.
const FAMILY: u64 = 91;

/// Systems of the opt-in run, and those of the plain one.
const MANY: u64 = 10_000;
const FEW: u64 = 120;

/// Choices of modes up to which a mixture is compared in the plain run.
const LIGHT: u64 = 64;

/// How many particles of each state.
#[derive(Clone, Copy)]
struct Mixture {
    free: usize,
    zero: usize,
    stick: usize,
    slip: usize,
}

impl Mixture {
    fn choices(self) -> u64 {
        (1 << self.slip) * (1 << (2 * self.zero))
    }

    /// One to six particles, one of them in impending slip.
    fn all() -> Vec<Mixture> {
        let mut all = Vec::new();
        for slip in 1..=6 {
            for zero in 0..=6 - slip {
                for stick in 0..=6 - slip - zero {
                    for free in 0..=6 - slip - zero - stick {
                        all.push(Mixture {
                            free,
                            zero,
                            stick,
                            slip,
                        });
                    }
                }
            }
        }

        all
    }

    /// The states, the signs of s by the bits of `signs`.
    fn states(self, signs: u64) -> Vec<ContactState> {
        let mut states = Vec::new();
        for p in 0..self.slip {
            let sign = if signs >> p & 1 == 0 { 1 } else { -1 };
            states.push(ContactState::Slip { sign });
        }
        states.extend(vec![ContactState::Zero; self.zero]);
        states.extend(vec![ContactState::Stick; self.stick]);
        states.extend(vec![ContactState::Free; self.free]);
        states
    }
}

/// What a run has met.
#[derive(Debug, Default)]
struct Corners {
    compared: usize,
    degenerate: usize,
    mixtures: usize,
    six_particles: usize,
    with_factors: usize,
    solutions_of: [usize; 2],
    modes: ZeroModes,
    several_zero: usize,
    irrational: usize,
}

impl Corners {
    /// The mode of each z particle in a solution.
    fn count(&mut self, split: &Reduced, unknown: usize, solution: &Solution) {
        self.solutions_of[unknown] += 1;
        self.several_zero += usize::from(split.zero.len() > 1);
        self.irrational += usize::from(solution.value.as_rational().is_none());

        self.modes.count(split, &solution.slip);
    }
}

fn random_system(index: u64, mixture: Mixture) -> System {
    let mut rng = rng(FAMILY, index);
    let signs = rng.random_range(0..64);
    let system = states::system(&mut rng, &mixture.states(signs), &mut Vec::new()).unwrap();
    if index.is_multiple_of(3) {
        with_factors(&system, &mut rng)
    } else {
        system
    }
}

/// Compares both enumerators on a system.
fn compare(index: u64, mixture: Mixture, corners: &mut Corners) {
    let system = random_system(index, mixture);
    let place = (index % 2) as usize;
    let unknown = UNKNOWNS[place];
    let label = format!("system {index}, {unknown:?}");

    let physical = PhysicalSystem::of(&system, unknown).unwrap();
    let direct = enumerate_motions(&physical, &Window::all()).unwrap();
    let split = reduce_system(&system, unknown).unwrap();
    let found = enumerate_modes(&split, &Window::all());
    let choices = ((1 << mixture.slip) - 1) * (1u64 << (2 * mixture.zero));
    assert_eq!(found.choices, choices, "{label}");

    if !direct.degenerate.is_empty() || !found.degenerate.is_empty() {
        corners.degenerate += 1;
        return;
    }

    assert_eq!(direct.motions.len(), found.solutions.len(), "{label}");
    for solution in &found.solutions {
        let lifted = lift(&system, unknown, &split.variables, &solution.x);
        let is_same = |motion: &&Motion| is_same_motion(motion, solution, &lifted);
        let same = direct.motions.iter().filter(is_same).count();
        assert_eq!(same, 1, "{label}");

        let value = &mut solution.value.clone();
        let lines = check_lines(&system, unknown, &lifted, value);
        assert_eq!(lines, Ok(()), "{label}");
        assert_accepted(&system, unknown, solution, &label);
        corners.count(&split, place, solution);
    }

    corners.compared += 1;
    corners.six_particles += usize::from(system.particles().len() == 6);
    corners.with_factors += usize::from(index.is_multiple_of(3));
}

/// Is v of the motion a positive multiple of the lifted one, at the same value?
fn is_same_motion(motion: &Motion, solution: &Solution, lifted: &Lifted) -> bool {
    let mut value = solution.value.clone();
    if !value.equals(&mut motion.value.clone()) {
        return false;
    }

    let moves = |i: &usize| value.clone().sign_of(&lifted.v[*i]) != Sign::Zero;
    let Some(pivot) = (0..lifted.v.len()).find(moves) else {
        return false;
    };
    if value.sign_of(&motion.v[pivot]) != value.sign_of(&lifted.v[pivot]) {
        return false;
    }

    for (v_i, u_i) in motion.v.iter().zip(&lifted.v) {
        let minor = &(v_i * &lifted.v[pivot]) - &(u_i * &motion.v[pivot]);
        if value.sign_of(&minor) != Sign::Zero {
            return false;
        }
    }

    true
}

/// The checker accepts the solution as an exact claim, and refuses it with the other orientation.
fn assert_accepted(system: &System, unknown: Unknown, solution: &Solution, label: &str) {
    let body = Body::System(system.clone());
    let problem = Problem::new(body, unknown, Window::all()).unwrap();
    let claim = exact_claim(solution);
    let accepted = check(&problem, &certificate(&problem, claim.clone()));
    assert!(accepted.is_ok(), "{label}: {accepted:?}");

    let mut opposite = claim;
    for coefficient in opposite.x.iter_mut().flatten() {
        coefficient.0 = -coefficient.0.clone();
    }
    assert!(
        check(&problem, &certificate(&problem, opposite)).is_err(),
        "{label}"
    );
}

fn certificate(problem: &Problem, claim: ExactSolution) -> Certificate {
    Certificate {
        problem_sha256: problem.sha256(),
        unknown: problem.unknown(),
        window: Window::all(),
        claims: vec![Claim::ExactSolution(claim)],
        complete_set: None,
        negative: None,
    }
}

/// The solution with an interval so short that all signs are certain.
fn exact_claim(solution: &Solution) -> ExactSolution {
    let mut value: Algebraic = solution.value.clone();
    value.refine_to(&rational(1, 1 << 40));
    for _ in 0..20 {
        value.refine();
    }

    let interval = [value.interval().lo(), value.interval().hi()];
    ExactSolution {
        support: solution.slip.clone(),
        biactive: solution.biactive.clone(),
        polynomial: value.poly().coeffs().to_vec(),
        interval: interval.map(|end| Number(end.clone())),
        x: value.reduce(&solution.x).iter().map(coefficients).collect(),
    }
}

fn coefficients(polynomial: &Poly) -> Vec<Number> {
    let integers = polynomial.coeffs().iter().cloned();
    integers
        .map(|c| Number(Rational::from_integer(c)))
        .collect()
}

/// Light mixtures with z particles.
#[test]
fn modes_of_the_split_form_are_the_motions() {
    let mut light = Mixture::all();
    light.retain(|mixture| mixture.zero > 0 && mixture.choices() <= LIGHT);

    let mut corners = Corners::default();
    for index in 0..FEW {
        let place = (7 * index) as usize % light.len();
        compare(index, light[place], &mut corners);
    }

    println!("{corners:?}");
    assert!(corners.compared >= 110, "{corners:?}");
    assert!(corners.with_factors >= 30, "{corners:?}");
    for solutions in corners.solutions_of {
        assert!(solutions >= 10, "{corners:?}");
    }
    assert!(corners.modes.rarest() >= 3, "{corners:?}");
}

/// All 126 mixtures once, and light ones up to 10,000 systems.
#[test]
#[ignore = "minutes in release"]
fn modes_of_the_split_form_are_the_motions_of_ten_thousand_systems() {
    let all = Mixture::all();
    assert_eq!(all.len(), 126);
    let mut light = all.clone();
    light.retain(|mixture| mixture.choices() <= LIGHT);

    let mut corners = Corners::default();
    for index in 0..MANY {
        let mixture = match all.get(index as usize) {
            Some(mixture) => {
                corners.mixtures += 1;
                *mixture
            }
            None => light[index as usize % light.len()],
        };
        compare(FEW + index, mixture, &mut corners);
    }

    println!("{corners:?}");
    assert_eq!(corners.mixtures, 126);
    assert!(corners.compared >= 9_500, "{corners:?}");
    assert!(corners.six_particles >= 500, "{corners:?}");
    assert!(corners.with_factors >= 3_000, "{corners:?}");
    assert!(corners.several_zero >= 300, "{corners:?}");
    assert!(corners.irrational >= 1_000, "{corners:?}");
    for solutions in corners.solutions_of {
        assert!(solutions >= 1_000, "{corners:?}");
    }
    assert!(corners.modes.rarest() >= 200, "{corners:?}");
}

/// A run that is stopped says how far it came; more than 2^16 choices are refused.
#[test]
fn an_enumeration_of_modes_can_be_stopped_and_is_limited() {
    let mixture = |slip, zero| Mixture {
        free: 0,
        zero,
        stick: 0,
        slip,
    };
    let split = |mixture| reduce_system(&random_system(0, mixture), Unknown::Lambda2).unwrap();
    let window = Window::all();

    let two_and_one = split(mixture(2, 1));
    let all = enumerate_modes_with(&two_and_one, &window, |_, _| ControlFlow::Continue(()));
    let all = all.unwrap();
    assert_eq!((all.choices, all.choices_total), (12, 12));
    assert!(all.is_finished());

    let up_to_five = |done, total| {
        assert_eq!(total, 12);
        if done < 5 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    let stopped = enumerate_modes_with(&two_and_one, &window, up_to_five).unwrap();
    assert_eq!(stopped.choices, 5);
    assert!(!stopped.is_finished() && !stopped.is_complete_list());

    let too_many = split(mixture(1, 8));
    let refused = enumerate_modes_with(&too_many, &window, |_, _| ControlFlow::Break(()));
    let limit = OracleError::TooLarge {
        what: "slip variables + 2 z particles",
        limit: 16,
        got: 17,
    };
    assert_eq!(refused.unwrap_err(), limit);
}
