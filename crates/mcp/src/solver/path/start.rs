//! The two starts of a path: regular, from the current point, and Lemke's ray, from the bounds.

use super::super::dense::Lu;
use super::super::number::Number;
use super::basis::Basis;
use super::columns::Frame;
use super::record::{Path, Start};
use super::subproblem::Subproblem;
use super::tableau::State;
use super::variable::Variable;

/// Sets z and the multipliers w - v of the state to the start of the given kind, a point of the
/// normal map's domain; the regular one over `current`.
pub(super) fn start_point<T: Number>(
    sub: &Subproblem<'_, T>,
    kind: Start,
    current: &[T],
    state: &mut State<T>,
    free: &mut FreeRows<T>,
) {
    match kind {
        Start::Regular => regular(sub, current, state),
        Start::Ray => ray(sub, state, free),
    }
}

/// The normal-map point over the current z with the least residual.
fn regular<T: Number>(sub: &Subproblem<'_, T>, current: &[T], state: &mut State<T>) {
    let State { z, multiplier, .. } = state;
    z.clear();
    z.extend_from_slice(current);
    sub.value(z, multiplier);
    for (i, m) in multiplier.iter_mut().enumerate() {
        *m = absorbed(&z[i], m, &sub.lower[i], &sub.upper[i]);
    }
}

/// The part of F_i that a bound absorbs: its positive part at a lower one, its negative part at an
/// upper one, all of it where both hold. The residual F - m is the least over z.
fn absorbed<T: Number>(z: &T, f: &T, lower: &T, upper: &T) -> T {
    let at_lower = if z <= lower {
        f.clone().larger(T::zero())
    } else {
        T::zero()
    };
    let at_upper = if z >= upper {
        f.clone().smaller(T::zero())
    } else {
        T::zero()
    };
    at_lower + at_upper
}

/// Lemke's ray: bounded z at a bound, free z solving their rows, and all multipliers lifted by the
/// same amount until they are positive, so that t -> -inf is a ray of the path.
fn ray<T: Number>(sub: &Subproblem<'_, T>, state: &mut State<T>, free: &mut FreeRows<T>) {
    let State { z, multiplier, .. } = state;
    z.clear();
    z.extend(
        sub.lower
            .iter()
            .zip(sub.upper)
            .map(|(l, u)| bound_or_zero(l, u)),
    );
    free.solve(sub, z, multiplier);
    sub.value(z, multiplier);
    let side = |i: usize| match (sub.lower[i].is_finite(), sub.upper[i].is_finite()) {
        _ if sub.lower[i] == sub.upper[i] => T::zero(),
        (true, _) => T::one(),
        (false, true) => -T::one(),
        (false, false) => T::zero(),
    };
    let sided = |(i, value): (usize, &T)| side(i) * value.clone();
    let worst = multiplier
        .iter()
        .enumerate()
        .map(|e| -sided(e))
        .fold(T::zero(), T::larger);
    let size = multiplier
        .iter()
        .enumerate()
        .map(|e| sided(e).magnitude())
        .fold(T::zero(), T::larger);
    let lift = worst + if size.is_zero() { T::one() } else { size };
    for (i, m) in multiplier.iter_mut().enumerate() {
        if sub.lower[i] == sub.upper[i] {
            continue;
        }
        *m = if side(i).is_zero() {
            T::zero()
        } else {
            m.clone() + side(i) * lift.clone()
        };
    }
}

fn bound_or_zero<T: Number>(lower: &T, upper: &T) -> T {
    match (lower.is_finite(), upper.is_finite()) {
        (true, _) => lower.clone(),
        (false, true) => upper.clone(),
        (false, false) => T::zero(),
    }
}

/// The rows of the unknowns without bounds. Storage is kept.
pub(super) struct FreeRows<T> {
    indices: Vec<usize>,
    lu: Lu<T>,
    step: Vec<T>,
}

impl<T> Default for FreeRows<T> {
    fn default() -> Self {
        FreeRows {
            indices: Vec::new(),
            lu: Lu::default(),
            step: Vec::new(),
        }
    }
}

impl<T: Number> FreeRows<T> {
    /// Sets the free z so that their own rows vanish, if those rows are regular; else leaves them.
    fn solve(&mut self, sub: &Subproblem<'_, T>, z: &mut [T], value: &mut Vec<T>) {
        let FreeRows { indices, lu, step } = self;
        indices.clear();
        indices.extend(
            (0..z.len()).filter(|&i| !sub.lower[i].is_finite() && !sub.upper[i].is_finite()),
        );
        if indices.is_empty() {
            return;
        }
        sub.value(z, value);
        let gather = |j: usize, rows: &[usize], out: &mut [T]| {
            let column = sub.column(indices[j]);
            rows.iter()
                .zip(out)
                .for_each(|(&i, o)| *o = column[indices[i]].clone());
        };
        if !lu.factor(indices.len(), gather, |_| T::zero()) {
            return;
        }
        step.clear();
        step.extend(lu.rows().iter().map(|&i| -value[indices[i]].clone()));
        lu.solve(step);
        if step.iter().all(T::is_finite) {
            indices
                .iter()
                .zip(step.iter())
                .for_each(|(&i, v)| z[i] = v.clone());
        }
    }
}

/// The basis of a start, repaired with artificials where it is singular: at a bound its multiplier
/// is basic, strictly inside z is. False if even the repaired basis does not factorise.
pub(super) fn starting_basis<T: Number>(
    sub: &Subproblem<'_, T>,
    frame: &mut Frame<T>,
    basis: &mut Basis<T>,
    state: &State<T>,
    path: &mut Path<T>,
) -> bool {
    let place = |(i, z): (usize, &T)| match z {
        z if *z <= sub.lower[i] => Variable::W(i),
        z if *z >= sub.upper[i] => Variable::V(i),
        _ => Variable::Z(i),
    };
    basis.variables.clear();
    basis
        .variables
        .extend(state.z.iter().enumerate().map(place));
    path.factorisations += 1;
    if basis.begin(&frame.columns(sub)) {
        return true;
    }
    for k in 0..basis.repairs().len() {
        let (place, row) = basis.repairs()[k];
        frame.add_artificial(place, row);
        basis.variables[place] = Variable::Artificial(place);
    }
    path.factorisations += 1;
    basis.begin(&frame.columns(sub))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    const INF: f64 = f64::INFINITY;

    #[test]
    fn bounds_absorb_the_part_of_their_sign() {
        for (z, f, expected) in [
            (0.0, 2.0, 2.0),
            (0.0, -2.0, 0.0),
            (1.0, -2.0, -2.0),
            (1.0, 2.0, 0.0),
            (0.5, 2.0, 0.0),
        ] {
            assert_eq!(absorbed(&z, &f, &0.0, &1.0), expected, "z = {z}, F = {f}");
        }
        assert_eq!(
            (
                absorbed(&3.0, &-2.0, &3.0, &3.0),
                absorbed(&3.0, &2.0, &3.0, &3.0)
            ),
            (-2.0, 2.0)
        );
    }

    #[test]
    fn the_ray_dominates_and_free_rows_vanish() {
        let m = dmatrix![2.0, 1.0, 0.0; 0.0, 1.0, 1.0; 1.0, 0.0, 1.0];
        let sub = Subproblem {
            m: &m,
            q: &[-4.0, -3.0, 5.0],
            lower: &[-INF, 0.0, -INF],
            upper: &[INF, INF, 1.0],
        };
        let mut start = State::default();
        ray(&sub, &mut start, &mut FreeRows::default());
        assert_eq!(start.z, [2.0, 0.0, 1.0]);
        let m = &start.multiplier;
        assert!(m[1] > 0.0 && m[2] < 0.0 && m[0] == 0.0);
    }

    #[test]
    fn singular_bases_are_repaired() {
        let m = dmatrix![1.0, 1.0; 1.0, 1.0];
        let sub = Subproblem {
            m: &m,
            q: &[-1.0, -1.0],
            lower: &[-INF; 2],
            upper: &[INF; 2],
        };
        let (mut frame, mut basis, mut state) =
            (Frame::default(), Basis::default(), State::default());
        regular(&sub, &[0.0, 0.0], &mut state);
        frame.set(&sub, &state.z, &state.multiplier);
        let mut path = Path::default();
        assert!(starting_basis(
            &sub, &mut frame, &mut basis, &state, &mut path
        ));
        assert_eq!(
            basis.variables,
            vec![Variable::Z(0), Variable::Artificial(1)]
        );
        assert_eq!(path.factorisations, 2);
    }

    /// All multipliers are lifted by the same amount: what the worst one lacks and the size of the
    /// largest. Equal bounds have no say and are not lifted.
    #[test]
    fn multipliers_are_lifted_until_the_worst_is_positive() {
        let m = DMatrix::<f64>::zeros(4, 4);
        let sub = Subproblem {
            m: &m,
            q: &[-3.0, 2.0, 1.0, -100.0],
            lower: &[0.0, 0.0, -INF, 5.0],
            upper: &[INF, 1.0, 0.0, 5.0],
        };
        let mut state = State::default();
        ray(&sub, &mut state, &mut FreeRows::default());
        assert_eq!(
            (state.z, state.multiplier),
            (vec![0.0, 0.0, 0.0, 5.0], vec![3.0, 8.0, -5.0, -100.0])
        );
        // Where all are zero the amount is one.
        let sub = Subproblem {
            m: &m,
            q: &[0.0; 4],
            ..sub
        };
        let mut state = State::default();
        ray(&sub, &mut state, &mut FreeRows::default());
        assert_eq!(state.multiplier, [1.0, 1.0, -1.0, 0.0]);
    }
}
