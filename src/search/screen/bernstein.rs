//! Pieces of [0, infinity) that may hold a root of a polynomial, by Bernstein coefficients in
//! doubles with proved error bounds.
//!
//! With t = s tau / (1 - tau) the polynomial sum c_i t^i times (1 - tau)^d has on 0 <= tau <= 1 the
//! Bernstein coefficients c_i s^i / C(d, i): no sum, so no cancellation. All coefficients of one
//! sign on a piece: no root there (Descartes; Bernstein's form is a convex combination of them).
//! Halving a piece is de Casteljau's scheme, means of neighbours only.

use super::coefficients::{Coefficient, Coefficients};

/// Pieces are not halved beyond a width of 2^-DEPTH: about what doubles still tell apart.
pub(super) const DEPTH: u32 = 44;

/// A piece of the tau axis, with the Bernstein coefficients of the polynomial on it.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Lower end, a multiple of 2^-depth.
    pub(super) low: f64,
    /// The width is 2^-depth.
    pub(super) depth: u32,
    /// Each within `error` of the exact one.
    bernstein: Vec<f64>,
    error: f64,
}

impl Piece {
    /// The polynomial on all of 0 <= tau <= 1, with its factor t^m removed: (piece, m). `None` for
    /// the zero polynomial.
    ///
    /// Error: `relative_error` of the coefficients, one rounding for each factor of s^i, three more
    /// for binomial, product and quotient, in units of 2^-53 of the largest.
    pub(super) fn whole(coefficients: &[Coefficient], primes: usize, scale: Scale) -> Option<(Piece, usize)> {
        let first = coefficients.iter().position(|c| c.mantissa != 0.0)?;
        let last = coefficients.iter().rposition(|c| c.mantissa != 0.0)?;
        let degree = last - first;
        let (mut power, mut binomial) = (1.0, 1.0);
        let mut scaled: Vec<(f64, i32)> = Vec::with_capacity(degree + 1);
        for (i, c) in coefficients[first..=last].iter().enumerate() {
            scaled.push((c.mantissa * power / binomial, c.exponent + scale.exponent * i as i32));
            power *= scale.mantissa;
            binomial = binomial * (degree - i) as f64 / (i + 1) as f64; // exact up to degree 56
        }
        let size = |&(m, e): &(f64, i32)| if m == 0.0 { i32::MIN } else { e + exponent_of(m) };
        let top = scaled.iter().map(size).max().unwrap_or(0);
        let bernstein: Vec<f64> = scaled.iter().map(|&(m, e)| if m == 0.0 { 0.0 } else { times_power(m, e - top) }).collect();
        let largest = bernstein.iter().fold(0.0, |x: f64, v| x.max(v.abs()));
        let error = (Coefficients::relative_error(primes) + degree as f64 + 6.0) * UNIT * largest + f64::MIN_POSITIVE;
        Some((Piece { low: 0.0, depth: 0, bernstein, error }, first))
    }

    /// Upper end.
    pub(super) fn high(&self) -> f64 {
        self.low + power_of_two(-(self.depth as i32))
    }

    /// Is it proved that the polynomial has no root here?
    pub(super) fn has_no_root(&self) -> bool {
        self.bernstein.iter().all(|&v| v > self.error) || self.bernstein.iter().all(|&v| v < -self.error)
    }

    /// The two halves. Each mean of neighbours rounds once (halving is exact), and errors of
    /// means are means of errors: d more roundings of the largest coefficient.
    pub(super) fn halves(mut self) -> (Piece, Piece) {
        let n = self.bernstein.len();
        let largest = self.bernstein.iter().fold(0.0, |x: f64, v| x.max(v.abs()));
        let error = self.error + n as f64 * UNIT * largest + f64::MIN_POSITIVE;
        let mut left = Vec::with_capacity(n);
        for k in 0..n {
            left.push(self.bernstein[0]);
            for i in 0..n - 1 - k {
                self.bernstein[i] = 0.5 * (self.bernstein[i] + self.bernstein[i + 1]);
            }
        }
        // What is left of each row is its last entry: the right half.
        let depth = self.depth + 1;
        let middle = self.low + power_of_two(-(depth as i32));
        (Piece { low: self.low, depth, bernstein: left, error }, Piece { low: middle, depth, bernstein: self.bernstein, error })
    }
}

/// s = mantissa * 2^exponent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    pub(super) mantissa: f64,
    pub(super) exponent: i32,
}

/// 2^-53: half a unit in the last place of 1.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// 2^k, 0 below the range of normal doubles and the largest power above it.
pub(super) fn power_of_two(k: i32) -> f64 {
    if k < -1022 { 0.0 } else { f64::from_bits(((k.min(1023) + 1023) as u64) << 52) }
}

/// floor(log2 |v|) for normal v.
fn exponent_of(v: f64) -> i32 {
    ((v.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// v 2^k for k + log2|v| <= 0; what falls below the normal range becomes less than `MIN_POSITIVE`.
fn times_power(v: f64, k: i32) -> f64 {
    let e = exponent_of(v);
    v * power_of_two(-e) * power_of_two(k + e)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(c: &[f64], s: f64) -> (Piece, usize) {
        let c: Vec<Coefficient> = c.iter().map(|&mantissa| Coefficient { mantissa, exponent: 0 }).collect();
        Piece::whole(&c, 1, Scale { mantissa: s, exponent: 0 }).unwrap()
    }

    /// All pieces at `depth` that may hold a root, as intervals of t.
    fn cover(c: &[f64], s: f64, depth: u32) -> Vec<(f64, f64)> {
        let (mut stack, mut out) = (vec![whole(c, s).0], Vec::new());
        while let Some(p) = stack.pop() {
            if p.has_no_root() {
                continue;
            }
            if p.depth == depth {
                let t = |tau: f64| s * tau / (1.0 - tau);
                out.push((t(p.low), t(p.high())));
                continue;
            }
            let (l, r) = p.halves();
            stack.extend([r, l]);
        }
        out
    }

    #[test]
    fn pieces_cover_each_root_and_little_else() {
        let roots = [0.25, 1.0, 1.5, 40.0];
        let mut c = vec![1.0];
        for r in roots {
            let mut next = vec![0.0; c.len() + 1];
            c.iter().enumerate().for_each(|(i, v)| {
                next[i + 1] += v;
                next[i] -= r * v;
            });
            c = next;
        }
        for s in [1.0, 1.37, 8.0] {
            let pieces = cover(&c, s, 20);
            assert!(roots.iter().all(|r| pieces.iter().any(|(a, b)| a <= r && r <= b)), "{pieces:?}");
            assert!(pieces.len() <= 8 && pieces.iter().all(|(a, b)| roots.iter().any(|r| *a - 0.01 <= *r && *r <= *b + 0.01)));
        }
        assert!(cover(&[2.0, -2.0, 1.0], 1.0, 20).is_empty()); // 1 +- i
    }

    #[test]
    fn a_double_root_is_never_lost() {
        let mut stack = vec![whole(&[1.0, -2.0, 1.0], 1.25).0];
        let mut deepest = 0;
        while let Some(p) = stack.pop() {
            deepest = deepest.max(p.depth);
            if !p.has_no_root() && p.depth < DEPTH {
                let (l, r) = p.halves();
                stack.extend([l, r]);
            }
        }
        assert_eq!(deepest, DEPTH);
    }

    #[test]
    fn zeros_at_both_ends_are_divided_out() {
        let (p, at_zero) = whole(&[0.0, 0.0, -3.0, 1.0, 0.0], 1.0);
        assert_eq!((p.bernstein.len(), at_zero), (2, 2));
        assert!(Piece::whole(&[], 1, Scale { mantissa: 1.0, exponent: 0 }).is_none());
    }

    #[test]
    fn far_exponents_do_not_overflow() {
        let c = [Coefficient { mantissa: -3.0, exponent: 5000 }, Coefficient { mantissa: 1.0, exponent: -5000 }];
        let (p, _) = Piece::whole(&c, 3, Scale { mantissa: 1.5, exponent: 900 }).unwrap();
        assert!(p.bernstein.iter().all(|v| v.is_finite()) && !p.has_no_root());
    }
}
