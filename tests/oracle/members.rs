//! What is proved of every body within the radii of its data, against the exact enumerator.
//!
//! Members are taken at corners of what the radii allow and within. At the end of the proved
//! absence and below it none of them has a solution, and at both ends of the proved presence and
//! between each has one. A certificate that forgets its radii is one of another problem, and one
//! that reaches beyond the critical mu of a member is refused.
#![cfg(feature = "testkit")]

use mceip_check::certificate::CriticalCertificate;
use mceip_check::{Reason, check_critical};
use mceip_engine::analysis::{Analysis, AnalysisOptions, ProofCertificate, analyse};
use mceip_engine::run::Watch;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ContactState, Problem, Radii, System, Unknown, Window};
use mceip_oracle::{Enumeration, enumerate};
use mceip_testkit::{Corner, mechanical, system_of};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

#[derive(Debug, Default)]
struct Counts {
    absent: usize,
    present: usize,
    /// Proved both ways.
    both: usize,
    free: usize,
    coupled: usize,
    oblique: usize,
    /// Certificates moved beyond the critical mu of a member.
    forged: usize,
}

/// The system with radii of all its data: a share of 1/500 of K, 1/1000 of M, 1/100 of friction.
fn with_radii(system: &System) -> System {
    let mut particles = system.particles().to_vec();
    for particle in &mut particles {
        particle.reaction = None;
        if matches!(particle.state, ContactState::Slip { .. }) {
            let factor = &particle.friction_factor;
            let off = factor * rational(1, 100);
            particle.friction_factor_range = Some([factor - &off, factor + &off]);
        }
    }

    let radii = Radii {
        stiffness: Some(Radii::relative(system.stiffness(), &rational(1, 500))),
        mass: system
            .mass()
            .map(|m| Radii::relative(m, &rational(1, 1000))),
    };
    let stiffness = system.stiffness().clone();
    let mass = system.mass().cloned();
    let friction = system.friction().cloned();
    let exact = System::new(stiffness, mass, friction, particles).unwrap();
    exact.with_radii(radii).unwrap()
}

/// A member: each number at an end of its interval, or at a quarter of it.
fn member(of: &System, rng: &mut ChaCha8Rng) -> System {
    let mut off = |matrix: &Sparse, radius: &Option<Sparse>| {
        let mut entries = Vec::new();
        for (i, j, r) in radius
            .iter()
            .flat_map(Sparse::entries)
            .filter(|(i, j, _)| i <= j)
        {
            let share = rational([-4, -4, 4, 4, 1][rng.random_range(0..5)], 4);
            entries.push((i, j, r * &share));
            if i != j {
                entries.push((j, i, r * share));
            }
        }
        let order = matrix.rows();
        matrix.add_scaled(&whole(1), &Sparse::from_entries(order, order, entries))
    };

    let stiffness = off(of.stiffness(), &of.radii().stiffness);
    let mass = of.mass().map(|mass| off(mass, &of.radii().mass));
    let mut particles = of.as_given().particles().to_vec();
    for (particle, given) in particles.iter_mut().zip(of.particles()) {
        if let Some([lo, hi]) = &given.friction_factor_range {
            particle.friction_factor = if rng.random_bool(0.5) { lo } else { hi }.clone();
        }
    }
    System::new(stiffness, mass, of.friction().cloned(), particles).unwrap()
}

/// MCEIP-lambda2 of a system at a mu.
fn problem_at(system: &System, mu: &Rational) -> Problem {
    let states: Vec<_> = system.particles().iter().map(|p| p.state).collect();
    let system = system.with_states(&states, Some(mu.clone())).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

fn solve(system: &System, mu: &Rational) -> Enumeration {
    let problem = problem_at(system, mu);
    enumerate(&reduce(&problem).unwrap().pencil, &Window::all()).unwrap()
}

fn has_solution(system: &System, mu: &Rational) -> bool {
    let found = solve(system, mu);
    !found.solutions.is_empty() || !found.cones.is_empty()
}

/// The certificate of absence of every member, if there is one.
fn absence(analysis: &Analysis) -> Option<&CriticalCertificate> {
    let proof = analysis
        .proofs
        .iter()
        .find(|p| p.name == "members-absence")?;
    match &proof.certificate {
        ProofCertificate::Absence(proved) => Some(proved.certificate()),
        _ => None,
    }
}

/// The analysis of a system at a mu, without samples.
fn analysis_of(system: &System, mu: &Rational) -> Analysis {
    let options = AnalysisOptions {
        samples: 0,
        ..AnalysisOptions::default()
    };
    analyse(system, mu, &options, &Watch::nobody()).unwrap()
}

/// Radii that leave nothing definite of K_ff: what is said of the body as given stays, and of the
/// members it is said why nothing is proved.
#[test]
fn radii_beyond_every_hypothesis_leave_the_answer_about_the_body() {
    let mut free = 0;
    for instance in mechanical(24, 42).unwrap() {
        let given = system_of(&instance.problem);
        let has_slip = !given.slip_particles().is_empty();
        if !has_slip || !given.zero_particles().is_empty() || given.free_dofs().is_empty() {
            continue;
        }

        free += 1;
        let radii = Radii {
            stiffness: Some(Radii::relative(given.stiffness(), &rational(3, 2))),
            mass: None,
        };
        let system = given.as_given().with_radii(radii).unwrap();
        let mu = given.friction().cloned().unwrap_or(whole(1));
        let [of_one, of_all] = [given, &system].map(|system| analysis_of(system, &mu));
        assert_eq!(of_all.divergence.verdict, of_one.divergence.verdict);
        assert_eq!(of_all.critical.absent_below, of_one.critical.absent_below);

        let members = of_all.members.as_ref().unwrap();
        assert!(members.absent_below.is_none() && members.present.is_none());
        assert!(members.obstacle.is_some(), "{}", instance.label);
        assert!(
            of_all
                .summary()
                .contains("within their radii nothing is proved")
        );
    }
    assert!(free >= 6, "{free}");
}

#[test]
fn members_are_as_the_certificates_say() {
    let mut counts = Counts::default();
    let mut rng = ChaCha8Rng::seed_from_u64(41);
    for instance in mechanical(48, 41).unwrap() {
        let given = system_of(&instance.problem);
        if given.slip_particles().is_empty() || !given.zero_particles().is_empty() {
            continue;
        }

        let label = &instance.label;
        let system = with_radii(given);
        let mu = given.friction().cloned().unwrap_or(whole(1));
        let analysis = analysis_of(&system, &mu);
        let found = analysis.members.as_ref().unwrap();
        let members: Vec<System> = (0..4).map(|_| member(&system, &mut rng)).collect();

        if let Some((below, _)) = &found.absent_below {
            counts.absent += 1;
            counts.coupled += usize::from(instance.corners.contains(&Corner::CoupledMass));
            counts.free += usize::from(!system.free_dofs().is_empty());
            counts.oblique += usize::from(system.particles().iter().any(|p| p.frame.is_some()));
            for member in &members {
                for mu in [below.clone(), below * rational(1, 3)] {
                    assert!(!has_solution(member, &mu), "{label} at {mu}");
                }
            }
        }
        if let Some(([from, to], _)) = &found.present {
            counts.present += 1;
            counts.both += usize::from(found.absent_below.is_some());
            for member in &members {
                for mu in [from.clone(), (from + to) / whole(2), to.clone()] {
                    assert!(has_solution(member, &mu), "{label} at {mu}");
                }
            }
        }
        if let (Some(certificate), Some(([from, _], _))) = (absence(&analysis), &found.present) {
            let mut beyond = certificate.clone();
            beyond.below = from.clone();
            let problem = problem_at(&system, &mu);
            assert!(check_critical(&problem, certificate).is_ok(), "{label}");
            assert!(check_critical(&problem, &beyond).is_err(), "{label}");

            let forgetful = problem.as_given();
            let refused = check_critical(&forgetful, certificate).unwrap_err();
            assert!(matches!(refused.reason, Reason::Digest { .. }), "{label}");
            counts.forged += 1;
        }
    }

    eprintln!("{counts:?}");
    assert!(counts.absent >= 40, "{counts:?}");
    assert!(counts.present >= 24, "{counts:?}");
    assert!(counts.both.min(counts.forged) >= 24, "{counts:?}");
    assert!(
        counts.free.min(counts.coupled).min(counts.oblique) >= 10,
        "{counts:?}"
    );
}
