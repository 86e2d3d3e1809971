//! Table 1: closed form = enumerator = what the solver finds, certified and accepted.
#![cfg(feature = "testkit")]

use mceip_engine::multistart::Search;
use mceip_engine::reduction::reduce;
use mceip_exact::{Poly, Sign, rational, whole};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use mceip_oracle::{TwoParticles, enumerate, table1, thresholds};
use mceip_paper::{pythagorean_angles, two_particles};
use mceip_testkit::{compare, table1_grid};

const SIGNS: [(i8, i8); 4] = [(1, 1), (1, -1), (-1, 1), (-1, -1)];

/// Every seventh instance of the grid; `mceip verify` and tests/campaign/verify.rs run all of it.
#[test]
fn the_solver_finds_every_solution_and_all_engines_agree() {
    let mut solutions = 0;
    for instance in table1_grid().unwrap().iter().step_by(7) {
        let report = compare(instance, &Search::default());
        assert!(
            report.disagreements.is_empty(),
            "{}: {:?}",
            report.label,
            report.disagreements
        );
        assert_eq!(report.found, report.oracle, "{}", report.label);
        solutions += report.oracle;
    }
    assert!(solutions > 30);
}

/// The irrational thresholds cannot be put into a rational grid (erratum O1), so they are compared
/// as exact MCEIP-mu values; the rational ones as well.
#[test]
fn thresholds_are_the_values_of_mceip_mu() {
    for (c, s) in pythagorean_angles() {
        for signs in SIGNS {
            let data = TwoParticles {
                c: c.clone(),
                s: s.clone(),
                k: rational(7, 3),
                m: whole(1),
                mu: whole(1),
                signs,
            };
            let problem = Problem::new(
                Body::System(two_particles(&data).unwrap()),
                Unknown::Mu,
                Window::all(),
            )
            .unwrap();
            let found = enumerate(&reduce(&problem).unwrap().pencil, problem.window()).unwrap();
            let closed = thresholds(&data);
            if c == whole(0) {
                // K is singular: every mu is an eigenvalue of the full support. For S1 = S2 its
                // kernel (1, 1) is a solution for every mu, otherwise it is (1, -1) and there is
                // none.
                assert_eq!(found.continua, vec![vec![0, 1]]);
                assert_eq!(
                    closed.map(|l| l.len()),
                    if signs.0 == signs.1 { None } else { Some(0) }
                );
                continue;
            }
            let closed = closed.unwrap();
            assert!(found.is_complete_list());
            assert_eq!(
                found.solutions.len(),
                closed.len(),
                "c = {c}, S = {signs:?}"
            );
            for t in closed {
                let equal = found.solutions.iter().filter(|f| {
                    let isolated = t
                        .value
                        .within(f.value.interval().lo(), f.value.interval().hi());
                    f.slip == t.slip
                        && isolated
                        && t.value.eval(f.value.poly()).sign() == Sign::Zero
                });
                assert_eq!(equal.count(), 1);
            }
        }
    }
}

/// At a threshold lambda^2 = 0 is a root; an inch below the solution is gone.
#[test]
fn thresholds_hold_with_equality() {
    let (c, s) = (rational(3, 5), rational(4, 5));
    let threshold = (&c * &c + whole(1)) / (&c * &s);
    for (mu, count) in [
        (threshold.clone(), 2),
        (&threshold - rational(1, 1_000_000_000_000), 0),
    ] {
        let data = TwoParticles {
            c: c.clone(),
            s: s.clone(),
            k: whole(1),
            m: whole(1),
            mu,
            signs: (1, -1),
        };
        assert_eq!(table1(&data).len(), count);
        let problem = Problem::new(
            Body::System(two_particles(&data).unwrap()),
            Unknown::Lambda2,
            Window::all(),
        )
        .unwrap();
        let mut found = enumerate(&reduce(&problem).unwrap().pencil, problem.window())
            .unwrap()
            .solutions;
        assert_eq!(found.len(), count);
        assert!(
            found
                .iter_mut()
                .all(|f| f.value.sign_of(&Poly::from_ints(&[0, 1])) == Sign::Zero)
        );
    }
}

/// The same body with the normals pointing up and down, and turned by a rotation: same solutions.
/// A wrong direction would mean mu -> -mu, silently.
#[test]
fn modelling_up_or_down_or_oblique_is_the_same() {
    let data = TwoParticles {
        c: rational(3, 5),
        s: rational(4, 5),
        k: whole(1),
        m: whole(1),
        mu: whole(8),
        signs: (1, -1),
    };
    let plain = two_particles(&data).unwrap();
    let values = |system: System| {
        let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap();
        let found = enumerate(&reduce(&problem).unwrap().pencil, problem.window()).unwrap();
        found
            .solutions
            .iter()
            .map(|s| (s.decimal(17), s.slip.clone()))
            .collect::<Vec<_>>()
    };
    let want = values(plain.clone());
    assert_eq!(want.len(), 3);
    // Normal dofs mirrored: rows and columns 1 and 3 of K change sign, and normal_direction says
    // so.
    let flip = |i: usize| whole(if i % 2 == 1 { -1 } else { 1 });
    let mirrored = mceip_exact::Sparse::from_entries(
        4,
        4,
        plain
            .stiffness()
            .entries()
            .map(|(i, j, v)| (i, j, v * flip(i) * flip(j))),
    );
    let particle = |i: usize, sign: i8, direction: i8| Particle {
        normal_direction: direction,
        ..Particle::plain(2 * i, 2 * i + 1, ContactState::Slip { sign })
    };
    let up = |direction: i8| {
        let particles = vec![particle(0, 1, direction), particle(1, -1, direction)];
        System::new(
            mirrored.clone(),
            plain.mass().cloned(),
            Some(whole(8)),
            particles,
        )
        .unwrap()
    };
    assert_eq!(values(up(-1)), want);
    assert_ne!(values(up(1)), want); // the mistake is visible
    // Both particles in axes turned by (3/5, 4/5): K' = Q' K Q with (T, N) = frame (first, second).
    let (a, b) = (rational(3, 5), rational(4, 5));
    let frame = [[a.clone(), b.clone()], [-b, a]];
    let q = mceip_exact::Sparse::from_entries(
        4,
        4,
        (0..2)
            .flat_map(|p| (0..4).map(move |k| (p, k)))
            .map(|(p, k)| (2 * p + k / 2, 2 * p + k % 2, frame[k / 2][k % 2].clone())),
    );
    let columns: Vec<Vec<_>> = (0..4)
        .map(|j| {
            q.transpose()
                .times(&plain.stiffness().times(&q.transpose().row(j).iter().fold(
                    vec![whole(0); 4],
                    |mut v, (i, x)| {
                        v[*i] = x.clone();
                        v
                    },
                )))
        })
        .collect();
    let turned = mceip_exact::Sparse::from_entries(
        4,
        4,
        (0..16).map(|k| (k % 4, k / 4, columns[k / 4][k % 4].clone())),
    );
    let oblique = |i: usize, sign: i8| Particle {
        frame: Some(frame.clone()),
        ..particle(i, sign, 1)
    };
    let system = System::new(
        turned,
        plain.mass().cloned(),
        Some(whole(8)),
        vec![oblique(0, 1), oblique(1, -1)],
    )
    .unwrap();
    assert_eq!(values(system), want);
}
