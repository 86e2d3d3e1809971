//! The projected-gradient step on the Fischer merit: the fallback when no path helps.

use super::evaluation::{Evaluated, Point};
use super::fischer;
use super::outcome::Termination;
use super::tolerance::{ARC_TRIALS, ARMIJO, BACKTRACK, GRADIENT_GAIN};
use crate::mcp::Mcp;
use nalgebra::DVector;

/// One step along the projected arc z(a) = pi(z - a grad Psi), with Armijo's rule; `None` where the
/// merit does not fall noticeably (a stationary point).
///
/// # Errors
/// [`Termination::NonFinite`] if F' is not finite at the point.
pub(super) fn gradient_step<P: Mcp + ?Sized>(problem: &mut Evaluated<'_, P>, point: &Point) -> Result<Option<Point>, Termination> {
    let jacobian = problem.jacobian(point)?;
    let mut along = problem.spare();
    let Point { z: direction, f: work, .. } = &mut along;
    fischer::gradient(problem.problem, point.z.as_slice(), point.f.as_slice(), &jacobian, direction, work);
    problem.recycle_matrix(jacobian);
    let next = search(problem, point, &along.z);
    problem.recycle(along);
    Ok(next)
}

/// Back along the arc until the merit falls.
fn search<P: Mcp + ?Sized>(problem: &mut Evaluated<'_, P>, point: &Point, gradient: &DVector<f64>) -> Option<Point> {
    let size = gradient.amax();
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    // First trial: the step that would remove the merit if it fell at the gradient's rate.
    let mut step = (2.0 * point.merit / gradient.norm_squared()).min((1.0 + point.z.amax()) / size);
    for _ in 0..ARC_TRIALS {
        let next = problem.point_with(|i| point.z[i] - gradient[i] * step);
        let promised: f64 = (0..gradient.len()).map(|i| gradient[i] * (point.z[i] - next.z[i])).sum();
        if next.merit <= point.merit - ARMIJO * promised && next.merit <= (1.0 - GRADIENT_GAIN) * point.merit {
            return Some(next);
        }
        problem.recycle(next);
        step *= BACKTRACK;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcp::LinearMcp;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn lowers_the_merit_and_stops_at_stationary_points() {
        let lcp = LinearMcp::lcp(dmatrix![2.0, 1.0; 1.0, 2.0], vec![-5.0, -6.0]).unwrap();
        let mut problem = Evaluated::new(&lcp);
        let far = problem.point(&dvector![3.0, 0.0]);
        let next = gradient_step(&mut problem, &far).unwrap().unwrap();
        assert!(next.merit < far.merit);
        let solution = problem.point(&dvector![4.0 / 3.0, 7.0 / 3.0]);
        assert!(gradient_step(&mut problem, &solution).unwrap().is_none_or(|p| p.merit < 1e-29));
    }
}
