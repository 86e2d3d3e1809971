//! Solutions as an engineer reads them: growth rate and displacement rates of all degrees of
//! freedom.
//!
//! A solution (lambda^2, x) of MCEIP-lambda2 is the motion (8) with growth rate lambda and shape v,
//! where v = x on the free dofs and v_T = -S x on the slip particles (10). Input: an accepted
//! solution with its x in doubles. Output: [`Mode`]. Called by `divergence`.

use crate::reduction::{MuFamily, mode};
use mceip_check::AcceptedClaim;
use mceip_exact::{Interval, to_f64};
use mceip_model::{ContactState, System};
use num_traits::Signed;

/// A diverging solution u(t) = u0 + alpha(t) v with alpha growing like exp(lambda t). // (8)
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Encloses lambda^2, in 1/s^2 for consistent units.
    pub lambda2: Interval,
    /// lambda = sqrt(lambda^2), in 1/s; 0 where the enclosure reaches 0 (a threshold: linear
    /// departure).
    pub growth_rate: f64,
    /// Particles that slip, as indices into the particles of the system.
    pub slipping: Vec<usize>,
    /// Particles in impending slip that do not move.
    pub sticking: Vec<usize>,
    /// v over all degrees of freedom, in doubles; the slip rates |v_T| of the slip particles sum to
    /// one.
    pub v: Vec<f64>,
}

impl Mode {
    /// The mode of a solution with the support of the variables of `family`.
    pub(super) fn of(
        system: &System,
        family: &MuFamily,
        solution: &AcceptedClaim,
        x: &[f64],
    ) -> Mode {
        let mut impending = Vec::new();
        for (index, particle) in system.particles().iter().enumerate() {
            if matches!(particle.state, ContactState::Slip { .. }) {
                impending.push(index);
            }
        }

        // The variables of the slip particles come last, in the order of the particles.
        let free_count = family.variables.len() - impending.len();
        let mut slipping = Vec::new();
        let mut sticking = Vec::new();
        for (k, particle) in impending.into_iter().enumerate() {
            let variable = free_count + k;
            if solution.support.contains(&variable) {
                slipping.push(particle);
            } else {
                sticking.push(particle);
            }
        }

        let lambda2 = &solution.value;
        let growth_rate = if lambda2.lo().is_positive() {
            to_f64(&lambda2.mid()).sqrt()
        } else {
            0.0
        };

        Mode {
            lambda2: lambda2.clone(),
            growth_rate,
            slipping,
            sticking,
            v: mode(&family.variables, x, system.dofs()),
        }
    }
}
