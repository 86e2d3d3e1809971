//! The way back to (9): lifted solutions satisfy every line, and each line notices its own breach.
#![cfg(feature = "testkit")]

use mceip_engine::reduction::{Lifted, Line, check_lines, lift, reduce};
use mceip_exact::{Algebraic, Poly, Rational, Sparse, to_f64, whole};
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

/// The terms of (9) at the slip particles, in doubles.
struct AtSlip {
    /// S v_T of each slip particle.
    slip: Vec<f64>,
    /// S w_T + mu w_N of each.
    cone: Vec<f64>,
}

impl AtSlip {
    fn new(system: &System, unknown: Unknown, lifted: &Lifted, value: f64) -> AtSlip {
        let mu = match unknown {
            Unknown::Mu => value,
            Unknown::Lambda2 => to_f64(system.friction().unwrap()),
        };
        let mut at_slip = AtSlip {
            slip: Vec::new(),
            cone: Vec::new(),
        };

        for particle in system.particles() {
            let ContactState::Slip { sign } = particle.state else {
                continue;
            };
            let s = f64::from(sign);
            let v_t = along(&particle.tangent(), &lifted.v, value);
            let w_t = along(&particle.tangent(), &lifted.w, value);
            let w_n = along(&particle.into_obstacle(), &lifted.w, value);
            at_slip.slip.push(s * v_t);
            at_slip.cone.push(s * w_t + mu * w_n);
        }
        at_slip
    }

    /// (S w_T + mu w_N)'(z - S v_T), which is at least 0 for every z <= 0 if (9) holds.
    fn side(&self, z: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (p, z_p) in z.iter().enumerate() {
            sum += self.cone[p] * (z_p - self.slip[p]);
        }
        sum
    }

    /// The least side over z = 0, z = 2 S v_T and one step down from S v_T in each component. Where
    /// it is at least 0, so is the side for every z <= 0.
    fn least_side(&self) -> f64 {
        let origin = vec![0.0; self.slip.len()];
        let twice: Vec<f64> = self.slip.iter().map(|s| 2.0 * s).collect();
        let mut least = self.side(&origin).min(self.side(&twice));

        for p in 0..self.slip.len() {
            let mut down = self.slip.clone();
            down[p] -= 1.0;
            least = least.min(self.side(&down));
        }
        least
    }
}

/// A direction times a vector of polynomials, at a value.
fn along(direction: &[(usize, Rational)], vector: &[Poly], value: f64) -> f64 {
    let mut sum = 0.0;
    for (dof, coefficient) in direction {
        let mut at_value = 0.0;
        for c in vector[*dof].coeffs().iter().rev() {
            at_value = at_value * value + to_f64(&Rational::from_integer(c.clone()));
        }
        sum += to_f64(coefficient) * at_value;
    }
    sum
}

/// (9) as a variational inequality: S v_T <= 0 and (S w_T + mu w_N)'(z - S v_T) >= 0 for all z <= 0.
/// (v_d = 0, v_Ns = 0 and w_f = 0 are lines of their own: `check_lines`.)
#[test]
fn lifted_solutions_solve_the_variational_inequality() {
    let mut count = 0;
    for instance in mechanical(60, 5).unwrap() {
        let Body::System(system) = instance.problem.body() else {
            panic!("a system")
        };
        let unknown = instance.problem.unknown();
        let reduced = reduce(&instance.problem).unwrap();
        let answer = enumerate(&reduced.pencil, instance.problem.window()).unwrap();

        for s in answer.solutions {
            let lifted = lift(system, unknown, &reduced.variables, &s.x);
            let value = s.decimal(17).parse().unwrap();
            let mut at_slip = AtSlip::new(system, unknown, &lifted, value);
            let scale: f64 = at_slip
                .cone
                .iter()
                .chain(&at_slip.slip)
                .map(|v| v.abs())
                .sum();

            // Basis: sums of a few dozen doubles of this size.
            let rounding = 1e-11 * (1.0 + scale * scale);
            assert!(
                at_slip.slip.iter().all(|s| *s <= rounding),
                "{}",
                instance.label
            );
            assert!(at_slip.least_side() >= -rounding, "{}", instance.label);

            // A reaction outside the friction cone.
            at_slip.cone[0] = 1.0 + scale;
            assert!(at_slip.least_side() < -rounding, "{}", instance.label);
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}
