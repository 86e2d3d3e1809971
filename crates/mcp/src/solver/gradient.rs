//! The projected-gradient step on the Fischer merit: the fallback when no path helps.
//!
//! From a point z the arc z(a) = pi(z - a grad Psi(z)), pi the projection onto the bounds, is
//! followed for a first length a, which is halved until Armijo's rule holds:
//! Psi(z(a)) <= Psi(z) - ARMIJO grad Psi(z)'(z - z(a)). Called by `newton/choose`.

use super::evaluation::{Evaluated, Point};
use super::fischer::{self, GradientStorage};
use super::outcome::Termination;
use super::tolerance::{ARC_TRIALS, ARMIJO, BACKTRACK, GRADIENT_GAIN};
use crate::mcp::Mcp;
use nalgebra::DVector;

/// One step along the projected arc z(a) = pi(z - a grad Psi), with Armijo's rule; `None` where the
/// merit does not fall noticeably (a stationary point).
///
/// # Errors
/// [`Termination::NonFinite`] if F' is not finite at the point.
pub(super) fn gradient_step<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    point: &Point,
) -> Result<Option<Point>, Termination> {
    let jacobian = problem.jacobian(point)?;

    // A spare point lends its two vectors.
    let mut spare = problem.spare();
    let mut storage = GradientStorage {
        gradient: &mut spare.z,
        work: &mut spare.f,
    };
    let z = point.z.as_slice();
    let f = point.f.as_slice();
    fischer::gradient(problem.problem, z, f, &jacobian, &mut storage);
    problem.recycle_matrix(jacobian);

    let next = search(problem, point, &spare.z);
    problem.recycle(spare);
    Ok(next)
}

/// Back along the arc until the merit falls.
fn search<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    point: &Point,
    gradient: &DVector<f64>,
) -> Option<Point> {
    let size = gradient.amax();
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }

    // First trial: the step that would remove the merit if it fell at the gradient's rate, but no
    // longer than 1 + |z|.
    let removing = 2.0 * point.merit / gradient.norm_squared();
    let mut step = removing.min((1.0 + point.z.amax()) / size);

    for _ in 0..ARC_TRIALS {
        let next = problem.point_with(|i| point.z[i] - gradient[i] * step);
        let terms = (0..gradient.len()).map(|i| gradient[i] * (point.z[i] - next.z[i]));
        let promised: f64 = terms.sum();

        let keeps_promise = next.merit <= point.merit - ARMIJO * promised;
        let gains = next.merit <= (1.0 - GRADIENT_GAIN) * point.merit;
        if keeps_promise && gains {
            return Some(next);
        }

        problem.recycle(next);
        step *= BACKTRACK;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::probe::free;
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::{dmatrix, dvector};

    /// Without a direction nothing is tried.
    #[test]
    fn a_gradient_of_zero_or_infinity_has_no_arc() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let point = problem.point(&dvector![3.0, 0.0]);
        let before = problem.counters.functions;

        for gradient in [dvector![0.0, 0.0], dvector![f64::INFINITY, 1.0]] {
            assert!(search(&mut problem, &point, &gradient).is_none());
        }

        assert_eq!(problem.counters.functions, before);
    }

    #[test]
    fn lowers_the_merit_and_stops_at_stationary_points() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let far = problem.point(&dvector![3.0, 0.0]);
        let next = gradient_step(&mut problem, &far).unwrap().unwrap();

        assert!(next.merit < far.merit);

        let solution = problem.point(&dvector![4.0 / 3.0, 7.0 / 3.0]);
        assert!(
            gradient_step(&mut problem, &solution)
                .unwrap()
                .is_none_or(|p| p.merit < 1e-29)
        );
    }

    /// The first trial removes the merit at the gradient's rate, here exactly, but goes no farther
    /// than 1 + |z|.
    #[test]
    fn the_first_trial_is_a_newton_step_of_bounded_length() {
        for (from, root, expected) in [
            (0.0, 5.0, 1.0),
            (2.0, 9.0, 5.0),
            (2.0, 4.0, 4.0),
            (-2.0, -2.5, -2.5),
            (0.0, -0.5, -0.5),
        ] {
            for slope in [1.0, 3.0] {
                let p = free(
                    1,
                    move |z, f| f[0] = slope * (z[0] - root),
                    move |_, j| j[(0, 0)] = slope,
                );
                let mut problem = Evaluated::new(&p);
                let point = problem.point(&dvector![from]);
                let next = gradient_step(&mut problem, &point).unwrap().unwrap();

                approx::assert_relative_eq!(next.z[0], expected, max_relative = 1e-14);
            }
        }
    }

    /// Psi = 1/2 everywhere but where a trial lands: taken from a fall of ARMIJO times what the
    /// gradient promises.
    #[test]
    fn a_trial_is_taken_from_the_promised_fall_on() {
        let taken = |trial: f64, share: f64| {
            let promised = 2.0 - trial; // gradient 1, from z = 2
            let value = (1.0 - 2.0 * share * ARMIJO * promised).sqrt();
            let p = free(
                1,
                move |z, f| f[0] = if z[0] == trial { value } else { 1.0 },
                |_, j| j[(0, 0)] = 0.0,
            );
            let mut problem = Evaluated::new(&p);
            let point = problem.point(&dvector![2.0]);
            search(&mut problem, &point, &dvector![1.0])
                .map(|next| (next.z[0], problem.counters.functions))
        };

        for (trial, trials) in [(1.0, 1), (1.5, 2), (1.75, 3)] {
            assert_eq!(taken(trial, 1.1), Some((trial, trials + 1)), "{trial}");
            assert_eq!(taken(trial, 0.9), None, "{trial}");
        }
    }

    /// Where the bounds hold the arc at the point, equal merit is no gain.
    #[test]
    fn a_step_that_goes_nowhere_is_none() {
        let lcp = LinearMcp::lcp(dmatrix![1.0], vec![-1.0]).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let point = problem.point(&dvector![0.0]);

        assert!(search(&mut problem, &point, &dvector![1.0]).is_none());
        assert!(search(&mut problem, &point, &dvector![f64::NAN]).is_none());
    }
}
