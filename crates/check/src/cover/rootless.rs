//! Signs of polynomials at algebraic numbers and between two of them, and the budget for them.
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
//! *SignBudget.* A transformation of a polynomial with n coefficients takes n^2 / 2 products of
//! numbers of n times the bits of a and b with one of these: it is counted as n^3 (bits + 64) (1 +
//! bits / 1024). Remainders and evaluations are counted in the same unit. All leaves of a file
//! share one budget (`spec/certificates.md`, Limits). Once it is spent, no sign can be told any
//! more.
//!
//! Called by `support`.

use super::ends::rational_bits;
use mceip_exact::{Integer, Interval, Poly, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::cell::Cell;

/// Halvings in a row and in all before the answer is no.
const MAX_DEPTH: u32 = 24;
const MAX_HALVINGS: usize = 200;

/// What a file may count without any coefficient, and for each coefficient of its support leaves.
const BASE_BUDGET: u64 = 1 << 35;
const BUDGET_PER_COEFFICIENT: u64 = 1 << 24;
/// A remainder counts 2^-9 of steps^2 x coefficients x bits^2: products of words against additions
/// of bits.
const REMAINDER_SHIFT: u32 = 9;
/// Ends of more than 2^10 bits are long factors: a product with one takes as many times longer.
const LONG_ENDS_SHIFT: u32 = 10;
/// Horner's rule at a point counts 2^-8 of the square of coefficients x bits.
const EVALUATION_SHIFT: u32 = 8;

/// What is left of the counts of a file.
pub(super) struct SignBudget {
    left: Cell<u64>,
    is_spent: Cell<bool>,
}

impl SignBudget {
    pub(super) fn new() -> Self {
        SignBudget {
            left: Cell::new(BASE_BUDGET),
            is_spent: Cell::new(false),
        }
    }

    #[cfg(test)]
    pub(super) fn of(left: u64) -> Self {
        SignBudget {
            left: Cell::new(left),
            is_spent: Cell::new(false),
        }
    }

    /// A leaf with this many coefficients is about to be checked.
    pub(super) fn add_coefficients(&self, count: u64) {
        let added = count.saturating_mul(BUDGET_PER_COEFFICIENT);
        self.left.set(self.left.get().saturating_add(added));
    }

    /// Was more asked for than there was?
    pub(super) fn is_spent(&self) -> bool {
        self.is_spent.get()
    }

    /// Takes what the remainder of g by p costs: every step makes it longer by the leading
    /// coefficient of p.
    fn spend_remainder(&self, g: &Poly, p: &Poly) -> bool {
        let length = g.coeffs().len() as u64;
        let divisor = p.coeffs().len() as u64;
        let steps = (length + 1).saturating_sub(divisor);
        let bits = p.coeffs().iter().map(Integer::bits).max().unwrap_or(0) + 64;

        let products = steps.saturating_pow(2).saturating_mul(length);
        self.take(products.saturating_mul(bits).saturating_mul(bits) >> REMAINDER_SHIFT)
    }

    /// Takes what Horner's rule for p over [lo, hi] costs: its numbers grow by the bits of the ends
    /// at each coefficient.
    pub(super) fn spend_evaluation(&self, p: &Poly, lo: &Rational, hi: &Rational) -> bool {
        let bits = rational_bits(lo) + rational_bits(hi) + 64;

        let size = bits.saturating_mul(p.coeffs().len() as u64);
        self.take(size.saturating_mul(size) >> EVALUATION_SHIFT)
    }

    /// Takes what transforming the polynomial costs; false if that is more than is left.
    fn spend(&self, p: &Poly, a: &Rational, b: Option<&Rational>) -> bool {
        let bits = rational_bits(a) + b.map_or(0, rational_bits);

        let count = p.coeffs().len() as u64;
        let additions = count.saturating_pow(3).saturating_mul(bits + 64);
        let length_of_factors = 1 + (bits >> LONG_ENDS_SHIFT);
        self.take(additions.saturating_mul(length_of_factors))
    }

    fn take(&self, cost: u64) -> bool {
        match self.left.get().checked_sub(cost) {
            Some(left) => self.left.set(left),
            None => self.is_spent.set(true),
        }

        !self.is_spent.get()
    }
}

/// The only root of `poly` in `value`.
pub(super) struct AlgebraicValue {
    pub(super) poly: Poly,
    pub(super) value: Interval,
}

impl AlgebraicValue {
    /// The sign of g here, if it can be told.
    pub(super) fn sign(&self, g: &Poly, budget: &SignBudget) -> Option<i8> {
        if !budget.spend_remainder(g, &self.poly) {
            return None;
        }

        let remainder = g.pseudo_rem(&self.poly);
        if remainder.is_zero() {
            return Some(0);
        }

        if !budget.spend_evaluation(&remainder, self.value.lo(), self.value.hi()) {
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
        let rest = stripped(g, &self.poly, budget);

        rest.sign_at(a) != 0 && rest.sign_at(b) != 0 && has_no_root(&rest, a, Some(b), budget)
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
    if !has_no_root(g, a, b, budget) {
        return None;
    }

    let sample = match b {
        Some(b) => (a + b) / Rational::from_integer(2.into()),
        None => a + Rational::one(),
    };
    Some(g.sign_at(&sample))
}

/// Is it certain that p has no root in the open interval?
pub(super) fn has_no_root(
    p: &Poly,
    a: &Rational,
    b: Option<&Rational>,
    budget: &SignBudget,
) -> bool {
    let mut halving = Halving {
        p,
        halvings: MAX_HALVINGS,
        budget,
    };
    halving.has_none(a, b, MAX_DEPTH)
}

struct Halving<'a> {
    p: &'a Poly,
    /// Halvings left.
    halvings: usize,
    budget: &'a SignBudget,
}

impl Halving<'_> {
    fn has_none(&mut self, a: &Rational, b: Option<&Rational>, depth: u32) -> bool {
        if !self.budget.spend(self.p, a, b) {
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
    let in_units = |v: &Rational| v.numer() * (&unit / v.denom());

    // p(y / unit) unit^n, shifted to begin at a.
    let mut coefficients: Vec<Integer> = p.coeffs().to_vec();
    multiply_by_powers(coefficients.iter_mut().rev(), &unit);
    shift(&mut coefficients, &in_units(a));

    if let Some(width) = width {
        // y = width s with s = 1 / (1 + x).
        multiply_by_powers(coefficients.iter_mut(), &in_units(&width));
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

/// g without its factors q.
fn stripped(g: &Poly, q: &Poly, budget: &SignBudget) -> Poly {
    let mut rest = g.clone();
    while rest.degree() >= q.degree()
        && budget.spend_remainder(&rest, q)
        && rest.pseudo_rem(q).is_zero()
    {
        rest = quotient(&rest, q);
    }

    rest
}

/// A multiple of g / q, which q divides over the rationals.
fn quotient(g: &Poly, q: &Poly) -> Poly {
    let lead = q.leading();
    let mut rest = g.clone();
    let mut quotient = Poly::default();

    while let (Some(n), Some(m)) = (rest.degree(), q.degree()) {
        if n < m {
            break;
        }

        let top = Poly::constant(rest.leading()).shift(n - m);
        rest = &rest.scale(&lead) - &(&top * q);
        quotient = &quotient.scale(&lead) + &top;
    }

    quotient.primitive()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn root(c: &[i64], a: (i64, i64), b: (i64, i64)) -> AlgebraicValue {
        AlgebraicValue {
            poly: Poly::from_ints(c),
            value: Interval::new(rational(a.0, a.1), rational(b.0, b.1)).unwrap(),
        }
    }

    #[test]
    fn roots_are_not_overlooked() {
        let p = Poly::from_ints(&[2, -3, 1]); // 1 and 2
        assert!(!has_no_root(
            &p,
            &whole(0),
            Some(&whole(3)),
            &SignBudget::new()
        ));
        assert!(!has_no_root(&p, &rational(3, 2), None, &SignBudget::new()));
        // Ends do not count.
        assert!(has_no_root(
            &p,
            &whole(1),
            Some(&whole(2)),
            &SignBudget::new()
        ));
        assert!(has_no_root(&p, &whole(2), None, &SignBudget::new()));
        // A double root does not change the sign and is one.
        assert!(!has_no_root(
            &Poly::from_ints(&[1, -2, 1]),
            &whole(0),
            Some(&whole(3)),
            &SignBudget::new()
        ));
        assert!(!has_no_root(
            &Poly::from_ints(&[1, -2, 1]),
            &whole(0),
            None,
            &SignBudget::new()
        ));
    }

    #[test]
    fn complex_roots_near_the_interval_take_halvings() {
        // (t - 1)^2 + 1/100
        let p = Poly::from_ints(&[101, -200, 100]);
        assert!(sign_changes(&p, &whole(0), Some(&whole(2))) > 0);
        assert!(
            has_no_root(&p, &whole(0), Some(&whole(2)), &SignBudget::new())
                && has_no_root(&p, &whole(0), None, &SignBudget::new())
        );
    }

    #[test]
    fn signs_between_roots() {
        let (one, sqrt2) = (
            root(&[-1, 1], (1, 1), (1, 1)),
            root(&[-2, 0, 1], (7, 5), (3, 2)),
        );
        let g = &Poly::from_ints(&[-2, 0, 1]) * &Poly::from_ints(&[-1, 1]);
        assert_eq!(
            sign_between(&g, &one, Some(&sqrt2), &SignBudget::new()),
            Some(-1)
        );
        assert_eq!(sign_between(&g, &sqrt2, None, &SignBudget::new()), Some(1));
        assert_eq!(
            sign_between(&(&g * &g), &sqrt2, None, &SignBudget::new()),
            Some(1)
        );
        assert_eq!(
            sign_between(&Poly::from_ints(&[-3, 2]), &one, None, &SignBudget::new()),
            None
        );
        // A root within the isolating interval, on either side of the isolated one.
        assert_eq!(
            sign_between(
                &Poly::from_ints(&[-29, 20]),
                &sqrt2,
                None,
                &SignBudget::new()
            ),
            None
        );
        assert_eq!(
            sign_between(
                &Poly::from_ints(&[-141, 100]),
                &one,
                Some(&sqrt2),
                &SignBudget::new()
            ),
            None
        );
        assert_eq!(
            sign_between(&Poly::default(), &one, None, &SignBudget::new()),
            Some(0)
        );
        assert_eq!(
            [&g, &Poly::from_ints(&[-1, 1])].map(|p| sqrt2.sign(p, &SignBudget::new())),
            [Some(0), Some(1)]
        );
    }

    /// The sample lies above the last point: a root just below it does not count.
    #[test]
    fn the_sign_to_infinity_is_taken_above() {
        let three = root(&[-3, 1], (3, 1), (3, 1));
        assert_eq!(
            sign_between(&Poly::from_ints(&[-5, 2]), &three, None, &SignBudget::new()),
            Some(1)
        );
        assert_eq!(
            sign_between(&Poly::from_ints(&[5, -2]), &three, None, &SignBudget::new()),
            Some(-1)
        );
        let half = root(&[-1, 2], (1, 2), (1, 2));
        assert_eq!(
            sign_between(
                &Poly::from_ints(&[1, 4]),
                &half,
                Some(&three),
                &SignBudget::new()
            ),
            Some(1)
        );
    }

    /// sqrt 2 in [7/5, 3/2], with another root of g, 29/20, beside it: told whether or not sqrt 2
    /// is one as well.
    #[test]
    fn another_root_in_the_isolating_interval_is_seen() {
        let (sqrt2, nine) = (
            root(&[-2, 0, 1], (7, 5), (3, 2)),
            root(&[-9, 1], (9, 1), (9, 1)),
        );
        let (beside, far) = (Poly::from_ints(&[-29, 20]), Poly::from_ints(&[-10, 1]));
        let square = &sqrt2.poly * &sqrt2.poly;
        for g in [
            &beside * &far,
            &(&beside * &far) * &sqrt2.poly,
            &(&beside * &far) * &square,
        ] {
            assert_eq!(
                sign_between(&g, &sqrt2, Some(&nine), &SignBudget::new()),
                None
            );
        }
        assert_eq!(
            sign_between(&(&far * &square), &sqrt2, Some(&nine), &SignBudget::new()),
            Some(-1)
        );
        assert_eq!(
            sign_between(
                &(&far * &Poly::from_ints(&[-10, 3])),
                &sqrt2,
                Some(&nine),
                &SignBudget::new()
            ),
            None
        );
        assert_eq!(
            sign_between(
                &(&far * &Poly::from_ints(&[-1, 3])),
                &sqrt2,
                Some(&nine),
                &SignBudget::new()
            ),
            Some(-1)
        );
    }

    /// A half line from `a` is halved above `a`, also where that is negative.
    #[test]
    fn half_lines_are_halved_above_their_end() {
        // Complex roots about `at` and a real one.
        let with_roots = |at: i64, real: i64| {
            let complex = Poly::from_ints(&[100 * at * at + 1, -200 * at, 100]);
            &complex * &Poly::from_ints(&[-real, 1])
        };
        let is_free_from = |start: i64, at: i64, real: i64| {
            has_no_root(
                &with_roots(at, real),
                &whole(start),
                None,
                &SignBudget::new(),
            )
        };

        assert!(is_free_from(3, 8, 2)); // 2 is below
        assert!(is_free_from(-3, 1, -5));
        assert!(is_free_from(-3, -1, -5));

        assert!(!is_free_from(3, 8, 5));
        assert!(!is_free_from(3, 8, 30));
    }

    /// (t - c)^2 + 1/10^4 takes about seven halvings on the way to c, on either side of the middle.
    #[test]
    fn the_answer_is_no_when_the_halvings_are_used_up() {
        let near = |c: i64| Poly::from_ints(&[c * c * 100 + 1, -2000 * c, 10_000]); // c in tenths
        for c in [1, 19] {
            let of = |depth: u32, halvings: usize| {
                let (p, budget) = (near(c), SignBudget::new());
                let mut halving = Halving {
                    p: &p,
                    halvings,
                    budget: &budget,
                };
                let verdict = halving.has_none(&whole(0), Some(&whole(2)), depth);
                (verdict, halving.halvings)
            };
            let (verdict, left) = of(24, 200);
            let used = 200 - left;
            assert!(verdict && (4..20).contains(&used), "{c}: {used}");
            assert_eq!([of(24, used), of(24, used - 1)], [(true, 0), (false, 0)]);
            let depth = (0..24).find(|&d| of(d, 200).0).unwrap();
            assert!((4..20).contains(&depth), "{c}: {depth}");
            assert!(!of(depth - 1, 200).0 && of(0, 200) == (false, 200));
        }
    }

    /// (t - 1)^2 + 1/100 has three coefficients and takes some halvings. The ends 0 and 2 have 1 +
    /// 1 and 2 + 1 bits.
    #[test]
    fn a_budget_ends_the_halvings() {
        let p = Poly::from_ints(&[101, -200, 100]);
        let first = 27 * (1 + 3 + 64);
        let with = |left: u64| {
            let budget = SignBudget {
                left: Cell::new(left),
                is_spent: Cell::new(false),
            };
            let verdict = has_no_root(&p, &whole(0), Some(&whole(2)), &budget);
            (verdict, budget.is_spent(), budget.left.get())
        };

        let (verdict, is_spent, left) = with(1 << 30);
        assert!(verdict && !is_spent);
        let cost = (1 << 30) - left;
        assert!(cost > 2 * first, "{cost}");

        assert_eq!(with(cost), (true, false, 0));
        let (verdict, is_spent, _) = with(cost - 1);
        assert!(!verdict && is_spent);
        assert_eq!(with(first - 1), (false, true, first - 1));
    }

    #[test]
    fn coefficients_add_to_the_budget() {
        let budget = SignBudget::new();
        budget.add_coefficients(3);
        assert_eq!(budget.left.get(), (1 << 35) + 3 * (1 << 24));
        budget.add_coefficients(u64::MAX);
        assert_eq!(budget.left.get(), u64::MAX);
    }

    /// Three coefficients by two: two steps, and a divisor of at most 3 bits.
    #[test]
    fn remainders_spend_the_budget() {
        let (g, p) = (Poly::from_ints(&[1, 2, 3]), Poly::from_ints(&[-7, 2]));
        let cost = (2 * 2 * 3 * 67 * 67) >> 9;
        let with = |left: u64| {
            let budget = SignBudget {
                left: Cell::new(left),
                is_spent: Cell::new(false),
            };
            let is_told = root(&[-7, 2], (7, 2), (7, 2)).sign(&g, &budget).is_some();
            (is_told, budget.is_spent(), budget.left.get())
        };

        // What is left is a constant, evaluated over [7/2, 7/2] with 5 + 5 bits.
        let evaluation = (74 * 74) >> 8;
        assert_eq!(with(cost + evaluation), (true, false, 0));
        assert_eq!(with(cost + evaluation - 1), (false, true, evaluation - 1));
        assert_eq!(with(cost - 1), (false, true, cost - 1));

        // Nothing to divide costs nothing.
        let free = SignBudget {
            left: Cell::new(0),
            is_spent: Cell::new(false),
        };
        assert!(free.spend_remainder(&Poly::from_ints(&[5]), &p) && !free.is_spent());
    }
}
