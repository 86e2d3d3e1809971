//! Particles in contact with zero reaction (z) in the MCP: friction ratios.
//!
//! The split form has for each z particle the pairs (g, p), (v+, s+), (v-, s-) with
//!
//! ```text
//! s+ = w_T - c mu w_N,    s- = -w_T - c mu w_N,    s+ + s- = 2 c mu p >= 0
//! ```
//!
//! and the vector v+ = v- = 1 belongs to v = w = 0 at every t, so that its matrix is singular. The
//! MCP has in the places of v+ and v- the unknowns v (which is v_T, without a sign) and rho in
//! [-1, 1], the *friction ratio* w_T / (c mu w_N), with the rows
//!
//! ```text
//! v:    ((1 + rho) s+ - (1 - rho) s-) / 2 = w_T - rho c mu w_N = 0
//! rho:  -v,  >= 0 where rho = -1,  = 0 inside,  <= 0 where rho = 1
//! ```
//!
//! Its solutions are those of (9) (`spec/zero-reaction.md`, Z.3): where v > 0, rho = 1 and s+ = 0;
//! where v < 0, rho = -1 and s- = 0; where v = 0, s+ and s- have one sign, and their sum is not
//! negative.
#![allow(clippy::float_arithmetic)]

use super::normal;
use mceip_model::ZeroVariables;
use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Gives v+ and v- one scale, so that their rows may be added.
pub(super) fn join_scales(diagonal: &mut [f64], zero: &[ZeroVariables]) {
    for variables in zero {
        diagonal[variables.left] = diagonal[variables.right];
    }
}

/// v has no bounds, the friction ratio lies in [-1, 1].
pub(super) fn set_bounds(variables: &ZeroVariables, lower: &mut [f64], upper: &mut [f64]) {
    lower[variables.right] = f64::NEG_INFINITY;
    lower[variables.left] = -1.0;
    upper[variables.left] = 1.0;
}

/// From v and rho to v+ and v-. Strictly inside its bounds the ratio says that v = 0.
pub(super) fn split(variables: &ZeroVariables, u: &mut [f64]) {
    let v = u[variables.right];
    let rho = u[variables.left];
    u[variables.right] = if rho >= 1.0 { v.max(0.0) } else { 0.0 };
    u[variables.left] = if rho <= -1.0 { (-v).max(0.0) } else { 0.0 };
}

/// From v+ and v- to v; rho is left at 0.
pub(super) fn join(variables: &ZeroVariables, z: &mut [f64]) {
    z[variables.right] -= z[variables.left];
    z[variables.left] = 0.0;
}

/// The ratio of a solution: the side to which it slides, else rho with (1 + rho) s+ = (1 - rho) s-,
/// else 0.
pub(super) fn ratio(variables: &ZeroVariables, v: f64, rows: &[f64]) -> f64 {
    if v != 0.0 {
        return v.signum();
    }

    let right = rows[variables.right];
    let left = rows[variables.left];
    let sum = right + left;
    if sum > 0.0 {
        ((left - right) / sum).clamp(-1.0, 1.0)
    } else {
        0.0
    }
}

/// Puts the rows of v and rho in the places of s+ and s-.
pub(super) fn combine_rows(variables: &ZeroVariables, z: &[f64], y: &mut [f64]) {
    let ZeroVariables { right, left, .. } = *variables;
    let rho = z[left];
    y[right] = 0.5 * ((1.0 + rho) * y[right] - (1.0 - rho) * y[left]);
    y[left] = -z[right];
}

/// The same for the rows of the Jacobian, and the column of rho, where `y` has the rows s+ and s-.
pub(super) fn combine_rows_of_jacobian(
    variables: &ZeroVariables,
    z: &[f64],
    y: &[f64],
    jacobian: &mut DMatrix<f64>,
) {
    let ZeroVariables { right, left, .. } = *variables;
    let rho = z[left];
    for k in 0..jacobian.ncols() {
        let of_right = jacobian[(right, k)];
        let of_left = jacobian[(left, k)];
        jacobian[(right, k)] = 0.5 * ((1.0 + rho) * of_right - (1.0 - rho) * of_left);
        jacobian[(left, k)] = 0.0;
    }

    jacobian[(right, left)] = 0.5 * (y[right] + y[left]);
    jacobian[(left, right)] = -1.0;
}

/// A start in a random mode: open, sticking, or sliding to one side. `size` is that of u.
pub(super) fn random_mode(
    variables: &ZeroVariables,
    size: f64,
    z: &mut [f64],
    rng: &mut ChaCha8Rng,
) {
    let v = size * normal(rng);
    match rng.random_range(0..3) {
        0 => {
            z[variables.gap] = size * normal(rng).abs();
            z[variables.right] = v;
            z[variables.left] = v.signum();
        }
        1 => z[variables.left] = rng.random_range(-1.0..1.0),
        _ => {
            z[variables.right] = v;
            z[variables.left] = v.signum();
        }
    }
}
