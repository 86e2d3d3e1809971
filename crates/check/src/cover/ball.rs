//! Numbers and matrices that are known up to a radius.

use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{Signed, Zero};

/// Every number within `radius` of `center`.
#[derive(Default)]
pub(super) struct Ball<N> {
    pub(super) center: N,
    pub(super) radius: N,
}

impl Ball<Integer> {
    /// Adds factor * (center +- radius).
    pub(super) fn add(&mut self, factor: &Integer, center: &Integer, radius: &Integer) {
        self.center += factor * center;
        if !radius.is_zero() {
            self.radius += factor.abs() * radius;
        }
    }

    /// The largest absolute value.
    pub(super) fn magnitude(&self) -> Integer {
        self.center.abs() + &self.radius
    }

    /// The sign of all these numbers, 0 if they differ.
    pub(super) fn sign(&self) -> i8 {
        if self.center > self.radius {
            1
        } else if -&self.center > self.radius {
            -1
        } else {
            0
        }
    }
}

/// Every square matrix whose entries lie within those of `r` of those of `m`, by rows.
#[derive(Clone)]
pub(super) struct BallMatrix<N> {
    pub(super) m: Vec<Vec<N>>,
    pub(super) r: Vec<Vec<N>>,
}

impl BallMatrix<Integer> {
    /// The zero matrix of this order.
    pub(super) fn zero(order: usize) -> BallMatrix<Integer> {
        let zero = vec![vec![Integer::zero(); order]; order];
        BallMatrix {
            m: zero.clone(),
            r: zero,
        }
    }

    /// The matrices with row i multiplied by 1 + d, |d| <= `shares[i]`.
    pub(super) fn with_rows_off(&self, shares: &[Rational]) -> BallMatrix<Integer> {
        let mut off = self.clone();
        for ((m, r), share) in self.m.iter().zip(&mut off.r).zip(shares) {
            if share.is_zero() {
                continue;
            }
            for (m, r) in m.iter().zip(r) {
                let largest = m.abs() + &*r;
                *r += (largest * share.numer()).div_ceil(share.denom());
            }
        }

        off
    }

    /// The multiples by a factor that is not negative.
    pub(super) fn times(&self, factor: &Integer) -> BallMatrix<Integer> {
        self.combine(factor, self, &Integer::zero())
    }

    /// q times this plus p times the other; neither factor is negative.
    pub(super) fn combine(
        &self,
        q: &Integer,
        other: &BallMatrix<Integer>,
        p: &Integer,
    ) -> BallMatrix<Integer> {
        BallMatrix {
            m: combination(&self.m, q, &other.m, p),
            r: combination(&self.r, q, &other.r, p),
        }
    }
}

/// q A + p B.
pub(super) fn combination(
    a: &[Vec<Integer>],
    q: &Integer,
    b: &[Vec<Integer>],
    p: &Integer,
) -> Vec<Vec<Integer>> {
    let mut sum = Vec::with_capacity(a.len());
    for (a, b) in a.iter().zip(b) {
        sum.push(a.iter().zip(b).map(|(a, b)| q * a + p * b).collect());
    }

    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn certain_signs_exclude_zero() {
        let of = |value: i64, radius: i64| {
            Ball {
                center: value.into(),
                radius: Integer::from(radius),
            }
            .sign()
        };
        let signs = [of(3, 2), of(2, 2), of(-2, 2), of(-3, 2)];
        assert_eq!(signs, [1, 0, 0, -1]);
        assert_eq!([of(0, 0), of(1, 0), of(-1, 0), of(0, 1)], [0, 1, -1, 0]);
    }
}
