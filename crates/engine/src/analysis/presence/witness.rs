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

use super::super::absence::at_friction;
use super::curve::Point;
use crate::search::complete::pieces::expansion::{Ends, Expansion};
use crate::search::complete::pieces::matrix::{Matrix, principal_block, times};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::rounding::{integer, integers, rounded};
use crate::tolerance::{PRESENCE_MARGIN, ROUNDING};
use mceip_check::certificate::PresencePiece;
use mceip_exact::{Rational, from_f64};
use mceip_mcp::linear::inverse;
use mceip_model::file::Number;

/// Bits tried: of Y beyond what its products lose, and of the smallest component of v.
const BITS: [i32; 3] = [10, 22, 40];

/// A box of (lambda^2, mu).
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// The interval of lambda^2.
    pub(super) t: [f64; 2],
    /// The interval of mu.
    pub(super) mu: [f64; 2],
}

impl Place {
    fn corners(&self, expansions: &[Expansion; 2]) -> [Ends; 2] {
        let [t0, t1] = self.t;
        let ends = expansions.each_ref().map(|part| part.ends(t0, t1));
        self.mu.map(|mu| at_friction(&ends, mu))
    }

    /// The matrices at one value of lambda^2 at both ends of the interval of mu.
    fn edge(&self, expansions: &[Expansion; 2], t: f64) -> [Ends; 2] {
        let ends = expansions.each_ref().map(|part| part.ends(t, t));
        self.mu.map(|mu| at_friction(&ends, mu))
    }
}

/// Y, u and v of a box; positions are those of the slip variables.
pub(super) struct Witness {
    pivot: usize,
    /// The support without the pivot.
    rest: Vec<usize>,
    inverse: Matrix,
    /// u and v on the rest.
    left: Vec<f64>,
    right: Vec<f64>,
}

impl Witness {
    /// The witness of a point on a branch, where T is `matrix`; `None` where T' is singular to
    /// doubles, or v is not positive.
    ///
    /// The pivot k has the largest u_k x_k, with null vectors u and x: det T' is proportional to
    /// it.
    pub(super) fn of(matrix: &Matrix, point: &Point) -> Option<Witness> {
        let mut rest = point.support.clone();
        let share = |place: usize| (point.left[place] * point.x[rest[place]]).abs();
        let place = (0..rest.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
        let pivot = rest.remove(place);
        let inverse = if rest.is_empty() {
            Matrix::new()
        } else {
            inverse(&principal_block(matrix, &rest))?
        };

        let column: Vec<f64> = rest.iter().map(|&i| matrix[i][pivot]).collect();
        let right: Vec<f64> = inverse.iter().map(|row| -dot(row, &column)).collect();
        if !right.iter().all(|v| v.is_finite() && *v > 0.0) {
            return None;
        }

        let mut left = vec![0.0; rest.len()];
        for (&j, row) in rest.iter().zip(&inverse) {
            for (u, y) in left.iter_mut().zip(row) {
                *u -= matrix[pivot][j] * y;
            }
        }

        Some(Witness {
            pivot,
            rest,
            inverse,
            left,
            right,
        })
    }

    /// The piece, if the witness holds in this box; `index` gives the problem's numbers of
    /// positions.
    pub(super) fn piece(
        &self,
        place: &Place,
        expansions: &[Expansion; 2],
        index: &[usize],
    ) -> Option<PresencePiece> {
        if !self.holds(place, expansions) {
            return None;
        }

        BITS.iter().find_map(|&bits| {
            let [inverse_exponent, exponent] = self.exponents(bits, place, expansions)?;
            let short = self.rounded([inverse_exponent, exponent]);
            if !short.holds(place, expansions) {
                return None;
            }

            let mut support = short.rest.clone();
            support.push(short.pivot);
            support.sort_unstable();
            let unit = f64::from(exponent).exp2();
            Some(PresencePiece {
                to: Number(exact(place.mu[1])?),
                interval: [Number(exact(place.t[0])?), Number(exact(place.t[1])?)],
                anchor: None,
                support: support.iter().map(|&i| index[i]).collect(),
                pivot: index[short.pivot],
                inverse: integers(&short.inverse, f64::from(inverse_exponent).exp2()),
                inverse_exponent,
                left: short.left.iter().map(|u| integer(u * unit)).collect(),
                right: short.right.iter().map(|v| integer(v * unit)).collect(),
                exponent,
            })
        })
    }

    /// The binary exponents of Y, and of u and v, so that rounding moves each component of v, and
    /// each of Y T'v relative to v, by about 2^-bits.
    fn exponents(&self, bits: i32, place: &Place, expansions: &[Expansion; 2]) -> Option<[u32; 2]> {
        let smallest = self.right.iter().fold(1.0f64, |s, v| s.min(*v));
        let matrix = &place.edge(expansions, place.t[0])[0].m[0];
        let block = principal_block(matrix, &self.rest);
        let absolute: Matrix = block
            .iter()
            .map(|row| row.iter().map(|v| v.abs()).collect())
            .collect();
        let reach: f64 = times(&absolute, &self.right).iter().sum();

        let of_inverse = f64::from(bits) + (reach / smallest).max(1.0).log2();
        let of_vectors = f64::from(bits) - smallest.log2();
        let exponents = [of_inverse, of_vectors].map(|bits| bits.ceil().max(0.0));
        let is_representable = exponents.iter().all(|e| *e < f64::from(f64::MAX_EXP - 100));
        is_representable.then(|| exponents.map(|e| e as u32))
    }

    fn rounded(&self, [inverse_exponent, exponent]: [u32; 2]) -> Witness {
        let unit = f64::from(exponent).exp2();
        let vectors = rounded(&vec![self.left.clone(), self.right.clone()], unit);
        Witness {
            pivot: self.pivot,
            rest: self.rest.clone(),
            inverse: rounded(&self.inverse, f64::from(inverse_exponent).exp2()),
            left: vectors[0].clone(),
            right: vectors[1].clone(),
        }
    }

    /// Do the inequalities hold by a margin for what doubles do not see?
    fn holds(&self, place: &Place, expansions: &[Expansion; 2]) -> bool {
        let corners = place.corners(expansions);
        let Some(margin) = self.margin(&corners) else {
            return false;
        };

        let error = largest(corners_of(&corners, self).map(|corner| corner.error(&margin)));
        if error >= 1.0 - PRESENCE_MARGIN {
            return false;
        }

        let keeps_rest = corners_of(&corners, self).all(|corner| corner.keeps_rest(error));
        if !keeps_rest {
            return false;
        }

        let signs = place
            .t
            .map(|t| self.edge_sign(&place.edge(expansions, t), &margin));
        signs[0] * signs[1] < 0.0
    }

    /// d; `None` where it is not positive.
    fn margin(&self, corners: &[Ends; 2]) -> Option<Vec<f64>> {
        let mut margin = self.right.clone();
        for corner in corners_of(corners, self) {
            for (d, (v, deviation)) in margin
                .iter_mut()
                .zip(self.right.iter().zip(corner.deviation()))
            {
                *d = d.min(v - deviation);
            }
        }

        let mut components = margin.iter().zip(&self.right);
        components
            .all(|(d, v)| *d > PRESENCE_MARGIN * v)
            .then_some(margin)
    }

    /// The sign of phi on an edge, 0 if it is not certain. With l, p and theta at its ends: l
    /// exceeds p theta at both, and in the mixed term.
    fn edge_sign(&self, ends: &[Ends; 2], margin: &[f64]) -> f64 {
        let at = ends.each_ref().map(|ends| {
            let corner = Corner::of(ends, 0, self);
            let products = corner.products();
            EdgeEnd {
                value: corner.value(&products),
                residual: corner.left_residual(),
                error: corner.error(margin),
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
struct EdgeEnd {
    value: Ball,
    residual: f64,
    error: f64,
}

fn exact(v: f64) -> Option<Rational> {
    from_f64(v).ok()
}

/// The largest of non-negative numbers; infinite if one of them is none.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    let or_infinite = |v: f64| if v.is_nan() { f64::INFINITY } else { v };
    values.map(or_infinite).fold(0.0, f64::max)
}

/// Every number within `radius` of `center`.
#[derive(Clone, Copy, Default)]
struct Ball {
    center: f64,
    radius: f64,
}

impl Ball {
    /// Adds factor * (m +- r), and what rounding may cost.
    fn add(&mut self, factor: f64, m: f64, r: f64) {
        let product = factor * m;
        self.center += product;
        self.radius += factor.abs() * r + ROUNDING * product.abs();
    }

    fn magnitude(self) -> f64 {
        self.center.abs() + self.radius
    }
}

/// One corner of a box, and the witness.
struct Corner<'a> {
    witness: &'a Witness,
    m: &'a Matrix,
    r: Option<&'a Matrix>,
}

/// The four corners.
fn corners_of<'a>(
    ends: &'a [Ends; 2],
    witness: &'a Witness,
) -> impl Iterator<Item = Corner<'a>> + 'a {
    let both = ends.iter();
    both.flat_map(move |ends| [0, 1].map(|end| Corner::of(ends, end, witness)))
}

impl<'a> Corner<'a> {
    fn of(ends: &'a Ends, end: usize, witness: &'a Witness) -> Corner<'a> {
        Corner {
            witness,
            m: &ends.m[end],
            r: ends.r.as_ref(),
        }
    }

    fn radius(&self, i: usize, j: usize) -> f64 {
        self.r.map_or(0.0, |r| r[i][j])
    }

    /// |I - Y T'| v.
    fn deviation(&self) -> Vec<f64> {
        let rest = &self.witness.rest;
        let mut deviation = Vec::with_capacity(rest.len());
        for (i, row) in self.witness.inverse.iter().enumerate() {
            let mut products = vec![Ball::default(); rest.len()];
            for (y, &k) in row.iter().zip(rest) {
                for (product, &j) in products.iter_mut().zip(rest) {
                    product.add(*y, self.m[k][j], self.radius(k, j));
                }
            }

            products[i].center -= 1.0;
            let terms = products.iter().zip(&self.witness.right);
            deviation.push(terms.map(|(product, v)| product.magnitude() * v).sum());
        }

        deviation
    }

    /// (T v)_row.
    fn row_times_v(&self, row: usize) -> Ball {
        let Witness {
            pivot, rest, right, ..
        } = self.witness;
        let mut sum = Ball::default();
        sum.add(1.0, self.m[row][*pivot], self.radius(row, *pivot));
        for (v, &j) in right.iter().zip(rest) {
            sum.add(*v, self.m[row][j], self.radius(row, j));
        }

        sum
    }

    /// (T v)_i for each i of the support, the pivot last.
    fn products(&self) -> Vec<Ball> {
        let rows = self.witness.rest.iter().chain([&self.witness.pivot]);
        rows.map(|&row| self.row_times_v(row)).collect()
    }

    /// The largest component of |Y (T_'k + T'v)| / d.
    fn error(&self, margin: &[f64]) -> f64 {
        let products = self.products();
        let mut errors = Vec::with_capacity(margin.len());
        for (row, d) in self.witness.inverse.iter().zip(margin) {
            let mut sum = Ball::default();
            for (y, product) in row.iter().zip(&products) {
                sum.add(*y, product.center, product.radius);
            }
            errors.push(sum.magnitude() / d);
        }

        largest(errors.into_iter())
    }

    /// T x >= 0 at rest for every x within theta v of v?
    fn keeps_rest(&self, theta: f64) -> bool {
        let Witness {
            pivot, rest, right, ..
        } = self.witness;
        let is_at_rest = |row: &usize| row != pivot && !rest.contains(row);
        (0..self.m.len()).filter(is_at_rest).all(|row| {
            let sum = self.row_times_v(row);
            let mut reach = 0.0;
            for (v, &j) in right.iter().zip(rest) {
                reach += (self.m[row][j].abs() + self.radius(row, j)) * v;
            }
            sum.center - sum.radius >= (theta + PRESENCE_MARGIN) * reach
        })
    }

    /// p: the sum of |T_k' + u'T'|_j v_j.
    fn left_residual(&self) -> f64 {
        let Witness {
            pivot,
            rest,
            left,
            right,
            ..
        } = self.witness;
        let mut total = 0.0;
        for (v, &j) in right.iter().zip(rest) {
            let mut sum = Ball::default();
            sum.add(1.0, self.m[*pivot][j], self.radius(*pivot, j));
            for (u, &i) in left.iter().zip(rest) {
                sum.add(*u, self.m[i][j], self.radius(i, j));
            }
            total += sum.magnitude() * v;
        }

        total
    }

    /// u'Tv.
    fn value(&self, products: &[Ball]) -> Ball {
        let mut sum = Ball::default();
        for (u, product) in self.witness.left.iter().chain([&1.0]).zip(products) {
            sum.add(*u, product.center, product.radius);
        }

        sum
    }
}
