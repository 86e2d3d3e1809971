//! `mceip-equilibrium/1`: the certificate that a body under loads has an equilibrium in given
//! contact states, and its file form.
//!
//! The file states: with so much of each load applied and this friction, the body of
//! `mceip-loads/1` has an equilibrium (5)-(7) in which each candidate is in this state, and the
//! sticking ones are at these places. That it is the only equilibrium is not stated.
//!
//! This module holds data and reads and writes it; it decides nothing. The checker is
//! `crate::equilibrium`, the normative text is `spec/certificates.md`, 5.20.

use super::{Claim, Number, object};
use mceip_exact::Rational;
use mceip_model::file::{from_json_of, to_json_of};
use mceip_model::{ContactState, ModelError};
use serde::{Deserialize, Serialize};

/// The format of certified contact states.
pub const EQUILIBRIUM_FORMAT: &str = "mceip-equilibrium/1";

/// The claim that loads have an equilibrium in given contact states, and its proof.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EquilibriumCertificate {
    /// SHA-256 of the canonical form of the body and its loads.
    pub loads_sha256: String,
    /// What is stated.
    pub stated: StatedEquilibrium,
    /// A solution of the pencil of the statement ([`crate::EquilibriumPencil`]).
    pub claim: Claim,
}

/// Which equilibrium it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatedEquilibrium {
    /// mu > 0.
    pub friction: Rational,
    /// How much of each load is applied.
    pub amounts: Vec<Rational>,
    /// The state of each candidate.
    pub candidates: Vec<StatedState>,
}

/// The contact state of a candidate at an equilibrium, with what the state leaves open.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "state", rename_all = "snake_case", deny_unknown_fields)]
pub enum StatedState {
    /// Not in contact.
    Free {},
    /// In contact, inside the friction cone.
    Stick {
        /// Its u_T: where it sticks depends on how the loads came to be applied.
        tangential: Number,
    },
    /// In impending slip with sign S: on the side of the cone where S r_T > 0.
    Slip {
        /// S.
        sign: SlipSign,
    },
    /// In contact without reaction.
    Zero {},
}

impl StatedState {
    /// The contact state alone.
    pub fn contact_state(&self) -> ContactState {
        match self {
            StatedState::Free {} => ContactState::Free,
            StatedState::Stick { .. } => ContactState::Stick,
            StatedState::Slip { sign } => ContactState::Slip {
                sign: i8::from(*sign),
            },
            StatedState::Zero {} => ContactState::Zero,
        }
    }
}

/// S = 1 or -1, and nothing else: another number would be another law of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "i8", into = "i8")]
pub enum SlipSign {
    /// S = 1.
    Plus,
    /// S = -1.
    Minus,
}

impl SlipSign {
    /// The sign of a number that is 1 or -1.
    pub fn of(sign: i8) -> SlipSign {
        if sign > 0 {
            SlipSign::Plus
        } else {
            SlipSign::Minus
        }
    }
}

impl From<SlipSign> for i8 {
    fn from(sign: SlipSign) -> i8 {
        match sign {
            SlipSign::Plus => 1,
            SlipSign::Minus => -1,
        }
    }
}

impl TryFrom<i8> for SlipSign {
    type Error = String;

    fn try_from(number: i8) -> Result<SlipSign, String> {
        match number {
            1 => Ok(SlipSign::Plus),
            -1 => Ok(SlipSign::Minus),
            other => Err(format!("expected 1 or -1, got {other}")),
        }
    }
}

/// The file form of an [`EquilibriumCertificate`].
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EquilibriumFile {
    loads_sha256: String,
    friction: Number,
    amounts: Vec<Number>,
    #[serde(deserialize_with = "object::list")]
    candidates: Vec<StatedState>,
    claim: Claim,
}

impl EquilibriumCertificate {
    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        let StatedEquilibrium {
            friction,
            amounts,
            candidates,
        } = &self.stated;
        let file = EquilibriumFile {
            loads_sha256: self.loads_sha256.clone(),
            friction: Number(friction.clone()),
            amounts: amounts.iter().cloned().map(Number).collect(),
            candidates: candidates.clone(),
            claim: self.claim.clone(),
        };

        to_json_of(EQUILIBRIUM_FORMAT, &file)
    }

    /// Reads a certificate.
    ///
    /// # Errors
    /// [`ModelError`]: not JSON of this shape, another version, unknown or duplicate fields, a
    /// number that cannot be read.
    pub fn from_json(text: &str) -> Result<EquilibriumCertificate, ModelError> {
        let file: EquilibriumFile = from_json_of(EQUILIBRIUM_FORMAT, text)?;

        Ok(EquilibriumCertificate {
            loads_sha256: file.loads_sha256,
            stated: StatedEquilibrium {
                friction: file.friction.0,
                amounts: file.amounts.into_iter().map(|amount| amount.0).collect(),
                candidates: file.candidates,
            },
            claim: file.claim,
        })
    }
}
