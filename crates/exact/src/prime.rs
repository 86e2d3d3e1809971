//! Arithmetic modulo primes just below 2^62: Montgomery products and a deterministic prime test.

/// A prime p < 2^62 with what Montgomery's product needs; numbers are kept in Montgomery form.
#[derive(Debug, Clone)]
pub struct Field {
    pub(crate) p: u64,
    /// -p^-1 mod 2^64.
    negated_inverse: u64,
    /// 2^128 mod p.
    square: u64,
}

impl Field {
    /// The field of an odd prime below 2^62 ([`primes`] gives them).
    pub fn new(p: u64) -> Field {
        // Newton's iteration for the inverse modulo 2^64 doubles the correct bits each time.
        let mut inverse = p;
        for _ in 0..6 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inverse)));
        }
        let r = (1u128 << 64) % u128::from(p);
        let square = (r * r % u128::from(p)) as u64;
        Field {
            p,
            negated_inverse: inverse.wrapping_neg(),
            square,
        }
    }

    /// The prime.
    pub fn prime(&self) -> u64 {
        self.p
    }

    /// a b / 2^64 mod p: the product of two numbers in Montgomery form, in Montgomery form.
    #[inline]
    pub fn mul(&self, a: u64, b: u64) -> u64 {
        self.reduce(u128::from(a) * u128::from(b))
    }

    /// sum a_k b_k / 2^64 mod p, reduced once.
    pub fn dot(&self, a: &[u64], b: &[u64]) -> u64 {
        let limit = u128::from(self.p) << 64; // < 2^126; a product is < 2^124
        let sum = a.iter().zip(b).fold(0u128, |sum, (&x, &y)| {
            let next = sum + u128::from(x) * u128::from(y);
            if next >= limit { next - limit } else { next }
        });
        self.reduce(sum)
    }

    /// product / 2^64 mod p, for product < 2^64 p.
    #[inline]
    fn reduce(&self, product: u128) -> u64 {
        let m = (product as u64).wrapping_mul(self.negated_inverse);
        // p < 2^62: the sum stays below 2^128.
        let reduced = ((product + u128::from(m) * u128::from(self.p)) >> 64) as u64;
        if reduced >= self.p {
            reduced - self.p
        } else {
            reduced
        }
    }

    /// a + b mod p.
    #[inline]
    pub fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    /// a - b mod p.
    #[inline]
    pub fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    /// Into Montgomery form.
    pub fn enter(&self, a: u64) -> u64 {
        self.mul(a, self.square)
    }

    /// Out of Montgomery form.
    pub fn leave(&self, a: u64) -> u64 {
        self.mul(a, 1)
    }

    /// a^-1 by Fermat, in Montgomery form.
    pub fn invert(&self, a: u64) -> u64 {
        let (mut result, mut base, mut e) = (self.enter(1), a, self.p - 2);
        while e > 0 {
            if e & 1 == 1 {
                result = self.mul(result, base);
            }
            base = self.mul(base, base);
            e >>= 1;
        }
        result
    }
}

/// The primes below 2^62, descending.
pub fn primes() -> impl Iterator<Item = u64> {
    (0..)
        .map(|k| (1u64 << 62) - 1 - 2 * k)
        .filter(|&n| is_prime(n))
}

/// Miller-Rabin with the first twelve primes as bases: proved for all n < 3.3e24 (Sorenson and
/// Webster 2015).
fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 || BASES.iter().any(|&b| n.is_multiple_of(b)) {
        return BASES.contains(&n);
    }
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;
    BASES.iter().all(|&base| {
        let mut x = power(base, odd, n);
        if x == 1 || x == n - 1 {
            return true;
        }
        (1..twos).any(|_| {
            x = (u128::from(x) * u128::from(x) % u128::from(n)) as u64;
            x == n - 1
        })
    })
}

fn power(base: u64, mut e: u64, n: u64) -> u64 {
    let (mut result, mut b) = (1u128, u128::from(base));
    while e > 0 {
        if e & 1 == 1 {
            result = result * b % u128::from(n);
        }
        b = b * b % u128::from(n);
        e >>= 1;
    }
    result as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prime_test_against_trial_division() {
        let slow = |n: u64| {
            n > 1
                && (2..)
                    .take_while(|d| d * d <= n)
                    .all(|d| !n.is_multiple_of(d))
        };
        assert!((0..3000).all(|n| is_prime(n) == slow(n)));
        assert!(!is_prime(3_215_031_751)); // strong pseudoprime to bases 2, 3, 5, 7
        assert_eq!(primes().next(), Some((1 << 62) - 57));
    }

    #[test]
    fn montgomery_agrees_with_division() {
        let p = primes().next().unwrap();
        let field = Field::new(p);
        for (a, b) in [
            (0, 5),
            (1, p - 1),
            (p - 1, p - 1),
            (123_456_789_012_345_678, 987_654_321),
        ] {
            let got = field.leave(field.mul(field.enter(a), field.enter(b)));
            assert_eq!(
                u128::from(got),
                u128::from(a) * u128::from(b) % u128::from(p)
            );
        }
        let (a, b) = (
            [p - 1; 20].map(|v| field.enter(v)),
            [p - 2; 20].map(|v| field.enter(v)),
        );
        assert_eq!(field.leave(field.dot(&a, &b)), 40); // 20 (-1)(-2)
        assert_eq!((field.add(p - 1, 3), field.sub(1, 3)), (2, p - 2));
        let a = field.enter(42);
        assert_eq!(field.leave(field.mul(a, field.invert(a))), 1);
    }

    #[test]
    fn a_field_knows_its_prime() {
        assert!(primes().take(3).all(|p| Field::new(p).prime() == p));
    }
}
