//! A solution for every mu of an interval: certificates of presence (`mceip-presence/1`).
//!
//! | file | what |
//! |---|---|
//! | `curve` | solutions of one support as a curve t(mu), in doubles |
//! | `climb` | follows a curve and proves it piece by piece |
//! | `witness` | Y, u and v of a box, and whether they hold in it |
//! | `intervals` | what the stretches of several curves cover together |
//!
//! Known solutions are followed in mu, first from just above the smallest of them. What is left
//! out on one curve, where a support changes or the curve ends, others may cover. Each maximal
//! interval becomes a certificate, and nothing is said before the checker has accepted it.
//!
//! Condensation may be too coarse for a piece where its curve goes on. A [`Prover`] notes such
//! values of lambda^2, and its caller may condense anew with anchors there.
//!
//! Input: a system, solutions in doubles, and the interval of mu that is asked. Output:
//! [`PresenceCertificate`]s. Called by `ranges`.

mod climb;
mod curve;
mod intervals;
mod witness;

use super::absence::{HalfLineFamily, PrecisePlace};
use super::critical::BranchStart;
use crate::branch::{BranchPencils, BranchPoint, BranchUnknown};
use crate::run::{Progress, Watch};
use crate::tolerance::{LEAST_INTERVAL, PRESENCE_NEAR, PRESENCE_START};
use climb::{Climb, Followed, PresenceStretch, short_multiple};
use curve::Curves;
use intervals::{Chain, chains, extent, gaps};
use mceip_check::certificate::PresenceCertificate;
use mceip_check::{Proved, Reason};
use mceip_exact::from_f64;
use mceip_model::Problem;

/// Solutions from which one gap is tried to be closed.
const STARTS_PER_GAP: usize = 6;

/// Halvings of the distance from the smallest solution at which its curve is met.
const NEAREST: i32 = 30;

/// Least distance of places about which condensation is made more precise: share of their reach.
const APART: f64 = 0.1;

/// Pieces that the checker may refuse before the rest is given up.
const MAX_REFUSED: usize = 8;

/// What the search rests on.
#[derive(Clone, Copy)]
pub(super) struct PresenceGround<'a> {
    /// MCEIP-lambda2 of the system: what certificates belong to.
    pub(super) problem: &'a Problem,
    pub(super) watch: Watch<'a>,
}

/// The search for intervals with a solution.
pub(super) struct Prover<'a> {
    ground: PresenceGround<'a>,
    family: HalfLineFamily,
    /// What doubles hold for proved.
    stretches: Vec<PresenceStretch>,
    /// Values of lambda^2 at which condensation was probably not precise enough.
    imprecise: Vec<f64>,
}

impl<'a> Prover<'a> {
    /// With the condensation that is to stand in the certificates.
    pub(super) fn new(ground: PresenceGround<'a>, family: HalfLineFamily) -> Prover<'a> {
        Prover {
            ground,
            family,
            stretches: Vec::new(),
            imprecise: Vec::new(),
        }
    }

    /// What it rests on.
    pub(super) fn ground(&self) -> PresenceGround<'a> {
        self.ground
    }

    /// Places about which a more precise condensation may prove more, [`APART`] at least.
    pub(super) fn imprecise_places(&self) -> Vec<PrecisePlace> {
        let mut values = self.imprecise.clone();
        values.sort_by(f64::total_cmp);

        let scale = self.family.view().scale;
        let mut places: Vec<PrecisePlace> = Vec::new();
        for lambda2 in values {
            let reach = PRESENCE_NEAR * (lambda2 + scale);
            let is_apart = |last: &PrecisePlace| lambda2 - last.lambda2 > APART * reach;
            if places.last().is_none_or(is_apart) {
                places.push(PrecisePlace {
                    lambda2,
                    near: PRESENCE_NEAR,
                });
            }
        }

        places
    }

    /// The part of [from, to] that no stretch covers, as a length.
    pub(super) fn uncovered(&self, from: f64, to: f64) -> f64 {
        let gaps = gaps(&self.stretches, from, to);
        gaps.iter().map(|[low, high]| high - low).sum()
    }

    /// Follows the solution of smallest mu upwards, on the sides of larger and of smaller lambda^2
    /// until one of them reaches the end.
    pub(super) fn climb_from(&mut self, smallest: &BranchStart, to: f64) {
        let from = smallest.mu * (1.0 + PRESENCE_START);
        let from = short_multiple(from, 0.5 * PRESENCE_START * smallest.mu);
        for side in [1.0, -1.0] {
            let Some(start) = self.beside(smallest, side, from) else {
                continue;
            };

            let followed = self.climb().prove(&start, to);
            self.keep(followed);
            if gaps(&self.stretches, from, to).len() <= 1 && self.is_covered_at(to) {
                return;
            }
        }
    }

    /// Follows the curves of the solution of smallest mu from a mu above it as far as `to`, and
    /// from the first mu that is proved back towards that solution.
    pub(super) fn climb_about(&mut self, smallest: &BranchStart, from: f64, to: f64) {
        let from = short_multiple(from, 0.5 * PRESENCE_START * smallest.mu);
        for side in [1.0, -1.0] {
            let Some(start) = self.beside(smallest, side, from) else {
                continue;
            };

            let climb = self.climb();
            let upwards = climb.prove(&start, to);
            let first = upwards.stretches.first().map(|stretch| stretch.low);
            let back = first.and_then(|low| climb.walk(&start, low));
            let downwards = back.map(|point| climb.prove(&point, smallest.mu));
            self.keep(upwards);
            downwards
                .into_iter()
                .for_each(|followed| self.keep(followed));
        }
    }

    /// The solution of smallest mu, on the curve that a guess is near.
    pub(super) fn smallest(&self, guess: &BranchStart) -> Option<BranchPoint> {
        let place = [guess.lambda2, guess.mu];
        let curves = self.climb().curves;
        curves.near(BranchUnknown::Friction, place, &guess.x)
    }

    /// The condensation.
    pub(super) fn family(&self) -> &HalfLineFamily {
        &self.family
    }

    /// Closes what gaps it can in [from, to] from these solutions.
    pub(super) fn close(&mut self, from: f64, to: f64, starts: &[BranchStart]) -> bool {
        let before = self.stretches.len();
        for gap in gaps(&self.stretches, from, to) {
            self.close_gap(gap, starts);
        }

        self.stretches.len() > before
    }

    /// Is this mu in a stretch that doubles hold for proved?
    fn is_covered_at(&self, mu: f64) -> bool {
        let mut stretches = self.stretches.iter();
        stretches.any(|stretch| stretch.low <= mu && mu <= stretch.high)
    }

    fn climb(&self) -> Climb<'_> {
        Climb {
            curves: Curves {
                family: &self.family,
            },
            watch: self.ground.watch,
        }
    }

    /// The point of a curve at a mu, just above that of its solution of smallest mu, where the
    /// curve may be vertical: it is met at larger and larger distances in lambda^2.
    fn beside(&self, smallest: &BranchStart, side: f64, mu: f64) -> Option<BranchPoint> {
        let curves = self.climb().curves;
        let unit = smallest.lambda2 + curves.unit();
        let mut guess = smallest.x.clone();
        let mut friction = smallest.mu;
        for k in (0..NEAREST).rev() {
            let t = smallest.lambda2 + side * unit * f64::from(-k).exp2();
            if t < 0.0 {
                return None;
            }

            let point = curves.near(BranchUnknown::Friction, [t, friction], &guess)?;
            if point.mu >= mu {
                return curves
                    .at_friction(mu, &point)
                    .filter(|point| point.violated.is_none());
            }

            guess.clone_from(&point.x);
            friction = point.mu;
        }

        None
    }

    fn close_gap(&mut self, [low, high]: [f64; 2], starts: &[BranchStart]) {
        let distance = |start: &&BranchStart| (low - start.mu).max(start.mu - high).max(0.0);
        let mut nearest: Vec<&BranchStart> = starts.iter().collect();
        nearest.sort_by(|p, q| distance(p).total_cmp(&distance(q)));

        for start in nearest.into_iter().take(STARTS_PER_GAP) {
            if gaps(&self.stretches, low, high).is_empty() || self.ground.watch.is_cancelled() {
                return;
            }

            for followed in self.across([low, high], start) {
                self.keep(followed);
            }
        }
    }

    fn keep(&mut self, followed: Followed) {
        self.stretches.extend(followed.stretches);
        self.imprecise.extend(followed.imprecise);
    }

    /// What is proved of the curve of a solution in [low, high].
    fn across(&self, [low, high]: [f64; 2], start: &BranchStart) -> Vec<Followed> {
        let climb = self.climb();
        let place = [start.lambda2, start.mu];
        let Some(point) = climb.curves.near(BranchUnknown::Lambda2, place, &start.x) else {
            return Vec::new();
        };

        if point.mu < low {
            let at_low = climb.walk(&point, low);
            let followed = at_low.map(|point| climb.prove(&point, high));
            return followed.into_iter().collect();
        }
        if point.mu > high {
            let at_high = climb.walk(&point, high);
            let followed = at_high.map(|point| climb.prove(&point, low));
            return followed.into_iter().collect();
        }

        vec![climb.prove(&point, low), climb.prove(&point, high)]
    }

    /// The certificates of the maximal intervals, each accepted by the checker.
    pub(super) fn certified(&self) -> Vec<Proved<PresenceCertificate>> {
        let mut open = chains(&self.stretches);
        open.reverse();
        let mut accepted = Vec::new();
        let mut refused = 0;
        while let Some(chain) = open.pop() {
            if refused > MAX_REFUSED || self.ground.watch.is_cancelled() {
                break;
            }

            let Some(certificate) = self.certificate(&chain) else {
                continue;
            };

            self.ground.watch.report(&Progress {
                done: chain.len() as u64,
                ..Progress::stage("ranges of mu: checking presence")
            });
            match Proved::new(self.ground.problem, certificate) {
                Ok(proved) => accepted.push(proved),
                Err(rejected) => {
                    refused += 1;
                    if let Reason::Boxes {
                        piece: Some(piece), ..
                    } = rejected.reason
                    {
                        open.push(chain[piece + 1..].to_vec());
                        open.push(chain[..piece].to_vec());
                    }
                }
            }
        }

        accepted
    }

    /// What doubles propose for a chain; `None` where it is too short to be worth a file.
    fn certificate(&self, chain: &Chain) -> Option<PresenceCertificate> {
        let [from, to] = extent(chain)?;
        if to - from < LEAST_INTERVAL * to {
            return None;
        }

        let mut anchors: Vec<usize> = chain.iter().filter_map(|s| s.piece.anchor).collect();
        anchors.sort_unstable();
        anchors.dedup();

        let mut pieces = Vec::with_capacity(chain.len());
        for stretch in chain {
            let mut piece = stretch.piece.clone();
            piece.anchor = piece.anchor.and_then(|k| anchors.binary_search(&k).ok());
            pieces.push(piece);
        }

        Some(PresenceCertificate {
            problem_sha256: self.ground.problem.sha256(),
            from: from_f64(from).ok()?,
            to: from_f64(to).ok()?,
            condensation: self.family.condensation_about(&anchors),
            pieces,
        })
    }
}
