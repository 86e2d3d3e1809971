//! From a point in doubles to an exact solution: read off the active set, solve it over Q, check.
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
    let n = problem.dimension();
    if point.len() != n {
        return Err(Violated::Length {
            expected: n,
            got: point.len(),
        }
        .into());
    }
    let mut z: Vec<Rational> = point
        .iter()
        .map(|v| from_f64(*v).unwrap_or_default())
        .collect();
    let f = problem.function(&z);
    let mut inside = Vec::new();
    for i in 0..n {
        let f_i = to_f64(&f[i]);
        match problem.bounds(i) {
            (Some(l), u) if point[i] - to_f64(l) <= f_i || u == Some(l) => z[i] = l.clone(),
            (_, Some(u)) if to_f64(u) - point[i] <= -f_i => z[i] = u.clone(),
            _ => inside.push(i),
        }
    }
    if !solve_rows(problem, &inside, &mut z) {
        return Err(Uncertifiable::Inconsistent { inside });
    }
    check(problem, &z)?;
    Ok(z)
}

/// Gauss and Jordan over Q for the rows F_I = 0 in the unknowns z_I; false if they contradict.
fn solve_rows(problem: &ExactMcp, inside: &[usize], z: &mut [Rational]) -> bool {
    let k = inside.len();
    // Rows of [M_II | -F_I], in steps from the present z.
    let f = problem.function(z);
    let mut rows: Vec<Vec<Rational>> = inside
        .iter()
        .map(|&i| {
            inside
                .iter()
                .map(|&j| problem.entry(i, j).clone())
                .chain([-&f[i]])
                .collect()
        })
        .collect();
    let mut pivots = Vec::new();
    for col in 0..k {
        let top = pivots.len();
        let Some(found) = (top..k).find(|&row| !rows[row][col].is_zero()) else {
            continue;
        };
        rows.swap(top, found);
        let pivot = rows[top][col].clone();
        rows[top].iter_mut().for_each(|v| *v /= &pivot);
        let pivot_row = rows[top].clone();
        for (r, row) in rows.iter_mut().enumerate() {
            if r != top && !row[col].is_zero() {
                let factor = row[col].clone();
                row.iter_mut()
                    .zip(&pivot_row)
                    .for_each(|(v, p)| *v -= &factor * p);
            }
        }
        pivots.push(col);
    }
    if rows[pivots.len()..].iter().any(|row| !row[k].is_zero()) {
        return false;
    }
    for (row, &col) in pivots.iter().enumerate() {
        z[inside[col]] += &rows[row][k];
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn lcp(m: &[&[i64]], q: &[i64]) -> ExactMcp {
        let n = q.len();
        let m = m
            .iter()
            .map(|row| row.iter().map(|v| whole(*v)).collect())
            .collect();
        ExactMcp::new(
            m,
            q.iter().map(|v| whole(*v)).collect(),
            vec![Some(whole(0)); n],
            vec![None; n],
        )
        .unwrap()
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
