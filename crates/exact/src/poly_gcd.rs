//! Division of integer polynomials: pseudo-remainder, exact quotient, gcd, squarefree part, Sturm
//! chain.

use super::{Integer, Poly, Rational};
use num_traits::{One, Signed, Zero};

impl Poly {
    /// A *positive* integer multiple of the remainder of `self` by `divisor` over Q.
    ///
    /// The multiplier is a power of |lead(divisor)|, so the sign survives: Sturm chains rely on it.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn pseudo_rem(&self, divisor: &Poly) -> Poly {
        let m = divisor.coeffs().len();
        assert!(m > 0, "division by the zero polynomial");
        let (lead, sign) = (divisor.leading().abs(), divisor.leading().signum());
        let mut rest = self.clone();
        while rest.coeffs().len() >= m {
            let shift = rest.coeffs().len() - m;
            let top = rest.leading() * &sign;
            rest = &rest.scale(&lead) - &divisor.scale(&top).shift(shift);
        }
        rest
    }

    /// The remainder of `self` by `divisor` times |lead(divisor)|^steps: with one number of steps
    /// for all entries a vector keeps its direction. `steps` is at least deg self - deg divisor +
    /// 1.
    #[doc(hidden)]
    pub fn pseudo_rem_steps(&self, divisor: &Poly, steps: usize) -> Poly {
        let m = divisor.coeffs().len();
        let (lead, sign) = (divisor.leading().abs(), divisor.leading().signum());
        let mut rest = self.clone();
        for _ in 0..steps {
            let scaled = rest.scale(&lead);
            rest = match rest.coeffs().len().checked_sub(m) {
                Some(shift) => &scaled - &divisor.scale(&(rest.leading() * &sign)).shift(shift),
                None => scaled,
            };
        }
        rest
    }

    /// `self / divisor` when that divides exactly over Z, else `None`.
    pub fn exact_div(&self, divisor: &Poly) -> Option<Poly> {
        let m = divisor.coeffs().len();
        if m == 0 {
            return None;
        }
        let mut rest = self.coeffs().to_vec();
        let mut quotient = vec![Integer::zero(); (rest.len() + 1).saturating_sub(m)];
        let lead = divisor.leading();
        for k in (0..quotient.len()).rev() {
            let (q, r) = num_integer::Integer::div_rem(&rest[k + m - 1], &lead);
            if !r.is_zero() {
                return None;
            }
            for (i, c) in divisor.coeffs().iter().enumerate() {
                rest[k + i] -= &q * c;
            }
            quotient[k] = q;
        }
        rest.iter().all(Zero::is_zero).then(|| Poly::new(quotient))
    }

    /// Primitive greatest common divisor (primitive remainder sequence); contents are ignored.
    pub fn gcd(&self, other: &Poly) -> Poly {
        let (mut a, mut b) = (self.primitive(), other.primitive());
        while !b.is_zero() {
            let r = a.pseudo_rem(&b).primitive();
            (a, b) = (b, r);
        }
        a
    }

    /// The primitive polynomial with the same roots, each simple.
    pub fn squarefree(&self) -> Poly {
        let p = self.primitive();
        let g = p.gcd(&p.derivative());
        // g divides p over Q and both are primitive, so by Gauss's lemma it divides over Z.
        p.exact_div(&g).unwrap_or(p)
    }

    /// The Sturm chain p, p', -rem, ... with each member scaled by a positive number (Sturm 1829).
    pub fn sturm_chain(&self) -> Vec<Poly> {
        let positive_part = |p: &Poly| {
            let g = p.content();
            if g.is_zero() || g.is_one() {
                p.clone()
            } else {
                Poly::new(p.coeffs().iter().map(|c| c / &g).collect())
            }
        };
        let mut chain = vec![positive_part(self), positive_part(&self.derivative())];
        while let [.., a, b] = &chain[..] {
            if b.is_zero() {
                chain.pop();
                break;
            }
            let next = -&a.pseudo_rem(b);
            chain.push(positive_part(&next));
        }
        chain
    }
}

/// Number of sign changes of a Sturm chain at a point, zeros skipped.
pub(super) fn variations(chain: &[Poly], t: &Rational) -> usize {
    let signs: Vec<i8> = chain
        .iter()
        .map(|p| p.sign_at(t))
        .filter(|&s| s != 0)
        .collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::whole;

    #[test]
    fn gcd_and_exact_division_undo_multiplication() {
        let (p, q, r) = (
            Poly::from_ints(&[-2, 0, 1]),
            Poly::from_ints(&[3, 1]),
            Poly::from_ints(&[1, 1, 1]),
        );
        let (pq, pr) = (&p * &q, &p * &r);
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
        let count = |a: i64, b: i64| variations(&chain, &whole(a)) - variations(&chain, &whole(b));
        assert_eq!((count(0, 4), count(0, 2), count(2, 3)), (3, 2, 1));
    }
}
