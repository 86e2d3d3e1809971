//! Is a symmetric rational matrix positive definite? Proved either way, without floats.
//!
//! Small matrices: the leading minors. Large sparse ones, where exact elimination grows unbearable:
//! an LDL' rounded to short dyadic numbers whose *residual is computed exactly*, A = L D L' + E,
//! and A is definite if D > 0 and a shift s covers E: the factorisation is of A - sI, so A = LDL' +
//! (E' + sI) with E' + sI diagonally dominant (Gershgorin).

use super::definite_short::certainly_definite;
use super::{Integer, Rational, Sparse, common_denominator};
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
/// use mceip_exact::{Sparse, positive_definite, whole};
/// let m = Sparse::from_entries(
///     2,
///     2,
///     [
///         (0, 0, whole(2)),
///         (0, 1, whole(1)),
///         (1, 0, whole(1)),
///         (1, 1, whole(1)),
///     ],
/// );
/// assert!(positive_definite(&m).is_ok());
/// let semi = Sparse::from_entries(
///     2,
///     2,
///     [
///         (0, 0, whole(1)),
///         (0, 1, whole(1)),
///         (1, 0, whole(1)),
///         (1, 1, whole(1)),
///     ],
/// );
/// assert!(positive_definite(&semi).is_err());
/// ```
pub fn positive_definite(m: &Sparse) -> Result<(), DefiniteError> {
    // Most are far from singular: then machine integers prove it, a hundred times faster.
    if certainly_definite(m) {
        return Ok(());
    }
    if m.rows() <= EXACT_ORDER {
        leading_minors(m)
    } else {
        rounded_ldl(m)
    }
}

/// Are all leading minors positive (Sylvester's criterion)? Elimination without fractions
/// (Bareiss), each row multiplied by a positive integer first, so that no number is longer than a
/// minor; the upper triangle is enough.
fn leading_minors(m: &Sparse) -> Result<(), DefiniteError> {
    let n = m.rows();
    let factors: Vec<Integer> = (0..n)
        .map(|i| common_denominator(m.row(i).iter().map(|(_, v)| v)))
        .collect();
    let mut s = vec![vec![Integer::zero(); n]; n];
    for (i, factor) in factors.iter().enumerate() {
        for (j, v) in m.row(i) {
            s[i][*j] = v.numer() * (factor / v.denom());
        }
    }

    let mut previous = Integer::one();
    for k in 0..n {
        let minor = s[k][k].clone();
        if !minor.is_positive() {
            // The pivot of LDL' is the quotient of two minors; the row's factor is in the first of
            // them only.
            let pivot = Rational::new(minor, &previous * &factors[k]);
            return Err(DefiniteError::Not(NotDefinite { index: k, pivot }));
        }
        for i in k + 1..n {
            // Each number is a minor times the factors of its rows, so the lower triangle follows
            // from the upper one.
            let below = &s[k][i] * &factors[i] / &factors[k];
            for j in i..n {
                s[i][j] = (&minor * &s[i][j] - &below * &s[k][j]) / &previous; // exact
            }
        }
        previous = minor;
    }
    Ok(())
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

    fn round(&self, v: &Rational) -> Integer {
        (v / self.unit()).round().to_integer()
    }
}

fn rounded_ldl(m: &Sparse) -> Result<(), DefiniteError> {
    let fixed = Fixed::of(m);
    let (lower, pivots) = factor(m, &fixed)?;
    match first_undominated(m, &fixed, &lower, &pivots) {
        None => Ok(()),
        Some(index) => Err(DefiniteError::Undecided { index }),
    }
}

/// Rows of a unit lower factor, below the diagonal, in units of 2^-FRACTION_BITS.
type Lower = Vec<BTreeMap<usize, Integer>>;

/// The rounded factors L and D of A - sI, or what the first pivot that is not positive shows.
fn factor(m: &Sparse, fixed: &Fixed) -> Result<(Lower, Vec<Integer>), DefiniteError> {
    let shift = Integer::one() << (FRACTION_BITS - SHIFT_BITS);
    // Pivots in fixed units.
    let mut lower: Lower = Vec::with_capacity(m.rows());
    let mut pivots: Vec<Integer> = Vec::with_capacity(m.rows());
    for i in 0..m.rows() {
        let row = factor_row(m, fixed, i, &lower, &pivots);
        let square: Integer = row
            .iter()
            .map(|(k, l)| (l * l * &pivots[*k]) >> (2 * FRACTION_BITS))
            .sum();
        let pivot = fixed.round(&m.get(i, i)) - &shift - square;
        if !pivot.is_positive() {
            return Err(refute(m, i, &row, &lower));
        }
        lower.push(row);
        pivots.push(pivot);
    }
    Ok((lower, pivots))
}

/// Row i of L from the rows above: l_ij d_j = a_ij - sum_k l_ik d_k l_jk, within the skyline.
fn factor_row(
    m: &Sparse,
    fixed: &Fixed,
    i: usize,
    lower: &[BTreeMap<usize, Integer>],
    pivots: &[Integer],
) -> BTreeMap<usize, Integer> {
    let given: BTreeMap<usize, Integer> = m
        .row(i)
        .iter()
        .filter(|e| e.0 < i)
        .map(|(j, v)| (*j, fixed.round(v)))
        .collect();
    let Some((&first, _)) = given.first_key_value() else {
        return BTreeMap::new();
    };
    let mut scaled: BTreeMap<usize, Integer> = BTreeMap::new(); // l_ik d_k, fixed units
    let mut row = BTreeMap::new();
    for j in first..i {
        let mut value = given.get(&j).cloned().unwrap_or_default();
        for (k, l_jk) in lower[j].range(first..) {
            if let Some(s) = scaled.get(k) {
                value -= (s * l_jk) >> FRACTION_BITS;
            }
        }
        if !value.is_zero() {
            row.insert(j, (&value << FRACTION_BITS) / &pivots[j]);
            scaled.insert(j, value);
        }
    }
    row
}

/// Exact residual of the rounded factorisation of A - sI: the first row whose off-diagonal
/// residual is not covered by s plus its diagonal residual.
fn first_undominated(
    m: &Sparse,
    fixed: &Fixed,
    lower: &[BTreeMap<usize, Integer>],
    pivots: &[Integer],
) -> Option<usize> {
    // (L D L')_ij exactly, in units of fixed.unit() * 2^(-2 FRACTION_BITS).
    let one = Integer::one() << FRACTION_BITS;
    let with_diagonal = |i: usize| lower[i].iter().map(|(k, v)| (*k, v)).chain([(i, &one)]);
    let unit = fixed.unit() / Rational::from_integer(Integer::one() << (2 * FRACTION_BITS));
    let mut diagonal = vec![Rational::zero(); m.rows()];
    let mut off = vec![Rational::zero(); m.rows()];
    for i in 0..m.rows() {
        let scaled: BTreeMap<usize, Integer> =
            with_diagonal(i).map(|(k, l)| (k, l * &pivots[k])).collect();
        let start = scaled
            .first_key_value()
            .map_or(i, |e| *e.0)
            .min(m.row(i).first().map_or(i, |e| e.0));
        // Columns where either the product or A can be non-zero lie between start and i.
        for j in start..=i {
            let product: Integer = with_diagonal(j)
                .filter_map(|(k, l)| scaled.get(&k).map(|s| s * l))
                .sum();
            let residual = m.get(i, j) - &unit * Rational::from_integer(product);
            if i == j {
                diagonal[i] = residual;
            } else {
                off[i] += residual.abs();
                off[j] += residual.abs();
            }
        }
    }
    (0..m.rows()).find(|&i| diagonal[i] <= off[i])
}

/// The pivot of A - sI at row i is not positive: the direction x with L'x = e_i shows, exactly,
/// whether x'Ax <= 0.
fn refute(
    m: &Sparse,
    i: usize,
    row: &BTreeMap<usize, Integer>,
    lower: &[BTreeMap<usize, Integer>],
) -> DefiniteError {
    let mut x = vec![Integer::zero(); m.rows()];
    x[i] = Integer::one() << FRACTION_BITS;
    for (k, l) in row {
        x[*k] = -l.clone();
    }
    for j in (0..i).rev() {
        let value = x[j].clone();
        for (k, l) in &lower[j] {
            x[*k] -= (l * &value) >> FRACTION_BITS;
        }
    }
    let x: Vec<Rational> = x
        .into_iter()
        .map(|v| Rational::new(v, Integer::one() << FRACTION_BITS))
        .collect();
    let quadratic: Rational = m.times(&x).iter().zip(&x).map(|(a, b)| a * b).sum();
    if quadratic.is_positive() {
        DefiniteError::Undecided { index: i }
    } else {
        DefiniteError::Not(NotDefinite {
            index: i,
            pivot: quadratic,
        })
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
        assert_eq!(leading_minors(&chain(12, whole(2))), Ok(()));
        assert_eq!(rounded_ldl(&chain(12, whole(2))), Ok(()));
        let tiny = Sparse::zeros(12, 12)
            .add_scaled(&rational(1, 1_000_000_000_000_000), &chain(12, whole(2)));
        assert_eq!(rounded_ldl(&tiny), Ok(()));
        assert_eq!(positive_definite(&chain(120, whole(2))), Ok(()));
    }

    /// Rows with denominators of their own, and the value of the pivot that is refused.
    #[test]
    fn minors_of_fractions_give_the_pivot() {
        let of = |corner: Rational| {
            let entries = [(0, 0, whole(2)), (1, 1, whole(2)), (2, 2, corner)];
            let off = [
                (0, 1, whole(1)),
                (1, 0, whole(1)),
                (1, 2, rational(1, 1000)),
                (2, 1, rational(1, 1000)),
            ];
            leading_minors(&Sparse::from_entries(3, 3, entries.into_iter().chain(off)))
        };
        let edge = rational(2, 3_000_000); // (1/1000)^2 / (3/2)
        let refused = |pivot| Err(DefiniteError::Not(NotDefinite { index: 2, pivot }));

        assert_eq!(of(&edge + rational(1, 1_000_000_000)), Ok(()));
        assert_eq!(of(edge.clone()), refused(whole(0)));
        assert_eq!(of(&edge - rational(1, 7)), refused(rational(-1, 7)));
    }

    #[test]
    fn both_methods_refuse_the_indefinite_chain_with_a_witness() {
        for result in [
            leading_minors(&chain(12, rational(19, 10))),
            rounded_ldl(&chain(12, rational(19, 10))),
        ] {
            assert!(
                matches!(result, Err(DefiniteError::Not(NotDefinite { pivot, .. })) if !pivot.is_positive())
            );
        }
        assert!(matches!(
            positive_definite(&chain(120, rational(19, 10))),
            Err(DefiniteError::Not(_))
        ));
    }

    /// The factors of one matrix prove nothing about another one: the exact residual notices.
    #[test]
    fn a_factorisation_of_another_matrix_is_not_dominated() {
        let (good, other) = (chain(12, whole(2)), chain(12, rational(19, 10)));
        let fixed = Fixed::of(&good);
        let (lower, pivots) = factor(&good, &fixed).unwrap();
        assert_eq!(first_undominated(&good, &fixed, &lower, &pivots), None);
        assert_eq!(first_undominated(&other, &fixed, &lower, &pivots), Some(0));
        let off = Sparse::from_entries(
            12,
            12,
            [
                (11, 0, rational(1, 1_000_000)),
                (0, 11, rational(1, 1_000_000)),
            ],
        );
        assert!(
            first_undominated(&good.add_scaled(&whole(1), &off), &fixed, &lower, &pivots).is_some()
        );
    }

    #[test]
    fn a_singular_matrix_is_never_accepted() {
        let ones = |n: usize| {
            Sparse::from_entries(
                n,
                n,
                (0..n).flat_map(|i| (0..n).map(move |j| (i, j, whole(1)))),
            )
        };
        assert!(matches!(
            positive_definite(&ones(3)),
            Err(DefiniteError::Not(NotDefinite { index: 1, .. }))
        ));
        assert!(positive_definite(&ones(60)).is_err());
        assert!(matches!(
            positive_definite(&Sparse::zeros(2, 2)),
            Err(DefiniteError::Not(NotDefinite { index: 0, .. }))
        ));
    }

    /// I + ones: every row has its products.
    #[test]
    fn a_dense_matrix_is_accepted() {
        let dense = |n: usize, d: Rational| {
            let entry = move |i: usize, j: usize| {
                if i == j {
                    whole(1) + &d
                } else {
                    rational(1 + (i * j % 3) as i64, 4)
                }
            };
            Sparse::from_entries(
                n,
                n,
                (0..n)
                    .flat_map(|i| (0..n).map(move |j| (i, j)))
                    .map(|(i, j)| (i, j, entry(i, j)))
                    .collect::<Vec<_>>(),
            )
        };
        assert_eq!(
            [
                rounded_ldl(&dense(6, whole(1))),
                leading_minors(&dense(6, whole(1)))
            ],
            [Ok(()), Ok(())]
        );
        assert!(rounded_ldl(&dense(6, rational(-9, 10))).is_err());
    }

    /// An entry off the diagonal is a residual of both its rows: the first of them is named.
    #[test]
    fn a_residual_off_the_diagonal_counts_for_both_rows() {
        let good = chain(12, whole(2));
        let fixed = Fixed::of(&good);
        let (lower, pivots) = factor(&good, &fixed).unwrap();
        for (i, j) in [(11, 0), (9, 4), (5, 4)] {
            let off = Sparse::from_entries(
                12,
                12,
                [
                    (i, j, rational(1, 1_000_000)),
                    (j, i, rational(1, 1_000_000)),
                ],
            );
            assert_eq!(
                first_undominated(&good.add_scaled(&whole(1), &off), &fixed, &lower, &pivots),
                Some(j)
            );
        }
    }
}
