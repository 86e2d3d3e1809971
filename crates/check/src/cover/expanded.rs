//! The condensed pencil as a polynomial matrix with a remainder, enclosed over an interval by its
//! two ends (a chord), the bend between them and the remainder.

use super::CoverFault;
use super::family::{Ends, Matrix};
use super::short::Short;
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Fraction bits kept of each entry, as in `family`.
const FRACTION_BITS: u64 = 128;

/// Z(d) +- (weight_i |l_i(d)| |r_j(d)| + rounding_weight_i |v_i(d)| |rounding_j(d)|) with d = t -
/// center.
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
    /// tau / sigma: the weights hold at t = 0, at t they are divided by 1 + t tau / sigma.
    pub(super) gain: Rational,
    /// How many coefficients W and V have, and one more: a bound of the coefficients of Z.
    pub(super) coefficients: usize,
    /// Is this B + sA, and the value expanded in s = 1 / t?
    pub(super) reversed: bool,
}

impl Expanded {
    /// The ends over [lo, hi]; reversed, over the interval of s, the first still that of the lower
    /// t.
    pub(super) fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        if !self.reversed {
            return self.between(lo, hi);
        }
        if lo.is_zero() {
            return Err(CoverFault::Hypothesis {
                expected: "a region above 0 for a reversed anchor",
                row: 0,
            });
        }
        let ends = self.between(
            &hi.map_or_else(Rational::zero, Rational::recip),
            Some(&lo.recip()),
        )?;
        let ([m1, m0], [r1, r0]) = (ends.m, ends.r);
        // s = 0 itself is not part of the window.
        Ok(Ends {
            m: [m0, m1],
            r: [r0, r1],
            infinite: hi.is_none(),
            ..ends
        })
    }

    fn between(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        let n = self.weight.len();
        let linear = self.is_linear();
        let scale = Integer::one() << FRACTION_BITS;
        let d0 = lo - &self.center;
        // The smallest eigenvalue of F is at least that at the lower end, which is not negative.
        let factor = (Rational::one() + &self.gain * lo).recip();
        let weight: Vec<Rational> = self.weight.iter().map(|w| w * &factor).collect();
        let Some(hi) = hi else {
            if !linear {
                return Err(CoverFault::Hypothesis {
                    expected: "a tail above the last finite interval",
                    row: 0,
                });
            }
            // T(t) = T(lo) + (t - lo) Z_1, and the remainder is linear in t as well.
            let m1 = grid(n, |i, j| self.fixed(&self.z[1][i][j], &Integer::one()));
            let none = grid(n, |_, _| Integer::zero());
            let r = [
                self.remainder(&d0.abs(), &weight),
                self.remainder_direction(),
            ];
            return Ok(Ends {
                m: [self.at(&d0), m1],
                r,
                slope: none,
                scale,
                infinite: true,
            });
        };
        let (d1, width) = (hi - &self.center, hi - lo);
        let reach = d0.abs().max(d1.abs());
        let bend = self.bend(&reach, &width);
        let radius = |d: &Rational| {
            let remainder = self.remainder(if linear { d } else { &reach }, &weight);
            grid(n, |i, j| &bend[i][j] / 8 + 1 + &remainder[i][j])
        };
        let remainder_slope = self.remainder_slope(&reach, &width, &weight);
        // m[0] and m[1] are rounded as well: two units.
        let slope = grid(n, |i, j| &bend[i][j] + &remainder_slope[i][j] + 2);
        Ok(Ends {
            m: [self.at(&d0), self.at(&d1)],
            r: [radius(&d0.abs()), radius(&d1.abs())],
            slope,
            scale,
            infinite: false,
        })
    }

    /// The constant and the direction of a family that is linear in t = d, remainders included, in
    /// short numbers: at t >= 0 it is within (R_0 + t R_1) of Z_0 + t Z_1, and so between the ends
    /// of every interval.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        if self.reversed || !self.center.is_zero() || !self.is_linear() {
            return None;
        }
        let none = Rational::zero();
        let direction = grid(self.weight.len(), |i, j| {
            self.fixed(&self.z[1][i][j], &Integer::one())
        });
        let all: Vec<usize> = (0..self.weight.len()).collect();
        let constant = Short::of(&self.at(&none), &self.remainder(&none, &self.weight), &all)?;
        Some([
            constant,
            Short::of(&direction, &self.remainder_direction(), &all)?,
        ])
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
        grid(self.weight.len(), |i, j| {
            let (sum, power) = horner(self.z.iter().map(|z| z[i][j].clone()), d);
            self.fixed(&sum, &power)
        })
    }

    /// v / (unit power) in the fixed unit, rounded down.
    fn fixed(&self, v: &Integer, power: &Integer) -> Integer {
        (v << FRACTION_BITS).div_floor(&(&self.unit * power))
    }

    /// Bound of |Z''| width^2 for |d| <= reach.
    fn bend(&self, reach: &Rational, width: &Rational) -> Matrix {
        if self.z.iter().skip(2).flatten().flatten().all(Zero::is_zero) {
            return grid(self.weight.len(), |_, _| Integer::zero());
        }
        let (w, v) = (width.numer() * width.numer(), width.denom() * width.denom());
        grid(self.weight.len(), |i, j| {
            let (sum, power) = horner(
                self.z
                    .iter()
                    .enumerate()
                    .skip(2)
                    .map(|(k, z)| z[i][j].abs() * (k * (k - 1))),
                reach,
            );
            up(&(sum * &w), &(&self.unit * power * &v))
        })
    }

    /// Bound of both remainders for |d| <= reach, and what rounding m down has cost.
    fn remainder(&self, reach: &Rational, weight: &[Rational]) -> Matrix {
        let of = |list: &[Vec<Integer>]| self.each(|i| norm(list, i, reach));
        let (l, r, v, q) = (
            of(&self.left),
            of(&self.right),
            of(&self.v),
            of(&self.rounding),
        );
        grid(self.weight.len(), |i, j| {
            weigh(&l[i], &r[j], &weight[i]) + weigh(&v[i], &q[j], &self.rounding_weight[i]) + 1
        })
    }

    /// The remainder of the direction Z_1 of a pencil that is linear.
    fn remainder_direction(&self) -> Matrix {
        let of = |list: &[Vec<Integer>], k: usize| {
            self.each(|i| {
                list.get(k)
                    .map_or_else(Integer::zero, |l| &l[i] << FRACTION_BITS)
            })
        };
        let (l, r, v, q) = (
            of(&self.left, 1),
            of(&self.right, 0),
            of(&self.v, 1),
            of(&self.rounding, 0),
        );
        grid(self.weight.len(), |i, j| {
            weigh(&l[i], &r[j], &self.weight[i]) + weigh(&v[i], &q[j], &self.rounding_weight[i]) + 1
        })
    }

    /// Bound of the remainders' derivative times the width: l' F^-1 r differentiated factor by
    /// factor.
    fn remainder_slope(&self, reach: &Rational, width: &Rational, weight: &[Rational]) -> Matrix {
        let of = |list: &[Vec<Integer>]| self.each(|i| norm(list, i, reach));
        let slope = |list: &[Vec<Integer>]| self.each(|i| norm_slope(list, i, reach));
        let (l, r, v, q) = (
            of(&self.left),
            of(&self.right),
            of(&self.v),
            of(&self.rounding),
        );
        let (dl, dr, dv, dq) = (
            slope(&self.left),
            slope(&self.right),
            slope(&self.v),
            slope(&self.rounding),
        );
        let times =
            |value: Integer, factor: &Rational| (value * factor.numer()).div_ceil(factor.denom());
        grid(self.weight.len(), |i, j| {
            let w = &weight[i];
            let second = weigh(&dl[i], &r[j], w)
                + weigh(&l[i], &dr[j], w)
                + times(weigh(&l[i], &r[j], w), &self.drift);
            let rounding = weigh(&dv[i], &q[j], &self.rounding_weight[i])
                + weigh(&v[i], &dq[j], &self.rounding_weight[i]);
            times(second + rounding, width)
        })
    }

    fn each(&self, f: impl Fn(usize) -> Integer) -> Vec<Integer> {
        (0..self.weight.len()).map(f).collect()
    }
}

/// sum c_k x^k as (numerator, denominator), not reduced: a fraction's gcd costs more than all else.
fn horner(
    coefficients: impl DoubleEndedIterator<Item = Integer>,
    x: &Rational,
) -> (Integer, Integer) {
    let (mut sum, mut power) = (Integer::zero(), Integer::one());
    let mut terms = 0;
    for c in coefficients.rev() {
        sum = sum * x.numer() + c * &power;
        power *= x.denom();
        terms += 1;
    }
    // One factor too many, unless there was no term at all.
    if terms == 0 {
        (sum, power)
    } else {
        (sum, power / x.denom())
    }
}

/// n / d in the fixed unit, rounded up; d > 0.
fn up(n: &Integer, d: &Integer) -> Integer {
    (n << FRACTION_BITS).div_ceil(d)
}

/// The product of two numbers in the fixed unit and a weight, rounded up to the fixed unit.
fn weigh(a: &Integer, b: &Integer, weight: &Rational) -> Integer {
    if a.is_zero() || b.is_zero() {
        return Integer::zero();
    }
    (a * b * weight.numer()).div_ceil(&(weight.denom() << FRACTION_BITS))
}

fn norm(list: &[Vec<Integer>], i: usize, reach: &Rational) -> Integer {
    let (sum, power) = horner(list.iter().map(|l| l[i].clone()), reach);
    up(&sum, &power)
}

fn norm_slope(list: &[Vec<Integer>], i: usize, reach: &Rational) -> Integer {
    let (sum, power) = horner(
        list.iter().enumerate().skip(1).map(|(k, l)| &l[i] * k),
        reach,
    );
    up(&sum, &power)
}

fn grid(n: usize, f: impl Fn(usize, usize) -> Integer) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| f(i, j)).collect()).collect()
}

#[cfg(test)]
mod tests;
