//! Certificates that the checker has accepted, as they are written to a file.
//!
//! [`Proved`] is the only value that may be called certified. It is made here alone, by checking a
//! certificate as a whole, and it gives the text of the file only if the text, read again, is that
//! very certificate. Claims that cost more together than one file may are shared out over several
//! files ([`Proved::claims`]).

use crate::certificate::{Certificate, Claim, CriticalCertificate, PresenceCertificate};
use crate::{Accepted, AcceptedAbsence, AcceptedPresence, Rejected};
use crate::{allowed_work, check, check_critical, check_presence, work_of};
use mceip_model::{ModelError, Problem};

/// A kind of certificate: its verdict and its file.
pub trait Evidence: Sized + PartialEq {
    /// What an accepted one has proved.
    type Accepted;

    /// Checks the certificate against a problem.
    ///
    /// # Errors
    /// [`Rejected`] with the first obligation that fails.
    fn check(&self, problem: &Problem) -> Result<Self::Accepted, Rejected>;

    /// The text of its file.
    fn text(&self) -> String;

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`ModelError`]: no certificate of this kind.
    fn read(text: &str) -> Result<Self, ModelError>;
}

impl Evidence for Certificate {
    type Accepted = Accepted;

    fn check(&self, problem: &Problem) -> Result<Accepted, Rejected> {
        check(problem, self)
    }

    fn text(&self) -> String {
        self.to_json()
    }

    fn read(text: &str) -> Result<Certificate, ModelError> {
        Certificate::from_json(text)
    }
}

impl Evidence for CriticalCertificate {
    type Accepted = AcceptedAbsence;

    fn check(&self, problem: &Problem) -> Result<AcceptedAbsence, Rejected> {
        check_critical(problem, self)
    }

    fn text(&self) -> String {
        self.to_json()
    }

    fn read(text: &str) -> Result<CriticalCertificate, ModelError> {
        CriticalCertificate::from_json(text)
    }
}

impl Evidence for PresenceCertificate {
    type Accepted = AcceptedPresence;

    fn check(&self, problem: &Problem) -> Result<AcceptedPresence, Rejected> {
        check_presence(problem, self)
    }

    fn text(&self) -> String {
        self.to_json()
    }

    fn read(text: &str) -> Result<PresenceCertificate, ModelError> {
        PresenceCertificate::from_json(text)
    }
}

/// A certificate that is accepted as a whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proved<C: Evidence> {
    certificate: C,
    accepted: C::Accepted,
}

impl<C: Evidence> Proved<C> {
    /// The certificate, if it is accepted for this problem.
    ///
    /// # Errors
    /// [`Rejected`] with the first obligation that fails.
    pub fn new(problem: &Problem, certificate: C) -> Result<Proved<C>, Rejected> {
        let accepted = certificate.check(problem)?;
        Ok(Proved {
            certificate,
            accepted,
        })
    }

    /// The certificate.
    pub fn certificate(&self) -> &C {
        &self.certificate
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
        if again == self.certificate {
            Ok(text)
        } else {
            Err(ModelError::NotAsWritten)
        }
    }
}

impl Proved<Certificate> {
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

        let certificates = files.into_iter().map(|claims| Certificate {
            problem_sha256: problem.sha256(),
            unknown: problem.unknown(),
            window: problem.window().clone(),
            claims,
            complete_set: None,
        });
        certificates.map(|c| Proved::new(problem, c)).collect()
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
