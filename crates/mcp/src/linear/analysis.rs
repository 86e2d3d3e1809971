//! The symbolic part of a sparse Cholesky factorisation: its fronts, from the pattern alone.
//!
//! Unknowns are eliminated in the order of a nested dissection (`dissection`). A *front* is the set
//! of the unknowns of one part, eliminated together in a dense matrix whose rows are these unknowns
//! and its *border*: the later ones that they touch, in the matrix or through what their children
//! have left.
//!
//! Each unknown is one of three: *eliminated*; *kept*, in which case it comes last and the
//! factorisation ends with a Schur complement over these; or *held* at zero and left out.
//!
//! Input: a symmetric matrix, of which the values play no part. Output: [`SymbolicAnalysis`], which
//! `multifrontal` factors matrices with.

use super::dissection::{DissectionNode, dissect};
use super::symmetric::Symmetric;
use std::mem::replace;

/// The place of an unknown that is held.
pub(super) const HELD: usize = usize::MAX;

/// Which unknowns are eliminated in which front. Serves every matrix with this pattern, or less.
#[derive(Debug, Clone)]
pub struct SymbolicAnalysis {
    /// Unknowns in the order of elimination, then those kept.
    pub(super) order: Vec<usize>,
    /// Place of each unknown in `order`; [`HELD`] for those held.
    pub(super) place: Vec<usize>,
    /// Number of unknowns eliminated.
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
    /// Number of places eliminated.
    pub(super) fn own(&self) -> usize {
        self.end - self.begin
    }

    /// Order of the dense matrix.
    pub(super) fn order(&self) -> usize {
        self.own() + self.border.len()
    }
}

impl SymbolicAnalysis {
    /// Unknowns in `kept` come last, in that order, and are not eliminated; those in `held` are
    /// left out (zero). `points`: positions of all unknowns in the plane, where known, make the
    /// fronts smaller. Indices beyond the order, and those that `held` names again, are ignored.
    pub fn new(
        matrix: &Symmetric,
        kept: &[usize],
        held: &[usize],
        points: Option<&[[f64; 2]]>,
    ) -> SymbolicAnalysis {
        let n = matrix.order();
        let columns: Vec<&[usize]> = (0..n).map(|i| matrix.columns(i)).collect();
        let points = points.filter(|points| points.len() == n);

        let mut is_eliminated = vec![true; n];
        for &unknown in kept.iter().chain(held) {
            if unknown < n {
                is_eliminated[unknown] = false;
            }
        }

        let parts = dissect(&columns, &is_eliminated, points);

        let mut order = Vec::new();
        for part in &parts {
            order.extend_from_slice(&part.own);
        }

        let eliminated = order.len();
        order.extend(kept_once(kept, held, n));

        let mut place = vec![HELD; n];
        for (k, &unknown) in order.iter().enumerate() {
            place[unknown] = k;
        }

        let fronts = fronts(matrix, &parts, &order, &place);
        SymbolicAnalysis {
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

/// The unknowns below `n` in `kept` that are not held, each once, in the order given.
fn kept_once(kept: &[usize], held: &[usize], n: usize) -> Vec<usize> {
    let mut is_done = vec![false; n];
    for &unknown in held {
        if unknown < n {
            is_done[unknown] = true;
        }
    }

    let mut list = Vec::new();
    for &unknown in kept {
        if unknown < n && !replace(&mut is_done[unknown], true) {
            list.push(unknown);
        }
    }
    list
}

/// The front of each part, whose places follow each other in the order of the parts.
fn fronts(
    matrix: &Symmetric,
    parts: &[DissectionNode],
    order: &[usize],
    place: &[usize],
) -> Vec<Front> {
    let mut fronts: Vec<Front> = Vec::with_capacity(parts.len());

    // The last front whose border a place was put on.
    let mut last_border = vec![usize::MAX; order.len()];
    let mut begin = 0;

    for (k, part) in parts.iter().enumerate() {
        let end = begin + part.own.len();

        let borders = part.children.iter().map(|&child| &fronts[child].border);
        let left_by_children = borders.flatten().copied();
        let columns = part.own.iter().flat_map(|&i| matrix.columns(i));
        let touched = columns.map(|&column| place[column]);

        let mut border = Vec::new();
        for later in left_by_children.chain(touched) {
            if later == HELD || later < end {
                continue;
            }

            if replace(&mut last_border[later], k) != k {
                border.push(later);
            }
        }

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
        let mut chain = Vec::new();
        for i in 0..7 {
            chain.push((i, i, 2.0));
            if i > 0 {
                chain.push((i, i - 1, -1.0));
                chain.push((i - 1, i, -1.0));
            }
        }

        let chain = Symmetric::new(7, chain).unwrap();

        let analysis = SymbolicAnalysis::new(&chain, &[3, 99, 3], &[0], None);
        assert_eq!(analysis.eliminated(), 5);
        assert_eq!(analysis.order.len(), 6);
        assert_eq!(analysis.order[5], 3);
        assert_eq!(analysis.place[0], HELD);
        assert_eq!(analysis.fronts.last().unwrap().border, [5]);
        assert_eq!(analysis.largest_front(), 6);
        assert_eq!(analysis.factor_entries(), 30);

        let nothing = Symmetric::new(0, []).unwrap();
        let analysis = SymbolicAnalysis::new(&nothing, &[], &[], None);
        assert_eq!(analysis.largest_front(), 0);
    }
}
