//! Arithmetic modulo primes just below 2^62: Montgomery products and a deterministic prime test.
//!
//! A number a modulo p is kept as a 2^64 mod p (Montgomery 1985): then the product of two numbers,
//! a b 2^128 / 2^64, needs no division by p. [`Field::enter`] and [`Field::leave`] go to this form
//! and back; sums and differences are those of any residues.
//!
//! Called by `modular` and `poly_gcd`, and by `path`, which lifts solutions of linear systems
//! p-adically.

/// A prime p < 2^62 with what Montgomery's product needs; numbers are kept in Montgomery form.
#[derive(Debug, Clone)]
pub struct Field {
    p: u64,
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
            let product = p.wrapping_mul(inverse);
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(product));
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
        let mut sum = 0u128;

        for (&a_k, &b_k) in a.iter().zip(b) {
            sum += u128::from(a_k) * u128::from(b_k);
            if sum >= limit {
                sum -= limit;
            }
        }

        self.reduce(sum)
    }

    /// product / 2^64 mod p, for product < 2^64 p.
    #[inline]
    fn reduce(&self, product: u128) -> u64 {
        // product + m p is divisible by 2^64; as p < 2^62, it stays below 2^128.
        let m = (product as u64).wrapping_mul(self.negated_inverse);
        let sum = product + u128::from(m) * u128::from(self.p);
        let quotient = (sum >> 64) as u64;

        if quotient >= self.p {
            quotient - self.p
        } else {
            quotient
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

    /// a^-1 = a^(p-2) by Fermat, in Montgomery form.
    pub fn invert(&self, a: u64) -> u64 {
        let mut result = self.enter(1);
        let mut square = a; // a^(2^k)
        let mut exponent = self.p - 2;

        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.mul(result, square);
            }
            square = self.mul(square, square);
            exponent >>= 1;
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
    if n < 2 || BASES.iter().any(|&base| n.is_multiple_of(base)) {
        return BASES.contains(&n);
    }
    BASES.iter().all(|&base| is_strong_probable_prime(n, base))
}

/// With n - 1 = odd 2^twos: is base^odd = 1 or base^(odd 2^k) = -1 mod n for some k < twos?
fn is_strong_probable_prime(n: u64, base: u64) -> bool {
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;

    let mut x = power(base, odd, n);

    if x == 1 || x == n - 1 {
        return true;
    }

    for _ in 1..twos {
        x = (u128::from(x) * u128::from(x) % u128::from(n)) as u64;
        if x == n - 1 {
            return true;
        }
    }

    false
}

/// base^exponent mod n, by squaring.
fn power(base: u64, mut exponent: u64, n: u64) -> u64 {
    let modulus = u128::from(n);
    let mut result = 1u128;
    let mut square = u128::from(base); // base^(2^k)
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * square % modulus;
        }
        square = square * square % modulus;
        exponent >>= 1;
    }

    result as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prime_test_against_trial_division() {
        for n in 0..3000u64 {
            let has_divisor = (2..n).any(|d| n.is_multiple_of(d));
            assert_eq!(is_prime(n), n > 1 && !has_divisor, "{n}");
        }

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
            let product = field.leave(field.mul(field.enter(a), field.enter(b)));
            let expected = u128::from(a) * u128::from(b) % u128::from(p);
            assert_eq!(u128::from(product), expected);
        }

        let a = [p - 1; 20].map(|v| field.enter(v));
        let b = [p - 2; 20].map(|v| field.enter(v));
        assert_eq!(field.leave(field.dot(&a, &b)), 40); // 20 (-1)(-2)

        assert_eq!(field.add(p - 1, 3), 2);
        assert_eq!(field.sub(1, 3), p - 2);

        let a = field.enter(42);
        assert_eq!(field.leave(field.mul(a, field.invert(a))), 1);
    }

    #[test]
    fn a_field_knows_its_prime() {
        assert!(primes().take(3).all(|p| Field::new(p).prime() == p));
    }
}
