//! Elimination of the free variables: the condensation of the certificate, and the view it gives.
//!
//! A condensation proves sym(A_ff) >= sigma I and sym(B_ff) >= tau I by rounded Cholesky factors,
//! and has an anchor (`anchor`) for each part of the window. Above the last anchor of an infinite
//! window stands either a tail (`leaf::tail`: no solution lies there) or a reversed anchor
//! (`reverse`), whichever begins lower.
//!
//! Input: a pencil with free variables, sym(A_ff) positive definite, sym(B_ff) positive
//! semidefinite. Called by `prepared`. The checker's side is `check::cover::condensed`.

use super::anchor::{
    Beside, CONSTANT, ExpandedAnchor, FreeElimination, Precision, Precisions, SpectrumBounds,
    centers, columns_of_all,
};
use super::blocks::PencilBlocks;
use super::expansion::Expansion;
use super::massless;
use super::reverse::{ReversedAnchor, beyond, exchanged};
use super::skyline::Skyline;
use super::view::{View, scale_of};
use super::wide::{DefiniteAnchors, WideAnchors};
use crate::magnitude::has_square_in_doubles;
use crate::search::complete::dyadic::{multiple_near, short_below};
use crate::search::complete::error::CompleteError;
use crate::search::complete::leaf::tail::tail;
use mceip_check::certificate::{Anchor, Condensation, Factor, Tail};
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Window};
use rayon::prelude::*;

/// Share of an estimated lower bound of a spectrum that is claimed; the rest is slack for rounding.
const CLAIMED: f64 = 0.8;
const SLACK: f64 = 0.2;

/// Bits of the centre of an anchor about a solution, whose own anchor is to be precise there.
const BITS_OF_FINE_CENTER: i32 = 20;

/// The condensation, its view and the interval of each anchor.
pub(crate) struct Condensed {
    pub(crate) condensation: Condensation,
    pub(crate) view: View,
    /// Upper end of each anchor's interval, without the reversed one; the last one is open.
    pub(crate) ends: Vec<f64>,
    /// Smallest eigenvalue of (A_ff, B_ff); zero where F does not depend on the unknown.
    pub(crate) lowest_frequency: f64,
    /// From where the reversed anchor, the last one, is used; up to infinity.
    pub(crate) beyond: Option<Rational>,
}

/// The pencils of which definiteness is proved: where the data have radii, what is at most each
/// member.
#[derive(Clone, Copy)]
pub(crate) struct DefinitePencils<'a> {
    /// Its free blocks are bounded from below.
    pub(crate) free: &'a Pencil,
    /// Its symmetric part makes a tail.
    pub(crate) whole: &'a Pencil,
}

impl<'a> DefinitePencils<'a> {
    /// The pencil itself.
    pub(crate) fn own(pencil: &'a Pencil) -> DefinitePencils<'a> {
        DefinitePencils {
            free: pencil,
            whole: pencil,
        }
    }
}

/// Condenses a pencil with free variables.
///
/// # Errors
/// [`CompleteError::NotDefinite`] where the symmetric part of A_ff is not positive definite (in
/// doubles) or that of B_ff is indefinite.
///
/// `definite` are this pencil, or others of a family with the same free rows. `precisions` are
/// those of the anchors.
pub(crate) fn condense(
    pencil: &Pencil,
    window: &Window,
    definite: DefinitePencils<'_>,
    precisions: Precisions,
) -> Result<Condensed, CompleteError> {
    let blocks = PencilBlocks::of(pencil);

    // The bounds of A_ff and B_ff.
    let first_free = blocks.free[0];
    let given_stiffness = definite.free.a().submatrix(&blocks.free, &blocks.free);
    let others = (!std::ptr::eq(definite.free, pencil)).then(|| PencilBlocks::of(definite.free));
    let bounded = others.as_ref().unwrap_or(&blocks);
    let stiffness = stiffness_bound(bounded);
    let stiffness =
        stiffness.ok_or_else(|| without_bound("A_ff", &given_stiffness, &blocks.free))?;
    let given_mass = definite.free.b().submatrix(&blocks.free, &blocks.free);
    let mass = mass_bound(&bounded.mass, &given_mass);
    let mass = mass.ok_or_else(|| without_bound("B_ff", &given_mass, &blocks.free))?;
    let elimination = FreeElimination {
        pencil,
        blocks,
        bounds: SpectrumBounds {
            sigma: to_f64(&stiffness.sigma),
            tau: to_f64(&mass.tau),
        },
    };
    let blocks = &elimination.blocks;

    // What stands above the anchors, and where it begins.
    let above = if window.max().is_none() && !blocks.mass_is_zero {
        Above::of(
            pencil,
            definite.whole,
            elimination.bounds,
            precisions.beyond,
        )
    } else {
        Above::Nothing
    };

    let top = above
        .begin()
        .or(window.max().map(to_f64))
        .unwrap_or(f64::INFINITY);

    let lowest_frequency = if blocks.mass_is_zero {
        0.0
    } else {
        let factor = blocks.factor_at(0.0).ok_or(CompleteError::NotDefinite {
            what: "A_ff",
            index: first_free,
        })?;
        blocks.lowest_frequency(&factor)
    };

    // An anchor for each part of the window below that.
    let precision = if blocks.mass_is_zero {
        CONSTANT
    } else {
        precisions.coarse
    };

    let low = to_f64(window.min());
    let wide = if lowest_frequency > 0.0 && top.is_finite() {
        let all_definite = DefiniteAnchors {
            elimination: &elimination,
            lowest_frequency,
            precision,
        };
        all_definite.anchors(definite.whole, low, top)
    } else {
        WideAnchors::none(top)
    };

    let mut anchors = ExpandedAnchors::default();
    let mut ends = Vec::new();
    if wide.anchors.is_empty() || wide.from > low {
        let centers = centers(lowest_frequency, low, wide.from);
        let expanded = centers
            .par_iter()
            .map(|center| elimination.expand(&center.at, precision));
        let expanded: Vec<Option<ExpandedAnchor>> = expanded.collect();
        for (center, expanded) in centers.iter().zip(expanded) {
            anchors.push(expanded.ok_or(CompleteError::NotDefinite {
                what: "A_ff + t B_ff",
                index: first_free,
            })?);
            ends.push(center.end);
        }
    }

    let has_wide = !wide.anchors.is_empty();
    if let Some(end) = ends.last_mut().filter(|_| has_wide) {
        *end = wide.from;
    }

    for (expanded, end) in wide.anchors {
        anchors.push(expanded);
        ends.push(end);
    }

    let mut tail = None;
    let mut beyond = None;
    match above {
        Above::Nothing => {}
        Above::Tail(found) => tail = Some(found),
        Above::Reversed(reversed) => {
            anchors.push(reversed.expanded);
            beyond = Some(reversed.from);
        }
    }

    let condensation = Condensation {
        sigma: Number(stiffness.sigma),
        stiffness_factor: stiffness.factor,
        mass_sigma: Number(mass.tau),
        mass_factor: mass.factor,
        anchors: anchors.certificate,
        tail,
    };

    let view = View {
        scale: scale_of(&anchors.expansions[0].coefficients),
        expansions: anchors.expansions,
        index: elimination.blocks.slip,
        zero: Vec::new(),
    };

    Ok(Condensed {
        condensation,
        view,
        ends,
        lowest_frequency,
        beyond,
    })
}

/// The anchors of a condensation and what they expand to, in the same order.
#[derive(Default)]
struct ExpandedAnchors {
    certificate: Vec<Anchor>,
    expansions: Vec<Expansion>,
}

impl ExpandedAnchors {
    fn push(&mut self, expanded: ExpandedAnchor) {
        self.certificate.push(expanded.anchor);
        self.expansions.push(expanded.expansion);
    }
}

/// What stands above the anchors of an infinite window.
enum Above {
    Nothing,
    Tail(Tail),
    Reversed(Box<ReversedAnchor>),
}

impl Above {
    /// The tail, or the reversed anchor where that begins lower.
    fn of(
        pencil: &Pencil,
        definite_above: &Pencil,
        bounds: SpectrumBounds,
        precision: Precision,
    ) -> Above {
        let tail = tail(definite_above);
        let beyond = beyond(pencil, bounds, precision);
        match (tail, beyond) {
            (Some(tail), Some(beyond)) if to_f64(&tail.from.0) > to_f64(&beyond.from) => {
                Above::Reversed(Box::new(beyond))
            }
            (Some(tail), _) => Above::Tail(tail),
            (None, Some(beyond)) => Above::Reversed(Box::new(beyond)),
            (None, None) => Above::Nothing,
        }
    }

    fn begin(&self) -> Option<f64> {
        match self {
            Above::Nothing => None,
            Above::Tail(tail) => Some(to_f64(&tail.from.0)),
            Above::Reversed(beyond) => Some(to_f64(&beyond.from)),
        }
    }
}

/// Why a free block has no bound: its entries are beyond what doubles carry, or it is indefinite.
fn without_bound(what: &'static str, block: &Sparse, free: &[usize]) -> CompleteError {
    let mut entries = block.entries();
    match entries.find(|(_, _, v)| !has_square_in_doubles(to_f64(v))) {
        Some((row, _, _)) => CompleteError::Hypothesis {
            expected: "A_ff and B_ff with entries between 10^-150 and 10^150",
            row,
        },
        None => CompleteError::NotDefinite {
            what,
            index: free[0],
        },
    }
}

/// sym(A_ff) >= sigma I and its evidence.
pub(crate) struct StiffnessBound {
    pub(crate) sigma: Rational,
    pub(crate) factor: Factor,
}

/// The bound of sym(A_ff); `None` where it is not definite in doubles.
pub(crate) fn stiffness_bound(blocks: &PencilBlocks) -> Option<StiffnessBound> {
    let bound = blocks.stiffness.below_spectrum()?;
    let sigma = short_below(CLAIMED * bound)?;
    let factor = factor_above(&blocks.stiffness, &sigma, SLACK * bound)?;
    Some(StiffnessBound { sigma, factor })
}

/// sym(B_ff) >= tau I and its evidence.
pub(crate) struct MassBound {
    pub(crate) tau: Rational,
    /// `None` where the block is a non-negative diagonal.
    pub(crate) factor: Option<Factor>,
}

/// The bound of B_ff, which is `given` and in skyline form `mass`; `None` where it is indefinite.
pub(crate) fn mass_bound(mass: &Skyline, given: &Sparse) -> Option<MassBound> {
    if mass.is_diagonal() {
        let tau = short_below(mass.smallest_diagonal()).unwrap_or_default();
        return Some(MassBound { tau, factor: None });
    }

    // Without mass in some rows the bound is zero.
    let Some(bound) = mass.below_spectrum() else {
        return Some(MassBound {
            tau: Rational::default(),
            factor: Some(massless::factor(given)?),
        });
    };

    let tau = short_below(CLAIMED * bound)?;
    let factor = factor_above(mass, &tau, SLACK * bound)?;
    Some(MassBound {
        tau,
        factor: Some(factor),
    })
}

/// The rounded Cholesky factor of S - (bound + slack) I: what proves S >= bound I.
fn factor_above(s: &Skyline, bound: &Rational, slack: f64) -> Option<Factor> {
    let factor = s.shifted(-to_f64(bound) - slack).cholesky()?;
    Some(factor.rounded(slack))
}

/// The bounds that a condensation proves, in doubles.
pub(crate) fn bounds_of(condensation: &Condensation) -> SpectrumBounds {
    SpectrumBounds {
        sigma: to_f64(&condensation.sigma.0),
        tau: to_f64(&condensation.mass_sigma.0),
    }
}

/// Appends anchors of a `fine` precision about further values to a condensation and its view.
/// Values at which the expansion fails get none.
pub(crate) fn refine(
    pencil: &Pencil,
    condensation: &mut Condensation,
    view: &mut View,
    values: &[f64],
    fine: Precision,
) {
    let elimination = FreeElimination::new(pencil, bounds_of(condensation));
    for value in values {
        let Some(center) = fine_center(*value) else {
            continue;
        };

        if let Some(expanded) = elimination.expand(&center, fine) {
            condensation.anchors.push(expanded.anchor);
            view.expansions.push(expanded.expansion);
        }
    }
}

/// The center of the anchor about a value: a number of [`BITS_OF_FINE_CENTER`] bits next to it.
fn fine_center(value: f64) -> Option<Rational> {
    if value == 0.0 {
        return Some(Rational::default());
    }

    multiple_near(value, value * f64::from(-BITS_OF_FINE_CENTER).exp2())
}

/// The view that a certificate's condensation gives.
pub(crate) fn view_of(pencil: &Pencil, condensation: &Condensation) -> View {
    let bounds = bounds_of(condensation);
    let elimination = FreeElimination::new(pencil, bounds);
    let exchanged = exchanged(pencil).ok();
    let reversed = exchanged
        .as_ref()
        .map(|exchanged| FreeElimination::new(exchanged, bounds.exchanged()));

    let mut expansions = Vec::new();
    for anchor in &condensation.anchors {
        expansions.push(match &reversed {
            Some(reversed) if anchor.reversed => expansion_of(reversed, anchor),
            _ => expansion_of(&elimination, anchor),
        });
    }

    let scale = expansions
        .first()
        .map_or(1.0, |e| scale_of(&e.coefficients));
    View {
        index: elimination.blocks.slip,
        scale,
        expansions,
        zero: Vec::new(),
    }
}

/// V of another pencil that has the same free rows beside each anchor, and what they expand to;
/// `None` where F is not definite in doubles.
pub(crate) fn beside(pencil: &Pencil, condensation: &Condensation) -> Option<Vec<Beside>> {
    let bounds = bounds_of(condensation);
    let exchanged = exchanged(pencil).ok()?;
    let elimination = FreeElimination::new(pencil, bounds);
    let reversed = FreeElimination::new(&exchanged, bounds.exchanged());

    let beside = |anchor: &Anchor| {
        let elimination = if anchor.reversed {
            &reversed
        } else {
            &elimination
        };

        let mut beside = elimination.expand_beside(anchor)?;
        beside.expansion.reversed = anchor.reversed;
        Some(beside)
    };
    condensation.anchors.par_iter().map(beside).collect()
}

/// The expansion that an anchor of a certificate gives for the pencil that is eliminated.
fn expansion_of(elimination: &FreeElimination<'_>, anchor: &Anchor) -> Expansion {
    let width = elimination.blocks.slip.len();
    let center = to_f64(&anchor.center.0);
    let right = columns_of_all(&anchor.right, width);
    let left = columns_of_all(&anchor.left, width);
    Expansion {
        reversed: anchor.reversed,
        ..elimination.expansion(center, &right, &left)
    }
}
