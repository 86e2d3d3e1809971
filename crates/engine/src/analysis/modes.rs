//! Solutions as an engineer reads them: growth rate and displacement rates of all degrees of
//! freedom.
//!
//! A solution (lambda^2, x) of MCEIP-lambda2 is the motion (8) with growth rate lambda and shape v,
//! where v = x on the free dofs and v_T = -S x on the slip particles (10). Input: an accepted
//! solution with its x in doubles. Output: [`Mode`]. Called by `divergence`.

use crate::magnitude::decimal_order;
use crate::reduction::mode;
use crate::report::{short, short_is_plain};
use mceip_check::AcceptedClaim;
use mceip_exact::{Interval, Rational, from_f64, to_f64, whole};
use mceip_model::reduction::zero_variables;
use mceip_model::{ContactState, MuFamily, System, ZeroVariables};
use num_traits::{Signed, Zero};

/// A diverging solution u(t) = u0 + alpha(t) v with alpha growing like exp(lambda t). // (8)
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Encloses lambda^2, in 1/s^2 for consistent units.
    pub lambda2: Interval,
    /// lambda = sqrt(lambda^2), in 1/s; 0 where the enclosure reaches 0 (a threshold: linear
    /// departure), and infinite beyond doubles.
    pub growth_rate: f64,
    /// Particles that slip, as indices into the particles of the system.
    pub slipping: Vec<usize>,
    /// Particles in impending slip that stay at rest: they stick, or are biactive.
    pub sticking: Vec<usize>,
    /// What each particle with zero reaction does.
    pub zero: Vec<(usize, ZeroMode)>,
    /// v over all degrees of freedom, in doubles; the slip rates |v_T| of the slip particles sum to
    /// one.
    pub v: Vec<f64>,
}

/// lambda in decimals, also where doubles cannot hold it: with six decimals, or six digits and an
/// exponent.
fn root_text(lambda2: &Rational) -> String {
    // sqrt(m 10^2k) = sqrt(m) 10^k, with m between 10^-2 and 10^2 or so.
    let half_exponent = decimal_order(lambda2) / 2;
    let ten_to_half = whole(10).pow(half_exponent as i32);
    let m = lambda2 / (&ten_to_half * &ten_to_half);

    let root = from_f64(to_f64(&m).sqrt()).unwrap_or_else(|_| Rational::zero());
    short(&(root * ten_to_half))
}

/// What a particle with zero reaction does (`spec/zero-reaction.md`, Z.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ZeroMode {
    /// It leaves the obstacle: v_N < 0.
    Open,
    /// It rests: v = 0.
    Stick,
    /// It slides along its tangent: v_N = 0 and v_T > 0.
    Right,
    /// It slides against its tangent: v_N = 0 and v_T < 0.
    Left,
}

impl ZeroMode {
    /// The word of files.
    pub fn word(self) -> &'static str {
        match self {
            ZeroMode::Open => "open",
            ZeroMode::Stick => "stick",
            ZeroMode::Right => "right",
            ZeroMode::Left => "left",
        }
    }

    fn of(variables: &ZeroVariables, support: &[usize]) -> ZeroMode {
        if support.contains(&variables.gap) {
            ZeroMode::Open
        } else if support.contains(&variables.right) {
            ZeroMode::Right
        } else if support.contains(&variables.left) {
            ZeroMode::Left
        } else {
            ZeroMode::Stick
        }
    }
}

/// v in units of the sum of the slip rates.
fn per_slip_rate(mut v: Vec<f64>, slip_rates: &[f64]) -> Vec<f64> {
    let sum: f64 = slip_rates.iter().sum();
    for component in &mut v {
        *component /= sum;
    }

    v
}

/// The modes of the particles with zero reaction in a solution with this support.
fn zero_modes(system: &System, support: &[usize]) -> Vec<(usize, ZeroMode)> {
    let mut modes = Vec::new();
    for variables in zero_variables(system) {
        modes.push((variables.particle, ZeroMode::of(&variables, support)));
    }

    modes
}

impl Mode {
    /// The growth rate in decimals; `None` at a threshold.
    pub(super) fn growth_text(&self) -> Option<String> {
        if !self.lambda2.lo().is_positive() {
            return None;
        }

        let is_in_doubles = self.growth_rate.is_normal();
        Some(if is_in_doubles && short_is_plain(self.growth_rate) {
            format!("{:.6}", self.growth_rate)
        } else {
            root_text(&self.lambda2.mid())
        })
    }

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

        // The variables of the slip particles follow the free ones, in the order of the particles.
        let free_count = family.stiffness.free().len();
        let slip_variables = free_count..free_count + impending.len();
        let mut v = mode(&family.variables, x, system.dofs());
        let zero = zero_modes(system, &solution.support);
        if !zero.is_empty() {
            v = per_slip_rate(v, &x[slip_variables]); // e'x = 1 has the variables of `zero` in it
        }

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
            zero,
            v,
        }
    }
}
