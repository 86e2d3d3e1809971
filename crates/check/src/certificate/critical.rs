//! `mceip-critical/1`: the certificate that there is no solution below a friction, and its file
//! form.
//!
//! The file states: for the mechanical system of the problem, with its contact states and signs,
//! every mu in [0, `below`] and every lambda^2 >= 0, problem (9) has no solution. The friction of
//! the problem file plays no part. So the critical friction, the infimum of mu over the solutions
//! with lambda^2 >= 0, is at least `below`.
//!
//! With t = lambda^2 the pencil and its Schur complement are affine in mu,
//!
//! ```text
//!     T(t, mu) = T0(t) + mu T1(t),
//! ```
//!
//! where T0 has the slip rows -S_p t_p'(K + tM) v and T1 the slip rows -n_p'(K + tM) v. The free
//! rows do not depend on mu. The file cuts [0, infinity) x [0, below] into boxes, and (supports)
//! with them, and each leaf proves that its box holds no solution.
//!
//! This module holds data and reads and writes it; it decides nothing. The checker is
//! `crate::critical`, the normative text is `spec/certificates.md`, 5.18.

use super::{
    Condensation, Factor, IntegerMatrix, Number, Piece, integer_rows, integers, object, rational,
    rational_or_zero,
};
use mceip_exact::{Integer, Rational};
use mceip_model::ModelError;
use mceip_model::file::{from_json_of, to_json_of};
use num_traits::Zero;
use serde::{Deserialize, Serialize};

/// The format of certified absence below a friction.
pub const CRITICAL_FORMAT: &str = "mceip-critical/1";

/// The claim that there is no solution with mu in [`from`, `below`] and lambda^2 >= 0, and its
/// proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CriticalCertificate {
    /// SHA-256 of the problem's canonical form.
    pub problem_sha256: String,
    /// Smallest friction of which absence is claimed; >= 0. A file without it means 0.
    #[serde(
        default,
        with = "rational_or_zero",
        skip_serializing_if = "Rational::is_zero"
    )]
    pub from: Rational,
    /// Largest friction of which absence is claimed; > `from`.
    #[serde(with = "rational")]
    pub below: Rational,
    /// How the free variables were eliminated; absent where there are none.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condensation: Option<CriticalCondensation>,
    /// Consecutive intervals of lambda^2 from 0 to infinity; the tree of each covers [`from`,
    /// `below`] as well.
    #[serde(deserialize_with = "super::cover::pieces_over_friction")]
    pub pieces: Vec<Piece>,
}

/// Proof that T restricted to the support of a box is regular everywhere in the box.
///
/// The support without the pivot, ascending, gives the rows and columns of `inverse`, and the
/// entries of `left` and `right`. Null vectors have the component 1 at the pivot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regular {
    /// The variable of the support whose component is set to 1.
    pub pivot: usize,
    /// Approximate inverse of T on the others, in units of 2^-`inverse_exponent`.
    #[serde(with = "integer_rows")]
    pub inverse: Vec<Vec<Integer>>,
    /// Binary exponent of `inverse`.
    pub inverse_exponent: u32,
    /// Approximate u with u'T = 0 on the others, in units of 2^-`exponent`.
    #[serde(with = "integers")]
    pub left: Vec<Integer>,
    /// Approximate v with Tv = 0 on the others, likewise.
    #[serde(with = "integers")]
    pub right: Vec<Integer>,
    /// Binary exponent of `left` and `right`.
    pub exponent: u32,
}

/// Elimination of the free variables; both parts of the condensed pencil are expanded at its
/// anchors.
pub type CriticalCondensation = Condensation<CriticalAnchor, CriticalTail>;

/// Approximations in powers of (t - center), as in [`super::Anchor`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CriticalAnchor {
    /// The value expanded about; of a reversed anchor its reciprocal.
    pub center: Number,
    /// Does it expand in powers of s - center, s = 1 / t?
    #[serde(default, skip_serializing_if = "super::cover::is_false")]
    pub reversed: bool,
    /// Coefficients of F^-1 T_fs.
    #[serde(deserialize_with = "object::list")]
    pub right: Vec<IntegerMatrix>,
    /// Coefficients of F^-1 T_sf', T_sf that of mu = 0; absent where they are those of `right`, as
    /// T_sf' = T_fs at mu = 0.
    #[serde(default, deserialize_with = "object::option_list")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<Vec<IntegerMatrix>>,
    /// Coefficients of F^-1 T_sf', T_sf the coefficient of mu.
    #[serde(deserialize_with = "object::list")]
    pub left_friction: Vec<IntegerMatrix>,
}

/// From `from` on, the symmetric part of the whole pencil is definite for every mu between the
/// `from` and the `below` of the certificate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CriticalTail {
    /// Where it begins.
    pub from: Number,
    /// Approximate Cholesky factor of sym(A + from B) at the smallest mu.
    #[serde(deserialize_with = "object::one")]
    pub factor: Factor,
    /// The same at mu = `below`.
    #[serde(deserialize_with = "object::one")]
    pub factor_below: Factor,
    /// Approximate Cholesky factor of sym(B) at the smallest mu, where that is no non-negative
    /// diagonal.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_factor: Option<Factor>,
    /// The same at mu = `below`.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_factor_below: Option<Factor>,
}

impl CriticalCertificate {
    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        to_json_of(CRITICAL_FORMAT, self)
    }

    /// Reads a certificate.
    ///
    /// # Errors
    /// [`ModelError`]: not JSON of this shape, another version, unknown or duplicate fields, a
    /// number that cannot be read.
    pub fn from_json(text: &str) -> Result<CriticalCertificate, ModelError> {
        from_json_of(CRITICAL_FORMAT, text)
    }
}
