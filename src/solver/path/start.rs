//! The two starts of a path: regular, from the current point, and Lemke's ray, from the bounds.

use super::basis::{Basis, Columns};
use super::number::Number;
use super::repair::dependent_places;
use super::variable::Variable;
use super::{Start, Subproblem};
use nalgebra::{DMatrix, DVector};

/// Where a path begins: a point of the normal map's domain as (z, multiplier w - v).
pub(super) struct StartPoint<T> {
    pub(super) z: DVector<T>,
    pub(super) multiplier: DVector<T>,
}

/// The start of the given kind; the regular one over `current`.
pub(super) fn start_point<T: Number>(sub: &Subproblem<'_, T>, kind: Start, current: &DVector<T>) -> StartPoint<T> {
    match kind {
        Start::Regular => regular(sub, current),
        Start::Ray => ray(sub),
    }
}

/// The normal-map point over the current z with the least residual.
fn regular<T: Number>(sub: &Subproblem<'_, T>, current: &DVector<T>) -> StartPoint<T> {
    let value = sub.m * current + sub.q;
    let multiplier = DVector::from_fn(current.len(), |i, _| absorbed(&current[i], &value[i], &sub.lower[i], &sub.upper[i]));
    StartPoint { z: current.clone(), multiplier }
}

/// The part of F_i that a bound absorbs: its positive part at a lower one, its negative part at an
/// upper one, all of it where both hold. The residual F - m is the least over z.
fn absorbed<T: Number>(z: &T, f: &T, lower: &T, upper: &T) -> T {
    let at_lower = if z <= lower { f.clone().larger(T::zero()) } else { T::zero() };
    let at_upper = if z >= upper { f.clone().smaller(T::zero()) } else { T::zero() };
    at_lower + at_upper
}

/// Lemke's ray: bounded z at a bound, free z solving their rows, and all multipliers lifted by the
/// same amount until they are positive, so that t -> -inf is a ray of the path.
fn ray<T: Number>(sub: &Subproblem<'_, T>) -> StartPoint<T> {
    let n = sub.q.len();
    let mut z = DVector::from_fn(n, |i, _| bound_or_zero(&sub.lower[i], &sub.upper[i]));
    solve_free_rows(sub, &mut z);
    let value = sub.m * &z + sub.q;
    let side = |i: usize| match (sub.lower[i].is_finite(), sub.upper[i].is_finite()) {
        _ if sub.lower[i] == sub.upper[i] => T::zero(),
        (true, _) => T::one(),
        (false, true) => -T::one(),
        (false, false) => T::zero(),
    };
    let worst = (0..n).map(|i| -side(i) * value[i].clone()).fold(T::zero(), T::larger);
    let size = (0..n).map(|i| (side(i) * value[i].clone()).magnitude()).fold(T::zero(), T::larger);
    let lift = worst + if size.is_zero() { T::one() } else { size };
    let multiplier = DVector::from_fn(n, |i, _| {
        if sub.lower[i] == sub.upper[i] {
            value[i].clone()
        } else if side(i).is_zero() {
            T::zero()
        } else {
            value[i].clone() + side(i) * lift.clone()
        }
    });
    StartPoint { z, multiplier }
}

fn bound_or_zero<T: Number>(lower: &T, upper: &T) -> T {
    match (lower.is_finite(), upper.is_finite()) {
        (true, _) => lower.clone(),
        (false, true) => upper.clone(),
        (false, false) => T::zero(),
    }
}

/// Sets the free z so that their own rows vanish, if those rows are regular; else leaves them at 0.
fn solve_free_rows<T: Number>(sub: &Subproblem<'_, T>, z: &mut DVector<T>) {
    let free: Vec<usize> = (0..z.len()).filter(|&i| !sub.lower[i].is_finite() && !sub.upper[i].is_finite()).collect();
    let value = sub.m * &*z + sub.q;
    let block = DMatrix::from_fn(free.len(), free.len(), |i, j| sub.m[(free[i], free[j])].clone());
    let right = DVector::from_fn(free.len(), |i, _| -value[free[i]].clone());
    if let Some(step) = T::solve(block, &right) {
        for (&i, v) in free.iter().zip(step.iter()) {
            z[i] = v.clone();
        }
    }
}

/// The basis of a start, repaired with artificials where it is singular: at a bound its multiplier
/// is basic, strictly inside z is. `None` if even the repaired basis does not factorise.
pub(super) fn starting_basis<T: Number>(columns: &mut Columns<'_, T>, point: &StartPoint<T>) -> Option<Basis<T>> {
    let n = point.z.len();
    let (lower, upper) = (columns.sub.lower, columns.sub.upper);
    let mut variables: Vec<Variable> = (0..n)
        .map(|i| match &point.z[i] {
            z if *z <= lower[i] => Variable::W(i),
            z if *z >= upper[i] => Variable::V(i),
            _ => Variable::Z(i),
        })
        .collect();
    let mut priority: Vec<usize> = (0..n).collect();
    priority.sort_by_key(|&i| matches!(variables[i], Variable::Z(_))); // unit columns first
    let matrix = DMatrix::from_fn(n, n, |row, place| columns.of(variables[place])[row].clone());
    for (place, row) in dependent_places(&matrix, &priority) {
        columns.artificial_row[place] = Some(row);
        variables[place] = Variable::Artificial(place);
    }
    let sign = |v: &Variable| if matches!(v, Variable::Artificial(_)) { T::zero() } else { T::one() };
    let signs: Vec<T> = variables.iter().map(sign).collect();
    Basis::new(columns, variables, &signs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    const INF: f64 = f64::INFINITY;

    #[test]
    fn bounds_absorb_the_part_of_their_sign() {
        for (z, f, expected) in [(0.0, 2.0, 2.0), (0.0, -2.0, 0.0), (1.0, -2.0, -2.0), (1.0, 2.0, 0.0), (0.5, 2.0, 0.0)] {
            assert_eq!(absorbed(&z, &f, &0.0, &1.0), expected, "z = {z}, F = {f}");
        }
        assert_eq!((absorbed(&3.0, &-2.0, &3.0, &3.0), absorbed(&3.0, &2.0, &3.0, &3.0)), (-2.0, 2.0));
    }

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
