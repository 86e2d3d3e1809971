//! The witness of a box of (t, mu) that holds a solution for each of its mu, in doubles.
//!
//! S is the support, k its pivot, T' the block of T on S without k; all indices below are of S
//! without k. The witness is Y ~ T'^-1 and u, v ~ the null vectors of T_SS that are 1 at k, all
//! from one point in the box. The box holds a solution for every mu if v > 0 and
//!
//! ```text
//!     d = v - max |I - Y T'| v > 0,    theta = max |Y (T_'k + T'v)| / d < 1,
//!     (T v)_i >= theta sum_(j != k) |T_ij| v_j    for each i at rest,
//! ```
//!
//! largest values over the four corners, radii included, and if u'Tv - p theta, with
//! p = |T_k' + u'T'| v, has opposite signs on the edges t = t0 and t = t1 (`spec/certificates.md`,
//! 5.19). theta and p are of first order in the size of the box, and u'Tv is on its edges.
//!
//! Doubles propose a witness that holds by a margin, with the fewest bits that still do. Called by
//! `climb`; the checker's side is `check::cover::presence`.

use crate::bordered::{BoxCorner, DoubleBall, NullVectors, largest};
use crate::branch::BranchPoint;
use crate::search::complete::pieces::expansion::{ChordEnds, Expansion};
use crate::search::complete::pieces::matrix::{SquareMatrix, absolute, principal_block, times};
use crate::tolerance::PRESENCE_MARGIN;
use mceip_check::certificate::PresencePiece;
use mceip_exact::{Rational, from_f64};
use mceip_model::file::Number;

/// Bits tried: of Y beyond what its products lose, and of the smallest component of v.
const BITS: [i32; 3] = [10, 22, 40];

/// A box of (lambda^2, mu).
#[derive(Debug, Clone, Copy)]
pub(super) struct CurveBox {
    /// The interval of lambda^2.
    pub(super) t: [f64; 2],
    /// The interval of mu.
    pub(super) mu: [f64; 2],
}

impl CurveBox {
    fn corners(&self, expansions: &[Expansion; 2]) -> [ChordEnds; 2] {
        let [t0, t1] = self.t;
        let ends = expansions.each_ref().map(|part| part.ends(t0, t1));
        self.mu
            .map(|mu| ChordEnds::at_friction(ends.each_ref(), mu))
    }

    /// The matrices at one value of lambda^2 at both ends of the interval of mu.
    fn edge(&self, expansions: &[Expansion; 2], t: f64) -> [ChordEnds; 2] {
        let ends = expansions.each_ref().map(|part| part.ends(t, t));
        self.mu
            .map(|mu| ChordEnds::at_friction(ends.each_ref(), mu))
    }
}

/// Y, u and v of a box.
pub(super) struct PresenceWitness(NullVectors);

impl PresenceWitness {
    /// The witness of a point on a branch, where T is `matrix`; `None` where T' is singular to
    /// doubles, or v is not positive.
    ///
    /// The pivot k has the largest u_k x_k, with null vectors u and x: det T' is proportional to
    /// it.
    pub(super) fn of(matrix: &SquareMatrix, point: &BranchPoint) -> Option<PresenceWitness> {
        let support = &point.support;
        let share = |place: usize| (point.left[place] * point.x[support[place]]).abs();
        let place = (0..support.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;

        let vectors = NullVectors::of(matrix, support, place)?;
        let is_positive = vectors.right.iter().all(|v| v.is_finite() && *v > 0.0);
        is_positive.then_some(PresenceWitness(vectors))
    }

    /// The piece, if the witness holds in this box; `index` gives the problem's numbers of
    /// positions.
    pub(super) fn piece(
        &self,
        place: &CurveBox,
        expansions: &[Expansion; 2],
        index: &[usize],
    ) -> Option<PresencePiece> {
        if !self.holds(place, expansions) {
            return None;
        }

        BITS.iter()
            .find_map(|&bits| self.rounded_piece(bits, place, expansions, index))
    }

    /// The piece with numbers of so many bits, if the witness still holds.
    fn rounded_piece(
        &self,
        bits: i32,
        place: &CurveBox,
        expansions: &[Expansion; 2],
        index: &[usize],
    ) -> Option<PresencePiece> {
        let [inverse_exponent, exponent] = self.exponents(bits, place, expansions)?;
        let [inverse_unit, unit] = [inverse_exponent, exponent].map(|e| f64::from(e).exp2());
        let short = PresenceWitness(self.0.rounded(inverse_unit, unit));
        if !short.holds(place, expansions) {
            return None;
        }

        let NullVectors { pivot, rest, .. } = &short.0;
        let mut support: Vec<usize> = rest.iter().map(|&i| index[i]).collect();
        support.push(index[*pivot]);
        support.sort_unstable();

        let integers = short.0.integers(inverse_unit, unit);
        Some(PresencePiece {
            to: Number(exact(place.mu[1])?),
            interval: [Number(exact(place.t[0])?), Number(exact(place.t[1])?)],
            anchor: None,
            support,
            pivot: index[*pivot],
            inverse: integers.inverse,
            inverse_exponent,
            left: integers.left,
            right: integers.right,
            exponent,
        })
    }

    /// The binary exponents of Y, and of u and v, so that rounding moves each component of v, and
    /// each of Y T'v relative to v, by about 2^-bits.
    fn exponents(
        &self,
        bits: i32,
        place: &CurveBox,
        expansions: &[Expansion; 2],
    ) -> Option<[u32; 2]> {
        let NullVectors { rest, right, .. } = &self.0;
        let smallest = right.iter().fold(1.0f64, |s, v| s.min(*v));
        let matrix = &place.edge(expansions, place.t[0])[0].m[0];
        let block = absolute(&principal_block(matrix, rest));
        let reach: f64 = times(&block, right).iter().sum();

        let of_inverse = f64::from(bits) + (reach / smallest).max(1.0).log2();
        let of_vectors = f64::from(bits) - smallest.log2();
        let exponents = [of_inverse, of_vectors].map(|bits| bits.ceil().max(0.0));
        let is_representable = exponents.iter().all(|e| *e < f64::from(f64::MAX_EXP - 100));
        is_representable.then(|| exponents.map(|e| e as u32))
    }

    /// Do the inequalities hold by a margin for what doubles do not see?
    fn holds(&self, place: &CurveBox, expansions: &[Expansion; 2]) -> bool {
        let corners = place.corners(expansions);
        let Some(margin) = self.margin(&corners) else {
            return false;
        };

        let error = largest(
            self.0
                .corners(&corners)
                .map(|corner| error(&corner, &margin)),
        );
        if error >= 1.0 - PRESENCE_MARGIN || !self.keeps_rest(&corners, error) {
            return false;
        }

        let signs = place
            .t
            .map(|t| self.edge_sign(&place.edge(expansions, t), &margin));
        signs[0] * signs[1] < 0.0
    }

    /// d; `None` where it is not positive.
    fn margin(&self, corners: &[ChordEnds; 2]) -> Option<Vec<f64>> {
        let v = &self.0.right;
        let mut margin = v.clone();
        for corner in self.0.corners(corners) {
            let deviations = corner.deviations(v);
            for (i, deviation) in deviations.into_iter().enumerate() {
                margin[i] = margin[i].min(v[i] - deviation);
            }
        }

        let mut components = margin.iter().zip(v);
        let is_positive = components.all(|(d, v)| *d > PRESENCE_MARGIN * v);
        is_positive.then_some(margin)
    }

    /// T x >= 0 at rest for every x within theta v of v?
    fn keeps_rest(&self, corners: &[ChordEnds; 2], theta: f64) -> bool {
        let NullVectors { pivot, rest, .. } = &self.0;
        let order = corners[0].m[0].len();
        let at_rest: Vec<usize> = (0..order)
            .filter(|row| row != pivot && !rest.contains(row))
            .collect();

        self.0.corners(corners).all(|corner| {
            let holds = |row: usize| {
                let sum = corner.row_times_v(row);
                sum.center - sum.radius >= (theta + PRESENCE_MARGIN) * corner.reach(row)
            };
            at_rest.iter().all(|&row| holds(row))
        })
    }

    /// The sign of phi on an edge, 0 if it is not certain. With l, p and theta at its ends: l
    /// exceeds p theta at both, and in the mixed term.
    fn edge_sign(&self, ends: &[ChordEnds; 2], margin: &[f64]) -> f64 {
        let at = ends.each_ref().map(|ends| {
            let corner = BoxCorner::of(ends, 0, &self.0);
            EdgeEstimate {
                value: corner.value(&corner.products()),
                residual: corner.left_residual(&self.0.right),
                error: error(&corner, margin),
            }
        });

        let sign = at[0].value.center.signum();
        let [low, high] = &at;
        let distances = [low, high].map(|end| sign * end.value.center - end.value.radius);
        let mixed = low.residual * high.error + high.residual * low.error;
        let factor = 1.0 + PRESENCE_MARGIN;
        let is_certain = distances[0] > factor * low.residual * low.error
            && distances[1] > factor * high.residual * high.error
            && distances[0] + distances[1] > factor * mixed;
        if is_certain { sign } else { 0.0 }
    }
}

/// What is known at an end of an edge: u'Tv, p and theta.
struct EdgeEstimate {
    value: DoubleBall,
    residual: f64,
    error: f64,
}

fn exact(v: f64) -> Option<Rational> {
    from_f64(v).ok()
}

/// The largest component of |Y (T_'k + T'v)| / d at a corner.
fn error(corner: &BoxCorner<'_>, margin: &[f64]) -> f64 {
    let errors = corner.errors(&corner.products());
    largest(errors.into_iter().zip(margin).map(|(error, d)| error / d))
}
