//! Signs of polynomials at algebraic numbers and between two of them.
//!
//! *Descartes' rule of signs.* If the polynomial (1 + x)^n p((a + bx) / (1 + x)) has coefficients
//! of one sign, p has no root in (a, b); if they change once, it has exactly one. (For (a,
//! infinity) the polynomial is p(a + x).) Where there are more changes the interval is halved, a
//! few times; what is not decided then counts as a possible root.
//!
//! *Between two roots.* Let [a, b] isolate a root r of p, and [a', b'] the next one. A polynomial g
//! has no root in (r, r') if it has none in (b, a') and none in [a, b] and [a', b'] other than the
//! isolated ones. For the latter g is divided by p as often as p divides it. Then the sign of g in
//! the middle of [b, a'] is its sign all between.
//!
//! Each transformation, remainder and evaluation is counted by a [`SignBudget`] before it is done.
//! Once that is spent, no sign can be told any more.
//!
//! Called by `support`.

use super::sign_budget::{PolySize, SignBudget};
use mceip_exact::{Integer, Interval, Poly, Rational, cleared};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Halvings in a row and in all before the answer is no.
const MAX_DEPTH: u32 = 24;
const MAX_HALVINGS: usize = 200;

/// The only root of `poly`, whose coefficients have no common factor, in `value`.
pub(super) struct AlgebraicValue {
    pub(super) poly: Poly,
    pub(super) value: Interval,
}

impl AlgebraicValue {
    /// The sign of g here, if it can be told.
    pub(super) fn sign(&self, g: &Poly, budget: &SignBudget) -> Option<i8> {
        let size = PolySize::of(g);
        if !budget.spend_remainder(size, &self.poly) {
            return None;
        }

        let remainder = g.pseudo_rem(&self.poly);
        if remainder.is_zero() {
            return Some(0);
        }

        let size = size.of_remainder(&self.poly, remainder.coeffs().len());
        if !budget.spend_evaluation(size, self.value.lo(), self.value.hi()) {
            return None;
        }

        match self.value.horner_rounded(&remainder).certain_sign() {
            0 => None,
            sign => Some(sign),
        }
    }

    /// Has g no root in the isolating interval but possibly this one?
    fn is_only_root_of(&self, g: &Poly, budget: &SignBudget) -> bool {
        if self.value.is_point() {
            return true;
        }

        let a = self.value.lo();
        let b = self.value.hi();
        let bits = PolySize::of(g).bits;
        let rest = stripped(g, &self.poly, budget);

        let is_zero_at_an_end = rest.sign_at(a) == 0 || rest.sign_at(b) == 0;
        !is_zero_at_an_end && has_no_root(&rest, bits, a, Some(b), budget)
    }
}

/// The sign of g strictly between two roots (`None`: infinity), if it has one there and it can be
/// told.
pub(super) fn sign_between(
    g: &Poly,
    left: &AlgebraicValue,
    right: Option<&AlgebraicValue>,
    budget: &SignBudget,
) -> Option<i8> {
    if g.is_zero() {
        return Some(0);
    }

    let is_only_root = |root: &AlgebraicValue| root.is_only_root_of(g, budget);
    if !is_only_root(left) || !right.is_none_or(is_only_root) {
        return None;
    }

    let a = left.value.hi();
    let b = right.map(|root| root.value.lo());
    if !has_no_root(g, PolySize::of(g).bits, a, b, budget) {
        return None;
    }

    let sample = match b {
        Some(b) => (a + b) / Rational::from_integer(2.into()),
        None => a + Rational::one(),
    };
    Some(g.sign_at(&sample))
}

/// Is it certain that p has no root in the open interval? The work is counted as if the longest
/// coefficient of p had this number of bits.
fn has_no_root(
    p: &Poly,
    bits: u64,
    a: &Rational,
    b: Option<&Rational>,
    budget: &SignBudget,
) -> bool {
    let mut halving = Halving {
        p,
        size: PolySize {
            coefficients: p.coeffs().len() as u64,
            bits,
        },
        halvings: MAX_HALVINGS,
        budget,
    };
    halving.has_none(a, b, MAX_DEPTH)
}

struct Halving<'a> {
    p: &'a Poly,
    /// By which the work is counted.
    size: PolySize,
    /// Halvings left.
    halvings: usize,
    budget: &'a SignBudget,
}

impl Halving<'_> {
    fn has_none(&mut self, a: &Rational, b: Option<&Rational>, depth: u32) -> bool {
        if !self.budget.spend_transformation(self.size, a, b) {
            return false;
        }

        match sign_changes(self.p, a, b) {
            0 => true,
            1 => false,
            _ if depth == 0 || self.halvings == 0 => false,
            _ => {
                self.halvings -= 1;
                let middle = middle_of(a, b);
                self.p.sign_at(&middle) != 0
                    && self.has_none(a, Some(&middle), depth - 1)
                    && self.has_none(&middle, b, depth - 1)
            }
        }
    }
}

/// Where an interval is cut: in the middle, a half line at a + |a| + 1.
fn middle_of(a: &Rational, b: Option<&Rational>) -> Rational {
    match b {
        Some(b) => (a + b) / Rational::from_integer(2.into()),
        None => a + a.abs() + Rational::one(),
    }
}

/// Descartes' bound of the number of roots in the open interval.
fn sign_changes(p: &Poly, a: &Rational, b: Option<&Rational>) -> usize {
    let width = b.map(|b| b - a);
    let unit = match &width {
        Some(width) => a.denom().lcm(width.denom()),
        None => a.denom().clone(),
    };

    // p(y / unit) unit^n, shifted to begin at a.
    let mut coefficients: Vec<Integer> = p.coeffs().to_vec();
    multiply_by_powers(coefficients.iter_mut().rev(), &unit);
    shift(&mut coefficients, &cleared(a, &unit));

    if let Some(width) = width {
        // y = width s with s = 1 / (1 + x).
        multiply_by_powers(coefficients.iter_mut(), &cleared(&width, &unit));
        coefficients.reverse();
        shift(&mut coefficients, &Integer::one());
    }

    changes(&coefficients)
}

/// Multiplies the k-th of the coefficients by factor^k.
fn multiply_by_powers<'a>(coefficients: impl Iterator<Item = &'a mut Integer>, factor: &Integer) {
    let mut power = Integer::one();
    for coefficient in coefficients {
        *coefficient *= &power;
        power *= factor;
    }
}

/// Changes of sign in a list, zeros left out.
fn changes(coefficients: &[Integer]) -> usize {
    let signs: Vec<bool> = coefficients
        .iter()
        .filter(|v| !v.is_zero())
        .map(Signed::is_positive)
        .collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// p(y) to p(y + a).
fn shift(c: &mut [Integer], a: &Integer) {
    for i in 0..c.len() {
        for k in (i..c.len().saturating_sub(1)).rev() {
            let step = &c[k + 1] * a;
            c[k] += step;
        }
    }
}

/// g without its factors q, a polynomial whose coefficients have no common factor. What is left is
/// counted with the bits of g.
fn stripped(g: &Poly, q: &Poly, budget: &SignBudget) -> Poly {
    let mut size = PolySize::of(g);
    let mut rest = g.clone();
    while rest.degree() >= q.degree() && budget.spend_remainder(size, q) {
        let Some(quotient) = rest.exact_div(q) else {
            break;
        };
        rest = quotient;
        size.coefficients = rest.coeffs().len() as u64;
    }

    rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// The root of a polynomial in [a, b], ends as (numerator, denominator).
    fn root(coefficients: &[i64], a: (i64, i64), b: (i64, i64)) -> AlgebraicValue {
        let value = Interval::new(rational(a.0, a.1), rational(b.0, b.1));
        AlgebraicValue {
            poly: Poly::from_ints(coefficients),
            value: value.unwrap(),
        }
    }

    fn sqrt_2() -> AlgebraicValue {
        root(&[-2, 0, 1], (7, 5), (3, 2))
    }

    fn is_rootless(p: &Poly, a: &Rational, b: Option<&Rational>) -> bool {
        has_no_root(p, PolySize::of(p).bits, a, b, &SignBudget::new())
    }

    fn sign_in_cell(g: &Poly, left: &AlgebraicValue, right: Option<&AlgebraicValue>) -> Option<i8> {
        sign_between(g, left, right, &SignBudget::new())
    }

    #[test]
    fn roots_are_not_overlooked() {
        let p = Poly::from_ints(&[2, -3, 1]); // 1 and 2
        assert!(!is_rootless(&p, &whole(0), Some(&whole(3))));
        assert!(!is_rootless(&p, &rational(3, 2), None));

        // Ends do not count.
        assert!(is_rootless(&p, &whole(1), Some(&whole(2))));
        assert!(is_rootless(&p, &whole(2), None));

        // A double root does not change the sign and is one.
        let double = Poly::from_ints(&[1, -2, 1]);
        assert!(!is_rootless(&double, &whole(0), Some(&whole(3))));
        assert!(!is_rootless(&double, &whole(0), None));
    }

    #[test]
    fn complex_roots_near_the_interval_take_halvings() {
        let p = Poly::from_ints(&[101, -200, 100]); // (t - 1)^2 + 1/100
        assert!(sign_changes(&p, &whole(0), Some(&whole(2))) > 0);

        assert!(is_rootless(&p, &whole(0), Some(&whole(2))));
        assert!(is_rootless(&p, &whole(0), None));
    }

    #[test]
    fn signs_between_roots() {
        let one = root(&[-1, 1], (1, 1), (1, 1));
        let sqrt_2 = sqrt_2();
        let t_minus_1 = Poly::from_ints(&[-1, 1]);
        let g = &Poly::from_ints(&[-2, 0, 1]) * &t_minus_1;

        assert_eq!(sign_in_cell(&g, &one, Some(&sqrt_2)), Some(-1));
        assert_eq!(sign_in_cell(&g, &sqrt_2, None), Some(1));
        assert_eq!(sign_in_cell(&(&g * &g), &sqrt_2, None), Some(1));
        assert_eq!(sign_in_cell(&Poly::default(), &one, None), Some(0));

        let zero_at_three_halves = Poly::from_ints(&[-3, 2]);
        assert_eq!(sign_in_cell(&zero_at_three_halves, &one, None), None);

        // A root within the isolating interval, on either side of the isolated one.
        let zero_above = Poly::from_ints(&[-29, 20]);
        let zero_below = Poly::from_ints(&[-141, 100]);
        assert_eq!(sign_in_cell(&zero_above, &sqrt_2, None), None);
        assert_eq!(sign_in_cell(&zero_below, &one, Some(&sqrt_2)), None);

        assert_eq!(sqrt_2.sign(&g, &SignBudget::new()), Some(0));
        assert_eq!(sqrt_2.sign(&t_minus_1, &SignBudget::new()), Some(1));
    }

    /// The sample lies above the last point: a root just below it does not count.
    #[test]
    fn the_sign_to_infinity_is_taken_above() {
        let half = root(&[-1, 2], (1, 2), (1, 2));
        let three = root(&[-3, 1], (3, 1), (3, 1));

        let rising = Poly::from_ints(&[-5, 2]);
        let falling = Poly::from_ints(&[5, -2]);
        assert_eq!(sign_in_cell(&rising, &three, None), Some(1));
        assert_eq!(sign_in_cell(&falling, &three, None), Some(-1));

        let positive = Poly::from_ints(&[1, 4]);
        assert_eq!(sign_in_cell(&positive, &half, Some(&three)), Some(1));
    }

    /// sqrt 2 in [7/5, 3/2], with another root of g, 29/20, beside it: told whether or not sqrt 2
    /// is one as well.
    #[test]
    fn another_root_in_the_isolating_interval_is_seen() {
        let sqrt_2 = sqrt_2();
        let nine = root(&[-9, 1], (9, 1), (9, 1));
        let square = &sqrt_2.poly * &sqrt_2.poly;

        let zero_beside = Poly::from_ints(&[-29, 20]);
        let zero_at_ten = Poly::from_ints(&[-10, 1]);
        let both = &zero_beside * &zero_at_ten;
        for g in [&both, &(&both * &sqrt_2.poly), &(&both * &square)] {
            assert_eq!(sign_in_cell(g, &sqrt_2, Some(&nine)), None);
        }

        let without = &zero_at_ten * &square;
        assert_eq!(sign_in_cell(&without, &sqrt_2, Some(&nine)), Some(-1));

        let zero_in_cell = &zero_at_ten * &Poly::from_ints(&[-10, 3]);
        assert_eq!(sign_in_cell(&zero_in_cell, &sqrt_2, Some(&nine)), None);

        let zero_below = &zero_at_ten * &Poly::from_ints(&[-1, 3]);
        assert_eq!(sign_in_cell(&zero_below, &sqrt_2, Some(&nine)), Some(-1));
    }

    /// A half line from `a` is halved above `a`, also where that is negative.
    #[test]
    fn half_lines_are_halved_above_their_end() {
        /// Is the product of (t - at)^2 + 1/100 and t - real certainly without root above `start`?
        fn is_free_from(start: i64, at: i64, real: i64) -> bool {
            let complex = Poly::from_ints(&[100 * at * at + 1, -200 * at, 100]);
            let product = &complex * &Poly::from_ints(&[-real, 1]);
            is_rootless(&product, &whole(start), None)
        }

        assert!(is_free_from(3, 8, 2)); // 2 is below
        assert!(is_free_from(-3, 1, -5));
        assert!(is_free_from(-3, -1, -5));

        assert!(!is_free_from(3, 8, 5));
        assert!(!is_free_from(3, 8, 30));
    }

    /// Is p certainly without root in (0, 2), with halvings up to this depth and number? And the
    /// halvings left.
    fn with_halvings(p: &Poly, depth: u32, halvings: usize) -> (bool, usize) {
        let budget = SignBudget::new();
        let mut halving = Halving {
            p,
            size: PolySize::of(p),
            halvings,
            budget: &budget,
        };
        let verdict = halving.has_none(&whole(0), Some(&whole(2)), depth);
        (verdict, halving.halvings)
    }

    /// (t - c)^2 + 1/10^4 takes about seven halvings on the way to c, on either side of the middle.
    #[test]
    fn the_answer_is_no_when_the_halvings_are_used_up() {
        for tenths in [1, 19] {
            let p = Poly::from_ints(&[tenths * tenths * 100 + 1, -2000 * tenths, 10_000]);

            let (verdict, left) = with_halvings(&p, 24, 200);
            let used = 200 - left;
            assert!(verdict);
            assert!((4..20).contains(&used), "{tenths}: {used}");
            assert_eq!(with_halvings(&p, 24, used), (true, 0));
            assert_eq!(with_halvings(&p, 24, used - 1), (false, 0));

            let depth = (0..24).find(|&depth| with_halvings(&p, depth, 200).0);
            let depth = depth.unwrap();
            assert!((4..20).contains(&depth), "{tenths}: {depth}");
            assert!(!with_halvings(&p, depth - 1, 200).0);
            assert_eq!(with_halvings(&p, 0, 200), (false, 200));
        }
    }

    /// (t - 1)^2 + 1/100 has three coefficients of up to 8 bits and takes some halvings. The ends 0
    /// and 2 have 0 + 1 and 2 + 1 bits.
    #[test]
    fn a_budget_ends_the_halvings() {
        let p = Poly::from_ints(&[101, -200, 100]);
        let first = 9 * (3 * (4 + 64) + 8);
        let with = |left: u64| {
            let budget = SignBudget::of(left);
            let verdict = has_no_root(&p, 8, &whole(0), Some(&whole(2)), &budget);
            (verdict, budget.is_spent(), budget.left())
        };

        let (verdict, is_spent, left) = with(1 << 30);
        assert!(verdict);
        assert!(!is_spent);
        let cost = (1 << 30) - left;
        assert!(cost > 2 * first, "{cost}");

        assert_eq!(with(cost), (true, false, 0));
        let (verdict, is_spent, _) = with(cost - 1);
        assert!(!verdict);
        assert!(is_spent);
        assert_eq!(with(first - 1), (false, true, first - 1));
    }

    /// The sign of 3 t^2 + 2 t + 1 at 7/2: two steps by a divisor of 3 bits, and the remainder, a
    /// constant, evaluated over [7/2, 7/2] with 5 + 5 bits.
    #[test]
    fn a_sign_at_a_point_takes_a_remainder_and_an_evaluation() {
        let g = Poly::from_ints(&[1, 2, 3]);
        let point = root(&[-7, 2], (7, 2), (7, 2));
        let with = |left: u64| {
            let budget = SignBudget::of(left);
            let is_told = point.sign(&g, &budget).is_some();
            (is_told, budget.is_spent(), budget.left())
        };

        let remainder_bits = 2 + 2 * 67;
        let remainder = (2 * 3 * 67 * remainder_bits) >> 9;
        let evaluation = (74 * (74 + remainder_bits)) >> 8;
        assert_eq!(with(remainder + evaluation), (true, false, 0));
        assert_eq!(
            with(remainder + evaluation - 1),
            (false, true, evaluation - 1)
        );
        assert_eq!(with(remainder - 1), (false, true, remainder - 1));
    }

    /// What is left of a polynomial without a factor is counted with the bits of the whole.
    #[test]
    fn a_factor_taken_out_leaves_the_bits() {
        let sqrt_2 = sqrt_2();
        let scaled = sqrt_2.poly.scale(&(Integer::one() << 100_u32)); // 102 bits
        let budget = SignBudget::of(1 << 30);

        assert_eq!(stripped(&scaled, &sqrt_2.poly, &budget).degree(), Some(0));
        let one_step = (3 * 66 * (102 + 66)) >> 9;
        assert_eq!(budget.left(), (1 << 30) - one_step);
    }
}
