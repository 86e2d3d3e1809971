//! Isolation of real roots by Sturm's theorem and bisection.

use super::poly_gcd::variations;
use super::{Algebraic, Interval, Poly, Rational};
use num_traits::{One, Signed, Zero};

/// The distinct real roots of `p` that are >= 0, ascending. Multiplicities are not kept.
///
/// The zero polynomial has no isolated roots: callers treat it before.
///
/// ```
/// use mceip_exact::{nonnegative_roots, Poly};
/// assert_eq!(nonnegative_roots(&Poly::from_ints(&[0, -1, 0, 1])).len(), 2); // 0 and 1, not -1
/// ```
pub fn nonnegative_roots(p: &Poly) -> Vec<Algebraic> {
    roots_in(p, &Rational::zero(), None)
}

/// The distinct real roots of `p` in the closed window [min, max] (`None`: no upper end),
/// ascending.
pub fn roots_in(p: &Poly, min: &Rational, max: Option<&Rational>) -> Vec<Algebraic> {
    let mut roots = Vec::new();
    let (mut poly, mut chain) = squarefree_chain(p);
    if poly.degree().unwrap_or(0) == 0 {
        return roots;
    }
    let bound = cauchy_bound(&poly);
    let top = max.filter(|m| **m < bound).unwrap_or(&bound).clone();
    // Roots exactly at the ends are divided out, so that the rest lie strictly inside.
    let mut at_top = None;
    for (end, is_top) in [(min, false), (&top, true)] {
        if poly.sign_at(end) == 0 && !(is_top && *end == *min) {
            poly = poly.exact_div(&Poly::linear_root(end)).unwrap_or(poly); // exact: Gauss's lemma
            chain = poly.sturm_chain();
            let root = Algebraic::rational(end.clone());
            if is_top {
                at_top = Some(root)
            } else {
                roots.push(root)
            }
        }
    }
    if *min < top {
        isolate(&poly, &chain, min.clone(), top, &mut roots);
    }
    roots.extend(at_top);
    roots
}

/// The squarefree part and its Sturm chain. The chain of `p` ends with gcd(p, p'), so that for a
/// squarefree `p`, nearly always, one remainder sequence is enough.
fn squarefree_chain(p: &Poly) -> (Poly, Vec<Poly>) {
    let poly = p.primitive();
    let chain = poly.sturm_chain();
    match chain
        .last()
        .filter(|g| g.degree() > Some(0))
        .and_then(|g| poly.exact_div(&g.primitive()))
    {
        Some(part) => {
            let chain = part.sturm_chain();
            (part, chain)
        }
        None => (poly, chain),
    }
}

/// Appends the roots of a squarefree `poly` with this Sturm chain in the open interval (lo, hi),
/// ascending. Neither end is a root.
fn isolate(poly: &Poly, chain: &[Poly], lo: Rational, hi: Rational, roots: &mut Vec<Algebraic>) {
    let (at_lo, at_hi) = (variations(chain, &lo), variations(chain, &hi));
    let mut stack = vec![(lo, at_lo, hi, at_hi)];
    while let Some((lo, at_lo, hi, at_hi)) = stack.pop() {
        match at_lo - at_hi {
            0 => {}
            1 => roots.extend(Interval::new(lo, hi).map(|i| Algebraic::isolated(poly.clone(), i))),
            _ => {
                let mid = split_point(poly, &lo, &hi);
                let at_mid = variations(chain, &mid);
                stack.push((mid.clone(), at_mid, hi, at_hi));
                stack.push((lo, at_lo, mid, at_mid)); // popped first: ascending order
            }
        }
    }
}

/// A point inside (lo, hi) that is not a root: the midpoint, or a point a little off it.
fn split_point(poly: &Poly, lo: &Rational, hi: &Rational) -> Rational {
    let width = hi - lo;
    // A polynomial has finitely many roots, so one of 1/2, 1/3, 1/4, ... is none.
    (2u32..)
        .map(|k| lo + &width / Rational::from_integer(k.into()))
        .find(|t| poly.sign_at(t) != 0)
        .unwrap_or_else(|| lo.clone())
}

/// A number larger than the absolute value of every root: 1 + max |c_i / c_n| (Cauchy 1829),
/// rounded up to a power of two so that bisection meets short numbers.
fn cauchy_bound(poly: &Poly) -> Rational {
    let lead = poly.leading().abs();
    let largest = poly
        .coeffs()
        .iter()
        .map(|c| c.abs())
        .max()
        .unwrap_or_else(One::one);
    let bits = (largest / lead).bits() + 1;
    Rational::from_integer(num_bigint::BigInt::one() << (bits + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{rational, whole};

    #[test]
    fn finds_each_planted_root_once() {
        let mut p = Poly::from_ints(&[1, 0, 1]); // no real root
        for (u, v) in [(0, 1), (1, 3), (1, 3), (5, 2), (-4, 1), (7, 1)] {
            p = &p * &Poly::linear_root(&rational(u, v));
        }
        let found: Vec<_> = nonnegative_roots(&p)
            .into_iter()
            .map(|mut r| {
                r.try_rational();
                r.as_rational().cloned().unwrap()
            })
            .collect();
        assert_eq!(
            found,
            vec![whole(0), rational(1, 3), rational(5, 2), whole(7)]
        );
    }

    #[test]
    fn the_window_is_closed_and_excludes_the_rest() {
        let p = Poly::from_ints(&[-6, 11, -6, 1]); // 1, 2, 3
        let count = |a: Rational, b: Option<Rational>| roots_in(&p, &a, b.as_ref()).len();
        assert_eq!(count(whole(1), Some(whole(2))), 2);
        assert_eq!(count(rational(11, 10), Some(rational(19, 10))), 0);
        assert_eq!(count(whole(2), Some(whole(2))), 1);
        assert_eq!(count(whole(3), None), 1);
        assert_eq!(count(whole(4), None), 0);
    }

    #[test]
    fn close_roots_are_separated_and_constants_have_none() {
        let p = &Poly::linear_root(&rational(1_000_000, 1_000_001))
            * &Poly::linear_root(&rational(1_000_001, 1_000_002));
        assert_eq!(nonnegative_roots(&p).len(), 2);
        assert!(nonnegative_roots(&Poly::from_ints(&[5])).is_empty());
        assert!(nonnegative_roots(&Poly::default()).is_empty());
    }
}
