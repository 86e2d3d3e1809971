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
//! Most pairs of polynomials have no common factor, and most of those have none modulo a prime
//! either, where the sequence takes machine integers ([`have_no_common_factor_modulo`]).
//!
//! Called by `algebraic` (gcd, remainders), `roots` (chains) and `kernel` (exact quotients).

use super::modular::residue;
use super::{Field, Integer, Poly, Rational};
use num_traits::{Signed, Zero};

/// The Mersenne prime 2^61 - 1.
const PRIME: u64 = (1 << 61) - 1;

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
        if have_no_common_factor_modulo(PRIME, self, other) {
            return Poly::from_ints(&[1]);
        }

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

/// Whether a and b are seen to be coprime over Q by their residues modulo a prime p.
///
/// A common factor h of positive degree, taken primitive, divides both over Z (Gauss's lemma). Its
/// lead divides that of a. So where p does not divide the lead of a, h keeps its degree modulo p
/// and divides both residues, which then have a common factor too. `false` says nothing.
fn have_no_common_factor_modulo(p: u64, a: &Poly, b: &Poly) -> bool {
    let field = Field::new(p);
    let [mut a, mut b] = [a, b].map(|poly| residues(poly, &field));

    // Without this `true` could be wrong.
    let keeps_its_degree = a.last().is_some_and(|lead| *lead != 0);
    if !keeps_its_degree {
        return false;
    }

    loop {
        // The lead of a is not zero.
        while b.last() == Some(&0) {
            b.pop();
        }
        match b.len() {
            0 => return a.len() == 1,
            1 => return true,
            _ => {}
        }
        if a.len() >= b.len() {
            reduce_modulo(&mut a, &b, &field);
        }
        std::mem::swap(&mut a, &mut b);
    }
}

/// The coefficients of a polynomial modulo the prime of a field.
fn residues(poly: &Poly, field: &Field) -> Vec<u64> {
    poly.coeffs()
        .iter()
        .map(|c| field.enter(residue(c, field.prime())))
        .collect()
}

/// Leaves the remainder of `a` by `b`, whose lead is not zero; it may end in zeros.
fn reduce_modulo(a: &mut Vec<u64>, b: &[u64], field: &Field) {
    let length = b.len();
    let inverse_of_lead = field.invert(b[length - 1]);

    while a.len() >= length {
        let shift = a.len() - length;
        let factor = field.mul(a[a.len() - 1], inverse_of_lead);
        for (entry, divisor_entry) in a[shift..].iter_mut().zip(b) {
            *entry = field.sub(*entry, field.mul(factor, *divisor_entry));
        }
        a.pop();
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

    /// t - 1 and t - 4 are one polynomial modulo 3, and 3 t + 1 loses its degree there.
    #[test]
    fn coprime_modulo_a_prime_says_coprime_and_nothing_else() {
        let seen = |p, a: &[i64], b: &[i64]| {
            have_no_common_factor_modulo(p, &Poly::from_ints(a), &Poly::from_ints(b))
        };

        assert!(seen(PRIME, &[-1, 1], &[-4, 1]));
        assert!(seen(PRIME, &[-2, 0, 1], &[5]));
        assert!(seen(3, &[1, 0, 1], &[2, 1]));
        assert!(seen(7, &[5], &[]));

        assert!(!seen(PRIME, &[-2, 0, 1], &[0, -2, 0, 1]));
        assert!(!seen(PRIME, &[-2, 0, 1], &[]));
        assert!(!seen(PRIME, &[], &[1]));
        assert!(!seen(3, &[-1, 1], &[-4, 1]));
        assert!(!seen(3, &[1, 3], &[1, 3]));
        assert!(!seen(3, &[1, 3], &[1, 1, 3]));
        assert_eq!(
            Poly::from_ints(&[1, 3]).gcd(&Poly::from_ints(&[4])),
            Poly::from_ints(&[1])
        );
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
