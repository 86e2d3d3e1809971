//! The verdict on `mceip-critical/1`: there is no solution below a friction.
//!
//! The certificate ([`crate::certificate::CriticalCertificate`]) speaks of the mechanical system of
//! a problem with unknown lambda^2, with mu in [`from`, `below`] in place of the friction of the
//! file. This module demands that it belongs to the problem and says something; `cover::critical`
//! checks its boxes. The obligations are those of `spec/certificates.md`, 5.18.

use crate::certificate::CriticalCertificate;
use crate::cover;
use crate::cover::walk::Audit;
use crate::pencil::FrictionParts;
use crate::reason::{Reason, Rejected};
use crate::{Covers, LeafPlace, of_problem};
use mceip_exact::Rational;
use mceip_model::{Body, Problem, Unknown};
use num_traits::Signed;

/// What an accepted certificate has proved: no solution for mu in [`from`, `below`] and
/// lambda^2 >= 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedAbsence {
    /// Smallest friction of which absence is proved.
    pub from: Rational,
    /// Largest friction of which absence is proved.
    pub below: Rational,
    /// Number of leaves that prove it.
    pub leaves: usize,
    /// Is it proved of every member of a problem whose data have radii?
    pub is_of_every_member: bool,
}

/// Checks a certificate of absence below a friction, exactly.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn check_critical(
    problem: &Problem,
    certificate: &CriticalCertificate,
) -> Result<AcceptedAbsence, Rejected> {
    Ok(verdict(problem, certificate, None)?)
}

/// What a certificate proves without the leaves that fail, and these leaves. Without any,
/// [`check_critical`] accepts the certificate.
///
/// A search that wants to replace all leaves that fail calls this once, where it would have to call
/// [`check_critical`] once for each of them. `go_on` is asked before each anchor and each node;
/// after a no the answer is `None`, which says nothing about the certificate.
///
/// # Errors
/// [`Rejected`] with an obligation that fails although these leaves are passed over.
pub fn audit_critical(
    problem: &Problem,
    certificate: &CriticalCertificate,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<(AcceptedAbsence, Vec<LeafPlace>)>, Rejected> {
    let audit = Audit::new(go_on);
    let accepted = verdict(problem, certificate, Some(&audit))?;
    Ok(audit.into_refused().map(|refused| (accepted, refused)))
}

fn verdict(
    problem: &Problem,
    certificate: &CriticalCertificate,
    audit: Option<&Audit<'_>>,
) -> Result<AcceptedAbsence, Reason> {
    of_problem(problem, &certificate.problem_sha256, Covers::EveryMember)?;
    let parts = friction_parts(problem)?;
    let CriticalCertificate { from, below, .. } = certificate;
    if !below.is_positive() {
        return Err(Reason::Below { got: below.clone() });
    }
    if from.is_negative() || from >= below {
        return Err(Reason::FrictionRange {
            from: from.clone(),
            to: below.clone(),
        });
    }

    let leaves = cover::critical::check(&parts, certificate, audit)?;
    Ok(AcceptedAbsence {
        from: from.clone(),
        below: below.clone(),
        leaves,
        is_of_every_member: !problem.is_exact(),
    })
}

/// The pencil of the problem as a function of mu: it must be a mechanical system with unknown
/// lambda^2 on flat obstacles.
///
/// Soundness hangs on the last: T = T0 + mu T1 leaves out what turns along a curved obstacle.
pub(crate) fn friction_parts(problem: &Problem) -> Result<FrictionParts, Reason> {
    let Body::System(system) = problem.body() else {
        return Err(Reason::NotASystem);
    };

    let (Unknown::Lambda2, Some(mass)) = (problem.unknown(), system.mass()) else {
        return Err(Reason::Unknown {
            expected: problem.unknown().word(),
            got: Unknown::Lambda2.word(),
        });
    };
    if let Some(particle) = system.curved_particle() {
        return Err(Reason::Curved { particle });
    }

    Ok(FrictionParts::of(system, mass))
}
