//! Curved obstacles (`spec/curvature.md`): the growth of true motions on circles, and the two
//! particles on a cylinder in closed form.
//!
//! Motions are integrated from Newton's law. A particle that slips on a circle of curvature kappa
//! has the tangent t = (1 - kappa u_N, kappa u_T) and the normal n = (-kappa u_T, 1 - kappa u_N) in
//! its directions at equilibrium, and
//!
//! ```text
//! M a + K u = r - r0,      n.a = kappa |u'|^2,      r = r_n (n - S c mu t)
//! ```
//!
//! Nothing of chapter 2 is used but the rate and the mode that are to be confirmed. Which particles
//! slip is that of the mode, and stays.
#![cfg(feature = "testkit")]

use mceip_exact::{Rational, rational, to_f64, whole};
use mceip_model::reduction::reduce;
use mceip_model::{
    Body, ContactState, Curvature, Particle, Pencil, Problem, RealWindow, System, Unknown, Window,
};
use mceip_oracle::{Solution, TwoParticles, enumerate};
use mceip_paper::{pythagorean_angles, two_particles};
use mceip_testkit::generators::{rng, states};
use nalgebra::{DMatrix, DVector};

/// Number of this family of random systems.
const FAMILY: u64 = 92;

/// How far from the equilibrium a motion begins, as a multiple of its mode.
const START: f64 = 1e-7;
/// Steps of an integration over the time 2 / lambda.
const STEPS: usize = 400;
/// What u and u' may be off e^2 times the start: the motion is on circles, and bends.
const TOLERANCE: f64 = 1e-4;

fn problem(system: &System) -> Problem {
    let body = Body::System(system.clone());
    Problem::new(body, Unknown::Lambda2, Window::all()).unwrap()
}

fn pencil(system: &System) -> Pencil {
    reduce(&problem(system)).unwrap().pencil
}

/// A growing motion: lambda, the mode over all degrees of freedom, and which particles slip in it.
struct Growing {
    lambda: f64,
    mode: DVector<f64>,
    slides: Vec<bool>,
}

impl Growing {
    fn of(system: &System, solution: &Solution) -> Growing {
        let reduced = reduce(&problem(system)).unwrap();
        let slip = reduced.pencil.slip();
        let mut mode = DVector::zeros(system.dofs());
        let x = solution.x_decimals(&slip, 17);
        for (variable, x_i) in reduced.variables.iter().zip(&x) {
            let x_i: f64 = x_i.parse().unwrap();
            for (dof, coefficient) in variable.column() {
                mode[dof] += to_f64(&coefficient) * x_i;
            }
        }

        let mut slides = Vec::new();
        let mut variables = slip.iter();
        for particle in system.particles() {
            let slips = matches!(particle.state, ContactState::Slip { .. });
            slides.push(slips && solution.slip.contains(variables.next().unwrap()));
        }

        let lambda2: f64 = solution.decimal(17).parse().unwrap();
        Growing {
            lambda: lambda2.sqrt(),
            mode,
            slides,
        }
    }
}

/// A body in motion along its obstacles.
struct Moving<'a> {
    system: &'a System,
    mass: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    /// Which particles slip.
    slides: &'a [bool],
}

impl Moving<'_> {
    fn of<'a>(system: &'a System, slides: &'a [bool]) -> Moving<'a> {
        let dense = |matrix: &mceip_exact::Sparse| {
            let mut dense = DMatrix::zeros(system.dofs(), system.dofs());
            for (i, j, entry) in matrix.entries() {
                dense[(i, j)] = to_f64(entry);
            }
            dense
        };
        Moving {
            system,
            mass: dense(system.mass().unwrap()),
            stiffness: dense(system.stiffness()),
            slides,
        }
    }

    /// a for given u and u': the equations of motion with a column for each unknown reaction and a
    /// row for each constraint.
    fn acceleration(&self, u: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        let dofs = self.system.dofs();
        let mut force = -(&self.stiffness * u);
        let mut constraints: Vec<(DVector<f64>, DVector<f64>, f64)> = Vec::new();

        for (particle, &slides) in self.system.particles().iter().zip(self.slides) {
            let tangent = self.direction(&particle.tangent());
            let normal = self.direction(&particle.into_obstacle());
            if slides {
                let circle = self.circle(particle);
                force -= (&normal - &tangent * circle.friction) * circle.normal_reaction;
                let along = 1.0 - circle.curvature * normal.dot(u);
                let across = circle.curvature * tangent.dot(u);
                let turned_tangent = &tangent * along + &normal * across;
                let turned_normal = &normal * along - &tangent * across;
                let reaction = &turned_normal - turned_tangent * circle.friction;
                let speed = velocity.dot(&tangent).hypot(velocity.dot(&normal));
                let bend = circle.curvature * speed * speed;
                constraints.push((turned_normal, reaction, bend));
            } else if particle.state != ContactState::Free {
                constraints.push((tangent.clone(), tangent, 0.0));
                constraints.push((normal.clone(), normal, 0.0));
            }
        }

        let order = dofs + constraints.len();
        let mut matrix = DMatrix::zeros(order, order);
        let mut right = DVector::zeros(order);
        matrix.view_mut((0, 0), (dofs, dofs)).copy_from(&self.mass);
        right.rows_mut(0, dofs).copy_from(&force);
        for (k, (direction, reaction, bend)) in constraints.iter().enumerate() {
            matrix
                .view_mut((0, dofs + k), (dofs, 1))
                .copy_from(&-reaction);
            matrix
                .view_mut((dofs + k, 0), (1, dofs))
                .copy_from(&direction.transpose());
            right[dofs + k] = *bend;
        }

        let solved = matrix.lu().solve(&right).unwrap();
        solved.rows(0, dofs).into_owned()
    }

    fn direction(&self, pairs: &[(usize, Rational)]) -> DVector<f64> {
        let mut direction = DVector::zeros(self.system.dofs());
        for (dof, coefficient) in pairs {
            direction[*dof] = to_f64(coefficient);
        }
        direction
    }

    fn circle(&self, particle: &Particle) -> Circle {
        let ContactState::Slip { sign } = particle.state else {
            panic!("a particle that slips")
        };
        let own_friction = self.system.friction().unwrap() * &particle.friction_factor;
        // On a flat obstacle the reaction does not turn, so that any will do.
        let flat = Curvature {
            value: whole(0),
            normal_reaction: whole(-1),
        };
        let curvature = particle.curvature.as_ref().unwrap_or(&flat);
        Circle {
            curvature: to_f64(&curvature.value),
            normal_reaction: to_f64(&curvature.normal_reaction),
            friction: f64::from(sign) * to_f64(&own_friction),
        }
    }

    /// u' times what it was at the start, along the mode, after the time 2 / lambda.
    fn growth(&self, growing: &Growing) -> f64 {
        let step = 2.0 / growing.lambda / STEPS as f64;
        let mut u = &growing.mode * START;
        let mut velocity = &u * growing.lambda;
        let start = velocity.dot(&growing.mode);
        for _ in 0..STEPS {
            (u, velocity) = self.after(step, &u, &velocity);
        }
        velocity.dot(&growing.mode) / start
    }

    /// The classical method of Runge and Kutta.
    fn after(
        &self,
        step: f64,
        u: &DVector<f64>,
        velocity: &DVector<f64>,
    ) -> (DVector<f64>, DVector<f64>) {
        let a1 = self.acceleration(u, velocity);
        let v2 = velocity + &a1 * (step / 2.0);
        let a2 = self.acceleration(&(u + velocity * (step / 2.0)), &v2);
        let v3 = velocity + &a2 * (step / 2.0);
        let a3 = self.acceleration(&(u + &v2 * (step / 2.0)), &v3);
        let v4 = velocity + &a3 * step;
        let a4 = self.acceleration(&(u + &v3 * step), &v4);

        let mean_velocity = (velocity + (v2 + v3) * 2.0 + v4) / 6.0;
        let mean_acceleration = (a1 + (a2 + a3) * 2.0 + a4) / 6.0;
        (
            u + mean_velocity * step,
            velocity + mean_acceleration * step,
        )
    }
}

/// The circle that a particle slips on.
struct Circle {
    curvature: f64,
    normal_reaction: f64,
    /// S c mu.
    friction: f64,
}

/// The system with all obstacles bent the other way.
fn bent_the_other_way(system: &System) -> System {
    let mut particles = system.particles().to_vec();
    for particle in &mut particles {
        if let Some(curvature) = &mut particle.curvature {
            curvature.value = -&curvature.value;
        }
    }

    system.with_particles(particles).unwrap()
}

/// Motions on true circles grow at the rates of (12) with the turning reactions, and not at those
/// of obstacles bent the other way.
#[test]
fn motions_on_circles_grow_at_the_rates_of_their_modes() {
    let mut grown = 0;
    let mut hollow = 0;
    let mut with_one_at_rest = 0;

    for number in 0..3 * states::MIXTURES {
        let mut rng = rng(FAMILY, number);
        let mixture = states::mixture(number);
        let flat = states::system(&mut rng, &mixture, &mut Vec::new()).unwrap();
        let system = states::on_curved_obstacles(&mut rng, &flat, &mut Vec::new()).unwrap();
        let found = enumerate(&pencil(&system), &Window::all()).unwrap();
        let lambda2 = |solution: &Solution| solution.decimal(17).parse::<f64>().unwrap();
        let solutions = found.solutions.iter();
        let Some(largest) = solutions.max_by(|p, q| lambda2(p).total_cmp(&lambda2(q))) else {
            continue;
        };

        let growing = Growing::of(&system, largest);
        let turns = |(p, slides): (&Particle, &bool)| *slides && p.curvature.is_some();
        let mut particles = system.particles().iter().zip(&growing.slides);
        if growing.lambda < 0.1 || !particles.any(turns) {
            continue;
        }

        let growth = Moving::of(&system, &growing.slides).growth(&growing);
        let expected = 2.0f64.exp();
        assert!(
            (growth / expected - 1.0).abs() < TOLERANCE,
            "system {number}: {growth} in place of {expected}"
        );
        let other = bent_the_other_way(&system);
        let wrong = Moving::of(&other, &growing.slides).growth(&growing);
        assert!(
            (wrong / expected - 1.0).abs() > 100.0 * TOLERANCE,
            "system {number}: {wrong}"
        );

        grown += 1;
        let is_hollow = |p: &Particle| p.curvature.as_ref().is_some_and(|c| c.value < whole(0));
        hollow += usize::from(system.particles().iter().any(is_hollow));
        let slipping = growing.slides.iter().filter(|slides| **slides).count();
        with_one_at_rest += usize::from(slipping < system.slip_particles().len());
    }

    assert!(grown >= 60, "{grown} motions");
    assert!(hollow >= 10, "{hollow} with a hollow obstacle");
    assert!(
        with_one_at_rest >= 10,
        "{with_one_at_rest} with one at rest"
    );
}

/// The two particles, both pressed with `pressure` on a cylinder of this curvature.
fn on_a_cylinder(data: &TwoParticles, curvature: &Rational, pressure: &Rational) -> System {
    let flat = two_particles(data).unwrap();
    let mut particles = flat.particles().to_vec();
    for particle in &mut particles {
        particle.curvature = Some(Curvature {
            value: curvature.clone(),
            normal_reaction: -pressure,
        });
    }

    flat.with_particles(particles).unwrap()
}

/// The solutions on a cylinder are those of the flat obstacle, each lambda^2 larger by
/// kappa N (1 + mu^2) / m: also where it is negative on the flat one.
#[test]
fn on_a_cylinder_all_rates_of_two_particles_are_shifted() {
    let mut listed = 0;
    let mut below_zero_when_flat = 0;

    for (c, s) in pythagorean_angles() {
        for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            for (curvature, mu) in [(2, rational(1, 2)), (-1, whole(3)), (1, whole(4))] {
                let data = TwoParticles {
                    c: c.clone(),
                    s: s.clone(),
                    k: whole(3),
                    m: rational(5, 2),
                    mu: mu.clone(),
                    signs,
                };
                let pressure = rational(7, 2);
                let curvature = whole(curvature);
                let shift = &curvature * &pressure * (whole(1) + &mu * &mu) / &data.m;
                let curved = pencil(&on_a_cylinder(&data, &curvature, &pressure));
                let flat = pencil(&two_particles(&data).unwrap());

                let on_cylinder = enumerate(&curved, &Window::all()).unwrap().solutions;
                let from = RealWindow::new(Some(-&shift), None).unwrap();
                let on_flat = enumerate(&flat, &from).unwrap().solutions;

                assert_eq!(on_cylinder.len(), on_flat.len(), "{data:?}");
                for (there, here) in on_cylinder.iter().zip(&on_flat) {
                    let value = |solution: &Solution| solution.decimal(17).parse::<f64>().unwrap();
                    let difference = value(there) - value(here) - to_f64(&shift);
                    assert!(difference.abs() < 1e-12, "{difference}");
                    assert_eq!(there.slip, here.slip);
                    listed += 1;
                    below_zero_when_flat += usize::from(value(here) < 0.0);
                }
            }
        }
    }

    assert!(listed >= 60, "{listed} solutions");
    assert!(
        below_zero_when_flat >= 20,
        "{below_zero_when_flat} with a negative lambda^2 when flat"
    );
}
