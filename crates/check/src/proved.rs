//! Certificates that the checker has accepted, as they are written to a file.
//!
//! [`Proved`] is the only value that may be called certified. It is made here alone, by checking a
//! certificate as a whole, and it gives the text of the file only if the text, read again, is that
//! very certificate. Claims that cost more together than one file may are shared out over several
//! files ([`Proved::claims`]).

use crate::certificate::{
    Certificate, Claim, CriticalCertificate, EquilibriumCertificate, Node, PresenceCertificate,
    StabilityCertificate,
};
use crate::{
    Accepted, AcceptedAbsence, AcceptedEquilibrium, AcceptedPresence, AcceptedStability, LeafPlace,
    Rejected,
};
use crate::{allowed_work, audit, audit_critical, work_of};
use crate::{check, check_critical, check_equilibrium, check_presence, check_stability};
use mceip_model::{LoadedBody, ModelError, Problem, Unknown};
use std::sync::Arc;

/// The kinds are those of this crate: nobody else says what is accepted.
mod sealed {
    pub trait Kind {}
}

/// A kind of certificate: its verdict and its file.
pub trait Provable: Sized + PartialEq + sealed::Kind {
    /// What it is about.
    type Subject;
    /// What an accepted one has proved.
    type Accepted;

    /// Checks the certificate against what it is about.
    ///
    /// # Errors
    /// [`Rejected`] with the first obligation that fails.
    fn check(&self, subject: &Self::Subject) -> Result<Self::Accepted, Rejected>;

    /// The text of its file.
    fn text(&self) -> String;

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`ModelError`]: no certificate of this kind.
    fn read(text: &str) -> Result<Self, ModelError>;
}

/// A kind of certificate: what it is about, what it proves, and its verdict.
macro_rules! provable {
    ($kind:ty, $subject:ty, $accepted:ty, $check:path) => {
        impl sealed::Kind for $kind {}

        impl Provable for $kind {
            type Subject = $subject;
            type Accepted = $accepted;

            fn check(&self, subject: &$subject) -> Result<$accepted, Rejected> {
                $check(subject, self)
            }

            fn text(&self) -> String {
                self.to_json()
            }

            fn read(text: &str) -> Result<$kind, ModelError> {
                <$kind>::from_json(text)
            }
        }
    };
}

provable!(Certificate, Problem, Accepted, check);
provable!(
    CriticalCertificate,
    Problem,
    AcceptedAbsence,
    check_critical
);
provable!(
    PresenceCertificate,
    Problem,
    AcceptedPresence,
    check_presence
);
provable!(
    StabilityCertificate,
    Problem,
    AcceptedStability,
    check_stability
);
provable!(
    EquilibriumCertificate,
    LoadedBody,
    AcceptedEquilibrium,
    check_equilibrium
);

/// A certificate that is accepted as a whole. Clones share it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proved<C: Provable> {
    certificate: Arc<C>,
    accepted: C::Accepted,
}

impl<C: Provable> Proved<C> {
    /// The certificate, if it is accepted for this problem or body.
    ///
    /// # Errors
    /// [`Rejected`] with the first obligation that fails.
    pub fn new(subject: &C::Subject, certificate: C) -> Result<Proved<C>, Rejected> {
        let accepted = certificate.check(subject)?;
        Ok(Proved {
            certificate: Arc::new(certificate),
            accepted,
        })
    }

    /// The certificate.
    pub fn certificate(&self) -> &C {
        &self.certificate
    }

    /// The certificate, to be changed: what comes of it is proved no longer.
    pub fn into_certificate(self) -> C
    where
        C: Clone,
    {
        Arc::unwrap_or_clone(self.certificate)
    }

    /// Is this a clone of the other one?
    pub fn is_clone_of(&self, other: &Proved<C>) -> bool {
        Arc::ptr_eq(&self.certificate, &other.certificate)
    }

    /// What it has proved.
    pub fn accepted(&self) -> &C::Accepted {
        &self.accepted
    }

    /// The text of its file. The verdict is on the certificate; that it is a verdict on the file
    /// rests on the comparison made here.
    ///
    /// # Errors
    /// [`ModelError`]: the text is not readable, or it is another certificate when it is read.
    pub fn file(&self) -> Result<String, ModelError> {
        let text = self.certificate.text();
        let again = C::read(&text)?;
        if again == *self.certificate {
            Ok(text)
        } else {
            Err(ModelError::NotAsWritten)
        }
    }
}

/// A certificate that is refused, to be mended.
#[derive(Debug)]
pub struct NotAccepted {
    /// The certificate.
    pub certificate: Certificate,
    /// Why.
    pub rejected: Rejected,
}

impl Proved<Certificate> {
    /// The certificate in which each leaf of the cover that fails is open, and these leaves.
    ///
    /// # Errors
    /// [`NotAccepted`] with an obligation that fails although these leaves are open.
    pub fn opened(
        problem: &Problem,
        mut certificate: Certificate,
    ) -> Result<(Proved<Certificate>, Vec<LeafPlace>), Box<NotAccepted>> {
        let (accepted, refused) = match audit(problem, &certificate) {
            Ok(audited) => audited,
            Err(rejected) => {
                return Err(Box::new(NotAccepted {
                    certificate,
                    rejected,
                }));
            }
        };

        // The verdict takes these leaves for open; so the certificate must have them open.
        if let Some(set) = &mut certificate.complete_set {
            for &(piece, node) in &refused {
                set.pieces[piece].tree[node] = Node::Open;
            }
        }

        let proved = Proved {
            certificate: Arc::new(certificate),
            accepted,
        };
        Ok((proved, refused))
    }

    /// This certificate of an eigenvalue problem, with what one of its reflection says as its
    /// values below 0.
    ///
    /// Both have been accepted, each for the problem whose digest it names. So they are not checked
    /// again where these are the digests of `problem` and of its reflection.
    ///
    /// # Errors
    /// [`Rejected`] where they are not, with the first obligation that fails.
    pub fn with_negative(
        self,
        problem: &Problem,
        reflected: Proved<Certificate>,
    ) -> Result<Proved<Certificate>, Rejected> {
        let names = |proved: &Proved<Certificate>, problem: &Problem| {
            let certificate = &proved.certificate;
            certificate.problem_sha256 == problem.sha256()
                && certificate.unknown == Unknown::Eigenvalue
                && certificate.negative.is_none()
        };
        let reflection = problem.reflected();
        let is_of_reflection = reflection.is_some_and(|problem| names(&reflected, &problem));
        let are_known = is_of_reflection && names(&self, problem);

        let accepted = self.accepted.clone();
        let below = reflected.accepted.clone();
        let certificate = self
            .into_certificate()
            .with_negative(reflected.into_certificate());
        if !are_known {
            return Proved::new(problem, certificate);
        }

        Ok(Proved {
            certificate: Arc::new(certificate),
            accepted: accepted.with_negative(below.claims, below.cover),
        })
    }

    /// The claims, without a complete set, in as few files as their order and the limit of work of
    /// a file allow; none for no claims.
    ///
    /// # Errors
    /// [`Rejected`] for a claim that is refused; its number counts from the first one of its file.
    pub fn claims(
        problem: &Problem,
        claims: Vec<Claim>,
    ) -> Result<Vec<Proved<Certificate>>, Rejected> {
        let works: Vec<u64> = claims.iter().map(work_of).collect();
        let mut claims = claims.into_iter();
        let mut files: Vec<Vec<Claim>> = Vec::new();
        for count in shares(&works) {
            files.push(claims.by_ref().take(count).collect());
        }

        let files = files.into_iter();
        let certificates = files.map(|claims| Certificate::of_claims(problem, claims));
        certificates.map(|c| Proved::new(problem, c)).collect()
    }
}

impl Proved<CriticalCertificate> {
    /// The certificate, if it is accepted for this problem; `None` if `go_on` has said no, which is
    /// asked before each anchor and each node.
    ///
    /// # Errors
    /// [`Rejected`] with an obligation that fails.
    pub fn unless_stopped(
        problem: &Problem,
        certificate: CriticalCertificate,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Option<Proved<CriticalCertificate>>, Rejected> {
        match audit_critical(problem, &certificate, go_on)? {
            None => Ok(None),
            Some((accepted, refused)) if refused.is_empty() => Ok(Some(Proved {
                certificate: Arc::new(certificate),
                accepted,
            })),
            Some(_) => Proved::new(problem, certificate).map(Some),
        }
    }
}

/// How many claims go into each file: of claims that cost this much, as many in turn as the limit
/// of a file allows. A claim alone is within the limit, or is refused by itself.
fn shares(works: &[u64]) -> Vec<usize> {
    let mut shares: Vec<usize> = Vec::new();
    let mut used: u64 = 0;
    for &work in works {
        let with_this_one = used.saturating_add(work);
        match shares.last_mut() {
            Some(count) if with_this_one <= allowed_work(*count + 1) => {
                *count += 1;
                used = with_this_one;
            }
            _ => {
                shares.push(1);
                used = work;
            }
        }
    }

    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each file is within its limit, and the next claim would not be.
    #[test]
    fn claims_fill_one_file_after_the_other() {
        assert_eq!(shares(&[]), Vec::<usize>::new());
        assert_eq!(shares(&[0; 1000]), [1000]);

        let half = allowed_work(2) / 2;
        assert_eq!(shares(&[half, half]), [2]);
        assert_eq!(shares(&[half, half + 1]), [1, 1]);
        assert_eq!(shares(&[half, half, half, half, 1]), [2, 3]);
        assert_eq!(shares(&[u64::MAX, u64::MAX]), [1, 1]);
    }
}
