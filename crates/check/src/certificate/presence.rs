//! `mceip-presence/1`: the certificate that there is a solution for every friction of an interval,
//! and its file form.
//!
//! The file states: for the mechanical system of the problem, with its contact states and signs,
//! and every mu in [`from`, `to`], problem (9) has a solution with x != 0 and lambda^2 >= 0. The
//! friction of the problem file plays no part.
//!
//! The file cuts [`from`, `to`] into consecutive intervals. Each piece names an interval of
//! t = lambda^2 and a support on which the pencil T(t, mu) = T0(t) + mu T1(t) becomes singular
//! between the ends of that interval, for every mu of the piece, with x > 0 and y >= 0.
//!
//! This module holds data and reads and writes it; it decides nothing. The checker is
//! `crate::presence`, the normative text is `spec/certificates.md`, 5.19.

use super::{
    CriticalAnchor, CriticalCondensation, Factor, Number, integer_rows, integers, object, rational,
};
use mceip_exact::{Integer, Rational};
use mceip_model::ModelError;
use mceip_model::file::{from_json_of, to_json_of};
use serde::{Deserialize, Deserializer, Serialize};

/// The format of certified presence on an interval of friction.
pub const PRESENCE_FORMAT: &str = "mceip-presence/1";

/// The claim that there is a solution for every mu in [`from`, `to`], and its proof.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PresenceCertificate {
    /// SHA-256 of the problem's canonical form.
    pub problem_sha256: String,
    /// Smallest friction; >= 0.
    #[serde(with = "rational")]
    pub from: Rational,
    /// Largest friction; > `from`.
    #[serde(with = "rational")]
    pub to: Rational,
    /// How the free variables were eliminated, without a tail; absent where there are none.
    #[serde(default, deserialize_with = "without_tail")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condensation: Option<CriticalCondensation>,
    /// Consecutive intervals of mu.
    #[serde(deserialize_with = "object::list")]
    pub pieces: Vec<PresencePiece>,
}

/// One interval of mu, and a box of (lambda^2, mu) that holds a solution for each of its mu.
///
/// The moving variables without the pivot, ascending, are the rows and columns of `inverse`, and
/// the entries of `left` and `right`. Null vectors have the component 1 at the pivot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PresencePiece {
    /// Where the interval of mu ends and that of the next piece begins.
    pub to: Number,
    /// The interval of lambda^2.
    pub interval: [Number; 2],
    /// The anchor of the condensation that encloses the pencil here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<usize>,
    /// The slip variables that move, by their index in the pencil, ascending.
    pub support: Vec<usize>,
    /// The one of them whose component is set to 1.
    pub pivot: usize,
    /// Approximate inverse of T on the others, in units of 2^-`inverse_exponent`.
    #[serde(with = "integer_rows")]
    pub inverse: Vec<Vec<Integer>>,
    /// Binary exponent of `inverse`.
    pub inverse_exponent: u32,
    /// Approximate left null vector on the others, in units of 2^-`exponent`.
    #[serde(with = "integers")]
    pub left: Vec<Integer>,
    /// Approximate right null vector, likewise.
    #[serde(with = "integers")]
    pub right: Vec<Integer>,
    /// Binary exponent of `left` and `right`.
    pub exponent: u32,
}

/// Elimination of the free variables as a file spells it: that of `mceip-critical/1` without a
/// tail.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WithoutTail {
    sigma: Number,
    #[serde(deserialize_with = "object::one")]
    stiffness_factor: Factor,
    mass_sigma: Number,
    #[serde(default, deserialize_with = "object::option")]
    mass_factor: Option<Factor>,
    #[serde(deserialize_with = "object::list")]
    anchors: Vec<CriticalAnchor>,
}

fn without_tail<'de, D: Deserializer<'de>>(d: D) -> Result<Option<CriticalCondensation>, D::Error> {
    let read: Option<WithoutTail> = object::option(d)?;
    Ok(read.map(|read| CriticalCondensation {
        sigma: read.sigma,
        stiffness_factor: read.stiffness_factor,
        mass_sigma: read.mass_sigma,
        mass_factor: read.mass_factor,
        anchors: read.anchors,
        tail: None,
    }))
}

impl PresenceCertificate {
    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        to_json_of(PRESENCE_FORMAT, self)
    }

    /// Reads a certificate.
    ///
    /// # Errors
    /// [`ModelError`]: not JSON of this shape, another version, unknown or duplicate fields, a
    /// number that cannot be read.
    pub fn from_json(text: &str) -> Result<PresenceCertificate, ModelError> {
        from_json_of(PRESENCE_FORMAT, text)
    }
}
