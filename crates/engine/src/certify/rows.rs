//! The rows of a pencil over the integers, and the variables that are active on a support.

use mceip_exact::{Integer, common_denominator};
use mceip_model::Pencil;
use std::collections::BTreeMap;

/// Rows of the pencil with denominators cleared: (column, coefficient of A, coefficient of B).
pub(super) struct IntegralRows(pub(super) Vec<Vec<(usize, Integer, Integer)>>);

impl IntegralRows {
    pub(super) fn of(pencil: &Pencil) -> Self {
        let row = |i: usize| {
            let (a, b) = (pencil.a().row(i), pencil.b().row(i));
            let factor = common_denominator(a.iter().chain(b).map(|e| &e.1));
            let mut merged: BTreeMap<usize, (Integer, Integer)> = BTreeMap::new();
            for (j, v) in a {
                merged.entry(*j).or_default().0 = v.numer() * (&factor / v.denom());
            }
            for (j, v) in b {
                merged.entry(*j).or_default().1 = v.numer() * (&factor / v.denom());
            }
            merged.into_iter().map(|(j, (a, b))| (j, a, b)).collect()
        };
        IntegralRows((0..pencil.order()).map(row).collect())
    }

    /// Bits of the largest coefficient.
    pub(super) fn bits(&self) -> u64 {
        self.0
            .iter()
            .flatten()
            .map(|(_, a, b)| a.bits().max(b.bits()))
            .max()
            .unwrap_or(0)
    }
}

/// Free and slip variables, ascending.
pub(super) fn active(pencil: &Pencil, support: &[usize]) -> Vec<usize> {
    let mut list: Vec<usize> = pencil.free().iter().chain(support).copied().collect();
    list.sort_unstable();
    list
}
