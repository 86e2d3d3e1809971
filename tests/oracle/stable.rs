//! Certificates of stability against the exact enumerator, on random mechanical systems.
//!
//! The truth is a theorem: an equilibrium that is stable has no motion (8). So at every mu of a
//! certificate MCEIP-lambda2 has no solution, and none of MCEIP-mu has a mu in it. The law says
//! nothing where no certificate is found, which is counted.
#![cfg(feature = "testkit")]

use mceip_check::check_stability;
use mceip_engine::analysis::stable_until;
use mceip_engine::run::Watch;
use mceip_exact::{rational, to_f64};
use mceip_model::{Body, Problem, System, Unknown, Window};
use mceip_oracle::Enumeration;
use mceip_testkit::{Corner, at_friction, mechanical, solutions_of, system_of};

fn solve(system: System, unknown: Unknown) -> Enumeration {
    solutions_of(system, unknown, &Window::all())
}

#[derive(Debug, Default)]
struct Counts {
    stable: usize,
    /// With a mass that couples particles in contact.
    coupled: usize,
    free: usize,
    /// Systems with a threshold, to which the interval of mu is moved in a forgery.
    forged: usize,
    /// Those of them of which more than half of the mu below the threshold is proved.
    half: usize,
}

#[test]
fn nothing_diverges_where_stability_is_proved() {
    let mut counts = Counts::default();
    for instance in mechanical(200, 36).unwrap() {
        let system = system_of(&instance.problem);
        if system.slip_particles().is_empty() {
            continue;
        }
        let Some(proved) = stable_until(system, &Watch::nobody()).unwrap() else {
            continue;
        };

        let label = &instance.label;
        let to = &proved.accepted().to;
        counts.stable += 1;
        counts.coupled += usize::from(instance.corners.contains(&Corner::CoupledMass));
        counts.free += usize::from(!system.free_dofs().is_empty());
        for mu in [to.clone(), to * rational(1, 3)] {
            let found = solve(at_friction(system, &mu).unwrap(), Unknown::Lambda2);
            assert!(
                found.solutions.is_empty() && found.cones.is_empty(),
                "{label} at {mu}"
            );
        }

        // A certificate that reaches beyond a solution is refused.
        let thresholds = solve(at_friction(system, to).unwrap(), Unknown::Mu);
        let smallest = thresholds
            .solutions
            .iter()
            .map(|s| s.value.interval().hi())
            .min();
        if let Some(smallest) = smallest {
            assert!(to <= smallest, "{label}: {to}");
            counts.forged += 1;
            counts.half += usize::from(to_f64(to) > 0.5 * to_f64(smallest));

            let mut beyond = proved.certificate().clone();
            beyond.to = smallest * rational(1001, 1000);
            let problem = problem_of(system);
            assert!(
                check_stability(&problem, proved.certificate()).is_ok(),
                "{label}"
            );
            assert!(check_stability(&problem, &beyond).is_err(), "{label}");
        }
    }

    eprintln!("{counts:?}");
    assert!(counts.stable >= 150, "{counts:?}");
    assert!(counts.coupled.min(counts.free) >= 20, "{counts:?}");
    assert!(counts.forged >= 40, "{counts:?}");
    assert!(counts.half >= 12, "{counts:?}");
}

/// MCEIP-lambda2, to which certificates belong, whatever its mu.
fn problem_of(system: &System) -> Problem {
    let system = at_friction(system, &rational(1, 1)).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}
