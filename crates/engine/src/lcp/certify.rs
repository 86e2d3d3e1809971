//! From a point in doubles to an exact solution of a plain problem.
//!
//! The active set is read off the point: which unknowns stand at a bound, and which between their
//! bounds, where F vanishes. The rows F_I = 0 of the latter are solved over Q, and the exact point
//! is checked by `check`. Called by `search`.
#![allow(clippy::float_arithmetic)]

use super::check::Violated;
use super::check::check;
use super::exact::ExactMcp;
use mceip_exact::{Rational, from_f64, to_f64};
use num_traits::Zero;

/// Why a point within the tolerance is no certified solution.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Uncertifiable {
    /// The rows of the unknowns between their bounds have no common solution.
    #[error("the rows of {inside:?} have no solution with the other unknowns at their bounds")]
    Inconsistent {
        /// Unknowns taken to be between their bounds.
        inside: Vec<usize>,
    },
    /// The exact point of this active set is no solution.
    #[error("the exact point of the active set is no solution: {0}")]
    NoSolution(#[from] Violated),
}

/// The exact solution near `point` (doubles, length n), checked.
///
/// An unknown stands at a bound if it is nearer to it than F to zero. Where the system of the
/// others is singular, those left undetermined keep the exact value of their double.
///
/// # Errors
/// [`Uncertifiable`].
pub fn certify(problem: &ExactMcp, point: &[f64]) -> Result<Vec<Rational>, Uncertifiable> {
    if point.len() != problem.dimension() {
        return Err(Violated::Length {
            expected: problem.dimension(),
            got: point.len(),
        }
        .into());
    }

    let exact_point = point.iter().map(|v| from_f64(*v).unwrap_or_default());
    let mut z: Vec<Rational> = exact_point.collect();

    let inside = move_to_bounds(problem, point, &mut z);
    if !solve_rows(problem, &inside, &mut z) {
        return Err(Uncertifiable::Inconsistent { inside });
    }

    check(problem, &z)?;
    Ok(z)
}

/// Puts each unknown on a bound that is nearer to it than F to zero; returns those that stay
/// between their bounds.
fn move_to_bounds(problem: &ExactMcp, point: &[f64], z: &mut [Rational]) -> Vec<usize> {
    let f = problem.function(z);
    let mut inside = Vec::new();
    for (i, z_i) in z.iter_mut().enumerate() {
        let f_i = to_f64(&f[i]);
        match problem.bounds(i) {
            (Some(lower), upper) if point[i] - to_f64(lower) <= f_i || upper == Some(lower) => {
                *z_i = lower.clone();
            }
            (_, Some(upper)) if to_f64(upper) - point[i] <= -f_i => *z_i = upper.clone(),
            _ => inside.push(i),
        }
    }

    inside
}

/// Solves the rows F_I = 0 in the unknowns z_I, in steps from the given z; false if the rows
/// contradict each other. Unknowns left undetermined keep their value.
fn solve_rows(problem: &ExactMcp, inside: &[usize], z: &mut [Rational]) -> bool {
    let mut system = ExactTableau::new(problem, inside, z);
    system.eliminate();
    if system.has_contradiction() {
        return false;
    }

    for (row, &column) in system.pivots.iter().enumerate() {
        z[inside[column]] += system.right_side(row);
    }

    true
}

/// Rows [M_II | -F_I] of the linear system for the step from z, in Gauss and Jordan's elimination.
struct ExactTableau {
    rows: Vec<Vec<Rational>>,
    /// Number of unknowns; the right-hand side is the column after them.
    order: usize,
    /// The pivot columns of the first rows.
    pivots: Vec<usize>,
}

impl ExactTableau {
    fn new(problem: &ExactMcp, inside: &[usize], z: &[Rational]) -> ExactTableau {
        let f = problem.function(z);
        let mut rows = Vec::with_capacity(inside.len());
        for &i in inside {
            let entries = inside.iter().map(|&j| problem.entry(i, j).clone());
            let mut row: Vec<Rational> = entries.collect();
            row.push(-&f[i]);
            rows.push(row);
        }

        ExactTableau {
            rows,
            order: inside.len(),
            pivots: Vec::new(),
        }
    }

    /// To reduced row echelon form.
    fn eliminate(&mut self) {
        for column in 0..self.order {
            let top = self.pivots.len();
            let found = (top..self.order).find(|&row| !self.rows[row][column].is_zero());
            let Some(found) = found else {
                continue;
            };
            self.rows.swap(top, found);
            self.pivot(top, column);
            self.pivots.push(column);
        }
    }

    /// Makes the entry of a row and column one, and all others of the column zero.
    fn pivot(&mut self, pivot_index: usize, column: usize) {
        let pivot = self.rows[pivot_index][column].clone();
        for entry in &mut self.rows[pivot_index] {
            *entry /= &pivot;
        }

        let pivot_row = self.rows[pivot_index].clone();
        for (index, row) in self.rows.iter_mut().enumerate() {
            if index == pivot_index || row[column].is_zero() {
                continue;
            }
            let factor = row[column].clone();
            for (entry, p) in row.iter_mut().zip(&pivot_row) {
                *entry -= &factor * p;
            }
        }
    }

    fn right_side(&self, row: usize) -> &Rational {
        &self.rows[row][self.order]
    }

    /// Does a row without a pivot say 0 = b with b not zero?
    fn has_contradiction(&self) -> bool {
        let without_pivot = self.pivots.len()..self.order;
        without_pivot
            .into_iter()
            .any(|row| !self.right_side(row).is_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn lcp(m: &[&[i64]], q: &[i64]) -> ExactMcp {
        let n = q.len();
        let m = m.iter().map(|row| exact(row)).collect();
        ExactMcp::new(m, exact(q), vec![Some(whole(0)); n], vec![None; n]).unwrap()
    }

    fn exact(integers: &[i64]) -> Vec<Rational> {
        integers.iter().map(|v| whole(*v)).collect()
    }

    #[test]
    fn rounded_points_become_exact_and_others_are_refused() {
        let problem = lcp(&[&[2, 1], &[1, 2]], &[-5, -6]);
        assert_eq!(
            certify(&problem, &[1.3333333, 2.3333333]).unwrap(),
            vec![rational(4, 3), rational(7, 3)]
        );

        // Far away the active set is another one, whose exact point is no solution.
        assert!(matches!(
            certify(&problem, &[9.0, 0.0]),
            Err(Uncertifiable::NoSolution(Violated::Sign { index: 0, .. }))
        ));
        assert!(matches!(
            check(&problem, &[rational(4, 3), whole(2)]),
            Err(Violated::Sign { index: 0, .. })
        ));
        assert!(matches!(
            check(&problem, &[whole(-1), whole(2)]),
            Err(Violated::Bounds { index: 0, .. })
        ));
        assert!(matches!(
            check(&problem, &[whole(1)]),
            Err(Violated::Length {
                expected: 2,
                got: 1
            })
        ));
    }

    #[test]
    fn singular_active_sets_keep_what_is_undetermined() {
        let ones = lcp(&[&[1, 1], &[1, 1]], &[-1, -1]);
        assert_eq!(
            certify(&ones, &[0.3, 0.7]).unwrap()[1],
            from_f64(0.7).unwrap()
        );

        let contradiction = lcp(&[&[1, 1], &[1, 1]], &[-1, -2]);
        assert!(matches!(
            certify(&contradiction, &[0.75, 0.75]),
            Err(Uncertifiable::Inconsistent { .. })
        ));
    }
}
