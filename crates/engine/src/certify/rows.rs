//! The rows of a pencil A + tB over the integers, and the variables that are active on a support.
//!
//! Each row of (A, B) is multiplied by the common denominator of its entries. A positive factor of
//! a row changes neither the zeros nor the signs of y = (A + tB) x. Called by the makers of exact
//! and of enclosed claims.

use mceip_check::certificate::EnclosedSolution;
use mceip_exact::{Integer, Rational, cleared, common_denominator};
use mceip_model::{Pencil, ZeroVariables};
use num_traits::Zero;
use std::collections::BTreeMap;

/// One entry a + t b of a row.
#[derive(Debug, Clone)]
pub(super) struct PencilEntry {
    pub(super) column: usize,
    pub(super) a: Integer,
    pub(super) b: Integer,
}

impl PencilEntry {
    fn zero(column: usize) -> PencilEntry {
        PencilEntry {
            column,
            a: Integer::zero(),
            b: Integer::zero(),
        }
    }

    /// Bits of the longer coefficient.
    pub(super) fn bits(&self) -> u64 {
        self.a.bits().max(self.b.bits())
    }
}

/// All rows of a pencil, denominators cleared row by row, entries by column.
pub(super) struct IntegralRows {
    rows: Vec<Vec<PencilEntry>>,
    /// The variables of the particles in contact with zero reaction.
    zero: Vec<ZeroVariables>,
}

impl IntegralRows {
    pub(super) fn of(pencil: &Pencil) -> Self {
        let mut rows = Vec::new();
        for i in 0..pencil.order() {
            rows.push(integral_row(pencil.a().row(i), pencil.b().row(i)));
        }

        IntegralRows {
            rows,
            zero: Vec::new(),
        }
    }

    /// The rows of the split form of a system with these variables of z particles.
    pub(super) fn with_zero(self, zero: Vec<ZeroVariables>) -> Self {
        IntegralRows { zero, ..self }
    }

    /// The variables off a support whose rows vanish with those of the support.
    pub(super) fn vanishing(&self, support: &[usize]) -> Vec<usize> {
        let zero = self.zero.iter();
        zero.filter_map(|variables| variables.vanishing(support))
            .collect()
    }

    pub(super) fn row(&self, index: usize) -> &[PencilEntry] {
        &self.rows[index]
    }

    /// All rows, in their order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[PencilEntry]> {
        self.rows.iter().map(Vec::as_slice)
    }

    /// Bits of the longest coefficient.
    pub(super) fn bits(&self) -> u64 {
        let entries = self.rows.iter().flatten();
        entries.map(PencilEntry::bits).max().unwrap_or(0)
    }
}

/// A row of A and one of B as one row of integers.
fn integral_row(a: &[(usize, Rational)], b: &[(usize, Rational)]) -> Vec<PencilEntry> {
    let values = a.iter().chain(b).map(|(_, value)| value);
    let denominator = common_denominator(values);

    let mut entries: BTreeMap<usize, PencilEntry> = BTreeMap::new();
    for (column, value) in a {
        let entry = entries.entry(*column);
        let entry = entry.or_insert_with(|| PencilEntry::zero(*column));
        entry.a = cleared(value, &denominator);
    }

    for (column, value) in b {
        let entry = entries.entry(*column);
        let entry = entry.or_insert_with(|| PencilEntry::zero(*column));
        entry.b = cleared(value, &denominator);
    }

    entries.into_values().collect()
}

/// The active variables: free ones and those of the support, ascending.
pub(crate) fn active(pencil: &Pencil, support: &[usize]) -> Vec<usize> {
    let mut list: Vec<usize> = pencil.free().iter().chain(support).copied().collect();
    list.sort_unstable();
    list
}

/// x over all variables at the centre of a box.
pub(crate) fn center_of(pencil: &Pencil, claim: &EnclosedSolution) -> Vec<Rational> {
    let mut x = vec![Rational::zero(); pencil.order()];
    for (i, center) in active(pencil, &claim.support)
        .into_iter()
        .zip(&claim.center)
    {
        x[i] = center.0.clone();
    }

    x
}
