//! Does a lifted pair (v, w) satisfy every line of (9)? Decided exactly at an algebraic number.
//!
//! | particles | lines of (9) |
//! |---|---|
//! | all | v != 0 |
//! | f | w_f = 0 |
//! | d (stick) | v_d = 0 |
//! | s (slip) | v_N = 0, S v_T <= 0, cone <= 0, and the product of the last two is 0 |
//! | z (zero reaction) | v_N <= 0, w_N <= 0, v_N w_N = 0, abs(w_T) + mu w_N <= 0 |
//! | z that slides | w_T = mu sign(v_T) w_N |
//!
//! with cone = S w_T + mu w_N, and (1 + mu^2) g S v_T more on a curved obstacle
//! (`spec/curvature.md`), mu that of the particle.
//!
//! Each side is a polynomial in t up to a positive factor; its sign at t decides the line. The
//! first line of (9), (t M + K) v = w, holds by construction of [`super::lift`].
//!
//! Called by `testkit` and the tests, which hold every lifted solution against (9).

use super::Lifted;
use crate::{ContactState, Direction, Particle, System, Unknown};
use mceip_exact::{Algebraic, Integer, Poly, Rational, Sign, cleared, common_denominator};
use num_traits::{One, Zero};

/// The lines of (9).
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
    /// v_Nz <= 0.
    GapRate,
    /// w_Nz <= 0.
    PressureRate,
    /// v_Nz w_Nz = 0.
    OpenOrPressed,
    /// |v_Tz| w_Tz = mu v_Tz w_Nz.
    AgainstMotion,
    /// S w_Ts + mu w_Ns <= 0; |w_Tz| + mu w_Nz <= 0.
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
    if lifted.v.iter().all(|v_i| value.sign_of(v_i) == Sign::Zero) {
        return Err(LineViolated {
            line: Line::NonTrivial,
            place: "dof",
            index: 0,
            got: Sign::Zero,
        });
    }

    for dof in system.free_dofs() {
        let w_f = value.sign_of(&lifted.w[dof]);
        require(
            w_f == Sign::Zero,
            Line::FreeReaction,
            LineSubject::Dof(dof),
            w_f,
        )?;
    }

    for (index, particle) in system.particles().iter().enumerate() {
        let place = LineSubject::Particle(index);
        match particle.state {
            ContactState::Free => {}
            ContactState::Stick => {
                for dof in [particle.tangential, particle.normal] {
                    let v_d = value.sign_of(&lifted.v[dof]);
                    require(v_d == Sign::Zero, Line::StickRate, place, v_d)?;
                }
            }
            ContactState::Zero => {
                let sides = ZeroSides::of(particle, &friction(system, unknown), lifted);
                sides.check(place, value)?;
            }
            ContactState::Slip { sign } => {
                let s = Rational::from_integer(sign.into());
                let sides = SlipSides {
                    v_n: positive_multiple(&particle.into_obstacle(), &Rational::one(), &lifted.v),
                    s_v_t: positive_multiple(&particle.tangent(), &s, &lifted.v),
                    cone: cone_side(particle, &s, &friction(system, unknown), lifted),
                };
                sides.check(place, value)?;
            }
        }
    }

    Ok(())
}

/// The coefficient of friction in (9).
enum FrictionTerm {
    /// mu as the system gives it (MCEIP-lambda2).
    Given(Rational),
    /// mu is the number t itself (MCEIP-mu).
    IsUnknown,
}

fn friction(system: &System, unknown: Unknown) -> FrictionTerm {
    match (unknown, system.friction()) {
        (Unknown::Mu, _) => FrictionTerm::IsUnknown,
        (Unknown::Lambda2, Some(mu)) => FrictionTerm::Given(mu.clone()),
        // `System::require_for` refuses lambda2 without mu, and eigenvalues of a body.
        (Unknown::Lambda2 | Unknown::Eigenvalue, _) => FrictionTerm::Given(Rational::one()),
    }
}

/// The left-hand sides of (9) at a slip particle, each times a positive number.
struct SlipSides {
    /// v_N.
    v_n: Poly,
    /// S v_T.
    s_v_t: Poly,
    /// S w_T + mu w_N + (1 + mu^2) g S v_T.
    cone: Poly,
}

impl SlipSides {
    fn check(&self, place: LineSubject, value: &mut Algebraic) -> Result<(), LineViolated> {
        let v_n = value.sign_of(&self.v_n);
        require(v_n == Sign::Zero, Line::NormalRate, place, v_n)?;

        let slip = value.sign_of(&self.s_v_t);
        require(slip != Sign::Positive, Line::SlipDirection, place, slip)?;

        let cone = value.sign_of(&self.cone);
        require(cone != Sign::Positive, Line::FrictionCone, place, cone)?;

        // Neither factor is positive, so their product is not negative.
        let product = if slip == Sign::Zero || cone == Sign::Zero {
            Sign::Zero
        } else {
            Sign::Positive
        };

        require(product == Sign::Zero, Line::Complementarity, place, product)
    }
}

/// The left-hand sides of (9) at a particle with zero reaction, each times a positive number.
struct ZeroSides {
    v_t: Poly,
    v_n: Poly,
    w_n: Poly,
    /// w_T + mu w_N.
    cone_plus: Poly,
    /// -w_T + mu w_N.
    cone_minus: Poly,
}

impl ZeroSides {
    fn of(particle: &Particle, friction: &FrictionTerm, lifted: &Lifted) -> ZeroSides {
        let one = Rational::one();
        ZeroSides {
            v_t: positive_multiple(&particle.tangent(), &one, &lifted.v),
            v_n: positive_multiple(&particle.into_obstacle(), &one, &lifted.v),
            w_n: positive_multiple(&particle.into_obstacle(), &one, &lifted.w),
            cone_plus: cone_side(particle, &one, friction, lifted),
            cone_minus: cone_side(particle, &-one, friction, lifted),
        }
    }

    fn check(&self, place: LineSubject, value: &mut Algebraic) -> Result<(), LineViolated> {
        let v_n = value.sign_of(&self.v_n);
        require(v_n != Sign::Positive, Line::GapRate, place, v_n)?;

        let w_n = value.sign_of(&self.w_n);
        require(w_n != Sign::Positive, Line::PressureRate, place, w_n)?;

        let is_one_zero = v_n == Sign::Zero || w_n == Sign::Zero;
        require(is_one_zero, Line::OpenOrPressed, place, Sign::Positive)?;

        let plus = value.sign_of(&self.cone_plus);
        require(plus != Sign::Positive, Line::FrictionCone, place, plus)?;
        let minus = value.sign_of(&self.cone_minus);
        require(minus != Sign::Positive, Line::FrictionCone, place, minus)?;

        // To the right w_T = mu w_N, to the left -w_T = mu w_N.
        let against = match value.sign_of(&self.v_t) {
            Sign::Positive => minus,
            Sign::Negative => plus,
            Sign::Zero => Sign::Zero,
        };
        require(against == Sign::Zero, Line::AgainstMotion, place, against)
    }
}

/// What a line of (9) is about.
#[derive(Clone, Copy)]
enum LineSubject {
    Dof(usize),
    Particle(usize),
}

fn require(holds: bool, line: Line, place: LineSubject, got: Sign) -> Result<(), LineViolated> {
    if holds {
        return Ok(());
    }

    let (place, index) = match place {
        LineSubject::Dof(dof) => ("dof", dof),
        LineSubject::Particle(particle) => ("particle", particle),
    };

    Err(LineViolated {
        line,
        place,
        index,
        got,
    })
}

/// A positive multiple of S t'w + mu n'w + (1 + mu^2) g S t'v.
fn cone_side(particle: &Particle, s: &Rational, friction: &FrictionTerm, lifted: &Lifted) -> Poly {
    let (mu, power, turning) = match friction {
        FrictionTerm::Given(mu) => (mu.clone(), 0, particle.turning_stiffness(mu)),
        // `System::require_for` refuses curved obstacles where mu is the unknown.
        FrictionTerm::IsUnknown => (Rational::one(), 1, Rational::zero()),
    };

    let tangential = times(&particle.tangent(), s);
    let normal = times(&particle.friction_direction(), &mu);
    let v_in_units_of_w = Rational::new(lifted.w_scale.clone(), lifted.v_scale.clone());
    let turned = times(&tangential, &(turning * v_in_units_of_w));

    let coefficients = tangential.iter().chain(&normal).chain(&turned);
    let clear = common_denominator(coefficients.map(|(_, c)| c));
    let w_t = integral_inner_product(&tangential, &clear, &lifted.w);
    let w_n = integral_inner_product(&normal, &clear, &lifted.w);
    let of_turning = integral_inner_product(&turned, &clear, &lifted.v);

    &(&w_t + &w_n.shift(power)) + &of_turning
}

/// A positive multiple of factor * d'p.
fn positive_multiple(direction: &Direction, factor: &Rational, p: &[Poly]) -> Poly {
    let scaled = times(direction, factor);
    let clear = common_denominator(scaled.iter().map(|(_, c)| c));
    integral_inner_product(&scaled, &clear, p)
}

/// factor * d.
fn times(direction: &Direction, factor: &Rational) -> Direction {
    direction
        .iter()
        .map(|(dof, coefficient)| (*dof, coefficient * factor))
        .collect()
}

/// clear * d'p, where `clear` is a multiple of every denominator of d.
fn integral_inner_product(direction: &Direction, clear: &Integer, p: &[Poly]) -> Poly {
    let mut sum = Poly::default();
    for (dof, coefficient) in direction {
        let integer = cleared(coefficient, clear);
        sum += &p[*dof].scale(&integer);
    }

    sum
}
