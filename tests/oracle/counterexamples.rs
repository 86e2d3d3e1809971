//! The counterexamples of the book, in exact numbers: bodies with one slip particle and at most one
//! free degree of freedom.
//!
//! The truth is the page named at each test, where the example is worked by hand. The enumerator
//! must find what the page lists, and nothing where the page says that there is nothing.

use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};
use mceip_oracle::{Enumeration, PhysicalSystem, enumerate, enumerate_motions};

/// A body whose last two degrees of freedom are those of a slip particle with S = +1.
fn body(stiffness: Sparse, mass: Sparse, friction: Rational) -> System {
    let normal = stiffness.rows() - 1;
    let slip = ContactState::Slip { sign: 1 };
    let particle = Particle::plain(normal - 1, normal, slip);
    System::new(stiffness, Some(mass), Some(friction), vec![particle]).unwrap()
}

fn reduced(system: &System, unknown: Unknown) -> Pencil {
    let body = Body::System(system.clone());
    let problem = Problem::new(body, unknown, Window::all()).unwrap();
    reduce(&problem).unwrap().pencil
}

fn solutions(system: &System, unknown: Unknown) -> Enumeration {
    let found = enumerate(&reduced(system, unknown), &Window::all()).unwrap();
    assert!(found.is_plain_list(), "{found:?}");
    found
}

/// The values of all solutions, to six digits.
fn values(system: &System, unknown: Unknown) -> Vec<String> {
    let found = solutions(system, unknown);
    found.solutions.iter().map(|s| s.decimal(6)).collect()
}

/// One slip particle at a time: velocity along the obstacle, gap, reaction.
struct Contact {
    velocity: Rational,
    into_obstacle: Rational,
    tangential: Rational,
    normal: Rational,
}

impl Contact {
    /// (1) and (2).
    fn obeys_the_laws(&self, mu: &Rational) -> bool {
        let zero = whole(0);
        let touches = &self.into_obstacle * &self.normal == zero;
        let pushes = self.into_obstacle <= zero && self.normal <= zero;

        let inside = abs(&self.tangential) + mu * &self.normal <= zero;
        let along = abs(&self.velocity) * &self.tangential;
        let against = mu * &self.velocity * &self.normal;

        touches && pushes && inside && along == against
    }
}

fn abs(value: &Rational) -> Rational {
    if *value < whole(0) {
        -value
    } else {
        value.clone()
    }
}

/// The particle of X14 displaced by a v, at rest, with r = r0 + a K v.
fn displaced(stiffness: &Sparse, a: &Rational, v: &[Rational; 2]) -> Contact {
    let w = stiffness.times(v);
    Contact {
        velocity: whole(0),
        into_obstacle: a * &v[1],
        tangential: rational(1, 2) + a * &w[0],
        normal: whole(-1) + a * &w[1],
    }
}

/// X14: with a constant alpha the motion (8) obeys (1)-(3) and (9) has no solution.
#[test]
fn a_constant_alpha_is_a_motion_although_9_has_no_solution() {
    let mu = rational(1, 2);
    let twice = Sparse::from_ints(&[&[4, 1], &[1, 4]]);
    let stiffness = Sparse::zeros(2, 2).add_scaled(&rational(1, 2), &twice);
    let system = body(stiffness.clone(), Sparse::identity(2), mu.clone());

    // Without acceleration (3) is K (a v) = a w, which is how `displaced` makes w.
    let slips = [whole(-1), whole(0)];
    for a in [rational(1, 4), rational(1, 100), rational(1, 1_000_000)] {
        let moved = displaced(&stiffness, &a, &slips);
        let in_the_cone = abs(&moved.tangential) + &mu * &moved.normal;

        assert!(moved.obeys_the_laws(&mu), "{a}");
        assert_eq!(in_the_cone, rational(-9, 4) * &a);
    }

    // The laws refuse what they should: the other way out of the cone, and a velocity inside it.
    let small = rational(1, 100);
    let other_way = displaced(&stiffness, &small, &[whole(1), whole(0)]);
    assert!(!other_way.obeys_the_laws(&mu));

    let mut sliding = displaced(&stiffness, &small, &slips);
    sliding.velocity = whole(-1);
    assert!(!sliding.obeys_the_laws(&mu));

    assert!(solutions(&system, Unknown::Lambda2).solutions.is_empty());
    let physical = PhysicalSystem::of(&system, Unknown::Lambda2).unwrap();
    let direct = enumerate_motions(&physical, &Window::all()).unwrap();
    assert!(direct.motions.is_empty() && direct.degenerate.is_empty());
}

/// Chapter 2.3: the condensed matrix is T = 1 at every friction, so that lambda = 0 is no solution;
/// from mu = 5 on there are solutions with lambda^2 > 0, the roots of t^2 + (3 - mu) t + 1.
#[test]
fn a_definite_condensed_matrix_excludes_lambda_zero_alone() {
    let stiffness = Sparse::from_ints(&[&[1, -1, 1], &[-1, 2, -1], &[1, -1, 2]]);
    let at = |mu: Rational| body(stiffness.clone(), Sparse::identity(3), mu);

    let family = reduced(&at(whole(1)), Unknown::Mu);
    for mu in [whole(0), whole(5), whole(1000)] {
        let matrix = family.a().add_scaled(&mu, family.b());
        let eliminated = matrix.get(1, 0) * matrix.get(0, 1) / matrix.get(0, 0);
        assert_eq!(matrix.get(1, 1) - eliminated, whole(1));
    }

    assert!(values(&at(whole(1)), Unknown::Mu).is_empty());
    assert!(values(&at(rational(499, 100)), Unknown::Lambda2).is_empty());
    assert_eq!(values(&at(whole(5)), Unknown::Lambda2), ["1"]);
    let expected = ["0.381966", "2.61803"];
    assert_eq!(values(&at(whole(6)), Unknown::Lambda2), expected);
}

/// The page on folds: with M* = 1 - mu and K* = 1 the solutions are lambda^2 = 1 / (mu - 1). They
/// leave every bound as mu falls to 1, where M* = 0; at 1 and below there is none.
#[test]
fn the_infimum_of_mu_may_lie_at_infinite_growth() {
    let mass = Sparse::from_ints(&[&[1, -1], &[-1, 2]]);
    let at = |mu: Rational| body(Sparse::identity(2), mass.clone(), mu);

    assert!(values(&at(rational(1, 2)), Unknown::Lambda2).is_empty());
    assert!(values(&at(whole(1)), Unknown::Lambda2).is_empty());
    for growth in [1, 100, 1_000_000] {
        let mu = whole(1) + rational(1, growth);
        assert_eq!(values(&at(mu), Unknown::Lambda2), [growth.to_string()]);
    }

    // No static threshold. With the mass in the place of the stiffness mu = 1 is one.
    assert!(values(&at(whole(1)), Unknown::Mu).is_empty());
    let mass_problem = body(mass.clone(), mass.clone(), whole(1));
    assert_eq!(values(&mass_problem, Unknown::Mu), ["1"]);
}
