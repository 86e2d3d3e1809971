//! Regular leaves: T(t, mu) on the support of a decided box has no null vector anywhere in the box.
//!
//! Let L be the support, k in L the *pivot*, and T' the block of T on L without k. The witness is
//! Y ~ T'^-1 and vectors v, u ~ right and left null vectors, with v_k = u_k = 1. Every T(t, mu) of
//! the box is a mean of matrices, each within R_c of M_c at a corner c. With the largest values
//! over the corners, radii included,
//!
//! ```text
//!     rho      >=  |I - Y T'|                          largest row sum
//!     epsilon  >=  |Y (T_'k + T'v)| / (1 - rho)        largest component
//!     P        >=  sum_j |T_k' + u'T'|_j
//! ```
//!
//! hold in the whole box, because the left sides are convex in T. The leaf demands rho < 1 and one
//! sign s with
//!
//! ```text
//!     s u'Tv  >  P epsilon    at all corners,
//! ```
//!
//! and so in the whole box, because u'Tv is linear in T.
//!
//! Let T x = 0 on L with x != 0. T' is regular, so x_k is not zero: it is scaled to 1, and z is
//! x - v without k. From T'z = -(T_'k + T'v) follows z = (I - Y T') z - Y (T_'k + T'v), so
//! |z| <= epsilon. Then 0 = u'Tx = u'Tv + (T_k' + u'T') z, whose last term is at most P epsilon: a
//! contradiction. As y = 0 on the support of a solution, the box holds none.
//!
//! Short numbers are tried first: machine integers, in which a product of three matrices costs
//! little. Where they cannot tell, or the witness does not fit into them, long numbers decide.
//!
//! Input: the support, the corners, the witness. Called by `critical`.

use super::ends::Corner;
use super::fault::CoverFault;
use super::null_witness::NullWitness;
use super::region::Region;
use super::root::Ball;
use super::short::Short;
use crate::certificate::Regular;
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Most bits of a number of a witness for short numbers to be tried.
///
/// Entries of corners have at most 2^62 in absolute value, and there are at most 2^10 of them in a
/// row: a sum of their products stays below 2^126.
const SHORT_BITS: u64 = 54;

/// The moving variables of a decided box by position, the pivot last. Demands that the witness
/// belongs to them.
pub(super) fn support(
    region: &Region,
    index: &[usize],
    witness: &Regular,
) -> Result<Vec<usize>, CoverFault> {
    let mut support = region.support();
    if !region.is_decided() || support.is_empty() {
        return Err(CoverFault::RootTooEarly);
    }

    let pivot = support.iter().position(|&i| index[i] == witness.pivot);
    let pivot = pivot.ok_or(CoverFault::Pivot {
        index: witness.pivot,
    })?;
    let pivot = support.remove(pivot);
    NullWitness::of_leaf(witness).check_shape(support.len())?;
    support.push(pivot);

    Ok(support)
}

/// Do short numbers prove that T is regular on the support?
pub(super) fn is_regular_at(support: &[usize], corners: &[Short], witness: &Regular) -> bool {
    let Some(witness) = Witness::<i64>::of(witness) else {
        return false;
    };

    let mut blocks = Vec::with_capacity(corners.len());
    for corner in corners {
        let Some(scale) = corner.scale() else {
            return false;
        };
        blocks.push(Block::of(&corner.m, &corner.r, scale, support));
    }

    witness.check(&blocks).is_ok()
}

/// Demands that T is regular on the support.
pub(super) fn check_corners(
    support: &[usize],
    corners: &[Corner<'_>],
    witness: &Regular,
) -> Result<(), CoverFault> {
    let blocks: Vec<Block<Integer>> = corners
        .iter()
        .map(|corner| Block::of(corner.m, corner.r, corner.scale.clone(), support))
        .collect();

    Witness::<Integer>::of(witness).check(&blocks)
}

/// What matrices and witnesses consist of: machine integers or long ones.
trait Entry: Clone {
    /// The sum of factor * (center +- radius).
    fn dot(factors: &[Self], line: &Line<Self>) -> Ball;

    /// The product with a ball.
    fn times(&self, ball: &Ball) -> Ball;
}

impl Entry for i64 {
    fn dot(factors: &[i64], line: &Line<i64>) -> Ball {
        let mut center: i128 = 0;
        let mut radius: i128 = 0;
        let entries = line.centers.iter().zip(&line.radii);
        for (factor, (m, r)) in factors.iter().zip(entries) {
            center += i128::from(*factor) * i128::from(*m);
            radius += i128::from(factor.abs()) * i128::from(*r);
        }

        Ball {
            center: center.into(),
            radius: radius.into(),
        }
    }

    fn times(&self, ball: &Ball) -> Ball {
        Ball {
            center: &ball.center * *self,
            radius: &ball.radius * self.unsigned_abs(),
        }
    }
}

impl Entry for Integer {
    fn dot(factors: &[Integer], line: &Line<Integer>) -> Ball {
        let mut sum = Ball::default();
        let entries = line.centers.iter().zip(&line.radii);
        for (factor, (m, r)) in factors.iter().zip(entries) {
            sum.add(factor, m, r);
        }

        sum
    }

    fn times(&self, ball: &Ball) -> Ball {
        Ball {
            center: &ball.center * self,
            radius: &ball.radius * self.abs(),
        }
    }
}

/// A row or a column of a matrix with radii.
struct Line<N> {
    centers: Vec<N>,
    radii: Vec<N>,
}

impl<N: Clone> Line<N> {
    /// The entries with these places.
    fn of<'a>(places: impl Iterator<Item = (&'a N, &'a N)>) -> Line<N>
    where
        N: 'a,
    {
        let (centers, radii) = places.map(|(m, r)| (m.clone(), r.clone())).unzip();
        Line { centers, radii }
    }
}

/// A corner on the support, the pivot last, in units of 1 / `scale`.
struct Block<N> {
    rows: Vec<Line<N>>,
    columns: Vec<Line<N>>,
    scale: Integer,
}

impl<N: Clone> Block<N> {
    fn of(m: &[Vec<N>], r: &[Vec<N>], scale: Integer, support: &[usize]) -> Block<N> {
        let row = |&i: &usize| Line::of(support.iter().map(|&j| (&m[i][j], &r[i][j])));
        let column = |&j: &usize| Line::of(support.iter().map(|&i| (&m[i][j], &r[i][j])));

        Block {
            rows: support.iter().map(row).collect(),
            columns: support.iter().map(column).collect(),
            scale,
        }
    }
}

/// Y, u and v; u and v end with the component 1 of the pivot.
struct Witness<N> {
    y: Vec<Vec<N>>,
    /// 1 in units of Y.
    y_one: Integer,
    u: Vec<N>,
    v: Vec<N>,
    /// 1 in units of u and v.
    one: Integer,
}

impl Witness<i64> {
    /// `None` where a number is too long.
    fn of(witness: &Regular) -> Option<Witness<i64>> {
        if NullWitness::of_leaf(witness).bits() >= SHORT_BITS {
            return None;
        }

        let long = Witness::<Integer>::of(witness);
        let short = |list: &Vec<Integer>| list.iter().map(ToPrimitive::to_i64).collect();
        Some(Witness {
            y: long.y.iter().map(short).collect::<Option<_>>()?,
            y_one: long.y_one,
            u: short(&long.u)?,
            v: short(&long.v)?,
            one: long.one,
        })
    }
}

impl Witness<Integer> {
    fn of(witness: &Regular) -> Witness<Integer> {
        let one = Integer::one() << witness.exponent;
        let mut u = witness.left.clone();
        let mut v = witness.right.clone();
        u.push(one.clone());
        v.push(one.clone());

        Witness {
            y: witness.inverse.clone(),
            y_one: Integer::one() << witness.inverse_exponent,
            u,
            v,
            one,
        }
    }
}

impl<N: Entry> Witness<N> {
    /// Demands that T is regular in the box with these corners.
    fn check(&self, corners: &[Block<N>]) -> Result<(), CoverFault> {
        let rho = largest(corners.iter().map(|corner| self.deviation(corner)));
        if rho >= Rational::one() {
            return Err(CoverFault::NotRegular { got: rho });
        }

        let mut errors = Vec::with_capacity(corners.len());
        let mut residuals = Vec::with_capacity(corners.len());
        let mut values = Vec::with_capacity(corners.len());
        for corner in corners {
            let products: Vec<Ball> = corner.rows.iter().map(|row| N::dot(&self.v, row)).collect();
            errors.push(self.error(corner, &products));
            residuals.push(self.left_residual(corner));
            values.push(self.value(corner, &products));
        }

        let epsilon = largest(errors) / (Rational::one() - rho);
        let bound = largest(residuals) * epsilon;

        // s u'Tv - radius > P epsilon.
        let is_above = values
            .iter()
            .all(|[center, radius]| center - radius > bound);
        let is_below = values
            .iter()
            .all(|[center, radius]| -center - radius > bound);
        if is_above || is_below {
            Ok(())
        } else {
            Err(CoverFault::SignChange)
        }
    }

    /// |I - Y T'| in the norm of the largest row sum.
    fn deviation(&self, corner: &Block<N>) -> Rational {
        let one = &self.y_one * &corner.scale;
        let order = self.y.len();

        let mut norm = Integer::zero();
        for (i, row) in self.y.iter().enumerate() {
            let mut row_sum = Integer::zero();

            // A column is longer than a row of Y by the entry of the pivot, which is not in T'.
            for (j, column) in corner.columns[..order].iter().enumerate() {
                let mut product = N::dot(row, column);
                if i == j {
                    product.center -= &one;
                }
                row_sum += product.magnitude();
            }

            norm = norm.max(row_sum);
        }

        Rational::new(norm, one)
    }

    /// The largest component of |Y (T_'k + T'v)|; `products` is Tv.
    fn error(&self, corner: &Block<N>, products: &[Ball]) -> Rational {
        let mut largest = Integer::zero();
        for row in &self.y {
            let mut sum = Ball::default();
            for (y, entry) in row.iter().zip(products) {
                let product = y.times(entry);
                sum.center += product.center;
                sum.radius += product.radius;
            }
            largest = largest.max(sum.magnitude());
        }

        Rational::new(largest, &self.y_one * &self.one * &corner.scale)
    }

    /// The sum of |T_k' + u'T'|_j.
    fn left_residual(&self, corner: &Block<N>) -> Rational {
        let mut sum = Integer::zero();
        for column in &corner.columns[..self.y.len()] {
            sum += N::dot(&self.u, column).magnitude();
        }

        Rational::new(sum, &self.one * &corner.scale)
    }

    /// u'Tv and its radius; `products` is Tv.
    fn value(&self, corner: &Block<N>, products: &[Ball]) -> [Rational; 2] {
        let mut sum = Ball::default();
        for (u, entry) in self.u.iter().zip(products) {
            let product = u.times(entry);
            sum.center += product.center;
            sum.radius += product.radius;
        }

        let unit = &self.one * &self.one * &corner.scale;
        [sum.center, sum.radius].map(|value| Rational::new(value, unit.clone()))
    }
}

/// The largest of numbers that are not negative.
fn largest(values: impl IntoIterator<Item = Rational>) -> Rational {
    values.into_iter().max().unwrap_or_default()
}

#[cfg(test)]
mod tests;
