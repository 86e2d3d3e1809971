//! Solutions as an engineer reads them: growth rate and displacement rates of all degrees of
//! freedom.

use crate::reduction::{MuFamily, Variable};
use mceip_check::AcceptedClaim;
use mceip_exact::{Interval, to_f64};
use mceip_model::{ContactState, System};
use num_traits::Signed;

/// A diverging solution u(t) = u0 + alpha(t) v with alpha growing like exp(lambda t). // E8
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
    pub(super) fn of(
        system: &System,
        family: &MuFamily,
        solution: &AcceptedClaim,
        x: &[f64],
    ) -> Mode {
        let impending: Vec<usize> = (0..system.particles().len())
            .filter(|&p| matches!(system.particles()[p].state, ContactState::Slip { .. }))
            .collect();
        let free = family.variables.len() - impending.len();
        let (slipping, sticking) = impending
            .iter()
            .enumerate()
            .map(|(k, p)| (k + free, *p))
            .partition::<Vec<_>, _>(|(i, _)| solution.support.contains(i));
        let particles = |list: Vec<(usize, usize)>| list.into_iter().map(|e| e.1).collect();
        Mode {
            lambda2: solution.value.clone(),
            growth_rate: if solution.value.lo().is_positive() {
                to_f64(&solution.value.mid()).sqrt()
            } else {
                0.0
            },
            slipping: particles(slipping),
            sticking: particles(sticking),
            v: lift(system.dofs(), &family.variables, x),
        }
    }
}

/// v = x on free dofs, -S x along the tangents, 0 elsewhere. // E10
fn lift(dofs: usize, variables: &[Variable], x: &[f64]) -> Vec<f64> {
    let mut v = vec![0.0; dofs];
    for (variable, x) in variables.iter().zip(x) {
        match variable {
            Variable::Free { dof } => v[*dof] += x,
            Variable::Slip { sign, tangent, .. } => tangent
                .iter()
                .for_each(|(dof, c)| v[*dof] -= f64::from(*sign) * x * to_f64(c)),
        }
    }
    v.iter().map(|v| v + 0.0).collect() // no negative zeros
}
