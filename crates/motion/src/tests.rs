//! The motion against closed forms, against certified modes and certified absence, and each law
//! against its breach.
//!
//! The truth is Table 1 in closed form, a certificate that the checker has accepted, or (1)-(4)
//! evaluated from K and M themselves. An integration of other equations, of another order, or with
//! slip in the wrong direction fails.

use super::*;
use mceip_engine::analysis::stable_until;
use mceip_engine::report::Listed;
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Sparse, parse, rational, to_f64, whole};
use mceip_model::reduction::reduce;
use mceip_model::{
    Body, ContactState, Direction, Particle, Problem, Reaction, System, Unknown, Window,
};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use mceip_testkit::{Corner, Instance, mechanical, system_of};
use nalgebra::dvector;

/// A motion in coordinates (q_1, q_2) of Fig. 1 with c = 3/5, s = 4/5, k = m = 1, mu = 8 and
/// S = (1, -1): lambda^2 = 37/25 for x = (1, 1), 62/25 for (1, 0) and (0, 1).
fn figure_1() -> Equations {
    Equations::new(&figure_1_system()).unwrap()
}

fn figure_1_system() -> System {
    let data = TwoParticles {
        c: rational(3, 5),
        s: rational(4, 5),
        k: whole(1),
        m: whole(1),
        mu: whole(8),
        signs: (1, -1),
    };
    two_particles(&data).unwrap()
}

fn plan(duration: f64, steps: usize) -> Plan {
    Plan { duration, steps }
}

#[test]
fn a_mode_of_table_1_grows_as_predicted_with_errors_of_second_order() {
    let equations = figure_1();
    let modes = [
        (37.0 / 25.0, dvector![1.0, 1.0]),
        (62.0 / 25.0, dvector![1.0, 0.0]),
        (62.0 / 25.0, dvector![0.0, 1.0]),
    ];

    for (lambda2, displacement) in modes {
        let mode = GrowthMode {
            lambda2,
            displacement,
        };
        let duration = mode.usual_duration(1.0);

        let growth = along_mode(&equations, &mode, plan(duration, 400)).unwrap();

        assert_eq!(growth.agreement(), GrowthAgreement::Agrees);
        assert!((growth.order().unwrap() - 2.0).abs() < 0.01);

        // The trapezoidal rule: lambda^3 h^2 t / 12 in steps of h/2.
        let expected = (4.0_f64).powi(3) / 12.0 / (800.0 * 800.0);
        assert!((growth.error / expected - 1.0).abs() < 0.02);
    }
}

/// lambda^2 wrong by a thousandth, or x by a hundredth.
#[test]
fn a_mode_that_is_none_does_not_agree() {
    let equations = figure_1();
    let near_misses = [
        (1.001 * 37.0 / 25.0, dvector![1.0, 1.0]),
        (37.0 / 25.0, dvector![1.01, 1.0]),
        (62.0 / 25.0, dvector![1.0, 0.01]),
    ];

    for (lambda2, displacement) in near_misses {
        let mode = GrowthMode {
            lambda2,
            displacement,
        };
        let duration = mode.usual_duration(1.0);

        let growth = along_mode(&equations, &mode, plan(duration, 400)).unwrap();

        assert_eq!(growth.agreement(), GrowthAgreement::Disagrees, "{lambda2}");
    }
}

/// A million roundings are part of the stated error; steps that are too long for the growth, or a
/// growth beyond doubles, are neither agreement nor contradiction.
#[test]
fn long_runs_agree_and_long_steps_say_nothing() {
    let equations = figure_1();
    let mode = GrowthMode {
        lambda2: 37.0 / 25.0,
        displacement: dvector![1.0, 1.0],
    };
    let judged = |duration: f64, steps: usize| {
        let growth = along_mode(&equations, &mode, plan(duration, steps)).unwrap();
        growth.agreement()
    };

    let usual = mode.usual_duration(1.0);
    assert_eq!(judged(usual, 500_000), GrowthAgreement::Agrees);
    assert_eq!(judged(30.0 * usual, 400), GrowthAgreement::NotResolved);
    assert_eq!(judged(1e3, 4000), GrowthAgreement::NotResolved);
}

/// From -x the accelerations would be against the slip direction: the particles stay where they
/// are.
#[test]
fn against_the_slip_direction_nothing_moves() {
    let equations = figure_1();
    let displacement = dvector![-1.0, -1.0];
    let start = Instant::start(&equations, displacement.clone(), dvector![0.0, 0.0]);

    let trajectory = run(&equations, start, plan(10.0, 400)).unwrap();

    let end = &trajectory.samples.last().unwrap().at;
    assert_eq!(end.displacement, displacement);
    assert_eq!(trajectory.class, MotionClass::NoGrowth);
}

/// The reactions at rest are on the cone; for x = (1, 1) both r_N grow by cs cosh(lambda t).
#[test]
fn the_range_ends_where_the_first_particle_lifts_off() {
    let mut system = figure_1_system();
    let normal = whole(-1);
    let mut particles = system.particles().to_vec();
    for (particle, sign) in particles.iter_mut().zip([1, -1]) {
        particle.reaction = Some(Reaction {
            tangential: whole(8 * sign),
            normal: normal.clone(),
        });
    }
    system = System::new(
        system.stiffness().clone(),
        system.mass().cloned(),
        system.friction().cloned(),
        particles,
    )
    .unwrap();
    let equations = Equations::new(&system).unwrap();
    let mode = GrowthMode {
        lambda2: 37.0 / 25.0,
        displacement: dvector![1.0, 1.0],
    };

    let growth = along_mode(&equations, &mode, plan(2.0, 2000)).unwrap();

    let range = growth.trajectory.range.unwrap();
    let expected = 25.0 / 12.0 / (2.0 * mode.rate()).cosh();
    assert!((range.amplitude / expected - 1.0).abs() < 0.001);
    assert_eq!((range.particle, range.limit), (0, Limit::LiftsOff));
}

/// Half of mu with twice the friction on each particle is the same motion.
#[test]
fn a_particle_has_its_own_friction() {
    let plain = figure_1_system();
    let mut particles = plain.particles().to_vec();
    for particle in &mut particles {
        particle.friction_factor = whole(2);
    }
    let halved = System::new(
        plain.stiffness().clone(),
        plain.mass().cloned(),
        Some(whole(4)),
        particles,
    )
    .unwrap();

    let expected = Equations::new(&plain).unwrap();
    let equations = Equations::new(&halved).unwrap();

    assert_eq!(equations.mass, expected.mass);
    assert_eq!(equations.stiffness, expected.stiffness);
}

#[test]
fn a_particle_with_zero_reaction_is_refused() {
    let plain = figure_1_system();
    let mut particles = plain.particles().to_vec();
    particles[1].state = ContactState::Zero;
    let system = System::new(
        plain.stiffness().clone(),
        plain.mass().cloned(),
        plain.friction().cloned(),
        particles,
    )
    .unwrap();

    let refused = Equations::new(&system);

    assert!(matches!(refused, Err(MotionError::Model(_))));
}

/// The largest violation of (1), (2) and (4) by the reactions in the middle of a step, all computed
/// from K and M, with this coefficient of friction.
fn violation(system: &System, mu: f64, equations: &Equations, from: &Instant, to: &Instant) -> f64 {
    let h = to.time - from.time;
    let acceleration = equations.displacement(&((&to.velocity - &from.velocity) / h));
    let middle = (&from.displacement + &to.displacement) / 2.0;
    let displacement = equations.displacement(&middle);
    let velocity = equations.displacement(&to.velocity);
    let mass = product(system.mass().unwrap(), &acceleration);
    let elastic = product(system.stiffness(), &displacement);
    let rho: Vec<f64> = mass.iter().zip(&elastic).map(|(m, k)| m + k).collect();

    let mut worst: f64 = 0.0;
    for dof in system.free_dofs() {
        worst = worst.max(rho[dof].abs());
    }
    for (particle, sign) in system.slip_particles() {
        let sign = f64::from(sign);
        let tangent = particle.tangent();
        let normal = particle.into_obstacle();
        let cone = sign * along(&tangent, &rho) + mu * along(&normal, &rho);
        let slip = sign * along(&tangent, &velocity);

        worst = worst.max(along(&normal, &displacement).abs());
        worst = worst.max(cone).max(slip).max((cone * slip).abs());
    }
    for particle in system.particles() {
        if particle.state == ContactState::Stick {
            worst = worst.max(along(&particle.tangent(), &displacement).abs());
            worst = worst.max(along(&particle.into_obstacle(), &displacement).abs());
        }
    }
    worst
}

fn product(matrix: &Sparse, x: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; x.len()];
    for (i, j, entry) in matrix.entries() {
        product[i] += to_f64(entry) * x[j];
    }
    product
}

fn along(direction: &Direction, x: &[f64]) -> f64 {
    let terms = direction.iter().map(|(dof, c)| to_f64(c) * x[*dof]);
    terms.sum()
}

#[test]
fn every_step_satisfies_1_to_4() {
    let mut steps_with_stick = 0;
    let mut breaches_noticed = 0;
    for instance in mechanical(40, 3).unwrap() {
        let system = system_of(&instance.problem);
        let equations = Equations::new(system).unwrap();
        let stepper = Stepper::new(&equations, 0.05).unwrap();
        if stepper.solutions() != StepSolutions::One {
            continue;
        }

        let mu = to_f64(system.friction().unwrap());
        let mut at = impulse(&equations, 1);
        for _ in 0..20 {
            let (next, _) = stepper.advance(&at).unwrap();
            let size = 1.0 + next.velocity.amax() / 0.05;

            let breach = violation(system, mu, &equations, &at, &next);
            assert!(breach < 1e-9 * size * size, "{}: {breach}", instance.label);

            let with_other_friction = violation(system, 1.1 * mu, &equations, &at, &next);
            breaches_noticed += usize::from(with_other_friction > 1e-3);
            steps_with_stick += usize::from(next.slips.contains(&false));
            at = next;
        }
    }

    assert!(steps_with_stick > 50, "{steps_with_stick}");
    assert!(breaches_noticed > 50, "{breaches_noticed}");
}

/// K* = [[-r, -s], [s, -r]] has lambda^2 = r + is: while both particles slip the motion spirals.
#[test]
fn a_spiral_is_flutter_until_a_particle_sticks() {
    let coupling = [("-1.96", "-0.4"), ("0.4", "-1.96")];
    let mut entries = Vec::new();
    for (i, (first, second)) in coupling.into_iter().enumerate() {
        entries.push((i, i, whole(1)));
        entries.push((2 + i, 2 + i, whole(10)));
        for (j, entry) in [first, second].into_iter().enumerate() {
            let entry = parse(entry).unwrap();
            entries.push((2 + i, j, entry.clone()));
            entries.push((j, 2 + i, entry));
        }
    }
    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![Particle::plain(0, 2, slip), Particle::plain(1, 3, slip)];
    let system = System::new(
        Sparse::from_entries(4, 4, entries),
        Some(Sparse::identity(4)),
        Some(whole(1)),
        particles,
    )
    .unwrap();
    let equations = Equations::new(&system).unwrap();
    let start = Instant::start(&equations, dvector![0.0, 0.0], dvector![1.0, 1.0]);

    let short = run(&equations, start.clone(), plan(3.0, 400)).unwrap();
    let long = run(&equations, start, plan(30.0, 4000)).unwrap();

    assert_eq!(short.class, MotionClass::Flutter);
    assert!(long.changes > 0);
    assert_ne!(long.class, MotionClass::Flutter);
}

/// What the comparison of random systems with their certificates has met.
#[derive(Debug, Default)]
struct Met {
    left_out: usize,
    with_divergence: usize,
    modes: usize,
    overtaken: usize,
    impulse_finds_mode: usize,
    runs_along_a_mode: usize,
    without: usize,
    stick_slip: usize,
    runs: usize,
    resolved: usize,
    oblique: usize,
    stick: usize,
    coupled: usize,
}

#[test]
fn random_systems_move_as_their_certificates_say() {
    let mut met = Met::default();
    for instance in mechanical(130, 20).unwrap() {
        compare(&instance, &mut met);
    }

    eprintln!("{met:?}");
    assert!(met.with_divergence >= 25 && met.without >= 25, "{met:?}");
    assert!(met.left_out >= 20, "{met:?}");
    assert!(met.impulse_finds_mode >= 25, "{met:?}");
    assert!(met.runs_along_a_mode >= 70, "{met:?}");
    assert!(met.stick_slip >= 2, "{met:?}");
    assert!(20 * met.resolved >= 19 * met.runs, "{met:?}");
    assert!(met.overtaken <= 2, "{met:?}");
    assert!(met.oblique.min(met.stick).min(met.coupled) >= 10, "{met:?}");
}

/// At the largest mu of which stability is proved, after impulses in any direction.
#[test]
fn nothing_grows_where_stability_is_proved() {
    let mut runs = 0;
    let mut resolved = 0;
    for instance in mechanical(200, 21).unwrap() {
        let system = system_of(&instance.problem);
        if system.slip_particles().is_empty() {
            continue;
        }
        let Some(proved) = stable_until(system, &Watch::nobody()).unwrap() else {
            continue;
        };

        let states: Vec<ContactState> = system.particles().iter().map(|p| p.state).collect();
        let friction = Some(proved.accepted().to.clone());
        let at_its_end = system.with_states(&states, friction).unwrap();
        let equations = Equations::new(&at_its_end).unwrap();
        let unit = equations.longest_period().unwrap();

        let run = AfterImpulse::new(&equations, 0, plan(20.0 * unit, 1000)).unwrap();
        runs += 1;
        if run.is_resolved() {
            resolved += 1;
            assert_eq!(run.fine.class, MotionClass::NoGrowth, "{}", instance.label);
        }
    }

    assert!(runs >= 150, "{runs}");
    assert!(10 * resolved >= 9 * runs, "{resolved} of {runs}");
}

fn compare(instance: &Instance, met: &mut Met) {
    let system = system_of(&instance.problem);
    let equations = Equations::new(system).unwrap();
    let limit = Stepper::new(&equations, 0.0).unwrap();
    if let StepSolutions::Several { .. } = limit.solutions() {
        met.left_out += 1;
        return;
    }
    assert_eq!(limit.solutions(), StepSolutions::One, "{}", instance.label);

    met.oblique += usize::from(instance.corners.contains(&Corner::Oblique));
    met.stick += usize::from(instance.corners.contains(&Corner::Stick));
    met.coupled += usize::from(instance.corners.contains(&Corner::CoupledMass));
    let unit = equations.longest_period().unwrap();
    let modes = certified_modes(system, &equations);

    for mode in &modes {
        let along_v = along_mode(&equations, mode, plan(mode.usual_duration(unit), 400)).unwrap();
        assert_eq!(
            along_v.agreement(),
            GrowthAgreement::Agrees,
            "{}: {mode:?}",
            instance.label
        );
        met.modes += 1;
        met.overtaken += usize::from(along_v.overtaken.is_some());
    }

    let impulse_plan = plan(20.0 * unit, 2000);
    let mut after = Vec::new();
    for seed in 0..2 {
        after.push(AfterImpulse::new(&equations, seed, impulse_plan).unwrap());
    }
    let resolved: Vec<&AfterImpulse> = after.iter().filter(|run| run.is_resolved()).collect();
    let classes: Vec<MotionClass> = resolved.iter().map(|run| run.fine.class).collect();
    let is_constant = classes.contains(&MotionClass::ConstantDirection);
    met.runs += after.len();
    met.resolved += resolved.len();

    if modes.is_empty() {
        met.without += 1;
        met.stick_slip += usize::from(classes.contains(&MotionClass::StickSlip));
        assert!(!is_constant, "{}: {classes:?}", instance.label);
    } else {
        met.with_divergence += 1;
        met.impulse_finds_mode += usize::from(is_constant);
        for run in &resolved {
            let step = impulse_plan.step().unwrap() / 2.0;
            met.runs_along_a_mode += usize::from(has_certified_rate(&run.fine, step, &modes));
        }
    }
}

/// Is a growth along a constant direction one with a certified lambda? In steps of h the
/// trapezoidal rule gives it the rate (2/h) artanh(h lambda / 2).
fn has_certified_rate(trajectory: &Trajectory, step: f64, modes: &[GrowthMode]) -> bool {
    if trajectory.class != MotionClass::ConstantDirection {
        return false;
    }

    let mut nearest = f64::INFINITY;
    for mode in modes {
        let expected = 2.0 / step * (step * mode.rate() / 2.0).atanh();
        nearest = nearest.min((trajectory.rate / expected - 1.0).abs());
    }
    assert!(
        nearest < 1e-4,
        "{} is {nearest} from any mode",
        trajectory.rate
    );
    true
}

/// All solutions of MCEIP-lambda2, by a certificate that the checker has accepted.
fn certified_modes(system: &System, equations: &Equations) -> Vec<GrowthMode> {
    let body = Body::System(system.clone());
    let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
    let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
    assert!(found.is_complete());

    let reduced = reduce(&problem).unwrap();
    let mut modes = Vec::new();
    for (_, listed) in Listed::of_cover(&problem, &reduced, &found) {
        let (v, _) = listed.lifted.unwrap();
        let v: Vec<f64> = v.iter().map(|decimal| decimal.parse().unwrap()).collect();
        modes.push(GrowthMode {
            lambda2: listed.value.parse().unwrap(),
            displacement: equations.coordinates(&v).unwrap(),
        });
    }
    modes
}

#[test]
fn what_is_no_motion_is_refused_by_name() {
    let system = figure_1_system();
    let equations = Equations::new(&system).unwrap();
    let at_rest = Instant::start(&equations, dvector![0.0, 0.0], dvector![0.0, 0.0]);

    for (duration, steps) in [(0.0, 10), (-1.0, 10), (f64::NAN, 10), (1.0, 0)] {
        let refused = run(&equations, at_rest.clone(), plan(duration, steps));
        assert!(matches!(refused, Err(MotionError::Plan { .. })));
    }

    // h lambda = 6: the step along (1, 0) has a negative mass.
    let start = impulse(&equations, 0);
    let refused = run(&equations, start, plan(6.0, 1));
    assert!(matches!(refused, Err(MotionError::LongStep { .. })));

    let short = equations.coordinates(&[1.0]);
    assert!(matches!(
        short,
        Err(MotionError::Length {
            expected: 4,
            got: 1
        })
    ));

    let particles = system.particles().to_vec();
    let massless = System::new(system.stiffness().clone(), None, None, particles).unwrap();
    assert!(matches!(
        Equations::new(&massless),
        Err(MotionError::Model(_))
    ));
}
