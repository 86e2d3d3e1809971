//! How far numbers are from a solution: the backward error of a value t and a vector x, exactly.
//!
//! With y = (A + tB) x, free variables f and
//!
//! ```text
//!     s_i = sum_j (|A_ij| + |t B_ij|) |x_j|
//!     r_i = |y_i|          for i in f, and where x_i > 0
//!     r_i = max(-y_i, 0)   where x_i = 0
//! ```
//!
//! the backward error is rho = max r_i / s_i. It is the least number such that (t, x) solves
//! (12)-(14) exactly with some A' and B' instead of A and B, where |A' - A| <= rho |A| and |B' - B|
//! <= rho |B| for each entry: such A' and B' move y_i by up to rho s_i to both sides, and by no
//! more (Oettli and Prager, Numerische Mathematik 6, 1964).
//!
//! A small backward error proves no solution with A and B themselves. It is what can be said of a
//! problem too large for a certificate. Called by the command `block` and by the verdict on
//! somebody's solutions.

use crate::exact_solution::within;
use crate::pencil::Rows;
use crate::reason::{Reason, Rejected};
use mceip_exact::{Integer, Interval, Rational, cleared, common_denominator};
use mceip_model::Problem;
use num_traits::{Signed, Zero};

/// The backward error of a value and x over the variables of the pencil.
///
/// ```
/// use mceip_check::backward_error;
/// use mceip_exact::{rational, whole};
///
/// // (2 - t) x = y >= 0 with x >= 0: t = 2 is a solution.
/// let file = r#"{"format": "mceip-problem/1", "unknown": "lambda2",
///     "pencil": {"a": [["2"]], "b": [["-1"]], "free": []}}"#;
/// let problem = mceip_model::file::read_problem(file, ".".as_ref()).unwrap();
///
/// assert_eq!(backward_error(&problem, &whole(2), &[whole(1)]), Ok(whole(0)));
/// // (2 - 3) x = -1: both terms have to change by a fifth.
/// assert_eq!(backward_error(&problem, &whole(3), &[whole(1)]), Ok(rational(1, 5)));
/// ```
///
/// # Errors
/// [`Rejected`] for a value outside the window, for an x of another length, without a component
/// that is not zero, or with a negative complementarity variable, and for a system with particles
/// in contact with zero reaction.
pub fn backward_error(
    problem: &Problem,
    value: &Rational,
    x: &[Rational],
) -> Result<Rational, Rejected> {
    let rows = Rows::of(problem);
    is_candidate(problem, &rows, value, x)?;

    let mut largest = Rational::zero();
    for (i, row) in rows.rows.iter().enumerate() {
        let unit = common_denominator(row.iter().map(|(j, ..)| &x[*j]));

        // Both are multiplied by the row's factor, the unit, and the denominator of t.
        let mut y = Integer::zero();
        let mut size = Integer::zero();
        for (j, a, b) in row {
            let x_j = cleared(&x[*j], &unit);
            let of_a = a * value.denom();
            let of_b = b * value.numer();
            size += (of_a.abs() + of_b.abs()) * x_j.abs();
            y += (of_a + of_b) * x_j;
        }

        let is_equation = rows.is_free[i] || x[i].is_positive();
        let is_violated = y.is_negative() || (is_equation && y.is_positive());
        if is_violated {
            largest = largest.max(Rational::new_raw(y.abs(), size));
        }
    }

    Ok(largest.reduced())
}

/// Demands a value in the window, and an x of the right length, without a negative slip, that is
/// not zero.
fn is_candidate(
    problem: &Problem,
    rows: &Rows,
    value: &Rational,
    x: &[Rational],
) -> Result<(), Reason> {
    rows.without_zero("a backward error")?;
    within(problem.window(), &Interval::point(value.clone()))?;
    Reason::length("x", rows.order(), x.len())?;
    if x.iter().all(Zero::is_zero) {
        return Err(Reason::XZero);
    }

    for (index, x_i) in x.iter().enumerate() {
        if !rows.is_free[index] && x_i.is_negative() {
            return Err(Reason::XNegative {
                index,
                got: x_i.clone(),
            });
        }
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, rational, whole};
    use mceip_model::{Body, Pencil, Unknown, Window};

    /// A = [[2, 1, 0], [1, -3, 2], [0, 1, 4]], B = [[1, 0, 0], [0, 1, 0], [1, 0, 1]], variable 0
    /// free.
    fn matrices() -> [Sparse; 2] {
        [
            Sparse::from_ints(&[&[2, 1, 0], &[1, -3, 2], &[0, 1, 4]]),
            Sparse::from_ints(&[&[1, 0, 0], &[0, 1, 0], &[1, 0, 1]]),
        ]
    }

    fn problem([a, b]: [Sparse; 2]) -> Problem {
        let pencil = Pencil::new(a, b, vec![0]).unwrap();
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
    }

    /// The matrices with row i moved by a share of its moduli against the sign of y_i.
    fn moved(row: usize, value: &Rational, x: &[Rational], share: &Rational) -> [Sparse; 2] {
        let [a, b] = matrices();
        let y: Rational = (0..3)
            .map(|j| (a.get(row, j) + value * b.get(row, j)) * &x[j])
            .sum();
        let of_y = y.signum();

        let against = |matrix: &Sparse, factor: &Rational| {
            let mut entries = Vec::new();
            for (i, j, v) in matrix.entries() {
                let of_term = (v * factor * &x[j]).signum();
                let change = if i == row {
                    -(share * &of_y * of_term)
                } else {
                    whole(0)
                };
                entries.push((i, j, v + v * change));
            }
            Sparse::from_entries(3, 3, entries)
        };

        [against(&a, &whole(1)), against(&b, value)]
    }

    /// The row with the largest share decides; moved by it, that row holds exactly.
    #[test]
    fn it_is_the_least_change_of_the_entries() {
        let value = rational(3, 2);
        let x = [rational(-1, 4), rational(1, 2), rational(0, 1)];
        // y = (-3/8, -1, 1/8) and s = (11/8, 5/2, 7/8). As x_2 = 0, y_2 may be positive.
        let rows = [(0, rational(3, 11)), (1, rational(2, 5))];

        let error = |matrices| backward_error(&problem(matrices), &value, &x).unwrap();
        assert_eq!(error(matrices()), rows[1].1);
        assert_eq!(error(moved(1, &value, &x, &rows[1].1)), rows[0].1);
    }

    /// Of y = (0, c x_0 + x_1) with x_0 = 1.
    #[test]
    fn the_sign_of_y_counts_only_at_rest() {
        let at = |c: i64, x_1: i64| {
            let a = Sparse::from_ints(&[&[0, 0], &[c, 1]]);
            let pencil = Pencil::new(a, Sparse::zeros(2, 2), Vec::new()).unwrap();
            let body = Body::Pencil(pencil);
            let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
            backward_error(&problem, &whole(0), &[whole(1), whole(x_1)]).unwrap()
        };

        assert_eq!(at(5, 0), whole(0));
        assert_eq!(at(-5, 0), whole(1));
        assert_eq!(at(-1, 1), whole(0));
        assert_eq!(at(5, 3), whole(1));
        assert_eq!(at(-5, 3), rational(1, 4));
    }

    #[test]
    fn no_candidate_is_refused_by_name() {
        let refused = |value: i64, x: &[i64]| {
            let x: Vec<Rational> = x.iter().map(|v| whole(*v)).collect();
            let rejected = backward_error(&problem(matrices()), &whole(value), &x);
            rejected.unwrap_err().reason.name()
        };

        assert_eq!(refused(-1, &[-1, 2, 3]), "OutsideWindow");
        assert_eq!(refused(1, &[1, 2]), "Length");
        assert_eq!(refused(1, &[0, 0, 0]), "XZero");
        assert_eq!(refused(1, &[-1, 2, -3]), "XNegative");
    }
}
