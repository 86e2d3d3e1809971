//! Does a lifted pair satisfy every line of (9)? Decided exactly at an algebraic number.

use super::Lifted;
use crate::{ContactState, Direction, System, Unknown};
use mceip_exact::{Algebraic, Integer, Poly, Rational, Sign, common_denominator};
use num_traits::{One, Zero};

/// The lines of (9) that apply without z particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// v != 0.
    NonTrivial,
    /// w_f = 0.
    FreeReaction,
    /// v_d = 0.
    StickRate,
    /// v_Ns = 0.
    NormalRate,
    /// S v_Ts <= 0.
    SlipDirection,
    /// S w_Ts + mu w_Ns <= 0.
    FrictionCone,
    /// (S w_Ts + mu w_Ns) (S v_Ts) = 0.
    Complementarity,
}

/// A line of (9) that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("E9: line {line:?} fails at {place} {index}: got {got:?}")]
pub struct LineViolated {
    /// The line.
    pub line: Line,
    /// What `index` numbers: "dof" or "particle".
    pub place: &'static str,
    /// The dof or particle.
    pub index: usize,
    /// The sign found.
    pub got: Sign,
}

/// Checks every line of (9) at t = `value`. The first line, (t M + K) v = w, holds by
/// construction of [`super::lift`].
///
/// # Errors
/// The first line that fails, with its dof or particle.
pub fn check_lines(
    system: &System,
    unknown: Unknown,
    lifted: &Lifted,
    value: &mut Algebraic,
) -> Result<(), LineViolated> {
    if lifted.v.iter().all(|p| value.sign_of(p) == Sign::Zero) {
        return Err(LineViolated {
            line: Line::NonTrivial,
            place: "dof",
            index: 0,
            got: Sign::Zero,
        });
    }
    for dof in system.free_dofs() {
        require(
            Line::FreeReaction,
            "dof",
            dof,
            value.sign_of(&lifted.w[dof]),
            &[Sign::Zero],
        )?;
    }
    for (index, p) in system.particles().iter().enumerate() {
        match p.state {
            ContactState::Free => {}
            ContactState::Stick => {
                for dof in [p.tangential, p.normal] {
                    require(
                        Line::StickRate,
                        "particle",
                        index,
                        value.sign_of(&lifted.v[dof]),
                        &[Sign::Zero],
                    )?;
                }
            }
            ContactState::Slip { sign } => {
                let s = Rational::from_integer(sign.into());
                let v_n = combine(&p.into_obstacle(), &lifted.v, &Rational::one());
                require(
                    Line::NormalRate,
                    "particle",
                    index,
                    value.sign_of(&v_n),
                    &[Sign::Zero],
                )?;
                let slip = value.sign_of(&combine(&p.tangent(), &lifted.v, &s)); // S v_T
                require(
                    Line::SlipDirection,
                    "particle",
                    index,
                    slip,
                    &[Sign::Zero, Sign::Negative],
                )?;
                let cone = cone(
                    system,
                    unknown,
                    &p.tangent(),
                    &p.into_obstacle(),
                    &s,
                    &lifted.w,
                );
                let cone = value.sign_of(&cone);
                require(
                    Line::FrictionCone,
                    "particle",
                    index,
                    cone,
                    &[Sign::Zero, Sign::Negative],
                )?;
                let product = if slip == Sign::Zero || cone == Sign::Zero {
                    Sign::Zero
                } else {
                    Sign::Positive
                };
                require(
                    Line::Complementarity,
                    "particle",
                    index,
                    product,
                    &[Sign::Zero],
                )?;
            }
        }
    }
    Ok(())
}

fn require(
    line: Line,
    place: &'static str,
    index: usize,
    got: Sign,
    allowed: &[Sign],
) -> Result<(), LineViolated> {
    if allowed.contains(&got) {
        Ok(())
    } else {
        Err(LineViolated {
            line,
            place,
            index,
            got,
        })
    }
}

/// S t'w + mu n'w as a polynomial; mu is the number itself for MCEIP-mu.
fn cone(
    system: &System,
    unknown: Unknown,
    tangent: &Direction,
    normal: &Direction,
    s: &Rational,
    w: &[Poly],
) -> Poly {
    let mu = match (unknown, system.friction()) {
        (Unknown::Lambda2, Some(mu)) => mu.clone(),
        _ => Rational::one(),
    };
    let weights: Vec<Rational> = tangent
        .iter()
        .map(|(_, c)| c * s)
        .chain(normal.iter().map(|(_, c)| c * &mu))
        .collect();
    let clear = common_denominator(&weights);
    let integral = |c: &Rational, factor: &Rational| {
        (c * factor * Rational::from_integer(clear.clone())).to_integer()
    };
    let w_t = sum(tangent
        .iter()
        .map(|(dof, c)| w[*dof].scale(&integral(c, s))));
    let w_n = sum(normal
        .iter()
        .map(|(dof, c)| w[*dof].scale(&integral(c, &mu))));
    match unknown {
        Unknown::Lambda2 => &w_t + &w_n,
        Unknown::Mu => &w_t + &w_n.shift(1),
    }
}

/// A positive multiple of factor * d'p.
fn combine(d: &Direction, p: &[Poly], factor: &Rational) -> Poly {
    let clear =
        Rational::from_integer(common_denominator(d.iter().map(|(_, c)| c)) * factor.denom());
    let integral = |c: &Rational| -> Integer { (c * factor * &clear).to_integer() };
    debug_assert!(
        d.iter()
            .all(|(_, c)| (c * factor * &clear).is_integer() && !clear.is_zero())
    );
    sum(d.iter().map(|(dof, c)| p[*dof].scale(&integral(c))))
}

fn sum(terms: impl Iterator<Item = Poly>) -> Poly {
    terms.fold(Poly::default(), |a, b| &a + &b)
}
