//! The condensed pencil as a polynomial matrix with a remainder, enclosed over an interval by its two
//! ends (a chord), the bend between them and the remainder.

use super::CoverFault;
use super::family::{Ends, Matrix};
use crate::exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};

/// Fraction bits kept of each entry, as in `family`.
const FRACTION_BITS: u64 = 128;

/// Z(d) +- (weight_i |l_i(d)| |r_j(d)| + rounding_weight_i |v_i(d)| |rounding_j(d)|) with d = t - center.
pub(super) struct Expanded {
    pub(super) center: Rational,
    /// Coefficients of d^k, in units of 1 / `unit`.
    pub(super) z: Vec<Matrix>,
    pub(super) unit: Integer,
    /// Bounds of |l_i| and |r_j|, coefficient by coefficient.
    pub(super) left: Vec<Vec<Integer>>,
    pub(super) right: Vec<Vec<Integer>>,
    /// Per row: what turns |l_i| |r_j| into a bound of the remainder.
    pub(super) weight: Vec<Rational>,
    /// Bounds of |V_i| and of the part of |r_j| that is rounding, coefficient by coefficient.
    pub(super) v: Vec<Vec<Integer>>,
    pub(super) rounding: Vec<Vec<Integer>>,
    pub(super) rounding_weight: Vec<Rational>,
    /// |dF/dt| / sigma.
    pub(super) drift: Rational,
}

impl Expanded {
    pub(super) fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        let n = self.weight.len();
        let linear = self.is_linear();
        let scale = Integer::one() << FRACTION_BITS;
        let d0 = lo - &self.center;
        let Some(hi) = hi else {
            if !linear {
                return Err(CoverFault::Hypothesis { expected: "a tail above the last finite interval", row: 0 });
            }
            // T(t) = T(lo) + (t - lo) Z_1, and the remainder is linear in t as well.
            let r0 = grid(n, |i, j| up(&self.remainder(i, j, &d0.abs())) + 1);
            let slope = |list: &[Vec<Integer>], i: usize| whole(list.get(1).map_or_else(Integer::zero, |l| l[i].clone()));
            let constant = |list: &[Vec<Integer>], j: usize| whole(list.first().map_or_else(Integer::zero, |l| l[j].clone()));
            let r1 = grid(n, |i, j| {
                let second = slope(&self.left, i) * constant(&self.right, j) * &self.weight[i];
                let rounding = slope(&self.v, i) * constant(&self.rounding, j) * &self.rounding_weight[i];
                up(&(second + rounding)) + 1
            });
            let m1 = grid(n, |i, j| self.fixed(&self.z[1][i][j], &Integer::one()));
            let none = grid(n, |_, _| Integer::zero());
            return Ok(Ends { m: [self.at(&d0), m1], r: [r0, r1], slope: none, scale, infinite: true });
        };
        let (d1, width) = (hi - &self.center, hi - lo);
        let reach = d0.abs().max(d1.abs());
        let bend = grid_of(n, |i, j| self.bend(i, j, &reach) * &width * &width);
        let eighth = Rational::new(1.into(), 8.into());
        let radius = |d: &Rational| {
            let reach = if linear { d.abs() } else { reach.clone() };
            grid(n, |i, j| up(&(&bend[i][j] * &eighth + self.remainder(i, j, &reach))) + 1)
        };
        let slope = grid(n, |i, j| up(&(&bend[i][j] + self.remainder_slope(i, j, &reach) * &width)) + 2);
        Ok(Ends { m: [self.at(&d0), self.at(&d1)], r: [radius(&d0), radius(&d1)], slope, scale, infinite: false })
    }

    /// Is the condensed pencil linear in t, its remainder included?
    fn is_linear(&self) -> bool {
        let vanish = |list: &[Vec<Integer>]| list.iter().flatten().all(Zero::is_zero);
        self.drift.is_zero()
            && self.z.iter().skip(2).flatten().flatten().all(Zero::is_zero)
            && vanish(self.right.get(1..).unwrap_or_default())
            && vanish(self.left.get(2..).unwrap_or_default())
            && vanish(self.rounding.get(1..).unwrap_or_default())
            && vanish(self.v.get(2..).unwrap_or_default())
    }

    /// Z(d), rounded down to the fixed unit.
    fn at(&self, d: &Rational) -> Matrix {
        let (p, q) = (d.numer(), d.denom());
        let n = self.weight.len();
        let value = |i: usize, j: usize| {
            let (mut sum, mut power) = (Integer::zero(), Integer::one());
            for z in self.z.iter().rev() {
                sum = sum * p + &z[i][j] * &power;
                power *= q;
            }
            (sum, power / q) // one factor q too many
        };
        grid(n, |i, j| {
            let (sum, power) = value(i, j);
            self.fixed(&sum, &power)
        })
    }

    /// v / (unit power) in the fixed unit, rounded down.
    fn fixed(&self, v: &Integer, power: &Integer) -> Integer {
        num_integer::Integer::div_floor(&(v << FRACTION_BITS), &(&self.unit * power))
    }

    /// Bound of |Z''_ij| for |d| <= reach.
    fn bend(&self, i: usize, j: usize, reach: &Rational) -> Rational {
        let mut sum = Rational::zero();
        for (k, z) in self.z.iter().enumerate().skip(2).rev() {
            sum = sum * reach + Rational::new(z[i][j].abs() * (k * (k - 1)), self.unit.clone());
        }
        sum
    }

    fn remainder(&self, i: usize, j: usize, reach: &Rational) -> Rational {
        norm(&self.left, i, reach) * norm(&self.right, j, reach) * &self.weight[i]
            + norm(&self.v, i, reach) * norm(&self.rounding, j, reach) * &self.rounding_weight[i]
    }

    /// Bound of the remainder's derivative: l' F^-1 r differentiated factor by factor.
    fn remainder_slope(&self, i: usize, j: usize, reach: &Rational) -> Rational {
        let (l, r) = (norm(&self.left, i, reach), norm(&self.right, j, reach));
        let (dl, dr) = (norm_slope(&self.left, i, reach), norm_slope(&self.right, j, reach));
        let (v, q) = (norm(&self.v, i, reach), norm(&self.rounding, j, reach));
        let (dv, dq) = (norm_slope(&self.v, i, reach), norm_slope(&self.rounding, j, reach));
        (dl * &r + &l * dr + &l * &r * &self.drift) * &self.weight[i] + (dv * q + v * dq) * &self.rounding_weight[i]
    }
}

fn whole(v: Integer) -> Rational {
    Rational::from_integer(v)
}

fn norm(list: &[Vec<Integer>], i: usize, reach: &Rational) -> Rational {
    list.iter().rev().fold(Rational::zero(), |sum, l| sum * reach + whole(l[i].clone()))
}

fn norm_slope(list: &[Vec<Integer>], i: usize, reach: &Rational) -> Rational {
    list.iter().enumerate().skip(1).rev().fold(Rational::zero(), |sum, (k, l)| sum * reach + whole(&l[i] * k))
}

/// Rounded up to the fixed unit.
fn up(v: &Rational) -> Integer {
    (v * whole(Integer::one() << FRACTION_BITS)).ceil().to_integer()
}

fn grid(n: usize, f: impl Fn(usize, usize) -> Integer) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| f(i, j)).collect()).collect()
}

fn grid_of(n: usize, f: impl Fn(usize, usize) -> Rational) -> Vec<Vec<Rational>> {
    (0..n).map(|i| (0..n).map(|j| f(i, j)).collect()).collect()
}
