//! Anchors that reach further than others, where a wide remainder does no harm.
//!
//! Far from solutions, above all at large values, sym(T) is definite by a wide margin: the regions
//! there are closed without a branch. An anchor may then be used up to [`WIDE_REACH`] of center +
//! lowest frequency, where the remainder of its Taylor polynomials is some per cent of T, and half
//! as many anchors suffice. Each of them costs memory and time of search, file and check.
//!
//! From the upper end of the window downwards an anchor of wide reach is expanded, and sym(T) is
//! tested over its interval. Where the test fails first, ordinary anchors take over.
//!
//! Called by `condense`.

use super::anchor::{Center, ExpandedAnchor, FreeElimination, Precision, center_below};
use super::expansion::Expansion;
use crate::search::complete::leaf::definite::holds_at_both_ends;
use mceip_check::certificate::VariableState;
use mceip_exact::to_f64;
use mceip_model::Pencil;

/// Distance from a centre up to which it is used, relative to center + lowest frequency.
///
/// Measured on L-shaped bodies of 2,416 and 9,440 degrees of freedom without a solution: with 0.5
/// the test holds down to lambda^2 = 0, with 0.6 not even over the first interval.
const WIDE_REACH: f64 = 0.5;

/// Parts of the interval of an anchor over which sym(T) is tested: as many as the search begins
/// with.
const PARTS: usize = 4;

/// Anchors at most.
const MOST: usize = 32;

/// Anchors next to the upper end of a window.
pub(crate) struct WideAnchors {
    /// By ascending centres, each with the upper end of its interval.
    pub(crate) anchors: Vec<(ExpandedAnchor, f64)>,
    /// Where the interval of the lowest one begins; the upper end of the window where there is
    /// none.
    pub(crate) from: f64,
}

impl WideAnchors {
    /// No anchor below the upper end of a window.
    pub(crate) fn none(top: f64) -> WideAnchors {
        WideAnchors {
            anchors: Vec::new(),
            from: top,
        }
    }
}

/// The search for such anchors.
pub(crate) struct DefiniteAnchors<'a> {
    pub(crate) elimination: &'a FreeElimination<'a>,
    pub(crate) lowest_frequency: f64,
    pub(crate) precision: Precision,
}

impl DefiniteAnchors<'_> {
    /// Anchors of wide reach that cover an interval below `top`, down to `low` at most. There
    /// sym(T) is definite for `pencil`, one of the same family as the one that is expanded.
    ///
    /// There are none if `pencil` has other free variables: those of particles with zero reaction
    /// are free in a tail, and both halves of their slip are variables of T, which is not definite.
    pub(crate) fn anchors(&self, pencil: &Pencil, low: f64, top: f64) -> WideAnchors {
        if pencil.free() != self.elimination.pencil.free() {
            return WideAnchors::none(top);
        }

        let is_own = std::ptr::eq(pencil, self.elimination.pencil);
        let other = (!is_own).then(|| FreeElimination::new(pencil, self.elimination.bounds));

        let mut wide = WideAnchors::none(top);
        while wide.from > low && wide.anchors.len() < MOST {
            let center = center_below(wide.from, self.lowest_frequency, WIDE_REACH);
            let begin = self.begin_of(&center).max(low);
            let Some(expanded) = self.definite_anchor(&center, begin, other.as_ref()) else {
                break;
            };

            wide.anchors.push((expanded, wide.from));
            wide.from = begin;
        }

        wide.anchors.reverse();
        wide
    }

    /// Where the interval of a centre begins.
    fn begin_of(&self, center: &Center) -> f64 {
        let at = to_f64(&center.at);
        at - WIDE_REACH * (at + self.lowest_frequency)
    }

    /// The anchor about a centre, if sym(T) is definite from `begin` to the end of its interval.
    fn definite_anchor(
        &self,
        center: &Center,
        begin: f64,
        other: Option<&FreeElimination<'_>>,
    ) -> Option<ExpandedAnchor> {
        let expanded = self.elimination.expand(&center.at, self.precision)?;
        let is_definite = match other {
            None => self.is_definite(&expanded.expansion, begin, center.end),
            Some(other) => {
                let beside = other.expand_beside(&expanded.anchor)?;
                self.is_definite(&beside.expansion, begin, center.end)
            }
        };

        is_definite.then_some(expanded)
    }

    /// Is sym(T) positive definite over each part of [begin, end]?
    fn is_definite(&self, expansion: &Expansion, begin: f64, end: f64) -> bool {
        let states = vec![VariableState::Undecided; expansion.order()];
        let ones = vec![1.0; states.len()];
        let lowest = begin + self.lowest_frequency;
        let ratio = (end + self.lowest_frequency) / lowest;
        let cut = |part: usize| {
            let power = part as f64 / PARTS as f64;
            lowest * ratio.powf(power) - self.lowest_frequency
        };

        (0..PARTS).all(|part| {
            let lo = cut(part).max(0.0);
            let ends = expansion.ends(lo, cut(part + 1));
            holds_at_both_ends(&ends, &states, &ones)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::anchor::{COARSE, SpectrumBounds};
    use super::*;
    use mceip_exact::Sparse;

    /// One variable is free, F = 1 + t, and one slips: T(t) = entry + t - 1 / (1 + t).
    fn wide(entry: i64, low: f64, top: f64) -> WideAnchors {
        let a = Sparse::from_ints(&[&[1, 1], &[1, entry]]);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![0]).unwrap();
        let bounds = SpectrumBounds {
            sigma: 1.0,
            tau: 1.0,
        };
        let elimination = FreeElimination::new(&pencil, bounds);
        let definite = DefiniteAnchors {
            elimination: &elimination,
            lowest_frequency: 1.0,
            precision: COARSE,
        };

        let wide = definite.anchors(&pencil, low, top);
        let mut begin = wide.from;
        for (_, end) in &wide.anchors {
            assert!(*end > begin);
            begin = *end;
        }
        assert_eq!(begin, top);
        wide
    }

    #[test]
    fn anchors_reach_down_to_the_lower_end_where_all_is_definite() {
        let wide = wide(9, 0.0, 100.0);

        assert_eq!(wide.from, 0.0);
        // (1 + 0.5) / (1 - 0.5) times as far from -1 each: 101 / 3^4 > 1, 101 / 3^5 < 1.
        assert_eq!(wide.anchors.len(), 5);
    }

    /// T = t - 3 - 1 / (1 + t) is not positive below t = 3.236.
    #[test]
    fn anchors_end_above_where_definiteness_ends() {
        let wide = wide(-3, 0.0, 1000.0);

        assert!(wide.from > 3.236, "{}", wide.from);
        assert!(!wide.anchors.is_empty());
    }

    #[test]
    fn there_are_none_where_nothing_is_definite() {
        let wide = wide(-3, 0.0, 3.0);

        assert_eq!((wide.from, wide.anchors.len()), (3.0, 0));
    }
}
