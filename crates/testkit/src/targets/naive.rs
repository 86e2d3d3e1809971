//! A second implementation of the arithmetic, naive on purpose: polynomials over Q as lists of
//! coefficients, Euclid's algorithm with division, determinants by Leibniz' formula, Sturm's
//! theorem as in the textbook.
//!
//! It shares no code with `exact` but the type of a rational number. Called by `arithmetic`, which
//! compares the two.

use mceip_exact::{Rational, whole};
use num_traits::{One, Signed, Zero};

/// A polynomial over Q from the constant term up, without leading zeros.
pub(super) type List = Vec<Rational>;

/// The polynomial without its leading zeros.
fn trimmed(mut p: List) -> List {
    while p.last().is_some_and(Zero::is_zero) {
        p.pop();
    }
    p
}

/// p + factor q.
pub(super) fn add(p: &[Rational], q: &[Rational], factor: i64) -> List {
    let mut sum = p.to_vec();
    sum.resize(p.len().max(q.len()), Rational::zero());
    for (k, c) in q.iter().enumerate() {
        sum[k] += c * whole(factor);
    }

    trimmed(sum)
}

/// p q.
pub(super) fn multiply(p: &[Rational], q: &[Rational]) -> List {
    let mut out = vec![Rational::zero(); (p.len() + q.len()).saturating_sub(1)];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            out[i + j] += a * b;
        }
    }

    trimmed(out)
}

/// Quotient and remainder; `None` for division by zero.
pub(super) fn divide(p: &[Rational], q: &[Rational]) -> Option<(List, List)> {
    let lead = q.last()?;
    let mut rest = trimmed(p.to_vec());
    let mut quotient = vec![Rational::zero(); (rest.len() + 1).saturating_sub(q.len())];

    while rest.len() >= q.len() {
        let shift = rest.len() - q.len();
        let factor = rest.last()? / lead;
        for (k, c) in q.iter().enumerate() {
            rest[shift + k] -= c * &factor;
        }

        quotient[shift] = factor;
        rest = trimmed(rest);
    }

    Some((trimmed(quotient), rest))
}

/// The monic greatest common divisor; empty for two zeros.
pub(super) fn gcd(p: &[Rational], q: &[Rational]) -> List {
    let mut p = trimmed(p.to_vec());
    let mut q = trimmed(q.to_vec());
    while let Some((_, rest)) = divide(&p, &q) {
        p = q;
        q = rest;
    }

    monic(&p)
}

/// p over its leading coefficient; empty for zero.
pub(super) fn monic(p: &[Rational]) -> List {
    match p.last() {
        Some(lead) => p.iter().map(|c| c / lead).collect(),
        None => Vec::new(),
    }
}

/// p(t).
pub(super) fn evaluate(p: &[Rational], t: &Rational) -> Rational {
    let mut power = Rational::one();
    let mut sum = Rational::zero();

    for c in p {
        sum += c * &power;
        power *= t;
    }

    sum
}

/// p'.
fn derivative(p: &[Rational]) -> List {
    let mut out = Vec::new();
    for (k, c) in p.iter().enumerate().skip(1) {
        out.push(c * whole(k as i64));
    }

    trimmed(out)
}

/// Number of distinct real roots in [lo, hi], lo <= hi, by Sturm's theorem on (lo, hi] and a look
/// at lo.
pub(super) fn count_roots(p: &[Rational], lo: &Rational, hi: &Rational) -> usize {
    let Some((squarefree, _)) = divide(p, &gcd(p, &derivative(p))) else {
        return 0;
    };

    let mut chain = vec![squarefree.clone(), derivative(&squarefree)];
    while let Some((_, rest)) = divide(&chain[chain.len() - 2], &chain[chain.len() - 1]) {
        chain.push(rest.iter().map(|c| -c).collect());
    }

    let at_lo = usize::from(evaluate(&squarefree, lo).is_zero());
    let above_lo = sign_changes(&chain, lo).saturating_sub(sign_changes(&chain, hi));
    at_lo + above_lo
}

/// How often the sign changes along the chain at t, zeros left out.
fn sign_changes(chain: &[List], t: &Rational) -> usize {
    let signs: Vec<bool> = chain
        .iter()
        .map(|q| evaluate(q, t))
        .filter(|v| !v.is_zero())
        .map(|v| v.is_positive())
        .collect();

    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

/// The determinant of a matrix of polynomials by Leibniz' formula.
pub(super) fn determinant(m: &[Vec<List>]) -> List {
    let mut order: Vec<usize> = (0..m.len()).collect();
    let mut sum = Vec::new();
    add_permutations(m, &mut order, 0, 1, &mut sum);
    sum
}

/// Adds to `sum` the terms of Leibniz' formula whose permutations begin with the first `fixed`
/// places of `order`; `sign` is that of `order`.
fn add_permutations(
    m: &[Vec<List>],
    order: &mut Vec<usize>,
    fixed: usize,
    sign: i64,
    sum: &mut List,
) {
    if fixed == order.len() {
        let mut product = vec![Rational::one()];
        for (row, &column) in order.iter().enumerate() {
            product = multiply(&product, &m[row][column]);
        }

        *sum = add(sum, &product, sign);
        return;
    }

    for k in fixed..order.len() {
        let next_sign = if k == fixed { sign } else { -sign };
        order.swap(fixed, k);
        add_permutations(m, order, fixed + 1, next_sign, sum);
        order.swap(fixed, k);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(c: &[i64]) -> List {
        c.iter().map(|v| whole(*v)).collect()
    }

    #[test]
    fn the_naive_ones_are_right_where_a_hand_can_check() {
        // (t - 1)^2 (t + 2) = t^3 - 3t + 2
        let p = list(&[2, -3, 0, 1]);
        let square = multiply(&list(&[-1, 1]), &list(&[-1, 1]));

        assert_eq!(multiply(&square, &list(&[2, 1])), p);
        assert_eq!(gcd(&p, &list(&[-1, 0, 1])), list(&[-1, 1]));
        assert_eq!(count_roots(&p, &whole(-2), &whole(1)), 2);
        assert_eq!(count_roots(&p, &whole(-1), &whole(0)), 0);
        assert_eq!(count_roots(&p, &whole(1), &whole(1)), 1);

        // det [t, 2; 3, t] = t^2 - 6
        let m = vec![
            vec![list(&[0, 1]), list(&[2])],
            vec![list(&[3]), list(&[0, 1])],
        ];
        assert_eq!(determinant(&m), list(&[-6, 0, 1]));
        assert_eq!(divide(&p, &[]), None);
    }
}
