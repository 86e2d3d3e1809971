//! The reversed pencil B + sA, s = 1 / t.
//!
//! One expansion about a small s reaches from the highest frequency of (A_ff, B_ff) to infinity,
//! where expansions in t would have to follow one another for ever. It needs B_ff >= tau I with
//! tau > 0. Called by `condense`.

use super::anchor::{ExpandedAnchor, FreeElimination, Precision, SpectrumBounds, centers};
use super::expansion::Expansion;
use crate::search::complete::dyadic::short_near;
use mceip_check::certificate::Anchor;
use mceip_exact::Rational;
use mceip_model::{ModelError, Pencil};

/// A reversed anchor and the value from which it is used.
pub(crate) struct ReversedAnchor {
    pub(crate) expanded: ExpandedAnchor,
    pub(crate) from: Rational,
}

/// The pencil with its matrices exchanged.
pub(crate) fn exchanged(pencil: &Pencil) -> Result<Pencil, ModelError> {
    let free = pencil.free().to_vec();
    Pencil::new(pencil.b().clone(), pencil.a().clone(), free)
}

/// The reversed anchor of a pencil; `None` unless B_ff is positive definite.
pub(crate) fn beyond(
    pencil: &Pencil,
    bounds: SpectrumBounds,
    precision: Precision,
) -> Option<ReversedAnchor> {
    if bounds.tau <= 0.0 {
        return None;
    }

    let exchanged = exchanged(pencil).ok()?;
    let elimination = FreeElimination::new(&exchanged, bounds.exchanged());
    let blocks = &elimination.blocks;
    let lowest = blocks.lowest_frequency(&blocks.factor_at(0.0)?);
    let only_first = centers(lowest, 0.0, f64::MIN_POSITIVE);
    let center = only_first.first()?;
    let from = short_near(1.0 / center.end, 0.05 / center.end)?;

    let expanded = elimination.expand(&center.at, precision)?;
    Some(ReversedAnchor {
        expanded: ExpandedAnchor {
            anchor: Anchor {
                reversed: true,
                ..expanded.anchor
            },
            expansion: Expansion {
                reversed: true,
                ..expanded.expansion
            },
        },
        from,
    })
}
