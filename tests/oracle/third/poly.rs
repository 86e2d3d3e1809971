//! Polynomials over the rational numbers, least power first, and the isolation of their roots.
//!
//! The numbers are those of `dashu`, and nothing here is shared with `mceip_exact`. The roots are
//! isolated by Descartes' rule of signs, where `mceip_exact` counts with Sturm sequences.

use dashu_ratio::RBig;

/// Coefficients, least power first, without leading zeros: the zero polynomial is empty.
pub type Polynomial = Vec<RBig>;

/// Quotient and remainder: dividend = quotient * divisor + remainder.
pub struct Division {
    pub quotient: Polynomial,
    pub remainder: Polynomial,
}

/// A root: the point lo = hi, or the only root in the open interval (lo, hi).
pub struct Bracket {
    pub lo: RBig,
    pub hi: RBig,
}

impl Bracket {
    fn point(value: RBig) -> Bracket {
        Bracket {
            lo: value.clone(),
            hi: value,
        }
    }
}

pub fn integer(value: i64) -> RBig {
    RBig::from(value)
}

pub fn half() -> RBig {
    integer(1) / integer(2)
}

pub fn magnitude(value: &RBig) -> RBig {
    if *value < RBig::ZERO {
        -value.clone()
    } else {
        value.clone()
    }
}

/// Takes the leading zeros off.
pub fn trim(mut p: Polynomial) -> Polynomial {
    while p.last().is_some_and(|c| *c == RBig::ZERO) {
        p.pop();
    }
    p
}

fn coefficient(p: &[RBig], power: usize) -> RBig {
    p.get(power).cloned().unwrap_or(RBig::ZERO)
}

pub fn add(a: &[RBig], b: &[RBig]) -> Polynomial {
    let length = a.len().max(b.len());
    let mut sum = Polynomial::new();

    for power in 0..length {
        sum.push(coefficient(a, power) + coefficient(b, power));
    }
    trim(sum)
}

pub fn scale(a: &[RBig], factor: &RBig) -> Polynomial {
    trim(a.iter().map(|c| c * factor).collect())
}

pub fn negate(a: &[RBig]) -> Polynomial {
    scale(a, &integer(-1))
}

pub fn multiply(a: &[RBig], b: &[RBig]) -> Polynomial {
    let length = (a.len() + b.len()).saturating_sub(1);
    let mut product = vec![RBig::ZERO; length];

    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    trim(product)
}

/// Long division; the divisor is not zero.
pub fn divide(dividend: &[RBig], divisor: &[RBig]) -> Division {
    let quotient_length = (dividend.len() + 1).saturating_sub(divisor.len());
    let mut quotient = vec![RBig::ZERO; quotient_length];
    let mut remainder = dividend.to_vec();
    let divisor_lead = &divisor[divisor.len() - 1];

    while remainder.len() >= divisor.len() {
        let shift = remainder.len() - divisor.len();
        let factor = remainder[remainder.len() - 1].clone() / divisor_lead;

        for (power, c) in divisor.iter().enumerate() {
            remainder[shift + power] -= &factor * c;
        }
        quotient[shift] = factor;

        // The leading term is zero now.
        remainder.pop();
        remainder = trim(remainder);
    }

    Division {
        quotient: trim(quotient),
        remainder: trim(remainder),
    }
}

/// The monic greatest common divisor, by Euclid's algorithm.
pub fn gcd(a: &[RBig], b: &[RBig]) -> Polynomial {
    let mut larger = a.to_vec();
    let mut smaller = b.to_vec();

    while !smaller.is_empty() {
        let remainder = divide(&larger, &smaller).remainder;
        larger = smaller;
        smaller = remainder;
    }
    monic(&larger)
}

/// Divided by its leading coefficient; zero stays zero.
pub fn monic(a: &[RBig]) -> Polynomial {
    match a.last() {
        Some(lead) => scale(a, &(integer(1) / lead)),
        None => Polynomial::new(),
    }
}

pub fn derivative(a: &[RBig]) -> Polynomial {
    let mut result = Polynomial::new();
    for (power, c) in a.iter().enumerate().skip(1) {
        result.push(c * integer(power as i64));
    }
    result
}

/// The monic polynomial with the same roots, each of them simple.
pub fn squarefree(a: &[RBig]) -> Polynomial {
    let repeated = gcd(a, &derivative(a));
    monic(&divide(a, &repeated).quotient)
}

/// The value at t, as a sum of powers.
pub fn eval(a: &[RBig], t: &RBig) -> RBig {
    let mut power = integer(1);
    let mut sum = RBig::ZERO;

    for c in a {
        sum += c * &power;
        power *= t;
    }
    sum
}

/// p(offset + factor x) as a polynomial in x, by repeated multiplication.
pub fn compose(p: &[RBig], offset: &RBig, factor: &RBig) -> Polynomial {
    let linear = trim(vec![offset.clone(), factor.clone()]);
    let mut power = vec![integer(1)];
    let mut sum = Polynomial::new();

    for c in p {
        sum = add(&sum, &scale(&power, c));
        power = multiply(&power, &linear);
    }
    sum
}

/// Upper bound of the number of roots in (0, 1), exact if it is 0 or 1.
///
/// These are the sign changes of (1 + x)^n p(1 / (1 + x)) (Descartes 1637, Vincent 1836).
pub fn sign_changes(p: &[RBig]) -> usize {
    let reversed: Polynomial = p.iter().rev().cloned().collect();
    let shifted = compose(&trim(reversed), &integer(1), &integer(1));

    let mut is_positive = Vec::new();
    for c in &shifted {
        if *c != RBig::ZERO {
            is_positive.push(*c > RBig::ZERO);
        }
    }
    is_positive.windows(2).filter(|w| w[0] != w[1]).count()
}

/// A power of two above all roots: it is larger than Lagrange's bound of a monic polynomial.
fn bound_of_roots(monic: &[RBig]) -> RBig {
    let mut lagrange = integer(1);
    for c in monic {
        lagrange += magnitude(c);
    }

    let mut bound = integer(1);
    while bound <= lagrange {
        bound *= integer(2);
    }
    bound
}

/// The distinct roots >= 0 of p, ascending.
pub fn nonnegative_roots(p: &[RBig]) -> Vec<Bracket> {
    let mut p = squarefree(p);
    let mut found = Vec::new();

    let vanishes_at_zero = p.len() > 1 && p[0] == RBig::ZERO;
    if vanishes_at_zero {
        found.push(Bracket::point(integer(0)));
        p.remove(0);
    }

    let bound = bound_of_roots(&p);
    let on_unit_interval = compose(&p, &integer(0), &bound);
    bisect(&on_unit_interval, &integer(0), &bound, &mut found);
    found
}

/// Appends the roots of p in (0, 1), which stands for (from, from + width).
fn bisect(p: &[RBig], from: &RBig, width: &RBig, found: &mut Vec<Bracket>) {
    let changes = sign_changes(p);
    if changes == 0 {
        return;
    }

    if changes == 1 {
        found.push(Bracket {
            lo: from.clone(),
            hi: from + width,
        });
        return;
    }

    let half_width = width * half();
    let middle = from + &half_width;

    let left = compose(p, &integer(0), &half());
    bisect(&left, from, &half_width, found);

    let right = compose(p, &half(), &half());
    let vanishes_at_middle = right.first().is_none_or(|c| *c == RBig::ZERO);
    if vanishes_at_middle {
        found.push(Bracket::point(middle.clone()));
    }
    bisect(&right, &middle, &half_width, found);
}
