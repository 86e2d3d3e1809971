//! Lifted solutions: v and w over all degrees of freedom, each line of (9) checked from K, M, mu
//! and the contact states themselves.
//!
//! The pencil is not used here, so that a wrong reduction (10)-(16) cannot hide. The value t is an
//! algebraic number alpha, and v and w are polynomials in it, as in `exact_solution`. The
//! obligations, in the order of `spec/certificates.md`:
//!
//! 1. Those of an exact solution on index sets, sizes, the isolating interval and the window.
//! 2. (t M + K) v = w at every degree of freedom; K v = w where mu is the unknown.
//! 3. w_f = 0 at the free degrees of freedom.
//! 4. Stick: v = 0 at both degrees of freedom of the particle. Slip: v_N = 0; S v_T < 0 on the
//!    support, else S v_T = 0; S w_T + mu w_N = 0 on the support and where biactive, else < 0.
//!    On a curved obstacle (`spec/curvature.md`) (1 + mu^2) g S v_T is added to S w_T + mu w_N,
//!    mu that of the particle; off the support it is 0.
//!    Zero reaction, with the variables gap, right and left: v_N < 0 if gap is in the support, else
//!    v_N = 0; w_N = 0 if gap is in the support or biactive, else w_N < 0; v_T > 0 if right is in
//!    the support, v_T < 0 if left is, else v_T = 0; the cone line of S = -1 for right, that of
//!    S = 1 for left, as for slip.
//! 5. v is not zero.
//!
//! Line 4 states (9) with the two inequalities and the product resolved: on the support the first
//! factor of (S w_T + mu w_N) (S v_T) is zero, elsewhere the second.
//!
//! Indices of `support` and `biactive` are those of the pencil: free degrees of freedom first, then
//! slip particles in file order, then gap, right and left of each particle with zero reaction.

use super::AcceptedClaim;
use super::exact_solution::{
    Alpha, ClaimSize, Polynomial, coefficients, index_set, isolate, one_half, within,
};
use super::pencil::{Rows, turning_stiffness};
use super::reason::Reason;
use crate::certificate::LiftedSolution;
use mceip_exact::{Poly, Rational, Sparse};
use mceip_model::{Body, ContactState, Direction, Particle, Problem, System, Unknown, Window};
use num_traits::{One, Zero};

pub(super) fn check(
    problem: &Problem,
    rows: &Rows,
    window: &Window,
    claim: &LiftedSolution,
) -> Result<AcceptedClaim, Reason> {
    let Body::System(system) = problem.body() else {
        return Err(Reason::NotASystem);
    };
    let polynomials = claim.v.iter().chain(&claim.w);
    index_set(rows, "support", &claim.support)?;
    index_set(rows, "biactive", &claim.biactive)?;
    one_half(rows, &claim.support)?;
    ClaimSize::of(&claim.polynomial, &claim.interval, polynomials.clone()).bounded()?;

    let p = Poly::new(claim.polynomial.clone()).primitive();
    let value = isolate(&p, &claim.interval)?;
    within(window, &value)?;
    Reason::length("v", system.dofs(), claim.v.len())?;
    Reason::length("w", system.dofs(), claim.w.len())?;

    let mut v = coefficients(polynomials, &p);
    let w = v.split_off(claim.v.len());
    let lines = Lines {
        system,
        unknown: problem.unknown(),
        alpha: Alpha { p, value },
        v,
        w,
    };
    lines.motion()?;
    lines.free()?;
    lines.particles(claim)?;
    lines.not_zero(claim)?;

    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value: lines.alpha.value,
    })
}

/// What a claim says of a complementarity pair, such as -S v_T and -(S w_T + mu w_N) of a slip
/// particle.
#[derive(Clone, Copy, PartialEq)]
enum ClaimedPair {
    /// x > 0, y = 0.
    InSupport,
    /// x = 0, y = 0.
    Biactive,
    /// x = 0, y > 0.
    AtZero,
}

/// The lines of (9) for one v, w and t.
struct Lines<'a> {
    system: &'a System,
    unknown: Unknown,
    alpha: Alpha,
    v: Vec<Polynomial>,
    w: Vec<Polynomial>,
}

impl Lines<'_> {
    /// (t M + K) v = w; for MCEIP-mu K v = w.
    fn motion(&self) -> Result<(), Reason> {
        for dof in 0..self.system.dofs() {
            let mut difference: Polynomial = self.w[dof].iter().map(|c| -c).collect();

            self.add_row(&mut difference, self.system.stiffness(), dof, 0);
            if self.unknown == Unknown::Lambda2
                && let Some(mass) = self.system.mass()
            {
                self.add_row(&mut difference, mass, dof, 1);
            }

            self.zero("(lambda^2 M + K) v = w", "dof", dof, &difference)?;
        }

        Ok(())
    }

    /// sum += t^shift (matrix v)_dof.
    fn add_row(&self, sum: &mut Polynomial, matrix: &Sparse, dof: usize, shift: usize) {
        for (j, entry) in matrix.row(dof) {
            add(sum, entry, &self.v[*j], shift);
        }
    }

    /// w_f = 0.
    fn free(&self) -> Result<(), Reason> {
        for dof in self.system.free_dofs() {
            self.zero("w_f = 0", "dof", dof, &self.w[dof])?;
        }

        Ok(())
    }

    /// The lines of each particle in contact.
    fn particles(&self, claim: &LiftedSolution) -> Result<(), Reason> {
        // In the pencil the slip variables follow the free ones, and those of z the slip ones.
        let mut variable = self.system.free_dofs().len();
        let mut gap = variable + self.system.slip_particles().len();

        for (index, particle) in self.system.particles().iter().enumerate() {
            match particle.state {
                ContactState::Free => {}
                ContactState::Stick => self.stick(index, particle)?,
                ContactState::Slip { sign } => {
                    let slip = claimed(claim, variable)?;
                    self.slip(index, particle, sign, slip)?;
                    variable += 1;
                }
                ContactState::Zero => {
                    self.gap(index, particle, claimed(claim, gap)?)?;
                    let right = claimed(claim, gap + 1)?;
                    let left = claimed(claim, gap + 2)?;
                    self.sliding(index, particle, right, left)?;
                    gap += 3;
                }
            }
        }

        Ok(())
    }

    /// v_d = 0.
    fn stick(&self, index: usize, particle: &Particle) -> Result<(), Reason> {
        for dof in [particle.tangential, particle.normal] {
            self.zero("v_d = 0", "particle", index, &self.v[dof])?;
        }

        Ok(())
    }

    /// v_N = 0, and the signs of S v_T and S w_T + mu w_N.
    fn slip(
        &self,
        index: usize,
        particle: &Particle,
        sign: i8,
        slip: ClaimedPair,
    ) -> Result<(), Reason> {
        let normal_rate = along(&particle.into_obstacle(), &self.v, &Rational::one());
        self.zero("v_N = 0", "particle", index, &normal_rate)?;

        let s = Rational::from_integer(sign.into());
        let slip_rate = along(&particle.tangent(), &self.v, &s);
        if slip == ClaimedPair::InSupport {
            self.negative("S v_T < 0 on the support", index, &slip_rate)?;
        } else {
            self.zero("S v_T = 0 off the support", "particle", index, &slip_rate)?;
        }

        let mut cone = self.cone(particle, &s);
        // With mu as the unknown obstacles are flat.
        if let Some(mu) = self.system.friction() {
            add(&mut cone, &turning_stiffness(particle, mu), &slip_rate, 0);
        }
        self.on_cone(index, &cone, slip)
    }

    /// The sign of `cone`, the line of the friction cone.
    fn on_cone(&self, index: usize, cone: &Polynomial, slip: ClaimedPair) -> Result<(), Reason> {
        let line = match slip {
            ClaimedPair::InSupport => "(S w_T + mu w_N) (S v_T) = 0",
            ClaimedPair::Biactive => "S w_T + mu w_N = 0 where biactive",
            ClaimedPair::AtZero => {
                return self.negative("S w_T + mu w_N < 0 where not biactive", index, cone);
            }
        };
        self.zero(line, "particle", index, cone)
    }

    /// The signs of v_N and w_N at a particle with zero reaction.
    fn gap(&self, index: usize, particle: &Particle, gap: ClaimedPair) -> Result<(), Reason> {
        let normal_rate = along(&particle.into_obstacle(), &self.v, &Rational::one());
        if gap == ClaimedPair::InSupport {
            self.negative("v_N < 0 on the support", index, &normal_rate)?;
        } else {
            self.zero("v_N = 0 off the support", "particle", index, &normal_rate)?;
        }

        let reaction = along(&particle.into_obstacle(), &self.w, &Rational::one());
        match gap {
            ClaimedPair::InSupport => self.zero("v_N w_N = 0", "particle", index, &reaction),
            ClaimedPair::Biactive => {
                self.zero("w_N = 0 where biactive", "particle", index, &reaction)
            }
            ClaimedPair::AtZero => self.negative("w_N < 0 where not biactive", index, &reaction),
        }
    }

    /// The sign of v_T at a particle with zero reaction, and both sides of its cone: w_T = mu w_N
    /// if it slides to the right, -w_T = mu w_N if to the left.
    fn sliding(
        &self,
        index: usize,
        particle: &Particle,
        right: ClaimedPair,
        left: ClaimedPair,
    ) -> Result<(), Reason> {
        let one = Rational::one();
        let minus_one = -&one;

        if right == ClaimedPair::InSupport {
            let to_the_left = along(&particle.tangent(), &self.v, &minus_one);
            self.negative("v_T > 0 on the support", index, &to_the_left)?;
        } else {
            let to_the_right = along(&particle.tangent(), &self.v, &one);
            if left == ClaimedPair::InSupport {
                self.negative("v_T < 0 on the support", index, &to_the_right)?;
            } else {
                self.zero("v_T = 0 off the support", "particle", index, &to_the_right)?;
            }
        }

        self.on_cone(index, &self.cone(particle, &minus_one), right)?;
        self.on_cone(index, &self.cone(particle, &one), left)
    }

    /// S w_T + mu w_N, where mu is a number of the system or the unknown itself.
    fn cone(&self, particle: &Particle, s: &Rational) -> Polynomial {
        let one = Rational::one();
        let mut sum = along(&particle.tangent(), &self.w, s);

        match (self.unknown, self.system.friction()) {
            (Unknown::Lambda2, Some(mu)) => {
                let friction = along(&particle.friction_direction(), &self.w, mu);
                add(&mut sum, &one, &friction, 0);
            }
            _ => {
                let friction = along(&particle.friction_direction(), &self.w, &one);
                add(&mut sum, &one, &friction, 1);
            }
        }

        sum
    }

    /// v != 0. On the support this has been seen; without one some free v_i must not be zero.
    fn not_zero(&self, claim: &LiftedSolution) -> Result<(), Reason> {
        if !claim.support.is_empty() {
            return Ok(());
        }

        for dof in self.system.free_dofs() {
            if self.alpha.enclose(&self.v[dof]).certain_sign() != 0 {
                return Ok(());
            }
        }

        Err(Reason::XZero)
    }

    /// Demands g(alpha) = 0.
    fn zero(
        &self,
        line: &'static str,
        place: &'static str,
        index: usize,
        g: &Polynomial,
    ) -> Result<(), Reason> {
        if self.alpha.remainder(g).is_zero() {
            return Ok(());
        }

        Err(self.fails(line, place, index, g))
    }

    /// Demands g(alpha) < 0 of a particle.
    fn negative(&self, line: &'static str, index: usize, g: &Polynomial) -> Result<(), Reason> {
        if self.alpha.enclose(g).certain_sign() == -1 {
            return Ok(());
        }

        Err(self.fails(line, "particle", index, g))
    }

    fn fails(
        &self,
        line: &'static str,
        place: &'static str,
        index: usize,
        g: &Polynomial,
    ) -> Reason {
        let image = self.alpha.enclose(g);
        Reason::Line {
            line,
            place,
            index,
            lo: image.lo().clone(),
            hi: image.hi().clone(),
        }
    }
}

/// What the claim says of the pair with this variable. It cannot be in both sets.
fn claimed(claim: &LiftedSolution, variable: usize) -> Result<ClaimedPair, Reason> {
    let is_in_support = claim.support.binary_search(&variable).is_ok();
    let is_biactive = claim.biactive.binary_search(&variable).is_ok();

    match (is_in_support, is_biactive) {
        (true, true) => Err(Reason::Biactive {
            index: variable,
            expected: false,
        }),
        (true, false) => Ok(ClaimedPair::InSupport),
        (false, true) => Ok(ClaimedPair::Biactive),
        (false, false) => Ok(ClaimedPair::AtZero),
    }
}

/// factor * direction' list.
fn along(direction: &Direction, list: &[Polynomial], factor: &Rational) -> Polynomial {
    let mut sum = Vec::new();
    for (dof, c) in direction {
        add(&mut sum, &(c * factor), &list[*dof], 0);
    }

    sum
}

/// sum += factor t^shift p.
fn add(sum: &mut Polynomial, factor: &Rational, p: &[Rational], shift: usize) {
    if sum.len() < p.len() + shift {
        sum.resize(p.len() + shift, Rational::zero());
    }

    for (k, c) in p.iter().enumerate() {
        sum[k + shift] += factor * c;
    }
}
