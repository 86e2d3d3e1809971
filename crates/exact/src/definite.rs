//! Is a symmetric rational matrix positive definite? Proved either way, without floats.
//!
//! Three methods, the first that decides:
//!
//! 1. machine integers (`definite_short`): most matrices are far from singular;
//! 2. up to order 48 the leading minors (Sylvester's criterion);
//! 3. beyond, where exact elimination grows unbearable, a rounded factorisation with an exact
//!    residual, as follows.
//!
//! With a small s > 0 the matrix A - sI is factored as L D L' in numbers rounded to a fixed unit,
//! and the residual E = A - sI - L D L' is computed *exactly*. Then
//!
//! ```text
//! A = L D L' + (E + sI),
//! ```
//!
//! and A is positive definite if D > 0 and E + sI = A - L D L' is strictly diagonally dominant with
//! a positive diagonal (Gershgorin). If a pivot of D is not positive, a direction x with x'Ax <= 0,
//! computed exactly, refutes it; between the two the answer is that it is undecided.
//!
//! Input: a symmetric matrix over Q (the caller has checked symmetry). Called where a hypothesis of
//! the paper is established: K_ff and M in `model`, K* and its like in `engine`.

use super::definite_short::certainly_definite;
use super::dominance::Dominance;
use super::{Integer, Rational, Sparse, cleared, common_denominator};
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// Largest order whose leading minors are computed.
const EXACT_ORDER: usize = 48;
/// Bits kept after the binary point, relative to the largest diagonal entry, by the rounded LDL'.
const FRACTION_BITS: u64 = 96;
/// The shift is 2^-SHIFT_BITS of the largest diagonal entry: far above rounding, far below what
/// makes a finite-element stiffness definite.
const SHIFT_BITS: u64 = 40;

/// Why a matrix is not positive definite.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotDefinite {
    /// The row at which elimination met the first pivot that is not positive.
    pub index: usize,
    /// That pivot (of LDL'), or x'Ax <= 0 for the direction found by the rounded one.
    pub pivot: Rational,
}

/// Definiteness was refuted, or could not be decided.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DefiniteError {
    /// The matrix is proved not to be positive definite.
    Not(NotDefinite),
    /// A large matrix so close to singular that the rounded factorisation settles neither side.
    Undecided {
        /// The row at which the factorisation stopped.
        index: usize,
    },
}

/// Proves that a symmetric matrix is positive definite. The caller has checked symmetry.
///
/// # Errors
/// [`DefiniteError::Not`] with the pivot that is not positive; [`DefiniteError::Undecided`] only
/// for matrices of order above 48 that are within about 2^-40 (relative) of singular.
///
/// ```
/// use mceip_exact::{Sparse, positive_definite};
/// let definite = Sparse::from_ints(&[&[2, 1], &[1, 1]]);
/// assert!(positive_definite(&definite).is_ok());
///
/// let semidefinite = Sparse::from_ints(&[&[1, 1], &[1, 1]]);
/// assert!(positive_definite(&semidefinite).is_err());
/// ```
pub fn positive_definite(m: &Sparse) -> Result<(), DefiniteError> {
    if certainly_definite(m) {
        return Ok(());
    }

    if m.rows() <= EXACT_ORDER {
        leading_minors(m)
    } else {
        rounded_ldl(m)
    }
}

/// Are all leading minors positive (Sylvester's criterion)? Each row is multiplied by a positive
/// integer first.
fn leading_minors(m: &Sparse) -> Result<(), DefiniteError> {
    let n = m.rows();
    let factors: Vec<Integer> = (0..n)
        .map(|i| common_denominator(m.row(i).iter().map(|(_, entry)| entry)))
        .collect();
    let mut s = vec![vec![Integer::zero(); n]; n];
    for (i, factor) in factors.iter().enumerate() {
        for (j, entry) in m.row(i) {
            s[i][*j] = cleared(entry, factor);
        }
    }

    match first_minor_not_positive(s) {
        None => Ok(()),
        Some(Minor {
            index,
            value,
            previous,
        }) => {
            // The pivot of LDL' is the quotient of two minors; the row's factor is in the first of
            // them only.
            let pivot = Rational::new(value, previous * &factors[index]);
            Err(DefiniteError::Not(NotDefinite { index, pivot }))
        }
    }
}

/// A leading minor of an integral matrix.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Minor {
    /// Its last row.
    pub index: usize,
    /// The minor.
    pub value: Integer,
    /// The minor of one row less; 1 for the first row.
    pub previous: Integer,
}

/// The first leading minor that is not positive; `None` proves a symmetric matrix positive definite
/// (Sylvester's criterion), also if its rows were multiplied by positive numbers. Elimination
/// without fractions (Bareiss): no number is longer than a minor.
pub fn first_minor_not_positive(mut s: Vec<Vec<Integer>>) -> Option<Minor> {
    let n = s.len();
    let mut previous = Integer::one();
    for k in 0..n {
        let value = s[k][k].clone();
        if !value.is_positive() {
            return Some(Minor {
                index: k,
                value,
                previous,
            });
        }

        for i in k + 1..n {
            for j in k + 1..n {
                // The division is exact.
                s[i][j] = (&value * &s[i][j] - &s[i][k] * &s[k][j]) / &previous;
            }
        }

        previous = value;
    }

    None
}

fn rounded_ldl(m: &Sparse) -> Result<(), DefiniteError> {
    let fixed = Fixed::of(m);
    let ldl = RoundedLdl::of(m, &fixed)?;

    match ldl.first_undominated(m, &fixed) {
        None => Ok(()),
        Some(index) => Err(DefiniteError::Undecided { index }),
    }
}

/// Fixed-point numbers: integers in units of `scale / 2^FRACTION_BITS`.
struct Fixed {
    /// Largest diagonal entry, rounded up to a power of two.
    scale: Rational,
}

impl Fixed {
    fn of(m: &Sparse) -> Fixed {
        let largest = (0..m.rows())
            .map(|i| m.get(i, i))
            .max()
            .unwrap_or_else(Rational::one);
        let bits = largest.numer().bits() as i64 - largest.denom().bits() as i64 + 1;
        let power = Rational::from_integer(Integer::one() << bits.unsigned_abs());
        Fixed {
            scale: if bits < 0 { power.recip() } else { power },
        }
    }

    fn unit(&self) -> Rational {
        &self.scale / Rational::from_integer(Integer::one() << FRACTION_BITS)
    }

    fn round(&self, value: &Rational) -> Integer {
        (value / self.unit()).round().to_integer()
    }
}

/// One row of L left of the diagonal, by column, in units of 2^-FRACTION_BITS.
type LowerRow = BTreeMap<usize, Integer>;

/// The rounded factors L and D of A - sI.
struct RoundedLdl {
    /// Rows of L; the diagonal of ones is not stored.
    lower: Vec<LowerRow>,
    /// D in fixed units.
    pivots: Vec<Integer>,
}

impl RoundedLdl {
    /// Factors A - sI, or says what the first pivot that is not positive shows.
    fn of(m: &Sparse, fixed: &Fixed) -> Result<RoundedLdl, DefiniteError> {
        let shift = Integer::one() << (FRACTION_BITS - SHIFT_BITS);
        let mut ldl = RoundedLdl {
            lower: Vec::with_capacity(m.rows()),
            pivots: Vec::with_capacity(m.rows()),
        };

        for i in 0..m.rows() {
            let row = ldl.next_row(m, fixed);
            let mut squares = Integer::zero(); // sum_k l_ik^2 d_k
            for (k, l_ik) in &row {
                squares += (l_ik * l_ik * &ldl.pivots[*k]) >> (2 * FRACTION_BITS);
            }

            let pivot = fixed.round(&m.get(i, i)) - &shift - squares;
            if !pivot.is_positive() {
                return Err(ldl.refute(m, &row));
            }
            ldl.lower.push(row);
            ldl.pivots.push(pivot);
        }

        Ok(ldl)
    }

    /// Row i of L from the rows above: l_ij d_j = a_ij - sum_k l_ik d_k l_jk, within the skyline,
    /// that is, from the first non-zero column of A on.
    fn next_row(&self, m: &Sparse, fixed: &Fixed) -> LowerRow {
        let i = self.lower.len();
        let mut given = LowerRow::new();

        for (j, entry) in m.row(i) {
            if *j < i {
                given.insert(*j, fixed.round(entry));
            }
        }

        let Some((&first, _)) = given.first_key_value() else {
            return LowerRow::new();
        };

        let mut row = LowerRow::new();
        let mut scaled = LowerRow::new(); // l_ik d_k in fixed units
        for j in first..i {
            let mut l_ij_d_j = given.get(&j).cloned().unwrap_or_default();
            for (k, l_jk) in self.lower[j].range(first..) {
                if let Some(l_ik_d_k) = scaled.get(k) {
                    l_ij_d_j -= (l_ik_d_k * l_jk) >> FRACTION_BITS;
                }
            }
            if !l_ij_d_j.is_zero() {
                row.insert(j, (&l_ij_d_j << FRACTION_BITS) / &self.pivots[j]);
                scaled.insert(j, l_ij_d_j);
            }
        }

        row
    }

    /// The first row of A - L D L' that is not strictly diagonally dominant with a positive
    /// diagonal entry. All numbers are exact.
    fn first_undominated(&self, m: &Sparse, fixed: &Fixed) -> Option<usize> {
        let n = m.rows();
        let one = Integer::one() << FRACTION_BITS;
        let two_roundings = Rational::from_integer(Integer::one() << (2 * FRACTION_BITS));
        let unit = fixed.unit() / two_roundings; // of the products l_ik d_k l_jk

        let mut residuals = Dominance::zero(n);
        for i in 0..n {
            let mut scaled = LowerRow::new(); // row i of L D
            for (k, l_ik) in self.row_with_diagonal(i, &one) {
                scaled.insert(k, l_ik * &self.pivots[k]);
            }

            // Columns where either the product or A can be non-zero lie between first and i.
            let first_of_product = self.lower[i].first_key_value().map_or(i, |(k, _)| *k);
            let first_of_given = m.row(i).first().map_or(i, |(k, _)| *k);
            for j in first_of_product.min(first_of_given)..=i {
                let mut product = Integer::zero(); // (L D L')_ij
                for (k, l_jk) in self.row_with_diagonal(j, &one) {
                    if let Some(l_ik_d_k) = scaled.get(&k) {
                        product += l_ik_d_k * l_jk;
                    }
                }
                let residual = m.get(i, j) - &unit * Rational::from_integer(product);
                residuals.add(i, j, residual);
            }
        }

        residuals.first_undominated(true)
    }

    /// Row i of L with its diagonal entry, by column.
    fn row_with_diagonal<'a>(
        &'a self,
        i: usize,
        one: &'a Integer,
    ) -> impl Iterator<Item = (usize, &'a Integer)> {
        let left = self.lower[i].iter().map(|(k, l_ik)| (*k, l_ik));
        left.chain([(i, one)])
    }

    /// The pivot after these rows is not positive: the direction x with L'x = e_i shows, exactly,
    /// whether x'Ax <= 0. `row` is row i of L.
    fn refute(&self, m: &Sparse, row: &LowerRow) -> DefiniteError {
        let i = self.lower.len();
        let mut x = vec![Integer::zero(); m.rows()]; // in units of 2^-FRACTION_BITS
        x[i] = Integer::one() << FRACTION_BITS;
        for (k, l_ik) in row {
            x[*k] = -l_ik.clone();
        }

        for j in (0..i).rev() {
            let x_j = x[j].clone();
            for (k, l_jk) in &self.lower[j] {
                x[*k] -= (l_jk * &x_j) >> FRACTION_BITS;
            }
        }

        let x: Vec<Rational> = x
            .into_iter()
            .map(|x_j| Rational::new(x_j, Integer::one() << FRACTION_BITS))
            .collect();
        let image = m.times(&x);
        let quadratic_form: Rational = image.iter().zip(&x).map(|(y_j, x_j)| y_j * x_j).sum();

        if quadratic_form.is_positive() {
            DefiniteError::Undecided { index: i }
        } else {
            DefiniteError::Not(NotDefinite {
                index: i,
                pivot: quadratic_form,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    /// tridiag(-1, d, -1) of order n: definite exactly for d > 2 cos(pi/(n+1)).
    fn chain(n: usize, d: Rational) -> Sparse {
        let off = (1..n).flat_map(|i| [(i, i - 1, whole(-1)), (i - 1, i, whole(-1))]);
        Sparse::from_entries(n, n, (0..n).map(|i| (i, i, d.clone())).chain(off))
    }

    #[test]
    fn both_methods_accept_the_chain() {
        let small = chain(12, whole(2));
        let factor = rational(1, 1_000_000_000_000_000);
        let tiny = Sparse::zeros(12, 12).add_scaled(&factor, &small);
        let large = chain(120, whole(2));

        assert_eq!(leading_minors(&small), Ok(()));
        assert_eq!(rounded_ldl(&small), Ok(()));
        assert_eq!(rounded_ldl(&tiny), Ok(()));
        assert_eq!(positive_definite(&large), Ok(()));
    }

    /// [[2, 1, 0], [1, 2, 1/1000], [0, 1/1000, corner]].
    fn with_corner(corner: Rational) -> Sparse {
        let entries = [
            (0, 0, whole(2)),
            (0, 1, whole(1)),
            (1, 0, whole(1)),
            (1, 1, whole(2)),
            (1, 2, rational(1, 1000)),
            (2, 1, rational(1, 1000)),
            (2, 2, corner),
        ];

        Sparse::from_entries(3, 3, entries)
    }

    /// By hand the minors are 6, 27 and 27 corner - 54: the last is zero at corner 2.
    #[test]
    fn pivots_of_the_elimination_are_the_minors() {
        let of = |corner: i64| {
            let rows = [[6, -3, 0], [-3, 6, -3], [0, -3, corner]];
            first_minor_not_positive(rows.map(|row| row.map(Integer::from).to_vec()).to_vec())
        };
        let last = |value: i64| {
            Some(Minor {
                index: 2,
                value: value.into(),
                previous: 27.into(),
            })
        };
        assert_eq!([of(6), of(3)], [None, None]);
        assert_eq!([of(2), of(1)], [last(0), last(-27)]);
    }

    fn refused_at_2(pivot: Rational) -> Result<(), DefiniteError> {
        Err(DefiniteError::Not(NotDefinite { index: 2, pivot }))
    }

    /// Rows with denominators of their own, and the value of the pivot that is refused.
    #[test]
    fn minors_of_fractions_give_the_pivot() {
        let edge = rational(2, 3_000_000); // (1/1000)^2 / (3/2)
        let definite = with_corner(&edge + rational(1, 1_000_000_000));
        let singular = with_corner(edge.clone());
        let indefinite = with_corner(&edge - rational(1, 7));

        assert_eq!(leading_minors(&definite), Ok(()));
        assert_eq!(leading_minors(&singular), refused_at_2(whole(0)));
        assert_eq!(leading_minors(&indefinite), refused_at_2(rational(-1, 7)));
    }

    #[test]
    fn both_methods_refuse_the_indefinite_chain_with_a_witness() {
        let small = chain(12, rational(19, 10));
        let large = chain(120, rational(19, 10));

        for result in [leading_minors(&small), rounded_ldl(&small)] {
            let Err(DefiniteError::Not(refuted)) = result else {
                panic!("{result:?}")
            };
            assert!(!refuted.pivot.is_positive());
        }

        let refused = positive_definite(&large);
        assert!(matches!(refused, Err(DefiniteError::Not(_))));
    }

    /// Entries (i, j) and (j, i) larger by 10^-6.
    fn disturbed(m: &Sparse, i: usize, j: usize) -> Sparse {
        let small = rational(1, 1_000_000);
        let entries = [(i, j, small.clone()), (j, i, small)];
        let off_diagonal = Sparse::from_entries(m.rows(), m.cols(), entries);
        m.add_scaled(&whole(1), &off_diagonal)
    }

    /// The factors of one matrix prove nothing about another one: the exact residual notices.
    #[test]
    fn a_factorisation_of_another_matrix_is_not_dominated() {
        let good = chain(12, whole(2));
        let other = chain(12, rational(19, 10));
        let disturbed = disturbed(&good, 11, 0);
        let fixed = Fixed::of(&good);
        let ldl = RoundedLdl::of(&good, &fixed).unwrap_or_else(|e| panic!("{e:?}"));

        assert_eq!(ldl.first_undominated(&good, &fixed), None);
        assert_eq!(ldl.first_undominated(&other, &fixed), Some(0));
        assert!(ldl.first_undominated(&disturbed, &fixed).is_some());
    }

    /// A matrix of order n by its entries.
    fn symmetric(n: usize, entry: impl Fn(usize, usize) -> Rational) -> Sparse {
        let mut entries = Vec::new();
        for i in 0..n {
            for j in 0..n {
                entries.push((i, j, entry(i, j)));
            }
        }

        Sparse::from_entries(n, n, entries)
    }

    #[test]
    fn a_singular_matrix_is_never_accepted() {
        let ones = symmetric(3, |_, _| whole(1));
        let many_ones = symmetric(60, |_, _| whole(1));

        assert!(matches!(
            positive_definite(&ones),
            Err(DefiniteError::Not(NotDefinite { index: 1, .. }))
        ));
        assert!(positive_definite(&many_ones).is_err());
        assert!(matches!(
            positive_definite(&Sparse::zeros(2, 2)),
            Err(DefiniteError::Not(NotDefinite { index: 0, .. }))
        ));
    }

    /// Order 6, without a zero: every row has its products.
    fn dense(diagonal: Rational) -> Sparse {
        symmetric(6, |i, j| {
            if i == j {
                diagonal.clone()
            } else {
                rational(1 + (i * j % 3) as i64, 4)
            }
        })
    }

    #[test]
    fn a_dense_matrix_is_accepted() {
        let definite = dense(whole(2));
        let indefinite = dense(rational(1, 10));

        assert_eq!(rounded_ldl(&definite), Ok(()));
        assert_eq!(leading_minors(&definite), Ok(()));
        assert!(rounded_ldl(&indefinite).is_err());
    }

    /// An entry off the diagonal is a residual of both its rows: the first of them is named.
    #[test]
    fn a_residual_off_the_diagonal_counts_for_both_rows() {
        let good = chain(12, whole(2));
        let fixed = Fixed::of(&good);
        let ldl = RoundedLdl::of(&good, &fixed).unwrap_or_else(|e| panic!("{e:?}"));

        for (i, j) in [(11, 0), (9, 4), (5, 4)] {
            let disturbed = disturbed(&good, i, j);
            assert_eq!(ldl.first_undominated(&disturbed, &fixed), Some(j));
        }
    }
}
