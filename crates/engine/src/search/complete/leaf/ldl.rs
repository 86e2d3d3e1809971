//! Leaf `ldl`: sym(A + tB) is definite over an interval, by exact factors at both ends.
//!
//! The matrices are those given, free variables included. If sym(A + tB) on the free variables and
//! those that may be in the support is positive definite for every t of the interval, a solution
//! would have 0 < x'(A + tB)x = x'y = 0. On a half line positive definite at the lower end and
//! sym(B) positive semidefinite suffice. // (19), (20)
//!
//! Called by `complete` for the whole window before any search, and by `tree` for regions that
//! reach to infinity. The checker's side is `check::cover::ldl`.

use super::definite::is_definite;
use crate::dense::eliminate_below;
use crate::search::complete::given::Given;
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::pieces::matrix::{SquareMatrix, largest_entry};
use crate::search::complete::pieces::view::View;
use crate::search::complete::region::{SearchRegion, at_zero};
use crate::tolerance::{DEFINITE_PIVOT, SEMIDEFINITE_PIVOT};
use mceip_check::certificate::{Ldl, LdlFactor, Node};
use mceip_exact::{Dense, Rational, rational, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use num_traits::{Signed, Zero};

/// Largest order for which exact factors are formed: beyond it their numbers grow longer than they
/// tell.
const MAX_ORDER: usize = 48;

/// A leaf that closes the whole window, if the pencil's symmetric part is definite at both ends
/// (semidefinite direction at an infinite one).
pub(crate) fn window_leaf(pencil: &Pencil, window: &Window) -> Option<Node> {
    if pencil.order() > MAX_ORDER {
        return None;
    }

    let lower = symmetric_at(pencil, window.min());
    let upper = match window.max() {
        Some(max) => symmetric_at(pencil, max),
        None => symmetric(&pencil.b().to_dense()),
    };

    // Exact factors of a large matrix take long: not where doubles see that there are none.
    if is_indefinite(&upper) || is_indefinite(&lower) {
        return None;
    }

    let lower = ldl(&lower)?;
    let upper = ldl(&upper)?;
    let upper_suffices = window.max().is_none() || is_strict(&upper);
    if is_strict(&lower) && upper_suffices {
        Some(Node::Ldl(Box::new(Ldl { lower, upper })))
    } else {
        None
    }
}

/// A leaf for a region that reaches to infinity, where sym(B) may be semidefinite only. Doubles see
/// first whether there is a chance. `ends` are those of the region, of an expansion that is not
/// reversed.
pub(crate) fn half_line_leaf(
    given: &Given<'_>,
    view: &View,
    region: &SearchRegion,
    ends: &ChordEnds,
) -> Option<Node> {
    let states = &region.states;
    let ones = vec![1.0; states.len()];
    if !ends.is_half_line() || !is_definite(&ends.m[0], ends.radius(0), states, &ones) {
        return None;
    }

    if !is_definite(&lifted_direction(&ends.m[1]), None, states, &ones) {
        return None;
    }

    let part = without(given.pencil, &view.variables(&at_zero(states)))?;
    let half_line = Window::new(region.lo.clone(), None).ok()?;
    window_leaf(&part, &half_line)
}

/// The direction with so much added to its diagonal that a semidefinite one passes for definite.
fn lifted_direction(direction: &SquareMatrix) -> SquareMatrix {
    let largest = largest_entry(direction).max(f64::MIN_POSITIVE);
    let mut lifted = direction.clone();
    for (i, row) in lifted.iter_mut().enumerate() {
        row[i] += 2.0 * DEFINITE_PIVOT * largest;
    }

    lifted
}

/// The pencil without these variables.
fn without(pencil: &Pencil, left_out: &[usize]) -> Option<Pencil> {
    let kept: Vec<usize> = (0..pencil.order())
        .filter(|i| !left_out.contains(i))
        .collect();
    let free = (0..kept.len())
        .filter(|&p| pencil.free().contains(&kept[p]))
        .collect();
    let a = pencil.a().submatrix(&kept, &kept);
    let b = pencil.b().submatrix(&kept, &kept);
    Pencil::new(a, b, free).ok()
}

/// sym(A + tB).
fn symmetric_at(pencil: &Pencil, t: &Rational) -> Vec<Vec<Rational>> {
    let matrix = pencil.a().add_scaled(t, pencil.b());
    symmetric(&matrix.to_dense())
}

fn symmetric(m: &Dense) -> Vec<Vec<Rational>> {
    let half = rational(1, 2);
    let mut rows = Vec::with_capacity(m.rows());
    for i in 0..m.rows() {
        let row = (0..m.rows()).map(|j| (&m.row(i)[j] + &m.row(j)[i]) * &half);
        rows.push(row.collect());
    }

    rows
}

/// Is a pivot of S clearly negative in doubles? Never for a semidefinite S: there rounding stays
/// below the margin, and what a row with a tiny pivot leaves behind is semidefinite as well.
fn is_indefinite(s: &[Vec<Rational>]) -> bool {
    let mut s: SquareMatrix = s
        .iter()
        .map(|row| row.iter().map(to_f64).collect())
        .collect();
    let order = s.len();
    let mut largest_diagonal = 0.0f64;
    for (i, row) in s.iter().enumerate() {
        largest_diagonal = largest_diagonal.max(row[i].abs());
    }

    let margin = SEMIDEFINITE_PIVOT * largest_diagonal;

    for k in 0..order {
        if s[k][k] < -margin {
            return true;
        }

        if s[k][k] <= margin {
            continue;
        }

        eliminate_below(&mut s, k);
    }

    false
}

/// S = L D L' with unit lower triangular L and D >= 0; `None` if S is not positive semidefinite.
fn ldl(s: &[Vec<Rational>]) -> Option<LdlFactor> {
    let order = s.len();
    let mut factor = Partial {
        rows: vec![Vec::new(); order],
        diagonal: Vec::new(),
    };

    for k in 0..order {
        let pivot = factor.reduced(s, k, k);
        if pivot.is_negative() {
            return None;
        }

        for i in k + 1..order {
            let below = factor.reduced(s, i, k);
            if pivot.is_zero() && !below.is_zero() {
                return None;
            }

            let entry = if pivot.is_zero() {
                below
            } else {
                below / &pivot
            };

            factor.rows[i].push(entry);
        }

        factor.diagonal.push(pivot);
    }

    Some(LdlFactor {
        rows: factor.rows.into_iter().map(numbers).collect(),
        diagonal: numbers(factor.diagonal),
    })
}

/// The columns of L and the entries of D that are known so far.
struct Partial {
    rows: Vec<Vec<Rational>>,
    diagonal: Vec<Rational>,
}

impl Partial {
    /// S_ik - sum_l L_il L_kl D_l over the known columns.
    fn reduced(&self, s: &[Vec<Rational>], i: usize, k: usize) -> Rational {
        let mut entry = s[i][k].clone();
        for (l, d) in self.diagonal.iter().enumerate() {
            entry -= &self.rows[i][l] * &self.rows[k][l] * d;
        }

        entry
    }
}

fn numbers(list: Vec<Rational>) -> Vec<Number> {
    list.into_iter().map(Number).collect()
}

fn is_strict(factor: &LdlFactor) -> bool {
    factor.diagonal.iter().all(|entry| entry.0.is_positive())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Watch;
    use crate::search::complete::{CompleteOptions, complete};
    use mceip_exact::{Sparse, whole};
    use mceip_model::{Body, Problem, Unknown};

    fn pencil(a: &[&[i64]], b: &[&[i64]]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), vec![]).unwrap()
    }

    fn up_to(max: i64) -> Window {
        Window::new(whole(0), Some(whole(max))).unwrap()
    }

    /// sym A definite, B semidefinite of rank one: (19) over the half line in one leaf.
    #[test]
    fn a_semidefinite_direction_closes_the_half_line() {
        let pencil = pencil(&[&[2, 1], &[-1, 2]], &[&[1, 2], &[2, 4]]);

        let leaf = window_leaf(&pencil, &Window::all());
        assert!(matches!(leaf, Some(Node::Ldl(_))));

        let body = Body::Pencil(pencil);
        let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
        let found = complete(&problem, &CompleteOptions::default(), &Watch::nobody()).unwrap();
        assert!(found.is_complete());
        assert_eq!(found.cover.leaves, 1);
        assert!(found.cover.solutions.is_empty());
    }

    /// v v' / 3 with entries of every size, `less` taken off a diagonal entry.
    fn nearly_rank_one(less: &Rational) -> Vec<Vec<Rational>> {
        let v = [7, -300, 0, 11, 1, -1, 99_991];
        let mut rows: Vec<Vec<Rational>> = v
            .iter()
            .map(|a| v.iter().map(|b| rational(a * b, 3)).collect())
            .collect();
        rows[4][4] -= less;
        rows
    }

    /// Rank one with entries of every size is semidefinite to the screen as it is to the exact
    /// factors; taking a thousandth off a diagonal entry is seen.
    #[test]
    fn the_screen_keeps_what_is_semidefinite() {
        let semidefinite = nearly_rank_one(&whole(0));
        assert!(!is_indefinite(&semidefinite));
        assert!(ldl(&semidefinite).is_some());

        let indefinite = nearly_rank_one(&whole(100_000));
        assert!(is_indefinite(&indefinite));

        // Too little to be seen in doubles: the exact factors refuse it.
        let barely_indefinite = nearly_rank_one(&rational(1, 1_000_000));
        assert!(!is_indefinite(&barely_indefinite));
        assert!(ldl(&barely_indefinite).is_none());
    }

    #[test]
    fn what_is_not_definite_has_no_leaf() {
        let singular_a = pencil(&[&[1, 1], &[1, 1]], &[&[1, 0], &[0, 1]]);
        assert!(window_leaf(&singular_a, &Window::all()).is_none());

        let indefinite_b = pencil(&[&[1, 0], &[0, 1]], &[&[1, 2], &[2, 1]]);
        assert!(window_leaf(&indefinite_b, &Window::all()).is_none());

        let definite_below_two = pencil(&[&[2, 0], &[0, 2]], &[&[-1, 0], &[0, 0]]);
        assert!(window_leaf(&definite_below_two, &Window::all()).is_none());
        assert!(window_leaf(&definite_below_two, &up_to(2)).is_none());
        assert!(window_leaf(&definite_below_two, &up_to(1)).is_some());
    }
}
