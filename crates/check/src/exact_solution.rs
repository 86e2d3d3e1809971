//! Exact solutions: the value is a root alpha of an integer polynomial p, x a vector of polynomials
//! in alpha.
//!
//! A number g(alpha), g a rational polynomial, is zero if p divides g. It has the sign of the
//! remainder r of g by p, which takes the same value at alpha; and if interval Horner of r on an
//! interval [a, b] that contains alpha gives positive numbers only, r(alpha) > 0. So both "= 0" and
//! "> 0" at alpha are decided by exact arithmetic on the coefficients. The test of zero may refuse
//! a true claim if p is reducible, but what it accepts is true for every root of p in [a, b].
//!
//! The obligations, in the order of `spec/certificates.md`:
//!
//! 1. `support` and `biactive` are ascending lists of complementarity variables, the support has at
//!    most one half of v_T of each particle with zero reaction, and the numbers are small enough to
//!    be multiplied out.
//! 2. [a, b] contains exactly one root of p: a = b and p(a) = 0; or p(a) p(b) < 0, so that there is
//!    one, and p' has one sign on [a, b], so that there are no two.
//! 3. [a, b] lies in the window.
//! 4. x_i > 0 on the support and x_i = 0 on the other complementarity variables; x is not zero
//!    (14).
//! 5. y = (A + tB) x is zero on the free rows (13) and on the support (25), zero on the biactive
//!    rows, and positive on all other rows (26).
//!
//! Together these are (12)-(14). Input: the integral rows of the pencil, the window and the claim.
//! The functions on index sets, sizes, intervals and remainders serve `lifted_solution` too, and
//! those on index sets and windows serve `enclosed`.

use super::AcceptedClaim;
use super::pencil::{Row, Rows};
use super::reason::Reason;
use crate::certificate::ExactSolution;
use crate::cover::ends::rational_bits;
use mceip_exact::{Integer, Interval, Poly, Rational, cleared, common_denominator};
use mceip_model::Window;
use mceip_model::file::Number;
use num_traits::Zero;

/// Largest number of coefficients of p and of each x_i. A support of n variables needs at most
/// n + 1.
const MAX_COEFFICIENTS: u64 = 512;
/// Largest product of the number of coefficients (of p and of the longest x_i) and the bits of the
/// longest number of the claim: bounds the work on a file that is small but hostile.
const MAX_SIZE: u64 = 1 << 21;
/// Largest product of the number of polynomials and the square of that size: Horner's rule is asked
/// for each row.
pub(super) const MAX_WORK: u64 = 1 << 43;
/// By how many coefficients x may exceed p for numbers of any length: y = (A + tB) x has one more
/// than x.
const FREE_EXCESS: u64 = 1;
/// Largest product of a larger excess with the bits of the longest number: every coefficient in
/// excess makes a remainder longer by the leading coefficient of p.
const MAX_EXCESS_SIZE: u64 = 1 << 13;

/// A rational polynomial, constant term first.
pub(super) type Polynomial = Vec<Rational>;

pub(super) fn check(
    rows: &Rows,
    window: &Window,
    claim: &ExactSolution,
) -> Result<AcceptedClaim, Reason> {
    index_set(rows, "support", &claim.support)?;
    index_set(rows, "biactive", &claim.biactive)?;
    one_half(rows, &claim.support)?;
    ClaimSize::of(&claim.polynomial, &claim.interval, &claim.x).bounded()?;

    let p = Poly::new(claim.polynomial.clone()).primitive();
    let value = isolate(&p, &claim.interval)?;
    within(window, &value)?;
    Reason::length("x", rows.order(), claim.x.len())?;

    let alpha = Alpha { p, value };
    let x = coefficients(&claim.x, &alpha.p);
    check_x(rows, claim, &alpha, &x)?;
    check_y(rows, claim, &alpha, &x)?;

    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value: alpha.value,
    })
}

/// No particle with zero reaction has both halves of its v_T in the support: with v+ = v- alone
/// x is not zero, but v is.
pub(super) fn one_half(rows: &Rows, support: &[usize]) -> Result<(), Reason> {
    for halves in &rows.halves {
        if support.contains(&halves.right) && support.contains(&halves.left) {
            return Err(Reason::BothHalves {
                particle: halves.particle,
                right: halves.right,
                left: halves.left,
            });
        }
    }

    Ok(())
}

/// How large an exact or lifted claim is.
pub(super) struct ClaimSize {
    /// Coefficients of the polynomial of the value.
    coefficients: u64,
    /// Entries of x, or of v and w.
    polynomials: u64,
    /// Coefficients of the longest of these.
    longest_x: u64,
    /// Bits of the longest number. Both ends of the interval count together, because interval
    /// Horner brings them to one denominator.
    bits: u64,
}

impl ClaimSize {
    /// `x` are the polynomials of the claim: those of x, or of v and w.
    pub(super) fn of<'a>(
        polynomial: &[Integer],
        [lo, hi]: &[Number; 2],
        x: impl IntoIterator<Item = &'a Vec<Number>>,
    ) -> ClaimSize {
        let mut size = ClaimSize {
            coefficients: polynomial.len() as u64,
            polynomials: 0,
            longest_x: 0,
            bits: rational_bits(&lo.0) + rational_bits(&hi.0),
        };

        for coefficient in polynomial {
            size.bits = size.bits.max(coefficient.bits());
        }

        for entry in x {
            size.polynomials += 1;
            size.longest_x = size.longest_x.max(entry.len() as u64);
            for coefficient in entry {
                size.bits = size.bits.max(rational_bits(&coefficient.0));
            }
        }

        size
    }

    /// Coefficients times bits.
    fn size(&self) -> u64 {
        let coefficients = self.coefficients + self.longest_x;
        self.bits.saturating_mul(coefficients)
    }

    /// What Horner's rule for all polynomials costs at most.
    pub(super) fn work(&self) -> u64 {
        let size = self.size();
        size.saturating_mul(size).saturating_mul(self.polynomials)
    }

    /// Demands that the claim is small enough to be multiplied out.
    pub(super) fn bounded(&self) -> Result<(), Reason> {
        let what = "coefficients of the polynomial";
        Reason::at_most(what, MAX_COEFFICIENTS, self.coefficients)?;
        Reason::at_most("coefficients of x", MAX_COEFFICIENTS, self.longest_x)?;

        Reason::at_most("size (coefficients times bits)", MAX_SIZE, self.size())?;
        let what = "work (polynomials times the square of coefficients times bits)";
        Reason::at_most(what, MAX_WORK, self.work())?;

        let excess = self.longest_x.saturating_sub(self.coefficients);
        if excess <= FREE_EXCESS {
            return Ok(());
        }

        let what = "excess (coefficients of x beyond those of the polynomial, times bits)";
        Reason::at_most(what, MAX_EXCESS_SIZE, self.bits.saturating_mul(excess))
    }
}

/// Demands an ascending list of complementarity variables.
pub(super) fn index_set(rows: &Rows, set: &'static str, list: &[usize]) -> Result<(), Reason> {
    for (position, &index) in list.iter().enumerate() {
        let is_complementarity_variable = index < rows.order() && !rows.is_free[index];
        let ascends = position == 0 || list[position - 1] < index;

        if !is_complementarity_variable || !ascends {
            return Err(Reason::IndexSet {
                set,
                position,
                got: index,
            });
        }
    }

    Ok(())
}

/// Demands that [a, b] contains exactly one root of p, and returns it.
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

    let at_a = p.sign_at(&a.0);
    if value.is_point() {
        if at_a != 0 {
            return Err(Reason::NotARoot {
                a: a.0.clone(),
                sign: at_a,
            });
        }

        return Ok(value);
    }

    let at_b = p.sign_at(&b.0);
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

/// Demands that an interval lies in the closed window.
pub(super) fn within(window: &Window, value: &Interval) -> Result<(), Reason> {
    let is_above_min = value.lo() >= window.min();
    let is_below_max = window.max().is_none_or(|max| value.hi() <= max);
    if is_above_min && is_below_max {
        return Ok(());
    }

    let max = match window.max() {
        Some(max) => max.to_string(),
        None => "infinity".into(),
    };
    Err(Reason::OutsideWindow {
        min: window.min().clone(),
        max,
        a: value.lo().clone(),
        b: value.hi().clone(),
    })
}

/// The value of the unknown: the root of p in an interval.
pub(super) struct Alpha {
    pub(super) p: Poly,
    pub(super) value: Interval,
}

impl Alpha {
    /// A positive multiple of the remainder of g by p. It is zero exactly if p divides g over Q.
    pub(super) fn remainder(&self, g: &[Rational]) -> Poly {
        Poly::from_rationals(g).pseudo_rem(&self.p)
    }

    /// Encloses a positive multiple of g(alpha).
    pub(super) fn enclose(&self, g: &[Rational]) -> Interval {
        self.value.horner_rounded(&self.remainder(g))
    }
}

/// x_i > 0 on the support, x_i = 0 elsewhere, and x is not zero.
fn check_x(
    rows: &Rows,
    claim: &ExactSolution,
    alpha: &Alpha,
    x: &[Polynomial],
) -> Result<(), Reason> {
    let mut is_non_zero = !claim.support.is_empty();

    for (index, x_i) in x.iter().enumerate() {
        let is_in_support = claim.support.binary_search(&index).is_ok();

        if rows.is_free[index] {
            is_non_zero |= alpha.enclose(x_i).certain_sign() != 0;
        } else if is_in_support {
            let image = alpha.enclose(x_i);
            Reason::x_positive(index, &image)?;
        } else if !alpha.remainder(x_i).is_zero() {
            return Err(Reason::XOffSupport { index });
        }
    }

    if is_non_zero {
        Ok(())
    } else {
        Err(Reason::XZero)
    }
}

/// y_i = 0 on the free rows, the support and the biactive rows, y_i > 0 on all others.
fn check_y(
    rows: &Rows,
    claim: &ExactSolution,
    alpha: &Alpha,
    x: &[Polynomial],
) -> Result<(), Reason> {
    for (index, row) in rows.rows.iter().enumerate() {
        let y = alpha.remainder(&times(row, x));
        let is_zero = y.is_zero();
        let is_free = rows.is_free[index];
        let is_active = is_free || claim.support.binary_search(&index).is_ok();
        let is_biactive = claim.biactive.binary_search(&index).is_ok();

        if is_active && !is_zero {
            let equation = if is_free { "E13" } else { "E25" };
            return Err(Reason::YNotZero { equation, index });
        }

        let expected = !is_active && is_zero;
        if is_biactive != expected {
            return Err(Reason::Biactive { index, expected });
        }

        if !is_zero {
            let image = alpha.value.horner_rounded(&y);
            Reason::y_positive(index, &image)?;
        }
    }

    Ok(())
}

/// The polynomials of a list, ready to be multiplied by rows of the pencil.
///
/// Where one of them is much longer than p, all are replaced by their remainders by p times one
/// common positive number. The rows then need not divide a long polynomial once each, and as the
/// factor is common, linear equations and signs remain what they are.
pub(super) fn coefficients<'a>(
    list: impl IntoIterator<Item = &'a Vec<Number>> + Clone,
    p: &Poly,
) -> Vec<Polynomial> {
    let coefficients = p.coeffs().len();
    let longest = list.clone().into_iter().map(Vec::len).max().unwrap_or(0);
    let is_long = longest > coefficients + FREE_EXCESS as usize;

    let mut polynomials = Vec::new();
    for numbers in list {
        let g: Polynomial = numbers.iter().map(|n| n.0.clone()).collect();
        if is_long {
            let steps = longest + 1 - coefficients;
            polynomials.push(reduced(&g, p, steps));
        } else {
            polynomials.push(g);
        }
    }

    polynomials
}

/// g modulo p, times |lead(p)|^steps.
fn reduced(g: &[Rational], p: &Poly, steps: usize) -> Polynomial {
    let common = common_denominator(g);
    let integral = g.iter().map(|c| cleared(c, &common)).collect();

    let remainder = Poly::new(integral).pseudo_rem_steps(p, steps);
    remainder
        .coeffs()
        .iter()
        .map(|c| Rational::new(c.clone(), common.clone()))
        .collect()
}

/// A row of A + tB times x, as a polynomial in t: its coefficient of t^k is
/// sum_j A_j x_j,k + B_j x_j,k-1.
fn times(row: &Row, x: &[Polynomial]) -> Polynomial {
    let degree = x.iter().map(Vec::len).max().unwrap_or(0);
    let mut product = Vec::with_capacity(degree + 1);

    let mut terms = Vec::new();
    for k in 0..=degree {
        terms.clear();
        for (j, a, b) in row {
            terms.extend(x[*j].get(k).map(|value| (a, value)));
            if k > 0 {
                terms.extend(x[*j].get(k - 1).map(|value| (b, value)));
            }
        }

        product.push(sum_of_products(&terms));
    }

    product
}

/// A sum of products of an integer and a fraction.
///
/// The sum is taken over the common denominator of its terms, which as a rule is that of each: this
/// needs one gcd for every term instead of two.
fn sum_of_products(terms: &[(&Integer, &Rational)]) -> Rational {
    let common = common_denominator(terms.iter().map(|(_, value)| *value));

    let mut numerator = Integer::zero();
    for (factor, value) in terms {
        numerator += *factor * cleared(value, &common);
    }

    Rational::new(numerator, common)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn zero() -> Number {
        Number(whole(0))
    }

    /// The upper end of an interval from 0 whose ends have so many bits together.
    fn number_of_bits(bits: u64) -> Number {
        // 2^k has k + 1 bits, and each denominator one.
        Number(Rational::from_integer(Integer::from(1) << (bits - 3)))
    }

    /// The verdict on p with so many coefficients, x with so many polynomials of zeros, and one
    /// long number.
    fn verdict(
        coefficients: usize,
        polynomials: usize,
        length_of_x: usize,
        number: Number,
    ) -> Result<(), Reason> {
        let p = vec![Integer::from(1); coefficients];
        let x = vec![vec![zero(); length_of_x]; polynomials];
        ClaimSize::of(&p, &[zero(), number], &x).bounded()
    }

    fn too_large(what: &'static str, limit: u64, got: u64) -> Result<(), Reason> {
        Err(Reason::TooLarge { what, limit, got })
    }

    #[test]
    fn index_sets_ascend_strictly() {
        let rows = Rows {
            halves: vec![],
            rows: vec![vec![]; 3],
            factor: vec![1.into(); 3],
            is_free: vec![false, true, false],
        };
        let refusal = |position: usize, got: usize| {
            Err(Reason::IndexSet {
                set: "support",
                position,
                got,
            })
        };

        assert_eq!(index_set(&rows, "support", &[]), Ok(()));
        assert_eq!(index_set(&rows, "support", &[0, 2]), Ok(()));

        assert_eq!(index_set(&rows, "support", &[2, 0]), refusal(1, 0));
        assert_eq!(index_set(&rows, "support", &[2, 2]), refusal(1, 2));
        assert_eq!(index_set(&rows, "support", &[0, 1]), refusal(1, 1)); // free
        assert_eq!(index_set(&rows, "support", &[3]), refusal(0, 3));
    }

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

        for entries in [
            &[(0, 1, 2), (3, 1, -2)][..],
            &[(0, 7, -3), (1, 0, 5), (2, 4, 4), (3, -11, 13)],
            &[(1, 2, 0)],
            &[],
        ] {
            let mut row = Row::new();
            let mut expected = vec![whole(0); 4];
            for &(j, a, b) in entries {
                row.push((j, a.into(), b.into()));
                for (k, c) in x[j].iter().enumerate() {
                    expected[k] += c * whole(a);
                    expected[k + 1] += c * whole(b);
                }
            }

            assert_eq!(times(&row, &x), expected);
        }
    }

    /// The limits themselves are allowed; beyond them the reason says by how much.
    #[test]
    fn a_claim_has_a_largest_size() {
        let one = || Number(whole(1));
        assert_eq!(verdict(512, 1, 0, one()), Ok(()));
        assert_eq!(verdict(1, 1, 512, one()), Ok(()));

        let what = "coefficients of the polynomial";
        assert_eq!(verdict(513, 1, 0, one()), too_large(what, 512, 513));
        let what = "coefficients of x";
        assert_eq!(verdict(1, 1, 513, one()), too_large(what, 512, 513));

        // 4 + 4 coefficients: 2^21 in all. The bits of numerator and denominator count together,
        // and so do those of the lower end 0: one.
        let what = "size (coefficients times bits)";
        let edge = 1u64 << 18;
        let fraction = |numerator_bits: u64, denominator_bits: u64| {
            let numerator = Integer::from(1) << (numerator_bits - 1);
            let denominator: Integer = Integer::from(1) << (denominator_bits - 1);
            Number(Rational::new(numerator, denominator + 1))
        };
        let at_the_edge = fraction(edge / 2, edge / 2 - 1);
        let beyond = fraction(edge / 2, edge / 2);

        assert_eq!(verdict(4, 1, 4, number_of_bits(edge)), Ok(()));
        assert_eq!(verdict(4, 1, 4, at_the_edge), Ok(()));
        let expected = too_large(what, 1 << 21, (1 << 21) + 8);
        assert_eq!(verdict(4, 1, 4, number_of_bits(edge + 1)), expected);
        assert_eq!(verdict(4, 1, 4, beyond), expected);
    }

    /// By hand: t^3 and 1/2 + t modulo 2t - 3 are 27/8 and 2, times 2^3. Short polynomials stay as
    /// they are.
    #[test]
    fn long_polynomials_are_reduced_by_one_factor() {
        let p = Poly::new(vec![(-3).into(), 2.into()]);
        let numbers = |polynomial: &[Rational]| -> Vec<Number> {
            polynomial.iter().cloned().map(Number).collect()
        };

        let long = vec![
            numbers(&[whole(0), whole(0), whole(0), whole(1)]),
            numbers(&[rational(1, 2), whole(1)]),
            vec![],
        ];
        assert_eq!(
            coefficients(&long, &p),
            [vec![whole(27)], vec![whole(16)], vec![]]
        );

        let short = vec![
            numbers(&[whole(0), whole(0), whole(1)]),
            numbers(&[rational(1, 2)]),
        ];
        assert_eq!(
            coefficients(&short, &p),
            [vec![whole(0), whole(0), whole(1)], vec![rational(1, 2)]]
        );
    }

    /// Each polynomial may be evaluated once; together they have a largest work.
    #[test]
    fn a_claim_has_a_largest_work() {
        // 4 + 4 coefficients of 2^k bits: size 2^(k + 3).
        let work_of =
            |polynomials: usize, bits: u64| verdict(4, polynomials, 4, number_of_bits(bits));
        assert_eq!(work_of(2, 1 << 18), Ok(()));
        assert_eq!(work_of(1 << 7, 1 << 15), Ok(()));

        let what = "work (polynomials times the square of coefficients times bits)";
        assert_eq!(work_of(3, 1 << 18), too_large(what, 1 << 43, 3 << 42));
        let more = (1 << 7) + 1;
        assert_eq!(work_of(more, 1 << 15), too_large(what, 1 << 43, 129 << 36));
    }

    /// One coefficient more than p is free for numbers of any length; each further one counts with
    /// the bits.
    #[test]
    fn x_has_a_largest_excess() {
        let of_three =
            |length_of_x: usize, bits: u64| verdict(3, 1, length_of_x, number_of_bits(bits));
        for length_of_x in [2, 3, 4] {
            assert_eq!(of_three(length_of_x, 1 << 17), Ok(()), "{length_of_x}");
        }
        assert_eq!(of_three(5, 1 << 12), Ok(()));
        assert_eq!(of_three(11, 1 << 10), Ok(()));

        let what = "excess (coefficients of x beyond those of the polynomial, times bits)";
        let one_bit_more = (1 << 12) + 1;
        assert_eq!(
            of_three(5, one_bit_more),
            too_large(what, 1 << 13, (1 << 13) + 2)
        );
        assert_eq!(of_three(12, 1 << 10), too_large(what, 1 << 13, 9 << 10));
    }
}
