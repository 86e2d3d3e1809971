//! The critical mu: the infimum of mu over all lambda^2 >= 0 at which a solution exists, folds
//! included, between a proved bound and a solution.
//!
//! Above: the static threshold and the solutions at the mu of the analysis are followed to local
//! minima of mu (`follow`), and the smallest is certified by MCEIP-mu at a short lambda^2 next to
//! the minimum. Below: a cover of [0, infinity) x [0, bound] ([`absence`](super::absence)), with
//! bounds ever closer to the solution. A box that cannot be emptied points to a smaller solution,
//! or the bound is lowered.
//!
//! Input: what [`analyse`](super::analyse) has found so far ([`KnownOfSystem`]). Output:
//! [`Critical`], and the proofs named `critical` (the solution) and `absence` (the bound).

use super::absence::{
    AbsenceBound, Blocked, Cause, CoverOutcome, Depth, HalfLineFamily, LastFamily, PrecisePlace,
    Quadrant, unit_of_lambda2,
};
use super::conditions::Necessary;
use super::divergence::Divergence;
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::families::Families;
use super::follow::{BranchFollower, Minimum};
use super::model::AnalysisModel;
use super::threshold::StaticThreshold;
use crate::run::Progress;
use crate::search::complete::Completed;
use crate::tolerance::{
    CRITICAL_GAPS, FIRST_GAP, FIRST_NEAR, LEAST_NEAR, NARROW_WINDOWS, SMALLER_FRICTION,
};
use mceip_check::Proved;
use mceip_check::certificate::CriticalCertificate;
use mceip_exact::{Interval, Rational, from_f64, to_f64, whole};
use mceip_model::{Problem, Window};
use num_traits::Zero;

/// A solution that is proved to exist: with these values of lambda^2 and mu.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CertifiedSolution {
    /// Encloses mu.
    pub mu: Interval,
    /// Encloses lambda^2.
    pub lambda2: Interval,
    /// Its certificate.
    pub evidence: Evidence,
}

/// What is proved about the smallest mu with divergence.
#[derive(Debug, Clone)]
pub struct Critical {
    /// For no lambda^2 >= 0 is there a solution with mu below this (not included); 0 where no such
    /// bound is proved; `None`: for no mu at all.
    pub absent_below: Option<Rational>,
    /// Why.
    pub evidence: Evidence,
    /// The solution of smallest mu that was found.
    pub solution: Option<CertifiedSolution>,
    /// Leaves of the cover behind the bound, where there is one.
    pub boxes: Option<usize>,
    /// The bound tried last in vain, above `absent_below`.
    pub unproved: Option<Unproved>,
}

/// A bound below which absence was tried and not proved.
#[derive(Debug, Clone, PartialEq)]
pub struct Unproved {
    /// The bound.
    pub below: Rational,
    /// Why not.
    pub reason: Obstacle,
    /// lambda^2 and mu of the first box that stood in the way, where it was one.
    pub place: Option<[f64; 2]>,
}

/// What stands in the way of a bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Obstacle {
    /// A box seems to hold a solution, which could not be certified.
    Solution,
    /// The remainder of the condensation, about the finest anchors as well.
    Remainder,
    /// The boxes allowed are used up.
    Boxes,
    /// The checker has refused what doubles propose.
    Refused,
    /// The run was interrupted.
    Interrupted,
}

impl Obstacle {
    /// A word for programs.
    pub fn word(self) -> &'static str {
        match self {
            Obstacle::Solution => "solution",
            Obstacle::Remainder => "remainder",
            Obstacle::Boxes => "boxes",
            Obstacle::Refused => "refused",
            Obstacle::Interrupted => "interrupted",
        }
    }
}

const BY_CONDITION: Evidence = Evidence::Exact(
    "condition (19): K* positive definite and M* positive semidefinite below it, by exact LDL' and \
     linearity in mu",
);

const BY_CONDITION_WITH_ZERO: Evidence = Evidence::Exact(
    "condition (19z): with the particles of zero reaction free, K* is positive definite and M* \
     positive semidefinite below it, by exact LDL' and linearity in mu",
);

const NO_BOUND: Evidence = Evidence::Exact(
    "no bound by condition (19): K* is not positive definite at mu = 0 already, by exact LDL'",
);

/// What stands behind the bound `excluded` of condition (19), or (19z).
fn by_condition(families: &Families, excluded: Option<&Rational>) -> Evidence {
    if excluded.is_some_and(Rational::is_zero) {
        NO_BOUND
    } else if families.zero.is_empty() {
        BY_CONDITION
    } else {
        BY_CONDITION_WITH_ZERO
    }
}

/// A solution in doubles from which branches are followed: x over the complementarity variables.
#[derive(Debug, Clone)]
pub(super) struct BranchStart {
    pub(super) lambda2: f64,
    pub(super) mu: f64,
    pub(super) x: Vec<f64>,
}

/// The critical mu, and what presence above it starts from.
pub(super) struct CriticalFound {
    pub(super) critical: Critical,
    /// The solution of smallest mu in doubles.
    pub(super) start: Option<BranchStart>,
    /// The condensation of the last cover, if there was one.
    pub(super) family: Option<HalfLineFamily>,
    /// Where condensation is to be precise.
    pub(super) places: Vec<PrecisePlace>,
}

/// What is known about a system before its critical mu is sought.
pub(super) struct KnownOfSystem<'a> {
    pub(super) families: &'a Families,
    pub(super) necessary: &'a Necessary,
    /// The mu of the analysis, and MCEIP-lambda2 there.
    pub(super) friction: &'a Rational,
    pub(super) problem: &'a Problem,
    /// Divergence at that mu.
    pub(super) divergence: &'a Divergence,
    pub(super) threshold: &'a StaticThreshold,
    /// The solutions of both in doubles.
    pub(super) starts: Vec<BranchStart>,
}

impl<'a> KnownOfSystem<'a> {
    /// Where covers are sought.
    pub(super) fn quadrant(&self, model: &AnalysisModel<'a>) -> Quadrant<'a> {
        Quadrant {
            families: self.families,
            problem: self.problem,
            limits: model.options.limits,
            threads: model.options.threads,
            watch: model.watch,
        }
    }

    /// The known solution of smallest mu: at the static threshold (lambda = 0), or at the mu of the
    /// analysis.
    fn smallest_solution(&self) -> Option<CertifiedSolution> {
        let at_threshold = self.threshold.values.first().map(|mu| CertifiedSolution {
            mu: mu.clone(),
            lambda2: Interval::point(Rational::zero()),
            evidence: self.threshold.evidence.clone(),
        });
        let Some(mode) = self.divergence.modes.first() else {
            return at_threshold;
        };

        match at_threshold {
            Some(solution) if solution.mu.hi() <= self.friction => Some(solution),
            _ => Some(CertifiedSolution {
                mu: Interval::point(self.friction.clone()),
                lambda2: mode.lambda2.clone(),
                evidence: self.divergence.evidence.clone(),
            }),
        }
    }

    /// The known solution in doubles that is nearest to a certified one.
    fn start_of(&self, solution: &CertifiedSolution) -> Option<BranchStart> {
        let mu = to_f64(&solution.mu.mid());
        let lambda2 = to_f64(&solution.lambda2.mid());
        let distance =
            |start: &&BranchStart| [(start.mu - mu).abs(), (start.lambda2 - lambda2).abs()];
        let nearest = self.starts.iter().min_by(|p, q| {
            let [p, q] = [distance(p), distance(q)];
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
        });
        nearest.cloned()
    }
}

/// Branches followed at most, those of smallest mu first.
const MAX_STARTS: usize = 16;

/// Free variables up to which the finest gap is aimed at: beyond that it costs more than a mesh is
/// worth.
const FINE_GAP_FREE: usize = 100;

/// Boxes that may hold a smaller solution are followed so many at a time, those of smallest mu
/// first, until one is certified.
const FOLLOWED_TOGETHER: usize = 3;

/// Covers tried for one gap.
const ROUNDS_PER_GAP: usize = 12;

/// Where no solution is known: bounds tried one after the other, as multiples of the mu below which
/// condition (19) excludes all; of the mu of the analysis, or 1, where that is 0.
const BOUNDS_WITHOUT_SOLUTION: [i64; 3] = [16, 1 << 10, 1 << 24];

/// Bounds the infimum from both sides.
pub(super) fn critical(
    model: &AnalysisModel<'_>,
    known: &KnownOfSystem<'_>,
    proofs: &mut Vec<Proof>,
) -> Result<CriticalFound, AnalysisError> {
    let solution = known.smallest_solution();
    let Some(excluded) = known.necessary.excluded_below() else {
        let critical = Critical {
            absent_below: None,
            evidence: by_condition(known.families, None),
            solution: None,
            boxes: None,
            unproved: None,
        };
        return Ok(CriticalFound {
            critical,
            start: None,
            family: None,
            places: Vec::new(),
        });
    };

    let mut bounds = CriticalBounds {
        start: solution.as_ref().and_then(|found| known.start_of(found)),
        solution,
        of_solution: None,
        absence: None,
        unproved: None,
        places: Vec::new(),
        last: LastFamily::default(),
    };

    if known.families.own.mass.is_some() && !model.stopped() {
        let scale = unit_of_lambda2(&known.families.own)?;
        let search = CriticalSearch {
            model,
            branches: BranchFollower::new(model.system, scale)?,
            scale,
            quadrant: known.quadrant(model),
            problem: known.problem,
            friction: known.friction,
        };

        search.follow(&known.starts, &mut bounds)?;
        search.close_from_below(&excluded, &mut bounds)?;
    }

    let start = bounds.start.take();
    let family = std::mem::take(&mut bounds.last).into_family();
    let places = std::mem::take(&mut bounds.places);
    Ok(CriticalFound {
        critical: bounds.into_critical(excluded, known, proofs),
        start,
        family,
        places,
    })
}

/// What is proved so far.
struct CriticalBounds {
    solution: Option<CertifiedSolution>,
    /// The same in doubles.
    start: Option<BranchStart>,
    /// The proof of that solution, if it is none of those known before.
    of_solution: Option<Proof>,
    absence: Option<Proved<CriticalCertificate>>,
    /// The bound tried last in vain.
    unproved: Option<Unproved>,
    /// Where condensation is to be precise.
    places: Vec<PrecisePlace>,
    last: LastFamily,
}

impl CriticalBounds {
    /// The mu of the known solution, at least a bound below it.
    fn at_most(&self, below: &Rational) -> Rational {
        let known = self.solution.iter().map(|solution| solution.mu.hi());
        let largest = known.fold(below, Ord::max);
        largest.clone()
    }

    /// Absence from mu = 0 to a bound, as it is asked for, and the condensation that may serve.
    fn absence_below(&mut self, below: &Rational) -> (AbsenceBound<'_>, &mut LastFamily) {
        let bound = AbsenceBound {
            from: Rational::zero(),
            below: below.clone(),
            at_most: self.at_most(below),
            places: &self.places,
        };
        (bound, &mut self.last)
    }

    /// A short number below the known solution, by a relative gap.
    fn short_bound(&self, gap: f64) -> Option<Rational> {
        let solution = self.solution.as_ref()?;
        short_bound(to_f64(solution.mu.lo()), gap)
    }

    /// Is this mu smaller than that of the known solution, by more than rounding?
    fn is_smaller(&self, mu: f64) -> bool {
        let known = self
            .solution
            .as_ref()
            .map(|solution| to_f64(solution.mu.hi()));
        known.is_none_or(|known| mu < known * (1.0 - SMALLER_FRICTION))
    }

    /// Makes condensation more precise at a value of lambda^2; false where that is no longer worth
    /// trying.
    fn sharpen(&mut self, lambda2: f64, scale: f64) -> bool {
        let place = PrecisePlace::sharper(&self.places, lambda2, scale);
        self.places.push(place);
        place.near >= LEAST_NEAR
    }

    /// Notes that absence below a bound is not proved.
    fn not_proved(&mut self, below: &Rational, reason: Obstacle, place: Option<[f64; 2]>) {
        self.unproved = Some(Unproved {
            below: below.clone(),
            reason,
            place,
        });
    }

    fn into_critical(
        self,
        excluded: Rational,
        known: &KnownOfSystem<'_>,
        proofs: &mut Vec<Proof>,
    ) -> Critical {
        let solution = match (self.solution, self.of_solution) {
            (Some(solution), Some(proof)) => {
                proofs.push(proof);
                Some(CertifiedSolution {
                    evidence: Evidence::Certificate(proofs.len() - 1),
                    ..solution
                })
            }
            (solution, _) => solution,
        };

        // A known solution refutes absence below any larger bound: that is false, not unproved.
        let first_solution = solution.as_ref().map(|found| found.mu.hi());
        let may_be_absent = |tried: &Unproved| first_solution.is_none_or(|mu| tried.below <= *mu);
        let unproved = self.unproved.filter(may_be_absent);

        let absence = self.absence;
        let beyond_condition = absence.filter(|found| found.accepted().below > excluded);
        let Some(proved) = beyond_condition else {
            return Critical {
                evidence: by_condition(known.families, Some(&excluded)),
                absent_below: Some(excluded),
                solution,
                boxes: None,
                unproved,
            };
        };

        let absent_below = proved.accepted().below.clone();
        let boxes = proved.accepted().leaves;
        let certificate = ProofCertificate::Absence(proved);
        proofs.push(Proof::new("absence", known.problem.clone(), certificate));

        Critical {
            absent_below: Some(absent_below),
            evidence: Evidence::Certificate(proofs.len() - 1),
            solution,
            boxes: Some(boxes),
            unproved,
        }
    }
}

/// What a failed cover leads to.
enum Next {
    /// Something new is known: the same gap again.
    Again,
    /// Nothing new: a wider gap.
    Wider,
}

/// The search for both bounds.
struct CriticalSearch<'a> {
    model: &'a AnalysisModel<'a>,
    branches: BranchFollower,
    /// The unit of lambda^2.
    scale: f64,
    quadrant: Quadrant<'a>,
    /// What absence is proved for.
    problem: &'a Problem,
    /// The mu of the analysis.
    friction: &'a Rational,
}

impl CriticalSearch<'_> {
    /// Follows the known solutions to their minima and certifies the smallest.
    fn follow(
        &self,
        starts: &[BranchStart],
        bounds: &mut CriticalBounds,
    ) -> Result<(), AnalysisError> {
        let mut starts = starts.to_vec();
        starts.sort_by(|p, q| p.mu.total_cmp(&q.mu));
        starts.truncate(MAX_STARTS);

        self.certify_smallest_below(&starts, bounds)?;
        if let Some(solution) = &bounds.solution {
            let lambda2 = to_f64(&solution.lambda2.mid());
            bounds.places.push(PrecisePlace {
                lambda2,
                near: FIRST_NEAR,
            });
        }

        Ok(())
    }

    /// Follows solutions to their minima, and certifies the smallest for which that succeeds.
    fn certify_smallest_below(
        &self,
        starts: &[BranchStart],
        bounds: &mut CriticalBounds,
    ) -> Result<Option<Minimum>, AnalysisError> {
        let mut minima: Vec<Minimum> = Vec::new();
        for (k, start) in starts.iter().enumerate() {
            if self.model.stopped() {
                break;
            }

            let stage = "critical mu: following solutions to smaller mu";
            let watch = &self.model.watch;
            watch.report(&Progress::of(stage, k, starts.len()));
            minima.extend(
                self.branches
                    .minimum_below(start.lambda2, start.mu, &start.x),
            );
        }

        minima.sort_by(|p, q| p.point.mu.total_cmp(&q.point.mu));
        // Several starts lead to one minimum.
        minima.dedup_by(|q, p| q.point.mu < p.point.mu * (1.0 + SMALLER_FRICTION));
        for minimum in minima {
            if self.certify(&minimum, bounds)? {
                return Ok(Some(minimum));
            }
        }

        Ok(None)
    }

    /// Certifies a solution in doubles, if its mu is smaller than that of the known one; is it
    /// known afterwards?
    fn certify(
        &self,
        minimum: &Minimum,
        bounds: &mut CriticalBounds,
    ) -> Result<bool, AnalysisError> {
        if self.model.stopped() || !bounds.is_smaller(minimum.point.mu) {
            return Ok(false);
        }

        // lambda = 0 is left out: there the static threshold is the smallest.
        let Some((lambda2, moved)) = self.branches.at_short_value(minimum) else {
            return Ok(false);
        };

        let Some((problem, found)) = self.set_about(&lambda2, moved.mu)? else {
            return Ok(false);
        };

        let moved_to = to_f64(&lambda2);

        bounds.start = Some(BranchStart {
            lambda2: moved_to,
            mu: moved.mu,
            x: moved.x,
        });
        bounds.solution = Some(CertifiedSolution {
            mu: found.cover.solutions[0].value.clone(),
            lambda2: Interval::point(lambda2),
            evidence: Evidence::Exact(""),
        });
        let certificate = ProofCertificate::Solutions(found.proved);
        self.model.keep("critical", &problem, &certificate);
        bounds.of_solution = Some(Proof::new("critical", problem, certificate));
        Ok(true)
    }

    /// A set with a solution in a narrow window about mu: complete in one of the windows tried, or
    /// else the first one.
    fn set_about(
        &self,
        lambda2: &Rational,
        mu: f64,
    ) -> Result<Option<(Problem, Completed)>, AnalysisError> {
        let stage = format!("critical mu: certifying a solution at mu = {mu:.9}");
        let problem = self.model.at_lambda2(lambda2)?;
        let mut incomplete = None;
        for half_width in NARROW_WINDOWS {
            let Some(window) = window_about(mu, half_width) else {
                return Ok(None);
            };

            let problem = problem.clone().with_window(window);
            let found = self.model.complete(&stage, &problem, None)?;
            if found.cover.solutions.is_empty() {
                continue;
            }
            if found.is_complete() {
                return Ok(Some((problem, found)));
            }
            incomplete = incomplete.or(Some((problem, found)));
        }

        Ok(incomplete)
    }

    /// Proves absence below bounds close to the known solution.
    fn close_from_below(
        &self,
        excluded: &Rational,
        bounds: &mut CriticalBounds,
    ) -> Result<(), AnalysisError> {
        if bounds.solution.is_none() {
            self.far_bounds(excluded, bounds)?;
        }

        self.find_smaller(excluded, bounds)?;
        for &gap in self.gaps() {
            if self.model.stopped() || self.close_gap(gap, excluded, bounds)? {
                break;
            }
        }

        Ok(())
    }

    /// The gaps to aim at.
    fn gaps(&self) -> &'static [f64] {
        if self.quadrant.families.own.stiffness.free().len() <= FINE_GAP_FREE {
            &CRITICAL_GAPS
        } else {
            &CRITICAL_GAPS[1..]
        }
    }

    /// Proves absence far beyond the condition, where no solution is known; or finds one.
    fn far_bounds(
        &self,
        excluded: &Rational,
        bounds: &mut CriticalBounds,
    ) -> Result<(), AnalysisError> {
        let units = [to_f64(excluded), to_f64(self.friction)];
        let unit = units.into_iter().find(|mu| *mu > 0.0).unwrap_or(1.0);
        for factor in BOUNDS_WITHOUT_SOLUTION {
            let Ok(below) = from_f64(unit * factor as f64) else {
                return Ok(());
            };

            for _ in 0..ROUNDS_PER_GAP {
                match self.attempt(&below, bounds)? {
                    None => break,
                    Some(Next::Again) if bounds.solution.is_none() => {}
                    Some(_) => return Ok(()),
                }
            }
        }

        Ok(())
    }

    /// Looks for solutions well below the known one, without a proof.
    fn find_smaller(
        &self,
        excluded: &Rational,
        bounds: &mut CriticalBounds,
    ) -> Result<(), AnalysisError> {
        for _ in 0..ROUNDS_PER_GAP {
            let Some(below) = bounds
                .short_bound(FIRST_GAP)
                .filter(|below| below > excluded)
            else {
                return Ok(());
            };

            let guesses = self.obstacles(&below, bounds, Depth::ToBranches)?;
            if guesses.is_empty() || self.model.stopped() {
                return Ok(());
            }
            if self.has_smaller(&guesses, bounds)? {
                continue;
            }

            let obstacles = self.obstacles(&below, bounds, Depth::Whole)?;
            let is_over = obstacles.is_empty() || self.model.stopped();
            if is_over || !matches!(self.learn_from(&obstacles, bounds)?, Next::Again) {
                return Ok(());
            }
        }

        Ok(())
    }

    /// What stands in the way of absence below a bound.
    fn obstacles(
        &self,
        below: &Rational,
        bounds: &mut CriticalBounds,
        depth: Depth,
    ) -> Result<Vec<Blocked>, AnalysisError> {
        let stage = "critical mu: looking for smaller solutions";
        let relay = |progress: &Progress<'_>| self.model.relay(stage, progress);
        let quadrant = self.quadrant.heard_by(&relay);
        let (bound, last) = bounds.absence_below(below);
        Ok(quadrant.obstacles(&bound, last, depth)?)
    }

    /// Proves absence up to the known solution but for a relative gap; false where that fails.
    fn close_gap(
        &self,
        gap: f64,
        excluded: &Rational,
        bounds: &mut CriticalBounds,
    ) -> Result<bool, AnalysisError> {
        for _ in 0..ROUNDS_PER_GAP {
            let Some(below) = bounds.short_bound(gap) else {
                return Ok(true);
            };

            if below <= *excluded {
                return Ok(true);
            }

            match self.attempt(&below, bounds)? {
                None => return Ok(true),
                Some(Next::Again) => {}
                Some(Next::Wider) => return Ok(false),
            }
        }

        Ok(false)
    }

    /// Tries to prove absence up to a bound; `None` if that has succeeded.
    fn attempt(
        &self,
        below: &Rational,
        bounds: &mut CriticalBounds,
    ) -> Result<Option<Next>, AnalysisError> {
        if self.model.stopped() {
            bounds.not_proved(below, Obstacle::Interrupted, None);
            return Ok(Some(Next::Wider));
        }

        let stage = format!("critical mu: proving absence below {:.7}", to_f64(below));
        let relay = |progress: &Progress<'_>| self.model.relay(&stage, progress);
        let quadrant = self.quadrant.heard_by(&relay);
        let (bound, last) = bounds.absence_below(below);
        match quadrant.cover(&bound, last)? {
            CoverOutcome::Absent(proved) => {
                bounds.unproved = bounds.unproved.take().filter(|tried| tried.below > *below);
                let proof = ProofCertificate::Absence(*proved.clone());
                self.model.keep("absence", self.problem, &proof);
                bounds.absence = Some(*proved);
                Ok(None)
            }
            CoverOutcome::Refused => {
                bounds.not_proved(below, Obstacle::Refused, None);
                Ok(Some(Next::Wider))
            }
            CoverOutcome::Stopped => {
                bounds.not_proved(below, Obstacle::Interrupted, None);
                Ok(Some(Next::Wider))
            }
            CoverOutcome::Blocked(obstacles) => {
                let first = obstacles.first();
                let reason = first.map_or(Obstacle::Refused, |box_| self.obstacle(box_.cause));
                bounds.not_proved(below, reason, first.map(|box_| box_.middle));
                self.learn_from(&obstacles, bounds).map(Some)
            }
        }
    }

    /// What a box that could not be emptied is called in the answer.
    fn obstacle(&self, cause: Cause) -> Obstacle {
        match cause {
            Cause::Solution => Obstacle::Solution,
            Cause::Remainder => Obstacle::Remainder,
            Cause::Budget if self.model.stopped() => Obstacle::Interrupted,
            Cause::Budget => Obstacle::Boxes,
        }
    }

    /// Follows the solutions next to these boxes to their minima. Is one smaller than the known
    /// solution, and certified? Then it is known afterwards.
    fn has_smaller(
        &self,
        obstacles: &[Blocked],
        bounds: &mut CriticalBounds,
    ) -> Result<bool, AnalysisError> {
        let start = |blocked: &Blocked| BranchStart {
            lambda2: blocked.middle[0],
            mu: blocked.middle[1],
            x: blocked.x.clone(),
        };
        let mut starts: Vec<BranchStart> = obstacles.iter().map(start).collect();
        starts.sort_by(|p, q| p.mu.total_cmp(&q.mu));
        for together in starts.chunks(FOLLOWED_TOGETHER) {
            if let Some(minimum) = self.certify_smallest_below(together, bounds)? {
                bounds.places.push(PrecisePlace {
                    lambda2: minimum.point.t,
                    near: FIRST_NEAR,
                });
                return Ok(true);
            }
        }

        Ok(false)
    }

    /// What boxes that could not be emptied tell: a smaller solution, or where condensation has to
    /// be more precise.
    fn learn_from(
        &self,
        obstacles: &[Blocked],
        bounds: &mut CriticalBounds,
    ) -> Result<Next, AnalysisError> {
        if self.has_smaller(obstacles, bounds)? {
            return Ok(Next::Again);
        }

        let mut next = Next::Again;
        for blocked in obstacles {
            let is_worth_more = match blocked.cause {
                Cause::Budget => false,
                Cause::Solution | Cause::Remainder => bounds.sharpen(blocked.middle[0], self.scale),
            };
            if !is_worth_more {
                next = Next::Wider;
            }
        }

        Ok(next)
    }
}

/// [mu (1 - half_width), mu (1 + half_width)].
fn window_about(mu: f64, half_width: f64) -> Option<Window> {
    let lo = from_f64(mu * (1.0 - half_width)).ok()?;
    let hi = from_f64(mu * (1.0 + half_width)).ok()?;
    Window::new(lo, Some(hi)).ok()
}

/// A short number at most mu (1 - gap), and within a tenth of the gap of it.
pub(super) fn short_bound(mu: f64, gap: f64) -> Option<Rational> {
    let target = mu * (1.0 - gap);
    let unit = (0.1 * gap * mu).log2().floor().exp2();
    let bound = (target / unit).floor() * unit;
    let bound = from_f64(bound).ok()?;
    (bound > whole(0)).then_some(bound)
}
