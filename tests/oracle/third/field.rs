//! The field Q(alpha) of a real algebraic number, and null spaces of matrices over it.
//!
//! An element is a polynomial in alpha, taken modulo a squarefree polynomial p with p(alpha) = 0.
//! p may have more roots than alpha. Where that shows, because an element and p have a common
//! factor, p is replaced by the factor that vanishes at alpha. Null spaces are computed by Gauss
//! elimination with division.

use super::poly::{
    Bracket, Polynomial, add, compose, derivative, divide, eval, gcd, half, integer, magnitude,
    monic, multiply, negate, scale, sign_changes, trim,
};
use dashu_ratio::RBig;

/// A real number: the only root of `p` in (lo, hi), or the point lo = hi.
#[derive(Debug, Clone)]
pub struct Alpha {
    pub p: Polynomial,
    pub lo: RBig,
    pub hi: RBig,
}

impl Alpha {
    /// The root of `p` in a bracket, which is shrunk until its ends are no roots.
    pub fn new(p: &[RBig], bracket: Bracket) -> Alpha {
        let Bracket { lo, hi } = bracket;
        if lo == hi {
            return Alpha::rational(lo);
        }

        let p = monic(p);
        let mut alpha = Alpha { p, lo, hi };

        while alpha.has_root_at_an_end() {
            let mid = alpha.middle();
            let left_half = compose(&alpha.p, &alpha.lo, &(&mid - &alpha.lo));

            if eval(&alpha.p, &mid) == RBig::ZERO {
                alpha = Alpha::rational(mid);
            } else if sign_changes(&left_half) == 1 {
                alpha.hi = mid;
            } else {
                alpha.lo = mid;
            }
        }
        alpha
    }

    pub fn rational(value: RBig) -> Alpha {
        Alpha {
            p: vec![-value.clone(), integer(1)],
            lo: value.clone(),
            hi: value,
        }
    }

    fn is_point(&self) -> bool {
        self.lo == self.hi
    }

    fn middle(&self) -> RBig {
        (&self.lo + &self.hi) * half()
    }

    fn has_root_at_an_end(&self) -> bool {
        if self.is_point() {
            return false;
        }
        let root_at_lo = eval(&self.p, &self.lo) == RBig::ZERO;
        let root_at_hi = eval(&self.p, &self.hi) == RBig::ZERO;
        root_at_lo || root_at_hi
    }

    /// Takes the half of the interval that holds the root.
    pub fn halve(&mut self) {
        let mid = self.middle();
        let at_mid = eval(&self.p, &mid);
        let at_hi = eval(&self.p, &self.hi);

        if at_mid == RBig::ZERO {
            *self = Alpha::rational(mid);
        } else if (at_mid > RBig::ZERO) == (at_hi > RBig::ZERO) {
            self.hi = mid;
        } else {
            self.lo = mid;
        }
    }

    /// The element modulo p.
    pub fn reduce(&self, element: &[RBig]) -> Polynomial {
        divide(element, &self.p).remainder
    }

    /// Does the element vanish here? A common factor with p splits p.
    pub fn is_zero(&mut self, element: &[RBig]) -> bool {
        let element = self.reduce(element);
        if element.is_empty() {
            return true;
        }

        let common = gcd(&element, &self.p);
        if common.len() <= 1 {
            return false;
        }

        // Exactly one of the two factors vanishes at alpha: the one that changes its sign inside.
        let other = divide(&self.p, &common).quotient;
        let vanishes = self.is_point() || {
            let positive_at_lo = eval(&common, &self.lo) > RBig::ZERO;
            let positive_at_hi = eval(&common, &self.hi) > RBig::ZERO;
            positive_at_lo != positive_at_hi
        };

        self.p = monic(if vanishes { &common } else { &other });
        vanishes
    }

    /// The sign of an element as 1, 0 or -1.
    ///
    /// Where it is not zero, the interval is halved until the value at its middle is larger than
    /// its width times a bound of the derivative.
    pub fn sign(&mut self, element: &[RBig]) -> i8 {
        if self.is_zero(element) {
            return 0;
        }
        let element = self.reduce(element);
        let mut slope_magnitudes = Polynomial::new();
        for c in derivative(&element) {
            slope_magnitudes.push(magnitude(&c));
        }

        loop {
            let largest = magnitude(&self.lo).max(magnitude(&self.hi));
            let steepest = eval(&slope_magnitudes, &largest);
            let slack = steepest * (&self.hi - &self.lo);

            let value = eval(&element, &self.middle());
            if magnitude(&value) > slack {
                return if value > RBig::ZERO { 1 } else { -1 };
            }
            self.halve();
        }
    }

    /// 1 / element modulo p by the extended Euclidean algorithm; the element is not zero here.
    ///
    /// Every remainder r that occurs has a cofactor s with s * element = r modulo p.
    fn invert(&mut self, element: &[RBig]) -> Polynomial {
        assert!(!self.is_zero(element));
        let mut remainder = self.p.clone();
        let mut cofactor = Polynomial::new();
        let mut next_remainder = self.reduce(element);
        let mut next_cofactor = vec![integer(1)];

        while !next_remainder.is_empty() {
            let division = divide(&remainder, &next_remainder);
            let product = multiply(&division.quotient, &next_cofactor);
            let difference = add(&cofactor, &negate(&product));

            remainder = next_remainder;
            next_remainder = division.remainder;
            cofactor = next_cofactor;
            next_cofactor = difference;
        }

        let constant = integer(1) / &remainder[0];
        self.reduce(&scale(&cofactor, &constant))
    }

    /// A basis of the null space of a matrix: one vector for each column without a pivot.
    pub fn null_space(
        &mut self,
        mut matrix: Vec<Vec<Polynomial>>,
        columns: usize,
    ) -> Vec<Vec<Polynomial>> {
        let pivots = self.eliminate(&mut matrix, columns);
        let mut basis = Vec::new();

        for column in 0..columns {
            if pivots.contains(&column) {
                continue;
            }
            let mut vector = vec![Polynomial::new(); columns];
            vector[column] = vec![integer(1)];
            for (row, &pivot) in pivots.iter().enumerate() {
                vector[pivot] = negate(&trim(matrix[row][column].clone()));
            }
            basis.push(vector);
        }
        basis
    }

    /// Brings the matrix to reduced row echelon form; returns the columns of its pivots.
    fn eliminate(&mut self, matrix: &mut [Vec<Polynomial>], columns: usize) -> Vec<usize> {
        let mut pivots = Vec::new();

        for column in 0..columns {
            let top = pivots.len();
            let mut candidates = top..matrix.len();
            let Some(row) = candidates.find(|&row| !self.is_zero(&matrix[row][column])) else {
                continue;
            };

            matrix.swap(top, row);
            let inverse = self.invert(&matrix[top][column]);
            matrix[top] = self.multiple_of_row(&matrix[top], &inverse);

            for other in 0..matrix.len() {
                if other == top {
                    continue;
                }
                let factor = negate(&matrix[other][column]);
                let multiple = self.multiple_of_row(&matrix[top], &factor);
                matrix[other] = self.sum_of_rows(&matrix[other], &multiple);
            }
            pivots.push(column);
        }
        pivots
    }

    fn multiple_of_row(&self, row: &[Polynomial], factor: &[RBig]) -> Vec<Polynomial> {
        row.iter()
            .map(|entry| self.reduce(&multiply(entry, factor)))
            .collect()
    }

    fn sum_of_rows(&self, left: &[Polynomial], right: &[Polynomial]) -> Vec<Polynomial> {
        left.iter()
            .zip(right)
            .map(|(l, r)| self.reduce(&add(l, r)))
            .collect()
    }

    /// Compares alpha with a rational number: 1 if alpha is larger, 0 if equal, -1 if smaller.
    pub fn compare_to(&mut self, value: &RBig) -> i8 {
        self.sign(&[-value.clone(), integer(1)])
    }

    /// Is this the number that `p` has in the closed interval from lo to hi?
    pub fn is_root_in(&mut self, p: &[RBig], lo: &RBig, hi: &RBig) -> bool {
        if !self.is_zero(p) {
            return false;
        }
        self.compare_to(lo) >= 0 && self.compare_to(hi) <= 0
    }
}
