//! An approximate inverse and null vectors of T on a support, and what they are worth where T is
//! known up to radii, in doubles.
//!
//! S is the support, k in S its *pivot*, T' the block of T on S without k, which is called the
//! *rest*. The witness is Y ~ T'^-1 and u, v ~ left and right null vectors of T_SS that are 1 at k;
//! from one matrix come
//!
//! ```text
//!     v = -Y T_'k,    u' = -T_k' Y.
//! ```
//!
//! At a corner, where each entry of T is known up to a radius, the residuals are bounded that the
//! leaves `root` and `regular` (5.11 and 5.18 of `spec/certificates.md`) and pieces of presence
//! (5.19) speak of. What is bounded of the left null vector is bounded of the right one of the
//! transpose ([`NullVectors::mirrored`]). Called by the makers of these; the checker's side is
//! `check::cover::bordered`.

use crate::dense::transposed;
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::pieces::matrix::{SquareMatrix, principal_block};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::rounding::{integers, rounded};
use crate::tolerance::ROUNDING;
use mceip_exact::Integer;
use mceip_mcp::linear::inverse;

/// Y, u and v; positions are those of the complementarity variables.
pub(crate) struct NullVectors {
    pub(crate) pivot: usize,
    /// The support without the pivot.
    pub(crate) rest: Vec<usize>,
    /// Y.
    pub(crate) inverse: SquareMatrix,
    /// u and v on the rest.
    pub(crate) left: Vec<f64>,
    pub(crate) right: Vec<f64>,
}

/// The same as integers in units of powers of two, as certificates spell them.
pub(crate) struct IntegerVectors {
    pub(crate) inverse: Vec<Vec<Integer>>,
    pub(crate) left: Vec<Integer>,
    pub(crate) right: Vec<Integer>,
}

impl NullVectors {
    /// Those of a matrix with the pivot at a place of the support; `None` where T' is singular to
    /// doubles, or there is no such place.
    pub(crate) fn of(
        matrix: &SquareMatrix,
        support: &[usize],
        place: usize,
    ) -> Option<NullVectors> {
        let pivot = *support.get(place)?;
        let mut rest = support.to_vec();
        rest.remove(place);
        let inverse = if rest.is_empty() {
            SquareMatrix::new()
        } else {
            inverse(&principal_block(matrix, &rest))?
        };

        let column: Vec<f64> = rest.iter().map(|&i| matrix[i][pivot]).collect();
        let right = inverse.iter().map(|row| -dot(row, &column)).collect();

        let mut left = vec![0.0; rest.len()];
        for (&j, row) in rest.iter().zip(&inverse) {
            for (u, y) in left.iter_mut().zip(row) {
                *u -= matrix[pivot][j] * y;
            }
        }

        Some(NullVectors {
            pivot,
            rest,
            inverse,
            left,
            right,
        })
    }

    /// The witness for the transpose.
    pub(crate) fn mirrored(&self) -> NullVectors {
        NullVectors {
            pivot: self.pivot,
            rest: self.rest.clone(),
            inverse: transposed(&self.inverse),
            left: self.right.clone(),
            right: self.left.clone(),
        }
    }

    /// Positions of the support, the pivot last.
    pub(crate) fn support(&self) -> Vec<usize> {
        let mut support = self.rest.clone();
        support.push(self.pivot);
        support
    }

    /// Rounded to multiples of 1 / `inverse_unit` and, u and v, of 1 / `unit`.
    pub(crate) fn rounded(&self, inverse_unit: f64, unit: f64) -> NullVectors {
        let [left, right] = [&self.left, &self.right]
            .map(|vector| vector.iter().map(|v| (v * unit).round() / unit));
        NullVectors {
            pivot: self.pivot,
            rest: self.rest.clone(),
            inverse: rounded(&self.inverse, inverse_unit),
            left: left.collect(),
            right: right.collect(),
        }
    }

    /// The integers of rounded vectors.
    pub(crate) fn integers(&self, inverse_unit: f64, unit: f64) -> IntegerVectors {
        let [left, right] =
            [&self.left, &self.right].map(|vector| integers(&vec![vector.clone()], unit).concat());
        IntegerVectors {
            inverse: integers(&self.inverse, inverse_unit),
            left,
            right,
        }
    }

    /// The corners at both ends of each interval.
    pub(crate) fn corners<'a>(
        &'a self,
        ends: &'a [ChordEnds],
    ) -> impl Iterator<Item = BoxCorner<'a>> {
        let both = ends.iter();
        both.flat_map(move |ends| [0, 1].map(|end| BoxCorner::of(ends, end, self)))
    }
}

/// Every number within `radius` of `center`.
#[derive(Clone, Copy, Default)]
pub(crate) struct DoubleBall {
    pub(crate) center: f64,
    pub(crate) radius: f64,
}

impl DoubleBall {
    /// Adds factor * other, and what rounding may cost.
    fn add(&mut self, factor: f64, other: DoubleBall) {
        let product = factor * other.center;
        self.center += product;
        self.radius += factor.abs() * other.radius + ROUNDING * product.abs();
    }

    /// The sign of all these numbers, 0 if they differ.
    pub(crate) fn sign(self) -> i8 {
        if self.center > self.radius {
            1
        } else if -self.center > self.radius {
            -1
        } else {
            0
        }
    }

    /// The largest absolute value.
    pub(crate) fn magnitude(self) -> f64 {
        self.center.abs() + self.radius
    }
}

/// One corner of a box: every matrix within `r` of `m`.
pub(crate) struct BoxCorner<'a> {
    vectors: &'a NullVectors,
    m: &'a SquareMatrix,
    /// `None` where the matrix is known exactly.
    r: Option<&'a SquareMatrix>,
    /// Is the transpose meant?
    is_mirrored: bool,
}

impl<'a> BoxCorner<'a> {
    /// The corner at an end of an interval.
    pub(crate) fn of(ends: &'a ChordEnds, end: usize, vectors: &'a NullVectors) -> BoxCorner<'a> {
        BoxCorner {
            vectors,
            m: &ends.m[end],
            r: ends.radius(end),
            is_mirrored: false,
        }
    }

    /// The transpose at an end of an interval, with the witness for it.
    pub(crate) fn mirrored(
        ends: &'a ChordEnds,
        end: usize,
        vectors: &'a NullVectors,
    ) -> BoxCorner<'a> {
        BoxCorner {
            is_mirrored: true,
            ..BoxCorner::of(ends, end, vectors)
        }
    }

    /// Order of T'.
    pub(crate) fn order(&self) -> usize {
        self.vectors.rest.len()
    }

    /// An entry and its radius.
    pub(crate) fn entry(&self, i: usize, j: usize) -> DoubleBall {
        let [i, j] = if self.is_mirrored { [j, i] } else { [i, j] };
        DoubleBall {
            center: self.m[i][j],
            radius: self.r.map_or(0.0, |r| r[i][j]),
        }
    }

    /// |I - Y T'| times weights: a bound for each row.
    pub(crate) fn deviations(&self, weights: &[f64]) -> Vec<f64> {
        let rest = &self.vectors.rest;
        let mut deviations = Vec::with_capacity(rest.len());
        for (i, row) in self.vectors.inverse.iter().enumerate() {
            let mut products = vec![DoubleBall::default(); rest.len()];
            for (y, &k) in row.iter().zip(rest) {
                for (product, &j) in products.iter_mut().zip(rest) {
                    product.add(*y, self.entry(k, j));
                }
            }

            products[i].center -= 1.0;
            let terms = products.iter().zip(weights);
            deviations.push(terms.map(|(product, w)| product.magnitude() * w).sum());
        }

        deviations
    }

    /// (T v)_row.
    pub(crate) fn row_times_v(&self, row: usize) -> DoubleBall {
        let NullVectors {
            pivot, rest, right, ..
        } = self.vectors;
        let mut sum = DoubleBall::default();
        sum.add(1.0, self.entry(row, *pivot));
        for (v, &j) in right.iter().zip(rest) {
            sum.add(*v, self.entry(row, j));
        }

        sum
    }

    /// (T v)_i for each i of the support, the pivot last.
    pub(crate) fn products(&self) -> Vec<DoubleBall> {
        let rows = self.vectors.rest.iter().chain([&self.vectors.pivot]);
        rows.map(|&row| self.row_times_v(row)).collect()
    }

    /// |Y (T_'k + T'v)|: a bound for each component; `products` is T v.
    pub(crate) fn errors(&self, products: &[DoubleBall]) -> Vec<f64> {
        let mut errors = Vec::with_capacity(self.vectors.rest.len());
        for row in &self.vectors.inverse {
            let mut sum = DoubleBall::default();
            for (y, product) in row.iter().zip(products) {
                sum.add(*y, *product);
            }
            errors.push(sum.magnitude());
        }

        errors
    }

    /// The sum of |T_k' + u'T'|_j times weights.
    pub(crate) fn left_residual(&self, weights: &[f64]) -> f64 {
        let NullVectors {
            pivot, rest, left, ..
        } = self.vectors;
        let mut total = 0.0;
        for (weight, &j) in weights.iter().zip(rest) {
            let mut sum = DoubleBall::default();
            sum.add(1.0, self.entry(*pivot, j));
            for (u, &i) in left.iter().zip(rest) {
                sum.add(*u, self.entry(i, j));
            }
            total += sum.magnitude() * weight;
        }

        total
    }

    /// u'Tv; `products` is T v.
    pub(crate) fn value(&self, products: &[DoubleBall]) -> DoubleBall {
        let mut sum = DoubleBall::default();
        for (u, product) in self.vectors.left.iter().chain([&1.0]).zip(products) {
            sum.add(*u, *product);
        }

        sum
    }

    /// The sum over the rest of |T_row,j| v_j, radii included.
    pub(crate) fn reach(&self, row: usize) -> f64 {
        let NullVectors { rest, right, .. } = self.vectors;
        let mut reach = 0.0;
        for (v, &j) in right.iter().zip(rest) {
            reach += self.entry(row, j).magnitude() * v;
        }

        reach
    }
}

/// The largest of numbers that are not negative; infinite if one of them is no number.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut largest: f64 = 0.0;
    for value in values {
        let is_number = !value.is_nan();
        largest = largest.max(if is_number { value } else { f64::INFINITY });
    }

    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// T = [[2, 1, 4], [1, 3, 5], [6, 7, 8]] on {0, 1, 2} with the pivot 2.
    fn matrix() -> SquareMatrix {
        vec![
            vec![2.0, 1.0, 4.0],
            vec![1.0, 3.0, 5.0],
            vec![6.0, 7.0, 8.0],
        ]
    }

    fn exact_ends(matrix: &SquareMatrix) -> ChordEnds {
        ChordEnds {
            lo: 0.0,
            hi: 1.0,
            m: [matrix.clone(), matrix.clone()],
            r: None,
            slope: None,
        }
    }

    #[test]
    fn residuals_vanish_where_the_vectors_come_from() {
        let matrix = matrix();
        let vectors = NullVectors::of(&matrix, &[0, 1, 2], 2).unwrap();
        // T'^-1 = [[3, -1], [-1, 2]] / 5.
        assert_relative_eq!(vectors.right[0], -7.0 / 5.0, max_relative = 1e-14);
        assert_relative_eq!(vectors.left[1], -8.0 / 5.0, max_relative = 1e-14);

        let ends = exact_ends(&matrix);
        let corner = BoxCorner::of(&ends, 0, &vectors);
        let products = corner.products();
        assert!(largest(corner.deviations(&[1.0, 1.0])) < 1e-13);
        assert!(largest(corner.errors(&products)) < 1e-13);
        assert!(corner.left_residual(&[1.0, 1.0]) < 1e-12);

        // The Schur complement: 8 - (6, 7) T'^-1 (4, 5)' = 8 - (6 * 7 + 7 * 6) / 5.
        let value = corner.value(&products);
        assert_relative_eq!(value.center, 8.0 - 84.0 / 5.0, max_relative = 1e-12);
    }

    /// A changed entry and a radius count where they stand, times the weight.
    #[test]
    fn changes_and_radii_are_seen() {
        let vectors = NullVectors::of(&matrix(), &[0, 1, 2], 2).unwrap();
        let mut changed = matrix();
        changed[0][1] += 1.0;
        let mut ends = exact_ends(&changed);
        let deviations = BoxCorner::of(&ends, 1, &vectors).deviations(&[1.0, 10.0]);
        // Y e_0 e_1' is (3, -1)' / 5 in column 1, of weight 10.
        assert_relative_eq!(deviations[0], 6.0, max_relative = 1e-12);
        assert_relative_eq!(deviations[1], 2.0, max_relative = 1e-12);

        let mut radii = vec![vec![0.0; 3]; 3];
        radii[2][0] = 0.5;
        ends.m[0] = matrix();
        ends.r = Some([radii.clone(), radii]);
        let corner = BoxCorner::of(&ends, 0, &vectors);
        assert_relative_eq!(corner.left_residual(&[2.0, 1.0]), 1.0, max_relative = 1e-9);
        let radius = corner.row_times_v(2).radius;
        assert_relative_eq!(radius, 0.5 * 7.0 / 5.0, max_relative = 1e-9);
    }

    #[test]
    fn no_number_counts_as_infinite() {
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert_eq!(largest([1.0, f64::NAN]), f64::INFINITY);
        assert_eq!(largest([]), 0.0);
    }
}
