//! The field Q(alpha) as Q[t] modulo a squarefree polynomial that shrinks when a zero divisor shows
//! up, and the null space of a matrix over it by plain Gauss elimination with division.

use super::poly::{
    P, add, changes, compose, derivative, divide, eval, gcd, half, monic, mul, q, scale, trim,
};
use dashu_ratio::RBig;

/// A real number: the only root of `p` in (lo, hi), or lo = hi.
#[derive(Debug, Clone)]
pub struct Alpha {
    pub p: P,
    pub lo: RBig,
    pub hi: RBig,
}

impl Alpha {
    /// From an isolating open interval with Descartes count 1, shrunk until its ends are no roots.
    pub fn new(p: &[RBig], (lo, hi): (RBig, RBig)) -> Alpha {
        let mut alpha = if lo == hi {
            Alpha::rational(lo)
        } else {
            Alpha {
                p: monic(p),
                lo,
                hi,
            }
        };
        while alpha.lo != alpha.hi
            && [&alpha.lo, &alpha.hi]
                .into_iter()
                .any(|end| eval(&alpha.p, end) == RBig::ZERO)
        {
            let mid = (&alpha.lo + &alpha.hi) * half();
            if eval(&alpha.p, &mid) == RBig::ZERO {
                alpha = Alpha::rational(mid);
            } else if changes(&compose(&alpha.p, &alpha.lo, &(&mid - &alpha.lo))) == 1 {
                alpha.hi = mid;
            } else {
                alpha.lo = mid;
            }
        }
        alpha
    }

    pub fn rational(v: RBig) -> Alpha {
        Alpha {
            p: vec![-v.clone(), q(1)],
            lo: v.clone(),
            hi: v,
        }
    }

    pub fn halve(&mut self) {
        let mid = (&self.lo + &self.hi) * half();
        let (at_mid, zero) = (eval(&self.p, &mid), RBig::ZERO);
        if at_mid == zero {
            *self = Alpha::rational(mid);
        } else if (at_mid > zero) == (eval(&self.p, &self.hi) > zero) {
            self.hi = mid;
        } else {
            self.lo = mid;
        }
    }

    pub fn reduce(&self, e: &[RBig]) -> P {
        divide(e, &self.p).1
    }

    /// Does e vanish here? A common factor with p splits p.
    pub fn is_zero(&mut self, e: &[RBig]) -> bool {
        let e = self.reduce(e);
        if e.is_empty() {
            return true;
        }
        let g = gcd(&e, &self.p);
        if g.len() <= 1 {
            return false;
        }
        // Exactly one of g and p / g vanishes at alpha: the one that has a root inside.
        let rest = divide(&self.p, &g).0;
        let zero = RBig::ZERO;
        let here = if self.lo == self.hi {
            true
        } else {
            (eval(&g, &self.lo) > zero) != (eval(&g, &self.hi) > zero)
        };
        self.p = monic(if here { &g } else { &rest });
        here
    }

    /// 1, 0 or -1: value at the middle, bound of the derivative on the interval.
    pub fn sign(&mut self, e: &[RBig]) -> i8 {
        if self.is_zero(e) {
            return 0;
        }
        let e = self.reduce(e);
        let slope = derivative(&e);
        let magnitude = |v: &RBig| {
            if *v < RBig::ZERO {
                -v.clone()
            } else {
                v.clone()
            }
        };
        loop {
            let mid = (&self.lo + &self.hi) * half();
            let largest = if magnitude(&self.lo) > magnitude(&self.hi) {
                magnitude(&self.lo)
            } else {
                magnitude(&self.hi)
            };
            let steepest = eval(&slope.iter().map(magnitude).collect::<P>(), &largest);
            let (value, slack) = (eval(&e, &mid), steepest * (&self.hi - &self.lo));
            if magnitude(&value) > slack {
                return if value > RBig::ZERO { 1 } else { -1 };
            }
            self.halve();
        }
    }

    /// 1 / e modulo p by the extended Euclidean algorithm; e is not zero here.
    fn invert(&mut self, e: &[RBig]) -> P {
        assert!(!self.is_zero(e));
        let (mut r0, mut r1) = (self.p.clone(), self.reduce(e));
        let (mut s0, mut s1): (P, P) = (Vec::new(), vec![q(1)]);
        while !r1.is_empty() {
            let (quotient, rest) = divide(&r0, &r1);
            (r0, r1) = (r1, rest);
            let next = add(&s0, &scale(&mul(&quotient, &s1), &q(-1)));
            (s0, s1) = (s1, next);
        }
        self.reduce(&scale(&s0, &(q(1) / &r0[0])))
    }

    /// A basis of the null space of a matrix with `cols` columns.
    pub fn null_space(&mut self, mut m: Vec<Vec<P>>, cols: usize) -> Vec<Vec<P>> {
        let mut pivots: Vec<usize> = Vec::new();
        for c in 0..cols {
            let top = pivots.len();
            let Some(r) = (top..m.len()).find(|&r| !self.is_zero(&m[r][c])) else {
                continue;
            };
            m.swap(top, r);
            let inverse = self.invert(&m[top][c]);
            m[top] = m[top]
                .iter()
                .map(|e| self.reduce(&mul(e, &inverse)))
                .collect();
            for i in (0..m.len()).filter(|&i| i != top) {
                let factor = scale(&m[i][c], &q(-1));
                m[i] = (0..cols)
                    .map(|j| self.reduce(&add(&m[i][j], &mul(&factor, &m[top][j]))))
                    .collect();
            }
            pivots.push(c);
        }
        let free = (0..cols).filter(|c| !pivots.contains(c));
        let vector = |f: usize| {
            let mut v: Vec<P> = vec![Vec::new(); cols];
            v[f] = vec![q(1)];
            pivots
                .iter()
                .enumerate()
                .for_each(|(r, &c)| v[c] = scale(&trim(m[r][f].clone()), &q(-1)));
            v
        };
        free.map(vector).collect()
    }

    /// Is this the number isolated by another polynomial and closed interval?
    pub fn is_root_in(&mut self, p: &[RBig], lo: &RBig, hi: &RBig) -> bool {
        if !self.is_zero(p) {
            return false;
        }
        let at_least = |a: &mut Alpha, v: &RBig| a.sign(&[-v.clone(), q(1)]);
        at_least(self, lo) >= 0 && at_least(self, hi) <= 0
    }
}
