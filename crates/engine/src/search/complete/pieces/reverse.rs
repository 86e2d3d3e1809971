//! The reversed pencil B + sA, s = 1 / t: one expansion about a small s reaches from the highest
//! frequency of (A_ff, B_ff) to infinity, where those in t would have to follow one another for
//! ever.

use crate::search::complete::pieces::anchor::{COARSE, centers, expand};
use crate::search::complete::pieces::blocks::{Blocks, lowest_frequency};
use crate::search::complete::pieces::view::Expansion;
use crate::search::complete::tree::short;
use mceip_check::certificate::Anchor;
use mceip_exact::{Rational, to_f64};
use mceip_model::Pencil;

/// A reversed anchor and the value from which it is used.
pub(crate) struct Beyond {
    pub(crate) anchor: Anchor,
    pub(crate) expansion: Expansion,
    pub(crate) from: Rational,
}

/// The pencil with its matrices exchanged.
pub(crate) fn swapped(pencil: &Pencil) -> Option<Pencil> {
    Pencil::new(
        pencil.b().clone(),
        pencil.a().clone(),
        pencil.free().to_vec(),
    )
    .ok()
}

/// Needs B_ff >= tau I with tau > 0; `bounds` are sigma (of A_ff) and tau.
pub(crate) fn beyond(pencil: &Pencil, [sigma, tau]: [&Rational; 2]) -> Option<Beyond> {
    let bounds = [to_f64(tau), to_f64(sigma)];
    if bounds[0] <= 0.0 {
        return None;
    }
    let swapped = swapped(pencil)?;
    let blocks = Blocks::of(&swapped);
    let base = lowest_frequency(&blocks, &blocks.stiffness.cholesky()?);
    let (list, ends) = centers(base, 0.0, f64::MIN_POSITIVE);
    let (center, end) = (list.first()?, ends.first()?);
    let from = short(1.0 / end, 0.05 / end)?;
    let (anchor, expansion) = expand(&swapped, &blocks, center, bounds, COARSE)?;
    Some(Beyond {
        anchor: Anchor {
            reversed: true,
            ..anchor
        },
        expansion: Expansion {
            reversed: true,
            ..expansion
        },
        from,
    })
}
