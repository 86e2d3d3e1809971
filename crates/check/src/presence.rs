//! The verdict on `mceip-presence/1`: there is a solution for every friction of an interval.
//!
//! The certificate ([`crate::certificate::PresenceCertificate`]) speaks of the mechanical system of
//! a problem with unknown lambda^2, with mu in [`from`, `to`] in place of the friction of the file.
//! This module demands that it belongs to the problem and says something; `cover::presence` checks
//! its pieces. The obligations are those of `spec/certificates.md`, 5.19.

use crate::certificate::PresenceCertificate;
use crate::critical::friction_parts;
use crate::reason::{Reason, Rejected};
use crate::{Covers, cover, of_problem};
use mceip_exact::Rational;
use mceip_model::Problem;
use num_traits::Signed;

/// What an accepted certificate has proved: a solution with lambda^2 >= 0 for every mu in
/// [`from`, `to`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedPresence {
    /// Smallest friction.
    pub from: Rational,
    /// Largest friction.
    pub to: Rational,
    /// Number of pieces that prove it.
    pub pieces: usize,
    /// Is it proved of every member of a problem whose data have radii?
    pub is_of_every_member: bool,
}

/// Checks a certificate of presence on an interval of friction, exactly.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn check_presence(
    problem: &Problem,
    certificate: &PresenceCertificate,
) -> Result<AcceptedPresence, Rejected> {
    of_problem(problem, &certificate.problem_sha256, Covers::EveryMember)?;
    let parts = friction_parts(problem)?;
    parts
        .plain
        .without_zero("presence on an interval of friction")?;

    let PresenceCertificate { from, to, .. } = certificate;
    if from.is_negative() || from >= to {
        let (from, to) = (from.clone(), to.clone());
        return Err(Reason::FrictionRange { from, to }.into());
    }

    cover::presence::check(&parts, certificate)?;
    Ok(AcceptedPresence {
        from: from.clone(),
        to: to.clone(),
        pieces: certificate.pieces.len(),
        is_of_every_member: !problem.is_exact(),
    })
}
