//! The pencil reversed: value s = 1 / t, so that infinity becomes zero.

use mceip_exact::{Rational, Sparse};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Pencil, Problem, Window};
use num_traits::Zero;

/// The problem with the rows of A and B exchanged, wherever B has a row that is not zero; rows of A
/// alone stay. For t > 0 its rows are those of A + tB over t or as they are, so (s, x) solves it
/// exactly if (1 / s, x) solves the given one (y is scaled by row). At s = 0 it is the limit for t
/// to infinity: its solutions there are the *solutions at infinity*, to which branches x(t) tend.
/// The window is the reciprocal one, [1 / max, 1 / min], which for an infinite window begins at 0
/// and for one that begins at 0 has no end. The name of the unknown is kept, though its value is
/// now s.
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
    let pencil = reduce(problem)?.pencil;
    let n = pencil.order();
    let stays = |i: usize| pencil.b().row(i).iter().all(|(_, v)| v.is_zero());
    let rows = |exchanged: &Sparse, kept: Option<&Sparse>| -> Sparse {
        let row = |i: usize| if stays(i) { kept } else { Some(exchanged) };
        let entries = (0..n).flat_map(|i| {
            row(i)
                .into_iter()
                .flat_map(move |m| m.row(i).iter().map(move |(j, v)| (i, *j, v.clone())))
        });
        Sparse::from_entries(n, n, entries.collect::<Vec<_>>())
    };
    let body = Pencil::new(
        rows(pencil.b(), Some(pencil.a())),
        rows(pencil.a(), None),
        pencil.free().to_vec(),
    )?;
    let reciprocal = |v: &Rational| if v.is_zero() { None } else { Some(v.recip()) };
    let window = problem.window();
    let min = window
        .max()
        .map_or_else(|| Some(Rational::zero()), reciprocal);
    // A window of the value 0 alone is infinity alone, which no window has: the empty end is 0 as
    // well.
    let window = match min {
        Some(min) => Window::new(min, reciprocal(window.min()))?,
        None => Window::all(),
    };
    Problem::new(Body::Pencil(body), problem.unknown(), window)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;
    use mceip_model::Unknown;
    use mceip_oracle::enumerate;

    /// Values of the reversed problem are the reciprocals, support by support, rows without B
    /// included.
    #[test]
    fn values_are_reciprocals_and_infinity_is_zero() {
        let pencil = |a: &[&[i64]], b: &[&[i64]], free: &[usize]| {
            Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
        };
        let list = [
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
        for pencil in list {
            let window = Window::new(mceip_exact::rational(1, 100), None).unwrap();
            let problem =
                Problem::new(Body::Pencil(pencil.clone()), Unknown::Mu, window.clone()).unwrap();
            let back = reversed(&problem).unwrap();
            let Body::Pencil(other) = back.body() else {
                panic!("a pencil")
            };
            let forth = enumerate(&pencil, &window).unwrap();
            let above = Window::new(
                mceip_exact::rational(1, 1_000_000),
                back.window().max().cloned(),
            )
            .unwrap();
            let there = enumerate(other, &above).unwrap();
            assert_eq!(forth.solutions.len(), there.solutions.len());
            let values = |e: &mceip_oracle::Enumeration| -> Vec<(Vec<usize>, f64)> {
                e.solutions
                    .iter()
                    .map(|s| (s.slip.clone(), s.decimal(17).parse().unwrap()))
                    .collect()
            };
            for (support, v) in values(&forth) {
                assert!(
                    values(&there)
                        .iter()
                        .any(|(s, w)| *s == support && (v * w - 1.0).abs() < 1e-12),
                    "{support:?} {v}"
                );
                found += 1;
            }
        }
        assert!(found >= 2, "{found}");
        // B = [[1, -1], [-1, 1]]: x = (1, 1) at infinity only.
        let limit = pencil(&[&[1, 0], &[0, 1]], &[&[1, -1], &[-1, 1]], &[]);
        let problem = Problem::new(Body::Pencil(limit), Unknown::Mu, Window::all()).unwrap();
        let back = reversed(&problem).unwrap();
        assert_eq!(
            (back.window().min(), back.window().max()),
            (&whole(0), None)
        );
        let Body::Pencil(other) = back.body() else {
            panic!("a pencil")
        };
        let found = enumerate(other, &Window::new(whole(0), Some(whole(0))).unwrap()).unwrap();
        assert_eq!(
            found
                .solutions
                .iter()
                .map(|s| s.slip.clone())
                .collect::<Vec<_>>(),
            [[0, 1]]
        );
    }
}
