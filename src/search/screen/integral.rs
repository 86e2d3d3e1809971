//! The pencil over Z, free variables first, and proved bounds for the determinants of its supports.

use crate::exact::Integer;
use crate::model::Pencil;
use num_integer::Integer as _;
use num_traits::{One, ToPrimitive, Zero};

/// A + tB with each row multiplied by a positive rational that makes it integral and primitive.
/// Variables in the order free, slip; a support is a set of slip variables (bit k: the k-th).
#[derive(Debug)]
pub(super) struct Integral {
    pub(super) a: Vec<Vec<Integer>>,
    pub(super) b: Vec<Vec<Integer>>,
    /// Number of free variables.
    pub(super) free: usize,
    /// Number of complementarity variables.
    pub(super) slip: usize,
    rows: Side,
    cols: Side,
}

/// What rows (or columns) contribute to bounds.
#[derive(Debug)]
struct Side {
    /// log2 of the factor in Hadamard's bound, rounded up; at least 0.
    bits: Vec<f64>,
    /// Does B have an entry there?
    varies: Vec<bool>,
}

impl Side {
    fn of_rows(a: &[Vec<Integer>], b: &[Vec<Integer>]) -> Side {
        let square = |row: &Vec<Integer>| row.iter().map(|v| v * v).sum::<Integer>();
        Side {
            // (|a| + |b|)^2 <= 2 (|a|^2 + |b|^2)
            bits: a.iter().zip(b).map(|(a, b)| half_log2((square(a) + square(b)) * 2)).collect(),
            varies: b.iter().map(|b| !square(b).is_zero()).collect(),
        }
    }
}

fn transposed(m: &[Vec<Integer>]) -> Vec<Vec<Integer>> {
    (0..m.len()).map(|j| m.iter().map(|row| row[j].clone()).collect()).collect()
}

/// Rounding of a double logarithm and of sums of up to 100 of them stay far below this.
const LOG_SLACK: f64 = 1.0 / 1024.0 / 1024.0;

impl Integral {
    pub(super) fn of(pencil: &Pencil) -> Integral {
        let (a, b) = pencil.a().to_dense().clear_rows(&pencil.b().to_dense());
        let order: Vec<usize> = pencil.free().iter().copied().chain(pencil.slip()).collect();
        let permuted =
            |m: &[Vec<Integer>]| -> Vec<Vec<Integer>> { order.iter().map(|&i| order.iter().map(|&j| m[i][j].clone()).collect()).collect() };
        let (mut a, mut b) = (permuted(&a), permuted(&b));
        for (ra, rb) in a.iter_mut().zip(&mut b) {
            let gcd = ra.iter().chain(rb.iter()).fold(Integer::zero(), |g, v| g.gcd(v));
            if !gcd.is_zero() && !gcd.is_one() {
                ra.iter_mut().chain(rb.iter_mut()).for_each(|v| *v /= &gcd);
            }
        }
        let (rows, cols) = (Side::of_rows(&a, &b), Side::of_rows(&transposed(&a), &transposed(&b)));
        let n = order.len();
        Integral { a, b, free: pencil.free().len(), slip: n - pencil.free().len(), rows, cols }
    }

    /// Free and slip variables of a support, in this pencil's order.
    pub(super) fn active(&self, mask: u64) -> impl Iterator<Item = usize> + '_ {
        (0..self.free).chain((0..self.slip).filter(move |k| mask >> k & 1 == 1).map(|k| self.free + k))
    }

    /// A bound of the degree of the determinant of a support: rows, and columns, in which t occurs.
    pub(super) fn degree(&self, mask: u64) -> usize {
        let count = |side: &Side| self.active(mask).filter(|&i| side.varies[i]).count();
        count(&self.rows).min(count(&self.cols))
    }

    /// log2 of a bound of |c| for every coefficient c of the determinant of a support.
    ///
    /// On |t| = 1 Hadamard's inequality gives |det(A + tB)| <= prod_i (|a_i| + |b_i|) over the rows
    /// (or the columns), and Cauchy's estimate bounds every coefficient by the maximum there.
    pub(super) fn coefficient_bits(&self, mask: u64) -> f64 {
        let sum = |side: &Side| self.active(mask).map(|i| side.bits[i]).sum::<f64>();
        sum(&self.rows).min(sum(&self.cols))
    }

    /// What row `i` adds at most to [`Integral::coefficient_bits`].
    pub(super) fn row_bits(&self, i: usize) -> f64 {
        self.rows.bits[i]
    }
}

/// log2(v) / 2, rounded up, for v >= 1; 0 for v = 0 (the determinant is 0 then).
fn half_log2(v: Integer) -> f64 {
    if v.is_zero() {
        return 0.0;
    }
    let drop = v.bits().saturating_sub(60);
    let top = (v >> drop).to_u64().unwrap_or(u64::MAX) + 1; // at most 60 bits, rounded up
    ((top as f64).log2() + drop as f64) / 2.0 + LOG_SLACK
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Sparse, determinant};
    use num_traits::Signed;

    #[test]
    fn bounds_hold_and_are_not_absurd() {
        let a = Sparse::from_ints(&[&[3, -9, 1], &[4, 5, 0], &[-7, 2, 8]]);
        let b = Sparse::from_ints(&[&[0, 0, 0], &[1, -2, 6], &[9, 9, -9]]);
        let m = Integral::of(&Pencil::new(a, b, vec![0]).unwrap());
        for mask in 0..4 {
            let active: Vec<usize> = m.active(mask).collect();
            let cut = |m: &[Vec<Integer>]| -> Vec<Vec<Integer>> {
                active.iter().map(|&i| active.iter().map(|&j| m[i][j].clone()).collect()).collect()
            };
            let det = determinant(&cut(&m.a), &cut(&m.b));
            assert!(det.degree().unwrap_or(0) <= m.degree(mask));
            let bound = m.coefficient_bits(mask).exp2();
            assert!(det.coeffs().iter().all(|c| c.abs().to_f64().unwrap() <= bound), "{mask}");
            assert!(bound < 40_000.0);
        }
        assert_eq!((m.degree(0), m.degree(3)), (0, 2));
    }
}
