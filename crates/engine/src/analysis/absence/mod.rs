//! No solution for any lambda^2 >= 0 and any mu of an interval: a cover of
//! [0, infinity) x [from, below] x (supports) that the checker reads as `mceip-critical/1`.
//!
//! | file | what |
//! |---|---|
//! | `family` | T(t, mu) = T0(t) + mu T1(t), condensed about common anchors |
//! | `members` | what the radii of the data add to it |
//! | `boxes` | what the search over boxes of (t, mu) does with decided ones |
//!
//! With particles of zero reaction T is that of the split form, and supports are those of its
//! variables. Doubles propose the cover, and nothing is returned as proved before the checker has
//! accepted it. Input: a system and the interval. Output: `CoverOutcome`. Called by `critical`,
//! which chooses bounds for intervals from 0 on, and by `absent_ranges`.

mod boxes;
mod family;
mod members;

use super::families::Families;
use crate::run::{OnProgress, Progress, Watch, in_threads};
use crate::search::complete::CompleteError;
use crate::search::complete::region::SearchRegion;
use crate::search::complete::shares::Shares;
use crate::search::complete::splice::numbered;
use crate::search::complete::tree::TreeSearch;
use boxes::Absence;
pub(super) use boxes::{Blocked, Cause, Depth};
use family::PieceOfHalfLine;
pub(super) use family::{HalfLineFamily, PrecisePlace, parts_of, unit_of_lambda2};
use mceip_check::Proved;
use mceip_check::certificate::{CriticalCertificate, Node, Piece};
use mceip_exact::Rational;
use mceip_model::Problem;
use mceip_model::file::Number;
pub(super) use members::FamilyRadii;
use rayon::prelude::*;

/// How much work the cover may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Boxes examined in one piece of [0, infinity) before the search ends with what it has: for up
    /// to `SMALL_ORDER` slip variables, and fewer for more of them, because each one takes longer.
    pub boxes: usize,
}

/// Slip variables up to which all boxes allowed are examined.
const SMALL_ORDER: usize = 8;

impl Default for Limits {
    fn default() -> Self {
        Limits { boxes: 400_000 }
    }
}

impl Limits {
    /// The boxes allowed with so many slip variables: their number times its square is constant.
    fn boxes_for(&self, order: usize) -> usize {
        let squares = [SMALL_ORDER, order.max(SMALL_ORDER)].map(|n| (n * n) as f64);
        let share = squares[0] / squares[1];
        (self.boxes as f64 * share) as usize
    }
}

/// Factor on the remainders where the checker has refused what doubles held for proved, and how
/// often it is applied.
const CAUTION: f64 = 8.0;
const CAUTIOUS_ROUNDS: usize = 2;

/// What a search ends with.
pub(super) enum CoverOutcome {
    /// The checker has accepted it.
    Absent(Box<Proved<CriticalCertificate>>),
    /// Of each piece that was not emptied the first box that could not be.
    Blocked(Vec<Blocked>),
    /// The checker refuses what doubles propose.
    Refused,
    /// The run was interrupted while the checker read it.
    Stopped,
}

/// The condensation made last: most attempts differ in their bound alone.
#[derive(Default)]
pub(super) struct LastFamily(Option<KeptFamily>);

struct KeptFamily {
    /// It serves absence below any friction up to this one.
    friction: Rational,
    places: Vec<PrecisePlace>,
    family: HalfLineFamily,
}

impl KeptFamily {
    /// The same about these places, if they are the old ones and perhaps new ones for which anchors
    /// can be added; `None` where all is to be made anew.
    fn with_places(mut self, places: &[PrecisePlace]) -> Result<Option<KeptFamily>, CompleteError> {
        let Some(new) = places.strip_prefix(self.places.as_slice()) else {
            return Ok(None);
        };

        for place in new {
            let is_nearest = self.places.iter().all(|other| place.near <= other.near);
            if !is_nearest || !self.family.can_add(place) {
                return Ok(None);
            }

            self.family.add(place)?;
            self.places.push(*place);
        }

        Ok(Some(self))
    }
}

impl LastFamily {
    /// The condensation about these places, made anew where the last one does not serve.
    fn of(
        &mut self,
        families: &Families,
        friction: &Rational,
        places: &[PrecisePlace],
    ) -> Result<&mut HalfLineFamily, CompleteError> {
        let last = self.0.take().filter(|last| *friction <= last.friction);
        let last = match last.and_then(|last| last.with_places(places).transpose()) {
            Some(last) => last?,
            None => KeptFamily {
                friction: friction.clone(),
                places: places.to_vec(),
                family: HalfLineFamily::new(families, friction, places)?,
            },
        };

        Ok(&mut self.0.insert(last).family)
    }

    pub(super) fn into_family(self) -> Option<HalfLineFamily> {
        self.0.map(|last| last.family)
    }
}

/// What is to be proved.
pub(super) struct AbsenceBound<'a> {
    /// Lower end of the interval of mu, included.
    pub(super) from: Rational,
    /// Upper end, included.
    pub(super) below: Rational,
    /// The condensation is made for mu up to here.
    pub(super) at_most: Rational,
    /// Where condensation is to be precise.
    pub(super) places: &'a [PrecisePlace],
}

/// A system whose covers are sought.
#[derive(Clone, Copy)]
pub(super) struct Quadrant<'a> {
    pub(super) families: &'a Families,
    /// MCEIP-lambda2 of the system: what a certificate belongs to.
    pub(super) problem: &'a Problem,
    pub(super) limits: Limits,
    pub(super) threads: Option<usize>,
    pub(super) watch: Watch<'a>,
}

impl<'a> Quadrant<'a> {
    /// The same with another listener.
    pub(super) fn heard_by<'b>(self, listener: &'b OnProgress<'b>) -> Quadrant<'b>
    where
        'a: 'b,
    {
        Quadrant {
            watch: self.watch.heard_by(listener),
            ..self
        }
    }

    /// The first box of each piece that cannot be emptied for a bound: no proof, but cheaper.
    ///
    /// # Errors
    /// As [`Quadrant::cover`].
    pub(super) fn obstacles(
        &self,
        bound: &AbsenceBound<'_>,
        last: &mut LastFamily,
        depth: Depth,
    ) -> Result<Vec<Blocked>, CompleteError> {
        let proposed = self.proposed(self.family(bound, last)?, bound, depth);
        Ok(proposed.err().unwrap_or_default())
    }

    fn family<'b>(
        &self,
        bound: &AbsenceBound<'_>,
        last: &'b mut LastFamily,
    ) -> Result<&'b mut HalfLineFamily, CompleteError> {
        self.watch.report(&Progress::stage("condensing"));
        in_threads(self.threads, || {
            last.of(self.families, &bound.at_most, bound.places)
        })
    }

    /// Covers [0, infinity) x [from, below].
    ///
    /// # Errors
    /// [`CompleteError`]: free variables that cannot be eliminated, too many slip variables.
    pub(super) fn cover(
        &self,
        bound: &AbsenceBound<'_>,
        last: &mut LastFamily,
    ) -> Result<CoverOutcome, CompleteError> {
        let family = self.family(bound, last)?;
        for _ in 0..=CAUTIOUS_ROUNDS {
            let certificate = match self.proposed(family, bound, Depth::Whole) {
                Ok(certificate) => certificate,
                Err(blocked) => return Ok(CoverOutcome::Blocked(blocked)),
            };

            self.watch.report(&Progress {
                done: leaves(&certificate) as u64,
                ..Progress::stage("checking its leaves")
            });
            let go_on = || !self.watch.is_cancelled();
            match Proved::unless_stopped(self.problem, certificate, &go_on) {
                Ok(Some(proved)) => return Ok(CoverOutcome::Absent(Box::new(proved))),
                Ok(None) => return Ok(CoverOutcome::Stopped),
                Err(_) => {}
            }

            family.enlarge_remainders(CAUTION);
        }

        *last = LastFamily::default();
        Ok(CoverOutcome::Refused)
    }

    /// The cover that doubles propose.
    fn proposed(
        &self,
        family: &HalfLineFamily,
        bound: &AbsenceBound<'_>,
        depth: Depth,
    ) -> Result<CriticalCertificate, Vec<Blocked>> {
        let shares = Shares::new(self.watch);
        let share = 1.0 / family.pieces.len() as f64;
        let searched = |piece| self.piece(family, piece, bound, depth, &shares, share);
        let searched: Vec<Result<Piece, Blocked>> = in_threads(self.threads, || {
            family.pieces.par_iter().map(searched).collect()
        });

        let mut pieces = Vec::with_capacity(searched.len());
        let mut blocked = Vec::new();
        for found in searched {
            match found {
                Ok(piece) => pieces.push(piece),
                Err(found) => blocked.push(found),
            }
        }

        if !blocked.is_empty() {
            return Err(blocked);
        }

        Ok(CriticalCertificate {
            problem_sha256: self.problem.sha256(),
            from: bound.from.clone(),
            below: bound.below.clone(),
            condensation: family.condensation([&bound.from, &bound.below]),
            pieces,
        })
    }

    /// One piece, covered.
    fn piece(
        &self,
        family: &HalfLineFamily,
        piece: &PieceOfHalfLine,
        bound: &AbsenceBound<'_>,
        depth: Depth,
        shares: &Shares<'_>,
        share: f64,
    ) -> Result<Piece, Blocked> {
        let mut covered = Piece {
            max: piece.hi.clone().map(Number),
            anchor: piece.anchor,
            tree: Vec::new(),
        };
        if piece.hi.is_none() && family.has_tail() {
            covered.tree.push(Node::Tail);
            return Ok(covered);
        }

        let mut search = TreeSearch {
            view: family.view(),
            expansions: family.expansions(piece.anchor),
            shares,
            budget: self.limits.boxes_for(family.view().order()),
            items: Vec::new(),
            aim: Absence {
                blocked: None,
                depth,
            },
        };

        let region = SearchRegion {
            mu: [bound.from.clone(), bound.below.clone()],
            ..SearchRegion::whole(piece.lo.clone(), piece.hi.clone(), search.view.order())
        };
        search.region(&region, share);

        match search.aim.blocked {
            // A leaf of such a cover names no claim.
            None => Ok(numbered(&covered, search.items, &mut Vec::new())),
            Some(blocked) => Err(blocked),
        }
    }
}

/// How many leaves a certificate has.
pub(super) fn leaves(certificate: &CriticalCertificate) -> usize {
    let nodes = certificate.pieces.iter().flat_map(|piece| &piece.tree);
    nodes.filter(|node| node.is_leaf()).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Cancel;
    use mceip_exact::{Sparse, from_f64, rational, whole};
    use mceip_model::{Body, ContactState, Particle, System, Unknown, Window};
    use mceip_oracle::TwoParticles;
    use mceip_paper::{Block, BlockModel, two_particles};

    /// Covers [0, infinity) x [0, below] for a system with mass and friction.
    fn cover(system: &System, below: f64, places: &[PrecisePlace]) -> CoverOutcome {
        watched_cover(system, below, places, Watch::nobody())
    }

    fn watched_cover(
        system: &System,
        below: f64,
        places: &[PrecisePlace],
        watch: Watch<'_>,
    ) -> CoverOutcome {
        let families = Families::of(system).unwrap();
        let body = Body::System(system.clone());
        let problem = Problem::new(body, Unknown::Lambda2, Window::all()).unwrap();
        let quadrant = Quadrant {
            families: &families,
            problem: &problem,
            limits: Limits::default(),
            threads: Some(1),
            watch,
        };

        let below = from_f64(below).unwrap();
        let bound = AbsenceBound {
            from: whole(0),
            below: below.clone(),
            at_most: below,
            places,
        };
        quadrant.cover(&bound, &mut LastFamily::default()).unwrap()
    }

    /// Two particles with k = 1000 and these signs of slip.
    fn stiff_pair(signs: (i8, i8)) -> System {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(1000),
            m: whole(2),
            mu: whole(1),
            signs,
        };
        two_particles(&data).unwrap()
    }

    /// Interrupted while the checker reads a cover that it would accept: not proved, not refused.
    #[test]
    fn an_interrupted_check_says_nothing() {
        let system = stiff_pair((1, 1));
        assert!(matches!(cover(&system, 1.5, &[]), CoverOutcome::Absent(_)));

        let cancel = Cancel::new();
        let cancel_at_check = |progress: &Progress<'_>| {
            if progress.stage == "checking its leaves" {
                cancel.request();
            }
        };
        let watch = Watch::new(&cancel, &cancel_at_check);
        let outcome = watched_cover(&system, 1.5, &[], watch);
        assert!(matches!(outcome, CoverOutcome::Stopped));
        assert!(cancel.is_requested());
    }

    /// A larger bound, nearer and farther places: what serves is kept, the rest made anew.
    #[test]
    fn one_condensation_serves_the_bounds_it_was_made_for() {
        let families = Families::of(&stiff_pair((1, 1))).unwrap();
        let place = PrecisePlace {
            lambda2: 1.0,
            near: 0.1,
        };

        let mut last = LastFamily::default();
        let mut made_for = |friction: i64, places: &[PrecisePlace]| {
            last.of(&families, &whole(friction), places).unwrap();
            last.0.as_ref().unwrap().friction.clone()
        };

        assert_eq!(made_for(2, &[]), whole(2));
        assert_eq!(made_for(1, &[]), whole(2));
        assert_eq!(made_for(3, &[]), whole(3));
        assert_eq!(made_for(1, &[place]), whole(3));
        let farther = PrecisePlace { near: 0.2, ..place };
        assert_eq!(made_for(1, &[place, farther]), whole(1));
        assert_eq!(made_for(1, &[farther]), whole(1));
        assert!(last.into_family().is_some());
    }

    /// With free variables: a place that is added later gives the anchors and pieces of a
    /// condensation about both.
    #[test]
    fn places_are_added_to_the_last_condensation() {
        let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
        let slip = ContactState::Slip { sign: 1 };
        let states = [slip, slip, ContactState::Free];
        let system = block.system(&states, Some(whole(1))).unwrap();
        let families = Families::of(&system).unwrap();
        let unit = unit_of_lambda2(&families.own).unwrap();
        let places = [(2.0, 0.1), (0.5, 0.03)].map(|(share, near)| PrecisePlace {
            lambda2: share * unit,
            near,
        });

        let mut last = LastFamily::default();
        for count in 0..=2 {
            let added = last.of(&families, &whole(2), &places[..count]).unwrap();
            let anew = HalfLineFamily::new(&families, &whole(2), &places[..count]).unwrap();

            assert_eq!(added.left_friction, anew.left_friction);
            let intervals = |family: &HalfLineFamily| {
                let piece = |p: &PieceOfHalfLine| (p.lo.clone(), p.hi.clone(), p.anchor);
                family.pieces.iter().map(piece).collect::<Vec<_>>()
            };
            assert_eq!(intervals(added), intervals(&anew));
            assert!(anew.left_friction.len() > count);
        }
    }

    /// T = [[1 + t, -4 mu], [0, 1 + t]] has no solution, and no definite symmetric part from mu =
    /// 1/2 on: weights take the place of branches.
    #[test]
    fn weights_take_the_place_of_branches() {
        let k = Sparse::from_ints(&[
            &[1, 0, 0, 0],
            &[0, 1, -4, 0],
            &[0, -4, 32, 0],
            &[0, 0, 0, 32],
        ]);
        let slip = ContactState::Slip { sign: 1 };
        let particles = vec![Particle::plain(0, 2, slip), Particle::plain(1, 3, slip)];
        let mass = Some(Sparse::identity(4));
        let system = System::new(k, mass, Some(whole(1)), particles).unwrap();

        let CoverOutcome::Absent(proved) = cover(&system, 2.0, &[]) else {
            panic!("not proved");
        };
        let nodes = |is_kind: fn(&Node) -> bool| {
            let trees = proved.certificate().pieces.iter().map(|piece| &piece.tree);
            trees.flatten().filter(|node| is_kind(node)).count()
        };
        assert!(nodes(|node| matches!(node, Node::WeightedDefinite(_))) > 0);
        assert_eq!(nodes(|node| matches!(node, Node::Branch(_))), 0);
    }

    /// Absence is proved a millionth below the critical mu. Returns where the search stops a
    /// millionth above it.
    #[track_caller]
    fn absent_just_below_and_not_above(
        system: &System,
        critical: f64,
        lambda2: f64,
    ) -> Vec<Blocked> {
        let place = PrecisePlace {
            lambda2,
            near: 0.03,
        };
        let below = cover(system, critical * (1.0 - 1e-6), &[place]);
        assert!(matches!(below, CoverOutcome::Absent(_)), "{critical}");

        let above = cover(system, critical * (1.0 + 1e-6), &[place]);
        let CoverOutcome::Blocked(blocked) = above else {
            panic!("a solution at {critical} was not met")
        };
        blocked
    }

    /// Table 1 has no folds: nothing exists below the static threshold, and (-1, 1) has nothing at
    /// all.
    #[test]
    fn two_particles_have_nothing_below_their_thresholds() {
        for (signs, threshold) in [
            ((1, 1), Some(2.0f64.sqrt() * 1.18f64.sqrt() / 0.8)),
            ((1, -1), Some(1.36 / 0.48)),
            ((-1, 1), None),
        ] {
            let system = stiff_pair(signs);

            match threshold {
                Some(threshold) => {
                    let blocked = absent_just_below_and_not_above(&system, threshold, 0.0);
                    assert!(blocked.iter().any(|b| b.cause == Cause::Solution));
                }
                None => assert!(matches!(cover(&system, 1e6, &[]), CoverOutcome::Absent(_))),
            }
        }
    }

    /// The fold of errata.md as a mechanical system: no static threshold at all, yet solutions from
    /// the fold on.
    #[test]
    fn a_fold_is_met_before_any_static_threshold() {
        let k = Sparse::from_ints(&[
            &[1, 0, 0, 1],
            &[0, 2, -3, -4],
            &[0, -3, 99, 0],
            &[1, -4, 0, 99],
        ]);
        let slip = ContactState::Slip { sign: 1 };
        let particles = vec![Particle::plain(0, 2, slip), Particle::plain(1, 3, slip)];
        let mass = Some(Sparse::identity(4));
        let system = System::new(k, mass, Some(whole(2)), particles).unwrap();

        // tests/program/analyze.rs has the derivation.
        let mu_of_fold = 1.0 + 0.75f64.sqrt();
        let value_of_fold = 0.5 + 3.0f64.sqrt();
        let blocked = absent_just_below_and_not_above(&system, mu_of_fold, value_of_fold);

        // Solutions a millionth above the fold have lambda^2 within 0.0019 of that of the fold.
        let [value, mu] = blocked[0].middle;
        assert!((value - value_of_fold).abs() < 0.0019, "{value}");
        assert!((mu / mu_of_fold - 1.0).abs() < 2e-6, "{mu}");
    }

    /// With free variables the enclosures of T0 and T1 hold what direct condensation gives.
    #[test]
    fn parts_condensed_about_anchors_agree_with_direct_condensation() {
        let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
        let slip = ContactState::Slip { sign: 1 };
        let states = [slip, slip, ContactState::Free];
        let system = block.system(&states, Some(whole(1))).unwrap();
        let families = Families::of(&system).unwrap();

        let family = HalfLineFamily::new(&families, &whole(2), &[]).unwrap();

        assert!(family.pieces.len() > 1);
        let mut lo = Rational::default();
        for piece in &family.pieces {
            assert_eq!(piece.lo, lo);
            lo = piece.hi.clone().unwrap_or(lo);

            let Some(hi) = &piece.hi else { continue };
            let middle = mceip_exact::to_f64(&(hi / whole(2) + &piece.lo / whole(2)));
            let [first, second] = family.expansions(piece.anchor);
            if piece.anchor.is_none() || first.reversed {
                continue;
            }

            let direct = family.direct(middle);
            let ends = [first.ends(middle, middle), second.ends(middle, middle)];
            for (part, matrix) in ends.iter().zip(&direct) {
                for (i, row) in matrix.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate() {
                        let distance = (entry - part.m[0][i][j]).abs();
                        assert!(
                            distance <= part.radius(0).map_or(0.0, |r| r[i][j]),
                            "{middle} {i} {j}: {distance}"
                        );
                    }
                }
            }
        }
    }
}
