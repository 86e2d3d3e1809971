//! The way back: from (t, x) of the pencil to (v, w) over all degrees of freedom of (9).

use super::Variable;
use crate::{System, Unknown};
use mceip_exact::{Integer, Poly, Rational, Sparse, common_denominator};
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

/// Lifts x (integer polynomials in t) to v and w = (t M + K) v, or K v for MCEIP-mu. // E10, E9
///
/// Stick particles and normal dofs of slip particles get v = 0. Directions may be oblique, so v
/// and w are multiplied by positive integers that clear denominators, given beside them.
pub fn lift(system: &System, unknown: Unknown, variables: &[Variable], x: &[Poly]) -> Lifted {
    let mut v: Vec<Vec<Rational>> = vec![Vec::new(); system.dofs()];
    for (variable, x_i) in variables.iter().zip(x) {
        match variable {
            Variable::Free { dof } => add(&mut v[*dof], x_i, &Rational::from_integer(1.into()), 0),
            Variable::Slip { sign, tangent, .. } => {
                for (dof, c) in tangent {
                    add(
                        &mut v[*dof],
                        x_i,
                        &(c * Rational::from_integer((-*sign).into())),
                        0,
                    ); // v_T = -S x
                }
            }
        }
    }
    let v_scale = common_denominator(v.iter().flatten());
    let v: Vec<Poly> = v.into_iter().map(|c| to_poly(&c, &v_scale)).collect();
    let mut w: Vec<Vec<Rational>> = vec![Vec::new(); system.dofs()];
    accumulate(&mut w, system.stiffness(), &v, 0);
    if let (Unknown::Lambda2, Some(mass)) = (unknown, system.mass()) {
        accumulate(&mut w, mass, &v, 1);
    }
    let clear = common_denominator(w.iter().flatten());
    let w = w.into_iter().map(|c| to_poly(&c, &clear)).collect();
    Lifted {
        v,
        w,
        w_scale: &v_scale * clear,
        v_scale,
    }
}

/// out += t^shift * m * v.
fn accumulate(out: &mut [Vec<Rational>], m: &Sparse, v: &[Poly], shift: usize) {
    for (i, j, value) in m.entries() {
        add(&mut out[i], &v[j], value, shift);
    }
}

/// sum += factor * t^shift * p.
fn add(sum: &mut Vec<Rational>, p: &Poly, factor: &Rational, shift: usize) {
    if sum.len() < p.coeffs().len() + shift {
        sum.resize(p.coeffs().len() + shift, Rational::zero());
    }
    for (k, c) in p.coeffs().iter().enumerate() {
        sum[k + shift] += factor * Rational::from_integer(c.clone());
    }
}

/// factor * coefficients, where the factor clears every denominator.
fn to_poly(coeffs: &[Rational], factor: &Integer) -> Poly {
    Poly::new(
        coeffs
            .iter()
            .map(|c| c.numer() * (factor / c.denom()))
            .collect(),
    )
}
