//! What two parts of the project disagree about.
//!
//! Every comparison of engines ends in counts or in one of these. Returned by `compare`,
//! `completed` and the campaign; reports and replay files print them.

/// Two parts of the project that do not say the same. Any of these is a bug.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Disagreement {
    /// The closed form of Table 1 and the enumerator differ.
    #[error(
        "closed form lists {closed} solutions, the enumerator {enumerated}, or they differ in \
         value, x or support"
    )]
    ClosedForm {
        /// Solutions of the closed form.
        closed: usize,
        /// Solutions of the enumerator.
        enumerated: usize,
    },
    /// A certified solution is not among the enumerator's.
    #[error("certified solution with support {support:?} is not in the enumerator's list")]
    NotInOracle {
        /// Its support.
        support: Vec<usize>,
    },
    /// The complete search claims a complete set that is not the enumerator's.
    #[error(
        "complete set of {claimed} solutions, the enumerator lists {enumerated} (or a cone, or a \
         continuum)"
    )]
    Incomplete {
        /// Solutions of the complete set.
        claimed: usize,
        /// Solutions of the enumerator.
        enumerated: usize,
    },
    /// A solution of the enumerator could not be certified.
    #[error("solution {index} of the enumerator was not certified: {reason}")]
    OracleNotCertified {
        /// Its index.
        index: usize,
        /// Why.
        reason: String,
    },
    /// The checker rejects what was certified.
    #[error("checker rejects a certified claim: {reason}")]
    Rejected {
        /// Why.
        reason: String,
    },
    /// The verified checker refuses what the checker accepts.
    #[error("the verified checker refuses a certificate that `check` accepts: {reason}")]
    VerifiedChecker {
        /// Its verdict.
        reason: String,
    },
    /// The checker accepts a forgery, or rejects it for another reason than the one broken.
    #[error("forgery {name:?}: {got}")]
    Forgery {
        /// Which forgery.
        name: &'static str,
        /// "accepted", or the other reason.
        got: String,
    },
    /// A lifted solution violates (9).
    #[error("lifted solution {index} violates (9): {line}")]
    Lift {
        /// Index in the enumerator's list.
        index: usize,
        /// The line.
        line: String,
    },
    /// Another enumerator answers otherwise than the plain one.
    #[error(
        "{got} solutions, the enumerator lists {enumerated}, or they differ in value, support, x, \
         cones or ranges"
    )]
    Enumerators {
        /// Solutions of the other.
        got: usize,
        /// Solutions of the plain enumerator.
        enumerated: usize,
    },
    /// The enumerator does not give the answer known by construction.
    #[error("known by construction: {expected}; the enumerator lists {enumerated} solutions")]
    Known {
        /// What is known.
        expected: String,
        /// Solutions of the enumerator.
        enumerated: usize,
    },
    /// An engine panicked.
    #[error("panic: {message}")]
    Panicked {
        /// The panic's message.
        message: String,
    },
    /// An engine refused the instance.
    #[error("{engine} refused the instance: {reason}")]
    Refused {
        /// Which engine.
        engine: &'static str,
        /// Why.
        reason: String,
    },
}

impl Disagreement {
    pub(crate) fn refused(engine: &'static str, reason: &dyn std::fmt::Display) -> Disagreement {
        let reason = reason.to_string();
        Disagreement::Refused { engine, reason }
    }

    /// What kind it is, in a word that a shrunk instance must keep.
    pub fn kind(&self) -> &'static str {
        match self {
            Disagreement::ClosedForm { .. } => "closed-form",
            Disagreement::NotInOracle { .. } => "not-in-oracle",
            Disagreement::Incomplete { .. } => "incomplete",
            Disagreement::OracleNotCertified { .. } => "not-certified",
            Disagreement::Rejected { .. } => "rejected",
            Disagreement::VerifiedChecker { .. } => "verified-checker",
            Disagreement::Forgery { .. } => "forgery",
            Disagreement::Lift { .. } => "lift",
            Disagreement::Enumerators { .. } => "enumerators",
            Disagreement::Known { .. } => "known-answer",
            Disagreement::Panicked { .. } => "panic",
            Disagreement::Refused { .. } => "refused",
        }
    }
}
