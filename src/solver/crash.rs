//! The crash: projected Newton on the guessed active set, before the first path (Dirkse and Ferris
//! 1997, "Crash techniques for large-scale complementarity problems").

use super::dense::solve;
use super::evaluation::{Evaluated, Point};
use super::outcome::{MajorRecord, StepKind, Termination};
use super::tolerance::{ARMIJO, BACKTRACK, CRASH_GAIN, CRASH_PROXIMAL, CRASH_PROXIMAL_LEAST, CRASH_SMALLEST};
use crate::mcp::Mcp;
use nalgebra::{DMatrix, DVector};

/// Crash steps from `start`, at most `limit`, until the active set changes by at most one index or
/// the merit hardly falls. Never raises the merit.
///
/// # Errors
/// [`Termination::NonFinite`] if F' is not finite at an accepted point.
pub(super) fn crash<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    start: Point,
    limit: usize,
    log: &mut Vec<MajorRecord>,
) -> Result<Point, Termination> {
    let mut point = start;
    let mut active = active_set(problem.problem, &point);
    for _ in 0..limit {
        let jacobian = problem.jacobian(&point)?;
        problem.counters.factorisations += 1;
        let (direction, proximal) = newton_direction(&jacobian, &point, &active);
        let Some(next) = direction.and_then(|d| search(problem, &point, &d)) else { break };
        problem.counters.crash_steps += 1;
        log.push(MajorRecord { merit: point.merit, step: StepKind::Crash, proximal, paths: Vec::new() });
        let gained = next.merit <= (1.0 - CRASH_GAIN) * point.merit;
        point = next;
        let next_active = active_set(problem.problem, &point);
        let changes = active.iter().zip(&next_active).filter(|(a, b)| a != b).count();
        active = next_active;
        if changes <= 1 || !gained {
            break;
        }
    }
    Ok(point)
}

/// At a bound, with F pointing strictly out of it.
fn active_set<P: Mcp + ?Sized>(problem: &P, point: &Point) -> Vec<bool> {
    let (l, u) = (problem.lower(), problem.upper());
    let active = |i: usize| {
        let (z, f) = (point.z[i], point.f[i]);
        l[i] == u[i] || (z <= l[i] && f > 0.0) || (z >= u[i] && f < 0.0)
    };
    (0..point.z.len()).map(active).collect()
}

/// Newton's direction in the inactive components; a singular factor is perturbed proximally, with a
/// term that vanishes with the merit. Also returns the term used.
fn newton_direction(jacobian: &DMatrix<f64>, point: &Point, active: &[bool]) -> (Option<DVector<f64>>, f64) {
    let inactive: Vec<usize> = (0..active.len()).filter(|&i| !active[i]).collect();
    let right = DVector::from_fn(inactive.len(), |i, _| -point.f[inactive[i]]);
    let block = |proximal: f64| {
        let entry = |i: usize, j: usize| jacobian[(inactive[i], inactive[j])] + if i == j { proximal } else { 0.0 };
        DMatrix::from_fn(inactive.len(), inactive.len(), entry)
    };
    let size = if jacobian.amax() > 0.0 { jacobian.amax() } else { 1.0 };
    let term = (CRASH_PROXIMAL * point.merit.sqrt()).clamp(CRASH_PROXIMAL_LEAST, CRASH_PROXIMAL) * size;
    for proximal in [0.0, term] {
        if let Some(step) = solve(block(proximal), &right) {
            let mut direction = DVector::zeros(active.len());
            for (&i, v) in inactive.iter().zip(step.iter()) {
                direction[i] = *v;
            }
            return (Some(direction), proximal);
        }
    }
    (None, term)
}

/// Back along the projected arc until the merit falls.
fn search<P: Mcp + ?Sized>(problem: &mut Evaluated<'_, P>, point: &Point, direction: &DVector<f64>) -> Option<Point> {
    let mut step = 1.0;
    while step >= CRASH_SMALLEST {
        let next = problem.point(&(&point.z + direction * step));
        if next.merit <= (1.0 - ARMIJO * step) * point.merit && next.merit < point.merit {
            return Some(next);
        }
        step *= BACKTRACK;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::dmatrix;

    fn crashed(m: DMatrix<f64>, q: Vec<f64>, start: &[f64]) -> (Point, usize) {
        let lcp = LinearMcp::lcp(m, q).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let start = problem.point(&DVector::from_column_slice(start));
        let mut log = Vec::new();
        let point = crash(&mut problem, start, 50, &mut log).unwrap();
        assert_eq!(log.len(), problem.counters.crash_steps);
        (point, log.len())
    }

    #[test]
    fn one_step_solves_an_inactive_linear_problem() {
        let (point, steps) = crashed(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0], &[1.0, 1.0]);
        assert!(point.merit < 1e-28 && steps == 1);
    }

    #[test]
    fn a_singular_factor_is_perturbed_and_the_merit_never_rises() {
        let (point, _) = crashed(dmatrix![0.0, 0.0; 0.0, 1.0], vec![0.0, -1.0], &[1.0, 3.0]);
        assert!(point.merit < 1e-3 && (point.z[1] - 1.0).abs() < 0.1);
        let (point, _) = crashed(dmatrix![-1.0], vec![-1.0], &[0.0]);
        assert!(point.merit <= 2.0);
    }

    /// At a bound with F strictly out of it; at equal bounds always.
    #[test]
    fn active_is_what_is_held_at_its_bound() {
        let p = LinearMcp::new(DMatrix::identity(1, 1), vec![0.0], vec![0.0], vec![4.0]).unwrap();
        let of = |z: f64, f: f64| active_set(&p, &Point { z: DVector::from_element(1, z), f: DVector::from_element(1, f), merit: 0.0 })[0];
        assert_eq!([of(0.0, 1.0), of(0.0, 0.0), of(0.0, -1.0), of(1.0, 1.0), of(1.0, -1.0)], [true, false, false, false, false]);
        assert_eq!([of(4.0, -1.0), of(4.0, 0.0), of(4.0, 1.0)], [true, false, false]);
        let fixed = LinearMcp::new(DMatrix::identity(1, 1), vec![0.0], vec![4.0], vec![4.0]).unwrap();
        assert!(active_set(&fixed, &Point { z: DVector::from_element(1, 4.0), f: DVector::from_element(1, 0.0), merit: 0.0 })[0]);
    }

    /// The proximal term: CRASH_PROXIMAL sqrt(merit) between its limits, times the largest entry.
    #[test]
    fn the_proximal_term_vanishes_with_the_merit() {
        let singular = dmatrix![0.0, 0.0; 0.0, 8.0];
        let of =
            |merit: f64| newton_direction(&singular, &Point { z: DVector::zeros(2), f: DVector::from_element(2, 1.0), merit }, &[false; 2]);
        for (merit, term) in [(1e9, CRASH_PROXIMAL), (0.25, 0.5 * CRASH_PROXIMAL), (0.0, CRASH_PROXIMAL_LEAST)] {
            let (direction, proximal) = of(merit);
            assert_eq!(proximal, term * 8.0);
            approx::assert_relative_eq!(direction.unwrap()[0], -1.0 / (term * 8.0), max_relative = 1e-9);
        }
    }
}
