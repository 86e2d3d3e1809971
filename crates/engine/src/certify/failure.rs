//! Why a candidate was not certified: one entry for each support that was tried.
//!
//! The texts of the failures are printed by the program and written into reports.

use crate::report::negated;
use mceip_check::Reason;

/// A candidate that stays uncertified, with what was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct NotCertified {
    /// Every support that was tried, in order.
    pub attempts: Vec<SupportAttempt>,
}

/// One support and what failed on it.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportAttempt {
    /// The complementarity variables taken as slipping.
    pub support: Vec<usize>,
    /// What failed.
    pub failure: AttemptFailure,
}

/// What failed in an attempt.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AttemptFailure {
    /// The candidate has the wrong number of components.
    #[error("expected x with {expected} components, got {got}")]
    WrongLength {
        /// Variables of the pencil.
        expected: usize,
        /// Components given.
        got: usize,
    },
    /// A component or the value is NaN or infinite.
    #[error("expected finite numbers, got a value or component that is not")]
    NotFinite,
    /// More active variables than dense linear algebra is run for, or a larger binary exponent of
    /// the preconditioner than the checker takes.
    #[error("expected an order or binary exponent of at most {limit}, got {got}")]
    TooLarge {
        /// The bound.
        limit: usize,
        /// What there is.
        got: usize,
    },
    /// Every component is zero.
    #[error("E12: expected x != 0, got the zero vector")]
    ZeroX,
    /// The support's determinant has no root near the value: proved, within the interval named.
    #[error("E25: expected a root of the support's determinant in [{lo}, {hi}], got none")]
    NoRootNear {
        /// Lower end of the interval searched.
        lo: String,
        /// Upper end.
        hi: String,
    },
    /// A component that should be positive is not.
    #[error("E14: x[{index}]: expected > 0, got a non-positive exact value")]
    XNotPositive {
        /// The variable.
        index: usize,
    },
    /// A component of y is negative.
    #[error("E26: y[{index}]: expected >= 0, got a negative exact value")]
    YNegative {
        /// The row.
        index: usize,
    },
    /// There is a solution nearby in value, but with another x.
    #[error("expected x within {limit} of the candidate, got distance {distance}")]
    TooFar {
        /// Distance found.
        distance: f64,
        /// Distance allowed.
        limit: f64,
    },
    /// A sign that the claim needs is not the same all over the smallest box that is tried.
    #[error(
        "expected one sign of {what} over a box of 2^-{bits} of the largest component, got both or \
         zero"
    )]
    Undecided {
        /// What has no certain sign: x, y, or the value's distance to an end of the window.
        what: String,
        /// Bits of the grid of the box.
        bits: u32,
    },
    /// Refinement reached its cap.
    #[error("expected strict signs within {limit} halvings, got none")]
    Precision {
        /// The cap.
        limit: usize,
    },
    /// The Jacobian is singular in doubles.
    #[error("Krawczyk: expected a regular Jacobian at the candidate, got a singular one")]
    SingularJacobian,
    /// The checker refuses the claim that was made.
    #[error("the checker refuses the claim: {reason}")]
    Refused {
        /// The obligation that fails.
        reason: Box<Reason>,
    },
    /// Krawczyk's test fails around the candidate.
    #[error("Krawczyk: expected a box that maps into itself around the candidate, got none")]
    NotContracting,
}

impl AttemptFailure {
    /// Is it said of the numbers given, whatever the support?
    fn is_of_no_candidate(&self) -> bool {
        use AttemptFailure::{NotFinite, WrongLength, ZeroX};
        matches!(self, WrongLength { .. } | NotFinite | ZeroX)
    }
}

impl NotCertified {
    /// Is what was given no candidate at all: of another length, not finite, or zero?
    pub fn is_no_candidate(&self) -> bool {
        let mut attempts = self.attempts.iter();
        !self.attempts.is_empty() && attempts.all(|attempt| attempt.failure.is_of_no_candidate())
    }

    /// Of a point of the reflected problem, as one of the problem: values change their sign.
    pub(super) fn reflected(mut self) -> NotCertified {
        for attempt in &mut self.attempts {
            if let AttemptFailure::NoRootNear { lo, hi } = &mut attempt.failure {
                (*lo, *hi) = (negated(hi), negated(lo));
            }
        }
        self
    }

    /// A failure before any support was tried.
    pub(super) fn of(failure: AttemptFailure) -> Self {
        NotCertified {
            attempts: vec![SupportAttempt {
                support: Vec::new(),
                failure,
            }],
        }
    }
}

impl std::fmt::Display for NotCertified {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (k, attempt) in self.attempts.iter().enumerate() {
            if k > 0 {
                f.write_str("; ")?;
            }
            if !attempt.failure.is_of_no_candidate() {
                write!(f, "support {:?}: ", attempt.support)?;
            }
            write!(f, "{}", attempt.failure)?;
        }

        Ok(())
    }
}

impl std::error::Error for NotCertified {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_attempt_is_told() {
        let first = SupportAttempt {
            support: vec![0, 2],
            failure: AttemptFailure::XNotPositive { index: 2 },
        };
        let second = SupportAttempt {
            support: vec![1],
            failure: AttemptFailure::NotContracting,
        };

        let told = NotCertified {
            attempts: vec![first, second],
        };

        let told = told.to_string();
        assert!(told.starts_with("support [0, 2]: "), "{told}");
        assert!(told.contains("; support [1]: "), "{told}");
    }
}
