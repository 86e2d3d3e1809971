//! Closed intervals with rational ends, and interval Horner: the enclosure a checker can afford.
//!
//! Every operation gives the smallest interval with all results (Moore, Interval Analysis, 1966),
//! exactly: nothing is rounded, except where a name says so. For p over [lo, hi] Horner's rule in
//! interval arithmetic encloses p(t) for all t there, and narrows to p(t) with the interval.
//!
//! Horner's rule runs on integers: with the common denominator v of the ends, lo = a/v and
//! hi = b/v, and after k steps both ends of the enclosure are integers over v^k. Signs need no
//! more.
//!
//! Called by `algebraic` for signs at isolating intervals, by `decimal`, and by the checker.

use super::{Integer, Poly, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed};

/// The closed interval [lo, hi], lo <= hi.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interval {
    lo: Rational,
    hi: Rational,
}

/// The ends of an interval times a positive integer, and that integer.
struct ScaledEnds {
    lo: Integer,
    hi: Integer,
    scale: Integer,
}

impl Interval {
    /// The interval [lo, hi], or `None` if lo > hi.
    pub fn new(lo: Rational, hi: Rational) -> Option<Self> {
        (lo <= hi).then_some(Interval { lo, hi })
    }

    /// The interval [v, v].
    pub fn point(v: Rational) -> Self {
        Interval {
            lo: v.clone(),
            hi: v,
        }
    }

    /// Lower end.
    pub fn lo(&self) -> &Rational {
        &self.lo
    }

    /// Upper end.
    pub fn hi(&self) -> &Rational {
        &self.hi
    }

    /// hi - lo.
    pub fn width(&self) -> Rational {
        &self.hi - &self.lo
    }

    /// Does the interval consist of one number?
    pub fn is_point(&self) -> bool {
        self.lo == self.hi
    }

    /// Midpoint.
    pub fn mid(&self) -> Rational {
        let sum = &self.lo + &self.hi;
        sum * Rational::new_raw(Integer::one(), 2.into())
    }

    /// The ends over their common denominator.
    fn cleared(&self) -> ScaledEnds {
        let scale = self.lo.denom().lcm(self.hi.denom());
        ScaledEnds {
            lo: self.lo.numer() * (&scale / self.lo.denom()),
            hi: self.hi.numer() * (&scale / self.hi.denom()),
            scale,
        }
    }

    /// Is `v` in the closed interval?
    pub fn contains(&self, v: &Rational) -> bool {
        let is_below = *v < self.lo;
        let is_above = *v > self.hi;
        !is_below && !is_above
    }

    /// 1 if every number in it is positive, -1 if every one is negative, 0 if neither is certain.
    pub fn certain_sign(&self) -> i8 {
        if self.lo.is_positive() {
            1
        } else if self.hi.is_negative() {
            -1
        } else {
            0
        }
    }

    /// { -t : t in self }.
    pub fn negated(&self) -> Interval {
        Interval {
            lo: -&self.hi,
            hi: -&self.lo,
        }
    }

    /// The smallest interval with every sum of a member of each.
    pub fn add(&self, other: &Interval) -> Interval {
        Interval {
            lo: &self.lo + &other.lo,
            hi: &self.hi + &other.hi,
        }
    }

    /// The smallest interval with every product of a member of each.
    pub fn mul(&self, other: &Interval) -> Interval {
        let products = [
            &self.lo * &other.lo,
            &self.lo * &other.hi,
            &self.hi * &other.lo,
            &self.hi * &other.hi,
        ];

        let mut smallest = &products[0];
        let mut largest = &products[0];

        for product in &products[1..] {
            smallest = smallest.min(product);
            largest = largest.max(product);
        }

        Interval {
            lo: smallest.clone(),
            hi: largest.clone(),
        }
    }

    /// The smallest interval with every quotient, or `None` if the divisor may be zero.
    pub fn div(&self, divisor: &Interval) -> Option<Interval> {
        if divisor.certain_sign() == 0 {
            return None;
        }

        let reciprocal = Interval {
            lo: divisor.hi.recip(),
            hi: divisor.lo.recip(),
        };

        Some(self.mul(&reciprocal))
    }

    /// An interval that contains p(t) for every t in `self`, by Horner's rule.
    ///
    /// ```
    /// use mceip_exact::{Interval, Poly, rational};
    /// let t = Interval::new(rational(7, 5), rational(3, 2)).unwrap();
    /// let image = t.horner(&Poly::from_ints(&[-2, 0, 1])); // t^2 - 2 changes sign here
    /// assert_eq!(image.certain_sign(), 0);
    /// assert_eq!(t.horner(&Poly::from_ints(&[-1, 1])).certain_sign(), 1);
    /// ```
    pub fn horner(&self, p: &Poly) -> Interval {
        self.horner_scaled(p).exactly()
    }

    /// [`Interval::horner`], with both ends rounded outward to 64 bits where their fractions are
    /// long. The signs of the ends are those of the exact ones, and no long fraction is reduced.
    pub fn horner_rounded(&self, p: &Poly) -> Interval {
        const SHORT: u64 = 256;

        let image = self.horner_scaled(p);
        let longest = image.lo.bits().max(image.hi.bits()).max(image.scale.bits());

        if longest <= SHORT {
            return image.exactly();
        }

        let minus_hi = rounded_down(&-image.hi, &image.scale);
        Interval {
            lo: rounded_down(&image.lo, &image.scale),
            hi: -minus_hi,
        }
    }

    /// [`Interval::certain_sign`] of [`Interval::horner`], without reducing a fraction.
    pub(super) fn sign_on(&self, p: &Poly) -> i8 {
        let image = self.horner_scaled(p);
        if image.lo.is_positive() {
            1
        } else if image.hi.is_negative() {
            -1
        } else {
            0
        }
    }

    /// The enclosure of p, over a power of the ends' common denominator.
    fn horner_scaled(&self, p: &Poly) -> ScaledEnds {
        let t = self.cleared();
        let leading = p.leading();
        let mut lo = leading.clone();
        let mut hi = leading;
        let mut scale = Integer::one();

        for coefficient in p.coeffs().iter().rev().skip(1) {
            let products = [&lo * &t.lo, &lo * &t.hi, &hi * &t.lo, &hi * &t.hi];
            let [p, q, r, s] = &products;
            lo = p.min(q).min(r).min(s).clone();
            hi = p.max(q).max(r).max(s).clone();

            scale *= &t.scale;
            let scaled_coefficient = coefficient * &scale;
            lo += &scaled_coefficient;
            hi += scaled_coefficient;
        }

        ScaledEnds { lo, hi, scale }
    }
}

impl ScaledEnds {
    /// [lo / scale, hi / scale].
    fn exactly(self) -> Interval {
        Interval {
            lo: Rational::new(self.lo, self.scale.clone()),
            hi: Rational::new(self.hi, self.scale),
        }
    }
}

/// The largest number with 64 bits or one more, or fewer after the point, that is at most
/// `numerator / denominator` (> 0).
fn rounded_down(numerator: &Integer, denominator: &Integer) -> Rational {
    const BITS: i64 = 64;

    // The quotient times 2^shift has 64 or 65 bits.
    let quotient_bits = numerator.bits() as i64 - denominator.bits() as i64;
    let shift = BITS - quotient_bits;

    if shift >= 0 {
        let scaled = numerator << shift.unsigned_abs();
        let quotient = scaled.div_floor(denominator);
        Rational::new(quotient, Integer::one() << shift.unsigned_abs())
    } else {
        let unit = denominator << shift.unsigned_abs();
        let quotient = numerator.div_floor(&unit);
        Rational::from_integer(quotient << shift.unsigned_abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    #[test]
    fn horner_encloses_sampled_values() {
        let p = Poly::from_ints(&[3, -4, 0, 1]);
        let t = Interval::new(whole(-1), rational(3, 2)).unwrap();

        let image = t.horner(&p);

        for k in -10..=15 {
            assert!(image.contains(&p.eval(&rational(k, 10))));
        }

        assert!(!image.contains(&whole(100)));
    }

    /// Ends that are integers, long fractions, huge and tiny: outward, close, and of the same sign.
    #[test]
    fn rounded_images_contain_the_exact_ones() {
        let tiny = Rational::new(1.into(), Integer::from(3).pow(400));
        let huge = Rational::from_integer(Integer::from(7).pow(300));
        let ends = [
            whole(0),
            whole(1),
            rational(22, 7),
            -tiny.clone(),
            tiny,
            -huge.clone(),
            huge,
        ];

        let polynomials = [
            vec![],
            vec![0, 1],
            vec![0, -1],
            vec![5],
            vec![-2, 0, 1],
            vec![1, -3, 0, 7],
        ];

        for (a, b) in ends
            .iter()
            .flat_map(|a| ends.iter().map(move |b| (a, b)))
            .filter(|(a, b)| a <= b)
        {
            let t = Interval::new(a.clone(), b.clone()).unwrap();
            for p in polynomials.iter().map(|c| Poly::from_ints(c)) {
                let exact = t.horner(&p);
                let rounded = t.horner_rounded(&p);

                let is_outward = rounded.lo <= exact.lo && exact.hi <= rounded.hi;
                assert!(is_outward, "{a} {b} {p}");
                assert_eq!(rounded.certain_sign(), exact.certain_sign(), "{a} {b} {p}");
                for (close, end) in [(&rounded.lo, &exact.lo), (&rounded.hi, &exact.hi)] {
                    let error = (close - end).abs();
                    assert!(error * whole(1 << 62) <= end.abs(), "{a} {b} {p}");
                }
            }
        }
    }

    #[test]
    fn products_are_the_smallest_interval_for_every_pair_of_signs() {
        let interval = |(lo, hi): (i64, i64)| Interval::new(whole(lo), whole(hi)).unwrap();
        let cases = [
            ((2, 3), (5, 7), (10, 21)),
            ((-3, -2), (5, 7), (-21, -10)),
            ((-3, -2), (-7, -5), (10, 21)),
            ((-2, 3), (-5, 7), (-15, 21)),
        ];

        for (a, b, product) in cases {
            assert_eq!(interval(a).mul(&interval(b)), interval(product));
            assert_eq!(interval(b).mul(&interval(a)), interval(product));
        }
    }

    #[test]
    fn midpoints_are_in_lowest_terms() {
        for (lo, hi) in [
            (rational(1, 4), rational(3, 4)),
            (rational(-1, 2), rational(1, 2)),
            (rational(1, 3), rational(5, 8)),
            (whole(3), whole(3)),
        ] {
            let mid = Interval::new(lo.clone(), hi.clone()).unwrap().mid();

            let reduced = Rational::new(mid.numer().clone(), mid.denom().clone());
            assert_eq!(&mid + &mid, lo + hi);
            assert_eq!(mid.numer(), reduced.numer());
            assert_eq!(mid.denom(), reduced.denom());
        }
    }

    #[test]
    fn reversed_ends_are_no_interval() {
        assert_eq!(Interval::new(whole(1), whole(0)), None);
    }
}
