//! The condensed pencil as a polynomial matrix with a remainder, enclosed over an interval by its two
//! ends (a chord), the bend between them and the remainder.

use super::CoverFault;
use super::family::{Ends, Matrix};
use super::short::Short;
use crate::exact::{Integer, Rational};
use num_integer::Integer as _;
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
    /// tau / sigma: the weights hold at t = 0, at t they are divided by 1 + t tau / sigma.
    pub(super) gain: Rational,
    /// Is this B + sA, and the value expanded in s = 1 / t?
    pub(super) reversed: bool,
}

impl Expanded {
    /// The ends over [lo, hi]; reversed, over the interval of s, the first still that of the lower t.
    pub(super) fn ends(&self, lo: &Rational, hi: Option<&Rational>) -> Result<Ends, CoverFault> {
        if !self.reversed {
            return self.between(lo, hi);
        }
        if lo.is_zero() {
            return Err(CoverFault::Hypothesis { expected: "a region above 0 for a reversed anchor", row: 0 });
        }
        let ends = self.between(&hi.map_or_else(Rational::zero, Rational::recip), Some(&lo.recip()))?;
        let ([m1, m0], [r1, r0]) = (ends.m, ends.r);
        // s = 0 itself is not part of the window.
        Ok(Ends { m: [m0, m1], r: [r0, r1], infinite: hi.is_none(), ..ends })
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
                return Err(CoverFault::Hypothesis { expected: "a tail above the last finite interval", row: 0 });
            }
            // T(t) = T(lo) + (t - lo) Z_1, and the remainder is linear in t as well.
            let m1 = grid(n, |i, j| self.fixed(&self.z[1][i][j], &Integer::one()));
            let none = grid(n, |_, _| Integer::zero());
            let r = [self.remainder(&d0.abs(), &weight), self.remainder_direction()];
            return Ok(Ends { m: [self.at(&d0), m1], r, slope: none, scale, infinite: true });
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
        Ok(Ends { m: [self.at(&d0), self.at(&d1)], r: [radius(&d0.abs()), radius(&d1.abs())], slope, scale, infinite: false })
    }

    /// The constant and the direction of a family that is linear in t = d, remainders included, in short numbers: at
    /// t >= 0 it is within (R_0 + t R_1) of Z_0 + t Z_1, and so between the ends of every interval.
    pub(super) fn short(&self) -> Option<[Short; 2]> {
        if self.reversed || !self.center.is_zero() || !self.is_linear() {
            return None;
        }
        let none = Rational::zero();
        let direction = grid(self.weight.len(), |i, j| self.fixed(&self.z[1][i][j], &Integer::one()));
        let all: Vec<usize> = (0..self.weight.len()).collect();
        let constant = Short::of(&self.at(&none), &self.remainder(&none, &self.weight), &all)?;
        Some([constant, Short::of(&direction, &self.remainder_direction(), &all)?])
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
            let (sum, power) = horner(self.z.iter().enumerate().skip(2).map(|(k, z)| z[i][j].abs() * (k * (k - 1))), reach);
            up(&(sum * &w), &(&self.unit * power * &v))
        })
    }

    /// Bound of both remainders for |d| <= reach, and what rounding m down has cost.
    fn remainder(&self, reach: &Rational, weight: &[Rational]) -> Matrix {
        let of = |list: &[Vec<Integer>]| self.each(|i| norm(list, i, reach));
        let (l, r, v, q) = (of(&self.left), of(&self.right), of(&self.v), of(&self.rounding));
        grid(self.weight.len(), |i, j| weigh(&l[i], &r[j], &weight[i]) + weigh(&v[i], &q[j], &self.rounding_weight[i]) + 1)
    }

    /// The remainder of the direction Z_1 of a pencil that is linear.
    fn remainder_direction(&self) -> Matrix {
        let of = |list: &[Vec<Integer>], k: usize| self.each(|i| list.get(k).map_or_else(Integer::zero, |l| &l[i] << FRACTION_BITS));
        let (l, r, v, q) = (of(&self.left, 1), of(&self.right, 0), of(&self.v, 1), of(&self.rounding, 0));
        grid(self.weight.len(), |i, j| weigh(&l[i], &r[j], &self.weight[i]) + weigh(&v[i], &q[j], &self.rounding_weight[i]) + 1)
    }

    /// Bound of the remainders' derivative times the width: l' F^-1 r differentiated factor by factor.
    fn remainder_slope(&self, reach: &Rational, width: &Rational, weight: &[Rational]) -> Matrix {
        let of = |list: &[Vec<Integer>]| self.each(|i| norm(list, i, reach));
        let slope = |list: &[Vec<Integer>]| self.each(|i| norm_slope(list, i, reach));
        let (l, r, v, q) = (of(&self.left), of(&self.right), of(&self.v), of(&self.rounding));
        let (dl, dr, dv, dq) = (slope(&self.left), slope(&self.right), slope(&self.v), slope(&self.rounding));
        let times = |value: Integer, factor: &Rational| (value * factor.numer()).div_ceil(factor.denom());
        grid(self.weight.len(), |i, j| {
            let w = &weight[i];
            let second = weigh(&dl[i], &r[j], w) + weigh(&l[i], &dr[j], w) + times(weigh(&l[i], &r[j], w), &self.drift);
            let rounding = weigh(&dv[i], &q[j], &self.rounding_weight[i]) + weigh(&v[i], &dq[j], &self.rounding_weight[i]);
            times(second + rounding, width)
        })
    }

    fn each(&self, f: impl Fn(usize) -> Integer) -> Vec<Integer> {
        (0..self.weight.len()).map(f).collect()
    }
}

/// sum c_k x^k as (numerator, denominator), not reduced: a fraction's gcd costs more than all else.
fn horner(coefficients: impl DoubleEndedIterator<Item = Integer>, x: &Rational) -> (Integer, Integer) {
    let (mut sum, mut power) = (Integer::zero(), Integer::one());
    let mut terms = 0;
    for c in coefficients.rev() {
        sum = sum * x.numer() + c * &power;
        power *= x.denom();
        terms += 1;
    }
    // One factor too many, unless there was no term at all.
    if terms == 0 { (sum, power) } else { (sum, power / x.denom()) }
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
    let (sum, power) = horner(list.iter().enumerate().skip(1).map(|(k, l)| &l[i] * k), reach);
    up(&sum, &power)
}

fn grid(n: usize, f: impl Fn(usize, usize) -> Integer) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| f(i, j)).collect()).collect()
}

/// The bounds again, in rational numbers and term by term as the formulas stand.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{rational, whole};

    fn int(list: &[i64]) -> Vec<Integer> {
        list.iter().map(|&v| v.into()).collect()
    }

    fn square(list: [[i64; 2]; 2]) -> Matrix {
        list.iter().map(|row| int(row)).collect()
    }

    /// Linear in t, remainder included.
    fn linear() -> Expanded {
        Expanded {
            center: rational(2, 3),
            z: vec![square([[70, -30], [11, 50]]), square([[5, -7], [-2, 9]])],
            unit: 12.into(),
            left: vec![int(&[3, 5]), int(&[2, 7])],
            right: vec![int(&[4, 6])],
            weight: vec![rational(1, 700), rational(2, 900)],
            v: vec![int(&[8, 1]), int(&[3, 5])],
            rounding: vec![int(&[2, 9])],
            rounding_weight: vec![rational(1, 50), rational(3, 70)],
            drift: whole(0),
            gain: rational(3, 5),
            reversed: false,
        }
    }

    /// Of degree three, every list with more than one coefficient.
    fn bent() -> Expanded {
        let mut e = linear();
        e.z.extend([square([[2, -3], [1, 0]]), square([[-4, 1], [3, 6]])]);
        e.left.push(int(&[1, 2]));
        e.right.extend([int(&[3, 1]), int(&[2, 4])]);
        e.v.push(int(&[6, 2]));
        e.rounding.push(int(&[5, 3]));
        e.drift = rational(7, 4);
        e
    }

    fn unit() -> Rational {
        Rational::from_integer(Integer::one() << FRACTION_BITS)
    }

    fn ceil(v: Rational) -> Rational {
        v.ceil()
    }

    fn power(x: &Rational, k: usize) -> Rational {
        (0..k).fold(whole(1), |p, _| p * x)
    }

    fn sum(list: &[Vec<Integer>], i: usize, x: &Rational) -> Rational {
        list.iter().enumerate().map(|(k, l)| Rational::from_integer(l[i].clone()) * power(x, k)).sum()
    }

    fn slope(list: &[Vec<Integer>], i: usize, x: &Rational) -> Rational {
        let term = |(k, l): (usize, &Vec<Integer>)| Rational::from_integer(&l[i] * k) * power(x, k - 1);
        list.iter().enumerate().skip(1).map(term).sum()
    }

    /// A bound rounded up to the fixed unit.
    fn up(v: Rational) -> Rational {
        ceil(v * unit())
    }

    fn weigh(a: &Rational, b: &Rational, w: &Rational) -> Rational {
        ceil(a * b * w / unit())
    }

    fn at(e: &Expanded, d: &Rational) -> Matrix {
        let entry = |i: usize, j: usize| {
            let z: Rational = e.z.iter().enumerate().map(|(k, z)| Rational::from_integer(z[i][j].clone()) * power(d, k)).sum();
            (z / Rational::from_integer(e.unit.clone()) * unit()).floor().to_integer()
        };
        grid(2, entry)
    }

    fn remainder(e: &Expanded, reach: &Rational, weight: &[Rational], i: usize, j: usize) -> Rational {
        let of = |list: &[Vec<Integer>], i: usize| up(sum(list, i, reach));
        weigh(&of(&e.left, i), &of(&e.right, j), &weight[i]) + weigh(&of(&e.v, i), &of(&e.rounding, j), &e.rounding_weight[i]) + whole(1)
    }

    fn weights(e: &Expanded, lo: &Rational) -> Vec<Rational> {
        e.weight.iter().map(|w| w / (whole(1) + &e.gain * lo)).collect()
    }

    fn check_finite(e: &Expanded, is_linear: bool, lo: &Rational, hi: &Rational) {
        let got = e.ends(lo, Some(hi)).unwrap();
        assert!(!got.infinite && got.scale == Integer::one() << FRACTION_BITS);
        let (d, width) = ([lo - &e.center, hi - &e.center], hi - lo);
        let reach = d[0].abs().max(d[1].abs());
        let weight = weights(e, lo);
        let bend = |i: usize, j: usize| {
            let term = |(k, z): (usize, &Matrix)| Rational::from_integer(z[i][j].abs() * k * (k - 1)) * power(&reach, k - 2);
            let second: Rational = e.z.iter().enumerate().skip(2).map(term).sum();
            up(second * &width * &width / Rational::from_integer(e.unit.clone()))
        };
        for end in 0..2 {
            assert_eq!(got.m[end], at(e, &d[end]));
            let reach = if is_linear { d[end].abs() } else { reach.clone() };
            let radius = grid(2, |i, j| ((bend(i, j) / whole(8)).floor() + whole(1) + remainder(e, &reach, &weight, i, j)).to_integer());
            assert_eq!(got.r[end], radius, "end {end}");
        }
        let of = |list: &[Vec<Integer>], i: usize| up(sum(list, i, &reach));
        let d_of = |list: &[Vec<Integer>], i: usize| up(slope(list, i, &reach));
        let expected = grid(2, |i, j| {
            let (l, r, v, q) = (of(&e.left, i), of(&e.right, j), of(&e.v, i), of(&e.rounding, j));
            let (dl, dr, dv, dq) = (d_of(&e.left, i), d_of(&e.right, j), d_of(&e.v, i), d_of(&e.rounding, j));
            let w = &weight[i];
            let second = weigh(&dl, &r, w) + weigh(&l, &dr, w) + ceil(weigh(&l, &r, w) * &e.drift);
            let rounding = weigh(&dv, &q, &e.rounding_weight[i]) + weigh(&v, &dq, &e.rounding_weight[i]);
            (bend(i, j) + ceil((second + rounding) * &width) + whole(2)).to_integer()
        });
        assert_eq!(got.slope, expected);
    }

    #[test]
    fn chord_radius_and_slope_are_those_of_the_formulas() {
        for (lo, hi) in [(rational(1, 7), rational(5, 3)), (whole(3), rational(22, 5)), (whole(0), rational(1, 9))] {
            check_finite(&bent(), false, &lo, &hi);
            check_finite(&linear(), true, &lo, &hi);
        }
    }

    #[test]
    fn an_infinite_end_has_the_direction_and_its_remainder() {
        let (e, lo) = (linear(), rational(5, 2));
        let got = e.ends(&lo, None).unwrap();
        let d = &lo - &e.center;
        let weight = weights(&e, &lo);
        assert!(got.infinite && got.slope == grid(2, |_, _| Integer::zero()));
        assert_eq!(got.m[0], at(&e, &d));
        assert_eq!(got.r[0], grid(2, |i, j| remainder(&e, &d, &weight, i, j).to_integer()));
        let direction = |i: usize, j: usize| (Rational::new(e.z[1][i][j].clone(), e.unit.clone()) * unit()).floor().to_integer();
        assert_eq!(got.m[1], grid(2, direction));
        let one = |l: &[Integer], i: usize| Rational::from_integer(l[i].clone()) * unit();
        let radius = |i: usize, j: usize| {
            weigh(&one(&e.left[1], i), &one(&e.right[0], j), &e.weight[i])
                + weigh(&one(&e.v[1], i), &one(&e.rounding[0], j), &e.rounding_weight[i])
                + whole(1)
        };
        assert_eq!(got.r[1], grid(2, |i, j| radius(i, j).to_integer()));
    }

    /// Whatever is not linear in t, were it one coefficient, has no direction at infinity.
    #[test]
    fn only_what_is_linear_reaches_infinity() {
        let mut cases: Vec<Expanded> = (0..6).map(|_| linear()).collect();
        cases[0].z.push(square([[0, 0], [0, 1]]));
        cases[1].left.push(int(&[0, 1]));
        cases[2].right.push(int(&[0, 1]));
        cases[3].v.push(int(&[0, 1]));
        cases[4].rounding.push(int(&[0, 1]));
        cases[5].drift = rational(1, 100);
        for (k, e) in cases.iter().enumerate() {
            assert!(matches!(e.ends(&whole(3), None), Err(CoverFault::Hypothesis { .. })), "{k}");
            check_finite(e, false, &whole(1), &whole(2));
        }
        // Zeros beyond do not matter.
        let mut same = linear();
        same.left.push(int(&[0, 0]));
        same.right.push(int(&[0, 0]));
        same.z.push(square([[0, 0], [0, 0]]));
        check_finite(&same, true, &whole(1), &whole(2));
        assert!(same.ends(&whole(3), None).is_ok());
    }
}

/// The short form encloses, closely.
#[cfg(test)]
mod short_forms {
    use super::*;
    use crate::exact::{rational, whole};

    fn big(rows: &[&[i64]]) -> Vec<Vec<Integer>> {
        rows.iter().map(|r| r.iter().map(|v| Integer::from(*v)).collect()).collect()
    }

    /// Linear, with the two remainders of different sizes.
    fn linear() -> Expanded {
        Expanded {
            center: whole(0),
            z: vec![big(&[&[300, -500], &[0, 700]]), big(&[&[-100, 200], &[0, 9000]])],
            unit: Integer::from(1024),
            left: big(&[&[1, 2], &[3, 4]]),
            right: big(&[&[5, 6], &[0, 0]]),
            weight: vec![rational(1, 30_000), rational(1, 40_000)],
            v: big(&[&[7, 1], &[0, 3]]),
            rounding: big(&[&[2, 1]]),
            rounding_weight: vec![rational(1, 50_000), rational(1, 60_000)],
            drift: whole(0),
            gain: whole(0),
            reversed: false,
        }
    }

    /// Does an enclosure in some unit contain Z(t) +- `times` the remainders, times the denominator of t?
    fn contains(e: &Expanded, short: &Short, t: &Rational, times: &Rational) -> bool {
        let at = |list: &[Vec<Integer>], i: usize| -> Rational {
            let coefficient = |k: usize| list.get(k).map_or_else(Rational::zero, |l| Rational::from_integer(l[i].clone()));
            coefficient(0) + t * coefficient(1)
        };
        let z = |i: usize, j: usize| {
            let [a, b] = [0, 1].map(|k| Rational::new(e.z[k][i][j].clone(), e.unit.clone()));
            a + t * b
        };
        let radius =
            |i: usize, j: usize| &e.weight[i] * at(&e.left, i) * at(&e.right, j) + &e.rounding_weight[i] * at(&e.v, i) * at(&e.rounding, j);
        let raised = Rational::from_integer(t.denom() << FRACTION_BITS);
        let fits = |unit: u64, i: usize, j: usize, sign: i64| {
            let unit = Integer::one() << unit;
            let value = (z(i, j) + radius(i, j) * times * whole(sign)) * &raised;
            (value - Rational::from_integer(&unit * short.m[i][j])).abs() <= Rational::from_integer(unit * short.r[i][j])
        };
        let entries = || [(0, 0), (0, 1), (1, 0), (1, 1)];
        (0..200).any(|unit| entries().iter().all(|&(i, j)| fits(unit, i, j, 1) && fits(unit, i, j, -1)))
    }

    #[test]
    fn the_short_form_of_a_linear_family_encloses_it_closely() {
        let e = linear();
        let [a, b] = e.short().unwrap();
        for t in [whole(0), rational(1, 3), whole(7), rational(100_001, 7)] {
            let short = a.combine(t.denom(), &b, t.numer()).unwrap();
            assert!(contains(&e, &short, &t, &whole(1)), "{t}");
            assert!(!contains(&e, &short, &t, &rational(1_001, 1_000)), "{t}: a radius too large to be right");
        }
    }

    #[test]
    fn what_is_not_linear_or_has_another_centre_has_no_short_form() {
        let of = |change: fn(&mut Expanded)| {
            let mut e = linear();
            change(&mut e);
            e.short().is_some()
        };
        assert!(of(|_| {}));
        assert!(!of(|e| e.center = whole(1)));
        assert!(!of(|e| e.reversed = true));
        assert!(!of(|e| e.drift = rational(1, 9)));
        assert!(!of(|e| e.z.push(big(&[&[0, 0], &[1, 0]]))));
        assert!(!of(|e| e.right[1][1] = Integer::one()));
        assert!(!of(|e| e.left.push(vec![Integer::zero(), Integer::one()])));
    }
}
