//! Division of integer polynomials: pseudo-remainder, exact quotient, gcd, squarefree part, Sturm
//! chain.
//!
//! Over Z a remainder needs a multiplier: |lead(b)|^k a = q b + r with deg r < deg b. The
//! multiplier is taken positive, so that r has the sign of the remainder over Q. Remainder
//! sequences a, b, r, ... are kept short by dividing each member by its content (the primitive
//! remainder sequence; Knuth, The Art of Computer Programming 2, section 4.6.1).
//!
//! With r negated at each step and p' after p the sequence is a Sturm chain: between two points at
//! which p does not vanish it loses as many sign changes as p has distinct roots there (Sturm 1829;
//! Basu, Pollack and Roy, Algorithms in Real Algebraic Geometry, theorem 2.62).
//!
//! Called by `algebraic` (gcd, remainders), `roots` (chains) and `kernel` (exact quotients).

use super::{Integer, Poly, Rational};
use num_traits::{Signed, Zero};

/// A divisor with the sign and the absolute value of its leading coefficient.
struct Divisor<'a> {
    coeffs: &'a [Integer],
    lead: Integer,
    sign: Integer,
}

impl Divisor<'_> {
    fn new(poly: &Poly) -> Divisor<'_> {
        Divisor {
            coeffs: poly.coeffs(),
            lead: poly.leading().abs(),
            sign: poly.leading().signum(),
        }
    }

    /// |lead| rest - top t^shift divisor, where top t^shift is chosen so that the leading term of
    /// `rest` cancels. `rest` is at least as long as the divisor.
    fn cancel_leading_term(&self, rest: &Poly) -> Poly {
        let shift = rest.coeffs().len() - self.coeffs.len();
        let top = rest.leading() * &self.sign;

        let mut coeffs: Vec<Integer> = rest.coeffs().iter().map(|c| c * &self.lead).collect();

        for (c, d) in coeffs[shift..].iter_mut().zip(self.coeffs) {
            *c -= d * &top;
        }

        Poly::new(coeffs)
    }
}

impl Poly {
    /// A *positive* integer multiple of the remainder of `self` by `divisor` over Q.
    ///
    /// The multiplier is a power of |lead(divisor)|, so the sign survives: Sturm chains rely on it.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn pseudo_rem(&self, divisor: &Poly) -> Poly {
        assert!(!divisor.is_zero(), "division by the zero polynomial");
        let divisor = Divisor::new(divisor);

        let mut rest = self.clone();

        while rest.coeffs().len() >= divisor.coeffs.len() {
            rest = divisor.cancel_leading_term(&rest);
        }

        rest
    }

    /// The remainder of `self` by `divisor` times |lead(divisor)|^steps: with one number of steps
    /// for all entries a vector keeps its direction. `steps` is at least deg self - deg divisor +
    /// 1.
    pub fn pseudo_rem_steps(&self, divisor: &Poly, steps: usize) -> Poly {
        let divisor = Divisor::new(divisor);

        let mut rest = self.clone();

        for _ in 0..steps {
            rest = if rest.coeffs().len() >= divisor.coeffs.len() {
                divisor.cancel_leading_term(&rest)
            } else {
                rest.scale(&divisor.lead)
            };
        }

        rest
    }

    /// `self / divisor` when that divides exactly over Z, else `None`.
    pub fn exact_div(&self, divisor: &Poly) -> Option<Poly> {
        let length = divisor.coeffs().len();
        if length == 0 {
            return None;
        }

        let lead = divisor.leading();
        let mut rest = self.coeffs().to_vec();
        let mut quotient = vec![Integer::zero(); (rest.len() + 1).saturating_sub(length)];

        for k in (0..quotient.len()).rev() {
            let (q, remainder) = num_integer::Integer::div_rem(&rest[k + length - 1], &lead);
            if !remainder.is_zero() {
                return None;
            }
            for (i, c) in divisor.coeffs().iter().enumerate() {
                rest[k + i] -= &q * c;
            }
            quotient[k] = q;
        }

        let divides = rest.iter().all(Zero::is_zero);

        divides.then(|| Poly::new(quotient))
    }

    /// Primitive greatest common divisor (primitive remainder sequence); contents are ignored.
    pub fn gcd(&self, other: &Poly) -> Poly {
        let mut a = self.primitive();
        let mut b = other.primitive();

        while !b.is_zero() {
            let remainder = a.pseudo_rem(&b).primitive();
            a = b;
            b = remainder;
        }

        a
    }

    /// The primitive polynomial with the same roots, each simple.
    pub fn squarefree(&self) -> Poly {
        let p = self.primitive();
        let repeated = p.gcd(&p.derivative());
        // It divides p over Q and both are primitive, so by Gauss's lemma it divides over Z.
        p.exact_div(&repeated).unwrap_or(p)
    }

    /// The Sturm chain p, p', -rem, ... with each member scaled by a positive number (Sturm 1829).
    pub fn sturm_chain(&self) -> Vec<Poly> {
        let mut chain = vec![
            self.divided_by_content(),
            self.derivative().divided_by_content(),
        ];

        while let [.., a, b] = &chain[..] {
            if b.is_zero() {
                chain.pop();
                break;
            }
            let next = -&a.pseudo_rem(b);
            chain.push(next.divided_by_content());
        }

        chain
    }
}

/// Number of sign changes of a Sturm chain at a point, zeros skipped.
pub(super) fn variations(chain: &[Poly], t: &Rational) -> usize {
    let mut changes = 0;
    let mut previous = 0;

    for p in chain {
        let sign = p.sign_at(t);
        if sign == 0 {
            continue;
        }
        if sign == -previous {
            changes += 1;
        }
        previous = sign;
    }

    changes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::whole;

    #[test]
    fn gcd_and_exact_division_undo_multiplication() {
        let p = Poly::from_ints(&[-2, 0, 1]);
        let q = Poly::from_ints(&[3, 1]);
        let r = Poly::from_ints(&[1, 1, 1]);

        let pq = &p * &q;
        let pr = &p * &r;

        assert_eq!(pq.gcd(&pr), p);
        assert_eq!(pq.exact_div(&q), Some(p.clone()));
        assert_eq!(pq.exact_div(&r), None);
        assert_eq!(p.exact_div(&Poly::default()), None);
        assert_eq!((&pq * &p).squarefree(), pq);
    }

    #[test]
    fn pseudo_remainder_keeps_the_sign_for_negative_leads() {
        // rem(t^2, -2t + 1) = 1/4 > 0.
        let r = Poly::from_ints(&[0, 0, 1]).pseudo_rem(&Poly::from_ints(&[1, -2]));
        assert!(r.degree() == Some(0) && r.leading().is_positive());

        // One step, so that a sign turned at every step is not turned back: rem(t, -2t + 1) = 1/2 >
        // 0.
        let r = Poly::from_ints(&[0, 1]).pseudo_rem(&Poly::from_ints(&[1, -2]));
        assert!(r.degree() == Some(0) && r.leading().is_positive());
    }

    #[test]
    fn sturm_counts_distinct_real_roots() {
        let p = Poly::from_ints(&[-6, 11, -6, 1]); // roots 1, 2, 3

        let chain = p.sturm_chain();
        let changes = [0, 2, 3, 4].map(|t| variations(&chain, &whole(t)));

        let [at_0, at_2, at_3, at_4] = changes;
        assert_eq!(at_0 - at_4, 3);
        assert_eq!(at_0 - at_2, 2); // an upper end that is a root counts
        assert_eq!(at_2 - at_3, 1);
    }
}
