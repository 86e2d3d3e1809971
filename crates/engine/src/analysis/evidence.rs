//! What stands behind a sentence: certificates accepted by the checker, exact conditions,
//! measurements.

use crate::lean::{LeanError, shorten};
use crate::run::Watch;
use mceip_check::Proved;
use mceip_check::certificate::{
    Certificate, CriticalCertificate, PresenceCertificate, StabilityCertificate,
};
use mceip_model::{ModelError, Problem};

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

impl Evidence {
    /// Is it no proof?
    pub fn is_measured(&self) -> bool {
        matches!(self, Evidence::Measured(_))
    }
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

impl Proof {
    pub(super) fn new(
        name: impl Into<String>,
        problem: Problem,
        certificate: ProofCertificate,
    ) -> Proof {
        Proof {
            name: name.into(),
            problem,
            certificate,
        }
    }
}

/// The file of a proof's certificate, as an answer names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProofFile {
    /// SHA-256 of its text.
    pub sha256: String,
    /// Where it has been written.
    pub path: Option<String>,
}

/// The certificate of a proof.
#[derive(Debug, Clone)]
pub enum ProofCertificate {
    /// Solutions, or all solutions in a window (`mceip-certificate/1`).
    Solutions(Proved<Certificate>),
    /// No solution for any friction of an interval (`mceip-critical/1`).
    Absence(Proved<CriticalCertificate>),
    /// A solution for every friction of an interval (`mceip-presence/1`).
    Presence(Proved<PresenceCertificate>),
    /// Stability for every friction of an interval (`mceip-stability/1`).
    Stability(Proved<StabilityCertificate>),
}

impl ProofCertificate {
    /// The text of its file.
    ///
    /// # Errors
    /// As [`Proved::file`].
    pub fn file(&self) -> Result<String, ModelError> {
        match self {
            ProofCertificate::Solutions(proved) => proved.file(),
            ProofCertificate::Absence(proved) => proved.file(),
            ProofCertificate::Presence(proved) => proved.file(),
            ProofCertificate::Stability(proved) => proved.file(),
        }
    }

    /// The text of its lean file; `None` where nothing can be left out.
    ///
    /// # Errors
    /// As [`shorten`].
    pub fn lean_file(
        &self,
        problem: &Problem,
        watch: &Watch<'_>,
    ) -> Result<Option<String>, LeanError> {
        match self {
            ProofCertificate::Solutions(proved) => shorten(problem, proved.certificate(), watch),
            ProofCertificate::Absence(proved) => shorten(problem, proved.certificate(), watch),
            ProofCertificate::Presence(proved) => shorten(problem, proved.certificate(), watch),
            ProofCertificate::Stability(_) => Ok(None),
        }
    }

    /// Is this a clone of the other one?
    pub fn is_clone_of(&self, other: &ProofCertificate) -> bool {
        match (self, other) {
            (ProofCertificate::Solutions(p), ProofCertificate::Solutions(q)) => p.is_clone_of(q),
            (ProofCertificate::Absence(p), ProofCertificate::Absence(q)) => p.is_clone_of(q),
            (ProofCertificate::Presence(p), ProofCertificate::Presence(q)) => p.is_clone_of(q),
            (ProofCertificate::Stability(p), ProofCertificate::Stability(q)) => p.is_clone_of(q),
            (
                ProofCertificate::Solutions(_)
                | ProofCertificate::Absence(_)
                | ProofCertificate::Presence(_)
                | ProofCertificate::Stability(_),
                _,
            ) => false,
        }
    }
}
