//! Real algebraic numbers as (squarefree polynomial, isolating interval), and exact signs at them.

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
    /// Sign of the polynomial at the lower end: refinement never changes it. 0 for a point.
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
        let (lo, hi) = (self.interval.lo().clone(), self.interval.hi().clone());
        if at_mid == 0 {
            *self = Self::rational(mid);
            return;
        }
        let (lo, hi) = if at_mid == self.at_lo {
            (mid, hi)
        } else {
            (lo, mid)
        };
        // lo <= hi: mid lies between the old ends.
        self.interval = Interval::new(lo, hi).unwrap_or_else(|| self.interval.clone());
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
        let quick = self.interval.sign_on(g);
        if quick != 0 {
            return Sign::from(quick);
        }
        if g.is_zero() || self.splits_off(g) {
            return Sign::Zero;
        }
        loop {
            if let Some(value) = self.as_rational() {
                return Sign::from(g.sign_at(value));
            }
            match self.interval.sign_on(g) {
                0 => self.refine(), // ends: g is not zero here and Horner converges with the width
                s => return Sign::from(s),
            }
        }
    }

    /// Does `g` vanish here? If a proper factor of the polynomial shows either way, keep the
    /// factor that vanishes here as the new, smaller polynomial (dynamic evaluation, Duval 1989).
    fn splits_off(&mut self, g: &Poly) -> bool {
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
        if let Some(f) = factor {
            self.poly = f.primitive();
            self.at_lo = self.poly.sign_at(self.interval.lo());
        }
        vanishes
    }

    /// The same vector at this number up to one positive factor, in polynomials of least degree and
    /// content 1: remainders by the defining polynomial, all scaled alike.
    ///
    /// ```
    /// use mceip_exact::{nonnegative_roots, Poly};
    /// let root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
    /// let v = root.reduce(&[Poly::from_ints(&[0, 0, 6]), Poly::from_ints(&[0, 8])]);
    /// assert_eq!(v, [Poly::from_ints(&[3]), Poly::from_ints(&[0, 2])]); // (6 t^2, 8 t) ~ (3, 2 t)
    /// ```
    pub fn reduce(&self, vector: &[Poly]) -> Vec<Poly> {
        let steps = vector
            .iter()
            .map(|p| p.coeffs().len())
            .max()
            .unwrap_or(0)
            .saturating_sub(self.poly.coeffs().len() - 1);
        let reduced: Vec<Poly> = vector
            .iter()
            .map(|p| p.pseudo_rem_steps(&self.poly, steps))
            .collect();
        let content = reduced
            .iter()
            .fold(Integer::zero(), |g, p| g.gcd(&p.content()));
        if content.is_zero() || content.is_one() {
            return reduced;
        }
        reduced
            .iter()
            .map(|p| Poly::new(p.coeffs().iter().map(|c| c / &content).collect()))
            .collect()
    }

    /// Looks for a rational value: a root u/v of a primitive polynomial has v dividing the lead, so
    /// in an interval narrower than 1/(2 lead^2) only the fraction of least denominator can be it.
    ///
    /// Given up (the number stays as it is) for leads of more than 256 bits, where it would cost
    /// many halvings.
    pub fn try_rational(&mut self) {
        if self.interval.is_point() || self.poly.leading().bits() > 256 {
            return;
        }
        let lead = Rational::from_integer(self.poly.leading());
        self.refine_to(&(Rational::one() / (&lead * &lead * Rational::from_integer(2.into()))));
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
    pub fn equals(&mut self, other: &mut Algebraic) -> bool {
        if let Some(v) = other.as_rational() {
            return self.sign_of(&Poly::linear_root(v)) == Sign::Zero;
        }
        if let Some(v) = self.as_rational() {
            return other.sign_of(&Poly::linear_root(v)) == Sign::Zero;
        }
        // `other`'s polynomial vanishes at self exactly if the gcd does; then self is one of
        // other's conjugates, and it is other itself exactly if it lies in other's interval.
        let polynomial = other.poly.clone();
        self.sign_of(&polynomial) == Sign::Zero
            && self.cmp_rational(other.interval.lo()) == Ordering::Greater
            && self.cmp_rational(other.interval.hi()) == Ordering::Less
    }
}

/// The fraction of least denominator in [lo, hi] (Stern-Brocot).
fn simplest_between(lo: &Rational, hi: &Rational) -> Rational {
    let floor = lo.floor();
    if floor == *lo {
        return floor;
    }
    let next = &floor + Rational::one();
    if next <= *hi {
        return next;
    }
    // Both lie strictly between floor and floor + 1: recurse on the reciprocals of the fractions.
    floor.clone() + simplest_between(&(hi - &floor).recip(), &(lo - &floor).recip()).recip()
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
        for (n, d, expected) in [
            (7, 5, Ordering::Greater),
            (3, 2, Ordering::Less),
            (1393, 985, Ordering::Greater),
            (3363, 2378, Ordering::Less),
        ] {
            let rational = || Algebraic::rational(rational(n, d));
            assert_eq!(
                (
                    sqrt(2).cmp_exact(&mut rational()),
                    rational().cmp_exact(&mut sqrt(2))
                ),
                (expected, expected.reverse()),
                "{n}/{d}"
            );
        }
    }

    #[test]
    fn signs_are_exact_also_an_inch_from_zero() {
        // 3363/2378 is a convergent of sqrt 2, below it by 6e-8.
        let mut root = sqrt(2);
        assert_eq!(
            root.sign_of(&Poly::from_ints(&[-3363, 2378])),
            Sign::Negative
        );
        assert_eq!(
            root.sign_of(&Poly::from_ints(&[-1393, 985])),
            Sign::Positive
        );
        assert_eq!(
            root.sign_of(&Poly::from_ints(&[4, 0, 0, 0, -1])),
            Sign::Zero
        );
    }

    #[test]
    fn zero_tests_shrink_a_reducible_polynomial() {
        let p = &Poly::from_ints(&[-2, 0, 1]) * &Poly::from_ints(&[-5, 0, 1]);
        let mut root = nonnegative_roots(&p).remove(0);
        assert_eq!(root.sign_of(&Poly::from_ints(&[-2, 0, 1])), Sign::Zero);
        assert_eq!(root.poly(), &Poly::from_ints(&[-2, 0, 1]));
        let mut larger = nonnegative_roots(&p).remove(1);
        assert_eq!(
            larger.sign_of(&Poly::from_ints(&[-2, 0, 1])),
            Sign::Positive
        );
        // The common factor t^2 - 2 is not zero at sqrt 5, which is just below 2889/1292: the sign
        // stays open at first.
        let near = &Poly::from_ints(&[-2, 0, 1]) * &Poly::from_ints(&[-2889, 1292]);
        assert_eq!(larger.sign_of(&near), Sign::Negative);
        assert_eq!(larger.poly(), &Poly::from_ints(&[-5, 0, 1]));
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
        let root = nonnegative_roots(&Poly::from_ints(&[-2, 0, 1])).remove(0);
        let v = root.reduce(&[Poly::from_ints(&[0, 0, 6]), Poly::from_ints(&[0, 8])]);
        assert_eq!(v, [Poly::from_ints(&[3]), Poly::from_ints(&[0, 2])]);
        let v = root.reduce(&[Poly::from_ints(&[0, 1, 0, 0, 0, 1])]); // t + 4 t
        assert_eq!(v, [Poly::from_ints(&[0, 1])]);
    }

    /// A lead of more than 256 bits would cost as many halvings: the number stays as it is.
    #[test]
    fn a_rational_with_a_long_denominator_is_not_looked_for() {
        let long = |bits: u32| {
            &Poly::new(vec![(-3).into(), Integer::from(1) << bits]) * &Poly::from_ints(&[-2, 0, 1])
        };
        let of = |bits: u32| {
            let value = Rational::new(3.into(), Integer::from(1) << bits);
            let interval = Interval::new(
                &value - Rational::new(1.into(), Integer::from(1) << (bits + 3)),
                value.clone() * Rational::from_integer(2.into()),
            )
            .unwrap();
            let at_lo = long(bits).sign_at(interval.lo());
            let mut number = Algebraic {
                poly: long(bits),
                interval,
                at_lo,
            };
            number.try_rational();
            number.interval.is_point()
        };
        assert!(of(20) && !of(300));
    }
}
