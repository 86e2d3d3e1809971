//! Eigenpairs of supports that are no solutions: a program that skips a check reports them.
//!
//! For a support J with active variables J and the free ones, the pair (t, x) solves
//! (A + tB) x = 0 on the rows and columns of the active variables. It is a solution only if x > 0
//! on J and y = (A + tB) x >= 0 elsewhere. Input: a pencil and an interval of values. Output: the
//! pairs of all supports, exact, and what kind each is. Called by `wrong`, which makes wrong
//! answers of them.

use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, determinant, kernel_at, roots_in, submatrix,
};
use mceip_model::Pencil;
use mceip_oracle::Solution;

/// What the eigenvector of a support looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EigenvectorKind {
    /// x > 0 on the support, y >= 0 elsewhere.
    Admissible,
    /// x > 0 on the support, y < 0 somewhere.
    NegativeY,
    /// x has both signs, or vanishes somewhere, on the support.
    MixedX,
}

/// Eigenpairs with one-dimensional kernels of all supports but the empty one, with values in [min,
/// max].
pub(super) fn eigenpairs(
    pencil: &Pencil,
    min: &Rational,
    max: Option<&Rational>,
) -> Vec<(EigenvectorKind, Solution)> {
    let integral = IntegralPencil::of(pencil);
    let slip = pencil.slip();

    let mut out = Vec::new();
    for mask in 1..1u64 << slip.len() {
        let mut support = Vec::new();
        for (k, &i) in slip.iter().enumerate() {
            if mask >> k & 1 == 1 {
                support.push(i);
            }
        }
        out.extend(integral.eigenpairs_of(&support, min, max));
    }
    out
}

/// A pencil whose rows of A and B are multiplied by common positive factors, so that they are
/// integers. Solutions are the same, and so are the signs of y.
struct IntegralPencil<'a> {
    free: &'a [usize],
    a: Vec<Vec<Integer>>,
    b: Vec<Vec<Integer>>,
}

impl IntegralPencil<'_> {
    fn of(pencil: &Pencil) -> IntegralPencil<'_> {
        let (a, b) = pencil.a().to_dense().clear_rows(&pencil.b().to_dense());
        IntegralPencil {
            free: pencil.free(),
            a,
            b,
        }
    }

    fn order(&self) -> usize {
        self.a.len()
    }

    /// a_ij + t b_ij.
    fn entry(&self, i: usize, j: usize) -> Poly {
        Poly::new(vec![self.a[i][j].clone(), self.b[i][j].clone()])
    }

    /// The eigenpairs of one support; none if its pencil is singular.
    fn eigenpairs_of(
        &self,
        support: &[usize],
        min: &Rational,
        max: Option<&Rational>,
    ) -> Vec<(EigenvectorKind, Solution)> {
        let mut active: Vec<usize> = self.free.iter().chain(support).copied().collect();
        active.sort_unstable();

        let [a, b] = [&self.a, &self.b].map(|rows| submatrix(rows, &active, &active));
        let determinant = determinant(&a, &b);
        if determinant.is_zero() {
            return Vec::new();
        }

        let mut out = Vec::new();
        for mut value in roots_in(&determinant, min, max) {
            let kernel = kernel_at(self.polynomial_block(&active), &mut value);
            if let [vector] = &kernel[..] {
                let x = self.spread(vector, &active);
                out.extend(self.eigenpair(value, x, support, &active));
            }
        }
        out
    }

    /// A + tB on the active rows and columns.
    fn polynomial_block(&self, active: &[usize]) -> Vec<Vec<Poly>> {
        active
            .iter()
            .map(|&i| active.iter().map(|&j| self.entry(i, j)).collect())
            .collect()
    }

    /// The vector over all variables, zero where they are not active.
    fn spread(&self, vector: &[Poly], active: &[usize]) -> Vec<Poly> {
        let mut x = vec![Poly::default(); self.order()];
        for (&i, component) in active.iter().zip(vector) {
            x[i] = component.clone();
        }
        x
    }

    /// The pair with its kind. The sign of x is that which makes its first component on the support
    /// that is not zero positive. `None` if x vanishes on the support, or if e'x_s is zero: x is
    /// printed over it.
    fn eigenpair(
        &self,
        mut value: Algebraic,
        mut x: Vec<Poly>,
        support: &[usize],
        active: &[usize],
    ) -> Option<(EigenvectorKind, Solution)> {
        let first = support
            .iter()
            .map(|&i| value.sign_of(&x[i]))
            .find(|s| *s != Sign::Zero)?;
        if first == Sign::Negative {
            x.iter_mut().for_each(|p| *p = -&*p);
        }

        let x_is_positive = support
            .iter()
            .all(|&i| value.sign_of(&x[i]) == Sign::Positive);
        let y_is_negative = (0..self.order())
            .filter(|i| !active.contains(i))
            .any(|i| value.sign_of(&self.image(i, &x)) == Sign::Negative);
        let kind = match (x_is_positive, y_is_negative) {
            (false, _) => EigenvectorKind::MixedX,
            (true, true) => EigenvectorKind::NegativeY,
            (true, false) => EigenvectorKind::Admissible,
        };

        let mut sum = Poly::default();
        for &i in support {
            sum = &sum + &x[i];
        }
        if value.sign_of(&sum) == Sign::Zero {
            return None;
        }

        let solution = Solution {
            value,
            multiplicity: 1,
            slip: support.to_vec(),
            biactive: Vec::new(),
            x,
            y: Vec::new(),
        };
        Some((kind, solution))
    }

    /// y_i = sum over j of (a_ij + t b_ij) x_j.
    fn image(&self, i: usize, x: &[Poly]) -> Poly {
        let mut sum = Poly::default();
        for (j, component) in x.iter().enumerate() {
            sum = &sum + &(&self.entry(i, j) * component);
        }
        sum
    }
}
