//! The way back to (9): lifted solutions satisfy every line, and each line notices its own breach.
#![cfg(feature = "testkit")]

use mceip_engine::reduction::{Lifted, Line, check_lines, lift, reduce};
use mceip_exact::{Algebraic, Poly, Sparse, whole};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_testkit::mechanical;

#[test]
fn every_solution_of_random_systems_lifts() {
    let mut count = 0;
    for instance in mechanical(60, 5).unwrap() {
        let Body::System(system) = instance.problem.body() else {
            panic!("a system")
        };
        let reduced = reduce(&instance.problem).unwrap();
        for s in enumerate(&reduced.pencil, instance.problem.window())
            .unwrap()
            .solutions
        {
            let lifted = lift(system, instance.problem.unknown(), &reduced.variables, &s.x);
            assert_eq!(
                check_lines(
                    system,
                    instance.problem.unknown(),
                    &lifted,
                    &mut s.value.clone()
                ),
                Ok(()),
                "{}",
                instance.label
            );
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), a second slip particle (5,
/// 6).
fn example() -> (System, Lifted, Algebraic) {
    let mut k = vec![
        (0, 1, 1),
        (1, 0, 1),
        (1, 2, -9),
        (2, 1, -9),
        (1, 5, -1),
        (5, 1, -1),
    ];
    k.extend((0..7).map(|i| (i, i, 4)));
    let k = Sparse::from_entries(7, 7, k.into_iter().map(|(i, j, v)| (i, j, whole(v))));
    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![
        Particle::plain(1, 2, slip),
        Particle::plain(3, 4, ContactState::Stick),
        Particle::plain(5, 6, slip),
    ];
    let system = System::new(k, Some(Sparse::identity(7)), Some(whole(2)), particles).unwrap();
    let problem = Problem::new(
        Body::System(system.clone()),
        Unknown::Lambda2,
        Window::all(),
    )
    .unwrap();
    let reduced = reduce(&problem).unwrap();
    let s = enumerate(&reduced.pencil, problem.window())
        .unwrap()
        .solutions
        .remove(0);
    let lifted = lift(&system, Unknown::Lambda2, &reduced.variables, &s.x);
    (system, lifted, s.value)
}

#[test]
fn each_line_notices_its_breach() {
    let (system, good, mut value) = example();
    let line = |lifted: &Lifted, value: &mut Algebraic| {
        check_lines(&system, Unknown::Lambda2, lifted, value)
            .err()
            .map(|e| e.line)
    };
    assert_eq!(line(&good, &mut value), None);
    let one = Poly::from_ints(&[1]);
    let breach = |change: &dyn Fn(&mut Lifted)| {
        let mut lifted = good.clone();
        change(&mut lifted);
        line(&lifted, &mut value.clone())
    };
    assert_eq!(
        breach(&|l| l.v.iter_mut().for_each(|p| *p = Poly::default())),
        Some(Line::NonTrivial)
    );
    assert_eq!(breach(&|l| l.w[0] = one.clone()), Some(Line::FreeReaction));
    assert_eq!(breach(&|l| l.v[3] = one.clone()), Some(Line::StickRate));
    assert_eq!(breach(&|l| l.v[2] = one.clone()), Some(Line::NormalRate));
    assert_eq!(
        breach(&|l| l.v.iter_mut().for_each(|p| *p = -&*p)),
        Some(Line::SlipDirection)
    );
    assert_eq!(
        breach(&|l| l.w[1] = &l.w[1] + &one),
        Some(Line::FrictionCone)
    );
    assert_eq!(
        breach(&|l| l.w[1] = &l.w[1] - &one),
        Some(Line::Complementarity)
    );
}
