//! The pencil reversed: value s = 1 / t, so that infinity becomes zero.
//!
//! For t > 0 the rows of (A + t B) x divided by t are those of (B + s A) x. Rows in which B
//! vanishes do not depend on t and stay. The solutions of the reversed problem at s = 0 are the
//! solutions at infinity of the given one.
//!
//! Input: a problem; output: the problem of s with the reciprocal window. Called by `mceip
//! complete` for the solutions at infinity.

use mceip_exact::{Rational, Sparse};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Pencil, Problem, Window};
use num_traits::Zero;

/// The problem with the rows of A and B exchanged, wherever B has a row that is not zero; rows of A
/// alone stay.
///
/// For t > 0 its rows are those of A + tB over t or as they are, so (s, x) solves it exactly if (1
/// / s, x) solves the given one (y is scaled by row). At s = 0 it is the limit for t to infinity:
/// its solutions there are the *solutions at infinity*, to which branches x(t) tend.
///
/// The window is the reciprocal one, [1 / max, 1 / min], which for an infinite window begins at 0
/// and for one that begins at 0 has no end. The unknown keeps its name, though the value is s.
///
/// # Errors
/// [`ModelError`] of the reduction.
///
/// ```
/// use mceip_exact::{Sparse, rational, whole};
/// use mceip_model::{Body, Pencil, Problem, Unknown, Window};
/// use mceip_engine::reduction::reversed;
/// // (1 - t) x = y: t = 1, and s = 1 of (s - 1) x = y.
/// let pencil = Pencil::new(
///     Sparse::from_ints(&[&[1]]),
///     Sparse::from_ints(&[&[-1]]),
///     vec![],
/// )
/// .unwrap();
/// let window = Window::new(rational(1, 2), None).unwrap();
/// let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, window).unwrap();
/// let back = reversed(&problem).unwrap();
/// let Body::Pencil(pencil) = back.body() else {
///     unreachable!()
/// };
/// assert_eq!(
///     (pencil.a().get(0, 0), pencil.b().get(0, 0)),
///     (whole(-1), whole(1))
/// );
/// assert_eq!(
///     (back.window().min(), back.window().max()),
///     (&whole(0), Some(&whole(2)))
/// );
/// ```
pub fn reversed(problem: &Problem) -> Result<Problem, ModelError> {
    let pencil = reduce(problem)?.without_zero()?.pencil;
    let order = pencil.order();

    let mut a = Vec::new();
    let mut b = Vec::new();
    for i in 0..order {
        let a_row = row_entries(pencil.a(), i);
        let b_row = row_entries(pencil.b(), i);
        if b_row.iter().all(|(_, _, v)| v.is_zero()) {
            a.extend(a_row);
        } else {
            a.extend(b_row);
            b.extend(a_row);
        }
    }

    let body = Pencil::new(
        Sparse::from_entries(order, order, a),
        Sparse::from_entries(order, order, b),
        pencil.free().to_vec(),
    )?;

    let window = reciprocal_window(problem.window())?;
    Problem::new(Body::Pencil(body), problem.unknown(), window)
}

/// The entries (row, column, value) of one row.
fn row_entries(matrix: &Sparse, row: usize) -> Vec<(usize, usize, Rational)> {
    let entries = matrix.row(row).iter();
    entries.map(|(j, v)| (row, *j, v.clone())).collect()
}

/// [1 / max, 1 / min], where 1 / infinity is 0 and 1 / 0 infinity.
///
/// A window of the value 0 alone would have infinity as its only value, which no window has; all
/// values are its reciprocal instead.
fn reciprocal_window(window: &Window) -> Result<Window, ModelError> {
    let min = match window.max() {
        Some(max) => reciprocal(max),
        None => Some(Rational::zero()),
    };

    match min {
        Some(min) => Window::new(min, reciprocal(window.min())),
        None => Ok(Window::all()),
    }
}

/// 1 / v, or `None` for 1 / 0.
fn reciprocal(v: &Rational) -> Option<Rational> {
    if v.is_zero() { None } else { Some(v.recip()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};
    use mceip_model::Unknown;
    use mceip_oracle::{Enumeration, enumerate};

    fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
    }

    fn problem(pencil: &Pencil, window: Window) -> Problem {
        Problem::new(Body::Pencil(pencil.clone()), Unknown::Mu, window).unwrap()
    }

    fn pencil_of(problem: &Problem) -> &Pencil {
        let Body::Pencil(pencil) = problem.body() else {
            panic!("a pencil")
        };
        pencil
    }

    /// Each solution's support and value.
    fn supports_and_values(enumeration: &Enumeration) -> Vec<(Vec<usize>, f64)> {
        let solutions = enumeration.solutions.iter();
        solutions
            .map(|s| (s.slip.clone(), s.decimal(17).parse().unwrap()))
            .collect()
    }

    /// Values of the reversed problem are the reciprocals, support by support, rows without B
    /// included.
    #[test]
    fn values_are_reciprocals_and_infinity_is_zero() {
        let pencils = [
            pencil(&[&[1, -6], &[2, -6]], &[&[1, 0], &[0, 1]], &[]),
            pencil(
                &[&[5, 1, 2], &[1, 4, 0], &[2, -1, 3]],
                &[&[0, 0, 0], &[1, -3, 1], &[-2, 0, -1]],
                &[0],
            ),
            pencil(
                &[&[1, -2, 0], &[-1, 1, 3], &[0, 2, 2]],
                &[&[0, 0, 0], &[1, -1, 0], &[0, 1, -4]],
                &[],
            ),
        ];
        let mut found = 0;
        for pencil in pencils {
            let window = Window::new(rational(1, 100), None).unwrap();

            let back = reversed(&problem(&pencil, window.clone())).unwrap();

            let of_t = enumerate(&pencil, &window).unwrap();
            let above_zero =
                Window::new(rational(1, 1_000_000), back.window().max().cloned()).unwrap();
            let of_s = enumerate(pencil_of(&back), &above_zero).unwrap();
            assert_eq!(of_t.solutions.len(), of_s.solutions.len());
            let reciprocals = supports_and_values(&of_s);
            for (support, t) in supports_and_values(&of_t) {
                let is_there = reciprocals
                    .iter()
                    .any(|(other, s)| *other == support && (t * s - 1.0).abs() < 1e-12);
                assert!(is_there, "{support:?} {t}");
                found += 1;
            }
        }

        assert!(found >= 2, "{found}");

        // B = [[1, -1], [-1, 1]]: x = (1, 1) at infinity only.
        let limit = pencil(&[&[1, 0], &[0, 1]], &[&[1, -1], &[-1, 1]], &[]);
        let back = reversed(&problem(&limit, Window::all())).unwrap();
        assert_eq!(
            (back.window().min(), back.window().max()),
            (&whole(0), None)
        );
        let only_zero = Window::new(whole(0), Some(whole(0))).unwrap();
        let at_zero = enumerate(pencil_of(&back), &only_zero).unwrap();
        let supports: Vec<_> = at_zero.solutions.iter().map(|s| s.slip.clone()).collect();
        assert_eq!(supports, [[0, 1]]);
    }
}
