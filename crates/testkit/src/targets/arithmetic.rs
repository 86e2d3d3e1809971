//! `exact` against the naive second implementation beside this file.
//!
//! Input: bytes of a fuzzer, of which the first picks a part of `exact`. Both implementations
//! compute the same; a difference is a panic. Called by the fuzz target `exact_against_naive`.

use super::naive::{self, List};
use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, determinant, from_f64, nonnegative_roots, parse,
    roots_in, to_f64, whole,
};
use num_traits::{Signed, Zero};

/// Polynomials (ring, gcd, division), determinants, root counts, signs at roots, doubles and
/// decimals: each twice.
pub fn exact_against_naive(data: &[u8]) {
    let Some((&pick, rest)) = data.split_first() else {
        return;
    };

    match pick % 4 {
        0 => polynomials(rest),
        1 => determinants(rest),
        2 => roots(rest),
        _ => numbers(rest),
    }
}

/// Product, sum, difference, gcd and division of two polynomials.
fn polynomials(data: &[u8]) {
    let (p, q) = two_polynomials(data);
    let naive_p = list(&p);
    let naive_q = list(&q);

    assert_eq!(list(&(&p * &q)), naive::multiply(&naive_p, &naive_q));
    assert_eq!(list(&(&p + &q)), naive::add(&naive_p, &naive_q, 1));
    assert_eq!(list(&(&p - &q)), naive::add(&naive_p, &naive_q, -1));

    let gcd = naive::monic(&list(&p.gcd(&q)));
    assert_eq!(
        gcd,
        naive::gcd(&naive_p, &naive_q),
        "gcd of {p:?} and {q:?}"
    );

    let Some((quotient, rest)) = naive::divide(&naive_p, &naive_q) else {
        return;
    };

    // Division over Z succeeds only if it does over Q.
    if let Some(exact) = p.exact_div(&q) {
        assert!(rest.is_empty() && list(&exact) == quotient, "{p:?} / {q:?}");
    }
    assert_eq!((&p * &q).exact_div(&q), Some(p.clone()));

    // A pseudo-remainder is a nonzero multiple of the remainder.
    let pseudo_rest = naive::monic(&list(&p.pseudo_rem(&q)));
    assert_eq!(pseudo_rest, naive::monic(&rest), "{p:?} mod {q:?}");
}

/// det(A + tB) of integer matrices of order 1 to 4.
fn determinants(data: &[u8]) {
    let order = usize::from(data.first().copied().unwrap_or(0) % 4) + 1;
    let entries = data.get(1..).unwrap_or_default();
    let a = integer_matrix(entries, order, 0);
    let b = integer_matrix(entries, order, order * order);

    let mut pencil: Vec<Vec<List>> = Vec::new();
    for i in 0..order {
        let mut row = Vec::new();
        for j in 0..order {
            let entry = Poly::new(vec![a[i][j].clone(), b[i][j].clone()]);
            row.push(list(&entry));
        }
        pencil.push(row);
    }

    let given = [a, b];
    assert_eq!(
        list(&determinant(&given)),
        naive::determinant(&pencil),
        "{given:?}"
    );
}

/// The matrix of this order whose first entry is made of the byte at `offset`, row by row.
///
/// A byte is an entry from -128 to 127, times 2^70 if the byte after it is 7 modulo 16.
fn integer_matrix(data: &[u8], order: usize, offset: usize) -> Vec<Vec<Integer>> {
    let byte = |k: usize| data.get(k).copied().unwrap_or(0);
    let mut rows = Vec::new();

    for i in 0..order {
        let mut row = Vec::new();
        for j in 0..order {
            let k = offset + i * order + j;
            let shift = if byte(k + 1) % 16 == 7 { 70 } else { 0 };
            row.push(Integer::from(byte(k).cast_signed()) << shift);
        }
        rows.push(row);
    }

    rows
}

/// Roots of a polynomial p in an interval, and signs of another polynomial g at the roots of p.
fn roots(data: &[u8]) {
    let (p, g) = two_polynomials(data);
    if p.is_zero() {
        return;
    }

    let start = i64::from(data.first().copied().unwrap_or(0)) - 128;
    let width = i64::from(data.get(1).copied().unwrap_or(0));
    let lo = whole(start) / whole(8);
    let hi = whole(start + width) / whole(8);
    let found = roots_in(&p, &lo, Some(&hi));

    assert_eq!(
        found.len(),
        naive::count_roots(&list(&p), &lo, &hi),
        "{p:?} in [{lo}, {hi}]"
    );

    for (k, root) in found.iter().enumerate() {
        let interval = root.interval();
        let own = list(root.poly());

        // Its own polynomial divides p and has this one root there; p may have others, divided out.
        let roots_here = naive::count_roots(&own, interval.lo(), interval.hi());
        let division = naive::divide(&list(&p), &own);
        assert!(roots_here == 1, "root {k} of {p:?}");
        assert!(
            division.is_some_and(|(_, rest)| rest.is_empty()),
            "root {k} of {p:?}"
        );
    }

    for root in nonnegative_roots(&p) {
        sign_at(&g, &p, &root);
    }
}

/// The sign of g at a root of p, against refinement alone: a common root by the naive gcd, or a
/// sign that does not change in a short interval.
fn sign_at(g: &Poly, p: &Poly, root: &Algebraic) {
    let sign = root.clone().sign_of(g);

    let mut near = root.clone();
    near.refine_to(&Rational::new(1.into(), Integer::from(1) << 300));
    let interval = near.interval();

    let common = naive::gcd(&list(p), &list(g));
    let has_common_root =
        common.len() > 1 && naive::count_roots(&common, interval.lo(), interval.hi()) > 0;
    let is_zero = g.is_zero() || has_common_root;
    assert_eq!(sign == Sign::Zero, is_zero, "{g:?} at {root:?}");

    let has_one_sign = naive::count_roots(&list(g), interval.lo(), interval.hi()) == 0;
    if !is_zero && has_one_sign {
        let value = naive::evaluate(&list(g), &interval.mid());
        let expected = if value.is_positive() {
            Sign::Positive
        } else {
            Sign::Negative
        };
        assert_eq!(sign, expected);
    }
}

/// Decimals and doubles: read, written, rounded.
fn numbers(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        decimal(text);
    }

    for chunk in data.chunks_exact(8) {
        if let Ok(bytes) = <[u8; 8]>::try_from(chunk) {
            double(f64::from_bits(u64::from_le_bytes(bytes)));
        }
    }
}

/// Both readers take a plain decimal; where ours does, the standard library's nearest double is
/// ours.
fn decimal(text: &str) {
    let (Ok(exact), Ok(nearest)) = (parse(text), text.trim().parse::<f64>()) else {
        return;
    };

    let ours = to_f64(&exact);
    let is_zero = exact.is_zero() && nearest == 0.0;
    assert!(
        ours == nearest || is_zero,
        "{text:?}: {ours:e}, expected {nearest:e}"
    );
}

/// A finite double becomes a rational number and back, also by way of text.
fn double(v: f64) {
    match from_f64(v) {
        Ok(exact) => {
            assert_eq!(to_f64(&exact), v);
            assert_eq!(parse(&format!("{v:e}")).map(|r| to_f64(&r)), Ok(v));
            assert_eq!(parse(&exact.to_string()), Ok(exact));
        }
        Err(_) => assert!(!v.is_finite()),
    }
}

/// Two polynomials of degree at most 5, in one of three cases with a common factor of degree 2.
fn two_polynomials(data: &[u8]) -> (Poly, Poly) {
    let p = polynomial(data, 2..8);
    let q = polynomial(data, 8..14);

    let has_common_factor = data.first().is_some_and(|b| b % 3 == 0);
    if has_common_factor {
        let common = polynomial(data, 14..17);
        return (&p * &common, &q * &common);
    }

    (p, q)
}

/// The polynomial whose coefficients are made of these bytes, the constant term first.
fn polynomial(data: &[u8], bytes: std::ops::Range<usize>) -> Poly {
    let coefficients = bytes.map(|k| coefficient(data.get(k).copied().unwrap_or(0)));
    Poly::new(coefficients.collect())
}

/// An integer from -16 to 15; a byte of 7 modulo 16 makes it up to 123 bits long.
fn coefficient(byte: u8) -> Integer {
    let long = if byte % 16 == 7 {
        Integer::from(1) << (usize::from(byte) / 2)
    } else {
        Integer::zero()
    };
    Integer::from(byte.cast_signed() / 8) + long
}

/// The polynomial in the form of the naive implementation.
fn list(p: &Poly) -> List {
    p.coeffs()
        .iter()
        .map(|c| Rational::from_integer(c.clone()))
        .collect()
}
