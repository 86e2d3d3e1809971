//! Lifted solutions: v and w over all degrees of freedom, each line of (9) checked from K, M, mu
//! and the contact states themselves. The pencil is not used, so a wrong reduction cannot hide
//! here.
//!
//! Obligations, in this order: index sets and sizes; [a, b] isolates one root in the window; then,
//! at that root, the lines of (9): (t M + K) v = w, w_f = 0, v_d = 0, v_N = 0, S v_T <= 0, S w_T +
//! mu w_N <= 0, their product zero with `support` and `biactive` saying which; v != 0.

use super::AcceptedClaim;
use super::exact_solution::{Alpha, bounded, coefficients, index_set, isolate, within};
use super::pencil::Rows;
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
    index_set(rows, "support", &claim.support)?;
    index_set(rows, "biactive", &claim.biactive)?;
    bounded(
        &claim.polynomial,
        &claim.interval,
        claim.v.iter().chain(&claim.w),
    )?;
    let p = Poly::new(claim.polynomial.clone()).primitive();
    let value = isolate(&p, &claim.interval)?;
    within(window, &value)?;
    for (what, list) in [("v", &claim.v), ("w", &claim.w)] {
        if list.len() != system.dofs() {
            return Err(Reason::Length {
                what,
                expected: system.dofs(),
                got: list.len(),
            });
        }
    }
    let mut v = coefficients(claim.v.iter().chain(&claim.w), &p);
    let w = v.split_off(claim.v.len());
    let lines = Lines {
        system,
        unknown: problem.unknown(),
        alpha: Alpha { p, value },
        v,
        w,
    };
    lines.motion()?;
    let mut position = lines.free()?; // slip variables follow the free ones in the pencil
    for (index, particle) in system.particles().iter().enumerate() {
        match particle.state {
            ContactState::Free => {}
            ContactState::Stick => lines.stick(index, particle)?,
            ContactState::Slip { sign } => {
                let slips = claim.support.binary_search(&position).is_ok();
                let biactive = claim.biactive.binary_search(&position).is_ok();
                if slips && biactive {
                    return Err(Reason::Biactive {
                        index: position,
                        expected: false,
                    });
                }
                lines.slip(index, particle, sign, slips, biactive)?;
                position += 1;
            }
        }
    }
    if claim.support.is_empty()
        && system
            .free_dofs()
            .iter()
            .all(|&d| lines.alpha.enclose(&lines.v[d]).certain_sign() == 0)
    {
        return Err(Reason::XZero);
    }
    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value: lines.alpha.value,
    })
}

type Polynomial = Vec<Rational>;

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
        let mass = self
            .system
            .mass()
            .filter(|_| self.unknown == Unknown::Lambda2);
        for dof in 0..self.system.dofs() {
            let mut sum: Polynomial = self.w[dof].iter().map(|c| -c).collect();
            let mut product = |m: &Sparse, shift: usize| {
                m.row(dof)
                    .iter()
                    .for_each(|(j, k)| add(&mut sum, k, &self.v[*j], shift))
            };
            product(self.system.stiffness(), 0);
            if let Some(mass) = mass {
                product(mass, 1);
            }
            self.zero("(lambda^2 M + K) v = w", "dof", dof, &sum)?;
        }
        Ok(())
    }

    /// w_f = 0; the number of free dofs.
    fn free(&self) -> Result<usize, Reason> {
        let free = self.system.free_dofs();
        free.iter()
            .try_for_each(|&dof| self.zero("w_f = 0", "dof", dof, &self.w[dof]))?;
        Ok(free.len())
    }

    /// v_d = 0.
    fn stick(&self, index: usize, p: &Particle) -> Result<(), Reason> {
        [p.tangential, p.normal]
            .into_iter()
            .try_for_each(|dof| self.zero("v_d = 0", "particle", index, &self.v[dof]))
    }

    fn slip(
        &self,
        index: usize,
        p: &Particle,
        sign: i8,
        slips: bool,
        biactive: bool,
    ) -> Result<(), Reason> {
        let s = Rational::from_integer(sign.into());
        self.zero(
            "v_N = 0",
            "particle",
            index,
            &along(&p.into_obstacle(), &self.v, &Rational::one()),
        )?;
        let rate = along(&p.tangent(), &self.v, &s);
        if slips {
            self.negative("S v_T < 0 on the support", index, &rate)?;
        } else {
            self.zero("S v_T = 0 off the support", "particle", index, &rate)?;
        }
        // mu is a number of the system or the unknown itself.
        let mut cone = along(&p.tangent(), &self.w, &s);
        match (self.unknown, self.system.friction()) {
            (Unknown::Lambda2, Some(mu)) => add(
                &mut cone,
                &Rational::one(),
                &along(&p.into_obstacle(), &self.w, mu),
                0,
            ),
            _ => add(
                &mut cone,
                &Rational::one(),
                &along(&p.into_obstacle(), &self.w, &Rational::one()),
                1,
            ),
        }
        if slips {
            self.zero("(S w_T + mu w_N) (S v_T) = 0", "particle", index, &cone)
        } else if biactive {
            self.zero(
                "S w_T + mu w_N = 0 where biactive",
                "particle",
                index,
                &cone,
            )
        } else {
            self.negative("S w_T + mu w_N < 0 where not biactive", index, &cone)
        }
    }

    fn zero(
        &self,
        line: &'static str,
        place: &'static str,
        index: usize,
        g: &Polynomial,
    ) -> Result<(), Reason> {
        if self.alpha.remainder(g).is_zero() {
            Ok(())
        } else {
            Err(self.fails(line, place, index, g))
        }
    }

    fn negative(&self, line: &'static str, index: usize, g: &Polynomial) -> Result<(), Reason> {
        if self.alpha.enclose(g).certain_sign() == -1 {
            Ok(())
        } else {
            Err(self.fails(line, "particle", index, g))
        }
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
