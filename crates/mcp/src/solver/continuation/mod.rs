//! The Newton homotopy of the normal map, F(z) - m = s r with m the multipliers of the bounds: a
//! piecewise smooth curve on which every point with s = 0 is a solution (Allgower and Georg 1990,
//! chapters 2 and 12; Lemke's method is its piecewise linear case).
//!
//! A start is a point with multipliers: r is the residual there and s = 1; or a solution with any
//! r at all, and s = 0. Where an inside unknown meets a bound, or a multiplier vanishes, the pair
//! changes places as in a complementary pivot. The curve turns back in s where it likes and goes on
//! after a solution, so that one curve meets several of them.
//!
//! `curve` holds what a curve leaves, `system` the equations on the current places, `follow`
//! predictor, corrector and events. Input: a problem, a point or a solution, and how many solutions
//! to find. Output: a [`Curve`]. Called by `newton` where the first attempt fails, and by searches
//! for all solutions (`mceip-engine`).

mod curve;
mod follow;
mod system;

use super::error::SolverError;
use super::evaluation::{Evaluated, Point};
use super::options::Options;
use super::outcome::Counters;
use super::tolerance::CURVE_LIFT;
use super::validate::validate;
use crate::mcp::Mcp;
pub use curve::{Curve, CurveEnd, Sense};
use follow::Follower;
use nalgebra::DVector;
use system::{CurvePoint, HomotopySystem, Places};

/// Follows the curve from `start` (length n, projected onto the bounds), where s = 1, until
/// `enough` points with s = 0 were met or the curve ends.
///
/// # Errors
/// [`SolverError`] for bounds, starts and options that make no sense.
///
/// ```
/// use mceip_mcp::{mcp::LinearMcp, solver::{continuation, Options, Sense}};
/// // z >= 0, 1 - z >= 0: the solutions 0 and 1 lie on one curve.
/// let lcp = LinearMcp::lcp(nalgebra::dmatrix![-1.0], vec![1.0]).unwrap();
/// let curve = continuation(&lcp, &[3.0], Sense::Down, 9, &Options::default()).unwrap();
/// assert_eq!(curve.solutions.len(), 2);
/// ```
pub fn continuation<P: Mcp + ?Sized>(
    problem: &P,
    start: &[f64],
    sense: Sense,
    enough: usize,
    options: &Options,
) -> Result<Curve, SolverError> {
    validate(problem, start, options)?;

    let mut evaluated = Evaluated::new(problem);
    let start = evaluated.point(&DVector::from_column_slice(start));
    let (solutions, end) = from_point(&mut evaluated, &start, sense, enough, options);

    Ok(curve(&solutions, end, evaluated.counters))
}

/// The curve through a solution (s = 0 there) with the residual direction `r`, length n.
///
/// # Errors
/// [`SolverError`] for bounds, starts and options that make no sense; `r` is checked like a start.
pub fn continuation_through<P: Mcp + ?Sized>(
    problem: &P,
    solution: &[f64],
    r: &[f64],
    sense: Sense,
    enough: usize,
    options: &Options,
) -> Result<Curve, SolverError> {
    validate(problem, solution, options)?;
    validate(problem, r, options)?;

    let mut evaluated = Evaluated::new(problem);
    let point = evaluated.point(&DVector::from_column_slice(solution));
    let places = Places::at_solution(problem, &point);
    let r = DVector::from_column_slice(r);
    let at = CurvePoint { z: point.z, s: 0.0 };
    let system = HomotopySystem {
        problem: &mut evaluated,
        r,
        places,
    };

    let (solutions, end) = Follower::new(system, at, options, enough).run(sense);
    Ok(curve(&solutions, end, evaluated.counters))
}

/// The public form of what a curve has met.
fn curve(solutions: &[DVector<f64>], end: CurveEnd, counters: Counters) -> Curve {
    Curve {
        solutions: solutions.iter().map(|z| z.as_slice().to_vec()).collect(),
        end,
        counters,
    }
}

/// The curve from a point within the bounds. Multipliers at bounds are lifted off zero, so that the
/// start is not degenerate.
pub(super) fn from_point<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    start: &Point,
    sense: Sense,
    enough: usize,
    options: &Options,
) -> (Vec<DVector<f64>>, CurveEnd) {
    if start.not_finite().is_some() {
        return (Vec::new(), CurveEnd::Stuck);
    }

    let places = Places::at_bounds(problem.problem, &start.z);
    let lift = lift(start.f.amax());
    let r = DVector::from_fn(start.z.len(), |i, _| {
        start.f[i] - places.lifted_multiplier(i, start.f[i], lift)
    });
    let at = CurvePoint {
        z: start.z.clone(),
        s: 1.0,
    };

    let system = HomotopySystem { problem, r, places };
    Follower::new(system, at, options, enough).run(sense)
}

/// How far multipliers at bounds are lifted off zero, where F is of this size.
fn lift(size: f64) -> f64 {
    CURVE_LIFT * (1.0 + size.min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::dmatrix;

    #[test]
    fn multipliers_are_lifted_once_or_twice_as_far() {
        assert_eq!(
            [lift(0.0), lift(0.5), lift(1.0), lift(7.0)],
            [1.0, 1.5, 2.0, 2.0].map(|v| CURVE_LIFT * v)
        );
    }

    fn values(curve: &Curve) -> Vec<f64> {
        curve.solutions.iter().map(|z| z[0]).collect()
    }

    #[test]
    fn a_p_matrix_has_one_solution_on_every_curve() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        for start in [[0.0, 0.0], [9.0, 0.0], [0.1, 7.0]] {
            let curve = continuation(&lcp, &start, Sense::Down, 9, &Options::default()).unwrap();
            assert_eq!(curve.solutions.len(), 1, "{curve:?}");
            assert!((curve.solutions[0][0] - 4.0 / 3.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_curve_goes_on_after_a_solution() {
        // On [0, 2]: 1 - z has the solution 1, and the end points 0 (F = 1) and 2 (F = -1).
        let mcp = LinearMcp::new(dmatrix![-1.0], vec![1.0], vec![0.0], vec![2.0]).unwrap();
        let curve = continuation(&mcp, &[1.5], Sense::Up, 9, &Options::default()).unwrap();

        assert_eq!(values(&curve), vec![2.0], "{curve:?}");

        let curve = continuation(&mcp, &[1.5], Sense::Down, 9, &Options::default()).unwrap();
        assert_eq!(curve.solutions.len(), 2, "{curve:?}");
    }

    #[test]
    fn an_infeasible_problem_ends_on_a_ray_without_solutions() {
        let lcp = LinearMcp::lcp(dmatrix![-1.0], vec![-1.0]).unwrap();
        for sense in [Sense::Down, Sense::Up] {
            let curve = continuation(&lcp, &[0.5], sense, 9, &Options::default()).unwrap();
            assert!(curve.solutions.is_empty(), "{curve:?}");
            assert_eq!(curve.end, CurveEnd::Ray, "{curve:?}");
        }
    }
}
