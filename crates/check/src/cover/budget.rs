//! Budgets of work for a file: the sum of what its leaves cost may not exceed what its size allows.
//!
//! The limits are those of `spec/certificates.md`, Limits. They keep the time of the checker
//! bounded by a polynomial in the size of the file and of the problem. The budget for signs on
//! support leaves is in `sign_budget`.

use super::fault::CoverFault;
use crate::certificate::Piece;
use crate::pencil::Rows;
use num_traits::Zero;
use std::cell::Cell;

/// Orders cubed of definite leaves, summed over a file: without any node or entry, for each node,
/// and for each entry of the pencil. Elimination takes a third of the cube.
const DEFINITE_BASE: u64 = 1 << 26;
const DEFINITE_PER_NODE: u64 = 1 << 20;
const DEFINITE_PER_ENTRY: u64 = 1 << 16;

/// Products of machine words for the matrices of all regions of a file: without any node or entry,
/// for each node, and for each entry of the pencil.
const MATRIX_BASE: u64 = 1 << 30;
const MATRIX_PER_NODE: u64 = 1 << 22;
const MATRIX_PER_ENTRY: u64 = 1 << 16;

/// What an entry of such a matrix costs beside the products of its words.
const WORK_OF_AN_ENTRY: u64 = 1 << 8;

/// Products of machine words for the witnesses of presence of a file: without any piece, and for
/// each piece.
const PIECE_BASE: u64 = 1 << 30;
const PIECE_EACH: u64 = 1 << 26;

/// Bits of the expansions of the anchors that pieces name: without any number in the matrices of
/// the anchors, and for each.
const ANCHOR_BASE: u64 = 1 << 30;
const ANCHOR_PER_NUMBER: u64 = 1 << 12;

/// What is left for one kind of work, or of memory.
pub(super) struct WorkBudget {
    what: &'static str,
    left: Cell<u64>,
}

impl WorkBudget {
    /// What the definite leaves of a file may cost in all: the sum of the cubes of their orders.
    pub(super) fn of_definite_leaves(pencils: &[&Rows], nodes: u64) -> WorkBudget {
        let by_nodes = DEFINITE_PER_NODE.saturating_mul(nodes);
        let by_entries = DEFINITE_PER_ENTRY.saturating_mul(entries(pencils));
        WorkBudget::definite_leaves(
            DEFINITE_BASE
                .saturating_add(by_nodes)
                .saturating_add(by_entries),
        )
    }

    /// What the matrices of all regions of a file may cost: products of machine words.
    pub(super) fn of_matrices(pencils: &[&Rows], nodes: u64) -> WorkBudget {
        let by_nodes = MATRIX_PER_NODE.saturating_mul(nodes);
        let by_entries = MATRIX_PER_ENTRY.saturating_mul(entries(pencils));
        WorkBudget::matrices(
            MATRIX_BASE
                .saturating_add(by_nodes)
                .saturating_add(by_entries),
        )
    }

    /// What the witnesses of presence of a file may cost: products of machine words.
    pub(super) fn of_pieces(pieces: u64) -> WorkBudget {
        let by_pieces = PIECE_EACH.saturating_mul(pieces);
        WorkBudget {
            what: "pieces: products of words, left of the file's budget",
            left: Cell::new(PIECE_BASE.saturating_add(by_pieces)),
        }
    }

    /// What the expansions of a file's anchors may take: bits.
    pub(super) fn of_anchors(numbers: u64) -> WorkBudget {
        let by_numbers = ANCHOR_PER_NUMBER.saturating_mul(numbers);
        WorkBudget {
            what: "anchors: bits of expansions, left of the file's budget",
            left: Cell::new(ANCHOR_BASE.saturating_add(by_numbers)),
        }
    }

    pub(super) fn definite_leaves(left: u64) -> WorkBudget {
        WorkBudget {
            what: "definite leaves: order cubed, left of the file's budget",
            left: Cell::new(left),
        }
    }

    pub(super) fn matrices(left: u64) -> WorkBudget {
        WorkBudget {
            what: "matrices of regions: products of words, left of the file's budget",
            left: Cell::new(left),
        }
    }

    /// Takes `cost` from what is left.
    pub(super) fn spend(&self, cost: u64) -> Result<(), CoverFault> {
        let left = self.left.get();
        CoverFault::at_most(self.what, left, cost)?;
        self.left.set(left - cost);
        Ok(())
    }

    #[cfg(test)]
    pub(super) fn left(&self) -> u64 {
        self.left.get()
    }
}

/// What the entries of a matrix with so many rows cost: the products of words for each, and what
/// any number costs that is as short as may be.
pub(super) fn entries_work(order: usize, products: u64) -> u64 {
    let entries = (order as u64).saturating_mul(order as u64);
    entries.saturating_mul(products.saturating_add(WORK_OF_AN_ENTRY))
}

/// Entries of the integral rows for which A_ij or B_ij is not zero.
fn entries(pencils: &[&Rows]) -> u64 {
    let mut entries: u64 = 0;
    let rows = pencils.iter().flat_map(|pencil| &pencil.rows);
    for (_, a, b) in rows.flatten() {
        if !a.is_zero() || !b.is_zero() {
            entries += 1;
        }
    }

    entries
}

/// The number of nodes of all trees.
pub(super) fn nodes(pieces: &[Piece]) -> u64 {
    pieces.iter().map(|piece| piece.tree.len() as u64).sum()
}
