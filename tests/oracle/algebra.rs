//! Random tests (quickcheck) of the arithmetic in `mceip_exact`.
//!
//! The truth is algebra itself: the laws of rings and fields, what a greatest common divisor is,
//! that the roots counted on two neighbouring intervals add up, that an interval encloses the value
//! it stands for. No expected number is written down, so a fault shows as soon as two routes to
//! the same number differ.

use mceip_exact::{
    Algebraic, Field, Integer, Interval, Poly, Quadratic, Rational, Sign, Sparse, from_f64,
    nonnegative_roots, parse, positive_definite, primes, roots_in, to_f64, whole,
};
use num_traits::{Signed, Zero};
use quickcheck::{TestResult, quickcheck};
use std::collections::BTreeSet;

/// The polynomial with the first six of these coefficients, least power first.
fn polynomial(coefficients: &[i8]) -> Poly {
    let first_six = coefficients.iter().take(6);
    Poly::new(first_six.map(|&c| Integer::from(c)).collect())
}

/// A rational number with the denominator `below + 1`, which is never zero.
fn fraction(numerator: i64, below: u32) -> Rational {
    let denominator = i64::from(below) + 1;
    Rational::new(numerator.into(), denominator.into())
}

/// The interval with this lower end and width.
fn interval((lower, width): (i8, u8)) -> Option<Interval> {
    let lo = whole(lower.into());
    let hi = whole(i64::from(lower) + i64::from(width));
    Interval::new(lo, hi)
}

/// The point that divides the interval as `step` divides 255.
fn point_of(interval: &Interval, step: u8) -> Rational {
    let part = Rational::new(step.into(), 255.into());
    interval.lo() + interval.width() * part
}

/// p + q sqrt(radicand).
fn quadratic((p, q): (i8, i8), radicand: i64) -> Option<Quadratic> {
    Quadratic::new(whole(p.into()), whole(q.into()), whole(radicand))
}

/// The sign as -1, 0 or 1.
fn sign_number(number: &Quadratic) -> i8 {
    number.sign() as i8 - Sign::Zero as i8
}

fn negated(number: &Quadratic) -> Quadratic {
    number.scale(&whole(-1))
}

fn are_equal(left: &Quadratic, right: &Quadratic) -> bool {
    left.add(&negated(right)).sign() == Sign::Zero
}

/// The ring laws for three quadratic numbers of one field.
fn ring_laws_hold(a: &Quadratic, b: &Quadratic, c: &Quadratic) -> bool {
    let sum_first = a.add(b).mul(c);
    let products_first = a.mul(c).add(&b.mul(c));
    let distributive = are_equal(&sum_first, &products_first);

    let left_first = a.mul(b).mul(c);
    let right_first = a.mul(&b.mul(c));
    let associative = are_equal(&left_first, &right_first);

    let commutative = are_equal(&a.mul(b), &b.mul(a));

    distributive && associative && commutative
}

/// The sign is multiplicative and odd, and the sum of positive numbers is positive.
fn order_laws_hold(a: &Quadratic, b: &Quadratic) -> bool {
    let sign_of_a = sign_number(a);
    let sign_of_b = sign_number(b);

    let multiplicative = sign_number(&a.mul(b)) == sign_of_a * sign_of_b;
    let odd = sign_number(&negated(a)) == -sign_of_a;

    let both_positive = sign_of_a > 0 && sign_of_b > 0;
    let sum_is_positive = sign_number(&a.add(b)) > 0;

    multiplicative && odd && (!both_positive || sum_is_positive)
}

/// The integer that an element of the field stands for.
fn integer_of(field: &Field, element: u64) -> Integer {
    Integer::from(field.leave(element))
}

/// The ring laws for three elements of a prime field, and what zero and one are.
fn is_commutative_ring(field: &Field, [a, b, c]: [u64; 3]) -> bool {
    let zero = field.enter(0);
    let one = field.enter(1);

    let sum_first = field.mul(field.add(a, b), c);
    let products_first = field.add(field.mul(a, c), field.mul(b, c));
    let distributive = sum_first == products_first;

    let product_left = field.mul(field.mul(a, b), c);
    let product_right = field.mul(a, field.mul(b, c));
    let sum_left = field.add(field.add(a, b), c);
    let sum_right = field.add(a, field.add(b, c));
    let associative = product_left == product_right && sum_left == sum_right;

    let product_commutes = field.mul(a, b) == field.mul(b, a);
    let sum_commutes = field.add(a, b) == field.add(b, a);
    let commutative = product_commutes && sum_commutes;

    let zero_is_neutral = field.add(a, zero) == a;
    let one_is_neutral = field.mul(a, one) == a;
    let difference_is_zero = field.sub(a, a) == zero;
    let neutral = zero_is_neutral && one_is_neutral && difference_is_zero;

    distributive && associative && commutative && neutral
}

/// Is the sign of g at the root the one that brute refinement to a width of 2^-400 leads to?
fn sign_agrees_with_refinement(mut root: Algebraic, g: &Poly) -> bool {
    let sign = root.sign_of(g);

    let width = Rational::new(1.into(), Integer::from(1) << 400);
    root.refine_to(&width);
    let enclosure = root.interval().horner(g);

    // The coefficients have eight bits: a value this close to zero is zero.
    sign == Sign::from(enclosure.certain_sign())
}

/// Does a power of the leading coefficient of `divisor`, below the eighth, make
/// power * dividend - remainder a multiple of `divisor`?
fn is_congruent_up_to_a_power(dividend: &Poly, divisor: &Poly, remainder: &Poly) -> bool {
    let lead = divisor.leading().abs();
    let mut scaled = dividend.clone();

    for _ in 0..8 {
        let difference = &scaled - remainder;
        if difference.exact_div(divisor).is_some() {
            return true;
        }
        scaled = scaled.scale(&lead);
    }
    false
}

/// |value - exact|, or 2^2000 for a value that is not finite.
fn error_of_double(value: f64, exact: &Rational) -> Rational {
    match from_f64(value) {
        Ok(value) => (value - exact).abs(),
        Err(_) => Rational::from_integer(Integer::from(1) << 2000),
    }
}

/// G G' + I, where G has these entries row by row, and zeros where they end.
fn gram_plus_identity(entries: &[i8], order: usize) -> Vec<Vec<i64>> {
    let mut g = vec![vec![0; order]; order];
    for (k, &entry) in entries.iter().take(order * order).enumerate() {
        g[k / order][k % order] = i64::from(entry);
    }

    let mut gram = vec![vec![0; order]; order];

    for i in 0..order {
        for j in 0..order {
            for k in 0..order {
                gram[i][j] += g[i][k] * g[j][k];
            }
        }
        gram[i][i] += 1;
    }
    gram
}

/// `factor` times a matrix of integers.
fn scaled_matrix(matrix: &[Vec<i64>], factor: i64) -> Sparse {
    let order = matrix.len();
    let mut entries = Vec::new();

    for (i, row) in matrix.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            entries.push((i, j, whole(factor * value)));
        }
    }
    Sparse::from_entries(order, order, entries)
}

quickcheck! {
    fn prime_fields_are_fields(a: u64, b: u64, c: u64, k: u8) -> bool {
        let p = primes().nth(usize::from(k % 3)).unwrap_or(3);
        let field = Field::new(p);
        let [a, b, c] = [a, b, c].map(|v| field.enter(v % p));

        let ring = is_commutative_ring(&field, [a, b, c]);

        let zero = field.enter(0);
        let one = field.enter(1);
        let invertible = a == zero || field.mul(a, field.invert(a)) == one;

        // The product is the one of the integers modulo p.
        let product_of_integers = integer_of(&field, a) * integer_of(&field, b);
        let product = product_of_integers % p == integer_of(&field, field.mul(a, b));

        ring && product && invertible
    }

    fn quadratic_numbers_are_an_ordered_ring(
        a: (i8, i8), b: (i8, i8), c: (i8, i8), d: u8
    ) -> bool {
        let radicand = i64::from(d % 12);
        let (Some(a), Some(b)) = (quadratic(a, radicand), quadratic(b, radicand)) else {
            return false;
        };
        let Some(c) = quadratic(c, radicand) else {
            return false;
        };

        ring_laws_hold(&a, &b, &c) && order_laws_hold(&a, &b)
    }

    fn sturm_counts_are_additive(a: Vec<i8>, lo: i8, first: u8, second: u8) -> TestResult {
        let p = polynomial(&a);
        if p.is_zero() {
            return TestResult::discard();
        }

        let lower = whole(lo.into());
        let middle = whole(i64::from(lo) + i64::from(first));
        let upper = &middle + whole(i64::from(second));

        let on_both = roots_in(&p, &lower, Some(&upper)).len();
        let on_left = roots_in(&p, &lower, Some(&middle)).len();
        let on_right = roots_in(&p, &middle, Some(&upper)).len();

        // The closed halves share the middle, so a root there is counted twice.
        let at_middle = usize::from(p.eval(&middle).is_zero());
        TestResult::from_bool(on_both + at_middle == on_left + on_right)
    }

    fn intervals_enclose_sums_products_and_quotients(
        a: (i8, u8), b: (i8, u8), k: u8, l: u8
    ) -> bool {
        let (Some(x), Some(y)) = (interval(a), interval(b)) else {
            return false;
        };
        let u = point_of(&x, k);
        let v = point_of(&y, l);

        let sum_encloses = x.add(&y).contains(&(&u + &v));
        let product_encloses = x.mul(&y).contains(&(&u * &v));
        let quotient_encloses = match x.div(&y) {
            Some(quotient) => quotient.contains(&(&u / &v)),
            None => y.contains(&whole(0)),
        };

        sum_encloses && product_encloses && quotient_encloses
    }

    fn polynomials_are_a_ring(a: Vec<i8>, b: Vec<i8>, c: Vec<i8>) -> bool {
        let a = polynomial(&a);
        let b = polynomial(&b);
        let c = polynomial(&c);

        let sum_first = &(&a + &b) * &c;
        let products_first = &(&a * &c) + &(&b * &c);
        let distributive = sum_first == products_first;

        let commutative = &a * &b == &b * &a;

        let left_first = &(&a * &b) * &c;
        let right_first = &a * &(&b * &c);
        let associative = left_first == right_first;

        let difference_is_zero = (&a - &a).is_zero();

        distributive && commutative && associative && difference_is_zero
    }

    fn evaluation_is_a_homomorphism(a: Vec<i8>, b: Vec<i8>, p: i16, q: u8) -> bool {
        let a = polynomial(&a);
        let b = polynomial(&b);
        let t = fraction(p.into(), q.into());

        let value_of_product = (&a * &b).eval(&t);
        let product_of_values = a.eval(&t) * b.eval(&t);

        let value_of_sum = (&a + &b).eval(&t);
        let sum_of_values = a.eval(&t) + b.eval(&t);

        value_of_product == product_of_values && value_of_sum == sum_of_values
    }

    fn gcd_divides_and_contains_common_factors(a: Vec<i8>, b: Vec<i8>, c: Vec<i8>) -> TestResult {
        let a = polynomial(&a);
        let b = polynomial(&b);
        let common_factor = polynomial(&c);
        if a.is_zero() || b.is_zero() || common_factor.is_zero() {
            return TestResult::discard();
        }

        let left = &a * &common_factor;
        let right = &b * &common_factor;
        let gcd = left.gcd(&right);

        let divides_left = left.primitive().exact_div(&gcd).is_some();
        let divides_right = right.primitive().exact_div(&gcd).is_some();
        let contains_factor = gcd.exact_div(&common_factor.primitive()).is_some();
        TestResult::from_bool(divides_left && divides_right && contains_factor)
    }

    fn pseudo_remainder_is_congruent(a: Vec<i8>, b: Vec<i8>) -> TestResult {
        let dividend = polynomial(&a);
        let divisor = polynomial(&b);
        if divisor.is_zero() {
            return TestResult::discard();
        }

        let remainder = dividend.pseudo_rem(&divisor);

        let is_small = remainder.degree().is_none_or(|d| Some(d) < divisor.degree());
        let is_congruent = is_congruent_up_to_a_power(&dividend, &divisor, &remainder);
        TestResult::from_bool(is_small && is_congruent)
    }

    fn roots_are_isolated_and_counted(roots: Vec<i8>) -> bool {
        // The factor t^2 + 1 has no real root.
        let mut p = Poly::from_ints(&[1, 0, 1]);
        let mut distinct = BTreeSet::new();
        for &root in roots.iter().take(6) {
            p = &p * &Poly::from_ints(&[-i64::from(root), 1]);
            distinct.insert(root);
        }

        let found = roots_in(&p, &whole(-200), Some(&whole(200)));

        let same_number = found.len() == distinct.len();
        let mut pairs = distinct.iter().zip(found);
        same_number && pairs.all(|(&r, mut f)| f.cmp_rational(&whole(i64::from(r))).is_eq())
    }

    fn signs_agree_with_refinement(a: Vec<i8>, g: Vec<i8>) -> TestResult {
        let p = polynomial(&a);
        let g = polynomial(&g);
        if p.degree().unwrap_or(0) == 0 {
            return TestResult::discard();
        }

        let mut roots = nonnegative_roots(&p).into_iter();
        TestResult::from_bool(roots.all(|root| sign_agrees_with_refinement(root, &g)))
    }

    fn products_vanish_at_roots(a: Vec<i8>, g: Vec<i8>) -> bool {
        let p = polynomial(&a);
        let product = &p * &polynomial(&g);

        let mut roots = nonnegative_roots(&p).into_iter();
        roots.all(|mut root| root.sign_of(&product) == Sign::Zero)
    }

    fn order_of_roots_is_strict(a: Vec<i8>, b: Vec<i8>) -> bool {
        let product = &polynomial(&a) * &polynomial(&b);
        let roots = nonnegative_roots(&product);

        roots.windows(2).all(|pair| {
            let mut lower = pair[0].clone();
            let mut upper = pair[1].clone();
            lower.cmp_exact(&mut upper).is_lt()
        })
    }

    fn interval_horner_encloses(a: Vec<i8>, lo: i8, width: u8, k: u8) -> bool {
        let p = polynomial(&a);
        let Some(interval) = interval((lo, width)) else {
            return false;
        };
        let t = point_of(&interval, k);

        interval.horner(&p).contains(&p.eval(&t))
    }

    fn doubles_survive(bits: u64) -> bool {
        let v = f64::from_bits(bits);
        if !v.is_finite() || v == 0.0 {
            return true;
        }
        from_f64(v).is_ok_and(|r| to_f64(&r).to_bits() == bits)
    }

    fn nearest_double_is_nearest(p: i64, q: u32) -> bool {
        let exact = fraction(p, q);
        let rounded = to_f64(&exact);

        let error = error_of_double(rounded, &exact);
        let error_above = error_of_double(rounded.next_up(), &exact);
        let error_below = error_of_double(rounded.next_down(), &exact);

        error <= error_above && error <= error_below
    }

    fn spelling_is_read_back(p: i64, q: u32) -> bool {
        let number = fraction(p, q);
        parse(&number.to_string()) == Ok(number)
    }

    fn gram_matrices_are_definite_and_their_negatives_are_not(g: Vec<i8>) -> bool {
        let gram = gram_plus_identity(&g, 3);

        let positive = scaled_matrix(&gram, 1);
        let negative = scaled_matrix(&gram, -1);

        positive_definite(&positive).is_ok() && positive_definite(&negative).is_err()
    }
}
