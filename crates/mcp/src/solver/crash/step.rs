//! One step of a crash: the linear system over the components inside, and the way back along the
//! projected arc until the merit falls.

use super::super::dense::Lu;
use super::super::evaluation::{Evaluated, Point};
use super::super::tolerance::{ARMIJO, BACKTRACK};
use crate::mcp::Mcp;
use nalgebra::DMatrix;

/// Solves (F'_II + diagonal) d = -residual over the components `inside` into `step`; says if there
/// is a solution.
pub(super) fn solve_inside(
    lu: &mut Lu<f64>,
    step: &mut Vec<f64>,
    jacobian: &DMatrix<f64>,
    inside: &[usize],
    diagonal: impl Fn(usize) -> f64,
    residual: impl Fn(usize) -> f64,
) -> bool {
    let gather = |j: usize, rows: &[usize], out: &mut [f64]| {
        let column = jacobian.column(inside[j]);
        let entry = |r: usize| column[inside[r]] + if r == j { diagonal(j) } else { 0.0 };
        rows.iter().zip(out).for_each(|(&r, o)| *o = entry(r));
    };
    if !lu.factor(inside.len(), gather, |_| 0.0) {
        return false;
    }
    step.clear();
    step.extend(lu.rows().iter().map(|&r| -residual(r)));
    lu.solve(step);
    step.iter().all(|v| v.is_finite())
}

/// Back along the projected arc, no further than to `smallest`, until the merit falls; with the
/// length of the step.
pub(super) fn search<P: Mcp + ?Sized>(
    problem: &mut Evaluated<'_, P>,
    point: &Point,
    direction: &[f64],
    smallest: f64,
) -> Option<(Point, f64)> {
    let mut step = 1.0;
    while step >= smallest {
        let next = problem.point_with(|i| point.z[i] + direction[i] * step);
        if next.merit <= (1.0 - ARMIJO * step) * point.merit && next.merit < point.merit {
            return Some((next, step));
        }
        problem.recycle(next);
        step *= BACKTRACK;
    }
    None
}
