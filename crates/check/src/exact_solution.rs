//! Exact solutions: alpha is a root isolated by [a, b], x a vector of polynomials in alpha.
//!
//! Obligations, in this order: index sets; [a, b] within the window and isolating one root of p;
//! x = 0 off the support, x > 0 on it; (A + tB) x = 0 mod p on active rows; y > 0 or y = 0 mod p
//! elsewhere, with the biactive set exactly the latter. "0 mod p" is a remainder, "> 0" is
//! interval Horner of the remainder on [a, b].

use super::AcceptedClaim;
use super::pencil::{Row, Rows};
use super::reason::Reason;
use crate::certificate::ExactSolution;
use mceip_exact::{Integer, Interval, Poly, Rational, common_denominator};
use mceip_model::Window;
use mceip_model::file::Number;
use num_integer::Integer as _;
use num_traits::{One, Zero};

/// Largest number of coefficients of p and of each x_i. A support of n variables needs at most n +
/// 1.
const MAX_COEFFICIENTS: u64 = 512;
/// Largest product of the number of coefficients (of p and of the longest x_i) and the bits of the
/// longest number of the claim: bounds the work on a file that is small but hostile.
const MAX_SIZE: u64 = 1 << 21;
/// Largest product of the number of polynomials and the square of that size: Horner's rule is asked
/// for each row.
const MAX_WORK: u64 = 1 << 46;
/// By how many coefficients x may exceed p for numbers of any length (y = (A + tB) x has one more
/// than x), and the largest product of a larger excess with the bits of the longest number: every
/// coefficient in excess makes a remainder longer by the leading coefficient of p.
const FREE_EXCESS: u64 = 1;
const MAX_EXCESS_SIZE: u64 = 1 << 13;

pub(super) fn check(
    rows: &Rows,
    window: &Window,
    claim: &ExactSolution,
) -> Result<AcceptedClaim, Reason> {
    index_set(rows, "support", &claim.support)?;
    index_set(rows, "biactive", &claim.biactive)?;
    bounded(&claim.polynomial, &claim.interval, &claim.x)?;
    let p = Poly::new(claim.polynomial.clone()).primitive();
    let value = isolate(&p, &claim.interval)?;
    within(window, &value)?;
    if claim.x.len() != rows.order() {
        return Err(Reason::Length {
            what: "x",
            expected: rows.order(),
            got: claim.x.len(),
        });
    }
    let alpha = Alpha { p, value };
    let x = coefficients(&claim.x, &alpha.p);
    check_x(rows, claim, &alpha, &x)?;
    check_y(rows, claim, &alpha, &x)?;
    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value: alpha.value,
    })
}

/// The claim is small enough to be multiplied out.
pub(super) fn bounded<'a>(
    polynomial: &[Integer],
    interval: &'a [Number; 2],
    x: impl IntoIterator<Item = &'a Vec<Number>> + Clone,
) -> Result<(), Reason> {
    let at_most = |what, limit, got| {
        if got > limit {
            Err(Reason::TooLarge { what, limit, got })
        } else {
            Ok(())
        }
    };
    let coefficients = polynomial.len() as u64;
    at_most(
        "coefficients of the polynomial",
        MAX_COEFFICIENTS,
        coefficients,
    )?;

    let polynomials = x.clone().into_iter().count() as u64;
    let longest_x = x.clone().into_iter().map(Vec::len).max().unwrap_or(0) as u64;
    at_most("coefficients of x", MAX_COEFFICIENTS, longest_x)?;

    let of = |n: &Number| n.0.numer().bits() + n.0.denom().bits();
    let numbers = interval.iter().chain(x.into_iter().flatten()).map(of);
    let bits = numbers
        .chain(polynomial.iter().map(|c| c.bits()))
        .max()
        .unwrap_or(0);
    let size = bits.saturating_mul(coefficients + longest_x);
    at_most("size (coefficients times bits)", MAX_SIZE, size)?;

    let work = size.saturating_mul(size).saturating_mul(polynomials);
    at_most(
        "work (polynomials times the square of coefficients times bits)",
        MAX_WORK,
        work,
    )?;

    let excess = longest_x.saturating_sub(coefficients);
    if excess <= FREE_EXCESS {
        return Ok(());
    }
    let what = "excess (coefficients of x beyond those of the polynomial, times bits)";
    at_most(what, MAX_EXCESS_SIZE, bits.saturating_mul(excess))
}

/// Ascending indices of complementarity variables.
pub(super) fn index_set(rows: &Rows, set: &'static str, list: &[usize]) -> Result<(), Reason> {
    let bad = |k: usize| {
        list[k] >= rows.order() || rows.is_free[list[k]] || (k > 0 && list[k - 1] >= list[k])
    };
    match (0..list.len()).find(|&k| bad(k)) {
        Some(position) => Err(Reason::IndexSet {
            set,
            position,
            got: list[position],
        }),
        None => Ok(()),
    }
}

/// [a, b] contains exactly one root of p.
pub(super) fn isolate(p: &Poly, [a, b]: &[Number; 2]) -> Result<Interval, Reason> {
    if p.degree().unwrap_or(0) == 0 {
        return Err(Reason::ConstantPolynomial {
            coefficients: p.coeffs().len(),
        });
    }
    let Some(value) = Interval::new(a.0.clone(), b.0.clone()) else {
        return Err(Reason::ReversedInterval {
            a: a.0.clone(),
            b: b.0.clone(),
        });
    };
    let (at_a, at_b) = (p.sign_at(&a.0), p.sign_at(&b.0));
    if value.is_point() {
        return if at_a == 0 {
            Ok(value)
        } else {
            Err(Reason::NotARoot {
                a: a.0.clone(),
                sign: at_a,
            })
        };
    }
    if at_a * at_b != -1 {
        return Err(Reason::NoSignChange { at_a, at_b });
    }
    let slope = value.horner_rounded(&p.derivative());
    if slope.certain_sign() == 0 {
        return Err(Reason::NotIsolated {
            lo: slope.lo().clone(),
            hi: slope.hi().clone(),
        });
    }
    Ok(value)
}

/// [a, b] lies in the closed window.
pub(super) fn within(window: &Window, value: &Interval) -> Result<(), Reason> {
    if value.lo() >= window.min() && window.max().is_none_or(|max| value.hi() <= max) {
        return Ok(());
    }
    let max = window
        .max()
        .map_or_else(|| "infinity".into(), ToString::to_string);
    Err(Reason::OutsideWindow {
        min: window.min().clone(),
        max,
        a: value.lo().clone(),
        b: value.hi().clone(),
    })
}

/// The value: a root of p in an interval.
pub(super) struct Alpha {
    pub(super) p: Poly,
    pub(super) value: Interval,
}

impl Alpha {
    /// A positive multiple of g mod p: zero exactly if p divides g over Q.
    pub(super) fn remainder(&self, g: &[Rational]) -> Poly {
        Poly::from_rationals(g).pseudo_rem(&self.p)
    }

    pub(super) fn enclose(&self, g: &[Rational]) -> Interval {
        self.value.horner_rounded(&self.remainder(g))
    }
}

fn check_x(
    rows: &Rows,
    claim: &ExactSolution,
    alpha: &Alpha,
    x: &[Vec<Rational>],
) -> Result<(), Reason> {
    let mut non_zero = !claim.support.is_empty();
    for (index, x) in x.iter().enumerate() {
        if rows.is_free[index] {
            non_zero |= alpha.enclose(x).certain_sign() != 0;
        } else if claim.support.binary_search(&index).is_err() {
            if !alpha.remainder(x).is_zero() {
                return Err(Reason::XOffSupport { index });
            }
        } else {
            let image = alpha.enclose(x);
            if image.certain_sign() != 1 {
                return Err(Reason::XNotPositive {
                    index,
                    lo: image.lo().clone(),
                    hi: image.hi().clone(),
                });
            }
        }
    }
    if non_zero { Ok(()) } else { Err(Reason::XZero) }
}

fn check_y(
    rows: &Rows,
    claim: &ExactSolution,
    alpha: &Alpha,
    x: &[Vec<Rational>],
) -> Result<(), Reason> {
    for (index, row) in rows.rows.iter().enumerate() {
        let y = alpha.remainder(&times(row, x));
        let is_zero = y.is_zero();
        if rows.is_free[index] || claim.support.binary_search(&index).is_ok() {
            if !is_zero {
                let equation = if rows.is_free[index] { "E13" } else { "E25" };
                return Err(Reason::YNotZero { equation, index });
            }
            if claim.biactive.binary_search(&index).is_ok() {
                return Err(Reason::Biactive {
                    index,
                    expected: false,
                });
            }
            continue;
        }
        if claim.biactive.binary_search(&index).is_ok() != is_zero {
            return Err(Reason::Biactive {
                index,
                expected: is_zero,
            });
        }
        let image = alpha.value.horner_rounded(&y);
        if !is_zero && image.certain_sign() != 1 {
            return Err(Reason::YNotPositive {
                index,
                lo: image.lo().clone(),
                hi: image.hi().clone(),
            });
        }
    }
    Ok(())
}

/// The polynomials of a list. Where one is much longer than p, all of them modulo p, times one
/// positive number: many rows then do not divide it once each.
pub(super) fn coefficients<'a>(
    list: impl IntoIterator<Item = &'a Vec<Number>> + Clone,
    p: &Poly,
) -> Vec<Vec<Rational>> {
    let plain = |g: &Vec<Number>| g.iter().map(|n| n.0.clone()).collect::<Vec<Rational>>();
    let coefficients = p.coeffs().len();
    let longest = list.clone().into_iter().map(Vec::len).max().unwrap_or(0);

    if longest <= coefficients + FREE_EXCESS as usize {
        return list.into_iter().map(plain).collect();
    }
    let steps = longest + 1 - coefficients;
    list.into_iter()
        .map(|g| reduced(&plain(g), p, steps))
        .collect()
}

/// g modulo p, times |lead(p)|^steps.
fn reduced(g: &[Rational], p: &Poly, steps: usize) -> Vec<Rational> {
    let common = common_denominator(g);
    let integral = g
        .iter()
        .map(|c| c.numer() * (&common / c.denom()))
        .collect();
    let remainder = Poly::new(integral).pseudo_rem_steps(p, steps);
    remainder
        .coeffs()
        .iter()
        .map(|c| Rational::new(c.clone(), common.clone()))
        .collect()
}

/// A row of A + tB times x, as a polynomial in t.
fn times(row: &Row, x: &[Vec<Rational>]) -> Vec<Rational> {
    let degree = x.iter().map(Vec::len).max().unwrap_or(0);
    (0..=degree)
        .map(|k| {
            sum(row.iter().flat_map(|(j, a, b)| {
                [
                    (a, x[*j].get(k)),
                    (b, k.checked_sub(1).and_then(|k| x[*j].get(k))),
                ]
            }))
        })
        .collect()
}

/// A sum of multiples over the common denominator of these terms, which as a rule is that of each:
/// one gcd instead of two for every term. (Per sum, not per claim: the worst file makes fractions
/// added one by one as long.)
fn sum<'a>(terms: impl Iterator<Item = (&'a Integer, Option<&'a Rational>)> + Clone) -> Rational {
    let given = terms
        .filter_map(|(factor, v)| Some((factor, v?)))
        .filter(|(factor, v)| !factor.is_zero() && !v.is_zero());
    let lift = |common: Integer, (_, v): (&Integer, &Rational)| {
        if common == *v.denom() {
            common
        } else {
            common.lcm(v.denom())
        }
    };
    let common = given.clone().fold(Integer::one(), lift);
    let lifted = |(factor, v): (&Integer, &Rational)| {
        let numerator = factor * v.numer();
        if common == *v.denom() {
            numerator
        } else {
            numerator * (&common / v.denom())
        }
    };
    let numerator: Integer = given.map(lifted).sum();
    Rational::new(numerator, common)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// Equal, unequal and cancelling denominators, a zero among the factors, polynomials of unequal
    /// length.
    #[test]
    fn rows_times_polynomials_are_the_sums_of_fractions() {
        let x = vec![
            vec![rational(1, 6), rational(-5, 6)],
            vec![rational(3, 4)],
            vec![],
            vec![rational(-1, 6), whole(0), rational(2, 7)],
        ];
        let row = |entries: &[(usize, i64, i64)]| -> Row {
            entries
                .iter()
                .map(|&(j, a, b)| (j, a.into(), b.into()))
                .collect()
        };
        for entries in [
            &[(0, 1, 2), (3, 1, -2)][..],
            &[(0, 7, -3), (1, 0, 5), (2, 4, 4), (3, -11, 13)],
            &[(1, 2, 0)],
            &[],
        ] {
            let mut plain = vec![whole(0); 4];
            for &(j, a, b) in entries {
                for (k, c) in x[j].iter().enumerate() {
                    plain[k] += c * whole(a);
                    plain[k + 1] += c * whole(b);
                }
            }
            assert_eq!(times(&row(entries), &x), plain);
        }
    }

    /// The limits themselves are allowed; beyond them the reason says by how much.
    #[test]
    fn a_claim_has_a_largest_size() {
        let zero = || Number(whole(0));
        let of = |coefficients: usize, longest_x: usize, (up, down): (u64, u64)| {
            let value = Rational::new(
                Integer::from(1) << (up - 1),
                (Integer::from(1) << (down - 1)) + i32::from(down > 1),
            );
            bounded(
                &vec![Integer::from(1); coefficients],
                &[zero(), Number(value)],
                &[vec![zero(); longest_x], vec![]],
            )
        };
        let large = |what, limit, got| Err(Reason::TooLarge { what, limit, got });
        assert_eq!([of(512, 0, (1, 1)), of(1, 512, (1, 1))], [Ok(()), Ok(())]);
        assert_eq!(
            of(513, 0, (1, 1)),
            large("coefficients of the polynomial", 512, 513)
        );
        assert_eq!(of(1, 513, (1, 1)), large("coefficients of x", 512, 513));
        let size = "size (coefficients times bits)";
        let edge = 1u64 << 18; // 4 + 4 coefficients: 2^21 in all
        assert_eq!(
            [of(4, 4, (edge - 1, 1)), of(4, 4, (edge / 2, edge / 2))],
            [Ok(()), Ok(())]
        );
        assert_eq!(of(4, 4, (edge, 1)), large(size, 1 << 21, (1 << 21) + 8));
        assert_eq!(
            of(4, 4, (edge / 2, edge / 2 + 1)),
            large(size, 1 << 21, (1 << 21) + 8)
        );
    }

    /// By hand: t^3 and 1/2 + t modulo 2t - 3 are 27/8 and 2, times 2^3. Short polynomials stay as
    /// they are.
    #[test]
    fn long_polynomials_are_reduced_by_one_factor() {
        let p = Poly::new(vec![(-3).into(), 2.into()]);
        let list = |polynomials: &[&[Rational]]| -> Vec<Vec<Number>> {
            polynomials
                .iter()
                .map(|g| g.iter().cloned().map(Number).collect())
                .collect()
        };

        let long = list(&[
            &[whole(0), whole(0), whole(0), whole(1)],
            &[rational(1, 2), whole(1)],
            &[],
        ]);
        assert_eq!(
            coefficients(&long, &p),
            [vec![whole(27)], vec![whole(16)], vec![]]
        );

        let short = list(&[&[whole(0), whole(0), whole(1)], &[rational(1, 2)]]);
        assert_eq!(
            coefficients(&short, &p),
            [vec![whole(0), whole(0), whole(1)], vec![rational(1, 2)]]
        );
    }

    /// Each polynomial may be evaluated once; together they have a largest work.
    #[test]
    fn a_claim_has_a_largest_work() {
        let zero = || Number(whole(0));
        // 4 + 4 coefficients of 2^k bits: size 2^(k + 3).
        let of = |polynomials: usize, bits: u64| {
            let number = Number(Rational::from_integer(Integer::from(1) << (bits - 2)));
            let x = vec![vec![zero(); 4]; polynomials];
            bounded(&vec![Integer::from(1); 4], &[zero(), number], &x)
        };
        let what = "work (polynomials times the square of coefficients times bits)";
        let large = |got| {
            Err(Reason::TooLarge {
                what,
                limit: 1 << 46,
                got,
            })
        };

        assert_eq!([of(16, 1 << 18), of(1 << 10, 1 << 15)], [Ok(()), Ok(())]);
        assert_eq!(
            [of(17, 1 << 18), of((1 << 10) + 1, 1 << 15)],
            [large(17 << 42), large(1025 << 36)]
        );
    }

    /// One coefficient more than p is free for numbers of any length; each further one counts with
    /// the bits.
    #[test]
    fn x_has_a_largest_excess() {
        let zero = || Number(whole(0));
        let of = |coefficients: usize, longest_x: usize, bits: u64| {
            let number = Number(Rational::from_integer(Integer::from(1) << (bits - 2)));
            bounded(
                &vec![Integer::from(1); coefficients],
                &[zero(), number],
                &[vec![zero(); longest_x]],
            )
        };
        let large = |got| {
            let what = "excess (coefficients of x beyond those of the polynomial, times bits)";
            Err(Reason::TooLarge {
                what,
                limit: 1 << 13,
                got,
            })
        };

        // 2^k has k + 1 bits and the denominator one.
        assert_eq!(
            [of(3, 4, 1 << 17), of(3, 3, 1 << 17), of(3, 2, 1 << 17)],
            [Ok(()), Ok(()), Ok(())]
        );
        assert_eq!([of(3, 5, 1 << 12), of(3, 11, 1 << 10)], [Ok(()), Ok(())]);
        assert_eq!(of(3, 5, (1 << 12) + 1), large((1 << 13) + 2));
        assert_eq!(of(3, 12, 1 << 10), large(9 << 10));
    }
}
