//! Leaf `regular`: T(t, mu) on the support of a decided box has no null vector anywhere in the box.
//!
//! L is the support, k its pivot, T' the block of T without k. With Y ~ T'^-1 and u, v ~ null
//! vectors that are 1 at k, all from the middle of the box, the leaf holds if at the four corners
//!
//! ```text
//!     rho = |I - Y T'| < 1    and    s u'Tv > P epsilon,
//!     epsilon = |Y (T_'k + T'v)| / (1 - rho),    P = sum_j |T_k' + u'T'|_j,
//! ```
//!
//! largest values over the corners, radii included. At the middle both residuals vanish, so that
//! P epsilon is of second order in the size of the box.
//!
//! The pivot is the one with the largest |(T_LL^-1)_kk| = |det T' / det T_LL| at the middle. Numbers
//! are rounded to the fewest bits that still prove. Called by `boxes` for decided boxes with finite
//! ends. The checker's side is `check::cover::regular`.

use crate::search::complete::pieces::expansion::Ends;
use crate::search::complete::pieces::matrix::{Matrix, principal_block};
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::region::{State, support};
use crate::search::complete::rounding::{exponent, integer, integers, rounded};
use crate::tolerance::{REGULAR_MARGIN, ROUNDING};
use mceip_check::certificate::{CriticalNode, Regular};
use mceip_mcp::linear::inverse;

/// Bits tried for the largest number of Y, and of u and v.
const BITS: [i32; 3] = [12, 22, 40];

/// Y, u and v of a decided box; positions are those of the pencil.
pub(super) struct Witness {
    pivot: usize,
    /// The support without the pivot.
    rest: Vec<usize>,
    inverse: Matrix,
    /// u and v on the rest.
    left: Vec<f64>,
    right: Vec<f64>,
}

/// What the corners of a box make of a witness.
struct Bounds {
    /// rho.
    norm: f64,
    /// P epsilon.
    product: f64,
    /// The least s u'Tv, what the radii may take from it subtracted; of the better sign s.
    distance: f64,
}

impl Bounds {
    /// Does the leaf hold, by a margin for what doubles do not see?
    fn hold(&self) -> bool {
        self.norm < 1.0 - REGULAR_MARGIN && self.excess() < 0.0
    }

    /// How far the inequality of the sign is from holding: negative where it holds.
    fn excess(&self) -> f64 {
        (1.0 + REGULAR_MARGIN) * self.product - self.distance
    }
}

impl Witness {
    /// The witness of the middle of a box, where T is `matrix`; `None` where nothing moves or T is
    /// singular to doubles.
    pub(super) fn of(matrix: &Matrix, states: &[State]) -> Option<Witness> {
        let mut rest = support(states);
        let whole = inverse(&principal_block(matrix, &rest))?;
        let place = (0..rest.len()).max_by(|&i, &j| {
            let sizes = [whole[i][i].abs(), whole[j][j].abs()];
            sizes[0].total_cmp(&sizes[1])
        })?;

        let pivot = rest.remove(place);
        let inverse = if rest.is_empty() {
            Matrix::new()
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

        Some(Witness {
            pivot,
            rest,
            inverse,
            left,
            right,
        })
    }

    /// The leaf, if it holds at these corners; `index` gives the problem's numbers of positions.
    pub(super) fn leaf(&self, corners: &[Ends], index: &[usize]) -> Option<CriticalNode> {
        if !self.bounds(corners).hold() {
            return None;
        }

        BITS.iter()
            .find_map(|&bits| self.rounded_leaf(bits, corners, index))
    }

    /// How far the leaf is from holding at these corners; infinite where T' may be singular.
    pub(super) fn excess(&self, corners: &[Ends]) -> f64 {
        let bounds = self.bounds(corners);
        if bounds.norm < 1.0 {
            bounds.excess()
        } else {
            f64::INFINITY
        }
    }

    /// The leaf with numbers of so many bits, if it still holds.
    fn rounded_leaf(&self, bits: i32, corners: &[Ends], index: &[usize]) -> Option<CriticalNode> {
        let vectors = vec![self.left.clone(), self.right.clone(), vec![1.0]];
        let inverse_exponent = exponent(&self.inverse, bits);
        let exponent = exponent(&vectors, bits);
        let inverse_unit = f64::from(inverse_exponent).exp2();
        let unit = f64::from(exponent).exp2();

        let vectors = rounded(&vectors, unit);
        let short = Witness {
            pivot: self.pivot,
            rest: self.rest.clone(),
            inverse: rounded(&self.inverse, inverse_unit),
            left: vectors[0].clone(),
            right: vectors[1].clone(),
        };
        if !short.bounds(corners).hold() {
            return None;
        }

        let leaf = Regular {
            pivot: index[self.pivot],
            inverse: integers(&short.inverse, inverse_unit),
            inverse_exponent,
            left: short.left.iter().map(|u| integer(u * unit)).collect(),
            right: short.right.iter().map(|v| integer(v * unit)).collect(),
            exponent,
        };
        Some(CriticalNode::Regular(Box::new(leaf)))
    }

    /// The bounds over both ends of each interval.
    fn bounds(&self, corners: &[Ends]) -> Bounds {
        let mut norm: f64 = 0.0;
        let mut error: f64 = 0.0;
        let mut residual: f64 = 0.0;
        let mut above = f64::INFINITY;
        let mut below = f64::INFINITY;

        for ends in corners {
            for m in &ends.m {
                let corner = Corner {
                    witness: self,
                    m,
                    r: ends.r.as_ref(),
                };
                let products = corner.products();
                norm = norm.max(corner.deviation());
                error = error.max(corner.error(&products));
                residual = residual.max(corner.left_residual());

                let value = corner.value(&products);
                above = above.min(value.center - value.radius);
                below = below.min(-value.center - value.radius);
            }
        }

        Bounds {
            norm,
            product: residual * error / (1.0 - norm).max(f64::MIN_POSITIVE),
            distance: above.max(below),
        }
    }
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

impl Corner<'_> {
    fn radius(&self, i: usize, j: usize) -> f64 {
        self.r.map_or(0.0, |r| r[i][j])
    }

    /// |I - Y T'|, the largest row sum.
    fn deviation(&self) -> f64 {
        let rest = &self.witness.rest;
        let mut norm: f64 = 0.0;
        for (i, row) in self.witness.inverse.iter().enumerate() {
            let mut products = vec![Ball::default(); rest.len()];
            for (y, &k) in row.iter().zip(rest) {
                for (product, &j) in products.iter_mut().zip(rest) {
                    product.add(*y, self.m[k][j], self.radius(k, j));
                }
            }

            products[i].center -= 1.0;
            norm = norm.max(products.iter().map(|product| product.magnitude()).sum());
        }

        norm
    }

    /// (T v)_i for each i of the support, the pivot last.
    fn products(&self) -> Vec<Ball> {
        let Witness {
            pivot, rest, right, ..
        } = self.witness;
        let mut products = Vec::with_capacity(rest.len() + 1);
        for &i in rest.iter().chain([pivot]) {
            let mut sum = Ball::default();
            sum.add(1.0, self.m[i][*pivot], self.radius(i, *pivot));
            for (v, &j) in right.iter().zip(rest) {
                sum.add(*v, self.m[i][j], self.radius(i, j));
            }
            products.push(sum);
        }

        products
    }

    /// The largest component of |Y (T_'k + T'v)|.
    fn error(&self, products: &[Ball]) -> f64 {
        let mut largest: f64 = 0.0;
        for row in &self.witness.inverse {
            let mut sum = Ball::default();
            for (y, product) in row.iter().zip(products) {
                sum.add(*y, product.center, product.radius);
            }
            largest = largest.max(sum.magnitude());
        }

        largest
    }

    /// The sum of |T_k' + u'T'|_j.
    fn left_residual(&self) -> f64 {
        let Witness {
            pivot, rest, left, ..
        } = self.witness;
        let mut total = 0.0;
        for &j in rest {
            let mut sum = Ball::default();
            sum.add(1.0, self.m[*pivot][j], self.radius(*pivot, j));
            for (u, &i) in left.iter().zip(rest) {
                sum.add(*u, self.m[i][j], self.radius(i, j));
            }
            total += sum.magnitude();
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
