//! How many certificates of a run the verified checker accepts, in all and for each kind of
//! evidence.

use super::VerifiedChecker;
use super::kinds::kinds_of;
use super::verdict::VerifiedVerdict;
use mceip_check::certificate::Certificate;
use mceip_model::Problem;
use std::collections::BTreeMap;

/// Verdicts on certificates.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize)]
pub struct VerifiedCounts {
    /// Certificates whose statement is proved, those with open regions among them.
    pub accepted: usize,
    /// Certificates refused, or without a verdict: each is a failure.
    pub refused: usize,
    /// Certificates not verified, by what is missing.
    pub not_verified: BTreeMap<String, usize>,
    /// The same for the certificates that hold a kind of evidence. A certificate with several kinds
    /// counts for each.
    pub kinds: BTreeMap<&'static str, KindCounts>,
}

/// Verdicts on the certificates that hold one kind of evidence.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct KindCounts {
    /// With a proved statement.
    pub accepted: usize,
    /// Refused, or without a verdict.
    pub refused: usize,
    /// Not verified.
    pub not_verified: usize,
}

impl KindCounts {
    /// All of them.
    pub fn total(&self) -> usize {
        self.accepted + self.refused + self.not_verified
    }

    fn count(&mut self, verdict: &VerifiedVerdict) {
        match verdict {
            VerifiedVerdict::Accepted(_) | VerifiedVerdict::Undecided(_) => self.accepted += 1,
            VerifiedVerdict::NotVerified(_) => self.not_verified += 1,
            _ => self.refused += 1,
        }
    }

    fn add(&mut self, other: &KindCounts) {
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.not_verified += other.not_verified;
    }
}

impl VerifiedCounts {
    /// Gives a certificate to the verified checker and counts the verdict. Returns why it is
    /// refused, if it is.
    pub fn submit(
        &mut self,
        checker: &VerifiedChecker,
        problem: &Problem,
        certificate: &Certificate,
    ) -> Option<String> {
        let verdict = checker.judge(problem, certificate);
        self.count(certificate, &verdict);
        verdict.refusal()
    }

    /// Counts the verdict on a certificate.
    pub fn count(&mut self, certificate: &Certificate, verdict: &VerifiedVerdict) {
        match verdict {
            VerifiedVerdict::Accepted(_) | VerifiedVerdict::Undecided(_) => self.accepted += 1,
            VerifiedVerdict::NotVerified(what) => {
                *self.not_verified.entry(what.clone()).or_default() += 1;
            }
            _ => self.refused += 1,
        }

        for kind in kinds_of(certificate) {
            self.kinds.entry(kind).or_default().count(verdict);
        }
    }

    /// Adds the counts of another run.
    pub fn add(&mut self, other: &VerifiedCounts) {
        self.accepted += other.accepted;
        self.refused += other.refused;

        for (what, count) in &other.not_verified {
            *self.not_verified.entry(what.clone()).or_default() += count;
        }
        for (kind, counts) in &other.kinds {
            self.kinds.entry(kind).or_default().add(counts);
        }
    }

    /// Certificates for which there is no theorem, or no witness was found.
    pub fn total_not_verified(&self) -> usize {
        self.not_verified.values().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_check::certificate::{CompleteSet, Node, Piece};
    use mceip_model::{Unknown, Window};

    fn cover(tree: Vec<Node>) -> Certificate {
        let piece = Piece {
            max: None,
            anchor: None,
            tree,
        };
        Certificate {
            problem_sha256: String::new(),
            unknown: Unknown::Mu,
            window: Window::all(),
            claims: vec![],
            negative: None,
            complete_set: Some(CompleteSet {
                condensation: None,
                pieces: vec![piece],
            }),
        }
    }

    #[test]
    fn each_certificate_counts_once_and_once_for_each_of_its_kinds() {
        let definite = cover(vec![
            Node::Branch(0),
            Node::PositiveDefinite,
            Node::PositiveDefinite,
        ]);
        let open = cover(vec![Node::Branch(0), Node::PositiveDefinite, Node::Open]);

        let mut first = VerifiedCounts::default();
        first.count(&definite, &VerifiedVerdict::Accepted(vec![]));
        first.count(&open, &VerifiedVerdict::NotVerified("open".into()));

        let mut second = VerifiedCounts::default();
        second.count(&open, &VerifiedVerdict::NotVerified("open".into()));
        second.count(&open, &VerifiedVerdict::None("a crash".into()));

        first.add(&second);
        assert_eq!(first.accepted, 1);
        assert_eq!(first.refused, 1);
        assert_eq!(first.total_not_verified(), 2);

        let of_definite = KindCounts {
            accepted: 1,
            refused: 1,
            not_verified: 2,
        };
        let of_open = KindCounts {
            accepted: 0,
            refused: 1,
            not_verified: 2,
        };
        assert_eq!(first.kinds["positive_definite"], of_definite);
        assert_eq!(first.kinds["open"], of_open);
        assert_eq!(of_open.total(), 3);
    }
}
