//! Polynomials over Q in `dashu` rationals, least power first: nothing here is shared with `exact`.

use dashu_ratio::RBig;

pub type P = Vec<RBig>;

pub fn q(n: i64) -> RBig {
    RBig::from(n)
}

pub fn half() -> RBig {
    q(1) / q(2)
}

pub fn trim(mut p: P) -> P {
    while p.last().is_some_and(|c| *c == RBig::ZERO) {
        p.pop();
    }
    p
}

pub fn add(a: &[RBig], b: &[RBig]) -> P {
    let at = |p: &[RBig], i: usize| p.get(i).cloned().unwrap_or(RBig::ZERO);
    trim(
        (0..a.len().max(b.len()))
            .map(|i| at(a, i) + at(b, i))
            .collect(),
    )
}

pub fn scale(a: &[RBig], f: &RBig) -> P {
    trim(a.iter().map(|c| c * f).collect())
}

pub fn mul(a: &[RBig], b: &[RBig]) -> P {
    let mut out = vec![RBig::ZERO; (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    trim(out)
}

/// Quotient and remainder over Q.
pub fn divide(a: &[RBig], b: &[RBig]) -> (P, P) {
    let (mut rest, mut quotient) = (
        a.to_vec(),
        vec![RBig::ZERO; (a.len() + 1).saturating_sub(b.len())],
    );
    while rest.len() >= b.len() {
        let shift = rest.len() - b.len();
        let f = rest[rest.len() - 1].clone() / &b[b.len() - 1];
        for (i, c) in b.iter().enumerate() {
            rest[shift + i] -= &f * c;
        }
        quotient[shift] = f;
        rest.pop(); // its leading term is zero now
        rest = trim(rest);
    }
    (trim(quotient), trim(rest))
}

/// Monic greatest common divisor.
pub fn gcd(a: &[RBig], b: &[RBig]) -> P {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        (a, b) = (b.clone(), divide(&a, &b).1);
    }
    monic(&a)
}

pub fn monic(a: &[RBig]) -> P {
    a.last().map_or(Vec::new(), |lead| scale(a, &(q(1) / lead)))
}

pub fn derivative(a: &[RBig]) -> P {
    a.iter()
        .enumerate()
        .skip(1)
        .map(|(i, c)| c * q(i as i64))
        .collect()
}

pub fn squarefree(a: &[RBig]) -> P {
    monic(&divide(a, &gcd(a, &derivative(a))).0)
}

/// Value by summing powers.
pub fn eval(a: &[RBig], t: &RBig) -> RBig {
    let mut power = q(1);
    let mut sum = RBig::ZERO;
    for c in a {
        sum += c * &power;
        power *= t;
    }
    sum
}

/// p(u + v x) by repeated multiplication.
pub fn compose(p: &[RBig], u: &RBig, v: &RBig) -> P {
    let step = trim(vec![u.clone(), v.clone()]);
    let (mut power, mut sum) = (vec![q(1)], Vec::new());
    for c in p {
        sum = add(&sum, &scale(&power, c));
        power = mul(&power, &step);
    }
    sum
}

/// Upper bound of the number of roots in (0, 1), exact if 0 or 1: sign changes of
/// (1 + x)^n p(1 / (1 + x)) (Descartes 1637, Vincent 1836).
pub fn changes(p: &[RBig]) -> usize {
    let reversed: P = p.iter().rev().cloned().collect();
    let shifted = compose(&trim(reversed), &q(1), &q(1));
    let signs: Vec<bool> = shifted
        .iter()
        .filter(|c| **c != RBig::ZERO)
        .map(|c| *c > RBig::ZERO)
        .collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

/// Isolating intervals of the roots >= 0 of p, ascending: points, or open intervals with one root.
pub fn roots(p: &[RBig]) -> Vec<(RBig, RBig)> {
    let mut p = squarefree(p);
    let mut found = Vec::new();
    if p.len() > 1 && p[0] == RBig::ZERO {
        found.push((q(0), q(0)));
        p.remove(0);
    }
    // Lagrange's bound, a power of two above it.
    let magnitude = |c: &RBig| {
        if *c < RBig::ZERO {
            -c.clone()
        } else {
            c.clone()
        }
    };
    let sum = p.iter().fold(q(1), |s, c| s + magnitude(c));
    let mut bound = q(1);
    while bound <= sum {
        bound *= q(2);
    }
    bisect(&compose(&p, &q(0), &bound), &q(0), &bound, &mut found);
    found
}

/// Roots in (0, 1) of p, which stands for (from, from + width).
fn bisect(p: &[RBig], from: &RBig, width: &RBig, found: &mut Vec<(RBig, RBig)>) {
    match changes(p) {
        0 => {}
        1 => found.push((from.clone(), from + width)),
        _ => {
            let (middle, w) = (from + width * half(), width * half());
            bisect(&compose(p, &q(0), &half()), from, &w, found);
            let right = compose(p, &half(), &half());
            if right.first() == Some(&RBig::ZERO) || right.is_empty() {
                found.push((middle.clone(), middle.clone()));
            }
            bisect(&right, &middle, &w, found);
        }
    }
}
