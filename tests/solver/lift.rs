//! The way back to (9): from a solution of the pencil to motion v and force w of the system.
//!
//! The truth is the exact enumerator. Its solutions, lifted, must satisfy every line of (9), and
//! the same lines as a variational inequality in doubles. On the other side each line must notice a
//! vector that breaks it, and the inequality a reaction outside the friction cone.
#![cfg(feature = "testkit")]

use mceip_exact::{Algebraic, Poly, Rational, Sparse, to_f64, whole};
use mceip_model::reduction::{Lifted, Line, check_lines, lift, reduce};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use mceip_oracle::{Solution, enumerate};
use mceip_testkit::{mechanical, system_of};

/// A solution that the enumerator lists, and its motion and force.
struct LiftedAnswer {
    solution: Solution,
    lifted: Lifted,
}

/// All solutions of a system, lifted.
fn lifted_answers(problem: &Problem) -> Vec<LiftedAnswer> {
    let system = system_of(problem);
    let reduced = reduce(problem).unwrap();
    let answer = enumerate(&reduced.pencil, problem.window()).unwrap();

    let mut list = Vec::new();
    for solution in answer.solutions {
        let lifted = lift(system, problem.unknown(), &reduced.variables, &solution.x);
        list.push(LiftedAnswer { solution, lifted });
    }
    list
}

#[test]
fn every_solution_of_random_systems_lifts() {
    let mut count = 0;

    for instance in mechanical(60, 5).unwrap() {
        let problem = &instance.problem;
        let system = system_of(problem);

        for answer in lifted_answers(problem) {
            let mut value = answer.solution.value;
            let checked = check_lines(system, problem.unknown(), &answer.lifted, &mut value);
            assert_eq!(checked, Ok(()), "{}", instance.label);
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}

/// A system, and motion and force of its first solution.
struct Example {
    system: System,
    lifted: Lifted,
    value: Algebraic,
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), and a second slip particle
/// on (5, 6).
fn example() -> Example {
    let mut stiffness = Vec::new();
    for dof in 0..7 {
        stiffness.push((dof, dof, whole(4)));
    }
    for (i, j, value) in [(0, 1, 1), (1, 2, -9), (1, 5, -1)] {
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

    let first = lifted_answers(&problem).remove(0);
    Example {
        system,
        lifted: first.lifted,
        value: first.solution.value,
    }
}

impl Example {
    /// The line of (9) that breaks when motion or force are changed, if any.
    fn broken_line(&self, change: impl Fn(&mut Lifted)) -> Option<Line> {
        let mut changed = self.lifted.clone();
        change(&mut changed);

        let mut value = self.value.clone();
        let checked = check_lines(&self.system, Unknown::Lambda2, &changed, &mut value);
        checked.err().map(|error| error.line)
    }
}

#[test]
fn each_line_notices_its_breach() {
    let example = example();
    let one = Poly::from_ints(&[1]);
    assert_eq!(example.broken_line(|_| ()), None);

    let without_motion = example.broken_line(|l| l.v.fill(Poly::default()));
    assert_eq!(without_motion, Some(Line::NonTrivial));

    let free_dof_loaded = example.broken_line(|l| l.w[0] = one.clone());
    assert_eq!(free_dof_loaded, Some(Line::FreeReaction));

    let stick_particle_moving = example.broken_line(|l| l.v[3] = one.clone());
    assert_eq!(stick_particle_moving, Some(Line::StickRate));

    let slip_particle_lifting = example.broken_line(|l| l.v[2] = one.clone());
    assert_eq!(slip_particle_lifting, Some(Line::NormalRate));

    let backwards = example.broken_line(|l| {
        for component in &mut l.v {
            *component = -&*component;
        }
    });
    assert_eq!(backwards, Some(Line::SlipDirection));

    let outside_the_cone = example.broken_line(|l| l.w[1] = &l.w[1] + &one);
    assert_eq!(outside_the_cone, Some(Line::FrictionCone));

    let inside_the_cone = example.broken_line(|l| l.w[1] = &l.w[1] - &one);
    assert_eq!(inside_the_cone, Some(Line::Complementarity));
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
            Unknown::Lambda2 | Unknown::Eigenvalue => to_f64(system.friction().unwrap()),
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

    /// The sum of the magnitudes of all terms.
    fn scale(&self) -> f64 {
        let mut scale = 0.0;
        for term in self.cone.iter().chain(&self.slip) {
            scale += term.abs();
        }
        scale
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

/// (9) as a variational inequality: S v_T <= 0 and (S w_T + mu w_N)'(z - S v_T) >= 0 for all
/// z <= 0. (v_d = 0, v_Ns = 0 and w_f = 0 are lines of their own: `check_lines`.)
#[test]
fn lifted_solutions_solve_the_variational_inequality() {
    let mut count = 0;

    for instance in mechanical(60, 5).unwrap() {
        let label = &instance.label;
        let problem = &instance.problem;
        let system = system_of(problem);

        for answer in lifted_answers(problem) {
            let value = answer.solution.decimal(17).parse().unwrap();
            let mut at_slip = AtSlip::new(system, problem.unknown(), &answer.lifted, value);

            // Basis: sums of a few dozen doubles of this size.
            let scale = at_slip.scale();
            let rounding = 1e-11 * (1.0 + scale * scale);
            assert!(at_slip.slip.iter().all(|s| *s <= rounding), "{label}");
            assert!(at_slip.least_side() >= -rounding, "{label}");

            // A reaction outside the friction cone.
            at_slip.cone[0] = 1.0 + scale;
            assert!(at_slip.least_side() < -rounding, "{label}");
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}
