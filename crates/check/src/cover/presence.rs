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
//! Left sides that are maxima over corners bound the whole box: they are convex in T, and the radii
//! are part of them.

use super::bordered::{Block, Bordered, NullWitness};
use super::budget::{WorkBudget, entries_work};
use super::critical::{PARTS, anchors, bits_of_box, families, of_file, of_piece};
use super::ends::{Ends, within_matrix_bits};
use super::family::{Family, words};
use super::fault::CoverFault;
use super::root::sign_fault;
use super::{check_size, expand_anchor};
use crate::certificate::{PresenceCertificate, PresencePiece};
use crate::pencil::FrictionParts;
use crate::reason::Reason;
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};

/// Checks that the pieces follow one another from `from` to `to`, and that each holds a solution
/// for every mu.
pub(crate) fn check(
    parts: &FrictionParts,
    certificate: &PresenceCertificate,
) -> Result<(), Reason> {
    let is_free = &parts.plain.is_free;
    let slip: Vec<usize> = (0..is_free.len()).filter(|&i| !is_free[i]).collect();
    let condensation = certificate.condensation.as_ref();
    // Each anchor is expanded for both parts.
    let expansions = condensation.map_or(0, |c| c.anchors.len().saturating_mul(2));
    check_size(slip.len(), expansions).map_err(of_file)?;

    let pieces = certificate.pieces.len() as u64;
    let anchors = anchors(parts, condensation).map_err(of_file)?;
    let mut boxes = Boxes {
        families: families(parts, anchors.as_ref()),
        slip,
        matrix_budget: WorkBudget::of_matrices([&parts.plain, &parts.friction], pieces),
        witness_budget: WorkBudget::of_pieces(pieces),
    };

    let mut low = &certificate.from;
    for (k, piece) in certificate.pieces.iter().enumerate() {
        let is_last = k + 1 == certificate.pieces.len();
        let high = &piece.to.0;
        check_order(low, high, &certificate.to, is_last).map_err(|fault| of_piece(k, fault))?;
        expand_anchor(anchors.as_ref(), &mut boxes.families, piece.anchor)
            .map_err(|fault| of_piece(k, fault))?;
        boxes
            .piece(piece, &[low.clone(), high.clone()])
            .map_err(|fault| of_piece(k, fault))?;
        low = high;
    }

    if certificate.pieces.is_empty() {
        return Err(of_file(piece_end(&certificate.to, low)));
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

/// What the check of each piece reads, and what is left of the budgets of the file.
struct Boxes {
    /// T0 and T1.
    families: [Family; 2],
    /// The slip variables: positions in matrices to indices of the pencil.
    slip: Vec<usize>,
    matrix_budget: WorkBudget,
    witness_budget: WorkBudget,
}

impl Boxes {
    /// A solution for every mu in `friction`.
    fn piece(&self, piece: &PresencePiece, friction: &[Rational; 2]) -> Result<(), CoverFault> {
        let [t0, t1] = piece.interval.each_ref().map(|end| &end.0);
        if t0.is_negative() || t0 >= t1 {
            return Err(CoverFault::Interval {
                a: t0.clone(),
                b: t1.clone(),
            });
        }

        let witness = Witness::new(piece, &self.slip)?;
        self.spend_witness(piece, [t0, t1], friction)?;

        let ends = self.ends(piece.anchor, [t0, t1], friction)?;
        let mut corners = Vec::with_capacity(4);
        for ends in &ends {
            for end in &ends.at {
                corners.push(witness.bordered.block(end, &ends.scale));
            }
        }

        let margin = witness.margin(&corners)?;
        let theta = witness.theta(&corners, &margin)?;
        witness.check_rest(&ends, &theta)?;

        let at_lower = self.edge(&witness, &margin, piece.anchor, t0, friction)?;
        let at_upper = self.edge(&witness, &margin, piece.anchor, t1, friction)?;
        if at_lower.sign() * at_upper.sign() == -1 {
            return Ok(());
        }

        Err(CoverFault::NoSignChange {
            lo: t0.clone(),
            hi: t1.clone(),
        })
    }

    /// Takes the work of a witness from the budget: the product of Y with the four corners.
    fn spend_witness(
        &self,
        piece: &PresencePiece,
        [t0, t1]: [&Rational; 2],
        friction: &[Rational; 2],
    ) -> Result<(), CoverFault> {
        let [end_bits, friction_bits] = bits_of_box(t0, Some(t1), friction.each_ref());
        let work = NullWitness::from(piece).work(piece.support.len(), end_bits + friction_bits);
        self.witness_budget.spend(work)
    }

    /// What is known of phi at one value of t, where the enclosure is that of this value alone.
    fn edge(
        &self,
        witness: &Witness<'_>,
        margin: &[Rational],
        anchor: Option<usize>,
        t: &Rational,
        friction: &[Rational; 2],
    ) -> Result<Edge, CoverFault> {
        let ends = self.ends(anchor, [t, t], friction)?;
        let at = ends.each_ref().map(|ends| {
            let corner = witness.bordered.block(&ends.at[0], &ends.scale);
            witness.edge_end(&corner, &ends.scale, margin)
        });

        Ok(Edge { at })
    }

    /// The matrices over an interval of t, at both ends of that of mu.
    fn ends(
        &self,
        anchor: Option<usize>,
        [lo, hi]: [&Rational; 2],
        friction: &[Rational; 2],
    ) -> Result<[Ends; 2], CoverFault> {
        let order = self.slip.len();
        for family in &self.families {
            family.affordable(anchor, lo, Some(hi))?;
            let work = family.matrix_work(anchor, lo, Some(hi));
            self.matrix_budget.spend(work)?;
        }

        let [end_bits, friction_bits] = bits_of_box(lo, Some(hi), friction.each_ref());
        let what = "bits of a box's matrix";
        within_matrix_bits(what, order, PARTS, end_bits + friction_bits)?;
        let products = words(end_bits).saturating_mul(words(friction_bits));
        self.matrix_budget.spend(entries_work(order, products))?;

        let plain = self.families[0].ends(anchor, lo, Some(hi))?;
        let of_friction = self.families[1].ends(anchor, lo, Some(hi))?;
        Ok(friction
            .each_ref()
            .map(|mu| plain.plus_multiple(&of_friction, mu)))
    }
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
    fn margin(&self, corners: &[Block<'_>]) -> Result<Vec<Rational>, CoverFault> {
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
    fn deviation(&self, corner: &Block<'_>, i: usize) -> Rational {
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
    fn theta(&self, corners: &[Block<'_>], margin: &[Rational]) -> Result<Rational, CoverFault> {
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
    fn errors(&self, corner: &Block<'_>, margin: &[Rational]) -> Vec<Rational> {
        let products = self.bordered.products(corner);
        let unit = self.bordered.deviation_unit(corner);

        let mut errors = Vec::with_capacity(margin.len());
        for (correction, d) in self.bordered.corrections(&products).into_iter().zip(margin) {
            errors.push(Rational::new(correction, unit.clone()) / d);
        }

        errors
    }

    /// Demands (T v_true)_i >= 0 for every i off the support, at all corners.
    fn check_rest(&self, ends: &[Ends; 2], theta: &Rational) -> Result<(), CoverFault> {
        let support = &self.bordered.support;
        for row in (0..self.slip.len()).filter(|row| !support.contains(row)) {
            for corner in ends.iter().flat_map(|ends| &ends.at) {
                let line = self.bordered.line(corner, row);
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

    /// What is known of phi at a corner in units of 1 / `scale`.
    fn edge_end(&self, corner: &Block<'_>, scale: &Integer, margin: &[Rational]) -> EdgeEnd {
        let mut residual = Integer::zero();
        let left_products = self.bordered.left_products(corner);
        for (entry, v) in left_products[..margin.len()].iter().zip(&self.bordered.v) {
            residual += entry.magnitude() * v;
        }

        let in_units = |number| Rational::new(number, scale.clone());
        let value = self.bordered.value(&self.bordered.products(corner));
        let errors = self.errors(corner, margin);
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
