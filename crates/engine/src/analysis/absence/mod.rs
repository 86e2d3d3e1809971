//! No solution for any lambda^2 >= 0 and any mu below a bound: a cover of the (lambda^2, mu)
//! quadrant.
//!
//! The quadrant is mapped to the unit square by lambda^2 = t = tau s/(1-s) and mu = nu m/(1-m); s =
//! 1 (t = infinity) is included. The cover consists of boxes in (s, m), times states of the slip
//! variables. On a box the condensed family is a convex combination of its four corners up to a
//! radius (`strip`), so a Farkas vector that works at the four corners, or a symmetric part
//! definite there, proves that the box holds no solution (`judge`). Boxes are taken in the order of
//! mu; the first that cannot be emptied ends the search, and everything below it is proved. Doubles
//! propose, integers decide.
//!
//! Input: K* and M* as functions of mu, and the mu below which the conditions (19), (20) have
//! excluded all. Output: [`Absence`]. Called by `critical`.

mod family;
mod judge;
mod strip;

use crate::reduction::MuFamily;
use crate::run::Watch;
use family::Scaled;
use judge::{Corners, State, Verdict};
use mceip_exact::Rational;
use num_traits::One;
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};
use std::rc::Rc;
use strip::Strip;

/// How much work the cover may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Boxes examined before the search ends with what it has.
    pub boxes: usize,
    /// Intervals of lambda^2 on which free variables are eliminated before it does.
    pub strips: usize,
    /// Slip variables beyond which no cover is tried.
    pub slip: usize,
    /// Free variables beyond which no cover is tried.
    pub free: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            boxes: 20_000,
            strips: 2_000,
            slip: 20,
            free: 120,
        }
    }
}

/// What the cover has proved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Absence {
    /// No solution with lambda^2 >= 0 and mu below this value (not included); `None`: for no mu at
    /// all.
    pub below: Option<Rational>,
    /// lambda^2 of the box that could not be emptied (`None` for infinity at its upper end).
    pub blocked: Option<(Rational, Option<Rational>)>,
    /// Boxes examined.
    pub boxes: usize,
    /// Did the budget or an interrupt end the search, rather than a box that seems to hold a
    /// solution?
    pub cut_short: bool,
}

/// Finest subdivision of s and m: 2^-LEVEL.
const LEVEL: u32 = 22;
/// A box of this relative size (2^-this, in s and m) that cannot be emptied ends the search.
const TINY: u32 = 14;

/// A box [s, s + 1] / 2^s_level by [m, m + 1] / 2^m_level, and the state of each slip variable.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Region {
    s: u64,
    s_level: u32,
    m: u64,
    m_level: u32,
    states: Vec<State>,
}

impl Region {
    /// The unit square with every slip variable open.
    fn whole(slip_count: usize) -> Region {
        Region {
            s: 0,
            s_level: 0,
            m: 0,
            m_level: 0,
            states: vec![State::Open; slip_count],
        }
    }

    /// Lower end of m in units of 2^-LEVEL: the order of the search.
    fn m_key(&self) -> u64 {
        self.m << (LEVEL - self.m_level)
    }

    fn lower_mu(&self, scaled: &Scaled) -> Option<Rational> {
        position(&scaled.nu, self.m, self.m_level)
    }

    fn upper_mu(&self, scaled: &Scaled) -> Option<Rational> {
        position(&scaled.nu, self.m + 1, self.m_level)
    }

    fn lower_lambda2(&self, scaled: &Scaled) -> Option<Rational> {
        position(&scaled.tau, self.s, self.s_level)
    }

    fn upper_lambda2(&self, scaled: &Scaled) -> Option<Rational> {
        position(&scaled.tau, self.s + 1, self.s_level)
    }

    fn with_state(&self, variable: usize, state: State) -> Region {
        let mut region = self.clone();
        region.states[variable] = state;
        region
    }

    /// The half of lower (k = 0) or upper (k = 1) m.
    fn half_along_m(&self, k: u64) -> Region {
        Region {
            m: 2 * self.m + k,
            m_level: self.m_level + 1,
            ..self.clone()
        }
    }

    /// The half of lower (k = 0) or upper (k = 1) s.
    fn half_along_s(&self, k: u64) -> Region {
        Region {
            s: 2 * self.s + k,
            s_level: self.s_level + 1,
            ..self.clone()
        }
    }
}

/// unit p / (1 - p) at p = index / 2^level; `None` for infinity.
fn position(unit: &Rational, index: u64, level: u32) -> Option<Rational> {
    let distance_to_one = (1u64 << level) - index;
    if distance_to_one == 0 {
        return None;
    }

    Some(unit * Rational::new(index.into(), distance_to_one.into()))
}

/// Covers the quadrant from mu = 0 up. `excluded_below`: mu below which (20) and (19) have already
/// excluded all.
///
/// `None` where the system is beyond the limits or doubles fail: then nothing is proved here.
pub fn absence(
    family: &MuFamily,
    excluded_below: &Rational,
    limits: Limits,
    watch: &Watch<'_>,
) -> Option<Absence> {
    let stiffness = &family.stiffness;
    let mass = family.mass.as_ref()?;
    if stiffness.slip().len() > limits.slip || stiffness.free().len() > limits.free {
        return None;
    }

    let scaled = Scaled::new(stiffness, mass)?;
    let mut strips = Strips {
        scaled: &scaled,
        known: HashMap::new(),
    };

    let mut queue = Queue::default();
    queue.push(Region::whole(scaled.slip_count()));

    let mut boxes = 0;
    while let Some(region) = queue.pop() {
        let is_used_up = boxes >= limits.boxes || strips.are_used_up(limits);
        let must_stop = is_used_up || watch.is_cancelled();
        boxes += 1;

        if let Some(mu) = region.upper_mu(&scaled)
            && mu <= *excluded_below
        {
            continue;
        }

        let verdict = strips.judge(&region)?;
        let children = children(&region, verdict);
        let is_blocked = children.is_none();

        if is_blocked || (must_stop && verdict != Verdict::Empty) {
            let lower = region.lower_lambda2(&scaled);
            let upper = region.upper_lambda2(&scaled);
            return Some(Absence {
                below: region.lower_mu(&scaled).max(Some(excluded_below.clone())),
                blocked: Some((lower.unwrap_or_else(Rational::one), upper)),
                boxes,
                cut_short: !is_blocked,
            });
        }

        for child in children.into_iter().flatten() {
            queue.push(child);
        }
    }

    Some(Absence {
        below: None,
        blocked: None,
        boxes,
        cut_short: false,
    })
}

/// Regions in the order of mu, then in that of arrival.
#[derive(Default)]
struct Queue {
    /// Keys of mu and numbers of arrival.
    order: BinaryHeap<Reverse<(u64, usize)>>,
    /// The regions by their numbers of arrival.
    regions: HashMap<usize, Region>,
    arrived: usize,
}

impl Queue {
    fn push(&mut self, region: Region) {
        self.order.push(Reverse((region.m_key(), self.arrived)));
        self.regions.insert(self.arrived, region);
        self.arrived += 1;
    }

    fn pop(&mut self) -> Option<Region> {
        let Reverse((_, id)) = self.order.pop()?;
        self.regions.remove(&id)
    }
}

/// The strips met so far, by (s, s_level). They are kept because eliminating the free variables
/// takes most of the time.
struct Strips<'a> {
    scaled: &'a Scaled,
    known: HashMap<(u64, u32), Rc<Strip>>,
}

impl Strips<'_> {
    /// Have free variables been eliminated as often as the limits allow?
    fn are_used_up(&self, limits: Limits) -> bool {
        let has_free_variables = self.scaled.free_count() > 0;
        has_free_variables && self.known.len() >= limits.strips
    }

    /// What to do with a region; `None` if doubles fail there.
    fn judge(&mut self, region: &Region) -> Option<Verdict> {
        let strip = self.over(region)?;
        if strip.too_wide {
            return Some(Verdict::Split {
                along_m: false,
                hopeful: true,
            });
        }

        let corners = Corners::new(&strip, region.m, region.m_level);
        Some(corners.judge(&region.states))
    }

    /// The strip a region lies in; `None` if doubles fail there.
    fn over(&mut self, region: &Region) -> Option<Rc<Strip>> {
        let key = (region.s, region.s_level);
        if let Some(strip) = self.known.get(&key) {
            return Some(Rc::clone(strip));
        }

        let strip = Rc::new(Strip::new(self.scaled, region.s, region.s_level)?);
        self.known.insert(key, Rc::clone(&strip));
        Some(strip)
    }
}

/// What is left of a region after a verdict; `None` if it should be halved and is too small for
/// that.
fn children(region: &Region, verdict: Verdict) -> Option<Vec<Region>> {
    match verdict {
        Verdict::Empty => Some(Vec::new()),
        Verdict::Branch(variable) => Some(vec![
            region.with_state(variable, State::Moving),
            region.with_state(variable, State::AtRest),
        ]),
        Verdict::Split { along_m, hopeful } => halves(region, along_m, hopeful),
    }
}

/// The halves of a box; `None` if it is too small for that.
///
/// It is halved in the direction asked for, except where it is finest in that direction, or tiny
/// and not hopeful. A box that is tiny in both directions and not hopeful seems to hold a solution.
fn halves(region: &Region, along_m: bool, hopeful: bool) -> Option<Vec<Region>> {
    let m_is_finest = region.m_level >= LEVEL;
    let s_is_finest = region.s_level >= LEVEL;
    // Relative to its place in m; absolute in s.
    let m_is_tiny = region.m >> TINY > 0 || m_is_finest;
    let s_is_tiny = region.s_level >= TINY;
    if !hopeful && m_is_tiny && s_is_tiny {
        return None;
    }

    let avoids_m = m_is_finest || (!hopeful && m_is_tiny);
    let avoids_s = s_is_finest || (!hopeful && s_is_tiny);
    let along_m = if along_m { !avoids_m } else { avoids_s };

    if along_m && !m_is_finest {
        Some(vec![region.half_along_m(0), region.half_along_m(1)])
    } else if !along_m && !s_is_finest {
        Some(vec![region.half_along_s(0), region.half_along_s(1)])
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::mu_family;
    use mceip_exact::{Sparse, rational, to_f64, whole};
    use mceip_model::{ContactState, Particle, System};
    use mceip_oracle::TwoParticles;
    use mceip_paper::two_particles;

    fn cover(family: &MuFamily) -> Absence {
        absence(family, &whole(0), Limits::default(), &Watch::nobody()).unwrap()
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
            let data = TwoParticles {
                c: rational(3, 5),
                s: rational(4, 5),
                k: whole(1000),
                m: whole(2),
                mu: whole(1),
                signs,
            };

            let found = cover(&mu_family(&two_particles(&data).unwrap()).unwrap());

            let below = found.below.as_ref().map(to_f64);
            match (threshold, below) {
                (Some(t), Some(b)) => {
                    assert!(b <= t && b > t * 0.999, "{signs:?}: {found:?}, {t}");
                    assert!(!found.cut_short, "{signs:?}: {found:?}");
                }
                // At m = 1, s = 1 the family vanishes (M1 = 0): a bound beyond any friction, not
                // all of them.
                (None, b) => assert!(b.is_none_or(|b| b > 1e6), "{found:?}"),
                other => panic!("{signs:?}: {other:?} {found:?}"),
            }
        }
    }

    /// The fold of errata.md as a mechanical system: no static threshold at all, yet solutions from
    /// the fold on.
    fn fold() -> System {
        let k = Sparse::from_ints(&[
            &[1, 0, 0, 1],
            &[0, 2, -3, -4],
            &[0, -3, 99, 0],
            &[1, -4, 0, 99],
        ]);
        let slip = ContactState::Slip { sign: 1 };
        let particles = vec![Particle::plain(0, 2, slip), Particle::plain(1, 3, slip)];
        System::new(k, Some(Sparse::identity(4)), Some(whole(2)), particles).unwrap()
    }

    #[test]
    fn a_fold_is_met_before_any_static_threshold() {
        // tests/program/analyze.rs has the derivation.
        let mu_of_fold = 1.0 + 0.75f64.sqrt();

        let found = cover(&mu_family(&fold()).unwrap());

        let below = to_f64(found.below.as_ref().unwrap());
        assert!(below <= mu_of_fold, "{below} {mu_of_fold} {found:?}");
        assert!(below > 0.999 * mu_of_fold, "{below} {mu_of_fold} {found:?}");
    }
}
