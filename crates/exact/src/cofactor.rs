//! Cofactors of a matrix pencil: the null vector of a singular value by Cramer's rule, all values
//! at once.

use super::kernel::{newton_interpolate, values_at};
use super::{Integer, Poly};
use num_traits::{One, Zero};

/// The cofactors of the first row of A + tB, as polynomials of degree < n in t.
///
/// Where det(A + tB) = 0 the vector is in the kernel (expansion along any other row has two equal
/// rows), and where it is not zero the rank is n - 1, so that it spans the kernel. The values at
/// t = 0, ..., n - 1 determine it, as they do the determinant ([`super::determinant`]).
///
/// ```
/// use mceip_exact::{first_row_cofactors, Integer, Poly};
/// let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
/// let c = first_row_cofactors(&z([[1, 2], [3, 4]]), &z([[1, 0], [0, 1]]));
/// assert_eq!(c, [Poly::from_ints(&[4, 1]), Poly::from_ints(&[-3])]);
/// ```
pub fn first_row_cofactors(a: &[Vec<Integer>], b: &[Vec<Integer>]) -> Vec<Poly> {
    let n = a.len();
    let at: Vec<Vec<Integer>> = (0..n)
        .map(|t| integer_cofactors(values_at(a, b, t)))
        .collect();
    (0..n)
        .map(|j| newton_interpolate(at.iter().map(|values| values[j].clone()).collect()))
        .collect()
}

/// The cofactors of the first row of an integer matrix: the null vector of the other rows by
/// fraction-free Gauss-Jordan elimination, whose entries are the minors up to one common sign.
fn integer_cofactors(mut m: Vec<Vec<Integer>>) -> Vec<Integer> {
    let n = m.len();
    let mut m = m.split_off(1);
    let mut passed = None; // the one column without a pivot
    let mut last = Integer::one();
    let mut negate = false;
    for c in 0..n {
        let rank = c - usize::from(passed.is_some());
        let Some(pivot) = (rank..n - 1).find(|&i| !m[i][c].is_zero()) else {
            if passed.replace(c).is_some() {
                return vec![Integer::zero(); n]; // rank < n - 1: every minor vanishes
            }
            continue;
        };
        negate ^= pivot != rank;
        m.swap(rank, pivot);
        let pivot_row = m[rank].clone();
        for (_, row) in m.iter_mut().enumerate().filter(|(i, _)| *i != rank) {
            let factor = row[c].clone();
            // Earlier pivot columns hold a multiple of the identity, which nobody reads.
            for j in (c + 1..n).chain(passed) {
                row[j] = (&pivot_row[c] * &row[j] - &factor * &pivot_row[j]) / &last;
            }
        }
        last = pivot_row[c].clone();
    }
    let free = passed.unwrap_or(n - 1); // n - 1 rows: one column is left over
    negate ^= free % 2 == 1;
    let columns = (0..n).filter(|&c| c != free);
    let mut cofactors = vec![last; n];
    columns
        .enumerate()
        .for_each(|(row, c)| cofactors[c] = -&m[row][free]);
    if negate {
        cofactors.into_iter().map(|c| -c).collect()
    } else {
        cofactors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::integer_determinant;

    /// Each cofactor as the determinant it is defined by, on matrices of every rank.
    #[test]
    fn cofactors_agree_with_determinants_of_what_is_left() {
        let mut state = 12345u64;
        let mut small = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            Integer::from((state >> 33) as i64 % 3)
        };
        let mut zero = 0;
        for k in 0..300 {
            let n = 1 + k % 5;
            let m: Vec<Vec<Integer>> = (0..n).map(|_| (0..n).map(|_| small()).collect()).collect();
            let minor = |j: usize| {
                m[1..]
                    .iter()
                    .map(|r| [&r[..j], &r[j + 1..]].concat())
                    .collect()
            };
            let expected: Vec<Integer> = (0..n)
                .map(|j| integer_determinant(minor(j)))
                .enumerate()
                .map(|(j, d)| if j % 2 == 1 { -d } else { d })
                .collect();
            zero += usize::from(expected.iter().all(Zero::is_zero));
            assert_eq!(integer_cofactors(m), expected);
        }
        assert!(zero > 5);
    }

    #[test]
    fn cofactors_of_a_pencil_are_polynomials() {
        let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
        let c = first_row_cofactors(&z([[1, 2], [3, 4]]), &z([[1, 0], [0, 1]]));
        assert_eq!(c, [Poly::from_ints(&[4, 1]), Poly::from_ints(&[-3])]);
    }
}
