//! Presence on an interval of friction: for every mu of a piece there is a solution with lambda^2
//! between two values.
//!
//! For a mechanical system the condensed pencil is affine in mu, T(t, mu) = T0(t) + mu T1(t), with
//! t = lambda^2. Over a box [t0, t1] x [low, high] it is enclosed by four corners as in `critical`.
//! The witness is that of `bordered` on the support S of the piece, with v > 0 and the pivot k.
//! Indices i, j belong to S without k.
//!
//! 1. d = v - max |I - Y T'| v > 0, the largest value of each row over the corners. So Y and T' are
//!    regular in the whole box, and v_true = -T'^-1 T_'k, 1 at k, is the only candidate for x.
//! 2. |v_true - v| <= theta v with theta = max_i |Y (T_'k + T'v)|_i / d_i, since
//!    |v_true - v| <= |Y (T_'k + T'v)| + |I - Y T'| |v_true - v|. With theta < 1, v_true > 0.
//! 3. T v_true >= 0 off the support, from the corners and theta.
//! 4. phi = T_kk - T_k' T'^-1 T_'k is continuous in t. It lies within p theta of u'Tv, with
//!    p = sum_j |T_k' + u'T'|_j v_j. On each of the edges t = t0 and t = t1 all three are bounded
//!    by their values at the two ends of [low, high] (`Edge`). If phi has one sign on one edge and
//!    the opposite one on the other, phi(., mu) has a zero in (t0, t1) for every mu.
//!
//! At such a zero x = v_true is a solution: T_SS x = 0, x > 0 on S, T x >= 0 off it.
//!
//! Where the data have radii, each member has a solution, because the ends hold its matrices too.
//!
//! Left sides that are maxima over corners bound the whole box: they are convex in T, and the radii
//! are part of them.

use super::anchors;
use super::bordered::{Bordered, NullWitness, SupportBlock};
use super::budget::WorkBudget;
use super::condensed::{AnchoredPiece, PencilParts};
use super::context::{Context, corner_bits, corners};
use super::critical::of_boxes;
use super::ends::{EndMatrix, Ends};
use super::fault::CoverFault;
use super::region::Region;
use super::root::sign_fault;
use super::walk::FaultAt;
use crate::certificate::{PresenceCertificate, PresencePiece};
use crate::pencil::FrictionParts;
use crate::reason::Reason;
use mceip_exact::{Integer, Rational};
use mceip_model::Window;
use num_traits::{One, Signed, Zero};
use std::rc::Rc;

/// Checks that the pieces follow one another from `from` to `to`, and that each holds a solution
/// for every mu.
pub(crate) fn check(
    parts: &FrictionParts,
    certificate: &PresenceCertificate,
) -> Result<(), Reason> {
    check_pieces(parts, certificate).map_err(of_boxes)
}

fn check_pieces(parts: &FrictionParts, certificate: &PresenceCertificate) -> Result<(), FaultAt> {
    let both = [&parts.plain, &parts.friction];
    let mut intervals = Vec::with_capacity(certificate.pieces.len());
    for piece in &certificate.pieces {
        let [lo, hi] = &piece.interval;
        intervals.push(AnchoredPiece {
            anchor: piece.anchor,
            lo: lo.0.clone(),
            hi: Some(hi.0.clone()),
        });
    }
    let pencil = PencilParts {
        rows: &both,
        radii: parts.radii.as_ref(),
        pieces: &intervals,
    };
    let condensation = certificate.condensation.as_ref();
    let anchors = anchors(pencil, condensation)?;

    let window = Window::all();
    let pieces = certificate.pieces.len() as u64;
    let mut context = Context::new(pencil, anchors.as_ref(), &window, pieces);
    let budget = WorkBudget::of_pieces(pieces);

    let mut low = &certificate.from;
    for (k, piece) in certificate.pieces.iter().enumerate() {
        let of_piece = |fault| FaultAt::piece(k, fault);
        let is_last = k + 1 == certificate.pieces.len();
        let high = &piece.to.0;
        check_order(low, high, &certificate.to, is_last).map_err(of_piece)?;
        context
            .use_anchor(anchors.as_ref(), piece.anchor)
            .map_err(of_piece)?;
        let friction = [low, high].map(|mu| Rc::new(mu.clone()));
        check_piece(&context, piece, friction, &budget).map_err(of_piece)?;
        low = high;
    }

    if certificate.pieces.is_empty() {
        return Err(piece_end(&certificate.to, low).into());
    }

    Ok(())
}

/// Demands that a piece ends above where it begins, and the last one at the end of the interval.
fn check_order(
    low: &Rational,
    high: &Rational,
    to: &Rational,
    is_last: bool,
) -> Result<(), CoverFault> {
    let ends_well = if is_last { high == to } else { high < to };
    if ends_well && high > low {
        return Ok(());
    }

    Err(piece_end(to, high))
}

fn piece_end(to: &Rational, got: &Rational) -> CoverFault {
    CoverFault::PieceEnd {
        expected: to.to_string(),
        got: got.to_string(),
    }
}

/// A solution for every mu in `friction`.
fn check_piece(
    context: &Context<'_>,
    piece: &PresencePiece,
    friction: [Rc<Rational>; 2],
    budget: &WorkBudget,
) -> Result<(), CoverFault> {
    let [t0, t1] = piece.interval.each_ref().map(|end| Rc::new(end.0.clone()));
    let no_interval = t0.is_negative() || t0 >= t1;
    if no_interval {
        return Err(CoverFault::Interval {
            a: Rational::clone(&t0),
            b: Rational::clone(&t1),
        });
    }

    let witness = Witness::new(piece, &context.index)?;
    let over = |lo: &Rc<Rational>, hi: &Rc<Rational>| {
        let order = context.index.len();
        Region::new(
            Rc::clone(lo),
            Some(Rc::clone(hi)),
            Some(friction.clone()),
            order,
        )
    };
    let region = over(&t0, &t1);
    let [end_bits, friction_bits] = corner_bits(&region);
    let work = NullWitness::from(piece).work(piece.support.len(), end_bits + friction_bits);
    budget.spend(work)?;

    context.affordable(&region)?;
    let ends = context.ends(&region)?;
    let corners = corners(&ends);
    let blocks = witness.bordered.blocks(&corners);

    let margin = witness.margin(&blocks)?;
    let theta = witness.theta(&blocks, &margin)?;
    witness.check_rest(&corners, &theta)?;

    let at_lower = edge(context, &over(&t0, &t0), &witness, &margin)?;
    let at_upper = edge(context, &over(&t1, &t1), &witness, &margin)?;
    if at_lower.sign() * at_upper.sign() == -1 {
        return Ok(());
    }

    Err(CoverFault::NoSignChange {
        lo: Rational::clone(&t0),
        hi: Rational::clone(&t1),
    })
}

/// What is known of phi at one value of t, where the enclosure is that of this value alone.
fn edge(
    context: &Context<'_>,
    at: &Region,
    witness: &Witness<'_>,
    margin: &[Rational],
) -> Result<Edge, CoverFault> {
    context.affordable(at)?;
    let ends = context.ends(at)?;
    let at = [0, 1].map(|end| witness.edge_end(&ends[end], margin));
    Ok(Edge { at })
}

/// At an end of [low, high] and one value of t, with a common unit: u'Tv and its radius, p, and the
/// bound of |v_true - v| as a share of v.
struct EdgeEnd {
    value: Rational,
    radius: Rational,
    residual: Rational,
    error: Rational,
}

impl EdgeEnd {
    /// How far u'Tv certainly is on the given side of zero.
    fn distance(&self, sign: i8) -> Rational {
        let value = if sign < 0 {
            -&self.value
        } else {
            self.value.clone()
        };
        value - &self.radius
    }
}

/// One value of t and every mu between low and high.
struct Edge {
    /// At low and at high.
    at: [EdgeEnd; 2],
}

impl Edge {
    /// The sign of phi for every mu of the edge, 0 if it is not certain.
    ///
    /// With mu = (1 - r) low + r high the distance l of u'Tv from zero, p and theta are at least,
    /// at most and at most the same mean of their values at low and high. So |phi| is at least
    ///
    /// ```text
    ///     (1 - r)^2 (l_0 - p_0 theta_0)
    ///         + r (1 - r) (l_0 + l_1 - p_0 theta_1 - p_1 theta_0) + r^2 (l_1 - p_1 theta_1).
    /// ```
    fn sign(&self) -> i8 {
        let [low, high] = &self.at;
        let sign = if low.value.is_negative() { -1 } else { 1 };
        let at_low = low.distance(sign);
        let at_high = high.distance(sign);
        let mixed = &low.residual * &high.error + &high.residual * &low.error;

        let is_certain = at_low > &low.residual * &low.error
            && at_high > &high.residual * &high.error
            && &at_low + &at_high > mixed;
        if is_certain { sign } else { 0 }
    }
}

/// The witness of a piece. `slip` are the indices of the positions in the matrices.
struct Witness<'a> {
    bordered: Bordered<'a>,
    slip: &'a [usize],
}

impl<'a> Witness<'a> {
    fn new(piece: &'a PresencePiece, slip: &'a [usize]) -> Result<Self, CoverFault> {
        let support = positions(&piece.support, slip)?;
        let bordered = Bordered::new(support, slip, piece.into())?;
        Ok(Witness { bordered, slip })
    }

    /// The problem's index of component i.
    fn index(&self, i: usize) -> usize {
        self.slip[self.bordered.support[i]]
    }

    /// d = v - max |I - Y T'| v over the corners, in units of v. Demands that it is positive.
    fn margin(&self, corners: &[SupportBlock<'_>]) -> Result<Vec<Rational>, CoverFault> {
        let mut margin = Vec::with_capacity(self.bordered.order());
        for i in 0..self.bordered.order() {
            let mut largest = Rational::zero();
            for corner in corners {
                largest = largest.max(self.deviation(corner, i));
            }

            let v = Rational::from_integer(self.bordered.v[i].clone());
            if largest >= v {
                let got = if v.is_positive() {
                    largest / v
                } else {
                    Rational::one()
                };
                let index = self.index(i);
                return Err(CoverFault::NotContracting { index, got });
            }

            margin.push(v - largest);
        }

        Ok(margin)
    }

    /// (|I - Y T'| v)_i at a corner, in units of v.
    fn deviation(&self, corner: &SupportBlock<'_>, i: usize) -> Rational {
        let mut sum = Integer::zero();
        for (entry, v) in self
            .bordered
            .deviation(corner, i)
            .iter()
            .zip(&self.bordered.v)
        {
            sum += entry * v;
        }

        Rational::new(sum, self.bordered.deviation_unit(corner))
    }

    /// theta over the corners. Demands that it is less than one: x is positive.
    fn theta(
        &self,
        corners: &[SupportBlock<'_>],
        margin: &[Rational],
    ) -> Result<Rational, CoverFault> {
        let mut theta = Rational::zero();
        for corner in corners {
            for (i, error) in self.errors(corner, margin).into_iter().enumerate() {
                if error >= Rational::one() {
                    return Err(sign_fault("x", self.index(i), "> 0"));
                }
                theta = theta.max(error);
            }
        }

        Ok(theta)
    }

    /// |Y (T_'k + T'v)|_i / d_i at a corner.
    fn errors(&self, corner: &SupportBlock<'_>, margin: &[Rational]) -> Vec<Rational> {
        let products = self.bordered.products(corner);
        let unit = self.bordered.deviation_unit(corner);

        let mut errors = Vec::with_capacity(margin.len());
        for (correction, d) in self.bordered.corrections(&products).into_iter().zip(margin) {
            errors.push(Rational::new(correction, unit.clone()) / d);
        }

        errors
    }

    /// Demands (T v_true)_i >= 0 for every i off the support, at all corners.
    fn check_rest(&self, corners: &[EndMatrix<'_>], theta: &Rational) -> Result<(), CoverFault> {
        let support = &self.bordered.support;
        for row in (0..self.slip.len()).filter(|row| !support.contains(row)) {
            for corner in corners {
                let line = self.bordered.line(corner.matrix, row);
                let y = self.bordered.times_v(&line);

                let mut reach = Integer::zero(); // sum of (|m| + r) v without the pivot
                for ((m, r), v) in line[..self.bordered.order()].iter().zip(&self.bordered.v) {
                    reach += (m.abs() + *r) * v;
                }

                let least = (y.center - y.radius) * theta.denom();
                if least < reach * theta.numer() {
                    return Err(sign_fault("y", self.slip[row], ">= 0"));
                }
            }
        }

        Ok(())
    }

    /// What is known of phi at the lower end, in units of 1 / its scale.
    fn edge_end(&self, ends: &Ends, margin: &[Rational]) -> EdgeEnd {
        let scale = &ends.scale;
        let corner = self.bordered.block(&ends.at[0], scale);

        let mut residual = Integer::zero();
        let left_products = self.bordered.left_products(&corner);
        for (entry, v) in left_products[..margin.len()].iter().zip(&self.bordered.v) {
            residual += entry.magnitude() * v;
        }

        let in_units = |number| Rational::new(number, scale.clone());
        let value = self.bordered.value(&self.bordered.products(&corner));
        let errors = self.errors(&corner, margin);
        EdgeEnd {
            value: in_units(value.center),
            radius: in_units(value.radius),
            residual: in_units(residual),
            error: errors.into_iter().max().unwrap_or_default(),
        }
    }
}

/// The positions of the slip variables of a support, which has to ascend.
fn positions(support: &[usize], slip: &[usize]) -> Result<Vec<usize>, CoverFault> {
    let fault = || CoverFault::SupportList {
        support: support.to_vec(),
    };
    if !support.is_sorted_by(|a, b| a < b) {
        return Err(fault());
    }

    let mut found = Vec::with_capacity(support.len());
    for index in support {
        found.push(slip.binary_search(index).map_err(|_| fault())?);
    }

    Ok(found)
}
