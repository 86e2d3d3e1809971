//! Damped Newton steps on the Fischer-Burmeister system Phi(z) = 0 before the first path (De Luca,
//! Facchinei and Kanzow 1996, "A semismooth equation approach to the solution of nonlinear
//! complementarity problems"), kept within the bounds (book, 3.4). A run of them that converges
//! costs one factorisation a step and no pivot.
//!
//! Row i of an element of the generalised Jacobian is by_z e_i' + by_f F'_i; divided by by_f it is
//! a row of F' with a term on the diagonal that grows towards the bound. Where a component is far
//! nearer to one branch than to the other the row of the minimum map stands for it: at a bound z_i
//! goes there exactly (and leaves the system), inside F_i + F'_i d = 0.
//!
//! Called by `newton` before projected Newton, which goes on where these steps do not converge.

use super::super::dense::Lu;
use super::super::evaluation::{Evaluated, Point};
use super::super::fischer::fischer;
use super::super::jacobian::JacobianMatrix;
use super::super::log::Log;
use super::super::outcome::{StepKind, Termination};
use super::super::tolerance::{
    SEMISMOOTH_GAIN, SEMISMOOTH_NEAR, SEMISMOOTH_SMALLEST, SEMISMOOTH_WINDOW,
};
use super::step::{InsideSystem, search};
use crate::mcp::Mcp;
use std::mem::replace;

/// What the steps work with, kept from one crash to the next.
#[derive(Default)]
pub(in super::super) struct SemismoothStorage {
    /// Rows of the system: the components that do not go to a bound.
    inside: Vec<usize>,
    /// The term on the diagonal of each row.
    diagonal: Vec<f64>,
    /// The residual of each row.
    residual: Vec<f64>,
    lu: Lu<f64>,
    /// Newton's step in the components inside.
    step: Vec<f64>,
    /// The direction in all components.
    direction: Vec<f64>,
}

/// The row that stands for a component.
#[derive(Debug, Clone, Copy, PartialEq)]
enum ComponentRow {
    /// The component goes this far, to its bound.
    Bound(f64),
    /// The row of F' with this on its diagonal, and this residual.
    Inside { diagonal: f64, residual: f64 },
}

/// When the steps end at the latest.
pub(in super::super) struct Ending<D> {
    /// After so many steps.
    pub(in super::super) limit: usize,
    /// At a point of which this is true.
    pub(in super::super) done: D,
}

/// Steps from `start` to the `ending`, or until there is no descent along two directions in a row,
/// or the merit has not fallen to [`SEMISMOOTH_GAIN`] over [`SEMISMOOTH_WINDOW`] steps. Says if it
/// is done. Never raises the merit.
///
/// # Errors
/// [`Termination::NonFinite`] if F' is not finite at an accepted point.
pub(in super::super) fn semismooth<P: Mcp + ?Sized, D: Fn(&Point) -> bool>(
    problem: &mut Evaluated<'_, P>,
    start: Point,
    ending: Ending<D>,
    storage: &mut SemismoothStorage,
    log: &mut Log,
) -> Result<(Point, bool), Termination> {
    let Ending { limit, done } = ending;
    let mut point = start;
    let mut least = point.merit;
    let mut last_failed = false;

    // Two elements by turns: the other one after a step that had to be shortened.
    let mut near = SEMISMOOTH_NEAR;

    for k in 0..limit {
        if done(&point) {
            return Ok((point, true));
        }

        if stalls(k, point.merit, &mut least) {
            return Ok((point, false));
        }

        let jacobian = problem.jacobian(&point)?;
        problem.counters.factorisations += 1;
        let solved = storage.newton_direction(problem.problem, &jacobian, &point, near[0]);
        problem.recycle_matrix(jacobian);

        let found = if solved {
            search(problem, &point, &storage.direction, SEMISMOOTH_SMALLEST)
        } else {
            None
        };

        take_turns(&mut near, found.as_ref().map(|(_, length)| *length));

        match found {
            Some((next, _)) => {
                last_failed = false;
                problem.counters.crash_steps += 1;
                log.step(point.merit, StepKind::FischerNewton, 0.0);
                problem.recycle(replace(&mut point, next));
            }
            None if last_failed => break,
            None => last_failed = true,
        }
    }

    let is_done = done(&point);
    Ok((point, is_done))
}

/// At the end of each window of steps: is the merit still above [`SEMISMOOTH_GAIN`] times that of
/// the last one's end?
fn stalls(step: usize, merit: f64, least: &mut f64) -> bool {
    if step == 0 || !step.is_multiple_of(SEMISMOOTH_WINDOW) {
        return false;
    }

    merit > SEMISMOOTH_GAIN * replace(least, merit)
}

/// The other element comes first after a step that was not of full length, or none.
fn take_turns(near: &mut [f64; 2], length: Option<f64>) {
    if length != Some(1.0) {
        near.swap(0, 1);
    }
}

/// The row for a component at z with F_i = f in [l, u]; the branches are told apart where one is
/// `near` times as far away as the other.
fn row(z: f64, f: f64, l: f64, u: f64, near: f64) -> ComponentRow {
    if l == u {
        return ComponentRow::Bound(0.0);
    }

    let below = z - l;
    let above = u - z;
    if f > 0.0 && below <= near * f {
        return ComponentRow::Bound(-below);
    }

    if f < 0.0 && above <= -near * f {
        return ComponentRow::Bound(above);
    }

    if f.abs() <= near * below.min(above) {
        return ComponentRow::Inside {
            diagonal: 0.0,
            residual: f,
        };
    }

    let phi = fischer(z, f, l, u);
    ComponentRow::Inside {
        diagonal: phi.by_z / phi.by_f,
        residual: phi.value / phi.by_f,
    }
}

impl SemismoothStorage {
    /// Newton's direction; says if there is one.
    fn newton_direction<P: Mcp + ?Sized>(
        &mut self,
        problem: &P,
        jacobian: &JacobianMatrix,
        point: &Point,
        near: f64,
    ) -> bool {
        self.take_rows(problem, point, near);
        self.move_bounded(jacobian);

        let diagonal = &self.diagonal;
        let residual = &self.residual;
        let system = InsideSystem {
            jacobian,
            inside: &self.inside,
            diagonal: |j: usize| diagonal[j],
            residual: |row: usize| residual[row],
        };

        if !system.solve(&mut self.lu, &mut self.step) {
            return false;
        }

        for (&i, value) in self.inside.iter().zip(&self.step) {
            self.direction[i] = *value;
        }
        true
    }

    /// The rows of the system, and the direction of the components that have none.
    fn take_rows<P: Mcp + ?Sized>(&mut self, problem: &P, point: &Point, near: f64) {
        self.inside.clear();
        self.diagonal.clear();
        self.residual.clear();
        self.direction.clear();

        let bounds = problem.lower().iter().zip(problem.upper());
        for (i, (&l, &u)) in bounds.enumerate() {
            let to_bound = match row(point.z[i], point.f[i], l, u, near) {
                ComponentRow::Bound(distance) => distance,
                ComponentRow::Inside { diagonal, residual } => {
                    self.inside.push(i);
                    self.diagonal.push(diagonal);
                    self.residual.push(residual);
                    0.0
                }
            };

            self.direction.push(to_bound);
        }
    }

    /// Adds to the residuals what the components that go to their bounds change in F.
    fn move_bounded(&mut self, jacobian: &JacobianMatrix) {
        for (j, moved) in self.direction.iter().enumerate() {
            if *moved == 0.0 {
                continue;
            }

            jacobian.add_column(j, *moved, &self.inside, &mut self.residual);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::{DMatrix, DVector, dmatrix};

    const INF: f64 = f64::INFINITY;

    fn crashed(p: &LinearMcp, start: &[f64]) -> (Point, bool, usize) {
        let mut problem = Evaluated::new(p);
        let start = problem.point(&DVector::from_column_slice(start));
        let merit = start.merit;
        let ending = Ending {
            limit: 50,
            done: |point: &Point| point.merit < 1e-24,
        };

        let mut storage = SemismoothStorage::default();
        let mut log = Log::default();
        let (point, ended) =
            semismooth(&mut problem, start, ending, &mut storage, &mut log).unwrap();

        assert!(point.merit <= merit);

        let records = log.records();
        let is_newton = |kind: StepKind| kind == StepKind::FischerNewton;
        assert!(records.iter().all(|record| is_newton(record.step)));
        assert_eq!(records.len(), problem.counters.crash_steps);
        assert!(problem.counters.factorisations >= problem.counters.crash_steps);

        (point, ended, problem.counters.factorisations)
    }

    /// Murty's problem, of 2^n - 1 pivots by Lemke's method, n = 12: solution 0, .., 0, 1, from far
    /// away; components at bounds are there exactly.
    #[test]
    fn it_converges_to_exact_bounds() {
        let n = 12;
        let murty = DMatrix::from_fn(n, n, |i, j| {
            if i == j {
                1.0
            } else {
                2.0 * f64::from(u8::from(j > i))
            }
        });
        let (point, ended, factorisations) = crashed(
            &LinearMcp::lcp(murty, vec![-1.0; n]).unwrap(),
            &vec![1.0; n],
        );

        assert!(ended, "{factorisations} {}", point.merit);
        assert!(factorisations < 30, "{factorisations} {}", point.merit);
        assert!(point.z.iter().take(n - 1).all(|v| *v == 0.0));
        assert!((point.z[n - 1] - 1.0).abs() < 1e-12);
    }

    /// Below, inside, above, fixed and free: z = (0, 1, 2, 5, 3) of F = z - (-1, 1, 4, 0, 3).
    #[test]
    fn bounds_of_every_kind() {
        let q = vec![1.0, -1.0, -4.0, 0.0, -3.0];
        let p = LinearMcp::new(
            DMatrix::identity(5, 5),
            q,
            vec![0.0, -1.0, 0.0, 5.0, -INF],
            vec![INF, 2.0, 2.0, 5.0, INF],
        )
        .unwrap();

        for start in [
            [0.0, 0.0, 0.0, 5.0, 0.0],
            [3.0, 2.0, 2.0, 5.0, -9.0],
            [0.5, -1.0, 1.0, 5.0, 3.0],
        ] {
            let (point, ended, _) = crashed(&p, &start);
            assert!(ended, "{start:?}: {point:?}");
            assert!(
                (point.z - DVector::from_column_slice(&[0.0, 1.0, 2.0, 5.0, 3.0])).amax() < 1e-12
            );
        }
    }

    /// No solution: the merit has a minimum that is not zero, and the steps end soon.
    #[test]
    fn poor_progress_ends_it() {
        let (point, ended, factorisations) =
            crashed(&LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap(), &[3.0]);
        assert!(!ended, "{factorisations}");
        assert!(point.merit > 0.4, "{factorisations}");
        assert!(factorisations <= 3 * SEMISMOOTH_WINDOW, "{factorisations}");

        let (_, ended, factorisations) =
            crashed(&LinearMcp::lcp(dmatrix![0.0], vec![-1.0]).unwrap(), &[0.0]);
        assert!(!ended, "{factorisations}");
        assert!(factorisations <= 2 * SEMISMOOTH_WINDOW, "{factorisations}");
    }

    /// The derivative of what Newton solves: -diagonal and residual against the function and its
    /// parts.
    #[test]
    fn rows_are_those_of_the_generalised_jacobian() {
        assert_eq!(row(2.0, 7.0, 2.0, 2.0, 0.5), ComponentRow::Bound(0.0));
        assert_eq!(row(0.25, 1.0, 0.0, INF, 0.5), ComponentRow::Bound(-0.25));
        assert_eq!(row(1.75, -1.0, 0.0, 2.0, 0.5), ComponentRow::Bound(0.25));
        assert_eq!(
            row(1.0, 0.25, 0.0, INF, 0.5),
            ComponentRow::Inside {
                diagonal: 0.0,
                residual: 0.25
            }
        );
        assert_eq!(
            row(7.0, 9.0, -INF, INF, 0.5),
            ComponentRow::Inside {
                diagonal: 0.0,
                residual: 9.0
            }
        );

        // At a bound with F = 0: F may change sign, so that the row stays.
        assert_eq!(
            row(0.0, 0.0, 0.0, INF, 0.5),
            ComponentRow::Inside {
                diagonal: 0.0,
                residual: 0.0
            }
        );

        // phi(3, 4) = -2, by_z = 3/5 - 1, by_f = 4/5 - 1.
        let ComponentRow::Inside { diagonal, residual } = row(3.0, 4.0, 0.0, INF, 0.5) else {
            panic!()
        };

        assert!((diagonal - 2.0).abs() < 1e-14);
        assert!((residual - 10.0).abs() < 1e-13);

        // Pointing out of the bound: never to the bound.
        assert!(matches!(
            row(0.0, -1.0, 0.0, INF, 1.0),
            ComponentRow::Inside { .. }
        ));
        assert!(matches!(
            row(2.0, 0.0, -INF, 2.0, 0.5),
            ComponentRow::Inside { .. }
        ));
    }

    /// `near` times the other one's distance, from both sides.
    #[test]
    fn branches_are_told_apart_by_near() {
        let is_bound = |z: f64, f: f64| matches!(row(z, f, 0.0, 8.0, 0.25), ComponentRow::Bound(_));
        assert!(is_bound(0.5, 2.0));
        assert!(!is_bound(0.5, 1.9));
        assert!(is_bound(7.5, -2.0));
        assert!(!is_bound(7.5, -1.9));

        let is_free = |z: f64, f: f64| {
            matches!(
                row(z, f, 0.0, 8.0, 0.25),
                ComponentRow::Inside { diagonal: 0.0, .. }
            )
        };
        assert!(is_free(2.0, 0.5));
        assert!(!is_free(2.0, 0.6));
        assert!(is_free(6.0, -0.5));
        assert!(!is_free(6.0, -0.6));
        assert!(!is_free(0.2, 0.15));
    }

    #[test]
    fn merits_are_compared_over_a_window() {
        let mut least = 8.0;
        let mut at = |step: usize, merit: f64| (stalls(step, merit, &mut least), least);
        assert_eq!(
            [at(0, 8.0), at(1, 9.0), at(SEMISMOOTH_WINDOW - 1, 9.0)],
            [(false, 8.0); 3]
        );
        assert_eq!(
            at(SEMISMOOTH_WINDOW, 8.0 * SEMISMOOTH_GAIN),
            (false, 8.0 * SEMISMOOTH_GAIN)
        );

        let above = 1.01 * SEMISMOOTH_GAIN * 8.0 * SEMISMOOTH_GAIN;
        assert_eq!(
            at(SEMISMOOTH_WINDOW + 1, 9.0),
            (false, 8.0 * SEMISMOOTH_GAIN)
        );
        assert_eq!(at(2 * SEMISMOOTH_WINDOW, above), (true, above));
    }

    #[test]
    fn elements_change_after_a_short_step() {
        let mut near = [1.0, 2.0];
        let mut after = |length| {
            take_turns(&mut near, length);
            near[0]
        };

        assert_eq!(after(Some(1.0)), 1.0);
        assert_eq!(after(Some(0.5)), 2.0);
        assert_eq!(after(Some(1.0)), 2.0);
        assert_eq!(after(None), 1.0);
    }

    /// z_0 goes to its bound, and what that adds to F_1 is in the right-hand side: 9 - 3/4 + 4 d =
    /// 0.
    #[test]
    fn components_that_go_to_bounds_move_the_others() {
        let p = LinearMcp::new(
            DMatrix::identity(2, 2),
            vec![0.0; 2],
            vec![0.0, -INF],
            vec![INF; 2],
        )
        .unwrap();
        let point = Point {
            z: nalgebra::dvector![0.25, 7.0],
            f: nalgebra::dvector![1.0, 9.0],
            merit: 1.0,
        };
        let mut storage = SemismoothStorage::default();
        let jacobian = dmatrix![2.0, 1.0; 3.0, 4.0].into();

        assert!(storage.newton_direction(&p, &jacobian, &point, 0.5));
        assert_eq!(storage.direction, [-0.25, -8.25 / 4.0]);
    }
}
