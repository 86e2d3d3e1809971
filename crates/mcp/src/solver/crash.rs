//! The crash: steps before the first path that find a good active set.
//!
//! This file: projected Newton on the guessed active set (Dirkse and Ferris 1997, "Crash techniques
//! for large-scale complementarity problems"). A component is *active* where it is at a bound and F
//! points out of it; Newton's direction is computed in the inactive ones, F'_II d_I = -F_I, and
//! followed along the projected arc until the merit falls. `semismooth` is Newton on the
//! Fischer-Burmeister system, `step` what both share.
//!
//! Called by `newton` at the beginning of attempt 0.

mod semismooth;
mod step;

use super::dense::Lu;
use super::evaluation::{Evaluated, Point};
use super::jacobian::JacobianMatrix;
use super::log::Log;
use super::outcome::{StepKind, Termination};
use super::tolerance::{CRASH_GAIN, CRASH_PROXIMAL, CRASH_PROXIMAL_LEAST, CRASH_SMALLEST};
use crate::mcp::Mcp;
use std::mem::replace;

pub(super) use semismooth::{Ending, semismooth};
use step::{InsideSystem, search};

/// What a crash works with, kept from one to the next.
#[derive(Default)]
pub(super) struct CrashStorage {
    pub(super) semismooth: semismooth::SemismoothStorage,
    /// Is the component active?
    active: Vec<bool>,
    /// The components that are not active.
    inactive: Vec<usize>,
    lu: Lu<f64>,
    /// Newton's step in the inactive components.
    step: Vec<f64>,
    /// The same in all components, 0 in the active ones.
    direction: Vec<f64>,
}

/// Crash steps from `start`, at most `limit`, until the active set changes by at most one index or
/// the merit hardly falls. Never raises the merit.
///
/// # Errors
/// [`Termination::NonFinite`] if F' is not finite at an accepted point.
pub(super) fn crash<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    start: Point,
    limit: usize,
    storage: &mut CrashStorage,
    log: &mut Log,
) -> Result<Point, Termination> {
    let mut point = start;
    storage.active.clear();
    storage.active.resize(point.z.len(), false);
    storage.update_active(problem.problem, &point);

    for _ in 0..limit {
        let jacobian = problem.jacobian(&point)?;
        problem.counters.factorisations += 1;
        let (solved, proximal) = storage.newton_direction(&jacobian, &point);
        problem.recycle_matrix(jacobian);

        if !solved {
            break;
        }

        let found = search(problem, &point, &storage.direction, CRASH_SMALLEST);
        let Some((next, _)) = found else {
            break;
        };
        problem.counters.crash_steps += 1;
        log.step(point.merit, StepKind::Crash, proximal);

        let gained = next.merit <= (1.0 - CRASH_GAIN) * point.merit;
        problem.recycle(replace(&mut point, next));
        let changes = storage.update_active(problem.problem, &point);

        if changes <= 1 || !gained {
            break;
        }
    }
    Ok(point)
}

/// At a bound, with F pointing strictly out of it.
fn is_active<P: Mcp + ?Sized>(problem: &P, point: &Point, i: usize) -> bool {
    let lower = problem.lower()[i];
    let upper = problem.upper()[i];
    let z = point.z[i];
    let f = point.f[i];

    lower == upper || (z <= lower && f > 0.0) || (z >= upper && f < 0.0)
}

impl CrashStorage {
    /// Sets the active components to those at the point; returns how many have changed.
    fn update_active<P: Mcp + ?Sized>(&mut self, problem: &P, point: &Point) -> usize {
        let mut changes = 0;
        for (i, active) in self.active.iter_mut().enumerate() {
            let before = replace(active, is_active(problem, point, i));
            changes += usize::from(before != *active);
        }
        changes
    }

    /// Newton's direction in the inactive components; a singular factor is perturbed proximally,
    /// with a term that vanishes with the merit. Says if there is one, and the term used.
    fn newton_direction(&mut self, jacobian: &JacobianMatrix, point: &Point) -> (bool, f64) {
        self.inactive.clear();
        for (i, active) in self.active.iter().enumerate() {
            if !active {
                self.inactive.push(i);
            }
        }

        let mut proximal = 0.0;
        let mut solved = self.solve(jacobian, point, proximal);
        if !solved {
            proximal = proximal_term(jacobian, point.merit);
            solved = self.solve(jacobian, point, proximal);
        }

        self.direction.clear();
        self.direction.resize(self.active.len(), 0.0);

        for (&i, value) in self.inactive.iter().zip(&self.step) {
            self.direction[i] = *value;
        }

        (solved, proximal)
    }

    /// Solves (F'_II + proximal I) d = -F_I into the step; says if there is a solution.
    fn solve(&mut self, jacobian: &JacobianMatrix, point: &Point, proximal: f64) -> bool {
        let inactive = &self.inactive;
        let system = InsideSystem {
            jacobian,
            inside: inactive,
            diagonal: |_| proximal,
            residual: |row: usize| point.f[inactive[row]],
        };

        system.solve(&mut self.lu, &mut self.step)
    }
}

/// The proximal term for a singular F': CRASH_PROXIMAL sqrt(Psi) within its limits, times the
/// largest entry of F', or absolute where F' is zero.
fn proximal_term(jacobian: &JacobianMatrix, merit: f64) -> f64 {
    let largest = jacobian.largest();
    let size = if largest > 0.0 { largest } else { 1.0 };

    let relative = CRASH_PROXIMAL * merit.sqrt();
    relative.clamp(CRASH_PROXIMAL_LEAST, CRASH_PROXIMAL) * size
}

#[cfg(test)]
mod tests {
    use super::super::probe::{bounded, free};
    use super::super::tolerance::ARMIJO;
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::{DMatrix, DVector, dmatrix};

    fn crashed(m: DMatrix<f64>, q: Vec<f64>, start: &[f64]) -> (Point, usize) {
        let lcp = LinearMcp::lcp(m, q).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let start = problem.point(&DVector::from_column_slice(start));
        let mut log = Log::default();
        let point = crash(
            &mut problem,
            start,
            50,
            &mut CrashStorage::default(),
            &mut log,
        )
        .unwrap();
        let steps = log.records().len();

        assert_eq!(steps, problem.counters.crash_steps);
        assert!(problem.counters.factorisations >= steps);

        (point, steps)
    }

    #[test]
    fn one_step_solves_an_inactive_linear_problem() {
        let (point, steps) = crashed(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0], &[1.0, 1.0]);
        assert!(point.merit < 1e-28);
        assert_eq!(steps, 1);
    }

    #[test]
    fn a_singular_factor_is_perturbed_and_the_merit_never_rises() {
        let (point, _) = crashed(dmatrix![0.0, 0.0; 0.0, 1.0], vec![0.0, -1.0], &[1.0, 3.0]);
        assert!(point.merit < 1e-3);
        assert!((point.z[1] - 1.0).abs() < 0.1);

        let (point, _) = crashed(dmatrix![-1.0], vec![-1.0], &[0.0]);
        assert!(point.merit <= 2.0);
    }

    /// Where F' vanishes the proximal term is absolute.
    #[test]
    fn a_zero_jacobian_is_perturbed_too() {
        let mut storage = CrashStorage {
            active: vec![false],
            ..CrashStorage::default()
        };
        let point = Point {
            z: DVector::from_element(1, 3.0),
            f: DVector::from_element(1, 2.0),
            merit: 1e6,
        };

        assert_eq!(
            storage.newton_direction(&dmatrix![0.0].into(), &point),
            (true, CRASH_PROXIMAL)
        );
        assert_eq!(storage.direction, [-2.0 / CRASH_PROXIMAL]);
    }

    /// At a solution nothing falls.
    #[test]
    fn a_step_that_gains_nothing_is_none() {
        let lcp = LinearMcp::lcp(dmatrix![1.0], vec![-1.0]).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let solution = problem.point(&DVector::from_element(1, 1.0));

        assert_eq!(solution.merit, 0.0);
        assert!(search(&mut problem, &solution, &[0.0], CRASH_SMALLEST).is_none());
    }

    /// A point with one component.
    fn on_a_line(z: f64, f: f64) -> Point {
        Point {
            z: DVector::from_element(1, z),
            f: DVector::from_element(1, f),
            merit: 0.0,
        }
    }

    /// At a bound with F strictly out of it; at equal bounds always.
    #[test]
    fn active_is_what_is_held_at_its_bound() {
        let p = LinearMcp::new(DMatrix::identity(1, 1), vec![0.0], vec![0.0], vec![4.0]).unwrap();
        let active = |z: f64, f: f64| is_active(&p, &on_a_line(z, f), 0);

        assert!(active(0.0, 1.0));
        assert!(!active(0.0, 0.0));
        assert!(!active(0.0, -1.0));
        assert!(!active(1.0, 1.0));
        assert!(!active(1.0, -1.0));
        assert!(active(4.0, -1.0));
        assert!(!active(4.0, 0.0));
        assert!(!active(4.0, 1.0));

        let fixed =
            LinearMcp::new(DMatrix::identity(1, 1), vec![0.0], vec![4.0], vec![4.0]).unwrap();
        assert!(is_active(&fixed, &on_a_line(4.0, 0.0), 0));
    }

    /// The proximal term: CRASH_PROXIMAL sqrt(merit) between its limits, times the largest entry.
    #[test]
    fn the_proximal_term_vanishes_with_the_merit() {
        let singular = dmatrix![0.0, 0.0; 0.0, 8.0].into();
        let direction_at = |merit: f64| {
            let mut storage = CrashStorage {
                active: vec![false; 2],
                ..CrashStorage::default()
            };
            let point = Point {
                z: DVector::zeros(2),
                f: DVector::from_element(2, 1.0),
                merit,
            };
            let (solved, proximal) = storage.newton_direction(&singular, &point);
            (solved.then_some(storage.direction), proximal)
        };

        for (merit, term) in [
            (1e9, CRASH_PROXIMAL),
            (0.25, 0.5 * CRASH_PROXIMAL),
            (0.0, CRASH_PROXIMAL_LEAST),
        ] {
            let (direction, proximal) = direction_at(merit);
            assert_eq!(proximal, term * 8.0);
            approx::assert_relative_eq!(
                direction.unwrap()[0],
                -1.0 / (term * 8.0),
                max_relative = 1e-9
            );
        }
    }

    /// Psi = 1/2 everywhere but where a trial lands: taken from a fall of ARMIJO times its length
    /// on.
    #[test]
    fn a_crash_step_is_taken_from_armijo_s_fall_on() {
        let taken = |trial: f64, share: f64| {
            let value = (1.0 - share * ARMIJO * trial).sqrt();
            let p = free(
                1,
                move |z, f| f[0] = if z[0] == 2.0 + trial { value } else { 1.0 },
                |_, j| j[(0, 0)] = 0.0,
            );
            let mut problem = Evaluated::new(&p);
            let point = problem.point(&DVector::from_element(1, 2.0));
            search(&mut problem, &point, &[1.0], CRASH_SMALLEST)
                .map(|(next, step)| (next.z[0] - 2.0, step))
        };

        for trial in [1.0, 0.5, 0.125, CRASH_SMALLEST] {
            assert_eq!(taken(trial, 1.01), Some((trial, trial)), "{trial}");
            assert_eq!(taken(trial, 0.99), None, "{trial}");
        }

        assert_eq!(taken(0.5 * CRASH_SMALLEST, 1.01), None); // the path is better
    }

    /// Two unknowns leave for their bounds in the first step, so that only the gain says if there
    /// is a second one. With F_3 = z^-p Newton's step is to z (1 + 1/p), which divides the merit by
    /// (1 + 1/p)^2p.
    #[test]
    fn a_crash_goes_on_while_it_gains() {
        /// Does the first step gain enough, and how many steps are there in all?
        fn steps(p: f64) -> (bool, usize) {
            let function = move |z: &[f64], f: &mut [f64]| {
                f[0] = z[0] + 1.0;
                f[1] = z[1] + 1.0;
                f[2] = 1e3 * z[2].powf(-p);
            };
            let jacobian = move |z: &[f64], j: &mut DMatrix<f64>| {
                j[(0, 0)] = 1.0;
                j[(1, 1)] = 1.0;
                j[(2, 2)] = -1e3 * p * z[2].powf(-p - 1.0);
            };
            let lower = [0.0, 0.0, f64::NEG_INFINITY];
            let problem = bounded(&lower, &[f64::INFINITY; 3], function, jacobian);
            let mut problem = Evaluated::new(&problem);
            let start = problem.point(&DVector::from_vec(vec![1e-3, 1e-3, 1.0]));
            let mut storage = CrashStorage::default();
            let mut log = Log::default();

            let once = crash(&mut problem, start.clone(), 1, &mut storage, &mut log).unwrap();
            let gain = 1.0 - once.merit / start.merit;

            problem.counters.crash_steps = 0;
            crash(&mut problem, start, 9, &mut storage, &mut log).unwrap();
            (gain > CRASH_GAIN, problem.counters.crash_steps)
        }

        // Gains of 0.9 and 1.1 %.
        assert_eq!(steps(6e-4), (false, 1));
        assert_eq!(steps(7.5e-4), (true, 2));
    }
}
