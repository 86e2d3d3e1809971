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

use super::ball::BallMatrix;
use super::ends::{Ends, FRACTION_BITS, LongMatrix};
use super::fault::CoverFault;
use super::spread::MemberSpread;
use mceip_exact::{Integer, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Bounds of norms of columns of a polynomial matrix: one vector per coefficient.
pub(super) type Norms = Vec<Vec<Integer>>;

/// Z(d) and the remainder's bounds.
pub(super) struct Expanded {
    pub(super) center: Rational,
    /// Coefficients of d^k, in units of 1 / `unit`.
    pub(super) z: Vec<LongMatrix>,
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
    /// What the entries of a member may be off beside the remainder, in the fixed unit, over the
    /// intervals that the anchor serves; where the data have radii.
    pub(super) spread: Option<LongMatrix>,
}

/// The factors |l_i|, |r_j|, |v_i|, |q_j| of the remainders, in the fixed unit: their bounds, or
/// bounds of their derivatives.
struct RemainderFactors {
    left: Vec<Integer>,
    right: Vec<Integer>,
    v: Vec<Integer>,
    rounding: Vec<Integer>,
}

/// The interval [lo, hi] of t, or of s = 1 / t for what is reversed; `None` where that has no upper
/// end because the interval begins at 0.
pub(super) fn own_interval(
    reversed: bool,
    lo: &Rational,
    hi: Option<&Rational>,
) -> Option<(Rational, Option<Rational>)> {
    if !reversed {
        return Some((lo.clone(), hi.cloned()));
    }
    if lo.is_zero() {
        return None;
    }

    let lower_s = hi.map_or_else(Rational::zero, Rational::recip);
    Some((lower_s, Some(lo.recip())))
}

impl Expanded {
    /// Adds what members may be off.
    pub(super) fn spread(&mut self, spread: MemberSpread) {
        for (norms, more) in [
            (&mut self.left, spread.left),
            (&mut self.right, spread.right),
        ] {
            // A residual has two coefficients at least.
            for (norm, more) in norms[0].iter_mut().zip(more) {
                *norm += more;
            }
        }

        self.spread = Some(spread.entries);
    }

    /// The ends over [lo, hi]; of a reversed expansion those over the interval of s, the first
    /// still that of the lower t.
    pub(super) fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        let (own_lo, own_hi) = self.own_interval(lo, hi)?;
        let mut ends = match &own_hi {
            Some(own_hi) => self.between(&own_lo, own_hi),
            None => self.from(&own_lo)?,
        };

        if self.reversed {
            ends.at.swap(0, 1);
            ends.infinite = hi.is_none(); // s = 0 itself is not part of the window
        }

        Ok(ends)
    }

    fn own_interval(
        &self,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<(Rational, Option<Rational>), CoverFault> {
        let expected = "a region above 0 for a reversed anchor";
        let own = own_interval(self.reversed, lo, hi);
        own.ok_or_else(|| CoverFault::hypothesis(expected, 0))
    }

    /// The ends over [lo, infinity): T(t) = T(lo) + (t - lo) Z_1, and the remainder is linear in t
    /// as well.
    fn from(&self, lo: &Rational) -> Result<Ends, CoverFault> {
        self.require_linear()?;

        let d = lo - &self.center;
        let weight = self.weight_above(lo);
        Ok(Ends {
            at: [
                BallMatrix {
                    m: self.at(&d),
                    r: self.remainder(&d.abs(), &weight),
                },
                BallMatrix {
                    m: self.direction(),
                    r: self.remainder_direction(),
                },
            ],
            slope: None,
            scale: Integer::one() << FRACTION_BITS,
            infinite: true,
        })
    }

    /// The ends over [lo, hi].
    fn between(&self, lo: &Rational, hi: &Rational) -> Ends {
        let d0 = lo - &self.center;
        let d1 = hi - &self.center;
        let reach = d0.abs().max(d1.abs());
        let weight = self.weight_above(lo);

        let bend = self.bend(&reach, &(hi - lo));
        let [r0, r1] = if self.is_linear() {
            [&d0, &d1].map(|d| self.radius(&bend, &self.remainder(&d.abs(), &weight)))
        } else {
            let remainder = self.remainder(&reach, &weight);
            let radius = self.radius(&bend, &remainder);
            [radius.clone(), radius]
        };

        Ends {
            at: [(d0, r0), (d1, r1)].map(|(d, r)| BallMatrix { m: self.at(&d), r }),
            slope: None,
            scale: Integer::one() << FRACTION_BITS,
            infinite: false,
        }
    }

    /// Bound of how far (hi - lo) T' may be from the difference of the ends over [lo, hi].
    pub(super) fn slope(
        &self,
        lo: &Rational,
        hi: Option<&Rational>,
    ) -> Result<LongMatrix, CoverFault> {
        let (own_lo, own_hi) = self.own_interval(lo, hi)?;
        match own_hi {
            Some(own_hi) => Ok(self.slope_between(&own_lo, &own_hi)),
            None => {
                self.require_linear()?;
                Ok(self.grid(|_, _| Integer::zero()))
            }
        }
    }

    fn slope_between(&self, lo: &Rational, hi: &Rational) -> LongMatrix {
        let width = hi - lo;
        let reach = (lo - &self.center).abs().max((hi - &self.center).abs());
        let weight = self.weight_above(lo);

        // m[0] and m[1] are rounded as well: two units.
        let bend = self.bend(&reach, &width);
        let remainder_slope = self.remainder_slope(&reach, &width, &weight);
        self.grid(|i, j| &bend[i][j] + &remainder_slope[i][j] + 2)
    }

    /// An eighth of the bend, rounded up, and the remainder.
    fn radius(&self, bend: &LongMatrix, remainder: &LongMatrix) -> LongMatrix {
        self.grid(|i, j| {
            let of_chord = &bend[i][j] / 8 + 1;
            of_chord + &remainder[i][j]
        })
    }

    fn order(&self) -> usize {
        self.weight.len()
    }

    /// Demands what a half line needs. The spread is that of an interval.
    fn require_linear(&self) -> Result<(), CoverFault> {
        if self.is_linear() && self.spread.is_none() {
            return Ok(());
        }

        let expected = "a tail above the last finite interval";
        Err(CoverFault::hypothesis(expected, 0))
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

        let mut weights = Vec::with_capacity(self.order());
        for w in &self.weight {
            let numerator = w.numer() * growth.denom();
            weights.push(Rational::new_raw(numerator, w.denom() * growth.numer()));
        }

        weights
    }

    /// Z(d), rounded down to the fixed unit.
    fn at(&self, d: &Rational) -> LongMatrix {
        let at_d = Functional::derivative(0, self.z.len(), d).in_fixed_unit();
        let unit = OddDivisor::of(&self.unit * &at_d.denominator);
        self.grid(|i, j| unit.floor(at_d.numerator(self.entry(i, j))))
    }

    /// Z_1, the coefficient of d, rounded down to the fixed unit.
    fn direction(&self) -> LongMatrix {
        let z_1 = &self.z[1];
        self.grid(|i, j| (&z_1[i][j] << FRACTION_BITS).div_floor(&self.unit))
    }

    /// The coefficients of Z_ij.
    fn entry(&self, i: usize, j: usize) -> impl Iterator<Item = &Integer> {
        self.z.iter().map(move |z| &z[i][j])
    }

    /// Bound of |Z''| width^2 for |d| <= reach: the sum of k (k - 1) |Z_k| reach^(k - 2).
    fn bend(&self, reach: &Rational, width: &Rational) -> LongMatrix {
        let second = Functional::derivative(2, self.z.len(), reach).in_fixed_unit();
        let square_numerator = width.numer() * width.numer();
        let square_denominator = width.denom() * width.denom();
        let unit = OddDivisor::of(&self.unit * &second.denominator * square_denominator);

        self.grid(|i, j| {
            let bound = second.bound(self.entry(i, j)) * &square_numerator;
            unit.ceil(bound)
        })
    }

    /// Bound of both remainders for |d| <= reach, what rounding m down has cost, and the spread.
    fn remainder(&self, reach: &Rational, weight: &[Rational]) -> LongMatrix {
        let factors = self.factors(0, reach);
        let remainder = self.weighted(&factors, weight);
        match &self.spread {
            Some(spread) => self.grid(|i, j| &remainder[i][j] + &spread[i][j]),
            None => remainder,
        }
    }

    /// The remainder of the direction Z_1 of a pencil that is linear: l and V may be linear, r and
    /// q are constant.
    fn remainder_direction(&self) -> LongMatrix {
        let factors = RemainderFactors {
            left: self.coefficient(&self.left, 1),
            right: self.coefficient(&self.right, 0),
            v: self.coefficient(&self.v, 1),
            rounding: self.coefficient(&self.rounding, 0),
        };
        self.weighted(&factors, &self.weight)
    }

    /// weight_i |l_i| |r_j| + rounding_weight_i |v_i| |q_j|, and one unit for a rounded entry.
    fn weighted(&self, factors: &RemainderFactors, weight: &[Rational]) -> LongMatrix {
        let remainder = weighted_products(&factors.left, &factors.right, weight);
        let rounding = weighted_products(&factors.v, &factors.rounding, &self.rounding_weight);
        self.grid(|i, j| &remainder[i][j] + &rounding[i][j] + 1)
    }

    /// Bound of the remainders' derivatives times the width: l' F^-1 r and V'q differentiated
    /// factor by factor, where d/dt F^-1 contributes the drift.
    fn remainder_slope(
        &self,
        reach: &Rational,
        width: &Rational,
        weight: &[Rational],
    ) -> LongMatrix {
        let bound = self.factors(0, reach);
        let slope = self.factors(1, reach);

        let by_left = weighted_products(&slope.left, &bound.right, weight);
        let by_right = weighted_products(&bound.left, &slope.right, weight);
        let by_f = weighted_products(&bound.left, &bound.right, weight);
        let by_v = weighted_products(&slope.v, &bound.rounding, &self.rounding_weight);
        let by_rounding = weighted_products(&bound.v, &slope.rounding, &self.rounding_weight);

        self.grid(|i, j| {
            let of_f = times_up(&by_f[i][j], &self.drift);
            let remainder = &by_left[i][j] + &by_right[i][j] + of_f;
            let rounding = &by_v[i][j] + &by_rounding[i][j];
            times_up(&(remainder + rounding), width)
        })
    }

    /// Bounds of the factors of the remainders for |d| <= reach (`order` 0), or of their
    /// derivatives (1).
    fn factors(&self, order: usize, reach: &Rational) -> RemainderFactors {
        let bounds = |norms: &Norms| {
            let bound = Functional::derivative(order, norms.len(), reach).in_fixed_unit();
            let of_column = |i| {
                let numerator = bound.bound(norms.iter().map(|list| &list[i]));
                numerator.div_ceil(&bound.denominator)
            };
            (0..self.order()).map(of_column).collect()
        };

        RemainderFactors {
            left: bounds(&self.left),
            right: bounds(&self.right),
            v: bounds(&self.v),
            rounding: bounds(&self.rounding),
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
    fn grid(&self, entry: impl Fn(usize, usize) -> Integer) -> LongMatrix {
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

/// A linear function of the coefficients c_k of a polynomial: sum c_k weights_k / denominator. The
/// fraction is not reduced.
struct Functional {
    weights: Vec<Integer>,
    denominator: Integer,
}

impl Functional {
    /// The derivative of this order at x = p / q, of a polynomial with so many coefficients: the
    /// sum of k (k - 1) ... (k - order + 1) c_k x^(k - order).
    fn derivative(order: usize, coefficients: usize, x: &Rational) -> Functional {
        let degree = coefficients.saturating_sub(order + 1);
        let mut weights = vec![Integer::zero(); coefficients];
        for (k, weight) in weights.iter_mut().enumerate().skip(order) {
            let falling: usize = (k + 1 - order..=k).product();
            let power = x.numer().pow((k - order) as u32);
            let missing = x.denom().pow((degree + order - k) as u32);
            *weight = power * missing * falling;
        }

        Functional {
            weights,
            denominator: x.denom().pow(degree as u32),
        }
    }

    /// The same, its values in the fixed unit.
    fn in_fixed_unit(mut self) -> Functional {
        for weight in &mut self.weights {
            *weight <<= FRACTION_BITS;
        }

        self
    }

    /// The value times the denominator.
    fn numerator<'a>(&self, coefficients: impl Iterator<Item = &'a Integer>) -> Integer {
        self.weights
            .iter()
            .zip(coefficients)
            .map(|(w, c)| w * c)
            .sum()
    }

    /// The same for the absolute values of the coefficients.
    fn bound<'a>(&self, coefficients: impl Iterator<Item = &'a Integer>) -> Integer {
        let terms = self.weights.iter().zip(coefficients);
        terms.map(|(w, c)| (w * c).abs()).sum()
    }
}

/// A positive number to divide by: `odd` 2^`twos`. As a rule it has many factors of two, and
/// shifting them off leaves a shorter division with the same result.
struct OddDivisor {
    odd: Integer,
    twos: u64,
}

impl OddDivisor {
    fn of(divisor: Integer) -> OddDivisor {
        let twos = divisor.trailing_zeros().unwrap_or(0);
        let odd = divisor >> twos;
        OddDivisor { odd, twos }
    }

    /// The quotient, rounded down.
    fn floor(&self, dividend: Integer) -> Integer {
        (dividend >> self.twos).div_floor(&self.odd)
    }

    /// The quotient, rounded up.
    fn ceil(&self, dividend: Integer) -> Integer {
        -self.floor(-dividend)
    }
}

/// The product of a number in the fixed unit and a factor, rounded up.
fn times_up(value: &Integer, factor: &Rational) -> Integer {
    (value * factor.numer()).div_ceil(factor.denom())
}

/// left_i right_j weight_i, factors and products in the fixed unit, rounded up.
fn weighted_products(left: &[Integer], right: &[Integer], weight: &[Rational]) -> LongMatrix {
    let mut products = LongMatrix::with_capacity(left.len());
    for (left_i, weight_i) in left.iter().zip(weight) {
        let factor = left_i * weight_i.numer();
        let unit = OddDivisor::of(weight_i.denom() << FRACTION_BITS);
        products.push(right.iter().map(|r| unit.ceil(&factor * r)).collect());
    }

    products
}

#[cfg(test)]
mod tests;
