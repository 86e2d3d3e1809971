//! A second implementation of the arithmetic, naive on purpose: polynomials over Q as lists of
//! coefficients, Euclid's algorithm with division, determinants by Leibniz' formula, Sturm's
//! theorem as in the textbook.

use mceip_exact::{Rational, whole};
use num_traits::{One, Signed, Zero};

/// A polynomial over Q from the constant term up, without leading zeros.
pub(super) type List = Vec<Rational>;

fn trimmed(mut p: List) -> List {
    while p.last().is_some_and(Zero::is_zero) {
        p.pop();
    }
    p
}

pub(super) fn add(p: &[Rational], q: &[Rational], factor: i64) -> List {
    let at = |l: &[Rational], k: usize| l.get(k).cloned().unwrap_or_default();
    trimmed(
        (0..p.len().max(q.len()))
            .map(|k| at(p, k) + at(q, k) * whole(factor))
            .collect(),
    )
}

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
    let (lead, mut rest) = (q.last()?, trimmed(p.to_vec()));
    let mut quotient = vec![Rational::zero(); (rest.len() + 1).saturating_sub(q.len())];

    while rest.len() >= q.len() {
        let shift = rest.len() - q.len();
        let factor = rest.last()? / lead;
        q.iter()
            .enumerate()
            .for_each(|(k, c)| rest[shift + k] -= c * &factor);
        quotient[shift] = factor;
        rest = trimmed(rest);
    }

    Some((trimmed(quotient), rest))
}

/// The monic greatest common divisor; empty for two zeros.
pub(super) fn gcd(p: &[Rational], q: &[Rational]) -> List {
    let (mut p, mut q) = (trimmed(p.to_vec()), trimmed(q.to_vec()));
    while let Some((_, rest)) = divide(&p, &q) {
        (p, q) = (q, rest);
    }

    monic(&p)
}

pub(super) fn monic(p: &[Rational]) -> List {
    p.last()
        .map_or_else(Vec::new, |lead| p.iter().map(|c| c / lead).collect())
}

pub(super) fn evaluate(p: &[Rational], t: &Rational) -> Rational {
    let mut power = Rational::one();
    let mut sum = Rational::zero();

    for c in p {
        sum += c * &power;
        power *= t;
    }

    sum
}

fn derivative(p: &[Rational]) -> List {
    trimmed(
        p.iter()
            .enumerate()
            .skip(1)
            .map(|(k, c)| c * whole(k as i64))
            .collect(),
    )
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

    let changes = |t: &Rational| {
        let signs: Vec<bool> = chain
            .iter()
            .map(|q| evaluate(q, t))
            .filter(|v| !v.is_zero())
            .map(|v| v.is_positive())
            .collect();

        signs.windows(2).filter(|w| w[0] != w[1]).count()
    };

    usize::from(evaluate(&squarefree, lo).is_zero()) + changes(lo).saturating_sub(changes(hi))
}

/// The determinant of a matrix of polynomials by Leibniz' formula.
pub(super) fn determinant(m: &[Vec<List>]) -> List {
    let n = m.len();
    let mut order: Vec<usize> = (0..n).collect();
    let mut sum = Vec::new();

    permutations(&mut order, 0, 1, &mut |order, sign| {
        let product = order
            .iter()
            .enumerate()
            .fold(vec![Rational::one()], |p, (i, &j)| multiply(&p, &m[i][j]));
        sum = add(&sum, &product, sign);
    });

    sum
}

fn permutations(
    order: &mut Vec<usize>,
    from: usize,
    sign: i64,
    see: &mut dyn FnMut(&[usize], i64),
) {
    if from == order.len() {
        return see(order, sign);
    }

    for k in from..order.len() {
        order.swap(from, k);
        permutations(order, from + 1, if k == from { sign } else { -sign }, see);
        order.swap(from, k);
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
        assert_eq!(
            multiply(&multiply(&list(&[-1, 1]), &list(&[-1, 1])), &list(&[2, 1])),
            p
        );
        assert_eq!(gcd(&p, &list(&[-1, 0, 1])), list(&[-1, 1]));
        assert_eq!(count_roots(&p, &whole(-2), &whole(1)), 2);
        assert_eq!(count_roots(&p, &whole(-1), &whole(0)), 0);
        assert_eq!(count_roots(&p, &whole(1), &whole(1)), 1);

        let m = [[list(&[0, 1]), list(&[2])], [list(&[3]), list(&[0, 1])]].map(|r| r.to_vec());
        assert_eq!(determinant(&m), list(&[-6, 0, 1]));
        assert_eq!(divide(&p, &[]), None);
    }
}
