//! The fronts of a sparse Cholesky factorisation, from the pattern alone.

use super::dissection::{Part, dissect};
use super::symmetric::Symmetric;

/// Which unknowns are eliminated in which front. Serves every matrix with this pattern, or less.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// Unknowns in the order of elimination, then those kept.
    pub(super) order: Vec<usize>,
    /// Place of each unknown in `order`; `usize::MAX` for those held.
    pub(super) place: Vec<usize>,
    /// Unknowns eliminated.
    pub(super) eliminated: usize,
    /// Fronts in the order of elimination, children first.
    pub(super) fronts: Vec<Front>,
}

/// Unknowns eliminated together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Front {
    /// First place eliminated here.
    pub(super) begin: usize,
    /// Place after the last one.
    pub(super) end: usize,
    /// Later places that the eliminated ones touch, ascending.
    pub(super) border: Vec<usize>,
    /// Fronts whose updates are added up here.
    pub(super) children: Vec<usize>,
}

impl Front {
    /// Places eliminated.
    pub(super) fn own(&self) -> usize {
        self.end - self.begin
    }

    /// Order of the dense matrix.
    pub(super) fn order(&self) -> usize {
        self.own() + self.border.len()
    }
}

impl Analysis {
    /// Unknowns in `kept` come last, in that order, and are not eliminated; those in `held` are
    /// left out (zero). `points`: positions of all unknowns in the plane, where known, make the
    /// fronts smaller. Indices beyond the order, and those that `held` names again, are ignored.
    pub fn new(
        matrix: &Symmetric,
        kept: &[usize],
        held: &[usize],
        points: Option<&[[f64; 2]]>,
    ) -> Analysis {
        let n = matrix.order();
        let mut wanted = vec![true; n];
        kept.iter()
            .chain(held)
            .filter(|&&i| i < n)
            .for_each(|&i| wanted[i] = false);
        let points = points.filter(|p| p.len() == n);
        let parts = dissect(n, &|i| matrix.columns(i), &|i| wanted[i], points);
        let mut order: Vec<usize> = parts.iter().flat_map(|p| p.own.iter().copied()).collect();
        let eliminated = order.len();
        let mut place = vec![usize::MAX; n];
        held.iter()
            .filter(|&&i| i < n)
            .for_each(|&i| wanted[i] = true);
        order.extend(
            kept.iter()
                .copied()
                .filter(|&i| i < n && !std::mem::replace(&mut wanted[i], true)),
        );
        order.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let fronts = fronts(matrix, &parts, &order, &place);
        Analysis {
            order,
            place,
            eliminated,
            fronts,
        }
    }

    /// Entries of the factor, those of dense lower triangles with their upper parts included.
    pub fn factor_entries(&self) -> usize {
        self.fronts.iter().map(|f| f.own() * f.order()).sum()
    }

    /// Order of the largest dense front.
    pub fn largest_front(&self) -> usize {
        self.fronts.iter().map(Front::order).max().unwrap_or(0)
    }

    /// The unknowns kept, in their order.
    pub fn kept(&self) -> &[usize] {
        &self.order[self.eliminated..]
    }

    /// Number of unknowns eliminated.
    pub fn eliminated(&self) -> usize {
        self.eliminated
    }
}

fn fronts(matrix: &Symmetric, parts: &[Part], order: &[usize], place: &[usize]) -> Vec<Front> {
    let mut fronts: Vec<Front> = Vec::with_capacity(parts.len());
    let mut seen = vec![usize::MAX; order.len()];
    let mut begin = 0;
    for (k, part) in parts.iter().enumerate() {
        let end = begin + part.own.len();
        let of_children = part
            .children
            .iter()
            .flat_map(|&c| fronts[c].border.iter().copied());
        let of_matrix = order[begin..end]
            .iter()
            .flat_map(|&i| matrix.columns(i).iter().map(|&j| place[j]));
        let later =
            |&p: &usize| p != usize::MAX && p >= end && std::mem::replace(&mut seen[p], k) != k;
        let mut border: Vec<usize> = of_children.chain(of_matrix).filter(later).collect();
        border.sort_unstable();
        fronts.push(Front {
            begin,
            end,
            border,
            children: part.children.clone(),
        });
        begin = end;
    }
    fronts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of seven, the middle kept, the first held: two chains that touch what is kept.
    #[test]
    fn kept_come_last_and_held_not_at_all() {
        let chain = (0..7usize).flat_map(|i| {
            [(i, i, 2.0)]
                .into_iter()
                .chain((i > 0).then(|| (i, i - 1, -1.0)))
        });
        let both = chain
            .flat_map(|(i, j, v)| [(i, j, v)].into_iter().chain((i != j).then_some((j, i, v))));
        let a = Analysis::new(&Symmetric::new(7, both).unwrap(), &[3, 99, 3], &[0], None);
        assert_eq!((a.eliminated(), a.order.len(), a.order[5]), (5, 6, 3));
        assert_eq!(a.place[0], usize::MAX);
        assert_eq!(a.fronts.last().unwrap().border, [5]);
        assert_eq!(a.largest_front(), 6);
        assert_eq!(a.factor_entries(), 30);
        assert_eq!(
            Analysis::new(&Symmetric::new(0, []).unwrap(), &[], &[], None).largest_front(),
            0
        );
    }
}
