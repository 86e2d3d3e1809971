//! Budgets of work for a file: the sum of what its leaves cost may not exceed what its size allows.
//!
//! The limits are those of `spec/certificates.md`, Limits. They keep the time of the checker
//! bounded by a polynomial in the size of the file and of the problem. The budget for signs on
//! support leaves is in `sign_budget`.

use super::fault::CoverFault;
use crate::certificate::CompleteSet;
use crate::pencil::Rows;
use num_traits::Zero;
use std::cell::Cell;

/// Orders cubed of definite leaves, summed over a file: without any node or entry, for each node,
/// and for each entry of the pencil. Elimination takes a third of the cube.
const DEFINITE_BASE: u64 = 1 << 26;
const DEFINITE_PER_NODE: u64 = 1 << 20;
const DEFINITE_PER_ENTRY: u64 = 1 << 16;

/// Products of machine words for the matrices of all regions of a file: without any node, and for
/// each node.
const MATRIX_BASE: u64 = 1 << 30;
const MATRIX_PER_NODE: u64 = 1 << 24;

/// Products of machine words for the witnesses of presence of a file: without any piece, and for
/// each piece.
const PIECE_BASE: u64 = 1 << 30;
const PIECE_EACH: u64 = 1 << 26;

/// What is left for one kind of work.
pub(super) struct WorkBudget {
    what: &'static str,
    left: Cell<u64>,
}

impl WorkBudget {
    /// What the definite leaves of a file may cost in all: the sum of the cubes of their orders.
    pub(super) fn of_definite_leaves<'a>(
        pencils: impl IntoIterator<Item = &'a Rows>,
        nodes: u64,
    ) -> WorkBudget {
        let mut entries: u64 = 0;
        let rows = pencils.into_iter().flat_map(|pencil| &pencil.rows);
        for (_, a, b) in rows.flatten() {
            if !a.is_zero() || !b.is_zero() {
                entries += 1;
            }
        }

        let by_nodes = DEFINITE_PER_NODE.saturating_mul(nodes);
        let by_entries = DEFINITE_PER_ENTRY.saturating_mul(entries);
        WorkBudget::definite_leaves(
            DEFINITE_BASE
                .saturating_add(by_nodes)
                .saturating_add(by_entries),
        )
    }

    /// What the matrices of all regions of a file may cost: products of machine words.
    pub(super) fn of_matrices(nodes: u64) -> WorkBudget {
        let by_nodes = MATRIX_PER_NODE.saturating_mul(nodes);
        WorkBudget::matrices(MATRIX_BASE.saturating_add(by_nodes))
    }

    /// What the witnesses of presence of a file may cost: products of machine words.
    pub(super) fn of_pieces(pieces: u64) -> WorkBudget {
        let by_pieces = PIECE_EACH.saturating_mul(pieces);
        WorkBudget {
            what: "pieces: products of words, left of the file's budget",
            left: Cell::new(PIECE_BASE.saturating_add(by_pieces)),
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

/// The number of nodes of all trees.
pub(super) fn nodes(cover: &CompleteSet) -> u64 {
    cover
        .pieces
        .iter()
        .map(|piece| piece.tree.len() as u64)
        .sum()
}
