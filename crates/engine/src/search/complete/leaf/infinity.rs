//! Decided regions that reach to infinity: their null vector lies below them, at infinity itself or
//! beyond it.

use crate::search::complete::leaf::farkas::definite;
use crate::search::complete::leaf::ldl::leaf;
use crate::search::complete::leaf::root::null_vector;
use crate::search::complete::pieces::view::{Ends, Expansion, Matrix};
use crate::search::complete::region::{Region, State};
use crate::search::complete::tree::Search;
use crate::tolerance::{AT_INFINITY, DEFINITE_PIVOT};
use mceip_check::certificate::{Node, RootOutcome};
use mceip_exact::{Integer, Poly, Rational, generic_kernel};
use mceip_model::{Pencil, Window};
use num_traits::Zero;

/// Free and moving variables up to which a null vector at infinity is looked for exactly.
const MAX_ACTIVE: usize = 60;

impl Search<'_> {
    /// Closes a region whose states are decided, if its null vector is provably alone on the way to
    /// infinity and not at a value inside.
    pub(crate) fn at_infinity(&mut self, region: &Region, ends: &Ends, share: f64) -> bool {
        // Cuts close in on a limit as well, at the price of more leaves: the way where the checker
        // has refused this one.
        if region.lo.is_zero() || self.expansion.caution > 1.0 {
            return false;
        }
        let chord = self.chord(ends);
        // 0 is the lower end, 1 infinity.
        let Some(null) = null_vector(&Expansion::line(&chord.m), &region.states, 0.0, 1.0) else {
            return false;
        };
        let Some(unique) = null.unique(&chord) else {
            return false;
        };
        let moving: Vec<usize> = (0..region.states.len())
            .filter(|&p| region.states[p] == State::Moving)
            .map(|p| self.view.index[p])
            .collect();
        // Exact arithmetic is asked first: in doubles the sign of a Schur complement that vanishes
        // is rounding.
        let limit = ((null.value - 1.0).abs() < AT_INFINITY)
            .then(|| (self.limit)(&moving))
            .flatten();
        let outcome = limit
            .map(RootOutcome::Infinity)
            .or_else(|| unique.is_absent(&chord).then_some(RootOutcome::Absent));
        let Some(outcome) = outcome else { return false };
        let root = unique.witness(
            &self.view.index,
            [region.lo.clone(), region.lo.clone()],
            outcome,
        );
        self.leaf(Node::Root(Box::new(root)), share);
        true
    }

    /// A region up to infinity where sym(B) is semidefinite only: exact factors, if doubles see a
    /// chance.
    pub(crate) fn half_line(&self, region: &Region, ends: &Ends) -> Option<Node> {
        if ends.hi.is_finite()
            || self.expansion.reversed
            || !definite(&ends.m[0], ends.r.as_ref(), &region.states, 1.0)
        {
            return None;
        }
        let mut direction = ends.m[1].clone();
        let largest = direction
            .iter()
            .flatten()
            .fold(0.0f64, |s, v| s.max(v.abs()));
        (0..direction.len())
            .for_each(|i| direction[i][i] += 2.0 * DEFINITE_PIVOT * largest.max(f64::MIN_POSITIVE));
        if !definite(&direction, None, &region.states, 1.0) {
            return None;
        }
        let resting: Vec<usize> = (0..region.states.len())
            .filter(|&p| region.states[p] == State::Rest)
            .map(|p| self.view.index[p])
            .collect();
        (self.definite_from)(&region.lo, &resting)
    }

    /// The ends of lo T(t) / t over [lo, infinity), as the checker forms them.
    fn chord(&self, ends: &Ends) -> Ends {
        if self.expansion.reversed {
            return Ends {
                m: ends.m.clone(),
                r: ends.r.clone(),
                slope: ends.slope.clone(),
                ..*ends
            };
        }
        let times = |m: &Matrix, f: f64| -> Matrix {
            m.iter()
                .map(|row| row.iter().map(|v| f * v).collect())
                .collect()
        };
        // Of a linear family the radius at lo and lo times that of the direction are of the size of
        // that at 2 lo.
        let r = self
            .expansion
            .ends(ends.lo, 2.0 * ends.lo)
            .r
            .map(|r| times(&r, 2.0));
        let slope = r.as_ref().map(|r| times(r, 2.0));
        Ends {
            lo: ends.lo,
            hi: ends.hi,
            m: [ends.m[0].clone(), times(&ends.m[1], ends.lo)],
            r,
            slope,
        }
    }
}

/// The null vector of the limit on a moving set, if there is one only: B on the active rows, of
/// free rows that are zero in B those of A.
pub(crate) fn limit(pencil: &Pencil, moving: &[usize], reversed: bool) -> Option<Vec<Integer>> {
    let mut active: Vec<usize> = moving.iter().chain(pencil.free()).copied().collect();
    active.sort_unstable();
    if active.len() > MAX_ACTIVE {
        return None;
    }
    let (a, b) = pencil
        .a()
        .submatrix(&active, &active)
        .to_dense()
        .clear_rows(&pencil.b().submatrix(&active, &active).to_dense());
    let row = |(p, i): (usize, &usize)| {
        let by_a = !reversed && pencil.free().contains(i);
        if by_a { &a[p] } else { &b[p] }
            .iter()
            .map(|v| Poly::new(vec![v.clone()]))
            .collect()
    };
    let mut basis = generic_kernel(active.iter().enumerate().map(row).collect()).0;
    let vector = basis.pop().filter(|_| basis.is_empty())?;
    let mut x = vec![Integer::zero(); pencil.order()];
    active
        .iter()
        .zip(vector)
        .for_each(|(&i, v)| x[i] = v.coeffs().first().cloned().unwrap_or_default());
    Some(x)
}

/// Exact factors of the symmetric part without the resting variables, from lo to infinity.
pub(crate) fn definite_from(pencil: &Pencil, lo: &Rational, resting: &[usize]) -> Option<Node> {
    let kept: Vec<usize> = (0..pencil.order())
        .filter(|i| !resting.contains(i))
        .collect();
    let free = (0..kept.len())
        .filter(|&p| pencil.free().contains(&kept[p]))
        .collect();
    let part = Pencil::new(
        pencil.a().submatrix(&kept, &kept),
        pencil.b().submatrix(&kept, &kept),
        free,
    )
    .ok()?;
    leaf(&part, &Window::new(lo.clone(), None).ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    #[test]
    fn the_limit_is_b_and_for_free_rows_without_b_those_of_a() {
        let integers = |v: &[i64]| Some(v.iter().map(|&v| Integer::from(v)).collect::<Vec<_>>());
        let pencil = |a: &[&[i64]], b: &[&[i64]], free: &[usize]| {
            Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
        };
        let plain = pencil(
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
            &[&[1, -2, 5], &[-2, 4, 5], &[0, 0, 0]],
            &[],
        );
        let x = limit(&plain, &[0, 1], false).unwrap();
        assert!(x[2].is_zero() && x[0] == &x[1] * 2 && !x[1].is_zero());
        assert_eq!(limit(&plain, &[0], false), None);
        assert_eq!(limit(&plain, &[2], false), integers(&[0, 0, 1]));
        let mu = pencil(&[&[2, -1], &[1, 1]], &[&[0, 0], &[4, -2]], &[0]);
        let x = limit(&mu, &[1], false).unwrap();
        assert!(x[1] == &x[0] * 2 && !x[0].is_zero());
        let mass = pencil(&[&[2, -1], &[1, 1]], &[&[1, 3], &[3, 9]], &[0]);
        let x = limit(&mass, &[1], true).unwrap();
        assert!(x[0] == &x[1] * -3 && !x[1].is_zero());
    }
}
