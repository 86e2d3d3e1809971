//! Determinants and kernels of matrix pencils A + tB: fraction-free elimination (Bareiss 1968).
//!
//! Two ways, both without fractions:
//!
//! * det(A + tB) from its values at t = 0, ..., n, which are determinants of integer matrices, by
//!   Newton's interpolation;
//! * kernels by Gauss-Jordan elimination over `Z[t]`, with the pivots that are not zero at a given
//!   algebraic number, or not zero identically.
//!
//! Each step of fraction-free elimination with the pivot p and the previous pivot p' is
//!
//! ```text
//! m_ij <- (p m_ij - m_ic m_rj) / p'        (pivot row r, pivot column c)
//! ```
//!
//! and the division is exact, because all entries stay minors of the given matrix (Sylvester's
//! identity). So numbers stay as short as minors are.
//!
//! Matrices are lists of rows. Called by the oracle and the search.

use super::{Algebraic, Integer, Poly, Sign};
use num_traits::{One, Zero};

/// det(A + tB + ...) as a polynomial in t, for square integer matrices of one order n given by
/// rows: the coefficients of 1, t, ..., t^d.
///
/// The degree is at most d n, so the values at t = 0, ..., d n determine it; they are integer
/// determinants, and Newton's forward differences put them together without a fraction.
/// The determinant of the empty pencil is 1.
///
/// ```
/// use mceip_exact::{determinant, Integer, Poly};
/// let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
/// let d = determinant(&[z([[1, 2], [3, 4]]), z([[1, 0], [0, 1]])]);
/// assert_eq!(d, Poly::from_ints(&[-2, 5, 1])); // (1+t)(4+t) - 6
/// ```
pub fn determinant(coefficients: &[Vec<Vec<Integer>>]) -> Poly {
    let order = coefficients.first().map_or(0, Vec::len);
    let degree = order * coefficients.len().saturating_sub(1);
    let values = (0..=degree)
        .map(|t| integer_determinant(values_at(coefficients, t)))
        .collect();
    newton_interpolate(values)
}

/// A + tB + ... at an integer, by Horner's rule.
pub(super) fn values_at(coefficients: &[Vec<Vec<Integer>>], t: usize) -> Vec<Vec<Integer>> {
    let Some((highest, lower)) = coefficients.split_last() else {
        return Vec::new();
    };

    let mut values = highest.clone();
    for coefficient in lower.iter().rev() {
        for (row, added) in values.iter_mut().zip(coefficient) {
            for (value, added) in row.iter_mut().zip(added) {
                *value = &*value * t + added;
            }
        }
    }

    values
}

/// Determinant of an integer matrix by Bareiss' elimination; every division is exact.
pub(super) fn integer_determinant(mut m: Vec<Vec<Integer>>) -> Integer {
    let n = m.len();
    let mut previous = Integer::one();
    let mut negate = false;

    for k in 0..n {
        let Some(pivot_row) = (k..n).find(|&i| !m[i][k].is_zero()) else {
            return Integer::zero();
        };
        negate ^= pivot_row != k;
        m.swap(k, pivot_row);

        let (top, below) = m.split_at_mut(k + 1);
        let pivot = &top[k];
        for row in below {
            for j in k + 1..n {
                row[j] = (&pivot[k] * &row[j] - &row[k] * &pivot[j]) / &previous;
            }
        }
        previous = m[k][k].clone();
    }

    if negate { -previous } else { previous }
}

/// The integer polynomial of degree <= n with the given values at 0, ..., n.
///
/// Newton's formula: p(t) = sum_k (D^k p)(0) t (t-1) ... (t-k+1) / k!, D the forward difference.
/// All is multiplied by n! and divided by it at the end.
pub(super) fn newton_interpolate(mut values: Vec<Integer>) -> Poly {
    let n = values.len().saturating_sub(1);
    let factorial: Integer = (1..=n).map(Integer::from).product();

    let mut sum = Poly::default();
    let mut falling = Poly::constant(Integer::one()); // t (t-1) ... (t-k+1)
    let mut weight = factorial.clone(); // n! / k!
    for k in 0..=n {
        let difference = &values[0]; // (D^k p)(0)
        sum += &falling.scale(&(difference * &weight));

        for i in 0..values.len() - 1 {
            values[i] = &values[i + 1] - &values[i];
        }
        values.pop();
        falling = &falling * &Poly::from_ints(&[-(k as i64), 1]);
        weight /= k + 1;
    }

    sum.divided_by(&factorial)
}

/// A basis of the kernel of a matrix over `Z[t]` at t = `alpha`, as vectors of integer polynomials
/// to be evaluated there.
///
/// Fraction-free Gauss-Jordan elimination over `Z[t]` whose pivots are chosen *non-zero at alpha*,
/// which is decided exactly. Entries stay minors of the matrix (Sylvester's identity), so the
/// divisions are exact whatever columns were passed over. What is left below the pivots vanishes
/// at alpha, so the rank there is the number of pivots.
pub fn kernel_at(m: Vec<Vec<Poly>>, alpha: &mut Algebraic) -> Vec<Vec<Poly>> {
    let (kernel, _) = kernel_and_free_columns_at(m, alpha);
    kernel
}

/// [`kernel_at`] with the columns without a pivot: the k-th vector is at the k-th of them what the
/// others are at theirs, and zero at theirs.
pub fn kernel_and_free_columns_at(
    m: Vec<Vec<Poly>>,
    alpha: &mut Algebraic,
) -> (Vec<Vec<Poly>>, Vec<usize>) {
    let echelon = Echelon::of(m, |entry| alpha.sign_of(entry) != Sign::Zero);
    (echelon.kernel(), echelon.free_columns())
}

/// A basis over Q(t) of the kernel of a matrix over `Z[t]`, the columns of the pivots, and the last
/// pivot: a minor of the order of the rank. Where that minor does not vanish, the rank is the same
/// and the basis is one of the kernel at that t.
pub fn generic_kernel(m: Vec<Vec<Poly>>) -> (Vec<Vec<Poly>>, Vec<usize>, Poly) {
    let echelon = Echelon::of(m, |entry| !entry.is_zero());
    (echelon.kernel(), echelon.pivots, echelon.last_pivot)
}

/// All minors of full order of the given columns that are not identically zero, up to sign, for a
/// matrix over `Z[t]` with at least as many rows. With no column the one minor is 1.
pub fn minors(m: &[Vec<Poly>], columns: &[usize]) -> Vec<Poly> {
    let order = columns.len();
    let mut found = Vec::new();
    let mut rows: Vec<usize> = (0..order).collect();

    if order > m.len() {
        return found;
    }

    loop {
        let echelon = Echelon::of(submatrix(m, &rows, columns), |entry| !entry.is_zero());
        if echelon.pivots.len() == order {
            found.push(echelon.last_pivot);
        }
        if !advance_combination(&mut rows, m.len()) {
            return found;
        }
    }
}

/// The entries of a matrix by rows in these rows and columns.
pub fn submatrix<T: Clone>(m: &[Vec<T>], rows: &[usize], columns: &[usize]) -> Vec<Vec<T>> {
    rows.iter()
        .map(|&i| columns.iter().map(|&j| m[i][j].clone()).collect())
        .collect()
}

/// The next combination of indices below `limit` in lexicographic order; `false` after the last.
fn advance_combination(chosen: &mut [usize], limit: usize) -> bool {
    let order = chosen.len();
    let Some(k) = (0..order).rev().find(|&k| chosen[k] + order - k < limit) else {
        return false;
    };

    chosen[k] += 1;
    for later in k + 1..order {
        chosen[later] = chosen[later - 1] + 1;
    }

    true
}

/// The non-zero rows of a reduced row echelon form at `alpha` (up to factors), and their pivots:
/// their number is the rank.
pub fn row_echelon_at(m: Vec<Vec<Poly>>, alpha: &mut Algebraic) -> (Vec<Vec<Poly>>, Vec<usize>) {
    let mut echelon = Echelon::of(m, |entry| alpha.sign_of(entry) != Sign::Zero);
    echelon.rows.truncate(echelon.pivots.len());
    (echelon.rows, echelon.pivots)
}

/// What fraction-free Gauss-Jordan elimination leaves: row k has `last_pivot` in column
/// `pivots[k]`, where all other rows have 0.
struct Echelon {
    rows: Vec<Vec<Poly>>,
    pivots: Vec<usize>,
    /// 1 without pivots.
    last_pivot: Poly,
    columns: usize,
}

impl Echelon {
    /// Eliminates with the pivots that `is_usable` accepts, column by column.
    fn of(rows: Vec<Vec<Poly>>, mut is_usable: impl FnMut(&Poly) -> bool) -> Echelon {
        let columns = rows.first().map_or(0, Vec::len);
        let mut echelon = Echelon {
            rows,
            pivots: Vec::new(),
            last_pivot: Poly::constant(Integer::one()),
            columns,
        };

        for column in 0..columns {
            let rank = echelon.pivots.len();
            let pivot_row =
                (rank..echelon.rows.len()).find(|&i| is_usable(&echelon.rows[i][column]));
            if let Some(pivot_row) = pivot_row {
                echelon.rows.swap(rank, pivot_row);
                echelon.eliminate(rank, column);
                echelon.pivots.push(column);
            }
        }

        echelon
    }

    /// Clears the column in every row but the pivot row; divides by the previous pivot.
    fn eliminate(&mut self, pivot_row: usize, column: usize) {
        let pivots = self.rows[pivot_row].clone();
        let pivot = &pivots[column];

        for (i, row) in self.rows.iter_mut().enumerate() {
            if i == pivot_row {
                continue;
            }
            let factor = row[column].clone();
            for (entry, pivot_entry) in row.iter_mut().zip(&pivots) {
                let numerator = &(pivot * entry) - &(&factor * pivot_entry);
                // Exact: both sides are minors of the matrix (Sylvester's identity).
                *entry = numerator.exact_div(&self.last_pivot).unwrap_or(numerator);
            }
        }

        self.last_pivot = pivot.clone();
    }

    /// One vector for each column without a pivot.
    fn kernel(&self) -> Vec<Vec<Poly>> {
        let free = self.free_columns().into_iter();
        free.map(|column| self.kernel_vector(column)).collect()
    }

    /// The columns without a pivot.
    fn free_columns(&self) -> Vec<usize> {
        (0..self.columns)
            .filter(|column| !self.pivots.contains(column))
            .collect()
    }

    /// The kernel vector v that is d = `last_pivot` at one column j without a pivot and 0 at the
    /// others: pivot row k says d v_c + m_kj d = 0 at its pivot column c.
    fn kernel_vector(&self, free_column: usize) -> Vec<Poly> {
        let mut vector = vec![Poly::default(); self.columns];
        vector[free_column] = self.last_pivot.clone();
        for (row, &pivot_column) in self.rows.iter().zip(&self.pivots) {
            vector[pivot_column] = -&row[free_column];
        }

        vector
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nonnegative_roots;

    fn pencil(a: &[&[i64]], b: &[&[i64]]) -> Vec<Vec<Poly>> {
        a.iter()
            .zip(b)
            .map(|(ra, rb)| {
                ra.iter()
                    .zip(rb.iter())
                    .map(|(&x, &y)| Poly::from_ints(&[x, y]))
                    .collect()
            })
            .collect()
    }

    fn integers(m: &[&[i64]]) -> Vec<Vec<Integer>> {
        m.iter()
            .map(|r| r.iter().map(|&v| v.into()).collect())
            .collect()
    }

    /// The determinant by Leibniz' formula on polynomials: slow, obviously right.
    fn leibniz(m: &[Vec<Poly>]) -> Poly {
        let Some(first) = m.first() else {
            return Poly::from_ints(&[1]);
        };

        let mut sum = Poly::default();
        for (j, entry) in first.iter().enumerate() {
            let minor: Vec<Vec<Poly>> = m[1..]
                .iter()
                .map(|r| {
                    r.iter()
                        .enumerate()
                        .filter(|(k, _)| *k != j)
                        .map(|(_, p)| p.clone())
                        .collect()
                })
                .collect();
            let term = entry * &leibniz(&minor);
            sum = if j % 2 == 0 {
                &sum + &term
            } else {
                &sum - &term
            };
        }

        sum
    }

    #[test]
    fn determinant_agrees_with_leibniz() {
        let a: &[&[i64]] = &[
            &[0, 2, -1, 3],
            &[4, 0, 5, 1],
            &[7, -2, 0, 0],
            &[1, 1, 1, -6],
        ];

        let b: &[&[i64]] = &[&[1, 0, 2, 0], &[-3, 0, 0, 1], &[0, 4, 1, 0], &[2, 0, 0, 5]];
        let singular: &[&[i64]] = &[&[1, 2], &[2, 4]];

        let det = determinant(&[integers(a), integers(b)]);
        let det_of_singular = determinant(&[integers(singular), integers(singular)]);

        assert_eq!(det, leibniz(&pencil(a, b)));
        assert!(det_of_singular.is_zero());
        assert_eq!(determinant(&[]), Poly::from_ints(&[1]));
    }

    /// With a coefficient of t^2 the degree is twice the order.
    #[test]
    fn determinant_of_a_quadratic_pencil_agrees_with_leibniz() {
        let a: &[&[i64]] = &[&[0, 2, -1], &[4, 0, 5], &[7, -2, 0]];
        let b: &[&[i64]] = &[&[1, 0, 2], &[-3, 0, 0], &[0, 4, 1]];
        let c: &[&[i64]] = &[&[2, 0, 1], &[0, -1, 3], &[1, 1, 0]];

        let mut quadratic = pencil(a, b);
        for (row, added) in quadratic.iter_mut().zip(c) {
            for (entry, added) in row.iter_mut().zip(*added) {
                *entry += &Poly::from_ints(&[0, 0, *added]);
            }
        }

        let det = determinant(&[a, b, c].map(integers));
        assert_eq!(det.degree(), Some(6));
        assert_eq!(det, leibniz(&quadratic));
    }

    #[test]
    fn kernels_annihilate_and_have_the_right_dimension() {
        // diag(t-1, t-1, t-2) at t = 1: dimension 2; at t = 2: dimension 1.
        let m = pencil(
            &[&[-1, 0, 0], &[0, -1, 0], &[0, 0, -2]],
            &[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]],
        );

        let mut roots = nonnegative_roots(&Poly::from_ints(&[2, -3, 1]));
        for (alpha, dimension) in roots.iter_mut().zip([2, 1]) {
            let basis = kernel_at(m.clone(), alpha);
            assert_eq!(basis.len(), dimension);
            for v in &basis {
                assert!(v.iter().any(|p| alpha.sign_of(p) != Sign::Zero));
                for row in &m {
                    let product = crate::dot(row, v);
                    assert_eq!(alpha.sign_of(&product), Sign::Zero);
                }
            }
        }
    }

    #[test]
    fn a_pivot_that_vanishes_at_alpha_is_passed_over() {
        // [[t^2-2, 1], [1, 0]]-like: the first entry is zero at sqrt 2 but not identically.
        let m = vec![
            vec![Poly::from_ints(&[-2, 0, 1]), Poly::from_ints(&[0])],
            vec![Poly::from_ints(&[0]), Poly::from_ints(&[3])],
        ];

        let mut root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
        assert_eq!(kernel_at(m, &mut root).len(), 1);
    }
}
