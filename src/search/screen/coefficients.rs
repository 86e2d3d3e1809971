//! From residues of values to the signs and sizes of the exact coefficients of a determinant.

use super::minors::Minors;
use crate::exact::Field;

/// log2 of every prime used exceeds this: they are the largest below 2^62.
const PRIME_BITS: f64 = 61.99;

/// An integer coefficient: sign exact, `mantissa * 2^exponent` with relative error below
/// [`Coefficients::relative_error`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coefficient {
    pub(super) mantissa: f64,
    pub(super) exponent: i32,
}

/// Interpolation modulo each prime and the Chinese remainder theorem (Garner's mixed radix).
#[derive(Debug)]
pub(super) struct Coefficients {
    primes: Vec<Prime>,
}

#[derive(Debug)]
struct Prime {
    field: Field,
    /// For each degree d the (d+1) x (d+1) inverse Vandermonde matrix, rows by coefficient.
    inverse_vandermonde: Vec<Vec<u64>>,
    /// Product of the primes before modulo this one, one factor less each: p_0 ... p_(k-1).
    products: Vec<u64>,
    /// Inverse of the product of all primes before.
    inverse: u64,
}

impl Coefficients {
    /// Bound of the relative error of a coefficient made of `count` digits, in units of 2^-53: each
    /// digit costs a conversion, a rounded prime, a product and a sum, and the first sum may cancel
    /// to half of its larger term.
    pub(super) fn relative_error(count: usize) -> f64 {
        8.0 + 4.0 * count as f64
    }

    pub(super) fn new(minors: &[Minors]) -> Coefficients {
        let primes = minors.iter().enumerate().map(|(k, m)| {
            let field = m.field.clone();
            let mut products = vec![field.enter(1)];
            for before in &minors[..k] {
                let factor = field.enter(before.field.prime() % field.prime());
                products.push(field.mul(products[products.len() - 1], factor));
            }
            let inverse = field.invert(products[k]);
            let inverse_vandermonde = (0..m.points.len()).map(|d| invert_vandermonde(&field, &m.points[..=d])).collect();
            Prime { field, inverse_vandermonde, products, inverse }
        });
        Coefficients { primes: primes.collect() }
    }

    /// How many primes prove a number of absolute value at most 2^bits.
    pub(super) fn primes_for(bits: f64) -> usize {
        // |c| < P/2
        ((bits + 1.0) / PRIME_BITS).floor() as usize + 1
    }

    /// Every bound for which [`Coefficients::primes_for`] wants more than `count` primes is above
    /// this, whatever the order in which its terms were added up.
    pub(super) fn bits_beyond(count: usize) -> f64 {
        PRIME_BITS * count as f64 - 1.0 - 1.0 / 128.0
    }

    /// Coefficients of the polynomial of degree at most `degree` whose values at the first points
    /// are `values(prime)`, constant term first.
    pub(super) fn interpolate<'v>(&self, degree: usize, count: usize, values: impl Fn(usize) -> &'v [u64], out: &mut Vec<Coefficient>) {
        out.clear();
        let width = degree + 1;
        let mut digits = Vec::with_capacity(count);
        for row in 0..width {
            digits.clear();
            for (k, prime) in self.primes[..count].iter().enumerate() {
                let matrix = &prime.inverse_vandermonde[degree][row * width..][..width];
                let residue = prime.field.dot(matrix, &values(k)[..width]);
                digits.push(prime.digit(residue, &digits));
            }
            out.push(self.float(&digits));
        }
    }

    /// Horner in mixed radix. Digits are balanced, so that the top one that is not zero outweighs
    /// the rest by a factor of two: no sum cancels below half of its larger term.
    fn float(&self, digits: &[i64]) -> Coefficient {
        let Some(top) = digits.iter().rposition(|&d| d != 0) else { return Coefficient { mantissa: 0.0, exponent: 0 } };
        let (mut mantissa, mut exponent, mut unit) = (digits[top] as f64, 0, 1.0);
        for k in (0..top).rev() {
            mantissa = mantissa * self.primes[k].field.prime() as f64 + digits[k] as f64 * unit;
            // Powers of two: exact, and far from the ends of the range of doubles.
            mantissa *= SHIFT;
            unit *= SHIFT;
            exponent += SHIFT_BITS;
        }
        Coefficient { mantissa, exponent }
    }
}

/// 2^-62: one prime's worth.
const SHIFT: f64 = 1.0 / (1u64 << 62) as f64;
const SHIFT_BITS: i32 = 62;

impl Prime {
    /// The next balanced digit of a number with this residue and these lower digits.
    fn digit(&self, residue: u64, lower: &[i64]) -> i64 {
        let (f, p) = (&self.field, self.field.prime());
        let mut rest = residue;
        for (&d, &product) in lower.iter().zip(&self.products) {
            let d = if d < 0 { p - d.unsigned_abs() % p } else { d.unsigned_abs() % p };
            rest = f.sub(rest, f.mul(f.enter(d % p), product));
        }
        let digit = f.leave(f.mul(rest, self.inverse));
        if digit > p / 2 { -((p - digit) as i64) } else { digit as i64 }
    }
}

/// Rows of the inverse of (t_j^i): coefficient i of the Lagrange polynomial of point j.
fn invert_vandermonde(f: &Field, points: &[u64]) -> Vec<u64> {
    let n = points.len();
    let mut master = vec![f.enter(1)]; // prod (t - t_j), constant term first
    for &t in points {
        let mut next = vec![0; master.len() + 1];
        for (i, &c) in master.iter().enumerate() {
            next[i + 1] = f.add(next[i + 1], c);
            next[i] = f.sub(next[i], f.mul(c, t));
        }
        master = next;
    }
    let mut inverse = vec![0; n * n];
    for (j, &t) in points.iter().enumerate() {
        let mut quotient = vec![0; n]; // master / (t - t_j)
        let mut carry = 0;
        for i in (0..n).rev() {
            carry = f.add(master[i + 1], f.mul(carry, t));
            quotient[i] = carry;
        }
        let value = quotient.iter().rev().fold(0, |v, &c| f.add(f.mul(v, t), c));
        let scale = f.invert(value); // the points are distinct
        quotient.iter().enumerate().for_each(|(i, &c)| inverse[i * n + j] = f.mul(c, scale));
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::super::integral::Integral;
    use super::*;
    use crate::exact::{Integer, Sparse, determinant, primes};
    use crate::model::Pencil;
    use num_traits::ToPrimitive;

    fn check(scale: i64) {
        let a: Vec<Vec<i64>> = vec![vec![3 * scale + 1, -9, 1], vec![4, 5 * scale - 7, 0], vec![-7, 2, 8 * scale + 3]];
        let b: Vec<Vec<i64>> = vec![vec![-scale, 1, 2], vec![1, -2, 6], vec![9, 9, 1 - scale]];
        let rows = |m: &[Vec<i64>]| Sparse::from_ints(&m.iter().map(|r| &r[..]).collect::<Vec<_>>());
        let pencil = Integral::of(&Pencil::new(rows(&a), rows(&b), vec![]).unwrap());
        let count = Coefficients::primes_for(pencil.coefficient_bits(7));
        let minors: Vec<Minors> = primes().take(count).map(|p| Minors::new(&pencil, p, 4)).collect();
        let coefficients = Coefficients::new(&minors);
        let values: Vec<Vec<u64>> = minors
            .iter()
            .map(|m| {
                let mut v = Vec::new();
                m.block(0, 3, 0.0, &mut v);
                v
            })
            .collect();
        let mut got = Vec::new();
        coefficients.interpolate(3, count, |k| &values[k][7 * 4..], &mut got);
        let integers = |m: &[Vec<i64>]| -> Vec<Vec<Integer>> { m.iter().map(|r| r.iter().map(|&v| v.into()).collect()).collect() };
        let want = determinant(&integers(&a), &integers(&b));
        for (g, w) in got.iter().zip(want.coeffs()) {
            let (g, w) = (g.mantissa * f64::from(g.exponent).exp2(), w.to_f64().unwrap());
            assert!((g - w).abs() <= Coefficients::relative_error(count) * f64::EPSILON / 2.0 * w.abs(), "{g} {w}");
        }
    }

    #[test]
    fn coefficients_agree_with_exact_ones_for_one_two_and_four_primes() {
        for scale in [1, -2, 1_000_000_007, 1 << 40, -(1 << 58)] {
            check(scale);
        }
    }

    #[test]
    fn zero_is_zero_and_the_number_of_primes_covers_the_sign() {
        assert_eq!((Coefficients::primes_for(60.9), Coefficients::primes_for(61.5), Coefficients::primes_for(0.0)), (1, 2, 1));
        assert!(Coefficients::bits_beyond(1) < 60.99 && Coefficients::primes_for(Coefficients::bits_beyond(2)) == 2);
        let a = Sparse::from_ints(&[&[1, 2], &[2, 4]]);
        let pencil = Integral::of(&Pencil::new(a.clone(), a, vec![]).unwrap());
        let minors = vec![Minors::new(&pencil, primes().next().unwrap(), 3)];
        let (mut values, mut got) = (Vec::new(), Vec::new());
        minors[0].block(0, 2, 0.0, &mut values);
        Coefficients::new(&minors).interpolate(2, 1, |_| &values[9..], &mut got);
        assert!(got.iter().all(|c| c.mantissa == 0.0));
    }
}
