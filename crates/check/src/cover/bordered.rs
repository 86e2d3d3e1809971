//! The bordered inverse: what is proved of a block of a matrix by an approximate inverse and
//! approximate null vectors.
//!
//! Let S be a support, k in S the *pivot*, T a matrix on S, known up to radii, and T' the block of
//! T without k. The witness is Y ~ T'^-1 and vectors v, u ~ the right and left null vectors, with
//! v_k = u_k = 1. Whatever numbers stand there, for every matrix within the radii:
//!
//! ```text
//!     |I - Y T'|            <= `deviation`,
//!     |T v|                 <= `products`,       T_'k + T'v on the rows of T',
//!     |Y (T_'k + T'v)|      <= `corrections`,
//!     u' T v                in `value`.
//! ```
//!
//! If the largest row sum rho of `deviation` is less than 1, Y and T' are regular. Then a null
//! vector of T has a component k other than zero; scaled to 1 there it is v_true = -T'^-1 T_'k on
//! the rest, and as T'^-1 = (Y T')^-1 Y,
//!
//! ```text
//!     |v_true - v| = |T'^-1 (T_'k + T'v)|  <=  |Y (T_'k + T'v)| / (1 - rho)  =  `error`.
//! ```
//!
//! The left null vector is the right one of the transpose, with Y' and u in place of Y and v
//! (`mirrored`). Vectors have the components of the support, the pivot last; norms are the largest
//! component and the largest row sum. Called by the leaves `root` and `regular` and by `presence`.

use super::ball::{Ball, BallMatrix};
use super::ends::{EndMatrix, LongMatrix, largest_bits};
use super::family::words;
use super::fault::CoverFault;
use super::region::Region;
use crate::certificate::{PresencePiece, Regular, Root};
use mceip_exact::{Integer, Rational};
use num_traits::{One, Zero};

/// Largest binary exponent of a witness.
const MAX_EXPONENT: u32 = 1 << 14;

/// The numbers of a witness as a certificate spells them.
#[derive(Clone, Copy)]
pub(super) struct NullWitness<'a> {
    pivot: usize,
    inverse: &'a LongMatrix,
    inverse_exponent: u32,
    /// u and v without the component 1 of the pivot.
    left: &'a [Integer],
    right: &'a [Integer],
    exponent: u32,
}

/// A kind of evidence that holds a [`NullWitness`].
macro_rules! has_witness {
    ($($kind:ty),*) => {$(
        impl<'a> From<&'a $kind> for NullWitness<'a> {
            fn from(of: &'a $kind) -> NullWitness<'a> {
                NullWitness {
                    pivot: of.pivot,
                    inverse: &of.inverse,
                    inverse_exponent: of.inverse_exponent,
                    left: &of.left,
                    right: &of.right,
                    exponent: of.exponent,
                }
            }
        }
    )*};
}

has_witness!(Root, Regular, PresencePiece);

impl NullWitness<'_> {
    /// Demands that u, v and Y have order n, and that their exponents are within the limit.
    fn check_shape(&self, n: usize) -> Result<(), CoverFault> {
        CoverFault::length("left", n, self.left.len())?;
        CoverFault::length("right", n, self.right.len())?;
        CoverFault::length("inverse", n, self.inverse.len())?;
        for row in self.inverse {
            CoverFault::length("inverse row", n, row.len())?;
        }

        let exponent = self.exponent.max(self.inverse_exponent);
        CoverFault::at_most("exponent", MAX_EXPONENT.into(), exponent.into())
    }

    /// Products of machine words in the product of Y with four corners of order `moving`, whose
    /// entries have `corner_bits`.
    pub(super) fn work(&self, moving: usize, corner_bits: u64) -> u64 {
        let numbers = self.inverse.iter().flatten();
        let longest = largest_bits(numbers.chain(self.left).chain(self.right));
        let exponent = self.exponent.max(self.inverse_exponent);
        let own_words = words(longest.max(exponent.into()));

        let cubes = (moving as u64).saturating_pow(3) * 8;
        cubes
            .saturating_mul(own_words)
            .saturating_mul(words(corner_bits))
    }
}

/// A witness and the positions of its variables in the matrices.
#[derive(Clone)]
pub(super) struct Bordered<'a> {
    /// The pivot is the last one.
    pub(super) support: Vec<usize>,
    /// Y by rows.
    y: Vec<Vec<&'a Integer>>,
    /// 1 in units of Y.
    y_one: Integer,
    pub(super) u: Vec<Integer>,
    pub(super) v: Vec<Integer>,
    /// 1 in units of u and v.
    pub(super) one: Integer,
}

/// The entries of a matrix on the support, each with its radius, in units of 1 / `scale`.
pub(super) struct SupportBlock<'a> {
    rows: Vec<BallLine<'a>>,
    scale: &'a Integer,
}

/// Entries of a row or of a column, each with its radius.
pub(super) type BallLine<'a> = Vec<(&'a Integer, &'a Integer)>;

impl SupportBlock<'_> {
    fn mirrored(&self) -> SupportBlock<'_> {
        let column = |j: usize| self.rows.iter().map(|row| row[j]).collect();

        SupportBlock {
            rows: (0..self.rows.len()).map(column).collect(),
            scale: self.scale,
        }
    }
}

impl<'a> Bordered<'a> {
    /// The witness of a leaf, whose region has to be decided with a support that is not empty.
    /// `index` are the problem's indices of the positions.
    pub(super) fn of_leaf(
        region: &Region,
        index: &[usize],
        witness: NullWitness<'a>,
    ) -> Result<Bordered<'a>, CoverFault> {
        let support = region.support();
        if !region.is_decided() || support.is_empty() {
            return Err(CoverFault::RootTooEarly);
        }

        Bordered::new(support, index, witness)
    }

    /// The witness on these positions, one of which has to be the pivot.
    pub(super) fn new(
        mut support: Vec<usize>,
        index: &[usize],
        witness: NullWitness<'a>,
    ) -> Result<Bordered<'a>, CoverFault> {
        let pivot = witness.pivot;
        let at_pivot = support.iter().position(|&i| index[i] == pivot);
        let pivot = support.remove(at_pivot.ok_or(CoverFault::Pivot { index: pivot })?);
        witness.check_shape(support.len())?;
        support.push(pivot);

        let one = Integer::one() << witness.exponent;
        let with_pivot = |list: &[Integer]| {
            let mut list = list.to_vec();
            list.push(one.clone());
            list
        };
        Ok(Bordered {
            support,
            y: witness
                .inverse
                .iter()
                .map(|row| row.iter().collect())
                .collect(),
            y_one: Integer::one() << witness.inverse_exponent,
            u: with_pivot(witness.left),
            v: with_pivot(witness.right),
            one,
        })
    }

    /// The witness for the transpose.
    pub(super) fn mirrored(&self) -> Bordered<'a> {
        let column = |j: usize| self.y.iter().map(|row| row[j]).collect();

        Bordered {
            support: self.support.clone(),
            y: (0..self.order()).map(column).collect(),
            y_one: self.y_one.clone(),
            u: self.v.clone(),
            v: self.u.clone(),
            one: self.one.clone(),
        }
    }

    /// Order of T'.
    pub(super) fn order(&self) -> usize {
        self.support.len() - 1
    }

    /// A row of a matrix on the support.
    pub(super) fn line<'m>(&self, matrix: &'m BallMatrix<Integer>, row: usize) -> BallLine<'m> {
        let BallMatrix { m, r } = matrix;
        let columns = self.support.iter();
        columns.map(|&j| (&m[row][j], &r[row][j])).collect()
    }

    /// The block of a matrix in units of 1 / `scale`.
    pub(super) fn block<'m>(
        &self,
        matrix: &'m BallMatrix<Integer>,
        scale: &'m Integer,
    ) -> SupportBlock<'m> {
        let rows = self.support.iter();
        SupportBlock {
            rows: rows.map(|&i| self.line(matrix, i)).collect(),
            scale,
        }
    }

    /// The blocks of the corners of a region.
    pub(super) fn blocks<'m>(&self, corners: &[EndMatrix<'m>]) -> Vec<SupportBlock<'m>> {
        let corners = corners.iter();
        corners
            .map(|corner| self.block(corner.matrix, corner.scale))
            .collect()
    }

    /// Row i of |I - Y T'|, in units of 1 / [`Bordered::deviation_unit`].
    pub(super) fn deviation(&self, block: &SupportBlock<'_>, i: usize) -> Vec<Integer> {
        let mut row = Vec::with_capacity(self.order());
        for j in 0..self.order() {
            let mut product = Ball::default();
            for (y, line) in self.y[i].iter().zip(&block.rows) {
                let (center, radius) = line[j];
                product.add(y, center, radius);
            }

            if i == j {
                product.center -= self.deviation_unit(block);
            }
            row.push(product.magnitude());
        }

        row
    }

    /// 1 in the units of the product Y T'.
    pub(super) fn deviation_unit(&self, block: &SupportBlock<'_>) -> Integer {
        &self.y_one * block.scale
    }

    /// rho: the norm of I - Y T' over all blocks. Demands that it is less than 1.
    pub(super) fn norm(&self, blocks: &[SupportBlock<'_>]) -> Result<Rational, CoverFault> {
        let mut norm = Rational::zero();
        for block in blocks {
            let row_sum = |i| self.deviation(block, i).into_iter().sum::<Integer>();
            let largest = (0..self.order()).map(row_sum).max().unwrap_or_default();
            norm = norm.max(Rational::new(largest, self.deviation_unit(block)));
        }

        if norm < Rational::one() {
            Ok(norm)
        } else {
            Err(CoverFault::NotRegular { got: norm })
        }
    }

    /// T v in units of 1 / ([`Bordered::one`] scale): the residual T_'k + T'v, and the row of the
    /// pivot.
    pub(super) fn products(&self, block: &SupportBlock<'_>) -> Vec<Ball<Integer>> {
        block.rows.iter().map(|line| self.times_v(line)).collect()
    }

    /// The product of a row and v.
    pub(super) fn times_v(&self, line: &BallLine<'_>) -> Ball<Integer> {
        dot(&self.v, line.iter().copied())
    }

    /// u' T in the same units: the residual T_k' + u'T', and the column of the pivot.
    pub(super) fn left_products(&self, block: &SupportBlock<'_>) -> Vec<Ball<Integer>> {
        self.mirrored().products(&block.mirrored())
    }

    /// The sum of |T_k' + u'T'|, in the same units.
    pub(super) fn left_residual(&self, block: &SupportBlock<'_>) -> Integer {
        let products = self.left_products(block);
        products[..self.order()].iter().map(Ball::magnitude).sum()
    }

    /// The components of |Y (T_'k + T'v)|, in units of the product of those of Y and of `products`.
    pub(super) fn corrections(&self, products: &[Ball<Integer>]) -> Vec<Integer> {
        let mut corrections = Vec::with_capacity(self.order());
        for row in &self.y {
            let residual = products.iter().map(|entry| (&entry.center, &entry.radius));
            corrections.push(dot(row.iter().copied(), residual).magnitude());
        }

        corrections
    }

    /// The bound of |v_true - v| over all blocks, given the norm.
    pub(super) fn error(&self, blocks: &[SupportBlock<'_>], norm: &Rational) -> Rational {
        let mut error = Rational::zero();
        for block in blocks {
            let corrections = self.corrections(&self.products(block));
            let largest = corrections.into_iter().max().unwrap_or_default();
            let unit = self.deviation_unit(block) * &self.one;
            error = error.max(Rational::new(largest, unit));
        }

        error / (Rational::one() - norm)
    }

    /// rho of the left side, |I - T'Y| in the norm of the largest column sum, and the bound of
    /// |u_true - u|.
    pub(super) fn left_error(&self, blocks: &[SupportBlock<'_>]) -> Result<Rational, CoverFault> {
        let mirrored = self.mirrored();
        let blocks: Vec<SupportBlock<'_>> = blocks.iter().map(SupportBlock::mirrored).collect();
        let norm = mirrored.norm(&blocks)?;
        Ok(mirrored.error(&blocks, &norm))
    }

    /// u'Tv in units of 1 / ([`Bordered::one`]^2 scale); `products` is Tv.
    pub(super) fn value(&self, products: &[Ball<Integer>]) -> Ball<Integer> {
        let products = products.iter().map(|entry| (&entry.center, &entry.radius));
        dot(&self.u, products)
    }
}

#[cfg(test)]
impl<'a> Bordered<'a> {
    /// Y, u and v, the latter with the component of the pivot, in units of 1 / `y_one` and 1 /
    /// `one`.
    pub(super) fn of_numbers(
        support: &[usize],
        (y, y_one): (&'a LongMatrix, i64),
        [u, v]: [&[i64]; 2],
        one: i64,
    ) -> Bordered<'a> {
        let vector = |list: &[i64]| list.iter().map(|&v| v.into()).collect();
        Bordered {
            support: support.to_vec(),
            y: y.iter().map(|row| row.iter().collect()).collect(),
            y_one: y_one.into(),
            u: vector(u),
            v: vector(v),
            one: one.into(),
        }
    }
}

/// The sum of factor * (center +- radius).
fn dot<'n>(
    factors: impl IntoIterator<Item = &'n Integer>,
    entries: impl Iterator<Item = (&'n Integer, &'n Integer)>,
) -> Ball<Integer> {
    let mut sum = Ball::default();
    for (factor, (center, radius)) in factors.into_iter().zip(entries) {
        sum.add(factor, center, radius);
    }

    sum
}
