//! The condensed pencil about one anchor: a polynomial matrix with a remainder, enclosed over an
//! interval.
//!
//! With d = t - center, entry (i, j) of T(t) lies within
//!
//! ```text
//!     weight_i |l_i(d)| |r_j(d)| / (1 + t tau / sigma)  +  rounding_weight_i |v_i(d)| |q_j(d)|
//! ```
//!
//! of Z_ij(d), a polynomial (`condensed` derives both). Over [lo, hi] the ends are Z(lo) and Z(hi).
//! The chord between two values of a function differs from it by at most (hi - lo)^2 / 8 max |Z''|,
//! so the radius is that plus the remainders over the interval. The slope (hi - lo) T' differs from
//! Z(hi) - Z(lo) by at most (hi - lo)^2 max |Z''| plus (hi - lo) times the remainders' derivatives.
//! Polynomials are bounded on |d| <= reach by the sum of |coefficient| reach^k.
//!
//! If everything is linear in d, remainders included, there is nothing to bound between the ends:
//! the remainder at each end is the one there, and an infinite end is allowed, with the
//! coefficients of d as its direction.
//!
//! A *reversed* expansion is one of B + sA in s = 1 / t; an interval [lo, hi] of t is [1 / hi, 1 /
//! lo] there, and it reaches to infinity, s = 0.
//!
//! Entries are rounded to units of 2^-128, outward. Fractions are kept as numerator and denominator
//! without reducing them, because a gcd costs more than all else here. Called by `family`.

use super::ends::{Ends, FRACTION_BITS, Matrix};
use super::fault::CoverFault;
use super::short::Short;
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Bounds of norms of columns of a polynomial matrix: one vector per coefficient.
pub(super) type Norms = Vec<Vec<Integer>>;

/// Z(d) and the remainder's bounds.
pub(super) struct Expanded {
    pub(super) center: Rational,
    /// Coefficients of d^k, in units of 1 / `unit`.
    pub(super) z: Vec<Matrix>,
    pub(super) unit: Integer,
    /// Bounds of |l_i| and |r_j|, coefficient by coefficient.
    pub(super) left: Norms,
    pub(super) right: Norms,
    /// Per row: what turns |l_i| |r_j| into a bound of the remainder.
    pub(super) weight: Vec<Rational>,
    /// Bounds of |V_i| and of the part of |r_j| that is rounding, coefficient by coefficient.
    pub(super) v: Norms,
    pub(super) rounding: Norms,
    pub(super) rounding_weight: Vec<Rational>,
    /// |dF/dt| / sigma.
    pub(super) drift: Rational,
    /// tau / sigma: the weights hold at t = 0, at t they are divided by 1 + t tau / sigma.
    pub(super) gain: Rational,
    /// Bits of sigma and tau, by which every number of a remainder is longer.
    pub(super) bound_bits: u64,
    /// How many coefficients W and V have, and one more: a bound of the coefficients of Z.
    pub(super) coefficients: usize,
    /// Is this B + sA, and the value expanded in s = 1 / t?
    pub(super) reversed: bool,
}

/// The factors |l_i|, |r_j|, |v_i|, |q_j| of the remainders, in the fixed unit: their bounds, or
/// bounds of their derivatives.
struct Factors {
    left: Vec<Integer>,
    right: Vec<Integer>,
    v: Vec<Integer>,
    rounding: Vec<Integer>,
}

impl Expanded {
    /// The ends over [lo, hi]; of a reversed expansion those over the interval of s, the first
    /// still that of the lower t.
    pub(super) fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        if !self.reversed {
            return match hi {
                Some(hi) => Ok(self.between(lo, hi)),
                None => self.from(lo),
            };
        }

        if lo.is_zero() {
            return Err(CoverFault::Hypothesis {
                expected: "a region above 0 for a reversed anchor",
                row: 0,
            });
        }

        let lower_s = hi.map_or_else(Rational::zero, Rational::recip);
        let mut ends = self.between(&lower_s, &lo.recip());
        ends.m.swap(0, 1);
        ends.r.swap(0, 1);
        ends.infinite = hi.is_none(); // s = 0 itself is not part of the window
        Ok(ends)
    }

    /// The ends over [lo, infinity): T(t) = T(lo) + (t - lo) Z_1, and the remainder is linear in t
    /// as well.
    fn from(&self, lo: &Rational) -> Result<Ends, CoverFault> {
        if !self.is_linear() {
            return Err(CoverFault::Hypothesis {
                expected: "a tail above the last finite interval",
                row: 0,
            });
        }

        let d = lo - &self.center;
        let weight = self.weight_above(lo);
        Ok(Ends {
            m: [self.at(&d), self.direction()],
            r: [
                self.remainder(&d.abs(), &weight),
                self.remainder_direction(),
            ],
            slope: self.grid(|_, _| Integer::zero()),
            scale: Integer::one() << FRACTION_BITS,
            infinite: true,
        })
    }

    /// The ends over [lo, hi].
    fn between(&self, lo: &Rational, hi: &Rational) -> Ends {
        let d0 = lo - &self.center;
        let d1 = hi - &self.center;
        let width = hi - lo;
        let reach = d0.abs().max(d1.abs());
        let weight = self.weight_above(lo);

        let bend = self.bend(&reach, &width);
        let [r0, r1] = if self.is_linear() {
            [&d0, &d1].map(|d| self.radius(&bend, &self.remainder(&d.abs(), &weight)))
        } else {
            let remainder = self.remainder(&reach, &weight);
            let radius = self.radius(&bend, &remainder);
            [radius.clone(), radius]
        };

        // m[0] and m[1] are rounded as well: two units.
        let remainder_slope = self.remainder_slope(&reach, &width, &weight);
        let slope = self.grid(|i, j| &bend[i][j] + &remainder_slope[i][j] + 2);

        Ends {
            m: [self.at(&d0), self.at(&d1)],
            r: [r0, r1],
            slope,
            scale: Integer::one() << FRACTION_BITS,
            infinite: false,
        }
    }

    /// An eighth of the bend, rounded up, and the remainder.
    fn radius(&self, bend: &Matrix, remainder: &Matrix) -> Matrix {
        self.grid(|i, j| {
            let of_chord = &bend[i][j] / 8 + 1;
            of_chord + &remainder[i][j]
        })
    }

    /// The constant and the direction of a family that is linear in t = d, remainders included, in
    /// short numbers: at t >= 0 it is within (R_0 + t R_1) of Z_0 + t Z_1, and so between the ends
    /// of every interval.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        if self.reversed || !self.center.is_zero() || !self.is_linear() {
            return None;
        }

        let all: Vec<usize> = (0..self.order()).collect();
        let zero = Rational::zero();

        let remainder = self.remainder(&zero, &self.weight);
        let constant = Short::of(&self.at(&zero), &remainder, &all)?;
        let direction = Short::of(&self.direction(), &self.remainder_direction(), &all)?;
        Some([constant, direction])
    }

    fn order(&self) -> usize {
        self.weight.len()
    }

    /// Is the condensed pencil linear in t, its remainder included?
    fn is_linear(&self) -> bool {
        self.drift.is_zero()
            && self.z.iter().skip(2).flatten().flatten().all(Zero::is_zero)
            && vanishes_from(1, &self.right)
            && vanishes_from(2, &self.left)
            && vanishes_from(1, &self.rounding)
            && vanishes_from(2, &self.v)
    }

    /// The weights for values from `lo` on: the smallest eigenvalue of F is at least that at the
    /// lower end, which is not negative.
    fn weight_above(&self, lo: &Rational) -> Vec<Rational> {
        let growth = Rational::one() + &self.gain * lo;
        let factor = growth.recip();
        self.weight.iter().map(|w| w * &factor).collect()
    }

    /// Z(d), rounded down to the fixed unit.
    fn at(&self, d: &Rational) -> Matrix {
        self.grid(|i, j| {
            let value = horner(self.z.iter().map(|z| z[i][j].clone()), d);
            self.fixed(&value.numerator, &value.denominator)
        })
    }

    /// Z_1, the coefficient of d, rounded down to the fixed unit.
    fn direction(&self) -> Matrix {
        let one = Integer::one();
        let z_1 = &self.z[1];
        self.grid(|i, j| self.fixed(&z_1[i][j], &one))
    }

    /// v / (unit power) in the fixed unit, rounded down.
    fn fixed(&self, v: &Integer, power: &Integer) -> Integer {
        (v << FRACTION_BITS).div_floor(&(&self.unit * power))
    }

    /// Bound of |Z''| width^2 for |d| <= reach: the sum of k (k - 1) |Z_k| reach^(k - 2).
    fn bend(&self, reach: &Rational, width: &Rational) -> Matrix {
        if self.z.iter().skip(2).flatten().flatten().all(Zero::is_zero) {
            return self.grid(|_, _| Integer::zero());
        }

        let square_numerator = width.numer() * width.numer();
        let square_denominator = width.denom() * width.denom();

        self.grid(|i, j| {
            let coefficients = self.z.iter().enumerate().skip(2);
            let second = coefficients.map(|(k, z)| z[i][j].abs() * (k * (k - 1)));
            let bound = horner(second, reach);
            up(
                &(bound.numerator * &square_numerator),
                &(&self.unit * bound.denominator * &square_denominator),
            )
        })
    }

    /// Bound of both remainders for |d| <= reach, and what rounding m down has cost.
    fn remainder(&self, reach: &Rational, weight: &[Rational]) -> Matrix {
        let factors = self.factors(|norms, i| norm(norms, i, reach));
        self.weighted(&factors, weight)
    }

    /// The remainder of the direction Z_1 of a pencil that is linear: l and V may be linear, r and
    /// q are constant.
    fn remainder_direction(&self) -> Matrix {
        let factors = Factors {
            left: self.coefficient(&self.left, 1),
            right: self.coefficient(&self.right, 0),
            v: self.coefficient(&self.v, 1),
            rounding: self.coefficient(&self.rounding, 0),
        };
        self.weighted(&factors, &self.weight)
    }

    /// weight_i |l_i| |r_j| + rounding_weight_i |v_i| |q_j|, and one unit for a rounded entry.
    fn weighted(&self, factors: &Factors, weight: &[Rational]) -> Matrix {
        self.grid(|i, j| {
            let remainder = weigh(&factors.left[i], &factors.right[j], &weight[i]);
            let rounding = weigh(
                &factors.v[i],
                &factors.rounding[j],
                &self.rounding_weight[i],
            );
            remainder + rounding + 1
        })
    }

    /// Bound of the remainders' derivatives times the width: l' F^-1 r and V'q differentiated
    /// factor by factor, where d/dt F^-1 contributes the drift.
    fn remainder_slope(&self, reach: &Rational, width: &Rational, weight: &[Rational]) -> Matrix {
        let bound = self.factors(|norms, i| norm(norms, i, reach));
        let slope = self.factors(|norms, i| norm_slope(norms, i, reach));

        self.grid(|i, j| {
            let w = &weight[i];
            let by_left = weigh(&slope.left[i], &bound.right[j], w);
            let by_right = weigh(&bound.left[i], &slope.right[j], w);
            let by_f = weigh(&bound.left[i], &bound.right[j], w);
            let remainder = by_left + by_right + times_up(&by_f, &self.drift);

            let w = &self.rounding_weight[i];
            let by_v = weigh(&slope.v[i], &bound.rounding[j], w);
            let by_rounding = weigh(&bound.v[i], &slope.rounding[j], w);

            times_up(&(remainder + by_v + by_rounding), width)
        })
    }

    /// The factors of the remainders, each entry as `of` bounds it.
    fn factors(&self, of: impl Fn(&Norms, usize) -> Integer) -> Factors {
        let entries = |norms: &Norms| (0..self.order()).map(|i| of(norms, i)).collect();
        Factors {
            left: entries(&self.left),
            right: entries(&self.right),
            v: entries(&self.v),
            rounding: entries(&self.rounding),
        }
    }

    /// The coefficients of d^k in the fixed unit, zero if there are none.
    fn coefficient(&self, norms: &Norms, k: usize) -> Vec<Integer> {
        match norms.get(k) {
            Some(list) => list.iter().map(|norm| norm << FRACTION_BITS).collect(),
            None => vec![Integer::zero(); self.order()],
        }
    }

    /// The matrix with these entries.
    fn grid(&self, entry: impl Fn(usize, usize) -> Integer) -> Matrix {
        let n = self.order();
        (0..n)
            .map(|i| (0..n).map(|j| entry(i, j)).collect())
            .collect()
    }
}

/// Are all coefficients from d^k on zero?
fn vanishes_from(k: usize, norms: &Norms) -> bool {
    norms.iter().skip(k).flatten().all(Zero::is_zero)
}

/// A fraction that is not reduced.
struct Fraction {
    numerator: Integer,
    denominator: Integer,
}

/// sum c_k x^k.
fn horner(coefficients: impl DoubleEndedIterator<Item = Integer>, x: &Rational) -> Fraction {
    let mut numerator = Integer::zero();
    let mut power = Integer::one();
    let mut terms = 0;

    for c in coefficients.rev() {
        numerator = numerator * x.numer() + c * &power;
        power *= x.denom();
        terms += 1;
    }

    // The power has one factor too many, unless there was no term at all.
    let denominator = if terms == 0 { power } else { power / x.denom() };
    Fraction {
        numerator,
        denominator,
    }
}

/// n / d in the fixed unit, rounded up; d > 0.
fn up(n: &Integer, d: &Integer) -> Integer {
    (n << FRACTION_BITS).div_ceil(d)
}

/// The product of a number in the fixed unit and a factor, rounded up.
fn times_up(value: &Integer, factor: &Rational) -> Integer {
    (value * factor.numer()).div_ceil(factor.denom())
}

/// The product of two numbers in the fixed unit and a weight, rounded up to the fixed unit.
fn weigh(a: &Integer, b: &Integer, weight: &Rational) -> Integer {
    if a.is_zero() || b.is_zero() {
        return Integer::zero();
    }

    (a * b * weight.numer()).div_ceil(&(weight.denom() << FRACTION_BITS))
}

/// Bound of the norm of column i for |d| <= reach, in the fixed unit.
fn norm(norms: &Norms, i: usize, reach: &Rational) -> Integer {
    let bound = horner(norms.iter().map(|l| l[i].clone()), reach);
    up(&bound.numerator, &bound.denominator)
}

/// Bound of the norm of the derivative of column i for |d| <= reach, in the fixed unit.
fn norm_slope(norms: &Norms, i: usize, reach: &Rational) -> Integer {
    let coefficients = norms.iter().enumerate().skip(1);
    let bound = horner(coefficients.map(|(k, l)| &l[i] * k), reach);
    up(&bound.numerator, &bound.denominator)
}

#[cfg(test)]
mod tests;
