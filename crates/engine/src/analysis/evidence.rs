//! What stands behind a sentence: certificates accepted by the checker, exact conditions,
//! measurements.

use mceip_check::certificate::{Certificate, CriticalCertificate, PresenceCertificate};
use mceip_model::Problem;

/// What stands behind a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Evidence {
    /// A certificate, accepted by the checker: index into
    /// [`Analysis::proofs`](super::Analysis::proofs).
    Certificate(usize),
    /// Decided in exact arithmetic, named here; running the analysis again is the check.
    Exact(&'static str),
    /// Computed in doubles: no proof.
    Measured(&'static str),
}

/// A problem and a certificate for it that the checker has accepted.
#[derive(Debug, Clone)]
pub struct Proof {
    /// Name of the pair, for files.
    pub name: String,
    /// The problem.
    pub problem: Problem,
    /// The certificate.
    pub certificate: ProofCertificate,
}

/// The certificate of a proof.
#[derive(Debug, Clone)]
pub enum ProofCertificate {
    /// Solutions, or all solutions in a window (`mceip-certificate/1`).
    Solutions(Certificate),
    /// No solution for any friction of an interval (`mceip-critical/1`).
    Absence(CriticalCertificate),
    /// A solution for every friction of an interval (`mceip-presence/1`).
    Presence(PresenceCertificate),
}

impl ProofCertificate {
    /// The certificate as JSON.
    pub fn to_json(&self) -> String {
        match self {
            ProofCertificate::Solutions(certificate) => certificate.to_json(),
            ProofCertificate::Absence(certificate) => certificate.to_json(),
            ProofCertificate::Presence(certificate) => certificate.to_json(),
        }
    }
}
