//! Claims in the degrees of freedom of a system (lifted claims), as the checker sees them.
//!
//! The truth is the exact enumerator: every solution it lists lifts to a claim that is accepted.
//! The checker in turn must refuse: each line of (9) has a forgery that breaks just that line, and
//! the reason must name the line and the place.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim, ExactSolution, LiftedSolution};
use mceip_check::{Accepted, Reason, check};
use mceip_engine::candidate::Candidate;
use mceip_engine::certify::{certificate, flattened, lifted, propose};
use mceip_exact::{Rational, Sparse, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::reduction::reduce;
use mceip_model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};
use mceip_oracle::{Solution, enumerate};
use mceip_testkit::{forgeries, mechanical};

/// The exact claim for a solution that the enumerator lists.
fn exact_claim(pencil: &Pencil, window: &Window, solution: &Solution) -> ExactSolution {
    let mut x = Vec::new();
    for decimal in solution.x_decimals(&pencil.slip(), 17) {
        x.push(decimal.parse().unwrap());
    }
    let candidate = Candidate {
        value: solution.decimal(17).parse().unwrap(),
        x,
    };

    match propose(pencil, window, &candidate).unwrap() {
        Claim::ExactSolution(claim) => claim,
        other => panic!("{other:?}"),
    }
}

/// Exact claims for all that the enumerator lists.
fn exact_claims(problem: &Problem) -> Vec<ExactSolution> {
    let pencil = reduce(problem).unwrap().pencil;
    let answer = enumerate(&pencil, problem.window()).unwrap();

    let mut claims = Vec::new();
    for solution in &answer.solutions {
        claims.push(exact_claim(&pencil, problem.window(), solution));
    }
    claims
}

fn system_of(problem: &Problem) -> &System {
    match problem.body() {
        Body::System(system) => system,
        Body::Pencil(_) => panic!("a system"),
    }
}

/// What the checker says of one claim.
fn verdict(problem: &Problem, claim: Claim) -> Result<Accepted, Reason> {
    let certificate = certificate(problem, vec![claim]);
    check(problem, &certificate).map_err(|rejection| rejection.reason)
}

/// All forgeries of the certificate are refused for the reason that each expects; their number.
fn count_of_refused_forgeries(problem: &Problem, own: &Certificate) -> usize {
    let mut count = 0;
    for forgery in forgeries(own) {
        let rejection = check(problem, &forgery.certificate).expect_err(forgery.name);
        let reason = rejection.reason;
        assert!((forgery.expected)(&reason), "{}: {reason}", forgery.name);
        count += 1;
    }
    count
}

#[test]
fn every_solution_of_random_systems_is_accepted_lifted_and_its_forgeries_are_not() {
    let mut count = 0;
    let mut forged = 0;

    for instance in mechanical(60, 5).unwrap() {
        let label = &instance.label;
        let problem = &instance.problem;
        let system = system_of(problem);

        for exact in exact_claims(problem) {
            let claim = lifted(system, problem.unknown(), &exact);
            assert_eq!(flattened(system, &claim), exact, "{label}");

            let own = certificate(problem, vec![Claim::LiftedSolution(claim)]);
            let accepted = match check(problem, &own) {
                Ok(accepted) => accepted,
                Err(rejection) => panic!("{label}: {rejection}"),
            };
            let accepted_exact = verdict(problem, Claim::ExactSolution(exact)).unwrap();
            assert_eq!(accepted.claims, accepted_exact.claims);
            assert_eq!(Certificate::from_json(&own.to_json()).unwrap(), own);

            forged += count_of_refused_forgeries(problem, &own);
            count += 1;
        }
    }

    assert!(count > 20, "{count} {forged}");
    assert!(forged > 8 * count, "{count} {forged}");
}

/// A problem and the lifted claim of its first solution.
struct Example {
    problem: Problem,
    claim: LiftedSolution,
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), and a second slip particle
/// on (5, 6), which rests inside its friction cone.
fn example() -> Example {
    let mut stiffness = Vec::new();
    for dof in 0..7 {
        stiffness.push((dof, dof, whole(4)));
    }
    for (i, j, value) in [(0, 1, 1), (1, 2, -9), (1, 5, 1)] {
        stiffness.push((i, j, whole(value)));
        stiffness.push((j, i, whole(value)));
    }
    let stiffness = Sparse::from_entries(7, 7, stiffness);
    let mass = Sparse::identity(7);

    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![
        Particle::plain(1, 2, slip),
        Particle::plain(3, 4, ContactState::Stick),
        Particle::plain(5, 6, slip),
    ];
    let system = System::new(stiffness, Some(mass), Some(whole(2)), particles).unwrap();
    let body = Body::System(system.clone());
    let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();

    let claim = lifted(&system, Unknown::Lambda2, &exact_claims(&problem)[0]);
    Example { problem, claim }
}

/// Adds a number to the coefficient of t^power.
fn add_to_coefficient(polynomial: &mut Vec<Number>, power: usize, amount: &Rational) {
    while polynomial.len() <= power {
        polynomial.push(Number(whole(0)));
    }
    polynomial[power].0 += amount;
}

fn tiny() -> Rational {
    rational(1, 1_000_000_000_000)
}

/// Adds a tiny number to one component of v, and to w what keeps w = (t M + K) v.
///
/// v changed alone always breaks the first line; the later ones need w changed with it.
fn shift_motion(system: &System, claim: &mut LiftedSolution, dof: usize) {
    let amount = tiny();
    add_to_coefficient(&mut claim.v[dof], 0, &amount);

    for (row, column, k) in system.stiffness().entries() {
        if column == dof {
            add_to_coefficient(&mut claim.w[row], 0, &(k * &amount));
        }
    }
    for (row, column, m) in system.mass().unwrap().entries() {
        if column == dof {
            add_to_coefficient(&mut claim.w[row], 1, &(m * &amount));
        }
    }
}

/// v and w with the opposite sign.
fn turn_backwards(claim: &mut LiftedSolution) {
    for polynomial in claim.v.iter_mut().chain(&mut claim.w) {
        for coefficient in polynomial {
            coefficient.0 = -coefficient.0.clone();
        }
    }
}

impl Example {
    /// Changes the claim; it must break this line at this place.
    fn assert_breaks(&self, line: &str, index: usize, change: impl Fn(&mut LiftedSolution)) {
        let mut forged = self.claim.clone();
        change(&mut forged);

        match verdict(&self.problem, Claim::LiftedSolution(forged)) {
            Err(Reason::Line {
                line: broken,
                index: place,
                ..
            }) => {
                assert_eq!(broken, line);
                assert_eq!(place, index);
            }
            other => panic!("{line}: {other:?}"),
        }
    }

    /// Changes one component of v, and w with it; the claim must break this line at this place.
    fn assert_motion_breaks(&self, line: &str, index: usize, dof: usize) {
        let system = system_of(&self.problem);
        self.assert_breaks(line, index, |claim| shift_motion(system, claim, dof));
    }
}

/// The particle that rests in `example` has index 2 in the pencil.
#[test]
fn each_line_has_a_forgery() {
    let example = example();
    let support = &example.claim.support;
    assert_eq!(*support, [1], "the first particle slips, the second rests");
    let good = Claim::LiftedSolution(example.claim.clone());
    assert!(verdict(&example.problem, good).is_ok());

    let equation = "(lambda^2 M + K) v = w";
    example.assert_breaks(equation, 6, |claim| {
        add_to_coefficient(&mut claim.w[6], 0, &tiny());
    });
    example.assert_breaks(equation, 0, |claim| {
        add_to_coefficient(&mut claim.v[0], 0, &tiny());
    });

    example.assert_motion_breaks("w_f = 0", 0, 0);
    example.assert_motion_breaks("v_d = 0", 1, 3);
    example.assert_motion_breaks("v_d = 0", 1, 4);
    example.assert_motion_breaks("v_N = 0", 2, 6);

    let slips_in_support = "S v_T < 0 on the support";
    example.assert_breaks(slips_in_support, 2, |claim| claim.support = vec![1, 2]);
    let cone_where_biactive = "S w_T + mu w_N = 0 where biactive";
    example.assert_breaks(cone_where_biactive, 2, |claim| claim.biactive = vec![2]);
    let rests_off_support = "S v_T = 0 off the support";
    example.assert_breaks(rests_off_support, 0, |claim| claim.support.clear());
    example.assert_breaks(slips_in_support, 0, turn_backwards);
}

/// The cone's inside and its surface: a problem whose friction differs by 1e-30 breaks
/// complementarity.
#[test]
fn friction_off_by_1e_30_breaks_complementarity() {
    let example = example();
    let system = system_of(&example.problem);
    let claim = Claim::LiftedSolution(example.claim.clone());

    let friction = system.friction().unwrap() + parse("1e-30").unwrap();
    let stiffness = system.stiffness().clone();
    let mass = system.mass().cloned();
    let particles = system.particles().to_vec();
    let other = System::new(stiffness, mass, Some(friction), particles).unwrap();
    let other = Problem::new(Body::System(other), Unknown::Lambda2, Window::all()).unwrap();

    let Err(Reason::Line { line, index, .. }) = verdict(&other, claim.clone()) else {
        panic!("a line is broken")
    };
    assert_eq!(line, "(S w_T + mu w_N) (S v_T) = 0");
    assert_eq!(index, 0);

    // A pencil has no dofs to speak of.
    let pencil = reduce(&example.problem).unwrap().pencil;
    let flat = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
    assert_eq!(verdict(&flat, claim).unwrap_err(), Reason::NotASystem);
}
