//! Cofactors of a matrix polynomial: the null vector of a singular value by Cramer's rule, all
//! values at once.
//!
//! The cofactors C_1, ..., C_n of the first row of M = A + tB + ... satisfy sum_j m_ij C_j = 0 for
//! i > 1 (expansion of a determinant with two equal rows) and sum_j m_1j C_j = det M. So where
//! det M = 0 the vector C is in the kernel of M, and where C != 0 the rank is n - 1 and C spans it.
//!
//! C is, up to a sign, the null vector of the last n - 1 rows whose entries are their maximal
//! minors; fraction-free elimination finds it at the integers t = 0, ..., d (n - 1), d the degree
//! of M, and interpolation gives the polynomials.
//!
//! Called by the oracle and the search, which then need no elimination at an algebraic number.

use super::kernel::{newton_interpolate, values_at};
use super::{Integer, Poly};
use num_traits::{One, Zero};

/// The cofactors of the first row of A + tB + ..., of degree d in t and order n, as polynomials of
/// degree d (n - 1) at most.
///
/// Where the determinant is 0 the vector is in the kernel (expansion along any other row has two
/// equal rows), and where it is not zero the rank is n - 1, so that it spans the kernel. The values
/// at t = 0, ..., d (n - 1) determine it, as they do the determinant ([`super::determinant`]).
///
/// ```
/// use mceip_exact::{first_row_cofactors, Integer, Poly};
/// let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
/// let c = first_row_cofactors(&[z([[1, 2], [3, 4]]), z([[1, 0], [0, 1]])]);
/// assert_eq!(c, [Poly::from_ints(&[4, 1]), Poly::from_ints(&[-3])]);
/// ```
pub fn first_row_cofactors(coefficients: &[Vec<Vec<Integer>>]) -> Vec<Poly> {
    let n = coefficients.first().map_or(0, Vec::len);
    if n == 0 {
        return Vec::new();
    }

    let degree = (n - 1) * (coefficients.len() - 1);
    let cofactors_at: Vec<Vec<Integer>> = (0..=degree)
        .map(|t| integer_cofactors(values_at(coefficients, t)))
        .collect();

    let mut polynomials = Vec::with_capacity(n);
    for j in 0..n {
        let values = cofactors_at.iter().map(|at_t| at_t[j].clone()).collect();
        polynomials.push(newton_interpolate(values));
    }

    polynomials
}

/// The cofactors of the first row of an integer matrix: the null vector of the other rows by
/// fraction-free Gauss-Jordan elimination, whose entries are the minors up to one common sign.
fn integer_cofactors(mut m: Vec<Vec<Integer>>) -> Vec<Integer> {
    let n = m.len();
    let mut m = m.split_off(1);
    let mut free_column = None; // the one column without a pivot
    let mut previous = Integer::one();
    let mut negate = false;

    for column in 0..n {
        let rank = column - usize::from(free_column.is_some());
        let Some(pivot_row) = (rank..n - 1).find(|&i| !m[i][column].is_zero()) else {
            if free_column.is_some() {
                return vec![Integer::zero(); n]; // rank < n - 1: every minor vanishes
            }
            free_column = Some(column);
            continue;
        };
        negate ^= pivot_row != rank;
        m.swap(rank, pivot_row);

        let pivots = m[rank].clone();
        let pivot = &pivots[column];
        for (i, row) in m.iter_mut().enumerate() {
            if i == rank {
                continue;
            }
            let factor = row[column].clone();
            // Earlier pivot columns hold a multiple of the identity, which nobody reads.
            for j in (column + 1..n).chain(free_column) {
                row[j] = (pivot * &row[j] - &factor * &pivots[j]) / &previous;
            }
        }
        previous = pivot.clone();
    }

    // n - 1 rows: one column is left over. Its minor is the last pivot, up to the row exchanges;
    // the cofactor has the sign (-1)^j.
    let free_column = free_column.unwrap_or(n - 1);
    negate ^= free_column % 2 == 1;

    let mut cofactors = vec![previous; n];
    for (row, column) in (0..n).filter(|&column| column != free_column).enumerate() {
        cofactors[column] = -&m[row][free_column];
    }

    if negate {
        for cofactor in &mut cofactors {
            *cofactor = -&*cofactor;
        }
    }

    cofactors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::integer_determinant;

    /// A linear congruential generator (Knuth's MMIX).
    struct Random(u64);

    impl Random {
        /// 0, 1 or 2.
        fn small(&mut self) -> Integer {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            Integer::from((self.0 >> 33) as i64 % 3)
        }
    }

    /// The cofactor of entry (0, j) by its definition.
    fn cofactor(m: &[Vec<Integer>], j: usize) -> Integer {
        let minor = m[1..]
            .iter()
            .map(|row| [&row[..j], &row[j + 1..]].concat())
            .collect();
        let det = integer_determinant(minor);

        if j % 2 == 1 { -det } else { det }
    }

    /// Each cofactor as the determinant it is defined by, on matrices of every rank.
    #[test]
    fn cofactors_agree_with_determinants_of_what_is_left() {
        let mut random = Random(12345);
        let mut singular = 0;

        for k in 0..300 {
            let n = 1 + k % 5;
            let m: Vec<Vec<Integer>> = (0..n)
                .map(|_| (0..n).map(|_| random.small()).collect())
                .collect();
            let expected: Vec<Integer> = (0..n).map(|j| cofactor(&m, j)).collect();
            singular += usize::from(expected.iter().all(Zero::is_zero));

            assert_eq!(integer_cofactors(m), expected);
        }

        assert!(singular > 5);
    }

    #[test]
    fn cofactors_of_a_pencil_are_polynomials() {
        let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
        let c = first_row_cofactors(&[z([[1, 2], [3, 4]]), z([[1, 0], [0, 1]])]);
        assert_eq!(c, [Poly::from_ints(&[4, 1]), Poly::from_ints(&[-3])]);

        // Of [1 + t^2, t; 2 t^2, 3], and of a matrix without rows.
        let coefficients = [[[1, 0], [0, 3]], [[0, 1], [0, 0]], [[1, 0], [2, 0]]].map(z);
        let c = first_row_cofactors(&coefficients);
        assert_eq!(c, [Poly::from_ints(&[3]), Poly::from_ints(&[0, 0, -2])]);
        assert!(first_row_cofactors(&[vec![], vec![]]).is_empty());
    }
}
