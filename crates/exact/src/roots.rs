//! Isolation of real roots by Sturm's theorem and bisection.
//!
//! 1. p is replaced by its squarefree part, which has the same roots.
//! 2. All roots are below Cauchy's bound, so the window becomes bounded.
//! 3. Roots at the two ends are divided out.
//! 4. The number of roots in an open interval whose ends are no roots is the difference of the sign
//!    changes of the Sturm chain at the ends (`poly_gcd`). Intervals with more than one root are
//!    halved until each has one.
//!
//! Input: a polynomial over Z, not zero, and a closed window. Output: its distinct roots in the
//! window, ascending, each as a polynomial with an isolating interval. Called by the oracle and by
//! the search for eigenvalues of a support, with a determinant.

use super::poly_gcd::variations;
use super::{Algebraic, Integer, Interval, Poly, Rational};
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

/// The distinct real roots of `p` in the closed window [min, max] (`None`: no end), ascending.
pub fn roots_in<'a>(
    p: &Poly,
    min: impl Into<Option<&'a Rational>>,
    max: Option<&Rational>,
) -> Vec<Algebraic> {
    let mut roots = Vec::new();
    let mut squarefree = Squarefree::part_of(p);

    if squarefree.poly.degree().unwrap_or(0) == 0 {
        return roots;
    }

    let bound = cauchy_bound(&squarefree.poly);
    let lowest = -&bound;
    let min = min.into().unwrap_or(&lowest);
    let top = match max {
        Some(max) if *max < bound => max.clone(),
        _ => bound,
    };

    // Roots exactly at the ends are divided out, so that the rest lie strictly inside.
    if squarefree.poly.sign_at(min) == 0 {
        squarefree = squarefree.without_root(min);
        roots.push(Algebraic::rational(min.clone()));
    }

    let mut at_top = None;
    if squarefree.poly.sign_at(&top) == 0 && top != *min {
        squarefree = squarefree.without_root(&top);
        at_top = Some(Algebraic::rational(top.clone()));
    }

    if *min < top {
        squarefree.isolate(min.clone(), top, &mut roots);
    }

    roots.extend(at_top);

    roots
}

/// A squarefree polynomial and its Sturm chain.
struct Squarefree {
    poly: Poly,
    chain: Vec<Poly>,
}

/// An open interval whose ends are no roots, with the sign changes of the Sturm chain there.
struct SturmSection {
    lo: Rational,
    hi: Rational,
    changes_at_lo: usize,
    changes_at_hi: usize,
}

impl Squarefree {
    /// The squarefree part. The chain of `p` ends with gcd(p, p'), so that for a squarefree `p`,
    /// nearly always, one remainder sequence is enough.
    fn part_of(p: &Poly) -> Squarefree {
        let poly = p.primitive();
        let chain = poly.sturm_chain();

        if let Some(gcd) = chain.last()
            && gcd.degree() > Some(0)
            && let Some(part) = poly.exact_div(&gcd.primitive())
        {
            return Squarefree::of(part);
        }

        Squarefree { poly, chain }
    }

    fn of(poly: Poly) -> Squarefree {
        let chain = poly.sturm_chain();
        Squarefree { poly, chain }
    }

    /// Divided by the linear factor of a rational root; exact by Gauss's lemma.
    fn without_root(self, root: &Rational) -> Squarefree {
        let quotient = self.poly.exact_div(&Poly::linear_root(root));
        Squarefree::of(quotient.unwrap_or(self.poly))
    }

    /// Appends the roots in the open interval (lo, hi), ascending. Neither end is a root.
    fn isolate(&self, lo: Rational, hi: Rational, roots: &mut Vec<Algebraic>) {
        let mut stack = vec![SturmSection {
            changes_at_lo: variations(&self.chain, &lo),
            changes_at_hi: variations(&self.chain, &hi),
            lo,
            hi,
        }];

        while let Some(section) = stack.pop() {
            match section.changes_at_lo - section.changes_at_hi {
                0 => {}
                1 => {
                    let interval = Interval::new(section.lo, section.hi);
                    roots.extend(interval.map(|i| Algebraic::isolated(self.poly.clone(), i)));
                }
                _ => {
                    let [lower, upper] = self.halves(section);
                    stack.push(upper);
                    stack.push(lower); // popped first: ascending order
                }
            }
        }
    }

    fn halves(&self, section: SturmSection) -> [SturmSection; 2] {
        let mid = self.split_point(&section.lo, &section.hi);
        let changes_at_mid = variations(&self.chain, &mid);
        let lower = SturmSection {
            lo: section.lo,
            hi: mid.clone(),
            changes_at_lo: section.changes_at_lo,
            changes_at_hi: changes_at_mid,
        };

        let upper = SturmSection {
            lo: mid,
            hi: section.hi,
            changes_at_lo: changes_at_mid,
            changes_at_hi: section.changes_at_hi,
        };

        [lower, upper]
    }

    /// A point inside (lo, hi) that is not a root: the midpoint, or a point a little off it. A
    /// polynomial has finitely many roots, so one of lo + width/2, lo + width/3, ... is none.
    fn split_point(&self, lo: &Rational, hi: &Rational) -> Rational {
        let width = hi - lo;
        let mut divisor = 2u32;

        loop {
            let point = lo + &width / Rational::from_integer(divisor.into());
            if self.poly.sign_at(&point) != 0 {
                return point;
            }
            divisor += 1;
        }
    }
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

    Rational::from_integer(Integer::one() << (bits + 1))
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

        let mut found = Vec::new();
        for mut root in nonnegative_roots(&p) {
            root.try_rational();
            found.push(root.as_rational().cloned().unwrap());
        }

        let expected = [whole(0), rational(1, 3), rational(5, 2), whole(7)];
        assert_eq!(found, expected);
    }

    #[test]
    fn the_window_is_closed_and_excludes_the_rest() {
        let p = Poly::from_ints(&[-6, 11, -6, 1]); // 1, 2, 3
        let windows = [
            (whole(1), Some(whole(2)), 2),
            (rational(11, 10), Some(rational(19, 10)), 0),
            (whole(2), Some(whole(2)), 1),
            (whole(3), None, 1),
            (whole(4), None, 0),
        ];

        for (min, max, expected) in windows {
            let roots = roots_in(&p, &min, max.as_ref());
            assert_eq!(roots.len(), expected, "{min} {max:?}");
        }
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
