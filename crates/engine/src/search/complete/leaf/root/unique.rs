//! The witness that the block of a support is singular at one value only, and what its null vector
//! is there.
//!
//! T_JJ(t) is the block of T on the support J. With a pivot p in J and r the rest of J, its Schur
//! complement is
//!
//! ```text
//! phi(t) = T_pp - T_pr T_rr^-1 T_rp,
//! ```
//!
//! and where T_rr is regular, T_JJ has a null vector exactly if phi = 0. If T_rr is regular over an
//! interval and phi' has one sign there, there is at most one such value. If phi changes its sign
//! over a narrower interval inside, there is one.
//!
//! The witness is made from a null vector in doubles: a pivot p, the inverse Y of T_rr rounded to
//! as few bits as will do, and the left and right null vectors u and v scaled to 1 at p. `bounds`
//! evaluates what they have to satisfy.
//!
//! The search proposes; the checker decides on the numbers as they are written. A value 0 has no
//! narrow interval here (its width is relative): the leaf `support` takes it.
//!
//! Called by the leaves `root` and `infinity` and by `precise`.

use super::bounds::{Errors, is_monotone, sign_product};
use crate::bordered::{BoxCorner, DoubleBall, NullVectors};
use crate::search::complete::null_vector::NullVector;
use crate::search::complete::pieces::expansion::{ChordEnds, Expansion};
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::search::complete::region::at_zero;
use crate::search::complete::rounding::{exponent, integer, integers, rounded};
use crate::tolerance::{ROOT_HALF_WIDTHS, ROUNDING};
use mceip_check::certificate::{Root, RootOutcome, VariableState};
use mceip_exact::{Integer, Rational, from_f64, to_f64};
use mceip_mcp::linear::inverse;
use mceip_model::file::Number;
use num_traits::One;

/// The null vectors are written in units of 2^-56, below the rounding of components near 1.
const VECTOR_BITS: u32 = 56;
/// Bits tried for the inverse's largest entry: few bits make a short certificate.
const INVERSE_BITS: [i32; 4] = [12, 20, 30, 44];
/// Pivots tried.
const PIVOTS: usize = 3;

/// A pivot with Y, u and v that prove uniqueness over an interval.
pub(crate) struct UniquenessWitness {
    vectors: NullVectors,
    /// Y in units of 2^-`inverse_bits`.
    inverse: Vec<Vec<Integer>>,
    inverse_bits: u32,
}

/// Where a value is proved to be and what its null vector is.
pub(crate) struct Located {
    pub(crate) interval: [Rational; 2],
    pub(crate) outcome: RootOutcome,
}

impl UniquenessWitness {
    /// The witness that this is the only null vector over `wide`, which contains the leaf; `None`
    /// where it is not to be had.
    ///
    /// The minor of T_JJ without row and column p is proportional to u_p v_p where T_JJ is
    /// singular, so that pivots with a large product come first.
    pub(crate) fn of(null: &NullVector, wide: &ChordEnds) -> Option<UniquenessWitness> {
        let weights: Vec<f64> = null
            .left
            .iter()
            .zip(&null.right)
            .map(|(u, v)| (u * v).abs())
            .collect();
        let mut order: Vec<usize> = (0..weights.len()).collect();
        order.sort_by(|p, q| weights[*q].total_cmp(&weights[*p]));

        for place in order.into_iter().take(PIVOTS) {
            let unique = UniquenessWitness::with_pivot(null, place, wide);
            if unique.is_some() {
                return unique;
            }
        }

        None
    }

    /// The same with the pivot at this place of the support.
    fn with_pivot(null: &NullVector, place: usize, wide: &ChordEnds) -> Option<UniquenessWitness> {
        let pivot = null.support[place];
        let mut rest = null.support.clone();
        rest.remove(place);
        let inverse_at_middle = if rest.is_empty() {
            Vec::new()
        } else {
            inverse(&middle_block(wide, &rest))?
        };

        let mut vectors = NullVectors {
            rest,
            pivot,
            inverse: Vec::new(),
            left: scaled_without(&null.left, place),
            right: scaled_without(&null.right, place),
        };

        for bits in INVERSE_BITS {
            let inverse_bits = exponent(&inverse_at_middle, bits);
            let unit = f64::from(inverse_bits).exp2();
            vectors.inverse = rounded(&inverse_at_middle, unit);

            let errors = Errors::of(&vectors, wide);
            let is_proof = errors.is_some_and(|errors| is_monotone(&vectors, wide, &errors));
            if is_proof {
                let inverse = integers(&vectors.inverse, unit);
                vectors.inverse = doubles(&inverse, inverse_bits);
                return Some(UniquenessWitness {
                    vectors,
                    inverse,
                    inverse_bits,
                });
            }
        }

        None
    }

    /// The certificate's form; `index` gives the problem's numbers of the positions, `interval`
    /// what the value lies in.
    pub(crate) fn witness(
        &self,
        index: &[usize],
        interval: [Rational; 2],
        outcome: RootOutcome,
    ) -> Root {
        let unit = f64::from(VECTOR_BITS).exp2();
        let left = &self.vectors.left;
        let right = &self.vectors.right;
        Root {
            pivot: index[self.vectors.pivot],
            interval: interval.map(Number),
            inverse: self.inverse.clone(),
            inverse_exponent: self.inverse_bits,
            left: left.iter().map(|v| integer(v * unit)).collect(),
            right: right.iter().map(|v| integer(v * unit)).collect(),
            exponent: VECTOR_BITS,
            outcome,
        }
    }

    /// A narrow interval around the value on which the signs of x and y are certain, and what they
    /// say; `None` where no width of [`ROOT_HALF_WIDTHS`] makes them so.
    ///
    /// A value near one of `ends`, the ends of its leaf or region, gets an interval centred at that
    /// end: the leaf on the other side finds it too, and of two intervals with one centre one holds
    /// the other, so that the checker sees one solution.
    ///
    /// `vanishing` are the variables at rest of which y is zero with y on the support.
    pub(crate) fn outcome(
        &self,
        expansion: &Expansion,
        value: f64,
        ends: [f64; 4],
        states: &[VariableState],
        [index, vanishing]: [&[usize]; 2],
    ) -> Option<Located> {
        ROOT_HALF_WIDTHS.iter().find_map(|width| {
            let half = width * value.abs();
            let center = nearest_end(value, ends, 0.5 * half);
            let narrow = expansion.ends(center - half, center + half);

            let errors = Errors::of(&self.vectors, &narrow)?;
            if sign_product(&self.vectors, &narrow, &errors) != -1 {
                return None;
            }

            let outcome = self.signs(&narrow, errors.right, states, [index, vanishing])?;
            let interval = [from_f64(center - half).ok()?, from_f64(center + half).ok()?];
            Some(Located { interval, outcome })
        })
    }

    /// Has the Schur complement one sign over the interval, so that there is no null vector in it?
    ///
    /// `wide` lies where [`UniquenessWitness::of`] has shown it monotone, so equal signs at both
    /// ends suffice.
    pub(crate) fn is_absent(&self, wide: &ChordEnds) -> bool {
        let errors = Errors::of(&self.vectors, wide);
        errors.is_some_and(|errors| sign_product(&self.vectors, wide, &errors) == 1)
    }

    /// What the signs of x on the support and of y = T x off it say; `None` if one is not certain.
    /// `error` bounds the error of the components of x; it is doubled because the checker's own
    /// bound, from rounded numbers, may be larger.
    fn signs(
        &self,
        narrow: &ChordEnds,
        error: f64,
        states: &[VariableState],
        [index, vanishing]: [&[usize]; 2],
    ) -> Option<RootOutcome> {
        let error = 2.0 * error + ROUNDING;
        let mut is_certain = true;
        for (&i, v) in self.vectors.rest.iter().zip(&self.vectors.right) {
            if *v < -error {
                return Some(RootOutcome::NegativeX(index[i]));
            }

            is_certain &= *v > error;
        }

        for i in at_zero(states) {
            if vanishing.contains(&index[i]) {
                continue;
            }

            let at_ends = [0, 1].map(|end| self.reaction(narrow, end, i, error));
            if at_ends.iter().all(|y| y.sign() == -1) {
                return Some(RootOutcome::NegativeY(index[i]));
            }

            is_certain &= at_ends.iter().all(|y| y.sign() == 1);
        }

        is_certain.then_some(RootOutcome::Solution)
    }

    /// Row i of T x at an end, for every x within `error` of the right vector.
    fn reaction(&self, narrow: &ChordEnds, end: usize, i: usize, error: f64) -> DoubleBall {
        let corner = BoxCorner::of(narrow, end, &self.vectors);
        let mut y = corner.row_times_v(i);
        for &j in &self.vectors.support() {
            y.radius += error * corner.entry(i, j).magnitude();
        }

        y
    }
}

/// The value, or an end within `distance` of it: of several the one with the shortest number, which
/// is what the neighbours have as well.
fn nearest_end(value: f64, ends: [f64; 4], distance: f64) -> f64 {
    ends.into_iter()
        .filter(|end| (end - value).abs() <= distance)
        .max_by_key(|end| end.to_bits().trailing_zeros())
        .unwrap_or(value)
}

/// The block of the matrix in the middle of the ends.
fn middle_block(wide: &ChordEnds, indices: &[usize]) -> SquareMatrix {
    let mut block = SquareMatrix::new();
    for &i in indices {
        let row = indices
            .iter()
            .map(|&j| 0.5 * (wide.m[0][i][j] + wide.m[1][i][j]));
        block.push(row.collect());
    }

    block
}

/// The components but the one at `place`, divided by that one.
fn scaled_without(list: &[f64], place: usize) -> Vec<f64> {
    let at_place = list[place];
    let mut scaled = list.to_vec();
    scaled.remove(place);
    for v in &mut scaled {
        *v /= at_place;
    }

    scaled
}

fn doubles(matrix: &[Vec<Integer>], bits: u32) -> SquareMatrix {
    let unit = Integer::one() << bits;
    let mut doubles = SquareMatrix::new();
    for row in matrix {
        let entries = row
            .iter()
            .map(|v| to_f64(&Rational::new(v.clone(), unit.clone())));
        doubles.push(entries.collect());
    }

    doubles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::complete::null_vector::null_vector;
    use crate::search::complete::pieces::view::View;
    use mceip_exact::Sparse;
    use mceip_model::Pencil;

    /// The double that lies this many units in the last place above 9/4.
    fn above(units: u64) -> f64 {
        f64::from_bits(2.25f64.to_bits() + units)
    }

    /// -9 + 4t vanishes at 9/4. Where leaves meet at an end near it their intervals have that end
    /// as centre, of several ends the one with the shortest number, whatever the rounded value; an
    /// end farther away than half the width does not count.
    #[test]
    fn a_value_near_an_end_gets_an_interval_around_that_end() {
        let a = Sparse::from_ints(&[&[-9]]);
        let b = Sparse::from_ints(&[&[4]]);
        let view = View::of(&Pencil::new(a, b, vec![]).unwrap());
        let expansion = &view.expansions[0];
        let states = [VariableState::InSupport];
        let null = null_vector(expansion, &states, 2.0, 3.0).unwrap();
        let unique = UniquenessWitness::of(&null, &expansion.ends(2.0, 3.0)).unwrap();
        let half = ROOT_HALF_WIDTHS[0] * 2.25;

        // Value, ends of the leaf and of the region, expected centre.
        let cases = [
            (2.25, [2.0, 2.5, 1.0, 3.0], 2.25),
            (above(3), [2.0, 2.5, 1.0, 3.0], above(3)),
            (above(3), [2.25, 2.5, 1.0, 3.0], 2.25),
            (above(3), [2.0, above(5), 1.0, 2.25], 2.25),
            (above(3), [2.0, above(6), 1.0, 3.0], above(6)),
            (above(3), [2.25 + 0.6 * half, 2.5, 1.0, 3.0], above(3)),
        ];
        for (value, ends, centre) in cases {
            let found = unique
                .outcome(expansion, value, ends, &states, [&[0], &[]])
                .unwrap();

            let interval = found.interval.map(|end| to_f64(&end));
            assert_eq!(interval, [centre - half, centre + half], "{value} {ends:?}");
            assert_eq!(found.outcome, RootOutcome::Solution);
        }
    }
}
