//! The two starts of a path: regular, from the current point, and Lemke's ray, from the bounds.
//!
//! A start is a point of the domain of the normal map: z within the bounds and multipliers w - v of
//! the bounds. The regular one lies over the current point; its residual F - (w - v) is the least
//! that the multipliers allow. On Lemke's ray bounded unknowns are at a bound and all multipliers
//! are positive, so that the path comes from t = -inf. `starting_basis` makes the basis of a start,
//! and mends it where it is singular.

use super::super::active_bound::ActiveBound;
use super::super::dense::Lu;
use super::super::number::PathNumber;
use super::basis::Basis;
use super::columns::PathFrame;
use super::record::{Path, Start};
use super::subproblem::Subproblem;
use super::tableau::PathState;
use super::variable::Variable;

/// Sets z and the multipliers w - v of the state to the start of the given kind, a point of the
/// normal map's domain; the regular one over `current`.
pub(super) fn start_point<T: PathNumber>(
    sub: &Subproblem<'_, T>,
    kind: Start,
    current: &[T],
    state: &mut PathState<T>,
    free: &mut FreeRows<T>,
) {
    match kind {
        Start::Regular => regular(sub, current, state),
        Start::Ray => ray(sub, state, free),
    }
}

/// The normal-map point over the current z with the least residual.
fn regular<T: PathNumber>(sub: &Subproblem<'_, T>, current: &[T], state: &mut PathState<T>) {
    let PathState { z, multiplier, .. } = state;
    z.clear();
    z.extend_from_slice(current);

    sub.value(z, multiplier);
    for (i, m) in multiplier.iter_mut().enumerate() {
        *m = absorbed(&z[i], m, &sub.lower[i], &sub.upper[i]);
    }
}

/// The part of F_i that a bound absorbs: its positive part at a lower one, its negative part at an
/// upper one, all of it where both hold. The residual F - m is the least over z.
fn absorbed<T: PathNumber>(z: &T, f: &T, lower: &T, upper: &T) -> T {
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
fn ray<T: PathNumber>(sub: &Subproblem<'_, T>, state: &mut PathState<T>, free: &mut FreeRows<T>) {
    let PathState { z, multiplier, .. } = state;
    z.clear();

    for (lower, upper) in sub.lower.iter().zip(sub.upper) {
        z.push(bound_or_zero(lower, upper));
    }

    free.solve(sub, z, multiplier);
    sub.value(z, multiplier);

    let lift = lift(sub, multiplier);
    for (i, m) in multiplier.iter_mut().enumerate() {
        *m = match bound_of_ray(sub, i) {
            ActiveBound::Lower => m.clone() + lift.clone(),
            ActiveBound::Upper => m.clone() - lift.clone(),
            ActiveBound::None => T::zero(),
            ActiveBound::Fixed => continue,
        };
    }
}

/// The bound that the ray holds an unknown at.
fn bound_of_ray<T: PathNumber>(sub: &Subproblem<'_, T>, i: usize) -> ActiveBound {
    let lower = &sub.lower[i];
    let upper = &sub.upper[i];

    if lower == upper {
        ActiveBound::Fixed
    } else if lower.is_finite() {
        ActiveBound::Lower
    } else if upper.is_finite() {
        ActiveBound::Upper
    } else {
        ActiveBound::None
    }
}

/// By how much multipliers have to be lifted to be positive on their sides: what the worst of them
/// lacks, and the size of the largest besides (1 if all are zero).
fn lift<T: PathNumber>(sub: &Subproblem<'_, T>, multiplier: &[T]) -> T {
    let mut worst = T::zero();
    let mut size = T::zero();

    for (i, m) in multiplier.iter().enumerate() {
        let sided = match bound_of_ray(sub, i) {
            ActiveBound::Lower => m.clone(),
            ActiveBound::Upper => -m.clone(),
            ActiveBound::Fixed | ActiveBound::None => continue,
        };

        worst = worst.larger(-sided.clone());
        size = size.larger(sided.magnitude());
    }

    let size = if size.is_zero() { T::one() } else { size };
    worst + size
}

/// The lower bound if it is finite, else the upper one if it is, else 0.
fn bound_or_zero<T: PathNumber>(lower: &T, upper: &T) -> T {
    if lower.is_finite() {
        lower.clone()
    } else if upper.is_finite() {
        upper.clone()
    } else {
        T::zero()
    }
}

/// The rows of the unknowns without bounds. Storage is kept.
pub(super) struct FreeRows<T> {
    /// The unknowns without bounds.
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

impl<T: PathNumber> FreeRows<T> {
    /// Sets the free z so that their own rows vanish, if those rows are regular; else leaves them.
    fn solve(&mut self, sub: &Subproblem<'_, T>, z: &mut [T], value: &mut Vec<T>) {
        self.indices.clear();
        for i in 0..z.len() {
            if !sub.lower[i].is_finite() && !sub.upper[i].is_finite() {
                self.indices.push(i);
            }
        }

        if self.indices.is_empty() || !self.factor(sub) {
            return;
        }

        sub.value(z, value);
        self.step.clear();

        for &row in self.lu.rows() {
            let i = self.indices[row];
            self.step.push(-value[i].clone());
        }

        self.lu.solve(&mut self.step);

        if self.step.iter().all(T::is_finite) {
            for (&i, step) in self.indices.iter().zip(&self.step) {
                z[i] = step.clone();
            }
        }
    }

    /// Factors M in the rows and columns of the free unknowns; false if it is singular.
    fn factor(&mut self, sub: &Subproblem<'_, T>) -> bool {
        let indices = &self.indices;
        self.lu.factor(
            indices.len(),
            |j, rows, out| {
                let column = sub.column(indices[j]);
                for (&row, entry) in rows.iter().zip(out) {
                    *entry = column[indices[row]].clone();
                }
            },
            |_| T::zero(),
        )
    }
}

/// The basis of a start, repaired with artificials where it is singular: at a bound its multiplier
/// is basic, strictly inside z is. False if even the repaired basis does not factorise.
pub(super) fn starting_basis<T: PathNumber>(
    sub: &Subproblem<'_, T>,
    frame: &mut PathFrame<T>,
    basis: &mut Basis<T>,
    state: &PathState<T>,
    path: &mut Path<T>,
) -> bool {
    basis.variables.clear();
    for (i, z) in state.z.iter().enumerate() {
        let variable = if *z <= sub.lower[i] {
            Variable::W(i)
        } else if *z >= sub.upper[i] {
            Variable::V(i)
        } else {
            Variable::Z(i)
        };

        basis.variables.push(variable);
    }

    path.factorisations += 1;
    if basis.begin(&frame.columns(sub)) {
        return true;
    }

    for k in 0..basis.repairs().len() {
        let repair = basis.repairs()[k];
        frame.add_artificial(repair.place, repair.row);
        basis.variables[repair.place] = Variable::Artificial(repair.place);
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

        assert_eq!(absorbed(&3.0, &-2.0, &3.0, &3.0), -2.0);
        assert_eq!(absorbed(&3.0, &2.0, &3.0, &3.0), 2.0);
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
        let mut start = PathState::default();
        ray(&sub, &mut start, &mut FreeRows::default());

        assert_eq!(start.z, [2.0, 0.0, 1.0]);

        let m = &start.multiplier;
        assert!(m[1] > 0.0);
        assert!(m[2] < 0.0);
        assert_eq!(m[0], 0.0);
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
            (PathFrame::default(), Basis::default(), PathState::default());
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
        let mut state = PathState::default();
        ray(&sub, &mut state, &mut FreeRows::default());

        assert_eq!(state.z, vec![0.0, 0.0, 0.0, 5.0]);
        assert_eq!(state.multiplier, vec![3.0, 8.0, -5.0, -100.0]);

        // Where all are zero the amount is one.
        let sub = Subproblem {
            m: &m,
            q: &[0.0; 4],
            ..sub
        };
        let mut state = PathState::default();
        ray(&sub, &mut state, &mut FreeRows::default());

        assert_eq!(state.multiplier, [1.0, 1.0, -1.0, 0.0]);
    }
}
