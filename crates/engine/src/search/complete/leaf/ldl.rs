//! Absence over a whole window by definiteness alone: the conditions (19) and (20) with exact LDL'
//! factors as evidence, tried before any search.

use crate::tolerance::SEMIDEFINITE_PIVOT;
use mceip_check::certificate::{Ldl, LdlFactor, Node};
use mceip_exact::{Rational, rational, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use num_traits::{Signed, Zero};

/// Largest order for which exact factors are formed: beyond it their numbers grow longer than they
/// tell.
const MAX_ORDER: usize = 48;

/// A leaf that closes the whole window, if the pencil's symmetric part is definite at both ends
/// (semidefinite direction at an infinite one). // E19, E20
pub(crate) fn leaf(pencil: &Pencil, window: &Window) -> Option<Node> {
    if pencil.order() > MAX_ORDER {
        return None;
    }
    let at = |t: &Rational| symmetric(&pencil.a().add_scaled(t, pencil.b()).to_dense());
    let lower = at(window.min());
    let upper = window
        .max()
        .map_or_else(|| symmetric(&pencil.b().to_dense()), at);
    // Exact factors of a large matrix take long: not where doubles see that there are none.
    if is_indefinite(&upper) || is_indefinite(&lower) {
        return None;
    }
    let (lower, upper) = (ldl(&lower)?, ldl(&upper)?);
    let strict = |f: &LdlFactor| f.diagonal.iter().all(|d| d.0.is_positive());
    let holds = strict(&lower) && (window.max().is_none() || strict(&upper));
    holds.then(|| Node::Ldl(Box::new(Ldl { lower, upper })))
}

fn symmetric(m: &mceip_exact::Dense) -> Vec<Vec<Rational>> {
    let n = m.rows();
    (0..n)
        .map(|i| {
            (0..n)
                .map(|j| (&m.row(i)[j] + &m.row(j)[i]) * rational(1, 2))
                .collect()
        })
        .collect()
}

/// Is a pivot of S clearly negative in doubles? Never for a semidefinite S: there rounding stays
/// below the margin, and what a row with a tiny pivot leaves behind is semidefinite as well.
fn is_indefinite(s: &[Vec<Rational>]) -> bool {
    let mut s: Vec<Vec<f64>> = s
        .iter()
        .map(|row| row.iter().map(to_f64).collect())
        .collect();
    let n = s.len();
    let margin = SEMIDEFINITE_PIVOT * (0..n).fold(0.0f64, |most, i| most.max(s[i][i].abs()));
    for k in 0..n {
        if s[k][k] < -margin {
            return true;
        }
        if s[k][k] <= margin {
            continue;
        }
        let (upper, lower) = s.split_at_mut(k + 1);
        let pivot = &upper[k];
        for row in lower {
            let factor = row[k] / pivot[k];
            (k + 1..n).for_each(|j| row[j] -= factor * pivot[j]);
        }
    }
    false
}

/// S = L D L' with unit lower triangular L and D >= 0; `None` if S is not positive semidefinite.
fn ldl(s: &[Vec<Rational>]) -> Option<LdlFactor> {
    let n = s.len();
    let (mut rows, mut diagonal): (Vec<Vec<Rational>>, Vec<Rational>) =
        (vec![Vec::new(); n], Vec::new());
    for k in 0..n {
        let reduced = |i: usize, rows: &[Vec<Rational>], diagonal: &[Rational]| {
            (0..k).fold(s[i][k].clone(), |sum, l| {
                sum - &rows[i][l] * &rows[k][l] * &diagonal[l]
            })
        };
        let d = reduced(k, &rows, &diagonal);
        if d.is_negative() {
            return None;
        }
        for i in k + 1..n {
            let below = reduced(i, &rows, &diagonal);
            if d.is_zero() && !below.is_zero() {
                return None;
            }
            rows[i].push(if d.is_zero() { below } else { below / &d });
        }
        diagonal.push(d);
    }
    let number = |list: Vec<Rational>| list.into_iter().map(Number).collect();
    Some(LdlFactor {
        rows: rows.into_iter().map(number).collect(),
        diagonal: number(diagonal),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Watch;
    use crate::search::complete::{Options, complete};
    use mceip_exact::{Sparse, whole};
    use mceip_model::{Body, Problem, Unknown};

    fn pencil(a: &[&[i64]], b: &[&[i64]]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), vec![]).unwrap()
    }

    /// sym A definite, B semidefinite of rank one: (19) over the half line in one leaf.
    #[test]
    fn a_semidefinite_direction_closes_the_half_line() {
        let p = pencil(&[&[2, 1], &[-1, 2]], &[&[1, 2], &[2, 4]]);
        assert!(matches!(leaf(&p, &Window::all()), Some(Node::Ldl(_))));
        let problem = Problem::new(Body::Pencil(p), Unknown::Lambda2, Window::all()).unwrap();
        let found = complete(&problem, &Options::default(), &Watch::nobody()).unwrap();
        assert_eq!(
            (
                found.is_complete(),
                found.cover.leaves,
                found.cover.solutions.len()
            ),
            (true, 1, 0)
        );
    }

    /// Rank one with entries of every size is semidefinite to the screen as it is to the exact
    /// factors; taking a thousandth off a diagonal entry is seen.
    #[test]
    fn the_screen_keeps_what_is_semidefinite() {
        let v = [7, -300, 0, 11, 1, -1, 99_991];
        let rank_one = |less: &Rational| -> Vec<Vec<Rational>> {
            let entry = |i: usize, j: usize| {
                rational(v[i] * v[j], 3)
                    - if (i, j) == (4, 4) {
                        less.clone()
                    } else {
                        whole(0)
                    }
            };
            (0..v.len())
                .map(|i| (0..v.len()).map(|j| entry(i, j)).collect())
                .collect()
        };
        assert!(!is_indefinite(&rank_one(&whole(0))) && ldl(&rank_one(&whole(0))).is_some());
        assert!(is_indefinite(&rank_one(&whole(100_000))));
        // Too little to be seen in doubles: the exact factors refuse it.
        assert!(
            !is_indefinite(&rank_one(&rational(1, 1_000_000)))
                && ldl(&rank_one(&rational(1, 1_000_000))).is_none()
        );
    }

    #[test]
    fn what_is_not_definite_has_no_leaf() {
        // det sym A = 0; sym B indefinite; definite on [0, 1] only.
        assert!(
            leaf(
                &pencil(&[&[1, 1], &[1, 1]], &[&[1, 0], &[0, 1]]),
                &Window::all()
            )
            .is_none()
        );
        assert!(
            leaf(
                &pencil(&[&[1, 0], &[0, 1]], &[&[1, 2], &[2, 1]]),
                &Window::all()
            )
            .is_none()
        );
        let falling = pencil(&[&[2, 0], &[0, 2]], &[&[-1, 0], &[0, 0]]);
        assert!(leaf(&falling, &Window::all()).is_none());
        assert!(leaf(&falling, &Window::new(whole(0), Some(whole(2))).unwrap()).is_none());
        assert!(leaf(&falling, &Window::new(whole(0), Some(whole(1))).unwrap()).is_some());
    }
}
