//! Claims in the degrees of freedom of a system: every enumerated solution lifts to one that is
//! accepted, and each line of (9) has a forgery that breaks just that line.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim, ExactSolution, LiftedSolution};
use mceip_check::{Reason, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, flattened, lifted, propose};
use mceip_engine::reduction::reduce;
use mceip_exact::{Sparse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_testkit::{forgeries, mechanical};

/// Exact claims for all that the enumerator lists.
fn claims(problem: &Problem) -> Vec<ExactSolution> {
    let pencil = reduce(problem).unwrap().pencil;
    let of = |s: &mceip_oracle::Solution| {
        let x = s
            .x_decimals(&pencil.slip(), 17)
            .iter()
            .map(|t| t.parse().unwrap())
            .collect();
        match propose(
            &pencil,
            problem.window(),
            &Candidate {
                value: s.decimal(17).parse().unwrap(),
                x,
            },
        )
        .unwrap()
        {
            Claim::ExactSolution(c) => c,
            other => panic!("{other:?}"),
        }
    };
    enumerate(&pencil, problem.window())
        .unwrap()
        .solutions
        .iter()
        .map(of)
        .collect()
}

fn system(problem: &Problem) -> &System {
    match problem.body() {
        Body::System(s) => s,
        Body::Pencil(_) => panic!("a system"),
    }
}

#[test]
fn every_solution_of_random_systems_is_accepted_lifted_and_its_forgeries_are_not() {
    let (mut count, mut forged) = (0, 0);
    for instance in mechanical(60, 5).unwrap() {
        let problem = &instance.problem;
        for exact in claims(problem) {
            let claim = lifted(system(problem), problem.unknown(), &exact);
            assert_eq!(
                flattened(system(problem), &claim),
                exact,
                "{}",
                instance.label
            );
            let own = certificate(problem, vec![Claim::LiftedSolution(claim)]);
            let accepted =
                check(problem, &own).unwrap_or_else(|e| panic!("{}: {e}", instance.label));
            assert_eq!(
                accepted.claims,
                check(
                    problem,
                    &certificate(problem, vec![Claim::ExactSolution(exact)])
                )
                .unwrap()
                .claims
            );
            assert_eq!(Certificate::from_json(&own.to_json()).unwrap(), own);
            for f in forgeries(&own) {
                let reason = check(problem, &f.certificate).expect_err(f.name).reason;
                assert!((f.expected)(&reason), "{}: {reason}", f.name);
                forged += 1;
            }
            count += 1;
        }
    }
    assert!(count > 20 && forged > 8 * count, "{count} {forged}");
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), a second slip particle (5,
/// 6).
fn example() -> (Problem, LiftedSolution) {
    let mut k = vec![
        (0, 1, 1),
        (1, 0, 1),
        (1, 2, -9),
        (2, 1, -9),
        (1, 5, 1),
        (5, 1, 1),
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
    let claim = lifted(&system, Unknown::Lambda2, &claims(&problem)[0]);
    (problem, claim)
}

/// A particle that rests in `example` does so on the friction cone's inside: index 2 of the pencil.
#[test]
fn each_line_has_a_forgery() {
    let (problem, good) = example();
    assert_eq!(
        good.support,
        [1],
        "the first particle slips, the second rests"
    );
    let verdict = |c: &LiftedSolution| {
        check(
            &problem,
            &certificate(&problem, vec![Claim::LiftedSolution(c.clone())]),
        )
        .map_err(|r| r.reason)
    };
    assert!(verdict(&good).is_ok());
    let tiny = || Number(rational(1, 1_000_000_000_000));
    let line = |wanted: &'static str, place: usize, change: &dyn Fn(&mut LiftedSolution)| {
        let mut c = good.clone();
        change(&mut c);
        match verdict(&c) {
            Err(Reason::Line { line, index, .. }) => assert_eq!((line, index), (wanted, place)),
            other => panic!("{wanted}: {other:?}"),
        }
    };
    // v changed alone always breaks the first line; the later ones need w changed with it: w = (t M
    // + K) v.
    let moved = |c: &mut LiftedSolution, dof: usize, by: &Number| {
        let s = system(&problem);
        add(&mut c.v[dof], 0, &by.0);
        for (row, column, k) in s.stiffness().entries().filter(|(_, j, _)| *j == dof) {
            assert_eq!(column, dof);
            add(&mut c.w[row], 0, &(k * &by.0));
        }
        for (row, _, m) in s.mass().unwrap().entries().filter(|(_, j, _)| *j == dof) {
            add(&mut c.w[row], 1, &(m * &by.0));
        }
    };
    line("(lambda^2 M + K) v = w", 6, &|c| {
        add(&mut c.w[6], 0, &tiny().0)
    });
    line("(lambda^2 M + K) v = w", 0, &|c| {
        add(&mut c.v[0], 0, &tiny().0)
    });
    line("w_f = 0", 0, &|c| moved(c, 0, &tiny()));
    line("v_d = 0", 1, &|c| moved(c, 3, &tiny()));
    line("v_d = 0", 1, &|c| moved(c, 4, &tiny()));
    line("v_N = 0", 2, &|c| moved(c, 6, &tiny()));
    line("S v_T < 0 on the support", 2, &|c| c.support = vec![1, 2]);
    line("S w_T + mu w_N = 0 where biactive", 2, &|c| {
        c.biactive = vec![2]
    });
    line("S v_T = 0 off the support", 0, &|c| c.support.clear());
    let backwards = |c: &mut LiftedSolution| {
        c.v.iter_mut()
            .chain(&mut c.w)
            .flatten()
            .for_each(|n| n.0 = -n.0.clone())
    };
    line("S v_T < 0 on the support", 0, &backwards);
}

fn add(p: &mut Vec<Number>, k: usize, by: &mceip_exact::Rational) {
    while p.len() <= k {
        p.push(Number(whole(0)));
    }
    p[k].0 += by;
}

/// The cone's inside and its surface: a problem whose friction differs by 1e-30 breaks
/// complementarity.
#[test]
fn friction_off_by_1e_30_breaks_complementarity() {
    let (problem, good) = example();
    let s = system(&problem);
    let mu = s.friction().unwrap() + mceip_exact::parse("1e-30").unwrap();
    let other = System::new(
        s.stiffness().clone(),
        s.mass().cloned(),
        Some(mu),
        s.particles().to_vec(),
    )
    .unwrap();
    let other = Problem::new(Body::System(other), Unknown::Lambda2, Window::all()).unwrap();
    let reason = check(
        &other,
        &certificate(&other, vec![Claim::LiftedSolution(good.clone())]),
    )
    .unwrap_err()
    .reason;
    assert!(
        matches!(
            reason,
            Reason::Line {
                line: "(S w_T + mu w_N) (S v_T) = 0",
                index: 0,
                ..
            }
        ),
        "{reason}"
    );
    // A pencil has no dofs to speak of.
    let pencil = Problem::new(
        Body::Pencil(reduce(&problem).unwrap().pencil),
        Unknown::Lambda2,
        Window::all(),
    )
    .unwrap();
    let reason = check(
        &pencil,
        &certificate(&pencil, vec![Claim::LiftedSolution(good)]),
    )
    .unwrap_err()
    .reason;
    assert_eq!(reason, Reason::NotASystem);
}
