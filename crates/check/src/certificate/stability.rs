//! `mceip-stability/1`: the certificate that an equilibrium is stable for every friction of an
//! interval, and its file form.
//!
//! The file states: for the mechanical system of the problem, with its contact states and signs,
//! and every mu in [`from`, `to`] without 0, a motion that begins near the equilibrium stays near
//! it (the theorem of `spec/stability.md`). The friction of the problem file plays no part.
//!
//! Its evidence are two matrices, one at each end of the interval, below the condensed pencil at
//! lambda^2 = 0, and bounds of the work that the vibration of the free degrees of freedom can do.
//!
//! This module holds data and reads and writes it; it decides nothing. The checker is
//! `crate::stability`, the normative text is `spec/certificates.md`, 5.21.

use super::{
    Factor, IntegerMatrix, Number, integer_rows, integers, object, rational, rational_or_zero,
};
use mceip_exact::{Integer, Rational};
use mceip_model::ModelError;
use mceip_model::file::{from_json_of, to_json_of};
use num_traits::Zero;
use serde::{Deserialize, Serialize};

/// The format of certified stability on an interval of friction.
pub const STABILITY_FORMAT: &str = "mceip-stability/1";

/// The claim that the equilibrium is stable for every mu > 0 in [`from`, `to`], and its proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilityCertificate {
    /// SHA-256 of the problem's canonical form.
    pub problem_sha256: String,
    /// Smallest friction; >= 0. A file without it means 0.
    #[serde(
        default,
        with = "rational_or_zero",
        skip_serializing_if = "Rational::is_zero"
    )]
    pub from: Rational,
    /// Largest friction; > `from`.
    #[serde(with = "rational")]
    pub to: Rational,
    /// m > 0 with M0 - m I positive semidefinite, M0 the mass of the admissible motions.
    #[serde(with = "rational")]
    pub mass_sigma: Rational,
    /// Approximate Cholesky factor of M0 - m I, where that is no diagonal matrix.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_factor: Option<Factor>,
    /// How the free variables were eliminated; absent where there are none.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condensation: Option<StabilityCondensation>,
    /// The evidence at mu = `from`.
    #[serde(deserialize_with = "object::one")]
    pub lower: StabilityEnd,
    /// The evidence at mu = `to`.
    #[serde(deserialize_with = "object::one")]
    pub upper: StabilityEnd,
}

/// Elimination of the free variables at lambda^2 = 0.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilityCondensation {
    /// sigma > 0 with K_ff - sigma I positive semidefinite.
    pub sigma: Number,
    /// Approximate Cholesky factor of K_ff - sigma I.
    #[serde(deserialize_with = "object::one")]
    pub stiffness_factor: Factor,
    /// W, approximately K_ff^-1 K_fs: a row per free and a column per slip variable.
    #[serde(deserialize_with = "object::one")]
    pub right: IntegerMatrix,
    /// V, approximately K_ff^-1 R_f', R the coefficient of mu; of the same shape.
    #[serde(deserialize_with = "object::one")]
    pub left_friction: IntegerMatrix,
    /// G', approximately: G M_ff is what mu adds to the mass in the slip rows and free columns; of
    /// the same shape. Absent where that is zero.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<IntegerMatrix>,
}

/// The evidence at one friction.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StabilityEnd {
    /// Binary exponent of `symmetric` and `bounds`.
    pub exponent: u32,
    /// Q, symmetric and below the condensed pencil, entry by entry, in units of 2^-`exponent`.
    #[serde(with = "integer_rows")]
    pub symmetric: Vec<Vec<Integer>>,
    /// b, likewise: b_i bounds the work of the free degrees of freedom on slip particle i.
    #[serde(with = "integers")]
    pub bounds: Vec<Integer>,
    /// Approximate Cholesky factor of 4 Q - b b'.
    #[serde(deserialize_with = "object::one")]
    pub factor: Factor,
}

impl StabilityCertificate {
    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        to_json_of(STABILITY_FORMAT, self)
    }

    /// Reads a certificate.
    ///
    /// # Errors
    /// [`ModelError`]: not JSON of this shape, another version, unknown or duplicate fields, a
    /// number that cannot be read.
    pub fn from_json(text: &str) -> Result<StabilityCertificate, ModelError> {
        from_json_of(STABILITY_FORMAT, text)
    }
}
