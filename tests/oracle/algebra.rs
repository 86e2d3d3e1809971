//! quickcheck on the algebra of `exact`: ring laws, gcd, Sturm counts, signs of algebraic numbers.

use mceip_exact::{
    Algebraic, Field, Integer, Interval, Poly, Quadratic, Rational, Sign, Sparse, from_f64,
    nonnegative_roots, parse, positive_definite, primes, roots_in, to_f64, whole,
};
use num_traits::{Signed, Zero};
use quickcheck::{TestResult, quickcheck};

fn poly(c: &[i8]) -> Poly {
    Poly::new(c.iter().take(6).map(|&v| Integer::from(v)).collect())
}

fn point(p: i16, q: u8) -> Rational {
    Rational::new(p.into(), (i64::from(q) + 1).into())
}

quickcheck! {
    fn prime_fields_are_fields(a: u64, b: u64, c: u64, k: u8) -> bool {
        let p = primes().nth(usize::from(k % 3)).unwrap_or(3);
        let f = Field::new(p);
        let [a, b, c] = [a, b, c].map(|v| f.enter(v % p));
        let (zero, one) = (f.enter(0), f.enter(1));
        let ring = f.mul(f.add(a, b), c) == f.add(f.mul(a, c), f.mul(b, c))
            && f.mul(f.mul(a, b), c) == f.mul(a, f.mul(b, c))
            && f.add(f.add(a, b), c) == f.add(a, f.add(b, c))
            && (f.mul(a, b), f.add(a, b)) == (f.mul(b, a), f.add(b, a))
            && (f.add(a, zero), f.mul(a, one), f.sub(a, a)) == (a, a, zero);
        let integer = |v: u64| Integer::from(f.leave(v));
        // And the field is that of the integers modulo p.
        let product = (integer(a) * integer(b)) % p == integer(f.mul(a, b));
        ring && product && (a == zero || f.mul(a, f.invert(a)) == one)
    }

    fn quadratic_numbers_are_an_ordered_ring(a: (i8, i8), b: (i8, i8), c: (i8, i8), d: u8) -> bool {
        let number = |(p, q): (i8, i8)| Quadratic::new(whole(p.into()), whole(q.into()), whole(i64::from(d % 12)));
        let (Some(a), Some(b), Some(c)) = (number(a), number(b), number(c)) else { return false };
        let minus = |x: &Quadratic| x.scale(&whole(-1));
        let equal = |x: &Quadratic, y: &Quadratic| x.add(&minus(y)).sign() == Sign::Zero;
        let sign = |x: &Quadratic| x.sign() as i8 - Sign::Zero as i8;
        equal(&a.add(&b).mul(&c), &a.mul(&c).add(&b.mul(&c)))
            && equal(&a.mul(&b).mul(&c), &a.mul(&b.mul(&c)))
            && equal(&a.mul(&b), &b.mul(&a))
            && sign(&a.mul(&b)) == sign(&a) * sign(&b)
            && sign(&minus(&a)) == -sign(&a)
            && (sign(&a) <= 0 || sign(&b) <= 0 || sign(&a.add(&b)) > 0)
    }

    fn sturm_counts_are_additive(a: Vec<i8>, lo: i8, first: u8, second: u8) -> TestResult {
        let p = poly(&a);
        let (lo, mid) = (whole(lo.into()), whole(i64::from(lo) + i64::from(first)));
        let hi = &mid + whole(i64::from(second));
        if p.is_zero() {
            return TestResult::discard();
        }
        let count = |from: &Rational, to: &Rational| roots_in(&p, from, Some(to)).len();
        let at_mid = usize::from(p.eval(&mid).is_zero());
        TestResult::from_bool(count(&lo, &hi) + at_mid == count(&lo, &mid) + count(&mid, &hi))
    }

    fn intervals_enclose_sums_products_and_quotients(a: (i8, u8), b: (i8, u8), k: u8, l: u8) -> bool {
        let make = |(lo, width): (i8, u8)| Interval::new(whole(lo.into()), whole(i64::from(lo) + i64::from(width)));
        let (Some(x), Some(y)) = (make(a), make(b)) else { return false };
        let at = |i: &Interval, k: u8| i.lo() + i.width() * Rational::new(k.into(), 255.into());
        let (u, v) = (at(&x, k), at(&y, l));
        let quotient = match x.div(&y) {
            Some(q) => q.contains(&(&u / &v)),
            None => y.contains(&whole(0)),
        };
        x.add(&y).contains(&(&u + &v)) && x.mul(&y).contains(&(&u * &v)) && quotient
    }

    fn polynomials_are_a_ring(a: Vec<i8>, b: Vec<i8>, c: Vec<i8>) -> bool {
        let (a, b, c) = (poly(&a), poly(&b), poly(&c));
        &(&a + &b) * &c == &(&a * &c) + &(&b * &c) && &a * &b == &b * &a && &(&a * &b) * &c == &a * &(&b * &c) && (&a - &a).is_zero()
    }

    fn evaluation_is_a_homomorphism(a: Vec<i8>, b: Vec<i8>, p: i16, q: u8) -> bool {
        let (a, b, t) = (poly(&a), poly(&b), point(p, q));
        (&a * &b).eval(&t) == a.eval(&t) * b.eval(&t) && (&a + &b).eval(&t) == a.eval(&t) + b.eval(&t)
    }

    fn gcd_divides_and_contains_common_factors(a: Vec<i8>, b: Vec<i8>, c: Vec<i8>) -> TestResult {
        let (a, b, c) = (poly(&a), poly(&b), poly(&c));
        if a.is_zero() || b.is_zero() || c.is_zero() {
            return TestResult::discard();
        }
        let g = (&a * &c).gcd(&(&b * &c));
        TestResult::from_bool((&a * &c).primitive().exact_div(&g).is_some() && g.exact_div(&c.primitive()).is_some())
    }

    fn pseudo_remainder_is_congruent(a: Vec<i8>, b: Vec<i8>) -> TestResult {
        let (a, b) = (poly(&a), poly(&b));
        if b.is_zero() {
            return TestResult::discard();
        }
        let r = a.pseudo_rem(&b);
        let small = r.degree().is_none_or(|d| Some(d) < b.degree());
        // lead^k a - r is a multiple of b for the power that was used.
        let lead = b.leading().abs();
        let mut scaled = a.clone();
        let divides = (0..8).any(|_| {
            let ok = (&scaled - &r).exact_div(&b).is_some();
            scaled = scaled.scale(&lead);
            ok
        });
        TestResult::from_bool(small && divides)
    }

    fn roots_are_isolated_and_counted(roots: Vec<i8>) -> bool {
        let distinct: std::collections::BTreeSet<i8> = roots.iter().take(6).copied().collect();
        let p = roots.iter().take(6).fold(Poly::from_ints(&[1, 0, 1]), |p, &r| &p * &Poly::from_ints(&[-i64::from(r), 1]));
        let found = roots_in(&p, &whole(-200), Some(&whole(200)));
        found.len() == distinct.len() && distinct.iter().zip(found).all(|(&r, mut f)| f.cmp_rational(&whole(i64::from(r))).is_eq())
    }

    fn signs_agree_with_refinement(a: Vec<i8>, g: Vec<i8>) -> TestResult {
        let (p, g) = (poly(&a), poly(&g));
        if p.degree().unwrap_or(0) == 0 {
            return TestResult::discard();
        }
        TestResult::from_bool(nonnegative_roots(&p).into_iter().all(|root| agrees(root, &g)))
    }

    fn products_vanish_at_roots(a: Vec<i8>, g: Vec<i8>) -> bool {
        let (p, g) = (poly(&a), poly(&g));
        nonnegative_roots(&p).into_iter().all(|mut root| root.sign_of(&(&p * &g)) == Sign::Zero)
    }

    fn order_of_roots_is_strict(a: Vec<i8>, b: Vec<i8>) -> bool {
        let mut roots = nonnegative_roots(&(&poly(&a) * &poly(&b)));
        (1..roots.len()).all(|k| {
            let (left, right) = roots.split_at_mut(k);
            left[k - 1].clone().cmp_exact(&mut right[0].clone()).is_lt()
        })
    }

    fn interval_horner_encloses(a: Vec<i8>, lo: i8, width: u8, k: u8) -> bool {
        let p = poly(&a);
        let (lo, width) = (whole(i64::from(lo)), whole(i64::from(width)));
        let t = &lo + &width * Rational::new(k.into(), 255.into());
        Interval::new(lo.clone(), &lo + &width).is_some_and(|i| i.horner(&p).contains(&p.eval(&t)))
    }

    fn doubles_survive(bits: u64) -> bool {
        let v = f64::from_bits(bits);
        !v.is_finite() || v == 0.0 || from_f64(v).is_ok_and(|r| to_f64(&r).to_bits() == bits)
    }

    fn nearest_double_is_nearest(p: i64, q: u32) -> bool {
        let r = Rational::new(p.into(), (i64::from(q) + 1).into());
        let got = to_f64(&r);
        let error = |v: f64| from_f64(v).map(|x| (x - &r).abs()).unwrap_or_else(|_| Rational::from_integer(Integer::from(1) << 2000));
        error(got) <= error(got.next_up()) && error(got) <= error(got.next_down())
    }

    fn spelling_is_read_back(p: i64, q: u32) -> bool {
        let r = Rational::new(p.into(), (i64::from(q) + 1).into());
        parse(&r.to_string()) == Ok(r)
    }

    fn gram_matrices_are_definite_and_their_negatives_are_not(g: Vec<i8>) -> bool {
        let n = 3;
        let at = |i: usize, j: usize| i64::from(g.get(i * n + j).copied().unwrap_or(0));
        let entry = |i: usize, j: usize| (0..n).map(|k| at(i, k) * at(j, k)).sum::<i64>() + i64::from(i == j);
        let m = |s: i64| Sparse::from_entries(n, n, (0..n * n).map(|k| (k / n, k % n, whole(s * entry(k / n, k % n)))));
        positive_definite(&m(1)).is_ok() && positive_definite(&m(-1)).is_err()
    }
}

/// The sign by brute refinement to 2^-400, where that is conclusive.
fn agrees(mut root: Algebraic, g: &Poly) -> bool {
    let sign = root.sign_of(g);
    root.refine_to(&Rational::new(1.into(), Integer::from(1) << 400));
    match root.interval().horner(g).certain_sign() {
        0 => sign == Sign::Zero || root.as_rational().is_some_and(|v| g.eval(v).is_zero()),
        s => sign == Sign::from(s),
    }
}
