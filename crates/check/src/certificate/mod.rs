//! `mceip-certificate/1`: what a certificate says, and its file form. (`critical` does the same for
//! `mceip-critical/1`, `presence` for `mceip-presence/1`, `equilibrium` for `mceip-equilibrium/1`,
//! `stability` for `mceip-stability/1`.)
//!
//! This module holds data and reads and writes it; it decides nothing. A certificate names its
//! problem by digest, states a window of values and makes claims: solutions ([`Claim`]), and
//! possibly that there are no others in the window ([`CompleteSet`]). What each claim has to meet
//! is checked elsewhere in this crate, one module per kind. The normative text is
//! `spec/certificates.md`.
//!
//! Numbers are read exactly as they are spelt. Unknown and duplicate fields are refused, so that no
//! reader can pass over a part of a claim it does not understand.

use mceip_exact::{Integer, Rational};
use mceip_model::file::{Number, from_json_of, to_json_of};
use mceip_model::{ModelError, Problem, RealWindow, Unknown, Window};
use serde::{Deserialize, Serialize};

mod cover;
mod critical;
mod equilibrium;
mod presence;
mod row;
mod stability;
pub use cover::{
    Alone, Anchor, CompleteSet, Condensation, Exact, Factor, IntegerMatrix, Ldl, LdlFactor, Member,
    Node, Piece, Polynomials, Root, RootOutcome, Support, SupportPoint, Tail, VariableState,
};
pub use critical::{
    CRITICAL_FORMAT, CriticalAnchor, CriticalCertificate, CriticalCondensation, CriticalTail,
    Regular,
};
pub use equilibrium::{
    EQUILIBRIUM_FORMAT, EquilibriumCertificate, SlipSign, StatedEquilibrium, StatedState,
};
pub use presence::{PRESENCE_FORMAT, PresenceCertificate, PresencePiece};
pub use row::IntegerRow;
pub use stability::{STABILITY_FORMAT, StabilityCertificate, StabilityCondensation, StabilityEnd};

/// The format this program reads and writes.
pub const CERTIFICATE_FORMAT: &str = "mceip-certificate/1";

/// Claims about one problem, bound to its matrices by digest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// SHA-256 of the problem's canonical form.
    pub problem_sha256: String,
    /// The unknown of the problem.
    #[serde(deserialize_with = "object::word")]
    pub unknown: Unknown,
    /// The window in which every claimed value lies.
    #[serde(with = "window")]
    pub window: Window,
    /// Solutions claimed; may be empty beside a complete set.
    pub claims: Vec<Claim>,
    /// The claim that there are no other solutions in the window.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub complete_set: Option<CompleteSet>,
    /// The same of the values below 0 of an eigenvalue problem.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub negative: Option<Box<NegativeValues>>,
}

/// What is claimed of the values t < 0 of an eigenvalue problem: claims about the reflected pencil
/// (A, -B), whose values are -t.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NegativeValues {
    /// The window in which every claimed -t lies.
    #[serde(with = "window")]
    pub window: Window,
    /// Solutions of the reflected pencil.
    pub claims: Vec<Claim>,
    /// The claim that it has no others in the window.
    #[serde(default, deserialize_with = "object::option")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub complete_set: Option<CompleteSet>,
}

/// What is claimed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// A solution over Q(alpha).
    #[serde(deserialize_with = "object::one")]
    ExactSolution(ExactSolution),
    /// A solution over Q(alpha) in the degrees of freedom of a mechanical system.
    #[serde(deserialize_with = "object::one")]
    LiftedSolution(LiftedSolution),
    /// A solution in a box, by Krawczyk's test.
    #[serde(deserialize_with = "object::one")]
    EnclosedSolution(EnclosedSolution),
}

/// An exact solution: alpha as (polynomial, isolating interval), x as polynomials in alpha.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExactSolution {
    /// Complementarity variables with x_i > 0, ascending.
    pub support: Vec<usize>,
    /// Complementarity variables with x_i = y_i = 0, ascending.
    pub biactive: Vec<usize>,
    /// Integer polynomial p with p(alpha) = 0, constant term first.
    #[serde(with = "integers")]
    pub polynomial: Vec<Integer>,
    /// [a, b]: a = b with p(a) = 0, or p(a) p(b) < 0 and p' of one sign between.
    pub interval: [Number; 2],
    /// x_i(alpha) as rational polynomials, constant term first, one list per variable.
    pub x: Vec<Vec<Number>>,
}

/// A solution in the degrees of freedom of a mechanical system: v and w of (9).
///
/// Both are rational polynomials in alpha, constant term first, one list per degree of freedom.
/// Indices are those of the pencil: free dofs ascending, then slip particles in file order.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LiftedSolution {
    /// Slip particles with S v_T < 0.
    pub support: Vec<usize>,
    /// Slip particles with S v_T = S w_T + mu w_N = 0.
    pub biactive: Vec<usize>,
    /// As in [`ExactSolution`].
    #[serde(with = "integers")]
    pub polynomial: Vec<Integer>,
    /// As in [`ExactSolution`].
    pub interval: [Number; 2],
    /// v(alpha).
    pub v: Vec<Vec<Number>>,
    /// w(alpha).
    pub w: Vec<Vec<Number>>,
}

/// A box that contains exactly one solution, with strict signs.
///
/// The equations are (A + tB) x = 0 on the active rows and e'x_s = 1; the unknowns are the active
/// variables (free or in the support) ascending, then t.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EnclosedSolution {
    /// Complementarity variables with x_i > 0, ascending.
    pub support: Vec<usize>,
    /// Centre of the box.
    pub center: Vec<Number>,
    /// Half width of the box in each unknown, > 0.
    pub radius: Vec<Number>,
    /// Approximate inverse of the Jacobian at the centre, integers in units of 2^-`exponent`,
    /// row by row. Rows of the Jacobian are the active rows with denominators cleared, then e'.
    #[serde(with = "integer_rows")]
    pub preconditioner: Vec<Vec<Integer>>,
    /// Binary exponent of the preconditioner.
    pub exponent: u32,
}

impl Certificate {
    /// Claims about a problem in its window, and nothing else.
    pub fn of_claims(problem: &Problem, claims: Vec<Claim>) -> Certificate {
        Certificate {
            problem_sha256: problem.sha256(),
            unknown: problem.unknown(),
            window: problem.window().clone(),
            claims,
            complete_set: None,
            negative: None,
        }
    }

    /// The windows of its complete sets or, without any, of its claims: two where values of both
    /// signs are spoken of and 0 does not join them.
    pub fn windows(&self) -> Vec<RealWindow> {
        let negative = self.negative.as_ref();
        let has_set = self.complete_set.is_some();
        let negative_has_set = negative.is_some_and(|part| part.complete_set.is_some());
        let has_any_set = has_set || negative_has_set;

        let is_spoken_of = |has_set: bool, claims: &[Claim]| match has_any_set {
            true => has_set,
            false => !claims.is_empty(),
        };
        let negative = negative.filter(|part| is_spoken_of(negative_has_set, &part.claims));
        let window = is_spoken_of(has_set, &self.claims).then_some(&self.window);
        RealWindow::of_parts(negative.map(|part| &part.window), window)
    }

    /// With what a certificate of the reflected problem (A, -B) says as its values below 0.
    #[must_use]
    pub fn with_negative(self, reflected: Certificate) -> Certificate {
        let negative = NegativeValues {
            window: reflected.window,
            claims: reflected.claims,
            complete_set: reflected.complete_set,
        };
        Certificate {
            negative: Some(Box::new(negative)),
            ..self
        }
    }

    /// What it says of values that are not negative, and what it says of the others, as a
    /// certificate of the reflected problem with this digest.
    pub fn by_sign(self, reflected_sha256: String) -> (Certificate, Option<Certificate>) {
        let unknown = self.unknown;
        let reflected = self.negative.map(|negative| Certificate {
            problem_sha256: reflected_sha256,
            unknown,
            window: negative.window,
            claims: negative.claims,
            complete_set: negative.complete_set,
            negative: None,
        });
        let non_negative = Certificate {
            negative: None,
            ..self
        };

        (non_negative, reflected)
    }

    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        to_json_of(CERTIFICATE_FORMAT, self)
    }

    /// Reads a certificate.
    ///
    /// # Errors
    /// [`ModelError`]: not JSON of this shape, another version, unknown or duplicate fields, a
    /// number that cannot be read, an empty window, values below 0 of another unknown than an
    /// eigenvalue.
    pub fn from_json(text: &str) -> Result<Certificate, ModelError> {
        let read: Certificate = from_json_of(CERTIFICATE_FORMAT, text)?;
        if read.negative.is_some() && read.unknown != Unknown::Eigenvalue {
            return Err(ModelError::NegativeValues {
                unknown: read.unknown.word(),
            });
        }

        Ok(read)
    }
}

/// Readers of JSON objects: the library would also read a struct from a list of its fields, or a
/// word from an object with one key, which the format does not allow.
mod object {
    use mceip_model::file::{Object, Word};
    use serde::{Deserialize, Deserializer};

    pub(super) fn one<'de, D: Deserializer<'de>, T: Deserialize<'de>>(d: D) -> Result<T, D::Error> {
        Ok(Object::deserialize(d)?.0)
    }

    pub(super) fn word<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        d: D,
    ) -> Result<T, D::Error> {
        Ok(Word::deserialize(d)?.0)
    }

    pub(super) fn option<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        d: D,
    ) -> Result<Option<T>, D::Error> {
        let object = Option::<Object<T>>::deserialize(d)?;
        Ok(object.map(|o| o.0))
    }

    pub(super) fn list<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        d: D,
    ) -> Result<Vec<T>, D::Error> {
        let objects = Vec::<Object<T>>::deserialize(d)?;
        Ok(objects.into_iter().map(|o| o.0).collect())
    }

    pub(super) fn option_list<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        d: D,
    ) -> Result<Option<Vec<T>>, D::Error> {
        let objects = Option::<Vec<Object<T>>>::deserialize(d)?;
        Ok(objects.map(|list| list.into_iter().map(|o| o.0).collect()))
    }
}

/// A window in a file, which has a lower end.
mod window {
    use super::{Number, Window, object};
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct WindowEnds {
        min: Number,
        max: Option<Number>,
    }

    pub(super) fn serialize<S: Serializer>(window: &Window, s: S) -> Result<S::Ok, S::Error> {
        let ends = WindowEnds {
            min: Number(window.min().clone()),
            max: window.max().cloned().map(Number),
        };
        ends.serialize(s)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Window, D::Error> {
        let WindowEnds { min, max } = object::one(d)?;
        Window::new(min.0, max.map(|number| number.0)).map_err(D::Error::custom)
    }
}

/// A number of a file.
mod rational {
    use super::{Number, Rational};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(number: &Rational, s: S) -> Result<S::Ok, S::Error> {
        Number(number.clone()).serialize(s)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Rational, D::Error> {
        Ok(Number::deserialize(d)?.0)
    }
}

/// An optional number of a file, 0 where it is null.
mod rational_or_zero {
    use super::{Number, Rational};
    use serde::{Deserialize, Deserializer};

    pub(super) use super::rational::serialize;

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Rational, D::Error> {
        let number = Option::<Number>::deserialize(d)?;
        Ok(number.map(|number| number.0).unwrap_or_default())
    }
}

/// A list of integers in a file, as [`IntegerRow`] has it.
mod integers {
    use super::{Integer, IntegerRow};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(list: &[Integer], s: S) -> Result<S::Ok, S::Error> {
        IntegerRow::from(list.to_vec()).serialize(s)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<Integer>, D::Error> {
        Ok(IntegerRow::deserialize(d)?.to_vec())
    }
}

/// A list of lists of integers in a file.
mod integer_rows {
    use super::{Integer, IntegerRow};
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(rows: &[Vec<Integer>], s: S) -> Result<S::Ok, S::Error> {
        s.collect_seq(rows.iter().map(|row| IntegerRow::from(row.clone())))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        d: D,
    ) -> Result<Vec<Vec<Integer>>, D::Error> {
        let rows = Vec::<IntegerRow>::deserialize(d)?;
        Ok(rows.iter().map(IntegerRow::to_vec).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    fn example() -> Certificate {
        let claim = ExactSolution {
            support: vec![0],
            biactive: vec![],
            polynomial: vec![Integer::from(-2), Integer::from(0), Integer::from(1)],
            interval: [Number(whole(1)), Number(rational(3, 2))],
            x: vec![vec![Number(whole(1))]],
        };
        Certificate {
            problem_sha256: "00".into(),
            unknown: Unknown::Mu,
            window: Window::all(),
            claims: vec![Claim::ExactSolution(claim)],
            complete_set: None,
            negative: None,
        }
    }

    #[test]
    fn files_round_trip() {
        assert_eq!(
            Certificate::from_json(&example().to_json()).unwrap(),
            example()
        );
    }

    #[test]
    fn malformed_certificates_are_refused() {
        let good = example().to_json();
        for (from, to) in [
            ("mceip-certificate/1", "mceip-certificate/2"),
            ("exact_solution", "magic"),
            ("\"support\":[0]", "\"support\":[-1]"),
            ("\"support\":[0]", "\"support\":[0],\"support\":[0]"),
            ("\"biactive\":[]", "\"biactive\":[],\"trust\":\"me\""),
            ("\"-2\"", "\"-2.5\""),
            ("\"3/2\"", "\"3/0\""),
            ("\"3/2\"", "null"),
        ] {
            assert!(good.contains(from));
            assert!(
                Certificate::from_json(&good.replace(from, to)).is_err(),
                "{from} -> {to}"
            );
        }
        assert!(Certificate::from_json(&good[..good.len() - 1]).is_err());
    }
}
