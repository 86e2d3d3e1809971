//! The budget for the signs of polynomials on support leaves.
//!
//! All support leaves of a file share one budget (`spec/certificates.md`, Limits). Before a
//! polynomial is multiplied, transformed, divided or evaluated, what that costs is taken from the
//! budget. The unit is the addition of a bit; a product of two words of 64 bits counts as 2^7.
//!
//! The counts depend on lengths only: on the number of coefficients and on the bits of the longest
//! one. They do not depend on how a checker scales what it has computed: a remainder is counted
//! with the bits it can have at most, and what is left of a polynomial without some factors is
//! counted with the bits of the whole. So every checker counts the same.
//!
//! Called by `support` and `rootless`.

use super::ends::rational_bits;
use mceip_exact::{Integer, Poly, Rational};
use std::cell::Cell;

/// What a file may count without any coefficient, and for each coefficient of its support leaves.
const BASE_BUDGET: u64 = 1 << 35;
const BUDGET_PER_COEFFICIENT: u64 = 1 << 24;
/// Added to the bits of numbers that are added: a word.
const WORD: u64 = 64;
/// Added to the bits of the factors of a product: what two short numbers cost beside their bits.
const SHORT_FACTOR: u64 = 256;
/// A product with an entry of the pencil counts 2^-5 of coefficients x bits x bits.
const PRODUCT_SHIFT: u32 = 5;
/// A remainder counts 2^-9 of steps x coefficients x bits of the divisor x bits of the result.
const REMAINDER_SHIFT: u32 = 9;
/// Horner's rule at a point counts 2^-8 of the bits by which a number grows x its bits in the end.
const EVALUATION_SHIFT: u32 = 8;
/// Ends of more than 2^10 bits are long factors: a product with one takes as many times longer.
const LONG_ENDS_SHIFT: u32 = 10;

/// How long a polynomial is.
#[derive(Clone, Copy)]
pub(super) struct PolySize {
    pub(super) coefficients: u64,
    /// Of the longest coefficient.
    pub(super) bits: u64,
}

impl PolySize {
    pub(super) fn of(p: &Poly) -> PolySize {
        PolySize {
            coefficients: p.coeffs().len() as u64,
            bits: p.coeffs().iter().map(Integer::bits).max().unwrap_or(0),
        }
    }

    /// The size of the remainder by a divisor, if it has this many coefficients: every step of the
    /// division makes the coefficients longer by those of the divisor.
    pub(super) fn of_remainder(self, divisor: &Poly, coefficients: usize) -> PolySize {
        let divisor = PolySize::of(divisor);
        let growth = self.steps(divisor).saturating_mul(divisor.bits + WORD);

        PolySize {
            coefficients: coefficients as u64,
            bits: self.bits.saturating_add(growth),
        }
    }

    /// Steps of a division: each removes one coefficient.
    fn steps(self, divisor: PolySize) -> u64 {
        (self.coefficients + 1).saturating_sub(divisor.coefficients)
    }
}

/// What is left of the counts of a file.
pub(super) struct SignBudget {
    left: Cell<u64>,
    is_spent: Cell<bool>,
}

impl SignBudget {
    pub(super) fn new() -> Self {
        SignBudget::of(BASE_BUDGET)
    }

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

    /// Takes what the product of the polynomial with an entry a + bt of the pencil costs; false if
    /// that is more than is left.
    pub(super) fn spend_product(&self, p: &Poly, a: &Integer, b: &Integer) -> bool {
        let size = PolySize::of(p);
        let entry_bits = a.bits().max(b.bits());

        let products = (size.bits + SHORT_FACTOR).saturating_mul(entry_bits + SHORT_FACTOR);
        self.take(products.saturating_mul(size.coefficients) >> PRODUCT_SHIFT)
    }

    /// Takes what the remainder of a polynomial of this size by p costs.
    pub(super) fn spend_remainder(&self, size: PolySize, p: &Poly) -> bool {
        let divisor = PolySize::of(p);
        let steps = size.steps(divisor);
        let factor_bits = divisor.bits + WORD;
        let result_bits = size.bits.saturating_add(steps.saturating_mul(factor_bits));

        let products = steps.saturating_mul(size.coefficients);
        let cost = products
            .saturating_mul(factor_bits)
            .saturating_mul(result_bits);
        self.take(cost >> REMAINDER_SHIFT)
    }

    /// Takes what Horner's rule over [lo, hi] costs: its numbers grow by the bits of the ends at
    /// each coefficient.
    pub(super) fn spend_evaluation(&self, size: PolySize, lo: &Rational, hi: &Rational) -> bool {
        let ends_bits = rational_bits(lo) + rational_bits(hi) + WORD;
        let growth = ends_bits.saturating_mul(size.coefficients);

        let cost = growth.saturating_mul(growth.saturating_add(size.bits));
        self.take(cost >> EVALUATION_SHIFT)
    }

    /// Takes what transforming a polynomial to (a, b) by Descartes' rule costs (`None`: infinity):
    /// half the square of its coefficients, as additions of numbers that grow by the bits of the
    /// ends at each coefficient.
    pub(super) fn spend_transformation(
        &self,
        size: PolySize,
        a: &Rational,
        b: Option<&Rational>,
    ) -> bool {
        let ends_bits = rational_bits(a) + b.map_or(0, rational_bits);
        let growth = size.coefficients.saturating_mul(ends_bits + WORD);
        let square = size.coefficients.saturating_pow(2);

        let additions = square.saturating_mul(growth.saturating_add(size.bits));
        let length_of_factors = 1 + (ends_bits >> LONG_ENDS_SHIFT);
        self.take(additions.saturating_mul(length_of_factors))
    }

    fn take(&self, cost: u64) -> bool {
        match self.left.get().checked_sub(cost) {
            Some(left) => self.left.set(left),
            None => self.is_spent.set(true),
        }

        !self.is_spent.get()
    }

    #[cfg(test)]
    pub(super) fn left(&self) -> u64 {
        self.left.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// What the work takes of a large budget; with one unit less than that the budget is spent.
    fn cost(work: impl Fn(&SignBudget) -> bool) -> u64 {
        let large = SignBudget::of(1 << 60);
        assert!(work(&large));
        let cost = (1 << 60) - large.left();

        let exact = SignBudget::of(cost);
        assert!(work(&exact));
        assert!(!exact.is_spent());
        assert_eq!(exact.left(), 0);

        if let Some(less) = cost.checked_sub(1) {
            let short = SignBudget::of(less);
            assert!(!work(&short));
            assert!(short.is_spent());
            assert_eq!(short.left(), less);
        }

        cost
    }

    #[test]
    fn coefficients_add_to_the_budget() {
        let budget = SignBudget::new();
        budget.add_coefficients(3);
        assert_eq!(budget.left(), (1 << 35) + 3 * (1 << 24));

        budget.add_coefficients(u64::MAX);
        assert_eq!(budget.left(), u64::MAX);
    }

    /// Three coefficients of at most 2 bits, times 5 + 1000 t, of at most 10 bits.
    #[test]
    fn products_count_both_factors() {
        let p = Poly::from_ints(&[1, 2, 3]);
        let expected = (3 * (2 + 256) * (10 + 256)) >> 5;

        assert_eq!(
            cost(|budget| budget.spend_product(&p, &5.into(), &1000.into())),
            expected
        );
        assert_eq!(
            cost(|budget| budget.spend_product(&p, &(-1000).into(), &5.into())),
            expected
        );

        let zero = Poly::default();
        assert_eq!(
            cost(|budget| budget.spend_product(&zero, &5.into(), &5.into())),
            0
        );
    }

    /// Three coefficients of 2 bits by two of at most 3 bits: two steps, each of which adds 3 + 64
    /// bits.
    #[test]
    fn remainders_count_their_steps() {
        let g = PolySize::of(&Poly::from_ints(&[1, 2, 3]));
        let p = Poly::from_ints(&[-7, 2]);
        let result_bits = 2 + 2 * 67;

        let taken = cost(|budget| budget.spend_remainder(g, &p));
        assert_eq!(taken, (2 * 3 * 67 * result_bits) >> 9);

        let remainder = g.of_remainder(&p, 1);
        assert_eq!((remainder.coefficients, remainder.bits), (1, result_bits));
    }

    /// A constant by a polynomial of two coefficients: nothing is divided.
    #[test]
    fn no_step_of_a_division_costs_nothing() {
        let constant = PolySize::of(&Poly::from_ints(&[5]));
        let p = Poly::from_ints(&[-7, 2]);

        assert_eq!(cost(|budget| budget.spend_remainder(constant, &p)), 0);
        assert_eq!(constant.of_remainder(&p, 1).bits, 3);
    }

    /// Three coefficients of 2 bits over [7/2, 4], whose ends have 3 + 2 and 3 + 1 bits.
    #[test]
    fn evaluations_count_the_growth_of_their_numbers() {
        let p = PolySize::of(&Poly::from_ints(&[1, 2, 3]));
        let growth = 3 * (9 + 64);

        let taken = cost(|budget| budget.spend_evaluation(p, &rational(7, 2), &whole(4)));
        assert_eq!(taken, (growth * (growth + 2)) >> 8);
    }

    /// Three coefficients of 7 bits on (0, 2), whose ends have 0 + 1 and 2 + 1 bits, and on the
    /// half line from 0.
    #[test]
    fn transformations_count_their_additions() {
        let p = PolySize::of(&Poly::from_ints(&[101, -100, 100]));
        let zero = whole(0);

        let finite = cost(|budget| budget.spend_transformation(p, &zero, Some(&whole(2))));
        assert_eq!(finite, 9 * (3 * (4 + 64) + 7));

        let half_line = cost(|budget| budget.spend_transformation(p, &zero, None));
        assert_eq!(half_line, 9 * (3 * (1 + 64) + 7));
    }

    /// Ends of 2,048 bits together count three times.
    #[test]
    fn long_ends_are_long_factors() {
        let p = PolySize::of(&Poly::from_ints(&[1, 1]));
        let long = Rational::from_integer(Integer::from(1) << 2045_u32);

        let taken = cost(|budget| budget.spend_transformation(p, &whole(0), Some(&long)));
        assert_eq!(taken, 4 * (2 * (2048 + 64) + 1) * 3);
    }
}
