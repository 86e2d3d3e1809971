//! What a search begins with: the view of a problem, and the pieces its window is cut into.
//!
//! Without free variables the window is cut into equal steps of theta. With free variables every
//! anchor of the condensation has an interval, which is cut likewise; above the last one follows
//! the tail, the reversed anchor, or a piece that stays open. After a first look at where the
//! solutions are, each of them gets an anchor and a piece of its own ([`Prepared::refined`]). Where
//! a null vector lies so near the lower end of the window that the coarse anchors cannot tell on
//! which side, that end gets one as well ([`Prepared::with_lower_anchor`]).
//!
//! Called by `complete` (a new search) and `resume` (from the pieces of a certificate).

use super::anchor::{NEAR, OF_FAMILY, OF_WINDOW, Precisions};
use super::condense::{Condensed, DefinitePencils, condense, refine, view_of};
use super::expansion::Expansion;
use super::view::View;
use crate::reduction::zero_of;
use crate::search::complete::dyadic::short_near;
use crate::search::complete::error::CompleteError;
use crate::tolerance::{NARROW, SHARED_ANCHOR};
use mceip_check::MAX_COVERED;
use mceip_check::certificate::{CompleteSet, Condensation, Node, Piece};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Problem, Window};

/// Up to where an anchor that has no end of its own is used, in units of the pencil's scale plus
/// the begin of the interval: what lies above stays open. (A checker bounds a family that is not
/// linear in t on finite intervals only.)
const FAR: f64 = 1024.0;

/// Factor on the remainders where the checker has refused what doubles held for proved.
const CAUTION: f64 = 8.0;

/// Pieces per anchor at least.
const MIN_PIECES: usize = 4;

/// How far a cut may lie from where it should be: share of the value, of a step of theta, and of
/// the reach of an anchor about a solution.
const SLACK_OF_END: f64 = 0.01;
const SLACK_OF_STEP: f64 = 0.2;
const SLACK_OF_REACH: f64 = 0.2;

/// An interval of the window: it begins where the one before ends.
#[derive(Clone)]
pub(crate) struct AnchoredInterval {
    /// Upper end; `None` for infinity.
    pub(crate) max: Option<Rational>,
    /// The anchor of the condensation that encloses the pencil there.
    pub(crate) anchor: Option<usize>,
}

/// What a search needs before it begins.
#[derive(Clone)]
pub(crate) struct Prepared {
    pub(crate) view: View,
    pub(crate) condensation: Option<Condensation>,
    /// Smallest eigenvalue of (A_ff, B_ff), where the elimination depends on the unknown.
    pub(crate) lowest_frequency: f64,
    /// Values up to this share the anchor of the window's lower end; 0 where there is none.
    shared_up_to: f64,
    /// How anchors are expanded.
    precisions: Precisions,
    pub(crate) intervals: Vec<AnchoredInterval>,
}

impl Prepared {
    /// Condenses where there are free variables, and cuts the window into about `count` pieces.
    ///
    /// # Errors
    /// [`CompleteError`]: no complementarity variables or too many, free variables that cannot be
    /// eliminated.
    pub(crate) fn new(
        problem: &Problem,
        pencil: &Pencil,
        count: usize,
        precisions: Precisions,
    ) -> Result<Prepared, CompleteError> {
        let definite = DefinitePencils::own(pencil);
        let mut prepared = Prepared::with_precisions(problem, pencil, definite, count, precisions)?;
        prepared.view.zero = zero_of(problem);
        Ok(prepared)
    }

    /// The same for the first part of a family in the friction; the bounds of its free block and
    /// the tail, if there is one, are to hold for other pencils of the family.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub(crate) fn of_family(
        problem: &Problem,
        pencil: &Pencil,
        definite: DefinitePencils<'_>,
        count: usize,
    ) -> Result<Prepared, CompleteError> {
        Prepared::with_precisions(problem, pencil, definite, count, OF_FAMILY)
    }

    fn with_precisions(
        problem: &Problem,
        pencil: &Pencil,
        definite: DefinitePencils<'_>,
        count: usize,
        precisions: Precisions,
    ) -> Result<Prepared, CompleteError> {
        let slip = pencil.slip().len();
        if slip == 0 {
            return Err(CompleteError::NothingSlips);
        }

        if slip > MAX_COVERED {
            return Err(CompleteError::TooManySlip {
                limit: MAX_COVERED,
                got: slip,
            });
        }

        let window = problem.window();
        if !pencil.free().is_empty() {
            let condensed = condense(pencil, window, definite, precisions)?;
            return Ok(Prepared::condensed(condensed, window, count, precisions));
        }

        let view = View::of(pencil);
        let intervals = cuts(&view, window.min(), window.max(), count)
            .into_iter()
            .map(|max| AnchoredInterval { max, anchor: None })
            .collect();
        Ok(Prepared {
            view,
            condensation: None,
            lowest_frequency: 0.0,
            shared_up_to: 0.0,
            precisions,
            intervals,
        })
    }

    fn condensed(
        condensed: Condensed,
        window: &Window,
        count: usize,
        precisions: Precisions,
    ) -> Prepared {
        let division = WindowDivision {
            condensed: &condensed,
            window,
            per_anchor: count.div_ceil(condensed.ends.len()).max(MIN_PIECES),
        };

        let intervals = division.intervals();
        Prepared {
            view: condensed.view,
            condensation: Some(condensed.condensation),
            lowest_frequency: condensed.lowest_frequency,
            shared_up_to: 0.0,
            precisions,
            intervals,
        }
    }

    /// From a certificate to go on with.
    ///
    /// # Errors
    /// [`CompleteError::NoAnchor`] where the condensation has no anchor.
    pub(crate) fn again(
        problem: &Problem,
        pencil: &Pencil,
        set: &CompleteSet,
    ) -> Result<Prepared, CompleteError> {
        let mut view = match &set.condensation {
            None => View::of(pencil),
            Some(condensation) if condensation.anchors.is_empty() => {
                return Err(CompleteError::NoAnchor);
            }
            Some(condensation) => view_of(pencil, condensation),
        };

        view.zero = zero_of(problem);
        let mut intervals = Vec::new();
        for piece in &set.pieces {
            intervals.push(AnchoredInterval {
                max: piece.max.as_ref().map(|number| number.0.clone()),
                anchor: piece.anchor,
            });
        }

        Ok(Prepared {
            view,
            condensation: set.condensation.clone(),
            lowest_frequency: 0.0,
            shared_up_to: 0.0,
            precisions: OF_WINDOW,
            intervals,
        })
    }

    /// Does the elimination depend on the unknown, so that solutions deserve anchors of their own?
    pub(crate) fn is_expanded(&self) -> bool {
        self.view
            .expansions
            .iter()
            .any(|expansion| !expansion.is_linear())
    }

    /// Multiplies all remainders by [`CAUTION`], because rounding errors of their computation in
    /// doubles are not part of them. From then on leaves at infinity are not tried either. Does
    /// that change anything? Without remainders only the first time.
    pub(crate) fn enlarge_remainders(&mut self) -> bool {
        let expansions = &mut self.view.expansions;
        let is_first = expansions.iter().all(|e| e.caution == 1.0);
        for expansion in expansions.iter_mut() {
            expansion.caution *= CAUTION;
        }

        let has_remainders = expansions.iter().any(|e| !e.is_everywhere());
        is_first || has_remainders
    }

    /// The same without remainders, for a first look at where the solutions are.
    pub(crate) fn without_remainders(&self) -> Prepared {
        let expansions = self.view.expansions.iter();
        let view = View {
            index: self.view.index.clone(),
            scale: self.view.scale,
            expansions: expansions.map(Expansion::without_remainder).collect(),
            zero: self.view.zero.clone(),
        };

        Prepared {
            view,
            condensation: self.condensation.clone(),
            intervals: self.intervals.clone(),
            ..*self
        }
    }

    /// Gives each of these values (ascending) an anchor and a piece around it, cut out of the
    /// pieces there are. Values near one another share one, and those next to the lower end of the
    /// window that of [`Prepared::with_lower_anchor`].
    pub(crate) fn refined(
        mut self,
        problem: &Problem,
        pencil: &Pencil,
        values: &[f64],
    ) -> Prepared {
        self.refine_within(NEAR, problem.window(), pencil, values);
        self
    }

    /// The same with anchors that are used within `near`, relative to value + lowest frequency.
    pub(crate) fn refine_within(
        &mut self,
        near: f64,
        window: &Window,
        pencil: &Pencil,
        values: &[f64],
    ) {
        let mut apart: Vec<f64> = Vec::new();
        for &value in values.iter().filter(|v| **v > self.shared_up_to) {
            let least_distance = 3.0 * self.reach(value, near);
            if apart.last().is_none_or(|l| value - l > least_distance) {
                apart.push(value);
            }
        }

        let Some(condensation) = self.condensation.as_mut() else {
            return;
        };

        // The matrices of the anchors may have been moved elsewhere, the expansions are all here.
        let before = self.view.expansions.len();
        let fine = self.precisions.fine;
        refine(pencil, condensation, &mut self.view, &apart, fine);
        if self.view.expansions.len() != before + apart.len() {
            return; // an expansion failed: the coarse anchors stay
        }

        for (k, value) in apart.iter().enumerate() {
            let reach = self.reach(*value, near);
            let slack = SLACK_OF_REACH * reach;
            let begin = short_near(value - reach, slack);
            let end = short_near(value + reach, slack);
            if let (Some(begin), Some(end)) = (begin, end) {
                self.cut_out(window.min(), &[begin, end], before + k);
            }
        }
    }

    /// Gives the lower end of the window a fine anchor and a piece above it; `None` where the
    /// expansion fails.
    ///
    /// A null vector near that end is a threshold: it has just entered the window, or is about to.
    /// The coarse anchors misplace a value by up to a thousandth of the lowest frequency, and so
    /// leave open what lies between.
    pub(crate) fn with_lower_anchor(
        mut self,
        window: &Window,
        pencil: &Pencil,
    ) -> Option<Prepared> {
        let condensation = self.condensation.as_mut()?;
        let before = condensation.anchors.len();
        let min = to_f64(window.min());
        let fine = self.precisions.fine;
        refine(pencil, condensation, &mut self.view, &[min], fine);
        if condensation.anchors.len() == before {
            return None;
        }

        let reach = self.lower_reach(window);
        let end = short_near(min + reach, SLACK_OF_REACH * reach)?;
        self.cut_out(window.min(), &[window.min().clone(), end], before);
        self.shared_up_to = min + SHARED_ANCHOR * (min + self.lowest_frequency);
        Some(self)
    }

    /// How far above the lower end of the window an anchor at that end is used.
    fn lower_reach(&self, window: &Window) -> f64 {
        NEAR * (to_f64(window.min()) + self.lowest_frequency)
    }

    /// How many pieces begin where an anchor at the lower end of the window would be used.
    pub(crate) fn count_of_lower_pieces(&self, window: &Window) -> usize {
        let end = to_f64(window.min()) + self.lower_reach(window);
        let begins_higher = self.intervals.iter().position(|interval| {
            let max = interval.max.as_ref();
            max.is_none_or(|max| to_f64(max) >= end)
        });
        begins_higher.map_or(self.intervals.len(), |last| last + 1)
    }

    /// Up to where the anchor about a value is used: the expansions reach as far as value + lowest
    /// frequency, of which `near` is a share.
    fn reach(&self, value: f64, near: f64) -> f64 {
        let by_frequency = near * (value + self.lowest_frequency);
        by_frequency.min(0.5 * value)
    }

    /// Gives the interval [begin, end] to this anchor; the rest of the intervals that it meets
    /// stays as it is. `min` is the lower end of the window.
    fn cut_out(&mut self, min: &Rational, [begin, end]: &[Rational; 2], anchor: usize) {
        let mut intervals = Vec::new();
        let mut lo = min.clone();
        for interval in &self.intervals {
            let mut cuts = Vec::new();
            for cut in [begin, end] {
                let is_inside = *cut > lo && interval.max.as_ref().is_none_or(|max| cut < max);
                if is_inside {
                    cuts.push(cut.clone());
                }
            }

            cuts.sort();

            for max in cuts.into_iter().map(Some).chain([interval.max.clone()]) {
                // A part between begin and end belongs to the new anchor.
                let is_near = lo >= *begin && max.as_ref().is_some_and(|max| max <= end);
                lo = max.clone().unwrap_or(lo);
                let anchor = if is_near {
                    Some(anchor)
                } else {
                    interval.anchor
                };

                intervals.push(AnchoredInterval { max, anchor });
            }
        }

        self.intervals = intervals;
    }

    /// The cover with everything open, the tail excepted.
    pub(crate) fn open_set(&self) -> CompleteSet {
        let has_tail = self.condensation.as_ref().is_some_and(|c| c.tail.is_some());
        let mut pieces = Vec::new();
        for interval in &self.intervals {
            let node = if interval.max.is_none() && has_tail {
                Node::Tail
            } else {
                Node::Open
            };

            pieces.push(Piece {
                max: interval.max.clone().map(Number),
                anchor: interval.anchor,
                tree: vec![node],
            });
        }

        CompleteSet {
            condensation: self.condensation.clone(),
            pieces,
        }
    }

    /// The expansion that encloses the pencil at a value.
    pub(crate) fn expansion_at(&self, value: &Rational) -> &Expansion {
        let interval = self
            .intervals
            .iter()
            .find(|interval| interval.max.as_ref().is_none_or(|max| value <= max))
            .unwrap_or(&self.intervals[0]);
        self.view.expansion(interval.anchor)
    }
}

/// The division of a window among the anchors of a condensation.
struct WindowDivision<'a> {
    condensed: &'a Condensed,
    window: &'a Window,
    /// Pieces of each anchor.
    per_anchor: usize,
}

impl WindowDivision<'_> {
    fn intervals(&self) -> Vec<AnchoredInterval> {
        let view = &self.condensed.view;
        let anchors = self.condensed.ends.len();
        let is_unbounded = self.window.max().is_none();
        let is_closed_above = is_unbounded && self.begin_of_last().is_some();

        let mut intervals = Vec::new();
        let mut lo = self.window.min().clone();
        for anchor in 0..anchors {
            let hi = self.end_of(anchor, &lo);
            let is_last = anchor + 1 == anchors;
            let is_needed = is_last && intervals.is_empty() && !is_closed_above;
            if hi.as_ref().is_none_or(|h| *h > lo) || is_needed {
                let cuts = cuts(view, &lo, hi.as_ref(), self.per_anchor);
                intervals.extend(with_anchor(cuts, anchor));
            }

            lo = hi.filter(|h| *h > lo).unwrap_or(lo);
        }

        let ends_early = intervals.last().is_none_or(|i| i.max.is_some());
        if is_unbounded && ends_early {
            if self.condensed.beyond.is_some() {
                let cuts = cuts(view, &lo, None, self.per_anchor);
                intervals.extend(with_anchor(cuts, anchors));
            } else {
                // The tail, or what no anchor reaches.
                intervals.push(AnchoredInterval {
                    max: None,
                    anchor: None,
                });
            }
        }

        intervals
    }

    /// Where the tail or the reversed anchor begins.
    fn begin_of_last(&self) -> Option<&Rational> {
        let tail = self.condensed.condensation.tail.as_ref();
        tail.map(|tail| &tail.from.0)
            .or(self.condensed.beyond.as_ref())
    }

    /// Upper end of an anchor's interval, which begins at `lo`; `None` for infinity.
    fn end_of(&self, anchor: usize, lo: &Rational) -> Option<Rational> {
        let end = self.condensed.ends[anchor];
        let is_last = anchor + 1 == self.condensed.ends.len();
        if !is_last {
            let end = short_near(end, SLACK_OF_END * end)?;
            // A short number near the window's end may lie beyond it: then this anchor has no
            // piece.
            let is_beyond = self.window.max().is_some_and(|max| end >= *max);
            return Some(if is_beyond { lo.clone() } else { end });
        }

        // The last anchor ends where the tail or the reversed anchor begins, or with the window.
        if let Some(from) = self.begin_of_last() {
            return Some(from.clone());
        }

        let is_linear = self.condensed.view.expansions[anchor].is_linear();
        if self.window.max().is_some() || is_linear {
            return self.window.max().cloned();
        }

        // An infinite interval needs a family that is linear in t. One anchor stands for all t
        // where the free rows of B are zero in their own columns only: then there is no end.
        // A window may begin above the end: the anchor is used there too, for want of another.
        let begin = to_f64(lo);
        let end = if end.is_finite() && end > begin {
            end
        } else {
            FAR * (self.condensed.view.scale + begin)
        };

        short_near(end, SLACK_OF_END * end)
    }
}

fn with_anchor(
    cuts: Vec<Option<Rational>>,
    anchor: usize,
) -> impl Iterator<Item = AnchoredInterval> {
    cuts.into_iter().map(move |max| AnchoredInterval {
        max,
        anchor: Some(anchor),
    })
}

/// Upper ends of `count` pieces of [min, max]: equal steps of theta, at short numbers. A narrow
/// interval stays whole: doubles do not tell its parts apart, and long numbers may decide it.
fn cuts(
    view: &View,
    min: &Rational,
    max: Option<&Rational>,
    count: usize,
) -> Vec<Option<Rational>> {
    let first = view.theta(to_f64(min));
    let last = view.theta(max.map_or(f64::INFINITY, to_f64));
    if last - first < NARROW {
        return vec![max.cloned()];
    }

    let step = (last - first) / count.max(1) as f64;

    let mut ends: Vec<Option<Rational>> = Vec::new();
    for k in 1..count {
        let theta = first + step * k as f64;
        let target = view.value(theta);
        let slack = target - view.value(theta - SLACK_OF_STEP * step);
        let Some(cut) = short_near(target, slack) else {
            continue;
        };

        let before = ends.last().and_then(Option::as_ref).unwrap_or(min);
        if cut > *before && max.is_none_or(|max| cut < *max) {
            ends.push(Some(cut));
        }
    }

    ends.push(max.cloned());
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;
    use mceip_model::{Body, Unknown};

    /// One variable is free, with the frequency 1, and one slips. The tail begins above 2.3.
    fn small_pencil() -> Pencil {
        let a = Sparse::from_ints(&[&[1, 1], &[1, -2]]);
        Pencil::new(a, Sparse::identity(2), vec![0]).unwrap()
    }

    fn lambda2_problem() -> Problem {
        let body = Body::Pencil(small_pencil());
        Problem::new(body, Unknown::Lambda2, Window::all()).unwrap()
    }

    fn anchor_centers(prepared: &Prepared) -> Vec<f64> {
        let anchors = &prepared.condensation.as_ref().unwrap().anchors;
        anchors.iter().map(|a| to_f64(&a.center.0)).collect()
    }

    /// Centers are these values, rounded to 20 bits below the leading one.
    #[track_caller]
    fn assert_centers(centers: &[f64], values: &[f64]) {
        assert_eq!(centers.len(), values.len());
        for (center, value) in centers.iter().zip(values) {
            approx::assert_relative_eq!(center, value, max_relative = 1e-6);

            let is_short = center.to_bits().trailing_zeros() >= 52 - 21;
            assert!(is_short, "{center}");
        }
    }

    #[test]
    fn the_lower_end_gets_an_anchor_and_a_piece_of_the_first_one() {
        let window = Window::all();
        let pencil = small_pencil();
        let coarse = Prepared::new(&lambda2_problem(), &pencil, 16, OF_WINDOW).unwrap();
        let coarse_count = anchor_centers(&coarse).len();
        assert_eq!(coarse.count_of_lower_pieces(&window), 1);

        let lower = coarse.clone().with_lower_anchor(&window, &pencil).unwrap();

        assert_eq!(anchor_centers(&lower)[coarse_count..], [0.0]);
        assert_eq!(lower.intervals.len(), coarse.intervals.len() + 1);
        assert_eq!(lower.intervals[0].anchor, Some(coarse_count));
        assert_eq!(lower.intervals[1].anchor, coarse.intervals[0].anchor);
        assert_eq!(lower.intervals[1].max, coarse.intervals[0].max);

        let end = to_f64(lower.intervals[0].max.as_ref().unwrap());
        approx::assert_relative_eq!(end, NEAR, max_relative = 0.25);
    }

    #[test]
    fn values_next_to_the_lower_end_share_its_anchor() {
        let pencil = small_pencil();
        let problem = lambda2_problem();
        let values = [0.5 * SHARED_ANCHOR, 0.2];

        let coarse = Prepared::new(&problem, &pencil, 16, OF_WINDOW).unwrap();
        let coarse_count = anchor_centers(&coarse).len();
        let apart = coarse.clone().refined(&problem, &pencil, &values);
        assert_centers(&anchor_centers(&apart)[coarse_count..], &values);

        let lower = coarse.with_lower_anchor(&Window::all(), &pencil).unwrap();
        let shared = lower.refined(&problem, &pencil, &values);
        assert_centers(&anchor_centers(&shared)[coarse_count..], &[0.0, 0.2]);
    }
}
