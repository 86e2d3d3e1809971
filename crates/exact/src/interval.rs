//! Closed intervals with rational ends, and interval Horner: the enclosure a checker can afford.

use super::{Integer, Poly, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// The closed interval [lo, hi], lo <= hi.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interval {
    lo: Rational,
    hi: Rational,
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
        let v = self.lo.denom().lcm(self.hi.denom());
        let sum =
            self.lo.numer() * (&v / self.lo.denom()) + self.hi.numer() * (&v / self.hi.denom());
        let shift = v.trailing_zeros().unwrap_or(0);
        if v.bits() != shift + 1 {
            return Rational::new(sum, v * 2);
        }
        // Ends of bisection are dyadic: p / 2^k is reduced by counting zeros, without a gcd.
        let common = sum
            .trailing_zeros()
            .map_or(shift + 1, |zeros| zeros.min(shift + 1));
        Rational::new_raw(sum >> common, Integer::one() << (shift + 1 - common))
    }

    /// Is `v` in the closed interval?
    pub fn contains(&self, v: &Rational) -> bool {
        *v >= self.lo && *v <= self.hi
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
        let (mut lo, mut hi) = (products[0].clone(), products[0].clone());
        for p in &products[1..] {
            if *p < lo {
                lo = p.clone();
            }
            if *p > hi {
                hi = p.clone();
            }
        }
        Interval { lo, hi }
    }

    /// The smallest interval with every quotient, or `None` if the divisor may be zero.
    pub fn div(&self, divisor: &Interval) -> Option<Interval> {
        (divisor.certain_sign() != 0).then(|| {
            self.mul(&Interval {
                lo: divisor.hi.recip(),
                hi: divisor.lo.recip(),
            })
        })
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
        let (lo, hi, scale) = self.horner_scaled(p);
        Interval {
            lo: Rational::new(lo, scale.clone()),
            hi: Rational::new(hi, scale),
        }
    }

    /// [`Interval::horner`], with both ends rounded outward to 64 bits where their fractions are
    /// long. The signs of the ends are those of the exact ones, and no long fraction is reduced.
    pub fn horner_rounded(&self, p: &Poly) -> Interval {
        const SHORT: u64 = 256;

        let (lo, hi, scale) = self.horner_scaled(p);
        let longest = lo.bits().max(hi.bits()).max(scale.bits());
        if longest <= SHORT {
            return Interval {
                lo: Rational::new(lo, scale.clone()),
                hi: Rational::new(hi, scale),
            };
        }

        let hi_below = rounded_down(&-hi, &scale);
        Interval {
            lo: rounded_down(&lo, &scale),
            hi: -hi_below,
        }
    }

    /// [`Interval::certain_sign`] of [`Interval::horner`], without reducing a fraction.
    pub(super) fn sign_on(&self, p: &Poly) -> i8 {
        let (lo, hi, _) = self.horner_scaled(p);
        if lo.is_positive() {
            1
        } else if hi.is_negative() {
            -1
        } else {
            0
        }
    }

    /// The ends of [`Interval::horner`] times a positive integer, and that integer.
    fn horner_scaled(&self, p: &Poly) -> (Integer, Integer, Integer) {
        // Integers over powers of the ends' common denominator v.
        let v = self.lo.denom().lcm(self.hi.denom());
        let (a, b) = (
            self.lo.numer() * (&v / self.lo.denom()),
            self.hi.numer() * (&v / self.hi.denom()),
        );
        let (mut lo, mut hi, mut scale) = (Integer::zero(), Integer::zero(), Integer::one());
        for (k, c) in p.coeffs().iter().rev().enumerate() {
            if k > 0 {
                scale *= &v;
                let products = [&lo * &a, &lo * &b, &hi * &a, &hi * &b];
                let [p, q, r, s] = &products;
                (lo, hi) = (
                    p.min(q).min(r).min(s).clone(),
                    p.max(q).max(r).max(s).clone(),
                );
            }
            let c = c * &scale;
            lo += &c;
            hi += c;
        }
        (lo, hi, scale)
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
        let quotient = (numerator << shift.unsigned_abs()).div_floor(denominator);
        Rational::new(quotient, Integer::one() << shift.unsigned_abs())
    } else {
        let unit = denominator << shift.unsigned_abs();
        Rational::from_integer(numerator.div_floor(&unit) << shift.unsigned_abs())
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
                let (exact, rounded) = (t.horner(&p), t.horner_rounded(&p));

                assert!(
                    rounded.lo <= exact.lo && exact.hi <= rounded.hi,
                    "{a} {b} {p}"
                );
                assert_eq!(rounded.certain_sign(), exact.certain_sign(), "{a} {b} {p}");
                for (close, end) in [(&rounded.lo, &exact.lo), (&rounded.hi, &exact.hi)] {
                    assert!(
                        (close - end).abs() * whole(1 << 62) <= end.abs(),
                        "{a} {b} {p}"
                    );
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
            assert_eq!(&mid + &mid, lo + hi);
            assert_eq!(mid, Rational::new(mid.numer().clone(), mid.denom().clone()));
            assert_eq!(
                mid.denom(),
                Rational::new(mid.numer().clone(), mid.denom().clone()).denom()
            );
        }
    }

    #[test]
    fn reversed_ends_are_no_interval() {
        assert_eq!(Interval::new(whole(1), whole(0)), None);
    }
}
