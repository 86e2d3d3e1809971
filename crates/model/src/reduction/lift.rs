//! The way back: from (t, x) of the pencil to (v, w) over all degrees of freedom of (9).
//!
//! By (10), v_f = x_f and v_T = -S x for the slip particles; all other components of v vanish. By
//! the first line of (9), w = (t M + K) v, or w = K v for MCEIP-mu, where t is mu.
//!
//! x is given by integer polynomials in t. K, M and oblique directions are rational, so v and w are
//! multiplied by positive integers that clear all denominators, given beside them.
//!
//! Called by `engine` for reports; [`super::check_lines`] holds the result against (9).

use crate::{ReducedVariable, System, Unknown};
use mceip_exact::{Integer, Poly, Rational, Sparse, cleared, common_denominator};
use num_traits::Zero;

/// Polynomials in t, to be evaluated at the solution's value; index = degree of freedom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lifted {
    /// `v_scale` times v, the displacement rate direction.
    pub v: Vec<Poly>,
    /// Positive factor that makes v integral (1 without oblique particles).
    pub v_scale: Integer,
    /// `w_scale` times w, the reaction rate direction.
    pub w: Vec<Poly>,
    /// Positive factor that makes w integral.
    pub w_scale: Integer,
}

/// Lifts x (integer polynomials in t) to v (10) and w = (t M + K) v (9), or w = K v for MCEIP-mu.
///
/// `variables` says what each entry of `x` stands for, as [`super::reduce`] gave it.
pub fn lift(
    system: &System,
    unknown: Unknown,
    variables: &[ReducedVariable],
    x: &[Poly],
) -> Lifted {
    let mut v = RationalVector::zero(system.dofs());
    for (variable, x_j) in variables.iter().zip(x) {
        for (dof, coefficient) in variable.column() {
            add_scaled(&mut v.0[dof], &coefficient, x_j, 0);
        }
    }

    let v = v.cleared();

    let mut w = RationalVector::zero(system.dofs());
    w.add_product(system.stiffness(), &v.entries, 0);
    if unknown == Unknown::Lambda2
        && let Some(mass) = system.mass()
    {
        w.add_product(mass, &v.entries, 1);
    }

    let w = w.cleared();

    Lifted {
        v: v.entries,
        w: w.entries,
        w_scale: &v.scale * w.scale,
        v_scale: v.scale,
    }
}

/// A vector of polynomials with rational coefficients: for each degree of freedom the coefficients
/// of 1, t, t^2, ...
struct RationalVector(Vec<Vec<Rational>>);

/// `scale` times a rational vector.
struct ClearedVector {
    entries: Vec<Poly>,
    scale: Integer,
}

impl RationalVector {
    fn zero(dofs: usize) -> RationalVector {
        RationalVector(vec![Vec::new(); dofs])
    }

    /// self += t^power matrix v.
    fn add_product(&mut self, matrix: &Sparse, v: &[Poly], power: usize) {
        for (i, j, entry) in matrix.entries() {
            add_scaled(&mut self.0[i], entry, &v[j], power);
        }
    }

    /// The vector times the common denominator of all its coefficients.
    fn cleared(self) -> ClearedVector {
        let scale = common_denominator(self.0.iter().flatten());
        let mut entries = Vec::with_capacity(self.0.len());

        for coefficients in &self.0 {
            let integers = coefficients.iter().map(|c| cleared(c, &scale));
            entries.push(Poly::new(integers.collect()));
        }

        ClearedVector { entries, scale }
    }
}

/// sum += factor t^power p, where `sum` holds the coefficients of 1, t, t^2, ...
fn add_scaled(sum: &mut Vec<Rational>, factor: &Rational, p: &Poly, power: usize) {
    let length = p.coeffs().len() + power;
    if sum.len() < length {
        sum.resize(length, Rational::zero());
    }

    for (k, coefficient) in p.coeffs().iter().enumerate() {
        sum[k + power] += factor * Rational::from_integer(coefficient.clone());
    }
}
