//! Follows a curve t(mu) of solutions in mu, and proves it piece by piece.
//!
//! A stretch [low, high] of mu gets a box of lambda^2 around the curve and the witness of its
//! middle. Where the witness does not hold the stretch is halved, where it does the next one is
//! twice as long. What is shorter than the least stretch is left out: where x_i or y_i reaches 0
//! and the curve goes on with another support, and where the expansion of T is not precise enough.
//!
//! Input: a solution in doubles, and the mu to go to. Output: [`Followed`], whose stretches the
//! checker decides about. Called by `mod.rs`.

use super::curve::Curves;
use super::witness::{CurveBox, PresenceWitness};
use crate::branch::{BranchPencils, BranchPoint, BranchUnknown, Slice};
use crate::run::Watch;
use crate::search::complete::pieces::expansion::Expansion;
use crate::tolerance::LEAST_STRETCH;
use mceip_check::certificate::PresencePiece;

/// Stretches tried on one curve at most.
const MAX_ATTEMPTS: usize = 2000;

/// Interruptions of one curve, at most.
const MAX_INTERRUPTIONS: usize = 60;

/// Lengths that are left out one after the other in one interruption, at most.
const MAX_SKIPS: usize = 8;

/// Factor between these lengths.
const LONGER_SKIP: f64 = 4.0;

/// Supports tried one after the other where one ends.
const MAX_SUPPORTS: usize = 8;

/// How far a box reaches beyond the curve in it: shares of the extent of the curve, or of
/// [`FLAT`] where that is less.
const BEYOND_CURVE: [f64; 3] = [0.5, 0.15, 1.5];

/// Least extent of a curve in lambda^2 for its box. Unit: lambda^2 + its scale, times the relative
/// length of the stretch.
const FLAT: f64 = 0.1;

/// Ends of stretches and boxes are multiples of a power of two at most this share of their width.
const UNIT_OF_WIDTH: f64 = 0.1;

/// An interval of mu with the piece that proves it.
#[derive(Debug, Clone)]
pub(super) struct PresenceStretch {
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) piece: PresencePiece,
}

/// What is followed.
#[derive(Clone, Copy)]
pub(super) struct Climb<'a> {
    pub(super) curves: Curves<'a>,
    pub(super) watch: Watch<'a>,
}

/// What is proved of a curve.
#[derive(Debug, Default)]
pub(super) struct Followed {
    /// In the order followed.
    pub(super) stretches: Vec<PresenceStretch>,
    /// Values of lambda^2 at which a piece fails although the support does not change: probably
    /// because condensation is not precise enough there.
    pub(super) imprecise: Vec<f64>,
}

/// The next point of a curve.
struct ClimbedPoint {
    point: BranchPoint,
    /// The proof on the way there, if one was asked for.
    stretch: Option<PresenceStretch>,
}

impl Climb<'_> {
    /// Follows a curve to a mu, with proofs.
    pub(super) fn prove(&self, start: &BranchPoint, target: f64) -> Followed {
        let mut followed = Followed::default();
        self.follow(start, target, Some(&mut followed));
        followed
    }

    /// Follows a curve to a mu; `None` where it ends before.
    pub(super) fn walk(&self, start: &BranchPoint, target: f64) -> Option<BranchPoint> {
        self.follow(start, target, None)
    }

    /// The way of both: with a record, each step is proved and written into it.
    fn follow(
        &self,
        start: &BranchPoint,
        target: f64,
        mut record: Option<&mut Followed>,
    ) -> Option<BranchPoint> {
        let mut here = start.clone();
        let mut step = target - here.mu;
        let mut interruptions = 0;
        let mut skips = 0;
        for _ in 0..MAX_ATTEMPTS {
            if here.mu == target {
                return Some(here);
            }

            if self.watch.is_cancelled() {
                return None;
            }

            let mu = short_end(here.mu, step, target);
            if let Some(reached) = self.attempt(&here, mu, record.is_some()) {
                if let Some(followed) = &mut record {
                    followed.stretches.extend(reached.stretch);
                }
                here = reached.point;
                step *= 2.0;
                skips = 0;
                continue;
            }

            let least = LEAST_STRETCH * here.mu;
            if step.abs() > least {
                step *= 0.5;
                continue;
            }

            let is_new_interruption = skips == 0;
            interruptions += usize::from(is_new_interruption);
            if skips == MAX_SKIPS || interruptions > MAX_INTERRUPTIONS {
                return None;
            }

            let aside = (least * LONGER_SKIP.powi(skips as i32)).copysign(step);
            skips += 1;
            let resumed_at = short_end(here.mu, aside, target);
            if let Some(next) = self.skip(&here, resumed_at) {
                if let Some(followed) = &mut record
                    && is_new_interruption
                    && next.support == here.support
                {
                    followed.imprecise.push(here.t);
                }
                here = next;
                step = 2.0 * aside;
            }
        }

        None
    }

    /// The curve from a point to a mu; `None` where that is not reached, or not proved.
    fn attempt(&self, here: &BranchPoint, mu: f64, is_proving: bool) -> Option<ClimbedPoint> {
        let is_regular = |point: &BranchPoint| point.violated.is_none();
        let point = self.curves.at_friction(mu, here).filter(is_regular)?;

        let stretch = if is_proving {
            Some(self.stretch(here, &point)?)
        } else {
            None
        };
        Some(ClimbedPoint { point, stretch })
    }

    /// A point beyond a place that is left out, on this support or another.
    fn skip(&self, here: &BranchPoint, mu: f64) -> Option<BranchPoint> {
        let mut point = self.curves.at_friction(mu, here)?;
        for _ in 1..MAX_SUPPORTS {
            let Some(position) = point.violated else {
                return Some(point);
            };
            let place = [point.t, mu];
            point = self
                .curves
                .beyond(BranchUnknown::Lambda2, place, &point, position)?;
        }

        point.violated.is_none().then_some(point)
    }

    /// The proof between two points of a curve.
    fn stretch(&self, one: &BranchPoint, other: &BranchPoint) -> Option<PresenceStretch> {
        let [below, above] = if one.mu < other.mu {
            [one, other]
        } else {
            [other, one]
        };
        let middle = self
            .curves
            .at_friction(0.5 * (below.mu + above.mu), below)?;
        if middle.violated.is_some() {
            return None;
        }

        let matrix = self.curves.at(middle.t)?.matrix(middle.mu);
        let witness = PresenceWitness::of(&matrix, &middle)?;
        let anchor = self.curves.family.anchor(middle.t);
        let expansions = self.curves.expansions(middle.t);
        let index = &self.curves.family.view().index;

        let ends = self.ends([below, &middle, above], expansions);
        for share in BEYOND_CURVE {
            let t = beyond_curve(ends, share);
            if expansions[0].reversed && t[0] <= 0.0 {
                continue;
            }

            let mu = [below.mu, above.mu];
            if let Some(piece) = witness.piece(&CurveBox { t, mu }, expansions, index) {
                return Some(PresenceStretch {
                    low: below.mu,
                    high: above.mu,
                    piece: PresencePiece { anchor, ..piece },
                });
            }
        }

        None
    }

    /// The least and the largest lambda^2 of three points of a curve, apart by [`FLAT`] at least,
    /// and by what the curves of members may be off.
    fn ends(
        &self,
        [below, middle, above]: [&BranchPoint; 3],
        expansions: &[Expansion; 2],
    ) -> [f64; 2] {
        let lowest = below.t.min(middle.t).min(above.t);
        let highest = below.t.max(middle.t).max(above.t);

        let relative_length = (above.mu - below.mu) / middle.mu;
        let flat = FLAT * (middle.t + self.curves.unit()) * relative_length;
        let spread = [below, above].map(|point| spread_of_t(point, expansions));
        let flat = flat.max(2.0 * spread[0].max(spread[1]));
        let missing = (flat - (highest - lowest)).max(0.0);
        [lowest - 0.5 * missing, highest + 0.5 * missing]
    }
}

/// How far from a point of a curve those of members are in lambda^2, to first order; 0 where the
/// data are exact.
fn spread_of_t(point: &BranchPoint, expansions: &[Expansion; 2]) -> f64 {
    if expansions[0].spread.is_none() {
        return 0.0;
    }

    (point.spread_of_null_vector(expansions) / point.of_t).abs()
}

/// An interval of lambda^2 that reaches beyond the ends of a curve by a share of their distance.
fn beyond_curve([lowest, highest]: [f64; 2], share: f64) -> [f64; 2] {
    let reach = share * (highest - lowest);
    let slack = UNIT_OF_WIDTH * reach;
    [
        short_multiple(lowest - reach, slack).max(0.0),
        short_multiple(highest + reach, slack),
    ]
}

/// A mu about one step further, short, or the target where that is near.
fn short_end(mu: f64, step: f64, target: f64) -> f64 {
    let is_near_target = (target - mu).abs() <= 1.25 * step.abs();
    if is_near_target {
        return target;
    }

    short_multiple(mu + step, UNIT_OF_WIDTH * step.abs())
}

/// The multiple of a power of two next to a number: within `slack` of it.
pub(super) fn short_multiple(target: f64, slack: f64) -> f64 {
    let unit = slack.log2().floor().exp2();
    let multiple = (target / unit).round() * unit;
    if multiple.is_finite() {
        multiple
    } else {
        target
    }
}
