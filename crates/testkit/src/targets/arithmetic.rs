//! `exact` against the naive second implementation beside this file.

use super::naive::{self, List};
use mceip_exact::{
    Integer, Poly, Rational, Sign, determinant, from_f64, nonnegative_roots, parse, roots_in,
    to_f64, whole,
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

fn polynomials(data: &[u8]) {
    let (p, q) = two(data);
    let (lp, lq) = (list(&p), list(&q));
    assert_eq!(list(&(&p * &q)), naive::multiply(&lp, &lq));
    assert_eq!(list(&(&p + &q)), naive::add(&lp, &lq, 1));
    assert_eq!(list(&(&p - &q)), naive::add(&lp, &lq, -1));

    assert_eq!(
        naive::monic(&list(&p.gcd(&q))),
        naive::gcd(&lp, &lq),
        "gcd of {p:?} and {q:?}"
    );

    if let Some((quotient, rest)) = naive::divide(&lp, &lq) {
        let exact = p.exact_div(&q);

        // Division over Z succeeds only if it does over Q.
        assert!(
            exact.is_none() || (rest.is_empty() && list(exact.as_ref().unwrap_or(&p)) == quotient),
            "{p:?} / {q:?}"
        );
        assert_eq!((&p * &q).exact_div(&q), Some(p.clone()));

        // A pseudo-remainder is a nonzero multiple of the remainder.
        assert_eq!(
            naive::monic(&list(&p.pseudo_rem(&q))),
            naive::monic(&rest),
            "{p:?} mod {q:?}"
        );
    }
}

fn determinants(data: &[u8]) {
    let n = usize::from(data.first().copied().unwrap_or(0) % 4) + 1;
    let at = |k: usize| data.get(1 + k).copied().unwrap_or(0);

    let number = |k: usize| {
        Integer::from(at(k).cast_signed())
            * if at(k + 1) % 16 == 7 {
                Integer::from(1) << 70
            } else {
                Integer::from(1)
            }
    };

    let matrix = |o: usize| {
        (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| number(o + i * n + j))
                    .collect::<Vec<Integer>>()
            })
            .collect::<Vec<_>>()
    };

    let (a, b) = (matrix(0), matrix(n * n));
    let entry = |i: usize, j: usize| list(&Poly::new(vec![a[i][j].clone(), b[i][j].clone()]));
    let m: Vec<Vec<List>> = (0..n)
        .map(|i| (0..n).map(|j| entry(i, j)).collect())
        .collect();

    assert_eq!(
        list(&determinant(&a, &b)),
        naive::determinant(&m),
        "{a:?} + t {b:?}"
    );
}

fn roots(data: &[u8]) {
    let (p, g) = two(data);
    if p.is_zero() {
        return;
    }

    let (lo, width) = (
        i64::from(data.first().copied().unwrap_or(0)) - 128,
        i64::from(data.get(1).copied().unwrap_or(0)),
    );
    let (lo, hi) = (whole(lo) / whole(8), whole(lo + width) / whole(8));
    let found = roots_in(&p, &lo, Some(&hi));

    assert_eq!(
        found.len(),
        naive::count_roots(&list(&p), &lo, &hi),
        "{p:?} in [{lo}, {hi}]"
    );

    for (k, root) in found.iter().enumerate() {
        let (i, own) = (root.interval(), list(root.poly()));

        // Its own polynomial divides p and has this one root there; p may have others, divided out.
        assert!(
            naive::count_roots(&own, i.lo(), i.hi()) == 1,
            "root {k} of {p:?}"
        );
        assert!(
            naive::divide(&list(&p), &own).is_some_and(|(_, rest)| rest.is_empty()),
            "root {k} of {p:?}"
        );
    }

    for root in nonnegative_roots(&p) {
        let sign = root.clone().sign_of(&g);

        // By refinement alone: common root by the naive gcd, or a sign that stays.
        let common = naive::gcd(&list(&p), &list(&g));
        let mut near = root.clone();
        near.refine_to(&Rational::new(1.into(), Integer::from(1) << 300));

        let i = near.interval();
        let zero =
            g.is_zero() || (common.len() > 1 && naive::count_roots(&common, i.lo(), i.hi()) > 0);
        assert_eq!(sign == Sign::Zero, zero, "{g:?} at {root:?}");

        if !zero && naive::count_roots(&list(&g), i.lo(), i.hi()) == 0 {
            let value = naive::evaluate(&list(&g), &i.mid());
            assert_eq!(
                sign,
                if value.is_positive() {
                    Sign::Positive
                } else {
                    Sign::Negative
                }
            );
        }
    }
}

fn numbers(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        // Both readers take a plain decimal; where ours does, the standard library's nearest double
        // is ours.
        if let (Ok(exact), Ok(nearest)) = (parse(text), text.trim().parse::<f64>()) {
            let ours = to_f64(&exact);
            assert!(
                ours == nearest || (exact.is_zero() && nearest == 0.0),
                "{text:?}: {ours:e}, expected {nearest:e}"
            );
        }
    }

    for chunk in data.chunks_exact(8) {
        let Ok(bits) = <[u8; 8]>::try_from(chunk) else {
            continue;
        };

        let v = f64::from_bits(u64::from_le_bytes(bits));
        match from_f64(v) {
            Ok(exact) => {
                assert_eq!(to_f64(&exact), v);
                assert_eq!(parse(&format!("{v:e}")).map(|r| to_f64(&r)), Ok(v));
                assert_eq!(parse(&exact.to_string()), Ok(exact));
            }
            Err(_) => assert!(!v.is_finite()),
        }
    }
}

/// Two polynomials of degree at most 5; a byte of 7 modulo 16 makes a coefficient long.
fn two(data: &[u8]) -> (Poly, Poly) {
    let coefficient = |k: usize| {
        let byte = data.get(k).copied().unwrap_or(0);
        let long = if byte % 16 == 7 {
            Integer::from(1) << (usize::from(byte) / 2)
        } else {
            Integer::zero()
        };

        Integer::from(byte.cast_signed() / 8) + long
    };

    let make = |o: usize| Poly::new((o..o + 6).map(coefficient).collect());
    let (p, q) = (make(2), make(8));

    // Sometimes with a common factor.
    if data.first().is_some_and(|b| b % 3 == 0) {
        let common = Poly::new((14..17).map(coefficient).collect());
        return (&p * &common, &q * &common);
    }

    (p, q)
}

fn list(p: &Poly) -> List {
    p.coeffs()
        .iter()
        .map(|c| Rational::from_integer(c.clone()))
        .collect()
}
