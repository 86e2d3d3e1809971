//! Determinants and kernels of matrix pencils A + tB: fraction-free elimination (Bareiss 1968).

use super::{Algebraic, Integer, Poly, Sign};
use num_traits::{One, Zero};

/// det(A + tB) as a polynomial in t, for square integer matrices given by rows.
///
/// The degree is at most n, so the values at t = 0, ..., n determine it; they are integer
/// determinants, and Newton's forward differences put them together without a fraction.
/// The determinant of the empty pencil is 1.
///
/// ```
/// use mceip_exact::{determinant, Integer, Poly};
/// let z = |m: [[i64; 2]; 2]| m.map(|r| r.map(Integer::from).to_vec()).to_vec();
/// let d = determinant(&z([[1, 2], [3, 4]]), &z([[1, 0], [0, 1]]));
/// assert_eq!(d, Poly::from_ints(&[-2, 5, 1])); // (1+t)(4+t) - 6
/// ```
pub fn determinant(a: &[Vec<Integer>], b: &[Vec<Integer>]) -> Poly {
    newton_interpolate(
        (0..=a.len())
            .map(|t| integer_determinant(values_at(a, b, t)))
            .collect(),
    )
}

/// A + tB at an integer.
pub(super) fn values_at(a: &[Vec<Integer>], b: &[Vec<Integer>], t: usize) -> Vec<Vec<Integer>> {
    a.iter()
        .zip(b)
        .map(|(ra, rb)| ra.iter().zip(rb).map(|(x, y)| x + y * t).collect())
        .collect()
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
pub(super) fn newton_interpolate(mut values: Vec<Integer>) -> Poly {
    let n = values.len().saturating_sub(1);
    let factorial: Integer = (1..=n).map(Integer::from).product();
    let mut sum = Poly::default();
    let mut falling = Poly::constant(Integer::one()); // t (t-1) ... (t-k+1)
    let mut weight = factorial.clone(); // n! / k!
    for k in 0..=n {
        sum = &sum + &falling.scale(&(&values[0] * &weight));
        for i in 0..values.len() - 1 {
            values[i] = &values[i + 1] - &values[i];
        }
        values.pop();
        falling = &falling * &Poly::from_ints(&[-(k as i64), 1]);
        weight /= k + 1;
    }
    Poly::new(sum.coeffs().iter().map(|c| c / &factorial).collect())
}

/// A basis of the kernel of a matrix over `Z[t]` at t = `alpha`, as vectors of integer polynomials
/// to be evaluated there.
///
/// Fraction-free Gauss-Jordan elimination over `Z[t]` whose pivots are chosen *non-zero at alpha*,
/// which is decided exactly. Entries stay minors of the matrix (Sylvester's identity), so the
/// divisions are exact whatever columns were passed over. What is left below the pivots vanishes
/// at alpha, so the rank there is the number of pivots.
pub fn kernel_at(m: Vec<Vec<Poly>>, alpha: &mut Algebraic) -> Vec<Vec<Poly>> {
    let Echelon {
        rows,
        pivots,
        last,
        cols,
    } = echelon(m, |p| alpha.sign_of(p) != Sign::Zero);
    (0..cols)
        .filter(|j| !pivots.contains(j))
        .map(|j| kernel_vector(&rows, &pivots, &last, j, cols))
        .collect()
}

/// A basis over Q(t) of the kernel of a matrix over `Z[t]`, the columns of the pivots, and the last
/// pivot: a minor of the order of the rank. Where that minor does not vanish, the rank is the same
/// and the basis is one of the kernel at that t.
pub fn generic_kernel(m: Vec<Vec<Poly>>) -> (Vec<Vec<Poly>>, Vec<usize>, Poly) {
    let Echelon {
        rows,
        pivots,
        last,
        cols,
    } = echelon(m, |p| !p.is_zero());
    let basis = (0..cols)
        .filter(|j| !pivots.contains(j))
        .map(|j| kernel_vector(&rows, &pivots, &last, j, cols))
        .collect();
    (basis, pivots, last)
}

/// All minors of full order of the given columns that are not identically zero, for a matrix over
/// `Z[t]` with at least as many rows. With no column the one minor is 1.
pub fn minors(m: &[Vec<Poly>], columns: &[usize]) -> Vec<Poly> {
    let order = columns.len();
    let mut found = Vec::new();
    let mut chosen: Vec<usize> = (0..order).collect();
    while chosen.last().is_none_or(|&r| r < m.len()) {
        let square = chosen
            .iter()
            .map(|&i| columns.iter().map(|&j| m[i][j].clone()).collect())
            .collect();
        let minor = echelon(square, |p| !p.is_zero());
        if minor.pivots.len() == order {
            found.push(minor.last); // up to sign
        }
        // The next combination of rows in lexicographic order.
        let Some(k) = (0..order).rev().find(|&k| chosen[k] + order - k < m.len()) else {
            break;
        };
        chosen[k] += 1;
        (k + 1..order).for_each(|l| chosen[l] = chosen[l - 1] + 1);
    }
    found
}

/// The non-zero rows of a reduced row echelon form at `alpha` (up to factors), and their pivots:
/// their number is the rank.
pub fn row_echelon_at(m: Vec<Vec<Poly>>, alpha: &mut Algebraic) -> (Vec<Vec<Poly>>, Vec<usize>) {
    let mut e = echelon(m, |p| alpha.sign_of(p) != Sign::Zero);
    e.rows.truncate(e.pivots.len());
    (e.rows, e.pivots)
}

/// What fraction-free Gauss-Jordan elimination leaves.
struct Echelon {
    rows: Vec<Vec<Poly>>,
    pivots: Vec<usize>,
    last: Poly,
    cols: usize,
}

/// Fraction-free Gauss-Jordan elimination with the pivots that `usable` accepts.
fn echelon(mut m: Vec<Vec<Poly>>, mut usable: impl FnMut(&Poly) -> bool) -> Echelon {
    let (rows, cols) = (m.len(), m.first().map_or(0, Vec::len));
    let mut pivots: Vec<usize> = Vec::new();
    let mut last = Poly::constant(Integer::one());
    for col in 0..cols {
        let rank = pivots.len();
        let Some(r) = (rank..rows).find(|&i| usable(&m[i][col])) else {
            continue;
        };
        m.swap(rank, r);
        eliminate(&mut m, rank, col, &last);
        last = m[rank][col].clone();
        pivots.push(col);
    }
    Echelon {
        rows: m,
        pivots,
        last,
        cols,
    }
}

/// Clears column `col` in every row but `rank`; divides by the previous pivot.
fn eliminate(m: &mut [Vec<Poly>], rank: usize, col: usize, last: &Poly) {
    let pivot_row = m[rank].clone();
    for (i, row) in m.iter_mut().enumerate() {
        if i == rank {
            continue;
        }
        let factor = row[col].clone();
        for (entry, p) in row.iter_mut().zip(&pivot_row) {
            let numerator = &(&pivot_row[col] * entry) - &(&factor * p);
            // Exact: both sides are minors of the matrix (Sylvester's identity).
            *entry = numerator.exact_div(last).unwrap_or(numerator);
        }
    }
}

/// The kernel vector with `last` at the free column `j`: d x_c + m_j d' = 0 in each pivot row.
fn kernel_vector(
    m: &[Vec<Poly>],
    pivots: &[usize],
    last: &Poly,
    j: usize,
    cols: usize,
) -> Vec<Poly> {
    let mut v = vec![Poly::default(); cols];
    v[j] = last.clone();
    for (k, &c) in pivots.iter().enumerate() {
        v[c] = -&m[k][j];
    }
    v
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
        assert_eq!(
            determinant(&integers(a), &integers(b)),
            leibniz(&pencil(a, b))
        );
        assert_eq!(determinant(&[], &[]), Poly::from_ints(&[1]));
        let singular: &[&[i64]] = &[&[1, 2], &[2, 4]];
        assert!(determinant(&integers(singular), &integers(singular)).is_zero());
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
                    let product = row
                        .iter()
                        .zip(v)
                        .fold(Poly::default(), |s, (p, x)| &s + &(p * x));
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
