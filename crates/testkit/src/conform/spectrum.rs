//! Eigenpairs of supports that are no solutions: a program that skips a check reports them.
//!
//! For a support J with active variables J and the free ones, the pair (t, x) solves
//! (A + tB) x = 0 on the rows and columns of the active variables. It is a solution only if x > 0
//! on J and y = (A + tB) x >= 0 elsewhere. Input: a pencil and an interval of values. Output: the
//! pairs of all supports, exact, and what kind each is. Called by `wrong`, which makes wrong
//! answers of them.

use mceip_exact::{Algebraic, Poly, Rational, Sign, kernel_at, roots_in};
use mceip_oracle::{IntegerPencil, Solution};

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
/// max]. `slip` are the complementarity variables.
pub(super) fn eigenpairs(
    pencil: &IntegerPencil<'_>,
    slip: &[usize],
    min: &Rational,
    max: Option<&Rational>,
) -> Vec<(EigenvectorKind, Solution)> {
    let mut out = Vec::new();
    for mask in 1..1u64 << slip.len() {
        let mut support = Vec::new();
        for (k, &i) in slip.iter().enumerate() {
            if mask >> k & 1 == 1 {
                support.push(i);
            }
        }
        out.extend(eigenpairs_of(pencil, &support, min, max));
    }
    out
}

/// The eigenpairs of one support; none if its pencil is singular.
fn eigenpairs_of(
    pencil: &IntegerPencil<'_>,
    support: &[usize],
    min: &Rational,
    max: Option<&Rational>,
) -> Vec<(EigenvectorKind, Solution)> {
    let active = pencil.active(support);
    let determinant = pencil.determinant(&active);
    if determinant.is_zero() {
        return Vec::new();
    }

    let mut out = Vec::new();
    for mut value in roots_in(&determinant, min, max) {
        let kernel = kernel_at(pencil.block(&active), &mut value);
        if let [vector] = &kernel[..] {
            let x = pencil.extend(&active, vector);
            out.extend(eigenpair(pencil, value, x, support));
        }
    }
    out
}

/// The pair with its kind. The sign of x is that which makes its first component on the support
/// that is not zero positive. `None` if x vanishes on the support, or if e'x_s is zero: x is
/// printed over it.
fn eigenpair(
    pencil: &IntegerPencil<'_>,
    mut value: Algebraic,
    mut x: Vec<Poly>,
    support: &[usize],
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
    let active = pencil.active(support);
    let y = pencil.times(&x);
    let y_is_negative = (0..pencil.order())
        .filter(|i| !active.contains(i))
        .any(|i| value.sign_of(&y[i]) == Sign::Negative);
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
