//! The view of a problem and the pieces its window is cut into before the search.

use crate::search::complete::error::CompleteError;
use crate::search::complete::leaf::root::null_vector;
use crate::search::complete::pieces::anchor::NEAR;
use crate::search::complete::pieces::condense::{condense, refine, view_of};
use crate::search::complete::pieces::view::{Expansion, View};
use crate::search::complete::region::State;
use crate::search::complete::tree::short;
use crate::tolerance::SAME_ROOT;
use mceip_check::certificate::{CompleteSet, Condensation, Node, Piece};
use mceip_check::{AcceptedClaim, MAX_COVERED};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::Number;
use mceip_model::{Pencil, Problem};

/// What a search needs before it begins.
pub(crate) struct Prepared {
    pub(crate) view: View,
    condensation: Option<Condensation>,
    /// Smallest eigenvalue of (A_ff, B_ff), where the elimination depends on the unknown.
    base: f64,
    /// Upper end and anchor of each piece.
    pieces: Vec<(Option<Rational>, Option<usize>)>,
}

impl Prepared {
    /// Condenses where there are free variables, and cuts the window into about `count` pieces.
    pub(crate) fn new(
        problem: &Problem,
        pencil: &Pencil,
        count: usize,
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
        if pencil.free().is_empty() {
            let view = View::of(pencil);
            let pieces = cuts(&view, window.min(), window.max(), count)
                .into_iter()
                .map(|max| (max, None))
                .collect();
            return Ok(Prepared {
                view,
                condensation: None,
                base: 0.0,
                pieces,
            });
        }
        let condensed = condense(pencil, window)?;
        let view = condensed.view;
        let mut pieces = Vec::new();
        let mut lo = window.min().clone();
        let each = count.div_ceil(condensed.ends.len()).max(MIN_PIECES);
        for (anchor, end) in condensed.ends.iter().enumerate() {
            let is_last = anchor + 1 == condensed.ends.len();
            let tail = condensed
                .condensation
                .tail
                .as_ref()
                .map(|t| &t.from.0)
                .or(condensed.beyond.as_ref());
            // The last anchor ends where the tail or the reversed anchor begins, or with the
            // window.
            let hi = match (is_last, tail) {
                (true, Some(from)) => Some(from.clone()),
                // An infinite interval needs a family that is linear in t.
                (true, None) if window.max().is_none() && view.expansions[anchor].z.len() > 2 => {
                    // One anchor for all t, where free rows of B are zero in their own columns
                    // only: search up to here.
                    let end = if end.is_finite() {
                        *end
                    } else {
                        FAR * view.scale
                    };
                    short(end, 0.01 * end)
                }
                (true, None) => window.max().cloned(),
                // A short number near the window's end may lie beyond it: then this anchor has no
                // piece.
                (false, _) => short(*end, 0.01 * end).map(|h| {
                    if window.max().is_some_and(|m| h >= *m) {
                        lo.clone()
                    } else {
                        h
                    }
                }),
            };
            let above = hi.as_ref().is_none_or(|h| *h > lo);
            let has_tail = tail.is_some() && window.max().is_none();
            if above || (is_last && pieces.is_empty() && !has_tail) {
                pieces.extend(
                    cuts(&view, &lo, hi.as_ref(), each)
                        .into_iter()
                        .map(|max| (max, Some(anchor))),
                );
            }
            lo = hi.filter(|h| *h > lo).unwrap_or(lo);
        }
        if window.max().is_none() && pieces.last().is_none_or(|p| p.0.is_some()) {
            match condensed.beyond {
                Some(_) => {
                    let each = count.div_ceil(condensed.ends.len()).max(MIN_PIECES);
                    let reversed = Some(condensed.ends.len());
                    pieces.extend(
                        cuts(&view, &lo, None, each)
                            .into_iter()
                            .map(|max| (max, reversed)),
                    );
                }
                None => pieces.push((None, None)), // the tail, or what no anchor reaches
            }
        }
        Ok(Prepared {
            view,
            condensation: Some(condensed.condensation),
            base: condensed.base,
            pieces,
        })
    }

    /// Does the elimination depend on the unknown, so that solutions deserve anchors of their own?
    pub(crate) fn is_expanded(&self) -> bool {
        self.view.expansions.iter().any(|e| e.z.len() > 2)
    }

    /// Takes the remainders for larger than doubles say they are, and no longer believes them at
    /// infinity; does that change anything? Without remainders only the first time.
    pub(crate) fn beware(&mut self) -> bool {
        let is_first = self.view.expansions.iter().all(|e| e.caution == 1.0);
        self.view
            .expansions
            .iter_mut()
            .for_each(|e| e.caution *= CAUTION);
        is_first || self.view.expansions.iter().any(|e| !e.is_everywhere())
    }

    /// The same without remainders, for a first look.
    pub(crate) fn scout(&self) -> Prepared {
        let expansions = self
            .view
            .expansions
            .iter()
            .map(Expansion::without_remainder)
            .collect();
        let view = View {
            index: self.view.index.clone(),
            scale: self.view.scale,
            expansions,
        };
        Prepared {
            view,
            condensation: self.condensation.clone(),
            base: self.base,
            pieces: self.pieces.clone(),
        }
    }

    /// Gives each of these values an anchor and a piece around it, cut out of the pieces there are.
    pub(crate) fn refined(
        mut self,
        problem: &Problem,
        pencil: &Pencil,
        values: &[f64],
    ) -> Prepared {
        let mut apart: Vec<f64> = Vec::new();
        for v in values.iter().filter(|v| **v > 0.0) {
            if apart
                .last()
                .is_none_or(|last| v - last > 3.0 * self.reach(*v))
            {
                apart.push(*v);
            }
        }
        let Some(condensation) = self.condensation.as_mut() else {
            return self;
        };
        let before = condensation.anchors.len();
        refine(pencil, condensation, &mut self.view, &apart);
        if condensation.anchors.len() != before + apart.len() {
            return self; // an expansion failed: the coarse anchors stay
        }
        for (k, v) in apart.iter().enumerate() {
            self.cut_out(problem.window().min(), *v, before + k);
        }
        self
    }

    /// Up to where the anchor about a value is used: the expansions reach as far as value + lowest
    /// frequency.
    fn reach(&self, v: f64) -> f64 {
        (NEAR * (v + self.base)).min(0.5 * v)
    }

    /// The piece around v with this anchor, the rest of the pieces it meets as before.
    fn cut_out(&mut self, min: &Rational, v: f64, anchor: usize) {
        let near = self.reach(v);
        let (Some(a), Some(b)) = (short(v - near, 0.2 * near), short(v + near, 0.2 * near)) else {
            return;
        };
        let inside = |t: &Rational, lo: &Rational, hi: &Option<Rational>| {
            t > lo && hi.as_ref().is_none_or(|h| t < h)
        };
        let mut out: Vec<(Option<Rational>, Option<usize>)> = Vec::new();
        let mut lo = min.clone();
        for (hi, own) in &self.pieces {
            let mut cuts: Vec<Rational> = [&a, &b]
                .into_iter()
                .filter(|t| inside(t, &lo, hi))
                .cloned()
                .collect();
            cuts.sort();
            for max in cuts.into_iter().map(Some).chain([hi.clone()]) {
                // A part between a and b belongs to the new anchor.
                let is_near = lo >= a && max.as_ref().is_some_and(|m| *m <= b);
                lo = max.clone().unwrap_or_else(|| lo.clone());
                out.push((max, if is_near { Some(anchor) } else { *own }));
            }
        }
        self.pieces = out;
    }

    /// From a certificate to go on with.
    pub(crate) fn again(pencil: &Pencil, set: &CompleteSet) -> Result<Prepared, CompleteError> {
        let view = match &set.condensation {
            None => View::of(pencil),
            Some(condensation) if condensation.anchors.is_empty() => {
                return Err(CompleteError::NoAnchor);
            }
            Some(condensation) => view_of(pencil, condensation),
        };
        let pieces = set
            .pieces
            .iter()
            .map(|p| (p.max.as_ref().map(|n| n.0.clone()), p.anchor))
            .collect();
        Ok(Prepared {
            view,
            condensation: set.condensation.clone(),
            base: 0.0,
            pieces,
        })
    }

    /// The cover with everything open, the tail excepted.
    pub(crate) fn open_set(&self) -> CompleteSet {
        let has_tail = self.condensation.as_ref().is_some_and(|c| c.tail.is_some());
        let node = |max: &Option<Rational>| {
            if max.is_none() && has_tail {
                Node::Tail
            } else {
                Node::Open
            }
        };
        let piece = |(max, anchor): &(Option<Rational>, Option<usize>)| Piece {
            max: max.clone().map(Number),
            anchor: *anchor,
            tree: vec![node(max)],
        };
        CompleteSet {
            condensation: self.condensation.clone(),
            pieces: self.pieces.iter().map(piece).collect(),
        }
    }

    /// x of an accepted solution over all variables of the pencil, e'x_s = 1, in doubles.
    pub(crate) fn shape(&self, pencil: &Pencil, solution: &AcceptedClaim) -> Vec<f64> {
        let (lo, hi) = (to_f64(solution.value.lo()), to_f64(solution.value.hi()));
        let t = to_f64(&solution.value.mid());
        let piece = self
            .pieces
            .iter()
            .position(|(max, _)| max.as_ref().is_none_or(|m| solution.value.lo() <= m))
            .unwrap_or(0);
        let expansion = self.view.expansion(self.pieces[piece].1);
        let moves = |i: &usize| {
            if solution.support.contains(i) {
                State::Moving
            } else {
                State::Rest
            }
        };
        let states: Vec<State> = self.view.index.iter().map(moves).collect();
        let reach = (hi - lo).max(SAME_ROOT * t.abs()).max(f64::MIN_POSITIVE);
        let x = null_vector(expansion, &states, t - reach, t + reach)
            .map_or_else(|| vec![f64::NAN; states.len()], |n| n.spread(states.len()));
        let sum: f64 = x.iter().sum();
        let mut out = vec![0.0; pencil.order()];
        self.view
            .index
            .iter()
            .zip(&x)
            .for_each(|(&i, v)| out[i] = v / sum);
        if let Some(free) = expansion.free_part(t, &x) {
            pencil
                .free()
                .iter()
                .zip(free)
                .for_each(|(&i, v)| out[i] = v / sum);
        }
        out
    }
}

/// Up to where an anchor that has no end of its own is used, in units of the pencil's scale: what
/// lies above stays open. (A checker bounds a family that is not linear in t on finite intervals
/// only.)
const FAR: f64 = 1024.0;

/// Factor on the remainders where the checker has refused what doubles held for proved.
const CAUTION: f64 = 8.0;

/// Pieces per anchor at least.
const MIN_PIECES: usize = 4;

/// Upper ends of `count` pieces of [min, max]: equal steps of theta, at short numbers.
fn cuts(
    view: &View,
    min: &Rational,
    max: Option<&Rational>,
    count: usize,
) -> Vec<Option<Rational>> {
    let (a, b) = (
        view.theta(to_f64(min)),
        view.theta(max.map_or(f64::INFINITY, to_f64)),
    );
    let step = (b - a) / count.max(1) as f64;
    let mut ends: Vec<Option<Rational>> = Vec::new();
    for k in 1..count {
        let theta = a + step * k as f64;
        let v = view.value(theta);
        let cut = short(v, v - view.value(theta - 0.2 * step));
        let last = ends.last().and_then(Option::as_ref).unwrap_or(min);
        if cut
            .as_ref()
            .is_some_and(|c| c > last && max.is_none_or(|m| c < m))
        {
            ends.push(cut);
        }
    }
    ends.push(max.cloned());
    ends
}
