//! Real algebraic numbers as (squarefree polynomial, isolating interval), and exact signs at them.
//!
//! alpha is the one root of p in [lo, hi]. Everything about alpha is the sign of some integer
//! polynomial g there:
//!
//! 1. interval arithmetic encloses g over [lo, hi]; if 0 is not in the enclosure, that is the sign;
//! 2. otherwise g(alpha) = 0 exactly if h = gcd(p, g) vanishes at alpha, that is, if h changes sign
//!    over [lo, hi], because all roots of p are simple;
//! 3. if it does not, bisection narrows the interval until 1. decides.
//!
//! A gcd that is neither 1 nor p splits p, and the factor that vanishes at alpha replaces it
//! (dynamic evaluation: Duval, Dynamic evaluation, 1989). Basu, Pollack and Roy, Algorithms in Real
//! Algebraic Geometry, chapter 10, treat the rest.
//!
//! Input: a polynomial with an interval that isolates one root of it (`roots`), or a rational.
//! Called by everything exact that leaves the rationals: `kernel`, `cone`, the oracle, the search.
//! (The checker does without: its claims carry intervals of their own.)

use super::{Integer, Interval, Poly, Rational};
use num_integer::Integer as _;
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// The sign of a real number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// Below zero.
    Negative,
    /// Exactly zero.
    Zero,
    /// Above zero.
    Positive,
}

impl From<i8> for Sign {
    fn from(value: i8) -> Self {
        match value.cmp(&0) {
            Ordering::Less => Sign::Negative,
            Ordering::Equal => Sign::Zero,
            Ordering::Greater => Sign::Positive,
        }
    }
}

/// A real algebraic number: the one root in `interval` of a squarefree primitive polynomial.
///
/// Invariant: either the interval is a point at which the polynomial vanishes, or the polynomial
/// has exactly one root in it and opposite signs at its two ends. Refinement narrows the interval
/// and may replace the polynomial by a factor; the number stays the same.
///
/// ```
/// use mceip_exact::{nonnegative_roots, Poly, Sign};
/// let mut root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0); // sqrt 2
/// assert_eq!(root.sign_of(&Poly::from_ints(&[-2, 0, 1])), Sign::Zero);
/// assert_eq!(root.sign_of(&Poly::from_ints(&[-141, 100])), Sign::Positive); // 1.41 < sqrt 2
/// ```
#[derive(Debug, Clone)]
pub struct Algebraic {
    poly: Poly,
    interval: Interval,
    /// Sign of the polynomial at the lower end, 0 for a point. It is the same for every narrower
    /// interval, and found again where a factor replaces the polynomial.
    at_lo: i8,
}

impl Algebraic {
    /// A rational number as an algebraic one.
    pub fn rational(value: Rational) -> Self {
        Algebraic {
            poly: Poly::linear_root(&value),
            interval: Interval::point(value),
            at_lo: 0,
        }
    }

    /// The root of a squarefree `poly` isolated by `interval`; the caller has isolated it.
    pub(super) fn isolated(poly: Poly, interval: Interval) -> Self {
        if interval.is_point() {
            return Self::rational(interval.lo().clone());
        }

        let at_lo = poly.sign_at(interval.lo());
        Algebraic {
            poly,
            interval,
            at_lo,
        }
    }

    /// The number a claim speaks of: its polynomial made squarefree, with its interval. The caller
    /// has checked, or is about to check, that the interval isolates one root.
    pub fn from_claim(poly: Poly, interval: Interval) -> Self {
        Self::isolated(poly.squarefree(), interval)
    }

    /// Minus this number.
    ///
    /// ```
    /// use mceip_exact::{nonnegative_roots, whole, Poly};
    /// let root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0); // sqrt 2
    /// let mut minus = root.negated();
    /// assert!(minus.cmp_rational(&whole(-1)).is_lt());
    /// assert!(minus.cmp_rational(&whole(-2)).is_gt());
    /// ```
    #[must_use]
    pub fn negated(&self) -> Self {
        Self::isolated(self.poly.reflected(), self.interval.negated())
    }

    /// A squarefree polynomial that vanishes here.
    pub fn poly(&self) -> &Poly {
        &self.poly
    }

    /// The interval known to contain the number and no other root of [`Algebraic::poly`].
    pub fn interval(&self) -> &Interval {
        &self.interval
    }

    /// The exact value where the number is known to be rational.
    pub fn as_rational(&self) -> Option<&Rational> {
        self.interval.is_point().then(|| self.interval.lo())
    }

    /// Halves the isolating interval (no-op on a point).
    pub fn refine(&mut self) {
        if self.interval.is_point() {
            return;
        }

        let mid = self.interval.mid();
        let at_mid = self.poly.sign_at(&mid);

        if at_mid == 0 {
            *self = Self::rational(mid);
            return;
        }

        let half = if at_mid == self.at_lo {
            Interval::new(mid, self.interval.hi().clone())
        } else {
            Interval::new(self.interval.lo().clone(), mid)
        };

        if let Some(half) = half {
            self.interval = half; // always: lo <= mid <= hi
        }
    }

    /// Refines until the interval is at most `width` wide.
    pub fn refine_to(&mut self, width: &Rational) {
        while self.interval.width() > *width {
            self.refine();
        }
    }

    /// The exact sign of `g` at this number.
    ///
    /// Zero is decided by gcd, never by a tolerance: if `g` vanishes here it shares a factor with
    /// the defining polynomial, which then changes sign over the interval.
    pub fn sign_of(&mut self, g: &Poly) -> Sign {
        if let Some(value) = self.as_rational() {
            return Sign::from(g.sign_at(value));
        }

        let sign = self.interval.sign_on(g);
        if sign != 0 {
            return Sign::from(sign);
        }

        if g.is_zero() || self.is_root_of(g) {
            return Sign::Zero;
        }

        // This ends: g is not zero here, and the enclosure narrows with the interval.
        loop {
            if let Some(value) = self.as_rational() {
                return Sign::from(g.sign_at(value));
            }
            let sign = self.interval.sign_on(g);
            if sign != 0 {
                return Sign::from(sign);
            }
            self.refine();
        }
    }

    /// Does `g` vanish here? If h = gcd(p, g) is a proper factor of the polynomial p, the one of h
    /// and p / h that vanishes here becomes the new, smaller polynomial.
    fn is_root_of(&mut self, g: &Poly) -> bool {
        let h = self.poly.gcd(g);
        if h.degree() == Some(0) {
            return false;
        }

        let vanishes = h.sign_at(self.interval.lo()) != h.sign_at(self.interval.hi());
        let factor = if vanishes {
            Some(h)
        } else {
            self.poly.exact_div(&h)
        };

        if let Some(factor) = factor {
            self.poly = factor.primitive();
            self.at_lo = self.poly.sign_at(self.interval.lo());
        }

        vanishes
    }

    /// The same vector at this number up to one positive factor, in polynomials of a degree below
    /// that of the defining polynomial, together of content 1.
    ///
    /// The entries are pseudo-remainders, all with the same power of |lead| as their factor.
    ///
    /// ```
    /// use mceip_exact::{nonnegative_roots, Poly};
    /// let root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    /// let v = root.reduce(&[Poly::from_ints(&[0, 0, 6]), Poly::from_ints(&[0, 8])]);
    /// assert_eq!(v, [Poly::from_ints(&[3]), Poly::from_ints(&[0, 2])]); // (6 t^2, 8 t) ~ (3, 2 t)
    /// ```
    pub fn reduce(&self, vector: &[Poly]) -> Vec<Poly> {
        let longest = vector.iter().map(|p| p.coeffs().len()).max().unwrap_or(0);
        let degree = self.poly.coeffs().len() - 1;
        let steps = longest.saturating_sub(degree);

        let remainders: Vec<Poly> = vector
            .iter()
            .map(|p| p.pseudo_rem_steps(&self.poly, steps))
            .collect();

        let mut content = Integer::zero();
        for p in &remainders {
            content = content.gcd(&p.content());
        }

        if content.is_zero() || content.is_one() {
            return remainders;
        }

        remainders.iter().map(|p| p.divided_by(&content)).collect()
    }

    /// Looks for a rational value.
    ///
    /// A root u/v of a primitive polynomial has v dividing the lead. Two different fractions with
    /// denominators up to the lead are at least 1/lead^2 apart. So in an interval of half that
    /// width only the fraction of least denominator can be the root.
    ///
    /// Given up (the number stays as it is) for leads of more than 256 bits, where it would cost
    /// many halvings.
    pub fn try_rational(&mut self) {
        if self.interval.is_point() || self.poly.leading().bits() > 256 {
            return;
        }

        let lead = Rational::from_integer(self.poly.leading());
        let two = Rational::from_integer(2.into());
        self.refine_to(&(&lead * &lead * two).recip());

        let simplest = simplest_between(self.interval.lo(), self.interval.hi());
        if self.poly.sign_at(&simplest) == 0 {
            *self = Self::rational(simplest);
        }
    }

    /// Exact comparison with a rational.
    pub fn cmp_rational(&mut self, value: &Rational) -> Ordering {
        match self.sign_of(&Poly::linear_root(value)) {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }

    /// Exact comparison of two numbers; both may be refined.
    pub fn cmp_exact(&mut self, other: &mut Algebraic) -> Ordering {
        if self.equals(other) {
            return Ordering::Equal;
        }

        // This ends: the numbers differ, so narrow intervals around them do not meet.
        loop {
            if self.interval.hi() < other.interval.lo() {
                return Ordering::Less;
            }
            if other.interval.hi() < self.interval.lo() {
                return Ordering::Greater;
            }
            self.refine();
            other.refine();
            if self.interval.is_point() && other.interval.is_point() {
                return self.interval.lo().cmp(other.interval.lo());
            }
        }
    }

    /// Are the two numbers equal?
    ///
    /// If the polynomial of `other` vanishes at `self`, both are roots of it. Then they are equal
    /// exactly if `self` lies in the interval of `other`, which holds one root only.
    pub fn equals(&mut self, other: &mut Algebraic) -> bool {
        if let Some(value) = other.as_rational() {
            return self.sign_of(&Poly::linear_root(value)) == Sign::Zero;
        }

        if let Some(value) = self.as_rational() {
            return other.sign_of(&Poly::linear_root(value)) == Sign::Zero;
        }

        self.sign_of(&other.poly) == Sign::Zero
            && self.cmp_rational(other.interval.lo()) == Ordering::Greater
            && self.cmp_rational(other.interval.hi()) == Ordering::Less
    }
}

/// The fraction of least denominator in [lo, hi], where lo <= hi.
///
/// It is found in the Stern-Brocot tree (Graham, Knuth and Patashnik, Concrete Mathematics, section
/// 4.5).
pub fn simplest_between(lo: &Rational, hi: &Rational) -> Rational {
    let floor = lo.floor();
    if floor == *lo {
        return floor;
    }

    let next = &floor + Rational::one();
    if next <= *hi {
        return next;
    }

    // Both ends lie strictly between floor and floor + 1. Of the fractions between two numbers in
    // (0, 1) the one of least denominator also has the least numerator, so that its reciprocal is
    // the one of least denominator between the reciprocals.
    let reciprocal_lo = (hi - &floor).recip();
    let reciprocal_hi = (lo - &floor).recip();

    floor + simplest_between(&reciprocal_lo, &reciprocal_hi).recip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{nonnegative_roots, rational, whole};

    fn sqrt(n: i64) -> Algebraic {
        nonnegative_roots(&Poly::from_ints(&[-n, 0, 1])).remove(0)
    }

    /// Only one of them is a point: the other one is narrowed until they part.
    #[test]
    fn a_rational_and_a_root_are_told_apart() {
        let cases = [
            (rational(7, 5), Ordering::Greater),
            (rational(3, 2), Ordering::Less),
            (rational(1393, 985), Ordering::Greater),
            (rational(3363, 2378), Ordering::Less),
        ];

        for (value, expected) in cases {
            let mut point = Algebraic::rational(value.clone());

            let root_against_point = sqrt(2).cmp_exact(&mut point.clone());
            let point_against_root = point.cmp_exact(&mut sqrt(2));

            assert_eq!(root_against_point, expected, "{value}");
            assert_eq!(point_against_root, expected.reverse(), "{value}");
        }
    }

    #[test]
    fn signs_are_exact_also_an_inch_from_zero() {
        // 3363/2378 is a convergent of sqrt 2, above it by 6e-8.
        let above = Poly::from_ints(&[-3363, 2378]);
        let below = Poly::from_ints(&[-1393, 985]);
        let zero = Poly::from_ints(&[4, 0, 0, 0, -1]);

        let mut root = sqrt(2);

        assert_eq!(root.sign_of(&above), Sign::Negative);
        assert_eq!(root.sign_of(&below), Sign::Positive);
        assert_eq!(root.sign_of(&zero), Sign::Zero);
    }

    #[test]
    fn zero_tests_shrink_a_reducible_polynomial() {
        let factor_of_sqrt_2 = Poly::from_ints(&[-2, 0, 1]);
        let factor_of_sqrt_5 = Poly::from_ints(&[-5, 0, 1]);
        let roots = nonnegative_roots(&(&factor_of_sqrt_2 * &factor_of_sqrt_5));

        let mut sqrt_2 = roots[0].clone();
        assert_eq!(sqrt_2.sign_of(&factor_of_sqrt_2), Sign::Zero);
        assert_eq!(sqrt_2.poly(), &factor_of_sqrt_2);

        let mut sqrt_5 = roots[1].clone();
        assert_eq!(sqrt_5.sign_of(&factor_of_sqrt_2), Sign::Positive);

        // The common factor t^2 - 2 is not zero at sqrt 5, which is just below 2889/1292: the sign
        // stays open at first.
        let near = &factor_of_sqrt_2 * &Poly::from_ints(&[-2889, 1292]);
        assert_eq!(sqrt_5.sign_of(&near), Sign::Negative);
        assert_eq!(sqrt_5.poly(), &factor_of_sqrt_5);
    }

    #[test]
    fn equality_and_order_across_polynomials() {
        let p = &Poly::from_ints(&[-2, 0, 1]) * &Poly::from_ints(&[-3, 1]);

        let mut from_product = nonnegative_roots(&p).remove(0);

        assert!(from_product.equals(&mut sqrt(2)));
        assert!(!from_product.equals(&mut sqrt(3)));
        assert_eq!(sqrt(2).cmp_exact(&mut sqrt(3)), Ordering::Less);
        assert_eq!(sqrt(5).cmp_rational(&whole(2)), Ordering::Greater);
        assert_eq!(sqrt(2).cmp_exact(&mut from_product), Ordering::Equal);
    }

    #[test]
    fn rational_values_are_recognised() {
        let p = &Poly::from_ints(&[-7, 3]) * &Poly::from_ints(&[-2, 0, 1]);

        let mut root = nonnegative_roots(&p).remove(1);
        root.try_rational();
        assert_eq!(root.as_rational(), Some(&rational(7, 3)));

        let mut irrational = sqrt(2);
        irrational.try_rational();
        assert_eq!(irrational.as_rational(), None);
    }

    #[test]
    fn a_vector_is_reduced_to_least_degree() {
        let vector = [Poly::from_ints(&[0, 0, 6]), Poly::from_ints(&[0, 8])]; // (12, 8 t)
        let number = [Poly::from_ints(&[0, 1, 0, 0, 0, 1])]; // t + 4 t

        let root = sqrt(2);

        let expected = [Poly::from_ints(&[3]), Poly::from_ints(&[0, 2])];
        assert_eq!(root.reduce(&vector), expected);
        assert_eq!(root.reduce(&number), [Poly::from_ints(&[0, 1])]);
    }

    /// 3 / 2^bits as a root of (2^bits t - 3) (t^2 - 2).
    fn hidden_rational(bits: u32) -> Algebraic {
        let denominator = Integer::from(1) << bits;
        let value = Rational::new(3.into(), denominator.clone());
        let factor = Poly::new(vec![(-3).into(), denominator]);

        let lo = &value - Rational::new(1.into(), Integer::from(1) << (bits + 3));
        let hi = value * whole(2);
        let interval = Interval::new(lo, hi).unwrap();

        Algebraic::isolated(&factor * &Poly::from_ints(&[-2, 0, 1]), interval)
    }

    /// A lead of more than 256 bits would cost twice as many halvings: the number stays as it is.
    #[test]
    fn a_rational_with_a_long_denominator_is_not_looked_for() {
        let mut short = hidden_rational(20);
        let mut long = hidden_rational(300);

        short.try_rational();
        long.try_rational();

        assert!(short.interval.is_point());
        assert!(!long.interval.is_point());
    }
}
