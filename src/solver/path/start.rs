//! The two starts of a path: regular, from the current point, and Lemke's ray, from the bounds.

use super::super::dense::solve;
use super::super::normal_map::multiplier;
use super::basis::{Basis, Columns};
use super::repair::dependent_places;
use super::variable::Variable;
use super::{Start, Subproblem};
use nalgebra::{DMatrix, DVector};

/// Where a path begins: a point of the normal map's domain as (z, multiplier w - v).
pub(super) struct StartPoint {
    pub(super) z: DVector<f64>,
    pub(super) multiplier: DVector<f64>,
}

/// The start of the given kind; the regular one over `current`.
pub(super) fn start_point(sub: &Subproblem<'_>, kind: Start, current: &DVector<f64>) -> StartPoint {
    match kind {
        Start::Regular => regular(sub, current),
        Start::Ray => ray(sub),
    }
}

/// The normal-map point over the current z with the least residual.
fn regular(sub: &Subproblem<'_>, current: &DVector<f64>) -> StartPoint {
    let value = sub.m * current + sub.q;
    let multiplier = multiplier(current, &value, sub.lower, sub.upper);
    StartPoint { z: current.clone(), multiplier }
}

/// Lemke's ray: bounded z at a bound, free z solving their rows, and all multipliers lifted by the
/// same amount until they are positive, so that t -> -inf is a ray of the path.
fn ray(sub: &Subproblem<'_>) -> StartPoint {
    let n = sub.q.len();
    let mut z = DVector::from_fn(n, |i, _| bound_or_zero(sub.lower[i], sub.upper[i]));
    solve_free_rows(sub, &mut z);
    let value = sub.m * &z + sub.q;
    let side = |i: usize| match (sub.lower[i].is_finite(), sub.upper[i].is_finite()) {
        _ if sub.lower[i] == sub.upper[i] => 0.0,
        (true, _) => 1.0,
        (false, true) => -1.0,
        (false, false) => 0.0,
    };
    let worst = (0..n).map(|i| -side(i) * value[i]).fold(0.0, f64::max);
    let size = (0..n).map(|i| (side(i) * value[i]).abs()).fold(0.0, f64::max);
    let lift = worst + if size > 0.0 { size } else { 1.0 };
    let multiplier = DVector::from_fn(n, |i, _| {
        if sub.lower[i] == sub.upper[i] {
            value[i]
        } else if side(i) == 0.0 {
            0.0
        } else {
            value[i] + side(i) * lift
        }
    });
    StartPoint { z, multiplier }
}

fn bound_or_zero(lower: f64, upper: f64) -> f64 {
    match (lower.is_finite(), upper.is_finite()) {
        (true, _) => lower,
        (false, true) => upper,
        (false, false) => 0.0,
    }
}

/// Sets the free z so that their own rows vanish, if those rows are regular; else leaves them at 0.
fn solve_free_rows(sub: &Subproblem<'_>, z: &mut DVector<f64>) {
    let free: Vec<usize> = (0..z.len()).filter(|&i| sub.lower[i] == f64::NEG_INFINITY && sub.upper[i] == f64::INFINITY).collect();
    let value = sub.m * &*z + sub.q;
    let block = DMatrix::from_fn(free.len(), free.len(), |i, j| sub.m[(free[i], free[j])]);
    let right = DVector::from_fn(free.len(), |i, _| -value[free[i]]);
    if let Some(step) = solve(block, &right) {
        for (&i, v) in free.iter().zip(step.iter()) {
            z[i] = *v;
        }
    }
}

/// The basis of a start, repaired with artificials where it is singular: at a bound its multiplier
/// is basic, strictly inside z is. `None` if even the repaired basis does not factorise.
pub(super) fn starting_basis(columns: &mut Columns<'_>, point: &StartPoint) -> Option<Basis> {
    let n = point.z.len();
    let (lower, upper) = (columns.sub.lower, columns.sub.upper);
    let mut variables: Vec<Variable> = (0..n)
        .map(|i| match point.z[i] {
            z if z <= lower[i] => Variable::W(i),
            z if z >= upper[i] => Variable::V(i),
            _ => Variable::Z(i),
        })
        .collect();
    let mut priority: Vec<usize> = (0..n).collect();
    priority.sort_by_key(|&i| matches!(variables[i], Variable::Z(_))); // unit columns first
    let matrix = DMatrix::from_fn(n, n, |row, place| columns.of(variables[place])[row]);
    for (place, row) in dependent_places(&matrix, &priority) {
        columns.artificial_row[place] = Some(row);
        variables[place] = Variable::Artificial(place);
    }
    let signs: Vec<f64> = variables.iter().map(|v| if matches!(v, Variable::Artificial(_)) { 0.0 } else { 1.0 }).collect();
    Basis::new(columns, variables, &signs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    const INF: f64 = f64::INFINITY;

    #[test]
    fn the_ray_dominates_and_free_rows_vanish() {
        let (m, q) = (dmatrix![2.0, 1.0, 0.0; 0.0, 1.0, 1.0; 1.0, 0.0, 1.0], dvector![-4.0, -3.0, 5.0]);
        let sub = Subproblem { m: &m, q: &q, lower: &[-INF, 0.0, -INF], upper: &[INF, INF, 1.0] };
        let start = ray(&sub);
        assert_eq!(start.z, dvector![2.0, 0.0, 1.0]);
        assert!(start.multiplier[1] > 0.0 && start.multiplier[2] < 0.0 && start.multiplier[0] == 0.0);
    }

    #[test]
    fn singular_bases_are_repaired() {
        let (m, q) = (dmatrix![1.0, 1.0; 1.0, 1.0], dvector![-1.0, -1.0]);
        let sub = Subproblem { m: &m, q: &q, lower: &[-INF; 2], upper: &[INF; 2] };
        let mut columns = Columns { sub: &sub, r: dvector![1.0, 1.0], artificial_row: vec![None; 2] };
        let basis = starting_basis(&mut columns, &regular(&sub, &dvector![0.0, 0.0])).unwrap();
        assert_eq!(basis.variables, vec![Variable::Z(0), Variable::Artificial(1)]);
    }
}
